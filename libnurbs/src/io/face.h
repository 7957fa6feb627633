/* Faces: surfaces of some form inside loops of curves in space, as NURBS patches. */
#ifndef NURBS_FACE_H
#define NURBS_FACE_H

#include "io/form.h"

#include <nurbs/patches.h>

/* Curves in the order in which they follow each other, each running in that direction. */
typedef struct face_loop {
    size_t count, room;
    nurbs_curve **curve; /* owned */
} face_loop;

typedef struct cad_face {
    cad_form form;
    bool reversed; /* the loops run clockwise about the normal of the natural parameters */
    size_t count, room;
    face_loop *loop;
} cad_face;

/* What became of a face. */
typedef struct face_outcome {
    size_t patches;
    bool exact;
    double deviation; /* metres: of resampled patches, or of edges that were straightened */
} face_outcome;

nurbs_status face_add_loop(cad_face *f);
/* To the last loop; takes the curve, also when it fails. */
nurbs_status face_add_curve(cad_face *f, nurbs_curve *curve);
/* Turns the last loop round: its curves and their order. */
nurbs_status face_reverse_loop(cad_face *f);
void face_free(cad_face *f);

/* Adds the patches of the face: one exact patch where its edges are parameter lines of its surface,
 * or a plane's four straight edges; else resampled pieces within the tolerance (metres). Nothing is
 * added after a failure: NURBS_ERROR_GEOMETRY or NURBS_ERROR_NUMERIC say why it cannot be. */
nurbs_status face_patches(const cad_face *f, double tolerance, nurbs_patches *patches,
                          face_outcome *outcome);

/* A stretch of a loop in natural parameters. */
typedef struct face_trace {
    size_t count;
    double *ab;               /* [count] pairs, continuous */
    double *t;                /* [count] parameters of the curve */
    const nurbs_curve *curve; /* borrowed; NULL: a straight line that was added */
    bool loose[2];            /* start and end lie in a pole */
    bool level[2];            /* parameter d is constant */
} face_trace;

typedef struct face_path {
    size_t count, room;
    face_trace *trace; /* owned */
    double winding[2]; /* turns about periodic parameters, in units of the parameter */
} face_path;

void face_path_free(face_path *path);
/* The loop in natural parameters; edges within `slack` metres of a parameter line are put on it,
 * and *moved grows to the largest such distance. */
nurbs_status face_path_create(const cad_face *f, const face_loop *loop, double slack,
                              face_path *path, double *moved);
/* Joins loops that wind about a periodic parameter with a seam, or with the pole they enclose. */
nurbs_status face_close_paths(const cad_face *f, size_t *count, face_path *paths);

#endif
