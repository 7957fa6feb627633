#include "solve/linear.h"

#include "core/error.h"
#include "core/vector_math.h"

#include <cblas.h>
#include <lapacke.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RESTART = 60, MOST = 300, ESTIMATES = 10 };
/* Unknowns that LU solves at once, in a fraction of a second, and columns of a panel beyond. */
enum { AT_ONCE = 512, PANEL = 256 };
static const double TOLERANCE = 1e-12;
/* For the condition estimate, which it can raise by a share of sqrt(n) times this at most. */
static const double ROUGH = 1e-3;
/* Half width of the band per square root of the unknowns: a few columns of a mesh. */
static const double BAND = 2.0;

static igabem_status check_size(size_t n)
{
    if (n <= INT_MAX)
        return IGABEM_OK;
    return igabem_fail(IGABEM_ERROR_ARGUMENT, "%zu unknowns are too many for LAPACK", n);
}

/* Of the rows, 1-norm; LAPACK's inf-norm, to which row-major storage is the transpose. Its driver
 * says 0 where it has no memory, so the room for its sums is ours. */
static igabem_status find_norm(const struct matrix *matrix, double *norm)
{
    lapack_int order = (lapack_int)matrix->n;
    double *sums = malloc(matrix->n * sizeof *sums);
    if (!sums)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory to solve");
    *norm = LAPACKE_dlange_work(LAPACK_COL_MAJOR, 'I', order, order, matrix->rows,
                                (lapack_int)matrix->stride, sums);
    free(sums);
    return isfinite(*norm)
               ? IGABEM_OK
               : igabem_fail(IGABEM_ERROR_NUMERIC, "the influence matrix is not finite");
}

/* LU by panels of columns, right-looking (Golub and Van Loan, Matrix Computations, 3.2.11), so that
 * a large one can be cancelled; of one panel it is LAPACK's own. */
static lapack_int factor(struct progress *progress, lapack_int order, double *a, lapack_int stride,
                         lapack_int *pivots)
{
    lapack_int width = order > AT_ONCE ? PANEL : order, info = 0;
    progress_stage(progress, progress ? progress->to : 0.0, (size_t)(order / width) + 1);
    for (lapack_int j = 0; j < order && info == 0; j += width) {
        lapack_int w = order - j < width ? order - j : width, right = order - j - w;
        double *panel = a + (size_t)j * (size_t)stride, *rest = panel + (size_t)w * (size_t)stride;
        info = LAPACKE_dgetrf(LAPACK_COL_MAJOR, order - j, w, panel + j, stride, pivots + j);
        for (lapack_int k = j; k < j + w; k++)
            pivots[k] += j;
        if (info == 0 && j > 0)
            info = LAPACKE_dlaswp(LAPACK_COL_MAJOR, j, a, stride, j + 1, j + w, pivots, 1);
        if (info == 0 && right > 0)
            info = LAPACKE_dlaswp(LAPACK_COL_MAJOR, right, rest, stride, j + 1, j + w, pivots, 1);
        if (info == 0 && right > 0) {
            cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasUnit, w, right,
                        1.0, panel + j, stride, rest + j, stride);
            cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, right, right, w, -1.0,
                        panel + j + w, stride, rest + j, stride, 1.0, rest + j + w, stride);
        }
        if (progress_step(progress))
            break;
    }
    return info;
}

igabem_status linear_lu_factor(const struct matrix *matrix, int *pivots, double *condition)
{
    igabem_status status = check_size(matrix->stride);
    if (status != IGABEM_OK)
        return status;
    lapack_int order = (lapack_int)matrix->n, stride = (lapack_int)matrix->stride;
    double *a = matrix->rows, norm = 0.0;
    status = find_norm(matrix, &norm);
    if (status != IGABEM_OK)
        return status;
    double reciprocal = 0.0;
    lapack_int info = factor(matrix->progress, order, a, stride, pivots);
    if (progress_status(matrix->progress))
        return IGABEM_ERROR_CANCELLED;
    if (info == 0 && condition) {
        info = LAPACKE_dgecon(LAPACK_COL_MAJOR, 'I', order, a, stride, norm, &reciprocal);
        *condition = 1.0 / reciprocal;
    }
    return info == 0 ? IGABEM_OK : igabem_fail_lapack("solution for the source density", info);
}

igabem_status linear_lu_solve(const struct matrix *factors, const int *pivots, bool transposed,
                              size_t count, double *right)
{
    size_t n = factors->n;
    igabem_status status = check_size(count);
    if (status != IGABEM_OK)
        return status;
    lapack_int info =
        LAPACKE_dgetrs(LAPACK_COL_MAJOR, transposed ? 'N' : 'T', (lapack_int)n, (lapack_int)count,
                       factors->rows, (lapack_int)factors->stride, pivots, right, (lapack_int)n);
    if (info != 0)
        return igabem_fail_lapack("solution for the source density", info);
    for (size_t i = 0; i < n * count; i++)
        if (!isfinite(right[i]))
            return igabem_fail(IGABEM_ERROR_NUMERIC, "unknown %zu is not finite", i % n);
    return IGABEM_OK;
}

igabem_status linear_lu(const struct matrix *matrix, double *right, double *condition)
{
    return linear_lu_many(matrix, 1, right, condition);
}

igabem_status linear_lu_many(const struct matrix *matrix, size_t count, double *right,
                             double *condition)
{
    int *pivots = malloc(matrix->n * sizeof *pivots);
    if (!pivots)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory to solve for %zu unknowns", matrix->n);
    igabem_status status = linear_lu_factor(matrix, pivots, condition);
    if (status == IGABEM_OK)
        status = linear_lu_solve(matrix, pivots, false, count, right);
    free(pivots);
    return status;
}

struct iteration {
    struct matrix matrix;
    size_t width;       /* of half the band */
    size_t *order;      /* [n] unknowns by x */
    double *band;       /* factors of the transposed band, LAPACK's layout */
    lapack_int *pivots; /* [n] */
    double *buffer;     /* [n] */
};

VECTOR_MULTIVERSION
static double dot(size_t n, const double *a, const double *b)
{
    double part[16] = {0}, sum = 0.0;
    size_t j = 0;
    for (; j + 16 <= n; j += 16)
        for (size_t l = 0; l < 16; l++)
            part[l] += a[j + l] * b[j + l];
    for (; j < n; j++)
        sum += a[j] * b[j];
    for (size_t l = 0; l < 16; l++)
        sum += part[l];
    return sum;
}

VECTOR_MULTIVERSION
static void add(size_t n, double factor, const double *a, double *b)
{
    for (size_t j = 0; j < n; j++)
        b[j] += factor * a[j];
}

/* What GMRES is handed: which matrix, and whether transposed. */
struct view {
    const struct iteration *iteration;
    const struct addend *addend;
    char transposed;
};

static void multiply(const void *data, const double *x, double *y)
{
    const struct view *view = data;
    const struct matrix *matrix = &view->iteration->matrix;
    size_t n = matrix->n;
#pragma omp parallel for num_threads(matrix->threads) schedule(static)
    for (size_t i = 0; i < n; i++)
        y[i] = dot(n, matrix->rows + i * matrix->stride, x);
    if (view->addend)
        view->addend->add(view->addend->data, x, y);
}

static void multiply_transposed(const void *data, const double *x, double *y)
{
    const struct view *view = data;
    const struct matrix *matrix = &view->iteration->matrix;
    size_t n = matrix->n, parts = (size_t)matrix->threads;
#pragma omp parallel for num_threads(matrix->threads) schedule(static)
    for (size_t part = 0; part < parts; part++) {
        size_t first = n * part / parts, count = n * (part + 1) / parts - first;
        memset(y + first, 0, count * sizeof *y);
        for (size_t i = 0; i < n; i++)
            add(count, x[i], matrix->rows + i * matrix->stride + first, y + first);
    }
}

/* The band is stored transposed, so that its rows are those of the matrix. */
static void solve_band(const void *data, const double *x, double *y)
{
    const struct view *view = data;
    const struct iteration *iteration = view->iteration;
    size_t n = iteration->matrix.n;
    lapack_int order = (lapack_int)n, width = (lapack_int)iteration->width;
    for (size_t i = 0; i < n; i++)
        iteration->buffer[i] = x[iteration->order[i]];
    lapack_int info = LAPACKE_dgbtrs_work(LAPACK_COL_MAJOR, view->transposed ? 'N' : 'T', order,
                                          width, width, 1, iteration->band, 3 * width + 1,
                                          iteration->pivots, iteration->buffer, order);
    /* NaN ends the iteration without a result. */
    for (size_t i = 0; i < n; i++)
        y[iteration->order[i]] = info ? NAN : iteration->buffer[i];
}

struct place {
    double x;
    size_t unknown;
};

static int by_x(const void *a, const void *b)
{
    const struct place *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return p->unknown < q->unknown ? -1 : p->unknown > q->unknown;
}

static igabem_status sort_unknowns(struct iteration *iteration, const double *point)
{
    size_t n = iteration->matrix.n;
    struct place *place = malloc(n * sizeof *place);
    if (!place)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory to sort %zu unknowns", n);
    for (size_t i = 0; i < n; i++)
        place[i] = (struct place){point[3 * i], i};
    qsort(place, n, sizeof *place, by_x);
    for (size_t i = 0; i < n; i++)
        iteration->order[i] = place[i].unknown;
    free(place);
    return IGABEM_OK;
}

static igabem_status factor_band(struct iteration *iteration)
{
    const struct matrix *matrix = &iteration->matrix;
    size_t n = matrix->n, width = iteration->width, height = 3 * width + 1;
    for (size_t i = 0; i < n; i++) {
        const double *row = matrix->rows + iteration->order[i] * matrix->stride;
        double *column = iteration->band + i * height + 2 * width - i;
        size_t first = i > width ? i - width : 0, last = i + width < n ? i + width + 1 : n;
        for (size_t k = first; k < last; k++) {
            column[k] = row[iteration->order[k]];
            if (!isfinite(column[k]))
                return igabem_fail(IGABEM_ERROR_NUMERIC, "the influence matrix is not finite");
        }
    }
    lapack_int order = (lapack_int)n, half = (lapack_int)width;
    if (LAPACKE_dgbtrf_work(LAPACK_COL_MAJOR, order, order, half, half, iteration->band,
                            (lapack_int)height, iteration->pivots) != 0)
        return igabem_fail(IGABEM_ERROR_NUMERIC,
                           "the influence matrix is singular near its diagonal");
    return IGABEM_OK;
}

igabem_status iteration_create(const struct matrix *matrix, const double *point,
                               struct iteration **result)
{
    size_t n = matrix->n;
    *result = NULL;
    igabem_status status = check_size(n);
    if (status != IGABEM_OK)
        return status;
    struct iteration *iteration = calloc(1, sizeof *iteration);
    if (!iteration)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory to solve for %zu unknowns", n);
    iteration->matrix = *matrix;
    iteration->width = (size_t)ceil(BAND * sqrt((double)n));
    if (iteration->width >= n)
        iteration->width = n - 1;
    iteration->order = malloc(n * sizeof *iteration->order);
    iteration->pivots = malloc(n * sizeof *iteration->pivots);
    iteration->buffer = malloc(n * sizeof *iteration->buffer);
    iteration->band = calloc(n * (3 * iteration->width + 1), sizeof *iteration->band);
    if (!iteration->order || !iteration->pivots || !iteration->buffer || !iteration->band)
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory to solve for %zu unknowns", n);
    if (status == IGABEM_OK)
        status = sort_unknowns(iteration, point);
    if (status == IGABEM_OK)
        status = factor_band(iteration);
    if (status != IGABEM_OK) {
        iteration_free(iteration);
        return status;
    }
    *result = iteration;
    return IGABEM_OK;
}

void iteration_free(struct iteration *iteration)
{
    if (!iteration)
        return;
    free(iteration->order);
    free(iteration->pivots);
    free(iteration->buffer);
    free(iteration->band);
    free(iteration);
}

/* Asked after each iteration. */
static bool cancelled(const void *data)
{
    const struct view *view = data;
    return progress_step(view->iteration->matrix.progress);
}

static igabem_status run(const struct view *view, double tolerance, const double *right, double *x,
                         struct gmres_result *result)
{
    const struct gmres gmres = {.n = view->iteration->matrix.n,
                                .matrix = view->transposed ? multiply_transposed : multiply,
                                .precondition = solve_band,
                                .cancelled = cancelled,
                                .data = view,
                                .restart = RESTART,
                                .most = MOST,
                                .tolerance = tolerance};
    igabem_status status = gmres_solve(&gmres, right, x, result);
    return status == IGABEM_ERROR_CANCELLED ? progress_status(view->iteration->matrix.progress)
                                            : status;
}

igabem_status iteration_solve(const struct iteration *iteration, const struct addend *addend,
                              const double *right, double *x, struct gmres_result *result)
{
    const struct view view = {iteration, addend, 0};
    return run(&view, TOLERANCE, right, x, result);
}

igabem_status iteration_condition(const struct iteration *iteration, double *condition)
{
    const struct matrix *matrix = &iteration->matrix;
    size_t n = matrix->n;
    lapack_int order = (lapack_int)n, kase = 0, save[3];
    double inverse = 0.0, norm = 0.0;
    double *vector = malloc(3 * n * sizeof *vector), *x = vector + n, *right = x + n;
    lapack_int *sign = malloc(n * sizeof *sign);
    igabem_status status = vector && sign ? find_norm(matrix, &norm)
                                          : igabem_fail(IGABEM_ERROR_MEMORY, "no memory to solve");
    for (int k = 0; k < ESTIMATES && status == IGABEM_OK; k++) {
        lapack_int info = LAPACKE_dlacn2_work(order, vector, x, sign, &inverse, &kase, save);
        if (info)
            status = igabem_fail(IGABEM_ERROR_NUMERIC, "condition: dlacn2 says %d", (int)info);
        if (info || kase == 0)
            break;
        const struct view view = {iteration, NULL, kase == 2};
        struct gmres_result result;
        memcpy(right, x, n * sizeof *x);
        memset(x, 0, n * sizeof *x);
        status = run(&view, ROUGH, right, x, &result);
    }
    *condition = norm * inverse;
    free(vector);
    free(sign);
    return status;
}

double iteration_memory(const struct iteration *iteration)
{
    size_t width = 3 * iteration->width + 1;
    return (double)(iteration->matrix.n * width * sizeof *iteration->band);
}
