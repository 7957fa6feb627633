/**
 * @file igabem.h
 * Isogeometric boundary elements for steady ship waves: everything of libigabem in one include.
 */
#ifndef IGABEM_IGABEM_H
#define IGABEM_IGABEM_H

#include <igabem/equilibrium.h>
#include <igabem/formulation.h>
#include <igabem/friction.h>
#include <igabem/hull.h>
#include <igabem/kelvin.h>
#include <igabem/ladder.h>
#include <igabem/panel.h>
#include <igabem/residual.h>
#include <igabem/solve.h>
#include <igabem/status.h>
#include <igabem/tangent.h>
#include <igabem/version.h>

#endif
