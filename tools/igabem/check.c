/* igabem check: whether a hull can be solved, and why not. */
#include "cli.h"
#include "commands.h"
#include "hull_input.h"
#include "json_result.h"

#include <igabem/solve.h>

#include <getopt.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: igabem check HULL [OPTION]...\n"
    "\n"
    "Refuses, with patch and place, a hull that cannot be solved: folds, points above the still\n"
    "water or across the centre plane, open seams, vanishing normals. Otherwise says what it is "
    "and\n"
    "which formulation and filter the rules choose.\n"
    "\n"
    "  --level Z       z of the still water in the file (0); --draft T sets it by keel draft\n"
    "  --length L      reference length, m (the file's, else the waterline's)\n"
    "  --simplify TOL  knot removal over the length (1e-4 if the hull is cut), 0 none\n"
    "  --json          one JSON object on standard output and nothing else\n"
    "  --threads N     threads to use\n"
    "  --help, --version\n"
    "\n"
    "Exit status: 0 usable, 1 not usable or failure, 2 wrong usage.\n";

static int parse(int argc, char **argv, struct hull_request *request, bool *json, bool *done)
{
    static const struct option options[] = {
        {"level", required_argument, NULL, 'z'},
        {"draft", required_argument, NULL, 'd'},
        {"length", required_argument, NULL, 'l'},
        {"simplify", required_argument, NULL, 's'},
        {"threads", required_argument, NULL, 'T'},
        {"json", no_argument, NULL, 'J'},
        {"help", no_argument, NULL, 'h'},
        {"version", no_argument, NULL, 'V'},
        {NULL, 0, NULL, 0},
    };
    int threads;
    hull_request_init(request, NULL);
    optind = 1;
    opterr = 0;
    for (int opt; (opt = getopt_long(argc, argv, "", options, NULL)) != -1;) {
        bool ok = true;
        switch (opt) {
        case 'z':
            ok = cli_parse_double(optarg, &request->level);
            break;
        case 'd':
            ok = cli_parse_double(optarg, &request->draft) && request->draft > 0;
            break;
        case 'l':
            ok = cli_parse_double(optarg, &request->length) && request->length > 0;
            break;
        case 's':
            ok = cli_parse_double(optarg, &request->simplify) && request->simplify >= 0;
            break;
        case 'T':
            ok = cli_parse_int(optarg, &threads) && threads > 0;
            if (ok)
                cli_set_threads(threads);
            break;
        case 'J':
            *json = true;
            break;
        case 'h':
            *done = true;
            return cli_print(help);
        case 'V':
            *done = true;
            return cli_version();
        default:
            return cli_usage("unknown option or missing value");
        }
        if (!ok)
            return cli_usage("'%s' is not a value of that option", optarg);
    }
    if (optind >= argc)
        return cli_usage("no HULL given");
    if (optind + 1 < argc)
        return cli_usage("more than one HULL: '%s'", argv[optind + 1]);
    request->path = argv[optind];
    return CLI_OK;
}

static int print_json(const struct hull_input *input, const igabem_hull_info *info,
                      const igabem_options *options)
{
    json_t *json = json_object();
    json_result_set(json, "usable", json_true());
    json_result_set(json, "note", json_string(input->note));
    json_result_set(json, "patches", json_integer((json_int_t)info->patches));
    json_result_set(json, "length", json_real(info->length));
    json_result_set(json, "surface_piercing", json_boolean(info->surface_piercing));
    json_result_set(json, "transom", json_boolean(info->transom != IGABEM_TRANSOM_NONE));
    json_result_set(json, "stern", json_string(hull_stern(info)));
    json_result_set(json, "nu_s", json_real(info->nu_s));
    json_result_set(json, "volume", json_real(info->hydrostatics.volume));
    json_result_set(json, "wetted_area", json_real(info->hydrostatics.wetted_area));
    json_result_set(json, "formulation",
                    json_string(igabem_formulation_name(options->formulation)));
    json_t *warnings = json_array();
    const char *sentence;
    for (size_t k = 0; (sentence = igabem_hull_warning(input->hull, k)); k++)
        json_result_append(warnings, json_string(sentence));
    json_result_set(json, "warnings", warnings);
    return json_result_print(json, JSON_INDENT(1) | JSON_REAL_PRECISION(12));
}

static int print_text(const struct hull_input *input, const igabem_hull_info *info,
                      const igabem_options *options, const char *path)
{
    printf("%s is usable: %s\n", path, input->note);
    printf("%zu patch%s, %s, %s, L %.6g m, V %.6g m^3, S %.6g m^2\n", info->patches,
           info->patches == 1 ? "" : "es",
           info->surface_piercing ? "surface-piercing" : "submerged", hull_stern(info),
           info->length, info->hydrostatics.volume, info->hydrostatics.wetted_area);
    if (info->surface_piercing)
        printf("nu_s %.4g: formulation %s, t_c %.4g, stem limit %.4g\n", info->nu_s,
               igabem_formulation_name(options->formulation), options->cutoff_angle,
               options->stem_limit);
    const char *sentence;
    for (size_t k = 0; (sentence = igabem_hull_warning(input->hull, k)); k++)
        printf("warning: %s\n", sentence);
    return cli_printed();
}

int command_check(int argc, char **argv)
{
    struct hull_request request;
    struct hull_input input;
    bool json = false, done = false;
    int code = parse(argc, argv, &request, &json, &done);
    if (code != CLI_OK || done)
        return code;
    code = hull_input_read(&request, &input);
    if (code != CLI_OK)
        return code;
    igabem_hull_info info;
    igabem_options options;
    igabem_hull_get_info(input.hull, &info);
    igabem_options_init(&options);
    options.froude = 0.3;
    if (igabem_options_freeze(input.hull, &options))
        code = cli_fail("%s: %s", request.path, igabem_last_error());
    else if (json)
        code = print_json(&input, &info, &options);
    else
        code = print_text(&input, &info, &options, request.path);
    hull_input_free(&input);
    return code;
}
