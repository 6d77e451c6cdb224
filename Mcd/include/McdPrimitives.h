/** @file McdPrimitives.h
 *  The simple geometries at once: sphere, box, plane, cylinder, sphyl, and the triangle list to put them on (User Guide
 *  ch. 4, "Register Types of Geometries to be Used"). All functions warn and do nothing if the framework is none.
 */
#ifndef MCDPRIMITIVES_H
#define MCDPRIMITIVES_H

#include "McdBox.h"
#include "McdCylinder.h"
#include "McdPlane.h"
#include "McdSphere.h"
#include "McdSphyl.h"

ME_BEGIN_C

/** How many types McdPrimitivesRegisterTypes registers. They are built in: McdInit's geoTypeMaxCount need not count
 *  them, but may. */
MEPUBLIC unsigned int MEAPI McdPrimitivesGetTypeCount(void);
/** Registers sphere, box, plane, cylinder, sphyl and triangle list. Before their geometries are created. */
MEPUBLIC void MEAPI McdPrimitivesRegisterTypes(McdFramework *frame);
/** Has each two of them interact, but for planes and triangle lists with each other, and line segments with each but
 *  the triangle list (see McdTriangleListLineSegmentRegisterInteraction). Returns 1; 0 if the framework is none. */
MEPUBLIC MeBool MEAPI McdPrimitivesRegisterInteractions(McdFramework *frame);
/** The same for sphere, box and plane only, so that less is linked. */
MEPUBLIC void MEAPI McdSphereBoxPlaneRegisterTypes(McdFramework *frame);
MEPUBLIC void MEAPI McdSphereBoxPlaneRegisterInteractions(McdFramework *frame);

ME_END_C

#endif
