#include "solve/formulation.h"

#include <string.h>

static const igabem_formulation_row table[] = {
    [IGABEM_FORMULATION_AUTO] = {.name = "auto",
                                 .sentence = "neumann-kelvin-stern with a transom, else "
                                             "neumann-kelvin",
                                 .solves = true,
                                 .kelvin_rows = true,
                                 .line_term = true,
                                 .pressure = true},
    [IGABEM_FORMULATION_NEUMANN_KELVIN] = {.name = "neumann-kelvin",
                                           .sentence =
                                               "Kelvin sources, Brard line term, flat filter",
                                           .solves = true,
                                           .kelvin_rows = true,
                                           .line_term = true,
                                           .pressure = true,
                                           .tangents = true},
    [IGABEM_FORMULATION_NEUMANN_KELVIN_STERN] = {.name = "neumann-kelvin-stern",
                                                 .sentence = "the same, rows aft of x_s see the "
                                                             "double-body kernel only",
                                                 .solves = true,
                                                 .kelvin_rows = true,
                                                 .stern_rows = true,
                                                 .line_term = true,
                                                 .pressure = true,
                                                 .tangents = true},
    /* The pressure drag of a double-body flow is zero but for its discretisation error; as a wave
     * resistance it would mislead. */
    [IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN] = {.name = "double-body-kochin",
                                               .sentence = "double-body sources, resistance by "
                                                           "their Kochin function",
                                               .solves = true,
                                               .line_term = true,
                                               .tangents = true},
    /* Hogner (1932). */
    [IGABEM_FORMULATION_HOGNER] = {.name = "hogner",
                                   .sentence = "sigma = U n_x on the hull (no solve)",
                                   .line_term = true,
                                   .tangents = true},
    /* Michell (1898). */
    [IGABEM_FORMULATION_MICHELL] = {.name = "michell",
                                    .sentence =
                                        "thin ship: the same sources moved to the centre plane",
                                    .centre_plane = true,
                                    .tangents = true},
    [IGABEM_FORMULATION_EXTERIOR] = {.name = "exterior",
                                     .sentence =
                                         "potential on hull and free surface outside of it, "
                                         "1/r alone",
                                     .solves = true,
                                     .pressure = true,
                                     .potential = true,
                                     .tangents = true},
    /* Dawson 1977; Nakos and Sclavounos 1990. */
    [IGABEM_FORMULATION_DOUBLE_MODEL] = {.name = "double-model",
                                         .sentence = "the same, linearised about the double-body "
                                                     "flow instead of the free stream",
                                         .solves = true,
                                         .pressure = true,
                                         .potential = true,
                                         .double_model = true,
                                         .tangents = true},
};
enum { ROWS = sizeof table / sizeof *table };

const igabem_formulation_row *igabem_formulation_info(igabem_formulation formulation)
{
    return (unsigned)formulation < ROWS ? &table[formulation] : NULL;
}

const char *igabem_formulation_name(igabem_formulation formulation)
{
    const igabem_formulation_row *row = igabem_formulation_info(formulation);
    return row ? row->name : NULL;
}

bool igabem_formulation_parse(const char *name, igabem_formulation *formulation)
{
    for (unsigned k = 0; k < ROWS && name && formulation; k++)
        if (strcmp(name, table[k].name) == 0) {
            *formulation = (igabem_formulation)k;
            return true;
        }
    return false;
}

igabem_formulation formulation_choose(const igabem_hull *hull)
{
    return hull->transom && hull->surface_piercing ? IGABEM_FORMULATION_NEUMANN_KELVIN_STERN
                                                   : IGABEM_FORMULATION_NEUMANN_KELVIN;
}

bool formulation_solves(const igabem_options *options)
{
    return options->kernel != IGABEM_KERNEL_KELVIN || table[options->formulation].solves;
}

bool formulation_has_potential(const igabem_options *options)
{
    return options->kernel == IGABEM_KERNEL_KELVIN && table[options->formulation].potential;
}

bool formulation_has_image(const igabem_options *options)
{
    return formulation_solves(options) && options->kernel != IGABEM_KERNEL_RANKINE;
}

bool formulation_has_waves(const igabem_options *options)
{
    return options->kernel == IGABEM_KERNEL_KELVIN && table[options->formulation].kelvin_rows;
}
