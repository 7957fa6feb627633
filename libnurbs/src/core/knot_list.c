#include "core/knot_list.h"

#include "core/error.h"

#include <stdlib.h>

enum { MAX_SIZE = 10000 };

static nurbs_status reserve(knot_list *list, size_t size)
{
    size_t needed = size + (size_t)list->degree + 1;
    if (size > list->most)
        return nurbs_fail(
            NURBS_ERROR_NUMERIC,
            "more than %zu control points in one direction would be needed to keep the "
            "tolerance",
            list->most);
    if (needed > list->room) {
        double *larger = realloc(list->knots, 2 * needed * sizeof *larger);
        if (!larger)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", 2 * needed);
        list->knots = larger;
        list->room = 2 * needed;
    }
    return NURBS_OK;
}

nurbs_status knot_list_start(knot_list *list, int degree, const double range[2])
{
    size_t order = (size_t)degree + 1;
    *list = (knot_list){.degree = degree, .most = MAX_SIZE};
    nurbs_status status = reserve(list, order);
    if (status != NURBS_OK)
        return status;
    list->size = order;
    for (size_t k = 0; k < order; k++) {
        list->knots[k] = range[0];
        list->knots[order + k] = range[1];
    }
    return NURBS_OK;
}

void knot_list_free(knot_list *list)
{
    free(list->knots);
    list->knots = NULL;
}

nurbs_status knot_list_append(knot_list *list, double knot)
{
    nurbs_status status = reserve(list, list->size + 1);
    if (status != NURBS_OK)
        return status;
    double last = list->knots[list->size];
    list->knots[list->size] = knot;
    list->size++;
    list->knots[list->size + (size_t)list->degree] = last;
    return NURBS_OK;
}

nurbs_status knot_list_divide(knot_list *list, const unsigned char *parts)
{
    size_t old = list->size + (size_t)list->degree + 1, added = 0;
    for (size_t k = 0; k + 1 < old; k++)
        added += parts[k] > 1 ? parts[k] - 1U : 0;
    nurbs_status status = reserve(list, list->size + added);
    if (status != NURBS_OK)
        return status;
    double *t = list->knots;
    size_t to = old + added;
    for (size_t k = old; k-- > 0;) {
        double knot = t[k], below = k ? t[k - 1] : 0;
        t[--to] = knot;
        for (unsigned part = k ? parts[k - 1] : 0; part > 1; part--)
            t[--to] = below + (knot - below) * (part - 1) / parts[k - 1];
    }
    list->size += added;
    return NURBS_OK;
}
