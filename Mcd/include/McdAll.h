/** @file McdAll.h
 *  Registers all geometry types and interactions of the library: for programs that need not choose. Beyond Karma.
 */
#ifndef MCDALL_H
#define MCDALL_H

#include "McdCTypes.h"

ME_BEGIN_C

/** Registers all built-in geometry types: null, sphere, box, plane, cylinder, sphyl, cone, convex mesh, triangle
 *  list, height field, mesh, aggregate. If @a frame is not a framework: a warning, and no effect. */
MEPUBLIC void MEAPI McdAllRegisterTypes(McdFramework *frame);
/**
 * Registers the interactions of all these types, and of line segments with all of them except triangle lists (which the
 * guide leaves to the program; see McdTriangleListLineSegmentRegisterInteraction). Register a program's own types first
 * if aggregates are to collide with them. Returns 1; 0, with a warning, if @a frame is not a framework.
 */
MEPUBLIC MeBool MEAPI McdAllRegisterInteractions(McdFramework *frame);

ME_END_C

#endif
