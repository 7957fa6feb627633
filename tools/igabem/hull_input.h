/* From a hull file to the wetted hull that the solver takes. */
#ifndef HULL_INPUT_H
#define HULL_INPUT_H

#include "settings.h"

#include <igabem/hull.h>
#include <nurbs/nurbs.h>

#include <stdbool.h>

/* What to do with the file. */
struct hull_request {
    char *path;
    double level;    /* z of the still water in the file's axes, m */
    double draft;    /* keel draft amidships that sets the level instead; NAN: not given */
    double simplify; /* tolerance of knot removal over the length; 0: none; NAN: 1e-4 if cut */
    double length;   /* reference length, m; NAN: the file's, else the waterline's */
    double sinkage, trim, pivot; /* attitude: m, positive down; radians, positive bow up, about
                                    x = pivot in the still water */
    bool unbounded; /* there is no water surface: the body is moved below z = 0 and not cut */
    bool quiet;     /* what was done to the file has been told before */
};

/* The rows of a command's table that say so; `hull` is the hull_request in its target. */
#define HULL_ROW(part, name, kind, place, ...)                                                     \
    {                                                                                              \
        .option = (name), .type = SETTING_##kind, .offset = offsetof(part, place), __VA_ARGS__     \
    }
#define HULL_FILE_ROW(part, hull)                                                                  \
    HULL_ROW(part, "HULL", TEXT, hull.path, .sentence = "the hull's file", .required = true)
#define HULL_WATER_ROWS(part, hull)                                                                \
    HULL_ROW(part, "length", NUMBER, hull.length,                                                  \
             .sentence = "reference length, m; by rule the file's, else the waterline's",          \
             SETTING_ABOVE(0), .words = HULL_BY_RULE),                                             \
        HULL_ROW(part, "level", NUMBER, hull.level,                                                \
                 .sentence = "z of the still water in the file, m"),                               \
        HULL_ROW(part, "draft", NUMBER, hull.draft,                                                \
                 .sentence = "keel draft amidships that sets it instead, m", SETTING_ABOVE(0),     \
                 .words = HULL_BY_RULE),                                                           \
        HULL_ROW(part, "simplify", NUMBER, hull.simplify,                                          \
                 .sentence = "knot removal tolerance over the length; 0 none; by rule 1e-4 if "    \
                             "the hull is cut",                                                    \
                 SETTING_FROM(0, INFINITY), .words = HULL_BY_RULE)
#define HULL_JSON_ROW(part, json)                                                                  \
    HULL_ROW(part, "json", SWITCH, json,                                                           \
             .sentence = "one JSON object on standard output and nothing else")
extern const struct setting_word HULL_BY_RULE[];

struct hull_input {
    nurbs_hull *source;           /* owned */
    igabem_hull *hull;            /* owned */
    const nurbs_patches *patches; /* light ones of the source: wetted, z = 0 the still water */
    const char *note;             /* how the water divides the hull */
    bool half;                    /* y >= 0 only, the other side is the mirror image */
    double simplify_bound;        /* metres, 0 if nothing was simplified */
    double lpp;                   /* of the file, 0: none given */
};

void hull_request_init(struct hull_request *request);

/* Reads, cleans, cuts, simplifies and checks; tells what was done to the file on stderr. Returns
 * CLI_OK, or CLI_FAILED after a message. */
int hull_input_read(const struct hull_request *request, struct hull_input *input);
void hull_input_free(struct hull_input *input);

/* "open transom", "closed transom" or "no transom". */
const char *hull_stern(const igabem_hull_info *info);

#endif
