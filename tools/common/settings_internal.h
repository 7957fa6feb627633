/* Between the files of the settings: values, files, command lines. */
#ifndef TOOLS_SETTINGS_INTERNAL_H
#define TOOLS_SETTINGS_INTERNAL_H

#include "settings.h"

/* What is wrong with a file or, path NULL, with a command line, in the order of the lines. */
struct settings_source {
    const char *path;
    size_t n; /* some of very many are not among the complaints */
    struct complaint {
        size_t line; /* 0: none */
        char *text;
    } * complaints;
    void *document;     /* yaml_document_t */
    const void *node;   /* the mapping being read, yaml_node_t */
    const char *prefix; /* its name, "variables.2", or "" */
};

/* KEY of the mapping being read, or "", then the text. */
__attribute__((format(printf, 4, 5))) void settings_add(struct settings_source *source, size_t line,
                                                        const char *key, const char *format, ...);
/* The same, ended by what the row expects; NULL: a section. */
__attribute__((format(printf, 5, 6))) void settings_refuse(struct settings_source *source,
                                                           size_t line, const char *key,
                                                           const struct setting *row,
                                                           const char *format, ...);
/* Prints the complaints; true when there were none. */
bool settings_close(struct settings_source *source);
/* The same without a word. */
bool settings_forget(struct settings_source *source);

/* Stores n texts as the value of a row. On failure complains by the key, unless source is NULL. */
bool settings_set(struct settings_source *source, const struct setting *row, size_t line,
                  const char *key, size_t n, char *const *texts, void *target);
/* The same for one text with entries separated by commas (of whole numbers also by x or :). */
bool settings_set_text(struct settings_source *source, const struct setting *row, size_t line,
                       const char *key, const char *text, void *target);

/* The k-th word of a row and what it stands for; NULL after the last. */
const char *settings_word(const struct setting *row, int k, double *value);
bool settings_has_range(const struct setting *row);
/* What the value of a row may be; NULL: of a section. */
void settings_print_expected(const struct setting *row, FILE *out);

/* Whether so few letters inserted, dropped or replaced make one word of the other: fewer than
 * *least, which becomes their number. Begin with a third of the letters. */
bool settings_nearer(const char *a, const char *b, size_t *least);

#endif
