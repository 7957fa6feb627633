/* Sections of any number of points, and the grid of points at equal shares of their lengths. */
#ifndef NURBS_SECTIONS_H
#define NURBS_SECTIONS_H

#include <nurbs/grid.h>

/* From deck to keel. x is a coordinate of the points too: the profile of an end is no plane
 * section.
 */
typedef struct section {
    double x;     /* its place among the others */
    size_t count; /* of points */
    double *points;
    size_t knuckle; /* index of a point plus 1; 0: none */
    size_t line;    /* of the file, for messages */
} section;

typedef struct section_list {
    size_t count, room;
    section *section;
} section_list;

/* Room for a section of `most` points; NULL: no memory. The pointer holds until the next call. */
section *section_append(section_list *list, size_t most);
void section_list_free(section_list *list);

/* Sorts the sections by x and samples them. columns 0: `usual`. *chine gets the knuckle's column if
 * some section has one, else 0. */
nurbs_status section_list_grid(section_list *list, const char *path, size_t columns, size_t usual,
                               nurbs_grid **grid, size_t *chine);

#endif
