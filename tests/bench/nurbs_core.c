/* libnurbs against SISL (when the build found it) on the same hull-like data in one run: figures in
 * pairs, each the best of several repetitions in process time.
 *
 *     nurbs_core [evaluations, 1000000] [repetitions, 5]
 *
 * The shape: a bicubic net of a 100 m hull whose knots wobble about even spacing, either with the
 * control points at their Greville abscissae ("smooth") or spread evenly ("wobbly"). */
#include <nurbs/nurbs.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifdef HAVE_SISL
#include <sisl.h>
#endif

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double random_unit(uint64_t *state)
{
    uint64_t z = (*state += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static void *need(void *p)
{
    if (!p) {
        fprintf(stderr, "nurbs_core: out of memory\n");
        exit(EXIT_FAILURE);
    }
    return p;
}

static void must(nurbs_status status)
{
    if (status < 0) {
        fprintf(stderr, "nurbs_core: %s\n", nurbs_last_error());
        exit(EXIT_FAILURE);
    }
}

static double *wobbly_knots(size_t n, uint64_t seed)
{
    double *t = need(malloc((n + 4) * sizeof *t));
    for (size_t i = 0; i < 4; i++) {
        t[i] = 0.0;
        t[n + i] = 1.0;
    }
    for (size_t i = 0; i < n - 4; i++)
        t[4 + i] = ((double)i + 1.0 + 0.6 * (random_unit(&seed) - 0.5)) / (double)(n - 3);
    return t;
}

static void hull_point(double s, double t, double p[3])
{
    const double x = 2.0 * s - 1.0, fullness = 1.0 - pow(fabs(x), 3.0);
    p[0] = 100.0 * s + 2.0 * x * (1.0 - t) * (1.0 - t);
    p[1] = 8.0 * fullness * pow(t, 0.5 + 0.8 * x * x) +
           0.4 * exp(-60.0 * (s - 0.97) * (s - 0.97) - 30.0 * (t - 0.2) * (t - 0.2));
    p[2] = 10.0 * (0.3 * t + 0.7 * t * t * (3.0 - 2.0 * t));
}

static nurbs_surface *hull(size_t nu, size_t nv, int wobbly, int rational)
{
    double *ku = wobbly_knots(nu, 11), *kv = wobbly_knots(nv, 22);
    double *gu = need(malloc(nu * sizeof *gu)), *gv = need(malloc(nv * sizeof *gv));
    double *p = need(malloc(3 * nu * nv * sizeof *p)), *w = need(malloc(nu * nv * sizeof *w));
    uint64_t state = 33;
    nurbs_greville(3, nu, ku, gu);
    nurbs_greville(3, nv, kv, gv);
    for (size_t i = 0; i < nu; i++)
        for (size_t j = 0; j < nv; j++) {
            hull_point(wobbly ? (double)i / (double)(nu - 1) : gu[i],
                       wobbly ? (double)j / (double)(nv - 1) : gv[j], p + 3 * (i * nv + j));
            w[i * nv + j] = 0.7 + 0.6 * random_unit(&state);
        }
    const int degree[2] = {3, 3};
    const size_t size[2] = {nu, nv};
    nurbs_surface *s;
    must(nurbs_surface_create(degree, size, ku, kv, p, rational ? w : NULL, &s));
    free(ku);
    free(kv);
    free(gu);
    free(gv);
    free(p);
    free(w);
    return s;
}

/* One line: ours, the peer's (negative: none), and how many times faster ours is. */
static void report(const char *name, double ours, double peer, const char *unit, const char *note)
{
    if (peer > 0.0)
        printf("%-34s %10.4g %10.4g %-8s %6.2fx  %s\n", name, ours, peer, unit, peer / ours, note);
    else
        printf("%-34s %10.4g %10s %-8s %6s   %s\n", name, ours, "-", unit, "", note);
    fflush(stdout);
}

#define BEST(best, statement)                                                                      \
    do {                                                                                           \
        const double start_ = seconds();                                                           \
        statement;                                                                                 \
        const double time_ = seconds() - start_;                                                   \
        best = best < 0.0 || time_ < best ? time_ : best;                                          \
    } while (0)

#ifdef HAVE_SISL
static SISLSurf *peer_surface(const nurbs_surface *s)
{
    const size_t nu = nurbs_surface_size(s, 0), nv = nurbs_surface_size(s, 1);
    const double *w = nurbs_surface_weights(s), *p = nurbs_surface_points(s);
    const size_t dim = w ? 4 : 3;
    double *c = need(malloc(dim * nu * nv * sizeof *c));
    for (size_t i = 0; i < nu; i++)
        for (size_t j = 0; j < nv; j++) { /* SISL: first direction fast */
            double *to = c + dim * (j * nu + i);
            const size_t from = i * nv + j;
            for (size_t x = 0; x < 3; x++)
                to[x] = p[3 * from + x] * (w ? w[from] : 1.0);
            if (w)
                to[3] = w[from];
        }
    double *ku = need(malloc((nu + 4) * sizeof *ku)), *kv = need(malloc((nv + 4) * sizeof *kv));
    memcpy(ku, nurbs_surface_knots(s, 0), (nu + 4) * sizeof *ku);
    memcpy(kv, nurbs_surface_knots(s, 1), (nv + 4) * sizeof *kv);
    SISLSurf *peer = need(newSurf((int)nu, (int)nv, 4, 4, ku, kv, c, w ? 2 : 1, 3, 1));
    free(c);
    free(ku);
    free(kv);
    return peer;
}

static double peer_scattered(SISLSurf *peer, int order, size_t n, double *uv, double *sum)
{
    int left[2] = {0, 0}, status;
    double out[54], normal[3];
    const double start = seconds();
    for (size_t i = 0; i < n; i++) {
        if (order == 0)
            s1424(peer, 0, 0, uv + 2 * i, &left[0], &left[1], out, &status);
        else
            s1421(peer, order, uv + 2 * i, &left[0], &left[1], out, normal, &status);
        *sum += out[0];
    }
    return seconds() - start;
}
#endif

static void bench_evaluation(size_t nu, size_t nv, int rational, size_t n, int repetitions)
{
    nurbs_surface *s = hull(nu, nv, 0, rational);
    uint64_t state = 99;
    double *uv = need(malloc(2 * n * sizeof *uv)), sum = 0.0;
    for (size_t i = 0; i < 2 * n; i++)
        uv[i] = random_unit(&state);
    const size_t side = (size_t)sqrt((double)n);
    double *at = need(malloc(side * sizeof *at));
    double *out = need(malloc(18 * n * sizeof *out)),
           *normals = need(malloc(3 * n * sizeof(double)));
    memset(out, 0, 18 * n * sizeof *out); /* pages in place before the clock runs */
    memset(normals, 0, 3 * n * sizeof *normals);
    for (size_t i = 0; i < side; i++)
        at[i] = ((double)i + 0.5) / (double)side;
    const char *kind = rational ? "rational" : "polynomial";
    static const char *const orders[3] = {"point", "1st derivatives", "2nd derivatives"};
#ifdef HAVE_SISL
    SISLSurf *peer = peer_surface(s);
#endif
    for (int order = 0; order <= 2; order++) {
        double ours = -1.0, single = -1.0, theirs = -1.0;
        for (int r = 0; r < repetitions; r++) {
            BEST(ours, must(nurbs_surface_eval(s, order, n, uv, out)));
            BEST(single, {
                for (size_t i = 0; i < n; i++) {
                    double one[18];
                    must(nurbs_surface_eval(s, order, 1, uv + 2 * i, one));
                    sum += one[0];
                }
            });
#ifdef HAVE_SISL
            const double time = peer_scattered(peer, order, n, uv, &sum);
            theirs = theirs < 0.0 || time < theirs ? time : theirs;
#endif
        }
        char name[80], note[80];
        snprintf(name, sizeof name, "%s %zux%zu %s", orders[order], nu, nv, kind);
        snprintf(note, sizeof note, "one call a point: %.1f ns", single / (double)n * 1e9);
        report(name, ours / (double)n * 1e9, theirs / (double)n * 1e9, "ns", note);
    }
    for (int order = 0; order <= 2; order += 2) {
        double ours = -1.0, theirs = -1.0;
        for (int r = 0; r < repetitions; r++) {
            BEST(ours, must(nurbs_surface_eval_grid(s, order, side, at, side, at, out)));
            sum += out[17];
#ifdef HAVE_SISL
            int status;
            BEST(theirs, s1506(peer, order, (int)side, at, (int)side, at, out, normals, &status));
            sum += out[17];
#endif
        }
        char name[80];
        snprintf(name, sizeof name, "grid, %s %zux%zu %s", orders[order], nu, nv, kind);
        report(name, ours / (double)(side * side) * 1e9, theirs / (double)(side * side) * 1e9, "ns",
               "");
    }
    if (sum == 0.123)
        puts("");
#ifdef HAVE_SISL
    freeSurf(peer);
#endif
    free(uv);
    free(at);
    free(out);
    free(normals);
    nurbs_surface_free(s);
}

static void bench_curve(size_t n, size_t evaluations, int repetitions)
{
    double *t = wobbly_knots(n, 11), *p = need(malloc(3 * n * sizeof *p));
    double *g = need(malloc(n * sizeof *g)), *u = need(malloc(evaluations * sizeof *u));
    double *out = need(malloc(9 * evaluations * sizeof *out)), sum = 0.0;
    nurbs_greville(3, n, t, g);
    for (size_t i = 0; i < n; i++)
        hull_point(0.3, g[i], p + 3 * i);
    uint64_t state = 99;
    for (size_t i = 0; i < evaluations; i++)
        u[i] = random_unit(&state);
    memset(out, 0, 9 * evaluations * sizeof *out);
    nurbs_curve *c;
    must(nurbs_curve_create(3, n, t, p, NULL, &c));
#ifdef HAVE_SISL
    SISLCurve *peer = need(newCurve((int)n, 4, t, p, 1, 3, 1));
#endif
    for (int order = 0; order <= 2; order += 2) {
        double ours = -1.0, theirs = -1.0;
        for (int r = 0; r < repetitions; r++) {
            BEST(ours, must(nurbs_curve_eval(c, order, evaluations, u, out)));
#ifdef HAVE_SISL
            int left = 0, status;
            double one[9];
            BEST(theirs, {
                for (size_t i = 0; i < evaluations; i++) {
                    s1221(peer, order, u[i], &left, one, &status);
                    sum += one[0];
                }
            });
#endif
        }
        char name[80];
        snprintf(name, sizeof name, "curve of %zu, %s", n, order ? "2nd derivatives" : "point");
        report(name, ours / (double)evaluations * 1e9, theirs / (double)evaluations * 1e9, "ns",
               "");
    }
    if (sum == 0.123)
        puts("");
#ifdef HAVE_SISL
    freeCurve(peer);
#endif
    nurbs_curve_free(c);
    free(t);
    free(p);
    free(g);
    free(u);
    free(out);
}

static void bench_changes(int repetitions)
{
    nurbs_surface *s = hull(90, 25, 0, 0), *half, *result = NULL;
    double u[90], v[25], ours = -1.0, theirs = -1.0;
    uint64_t state = 5;
    for (size_t i = 0; i < 90; i++)
        u[i] = ((double)i + random_unit(&state)) / 90.0;
    for (size_t i = 0; i < 25; i++)
        v[i] = ((double)i + random_unit(&state)) / 25.0;
#ifdef HAVE_SISL
    SISLSurf *peer = peer_surface(s), *changed;
    int status;
#endif
    for (int r = 0; r < repetitions; r++) {
        BEST(ours, {
            must(nurbs_surface_insert(s, 1, 25, v, &half));
            must(nurbs_surface_insert(half, 0, 90, u, &result));
        });
        nurbs_surface_free(half);
        nurbs_surface_free(result);
#ifdef HAVE_SISL
        BEST(theirs, s1025(peer, u, 90, v, 25, &changed, &status));
        freeSurf(changed);
#endif
    }
    report("insert 90 + 25 knots into 90x25", ours * 1e3, theirs * 1e3, "ms", "");
    ours = theirs = -1.0;
    for (int r = 0; r < repetitions; r++) {
        BEST(ours, {
            must(nurbs_surface_elevate(s, 1, 1, &half));
            must(nurbs_surface_elevate(half, 0, 1, &result));
        });
        nurbs_surface_free(half);
        nurbs_surface_free(result);
#ifdef HAVE_SISL
        BEST(theirs, s1387(peer, 5, 5, &changed, &status));
        freeSurf(changed);
#endif
    }
    report("elevate 90x25 to degree 4", ours * 1e3, theirs * 1e3, "ms", "");
#ifdef HAVE_SISL
    freeSurf(peer);
#endif
    nurbs_surface_free(s);
}

/* Sections of the hull, on one knot vector or each with its own. */
static void bench_skin(int own, int repetitions)
{
    enum { SECTIONS = 90, SIZE = 25 };
    nurbs_curve *sections[SECTIONS];
    for (size_t i = 0; i < SECTIONS; i++) {
        double *t = wobbly_knots(SIZE, own ? 1000 + i : 22), g[SIZE], p[3 * SIZE];
        nurbs_greville(3, SIZE, t, g);
        for (size_t j = 0; j < SIZE; j++)
            hull_point((double)i / (SECTIONS - 1), g[j], p + 3 * j);
        must(nurbs_curve_create(3, SIZE, t, p, NULL, &sections[i]));
        free(t);
    }
    double ours = -1.0, theirs = -1.0;
    nurbs_surface *skin = NULL;
    for (int r = 0; r < repetitions; r++) {
        nurbs_surface_free(skin);
        BEST(ours, must(nurbs_skin_curves(SECTIONS, (const nurbs_curve *const *)sections, NULL, 3,
                                          0.0, &skin)));
    }
    size_t peer_size[2] = {0, 0};
#ifdef HAVE_SISL
    SISLCurve *peers[SECTIONS];
    int kinds[SECTIONS];
    for (size_t i = 0; i < SECTIONS; i++) {
        double t[SIZE + 4], p[3 * SIZE];
        memcpy(t, nurbs_curve_knots(sections[i]), sizeof t);
        memcpy(p, nurbs_curve_points(sections[i]), sizeof p);
        peers[i] = need(newCurve(SIZE, 4, t, p, 1, 3, 1));
        kinds[i] = 1;
    }
    for (int r = 0; r < repetitions; r++) {
        SISLSurf *surface = NULL;
        double *parameters = NULL;
        int status;
        BEST(theirs, s1538(SECTIONS, peers, kinds, 0.0, 1, 4, 0, &surface, &parameters, &status));
        if (surface) {
            peer_size[0] = (size_t)surface->in1;
            peer_size[1] = (size_t)surface->in2;
            freeSurf(surface);
        }
        free(parameters);
    }
    for (size_t i = 0; i < SECTIONS; i++)
        freeCurve(peers[i]);
#endif
    char note[120];
    snprintf(note, sizeof note, "%zux%zu, peer %zux%zu", nurbs_surface_size(skin, 0),
             nurbs_surface_size(skin, 1), peer_size[1], peer_size[0]);
    report(own ? "skin 90 sections, own knots" : "skin 90 sections, common knots", ours * 1e3,
           theirs * 1e3, "ms", note);
    nurbs_surface_free(skin);
    for (size_t i = 0; i < SECTIONS; i++)
        nurbs_curve_free(sections[i]);
}

/* Points of the hull on an even grid, u slow. */
static nurbs_grid *hull_grid(size_t rows, size_t columns)
{
    nurbs_grid *grid;
    must(nurbs_grid_create(rows, columns, NULL, &grid));
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++)
            hull_point((double)i / (double)(rows - 1), (double)j / (double)(columns - 1),
                       nurbs_grid_edit(grid) + 3 * (i * columns + j));
    return grid;
}

static double *even(size_t n)
{
    double *u = need(malloc(n * sizeof *u));
    for (size_t i = 0; i < n; i++)
        u[i] = (double)i / (double)(n - 1);
    return u;
}

#ifdef HAVE_SISL
/* The points with the first direction fast. */
static double *peer_points(const nurbs_grid *grid)
{
    const size_t rows = nurbs_grid_rows(grid), columns = nurbs_grid_columns(grid);
    double *points = need(malloc(3 * rows * columns * sizeof *points));
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++)
            memcpy(points + 3 * (j * rows + i), nurbs_grid_points(grid) + 3 * (i * columns + j),
                   3 * sizeof *points);
    return points;
}
#endif

static void bench_interpolation(int repetitions)
{
    nurbs_grid *grid = hull_grid(90, 25);
    double ours = -1.0, theirs = -1.0, skin = -1.0, *u = even(90), *v = even(25);
    nurbs_surface *s;
    for (int r = 0; r < repetitions; r++) {
        BEST(ours, must(nurbs_surface_interpolate((const int[]){3, 3}, grid, u, v, &s)));
        nurbs_surface_free(s);
        BEST(skin, must(nurbs_skin(grid, NULL, &s)));
        nurbs_surface_free(s);
    }
#ifdef HAVE_SISL
    double *points = peer_points(grid);
    for (int r = 0; r < repetitions; r++) {
        SISLSurf *peer = NULL;
        int status;
        BEST(theirs, s1537(points, 90, 25, 3, u, v, 0, 0, 0, 0, 4, 4, 1, 1, &peer, &status));
        freeSurf(peer);
    }
    free(points);
#endif
    char note[80];
    snprintf(note, sizeof note, "with parameters, kinks and fold check: %.3g ms", skin * 1e3);
    report("interpolate 90x25 points", ours * 1e3, theirs * 1e3, "ms", note);
    free(u);
    free(v);
    nurbs_grid_free(grid);
}

/* Within a tolerance of a grid: ours interpolates and simplifies. */
static void bench_grid_fit(double tolerance, int repetitions)
{
    enum { ROWS = 300, COLUMNS = 100 };
    nurbs_grid *grid = hull_grid(ROWS, COLUMNS);
    double ours = -1.0, theirs = -1.0, *u = even(ROWS), *v = even(COLUMNS);
    nurbs_surface *s = NULL, *full;
    for (int r = 0; r < repetitions; r++) {
        nurbs_surface_free(s);
        BEST(ours, {
            must(nurbs_skin(grid, NULL, &full));
            must(nurbs_surface_simplify(full, tolerance, 0, &s, NULL));
        });
        nurbs_surface_free(full);
    }
    size_t peer_size[2] = {0, 0};
#ifdef HAVE_SISL
    double *points = peer_points(grid), *worst = need(malloc(3 * ROWS * COLUMNS * sizeof *worst));
    for (int r = 0; r < repetitions; r++) {
        double eps[3] = {tolerance, tolerance, tolerance}, edge[12];
        int status, fixed[4] = {0, 0, 0, 0};
        SISLSurf *peer = NULL;
        for (int i = 0; i < 12; i++)
            edge[i] = tolerance;
        BEST(theirs, s1966(points, ROWS, COLUMNS, 3, 3, u, v, eps, fixed, 1, 1, edge, 0.4, 3, 10, 4,
                           4, &peer, worst, &status));
        if (peer) {
            peer_size[0] = (size_t)peer->in1;
            peer_size[1] = (size_t)peer->in2;
            freeSurf(peer);
        }
    }
    free(points);
    free(worst);
#endif
    char name[80], note[120];
    snprintf(name, sizeof name, "fit 300x100 points within %g", tolerance);
    snprintf(note, sizeof note, "%zux%zu, peer %zux%zu", nurbs_surface_size(s, 0),
             nurbs_surface_size(s, 1), peer_size[0], peer_size[1]);
    report(name, ours * 1e3, theirs * 1e3, "ms", note);
    nurbs_surface_free(s);
    free(u);
    free(v);
    nurbs_grid_free(grid);
}

/* Within a tolerance of points on a line; and least squares on the peer's number of even knots. */
static void bench_curve_fit(double tolerance, int repetitions)
{
    enum { POINTS = 2000 };
    double *p = need(malloc(3 * POINTS * sizeof *p)), *u = even(POINTS);
    for (size_t i = 0; i < POINTS; i++)
        hull_point(0.1 + 0.8 * u[i], 0.3 + 0.2 * u[i], p + 3 * i);
    double ours = -1.0, theirs = -1.0, squares = -1.0;
    nurbs_curve *c = NULL, *full;
    for (int r = 0; r < repetitions; r++) {
        nurbs_curve_free(c);
        BEST(ours, {
            must(nurbs_curve_interpolate(3, POINTS, p, u, &full));
            must(nurbs_curve_simplify(full, tolerance, &c, NULL));
        });
        nurbs_curve_free(full);
    }
    size_t peer_size = 0;
#ifdef HAVE_SISL
    double worst[3];
    for (int r = 0; r < repetitions; r++) {
        double eps[3] = {tolerance, tolerance, tolerance};
        int status;
        SISLCurve *peer = NULL;
        BEST(theirs, s1961(p, POINTS, 3, 1, u, eps, 0, 0, 1, 0.4, 10, 4, &peer, worst, &status));
        if (peer) {
            peer_size = (size_t)peer->in;
            freeCurve(peer);
        }
    }
#endif
    double knots[54];
    nurbs_curve *fit;
    for (int i = 0; i < 54; i++)
        knots[i] = i < 4 ? 0.0 : i > 49 ? 1.0 : (i - 3) / 47.0;
    for (int r = 0; r < repetitions; r++) {
        BEST(squares, must(nurbs_curve_fit(3, 50, knots, POINTS, p, u, &fit)));
        nurbs_curve_free(fit);
    }
    char name[80], note[160];
    snprintf(name, sizeof name, "fit 2000 points within %g", tolerance);
    snprintf(note, sizeof note, "%zu, peer %zu; least squares on 50 given: %.3g ms",
             nurbs_curve_size(c), peer_size, squares * 1e3);
    report(name, ours * 1e3, theirs * 1e3, "ms", note);
    nurbs_curve_free(c);
    free(u);
    free(p);
}

/* Points around the hull, about 1 m away. */
static void bench_closest(int repetitions)
{
    enum { POINTS = 500 };
    nurbs_surface *s = hull(90, 25, 0, 0);
    nurbs_locator *locator;
    double points[3 * POINTS], uv[2 * POINTS], distance[POINTS], ours = -1.0, theirs = -1.0;
    double farther = 0.0;
    uint64_t state = 3;
    must(nurbs_locator_create(s, &locator));
    for (size_t i = 0; i < POINTS; i++) {
        const double at[2] = {random_unit(&state), random_unit(&state)};
        must(nurbs_surface_eval(s, 0, 1, at, points + 3 * i));
        for (size_t c = 0; c < 3; c++)
            points[3 * i + c] += 2.0 * (random_unit(&state) - 0.5);
    }
    for (int r = 0; r < repetitions; r++)
        BEST(ours, must(nurbs_locator_closest(locator, POINTS, points, uv, distance)));
#ifdef HAVE_SISL
    SISLSurf *peer = peer_surface(s);
    BEST(theirs, {
        for (size_t i = 0; i < POINTS; i++) {
            double at[2];
            double d;
            int status;
            s1958(peer, points + 3 * i, 3, 1e-15, 1e-9, at, &d, &status);
            farther += d > distance[i] * (1.0 + 1e-9);
        }
    });
    freeSurf(peer);
#endif
    char note[80];
    snprintf(note, sizeof note, "peer farther for %g of %d points", farther, POINTS);
    report("closest point, global, 90x25", ours / POINTS * 1e6, theirs / POINTS * 1e6, "us", note);
    nurbs_locator_free(locator);
    nurbs_surface_free(s);
}

static void bench_simplify(const char *name, nurbs_surface *s, double tolerance, int repetitions)
{
    double ours = -1.0, theirs = -1.0, thrifty = -1.0, bound = 0.0;
    nurbs_surface *simple = NULL, *light = NULL;
    size_t peer_size[2] = {0, 0};
    for (int r = 0; r < repetitions; r++) {
        nurbs_surface_free(simple);
        BEST(ours, must(nurbs_surface_simplify(s, tolerance, 0, &simple, &bound)));
    }
    BEST(thrifty, must(nurbs_surface_simplify(s, tolerance, NURBS_SIMPLIFY_THRIFTY, &light, NULL)));
#ifdef HAVE_SISL
    SISLSurf *peer = peer_surface(s);
    for (int r = 0; r < repetitions; r++) {
        double eps[3] = {tolerance, tolerance, tolerance}, edge[12], worst[3];
        int fixed[4] = {0, 0, 0, 0}, status;
        SISLSurf *reduced = NULL;
        for (int i = 0; i < 12; i++)
            edge[i] = tolerance;
        BEST(theirs, s1965(peer, eps, fixed, 1, 1, edge, 3, 10, &reduced, worst, &status));
        if (reduced) {
            peer_size[0] = (size_t)reduced->in1;
            peer_size[1] = (size_t)reduced->in2;
            freeSurf(reduced);
        }
    }
    freeSurf(peer);
#endif
    char note[200];
    snprintf(
        note, sizeof note,
        "%zux%zu -> %zux%zu (bound %.3g), peer %zux%zu: %.2f of its points; thrifty %zux%zu in "
        "%.3g ms",
        nurbs_surface_size(s, 0), nurbs_surface_size(s, 1), nurbs_surface_size(simple, 0),
        nurbs_surface_size(simple, 1), bound, peer_size[0], peer_size[1],
        (double)(nurbs_surface_size(simple, 0) * nurbs_surface_size(simple, 1)) /
            (double)(peer_size[0] * peer_size[1]),
        nurbs_surface_size(light, 0), nurbs_surface_size(light, 1), thrifty * 1e3);
    report(name, ours * 1e3, theirs * 1e3, "ms", note);
    nurbs_surface_free(simple);
    nurbs_surface_free(light);
}

static void bench_simplifications(int repetitions)
{
    static const double tolerances[3] = {1e-4, 1e-3, 1e-2};
    char name[80];
    nurbs_surface *s = hull(90, 25, 0, 0), *half, *fine;
    double u[90], v[25];
    uint64_t state = 5;
    for (size_t i = 0; i < 90; i++)
        u[i] = ((double)i + random_unit(&state)) / 90.0;
    for (size_t i = 0; i < 25; i++)
        v[i] = ((double)i + random_unit(&state)) / 25.0;
    must(nurbs_surface_insert(s, 1, 25, v, &half));
    must(nurbs_surface_insert(half, 0, 90, u, &fine));
    bench_simplify("remove inserted knots, 1e-8", fine, 1e-8, repetitions);
    nurbs_surface_free(half);
    nurbs_surface_free(fine);
    for (int k = 0; k < 3; k++) {
        snprintf(name, sizeof name, "simplify 90x25, %g", tolerances[k]);
        bench_simplify(name, s, tolerances[k], repetitions);
    }
    nurbs_surface_free(s);
    for (int wobbly = 0; wobbly < 2; wobbly++) {
        s = hull(200, 200, wobbly, 0);
        for (int k = wobbly; k < 3; k++) {
            snprintf(name, sizeof name, "simplify 200x200%s, %g", wobbly ? " wobbly" : "",
                     tolerances[k]);
            bench_simplify(name, s, tolerances[k], repetitions < 3 ? repetitions : 3);
        }
        nurbs_surface_free(s);
    }
}

int main(int argc, char **argv)
{
    const size_t n = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 1000000;
    const int repetitions = argc > 2 ? (int)strtol(argv[2], NULL, 10) : 5;
    if (n < 1 || repetitions < 1) {
        fprintf(stderr, "usage: nurbs_core [evaluations] [repetitions]\n");
        return 2;
    }
    printf("%-34s %10s %10s\n", "", "libnurbs", "SISL");
    for (int rational = 0; rational < 2; rational++) {
        bench_evaluation(90, 25, rational, n, repetitions);
        bench_evaluation(200, 200, rational, n, repetitions);
    }
    bench_curve(25, n, repetitions);
    bench_curve(200, n, repetitions);
    bench_changes(10 * repetitions); /* short calls: until memory is warm */
    for (int own = 0; own < 2; own++)
        bench_skin(own, repetitions);
    bench_interpolation(repetitions);
    bench_grid_fit(1e-2, repetitions);
    bench_grid_fit(1e-3, repetitions);
    bench_curve_fit(1e-3, repetitions);
    bench_curve_fit(1e-5, repetitions);
    bench_closest(repetitions);
    bench_simplifications(repetitions);
    return 0;
}
