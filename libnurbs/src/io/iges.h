/* IGES 5.3 files: the fixed records and free-format parameters behind nurbs_patches_read_iges(). */
#ifndef NURBS_IGES_H
#define NURBS_IGES_H

#include "io/face.h"

#include <nurbs/curve.h>
#include <nurbs/status.h>
#include <nurbs/surface.h>

#include <stdbool.h>

/* Free-format parameters of one record: pieces of text, blanks around them removed. */
typedef struct iges_record {
    size_t count;
    const char **field; /* not terminated */
    size_t *length;
} iges_record;

typedef struct iges_entity {
    int type, form;
    size_t transformation; /* index of a 124 plus 1; 0: none */
    int dependent;         /* the two digits of "subordinate" */
    bool blank;            /* not to be shown */
    size_t first_line;     /* of its parameters, counted from 0 */
    iges_record record;
} iges_entity;

typedef struct iges_file {
    const char *path;        /* borrowed */
    char *text, *parameters; /* the file; the parameter section in lines of 64 columns */
    size_t parameter_lines;
    iges_record global;
    size_t count;
    iges_entity *entity;
    char parameter_delimiter, record_delimiter;
    double metres; /* per unit of the file */
    char *report;  /* fills report_size bytes; grows by iges_report() */
    size_t report_size, report_used;
} iges_file;

nurbs_status iges_open(const char *path, iges_file *file);
void iges_close(iges_file *file);

/* Appends a sentence to the report; silently cut when it is full. */
__attribute__((format(printf, 2, 3))) void iges_report(iges_file *file, const char *format, ...);

/* Directory entry number as other programs show it: 1, 3, 5 ... */
static inline size_t iges_number(size_t index)
{
    return 2 * index + 1;
}

/* Parameter k of an entity (0: the one after the entity type). An absent or empty one is the
 * default. */
nurbs_status iges_real(const iges_file *file, size_t entity, size_t k, double missing,
                       double *value);
nurbs_status iges_integer(const iges_file *file, size_t entity, size_t k, long missing,
                          long *value);
/* A pointer to an entity; *index gets its index. */
nurbs_status iges_pointer(const iges_file *file, size_t entity, size_t k, size_t *index);
/* Number of parameters after the entity type. */
size_t iges_parameters(const iges_file *file, size_t entity);

/* Row by row matrix and shift (in metres) of an entity's transformation chain. */
nurbs_status iges_transformation(const iges_file *file, size_t entity, double matrix[9],
                                 double shift[3]);

/* Entity 128 in metres, transformed, clamped, cut to its stated range. */
nurbs_status iges_surface(iges_file *file, size_t entity, nurbs_surface **surface);

/* Entities 100, 104, 106, 110, 112 and 126 as one curve; scale 1 for curves in parameter space,
 * else metres. Transformed. */
nurbs_status iges_curve(iges_file *file, size_t entity, double scale, nurbs_curve **curve);
/* The same, and composites 102, in metres: as their parts (nurbs_curves_free), or joined. */
nurbs_status iges_curve_parts(iges_file *file, size_t entity, size_t *count, nurbs_curve ***parts);
nurbs_status iges_curve_joined(iges_file *file, size_t entity, nurbs_curve **curve);

/* Of iges_curve, before its transformation. */
nurbs_status iges_conic(const iges_file *file, size_t entity, double metres, nurbs_curve **curve);
nurbs_status iges_polyline(const iges_file *file, size_t entity, double metres,
                           nurbs_curve **curve);
nurbs_status iges_parametric(const iges_file *file, size_t entity, double metres,
                             nurbs_curve **curve);

/* Entities that are surfaces by themselves, but no B-spline surface. */
bool iges_is_form(int type);
/* The form behind a surface entity of any type, in metres, transformed. The caller frees it. */
nurbs_status iges_form(iges_file *file, size_t entity, cad_form *f);
/* The whole of a surface entity that ends by itself: 118, 120, 122, 128, 196, 198, and 140 on
 * such ones; a plane 108 inside its own curve is a face. NURBS_ERROR_GEOMETRY: it has no end. */
nurbs_status iges_whole(iges_file *file, size_t entity, nurbs_surface **surface);

/* A face: entity 144, 143 or 510. */
typedef enum iges_trim {
    IGES_WHOLE,   /* its loops run along the boundary of the surface */
    IGES_TRIMMED, /* a loop cuts the surface */
    IGES_UNKNOWN  /* no curves in parameter space */
} iges_trim;

typedef struct iges_face {
    size_t surface; /* index of the base surface */
    iges_trim trim;
    size_t loops;
    size_t count; /* curves of all loops in parameter space, in their order */
    size_t room;
    nurbs_curve **curve;
    size_t *end; /* [loops] of each loop's curves */
} iges_face;

int iges_is_face(int type);
/* Base surface and curves of a face; nothing to free after a failure. */
nurbs_status iges_face_read(iges_file *file, size_t entity, iges_face *face);
void iges_face_free(iges_face *face);

/* Base surface of a face, and the bounding curves of face or plane 108 as curves in space, each in
 * the direction of its loop. NURBS_ERROR_GEOMETRY: it has none there. The caller frees the face. */
nurbs_status iges_face_base(const iges_file *file, size_t entity, size_t *surface);
nurbs_status iges_face_space(iges_file *file, size_t entity, cad_face *f);

#endif
