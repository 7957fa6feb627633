/* A flat panel and what its plane decides: frame, integrals of 1/r. */
#ifndef PANEL_FRAME_H
#define PANEL_FRAME_H

#include <igabem/panel.h>

#include <stdbool.h>

struct panel {
    int corners;         /* 3 or 4 */
    int diagonal;        /* 0: corners 0 and 2 divide it in two triangles; 1: corners 1 and 3 */
    double corner[4][3]; /* on the plane, counterclockwise around the normal */
    double centroid[3], normal[3];
    double area, size; /* size: the longest diagonal or side */
};

/* Fills the panel of number j from its four corners. */
igabem_status panel_frame(size_t j, const double *corners, struct panel *panel);

/* Triangles t = 0, 1 (only 0 of a triangle): numbers of their corners. */
void panel_triangle(const struct panel *panel, int t, int corner[3]);

/* The integral of 1/r over the panel and its gradient at P; on the panel the principal value. False
 * on an edge, where the gradient is infinite. */
bool panel_pole(const struct panel *panel, const double P[3], double pole[4]);

#endif
