#include "cli.h"
#include "settings_internal.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* What every command takes; its target is an int. */
static const struct setting STANDARD[] = {
    {.option = "threads",
     .type = SETTING_INTEGER,
     .least = 1,
     .most = 4096,
     .sentence = "threads to use; by default all cores"},
    {.option = "help", .type = SETTING_HEADING, .sentence = "print this"},
    {.option = "version", .type = SETTING_HEADING, .sentence = "print the version"},
};
static const struct settings STANDARDS = {.n = 3, .rows = STANDARD};

static bool is_operand(const struct setting *row)
{
    return row->option && isupper((unsigned char)*row->option);
}

static const char *without_no(const char *name, bool *no)
{
    *no = strncmp(name, "no-", 3) == 0;
    return name + (*no ? 3 : 0);
}

/* Where an option leads: its row and what the row's offset counts from. */
struct found {
    const struct setting *row;
    char *target;
    size_t candidates; /* rows whose name begins like that; an exact one is the only */
    bool no;           /* given as --no-x */
};

static void find_option(const struct settings *table, void *target, const char *name,
                        struct found *found)
{
    for (size_t r = 0; r < table->n; r++) {
        const struct setting *row = &table->rows[r];
        if (!row->option || is_operand(row))
            continue;
        bool no, own_no = false, one = row->letter && name[0] == row->letter && !name[1];
        const char *own = row->option, *given = name;
        if (row->type == SETTING_SWITCH) {
            own = without_no(row->option, &own_no);
            given = without_no(name, &no);
        } else {
            no = false;
        }
        one = one || strcmp(own, given) == 0;
        if (!one && strncmp(own, given, strlen(given)) != 0)
            continue;
        *found = (struct found){row, target, one ? 1 : found->candidates + 1, no};
        if (one)
            return;
    }
    if (table->also)
        find_option(table->also, (char *)target + table->also_offset, name, found);
}

static const char *nearest_option(const struct settings *table, const char *name, const char *best,
                                  size_t least)
{
    for (size_t r = 0; r < table->n; r++) {
        const struct setting *row = &table->rows[r];
        size_t d = row->option && !is_operand(row) ? settings_distance(name, row->option) : least;
        if (d < least) {
            least = d;
            best = row->option;
        }
    }
    return table->also ? nearest_option(table->also, name, best, least) : best;
}

/* A command line as far as it is read. */
struct command_line {
    struct settings_source *source;
    const struct settings *table;
    void *target;
    int argc, at;
    char **argv;
    bool operands_only; /* after "--" */
    size_t n_words, n_operands, n_given;
    char **words;                 /* NULL: none are expected */
    const struct setting **given; /* rows that were */
    int threads;
};

static void read_option(struct command_line *line, const char *name, const char *value)
{
    struct found found = {.row = NULL};
    find_option(line->table, line->target, name, &found);
    if (found.candidates != 1 || strcmp(found.row->option, name) != 0) {
        struct found standard = {.row = NULL};
        find_option(&STANDARDS, &line->threads, name, &standard);
        if (standard.candidates == 1 && (found.candidates != 1))
            found = standard;
    }
    if (found.candidates != 1) {
        const char *near = nearest_option(line->table, name, NULL, 1 + strlen(name) / 3);
        settings_add(line->source, 0, "there is no option '--%s'%s%s%s", name,
                     near ? "; did you mean '--" : "", near ? near : "", near ? "'?" : "");
        return;
    }
    char shown[80];
    snprintf(shown, sizeof shown, "--%s", found.row->option);
    line->given[line->n_given++] = found.row;
    if (found.row->type == SETTING_SWITCH) {
        if (value)
            settings_add(line->source, 0, "%s takes no value, '%s' is one", shown, value);
        settings_set_text(line->source, found.row, 0, shown, found.no ? "false" : "true",
                          found.target);
        return;
    }
    if (!value && line->at + 1 < line->argc)
        value = line->argv[++line->at];
    if (value)
        settings_set_text(line->source, found.row, 0, shown, value, found.target);
    else
        settings_add(line->source, 0, "%s needs a value", shown);
}

static const struct setting *operand_row(const struct settings *table, size_t k)
{
    for (size_t r = 0; r < table->n; r++)
        if (is_operand(&table->rows[r]) && k-- == 0)
            return &table->rows[r];
    return NULL;
}

static void read_word(struct command_line *line, char *word)
{
    const struct setting *row = operand_row(line->table, line->n_operands);
    if (row) {
        line->n_operands++;
        line->given[line->n_given++] = row;
        settings_set_text(line->source, row, 0, row->option, word, line->target);
    } else if (line->words) {
        line->words[line->n_words++] = word;
    } else {
        settings_add(line->source, 0, "'%.100s' is a word too many", word);
    }
}

static void read_argument(struct command_line *line)
{
    char *word = line->argv[line->at], *equals = strchr(word, '=');
    double number;
    if (line->operands_only || *word != '-' || !word[1] || cli_parse_double(word, &number)) {
        read_word(line, word);
    } else if (strcmp(word, "--") == 0) {
        line->operands_only = true;
    } else if (word[1] == '-') {
        char name[80];
        snprintf(name, sizeof name, "%.*s", equals ? (int)(equals - word) - 2 : 79, word + 2);
        read_option(line, name, equals ? equals + 1 : NULL);
    } else {
        char name[2] = {word[1]};
        read_option(line, name, word[2] ? word + 2 : NULL);
    }
}

static void check_required(struct command_line *line)
{
    for (size_t r = 0; r < line->table->n; r++) {
        const struct setting *row = &line->table->rows[r];
        bool missing = row->required && row->option && !row->key;
        for (size_t k = 0; k < line->n_given && missing; k++)
            missing = line->given[k] != row;
        if (missing)
            settings_add(line->source, 0, "%s%s is missing: %s", is_operand(row) ? "" : "--",
                         row->option, row->sentence);
    }
}

static int print_help(const struct settings *table, const void *target)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    if (!out)
        return cli_fail("out of memory");
    fputs(table->usage ? table->usage : "", out);
    settings_help(table, target, false, out);
    settings_help(&STANDARDS, &(int){0}, false, out);
    fputs("\nExit status: 0 success, 1 failure, 2 wrong usage.\n", out);
    fclose(out);
    int code = cli_print(text);
    free(text);
    return code;
}

int settings_options(int argc, char **argv, const struct settings *table, void *target,
                     size_t *n_words, char **words)
{
    struct settings_source source = {.table = table, .prefix = ""};
    struct command_line line = {.source = &source,
                                .table = table,
                                .target = target,
                                .argc = argc,
                                .argv = argv,
                                .words = words,
                                .given = calloc((size_t)argc + 1, sizeof *line.given)};
    if (!line.given)
        return cli_fail("out of memory");
    int code = -1;
    for (int i = 1; i < argc && code < 0 && strcmp(argv[i], "--") != 0; i++)
        if (strcmp(argv[i], "--help") == 0)
            code = print_help(table, target);
        else if (strcmp(argv[i], "--version") == 0)
            code = cli_version();
    for (line.at = 1; line.at < argc && code < 0; line.at++)
        read_argument(&line);
    if (code < 0)
        check_required(&line);
    if (code < 0 && !source.n && table->check)
        table->check(&source, target);
    if (line.threads > 0)
        cli_set_threads(line.threads);
    if (n_words)
        *n_words = line.n_words;
    free(line.given);
    return settings_close(&source, NULL) ? code : CLI_USAGE;
}
