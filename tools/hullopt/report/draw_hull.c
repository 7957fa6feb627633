#include "report/drawings.h"
#include "report/svg.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 760, HEIGHT = 250, BAR_SPACE = 52 };

/* The eye: degrees ahead of abeam to port, and above the horizon. */
static const double AZIMUTH = 38, ELEVATION = 9;

struct camera {
    double right[3], up[3], toward[3];
    double left, top, scale; /* view units = (projection - left) * scale */
};

/* A quad ready to be painted: corners in tenths of view units, depth towards the eye. */
struct face {
    int corner[4][2];
    double depth;
    unsigned char colour[3];
};

static void aim(struct camera *c)
{
    double pi = acos(-1), a = AZIMUTH * pi / 180, e = ELEVATION * pi / 180;
    const double toward[3] = {sin(a) * cos(e), cos(a) * cos(e), sin(e)};
    /* Seen from port, forward points to the left of the picture. */
    const double right[3] = {-cos(a), sin(a), 0};
    const double up[3] = {-sin(a) * sin(e), -cos(a) * sin(e), cos(e)};
    for (int k = 0; k < 3; k++) {
        c->toward[k] = toward[k];
        c->right[k] = right[k];
        c->up[k] = up[k];
    }
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void fit(struct camera *c, const struct hull_view *view)
{
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    for (size_t k = 0; k < view->rows * view->columns; k++) {
        for (int side = -1; side <= 1; side += 2) {
            const double *p = view->points + 3 * k, q[3] = {p[0], side * p[1], p[2]};
            double x = dot(q, c->right), y = -dot(q, c->up);
            x0 = fmin(x0, x);
            x1 = fmax(x1, x);
            y0 = fmin(y0, y);
            y1 = fmax(y1, y);
        }
    }
    double room_x = WIDTH - BAR_SPACE - 90, room_y = HEIGHT - 48;
    c->scale = fmin(room_x / (x1 - x0), room_y / (y1 - y0));
    c->left = (x0 + x1) / 2 - (WIDTH - BAR_SPACE) / 2.0 / c->scale;
    c->top = (y0 + y1) / 2 - (HEIGHT + 20) / 2.0 / c->scale;
}

/* Matte shading by two lights; a value picks the colour, without values the hull is grey. */
static void shade(const struct hull_view *view, double value, const double normal[3], bool far_side,
                  unsigned char colour[3])
{
    static const double key[3] = {0.45, 0.62, 0.64}, fill[3] = {0.75, 0.5, -0.43};
    unsigned char base[3] = {196, 205, 214};
    if (view->values && !far_side) {
        double t = (value - view->low) / (view->high - view->low);
        (view->diverging ? svg_map_diverging : svg_map_sequential)(t, base);
    }
    double light = 0.62 + 0.34 * fmax(0, dot(normal, key)) + 0.14 * fmax(0, dot(normal, fill));
    if (far_side)
        light = 0.72 + 0.1 * fabs(normal[1]);
    for (int k = 0; k < 3; k++)
        colour[k] = (unsigned char)fmin(255, base[k] * light);
}

static void make_face(const struct camera *camera, const struct hull_view *view, size_t i, size_t j,
                      double side, size_t step, struct face *face)
{
    size_t ni = i + step < view->rows ? i + step : view->rows - 1;
    size_t nj = j + step < view->columns ? j + step : view->columns - 1;
    const size_t index[4] = {i * view->columns + j, ni * view->columns + j, ni * view->columns + nj,
                             i * view->columns + nj};
    double q[4][3], value = 0;
    face->depth = 0;
    for (int k = 0; k < 4; k++) {
        const double *p = view->points + 3 * index[k];
        q[k][0] = p[0];
        q[k][1] = side * p[1];
        q[k][2] = p[2];
        face->corner[k][0] =
            (int)lround(10 * camera->scale * (dot(q[k], camera->right) - camera->left));
        face->corner[k][1] =
            (int)lround(10 * camera->scale * (-dot(q[k], camera->up) - camera->top));
        face->depth += dot(q[k], camera->toward) / 4;
        if (view->values)
            value += view->values[index[k]] / 4;
    }
    double a[3], b[3], n[3];
    for (int k = 0; k < 3; k++) {
        a[k] = q[2][k] - q[0][k];
        b[k] = q[3][k] - q[1][k];
    }
    n[0] = a[1] * b[2] - a[2] * b[1];
    n[1] = a[2] * b[0] - a[0] * b[2];
    n[2] = a[0] * b[1] - a[1] * b[0];
    /* Outwards: away from the centre plane, whatever way the grid runs. */
    double length = sqrt(dot(n, n)), sign = n[1] * side < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++)
        n[k] = length > 0 ? sign * n[k] / length : 0;
    shade(view, value, n, side < 0, face->colour);
}

static int nearer(const void *a, const void *b)
{
    double x = ((const struct face *)a)->depth, y = ((const struct face *)b)->depth;
    return (x > y) - (x < y);
}

static void paint(FILE *out, const struct face *faces, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const struct face *f = &faces[i];
        fprintf(out, "<path d=\"M%d %d", f->corner[0][0], f->corner[0][1]);
        for (int k = 1; k < 4; k++)
            fprintf(out, "l%d %d", f->corner[k][0] - f->corner[k - 1][0],
                    f->corner[k][1] - f->corner[k - 1][1]);
        char colour[8];
        snprintf(colour, sizeof colour, "#%02x%02x%02x", f->colour[0], f->colour[1], f->colour[2]);
        fprintf(out, "z\" fill=\"%s\" stroke=\"%s\"/>", colour, colour);
        if (i % 4 == 3)
            fputc('\n', out);
    }
}

/* One side in order of depth; the far one coarser, it is only background. */
static void paint_side(FILE *out, const struct camera *camera, const struct hull_view *view,
                       double side, size_t step, struct face *faces)
{
    size_t n = 0;
    for (size_t i = 0; i + 1 < view->rows; i += step)
        for (size_t j = 0; j + 1 < view->columns; j += step)
            make_face(camera, view, i, j, side, step, &faces[n++]);
    qsort(faces, n, sizeof *faces, nearer);
    paint(out, faces, n);
}

static void paint_waterline(FILE *out, const struct camera *c, const struct hull_view *view)
{
    bool drawing = false;
    fputs("<path fill=\"none\" stroke=\"#fff\" stroke-width=\"12\" stroke-opacity=\"0.85\" d=\"",
          out);
    for (size_t i = 0; i < view->rows; i++) {
        const double *row = view->points + 3 * i * view->columns;
        for (size_t j = 0; j + 1 < view->columns; j++) {
            const double *a = row + 3 * j, *b = a + 3;
            if ((a[2] > 0) == (b[2] > 0))
                continue;
            double share = a[2] / (a[2] - b[2]), q[3];
            for (int k = 0; k < 3; k++)
                q[k] = a[k] + share * (b[k] - a[k]);
            fprintf(out, "%c%.0f %.0f", drawing ? 'L' : 'M',
                    10 * c->scale * (dot(q, c->right) - c->left),
                    10 * c->scale * (-dot(q, c->up) - c->top));
            drawing = true;
            break;
        }
    }
    fputs("\"/>\n", out);
}

void draw_hull(FILE *out, const struct hull_view *view)
{
    struct camera camera;
    struct face *faces = malloc(view->rows * view->columns * sizeof *faces);
    aim(&camera);
    fit(&camera, view);
    svg_open(out, WIDTH, HEIGHT, view->title);
    if (faces) {
        fputs("<g transform=\"scale(0.1)\" stroke-width=\"4\" stroke-linejoin=\"round\">\n", out);
        paint_side(out, &camera, view, -1, 2, faces);
        paint_side(out, &camera, view, 1, 1, faces);
        paint_waterline(out, &camera, view);
        fputs("</g>\n", out);
    }
    svg_text(out, 8, 20, 14, "start", SVG_INK, view->title);
    if (view->values) {
        svg_colour_bar(out, WIDTH - 52, 60, 14, HEIGHT - 110,
                       view->diverging ? svg_map_diverging : svg_map_sequential, view->low_label,
                       view->high_label, "");
        svg_text(out, WIDTH - 8, 20, 11, "end", SVG_MUTED, view->bar_title);
    }
    svg_close(out);
    free(faces);
}
