/** @file McdAll.h
 *  Every geometry type and interaction of the library at once: for programs that would rather not choose. Beyond Karma.
 */
#ifndef MCDALL_H
#define MCDALL_H

#include "McdCTypes.h"

ME_BEGIN_C

/** Registers all built-in geometry types: null, sphere, box, plane, cylinder, sphyl, cone, convex mesh, triangle list,
 *  height field, aggregate. Warns and does nothing if the framework is none. */
MEPUBLIC void MEAPI McdAllRegisterTypes(McdFramework *frame);
/**
 * Has all of them interact, and line segments with all but triangle lists (which the guide leaves to the program; see
 * McdTriangleListLineSegmentRegisterInteraction). Types of a program's own that aggregates are to meet are registered
 * before. Returns 1; 0 if the framework is none.
 */
MEPUBLIC MeBool MEAPI McdAllRegisterInteractions(McdFramework *frame);

ME_END_C

#endif
