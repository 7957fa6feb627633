/* A program compiled with release 0.2.0, as far as memory goes: it knows no header of today,
 * allocates for options and results the bytes that 0.2.0 promised, and looks whether a call writes
 * beyond them. A size here never changes while the soname's number is 1; structures added later are
 * added. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void nurbs_hull_options_init(void *);
void nurbs_skin_options_init(void *);
void galv_options_init(void *);
void bayesopt_options_init(void *);
void bayesopt_design_options_init(void *);
void bayesopt_gp_options_init(void *);
void igabem_options_init(void *);
void igabem_kelvin_filter_init(void *);
void igabem_matrix_options_init(void *);
int nurbs_make_ellipsoid(double, double, double, double, void **);
void nurbs_surface_free(void *);
int igabem_hull_create(void *const *, size_t, unsigned, void **);
void igabem_hull_get_info(const void *, void *);
void igabem_hull_free(void *);
int igabem_solve(const void *, const void *, void **);
int igabem_forces_compute(const void *, void *);
void igabem_solution_free(void *);
int bayesopt_create(size_t, const double *, const double *, const void *, void **);
int bayesopt_ask(void *, size_t, double *, uint64_t *);
int bayesopt_get(const void *, size_t, void *);
void bayesopt_free(void *);

enum { FILL = 0xa5 };
static unsigned char room[4096];
static int failures;

static void *fresh(void)
{
    memset(room, FILL, sizeof room);
    return room;
}

static void check(const char *what, size_t size)
{
    size_t used = sizeof room;
    while (used > 0 && room[used - 1] == FILL)
        used--;
    if (used > size || used == 0) {
        printf("%s: %zu bytes promised, %zu written\n", what, size, used);
        failures++;
    }
}

static void must(int status, const char *what)
{
    if (status != 0) {
        printf("%s failed with %d\n", what, status);
        exit(1);
    }
}

static void options(void)
{
    const struct {
        const char *name;
        void (*init)(void *);
        size_t size;
    } all[] = {
        {"nurbs_hull_options", nurbs_hull_options_init, 136},
        {"nurbs_skin_options", nurbs_skin_options_init, 112},
        {"galv_options", galv_options_init, 144},
        {"bayesopt_options", bayesopt_options_init, 328},
        {"bayesopt_design_options", bayesopt_design_options_init, 136},
        {"bayesopt_gp_options", bayesopt_gp_options_init, 152},
        {"igabem_options", igabem_options_init, 280},
        {"igabem_kelvin_filter", igabem_kelvin_filter_init, 80},
        {"igabem_matrix_options", igabem_matrix_options_init, 168},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        all[i].init(fresh());
        check(all[i].name, all[i].size);
    }
}

/* Results: a small solve without waves, and a point of a search. */
static void results(void)
{
    void *surface, *hull, *flow, *search;
    const size_t forces = 328, info = 304, point = 168;
    double settings[280 / sizeof(double)], lower[2] = {0, 0}, upper[2] = {1, 1}, x[2];
    uint64_t id;
    igabem_options_init(settings);
    settings[0] = 0.5; /* froude */
    const int double_body = 1, one = 1;
    memcpy((char *)settings + 24, &double_body, sizeof double_body);
    memcpy((char *)settings + 32, &one, sizeof one);
    must(nurbs_make_ellipsoid(2, 0.4, 0.4, 1, &surface), "nurbs_make_ellipsoid");
    must(igabem_hull_create(&surface, 1, 1, &hull), "igabem_hull_create");
    igabem_hull_get_info(hull, fresh());
    check("igabem_hull_info", info);
    must(igabem_solve(hull, settings, &flow), "igabem_solve");
    must(igabem_forces_compute(flow, fresh()), "igabem_forces_compute");
    check("igabem_forces", forces);
    igabem_solution_free(flow);
    igabem_hull_free(hull);
    nurbs_surface_free(surface);
    must(bayesopt_create(2, lower, upper, NULL, &search), "bayesopt_create");
    must(bayesopt_ask(search, 1, x, &id), "bayesopt_ask");
    must(bayesopt_get(search, 0, fresh()), "bayesopt_get");
    check("bayesopt_point", point);
    bayesopt_free(search);
}

int main(void)
{
    options();
    results();
    return failures ? EXIT_FAILURE : EXIT_SUCCESS;
}
