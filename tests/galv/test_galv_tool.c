/* The galv command as its users meet it. */
#include "check.h"
#include "run_tool.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

enum { SECTIONS = 13, GIRTH = 7 };

static const char shape_text[] = "combination: recursive\n"
                                 "direction: y\n"
                                 "bounds: [-0.02, 0.02]\n"
                                 "functions:\n"
                                 "  - {order: [1, 1, 1], phase: [0, 0, 1.5707963267948966]}\n"
                                 "  - {order: [2, 1, 1]}\n"
                                 "  - {order: [1, 2, 1], bounds: [-0.01, 0.01]}\n"
                                 "  - {order: [2, 2, 1], direction: y}\n";

static void write_inputs(void)
{
    FILE *stream = fopen(scratch("hull.csv"), "w");
    fputs("# a Wigley half hull\ni,j,x,y,z\n", stream);
    for (int i = 0; i < SECTIONS; i++)
        for (int j = 0; j < GIRTH; j++) {
            double s = i / (SECTIONS - 1.0), t = j / (GIRTH - 1.0);
            fprintf(stream, "%d,%d,%.17g,%.17g,%.17g\n", i + 1, j + 1, 6 * s,
                    1.6 * s * (1 - s) * (1 - t * t), -0.3 * t);
        }
    fclose(stream);
    scratch_write("shape.yaml", shape_text);
}

static const char *const reduce = "reduce --hull hull.csv --shape shape.yaml --random 500 --seed 3 "
                                  "--variance 0.9999 -o model.h5 --json";

static double number(json_t *root, const char *name)
{
    json_t *value = json_object_get(root, name);
    CU_ASSERT_TRUE(json_is_number(value));
    return json_number_value(value);
}

/* Exit code, and the words that must be on standard error. */
static void expect(const char *arguments, int code, const char *words)
{
    struct run run = run_tool(arguments);
    if (run.code != code || (words && !strstr(run.errors, words)))
        fprintf(stderr, "galv %s: exit %d, said: %s\n", arguments, run.code, run.errors);
    CU_ASSERT_EQUAL(run.code, code);
    CU_ASSERT_TRUE(!words || strstr(run.errors, words));
    CU_ASSERT_TRUE(code == 0 || *run.output == '\0');
    run_free(&run);
}

static void test_reduce_prints_json(void)
{
    write_inputs();
    json_t *root = run_json(reduce);
    size_t modes = (size_t)number(root, "modes");
    json_t *values = json_object_get(root, "eigenvalues"), *mse = json_object_get(root, "mse");
    double sum = 0, trace = number(root, "trace");
    CU_ASSERT_EQUAL(number(root, "samples"), 500);
    CU_ASSERT_EQUAL(number(root, "elements"), SECTIONS * GIRTH);
    CU_ASSERT_EQUAL(number(root, "parameters"), 4);
    CU_ASSERT_EQUAL(json_array_size(values), json_array_size(mse));
    CU_ASSERT_TRUE_FATAL(modes >= 1 && json_array_size(values) >= modes);
    for (size_t k = 0; k < json_array_size(values); k++) {
        sum += json_number_value(json_array_get(values, k));
        CHECK_CLOSE(json_number_value(json_array_get(mse, k)), trace - sum, 1e-12 * trace);
        if (k + 1 == modes)
            CHECK_CLOSE(number(root, "retained"), sum / trace, 1e-12);
    }
    CU_ASSERT_TRUE(number(root, "retained") >= 0.9999);
    json_decref(root);
}

/* The same run with samples from a file: uniform draws of a run printed by `project` stay the same.
 */
static void test_reduce_from_samples(void)
{
    write_inputs();
    FILE *stream = fopen(scratch("x.csv"), "w");
    fputs("x1,x2,x3,x4\n", stream);
    for (int r = 0; r < 60; r++)
        fprintf(stream, "%.17g,%.17g,%.17g,%.17g\n", 0.02 * sin(r), 0.02 * cos(2 * r),
                0.01 * sin(3 * r + 1), 0.02 * sin(5 * r + 2));
    fclose(stream);
    json_t *root = run_json("reduce --hull hull.csv --shape shape.yaml --samples x.csv --modes 3 "
                            "--centre --weights area --method gram --spectrum 5 --json");
    CU_ASSERT_EQUAL(number(root, "samples"), 60);
    CU_ASSERT_EQUAL(number(root, "modes"), 3);
    CU_ASSERT_STRING_EQUAL(json_string_value(json_object_get(root, "method")), "gram");
    json_decref(root);
    scratch_write("short.csv", "x1,x2\n0,0\n");
    expect("reduce --hull hull.csv --shape shape.yaml --samples short.csv", 1, "x1 to x4");
    scratch_write("nan.csv", "a,b,c,d\n0,0,0,0\n0,nan,0,0\n");
    expect("reduce --hull hull.csv --shape shape.yaml --samples nan.csv", 1, "nan.csv:3");
}

/* A file of samples without a header keeps its first one, and a byte order mark is no part of a
 * name. */
static void test_first_lines(void)
{
    static const char rows[] = "0.01,0,0,0.01\n0,0.02,0.01,0\n0,-0.01,0.005,0.02\n";
    char text[200];
    write_inputs();
    scratch_write("bare.csv", rows);
    snprintf(text, sizeof text, "x1,x2,x3,x4\n%s", rows);
    scratch_write("named.csv", text);
    snprintf(text, sizeof text, "\xEF\xBB\xBFx1,x2,x3,x4\n%s", rows);
    scratch_write("marked.csv", text);
    snprintf(text, sizeof text, "\xEF\xBB\xBF%s", rows);
    scratch_write("both.csv", text);
    static const char *const names[] = {"named", "bare", "marked", "both"};
    json_t *first = NULL;
    for (size_t i = 0; i < 4; i++) {
        snprintf(text, sizeof text,
                 "reduce --hull hull.csv --shape shape.yaml --samples %s.csv --json", names[i]);
        json_t *root = run_json(text);
        CU_ASSERT_EQUAL(number(root, "samples"), 3);
        if (i == 0)
            first = json_incref(json_object_get(root, "eigenvalues"));
        CU_ASSERT_TRUE(json_equal(json_object_get(root, "eigenvalues"), first));
        CU_ASSERT_EQUAL(json_array_size(json_object_get(root, "warnings")), 0);
        json_decref(root);
    }
    json_decref(first);
    scratch_write("bare_hull.csv", "1,1,0,0.1,-0.3\n1,2,0,0.1,0.1\n");
    expect("reduce --hull bare_hull.csv --shape shape.yaml --random 9", 1, "columns x, y and z");
}

/* Parameters outside of their bounds are taken, and said. */
static void test_outside_bounds(void)
{
    write_inputs();
    json_decref(run_json(reduce));
    scratch_write("wide.csv", "x1,x2,x3,x4\n0.01,0,0,0\n0,0.5,0.02,0\n");
    static const char *const commands[] = {
        "reduce --hull hull.csv --shape shape.yaml --samples wide.csv --json",
        "extend model.h5 --samples wide.csv --json",
        "project model.h5 --parameters wide.csv --json",
        "reconstruct model.h5 --parameters 0,0.5,0.02 --json",
    };
    for (size_t i = 0; i < 4; i++) {
        struct run run = run_tool(commands[i]);
        CU_ASSERT_EQUAL(run.code, 0);
        CU_ASSERT_PTR_NOT_NULL(strstr(run.errors, "2 parameters lie outside of their bounds"));
        CU_ASSERT_PTR_NOT_NULL(strstr(run.errors, "x2 is 0.5"));
        json_t *root = json_loads(run.output, 0, NULL);
        CU_ASSERT_EQUAL(json_array_size(json_object_get(root, "warnings")), 1);
        json_decref(root);
        run_free(&run);
    }
    expect("project model.h5 --parameters 0.02,-0.02,0.01,0.02", 0, NULL);
}

static void test_bad_grids(void)
{
    static const char *const bad[] = {"-1", "4e9", "1.5"};
    char text[200];
    write_inputs();
    for (size_t i = 0; i < 3; i++) {
        snprintf(text, sizeof text, "i,j,x,y,z\n1,1,0,0.1,-0.3\n%s,2,0,0.1,0.1\n", bad[i]);
        scratch_write("bad.csv", text);
        expect("reduce --hull bad.csv --shape shape.yaml --random 9", 1, "bad.csv:3: i is");
        snprintf(text, sizeof text, "i,j,x,y,z\n1,1,0,0.1,-0.3\n1,%s,0,0.1,0.1\n", bad[i]);
        scratch_write("bad.csv", text);
        expect("reduce --hull bad.csv --shape shape.yaml --random 9", 1, "bad.csv:3: j is");
    }
}

static void test_model_round_trip(void)
{
    write_inputs();
    json_t *reduced = run_json(reduce), *info = run_json("info model.h5 --json");
    CHECK_CLOSE(number(info, "trace"), number(reduced, "trace"), 0);
    CHECK_CLOSE(number(info, "retained"), number(reduced, "retained"), 0);
    CU_ASSERT_TRUE(
        json_equal(json_object_get(info, "eigenvalues"), json_object_get(reduced, "eigenvalues")));
    CU_ASSERT_TRUE(json_equal(json_object_get(info, "latent_upper"),
                              json_object_get(reduced, "latent_upper")));
    json_decref(info);
    json_decref(reduced);
    expect("info model.h5", 0, NULL);
}

/* Parameters -> latent -> parameters, and latent -> hull -> latent. */
static void test_there_and_back(void)
{
    write_inputs();
    json_decref(run_json(reduce));
    scratch_write("p.csv", "x1,x2,x3,x4\n0.01,-0.004,0.002,0.013\n");
    json_t *projected = run_json("project model.h5 --parameters p.csv --json");
    json_t *row = json_array_get(json_object_get(projected, "rows"), 0);
    char u[256] = "", command[512];
    for (int k = 1; k <= 20; k++) {
        char name[8];
        snprintf(name, sizeof name, "u%d", k);
        json_t *value = json_object_get(row, name);
        if (value)
            snprintf(u + strlen(u), sizeof u - strlen(u), "%s%.17g", k > 1 ? "," : "",
                     json_number_value(value));
    }
    CU_ASSERT_TRUE(number(row, "distance") < 1e-3);
    snprintf(command, sizeof command, "backmap model.h5 --latent=%s --json", u);
    json_t *mapped = run_json(command);
    json_t *x = json_array_get(json_object_get(mapped, "rows"), 0);
    const double expected[] = {0.01, -0.004, 0.002, 0.013};
    for (int i = 0; i < 4; i++) {
        char name[8];
        snprintf(name, sizeof name, "x%d", i + 1);
        CHECK_CLOSE(number(x, name), expected[i], 1e-3);
    }
    snprintf(command, sizeof command, "reconstruct model.h5 --latent=%s -o moved.csv", u);
    expect(command, 0, NULL);
    json_t *again = run_json("project model.h5 --hull moved.csv --json");
    json_t *back = json_array_get(json_object_get(again, "rows"), 0);
    CHECK_CLOSE(number(back, "u1"), number(row, "u1"), 1e-14);
    CHECK_CLOSE(number(back, "distance"), 0, 1e-14);
    json_decref(projected);
    json_decref(mapped);
    json_decref(again);
}

/* 500 samples and 300 more from the same stream against 800 at once; then samples of other origin.
 */
static void test_extend(void)
{
    write_inputs();
    json_t *before = run_json(reduce);
    json_t *grown = run_json("extend model.h5 --random 300 --variance 0.9999 -o grown.h5 --json");
    json_t *whole = run_json("reduce --hull hull.csv --shape shape.yaml --random 800 --seed 3 "
                             "--variance 0.9999 --json");
    CU_ASSERT_EQUAL(number(grown, "samples"), 800);
    CU_ASSERT_EQUAL(number(grown, "samples_before"), 500);
    CU_ASSERT_EQUAL(number(grown, "modes"), number(whole, "modes"));
    CHECK_RELATIVE(number(grown, "trace"), number(whole, "trace"), 1e-12);
    CHECK_CLOSE(number(grown, "trace_before"), number(before, "trace"), 0);
    json_t *values = json_object_get(grown, "eigenvalues");
    json_t *exact = json_object_get(whole, "eigenvalues");
    for (size_t k = 0; k < (size_t)number(grown, "modes"); k++) {
        double lost = json_number_value(json_array_get(exact, k)) -
                      json_number_value(json_array_get(values, k));
        CU_ASSERT_TRUE(lost >= -1e-12 * number(whole, "trace"));
        CU_ASSERT_TRUE(lost <= number(grown, "truncation") + 1e-12 * number(whole, "trace"));
    }
    CU_ASSERT_TRUE(number(grown, "subspace_angle") > 0);
    json_t *info = run_json("info grown.h5 --json");
    CHECK_CLOSE(number(info, "truncation"), number(grown, "truncation"), 0);
    CU_ASSERT_EQUAL(number(info, "seed"), 3);
    json_decref(info);
    /* Another seed, then a file: no longer one stream. */
    expect("extend grown.h5 --random 50 --seed 4 -o mixed.h5", 0, NULL);
    info = run_json("info mixed.h5 --json");
    CU_ASSERT_TRUE(json_is_null(json_object_get(info, "seed")));
    CU_ASSERT_EQUAL(number(info, "samples"), 850);
    scratch_write("more.csv", "x1,x2,x3,x4\n0.01,0,0,0\n0,0.01,0.001,0\n");
    json_t *mixed = run_json("extend mixed.h5 --samples more.csv --modes 2 --json");
    CU_ASSERT_EQUAL(number(mixed, "samples"), 852);
    CU_ASSERT_EQUAL(number(mixed, "modes"), 2);
    expect("extend model.h5", 2, "--random");
    expect("extend model.h5 --random 5 --samples more.csv", 2, "--random");
    expect("extend model.h5 --random 5 --variance 0", 2, "--variance");
    expect("info model.h5 --random 5", 2, "there is no option '--random'");
    json_decref(before);
    json_decref(grown);
    json_decref(whole);
    json_decref(info);
    json_decref(mixed);
}

static void test_moments_and_lattice(void)
{
    write_inputs();
    json_t *root = run_json("reduce --hull hull.csv --shape shape.yaml --random 300 --moments 1 "
                            "--moment-share 0.2 -o moments.h5 --json");
    CU_ASSERT_EQUAL(number(root, "coordinates"), 3 * SECTIONS * GIRTH + 4);
    CU_ASSERT_TRUE(number(root, "retained_geometry") != number(root, "retained"));
    json_decref(root);
    FILE *stream = fopen(scratch("q.csv"), "w");
    fputs("resistance,cost\n", stream);
    for (int r = 0; r < 300; r++)
        fprintf(stream, "%.17g,%.17g\n", sin(r), cos(3 * r));
    fclose(stream);
    root = run_json("reduce --hull hull.csv --shape shape.yaml --random 300 --moments 1 "
                    "--section-moments 1:4:6 --rows q.csv --variance 0.9999 -o rows.h5 --json");
    CU_ASSERT_EQUAL(number(root, "coordinates"), 3 * SECTIONS * GIRTH + 4 + 2 * 3 + 2);
    CU_ASSERT_TRUE(number(root, "retained_geometry") > 0.9);
    json_decref(root);
    root = run_json("info rows.h5 --json");
    CU_ASSERT_EQUAL(number(root, "coordinates"), 3 * SECTIONS * GIRTH + 4 + 2 * 3 + 2);
    json_decref(root);
    expect("reconstruct rows.h5 --latent 0.01 -o moved.csv", 0, NULL);
    expect("project rows.h5 --hull moved.csv", 1, "known for samples only");
    expect("reduce --hull hull.csv --shape shape.yaml --random 30 --rows q.csv", 1, "30 samples");
    expect("reduce --hull hull.csv --shape shape.yaml --random 30 --section-moments 1:20:5", 1,
           "section 20");
    expect("reduce --hull hull.csv --shape shape.yaml --random 30 --section-moments 1:2", 2,
           "3 whole numbers");
    expect("reduce --hull hull.csv --shape shape.yaml --random 30 --section-moments 1:2:3:4:5", 2,
           "3 whole numbers");
    scratch_write("p.csv", "0.01,0,0,0\n0.01,0,0,0\n");
    root = run_json("project moments.h5 --parameters 0.01,0.002 --json");
    json_decref(root);
    scratch_write("lattice.yaml", "bounds: [-0.02, 0.02]\n"
                                  "lattice:\n"
                                  "  count: [5, 3, 3]\n"
                                  "  first: [1, 1, 0]\n"
                                  "  last: [3, 2, 2]\n"
                                  "  directions: [y, z]\n");
    root = run_json("reduce --hull hull.csv --shape lattice.yaml --random 300 -o l.h5 --json");
    CU_ASSERT_EQUAL(number(root, "parameters"), 3 * 2 * 3 * 2);
    CU_ASSERT_STRING_EQUAL(json_string_value(json_object_get(root, "method")), "factored");
    json_decref(root);
    root = run_json("backmap l.h5 --latent 0.01 --json");
    CU_ASSERT_TRUE(number(json_array_get(json_object_get(root, "rows"), 0), "residual") < 1e-3);
    json_decref(root);
}

/* The control points of the Wigley hull, 3 x 3 of degree 2, are moved by Bernstein polynomials. */
static void test_control_points(void)
{
    static const double x[5] = {0.01, -0.004, 0.003, 0.02, -0.006};
    enum { ROWS = 7, COLUMNS = 4 };
    scratch_write("net.yaml", "bounds: [-0.02, 0.02]\n"
                              "control_points:\n"
                              "  moved:\n"
                              "    - {first: [1, 0], last: [1, 1], directions: [y, z]}\n"
                              "    - {first: [0, 0], last: [2, 1], directions: [x], "
                              "together: true, bounds: [-0.1, 0.1]}\n");
    json_t *root = run_json("reduce --hull " EXAMPLES_DIR "/hulls/wigley.json --grid 7x4 "
                            "--shape net.yaml --random 50 -o net.h5 --json");
    CU_ASSERT_EQUAL(number(root, "parameters"), 5);
    CU_ASSERT_STRING_EQUAL(json_string_value(json_object_get(root, "method")), "factored");
    json_decref(root);
    root = run_json("info net.h5 --json");
    CU_ASSERT_STRING_EQUAL(json_string_value(json_object_get(root, "shape")), "control points");
    json_decref(root);
    expect("reconstruct net.h5 --parameters 0.01,-0.004,0.003,0.02,-0.006 -o moved.csv", 0, NULL);
    FILE *stream = fopen(scratch("moved.csv"), "r");
    CU_ASSERT_PTR_NOT_NULL_FATAL(stream);
    CU_ASSERT_EQUAL(fscanf(stream, "i,j,x,y,z"), 0);
    for (int r = 0; r < ROWS * COLUMNS; r++) {
        double u = r / COLUMNS / (ROWS - 1.0), v = r % COLUMNS / (COLUMNS - 1.0), p[3];
        double middle = 2 * u * (1 - u), top = (1 - v) * (1 - v), below = 2 * v * (1 - v);
        CU_ASSERT_EQUAL_FATAL(fscanf(stream, "%*d,%*d,%lf,%lf,%lf", &p[0], &p[1], &p[2]), 3);
        CHECK_CLOSE(p[0], u - 0.5 + x[4] * (top + below), 1e-15);
        CHECK_CLOSE(p[1], 0.2 * u * (1 - u) * (1 - v * v) + middle * (x[0] * top + x[2] * below),
                    1e-15);
        CHECK_CLOSE(p[2], -0.0625 * v + middle * (x[1] * top + x[3] * below), 1e-15);
    }
    fclose(stream);
    /* A spline of more points over the hull holds what the fewer ones can do. */
    scratch_write("fine.yaml", "bounds: [-0.02, 0.02]\n"
                               "control_points:\n"
                               "  count: [6, 5]\n"
                               "  moved:\n"
                               "    - {first: [0, 0], last: [5, 4], directions: [x, y, z]}\n");
    root = run_json("reduce --hull " EXAMPLES_DIR "/hulls/wigley.json --grid 21x13 "
                    "--shape fine.yaml --random 200 --modes 90 -o fine.h5 --json");
    CU_ASSERT_EQUAL(number(root, "parameters"), 90);
    json_decref(root);
    json_decref(run_json("reduce --hull " EXAMPLES_DIR "/hulls/wigley.json --grid 21x13 "
                         "--shape net.yaml --random 50 -o net.h5 --json"));
    expect("reconstruct net.h5 --parameters 0.01,-0.004,0.003,0.02,-0.006 -o moved.csv", 0, NULL);
    root = run_json("project fine.h5 --hull moved.csv --json");
    CHECK_CLOSE(number(json_array_get(json_object_get(root, "rows"), 0), "distance"), 0, 1e-12);
    json_decref(root);
    /* and not the other way round */
    expect("reconstruct fine.h5 --parameters 0.02 -o moved.csv", 0, NULL);
    root = run_json("project net.h5 --hull moved.csv --json");
    CU_ASSERT_TRUE(number(json_array_get(json_object_get(root, "rows"), 0), "distance") > 1e-4);
    json_decref(root);
}

static void test_bad_control_points(void)
{
    static const struct {
        const char *text, *words;
    } bad[] = {
        {"  moved:\n    - {first: [0, 0], last: [3, 0]}\n",
         "bad.yaml:3: control_points.moved in entry 1 along u"},
        {"  moved:\n    - {first: [0, 2], last: [0, 1]}\n", "along v"},
        {"  moved:\n    - {last: [0, 1]}\n", "first is missing"},
        {"  degree: [2, 2]\n  moved:\n    - {first: [0, 0], last: [1, 1]}\n", "without count"},
        {"  count: [4, 4]\n  degree: [4, 2]\n  moved:\n    - {first: [0, 0], last: [1, 1]}\n",
         "4 of 4 points"},
        {"  count: [4, 4]\n", "no list 'moved'"},
        {"  moved:\n    - {first: [0, 0], last: [1, 1], directions: [w]}\n", "'w'"},
        {"  moved:\n    - {first: [0, 0], last: [1, 1], bounds: [1, 0]}\n", "1 and 0"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char text[300];
        snprintf(text, sizeof text, "bounds: [0, 1]\ncontrol_points:\n%s", bad[i].text);
        scratch_write("bad.yaml", text);
        expect("reduce --hull " EXAMPLES_DIR "/hulls/wigley.json --grid 7x4 --shape bad.yaml "
               "--random 5",
               1, bad[i].words);
    }
    scratch_write("bad.yaml", "control_points:\n  moved:\n    - {first: [0, 0], last: [1, 1]}\n");
    expect("reduce --hull " EXAMPLES_DIR
           "/hulls/wigley.json --grid 7x4 --shape bad.yaml --random 5",
           1, "no bounds in entry 1");
}

static void expect_svg(const char *name, const char *holds)
{
    FILE *stream = fopen(scratch(name), "r");
    CU_ASSERT_PTR_NOT_NULL_FATAL(stream);
    static char text[4 << 20];
    size_t length = fread(text, 1, sizeof text - 1, stream);
    text[length] = '\0';
    fclose(stream);
    CU_ASSERT_PTR_NOT_NULL(strstr(text, "</svg>"));
    CU_ASSERT_PTR_NOT_NULL(strstr(text, holds));
    CU_ASSERT_PTR_NULL(strstr(text, "nan"));
}

static void test_drawings(void)
{
    write_inputs();
    json_decref(run_json(reduce));
    expect("plot model.h5 -o plot.svg --modes 2", 0, NULL);
    expect_svg("plot.svg", "Mode 2: ");
    expect_svg("plot.svg", ">rms, mm</text>");
    expect("plot model.h5 -o plot.pdf", 0, NULL);
    expect("plot model.h5 -o plot.txt", 2, ".svg, .png or .pdf");
    expect("animate model.h5 -o strip.svg --modes 2 --frames 3 --scale 2", 0, NULL);
    expect_svg("strip.svg", "<animate");
    json_t *root = run_json("plot model.h5 -o again.svg --json");
    CU_ASSERT_STRING_EQUAL(json_string_value(json_object_get(root, "file")), "again.svg");
    json_decref(root);
    root = run_json("animate model.h5 -o strip.svg --modes 2 --json");
    CU_ASSERT_EQUAL(number(root, "modes"), 2);
    json_decref(root);
    root = run_json("reconstruct model.h5 --latent 0.01 --json");
    CU_ASSERT_EQUAL(json_array_size(json_object_get(root, "points")), SECTIONS * GIRTH);
    CU_ASSERT_TRUE(number(root, "radius") > 0);
    json_decref(root);
    root = run_json("reconstruct model.h5 --latent 0.01 -o moved.csv --json");
    CU_ASSERT_STRING_EQUAL(json_string_value(json_object_get(root, "file")), "moved.csv");
    CU_ASSERT_PTR_NULL(json_object_get(root, "points"));
    json_decref(root);
    expect("plot model.h5", 2, "--output");
    expect("plot model.h5 -o no/such/folder/plot.svg", 1, "no/such/folder");
}

static void test_usage(void)
{
    write_inputs();
    static const char *const commands[] = {"reduce",  "info", "project", "reconstruct",
                                           "backmap", "plot", "animate", "extend"};
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++) {
        char arguments[64];
        snprintf(arguments, sizeof arguments, "%s --help", commands[i]);
        struct run run = run_tool(arguments);
        CU_ASSERT_EQUAL(run.code, 0);
        CU_ASSERT_PTR_NOT_NULL(strstr(run.output, commands[i]));
        run_free(&run);
        snprintf(arguments, sizeof arguments, "%s --nonsense", commands[i]);
        expect(arguments, 2, "--nonsense");
        expect(commands[i], 2, "");
    }
    expect("--help", 0, NULL);
    expect("--version", 0, NULL);
    expect("", 2, NULL);
    expect("nothing", 2, "nothing");
    expect("reduce --hull hull.csv --shape shape.yaml", 2, "--samples");
    expect("reduce --hull hull.csv --shape shape.yaml --random 5 --samples x.csv", 2, "--samples");
    expect("reduce --hull hull.csv --shape shape.yaml --random 0", 2, "--random");
    expect("reduce --hull hull.csv --shape shape.yaml --random 5 --variance 1.01", 2, "--variance");
    expect("reduce --hull hull.csv --shape shape.yaml --random 5 --method magic", 2, "magic");
    expect("reduce --hull hull.csv --shape shape.yaml --random 5 --method factored", 1, "factored");
    expect("reduce --hull none.csv --shape shape.yaml --random 5", 1, "none.csv");
    expect("reduce --hull hull.csv --shape none.yaml --random 5", 1, "none.yaml");
}

static void test_bad_shapes_name_the_field(void)
{
    static const struct {
        const char *text, *words;
    } bad[] = {
        {"bounds: [0, 1]\n", "functions, orders, lattice and control_points"},
        {"bounds: [0, 1]\norders: [1, 1, 1]\nfunctions:\n  - {order: [1, 1, 1]}\n",
         "2 of functions"},
        {"bounds: [0, 1]\norders: [1, 0, 1]\n", "bad.yaml:2"},
        {"bounds: [0, 1]\norders: [1, 1.5, 1]\n", "'1.5'"},
        {"orders: [1, 2, 1]\n", "bounds"},
        {"bounds: [0, 1]\nfunctions:\n  - {order: [1, x, 1]}\n", "'x'"},
        {"bounds: [0, 1]\nfunctions:\n  - {order: [1, 1]}\n", "order"},
        {"functions:\n  - {order: [1, 1, 1]}\n", "bounds"},
        {"bounds: [1, 0]\nfunctions:\n  - {order: [1, 1, 1]}\n", "bad.yaml:1: bounds are 1 and 0"},
        {"bounds: [0, 1]\ndirection: w\nfunctions:\n  - {order: [1, 1, 1]}\n", "bad.yaml:2"},
        {"bounds: [0, 1]\ncombination: odd\nfunctions:\n  - {order: [1, 1, 1]}\n", "odd"},
        {"bounds: [0, 1]\nbox: {length: [3000, 500, 500]}\norders: [1, 1, 1]\n",
         "bad.yaml:2: box from"},
        {"bounds: [0, 1]\nbox: {origin: [50, 0, 0]}\norders: [1, 1, 1]\n", "lies beside"},
        {"bounds: [0, 1]\nbox: {length: [0.001, 0.001, 0.001]}\norders: [1, 1, 1]\n", "smaller"},
        {"bounds: [0, 1]\nlattice: {count: [3, 3, 3], last: [2, 2, 2]}\n",
         "bad.yaml:2: lattice.first is missing"},
        {"bounds: [0, 1]\ncolour: red\nfunctions:\n  - {order: [1, 1, 1]}\n", "colour"},
        {"bounds: [0, 1]\nbox: {length: [0, 1, 1]}\nfunctions:\n  - {order: [1, 1, 1]}\n",
         "length"},
        {"bounds: [0, 1]\nlattice: {count: [3, 3, 3], first: [0, 0, 0], last: [3, 2, 2]}\n",
         "along x"},
        {"bounds: [0, 1]\nlattice: {count: [3, 3, 3], degree: [2, 5, 2], first: [0, 0, 0], "
         "last: [2, 2, 2]}\n",
         "along y"},
        {"bounds: [0, 1]\ncontrol_points:\n  moved:\n    - {first: [0, 0], last: [0, 0]}\n",
         "bad.yaml:2: control_points are those of a NURBS surface"},
    };
    write_inputs();
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        scratch_write("bad.yaml", bad[i].text);
        expect("reduce --hull hull.csv --shape bad.yaml --random 5", 1, bad[i].words);
    }
}

/* The short form stands for the list of all triples, the last axis fastest. */
static void test_orders(void)
{
    write_inputs();
    scratch_write("short.yaml", "bounds: [-0.02, 0.02]\norders: [2, 1, 2]\n");
    scratch_write("long.yaml", "bounds: [-0.02, 0.02]\n"
                               "functions:\n"
                               "  - {order: [1, 1, 1]}\n"
                               "  - {order: [1, 1, 2]}\n"
                               "  - {order: [2, 1, 1]}\n"
                               "  - {order: [2, 1, 2]}\n");
    json_t *brief = run_json("reduce --hull hull.csv --shape short.yaml --random 50 --json");
    json_t *whole = run_json("reduce --hull hull.csv --shape long.yaml --random 50 --json");
    CU_ASSERT_EQUAL(number(brief, "parameters"), 4);
    CHECK_CLOSE(number(brief, "trace"), number(whole, "trace"), 0);
    CU_ASSERT_TRUE(
        json_equal(json_object_get(brief, "eigenvalues"), json_object_get(whole, "eigenvalues")));
    json_decref(brief);
    json_decref(whole);
}

/* Cut anywhere, or with a bit of its headers changed, a model file is refused with a sentence. */
static void test_bad_models_are_refused(void)
{
    write_inputs();
    json_decref(run_json(reduce));
    FILE *stream = fopen(scratch("model.h5"), "rb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(stream);
    static char bytes[4 << 20];
    size_t length = fread(bytes, 1, sizeof bytes, stream);
    fclose(stream);
    CU_ASSERT_TRUE(length > 10000);
    for (int cut = 0; cut < 8; cut++) {
        stream = fopen(scratch("cut.h5"), "wb");
        fwrite(bytes, 1, length * (size_t)cut / 8, stream);
        fclose(stream);
        expect("info cut.h5", 1, "cut.h5");
    }
    for (size_t at = 8; at < 168; at += 13) { /* superblock and header of the root */
        bytes[at] ^= 0x10;
        stream = fopen(scratch("bent.h5"), "wb");
        fwrite(bytes, 1, length, stream);
        fclose(stream);
        expect("info bent.h5", 1, "bent.h5");
        bytes[at] ^= 0x10;
    }
    expect("info hull.csv", 1, "hull.csv");
    expect("info none.h5", 1, "none.h5");
    expect("backmap model.h5 --latent 1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20", 1,
           "at most");
    expect("reconstruct model.h5 --latent nan", 1, "'nan' is neither finite numbers u1,u2,...");
    expect("project model.h5 --hull shape.yaml", 1, "shape.yaml");
    scratch_write("few.csv", "x,y,z\n0,0,0\n");
    expect("project model.h5 --hull few.csv", 1, "1 points");
    scratch_remove_all();
}

/* The grid of write_inputs() with every row of a table of moves added, as a table of variants. */
static void write_variants(const char *name, size_t count, double moves(size_t r, size_t i))
{
    static double xyz[SECTIONS * GIRTH * 3];
    char line[128];
    size_t n = 0;
    FILE *hull = fopen(scratch("hull.csv"), "r");
    while (fgets(line, sizeof line, hull))
        if (sscanf(line, "%*d,%*d,%lf,%lf,%lf", &xyz[n], &xyz[n + 1], &xyz[n + 2]) == 3)
            n += 3;
    fclose(hull);
    CU_ASSERT_EQUAL_FATAL(n, SECTIONS * GIRTH * 3);
    FILE *stream = fopen(scratch(name), "w");
    for (size_t r = 0; r < count; r++)
        for (size_t i = 0; i < n; i++)
            fprintf(stream, "%.17g%c", xyz[i] + moves(r, i), i + 1 < n ? ',' : '\n');
    fclose(stream);
}

/* Two orthogonal moves whose amplitudes over 24 variants are a cosine and a sine: of point p by
 * sin(pi p / P) and sin(2 pi p / P) along y. sum sin^2 = P/2, mean cos^2 = 1/2. */
static double two_moves(size_t r, size_t i)
{
    double s = PI * (double)(i / 3) / (SECTIONS * GIRTH), a = 2 * PI * (double)r / 24;
    return i % 3 == 1 ? 0.03 * cos(a) * sin(s) + 0.01 * sin(a) * sin(2 * s) : 0;
}

static void test_snapshots(void)
{
    write_inputs();
    write_variants("variants.csv", 24, two_moves);
    json_t *root = run_json("reduce --snapshots variants.csv --hull hull.csv -o model.h5 "
                            "--variance 0.99 --json");
    json_t *values = json_object_get(root, "eigenvalues");
    CU_ASSERT_EQUAL(number(root, "samples"), 24);
    CU_ASSERT_EQUAL(number(root, "parameters"), 0);
    CU_ASSERT_EQUAL(number(root, "modes"), 2);
    double unit = SECTIONS * GIRTH / 2.0 / 2;
    CHECK_RELATIVE(json_number_value(json_array_get(values, 0)), 9e-4 * unit, 1e-12);
    CHECK_RELATIVE(json_number_value(json_array_get(values, 1)), 1e-4 * unit, 1e-12);
    json_decref(root);
    /* Their mean is the parent itself; --grid says where its sections are. */
    json_t *mean = run_json("reduce --snapshots variants.csv --grid 13x7 --weights area --json");
    CU_ASSERT_TRUE(number(mean, "trace") > 0);
    json_decref(mean);
    mean = run_json("reduce --snapshots variants.csv -o loose.h5 --json");
    CHECK_RELATIVE(number(mean, "trace"), 1e-3 * unit, 1e-12);
    json_decref(mean);
    json_t *info = run_json("info model.h5 --json");
    CU_ASSERT_STRING_EQUAL(json_string_value(json_object_get(info, "shape")), "snapshots");
    json_decref(info);
    expect("info loose.h5", 0, NULL);
    expect("plot loose.h5 -o loose.svg", 0, NULL);
    expect("plot model.h5 -o snapshots.svg", 0, NULL);
    expect("animate model.h5 -o snapshots.svg", 0, NULL);
    /* There and back. */
    expect("reconstruct model.h5 --latent 0.05,-0.02 -o moved.csv", 0, NULL);
    json_t *again = run_json("project model.h5 --hull moved.csv --json");
    json_t *u = json_array_get(json_object_get(again, "rows"), 0);
    CHECK_CLOSE(number(u, "u1"), 0.05, 1e-14);
    CHECK_CLOSE(number(u, "u2"), -0.02, 1e-14);
    json_decref(again);
    /* The vectors of the model as snapshots of their own: orthonormal rows. */
    json_t *rows = run_json("reduce --snapshots model.h5 --dataset vectors --displacements "
                            "--hull hull.csv --json");
    double count = number(rows, "samples");
    CHECK_RELATIVE(json_number_value(json_array_get(json_object_get(rows, "eigenvalues"), 0)),
                   1 / count, 1e-12);
    CHECK_RELATIVE(number(rows, "trace"), 1.0, 1e-12);
    json_decref(rows);
}

static void test_snapshots_refused(void)
{
    write_inputs();
    write_variants("variants.csv", 24, two_moves);
    expect("reduce --snapshots variants.csv --hull hull.csv -o model.h5", 0, NULL);
    expect("backmap model.h5 --latent 0.01", 1, "it has no parameters");
    expect("extend model.h5 --random 9", 1, "it has no parameters");
    expect("project model.h5 --parameters 0.01", 1, "it has no parameters");
    expect("reconstruct model.h5 --parameters 0.01", 1, "it has no parameters");
    expect("reduce --snapshots variants.csv --shape shape.yaml --hull hull.csv", 2, "--shape");
    expect("reduce --snapshots variants.csv --random 9", 2, "snapshots");
    expect("reduce --snapshots variants.csv --displacements", 2, "--hull");
    expect("reduce --shape shape.yaml --random 9", 2, "hull");
    expect("reduce --snapshots variants.csv --grid 13x8", 1, "expected 13 x 8");
    expect("reduce --snapshots model.h5", 1, "no dataset 'snapshots'");
    expect("reduce --snapshots none.h5", 1, "none.h5");
    scratch_write("odd.csv", "0,0,0,1\n0,0,1,1\n");
    expect("reduce --snapshots odd.csv", 1, "2 rows of 4 numbers");
    scratch_write("other.csv", "0,0,0\n0,0,1\n");
    expect("reduce --snapshots other.csv --hull hull.csv", 1, "1 points in a row");
    scratch_write("same.csv", "0,0,1\n0,0,1\n");
    expect("reduce --snapshots same.csv", 1, "zero");
}

static const struct check_case cases[] = {
    {"reduce prints JSON that adds up", test_reduce_prints_json},
    {"reduce from a file of samples", test_reduce_from_samples},
    {"first lines of samples", test_first_lines},
    {"parameters outside of their bounds", test_outside_bounds},
    {"numbers of sections", test_bad_grids},
    {"model files keep every bit", test_model_round_trip},
    {"there and back", test_there_and_back},
    {"a model grows", test_extend},
    {"moments and lattices", test_moments_and_lattice},
    {"control points of a NURBS hull", test_control_points},
    {"control points that there are not", test_bad_control_points},
    {"drawings", test_drawings},
    {"usage", test_usage},
    {"bad shapes name the field", test_bad_shapes_name_the_field},
    {"all triples of half-waves", test_orders},
    {"variants of anybody", test_snapshots},
    {"variants refused", test_snapshots_refused},
    {"bad models are refused", test_bad_models_are_refused},
};

CHECK_MAIN("galv tool", cases)
