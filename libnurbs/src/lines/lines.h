/* What stands between a mesh and the surface through its sections. */
#ifndef NURBS_LINES_H
#define NURBS_LINES_H

#include <nurbs/sections.h>

#include <stdbool.h>

/* Heights at which the outlines are kept. */
enum { OUTLINE_LEVELS = 2001 };

/* The outlines of both ends seen from the side, and the sheets x = sheet(x0, z) between them. */
typedef struct sheets {
    double low[3], high[3];        /* of the mesh */
    double extent;                 /* in x */
    double z[2];                   /* heights of the first and the last level */
    double end[2][OUTLINE_LEVELS]; /* [aft, fore] x at each level */
    double tip[2];                 /* x of the outermost points */
} sheets;

nurbs_status sheets_create(const nurbs_mesh *mesh, sheets *sheets);
double sheets_outline(const sheets *s, int end, double z);
/* Where the sheet of place x0, between the tips, lies at a height. */
double sheets_x(const sheets *s, double x0, double z);
/* The place of the sheet through x at this height. */
double sheets_place(const sheets *s, double x, double z);

/* A section from deck to keel. */
typedef struct line {
    double place; /* x0 of its sheet */
    size_t n;
    double *points, *along; /* along[n]: length from the deck */
    size_t corners;
    double corner[NURBS_SECTIONS_CORNERS]; /* shares of the length, increasing */
    double closing; /* of the last section of an end that is open above and closed below: the share
                       at which it meets the centre plane; 0: of no other */
} line;
void line_free(line *line);

/* Follows a section from the keel to the deck and turns it. *left_out grows with the length of what
 * else the sheet meets. */
nurbs_status line_trace(const nurbs_mesh *mesh, const sheets *s, double place, double kink_angle,
                        line *line, double *left_out);
/* The section at a closed end: its outline in the centre plane between two heights, with the points
 * of a section near it put there, so that columns run on. */
nurbs_status line_outline(const sheets *s, int end, double deck, double keel, const line *near,
                          line *line);
/* Fills along and finds the corners. */
nurbs_status line_finish(line *line, double kink_angle);

/* Places at which the keel turns by more than the angle: fills up to `most`, returns their number
 * in *n. */
nurbs_status keel_kinks(const nurbs_mesh *mesh, const sheets *s, double kink_angle, size_t most,
                        double *place, size_t *n);

/* The grid of points at equal shares between the corners that many sections have, and their
 * columns.
 */
nurbs_status lines_grid(size_t n, const line *const *lines, size_t columns, nurbs_grid **grid,
                        size_t *corners, size_t corner[NURBS_SECTIONS_CORNERS]);

/* Distances from triangles. */
typedef struct mesh_distance mesh_distance;
nurbs_status mesh_distance_create(const nurbs_mesh *mesh, mesh_distance **distance);
void mesh_distance_free(mesh_distance *distance);
double mesh_distance_of(const mesh_distance *distance, const double p[3]);

/* Closest points of patches, which are borrowed. */
typedef struct projector projector;
nurbs_status projector_create(const nurbs_patches *patches, projector **projector);
void projector_free(projector *projector);
/* Moves a point onto the patches if they are within reach. */
nurbs_status projector_put(const projector *projector, double reach, double point[3]);

#endif
