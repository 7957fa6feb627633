#include "latent.h"

#include <stdlib.h>
#include <string.h>

bool latent_allocate(struct latent *latent)
{
    size_t m = latent->modes, n = latent->coordinates, s = latent->spectrum;
    latent->eigenvalues = calloc(s, sizeof(double));
    latent->mse = calloc(s, sizeof(double));
    latent->vectors = calloc(m * n, sizeof(double));
    latent->mean = calloc(n, sizeof(double));
    latent->lower = calloc(m, sizeof(double));
    latent->upper = calloc(m, sizeof(double));
    bool ok = latent->eigenvalues && latent->mse && latent->vectors && latent->mean &&
              latent->lower && latent->upper;
    if (!ok)
        latent_free(latent);
    return ok;
}

bool latent_copy_model(const galv_model *model, struct latent *latent)
{
    *latent = (struct latent){.modes = galv_model_modes(model),
                              .coordinates = galv_model_coordinates(model),
                              .spectrum = galv_model_spectrum(model),
                              .samples = galv_model_samples(model),
                              .parameters = galv_model_parameters(model),
                              .active = galv_model_active(model),
                              .retained = galv_model_retained(model),
                              .trace = galv_model_trace(model)};
    if (!latent_allocate(latent))
        return false;
    size_t m = latent->modes, n = latent->coordinates, s = latent->spectrum;
    memcpy(latent->eigenvalues, galv_model_eigenvalues(model), s * sizeof(double));
    memcpy(latent->mse, galv_model_mse(model), s * sizeof(double));
    memcpy(latent->vectors, galv_model_vectors(model), m * n * sizeof(double));
    memcpy(latent->mean, galv_model_mean(model), n * sizeof(double));
    memcpy(latent->lower, galv_model_lower(model), m * sizeof(double));
    memcpy(latent->upper, galv_model_upper(model), m * sizeof(double));
    return true;
}

void latent_free(struct latent *latent)
{
    free(latent->eigenvalues);
    free(latent->mse);
    free(latent->vectors);
    free(latent->mean);
    free(latent->lower);
    free(latent->upper);
    *latent = (struct latent){0};
}

void latent_displace(const struct latent *latent, const double *u, double *d)
{
    size_t n = latent->coordinates;
    memcpy(d, latent->mean, n * sizeof *d);
    for (size_t m = 0; m < latent->modes; m++) {
        const double *mode = latent->vectors + m * n;
        for (size_t k = 0; k < n; k++)
            d[k] += u[m] * mode[k];
    }
}
