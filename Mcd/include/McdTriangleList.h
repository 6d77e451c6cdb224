/** @file McdTriangleList.h
 *  Triangle lists: terrain and other fixed surfaces of triangles.
 *
 *  The program keeps the triangles: when a model comes near the list's box, a callback returns those close to it,
 *  and each of them gives contacts by its flags (see McdTriangleFlags):
 *  - UseSmallestPenetration: the normal is the direction of the smallest penetration, if it is a normal of the
 *    surface; else the face's.
 *  - UseEdge0 .. 2: the edge is sharp: there, and at corners between two sharp edges, normals other than the face's
 *    are possible. At an edge or corner that triangles share (corners at exactly equal coordinates), only normals
 *    between the faces' normals, on the outside of a convex fold, are possible. Flat and concave edges have none,
 *    whatever the flags: models slide over them without effect. If a corner lies on another triangle's edge (a
 *    T-junction), the surface beside the contact is examined: if it rises there above the plane orthogonal to the
 *    normal, the face's normal is used. In folds that is less exact; better split such edges.
 *  - TwoSided: both sides are outside. Otherwise only the side to which the triangle's normal points: contacts push
 *    that way. A model without other contacts whose centre is behind the surface is pushed back if the centre is no
 *    farther behind than half of the model's radius; deeper models, and models that come from behind, pass.
 *
 *  Contacts of coplanar triangles form one manifold of at most four. McdContact.element1 or element2 is the
 *  triangle's triangleData. Features do not depend on it, nor on the order of the triangles. Triangles without area,
 *  or with coordinates that are not finite, are skipped; MeDebug reports their number.
 *
 *  After a change of the triangles, McdGeometryUpdate wakes bodies that sleep on them.
 */
#ifndef MCDTRIANGLELIST_H
#define MCDTRIANGLELIST_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** Registers the geometry type; required before McdTriangleListCreate. */
MEPUBLIC void MEAPI McdTriangleListRegisterType(McdFramework *frame);
/**
 * Creates a triangle list.
 * @param min,max           corners of a box around all triangles, in the list's frame: min <= max.
 * @param triangleMaxCount  the maximum number of triangles that the callback may return in a call: 1 or more.
 * @param f                 the callback, see McdTriangleListFnPtr. Null: no triangles.
 * @return null, with a warning, if an argument is out of range or the type is not registered.
 */
MEPUBLIC McdTriangleListID MEAPI McdTriangleListCreate(McdFramework *frame, MeVector3 min, MeVector3 max,
                                                       int triangleMaxCount, McdTriangleListFnPtr f);

/** @name Accessors
 *  For a geometry that is not a triangle list: a warning; getters return 0 or null.
 *  @{ */
/** m, in the list's frame. */
MEPUBLIC void MEAPI McdTriangleListGetBoundingBox(McdTriangleListID g, MeVector3 min, MeVector3 max);
/** Takes effect at the next update of its models. Unless min <= max: a warning, and no change. */
MEPUBLIC void MEAPI McdTriangleListSetBoundingBox(McdTriangleListID g, MeVector3 min, MeVector3 max);
/** The callback; null if the list has no triangles. */
MEPUBLIC McdTriangleListFnPtr MEAPI McdTriangleListGetGenerator(McdTriangleListID g);
/** Sets another callback; null: no triangles. Call McdGeometryUpdate after it. */
MEPUBLIC void MEAPI McdTriangleListSetGenerator(McdTriangleListID g, McdTriangleListFnPtr f);
/** The largest number of triangles that the callback may return. */
MEPUBLIC int MEAPI McdTriangleListGetMaxTriangles(McdTriangleListID g);
/** 1 or more; otherwise a warning, and no change. Not from within the callback. */
MEPUBLIC void MEAPI McdTriangleListSetMaxTriangles(McdTriangleListID g, int max);
/** The pointer of McdTriangleListSetUserData; null by default. */
MEPUBLIC void *MEAPI McdTriangleListGetUserData(McdTriangleListID g);
/** A pointer of the program's, for its callback. Default null. */
MEPUBLIC void MEAPI McdTriangleListSetUserData(McdTriangleListID g, void *data);
/** @} */

/** @name The type's functions, as every type has them: see McdGeometryDeclare.h
 *  @{ */
/** kMcdGeometryTypeTriangleList. */
MEPUBLIC MeI16 MEAPI McdTriangleListGetTypeId(void);
/** "TriangleList"; the argument is ignored. */
MEPUBLIC char *MEAPI McdTriangleListGetTypeName(McdGeometryID g);
/** McdGeometryDestroy for triangle lists. The program's triangles are not freed. */
MEPUBLIC void MEAPI McdTriangleListDestroy(McdGeometryID g);
/** Sets the instance's box at its transform and, unless null, at @a finalTM; @a tight has no effect. */
MEPUBLIC void MEAPI McdTriangleListUpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight);
/** The sphere around its box, in its own frame, m. */
MEPUBLIC void MEAPI McdTriangleListGetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius);
/** The farthest corner of its box. */
MEPUBLIC void MEAPI McdTriangleListMaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir, MeReal *const outPoint);
/** Returns 0: a surface has no mass. */
MEPUBLIC MeI16 MEAPI McdTriangleListGetMassProperties(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 m, MeReal *volume);
/** Draws the box. */
MEPUBLIC void MEAPI McdTriangleListDebugDraw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3]);
/** @} */

/** @name Interactions
 *  Each Intersect function finds the contacts of a pair whose first model is convex and whose second is a triangle
 *  list; the RegisterInteraction functions register it with the framework and return 1.
 *  @{ */
/** Contacts of a sphere with the surface. Returns 1 if there are any. */
MEPUBLIC int MEAPI McdSphereTriangleListIntersect(McdModelPair *p, McdIntersectResult *result);
/** Contacts of a box with the surface. Returns 1 if there are any. */
MEPUBLIC int MEAPI McdBoxTriangleListIntersect(McdModelPair *p, McdIntersectResult *result);
/** Contacts of a cylinder with the surface. Returns 1 if there are any. */
MEPUBLIC int MEAPI McdCylinderTriangleListIntersect(McdModelPair *p, McdIntersectResult *result);
/** Contacts of a sphyl with the surface. Returns 1 if there are any. */
MEPUBLIC int MEAPI McdSphylTriangleListIntersect(McdModelPair *p, McdIntersectResult *result);
/** Contacts of a hull with the surface. Returns 1 if there are any. */
MEPUBLIC int MEAPI McdConvexMeshTriangleListIntersect(McdModelPair *p, McdIntersectResult *result);
/** Contacts of a cone with the surface. Returns 1 if there are any. */
MEPUBLIC int MEAPI McdConeTriangleListIntersect(McdModelPair *p, McdIntersectResult *result);
/** Registers spheres with triangle lists; 0 if @a frame is no framework. */
MEPUBLIC MeBool MEAPI McdSphereTriangleListRegisterInteraction(McdFramework *frame);
/** Registers boxes with triangle lists; 0 if @a frame is no framework. */
MEPUBLIC MeBool MEAPI McdBoxTriangleListRegisterInteraction(McdFramework *frame);
/** Registers cylinders with triangle lists; 0 if @a frame is no framework. */
MEPUBLIC MeBool MEAPI McdCylinderTriangleListRegisterInteraction(McdFramework *frame);
/** Registers sphyls with triangle lists; 0 if @a frame is no framework. */
MEPUBLIC MeBool MEAPI McdSphylTriangleListRegisterInteraction(McdFramework *frame);
/** Registers hulls with triangle lists; 0 if @a frame is no framework. */
MEPUBLIC MeBool MEAPI McdConvexMeshTriangleListRegisterInteraction(McdFramework *frame);
/** Registers cones with triangle lists; 0 if @a frame is no framework. */
MEPUBLIC MeBool MEAPI McdConeTriangleListRegisterInteraction(McdFramework *frame);
/**
 * Registers the intersection of line segments with triangle lists, which the guide does not have; nothing else
 * registers it. The callback gets a pair in which both models are the list's, the middle of the segment and half of its
 * length. Triangles that are not two-sided are hit only from their front. Beyond Karma.
 */
MEPUBLIC void MEAPI McdTriangleListLineSegmentRegisterInteraction(McdFramework *frame);
/** @} */

ME_END_C

#endif
