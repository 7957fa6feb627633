/* igabem hydrostatics: the page a naval architect wants of a hull at rest. */
#include "cli.h"
#include "commands.h"
#include "constants.h"
#include "hull_input.h"
#include "json_result.h"

#include <nurbs/particulars.h>

#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

struct request {
    struct hull_request hull;
    double kg, density;
    size_t stations;
    bool json;
};

static const struct setting_word UNKNOWN[] = {{"not known", NAN}, {NULL, 0}};
#define ROW(...) HULL_ROW(struct request, __VA_ARGS__)
static const struct setting ROWS[] = {
    HULL_FILE_ROW(struct request, hull),
    HULL_WATER_ROWS(struct request, hull),
    ROW("kg", NUMBER, kg, .sentence = "height of the centre of gravity above the keel, m: GM_t too",
        SETTING_ABOVE(0), .words = UNKNOWN),
    ROW("density", NUMBER, density, .sentence = "kg/m^3", SETTING_ABOVE(0)),
    ROW("stations", COUNT, stations, .sentence = "sections of the area curve",
        SETTING_FROM(2, 10001)),
    HULL_JSON_ROW(struct request, json),
};
static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS,
    .usage = "usage: igabem hydrostatics HULL [OPTION]...\n"
             "\n"
             "Particulars of a hull at rest. HULL: a NURBS file (.json, .igs), cut at the still "
             "water if it\n"
             "crosses it. Lengths in metres; x as in the file, z up from the still water.\n\n"};

/* What the page shows. */
struct page {
    const char *path;
    char note[200];
    nurbs_particulars hull;
    double nu_s, entrance_angle;
    size_t stations;
    double *x, *area; /* [stations] */
};

static const struct figure {
    const char *key, *unit, *text;
    size_t at;   /* offset of a double in the page */
    bool afloat; /* left out for a body without a waterline */
} FIGURES[] = {
#define OF_HULL(member) offsetof(struct page, hull.member)
#define AT_REST(member) offsetof(struct page, hull.hydrostatics.member)
    {"length", "m", "reference length (Lpp)", OF_HULL(length), false},
    {"waterline_length", "m", "Lwl", OF_HULL(waterline_length), false},
    {"x_aft", "m", "aft end of the waterline", AT_REST(x_aft), false},
    {"x_fore", "m", "fore end of the waterline", AT_REST(x_fore), false},
    {"beam", "m", "at the waterline", AT_REST(beam), false},
    {"draft", "m", "deepest point", AT_REST(draft), false},
    {"keel_draft", "m", "keel amidships", AT_REST(keel_draft), false},
    {"volume", "m^3", "displacement", AT_REST(volume), false},
    {"mass", "kg", "displaced", OF_HULL(mass), false},
    {"wetted_area", "m^2", "both sides, transom excluded", AT_REST(wetted_area), false},
    {"waterplane_area", "m^2", "", AT_REST(waterplane_area), false},
    {"transom_area", "m^2", "immersed, at rest", AT_REST(transom_area), false},
    {"transom_ratio", "", "over the largest section", OF_HULL(transom_ratio), false},
    {"section_area_max", "m^2", "", AT_REST(section_area_max), false},
    {"section_area_max_x", "m", "", AT_REST(section_area_max_x), false},
    {"lcb", "m", "x of the centre of buoyancy", AT_REST(centroid[0]), false},
    {"lcb_from_fore", "m", "aft of the fore perpendicular", OF_HULL(lcb_from_fore), false},
    {"lcb_percent", "%", "of the length, forward of midship", OF_HULL(lcb_percent), false},
    {"vcb", "m", "z of the centre of buoyancy", AT_REST(centroid[2]), false},
    {"kb", "m", "above the keel", OF_HULL(kb), false},
    {"lcf", "m", "x of the centre of flotation", OF_HULL(lcf), false},
    {"lcf_from_fore", "m", "", OF_HULL(lcf_from_fore), false},
    {"bmt", "m", "transverse metacentric radius", OF_HULL(bmt), true},
    {"bml", "m", "longitudinal metacentric radius", OF_HULL(bml), true},
    {"kmt", "m", "", OF_HULL(kmt), true},
    {"gmt", "m", "", OF_HULL(gmt), true},
    {"tpc", "t/cm", "tonnes per centimetre immersion", OF_HULL(tpc), true},
    {"mtc", "t m/cm", "moment to change trim one centimetre", OF_HULL(mtc), true},
    {"cb", "", "block, on Lwl, B, keel draft", OF_HULL(cb), true},
    {"cm", "", "largest section", OF_HULL(cm), true},
    {"cp", "", "prismatic", OF_HULL(cp), true},
    {"cwp", "", "waterplane", OF_HULL(cwp), true},
    {"cvp", "", "vertical prismatic", OF_HULL(cvp), true},
    {"nu_s", "", "largest |x component| of the waterline normal", offsetof(struct page, nu_s),
     true},
    {"entrance_angle", "deg", "half angle that belongs to it",
     offsetof(struct page, entrance_angle), true},
    {"error", "", "relative, of the integrals", AT_REST(error), false},
    {"bulb_ratio", "", "section at the fore perpendicular over the largest", OF_HULL(bulb_ratio),
     true},
};
enum { N_FIGURES = sizeof FIGURES / sizeof *FIGURES };

static bool figure_value(const struct page *page, size_t k, double *value)
{
    *value = *(const double *)(const void *)((const char *)page + FIGURES[k].at);
    return !FIGURES[k].afloat || !isnan(page->hull.waterline_length);
}

/* Creates x and area of the page. */
static bool fill_page(const struct request *request, const struct hull_input *input,
                      struct page *page)
{
    size_t n = page->stations = request->stations;
    igabem_hull_info info;
    igabem_hull_get_info(input->hull, &info);
    page->path = request->hull.path;
    snprintf(page->note, sizeof page->note, "%s; %s", input->note, hull_stern(&info));
    page->nu_s = info.nu_s;
    page->entrance_angle = asin(fmin(1.0, info.nu_s)) * (180 / PI);
    page->x = malloc(2 * n * sizeof *page->x);
    page->area = page->x ? page->x + n : NULL;
    if (!page->x)
        return cli_refuse("out of memory");
    if (nurbs_hull_particulars(input->source, request->density, request->kg, &page->hull))
        return cli_refuse("%s: %s", page->path, nurbs_last_error());
    const double *end = page->hull.perpendicular;
    for (size_t i = 0; i < n; i++)
        page->x[i] = end[0] + (end[1] - end[0]) * (double)i / (double)(n - 1);
    return !nurbs_hull_section_areas(input->source, n, page->x, page->area) ||
           cli_refuse("%s: %s", page->path, nurbs_last_error());
}

static int print_json(const igabem_hull *hull, const struct page *page)
{
    json_t *json = json_object(), *curve = json_array(), *warnings = json_array();
    double value;
    for (size_t k = 0; k < N_FIGURES; k++)
        if (figure_value(page, k, &value))
            json_result_set(json, FIGURES[k].key, isfinite(value) ? json_real(value) : json_null());
    for (size_t i = 0; i < page->stations; i++)
        json_result_append(curve, json_pack("{s:f,s:f}", "x", page->x[i], "area", page->area[i]));
    json_result_set(json, "section_areas", curve);
    json_result_set(json, "note", json_string(page->note));
    const char *sentence;
    for (size_t k = 0; (sentence = igabem_hull_warning(hull, k)); k++)
        json_result_append(warnings, json_string(sentence));
    json_result_set(json, "warnings", warnings);
    return json_result_print(json, JSON_INDENT(1) | JSON_REAL_PRECISION(12));
}

static int print_table(const struct page *page)
{
    double value;
    printf("%s: %s\n\n", page->path, page->note);
    for (size_t k = 0; k < N_FIGURES; k++)
        if (figure_value(page, k, &value) && isfinite(value))
            printf("%-22s %14.7g %-7s %s\n", FIGURES[k].key, value, FIGURES[k].unit,
                   FIGURES[k].text);
    printf("\nsection areas, both sides\n%14s %14s\n", "x m", "m^2");
    for (size_t i = 0; i < page->stations; i++)
        printf("%14.7g %14.7g\n", page->x[i], page->area[i]);
    return cli_printed();
}

static int show(const struct request *request)
{
    struct hull_input input;
    struct page page = {0};
    int code = hull_input_read(&request->hull, &input);
    if (code != CLI_OK)
        return code;
    code = !fill_page(request, &input, &page) ? CLI_FAILED
           : request->json                    ? print_json(input.hull, &page)
                                              : print_table(&page);
    free(page.x);
    hull_input_free(&input);
    return code;
}

int command_hydrostatics(int argc, char **argv)
{
    struct request request = {.kg = NAN, .density = 1000.0, .stations = 21};
    hull_request_init(&request.hull);
    request.hull.simplify = 0.0;
    settings_start(&TABLE, &request);
    int code = settings_options(argc, argv, &TABLE, &request, NULL, NULL);
    if (code < 0)
        code = show(&request);
    settings_free(&TABLE, &request);
    return code;
}
