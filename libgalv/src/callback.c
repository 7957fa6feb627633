/* The caller's own function as a shape. */
#include "error.h"
#include "shape.h"

#include <stdlib.h>

typedef struct callback_shape {
    galv_shape head;
    galv_displacement displace;
    void *user_data;
} callback_shape;

static galv_status callback_displace(const galv_shape *head, size_t npoints, const double *xyz,
                                     const double *x, double *d)
{
    const callback_shape *shape = (const callback_shape *)head;
    int refused = shape->displace(shape->user_data, npoints, xyz, x, d);
    if (refused)
        return galv_fail(GALV_ERROR_NUMERIC, "the displacement function returned %d", refused);
    return GALV_OK;
}

static void callback_destroy(galv_shape *shape)
{
    free(shape);
}

static const galv_shape_class callback_class = {
    .name = "callback", .displace = callback_displace, .destroy = callback_destroy};

static const galv_shape_class concurrent_class = {.name = "callback",
                                                  .concurrent = true,
                                                  .displace = callback_displace,
                                                  .destroy = callback_destroy};

galv_status galv_shape_callback(size_t n, const double *lower, const double *upper,
                                galv_displacement displace, void *user_data, bool concurrent,
                                galv_shape **out)
{
    if (!displace || !out)
        return galv_fail(GALV_ERROR_ARGUMENT, "the displacement function is NULL");
    callback_shape *shape = malloc(sizeof *shape);
    if (!shape)
        return galv_fail(GALV_ERROR_MEMORY, "shape");
    galv_status status = galv_shape_start(
        &shape->head, concurrent ? &concurrent_class : &callback_class, n, lower, upper);
    if (status) {
        free(shape);
        return status;
    }
    shape->displace = displace;
    shape->user_data = user_data;
    *out = &shape->head;
    return GALV_OK;
}
