/* The run configuration: defaults, ranges, and one sentence with the line for whatever is wrong. */
#include "capture.h"
#include "check.h"
#include "config.h"

#include <stdint.h>
#include <stdlib.h>

static char folder[120];

static void write_file(const char *name, const char *text, char *path, size_t size)
{
    snprintf(path, size, "%s/%s", folder, name);
    FILE *out = fopen(path, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(out);
    fputs(text, out);
    fclose(out);
}

static bool read_text(const char *text, struct config *config)
{
    char path[200], other[200];
    write_file("hull.json", "{}", other, sizeof other);
    write_file("shape.yaml", "x: 1\n", other, sizeof other);
    write_file("run.yaml", text, path, sizeof path);
    return config_read(path, NULL, config);
}

static const char MINIMAL[] = "hull: hull.json\nshape: shape.yaml\nflow:\n  froude: 0.3\n";

static void test_defaults(void)
{
    struct config c;
    CU_ASSERT_TRUE_FATAL(read_text(MINIMAL, &c));
    CU_ASSERT_EQUAL(c.samples, 9000);
    CU_ASSERT_EQUAL(c.initial, 200);
    CU_ASSERT_EQUAL(c.iterations, 100);
    CU_ASSERT_EQUAL(c.sections, 0);
    CU_ASSERT_TRUE(isnan(c.displacement));
    CU_ASSERT_EQUAL(c.variance, 0.95);
    CU_ASSERT_EQUAL(c.solver.froude, 0.3);
    CU_ASSERT_EQUAL(c.solver.formulation, IGABEM_FORMULATION_AUTO);
    CU_ASSERT_PTR_NOT_NULL(strstr(c.hull, folder));
    config_free(&c);
}

static void test_all_fields(void)
{
    struct config c;
    CU_ASSERT_TRUE_FATAL(read_text(
        "name: test\nhull: hull.json\nshape: shape.yaml\n"
        "grid: {sections: 31, girth: 11}\n"
        "latent: {samples: 500, seed: 7, variance: 0.9}\n"
        "reconstruction: {tolerance: 1e-3}\n"
        "flow: {froude: 0.316, gravity: 9.8, density: 1025}\n"
        "solver: {formulation: neumann-kelvin, refine: 2, elements_u: 30, elements_v: auto, "
        "degree: 4, "
        "line_term: off, cutoff_factor: 1.5,\n"
        "         cutoff_angle: 5, stem_limit: 0.4, stern_length: 0.3, stern_blend: 0.02,\n"
        "         spectrum_limit: 30, tolerance: 1e-4}\n"
        "constraints: {displacement: 0.02, breadth: 0.2, entrance: 1.25, pressure: 1.1, speeds: "
        "1.05}\n"
        "search: {initial: 12, iterations: 6, design: sobol, strategy: global, seed: 3}\n"
        "verification: {refine: 3, froude: [0.28, 0.41]}\n",
        &c));
    CU_ASSERT_STRING_EQUAL(c.name, "test");
    CU_ASSERT_EQUAL(c.sections, 31);
    CU_ASSERT_EQUAL(c.girth, 11);
    CU_ASSERT_EQUAL(c.latent_seed, 7);
    CU_ASSERT_EQUAL(c.tolerance, 1e-3);
    CU_ASSERT_EQUAL(c.solver.gravity, 9.8);
    CU_ASSERT_EQUAL(c.solver.density, 1025);
    CU_ASSERT_EQUAL(c.solver.formulation, IGABEM_FORMULATION_NEUMANN_KELVIN);
    CU_ASSERT_EQUAL(c.solver.refine, 2);
    CU_ASSERT_EQUAL(c.solver.elements_u, 30);
    CU_ASSERT_EQUAL(c.solver.elements_v, -1);
    CU_ASSERT_EQUAL(c.solver.degree, 4);
    CU_ASSERT_EQUAL(c.solver.line_term, 0);
    CU_ASSERT_EQUAL(c.solver.cutoff_angle, 5);
    CU_ASSERT_EQUAL(c.solver.stern_length, 0.3);
    CU_ASSERT_EQUAL(c.displacement, 0.02);
    CU_ASSERT_EQUAL(c.breadth, 0.2);
    CU_ASSERT_EQUAL(c.entrance, 1.25);
    CU_ASSERT_EQUAL(c.pressure, 1.1);
    CU_ASSERT_EQUAL(c.speeds, 1.05);
    CU_ASSERT_EQUAL(c.design, BAYESOPT_DESIGN_SOBOL);
    CU_ASSERT_EQUAL(c.strategy, BAYESOPT_STRATEGY_GLOBAL);
    CU_ASSERT_EQUAL(c.search_seed, 3);
    CU_ASSERT_EQUAL(c.verify_refine, 3);
    CU_ASSERT_EQUAL_FATAL(c.verify_froudes, 2);
    CU_ASSERT_EQUAL(c.verify_froude[1], 0.41);
    config_free(&c);
}

static void test_displacement_null(void)
{
    struct config c;
    char text[300];
    snprintf(text, sizeof text, "%sconstraints:\n  displacement: null\n", MINIMAL);
    CU_ASSERT_TRUE_FATAL(read_text(text, &c));
    CU_ASSERT_TRUE(isnan(c.displacement));
    CU_ASSERT_PTR_NOT_NULL(strstr(c.text, "constraints.displacement = none\n"));
    config_free(&c);
}

static void test_overrides(void)
{
    struct config c;
    char path[200];
    struct config_overrides overrides = {5, -1};
    CU_ASSERT_TRUE_FATAL(read_text(MINIMAL, &c));
    config_free(&c);
    snprintf(path, sizeof path, "%s/run.yaml", folder);
    CU_ASSERT_TRUE_FATAL(config_read(path, &overrides, &c));
    CU_ASSERT_EQUAL(c.initial, 5);
    CU_ASSERT_EQUAL(c.iterations, 100);
    CU_ASSERT_PTR_NOT_NULL(strstr(c.text, "search.initial = 5\n"));
    config_free(&c);
}

/* What is appended to a minimal file, the line of the fault and a part of the sentence. */
static const struct {
    const char *text;
    const char *line, *part;
} bad[] = {
    {"latent:\n  variance: 1.5\n", ":6:", "> 0 and <= 1"},
    {"latent:\n  variance: 0\n", ":6:", "latent.variance"},
    {"latent:\n  variance: 0.9x\n", ":6:", "'0.9x'"},
    {"latent: {samples: 3.5}\n", ":5:", "whole number from 2"},
    {"latent: {samples: 1}\n", ":5:", "latent.samples"},
    {"latent:\n  seed: -1\n", ":6:", "latent.seed"},
    {"grid:\n  sections: 2\n", ":6:", "grid.sections"},
    {"solver:\n  formulation: magic\n", ":6:", "neumann-kelvin-stern"},
    {"solver:\n  elements_u: many\n", ":6:", "solver.elements_u"},
    {"solver:\n  line_term: maybe\n", ":6:", "true or false"},
    {"solver:\n  tolerance: nan\n", ":6:", "solver.tolerance"},
    {"search:\n  design: random\n", ":6:", "stlbo"},
    {"search:\n  strategy: fast\n", ":6:", "auto, global or local"},
    {"search:\n\n  initial: 1\n", ":7:", "search.initial"},
    {"constraints:\n  displacement: 2\n", ":6:", "constraints.displacement"},
    {"constraints:\n  breadth: 1\n", ":6:", "constraints.breadth"},
    {"constraints:\n  entrance: 0.9\n", ":6:", "constraints.entrance"},
    {"search:\n  confirm: 0.5\n", ":6:", "needs search.models"},
    {"objective:\n  weights: [1, 1]\n", ":6:", "has 2 numbers, expected 1"},
    {"objective:\n  weights: [0]\n", ":6:", "are all 0"},
    {"objective:\n  quantity: total\n", ":6:", "total-resistance"},
    {"objective:\n  weights: [1, 1]\nverification: {froude: [0.2]}\nsearch: {method: "
     "gauss-newton}\n",
     ":6:", "is not for gauss-newton"},
    {"objective: {quantity: total-resistance}\nsearch: {method: gauss-newton, models: [michell], "
     "confirm: "
     "0.5}\n",
     ":6:", "search.confirm"},
    {"search:\n  method: annealing\n", ":6:", "particle-swarm"},
    {"objective_2:\n  quantity: drag\n", ":6:", "total-resistance"},
    {"objective_2:\n  quantity: displacement\n  froude: 0.2\n", ":7:", "is for a resistance"},
    {"objective_2:\n  quantity: wave-resistance\n  froude: 0.2\n",
     ":7:", "one of verification.froude"},
    {"objective_2:\n  maximise: true\n", ":5:", "is missing"},
    {"objective_2:\n  quantity: command\n", ":6:", "needs objective.command"},
    {"objective_2:\n  quantity: gm\n", ":6:", "needs constraints.kg"},
    {"objective_3:\n  quantity: beam\n", ":6:", "without objective_2.quantity"},
    {"objective_2: {quantity: beam}\nsearch: {method: cobyla}\n", ":5:", "lowers one number"},
    {"objective_2: {quantity: beam}\nsearch: {method: gauss-newton}\n",
     ":5:", "expected bayesian, random or lhs"},
    {"objective_2: {quantity: beam}\nsearch: {strategy: local}\n", ":5:", "over the whole box"},
    {"constraints:\n  gm: [0.9, 2]\n", ":6:", "needs constraints.kg"},
    {"constraints:\n  stations: [0.9, 1.1]\n", ":6:", "needs constraints.at_stations"},
    {"constraints:\n  at_points: [1, -0.1, 2]\n", ":6:", "expected 2 for each"},
    {"constraints:\n  beam: [1.1, 1]\n", ":5:", "above a most of 1"},
    {"constraints:\n  beam: [1]\n", ":6:", "constraints.beam"},
    {"waves:\n  along: 1\n", ":6:", "waves.along"},
    {"verification:\n  froude: [0.3, -1]\n", ":6:", "verification.froude"},
    {"constraints:\n  speeds: 1\n", ":6:", "verification.froude"},
    {"colour: red\n", ":5:", "colour is no setting"},
    {"search:\n  initial: 5\n  budget: 7\n", ":7:", "search.budget is no setting"},
    {"search: 5\n", ":5:", "search"},
    {"latent:\n  sample: 5\n", ":6:", "did you mean 'latent.samples'?"},
    {"sovler:\n  refine: 2\n", ":5:", "did you mean 'solver'?"},
    {"constraints:\n  pressure: 1\nsolver: {formulation: michell}\n", ":6:", "michell has not"},
};

static void test_bad_fields(void)
{
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct config c;
        struct capture capture;
        char text[600], sentence[1000];
        snprintf(text, sizeof text, "%s%s", MINIMAL, bad[i].text);
        capture_begin(&capture);
        bool ok = read_text(text, &c);
        capture_end(&capture, sentence, sizeof sentence);
        CU_ASSERT_FALSE(ok);
        CU_ASSERT_TRUE(capture_is_sentence(sentence));
        int told = strstr(sentence, bad[i].line) && strstr(sentence, bad[i].part);
        if (!told)
            fprintf(stderr, "for '%s' the sentence was '%s'\n", bad[i].text, sentence);
        CU_ASSERT_TRUE(told);
        if (ok)
            config_free(&c);
    }
}

static void check_whole(const char *text, const char *part)
{
    struct config c;
    struct capture capture;
    char sentence[1000];
    capture_begin(&capture);
    bool ok = read_text(text, &c);
    capture_end(&capture, sentence, sizeof sentence);
    CU_ASSERT_FALSE(ok);
    CU_ASSERT_TRUE(capture_is_sentence(sentence));
    CU_ASSERT_PTR_NOT_NULL(strstr(sentence, part));
    if (!strstr(sentence, part))
        fprintf(stderr, "for '%s' the sentence was '%s'\n", text, sentence);
    if (ok)
        config_free(&c);
}

static void test_bad_files(void)
{
    check_whole("", "empty");
    check_whole("hull: hull.json\nshape: shape.yaml\n", "flow.froude is missing");
    check_whole("hull: hull.json\nshape: shape.yaml\nflow: {gravity: 9.8}\n",
                "flow.froude is missing");
    check_whole("hull: hull.json\nshape: shape.yaml\nflow:\n  froude: 0\n", ":4: flow.froude");
    check_whole("hull: hull.json\nshape: shape.yaml\nflow:\n  froude: -0.3\n", ":4: flow.froude");
    check_whole("hull: none.json\nshape: shape.yaml\nflow:\n  froude: 0.3\n", ":1: hull");
    check_whole("hull: hull.json\nshape: nix.yaml\nflow:\n  froude: 0.3\n", ":2: shape");
    check_whole("hull: [unclosed\n", "run.yaml");
    struct config c;
    struct capture capture;
    char sentence[1000];
    capture_begin(&capture);
    bool ok = config_read("/nonexistent/run.yaml", NULL, &c);
    capture_end(&capture, sentence, sizeof sentence);
    CU_ASSERT_FALSE(ok);
    CU_ASSERT_PTR_NOT_NULL(strstr(sentence, "No such file"));
}

/* What is wrong is told at once, in the order of the lines. */
static void test_all_at_once(void)
{
    struct config c;
    struct capture capture;
    char sentences[2000];
    const char *at = sentences;
    capture_begin(&capture);
    bool ok = read_text("hull: none.json\nshape: shape.yaml\nlatent: {samples: x}\n"
                        "search:\n  intial: 7\n  design: latin\n",
                        &c);
    capture_end(&capture, sentences, sizeof sentences);
    CU_ASSERT_FALSE(ok);
    static const char *const parts[] = {"flow.froude is missing", ":1: hull", ":3: latent.samples",
                                        ":5: search.intial is no setting", ":6: search.design"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts && at; i++)
        at = strstr(at, parts[i]);
    CU_ASSERT_PTR_NOT_NULL(at);
}

/* Comments and order do not make another run; a value and an input file do. */
static void test_canonical(void)
{
    struct config a, b;
    static const char *const sides[] = {"now", "then"};
    char difference[300], path[200];
    CU_ASSERT_TRUE_FATAL(read_text(MINIMAL, &a));
    CU_ASSERT_TRUE_FATAL(
        read_text("# the same\nflow: {froude: 3.0e-1}\nshape: shape.yaml\nhull: hull.json\n", &b));
    CU_ASSERT_FALSE(config_difference(a.text, b.text, sides, difference, sizeof difference));
    config_free(&b);
    CU_ASSERT_TRUE_FATAL(
        read_text("hull: hull.json\nshape: shape.yaml\nflow: {froude: 0.31}\n", &b));
    CU_ASSERT_TRUE(config_difference(a.text, b.text, sides, difference, sizeof difference));
    CU_ASSERT_STRING_EQUAL(difference, "now 'flow.froude = 0.3', then 'flow.froude = 0.31'");
    config_free(&b);
    write_file("shape.yaml", "x: 2\n", path, sizeof path);
    snprintf(path, sizeof path, "%s/run.yaml", folder);
    write_file("run.yaml", MINIMAL, path, sizeof path);
    CU_ASSERT_TRUE_FATAL(config_read(path, NULL, &b));
    CU_ASSERT_TRUE(config_difference(a.text, b.text, sides, difference, sizeof difference));
    CU_ASSERT_PTR_NOT_NULL(strstr(difference, "shape = shape.yaml"));
    config_free(&a);
    config_free(&b);
}

static const struct check_case cases[] = {
    {"defaults of a minimal file", test_defaults},
    {"every field", test_all_fields},
    {"displacement null", test_displacement_null},
    {"overrides from the command line", test_overrides},
    {"bad fields", test_bad_fields},
    {"bad files", test_bad_files},
    {"all faults at once", test_all_at_once},
    {"canonical text", test_canonical},
};

int main(void)
{
    snprintf(folder, sizeof folder, "%s/hullopt_config_XXXXXX", check_scratch());
    if (!mkdtemp(folder))
        return EXIT_FAILURE;
    int code = check_main("hullopt configuration", cases, sizeof cases / sizeof *cases);
    char command[160];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command) == 0 ? code : EXIT_FAILURE;
}
