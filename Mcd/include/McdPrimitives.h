/** @file McdPrimitives.h
 *  Registers the simple geometries: sphere, box, plane, cylinder, sphyl, and the triangle list for terrain. If the
 *  argument is not a framework: a warning, and no effect.
 */
#ifndef MCDPRIMITIVES_H
#define MCDPRIMITIVES_H

#include "McdBox.h"
#include "McdCylinder.h"
#include "McdPlane.h"
#include "McdSphere.h"
#include "McdSphyl.h"

ME_BEGIN_C

/** The number of types that McdPrimitivesRegisterTypes registers. They are built in: McdInit's geoTypeMaxCount need
 *  not include them, but may. */
MEPUBLIC unsigned int MEAPI McdPrimitivesGetTypeCount(void);
/** Registers sphere, box, plane, cylinder, sphyl and triangle list; required before their geometries are created. */
MEPUBLIC void MEAPI McdPrimitivesRegisterTypes(McdFramework *frame);
/** Registers the interactions of each two of these types, except of planes and triangle lists with each other, and
 *  of line segments with all of them except the triangle list (see McdTriangleListLineSegmentRegisterInteraction).
 *  Returns 1; 0 if @a frame is not a framework. */
MEPUBLIC MeBool MEAPI McdPrimitivesRegisterInteractions(McdFramework *frame);
/** Registers the types, and the interactions, of sphere, box and plane only, so that less is linked. */
MEPUBLIC void MEAPI McdSphereBoxPlaneRegisterTypes(McdFramework *frame);
/** Registers those of each two of the three, except of planes with each other. */
MEPUBLIC void MEAPI McdSphereBoxPlaneRegisterInteractions(McdFramework *frame);

ME_END_C

#endif
