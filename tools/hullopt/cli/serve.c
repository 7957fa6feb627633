#include "cli.h"
#include "cli/commands.h"
#include "core/identity.h"
#include "core/sentence.h"
#include "json_result.h"
#include "serve/designs.h"
#include "serve/http.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is served, and how much of it. */
struct server {
    const struct config *config;
    struct designs *designs;
    json_t *identity; /* of the problem */
    atomic_size_t evaluated, failed;
};

static bool sizes(const struct served *model, const json_t *config, size_t sizes[SERVED_OUTPUTS],
                  struct served_error *error)
{
    const struct server *server = model->user_data;
    struct variant variant;
    if (!variant_read(server->config, config, &variant, error))
        return false;
    variant_sizes(&variant, server->config, sizes);
    return true;
}

static json_t *labels(const struct served *model)
{
    return variant_labels(((const struct server *)model->user_data)->config);
}

static bool value_design(struct server *server, const double *input, const struct variant *variant,
                         double *output, struct served_error *error)
{
    bool ok = designs_evaluate(server->designs, input, variant, output, error);
    atomic_fetch_add(&server->evaluated, 1);
    if (!ok) {
        atomic_fetch_add(&server->failed, 1);
        fprintf(stderr, "%s: a design failed: %s\n", cli_name(), error->sentence);
    }
    return ok;
}

static bool evaluate_latent(const struct served *model, const double *input, const json_t *config,
                            double *output, struct served_error *error)
{
    struct server *server = model->user_data;
    struct variant variant;
    return variant_read(server->config, config, &variant, error) &&
           value_design(server, input, &variant, output, error);
}

static bool differentiate_latent(const struct served *model, const double *input,
                                 const json_t *config, size_t k, double *jacobian,
                                 struct served_error *error)
{
    struct server *server = model->user_data;
    struct variant variant;
    if (k > 0)
        return served_fail(error, SERVED_UNSUPPORTED,
                           "output %zu has no derivatives, only output 0 has, C_w by speed", k);
    return variant_read(server->config, config, &variant, error) &&
           designs_differentiate(server->designs, input, &variant, jacobian, error);
}

/* Model 'design' is what 'hullopt run --server' asks: whoever asks says in every request which
 * problem is meant, so that it reaches the server through a load balancer too. */
static bool is_ours(const struct server *server, const json_t *config, struct served_error *error)
{
    char sentence[SERVED_SENTENCE / 2];
    return identity_agrees(server->identity, config, sentence, sizeof sentence) ||
           served_fail(error, SERVED_INVALID_INPUT, "the server has another problem: %s", sentence);
}

static const struct variant AS_RUN = {.as_run = true};

static bool design_sizes(const struct served *model, const json_t *config,
                         size_t sizes[SERVED_OUTPUTS], struct served_error *error)
{
    const struct server *server = model->user_data;
    variant_sizes(&AS_RUN, server->config, sizes);
    return is_ours(server, config, error);
}

static bool evaluate_design(const struct served *model, const double *input, const json_t *config,
                            double *output, struct served_error *error)
{
    struct server *server = model->user_data;
    return is_ours(server, config, error) && value_design(server, input, &AS_RUN, output, error);
}

static json_t *design_labels(const struct served *model)
{
    (void)model;
    return json_pack("[[s], [s], [s, s, s, s, s, s]]",
                     "C_w by search.models and speeds of the configuration",
                     "objective.command, C_w by pressure, where there are", "R_w, N",
                     "share of C_w beyond the filter", "condition", "unknowns", "volume, m^3",
                     "wetted area, m^2");
}

static bool print_text(const struct options *options, unsigned port, size_t modes)
{
    printf("http://%s:%u serves model 'latent' of %zu variables, %d designs at once\n",
           options->address, port, modes, options->jobs);
    return cli_printed() == CLI_OK;
}

static bool print_json(const struct options *options, unsigned port, size_t modes)
{
    char url[80];
    snprintf(url, sizeof url, "http://%s:%u", options->address, port);
    return json_result_print(json_pack("{s:s, s:s, s:I, s:i}", "url", url, "model", "latent",
                                       "variables", (json_int_t)modes, "jobs", options->jobs),
                             JSON_COMPACT) == CLI_OK;
}

/* Serves until one of the signals comes. */
static bool serve(const struct options *options, uint16_t port, struct server *server,
                  const sigset_t *signals)
{
    char sentence[SERVED_SENTENCE];
    size_t modes = designs_modes(server->designs);
    const struct served models[] = {
        {.name = "latent",
         .n = modes,
         .lower = designs_lower(server->designs),
         .upper = designs_upper(server->designs),
         .sizes = sizes,
         .labels = labels,
         .evaluate = evaluate_latent,
         .differentiate = designs_have_derivatives(server->designs) ? differentiate_latent : NULL,
         .user_data = server},
        {.name = "design",
         .n = modes,
         .sizes = design_sizes,
         .labels = design_labels,
         .evaluate = evaluate_design,
         .user_data = server}};
    struct http *http =
        http_start(options->address, port, sizeof models / sizeof *models, models, sentence);
    if (!http)
        return cli_refuse("%s", sentence);
    bool ok = options->json ? print_json(options, http_port(http), modes)
                            : print_text(options, http_port(http), modes);
    int signal;
    if (ok)
        sigwait(signals, &signal);
    designs_stop(server->designs);
    http_stop(http);
    fprintf(stderr, "%s: %zu designs were evaluated, %zu failed\n", cli_name(),
            atomic_load(&server->evaluated), atomic_load(&server->failed));
    return ok;
}

/* Before a thread is made: all of them leave the signals to sigwait(). */
static void block(sigset_t *signals)
{
    sigemptyset(signals);
    sigaddset(signals, SIGINT);
    sigaddset(signals, SIGTERM);
    pthread_sigmask(SIG_BLOCK, signals, NULL);
}

/* As the job scripts of UM-Bridge's load balancer give it. */
static bool choose_port(int given, uint16_t *port)
{
    const char *text = getenv("PORT");
    int number = 4242;
    if (given < 0 && text && (!cli_parse_int(text, &number) || number < 0 || number > UINT16_MAX))
        return cli_refuse("PORT is '%s' in the environment, expected 0 to 65535", text);
    *port = (uint16_t)(given < 0 ? number : given);
    return true;
}

int serve_command(const struct options *options)
{
    struct config config;
    sigset_t signals;
    uint16_t port = 0;
    if (!choose_port(options->port, &port) || !config_read(options->path, NULL, &config))
        return CLI_FAILED;
    block(&signals);
    struct server server = {.config = &config};
    int threads = cli_threads() / options->jobs;
    server.designs = designs_start(&config, (size_t)options->jobs, threads > 1 ? threads : 1);
    server.identity = server.designs ? identity_of(designs_problem(server.designs)) : NULL;
    bool ok = server.identity ? serve(options, port, &server, &signals)
                              : cli_refuse("%s", core_sentence());
    designs_free(server.designs);
    json_decref(server.identity);
    config_free(&config);
    return ok ? CLI_OK : CLI_FAILED;
}
