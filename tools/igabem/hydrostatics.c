/* igabem hydrostatics: the page a naval architect wants of a hull at rest. */
#include "cli.h"
#include "commands.h"
#include "json_result.h"
#include "particulars.h"

#include <getopt.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: igabem hydrostatics HULL [OPTION]...\n"
    "\n"
    "Particulars of a hull at rest. HULL: a NURBS file (.json, .igs), cut at the still water if "
    "it\n"
    "crosses it. Lengths in metres; x as in the file, z up from the still water.\n"
    "\n"
    "  --draft T       keel draft amidships that sets the level\n"
    "  --level Z       z of the still water in the file (0)\n"
    "  --length L      length between perpendiculars (the file's, else the waterline's)\n"
    "  --kg KG         height of the centre of gravity above the keel: GM_t too\n"
    "  --density RHO   kg/m^3 (1000)\n"
    "  --stations N    sections of the area curve (21)\n"
    "  --simplify TOL  knot removal over the length after a cut (0: none)\n"
    "  --json          one JSON object on standard output and nothing else\n"
    "  --threads N     threads to use\n"
    "  --help, --version\n"
    "\n"
    "Exit status: 0 success, 1 failure, 2 wrong usage.\n";

struct request {
    struct hull_request hull;
    double kg, density;
    int stations;
    bool json;
};

static int take(int opt, struct request *request, bool *done)
{
    double *target = NULL;
    int threads;
    switch (opt) {
    case 'd':
        target = &request->hull.draft;
        break;
    case 'z':
        if (!cli_parse_double(optarg, &request->hull.level))
            return cli_usage("--level: '%s', expected a number", optarg);
        return CLI_OK;
    case 'l':
        target = &request->hull.length;
        break;
    case 'k':
        target = &request->kg;
        break;
    case 'r':
        target = &request->density;
        break;
    case 's':
        if (!cli_parse_int(optarg, &request->stations) || request->stations < 2 ||
            request->stations > 10001)
            return cli_usage("--stations: '%s', expected a count from 2 to 10001", optarg);
        return CLI_OK;
    case 'm':
        if (!cli_parse_double(optarg, &request->hull.simplify) || request->hull.simplify < 0)
            return cli_usage("--simplify: '%s', expected a number >= 0", optarg);
        return CLI_OK;
    case 'T':
        if (!cli_parse_int(optarg, &threads) || threads < 1)
            return cli_usage("--threads: '%s', expected a count", optarg);
        cli_set_threads(threads);
        return CLI_OK;
    case 'J':
        request->json = true;
        return CLI_OK;
    case 'h':
        *done = true;
        return cli_print(help);
    case 'V':
        *done = true;
        return cli_version();
    default:
        return cli_usage("unknown option or missing value");
    }
    if (!cli_parse_double(optarg, target) || !(*target > 0))
        return cli_usage("'%s', expected a positive number", optarg);
    return CLI_OK;
}

static int parse(int argc, char **argv, struct request *request, bool *done)
{
    static const struct option options[] = {
        {"draft", required_argument, NULL, 'd'},    {"level", required_argument, NULL, 'z'},
        {"length", required_argument, NULL, 'l'},   {"kg", required_argument, NULL, 'k'},
        {"density", required_argument, NULL, 'r'},  {"stations", required_argument, NULL, 's'},
        {"simplify", required_argument, NULL, 'm'}, {"threads", required_argument, NULL, 'T'},
        {"json", no_argument, NULL, 'J'},           {"help", no_argument, NULL, 'h'},
        {"version", no_argument, NULL, 'V'},        {NULL, 0, NULL, 0},
    };
    *request = (struct request){.kg = NAN, .density = 1000.0, .stations = 21};
    hull_request_init(&request->hull, NULL);
    request->hull.simplify = 0.0;
    optind = 1;
    opterr = 0;
    for (int opt; (opt = getopt_long(argc, argv, "", options, NULL)) != -1;) {
        int code = take(opt, request, done);
        if (code != CLI_OK || *done)
            return code;
    }
    if (optind >= argc)
        return cli_usage("no HULL given");
    if (optind + 1 < argc)
        return cli_usage("more than one HULL: '%s'", argv[optind + 1]);
    request->hull.path = argv[optind];
    return CLI_OK;
}

static int print_json(const igabem_hull *hull, const struct particulars *p)
{
    json_t *json = json_object(), *curve = json_array();
    for (size_t i = 0; i < p->count; i++)
        json_result_set(json, p->item[i].key,
                        isfinite(p->item[i].value) ? json_real(p->item[i].value) : json_null());
    for (size_t i = 0; i < p->stations; i++) {
        json_t *station = json_object();
        json_result_set(station, "x", json_real(p->station_x[i]));
        json_result_set(station, "area", json_real(p->station_area[i]));
        json_result_append(curve, station);
    }
    json_result_set(json, "section_areas", curve);
    json_result_set(json, "note", json_string(p->note));
    json_t *warnings = json_array();
    const char *sentence;
    for (size_t k = 0; (sentence = igabem_hull_warning(hull, k)); k++)
        json_result_append(warnings, json_string(sentence));
    json_result_set(json, "warnings", warnings);
    return json_result_print(json, JSON_INDENT(1) | JSON_REAL_PRECISION(12));
}

static int print_table(const struct particulars *p, const char *path)
{
    printf("%s: %s\n\n", path, p->note);
    for (size_t i = 0; i < p->count; i++)
        if (isfinite(p->item[i].value))
            printf("%-22s %14.7g %-7s %s\n", p->item[i].key, p->item[i].value, p->item[i].unit,
                   p->item[i].text);
    printf("\nsection areas, both sides\n%14s %14s\n", "x m", "m^2");
    for (size_t i = 0; i < p->stations; i++)
        printf("%14.7g %14.7g\n", p->station_x[i], p->station_area[i]);
    return cli_printed();
}

int command_hydrostatics(int argc, char **argv)
{
    struct request request;
    struct hull_input input;
    struct particulars particulars;
    bool done = false;
    int code = parse(argc, argv, &request, &done);
    if (code != CLI_OK || done)
        return code;
    code = hull_input_read(&request.hull, &input);
    if (code != CLI_OK)
        return code;
    code = particulars_find(&input, request.density, request.kg, (size_t)request.stations,
                            &particulars);
    if (code == CLI_OK)
        code = request.json ? print_json(input.hull, &particulars)
                            : print_table(&particulars, request.hull.path);
    particulars_free(&particulars);
    hull_input_free(&input);
    return code;
}
