/* What looks like no ship, or not like the ship that was meant, with the call that mends it. */
#include "core/error.h"
#include "hull/hull.h"
#include "mesh/mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { HINT_SIZE = 220 };

/* The longest ships have 460 to 490 m; the shortest towing tank models half a metre, but bodies of
 * unit length are common, and scaled ones. */
static const double longest = 600, shortest = 0.02;

/* A length between perpendiculars over that of the body: beyond `most` times it or its part it
 * belongs to another body or unit, beyond `usual` it deserves a look. */
static const double most = 3, usual = 1.3;

static const double companion = 0.2;    /* of the longer body: shorter ones are rudders, struts */
static const double reach = 5e-3;       /* of the length: a bulb ahead of the waterline */
static const double fuller_fore = 0.01; /* of the length: LCF ahead of LCB */
static const double off_centre = 0.05;  /* of the breadth */

/* What a box of sizes says when the unit or the axes are others; "" if nothing. */
static void hint_of_size(const hull_box *box, char hint[HINT_SIZE])
{
    double size[3];
    for (int c = 0; c < 3; c++)
        size[c] = box->upper[c] - box->lower[c];
    bool one_side = box->lower[1] >= -off_centre * box->upper[1];
    double breadth = one_side ? 2 * box->upper[1] : size[1];
    *hint = '\0';
    if (fmax(size[0], size[1]) > longest)
        snprintf(hint, HINT_SIZE,
                 "%.4g m long, more than any ship: if its millimetres were taken for metres, "
                 "'nurbs clean --scale 0.001' mends it",
                 fmax(size[0], size[1]));
    else if (fmax(size[0], size[1]) < shortest)
        snprintf(hint, HINT_SIZE,
                 "%.4g m long, less than any model: if its metres were taken for millimetres, "
                 "'nurbs clean --scale 1000' mends it",
                 fmax(size[0], size[1]));
    else if (size[2] > fmax(size[0], size[1]))
        snprintf(hint, HINT_SIZE,
                 "%.4g m high and %.4g m long: if z is not upward, 'nurbs clean --axes' names the "
                 "axes of the file",
                 size[2], size[0]);
    else if (breadth > size[0] && size[1] > size[0])
        snprintf(hint, HINT_SIZE,
                 "%.4g m wide and %.4g m long: if x does not run along the ship, 'nurbs clean "
                 "--axes yxz' exchanges x and y",
                 breadth, size[0]);
}

/* Where the box lies, for a hull that was refused. */
static void hint_of_place(const nurbs_hull *hull, const hull_box *box, char hint[HINT_SIZE])
{
    double clearance = HULL_CLEARANCE * hull->extent, low = box->lower[1], high = box->upper[1],
           middle = 0.5 * (low + high), breadth = high - low;
    bool draft = !isnan(hull->options.draft);
    *hint = '\0';
    if (!hull->options.unbounded && hull->level > box->upper[2] + clearance)
        snprintf(hint, HINT_SIZE,
                 "the still water lies %.4g m above its highest point, and it is only %.4g m deep: "
                 "is the %s right?",
                 hull->level - box->upper[2], box->upper[2] - box->lower[2],
                 draft ? "draft" : "level ('nurbs clean --level Z' or '--draft T')");
    else if (!hull->options.unbounded && hull->level <= box->lower[2])
        snprintf(hint, HINT_SIZE,
                 "it lies between z = %.6g and %.6g m: 'nurbs clean --level Z' says where the "
                 "still water is",
                 box->lower[2], box->upper[2]);
    else if (low > clearance || (low < -clearance && -low < off_centre * high))
        snprintf(hint, HINT_SIZE,
                 "its sides begin at y = %.4g m: if the centre plane of a half is there, 'nurbs "
                 "clean --shift 0,%.6g,0' mends it",
                 low, -low);
    else if (low < -off_centre * high && fabs(middle) > 1e-3 * breadth &&
             fabs(middle) < 0.5 * breadth)
        snprintf(hint, HINT_SIZE,
                 "its middle lies at y = %.6g m: if the centre plane is there, 'nurbs clean "
                 "--shift 0,%.6g,0' mends it, if the axes are others, '--axes'",
                 middle, -middle);
}

static int by_start(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Two bodies one behind the other: a stretch of x without patches; what is beyond it is no rudder
 * but long. "" if there are none. */
static nurbs_status hint_of_bodies(const nurbs_patches *patches, char hint[HINT_SIZE])
{
    size_t n = nurbs_patches_count(patches);
    double(*range)[2] = malloc((n + 1) * sizeof *range);
    *hint = '\0';
    if (!range)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < n && !status; k++) {
        hull_box box = hull_box_empty();
        status = hull_box_widen(nurbs_patches_get(patches, k), &box);
        range[k][0] = box.lower[0];
        range[k][1] = box.upper[0];
    }
    if (!status) {
        qsort(range, n, sizeof *range, by_start);
        double end = range[0][1], last = end;
        for (size_t k = 0; k < n; k++)
            last = fmax(last, range[k][1]);
        for (size_t k = 1; k < n; end = fmax(end, range[k++][1])) {
            double first = end - range[0][0], second = last - range[k][0];
            if (range[k][0] > end && fmin(first, second) > companion * fmax(first, second))
                snprintf(hint, HINT_SIZE,
                         "two bodies one behind the other, x = %.6g ... %.6g and %.6g ... %.6g m: "
                         "'nurbs clean --keep' or '--drop' chooses the patches of one",
                         range[0][0], end, range[k][0], last);
        }
    }
    free(range);
    return status;
}

nurbs_status hull_refuse_with_hint(const nurbs_hull *hull, const hull_box *box, nurbs_status status)
{
    char hint[HINT_SIZE], sentence[512];
    if (status != NURBS_ERROR_GEOMETRY)
        return status;
    snprintf(sentence, sizeof sentence, "%s", nurbs_last_error());
    hint_of_size(box, hint);
    if (!*hint && hint_of_bodies(hull->full, hint))
        return status;
    if (!*hint)
        hint_of_place(hull, box, hint);
    if (!*hint)
        return status;
    return nurbs_fail(status, "%s (%s)", sentence, hint);
}

/* The reference length, from the file or an option, against the body's own. */
static nurbs_status check_length(nurbs_hull *hull)
{
    bool option = !isnan(hull->options.length);
    double length = hull->length, body = hull->extent;
    if (!(length > 0 && body > 0))
        return NURBS_OK;
    if (length > most * body || length < body / most)
        return nurbs_fail(NURBS_ERROR_GEOMETRY,
                          "the reference length %s is %.6g m, %.3g times that of the body, %.6g m: "
                          "%s",
                          option ? "asked for" : "of the file", length, length / body, body,
                          option ? "are both in metres?"
                                 : "'nurbs clean --lpp L' says the right one");
    const nurbs_hydrostatics *h = &hull->hydrostatics;
    double waterline = h->x_fore - h->x_aft;
    if (length > usual * waterline || length < waterline / usual)
        return hull_tell(hull, "the reference length is %.6g m, the waterline %.6g m long", length,
                         waterline);
    return NURBS_OK;
}

/* The bow is where a bulb reaches ahead of the waterline; and the waterplane of nearly every ship
 * is fuller aft, so that its centre lies abaft that of the volume. "" if nothing speaks against it.
 */
static void hint_of_bow(const hull_box *wetted, const nurbs_hydrostatics *h, char hint[HINT_SIZE])
{
    static const char mend[] = "if the bow is at small x, 'nurbs clean --flip x' mends it";
    double length = h->x_fore - h->x_aft, aft = h->x_aft - wetted->lower[0],
           fore = wetted->upper[0] - h->x_fore;
    *hint = '\0';
    if (!(length > 0) || fore > reach * length)
        return;
    if (aft > reach * length)
        snprintf(hint, HINT_SIZE,
                 "below the water it reaches %.3g m beyond the waterline at small x, as bulbs do: "
                 "%s",
                 aft, mend);
    else if (h->waterplane_centre > h->centroid[0] + fuller_fore * length)
        snprintf(hint, HINT_SIZE,
                 "the waterplane is fuller at large x (LCF %.6g m, LCB %.6g m), as ships are aft: "
                 "%s",
                 h->waterplane_centre, h->centroid[0], mend);
}

static nurbs_status doubt_bow(nurbs_hull *hull)
{
    char hint[HINT_SIZE];
    hull_box box;
    if (!hull->waterline)
        return NURBS_OK;
    nurbs_status status = hull_box_of(hull->wetted, &box);
    if (status)
        return status;
    hint_of_bow(&box, &hull->hydrostatics, hint);
    return *hint ? hull_tell(hull, "%s", hint) : NURBS_OK;
}

nurbs_status hull_doubt(nurbs_hull *hull, const hull_box *file)
{
    char hint[HINT_SIZE];
    nurbs_status status = check_length(hull);
    if (status)
        return hull_refuse_with_hint(hull, file, status);
    hint_of_size(file, hint);
    if (!status && *hint)
        status = hull_tell(hull, "%s", hint);
    if (!status)
        status = hint_of_bodies(hull->wetted, hint);
    if (!status && *hint)
        status = hull_tell(hull, "%s", hint);
    return status ? status : doubt_bow(hull);
}

nurbs_status nurbs_mesh_doubt(const nurbs_mesh *mesh, double level, const nurbs_hydrostatics *h,
                              size_t size, char *sentence)
{
    if (!mesh || !h || !sentence || size == 0)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "nurbs_mesh_doubt: a mesh, its hydrostatics and "
                                                "room for a sentence are expected");
    char hint[HINT_SIZE];
    hull_box all = hull_box_empty(), wetted = hull_box_empty();
    for (size_t k = 0; k < mesh->vertices; k++) {
        const double *p = mesh->points + 3 * k;
        for (int c = 0; c < 3; c++) {
            all.lower[c] = fmin(all.lower[c], p[c]);
            all.upper[c] = fmax(all.upper[c], p[c]);
        }
        if (p[2] < level) {
            wetted.lower[0] = fmin(wetted.lower[0], p[0]);
            wetted.upper[0] = fmax(wetted.upper[0], p[0]);
        }
    }
    hint_of_size(&all, hint);
    if (!*hint)
        hint_of_bow(&wetted, h, hint);
    snprintf(sentence, size, "%s", hint);
    return NURBS_OK;
}
