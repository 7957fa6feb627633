/* What the momentum of the water says of the resistance (docs/theory.md, sections 7 and 14). */
#ifndef MOMENTUM_H
#define MOMENTUM_H

#include "result/sources.h"
#include "solve/solution.h"

/* Whether it must give C_w: what is solved is the linear problem at the surface and nothing else.
 */
bool momentum_kept(const igabem_solution *solution);

/* About a double-body flow: fills cw_pressure, by the pressure linear in what phi differs from that
 * flow's and the run-up by the elevation linear in the same, cw_run_up and cw_momentum; cw_transom
 * stands. sources: with their velocities. scale: of sums over rho to coefficients. */
igabem_status momentum_double_model(const igabem_solution *solution, const struct sources *sources,
                                    double scale, igabem_forces *forces);

#endif
