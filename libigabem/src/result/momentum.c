#include "result/momentum.h"

#include "core/error.h"

#include <math.h>

bool momentum_kept(const igabem_solution *solution)
{
    const igabem_formulation_row *row = solution->formulation;
    if (!solution->waves || row->double_model)
        return solution->waves;
    return solution->info.surface_piercing &&
           (row->potential || (row->kelvin_rows && row->line_term && !row->stern_rows &&
                               solution->options.line_term));
}

/* Of both sides, over rho. */
struct sums {
    double pressure, run_up; /* Int p n_x without it */
    double momentum;         /* Int (U phi_x - |grad phi|^2/2) n_x dS + what the surface takes */
};

/* The double body's own pressure is left out: its sum is zero (d'Alembert) but for what a mesh
 * makes of it. base: grad Phi of unit speed at the same nodes. */
static void integrate(const igabem_solution *solution, const struct sources *s,
                      const struct sources *base, struct sums *sums)
{
    double speed = solution->speed, gravity = solution->options.gravity;
    *sums = (struct sums){0.0, 0.0, solution->surface_momentum};
    for (size_t j = 0; j < s->n; j++) {
        double mixed = 0.0, square = 0.0, own = 0.0, nx = s->normal[0][j] * s->area[j];
        for (int c = 0; c < 3; c++) {
            mixed += s->velocity[c][j] * base->velocity[c][j];
            square += base->velocity[c][j] * base->velocity[c][j];
            own += s->velocity[c][j] * s->velocity[c][j];
        }
        double along = speed * (s->velocity[0][j] - speed * base->velocity[0][j]);
        sums->pressure += (along - speed * (mixed - speed * square)) * nx;
        sums->momentum += (along - 0.5 * (own - speed * speed * square)) * nx;
    }
    for (size_t j = 0; j < s->n_line; j++) {
        double p = base->line_velocity[0][j], q = base->line_velocity[1][j];
        double flow = (p - 1.0) * s->line_velocity[0][j] + q * s->line_velocity[1][j];
        double zeta = speed / gravity * (0.5 * speed * (p * p + q * q) - flow);
        double length = s->line_nu_x[j] * s->line_length[j];
        sums->run_up += 0.5 * gravity * zeta * zeta * length;
        sums->momentum += 0.5 / solution->k0 * flow * flow * length;
    }
    sums->pressure *= 2.0;
    sums->run_up *= 2.0;
    sums->momentum *= 2.0;
}

igabem_status momentum_double_model(const igabem_solution *solution, const struct sources *s,
                                    double scale, igabem_forces *forces)
{
    igabem_solution about = *solution;
    const struct source_rule plain = {.k0 = 0.0};
    struct sources *base;
    struct sums sums;
    about.velocity = solution->base_velocity;
    igabem_status status = sources_create(&about, &plain, NULL, &base);
    if (status)
        return status;
    integrate(solution, s, base, &sums);
    sources_free(base);
    forces->cw_pressure = scale * (sums.pressure + sums.run_up);
    forces->cw_run_up = scale * sums.run_up;
    forces->cw_momentum = scale * sums.momentum;
    if (isfinite(forces->cw_transom))
        forces->cw_momentum += forces->cw_transom;
    return isfinite(forces->cw_pressure) && isfinite(forces->cw_momentum)
               ? IGABEM_OK
               : igabem_fail(IGABEM_ERROR_NUMERIC, "the pressure on the hull is not finite");
}
