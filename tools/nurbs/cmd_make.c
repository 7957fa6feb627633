#include "nurbs_tool.h"

#include <jansson.h>
#include <string.h>

struct dimensions {
    double length, beam, height, draft, depth;
};

static nurbs_status make_sphere(struct dimensions d, nurbs_surface **surface)
{
    double size = d.length > 0 ? d.length : 1;
    return nurbs_make_ellipsoid(size, size, size, d.depth, surface);
}

/* Prolate of revolution about x. */
static nurbs_status make_spheroid(struct dimensions d, nurbs_surface **surface)
{
    double beam = d.beam > 0 ? d.beam : 0.2 * (d.length > 0 ? d.length : 1);
    return nurbs_make_ellipsoid(d.length > 0 ? d.length : 1, beam, beam, d.depth, surface);
}

static nurbs_status make_ellipsoid(struct dimensions d, nurbs_surface **surface)
{
    double length = d.length > 0 ? d.length : 1, beam = d.beam > 0 ? d.beam : 0.2 * length;
    return nurbs_make_ellipsoid(length, beam, d.height > 0 ? d.height : 0.75 * beam, d.depth,
                                surface);
}

static nurbs_status make_wigley(struct dimensions d, nurbs_surface **surface)
{
    double length = d.length > 0 ? d.length : 1;
    return nurbs_make_wigley(length, d.beam > 0 ? d.beam : 0.1 * length,
                             d.draft > 0 ? d.draft : 0.0625 * length, surface);
}

/* Lengths that are not given: beam and draft as shares of the length. */
static nurbs_status make_ship(struct dimensions d,
                              nurbs_status (*fill)(double, double, double, nurbs_ship_form *),
                              double beam, double draft, nurbs_surface **surface)
{
    double length = d.length > 0 ? d.length : 1;
    nurbs_ship_form form;
    nurbs_status status = fill(length, d.beam > 0 ? d.beam : beam * length,
                               d.draft > 0 ? d.draft : draft * length, &form);
    return status == NURBS_OK ? nurbs_make_ship(&form, surface) : status;
}

static nurbs_status make_fast(struct dimensions d, nurbs_surface **surface)
{
    return make_ship(d, nurbs_ship_form_fast, 0.13, 0.04, surface);
}

static nurbs_status make_bulb(struct dimensions d, nurbs_surface **surface)
{
    return make_ship(d, nurbs_ship_form_bulb, 0.14, 0.05, surface);
}

static const struct body {
    const char *name;
    nurbs_status (*make)(struct dimensions, nurbs_surface **);
} bodies[] = {{"sphere", make_sphere}, {"spheroid", make_spheroid}, {"ellipsoid", make_ellipsoid},
              {"wigley", make_wigley}, {"fast", make_fast},         {"bulb", make_bulb}};

static int write_body(const struct body *body, struct dimensions d, const char *path, bool json)
{
    nurbs_surface *surface = NULL;
    nurbs_patches *patches = NULL;
    char note[120];
    snprintf(note, sizeof note, "%s, exact; made by 'nurbs make'", body->name);
    nurbs_status status = body->make(d, &surface);
    if (status == NURBS_OK)
        status = nurbs_patches_create(&patches);
    if (status == NURBS_OK)
        status = nurbs_patches_add(patches, surface);
    if (status == NURBS_OK)
        status = nurbs_patches_set_length(patches, d.length > 0 ? d.length : 1);
    if (status == NURBS_OK)
        status = nurbs_patches_set_note(patches, note);
    if (status == NURBS_OK)
        status = nurbs_patches_write(patches, path);
    int code = status == NURBS_OK ? CLI_OK : library_failure();
    if (code == CLI_OK && json)
        code = print_json(json_pack("{s:s,s:s,s:f}", "file", path, "body", body->name, "length",
                                    nurbs_patches_length(patches)));
    nurbs_surface_free(surface);
    nurbs_patches_free(patches);
    return code;
}

static int run(int argc, char **argv)
{
    struct dimensions d = {0};
    const char *output = NULL;
    bool json = false;
    const tool_option options[] = {
        {"length", OPTION_LENGTH, &d.length, 0, 0}, {"beam", OPTION_LENGTH, &d.beam, 0, 0},
        {"height", OPTION_LENGTH, &d.height, 0, 0}, {"draft", OPTION_LENGTH, &d.draft, 0, 0},
        {"depth", OPTION_NUMBER, &d.depth, 0, 0},   {"output", OPTION_OUTPUT, &output, 0, 0}};
    const operands body = {1, 1, "one body: sphere, spheroid, ellipsoid, wigley, fast or bulb"};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, body, &json);
    if (code != CLI_OK)
        return code;
    for (size_t k = 0; k < sizeof bodies / sizeof bodies[0]; k++)
        if (strcmp(bodies[k].name, argv[optind]) == 0)
            return write_body(&bodies[k], d, output, json);
    return cli_usage(
        "unknown body '%s', expected sphere, spheroid, ellipsoid, wigley, fast or bulb",
        argv[optind]);
}

const subcommand make_command = {
    "make", "make a body with an exact NURBS form", run,
    "usage: nurbs make BODY -o FILE [options]\n"
    "  Makes the half body (y >= 0) of a sphere, spheroid, ellipsoid or wigley hull, or the\n"
    "  wetted half of a parametric ship: fast (round bilge, wide immersed transom) or bulb\n"
    "  (bulbous bow, narrow transom), x from the transom to the stem.\n"
    "  Bodies of revolution and ellipsoids: centre at x = 0, axis at z = -depth. Wigley:\n"
    "  midship at x = 0, waterline at z = 0.\n"
    "  --length L     length, or diameter of the sphere (1)\n"
    "  --beam B       breadth (sphere: L; spheroid, ellipsoid 0.2 L; wigley 0.1 L; fast 0.13 L;\n"
    "                 bulb 0.14 L)\n"
    "  --height Z     height of the ellipsoid (0.75 B)\n"
    "  --draft T      draft (wigley 0.0625 L; fast 0.04 L; bulb 0.05 L)\n"
    "  --depth H      depth of the axis below z = 0 (0)\n"
    "  -o, --output FILE\n"};
