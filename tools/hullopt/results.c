#include "results.h"

#include "cli.h"
#include "limits.h"
#include "outcome.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool results_text(const char *settings, const char *key, char *value, size_t size)
{
    size_t length = strlen(key);
    for (const char *line = settings; line && *line;) {
        if (strncmp(line, key, length) == 0 && strncmp(line + length, " = ", 3) == 0) {
            const char *text = line + length + 3;
            snprintf(value, size, "%.*s", (int)strcspn(text, "\n"), text);
            return true;
        }
        line = strchr(line, '\n');
        line = line ? line + 1 : NULL;
    }
    if (size)
        *value = '\0';
    return false;
}

double results_number(const char *settings, const char *key)
{
    char text[64];
    double value;
    if (results_text(settings, key, text, sizeof text) && cli_parse_double(text, &value))
        return value;
    return NAN;
}

static bool load_parent(struct store *store, struct results *r)
{
    size_t rows = 0, columns = 0, one, length_columns;
    double *points = store_get_array(store, "grid", &rows, &columns);
    double *length = store_get_array(store, "length", &one, &length_columns);
    bool ok = points && length && columns % 3 == 0 && one * length_columns == 1 &&
              rows * columns == r->latent.coordinates &&
              nurbs_grid_create(rows, columns / 3, points, &r->parent.grid) == NURBS_OK;
    if (ok)
        r->parent.length = *length;
    else
        cli_fail("run.db: the parent's grid is missing or does not fit the latent space");
    free(points);
    free(length);
    return ok;
}

static void find_best(struct results *r)
{
    r->limits = (struct outcome_limits){results_number(r->settings, "constraints.pressure"),
                                        results_number(r->settings, "constraints.speeds")};
    for (size_t i = 0; i < r->n; i++) {
        const struct evaluation *e = &r->evaluations[i];
        r->failed += e->failed;
        if (e->id == 0)
            r->baseline = e;
        if (outcome_allowed(&r->limits, e, r->evaluations) && (!r->best || e->cw < r->best->cw))
            r->best = e;
    }
}

static bool build(const struct results *r, const double *u, struct design *design)
{
    struct failure failure;
    double tolerance = results_number(r->settings, "reconstruction.tolerance");
    double *d = malloc(r->latent.coordinates * sizeof *d);
    if (!d)
        return cli_fail("out of memory") == CLI_OK;
    latent_displace(&r->latent, u, d);
    bool ok = design_build(&r->parent, d, tolerance, design, &failure);
    if (!ok)
        cli_fail("run.db: a recorded design cannot be built again (%s): %s", failure.stage,
                 failure.reason);
    free(d);
    return ok;
}

static bool load_designs(struct results *r)
{
    r->nu_s[0] = r->nu_s[1] = NAN;
    if (!r->baseline)
        return true;
    if (!build(r, r->baseline->u, &r->designs[0]) || !build(r, r->best->u, &r->designs[1]))
        return false;
    for (int k = 0; k < 2; k++) {
        const nurbs_surface *patch = r->designs[k].light;
        igabem_hull *hull;
        igabem_hull_info info;
        if (igabem_hull_create(&patch, 1, IGABEM_SYMMETRIC, &hull) != IGABEM_OK)
            continue;
        igabem_hull_get_info(hull, &info);
        r->nu_s[k] = info.nu_s;
        igabem_hull_free(hull);
    }
    return true;
}

static void measure_breadth(struct results *r)
{
    struct limits limits;
    r->breadth = NAN;
    if (!r->best || !limits_create(&r->latent, r->parent.grid, NULL, &limits))
        return;
    r->breadth = limits_breadth(&limits, r->best->u).least_share;
    limits_free(&limits);
}

static void load_parameters(struct store *store, struct results *r)
{
    size_t one, n;
    r->residual = NAN;
    r->parameters = store_get_array(store, "best.parameters", &one, &r->n_parameters);
    double *residual = store_get_array(store, "best.residual", &one, &n);
    if (residual && one * n == 1)
        r->residual = *residual;
    free(residual);
}

bool results_load(struct store *store, struct results *r)
{
    *r = (struct results){0};
    r->settings = store_get_text(store, "configuration");
    r->solver = store_get_text(store, "solver");
    r->stop = store_get_text(store, "stop");
    bool ok = r->settings && r->solver && store_get_latent(store, &r->latent) &&
              load_parent(store, r) &&
              store_list_evaluations(store, r->latent.modes, &r->evaluations, &r->n) &&
              store_list_verifications(store, &r->rows, &r->n_rows);
    if (ok) {
        find_best(r);
        ok = load_designs(r);
    }
    if (!ok) {
        results_free(r);
        return false;
    }
    verify_judge(r->rows, r->n_rows, &r->verdict);
    bool both = waves_load(store, "parent", &r->waves[0]);
    both = (waves_load(store, "best", &r->waves[1]) || r->best == r->baseline) && both;
    load_parameters(store, r);
    measure_breadth(r);
    r->seconds = store_total_seconds(store, &r->sessions);
    r->complete = r->stop && both && r->n_rows > 0;
    return true;
}

void results_free(struct results *r)
{
    for (size_t i = 0; i < r->n; i++)
        evaluation_free(&r->evaluations[i]);
    for (int k = 0; k < 2; k++) {
        design_free(&r->designs[k]);
        free(r->waves[k].elevation);
    }
    free(r->evaluations);
    free(r->rows);
    free(r->parameters);
    free(r->settings);
    free(r->solver);
    free(r->stop);
    latent_free(&r->latent);
    parent_free(&r->parent);
    *r = (struct results){0};
}

struct results_times results_times(const struct results *r)
{
    struct results_times t = {0, 0, 0, 0};
    for (size_t i = 0; i < r->n; i++) {
        t.geometry += r->evaluations[i].geometry_seconds;
        t.solve += r->evaluations[i].solve_seconds;
        t.propose += r->evaluations[i].propose_seconds;
    }
    double n = r->n ? (double)r->n : 1;
    t.geometry /= n;
    t.solve /= n;
    t.propose /= n;
    t.evaluation = t.geometry + t.solve;
    return t;
}
