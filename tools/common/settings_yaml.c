#include "cli.h"
#include "settings_internal.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

/* libyaml's phrases are about its states; ours about what to mend. */
static const char *const SYNTAX[][2] = {
    {"cannot start any token",
     "a tab or one of @ ` % begins a word; indent by spaces, quote words"},
    {"mapping values are not allowed", "a ':' where no key can stand; is the line above complete?"},
    {"expected key",
     "a line that belongs to nothing above it; is it indented like its neighbours?"},
    {"expected '-' indicator", "a line that is no entry of the list above it"},
    {"could not find expected ':'", "a key without ':' after it"},
    {"unexpected end of stream", "a quotation that does not end"},
    {"',' or ']'", "a list whose '[' is not closed"},
    {"',' or '}'", "a mapping whose '{' is not closed"},
    {"undefined alias", "an '*' that refers to no '&'"},
    {"unexpected document", "a '---' or '...' inside of the text"},
    {"duplicate", "an '&' with a name that is taken"},
};

static void complain_syntax(struct settings_source *source, const yaml_parser_t *parser)
{
    const char *said = "something that is not YAML", *problem = parser->problem;
    if (parser->error == YAML_READER_ERROR) {
        settings_add(source, 0, "holds bytes that are not UTF-8 text, from byte %zu on",
                     parser->problem_offset);
        return;
    }
    if (parser->error == YAML_MEMORY_ERROR)
        said = "more than the memory can hold";
    for (size_t i = 0; problem && i < sizeof SYNTAX / sizeof *SYNTAX; i++)
        if (strstr(problem, SYNTAX[i][0]))
            said = SYNTAX[i][1];
    settings_add(source, parser->problem_mark.line + 1, "has %s (column %zu)", said,
                 parser->problem_mark.column + 1);
}

/* False after a complaint; the document is then empty. */
static bool load(struct settings_source *source, yaml_document_t *document)
{
    yaml_parser_t parser;
    FILE *stream = fopen(source->path, "rb");
    int first = stream ? fgetc(stream) : EOF;
    if (!stream || (first == EOF && ferror(stream)) || !yaml_parser_initialize(&parser)) {
        settings_add(source, 0, "%s", strerror(errno));
        if (stream)
            fclose(stream);
        return false;
    }
    rewind(stream);
    yaml_parser_set_input_file(&parser, stream);
    bool ok = yaml_parser_load(&parser, document);
    if (!ok)
        complain_syntax(source, &parser);
    else if (!yaml_document_get_root_node(document))
        settings_add(source, 0, "is empty");
    yaml_parser_delete(&parser);
    fclose(stream);
    return ok;
}

static const char *scalar(const yaml_node_t *node)
{
    return node && node->type == YAML_SCALAR_NODE ? (const char *)node->data.scalar.value : NULL;
}

static bool is_null(const yaml_node_t *node)
{
    const char *text = scalar(node);
    return text && node->data.scalar.style == YAML_PLAIN_SCALAR_STYLE &&
           (!*text || strcmp(text, "~") == 0 || strcmp(text, "null") == 0);
}

static size_t line_of(const yaml_node_t *node)
{
    return node ? node->start_mark.line + 1 : 0;
}

static yaml_node_t *node_at(struct settings_source *source, int index)
{
    return yaml_document_get_node(source->document, index);
}

/* What stands at "objective.command" below a mapping, and the line of its key; NULL: nothing. */
static const yaml_node_t *find(struct settings_source *source, const yaml_node_t *node,
                               const char *key, size_t *line)
{
    size_t length = strcspn(key, ".");
    if (!node || node->type != YAML_MAPPING_NODE)
        return NULL;
    for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top;
         p++) {
        const char *name = scalar(node_at(source, p->key));
        if (!name || strlen(name) != length || strncmp(name, key, length) != 0)
            continue;
        *line = line_of(node_at(source, p->key));
        const yaml_node_t *value = node_at(source, p->value);
        return key[length] ? find(source, value, key + length + 1, line) : value;
    }
    return NULL;
}

static const char *form(const yaml_node_t *node)
{
    return node->type == YAML_MAPPING_NODE ? "mapping" : "list";
}

static void complain_form(struct settings_source *source, const yaml_node_t *node, size_t line,
                          const char *name, const struct setting *row)
{
    char expected[400] = "a mapping of settings";
    FILE *out = row ? fmemopen(expected, sizeof expected, "w") : NULL;
    if (out) {
        settings_print_expected(row, out);
        fclose(out);
    }
    if (scalar(node))
        settings_add(source, line, "%s is '%.100s', expected %s", name, scalar(node), expected);
    else
        settings_add(source, line, "%s is a %s, expected %s", name, form(node), expected);
}

static void read_table(struct settings_source *source, const struct settings *table,
                       const yaml_node_t *node, const char *prefix, void *target);

static void read_rows(struct settings_source *source, const struct setting *row,
                      const yaml_node_t *node, size_t line, const char *name, char *target)
{
    char element[380], **at = (char **)(void *)(target + row->offset);
    if (node->type != YAML_SEQUENCE_NODE) {
        complain_form(source, node, line, name, row);
        return;
    }
    size_t n = (size_t)(node->data.sequence.items.top - node->data.sequence.items.start);
    if (n < row->n_least || (row->n_most && n > row->n_most))
        settings_add(source, line, "%s has %zu entries, expected %zu to %zu", name, n, row->n_least,
                     row->n_most);
    *at = calloc(n + 1, row->size);
    *(size_t *)(void *)(target + row->count) = *at ? n : 0;
    for (size_t i = 0; *at && i < n; i++) {
        const yaml_node_t *entry = node_at(source, node->data.sequence.items.start[i]);
        snprintf(element, sizeof element, "%s.%zu", name, i + 1);
        settings_start(row->table, *at + i * row->size);
        if (entry->type == YAML_MAPPING_NODE)
            read_table(source, row->table, entry, element, *at + i * row->size);
        else
            complain_form(source, entry, line_of(entry), element, NULL);
    }
}

static void read_value(struct settings_source *source, const struct setting *row,
                       const yaml_node_t *node, size_t line, const char *name, void *target)
{
    bool many = row->n_most || row->type == SETTING_NUMBERS;
    if (is_null(node))
        return;
    if (row->type == SETTING_ROWS) {
        read_rows(source, row, node, line, name, target);
        return;
    }
    if (node->type == YAML_MAPPING_NODE || (node->type == YAML_SEQUENCE_NODE && !many)) {
        complain_form(source, node, line, name, row);
        return;
    }
    char *one = (char *)node->data.scalar.value, **texts = &one;
    size_t n = 1;
    if (node->type == YAML_SEQUENCE_NODE) {
        n = (size_t)(node->data.sequence.items.top - node->data.sequence.items.start);
        texts = calloc(n + 1, sizeof *texts);
    }
    for (size_t i = 0; texts && texts != &one && i < n; i++) {
        const yaml_node_t *entry = node_at(source, node->data.sequence.items.start[i]);
        texts[i] = (char *)(scalar(entry) ? scalar(entry) : form(entry));
    }
    if (texts)
        settings_set(source, row, line, name, n, texts, target);
    if (texts != &one)
        free(texts);
}

/* The nearest key, or section of keys, when it is near: a third of the letters may differ. */
static bool nearest(const struct settings *table, const char *key, char best[80])
{
    size_t least = 1 + strlen(key) / 3, dots = 0;
    for (const char *c = key; *c; c++)
        dots += *c == '.';
    *best = '\0';
    for (size_t r = 0; r < table->n; r++) {
        const char *known = table->rows[r].key, *end = known;
        char name[80];
        for (size_t k = 0; end && k <= dots; k++)
            end = strchr(end + (k > 0), '.');
        snprintf(name, sizeof name, "%.*s", end ? (int)(end - known) : 79, known ? known : "");
        size_t d = settings_distance(key, name);
        if (d < least) {
            least = d;
            strcpy(best, name);
        }
    }
    return *best;
}

/* One key of a mapping: a setting, a section of settings, or a mistake. */
static void read_pair(struct settings_source *source, const struct settings *table,
                      const yaml_node_t *value, size_t line, const char *key, void *target);

static void read_mapping(struct settings_source *source, const struct settings *table,
                         const yaml_node_t *node, const char *section, void *target)
{
    yaml_node_pair_t *first = node->data.mapping.pairs.start;
    for (yaml_node_pair_t *p = first; p < node->data.mapping.pairs.top; p++) {
        const yaml_node_t *key = node_at(source, p->key);
        char full[160];
        size_t line = line_of(key), before;
        if (!scalar(key) || strchr(scalar(key), '.')) {
            settings_add(source, line, "'%.100s' is no key; sections are mappings in mappings",
                         scalar(key) ? scalar(key) : form(key));
            continue;
        }
        snprintf(full, sizeof full, "%s%s%s", section, *section ? "." : "", scalar(key));
        if (find(source, node, scalar(key), &before) != node_at(source, p->value))
            settings_add(source, line, "%s%s%s is given twice, first on line %zu", source->prefix,
                         *source->prefix ? "." : "", full, before);
        else
            read_pair(source, table, node_at(source, p->value), line, full, target);
    }
}

static void read_pair(struct settings_source *source, const struct settings *table,
                      const yaml_node_t *value, size_t line, const char *key, void *target)
{
    size_t length = strlen(key);
    char name[340];
    snprintf(name, sizeof name, "%s%s%s", source->prefix, *source->prefix ? "." : "", key);
    for (size_t r = 0; r < table->n; r++) {
        const char *known = table->rows[r].key;
        if (!known || strncmp(known, key, length) != 0)
            continue;
        if (!known[length]) {
            read_value(source, &table->rows[r], value, line, name, target);
            return;
        }
        if (known[length] != '.')
            continue;
        if (value->type == YAML_MAPPING_NODE)
            read_mapping(source, table, value, key, target);
        else if (!is_null(value))
            complain_form(source, value, line, name, NULL);
        return;
    }
    char near[80];
    bool found = nearest(table, key, near);
    settings_add(source, line, "there is no setting '%s'%s%s%s", name,
                 found ? "; did you mean '" : "", near, found ? "'?" : "");
}

static void read_table(struct settings_source *source, const struct settings *table,
                       const yaml_node_t *node, const char *prefix, void *target)
{
    struct settings_source outer = *source;
    size_t line = line_of(node);
    source->node = node;
    source->prefix = prefix;
    read_mapping(source, table, node, "", target);
    for (size_t r = 0; r < table->n; r++) {
        const struct setting *row = &table->rows[r];
        const yaml_node_t *value =
            row->required && row->key ? find(source, node, row->key, &line) : node;
        if (!value || is_null(value))
            settings_add(source, *prefix ? line_of(node) : 0, "%s%s%s is missing: %s", prefix,
                         *prefix ? "." : "", row->key, row->sentence);
    }
    if (table->check && source->n == outer.n)
        table->check(source, target);
    source->node = outer.node;
    source->prefix = outer.prefix;
}

void settings_complain(struct settings_source *source, const char *key, const char *format, ...)
{
    char text[512];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    if (!source->path) {
        for (size_t r = 0; r < source->table->n; r++) {
            const struct setting *row = &source->table->rows[r];
            if (row->key && row->option && strcmp(row->key, key) == 0)
                key = row->option;
        }
        settings_add(source, 0, "--%s %s", key, text);
        return;
    }
    size_t line = line_of(source->node);
    find(source, source->node, key, &line);
    settings_add(source, line, "%s%s%s%s%s", source->prefix, *source->prefix && *key ? "." : "",
                 key, *key || *source->prefix ? " " : "", text);
}

bool settings_read(const char *path, const struct settings *table, void *target, char **sentences)
{
    yaml_document_t document;
    struct settings_source source = {.path = path, .document = &document, .prefix = ""};
    if (!load(&source, &document))
        return settings_close(&source, sentences);
    const yaml_node_t *root = yaml_document_get_root_node(&document);
    if (root && root->type == YAML_MAPPING_NODE)
        read_table(&source, table, root, "", target);
    else if (root)
        settings_add(&source, line_of(root), "expected a mapping of settings, 'key: value'");
    yaml_document_delete(&document);
    return settings_close(&source, sentences);
}

size_t settings_line(const char *path, const char *key)
{
    yaml_document_t document;
    struct settings_source source = {.path = path, .document = &document, .prefix = ""};
    size_t line = 0;
    if (load(&source, &document)) {
        find(&source, yaml_document_get_root_node(&document), key, &line);
        yaml_document_delete(&document);
    }
    for (size_t i = 0; i < source.n; i++)
        free(source.complaints[i].text);
    free(source.complaints);
    return line;
}
