/* Families that move points along x and z too, against what is known of the hulls: a translation
 * changes no C_w, a hull that rises has the volume, the beam and the draft of a closed form, and
 * moved control points are those of the moved surface. */
#include "check.h"
#include "core/constraints.h"
#include "core/evaluate.h"
#include "core/particulars.h"
#include "core/residuals.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char path[200], shape_path[210];
static struct config config;
static struct problem problem;

static void say_why(bool ok)
{
    if (!ok)
        fprintf(stderr, "%s\n", core_sentence());
    CU_ASSERT_TRUE_FATAL(ok);
}

static void write_text(const char *to, const char *text)
{
    FILE *file = fopen(to, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    fputs(text, file);
    fclose(file);
}

/* In the space of the parameters themselves. */
static void read_problem(const char *hull, const char *shape, const char *rest)
{
    const struct core_watch nobody = {0};
    char text[2000];
    write_text(shape_path, shape);
    snprintf(text, sizeof text, "hull: " EXAMPLES_DIR "/hulls/%s.json\nshape: %s\n%s", hull,
             shape_path, rest);
    write_text(path, text);
    CU_ASSERT_TRUE_FATAL(config_read(path, NULL, &config));
    say_why(problem_read(&config, &problem));
    galv_shape *modification = problem_shape(&problem);
    CU_ASSERT_PTR_NOT_NULL_FATAL(modification);
    say_why(problem_reduce(&problem, modification, &nobody));
    galv_shape_free(modification);
}

static void free_problem(void)
{
    problem_free(&problem);
    config_free(&config);
}

static void value(const double *u, struct evaluation *e)
{
    evaluation_start(1, "design", u, e);
    if (u)
        evaluate(&problem, e, NULL, NULL);
    else
        evaluate_parent(&problem, e, NULL, NULL);
    if (e->failed)
        fprintf(stderr, "%s\n", e->reason);
    CU_ASSERT_FALSE_FATAL(e->failed);
}

/* All control points by the same along x; a step to either side. */
static void check_translation(double step)
{
    struct evaluation parent, moved;
    value(NULL, &parent);
    for (int side = 0; side < 2; side++) {
        const double u[1] = {side ? step : -step};
        value(u, &moved);
        CHECK_RELATIVE(moved.cw, parent.cw, 1e-9);
        CHECK_RELATIVE(moved.cw_pressure, parent.cw_pressure, 1e-7); /* forces that cancel */
        CHECK_RELATIVE(moved.volume, parent.volume, 1e-12);
        CHECK_CLOSE(moved.particular[PARTICULAR_LCB][0] - parent.particular[PARTICULAR_LCB][0],
                    u[0] / problem_length(&problem), 1e-12);
        CHECK_RELATIVE(moved.particular[PARTICULAR_KM][0], parent.particular[PARTICULAR_KM][0],
                       1e-12);
    }
}

static void translates_a_wigley_hull(void)
{
    read_problem("wigley",
                 "bounds: [-0.2, 0.2]\ncontrol_points:\n  moved:\n"
                 "    - {first: [0, 0], last: [2, 2], directions: [x], together: true}\n",
                 "grid: {sections: 21, girth: 9}\nflow: {froude: 0.316}\n"
                 "solver: {formulation: neumann-kelvin, elements_u: 10, elements_v: 4, "
                 "tolerance: 1e-6}\nsearch: {space: parameters}\n");
    check_translation(0.13);
    free_problem();
}

/* With the rows of its stern, which end at a share of the length from its aft end. */
static void translates_the_dtmb_5415(void)
{
    read_problem("dtmb5415",
                 "bounds: [-1, 1]\ncontrol_points:\n  count: [4, 3]\n  moved:\n"
                 "    - {first: [0, 0], last: [3, 2], directions: [x], together: true}\n",
                 "flow: {froude: 0.35}\n"
                 "solver: {formulation: neumann-kelvin-stern, elements_u: 14, elements_v: 5, "
                 "tolerance: 1e-4}\nsearch: {space: parameters}\n");
    check_translation(0.71);
    free_problem();
}

/* Up by d: V = 2/3 B L (T - d - (T^3 - d^3)/(3 T^2)), beam B (1 - d^2/T^2), draft T - d, known
 * before the hull is built and of the built one. */
static void raises_a_wigley_hull(void)
{
    const double length = 1, beam = 0.1, draft = 0.0625, whole = 4.0 / 9 * length * beam * draft;
    read_problem("wigley",
                 "bounds: [-0.001, 0.02]\ncontrol_points:\n  moved:\n"
                 "    - {first: [0, 0], last: [2, 2], directions: [z], together: true}\n",
                 "grid: {sections: 41, girth: 17}\nflow: {froude: 0.316}\n"
                 "reconstruction: {tolerance: 1e-5}\n"
                 "solver: {formulation: michell}\nsearch: {space: parameters}\n"
                 "constraints: {displacement: 0.9, entrance: 1.2}\n");
    for (int k = 1; k <= 4; k++) {
        double d = 0.005 * k, t = draft - d, u[1] = {d}, ratio;
        double volume =
            2.0 / 3 * beam * length * (t - (pow(draft, 3) - pow(d, 3)) / (3 * draft * draft));
        struct evaluation e;
        value(u, &e);
        CHECK_RELATIVE(e.volume, volume, 2e-5);
        CU_ASSERT_EQUAL(galv_limits_volume(problem.limits, u, &ratio), GALV_OK);
        CHECK_CLOSE(ratio, volume / whole, 1e-3);
        CHECK_RELATIVE(e.particular[PARTICULAR_BEAM][0], beam * (1 - d * d / (draft * draft)),
                       1e-3);
        struct design design;
        say_why(problem_build(&problem, u, &design));
        CHECK_CLOSE(nurbs_hull_hydrostatics(design.hull)->draft, t, 1e-6);
        /* The slope of the waterline at its ends is 2 B/L times the share of the beam. */
        CU_ASSERT_EQUAL(galv_limits_entrance(problem.limits, u, &ratio), GALV_OK);
        CHECK_CLOSE(ratio, design_nu_s(&design) / design_nu_s(&problem.parent), 2e-3);
        design_free(&design);
    }
    free_problem();
}

/* The grid moved by parameters lies on the surface whose control points are moved, and the hull
 * built on it is that surface. */
static void moves_the_control_points(void)
{
    enum { N = 9 };
    read_problem("wigley",
                 "bounds: [-0.004, 0.004]\ncontrol_points:\n  moved:\n"
                 "    - {first: [1, 0], last: [1, 1], directions: [x, y, z]}\n"
                 "    - {first: [0, 2], last: [2, 2], directions: [z]}\n",
                 "grid: {sections: 21, girth: 9}\nflow: {froude: 0.316}\n"
                 "reconstruction: {tolerance: 1e-5}\n"
                 "solver: {formulation: michell}\nsearch: {space: parameters}\n");
    CU_ASSERT_EQUAL_FATAL(galv_model_modes(problem.model), N);
    const double u[N] = {0.003, 0.004, 0.001, -0.002, -0.003, -0.002, 0.004, -0.003, 0.002};
    /* of control point 3 i + j, coordinate a: the parameters in turn */
    static const int at[N] = {9, 10, 11, 12, 13, 14, 8, 17, 26};
    const nurbs_surface *own = nurbs_patches_get(nurbs_hull_full(problem.source), 0);
    double points[27];
    memcpy(points, nurbs_surface_points(own), sizeof points);
    for (int k = 0; k < N; k++)
        points[at[k]] += u[k];
    nurbs_surface *moved = NULL;
    nurbs_patches *patches = NULL;
    nurbs_grid *grid = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((int[]){2, 2}, (size_t[]){3, 3},
                                               nurbs_surface_knots(own, 0),
                                               nurbs_surface_knots(own, 1), points, NULL, &moved),
                          NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&patches), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_add(patches, moved), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_design_grid(patches, 0, 21, 9, &grid), NURBS_OK);
    struct design design;
    say_why(problem_build(&problem, u, &design));
    const double *mine = nurbs_grid_points(problem.moved), *theirs = nurbs_grid_points(grid);
    for (size_t k = 0; k < (size_t)3 * 21 * 9; k++)
        CHECK_CLOSE(mine[k], theirs[k], 1e-15);
    nurbs_hull *hull = NULL;
    nurbs_hull_options options;
    nurbs_hull_options_init(&options);
    options.length = 1;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(patches, &options, &hull), NURBS_OK);
    CHECK_RELATIVE(nurbs_hull_hydrostatics(design.hull)->volume,
                   nurbs_hull_hydrostatics(hull)->volume, 1e-5);
    nurbs_hull_free(hull);
    design_free(&design);
    nurbs_grid_free(grid);
    nurbs_patches_free(patches);
    nurbs_surface_free(moved);
    free_problem();
}

/* A descent does not take tangents, which are of moves athwartships, for such a family: by the
 * control points that move. */
static void check_differences(const char *moved)
{
    char shape[200];
    snprintf(shape, sizeof shape, "bounds: [-0.004, 0.004]\ncontrol_points:\n  moved:\n    - %s\n",
             moved);
    read_problem("wigley", shape,
                 "grid: {sections: 21, girth: 9}\nflow: {froude: 0.316}\n"
                 "solver: {formulation: michell}\n"
                 "search: {space: parameters, method: gauss-newton}\n");
    struct descent d;
    say_why(descent_start(&problem, NULL, &d));
    double u[4] = {0}, *residual = calloc(4 * d.problem.n_residuals, sizeof *residual);
    bool known[1] = {false};
    bayesopt_descent_slopes slopes = {.residual = residual, .known = known};
    core_fail("nothing");
    CU_ASSERT_EQUAL(d.problem.derivatives(d.problem.user_data, u, &slopes),
                    BAYESOPT_DESCENT_FAILED);
    CU_ASSERT_FALSE(known[0]);
    CU_ASSERT_PTR_NOT_NULL(strstr(core_sentence(), "along x or z"));
    free(residual);
    descent_end(&d);
    free_problem();
}

/* The aft end drawn forward of midship: x runs back and forth along the hull. */
static void takes_no_folded_grid(void)
{
    struct evaluation e;
    read_problem("wigley",
                 "bounds: [-0.7, 0.7]\ncontrol_points:\n  moved:\n"
                 "    - {first: [0, 0], last: [0, 2], directions: [x], together: true}\n",
                 "grid: {sections: 21, girth: 9}\nflow: {froude: 0.316}\n"
                 "solver: {formulation: michell}\nsearch: {space: parameters}\n");
    const double far[1] = {0.6}, less[1] = {0.3};
    value(less, &e);
    CU_ASSERT_TRUE(e.outside <= 0);
    evaluation_start(1, "design", far, &e);
    evaluate(&problem, &e, NULL, NULL);
    CU_ASSERT_TRUE(e.outside > 0);
    free_problem();
}

static void differences_what_moves_along_x_or_z(void)
{
    check_differences("{first: [1, 0], last: [1, 1], directions: [y, z]}");
    check_differences("{first: [0, 0], last: [2, 2], directions: [x], together: true}");
}

static const struct check_case cases[] = {
    {"translates a Wigley hull", translates_a_wigley_hull},
    {"translates the DTMB 5415", translates_the_dtmb_5415},
    {"raises a Wigley hull", raises_a_wigley_hull},
    {"moves the control points", moves_the_control_points},
    {"takes no folded grid", takes_no_folded_grid},
    {"differences what moves along x or z", differences_what_moves_along_x_or_z},
};

int main(void)
{
    snprintf(path, sizeof path, "%s/test_hullopt_families_%ld.yaml", check_scratch(),
             (long)getpid());
    snprintf(shape_path, sizeof shape_path, "%s.shape", path);
    int failed = check_main("families", cases, sizeof cases / sizeof *cases);
    remove(path);
    remove(shape_path);
    return failed;
}
