/* nurbs_patches_write_step(): every patch a face of one open shell, AP214. */
#include "core/error.h"
#include "core/textfile.h"
#include "core/vector.h"

#include <nurbs/io.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Opposite edges whose control points agree within this share of the patch's extent are one edge, a
 * seam; an edge that is no longer has collapsed. */
static const double same_place = 1e-9;

typedef struct writer {
    FILE *stream;
    size_t next; /* number of the next instance */
} writer;

/* Numbers that read back bit for bit, with the decimal point that Part 21 wants. */
static void put_real(FILE *stream, double value)
{
    char text[40];
    snprintf(text, sizeof text, "%.17g", value);
    if (!strpbrk(text, ".e"))
        strcat(text, ".");
    else if (!strchr(text, '.')) {
        char *e = strchr(text, 'e');
        memmove(e + 1, e, strlen(e) + 1);
        *e = '.';
    }
    for (char *c = text; *c; c++)
        *c = *c == 'e' ? 'E' : *c;
    fputs(text, stream);
}

static size_t put_point(writer *w, const double p[3])
{
    fprintf(w->stream, "#%zu=CARTESIAN_POINT('',(", w->next);
    for (int c = 0; c < 3; c++) {
        fputs(c ? "," : "", w->stream);
        put_real(w->stream, p[c]);
    }
    fputs("));\n", w->stream);
    return w->next++;
}

/* References first ... first + n - 1 in steps. */
static void put_references(FILE *stream, size_t first, size_t n)
{
    fputc('(', stream);
    for (size_t k = 0; k < n; k++)
        fprintf(stream, "%s#%zu%s", k ? "," : "", first + k, k % 12 == 11 ? "\n" : "");
    fputc(')', stream);
}

/* "(4,1,4),(0.,0.5,1.)" */
static void put_multiplicities(FILE *stream, size_t count, const double *knots)
{
    fputc('(', stream);
    for (size_t k = 0; k < count;) {
        size_t m = 1;
        while (k + m < count && knots[k + m] == knots[k])
            m++;
        fprintf(stream, "%s%zu", k ? "," : "", m);
        k += m;
    }
    fputc(')', stream);
}

static void put_knots(FILE *stream, size_t count, const double *knots)
{
    fputc('(', stream);
    for (size_t k = 0; k < count; k++)
        if (k == 0 || knots[k] != knots[k - 1]) {
            fputs(k ? "," : "", stream);
            put_real(stream, knots[k]);
        }
    fputc(')', stream);
}

static void put_weights(FILE *stream, size_t n, const double *weights)
{
    fputc('(', stream);
    for (size_t k = 0; k < n; k++) {
        fputs(k ? "," : "", stream);
        put_real(stream, weights[k]);
        fputs(k % 8 == 7 ? "\n" : "", stream);
    }
    fputc(')', stream);
}

static size_t put_curve(writer *w, const nurbs_curve *curve)
{
    size_t n = nurbs_curve_size(curve), first = w->next;
    int degree = nurbs_curve_degree(curve);
    size_t knots = n + (size_t)degree + 1;
    const double *weights = nurbs_curve_weights(curve);
    for (size_t k = 0; k < n; k++)
        put_point(w, nurbs_curve_points(curve) + 3 * k);
    FILE *f = w->stream;
    if (weights)
        fprintf(f, "#%zu=(BOUNDED_CURVE()B_SPLINE_CURVE(%d,", w->next, degree);
    else
        fprintf(f, "#%zu=B_SPLINE_CURVE_WITH_KNOTS('',%d,", w->next, degree);
    put_references(f, first, n);
    fputs(",.UNSPECIFIED.,.F.,.F.", f);
    fputs(weights ? ")B_SPLINE_CURVE_WITH_KNOTS(" : ",", f);
    put_multiplicities(f, knots, nurbs_curve_knots(curve));
    fputc(',', f);
    put_knots(f, knots, nurbs_curve_knots(curve));
    fputs(",.UNSPECIFIED.)", f);
    if (weights) {
        fputs("CURVE()GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE(", f);
        put_weights(f, n, weights);
        fputs(")REPRESENTATION_ITEM(''))", f);
    }
    fputs(";\n", f);
    return w->next++;
}

static size_t put_surface(writer *w, const nurbs_surface *surface)
{
    size_t nu = nurbs_surface_size(surface, 0), nv = nurbs_surface_size(surface, 1),
           first = w->next;
    const double *weights = nurbs_surface_weights(surface);
    for (size_t k = 0; k < nu * nv; k++)
        put_point(w, nurbs_surface_points(surface) + 3 * k);
    FILE *f = w->stream;
    fprintf(f,
            weights ? "#%zu=(BOUNDED_SURFACE()B_SPLINE_SURFACE(%d,%d,("
                    : "#%zu=B_SPLINE_SURFACE_WITH_KNOTS('',%d,%d,(",
            w->next, nurbs_surface_degree(surface, 0), nurbs_surface_degree(surface, 1));
    for (size_t i = 0; i < nu; i++) {
        fputs(i ? ",\n" : "", f);
        put_references(f, first + i * nv, nv);
    }
    fputs("),.UNSPECIFIED.,.F.,.F.,.F.", f);
    fputs(weights ? ")B_SPLINE_SURFACE_WITH_KNOTS(" : ",", f);
    size_t count[2];
    for (int d = 0; d < 2; d++) {
        count[d] = nurbs_surface_size(surface, d) + (size_t)nurbs_surface_degree(surface, d) + 1;
        put_multiplicities(f, count[d], nurbs_surface_knots(surface, d));
        fputc(',', f);
    }
    for (int d = 0; d < 2; d++) {
        put_knots(f, count[d], nurbs_surface_knots(surface, d));
        fputc(',', f);
    }
    fputs(".UNSPECIFIED.)", f);
    if (weights) {
        fputs("GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE((", f);
        for (size_t i = 0; i < nu; i++) {
            fputs(i ? ",\n" : "", f);
            put_weights(f, nv, weights + i * nv);
        }
        fputs("))REPRESENTATION_ITEM('')SURFACE())", f);
    }
    fputs(";\n", f);
    return w->next++;
}

/* The four sides of a patch: 0 at v low, 1 at u high, 2 at v high, 3 at u low, each in the
 * direction of growing parameter. */
typedef struct side {
    nurbs_curve *curve;
    size_t corner[2]; /* 0 (low, low), 1 (high, low), 2 (high, high), 3 (low, high) */
    bool collapsed;
    size_t edge; /* its EDGE_CURVE */
} side;

static double extent_of(const nurbs_surface *surface)
{
    const double *p = nurbs_surface_points(surface);
    double most = 0;
    for (size_t k = 1; k < nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1); k++)
        most = fmax(most, distance3(p, p + 3 * k));
    return most;
}

static bool same_curve(const nurbs_curve *a, const nurbs_curve *b, double near)
{
    for (size_t k = 0; k < nurbs_curve_size(a); k++)
        if (distance3(nurbs_curve_points(a) + 3 * k, nurbs_curve_points(b) + 3 * k) > near)
            return false;
    return true;
}

static nurbs_status find_sides(const nurbs_surface *surface, double near, side sides[4])
{
    static const size_t corner[4][2] = {{0, 1}, {1, 2}, {3, 2}, {0, 3}};
    nurbs_status status = NURBS_OK;
    for (int k = 0; k < 4 && status == NURBS_OK; k++) {
        int fixed = k % 2 ? 0 : 1; /* the parameter that is constant */
        bool high = k == 1 || k == 2;
        const double *knots = nurbs_surface_knots(surface, fixed);
        status = nurbs_surface_iso_curve(
            surface, fixed, high ? knots[nurbs_surface_size(surface, fixed)] : knots[0],
            &sides[k].curve);
        if (status != NURBS_OK)
            break;
        const double *p = nurbs_curve_points(sides[k].curve);
        sides[k].collapsed = true;
        for (size_t i = 1; i < nurbs_curve_size(sides[k].curve); i++)
            sides[k].collapsed &= distance3(p, p + 3 * i) <= near;
        memcpy(sides[k].corner, corner[k], sizeof corner[k]);
    }
    return status;
}

/* Corners at one place share a vertex. */
static void put_vertices(writer *w, const side sides[4], double near, size_t vertex[4])
{
    double place[4][3];
    for (int k = 0; k < 4; k++) {
        const nurbs_curve *curve = sides[k < 2 ? 0 : 2].curve;
        size_t at = k == 1 || k == 2 ? nurbs_curve_size(curve) - 1 : 0;
        memcpy(place[k], nurbs_curve_points(curve) + 3 * at, sizeof place[k]);
        vertex[k] = 0;
        for (int i = 0; i < k; i++)
            if (!vertex[k] && distance3(place[k], place[i]) <= near)
                vertex[k] = vertex[i];
        if (vertex[k])
            continue;
        size_t point = put_point(w, place[k]);
        fprintf(w->stream, "#%zu=VERTEX_POINT('',#%zu);\n", w->next, point);
        vertex[k] = w->next++;
    }
}

static void put_edges(writer *w, side sides[4], double near, const size_t vertex[4])
{
    for (int k = 0; k < 4; k++) {
        if (sides[k].collapsed)
            continue;
        if (k >= 2 && !sides[k - 2].collapsed &&
            same_curve(sides[k].curve, sides[k - 2].curve, near)) {
            sides[k].edge = sides[k - 2].edge; /* a seam */
            continue;
        }
        size_t curve = put_curve(w, sides[k].curve);
        fprintf(w->stream, "#%zu=EDGE_CURVE('',#%zu,#%zu,#%zu,.T.);\n", w->next,
                vertex[sides[k].corner[0]], vertex[sides[k].corner[1]], curve);
        sides[k].edge = w->next++;
    }
}

static nurbs_status put_face(writer *w, const nurbs_surface *surface, size_t *face)
{
    side sides[4] = {{0}, {0}, {0}, {0}};
    size_t vertex[4], first, uses = 0;
    double near = same_place * extent_of(surface);
    nurbs_status status = find_sides(surface, near, sides);
    if (status == NURBS_OK) {
        put_vertices(w, sides, near, vertex);
        put_edges(w, sides, near, vertex);
        first = w->next;
        for (int k = 0; k < 4; k++)
            if (!sides[k].collapsed) {
                fprintf(w->stream, "#%zu=ORIENTED_EDGE('',*,*,#%zu,%s);\n", w->next++,
                        sides[k].edge, k < 2 ? ".T." : ".F.");
                uses++;
            }
        fprintf(w->stream, "#%zu=EDGE_LOOP('',", w->next);
        put_references(w->stream, first, uses);
        fputs(");\n", w->stream);
        size_t loop = w->next++, own = put_surface(w, surface);
        fprintf(w->stream, "#%zu=FACE_OUTER_BOUND('',#%zu,.T.);\n", w->next, loop);
        fprintf(w->stream, "#%zu=ADVANCED_FACE('',(#%zu),#%zu,.T.);\n", w->next + 1, w->next, own);
        w->next += 2;
        *face = w->next - 1;
    }
    for (int k = 0; k < 4; k++)
        nurbs_curve_free(sides[k].curve);
    return status;
}

/* Instances 1 to 22: product, units in metres, and where the shape of it stands. */
enum { CONTEXT = 14, SHAPE = 7, PLACEMENT = 18, FIRST = 23 };

static void put_head(FILE *f)
{
    fputs("ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('NURBS surfaces'),'2;1');\n"
          "FILE_NAME('hull','2024-01-01T00:00:00',(''),(''),'libnurbs','libnurbs','');\n"
          "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n"
          "#1=APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,"
          "#2);\n"
          "#2=APPLICATION_CONTEXT('core data for automotive mechanical design processes');\n"
          "#3=PRODUCT_CONTEXT('',#2,'mechanical');\n"
          "#4=PRODUCT('hull','hull','',(#3));\n"
          "#5=PRODUCT_DEFINITION_FORMATION('','',#4);\n"
          "#6=PRODUCT_DEFINITION_CONTEXT('part definition',#2,'design');\n",
          f);
    fprintf(
        f,
        "#8=PRODUCT_DEFINITION('design','',#5,#6);\n"
        "#9=PRODUCT_DEFINITION_SHAPE('','',#8);\n"
        "#10=SHAPE_DEFINITION_REPRESENTATION(#9,#%d);\n"
        "#11=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n"
        "#12=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
        "#13=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());\n"
        "#%d=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#15))"
        "GLOBAL_UNIT_ASSIGNED_CONTEXT((#11,#12,#13))REPRESENTATION_CONTEXT('',''));\n"
        "#15=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),#11,'distance_accuracy_value',"
        "'');\n"
        "#16=PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(#4));\n"
        "#17=CARTESIAN_POINT('',(0.,0.,0.));\n"
        "#%d=AXIS2_PLACEMENT_3D('',#17,#19,#20);\n"
        "#19=DIRECTION('',(0.,0.,1.));\n#20=DIRECTION('',(1.,0.,0.));\n",
        SHAPE, CONTEXT, PLACEMENT);
}

nurbs_status nurbs_patches_write_step(const nurbs_patches *patches, const char *path)
{
    outfile file;
    if (!patches || !path)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no patches or no path");
    size_t n = nurbs_patches_count(patches), *face = malloc((n + 1) * sizeof *face);
    if (n == 0 || !face) {
        free(face);
        return n ? nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu faces", n)
                 : nurbs_fail(NURBS_ERROR_ARGUMENT, "no patches to write");
    }
    nurbs_status status = outfile_open(&file, path);
    if (status != NURBS_OK) {
        free(face);
        return status;
    }
    writer w = {file.stream, FIRST};
    put_head(file.stream);
    for (size_t k = 0; k < n && status == NURBS_OK; k++)
        status = put_face(&w, nurbs_patches_get(patches, k), &face[k]);
    if (status == NURBS_OK) {
        fprintf(file.stream, "#%zu=OPEN_SHELL('',(", w.next);
        for (size_t k = 0; k < n; k++)
            fprintf(file.stream, "%s#%zu%s", k ? "," : "", face[k], k % 12 == 11 ? "\n" : "");
        fprintf(file.stream,
                "));\n#21=SHELL_BASED_SURFACE_MODEL('',(#%zu));\n"
                "#%d=MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',(#%d,#21),#%d);\n"
                "ENDSEC;\nEND-ISO-10303-21;\n",
                w.next, SHAPE, PLACEMENT, CONTEXT);
        status = outfile_commit(&file);
    } else {
        outfile_abandon(&file);
    }
    free(face);
    return status;
}
