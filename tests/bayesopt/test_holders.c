/* Who holds pending points: signs of life, points gone stale, sessions of other machines. */
#include "check.h"

#include <bayesopt/bayesopt.h>

#include <sqlite3.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

static char path[256];

static void execute(const char *sql)
{
    sqlite3 *db;
    CU_ASSERT_EQUAL_FATAL(sqlite3_open(path, &db), SQLITE_OK);
    CU_ASSERT_EQUAL(sqlite3_exec(db, sql, NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
}

/* A store with points 1 to 3 asked 1000 seconds ago; detached unless the session is kept. */
static bayesopt *start(const char *name, bool keep)
{
    const double lower = 0, upper = 1;
    double x[3];
    uint64_t ids[3];
    bayesopt *bo = NULL;
    snprintf(path, sizeof path, "%s/bayesopt_%s_%ld.db", check_scratch(), name, (long)getpid());
    remove(path);
    CU_ASSERT_EQUAL_FATAL(bayesopt_create(1, &lower, &upper, NULL, &bo), BAYESOPT_OK);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_store(bo, path), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_ask(bo, 3, x, ids), BAYESOPT_OK);
    if (keep)
        return bo;
    CU_ASSERT_EQUAL(bayesopt_detach(bo), BAYESOPT_OK);
    bayesopt_free(bo);
    execute("UPDATE bayesopt_points SET asked = asked - 1000");
    CU_ASSERT_EQUAL_FATAL(bayesopt_open(path, NULL, NULL, &bo), BAYESOPT_OK);
    return bo;
}

static uint64_t ask(bayesopt *bo)
{
    double x;
    uint64_t id = 0;
    CU_ASSERT_EQUAL(bayesopt_ask(bo, 1, &x, &id), BAYESOPT_OK);
    return id;
}

static void stale_points(void)
{
    bayesopt *bo = start("stale", false);
    bayesopt_holder holder;
    CU_ASSERT_EQUAL(bayesopt_get_holder(bo, 2, &holder), BAYESOPT_OK);
    CU_ASSERT(holder.detached && holder.asked >= 1000 && holder.heard >= 1000);
    CU_ASSERT(holder.process == getpid() && *holder.host);
    CU_ASSERT_EQUAL(bayesopt_heartbeat(bo, 2), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_get_holder(bo, 2, &holder), BAYESOPT_OK);
    CU_ASSERT(holder.asked >= 1000 && holder.heard < 500);
    CU_ASSERT_EQUAL(bayesopt_reclaim_stale(bo, 5000), BAYESOPT_OK);
    CU_ASSERT_EQUAL(ask(bo), 4);
    CU_ASSERT_EQUAL(bayesopt_reclaim_stale(bo, 500), BAYESOPT_OK);
    CU_ASSERT_EQUAL(ask(bo), 1); /* 2 was heard of */
    CU_ASSERT_EQUAL(ask(bo), 3);
    CU_ASSERT_EQUAL(bayesopt_reclaim_stale(bo, 500), BAYESOPT_OK);
    CU_ASSERT_EQUAL(ask(bo), 5); /* none twice */
    CU_ASSERT_EQUAL(bayesopt_reclaim(bo), BAYESOPT_OK);
    CU_ASSERT_EQUAL(ask(bo), 2);
    CU_ASSERT_EQUAL(bayesopt_get_holder(bo, 2, &holder), BAYESOPT_OK);
    CU_ASSERT(holder.alive && !holder.detached && holder.process == getpid());
    CU_ASSERT_EQUAL(bayesopt_tell(bo, 2, 0, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_get_holder(bo, 2, &holder), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_heartbeat(bo, 2), BAYESOPT_ERROR_ARGUMENT);
    bayesopt_free(bo);
    remove(path);
}

/* What a session of this machine that still runs holds is never given to another. */
static void living_sessions(void)
{
    bayesopt *bo = start("living", true), *other;
    execute("UPDATE bayesopt_points SET asked = asked - 1000");
    CU_ASSERT_EQUAL_FATAL(bayesopt_open(path, NULL, NULL, &other), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_reclaim_stale(other, 1), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_reclaim(other), BAYESOPT_OK);
    CU_ASSERT_EQUAL(ask(other), 4);
    bayesopt_free(other);
    bayesopt_free(bo);
    remove(path);
}

/* Of a session elsewhere only its signs of life tell. */
static void sessions_elsewhere(void)
{
    bayesopt *bo = start("elsewhere", true), *other;
    bayesopt_holder holder;
    execute("UPDATE bayesopt_points SET asked = asked - 1000;"
            "UPDATE bayesopt_sessions SET host = 'node17 boot', pid = 1");
    CU_ASSERT_EQUAL_FATAL(bayesopt_open(path, NULL, NULL, &other), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_get_holder(other, 1, &holder), BAYESOPT_OK);
    CU_ASSERT(holder.alive && holder.process == 1);
    CU_ASSERT_STRING_EQUAL(holder.host, "node17");
    CU_ASSERT_EQUAL(bayesopt_reclaim(other), BAYESOPT_OK);
    CU_ASSERT_EQUAL(ask(other), 4);
    CU_ASSERT_EQUAL(bayesopt_heartbeat(bo, 0), BAYESOPT_OK); /* the session's three */
    CU_ASSERT_EQUAL(bayesopt_reclaim_stale(other, 500), BAYESOPT_OK);
    CU_ASSERT_EQUAL(ask(other), 5);
    execute("UPDATE bayesopt_points SET heard = heard - 1000");
    CU_ASSERT_EQUAL(bayesopt_reclaim_stale(other, 500), BAYESOPT_OK);
    CU_ASSERT_EQUAL(ask(other), 1);
    bayesopt_free(other);
    bayesopt_free(bo);
    remove(path);
}

static const struct check_case cases[] = {{"stale points", stale_points},
                                          {"living sessions", living_sessions},
                                          {"sessions elsewhere", sessions_elsewhere}};

CHECK_MAIN("bayesopt holders", cases)
