/* Files that bayesopt reads. */
#include "config.h"
#include "import.h"
#include "result.h"
#include "target.h"

#include <bayesopt/bayesopt.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Reads the study and makes its optimisation; runs nothing. */
static void read_study(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    struct config config;
    bayesopt *bo = NULL;
    config_start(&config);
    config.path = strdup(path);
    if (config.path && config_read(path, &config) && config_create(&config, ":memory:", &bo)) {
        size_t d = bayesopt_dimension(bo, NULL, NULL);
        double *bounds = malloc(2 * d * sizeof *bounds);
        demand(bounds != NULL, "there is memory");
        bayesopt_dimension(bo, bounds, bounds + d);
        demand_finite(2 * d, bounds, "bounds");
        free(bounds);
    }
    bayesopt_free(bo);
    config_free(&config);
}

/* Results in a table, told to a fresh optimisation. */
static void read_table(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    char x[] = "x", kind[] = "kind", c[] = "c", a[] = "a", b[] = "b", *texts[] = {a, b};
    char *variables[] = {x, kind}, *constraints[] = {c};
    struct labels labels[] = {{0, NULL}, {2, texts}};
    const struct names names = {2, 1, variables, constraints, labels};
    const bayesopt_kind kinds[] = {BAYESOPT_KIND_REAL, BAYESOPT_KIND_CATEGORICAL};
    bayesopt_options options;
    bayesopt *bo = NULL;
    bayesopt_options_init(&options);
    options.kind = kinds;
    options.n_constraints = 1;
    options.constraint_lower = (const double[]){-INFINITY};
    options.constraint_upper = (const double[]){1};
    demand(!bayesopt_create(2, (const double[]){0, 0}, (const double[]){1, 1}, &options, &bo),
           "an optimisation can be made");
    if (import_table(bo, &names, path, false)) {
        bayesopt_point p;
        for (size_t i = 0; i < bayesopt_count(bo); i++) {
            demand(!bayesopt_get(bo, i, &p), "every row can be had");
            demand(p.x[0] >= 0 && p.x[0] <= 1 && (p.x[1] == 0 || p.x[1] == 1), "a point in bounds");
        }
    }
    bayesopt_free(bo);
}

/* What a program printed. */
static void read_result(const char *path, size_t n, const uint8_t *bytes)
{
    (void)path;
    char *text = malloc(n + 1), reason[200];
    double values[3];
    demand(text != NULL, "there is memory");
    for (size_t i = 0; i < n; i++) /* as program_read() gives it */
        text[i] = (char)(bytes[i] ? bytes[i] : ' ');
    text[n] = '\0';
    result_find(text, "Cw", RESULT_EQUAL, 1, values, reason, sizeof reason);
    result_find(text, "gradient", RESULT_LAST, 3, values, reason, sizeof reason);
    result_last(text, values, reason, sizeof reason);
    free(text);
}

const struct reader READERS[] = {
    {"study_yaml", ".yaml", read_study},
    {"results_csv", ".csv", read_table},
    {"result", NULL, read_result},
    {NULL, NULL, NULL},
};
