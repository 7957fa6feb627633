#include "core/error.h"
#include "solve/formulation.h"
#include "solve/resolution.h"

#include <math.h>

static const size_t enough_unknowns = 400;
static const double irregular_spans = 3.0;
static const double most_froude = 100.0;
static const int most_threads = 1024;
static const double transom_stem_factor = 1.2, stem_factor = 2.0;
/* x_s - x_aft: this share of the length, at lower speeds 0.45 transverse wave lengths 2 pi/k0. */
static const double stern_share = 0.35, stern_froude = 0.35;

void igabem_options_init(igabem_options *options)
{
    if (!options)
        return;
    *options = (igabem_options){.froude = NAN,
                                .gravity = 9.80665,
                                .density = 1000.0,
                                .kernel = IGABEM_KERNEL_KELVIN,
                                .formulation = IGABEM_FORMULATION_AUTO,
                                .elements_u = -1,
                                .elements_v = -1,
                                .waterline_span = 0.1,
                                .degree = 3,
                                .line_term = 1,
                                .cutoff_angle = NAN,
                                .cutoff_factor = 1.2,
                                .stem_limit = NAN,
                                .stern_length = NAN,
                                .stern_blend = 0.014,
                                .spectrum_limit = 20.0,
                                .tolerance = 1e-5};
}

static igabem_status check_positive(const char *name, double value)
{
    if (value > 0 && isfinite(value))
        return IGABEM_OK;
    return igabem_fail(IGABEM_ERROR_ARGUMENT, "%s is %g, expected a positive number", name, value);
}

static igabem_status check_range(const char *name, double value, double lower, double upper)
{
    if (value >= lower && value <= upper)
        return IGABEM_OK;
    return igabem_fail(IGABEM_ERROR_ARGUMENT, "%s is %g, expected %g to %g", name, value, lower,
                       upper);
}

static igabem_status check(const igabem_options *options)
{
    igabem_status status = IGABEM_OK;
    if (options->kernel < IGABEM_KERNEL_KELVIN || options->kernel > IGABEM_KERNEL_RANKINE)
        status = igabem_fail(IGABEM_ERROR_ARGUMENT, "unknown kernel %d", (int)options->kernel);
    else if (options->solver < IGABEM_SOLVER_AUTO || options->solver > IGABEM_SOLVER_GMRES)
        status = igabem_fail(IGABEM_ERROR_ARGUMENT, "unknown solver %d", (int)options->solver);
    else if (!igabem_formulation_info(options->formulation))
        status =
            igabem_fail(IGABEM_ERROR_ARGUMENT, "unknown formulation %d", (int)options->formulation);
    if (status == IGABEM_OK && options->kernel == IGABEM_KERNEL_KELVIN)
        status = check_positive("Froude number", options->froude);
    if (status == IGABEM_OK && options->kernel == IGABEM_KERNEL_KELVIN)
        status = check_range("Froude number", options->froude, 0.0, most_froude);
    if (status == IGABEM_OK)
        status = check_positive("gravity", options->gravity);
    if (status == IGABEM_OK)
        status = check_positive("density of water", options->density);
    if (status == IGABEM_OK)
        status = check_range("refine", options->refine, 0, 1000);
    if (status == IGABEM_OK)
        status = check_range("refine_v", options->refine_v, 0, 1000);
    if (status == IGABEM_OK)
        status = check_range("elements_u", options->elements_u, -1, 100000);
    if (status == IGABEM_OK)
        status = check_range("elements_v", options->elements_v, -1, 100000);
    if (status == IGABEM_OK)
        status = check_range("degree", options->degree, 1, 9);
    if (status == IGABEM_OK)
        status = check_range("waterline_span", options->waterline_span, 0.0, 0.5);
    if (status == IGABEM_OK)
        status = check_range("tolerance", options->tolerance, 1e-12, 1e-2);
    if (status == IGABEM_OK && !isnan(options->stern_length))
        status = check_range("stern_length", options->stern_length, 0.0, 1.0);
    if (status == IGABEM_OK)
        status = check_range("stern_blend", options->stern_blend, 0.0, 1.0);
    if (status == IGABEM_OK)
        status = check_positive("spectrum_limit", options->spectrum_limit);
    if (status == IGABEM_OK)
        status = check_positive("cutoff_factor", options->cutoff_factor);
    if (status == IGABEM_OK)
        status = check_range("threads", options->threads, 0, most_threads);
    if (status == IGABEM_OK && options->surface_cells != 0.0)
        status = check_range("surface_cells", options->surface_cells, 4.0, 1000.0);
    if (status == IGABEM_OK && options->surface_rows != 0.0)
        status = check_range("surface_rows", options->surface_rows, 4.0, 1000.0);
    if (status == IGABEM_OK && options->surface_first != 0.0)
        status = check_range("surface_first", options->surface_first, 0.1, 10.0);
    if (status == IGABEM_OK && options->surface_damping != 0.0)
        status = check_range("surface_damping", options->surface_damping, 1e-6, 10.0);
    if (status == IGABEM_OK && options->surface_upstream != 0.0)
        status = check_range("surface_upstream", options->surface_upstream, 0.05, 10.0);
    if (status == IGABEM_OK && options->surface_downstream != 0.0)
        status = check_range("surface_downstream", options->surface_downstream, 0.05, 10.0);
    if (status == IGABEM_OK && options->surface_side != 0.0)
        status = check_range("surface_side", options->surface_side, 0.05, 10.0);
    if (status == IGABEM_OK && options->surface_columns != 0.0)
        status = check_range("surface_columns", options->surface_columns, 2.0, 1000.0);
    if (status == IGABEM_OK)
        status = check_range("keep_system", options->keep_system, 0.0, 1.0);
    return status;
}

/* Unknowns of patch p with so many spans along u and v. */
static double patch_unknowns(const struct hull_patch *patch, int least_degree, const int spans[2])
{
    double product = 1.0;
    for (int d = 0; d < 2; d++) {
        int degree = nurbs_surface_degree(patch->surface, d);
        product *= spans[d] + (degree > least_degree ? degree : least_degree);
    }
    return product;
}

/* With own knots, as the density shares them among the patches. */
static double count_own(const igabem_hull *hull, int least_degree, const int elements[2])
{
    double sum = 0.0;
    for (size_t p = 0; p < hull->n; p++) {
        int spans[2];
        for (int d = 0; d < 2; d++)
            spans[d] = hull_share(hull, p, d, elements[hull_is_around(&hull->patches[p], d)]);
        sum += patch_unknowns(&hull->patches[p], least_degree, spans);
    }
    return sum;
}

static int is_uneven(const igabem_hull *hull)
{
    int own = 0;
    for (size_t p = 0; p < hull->n; p++)
        for (int d = 0; d < 2; d++)
            own |= hull->patches[p].span_ratio[d] > irregular_spans;
    return own;
}

/* Knots that are crowded in some places and far apart in others waste unknowns here and lack them
 * there, and they move when the shape does: as many uniform ones as the hull has, or, where it has
 * few, enough. */
static void choose_elements(const igabem_hull *hull, size_t unknowns, igabem_options *options)
{
    int own = is_uneven(hull), uniform[2] = {0, 0};
    for (double factor = 1.0; own && factor < 16.0; factor *= 1.02) {
        for (int d = 0; d < 2; d++)
            uniform[d] = (int)lround(factor * hull->run_spans[d]);
        if (count_own(hull, options->degree, uniform) >= (double)unknowns)
            break;
    }
    if (options->elements_u < 0)
        options->elements_u = uniform[0];
    if (options->elements_v < 0)
        options->elements_v = uniform[1];
}

static void choose_refine(const igabem_hull *hull, igabem_options *options)
{
    if (options->refine_v > 0 || options->elements_u > 0 || options->elements_v > 0)
        options->refine = 1;
    else
        igabem_options_refine(hull, enough_unknowns, options);
}

/* Waves that the stern rows make and feel among themselves are shorter than the stern part if it is
 * longer than half a wave; kept longer it takes bow waves from rows that could bear them. */
static double stern_by_rule(const igabem_options *options)
{
    double ratio = options->froude / stern_froude;
    return ratio < 1.0 ? stern_share * ratio * ratio : stern_share;
}

static igabem_status choose_cutoff(const igabem_hull *hull, igabem_options *options)
{
    if (!hull->surface_piercing) {
        if (isnan(options->cutoff_angle))
            options->cutoff_angle = INFINITY;
        if (isnan(options->stem_limit))
            options->stem_limit = INFINITY;
    }
    if (isnan(options->cutoff_angle) || isnan(options->stem_limit)) {
        if (options->kernel == IGABEM_KERNEL_KELVIN && !(hull->nu_s > 0))
            return igabem_fail(
                IGABEM_ERROR_GEOMETRY,
                "the waterline has no entrance angle (nu_s = %g): state cutoff_angle "
                "and stem_limit",
                hull->nu_s);
        if (isnan(options->cutoff_angle))
            options->cutoff_angle = options->cutoff_factor / hull->nu_s;
        if (isnan(options->stem_limit))
            options->stem_limit = (hull->transom ? transom_stem_factor : stem_factor) * hull->nu_s;
    }
    if (!(options->cutoff_angle > 0))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "cutoff_angle is %g, expected > 0 or INFINITY",
                           options->cutoff_angle);
    if (!(options->stem_limit > 0))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "stem_limit is %g, expected > 0 or INFINITY",
                           options->stem_limit);
    return IGABEM_OK;
}

/* The condition at the upstream edge sends an error downstream that counts beside the waves of a
 * submerged body, which are weak for the disturbance that it makes (docs/experiments.md). */
static void choose_surface(const igabem_hull *hull, igabem_options *options)
{
    if (options->surface_cells == 0.0)
        options->surface_cells = hull->surface_piercing ? 48.0 : 24.0;
    if (options->surface_rows == 0.0)
        options->surface_rows = fmax(4.0, round(options->surface_cells / 3.0));
    if (options->surface_first == 0.0) {
        double slope = hull->nu_s / sqrt(fmax(0.1, 1.0 - hull->nu_s * hull->nu_s));
        options->surface_first = hull->surface_piercing ? fmax(0.5, 1.3 * slope) : 1.0;
    }
    if (options->surface_damping == 0.0)
        options->surface_damping = 1.0;
    if (options->surface_upstream == 0.0)
        options->surface_upstream = hull->surface_piercing ? 0.5 : 2.0;
    if (options->surface_downstream == 0.0)
        options->surface_downstream = 1.0;
    if (options->surface_side == 0.0)
        options->surface_side = 0.75;
    if (options->surface_columns == 0.0)
        options->surface_columns = 6.0;
}

igabem_status igabem_options_freeze(const igabem_hull *hull, igabem_options *options)
{
    if (!hull || !options)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_options_freeze");
    igabem_status status = check(options);
    if (status != IGABEM_OK)
        return status;
    choose_elements(hull, enough_unknowns, options);
    if (options->refine == 0)
        choose_refine(hull, options);
    if (options->refine_v == 0)
        options->refine_v = options->refine;
    if (options->formulation == IGABEM_FORMULATION_AUTO)
        options->formulation = formulation_choose(hull);
    choose_surface(hull, options);
    if (isnan(options->stern_length))
        options->stern_length = stern_by_rule(options);
    options->line_term = options->line_term && hull->surface_piercing;
    status = choose_cutoff(hull, options);
    return status == IGABEM_OK ? resolution_check(hull, options) : status;
}

/* Unknowns with the spans divided in so many parts along the hull and around it. */
static double count_unknowns(const igabem_hull *hull, int least_degree, const int parts[2])
{
    double sum = 0.0;
    for (size_t p = 0; p < hull->n; p++) {
        const struct hull_patch *patch = &hull->patches[p];
        int spans[2];
        for (int d = 0; d < 2; d++)
            spans[d] = (int)patch->spans[d] * parts[hull_is_around(patch, d)];
        sum += patch_unknowns(patch, least_degree, spans);
    }
    return sum;
}

/* Spans may be longer than wide by the square root of their patch's ratio: the direction along is
 * due to be divided when they are longer, in the mean over the patches. */
static int along_is_due(const igabem_hull *hull, const int parts[2])
{
    double sum = 0.0;
    for (size_t p = 0; p < hull->n; p++) {
        const struct hull_patch *patch = &hull->patches[p];
        int u = patch->along, v = 1 - u;
        if (u >= 0 && patch->length[v] > 0)
            sum += 0.5 * log(patch->length[u] / patch->length[v]) -
                   log((double)patch->spans[u] * parts[0] / ((double)patch->spans[v] * parts[1]));
    }
    return sum >= 0.0;
}

void igabem_options_refine(const igabem_hull *hull, size_t unknowns, igabem_options *options)
{
    enum { MOST_PARTS = 64 };
    int parts[2] = {1, 1};
    if (!hull || !options)
        return;
    /* Knots of its own have what is asked, and are not divided once more. */
    if (options->elements_u < 0 && options->elements_v < 0 && is_uneven(hull)) {
        choose_elements(hull, unknowns, options);
        options->refine = options->refine_v = 1;
        return;
    }
    while (count_unknowns(hull, options->degree, parts) < (double)unknowns &&
           parts[0] < MOST_PARTS && parts[1] < MOST_PARTS)
        parts[!along_is_due(hull, parts)]++;
    options->refine = parts[0];
    options->refine_v = parts[1];
}
