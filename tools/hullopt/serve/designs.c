#include "serve/designs.h"

#include "cli.h"
#include "core/problem.h"
#include "core/slopes.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#define STOPPING "the server is stopping"

enum { VARIANTS = 8 };

/* The parent under a variant, as its options were frozen on it. */
struct frozen {
    struct variant variant;
    igabem_options solver, speed[CONFIG_FROUDE_MOST];
    size_t speeds;
    struct evaluation parent;
};

struct job {
    const double *u;
    const struct variant *variant;
    bool is_derivative; /* output: the Jacobian of C_w by speed, not the figures */
    double *output;
    struct served_error *error;
    bool ok, is_done;
    struct job *next;
};

struct worker {
    struct designs *designs;
    pthread_t thread;
    struct config config; /* of the variant at hand */
    struct problem problem;
    struct frozen frozen[VARIANTS];
    size_t n_frozen;
};

struct designs {
    const struct config *config;
    int threads;
    pthread_mutex_t lock;
    pthread_cond_t asked, answered; /* a job waits, or the end; one is done, or a worker ready */
    struct job *first, **last;
    atomic_bool is_stopping;
    size_t n, ready, failed;
    char sentence[SENTENCE_SIZE]; /* why a worker failed to start */
    struct worker *workers;
};

static int cancel(void *user_data, double fraction)
{
    (void)fraction;
    return atomic_load(&((struct designs *)user_data)->is_stopping);
}

static bool prepare(struct worker *w)
{
    const struct core_watch nobody = {0};
    w->config = *w->designs->config;
    w->config.solver.threads = w->designs->threads;
    w->config.solver.progress = cancel;
    w->config.solver.progress_user_data = w->designs;
    if (!problem_read(&w->config, &w->problem))
        return false;
    galv_shape *shape = problem_shape(&w->problem);
    bool ok = (shape || core_fail("%s: the shape cannot be read", w->config.shape)) &&
              problem_reduce(&w->problem, shape, &nobody);
    galv_shape_free(shape);
    return ok;
}

/* Puts the options of a variant that was met before, or freezes them; returns its parent, NULL
 * when that has no value. */
static const struct evaluation *set_variant(struct worker *w, const struct variant *v)
{
    struct problem *p = &w->problem;
    struct config run = *w->designs->config;
    run.solver = w->config.solver;
    variant_apply(v, &run, &w->config);
    size_t k = 0;
    while (k < w->n_frozen && k < VARIANTS && !variant_equal(&w->frozen[k].variant, v))
        k++;
    bool is_known = k < w->n_frozen && k < VARIANTS;
    struct frozen *f = &w->frozen[is_known ? k : w->n_frozen % VARIANTS];
    if (is_known) {
        p->solver = f->solver;
        p->speeds = f->speeds;
        for (size_t i = 0; i < p->speeds; i++)
            p->speed[i] = f->speed[i];
        return &f->parent;
    }
    if (!problem_freeze(p))
        return NULL;
    evaluation_start(0, "parent", NULL, &f->parent);
    evaluate_parent(p, &f->parent, NULL, NULL);
    if (f->parent.failed) {
        core_fail("the parent: %s", f->parent.reason);
        return NULL;
    }
    f->variant = *v;
    f->solver = p->solver;
    f->speeds = p->speeds;
    for (size_t i = 0; i < p->speeds; i++)
        f->speed[i] = p->speed[i];
    w->n_frozen++;
    return &f->parent;
}

/* Whatever failed, when the server is stopping that is why. */
static bool fail_job(const struct worker *w, const struct job *job, const char *reason)
{
    return atomic_load(&w->designs->is_stopping)
               ? served_fail(job->error, SERVED_UNAVAILABLE, STOPPING)
               : served_fail(job->error, SERVED_INVALID_OUTPUT, "%s", reason);
}

static bool evaluate_job(struct worker *w, const struct job *job, const struct evaluation *parent)
{
    struct evaluation e;
    evaluation_start(1, "served", job->u, &e);
    evaluate(&w->problem, &e, NULL, NULL);
    if (e.no_memory) /* another server may know more of the design */
        return served_fail(job->error, SERVED_UNAVAILABLE, "%s", e.reason);
    if (e.failed)
        return fail_job(w, job, e.reason);
    variant_output(job->variant, w->designs->config, parent, &e, job->output);
    return true;
}

static bool differentiate_job(struct worker *w, const struct job *job)
{
    size_t modes = galv_model_modes(w->problem.model);
    struct slopes slopes;
    slopes_start(&w->problem, &slopes);
    bool has = slopes.has[0]; /* one formulation at all speeds */
    bool ok = has && slopes_open(&slopes, job->u);
    for (size_t m = 0; m < slopes.n && ok; m++)
        ok = slopes_cw(&slopes, m, job->output + m * modes);
    slopes_end(&slopes);
    if (!has)
        return served_fail(job->error, SERVED_UNSUPPORTED, "C_w by '%s' has no derivatives",
                           igabem_formulation_name(job->variant->formulation));
    return ok || fail_job(w, job, core_sentence());
}

static bool do_job(struct worker *w, const struct job *job)
{
    const struct evaluation *parent = set_variant(w, job->variant);
    if (!parent)
        return fail_job(w, job, core_sentence());
    return job->is_derivative ? differentiate_job(w, job) : evaluate_job(w, job, parent);
}

/* The next job, or NULL at the end. */
static struct job *take(struct designs *d)
{
    pthread_mutex_lock(&d->lock);
    while (!d->first && !atomic_load(&d->is_stopping))
        pthread_cond_wait(&d->asked, &d->lock);
    struct job *job = atomic_load(&d->is_stopping) ? NULL : d->first;
    if (job) {
        d->first = job->next;
        d->last = d->first ? d->last : &d->first;
    }
    pthread_mutex_unlock(&d->lock);
    return job;
}

static void finish(struct designs *d, struct job *job, bool ok)
{
    pthread_mutex_lock(&d->lock);
    job->ok = ok;
    job->is_done = true;
    pthread_cond_broadcast(&d->answered);
    pthread_mutex_unlock(&d->lock);
}

static void report_ready(struct designs *d, bool ok)
{
    pthread_mutex_lock(&d->lock);
    if (!ok && d->failed == 0)
        snprintf(d->sentence, sizeof d->sentence, "%s", core_sentence());
    d->failed += !ok;
    d->ready += ok;
    pthread_cond_broadcast(&d->answered);
    pthread_mutex_unlock(&d->lock);
}

static void *work(void *argument)
{
    struct worker *w = argument;
    struct job *job;
    cli_set_threads(w->designs->threads);
    bool ok = prepare(w);
    report_ready(w->designs, ok);
    while (ok && (job = take(w->designs)) != NULL)
        finish(w->designs, job, do_job(w, job));
    return NULL;
}

static bool wait_for(struct designs *d, struct job *job)
{
    pthread_mutex_lock(&d->lock);
    if (atomic_load(&d->is_stopping)) {
        job->is_done = true;
        served_fail(job->error, SERVED_UNAVAILABLE, STOPPING);
    } else {
        *d->last = job;
        d->last = &job->next;
        pthread_cond_signal(&d->asked);
    }
    while (!job->is_done)
        pthread_cond_wait(&d->answered, &d->lock);
    pthread_mutex_unlock(&d->lock);
    return job->ok;
}

bool designs_evaluate(struct designs *d, const double *u, const struct variant *variant,
                      double *output, struct served_error *error)
{
    return wait_for(d, &(struct job){.u = u, .variant = variant, .output = output, .error = error});
}

bool designs_differentiate(struct designs *d, const double *u, const struct variant *variant,
                           double *jacobian, struct served_error *error)
{
    return wait_for(
        d,
        &(struct job){
            .u = u, .variant = variant, .is_derivative = true, .output = jacobian, .error = error});
}

size_t designs_modes(const struct designs *d)
{
    return galv_model_modes(d->workers[0].problem.model);
}

const struct problem *designs_problem(const struct designs *d)
{
    return &d->workers[0].problem;
}

const double *designs_lower(const struct designs *d)
{
    return galv_model_lower(d->workers[0].problem.model);
}

const double *designs_upper(const struct designs *d)
{
    return galv_model_upper(d->workers[0].problem.model);
}

bool designs_have_derivatives(const struct designs *d)
{
    const struct problem *problem = designs_problem(d);
    return !config_by_command(d->config) && !d->config->free_to_trim &&
           slopes_has(problem, &problem->solver);
}

void designs_stop(struct designs *d)
{
    pthread_mutex_lock(&d->lock);
    atomic_store(&d->is_stopping, true);
    for (struct job *job = d->first; job; job = job->next) {
        served_fail(job->error, SERVED_UNAVAILABLE, STOPPING);
        job->is_done = true;
    }
    d->first = NULL;
    d->last = &d->first;
    pthread_cond_broadcast(&d->asked);
    pthread_cond_broadcast(&d->answered);
    pthread_mutex_unlock(&d->lock);
}

/* Waits until every worker is ready or has failed. */
static bool are_ready(struct designs *d)
{
    pthread_mutex_lock(&d->lock);
    while (d->ready + d->failed < d->n)
        pthread_cond_wait(&d->answered, &d->lock);
    pthread_mutex_unlock(&d->lock);
    return d->failed == 0 || core_fail("%s", d->sentence);
}

/* n becomes the number of threads that could be had. */
static bool start_workers(struct designs *d, size_t n)
{
    for (d->n = 0; d->n < n; d->n++) {
        struct worker *w = &d->workers[d->n];
        w->designs = d;
        if (pthread_create(&w->thread, NULL, work, w) != 0)
            return core_fail("a thread cannot be had for worker %zu", d->n + 1);
    }
    return true;
}

struct designs *designs_start(const struct config *config, size_t n, int threads)
{
    struct designs *d = calloc(1, sizeof *d);
    struct worker *workers = calloc(n, sizeof *workers);
    if (!d || !workers) {
        free(d);
        free(workers);
        core_no_memory();
        return NULL;
    }
    d->config = config;
    d->threads = threads;
    d->workers = workers;
    d->last = &d->first;
    pthread_mutex_init(&d->lock, NULL);
    pthread_cond_init(&d->asked, NULL);
    pthread_cond_init(&d->answered, NULL);
    atomic_init(&d->is_stopping, false);
    if (start_workers(d, n) && are_ready(d))
        return d;
    designs_free(d);
    return NULL;
}

void designs_free(struct designs *d)
{
    if (!d)
        return;
    designs_stop(d);
    for (size_t i = 0; i < d->n; i++) {
        pthread_join(d->workers[i].thread, NULL);
        problem_free(&d->workers[i].problem);
    }
    pthread_cond_destroy(&d->answered);
    pthread_cond_destroy(&d->asked);
    pthread_mutex_destroy(&d->lock);
    free(d->workers);
    free(d);
}
