/* The figures by which a naval architect knows a hull, before and after. */
#ifndef HULLOPT_PARTICULARS_H
#define HULLOPT_PARTICULARS_H

#include "report/results.h"

enum { PARTICULARS_MOST = 24 };

struct particular {
    const char *key, *label, *unit; /* unit "" for coefficients */
    int decimals;
    double value[2]; /* original, optimum */
};

/* Fills the list; returns how many. Both designs must be there. */
size_t particulars_list(const struct results *results, struct particular list[PARTICULARS_MOST]);

#endif
