/* Fields of moves of a hull along y, as splines over the elements of a density. With S the position
 * and V the move along y at the same parameters, a = S_s x S_t changes by
 *     a' = V_s (e_y x S_t) + V_t (S_s x e_y). */
#ifndef FIELD_H
#define FIELD_H

#include "space/cell.h"

enum { FIELD_BLOCK = 8 }; /* fields that are summed at once */

struct field {
    size_t n;     /* fields */
    size_t width; /* the same with what fills the last block up, which stays still */
    const struct mesh *mesh;
    size_t controls; /* control values of all elements */
    size_t *offset;  /* [elements] of the first of each */
    double *net;     /* [controls][width]: weight times V */
    size_t points;   /* control points of the density's surfaces */
    double *point;   /* [points][width]: V */
};

/* move[n][points][3] of all patches of the hull; refuses what is not allowed. */
igabem_status field_create(const igabem_hull *hull, const struct density *density,
                           const struct mesh *mesh, size_t n, const double *move,
                           struct field **field);
/* The same of any moves along y, which are not checked. */
igabem_status field_make(const igabem_hull *hull, const struct density *density,
                         const struct mesh *mesh, size_t n, const double *move,
                         struct field **field);
void field_free(struct field *field);

/* Control points of all patches; sets to 0 what has to stay of a value for each. */
size_t field_points(const igabem_hull *hull);
void field_hold(const igabem_hull *hull, double *value);

/* Control values of an element, [pu+1][pv+1][width]. */
const double *field_net(const struct field *field, const struct element *element);

/* Turns factors of all control values into factors of V at the control points, of which there are
 * fewer: fills point[points]. */
void field_points_of(const struct field *field, const double *factor, double *point);

/* V, V_s and V_t at local parameters of an element: fills v[3][n]. */
void field_at(const struct field *field, const struct element *element, const double local[2],
              double *v);

/* Adds to out[sets][n], sets <= 3, the sums of factor[sets][(pu+1)(pv+1)] over the control values
 * of an element. */
void field_contract(const struct field *field, const struct element *element, size_t sets,
                    const double *factor, double *out);

/* How the area vector turned outwards, its length and its x component change: by along[0] V_s +
 * along[1] V_t. */
struct area_change {
    double area[3], size;                      /* the vector itself */
    double vector[2][3], length[2], inflow[2]; /* inflow: of the x component */
};

void area_change(const double ds[3], const double dt[3], double sign, struct area_change *change);

#endif
