#include "io/iges_spline.h"

#include "fit/interpolate.h"

#include <string.h>

static size_t multiplicity(size_t count, const double *knots, double value)
{
    size_t found = 0;
    for (size_t k = 0; k < count; k++)
        found += knots[k] == value;
    return found;
}

int clamp_spline(int degree, size_t *n, double *knots, size_t m, double *rows)
{
    size_t p = (size_t)degree, changed = 0;
    const double first = knots[p], last = knots[*n];
    for (size_t k = 0; k < p; k++)
        changed += knots[k] != first || knots[*n + 1 + k] != last;
    if (!changed)
        return 0;
    /* With p equal knots the spline passes through a control row. */
    for (size_t have = multiplicity(*n + p + 1, knots, first); have < p; have++)
        spline_insert_rows(degree, n, knots, m, rows, first);
    for (size_t have = multiplicity(*n + p + 1, knots, last); have < p; have++)
        spline_insert_rows(degree, n, knots, m, rows, last);
    size_t left = *n, right = p;
    while (knots[left] != first)
        left--;
    while (knots[right] != last)
        right++;
    size_t size = right - left + p;
    memmove(rows, rows + (left - p) * m, size * m * sizeof *rows);
    memmove(knots, knots + (left - p), (size + p + 1) * sizeof *knots);
    knots[0] = first;
    knots[size + p] = last;
    *n = size;
    return 1;
}
