/* Sinkage and trim at which a hull under way floats freely. */
#ifndef IGABEM_TOOL_EQUILIBRIUM_H
#define IGABEM_TOOL_EQUILIBRIUM_H

#include "solve.h"

/* Finds request->hull.sinkage and .trim from the hull at rest in *input, which it replaces by the
 * hull in that attitude; fixes in request->options what follows from the hull at rest. One Froude
 * number, one formulation that has pressures. CLI_OK or CLI_FAILED after a message. */
int equilibrium_find(struct solve_request *request, struct hull_input *input);

#endif
