/* What zones along the hull contribute to the wave resistance. With H = Sum H_k over zones,
 * |H|^2 = Sum Re(H_k conj H): the interference of two zones goes to both in equal parts. */
#include "core/error.h"
#include "result/amplitude.h"
#include "result/radiation.h"
#include "threads.h"

#include <math.h>
#include <stdlib.h>

/* Zone of x among n limits that decrease from the bow. */
static size_t zone_of(size_t n, const double *limit, double x)
{
    size_t zone = 0;
    while (zone < n && x < limit[zone])
        zone++;
    return zone;
}

/* The sources of one zone as a view of its own: x, y, z, strength of the surface and x, y, strength
 * of the line, in the order of the whole, and the dipoles of a potential. Fills
 * room[7 n + 4 n_line] of the whole. */
static void take_zone(const struct sources *whole, size_t n_limits, const double *limit,
                      size_t zone, double *room, struct sources *part)
{
    *part = (struct sources){.symmetric = whole->symmetric,
                             .x = room,
                             .y = room + whole->n,
                             .z = room + 2 * whole->n,
                             .strength = room + 3 * whole->n};
    part->line_x = room + 7 * whole->n;
    part->line_y = part->line_x + whole->n_line;
    part->line_strength = part->line_y + whole->n_line;
    for (size_t c = 0; c < 3 && whole->dipole[0]; c++)
        part->dipole[c] = room + (4 + c) * whole->n;
    if (whole->dipole[0])
        part->line_dipole = part->line_strength + whole->n_line;
    for (size_t j = 0; j < whole->n; j++) {
        if (zone_of(n_limits, limit, whole->x[j]) != zone)
            continue;
        part->x[part->n] = whole->x[j];
        part->y[part->n] = whole->y[j];
        part->z[part->n] = whole->z[j];
        for (size_t c = 0; c < 3 && part->dipole[0]; c++)
            part->dipole[c][part->n] = whole->dipole[c][j];
        part->strength[part->n++] = whole->strength[j];
    }
    for (size_t j = 0; j < whole->n_line; j++) {
        if (zone_of(n_limits, limit, whole->line_x[j]) != zone)
            continue;
        part->line_x[part->n_line] = whole->line_x[j];
        part->line_y[part->n_line] = whole->line_y[j];
        if (part->line_dipole)
            part->line_dipole[part->n_line] = whole->line_dipole[j];
        part->line_strength[part->n_line++] = whole->line_strength[j];
    }
}

/* Adds weight times h times the conjugate of whole, real part, for both signs of t. */
static igabem_status zone_products(const struct sources *part, double k0, size_t n, const double *t,
                                   const double *weight, const double *whole, double *sum)
{
    double *product = malloc(n * sizeof *product);
    if (!product)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu wave angles", n);
#pragma omp parallel for schedule(dynamic, 8)
    for (size_t i = 0; i < n; i++) {
        double h[2];
        amplitude(part, k0, t[i], h);
        product[i] = h[0] * whole[4 * i] + h[1] * whole[4 * i + 1];
        if (!part->symmetric)
            amplitude(part, k0, -t[i], h);
        product[i] += h[0] * whole[4 * i + 2] + h[1] * whole[4 * i + 3];
    }
    *sum = 0.0;
    for (size_t i = 0; i < n; i++)
        *sum += weight[i] * sqrt(1.0 + t[i] * t[i]) * product[i];
    free(product);
    return IGABEM_OK;
}

static igabem_status zone_shares(const struct sources *sources, double k0, size_t n_t,
                                 const double *t, const double *weight, size_t n, const double *x,
                                 double *share)
{
    double *whole = malloc(4 * n_t * sizeof *whole);
    double *room = malloc((7 * sources->n + 4 * sources->n_line + 1) * sizeof *room);
    igabem_status status = whole && room
                               ? IGABEM_OK
                               : igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the wave shares");
    if (!status) {
#pragma omp parallel for schedule(dynamic, 8)
        for (size_t i = 0; i < n_t; i++) {
            amplitude(sources, k0, t[i], whole + 4 * i);
            amplitude(sources, k0, -t[i], whole + 4 * i + 2);
        }
    }
    double total = 0.0;
    for (size_t zone = 0; !status && zone <= n; zone++) {
        struct sources part;
        take_zone(sources, n, x, zone, room, &part);
        status = zone_products(&part, k0, n_t, t, weight, whole, &share[zone]);
        total += share[zone];
    }
    free(whole);
    free(room);
    if (!status && !(total > 0 && isfinite(total)))
        status = igabem_fail(IGABEM_ERROR_NUMERIC,
                             "the hull radiates no waves that could be shared out");
    for (size_t zone = 0; !status && zone <= n; zone++)
        share[zone] /= total;
    return status;
}

igabem_status igabem_wave_shares(const igabem_solution *solution, size_t n, const double *x,
                                 double *share)
{
    if (!solution || (n && !x) || !share)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_wave_shares");
    if (!solution->waves)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "this solution has no free surface, expected the Kelvin kernel");
    for (size_t i = 0; i < n; i++)
        if (!isfinite(x[i]) || (i > 0 && !(x[i] < x[i - 1])))
            return igabem_fail(IGABEM_ERROR_ARGUMENT,
                               "limit %zu is x = %g m, expected values that decrease from the bow",
                               i, x[i]);
    THREADS(solution->options.threads);
    struct sources *sources;
    double limit = radiation_limit(solution), length, beam;
    igabem_status status = radiation_sources(solution, RADIATION_AS_SOLVED, limit, n, x, &sources);
    if (status)
        return status;
    radiation_extent(solution, &length, &beam);
    size_t n_t;
    double *t, *weight;
    status = amplitude_rule(solution->k0, length, beam, limit, 0.0, &n_t, &t, &weight);
    if (!status) {
        status = zone_shares(sources, solution->k0, n_t, t, weight, n, x, share);
        free(t);
        free(weight);
    }
    sources_free(sources);
    return status;
}
