#include "cli.h"
#include "settings_internal.h"
#include "text.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void print_range(const struct setting *row, FILE *out)
{
    const char *least = row->open_least ? ">" : ">=", *most = row->open_most ? "<" : "<=";
    if (isinf(row->most))
        fprintf(out, " %s %.15g", least, row->least);
    else if (row->open_least != row->open_most)
        fprintf(out, " %s %.15g and %s %.15g", least, row->least, most, row->most);
    else if (row->open_least)
        fprintf(out, " between %.15g and %.15g, both excluded", row->least, row->most);
    else
        fprintf(out, " from %.15g to %.15g", row->least, row->most);
}

void settings_print_expected(const struct setting *row, FILE *out)
{
    static const char *const kinds[][2] = {
        [SETTING_NUMBER] = {"a number", "numbers"},
        [SETTING_COUNT] = {"a whole number", "whole numbers"},
        [SETTING_INTEGER] = {"an integer", "integers"},
        [SETTING_SWITCH] = {"true or false", "true or false"},
        [SETTING_CHOICE] = {"", "of "},
        [SETTING_TEXT] = {"a text", "texts"},
        [SETTING_FILE] = {"a file", "files"},
        [SETTING_NUMBERS] = {"numbers", "numbers"},
        [SETTING_ROWS] = {"mappings in a list", "mappings in a list"}};
    const char *word;
    double value;
    if (!row) {
        fputs("a mapping of settings", out);
        return;
    }
    if (row->n_most > 1 && row->n_most == row->n_least)
        fprintf(out, "%zu ", row->n_most);
    else if (row->n_most > 1)
        fprintf(out, "%zu to %zu ", row->n_least, row->n_most);
    fputs(kinds[row->type][row->n_most > 1], out);
    if (settings_has_range(row))
        print_range(row, out);
    for (int k = 0; row->type != SETTING_SWITCH && (word = settings_word(row, k, &value)) != NULL;
         k++) {
        bool excluded = row->open_least && row->open_most && isfinite(row->most);
        const char *before = settings_word(row, k + 1, &value) ? ", " : excluded ? ", or " : " or ";
        fprintf(out, "%s%s", k == 0 && row->type == SETTING_CHOICE ? "" : before, word);
    }
}

/* Entry i of the value at AT, by its word where it has one. */
static void print_entry(const struct setting *row, const void *at, size_t i, FILE *out)
{
    const char *word;
    double value = NAN, meant;
    if (row->type >= SETTING_TEXT && row->type <= SETTING_FILE) {
        fputs(((char *const *)at)[i] ? ((char *const *)at)[i] : "", out);
        return;
    }
    if (row->type == SETTING_NUMBER || row->type == SETTING_NUMBERS)
        value = row->type == SETTING_NUMBER ? ((const double *)at)[i] : (*(double *const *)at)[i];
    else if (row->type == SETTING_COUNT)
        value = (double)((const size_t *)at)[i];
    else if (row->type != SETTING_SWITCH || row->size == sizeof(int))
        value = ((const int *)at)[i];
    else
        value = ((const bool *)at)[i];
    for (int k = 0; (word = settings_word(row, k, &meant)) != NULL; k++)
        if (meant == value || (isnan(meant) && isnan(value)))
            break;
    if (word)
        fputs(word, out);
    else if (row->type == SETTING_COUNT)
        fprintf(out, "%zu", ((const size_t *)at)[i]);
    else if (!isnan(value))
        fprintf(out, "%.15g", value);
}

char *settings_value(const struct setting *row, const void *target)
{
    char *text = NULL;
    size_t length, n = row->n_most ? row->n_most : row->type < SETTING_ROWS;
    FILE *out = cli_needed(text_open(&text, &length));
    if (row->count)
        n = *(const size_t *)(const void *)((const char *)target + row->count);
    for (size_t i = 0; i < n && row->type != SETTING_HEADING && row->type != SETTING_ROWS; i++) {
        fputs(i ? ", " : "", out);
        print_entry(row, (const char *)target + row->offset, i, out);
    }
    return cli_needed(text_close(out, &text));
}

static bool print_file(const char *path, FILE *out)
{
    const char *slash = strrchr(path, '/');
    FILE *file = fopen(path, "rb");
    if (!file && errno == ENOMEM)
        cli_needed(NULL);
    if (!file)
        return false;
    uint64_t hash = UINT64_C(0xcbf29ce484222325); /* FNV-1a */
    for (int byte; (byte = getc_unlocked(file)) != EOF;)
        hash = (hash ^ (unsigned char)byte) * UINT64_C(0x100000001b3);
    bool ok = !ferror(file);
    fclose(file);
    fprintf(out, "%s (%016" PRIx64 ")", slash ? slash + 1 : path, hash);
    return ok;
}

char *settings_text(const struct settings *table, const void *target)
{
    char *text = NULL;
    size_t length;
    FILE *out = cli_needed(text_open(&text, &length));
    bool ok = true;
    for (size_t r = 0; ok && r < table->n; r++) {
        const struct setting *row = &table->rows[r];
        if (!row->key || row->type == SETTING_ROWS)
            continue;
        char *value = settings_value(row, target);
        fprintf(out, "%s =%s", row->key, *value ? " " : "");
        for (char *c = value; *c; c++)
            *c = *c == '\n' ? ' ' : *c;
        if (*value && row->type == SETTING_FILE)
            ok = print_file(value, out);
        else
            fputs(value, out);
        fputc('\n', out);
        free(value);
    }
    cli_needed(text_close(out, &text));
    if (ok)
        return text;
    free(text);
    return NULL;
}

static const struct setting *row_of(const struct settings *table, const char *key, size_t length)
{
    for (size_t r = 0; r < table->n; r++) {
        const char *known = table->rows[r].key;
        if (known && strlen(known) == length && strncmp(known, key, length) == 0)
            return &table->rows[r];
    }
    return NULL;
}

/* What was read is all there, and goes together. */
static bool is_whole(const struct settings *table, const char *text, void *target)
{
    struct settings_source source = {.prefix = ""};
    for (size_t r = 0; r < table->n; r++) {
        const char *key = table->rows[r].key, *at = text;
        if (!key || !table->rows[r].required)
            continue;
        size_t length = strlen(key);
        while (at && (strncmp(at, key, length) != 0 || strncmp(at + length, " =", 2) != 0))
            at = strchr(at, '\n') ? strchr(at, '\n') + 1 : NULL;
        const char *value = at ? at + length + 2 : "";
        value += *value == ' ';
        if (*value == '\0' || *value == '\n')
            return false;
    }
    if (table->check)
        table->check(&source, target);
    return settings_forget(&source);
}

bool settings_restore(const struct settings *table, const char *text, void *target, size_t *line)
{
    const char *at = text;
    for (*line = 1; *at; ++*line) {
        size_t length = strcspn(at, "\n"), key = strcspn(at, " =\n");
        const struct setting *row = row_of(table, at, key);
        if (!row || strncmp(at + key, " =", 2) != 0)
            return false;
        key += at[key + 2] == ' ' ? 3 : 2;
        char *value = cli_needed(strndup(at + key, length - key));
        bool ok = !*value || settings_set_text(NULL, row, 0, "", value, target);
        free(value);
        if (!ok)
            return false;
        at += length + (at[length] == '\n');
    }
    *line = 0;
    return is_whole(table, text, target);
}

enum { HELP_COLUMN = 22, HELP_WIDTH = 96 };

/* Words of a text from the column at on, broken at the width and indented. */
static void wrap(const char *text, size_t at, FILE *out)
{
    while (*text) {
        size_t length = strcspn(text, " ");
        if (at > HELP_COLUMN && at + 1 + length > HELP_WIDTH) {
            fprintf(out, "\n%*s", HELP_COLUMN, "");
            at = HELP_COLUMN;
        }
        at += (size_t)fprintf(out, "%s%.*s", at > HELP_COLUMN ? " " : "", (int)length, text);
        text += length + strspn(text + length, " ");
    }
    fputc('\n', out);
}

/* The sentence of a row, what it may be and, of a target, what it is. */
static void print_meaning(const struct setting *row, const void *target, FILE *out)
{
    char *value = target ? settings_value(row, target) : NULL;
    fputs(row->sentence, out);
    if (settings_has_range(row) || row->words || row->choice) {
        fputs("; ", out);
        settings_print_expected(row, out);
    }
    if (value && *value && row->type != SETTING_SWITCH)
        fprintf(out, " (default %s)", value);
    free(value);
}

/* A value as YAML has it. */
static void print_yaml(const struct setting *row, const char *value, FILE *out)
{
    bool list = row->n_most || row->type == SETTING_NUMBERS;
    bool text = row->type == SETTING_TEXT || row->type == SETTING_FILE;
    if (!list && !text) {
        fputs(value, out);
        return;
    }
    fputs(list ? "[" : "\"", out);
    for (; *value; value++)
        fprintf(out, "%s%c", text && strchr("\"\\", *value) ? "\\" : "", *value);
    fputs(list ? "]" : "\"", out);
}

void settings_template(const struct settings *table, const void *target, FILE *out)
{
    size_t section = 0;
    const char *before = "";
    for (size_t r = 0; r < table->n; r++) {
        const struct setting *row = &table->rows[r];
        if (!row->key || row->type == SETTING_ROWS)
            continue;
        const char *dot = strrchr(row->key, '.');
        size_t length = dot ? (size_t)(dot - row->key) : 0;
        if (length && (length != section || strncmp(before, row->key, length) != 0))
            fprintf(out, "\n%.*s:\n", (int)length, row->key);
        section = length;
        before = row->key;
        const char *indent = length ? "  " : "";
        char *value = settings_value(row, target);
        fprintf(out, "%s# ", indent);
        print_meaning(row, NULL, out);
        fprintf(out, "\n%s%s: ", indent, dot ? dot + 1 : row->key);
        if (*value || row->n_most)
            print_yaml(row, value, out);
        fputc('\n', out);
        free(value);
    }
}

static void print_help_row(const struct setting *row, const void *target, bool keys, FILE *out)
{
    static const char *const names[] = {
        [SETTING_NUMBER] = "X",        [SETTING_COUNT] = "N",   [SETTING_INTEGER] = "N",
        [SETTING_CHOICE] = "NAME",     [SETTING_TEXT] = "TEXT", [SETTING_FILE] = "FILE",
        [SETTING_NUMBERS] = "X,Y,...", [SETTING_ROWS] = ""};
    char name[80], meaning[800];
    FILE *text = cli_needed(fmemopen(meaning, sizeof meaning, "w"));
    const char *kind = names[row->type] ? names[row->type] : "";
    print_meaning(row, target, text);
    fclose(text);
    if (row->n_most > 1 && row->type < SETTING_CHOICE)
        kind = row->type == SETTING_NUMBER ? "X,Y,..." : "N,M,...";
    if (keys)
        snprintf(name, sizeof name, "%s", row->key);
    else
        snprintf(name, sizeof name, "%.1s%.1s%s--%s %s", row->letter ? "-" : "", &row->letter,
                 row->letter ? ", " : "", row->option, kind);
    if (fprintf(out, "  %-*s", HELP_COLUMN - 3, name) >= HELP_COLUMN)
        fprintf(out, "\n%*s", HELP_COLUMN - 1, "");
    fputc(' ', out);
    wrap(meaning, HELP_COLUMN, out);
}

void settings_help(const struct settings *table, const void *target, bool keys, FILE *out)
{
    for (size_t r = 0; r < table->n; r++) {
        const struct setting *row = &table->rows[r];
        if (row->type == SETTING_HEADING && !row->option)
            fprintf(out, "\n%s\n", row->sentence);
        else if (keys ? row->key != NULL
                      : row->option && !(*row->option >= 'A' && *row->option <= 'Z'))
            print_help_row(row, target, keys, out);
    }
}
