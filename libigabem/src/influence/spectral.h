/* What the spectral sum of the wave part works on: wave angles, sources and points, both from bow
 * to stern. */
#ifndef SPECTRAL_H
#define SPECTRAL_H

#include "influence/influence.h"
#include "influence/spectrum.h"
#include "space/quadrature_wave.h"

/* A panel or a segment of the waterline. */
struct source {
    const struct element *element; /* one of the panel's: they share their functions */
    const struct panel *panel;
    const struct line_segment *segment; /* NULL: the panel */
    double box[2];                      /* bounds of x */
    double *moments;                    /* [function][set][re, im][angle] */
};

struct spectral {
    const struct influence *influence;
    const struct line *line;
    struct spectrum *spectrum;
    size_t sets;   /* cos(eta) alone, or cos and sin without symmetry */
    size_t width;  /* 2 sets n: length of a moment */
    double k0, x0; /* phases are measured from x0 */
    double depth;  /* of the shallowest source */
    double slack;  /* sources this far behind a point still count as ahead of it, m */
    struct wave_rule rule;
    size_t filters;
    const double *cutoff;
    double *filter;        /* [filters][angles]; after the first, differences from it */
    const double *weight;  /* of the rows, NULL: 1 */
    struct source *source; /* by decreasing box[0] */
    size_t sources;
    size_t *point; /* wanted rows, by decreasing x */
    size_t points;
    double *storage;
    struct filter_change *change; /* NULL with one filter */
};

/* Fills the rest of *wave from influence, line, sets, k0, filters, cutoff and weight; moments of
 * the sources are left empty. To be freed also after an error. */
igabem_status spectral_create(struct spectral *wave);
/* Frees all but the change. */
void spectral_free(struct spectral *wave);

/* Number of leading angles that reach down and up again over a path of this depth, to a hundredth
 * of the tolerance because they are many. */
size_t spectral_angles(const struct spectral *wave, double depth);

/* Appends the nodes of the part of a source ahead of x (-INFINITY: all of it). */
void spectral_nodes(const struct spectral *wave, const struct source *source, double x,
                    const struct wave_rule *rule, struct nodes *nodes);

/* Basis functions of an element. */
size_t spectral_functions(const struct element *element);

#endif
