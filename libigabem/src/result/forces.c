/* Forces on the hull: by the waves it radiates and by the pressure on it (docs/theory.md, sections
 * 6 and 7). */
#include "core/constants.h"
#include "core/error.h"
#include "result/kochin.h"
#include "result/momentum.h"
#include "result/radiation.h"
#include "threads.h"

#include <math.h>

/* Surface integrals of the pressure over rho, and of the run-up, over both sides; moments about the
 * transverse axis through (x_f, z = 0). */
struct pressure_sums {
    double drag_linear, drag_square; /* Int U phi_x n_x, Int -|grad phi|^2/2 n_x */
    double run_up;                   /* (g/2) Oint zeta^2 nu_x dl */
    double transom;                  /* -g Int z n_x: zero on a closed body */
    double lift;                     /* -Int p/rho n_z: the upward force */
    double moment;                   /* positive bow down */
};

static void integrate_pressure(const igabem_solution *solution, const struct sources *s,
                               struct pressure_sums *sums)
{
    double speed = solution->speed, gravity = solution->options.gravity;
    double axis = solution->info.hydrostatics.waterplane_centre;
    *sums = (struct pressure_sums){0, 0, 0, 0, 0, 0};
    for (size_t j = 0; j < s->n; j++) {
        double u = s->velocity[0][j], v = s->velocity[1][j], w = s->velocity[2][j];
        double linear = speed * u, square = -0.5 * (u * u + v * v + w * w);
        double nx = s->normal[0][j] * s->area[j], nz = s->normal[2][j] * s->area[j];
        sums->drag_linear += linear * nx;
        sums->drag_square += square * nx;
        sums->transom -= gravity * s->z[j] * nx;
        sums->lift -= (linear + square) * nz;
        sums->moment -= (linear + square) * (s->z[j] * nx - (s->x[j] - axis) * nz);
    }
    for (size_t j = 0; j < s->n_line && s->line_velocity[0]; j++) {
        double zeta = speed / gravity * s->line_velocity[0][j];
        sums->run_up += 0.5 * gravity * zeta * zeta * s->line_nu_x[j] * s->line_length[j];
    }
    double sides = s->symmetric ? 2.0 : 1.0;
    sums->drag_linear *= sides;
    sums->drag_square *= sides;
    sums->run_up *= sides;
    sums->transom *= sides;
    sums->lift *= sides;
    sums->moment *= sides;
}

/* Sinkage and trim in equilibrium with the hydrostatic stiffness rho g A_wp and rho g I_L. */
static void attitude(const igabem_solution *solution, const struct pressure_sums *sums,
                     igabem_forces *forces)
{
    const nurbs_hydrostatics *h = &solution->info.hydrostatics;
    if (!solution->info.surface_piercing || !(h->waterplane_area > 0) ||
        !(h->waterplane_inertia_y > 0))
        return;
    forces->sinkage = -sums->lift / (solution->options.gravity * h->waterplane_area);
    forces->trim = -sums->moment / (solution->options.gravity * h->waterplane_inertia_y);
}

static igabem_status pressure_forces(const igabem_solution *solution, igabem_forces *forces)
{
    if (!solution->velocity)
        return IGABEM_OK;
    struct sources *sources;
    struct pressure_sums sums;
    const struct source_rule plain = {.k0 = 0.0};
    igabem_status status = sources_create(solution, &plain, NULL, &sources);
    if (status)
        return status;
    integrate_pressure(solution, sources, &sums);
    double scale = 2.0 / (solution->speed * solution->speed * forces->wetted_area);
    if (solution->formulation->pressure || !solution->formulation->solves) {
        forces->cw_pressure_linear = scale * sums.drag_linear;
        forces->cw_pressure = scale * (sums.drag_linear + sums.drag_square + sums.run_up);
        forces->cw_run_up = scale * sums.run_up;
        if (solution->info.transom == IGABEM_TRANSOM_OPEN)
            forces->cw_transom = scale * sums.transom;
    }
    attitude(solution, &sums, forces);
    if (solution->base_velocity)
        status = momentum_double_model(solution, sources, scale, forces);
    else if (momentum_kept(solution))
        forces->cw_momentum = forces->cw_pressure - 2.0 * forces->cw_run_up +
                              (isfinite(forces->cw_transom) ? forces->cw_transom : 0.0);
    sources_free(sources);
    if (status)
        return status;
    if (!isfinite(sums.drag_linear) || !isfinite(sums.drag_square) || !isfinite(sums.lift))
        return igabem_fail(IGABEM_ERROR_NUMERIC, "the pressure on the hull is not finite");
    return IGABEM_OK;
}

/* Of the patch with the widest spacing: a mesh is as good as its coarsest part. */
static double unknowns_per_wave(const igabem_solution *solution)
{
    double spacing = 0.0;
    for (size_t p = 0; p < solution->density->patches; p++) {
        const struct density_patch *patch = &solution->density->patch[p];
        int along = patch->hull.along;
        if (along >= 0)
            spacing = fmax(spacing, patch->hull.length[along] / (double)patch->size[along]);
    }
    return solution->waves && spacing > 0 ? 2.0 * PI / solution->k0 / spacing : NAN;
}

igabem_status igabem_forces_compute(const igabem_solution *solution, igabem_forces *forces)
{
    if (!solution || !forces)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_forces_compute");
    THREADS(solution->options.threads);
    const nurbs_hydrostatics *h = &solution->info.hydrostatics;
    *forces = (igabem_forces){.speed = solution->speed,
                              .k0 = solution->k0,
                              .wetted_area = h->wetted_area,
                              .volume = h->volume,
                              .rw = NAN,
                              .cw = NAN,
                              .cw_l2 = NAN,
                              .cw_pressure = NAN,
                              .cw_pressure_linear = NAN,
                              .cw_run_up = NAN,
                              .cw_transom = NAN,
                              .cw_momentum = NAN,
                              .cw_error = NAN,
                              .cw_cutoff_lower = NAN,
                              .cw_cutoff_upper = NAN,
                              .share_beyond_cutoff = NAN,
                              .sinkage = NAN,
                              .trim = NAN,
                              .condition = solution->condition,
                              .iterations = solution->iterations,
                              .residual = solution->residual,
                              .seconds = solution->seconds,
                              .memory = solution->memory,
                              .dofs = solution->density->n,
                              .cost = solution->cost,
                              .unknowns_per_wave = unknowns_per_wave(solution)};
    struct kochin_resistance far;
    igabem_status status = kochin_resistance(solution, &far);
    if (!status)
        status = pressure_forces(solution, forces);
    if (status)
        return status;
    double pressure = 0.5 * solution->options.density * solution->speed * solution->speed;
    double length = solution->info.length;
    forces->cw = far.cw;
    forces->rw = far.cw * pressure * h->wetted_area;
    forces->cw_l2 = far.cw * h->wetted_area / (length * length);
    forces->cw_error = far.cw_error;
    forces->cw_cutoff_lower = far.cw_lower;
    forces->cw_cutoff_upper = far.cw_upper;
    forces->share_beyond_cutoff = far.share_beyond_cutoff;
    return IGABEM_OK;
}
