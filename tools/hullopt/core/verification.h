/* Rows of a verification. */
#ifndef HULLOPT_VERIFICATION_H
#define HULLOPT_VERIFICATION_H

#include <stddef.h>

/* What a row varies. */
enum verification_group {
    GROUP_OBJECTIVE,   /* nothing: the objective of the search */
    GROUP_FORMULATION, /* the formulation */
    GROUP_STERN,       /* the length of the stern */
    GROUP_RESOLUTION,
    GROUP_FILTER, /* the short-wave filter: each hull's own */
    GROUP_SPEED,
    GROUP_COARSER, /* of the resolution: the third mesh of a ladder */
    GROUPS
};
const char *verification_group_name(enum verification_group group);

/* One line: parent and optimum under the same settings. */
struct verification {
    enum verification_group group;
    char label[80], formulation[40];
    double froude;
    int refine;
    double stern_length;
    double cw_parent, cw_best; /* NAN: no result, see note */
    double cw_pressure_parent, cw_pressure_best;
    size_t dofs_parent, dofs_best;
    double seconds;
    char note[256];
};

#endif
