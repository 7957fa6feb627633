/* A parabola in two variables, through the installed libbayesopt. */
#include <bayesopt/bayesopt.h>

#include <stdio.h>
#include <string.h>

int main(void)
{
    char version[40];
    snprintf(version, sizeof version, "%d.%d.%d", BAYESOPT_VERSION_MAJOR, BAYESOPT_VERSION_MINOR,
             BAYESOPT_VERSION_PATCH);
    if (strcmp(version, bayesopt_version()) != 0)
        return 1;
    const double lower[2] = {-1, -1}, upper[2] = {1, 1};
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 8;
    options.max_evaluations = 20;
    bayesopt *bo = NULL;
    if (bayesopt_create(2, lower, upper, &options, &bo) != BAYESOPT_OK) {
        fprintf(stderr, "%s\n", bayesopt_last_error());
        return 1;
    }
    double x[2], f;
    uint64_t id;
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK)
        if (bayesopt_tell(bo, id, (x[0] - 0.3) * (x[0] - 0.3) + x[1] * x[1], NULL) != BAYESOPT_OK)
            return 1;
    int ok = bayesopt_best(bo, x, &f, NULL) == BAYESOPT_OK && f < 1e-3;
    bayesopt_free(bo);
    return ok ? 0 : 1;
}
