/* The record of a run: what goes in comes out, also where nothing may be written, and what is not
 * such a record, newer or damaged is refused. */
#include "check.h"
#include "cli.h"
#include "core/front.h"
#include "core/record.h"
#include "core/search.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[120], path[200];

enum { ROWS = 5, COLUMNS = 4, POINTS = ROWS * COLUMNS, MODES = 2 };

static struct config config = {.path = "run.yaml",
                               .initial = 4,
                               .iterations = 2,
                               .displacement = NAN,
                               .breadth = NAN,
                               .entrance = NAN,
                               .pressure = NAN,
                               .speeds = NAN,
                               .confirm = NAN,
                               .other = {{.quantity = QUANTITY_NONE}, {.quantity = QUANTITY_NONE}},
                               .text = "a = 1\n"};
static struct problem problem = {.config = &config};

/* A latent space of two sideways modes on a half of a box; no solver is ever asked. */
static void make_problem(void)
{
    double points[3 * POINTS], fields[MODES * 3 * POINTS] = {0}, lower[MODES] = {-1, -1},
                                                  upper[MODES] = {1, 1};
    const double gradient[MODES] = {0.25, -0.5};
    for (size_t p = 0; p < PARTICULARS; p++)
        config.particular[p][0] = config.particular[p][1] = NAN;
    galv_shape *shape;
    galv_options options;
    galv_model *model;
    for (size_t p = 0; p < POINTS; p++) {
        points[3 * p] = (double)(p / COLUMNS);
        points[3 * p + 1] = 0.5;
        points[3 * p + 2] = 0.2 - 0.3 * (double)(p % COLUMNS);
        fields[3 * p + 1] = 0.1;
        fields[3 * POINTS + 3 * p + 1] = 0.1 * points[3 * p];
    }
    galv_options_init(&options);
    options.modes = MODES;
    CU_ASSERT_EQUAL_FATAL(galv_shape_fields(MODES, POINTS, fields, lower, upper, &shape), GALV_OK);
    CU_ASSERT_EQUAL_FATAL(galv_build(shape, POINTS, points, galv_uniform(40, 1), &options, &model),
                          GALV_OK);
    galv_shape_free(shape);
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(ROWS, COLUMNS, points, &problem.grid), NURBS_OK);
    nurbs_surface *side;
    nurbs_hull_options hull;
    nurbs_hull_options_init(&hull);
    hull.length = 4;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(4, 1, 0.5, &side), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(
        nurbs_hull_create_surfaces(1, (const nurbs_surface *const[]){side}, &hull, &problem.source),
        NURBS_OK);
    nurbs_surface_free(side);
    problem.model = model;
    CU_ASSERT_EQUAL_FATAL(galv_limits_create(model, ROWS, COLUMNS, 1, &problem.limits), GALV_OK);
    CU_ASSERT_EQUAL(galv_limits_set_gradient(problem.limits, gradient), GALV_OK);
    igabem_options_init(&problem.solver);
    problem.solver.formulation = IGABEM_FORMULATION_HOGNER;
    problem.solver.froude = 0.3;
    problem.solver.line_term = 0;
    problem.solver.stem_limit = NAN;
}

static void fresh(const char *name, struct record *record)
{
    snprintf(path, sizeof path, "%s/%s", folder, name);
    CU_ASSERT_TRUE_FATAL(search_open(&problem, path, record));
    CU_ASSERT_TRUE_FATAL(record_put_origin(record, &problem));
}

static void test_texts_and_arrays(void)
{
    struct record record;
    const double values[6] = {1, -0.0, NAN, INFINITY, 1e-310, 1.0 / 3};
    char *text;
    double *back;
    size_t rows = 0, columns = 0;
    fresh("texts.db", &record);
    CU_ASSERT_TRUE(record_put_text(&record, "stop", "first"));
    CU_ASSERT_TRUE(record_put_text(&record, "stop", "second"));
    CU_ASSERT_TRUE(record_get_text(&record, "stop", &text));
    CU_ASSERT_STRING_EQUAL_FATAL(text, "second");
    free(text);
    CU_ASSERT_TRUE(record_get_text(&record, "nothing", &text));
    CU_ASSERT_PTR_NULL(text);
    CU_ASSERT_TRUE(record_put_array(&record, "a", 2, 3, values));
    CU_ASSERT_TRUE(record_get_array(&record, "a", &rows, &columns, &back));
    CU_ASSERT_EQUAL(rows, 2);
    CU_ASSERT_EQUAL(columns, 3);
    CU_ASSERT_EQUAL(memcmp(values, back, sizeof values), 0);
    free(back);
    record_close(&record);
}

/* The latent space comes back whole, and so does what it was found for. */
static void test_origin(void)
{
    struct record record;
    struct origin o;
    fresh("origin.db", &record);
    record_close(&record);
    CU_ASSERT_TRUE_FATAL(record_read(path, &record, &o));
    CU_ASSERT_STRING_EQUAL(o.configuration, "a = 1\n");
    CU_ASSERT_EQUAL(o.length, 4);
    CU_ASSERT_EQUAL(o.grid[0], ROWS);
    CU_ASSERT_EQUAL(o.grid[1], COLUMNS);
    CU_ASSERT_EQUAL(o.gradient[0], 0.25);
    CU_ASSERT_EQUAL(o.gradient[1], -0.5);
    CU_ASSERT_EQUAL(o.solver.formulation, IGABEM_FORMULATION_HOGNER);
    CU_ASSERT_EQUAL(o.solver.froude, 0.3);
    CU_ASSERT_FALSE(o.solver.line_term);
    CU_ASSERT_TRUE(isnan(o.solver.stem_limit));
    CU_ASSERT_EQUAL(o.solver.degree, problem.solver.degree);
    for (size_t i = 0; i < galv_model_field_count(); i++) {
        galv_field a = galv_model_field(problem.model, i), b = galv_model_field(o.model, i);
        CU_ASSERT_EQUAL(!a.values, !b.values);
        size_t size = a.type == GALV_TYPE_BOOL ? sizeof(bool) : sizeof(double);
        if (a.values && b.values)
            CU_ASSERT_EQUAL(memcmp(a.values, b.values, a.rows * a.columns * size), 0);
    }
    origin_free(&o);
    record_close(&record);
}

static void fill(uint64_t id, const double *u, struct evaluation *e)
{
    evaluation_start(id, NULL, u, e);
    e->cw = e->objective = 1e-3 / (double)(id + 1);
    e->models = 1;
    e->cw_model[0] = 0.25;
    e->dofs = 468;
    e->solve_seconds = 1.5;
    e->speeds = 2;
    e->cw_speed[0] = 1.0 / 3;
    e->cw_speed[1] = 2.0 / 3;
}

static void test_evaluations(void)
{
    const double parent[MODES] = {0, 0};
    struct record record;
    struct evaluation e, *list;
    double u[2 * MODES];
    uint64_t id[2];
    size_t n;
    fresh("evaluations.db", &record);
    fill(0, parent, &e);
    CU_ASSERT_TRUE(record_tell(&record, &e, NULL));
    CU_ASSERT_EQUAL_FATAL(bayesopt_ask(record.bo, 2, u, id), BAYESOPT_OK);
    fill(id[0], u, &e);
    CU_ASSERT_TRUE(record_tell(&record, &e, NULL));
    CU_ASSERT_FALSE(record_tell(&record, &e, NULL)); /* told twice */
    CU_ASSERT_PTR_NOT_NULL(strstr(core_sentence(), "already been told"));
    record_close(&record);

    CU_ASSERT_TRUE_FATAL(search_open(&problem, path, &record));
    double again[MODES];
    uint64_t same;
    CU_ASSERT_EQUAL_FATAL(bayesopt_ask(record.bo, 1, again, &same), BAYESOPT_OK);
    CU_ASSERT_EQUAL(same, id[1]); /* asked and not told: the same point */
    CU_ASSERT_EQUAL(memcmp(again, u + MODES, sizeof again), 0);
    evaluation_start(id[1], NULL, again, &e);
    e.failed = true;
    e.volume = 0.25;
    snprintf(e.reason, sizeof e.reason, "skin: folded at 'u' = 0.5");
    CU_ASSERT_TRUE(record_tell(&record, &e, NULL));

    CU_ASSERT_TRUE_FATAL(record_evaluations(&record, &list, &n));
    CU_ASSERT_EQUAL_FATAL(n, 3);
    CU_ASSERT_EQUAL(list[0].id, 0);
    CU_ASSERT_STRING_EQUAL(list[0].phase, "parent");
    CU_ASSERT_EQUAL(list[0].cw, 1e-3);
    CU_ASSERT_EQUAL(list[1].id, id[0]);
    CU_ASSERT_STRING_EQUAL(list[1].phase, "initial");
    CU_ASSERT_EQUAL(memcmp(list[1].u, u, MODES * sizeof *u), 0);
    CU_ASSERT_EQUAL(list[1].dofs, 468);
    CU_ASSERT_EQUAL(list[1].solve_seconds, 1.5);
    CU_ASSERT_EQUAL_FATAL(list[1].models, 1);
    CU_ASSERT_EQUAL(list[1].cw_model[0], 0.25);
    CU_ASSERT_EQUAL_FATAL(list[1].speeds, 2);
    CU_ASSERT_EQUAL(list[1].cw_speed[0], 1.0 / 3);
    CU_ASSERT_EQUAL(list[1].cw_speed[1], 2.0 / 3);
    CU_ASSERT_TRUE(isnan(list[1].volume));
    CU_ASSERT_FALSE(list[1].failed);
    CU_ASSERT_TRUE(list[2].failed && isnan(list[2].cw));
    CU_ASSERT_EQUAL(list[2].volume, 0.25);
    CU_ASSERT_STRING_EQUAL(list[2].reason, "skin: folded at 'u' = 0.5");
    free(list);
    record_close(&record);
}

static void test_verifications_and_sessions(void)
{
    struct record record;
    struct verification row = {.group = GROUP_SPEED,
                               .label = "Fr 0.28",
                               .formulation = "hogner",
                               .froude = 0.28,
                               .refine = 2,
                               .stern_length = NAN,
                               .cw_parent = 1e-3,
                               .cw_best = NAN,
                               .dofs_parent = 10,
                               .note = "optimum: too thin"};
    struct verification *list;
    size_t n, sessions;
    double seconds;
    fresh("rows.db", &record);
    CU_ASSERT_TRUE(record_put_verification(&record, 1, &row));
    row.refine = 1;
    row.group = GROUP_FILTER;
    CU_ASSERT_TRUE(record_put_verification(&record, 0, &row));
    CU_ASSERT_TRUE_FATAL(record_verifications(&record, &list, &n));
    CU_ASSERT_EQUAL_FATAL(n, 2);
    CU_ASSERT_EQUAL(list[0].refine, 1);
    CU_ASSERT_EQUAL(list[0].group, GROUP_FILTER);
    CU_ASSERT_EQUAL(list[1].refine, 2);
    CU_ASSERT_EQUAL(list[1].group, GROUP_SPEED);
    CU_ASSERT_EQUAL(list[1].cw_parent, 1e-3);
    CU_ASSERT_EQUAL(list[1].dofs_parent, 10);
    CU_ASSERT_TRUE(isnan(list[1].cw_best));
    CU_ASSERT_STRING_EQUAL(list[1].note, "optimum: too thin");
    free(list);

    CU_ASSERT_TRUE(record_begin_session(&record, 2, cli_seconds()));
    CU_ASSERT_TRUE(record_update_session(&record));
    CU_ASSERT_TRUE(record_begin_session(&record, 1, cli_seconds()));
    CU_ASSERT_TRUE(record_seconds(&record, &sessions, &seconds));
    CU_ASSERT_EQUAL(sessions, 2);
    CU_ASSERT_TRUE(seconds >= 0 && seconds < 60);
    record_close(&record);
}

static void check_refused(const char *part)
{
    struct record record;
    struct origin origin;
    CU_ASSERT_FALSE(record_read(path, &record, &origin));
    CU_ASSERT_PTR_NULL(record.bo);
    int said = strstr(core_sentence(), part) && strstr(core_sentence(), path);
    if (!said)
        fprintf(stderr, "the sentence was '%s', expected '%s' in it\n", core_sentence(), part);
    CU_ASSERT_TRUE(said);
}

static void test_foreign(void)
{
    struct record record;
    const double newer = 4;
    snprintf(path, sizeof path, "%s/text.db", folder);
    FILE *out = fopen(path, "w");
    for (int k = 0; k < 400; k++)
        fputs("this is not a database\n", out);
    fclose(out);
    check_refused("not a database");

    /* a study of the search alone */
    snprintf(path, sizeof path, "%s/study.db", folder);
    CU_ASSERT_TRUE_FATAL(search_open(&problem, path, &record));
    record_close(&record);
    check_refused("not the record of a hullopt run");

    fresh("newer.db", &record);
    CU_ASSERT_TRUE(record_put_array(&record, "hullopt.format", 1, 1, &newer));
    record_close(&record);
    check_refused("a newer hullopt wrote it: format 4");

    fresh("short.db", &record);
    CU_ASSERT_TRUE(record_put_array(&record, "latent.mean", 1, 1, &newer));
    record_close(&record);
    check_refused("latent space is damaged");
}

/* A page of the file overwritten, as a failing disk does. */
static void test_damaged(void)
{
    struct record record;
    double *values = calloc(20000, sizeof *values);
    fresh("damaged.db", &record);
    for (int k = 0; k < 8; k++) {
        char name[8];
        snprintf(name, sizeof name, "a%d", k);
        CU_ASSERT_TRUE(record_put_array(&record, name, 1, 20000, values));
    }
    free(values);
    record_close(&record);
    FILE *file = fopen(path, "r+");
    unsigned char noise[4096];
    for (size_t k = 0; k < sizeof noise; k++)
        noise[k] = (unsigned char)(7 * k + 3);
    for (long page = 1; page < 12; page++) {
        fseek(file, 4096 * page, SEEK_SET);
        fwrite(noise, 1, sizeof noise, file);
    }
    fclose(file);
    check_refused(path);
}

/* Reading changes nothing: neither the file nor its folder is touched. */
static void test_reading(void)
{
    char closed[160];
    struct record record;
    struct origin origin;
    struct stat before, after;
    snprintf(closed, sizeof closed, "%s/closed", folder);
    CU_ASSERT_EQUAL(mkdir(closed, 0700), 0);
    fresh("closed/run.db", &record);
    record_close(&record);
    CU_ASSERT_EQUAL(chmod(path, 0400), 0);
    CU_ASSERT_EQUAL(chmod(closed, 0500), 0);
    CU_ASSERT_EQUAL(stat(path, &before), 0);
    CU_ASSERT_TRUE(record_read(path, &record, &origin));
    CU_ASSERT_FALSE(record_put_text(&record, "stop", "no"));
    origin_free(&origin);
    record_close(&record);
    CU_ASSERT_EQUAL(stat(path, &after), 0);
    CU_ASSERT_TRUE(before.st_mtim.tv_sec == after.st_mtim.tv_sec &&
                   before.st_mtim.tv_nsec == after.st_mtim.tv_nsec);
    CU_ASSERT_EQUAL(chmod(closed, 0700), 0);
}

/* C_w and, raised, the displacement: 4 and 2 are dominated by 1 and 3; 5 would be the best of all
 * but failed. The set is 6 (1, 1), 3 (2, 2), 1 (3, 3) and the parent (5, 3.5), with ranges of 4 and
 * 2.5; squares of the distances from (1, 3.5) are 1, 0.4225, 0.29 and, not counted, 1. */
static void test_front(void)
{
    const double cw[6] = {3, 4, 2, 3.5, 0.5, 1}, volume[6] = {3, 2.5, 2, 2.9, 9, 1};
    const double origin[MODES] = {0, 0};
    const struct config_objective none = config.other[0];
    struct record record;
    struct evaluation e, *list;
    double u[6 * MODES];
    uint64_t id[6];
    size_t n, count, places[7];
    config.other[0] = (struct config_objective){QUANTITY_DISPLACEMENT, NAN, true, NULL};
    fresh("front.db", &record);
    evaluation_start(0, NULL, origin, &e);
    e.cw = e.objective = 5;
    e.volume = 3.5;
    CU_ASSERT_TRUE(record_tell(&record, &e, &e.volume));
    CU_ASSERT_EQUAL_FATAL(bayesopt_ask(record.bo, 6, u, id), BAYESOPT_OK);
    for (size_t i = 0; i < 6; i++) {
        evaluation_start(id[i], NULL, u + i * MODES, &e);
        e.cw = e.objective = cw[i];
        e.volume = volume[i];
        e.failed = i == 4;
        CU_ASSERT_TRUE(record_tell(&record, &e, &e.volume));
    }
    CU_ASSERT_TRUE_FATAL(record_evaluations(&record, &list, &n));
    CU_ASSERT_TRUE_FATAL(front_of(&record, n, list, &count, places));
    CU_ASSERT_EQUAL_FATAL(count, 4);
    const size_t expected[4] = {6, 3, 1, 0};
    CU_ASSERT_EQUAL(memcmp(places, expected, sizeof expected), 0);
    const struct evaluation *best;
    CU_ASSERT_TRUE(front_best(&record, &config, 4, n, list, &best));
    CU_ASSERT_PTR_EQUAL(best, &list[1]);
    config.other[0] = none;
    CU_ASSERT_TRUE(front_best(&record, &config, 4, n, list, &best));
    CU_ASSERT_PTR_EQUAL(best, &list[6]);
    free(list);
    record_close(&record);
}

static const struct check_case cases[] = {
    {"texts and arrays", test_texts_and_arrays},
    {"latent space and settings", test_origin},
    {"evaluations", test_evaluations},
    {"the Pareto set", test_front},
    {"verification rows and sessions", test_verifications_and_sessions},
    {"foreign, newer and incomplete files", test_foreign},
    {"a damaged file", test_damaged},
    {"reading alone", test_reading},
};

static void prepare(void)
{
    snprintf(folder, sizeof folder, "%s/hullopt_store_XXXXXX", check_scratch());
    CU_ASSERT_PTR_NOT_NULL_FATAL(mkdtemp(folder));
    make_problem();
}

int main(void)
{
    struct check_case all[1 + sizeof cases / sizeof *cases] = {{"a problem", prepare}};
    memcpy(all + 1, cases, sizeof cases);
    int code = check_main("hullopt store", all, sizeof all / sizeof *all);
    char command[160];
    problem_free(&problem);
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command) == 0 ? code : EXIT_FAILURE;
}
