/* igabem green: the Kelvin Green function's local and wave part at the points of a CSV table. */
#include "cli.h"
#include "commands.h"
#include "constants.h"
#include "hull_input.h"
#include "json_result.h"

#include <igabem/kelvin.h>

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

struct request {
    bool bench, json;
};
static const struct setting ROWS[] = {
    HULL_ROW(struct request, "bench", SWITCH, bench,
             .sentence = "print nanoseconds per evaluation by region instead"),
    HULL_JSON_ROW(struct request, json),
};
static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS,
    .usage = "usage: igabem green [OPTION]... < IN.csv > OUT.csv\n"
             "\n"
             "N and W of 4 pi G = -1/r + 1/r' + k0 (N + W) and their gradients, dimensionless.\n"
             "IN.csv: header X,Y,Z, one point a line, Z <= 0; '#' starts a comment line.\n"
             "OUT.csv: header X,Y,Z,N,N_X,N_Y,N_Z,W,W_X,W_Y,W_Z, 17 significant digits.\n\n"};

enum { COLUMNS = 11, BENCH_POINTS = 4000 };
static const char *const names[COLUMNS] = {"X",   "Y", "Z",   "N",   "N_X", "N_Y",
                                           "N_Z", "W", "W_X", "W_Y", "W_Z"};

/* n values of each column, column by column; line: where each point stood in the input. */
static int evaluate(size_t n, const size_t *line, double *v)
{
    double *c[COLUMNS];
    for (size_t k = 0; k < COLUMNS; k++)
        c[k] = v + k * n;
    for (size_t i = 0; i < n; i++) {
        if (c[2][i] > 0)
            return cli_fail("standard input:%zu: Z is %g, expected Z <= 0", line[i], c[2][i]);
        if (c[0][i] == 0 && c[1][i] == 0 && c[2][i] == 0)
            return cli_fail("standard input:%zu: X = Y = Z = 0, where N is singular", line[i]);
        if (fmax(fmax(fabs(c[0][i]), fabs(c[1][i])), -c[2][i]) > 1e9)
            return cli_fail("standard input:%zu: the point is farther than 1e9", line[i]);
    }
    if (igabem_kelvin_local(n, c[0], c[1], c[2], c[3], c[4], c[5], c[6]) != IGABEM_OK ||
        igabem_kelvin_wave(n, c[0], c[1], c[2], c[7], c[8], c[9], c[10]) != IGABEM_OK)
        return cli_fail("%s", igabem_last_error());
    return CLI_OK;
}

static int print_csv(size_t n, const double *v)
{
    for (int k = 0; k < COLUMNS; k++)
        printf("%s%c", names[k], k + 1 < COLUMNS ? ',' : '\n');
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < COLUMNS; k++)
            printf("%.17g%c", v[k * n + i], k + 1 < COLUMNS ? ',' : '\n');
    return cli_print("");
}

static int print_json(json_t *object)
{
    if (!object)
        return cli_fail("out of memory");
    return json_result_print(object, JSON_REAL_PRECISION(17) | JSON_COMPACT);
}

static int print_points_json(size_t n, const double *v)
{
    json_t *root = json_object();
    for (size_t k = 0; root && k < COLUMNS; k++) {
        json_t *column = json_array();
        for (size_t i = 0; column && i < n; i++)
            json_result_append(column, json_real(v[k * n + i]));
        json_result_set(root, names[k], column);
    }
    return print_json(root);
}

static int run_table(bool json)
{
    struct cli_table table;
    if (!cli_table_read("-", &table))
        return CLI_FAILED;
    size_t n = table.rows;
    int column[3], status = CLI_OK;
    for (int k = 0; k < 3 && status == CLI_OK; k++) {
        column[k] = cli_table_column(&table, names[k]);
        if (column[k] < 0)
            status =
                cli_fail("standard input: the header has no column %s, expected X,Y,Z", names[k]);
    }
    double *v = status == CLI_OK ? calloc(COLUMNS * (n + 1), sizeof *v) : NULL;
    if (status == CLI_OK && !v)
        status = cli_fail("out of memory");
    if (status == CLI_OK) {
        for (size_t i = 0; i < n; i++)
            for (size_t k = 0; k < 3; k++)
                v[k * n + i] = table.values[i * table.columns + (size_t)column[k]];
        status = evaluate(n, table.lines, v);
    }
    if (status == CLI_OK)
        status = json ? print_points_json(n, v) : print_csv(n, v);
    free(v);
    cli_table_free(&table);
    return status;
}

/* Uniform in [0, 1). */
static double uniform(unsigned long long *state)
{
    *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(*state >> 11) * 0x1p-53;
}

/* Regions of the benchmark: behind a hull of k0 L = 16, near the origin, and log-uniform in R. */
static const char *const regions[] = {"hull", "near", "whole"};
enum { REGIONS = 3 };

static void place(int region, double *v)
{
    unsigned long long state = 1;
    for (size_t i = 0; i < BENCH_POINTS; i++) {
        double a = uniform(&state), b = uniform(&state), c = uniform(&state), *P = v + i;
        double size = region == 1 ? 0.1 : 1, R = 1e-4 * pow(1e8, a), t = PI / 2;
        if (region < 2) {
            P[0] = -16 * a * size;
            P[BENCH_POINTS] = 1.6 * (b - 0.5) * size;
            P[2 * BENCH_POINTS] = -(0.01 + 0.8 * c) * size;
        } else {
            P[0] = -R * cos(t * b);
            P[BENCH_POINTS] = R * sin(t * b) * cos(t * c);
            P[2 * BENCH_POINTS] = -R * sin(t * b) * sin(t * c);
        }
    }
}

static double processor_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Least nanoseconds per point of several passes, in batches of `batch`. */
static double measure(bool wave, size_t batch, double *v)
{
    const size_t n = BENCH_POINTS;
    double best = INFINITY;
    for (int pass = 0; pass < 7; pass++) {
        double start = processor_seconds();
        for (size_t i = 0; i + batch <= n; i += batch) {
            double *p = v + i, *o = p + 3 * n;
            igabem_status status = (wave ? igabem_kelvin_wave : igabem_kelvin_local)(
                batch, p, p + n, p + 2 * n, o, o + n, o + 2 * n, o + 3 * n);
            if (status != IGABEM_OK)
                return NAN;
        }
        best = fmin(best, 1e9 * (processor_seconds() - start) / (double)n);
    }
    return best;
}

/* A core that has idled runs slower for its first seconds, this kernel by a factor of 3. */
static void warm_up(double *v)
{
    place(0, v);
    for (double start = processor_seconds(); processor_seconds() - start < 4.0;)
        measure(true, BENCH_POINTS, v);
}

static int run_bench(bool json)
{
    static const char *const what[] = {"local", "wave"};
    double *v = calloc(7 * (size_t)BENCH_POINTS, sizeof *v);
    json_t *root = json ? json_object() : NULL;
    if (!v || (json && !root)) {
        free(v);
        json_decref(root);
        return cli_fail("out of memory");
    }
    if (!json)
        printf("nanoseconds of processor time per point, value and gradient, one thread\n"
               "%-8s %-8s %8s %8s\n",
               "region", "part", "batch", "single");
    warm_up(v);
    for (int region = 0; region < REGIONS; region++) {
        json_t *entry = json ? json_object() : NULL;
        place(region, v);
        for (int part = 0; part < 2; part++) {
            double batch = measure(part == 1, BENCH_POINTS, v), single = measure(part == 1, 1, v);
            if (json)
                json_result_set(entry, what[part],
                                json_pack("{s:f,s:f}", "batch", batch, "single", single));
            else
                printf("%-8s %-8s %8.0f %8.0f\n", regions[region], what[part], batch, single);
        }
        if (json)
            json_result_set(root, regions[region], entry);
    }
    free(v);
    return json ? print_json(root) : cli_print("");
}

int command_green(int argc, char **argv)
{
    struct request request = {0};
    int code = settings_options(argc, argv, &TABLE, &request, NULL, NULL);
    if (code >= 0)
        return code;
    return request.bench ? run_bench(request.json) : run_table(request.json);
}
