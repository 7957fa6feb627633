/* Readers under libFuzzer, in one process: a program has a table of them, FUZZ_READER names the one
 * that takes the bytes. tests/fuzz/readers runs them; built without libFuzzer the program reads the
 * files that are its arguments, which is how findings are tried again. */
#ifndef TESTS_FUZZ_TARGET_H
#define TESTS_FUZZ_TARGET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct reader {
    const char *name;
    const char *extension; /* of the file that holds the bytes; NULL: there is none */
    void (*read)(const char *path, size_t n, const uint8_t *bytes);
};

/* The program's, up to one without a name. */
extern const struct reader READERS[];

/* Ends the process when a promise of the reader does not hold. */
void demand(bool holds, const char *promise);
/* The same for n numbers that are all to be finite; NULL is none of them. */
void demand_finite(size_t n, const double *values, const char *what);

#endif
