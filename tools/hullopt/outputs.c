#include "outputs.h"

#include "cli.h"
#include "folder.h"

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
        return cli_fail("%s: %s", path, strerror(errno)) == CLI_OK;
    if (json_dumpf(summary, file.stream, JSON_INDENT(2) | JSON_REAL_PRECISION(15)) != 0 ||
        fputc('\n', file.stream) == EOF) {
        cli_file_abandon(&file);
        return cli_fail("%s: cannot be written", path) == CLI_OK;
    }
    return cli_file_commit(&file) || cli_fail("%s: %s", path, strerror(errno)) == CLI_OK;
}

static bool write_report(const struct results *results, const char *path)
{
    struct cli_file file;
    if (!cli_file_open(&file, path))
        return cli_fail("%s: %s", path, strerror(errno)) == CLI_OK;
    if (!report_write(file.stream, results)) {
        cli_file_abandon(&file);
        return cli_fail("%s: cannot be written", path) == CLI_OK;
    }
    return cli_file_commit(&file) || cli_fail("%s: %s", path, strerror(errno)) == CLI_OK;
}

static bool write_patch(const struct results *r, const nurbs_surface *surface, const char *what,
                        const char *path)
{
    char note[300];
    nurbs_patches *patches = NULL;
    snprintf(note, sizeof note, "%s; evaluation %llu of hullopt run, C_w %.6g at Fr %g", what,
             (unsigned long long)r->best->id, r->best->cw,
             results_number(r->settings, "flow.froude"));
    bool ok = nurbs_patches_create(&patches) == NURBS_OK &&
              nurbs_patches_add(patches, surface) == NURBS_OK &&
              nurbs_patches_set_note(patches, note) == NURBS_OK &&
              nurbs_patches_set_length(patches, r->parent.length) == NURBS_OK &&
              nurbs_patches_write(patches, path) == NURBS_OK;
    if (!ok)
        cli_fail("%s", nurbs_last_error());
    nurbs_patches_free(patches);
    return ok;
}

static bool write_hulls(const struct results *r, const char *json, const char *iges,
                        const char *wetted)
{
    nurbs_surface *hull = NULL;
    if (nurbs_surface_simplify(r->designs[1].full, HULL_TOLERANCE * r->parent.length,
                               NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_THRIFTY, &hull,
                               NULL) != NURBS_OK)
        return cli_fail("best.json: %s", nurbs_last_error()) == CLI_OK;
    bool ok = write_patch(r, hull, "optimised hull up to the deck", json) &&
              write_patch(r, hull, "optimised hull up to the deck", iges) &&
              write_patch(r, r->designs[1].light, "wetted part of the optimised hull", wetted);
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

static bool print_figures(const struct results *r, const char *report)
{
    struct results_times times = results_times(r);
    double allowed = results_number(r->settings, "constraints.displacement");
    printf("%-22s%zu of %zu parameters, %.2f %% of the variance\n", "latent variables",
           r->latent.modes, r->latent.parameters, 100 * r->latent.retained);
    printf("%-22s%.4e\n%-22s%.4e\n%-22s%.1f %%\n", "C_w before", r->baseline->cw, "C_w after",
           r->best->cw, "reduction", 100 * (1 - r->best->cw / r->baseline->cw));
    printf("%-22s%+.2f %%", "displacement", 100 * (r->best->volume_ratio - 1));
    if (isnan(allowed))
        puts(", not constrained");
    else
        printf(", allowed %g %%\n", 100 * allowed);
    printf("%-22s%zu evaluated, %zu failed\n", "designs", r->n - 1, r->failed);
    printf("%-22s%.2f s: geometry %.2f, solve %.2f; proposing %.2f\n", "one evaluation",
           times.evaluation, times.geometry, times.solve, times.propose);
    print_duration("total time", r->seconds);
    printf("%-22s%s\n", "verification",
           r->n_rows ? r->verdict.statement : "not done yet: the run is not finished");
    printf("%-22s%s\n", "report", report);
    return fflush(stdout) != EOF || cli_fail("standard output: %s", strerror(errno)) == CLI_OK;
}

static bool print_summary(const json_t *summary)
{
    bool ok = json_dumpf(summary, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(15)) == 0 &&
              putchar('\n') != EOF && fflush(stdout) != EOF;
    return ok || cli_fail("standard output: %s", strerror(errno)) == CLI_OK;
}

static bool write_all(const struct results *r, const char *folder, bool json)
{
    static const char *const names[] = {"summary.json", "best.json", "best.igs", "best_wetted.json",
                                        "report.html"};
    char *path[5] = {0};
    bool ok = true;
    for (size_t i = 0; i < 5; i++)
        ok = (path[i] = folder_join(folder, names[i])) != NULL && ok;
    json_t *summary = ok ? summary_make(r) : NULL;
    ok = summary != NULL || cli_fail("out of memory") == CLI_OK;
    ok = ok && write_hulls(r, path[1], path[2], path[3]) && write_report(r, path[4]) &&
         write_summary(summary, path[0]) &&
         (json ? print_summary(summary) : print_figures(r, path[4]));
    json_decref(summary);
    for (size_t i = 0; i < 5; i++)
        free(path[i]);
    return ok;
}

bool outputs_write(struct store *store, const char *folder, bool json)
{
    struct results results;
    if (!results_load(store, &results))
        return false;
    bool ok = results.baseline != NULL;
    if (!ok)
        cli_fail("%s: nothing has been evaluated yet", folder);
    ok = ok && write_all(&results, folder, json);
    results_free(&results);
    return ok;
}
