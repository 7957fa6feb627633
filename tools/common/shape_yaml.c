#include "shape_yaml.h"

#include "cli.h"
#include "settings.h"
#include "shape_net.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const size_t MOST_PARAMETERS = 1000000;

/* A function of the file, or what all have that give nothing of their own. */
struct function_text {
    double order[3], phase[3], bounds[2];
    int direction;
    bool has_phase, has_bounds, has_direction;
};

struct shape_text {
    const struct shape_points *points;
    int combination;
    struct function_text all;
    double origin[3], length[3]; /* NAN: auto */
    struct function_text *functions;
    size_t n_functions;
    size_t orders[3], n_orders;
    size_t count[3], degree[3], first[3], last[3];
    size_t n_count, n_degree, n_first, n_last; /* 3, or 0 where it is not given */
    int directions[3];
    size_t n_directions;
    struct shape_net net;
};

static const char *const KINDS[SHAPE_KINDS] = {"sines", "lattice", "control points"};

const char *shape_kind_name(enum shape_kind kind)
{
    return (unsigned)kind < SHAPE_KINDS ? KINDS[kind] : "unknown";
}

static const struct setting_word AUTO[] = {{"auto", NAN}, {NULL, 0}};
static const struct setting_word AXES[] = {{"x", 0}, {"y", 1}, {"z", 2}, {NULL, 0}};
static const struct setting_word COMBINATIONS[] = {{"recursive", GALV_COMBINATION_RECURSIVE},
                                                   {"linear", GALV_COMBINATION_LINEAR},
                                                   {"scaled", GALV_COMBINATION_SCALED},
                                                   {NULL, 0}};

const char *shape_combination_name(galv_combination combination)
{
    const struct setting_word *word = COMBINATIONS;
    while (word->name && word->value != (double)combination)
        word++;
    return word->name ? word->name : "unknown";
}

bool shape_combination_find(const char *name, galv_combination *combination)
{
    for (const struct setting_word *word = COMBINATIONS; word->name; word++)
        if (strcmp(word->name, name) == 0) {
            *combination = (galv_combination)word->value;
            return true;
        }
    return false;
}

#define FUNCTION(...)       SETTING_ROW(struct function_text, __VA_ARGS__)
#define SHAPE(...)          SETTING_ROW(struct shape_text, __VA_ARGS__)
#define ALL(n)              .n_least = (n), .n_most = (n)
#define GIVEN(part, member) .given = offsetof(struct part, member)
#define COUNTED(member)     .count = offsetof(struct shape_text, member)

static const struct setting FUNCTION_ROWS[] = {
    FUNCTION("order", NUMBER, order, "half-waves along x, y and z", ALL(3), .required = true),
    FUNCTION("phase", NUMBER, phase, "radians", ALL(3), GIVEN(function_text, has_phase)),
    FUNCTION("bounds", NUMBER, bounds, "of its parameter, m or share", ALL(2),
             GIVEN(function_text, has_bounds)),
    FUNCTION("direction", CHOICE, direction, "in which points move", .words = AXES,
             GIVEN(function_text, has_direction)),
};

static void complain_order(struct settings_source *source, bool given, const double bounds[2])
{
    if (given && !(bounds[0] <= bounds[1]))
        settings_complain(source, "bounds", "are %g and %g, expected in order", bounds[0],
                          bounds[1]);
}

static void check_bounds(struct settings_source *source, void *target)
{
    const struct function_text *f = target;
    complain_order(source, f->has_bounds, f->bounds);
}

static const struct settings FUNCTION_TABLE = {4, FUNCTION_ROWS, .check = check_bounds};

#define MOVED(...) SETTING_ROW(struct shape_net_part, __VA_ARGS__)

static const struct setting MOVED_ROWS[] = {
    MOVED("first", COUNT, first, "moved control points along u and v, from 0", ALL(2),
          .required = true),
    MOVED("last", COUNT, last, "the last of them", ALL(2), .required = true),
    MOVED("directions", CHOICE, directions, "in which they move", .n_least = 1, .n_most = 3,
          .words = AXES, .count = offsetof(struct shape_net_part, n_directions), .otherwise = "y"),
    MOVED("together", SWITCH, together, "one parameter for all of them, not one for each",
          .otherwise = "false"),
    MOVED("bounds", NUMBER, bounds, "of these parameters, m", ALL(2),
          GIVEN(shape_net_part, has_bounds)),
};

static void check_part(struct settings_source *source, void *target)
{
    const struct shape_net_part *part = target;
    complain_order(source, part->has_bounds, part->bounds);
}

static const struct settings MOVED_TABLE = {sizeof MOVED_ROWS / sizeof *MOVED_ROWS, MOVED_ROWS,
                                            .check = check_part};

static const struct setting ROWS[] = {
    SHAPE("combination", CHOICE, combination,
          "whether a function sees what those before it moved, or moves each point by a "
          "share of its own coordinate",
          .words = COMBINATIONS, .otherwise = "recursive"),
    SHAPE("direction", CHOICE, all.direction, "in which points move", .words = AXES,
          .otherwise = "y"),
    SHAPE("phase", NUMBER, all.phase, "radians", ALL(3), .otherwise = "0,0,0"),
    SHAPE("bounds", NUMBER, all.bounds, "of every parameter, m or share", ALL(2),
          GIVEN(shape_text, all.has_bounds)),
    SHAPE("box.origin", NUMBER, origin, "m; auto: least coordinate of the points", ALL(3),
          .words = AUTO, .otherwise = "auto"),
    SHAPE("box.length", NUMBER, length, "m; auto: extent of the points", ALL(3), .words = AUTO,
          .otherwise = "auto", SETTING_ABOVE(0)),
    SHAPE("functions", ROWS, functions, "sine products", COUNTED(n_functions), .n_least = 1,
          .n_most = 100000, .table = &FUNCTION_TABLE, .size = sizeof(struct function_text)),
    SHAPE("orders", COUNT, orders, "all sine products of 1 to so many half-waves", ALL(3),
          COUNTED(n_orders), SETTING_FROM(1, 50)),
    SHAPE("lattice.count", COUNT, count, "control points along x, y and z", ALL(3),
          COUNTED(n_count), SETTING_FROM(2, 1000)),
    SHAPE("lattice.degree", COUNT, degree, "of the B-splines", ALL(3), COUNTED(n_degree),
          SETTING_FROM(1, 999)),
    SHAPE("lattice.first", COUNT, first, "moved control points, from 0", ALL(3), COUNTED(n_first)),
    SHAPE("lattice.last", COUNT, last, "the last of them", ALL(3), COUNTED(n_last)),
    SHAPE("lattice.directions", CHOICE, directions, "in which they move", .n_least = 1, .n_most = 3,
          .words = AXES, COUNTED(n_directions), .otherwise = "y"),
    SHAPE("control_points.count", COUNT, net.count,
          "of a spline over the hull, along u and v; left out: the hull's own", ALL(2),
          COUNTED(net.n_count), SETTING_FROM(2, 1000)),
    SHAPE("control_points.degree", COUNT, net.degree, "of that spline; 3, or less for few points",
          ALL(2), COUNTED(net.n_degree), SETTING_FROM(1, NURBS_MAX_DEGREE)),
    SHAPE("control_points.moved", ROWS, net.parts, "which of them move, and in what direction",
          COUNTED(net.n_parts), .n_least = 1, .n_most = 100000, .table = &MOVED_TABLE,
          .size = sizeof(struct shape_net_part)),
};

static bool has_net(const struct shape_text *t)
{
    return t->net.n_count + t->net.n_degree + t->net.n_parts > 0;
}

static bool has_lattice(const struct shape_text *t)
{
    return t->n_count + t->n_degree + t->n_first + t->n_last > 0;
}

/* The moved control points are those from `first` to `last`, both included, counted from 0. */
static void check_lattice(struct settings_source *source, struct shape_text *t)
{
    if (!t->n_count || !t->n_first || !t->n_last) {
        settings_complain(source,
                          !t->n_count   ? "lattice.count"
                          : !t->n_first ? "lattice.first"
                                        : "lattice.last",
                          "is missing");
        return;
    }
    size_t moved = t->n_directions;
    for (int j = 0; j < 3; j++) {
        if (t->first[j] > t->last[j] || t->last[j] >= t->count[j])
            settings_complain(source, "lattice.last",
                              "along %c: moved points %zu to %zu of %zu (0 is the first)", "xyz"[j],
                              t -> first[j], t -> last[j], t -> count[j]);
        else
            moved *= t->last[j] - t->first[j] + 1;
        if (!t->n_degree)
            t->degree[j] = t->count[j] - 1;
    }
    if (moved > MOST_PARAMETERS)
        settings_complain(source, "lattice", "moves %zu coordinates, expected at most %zu", moved,
                          MOST_PARAMETERS);
}

/* Whether all of them lie on the net. */
static void check_net(struct settings_source *source, struct shape_text *t)
{
    struct shape_net *net = &t->net;
    const nurbs_surface *surface = t->points->surface;
    if (!surface) {
        settings_complain(source, "control_points",
                          "are those of a NURBS surface, but the hull is a grid of points");
        return;
    }
    if (!net->n_parts)
        settings_complain(source, "control_points", "has no list 'moved' of what moves");
    if (net->n_degree && !net->n_count)
        settings_complain(source, "control_points.degree",
                          "is given without count: the hull's own points have its own degree");
    shape_net_complete(net, surface);
    size_t moved = 0;
    for (int a = 0; a < 2; a++)
        if (net->degree[a] >= net->count[a])
            settings_complain(source, "control_points.degree",
                              "along %c: %zu of %zu points, expected less", "uv"[a],
                              net -> degree[a], net -> count[a]);
    for (size_t k = 0; k < net->n_parts; k++) {
        const struct shape_net_part *part = &net->parts[k];
        for (int a = 0; a < 2; a++)
            if (part->first[a] > part->last[a] || part->last[a] >= net->count[a])
                settings_complain(
                    source, "control_points.moved",
                    "in entry %zu along %c: points %zu to %zu of %zu (0 is the first)", k + 1,
                    "uv"[a], part -> first[a], part -> last[a], net -> count[a]);
        if (!part->has_bounds && !t->all.has_bounds)
            settings_complain(source, "control_points.moved",
                              "has no bounds in entry %zu, and none are given for all", k + 1);
        moved += shape_net_parameters(part);
    }
    if (moved > MOST_PARAMETERS)
        settings_complain(source, "control_points", "moves %zu coordinates, expected at most %zu",
                          moved, MOST_PARAMETERS);
}

/* A box that has nothing to do with the points is in other units than they are: modes would be
 * found all the same. */
static void check_box(struct settings_source *source, struct shape_text *t)
{
    galv_box around;
    if (galv_box_around(t->points->n, t->points->xyz, &around)) {
        settings_complain(source, "box", "cannot be laid around the hull: %s", galv_last_error());
        return;
    }
    bool apart = false, small = true, large = true;
    for (int j = 0; j < 3; j++) {
        if (isnan(t->origin[j]))
            t->origin[j] = around.origin[j];
        if (isnan(t->length[j]))
            t->length[j] = around.length[j];
        apart = apart || t->origin[j] >= around.origin[j] + around.length[j] ||
                t->origin[j] + t->length[j] <= around.origin[j];
        small = small && t->length[j] < 0.1 * around.length[j];
        large = large && t->length[j] > 2.5 * around.length[j];
    }
    if (apart || small || large)
        settings_complain(source, "box",
                          "from (%g, %g, %g) of %g x %g x %g %s the hull's, from (%g, %g, %g) of "
                          "%g x %g x %g: are both in metres?",
                          t->origin[0], t->origin[1], t->origin[2], t->length[0], t->length[1],
                          t->length[2],
                          apart   ? "lies beside"
                          : small ? "is far smaller than"
                                  : "is far larger than",
                          around.origin[0], around.origin[1], around.origin[2], around.length[0],
                          around.length[1], around.length[2]);
}

static void check_shape(struct settings_source *source, void *target)
{
    struct shape_text *t = target;
    size_t kinds = (size_t)(t->n_functions > 0) + (t->n_orders > 0) + has_lattice(t) + has_net(t);
    if (kinds != 1)
        settings_complain(source, "",
                          "has %zu of functions, orders, lattice and control_points, expected one",
                          kinds);
    for (size_t i = 0; i < t->n_functions; i++)
        if (!t->functions[i].has_bounds && !t->all.has_bounds)
            settings_complain(source, "functions",
                              "has no bounds in entry %zu, and none are given for all", i + 1);
    if (!t->n_functions && !has_net(t) && !t->all.has_bounds)
        settings_complain(source, "bounds", "is missing");
    check_bounds(source, &t->all);
    if (has_lattice(t))
        check_lattice(source, t);
    if (has_net(t))
        check_net(source, t);
    check_box(source, t);
}

static const struct settings SHAPE_TABLE = {sizeof ROWS / sizeof *ROWS, ROWS, .check = check_shape};

/* The fields of one function override those given for all. */
static void put_function(const struct shape_text *t, const struct function_text *f,
                         const double order[3], size_t i, struct shape_definition *definition)
{
    const double *bounds = f->has_bounds ? f->bounds : t->all.bounds;
    galv_sine *sine = &definition->functions[i];
    *sine = (galv_sine){.direction = f->has_direction ? f->direction : t->all.direction};
    memcpy(sine->order, order, sizeof sine->order);
    memcpy(sine->phase, f->has_phase ? f->phase : t->all.phase, sizeof sine->phase);
    definition->lower[i] = bounds[0];
    definition->upper[i] = bounds[1];
}

static void put_sines(const struct shape_text *t, struct shape_definition *definition)
{
    const size_t *most = t->orders;
    definition->combination = (galv_combination)t->combination;
    for (size_t i = 0; i < t->n_functions; i++)
        put_function(t, &t->functions[i], t->functions[i].order, i, definition);
    /* Every triple of half-waves from 1 on, the last axis fastest. */
    for (size_t i = 0; t->n_orders && i < definition->n; i++)
        put_function(t, &t->all,
                     (double[]){(double)(1 + i / (most[1] * most[2])),
                                (double)(1 + i / most[2] % most[1]), (double)(1 + i % most[2])},
                     i, definition);
}

static void put_lattice(const struct shape_text *t, struct shape_definition *definition)
{
    size_t n = 0;
    for (size_t i = t->first[0]; i <= t->last[0]; i++)
        for (size_t j = t->first[1]; j <= t->last[1]; j++)
            for (size_t k = t->first[2]; k <= t->last[2]; k++)
                for (size_t a = 0; a < t->n_directions; a++) {
                    definition->lower[n] = t->all.bounds[0];
                    definition->upper[n] = t->all.bounds[1];
                    definition->moves[n++] = (galv_lattice_move){{i, j, k}, t->directions[a]};
                }
    for (int j = 0; j < 3; j++) {
        definition->count[j] = t->count[j];
        definition->degree[j] = (int)t->degree[j];
    }
}

/* A parameter for each point and direction, or one for all points. */
static void put_net(const struct shape_text *t, const double *basis,
                    struct shape_definition *definition)
{
    size_t n = 0;
    for (const struct shape_net_part *part = t->net.parts; part < t->net.parts + t->net.n_parts;
         part++) {
        const double *bounds = part->has_bounds ? part->bounds : t->all.bounds;
        for (size_t k = 0; k < shape_net_parameters(part); k++, n++) {
            definition->lower[n] = bounds[0];
            definition->upper[n] = bounds[1];
            definition->moves[n].direction = shape_net_field(
                &t->net, part, k, t->points->n, basis, definition->fields + n * 3 * t->points->n);
        }
    }
}

static size_t count_parameters(const struct shape_text *t)
{
    size_t n = t->n_orders ? t->orders[0] * t->orders[1] * t->orders[2] : t->n_functions;
    if (has_lattice(t)) {
        n = t->n_directions;
        for (int j = 0; j < 3; j++)
            n *= t->last[j] - t->first[j] + 1;
    }
    for (size_t k = 0; k < t->net.n_parts; k++)
        n += shape_net_parameters(&t->net.parts[k]);
    return n;
}

static bool put_shape(const struct shape_text *t, struct shape_definition *definition)
{
    enum shape_kind kind = has_net(t)       ? SHAPE_CONTROL_POINTS
                           : has_lattice(t) ? SHAPE_LATTICE
                                            : SHAPE_SINES;
    double *basis = NULL;
    if (kind == SHAPE_CONTROL_POINTS && !shape_net_basis(&t->net, t->points, &basis))
        return false;
    bool ok = shape_definition_allocate(kind, count_parameters(t), t->points->n, definition) ||
              cli_refuse("out of memory");
    if (ok && kind == SHAPE_CONTROL_POINTS)
        put_net(t, basis, definition);
    else if (ok && kind == SHAPE_LATTICE)
        put_lattice(t, definition);
    else if (ok)
        put_sines(t, definition);
    free(basis);
    if (ok) {
        memcpy(definition->box.origin, t->origin, sizeof t->origin);
        memcpy(definition->box.length, t->length, sizeof t->length);
    }
    return ok;
}

bool shape_definition_read(const char *path, const struct shape_points *points,
                           struct shape_definition *definition)
{
    struct shape_text text = {.points = points};
    *definition = (struct shape_definition){.n = 0};
    settings_start(&SHAPE_TABLE, &text);
    bool ok = settings_read(path, &SHAPE_TABLE, &text) && put_shape(&text, definition);
    settings_free(&SHAPE_TABLE, &text);
    return ok;
}

bool shape_definition_allocate(enum shape_kind kind, size_t n, size_t npoints,
                               struct shape_definition *definition)
{
    bool net = kind == SHAPE_CONTROL_POINTS;
    *definition = (struct shape_definition){.kind = kind, .n = n, .npoints = net ? npoints : 0};
    bool large = net && npoints > SIZE_MAX / (3 * sizeof *definition->fields);
    if (kind == SHAPE_SINES)
        definition->functions = calloc(n, sizeof *definition->functions);
    else
        definition->moves = calloc(n, sizeof *definition->moves);
    if (net && !large)
        definition->fields = calloc(n, 3 * npoints * sizeof *definition->fields);
    definition->lower = calloc(n, sizeof *definition->lower);
    definition->upper = calloc(n, sizeof *definition->upper);
    if ((definition->functions || definition->moves) && definition->lower && definition->upper &&
        (definition->fields || !net))
        return true;
    shape_definition_free(definition);
    return false;
}

void shape_definition_free(struct shape_definition *definition)
{
    free(definition->functions);
    free(definition->moves);
    free(definition->fields);
    free(definition->lower);
    free(definition->upper);
    *definition = (struct shape_definition){.n = 0};
}

galv_status shape_definition_create(const struct shape_definition *definition, galv_shape **shape)
{
    if (definition->kind == SHAPE_SINES)
        return galv_shape_sine(definition->n, definition->functions, &definition->box,
                               definition->lower, definition->upper, definition->combination,
                               shape);
    if (definition->kind == SHAPE_CONTROL_POINTS)
        return galv_shape_fields(definition->n, definition->npoints, definition->fields,
                                 definition->lower, definition->upper, shape);
    galv_lattice lattice = {.box = definition->box};
    for (int j = 0; j < 3; j++) {
        lattice.count[j] = definition->count[j];
        lattice.degree[j] = definition->degree[j];
    }
    return galv_shape_ffd(&lattice, definition->n, definition->moves, definition->lower,
                          definition->upper, shape);
}

galv_shape *shape_yaml_read(const char *path, const struct shape_points *points)
{
    struct shape_definition definition;
    galv_shape *shape = NULL;
    if (!shape_definition_read(path, points, &definition))
        return NULL;
    if (shape_definition_create(&definition, &shape))
        cli_fail("%s: %s", path, galv_last_error());
    shape_definition_free(&definition);
    return shape;
}
