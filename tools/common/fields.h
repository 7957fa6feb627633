/* Texts with {name} in them, such as commands. */
#ifndef TOOLS_FIELDS_H
#define TOOLS_FIELDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Writes what a name of that length stands for, to out unless that is NULL; false: it is no field.
 */
typedef bool (*fields_value)(void *user_data, const char *name, size_t length, FILE *out);

/* Writes the text with every {name} replaced. "{{" stands for a brace; braces around anything but a
 * word stay, and so do those after a $. */
void fields_write(const char *text, size_t length, fields_value value, void *user_data, FILE *out);

/* The first {word} that is no field, or NULL; *field is its length, braces included. */
const char *fields_unknown(const char *text, size_t length, fields_value value, void *user_data,
                           size_t *field);

#endif
