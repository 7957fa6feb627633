/* YAML configuration files through libcyaml: one sentence with file, line and field for whatever is
 * wrong. libcyaml reads "3x" as 3 and 3.5 as the integer 3, so numbers are declared as strings in
 * the schema and parsed by cli_parse_double() and its kin; the line of a field that turns out to be
 * wrong is found with cli_yaml_fail(). */
#ifndef TOOLS_YAML_FILE_H
#define TOOLS_YAML_FILE_H

#include <cyaml/cyaml.h>
#include <stdbool.h>
#include <stddef.h>

/* Loads PATH by the schema of its top mapping (CYAML_FLAG_POINTER) into *data. On failure prints
 * the sentence and returns false with *data NULL. */
bool cli_yaml_load(const char *path, const cyaml_schema_value_t *schema, void **data);
void cli_yaml_free(const cyaml_schema_value_t *schema, void *data);

/* Line of a field of a file in block or flow style, "latent.variance"; 0 when it is not there. */
size_t cli_yaml_line(const char *path, const char *field);

/* "path:line: field message" on stderr; returns CLI_FAILED. */
__attribute__((format(printf, 3, 4))) int cli_yaml_fail(const char *path, const char *field,
                                                        const char *format, ...);

#endif
