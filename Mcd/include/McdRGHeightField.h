/** @file McdRGHeightField.h
 *  Height fields: terrain over a regular grid, without a triangle list's callback. Karma had the type; its creation is
 *  designed here.
 *
 *  The grid lies along x and y of the field's frame, z is up: point (i, j), 0 <= i < xCount, 0 <= j < yCount, is at
 *  (x0 + i xStep, y0 + j yStep, heights[j xCount + i]). The cell between (i, j) and (i+1, j+1) is divided into two
 *  triangles by the line between these points: element 2 (j (xCount - 1) + i) on the side of (i+1, j), and the next
 *  number on the side of (i, j+1). A triangle with a NaN corner is a hole.
 *
 *  Up is outside. Contacts are as those of a triangle list with kMcdTriangleUseSmallestPenetration and all edges
 *  sharp: flat and concave edges have no effect. A model without other contacts whose centre is below the surface is
 *  pushed back up if the centre is no deeper than half of the model's radius.
 */
#ifndef MCDRGHEIGHTFIELD_H
#define MCDRGHEIGHTFIELD_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** Registers the geometry type; required before McdRGHeightFieldCreate. */
MEPUBLIC void MEAPI McdRGHeightFieldRegisterType(McdFramework *frame);
/**
 * Creates a height field.
 * @param heights       xCount yCount heights (m), row after row of x. Kept by pointer, and read in every query. Call
 *                      McdGeometryUpdate after changing them.
 * @param xCount,yCount number of points along x and y: 2 or more.
 * @param xStep,yStep   distance between points (m): > 0.
 * @param x0,y0         position of the first point (m).
 * @return null, with a warning, if an argument is out of range or the type is not registered.
 */
MEPUBLIC McdRGHeightFieldID MEAPI McdRGHeightFieldCreate(McdFramework *frame, const MeReal *heights, int xCount,
                                                         int yCount, MeReal xStep, MeReal yStep, MeReal x0, MeReal y0);

/** @name Accessors
 *  For a geometry that is not a height field: a warning, and a result of 0 or null.
 *  @{ */
/** The program's array, m. */
MEPUBLIC const MeReal *MEAPI McdRGHeightFieldGetHeights(McdRGHeightFieldID g);
/** Sets other heights, by pointer. */
MEPUBLIC void MEAPI McdRGHeightFieldSetHeights(McdRGHeightFieldID g, const MeReal *heights);
/** McdGeometryUpdate for a height field, to be called after heights have changed. Finds the lowest and the highest
 *  one, for the box. Without a universe, the models must be updated after it. */
MEPUBLIC void MEAPI McdRGHeightFieldUpdateHeights(McdRGHeightFieldID g);
/** Numbers of points, distances of points (m), and the place of the first one (m), as given at creation. */
MEPUBLIC void MEAPI McdRGHeightFieldGetCounts(McdRGHeightFieldID g, int *xCount, int *yCount);
/** m, > 0: distances of points along x and y. */
MEPUBLIC void MEAPI McdRGHeightFieldGetSteps(McdRGHeightFieldID g, MeReal *xStep, MeReal *yStep);
/** m: place of point (0, 0) in the field's frame. */
MEPUBLIC void MEAPI McdRGHeightFieldGetOrigin(McdRGHeightFieldID g, MeReal *x0, MeReal *y0);
/** Gets the height of the surface at (x, y) in its own frame and, unless @a normal is null, the surface normal. Returns
 *  false, and writes nothing, where there is no surface. */
MEPUBLIC MeBool MEAPI McdRGHeightFieldGetHeightAt(McdRGHeightFieldID g, MeReal x, MeReal y, MeReal *height,
                                                  MeVector3 normal);
/** @} */

/** @name The type's functions, as every type has them: see McdGeometryDeclare.h
 *  @{ */
/** kMcdGeometryTypeRGHeightField. */
MEPUBLIC MeI16 MEAPI McdRGHeightFieldGetTypeId(void);
/** "RGHeightField"; the argument is ignored. */
MEPUBLIC char *MEAPI McdRGHeightFieldGetTypeName(McdGeometryID g);
/** McdGeometryDestroy for height fields. The program's heights are not freed. */
MEPUBLIC void MEAPI McdRGHeightFieldDestroy(McdGeometryID g);
/** Sets the instance's box at its transform and, unless null, at @a finalTM; @a tight has no effect. */
MEPUBLIC void MEAPI McdRGHeightFieldUpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight);
/** The sphere around its box, in its own frame, m. */
MEPUBLIC void MEAPI McdRGHeightFieldGetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius);
/** The farthest corner of its box. */
MEPUBLIC void MEAPI McdRGHeightFieldMaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir,
                                                 MeReal *const outPoint);
/** Returns 0: a surface has no mass. */
MEPUBLIC MeI16 MEAPI McdRGHeightFieldGetMassProperties(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 m, MeReal *volume);
/** Draws the lines of the grid. */
MEPUBLIC void MEAPI McdRGHeightFieldDebugDraw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3]);
/** @} */

/** @name Interactions
 *  Each Intersect function finds the contacts of a pair whose first model is convex and whose second is a height
 *  field; the RegisterInteraction functions register it with the framework and return 1.
 *  @{ */
/** Contacts of a sphere with the surface. Returns 1 if there are any. */
MEPUBLIC int MEAPI McdSphereRGHeightFieldIntersect(McdModelPair *p, McdIntersectResult *result);
/** Contacts of a box with the surface. Returns 1 if there are any. */
MEPUBLIC int MEAPI McdBoxRGHeightFieldIntersect(McdModelPair *p, McdIntersectResult *result);
/** Contacts of a cylinder with the surface. Returns 1 if there are any. */
MEPUBLIC int MEAPI McdCylinderRGHeightFieldIntersect(McdModelPair *p, McdIntersectResult *result);
/** Contacts of a sphyl with the surface. Returns 1 if there are any. */
MEPUBLIC int MEAPI McdSphylRGHeightFieldIntersect(McdModelPair *p, McdIntersectResult *result);
/** Contacts of a hull with the surface. Returns 1 if there are any. */
MEPUBLIC int MEAPI McdConvexMeshRGHeightFieldIntersect(McdModelPair *p, McdIntersectResult *result);
/** Contacts of a cone with the surface. Returns 1 if there are any. */
MEPUBLIC int MEAPI McdConeRGHeightFieldIntersect(McdModelPair *p, McdIntersectResult *result);
/** Registers spheres with height fields; 0 if @a frame is no framework. */
MEPUBLIC MeBool MEAPI McdSphereRGHeightFieldRegisterInteraction(McdFramework *frame);
/** Registers boxes with height fields; 0 if @a frame is no framework. */
MEPUBLIC MeBool MEAPI McdBoxRGHeightFieldRegisterInteraction(McdFramework *frame);
/** Registers cylinders with height fields; 0 if @a frame is no framework. */
MEPUBLIC MeBool MEAPI McdCylinderRGHeightFieldRegisterInteraction(McdFramework *frame);
/** Registers sphyls with height fields; 0 if @a frame is no framework. */
MEPUBLIC MeBool MEAPI McdSphylRGHeightFieldRegisterInteraction(McdFramework *frame);
/** Registers hulls with height fields; 0 if @a frame is no framework. */
MEPUBLIC MeBool MEAPI McdConvexMeshRGHeightFieldRegisterInteraction(McdFramework *frame);
/** Registers cones with height fields; 0 if @a frame is no framework. */
MEPUBLIC MeBool MEAPI McdConeRGHeightFieldRegisterInteraction(McdFramework *frame);
/** Registers the intersection of line segments with height fields, from above. */
MEPUBLIC void MEAPI McdRGHeightFieldLineSegmentRegisterInteraction(McdFramework *frame);
/** @} */

ME_END_C

#endif
