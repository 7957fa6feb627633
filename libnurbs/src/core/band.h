/* Sparse rows that map the control points of one knot vector to those of another: insertion,
 * elevation, Bezier extraction. Row j combines `width` consecutive control points from first[j]. */
#ifndef NURBS_BAND_H
#define NURBS_BAND_H

#include "core/object.h"

struct band {
    size_t rows;
    size_t width;
    size_t *first;
    double *values; /* rows * width */
};

nurbs_status band_create(size_t rows, size_t width, struct band *band);
/* Takes a band of zeros. */
void band_free(struct band *band);

/* out[rows][columns] = band * in[.][columns]. */
void band_apply(const struct band *band, size_t columns, const double *in, double *out);

/* Weights of the blossom f(args[0], ..., args[p-1]) of the polynomial on the non-empty span:
 * fills weights[p + 1] for the control points span - p ... span. */
void blossom(int degree, const double *knots, size_t span, const double *args, double *weights);

/* Rows that give the control points over `target` (target_size + degree + 1 clamped knots), whose
 * domain lies in that of `axis` and which holds every knot of `axis` inside that domain. */
nurbs_status band_insertion(const struct axis *axis, size_t target_size, const double *target,
                            struct band *band);

/* Rows for one degree more. elevated: knots of that degree, one more of each distinct knot. */
nurbs_status band_elevation(const struct axis *axis, size_t elevated_size, const double *elevated,
                            struct band *band);

/* The curve or surface whose control points along the axis (direction) are the band's rows. */
nurbs_status curve_map(const nurbs_curve *curve, const struct band *band, int degree,
                       const double *knots, nurbs_curve **result);
nurbs_status surface_map(const nurbs_surface *surface, int direction, const struct band *band,
                         int degree, const double *knots, nurbs_surface **result);

#endif
