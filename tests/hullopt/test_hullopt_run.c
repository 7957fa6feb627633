/* The command from end to end on a small hull: every file of a run, the refusals, and the report.
 */
#include "check.h"
#include "runner.h"

#include <nurbs/nurbs.h>

#include <jansson.h>
#include <sys/stat.h>

static struct runner runner;
static char config[200], out[200];

static const char WIGLEY[] = EXAMPLES_DIR "/hulls/wigley.json";

static int exists(const char *name)
{
    char path[300];
    struct stat info;
    snprintf(path, sizeof path, "%s/%s", out, name);
    return stat(path, &info) == 0;
}

static json_t *read_json(const char *name)
{
    char path[300];
    snprintf(path, sizeof path, "%s/%s", out, name);
    return json_load_file(path, 0, NULL);
}

static double number(const json_t *object, const char *a, const char *b)
{
    const json_t *value = json_object_get(object, a);
    if (b)
        value = json_object_get(value, b);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

static void test_run(void)
{
    const char *const run[] = {"run", config, "--out", out, "--threads", "2", NULL};
    int code = runner_run(&runner, run);
    if (code != 0)
        fputs(runner.err, stderr);
    CU_ASSERT_EQUAL_FATAL(code, 0);
    CU_ASSERT_PTR_NOT_NULL(strstr(runner.out, "reduction"));
    CU_ASSERT_PTR_NOT_NULL(strstr(runner.out, "report.html"));
    CU_ASSERT_PTR_NOT_NULL(strstr(runner.err, "search: 100 %"));
}

static void test_summary(void)
{
    json_t *s = read_json("summary.json");
    CU_ASSERT_PTR_NOT_NULL_FATAL(s);
    double before = number(s, "baseline", "cw"), after = number(s, "best", "cw");
    CU_ASSERT_TRUE(before > 0 && after > 0 && after <= before);
    CHECK_CLOSE(number(s, "reduction_percent", NULL), 100 * (1 - after / before), 1e-9);
    CU_ASSERT_EQUAL(number(s, "evaluations", NULL), 13);
    CU_ASSERT_EQUAL(number(s, "initial_samples", NULL), 8);
    CU_ASSERT_TRUE(number(s, "modes", NULL) >= 1);
    CU_ASSERT_TRUE(number(s, "retained_variance", NULL) >= 0.95);
    CU_ASSERT_TRUE(number(s, "seconds", NULL) > 0);
    CU_ASSERT_TRUE(number(s, "seconds_per_evaluation", NULL) > 0);
    CU_ASSERT_TRUE(json_is_true(json_object_get(s, "complete")));
    const json_t *d = json_object_get(json_object_get(s, "constraints"), "displacement");
    CU_ASSERT_EQUAL(number(d, "allowed", NULL), 0.05);
    CU_ASSERT_TRUE(json_is_true(json_object_get(d, "satisfied")));
    CHECK_CLOSE(number(d, "change", NULL), number(d, "after", NULL) / number(d, "before", NULL) - 1,
                1e-12);
    CHECK_RELATIVE(number(d, "before", NULL), 4.0 / 9 * 0.1 * 0.0625, 5e-3);
    const json_t *rows = json_object_get(s, "verification");
    CU_ASSERT_EQUAL_FATAL(json_array_size(rows), 8); /* objective, six formulations, filter */
    CHECK_RELATIVE(number(json_array_get(rows, 0), "cw_after", NULL), after, 1e-12);
    CHECK_RELATIVE(number(json_array_get(rows, 0), "cw_before", NULL), before, 1e-12);
    CU_ASSERT_TRUE(json_is_string(json_object_get(json_object_get(s, "robust"), "statement")));
    CU_ASSERT_TRUE(json_is_boolean(json_object_get(json_object_get(s, "robust"), "filter")));
    /* the filter was frozen on the parent, whose own it is */
    CHECK_RELATIVE(number(json_array_get(rows, 7), "cw_before", NULL), before, 1e-12);
    json_decref(s);
}

static void test_hulls(void)
{
    static const char *const names[] = {"best.json", "best.igs", "best_wetted.json"};
    for (size_t k = 0; k < 3; k++) {
        char path[300];
        nurbs_patches *patches;
        snprintf(path, sizeof path, "%s/%s", out, names[k]);
        nurbs_status status = nurbs_patches_read(path, &patches);
        if (status != NURBS_OK)
            fprintf(stderr, "%s\n", nurbs_last_error());
        CU_ASSERT_EQUAL_FATAL(status, NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_patches_count(patches), 1);
        nurbs_patches_free(patches);
    }
}

static size_t count(const char *text, const char *word)
{
    size_t n = 0;
    for (const char *at = text; (at = strstr(at, word)) != NULL; at++)
        n++;
    return n;
}

/* Empties the raster pictures: any letters may stand in them. */
static void drop_pictures(char *text)
{
    static const char start[] = "base64,";
    for (char *at = text; (at = strstr(at, start)) != NULL;) {
        at += strlen(start);
        char *end = strchr(at, '"');
        if (end)
            memmove(at, end, strlen(end) + 1);
    }
}

/* One file: nothing is fetched from anywhere, and every drawing is closed. */
static void test_report(void)
{
    enum { ROOM = 4000000 };
    char path[300], *text = malloc(ROOM);
    CU_ASSERT_PTR_NOT_NULL_FATAL(text);
    snprintf(path, sizeof path, "%s/report.html", out);
    CU_ASSERT_TRUE(runner_read(path, text, ROOM) > 50000);
    drop_pictures(text);
    CU_ASSERT_TRUE(count(text, "<svg") >= 10);
    CU_ASSERT_EQUAL(count(text, "<svg"), count(text, "</svg>"));
    CU_ASSERT_EQUAL(count(text, "http"), count(text, "xmlns=\"http://www.w3.org/2000/svg\""));
    CU_ASSERT_EQUAL(count(text, "src="), 0);
    CU_ASSERT_EQUAL(count(text, "<link"), 0);
    CU_ASSERT_EQUAL(count(text, "<script"), 0);
    CU_ASSERT_EQUAL(count(text, "nan") + count(text, "inf\""), 0);
    CU_ASSERT_EQUAL(count(text, "<section>"), count(text, "</section>"));
    CU_ASSERT_EQUAL(count(text, "<table"), count(text, "</table>"));
    CU_ASSERT_EQUAL(count(text, "<figure"), count(text, "</figure>"));
    CU_ASSERT_PTR_NOT_NULL(strstr(text, "data:image/png;base64,"));
    free(text);
}

/* Report alone makes the same files again, and prints the summary as one JSON object. */
static void test_report_again(void)
{
    const char *const report[] = {"report", out, "--threads", "2", "--json", NULL};
    char path[300];
    json_t *before = read_json("summary.json");
    snprintf(path, sizeof path, "%s/report.html", out);
    unlink(path);
    snprintf(path, sizeof path, "%s/summary.json", out);
    unlink(path);
    CU_ASSERT_EQUAL_FATAL(runner_run(&runner, report), 0);
    CU_ASSERT_TRUE(exists("report.html"));
    json_t *after = read_json("summary.json"), *printed = json_loads(runner.out, 0, NULL);
    CU_ASSERT_PTR_NOT_NULL(printed);
    CU_ASSERT_TRUE(json_equal(before, after));
    CU_ASSERT_TRUE(json_equal(printed, after));
    json_decref(before);
    json_decref(after);
    json_decref(printed);
}

/* Of a run that may not be written the figures are printed, and the files go elsewhere. */
static void test_report_elsewhere(void)
{
    char elsewhere[200], path[300];
    json_t *whole = read_json("summary.json");
    runner_path(&runner, "elsewhere", elsewhere, sizeof elsewhere);
    snprintf(path, sizeof path, "%s/report.html", out);
    CU_ASSERT_EQUAL(unlink(path), 0);
    CU_ASSERT_EQUAL(chmod(out, 0500), 0);
    const char *const report[] = {"report",    out, "--out",  elsewhere,
                                  "--threads", "2", "--json", NULL};
    CU_ASSERT_EQUAL(runner_run(&runner, report), 0);
    json_t *printed = json_loads(runner.out, 0, NULL);
    CU_ASSERT_TRUE(json_equal(printed, whole));
    CU_ASSERT_FALSE(exists("report.html"));
    snprintf(path, sizeof path, "%s/report.html", elsewhere);
    CU_ASSERT_EQUAL(access(path, R_OK), 0);
    const char *const figures[] = {"report", out, NULL};
    CU_ASSERT_EQUAL(runner_run(&runner, figures), 0);
    CU_ASSERT_PTR_NOT_NULL(strstr(runner.out, "reduction"));
    if (geteuid() != 0) { /* root may write everywhere */
        CU_ASSERT_PTR_NOT_NULL(strstr(runner.err, "warning"));
        CU_ASSERT_FALSE(exists("report.html"));
    }
    CU_ASSERT_EQUAL(chmod(out, 0700), 0);
    json_decref(printed);
    json_decref(whole);
}

/* C_w at other speeds as a constraint: told to the search, kept by the best, and the same figures
 * as the verification's. */
static void test_speeds(void)
{
    char text[900], path[200], folder[200];
    snprintf(text, sizeof text,
             "hull: %s\nshape: " EXAMPLES_DIR "/wigley_shape.yaml\nflow: {froude: 0.316}\n"
             "grid: {sections: 21, girth: 9}\nlatent: {samples: 200}\n"
             "solver: {formulation: hogner, tolerance: 1e-3, surface_cells: 8}\n"
             "reconstruction: {tolerance: 1e-3}\nconstraints: {speeds: 1.02}\n"
             "search: {initial: 8, iterations: 5}\n"
             "verification: {refine: 1, froude: [0.27, 0.4]}\nwaves: {along: 6, across: 4}\n",
             WIGLEY);
    runner_write(&runner, "speeds.yaml", text);
    runner_path(&runner, "speeds.yaml", path, sizeof path);
    runner_path(&runner, "speeds", folder, sizeof folder);
    const char *const run[] = {"run", path, "--out", folder, "--json", NULL};
    CU_ASSERT_EQUAL_FATAL(runner_run(&runner, run), 0);
    json_t *s = json_loads(runner.out, 0, NULL);
    CU_ASSERT_PTR_NOT_NULL_FATAL(s);
    const json_t *limit = json_object_get(json_object_get(s, "constraints"), "speeds");
    CU_ASSERT_EQUAL(number(limit, "allowed", NULL), 1.02);
    CU_ASSERT_TRUE(json_is_true(json_object_get(limit, "satisfied")));
    CU_ASSERT_TRUE(number(limit, "largest_ratio", NULL) <= 1.02);
    const json_t *rows = json_object_get(s, "verification");
    const json_t *before = json_object_get(json_object_get(s, "baseline"), "cw_speeds");
    const json_t *after = json_object_get(json_object_get(s, "best"), "cw_speeds");
    CU_ASSERT_EQUAL_FATAL(json_array_size(before), 2);
    CU_ASSERT_EQUAL_FATAL(json_array_size(after), 2);
    for (size_t i = 0; i < 2; i++) {
        /* Each speed has rows of exterior and double-model behind it. */
        const json_t *row = json_array_get(rows, json_array_size(rows) - 6 + 3 * i);
        CHECK_RELATIVE(json_number_value(json_array_get(before, i)), number(row, "cw_before", NULL),
                       1e-10);
        CHECK_RELATIVE(json_number_value(json_array_get(after, i)), number(row, "cw_after", NULL),
                       1e-10);
    }
    json_decref(s);
}

/* Spearman's correlation of distinct values, by the squares of the differences of the ranks. */
static double rank_correlation(const json_t *a, const json_t *b)
{
    size_t n = json_array_size(a);
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        double difference = 0;
        for (size_t k = 0; k < n; k++) {
            difference +=
                json_number_value(json_array_get(a, k)) < json_number_value(json_array_get(a, i));
            difference -=
                json_number_value(json_array_get(b, k)) < json_number_value(json_array_get(b, i));
        }
        sum += difference * difference;
    }
    return 1 - 6 * sum / (double)(n * (n * n - 1));
}

/* How alike two formulations rank the designs, at each speed, in the summary and as pictures. */
static void test_agreement(void)
{
    char path[200], folder[200];
    runner_write(
        &runner, "agree.yaml",
        "hull: " EXAMPLES_DIR "/hulls/wigley.json\nshape: " EXAMPLES_DIR "/wigley_shape.yaml\n"
        "grid: {sections: 21, girth: 9}\nlatent: {samples: 200}\nflow: {froude: 0.316}\n"
        "solver: {formulation: hogner, tolerance: 1e-3}\nreconstruction: {tolerance: 1e-3}\n"
        "constraints: {speeds: 5}\nwaves: {along: 6, across: 4}\n"
        "search: {method: lhs, initial: 5, iterations: 4, models: [michell]}\n"
        "verification: {refine: 0, froude: [0.27]}\n");
    runner_path(&runner, "agree.yaml", path, sizeof path);
    runner_path(&runner, "agree", folder, sizeof folder);
    const char *const run[] = {"run", path, "--out", folder, "--json", NULL};
    CU_ASSERT_EQUAL_FATAL(runner_run(&runner, run), 0);
    json_t *s = json_loads(runner.out, 0, NULL);
    const json_t *rows = json_object_get(s, "agreement");
    CU_ASSERT_EQUAL_FATAL(json_array_size(rows), 2);
    CU_ASSERT_EQUAL(number(json_array_get(rows, 1), "fr", NULL), 0.27);
    for (size_t r = 0; r < 2; r++) {
        const json_t *row = json_array_get(rows, r),
                     *rank = json_object_get(row, "rank_correlation");
        const json_t *ratio = json_object_get(row, "cw_ratio");
        CU_ASSERT_EQUAL(number(row, "designs", NULL), 9);
        CHECK_CLOSE(json_number_value(json_array_get(json_array_get(rank, 0), 0)), 1, 1e-12);
        CHECK_CLOSE(json_number_value(json_array_get(json_array_get(rank, 0), 1)),
                    rank_correlation(json_array_get(ratio, 0), json_array_get(ratio, 1)), 1e-12);
    }
    json_decref(s);
    char report[220];
    snprintf(report, sizeof report, "%s/report.html", folder);
    static char page[2000000];
    runner_read(report, page, sizeof page);
    CU_ASSERT_EQUAL(count(page, "Designs by each formulation"), 2);
}

static void check_refusal(const char *const *arguments, int code, const char *part)
{
    int got = runner_run(&runner, arguments);
    CU_ASSERT_EQUAL(got, code);
    int sentence = strncmp(runner.err, "hullopt: ", 9) == 0 && count(runner.err, "\n") == 1 &&
                   strstr(runner.err, part) != NULL;
    if (!sentence || got != code)
        fprintf(stderr, "expected '%s' and %d, got %d and: %s\n", part, code, got, runner.err);
    CU_ASSERT_TRUE(sentence);
    CU_ASSERT_EQUAL(runner.out[0], '\0');
}

static void test_existing_run(void)
{
    const char *const run[] = {"run", config, "--out", out, NULL};
    check_refusal(run, 1, "holds a run already");
    const char *const changed[] = {"run",      config,         "--out", out,
                                   "--resume", "--iterations", "9",     NULL};
    check_refusal(changed, 1, "search.iterations = 9', then 'search.iterations = 5'");
    const char *const resume[] = {"run", config, "--out", out, "--resume", NULL};
    CU_ASSERT_EQUAL(runner_run(&runner, resume), 0);
    json_t *s = read_json("summary.json");
    CU_ASSERT_EQUAL(number(s, "evaluations", NULL), 13);
    CU_ASSERT_EQUAL(number(s, "sessions", NULL), 2);
    json_decref(s);
}

static void test_usage(void)
{
    const char *const nothing[] = {NULL}, *const unknown[] = {"walk", NULL};
    const char *const no_out[] = {"run", config, NULL}, *const option[] = {"report", "a", "--fast",
                                                                           NULL};
    const char *const threads[] = {"run", config, "--out", out, "--threads", "0", NULL};
    const char *const two[] = {"report", "a", "b", NULL};
    check_refusal(nothing, 2, "no command");
    check_refusal(unknown, 2, "unknown command 'walk'");
    check_refusal(no_out, 2, "--out");
    check_refusal(option, 2, "--fast");
    check_refusal(threads, 2, "--threads");
    check_refusal(two, 2, "a word too many");
    const char *const help[] = {"--help", NULL}, *const version[] = {"--version", NULL};
    CU_ASSERT_EQUAL(runner_run(&runner, help), 0);
    CU_ASSERT_PTR_NOT_NULL(strstr(runner.out, "--resume"));
    CU_ASSERT_EQUAL(runner_run(&runner, version), 0);
    CU_ASSERT_EQUAL(strncmp(runner.out, "hullopt ", 8), 0);
}

/* Each of these runs is refused with one sentence and leaves no folder behind. */
static void check_bad(const char *hull, const char *extra, const char *part)
{
    char bad[200], fresh[200];
    struct stat info;
    runner_configuration(&runner, "bad.yaml", hull, 8, 5, extra);
    runner_path(&runner, "bad.yaml", bad, sizeof bad);
    runner_path(&runner, "fresh", fresh, sizeof fresh);
    const char *const run[] = {"run", bad, "--out", fresh, NULL};
    check_refusal(run, 1, part);
    CU_ASSERT_NOT_EQUAL(stat(fresh, &info), 0);
}

static void write_moved_wigley(const char *path, double dz, double fold)
{
    nurbs_surface *hull, *moved;
    nurbs_patches *patches;
    const double shift[3] = {0, 0, dz};
    /* A map that is not one-to-one along the hull folds it. */
    const double shear[9] = {1, fold, 0, 0, 1, 0, 0, 0, 1};
    CU_ASSERT_EQUAL(nurbs_make_wigley(1, 0.1, 0.0625, &hull), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_transform(hull, shear, shift, &moved), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_create(&patches), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_add(patches, moved), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_write(patches, path), NURBS_OK);
    nurbs_patches_free(patches);
    nurbs_surface_free(hull);
    nurbs_surface_free(moved);
}

static void test_bad_hulls(void)
{
    char path[200];
    check_bad("/nonexistent/hull.json", "", "hull is");
    runner_write(&runner, "broken.json", "{\"format\":\"nurbs\",");
    runner_path(&runner, "broken.json", path, sizeof path);
    check_bad(path, "", "broken.json");
    runner_path(&runner, "high.json", path, sizeof path);
    write_moved_wigley(path, 0.2, 0);
    check_bad(path, "", "high.json");
    runner_path(&runner, "folded.json", path, sizeof path);
    write_moved_wigley(path, 0, 40);
    check_bad(path, "", "folded.json");
}

static void test_bad_settings(void)
{
    char bad[200], fresh[200];
    runner_path(&runner, "bad.yaml", bad, sizeof bad);
    runner_path(&runner, "fresh", fresh, sizeof fresh);
    const char *const run[] = {"run", bad, "--out", fresh, NULL};
    runner_write(&runner, "bad.yaml", "hull: x\nshape: y\nflow: {froude: 0}\n");
    CU_ASSERT_EQUAL(runner_run(&runner, run), 1);
    CU_ASSERT_TRUE(strstr(runner.err, ":1: hull is 'x'") &&
                   strstr(runner.err, ":2: shape is 'y'") &&
                   strstr(runner.err, ":3: flow.froude is '0'"));
    check_bad(WIGLEY, "colour: red\n", "colour is no setting");
    char text[500];
    snprintf(text, sizeof text,
             "hull: %s\nshape: " EXAMPLES_DIR "/wigley_shape.yaml\nflow: {froude: 0.3}\n", WIGLEY);
    runner_write(&runner, "bad.yaml", text);
    check_refusal(run, 1, "grid.sections is missing");
    snprintf(text, sizeof text,
             "hull: %s\nshape: " EXAMPLES_DIR "/wigley_shape.yaml\nflow: {froude: 0.3}\n"
             "grid: {sections: 21, girth: 9}\nsolver: {formulation: hogner}\n"
             "constraints: {pressure: 1}\n",
             WIGLEY);
    runner_write(&runner, "bad.yaml", text);
    check_refusal(run, 1, "constraints.pressure needs a resistance by pressure");
    snprintf(text, sizeof text,
             "hull: %s\nshape: " EXAMPLES_DIR "/wigley_shape.yaml\nflow: {froude: 0.3}\n"
             "grid: {sections: 21, girth: 9}\nsolver: {formulation: neumann-kelvin-stern}\n",
             WIGLEY);
    runner_write(&runner, "bad.yaml", text);
    check_refusal(run, 1, "has no immersed transom");
    const char *const missing[] = {"run", "/nonexistent.yaml", "--out", fresh, NULL};
    check_refusal(missing, 1, "/nonexistent.yaml: No such file");
}

/* A template is read back; a check tells what a run would do and writes nothing. */
static void test_init_and_check(void)
{
    char written[200];
    runner_path(&runner, "template.yaml", written, sizeof written);
    const char *const init[] = {
        "init", WIGLEY, EXAMPLES_DIR "/wigley_shape.yaml", "--fr", "0.3", "-o", written, NULL};
    CU_ASSERT_EQUAL(runner_run(&runner, init), 0);
    check_refusal(init, 1, "exists");
    const char *const template[] = {"check", written, NULL};
    check_refusal(template, 1, "grid.sections is missing");
    const char *const print[] = {"init", NULL};
    CU_ASSERT_EQUAL(runner_run(&runner, print), 0);
    CU_ASSERT_PTR_NOT_NULL(strstr(runner.out, "\n  # U/sqrt(g L); a number between 0 and 10"));
    CU_ASSERT_PTR_NOT_NULL(strstr(runner.out, "\n  froude: \n"));
    runner_configuration(&runner, "plan.yaml", WIGLEY, 8, 5, "");
    runner_path(&runner, "plan.yaml", written, sizeof written);
    CU_ASSERT_EQUAL(runner_run(&runner, template), 0);
    CU_ASSERT_PTR_NOT_NULL(strstr(runner.out, "displacement: ±5 %"));
    CU_ASSERT_PTR_NOT_NULL(strstr(runner.out, "bayesian, at most 14 designs"));
    const char *const json[] = {"check", written, "--json", NULL};
    CU_ASSERT_EQUAL(runner_run(&runner, json), 0);
    json_t *plan = json_loads(runner.out, 0, NULL);
    CU_ASSERT_EQUAL(json_integer_value(json_object_get(plan, "evaluations")), 14);
    CU_ASSERT_EQUAL(json_integer_value(json_object_get(plan, "parameters")), 6);
    CU_ASSERT_TRUE(json_real_value(json_object_get(plan, "cw")) > 0);
    CU_ASSERT_TRUE(json_is_array(json_object_get(plan, "warnings")));
    json_decref(plan);
}

static void test_bad_folders(void)
{
    const char *const file[] = {"run", config, "--out", config, NULL};
    check_refusal(file, 1, config);
    const char *const device[] = {"run", config, "--out", "/dev/null/run", NULL};
    check_refusal(device, 1, "/dev/null/run");
    const char *const report[] = {"report", "/nonexistent", NULL};
    check_refusal(report, 1, "no such file");
}

static void test_damaged_database(void)
{
    char folder[200], path[300];
    runner_path(&runner, "damaged", folder, sizeof folder);
    CU_ASSERT_EQUAL(mkdir(folder, 0700), 0);
    snprintf(path, sizeof path, "%s/run.db", folder);
    FILE *file = fopen(path, "w");
    for (int k = 0; k < 1000; k++)
        fputs("no database at all\n", file);
    fclose(file);
    const char *const resume[] = {"run", config, "--out", folder, "--resume", NULL};
    check_refusal(resume, 1, "run.db");
    const char *const report[] = {"report", folder, NULL};
    check_refusal(report, 1, "run.db");
    char text[100];
    CU_ASSERT_EQUAL(runner_read(path, text, sizeof text), sizeof text - 1);
    CU_ASSERT_EQUAL(strncmp(text, "no database", 11), 0);
}

/* Every design of the budget once, however many are at work; not where one waits for the other. */
static void test_jobs(void)
{
    char written[200], folder[200];
    runner_configuration(&runner, "jobs.yaml", WIGLEY, 8, 5, "");
    runner_path(&runner, "jobs.yaml", written, sizeof written);
    runner_path(&runner, "jobs", folder, sizeof folder);
    const char *const run[] = {"run", written, "--out", folder, "--jobs", "3", "--json", NULL};
    CU_ASSERT_EQUAL(runner_run(&runner, run), 0);
    json_t *summary = json_loads(runner.out, 0, NULL);
    CU_ASSERT_EQUAL(json_integer_value(json_object_get(summary, "evaluations")), 13);
    CU_ASSERT_EQUAL(json_integer_value(json_object_get(summary, "failed_designs")), 0);
    json_decref(summary);
    runner_path(&runner, "methods.yaml", written, sizeof written);
    runner_path(&runner, "alone", folder, sizeof folder);
    runner_write(&runner, "methods.yaml",
                 "hull: " EXAMPLES_DIR "/hulls/wigley.json\nshape: " EXAMPLES_DIR
                 "/wigley_shape.yaml\n"
                 "grid: {sections: 21, girth: 9}\nlatent: {samples: 200}\n"
                 "flow: {froude: 0.316}\nsolver: {formulation: hogner, tolerance: 1e-3}\n"
                 "search: {method: cobyla, iterations: 3}\n");
    check_refusal(run, 1, "--jobs 3: cobyla needs the value of each design before the next");
}

static const struct check_case cases[] = {
    {"a whole run", test_run},
    {"several designs at once", test_jobs},
    {"summary", test_summary},
    {"hull files", test_hulls},
    {"report", test_report},
    {"report again", test_report_again},
    {"report elsewhere", test_report_elsewhere},
    {"other speeds bounded", test_speeds},
    {"how alike models rank", test_agreement},
    {"a folder that holds a run", test_existing_run},
    {"usage", test_usage},
    {"bad hulls", test_bad_hulls},
    {"bad settings", test_bad_settings},
    {"init and check", test_init_and_check},
    {"bad folders", test_bad_folders},
    {"damaged database", test_damaged_database},
};

int main(void)
{
    if (!runner_open(&runner))
        return EXIT_FAILURE;
    runner_path(&runner, "run.yaml", config, sizeof config);
    runner_path(&runner, "out", out, sizeof out);
    runner_configuration(&runner, "run.yaml", WIGLEY, 8, 5, "");
    int code = check_main("hullopt run", cases, sizeof cases / sizeof *cases);
    return runner_close(&runner) == 0 ? code : EXIT_FAILURE;
}
