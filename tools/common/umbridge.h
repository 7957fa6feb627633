/* Models of other programs over HTTP: a client of the UM-Bridge protocol, version 1.0. */
#ifndef TOOLS_UMBRIDGE_H
#define TOOLS_UMBRIDGE_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct umbridge {
    const char *url, *name;                        /* borrowed */
    json_t *config;                                /* an object */
    size_t n_inputs, n_outputs, *inputs, *outputs; /* vectors, and how long each is */
    bool has_gradient;
};

/* Exit statuses of an evaluation, as in sysexits.h. */
enum { UMBRIDGE_INPUT = 65, UMBRIDGE_MODEL = 70, UMBRIDGE_LOST = 75 };

enum { UMBRIDGE_SENTENCE = 512 };

/* Asks the server for the model and its sizes, which must be those of d variables and of outputs
 * up to number `most`. Takes the configuration of all requests, an object; NULL: an empty one. On
 * failure fills sentence[UMBRIDGE_SENTENCE]; umbridge_close() in any case. */
bool umbridge_open(struct umbridge *model, const char *url, const char *name, json_t *config,
                   size_t d, size_t most, char *sentence);
void umbridge_close(struct umbridge *model);

/* One evaluation at x [d]: prints "output.1 = 3" and so on, and with gradient > 0 the derivatives
 * of that output as "gradient = ...". Returns 0 or one of the statuses, with the sentence on err.
 */
int umbridge_evaluate(const struct umbridge *model, const double *x, size_t gradient, FILE *out,
                      FILE *err);
/* The same into output, as many numbers as the model gives. Only an error that the model itself
 * tells is UMBRIDGE_MODEL: every other answer that is not all numbers is that of a lost server. */
int umbridge_numbers(const struct umbridge *model, const double *x, double *output, char *sentence);

#endif
