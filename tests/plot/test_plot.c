/* The drawing kit: ticks of awkward ranges, text that does not collide, sheets that parse, files of
 * the right kind and size. */
#include "check.h"
#include "plot/ship.h"

#include <cairo.h>
#include <ctype.h>
#include <string.h>
#include <unistd.h>

static size_t check_ticks(struct plot_axis axis, bool nice)
{
    double value[PLOT_TICKS];
    char text[PLOT_TICKS][24];
    if (nice)
        plot_nice(&axis, 5);
    else
        plot_settle(&axis);
    CU_ASSERT_TRUE(isfinite(axis.low) && isfinite(axis.high) && axis.low < axis.high);
    size_t n = plot_ticks(&axis, 5, value, text);
    CU_ASSERT_TRUE(n <= 14 && (n >= 2 || (axis.log && !nice)));
    for (size_t k = 0; k < n; k++) {
        CU_ASSERT_TRUE(strlen(text[k]) > 0);
        CU_ASSERT_TRUE(k == 0 || strcmp(text[k], text[k - 1]) != 0);
        CU_ASSERT_TRUE(!axis.whole || !strchr(text[k], '.') || strchr(text[k], 'e'));
        double share = (value[k] - axis.low) / (axis.high - axis.low);
        CU_ASSERT_TRUE(share > -1e-6 && share < 1 + 1e-6);
    }
    return n;
}

static void test_ticks(void)
{
    static const double ranges[][2] = {{0, 9.3},
                                       {-0.013, 0.021},
                                       {3.1e-3, 7.7e-3},
                                       {2, 2},
                                       {0, 0},
                                       {-5, -5},
                                       {5, -5},
                                       {-1e300, 1e300},
                                       {1e-300, 2e-300},
                                       {-1e9 - 1, -1e9},
                                       {1e9, 1e9 + 1e-6},
                                       {NAN, 1},
                                       {-INFINITY, 3},
                                       {0, INFINITY},
                                       {123456, 123461},
                                       {1e-7, 1.5e-7},
                                       {-1e-12, 1e-12},
                                       {INFINITY, -INFINITY}};
    for (size_t k = 0; k < sizeof ranges / sizeof *ranges; k++)
        for (int kind = 0; kind < 6; kind++)
            check_ticks((struct plot_axis){.low = ranges[k][0],
                                           .high = ranges[k][1],
                                           .log = kind / 2 == 1,
                                           .whole = kind / 2 == 2},
                        kind % 2);
    double value[PLOT_TICKS];
    char text[PLOT_TICKS][24];
    struct plot_axis axis = {.low = 3.1e-3, .high = 7.7e-3};
    plot_nice(&axis, 5);
    CHECK_CLOSE(axis.low, 3e-3, 1e-15);
    CHECK_CLOSE(axis.high, 8e-3, 1e-15);
    axis.unit = 1000;
    CU_ASSERT_EQUAL(plot_ticks(&axis, 5, value, text), 6);
    CU_ASSERT_STRING_EQUAL(text[1], "4");
    CHECK_CLOSE(value[1], 4e-3, 1e-15);
    axis = (struct plot_axis){.low = 0, .high = 3, .whole = true};
    CU_ASSERT_EQUAL(plot_ticks(&axis, 12, value, text), 4);
    axis = (struct plot_axis){.low = 1e-4, .high = 1, .log = true};
    CU_ASSERT_EQUAL(plot_ticks(&axis, 8, value, text), 5);
    CU_ASSERT_STRING_EQUAL(text[0], "10⁻⁴");
    axis = (struct plot_axis){.low = -0.4, .high = 0.4};
    plot_ticks(&axis, 4, value, text);
    CU_ASSERT_STRING_EQUAL(text[0], "−0.4");
}

static void test_frame(void)
{
    struct plot_frame f = {10, 20, 100, 50, {.low = -1, .high = 3}, {.low = 0, .high = 4}};
    CHECK_CLOSE(plot_x(&f, -1), 10, 1e-12);
    CHECK_CLOSE(plot_x(&f, 3), 110, 1e-12);
    CHECK_CLOSE(plot_y(&f, 0), 70, 1e-12);
    CHECK_CLOSE(plot_y(&f, 4), 20, 1e-12);
    f.y = (struct plot_axis){.low = 1e-4, .high = 1, .log = true};
    CHECK_CLOSE(plot_y(&f, 1e-2), 45, 1e-12);
}

static void test_escape(void)
{
    char text[200] = "";
    FILE *out = fmemopen(text, sizeof text, "w");
    plot_escape(out, "a < b & \"c\" > d\x01");
    fclose(out);
    CU_ASSERT_STRING_EQUAL(text, "a &lt; b &amp; &quot;c&quot; &gt; d");
}

static double luminance(const unsigned char c[3])
{
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

static void test_maps(void)
{
    unsigned char c[3], previous[3], mirror[3];
    plot_colour(PLOT_SEQUENTIAL, 0, previous);
    CU_ASSERT_TRUE(previous[2] > previous[0] && previous[2] > previous[1]);
    for (int k = 1; k <= 50; k++) {
        plot_colour(PLOT_SEQUENTIAL, k / 50.0, c);
        CU_ASSERT_TRUE(luminance(c) >= luminance(previous));
        memcpy(previous, c, 3);
    }
    CU_ASSERT_TRUE(c[0] > 200 && c[1] > 200 && c[2] < 100);
    plot_colour(PLOT_DIVERGING, 0.5, c);
    CU_ASSERT_TRUE(c[0] > 240 && c[1] > 240 && c[2] > 240);
    plot_colour(PLOT_DIVERGING, 0, c);
    plot_colour(PLOT_DIVERGING, 1, mirror);
    CU_ASSERT_TRUE(c[2] > c[0] && mirror[0] > mirror[2]);
    plot_colour(PLOT_DIVERGING, NAN, c);
    plot_colour(PLOT_SEQUENTIAL, 7, c);
    CU_ASSERT_EQUAL(c[0], 250);
}

/* Elements closed in order, attributes quoted, no bare & or <, no number that is none. */
static bool is_well_formed(const char *text)
{
    const char *open[64];
    size_t depth = 0;
    if (strstr(text, "nan") || strstr(text, "inf"))
        return false;
    for (const char *p = strchr(text, '<'); p; p = strchr(p, '<')) {
        const char *end = p[1] == '!' ? strstr(p, "-->") : p;
        bool quoted = false;
        for (; p[1] != '!' && *end && (quoted || *end != '>'); end++) {
            quoted ^= *end == '"';
            if (quoted && *end == '<')
                return false;
        }
        if (!end || !*end)
            return false;
        size_t name = strcspn(p + 1 + (p[1] == '/'), " />\n");
        if (p[1] == '/') {
            if (!depth || strncmp(open[--depth] + 1, p + 2, name) || isalpha(open[depth][1 + name]))
                return false;
        } else if (p[1] != '!' && p[1] != '?' && end[-1] != '/') {
            if (depth == 64)
                return false;
            open[depth++] = p;
        }
        p = end;
    }
    for (const char *p = strchr(text, '&'); p; p = strchr(p + 1, '&'))
        if (strncmp(p, "&lt;", 4) && strncmp(p, "&gt;", 4) && strncmp(p, "&amp;", 5) &&
            strncmp(p, "&quot;", 6))
            return false;
    return depth == 0;
}

static bool boxes_apart(const struct plot *plot)
{
    for (size_t i = 0; i < plot->n_boxes; i++)
        for (size_t j = 0; j < i; j++) {
            const struct plot_box *a = &plot->boxes[i], *b = &plot->boxes[j];
            if (a->left < b->right && b->left < a->right && a->top < b->bottom &&
                b->top < a->bottom)
                return false;
        }
    return true;
}

/* Checks the sheet and frees it. */
static void check_sheet(struct plot *plot)
{
    CU_ASSERT_TRUE(boxes_apart(plot));
    for (size_t k = 0; k < plot->n_boxes; k++)
        CU_ASSERT_TRUE(plot->boxes[k].left > -1 && plot->boxes[k].right < plot->width + 1 &&
                       plot->boxes[k].top > -1 && plot->boxes[k].bottom < plot->height + 1);
    char *text = NULL;
    size_t size = 0;
    FILE *page = open_memstream(&text, &size);
    plot_embed(plot, page);
    fclose(page);
    CU_ASSERT_TRUE(is_well_formed(text));
    free(text);
}

static void draw_chart(struct plot *plot, bool log)
{
    static const double x[] = {1, 2, NAN, 3, 4}, y[] = {1e-3, -2, 5, INFINITY, 7};
    struct plot_frame f = {.left = 80, .top = 30, .width = 300, .height = 200};
    f.x = (struct plot_axis){.low = INFINITY, .high = -INFINITY, .label = "x <m>"};
    f.y =
        (struct plot_axis){.low = INFINITY, .high = -INFINITY, .log = log, .label = "C_{w} & more"};
    plot_include(&f.x, 5, x);
    plot_include(&f.y, 5, y);
    CU_ASSERT_TRUE(plot_open(plot, 400, 280, "A \"chart\" & <more>"));
    plot_axes(plot, &f);
    plot_curve(plot, &f, 5, x, y, (struct plot_pen){PLOT_BLUE, 1, "2 3"});
    plot_band(plot, &f, 5, x, y, y, PLOT_RED);
    plot_mark(plot, plot_x(&f, 2), plot_y(&f, NAN), PLOT_RING, 3, PLOT_RED, "a & b");
    plot_mark(plot, 100, 100, PLOT_CROSS, 3, PLOT_RED, "<a>");
}

static void test_charts(void)
{
    struct plot plot;
    for (int log = 0; log < 2; log++) {
        draw_chart(&plot, log);
        check_sheet(&plot);
    }
}

/* More labels than there is room for: those that are put stand apart. */
static void test_crowd(void)
{
    struct plot plot;
    size_t put = 0;
    CU_ASSERT_TRUE(plot_open(&plot, 300, 100, "crowd"));
    for (int k = 0; k < 500; k++)
        put += plot_label(&plot, 17 * k % 331, 13 * k % 109, 10, PLOT_MIDDLE, PLOT_INK, "%d", k);
    CU_ASSERT_TRUE(put > 20 && put < 200);
    check_sheet(&plot);
}

static void test_history(void)
{
    static struct plot_trial trials[60];
    for (size_t k = 0; k < 60; k++)
        trials[k] = (struct plot_trial){.number = (double)k,
                                        .value = k == 30 ? 1e30 : 1 / (1.0 + (double)k),
                                        .initial = k < 20,
                                        .infeasible = k % 7 == 0,
                                        .failed = k % 9 == 0};
    for (size_t n = 0; n <= 60; n += 20) {
        const struct plot_history history = {n, trials, n == 60 ? 0.3 : NAN, 1000, "10³ C_{w}"};
        struct plot plot;
        CU_ASSERT_TRUE(plot_open(&plot, 900, 400, "history"));
        plot_history(&plot, 0, 0, 900, 400, &history);
        check_sheet(&plot);
    }
}

static double slope(const void *user_data, double x, double y)
{
    return x + y + *(const double *)user_data;
}

static void test_fields(void)
{
    static const double x[] = {0, 0, 0, 1, 1, 1, 2, 2, 2}, y[] = {0, 1, 2, 0, 1, 2, 0, 1, 2},
                        value[] = {0, 1, 2, 1, NAN, 3, 2, 3, 4}, zero = 0;
    const struct plot_field field = {3, 3, x, y, value};
    struct plot_scale scale = {PLOT_DIVERGING, {.low = -3, .high = 3, .label = "mm"}};
    struct plot_frame f = {20, 20, 100, 100, {.low = 0, .high = 2}, {.low = 0, .high = 2}};
    struct plot plot;
    CU_ASSERT_TRUE(plot_open(&plot, 200, 140, "fields"));
    plot_raster(&plot, &f, 7, 5, &scale, slope, &zero);
    plot_cells(&plot, &f, &field, &scale);
    plot_isolines(&plot, &f, &field, 0.5, (struct plot_pen){PLOT_INK, 1, NULL});
    plot_bar(&plot, 130, 20, 10, 100, &scale);
    CU_ASSERT_TRUE(plot.n_boxes >= 4);
    check_sheet(&plot);
}

static void test_waves(void)
{
    static double zeta[60 * 20];
    static double edge[] = {-1, 0, 0, 0.1, 1, 0};
    for (size_t k = 0; k < 60 * 20; k++)
        zeta[k] = k % 20 == 0 ? NAN : 0.01 * sin((double)k);
    const struct plot_waves waves[2] = {{"original", 60, 20, 3, -4, 0.1, 0, 0.1, zeta, edge},
                                        {"optimum", 60, 20, 3, -4, 0.1, 0, 0.1, zeta, edge}};
    CU_ASSERT_TRUE(isfinite(plot_wave_at(&waves[0], 0, 0)));
    CU_ASSERT_TRUE(isfinite(plot_wave_at(&waves[0], 1e9, -1e9)));
    for (size_t n = 1; n <= 2; n++) {
        struct plot plot;
        CU_ASSERT_TRUE(plot_wave_pattern(&plot, 900, n, waves));
        check_sheet(&plot);
    }
}

static void test_lines(void)
{
    static const char *const names[] = {"dtmb5415", "wigley", "fast", "sphere", "bulb"};
    for (size_t k = 0; k < 5; k++) {
        char path[300];
        nurbs_patches *patches = NULL;
        struct plot plot;
        snprintf(path, sizeof path, EXAMPLES_DIR "/hulls/%s.json", names[k]);
        CU_ASSERT_EQUAL_FATAL(nurbs_patches_read(path, &patches), NURBS_OK);
        const nurbs_surface *surface = nurbs_patches_get(patches, 0);
        const struct plot_hull hulls[2] = {{"original", 1, &surface, {PLOT_ORIGINAL, 1, "5 3"}},
                                           {"optimum", 1, &surface, {PLOT_OPTIMUM, 1, NULL}}};
        double length = nurbs_patches_length(patches), aft = k == 1 || k == 3 ? -length / 2 : 0;
        const struct plot_lines lines = {{aft, aft + length}, 0, k ? 20 : 40, 12, 5};
        CU_ASSERT_TRUE(plot_lines_plan(&plot, 1200, &lines, 2, hulls));
        check_sheet(&plot);
        nurbs_patches_free(patches);
    }
}

static void test_files(void)
{
    char path[300], start[5] = "";
    struct plot plot;
    CU_ASSERT_TRUE(plot_is_picture("a.b/c.SVG") && plot_is_picture("x.pdf"));
    CU_ASSERT_FALSE(plot_is_picture("svg") || plot_is_picture("a.svg/b"));
    for (int k = 0; k < 3; k++) {
        static const char *const ends[] = {"svg", "png", "pdf"}, *const begins[] = {
                                                                     "<?xm", "\x89PNG", "%PDF"};
        snprintf(path, sizeof path, "%s/test_plot_%ld.%s", check_scratch(), (long)getpid(),
                 ends[k]);
        draw_chart(&plot, false);
        plot.scale = 1.5;
        CU_ASSERT_TRUE(plot_save(&plot, path));
        FILE *file = fopen(path, "rb");
        CU_ASSERT_PTR_NOT_NULL_FATAL(file);
        CU_ASSERT_EQUAL(fread(start, 1, 4, file), 4);
        fclose(file);
        CU_ASSERT_STRING_EQUAL(start, begins[k]);
        if (k == 1) {
            cairo_surface_t *image = cairo_image_surface_create_from_png(path);
            CU_ASSERT_EQUAL(cairo_image_surface_get_width(image), 600);
            CU_ASSERT_EQUAL(cairo_image_surface_get_height(image), 420);
            cairo_surface_destroy(image);
        }
        remove(path);
    }
    draw_chart(&plot, false);
    CU_ASSERT_FALSE(plot_save(&plot, "/no/such/folder/plot.svg"));
}

static const struct check_case cases[] = {
    {"ticks", test_ticks},       {"frames", test_frame},  {"escaped text", test_escape},
    {"colour maps", test_maps},  {"charts", test_charts}, {"crowded labels", test_crowd},
    {"history", test_history},   {"fields", test_fields}, {"wave patterns", test_waves},
    {"lines plans", test_lines}, {"files", test_files},
};

CHECK_MAIN("plot", cases)
