/* The parts of the validation report of libigabem; each prints one section in Markdown. */
#ifndef IGABEM_VALIDATION_H
#define IGABEM_VALIDATION_H

#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

/* Bodies; a failure prints its reason and exits. */
igabem_hull *wigley(double beam, double draft, int along, int around);
igabem_hull *ellipsoid(double length, double beam, double height, double depth, int along,
                       int around);
nurbs_surface *ellipsoid_surface(double length, double beam, double height, double depth, int along,
                                 int around);

/* The wetted hull of a NURBS file, simplified within tolerance (over its length); a file that ends
 * at the still water is used as it is. */
igabem_hull *hull_file(const char *file, double tolerance);

/* Default options at a Froude number. */
igabem_options at_froude(double froude);

/* Solves all settings at once and computes their forces. */
void solve_all(const igabem_hull *hull, size_t n, const igabem_options *options,
               igabem_forces *forces);

void double_body_section(void);
void spheroid_section(void);
void wigley_section(void);
void forms_section(void);
void tank_section(void);
void patches_section(void);
void dtmb5415_section(const char *file);
void hulls_section(void);
void error_section(const char *file);

/* Of a hull with a transom at three speeds: meshes, spreads over cut-off and x_s, pressure,
 * attitude. */
void transom_hull_table(const igabem_hull *hull);

#endif
