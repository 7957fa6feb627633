#include "nurbs_tool.h"

#include <string.h>
#include <strings.h>

static bool is_iges(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && (strcasecmp(dot, ".igs") == 0 || strcasecmp(dot, ".iges") == 0);
}

struct request {
    double scale, length, untrim;
    const char *note;
    bool json;
};

static int convert(const char *input, const char *output, const struct request *request)
{
    const double scale = request->scale, length = request->length;
    const char *note = request->note;
    char report[4000] = "";
    nurbs_patches *read = NULL, *written = NULL;
    nurbs_status status = is_iges(input) ? nurbs_patches_read_iges_untrimmed(
                                               input, request->untrim, &read, report, sizeof report)
                                         : nurbs_patches_read(input, &read);
    if (status != NURBS_OK)
        return library_failure();
    const double matrix[9] = {scale, 0, 0, 0, scale, 0, 0, 0, scale}, shift[3] = {0, 0, 0};
    status = nurbs_patches_create(&written);
    for (size_t k = 0; k < nurbs_patches_count(read) && status == NURBS_OK; k++) {
        nurbs_surface *surface = NULL;
        const double *u, *v;
        status = nurbs_surface_transform(nurbs_patches_get(read, k), matrix, shift, &surface);
        if (status == NURBS_OK)
            status = nurbs_patches_add(written, surface);
        size_t rows = nurbs_patches_parameters(read, k, 0, &u),
               columns = nurbs_patches_parameters(read, k, 1, &v);
        if (status == NURBS_OK)
            status = nurbs_patches_set_parameters(written, k, rows, u, columns, v);
        nurbs_surface_free(surface);
    }
    if (status == NURBS_OK)
        status = nurbs_patches_set_length(written,
                                          length > 0 ? length : scale * nurbs_patches_length(read));
    if (status == NURBS_OK)
        status = nurbs_patches_set_note(written, note ? note : nurbs_patches_note(read));
    if (status == NURBS_OK)
        status = nurbs_patches_write(written, output);
    int code = status == NURBS_OK ? CLI_OK : library_failure();
    if (code == CLI_OK && request->json)
        code =
            print_json(json_pack("{s:s,s:s,s:I,s:s}", "input", input, "output", output, "patches",
                                 (json_int_t)nurbs_patches_count(written), "report", report));
    else if (code == CLI_OK && *report)
        fprintf(stderr, "%s: %s\n", input, report);
    nurbs_patches_free(read);
    nurbs_patches_free(written);
    return code;
}

static int run(int argc, char **argv)
{
    static const struct option options[] = {{"scale", required_argument, NULL, 's'},
                                            {"lpp", required_argument, NULL, 'l'},
                                            {"note", required_argument, NULL, 'n'},
                                            {"untrim", required_argument, NULL, 'u'},
                                            COMMON_OPTIONS,
                                            END_OF_OPTIONS};
    struct request request = {.scale = 1};
    int letter, code = CLI_OK;
    while (code == CLI_OK && (letter = getopt_long(argc, argv, ":", options, NULL)) != -1)
        switch (letter) {
        case 's':
            if (!cli_parse_double(optarg, &request.scale) || !(request.scale > 0))
                code = cli_usage("--scale '%s': expected a number > 0", optarg);
            break;
        case 'l':
            code = length_option("lpp", optarg, &request.length);
            break;
        case 'n':
            request.note = optarg;
            break;
        case 'u':
            code = length_option("untrim", optarg, &request.untrim);
            break;
        default:
            code = common_option(letter, argv, &request.json);
        }
    if (code == CLI_OK)
        code = operand_count(argc, argv, 2, "an input and an output file");
    return code == CLI_OK ? convert(argv[optind], argv[optind + 1], &request) : code;
}

const subcommand convert_command = {
    "convert", "change the file format", run,
    "usage: nurbs convert IN OUT [options]\n"
    "  By extension: reads .json .igs .iges, writes .json .igs .iges .stl .vtu .csv. What an\n"
    "  IGES file held and what was changed is told on standard error.\n"
    "  --untrim T     faces of an IGES file that are trimmed to four sides become patches of\n"
    "                 their own, within T metres (surfaces are kept whole)\n"
    "  --scale S      multiply all lengths\n"
    "  --lpp L        reference length kept in a NURBS file\n"
    "  --note TEXT    provenance kept in a NURBS file\n"};
