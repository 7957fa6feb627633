#include "config.h"

#include "cli.h"
#include "fields.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct setting_word NONE[] = {{"none", NAN}, {NULL, 0}};
static const struct setting_word BY_RULE[] = {{"by rule", NAN}, {NULL, 0}};
static const struct setting_word SURFACE[] = {{"by rule", 0}, {NULL, 0}};
static const struct setting_word AUTO[] = {{"auto", -1}, {NULL, 0}};
static const struct setting_word AS_IN_FILE[] = {{"as in the hull file", 0}, {NULL, 0}};

static const struct setting_word QUANTITIES[] = {{"wave-coefficient", QUANTITY_CW},
                                                 {"wave-resistance", QUANTITY_WAVE},
                                                 {"total-resistance", QUANTITY_TOTAL},
                                                 {NULL, 0}};
#define OF_GRID(k) QUANTITY_PARTICULAR + (k)
static const struct setting_word OTHERS[] = {{"none", QUANTITY_NONE},
                                             {"wave-coefficient", QUANTITY_CW},
                                             {"wave-resistance", QUANTITY_WAVE},
                                             {"total-resistance", QUANTITY_TOTAL},
                                             {"pressure-coefficient", QUANTITY_PRESSURE},
                                             {"displacement", QUANTITY_DISPLACEMENT},
                                             {"command", QUANTITY_COMMAND},
                                             {"surface", OF_GRID(0)},
                                             {"beam", OF_GRID(1)},
                                             {"lcb", OF_GRID(2)},
                                             {"km", OF_GRID(3)},
                                             {"gm", OF_GRID(4)},
                                             {"midship", OF_GRID(5)},
                                             {"waterplane", OF_GRID(6)},
                                             {"transom_breadth", OF_GRID(7)},
                                             {"transom_depth", OF_GRID(8)},
                                             {"waterlines", OF_GRID(9)},
                                             {"sections", OF_GRID(10)},
                                             {"radius", OF_GRID(11)},
                                             {"waterlines_energy", OF_GRID(12)},
                                             {"sections_energy", OF_GRID(13)},
                                             {NULL, 0}};
static const struct setting_word OWN_SPEED[] = {{"flow.froude", NAN}, {NULL, 0}};

static const struct setting_word SURFACES[] = {{"rest", 0}, {"running", 1}, {NULL, 0}};
static const struct setting_word SPACES[] = {{"latent", 0}, {"parameters", 1}, {NULL, 0}};

static const char *formulation(int value)
{
    return igabem_formulation_name((igabem_formulation)value);
}

static const char *design(int value)
{
    return value == CONFIG_DESIGN_FORECAST ? "forecast"
           : value > BAYESOPT_DESIGN_STLBO ? NULL
                                           : bayesopt_design_name((bayesopt_design_kind)value);
}

static const char *strategy(int value)
{
    return value > BAYESOPT_STRATEGY_LOCAL ? NULL
                                           : bayesopt_strategy_name((bayesopt_strategy)value);
}

static const char *method(int value)
{
    return method_row(value) ? method_row(value)->name : NULL;
}

#define ROW(...) SETTING_ROW(struct config, __VA_ARGS__)

/* Least and most of a particular. */
#define PARTICULAR(place, name, meaning)                                                           \
    ROW("constraints." name, NUMBER, particular[(size_t)(place)], meaning, SETTING_FROM(-10, 1e3), \
        .n_least = 2, .n_most = 2, .words = NONE, .otherwise = "none")

/* One that stands beside objective.quantity: designs of the Pareto set are looked for. */
#define OBJECTIVE(name, place)                                                                     \
    ROW(name ".quantity", CHOICE, other[place].quantity,                                           \
        "another objective, so that the Pareto set is looked for: a quantity as above, or a "      \
        "figure of the hull by the name of its constraint",                                        \
        .words = OTHERS, .otherwise = "none"),                                                     \
        ROW(name ".froude", NUMBER, other[place].froude,                                           \
            "its speed, flow.froude or one of verification.froude", SETTING_INSIDE(0, 10),         \
            .words = OWN_SPEED, .otherwise = "flow.froude"),                                       \
        ROW(name ".maximise", SWITCH, other[place].maximise, "it is raised instead of lowered",    \
            .otherwise = "false"),                                                                 \
        ROW(name ".key", TEXT, other[place].key,                                                   \
            "of a command's number, what stands before it in what objective.command prints",       \
            .otherwise = NULL)

static const struct setting ROWS[] = {
    ROW("name", TEXT, name, "title of the report", .otherwise = "Hull form optimisation"),
    ROW("hull", FILE, hull, "the hull: any file that nurbs reads", .otherwise = NULL),
    ROW("shape", FILE, shape, "how it may be modified", .otherwise = NULL),
    ROW("parameters.command", TEXT, maker.command,
        "in place of hull and shape: what makes the hull of the parameters, {name} for each, in a "
        "folder of its own; {here}: the folder of this file",
        .otherwise = NULL),
    ROW("parameters.file", TEXT, maker.file, "the hull that it writes there",
        .otherwise = "hull.json"),
    ROW("parameters.names", TEXT, parameter, "of the parameters", .n_most = CONFIG_PARAMETERS_MOST,
        .count = offsetof(struct config, n_parameters)),
    ROW("parameters.original", NUMBER, original, "their values in the original",
        .n_most = CONFIG_PARAMETERS_MOST, .count = offsetof(struct config, n_original)),
    ROW("parameters.lower", NUMBER, lower, "and from what", .n_most = CONFIG_PARAMETERS_MOST,
        .count = offsetof(struct config, n_lower)),
    ROW("parameters.upper", NUMBER, upper, "to what they may go", .n_most = CONFIG_PARAMETERS_MOST,
        .count = offsetof(struct config, n_upper)),
    ROW("parameters.snapshots", COUNT, snapshots,
        "hulls of the command whose latent space is searched, by latent.variance; 0: the "
        "parameters are searched themselves",
        SETTING_FROM(0, 1e5), .otherwise = "0"),
    ROW("parameters.timeout", NUMBER, maker.timeout, "s after which the design has failed",
        SETTING_ABOVE(0), .otherwise = "600"),
    ROW("folder", TEXT, folder,
        "where commands work, a numbered folder each time; relative to the folder of this file",
        .otherwise = "evaluations"),
    ROW("placement.draft", NUMBER, draft,
        "at the keel amidships, m, which sets the still water; else it is z = 0 of the file",
        SETTING_ABOVE(0), .words = NONE, .otherwise = "none"),
    ROW("placement.trim", NUMBER, trim, "degrees, bow up, about the middle of the waterline",
        SETTING_INSIDE(-10, 10), .otherwise = "0"),
    ROW("grid.sections", COUNT, sections, "points of the design grid along the hull",
        SETTING_FROM(4, 2000), .words = AS_IN_FILE, .otherwise = "0"),
    ROW("grid.girth", COUNT, girth, "and around it", SETTING_FROM(4, 2000), .words = AS_IN_FILE,
        .otherwise = "as in the hull file"),
    ROW("latent.samples", COUNT, samples, "of the shape, from which the latent space is found",
        SETTING_FROM(2, 1e7), .otherwise = "9000"),
    ROW("latent.seed", COUNT, latent_seed, "of the samples", .otherwise = "1"),
    ROW("latent.variance", NUMBER, variance,
        "share of the geometric variance to retain; 1: as many variables as parameters",
        SETTING_FROM(0, 1), .open_least = true, .otherwise = "0.95"),
    ROW("reconstruction.tolerance", NUMBER, tolerance,
        "distance of the simplified patch from the hull, share of the length",
        SETTING_INSIDE(0, 0.1), .otherwise = "1e-4"),
    ROW("constraints.displacement", NUMBER, displacement, "largest relative change of the volume",
        SETTING_INSIDE(0, 1), .words = NONE, .otherwise = "none"),
    ROW("constraints.breadth", NUMBER, breadth,
        "least share of its half breadth that a wet point keeps", SETTING_INSIDE(0, 1),
        .words = NONE, .otherwise = "none"),
    ROW("constraints.entrance", NUMBER, entrance, "steepest waterline over that of the original",
        SETTING_INSIDE(1, 10), .words = NONE, .otherwise = "none"),
    ROW("constraints.pressure", NUMBER, pressure,
        "resistance by pressure over that of the original", SETTING_INSIDE(0, 10), .words = NONE,
        .otherwise = "none"),
    ROW("constraints.speeds", NUMBER, speeds,
        "C_w over that of the original at each of verification.froude", SETTING_INSIDE(0, 10),
        .words = NONE, .otherwise = "none"),
    PARTICULAR(0, "surface", "wetted surface, over that of the original"),
    PARTICULAR(1, "beam", "beam at the waterline, likewise"),
    PARTICULAR(2, "lcb", "shift of the centre of buoyancy, share of the length, forward positive"),
    PARTICULAR(3, "km", "metacentre above the keel, over the original's"),
    PARTICULAR(4, "gm", "metacentric height for constraints.kg, likewise"),
    PARTICULAR(5, "midship", "largest section over beam and draft, likewise"),
    PARTICULAR(6, "waterplane", "waterplane over length and beam, likewise"),
    PARTICULAR(7, "transom_breadth", "at the waterline, likewise"),
    PARTICULAR(8, "transom_depth", "of its lowest point, likewise"),
    PARTICULAR(9, "waterlines", "their turning, likewise: what inflections add to"),
    PARTICULAR(10, "sections", "their turning, likewise"),
    PARTICULAR(11, "radius", "least radius of the waterlines, likewise"),
    PARTICULAR(12, "waterlines_energy", "integral of their squared curvature, likewise"),
    PARTICULAR(13, "sections_energy", "likewise"),
    PARTICULAR(14, "waterlines_inflections", "their number, likewise; not by a descent"),
    PARTICULAR(15, "sections_inflections", "likewise"),
    PARTICULAR(16, "stations",
               "half breadths of the waterline at constraints.at_stations, likewise"),
    PARTICULAR(17, "hard", "half breadths at constraints.at_points, likewise"),
    PARTICULAR(18, "boxes", "half breadths at constraints.at_boxes over theirs"),
    ROW("constraints.kg", NUMBER, kg, "centre of gravity above the deepest point, m",
        SETTING_FROM(0, 1e3), .words = NONE, .otherwise = "none"),
    ROW("constraints.at_stations", NUMBER, station, "x, m, for constraints.stations",
        .n_most = CONFIG_PLACES_MOST, .count = offsetof(struct config, stations)),
    ROW("constraints.at_points", NUMBER, hard_point, "x and z of each, m, for constraints.hard",
        .n_most = CONFIG_PLACES_MOST, .count = offsetof(struct config, hard_points)),
    ROW("constraints.at_boxes", NUMBER, box,
        "x from and to, half breadth, z from and to of each, m, for constraints.boxes",
        .n_most = CONFIG_PLACES_MOST, .count = offsetof(struct config, boxes)),
    ROW("flow.froude", NUMBER, solver.froude, "U/sqrt(g L)", SETTING_INSIDE(0, 10),
        .required = true),
    ROW("flow.gravity", NUMBER, solver.gravity, "m/s^2", SETTING_ABOVE(0)),
    ROW("flow.density", NUMBER, solver.density, "kg/m^3", SETTING_ABOVE(0)),
    ROW("flow.free_to_trim", SWITCH, free_to_trim,
        "each design at the sinkage and trim of each speed, by solver.formulation; else held",
        .otherwise = "false"),
    ROW("flow.viscosity", NUMBER, viscosity,
        "kinematic, m^2/s, for the total resistance by ITTC-57", SETTING_ABOVE(0),
        .otherwise = "1.1386e-6"),
    ROW("flow.form_factor", NUMBER, form_factor, "k of C_t = (1 + k) C_f + C_w", SETTING_FROM(0, 2),
        .otherwise = "0"),
    ROW("objective.quantity", CHOICE, quantity,
        "what is lowered: C_w, or the resistance of waves or of the ship, N", .words = QUANTITIES,
        .otherwise = "wave-coefficient"),
    ROW("objective.surface", CHOICE, running_surface,
        "wetted surface of the friction: at rest, or as the design floats by flow.free_to_trim",
        .words = SURFACES, .otherwise = "rest"),
    ROW("objective.weights", NUMBER, weight,
        "of its values at flow.froude and at each of verification.froude", SETTING_FROM(0, 1e6),
        .n_most = 1 + CONFIG_FROUDE_MOST, .count = offsetof(struct config, weights)),
    ROW("objective.command", TEXT, judge.command,
        "what prints the number that is lowered instead, of the hull in the file {hull}; in a "
        "folder of its own",
        .otherwise = NULL),
    ROW("objective.file", TEXT, judge.file,
        "name of {hull}; its end says how it is written: .igs, .step, .json, .stl",
        .otherwise = "hull.igs"),
    ROW("objective.key", TEXT, judge.key,
        "what stands before the number; by default it is the last one printed", .otherwise = NULL),
    ROW("objective.timeout", NUMBER, judge.timeout, "s after which the design has failed",
        SETTING_ABOVE(0), .otherwise = "3600"),
    OBJECTIVE("objective_2", 0),
    OBJECTIVE("objective_3", 1),
    ROW("solver.formulation", CHOICE, solver.formulation, "what is solved", .choice = formulation),
    ROW("solver.refine", INTEGER, solver.refine, "parts of every knot span", SETTING_FROM(1, 16),
        .otherwise = "1"),
    ROW("solver.degree", INTEGER, solver.degree, "least degree of the density", SETTING_FROM(1, 9)),
    ROW("solver.line_term", SWITCH, solver.line_term, "Brard's waterline integral",
        .size = sizeof(int)),
    ROW("solver.elements_u", INTEGER, solver.elements_u,
        "spans of the density's own knots along the hull; 0: those of the patch",
        SETTING_FROM(0, 1000), .words = AUTO),
    ROW("solver.elements_v", INTEGER, solver.elements_v, "and around it", SETTING_FROM(0, 1000),
        .words = AUTO),
    ROW("solver.cutoff_angle", NUMBER, solver.cutoff_angle,
        "tangent of the angle of the short-wave filter", SETTING_ABOVE(0), .words = BY_RULE),
    ROW("solver.cutoff_factor", NUMBER, solver.cutoff_factor,
        "that angle times nu_s of the entrance, where it is by rule", SETTING_ABOVE(0)),
    ROW("solver.stem_limit", NUMBER, solver.stem_limit,
        "slope of the waterline at which the line term fades", SETTING_ABOVE(0), .words = BY_RULE),
    ROW("solver.stern_length", NUMBER, solver.stern_length,
        "of the stern that sees the double body only, share of the length", SETTING_FROM(0, 1),
        .words = BY_RULE),
    ROW("solver.stern_blend", NUMBER, solver.stern_blend,
        "width of the switch there, share of the length", SETTING_INSIDE(0, 1)),
    ROW("solver.spectrum_limit", NUMBER, solver.spectrum_limit,
        "largest tangent of the Kochin integral", SETTING_ABOVE(1)),
    ROW("solver.surface_cells", NUMBER, solver.surface_cells,
        "of exterior, cells of the free surface along the hull", SETTING_FROM(4, 1000),
        .words = SURFACE),
    ROW("solver.surface_first", NUMBER, solver.surface_first,
        "of exterior, width of its first row over the length of a cell: wider follows steeper "
        "waterlines",
        SETTING_FROM(0.1, 10), .words = SURFACE),
    ROW("solver.tolerance", NUMBER, solver.tolerance, "relative error asked of the quadrature",
        SETTING_INSIDE(0, 0.1)),
    ROW("search.method", CHOICE, method, "how the best design is looked for", .choice = method,
        .otherwise = "bayesian"),
    ROW("search.space", CHOICE, space,
        "latent variables, or the parameters of the shape themselves", .words = SPACES,
        .otherwise = "latent"),
    ROW("search.models", CHOICE, model,
        "formulations besides solver.formulation: what counts is the worst of them",
        .choice = formulation, .n_most = CONFIG_MODELS_MOST,
        .count = offsetof(struct config, models)),
    ROW("search.confirm", NUMBER, confirm,
        "share of the gain of solver.formulation that each of search.models must see instead",
        SETTING_INSIDE(0, 1), .words = NONE, .otherwise = "none"),
    ROW("search.initial", COUNT, initial, "designs before the first proposal", SETTING_FROM(2, 1e5),
        .otherwise = "200"),
    ROW("search.iterations", COUNT, iterations, "proposals after them", SETTING_FROM(0, 1e5),
        .otherwise = "100"),
    ROW("search.design", CHOICE, design, "kind of the initial design", .choice = design,
        .otherwise = "stlbo"),
    ROW("search.strategy", CHOICE, strategy, "which steps follow it", .choice = strategy,
        .otherwise = "auto"),
    ROW("search.seed", COUNT, search_seed, "of the search", .otherwise = "1"),
    ROW("verification.refine", INTEGER, verify_refine,
        "factor of the resolution; 1: none, 0: no verification at all", SETTING_FROM(0, 16),
        .otherwise = "2"),
    ROW("verification.froude", NUMBER, verify_froude, "other speeds", SETTING_INSIDE(0, 10),
        .n_most = CONFIG_FROUDE_MOST, .count = offsetof(struct config, verify_froudes)),
    ROW("waves.along", COUNT, waves_along, "points of the wave patterns along the ship",
        SETTING_FROM(2, 5000), .otherwise = "221"),
    ROW("waves.across", COUNT, waves_across, "and across", SETTING_FROM(2, 5000),
        .otherwise = "66"),
};

/* Bounds in order, and places where some are asked for. */
static void check_places(struct settings_source *source, const struct config *c)
{
    const struct {
        size_t particular;
        const char *key, *needs;
        size_t n, each;
    } list[] = {{16, "constraints.stations", "constraints.at_stations", c->stations, 1},
                {17, "constraints.hard", "constraints.at_points", c->hard_points, 2},
                {18, "constraints.boxes", "constraints.at_boxes", c->boxes, 5},
                {4, "constraints.gm", "constraints.kg", (size_t)!isnan(c->kg), 1}};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        if (!isnan(c->particular[list[i].particular][0]) && !list[i].n)
            settings_complain(source, list[i].key, "needs %s", list[i].needs);
        if (list[i].n % list[i].each)
            settings_complain(source, list[i].needs, "has %zu numbers, expected %zu for each",
                              list[i].n, list[i].each);
    }
    if (method_row(c->method)->kind == METHOD_DESCENT &&
        !(isnan(c->particular[14][0]) && isnan(c->particular[15][0])))
        settings_complain(source, "constraints.waterlines_inflections",
                          "is a number without derivatives, which gauss-newton cannot keep: bound "
                          "the turning and the energy");
    for (size_t i = 0; i < PARTICULARS; i++)
        if (c->particular[i][0] > c->particular[i][1])
            settings_complain(source, "constraints", "has a least of %g above a most of %g",
                              c->particular[i][0], c->particular[i][1]);
}

/* The derivatives of the descent are those of a sum of squares at one speed. */
static void check_objective(struct settings_source *source, const struct config *c)
{
    double sum = 0;
    for (size_t j = 0; j < c->weights; j++)
        sum += c->weight[j];
    if (c->weights && c->weights != 1 + c->verify_froudes)
        settings_complain(source, "objective.weights",
                          "has %zu numbers, expected %zu: flow.froude and verification.froude",
                          c->weights, 1 + c->verify_froudes);
    else if (c->weights && !(sum > 0))
        settings_complain(source, "objective.weights", "are all 0");
    bool descent = method_row(c->method)->kind == METHOD_DESCENT;
    if (c->weights && descent)
        settings_complain(source, "objective.weights", "is not for %s, which lowers one speed's",
                          method_row(c->method)->name);
    if (c->quantity != QUANTITY_CW && !isnan(c->confirm) && descent)
        settings_complain(source, "search.confirm", "is about C_w, which alone it lowers with %s",
                          method_row(c->method)->name);
}

/* Whether a speed is one at which every design is, or can be, solved. */
static bool is_speed(const struct config *c, double froude)
{
    bool known = isnan(froude) || froude == c->solver.froude;
    for (size_t j = 0; j < c->verify_froudes && !known; j++)
        known = froude == c->verify_froude[j];
    return known;
}

static void check_other(struct settings_source *source, const struct config *c, const char *name,
                        const struct config_objective *o)
{
    char key[40];
    snprintf(key, sizeof key, "%s.quantity", name);
    const struct method_row *method = method_row(c->method);
    if (o->quantity == QUANTITY_NONE) {
        if (!isnan(o->froude) || o->maximise || o->key)
            settings_complain(source, key, "is missing: what the others of %s are about", name);
        return;
    }
    if (method->kind != METHOD_GAUSSIAN_PROCESS && method->kind != METHOD_DESIGN)
        settings_complain(
            source, key,
            "is not for %s, which lowers one number: expected bayesian, random or lhs "
            "in search.method",
            method->name);
    if (c->strategy == BAYESOPT_STRATEGY_LOCAL)
        settings_complain(source, key,
                          "is looked for over the whole box, not by search.strategy "
                          "local");
    if (o->quantity == QUANTITY_COMMAND && (!c->judge.command || !o->key))
        settings_complain(source, key, "is command, which needs objective.command and %s.key",
                          name);
    if (o->quantity == QUANTITY_PRESSURE &&
        !igabem_formulation_info(c->solver.formulation)->pressure)
        settings_complain(source, key, "is by pressure, which %s has not",
                          igabem_formulation_name(c->solver.formulation));
    if (o->quantity == OF_GRID(4) && isnan(c->kg))
        settings_complain(source, key, "is gm, which needs constraints.kg");
    snprintf(key, sizeof key, "%s.froude", name);
    if (o->quantity > QUANTITY_TOTAL && !isnan(o->froude))
        settings_complain(source, key, "is for a resistance, which %s.quantity is not", name);
    else if (!is_speed(c, o->froude))
        settings_complain(source, key,
                          "is %g, expected flow.froude or one of verification.froude, where every "
                          "design is solved then",
                          o->froude);
}

static void check_others(struct settings_source *source, const struct config *c)
{
    check_other(source, c, "objective_2", &c->other[0]);
    check_other(source, c, "objective_3", &c->other[1]);
    if (c->other[1].quantity != QUANTITY_NONE && c->other[0].quantity == QUANTITY_NONE)
        settings_complain(source, "objective_3.quantity", "is given without objective_2.quantity");
}

static bool is_field(const char *name, size_t length, const char *field)
{
    return strlen(field) == length && strncmp(name, field, length) == 0;
}

bool config_field(void *user_data, const char *name, size_t length, FILE *out)
{
    const struct config_fields *f = user_data;
    size_t k = 0;
    while (k < f->config->n_parameters && !is_field(name, length, f->config->parameter[k]))
        k++;
    bool parameter = k < f->config->n_parameters, here = is_field(name, length, "here");
    bool hull = f->hull && is_field(name, length, "hull");
    if (out && parameter)
        fprintf(out, "%.17g", f->x[k]);
    else if (out && (here || hull))
        fputs(here ? f->here : f->hull, out);
    return parameter || here || hull;
}

static void check_command(struct settings_source *source, const char *key,
                          const struct config_command *command, struct config_fields fields)
{
    size_t length;
    if (!command->command)
        return;
    const char *unknown =
        fields_unknown(command->command, strlen(command->command), config_field, &fields, &length);
    if (unknown)
        settings_complain(source, key, "has %.*s, expected {here}%s%s", (int)length, unknown,
                          fields.hull ? ", {hull}" : "",
                          fields.config->n_parameters ? " and the names of parameters" : "");
    if (!command->file || !*command->file || strchr(command->file, '/'))
        settings_complain(source, key, "needs a file, a name without folders");
}

/* A name is a word, and one parameter's alone. */
static void check_names(struct settings_source *source, const struct config *c)
{
    static const char key[] = "parameters.names", reserved[] = "is a word of its own";
    for (size_t k = 0; k < c->n_parameters; k++) {
        const char *name = c->parameter[k];
        size_t length = strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                     "0123456789_");
        if (!*name || name[length] || (*name >= '0' && *name <= '9'))
            settings_complain(source, key, "has '%s', expected letters, digits and _", name);
        if (strcmp(name, "here") == 0 || strcmp(name, "hull") == 0)
            settings_complain(source, key, "has '%s', which %s", name, reserved);
        for (size_t i = 0; i < k; i++)
            if (strcmp(name, c->parameter[i]) == 0)
                settings_complain(source, key, "has '%s' twice", name);
    }
}

/* Where the hull and its designs are from. */
static void check_hull(struct settings_source *source, const struct config *c)
{
    if (!c->maker.command) {
        if (!c->hull)
            settings_complain(source, "hull", "is missing: the hull's file, or parameters.command");
        if (!c->shape)
            settings_complain(source, "shape", "is missing: how the hull may be modified");
        if (c->n_parameters || c->snapshots)
            settings_complain(source, "parameters", "need parameters.command");
        return;
    }
    if (c->hull || c->shape)
        settings_complain(source, c->hull ? "hull" : "shape",
                          "is given, and so is parameters.command: expected one of them");
    if (!c->n_parameters || c->n_original != c->n_parameters || c->n_lower != c->n_parameters ||
        c->n_upper != c->n_parameters) {
        settings_complain(source, "parameters",
                          "have %zu names, %zu values of the original, %zu lower and %zu upper "
                          "ends, expected as many of each",
                          c->n_parameters, c->n_original, c->n_lower, c->n_upper);
        return;
    }
    check_names(source, c);
    for (size_t k = 0; k < c->n_parameters; k++)
        if (!(c->lower[k] < c->original[k] && c->original[k] < c->upper[k]))
            settings_complain(source, "parameters.original",
                              "has %g for %s, expected between %g and %g", c->original[k],
                              c->parameter[k], c->lower[k], c->upper[k]);
    if (config_by_command(c) &&
        (method_row(c->method)->kind == METHOD_DESCENT || c->design == CONFIG_DESIGN_FORECAST))
        settings_complain(source, "search",
                          "is by derivatives, which the hulls of a command have not: the latent "
                          "space of parameters.snapshots has them");
    if (c->snapshots && c->snapshots <= c->n_parameters)
        settings_complain(source, "parameters.snapshots",
                          "is %zu, expected more than the %zu "
                          "parameters",
                          c->snapshots, c->n_parameters);
    if (c->snapshots && c->space)
        settings_complain(source, "parameters.snapshots",
                          "are for search.space latent; without them the parameters are searched");
}

static void check_commands(struct settings_source *source, const struct config *c)
{
    check_hull(source, c);
    check_command(source, "parameters.command", &c->maker, (struct config_fields){.config = c});
    check_command(source, "objective.command", &c->judge,
                  (struct config_fields){.config = c, .hull = ""});
    if (c->judge.command && (c->weights || c->quantity != QUANTITY_CW || c->models))
        settings_complain(source, "objective.command",
                          "is lowered alone, without objective.quantity, objective.weights and "
                          "search.models");
    if (c->judge.command && method_row(c->method)->kind == METHOD_DESCENT)
        settings_complain(source, "objective.command", "is not for %s, which needs derivatives",
                          method_row(c->method)->name);
}

static void check_attitude(struct settings_source *source, const struct config *c)
{
    if (c->free_to_trim && !igabem_formulation_info(c->solver.formulation)->pressure)
        settings_complain(source, "flow.free_to_trim",
                          "needs the pressure on the hull, which %s has not",
                          igabem_formulation_name(c->solver.formulation));
    if (c->running_surface && !c->free_to_trim)
        settings_complain(source, "objective.surface", "is running, which needs flow.free_to_trim");
    if (c->free_to_trim &&
        (method_row(c->method)->kind == METHOD_DESCENT || c->design == CONFIG_DESIGN_FORECAST))
        settings_complain(source, "flow.free_to_trim",
                          "is not for searches by derivatives, which are those of a hull held at "
                          "rest");
}

static void check(struct settings_source *source, void *target)
{
    const struct config *c = target;
    check_commands(source, c);
    check_objective(source, c);
    check_others(source, c);
    for (size_t i = 0; i < c->models; i++)
        if (c->model[i] == IGABEM_FORMULATION_AUTO || c->model[i] == c->solver.formulation)
            settings_complain(source, "search.models", "is %s, expected others than %s",
                              igabem_formulation_name(c->model[i]),
                              c->model[i] ? "solver.formulation" : "auto");
    if (!isnan(c->speeds) && !c->verify_froudes)
        settings_complain(source, "constraints.speeds",
                          "needs a list of speeds in verification.froude");
    if (!isnan(c->confirm) && !c->models)
        settings_complain(source, "search.confirm", "needs search.models");
    check_places(source, c);
    check_attitude(source, c);
    if (!isnan(c->pressure) && !igabem_formulation_info(c->solver.formulation)->pressure)
        settings_complain(source, "constraints.pressure",
                          "needs a resistance by pressure, which %s has not",
                          igabem_formulation_name(c->solver.formulation));
}

const struct settings CONFIG = {sizeof ROWS / sizeof *ROWS, ROWS, .check = check};

bool config_by_command(const struct config *config)
{
    return config->maker.command && !config->snapshots;
}

/* For messages: the original of a command has no file. */
static void name_hull(struct config *config)
{
    if (!config->maker.command)
        return;
    free(config->hull);
    free(config->shape);
    config->hull = cli_needed(strdup("parameters.command"));
    config->shape = cli_needed(strdup("parameters.command"));
}

bool config_read(const char *path, const struct config_overrides *overrides, struct config *config)
{
    *config = (struct config){.path = cli_needed(strdup(path))};
    igabem_options_init(&config->solver);
    settings_start(&CONFIG, config);
    bool ok = settings_read(path, &CONFIG, config);
    if (overrides && overrides->initial >= 0)
        config->initial = (size_t)overrides->initial;
    if (overrides && overrides->iterations >= 0)
        config->iterations = (size_t)overrides->iterations;
    ok = ok && ((config->text = settings_text(&CONFIG, config)) != NULL ||
                cli_refuse("%s: an input file cannot be read", path));
    if (ok)
        name_hull(config);
    if (!ok)
        config_free(config);
    return ok;
}

bool config_restore(const char *text, struct config *config)
{
    size_t line;
    *config = (struct config){.text = cli_needed(strdup(text))};
    igabem_options_init(&config->solver);
    settings_start(&CONFIG, config);
    bool ok = settings_restore(&CONFIG, text, config, &line);
    if (ok)
        name_hull(config);
    else
        config_free(config);
    return ok;
}

void config_free(struct config *config)
{
    settings_free(&CONFIG, config);
    free(config->path);
    free(config->text);
    *config = (struct config){0};
}

bool config_difference(const char *a, const char *b, const char *const sides[2], char *sentence,
                       size_t size)
{
    while (*a || *b) {
        size_t m = strcspn(a, "\n"), n = strcspn(b, "\n");
        if (m != n || memcmp(a, b, m) != 0) {
            snprintf(sentence, size, "%s '%.*s', %s '%.*s'", sides[0], (int)m, a, sides[1], (int)n,
                     b);
            return true;
        }
        a += m + (a[m] == '\n');
        b += n + (b[n] == '\n');
    }
    return false;
}
