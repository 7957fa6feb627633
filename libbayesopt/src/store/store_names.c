/* Names of variables and texts of conditions: one text each, "variable.1", "condition.1", ..., and
 * how many there are, which older stores do not tell. */
#include "core/error.h"
#include "store/store_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char variable[] = "variable", condition[] = "condition", named_entry[] = "named";

static bayesopt_status get(struct store *store, const char *kind, size_t i, char **text)
{
    char entry[40];
    snprintf(entry, sizeof entry, "%s.%zu", kind, i + 1);
    return store_get_text(store, entry, text);
}

static bayesopt_status put(struct store *store, const char *kind, size_t i, const char *text)
{
    char entry[40];
    snprintf(entry, sizeof entry, "%s.%zu", kind, i + 1);
    return store_put_text(store, entry, text);
}

bayesopt_status store_put_names(struct bayesopt *bo)
{
    bayesopt_status status = BAYESOPT_OK;
    for (size_t j = 0; j < bo->d && bo->named && !status; j++)
        status = put(bo->store, variable, j, bo->names[j]);
    for (size_t i = 0; i < bo->conditions.n && !status; i++)
        status = put(bo->store, condition, i, bo->conditions.texts[i]);
    const double counts[2] = {bo->named ? (double)bo->d : 0, (double)bo->conditions.n};
    return status ? status : store_put_meta(bo->store, named_entry, counts, 2);
}

/* Refuses another text than that of the store; one that has none gets it. */
static bayesopt_status compare(struct store *store, const char *kind, size_t i, const char *text,
                               bool adopt)
{
    char *there;
    bayesopt_status status = get(store, kind, i, &there);
    if (!status && !there && adopt && text)
        return put(store, kind, i, text);
    if (!status && (!there != !text || (there && strcmp(there, text) != 0)))
        status = bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                               "%s belongs to another problem: %s %zu is '%s' there, '%s' here",
                               store->path, kind, i + 1, there ? there : "", text ? text : "");
    free(there);
    return status;
}

bayesopt_status store_compare_names(struct bayesopt *bo)
{
    bayesopt_status status = BAYESOPT_OK;
    for (size_t j = 0; j < bo->d && bo->named && !status; j++)
        status = compare(bo->store, variable, j, bo->names[j], true);
    for (size_t i = 0; i <= bo->conditions.n && !status; i++)
        status = compare(bo->store, condition, i, bo->conditions.texts[i], false);
    return status;
}

/* None may be lost, names may have been added. */
static bayesopt_status check_counts(struct store *store, const struct named *named)
{
    double *counts;
    size_t n, names = 0;
    bayesopt_status status = store_get_meta(store, named_entry, &counts, &n);
    for (size_t j = 0; j < named->d; j++)
        names += named->names[j] != NULL;
    if (!status && counts &&
        !(n == 2 && (double)names >= counts[0] && (double)named->n == counts[1]))
        status = bayesopt_fail(
            BAYESOPT_ERROR_FORMAT,
            "%s: %zu names of variables and %zu conditions are left of %g and %g", store->path,
            names, named->n, n == 2 ? counts[0] : (double)NAN, n == 2 ? counts[1] : (double)NAN);
    free(counts);
    return status;
}

bayesopt_status store_get_names(struct store *store, size_t d, struct named *named)
{
    bayesopt_status status = BAYESOPT_OK;
    *named = (struct named){.d = d};
    named->names = calloc(d, sizeof *named->names);
    named->conditions = calloc(BAYESOPT_MOST_CONSTRAINTS, sizeof *named->conditions);
    if (!named->names || !named->conditions)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    for (size_t j = 0; j < d && !status; j++)
        status = get(store, variable, j, &named->names[j]);
    for (bool more = true; more && !status && named->n < BAYESOPT_MOST_CONSTRAINTS;) {
        status = get(store, condition, named->n, &named->conditions[named->n]);
        more = named->conditions[named->n] != NULL;
        named->n += more;
    }
    return status ? status : check_counts(store, named);
}

void named_free(struct named *named)
{
    for (size_t j = 0; named->names && j < named->d; j++)
        free(named->names[j]);
    for (size_t i = 0; named->conditions && i < named->n; i++)
        free(named->conditions[i]);
    free(named->names);
    free(named->conditions);
}
