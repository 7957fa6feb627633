#include "reference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void give_up(const char *what)
{
    fprintf(stderr, "reference data: %s: %s\n", what, nurbs_last_error());
    exit(EXIT_FAILURE);
}

struct reference reference_load(void)
{
    json_error_t error;
    struct reference r;
    r.root = json_load_file(TEST_DATA_DIR "/nurbs_reference.json", 0, &error);
    if (!r.root)
        give_up(error.text);
    r.cases = json_object_get(r.root, "cases");
    return r;
}

void reference_free(struct reference *reference)
{
    json_decref(reference->root);
}

int reference_is(const json_t *c, const char *kind)
{
    return strcmp(json_string_value(json_object_get(c, "kind")), kind) == 0;
}

const char *reference_id(const json_t *c)
{
    return json_string_value(json_object_get(c, "id"));
}

static size_t flatten(const json_t *value, double *out)
{
    if (!json_is_array(value)) {
        if (out)
            *out = json_number_value(value);
        return 1;
    }
    size_t n = 0;
    for (size_t i = 0; i < json_array_size(value); i++)
        n += flatten(json_array_get(value, i), out ? out + n : NULL);
    return n;
}

double *reference_numbers(const json_t *array, size_t *n)
{
    if (!array)
        give_up("missing array");
    const size_t count = flatten(array, NULL);
    double *out = malloc((count + 1) * sizeof *out);
    if (!out)
        give_up("memory");
    flatten(array, out);
    if (n)
        *n = count;
    return out;
}

double *reference_points(const json_t *array, int dim, size_t *n)
{
    size_t count;
    double *flat = reference_numbers(array, &count);
    const size_t points = count / (size_t)dim;
    double *out = calloc(3 * points + 1, sizeof *out);
    if (!out)
        give_up("memory");
    for (size_t i = 0; i < points; i++)
        memcpy(out + 3 * i, flat + (size_t)dim * i, (size_t)dim * sizeof *out);
    free(flat);
    if (n)
        *n = points;
    return out;
}

static int dimension(const json_t *c)
{
    return (int)json_integer_value(json_object_get(c, "dim"));
}

static int degree_of(const json_t *c, size_t direction)
{
    return (int)json_integer_value(json_array_get(json_object_get(c, "degree"), direction));
}

nurbs_curve *reference_curve(const json_t *c, const json_t *part, int by)
{
    size_t n;
    double *points = reference_points(json_object_get(part, "P"), dimension(c), &n);
    double *knots = reference_numbers(json_object_get(part, "knots"), NULL);
    json_t *w = json_object_get(part, "w");
    double *weights = w ? reference_numbers(w, NULL) : NULL;
    nurbs_curve *curve;
    if (nurbs_curve_create(degree_of(c, 0) + by, n, knots, points, weights, &curve) != NURBS_OK)
        give_up(reference_id(c));
    free(points);
    free(knots);
    free(weights);
    return curve;
}

nurbs_surface *reference_surface(const json_t *c, const json_t *part, int by)
{
    const int degree[2] = {degree_of(c, 0) + by, degree_of(c, 1) + by};
    size_t size[2];
    double *knots[2];
    for (size_t d = 0; d < 2; d++) {
        size[d] = (size_t)json_integer_value(json_array_get(json_object_get(part, "n"), d));
        knots[d] = reference_numbers(json_array_get(json_object_get(part, "knots"), d), NULL);
    }
    double *points = reference_points(json_object_get(part, "P"), 3, NULL);
    json_t *w = json_object_get(part, "w");
    double *weights = w ? reference_numbers(w, NULL) : NULL;
    nurbs_surface *surface;
    if (nurbs_surface_create(degree, size, knots[0], knots[1], points, weights, &surface) !=
        NURBS_OK)
        give_up(reference_id(c));
    free(knots[0]);
    free(knots[1]);
    free(points);
    free(weights);
    return surface;
}

double scale_of(const double *values, size_t n)
{
    double scale = 1.0;
    for (size_t i = 0; i < n; i++)
        scale = fmax(scale, fabs(values[i]));
    return scale;
}

double largest_difference(const double *a, const double *b, size_t n)
{
    double largest = 0.0;
    for (size_t i = 0; i < n; i++) {
        const double d = fabs(a[i] - b[i]);
        if (!(d <= largest))
            largest = d;
    }
    return largest;
}

double random_unit(uint64_t *state)
{
    uint64_t z = (*state += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

void random_knots(uint64_t *state, int degree, size_t n, int hard, double *knots)
{
    const size_t p = (size_t)degree, interior = n - p - 1;
    for (size_t i = 0; i <= p; i++) {
        knots[i] = 0.0;
        knots[n + i] = 1.0;
    }
    for (size_t i = 0; i < interior; i++)
        knots[p + 1 + i] =
            ((double)i + 1.0 + 0.6 * (random_unit(state) - 0.5)) / (double)(interior + 1);
    for (size_t i = 1; hard && i < interior; i++) {
        const double choice = random_unit(state);
        if (choice < 0.25 && degree > 1 && (i < 2 || knots[p + i] != knots[p + i - 1]))
            knots[p + 1 + i] = knots[p + i];
        else if (choice < 0.45)
            knots[p + 1 + i] = knots[p + i] + 1e-9;
    }
}

nurbs_curve *random_curve(uint64_t *state, int degree, size_t n, int hard, int rational)
{
    double *knots = malloc((n + (size_t)degree + 1) * sizeof *knots);
    double *points = malloc(3 * n * sizeof *points), *weights = malloc(n * sizeof *weights);
    nurbs_curve *curve = NULL;
    if (!knots || !points || !weights)
        give_up("memory");
    random_knots(state, degree, n, hard, knots);
    for (size_t i = 0; i < 3 * n; i++)
        points[i] = 2.0 * random_unit(state) - 1.0;
    for (size_t i = 0; i < n; i++)
        weights[i] = 0.5 + 1.5 * random_unit(state);
    if (nurbs_curve_create(degree, n, knots, points, rational ? weights : NULL, &curve) != NURBS_OK)
        give_up("random curve");
    free(knots);
    free(points);
    free(weights);
    return curve;
}

nurbs_surface *random_surface(uint64_t *state, const int degree[2], const size_t size[2], int hard,
                              int rational)
{
    const size_t n = size[0] * size[1];
    double *knots[2];
    for (int d = 0; d < 2; d++) {
        knots[d] = malloc((size[d] + (size_t)degree[d] + 1) * sizeof(double));
        if (!knots[d])
            give_up("memory");
        random_knots(state, degree[d], size[d], hard, knots[d]);
    }
    double *points = malloc(3 * n * sizeof *points), *weights = malloc(n * sizeof *weights);
    nurbs_surface *surface = NULL;
    if (!points || !weights)
        give_up("memory");
    for (size_t i = 0; i < 3 * n; i++)
        points[i] = 2.0 * random_unit(state) - 1.0;
    for (size_t i = 0; i < n; i++)
        weights[i] = 0.5 + 1.5 * random_unit(state);
    if (nurbs_surface_create(degree, size, knots[0], knots[1], points, rational ? weights : NULL,
                             &surface) != NURBS_OK)
        give_up("random surface");
    free(knots[0]);
    free(knots[1]);
    free(points);
    free(weights);
    return surface;
}
