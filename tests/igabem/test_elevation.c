/* Wave elevation against direct sums of the Green function over the solved density. */
#include "check.h"
#include "hulls.h"

#include <string.h>

static const double PI = 3.14159265358979323846;

enum { GAUSS = 8, MOST = 64 };

static igabem_solution *solve(const igabem_hull *hull, double froude, int line_term)
{
    igabem_options options;
    igabem_solution *solution = NULL;
    igabem_options_init(&options);
    options.refine = 1;
    options.froude = froude;
    options.line_term = line_term;
    igabem_status status = igabem_solve(hull, &options, &solution);
    if (status)
        fprintf(stderr, "%s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    return solution;
}

static size_t rule(const nurbs_surface *surface, int d, double *at, double *weight)
{
    double x[GAUSS], w[GAUSS], breaks[MOST];
    size_t n = 0;
    size_t count =
        nurbs_knots_distinct(nurbs_surface_degree(surface, d), nurbs_surface_size(surface, d),
                             nurbs_surface_knots(surface, d), breaks, NULL);
    CU_ASSERT_EQUAL_FATAL(nurbs_gauss_legendre(GAUSS, x, w), NURBS_OK);
    for (size_t s = 0; s + 1 < count; s++)
        for (int i = 0; i < GAUSS; i++) {
            at[n] = breaks[s] + (breaks[s + 1] - breaks[s]) * x[i];
            weight[n++] = (breaks[s + 1] - breaks[s]) * w[i];
        }
    return n;
}

/* k0^2/(4 pi) (N_X + W_X) of a source and its mirror image at (x, y, 0). */
static double slope(double k0, const double p[3], double x, double y,
                    const igabem_kelvin_filter *filter)
{
    double sum = 0.0, local, wave;
    for (int side = -1; side <= 1; side += 2) {
        double X = k0 * (x - p[0]), Y = k0 * (y - side * p[1]), Z = k0 * p[2];
        CU_ASSERT_EQUAL(igabem_kelvin_local(1, &X, &Y, &Z, NULL, &local, NULL, NULL), IGABEM_OK);
        CU_ASSERT_EQUAL(igabem_kelvin_wave_filtered(1, &X, &Y, &Z, filter, NULL, &wave, NULL, NULL),
                        IGABEM_OK);
        sum += k0 * k0 / (4 * PI) * (local + wave);
    }
    return sum;
}

/* Elevation by a plain sum over a Gauss rule of the surface and, with the line term of a wall-sided
 * waterline edge v = 0, of the waterline. */
static double direct(const igabem_solution *solution, const nurbs_surface *surface, double x,
                     double y, double nu_c, const igabem_kelvin_filter *filter)
{
    static double u[MOST * GAUSS], wu[MOST * GAUSS], v[MOST * GAUSS], wv[MOST * GAUSS];
    size_t nu = rule(surface, 0, u, wu), nv = rule(surface, 1, v, wv);
    igabem_forces forces;
    CU_ASSERT_EQUAL_FATAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    double sum = 0.0, k0 = forces.k0;
    for (size_t i = 0; i < nu; i++) {
        for (size_t j = 0; j < nv; j++) {
            double uv[2] = {u[i], v[j]}, s[9], sigma;
            CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 1, 1, uv, s), NURBS_OK);
            CU_ASSERT_EQUAL(igabem_source_density(solution, 0, 1, uv, &sigma), IGABEM_OK);
            double n[3] = {s[4] * s[8] - s[5] * s[7], s[5] * s[6] - s[3] * s[8],
                           s[3] * s[7] - s[4] * s[6]};
            double area = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            sum += wu[i] * wv[j] * area * sigma * slope(k0, s, x, y, filter);
        }
        if (nu_c > 0) {
            double uv[2] = {u[i], 0}, s[9], sigma;
            CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 1, 1, uv, s), NURBS_OK);
            CU_ASSERT_EQUAL(igabem_source_density(solution, 0, 1, uv, &sigma), IGABEM_OK);
            double dl = hypot(s[3], s[4]), nu_x = -s[4] / dl; /* wall sided: n_x = nu_x */
            double chi = 1 / (1 + pow(fabs(nu_x) / nu_c, 4));
            double p[3] = {s[0], s[1], 0};
            sum -= wu[i] * dl * chi * sigma * nu_x * nu_x / k0 * slope(k0, p, x, y, filter);
        }
    }
    return forces.speed / 9.80665 * sum;
}

static nurbs_surface *copy_of_ellipsoid(int parts_u, int parts_v, igabem_hull **hull)
{
    *hull = ellipsoid_hull(1.0, 0.2, 0.2, 0.2, parts_u, parts_v);
    return ellipsoid_surface(1.0, 0.2, 0.2, 0.2, parts_u, parts_v);
}

/* Ahead of, abreast of and behind a submerged body, where the plain sum is accurate. */
static void submerged_body(void)
{
    igabem_hull *hull;
    nurbs_surface *surface = copy_of_ellipsoid(2, 1, &hull);
    igabem_solution *solution = solve(hull, 0.5, 1);
    const double x[7] = {1.2, 0.5, 0.11, -0.23, -0.9, -2.0, -2.0};
    const double y[7] = {0.1, 0.4, 0.3, 0.5, 0.2, 0.0, 0.7};
    double zeta[7], scale = 0.0;
    CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 7, x, y, zeta), IGABEM_OK);
    for (int i = 0; i < 7; i++)
        scale = fmax(scale, fabs(zeta[i]));
    for (int i = 0; i < 7; i++)
        CHECK_CLOSE(zeta[i], direct(solution, surface, x[i], y[i], 0, NULL), 1e-4 * scale);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
    nurbs_surface_free(surface);
}

/* The filtered field of a hull with its line term, behind and well beside it. */
static void surface_piercing_hull(void)
{
    nurbs_surface *surface = wigley_surface(0.1, 0.0625, 12, 5);
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 12, 5);
    for (int line = 0; line < 2; line++) {
        igabem_solution *solution = solve(hull, 0.35, line);
        const igabem_options *used = igabem_solution_options(solution);
        igabem_kelvin_filter filter;
        igabem_kelvin_filter_init(&filter);
        filter.cut_off = used->cutoff_angle;
        const double x[6] = {0.7, 0.52, -0.8, -1.5, -1.5, -3.0};
        const double y[6] = {0.1, 0.3, 0.1, 0.0, 0.5, 0.9};
        double zeta[6], scale = 0.0;
        CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 6, x, y, zeta), IGABEM_OK);
        for (int i = 0; i < 6; i++)
            scale = fmax(scale, fabs(zeta[i]));
        for (int i = 0; i < 6; i++)
            CHECK_CLOSE(zeta[i],
                        direct(solution, surface, x[i], y[i], line ? used->stem_limit : 0, &filter),
                        2e-4 * scale);
        igabem_solution_free(solution);
    }
    igabem_hull_free(hull);
    nurbs_surface_free(surface);
}

/* Along a line beside the hull the field is smooth although N and W jump at every source: second
 * differences stay those of the waves. */
static void smooth_beside_the_hull(void)
{
    enum { N = 41 };
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 12, 4);
    igabem_solution *solution = solve(hull, 0.35, 1);
    double x[N], y[N], zeta[N], largest = 0.0, scale = 0.0;
    for (int i = 0; i < N; i++) {
        x[i] = 0.2 - 0.002 * i;
        y[i] = 0.12;
    }
    CU_ASSERT_EQUAL(igabem_wave_elevation(solution, N, x, y, zeta), IGABEM_OK);
    for (int i = 1; i + 1 < N; i++) {
        largest = fmax(largest, fabs(zeta[i - 1] - 2 * zeta[i] + zeta[i + 1]));
        scale = fmax(scale, fabs(zeta[i]));
    }
    /* The shortest kept wave has k L = k0 (1 + t_c^2) = 314: (k dx)^2 = 0.4; main waves 0.02. */
    CU_ASSERT(largest < 0.02 * scale);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

/* Inside the waterplane there is no water; the field is even in y. */
static void inside_and_symmetry(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 8, 3);
    igabem_solution *solution = solve(hull, 0.3, 1);
    const double x[5] = {0.0, 0.4, -0.49, -1.0, -1.0};
    const double y[5] = {0.049, 0.017, 0.0, 0.3, -0.3};
    const double outside_x[2] = {0.0, 0.4}, outside_y[2] = {0.0502, 0.0182};
    double zeta[5];
    CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 5, x, y, zeta), IGABEM_OK);
    for (int i = 0; i < 3; i++)
        CU_ASSERT(isnan(zeta[i]));
    CHECK_CLOSE(zeta[3], zeta[4], 1e-12);
    CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 2, outside_x, outside_y, zeta), IGABEM_OK);
    CU_ASSERT(isfinite(zeta[0]) && isfinite(zeta[1]));
    const double bad[1] = {NAN};
    CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 1, bad, y, zeta), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 1, x, NULL, zeta), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 0, NULL, NULL, NULL), IGABEM_OK);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

/* A deep slender body acts like its volume dipole: mu = (1 + k) V U, k the added-mass coefficient;
 * a sphere's is 1/2 and it makes zeta = (U/g) mu d^2/dx^2 of G. */
static void deep_sphere(void)
{
    const double radius = 0.1, depth = 1.0;
    igabem_hull *hull = ellipsoid_hull(2 * radius, 2 * radius, 2 * radius, depth, 2, 2);
    CU_ASSERT_EQUAL(igabem_hull_set_length(hull, 1.0), IGABEM_OK);
    igabem_solution *solution = solve(hull, 0.9, 1);
    igabem_forces forces;
    CU_ASSERT_EQUAL_FATAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    const double x[4] = {0.4, -0.5, -2.0, -4.0}, y[4] = {0.0, 0.3, 0.0, 1.0};
    double zeta[4], scale = 0.0, exact[4], zero = 0.0, source = -depth;
    double mu = 2 * PI * radius * radius * radius * forces.speed;
    CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 4, x, y, zeta), IGABEM_OK);
    for (int i = 0; i < 4; i++) {
        double gxx;
        CU_ASSERT_EQUAL(igabem_kelvin_green_second(forces.k0, 1, &x[i], &y[i], &zero, &zero, &zero,
                                                   &source, IGABEM_LOCAL | IGABEM_WAVE, &gxx, NULL,
                                                   NULL, NULL, NULL, NULL),
                        IGABEM_OK);
        exact[i] = -forces.speed / 9.80665 * mu * gxx; /* dipole: -mu dG/dx */
        scale = fmax(scale, fabs(exact[i]));
    }
    for (int i = 0; i < 4; i++)
        CHECK_CLOSE(zeta[i], exact[i], 0.01 * scale);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

static const struct check_case cases[] = {
    {"submerged body against direct sums", submerged_body},
    {"filtered field and line term against direct sums", surface_piercing_hull},
    {"smooth beside the hull", smooth_beside_the_hull},
    {"inside the waterplane, symmetry, arguments", inside_and_symmetry},
    {"deep sphere is a dipole", deep_sphere},
};

CHECK_MAIN("elevation", cases)
