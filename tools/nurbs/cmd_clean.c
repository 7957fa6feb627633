/* A file as it came to a hull that every command takes: what the user asks for, then what
 * nurbs_hull_create() does by itself, told in one line. */
#include "nurbs_tool.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_SIZE = 4000 };

struct request {
    const char *keep, *drop, *axes, *flip, *shift, *output;
    double scale, snap, length;
    bool both, json;
    nurbs_hull_options hull;
    char line[LINE_SIZE]; /* what was done */
};

__attribute__((format(printf, 2, 3))) static void tell(struct request *request, const char *format,
                                                       ...)
{
    size_t used = strlen(request->line);
    va_list args;
    if (used && used + 3 < LINE_SIZE)
        used += (size_t)snprintf(request->line + used, LINE_SIZE - used, "; ");
    va_start(args, format);
    vsnprintf(request->line + used, LINE_SIZE - used, format, args);
    va_end(args);
}

static void replace(nurbs_patches **patches, nurbs_patches *changed)
{
    nurbs_patches_free(*patches);
    *patches = changed;
}

/* The patches named, or all but those. */
static int choose(struct request *request, const char *option, const char *list, bool named,
                  nurbs_patches **patches)
{
    double *number = NULL;
    size_t n = 0, count = nurbs_patches_count(*patches);
    nurbs_patches *rest = NULL;
    bool good = cli_parse_list(list, &number, &n);
    for (size_t k = 0; k < n && good; k++)
        good = number[k] >= 0 && number[k] < (double)count && number[k] == floor(number[k]);
    if (!good) {
        free(number);
        return cli_usage("%s '%s': expected numbers of patches from 0 to %zu", option, list,
                         count - 1);
    }
    nurbs_status status = start_patches(*patches, &rest);
    for (size_t k = 0; k < count && status == NURBS_OK; k++) {
        bool found = false;
        for (size_t i = 0; i < n; i++)
            found |= number[i] == (double)k;
        if (found == named)
            status = add_with_parameters(nurbs_patches_get(*patches, k), *patches, k, rest);
    }
    free(number);
    if (status != NURBS_OK) {
        nurbs_patches_free(rest);
        return library_failure();
    }
    replace(patches, rest);
    tell(request, "%s %s", named ? "kept patches" : "dropped patches", list);
    return CLI_OK;
}

/* The three axes of the file that become x, y and z. */
static int read_axes(const char *text, size_t axis[3])
{
    bool seen[3] = {false, false, false};
    bool good = strlen(text) == 3;
    for (int c = 0; c < 3 && good; c++) {
        good = text[c] >= 'x' && text[c] <= 'z' && !seen[text[c] - 'x'];
        if (good) {
            axis[c] = (size_t)(text[c] - 'x');
            seen[axis[c]] = true;
        }
    }
    return good ? CLI_OK : cli_usage("--axes '%s': expected x, y and z in some order", text);
}

static int read_shift(const char *text, double shift[3])
{
    double *number = NULL;
    size_t n = 0;
    bool good = cli_parse_list(text, &number, &n) && n == 3;
    for (size_t c = 0; c < 3 && good; c++)
        shift[c] = number[c];
    free(number);
    return good ? CLI_OK : cli_usage("--shift '%s': expected three lengths X,Y,Z", text);
}

/* Lengths multiplied, axes exchanged and reversed, then everything shifted. */
static int transform(struct request *request, nurbs_patches **patches)
{
    size_t axis[3] = {0, 1, 2};
    double sign[3] = {1, 1, 1}, matrix[9] = {0}, shift[3] = {0, 0, 0};
    nurbs_patches *moved = NULL;
    int code = request->axes ? read_axes(request->axes, axis) : CLI_OK;
    if (code == CLI_OK && request->shift)
        code = read_shift(request->shift, shift);
    if (code != CLI_OK)
        return code;
    for (const char *c = request->flip; c && *c; c++) {
        if (!strchr("xyz", *c))
            return cli_usage("--flip '%s': expected some of x, y and z", request->flip);
        sign[*c - 'x'] *= -1;
    }
    if (request->scale == 1 && !request->axes && !request->flip && !request->shift)
        return CLI_OK;
    for (size_t c = 0; c < 3; c++)
        matrix[3 * c + axis[c]] = sign[c] * request->scale;
    if (nurbs_patches_transform(*patches, matrix, shift, &moved) != NURBS_OK)
        return library_failure();
    replace(patches, moved);
    if (request->scale != 1)
        tell(request, "lengths times %g", request->scale);
    if (request->axes)
        tell(request, "%s of the file taken as xyz", request->axes);
    if (request->flip)
        tell(request, "reversed %s", request->flip);
    if (request->shift)
        tell(request, "shifted by %s m", request->shift);
    return CLI_OK;
}

/* The reference length that the file is to keep. */
static int set_length(struct request *request, nurbs_patches *patches)
{
    if (!(request->length > 0))
        return CLI_OK;
    if (nurbs_patches_set_length(patches, request->length) != NURBS_OK)
        return library_failure();
    tell(request, "reference length %g m", request->length);
    return CLI_OK;
}

static int snap(struct request *request, nurbs_patches **patches)
{
    nurbs_patches *snapped = NULL;
    size_t edges = 0;
    double moved = 0;
    if (!(request->snap > 0))
        return CLI_OK;
    if (nurbs_patches_snap(*patches, request->snap, &snapped, &edges, &moved) != NURBS_OK)
        return library_failure();
    replace(patches, snapped);
    tell(request, "%zu edge%s put into the centre plane, moved by at most %.3g m", edges,
         edges == 1 ? "" : "s", moved);
    return CLI_OK;
}

static bool reaches_across(const nurbs_surface *surface)
{
    size_t points = nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
    bool across = false;
    for (size_t k = 0; k < points; k++)
        across |= nurbs_surface_points(surface)[3 * k + 1] < 0;
    return across && !nurbs_surface_weights(surface);
}

/* Patches of a half off the other side of the centre plane, as the hull has lifted them for itself:
 * what is told of it then holds for the file too. */
static nurbs_status raise_sides(nurbs_patches **patches)
{
    nurbs_patches *raised = NULL;
    nurbs_status status = start_patches(*patches, &raised);
    for (size_t k = 0; k < nurbs_patches_count(*patches) && status == NURBS_OK; k++) {
        const nurbs_surface *surface = nurbs_patches_get(*patches, k);
        nurbs_surface *lifted = NULL;
        double by;
        if (reaches_across(surface))
            status = nurbs_surface_raise_side(surface, &lifted, &by);
        if (status == NURBS_OK)
            status = add_with_parameters(lifted ? lifted : surface, *patches, k, raised);
        nurbs_surface_free(lifted);
    }
    if (status == NURBS_OK)
        replace(patches, raised);
    else
        nurbs_patches_free(raised);
    return status;
}

/* Writes the hull with the water at z = 0, one side of it or both. */
static int save(struct request *request, const nurbs_hull *hull)
{
    const double level = nurbs_hull_level(hull), down[3] = {0, 0, -level};
    nurbs_patches *moved = NULL, *both = NULL;
    bool mirror = request->both && nurbs_hull_is_half(hull);
    nurbs_status status = nurbs_patches_transform(nurbs_hull_full(hull), NULL, down, &moved);
    if (status == NURBS_OK && nurbs_hull_is_half(hull))
        status = raise_sides(&moved);
    if (status == NURBS_OK && mirror)
        status = nurbs_patches_mirror(moved, 1, &both);
    if (level != 0)
        tell(request, "moved by %g m along z", -level);
    if (mirror)
        tell(request, "the other side added");
    if (!*request->line)
        tell(request, "nothing to do");
    nurbs_patches *result = both ? both : moved;
    if (status == NURBS_OK)
        status = nurbs_patches_set_note(result, request->line);
    if (status == NURBS_OK)
        status = nurbs_patches_write(result, request->output);
    size_t count = nurbs_patches_count(result);
    nurbs_patches_free(moved);
    nurbs_patches_free(both);
    if (status != NURBS_OK)
        return library_failure();
    const nurbs_hydrostatics *h = nurbs_hull_hydrostatics(hull);
    if (request->json)
        return print_json(json_pack(
            "{s:s,s:I,s:f,s:f,s:s,s:[]}", "file", request->output, "patches", (json_int_t)count,
            "volume", h->volume, "wetted_area", h->wetted_area, "done", request->line, "warnings"));
    printf("%s: %s\n", request->output, request->line);
    return CLI_OK;
}

static int clean(struct request *request, const char *path)
{
    char report[LINE_SIZE / 2];
    nurbs_patches *patches = NULL;
    nurbs_hull *hull = NULL;
    if (nurbs_hull_read_patches(path, NAN, &patches, report, sizeof report) != NURBS_OK)
        return library_failure();
    if (*report)
        fprintf(stderr, "%s: %s: %s\n", cli_name(), path, report);
    int code = CLI_OK;
    if (request->keep)
        code = choose(request, "--keep", request->keep, true, &patches);
    if (code == CLI_OK && request->drop)
        code = choose(request, "--drop", request->drop, false, &patches);
    if (code == CLI_OK)
        code = transform(request, &patches);
    if (code == CLI_OK)
        code = set_length(request, patches);
    if (code == CLI_OK)
        code = snap(request, &patches);
    if (code == CLI_OK && nurbs_hull_create(patches, &request->hull, &hull) != NURBS_OK)
        code = cli_fail("%s: %s", path, nurbs_last_error());
    const char *step;
    for (size_t k = 1; code == CLI_OK && (step = nurbs_hull_step(hull, k)); k++)
        tell(request, "%s", step);
    if (code == CLI_OK)
        code = save(request, hull);
    nurbs_hull_free(hull);
    nurbs_patches_free(patches);
    return code;
}

static int run(int argc, char **argv)
{
    struct request request = {.scale = 1};
    nurbs_hull_options_init(&request.hull);
    request.hull.simplify = 0;
    request.hull.draft = 0;
    const tool_option options[] = {{"keep", OPTION_TEXT, &request.keep, 0, 0},
                                   {"drop", OPTION_TEXT, &request.drop, 0, 0},
                                   {"scale", OPTION_LENGTH, &request.scale, 0, 0},
                                   {"axes", OPTION_TEXT, &request.axes, 0, 0},
                                   {"flip", OPTION_TEXT, &request.flip, 0, 0},
                                   {"shift", OPTION_TEXT, &request.shift, 0, 0},
                                   {"lpp", OPTION_LENGTH, &request.length, 0, 0},
                                   {"snap", OPTION_LENGTH, &request.snap, 0, 0},
                                   {"level", OPTION_NUMBER, &request.hull.level, 0, 0},
                                   {"draft", OPTION_LENGTH, &request.hull.draft, 0, 0},
                                   {"both", OPTION_FLAG, &request.both, 0, 0}};
    const operands wanted = {2, 2, "a file to read and one to write"};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, wanted, &request.json);
    if (code != CLI_OK)
        return code;
    if (!(request.hull.draft > 0))
        request.hull.draft = NAN;
    request.output = argv[optind + 1];
    return clean(&request, argv[optind]);
}

const subcommand clean_command = {
    "clean", "make a hull that every command takes of what a file holds", run,
    "usage: nurbs clean IN OUT [options]\n"
    "  In this order: the options, then what every command does to a hull by itself: faces in the\n"
    "  centre plane, level decks and transoms left out, a starboard half mirrored, of both sides "
    "in\n"
    "  one surface the port half taken, a bow at small x turned round. OUT has the still water at\n"
    "  z = 0; one line tells what was done, and OUT keeps it as its note. What is no hull then is\n"
    "  refused with the place.\n"
    "  --keep K,...   these patches only, counted from 0\n"
    "  --drop K,...   all but these, counted in what is kept\n"
    "  --scale S      multiply lengths: 0.001 for millimetres told as metres\n"
    "  --axes ORDER   axes of IN that are x (forward), y (to port) and z (up): yxz, xzy, ...\n"
    "  --flip AXES    reverse some of x, y and z\n"
    "  --shift X,Y,Z  then move by so many metres\n"
    "  --lpp L        reference length that OUT keeps, metres\n"
    "  --snap T       put edges within T metres of the centre plane into it\n"
    "  --level Z      height of the still water in IN, after the options above (0)\n"
    "  --draft T      draft of the keel amidships that sets it instead, metres\n"
    "  --both         write both sides of a half hull\n"};
