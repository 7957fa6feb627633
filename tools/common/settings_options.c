#include "cli.h"
#include "settings_internal.h"
#include "text.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* What every command takes; its target is an int. */
static const struct setting_word ALL_CORES[] = {{"all cores", 0}, {NULL, 0}};
static const struct setting STANDARD[] = {
    {.option = "threads",
     .type = SETTING_INTEGER,
     .least = 1,
     .most = 4096,
     .words = ALL_CORES,
     .sentence = "threads to use"},
    {.option = "help", .type = SETTING_HEADING, .sentence = "print this"},
    {.option = "version", .type = SETTING_HEADING, .sentence = "print the version"},
};
static const struct settings STANDARDS = {.n = 3, .rows = STANDARD};

enum { MOST = 200 };

/* A command line as far as it is read, and the rows it can set. */
struct command_line {
    struct settings_source *source;
    int argc, at;
    char **argv, **words; /* words NULL: none are expected */
    size_t n_words, n;
    struct place {
        const struct setting *row;
        char *target; /* of its offset */
        bool given;
    } places[MOST];
};

static bool is_operand(const struct setting *row)
{
    return isupper((unsigned char)*row->option);
}

static void add_rows(struct command_line *line, const struct settings *table, void *target)
{
    for (size_t r = 0; r < table->n && line->n < MOST; r++)
        if (table->rows[r].option && table->rows[r].type != SETTING_HEADING)
            line->places[line->n++] = (struct place){&table->rows[r], target, false};
}

static const char *without_no(const char *name)
{
    return name + (strncmp(name, "no-", 3) == 0 ? 3 : 0);
}

/* The option of a name, of its letter, or the only one that begins like that; NULL: there is none.
 */
static struct place *find_option(struct command_line *line, const char *name)
{
    struct place *found = NULL;
    size_t candidates = 0;
    for (size_t k = 0; k < line->n; k++) {
        const struct setting *row = line->places[k].row;
        bool turns = row->type == SETTING_SWITCH,
             letter = row->letter && row->letter == name[0] && !name[1];
        const char *own = turns ? without_no(row->option) : row->option;
        const char *given = turns ? without_no(name) : name;
        if (letter || strcmp(own, given) == 0)
            return &line->places[k];
        if (is_operand(row) || strncmp(own, given, strlen(given)) != 0)
            continue;
        found = &line->places[k];
        candidates++;
    }
    return candidates == 1 ? found : NULL;
}

static void complain_unknown(struct command_line *line, const char *name)
{
    const char *near = "";
    size_t least = 1 + strlen(name) / 3;
    for (size_t k = 0; k < line->n; k++)
        if (!is_operand(line->places[k].row) &&
            settings_nearer(name, line->places[k].row->option, &least))
            near = line->places[k].row->option;
    settings_add(line->source, 0, "", "there is no option '--%s'%s%s%s", name,
                 *near ? "; did you mean '--" : "", near, *near ? "'?" : "");
}

static void read_option(struct command_line *line, const char *name, char *value)
{
    char shown[80];
    struct place *place = find_option(line, name);
    if (!place) {
        complain_unknown(line, name);
        return;
    }
    place->given = true;
    snprintf(shown, sizeof shown, "--%s", place->row->option);
    if (place->row->type == SETTING_SWITCH && value)
        settings_add(line->source, 0, shown, "takes no value, '%s' is one", value);
    else if (place->row->type == SETTING_SWITCH)
        value = without_no(name) == name ? "true" : "false";
    else if (!value && line->at + 1 < line->argc)
        value = line->argv[++line->at];
    if (value)
        settings_set_text(line->source, place->row, 0, shown, value, place->target);
    else
        settings_add(line->source, 0, shown, "needs a value");
}

/* A word without dashes: the next operand, or one of those beyond. */
static void read_word(struct command_line *line, char *word)
{
    for (size_t k = 0; k < line->n; k++) {
        struct place *place = &line->places[k];
        if (!is_operand(place->row) || place->given)
            continue;
        place->given = true;
        settings_set_text(line->source, place->row, 0, place->row->option, word, place->target);
        return;
    }
    if (line->words)
        line->words[line->n_words++] = word;
    else
        settings_add(line->source, 0, "", "'%.100s' is a word too many", word);
}

static void read_argument(struct command_line *line, bool *only_words)
{
    char *word = line->argv[line->at], *equals = strchr(word, '='), name[80];
    double number;
    if (*only_words || *word != '-' || !word[1] || cli_parse_double(word, &number)) {
        read_word(line, word);
    } else if (strcmp(word, "--") == 0) {
        *only_words = true;
    } else if (word[1] == '-') {
        snprintf(name, sizeof name, "%.*s", equals ? (int)(equals - word) - 2 : 79, word + 2);
        read_option(line, name, equals ? equals + 1 : NULL);
    } else {
        read_option(line, (char[2]){word[1]}, word[2] ? word + 2 : NULL);
    }
}

static int print_help(const struct settings *table, const void *target)
{
    char *text = NULL;
    size_t length;
    FILE *out = text_open(&text, &length);
    if (!out)
        return cli_fail("out of memory");
    fputs(table->usage ? table->usage : "", out);
    settings_help(table, target, false, out);
    settings_help(&STANDARDS, &(int){0}, false, out);
    fputs("\nExit status: 0 success, 1 failure, 2 wrong usage.\n", out);
    int code = cli_print(text_close(out, &text));
    free(text);
    return code;
}

int settings_options(int argc, char **argv, const struct settings *table, void *target,
                     size_t *n_words, char **words)
{
    int threads = 0;
    bool only_words = false;
    struct settings_source source = {.prefix = ""};
    struct command_line line = {
        .source = &source, .argc = argc, .argv = argv, .words = words, .at = 1};
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++)
        if (strcmp(argv[i], "--help") == 0)
            return print_help(table, target);
        else if (strcmp(argv[i], "--version") == 0)
            return cli_version();
    add_rows(&line, table, target);
    add_rows(&line, &STANDARDS, &threads);
    for (; line.at < argc; line.at++)
        read_argument(&line, &only_words);
    for (size_t k = 0; k < line.n; k++) {
        const struct place *place = &line.places[k];
        if (place->row->required && !place->row->key && !place->given)
            settings_add(&source, 0, "", "%s%s is missing: %s", is_operand(place->row) ? "" : "--",
                         place->row->option, place->row->sentence);
    }
    if (!source.n && table->check)
        table->check(&source, target);
    if (threads > 0)
        cli_set_threads(threads);
    if (n_words)
        *n_words = line.n_words;
    return settings_close(&source) ? -1 : CLI_USAGE;
}
