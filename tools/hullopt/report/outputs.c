#include "report/outputs.h"

#include "cli.h"
#include "cli/folder.h"
#include "core/constraints.h"
#include "core/objective.h"
#include "json_result.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The hull for a drawing office is kept ten times closer than the patch that is solved. */
static const double HULL_TOLERANCE = 1e-5;

static bool write_summary(const json_t *summary, const char *path)
{
    struct cli_file file;
    if (!cli_file_open(&file, path))
        return cli_refuse("%s: cannot be written: %s", path, strerror(errno));
    if (!json_result_write(file.stream, json_incref((json_t *)summary),
                           JSON_INDENT(2) | JSON_REAL_PRECISION(15))) {
        cli_file_abandon(&file);
        return false;
    }
    return cli_file_commit(&file) || cli_refuse("%s: cannot be written: %s", path, strerror(errno));
}

static bool write_report(const struct results *results, const char *path)
{
    struct cli_file file;
    if (!cli_file_open(&file, path))
        return cli_refuse("%s: cannot be written: %s", path, strerror(errno));
    report_write(file.stream, results);
    return cli_file_commit(&file) || cli_refuse("%s: cannot be written: %s", path, strerror(errno));
}

static bool write_patch(const struct results *r, const nurbs_surface *surface, const char *what,
                        const char *path)
{
    char note[300];
    nurbs_patches *patches = NULL;
    snprintf(note, sizeof note, "%s; evaluation %llu of hullopt run, C_w %.6g at Fr %g", what,
             (unsigned long long)r->best->id, r->best->cw, r->problem->config->solver.froude);
    bool ok = nurbs_patches_create(&patches) == NURBS_OK &&
              nurbs_patches_add(patches, surface) == NURBS_OK &&
              nurbs_patches_set_note(patches, note) == NURBS_OK &&
              nurbs_patches_set_length(patches, problem_length(r->problem)) == NURBS_OK &&
              nurbs_patches_write(patches, path) == NURBS_OK;
    if (!ok)
        cli_fail("%s", nurbs_last_error());
    nurbs_patches_free(patches);
    return ok;
}

/* The hull in three formats, then its wetted part. */
static bool write_hulls(const struct results *r, char *const path[4])
{
    nurbs_surface *hull = NULL;
    if (nurbs_surface_simplify(nurbs_patches_get(nurbs_hull_full(results_hull(r, 1)), 0),
                               HULL_TOLERANCE * problem_length(r->problem),
                               NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_THRIFTY, &hull,
                               NULL) != NURBS_OK)
        return cli_refuse("best.json: %s", nurbs_last_error());
    bool ok = true;
    for (size_t i = 0; i < 3; i++)
        ok = ok && write_patch(r, hull, "optimised hull up to the deck", path[i]);
    ok = ok && write_patch(r, nurbs_patches_get(nurbs_hull_light(results_hull(r, 1)), 0),
                           "wetted part of the optimised hull", path[3]);
    nurbs_surface_free(hull);
    return ok;
}

static void print_duration(const char *label, double seconds)
{
    if (seconds < 120)
        printf("%-22s%.1f s\n", label, seconds);
    else
        printf("%-22s%d min %02d s\n", label, (int)(seconds / 60), (int)fmod(seconds, 60));
}

static void print_front(const struct results *r)
{
    const size_t objectives = objectives_count(r->problem->config);
    struct objective o;
    if (objectives == 1)
        return;
    printf("%-22s%zu designs, %llu is the one below\n", "Pareto set", r->n_front,
           (unsigned long long)r->best->id);
    for (size_t k = 0; k < objectives; k++) {
        double low = INFINITY, high = -INFINITY;
        objectives_describe(r->problem->config, k, &o);
        for (size_t i = 0; i < r->n_front; i++) {
            double value = results_objective(r, k, &r->evaluations[r->front[i]]);
            low = fmin(low, value);
            high = fmax(high, value);
        }
        printf("  %-32s%.5g to %.5g, original %.5g, here %.5g\n", o.label, low, high,
               results_objective(r, k, r->baseline), results_objective(r, k, r->best));
    }
}

static bool print_figures(const struct results *r, const char *folder)
{
    struct results_times times = results_times(r);
    printf("%-22s%zu of %zu parameters, %.2f %% of the variance\n", "latent variables",
           galv_model_modes(r->problem->model), results_parameters(r),
           100 * galv_model_retained(r->problem->model));
    print_front(r);
    if (r->problem->config->judge.command)
        printf("%-22s%.6g, original %.6g, %+.1f %%\n", "objective", r->best->value,
               r->baseline->value, 100 * (r->best->value / r->baseline->value - 1));
    printf("%-22s%.4e\n%-22s%.4e\n%-22s%.1f %%\n", "C_w before", r->baseline->cw, "C_w after",
           r->best->cw, "reduction", 100 * (1 - r->best->cw / r->baseline->cw));
    double total[2];
    results_total_resistance(r, total);
    printf("%-22s%.4g N, %+.1f %% by ITTC-57, form factor %g\n", "R_t", total[1],
           100 * (total[1] / total[0] - 1), r->problem->config->form_factor);
    for (size_t k = 0; k < constraints_count(); k++) {
        struct constraint_figures f;
        constraints_figures(r->problem->config, k, r->baseline, r->best, &f);
        if (isfinite(f.ratio) && !(f.is_optional && isnan(f.allowed)))
            printf("%-22s%+.2f %%, limit %s\n", f.name, 100 * f.change, f.limit);
    }
    if (r->made)
        printf("%-22s%.2g m from the optimum, C_w %.4e: %s\n", "hull of the command", r->residual,
               r->made_cw, r->made);
    printf("%-22s%zu evaluated, %zu failed\n", "designs", r->n - 1, r->failed);
    printf("%-22s%.2f s: geometry %.2f, solve %.2f; proposing %.2f\n", "one evaluation",
           times.evaluation, times.geometry, times.solve, times.propose);
    print_duration("total time", r->seconds);
    printf("%-22s%s\n", "verification", results_statement(r));
    if (folder)
        printf("%-22s%s/report.html\n", "report", folder);
    return cli_printed() == CLI_OK;
}

static bool print_summary(const json_t *summary)
{
    return json_result_print(json_incref((json_t *)summary),
                             JSON_INDENT(2) | JSON_REAL_PRECISION(15)) == CLI_OK;
}

static bool write_files(const struct results *r, const char *folder, const json_t *summary)
{
    static const char *const names[] = {"summary.json", "best.json",        "best.igs",
                                        "best.step",    "best_wetted.json", "report.html"};
    enum { FILES = sizeof names / sizeof *names };
    char *path[FILES];
    for (size_t i = 0; i < FILES; i++)
        path[i] = folder_join(folder, names[i]);
    bool ok =
        write_hulls(r, path + 1) && write_report(r, path[5]) && write_summary(summary, path[0]);
    for (size_t i = 0; i < FILES; i++)
        free(path[i]);
    return ok;
}

bool outputs_write(const struct results *r, const char *folder, bool json)
{
    json_t *summary = summary_make(r);
    bool ok = (summary || cli_refuse("out of memory")) &&
              (!folder || write_files(r, folder, summary)) &&
              (json ? print_summary(summary) : print_figures(r, folder));
    json_decref(summary);
    return ok;
}
