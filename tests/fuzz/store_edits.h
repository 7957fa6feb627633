/* A sound store with values replaced: the bytes say which, so that the fuzzer works on what a
 * database holds, and not on its pages. */
#ifndef TESTS_FUZZ_STORE_EDITS_H
#define TESTS_FUZZ_STORE_EDITS_H

#include <stddef.h>
#include <stdint.h>

/* Writes to path the store that FUZZ_STORE names, changed as the bytes say: four for table, column,
 * row and kind of each value, then the value. */
void store_edit(const char *path, size_t n, const uint8_t *bytes);

#endif
