#include "cli.h"
#include "settings_internal.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

/* A file of settings is written by hand. libyaml compares each anchor with all before it, as keys
 * are compared here. */
enum { MOST_BYTES = 4 << 20, MOST_ANCHORS = 10000, MOST_KEYS = 1000 };

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

struct input {
    FILE *stream;
    size_t left, anchors;
};

static int read_bytes(void *user_data, unsigned char *buffer, size_t size, size_t *n)
{
    struct input *input = user_data;
    *n = fread(buffer, 1, size < input->left ? size : input->left, input->stream);
    input->left -= *n;
    for (size_t i = 0; i < *n; i++)
        input->anchors += buffer[i] == '&';
    return input->left > 0 && input->anchors <= MOST_ANCHORS && !ferror(input->stream);
}

static void complain_syntax(struct settings_source *source, const yaml_parser_t *parser,
                            const struct input *input)
{
    const char *said = "something that is not YAML", *problem = parser->problem;
    for (size_t i = 0; problem && i < sizeof SYNTAX / sizeof *SYNTAX; i++)
        if (strstr(problem, SYNTAX[i][0]))
            said = SYNTAX[i][1];
    if (ferror(input->stream))
        settings_add(source, 0, "", "%s", strerror(errno));
    else if (!input->left)
        settings_add(source, 0, "", "is longer than %d bytes, and no file of settings",
                     (int)MOST_BYTES);
    else if (input->anchors > MOST_ANCHORS)
        settings_add(source, 0, "", "has more than %d '&', and is no file of settings",
                     (int)MOST_ANCHORS);
    else if (parser->error == YAML_READER_ERROR)
        settings_add(source, 0, "", "holds bytes that are not UTF-8 text, from byte %zu on",
                     parser->problem_offset);
    else if (parser->error == YAML_MEMORY_ERROR || !parser->problem)
        settings_add(source, 0, "", "out of memory");
    else
        settings_add(source, parser->problem_mark.line + 1, "", "has %s (column %zu)", said,
                     parser->problem_mark.column + 1);
}

/* False after a complaint; the document is then empty. */
static bool load(struct settings_source *source, yaml_document_t *document)
{
    yaml_parser_t parser;
    struct input input = {fopen(source->path, "rb"), MOST_BYTES, 0};
    if (!input.stream || !yaml_parser_initialize(&parser)) {
        settings_add(source, 0, "", "%s", strerror(input.stream ? ENOMEM : errno));
        if (input.stream)
            fclose(input.stream);
        return false;
    }
    yaml_parser_set_input(&parser, read_bytes, &input);
    bool ok = yaml_parser_load(&parser, document);
    if (!ok)
        complain_syntax(source, &parser, &input);
    else if (!yaml_document_get_root_node(document))
        settings_add(source, 0, "", "is empty");
    yaml_parser_delete(&parser);
    fclose(input.stream);
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

/* A list or a mapping stands where something else is expected, or a text where one of them is. */
static void complain_form(struct settings_source *source, const yaml_node_t *node, size_t line,
                          const char *key, const struct setting *row)
{
    static const char *const forms[] = {
        [YAML_MAPPING_NODE] = "mapping", [YAML_SEQUENCE_NODE] = "list"};
    bool text = scalar(node) != NULL;
    settings_refuse(source, line, key, row, text ? "is '%.100s'" : "is a %s",
                    text ? scalar(node) : forms[node->type]);
}

static void read_table(struct settings_source *source, const struct settings *table,
                       const yaml_node_t *node, const char *prefix, void *target);

static void read_rows(struct settings_source *source, const struct setting *row,
                      const yaml_node_t *node, const char *key, char *target)
{
    char name[380], **at = (char **)(void *)(target + row->offset);
    const yaml_node_item_t *items = node->data.sequence.items.start;
    size_t n = (size_t)(node->data.sequence.items.top - items);
    *at = cli_needed(calloc(n + 1, row->size));
    *(size_t *)(void *)(target + row->count) = n;
    for (size_t i = 0; i < n; i++) {
        const yaml_node_t *entry = node_at(source, items[i]);
        snprintf(name, sizeof name, "%s%s%s.%zu", source->prefix, *source->prefix ? "." : "", key,
                 i + 1);
        settings_start(row->table, *at + i * row->size);
        read_table(source, row->table, entry, name, *at + i * row->size);
    }
}

static void read_value(struct settings_source *source, const struct setting *row,
                       const yaml_node_t *node, size_t line, void *target)
{
    bool list = node->type == YAML_SEQUENCE_NODE, rows = row->type == SETTING_ROWS;
    bool many = row->n_most || row->type == SETTING_NUMBERS || rows, ok = true;
    if (is_null(node))
        return;
    if (list ? !many : rows || !scalar(node)) {
        complain_form(source, node, line, row->key, row);
        return;
    }
    const yaml_node_item_t *items = list ? node->data.sequence.items.start : NULL;
    size_t n = list ? (size_t)(node->data.sequence.items.top - items) : 1;
    if (list && row->n_most && (n < row->n_least || n > row->n_most)) {
        settings_refuse(source, line, row->key, row, "has %zu %s", n, n == 1 ? "entry" : "entries");
    } else if (rows) {
        read_rows(source, row, node, row->key, target);
    } else {
        char **texts = cli_needed(calloc(n + 1, sizeof *texts));
        for (size_t i = 0; ok && i < n; i++) {
            const yaml_node_t *entry = list ? node_at(source, items[i]) : node;
            ok = (texts[i] = (char *)scalar(entry)) != NULL;
            if (!ok)
                complain_form(source, entry, line_of(entry), row->key, row);
        }
        if (ok)
            settings_set(source, row, line, row->key, n, texts, target);
        free(texts);
    }
}

/* The nearest key, or section of keys, when it is near. */
static void complain_unknown(struct settings_source *source, const struct settings *table,
                             const char *key, size_t line)
{
    char near[80] = "", name[80];
    size_t least = 1 + strlen(key) / 3, dots = 0;
    for (const char *c = key; *c; c++)
        dots += *c == '.';
    for (size_t r = 0; r < table->n; r++) {
        const char *known = table->rows[r].key ? table->rows[r].key : "", *end = known;
        for (size_t k = 0; end && k <= dots; k++)
            end = strchr(end + (k > 0), '.');
        snprintf(name, sizeof name, "%.*s", end ? (int)(end - known) : 79, known);
        if (settings_nearer(key, name, &least))
            strcpy(near, name);
    }
    settings_add(source, line, key, "is no setting%s%s%s", *near ? "; did you mean '" : "", near,
                 *near ? "'?" : "");
}

/* Each key is a setting, a section of settings, or a mistake. */
static void read_mapping(struct settings_source *source, const struct settings *table,
                         const yaml_node_t *node, const char *section, void *target)
{
    size_t keys = (size_t)(node->data.mapping.pairs.top - node->data.mapping.pairs.start);
    if (keys > MOST_KEYS) {
        settings_add(source, line_of(node), section, "has %zu keys, more than any settings have",
                     keys);
        return;
    }
    for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top;
         p++) {
        const yaml_node_t *key = node_at(source, p->key), *value = node_at(source, p->value);
        char full[160];
        size_t line = line_of(key), before, r = 0;
        const char *name = scalar(key), *known = NULL;
        if (!name || strchr(name, '.')) {
            settings_add(source, line, name ? name : "a list or mapping",
                         "is no key; sections are mappings in mappings");
            continue;
        }
        size_t n =
            (size_t)snprintf(full, sizeof full, "%s%s%s", section, *section ? "." : "", name);
        for (; r < table->n; r++)
            if ((known = table->rows[r].key) && strncmp(known, full, n) == 0 &&
                (!known[n] || known[n] == '.'))
                break;
        if (find(source, node, name, &before) != value)
            settings_add(source, line, full, "is given twice, first on line %zu", before);
        else if (r == table->n)
            complain_unknown(source, table, full, line);
        else if (!known[n])
            read_value(source, &table->rows[r], value, line, target);
        else if (value->type == YAML_MAPPING_NODE)
            read_mapping(source, table, value, full, target);
        else if (!is_null(value))
            complain_form(source, value, line, full, NULL);
    }
}

static void read_table(struct settings_source *source, const struct settings *table,
                       const yaml_node_t *node, const char *prefix, void *target)
{
    struct settings_source outer = *source;
    size_t line = line_of(node);
    source->node = node;
    source->prefix = prefix;
    if (node->type == YAML_MAPPING_NODE)
        read_mapping(source, table, node, "", target);
    else
        complain_form(source, node, line, "", NULL);
    for (size_t r = 0; node->type == YAML_MAPPING_NODE && r < table->n; r++) {
        const struct setting *row = &table->rows[r];
        const yaml_node_t *value =
            row->required && row->key ? find(source, node, row->key, &line) : node;
        if (!value || is_null(value))
            settings_add(source, *prefix ? line_of(node) : 0, row->key, "is missing: %s",
                         row->sentence);
    }
    if (table->check && source->n == outer.n)
        table->check(source, target);
    source->node = outer.node;
    source->prefix = outer.prefix;
}

void settings_complain(struct settings_source *source, const char *key, const char *format, ...)
{
    char text[512];
    size_t line = line_of(source->node);
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    const char *dot = strrchr(key, '.');
    if (source->path)
        find(source, source->node, key, &line);
    if (source->path)
        settings_add(source, line, key, "%s", text);
    else
        settings_add(source, 0, "", "--%s %s", dot ? dot + 1 : key, text);
}

bool settings_read(const char *path, const struct settings *table, void *target)
{
    yaml_document_t document;
    struct settings_source source = {.path = path, .document = &document, .prefix = ""};
    if (load(&source, &document)) {
        const yaml_node_t *root = yaml_document_get_root_node(&document);
        if (root)
            read_table(&source, table, root, "", target);
        yaml_document_delete(&document);
    }
    return settings_close(&source);
}
