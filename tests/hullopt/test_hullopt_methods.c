/* Every method of search on one small problem whose optimum is known by another way: C_w of
 * Michell's formula is a sum of squares of what is linear in the half breadths, so within the
 * displacement's band there is one minimum. And: a run that dies goes on by the same designs. */
#include "check.h"
#include "core/compare.h"
#include "core/constraints.h"
#include "core/forecast.h"
#include "core/optimise.h"
#include "core/search.h"

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { BUDGET = 10, MODES = 8 };

static char path[300], store[300];
static const char *limits = "displacement: 0.02";

static void write_config(const char *method, int designs)
{
    FILE *file = fopen(path, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    fprintf(file,
            "hull: " EXAMPLES_DIR "/hulls/wigley.json\nshape: " EXAMPLES_DIR "/wigley_shape.yaml\n"
            "grid: {sections: 15, girth: 7}\nlatent: {samples: 100, variance: 0.9}\n"
            "flow: {froude: 0.316}\nsolver: {formulation: michell, elements_u: 8, elements_v: 4, "
            "surface_cells: 8, "
            "tolerance: 1e-3}\nreconstruction: {tolerance: 1e-3}\nconstraints: {%s}\n"
            "search: {method: %s, initial: %d, iterations: %d}\n",
            limits, method, designs / 2, designs - designs / 2);
    fclose(file);
}

/* Dies, without a word, when so many designs have been shown. */
struct deadline {
    int left;
};

static void die(void *user_data, const char *stage, double fraction, const char *detail)
{
    struct deadline *d = user_data;
    (void)fraction;
    (void)detail;
    if (strcmp(stage, "search") == 0 && d->left-- == 0)
        _exit(7);
}

/* A session on the store, in a process of its own; 7 when it died as it should. */
static int session(int left)
{
    pid_t child = fork();
    if (child == 0) {
        struct config config;
        struct problem problem;
        struct record record;
        struct deadline deadline = {left};
        const struct core_watch watch = {.show = left >= 0 ? die : NULL, .user_data = &deadline};
        if (!config_read(path, NULL, &config) || !problem_read(&config, &problem))
            _exit(2);
        galv_shape *shape = problem_shape(&problem);
        const struct core_watch nobody = {.show = NULL};
        bool ok = access(store, F_OK) == 0 ? optimise_resume(&problem, store)
                                           : optimise_begin(&problem, shape, store, &nobody);
        ok = ok && search_open(&problem, store, &record) && record_begin_session(&record, 1, 0) &&
             search_run(&problem, &record, &watch);
        if (!ok)
            fprintf(stderr, "%s\n", core_sentence());
        else
            record_close(&record);
        _exit(ok ? 0 : 3);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

struct history {
    size_t n;
    double u[2 * BUDGET * 8][MODES], value[2 * BUDGET * 8];
    double best;
};

static void read_history(struct history *h)
{
    struct record record;
    struct origin origin;
    struct config config;
    struct evaluation *list;
    memset(h, 0, sizeof *h);
    CU_ASSERT_TRUE_FATAL(record_read(store, &record, &origin));
    CU_ASSERT_TRUE_FATAL(config_restore(origin.configuration, &config));
    CU_ASSERT_TRUE_FATAL(record_evaluations(&record, &list, &h->n));
    size_t modes = galv_model_modes(origin.model);
    CU_ASSERT_TRUE_FATAL(modes <= MODES && h->n <= sizeof h->value / sizeof *h->value);
    for (size_t i = 0; i < h->n; i++) {
        memcpy(h->u[i], list[i].u, modes * sizeof *list[i].u);
        h->value[i] = list[i].failed ? -1 : list[i].objective;
    }
    const struct evaluation *best = outcome_best(&config, h->n, list);
    h->best = best ? best->objective / list[0].objective : NAN;
    CU_ASSERT_TRUE(best && (best->id == 0 || fabs(best->volume_ratio - 1) <= 0.02));
    free(list);
    origin_free(&origin);
    config_free(&config);
    record_close(&record);
}

static void run_whole(const char *method, int designs, struct history *h)
{
    write_config(method, designs);
    record_remove(store);
    CU_ASSERT_EQUAL_FATAL(session(-1), 0);
    read_history(h);
}

static bool has_twins(const struct history *h)
{
    for (size_t i = 0; i < h->n; i++)
        for (size_t k = 0; k < i; k++)
            if (memcmp(h->u[i], h->u[k], sizeof h->u[i]) == 0)
                return true;
    return false;
}

/* The budget is kept, no design is evaluated twice, and a run that died has the same. */
static void test_resume(void)
{
    static struct history whole, again;
    const struct method_row *row;
    for (int m = 0; (row = method_row(m)); m++) {
        if (row->kind != METHOD_NLOPT && row->kind != METHOD_SWARM)
            continue;
        run_whole(row->name, BUDGET, &whole);
        CU_ASSERT_TRUE(whole.n > 1 && whole.n <= BUDGET + 1);
        CU_ASSERT_FALSE(has_twins(&whole));
        CU_ASSERT_TRUE(whole.best <= 1);
        if (row->kind == METHOD_NLOPT && !row->gradient)
            continue; /* they share all of their resume with one that is tried */
        record_remove(store);
        CU_ASSERT_EQUAL(session(6), 7);
        CU_ASSERT_EQUAL(session(-1), 0);
        read_history(&again);
        bool same = again.n == whole.n && memcmp(again.u, whole.u, sizeof whole.u) == 0 &&
                    memcmp(again.value, whole.value, sizeof whole.value) == 0;
        if (!same)
            fprintf(stderr, "%s: another history after it died\n", row->name);
        CU_ASSERT_TRUE(same);
    }
}

/* Designs alone: as many as asked for, all inside. */
static void test_designs(void)
{
    static struct history h;
    static const char *const names[] = {"random", "lhs", "random, space: parameters"};
    for (size_t k = 0; k < 3; k++) {
        run_whole(names[k], BUDGET, &h);
        CU_ASSERT_EQUAL(h.n, BUDGET + 1);
        for (size_t i = 0; i < h.n; i++)
            CU_ASSERT_TRUE(h.value[i] > 0);
    }
}

/* Initial designs of the derivatives at the original are better than it, each another, and kept
 * with the run. */
static void test_initial_designs(void)
{
    static struct history whole, again;
    run_whole("bayesian, design: forecast", BUDGET, &whole);
    CU_ASSERT_EQUAL(whole.n, BUDGET + 1);
    CU_ASSERT_FALSE(has_twins(&whole));
    for (size_t i = 1; i <= BUDGET / 2; i++)
        CU_ASSERT_TRUE(whole.value[i] > 0 && whole.value[i] < whole.value[0]);
    record_remove(store);
    CU_ASSERT_EQUAL(session(4), 7);
    CU_ASSERT_EQUAL(session(-1), 0);
    read_history(&again);
    CU_ASSERT_TRUE(again.n == whole.n && memcmp(again.u, whole.u, sizeof whole.u) == 0);
}

/* What is forecast, in a process of its own. */
static struct forecast forecast_alone(void)
{
    struct forecast f = {.asked = NAN};
    int ends[2], status = 0;
    CU_ASSERT_EQUAL_FATAL(pipe(ends), 0);
    pid_t child = fork();
    if (child == 0) {
        const struct core_watch nobody = {.show = NULL};
        struct config config;
        struct problem problem;
        if (!config_read(path, NULL, &config) || !problem_read(&config, &problem))
            _exit(2);
        galv_shape *shape = problem_shape(&problem);
        bool ok = shape && problem_reduce(&problem, shape, &nobody) && forecast_run(&problem, &f);
        _exit(ok && write(ends[1], &f, sizeof f) == sizeof f ? 0 : 3);
    }
    close(ends[1]);
    CU_ASSERT_EQUAL(read(ends[0], &f, sizeof f), sizeof f);
    close(ends[0]);
    waitpid(child, &status, 0);
    CU_ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    return f;
}

/* Two local methods that share nothing find the one minimum; one of rank-one samples comes near. */
static void test_minimum(void)
{
    static struct history descent, sqp, cobyla;
    run_whole("gauss-newton", 16, &descent);
    run_whole("sqp", 48, &sqp);
    run_whole("cobyla", 60, &cobyla);
    CU_ASSERT_TRUE(descent.best < 0.6);
    CHECK_CLOSE(sqp.best, descent.best, 0.02);
    CHECK_CLOSE(cobyla.best, descent.best, 0.05);
    /* Michell's formula is linear in the half breadths: one Jacobian tells the optimum, up to the
     * coarse mesh. A constraint less never costs anything. */
    struct forecast f = forecast_alone(), slow;
    CHECK_CLOSE(f.asked, descent.best, 0.05);
    limits = "displacement: 0.02, speeds: 1}\nverification: {froude: [0.25]";
    write_config("gauss-newton", 16);
    slow = forecast_alone();
    limits = "displacement: 0.02";
    CU_ASSERT_TRUE(slow.asked >= f.asked - 1e-4);
    bool dropped = false;
    for (size_t k = 0; k < FORECAST_ROWS; k++) {
        CU_ASSERT_TRUE(isnan(f.without[k]) || f.without[k] <= f.asked + 1e-4);
        CU_ASSERT_TRUE(isnan(slow.without[k]) || slow.without[k] <= slow.asked + 1e-4);
        dropped = dropped || f.without[k] < f.asked;
    }
    CU_ASSERT_TRUE(dropped);
}

/* Quartiles by hand; runs of one problem beside each other, of two refused. */
static void test_compare(void)
{
    static struct history h;
    double numbers[] = {4, 1, 3, 2, INFINITY}, quartile[3];
    struct comparison c;
    char other[320];
    comparison_quartiles(5, numbers, quartile);
    CU_ASSERT_EQUAL(quartile[0], 2);
    CU_ASSERT_EQUAL(quartile[1], 3);
    CU_ASSERT_EQUAL(quartile[2], 4);
    comparison_quartiles(2, (double[]){1, 2}, quartile);
    CHECK_CLOSE(quartile[0], 1.25, 1e-15);
    run_whole("random", BUDGET, &h);
    snprintf(other, sizeof other, "%s.other", store);
    CU_ASSERT_EQUAL(rename(store, other), 0);
    double least = h.best;
    run_whole("lhs", BUDGET, &h);
    least = fmin(least, h.best);
    char *const both[] = {store, other};
    CU_ASSERT_TRUE_FATAL(comparison_read(2, both, &c));
    CU_ASSERT_EQUAL(c.groups, 2);
    CU_ASSERT_EQUAL(c.least, least);
    CU_ASSERT_EQUAL(c.course[0].n, BUDGET);
    CU_ASSERT_EQUAL(c.course[0].best[BUDGET - 1], h.best);
    for (size_t level = 0; level < COMPARE_LEVELS; level++)
        for (size_t g = 0; g < 2; g++) {
            size_t n = comparison_needed(&c, g, level, false, numbers), k = 0;
            CU_ASSERT_EQUAL(n, 1);
            while (k < BUDGET && c.course[g].best[k] > (1 + COMPARE_LEVEL[level]) * least)
                k++;
            CU_ASSERT_EQUAL(numbers[0], k == BUDGET ? INFINITY : (double)(k + 1));
        }
    comparison_free(&c);
    FILE *file = fopen(path, "a");
    fputs("verification: {froude: [0.28]}\n", file);
    fclose(file);
    record_remove(store);
    CU_ASSERT_EQUAL(session(-1), 0);
    CU_ASSERT_FALSE(comparison_read(2, both, &c));
    CU_ASSERT_PTR_NOT_NULL(strstr(core_sentence(), "different problems"));
    record_remove(other);
}

static const struct check_case cases[] = {
    {"runs beside each other", test_compare},
    {"a search that dies goes on by the same designs", test_resume},
    {"designs alone", test_designs},
    {"initial designs by derivatives", test_initial_designs},
    {"the one minimum", test_minimum},
};

int main(void)
{
    char folder[200];
    snprintf(folder, sizeof folder, "%s/hullopt_methods_XXXXXX", check_scratch());
    if (!mkdtemp(folder))
        return EXIT_FAILURE;
    snprintf(path, sizeof path, "%s/run.yaml", folder);
    snprintf(store, sizeof store, "%s/run.db", folder);
    int code = check_main("hullopt methods", cases, sizeof cases / sizeof *cases);
    record_remove(store);
    unlink(path);
    return rmdir(folder) == 0 ? code : EXIT_FAILURE;
}
