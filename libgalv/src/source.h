/* Streams of displacement rows: where samples come from, which coordinates move, weights and shift.
 */
#ifndef GALV_SOURCE_H
#define GALV_SOURCE_H

#include "stage.h"

/* Produces rows of a data set that nobody has to hold at once. */
typedef struct galv_source galv_source;
struct galv_source {
    size_t samples;       /* N */
    size_t coordinates;   /* L, with those that never move */
    size_t stored;        /* coordinates a row holds */
    const size_t *index;  /* place of stored coordinate s among the L */
    const double *values; /* all rows, when they are in memory; else NULL and `rows` is called */
    /* Fills rows (count rows of `stored` numbers) with samples first..first+count-1. A failure's
     * message names the sample. */
    galv_status (*rows)(galv_source *source, size_t first, size_t count, double *rows);
};

/* A source of N samples of a shape on fixed points, with the appended quantities behind each row.
 */
typedef struct galv_shape_source {
    galv_source head;
    const galv_shape *shape;
    galv_sampling sampling;
    struct galv_plan *plan;
    const galv_extra *extra; /* NULL: none */
    size_t npoints;
    const double *xyz;
    double *parent; /* appended quantities of the parent */
    size_t *index;  /* places of the stored coordinates and the appended quantities */
    double *x;      /* parameters of one block */
} galv_shape_source;

/* block: the most rows asked for at once. */
galv_status galv_shape_source_start(galv_shape_source *source, const galv_shape *shape,
                                    size_t npoints, const double *xyz, galv_sampling sampling,
                                    const galv_extra *extra, size_t block);
void galv_shape_source_end(galv_shape_source *source);
/* Parameters of sample r, into x. */
void galv_shape_source_parameters(const galv_shape_source *source, size_t r, double *x);

/* Reads a source block by block as the columns of an active x count matrix, with the coordinates
 * that have moved so far (in order of their discovery), weighted and shifted. */
typedef struct galv_stream {
    galv_source *source;
    size_t block;        /* most rows at once */
    size_t active;       /* coordinates that moved in some row read so far */
    size_t *place;       /* place[a]: stored coordinate of active coordinate a */
    unsigned char *seen; /* per stored coordinate: whether it has moved */
    uint64_t *hidden;    /* per stored coordinate: all bits set until it has a place */
    double *scale;       /* per stored coordinate, square root of its weight; NULL: 1 */
    double *shift;       /* per stored coordinate, subtracted; NULL: none */
    double *buffer;      /* block x stored, unless the source's values are in memory */
    const double *raw;   /* the block as the source gave it */
    double *packed;      /* block x active, scaled and shifted */
    const double *rows;  /* what readers use: packed, or raw when that is the same */
    double *energy;      /* per row of the block, squared norm of `rows` */
    galv_stage stage;
} galv_stream;

/* weights: one per coordinate, or NULL. */
galv_status galv_stream_start(galv_stream *stream, galv_source *source, size_t block,
                              const double *weights, bool shifted);
void galv_stream_end(galv_stream *stream);

/* Gives places to all coordinates in which one of n stored rows differs from zero. */
void galv_stream_expect(galv_stream *stream, size_t n, const double *rows);

/* Reads rows first..first+count-1; `active` may have grown on return. When the stream is shifted,
 * sample 0 is the shift: it must be read first. */
galv_status galv_stream_read(galv_stream *stream, size_t first, size_t count);

/* Tells the caller's progress function that `done` samples of this pass are read; fails when it
 * cancels. */
galv_status galv_stream_report(galv_stream *stream, size_t done);

#endif
