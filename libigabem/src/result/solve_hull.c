/* From a hull of libnurbs to its resistance. */
#include "core/error.h"

#include <igabem/solve.h>

igabem_status igabem_solve_hull(const nurbs_hull *source, const igabem_options *options,
                                igabem_forces *forces)
{
    igabem_hull *hull = NULL;
    igabem_solution *solution = NULL;
    if (!options || !forces)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "options and a place for forces must be given");
    igabem_status status = igabem_hull_from(source, &hull);
    if (!status)
        status = igabem_solve(hull, options, &solution);
    if (!status)
        status = igabem_forces_compute(solution, forces);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
    return status;
}
