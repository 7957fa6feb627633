/* The hull as the modules of the library see it: patches with an orientation, what each edge is,
 * and the figures found once at creation. */
#ifndef HULL_H
#define HULL_H

#include <igabem/hull.h>
#include <nurbs/topology.h>

/* The four edges of a patch: u first, u last, v first, v last. */
enum { HULL_U0, HULL_U1, HULL_V0, HULL_V1, HULL_EDGES };

enum hull_edge {
    HULL_EDGE_JOINED,    /* shared with an edge of this or another patch */
    HULL_EDGE_OPEN,      /* shared with nothing: the rim of an open transom */
    HULL_EDGE_WATERLINE, /* in z = 0 */
    HULL_EDGE_CENTRE,    /* in y = 0 of a half hull */
    HULL_EDGE_COLLAPSED  /* a single point */
};

struct hull_patch {
    nurbs_surface *surface; /* owned */
    double domain[2][2];    /* first and last knot of u and of v */
    double sign;            /* outward normal: sign * Su x Sv, sign = +-1 */
    double side[2];         /* least and largest y of the samples, m */
    bool transom;           /* a flat face that closes the stern */
    int along;              /* direction that runs lengthwise; -1: the patch lies across the hull */
    double length[2];       /* of the longest line of either direction, m */
    double x[2];            /* mean x of the aft and of the fore end, m */
    size_t spans[2];        /* knot spans */
    double span_ratio[2];   /* of the widest to the narrowest */
    enum hull_edge edge[HULL_EDGES];
};

struct igabem_hull {
    size_t n;
    struct hull_patch *patches;
    bool symmetric;            /* the mirror image in y belongs to the body */
    double length;             /* reference length, m */
    double extent;             /* x_fore - x_aft of the patches, m: scale of all tolerances */
    double lower[3], upper[3]; /* bounding box of the sampled patches, m */
    double run[2];             /* length from end to end, largest half girth, in patch lengths, m */
    double run_spans[2];       /* the same in knot spans */
    bool surface_piercing;
    int transom; /* igabem_transom */
    double nu_s;
    nurbs_hydrostatics hydrostatics;
};

/* Parameters along an edge: s in [0,1] runs with the free direction. */
void hull_edge_parameters(const struct hull_patch *patch, int edge, double s, double uv[2]);

/* Point, outward unit normal and area element dS/(du dv) from the triples S, Su, Sv of
 * nurbs_surface_eval order 1. Returns 0 where the normal vanishes (normal and area then 0). */
bool hull_normal(const struct hull_patch *patch, const double triples[9], double normal[3],
                 double *area);

/* On a waterline edge: nu[2], the horizontal unit normal out of the body, and dl/ds of the edge
 * parameter given above, from S, Su, Sv. */
void hull_waterline_normal(const struct hull_patch *patch, int edge, const double triples[9],
                           double nu[2], double *dl);

/* Whether direction d of a patch runs around the hull (1) or along it (0). */
bool hull_is_around(const struct hull_patch *patch, int d);

/* The part that falls to direction d of patch p of a number of elements along the hull or around
 * it: by length, at least 1; 0 for 0. */
int hull_share(const struct igabem_hull *hull, size_t p, int d, int elements);

/* Whether two patches lie on the same side of the centre plane. */
bool hull_same_side(const struct hull_patch *a, const struct hull_patch *b);

/* Edges of different patches, or opposite ones of the same patch, this close run together, m. */
double hull_join_tolerance(const struct igabem_hull *hull);

/* Passes on a failure of libnurbs; what names the object ("patch 2"). */
igabem_status hull_nurbs_fail(nurbs_status status, const char *what);

/* The steps of igabem_hull_create, in order; each names patch and place when it refuses. */
igabem_status hull_bounds(struct igabem_hull *hull);
igabem_status hull_topology(const struct igabem_hull *hull, nurbs_topology *topology);
igabem_status hull_orient(struct igabem_hull *hull, const nurbs_topology *topology);
igabem_status hull_measure(struct igabem_hull *hull);
igabem_status hull_check(struct igabem_hull *hull);
igabem_status hull_check_joints(const struct igabem_hull *hull, const nurbs_topology *topology);
/* part[n]: numbers of the connected parts, below parts. */
igabem_status hull_check_overlap(const struct igabem_hull *hull, const size_t *part, size_t parts);
igabem_status hull_classify_edges(struct igabem_hull *hull);
igabem_status hull_check_submergence(const struct igabem_hull *hull);
igabem_status hull_waterline_angle(const struct igabem_hull *hull, double *nu_s);

#endif
