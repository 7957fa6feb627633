/* Who is working on a store: sessions, and the pending points of those that are gone. */
#include "core/error.h"
#include "store/store_internal.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Start time of a process in clock ticks since boot (field 22 of /proc/PID/stat), which tells it
 * from a later one with the same number; 0 where there is no such file. */
static int64_t start_time(int64_t pid)
{
    char path[64], line[1024];
    long long ticks = 0;
    snprintf(path, sizeof path, "/proc/%lld/stat", (long long)pid);
    FILE *file = fopen(path, "r");
    if (!file)
        return 0;
    const char *at = fgets(line, sizeof line, file) ? strrchr(line, ')') : NULL;
    for (int field = 2; at && field < 22; field++)
        at = strchr(at + 1, ' ');
    if (at)
        ticks = strtoll(at, NULL, 10);
    fclose(file);
    return ticks;
}

/* The machine, and its present boot where the system tells. */
static void this_host(char *host, size_t size)
{
    char boot[64] = "";
    host[0] = '\0';
    if (gethostname(host, size - sizeof boot) != 0)
        snprintf(host, size, "localhost");
    host[size - sizeof boot - 1] = '\0';
    FILE *file = fopen("/proc/sys/kernel/random/boot_id", "r");
    if (file) {
        if (!fgets(boot, sizeof boot, file))
            boot[0] = '\0';
        fclose(file);
    }
    boot[strcspn(boot, "\n")] = '\0';
    size_t used = strlen(host);
    snprintf(host + used, size - used, " %s", boot);
}

bayesopt_status store_session_start(struct bayesopt *bo)
{
    char host[320];
    sqlite3_stmt *s;
    bayesopt_status status = store_prepare(
        bo->store, "INSERT INTO bayesopt_sessions(host, pid, started, ended) VALUES(?, ?, ?, 0)",
        &s);
    if (status)
        return status;
    this_host(host, sizeof host);
    sqlite3_bind_text(s, 1, host, -1, SQLITE_STATIC);
    sqlite3_bind_int64(s, 2, getpid());
    sqlite3_bind_int64(s, 3, start_time(getpid()));
    if (sqlite3_step(s) != SQLITE_DONE)
        status = store_error(bo->store, "writing the store");
    sqlite3_finalize(s);
    bo->session = sqlite3_last_insert_rowid(bo->store->db);
    return status;
}

void store_session_end(struct bayesopt *bo)
{
    sqlite3_stmt *s;
    if (store_prepare(bo->store, "UPDATE bayesopt_sessions SET ended = 1 WHERE id = ?", &s))
        return;
    /* Should this fail the session is found dead by its process instead. */
    sqlite3_bind_int64(s, 1, bo->session);
    sqlite3_step(s);
    sqlite3_finalize(s);
}

/* Whether some process still answers for a session. */
enum life { DEAD, ALIVE, ELSEWHERE /* on another machine, where that cannot be seen */ };

static bayesopt_status session_life(struct bayesopt *bo, int64_t session, enum life *life,
                                    struct bayesopt_holder *holder)
{
    sqlite3_stmt *s;
    *life = DEAD;
    bayesopt_status status = store_prepare(
        bo->store, "SELECT host, pid, started, ended FROM bayesopt_sessions WHERE id = ?", &s);
    if (status)
        return status;
    sqlite3_bind_int64(s, 1, session);
    bool found = sqlite3_step(s) == SQLITE_ROW;
    if (found && holder) {
        const char *theirs = (const char *)sqlite3_column_text(s, 0);
        snprintf(holder->host, sizeof holder->host, "%.*s", theirs ? (int)strcspn(theirs, " ") : 0,
                 theirs ? theirs : "");
        holder->process = sqlite3_column_int64(s, 1);
    }
    if (found && !sqlite3_column_int(s, 3)) {
        char host[320];
        const char *theirs = (const char *)sqlite3_column_text(s, 0);
        int64_t pid = sqlite3_column_int64(s, 1), started = sqlite3_column_int64(s, 2);
        this_host(host, sizeof host);
        size_t name = strcspn(host, " ") + 1;
        bool runs = (kill((pid_t)pid, 0) == 0 || errno == EPERM) && start_time(pid) == started;
        if (!theirs || strncmp(host, theirs, name) != 0)
            *life = ELSEWHERE;
        else if (strcmp(host, theirs) == 0 && runs)
            *life = ALIVE;
    }
    sqlite3_finalize(s);
    return status;
}

/* Whether a point was last asked, or heard of, so many seconds ago. */
static bayesopt_status is_stale(struct bayesopt *bo, uint64_t id, double age, bool *stale)
{
    sqlite3_stmt *s;
    bayesopt_status status = store_prepare(
        bo->store,
        "SELECT strftime('%s', 'now') - max(asked, ifnull(heard, asked)) FROM bayesopt_points "
        "WHERE id = ?1",
        &s);
    if (status)
        return status;
    sqlite3_bind_int64(s, 1, (int64_t)id);
    *stale = sqlite3_step(s) != SQLITE_ROW || sqlite3_column_double(s, 0) >= age;
    sqlite3_finalize(s);
    return status;
}

bayesopt_status store_touch(struct bayesopt *bo, const struct point *point)
{
    sqlite3_stmt *s;
    if (!bo->store)
        return BAYESOPT_OK;
    bayesopt_status status = store_prepare(
        bo->store, "UPDATE bayesopt_points SET asked = strftime('%s', 'now') WHERE id = ?1", &s);
    if (status)
        return status;
    sqlite3_bind_int64(s, 1, (int64_t)point->id);
    if (sqlite3_step(s) != SQLITE_DONE)
        status = store_error(bo->store, "writing the store");
    sqlite3_finalize(s);
    return status;
}

bayesopt_status store_release_orphans(struct bayesopt *bo, bool reclaim, double age)
{
    bayesopt_status status = BAYESOPT_OK;
    int64_t judged = 0;
    enum life life = ALIVE;
    for (size_t i = 0; bo->store && i < bo->n_points && !status; i++) {
        struct point *p = &bo->points[i];
        if (p->state != BAYESOPT_STATE_PENDING || p->session == 0 || p->session == bo->session ||
            (p->detached && !reclaim))
            continue;
        if (p->session != judged)
            status = session_life(bo, p->session, &life, NULL);
        judged = p->session;
        bool stale = true;
        if (!status && life != ALIVE && age > 0)
            status = is_stale(bo, p->id, age, &stale);
        if (status || life == ALIVE || !stale || (life == ELSEWHERE && !(age > 0)))
            continue;
        p->session = 0;
        p->detached = false;
        status = store_update(bo, p);
    }
    return status;
}

bayesopt_status bayesopt_reclaim(bayesopt *bo)
{
    return bayesopt_reclaim_stale(bo, 0);
}

bayesopt_status bayesopt_reclaim_stale(bayesopt *bo, double seconds)
{
    NEED(bo);
    if (!(seconds >= 0))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "stale after %g seconds, expected not negative", seconds);
    bayesopt_status status = store_begin(bo);
    if (status)
        return status;
    if (!bo->store)
        return BAYESOPT_OK;
    status = store_release_orphans(bo, true, seconds);
    if (!status)
        status = store_commit(bo);
    if (status)
        store_rollback(bo);
    return status;
}

bayesopt_status bayesopt_detach(bayesopt *bo)
{
    NEED(bo);
    bayesopt_status status = store_begin(bo);
    for (size_t i = 0; bo->store && i < bo->n_points && !status; i++) {
        struct point *p = &bo->points[i];
        if (p->state != BAYESOPT_STATE_PENDING || p->session != bo->session)
            continue;
        p->detached = true;
        status = store_update(bo, p);
    }
    if (!status)
        status = store_commit(bo);
    if (status)
        store_rollback(bo);
    return status;
}

static bayesopt_status find_pending(struct bayesopt *bo, uint64_t id, struct point **p)
{
    *p = history_find(bo, id);
    bool pending = *p && (*p)->state == BAYESOPT_STATE_PENDING;
    return pending ? BAYESOPT_OK
                   : bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "point %llu is not pending",
                                   (unsigned long long)id);
}

static bayesopt_status store_hear(struct bayesopt *bo, uint64_t id)
{
    sqlite3_stmt *s;
    bayesopt_status status = store_prepare(
        bo->store, "UPDATE bayesopt_points SET heard = strftime('%s', 'now') WHERE id = ?1", &s);
    if (status)
        return status;
    sqlite3_bind_int64(s, 1, (int64_t)id);
    if (sqlite3_step(s) != SQLITE_DONE)
        status = store_error(bo->store, "writing the store");
    sqlite3_finalize(s);
    return status;
}

bayesopt_status bayesopt_heartbeat(bayesopt *bo, uint64_t id)
{
    NEED(bo);
    struct point *p = NULL;
    bayesopt_status status = store_begin(bo);
    if (status)
        return status;
    if (id)
        status = find_pending(bo, id, &p);
    for (size_t i = 0; bo->store && i < bo->n_points && !status; i++) {
        const struct point *q = &bo->points[i];
        if (q->state == BAYESOPT_STATE_PENDING && (id ? q->id == id : q->session == bo->session))
            status = store_hear(bo, q->id);
    }
    if (!status)
        status = store_commit(bo);
    if (status)
        store_rollback(bo);
    return status;
}

bayesopt_status bayesopt_get_holder(bayesopt *bo, uint64_t id, bayesopt_holder *holder)
{
    NEED(bo);
    NEED(holder);
    struct point *p;
    sqlite3_stmt *s;
    enum life life = ALIVE;
    bayesopt_status status = find_pending(bo, id, &p);
    if (status)
        return status;
    *holder = (bayesopt_holder){.alive = true, .detached = p->detached};
    if (!bo->store) {
        holder->process = getpid();
        return BAYESOPT_OK;
    }
    status = session_life(bo, p->session, &life, holder);
    holder->alive = life != DEAD;
    if (!status)
        status =
            store_prepare(bo->store,
                          "SELECT strftime('%s', 'now') - asked, strftime('%s', 'now') - "
                          "max(asked, ifnull(heard, asked)) FROM bayesopt_points WHERE id = ?1",
                          &s);
    if (status)
        return status;
    sqlite3_bind_int64(s, 1, (int64_t)id);
    if (sqlite3_step(s) == SQLITE_ROW) {
        holder->asked = sqlite3_column_double(s, 0);
        holder->heard = sqlite3_column_double(s, 1);
    } else {
        status = store_error(bo->store, "reading the store");
    }
    sqlite3_finalize(s);
    return status;
}
