#include "hull_input.h"

#include "cli.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double CUT_TOLERANCE = 1e-5;    /* of the length: wetted surface against the file's */
static const double DEFAULT_SIMPLIFY = 1e-4; /* of the length */
static const double CLEARANCE = 1e-6;        /* of the length: above this a patch must be cut */

void hull_request_init(struct hull_request *request, const char *path)
{
    *request = (struct hull_request){.path = path, .draft = NAN, .simplify = NAN, .length = NAN};
}

void hull_input_free(struct hull_input *input)
{
    nurbs_patches_free(input->patches);
    igabem_hull_free(input->hull);
    *input = (struct hull_input){0};
}

/* Bounds of a surface from samples: SIDE points along each direction. */
static int sample_box(const nurbs_surface *surface, double lower[3], double upper[3])
{
    enum { SIDE = 65 };
    double u[2][SIDE], *points = malloc(sizeof(double) * 3 * SIDE * SIDE);
    if (!points)
        return 0;
    for (int d = 0; d < 2; d++) {
        const double *knots = nurbs_surface_knots(surface, d);
        size_t last = nurbs_surface_size(surface, d) + (size_t)nurbs_surface_degree(surface, d);
        for (int i = 0; i < SIDE; i++)
            u[d][i] = i == SIDE - 1 ? knots[last]
                                    : knots[0] + (knots[last] - knots[0]) * i / (SIDE - 1.0);
    }
    int ok = nurbs_surface_eval_grid(surface, 0, SIDE, u[0], SIDE, u[1], points) == NURBS_OK;
    for (size_t i = 0; ok && i < SIDE * SIDE; i++)
        for (int k = 0; k < 3; k++) {
            lower[k] = fmin(lower[k], points[3 * i + (size_t)k]);
            upper[k] = fmax(upper[k], points[3 * i + (size_t)k]);
        }
    free(points);
    return ok;
}

static int file_box(const nurbs_patches *patches, double lower[3], double upper[3])
{
    for (int k = 0; k < 3; k++) {
        lower[k] = INFINITY;
        upper[k] = -INFINITY;
    }
    for (size_t p = 0; p < nurbs_patches_count(patches); p++)
        if (!sample_box(nurbs_patches_get(patches, p), lower, upper))
            return 0;
    return 1;
}

/* The file's patches sunk by request->sinkage and turned bow up by request->trim about the
 * transverse axis at x = pivot, z = level. */
static nurbs_status place(nurbs_patches **patches, const struct hull_request *request, double level)
{
    double c = cos(request->trim), s = sin(request->trim), x = request->pivot;
    const double turn[9] = {c, 0, -s, 0, 1, 0, s, 0, c};
    const double shift[3] = {x - c * x + s * level, 0.0,
                             level - s * x - c * level - request->sinkage};
    nurbs_patches *placed = NULL;
    nurbs_status status = nurbs_patches_create(&placed);
    for (size_t p = 0; !status && p < nurbs_patches_count(*patches); p++) {
        nurbs_surface *moved = NULL;
        status = nurbs_surface_transform(nurbs_patches_get(*patches, p), turn, shift, &moved);
        if (!status)
            status = nurbs_patches_add(placed, moved);
        nurbs_surface_free(moved);
    }
    if (status) {
        nurbs_patches_free(placed);
        return status;
    }
    nurbs_patches_free(*patches);
    *patches = placed;
    return NURBS_OK;
}

/* The part below the level; sections are lines of constant u, or of constant v where those do not
 * cross the level. */
static nurbs_status cut_patch(const nurbs_surface *patch, double level, double tolerance,
                              nurbs_surface **below)
{
    nurbs_surface *swapped = NULL;
    nurbs_status status = nurbs_surface_wetted(patch, level, tolerance, below);
    if (status != NURBS_ERROR_GEOMETRY)
        return status;
    status = nurbs_surface_swap(patch, &swapped);
    if (!status)
        status = nurbs_surface_wetted(swapped, level, tolerance, below);
    nurbs_surface_free(swapped);
    /* The message that names the patch's own parameters. */
    return status ? nurbs_surface_wetted(patch, level, tolerance, below) : status;
}

/* One patch of the file below the level, moved so that the water lies at z = 0; *wetted NULL when
 * nothing of it is below. */
static nurbs_status wet_patch(const nurbs_surface *patch, double level, double length, int *cut,
                              nurbs_surface **wetted)
{
    double lower[3] = {INFINITY, INFINITY, INFINITY};
    double upper[3] = {-INFINITY, -INFINITY, -INFINITY};
    *wetted = NULL;
    *cut = 0;
    if (!sample_box(patch, lower, upper))
        return NURBS_ERROR_MEMORY;
    if (lower[2] >= level - CLEARANCE * length)
        return NURBS_OK;
    nurbs_surface *below = NULL;
    nurbs_status status;
    if (upper[2] > level + CLEARANCE * length) {
        *cut = 1;
        status = cut_patch(patch, level, CUT_TOLERANCE * length, &below);
    } else {
        status = nurbs_surface_copy(patch, &below);
    }
    const double shift[3] = {0.0, 0.0, -level};
    if (!status && level != 0.0)
        status = nurbs_surface_transform(below, NULL, shift, wetted);
    else if (!status) {
        *wetted = below;
        below = NULL;
    }
    nurbs_surface_free(below);
    return status;
}

static nurbs_status simplify_patch(nurbs_surface **surface, double tolerance, double *bound)
{
    nurbs_surface *light;
    double distance;
    nurbs_status status = nurbs_surface_simplify(
        *surface, tolerance,
        NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_KEEP_KINKS | NURBS_SIMPLIFY_THRIFTY, &light,
        &distance);
    if (status)
        return status;
    nurbs_surface_free(*surface);
    *surface = light;
    *bound = fmax(*bound, distance);
    return NURBS_OK;
}

static size_t control_points(const nurbs_patches *patches)
{
    size_t n = 0;
    for (size_t p = 0; p < nurbs_patches_count(patches); p++) {
        const nurbs_surface *surface = nurbs_patches_get(patches, p);
        n += nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
    }
    return n;
}

/* Level that gives the keel draft amidships: from the keel draft of the hull at the file's own
 * level 0. */
static int level_of_draft(const nurbs_patches *file, const struct hull_request *request,
                          double length, double *level)
{
    nurbs_patches *wetted = NULL;
    const nurbs_surface **list = NULL;
    nurbs_hydrostatics h;
    size_t n = 0;
    nurbs_status status = nurbs_patches_create(&wetted);
    for (size_t p = 0; !status && p < nurbs_patches_count(file); p++) {
        nurbs_surface *below;
        int cut;
        status = wet_patch(nurbs_patches_get(file, p), 0.0, length, &cut, &below);
        if (!status && below)
            status = nurbs_patches_add(wetted, below);
        nurbs_surface_free(below);
    }
    if (!status)
        list = malloc((nurbs_patches_count(wetted) + 1) * sizeof(const nurbs_surface *));
    for (; list && n < nurbs_patches_count(wetted); n++)
        list[n] = nurbs_patches_get(wetted, n);
    if (list)
        status = nurbs_hydrostatics_compute(n, list, 0.0, &h);
    else if (!status)
        status = NURBS_ERROR_MEMORY;
    free(list);
    nurbs_patches_free(wetted);
    if (status) {
        cli_fail("%s: keel draft at z = 0: %s", request->path, nurbs_last_error());
        return CLI_FAILED;
    }
    *level = request->draft - h.keel_draft;
    return CLI_OK;
}

static int prepare(const nurbs_patches *file, const struct hull_request *request, double length,
                   struct hull_input *input)
{
    double tolerance = request->simplify;
    nurbs_status status = nurbs_patches_create(&input->patches);
    for (size_t p = 0; !status && p < nurbs_patches_count(file); p++) {
        nurbs_surface *wetted;
        int cut;
        status = wet_patch(nurbs_patches_get(file, p), input->level, length, &cut, &wetted);
        input->cut |= cut;
        double relative = isnan(tolerance) ? (cut ? DEFAULT_SIMPLIFY : 0.0) : tolerance;
        if (!status && wetted && relative > 0)
            status = simplify_patch(&wetted, relative * length, &input->simplify_bound);
        if (!status && wetted)
            status = nurbs_patches_add(input->patches, wetted);
        nurbs_surface_free(wetted);
    }
    if (status)
        return cli_fail("%s: %s", request->path, nurbs_last_error());
    if (nurbs_patches_count(input->patches) == 0)
        return cli_fail("%s: nothing lies below the still water, z = %g m", request->path,
                        input->level);
    snprintf(input->note, sizeof input->note, "%s at z = %g m, %zu of %zu control points%s",
             input->cut           ? "cut"
             : request->unbounded ? "whole, water left out"
                                  : "used as it is",
             input->level, control_points(input->patches), control_points(file),
             input->simplify_bound > 0 ? " after simplification" : "");
    return CLI_OK;
}

static int create_hull(const struct hull_request *request, double lpp, struct hull_input *input)
{
    double lower[3], upper[3];
    size_t n = nurbs_patches_count(input->patches);
    const nurbs_surface **list = malloc(n * sizeof(const nurbs_surface *));
    if (!list || !file_box(input->patches, lower, upper)) {
        free(list);
        return cli_fail("out of memory");
    }
    for (size_t p = 0; p < n; p++)
        list[p] = nurbs_patches_get(input->patches, p);
    input->half = lower[1] > -CLEARANCE * (upper[0] - lower[0]);
    igabem_status status =
        igabem_hull_create(list, n, input->half ? IGABEM_SYMMETRIC : 0, &input->hull);
    free(list);
    double length = isnan(request->length) ? lpp : request->length;
    if (!status && length > 0)
        status = igabem_hull_set_length(input->hull, length);
    if (status)
        return cli_fail("%s: %s", request->path, igabem_last_error());
    return CLI_OK;
}

int hull_input_read(const struct hull_request *request, struct hull_input *input)
{
    nurbs_patches *file;
    double lower[3], upper[3];
    *input = (struct hull_input){.level = request->level};
    if (nurbs_patches_read(request->path, &file))
        return cli_fail("%s", nurbs_last_error());
    if (nurbs_patches_count(file) == 0 || !file_box(file, lower, upper)) {
        nurbs_patches_free(file);
        return cli_fail("%s: holds no patches, expected at least one", request->path);
    }
    double extent = upper[0] - lower[0];
    input->lpp = nurbs_patches_length(file);
    int code = CLI_OK;
    if (request->unbounded)
        input->level = fmax(request->level, upper[2] + extent);
    else if (!isnan(request->draft))
        code = level_of_draft(file, request, extent, &input->level);
    if (code == CLI_OK && (request->sinkage != 0.0 || request->trim != 0.0) &&
        place(&file, request, input->level))
        code = cli_fail("%s: %s", request->path, nurbs_last_error());
    if (code == CLI_OK)
        code = prepare(file, request, extent, input);
    if (code == CLI_OK)
        code = create_hull(request, input->lpp, input);
    nurbs_patches_free(file);
    if (code != CLI_OK)
        hull_input_free(input);
    return code;
}

const char *hull_stern(const igabem_hull_info *info)
{
    return info->transom == IGABEM_TRANSOM_OPEN     ? "open transom"
           : info->transom == IGABEM_TRANSOM_CLOSED ? "closed transom"
                                                    : "no transom";
}

const char *hull_warning(const igabem_hull_info *info)
{
    if (info->transom == IGABEM_TRANSOM_CLOSED)
        return "closed transom: without viscosity the flow turns round its corner, C_w means "
               "nothing; "
               "leave its patch out for a transom that runs dry";
    if (info->nu_s > 0.35)
        return "full waterline entrance (nu_s > 0.35): no cut-off plateau is known for it, do not "
               "trust C_w";
    if (info->nu_s > 0.29)
        return "full waterline entrance (nu_s > 0.29): C_w depends on the cut-off by 5 to 15 %";
    return "";
}
