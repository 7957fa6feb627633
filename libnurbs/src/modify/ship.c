/* Ships made of a dozen numbers. */
#include "core/constants.h"
#include "core/error.h"

#include <nurbs/basis.h>
#include <nurbs/primitives.h>

#include <math.h>

enum { DEGREE = 3, ALONG = 30, AROUND = 14 };

static const double BENT = 0.14; /* share of the length in which sections bend into the stem */
static const double BULB_REACH = 0.12; /* share of the length over which the bulb grows */
static const double BULB_PLACE = 0.72; /* of the half girth from waterline to keel */
static const double BULB_WIDTH = 0.22; /* of the same */

nurbs_status nurbs_ship_form_fast(double length, double beam, double draft, nurbs_ship_form *form)
{
    if (!form)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no form to fill");
    *form = (nurbs_ship_form){.length = length,
                              .beam = beam,
                              .draft = draft,
                              .fullest = 0.4,
                              .transom_beam = 0.8,
                              .transom_draft = 0.2,
                              .run = 0.5,
                              .entrance = 2.0,
                              .section = {3.0, 2.4, 1.5},
                              .rake = 0.05};
    return NURBS_OK;
}

nurbs_status nurbs_ship_form_bulb(double length, double beam, double draft, nurbs_ship_form *form)
{
    if (!form)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no form to fill");
    *form = (nurbs_ship_form){.length = length,
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
    return NURBS_OK;
}

static nurbs_status check_form(const nurbs_ship_form *form)
{
    const double tiny = 1e-9, large = 1e9; /* positive, finite */
    const struct {
        const char *name;
        double value, least, most;
    } numbers[] = {{"length", form->length, tiny, large},
                   {"beam", form->beam, tiny, large},
                   {"draft", form->draft, tiny, large},
                   {"fullest", form->fullest, tiny, 1 - tiny},
                   {"transom_beam", form->transom_beam, 0, 1},
                   {"transom_draft", form->transom_draft, 0, 1},
                   {"run", form->run, tiny, large},
                   {"entrance", form->entrance, tiny, large},
                   {"section[0]", form->section[0], tiny, large},
                   {"section[1]", form->section[1], tiny, large},
                   {"section[2]", form->section[2], tiny, large},
                   {"rake", form->rake, -1, 1},
                   {"bulb_length", form->bulb_length, 0, 1},
                   {"bulb_beam", form->bulb_beam, 0, 1}};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        if (!(numbers[k].value >= numbers[k].least && numbers[k].value <= numbers[k].most))
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "ship: %s is %g, expected %g to %g",
                              numbers[k].name, numbers[k].value, numbers[k].least, numbers[k].most);
    return NURBS_OK;
}

static double smooth_step(double s)
{
    s = fmin(1.0, fmax(0.0, s));
    return s * s * (3.0 - 2.0 * s);
}

/* Half breadth of the waterline at s = x/L. */
static double half_breadth(const nurbs_ship_form *form, double s)
{
    double m = form->fullest;
    double share = s < m ? 1.0 - (1.0 - form->transom_beam) * pow((m - s) / m, 2.0)
                         : 1.0 - pow((s - m) / (1.0 - m), form->entrance);
    return 0.5 * form->beam * fmax(0.0, share);
}

static double keel_draft(const nurbs_ship_form *form, double s)
{
    double rise = fmax(0.0, 1.0 - s / form->run);
    return form->draft * (1.0 - (1.0 - form->transom_draft) * rise * rise);
}

static double section_exponent(const nurbs_ship_form *form, double s)
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
    return exp(-d * d) * sin(PI * fmin(1.0, fmax(0.0, v)));
}

static void form_point(const nurbs_ship_form *form, double s, double v, double point[3])
{
    double power = 2.0 / section_exponent(form, s), angle = 0.5 * PI * v;
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

nurbs_status nurbs_make_ship(const nurbs_ship_form *form, nurbs_surface **surface)
{
    if (!form || !surface)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no form or no place for the surface");
    *surface = NULL;
    nurbs_status status = check_form(form);
    if (status)
        return status;
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
