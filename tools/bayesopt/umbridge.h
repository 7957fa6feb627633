/* Models of other programs over HTTP: a client of the UM-Bridge protocol, version 1.0. */
#ifndef BAYESOPT_TOOL_UMBRIDGE_H
#define BAYESOPT_TOOL_UMBRIDGE_H

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

/* Asks the server for the model and its sizes, which must be those of d variables and of outputs
 * up to number `most`. Prints the sentence on failure; umbridge_close() in any case. */
bool umbridge_open(struct umbridge *model, const char *url, const char *name, const char *config,
                   size_t d, size_t most);
void umbridge_close(struct umbridge *model);

/* One evaluation at x [d]: prints "output.1 = 3" and so on, and with gradient > 0 the derivatives
 * of that output as "gradient = ...". Returns 0 or one of the statuses, with the sentence on err.
 */
int umbridge_evaluate(const struct umbridge *model, const double *x, size_t gradient, FILE *out,
                      FILE *err);

#endif
