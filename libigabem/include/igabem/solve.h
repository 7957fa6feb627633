/**
 * @file solve.h
 * Steady potential flow past a hull by isogeometric collocation: source density in the NURBS basis
 * of the hull itself (refined on request), Greville points, and the resistance of the waves it
 * makes.
 *
 *     sigma/2 + Int_S sigma dG/dn dS - (1/k0) Oint chi sigma n_x nu_x dG/dn dl = U n_x
 *
 * (Brard 1972; Baar and Price 1988; Belibassakis et al. 2013). docs/theory.md has every sign.
 */
#ifndef IGABEM_SOLVE_H
#define IGABEM_SOLVE_H

#include <igabem/formulation.h>
#include <igabem/hull.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Which Green function: the simple ones test the machinery. */
typedef enum igabem_kernel {
    IGABEM_KERNEL_KELVIN,      /**< -1/r + 1/r' + k0 (N + W) */
    IGABEM_KERNEL_DOUBLE_BODY, /**< -1/r - 1/r': rigid still water, the limit Fr -> 0 */
    IGABEM_KERNEL_RANKINE      /**< -1/r: unbounded fluid */
} igabem_kernel;

/** How the linear system is solved. */
typedef enum igabem_solver {
    IGABEM_SOLVER_AUTO, /**< LU below 1000 unknowns, else GMRES, and LU should that fail */
    IGABEM_SOLVER_LU,   /**< LU with partial pivoting, O(n^3) */
    IGABEM_SOLVER_GMRES /**< restarted GMRES with a band around the diagonal, in order of x, as
                           preconditioner, to a relative residual of 1e-12, O(n^2) an iteration;
                           IGABEM_ERROR_NUMERIC when it does not converge */
} igabem_solver;

/** Receives progress in [0,1], in the thread that called: after every hundredth, else twice a
 * second, as far as rows of matrices, blocks of factors and iterations are done by then. A non-zero
 * return cancels (IGABEM_ERROR_CANCELLED). */
typedef int (*igabem_progress)(void *user_data, double fraction);

/** All settings of a solve. NAN means "by the rule that the field's comment gives". */
typedef struct igabem_options {
    double froude;        /**< U / sqrt(g L), > 0, at most 100; no default for the Kelvin kernel */
    double gravity;       /**< m/s^2; 9.80665 */
    double density;       /**< kg/m^3; 1000 */
    igabem_kernel kernel; /**< IGABEM_KERNEL_KELVIN */
    igabem_formulation formulation; /**< IGABEM_FORMULATION_AUTO */

    int refine;     /**< each knot span split in this many (l of the paper's eq. 14); 0 (default):
                       1 with refine_v, elements_u or elements_v, else by igabem_options_refine() for
                       400 unknowns */
    int refine_v;   /**< the same around the hull, refine then being along it: the direction of a
                       patch that gains more in x is along; 0: like refine */
    int elements_u; /**< > 0: the density has its own uniform knots with this many spans along the
                       hull (times refine), whatever the knots of the hull; several patches share
                       them by their length, each at least 1, and one that lies across the hull (a
                       transom) takes spans as wide as those around; 0: the hull's own knots; -1
                       (default): own knots, as many as the hull has or the 400 unknowns need, when
                       the spans of a patch differ by more than a factor of 3, as after knot
                       removal; else 0 */
    int elements_v; /**< the same around the half girth; -1 */
    double waterline_span; /**< own knots keep spans along a waterline at least this wide, as a
                              share of the girth (of the range of the parameter on one patch), and
                              are graded away from it when they would be narrower; 0: always
                              uniform; 0.1 */
    int degree;            /**< least degree of the density; 3: lower geometry is elevated */

    int line_term;        /**< Brard's waterline integral on (1) or off (0); 1 */
    double cutoff_angle;  /**< t_c of the filter exp(-((1+t^2)/(1+t_c^2))^2), t = tan(theta); NAN:
                             cutoff_factor/nu_s;  INFINITY: no filter (the default when submerged) */
    double cutoff_factor; /**< 1.2 */
    double stem_limit;    /**< nu_c of chi = 1/(1+(|nu_x|/nu_c)^4); NAN: 2 nu_s, with a transom 1.2
                             nu_s */
    double stern_length;  /**< x_s - x_aft of neumann-kelvin-stern as a share of the length, 0 to 1;
                             NAN: 0.35 min(1, (Fr/0.35)^2), below Fr 0.35 this is 2.86 U^2/g */
    double stern_blend;   /**< width of the switch there as a share of the length; 0.014 */
    double spectrum_limit; /**< largest t of the Kochin integral when surface-piercing; 20, of which
                              a formulation with a potential takes 8 at most, a double model 4.
                              Waves whose phase k0 sqrt(1+t^2) (L + t B) along the hull exceeds 3e4
                              are refused (B/L 0.1, t 20: below Fr 0.045) */

    double tolerance;         /**< relative error asked of the quadrature; 1e-5 */
    igabem_solver solver;     /**< IGABEM_SOLVER_AUTO */
    int sensitivity;          /**< also C_w at 0.85 and 1.15 of the cut-off; 0 */
    int threads;              /**< of OpenMP, and of the BLAS of the whole process during a call; 0:
                                 as they decide; at most 1024 */
    igabem_progress progress; /**< NULL: none */
    void *progress_user_data;

    /* Of a formulation with a potential, the free surface that it solves on; 0: by the rule given.
     */
    double surface_cells;      /**< cells along the hull; 48, over a submerged one 24 */
    double surface_rows;       /**< rows of cells from the hull outwards; a third of those */
    double surface_first;      /**< width of the first row as a share of a cell's length, at least
                                  1.25 times the waterline's slope; 0.5, 1.3 times that slope if
                                  that is more, over a submerged hull 1 */
    double surface_damping;    /**< factor of the least damping of short waves across the stream
                                  (theory.md, section 12), at least 1e-6; 1 */
    double surface_upstream;   /**< extent ahead of the hull as a share of its length; 0.5, over a
                                  submerged one 2 */
    double surface_downstream; /**< aft of it; 1 */
    double surface_side;       /**< from the centre line outwards; 0.75 */
    double surface_columns;    /**< of cells aft of the half of a dry transom; 6 */
    double keep_system;        /**< 1: the solution keeps its system, 24 dofs^2 bytes (exterior: 8
                                  times the square of all unknowns), so that
                                  igabem_tangent_create() need not assemble it again; 0 */
    double reserved[7];        /**< 0: room for members of later releases */
} igabem_options;

/** Fills the defaults; nothing when NULL. */
IGABEM_API void igabem_options_init(igabem_options *options);

/** Replaces every NAN, IGABEM_FORMULATION_AUTO and refine 0 by what the rules give on this hull.
 * Over an optimisation, freeze once on the parent hull: C_w is then a smooth function of the shape.
 */
IGABEM_API igabem_status igabem_options_freeze(const igabem_hull *hull, igabem_options *options);

/** Sets refine and refine_v so that the knots of the hull give at least so many unknowns (64 parts
 * a span at most): a hull has as many spans as its shape needs, perhaps a single one, and waves
 * need more. 400 keep C_w of a Wigley hull within 1 % of its limit for Fr >= 0.25 and that of a
 * submerged spheroid within 1e-3 for Fr >= 0.30. A hull with more is left at 1. Where elements_u
 * and elements_v are -1 and the rule gives own knots, these get so many, and refine and refine_v
 * are 1.
 */
IGABEM_API void igabem_options_refine(const igabem_hull *hull, size_t unknowns,
                                      igabem_options *options);

typedef struct igabem_solution igabem_solution;

/** Solves. options->froude is ignored by the double-body and Rankine kernels. */
IGABEM_API igabem_status igabem_solve(const igabem_hull *hull, const igabem_options *options,
                                      igabem_solution **solution);
/** Several settings on one hull (formulations, Froude numbers, filters): everything that they
 * share, such as the Rankine integrals of equal refine, degree and tolerance, is computed once.
 * Fills solutions[n]; on error all are NULL. */
IGABEM_API igabem_status igabem_solve_many(const igabem_hull *hull, size_t n,
                                           const igabem_options *options,
                                           igabem_solution **solutions);
/** Frees a solution; takes NULL. */
IGABEM_API void igabem_solution_free(igabem_solution *solution);

/** Work of the quadrature of a solve: each singular, near or far pair is a collocation point, or a
 * mirror image of it, and an element (or a group of elements, when far); of 1/r and N together.
 * Of what several settings share, 1/r is counted in each of them and N in the first. */
typedef struct igabem_cost {
    size_t singular_pairs; /**< the element contains the point */
    size_t near_pairs;     /**< divided towards the point, or at the plane x = x_P */
    size_t far_pairs;      /**< one of the fixed rules */
    size_t rankine;        /**< evaluations of grad 1/r */
    size_t local;          /**< evaluations of grad N */
    size_t wave;           /**< plane waves at a node: nodes times wave angles */
    double reserved[4];    /**< 0: room for members of later releases */
} igabem_cost;

/** Resistance and what qualifies it. Coefficients: R / (rho U^2 S / 2), S both sides at rest. NAN
 * where a formulation has no such figure. */
typedef struct igabem_forces {
    double speed, k0;           /**< U, m/s; g/U^2, 1/m */
    double wetted_area, volume; /**< m^2, m^3 */
    double rw;                  /**< wave resistance by the Kochin function, N */
    double cw;                  /**< its coefficient */
    double cw_l2;               /**< rw / (rho U^2 L^2 / 2) */
    double cw_pressure;         /**< by integrating the pressure over the hull; of double-model the
                                   pressure linear in what the flow differs from the double
                                   body's by */
    double cw_pressure_linear;  /**< the same without the quadratic and run-up terms */
    double cw_run_up;           /**< part of cw_pressure from the strip between water and wave */
    double cw_transom; /**< what a dry transom adds to cw_pressure: the hydrostatic pressure
                          that is missing on it; NAN without an open transom */
    double cw_cutoff_lower,
        cw_cutoff_upper;        /**< cw at 0.85 and 1.15 of the cut-off (options.sensitivity) */
    double share_beyond_cutoff; /**< part of cw from t > t_c */
    double sinkage, trim;       /**< linear: m, positive down; radians, positive bow up */
    double condition;           /**< 1-norm estimate of the matrix */
    size_t iterations;          /**< of GMRES; 0 with LU */
    double residual;            /**< relative, of GMRES; NAN with LU */
    double seconds;             /**< wall clock of the solve */
    double memory;    /**< bytes of its influences and matrix, what grows as dofs^2; 0 without
                         a solve */
    size_t dofs;      /**< unknowns on the modelled part of the hull */
    igabem_cost cost; /**< of its quadrature */
    double unknowns_per_wave; /**< along the hull, where they are fewest, in a transverse wave
                                 length 2 pi/k0 */
    double cw_error;          /**< discretisation error of cw, of either sign: an estimate from what
                                 the same equations give on half the knots, within a factor of 3
                                 for three meshes out of five, else mostly more
                                 (docs/validation.md). NAN without a solve and with a potential */
    double cw_momentum; /**< what the momentum of the water that was solved says of cw, equal to
                           it but for discretisation (docs/theory.md, sections 7 and 14); NAN
                           where the two have none in common */
    double reserved[6]; /**< 0: room for members of later releases */
} igabem_forces;

/** Fills forces. */
IGABEM_API igabem_status igabem_forces_compute(const igabem_solution *solution,
                                               igabem_forces *forces);

/** Why a result may be wrong though the solve succeeded, sentence by sentence: what
 * igabem_hull_warning() says as far as the formulation feels it, a mesh too coarse for the waves, a
 * speed or an attitude beyond linear theory, pressure and Kochin function apart, a pressure
 * resistance below zero.
 * @param forces of that solution; NULL: what can be said without them
 * @return NULL from the first number on that has none. Borrowed: valid until the next such call of
 *         this thread. */
IGABEM_API const char *igabem_solution_warning(const igabem_solution *solution,
                                               const igabem_forces *forces, size_t number);

/** Resistance of a hull of libnurbs in one call: igabem_hull_from(), igabem_solve(),
 * igabem_forces_compute(). Over an optimisation freeze the options on the parent first. */
IGABEM_API igabem_status igabem_solve_hull(const nurbs_hull *hull, const igabem_options *options,
                                           igabem_forces *forces);

/** The settings as they were used: no NAN, no automatic. Borrowed; NULL of NULL. */
IGABEM_API const igabem_options *igabem_solution_options(const igabem_solution *solution);

/** Free-surface elevation at n points (x, y), m: zeta = (U/g) phi_x at z = 0, filtered like the
 * solution. Fills zeta[n]; NAN inside the waterplane. Points further from the bow than 3e4/k0 are
 * refused, of a formulation with a potential those off the free surface that it solved. */
IGABEM_API igabem_status igabem_wave_elevation(const igabem_solution *solution, size_t n,
                                               const double *x, const double *y, double *zeta);

/** Disturbance velocity grad phi on the hull at n parameters uv of a patch: fills velocity[n][3],
 * m/s; pressure coefficient Cp = p_dyn/(rho U^2/2) into cp[n] if not NULL. */
IGABEM_API igabem_status igabem_surface_velocity(const igabem_solution *solution, size_t patch,
                                                 size_t n, const double *uv, double *velocity,
                                                 double *cp);

/** Source density at n parameters uv of a patch: fills sigma[n], m/s. Refused by a formulation with
 * a potential, which has none. */
IGABEM_API igabem_status igabem_source_density(const igabem_solution *solution, size_t patch,
                                               size_t n, const double *uv, double *sigma);

/** Kochin function at n wave angles t = tan(theta), as large as options.spectrum_limit may be:
 * fills h[n][2], real and imaginary part, and, if not NULL, dcw[n] = d C_w / d t. */
IGABEM_API igabem_status igabem_kochin(const igabem_solution *solution, size_t n, const double *t,
                                       double h[][2], double *dcw);

/** Shares of C_w (Kochin) of zones along the hull: zone k has the sources between x[k-1] and x[k],
 * zone 0 those ahead of x[0], zone n those aft of x[n-1] (x[n] decreases from the bow, m). The
 * interference of two zones goes to both in equal parts, so a share may be negative. Fills
 * share[n + 1], which add up to 1. */
IGABEM_API igabem_status igabem_wave_shares(const igabem_solution *solution, size_t n,
                                            const double *x, double *share);

/** Nodes of the free surface that a formulation with a potential has solved, y >= 0: size[0] lines
 * from the one farthest ahead, size[1] nodes of each outwards, those over the strip aft of a dry
 * transom first; x and y (m) of node (i, j) at i size[1] + j. The nodes of the strip lie inside the
 * water plane, where igabem_wave_elevation() gives NAN, ahead of its beginning. x, y NULL: only
 * size. Errors: IGABEM_ERROR_ARGUMENT: another formulation. */
IGABEM_API igabem_status igabem_free_surface_grid(const igabem_solution *solution, size_t size[2],
                                                  double *x, double *y);

/** C_w from the waves along the line y = const beside a symmetric hull, given as a half or whole
 * (Eggers, Sharma and Ward 1967), m; NAN: a transverse wave length off the side. It holds a part of
 * the local disturbance of relative size e^{-k0 (y - B/2)}, and waves as filtered by the cut-off,
 * which the Kochin function is not. Costs some thousand elevations.
 *
 * Of a formulation with a potential: through the free surface that was solved, up to t = 4. Free
 * waves fitted to the elevations behind the ship continue the cut aft and give its small angles
 * (docs/theory.md, section 8); NAN: a twentieth of the length off the side. Errors:
 * IGABEM_ERROR_ARGUMENT: y beyond the surface; a surface that ends less than 1.2 transverse wave
 * lengths aft of the hull. */
IGABEM_API igabem_status igabem_wave_cut(const igabem_solution *solution, double y, double *cw);

#ifdef __cplusplus
}
#endif

#endif
