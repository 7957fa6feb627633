/* The pieces of the drawings: scales, colours, the picture format. */
#include "check.h"
#include "report/png.h"
#include "report/svg.h"

#include <string.h>

static void test_frame(void)
{
    const struct svg_frame f = {
        .left = 10, .top = 20, .width = 100, .height = 50, .x0 = -1, .x1 = 3, .y0 = 0, .y1 = 4};
    CHECK_CLOSE(svg_x(&f, -1), 10, 1e-12);
    CHECK_CLOSE(svg_x(&f, 3), 110, 1e-12);
    CHECK_CLOSE(svg_y(&f, 0), 70, 1e-12);
    CHECK_CLOSE(svg_y(&f, 4), 20, 1e-12);
    struct svg_frame g = f;
    g.log_y = true;
    g.y0 = 1e-4;
    g.y1 = 1;
    CHECK_CLOSE(svg_y(&g, 1e-2), 45, 1e-12);
}

static void check_nice(double low, double high, double expected_low, double expected_high)
{
    svg_nice(&low, &high);
    CHECK_CLOSE(low, expected_low, 1e-12);
    CHECK_CLOSE(high, expected_high, 1e-12);
}

static void test_nice(void)
{
    check_nice(0, 9.3, 0, 10);
    check_nice(-0.013, 0.021, -0.015, 0.025);
    check_nice(3.1e-3, 7.7e-3, 3e-3, 8e-3);
    double low = 2, high = 2;
    svg_nice(&low, &high);
    CU_ASSERT_TRUE(low < 2 && high > 2);
}

static void test_escape(void)
{
    char text[200] = "";
    FILE *out = fmemopen(text, sizeof text, "w");
    svg_escape(out, "a < b & \"c\" > d\x01");
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
    svg_map_sequential(0, previous);
    CU_ASSERT_TRUE(previous[2] > previous[0] && previous[2] > previous[1]);
    for (int k = 1; k <= 50; k++) {
        svg_map_sequential(k / 50.0, c);
        CU_ASSERT_TRUE(luminance(c) >= luminance(previous));
        memcpy(previous, c, 3);
    }
    CU_ASSERT_TRUE(c[0] > 200 && c[1] > 200 && c[2] < 100);
    svg_map_diverging(0.5, c);
    CU_ASSERT_TRUE(c[0] > 240 && c[1] > 240 && c[2] > 240);
    svg_map_diverging(0, c);
    svg_map_diverging(1, mirror);
    CU_ASSERT_TRUE(c[2] > c[0] && mirror[0] > mirror[2]);
    svg_map_diverging(NAN, c);
    svg_map_sequential(7, c);
    CU_ASSERT_EQUAL(c[0], 250);
}

static int digit(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *found = c ? strchr(digits, c) : NULL;
    return found ? (int)(found - digits) : 0;
}

static size_t decode(const char *text, unsigned char *out)
{
    size_t n = 0;
    for (; *text; text += 4) {
        int word =
            digit(text[0]) << 18 | digit(text[1]) << 12 | digit(text[2]) << 6 | digit(text[3]);
        out[n++] = (unsigned char)(word >> 16);
        if (text[2] != '=')
            out[n++] = (unsigned char)(word >> 8);
        if (text[3] != '=')
            out[n++] = (unsigned char)word;
    }
    return n;
}

static size_t big_endian(const unsigned char *b)
{
    return (size_t)b[0] << 24 | (size_t)b[1] << 16 | (size_t)b[2] << 8 | b[3];
}

/* A picture of more than one stored block comes back pixel by pixel, and the checksum of the empty
 * last chunk is the one every PNG has. */
static void test_png(void)
{
    enum { WIDTH = 301, HEIGHT = 307 };
    static const char prefix[] = "data:image/png;base64,";
    static unsigned char pixels[WIDTH * HEIGHT], palette[256][3], file[200000], lines[110000];
    for (size_t k = 0; k < sizeof pixels; k++)
        pixels[k] = (unsigned char)(k * k % 251);
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    CU_ASSERT_TRUE(png_data_uri(out, WIDTH, HEIGHT, pixels, (const unsigned char(*)[3])palette));
    fclose(out);
    CU_ASSERT_EQUAL_FATAL(strncmp(text, prefix, sizeof prefix - 1), 0);
    size_t n = decode(text + sizeof prefix - 1, file);
    free(text);
    CU_ASSERT_EQUAL(memcmp(file, "\x89PNG\r\n\x1a\n", 8), 0);
    CU_ASSERT_EQUAL(big_endian(file + 16), WIDTH);
    CU_ASSERT_EQUAL(big_endian(file + 20), HEIGHT);
    CU_ASSERT_EQUAL(memcmp(file + n - 8, "IEND\xae\x42\x60\x82", 8), 0);

    const unsigned char *data = file + 33 + 12 + 768;
    CU_ASSERT_EQUAL_FATAL(memcmp(data + 4, "IDAT", 4), 0);
    size_t got = 0;
    for (const unsigned char *block = data + 8 + 2;;) {
        size_t stored = block[1] | (size_t)block[2] << 8;
        CU_ASSERT_EQUAL(stored ^ 0xffff, (block[3] | (size_t)block[4] << 8));
        memcpy(lines + got, block + 5, stored);
        got += stored;
        if (block[0])
            break;
        block += 5 + stored;
    }
    CU_ASSERT_EQUAL_FATAL(got, (WIDTH + 1) * HEIGHT);
    for (size_t j = 0; j < HEIGHT; j++)
        CU_ASSERT_EQUAL(memcmp(lines + j * (WIDTH + 1) + 1, pixels + j * WIDTH, WIDTH), 0);
}

static const struct check_case cases[] = {
    {"frames", test_frame},     {"nice limits", test_nice}, {"escaped text", test_escape},
    {"colour maps", test_maps}, {"pictures", test_png},
};

CHECK_MAIN("hullopt drawing", cases)
