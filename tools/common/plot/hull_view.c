/* Hulls in perspective of an eye far away, painted from behind to the front. */
#include "cli.h"
#include "plot/ship.h"

#include <math.h>
#include <stdlib.h>

struct camera {
    double right[3], up[3], toward[3];
    double left, top, scale; /* sheet = (projection - left) * scale */
};

struct face {
    double xy[4][2], depth;
    unsigned char colour[3];
};

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static struct camera aim(double left, double top, double width, double height,
                         const struct plot_view *view)
{
    /* The eye in radians: ahead of abeam to port, and above the horizon. */
    static const double a = 0.66, e = 0.16;
    struct camera c = {{-cos(a), sin(a), 0}, /* forward points to the left */
                       {-sin(a) * sin(e), -cos(a) * sin(e), cos(e)},
                       {sin(a) * cos(e), cos(a) * cos(e), sin(e)},
                       0,
                       0,
                       0};
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t k = 0; k < 2 * view->rows * view->columns; k++) {
        const double *p = view->points + 3 * (k / 2);
        const double q[3] = {p[0], k % 2 ? p[1] : -p[1], p[2]};
        const double at[2] = {dot(q, c.right), -dot(q, c.up)};
        for (int d = 0; d < 2; d++) {
            low[d] = fmin(low[d], at[d]);
            high[d] = fmax(high[d], at[d]);
        }
    }
    c.scale = fmin(width / (high[0] - low[0]), height / (high[1] - low[1]));
    c.left = (low[0] + high[0]) / 2 - (left + width / 2) / c.scale;
    c.top = (low[1] + high[1]) / 2 - (top + height / 2) / c.scale;
    return c;
}

static void project(const struct camera *c, const double *q, double xy[2])
{
    xy[0] = c->scale * (dot(q, c->right) - c->left);
    xy[1] = c->scale * (-dot(q, c->up) - c->top);
}

/* Matte shading by two lights. */
static void shade(const struct plot_view *view, double value, const double normal[3], double side,
                  unsigned char colour[3])
{
    static const double key[3] = {0.45, 0.62, 0.64}, fill[3] = {0.75, 0.5, -0.43};
    unsigned char base[3] = {196, 205, 214};
    const struct plot_axis *axis = &view->scale.axis;
    if (view->values && side > 0)
        plot_colour(view->scale.map, (value - axis->low) / (axis->high - axis->low), base);
    double light = 0.62 + 0.34 * fmax(0, dot(normal, key)) + 0.14 * fmax(0, dot(normal, fill));
    if (side < 0)
        light = 0.72 + 0.1 * fabs(normal[1]);
    for (int k = 0; k < 3; k++)
        colour[k] = (unsigned char)fmin(255, base[k] * light);
}

static void make_face(const struct camera *camera, const struct plot_view *view, size_t i, size_t j,
                      double side, size_t step, struct face *face)
{
    size_t ni = i + step < view->rows ? i + step : view->rows - 1;
    size_t nj = j + step < view->columns ? j + step : view->columns - 1;
    const size_t index[4] = {i * view->columns + j, ni * view->columns + j, ni * view->columns + nj,
                             i * view->columns + nj};
    double q[4][3], value = 0, a[3], b[3];
    face->depth = 0;
    for (int k = 0; k < 4; k++) {
        const double *p = view->points + 3 * index[k];
        q[k][0] = p[0];
        q[k][1] = side * p[1];
        q[k][2] = p[2];
        project(camera, q[k], face->xy[k]);
        face->depth += dot(q[k], camera->toward);
        value += view->values ? view->values[index[k]] / 4 : 0;
    }
    for (int k = 0; k < 3; k++) {
        a[k] = q[2][k] - q[0][k];
        b[k] = q[3][k] - q[1][k];
    }
    double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    /* Outwards: away from the centre plane, whatever way the grid runs. */
    double length = sqrt(dot(n, n)), sign = n[1] * side < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++)
        n[k] = length > 0 ? sign * n[k] / length : 0;
    shade(view, value, n, side, face->colour);
}

static int nearer(const void *a, const void *b)
{
    double x = ((const struct face *)a)->depth, y = ((const struct face *)b)->depth;
    return (x > y) - (x < y);
}

/* One side in order of depth; the far one coarser, it is only background. */
static void paint_side(struct plot *plot, const struct camera *camera, const struct plot_view *view,
                       double side, size_t step, struct face *faces)
{
    size_t n = 0;
    for (size_t i = 0; i + 1 < view->rows; i += step)
        for (size_t j = 0; j + 1 < view->columns; j += step)
            make_face(camera, view, i, j, side, step, &faces[n++]);
    qsort(faces, n, sizeof *faces, nearer);
    fputs("<g stroke-width=\"0.4\" stroke-linejoin=\"round\">\n", plot->out);
    for (size_t i = 0; i < n; i++) {
        const unsigned char *c = faces[i].colour;
        for (int k = 0; k < 4; k++)
            fprintf(plot->out, "%s%.1f %.1f", k ? "L" : "<path d=\"M", faces[i].xy[k][0],
                    faces[i].xy[k][1]);
        fprintf(plot->out, "z\" fill=\"#%02x%02x%02x\" stroke=\"#%02x%02x%02x\"/>\n", c[0], c[1],
                c[2], c[0], c[1], c[2]);
    }
    fputs("</g>\n", plot->out);
}

static void paint_waterline(struct plot *plot, const struct camera *c, const struct plot_view *view)
{
    bool drawing = false;
    plot_path(plot, (struct plot_pen){"white", 1.2, NULL}, NULL);
    for (size_t i = 0; i < view->rows; i++)
        for (size_t j = 0; j + 1 < view->columns; j++) {
            const double *a = view->points + 3 * (i * view->columns + j), *b = a + 3;
            double share = a[2] / (a[2] - b[2]), q[3], xy[2];
            if ((a[2] > 0) == (b[2] > 0))
                continue;
            for (int k = 0; k < 3; k++)
                q[k] = a[k] + share * (b[k] - a[k]);
            project(c, q, xy);
            fprintf(plot->out, "%c%.1f %.1f", drawing ? 'L' : 'M', xy[0], xy[1]);
            drawing = true;
            break;
        }
    plot_path_end(plot);
}

void plot_hull_view(struct plot *plot, double left, double top, double width, double height,
                    const struct plot_view *view)
{
    double bar = view->values ? 84 : 0;
    struct camera camera = aim(left, top, width - bar, height, view);
    struct face *faces = cli_needed(malloc(view->rows * view->columns * sizeof *faces));
    paint_side(plot, &camera, view, -1, 2, faces);
    paint_side(plot, &camera, view, 1, 1, faces);
    paint_waterline(plot, &camera, view);
    if (view->values)
        plot_bar(plot, left + width - 70, top + 6, 14, height - 12, &view->scale);
    free(faces);
}

void plot_mode_view(struct plot *plot, double left, double top, double width, double height,
                    const struct plot_mode *mode)
{
    size_t n = mode->rows * mode->columns;
    double *size = cli_needed(malloc(n * sizeof *size)), most = 0, spread = sqrt(mode->eigenvalue);
    for (size_t k = 0; k < n; k++) {
        size[k] = spread * sqrt(dot(mode->vector + 3 * k, mode->vector + 3 * k));
        most = fmax(most, size[k]);
    }
    struct plot_view view = {mode->rows,
                             mode->columns,
                             mode->points,
                             size,
                             {PLOT_SEQUENTIAL, {.high = most, .unit = 1000, .label = "rms, mm"}}};
    plot_settle(&view.scale.axis);
    plot_text(plot, left, top + 14, 13, PLOT_START, PLOT_INK, "Mode %zu: %.1f %% of the variance",
              mode->number, 100 * mode->eigenvalue / mode->trace);
    plot_hull_view(plot, left, top + 24, width, height - 24, &view);
    free(size);
}
