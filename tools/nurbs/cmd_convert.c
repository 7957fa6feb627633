#include "nurbs_tool.h"

#include <math.h>

struct request {
    double scale, length, untrim;
    const char *note;
    bool json;
};

static int convert(const char *input, const char *output, const struct request *request)
{
    const double scale = request->scale;
    char report[4000] = "";
    nurbs_patches *read = NULL, *written = NULL;
    nurbs_status status =
        is_skinned(input)
            ? nurbs_hull_read_patches(input, NAN, &read, report, sizeof report)
            : nurbs_patches_read_reported(input, request->untrim, &read, report, sizeof report);
    if (status != NURBS_OK)
        return library_failure();
    const double matrix[9] = {scale, 0, 0, 0, scale, 0, 0, 0, scale};
    status = nurbs_patches_transform(read, matrix, NULL, &written);
    if (status == NURBS_OK && request->length > 0)
        status = nurbs_patches_set_length(written, request->length);
    if (status == NURBS_OK && request->note)
        status = nurbs_patches_set_note(written, request->note);
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
    struct request request = {.scale = 1};
    const tool_option options[] = {{"scale", OPTION_NUMBER, &request.scale, 0, 0},
                                   {"lpp", OPTION_LENGTH, &request.length, 0, 0},
                                   {"note", OPTION_TEXT, &request.note, 0, 0},
                                   {"untrim", OPTION_LENGTH, &request.untrim, 0, 0}};
    const operands files = {2, 2, "an input and an output file"};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, files, &request.json);
    if (code == CLI_OK && !(request.scale > 0))
        code = cli_usage("--scale %g: expected a number > 0", request.scale);
    return code == CLI_OK ? convert(argv[optind], argv[optind + 1], &request) : code;
}

const subcommand convert_command = {
    "convert", "change the file format", run,
    "usage: nurbs convert IN OUT [options]\n"
    "  By extension: reads .json .igs .iges .step .stp, writes these and .stl .vtu .csv. "
    "Triangles\n"
    "  (.stl .obj), offset tables, stations and grids (.csv) become the one surface of 'nurbs\n"
    "  sections'. What the file held and what was changed is told on standard error.\n"
    "  --untrim T     faces that loops cut out of B-spline surfaces become patches of their own,\n"
    "                 within T metres (those of IGES files are kept whole)\n"
    "  --scale S      multiply all lengths\n"
    "  --lpp L        reference length kept in a NURBS file\n"
    "  --note TEXT    provenance kept in a NURBS file\n"};
