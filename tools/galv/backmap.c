#include "arguments.h"
#include "cli.h"
#include "commands.h"

#include <stdlib.h>

static const struct setting ROWS[] = {
    OPTION_MODEL,
    OPTION("latent", TEXT, latent, .required = true,
           .sentence = "u1,u2,... (numbers left out are 0), or a CSV file"),
    OPTION_JSON,
};

static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS,
    .usage = "usage: galv backmap MODEL --latent LIST|U.csv [--json]\n"
             "\n"
             "Prints the parameters x1, x2, ... within their bounds whose hull is nearest to that "
             "of each\n"
             "latent point, and\n"
             "\n"
             "  residual  root mean square distance of the points of the two hulls, metres\n\n"};

static bool backmap(const struct arguments *a, const struct rows *u, double *x, double *residual)
{
    const galv_model *model = a->file.model;
    galv_shape *shape = NULL;
    bool ok =
        !shape_definition_create(&a->file.shape, &shape) || cli_refuse("%s", galv_last_error());
    for (size_t r = 0; ok && r < u->count; r++)
        ok = !galv_backmap(model, shape, u->values + r * u->width,
                           x + r * galv_model_parameters(model), residual + r) ||
             cli_refuse("row %zu: %s", r + 1, galv_last_error());
    galv_shape_free(shape);
    return ok;
}

int command_backmap(int argc, char **argv)
{
    static const char *const names[] = {"residual"};
    struct arguments a;
    struct rows u = {.values = NULL};
    int code = arguments_read(argc, argv, &TABLE, &a);
    if (code != -1)
        return code;
    size_t n = galv_model_parameters(a.file.model);
    bool ok = arguments_have_parameters(&a) &&
              rows_read(a.latent, galv_model_modes(a.file.model), "u", &u);
    double *x = ok ? malloc(u.count * n * sizeof *x) : NULL;
    double *residual = ok ? malloc(u.count * sizeof *residual) : NULL;
    ok = ok && ((x && residual) || cli_refuse("out of memory")) && backmap(&a, &u, x, residual);
    const struct table table = {u.count, n, 1, "x", names, x, residual};
    code = ok ? table_print(&table, a.json, &a.warnings) : CLI_FAILED;
    free(x);
    free(residual);
    rows_free(&u);
    arguments_free(&a);
    return code;
}
