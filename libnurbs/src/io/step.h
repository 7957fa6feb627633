/* STEP files (ISO 10303-21): the syntax, and the geometry of AP203, AP214 and AP242 behind
 * nurbs_patches_read_step(). */
#ifndef NURBS_STEP_H
#define NURBS_STEP_H

#include "io/face.h"

#include <nurbs/status.h>

#include <stdbool.h>
#include <stddef.h>

typedef enum step_kind {
    STEP_OMITTED, /* $ */
    STEP_DERIVED, /* * */
    STEP_NUMBER,
    STEP_STRING, /* between its quotes */
    STEP_ENUM,   /* between its dots */
    STEP_BINARY,
    STEP_REFERENCE,
    STEP_LIST,
    STEP_TYPED /* NAME(value): a list with a name */
} step_kind;

/* Children of lists hang on `first` and `next`, indices of nodes; 0 ends. */
typedef struct step_node {
    step_kind kind;
    size_t first, next, count;
    double number;
    size_t id; /* of a reference */
    const char *text;
    size_t length;
} step_node;

/* One NAME(...) of an instance; a complex instance has several. */
typedef struct step_record {
    const char *name;
    size_t length;
    size_t list; /* node of the parameters */
} step_record;

typedef struct step_instance {
    size_t id, line;
    size_t first, count; /* records */
} step_instance;

typedef struct step_file {
    const char *path; /* borrowed */
    char *text;
    size_t line; /* while parsing */
    size_t nodes, node_room;
    step_node *node; /* node 0 is none */
    size_t records, record_room;
    step_record *record;
    size_t count, room;
    step_instance *instance; /* by growing id */
    char schema[64];
    double metres, radians; /* per unit of the representation being read */
    char *report;
    size_t report_size, report_used;
} step_file;

nurbs_status step_open(const char *path, step_file *file);
void step_close(step_file *file);
__attribute__((format(printf, 2, 3))) void step_report(step_file *file, const char *format, ...);

/* Index of an instance; file->count: none. */
size_t step_find(const step_file *file, size_t id);
/* The record of that name in an instance, or NULL. */
const step_record *step_record_of(const step_file *file, size_t instance, const char *name);
/* Name of the instance's first record, for messages. */
const char *step_name(const step_file *file, size_t instance, char text[64]);
__attribute__((format(printf, 3, 4))) nurbs_status
step_refuse(const step_file *file, size_t instance, const char *format, ...);

/* Parameter k of a record; NULL: none. */
const step_node *step_parameter(const step_file *file, const step_record *record, size_t k);
/* Child k of a list, and the one behind a child. */
const step_node *step_child(const step_file *file, const step_node *list, size_t k);
const step_node *step_next(const step_file *file, const step_node *node);

/* Values; failures name the instance. A typed value gives what it holds. */
nurbs_status step_number(const step_file *file, size_t instance, const step_node *node,
                         double *value);
nurbs_status step_size(const step_file *file, size_t instance, const step_node *node, size_t most,
                       size_t *value);
nurbs_status step_reference(const step_file *file, size_t instance, const step_node *node,
                            size_t *index);
nurbs_status step_list(const step_file *file, size_t instance, const step_node *node);
/* .T. is true; anything else is `missing`, .F. false. */
bool step_flag(const step_node *node, bool missing);
/* A string in UTF-8, its directives (\X\, \X2\, \X4\, \S\) decoded; cut at size. */
void step_string(const step_node *node, size_t size, char *text);

/* Lengths are metres. */
nurbs_status step_point(const step_file *file, size_t instance, double p[3]);
nurbs_status step_direction(const step_file *file, size_t instance, double d[3]);
/* Frame of an AXIS2_PLACEMENT_3D or AXIS1_PLACEMENT: origin and three unit vectors. */
nurbs_status step_placement(const step_file *file, size_t instance, double origin[3],
                            double frame[3][3]);

/* A curve as a whole: lines as the segment of one vector, conics as a full turn. */
nurbs_status step_curve(step_file *file, size_t instance, int depth, nurbs_curve **curve);
/* An EDGE_CURVE from its first to its second vertex. */
nurbs_status step_edge(step_file *file, size_t instance, nurbs_curve **curve);
nurbs_status step_form(step_file *file, size_t instance, int depth, cad_form *f);

/* Control points in homogeneous form and knots, clamped if need be. */
nurbs_status step_spline_curve(step_file *file, size_t instance, nurbs_curve **curve);
nurbs_status step_spline_surface(step_file *file, size_t instance, nurbs_surface **surface);
bool step_is_spline(const step_file *file, size_t instance, bool surface);

/* An ADVANCED_FACE or FACE_SURFACE; the caller frees the face. */
nurbs_status step_face(step_file *file, size_t instance, cad_face *f);

#endif
