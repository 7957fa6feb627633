/* Texts with {name} in them: the command, and input files of the program. */
#ifndef BAYESOPT_TOOL_TEMPLATE_H
#define BAYESOPT_TOOL_TEMPLATE_H

#include "fields.h"
#include "names.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* What the fields of a template stand for: the variables, {id} and {level}. */
struct template_values {
    const struct names *names;
    const double *x; /* [d] */
    uint64_t id;
    int level;
};

/* Writes the text with every {name} replaced. "{{" stands for a brace; braces around anything but a
 * word stay, and so do those after a $. */
void template_write(const char *text, size_t length, const struct template_values *values,
                    FILE *out);

/* The first {word} that is no field, or NULL; *field is its length, braces included. */
const char *template_unknown(const char *text, size_t length, const struct names *names,
                             size_t *field);

/* Copies a template into a folder, under its own name, filled in. Prints the sentence on failure.
 */
bool template_copy(const char *path, const char *folder, const struct template_values *values);

#endif
