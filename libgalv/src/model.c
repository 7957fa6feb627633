#include "model.h"

#include "error.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

galv_model *galv_model_new(const galv_model *sizes, bool weighted)
{
    galv_model *model = malloc(sizeof *model);
    if (!model)
        return NULL;
    *model = *sizes;
    size_t parameters = model->parameters, modes = model->modes, spectrum = model->spectrum;
    model->eigenvalues = calloc(spectrum, sizeof(double));
    model->residuals = calloc(spectrum, sizeof(double));
    model->mse = calloc(spectrum, sizeof(double));
    model->vectors = calloc(model->coordinates * model->kept, sizeof(double));
    model->mean = calloc(model->coordinates, sizeof(double));
    model->parent = calloc(3 * model->points + 1, sizeof(double));
    model->latent = calloc(model->samples * modes, sizeof(double));
    model->lower = calloc(2 * modes, sizeof(double));
    model->weights = weighted ? calloc(model->coordinates, sizeof(double)) : NULL;
    model->regression = parameters ? calloc(parameters * (1 + modes), sizeof(double)) : NULL;
    if (!model->eigenvalues || !model->residuals || !model->mse || !model->vectors ||
        !model->mean || !model->parent || !model->latent || !model->lower ||
        (weighted && !model->weights) || (parameters && !model->regression)) {
        galv_model_free(model);
        return NULL;
    }
    model->upper = model->lower + modes;
    return model;
}

void galv_model_free(galv_model *model)
{
    if (!model)
        return;
    free(model->eigenvalues);
    free(model->residuals);
    free(model->mse);
    free(model->vectors);
    free(model->mean);
    free(model->parent);
    free(model->weights);
    free(model->latent);
    free(model->lower);
    free(model->regression);
    free(model);
}

size_t galv_model_samples(const galv_model *model)
{
    return model->samples;
}

size_t galv_model_points(const galv_model *model)
{
    return model->points;
}

size_t galv_model_coordinates(const galv_model *model)
{
    return model->coordinates;
}

size_t galv_model_active(const galv_model *model)
{
    return model->active;
}

size_t galv_model_parameters(const galv_model *model)
{
    return model->parameters;
}

size_t galv_model_modes(const galv_model *model)
{
    return model->modes;
}

size_t galv_model_spectrum(const galv_model *model)
{
    return model->spectrum;
}

double galv_model_retained(const galv_model *model)
{
    return model->retained;
}

double galv_model_trace(const galv_model *model)
{
    return model->trace;
}

double galv_model_retained_geometry(const galv_model *model)
{
    return model->retained_geometry;
}

double galv_model_truncation(const galv_model *model)
{
    return model->truncation;
}

const double *galv_model_eigenvalues(const galv_model *model)
{
    return model->eigenvalues;
}

const double *galv_model_residuals(const galv_model *model)
{
    return model->residuals;
}

const double *galv_model_mse(const galv_model *model)
{
    return model->mse;
}

const double *galv_model_vectors(const galv_model *model)
{
    return model->vectors;
}

const double *galv_model_mean(const galv_model *model)
{
    return model->mean;
}

const double *galv_model_parent(const galv_model *model)
{
    return model->parent;
}

const double *galv_model_weights(const galv_model *model)
{
    return model->weights;
}

const double *galv_model_latent(const galv_model *model)
{
    return model->latent;
}

const double *galv_model_lower(const galv_model *model)
{
    return model->lower;
}

const double *galv_model_upper(const galv_model *model)
{
    return model->upper;
}

galv_confidence galv_model_confidence(const galv_model *model)
{
    return model->confidence;
}

galv_method galv_model_method(const galv_model *model)
{
    return model->method;
}

static galv_status check_finite(const char *what, size_t n, const double *values)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(values[i]))
            return galv_fail(GALV_ERROR_ARGUMENT, "%s %zu is %g", what, i, values[i]);
    return GALV_OK;
}

galv_status galv_project(const galv_model *model, const double *d, double *u)
{
    if (!model || !d || !u)
        return galv_fail(GALV_ERROR_ARGUMENT, "model, displacement and result must be given");
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
    return GALV_OK;
}

galv_status galv_reconstruct(const galv_model *model, const double *u, double *d)
{
    if (!model || !u || !d)
        return galv_fail(GALV_ERROR_ARGUMENT, "model, latent point and result must be given");
    galv_status status = check_finite("latent coordinate", model->modes, u);
    if (status)
        return status;
    blasint length = (blasint)model->coordinates;
    memcpy(d, model->mean, model->coordinates * sizeof *d);
    cblas_dgemv(CblasColMajor, CblasNoTrans, length, (blasint)model->modes, 1, model->vectors,
                length, u, 1, 1, d, 1);
    return GALV_OK;
}
