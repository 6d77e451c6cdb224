/** @file McdGeometry.h
 *  What all geometries have (User Guide ch. 4, "Explanation of Model, Geometry, and Body").
 *
 *  A geometry is a shape without a place. Models and aggregates share it and count as references; it is destroyed after
 *  them. A change of its size counts from the next update of its models on.
 */
#ifndef MCDGEOMETRY_H
#define MCDGEOMETRY_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** Destroys a geometry. One that models or aggregates still use gets a warning and stays. Null does nothing. */
MEPUBLIC void MEAPI McdGeometryDestroy(McdGeometryID g);
/** Is it a live geometry of a registered type? */
MEPUBLIC MeBool MEAPI McdGeometryIsValid(McdGeometryID g);
/** A statement: warns if it is not. */
#define MCDGEOMETRY_CHECK_ISVALID(g) ((void)(McdGeometryIsValid(g) || (MeWarning(0, "%s is no geometry", #g), 0)))

/** The type's number. -1 for what is no geometry. */
MEPUBLIC int MEAPI McdGeometryGetType(const McdGeometryID g);
/** The same. */
MEPUBLIC int MEAPI McdGeometryGetTypeId(const McdGeometryID g);
/** The type's name. */
MEPUBLIC const char *MEAPI McdGeometryGetTypeName(const McdGeometryID g);
/** The framework it belongs to. */
MEPUBLIC McdFrameworkID MEAPI McdGeometryGetFramework(const McdGeometryID g);
/** How a line segment meets models of it, or null. */
MEPUBLIC McdLineSegIntersectFnPtr MEAPI McdGeometryGetLineSegIntersectFnPtr(McdGeometryID g);

/** The box along the world's axes around the geometry at @a tm. */
MEPUBLIC void MEAPI McdGeometryGetAABB(McdGeometryID g, const MeMatrix4 tm, MeVector3 minCorner, MeVector3 maxCorner);
/** A sphere around the geometry, in its own frame. */
MEPUBLIC void MEAPI McdGeometryGetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius);
/** The point of the geometry at @a tm that is farthest in the world direction @a inDir. */
MEPUBLIC void MEAPI McdGeometryMaximumPoint(McdGeometryID g, const MeMatrix4 tm, MeReal *const inDir,
                                            MeReal *const outPoint);
/**
 * The mass properties for unit density: relativeTransform gets the centre of mass (and axes, the geometry's own), in
 * the geometry's frame; inertiaMatrix the inertia about that centre along those axes (m^5); volume (m^3) is the mass.
 * Returns 0 for geometries without: planes, triangle lists, height fields, null; and for those so large that these are
 * beyond MeReal.
 */
MEPUBLIC MeI16 MEAPI McdGeometryGetMassProperties(McdGeometryID g, MeMatrix4 relativeTransform, MeMatrix3 inertiaMatrix,
                                                  MeReal *volume);
/** Draws the geometry at @a tm by MeDebugDrawAPI. */
MEPUBLIC void MEAPI McdGeometryDebugDraw(const McdGeometryID g, const MeMatrix4Ptr tm, const MeReal colour[3]);

/**
 * Says that what the program keeps for a geometry was changed: the heights of a height field, the triangles that a
 * list's callback hands over, what functions of the program's own types read. To be called after the change, between
 * steps; once for all changes of a step. Each model of the geometry, or of aggregates with it, gets a new box, and all
 * its pairs are tested in the next step: bodies asleep wake if a bit of their contacts is another. It takes time as the
 * framework's models, and for a height field as all of its heights.
 *
 * Without the call a change counts as well, but later where bodies sleep: pairs of which a body is awake are tested in
 * each step and meet the change in the next one; a body asleep may stay as it is until something wakes it, and then
 * meets it. The box of a height field stays as it was: models wholly above or below that box meet nothing of heights
 * beyond it. What is no live geometry gets a warning. Beyond Karma; McdRGHeightFieldUpdateHeights is the same for
 * height fields.
 */
MEPUBLIC void MEAPI McdGeometryUpdate(McdGeometryID g);

/** @name For geometry types of a program
 *  @{ */
/** Makes the head of a geometry that begins at @a g, of a registered type. */
MEPUBLIC void MEAPI McdGeometryInit(McdGeometryID g, McdFramework *frame, MeI16 typeId);
/** Undoes that. */
MEPUBLIC void MEAPI McdGeometryDeinit(McdGeometryID g);
MEPUBLIC int MEAPI McdGeometryGetReferenceCount(const McdGeometryID g);
MEPUBLIC void MEAPI McdGeometrySetReferenceCount(McdGeometryID g, int refCount);
MEPUBLIC void MEAPI McdGeometryIncrementReferenceCount(McdGeometryID g);
MEPUBLIC void MEAPI McdGeometryDecrementReferenceCount(McdGeometryID g);
/** @} */

ME_END_C

#endif
