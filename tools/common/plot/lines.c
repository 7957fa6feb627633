#include "cli.h"
#include "plot/ship.h"

#include <math.h>
#include <stdlib.h>

/* How model axes go onto the sheet: sheet position of the model's zero, units per metre. */
struct view {
    int across, up;
    double left, base, scale;
};

struct plan {
    struct plot *plot;
    const struct plot_lines *lines;
    size_t n;
    const struct plot_hull *hulls;
    double low[3], high[3]; /* of the bodies */
    double base, waterline_step, buttock_step;
};

static const struct plot_pen grid_pen = {"#d5dbe1", 0.6, NULL}, level_pen = {PLOT_BLUE, 1.1, NULL},
                             base_pen = {PLOT_MUTED, 1, "8 3 2 3"};

static bool refuse(nurbs_status status)
{
    if (status == NURBS_ERROR_MEMORY)
        cli_needed(NULL);
    return cli_refuse("%s", nurbs_last_error());
}

static void fill_parameters(const nurbs_surface *surface, int d, size_t n, double *out)
{
    const double *knots = nurbs_surface_knots(surface, d);
    double first = knots[nurbs_surface_degree(surface, d)];
    double last = knots[nurbs_surface_size(surface, d)];
    for (size_t k = 0; k < n; k++)
        out[k] = k + 1 == n ? last : first + (last - first) * (double)k / (double)(n - 1);
}

/* The box of the bodies, by points on them. */
static bool measure(struct plan *plan)
{
    enum { U = 201, V = 101 };
    double u[U], v[V], *p = cli_needed(malloc(sizeof(double) * 3 * U * V));
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < 3; k++) {
        plan->low[k] = INFINITY;
        plan->high[k] = -INFINITY;
    }
    for (size_t h = 0; h < plan->n && !status; h++)
        for (size_t s = 0; s < plan->hulls[h].n && !status; s++) {
            fill_parameters(plan->hulls[h].surfaces[s], 0, U, u);
            fill_parameters(plan->hulls[h].surfaces[s], 1, V, v);
            status = nurbs_surface_eval_grid(plan->hulls[h].surfaces[s], 0, U, u, V, v, p);
            for (size_t i = 0; i < 3 * U * V && !status; i++) {
                plan->low[i % 3] = fmin(plan->low[i % 3], p[i]);
                plan->high[i % 3] = fmax(plan->high[i % 3], p[i]);
            }
        }
    free(p);
    return !status || refuse(status);
}

/* Goes through the points where coordinate `axis` of the hull is `value`; first: of a line. */
static bool each_point(const struct plot_hull *hull, int axis, double value,
                       void (*take)(void *user_data, const double *point, bool first),
                       void *user_data)
{
    for (size_t s = 0; s < hull->n; s++) {
        double normal[3] = {axis == 0, axis == 1, axis == 2};
        nurbs_contour contour;
        nurbs_status status = nurbs_surface_contour(hull->surfaces[s], normal, value, 0, &contour);
        if (status)
            return refuse(status);
        for (size_t l = 0; l < contour.lines; l++)
            for (size_t i = contour.first[l]; i < contour.first[l + 1]; i++)
                take(user_data, contour.points + 3 * i, i == contour.first[l]);
        nurbs_contour_free(&contour);
    }
    return true;
}

struct range {
    int axis;
    double low, high;
};

static void take_range(void *user_data, const double *point, bool first)
{
    struct range *range = user_data;
    (void)first;
    range->low = fmin(range->low, point[range->axis]);
    range->high = fmax(range->high, point[range->axis]);
}

/* A line on its way onto the sheet. */
struct stroke {
    struct plot *plot;
    const struct view *view;
    double side, tip[2]; /* the highest point */
    bool any;
};

static void take_stroke(void *user_data, const double *point, bool first)
{
    struct stroke *s = user_data;
    double x = s->view->left + s->side * s->view->scale * point[s->view->across];
    double y = s->view->base - s->view->scale * point[s->view->up];
    fprintf(s->plot->out, "%c%.2f %.2f", first ? 'M' : 'L', x, y);
    if (!s->any || y < s->tip[1]) {
        s->tip[0] = x;
        s->tip[1] = y;
    }
    s->any = true;
}

static bool put_section(const struct plan *plan, const struct view *view, size_t hull, int axis,
                        double value, double side, struct stroke *stroke)
{
    struct plot_pen pen = plan->hulls[hull].pen;
    if (axis == 2 && fabs(value - plan->lines->level) < 1e-9 * plan->high[0] && hull == 0)
        pen = level_pen;
    *stroke = (struct stroke){plan->plot, view, side, {0, 0}, false};
    plot_path(plan->plot, pen, NULL);
    bool good = each_point(&plan->hulls[hull], axis, value, take_stroke, stroke);
    plot_path_end(plan->plot);
    return good;
}

/* The four edges of every surface: stem, keel, deck and transom. */
static bool put_edges(const struct plan *plan, const struct view *view,
                      const struct plot_hull *hull)
{
    enum { SAMPLES = 400 };
    double t[SAMPLES + 1], points[3 * (SAMPLES + 1)];
    struct stroke stroke = {plan->plot, view, 1, {0, 0}, false};
    struct plot_pen pen = hull->pen;
    pen.width *= 1.7;
    for (size_t e = 0; e < 4 * hull->n; e++) {
        const nurbs_surface *surface = hull->surfaces[e / 4];
        int d = e / 2 % 2; /* constant direction */
        const double *fixed = nurbs_surface_knots(surface, d);
        double value = e % 2 ? fixed[nurbs_surface_size(surface, d)] : fixed[0];
        fill_parameters(surface, !d, SAMPLES + 1, t);
        nurbs_status status =
            d == 0 ? nurbs_surface_eval_grid(surface, 0, 1, &value, SAMPLES + 1, t, points)
                   : nurbs_surface_eval_grid(surface, 0, SAMPLES + 1, t, 1, &value, points);
        if (status)
            return refuse(status);
        plot_path(plan->plot, pen, NULL);
        for (size_t i = 0; i <= SAMPLES; i++)
            take_stroke(&stroke, points + 3 * i, i == 0);
        plot_path_end(plan->plot);
    }
    return true;
}

static void put_ruler(const struct plan *plan, const struct view *view, bool upright, double value,
                      double from, double to, struct plot_pen pen)
{
    double a = upright ? view->left + view->scale * value : view->base - view->scale * value;
    double s = view->scale;
    if (upright)
        plot_line(plan->plot, a, view->base - s * from, a, view->base - s * to, pen);
    else
        plot_line(plan->plot, view->left + s * from, a, view->left + s * to, a, pen);
}

/* Heights of the waterlines (axis 2), from the base line, or distances of the buttocks: the k-th
 * value, false behind the last. */
static bool spaced(const struct plan *plan, int axis, int k, double *value)
{
    double step = axis == 2 ? plan->waterline_step : plan->buttock_step;
    double start = axis == 2 ? plan->base : 0;
    double first = axis == 2 ? ceil((plan->low[2] - start) / step + 1e-6) : 1;
    *value = start + step * (first + k);
    return *value < plan->high[axis] - 1e-6 * step;
}

/* Waterlines as they are seen edge on, from `from` to `to`, with their heights above base. */
static void put_heights(const struct plan *plan, const struct view *view, double from, double to)
{
    double z;
    for (int k = 0; spaced(plan, 2, k, &z); k++) {
        put_ruler(plan, view, false, z, from, to, grid_pen);
        plot_label(plan->plot, view->left + view->scale * to + 6,
                   view->base - view->scale * z + 3.5, 12, PLOT_START, PLOT_MUTED, "%.3g",
                   fabs(z - plan->base) < 1e-9 ? 0 : z - plan->base);
    }
    put_ruler(plan, view, false, plan->base, from, to, base_pen);
    put_ruler(plan, view, false, plan->lines->level, from, to, level_pen);
}

static double station(const struct plan *plan, size_t k)
{
    return plan->lines->perpendicular[0] +
           (plan->lines->perpendicular[1] - plan->lines->perpendicular[0]) * (double)k /
               (double)plan->lines->stations;
}

/* A plane through an edge, a transom at the aft perpendicular, gives no line: just inside. */
static double inner_station(const struct plan *plan, size_t k)
{
    static const double inside = 1e-6;
    const double *x = plan->lines->perpendicular;
    double shift = k == 0 ? inside : k == plan->lines->stations ? -inside : 0;
    return station(plan, k) + shift * (x[1] - x[0]);
}

static void put_station_lines(const struct plan *plan, const struct view *view, bool numbered)
{
    double low = view->up == 2 ? plan->low[2] : 0, high = plan->high[view->up];
    for (size_t k = 0; k <= plan->lines->stations; k++) {
        double x = view->left + view->scale * station(plan, k);
        put_ruler(plan, view, true, station(plan, k), low, high, grid_pen);
        if (numbered)
            plot_label(plan->plot, x, view->base - view->scale * low + 15, 12, PLOT_MIDDLE,
                       PLOT_MUTED, "%zu", k);
    }
    if (!numbered)
        return;
    double y = view->base - view->scale * low + 28;
    plot_text(plan->plot, view->left + view->scale * plan->lines->perpendicular[0], y, 12,
              PLOT_MIDDLE, PLOT_INK, "AP");
    plot_text(plan->plot, view->left + view->scale * plan->lines->perpendicular[1], y, 12,
              PLOT_MIDDLE, PLOT_INK, "FP");
}

/* The number of a station at the tip of its section, lifted with a thin line where others stand. */
static void put_number(const struct plan *plan, const struct stroke *stroke, size_t number)
{
    for (int lift = 0; lift < 6; lift++) {
        double y = stroke->tip[1] - 5 - 12 * lift, x = stroke->tip[0] + 2 * lift * stroke->side;
        if (!plot_label(plan->plot, x, y, 12, PLOT_MIDDLE, PLOT_INK, "%zu", number))
            continue;
        if (lift)
            plot_line(plan->plot, stroke->tip[0], stroke->tip[1] - 1, x, y + 2,
                      (struct plot_pen){PLOT_MUTED, 0.5, "1 2"});
        return;
    }
}

/* Aft sections to the left, fore sections to the right, midship on both sides. */
static bool put_body_plan(const struct plan *plan, const struct view *view)
{
    size_t stations = plan->lines->stations;
    double breadth = plan->high[1], y;
    struct stroke stroke;
    put_heights(plan, view, -breadth, breadth);
    for (int k = -1; k < 0 || spaced(plan, 1, k, &y); k++)
        for (int side = -1; side <= 1; side += 2)
            put_ruler(plan, view, true, k < 0 ? 0 : side * y, plan->low[2], plan->high[2],
                      k < 0 ? base_pen : grid_pen);
    for (size_t h = 0; h < plan->n; h++)
        /* From the ends towards midship, where numbers are crowded and give way. */
        for (size_t k = 0; k <= 2 * stations + 1; k++) {
            size_t half = k / 2, number = k % 2 ? stations - half : half;
            double side = k % 2 ? 1 : -1;
            if ((k % 2 ? 2 * number < stations : 2 * number > stations))
                continue;
            if (!put_section(plan, view, h, 0, inner_station(plan, number), side, &stroke))
                return false;
            if (h == 0 && stroke.any)
                put_number(plan, &stroke, number);
        }
    return true;
}

static bool put_profile(const struct plan *plan, const struct view *view)
{
    struct stroke stroke;
    double y;
    put_heights(plan, view, plan->low[0], plan->high[0]);
    put_station_lines(plan, view, true);
    for (size_t h = 0; h < plan->n; h++) {
        for (int k = 0; spaced(plan, 1, k, &y); k++)
            if (!put_section(plan, view, h, 1, y, 1, &stroke))
                return false;
        if (!put_edges(plan, view, &plan->hulls[h]))
            return false;
    }
    return true;
}

static bool put_half_breadth(const struct plan *plan, const struct view *view)
{
    struct stroke stroke;
    double value;
    put_station_lines(plan, view, false);
    for (int k = 0; spaced(plan, 1, k, &value); k++) {
        put_ruler(plan, view, false, value, plan->low[0], plan->high[0], grid_pen);
        plot_label(plan->plot, view->left + view->scale * plan->high[0] + 6,
                   view->base - view->scale * value + 3.5, 12, PLOT_START, PLOT_MUTED, "%.3g",
                   value);
    }
    put_ruler(plan, view, false, 0, plan->low[0], plan->high[0], base_pen);
    for (size_t h = 0; h < plan->n; h++) {
        for (int k = 0; spaced(plan, 2, k, &value); k++)
            if (!put_section(plan, view, h, 2, value, 1, &stroke))
                return false;
        if (!put_section(plan, view, h, 2, plan->lines->level, 1, &stroke) ||
            !put_edges(plan, view, &plan->hulls[h]))
            return false;
    }
    return true;
}

void plot_scale_bar(struct plot *plot, double right, double y, double scale, double room)
{
    double step = plot_tick_step(room / scale, 5, false), unit = step * scale;
    double x = right - 4 * unit;
    for (int k = 0; k <= 4; k++) {
        if (k < 4)
            fprintf(plot->out,
                    "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"5\" fill=\"%s\" "
                    "stroke=\"%s\" stroke-width=\"0.7\"/>\n",
                    x + k * unit, y, unit, k % 2 ? "white" : PLOT_INK, PLOT_INK);
        if (k % 2 == 0)
            plot_label(plot, x + k * unit, y + 17, 12, PLOT_MIDDLE, PLOT_INK,
                       k < 4 ? "%.3g" : "%.3g m", k * step);
    }
}

/* What the drawing shows, in words and metres. */
static void put_legend(const struct plan *plan, double x, double y)
{
    const struct plot_lines *l = plan->lines;
    double length = plan->lines->perpendicular[1] - plan->lines->perpendicular[0];
    for (size_t h = 0; h < plan->n; h++)
        if (plan->hulls[h].name) {
            struct plot_legend entry = {plan->hulls[h].name, plan->hulls[h].pen, PLOT_LINE};
            plot_legend(plan->plot, x, y, true, 1, &entry);
            y += 19;
        }
    const struct plot_legend water = {"still water", level_pen, PLOT_LINE},
                             base = {"base line", base_pen, PLOT_LINE};
    plot_legend(plan->plot, x, y, true, 1, &water);
    plot_legend(plan->plot, x, y + 19, true, 1, &base);
    y += 46;
    plot_text(plan->plot, x, y, 12, PLOT_START, PLOT_INK, "Length between perpendiculars %.4g m",
              length);
    y += 19;
    plot_text(plan->plot, x, y, 12, PLOT_START, PLOT_INK, "Greatest breadth %.4g m",
              2 * plan->high[1]);
    if (l->level > plan->low[2] && l->level <= plan->high[2]) {
        y += 19;
        plot_text(plan->plot, x, y, 12, PLOT_START, PLOT_INK, "Draught %.4g m to the base line,",
                  l->level - plan->base);
        y += 19;
        plot_text(plan->plot, x, y, 12, PLOT_START, PLOT_INK, "%.4g m to the lowest point",
                  l->level - plan->low[2]);
    }
    plot_text(plan->plot, x, y + 38, 12, PLOT_START, PLOT_INK, "Stations 0–%zu, %.4g m apart",
              l->stations, length / (double)l->stations);
    plot_text(plan->plot, x, y + 57, 12, PLOT_START, PLOT_INK,
              "Waterlines %.3g m apart, heights above base", plan->waterline_step);
    plot_text(plan->plot, x, y + 76, 12, PLOT_START, PLOT_INK, "Buttocks %.3g m apart",
              plan->buttock_step);
}

static bool put_views(struct plan *plan, double width)
{
    enum { MARGIN = 30, RIGHT = 44, TITLE = 34, GAP = 34 };
    double length = plan->high[0] - plan->low[0], height = plan->high[2] - plan->low[2];
    double breadth = plan->high[1];
    double s = fmin((width - MARGIN - RIGHT) / length, fmin(360 / height, 260 / breadth));
    double large = fmax(s, fmin(0.3 * width / breadth, 480 / height)),
           left = MARGIN - s * plan->low[0];
    double second = TITLE + s * height + GAP, third = second + GAP + s * breadth + 44;
    struct view profile = {0, 2, left, TITLE + s * plan->high[2], s};
    struct view half = {0, 1, left, second + TITLE + s * breadth, s};
    struct view body = {1, 2, MARGIN + large * breadth, third + TITLE + 20 + large * plan->high[2],
                        large};
    if (!plot_open(plan->plot, width, third + TITLE + large * height + 60, "Lines plan"))
        return false;
    plot_text(plan->plot, MARGIN, TITLE - 14, 13, PLOT_START, PLOT_INK, "Profile and buttocks");
    plot_text(plan->plot, MARGIN, second + TITLE - 10, 13, PLOT_START, PLOT_INK,
              "Half-breadth plan and waterlines");
    plot_text(plan->plot, MARGIN, third + 12, 13, PLOT_START, PLOT_INK,
              "Body plan: aft body left, fore body right");
    plot_scale_bar(plan->plot, left + s * plan->high[0], half.base + 12, s, 250);
    plot_scale_bar(plan->plot, body.left + large * breadth, body.base - large * plan->low[2] + 12,
                   large, 250);
    put_legend(plan, body.left + large * breadth + 70, third + 50);
    return put_profile(plan, &profile) && put_half_breadth(plan, &half) &&
           put_body_plan(plan, &body);
}

bool plot_lines_plan(struct plot *plot, double width, const struct plot_lines *lines, size_t n,
                     const struct plot_hull *hulls)
{
    struct plan plan = {.plot = plot, .lines = lines, .n = n, .hulls = hulls};
    struct range midship = {2, INFINITY, -INFINITY};
    if (!measure(&plan))
        return false;
    if (!(plan.high[0] > plan.low[0]) || !(plan.high[1] > 0) || !(plan.high[2] > plan.low[2]))
        return cli_refuse("the body has no extent to draw");
    const double *x = lines->perpendicular;
    if (!each_point(hulls, 0, (x[0] + x[1]) / 2, take_range, &midship))
        return false;
    plan.base = midship.low < midship.high ? midship.low : plan.low[2];
    plan.waterline_step = plot_tick_step(plan.high[2] - plan.low[2], (int)lines->waterlines, false);
    plan.buttock_step = plot_tick_step(plan.high[1], (int)lines->buttocks, false);
    if (put_views(&plan, width))
        return true;
    plot_free(plot);
    return false;
}
