/* How far a build has come, as its caller hears it. */
#ifndef GALV_STAGE_H
#define GALV_STAGE_H

#include <galv/model.h>

/* Ends of the parts of a build: samples read, eigenpairs found, samples projected. */
#define GALV_STAGE_READ      0.35
#define GALV_STAGE_SOLVED    0.7
#define GALV_STAGE_PROJECTED 0.9

typedef struct galv_stage {
    galv_progress tell; /* NULL: nobody listens */
    void *user_data;
    double from, to; /* of the whole, the part at work */
    double told;     /* never falls, though a part may need more passes than planned */
} galv_stage;

/* The next part of the work ends at `to`. NULL: nobody listens. */
void galv_stage_next(galv_stage *stage, double to);

/* This share of the part is done; fails when the caller cancels. */
galv_status galv_stage_report(galv_stage *stage, double done);

#endif
