#include "core/compare.h"

#include "core/constraints.h"
#include "core/objective.h"
#include "core/record.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The lines of a canonical text that begin with none of these. */
static char *without(const char *text, const char *const *keys)
{
    char *kept = calloc(1, strlen(text) + 1), *to = kept;
    while (kept && *text) {
        size_t length = strcspn(text, "\n");
        length += text[length] == '\n';
        bool drop = false;
        for (const char *const *key = keys; *key; key++)
            drop = drop || strncmp(text, *key, strlen(*key)) == 0;
        if (!drop) {
            memcpy(to, text, length);
            to += length;
        }
        text += length;
    }
    return kept;
}

static bool set_texts(const struct config *config, size_t variables, struct course *r)
{
    static const char *const own[] = {"search.seed", "name", NULL},
                             *const ways[] = {"search.method",  "search.space",
                                              "search.initial", "search.iterations",
                                              "search.design",  "search.strategy",
                                              "search.seed",    "latent.",
                                              "name",           NULL};
    char label[80];
    const struct method_row *method = method_row(config->method);
    bool forecast =
        method->kind == METHOD_GAUSSIAN_PROCESS && config->design == CONFIG_DESIGN_FORECAST;
    snprintf(label, sizeof label, "%s%s, %zu variables", method->name, forecast ? "-forecast" : "",
             variables);
    r->label = strdup(label);
    r->group = without(config->text, own);
    r->problem = without(config->text, ways);
    return (r->label && r->group && r->problem) || core_no_memory();
}

static bool follow(const struct config *config, size_t n, const struct evaluation *list,
                   struct course *r)
{
    double best = 1, seconds = 0;
    r->best = malloc((n + 1) * sizeof *r->best);
    r->seconds = malloc((n + 1) * sizeof *r->seconds);
    if (!r->best || !r->seconds)
        return core_no_memory();
    for (size_t i = 1; i < n; i++) {
        if (outcome_allowed(config, &list[i], list))
            best = fmin(best, list[i].objective / list[0].objective);
        const double spent[] = {list[i].propose_seconds, list[i].geometry_seconds,
                                list[i].solve_seconds};
        for (size_t k = 0; k < 3; k++)
            seconds += isfinite(spent[k]) ? spent[k] : 0;
        r->best[r->n] = best;
        r->seconds[r->n++] = seconds;
    }
    return true;
}

static bool read_course(const char *path, struct course *r)
{
    struct record record;
    struct origin origin;
    struct config config;
    struct evaluation *list = NULL;
    size_t n = 0;
    if (!record_read(path, &record, &origin))
        return false;
    bool known = config_restore(origin.configuration, &config);
    bool ok = (known || core_fail("%s: the configuration is damaged", path)) &&
              record_evaluations(&record, &list, &n) &&
              ((n > 0 && !list[0].failed) || core_fail("%s: no design is on record", path)) &&
              (objectives_count(&config) == 1 ||
               core_fail("%s: it has several objectives, of which no design is the best", path)) &&
              set_texts(&config, galv_model_modes(origin.model), r) && follow(&config, n, list, r);
    free(list);
    if (known)
        config_free(&config);
    origin_free(&origin);
    record_close(&record);
    return ok;
}

static bool set_groups(struct comparison *c, char *const *paths)
{
    char difference[400];
    for (size_t i = 0; i < c->n; i++) {
        size_t first = 0;
        if (config_difference(c->course[i].problem, c->course[0].problem,
                              (const char *const[]){paths[i], paths[0]}, difference,
                              sizeof difference))
            return core_fail("these are runs of different problems: %s", difference);
        while (strcmp(c->course[first].group, c->course[i].group) != 0)
            first++;
        c->group[i] = first < i ? c->group[first] : c->groups++;
        if (c->course[i].n)
            c->least = fmin(c->least, c->course[i].best[c->course[i].n - 1]);
    }
    return true;
}

bool comparison_read(size_t n, char *const *paths, struct comparison *c)
{
    *c = (struct comparison){.n = n, .least = 1};
    c->course = calloc(n + 1, sizeof *c->course);
    c->group = calloc(n + 1, sizeof *c->group);
    bool ok = (c->course && c->group) || core_no_memory();
    for (size_t i = 0; i < n && ok; i++)
        ok = read_course(paths[i], &c->course[i]);
    ok = ok && set_groups(c, paths);
    if (!ok)
        comparison_free(c);
    return ok;
}

void comparison_free(struct comparison *c)
{
    for (size_t i = 0; c->course && i < c->n; i++) {
        struct course *r = &c->course[i];
        free(r->label);
        free(r->group);
        free(r->problem);
        free(r->best);
        free(r->seconds);
    }
    free(c->course);
    free(c->group);
    *c = (struct comparison){.n = 0};
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void comparison_quartiles(size_t n, double *values, double quartile[3])
{
    qsort(values, n, sizeof *values, by_value);
    for (size_t q = 0; q < 3; q++) {
        double place = 0.25 * (double)(q + 1) * (double)(n - 1), share = place - floor(place);
        size_t k = (size_t)place;
        quartile[q] = n == 0 ? NAN : values[k];
        if (n && share > 0)
            quartile[q] =
                isinf(values[k + 1]) ? INFINITY : (1 - share) * values[k] + share * values[k + 1];
    }
}

size_t comparison_last(const struct comparison *c, size_t group, double *values)
{
    size_t count = 0;
    for (size_t i = 0; i < c->n; i++)
        if (c->group[i] == group)
            values[count++] = c->course[i].n ? c->course[i].best[c->course[i].n - 1] : 1;
    return count;
}

size_t comparison_needed(const struct comparison *c, size_t group, size_t level, bool seconds,
                         double *values)
{
    size_t count = 0;
    for (size_t i = 0; i < c->n; i++) {
        const struct course *r = &c->course[i];
        size_t k = 0;
        if (c->group[i] != group)
            continue;
        while (k < r->n && r->best[k] > (1 + COMPARE_LEVEL[level]) * c->least)
            k++;
        values[count++] = k == r->n ? INFINITY : seconds ? r->seconds[k] : (double)(k + 1);
    }
    return count;
}
