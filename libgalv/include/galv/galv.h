/**
 * @file galv.h
 * Geometrically active latent variables: everything of libgalv.
 *
 * A family of shape modifications with n parameters (shape.h) is sampled on the points of a hull,
 * and the few directions that carry the geometric variance of the samples span the latent space
 * (model.h); what a latent point's hull will be like is known before it is built (limits.h).
 * Equation numbers refer to Khan, Kaklis, Kostas, Serani and Diez, "Bayesian shape optimisation in
 * high dimensional design spaces using isogeometric boundary element analysis".
 *
 * Conventions: SI units; points are x,y,z triples; a displacement vector d holds 3 npoints numbers
 * in the same order (dx, dy, dz of point 0, then of point 1, ...; eq. 3 lists all dx first, which
 * changes no eigenvalue). The library prints nothing, keeps no state between calls and uses the
 * calling program's OpenMP and BLAS thread settings.
 */
#ifndef GALV_GALV_H
#define GALV_GALV_H

#include <galv/limits.h>
#include <galv/model.h>
#include <galv/moments.h>
#include <galv/particulars.h>
#include <galv/shape.h>
#include <galv/status.h>
#include <galv/version.h>

#endif
