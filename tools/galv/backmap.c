#include "cli.h"
#include "commands.h"
#include "latent_rows.h"
#include "results.h"
#include "use.h"

#include <stdlib.h>

static const char help[] =
    "usage: galv backmap MODEL --latent LIST|U.csv [--json]\n"
    "\n"
    "Prints the parameters x1, x2, ... within their bounds whose hull is nearest to that of each "
    "latent\n"
    "point, and\n"
    "\n"
    "  residual  root mean square distance of the points of the two hulls, metres\n";

static int backmap(const struct use *use)
{
    const galv_model *model = use->file.model;
    size_t n = galv_model_parameters(model), m = galv_model_modes(model);
    struct rows u;
    galv_shape *shape = NULL;
    if (!rows_read(use->latent, m, "u", &u))
        return CLI_FAILED;
    double *x = malloc(u.count * n * sizeof *x), *residual = malloc(u.count * sizeof *residual);
    bool ok = x && residual;
    if (!ok)
        cli_fail("out of memory");
    else if (!(ok = !shape_definition_create(&use->file.shape, &shape)))
        cli_fail("%s", galv_last_error());
    for (size_t r = 0; ok && r < u.count; r++) {
        ok = !galv_backmap(model, shape, u.values + r * m, x + r * n, residual + r);
        if (!ok)
            cli_fail("row %zu: %s", r + 1, galv_last_error());
    }
    static const char *const names[] = {"residual"};
    int result = ok ? results_print(use->json, u.count, "x", n, x, 1, names, residual) : CLI_FAILED;
    galv_shape_free(shape);
    free(x);
    free(residual);
    rows_free(&u);
    return result;
}

int command_backmap(int argc, char **argv)
{
    struct use use;
    int result = use_start(argc, argv, help, USE_LATENT, &use);
    if (result != -1)
        return result;
    result = use.latent ? backmap(&use) : cli_usage("--latent is required");
    use_free(&use);
    return result;
}
