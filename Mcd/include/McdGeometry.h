/** @file McdGeometry.h
 *  Functions of all geometries.
 *
 *  A geometry is a shape without a place. Models and aggregates share geometries and count as references; a geometry
 *  is destroyed after them. A change of its size takes effect at the next update of its models.
 */
#ifndef MCDGEOMETRY_H
#define MCDGEOMETRY_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** Destroys a geometry. If models or aggregates still use it: a warning, and it stays. Null is ignored. */
MEPUBLIC void MEAPI McdGeometryDestroy(McdGeometryID g);
/** Whether it is a live geometry of a registered type. */
MEPUBLIC MeBool MEAPI McdGeometryIsValid(McdGeometryID g);
/** Statement: warns if g is not valid. */
#define MCDGEOMETRY_CHECK_ISVALID(g) ((void)(McdGeometryIsValid(g) || (MeWarning(0, "%s is no geometry", #g), 0)))

/** The number of its type. -1, with a warning, if it is not a geometry. */
MEPUBLIC int MEAPI McdGeometryGetType(const McdGeometryID g);
/** As McdGeometryGetType. */
MEPUBLIC int MEAPI McdGeometryGetTypeId(const McdGeometryID g);
/** The type's name. */
MEPUBLIC const char *MEAPI McdGeometryGetTypeName(const McdGeometryID g);
/** The framework it belongs to. */
MEPUBLIC McdFrameworkID MEAPI McdGeometryGetFramework(const McdGeometryID g);
/** The function that intersects line segments with models of it, or null. */
MEPUBLIC McdLineSegIntersectFnPtr MEAPI McdGeometryGetLineSegIntersectFnPtr(McdGeometryID g);

/** The bounding box along the world's axes of the geometry at @a tm. */
MEPUBLIC void MEAPI McdGeometryGetAABB(McdGeometryID g, const MeMatrix4 tm, MeVector3 minCorner, MeVector3 maxCorner);
/** A bounding sphere of the geometry, in its own frame. */
MEPUBLIC void MEAPI McdGeometryGetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius);
/** The point of the geometry at @a tm that is farthest in the world direction @a inDir. */
MEPUBLIC void MEAPI McdGeometryMaximumPoint(McdGeometryID g, const MeMatrix4 tm, MeReal *const inDir,
                                            MeReal *const outPoint);
/**
 * The mass properties for unit density. relativeTransform: the centre of mass (and the geometry's own axes), in the
 * geometry's frame; inertiaMatrix: the inertia about that centre along those axes (m^5); volume (m^3): equal to the
 * mass. Returns 0 for geometries without mass properties (planes, triangle lists, height fields, null), and if they
 * exceed the range of MeReal.
 */
MEPUBLIC MeI16 MEAPI McdGeometryGetMassProperties(McdGeometryID g, MeMatrix4 relativeTransform, MeMatrix3 inertiaMatrix,
                                                  MeReal *volume);
/** Draws the geometry at @a tm by MeDebugDrawAPI. */
MEPUBLIC void MEAPI McdGeometryDebugDraw(const McdGeometryID g, const MeMatrix4Ptr tm, const MeReal colour[3]);

/**
 * Announces that the program has changed data that it keeps for a geometry: the heights of a height field, the
 * triangles that a list's callback returns, data read by functions of the program's own types. To be called after the
 * change, between steps, once for all changes of a step. Each model of the geometry, or of an aggregate that contains
 * it, gets a new box, and all its pairs are tested in the next step: sleeping bodies wake if any bit of their contacts
 * changed. The cost is proportional to the number of the framework's models, and for a height field to its number of
 * heights.
 *
 * Without the call a change takes effect later for sleeping bodies: pairs with a body that is awake are tested in each
 * step and see the change in the next one; a sleeping body may stay in place until something wakes it. The box of a
 * height field is not updated: models entirely above or below the old box do not touch heights beyond it. If @a g is
 * not a live geometry: a warning. Beyond Karma; McdRGHeightFieldUpdateHeights is the same for height fields.
 */
MEPUBLIC void MEAPI McdGeometryUpdate(McdGeometryID g);

/** @name For geometry types of a program
 *  @{ */
/** Initializes the head of a geometry of a registered type; the record begins at @a g. */
MEPUBLIC void MEAPI McdGeometryInit(McdGeometryID g, McdFramework *frame, MeI16 typeId);
/** Releases the head: removes the geometry from its framework. */
MEPUBLIC void MEAPI McdGeometryDeinit(McdGeometryID g);
/** The number of models and aggregates that use it: McdGeometryDestroy refuses above 0. A type of a program changes it
 *  only for references of its own. */
MEPUBLIC int MEAPI McdGeometryGetReferenceCount(const McdGeometryID g);
/** Sets the number; references that were counted before are lost. */
MEPUBLIC void MEAPI McdGeometrySetReferenceCount(McdGeometryID g, int refCount);
/** Adds a reference of the program's own: the geometry cannot be destroyed meanwhile. */
MEPUBLIC void MEAPI McdGeometryIncrementReferenceCount(McdGeometryID g);
/** Ends such a reference. */
MEPUBLIC void MEAPI McdGeometryDecrementReferenceCount(McdGeometryID g);
/** @} */

ME_END_C

#endif
