/* Damaged files: readers must answer with a status and a sentence, whatever the bytes. Valid files
 * are cut, overwritten, repeated and spliced by a fixed random stream, and IGES and STEP files also
 * cut behind and changed at every STEPth byte; the sanitizer build watches the memory. More:
 * FUZZ_ROUNDS=100000 fuzz_files, which also takes every byte. */
#include "check.h"

#include <nurbs/nurbs.h>

#include <stdint.h>
#include <string.h>
#include <unistd.h>

enum { LARGEST = 1 << 16, DEFAULT_ROUNDS = 400, STEP = 37 };

static uint64_t next(uint64_t *state)
{
    uint64_t z = (*state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

static size_t below(uint64_t *state, size_t n)
{
    return n ? (size_t)(next(state) % n) : 0;
}

static size_t load(const char *path, char *bytes)
{
    FILE *stream = fopen(path, "rb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(stream);
    size_t n = fread(bytes, 1, LARGEST, stream);
    fclose(stream);
    CU_ASSERT_TRUE_FATAL(n > 0);
    return n;
}

/* One to four changes of the kinds that transfers, editors and wrong programs make. */
static size_t damage(uint64_t *state, size_t n, char *bytes)
{
    static const char *const tokens[] = {"nan", "1e999", "-", "99999999999", ",,", "\n",
                                         "0",   "]",     ";"};
    for (size_t k = 1 + below(state, 4); k > 0 && n > 1; k--) {
        size_t at = below(state, n), length = 1 + below(state, 40);
        if (length > n - at)
            length = n - at;
        const char *token = tokens[below(state, sizeof tokens / sizeof *tokens)];
        switch (below(state, 5)) {
        case 0: /* truncated */
            n = at + 1;
            break;
        case 1: /* another byte */
            bytes[at] = (char)below(state, 256);
            break;
        case 2: /* another token */
            for (size_t i = 0; token[i] && at + i < n; i++)
                bytes[at + i] = token[i];
            break;
        case 3: /* a piece lost */
            memmove(bytes + at, bytes + at + length, n - at - length);
            n -= length;
            break;
        default: /* a piece from elsewhere */
            memmove(bytes + at, bytes + below(state, n - length + 1), length);
        }
    }
    return n;
}

static void check_mesh(const char *path)
{
    nurbs_mesh *mesh = NULL;
    nurbs_hydrostatics result;
    nurbs_contour contour;
    nurbs_status status = nurbs_mesh_read(path, 1, &mesh);
    CU_ASSERT_TRUE(status == NURBS_OK || (!mesh && strlen(nurbs_last_error()) > 10));
    if (status == NURBS_OK) {
        nurbs_mesh_hydrostatics(mesh, 0, &result);
        if (nurbs_mesh_section(mesh, (const double[]){1, 0, 0}, 0.1, &contour) == NURBS_OK)
            nurbs_contour_free(&contour);
    }
    nurbs_mesh_free(mesh);
}

static void check_sections(const char *path)
{
    nurbs_grid *grid = NULL;
    nurbs_status status = strstr(path, ".stations") ? nurbs_stations_read(path, 0, &grid)
                                                    : nurbs_offsets_read(path, 0, &grid, NULL);
    CU_ASSERT_TRUE(status == NURBS_OK || (!grid && strlen(nurbs_last_error()) > 10));
    nurbs_grid_free(grid);
}

static void check_reader(const char *path, int grid)
{
    if (strstr(path, ".offsets.csv") || strstr(path, ".stations")) {
        check_sections(path);
        return;
    }
    if (strstr(path, ".stl") || strstr(path, ".obj")) {
        check_mesh(path);
        return;
    }
    nurbs_patches *patches = NULL;
    nurbs_grid *points = NULL;
    char report[512];
    nurbs_status status = NURBS_OK;
    if (grid)
        status = nurbs_grid_read(path, &points);
    else if (strstr(path, ".igs") || strstr(path, ".step"))
        status = nurbs_patches_read_reported(path, 1e-2, &patches, report, sizeof report);
    else
        status = nurbs_patches_read_json(path, &patches);
    if (status == NURBS_OK)
        CU_ASSERT_TRUE(grid ? points != NULL : patches != NULL);
    if (status != NURBS_OK) {
        CU_ASSERT_PTR_NULL(points);
        CU_ASSERT_PTR_NULL(patches);
        CU_ASSERT_TRUE(strlen(nurbs_last_error()) > 10);
    }
    nurbs_grid_free(points);
    nurbs_patches_free(patches);
    if (!grid && strstr(path, ".igs")) {
        size_t n;
        nurbs_curve **curves;
        status = nurbs_curves_read_iges(path, &n, &curves);
        CU_ASSERT_TRUE(status == NURBS_OK || (n == 0 && !curves));
        nurbs_curves_free(n, curves);
    }
}

static void fuzz(const char *source, const char *extension, int grid)
{
    static char original[LARGEST], bytes[LARGEST];
    const char *folder = getenv("TMPDIR"), *wanted = getenv("FUZZ_ROUNDS");
    size_t n = load(source, original), rounds = wanted ? strtoul(wanted, NULL, 10) : DEFAULT_ROUNDS;
    char path[512];
    snprintf(path, sizeof path, "%s/fuzz_files_%ld%s", folder ? folder : "/tmp", (long)getpid(),
             extension);
    uint64_t state = 20240901;
    for (size_t r = 0; r < rounds; r++) {
        memcpy(bytes, original, n);
        size_t m = damage(&state, n, bytes);
        FILE *stream = fopen(path, "wb");
        CU_ASSERT_PTR_NOT_NULL_FATAL(stream);
        CU_ASSERT_EQUAL(fwrite(bytes, 1, m, stream), m);
        fclose(stream);
        check_reader(path, grid);
    }
    unlink(path);
}

static void check_bytes(const char *path, size_t n, const char *bytes)
{
    FILE *stream = fopen(path, "wb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(stream);
    CU_ASSERT_EQUAL(fwrite(bytes, 1, n, stream), n);
    fclose(stream);
    check_reader(path, 0);
}

/* Every beginning of a file, and every byte replaced by those that mean something in the format. */
static void sweep(const char *source, const char *extension, const char instead[10])
{
    enum { CHOICES = 10 };
    static char original[LARGEST];
    const char *folder = getenv("TMPDIR");
    size_t n = load(source, original), step = getenv("FUZZ_ROUNDS") ? 1 : STEP;
    char path[512];
    snprintf(path, sizeof path, "%s/fuzz_sweep_%ld%s", folder ? folder : "/tmp", (long)getpid(),
             extension);
    for (size_t k = 0; k < n; k += step) {
        char before = original[k];
        check_bytes(path, k, original);
        for (size_t i = 0; i < CHOICES; i++) {
            original[k] = instead[step == 1 ? i : (k / step) % CHOICES];
            check_bytes(path, n, original);
            if (step > 1)
                break;
        }
        original[k] = before;
    }
    unlink(path);
}

static void test_iges_bytes(void)
{
    static const char *const files[] = {"iges_trimmed_curved.igs", "iges_trimmed_face.igs",
                                        "iges_curves.igs",         "iges_transformed.igs",
                                        "occt_trimmed_brep.igs",   "occt_rational.igs",
                                        "occt_barge.igs"};
    static const char instead[10] = {'9', '-', ',', ';', 'H', ' ', '\n', 'D', '\0', (char)0xff};
    for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", TEST_DATA_DIR, files[k]);
        sweep(path, ".igs", instead);
    }
}

static void test_step_bytes(void)
{
    static const char *const files[] = {"occt_barge_m.step", "occt_swept.step",
                                        "occt_assembly.step"};
    static const char instead[10] = {'9', '#', ',', ')', '(', '\'', '\n', '*', '\0', (char)0xff};
    for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", TEST_DATA_DIR, files[k]);
        sweep(path, ".step", instead);
    }
}

static void test_json(void)
{
    fuzz(EXAMPLES_DIR "/hulls/spheroid.json", ".json", 0);
}

static void test_iges(void)
{
    const char *folder = getenv("TMPDIR");
    char path[512];
    nurbs_patches *patches = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_read(EXAMPLES_DIR "/hulls/spheroid.json", &patches),
                          NURBS_OK);
    snprintf(path, sizeof path, "%s/fuzz_source_%ld.igs", folder ? folder : "/tmp", (long)getpid());
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_write_iges(patches, path), NURBS_OK);
    nurbs_patches_free(patches);
    fuzz(path, ".igs", 0);
    unlink(path);
}

/* A damaged file may ask for long work, but for no other answer than a status. */
static void test_step(void)
{
    fuzz(TEST_DATA_DIR "/occt_barge.step", ".step", 0);
}

static void test_stl(void)
{
    const char *folder = getenv("TMPDIR");
    char path[512];
    nurbs_patches *patches = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_read(EXAMPLES_DIR "/hulls/spheroid.json", &patches),
                          NURBS_OK);
    snprintf(path, sizeof path, "%s/fuzz_source_%ld.stl", folder ? folder : "/tmp", (long)getpid());
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_write_stl(patches, 2, path), NURBS_OK);
    nurbs_patches_free(patches);
    fuzz(path, ".stl", 0);
    unlink(path);
}

static void test_obj(void)
{
    const char *folder = getenv("TMPDIR");
    char path[512];
    snprintf(path, sizeof path, "%s/fuzz_source_%ld.obj", folder ? folder : "/tmp", (long)getpid());
    FILE *stream = fopen(path, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(stream);
    for (int k = 0; k < 20; k++)
        fprintf(stream, "v %d %g %g\n", k / 5, 0.1 * (k % 5), -0.2 * (k % 5));
    for (int k = 0; k < 14; k++)
        fprintf(stream, "f %d/1 %d/2/3 -%d\n", k + 1, k + 2, k + 1);
    fclose(stream);
    fuzz(path, ".obj", 0);
    unlink(path);
}

static void test_offsets(void)
{
    static const char instead[10] = {'9', '-', ',', '#', 'k', ' ', '\n', '.', '\0', (char)0xff};
    fuzz(EXAMPLES_DIR "/hulls/series60.offsets.csv", ".offsets.csv", 0);
    sweep(EXAMPLES_DIR "/hulls/series60.offsets.csv", ".offsets.csv", instead);
}

static void test_stations(void)
{
    const char *folder = getenv("TMPDIR");
    char path[512];
    snprintf(path, sizeof path, "%s/fuzz_source_%ld.stations", folder ? folder : "/tmp",
             (long)getpid());
    FILE *stream = fopen(path, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(stream);
    for (int k = 0; k < 20; k++)
        fprintf(stream, k % 5 ? "%d, %g\n" : "%d\n", k % 5 ? 5 - k % 5 : k, -0.2 * (k % 5));
    fclose(stream);
    fuzz(path, ".stations", 0);
    unlink(path);
}

static void test_grid(void)
{
    const char *folder = getenv("TMPDIR");
    char path[512];
    nurbs_grid *grid = NULL;
    double points[3 * 4 * 5];
    for (int k = 0; k < 20; k++) {
        points[3 * k] = k / 5;
        points[3 * k + 1] = 0.1 * (k % 5);
        points[3 * k + 2] = -0.2 * (k % 5);
    }
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(4, 5, points, &grid), NURBS_OK);
    snprintf(path, sizeof path, "%s/fuzz_source_%ld.csv", folder ? folder : "/tmp", (long)getpid());
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_write(grid, path), NURBS_OK);
    nurbs_grid_free(grid);
    fuzz(path, ".csv", 1);
    unlink(path);
}

static const struct check_case cases[] = {
    {"damaged NURBS files", test_json},
    {"damaged IGES files", test_iges},
    {"every byte of IGES files", test_iges_bytes},
    {"damaged STEP files", test_step},
    {"every byte of STEP files", test_step_bytes},
    {"damaged STL files", test_stl},
    {"damaged OBJ files", test_obj},
    {"damaged offset tables", test_offsets},
    {"damaged station files", test_stations},
    {"damaged grids", test_grid},
};

CHECK_MAIN("damaged files", cases)
