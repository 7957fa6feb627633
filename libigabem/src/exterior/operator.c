#include "exterior/operator.h"

#include "core/constants.h"
#include "core/error.h"
#include "exterior/spline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ALONG = SPLINE_STENCIL, DIFFERENCE = 7, ACROSS = 11 };

void operator_free(struct surface_operator *operator_)
{
    sparse_free(&operator_->value);
    sparse_free(&operator_->second);
    sparse_free(&operator_->odd);
}

static igabem_status no_memory(void)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the free-surface operator");
}

static const double sixth[DIFFERENCE] = {-1.0, 6.0, -15.0, 20.0, -15.0, 6.0, -1.0};

/* Products of the stencils across; the second derivative is the first taken twice, which vanishes
 * on the shortest wave: with the spline's own, lines that are oblique to the stream take the root
 * off the operator there, and nothing is stable. */
struct across {
    double value[ACROSS], first[ACROSS], second[ACROSS], value_sixth[ACROSS], first_sixth[ACROSS];
};

/* Product of a stencil and one of `width` places, both about their middle. */
static void convolve(const double a[ALONG], size_t width, const double *b, double out[ACROSS])
{
    memset(out, 0, ACROSS * sizeof *out);
    for (size_t i = 0; i < ALONG; i++)
        for (size_t j = 0; j < width; j++)
            out[i + j + (DIFFERENCE - width) / 2] += a[i] * b[j];
}

static void fill_across(struct across *across)
{
    static const double unit = 1.0;
    convolve(spline_along[0], 1, &unit, across->value);
    convolve(spline_along[1], 1, &unit, across->first);
    convolve(spline_along[1], ALONG, spline_along[1], across->second);
    convolve(spline_along[0], DIFFERENCE, sixth, across->value_sixth);
    convolve(spline_along[1], DIFFERENCE, sixth, across->first_sixth);
}

/* Where a cell lies. The lines of the grid turn at bow and stern. */
enum zone { AHEAD, BESIDE, AFT };

static enum zone zone_of(const struct free_surface *surface, long i)
{
    if (!surface->waterline.n || i < (long)surface->bow)
        return AHEAD;
    return i < (long)surface->stern ? BESIDE : AFT;
}

/* What factors of the unknowns are added to: a row, or a sum of factors times the unknowns. */
struct target {
    const struct free_surface *surface;
    double *row;
    const double *phi; /* NULL: the row */
    double sum;
    struct jumps *jumps; /* collect these instead; NULL: do not */
};

/* Factors J and K of a row at bow and stern, [2][ny], bow first. */
struct jumps {
    double slope, bend;
};

static void add_unknown(struct target *target, long column, double factor)
{
    if (target->phi)
        target->sum += factor * target->phi[column];
    else
        target->row[column] += factor;
}

/* Adds factor times the coefficient along the waterline of the spline through the hull's phi at the
 * middles of the cells, which are the columns after those of the unknowns. */
static void add_edge(struct target *target, long i, double factor)
{
    const struct free_surface *surface = target->surface;
    long bow = (long)surface->bow, stern = (long)surface->stern;
    long edge = (long)(surface->nx * surface->ny) - bow;
    if (i == bow || i == stern - 1) {
        add_unknown(target, edge + i, factor);
        return;
    }
    add_unknown(target, edge + i - 1, -0.125 * factor);
    add_unknown(target, edge + i, 1.25 * factor);
    add_unknown(target, edge + i + 1, -0.125 * factor);
}

/* Adds factor times the coefficient of cell (i, j), which may lie beyond the edges of the grid. */
static void add_coefficient(struct target *target, long i, long j, double factor)
{
    const struct free_surface *surface = target->surface;
    long ny = (long)surface->ny, at = (i - 1) * ny;
    enum zone zone = zone_of(surface, i);
    if (factor == 0.0 || target->jumps)
        return;
    if (i < 1) {
        /* Linear upstream. */
        add_coefficient(target, 1, j, (double)(2 - i) * factor);
        add_coefficient(target, 2, j, (double)(i - 1) * factor);
    } else if (j < 0 && zone == AFT && surface->transom > 0) {
        add_unknown(target, at, (double)(1 - j) * factor);
        add_unknown(target, at + 1, (double)j * factor);
    } else if (j < 0 && zone != BESIDE) {
        add_unknown(target, at - 1 - j, factor);
    } else if (j < 0) {
        /* Through the hull's phi at the edge: c_-1 = 2 e - c_0; beyond it a parabola. */
        double m = (double)(-1 - j), last_factor = factor * (1.0 + m + 0.5 * m * (m + 1.0));
        add_unknown(target, at, -(factor * m * (m + 2.0) + last_factor));
        add_unknown(target, at + 1, factor * 0.5 * m * (m + 1.0));
        add_edge(target, i, 2.0 * last_factor);
    } else if (j >= ny) {
        add_unknown(target, at + ny - 1, (double)(j - ny + 2) * factor);
        add_unknown(target, at + ny - 2, -(double)(j - ny + 1) * factor);
    } else {
        add_unknown(target, at + j, factor);
    }
}

/* Derivatives of y(x, eta) at the middle of the first (place 0), middle or last line of a cell,
 * from y at its half cells. */
struct slopes {
    double x, xx, xe, e, ee;
};

static struct slopes slopes_at(double dx, size_t place, const double y[3][3])
{
    static const double first[3][3] = {{-3.0, 4.0, -1.0}, {-1.0, 0.0, 1.0}, {1.0, -4.0, 3.0}};
    double yx[3] = {0.0, 0.0, 0.0};
    for (size_t a = 0; a < 3; a++)
        for (size_t b = 0; b < 3; b++)
            yx[b] -= first[place][a] * y[a][b] / dx;
    const double *at = y[place];
    return (struct slopes){.x = yx[1],
                           .xx = 4.0 * (y[2][1] - 2.0 * y[1][1] + y[0][1]) / (dx * dx),
                           .xe = yx[2] - yx[0],
                           .e = at[2] - at[0],
                           .ee = 4.0 * (at[2] - 2.0 * at[1] + at[0])};
}

/* Derivatives of eta(x, y) there, and the first two of y(eta). */
struct lines {
    double ex, exx, exe, ye, yee;
};

static struct slopes cell_slopes(const struct free_surface *surface, size_t i, size_t j,
                                 size_t place)
{
    double y[3][3];
    for (size_t a = 0; a < 3; a++)
        for (size_t b = 0; b < 3; b++)
            y[a][b] = free_surface_y(surface, (double)i + 0.5 * (double)a, 2 * j + b);
    return slopes_at(surface->dx, place, (const double(*)[3])y);
}

static struct lines lines_of(const struct slopes *y)
{
    double ex = -y->x / y->e;
    return (struct lines){ex, -(y->xx + 2.0 * ex * y->xe + ex * ex * y->ee) / y->e,
                          -(y->xe + ex * y->ee) / y->e, y->e, y->ee};
}

static struct lines lines_at(const struct free_surface *surface, size_t i, size_t j, size_t place)
{
    const struct slopes y = cell_slopes(surface, i, j, place);
    return lines_of(&y);
}

/* Adds slope times J and bend times K of row j, the jumps of F_xi and F_xi,xi over (xi, eta) at the
 * line i where those of the grid turn. phi_x and phi_xx have none:
 *     [F_x]  = -[eta_x] F_eta,
 *     [F_xx] = -2 [eta_x] F_x,eta + (sum of eta_x) [eta_x]_eta F_eta - [eta_xx] F_eta
 * with the mean of F_x,eta. */
static void add_jump(struct target *target, size_t i, size_t j, double slope, double bend)
{
    const struct free_surface *surface = target->surface;
    if (target->jumps) {
        struct jumps *to = &target->jumps[(i == surface->bow ? 0 : surface->ny) + j];
        to->slope += slope;
        to->bend += bend;
        return;
    }
    struct lines a = lines_at(surface, i - 1, j, 2), b = lines_at(surface, i, j, 0);
    double dx = surface->dx, ex = b.ex - a.ex;
    double plain =
        slope * dx * ex + bend * dx * dx * ((a.ex + b.ex) * (b.exe - a.exe) - (b.exx - a.exx));
    double mixed = bend * 2.0 * dx * ex;
    for (long l = 0; l < ALONG; l++) {
        double d = spline_along[1][l];
        add_coefficient(target, (long)i - 1, (long)j + l - 2, (0.5 * plain - mixed) * d);
        add_coefficient(target, (long)i, (long)j + l - 2, (0.5 * plain + mixed) * d);
    }
}

/* The coefficient of cell (i, j) that F continued from a zone would have. */
static void add_seen(struct target *target, enum zone from, long i, long j, double factor)
{
    const struct free_surface *surface = target->surface;
    enum zone zone = zone_of(surface, i);
    if (zone == from || i < 0 || factor == 0.0) {
        add_coefficient(target, i, j, factor);
        return;
    }
    bool mirror = j < 0 && from != BESIDE && !(from == AFT && surface->transom > 0);
    long row = mirror ? -1 - j : j;
    size_t line = from == AHEAD || zone == AHEAD ? surface->bow : surface->stern;
    double t = (double)i + 0.5 - (double)line, side = from < zone ? 1.0 : -1.0, sign = 1.0;
    if (row < 0 && (zone == AHEAD || surface->transom == 0)) {
        sign = -1.0;
        row = -1 - row;
    }
    add_coefficient(target, i, mirror ? -1 - j : j, factor);
    add_jump(target, line, (size_t)fmin(fmax(0.0, (double)row), (double)surface->ny - 1.0),
             -sign * factor * fabs(t), -sign * side * 0.5 * factor * (t * t - 0.25));
}

/* Adds the product of two stencils about cell (i, j). */
static void add_product(struct target *target, size_t i, size_t j, const double a[ALONG],
                        const double b[ACROSS], double factor)
{
    enum zone from = zone_of(target->surface, (long)i);
    for (long k = 0; k < ALONG; k++)
        for (long l = 0; l < ACROSS; l++)
            add_seen(target, from, (long)i + k - 2, (long)j + l - ACROSS / 2, factor * a[k] * b[l]);
}

/* phi_xx at the middle of cell (i, j), F over (x, eta):
 *     phi_xx = F_xx + 2 eta_x F_x,eta + eta_x^2 F_eta,eta + eta_xx F_eta,
 * and with another base flow, c = w_i eta_i, and g_i what multiplies phi_i
 *     w_x^2 F_xx + 2 w_x c F_x,eta + c^2 F_eta,eta + w_i w_j eta_ij F_eta + g_x F_x + g_i eta_i
 * F_eta. */
static void second_row(struct target *target, const struct across *across,
                       const struct base_point *base, size_t i, size_t j)
{
    const struct free_surface *surface = target->surface;
    const struct lines at = lines_at(surface, i, j, 1);
    const double(*d)[ALONG] = i + 1 < surface->nx ? spline_along : spline_last, dx = surface->dx;
    const double w[2] = {base->gradient[0] - 1.0, base->gradient[1]}, *h = base->second;
    double ey = 1.0 / at.ye, exy = at.exe * ey, eyy = -at.yee * ey * ey * ey;
    double c = w[0] * at.ex + w[1] * ey, spread = h[0] + h[2];
    double gx = 2.0 * (w[0] * h[0] + w[1] * h[1]) + spread * w[0];
    double gy = 2.0 * (w[0] * h[1] + w[1] * h[2]) + spread * w[1];
    double bend = w[0] * w[0] * at.exx + 2.0 * w[0] * w[1] * exy + w[1] * w[1] * eyy;
    add_product(target, i, j, d[2], across->value, w[0] * w[0] / (dx * dx));
    add_product(target, i, j, d[1], across->first, -2.0 * w[0] * c / dx);
    add_product(target, i, j, d[0], across->second, c * c);
    add_product(target, i, j, d[0], across->first, bend + gx * at.ex + gy * ey);
    add_product(target, i, j, d[1], across->value, -gx / dx);
}

/* 2 mu w_i phi_i over sqrt(k0), of the sixth difference across. */
static void odd_row(struct target *target, const struct across *across,
                    const struct base_point *base, size_t i, size_t j)
{
    const struct free_surface *surface = target->surface;
    const struct lines at = lines_at(surface, i, j, 1);
    const double(*d)[ALONG] = i + 1 < surface->nx ? spline_along : spline_last;
    const double twice = 1.0 / (64.0 * sqrt(PI * at.ye));
    const double w[2] = {base->gradient[0] - 1.0, base->gradient[1]};
    add_product(target, i, j, d[1], across->value_sixth, -w[0] * twice / surface->dx);
    add_product(target, i, j, d[0], across->first_sixth, twice * (w[0] * at.ex + w[1] / at.ye));
}

/* Linearised about the free stream. */
static const struct base_point stream = {{0.0, 0.0}, {0.0, 0.0, 0.0}};

igabem_status operator_create(const struct free_surface *surface, const struct base_point *base,
                              struct surface_operator *result)
{
    size_t nx = surface->nx, ny = surface->ny, n = nx * ny, room[3] = {0, 0, 0};
    size_t columns = n + surface->stern - surface->bow;
    struct across across;
    fill_across(&across);
    *result = (struct surface_operator){.value.start = calloc(n + 1, sizeof(size_t)),
                                        .second.start = calloc(n + 1, sizeof(size_t)),
                                        .odd.start = calloc(n + 1, sizeof(size_t))};
    double *row = calloc(columns, sizeof *row);
    struct target target = {.surface = surface, .row = row};
    bool complete = result->value.start && result->second.start && result->odd.start && row;
    for (size_t c = 0; c < n && complete; c++) {
        size_t i = c / ny, j = c % ny;
        const struct base_point *at = base ? &base[c] : &stream;
        add_product(&target, i, j, spline_along[0], across.value, 1.0);
        complete = sparse_append(&result->value, columns, row, &room[0]);
        second_row(&target, &across, at, i, j);
        complete = complete && sparse_append(&result->second, columns, row, &room[1]);
        odd_row(&target, &across, at, i, j);
        complete = complete && sparse_append(&result->odd, columns, row, &room[2]);
    }
    free(row);
    if (complete)
        return IGABEM_OK;
    operator_free(result);
    return no_memory();
}

igabem_status operator_edge(const struct free_surface *surface, const struct density *density,
                            const struct mesh *mesh, struct sparse *edge)
{
    size_t n = surface->waterline.n ? surface->stern - surface->bow : 0, room = 0;
    *edge = (struct sparse){.start = calloc(n + 1, sizeof(size_t))};
    double *row = calloc(density->n, sizeof *row);
    igabem_status status = edge->start && row ? IGABEM_OK : no_memory();
    for (size_t k = 0; k < n && status == IGABEM_OK; k++) {
        size_t patch;
        double x = surface->x0 - surface->dx * ((double)(surface->bow + k) + 0.5), uv[2];
        status = edge_locate(&surface->waterline, density, x, &patch, uv);
        if (status == IGABEM_OK)
            spline_hull_basis(mesh, patch, uv, row);
        if (status == IGABEM_OK && !sparse_append(edge, density->n, row, &room))
            status = no_memory();
    }
    free(row);
    if (status != IGABEM_OK)
        sparse_free(edge);
    return status;
}

void operator_gradient(const struct free_surface *surface, const struct free_surface_place *place,
                       const double *phi, double gradient[2])
{
    double i = fmin(floor(place->xi), (double)surface->nx - 1.0);
    double j = fmin(floor(place->eta), (double)surface->ny - 1.0);
    double u[3], du[3], v[3], dv[3];
    struct target along = {.surface = surface, .phi = phi}, across = along;
    enum zone from = zone_of(surface, (long)i);
    spline_evaluate(place->xi - i, u, du);
    spline_evaluate(place->eta - j, v, dv);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            add_seen(&along, from, (long)i + a - 1, (long)j + b - 1, -du[a] * v[b] / surface->dx);
            add_seen(&across, from, (long)i + a - 1, (long)j + b - 1, u[a] * dv[b]);
        }
    gradient[0] = along.sum + place->eta_x * across.sum;
    gradient[1] = place->eta_y * across.sum;
}

void operator_apply(const struct free_surface *surface, const struct base_point *base,
                    const double *phi, double *value, double *second, double *odd)
{
    struct across across;
    fill_across(&across);
    for (size_t c = 0; c < surface->nx * surface->ny; c++) {
        size_t i = c / surface->ny, j = c % surface->ny;
        struct target to[3] = {{.surface = surface, .phi = phi}};
        to[1] = to[2] = to[0];
        add_product(&to[0], i, j, spline_along[0], across.value, 1.0);
        second_row(&to[1], &across, base ? &base[c] : &stream, i, j);
        odd_row(&to[2], &across, base ? &base[c] : &stream, i, j);
        value[c] = to[0].sum;
        second[c] = to[1].sum;
        odd[c] = to[2].sum;
    }
}

/* What a change of the breadth at three half cells does to the lines at a place of a cell. */
static struct lines change_lines(const struct free_surface *surface, size_t j, size_t place,
                                 const struct slopes *y, const double breadth[3])
{
    double change[3][3], all = surface->offset[2 * surface->ny];
    for (size_t a = 0; a < 3; a++)
        for (size_t b = 0; b < 3; b++)
            change[a][b] = breadth[a] * (1.0 - surface->offset[2 * j + b] / all);
    const struct slopes d = slopes_at(surface->dx, place, (const double(*)[3])change);
    const struct lines at = lines_of(y);
    double ex = -(d.x + at.ex * d.e) / y->e;
    double exx = -(d.xx + 2.0 * (ex * y->xe + at.ex * d.xe + at.ex * ex * y->ee) +
                   at.ex * at.ex * d.ee + at.exx * d.e) /
                 y->e;
    double exe = -(d.xe + ex * y->ee + at.ex * d.ee + at.exe * d.e) / y->e;
    return (struct lines){ex, exx, exe, d.e, d.ee};
}

/* Of a row at bow or stern: what J and K are multiplied by, F_eta and twice the jump of F_eta, and
 * what the first of the changes of breadth does to J's and K's factors (add_jump()). */
struct turn {
    double plain, mixed;
    double *change; /* [3][count]: of slope plain, bend plain, bend mixed */
};

static void fill_turn(const struct free_surface *surface, const double *phi, size_t i, size_t j,
                      size_t count, const double *breadth, struct turn *turn)
{
    struct target side[2] = {{.surface = surface, .phi = phi}, {.surface = surface, .phi = phi}};
    const struct slopes ya = cell_slopes(surface, i - 1, j, 2), yb = cell_slopes(surface, i, j, 0);
    const struct lines a = lines_of(&ya), b = lines_of(&yb);
    double dx = surface->dx;
    for (long l = 0; l < ALONG; l++)
        for (long k = 0; k < 2; k++)
            add_coefficient(&side[k], (long)i - 1 + k, (long)j + l - 2, spline_along[1][l]);
    turn->plain = 0.5 * (side[0].sum + side[1].sum);
    turn->mixed = side[1].sum - side[0].sum;
    for (size_t f = 0; f < count; f++) {
        double at[2][3];
        for (size_t s = 0; s < 3; s++) {
            at[0][s] = breadth[(2 * i - 2 + s) * count + f];
            at[1][s] = breadth[(2 * i + s) * count + f];
        }
        struct lines da = change_lines(surface, j, 2, &ya, at[0]);
        struct lines db = change_lines(surface, j, 0, &yb, at[1]);
        turn->change[f] = dx * (db.ex - da.ex);
        turn->change[count + f] = dx * dx *
                                  ((da.ex + db.ex) * (b.exe - a.exe) +
                                   (a.ex + b.ex) * (db.exe - da.exe) - (db.exx - da.exx));
        turn->change[2 * count + f] = 2.0 * dx * (db.ex - da.ex);
    }
}

/* Adds what the turns' changes do to a row whose jumps were collected, which are cleared. */
static void add_turns(size_t rows, size_t count, const struct turn *turn, struct jumps *jumps,
                      double *out)
{
    for (size_t r = 0; r < rows; r++) {
        double slope = jumps[r].slope, bend = jumps[r].bend;
        if (slope == 0.0 && bend == 0.0)
            continue;
        const double *d = turn[r].change;
        for (size_t f = 0; f < count; f++)
            out[f] += (slope * d[f] + bend * d[count + f]) * turn[r].plain +
                      bend * d[2 * count + f] * turn[r].mixed;
        jumps[r] = (struct jumps){0.0, 0.0};
    }
}

/* The products of second_row() and odd_row() */
enum { OF_XX, OF_XE, OF_EE, OF_E, OF_X, ODD_X, ODD_E, PRODUCTS };

/* What changes of the lines and of the base flow (w, then second derivatives) change in their
 * factors. */
static void change_factors(double dx, const struct lines *at, const struct lines *d,
                           const struct base_point *base, const double b[5],
                           double factor[PRODUCTS])
{
    const double w[2] = {base->gradient[0] - 1.0, base->gradient[1]}, *h = base->second;
    double ey = 1.0 / at->ye, exy = at->exe * ey, eyy = -at->yee * ey * ey * ey;
    double c = w[0] * at->ex + w[1] * ey, spread = h[0] + h[2];
    double gx = 2.0 * (w[0] * h[0] + w[1] * h[1]) + spread * w[0];
    double gy = 2.0 * (w[0] * h[1] + w[1] * h[2]) + spread * w[1];
    double dey = -ey * ey * d->ye, dexy = d->exe * ey + at->exe * dey;
    double deyy = -ey * ey * (d->yee * ey + 3.0 * at->yee * dey);
    double dc = b[0] * at->ex + w[0] * d->ex + b[1] * ey + w[1] * dey, dspread = b[2] + b[4];
    double dgx = 2.0 * (b[0] * h[0] + w[0] * b[2] + b[1] * h[1] + w[1] * b[3]) + dspread * w[0] +
                 spread * b[0];
    double dgy = 2.0 * (b[0] * h[1] + w[0] * b[3] + b[1] * h[2] + w[1] * b[4]) + dspread * w[1] +
                 spread * b[1];
    double dbend = 2.0 * w[0] * b[0] * at->exx + w[0] * w[0] * d->exx +
                   2.0 * ((b[0] * w[1] + w[0] * b[1]) * exy + w[0] * w[1] * dexy) +
                   2.0 * w[1] * b[1] * eyy + w[1] * w[1] * deyy;
    double twice = 1.0 / (64.0 * sqrt(PI * at->ye)), fall = -0.5 * twice * d->ye * ey;
    factor[OF_XX] = 2.0 * w[0] * b[0] / (dx * dx);
    factor[OF_XE] = -2.0 * (b[0] * c + w[0] * dc) / dx;
    factor[OF_EE] = 2.0 * c * dc;
    factor[OF_E] = dbend + dgx * at->ex + gx * d->ex + dgy * ey + gy * dey;
    factor[OF_X] = -dgx / dx;
    factor[ODD_X] = -(b[0] * twice + w[0] * fall) / dx;
    factor[ODD_E] = fall * c + twice * dc;
}

static void change_cell(const struct operator_change *change, const struct across *across, size_t i,
                        size_t j, double *second, double *odd)
{
    static const double still[5] = {0.0, 0.0, 0.0, 0.0, 0.0};
    const struct free_surface *surface = change->surface;
    const double(*d)[ALONG] = i + 1 < surface->nx ? spline_along : spline_last;
    const double *const b[PRODUCTS] = {across->value,      across->first, across->second,
                                       across->first,      across->value, across->value_sixth,
                                       across->first_sixth};
    const int along[PRODUCTS] = {2, 1, 0, 0, 1, 1, 0};
    const struct slopes y = cell_slopes(surface, i, j, 1);
    const struct lines at = lines_of(&y);
    size_t count = change->count, cell = i * surface->ny + j;
    double sum[PRODUCTS];
    for (int k = 0; k < PRODUCTS; k++) {
        struct target target = {.surface = surface, .phi = change->phi};
        add_product(&target, i, j, d[along[k]], b[k], 1.0);
        sum[k] = target.sum;
    }
    for (size_t f = 0; f < count; f++) {
        double breadth[3], base[5], factor[PRODUCTS];
        for (size_t s = 0; s < 3; s++)
            breadth[s] = change->breadth[(2 * i + s) * count + f];
        for (size_t s = 0; s < 5 && change->base; s++)
            base[s] = change->base_change[(5 * cell + s) * count + f];
        const struct lines e = change_lines(surface, j, 1, &y, breadth);
        change_factors(surface->dx, &at, &e, change->base ? &change->base[cell] : &stream,
                       change->base ? base : still, factor);
        for (int k = 0; k < ODD_X; k++)
            second[f] += factor[k] * sum[k];
        odd[f] += factor[ODD_X] * sum[ODD_X] + factor[ODD_E] * sum[ODD_E];
    }
}

/* Whether the stencils about a cell reach across a line of the grid. */
static bool sees(size_t i, size_t line)
{
    return i + 2 >= line && i <= line + 1;
}

igabem_status operator_change(const struct operator_change *in, double *value, double *second,
                              double *odd)
{
    const struct free_surface *surface = in->surface;
    size_t count = in->count;
    size_t nx = surface->nx, ny = surface->ny, rows = surface->waterline.n ? 2 * ny : 0;
    const size_t line[2] = {surface->bow, surface->stern};
    struct across across;
    fill_across(&across);
    struct jumps *jumps = calloc(2 * ny, sizeof *jumps);
    struct turn *turn = calloc(2 * ny, sizeof *turn);
    double *change = malloc((6 * ny * count + 1) * sizeof *change);
    bool complete = jumps && turn && change;
    for (size_t r = 0; r < rows && complete; r++) {
        turn[r].change = change + 3 * count * r;
        fill_turn(surface, in->phi, line[r / ny], r % ny, count, in->breadth, &turn[r]);
    }
    for (size_t c = 0; c < nx * ny && complete; c++) {
        size_t i = c / ny, j = c % ny;
        double *v = value + c * count, *s = second + c * count, *o = odd + c * count;
        for (size_t f = 0; f < count; f++)
            v[f] = s[f] = o[f] = 0.0;
        change_cell(in, &across, i, j, s, o);
        if (rows == 0 || !(sees(i, line[0]) || sees(i, line[1])))
            continue;
        struct target target = {.surface = surface, .jumps = jumps};
        add_product(&target, i, j, spline_along[0], across.value, 1.0);
        add_turns(rows, count, turn, jumps, v);
        second_row(&target, &across, in->base ? &in->base[c] : &stream, i, j);
        add_turns(rows, count, turn, jumps, s);
        odd_row(&target, &across, in->base ? &in->base[c] : &stream, i, j);
        add_turns(rows, count, turn, jumps, o);
    }
    free(jumps);
    free(turn);
    free(change);
    return complete ? IGABEM_OK : no_memory();
}

void operator_interpolate(const struct free_surface *surface, double *values, double *scratch)
{
    size_t nx = surface->nx, ny = surface->ny, columns = surface->columns;
    for (size_t i = 1; i <= nx; i++)
        spline_interpolate(ny, values + i * columns, 1, scratch);
    for (size_t j = 0; j < ny + 2; j++)
        spline_interpolate(nx, values + j, columns, scratch);
}

void operator_fold(const struct free_surface *surface, double *coefficients, double *scratch)
{
    size_t nx = surface->nx, ny = surface->ny, columns = surface->columns;
    for (size_t j = 0; j < ny + 2; j++)
        spline_fold(nx, coefficients + j, columns, scratch);
    for (size_t i = 1; i <= nx; i++)
        spline_fold(ny, coefficients + i * columns, 1, scratch);
}
