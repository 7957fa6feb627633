/* Writes the C source of the tables described in src/kelvin/kelvin_table.h.
 *
 * N is sampled at Chebyshev nodes of large blocks (one face, one octave of r), where the polynomial
 * of degree about 20 per variable is exact to 1e-13; every cell is a part of one block. A cell
 * keeps the least total degree whose dropped Chebyshev coefficients bound the error of value and
 * gradient. */
#include "../src/core/constants.h"
#include "../src/kelvin/kelvin_table.h"
#include "local_integral.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { BLOCK_R = 18, BLOCK_A = 21, BLOCK_B = 22, MOST = 24, CELL = 16 };

/* Bound asked of the gradient error, relative to |N|/R; the value is then far better. */
static const double gradient_tolerance = 1e-9;
/* Relative error of the samples: coefficients below are noise. */
static const double rounding = 4e-15;

/* Samples or Chebyshev coefficients of n[0] x n[1] x n[2]. */
struct tensor {
    int n[3];
    double v[MOST][MOST][MOST];
};

enum quantity { PLAIN, LOG_L, LOG_K };

static void point_of(int face, double M, double a, double b, double *P)
{
    double y = face == 1 ? 1 : sqrt(a);
    P[0] = M * (face == 0 ? 1 : face == 1 ? a : b);
    P[1] = M * y;
    P[2] = -M * (face == 2 ? 1 : b);
}

static double sample(enum quantity what, int face, double r, double a, double b)
{
    double P[3];
    if (what == PLAIN) {
        point_of(face, 1 / r, a, b, P);
        return local_integral(P[0], P[1], P[2]) / r;
    }
    point_of(face, r, a, b, P);
    double L = logarithm_factor(P[0], P[1], P[2]);
    if (what == LOG_L)
        return L;
    double R = sqrt(P[0] * P[0] + P[1] * P[1] + P[2] * P[2]);
    return local_integral(P[0], P[1], P[2]) + 2 * (1 - P[2] / (R + P[0])) + log(r) * L;
}

static double node(int i, int n, double low, double high)
{
    return 0.5 * (low + high) + 0.5 * (high - low) * cos(PI * (i + 0.5) / n);
}

/* t <- m t along one axis; m is rows x t->n[axis]. */
static void apply(struct tensor *t, int axis, int rows, double m[MOST][MOST])
{
    int p = axis == 0 ? 1 : 0, q = axis == 2 ? 1 : 2, old = t->n[axis];
    for (int i = 0; i < t->n[p]; i++)
        for (int j = 0; j < t->n[q]; j++) {
            double line[MOST];
            int at[3];
            at[p] = i;
            at[q] = j;
            for (int k = 0; k < old; k++) {
                at[axis] = k;
                line[k] = t->v[at[0]][at[1]][at[2]];
            }
            for (int r = 0; r < rows; r++) {
                double sum = 0;
                for (int k = 0; k < old; k++)
                    sum += m[r][k] * line[k];
                at[axis] = r;
                t->v[at[0]][at[1]][at[2]] = sum;
            }
        }
    t->n[axis] = rows;
}

/* Samples at Chebyshev nodes to Chebyshev coefficients. */
static void transform(struct tensor *t)
{
    for (int axis = 0; axis < 3; axis++) {
        double m[MOST][MOST];
        int n = t->n[axis];
        for (int p = 0; p < n; p++)
            for (int i = 0; i < n; i++)
                m[p][i] = (p ? 2.0 : 1.0) / n * cos(PI * p * (i + 0.5) / n);
        apply(t, axis, n, m);
    }
}

/* Chebyshev coefficients on the part [low, high] of [-1, 1] along each axis, CELL per axis. */
static void restrict_to(const struct tensor *block, const double *low, const double *high,
                        struct tensor *cell)
{
    *cell = *block;
    for (int axis = 0; axis < 3; axis++) {
        double m[MOST][MOST];
        for (int i = 0; i < CELL; i++) {
            double x = node(i, CELL, low[axis], high[axis]);
            m[i][0] = 1;
            m[i][1] = x;
            for (int k = 2; k < block->n[axis]; k++)
                m[i][k] = 2 * x * m[i][k - 1] - m[i][k - 2];
        }
        apply(cell, axis, CELL, m);
    }
    transform(cell);
}

/* Chebyshev to powers along one axis, T_k as rows of the usual triangle. */
static void to_powers(struct tensor *t)
{
    double m[MOST][MOST] = {{0}}, T[MOST][MOST] = {{0}};
    T[0][0] = T[1][1] = 1;
    for (int k = 2; k < CELL; k++)
        for (int p = 0; p <= k; p++)
            T[k][p] = (p ? 2 * T[k - 1][p - 1] : 0) - T[k - 2][p];
    for (int p = 0; p < CELL; p++)
        for (int k = 0; k < CELL; k++)
            m[p][k] = T[k][p];
    for (int axis = 0; axis < 3; axis++)
        apply(t, axis, CELL, m);
}

/* Least D with Sum_{i+j+k > D} |c_ijk| |gradient of T_i T_j T_k| below the tolerance; |T_n'| <=
 * n^2, and the half widths of a cell are at least a seventh of r and exactly 1/(2 CUTS) in a and b.
 */
static int least_degree(const struct tensor *t)
{
    double per_degree[3 * CELL] = {0}, largest = 0;
    for (int i = 0; i < CELL; i++)
        for (int j = 0; j < CELL; j++)
            for (int k = 0; k < CELL; k++) {
                double c = fabs(t->v[i][j][k]);
                largest = fmax(largest, c);
                if (c > rounding * largest) /* the constant term comes first */
                    per_degree[i + j + k] +=
                        c * (7.0 * i * i + 2.0 * KELVIN_CUTS * (2.0 * j * j + k * k));
            }
    double dropped = 0;
    int degree = 3 * CELL - 1;
    while (degree > 0 && dropped + per_degree[degree] <= gradient_tolerance * largest)
        dropped += per_degree[degree--];
    if (degree > KELVIN_MOST_DEGREE) {
        fprintf(stderr, "kelvin_tables: a cell needs degree %d, at most %d\n", degree,
                KELVIN_MOST_DEGREE);
        exit(EXIT_FAILURE);
    }
    return degree;
}

static void cut_to_degree(struct tensor *t, int degree)
{
    for (int i = 0; i < CELL; i++)
        for (int j = 0; j < CELL; j++)
            for (int k = 0; k < CELL; k++)
                if (i + j + k > degree)
                    t->v[i][j][k] = 0;
}

static kelvin_cell cells[KELVIN_ZONES * KELVIN_CELLS_PER_ZONE];
static double *coefficients;
static uint32_t used, room;

static void keep(double value)
{
    if (used == room) {
        room = room ? 2 * room : 1 << 18;
        coefficients = realloc(coefficients, room * sizeof *coefficients);
        if (!coefficients) {
            fputs("kelvin_tables: out of memory\n", stderr);
            exit(EXIT_FAILURE);
        }
    }
    coefficients[used++] = value;
}

static void keep_cell(const struct tensor *t, int degree, kelvin_cell *cell)
{
    *cell = (kelvin_cell){used, (uint32_t)degree};
    for (int first = 0; first <= 8; first += 8)
        for (int i = degree - first; i >= 0; i--)
            for (int j = degree - first - i; j >= 0; j--)
                for (int k = first; k < first + 8; k++)
                    keep(k < CELL ? t->v[i][j][k] : 0);
}

/* Splits one block into `parts` zones along r, cut at the given places of [-1,1], and CUTS^2 cells
 * each. */
static void store(const struct tensor *block, int face, int zone, int parts, const double *places)
{
    static struct tensor cell;
    for (int part = 0; part < parts; part++)
        for (int i = 0; i < KELVIN_CUTS; i++)
            for (int j = 0; j < KELVIN_CUTS; j++) {
                double low[3] = {places[part], -1 + 2.0 * i / KELVIN_CUTS,
                                 -1 + 2.0 * j / KELVIN_CUTS};
                double high[3] = {places[part + 1], -1 + 2.0 * (i + 1) / KELVIN_CUTS,
                                  -1 + 2.0 * (j + 1) / KELVIN_CUTS};
                restrict_to(block, low, high, &cell);
                int degree = least_degree(&cell);
                cut_to_degree(&cell, degree);
                to_powers(&cell);
                keep_cell(&cell, degree,
                          &cells[(zone + part) * KELVIN_CELLS_PER_ZONE +
                                 (face * KELVIN_CUTS + i) * KELVIN_CUTS + j]);
            }
}

static void fill_block(enum quantity what, int face, double low, double high, struct tensor *block)
{
    block->n[0] = BLOCK_R;
    block->n[1] = BLOCK_A;
    block->n[2] = BLOCK_B;
#pragma omp parallel for collapse(2) schedule(dynamic, 4)
    for (int i = 0; i < BLOCK_R; i++)
        for (int j = 0; j < BLOCK_A; j++)
            for (int k = 0; k < BLOCK_B; k++)
                block->v[i][j][k] = sample(what, face, node(i, BLOCK_R, low, high),
                                           node(j, BLOCK_A, 0, 1), node(k, BLOCK_B, 0, 1));
    transform(block);
}

static int write_source(const char *path)
{
    FILE *out = fopen(path, "w");
    if (!out) {
        perror(path);
        return EXIT_FAILURE;
    }
    fputs("#include \"kelvin/kelvin_table.h\"\n\nconst kelvin_cell kelvin_cells[] = {\n", out);
    for (int i = 0; i < KELVIN_ZONES * KELVIN_CELLS_PER_ZONE; i++)
        fprintf(out, "{%u,%u},\n", (unsigned)cells[i].offset, (unsigned)cells[i].degree);
    fputs("};\n\n_Alignas(64) const double kelvin_coefficients[] = {\n", out);
    for (uint32_t i = 0; i < used; i++) {
        if (coefficients[i] == 0)
            fputs("0", out);
        else
            fprintf(out, "%a", coefficients[i]);
        fputs(i % 8 == 7 ? ",\n" : ",", out);
    }
    fputs("};\n", out);
    int failed = ferror(out);
    if (fclose(out) != 0 || failed) {
        fprintf(stderr, "%s: cannot be written\n", path);
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: %s OUTPUT.c\n", argv[0]);
        return 2;
    }
    static struct tensor block;
    /* Places of [-1,1] where an octave is cut: its ends and 1.5 times the lower one. */
    static const double whole[] = {-1, 1}, halves[] = {-1, 0, 1};
    for (int face = 0; face < 3; face++) {
        for (int e = KELVIN_R_FAR_EXPONENT; e < KELVIN_R_NEAR_EXPONENT; e++) {
            fill_block(PLAIN, face, ldexp(1, e), ldexp(1, e + 1), &block);
            store(&block, face, 2 * (e - KELVIN_R_FAR_EXPONENT), 2, halves);
        }
        fill_block(PLAIN, face, 0, KELVIN_R_FAR, &block);
        store(&block, face, KELVIN_ZONE_FAR, 1, whole);
        fill_block(LOG_L, face, 0, 1 / KELVIN_R_NEAR, &block);
        store(&block, face, KELVIN_ZONE_LOG_L, 1, whole);
        fill_block(LOG_K, face, 0, 1 / KELVIN_R_NEAR, &block);
        store(&block, face, KELVIN_ZONE_LOG_K, 1, whole);
    }
    int status = write_source(argv[1]);
    free(coefficients);
    return status;
}
