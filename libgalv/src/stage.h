/* How far a build has come, as its caller hears it. */
#ifndef GALV_STAGE_H
#define GALV_STAGE_H

#include <galv/model.h>

/* Ends of the parts of a build: samples read, eigenpairs found, taken back to coordinates. What is
 * left is shared by the projection and the confidence, whose sizes the eigenpairs tell. */
#define GALV_STAGE_READ   0.5
#define GALV_STAGE_SOLVED 0.6
#define GALV_STAGE_BACK   0.65

typedef struct galv_stage {
    galv_progress tell; /* NULL: nobody listens */
    void *user_data;
    double from, to; /* of the whole, the part at work */
    double told;     /* never falls */
} galv_stage;

/* The next part of the work ends at `to`, if not before, and begins at what was told last: a part
 * that ends early, as iterations do, leaves more to those after it. NULL: nobody listens. */
void galv_stage_next(galv_stage *stage, double to);

/* The next part takes this share of what is left until `to`. */
void galv_stage_share(galv_stage *stage, double share, double to);

/* This share of the part is done; fails when the caller cancels. */
galv_status galv_stage_report(galv_stage *stage, double done);

#endif
