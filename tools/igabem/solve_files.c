/* Files of a solution: the hull with what is known on it, the wave field, the spectrum. */
#include "cli.h"
#include "constants.h"
#include "plot/plot.h"
#include "solve.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cells a knot span of a .vtu; least cells of a picture along and across a patch. */
enum { SPAN_CELLS = 4, PICTURE_ALONG = 160, PICTURE_ACROSS = 40 };

static int finish(struct cli_file *file, const char *path)
{
    if (!cli_file_commit(file))
        return cli_fail("%s: cannot be written: %s", path, strerror(errno));
    return CLI_OK;
}

static const char *file_note(void)
{
    return "igabem " TOOL_VERSION;
}

static void sample_free(struct patch_sample *sample)
{
    free(sample->uv);
    free(sample->xyz);
    free(sample->velocity);
    free(sample->cp);
    free(sample->sigma);
}

static size_t span_count(const nurbs_surface *surface, int d)
{
    size_t size = nurbs_surface_size(surface, d), spans = 0;
    const double *knots = nurbs_surface_knots(surface, d);
    for (size_t s = (size_t)nurbs_surface_degree(surface, d); s < size; s++)
        spans += knots[s + 1] > knots[s];
    return spans;
}

/* i-th of the parameters that divide every knot span into `cells`. */
static double sample_parameter(const nurbs_surface *surface, int d, size_t cells, size_t i)
{
    size_t s = (size_t)nurbs_surface_degree(surface, d), left = i;
    const double *knots = nurbs_surface_knots(surface, d);
    size_t last = nurbs_surface_size(surface, d);
    for (; s < last; s++) {
        if (!(knots[s + 1] > knots[s]))
            continue;
        if (left < cells)
            return knots[s] + (knots[s + 1] - knots[s]) * (double)left / (double)cells;
        left -= cells;
    }
    return knots[last];
}

/* picture: cells small enough to be seen as a smooth field; else so many a span. */
static int sample_patch(const igabem_solution *solution, const nurbs_surface *surface, size_t patch,
                        bool picture, struct patch_sample *out)
{
    static const size_t least[2] = {PICTURE_ALONG, PICTURE_ACROSS};
    size_t cells[2], count[2];
    for (int d = 0; d < 2; d++) {
        size_t spans = span_count(surface, d);
        cells[d] = picture ? (least[d] + spans - 1) / spans : SPAN_CELLS;
        count[d] = spans * cells[d] + 1;
    }
    *out = (struct patch_sample){.nu = count[0], .nv = count[1]};
    size_t n = out->nu * out->nv;
    out->uv = malloc(n * 2 * sizeof(double));
    out->xyz = malloc(n * 3 * sizeof(double));
    out->velocity = calloc(n * 3, sizeof(double));
    out->cp = calloc(n, sizeof(double));
    out->sigma = calloc(n, sizeof(double)); /* 0 where a formulation has no sources */
    if (!out->uv || !out->xyz || !out->velocity || !out->cp || !out->sigma)
        return cli_fail("out of memory");
    for (size_t i = 0; i < out->nu; i++)
        for (size_t j = 0; j < out->nv; j++) {
            out->uv[2 * (i * out->nv + j)] = sample_parameter(surface, 0, cells[0], i);
            out->uv[2 * (i * out->nv + j) + 1] = sample_parameter(surface, 1, cells[1], j);
        }
    if (nurbs_surface_eval(surface, 0, n, out->uv, out->xyz))
        return cli_fail("%s", nurbs_last_error());
    const igabem_options *options = igabem_solution_options(solution);
    const igabem_formulation_row *row = igabem_formulation_info(options->formulation);
    bool density = options->kernel != IGABEM_KERNEL_KELVIN || !row->potential;
    if (density && igabem_source_density(solution, patch, n, out->uv, out->sigma))
        return cli_fail("%s", igabem_last_error());
    if (!row->solves)
        return CLI_OK; /* no velocity on the hull: zeros */
    if (igabem_surface_velocity(solution, patch, n, out->uv, out->velocity, out->cp))
        return cli_fail("%s", igabem_last_error());
    return CLI_OK;
}

static void write_field(FILE *f, const char *name, int components, const struct patch_sample *s,
                        size_t patches, const double *(*field)(const struct patch_sample *))
{
    fprintf(f,
            "<DataArray type=\"Float64\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"ascii\">\n",
            name, components);
    for (size_t p = 0; p < patches; p++) {
        const double *values = field(&s[p]);
        size_t n = s[p].nu * s[p].nv * (size_t)components;
        for (size_t i = 0; i < n; i++)
            fprintf(f, "%.9g%c", values[i], (i + 1) % (size_t)components ? ' ' : '\n');
    }
    fprintf(f, "</DataArray>\n");
}

static const double *field_xyz(const struct patch_sample *s)
{
    return s->xyz;
}
static const double *field_velocity(const struct patch_sample *s)
{
    return s->velocity;
}
static const double *field_cp(const struct patch_sample *s)
{
    return s->cp;
}
static const double *field_sigma(const struct patch_sample *s)
{
    return s->sigma;
}

static void write_cells(FILE *f, const size_t *quads, size_t cells)
{
    fprintf(f, "<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n");
    for (size_t c = 0; c < cells; c++)
        fprintf(f, "%zu %zu %zu %zu\n", quads[4 * c], quads[4 * c + 1], quads[4 * c + 2],
                quads[4 * c + 3]);
    fprintf(f, "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n");
    for (size_t c = 0; c < cells; c++)
        fprintf(f, "%zu\n", 4 * (c + 1));
    fprintf(f, "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n");
    for (size_t c = 0; c < cells; c++)
        fprintf(f, "9\n");
    fprintf(f, "</DataArray>\n</Cells>\n");
}

static void open_grid(FILE *f, size_t points, size_t cells)
{
    fprintf(f,
            "<?xml version=\"1.0\"?>\n<!-- %s; metres, metres per second -->\n"
            "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
            "<UnstructuredGrid>\n<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n",
            file_note(), points, cells);
}

static void close_grid(FILE *f)
{
    fprintf(f, "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

static int write_hull_grid(const struct patch_sample *samples, size_t patches, const char *path)
{
    size_t points = 0, cells = 0;
    for (size_t p = 0; p < patches; p++) {
        points += samples[p].nu * samples[p].nv;
        cells += (samples[p].nu - 1) * (samples[p].nv - 1);
    }
    size_t *quads = malloc((cells ? cells : 1) * 4 * sizeof *quads), c = 0, base = 0;
    struct cli_file file;
    if (!quads)
        return cli_fail("out of memory");
    if (!cli_file_open(&file, path)) {
        free(quads);
        return cli_fail("%s: cannot be written: %s", path, strerror(errno));
    }
    for (size_t p = 0; p < patches; p++) {
        for (size_t i = 0; i + 1 < samples[p].nu; i++)
            for (size_t j = 0; j + 1 < samples[p].nv; j++, c++) {
                size_t a = base + i * samples[p].nv + j;
                const size_t quad[4] = {a, a + samples[p].nv, a + samples[p].nv + 1, a + 1};
                memcpy(quads + 4 * c, quad, sizeof quad);
            }
        base += samples[p].nu * samples[p].nv;
    }
    open_grid(file.stream, points, cells);
    fprintf(file.stream, "<PointData>\n");
    write_field(file.stream, "velocity", 3, samples, patches, field_velocity);
    write_field(file.stream, "cp", 1, samples, patches, field_cp);
    write_field(file.stream, "source_density", 1, samples, patches, field_sigma);
    fprintf(file.stream, "</PointData>\n<Points>\n");
    write_field(file.stream, "points", 3, samples, patches, field_xyz);
    fprintf(file.stream, "</Points>\n");
    write_cells(file.stream, quads, cells);
    close_grid(file.stream);
    free(quads);
    return finish(&file, path);
}

/* The patches of the hull, handed to a writer of a file. */
static int write_samples(const igabem_solution *solution, const struct hull_input *input,
                         const struct solve_run *run, const char *path)
{
    size_t patches = nurbs_patches_count(input->patches);
    struct patch_sample *samples = calloc(patches, sizeof *samples);
    int code = samples ? CLI_OK : cli_fail("out of memory");
    for (size_t p = 0; code == CLI_OK && p < patches; p++)
        code = sample_patch(solution, nurbs_patches_get(input->patches, p), p, run, &samples[p]);
    if (code == CLI_OK && run)
        code = solve_draw_pressure(run, samples, patches, path) ? CLI_OK : CLI_FAILED;
    else if (code == CLI_OK)
        code = write_hull_grid(samples, patches, path);
    for (size_t p = 0; samples && p < patches; p++)
        sample_free(&samples[p]);
    free(samples);
    return code;
}

int solve_write_vtu(const igabem_solution *solution, const struct hull_input *input,
                    const char *path)
{
    return write_samples(solution, input, NULL, path);
}

int solve_write_pressure(const igabem_solution *solution, const struct solve_run *run,
                         const char *path)
{
    igabem_formulation formulation = igabem_solution_options(solution)->formulation;
    if (igabem_solution_options(solution)->kernel == IGABEM_KERNEL_KELVIN &&
        !igabem_formulation_info(formulation)->solves)
        return cli_fail("--pressure-plot %s: formulation %s knows no pressure on the hull", path,
                        igabem_formulation_name(formulation));
    return write_samples(solution, run->input, run, path);
}

static int wave_grid_make(const igabem_solution *solution, const struct solve_run *run,
                          bool picture, struct wave_grid *grid)
{
    const struct solve_request *request = run->request;
    const double *box = request->waves_box;
    double length = run->info.length, fore = run->info.hydrostatics.x_fore;
    size_t own[2];
    /* A formulation with a grid of its own has solved nothing beyond it. */
    bool solved = !picture && !igabem_free_surface_grid(solution, own, NULL, NULL);
    *grid = solved ? (struct wave_grid){.nx = own[0], .ny = own[1]}
                   : (struct wave_grid){.nx = request->waves_grid[0], .ny = request->waves_grid[1]};
    size_t n = grid->nx * grid->ny;
    grid->x = malloc(n * sizeof(double));
    grid->y = malloc(n * sizeof(double));
    grid->zeta = malloc(n * sizeof(double));
    if (!grid->x || !grid->y || !grid->zeta)
        return cli_fail("out of memory");
    if (solved)
        igabem_free_surface_grid(solution, own, grid->x, grid->y);
    for (size_t i = 0; i < grid->nx && !solved; i++)
        for (size_t j = 0; j < grid->ny; j++) {
            double a = (double)i / (double)(grid->nx - 1), b = (double)j / (double)(grid->ny - 1);
            grid->x[i * grid->ny + j] = fore + length * (box[0] + (box[1] - box[0]) * a);
            grid->y[i * grid->ny + j] = length * (box[2] + (box[3] - box[2]) * b);
        }
    if (igabem_wave_elevation(solution, n, grid->x, grid->y, grid->zeta))
        return cli_fail("%s", igabem_last_error());
    return CLI_OK;
}

static void write_wave_csv(FILE *f, const struct wave_grid *grid)
{
    fprintf(f, "# %s: wave elevation, m; empty inside the hull; %zu lines of x, %zu of y\n",
            file_note(), grid->nx, grid->ny);
    fprintf(f, "x,y,zeta\n");
    for (size_t i = 0; i < grid->nx * grid->ny; i++) {
        fprintf(f, "%.9g,%.9g,", grid->x[i], grid->y[i]);
        if (isfinite(grid->zeta[i]))
            fprintf(f, "%.9g", grid->zeta[i]);
        fputc('\n', f);
    }
}

static int write_wave_vtu(FILE *f, const struct wave_grid *grid)
{
    size_t n = grid->nx * grid->ny, cells = 0;
    size_t *quads = malloc((grid->nx - 1) * (grid->ny - 1) * 4 * sizeof *quads);
    if (!quads)
        return 0;
    for (size_t i = 0; i + 1 < grid->nx; i++)
        for (size_t j = 0; j + 1 < grid->ny; j++) {
            size_t a = i * grid->ny + j;
            const size_t quad[4] = {a, a + grid->ny, a + grid->ny + 1, a + 1};
            int wet = 1;
            for (int k = 0; k < 4; k++)
                wet &= isfinite(grid->zeta[quad[k]]) != 0;
            if (wet)
                memcpy(quads + 4 * cells++, quad, sizeof quad);
        }
    open_grid(f, n, cells);
    fprintf(f, "<PointData>\n<DataArray type=\"Float64\" Name=\"zeta\" format=\"ascii\">\n");
    for (size_t i = 0; i < n; i++)
        fprintf(f, "%.9g\n", isfinite(grid->zeta[i]) ? grid->zeta[i] : 0.0);
    fprintf(f, "</DataArray>\n</PointData>\n<Points>\n<DataArray type=\"Float64\" "
               "NumberOfComponents=\"3\" format=\"ascii\">\n");
    for (size_t i = 0; i < n; i++)
        fprintf(f, "%.9g %.9g %.9g\n", grid->x[i], grid->y[i],
                isfinite(grid->zeta[i]) ? grid->zeta[i] : 0.0);
    fprintf(f, "</DataArray>\n</Points>\n");
    write_cells(f, quads, cells);
    close_grid(f);
    free(quads);
    return 1;
}

static bool ends_with(const char *text, const char *end)
{
    size_t n = strlen(text), m = strlen(end);
    return n >= m && strcmp(text + n - m, end) == 0;
}

int solve_write_waves(const igabem_solution *solution, const struct solve_run *run,
                      const char *path)
{
    struct wave_grid grid;
    struct cli_file file;
    bool picture = plot_is_picture(path);
    if (!picture && !ends_with(path, ".csv") && !ends_with(path, ".vtu"))
        return cli_fail("--waves %s: expected a name that ends in .csv, .vtu, .svg, .png or .pdf",
                        path);
    int code = wave_grid_make(solution, run, picture, &grid);
    if (code == CLI_OK && picture)
        code = solve_draw_waves(run, &grid, path) ? CLI_OK : CLI_FAILED;
    else if (code == CLI_OK && !cli_file_open(&file, path))
        code = cli_fail("%s: cannot be written: %s", path, strerror(errno));
    else if (code == CLI_OK) {
        if (ends_with(path, ".csv")) {
            write_wave_csv(file.stream, &grid);
            code = finish(&file, path);
        } else if (write_wave_vtu(file.stream, &grid)) {
            code = finish(&file, path);
        } else {
            cli_file_abandon(&file);
            code = cli_fail("out of memory");
        }
    }
    free(grid.x);
    free(grid.y);
    free(grid.zeta);
    return code;
}

int solve_write_spectrum(const igabem_solution *solution, const char *path)
{
    enum { N = 1201 };
    double t[N], h[N][2], dcw[N];
    double top = asinh(igabem_solution_options(solution)->spectrum_limit);
    for (int i = 0; i < N; i++)
        t[i] = sinh(top * i / (N - 1.0));
    if (igabem_kochin(solution, N, t, h, dcw))
        return cli_fail("%s", igabem_last_error());
    struct cli_file file;
    if (!cli_file_open(&file, path))
        return cli_fail("%s: cannot be written: %s", path, strerror(errno));
    fprintf(file.stream,
            "# %s: Kochin function H, m^3/s, and d C_w/d t of one sign of t = tan(wave angle)\n"
            "t,degrees,h_re,h_im,dcw_dt\n",
            file_note());
    for (int i = 0; i < N; i++)
        fprintf(file.stream, "%.9g,%.7g,%.12g,%.12g,%.12g\n", t[i], atan(t[i]) * (180 / PI),
                h[i][0], h[i][1], dcw[i]);
    return finish(&file, path);
}
