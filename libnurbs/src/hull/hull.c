#include "hull/hull.h"

#include "core/error.h"
#include "hull/source.h"
#include "hull/space.h"

#include <nurbs/io.h>
#include <nurbs/topology.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { REPORT_SIZE = 4000 };

static const double default_cut = 1e-5; /* of the extent */

void nurbs_hull_options_init(nurbs_hull_options *options)
{
    if (options)
        *options = (nurbs_hull_options){
            .draft = NAN, .length = NAN, .cut = NAN, .simplify = NAN, .sections = NAN};
}

static nurbs_status check_options(const nurbs_hull_options *o)
{
    if (!isfinite(o->level) || !isfinite(o->sinkage) || !isfinite(o->trim) || !isfinite(o->pivot))
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "level %g, sinkage %g, trim %g, pivot %g: expected finite numbers",
                          o->level, o->sinkage, o->trim, o->pivot);
    if (!isnan(o->length) && !(o->length > 0 && isfinite(o->length)))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "length %g m, expected a positive one", o->length);
    if (o->sections < 0 || isinf(o->sections))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "tolerance %g m of sections, expected > 0",
                          o->sections);
    if (o->cut <= 0 || isinf(o->cut) || o->simplify < 0 || isinf(o->simplify))
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "tolerances %g of the cut and %g of the simplification, expected "
                          "positive ones",
                          o->cut, o->simplify);
    return NURBS_OK;
}

nurbs_status hull_tell(nurbs_hull *hull, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int length = vsnprintf(NULL, 0, format, args);
    va_end(args);
    char **more = realloc(hull->step, (hull->steps + 1) * sizeof *more);
    if (more)
        hull->step = more;
    char *sentence = more && length >= 0 ? malloc((size_t)length + 1) : NULL;
    if (!sentence)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu sentences", hull->steps + 1);
    va_start(args, format);
    vsnprintf(sentence, (size_t)length + 1, format, args);
    va_end(args);
    hull->step[hull->steps++] = sentence;
    return NURBS_OK;
}

/* The sentence about the water is told last and read first. */
static void water_first(nurbs_hull *hull)
{
    char *last = hull->step[hull->steps - 1];
    memmove(hull->step + 1, hull->step, (hull->steps - 1) * sizeof *hull->step);
    hull->step[0] = last;
}

static void choose_length(nurbs_hull *hull)
{
    const nurbs_hydrostatics *h = &hull->hydrostatics;
    hull->length = hull->options.length;
    if (isnan(hull->length))
        hull->length = hull->lpp;
    if (!(hull->length > 0))
        hull->length = h->x_fore - h->x_aft;
}

void hull_replace_full(nurbs_hull *hull, nurbs_patches *patches)
{
    nurbs_patches_free(hull->full);
    hull->full = patches;
}

/* Back to the file's patches before they were cut. */
static void dry(nurbs_hull *hull)
{
    if (hull->light != hull->wetted)
        nurbs_patches_free(hull->light);
    nurbs_patches_free(hull->wetted);
    hull->light = hull->wetted = NULL;
    hull->cut = false;
    hull->bound = hull->deviation = hull->lifted = 0;
}

/* x -> lower + upper - x. */
static nurbs_status turn_round(nurbs_hull *hull)
{
    hull_box box;
    nurbs_patches *turned = NULL;
    const double matrix[9] = {-1, 0, 0, 0, 1, 0, 0, 0, 1};
    nurbs_status status = hull_box_of(hull->full, &box);
    const double shift[3] = {box.lower[0] + box.upper[0], 0, 0};
    if (!status)
        status = nurbs_patches_transform(hull->full, matrix, shift, &turned);
    if (status)
        return status;
    hull_replace_full(hull, turned);
    return hull_tell(hull,
                     "open at the end of large x, so the bow lies at small x: x turned to %.6g "
                     "m - x",
                     shift[0]);
}

static nurbs_status wet_and_check(nurbs_hull *hull, bool *bow_aft)
{
    *bow_aft = false;
    size_t told = hull->steps;
    nurbs_status status = hull_wet(hull);
    if (!status)
        status = hull_side(hull);
    if (!status)
        status = hull_check_edges(hull, bow_aft);
    while (*bow_aft && hull->steps > told)
        free(hull->step[--hull->steps]);
    return status;
}

static nurbs_status clean(nurbs_hull *hull)
{
    hull_box box;
    bool covers = !hull->options.unbounded;
    nurbs_status status = hull_leave_out_centre(hull);
    /* Decks and transoms from side to side say nothing of the sides; a level that a draft sets is
     * known later. */
    hull->level = hull->options.level;
    if (!status && covers && isnan(hull->options.draft))
        status = hull_leave_out_covers(hull);
    if (!status)
        status = hull_take_half(hull);
    if (!status)
        status = hull_box_of(hull->full, &box);
    if (!status)
        status = hull_choose_level(hull, &box);
    if (!status && covers)
        status = hull_leave_out_covers(hull);
    return status;
}

/* Numbers of the patches in the file, and what is relative to the extent. */
static nurbs_status prepare(nurbs_hull *hull, const hull_box *box)
{
    size_t n = nurbs_patches_count(hull->full);
    hull->number = malloc(n * sizeof *hull->number);
    if (!hull->number)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    for (size_t k = 0; k < n; k++)
        hull->number[k] = k;
    hull->extent = box->upper[0] - box->lower[0];
    if (isnan(hull->options.cut))
        hull->options.cut = default_cut * hull->extent;
    hull->lpp = nurbs_patches_length(hull->full);
    return NURBS_OK;
}

static nurbs_status place_and_wet(nurbs_hull *hull)
{
    bool bow_aft = false;
    nurbs_status status = clean(hull);
    if (!status && hull->options.single && nurbs_patches_count(hull->full) > 1)
        status = hull_join(hull);
    if (!status)
        status = hull_place(hull);
    if (!status)
        status = wet_and_check(hull, &bow_aft);
    if (status && bow_aft) {
        dry(hull);
        status = turn_round(hull);
        if (!status)
            status = wet_and_check(hull, &bow_aft);
    }
    if (!status)
        status = hull_measure(hull);
    return status ? status : hull_check_volume(hull);
}

static nurbs_status make(nurbs_hull *hull)
{
    hull_box box;
    if (nurbs_patches_count(hull->full) == 0)
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "holds no patches, expected at least one");
    nurbs_status status = hull_box_of(hull->full, &box);
    if (!status)
        status = prepare(hull, &box);
    if (status)
        return status;
    hull->level = hull->options.level;
    status = place_and_wet(hull);
    if (status)
        return hull_refuse_with_hint(hull, &box, status);
    water_first(hull);
    choose_length(hull);
    return hull_doubt(hull, &box);
}

static nurbs_status start(const nurbs_hull_options *options, nurbs_hull **hull)
{
    nurbs_hull *result = calloc(1, sizeof *result);
    if (!result)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a hull");
    if (options)
        result->options = *options;
    else
        nurbs_hull_options_init(&result->options);
    if (result->options.sections == 0)
        result->options.sections = NAN;
    nurbs_status status = check_options(&result->options);
    if (status) {
        nurbs_hull_free(result);
        return status;
    }
    *hull = result;
    return NURBS_OK;
}

/* Surfaces that a loop cuts come whole at first, which tells how large the hull is and so how
 * closely they have to be resampled inside their loops. */
nurbs_status nurbs_hull_read_patches(const char *path, double tolerance, nurbs_patches **patches,
                                     char *report, size_t report_size)
{
    hull_box box;
    if (!path || !patches || !report || report_size == 0)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "path, patches or report is NULL");
    double volume;
    if (hull_source_of(path) != HULL_SOURCE_PATCHES)
        return hull_source_read(path, NAN, 0, patches, &volume, report, report_size);
    nurbs_status status = nurbs_patches_read_reported(path, 0.0, patches, report, report_size);
    if (status || !strstr(report, "the whole surface is kept"))
        return status;
    if (isnan(tolerance)) {
        status = hull_box_of(*patches, &box);
        tolerance = default_cut * (box.upper[0] - box.lower[0]);
    }
    nurbs_patches_free(*patches);
    *patches = NULL;
    return status ? status
                  : nurbs_patches_read_reported(path, tolerance, patches, report, report_size);
}

static nurbs_status read_file(const char *path, nurbs_hull *hull)
{
    char report[REPORT_SIZE];
    nurbs_status status =
        hull_source_of(path) == HULL_SOURCE_PATCHES
            ? nurbs_hull_read_patches(path, hull->options.cut, &hull->full, report, sizeof report)
            : hull_source_read(path, hull->options.sections, hull->options.level, &hull->full,
                               &hull->triangles, report, sizeof report);
    if (!isnan(hull->options.draft) || hull->options.unbounded)
        hull->triangles = 0;
    return !status && *report ? hull_tell(hull, "%s", report) : status;
}

nurbs_status nurbs_hull_read(const char *path, const nurbs_hull_options *options, nurbs_hull **hull)
{
    if (!path || !hull)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "path or hull is NULL");
    *hull = NULL;
    nurbs_hull *result = NULL;
    nurbs_status status = start(options, &result);
    if (status)
        return status;
    status = read_file(path, result);
    if (!status) {
        status = make(result);
        if (status)
            status = nurbs_fail_in(status, path);
    }
    if (status) {
        nurbs_hull_free(result);
        return status;
    }
    *hull = result;
    return NURBS_OK;
}

nurbs_status nurbs_hull_create(const nurbs_patches *patches, const nurbs_hull_options *options,
                               nurbs_hull **hull)
{
    const double none[3] = {0, 0, 0};
    if (!patches || !hull)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "patches or hull is NULL");
    *hull = NULL;
    nurbs_hull *result = NULL;
    nurbs_status status = start(options, &result);
    if (status)
        return status;
    status = nurbs_patches_transform(patches, NULL, none, &result->full);
    if (!status)
        status = make(result);
    if (status) {
        nurbs_hull_free(result);
        return status;
    }
    *hull = result;
    return NURBS_OK;
}

nurbs_status nurbs_hull_create_surfaces(size_t n, const nurbs_surface *const *surfaces,
                                        const nurbs_hull_options *options, nurbs_hull **hull)
{
    nurbs_patches *patches = NULL;
    if (!n || !surfaces || !hull)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "surfaces and a place for the hull must be given");
    *hull = NULL;
    nurbs_status status = nurbs_patches_create(&patches);
    for (size_t k = 0; k < n && !status; k++)
        status = nurbs_patches_add(patches, surfaces[k]);
    if (!status)
        status = nurbs_hull_create(patches, options, hull);
    nurbs_patches_free(patches);
    return status;
}

void nurbs_hull_free(nurbs_hull *hull)
{
    if (!hull)
        return;
    if (hull->light != hull->wetted)
        nurbs_patches_free(hull->light);
    nurbs_patches_free(hull->wetted);
    nurbs_patches_free(hull->full);
    hull_space_free(hull->space);
    for (size_t k = 0; k < hull->steps; k++)
        free(hull->step[k]);
    free(hull->step);
    free(hull->number);
    free(hull);
}

const nurbs_patches *nurbs_hull_full(const nurbs_hull *hull)
{
    return hull ? hull->full : NULL;
}

const nurbs_patches *nurbs_hull_wetted(const nurbs_hull *hull)
{
    return hull ? hull->wetted : NULL;
}

const nurbs_patches *nurbs_hull_light(const nurbs_hull *hull)
{
    return hull ? hull->light : NULL;
}

double nurbs_hull_bound(const nurbs_hull *hull)
{
    return hull ? hull->bound : 0;
}

double nurbs_hull_deviation(const nurbs_hull *hull)
{
    return hull ? hull->deviation : 0;
}

double nurbs_hull_level(const nurbs_hull *hull)
{
    return hull ? hull->level : 0;
}

double nurbs_hull_length(const nurbs_hull *hull)
{
    return hull ? hull->length : 0;
}

double nurbs_hull_lpp(const nurbs_hull *hull)
{
    return hull ? hull->lpp : 0;
}

bool nurbs_hull_is_half(const nurbs_hull *hull)
{
    return hull && hull->half;
}

bool nurbs_hull_is_cut(const nurbs_hull *hull)
{
    return hull && hull->cut;
}

bool nurbs_hull_has_waterline(const nurbs_hull *hull)
{
    return hull && hull->waterline;
}

const nurbs_hydrostatics *nurbs_hull_hydrostatics(const nurbs_hull *hull)
{
    return hull ? &hull->hydrostatics : NULL;
}

const char *nurbs_hull_step(const nurbs_hull *hull, size_t number)
{
    return hull && number < hull->steps ? hull->step[number] : NULL;
}

nurbs_status nurbs_hull_write(const nurbs_hull *hull, const char *note, const char *path)
{
    const double none[3] = {0, 0, 0};
    nurbs_patches *copy = NULL;
    if (!hull || !path)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "hull or path is NULL");
    nurbs_status status = nurbs_patches_transform(hull->full, NULL, none, &copy);
    if (!status)
        status = nurbs_patches_set_note(copy, note);
    if (!status)
        status = nurbs_patches_set_length(copy, hull->length);
    if (!status)
        status = nurbs_patches_write(copy, path);
    nurbs_patches_free(copy);
    return status;
}
