#include "settings.h"

#include "cli.h"
#include "settings_internal.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Of an array in one text; no row has more. */
enum { MOST_ENTRIES = 64 };

/* The k-th word of a row and what it stands for; NULL after the last. */
static const char *word_at(const struct setting *row, int k, double *value)
{
    if (row->choice) {
        *value = k;
        return row->choice(k);
    }
    if (!row->words || !row->words[k].name)
        return NULL;
    *value = row->words[k].value;
    return row->words[k].name;
}

static bool find_word(const struct setting *row, const char *text, double *value)
{
    const char *word;
    for (int k = 0; (word = word_at(row, k, value)) != NULL; k++)
        if (strcmp(word, text) == 0)
            return true;
    *value = 0;
    return false;
}

static bool inside(const struct setting *row, double value)
{
    if (row->least == 0 && row->most == 0)
        return true;
    return (row->open_least ? value > row->least : value >= row->least) &&
           (row->open_most ? value < row->most : value <= row->most);
}

static void print_range(const struct setting *row, FILE *out)
{
    if (row->least == 0 && row->most == 0)
        return;
    if (isinf(row->most))
        fprintf(out, " %s %.15g", row->open_least ? ">" : ">=", row->least);
    else if (row->open_least != row->open_most)
        fprintf(out, " %s %.15g and %s %.15g", row->open_least ? ">" : ">=", row->least,
                row->open_most ? "<" : "<=", row->most);
    else if (row->open_least)
        fprintf(out, " between %.15g and %.15g, both excluded", row->least, row->most);
    else
        fprintf(out, " from %.15g to %.15g", row->least, row->most);
}

void settings_print_expected(const struct setting *row, FILE *out)
{
    static const char *const kinds[] = {[SETTING_NUMBER] = "number",
                                        [SETTING_COUNT] = "whole number",
                                        [SETTING_SEED] = "whole number",
                                        [SETTING_INTEGER] = "integer",
                                        [SETTING_SWITCH] = "true or false",
                                        [SETTING_TEXT] = "text",
                                        [SETTING_FILE] = "file",
                                        [SETTING_NUMBERS] = "number",
                                        [SETTING_ROWS] = "mappings in a list"};
    bool many = (row->n_most > 1 && row->type != SETTING_ROWS) || row->type == SETTING_NUMBERS;
    if (many && row->n_most == row->n_least && row->type != SETTING_NUMBERS)
        fprintf(out, "%zu ", row->n_most);
    else if (row->n_most > 1)
        fprintf(out, "%zu to %zu ", row->n_least, row->n_most);
    if (row->type == SETTING_CHOICE)
        fputs(many ? "of " : "", out);
    else if (many)
        fprintf(out, "%ss", kinds[row->type]);
    else if (row->type == SETTING_SWITCH || row->n_most > 1)
        fputs(kinds[row->type], out);
    else
        fprintf(out, "%s %s", row->type == SETTING_INTEGER ? "an" : "a", kinds[row->type]);
    print_range(row, out);
    const char *word;
    double value;
    for (int k = 0; (word = word_at(row, k, &value)) != NULL; k++) {
        const char *before = word_at(row, k + 1, &value) ? ", " : " or ";
        fprintf(out, "%s%s", k == 0 && row->type == SETTING_CHOICE ? "" : before, word);
    }
}

/* Paths of a file are relative to its folder. */
static char *resolve(const char *config, const char *path)
{
    const char *slash = config ? strrchr(config, '/') : NULL;
    size_t folder = slash && *path != '/' ? (size_t)(slash - config) + 1 : 0;
    char *joined = malloc(folder + strlen(path) + 1);
    if (joined) {
        memcpy(joined, config ? config : "", folder);
        strcpy(joined + folder, path);
    }
    return joined;
}

static bool scan_switch(const char *text, bool *value)
{
    static const char *const words[] = {"false", "true", "no", "yes", "off", "on"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(text, words[i]) == 0) {
            *value = i % 2 == 1;
            return true;
        }
    return false;
}

/* Entry i of the row; false when the text is none of what is expected. */
static bool store(const struct setting *row, const char *text, size_t i, void *target,
                  const char *path)
{
    char *at = (char *)target + row->offset;
    double value;
    bool ok = find_word(row, text, &value);
    size_t count = ok ? (size_t)value : 0;
    int integer = ok ? (int)value : 0;
    switch (row->type) {
    case SETTING_NUMBER:
    case SETTING_NUMBERS:
        ok = ok || (cli_parse_double(text, &value) && inside(row, value));
        if (ok)
            ((double *)(void *)at)[i] = value;
        return ok;
    case SETTING_COUNT:
    case SETTING_SEED:
        ok = ok || (cli_parse_size(text, &count) && inside(row, (double)count));
        if (ok && row->type == SETTING_COUNT)
            ((size_t *)(void *)at)[i] = count;
        else if (ok)
            ((uint64_t *)(void *)at)[i] = count;
        return ok;
    case SETTING_INTEGER:
        ok = ok || (cli_parse_int(text, &integer) && inside(row, integer));
        /* fall through */
    case SETTING_CHOICE:
        if (ok)
            ((int *)(void *)at)[i] = integer;
        return ok;
    case SETTING_SWITCH:
        if (!scan_switch(text, &ok))
            return false;
        if (row->size == sizeof(int))
            ((int *)(void *)at)[i] = ok;
        else
            ((bool *)at)[i] = ok;
        return true;
    default: {
        char *copy = row->type == SETTING_FILE ? resolve(path, text) : strdup(text);
        free(((char **)(void *)at)[i]);
        ((char **)(void *)at)[i] = copy;
        return copy && (row->type != SETTING_FILE || !path || access(copy, R_OK) == 0);
    }
    }
}

static bool store_list(const struct setting *row, size_t n, char *const *texts, void *target,
                       size_t *bad)
{
    double **at = (double **)(void *)((char *)target + row->offset), *all = NULL;
    size_t total = 0;
    bool ok = true;
    for (*bad = 0; ok && *bad < n; *bad += ok) {
        double *part = NULL, *more = NULL;
        size_t m = 0;
        ok = cli_parse_list(texts[*bad], &part, &m) &&
             (more = realloc(all, (total + m) * sizeof *all)) != NULL;
        all = more ? more : all;
        for (size_t i = 0; ok && i < m; i++) {
            ok = inside(row, part[i]);
            all[total++] = part[i];
        }
        free(part);
    }
    if (ok) {
        free(*at);
        *at = all;
        *(size_t *)(void *)((char *)target + row->count) = total;
    } else {
        free(all);
    }
    return ok;
}

void settings_add(struct settings_source *source, size_t line, const char *format, ...)
{
    char text[640];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    struct complaint *more =
        realloc(source->complaints, (source->n + 1) * sizeof *source->complaints);
    char *copy = strdup(text);
    if (!more || !copy) {
        free(copy);
        source->complaints = more ? more : source->complaints;
        return;
    }
    source->complaints = more;
    size_t i = source->n++;
    for (; i > 0 && more[i - 1].line > line; i--)
        more[i] = more[i - 1];
    more[i] = (struct complaint){line, copy};
}

static void complain_value(struct settings_source *source, const struct setting *row, size_t line,
                           const char *name, size_t n, const char *text)
{
    int reason = errno;
    char expected[400] = "";
    FILE *out = fmemopen(expected, sizeof expected, "w");
    if (out) {
        settings_print_expected(row, out);
        fclose(out);
    }
    if (!text)
        settings_add(source, line, "%s has %zu %s, expected %s", name, n,
                     n == 1 ? "entry" : "entries", expected);
    else if (row->type == SETTING_FILE)
        settings_add(source, line, "%s is '%.100s', which cannot be read: %s", name, text,
                     strerror(reason));
    else
        settings_add(source, line, "%s is '%.100s', expected %s", name, text, expected);
}

bool settings_set(struct settings_source *source, const struct setting *row, size_t line,
                  const char *name, size_t n, char *const *texts, void *target)
{
    double value;
    size_t bad = 0, room = row->n_most ? row->n_most : 1;
    bool list = row->type == SETTING_NUMBERS;
    bool fill = n == 1 && row->n_least > 1 && find_word(row, texts[0], &value);
    n = fill ? row->n_least : n;
    bool fits = list || (n >= row->n_least && n <= room), ok = fits;
    if (list)
        ok = store_list(row, n, texts, target, &bad);
    for (; !list && ok && bad < n; bad += ok)
        ok = store(row, texts[fill ? 0 : bad], bad, target, source ? source->path : NULL);
    if (!ok && source)
        complain_value(source, row, line, name, n, fits ? texts[fill ? 0 : bad] : NULL);
    if (ok && row->count && !list)
        *(size_t *)(void *)((char *)target + row->count) = n;
    if (ok && row->given && source)
        *((bool *)target + row->given) = true;
    return ok;
}

bool settings_set_text(struct settings_source *source, const struct setting *row, size_t line,
                       const char *name, const char *text, void *target)
{
    bool whole = row->type == SETTING_COUNT || row->type == SETTING_INTEGER;
    char *copy = strdup(text), *texts[MOST_ENTRIES];
    size_t n = 0;
    if (!copy)
        return false;
    texts[n++] = copy;
    for (char *at = copy; row->n_most && *at; at++) {
        if (!strchr(whole ? ",x:" : ",", *at) || n == MOST_ENTRIES)
            continue;
        *at = '\0';
        texts[n++] = at + 1;
    }
    bool ok = settings_set(source, row, line, name, n, texts, target);
    free(copy);
    return ok;
}

void settings_start(const struct settings *table, void *target)
{
    for (size_t r = 0; r < table->n; r++) {
        const struct setting *row = &table->rows[r];
        if (row->type >= SETTING_TEXT)
            *(void **)(void *)((char *)target + row->offset) = NULL;
        if (row->otherwise)
            settings_set_text(NULL, row, 0, "", row->otherwise, target);
    }
    if (table->also)
        settings_start(table->also, (char *)target + table->also_offset);
}

void settings_free(const struct settings *table, void *target)
{
    for (size_t r = 0; r < table->n; r++) {
        const struct setting *row = &table->rows[r];
        if (row->type < SETTING_TEXT)
            continue;
        void **at = (void **)(void *)((char *)target + row->offset);
        size_t n = row->type == SETTING_ROWS ? *(size_t *)(void *)((char *)target + row->count) : 0;
        for (size_t i = 0; *at && i < n; i++)
            settings_free(row->table, (char *)*at + i * row->size);
        free(*at);
        *at = NULL;
    }
    if (table->also)
        settings_free(table->also, (char *)target + table->also_offset);
}

static void print_number(const struct setting *row, double value, FILE *out)
{
    const char *word;
    double meant;
    for (int k = 0; (word = word_at(row, k, &meant)) != NULL; k++)
        if (meant == value || (isnan(meant) && isnan(value))) {
            fputs(word, out);
            return;
        }
    fprintf(out, "%.15g", value);
}

static void print_entry(const struct setting *row, const char *at, size_t i, FILE *out)
{
    switch (row->type) {
    case SETTING_NUMBER:
        print_number(row, ((const double *)(const void *)at)[i], out);
        break;
    case SETTING_NUMBERS:
        print_number(row, (*(double *const *)(const void *)at)[i], out);
        break;
    case SETTING_COUNT:
        print_number(row, (double)((const size_t *)(const void *)at)[i], out);
        break;
    case SETTING_SEED:
        fprintf(out, "%llu", (unsigned long long)((const uint64_t *)(const void *)at)[i]);
        break;
    case SETTING_INTEGER:
    case SETTING_CHOICE:
        print_number(row, ((const int *)(const void *)at)[i], out);
        break;
    case SETTING_SWITCH:
        fputs(
            (row->size == sizeof(int) ? ((const int *)(const void *)at)[i] : ((const bool *)at)[i])
                ? "true"
                : "false",
            out);
        break;
    case SETTING_TEXT:
    case SETTING_FILE:
        if (((char *const *)(const void *)at)[i])
            fputs(((char *const *)(const void *)at)[i], out);
        break;
    default:
        break;
    }
}

char *settings_value(const struct setting *row, const void *target)
{
    char *text = NULL;
    size_t length, n = row->n_most ? row->n_most : row->type < SETTING_ROWS;
    FILE *out = open_memstream(&text, &length);
    if (!out)
        return NULL;
    if (row->count)
        n = *(const size_t *)(const void *)((const char *)target + row->count);
    for (size_t i = 0; i < n; i++) {
        fputs(i ? ", " : "", out);
        print_entry(row, (const char *)target + row->offset, i, out);
    }
    fclose(out);
    return text;
}

static bool print_file(const char *path, FILE *out)
{
    const char *slash = strrchr(path, '/');
    FILE *file = fopen(path, "rb");
    if (!file)
        return false;
    uint64_t hash = UINT64_C(0xcbf29ce484222325); /* FNV-1a */
    for (int byte; (byte = getc_unlocked(file)) != EOF;)
        hash = (hash ^ (unsigned char)byte) * UINT64_C(0x100000001b3);
    bool ok = !ferror(file);
    fclose(file);
    fprintf(out, " %s (%016" PRIx64 ")", slash ? slash + 1 : path, hash);
    return ok;
}

char *settings_text(const struct settings *table, const void *target)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    bool ok = out != NULL;
    for (size_t r = 0; ok && r < table->n; r++) {
        const struct setting *row = &table->rows[r];
        if (!row->key || row->type == SETTING_ROWS)
            continue;
        char *value = settings_value(row, target);
        ok = value != NULL;
        fprintf(out, "%s =", row->key);
        if (ok && *value && row->type == SETTING_FILE)
            ok = print_file(value, out);
        else if (ok && *value)
            fprintf(out, " %s", value);
        fputc('\n', out);
        free(value);
    }
    if (out && (fclose(out) != 0 || !ok)) {
        free(text);
        return NULL;
    }
    return text;
}

/* What stands for the value in the help. */
static const char *value_name(const struct setting *row)
{
    switch (row->type) {
    case SETTING_NUMBER:
        return row->n_most > 1 ? "X,Y,..." : "X";
    case SETTING_NUMBERS:
        return "X,Y,...";
    case SETTING_COUNT:
    case SETTING_INTEGER:
    case SETTING_SEED:
        return row->n_most > 1 ? "N,M,..." : "N";
    case SETTING_CHOICE:
        return "NAME";
    case SETTING_TEXT:
        return "TEXT";
    case SETTING_FILE:
        return "FILE";
    default:
        return "";
    }
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

static void print_help_row(const struct setting *row, const void *target, bool keys, FILE *out)
{
    char name[80], meaning[800], *value = settings_value(row, target);
    FILE *text = fmemopen(meaning, sizeof meaning, "w");
    if (keys)
        snprintf(name, sizeof name, "%s", row->key);
    else
        snprintf(name, sizeof name, "%.1s%.1s%s--%s %s", row->letter ? "-" : "", &row->letter,
                 row->letter ? ", " : "", row->option, value_name(row));
    if (text && value) {
        fputs(row->sentence, text);
        if (row->least != 0 || row->most != 0 || row->words || row->choice) {
            fputs("; ", text);
            settings_print_expected(row, text);
        }
        if (*value && row->type != SETTING_SWITCH)
            fprintf(text, " (default %s)", value);
        fclose(text);
        int width = fprintf(out, "  %-*s", HELP_COLUMN - 3, name);
        if (width >= HELP_COLUMN)
            fprintf(out, "\n%*s", HELP_COLUMN - 1, "");
        fputc(' ', out);
        wrap(meaning, HELP_COLUMN, out);
    }
    free(value);
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
    if (table->also)
        settings_help(table->also, (const char *)target + table->also_offset, keys, out);
}

size_t settings_distance(const char *a, const char *b)
{
    size_t row[128], n = strlen(b);
    if (n >= sizeof row / sizeof *row)
        return SIZE_MAX;
    for (size_t j = 0; j <= n; j++)
        row[j] = j;
    for (size_t i = 1; a[i - 1]; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= n; j++) {
            size_t replace = diagonal + (a[i - 1] != b[j - 1]);
            size_t edit = 1 + (row[j] < row[j - 1] ? row[j] : row[j - 1]);
            diagonal = row[j];
            row[j] = replace < edit ? replace : edit;
        }
    }
    return row[n];
}

bool settings_close(struct settings_source *source, char **sentences)
{
    bool ok = source->n == 0;
    size_t length;
    FILE *out = sentences ? open_memstream(sentences, &length) : NULL;
    for (size_t i = 0; i < source->n; i++) {
        char place[32] = "";
        if (source->complaints[i].line)
            snprintf(place, sizeof place, ":%zu", source->complaints[i].line);
        if (out)
            fprintf(out, "%s%s%s: %s", i ? "\n" : "", source->path, place,
                    source->complaints[i].text);
        else if (!source->path)
            cli_usage("%s", source->complaints[i].text);
        else
            cli_fail("%s%s: %s", source->path, place, source->complaints[i].text);
        free(source->complaints[i].text);
    }
    free(source->complaints);
    if (out)
        fclose(out);
    return ok;
}
