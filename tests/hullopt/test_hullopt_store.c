/* The database of a run: what goes in comes out, and what is not a run is refused. */
#include "capture.h"
#include "check.h"
#include "cli.h"
#include "store.h"

#include <sqlite3.h>
#include <stdlib.h>

static char folder[120];
static char path[200];

static struct store *fresh(const char *name)
{
    snprintf(path, sizeof path, "%s/%s", folder, name);
    struct store *store = store_create(path);
    CU_ASSERT_PTR_NOT_NULL_FATAL(store);
    CU_ASSERT_TRUE(store_put_text(store, "configuration", "a = 1\n"));
    return store;
}

static void test_texts_and_arrays(void)
{
    struct store *store = fresh("texts.db");
    CU_ASSERT_TRUE(store_put_text(store, "stop", "first"));
    CU_ASSERT_TRUE(store_put_text(store, "stop", "second"));
    char *text = store_get_text(store, "stop");
    CU_ASSERT_STRING_EQUAL_FATAL(text, "second");
    free(text);
    CU_ASSERT_PTR_NULL(store_get_text(store, "nothing"));

    const double values[6] = {1, -0.0, NAN, INFINITY, 1e-310, 1.0 / 3};
    size_t rows = 0, columns = 0;
    CU_ASSERT_TRUE(store_put_array(store, "a", 2, 3, values));
    double *back = store_get_array(store, "a", &rows, &columns);
    CU_ASSERT_PTR_NOT_NULL_FATAL(back);
    CU_ASSERT_EQUAL(rows, 2);
    CU_ASSERT_EQUAL(columns, 3);
    CU_ASSERT_EQUAL(memcmp(values, back, sizeof values), 0);
    free(back);
    CU_ASSERT_PTR_NULL(store_get_array(store, "b", &rows, &columns));
    store_close(store);
}

static void test_latent(void)
{
    struct store *store = fresh("latent.db");
    struct latent l = {.modes = 2,
                       .coordinates = 6,
                       .spectrum = 3,
                       .samples = 40,
                       .parameters = 4,
                       .active = 5,
                       .retained = 0.97,
                       .trace = 3.5};
    struct latent back;
    CU_ASSERT_TRUE_FATAL(latent_allocate(&l));
    for (size_t k = 0; k < 12; k++)
        l.vectors[k] = 1.0 / (double)(k + 1);
    for (size_t k = 0; k < 3; k++)
        l.eigenvalues[k] = 3.0 - (double)k;
    l.lower[1] = -4;
    l.upper[1] = 5;
    l.mean[3] = 0.25;
    l.mse[2] = 1e-9;
    CU_ASSERT_TRUE(store_put_latent(store, &l));
    CU_ASSERT_TRUE_FATAL(store_get_latent(store, &back));
    CU_ASSERT_EQUAL(back.modes, 2);
    CU_ASSERT_EQUAL(back.coordinates, 6);
    CU_ASSERT_EQUAL(back.parameters, 4);
    CU_ASSERT_EQUAL(back.active, 5);
    CU_ASSERT_EQUAL(back.samples, 40);
    CU_ASSERT_EQUAL(back.retained, 0.97);
    CU_ASSERT_EQUAL(memcmp(back.vectors, l.vectors, 12 * sizeof(double)), 0);
    CU_ASSERT_EQUAL(memcmp(back.eigenvalues, l.eigenvalues, 3 * sizeof(double)), 0);
    CU_ASSERT_EQUAL(back.lower[1], -4);
    CU_ASSERT_EQUAL(back.upper[1], 5);
    CU_ASSERT_EQUAL(back.mean[3], 0.25);
    CU_ASSERT_EQUAL(back.mse[2], 1e-9);

    const double u[2] = {2, -3};
    double d[6];
    latent_displace(&back, u, d);
    for (size_t k = 0; k < 6; k++)
        CHECK_CLOSE(d[k], l.mean[k] + 2 * l.vectors[k] - 3 * l.vectors[6 + k], 1e-16);
    latent_free(&l);
    latent_free(&back);
    store_close(store);
}

static void fill(struct evaluation *e, uint64_t id)
{
    CU_ASSERT_TRUE_FATAL(evaluation_create(3, e));
    e->id = id;
    e->u[0] = (double)id;
    e->u[1] = 1.0 / 3;
    e->cw = 1e-3 / (double)(id + 1);
    e->dofs = 468;
    e->solve_seconds = 1.5;
    snprintf(e->phase, sizeof e->phase, "initial");
}

static void test_evaluations(void)
{
    struct store *store = fresh("evaluations.db");
    struct evaluation e, back, *list;
    size_t n;
    fill(&e, 7);
    CU_ASSERT_TRUE(store_put_evaluation(store, 3, &e));
    CU_ASSERT_EQUAL(store_find_evaluation(store, 6, 3, &back), 0);
    CU_ASSERT_EQUAL_FATAL(store_find_evaluation(store, 7, 3, &back), 1);
    CU_ASSERT_EQUAL(memcmp(back.u, e.u, 3 * sizeof(double)), 0);
    CU_ASSERT_EQUAL(back.cw, e.cw);
    CU_ASSERT_EQUAL(back.dofs, 468);
    CU_ASSERT_EQUAL(back.solve_seconds, 1.5);
    CU_ASSERT_TRUE(isnan(back.volume));
    CU_ASSERT_FALSE(back.failed);
    CU_ASSERT_STRING_EQUAL(back.phase, "initial");
    evaluation_free(&back);

    struct capture capture;
    char sentence[400];
    capture_begin(&capture);
    bool twice = store_put_evaluation(store, 3, &e);
    capture_end(&capture, sentence, sizeof sentence);
    CU_ASSERT_FALSE(twice);
    evaluation_free(&e);

    fill(&e, 2);
    e.failed = true;
    e.cw = NAN;
    snprintf(e.stage, sizeof e.stage, "skin");
    snprintf(e.reason, sizeof e.reason, "folded at 'u' = 0.5");
    CU_ASSERT_TRUE(store_put_evaluation(store, 3, &e));
    evaluation_free(&e);
    CU_ASSERT_TRUE_FATAL(store_list_evaluations(store, 3, &list, &n));
    CU_ASSERT_EQUAL_FATAL(n, 2);
    CU_ASSERT_EQUAL(list[0].id, 2);
    CU_ASSERT_TRUE(list[0].failed);
    CU_ASSERT_TRUE(isnan(list[0].cw));
    CU_ASSERT_STRING_EQUAL(list[0].reason, "folded at 'u' = 0.5");
    CU_ASSERT_EQUAL(list[1].id, 7);
    for (size_t i = 0; i < n; i++)
        evaluation_free(&list[i]);
    free(list);
    store_close(store);
}

static void test_verifications_and_sessions(void)
{
    struct store *store = fresh("rows.db");
    struct verification row = {.group = "speed",
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
    CU_ASSERT_TRUE(store_put_verification(store, 1, &row));
    row.refine = 1;
    CU_ASSERT_TRUE(store_put_verification(store, 0, &row));
    CU_ASSERT_TRUE_FATAL(store_list_verifications(store, &list, &n));
    CU_ASSERT_EQUAL_FATAL(n, 2);
    CU_ASSERT_EQUAL(list[0].refine, 1);
    CU_ASSERT_EQUAL(list[1].refine, 2);
    CU_ASSERT_EQUAL(list[1].cw_parent, 1e-3);
    CU_ASSERT_TRUE(isnan(list[1].cw_best));
    CU_ASSERT_STRING_EQUAL(list[1].note, "optimum: too thin");
    free(list);

    CU_ASSERT_TRUE(store_begin_session(store, 2, cli_seconds()));
    CU_ASSERT_TRUE(store_update_session(store));
    CU_ASSERT_TRUE(store_begin_session(store, 1, cli_seconds()));
    double seconds = store_total_seconds(store, &sessions);
    CU_ASSERT_EQUAL(sessions, 2);
    CU_ASSERT_TRUE(seconds >= 0 && seconds < 60);
    store_close(store);
}

static void check_unusable(const char *part)
{
    struct capture capture;
    char sentence[600];
    capture_begin(&capture);
    enum store_state state = store_probe(path);
    capture_end(&capture, sentence, sizeof sentence);
    CU_ASSERT_EQUAL(state, STORE_UNUSABLE);
    CU_ASSERT_TRUE(capture_is_sentence(sentence));
    CU_ASSERT_PTR_NOT_NULL(strstr(sentence, part));
    if (!strstr(sentence, part))
        fprintf(stderr, "the sentence was '%s', expected '%s' in it\n", sentence, part);
}

static void test_probe(void)
{
    snprintf(path, sizeof path, "%s/absent.db", folder);
    CU_ASSERT_EQUAL(store_probe(path), STORE_ABSENT);
    store_close(fresh("run.db"));
    CU_ASSERT_EQUAL(store_probe(path), STORE_RUN);

    snprintf(path, sizeof path, "%s/text.db", folder);
    FILE *out = fopen(path, "w");
    for (int k = 0; k < 400; k++)
        fputs("this is not a database\n", out);
    fclose(out);
    check_unusable("text.db: ");

    sqlite3 *db;
    snprintf(path, sizeof path, "%s/other.db", folder);
    CU_ASSERT_EQUAL(sqlite3_open(path, &db), SQLITE_OK);
    CU_ASSERT_EQUAL(sqlite3_exec(db, "CREATE TABLE a (b)", NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
    check_unusable("not the database of a hullopt run");
}

/* A page of the file overwritten, as a failing disk does. */
static void test_damaged(void)
{
    struct store *store = fresh("damaged.db");
    double *values = calloc(20000, sizeof *values);
    for (int k = 0; k < 8; k++) {
        char name[8];
        snprintf(name, sizeof name, "a%d", k);
        CU_ASSERT_TRUE(store_put_array(store, name, 1, 20000, values));
    }
    free(values);
    store_close(store);
    CU_ASSERT_EQUAL(store_probe(path), STORE_RUN);
    FILE *file = fopen(path, "r+");
    unsigned char noise[4096];
    for (size_t k = 0; k < sizeof noise; k++)
        noise[k] = (unsigned char)(7 * k + 3);
    for (long page = 1; page < 12; page++) {
        fseek(file, 4096 * page, SEEK_SET);
        fwrite(noise, 1, sizeof noise, file);
    }
    fclose(file);
    check_unusable("damaged");
}

static const struct check_case cases[] = {
    {"texts and arrays", test_texts_and_arrays},
    {"latent space", test_latent},
    {"evaluations", test_evaluations},
    {"verification rows and sessions", test_verifications_and_sessions},
    {"absent, foreign and proper files", test_probe},
    {"a damaged file", test_damaged},
};

int main(void)
{
    snprintf(folder, sizeof folder, "%s/hullopt_store_XXXXXX", check_scratch());
    if (!mkdtemp(folder))
        return EXIT_FAILURE;
    int code = check_main("hullopt store", cases, sizeof cases / sizeof *cases);
    char command[160];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command) == 0 ? code : EXIT_FAILURE;
}
