/* A child of fork() solves although its parent had started threads, which it does not have. */
#include "check.h"

#include <igabem/panel.h>
#include <igabem/solve.h>
#include <nurbs/primitives.h>

#include <sys/wait.h>
#include <unistd.h>

/* A pressure integral of the double body and an entry of a matrix: loops of both kinds. */
static double figure(int threads)
{
    nurbs_surface *surface;
    igabem_hull *hull;
    igabem_solution *solution;
    igabem_options options;
    igabem_matrix_options matrix;
    igabem_forces forces;
    double slope[4] = {NAN, NAN, NAN, NAN};
    igabem_options_init(&options);
    options.kernel = IGABEM_KERNEL_DOUBLE_BODY;
    options.froude = 0.3;
    options.refine = 1;
    options.threads = threads;
    if (nurbs_make_ellipsoid(2, 0.5, 0.5, 1, &surface) != NURBS_OK)
        return NAN;
    const nurbs_surface *patch = surface;
    if (igabem_hull_create(&patch, 1, IGABEM_SYMMETRIC, &hull) != IGABEM_OK ||
        igabem_solve(hull, &options, &solution) != IGABEM_OK ||
        igabem_forces_compute(solution, &forces) != IGABEM_OK)
        return NAN;
    double velocity[3], uv[2] = {0.4, 0.5};
    if (igabem_surface_velocity(solution, 0, 1, uv, velocity, NULL) != IGABEM_OK)
        return NAN;
    const double points[] = {1, 0, -0.5, 2, 0.3, -0.4}, sources[] = {0, 0, -1, -1, 0.1, -0.6};
    igabem_matrix_options_init(&matrix);
    matrix.threads = threads;
    if (igabem_green_matrix(2, 2, points, NULL, 2, sources, &matrix, slope, NULL, NULL) !=
        IGABEM_OK)
        return NAN;
    igabem_solution_free(solution);
    igabem_hull_free(hull);
    nurbs_surface_free(surface);
    return velocity[0] + slope[0] + slope[3];
}

static void child_solves(void)
{
    double parent = figure(2);
    CU_ASSERT(isfinite(parent));
    int ends[2];
    CU_ASSERT_EQUAL_FATAL(pipe(ends), 0);
    pid_t child = fork();
    CU_ASSERT_NOT_EQUAL_FATAL(child, -1);
    if (child == 0) {
        alarm(100); /* it would wait for ever */
        double mine = figure(2);
        ssize_t written = write(ends[1], &mine, sizeof mine);
        _exit(written == sizeof mine ? 0 : 1);
    }
    close(ends[1]);
    int status;
    double got = NAN;
    CU_ASSERT_EQUAL(waitpid(child, &status, 0), child);
    CU_ASSERT(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    CU_ASSERT_EQUAL(read(ends[0], &got, sizeof got), (ssize_t)sizeof got);
    CHECK_RELATIVE(got, parent, 1e-10); /* one thread instead of two: equal to rounding */
    close(ends[0]);
}

static void numbers_refused(void)
{
    igabem_matrix_options options;
    igabem_matrix_options_init(&options);
    const double P[3] = {1, 0, -1}, Q[3] = {0, 0, -1};
    double value;
    for (int threads = -1; threads <= 1025; threads += 1026) {
        options.threads = threads;
        CU_ASSERT_EQUAL(igabem_green_matrix(1, 1, P, NULL, 1, Q, &options, &value, NULL, NULL),
                        IGABEM_ERROR_ARGUMENT);
    }
}

static const struct check_case cases[] = {
    {"a child of fork solves", child_solves},
    {"threads that are refused", numbers_refused},
};

CHECK_MAIN("igabem_fork", cases)
