/* How fine a density to start from when the command line does not say. */
#ifndef IGABEM_TOOL_RESOLUTION_H
#define IGABEM_TOOL_RESOLUTION_H

#include "hull_input.h"

#include <igabem/igabem.h>

/* Sets options->refine and refine_v so that there are about 400 unknowns, on the last level but one
 * of a ladder whose `levels` are each half as fine again; a hull of more spans is left as it is.
 * CLI_OK, or CLI_FAILED after a message. */
int resolution_by_rule(const struct hull_input *input, int levels, igabem_options *options);

#endif
