/* Matrices of the Green function: against the pairwise call, panels against slow quadrature, closed
 * forms, the jump. */
#include "check.h"

#include <igabem/panel.h>
#include <igabem/solve.h>

#include <string.h>

static const double pi = 3.14159265358979323846;
enum { KELVIN = IGABEM_RANKINE | IGABEM_IMAGE | IGABEM_LOCAL | IGABEM_WAVE };

/* A tilted quadrilateral and a triangle, z <= -0.3; a vertical one that reaches up to z = -0.02. */
static const double corners[3][12] = {
    {0, 0, -0.8, 0.5, 0.1, -0.7, 0.55, 0.5, -0.3, 0.05, 0.4, -0.4},
    {0.2, 1, -0.5, 0.7, 1, -0.6, 0.3, 1.3, -0.5, 0.3, 1.3, -0.5},
    {0.2, 0.3, -0.32, -0.2, 0.3, -0.32, -0.2, 0.3, -0.02, 0.2, 0.3, -0.02}};
static const double points[5][3] = {
    {3, 0.3, -0.2}, {-2, 0.1, -0.3}, {0.3, 0.6, -0.5}, {-0.4, 0.2, -0.05}, {-8, 1, -0.6}};
static const double normals[5][3] = {
    {1, 0, 0}, {0, 1, 0}, {0.6, 0, 0.8}, {0, -0.6, 0.8}, {0, 0, 1}};

/* Every entry is the pairwise call's; any number of threads gives the same bits. */
static void all_pairs(void)
{
    enum { N = 5, M = 130 };
    const double k0 = 2.3;
    double sources[M][3], value[N][M], gradient[N][M][3], slope[N][M], again[N][M][3];
    for (int j = 0; j < M; j++) {
        sources[j][0] = 2 * sin(j);
        sources[j][1] = cos(2.0 * j);
        sources[j][2] = -0.05 - 0.01 * j;
    }
    igabem_matrix_options options;
    igabem_matrix_options_init(&options);
    const unsigned parts[] = {KELVIN, IGABEM_RANKINE | IGABEM_LID, IGABEM_WAVE};
    for (int p = 0; p < 3; p++) {
        options.parts = parts[p];
        options.threads = 1;
        CU_ASSERT_EQUAL(igabem_green_matrix(k0, N, points[0], normals[0], M, sources[0], &options,
                                            value[0], gradient[0][0], slope[0]),
                        IGABEM_OK);
        options.threads = 3;
        CU_ASSERT_EQUAL(igabem_green_matrix(k0, N, points[0], NULL, M, sources[0], &options, NULL,
                                            again[0][0], NULL),
                        IGABEM_OK);
        CU_ASSERT_EQUAL(memcmp(gradient, again, sizeof again), 0);
        for (int i = 0; i < N; i++)
            for (int j = 0; j < M; j++) {
                const double *P = points[i], *Q = sources[j], *n = normals[i];
                double g[4];
                CU_ASSERT_EQUAL(igabem_kelvin_green(k0, 1, P, P + 1, P + 2, Q, Q + 1, Q + 2,
                                                    parts[p], g, g + 1, g + 2, g + 3),
                                IGABEM_OK);
                double scale = fabs(g[1]) + fabs(g[2]) + fabs(g[3]);
                CHECK_CLOSE(value[i][j], g[0], 1e-13 * (fabs(g[0]) + scale));
                for (int k = 0; k < 3; k++)
                    CHECK_CLOSE(gradient[i][j][k], g[1 + k], 1e-12 * scale);
                CHECK_CLOSE(slope[i][j], n[0] * g[1] + n[1] * g[2] + n[2] * g[3], 1e-12 * scale);
            }
    }
}

/* -1/r + 1/r' and -1/r - 1/r' differ by twice the image, in the pairwise call too. */
static void sign_of_the_image(void)
{
    const double *P = points[1], Q[3] = {0.3, 0.2, -0.4};
    double image[4], lid[4], H[6], L[6];
    igabem_kelvin_green(1, 1, P, P + 1, P + 2, Q, Q + 1, Q + 2, IGABEM_IMAGE, image, image + 1,
                        image + 2, image + 3);
    igabem_kelvin_green(1, 1, P, P + 1, P + 2, Q, Q + 1, Q + 2, IGABEM_LID, lid, lid + 1, lid + 2,
                        lid + 3);
    igabem_kelvin_green_second(1, 1, P, P + 1, P + 2, Q, Q + 1, Q + 2, IGABEM_IMAGE, H, H + 1,
                               H + 2, H + 3, H + 4, H + 5);
    igabem_kelvin_green_second(1, 1, P, P + 1, P + 2, Q, Q + 1, Q + 2, IGABEM_LID, L, L + 1, L + 2,
                               L + 3, L + 4, L + 5);
    for (int k = 0; k < 4; k++)
        CHECK_CLOSE(image[k] + lid[k], 0, 0);
    for (int k = 0; k < 6; k++)
        CHECK_CLOSE(H[k] + L[k], 0, 0);
    double r = sqrt(2.3 * 2.3 + 0.1 * 0.1 + 0.7 * 0.7);
    CHECK_RELATIVE(lid[0], -1 / (4 * pi * r), 1e-14);
    CU_ASSERT_EQUAL(igabem_kelvin_green(1, 1, P, P + 1, P + 2, Q, Q + 1, Q + 2,
                                        IGABEM_IMAGE | IGABEM_LID, lid, NULL, NULL, NULL),
                    IGABEM_ERROR_ARGUMENT);
}

/* Midpoint rule on n x n cells of the bilinear map, the slow oracle: O(1/n^2), extrapolated. */
static void midpoints(double k0, const double *P, const double *panel, unsigned parts, int n,
                      double sum[4])
{
    memset(sum, 0, 4 * sizeof *sum);
    for (int a = 0; a < n; a++)
        for (int b = 0; b < n; b++) {
            double u = (a + 0.5) / n, v = (b + 0.5) / n, Q[3], du[3], dv[3], g[4];
            for (int k = 0; k < 3; k++) {
                const double *c = panel + k;
                Q[k] = (1 - u) * (1 - v) * c[0] + u * (1 - v) * c[3] + u * v * c[6] +
                       (1 - u) * v * c[9];
                du[k] = (1 - v) * (c[3] - c[0]) + v * (c[6] - c[9]);
                dv[k] = (1 - u) * (c[9] - c[0]) + u * (c[6] - c[3]);
            }
            double x = du[1] * dv[2] - du[2] * dv[1], y = du[2] * dv[0] - du[0] * dv[2],
                   z = du[0] * dv[1] - du[1] * dv[0];
            double dS = sqrt(x * x + y * y + z * z) / n / n;
            igabem_kelvin_green(k0, 1, P, P + 1, P + 2, Q, Q + 1, Q + 2, parts, g, g + 1, g + 2,
                                g + 3);
            for (int k = 0; k < 4; k++)
                sum[k] += dS * g[k];
        }
}

static void oracle(double k0, const double *P, const double *panel, unsigned parts, int n,
                   double sum[4])
{
    double coarse[4];
    midpoints(k0, P, panel, parts, n, coarse);
    midpoints(k0, P, panel, parts, 2 * n, sum);
    for (int k = 0; k < 4; k++)
        sum[k] += (sum[k] - coarse[k]) / 3;
}

static void against_quadrature(void)
{
    const double k0 = 3;
    /* The first corners of panel 0 are not in one plane: its frame's are. */
    double flat[3][12];
    memcpy(flat, corners, sizeof flat);
    flat[0][8] = -0.8 + 0.1 + 0.4; /* c2 = c1 + c3 - c0: a parallelogram is flat */
    flat[0][6] = 0.55;
    const unsigned parts[] = {IGABEM_RANKINE, IGABEM_LID, IGABEM_LOCAL | IGABEM_WAVE, KELVIN};
    igabem_matrix_options options;
    igabem_matrix_options_init(&options);
    for (int p = 0; p < 4; p++) {
        double expected[5][3][4];
        for (int i = 0; i < 5; i++)
            for (int j = 0; j < 3; j++)
                oracle(k0, points[i], flat[j], parts[p], 20, expected[i][j]);
        for (int loose = 0; loose < 2; loose++) {
            double value[5][3], gradient[5][3][3], slope[5][3];
            options.parts = parts[p];
            options.tolerance = loose ? 1e-3 : 1e-5;
            CU_ASSERT_EQUAL(igabem_panel_matrix(k0, 5, points[0], normals[0], 3, flat[0], &options,
                                                value[0], gradient[0][0], slope[0]),
                            IGABEM_OK);
            double error = loose && p >= 2 ? 3e-4 : 2e-4;
            for (int i = 0; i < 5; i++)
                for (int j = 0; j < 3; j++) {
                    const double *e = expected[i][j], *n = normals[i], *g = gradient[i][j];
                    double scale = fabs(e[1]) + fabs(e[2]) + fabs(e[3]);
                    CHECK_CLOSE(value[i][j], e[0], error * (fabs(e[0]) + scale));
                    for (int k = 0; k < 3; k++)
                        CHECK_CLOSE(g[k], e[1 + k], error * scale);
                    CHECK_CLOSE(slope[i][j], n[0] * g[0] + n[1] * g[1] + n[2] * g[2], 1e-14);
                }
        }
    }
}

/* The potential in the middle of a square of side a is 4 a ln(1 + sqrt 2)/(-4 pi). */
static void on_the_panel(void)
{
    const double square[12] = {0, 0, -2, 1, 0, -2, 1, 1, -2, 0, 1, -2};
    const double centre[3] = {0.5, 0.5, -2}, up[3] = {0, 0, 1}, beside[3] = {0.3, 0.2, -2};
    double value, gradient[3], slope;
    igabem_matrix_options options;
    igabem_matrix_options_init(&options);
    options.parts = IGABEM_RANKINE;
    CU_ASSERT_EQUAL(
        igabem_panel_matrix(1, 1, centre, up, 1, square, &options, &value, gradient, &slope),
        IGABEM_OK);
    CHECK_RELATIVE(value, -log(1 + sqrt(2)) / pi, 1e-14);
    for (int k = 0; k < 3; k++)
        CHECK_CLOSE(gradient[k], 0, 1e-15);
    CHECK_CLOSE(slope, 0, 1e-15);
    double inside[3];
    igabem_panel_matrix(1, 1, beside, NULL, 1, square, &options, NULL, inside, NULL);
    CU_ASSERT(fabs(inside[0]) > 0.01);
    for (int side = -1; side <= 1; side += 2) {
        double near[3] = {0.3, 0.2, -2 + side * 1e-7}, limit[3];
        igabem_panel_matrix(1, 1, near, NULL, 1, square, &options, NULL, limit, NULL);
        CHECK_CLOSE(limit[0], inside[0], 1e-6);
        CHECK_CLOSE(limit[1], inside[1], 1e-6);
        CHECK_CLOSE(limit[2], 0.5 * side, 1e-6);
    }
}

/* Six squares of density 1 enclose a cube: the flux of the gradient through a face of a larger cube
 * around it is a sixth of theirs. Here by the solid angle: dG/dn of a face seen from inside. */
static void solid_angles(void)
{
    const double low = -3, high = -2;
    const double cube[6][12] = {{0, 0, low, 0, 1, low, 1, 1, low, 1, 0, low},
                                {0, 0, high, 1, 0, high, 1, 1, high, 0, 1, high},
                                {0, 0, low, 1, 0, low, 1, 0, high, 0, 0, high},
                                {0, 1, low, 0, 1, high, 1, 1, high, 1, 1, low},
                                {0, 0, low, 0, 0, high, 0, 1, high, 0, 1, low},
                                {1, 0, low, 1, 1, low, 1, 1, high, 1, 0, high}};
    double normal[6][3], area[6], centroid[6][3], gradient[6][3];
    CU_ASSERT_EQUAL(igabem_panel_frames(6, cube[0], centroid[0], normal[0], area), IGABEM_OK);
    igabem_matrix_options options;
    igabem_matrix_options_init(&options);
    options.parts = IGABEM_RANKINE;
    const double inside[2][3] = {{0.3, 0.4, -2.2}, {0.9, 0.1, -2.95}};
    for (int p = 0; p < 2; p++) {
        igabem_panel_matrix(1, 1, inside[p], NULL, 6, cube[0], &options, NULL, gradient[0], NULL);
        double sum = 0; /* of -Omega/(4 pi) along outward normals: the whole sphere */
        for (int j = 0; j < 6; j++) {
            double middle[3] = {0.5, 0.5, -2.5}, out = 0;
            for (int k = 0; k < 3; k++) {
                out += (centroid[j][k] - middle[k]) * normal[j][k];
                sum += gradient[j][k] * normal[j][k];
            }
            CHECK_CLOSE(out, 0.5, 1e-15);
            CHECK_CLOSE(area[j], 1, 1e-15);
        }
        CHECK_CLOSE(sum, -1, 1e-14);
    }
}

static void frames(void)
{
    /* A triangle is the same wherever its corner is repeated; a dart has its area. */
    const double shapes[4][12] = {{0, 0, -1, 1, 0, -1, 0, 2, -1, 0, 2, -1},
                                  {0, 0, -1, 0, 0, -1, 1, 0, -1, 0, 2, -1},
                                  {0, 0, -1, 2, 0, -1, 0.5, 0.5, -1, 0, 2, -1},
                                  {0, 0, -1.01, 1, 0, -0.99, 1, 1, -1.01, 0, 1, -0.99}};
    double centroid[4][3], normal[4][3], area[4];
    CU_ASSERT_EQUAL(igabem_panel_frames(4, shapes[0], centroid[0], normal[0], area), IGABEM_OK);
    for (int j = 0; j < 2; j++) {
        CHECK_CLOSE(area[j], 1, 1e-15);
        CHECK_CLOSE(centroid[j][0], 1.0 / 3, 1e-15);
        CHECK_CLOSE(centroid[j][1], 2.0 / 3, 1e-15);
    }
    CHECK_CLOSE(area[2], 1, 1e-15);
    CHECK_CLOSE(centroid[2][0], 0.5, 1e-15);
    CHECK_CLOSE(area[3], 1, 1e-15); /* flattened: the square of its plan */
    for (int j = 0; j < 4; j++)
        CHECK_CLOSE(normal[j][2], 1, 1e-15);
}

static void refusals(void)
{
    double value, P[3] = {0.5, 0, -2};
    const double square[12] = {0, 0, -2, 1, 0, -2, 1, 1, -2, 0, 1, -2};
    double wrong[5][12];
    for (int w = 0; w < 5; w++)
        memcpy(wrong[w], square, sizeof square);
    wrong[0][2] = 0.1;                                /* above the water */
    memcpy(wrong[1] + 3, square, 3 * sizeof(double)); /* two corners are left */
    memcpy(wrong[1] + 6, square, 3 * sizeof(double));
    wrong[2][5] = -1;                /* warped */
    wrong[3][3] = wrong[3][4] = 1.5; /* crosses itself */
    wrong[3][6] = 1, wrong[3][7] = 0;
    wrong[4][0] = NAN;
    CU_ASSERT_EQUAL(igabem_panel_matrix(1, 1, P, NULL, 1, square, NULL, &value, NULL, NULL),
                    IGABEM_ERROR_ARGUMENT); /* on an edge */
    P[2] = -1;
    for (int w = 0; w < 5; w++)
        CU_ASSERT_EQUAL(igabem_panel_matrix(1, 1, P, NULL, 1, wrong[w], NULL, &value, NULL, NULL),
                        IGABEM_ERROR_ARGUMENT);
    igabem_matrix_options options;
    for (int w = 0; w < 6; w++) {
        igabem_matrix_options_init(&options);
        if (w == 0)
            options.parts = 32;
        if (w == 1)
            options.parts = IGABEM_LID | IGABEM_IMAGE;
        if (w == 2)
            options.threads = -1;
        if (w == 3)
            options.tolerance = 0;
        if (w == 4)
            options.filter.cut_off = -1;
        CU_ASSERT_EQUAL(igabem_panel_matrix(w == 5 ? -1 : 1, 1, P, NULL, 1, square, &options,
                                            &value, NULL, NULL),
                        IGABEM_ERROR_ARGUMENT);
    }
    CU_ASSERT_EQUAL(igabem_panel_matrix(1, 1, P, NULL, 1, square, NULL, NULL, NULL, &value),
                    IGABEM_ERROR_ARGUMENT); /* no normals */
    CU_ASSERT_EQUAL(igabem_green_matrix(1, 1, NULL, NULL, 1, P, NULL, &value, NULL, NULL),
                    IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_green_matrix(1, 1, P, NULL, 1, P, NULL, &value, NULL, NULL),
                    IGABEM_ERROR_ARGUMENT); /* coincide */
    CU_ASSERT(strstr(igabem_last_error(), "coincide") != NULL);
    /* Waves without end on the track behind a panel at the surface. */
    const double surface[12] = {0, -0.1, 0, 0, 0.1, 0, -0.2, 0.1, 0, -0.2, -0.1, 0};
    const double behind[3] = {-3, 0.01, 0};
    CU_ASSERT_EQUAL(igabem_panel_matrix(4, 1, behind, NULL, 1, surface, NULL, &value, NULL, NULL),
                    IGABEM_ERROR_NUMERIC);
    igabem_matrix_options_init(&options);
    options.filter.cut_off = 5;
    CU_ASSERT_EQUAL(
        igabem_panel_matrix(4, 1, behind, NULL, 1, surface, &options, &value, NULL, NULL),
        IGABEM_OK);
    CU_ASSERT(isfinite(value));
    CU_ASSERT_EQUAL(igabem_panel_matrix(1, 0, NULL, NULL, 0, NULL, NULL, NULL, NULL, NULL),
                    IGABEM_OK);
}

static const struct check_case cases[] = {
    {"all pairs are those of the pairwise call", all_pairs},
    {"the image has either sign", sign_of_the_image},
    {"panels are what slow quadrature gives", against_quadrature},
    {"self terms and the jump", on_the_panel},
    {"solid angles of a closed body add up", solid_angles},
    {"frames of panels", frames},
    {"what is refused, and why", refusals},
};

CHECK_MAIN("igabem_panel", cases)
