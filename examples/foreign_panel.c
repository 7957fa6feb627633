/* A Neumann-Kelvin panel code of one's own on the kernel of libigabem (igabem/panel.h): flat panels
 * of constant source density on a submerged spheroid, its wave resistance from the far field, and
 * beside it what libigabem's own splines give. The equation: sigma/2 + Int sigma dG/dn = U n_x. */
#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846, gravity = 9.80665, density = 1000;
static const double length = 2, radius = 0.2, depth = 0.5, froude = 0.6;

static void must(igabem_status status)
{
    if (status == IGABEM_OK)
        return;
    fprintf(stderr, "foreign_panel: %s\n", igabem_last_error());
    exit(EXIT_FAILURE);
}

static void *room(size_t n)
{
    void *data = calloc(n, sizeof(double));
    if (!data)
        exit(EXIT_FAILURE);
    return data;
}

static void place(double theta, double psi, double *at)
{
    at[0] = 0.5 * length * cos(theta);
    at[1] = radius * sin(theta) * cos(psi);
    at[2] = radius * sin(theta) * sin(psi) - depth;
}

/* The side y > 0 in rows x columns panels, counterclockwise seen from the water; the quadrilaterals
 * at the ends have a side of no length. */
static void make_panels(size_t rows, size_t columns, double (*corners)[4][3])
{
    for (size_t r = 0; r < rows; r++)
        for (size_t c = 0; c < columns; c++) {
            double theta = pi * (double)r / (double)rows, step = pi / (double)rows;
            double psi = pi * (double)c / (double)columns - pi / 2, turn = pi / (double)columns;
            double(*corner)[3] = corners[r * columns + c];
            place(theta, psi, corner[0]);
            place(theta, psi + turn, corner[3]);
            place(theta + step, psi + turn, corner[2]);
            place(theta + step, psi, corner[1]);
        }
}

/* Gaussian elimination; a matrix with sigma/2 on its diagonal needs no pivots. */
static void eliminate(size_t n, double *a, double *b)
{
    for (size_t k = 0; k < n; k++)
        for (size_t i = k + 1; i < n; i++) {
            double factor = a[i * n + k] / a[k * n + k];
            for (size_t j = k; j < n; j++)
                a[i * n + j] -= factor * a[k * n + j];
            b[i] -= factor * b[k];
        }
    for (size_t k = n; k-- > 0;) {
        for (size_t j = k + 1; j < n; j++)
            b[k] -= a[k * n + j] * b[j];
        b[k] /= a[k * n + k];
    }
}

/* R = (rho k0^2/2 pi) Int |H|^2 sqrt(1+t^2) dt with t = sinh(s), H of both sides. */
static double resistance(double k0, size_t n, const double *centre, const double *area,
                         const double *sigma)
{
    enum { ANGLES = 401 };
    double *x = room(n), *y = room(n), *z = room(n), *strength = room(n), sum = 0, step = 0.02;
    double t[ANGLES], hr[ANGLES], hi[ANGLES], mr[ANGLES], mi[ANGLES];
    for (size_t j = 0; j < n; j++) {
        x[j] = centre[3 * j], y[j] = centre[3 * j + 1], z[j] = centre[3 * j + 2];
        strength[j] = sigma[j] * area[j];
    }
    for (int i = 0; i < ANGLES; i++)
        t[i] = sinh(step * (i - ANGLES / 2));
    must(igabem_kochin_points(k0, ANGLES, t, n, x, y, z, strength, hr, hi));
    for (size_t j = 0; j < n; j++)
        y[j] = -y[j];
    must(igabem_kochin_points(k0, ANGLES, t, n, x, y, z, strength, mr, mi));
    for (int i = 0; i < ANGLES; i++)
        sum += step * (1 + t[i] * t[i]) * (pow(hr[i] + mr[i], 2) + pow(hi[i] + mi[i], 2));
    free(x), free(y), free(z), free(strength);
    return density * k0 * k0 / (2 * pi) * sum;
}

/* C_w = R/(rho U^2 S/2) with rows x columns panels. */
static double panel_cw(size_t rows, size_t columns)
{
    size_t n = rows * columns;
    double speed = froude * sqrt(gravity * length), k0 = gravity / (speed * speed), wetted = 0;
    double(*corners)[4][3] = room(12 * n), *area = room(n), *sigma = room(n);
    double *centre = room(6 * n), *normal = room(6 * n), *slope = room(2 * n * n);
    make_panels(rows, columns, corners);
    must(igabem_panel_frames(n, corners[0][0], centre, normal, area));
    /* What the mirrored panels do to the points is what the panels do to the mirrored points. */
    for (size_t i = 0; i < 3 * n; i++) {
        centre[3 * n + i] = i % 3 == 1 ? -centre[i] : centre[i];
        normal[3 * n + i] = i % 3 == 1 ? -normal[i] : normal[i];
    }
    igabem_matrix_options options;
    igabem_matrix_options_init(&options);
    options.tolerance = 1e-3;
    must(igabem_panel_matrix(k0, 2 * n, centre, normal, n, corners[0][0], &options, NULL, NULL,
                             slope));
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++)
            slope[i * n + j] += slope[(n + i) * n + j];
        slope[i * n + i] += 0.5; /* the jump: the water is where the normals point */
        sigma[i] = speed * normal[3 * i];
        wetted += 2 * area[i];
    }
    /* What a panel emits leaves the body: its diagonal takes what flat panels miss of curvature. */
    for (size_t j = 0; j < n; j++) {
        double flux = 0;
        for (size_t i = 0; i < n; i++)
            flux += area[i] * slope[i * n + j];
        slope[j * n + j] += 1 - flux / area[j];
    }
    eliminate(n, slope, sigma);
    double r = resistance(k0, n, centre, area, sigma);
    free(corners), free(area), free(sigma), free(centre), free(normal), free(slope);
    return r / (0.5 * density * speed * speed * wetted);
}

static double spline_cw(void)
{
    nurbs_surface *surface;
    igabem_hull *hull;
    igabem_solution *flow;
    igabem_forces forces;
    igabem_options options;
    igabem_options_init(&options);
    options.froude = froude;
    if (nurbs_make_ellipsoid(length, 2 * radius, 2 * radius, depth, &surface) != NURBS_OK)
        exit(EXIT_FAILURE);
    const nurbs_surface *patch = surface;
    must(igabem_hull_create(&patch, 1, IGABEM_SYMMETRIC, &hull));
    igabem_options_refine(hull, 100, &options);
    must(igabem_solve(hull, &options, &flow));
    must(igabem_forces_compute(flow, &forces));
    igabem_solution_free(flow);
    igabem_hull_free(hull);
    nurbs_surface_free(surface);
    return forces.cw;
}

int main(void)
{
    double coarse = panel_cw(8, 6), fine = panel_cw(16, 12), ours = spline_cw();
    double limit = fine + (fine - coarse) / 3; /* the error falls as h^2 */
    printf("C_w by  48 panels a side  %.5e\n       192                %.5e\n", coarse, fine);
    printf("       Richardson         %.5e\n       libigabem          %.5e\n", limit, ours);
    return fabs(limit / ours - 1) < 0.01 ? EXIT_SUCCESS : EXIT_FAILURE;
}
