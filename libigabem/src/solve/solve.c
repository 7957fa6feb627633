#include "core/error.h"
#include "solve/group.h"

#include <stdlib.h>

/* Solves the settings of solutions[n] group by group. member has room for n, taken[n] is all false.
 */
static igabem_status solve_groups(size_t n, igabem_solution *const *solutions,
                                  igabem_solution **member, bool *taken, struct progress *progress)
{
    igabem_status status = IGABEM_OK;
    for (size_t k = 0; k < n && status == IGABEM_OK; k++) {
        if (taken[k])
            continue;
        size_t count = 0;
        for (size_t m = k; m < n; m++)
            if (!taken[m] && group_has_both(&solutions[k]->options, &solutions[m]->options)) {
                taken[m] = true;
                member[count++] = solutions[m];
            }
        status = group_solve(count, member, 1.0 / (double)n, progress);
    }
    return status;
}

igabem_status igabem_solve_many(const igabem_hull *hull, size_t n, const igabem_options *options,
                                igabem_solution **solutions)
{
    for (size_t k = 0; k < n && solutions; k++)
        solutions[k] = NULL;
    if (!hull || (n && (!options || !solutions)))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "hull, options or solutions is NULL");
    igabem_solution **member = calloc(n + 1, sizeof *member);
    bool *taken = calloc(n + 1, sizeof *taken);
    igabem_status status =
        member && taken ? IGABEM_OK : igabem_fail(IGABEM_ERROR_MEMORY, "no memory to solve");
    for (size_t k = 0; k < n && status == IGABEM_OK; k++)
        status = solution_create(hull, &options[k], &solutions[k]);
    struct progress progress = {.tell = NULL};
    if (n > 0)
        progress = (struct progress){.tell = options[0].progress,
                                     .user_data = options[0].progress_user_data};
    if (status == IGABEM_OK)
        status = solve_groups(n, solutions, member, taken, &progress);
    free(member);
    free(taken);
    for (size_t k = 0; k < n && status != IGABEM_OK; k++) {
        igabem_solution_free(solutions[k]);
        solutions[k] = NULL;
    }
    return status;
}

igabem_status igabem_solve(const igabem_hull *hull, const igabem_options *options,
                           igabem_solution **solution)
{
    return igabem_solve_many(hull, 1, options, solution);
}
