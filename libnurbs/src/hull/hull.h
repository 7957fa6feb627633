/* The object behind nurbs_hull and the steps that make it. */
#ifndef NURBS_HULL_OBJECT_H
#define NURBS_HULL_OBJECT_H

#include <nurbs/hull.h>
#include <nurbs/topology.h>

/* Relative to the extent in x: a surface that stays within this of a plane lies in it. */
#define HULL_CLEARANCE 1e-6

struct nurbs_hull {
    nurbs_hull_options options;
    nurbs_patches *full, *wetted;
    nurbs_patches *light; /* may be `wetted` itself */
    double extent;        /* of the file in x, m */
    double level, length, lpp, bound;
    size_t *number;   /* [patches of full] in the file */
    double triangles; /* volume of the triangles that the surface stands for, m^3; 0: not known */
    double lifted;    /* how far control points moved to y >= 0, m */
    double deviation; /* of cut surfaces from the full ones, m */
    bool half, cut, waterline, shares_space;
    struct hull_space *space; /* of the hulls rebuilt from this one; NULL: none */
    nurbs_hydrostatics hydrostatics;
    size_t steps;
    char **step;
};

/* Corners of the box of samples of a surface, or of all patches, which widen the box given. */
typedef struct hull_box {
    double lower[3], upper[3];
} hull_box;
hull_box hull_box_empty(void);
nurbs_status hull_box_widen(const nurbs_surface *surface, hull_box *box);
nurbs_status hull_box_of(const nurbs_patches *patches, hull_box *box);

/* Puts edges that lie within the clearance of the water, or within the cut or `moved` of the centre
 * plane, there. Creates a surface. */
nurbs_status hull_settle_edges(const nurbs_hull *hull, const nurbs_surface *patch, double level,
                               double moved, nurbs_surface **settled);
/* Adds a sentence to the report. */
__attribute__((format(printf, 2, 3))) nurbs_status hull_tell(nurbs_hull *hull, const char *format,
                                                             ...);

/* Makes `patches`, which it takes, the full ones instead of those it has. */
void hull_replace_full(nurbs_hull *hull, nurbs_patches *patches);

/* Makes one surface of the full ones, through their sections. */
nurbs_status hull_join(nurbs_hull *hull);
/* Refuses a surface whose volume is another one than that of what it was made of. */
nurbs_status hull_check_volume(const nurbs_hull *hull);

/* An empty set with the length and note of another. */
nurbs_status hull_start_patches(const nurbs_patches *from, nurbs_patches **to);

/* Takes patches of full in the centre plane out; then those in the water or level above it, and
 * transoms. */
nurbs_status hull_leave_out_centre(nurbs_hull *hull);
nurbs_status hull_leave_out_covers(nurbs_hull *hull);

/* Mirrors a starboard half, takes the port half of surfaces across the centre plane. */
nurbs_status hull_take_half(nurbs_hull *hull);

/* Adds what of a surface lies below the level to a set, in one piece or in strips. */
nurbs_status hull_cut_patch(const nurbs_surface *patch, double level, double extent,
                            double tolerance, nurbs_patches *below, double *deviation);

/* The same in strips of sections that lie below, above or cross once. */
nurbs_status hull_cut_strips(const nurbs_surface *surface, double level, double extent,
                             double tolerance, nurbs_patches *below, double *deviation);

/* Refuses wetted patches that leave an opening elsewhere than at the stern, or that cover a place
 * twice; *bow_aft: the only openings are at the other end. */
nurbs_status hull_check_edges(const nurbs_hull *hull, bool *bow_aft);

/* Refuses bodies, parts that share no edges, that reach into each other. */
nurbs_status hull_check_bodies(const nurbs_patches *patches, const nurbs_topology *topology,
                               double extent);

/* From the file's patches, which `full` holds, to wetted and light ones. */
nurbs_status hull_choose_level(nurbs_hull *hull, const hull_box *box);
nurbs_status hull_place(nurbs_hull *hull);
nurbs_status hull_wet(nurbs_hull *hull);

/* Fills hull->half from the wetted patches; hull->hydrostatics. */
nurbs_status hull_side(nurbs_hull *hull);
nurbs_status hull_measure(nurbs_hull *hull);

/* Hydrostatics of patches that all lie at y >= 0 (half), or on both sides of the centre plane. */
nurbs_status hull_hydrostatics(const nurbs_patches *wetted, bool half, nurbs_hydrostatics *sum);

/* After hull_measure(): tells what looks unlike the ship that was meant, with its remedy; refuses a
 * reference length of another body. file: the box of what was read. */
nurbs_status hull_doubt(nurbs_hull *hull, const hull_box *file);

/* Adds to the sentence of a refusal what may be wrong with the file: unit, axes, place. */
nurbs_status hull_refuse_with_hint(const nurbs_hull *hull, const hull_box *box,
                                   nurbs_status status);

#endif
