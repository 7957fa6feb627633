/* Settings by a table: files that are right and files that are wrong in every way, command lines,
 * canonical text and help. */
#include "capture.h"
#include "check.h"
#include "settings.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

struct part {
    char *name;
    double bounds[2];
    bool has_bounds;
};

struct run {
    char *title, *hull;
    double tolerance, share, cutoff, box[3], *speeds;
    size_t n_speeds, samples, grid[2], n_axes;
    uint64_t seed;
    int refine, formulation, axes[3];
    bool line_term, json, refine_given;
    struct part *parts;
    size_t n_parts;
};

static const struct setting_word NONE[] = {{"none", INFINITY}, {"by rule", NAN}, {NULL, 0}};
static const struct setting_word AUTO[] = {{"auto", NAN}, {NULL, 0}};
static const struct setting_word FORMULATIONS[] = {{"auto", 0}, {"michell", 5}, {NULL, 0}};
static const struct setting_word AXES[] = {{"x", 0}, {"y", 1}, {"z", 2}, {NULL, 0}};

static const struct setting PART_ROWS[] = {
    {.key = "name",
     .type = SETTING_TEXT,
     .offset = offsetof(struct part, name),
     .required = true,
     .sentence = "of the part"},
    {.key = "bounds",
     .type = SETTING_NUMBER,
     .offset = offsetof(struct part, bounds),
     .n_least = 2,
     .n_most = 2,
     .given = offsetof(struct part, has_bounds),
     .otherwise = "0,1",
     .sentence = "from and to, m"},
};

static void check_part(struct settings_source *source, void *target)
{
    const struct part *part = target;
    if (!(part->bounds[0] < part->bounds[1]))
        settings_complain(source, "bounds", "are %g and %g, expected increasing", part->bounds[0],
                          part->bounds[1]);
}

static const struct settings PART = {.n = 2, .rows = PART_ROWS, .check = check_part};

#define AT(member) .offset = offsetof(struct run, member)
static const struct setting ROWS[] = {
    {.option = "FILE", .type = SETTING_TEXT, AT(title), .required = true, .sentence = "what to do"},
    {.key = "hull", .type = SETTING_FILE, AT(hull), .sentence = "the hull"},
    {.type = SETTING_HEADING, .sentence = "Solver:"},
    {.key = "solver.tolerance",
     .option = "tolerance",
     .letter = 't',
     .type = SETTING_NUMBER,
     AT(tolerance),
     .most = 0.1,
     .open_least = true,
     .open_most = true,
     .otherwise = "1e-4",
     .sentence = "relative error asked of the quadrature"},
    {.key = "solver.share",
     .type = SETTING_NUMBER,
     AT(share),
     .most = 1,
     .open_least = true,
     .otherwise = "0.95",
     .sentence = "of the variance"},
    {.key = "solver.cutoff",
     .option = "cutoff",
     .type = SETTING_NUMBER,
     AT(cutoff),
     .most = INFINITY,
     .open_least = true,
     .words = NONE,
     .otherwise = "by rule",
     .sentence = "tangent of the angle of the filter"},
    {.key = "solver.refine",
     .option = "refine",
     .type = SETTING_INTEGER,
     AT(refine),
     .least = 1,
     .most = 16,
     .otherwise = "1",
     .given = offsetof(struct run, refine_given),
     .sentence = "parts of every knot span"},
    {.key = "solver.formulation",
     .option = "formulation",
     .type = SETTING_CHOICE,
     AT(formulation),
     .words = FORMULATIONS,
     .otherwise = "auto",
     .sentence = "what is solved"},
    {.key = "solver.line_term",
     .option = "no-line-term",
     .type = SETTING_SWITCH,
     AT(line_term),
     .otherwise = "true",
     .sentence = "without the waterline integral"},
    {.option = "json", .type = SETTING_SWITCH, AT(json), .otherwise = "false", .sentence = "JSON"},
    {.key = "samples",
     .type = SETTING_COUNT,
     AT(samples),
     .least = 2,
     .most = 1e7,
     .otherwise = "9000",
     .sentence = "of the shape"},
    {.key = "seed", .type = SETTING_COUNT, AT(seed), .otherwise = "1", .sentence = "of the draws"},
    {.key = "box",
     .type = SETTING_NUMBER,
     AT(box),
     .n_least = 3,
     .n_most = 3,
     .words = AUTO,
     .otherwise = "auto",
     .sentence = "lengths, m"},
    {.key = "axes",
     .type = SETTING_CHOICE,
     AT(axes),
     .n_least = 1,
     .n_most = 3,
     .words = AXES,
     .count = offsetof(struct run, n_axes),
     .otherwise = "y",
     .sentence = "that move"},
    {.key = "speeds",
     .option = "fr",
     .type = SETTING_NUMBERS,
     AT(speeds),
     .most = 10,
     .open_least = true,
     .open_most = true,
     .count = offsetof(struct run, n_speeds),
     .sentence = "Froude numbers"},
    {.option = "grid",
     .type = SETTING_COUNT,
     AT(grid),
     .n_least = 2,
     .n_most = 2,
     .least = 2,
     .most = 100,
     .otherwise = "90x25",
     .sentence = "points"},
    {.key = "parts",
     .type = SETTING_ROWS,
     AT(parts),
     .count = offsetof(struct run, n_parts),
     .table = &PART,
     .size = sizeof(struct part),
     .n_least = 1,
     .n_most = 3,
     .sentence = "of the hull"},
};
static const struct settings TABLE = {.n = sizeof ROWS / sizeof *ROWS, .rows = ROWS};

static char path[200], said[16000];

/* What it prints becomes said. */
static bool read_file(const char *name, struct run *run)
{
    struct capture capture;
    *run = (struct run){0};
    settings_start(&TABLE, run);
    capture_begin(&capture);
    bool ok = settings_read(name, &TABLE, run);
    capture_end(&capture, said, sizeof said);
    return ok;
}

static bool read_text(const char *text, struct run *run)
{
    FILE *out = fopen(path, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(out);
    fputs(text, out);
    fclose(out);
    return read_file(path, run);
}

static void test_good_file(void)
{
    struct run run;
    CU_ASSERT_TRUE(read_text("# comment\nsolver: {tolerance: 1e-3, cutoff: none, refine: 2, "
                             "formulation: michell, line_term: off}\n"
                             "samples: 500\nseed: 18446744073709551615\nbox: [auto, 2.5, auto]\n"
                             "axes: [z, x]\nspeeds: [0.28, '0.3:0.4:0.05']\nparts:\n"
                             "  - name: bow\n    bounds: [1, 2]\n  - {name: stern}\n",
                             &run));
    CU_ASSERT_STRING_EQUAL(said, "");
    CU_ASSERT_EQUAL(run.tolerance, 1e-3);
    CU_ASSERT_EQUAL(run.share, 0.95);
    CU_ASSERT_TRUE(isinf(run.cutoff));
    CU_ASSERT_EQUAL(run.refine, 2);
    CU_ASSERT_TRUE(run.refine_given);
    CU_ASSERT_EQUAL(run.formulation, 5);
    CU_ASSERT_FALSE(run.line_term);
    CU_ASSERT_EQUAL(run.samples, 500);
    CU_ASSERT_EQUAL(run.seed, UINT64_MAX);
    CU_ASSERT_TRUE(isnan(run.box[0]) && run.box[1] == 2.5 && isnan(run.box[2]));
    CU_ASSERT_TRUE(run.n_axes == 2 && run.axes[0] == 2 && run.axes[1] == 0);
    CU_ASSERT_EQUAL_FATAL(run.n_speeds, 4);
    CHECK_CLOSE(run.speeds[3], 0.4, 1e-15);
    CU_ASSERT_EQUAL_FATAL(run.n_parts, 2);
    CU_ASSERT_STRING_EQUAL(run.parts[0].name, "bow");
    CU_ASSERT_TRUE(run.parts[0].has_bounds && run.parts[0].bounds[1] == 2);
    CU_ASSERT_TRUE(!run.parts[1].has_bounds && run.parts[1].bounds[1] == 1);
    settings_free(&TABLE, &run);
}

static void test_null_keeps_the_default(void)
{
    struct run run;
    CU_ASSERT_TRUE(
        read_text("solver:\n  refine: null\n  tolerance:\n  cutoff: ~\nbox: auto\n", &run));
    CU_ASSERT_EQUAL(run.refine, 1);
    CU_ASSERT_FALSE(run.refine_given);
    CU_ASSERT_TRUE(isnan(run.cutoff) && isnan(run.box[2]));
    CU_ASSERT_EQUAL(run.axes[0], 1);
    settings_free(&TABLE, &run);
}

/* Wrong texts, and what the one sentence about each must hold after the path. */
static const struct wrong {
    const char *text, *sentence;
} WRONG[] = {
    {"samples: 5x\n", ":1: samples is '5x', expected a whole number from 2 to 10000000"},
    {"samples: 5.5\n", ":1: samples is '5.5', expected a whole number from 2"},
    {"samples: -5\n", ":1: samples is '-5', expected a whole number from 2"},
    {"\nsamples: 1\n", ":2: samples is '1', expected a whole number from 2"},
    {"seed: -1\n", ":1: seed is '-1', expected a whole number"},
    {"solver:\n  tolerance: 0\n",
     ":2: solver.tolerance is '0', expected a number between 0 and 0.1, both excluded"},
    {"solver:\n  tolerance: nan\n", ":2: solver.tolerance is 'nan', expected a number between"},
    {"solver: {share: 0}\n", ":1: solver.share is '0', expected a number > 0 and <= 1"},
    {"solver: {cutoff: never}\n",
     ":1: solver.cutoff is 'never', expected a number > 0, none or by rule"},
    {"solver: {refine: 17}\n", ":1: solver.refine is '17', expected an integer from 1 to 16"},
    {"solver: {line_term: maybe}\n", ":1: solver.line_term is 'maybe', expected true or false"},
    {"solver:\n  formulation: hogner\n",
     ":2: solver.formulation is 'hogner', expected auto or michell"},
    {"hull: missing.json\n", ":1: hull is 'missing.json', which cannot be read: No such file"},
    {"box: [1, 2]\n", ":1: box has 2 entries, expected 3 numbers or auto"},
    {"box: [1, 2, x]\n", ":1: box is 'x', expected 3 numbers or auto"},
    {"axes: [x, y, z, x]\n", ":1: axes has 4 entries, expected 1 to 3 of x, y or z"},
    {"axes: []\n", ":1: axes has 0 entries, expected 1 to 3 of x, y or z"},
    {"speeds: [0.3, 11]\n", ":1: speeds is '11', expected numbers between 0 and 10"},
    {"solver: 5\n", ":1: solver is '5', expected a mapping of settings"},
    {"solver: [5]\n", ":1: solver is a list, expected a mapping of settings"},
    {"samples: [5]\n", ":1: samples is a list, expected a whole number"},
    {"samples: {a: 5}\n", ":1: samples is a mapping, expected a whole number"},
    {"parts: 5\n", ":1: parts is '5', expected 1 to 3 mappings in a list"},
    {"parts: [5]\n", ":1: parts.1 is '5', expected a mapping of settings"},
    {"parts: []\n", ":1: parts has 0 entries, expected 1 to 3"},
    {"parts:\n  - {name: a}\n  - bounds: [0, 1]\n", ":3: parts.2.name is missing: of the part"},
    {"parts:\n  - name: a\n    bounds: [2, 1]\n",
     ":3: parts.1.bounds are 2 and 1, expected increasing"},
    {"parts:\n  - {name: a, bound: 1}\n",
     ":2: parts.1.bound is no setting; did you mean 'bounds'?"},
    {"sampels: 500\n", ":1: sampels is no setting; did you mean 'samples'?"},
    {"solver: {tolerence: 1e-3}\n", "did you mean 'solver.tolerance'?"},
    {"quite_another: 1\n", ":1: quite_another is no setting\n"},
    {"samples: 500\nseed: 2\nsamples: 600\n", ":3: samples is given twice, first on line 1"},
    {"solver: {refine: 2, refine: 2}\n", ":1: solver.refine is given twice, first on line 1"},
    {"solver.refine: 2\n", ":1: solver.refine is no key"},
    {"[a, b]: 2\n", ":1: a list or mapping is no key"},
    {"- 1\n", ":1: is a list, expected a mapping of settings"},
    {"", ": is empty"},
    {"# nothing\n", ": is empty"},
    {"solver:\n\trefine: 2\n", ":2: has a tab"},
    {"solver: refine: 2\n", ":1: has a ':' where no key can stand"},
    {"solver: [1, 2\nseed: 1\n", "has a list whose '[' is not closed"},
    {"solver: {a: 2\n", "has a mapping whose '{' is not closed"},
    {"hull: 'a\n", "has a quotation that does not end"},
    {"solver:\n    refine: 2\n  tolerance: 1\n", ":3: has a line that belongs to nothing above it"},
    {"seed: *a\n", ":1: has an '*' that refers to no '&'"},
    {"seed: \xff\n", ": holds bytes that are not UTF-8 text"},
    {"box: [1, 2, [3]]\n", ":1: box is a list, expected 3 numbers or auto"},
    {"hull: /dev/zero\n", ":1: hull is '/dev/zero', which cannot be read: no regular file"},
    {"solvre: {refine: 2}\n", ":1: solvre is no setting; did you mean 'solver'?"},
};

static void test_wrong_files(void)
{
    for (size_t i = 0; i < sizeof WRONG / sizeof *WRONG; i++) {
        struct run run;
        char expected[400];
        CU_ASSERT_FALSE(read_text(WRONG[i].text, &run));
        bool from_path = WRONG[i].sentence[0] == ':';
        snprintf(expected, sizeof expected, "%s%s", from_path ? path : "", WRONG[i].sentence);
        expected[strcspn(expected, "\n")] = '\0';
        if (!strstr(said, expected) || !capture_is_sentence(said)) {
            fprintf(stderr, "'%s' gives '%s', expected '%s'\n", WRONG[i].text, said, expected);
            CU_FAIL("sentence");
        }
        settings_free(&TABLE, &run);
    }
}

static void test_all_at_once_in_order(void)
{
    struct run run;
    CU_ASSERT_FALSE(read_text("seed: x\nsolver: {refine: 99, unknown: 1}\nparts:\n  - {bounds: 3}\n"
                              "samples: y\n",
                              &run));
    size_t lines = 0;
    for (const char *c = said; *c; c++)
        lines += *c == '\n';
    CU_ASSERT_EQUAL(lines, 6);
    const char *first = strstr(said, ":1: seed"), *last = strstr(said, ":5: samples");
    CU_ASSERT_TRUE(first && last && first < last);
    settings_free(&TABLE, &run);
}

static void test_missing_file(void)
{
    struct run run;
    CU_ASSERT_FALSE(read_file("/nowhere/run.yaml", &run));
    CU_ASSERT_PTR_NOT_NULL(strstr(said, ": /nowhere/run.yaml: No such file or directory\n"));
    settings_free(&TABLE, &run);
}

static int options(struct run *run, size_t *n_words, char **words, int argc, char **argv)
{
    *run = (struct run){0};
    settings_start(&TABLE, run);
    return settings_options(argc, argv, &TABLE, run, n_words, words);
}
#define OPTIONS(run, n_words, words, ...)                                                          \
    options(run, n_words, words, (int)(sizeof((char *[]){__VA_ARGS__}) / sizeof(char *)),          \
            (char *[]){__VA_ARGS__})

static void test_options(void)
{
    struct run run;
    char *words[16];
    size_t n;
    CU_ASSERT_EQUAL(OPTIONS(&run, &n, words, "x", "a.json", "-t", "1e-3", "--cutoff=none", "--json",
                            "--no-line-term", "--form", "michell", "--grid", "31x11", "--fr",
                            "0.2:0.3:0.05", "-2.5", "--", "--json"),
                    -1);
    CU_ASSERT_STRING_EQUAL(run.title, "a.json");
    CU_ASSERT_EQUAL(run.tolerance, 1e-3);
    CU_ASSERT_TRUE(isinf(run.cutoff) && run.json && !run.line_term && run.formulation == 5);
    CU_ASSERT_TRUE(run.grid[0] == 31 && run.grid[1] == 11 && run.n_speeds == 3);
    CU_ASSERT_EQUAL_FATAL(n, 2);
    CU_ASSERT_STRING_EQUAL(words[0], "-2.5");
    CU_ASSERT_STRING_EQUAL(words[1], "--json");
    settings_free(&TABLE, &run);
    CU_ASSERT_EQUAL(OPTIONS(&run, NULL, NULL, "x", "a", "--line-term", "--no-json"), -1);
    CU_ASSERT_TRUE(run.line_term && !run.json);
    settings_free(&TABLE, &run);
}

static void test_wrong_options(void)
{
    struct run run;
    CU_ASSERT_EQUAL(OPTIONS(&run, NULL, NULL, "x"), 2); /* FILE is missing */
    settings_free(&TABLE, &run);
    CU_ASSERT_EQUAL(OPTIONS(&run, NULL, NULL, "x", "a", "b"), 2);
    settings_free(&TABLE, &run);
    CU_ASSERT_EQUAL(OPTIONS(&run, NULL, NULL, "x", "a", "--refin", "x"), 2);
    settings_free(&TABLE, &run);
    CU_ASSERT_EQUAL(OPTIONS(&run, NULL, NULL, "x", "a", "--refine"), 2);
    settings_free(&TABLE, &run);
    CU_ASSERT_EQUAL(OPTIONS(&run, NULL, NULL, "x", "a", "--nothing"), 2);
    settings_free(&TABLE, &run);
    CU_ASSERT_EQUAL(OPTIONS(&run, NULL, NULL, "x", "a", "--json=1"), 2);
    settings_free(&TABLE, &run);
    CU_ASSERT_EQUAL(OPTIONS(&run, NULL, NULL, "x", "a", "--grid", "31"), 2);
    settings_free(&TABLE, &run);
}

static void test_canonical_text_reads_back(void)
{
    struct run run;
    char *text;
    size_t length;
    CU_ASSERT_TRUE(read_text(
        "solver: {tolerance: 0.003, cutoff: none}\naxes: [z, x]\nspeeds: [0.28, 0.41]\n", &run));
    text = settings_text(&TABLE, &run);
    CU_ASSERT_PTR_NOT_NULL_FATAL(text);
    CU_ASSERT_STRING_EQUAL(text, "hull =\nsolver.tolerance = 0.003\nsolver.share = 0.95\n"
                                 "solver.cutoff = none\nsolver.refine = 1\n"
                                 "solver.formulation = auto\nsolver.line_term = true\n"
                                 "samples = 9000\nseed = 1\nbox = auto, auto, auto\naxes = z, x\n"
                                 "speeds = 0.28, 0.41\n");
    free(text);
    FILE *out = open_memstream(&text, &length);
    settings_help(&TABLE, &run, false, out);
    fclose(out);
    CU_ASSERT_PTR_NOT_NULL(strstr(text, "\nSolver:\n  -t, --tolerance X   relative error asked"));
    CU_ASSERT_PTR_NOT_NULL(strstr(text, "  --no-line-term      without the waterline integral\n"));
    free(text);
    settings_free(&TABLE, &run);
}

static void test_restore(void)
{
    struct run run = {0};
    size_t line;
    settings_start(&TABLE, &run);
    CU_ASSERT_TRUE(settings_restore(
        &TABLE,
        "hull = a.json (00ff)\nsolver.cutoff = none\nsolver.line_term = false\n"
        "seed = 18446744073709551615\naxes = z, x\nspeeds = 0.28, 0.41\nsamples =\n",
        &run, &line));
    CU_ASSERT_STRING_EQUAL(run.hull, "a.json (00ff)");
    CU_ASSERT_TRUE(isinf(run.cutoff) && !run.line_term && run.samples == 9000);
    CU_ASSERT_EQUAL(run.seed, UINT64_MAX);
    CU_ASSERT_TRUE(run.n_axes == 2 && run.axes[0] == 2 && run.axes[1] == 0);
    CU_ASSERT_TRUE(run.n_speeds == 2 && run.speeds[1] == 0.41);
    CU_ASSERT_FALSE(settings_restore(&TABLE, "seed = 1\nsede = 2\n", &run, &line));
    CU_ASSERT_EQUAL(line, 2);
    CU_ASSERT_FALSE(settings_restore(&TABLE, "samples = many\n", &run, &line));
    CU_ASSERT_EQUAL(line, 1);
    /* What a file may not be without, and what goes with what. */
    struct part part = {0};
    settings_start(&PART, &part);
    CU_ASSERT_FALSE(settings_restore(&PART, "bounds = 1, 2\n", &part, &line));
    CU_ASSERT_EQUAL(line, 0);
    CU_ASSERT_FALSE(settings_restore(&PART, "name = a\nbounds = 2, 1\n", &part, &line));
    CU_ASSERT_FALSE(settings_restore(&PART, "bounds = 1, 2\nname =\n", &part, &line));
    CU_ASSERT_TRUE(settings_restore(&PART, "bounds = 1, 2\nname = a\n", &part, &line));
    settings_free(&PART, &part);
    settings_free(&TABLE, &run);
}

/* A template is a file with what stands in the target. */
static void test_template(void)
{
    struct run run;
    char *before, *after, *text;
    size_t length;
    CU_ASSERT_TRUE(read_text("solver: {tolerance: 0.003, cutoff: none, line_term: no}\n"
                             "axes: [z, x]\nspeeds: [0.28, 0.41]\n",
                             &run));
    before = settings_text(&TABLE, &run);
    FILE *out = open_memstream(&text, &length);
    settings_template(&TABLE, &run, out);
    fclose(out);
    settings_free(&TABLE, &run);
    CU_ASSERT_PTR_NOT_NULL(strstr(text, "\nsolver:\n  # relative error asked of the quadrature; "
                                        "a number between 0 and 0.1, both excluded\n"
                                        "  tolerance: 0.003\n"));
    CU_ASSERT_TRUE(read_text(text, &run));
    after = settings_text(&TABLE, &run);
    CU_ASSERT_STRING_EQUAL(before, after);
    free(before);
    free(after);
    free(text);
    settings_free(&TABLE, &run);
}

/* A byte order mark is no part of the text; a file without end is given up. */
static void test_bytes(void)
{
    struct run run;
    CU_ASSERT_TRUE(read_text("\xef\xbb\xbfseed: 5\n", &run));
    CU_ASSERT_EQUAL(run.seed, 5);
    settings_free(&TABLE, &run);
    CU_ASSERT_FALSE(read_file("/dev/zero", &run));
    settings_free(&TABLE, &run);
    FILE *out = fopen(path, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(out);
    for (size_t i = 0; i < 100000; i++)
        fputs("# a comment of some forty characters here\n", out);
    fclose(out);
    CU_ASSERT_EQUAL(truncate(path, (off_t)2 << 30), 0);
    CU_ASSERT_FALSE(read_file(path, &run));
    CU_ASSERT_PTR_NOT_NULL(strstr(said, "is longer than 4194304 bytes"));
    settings_free(&TABLE, &run);
}

/* COUNT lines, in which %zu stands for the number of the line, and what is said of them. */
static void read_many(size_t count, const char *before, const char *line, const char *after)
{
    struct run run;
    FILE *out = fopen(path, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(out);
    fputs(before, out);
    for (size_t i = 0; i < count; i++) {
        const char *at = strstr(line, "%zu");
        fprintf(out, "%.*s%zu%s", (int)(at - line), line, i, at + 3);
    }
    fputs(after, out);
    fclose(out);
    CU_ASSERT_FALSE(read_file(path, &run));
    settings_free(&TABLE, &run);
}

/* What would take hours or all memory is refused by its number. */
static void test_very_many(void)
{
    read_many(300000, "", "k%zu: 1\n", "");
    CU_ASSERT_PTR_NOT_NULL(strstr(said, "has 300000 keys, more than any settings have"));
    read_many(300000, "speeds: [", "&a%zu 1,\n", "1]\n");
    CU_ASSERT_PTR_NOT_NULL(strstr(said, "has more than 10000 '&'"));
    read_many(20000, "speeds: [", "0:1:1e-5, \n # %zu\n", "1]\n");
    CU_ASSERT_PTR_NOT_NULL(strstr(said, "speeds is '0:1:1e-5', expected"));
    read_many(900, "", "k%zu: 1\n", "");
    size_t lines = 0;
    for (const char *c = said; *c; c++)
        lines += *c == '\n';
    CU_ASSERT_EQUAL(lines, 101);
    CU_ASSERT_PTR_NOT_NULL(strstr(said, ": 800 more of such\n"));
}

int main(void)
{
    static const struct check_case cases[] = {
        {"good_file", test_good_file},
        {"null_keeps_the_default", test_null_keeps_the_default},
        {"wrong_files", test_wrong_files},
        {"all_at_once_in_order", test_all_at_once_in_order},
        {"missing_file", test_missing_file},
        {"options", test_options},
        {"wrong_options", test_wrong_options},
        {"canonical_text_reads_back", test_canonical_text_reads_back},
        {"restore", test_restore},
        {"template", test_template},
        {"bytes", test_bytes},
        {"very_many", test_very_many},
    };
    snprintf(path, sizeof path, "%s/settings_XXXXXX", check_scratch());
    int file = mkstemp(path);
    if (file < 0)
        return 1;
    close(file);
    int code = check_main("settings", cases, sizeof cases / sizeof *cases);
    unlink(path);
    return code;
}
