/**
 * @file topology.h
 * How the patches of a body meet: shared edges with their gaps, free edges, orientation.
 */
#ifndef NURBS_TOPOLOGY_H
#define NURBS_TOPOLOGY_H

#include <nurbs/patches.h>

#ifdef __cplusplus
extern "C" {
#endif

/** One of the four edges of a patch; edge 4 * patch + side. */
typedef struct nurbs_edge {
    size_t patch;
    int side;           /**< 0: first u, 1: last u, 2: first v, 3: last v */
    double range[2];    /**< of its parameter (v on sides 0 and 1, u on 2 and 3) */
    double length;      /**< m */
    double joined;      /**< how much of that runs along other edges, m */
    int collapsed;      /**< the edge is a point, within the tolerance */
    double reserved[4]; /**< 0: room for members of later releases */
} nurbs_edge;

/** A stretch in which two edges run together. */
typedef struct nurbs_joint {
    size_t edge[2];
    double from[2], to[2]; /**< parameters of either edge at the two ends of the stretch */
    double length;         /**< m, along edge[0] */
    double at[3];          /**< a point halfway along it */
    double gap;     /**< largest distance of edge[0] from edge[1] on it, m, on 32 samples a span */
    int consistent; /**< the normals on both sides are on the same side of the body */
    double reserved[4]; /**< 0: room for members of later releases */
} nurbs_joint;

/** Edges of patches and where they run together. */
typedef struct nurbs_topology {
    size_t edges, joints;
    nurbs_edge *edge; /**< [edges], edges = 4 * patches */
    nurbs_joint *joint;
    double gap;          /**< largest of all joints, m */
    size_t inconsistent; /**< number of joints at which the orientation changes */
    double reserved[8];  /**< 0: room for members of later releases */
} nurbs_topology;

/** Fills the topology: edges run together where they are within `tolerance` metres of each other on
 * more than ten times that length; one edge may meet several others (T junctions), or another one
 * of the same patch. Complexity: pairs of edges whose boxes touch, times their samples. */
NURBS_API nurbs_status nurbs_patches_topology(const nurbs_patches *patches, double tolerance,
                                              nurbs_topology *topology);
/** Frees the arrays; the struct itself is the caller's. */
NURBS_API void nurbs_topology_free(nurbs_topology *topology);

/** Makes the orientation of joined patches one: fills sign[edges/4] (-1: to be turned; the first
 * patch of each connected part keeps its own) and part[edges/4], the number of the connected part
 * that holds a patch, from 0 to *parts - 1. Joints that take less than 5 % of either edge do not
 * count: edges that part at a small angle from a common corner.
 * Error: NURBS_ERROR_GEOMETRY if that is impossible (a Moebius strip), naming patches and place. */
NURBS_API nurbs_status nurbs_topology_orient(const nurbs_topology *topology, int *sign,
                                             size_t *part, size_t *parts);

/** Creates the same patches with one orientation for all that are joined: outwards, so that the
 * volume of each connected part (nurbs_moments) is positive. A patch is turned by reversing u.
 * Error: NURBS_ERROR_GEOMETRY if that is impossible (a Moebius strip), naming the joint.
 * @param turned  fills the number of patches that were turned; NULL allowed */
NURBS_API nurbs_status nurbs_patches_orient(const nurbs_patches *patches, double tolerance,
                                            nurbs_patches **result, size_t *turned);

/** Creates the patches moved by p -> matrix p + shift (as nurbs_surface_transform()). A matrix that
 * mirrors also reverses u, so that normals which point outwards still do. Parameters of the design
 * grid and the note are kept; the length is scaled by the cube root of the determinant. */
NURBS_API nurbs_status nurbs_patches_transform(const nurbs_patches *patches, const double *matrix,
                                               const double shift[3], nurbs_patches **result);

/** Creates the patches and their mirror images in the plane where coordinate `axis` (0 x, 1 y, 2 z)
 * is zero: both sides of a ship from its half with axis 1. */
NURBS_API nurbs_status nurbs_patches_mirror(const nurbs_patches *patches, int axis,
                                            nurbs_patches **result);

#ifdef __cplusplus
}
#endif

#endif
