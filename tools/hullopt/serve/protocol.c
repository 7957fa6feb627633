#include "serve/protocol.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    STATUS_OK = 200,
    STATUS_INPUT = 400,
    STATUS_PATH = 404,
    STATUS_METHOD = 405,
    STATUS_MODEL = 500,
    STATUS_STOPPING = 503
};

static const char *const FAULTS[SERVED_FAULTS] = {
    [SERVED_INVALID_INPUT] = "InvalidInput",     [SERVED_MODEL_NOT_FOUND] = "ModelNotFound",
    [SERVED_UNSUPPORTED] = "UnsupportedFeature", [SERVED_INVALID_OUTPUT] = "InvalidOutput",
    [SERVED_UNAVAILABLE] = "InvalidOutput",
};

bool served_fail(struct served_error *error, enum served_fault fault, const char *format, ...)
{
    va_list args;
    error->fault = fault;
    va_start(args, format);
    vsnprintf(error->sentence, sizeof error->sentence, format, args);
    va_end(args);
    return false;
}

static bool no_memory(struct served_error *error)
{
    return served_fail(error, SERVED_UNAVAILABLE, "out of memory");
}

/* What all requests but /Info hold. */
struct request {
    const struct served *model;
    json_t *body;
    json_t *config; /* borrowed from the body, or empty */
};

static bool find_model(size_t n, const struct served *models, struct request *request,
                       struct served_error *error)
{
    const json_t *name = json_object_get(request->body, "name");
    if (!json_is_string(name))
        return served_fail(error, SERVED_INVALID_INPUT,
                           "name is missing, expected that of a model");
    for (size_t i = 0; i < n; i++)
        if (strcmp(models[i].name, json_string_value(name)) == 0)
            request->model = &models[i];
    return request->model || served_fail(error, SERVED_MODEL_NOT_FOUND,
                                         "there is no model '%s', GET /Info lists those there are",
                                         json_string_value(name));
}

static bool find_config(struct request *request, struct served_error *error)
{
    request->config = json_object_get(request->body, "config");
    if (!request->config || json_is_null(request->config)) {
        json_t *empty = json_object();
        request->config = empty;
        return (empty && json_object_set_new(request->body, "config", empty) == 0) ||
               no_memory(error);
    }
    return json_is_object(request->config) ||
           served_fail(error, SERVED_INVALID_INPUT, "config is no object");
}

static bool read_request(size_t n, const struct served *models, size_t size, const char *body,
                         struct request *request, struct served_error *error)
{
    json_error_t at;
    *request = (struct request){.body = json_loadb(body, size, JSON_REJECT_DUPLICATES, &at)};
    if (!request->body)
        return served_fail(error, SERVED_INVALID_INPUT, "the request is no JSON: line %d, %s",
                           at.line, at.text);
    if (!json_is_object(request->body))
        return served_fail(error, SERVED_INVALID_INPUT, "the request is no JSON object");
    return find_model(n, models, request, error) && find_config(request, error);
}

static json_t *info(size_t n, const struct served *models)
{
    json_t *names = json_array();
    for (size_t i = 0; i < n; i++)
        json_array_append_new(names, json_string(models[i].name));
    return json_pack("{s:s, s:o}", "protocolVersion", "1.0", "models", names);
}

static json_t *bounds(const struct served *model)
{
    json_t *list = json_array();
    for (size_t i = 0; model->lower && i < model->n; i++)
        json_array_append_new(list, json_pack("[f, f]", model->lower[i], model->upper[i]));
    return list;
}

/* Beside what the protocol asks for: the range of each input and the names of the outputs. */
static bool model_info(const struct request *r, json_t **answer, struct served_error *error)
{
    int derivatives = r->model->differentiate != NULL;
    (void)error;
    *answer = json_pack("{s:{s:b, s:b, s:b, s:b}, s:o, s:o}", "support", "Evaluate", 1, "Gradient",
                        derivatives, "ApplyJacobian", derivatives, "ApplyHessian", 0, "inputBounds",
                        bounds(r->model), "outputLabels", r->model->labels(r->model));
    return true;
}

static bool input_sizes(const struct request *r, json_t **answer, struct served_error *error)
{
    (void)error;
    *answer = json_pack("{s:[I]}", "inputSizes", (json_int_t)r->model->n);
    return true;
}

static bool output_sizes(const struct request *r, json_t **answer, struct served_error *error)
{
    size_t sizes[SERVED_OUTPUTS];
    if (!r->model->sizes(r->model, r->config, sizes, error))
        return false;
    json_t *list = json_array();
    for (size_t i = 0; i < SERVED_OUTPUTS; i++)
        json_array_append_new(list, json_integer((json_int_t)sizes[i]));
    *answer = json_pack("{s:o}", "outputSizes", list);
    return true;
}

static bool read_number(const struct served *model, const json_t *list, size_t i, double *x,
                        struct served_error *error)
{
    const json_t *value = json_array_get(list, i);
    if (!json_is_number(value))
        return served_fail(error, SERVED_INVALID_INPUT, "input[0][%zu] is no number", i);
    *x = json_number_value(value);
    if (model->lower && !(*x >= model->lower[i] && *x <= model->upper[i]))
        return served_fail(error, SERVED_INVALID_INPUT,
                           "input[0][%zu] is %.15g, expected %.15g to %.15g", i, *x,
                           model->lower[i], model->upper[i]);
    return true;
}

static bool read_input(const struct request *r, double *x, struct served_error *error)
{
    const json_t *input = json_object_get(r->body, "input"), *list = json_array_get(input, 0);
    size_t n = r->model->n;
    if (!json_is_array(input) || json_array_size(input) != 1 || !json_is_array(list))
        return served_fail(error, SERVED_INVALID_INPUT, "input is no list of one vector");
    if (json_array_size(list) != n)
        return served_fail(error, SERVED_INVALID_INPUT, "input[0] has %zu numbers, expected %zu",
                           json_array_size(list), n);
    for (size_t i = 0; i < n; i++)
        if (!read_number(r->model, list, i, &x[i], error))
            return false;
    return true;
}

static bool write_output(const size_t sizes[SERVED_OUTPUTS], const double *output, json_t **answer,
                         struct served_error *error)
{
    json_t *vectors = json_array();
    for (size_t k = 0; k < SERVED_OUTPUTS; k++) {
        json_t *vector = json_array();
        for (size_t i = 0; i < sizes[k]; i++, output++) {
            if (!isfinite(*output)) {
                json_decref(vector);
                json_decref(vectors);
                return served_fail(error, SERVED_INVALID_OUTPUT,
                                   "output[%zu][%zu] has no value for this input", k, i);
            }
            json_array_append_new(vector, json_real(*output));
        }
        json_array_append_new(vectors, vector);
    }
    *answer = json_pack("{s:o}", "output", vectors);
    return true;
}

static bool evaluate(const struct request *r, json_t **answer, struct served_error *error)
{
    size_t sizes[SERVED_OUTPUTS], n = 0;
    if (!r->model->sizes(r->model, r->config, sizes, error))
        return false;
    for (size_t k = 0; k < SERVED_OUTPUTS; k++)
        n += sizes[k];
    double *x = malloc((r->model->n + n) * sizeof *x);
    bool ok = x || no_memory(error);
    ok = ok && read_input(r, x, error) &&
         r->model->evaluate(r->model, x, r->config, x + r->model->n, error) &&
         write_output(sizes, x + r->model->n, answer, error);
    free(x);
    return ok;
}

static bool no_derivative(const struct request *r, json_t **answer, struct served_error *error)
{
    (void)answer;
    return served_fail(error, SERVED_UNSUPPORTED, "model '%s' has no such derivatives",
                       r->model->name);
}

/* A whole number below n. */
static bool read_index(const struct request *r, const char *key, size_t n, size_t *index,
                       struct served_error *error)
{
    const json_t *value = json_object_get(r->body, key);
    json_int_t number = json_integer_value(value);
    if (!json_is_integer(value) || number < 0 || (size_t)number >= n)
        return served_fail(error, SERVED_INVALID_INPUT, "%s is no whole number from 0 to %zu", key,
                           n - 1);
    *index = (size_t)number;
    return true;
}

static bool read_vector(const struct request *r, const char *key, size_t n, double *x,
                        struct served_error *error)
{
    const json_t *list = json_object_get(r->body, key);
    if (!json_is_array(list) || json_array_size(list) != n)
        return served_fail(error, SERVED_INVALID_INPUT, "%s is no list of %zu numbers", key, n);
    for (size_t i = 0; i < n; i++) {
        if (!json_is_number(json_array_get(list, i)))
            return served_fail(error, SERVED_INVALID_INPUT, "%s[%zu] is no number", key, i);
        x[i] = json_number_value(json_array_get(list, i));
    }
    return true;
}

static bool write_vector(size_t n, const double *x, json_t **answer, struct served_error *error)
{
    json_t *list = json_array();
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(x[i])) {
            json_decref(list);
            return served_fail(error, SERVED_INVALID_OUTPUT,
                               "output[%zu] has no value for this input", i);
        }
        json_array_append_new(list, json_real(x[i]));
    }
    *answer = json_pack("{s:o}", "output", list);
    return true;
}

/* The Jacobian J [rows][n] of one output by the one input, times the vector of the request: J^T
 * sens, or J vec. */
static bool differentiate(const struct request *r, const char *key, bool is_transposed,
                          json_t **answer, struct served_error *error)
{
    size_t sizes[SERVED_OUTPUTS], n = r->model->n, output = 0, input = 0;
    if (!r->model->differentiate)
        return no_derivative(r, answer, error);
    if (!r->model->sizes(r->model, r->config, sizes, error) ||
        !read_index(r, "outWrt", SERVED_OUTPUTS, &output, error) ||
        !read_index(r, "inWrt", 1, &input, error))
        return false;
    size_t rows = sizes[output], given = is_transposed ? rows : n, told = is_transposed ? n : rows;
    double *work = calloc(n + given + told + rows * n, sizeof *work);
    if (!work)
        return no_memory(error);
    double *x = work, *vector = x + n, *product = vector + given, *jacobian = product + told;
    bool ok = read_input(r, x, error) && read_vector(r, key, given, vector, error) &&
              r->model->differentiate(r->model, x, r->config, output, jacobian, error);
    for (size_t i = 0; i < rows && ok; i++)
        for (size_t k = 0; k < n; k++)
            if (is_transposed)
                product[k] += vector[i] * jacobian[i * n + k];
            else
                product[i] += jacobian[i * n + k] * vector[k];
    ok = ok && write_vector(told, product, answer, error);
    free(work);
    return ok;
}

static bool gradient(const struct request *r, json_t **answer, struct served_error *error)
{
    return differentiate(r, "sens", true, answer, error);
}

static bool apply_jacobian(const struct request *r, json_t **answer, struct served_error *error)
{
    return differentiate(r, "vec", false, answer, error);
}

static const struct {
    const char *path;
    bool (*answer)(const struct request *request, json_t **answer, struct served_error *error);
} CALLS[] = {{"/Evaluate", evaluate},         {"/ModelInfo", model_info},
             {"/InputSizes", input_sizes},    {"/OutputSizes", output_sizes},
             {"/Gradient", gradient},         {"/ApplyJacobian", apply_jacobian},
             {"/ApplyHessian", no_derivative}};
enum { N_CALLS = sizeof CALLS / sizeof *CALLS };

/* An answer without a text had no memory for it. */
static unsigned finish(unsigned status, json_t *answer, char **text)
{
    *text = answer ? json_dumps(answer, JSON_COMPACT) : NULL;
    json_decref(answer);
    return *text ? status : STATUS_MODEL;
}

static unsigned refuse(unsigned status, enum served_fault fault, const char *sentence, char **text)
{
    return finish(status,
                  json_pack("{s:{s:s, s:s}}", "error", "type", FAULTS[fault], "message", sentence),
                  text);
}

unsigned protocol_refuse(unsigned status, const char *sentence, char **text)
{
    return refuse(status, SERVED_INVALID_INPUT, sentence, text);
}

static unsigned post(size_t n, const struct served *models, size_t call, size_t size,
                     const char *body, char **text)
{
    struct request request;
    struct served_error error;
    json_t *answer = NULL;
    bool ok = read_request(n, models, size, body, &request, &error) &&
              CALLS[call].answer(&request, &answer, &error);
    json_decref(request.body);
    if (ok)
        return finish(STATUS_OK, answer, text);
    unsigned status = error.fault == SERVED_INVALID_OUTPUT ? STATUS_MODEL
                      : error.fault == SERVED_UNAVAILABLE  ? STATUS_STOPPING
                                                           : STATUS_INPUT;
    return refuse(status, error.fault, error.sentence, text);
}

unsigned protocol_answer(size_t n, const struct served *models, const char *method,
                         const char *path, size_t size, const char *body, char **text)
{
    bool is_info = strcmp(path, "/Info") == 0;
    if (is_info && (strcmp(method, "GET") == 0 || strcmp(method, "HEAD") == 0))
        return finish(STATUS_OK, info(n, models), text);
    for (size_t k = 0; k < N_CALLS; k++)
        if (strcmp(path, CALLS[k].path) == 0 && strcmp(method, "POST") == 0)
            return post(n, models, k, size, body, text);
        else if (strcmp(path, CALLS[k].path) == 0)
            return protocol_refuse(STATUS_METHOD, "expected POST", text);
    return is_info ? protocol_refuse(STATUS_METHOD, "expected GET", text)
                   : protocol_refuse(STATUS_PATH, "there is no such call of UM-Bridge 1.0", text);
}
