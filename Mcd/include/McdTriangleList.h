/** @file McdTriangleList.h
 *  Terrain and other fixed surfaces of triangles (User Guide ch. 4, "Triangle List").
 *
 *  The program keeps the triangles: when a model comes near the list's box, a callback hands over those close to it,
 *  and each of them gives contacts as its flags say (see McdTriangleFlags):
 *  - UseSmallestPenetration: the normal is the shortest way out, as far as it is one of the surface; else the face's.
 *  - UseEdge0 .. 2: the edge is sharp: there, and at the corners between two sharp edges, normals other than the face's
 *    are made. At an edge or corner that triangles share (corners at exactly equal coordinates) only those normals are
 *    made that are between the faces' normals on the outside of a convex fold. Flat and concave ones have none,
 *    whatever the flags say: a model slides over them as if they were not there. Where a corner lies on another
 *    triangle's edge, the surface is looked for beside the contact: if it rises there above the plane across the
 *    normal, the face's normal is made. In folds that is less exact; better split such edges there.
 *  - TwoSided: both sides are outside. Else the side to which the triangle's normal points is: contacts push that way.
 *    A model whose middle has got behind, while nothing else touches it, is brought back if the middle is no farther
 *    behind than half of the model's radius; deeper ones, and those that come from behind, pass.
 *
 *  Contacts of triangles in one plane become one manifold of at most four. McdContact.element1 or element2 is the
 *  triangle's triangleData. Features do not depend on it, nor on the order in which triangles are given.
 *  Triangles without area, or with coordinates that are not finite, are skipped; MeDebug counts them.
 *
 *  Where other triangles are shown than before, McdGeometryUpdate says so to bodies that sleep on them.
 */
#ifndef MCDTRIANGLELIST_H
#define MCDTRIANGLELIST_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** Registers the geometry type, on which McdTriangleListCreate depends. */
MEPUBLIC void MEAPI McdTriangleListRegisterType(McdFramework *frame);
/**
 * Creates a triangle list.
 * @param min,max           corners of a box around all triangles, in the list's frame: min <= max.
 * @param triangleMaxCount  how many triangles the callback may hand over at once: 1 or more.
 * @param f                 the callback, see McdTriangleListFnPtr. Null: no triangles.
 * @return null, with a warning, if an argument is out of range or the type is not registered.
 */
MEPUBLIC McdTriangleListID MEAPI McdTriangleListCreate(McdFramework *frame, MeVector3 min, MeVector3 max,
                                                       int triangleMaxCount, McdTriangleListFnPtr f);

/** @name What it is made of
 *  A geometry that is no triangle list gets a warning; getters then return 0 or null.
 *  @{ */
MEPUBLIC void MEAPI McdTriangleListGetBoundingBox(McdTriangleListID g, MeVector3 min, MeVector3 max);
/** Counts from the next update of its models on. Unless min <= max: a warning, and no change. */
MEPUBLIC void MEAPI McdTriangleListSetBoundingBox(McdTriangleListID g, MeVector3 min, MeVector3 max);
MEPUBLIC McdTriangleListFnPtr MEAPI McdTriangleListGetGenerator(McdTriangleListID g);
MEPUBLIC void MEAPI McdTriangleListSetGenerator(McdTriangleListID g, McdTriangleListFnPtr f);
MEPUBLIC int MEAPI McdTriangleListGetMaxTriangles(McdTriangleListID g);
/** 1 or more; else a warning, and no change. Not from within the callback. */
MEPUBLIC void MEAPI McdTriangleListSetMaxTriangles(McdTriangleListID g, int max);
MEPUBLIC void *MEAPI McdTriangleListGetUserData(McdTriangleListID g);
MEPUBLIC void MEAPI McdTriangleListSetUserData(McdTriangleListID g, void *data);
/** @} */

/** @name The type's functions
 *  @{ */
MEPUBLIC MeI16 MEAPI McdTriangleListGetTypeId(void);
MEPUBLIC char *MEAPI McdTriangleListGetTypeName(McdGeometryID g);
MEPUBLIC void MEAPI McdTriangleListDestroy(McdGeometryID g);
MEPUBLIC void MEAPI McdTriangleListUpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight);
MEPUBLIC void MEAPI McdTriangleListGetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius);
/** The box' farthest corner. */
MEPUBLIC void MEAPI McdTriangleListMaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir, MeReal *const outPoint);
/** Returns 0: a surface has none. */
MEPUBLIC MeI16 MEAPI McdTriangleListGetMassProperties(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 m, MeReal *volume);
/** Draws the box. */
MEPUBLIC void MEAPI McdTriangleListDebugDraw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3]);
/** @} */

/** @name Interactions
 *  Each finds contacts of a pair whose first model is convex and whose second is a triangle list; the
 *  RegisterInteraction functions put it in the framework's table and return 1.
 *  @{ */
MEPUBLIC int MEAPI McdSphereTriangleListIntersect(McdModelPair *p, McdIntersectResult *result);
MEPUBLIC int MEAPI McdBoxTriangleListIntersect(McdModelPair *p, McdIntersectResult *result);
MEPUBLIC int MEAPI McdCylinderTriangleListIntersect(McdModelPair *p, McdIntersectResult *result);
MEPUBLIC int MEAPI McdSphylTriangleListIntersect(McdModelPair *p, McdIntersectResult *result);
MEPUBLIC int MEAPI McdConvexMeshTriangleListIntersect(McdModelPair *p, McdIntersectResult *result);
MEPUBLIC int MEAPI McdConeTriangleListIntersect(McdModelPair *p, McdIntersectResult *result);
MEPUBLIC MeBool MEAPI McdSphereTriangleListRegisterInteraction(McdFramework *frame);
MEPUBLIC MeBool MEAPI McdBoxTriangleListRegisterInteraction(McdFramework *frame);
MEPUBLIC MeBool MEAPI McdCylinderTriangleListRegisterInteraction(McdFramework *frame);
MEPUBLIC MeBool MEAPI McdSphylTriangleListRegisterInteraction(McdFramework *frame);
MEPUBLIC MeBool MEAPI McdConvexMeshTriangleListRegisterInteraction(McdFramework *frame);
MEPUBLIC MeBool MEAPI McdConeTriangleListRegisterInteraction(McdFramework *frame);
/**
 * Has line segments meet triangle lists, which the guide says they do not; nothing else registers it. The callback gets
 * a pair in which both models are the list's, the middle of the segment and half of its length. Triangles that are not
 * two-sided are met from their front only. Beyond Karma.
 */
MEPUBLIC void MEAPI McdTriangleListLineSegmentRegisterInteraction(McdFramework *frame);
/** @} */

ME_END_C

#endif
