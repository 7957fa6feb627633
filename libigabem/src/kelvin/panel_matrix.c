/* Matrices of all pairs of field points and sources or panels, row by row in parallel. */
#include "core/constants.h"
#include "core/error.h"
#include "kelvin/kelvin_green.h"
#include "kelvin/panel_rule.h"
#include "threads.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 64 };

/* One call: what it is given and where it puts the results. */
struct matrix_call {
    double k0;
    size_t n, m;
    const double *points, *normals, *sources;
    const struct panel *panels; /* NULL: point sources */
    igabem_matrix_options options;
    double *value, *gradient, *slope;
};

void igabem_matrix_options_init(igabem_matrix_options *options)
{
    if (options)
        *options = (igabem_matrix_options){
            .parts = IGABEM_RANKINE | IGABEM_IMAGE | IGABEM_LOCAL | IGABEM_WAVE, .tolerance = 1e-4};
}

static igabem_status check(const struct matrix_call *call, const double *what)
{
    const igabem_matrix_options *o = &call->options;
    if (!(call->k0 > 0) || !isfinite(call->k0))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "matrix: k0 is %g, expected > 0", call->k0);
    if ((call->n > 0 && !call->points) || (call->m > 0 && !what))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "matrix: points, sources or panels are NULL");
    if (call->slope && call->n > 0 && !call->normals)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "matrix: slope needs normals, which are NULL");
    if (call->m > 0 && call->n > SIZE_MAX / sizeof(double[3]) / call->m)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "matrix: %zu by %zu is too large", call->n,
                           call->m);
    if (o->threads < 0 || o->threads > MOST_THREADS)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "matrix: threads is %d, expected 0 to %d",
                           o->threads, MOST_THREADS);
    if (!(o->tolerance >= 1e-12 && o->tolerance <= 0.1))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "matrix: tolerance is %g, expected 1e-12 to 0.1",
                           o->tolerance);
    for (size_t i = 0; i < 3 * call->n; i++)
        if (!isfinite(call->points[i]) || (i % 3 == 2 && call->points[i] > 0) ||
            (call->slope && !isfinite(call->normals[i])))
            return igabem_fail(IGABEM_ERROR_ARGUMENT,
                               "field point %zu: expected finite coordinates, z <= 0", i / 3);
    return kelvin_check_parts(o->parts);
}

static void store(const struct matrix_call *call, size_t i, size_t j, const double g[4])
{
    size_t at = i * call->m + j;
    if (call->value)
        call->value[at] = g[0];
    if (call->gradient)
        memcpy(call->gradient + 3 * at, g + 1, 3 * sizeof *g);
    if (call->slope) {
        const double *n = call->normals + 3 * i;
        call->slope[at] = n[0] * g[1] + n[1] * g[2] + n[2] * g[3];
    }
}

/* A row of point sources. */
static igabem_status point_row(const struct matrix_call *call, size_t i)
{
    const double *P = call->points + 3 * i;
    for (size_t first = 0; first < call->m; first += BLOCK) {
        size_t n = call->m - first < BLOCK ? call->m - first : BLOCK;
        double at[3][BLOCK], from[3][BLOCK], g[4][BLOCK];
        for (size_t j = 0; j < n; j++)
            for (int k = 0; k < 3; k++) {
                at[k][j] = P[k];
                from[k][j] = call->sources[3 * (first + j) + (size_t)k];
            }
        igabem_status status = kelvin_green_filtered(call->k0, n, at[0], at[1], at[2], from[0],
                                                     from[1], from[2], call->options.parts,
                                                     &call->options.filter, g[0], g[1], g[2], g[3]);
        if (status != IGABEM_OK) {
            char reason[256];
            snprintf(reason, sizeof reason, "%s", igabem_last_error());
            return igabem_fail(status, "field point %zu, sources from %zu on: %s", i, first,
                               reason);
        }
        for (size_t j = 0; j < n; j++)
            store(call, i, first + j, (double[4]){g[0][j], g[1][j], g[2][j], g[3][j]});
    }
    return IGABEM_OK;
}

/* The closed forms of 1/r and of the image, whose panel is that of the mirrored field point. */
static igabem_status add_poles(const struct matrix_call *call, size_t i, double (*row)[4])
{
    const unsigned parts = call->options.parts;
    const double *P = call->points + 3 * i, mirrored[3] = {P[0], P[1], -P[2]};
    for (size_t j = 0; j < call->m; j++) {
        double direct[4] = {0}, image[4] = {0};
        if (((parts & IGABEM_RANKINE) && !panel_pole(&call->panels[j], P, direct)) ||
            ((parts & (IGABEM_IMAGE | IGABEM_LID)) &&
             !panel_pole(&call->panels[j], mirrored, image)))
            return igabem_fail(IGABEM_ERROR_ARGUMENT,
                               "field point %zu lies on an edge of panel %zu or of its image", i,
                               j);
        double sign = parts & IGABEM_IMAGE ? 1 : -1;
        for (int k = 0; k < 4; k++)
            row[j][k] = (-direct[k] + (k == 3 ? -sign : sign) * image[k]) / (4 * PI);
    }
    return IGABEM_OK;
}

static igabem_status panel_row(const struct matrix_call *call, size_t i, struct panel_rule *rule,
                               double (*row)[4])
{
    igabem_status status = add_poles(call, i, row);
    if (status == IGABEM_OK && (call->options.parts & (IGABEM_LOCAL | IGABEM_WAVE)))
        status = panel_rule_add(rule, call->k0, i, call->points + 3 * i, call->m, call->panels,
                                &call->options, row);
    for (size_t j = 0; status == IGABEM_OK && j < call->m; j++)
        store(call, i, j, row[j]);
    return status;
}

/* Rows first, first + step, ...; returns the first that failed, or n. */
static size_t some_rows(const struct matrix_call *call, size_t first, size_t step,
                        igabem_status *status)
{
    struct panel_rule *rule = NULL;
    double(*row)[4] = NULL;
    size_t i = first;
    *status = IGABEM_OK;
    if (call->panels) {
        rule = panel_rule_create();
        row = calloc(call->m, sizeof *row);
        if (!rule || !row)
            *status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a row of the matrix");
    }
    for (; *status == IGABEM_OK && i < call->n; i += step) {
        *status = call->panels ? panel_row(call, i, rule, row) : point_row(call, i);
        if (*status != IGABEM_OK)
            break;
    }
    panel_rule_free(rule);
    free(row);
    return *status == IGABEM_OK ? call->n : i;
}

static igabem_status all_rows(const struct matrix_call *call)
{
    THREADS(call->options.threads);
    int threads = threads_at_hand();
    if ((size_t)threads > call->n)
        threads = (int)call->n;
    size_t failed = call->n;
#pragma omp parallel for num_threads(threads) schedule(static, 1) reduction(min : failed)
    for (int t = 0; t < threads; t++) {
        igabem_status status;
        size_t row = some_rows(call, (size_t)t, (size_t)threads, &status);
        failed = row < failed ? row : failed;
    }
    if (failed == call->n)
        return IGABEM_OK;
    /* The sentence belongs to the thread that failed: have it said in this one. */
    igabem_status status;
    some_rows(call, failed, call->n, &status);
    return status != IGABEM_OK
               ? status
               : igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a row of the matrix");
}

igabem_status igabem_green_matrix(double k0, size_t n, const double *points, const double *normals,
                                  size_t m, const double *sources,
                                  const igabem_matrix_options *options, double *value,
                                  double *gradient, double *slope)
{
    struct matrix_call call = {.k0 = k0,
                               .n = n,
                               .m = m,
                               .points = points,
                               .normals = normals,
                               .sources = sources,
                               .value = value,
                               .gradient = gradient,
                               .slope = slope};
    igabem_matrix_options_init(&call.options);
    if (options)
        call.options = *options;
    igabem_status status = check(&call, sources);
    return status == IGABEM_OK && n > 0 && m > 0 ? all_rows(&call) : status;
}

igabem_status igabem_panel_matrix(double k0, size_t n, const double *points, const double *normals,
                                  size_t m, const double *corners,
                                  const igabem_matrix_options *options, double *value,
                                  double *gradient, double *slope)
{
    struct matrix_call call = {.k0 = k0,
                               .n = n,
                               .m = m,
                               .points = points,
                               .normals = normals,
                               .value = value,
                               .gradient = gradient,
                               .slope = slope};
    igabem_matrix_options_init(&call.options);
    if (options)
        call.options = *options;
    igabem_status status = check(&call, corners);
    if (status != IGABEM_OK || n == 0 || m == 0)
        return status;
    struct panel *panels = m <= SIZE_MAX / sizeof *panels ? malloc(m * sizeof *panels) : NULL;
    if (!panels)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu panels", m);
    for (size_t j = 0; status == IGABEM_OK && j < m; j++)
        status = panel_frame(j, corners + 12 * j, &panels[j]);
    call.panels = panels;
    if (status == IGABEM_OK)
        status = all_rows(&call);
    free(panels);
    return status;
}

igabem_status igabem_panel_frames(size_t m, const double *corners, double *centroid, double *normal,
                                  double *area)
{
    if (m > 0 && !corners)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "panels: corners are NULL");
    for (size_t j = 0; j < m; j++) {
        struct panel panel;
        igabem_status status = panel_frame(j, corners + 12 * j, &panel);
        if (status != IGABEM_OK)
            return status;
        if (centroid)
            memcpy(centroid + 3 * j, panel.centroid, sizeof panel.centroid);
        if (normal)
            memcpy(normal + 3 * j, panel.normal, sizeof panel.normal);
        if (area)
            area[j] = panel.area;
    }
    return IGABEM_OK;
}
