#include "cli.h"
#include "plot/plot.h"
#include "solve.h"

#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: igabem solve HULL --fr F [OPTION]...\n"
    "\n"
    "Steady wave resistance of a hull by isogeometric collocation of Kelvin sources.\n"
    "HULL: a NURBS file (.json, .igs). A hull that crosses the still water is cut there and\n"
    "simplified; wetted or submerged patches are used as they are. Half hulls have y >= 0.\n"
    "\n"
    "  --fr F              Froude number on the reference length: 0.35, 0.2,0.3 or 0.2:0.45:0.01\n"
    "  --formulation NAME  auto, neumann-kelvin, neumann-kelvin-stern, double-body-kochin,\n"
    "                      hogner, michell, or all (auto)\n"
    "  --kernel NAME       kelvin, double-body or rankine (kelvin)\n"
    "  --refine K          split every knot span of the hull in K; --refine-v K around it only\n"
    "                      (without these and --elements: about 400 unknowns at least)\n"
    "  --elements N,M      the density on uniform knots of its own, N spans along the hull and M\n"
    "                      around its half girth, shared among the patches by their length (as\n"
    "                      many as the hull has if its spans are uneven), or none\n"
    "  --waterline-span F  least width of such spans at the waterline, share of the half girth;\n"
    "                      0: uniform (0.1)\n"
    "  --degree P          least degree of the source density (3)\n"
    "  --tolerance T       relative error asked of the quadrature (1e-5)\n"
    "  --solver NAME       auto, lu or gmres (auto: gmres from 1000 unknowns on)\n"
    "  --ladder N          N levels from --refine on, each half as fine again: orders and\n"
    "                      Richardson's value\n"
    "  --no-sensitivity    without C_w at 0.85 and 1.15 of the cut-off angle (5 % faster)\n"
    "  --free-to-trim      at the sinkage and trim of equilibrium (one Froude number); the file "
    "must\n"
    "                      reach above the water\n"
    "  --survey            also C_w by a wave cut, and the shares of bow, middle and stern\n"
    "\n"
    "Formulation (defaults by rule from the hull; docs/theory.md):\n"
    "  --cutoff T          t_c = tan(angle) of the short-wave filter, or none\n"
    "  --cutoff-factor F   t_c = F / nu_s (1.2)\n"
    "  --stem-limit NU     limiter of the line term at stems, or none\n"
    "  --no-line-term      without Brard's waterline integral\n"
    "  --x-s X             rows aft of x = X m see the double body only (neumann-kelvin-stern)\n"
    "  --stern-length F    the same as a share of the length (0.35, below Fr 0.35 times\n"
    "                      (Fr/0.35)^2)\n"
    "  --stern-blend F     width of the switch there as a share of the length (0.014)\n"
    "  --spectrum-limit T  largest wave angle of the resistance integral (20)\n"
    "\n"
    "Hull and water:\n"
    "  --length L          reference length, m (the file's, else the waterline's)\n"
    "  --level Z           z of the still water in the file (0); --draft T sets it by keel draft\n"
    "  --simplify TOL      knot removal tolerance over the length (1e-4 if the hull is cut), 0 "
    "none\n"
    "  --gravity G         m/s^2 (9.80665);  --density RHO kg/m^3 (1000)\n"
    "  --viscosity NU      m^2/s, for the total resistance by ITTC-57 (1.1386e-6)\n"
    "  --form-factor K     (0)\n"
    "\n"
    "Files (of the finest level; with several Froude numbers, of the last one):\n"
    "  --vtu FILE          hull with velocity, pressure coefficient and source density\n"
    "  --waves FILE        wave elevation on a grid: .csv or .vtu, or its picture: .svg .png .pdf\n"
    "  --waves-grid N,M    points along and across (200,60)\n"
    "  --waves-box A,B,C,D x from A to B, y from C to D, in lengths from the fore end "
    "(-3,0.25,0,1)\n"
    "  --spectrum FILE     Kochin function and d C_w/d t against t: .csv\n"
    "  --plot FILE         C_w against Froude number; by pressure dashed, 0.85 to 1.15 t_c "
    "shaded:\n"
    "                      .svg .png .pdf\n"
    "  --pressure-plot FILE  C_p on the side and the bottom of the hull: .svg .png .pdf\n"
    "\n"
    "  --json              one JSON object on standard output and nothing else\n"
    "  --threads N         threads to use\n"
    "  --help, --version\n"
    "\n"
    "Exit status: 0 success, 1 failure, 2 wrong usage.\n";

enum option_value {
    OPT_FR = 256,
    OPT_FORMULATION,
    OPT_KERNEL,
    OPT_REFINE,
    OPT_REFINE_V,
    OPT_DEGREE,
    OPT_TOLERANCE,
    OPT_SOLVER,
    OPT_LADDER,
    OPT_SENSITIVITY,
    OPT_NO_SENSITIVITY,
    OPT_FREE_TO_TRIM,
    OPT_SURVEY,
    OPT_CUTOFF,
    OPT_CUTOFF_FACTOR,
    OPT_STEM_LIMIT,
    OPT_NO_LINE_TERM,
    OPT_X_S,
    OPT_STERN_LENGTH,
    OPT_STERN_BLEND,
    OPT_SPECTRUM_LIMIT,
    OPT_LENGTH,
    OPT_LEVEL,
    OPT_DRAFT,
    OPT_SIMPLIFY,
    OPT_ELEMENTS,
    OPT_WATERLINE_SPAN,
    OPT_GRAVITY,
    OPT_DENSITY,
    OPT_VISCOSITY,
    OPT_FORM_FACTOR,
    OPT_VTU,
    OPT_WAVES,
    OPT_WAVES_GRID,
    OPT_WAVES_BOX,
    OPT_SPECTRUM,
    OPT_PLOT,
    OPT_PRESSURE_PLOT,
    OPT_JSON,
    OPT_THREADS,
    OPT_HELP,
    OPT_VERSION
};

static const struct option options[] = {
    {"fr", required_argument, NULL, OPT_FR},
    {"formulation", required_argument, NULL, OPT_FORMULATION},
    {"kernel", required_argument, NULL, OPT_KERNEL},
    {"refine", required_argument, NULL, OPT_REFINE},
    {"refine-v", required_argument, NULL, OPT_REFINE_V},
    {"degree", required_argument, NULL, OPT_DEGREE},
    {"tolerance", required_argument, NULL, OPT_TOLERANCE},
    {"solver", required_argument, NULL, OPT_SOLVER},
    {"ladder", required_argument, NULL, OPT_LADDER},
    {"sensitivity", no_argument, NULL, OPT_SENSITIVITY},
    {"no-sensitivity", no_argument, NULL, OPT_NO_SENSITIVITY},
    {"free-to-trim", no_argument, NULL, OPT_FREE_TO_TRIM},
    {"survey", no_argument, NULL, OPT_SURVEY},
    {"cutoff", required_argument, NULL, OPT_CUTOFF},
    {"cutoff-factor", required_argument, NULL, OPT_CUTOFF_FACTOR},
    {"stem-limit", required_argument, NULL, OPT_STEM_LIMIT},
    {"no-line-term", no_argument, NULL, OPT_NO_LINE_TERM},
    {"x-s", required_argument, NULL, OPT_X_S},
    {"stern-length", required_argument, NULL, OPT_STERN_LENGTH},
    {"stern-blend", required_argument, NULL, OPT_STERN_BLEND},
    {"spectrum-limit", required_argument, NULL, OPT_SPECTRUM_LIMIT},
    {"length", required_argument, NULL, OPT_LENGTH},
    {"level", required_argument, NULL, OPT_LEVEL},
    {"draft", required_argument, NULL, OPT_DRAFT},
    {"simplify", required_argument, NULL, OPT_SIMPLIFY},
    {"elements", required_argument, NULL, OPT_ELEMENTS},
    {"waterline-span", required_argument, NULL, OPT_WATERLINE_SPAN},
    {"gravity", required_argument, NULL, OPT_GRAVITY},
    {"density", required_argument, NULL, OPT_DENSITY},
    {"viscosity", required_argument, NULL, OPT_VISCOSITY},
    {"form-factor", required_argument, NULL, OPT_FORM_FACTOR},
    {"vtu", required_argument, NULL, OPT_VTU},
    {"waves", required_argument, NULL, OPT_WAVES},
    {"waves-grid", required_argument, NULL, OPT_WAVES_GRID},
    {"waves-box", required_argument, NULL, OPT_WAVES_BOX},
    {"spectrum", required_argument, NULL, OPT_SPECTRUM},
    {"plot", required_argument, NULL, OPT_PLOT},
    {"pressure-plot", required_argument, NULL, OPT_PRESSURE_PLOT},
    {"json", no_argument, NULL, OPT_JSON},
    {"threads", required_argument, NULL, OPT_THREADS},
    {"help", no_argument, NULL, OPT_HELP},
    {"version", no_argument, NULL, OPT_VERSION},
    {NULL, 0, NULL, 0},
};

static const char *option_name(int value)
{
    for (size_t i = 0; options[i].name; i++)
        if (options[i].val == value)
            return options[i].name;
    return "?";
}

/* Numbers with a lower bound that is itself allowed or not. */
static int number(int opt, double lower, bool inclusive, double *out)
{
    double value;
    if (!cli_parse_double(optarg, &value) || value < lower || (value == lower && !inclusive))
        return cli_usage("--%s: '%s', expected a number %s %g", option_name(opt), optarg,
                         inclusive ? ">=" : ">", lower);
    *out = value;
    return CLI_OK;
}

static int anywhere(int opt, double *out)
{
    if (!cli_parse_double(optarg, out))
        return cli_usage("--%s: '%s', expected a number", option_name(opt), optarg);
    return CLI_OK;
}

static int number_or_none(int opt, double *out)
{
    if (strcmp(optarg, "none") == 0) {
        *out = INFINITY;
        return CLI_OK;
    }
    return number(opt, 0.0, false, out);
}

static int integer(int opt, int lower, int upper, int *out)
{
    int value;
    if (!cli_parse_int(optarg, &value) || value < lower || value > upper)
        return cli_usage("--%s: '%s', expected an integer from %d to %d", option_name(opt), optarg,
                         lower, upper);
    *out = value;
    return CLI_OK;
}

static int parse_fr(struct solve_request *request)
{
    free(request->fr);
    request->fr = NULL;
    if (!cli_parse_list(optarg, &request->fr, &request->n_fr))
        return cli_usage("--fr: '%s', expected a number, a list a,b,c or a range a:b:step", optarg);
    for (size_t i = 0; i < request->n_fr; i++)
        if (!(request->fr[i] > 0))
            return cli_usage("--fr: %g, expected a Froude number > 0", request->fr[i]);
    return CLI_OK;
}

static int parse_formulation(struct solve_request *request)
{
    if (strcmp(optarg, "all") == 0) {
        request->all = true;
        return CLI_OK;
    }
    if (!igabem_formulation_parse(optarg, &request->options.formulation))
        return cli_usage("--formulation: there is no '%s'", optarg);
    return CLI_OK;
}

static int parse_solver(igabem_options *used)
{
    for (int k = IGABEM_SOLVER_AUTO; k <= IGABEM_SOLVER_GMRES; k++)
        if (strcmp(optarg, solve_solver_name((igabem_solver)k)) == 0) {
            used->solver = (igabem_solver)k;
            return CLI_OK;
        }
    return cli_usage("--solver: there is no '%s', expected auto, lu or gmres", optarg);
}

static int parse_kernel(struct solve_request *request)
{
    static const char *const names[] = {"kelvin", "double-body", "rankine"};
    for (int k = 0; k < 3; k++)
        if (strcmp(optarg, names[k]) == 0) {
            request->options.kernel = (igabem_kernel)k;
            return CLI_OK;
        }
    return cli_usage("--kernel: there is no '%s', expected kelvin, double-body or rankine", optarg);
}

static int parse_grid(struct solve_request *request)
{
    double *list = NULL;
    size_t n = 0;
    int ok = cli_parse_list(optarg, &list, &n) && n == 2 && list[0] >= 2 && list[1] >= 2 &&
             list[0] <= 1e5 && list[1] <= 1e5;
    if (ok) {
        request->waves_grid[0] = (size_t)list[0];
        request->waves_grid[1] = (size_t)list[1];
    }
    free(list);
    return ok ? CLI_OK : cli_usage("--waves-grid: '%s', expected two counts N,M >= 2", optarg);
}

static int parse_elements(struct solve_request *request)
{
    double *list = NULL;
    size_t n = 0;
    igabem_options *o = &request->options;
    o->elements_u = o->elements_v = 0;
    if (strcmp(optarg, "none") == 0)
        return CLI_OK;
    int ok = cli_parse_list(optarg, &list, &n) && n == 2 && list[0] >= 1 && list[1] >= 1 &&
             list[0] <= 1000 && list[1] <= 1000;
    if (ok) {
        o->elements_u = (int)list[0];
        o->elements_v = (int)list[1];
    }
    free(list);
    return ok ? CLI_OK
              : cli_usage("--elements: '%s', expected two counts N,M from 1 to 1000, or none",
                          optarg);
}

static int parse_box(struct solve_request *request)
{
    double *list = NULL;
    size_t n = 0;
    int ok = cli_parse_list(optarg, &list, &n) && n == 4 && list[0] < list[1] && list[2] < list[3];
    for (size_t k = 0; ok && k < 4; k++)
        request->waves_box[k] = list[k];
    free(list);
    return ok ? CLI_OK
              : cli_usage("--waves-box: '%s', expected A,B,C,D with A < B and C < D", optarg);
}

static int take(int opt, struct solve_request *r, bool *done)
{
    igabem_options *o = &r->options;
    int threads = 0;
    switch (opt) {
    case OPT_FR:
        return parse_fr(r);
    case OPT_FORMULATION:
        return parse_formulation(r);
    case OPT_KERNEL:
        return parse_kernel(r);
    case OPT_REFINE:
        r->resolution_given = true;
        return integer(opt, 1, 64, &o->refine);
    case OPT_REFINE_V:
        r->resolution_given = true;
        return integer(opt, 1, 64, &o->refine_v);
    case OPT_DEGREE:
        return integer(opt, 1, 9, &o->degree);
    case OPT_TOLERANCE:
        return number(opt, 0, false, &o->tolerance);
    case OPT_SOLVER:
        return parse_solver(o);
    case OPT_LADDER:
        return integer(opt, 2, 16, &r->ladder);
    case OPT_SENSITIVITY:
        o->sensitivity = 1;
        return CLI_OK;
    case OPT_NO_SENSITIVITY:
        o->sensitivity = 0;
        return CLI_OK;
    case OPT_FREE_TO_TRIM:
        r->free_to_trim = true;
        return CLI_OK;
    case OPT_SURVEY:
        r->survey = true;
        return CLI_OK;
    case OPT_CUTOFF:
        return number_or_none(opt, &o->cutoff_angle);
    case OPT_CUTOFF_FACTOR:
        return number(opt, 0, false, &o->cutoff_factor);
    case OPT_STEM_LIMIT:
        return number_or_none(opt, &o->stem_limit);
    case OPT_NO_LINE_TERM:
        o->line_term = 0;
        return CLI_OK;
    case OPT_X_S:
        return anywhere(opt, &r->x_s);
    case OPT_STERN_LENGTH:
        return number(opt, 0, true, &o->stern_length);
    case OPT_STERN_BLEND:
        return number(opt, 0, true, &o->stern_blend);
    case OPT_SPECTRUM_LIMIT:
        return number(opt, 0, false, &o->spectrum_limit);
    case OPT_LENGTH:
        return number(opt, 0, false, &r->hull.length);
    case OPT_LEVEL:
        return anywhere(opt, &r->hull.level);
    case OPT_DRAFT:
        return number(opt, 0, false, &r->hull.draft);
    case OPT_SIMPLIFY:
        return number(opt, 0, true, &r->hull.simplify);
    case OPT_ELEMENTS:
        r->resolution_given = true;
        return parse_elements(r);
    case OPT_WATERLINE_SPAN:
        return number(opt, 0, true, &o->waterline_span);
    case OPT_GRAVITY:
        return number(opt, 0, false, &o->gravity);
    case OPT_DENSITY:
        return number(opt, 0, false, &o->density);
    case OPT_VISCOSITY:
        return number(opt, 0, false, &r->viscosity);
    case OPT_FORM_FACTOR:
        return anywhere(opt, &r->form_factor);
    case OPT_VTU:
        r->vtu = optarg;
        return CLI_OK;
    case OPT_WAVES:
        r->waves = optarg;
        return CLI_OK;
    case OPT_WAVES_GRID:
        return parse_grid(r);
    case OPT_WAVES_BOX:
        return parse_box(r);
    case OPT_SPECTRUM:
        r->spectrum = optarg;
        return CLI_OK;
    case OPT_PLOT:
        r->plot = optarg;
        return plot_check_path("--plot", optarg) ? CLI_OK : CLI_USAGE;
    case OPT_PRESSURE_PLOT:
        r->pressure_plot = optarg;
        return plot_check_path("--pressure-plot", optarg) ? CLI_OK : CLI_USAGE;
    case OPT_JSON:
        r->json = true;
        return CLI_OK;
    case OPT_THREADS: {
        int code = integer(opt, 1, 4096, &threads);
        if (code == CLI_OK) {
            cli_set_threads(threads);
            o->threads = threads;
        }
        return code;
    }
    case OPT_HELP:
        *done = true;
        return cli_print(help);
    case OPT_VERSION:
        *done = true;
        return cli_version();
    default:
        return cli_usage("option not understood");
    }
}

static int complete(int argc, char **argv, struct solve_request *r)
{
    if (optind >= argc)
        return cli_usage("no HULL given");
    if (optind + 1 < argc)
        return cli_usage("more than one HULL: '%s'", argv[optind + 1]);
    r->hull.path = argv[optind];
    if (r->resolution_given && r->options.refine == 0)
        r->options.refine = 1;
    if (r->options.kernel == IGABEM_KERNEL_KELVIN && r->n_fr == 0)
        return cli_usage("--fr is missing");
    if (r->all && r->options.kernel != IGABEM_KERNEL_KELVIN)
        return cli_usage("--formulation all compares wave resistances, expected --kernel kelvin");
    if (r->waves && r->options.kernel != IGABEM_KERNEL_KELVIN)
        return cli_usage("--waves needs a free surface, expected --kernel kelvin");
    if (r->free_to_trim && (r->options.kernel != IGABEM_KERNEL_KELVIN || r->n_fr != 1))
        return cli_usage("--free-to-trim expects --kernel kelvin and one Froude number");
    r->hull.unbounded = r->options.kernel == IGABEM_KERNEL_RANKINE;
    if (r->n_fr == 0) { /* other kernels: one result without a Froude number */
        r->fr = malloc(sizeof *r->fr);
        if (!r->fr)
            return cli_fail("out of memory");
        r->fr[0] = NAN;
        r->n_fr = 1;
    }
    return CLI_OK;
}

int solve_parse(int argc, char **argv, struct solve_request *request, bool *done)
{
    *request = (struct solve_request){.ladder = 1,
                                      .x_s = NAN,
                                      .viscosity = 1.1386e-6,
                                      .waves_grid = {200, 60},
                                      .waves_box = {-3.0, 0.25, 0.0, 1.0}};
    hull_request_init(&request->hull, NULL);
    igabem_options_init(&request->options);
    request->options.sensitivity = 1;
    *done = false;
    optind = 1;
    opterr = 0;
    for (int opt; (opt = getopt_long(argc, argv, "", options, NULL)) != -1;) {
        if (opt == '?')
            return cli_usage("'%s': unknown option or missing value", argv[optind - 1]);
        int code = take(opt, request, done);
        if (code != CLI_OK || *done)
            return code;
    }
    return complete(argc, argv, request);
}

void solve_request_free(struct solve_request *request)
{
    free(request->fr);
}
