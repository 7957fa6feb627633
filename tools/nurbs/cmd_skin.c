#include "constants.h"
#include "nurbs_tool.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* `skin` passes through every point; `fit` then drops what its tolerance allows and keeps in the
 * file where the points are. */
struct request {
    nurbs_skin_options skin;
    size_t chine[16];
    double tolerance, length;
    const char *note, *output;
    bool json;
};

static const struct {
    const char *name;
    nurbs_parametrization kind;
} parametrizations[] = {{"uniform", NURBS_PARAMETRIZATION_UNIFORM},
                        {"chord", NURBS_PARAMETRIZATION_CHORD},
                        {"centripetal", NURBS_PARAMETRIZATION_CENTRIPETAL},
                        {"foley", NURBS_PARAMETRIZATION_FOLEY}};

static int parametrization_option(const char *text, nurbs_parametrization *kind)
{
    for (size_t k = 0; k < sizeof parametrizations / sizeof parametrizations[0]; k++)
        if (strcmp(text, parametrizations[k].name) == 0) {
            *kind = parametrizations[k].kind;
            return CLI_OK;
        }
    return cli_usage("--parametrize '%s': expected uniform, chord, centripetal or foley", text);
}

/* Columns from 1, as in the grid file, separated by commas. */
static int chine_option(const char *text, struct request *request)
{
    const size_t most = sizeof request->chine / sizeof request->chine[0];
    size_t count = 0;
    for (const char *at = text; at; count++) {
        char *end;
        const long column = strtol(at, &end, 10);
        if (end == at || column < 2 || column > 1000000 || (*end && *end != ',') || count == most)
            return cli_usage("--chine '%s': expected up to %zu columns like 7 or 7,12", text, most);
        request->chine[count] = (size_t)column - 1;
        at = *end ? end + 1 : NULL;
    }
    request->skin.chine = request->chine;
    request->skin.chine_count = count;
    return CLI_OK;
}

static int parse(int argc, char **argv, struct request *request)
{
    size_t degree = (size_t)request->skin.degree;
    double degrees = request->skin.kink_angle * 180 / PI;
    const char *kind = NULL, *chine = NULL;
    const tool_option options[] = {{"degree", OPTION_COUNT, &degree, 1, 5},
                                   {"parametrize", OPTION_TEXT, &kind, 0, 0},
                                   {"kink-angle", OPTION_NUMBER, &degrees, 0, 0},
                                   {"chine", OPTION_TEXT, &chine, 0, 0},
                                   {"tolerance", OPTION_LENGTH, &request->tolerance, 0, 0},
                                   {"lpp", OPTION_LENGTH, &request->length, 0, 0},
                                   {"note", OPTION_TEXT, &request->note, 0, 0},
                                   {"output", OPTION_OUTPUT, &request->output, 0, 0}};
    const operands grid = {1, 1, "one grid file"};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, grid, &request->json);
    if (code == CLI_OK && kind)
        code = parametrization_option(kind, &request->skin.parametrize);
    if (code == CLI_OK && chine)
        code = chine_option(chine, request);
    request->skin.degree = (int)degree;
    request->skin.kink_angle = degrees * PI / 180;
    return code;
}

/* Writes the surface with its parameters, length and note. */
static int save(const nurbs_surface *surface, const nurbs_grid *grid, const double *u,
                const double *v, const struct request *request)
{
    nurbs_patches *patches;
    nurbs_status status = nurbs_patches_create(&patches);
    if (status == NURBS_OK)
        status = nurbs_patches_add(patches, surface);
    if (status == NURBS_OK)
        status = nurbs_patches_set_parameters(patches, 0, nurbs_grid_rows(grid), u,
                                              nurbs_grid_columns(grid), v);
    if (status == NURBS_OK)
        status = nurbs_patches_set_length(patches, request->length);
    if (status == NURBS_OK)
        status = nurbs_patches_set_note(patches, request->note);
    if (status == NURBS_OK)
        status = nurbs_patches_write(patches, request->output);
    int code = status == NURBS_OK ? CLI_OK : library_failure();
    nurbs_patches_free(patches);
    return code;
}

static int report(const nurbs_surface *surface, double worst, const struct request *request)
{
    size_t nu = nurbs_surface_size(surface, 0), nv = nurbs_surface_size(surface, 1);
    if (request->json)
        return print_json(json_pack("{s:s,s:[I,I],s:f}", "file", request->output, "size",
                                    (json_int_t)nu, (json_int_t)nv, "deviation", worst));
    printf("%s: %zu x %zu control points, largest distance to the grid %.3g m\n", request->output,
           nu, nv, worst);
    return CLI_OK;
}

static int skin_grid(const nurbs_grid *grid, const struct request *request)
{
    size_t rows = nurbs_grid_rows(grid), columns = nurbs_grid_columns(grid);
    nurbs_surface *surface = NULL;
    double *u = malloc((rows + columns) * sizeof *u), worst = 0;
    if (!u)
        return cli_fail("out of memory");
    nurbs_status status =
        request->tolerance > 0
            ? nurbs_skin_light(grid, &request->skin, request->tolerance, &surface, NULL)
            : nurbs_skin(grid, &request->skin, &surface);
    if (status == NURBS_OK)
        status = nurbs_skin_parameters(grid, &request->skin, u, u + rows);
    int code = status == NURBS_OK ? CLI_OK : library_failure();
    if (code == CLI_OK)
        code = grid_deviation(surface, grid, u, u + rows, &worst);
    if (code == CLI_OK)
        code = save(surface, grid, u, u + rows, request);
    if (code == CLI_OK)
        code = report(surface, worst, request);
    nurbs_surface_free(surface);
    free(u);
    return code;
}

static bool ends_with(const char *path, const char *end)
{
    size_t length = strlen(path), n = strlen(end);
    return length > n && strcmp(path + length - n, end) == 0;
}

/* A grid, an offset table, a station file or curves; a table tells its length and knuckle. */
static nurbs_status read_sections(const char *path, struct request *request, nurbs_grid **grid)
{
    nurbs_offsets_info info;
    if (ends_with(path, ".stations"))
        return nurbs_stations_read(path, 0, grid);
    if (ends_with(path, ".igs") || ends_with(path, ".iges")) {
        size_t others;
        nurbs_status found = nurbs_sections_read_iges(path, 0, grid, &others);
        if (found == NURBS_OK && others > 0)
            fprintf(stderr, "%s: %s: %zu curves that are no sections: left out\n", cli_name(), path,
                    others);
        return found;
    }
    if (!ends_with(path, ".offsets.csv"))
        return nurbs_grid_read(path, grid);
    nurbs_status status = nurbs_offsets_read(path, 0, grid, &info);
    if (status == NURBS_OK && !(request->length > 0))
        request->length = info.length;
    if (status == NURBS_OK && info.chine > 0 && request->skin.chine_count == 0) {
        request->chine[0] = info.chine;
        request->skin.chine = request->chine;
        request->skin.chine_count = 1;
    }
    return status;
}

static int run(int argc, char **argv, double tolerance)
{
    struct request request = {.tolerance = tolerance};
    nurbs_grid *grid;
    nurbs_skin_options_init(&request.skin);
    int code = parse(argc, argv, &request);
    if (code != CLI_OK)
        return code;
    if (read_sections(argv[optind], &request, &grid) != NURBS_OK)
        return library_failure();
    code = skin_grid(grid, &request);
    nurbs_grid_free(grid);
    return code;
}

static int run_skin(int argc, char **argv)
{
    return run(argc, argv, 0);
}

/* Without --tolerance: 1e-5 of the grid's extent in x would need the grid; a tenth of a millimetre
 * is below what yards build to and models are cut to. */
static int run_fit(int argc, char **argv)
{
    return run(argc, argv, 1e-4);
}

#define SKIN_OPTIONS                                                                               \
    "  --degree P     1 to 5 (3)\n"                                                                \
    "  --parametrize uniform|chord|centripetal|foley   (centripetal)\n"                            \
    "  --kink-angle A degrees an edge line may turn at a station before it is kept as a\n"         \
    "                 kink (20; 0: no kinks)\n"                                                    \
    "  --chine J,...  columns that are chines: sections that turn there by more than the\n"        \
    "                 kink angle keep the corner\n"                                                \
    "  --lpp L        length between perpendiculars, kept in the file\n"                           \
    "  --note TEXT    provenance, kept in the file\n"                                              \
    "  -o, --output FILE\n"

const subcommand skin_command = {
    "skin", "pass a surface through a grid of sections", run_skin,
    "usage: nurbs skin GRID.csv -o FILE [options]\n"
    "  One surface through every point of the grid; u runs along the rows (sections), v along\n"
    "  the columns. The parameters of the points are kept in the file for 'nurbs grid'.\n"
    "  GRID may also be an offset table, FILE.offsets.csv, a station file, FILE.stations, or the\n"
    "  sections that an IGES file holds as curves, FILE.igs.\n"
    "  --tolerance T  drop control points as long as the surface moves less than T "
    "metres\n" SKIN_OPTIONS};

const subcommand fit_command = {
    "fit", "fit a light surface to a grid within a tolerance", run_fit,
    "usage: nurbs fit GRID.csv -o FILE [options]\n"
    "  As 'nurbs skin', then knot removal: the surface stays within the tolerance of the\n"
    "  interpolating one everywhere, so also of the points.\n"
    "  --tolerance T  metres (1e-4)\n" SKIN_OPTIONS};
