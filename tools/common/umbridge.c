#include "umbridge.h"

#include <curl/curl.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* What an answer may hold, and how long a server may take to be reached. */
enum { MOST_ANSWER = 64 << 20, CONNECT_SECONDS = 30, MOST_REASON = 300 };

struct answer {
    char *text;
    size_t length;
};

/* One request and what became of it. */
struct request {
    long status; /* of HTTP; 0: there was no answer */
    json_t *root;
    char reason[MOST_REASON];
};

static size_t collect(char *data, size_t size, size_t n, void *user_data)
{
    struct answer *a = user_data;
    size_t more = size * n;
    if (a->length + more > MOST_ANSWER)
        return 0;
    char *text = realloc(a->text, a->length + more + 1);
    if (!text)
        return 0;
    memcpy(text + a->length, data, more);
    a->text = text;
    a->length += more;
    text[a->length] = '\0';
    return more;
}

/* The server's own words, {"error": {"type": ..., "message": ...}}, or its status. */
static void take_error(struct request *r, const char *url)
{
    const json_t *error = json_object_get(r->root, "error");
    const char *type = json_string_value(json_object_get(error, "type"));
    const char *message = json_string_value(json_object_get(error, "message"));
    if (type || message)
        snprintf(r->reason, sizeof r->reason, "%s%s%s", type ? type : "",
                 type && message ? ": " : "", message ? message : "");
    else
        snprintf(r->reason, sizeof r->reason, "%s answers with the status %ld of HTTP", url,
                 r->status);
}

/* Sends and waits. False with the reason when there is no answer of status 200 in JSON. */
static bool perform(CURL *curl, const char *url, const char *body, struct request *r)
{
    struct answer answer = {0};
    struct curl_slist *headers = curl_slist_append(NULL, "Content-Type: application/json");
    struct curl_slist *all = headers ? curl_slist_append(headers, "Expect:") : NULL;
    char said[CURL_ERROR_SIZE] = "";
    curl_easy_setopt(curl, CURLOPT_URL, url);
    curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, said);
    curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
    curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
    curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, (long)CONNECT_SECONDS);
    curl_easy_setopt(curl, CURLOPT_TCP_KEEPALIVE, 1L); /* a machine that went away is noticed */
    curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, collect);
    curl_easy_setopt(curl, CURLOPT_WRITEDATA, &answer);
    if (body) {
        curl_easy_setopt(curl, CURLOPT_HTTPHEADER, all);
        curl_easy_setopt(curl, CURLOPT_POSTFIELDS, body);
    }
    CURLcode code = all ? curl_easy_perform(curl) : CURLE_OUT_OF_MEMORY;
    if (code == CURLE_OK)
        curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &r->status);
    r->root = code == CURLE_OK && answer.text ? json_loads(answer.text, 0, NULL) : NULL;
    if (code != CURLE_OK)
        snprintf(r->reason, sizeof r->reason, "%s: %s", url,
                 *said ? said : curl_easy_strerror(code));
    else if (r->status != 200)
        take_error(r, url);
    else if (!json_is_object(r->root))
        snprintf(r->reason, sizeof r->reason, "%s: the answer is no JSON object", url);
    curl_slist_free_all(headers);
    free(answer.text);
    return code == CURLE_OK && r->status == 200 && json_is_object(r->root);
}

/* POST of a body, or GET without; takes over the body. r->root is the caller's to release. */
static bool request(const struct umbridge *m, const char *call, json_t *body, struct request *r)
{
    size_t length = strlen(m->url), size = length + strlen(call) + 2;
    char *url = malloc(size), *text = body ? json_dumps(body, JSON_REAL_PRECISION(17)) : NULL;
    CURL *curl = curl_easy_init();
    *r = (struct request){0};
    snprintf(r->reason, sizeof r->reason, "out of memory");
    bool ok = url && curl && (!body || text);
    if (ok) {
        snprintf(url, size, "%s%s%s", m->url, length && m->url[length - 1] == '/' ? "" : "/", call);
        ok = perform(curl, url, text, r);
    }
    curl_easy_cleanup(curl);
    json_decref(body);
    free(text);
    free(url);
    return ok;
}

static json_t *named(const struct umbridge *m)
{
    return json_pack("{s:s, s:O}", "name", m->name, "config", m->config);
}

/* Fills the sentence and returns false. */
__attribute__((format(printf, 2, 3))) static bool fail(char *sentence, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(sentence, UMBRIDGE_SENTENCE, format, args);
    va_end(args);
    return false;
}

static bool refuse(struct request *r, char *sentence)
{
    json_decref(r->root);
    return fail(sentence, "%s", r->reason);
}

/* Whether the server has the model. */
static bool check_name(const struct umbridge *m, char *sentence)
{
    struct request r;
    size_t i;
    const json_t *name;
    bool found = false;
    char known[200] = "";
    if (!request(m, "Info", NULL, &r))
        return refuse(&r, sentence);
    json_array_foreach(json_object_get(r.root, "models"), i, name)
    {
        const char *text = json_string_value(name);
        size_t used = strlen(known);
        found = found || (text && strcmp(text, m->name) == 0);
        if (text)
            snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", text);
    }
    json_decref(r.root);
    return found || fail(sentence, "%s has no model '%s', it has %s", m->url, m->name,
                         *known ? known : "none");
}

static bool read_sizes(const struct umbridge *m, const char *call, const char *key, size_t *n,
                       size_t **sizes, char *sentence)
{
    struct request r;
    size_t i;
    const json_t *size;
    if (!request(m, call, named(m), &r))
        return refuse(&r, sentence);
    const json_t *list = json_object_get(r.root, key);
    *n = json_array_size(list);
    *sizes = calloc(*n + 1, sizeof **sizes);
    bool ok = *sizes && *n;
    json_array_foreach(list, i, size)
    {
        ok = ok && json_is_integer(size) && json_integer_value(size) >= 0 &&
             json_integer_value(size) < 1000000;
        if (ok)
            (*sizes)[i] = (size_t)json_integer_value(size);
    }
    json_decref(r.root);
    return ok || fail(sentence, "%s: %s of '%s' is no list of sizes", m->url, key, m->name);
}

static size_t total(size_t n, const size_t *sizes)
{
    size_t sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += sizes[i];
    return sum;
}

bool umbridge_open(struct umbridge *m, const char *url, const char *name, json_t *config, size_t d,
                   size_t most, char *sentence)
{
    struct request r;
    *m = (struct umbridge){.url = url, .name = name};
    m->config = config ? config : json_object();
    if (!m->config)
        return fail(sentence, "out of memory");
    if (curl_global_init(CURL_GLOBAL_DEFAULT) != CURLE_OK)
        return fail(sentence, "libcurl does not start");
    if (!check_name(m, sentence))
        return false;
    if (!request(m, "ModelInfo", json_pack("{s:s}", "name", name), &r))
        return refuse(&r, sentence);
    const json_t *support = json_object_get(r.root, "support");
    bool evaluates = json_is_true(json_object_get(support, "Evaluate"));
    m->has_gradient = json_is_true(json_object_get(support, "Gradient"));
    json_decref(r.root);
    if (!evaluates)
        return fail(sentence, "%s: '%s' cannot be evaluated", url, name);
    if (!read_sizes(m, "InputSizes", "inputSizes", &m->n_inputs, &m->inputs, sentence) ||
        !read_sizes(m, "OutputSizes", "outputSizes", &m->n_outputs, &m->outputs, sentence))
        return false;
    if (total(m->n_inputs, m->inputs) != d)
        return fail(sentence, "%s: '%s' takes %zu numbers, expected one for each of %zu variables",
                    url, name, total(m->n_inputs, m->inputs), d);
    if (total(m->n_outputs, m->outputs) < most)
        return fail(sentence, "%s: '%s' gives %zu numbers, expected %zu at least", url, name,
                    total(m->n_outputs, m->outputs), most);
    return true;
}

void umbridge_close(struct umbridge *m)
{
    json_decref(m->config);
    free(m->inputs);
    free(m->outputs);
    *m = (struct umbridge){0};
}

static json_t *inputs_json(const struct umbridge *m, const double *x)
{
    json_t *input = json_array();
    for (size_t i = 0; i < m->n_inputs; i++) {
        json_t *vector = json_array();
        for (size_t k = 0; k < m->inputs[i]; k++)
            json_array_append_new(vector, json_real(*x++));
        json_array_append_new(input, vector);
    }
    return input;
}

/* A server that is not there, says that it is overloaded, or something else in its place answers,
 * is lost; the rest is the model's or the point's. */
static int classify(const struct request *r)
{
    bool told = json_is_object(json_object_get(r->root, "error"));
    bool lost = r->status == 0 || r->status == 429 || (r->status >= 502 && r->status <= 504) ||
                (!told && (r->status < 400 || r->status >= 500));
    return lost                                  ? UMBRIDGE_LOST
           : r->status >= 400 && r->status < 500 ? UMBRIDGE_INPUT
                                                 : UMBRIDGE_MODEL;
}

static int say(struct request *r, int status, FILE *err)
{
    fprintf(err, "%s\n", r->reason);
    json_decref(r->root);
    return status;
}

/* Writes the numbers of an answer's vectors one behind the other. */
static bool print_outputs(const struct umbridge *m, const json_t *output, FILE *out)
{
    size_t number = 0;
    if (json_array_size(output) != m->n_outputs)
        return false;
    for (size_t i = 0; i < m->n_outputs; i++) {
        const json_t *vector = json_array_get(output, i);
        if (json_array_size(vector) != m->outputs[i])
            return false;
        for (size_t k = 0; k < m->outputs[i]; k++) {
            const json_t *value = json_array_get(vector, k);
            if (!json_is_number(value))
                fprintf(out, "output.%zu = none\n", ++number);
            else
                fprintf(out, "output.%zu = %.17g\n", ++number, json_number_value(value));
        }
    }
    return true;
}

/* The vector and the place in it of output number `number`, from 1. */
static size_t locate(const struct umbridge *m, size_t number, size_t *place)
{
    size_t i = 0;
    for (*place = number - 1; i < m->n_outputs && *place >= m->outputs[i]; i++)
        *place -= m->outputs[i];
    return i;
}

static int print_gradient(const struct umbridge *m, const double *x, size_t number, FILE *out,
                          FILE *err)
{
    struct request r;
    size_t place, vector = locate(m, number, &place);
    fprintf(out, "gradient =");
    for (size_t i = 0; i < m->n_inputs; i++) {
        json_t *body = named(m), *sens = json_array();
        for (size_t k = 0; k < m->outputs[vector]; k++)
            json_array_append_new(sens, json_real(k == place));
        json_object_set_new(body, "outWrt", json_integer((json_int_t)vector));
        json_object_set_new(body, "inWrt", json_integer((json_int_t)i));
        json_object_set_new(body, "input", inputs_json(m, x));
        json_object_set_new(body, "sens", sens);
        if (!request(m, "Gradient", body, &r))
            return say(&r, classify(&r), err);
        const json_t *output = json_object_get(r.root, "output");
        bool ok = json_array_size(output) == m->inputs[i];
        for (size_t k = 0; k < m->inputs[i] && ok; k++)
            fprintf(out, " %.17g", json_number_value(json_array_get(output, k)));
        snprintf(r.reason, sizeof r.reason, "%s: a gradient of other sizes", m->url);
        if (!ok)
            return say(&r, UMBRIDGE_MODEL, err);
        json_decref(r.root);
    }
    fputc('\n', out);
    return 0;
}

int umbridge_evaluate(const struct umbridge *m, const double *x, size_t gradient, FILE *out,
                      FILE *err)
{
    struct request r;
    json_t *body = named(m);
    json_object_set_new(body, "input", inputs_json(m, x));
    if (!request(m, "Evaluate", body, &r))
        return say(&r, classify(&r), err);
    if (!print_outputs(m, json_object_get(r.root, "output"), out)) {
        snprintf(r.reason, sizeof r.reason, "%s: outputs of other sizes than it said", m->url);
        return say(&r, UMBRIDGE_MODEL, err);
    }
    json_decref(r.root);
    return gradient ? print_gradient(m, x, gradient, out, err) : 0;
}

/* The numbers of an answer; false when they are not as many, or not all numbers. */
static bool read_outputs(const struct umbridge *m, const json_t *output, double *values)
{
    bool ok = json_array_size(output) == m->n_outputs;
    for (size_t i = 0; i < m->n_outputs && ok; i++) {
        const json_t *vector = json_array_get(output, i);
        ok = json_array_size(vector) == m->outputs[i];
        for (size_t k = 0; k < m->outputs[i] && ok; k++) {
            const json_t *value = json_array_get(vector, k);
            ok = json_is_number(value);
            *values++ = json_number_value(value);
        }
    }
    return ok;
}

int umbridge_numbers(const struct umbridge *m, const double *x, double *output, char *sentence)
{
    struct request r;
    json_t *body = named(m);
    json_object_set_new(body, "input", inputs_json(m, x));
    int status = request(m, "Evaluate", body, &r) ? 0 : classify(&r);
    if (status == 0 && !read_outputs(m, json_object_get(r.root, "output"), output)) {
        snprintf(r.reason, sizeof r.reason, "%s: no numbers, or not as many as it said", m->url);
        status = UMBRIDGE_LOST;
    }
    fail(sentence, "%s", r.reason);
    json_decref(r.root);
    return status;
}
