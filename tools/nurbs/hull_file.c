#include "json_result.h"
#include "nurbs_tool.h"

int load_hull(const char *path, const nurbs_hull_options *options, nurbs_hull **hull)
{
    if (nurbs_hull_read(path, options, hull) != NURBS_OK)
        return library_failure();
    const char *step;
    for (size_t k = 1; (step = nurbs_hull_step(*hull, k)); k++)
        fprintf(stderr, "%s: %s: %s\n", cli_name(), path, step);
    return CLI_OK;
}

json_t *hull_steps(const nurbs_hull *hull)
{
    json_t *list = json_array();
    const char *step;
    for (size_t k = 1; (step = nurbs_hull_step(hull, k)); k++)
        json_result_append(list, json_string(step));
    return list;
}
