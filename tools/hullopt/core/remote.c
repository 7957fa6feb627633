#include "core/remote.h"

#include "core/identity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The original here and there: one program with another number of threads agrees to this. */
static const double SAME_CW = 1e-6;
/* Volume and surface of a design: a knot more or less, but not another hull. */
static const double SAME_HULL = 1e-3;
/* Stands for a figure without a value, which none of them has otherwise. */
static const double NONE = -1;
/* Before a server that failed once is asked again, s, and twice as long each time after. The last
 * one left is waited for longer, as behind one URL a balancer may need seconds to notice that one
 * of its machines is gone. */
enum { PAUSE = 2, ATTEMPTS = 2, LAST_ATTEMPTS = 4 };

static const size_t FIGURES[REMOTE_FIGURES] = {
    offsetof(struct evaluation, rw),        offsetof(struct evaluation, share_beyond_cutoff),
    offsetof(struct evaluation, condition), offsetof(struct evaluation, dofs),
    offsetof(struct evaluation, volume),    offsetof(struct evaluation, wetted_area)};
enum { DOFS = 3, VOLUME = 4, AREA = 5 };

static size_t count_speeds(const struct config *config)
{
    return evaluate_asks_speeds(config) ? config->verify_froudes * (1 + config->models) : 0;
}

/* The numbers of objective.command, of which there may be none. */
static size_t list_told(const struct config *config, struct evaluation *e,
                        double *told[OBJECTIVES_MOST])
{
    size_t n = 0;
    if (config->judge.command)
        told[n++] = &e->value;
    for (size_t k = 0; k + 1 < OBJECTIVES_MOST; k++)
        if (config->other[k].quantity == QUANTITY_COMMAND)
            told[n++] = &e->told[k];
    return n;
}

void remote_sizes(const struct config *config, size_t sizes[3])
{
    struct evaluation e;
    double *told[OBJECTIVES_MOST];
    sizes[0] = 1 + config->models + count_speeds(config);
    sizes[1] =
        igabem_formulation_info(config->solver.formulation)->pressure + list_told(config, &e, told);
    sizes[2] = REMOTE_FIGURES;
}

static double *figure(const struct evaluation *e, size_t k)
{
    return (double *)(void *)((char *)e + FIGURES[k]);
}

void remote_write(const struct config *config, const struct evaluation *e, double *output)
{
    struct evaluation all = *e;
    double *told[OBJECTIVES_MOST];
    size_t sizes[3], n = list_told(config, &all, told);
    remote_sizes(config, sizes);
    *output++ = e->cw;
    memcpy(output, e->cw_model, e->models * sizeof *output);
    memcpy(output + e->models, e->cw_speed, e->speeds * sizeof *output);
    output += sizes[0] - 1;
    for (size_t k = 0; k < n; k++)
        *output++ = *told[k];
    if (igabem_formulation_info(config->solver.formulation)->pressure)
        *output++ = e->cw_pressure;
    for (size_t k = 0; k < REMOTE_FIGURES; k++) {
        double value = k == DOFS ? (double)e->dofs : *figure(e, k);
        output[k] = isnan(value) ? NONE : value;
    }
}

static bool close_to(double a, double b, double tolerance)
{
    return fabs(a - b) <= tolerance * fabs(b);
}

/* False, with the reason, when these are not the figures of that design. */
static bool take(const struct remote *remote, const struct umbridge *server, const double *output,
                 struct evaluation *e, char *reason)
{
    const double *more = output + server->outputs[0] + server->outputs[1];
    for (size_t k = 0; k < server->outputs[0]; k++)
        if (!(output[k] > 0)) {
            snprintf(reason, UMBRIDGE_SENTENCE, "%s: C_w is %g, expected a positive number",
                     server->url, output[k]);
            return false;
        }
    if (!close_to(more[VOLUME], e->volume, SAME_HULL) ||
        !close_to(more[AREA], e->wetted_area, SAME_HULL)) {
        snprintf(reason, UMBRIDGE_SENTENCE,
                 "%s builds another hull: %.6g m³ and %.6g m², here %.6g and %.6g", server->url,
                 more[VOLUME], more[AREA], e->volume, e->wetted_area);
        return false;
    }
    e->cw = output[0];
    memcpy(e->cw_model, output + 1, e->models * sizeof *output);
    memcpy(e->cw_speed, output + 1 + e->models, e->speeds * sizeof *output);
    output += server->outputs[0];
    double *told[OBJECTIVES_MOST];
    size_t n = list_told(remote->config, e, told);
    for (size_t k = 0; k < n; k++)
        *told[k] = *output++;
    if (output < more)
        e->cw_pressure = *output;
    for (size_t k = 0; k < DOFS; k++)
        *figure(e, k) = more[k] == NONE ? NAN : more[k];
    e->dofs = more[DOFS] > 0 ? (size_t)more[DOFS] : 0;
    return true;
}

static bool open_one(struct umbridge *server, const char *url, const struct problem *problem,
                     const json_t *identity)
{
    size_t sizes[3], modes = galv_model_modes(problem->model);
    char sentence[UMBRIDGE_SENTENCE];
    remote_sizes(problem->config, sizes);
    if (!umbridge_open(server, url, "design", json_deep_copy(identity), modes,
                       sizes[0] + sizes[1] + sizes[2], sentence))
        return core_fail("%s", sentence);
    return (server->n_inputs == 1 && server->n_outputs == 3 &&
            memcmp(server->outputs, sizes, sizeof sizes) == 0) ||
           core_fail("%s: 'design' gives other figures than this version of hullopt asks for", url);
}

bool remote_open(struct remote *remote, const struct problem *problem, const char *urls)
{
    *remote = (struct remote){.urls = strdup(urls), .config = problem->config};
    if (problem->config->running_surface)
        return core_fail("--server: servers do not tell the surface that objective.surface asks "
                         "for");
    json_t *identity = identity_of(problem);
    char *rest = remote->urls, *url;
    bool ok = (rest || core_no_memory()) && identity;
    while (ok && (url = strtok_r(rest, ",", &rest)) != NULL)
        ok = remote->n == REMOTE_MOST
                 ? core_fail("--server has more than %d URLs", REMOTE_MOST)
                 : open_one(&remote->server[remote->n++], url, problem, identity);
    json_decref(identity);
    return ok && (remote->n || core_fail("--server is '%s', expected URLs", urls));
}

void remote_close(struct remote *remote)
{
    for (size_t i = 0; i < remote->n; i++)
        umbridge_close(&remote->server[i]);
    free(remote->urls);
}

bool remote_check(const struct remote *remote, const struct evaluation *parent, size_t modes)
{
    double *zero = calloc(modes, sizeof *zero), output[REMOTE_SIZE];
    char reason[UMBRIDGE_SENTENCE];
    bool ok = zero || core_no_memory();
    for (size_t i = 0; i < remote->n && ok; i++) {
        const struct umbridge *server = &remote->server[i];
        struct evaluation e = *parent;
        ok = umbridge_numbers(server, zero, output, reason) == 0 &&
             take(remote, server, output, &e, reason);
        if (!ok)
            core_fail("%s", reason);
        else if (!close_to(e.cw, parent->cw, SAME_CW))
            ok = core_fail("%s gives the original C_w %.8e, here it is %.8e: is it another version "
                           "of hullopt?",
                           server->url, e.cw, parent->cw);
    }
    free(zero);
    return ok;
}

static bool is_lost(uint64_t lost, size_t i)
{
    return lost >> i & 1;
}

void remote_choose(struct remote *remote, size_t place)
{
    remote->first = place % remote->n;
    for (size_t i = 0; i < remote->n && is_lost(remote->lost, remote->first); i++)
        remote->first = (remote->first + 1) % remote->n;
}

static bool is_last(const struct remote *remote, uint64_t lost, size_t i)
{
    for (size_t k = 0; k < remote->n; k++)
        if (k != i && !is_lost(lost, k))
            return false;
    return true;
}

/* Asks server i, again where it does not answer. */
static int ask(const struct remote *remote, const struct evaluation *e, size_t i, double *output,
               char *reason)
{
    int attempts = is_last(remote, remote->lost | e->lost, i) ? LAST_ATTEMPTS : ATTEMPTS;
    int status = umbridge_numbers(&remote->server[i], e->u, output, reason);
    for (int n = 1; n < attempts && status == UMBRIDGE_LOST; n++) {
        sleep((unsigned)PAUSE << (n - 1));
        status = umbridge_numbers(&remote->server[i], e->u, output, reason);
    }
    return status;
}

/* The model's own error is about the design. */
static bool fail_design(const char *reason)
{
    static const char type[] = "InvalidOutput: ";
    bool typed = strncmp(reason, type, sizeof type - 1) == 0;
    return core_fail("%s", reason + (typed ? sizeof type - 1 : 0));
}

bool remote_solve(struct remote *remote, struct evaluation *e)
{
    double output[REMOTE_SIZE];
    char reason[UMBRIDGE_SENTENCE] = "";
    for (size_t k = 0; k < remote->n; k++) {
        size_t i = (remote->first + k) % remote->n;
        if (is_lost(remote->lost, i))
            continue;
        int status = ask(remote, e, i, output, reason);
        if (status == 0 && take(remote, &remote->server[i], output, e, reason))
            return true;
        if (status == UMBRIDGE_MODEL)
            return fail_design(reason);
        e->lost |= (uint64_t)1 << i;
        snprintf(e->lost_reason, sizeof e->lost_reason, "%s", reason);
    }
    e->unanswered = true;
    return core_fail("no server answers");
}

bool remote_learn(struct remote *remote, const struct evaluation *e, const struct core_watch *watch)
{
    size_t left = 0;
    for (size_t i = 0; i < remote->n; i++) {
        if (is_lost(e->lost & ~remote->lost, i))
            core_tell(watch, "%s is not asked any more: %s", remote->server[i].url, e->lost_reason);
        left += !is_lost(e->lost | remote->lost, i);
    }
    remote->lost |= e->lost;
    return (left && !e->unanswered) ||
           core_fail("no server is left (%s): the design at hand is not on record, and --resume "
                     "goes on with it",
                     e->lost_reason);
}
