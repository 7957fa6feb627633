/* What the configuration of a request may change of a run's problem. */
#ifndef HULLOPT_VARIANT_H
#define HULLOPT_VARIANT_H

#include "core/evaluate.h"
#include "serve/protocol.h"

struct variant {
    bool as_run; /* all that a run asks of a design, nothing changed; the rest is not used then */
    size_t n;
    double froude[1 + CONFIG_FROUDE_MOST];
    igabem_formulation formulation;
    int refine;
};

/* Reads {"froude": number or list, "formulation": name, "refine": factor} over what the run has. */
bool variant_read(const struct config *run, const json_t *config, struct variant *variant,
                  struct served_error *error);

/* Writes it into a copy of the run's configuration. Every speed is solved, by one formulation, and
 * no built design fails for its displacement: that is an output. */
void variant_apply(const struct variant *variant, const struct config *run, struct config *config);

bool variant_equal(const struct variant *a, const struct variant *b);

/* The outputs: C_w by speed; the constraints of the run, <= 0 where kept; figures of the design.
 * parent and design were evaluated under the variant. */
void variant_sizes(const struct variant *variant, const struct config *run,
                   size_t sizes[SERVED_OUTPUTS]);
void variant_output(const struct variant *variant, const struct config *run,
                    const struct evaluation *parent, const struct evaluation *design,
                    double *output);
json_t *variant_labels(const struct config *run);

#endif
