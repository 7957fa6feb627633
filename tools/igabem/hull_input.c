#include "hull_input.h"

#include "cli.h"

#include <math.h>

const struct setting_word HULL_BY_RULE[] = {{"by rule", NAN}, {NULL, 0}};

void hull_request_init(struct hull_request *request)
{
    *request = (struct hull_request){.draft = NAN, .simplify = NAN, .length = NAN};
}

void hull_input_free(struct hull_input *input)
{
    igabem_hull_free(input->hull);
    nurbs_hull_free(input->source);
    *input = (struct hull_input){0};
}

int hull_input_read(const struct hull_request *request, struct hull_input *input)
{
    nurbs_hull_options options;
    *input = (struct hull_input){0};
    nurbs_hull_options_init(&options);
    options.level = request->level;
    options.draft = request->draft;
    options.simplify = request->simplify;
    options.length = request->length;
    options.sinkage = request->sinkage;
    options.trim = request->trim;
    options.pivot = request->pivot;
    options.unbounded = request->unbounded;
    if (nurbs_hull_read(request->path, &options, &input->source))
        return cli_fail("%s", nurbs_last_error());
    const char *step;
    for (size_t k = 1; !request->quiet && (step = nurbs_hull_step(input->source, k)); k++)
        fprintf(stderr, "%s: %s: %s\n", cli_name(), request->path, step);
    if (igabem_hull_from(input->source, &input->hull)) {
        hull_input_free(input);
        return cli_fail("%s: %s", request->path, igabem_last_error());
    }
    input->patches = nurbs_hull_light(input->source);
    input->note = nurbs_hull_step(input->source, 0);
    input->half = nurbs_hull_is_half(input->source);
    input->simplify_bound = nurbs_hull_bound(input->source);
    input->lpp = nurbs_hull_lpp(input->source);
    return CLI_OK;
}

const char *hull_stern(const igabem_hull_info *info)
{
    return info->transom == IGABEM_TRANSOM_OPEN     ? "open transom"
           : info->transom == IGABEM_TRANSOM_CLOSED ? "closed transom"
                                                    : "no transom";
}
