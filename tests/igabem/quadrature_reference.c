#include "quadrature_reference.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>

enum { POINTS = 10, CHOSEN_S = 1, CHOSEN_T = 2, BISECTIONS = 40 };
static const long double pi = 3.14159265358979323846264338327950288L;

const char *plate_name(enum plate_shape shape)
{
    static const char *const name[PLATE_SHAPES] = {"bent", "long", "curved", "collapsed", "strip"};
    return name[shape];
}

static void control_point(enum plate_shape shape, int i, int j, double h[4])
{
    static const double across[PLATE_SIDE] = {-0.5, -0.5, 0.5, 0.5},
                        up[PLATE_SIDE] = {0, 0.7, 0.7, 0};
    double s = i / 3.0, t = j / 3.0;
    double bent_s = s + 0.5 * s * (1.0 - s) * (t - 0.5),
           bent_t = t + 0.5 * t * (1.0 - t) * (s - 0.5);
    h[3] = 1.0;
    switch (shape) {
    case PLATE_BENT:
        h[0] = -0.2 + 1.2 * bent_s;
        h[1] = 0.4 * bent_t;
        h[2] = 0.0;
        break;
    case PLATE_LONG:
        h[0] = bent_s;
        h[1] = 0.01 * bent_t;
        h[2] = 0.0;
        break;
    case PLATE_CURVED:
        h[0] = (1.0 - 0.4 * t) * across[i] + 0.5 * t * t;
        h[1] = 1.2 * t;
        h[2] = (1.0 - 0.3 * t * t) * up[i];
        break;
    case PLATE_COLLAPSED:
        h[0] = t * (s - 0.5);
        h[1] = t - 0.2 * t * s * (1.0 - s);
        h[2] = 0.4 * t * t + 0.5 * t * s * (1.0 - s);
        break;
    default:
        h[0] = 10.0 * s;
        h[1] = 0.1 * t * (1.0 + 0.2 * s);
        h[2] = 0.1 * sqrt(t) + 0.3 * s * s;
        break;
    }
}

void plate_make(enum plate_shape shape, struct plate *plate)
{
    *plate = (struct plate){
        .element = {.degree = {PLATE_DEGREE, PLATE_DEGREE}, .stride = PLATE_SIDE, .sign = 1.0}};
    for (int k = 0; k < PLATE_NET; k++)
        control_point(shape, k / PLATE_SIDE, k % PLATE_SIDE, plate->net + 4 * k);
    for (int i = 0; i < PLATE_SIDE; i++)
        plate->extraction[i * PLATE_SIDE + i] = 1.0;
    struct element *element = &plate->element;
    element->net = plate->net;
    element->upper[0] = element->upper[1] = 1.0;
    element->extraction[0] = element->extraction[1] = plate->extraction;
    double square = 0.0;
    for (int c = 0; c < 3; c++) {
        element->box[0][c] = element->box[1][c] = plate->net[c];
        for (int k = 0; k < PLATE_NET; k++) {
            element->box[0][c] = fmin(element->box[0][c], plate->net[4 * k + c]);
            element->box[1][c] = fmax(element->box[1][c], plate->net[4 * k + c]);
        }
        square += pow(element->box[1][c] - element->box[0][c], 2.0);
    }
    plate->diagonal = sqrt(square);
    plate->mesh = (struct mesh){.n = 1, .degree = {PLATE_DEGREE, PLATE_DEGREE}};
}

struct place {
    long double x[3], ds[3], dt[3], area;
};

static void cubic(long double s, long double b[PLATE_SIDE], long double d[PLATE_SIDE])
{
    long double r = 1 - s;
    b[0] = r * r * r;
    b[1] = 3 * r * r * s;
    b[2] = 3 * r * s * s;
    b[3] = s * s * s;
    d[0] = -3 * r * r;
    d[1] = 3 * r * r - 6 * r * s;
    d[2] = 6 * r * s - 3 * s * s;
    d[3] = 3 * s * s;
}

static void evaluate(const struct plate *plate, long double s, long double t, struct place *place)
{
    long double bs[PLATE_SIDE], ds[PLATE_SIDE], bt[PLATE_SIDE], dt[PLATE_SIDE];
    cubic(s, bs, ds);
    cubic(t, bt, dt);
    *place = (struct place){.area = 0};
    for (int k = 0; k < PLATE_NET; k++)
        for (int c = 0; c < 3; c++) {
            long double h = plate->net[4 * k + c];
            place->x[c] += bs[k / PLATE_SIDE] * bt[k % PLATE_SIDE] * h;
            place->ds[c] += ds[k / PLATE_SIDE] * bt[k % PLATE_SIDE] * h;
            place->dt[c] += bs[k / PLATE_SIDE] * dt[k % PLATE_SIDE] * h;
        }
    const long double *a = place->ds, *b = place->dt;
    long double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                        a[0] * b[1] - a[1] * b[0]};
    place->area = sqrtl(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

static long double polynomial(long double s, long double t)
{
    long double bs[PLATE_SIDE], ds[PLATE_SIDE], bt[PLATE_SIDE], dt[PLATE_SIDE];
    cubic(s, bs, ds);
    cubic(t, bt, dt);
    return bs[CHOSEN_S] * bt[CHOSEN_T];
}

double reference_polynomial(double s, double t)
{
    return (double)polynomial(s, t);
}

/* Adds weight (P - Q)/(4 pi r^3) dS/(ds dt) to both moments. */
static void add_kernel(const struct plate *plate, const long double p[3], long double s,
                       long double t, long double weight, long double v[FIELDS])
{
    struct place q;
    evaluate(plate, s, t, &q);
    long double d[3] = {p[0] - q.x[0], p[1] - q.x[1], p[2] - q.x[2]};
    long double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    long double strength = weight * q.area / (4 * pi * r2 * sqrtl(r2)), b = polynomial(s, t);
    for (int c = 0; c < 3; c++) {
        v[c] += strength * d[c];
        v[3 + c] += b * strength * d[c];
    }
}

static void gauss_rule(double node[POINTS], double weight[POINTS])
{
    if (nurbs_gauss_legendre(POINTS, node, weight) != NURBS_OK)
        abort();
}

static long double gap(const long double a[3], const long double b[3])
{
    return hypotl(hypotl(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* Cells are halved the longer way until the point is three half diagonals away. */
static void divide(const struct plate *plate, const long double p[3], const long double rect[4],
                   const double *node, const double *weight, long double v[FIELDS])
{
    struct place centre, end[4];
    long double s = (rect[0] + rect[1]) / 2, t = (rect[2] + rect[3]) / 2;
    evaluate(plate, s, t, &centre);
    long double size[2] = {0, 0};
    for (int k = 0; k < 4; k++) {
        evaluate(plate, k < 2 ? rect[k] : s, k < 2 ? t : rect[k], &end[k]);
        size[k / 2] += gap(end[k].x, centre.x);
    }
    /* lengths along the edges too: those of a triangle differ */
    struct place corner[4];
    for (int k = 0; k < 4; k++)
        evaluate(plate, rect[k / 2], rect[2 + k % 2], &corner[k]);
    size[0] = fmaxl(size[0], fmaxl(gap(corner[0].x, corner[2].x), gap(corner[1].x, corner[3].x)));
    size[1] = fmaxl(size[1], fmaxl(gap(corner[0].x, corner[1].x), gap(corner[2].x, corner[3].x)));
    if (gap(centre.x, p) < 1.5L * hypotl(size[0], size[1]) || rect[1] - rect[0] > 0.25L ||
        rect[3] - rect[2] > 0.25L) {
        int d = rect[1] - rect[0] > 0.25L ? 0 : rect[3] - rect[2] > 0.25L ? 1 : size[1] > size[0];
        long double half[4] = {rect[0], rect[1], rect[2], rect[3]}, middle = d ? t : s;
        half[2 * d + 1] = middle;
        divide(plate, p, half, node, weight, v);
        half[2 * d] = middle;
        half[2 * d + 1] = rect[2 * d + 1];
        divide(plate, p, half, node, weight, v);
        return;
    }
    for (int k = 0; k < POINTS * POINTS; k++) {
        int i = k / POINTS, j = k % POINTS;
        add_kernel(plate, p, rect[0] + (rect[1] - rect[0]) * node[i],
                   rect[2] + (rect[3] - rect[2]) * node[j],
                   (rect[1] - rect[0]) * (rect[3] - rect[2]) * weight[i] * weight[j], v);
    }
}

void reference_near(const struct plate *plate, const double point[3], double v[FIELDS])
{
    double node[POINTS], weight[POINTS];
    const long double whole[4] = {0, 1, 0, 1}, p[3] = {point[0], point[1], point[2]};
    long double sum[FIELDS] = {0};
    gauss_rule(node, weight);
    divide(plate, p, whole, node, weight, sum);
    for (int k = 0; k < FIELDS; k++)
        v[k] = (double)sum[k];
}

/* The ray from (s, t) towards the edge point at tau:
 *     Int_0^1 (F - g/lambda) dlambda + g ln A,
 * lambda graded towards the far end, where a curved element may come close again. */
struct ray {
    const struct plate *plate;
    struct place at;
    long double s, t, corner[2], edge[2];
    const double *node, *weight;
};

static void ray_integral(const struct ray *ray, long double tau, long double v[FIELDS])
{
    static const long double stop[4] = {0, 0.25L, 0.6L, 1};
    long double a = ray->corner[0] + tau * ray->edge[0], b = ray->corner[1] + tau * ray->edge[1];
    long double twice = fabsl(ray->corner[0] * ray->edge[1] - ray->corner[1] * ray->edge[0]);
    long double g[FIELDS], image[3], square = 0;
    for (int c = 0; c < 3; c++) {
        image[c] = a * ray->at.ds[c] + b * ray->at.dt[c];
        square += image[c] * image[c];
    }
    for (int c = 0; c < FIELDS; c++)
        g[c] = -twice * ray->at.area * image[c % 3] / (4 * pi * square * sqrtl(square)) *
               (c < 3 ? 1 : polynomial(ray->s, ray->t));
    for (int c = 0; c < FIELDS; c++)
        v[c] = g[c] * logl(square) / 2;
    for (int k = 0; k < 3 * POINTS; k++) {
        long double step = stop[k / POINTS + 1] - stop[k / POINTS];
        long double lambda = stop[k / POINTS] + step * ray->node[k % POINTS];
        long double w = step * ray->weight[k % POINTS];
        add_kernel(ray->plate, ray->at.x, ray->s + lambda * a, ray->t + lambda * b,
                   w * lambda * twice, v);
        for (int c = 0; c < FIELDS; c++)
            v[c] -= w * g[c] / lambda;
    }
}

static void edge_rule(const struct ray *ray, long double from, long double to,
                      long double v[FIELDS])
{
    for (int c = 0; c < FIELDS; c++)
        v[c] = 0;
    for (int i = 0; i < POINTS; i++) {
        long double f[FIELDS];
        ray_integral(ray, from + (to - from) * ray->node[i], f);
        for (int c = 0; c < FIELDS; c++)
            v[c] += (to - from) * ray->weight[i] * f[c];
    }
}

/* Halves the edge until halves and whole agree. */
static void edge_integral(const struct ray *ray, long double from, long double to,
                          const long double whole[FIELDS], int depth, long double v[FIELDS])
{
    long double middle = (from + to) / 2, half[2][FIELDS], error = 0;
    edge_rule(ray, from, middle, half[0]);
    edge_rule(ray, middle, to, half[1]);
    for (int c = 0; c < FIELDS; c++)
        error = fmaxl(error, fabsl(half[0][c] + half[1][c] - whole[c]));
    if (error < 1e-13L || depth == BISECTIONS) {
        for (int c = 0; c < FIELDS; c++)
            v[c] += half[0][c] + half[1][c];
        return;
    }
    edge_integral(ray, from, middle, half[0], depth + 1, v);
    edge_integral(ray, middle, to, half[1], depth + 1, v);
}

void reference_singular(const struct plate *plate, double s, double t, double v[FIELDS])
{
    double node[POINTS], weight[POINTS];
    gauss_rule(node, weight);
    const double corner[5][2] = {
        {-s, -t}, {1.0 - s, -t}, {1.0 - s, 1.0 - t}, {-s, 1.0 - t}, {-s, -t}};
    struct ray ray = {.plate = plate, .s = s, .t = t, .node = node, .weight = weight};
    evaluate(plate, s, t, &ray.at);
    long double sum[FIELDS] = {0}, whole[FIELDS];
    for (int k = 0; k < 4; k++) {
        for (int d = 0; d < 2; d++) {
            ray.corner[d] = corner[k][d];
            ray.edge[d] = (long double)corner[k + 1][d] - corner[k][d];
        }
        if (ray.corner[0] * ray.edge[1] - ray.corner[1] * ray.edge[0] == 0)
            continue;
        edge_rule(&ray, 0, 1, whole);
        edge_integral(&ray, 0, 1, whole, 0, sum);
    }
    for (int c = 0; c < FIELDS; c++)
        v[c] = (double)sum[c];
}

double node_polynomial(const struct nodes *nodes, size_t i)
{
    return nodes->bu[PLATE_SIDE * i + CHOSEN_S] * nodes->bv[PLATE_SIDE * i + CHOSEN_T];
}

void nodes_velocity(const struct nodes *nodes, const double p[3], double v[FIELDS])
{
    for (size_t i = 0; i < nodes->n; i++) {
        double d[3] = {p[0] - nodes->x[i], p[1] - nodes->y[i], p[2] - nodes->z[i]};
        double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        double strength = nodes->g[i] / (4.0 * (double)pi * r2 * sqrt(r2));
        double b = node_polynomial(nodes, i);
        for (int c = 0; c < 3; c++) {
            v[c] += strength * d[c];
            v[3 + c] += b * strength * d[c];
        }
    }
}

double moments_difference(const double a[FIELDS], const double b[FIELDS])
{
    double largest = 0.0;
    for (int k = 0; k < FIELDS; k++)
        largest = fmax(largest, fabs(a[k] - b[k]));
    return largest;
}

void rectangle_velocity(const double p[3], double x0, double x1, double y0, double y1, double v[3])
{
    const double xs[2] = {x0 - p[0], x1 - p[0]}, ys[2] = {y0 - p[1], y1 - p[1]};
    v[0] = v[1] = v[2] = 0.0;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            double sign = i == j ? 1.0 : -1.0, x = xs[i], y = ys[j];
            double r = sqrt(x * x + y * y + p[2] * p[2]);
            /* ln(y + r) without cancellation; the other part is the same at both ends of y */
            double ly = y > 0 ? log(y + r) : log((x * x + p[2] * p[2]) / (r - y));
            double lx = x > 0 ? log(x + r) : log((y * y + p[2] * p[2]) / (r - x));
            v[0] += sign * ly / (4.0 * (double)pi);
            v[1] += sign * lx / (4.0 * (double)pi);
            if (p[2] != 0.0)
                v[2] += sign * atan(x * y / (p[2] * r)) / (4.0 * (double)pi);
        }
}
