/**
 * @file nurbs.h
 * B-spline and NURBS curves and surfaces for hulls: everything of libnurbs in one include.
 *
 * Conventions. Knot vectors are clamped and complete: n + p + 1 knots for n control points of
 * degree p. Control points are Cartesian (not multiplied by their weights), x,y,z triples; a
 * surface's net has u slow and v fast, point (i,j) at index i*nv + j. Lengths are in metres.
 * Evaluation never allocates.
 */
#ifndef NURBS_NURBS_H
#define NURBS_NURBS_H

#include <nurbs/basis.h>
#include <nurbs/curve.h>
#include <nurbs/fit.h>
#include <nurbs/geometry.h>
#include <nurbs/grid.h>
#include <nurbs/hull.h>
#include <nurbs/integrals.h>
#include <nurbs/invert.h>
#include <nurbs/io.h>
#include <nurbs/mesh.h>
#include <nurbs/modify.h>
#include <nurbs/offsets.h>
#include <nurbs/particulars.h>
#include <nurbs/patches.h>
#include <nurbs/primitives.h>
#include <nurbs/section.h>
#include <nurbs/sections.h>
#include <nurbs/simplify.h>
#include <nurbs/status.h>
#include <nurbs/surface.h>
#include <nurbs/topology.h>
#include <nurbs/trim.h>
#include <nurbs/version.h>

#endif
