/* Numbers in what a program printed or wrote. */
#ifndef TOOLS_RESULT_H
#define TOOLS_RESULT_H

#include <stdbool.h>
#include <stddef.h>

/* What counts when a key is stated more than once. */
enum result_match { RESULT_EQUAL, RESULT_FIRST, RESULT_LAST };

/* The n numbers that the text states for a key. A line states it when the key stands in it as a
 * word, in quotes or not, then perhaps a unit in brackets, and then
 *   - one of = : | and a value, which must be a number: "Cw = diverged" is a failure;
 *   - a blank or a comma and a number: "Cw history written" is prose.
 * A number is a whole word, with E, D or Q before its exponent or, as Fortran writes large ones,
 * with none ("1.5-103"). RESULT_EQUAL: statements that differ are a failure. On failure the reason
 * quotes the line. */
bool result_find(const char *text, const char *key, enum result_match match, size_t n,
                 double *values, char *reason, size_t size);

/* The number at the end of the last line that is not blank. */
bool result_last(const char *text, double *value, char *reason, size_t size);

/* The last line that is not blank, without the blanks around it; *length 0: there is none. */
const char *result_last_line(const char *text, size_t *length);

#endif
