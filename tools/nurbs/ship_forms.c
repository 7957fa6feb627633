#include "ship_forms.h"

#include <nurbs/basis.h>

#include <math.h>

enum { DEGREE = 3, ALONG = 30, AROUND = 14 };

static const double HALF_PI = 1.57079632679489661923;
static const double BENT = 0.14; /* share of the length in which sections bend into the stem */
static const double BULB_REACH = 0.12; /* share of the length over which the bulb grows */
static const double BULB_PLACE = 0.72; /* of the half girth from waterline to keel */
static const double BULB_WIDTH = 0.22; /* of the same */

struct ship_form ship_form_fast(double length, double beam, double draft)
{
    return (struct ship_form){.length = length,
                              .beam = beam,
                              .draft = draft,
                              .fullest = 0.4,
                              .transom_beam = 0.8,
                              .transom_draft = 0.2,
                              .run = 0.5,
                              .entrance = 2.0,
                              .section = {3.0, 2.4, 1.5},
                              .rake = 0.05};
}

struct ship_form ship_form_bulb(double length, double beam, double draft)
{
    return (struct ship_form){.length = length,
                              .beam = beam,
                              .draft = draft,
                              .fullest = 0.45,
                              .transom_beam = 0.45,
                              .transom_draft = 0.08,
                              .run = 0.35,
                              .entrance = 2.0,
                              .section = {2.2, 3.2, 1.6},
                              .rake = 0.0,
                              .bulb_length = 0.025,
                              .bulb_beam = 0.1};
}

static double smooth_step(double s)
{
    s = fmin(1.0, fmax(0.0, s));
    return s * s * (3.0 - 2.0 * s);
}

/* Half breadth of the waterline at s = x/L. */
static double half_breadth(const struct ship_form *form, double s)
{
    double m = form->fullest;
    double share = s < m ? 1.0 - (1.0 - form->transom_beam) * pow((m - s) / m, 2.0)
                         : 1.0 - pow((s - m) / (1.0 - m), form->entrance);
    return 0.5 * form->beam * fmax(0.0, share);
}

static double keel_draft(const struct ship_form *form, double s)
{
    double rise = fmax(0.0, 1.0 - s / form->run);
    return form->draft * (1.0 - (1.0 - form->transom_draft) * rise * rise);
}

static double section_exponent(const struct ship_form *form, double s)
{
    double m = form->fullest;
    int end = s < m ? 0 : 2;
    double share = smooth_step(end == 0 ? (m - s) / m : (s - m) / (1.0 - m));
    return form->section[1] + share * (form->section[end] - form->section[1]);
}

/* Bell over the half girth, 0 at the waterline and at the keel. */
static double bulb_bell(double v)
{
    double d = (v - BULB_PLACE) / BULB_WIDTH;
    return exp(-d * d) * sin(2.0 * HALF_PI * fmin(1.0, fmax(0.0, v)));
}

static void form_point(const struct ship_form *form, double s, double v, double point[3])
{
    double power = 2.0 / section_exponent(form, s), angle = HALF_PI * v;
    double side = v < 1.0 ? pow(cos(angle), power) : 0.0;
    double depth = v > 0.0 ? pow(sin(angle), power) : 0.0;
    double bend = smooth_step((s - 1.0 + BENT) / BENT);
    double into = fmax(0.0, (s - 1.0 + BULB_REACH) / BULB_REACH);
    double bulb = bulb_bell(v);
    point[0] = form->length * (s + bend * (form->bulb_length * bulb - form->rake * depth * depth));
    /* the bulb closes like an ellipse at its tip */
    point[1] = half_breadth(form, s) * side + form->bulb_beam * form->beam * bulb *
                                                  smooth_step(2.0 * into) *
                                                  sqrt(fmax(0.0, 1.0 - into * into));
    point[2] = -keel_draft(form, s) * depth;
}

nurbs_status ship_form_make(const struct ship_form *form, nurbs_surface **surface)
{
    enum { SIZE = ALONG * AROUND };
    static const int degree[2] = {DEGREE, DEGREE};
    static const size_t size[2] = {ALONG, AROUND};
    double knots[2][ALONG + DEGREE + 1], greville[2][ALONG], points[3 * SIZE];
    for (int d = 0; d < 2; d++) {
        size_t spans = size[d] - DEGREE;
        for (size_t k = 0; k < size[d] + DEGREE + 1; k++) {
            double at = (double)k - DEGREE;
            knots[d][k] = fmin(1.0, fmax(0.0, at / (double)spans));
        }
        nurbs_greville(DEGREE, size[d], knots[d], greville[d]);
    }
    for (size_t i = 0; i < ALONG; i++)
        for (size_t j = 0; j < AROUND; j++)
            form_point(form, greville[0][i], greville[1][j], points + 3 * (i * AROUND + j));
    return nurbs_surface_create(degree, size, knots[0], knots[1], points, NULL, surface);
}
