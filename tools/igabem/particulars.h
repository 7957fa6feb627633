/* Hydrostatic particulars of a wetted hull, in the order of the printed page. */
#ifndef PARTICULARS_H
#define PARTICULARS_H

#include "hull_input.h"

enum { PARTICULARS_MOST = 64 };

struct particular {
    const char *key, *unit, *text;
    double value; /* NAN: has no meaning for this hull */
};

struct particulars {
    size_t count;
    struct particular item[PARTICULARS_MOST];
    size_t stations;
    double *station_x, *station_area; /* m, m^2 of both sides */
    char note[200];
};

/* kg: height of the centre of gravity above the keel, m; NAN: unknown. CLI_OK or CLI_FAILED. */
int particulars_find(const struct hull_input *input, double density, double kg, size_t stations,
                     struct particulars *particulars);
void particulars_free(struct particulars *particulars);

#endif
