#include "methods.h"

static const struct method_row ROWS[] = {
    {"bayesian", METHOD_GAUSSIAN_PROCESS, .seeded = true,
     .sentence = "Gaussian process, the method of the paper"},
    {"gauss-newton", METHOD_DESCENT,
     .sentence = "descent by derivatives of the Kochin function and the velocities"},
    {"direct", METHOD_NLOPT, .algorithm = NLOPT_GN_DIRECT_L,
     .sentence = "divides the box (DIRECT, locally biased)"},
    {"crs2", METHOD_NLOPT, .algorithm = NLOPT_GN_CRS2_LM, .seeded = true,
     .sentence = "controlled random search with local mutation"},
    {"isres", METHOD_NLOPT, .algorithm = NLOPT_GN_ISRES, .constraints = true, .seeded = true,
     .sentence = "evolution strategy with stochastic ranking"},
    {"cobyla", METHOD_NLOPT, .algorithm = NLOPT_LN_COBYLA, .constraints = true, .outside = 0.5,
     .sentence = "linear models on a simplex"},
    {"bobyqa", METHOD_NLOPT, .algorithm = NLOPT_LN_BOBYQA,
     .sentence = "a quadratic model in a trust region"},
    {"sqp", METHOD_NLOPT, .algorithm = NLOPT_LD_SLSQP, .gradient = true, .constraints = true,
     .outside = 0.5,
     .sentence = "sequential quadratic programming (SLSQP) on one-sided differences"},
    {"particle-swarm", METHOD_SWARM, .seeded = true, .sentence = "swarm with constriction"},
    {"random", METHOD_DESIGN, .design = BAYESOPT_DESIGN_UNIFORM, .seeded = true,
     .sentence = "uniform designs inside the known limits"},
    {"lhs", METHOD_DESIGN, .design = BAYESOPT_DESIGN_LHS, .seeded = true,
     .sentence = "a Latin hypercube inside the known limits"},
};

const struct method_row *method_row(int method)
{
    return method >= 0 && (size_t)method < sizeof ROWS / sizeof *ROWS ? &ROWS[method] : 0;
}
