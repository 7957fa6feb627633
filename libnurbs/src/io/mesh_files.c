/* Files for looking at patches: triangles (STL), quads (VTU) and control points (CSV). */
#include "core/error.h"
#include "core/textfile.h"

#include <nurbs/io.h>

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PARTS = 1000, LEAST_PARTS = 4, MOST_TRIANGLES = 50000 };

/* Of the extent: how far chords may be from the surface where the parts are chosen by rule. */
static const double fine_enough = 2e-5;

/* Points of one patch on `parts` parts of every knot span. */
typedef struct mesh {
    size_t n[2];
    double *points;
} mesh;

static size_t divide_spans(const nurbs_surface *surface, int direction, int parts, double *t)
{
    const double *knots = nurbs_surface_knots(surface, direction);
    size_t size = nurbs_surface_size(surface, direction), count = 0;
    for (size_t k = (size_t)nurbs_surface_degree(surface, direction); k < size; k++)
        for (int s = 0; s < parts && knots[k + 1] > knots[k]; s++)
            t[count++] = knots[k] + (knots[k + 1] - knots[k]) * s / parts;
    t[count++] = knots[size];
    return count;
}

static nurbs_status mesh_create(const nurbs_surface *surface, int parts, mesh *grid)
{
    size_t room[2];
    for (int d = 0; d < 2; d++)
        room[d] = (size_t)parts * nurbs_surface_size(surface, d) + 1;
    double *u = malloc((room[0] + room[1]) * sizeof *u), *v = u + room[0];
    *grid = (mesh){{0, 0}, NULL};
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu parameters", room[0] + room[1]);
    grid->n[0] = divide_spans(surface, 0, parts, u);
    grid->n[1] = divide_spans(surface, 1, parts, v);
    grid->points = malloc(3 * grid->n[0] * grid->n[1] * sizeof(double));
    nurbs_status status =
        grid->points
            ? nurbs_surface_eval_grid(surface, 0, grid->n[0], u, grid->n[1], v, grid->points)
            : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu points", grid->n[0],
                         grid->n[1]);
    free(u);
    return status;
}

/* The largest distance of a chord from the curve over it, an eighth of the second difference of
 * three neighbours in a span. */
static double largest_sag(const mesh *grid, size_t parts)
{
    double sag = 0;
    for (int d = 0; d < 2; d++) {
        size_t step = 3 * (d ? 1 : grid->n[1]);
        for (size_t i = 0; i < grid->n[0] * grid->n[1]; i++) {
            size_t at = d ? i % grid->n[1] : i / grid->n[1];
            const double *p = grid->points + 3 * i;
            double square = 0;
            for (size_t c = 0; at % parts != 0 && c < 3; c++) {
                double second = (p - step)[c] - 2 * p[c] + (p + step)[c];
                square += second * second;
            }
            sag = fmax(sag, 0.125 * sqrt(square));
        }
    }
    return sag;
}

/* One number for all patches, so that neighbours with the same knots share their nodes: as many as
 * make chords fine enough, or as the number of triangles allows. */
static nurbs_status choose_parts(const nurbs_patches *patches, int *parts)
{
    double sag = 0, low[3] = {INFINITY, INFINITY, INFINITY},
           high[3] = {-INFINITY, -INFINITY, -INFINITY}, extent = 0, triangles = 0;
    for (size_t k = 0; k < nurbs_patches_count(patches); k++) {
        mesh grid;
        nurbs_status status = mesh_create(nurbs_patches_get(patches, k), LEAST_PARTS, &grid);
        if (status != NURBS_OK)
            return status;
        sag = fmax(sag, largest_sag(&grid, LEAST_PARTS));
        triangles += 2 * (double)((grid.n[0] - 1) * (grid.n[1] - 1));
        for (size_t i = 0; i < 3 * grid.n[0] * grid.n[1]; i++) {
            low[i % 3] = fmin(low[i % 3], grid.points[i]);
            high[i % 3] = fmax(high[i % 3], grid.points[i]);
        }
        free(grid.points);
    }
    for (int c = 0; c < 3; c++)
        extent = fmax(extent, high[c] - low[c]);
    double wanted = extent > 0 ? LEAST_PARTS * sqrt(sag / (fine_enough * extent)) : 1,
           allowed = LEAST_PARTS * sqrt(MOST_TRIANGLES / fmax(triangles, 1));
    *parts = (int)fmin(fmax(fmin(ceil(wanted), floor(allowed)), LEAST_PARTS), MAX_PARTS);
    return NURBS_OK;
}

static nurbs_status meshes_create(const nurbs_patches *patches, int parts, mesh **meshes)
{
    size_t count = nurbs_patches_count(patches);
    *meshes = NULL;
    if (parts < 0 || parts > MAX_PARTS)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%d parts a knot span, expected 0 to %d", parts,
                          MAX_PARTS);
    if (parts == 0) {
        nurbs_status status = choose_parts(patches, &parts);
        if (status != NURBS_OK)
            return status;
    }
    if (count == 0)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no patches to write");
    *meshes = calloc(count, sizeof **meshes);
    nurbs_status status =
        *meshes ? NURBS_OK : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", count);
    for (size_t k = 0; k < count && status == NURBS_OK; k++)
        status = mesh_create(nurbs_patches_get(patches, k), parts, &(*meshes)[k]);
    return status;
}

static void meshes_free(size_t count, mesh *meshes)
{
    for (size_t k = 0; meshes && k < count; k++)
        free(meshes[k].points);
    free(meshes);
}

static void put_float(FILE *stream, double value)
{
    float single = (float)value;
    uint32_t bits;
    memcpy(&bits, &single, sizeof bits);
    for (int k = 0; k < 4; k++)
        fputc((int)(bits >> (8 * k) & 0xff), stream);
}

static void put_triangle(FILE *stream, const double *a, const double *b, const double *c)
{
    double p[3], q[3], n[3], length;
    for (int k = 0; k < 3; k++) {
        p[k] = b[k] - a[k];
        q[k] = c[k] - a[k];
    }
    n[0] = p[1] * q[2] - p[2] * q[1];
    n[1] = p[2] * q[0] - p[0] * q[2];
    n[2] = p[0] * q[1] - p[1] * q[0];
    length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        put_float(stream, length > 0 ? n[k] / length : 0);
    for (int k = 0; k < 3; k++)
        put_float(stream, a[k]);
    for (int k = 0; k < 3; k++)
        put_float(stream, b[k]);
    for (int k = 0; k < 3; k++)
        put_float(stream, c[k]);
    fputc(0, stream);
    fputc(0, stream);
}

nurbs_status nurbs_patches_write_stl(const nurbs_patches *patches, int parts, const char *path)
{
    NURBS_NEED(patches && path);
    size_t count = nurbs_patches_count(patches), triangles = 0;
    mesh *meshes;
    outfile file;
    nurbs_status status = meshes_create(patches, parts, &meshes);
    if (status == NURBS_OK)
        status = outfile_open(&file, path);
    if (status != NURBS_OK) {
        meshes_free(count, meshes);
        return status;
    }
    for (size_t k = 0; k < count; k++)
        triangles += 2 * (meshes[k].n[0] - 1) * (meshes[k].n[1] - 1);
    char header[80] = "binary STL written by libnurbs, metres";
    fwrite(header, 1, sizeof header, file.stream);
    for (int k = 0; k < 4; k++)
        fputc((int)(triangles >> (8 * k) & 0xff), file.stream);
    for (size_t k = 0; k < count; k++)
        for (size_t i = 0; i + 1 < meshes[k].n[0]; i++)
            for (size_t j = 0; j + 1 < meshes[k].n[1]; j++) {
                const double *a = meshes[k].points + 3 * (i * meshes[k].n[1] + j),
                             *b = a + 3 * meshes[k].n[1];
                put_triangle(file.stream, a, b, b + 3);
                put_triangle(file.stream, a, b + 3, a + 3);
            }
    meshes_free(count, meshes);
    return outfile_commit(&file);
}

static void write_piece(FILE *stream, const mesh *grid)
{
    size_t nu = grid->n[0], nv = grid->n[1], cells = (nu - 1) * (nv - 1);
    fprintf(stream, "<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n", nu * nv, cells);
    fprintf(stream, "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
                    "format=\"ascii\">\n");
    for (size_t k = 0; k < nu * nv; k++)
        fprintf(stream, "%.17g %.17g %.17g\n", grid->points[3 * k], grid->points[3 * k + 1],
                grid->points[3 * k + 2]);
    fprintf(stream, "</DataArray></Points>\n<Cells>\n"
                    "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n");
    for (size_t i = 0; i + 1 < nu; i++)
        for (size_t j = 0; j + 1 < nv; j++)
            fprintf(stream, "%zu %zu %zu %zu\n", i * nv + j, (i + 1) * nv + j, (i + 1) * nv + j + 1,
                    i * nv + j + 1);
    fprintf(stream, "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n");
    for (size_t k = 1; k <= cells; k++)
        fprintf(stream, "%zu\n", 4 * k);
    fprintf(stream, "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n");
    for (size_t k = 0; k < cells; k++)
        fprintf(stream, "9\n");
    fprintf(stream, "</DataArray>\n</Cells>\n</Piece>\n");
}

nurbs_status nurbs_patches_write_vtu(const nurbs_patches *patches, int parts, const char *path)
{
    NURBS_NEED(patches && path);
    size_t count = nurbs_patches_count(patches);
    mesh *meshes;
    outfile file;
    nurbs_status status = meshes_create(patches, parts, &meshes);
    if (status == NURBS_OK)
        status = outfile_open(&file, path);
    if (status == NURBS_OK) {
        fprintf(file.stream, "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" "
                             "version=\"1.0\" byte_order=\"LittleEndian\" "
                             "header_type=\"UInt64\">\n<UnstructuredGrid>\n");
        for (size_t k = 0; k < count; k++)
            write_piece(file.stream, &meshes[k]);
        fprintf(file.stream, "</UnstructuredGrid>\n</VTKFile>\n");
        status = outfile_commit(&file);
    }
    meshes_free(count, meshes);
    return status;
}

nurbs_status nurbs_patches_write_points(const nurbs_patches *patches, const char *path)
{
    NURBS_NEED(patches && path);
    outfile file;
    nurbs_status status = outfile_open(&file, path);
    if (status != NURBS_OK)
        return status;
    fprintf(file.stream, "patch,i,j,x,y,z,weight\n");
    for (size_t k = 0; k < nurbs_patches_count(patches); k++) {
        const nurbs_surface *surface = nurbs_patches_get(patches, k);
        size_t nv = nurbs_surface_size(surface, 1), n = nurbs_surface_size(surface, 0) * nv;
        const double *p = nurbs_surface_points(surface), *w = nurbs_surface_weights(surface);
        for (size_t i = 0; i < n; i++)
            fprintf(file.stream, "%zu,%zu,%zu,%.17g,%.17g,%.17g,%.17g\n", k, i / nv, i % nv,
                    p[3 * i], p[3 * i + 1], p[3 * i + 2], w ? w[i] : 1);
    }
    return outfile_commit(&file);
}
