/* Influence rows against plain integration of the Green function itself. */
#include "check.h"
#include "hulls.h"
#include "influence/influence.h"

#include <string.h>

static const double pi = 3.14159265358979323846;

struct problem {
    igabem_hull *hull;
    struct density *density;
    struct mesh *mesh;
    struct influence *influence;
    double *sigma; /* a smooth density's coefficients */
};

static void open_problem(struct problem *p, igabem_hull *hull, int nu, int nv, double tolerance)
{
    const struct density_rule rule = {.degree = 3, .refine = {1, 1}, .elements = {nu, nv}};
    *p = (struct problem){.hull = hull};
    CU_ASSERT_EQUAL_FATAL(density_create(hull, &rule, &p->density), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(mesh_create(p->density, &p->mesh), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(influence_create(p->density, p->mesh, tolerance, 2, &p->influence),
                          IGABEM_OK);
    p->sigma = malloc(p->density->n * sizeof *p->sigma);
    CU_ASSERT_PTR_NOT_NULL_FATAL(p->sigma);
    for (size_t i = 0; i < p->density->n; i++)
        p->sigma[i] =
            1.0 + 0.5 * cos(3.0 * p->density->point[3 * i]) + 4.0 * p->density->point[3 * i + 2];
}

static void close_problem(struct problem *p)
{
    influence_free(p->influence);
    mesh_free(p->mesh);
    density_free(p->density);
    igabem_hull_free(p->hull);
    free(p->sigma);
}

static void apply(const struct problem *p, const double *rows, size_t point, double v[3])
{
    size_t n = p->density->n;
    for (size_t c = 0; c < 3; c++) {
        v[c] = 0.0;
        for (size_t k = 0; k < n; k++)
            v[c] += rows[(3 * point + c) * n + k] * p->sigma[k];
    }
}

/* Which term of the Green function. */
struct term {
    int wave;
    double k0, cutoff;
};

/* Adds the velocity at x due to the nodes and their images in y. */
static void add_nodes(const struct problem *p, const struct nodes *nodes, const double x[3],
                      const struct term *term, double v[3])
{
    size_t n = nodes->n, unknowns = p->density->n;
    double *a = malloc(9 * n * sizeof *a), *row = calloc(3 * unknowns, sizeof *row);
    CU_ASSERT_FATAL(a && row);
    double *X = a, *Y = a + n, *Z = a + 2 * n, *k = a + 3 * n, *sum = a + 6 * n;
    memset(sum, 0, 3 * n * sizeof *sum);
    struct igabem_kelvin_filter filter;
    igabem_kelvin_filter_init(&filter);
    if (!isinf(term->cutoff))
        filter.cut_off = term->cutoff;
    for (int side = 1; side >= -1; side -= 2) {
        for (size_t i = 0; i < n; i++) {
            X[i] = term->k0 * (x[0] - nodes->x[i]);
            Y[i] = term->k0 * (x[1] - side * nodes->y[i]);
            Z[i] = term->k0 * (x[2] + nodes->z[i]);
        }
        igabem_status status =
            term->wave ? igabem_kelvin_wave_filtered(n, X, Y, Z, &filter, NULL, k, k + n, k + 2 * n)
                       : igabem_kelvin_local(n, X, Y, Z, NULL, k, k + n, k + 2 * n);
        CU_ASSERT_EQUAL(status, IGABEM_OK);
        for (size_t i = 0; i < 3 * n; i++)
            sum[i] += term->k0 * term->k0 / (4.0 * pi) * k[i];
    }
    nodes_scatter(nodes, 3, sum, n, row, unknowns);
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < unknowns; i++)
            v[c] += row[c * unknowns + i] * p->sigma[i];
    free(a);
    free(row);
}

/* Velocity at a point by many Gauss points on every element, divided at x = x_P only. */
static void plain_surface(const struct problem *p, const double x[3], int parts,
                          const struct term *term, double v[3])
{
    struct nodes nodes;
    nodes_init(&nodes, p->mesh);
    for (size_t e = 0; e < p->mesh->n; e++) {
        struct domain pieces[DOMAIN_PIECES];
        size_t n = domain_cut(&p->mesh->element[e], x[0], pieces);
        for (size_t k = 0; k < n; k++)
            for (int i = 0; i < parts * parts && (pieces[k].ahead || !term->wave); i++) {
                double a = (double)(i / parts) / parts, b = (double)(i % parts) / parts;
                const double rect[4] = {a, a + 1.0 / parts, b, b + 1.0 / parts};
                const int points[2] = {10, 10};
                cell_nodes(&pieces[k], rect, points, &p->influence->gauss, &nodes);
            }
    }
    v[0] = v[1] = v[2] = 0.0;
    add_nodes(p, &nodes, x, term, v);
    nodes_free(&nodes);
}

static void plain_line(const struct problem *p, const struct line *line, const double x[3],
                       int parts, const struct term *term, double v[3])
{
    struct nodes nodes;
    nodes_init(&nodes, p->mesh);
    for (size_t s = 0; s < line->n; s++) {
        double stops[ELEMENT_SIDE + 2];
        size_t n = line_cut(&line->segment[s], x[0], stops);
        for (size_t k = 0; k + 1 < n; k++) {
            struct line_point middle;
            line_evaluate(line, &line->segment[s], 0.5 * (stops[k] + stops[k + 1]), &middle);
            for (int i = 0; i < parts && (middle.x > x[0] || !term->wave); i++) {
                double width = (stops[k + 1] - stops[k]) / parts;
                const double range[2] = {stops[k] + i * width, stops[k] + (i + 1) * width};
                line_nodes(line, &line->segment[s], range, 12, &p->influence->gauss, &nodes);
            }
        }
    }
    for (size_t i = 0; i < nodes.n; i++)
        nodes.g[i] /= term->k0;
    add_nodes(p, &nodes, x, term, v);
    nodes_free(&nodes);
}

static void test_submerged(void)
{
    struct problem p;
    const double k0 = 8.0, cutoff = INFINITY;
    open_problem(&p, ellipsoid_hull(1.0, 1.0 / 6.0, 1.0 / 6.0, 0.16, 1, 1), 5, 3, 1e-8);
    size_t n = p.density->n;
    double *local = calloc(3 * n * n, sizeof *local), *wave = calloc(3 * n * n, sizeof *wave);
    CU_ASSERT_FATAL(local && wave);
    CU_ASSERT_EQUAL(influence_local(p.influence, k0, NULL, local), IGABEM_OK);
    CU_ASSERT_EQUAL(influence_wave(p.influence, NULL, k0, 1, &cutoff, NULL, wave, NULL), IGABEM_OK);
    const struct term terms[2] = {{0, k0, cutoff}, {1, k0, cutoff}};
    for (size_t i = 0; i < n; i += 5)
        for (int t = 0; t < 2; t++) {
            double expected[3], actual[3];
            plain_surface(&p, p.density->point + 3 * i, 2, &terms[t], expected);
            apply(&p, t ? wave : local, i, actual);
            for (int c = 0; c < 3; c++) /* local: the sum of a few dozen panels at 1e-8 each */
                CHECK_CLOSE(actual[c], expected[c], t ? 2e-8 : 3e-7);
        }
    free(local);
    free(wave);
    close_problem(&p);
}

/* Hull and waterline with the short-wave filter; the line's local part at points that keep a
 * distance from it. */
static void test_waterline(void)
{
    struct problem p;
    const double k0 = 11.0, cutoff = 5.0;
    open_problem(&p, wigley_hull(0.1, 0.0625, 1, 1), 5, 2, 1e-8);
    size_t n = p.density->n, size = 3 * n * n;
    double *local = calloc(size, sizeof *local), *wave = calloc(size, sizeof *wave);
    CU_ASSERT_FATAL(local && wave);
    struct line *line = NULL;
    CU_ASSERT_EQUAL_FATAL(line_create(p.density, p.mesh, 0.4, &line), IGABEM_OK);
    CU_ASSERT_EQUAL(influence_local_line(p.influence, line, k0, NULL, local), IGABEM_OK);
    CU_ASSERT_EQUAL(influence_wave(p.influence, line, k0, 1, &cutoff, NULL, wave, NULL), IGABEM_OK);
    const struct term terms[2] = {{0, k0, cutoff}, {1, k0, cutoff}};
    for (size_t i = 0; i < n; i += 3) {
        const double *x = p.density->point + 3 * i;
        double expected[3] = {0}, actual[3];
        plain_surface(&p, x, 2, &terms[1], expected);
        plain_line(&p, line, x, 4, &terms[1], expected);
        apply(&p, wave, i, actual);
        for (int c = 0; c < 3; c++)
            CHECK_CLOSE(actual[c], expected[c], 1e-6);
        if (x[2] > -0.02)
            continue;
        double expected_line[3] = {0};
        plain_line(&p, line, x, 40, &terms[0], expected_line);
        apply(&p, local, i, actual);
        for (int c = 0; c < 3; c++)
            CHECK_CLOSE(actual[c], expected_line[c], 2e-8);
    }
    free(local);
    free(wave);
    line_free(line);
    close_problem(&p);
}

/* The operator of further filters, by marching and expanded, against rows of each filter alone. */
static void test_filter_change(void)
{
    struct problem p;
    const double k0 = 11.0, cutoff[3] = {5.0, 4.25, 5.75};
    open_problem(&p, wigley_hull(0.1, 0.0625, 1, 1), 9, 3, 1e-8);
    size_t n = p.density->n, size = 3 * n * n;
    double *rows = calloc(2 * size, sizeof *rows), *first = rows + size;
    double *matrix = malloc(n * n * sizeof *matrix);
    double *weight = malloc(2 * n * sizeof *weight), *marched = weight + n;
    CU_ASSERT_FATAL(rows && matrix && weight);
    for (size_t i = 0; i < n; i++)
        weight[i] = i % 7 == 0 ? 0.0 : i % 2 ? 1.0 : 0.4;
    struct line *line = NULL;
    struct filter_change *change = NULL;
    CU_ASSERT_EQUAL_FATAL(line_create(p.density, p.mesh, 0.4, &line), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(influence_wave(p.influence, line, k0, 3, cutoff, weight, first, &change),
                          IGABEM_OK);
    CU_ASSERT(filter_change_memory(change) > 0);
    for (size_t f = 0; f < 2; f++) {
        double largest = 0.0;
        memset(rows, 0, size * sizeof *rows);
        CU_ASSERT_EQUAL(
            influence_wave(p.influence, line, k0, 1, &cutoff[f + 1], weight, rows, NULL),
            IGABEM_OK);
        filter_change_expand(change, f, matrix);
        memset(marched, 0, n * sizeof *marched);
        filter_change_add(change, f, p.sigma, marched);
        for (size_t i = 0; i < n; i++) {
            const double *normal = p.density->normal + 3 * i;
            double a[3], b[3], expected = 0.0, expanded = 0.0;
            apply(&p, first, i, a);
            apply(&p, rows, i, b);
            for (int c = 0; c < 3; c++)
                expected += normal[c] * (b[c] - a[c]);
            for (size_t k = 0; k < n; k++)
                expanded += matrix[n * i + k] * p.sigma[k];
            CHECK_CLOSE(marched[i], expected, 1e-6);
            CHECK_CLOSE(expanded, marched[i], 1e-13);
            CU_ASSERT(weight[i] != 0.0 || marched[i] == 0.0);
            largest = fmax(largest, fabs(expected));
        }
        CU_ASSERT(largest > 1e-3);
    }
    filter_change_free(change);
    line_free(line);
    free(rows);
    free(matrix);
    free(weight);
    close_problem(&p);
}

/* Rows that are not asked for stay as they were. */
static void test_row_selection(void)
{
    struct problem p;
    const double k0 = 8.0, cutoff = INFINITY;
    open_problem(&p, ellipsoid_hull(1.0, 0.2, 0.2, 0.16, 1, 1), 2, 2, 1e-4);
    size_t n = p.density->n;
    double *rows = calloc(3 * n * n, sizeof *rows);
    double *wanted = calloc(n, sizeof *wanted);
    CU_ASSERT_FATAL(rows && wanted);
    wanted[3] = 1.0;
    CU_ASSERT_EQUAL(influence_local(p.influence, k0, wanted, rows), IGABEM_OK);
    CU_ASSERT_EQUAL(influence_wave(p.influence, NULL, k0, 1, &cutoff, wanted, rows, NULL),
                    IGABEM_OK);
    for (size_t i = 0; i < n; i++) {
        double sum = 0.0;
        for (size_t k = 0; k < 3 * n; k++)
            sum += fabs(rows[3 * n * i + k]);
        CU_ASSERT((sum > 0) == (i == 3));
    }
    free(rows);
    free(wanted);
    close_problem(&p);
}

static const struct check_case cases[] = {
    {"submerged body: local and wave part", test_submerged},
    {"waterline: filtered waves and line term", test_waterline},
    {"change by further filters", test_filter_change},
    {"row selection", test_row_selection},
};

CHECK_MAIN("influence", cases)
