/* The options of `igabem solve`: one row each. */
#include "cli.h"
#include "plot/plot.h"
#include "settings.h"
#include "solve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of --formulation, after the names of the table. */
static const char every[] = "all";

static const char *choose_formulation(int value)
{
    const char *name = igabem_formulation_name((igabem_formulation)value);
    bool last = !name && value > 0 && igabem_formulation_name((igabem_formulation)(value - 1));
    return last ? every : name;
}

static const struct setting_word KERNELS[] = {{"kelvin", IGABEM_KERNEL_KELVIN},
                                              {"double-body", IGABEM_KERNEL_DOUBLE_BODY},
                                              {"rankine", IGABEM_KERNEL_RANKINE},
                                              {NULL, 0}};
static const struct setting_word SOLVERS[] = {{"auto", IGABEM_SOLVER_AUTO},
                                              {"lu", IGABEM_SOLVER_LU},
                                              {"gmres", IGABEM_SOLVER_GMRES},
                                              {NULL, 0}};
static const struct setting_word BY_MESH[] = {{"by rule", 0}, {NULL, 0}};
static const struct setting_word LIKE_REFINE[] = {{"like --refine", 0}, {NULL, 0}};
static const struct setting_word ELEMENTS[] = {{"none", 0}, {"by rule", -1}, {NULL, 0}};
static const struct setting_word BY_RULE[] = {{"by rule", NAN}, {NULL, 0}};
static const struct setting_word FILTER[] = {{"none", INFINITY}, {"by rule", NAN}, {NULL, 0}};
static const struct setting_word NO_LADDER[] = {{"none", 1}, {NULL, 0}};

#define ROW(...) HULL_ROW(struct solve_request, __VA_ARGS__)
#define HEADING(text)                                                                              \
    {                                                                                              \
        .type = SETTING_HEADING, .sentence = (text)                                                \
    }
#define RESOLUTION .given = offsetof(struct solve_request, resolution_given)
#define INT_SWITCH .size = sizeof(int)

static const struct setting ROWS[] = {
    HULL_FILE_ROW(struct solve_request, hull),
    ROW("fr", NUMBERS, fr,
        .sentence = "Froude number on the reference length: 0.35, 0.2,0.3 or 0.2:0.45:0.01",
        SETTING_ABOVE(0), .count = offsetof(struct solve_request, n_fr)),
    ROW("formulation", CHOICE, formulation, .sentence = "what is solved; auto chooses by the hull",
        .choice = choose_formulation),
    ROW("kernel", CHOICE, options.kernel, .sentence = "Green function", .words = KERNELS),
    ROW("refine", INTEGER, options.refine,
        .sentence =
            "split every knot span of the hull in so many; without this, --refine-v and --elements "
            "about "
            "400 unknowns at least",
        SETTING_FROM(1, 64), .words = BY_MESH, RESOLUTION),
    ROW("refine-v", INTEGER, options.refine_v, .sentence = "the same around the hull only",
        SETTING_FROM(1, 64), .words = LIKE_REFINE, RESOLUTION),
    ROW("elements", INTEGER, elements,
        .sentence =
            "the density on uniform knots of its own, N spans along the hull and M around its half "
            "girth, shared among the patches by their length; by rule as many as the hull has if "
            "its "
            "spans are uneven",
        SETTING_FROM(1, 1000), .n_least = 2, .n_most = 2, .words = ELEMENTS, RESOLUTION),
    ROW("waterline-span", NUMBER, options.waterline_span,
        .sentence =
            "least width of such spans at the waterline, share of the half girth; 0: uniform",
        SETTING_FROM(0, 0.5)),
    ROW("degree", INTEGER, options.degree, .sentence = "least degree of the source density",
        SETTING_FROM(1, 9)),
    ROW("tolerance", NUMBER, options.tolerance,
        .sentence = "relative error asked of the quadrature", SETTING_FROM(1e-12, 1e-2)),
    ROW("surface-cells", NUMBER, options.surface_cells,
        .sentence = "of exterior and double-model: cells of the free surface along the hull; by "
                    "rule 48, over a "
                    "submerged one 24",
        SETTING_FROM(4, 1000), .words = BY_MESH),
    ROW("solver", CHOICE, options.solver, .sentence = "auto: gmres from 1000 unknowns on",
        .words = SOLVERS),
    ROW("ladder", INTEGER, ladder,
        .sentence = "so many levels from --refine on, each half as fine again: orders and "
                    "Richardson's value",
        SETTING_FROM(2, 16), .words = NO_LADDER),
    ROW("no-sensitivity", SWITCH, options.sensitivity,
        .sentence = "without C_w at 0.85 and 1.15 of the cut-off angle (5 % faster)", INT_SWITCH),
    ROW("free-to-trim", SWITCH, free_to_trim,
        .sentence = "at the sinkage and trim of equilibrium (one Froude number); the file must "
                    "reach above the "
                    "water"),
    ROW("survey", SWITCH, survey,
        .sentence = "also C_w by a wave cut, and the shares of bow, middle and stern"),

    HEADING("Formulation (by rule: from the hull; docs/theory.md):"),
    ROW("cutoff", NUMBER, options.cutoff_angle,
        .sentence = "t_c = tan(angle) of the short-wave filter", SETTING_ABOVE(0), .words = FILTER),
    ROW("cutoff-factor", NUMBER, options.cutoff_factor, .sentence = "by rule t_c is this over nu_s",
        SETTING_ABOVE(0)),
    ROW("stem-limit", NUMBER, options.stem_limit, .sentence = "limiter of the line term at stems",
        SETTING_ABOVE(0), .words = FILTER),
    ROW("no-line-term", SWITCH, options.line_term, .sentence = "without Brard's waterline integral",
        INT_SWITCH),
    ROW("x-s", NUMBER, x_s,
        .sentence =
            "rows aft of x = X m see the double body only (neumann-kelvin-stern); by rule as "
            "--stern-length says",
        .words = BY_RULE),
    ROW("stern-length", NUMBER, options.stern_length,
        .sentence =
            "the same as a share of the length; by rule 0.35, below Fr 0.35 times (Fr/0.35)^2",
        SETTING_FROM(0, 1), .words = BY_RULE),
    ROW("stern-blend", NUMBER, options.stern_blend,
        .sentence = "width of the switch there as a share of the length", SETTING_FROM(0, 1)),
    ROW("spectrum-limit", NUMBER, options.spectrum_limit,
        .sentence = "largest wave angle of the resistance integral", SETTING_ABOVE(0)),

    HEADING("Hull and water:"),
    HULL_WATER_ROWS(struct solve_request, hull),
    ROW("gravity", NUMBER, options.gravity, .sentence = "m/s^2", SETTING_ABOVE(0)),
    ROW("density", NUMBER, options.density, .sentence = "kg/m^3", SETTING_ABOVE(0)),
    ROW("viscosity", NUMBER, viscosity, .sentence = "m^2/s, for the total resistance by ITTC-57",
        SETTING_ABOVE(0)),
    ROW("form-factor", NUMBER, form_factor, .sentence = "k of C_t = (1 + k) C_f + C_w"),

    HEADING("Files (of the finest level; with several Froude numbers, of the last one):"),
    ROW("vtu", TEXT, vtu,
        .sentence = "hull with velocity, pressure coefficient and source density"),
    ROW("waves", TEXT, waves,
        .sentence =
            "wave elevation on a grid (of exterior: its own): .csv or .vtu, or its picture: "
            ".svg .png .pdf"),
    ROW("waves-grid", COUNT, waves_grid, .sentence = "points along and across",
        SETTING_FROM(2, 1e5), .n_least = 2, .n_most = 2),
    ROW("waves-box", NUMBER, waves_box,
        .sentence = "A,B,C,D: x from A to B, y from C to D, in lengths from the fore end",
        .n_least = 4, .n_most = 4),
    ROW("spectrum", TEXT, spectrum, .sentence = "Kochin function and d C_w/d t against t: .csv"),
    ROW("plot", TEXT, plot,
        .sentence = "C_w against Froude number; by pressure dashed, 0.85 to 1.15 t_c shaded: .svg "
                    ".png .pdf"),
    ROW("pressure-plot", TEXT, pressure_plot,
        .sentence = "C_p on the side and the bottom of the hull: .svg .png .pdf"),

    HEADING("Output:"),
    HULL_JSON_ROW(struct solve_request, json),
};

/* What the Kelvin kernel alone has. */
static void check_kernel(struct settings_source *source, const struct solve_request *r)
{
    bool kelvin = r->options.kernel == IGABEM_KERNEL_KELVIN;
    if (kelvin && r->n_fr == 0)
        settings_complain(source, "fr", "is missing: %s", ROWS[1].sentence);
    if (!kelvin && strcmp(choose_formulation(r->formulation), every) == 0)
        settings_complain(source, "formulation",
                          "is all, which compares wave resistances, expected --kernel kelvin");
    if (!kelvin && r->waves)
        settings_complain(source, "waves", "needs a free surface, expected --kernel kelvin");
    if (r->free_to_trim && (!kelvin || r->n_fr != 1))
        settings_complain(source, "free-to-trim", "expects --kernel kelvin and one Froude number");
}

static void check(struct settings_source *source, void *target)
{
    const struct solve_request *r = target;
    check_kernel(source, r);
    if (!(r->waves_box[0] < r->waves_box[1] && r->waves_box[2] < r->waves_box[3]))
        settings_complain(source, "waves-box",
                          "is %g,%g,%g,%g, expected A,B,C,D with A < B and C < D", r->waves_box[0],
                          r->waves_box[1], r->waves_box[2], r->waves_box[3]);
}

static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS, .check = check,
    .usage =
        "usage: igabem solve HULL --fr F [OPTION]...\n"
        "\n"
        "Steady wave resistance of a hull by isogeometric collocation of Kelvin sources.\n"
        "HULL: a NURBS file (.json, .igs). A hull that crosses the still water is cut there and\n"
        "simplified; wetted or submerged patches are used as they are. Half hulls have y >= "
        "0.\n\n"};

/* From the options as they were read to what is solved. */
static int complete(struct solve_request *r)
{
    r->hull.unbounded = r->options.kernel == IGABEM_KERNEL_RANKINE;
    r->options.elements_u = r->elements[0];
    r->options.elements_v = r->elements[1];
    if (r->resolution_given && r->options.refine == 0)
        r->options.refine = 1;
    r->all = strcmp(choose_formulation(r->formulation), every) == 0;
    if (!r->all)
        r->options.formulation = (igabem_formulation)r->formulation;
    if ((r->plot && !plot_check_path("--plot", r->plot)) ||
        (r->pressure_plot && !plot_check_path("--pressure-plot", r->pressure_plot)))
        return CLI_USAGE;
    if (r->n_fr == 0) { /* other kernels: one result without a Froude number */
        r->fr = malloc(sizeof *r->fr);
        if (!r->fr)
            return cli_fail("out of memory");
        r->fr[0] = NAN;
        r->n_fr = 1;
    }
    return -1;
}

int solve_parse(int argc, char **argv, struct solve_request *request)
{
    *request = (struct solve_request){.ladder = 1,
                                      .x_s = NAN,
                                      .viscosity = 1.1386e-6,
                                      .waves_grid = {200, 60},
                                      .waves_box = {-3.0, 0.25, 0.0, 1.0}};
    hull_request_init(&request->hull);
    igabem_options_init(&request->options);
    request->options.sensitivity = 1;
    request->elements[0] = request->options.elements_u;
    request->elements[1] = request->options.elements_v;
    settings_start(&TABLE, request);
    int code = settings_options(argc, argv, &TABLE, request, NULL, NULL);
    return code < 0 ? complete(request) : code;
}

void solve_request_free(struct solve_request *request)
{
    settings_free(&TABLE, request);
}
