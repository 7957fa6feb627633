/* By what two sides of a network know that they speak of one problem: the settings that decide what
 * a design is, and where the ends of each variable move the design grid. */
#ifndef HULLOPT_IDENTITY_H
#define HULLOPT_IDENTITY_H

#include "core/problem.h"

#include <jansson.h>

/* {"settings": text, "moves": [[sum, size], ...]}; NULL with a sentence. */
json_t *identity_of(const struct problem *problem);

/* Whether theirs is the same problem as mine; otherwise sentence[size] names what differs. */
bool identity_agrees(const json_t *mine, const json_t *theirs, char *sentence, size_t size);

#endif
