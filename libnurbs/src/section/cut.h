/* Sections of a hull (u = constant) cut at a horizontal plane and followed from there to their
 * lower ends: T(u,w) = S(u, v*(u) + w (1 - v*(u))), z(u, v*(u)) = level, in scaled v from 0 to 1.
 */
#ifndef NURBS_CUT_H
#define NURBS_CUT_H

#include <nurbs/surface.h>

typedef struct cut {
    const nurbs_surface *hull;
    double level;
    int degree[2];
    size_t size[2];
    const double *knots_u;
    double *knots_v; /* domain 0 to 1, the upper end of the sections at 0 */
    double *net;     /* homogeneous control points, v as in knots_v */
    double *polygon; /* homogeneous control points of the section at hand */
    double *along;   /* their derivative with respect to u */
    double *scan;    /* parameters v at which crossings are looked for */
    size_t scans;
    double slack; /* metres: an upper end this little below the level lies on it */
} cut;

/* Borrows the hull. */
nurbs_status cut_create(const nurbs_surface *hull, double level, cut *sections);
void cut_free(cut *sections);

/* Which side of a knot u a section's derivative with respect to u is taken from. */
typedef enum cut_side { CUT_LEFT, CUT_RIGHT } cut_side;

/* What a section does at the level. */
typedef enum cut_kind { CUT_CROSSES, CUT_ABOVE, CUT_BELOW, CUT_SEVERAL } cut_kind;

/* Prepares the section at u and finds v*. */
cut_kind cut_section(cut *sections, double u, double *crossing);

/* Fills out[n][3]: points of the prepared section at w. */
void cut_points(const cut *sections, double crossing, size_t n, const double *w, double *out);

/* Fills out[n][3]: dT/du at w of the section at u with its crossing, from one side. */
void cut_derivative(cut *sections, double u, cut_side side, double crossing, size_t n,
                    const double *w, double *out);

/* Where in u the hull crosses the level. Sections beyond range[0] and range[1] lie above it. At an
 * end that is a single point limit[e] is the crossing in the limit, elsewhere -1. Fails with the
 * place when a section does not cross once, or when the hull leaves the level and comes back. */
nurbs_status cut_range(cut *sections, double range[2], double limit[2]);

/* A failure that names the section at u. */
nurbs_status cut_refuse(const cut *sections, double u, cut_kind kind);

/* Whether the prepared section is a single point. */
int cut_is_point(const cut *sections);

/* z - level at the lower end of the section at u. */
double cut_profile(const cut *sections, double u);

#endif
