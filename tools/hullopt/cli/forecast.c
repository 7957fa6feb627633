#include "core/forecast.h"

#include "cli.h"
#include "cli/commands.h"
#include "core/constraints.h"
#include "json_result.h"

#include <jansson.h>
#include <math.h>

static void put(json_t *o, const char *name, double ratio)
{
    if (!isnan(ratio))
        json_result_set(o, name, isfinite(ratio) ? json_real(100 * (1 - ratio)) : json_null());
}

/* Reductions of the objective in per cent; null: no step was found that keeps the limits. */
static json_t *result(const struct forecast *f)
{
    json_t *o = json_object(), *shares = json_object(), *without = json_object();
    char name[16];
    put(o, "reduction_percent", f->asked);
    for (size_t i = 0; i < FORECAST_SHARES; i++) {
        snprintf(name, sizeof name, "%g", FORECAST_SHARE[i]);
        put(shares, name, f->confirmed[i]);
    }
    for (size_t k = 0; k < constraints_count(); k++)
        put(without, constraints_name(k), f->without[k]);
    json_result_set(o, "confirm", shares);
    json_result_set(o, "without", without);
    json_result_set(o, "tangents", json_integer((json_int_t)f->tangents));
    json_result_set(o, "solves", json_integer((json_int_t)f->solves));
    return o;
}

static void print_row(const char *kind, const char *name, double ratio, const char *remark)
{
    char label[64];
    snprintf(label, sizeof label, "%s%s", kind, name);
    if (isfinite(ratio))
        printf("%-28s%6.1f %%%s\n", label, 100 * (1 - ratio), remark);
    else if (!isnan(ratio))
        printf("%-28sno step found that keeps the limits\n", label);
}

static bool print_text(const struct forecast *f)
{
    printf("forecast from one Jacobian, ");
    if (f->tangents)
        printf("%zu of %zu settings by tangents%s", f->tangents, f->settings,
               f->solves ? ", the others by " : "");
    if (f->solves)
        printf("%zu coarse solves", f->solves);
    printf(": reductions of the objective\n");
    print_row("as configured", "", f->asked, "");
    char share[16];
    for (size_t i = 0; i < FORECAST_SHARES; i++) {
        snprintf(share, sizeof share, "%g", FORECAST_SHARE[i]);
        print_row("confirm: ", share, f->confirmed[i],
                  FORECAST_SHARE[i] == 1 ? ", in the worst of all models" : "");
    }
    for (size_t k = 0; k < constraints_count(); k++)
        print_row("without ", constraints_name(k), f->without[k], "");
    return cli_printed() == CLI_OK;
}

int forecast_command(const struct options *options)
{
    const struct core_watch nobody = {.show = NULL};
    struct config config;
    struct problem problem;
    struct forecast f;
    if (!config_read(options->path, NULL, &config))
        return CLI_FAILED;
    if (config_by_command(&config) || config.judge.command) {
        config_free(&config);
        return cli_fail("%s: there is no forecast for commands, which have no derivatives",
                        options->path);
    }
    bool ok = problem_read(&config, &problem);
    if (ok) {
        galv_shape *shape = problem_shape(&problem);
        bool read = shape != NULL;
        ok = read && problem_reduce(&problem, shape, &nobody) && forecast_run(&problem, &f);
        ok = ok || (read && cli_refuse("%s", core_sentence()));
        galv_shape_free(shape);
        problem_free(&problem);
    } else {
        cli_fail("%s", core_sentence());
    }
    if (ok)
        ok = options->json ? json_result_print(result(&f), JSON_INDENT(2)) == CLI_OK
                           : print_text(&f);
    config_free(&config);
    return ok ? CLI_OK : CLI_FAILED;
}
