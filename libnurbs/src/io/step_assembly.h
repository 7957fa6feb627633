/* Where representations of a STEP file stand: placements, units, and what an assembly puts where.
 */
#ifndef NURBS_STEP_ASSEMBLY_H
#define NURBS_STEP_ASSEMBLY_H

#include "io/step.h"

/* p -> matrix p + shift */
typedef struct step_place {
    double matrix[9], shift[3];
} step_place;

step_place step_after(const step_place *outer, const step_place *inner);
/* From the coordinates of a frame to those in which it is given. */
step_place step_of_frame(const double origin[3], double frame[3][3]);
/* Of a rigid motion. */
step_place step_inverse(const step_place *p);

/* A representation has a name, a list of items and a context; NULL: it is none. */
const step_record *step_representation(const step_file *file, size_t instance);
/* The units of a context, or of a representation's; without units those of before stay. */
nurbs_status step_set_units(step_file *file, size_t context);
nurbs_status step_use_units_of(step_file *file, size_t representation);

/* A representation stands inside another one at a place. */
typedef struct step_link {
    size_t inside, parent; /* instances */
    step_place at;
} step_link;

typedef struct step_assembly {
    size_t links, room;
    step_link *link;
    size_t *same;        /* [instances] a representation that shares coordinates; itself at last */
    unsigned char *used; /* [instances] representations that stand inside others */
} step_assembly;

nurbs_status step_assembly_find(step_file *file, step_assembly *assembly);
void step_assembly_free(step_assembly *assembly);
/* The one instance that stands for all that share coordinates. */
size_t step_root(const step_assembly *assembly, size_t instance);

#endif
