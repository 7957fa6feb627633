/* igabem check: whether a hull can be solved, and why not. */
#include "cli.h"
#include "commands.h"
#include "hull_input.h"
#include "json_result.h"

#include <igabem/solve.h>

#include <jansson.h>
#include <math.h>

struct request {
    struct hull_request hull;
    bool json;
};

static const struct setting ROWS[] = {
    HULL_FILE_ROW(struct request, hull),
    HULL_WATER_ROWS(struct request, hull),
    HULL_JSON_ROW(struct request, json),
};
static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS,
    .usage = "usage: igabem check HULL [OPTION]...\n"
             "\n"
             "Refuses, with patch and place, a hull that cannot be solved: folds, points above the "
             "still\n"
             "water or across the centre plane, open seams, vanishing normals. Otherwise says what "
             "it is\n"
             "and which formulation and filter the rules choose.\n\n"};

static int print_json(const struct hull_input *input, const igabem_hull_info *info,
                      const igabem_options *options)
{
    json_t *json = json_object();
    json_result_set(json, "usable", json_true());
    json_result_set(json, "note", json_string(input->note));
    json_result_set(json, "patches", json_integer((json_int_t)info->patches));
    json_result_set(json, "length", json_real(info->length));
    json_result_set(json, "surface_piercing", json_boolean(info->surface_piercing));
    json_result_set(json, "transom", json_boolean(info->transom != IGABEM_TRANSOM_NONE));
    json_result_set(json, "stern", json_string(hull_stern(info)));
    json_result_set(json, "nu_s", json_real(info->nu_s));
    json_result_set(json, "volume", json_real(info->hydrostatics.volume));
    json_result_set(json, "wetted_area", json_real(info->hydrostatics.wetted_area));
    json_result_set(json, "formulation",
                    json_string(igabem_formulation_name(options->formulation)));
    json_t *warnings = json_array();
    const char *sentence;
    for (size_t k = 0; (sentence = igabem_hull_warning(input->hull, k)); k++)
        json_result_append(warnings, json_string(sentence));
    json_result_set(json, "warnings", warnings);
    return json_result_print(json, JSON_INDENT(1) | JSON_REAL_PRECISION(12));
}

static int print_text(const struct hull_input *input, const igabem_hull_info *info,
                      const igabem_options *options, const char *path)
{
    printf("%s is usable: %s\n", path, input->note);
    printf("%zu patch%s, %s, %s, L %.6g m, V %.6g m^3, S %.6g m^2\n", info->patches,
           info->patches == 1 ? "" : "es",
           info->surface_piercing ? "surface-piercing" : "submerged", hull_stern(info),
           info->length, info->hydrostatics.volume, info->hydrostatics.wetted_area);
    if (info->surface_piercing)
        printf("nu_s %.4g: formulation %s, t_c %.4g, stem limit %.4g\n", info->nu_s,
               igabem_formulation_name(options->formulation), options->cutoff_angle,
               options->stem_limit);
    const char *sentence;
    for (size_t k = 0; (sentence = igabem_hull_warning(input->hull, k)); k++)
        printf("warning: %s\n", sentence);
    return cli_printed();
}

static int check(const struct request *request)
{
    struct hull_input input;
    igabem_hull_info info;
    igabem_options options;
    int code = hull_input_read(&request->hull, &input);
    if (code != CLI_OK)
        return code;
    igabem_hull_get_info(input.hull, &info);
    igabem_options_init(&options);
    options.froude = 0.3;
    if (igabem_options_freeze(input.hull, &options))
        code = cli_fail("%s: %s", request->hull.path, igabem_last_error());
    else if (request->json)
        code = print_json(&input, &info, &options);
    else
        code = print_text(&input, &info, &options, request->hull.path);
    hull_input_free(&input);
    return code;
}

int command_check(int argc, char **argv)
{
    struct request request = {0};
    hull_request_init(&request.hull);
    settings_start(&TABLE, &request);
    int code = settings_options(argc, argv, &TABLE, &request, NULL, NULL);
    if (code < 0)
        code = check(&request);
    settings_free(&TABLE, &request);
    return code;
}
