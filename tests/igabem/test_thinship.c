/* Formulations without a solve, from the hull itself: Michell's integral against its reference
 * values, Hogner's against Michell's in the thin limit. */
#include "check.h"
#include "hulls.h"

static double cw_of(const igabem_hull *hull, double froude, igabem_formulation formulation,
                    double spectrum_limit, int line_term)
{
    igabem_options options;
    igabem_solution *solution;
    igabem_forces forces = {.cw = NAN};
    igabem_options_init(&options);
    options.refine = 1;
    options.froude = froude;
    options.formulation = formulation;
    options.spectrum_limit = spectrum_limit;
    options.line_term = line_term;
    igabem_status status = igabem_solve(hull, &options, &solution);
    if (status)
        fprintf(stderr, "%s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    CU_ASSERT_EQUAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    CU_ASSERT(isnan(forces.cw_pressure));
    igabem_solution_free(solution);
    return forces.cw;
}

/* Standard Wigley hull: analytic inner integrals, outer Gauss panels, 1e-9. */
static void michell_wigley(void)
{
    static const double exact[][2] = {
        {0.20, 0.0008875624682}, {0.25, 0.001063919659}, {0.30, 0.00214166683},
        {0.35, 0.001247921974},  {0.40, 0.002733928014}, {0.45, 0.004154257293},
    };
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 8, 2);
    for (size_t i = 0; i < sizeof exact / sizeof exact[0]; i++) {
        /* The tail beyond t = 20 is a few 1e-5. */
        CHECK_RELATIVE(cw_of(hull, exact[i][0], IGABEM_FORMULATION_MICHELL, 20, 1), exact[i][1],
                       1e-4);
    }
    CHECK_RELATIVE(cw_of(hull, 0.35, IGABEM_FORMULATION_MICHELL, 40, 1), 0.001247921974, 3e-6);
    igabem_hull_free(hull);
}

/* C_w/C_w(Michell) of Hogner's sources without line term tends to 1 with the beam. */
static void hogner_thin_limit(void)
{
    double ratio[3];
    for (int k = 0; k < 3; k++) {
        double beam = 0.04 / (1 << k);
        igabem_hull *hull = wigley_hull(beam, 0.0625, 8, 2);
        ratio[k] = cw_of(hull, 0.3, IGABEM_FORMULATION_HOGNER, 20, 0) /
                   cw_of(hull, 0.3, IGABEM_FORMULATION_MICHELL, 20, 0);
        igabem_hull_free(hull);
    }
    CU_ASSERT(fabs(ratio[1] - 1) < 0.7 * fabs(ratio[0] - 1));
    CU_ASSERT(fabs(ratio[2] - 1) < 0.7 * fabs(ratio[1] - 1));
    CHECK_CLOSE(2 * ratio[2] - ratio[1], 1.0, 2e-3);
}

static const struct check_case cases[] = {
    {"Michell's integral of the Wigley hull", michell_wigley},
    {"Hogner's sources in the thin limit", hogner_thin_limit},
};

CHECK_MAIN("thin ship", cases)
