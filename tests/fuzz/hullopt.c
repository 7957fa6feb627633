/* Files and requests that hullopt reads. */
#include "config.h"
#include "core/record.h"
#include "serve/protocol.h"
#include "store_edits.h"
#include "target.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void use_config(const struct config *config)
{
    demand(config->text != NULL, "a configuration has its text");
    demand_finite(1, &config->solver.froude, "a Froude number");
    demand_finite(config->n_parameters, config->lower, "bounds");
}

static void read_run(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    struct config config;
    if (config_read(path, NULL, &config)) {
        use_config(&config);
        config_free(&config);
    }
}

/* A configuration as the record keeps it. */
static void read_text(const char *path, size_t n, const uint8_t *bytes)
{
    (void)path;
    struct config config;
    char *text = malloc(n + 1);
    demand(text != NULL, "there is memory");
    memcpy(text, bytes, n);
    text[n] = '\0';
    if (config_restore(text, &config)) {
        use_config(&config);
        config_free(&config);
    }
    free(text);
}

static void read_record(const char *path, size_t n, const uint8_t *bytes)
{
    struct record record = {0};
    struct origin origin;
    struct evaluation *list = NULL;
    struct verification *rows = NULL;
    struct config config;
    size_t count, sessions;
    double seconds;
    store_edit(path, n, bytes);
    if (!record_read(path, &record, &origin))
        return;
    demand_finite(1, &origin.length, "the length");
    if (config_restore(origin.configuration, &config))
        config_free(&config);
    if (record_evaluations(&record, &list, &count))
        free(list);
    if (record_verifications(&record, &rows, &count))
        free(rows);
    record_seconds(&record, &sessions, &seconds);
    origin_free(&origin);
    record_close(&record);
}

/* A model of UM-Bridge that sums its input up. */
static bool sizes(const struct served *model, const json_t *config, size_t n[SERVED_OUTPUTS],
                  struct served_error *error)
{
    (void)model, (void)config, (void)error;
    n[0] = n[1] = n[2] = 1;
    return true;
}

static json_t *labels(const struct served *model)
{
    (void)model;
    return json_pack("[[s], [s], [s]]", "sum", "n", "none");
}

static bool sum(const struct served *model, const double *input, const json_t *config,
                double *output, struct served_error *error)
{
    (void)config, (void)error;
    demand_finite(model->n, input, "an input");
    output[0] = output[1] = output[2] = 0;
    for (size_t i = 0; i < model->n; i++)
        output[0] += input[i];
    return true;
}

static bool slopes(const struct served *model, const double *input, const json_t *config, size_t k,
                   double *jacobian, struct served_error *error)
{
    (void)config, (void)error;
    demand_finite(model->n, input, "an input");
    for (size_t i = 0; i < model->n; i++)
        jacobian[i] = k == 0;
    return true;
}

/* The first line is the path, what follows the body. */
static void read_request(const char *path, size_t n, const uint8_t *bytes)
{
    (void)path;
    static const double lower[] = {-1, -1}, upper[] = {1, 1};
    static const struct served model = {.name = "hull",
                                        .n = 2,
                                        .lower = lower,
                                        .upper = upper,
                                        .sizes = sizes,
                                        .labels = labels,
                                        .evaluate = sum,
                                        .differentiate = slopes};
    const uint8_t *end = n ? memchr(bytes, '\n', n) : NULL;
    size_t length = end ? (size_t)(end - bytes) : n, rest = end ? n - length - 1 : 0;
    char *place = calloc(length + 1, 1), *text = NULL;
    demand(place != NULL, "there is memory");
    memcpy(place, bytes, length);
    protocol_answer(1, &model, "POST", place, rest, end ? (const char *)end + 1 : "", &text);
    json_t *answer = text ? json_loads(text, 0, NULL) : NULL;
    demand(json_is_object(answer), "the answer is a JSON object");
    json_decref(answer);
    free(text);
    free(place);
}

const struct reader READERS[] = {
    {"run_yaml", ".yaml", read_run},
    {"run_text", NULL, read_text},
    {"run_db", NULL, read_record},
    {"request", NULL, read_request},
    {NULL, NULL, NULL},
};
