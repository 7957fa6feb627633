/* Bayesian optimisation of somebody else's simulation, which sometimes fails. The optional argument
 * names a store: interrupt the program, run it again, and it goes on where it was. */
#include <bayesopt/bayesopt.h>

#include <math.h>
#include <stdio.h>

/* Stands for an expensive run; outside a disc its "mesher" gives up. */
static int simulate(const double *x, double *f)
{
    if (x[0] * x[0] + x[1] * x[1] > 3)
        return 0;
    *f = pow(x[0] - 0.4, 2) + 2 * pow(x[1] + 0.7 - 0.3 * sin(3 * x[0]), 2);
    return 1;
}

int main(int argc, char **argv)
{
    const double lower[2] = {-1.5, -1.5}, upper[2] = {1.5, 1.5};
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 10;
    options.max_evaluations = 30;

    bayesopt *bo = NULL;
    double x[2], f;
    uint64_t id;
    bayesopt_status status = bayesopt_create(2, lower, upper, &options, &bo);
    if (status == BAYESOPT_OK && argc > 1)
        status = bayesopt_open_store(bo, argv[1]);
    while (status == BAYESOPT_OK && (status = bayesopt_ask(bo, 1, x, &id)) == BAYESOPT_OK)
        status = simulate(x, &f) ? bayesopt_tell(bo, id, f, NULL)
                                 : bayesopt_tell_failed(bo, id, "the mesh folded");
    if (status > 0)
        status = bayesopt_best(bo, x, &f, NULL);
    if (status == BAYESOPT_OK)
        printf("f(%.4f, %.4f) = %.2e after %zu evaluations\n", x[0], x[1], f, bayesopt_count(bo));
    else
        fprintf(stderr, "ask_tell: %s\n", bayesopt_last_error());
    bayesopt_free(bo);
    return status == BAYESOPT_OK ? 0 : 1;
}
