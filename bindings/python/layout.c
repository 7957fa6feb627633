/* Prints _layout.py: where the structures of the C libraries hold the fields that the Python module
 * uses, and the values of the names it takes. Compiled with the headers, so that both agree. */
#include <bayesopt/bayesopt.h>
#include <galv/galv.h>
#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

#include <stddef.h>
#include <stdio.h>

static void field(const char *name, const char *type, size_t offset)
{
    printf("        (\"%s\", \"%s\", %zu),\n", name, type, offset);
}

/* The type is checked by the compiler, but for enumerations, which are ints. */
#define FIELD(structure, name, ctype, python)                                                      \
    do {                                                                                           \
        _Static_assert(_Generic(((structure *)0)->name, ctype : 1, default : 0),                   \
                       "type of " #name);                                                          \
        field(#name, python, offsetof(structure, name));                                           \
    } while (0)
#define D(structure, name)   FIELD(structure, name, double, "c_double")
#define I(structure, name)   FIELD(structure, name, int, "c_int")
#define N(structure, name)   FIELD(structure, name, size_t, "c_size_t")
#define U64(structure, name) FIELD(structure, name, uint64_t, "c_uint64")
#define B(structure, name)   FIELD(structure, name, bool, "c_bool")
#define P(structure, name)   FIELD(structure, name, const double *, "c_void_p")
#define E(structure, name)                                                                         \
    do {                                                                                           \
        _Static_assert(sizeof(((structure *)0)->name) == sizeof(int), "size of " #name);           \
        field(#name, "c_int", offsetof(structure, name));                                          \
    } while (0)
/* A pointer to anything else. */
#define A(structure, name)                                                                         \
    do {                                                                                           \
        _Static_assert(sizeof(((structure *)0)->name) == sizeof(void *), "size of " #name);        \
        field(#name, "c_void_p", offsetof(structure, name));                                       \
    } while (0)
#define BEGIN(structure) printf("    \"%s\": (%zu, [\n", #structure, sizeof(structure))
#define END              printf("    ]),\n")
#define VALUE(name)      printf("    \"%s\": %d,\n", #name, (int)name)

static void print_nurbs(void)
{
    BEGIN(nurbs_hull_options);
    D(nurbs_hull_options, level);
    D(nurbs_hull_options, draft);
    D(nurbs_hull_options, length);
    D(nurbs_hull_options, cut);
    D(nurbs_hull_options, simplify);
    D(nurbs_hull_options, sinkage);
    D(nurbs_hull_options, trim);
    D(nurbs_hull_options, pivot);
    B(nurbs_hull_options, unbounded);
    END;
    BEGIN(nurbs_hydrostatics);
    D(nurbs_hydrostatics, wetted_area);
    D(nurbs_hydrostatics, volume);
    field("centroid", "c_double * 3", offsetof(nurbs_hydrostatics, centroid));
    D(nurbs_hydrostatics, waterplane_area);
    D(nurbs_hydrostatics, waterplane_centre);
    D(nurbs_hydrostatics, waterplane_inertia_x);
    D(nurbs_hydrostatics, waterplane_inertia_y);
    D(nurbs_hydrostatics, beam);
    D(nurbs_hydrostatics, draft);
    D(nurbs_hydrostatics, keel_draft);
    D(nurbs_hydrostatics, x_aft);
    D(nurbs_hydrostatics, x_fore);
    D(nurbs_hydrostatics, transom_area);
    D(nurbs_hydrostatics, section_area_max);
    D(nurbs_hydrostatics, section_area_max_x);
    D(nurbs_hydrostatics, error);
    END;
    BEGIN(nurbs_skin_options);
    I(nurbs_skin_options, degree);
    E(nurbs_skin_options, parametrize);
    D(nurbs_skin_options, kink_angle);
    END;
}

static void print_igabem(void)
{
    BEGIN(igabem_options);
    D(igabem_options, froude);
    D(igabem_options, gravity);
    D(igabem_options, density);
    E(igabem_options, kernel);
    E(igabem_options, formulation);
    I(igabem_options, refine);
    I(igabem_options, refine_v);
    I(igabem_options, elements_u);
    I(igabem_options, elements_v);
    I(igabem_options, degree);
    D(igabem_options, cutoff_angle);
    D(igabem_options, cutoff_factor);
    D(igabem_options, stem_limit);
    D(igabem_options, stern_length);
    D(igabem_options, stern_blend);
    D(igabem_options, spectrum_limit);
    D(igabem_options, tolerance);
    I(igabem_options, threads);
    D(igabem_options, surface_cells);
    D(igabem_options, surface_rows);
    D(igabem_options, surface_first);
    D(igabem_options, surface_damping);
    D(igabem_options, surface_upstream);
    D(igabem_options, surface_downstream);
    D(igabem_options, surface_side);
    D(igabem_options, surface_columns);
    D(igabem_options, keep_system);
    END;
    BEGIN(igabem_forces);
    D(igabem_forces, speed);
    D(igabem_forces, k0);
    D(igabem_forces, wetted_area);
    D(igabem_forces, volume);
    D(igabem_forces, rw);
    D(igabem_forces, cw);
    D(igabem_forces, cw_l2);
    D(igabem_forces, cw_error);
    D(igabem_forces, cw_pressure);
    D(igabem_forces, cw_pressure_linear);
    D(igabem_forces, cw_run_up);
    D(igabem_forces, cw_transom);
    D(igabem_forces, cw_momentum);
    D(igabem_forces, sinkage);
    D(igabem_forces, trim);
    D(igabem_forces, condition);
    N(igabem_forces, dofs);
    D(igabem_forces, seconds);
    END;
}

static void print_galv(void)
{
    BEGIN(galv_sampling);
    N(galv_sampling, count);
    N(galv_sampling, first);
    U64(galv_sampling, seed);
    P(galv_sampling, x);
    END;
    BEGIN(galv_options);
    D(galv_options, variance);
    N(galv_options, modes);
    N(galv_options, spectrum);
    B(galv_options, centre);
    P(galv_options, weights);
    N(galv_options, workspace);
    U64(galv_options, seed);
    END;
    BEGIN(galv_data);
    N(galv_data, count);
    N(galv_data, coordinates);
    N(galv_data, npoints);
    P(galv_data, values);
    P(galv_data, xyz);
    END;
    BEGIN(galv_box);
    field("origin", "c_double * 3", offsetof(galv_box, origin));
    field("length", "c_double * 3", offsetof(galv_box, length));
    END;
    BEGIN(galv_sine);
    field("order", "c_double * 3", offsetof(galv_sine, order));
    field("phase", "c_double * 3", offsetof(galv_sine, phase));
    I(galv_sine, direction);
    END;
}

static void print_bayesopt(void)
{
    BEGIN(bayesopt_options);
    U64(bayesopt_options, seed);
    N(bayesopt_options, max_evaluations);
    N(bayesopt_options, initial_n);
    N(bayesopt_options, n_constraints);
    P(bayesopt_options, constraint_lower);
    P(bayesopt_options, constraint_upper);
    E(bayesopt_options, noise);
    E(bayesopt_options, strategy);
    A(bayesopt_options, kind);
    B(bayesopt_options, maximise);
    A(bayesopt_options, names);
    N(bayesopt_options, n_conditions);
    A(bayesopt_options, conditions);
    N(bayesopt_options, n_first);
    P(bayesopt_options, first_x);
    B(bayesopt_options, told_count);
    N(bayesopt_options, n_objectives);
    A(bayesopt_options, maximise_others);
    END;
    BEGIN(bayesopt_result);
    D(bayesopt_result, f);
    P(bayesopt_result, constraints);
    P(bayesopt_result, gradient);
    A(bayesopt_result, note);
    B(bayesopt_result, transient);
    B(bayesopt_result, outside);
    END;
    BEGIN(bayesopt_point);
    U64(bayesopt_point, id);
    E(bayesopt_point, state);
    P(bayesopt_point, x);
    D(bayesopt_point, f);
    P(bayesopt_point, constraints);
    A(bayesopt_point, note);
    B(bayesopt_point, feasible);
    END;
}

int main(void)
{
    printf("\"\"\"Layouts of the C structures; generated when the module is built.\"\"\"\n\n"
           "STRUCTURES = {\n");
    print_nurbs();
    print_igabem();
    print_galv();
    print_bayesopt();
    printf("}\n\nVALUES = {\n");
    VALUE(IGABEM_KERNEL_KELVIN);
    VALUE(IGABEM_KERNEL_DOUBLE_BODY);
    VALUE(IGABEM_KERNEL_RANKINE);
    VALUE(IGABEM_WAVE_RESIDUALS);
    VALUE(IGABEM_RANKINE);
    VALUE(IGABEM_IMAGE);
    VALUE(IGABEM_LOCAL);
    VALUE(IGABEM_WAVE);
    VALUE(GALV_COMBINATION_LINEAR);
    VALUE(GALV_COMBINATION_RECURSIVE);
    VALUE(GALV_COMBINATION_SCALED);
    VALUE(NURBS_PARAMETRIZATION_UNIFORM);
    VALUE(NURBS_PARAMETRIZATION_CHORD);
    VALUE(NURBS_PARAMETRIZATION_CENTRIPETAL);
    VALUE(NURBS_PARAMETRIZATION_FOLEY);
    VALUE(NURBS_SIMPLIFY_KEEP_EDGES);
    VALUE(NURBS_SIMPLIFY_KEEP_KINKS);
    VALUE(NURBS_SIMPLIFY_THRIFTY);
    VALUE(BAYESOPT_NOISE_DETERMINISTIC);
    VALUE(BAYESOPT_NOISE_LEARNED);
    VALUE(BAYESOPT_STRATEGY_AUTO);
    VALUE(BAYESOPT_STRATEGY_GLOBAL);
    VALUE(BAYESOPT_STRATEGY_LOCAL);
    VALUE(BAYESOPT_KIND_REAL);
    VALUE(BAYESOPT_KIND_LOG);
    VALUE(BAYESOPT_KIND_INTEGER);
    VALUE(BAYESOPT_KIND_CATEGORICAL);
    VALUE(BAYESOPT_STATE_PENDING);
    VALUE(BAYESOPT_STATE_DONE);
    VALUE(BAYESOPT_STATE_FAILED);
    VALUE(BAYESOPT_STATE_LOST);
    VALUE(BAYESOPT_NONE_FEASIBLE);
    printf("}\n");
    return 0;
}
