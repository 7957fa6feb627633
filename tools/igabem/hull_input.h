/* From a hull file to the wetted hull that the solver takes. */
#ifndef HULL_INPUT_H
#define HULL_INPUT_H

#include <igabem/hull.h>
#include <nurbs/nurbs.h>

#include <stdbool.h>

/* What to do with the file. */
struct hull_request {
    const char *path;
    double level;    /* z of the still water in the file's axes, m */
    double draft;    /* keel draft amidships that sets the level instead; NAN: not given */
    double simplify; /* tolerance of knot removal over the length; 0: none; NAN: 1e-4 if cut */
    double length;   /* reference length, m; NAN: the file's, else the waterline's */
    double sinkage, trim, pivot; /* attitude: m, positive down; radians, positive bow up, about
                                    x = pivot in the still water */
    bool unbounded; /* there is no water surface: the body is moved below z = 0 and not cut */
    bool quiet;     /* what was done to the file has been told before */
};

struct hull_input {
    nurbs_hull *source;           /* owned */
    igabem_hull *hull;            /* owned */
    const nurbs_patches *patches; /* light ones of the source: wetted, z = 0 the still water */
    const char *note;             /* how the water divides the hull */
    bool half;                    /* y >= 0 only, the other side is the mirror image */
    double simplify_bound;        /* metres, 0 if nothing was simplified */
    double lpp;                   /* of the file, 0: none given */
};

void hull_request_init(struct hull_request *request, const char *path);

/* Reads, cleans, cuts, simplifies and checks; tells what was done to the file on stderr. Returns
 * CLI_OK, or CLI_FAILED after a message. */
int hull_input_read(const struct hull_request *request, struct hull_input *input);
void hull_input_free(struct hull_input *input);

/* "open transom", "closed transom" or "no transom". */
const char *hull_stern(const igabem_hull_info *info);

#endif
