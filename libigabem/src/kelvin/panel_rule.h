/* The local and the wave part integrated over panels for one field point. */
#ifndef PANEL_RULE_H
#define PANEL_RULE_H

#include "kelvin/panel_frame.h"

struct panel_rule; /* room to work in, one a thread */

struct panel_rule *panel_rule_create(void); /* NULL: no memory */
void panel_rule_free(struct panel_rule *rule);

/* Adds the integrals of N + W (the parts that options ask for), as G and its gradient, to
 * out[m][4]. */
igabem_status panel_rule_add(struct panel_rule *rule, double k0, size_t i, const double P[3],
                             size_t m, const struct panel *panels,
                             const igabem_matrix_options *options, double (*out)[4]);

#endif
