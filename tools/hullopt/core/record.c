#include "core/record.h"

#include "cli.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The one version of what the names below mean. 1: version 0.1.0, which kept tables of its own. */
enum { FORMAT = 3 };

static const char FORMAT_NAME[] = "hullopt.format", CONFIGURATION[] = "configuration",
                  SESSIONS[] = "sessions", VERIFICATION[] = "verification", SOLVER[] = "solver";

static bool done(bayesopt_status status)
{
    return status >= 0 || core_fail("%s", bayesopt_last_error());
}

bool record_put_text(struct record *record, const char *name, const char *text)
{
    return done(bayesopt_store_put_text(record->bo, name, text));
}

bool record_get_text(const struct record *record, const char *name, char **text)
{
    return done(bayesopt_store_get_text(record->bo, name, text));
}

bool record_put_array(struct record *record, const char *name, size_t rows, size_t columns,
                      const double *values)
{
    return done(bayesopt_store_put_array(record->bo, name, rows, columns, values));
}

bool record_get_array(const struct record *record, const char *name, size_t *rows, size_t *columns,
                      double **values)
{
    return done(bayesopt_store_get_array(record->bo, name, rows, columns, values));
}

void record_close(struct record *record)
{
    bayesopt_free(record->bo);
    *record = (struct record){0};
}

void record_remove(const char *path)
{
    static const char *const suffixes[] = {"", "-journal", "-wal", "-shm"};
    char name[4096];
    for (size_t i = 0; i < sizeof suffixes / sizeof *suffixes; i++)
        if (snprintf(name, sizeof name, "%s%s", path, suffixes[i]) < (int)sizeof name)
            unlink(name);
}

/* A member that is kept as an attribute of the same name; one that came later may be missing. */
struct member {
    const char *name;
    enum { MEMBER_NUMBER, MEMBER_COUNT, MEMBER_INTEGER, MEMBER_TEXT } type;
    size_t offset, size;
    bool later;
};

#define MEMBER(owner, what, member)                                                                \
    {                                                                                              \
        .name = #member, .type = what, .offset = offsetof(struct owner, member),                   \
        .size = sizeof((struct owner *)0)->member                                                  \
    }
#define FIGURE(member) MEMBER(evaluation, MEMBER_NUMBER, member)
#define LATER(member)                                                                              \
    {                                                                                              \
        .name = #member, .type = MEMBER_NUMBER, .offset = offsetof(struct evaluation, member),     \
        .later = true                                                                              \
    }
#define RESULT(member) MEMBER(verification, MEMBER_NUMBER, member)

#define OPTION(member) MEMBER(igabem_options, MEMBER_NUMBER, member)
#define WHOLE(member)  MEMBER(igabem_options, MEMBER_INTEGER, member)

enum { MEMBERS_MOST = 20 }; /* of the lists below */

static const struct member EVALUATION[] = {
    FIGURE(cw),
    FIGURE(cw_pressure),
    FIGURE(rw),
    FIGURE(condition),
    FIGURE(share_beyond_cutoff),
    FIGURE(volume),
    FIGURE(volume_ratio),
    FIGURE(wetted_area),
    FIGURE(bound),
    FIGURE(breadth),
    LATER(outside),
    FIGURE(nu_s),
    LATER(sinkage),
    LATER(trim),
    FIGURE(propose_seconds),
    FIGURE(geometry_seconds),
    FIGURE(solve_seconds),
    MEMBER(evaluation, MEMBER_COUNT, dofs),
    FIGURE(value),
    MEMBER(evaluation, MEMBER_TEXT, made),
};
static const struct member SOLVER_OPTIONS[] = {
    OPTION(froude),         OPTION(gravity),      OPTION(density),     WHOLE(refine),
    WHOLE(elements_u),      WHOLE(elements_v),    WHOLE(degree),       OPTION(cutoff_angle),
    OPTION(stem_limit),     OPTION(stern_length), OPTION(stern_blend), OPTION(tolerance),
    OPTION(spectrum_limit),
};
static const struct member ROW[] = {
    MEMBER(verification, MEMBER_TEXT, label),
    MEMBER(verification, MEMBER_TEXT, formulation),
    MEMBER(verification, MEMBER_TEXT, note),
    MEMBER(verification, MEMBER_INTEGER, refine),
    MEMBER(verification, MEMBER_COUNT, dofs_parent),
    MEMBER(verification, MEMBER_COUNT, dofs_best),
    RESULT(froude),
    RESULT(stern_length),
    RESULT(cw_parent),
    RESULT(cw_best),
    RESULT(cw_pressure_parent),
    RESULT(cw_pressure_best),
    RESULT(seconds),
};

#define LENGTH(array) (sizeof(array) / sizeof *(array))

static size_t pack(size_t n, const struct member *members, const void *from,
                   bayesopt_attribute *attributes)
{
    for (size_t i = 0; i < n; i++) {
        const char *at = (const char *)from + members[i].offset;
        bayesopt_attribute *a = &attributes[i];
        *a = (bayesopt_attribute){.name = members[i].name};
        switch (members[i].type) {
        case MEMBER_NUMBER:
            a->number = *(const double *)(const void *)at;
            break;
        case MEMBER_COUNT:
            a->number = (double)*(const size_t *)(const void *)at;
            break;
        case MEMBER_INTEGER:
            a->number = *(const int *)(const void *)at;
            break;
        case MEMBER_TEXT:
            a->text = at;
            break;
        }
    }
    return n;
}

static const bayesopt_attribute *find(size_t n, const bayesopt_attribute *attributes,
                                      const char *name)
{
    for (size_t i = 0; i < n; i++)
        if (strcmp(attributes[i].name, name) == 0)
            return &attributes[i];
    return NULL;
}

/* Stores an attribute as a member; false: it is no such value. */
static bool store_member(const struct member *member, const bayesopt_attribute *a, void *at)
{
    bool whole = a->number == floor(a->number);
    if ((member->type == MEMBER_TEXT) != (a->text != NULL))
        return false;
    switch (member->type) {
    case MEMBER_NUMBER:
        *(double *)at = a->number;
        return !isinf(a->number);
    case MEMBER_COUNT:
        whole = whole && a->number >= 0 && a->number <= 0x1p53;
        *(size_t *)at = whole ? (size_t)a->number : 0;
        return whole;
    case MEMBER_INTEGER:
        whole = whole && a->number >= INT_MIN && a->number <= INT_MAX;
        *(int *)at = whole ? (int)a->number : 0;
        return whole;
    case MEMBER_TEXT:
        snprintf(at, member->size, "%s", a->text);
        return true;
    }
    return false;
}

static bool unpack(size_t n, const struct member *members, size_t n_attributes,
                   const bayesopt_attribute *attributes, void *to, const char *what)
{
    for (size_t i = 0; i < n; i++) {
        const bayesopt_attribute *a = find(n_attributes, attributes, members[i].name);
        const bayesopt_attribute none = {.name = members[i].name, .number = NAN};
        if (!a && !members[i].later)
            return core_fail("%s: '%s' is missing", what, members[i].name);
        if (!store_member(&members[i], a ? a : &none, (char *)to + members[i].offset))
            return core_fail("%s: '%s' is damaged", what, members[i].name);
    }
    return true;
}

size_t record_solver(const igabem_options *solver, bayesopt_attribute attributes[SOLVER_MOST])
{
    attributes[0] = (bayesopt_attribute){.name = "formulation",
                                         .text = igabem_formulation_name(solver->formulation)};
    attributes[1] =
        (bayesopt_attribute){.name = "line_term", .text = solver->line_term ? "true" : "false"};
    return 2 + pack(LENGTH(SOLVER_OPTIONS), SOLVER_OPTIONS, solver, attributes + 2);
}

static bool get_solver(const struct record *record, igabem_options *solver)
{
    bayesopt_table *table;
    const bayesopt_attribute *row;
    igabem_options_init(solver);
    if (!done(bayesopt_store_get_table(record->bo, SOLVER, &table)))
        return false;
    size_t n = bayesopt_table_row(table, 0, &row);
    const char *name = bayesopt_attribute_text(n, row, "formulation");
    const char *line_term = bayesopt_attribute_text(n, row, "line_term");
    bool ok = unpack(LENGTH(SOLVER_OPTIONS), SOLVER_OPTIONS, n, row, solver, "its solver");
    solver->line_term = strcmp(line_term, "true") == 0;
    ok = ok && (solver->line_term || strcmp(line_term, "false") == 0 ||
                core_fail("its solver: 'line_term' is damaged"));
    igabem_formulation f = 0;
    while (igabem_formulation_info(f) && strcmp(igabem_formulation_name(f), name) != 0)
        f++;
    ok = ok && (igabem_formulation_info(f) || core_fail("formulation '%s' is not known", name));
    solver->formulation = f;
    bayesopt_table_free(table);
    return ok;
}

/* The name of a field of the latent space in the store. */
static void name_field(const galv_field *field, char name[64])
{
    snprintf(name, 64, "latent.%s", field->name);
}

static bool put_model(struct record *record, const galv_model *model)
{
    char name[64];
    for (size_t i = 0; i < galv_model_field_count(); i++) {
        const galv_field field = galv_model_field(model, i);
        const double number = galv_field_number(&field);
        name_field(&field, name);
        if (field.values && !record_put_array(record, name, field.rows, field.columns,
                                              field.dimensions ? field.values : &number))
            return false;
    }
    return true;
}

static bool get_model(const struct record *record, galv_model **model)
{
    enum { MOST = 64 };
    galv_field fields[MOST];
    size_t n = galv_model_field_count() < MOST ? galv_model_field_count() : MOST;
    bool ok = true;
    for (size_t i = 0; i < n; i++) {
        char name[64];
        double *values = NULL;
        fields[i] = galv_model_field(NULL, i);
        name_field(&fields[i], name);
        ok = ok && record_get_array(record, name, &fields[i].rows, &fields[i].columns, &values);
        fields[i].type = GALV_TYPE_DOUBLE;
        fields[i].values = values;
    }
    ok = ok && (galv_model_restore(n, fields, model) == GALV_OK ||
                core_fail("the latent space is damaged: %s", galv_last_error()));
    for (size_t i = 0; i < n; i++)
        free((void *)fields[i].values);
    return ok;
}

static const char INITIAL[] = "initial", ENDS[] = "parameters.ends", MAP[] = "parameters.map";

static void name_points(uint64_t id, char name[40])
{
    snprintf(name, 40, "points.%llu", (unsigned long long)id);
}

bool record_put_points(struct record *record, uint64_t id, size_t n, const double *points)
{
    char name[40];
    name_points(id, name);
    return record_put_array(record, name, n, 3, points);
}

bool record_get_points(const struct record *record, uint64_t id, size_t n, double **points)
{
    size_t rows, columns;
    char name[40];
    name_points(id, name);
    return record_get_array(record, name, &rows, &columns, points) &&
           (!*points || rows * columns == 3 * n || core_fail("'%s' is damaged", name));
}

bool record_put_origin(struct record *record, const struct problem *problem)
{
    const double format = FORMAT, length = problem_length(problem);
    const double grid[2] = {(double)nurbs_grid_rows(problem->grid),
                            (double)nurbs_grid_columns(problem->grid)};
    const double *gradient = galv_limits_gradient(problem->limits);
    bayesopt_attribute solver[SOLVER_MOST];
    size_t n = record_solver(&problem->solver, solver);
    return record_put_text(record, "version", TOOL_VERSION) &&
           done(bayesopt_store_put_row(record->bo, SOLVER, 0, n, solver)) &&
           record_put_array(record, "length", 1, 1, &length) &&
           record_put_array(record, "grid", 1, 2, grid) && put_model(record, problem->model) &&
           (!gradient || record_put_array(record, "volume.gradient", 1,
                                          galv_model_modes(problem->model), gradient)) &&
           (!problem->initial ||
            record_put_array(record, INITIAL, problem->config->initial,
                             galv_model_modes(problem->model), problem->initial)) &&
           (!problem->ends ||
            record_put_array(record, ENDS, 2 * galv_model_modes(problem->model),
                             3 * galv_model_points(problem->model), problem->ends)) &&
           (!problem->map || record_put_array(record, MAP, galv_model_modes(problem->model),
                                              problem->config->n_parameters, problem->map)) &&
           record_put_text(record, CONFIGURATION, problem->config->text) &&
           record_put_array(record, FORMAT_NAME, 1, 1, &format);
}

/* Numbers of a fixed count. */
static bool get_numbers(const struct record *record, const char *name, size_t n, double *numbers)
{
    size_t rows, columns;
    double *values;
    if (!record_get_array(record, name, &rows, &columns, &values))
        return false;
    bool ok = values && rows * columns == n;
    if (ok)
        memcpy(numbers, values, n * sizeof *numbers);
    free(values);
    return ok || core_fail("'%s' is missing", name);
}

static bool check_format(const struct record *record)
{
    double format;
    size_t rows, columns;
    double *values;
    if (!record_get_array(record, FORMAT_NAME, &rows, &columns, &values))
        return false;
    format = values ? *values : 0;
    free(values);
    if (format == FORMAT)
        return true;
    if (format > FORMAT)
        return core_fail("a newer hullopt wrote it: format %g, this one knows %d", format, FORMAT);
    if (format > 1)
        return core_fail("an older hullopt wrote it: format %g, this one knows %d", format, FORMAT);
    return core_fail("not the record of a hullopt run, or that of version 0.1.0, which this one "
                     "does not read");
}

/* An array that need not be there. size: how many rows and columns there are to be, or 0 for any
 * number, which is filled. */
static bool get_block(const struct record *record, const char *name, size_t size[2],
                      double **values)
{
    size_t found[2];
    if (!record_get_array(record, name, &found[0], &found[1], values))
        return false;
    for (int k = 0; k < 2 && *values; k++) {
        if (size[k] && size[k] != found[k])
            return core_fail("'%s' is damaged: %zu x %zu numbers", name, found[0], found[1]);
        size[k] = found[k];
    }
    return true;
}

static bool get_grid(const struct record *record, size_t points, size_t size[2])
{
    double grid[2];
    if (!get_numbers(record, "grid", 2, grid))
        return false;
    for (int k = 0; k < 2; k++) {
        if (!(grid[k] >= 2 && grid[k] <= (double)points) || grid[k] != floor(grid[k]))
            return core_fail("'grid' is damaged");
        size[k] = (size_t)grid[k];
    }
    return true;
}

static bool read_origin(const struct record *record, struct origin *o)
{
    if (!check_format(record) || !record_get_text(record, CONFIGURATION, &o->configuration) ||
        !get_solver(record, &o->solver) || !get_numbers(record, "length", 1, &o->length) ||
        !get_model(record, &o->model))
        return false;
    size_t modes = galv_model_modes(o->model), points = galv_model_points(o->model);
    size_t initial[2] = {0, modes}, ends[2] = {2 * modes, 3 * points}, map[2] = {modes, 0};
    size_t gradient[2] = {1, modes};
    if (!get_grid(record, points, o->grid) || !get_block(record, INITIAL, initial, &o->initial) ||
        !get_block(record, ENDS, ends, &o->ends) || !get_block(record, MAP, map, &o->map) ||
        !get_block(record, "volume.gradient", gradient, &o->gradient))
        return false;
    o->n_initial = initial[0];
    o->n_parameters = map[1];
    if (!(o->length > 0 && isfinite(o->length)))
        return core_fail("'length' is damaged");
    return (o->configuration && *o->configuration) || core_fail("it has no configuration");
}

bool record_read(const char *path, struct record *record, struct origin *origin)
{
    *record = (struct record){0};
    *origin = (struct origin){0};
    if (bayesopt_open_read(path, &record->bo) != BAYESOPT_OK)
        return core_fail("%s", bayesopt_last_error());
    if (read_origin(record, origin))
        return true;
    origin_free(origin);
    record_close(record);
    bool named = strncmp(core_sentence(), path, strlen(path)) == 0;
    return named ? false : core_fail("%s: %s", path, core_sentence());
}

void origin_free(struct origin *origin)
{
    free(origin->configuration);
    free(origin->gradient);
    free(origin->initial);
    free(origin->ends);
    free(origin->map);
    galv_model_free(origin->model);
    *origin = (struct origin){0};
}

bool record_begin_session(struct record *record, int threads, double start)
{
    double seconds;
    record->threads = threads;
    record->start = start;
    return record_seconds(record, &record->session, &seconds) && record_update_session(record);
}

bool record_update_session(struct record *record)
{
    const bayesopt_attribute row[] = {
        {.name = "threads", .number = record->threads},
        {.name = "seconds", .number = cli_seconds() - record->start},
    };
    return done(bayesopt_store_put_row(record->bo, SESSIONS, record->session, 2, row));
}

bool record_seconds(const struct record *record, size_t *sessions, double *seconds)
{
    bayesopt_table *table;
    const bayesopt_attribute *row;
    if (!done(bayesopt_store_get_table(record->bo, SESSIONS, &table)))
        return false;
    *sessions = bayesopt_table_rows(table);
    *seconds = 0;
    for (size_t i = 0; i < *sessions; i++) {
        size_t n = bayesopt_table_row(table, i, &row);
        const bayesopt_attribute *spent = find(n, row, "seconds");
        if (!spent || !(spent->number >= 0)) {
            bayesopt_table_free(table);
            return core_fail("a session without its seconds");
        }
        *seconds += spent->number;
    }
    bayesopt_table_free(table);
    return true;
}

/* Names of numbered figures: "cw_speed_1". */
enum { NAME_SIZE = 32 };
static void number_name(const char *name, size_t i, char text[NAME_SIZE])
{
    snprintf(text, NAME_SIZE, "%s_%zu", name, i + 1);
}

static size_t pack_list(const char *name, size_t n, const double *values, char (*names)[NAME_SIZE],
                        bayesopt_attribute *attributes)
{
    for (size_t i = 0; i < n; i++) {
        number_name(name, i, names[i]);
        attributes[i] = (bayesopt_attribute){.name = names[i], .number = values[i]};
    }
    return n;
}

/* How many figures of a numbered name a design has, which are numbers and have no gap. */
static bool count_list(const char *name, const bayesopt_point *point, size_t *n)
{
    char text[NAME_SIZE];
    size_t length = strlen(name), all = 0;
    bool ok = true;
    for (size_t i = 0; i < point->n_attributes; i++) {
        const bayesopt_attribute *a = &point->attributes[i];
        bool ours = strncmp(a->name, name, length) == 0 && a->name[length] == '_';
        ok = ok && !(ours && (a->text || isinf(a->number)));
        all += ours;
    }
    for (*n = 0; number_name(name, *n, text), find(point->n_attributes, point->attributes, text);)
        ++*n;
    return (ok && *n == all) || core_fail("design %llu: a figure '%s_...' is damaged",
                                          (unsigned long long)point->id, name);
}

static size_t unpack_list(const char *name, size_t most, const bayesopt_point *point,
                          double *values)
{
    char text[NAME_SIZE];
    size_t n = 0;
    for (; n < most; n++) {
        number_name(name, n, text);
        values[n] = bayesopt_attribute_number(point->n_attributes, point->attributes, text);
        if (isnan(values[n]))
            break;
    }
    return n;
}

static const char MODEL[] = "cw_model", SPEED[] = "cw_speed", PARTICULAR[] = "particular",
                  TOLD[] = "told", SURFACE[] = "surface";

bool record_tell(struct record *record, struct evaluation *e, const double *ratio)
{
    enum { NUMBERS = 2 * PARTICULARS };
    enum { LISTS = CONFIG_MODELS_MOST + SPEEDS_MOST + NUMBERS + OBJECTIVES_MOST + SURFACES_MOST };
    bayesopt_attribute attributes[MEMBERS_MOST + LISTS];
    char names[LISTS][NAME_SIZE];
    size_t told = OBJECTIVES_MOST - 1;
    while (told && isnan(e->told[told - 1]))
        told--;
    size_t n = pack(LENGTH(EVALUATION), EVALUATION, e, attributes);
    bayesopt_attribute *list = attributes + n;
    size_t k = pack_list(MODEL, e->models, e->cw_model, names, list);
    k += pack_list(SPEED, e->speeds, e->cw_speed, names + k, list + k);
    k += pack_list(PARTICULAR, NUMBERS, e->particular[0], names + k, list + k);
    k += pack_list(TOLD, told, e->told, names + k, list + k);
    n += k + pack_list(SURFACE, e->surfaces, e->surface, names + k, list + k);
    bool first = bayesopt_count(record->bo) == 0; /* the parent keeps 0 */
    const bayesopt_result result = {.f = e->failed ? NAN : e->objective,
                                    .constraints = ratio,
                                    .note = e->failed ? e->reason : NULL,
                                    .n_attributes = n,
                                    .attributes = attributes};
    return done(e->id
                    ? bayesopt_tell_result(record->bo, e->id, &result)
                    : bayesopt_tell_point_result(record->bo, e->u, &result, first ? NULL : &e->id));
}

/* Those without a value, a place that is not asked for, are not on record. */
static void unpack_numbers(const char *name, size_t n, const bayesopt_point *point, double *value)
{
    char text[NAME_SIZE];
    for (size_t i = 0; i < n; i++) {
        number_name(name, i, text);
        value[i] = bayesopt_attribute_number(point->n_attributes, point->attributes, text);
    }
}

/* What was not asked for is the parent, which comes first, or a design of a descent. */
static bool read_evaluation(const bayesopt_point *point, bool first, struct evaluation *e)
{
    char what[40];
    const char *phase = first ? "parent"
                        : point->phase == BAYESOPT_PHASE_EXTERNAL
                            ? "descent"
                            : bayesopt_phase_name(point->phase);
    evaluation_start(first ? 0 : point->id, phase, point->x, e);
    e->failed = point->state == BAYESOPT_STATE_FAILED;
    e->objective = point->f;
    if (e->failed)
        snprintf(e->reason, sizeof e->reason, "%s", point->note);
    snprintf(what, sizeof what, "design %llu", (unsigned long long)e->id);
    if (!unpack(LENGTH(EVALUATION), EVALUATION, point->n_attributes, point->attributes, e, what))
        return false;
    size_t n;
    if (!count_list(MODEL, point, &n) || !count_list(SPEED, point, &n) ||
        !count_list(PARTICULAR, point, &n) || !count_list(SURFACE, point, &n))
        return false;
    if (!e->failed && !isfinite(e->cw))
        return core_fail("%s: 'cw' is damaged", what);
    e->models = unpack_list(MODEL, CONFIG_MODELS_MOST, point, e->cw_model);
    e->speeds = unpack_list(SPEED, SPEEDS_MOST, point, e->cw_speed);
    e->surfaces = unpack_list(SURFACE, SURFACES_MOST, point, e->surface);
    unpack_numbers(TOLD, OBJECTIVES_MOST - 1, point, e->told);
    unpack_numbers(PARTICULAR, 2 * PARTICULARS, point, e->particular[0]);
    return true;
}

bool record_evaluations(const struct record *record, struct evaluation **list, size_t *n)
{
    size_t all = bayesopt_count(record->bo);
    bayesopt_point point;
    *n = 0;
    *list = calloc(all + 1, sizeof **list);
    bool ok = *list || core_no_memory();
    for (size_t i = 0; i < all && ok; i++) {
        ok = done(bayesopt_get(record->bo, i, &point));
        if (!ok || point.state == BAYESOPT_STATE_PENDING)
            continue;
        ok = read_evaluation(&point, i == 0, &(*list)[*n]);
        *n += ok;
    }
    if (!ok) {
        free(*list);
        *list = NULL;
    }
    return ok;
}

bool record_put_verification(struct record *record, size_t position, const struct verification *row)
{
    bayesopt_attribute attributes[MEMBERS_MOST];
    size_t n = pack(LENGTH(ROW), ROW, row, attributes);
    attributes[n++] =
        (bayesopt_attribute){.name = "group", .text = verification_group_name(row->group)};
    return done(bayesopt_store_put_row(record->bo, VERIFICATION, position, n, attributes));
}

static bool read_row(size_t n, const bayesopt_attribute *attributes, struct verification *row)
{
    const char *group = bayesopt_attribute_text(n, attributes, "group");
    if (!unpack(LENGTH(ROW), ROW, n, attributes, row, "its verification"))
        return false;
    for (row->group = 0; row->group < GROUPS; row->group++)
        if (strcmp(group, verification_group_name(row->group)) == 0)
            return true;
    return core_fail("a verification of '%s', which this version does not know", group);
}

bool record_verifications(const struct record *record, struct verification **list, size_t *n)
{
    bayesopt_table *table;
    *list = NULL;
    *n = 0;
    if (!done(bayesopt_store_get_table(record->bo, VERIFICATION, &table)))
        return false;
    size_t rows = bayesopt_table_rows(table);
    *list = calloc(rows + 1, sizeof **list);
    bool ok = *list || core_no_memory();
    while (ok && *n < rows) {
        const bayesopt_attribute *attributes;
        size_t count = bayesopt_table_row(table, *n, &attributes);
        ok = read_row(count, attributes, &(*list)[*n]);
        *n += ok;
    }
    bayesopt_table_free(table);
    return ok;
}
