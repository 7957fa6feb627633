/* Hull grids drawn into a rectangle of an SVG file. */
#ifndef GALV_TOOL_VIEW_H
#define GALV_TOOL_VIEW_H

#include <stddef.h>
#include <stdio.h>

struct view {
    double x, y, width, height; /* rectangle */
    size_t sections, girth;
};

/* The half hull from off the port bow, its cells coloured by value (sections x girth, scaled so
 * that the largest is yellow and 0 is blue). Returns 0, or -1 when memory is short. */
int view_surface(FILE *out, const struct view *view, const double *xyz, const double *value);

/* Scale and origin of the body plan of a hull, shared by hulls to be compared. */
struct body_plan {
    double scale, centre, bottom; /* pixels per metre, x of the centre plane, y of z = 0 */
    double middle;                /* x (metres) that divides fore from aft sections */
    size_t stride;                /* sections drawn: every stride-th */
};
struct body_plan view_body_plan(const struct view *view, const double *xyz);

/* Path data of the sections: aft ones to the left, fore ones to the right. */
void view_sections(FILE *out, const struct view *view, const struct body_plan *plan,
                   const double *xyz);

#endif
