/* UM-Bridge 1.0, the server's side without the network: the path and body of a request in, a status
 * of HTTP and a JSON text out (um-bridge-benchmarks.readthedocs.io, "Interface"). */
#ifndef HULLOPT_PROTOCOL_H
#define HULLOPT_PROTOCOL_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

enum { SERVED_OUTPUTS = 3, SERVED_SENTENCE = 512 };

/* Why a request is not answered. */
enum served_fault {
    SERVED_INVALID_INPUT,   /* the caller's: status 400 */
    SERVED_MODEL_NOT_FOUND, /* 400 */
    SERVED_UNSUPPORTED,     /* 400 */
    SERVED_INVALID_OUTPUT,  /* the model's: 500 */
    SERVED_UNAVAILABLE,     /* nobody's: 503 */
    SERVED_FAULTS
};
struct served_error {
    enum served_fault fault;
    char sentence[SERVED_SENTENCE];
};
/* Fills the error and returns false. */
__attribute__((format(printf, 3, 4))) bool
served_fail(struct served_error *error, enum served_fault fault, const char *format, ...);

/* A model: one vector in, SERVED_OUTPUTS vectors out. The calls come from several threads. */
struct served {
    const char *name;
    size_t n;                    /* numbers of the input, */
    const double *lower, *upper; /* [n] between which each is; NULL: any */
    /* Numbers of each output under a configuration, which is an object. */
    bool (*sizes)(const struct served *model, const json_t *config, size_t sizes[SERVED_OUTPUTS],
                  struct served_error *error);
    /* What the numbers of each output are called: a list of lists of strings. */
    json_t *(*labels)(const struct served *model);
    /* Fills output, one vector after the other. */
    bool (*evaluate)(const struct served *model, const double *input, const json_t *config,
                     double *output, struct served_error *error);
    /* Fills jacobian [numbers of output k][n]; NULL: the model has no derivatives. */
    bool (*differentiate)(const struct served *model, const double *input, const json_t *config,
                          size_t k, double *jacobian, struct served_error *error);
    void *user_data;
};

/* Answers a request with its status; *text, which the caller frees, is NULL for want of memory. */
unsigned protocol_answer(size_t n, const struct served *models, const char *method,
                         const char *path, size_t size, const char *body, char **text);
/* The same for a request that the transport refuses. */
unsigned protocol_refuse(unsigned status, const char *sentence, char **text);

#endif
