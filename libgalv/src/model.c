#include "model.h"

#include "error.h"

#include <math.h>
#include <string.h>

#define GETTER(type, name, none)                                                                   \
    type galv_model_##name(const galv_model *model)                                                \
    {                                                                                              \
        return model ? model->name : none;                                                         \
    }

GETTER(size_t, samples, 0)
GETTER(size_t, points, 0)
GETTER(size_t, coordinates, 0)
GETTER(size_t, active, 0)
GETTER(size_t, parameters, 0)
GETTER(size_t, modes, 0)
GETTER(size_t, spectrum, 0)
GETTER(size_t, passes, 0)
GETTER(bool, centred, false)
GETTER(double, retained, NAN)
GETTER(double, retained_geometry, NAN)
GETTER(double, trace, NAN)
GETTER(double, truncation, NAN)
GETTER(const double *, eigenvalues, NULL)
GETTER(const double *, residuals, NULL)
GETTER(const double *, mse, NULL)
GETTER(const double *, vectors, NULL)
GETTER(const double *, mean, NULL)
GETTER(const double *, parent, NULL)
GETTER(const double *, weights, NULL)
GETTER(const double *, latent, NULL)
GETTER(const double *, lower, NULL)
GETTER(const double *, upper, NULL)

galv_method galv_model_method(const galv_model *model)
{
    return model ? (galv_method)model->method : GALV_METHOD_AUTO;
}

galv_confidence galv_model_confidence(const galv_model *model)
{
    return model ? model->confidence : (galv_confidence){NAN, NAN, NAN, {0}};
}

static galv_status check_finite(const char *what, size_t n, const double *values)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(values[i]))
            return galv_fail(GALV_ERROR_ARGUMENT, "%s %zu is %g", what, i, values[i]);
    return GALV_OK;
}

/* Of numbers that are finite one by one, sums need not be. */
static galv_status check_result(const char *what, size_t n, const double *values)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(values[i]))
            return galv_fail(GALV_ERROR_NUMERIC, "%s %zu overflows", what, i);
    return GALV_OK;
}

galv_status galv_project(const galv_model *model, const double *d, double *u)
{
    if (!model || !d || !u)
        return galv_fail(GALV_ERROR_ARGUMENT, "model, displacement and result must be given");
    if (model->method == GALV_METHOD_PARAMETERS)
        return galv_fail(GALV_ERROR_ARGUMENT, "the modes of this model are the parameters");
    galv_status status = check_finite("displacement", model->coordinates, d);
    if (status)
        return status;
    size_t length = model->coordinates;
    for (size_t k = 0; k < model->modes; k++) {
        const double *mode = model->vectors + k * length;
        double sum = 0;
        if (model->weights)
            for (size_t i = 0; i < length; i++)
                sum += model->weights[i] * mode[i] * (d[i] - model->mean[i]);
        else
            for (size_t i = 0; i < length; i++)
                sum += mode[i] * (d[i] - model->mean[i]);
        u[k] = sum;
    }
    return check_result("latent coordinate", model->modes, u);
}

galv_status galv_latent_check(const galv_model *model, const double *u)
{
    return check_finite("latent coordinate", model->modes, u);
}

void galv_add_modes(size_t m, const double *modes, size_t stride, const double *u, size_t n,
                    double *d)
{
    for (size_t k = 0; k < m; k++) {
        const double *mode = modes + k * stride;
        for (size_t i = 0; i < n; i++)
            d[i] += u[k] * mode[i];
    }
}

void galv_model_displacement(const galv_model *model, const double *u, size_t first, size_t n,
                             double *d)
{
    memcpy(d, model->mean + first, n * sizeof *d);
    galv_add_modes(model->modes, model->vectors + first, model->coordinates, u, n, d);
}

galv_status galv_reconstruct(const galv_model *model, const double *u, double *d)
{
    if (!model || !u || !d)
        return galv_fail(GALV_ERROR_ARGUMENT, "model, latent point and result must be given");
    galv_status status = galv_latent_check(model, u);
    if (status)
        return status;
    galv_model_displacement(model, u, 0, model->coordinates, d);
    return check_result("displacement", model->coordinates, d);
}

galv_status galv_displace(const galv_model *model, const double *u, double *moved)
{
    if (!model || !u || !moved)
        return galv_fail(GALV_ERROR_ARGUMENT, "model, latent point and result must be given");
    if (!model->parent)
        return galv_fail(GALV_ERROR_ARGUMENT, "the model was built from data without points");
    galv_status status = galv_latent_check(model, u);
    if (status)
        return status;
    galv_model_displacement(model, u, 0, 3 * model->points, moved);
    for (size_t k = 0; k < 3 * model->points; k++)
        moved[k] += model->parent[k];
    return check_result("coordinate of a point", 3 * model->points, moved);
}
