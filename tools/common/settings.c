#include "settings.h"

#include "cli.h"
#include "settings_internal.h"
#include "text.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_ENTRIES = 64 };              /* of an array in one text; no row has more */
static const off_t MOST_BYTES = 1 << 30; /* of a file that a setting names */

static const struct setting_word SWITCH[] = {{"true", 1}, {"false", 0}, {"yes", 1}, {"no", 0},
                                             {"on", 1},   {"off", 0},   {NULL, 0}};

const char *settings_word(const struct setting *row, int k, double *value)
{
    const struct setting_word *words = row->type == SETTING_SWITCH ? SWITCH : row->words;
    *value = words ? words[k].value : k;
    return words ? words[k].name : row->choice ? row->choice(k) : NULL;
}

static bool find_word(const struct setting *row, const char *text, double *value)
{
    const char *word;
    for (int k = 0; (word = settings_word(row, k, value)) != NULL; k++)
        if (strcmp(word, text) == 0)
            return true;
    return false;
}

bool settings_has_range(const struct setting *row)
{
    return row->least != 0 || row->most != 0;
}

static bool inside(const struct setting *row, double value)
{
    return !settings_has_range(row) ||
           ((row->open_least ? value > row->least : value >= row->least) &&
            (row->open_most ? value < row->most : value <= row->most));
}

/* Paths of a file are relative to its folder. */
static char *resolve(const char *config, const char *path)
{
    const char *slash = config ? strrchr(config, '/') : NULL;
    size_t folder = slash && *path != '/' ? (size_t)(slash - config) + 1 : 0;
    char *joined = cli_needed(malloc(folder + strlen(path) + 1));
    strcpy((char *)memcpy(joined, config ? config : "", folder) + folder, path);
    return joined;
}

/* NULL, or what is wrong with a file that is to be read. */
static const char *refuse_file(const char *path)
{
    struct stat info;
    if (stat(path, &info) != 0 || access(path, R_OK) != 0)
        return strerror(errno);
    return !S_ISREG(info.st_mode)      ? "no regular file"
           : info.st_size > MOST_BYTES ? "more than 1 GiB"
                                       : NULL;
}

/* Stores a text as entry i; false when it is none of what is expected. */
static bool store(const struct setting *row, const char *text, size_t i, void *at, const char *path)
{
    double value;
    size_t count = 0;
    int integer = 0;
    bool word = find_word(row, text, &value), ok = word;
    switch (row->type) {
    case SETTING_NUMBER:
        ok = ok || (cli_parse_double(text, &value) && inside(row, value));
        if (ok)
            ((double *)at)[i] = value;
        return ok;
    case SETTING_COUNT:
        ok = ok || (cli_parse_size(text, &count) && inside(row, (double)count));
        if (ok)
            ((size_t *)at)[i] = word ? (size_t)value : count;
        return ok;
    case SETTING_INTEGER:
        ok = ok || (cli_parse_int(text, &integer) && inside(row, integer));
        /* fall through */
    case SETTING_CHOICE:
    case SETTING_SWITCH:
        integer = word ? (int)value : integer;
        if (ok && row->type == SETTING_SWITCH && row->size != sizeof(int))
            ((bool *)at)[i] = integer;
        else if (ok)
            ((int *)at)[i] = integer;
        return ok;
    default:
        free(((char **)at)[i]);
        ((char **)at)[i] =
            row->type == SETTING_FILE ? resolve(path, text) : cli_needed(strdup(text));
        return true;
    }
}

/* Of a list, however many ranges it has. */
enum { MOST_NUMBERS = 100000 };

/* Appends the numbers of a text, "0.2,0.3" or "0.2:0.3:0.05", to the list. */
static bool store_list(const struct setting *row, const char *text, double **list, size_t *n)
{
    double *part = NULL, *more = NULL;
    size_t m = 0;
    bool ok = cli_parse_list(text, &part, &m);
    ok = ok && *n + m <= MOST_NUMBERS;
    if (ok)
        more = cli_needed(realloc(*list, (*n + m) * sizeof *more));
    for (size_t i = 0; ok && i < m; i++) {
        *list = more;
        more[(*n)++] = part[i];
        ok = inside(row, part[i]);
    }
    free(part);
    return ok;
}

/* That are told of a file; the rest is counted. */
enum { MOST_COMPLAINTS = 100 };

void settings_add(struct settings_source *source, size_t line, const char *key, const char *format,
                  ...)
{
    if (source->n >= MOST_COMPLAINTS) {
        source->n++;
        return;
    }
    struct complaint *more =
        cli_needed(realloc(source->complaints, (source->n + 1) * sizeof *source->complaints));
    char *text = NULL;
    size_t length, i = source->n;
    FILE *out = cli_needed(text_open(&text, &length));
    source->complaints = more;
    fprintf(out, "%s%s%s%s", source->prefix, *source->prefix && *key ? "." : "", key,
            *source->prefix || *key ? " " : "");
    va_list args;
    va_start(args, format);
    vfprintf(out, format, args);
    va_end(args);
    cli_needed(text_close(out, &text));
    for (; i > 0 && more[i - 1].line > line; i--)
        more[i] = more[i - 1];
    more[i] = (struct complaint){line, text};
    source->n++;
}

void settings_refuse(struct settings_source *source, size_t line, const char *key,
                     const struct setting *row, const char *format, ...)
{
    char text[160], expected[400] = "";
    FILE *out = cli_needed(fmemopen(expected, sizeof expected, "w"));
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    settings_print_expected(row, out);
    fclose(out);
    settings_add(source, line, key, "%s, expected %s", text, expected);
}

bool settings_set(struct settings_source *source, const struct setting *row, size_t line,
                  const char *key, size_t n, char *const *texts, void *target)
{
    double value, *list = NULL;
    size_t i = 0, total = 0;
    char *at = (char *)target + row->offset;
    const char *wrong = NULL;
    bool fill = n == 1 && row->n_least > 1 && find_word(row, texts[0], &value), ok = true;
    n = fill ? row->n_least : n;
    if (row->type != SETTING_NUMBERS && (n < row->n_least || n > (row->n_most ? row->n_most : 1))) {
        if (source)
            settings_refuse(source, line, key, row, "has %zu %s", n, n == 1 ? "entry" : "entries");
        return false;
    }
    for (; ok && i < n; i += ok)
        ok = row->type == SETTING_NUMBERS
                 ? store_list(row, texts[i], &list, &total)
                 : store(row, texts[fill ? 0 : i], i, at, source ? source->path : NULL);
    if (row->type == SETTING_NUMBERS) {
        n = total;
        free(*(double **)(void *)at);
        *(double **)(void *)at = list;
    } else if (ok && row->type == SETTING_FILE && source && source->path) {
        wrong = refuse_file(*(char **)(void *)at);
    }
    if (!ok && source)
        settings_refuse(source, line, key, row, "is '%.100s'", texts[fill ? 0 : i]);
    else if (wrong)
        settings_add(source, line, key, "is '%.100s', which cannot be read: %s", texts[0], wrong);
    if (row->count)
        *(size_t *)(void *)((char *)target + row->count) = n;
    if (ok && row->given && source)
        *((bool *)target + row->given) = true;
    return ok;
}

bool settings_set_text(struct settings_source *source, const struct setting *row, size_t line,
                       const char *key, const char *text, void *target)
{
    bool whole = row->type == SETTING_COUNT || row->type == SETTING_INTEGER;
    char *copy = cli_needed(strdup(text)), *texts[MOST_ENTRIES] = {copy};
    size_t n = 1;
    for (char *at = copy; row->n_most && n < MOST_ENTRIES;) {
        if ((at = strpbrk(at, whole ? ",x:" : ",")) == NULL)
            break;
        *at++ = '\0';
        texts[n++] = at + strspn(at, " ");
    }
    bool ok = settings_set(source, row, line, key, n, texts, target);
    free(copy);
    return ok;
}

/* Pointers that a row owns in the target. */
static size_t count_pointers(const struct setting *row)
{
    bool texts = row->type == SETTING_TEXT || row->type == SETTING_FILE;
    return row->type < SETTING_TEXT ? 0 : texts && row->n_most ? row->n_most : 1;
}

void settings_start(const struct settings *table, void *target)
{
    for (size_t r = 0; r < table->n; r++) {
        const struct setting *row = &table->rows[r];
        for (size_t i = 0; i < count_pointers(row); i++)
            ((void **)(void *)((char *)target + row->offset))[i] = NULL;
        if (row->otherwise)
            settings_set_text(NULL, row, 0, "", row->otherwise, target);
    }
}

void settings_free(const struct settings *table, void *target)
{
    for (size_t r = 0; r < table->n; r++) {
        const struct setting *row = &table->rows[r];
        size_t pointers = count_pointers(row);
        if (!pointers)
            continue;
        void **at = (void **)(void *)((char *)target + row->offset);
        size_t n = row->type == SETTING_ROWS ? *(size_t *)(void *)((char *)target + row->count) : 0;
        for (size_t i = 0; *at && i < n; i++)
            settings_free(row->table, (char *)*at + i * row->size);
        for (size_t i = 0; i < pointers; i++) {
            free(at[i]);
            at[i] = NULL;
        }
    }
}

bool settings_nearer(const char *a, const char *b, size_t *least)
{
    size_t row[128], n = strlen(b);
    if (n >= sizeof row / sizeof *row)
        return false;
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
    bool nearer = row[n] < *least;
    *least = nearer ? row[n] : *least;
    return nearer;
}

bool settings_forget(struct settings_source *source)
{
    for (size_t i = 0; i < source->n && i < MOST_COMPLAINTS; i++)
        free(source->complaints[i].text);
    free(source->complaints);
    return source->n == 0;
}

bool settings_close(struct settings_source *source)
{
    size_t told = source->n < MOST_COMPLAINTS ? source->n : MOST_COMPLAINTS;
    for (size_t i = 0; i < told; i++) {
        const struct complaint *c = &source->complaints[i];
        if (!source->path)
            cli_usage("%s", c->text);
        else if (c->line)
            cli_fail("%s:%zu: %s", source->path, c->line, c->text);
        else
            cli_fail("%s: %s", source->path, c->text);
    }
    if (source->n > told)
        cli_fail("%s: %zu more of such", source->path ? source->path : "the command line",
                 source->n - told);
    return settings_forget(source);
}
