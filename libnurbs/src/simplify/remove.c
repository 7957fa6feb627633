/* Removal of a given knot, whatever the distance: the best spline without it that least squares
 * followed by balancing finds. */
#include "core/error.h"
#include "simplify/subject.h"

#include <nurbs/simplify.h>

#include <float.h>
#include <math.h>
#include <string.h>

/* Divisions of a span in the certificate: one knot only, so a close one is affordable. */
enum { PARTS = 4 };

/* Index of the last copy of a knot inside the domain, 0: there is none. */
static size_t last_copy(const struct reduction *r, double knot)
{
    for (size_t k = r->size - 1; k > (size_t)r->degree; k--)
        if (r->knots[k] == knot)
            return k;
    return 0;
}

/* Balances towards lower and lower goals until they are out of reach. */
static void minimize_largest(struct thinning *t, double rounding)
{
    double largest = thinning_largest(t);
    for (int round = 0; round < 40 && largest > rounding; round++) {
        const double next = thinning_balance(t, 0.93 * largest, 30);
        if (!(next < 0.995 * largest))
            break;
        largest = next;
    }
}

static nurbs_status remove_knot(const struct subject *s, int direction, double knot, int times,
                                struct simple *r)
{
    struct thinning t;
    struct thinning_request request = subject_request(s, 1, 0.0);
    memset(r, 0, sizeof *r);
    nurbs_status status = thinning_create(&request, &t);
    if (status != NURBS_OK)
        return status;
    for (int k = 0; k < times && status == NURBS_OK; k++) {
        const size_t index = last_copy(&t.along[direction], knot);
        if (!index)
            status = nurbs_fail(NURBS_ERROR_ARGUMENT,
                                "knot %.17g to remove %d times is %d times inside the domain", knot,
                                times, k);
        else if (!thinning_remove(&t, direction, index))
            status = nurbs_fail(NURBS_ERROR_NUMERIC, "knot %.17g cannot be removed", knot);
    }
    if (status == NURBS_OK) {
        minimize_largest(&t, s->rounding);
        status = simple_create(s, t.along, r);
    }
    if (status == NURBS_OK) {
        const struct coarse_net net = thinning_net(&t);
        if (subject_read(s, &net, r->points, r->weights))
            r->bound = subject_certify(s, &t, r->points, r->weights);
        else
            status = nurbs_fail(NURBS_ERROR_NUMERIC,
                                "removing knot %.17g needs weights that are not positive", knot);
    }
    thinning_free(&t);
    return status;
}

nurbs_status nurbs_curve_remove(const nurbs_curve *curve, double knot, int times,
                                nurbs_curve **result, double *bound)
{
    if (!curve || !result)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL", curve ? "result" : "curve");
    *result = NULL;
    if (times < 0)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "knot %g removed %d times, expected 0 or more",
                          knot, times);
    const struct axis *const axes[2] = {&curve->axis, NULL};
    struct subject s;
    struct simple r;
    nurbs_status status = subject_create(1, PARTS, axes, curve->points, curve->weights, &s);
    if (status != NURBS_OK)
        return status;
    status = remove_knot(&s, 0, knot, times, &r);
    if (status == NURBS_OK)
        status = simple_curve(curve, &r, result, bound);
    simple_free(&r);
    subject_free(&s);
    return status;
}

nurbs_status nurbs_surface_remove(const nurbs_surface *surface, int direction, double knot,
                                  int times, nurbs_surface **result, double *bound)
{
    nurbs_status status = modify_check(surface, direction, result);
    if (status != NURBS_OK)
        return status;
    if (times < 0)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "knot %g removed %d times, expected 0 or more",
                          knot, times);
    const struct axis *const axes[2] = {&surface->axis[0], &surface->axis[1]};
    struct subject s;
    struct simple r;
    status = subject_create(2, PARTS, axes, surface->points, surface->weights, &s);
    if (status != NURBS_OK)
        return status;
    status = remove_knot(&s, direction, knot, times, &r);
    if (status == NURBS_OK)
        status = simple_surface(surface, &r, result, bound);
    simple_free(&r);
    subject_free(&s);
    return status;
}
