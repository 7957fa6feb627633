/* The parts of the page that are text and tables. */
#ifndef HULLOPT_REPORT_PARTS_H
#define HULLOPT_REPORT_PARTS_H

#include "report/results.h"

#include <stdio.h>

/* Doctype, style, title, the key figures and the verdict. */
void report_head(FILE *out, const struct results *results);
/* The Pareto set; nothing of one objective. */
void report_front(FILE *out, const struct results *results);
void report_particulars(FILE *out, const struct results *results);
void report_failures(FILE *out, const struct results *results);
void report_verification(FILE *out, const struct results *results);
/* Nothing without search.models. */
void report_agreement(FILE *out, const struct results *results);
/* The model of the search, where it has one. */
void report_model(FILE *out, const struct results *results);
void report_settings(FILE *out, const struct results *results);

#endif
