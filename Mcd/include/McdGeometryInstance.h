/** @file McdGeometryInstance.h
 *  A geometry at a place: what a model is made of (User Guide ch. 4, "Creating a Model with an Aggregate Geometry").
 *
 *  The instance of an aggregate has one child per element. A child follows its parent: its transform is the element's,
 *  then the parent's; it is computed when the model is updated.
 */
#ifndef MCDGEOMETRYINSTANCE_H
#define MCDGEOMETRYINSTANCE_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** The instance's geometry. */
MEPUBLIC McdGeometryID MEAPI McdGeometryInstanceGetGeometry(McdGeometryInstanceID ins);
/** Gives it another geometry, which must not be an aggregate, nor the one it had. */
MEPUBLIC void MEAPI McdGeometryInstanceSetGeometry(McdGeometryInstanceID ins, McdGeometryID g);
/** The type of its geometry. */
MEPUBLIC McdGeometryType MEAPI McdGeometryInstanceGetGeometryType(McdGeometryInstanceID ins);
/** The child for element @a i of an aggregate; null where there is none. */
MEPUBLIC McdGeometryInstanceID MEAPI McdGeometryInstanceGetChild(McdGeometryInstanceID ins, int i);
/** How many children it has; 0 if its geometry is no aggregate. */
MEPUBLIC int MEAPI McdGeometryInstanceGetChildCount(McdGeometryInstanceID ins);
/** The instance whose child it is; null for a model's own. */
MEPUBLIC McdGeometryInstanceID MEAPI McdGeometryInstanceGetParent(McdGeometryInstanceID ins);
/** The model it is a part of. */
MEPUBLIC McdModelID MEAPI McdGeometryInstanceGetModel(McdGeometryInstanceID ins);

/** Where the instance is: the pointer that was set, or null. */
MEPUBLIC MeMatrix4Ptr MEAPI McdGeometryInstanceGetTransformPtr(const McdGeometryInstanceID ins);
/**
 * Sets that pointer, which is kept. For a model's own instance: where the model is, as McdModelSetTransformPtr. For a
 * child: where its transform is written at every update of the model; null: nowhere.
 */
MEPUBLIC void MEAPI McdGeometryInstanceSetTransformPtr(const McdGeometryInstanceID ins, const MeMatrix4Ptr geometryTM);
/** The child's material; a child without one (the default) has its parent's. */
MEPUBLIC unsigned int MEAPI McdGeometryInstanceGetMaterial(McdGeometryInstanceID ins);
/** Sets it: 0 or more; -1 takes the parent's again. */
MEPUBLIC void MEAPI McdGeometryInstanceSetMaterial(McdGeometryInstanceID ins, int material);
/** Parent's material, no transform pointer. */
MEPUBLIC void MEAPI McdGeometryInstanceReset(McdGeometryInstanceID ins);

/** The box along the world's axes, as of the last update. */
MEPUBLIC void MEAPI McdGeometryInstanceGetAABB(McdGeometryInstanceID ins, MeVector3 minCorner, MeVector3 maxCorner);
/** For the box functions of a program's geometry types: what the box is. */
MEPUBLIC void MEAPI McdGeometryInstanceSetAABB(McdGeometryInstanceID ins, const MeVector3 minCorner,
                                               const MeVector3 maxCorner);
/** Renews the box: around where it is, and where it will be if finalTM is not null. */
MEPUBLIC void MEAPI McdGeometryInstanceUpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight);
/** Do the boxes of both overlap? */
MEPUBLIC MeBool MEAPI McdGeometryInstanceOverlap(McdGeometryInstanceID ins1, McdGeometryInstanceID ins2);
/** A sphere around it, its centre in the world. */
MEPUBLIC void MEAPI McdGeometryInstanceGetBSphere(const McdGeometryInstanceID ins, MeVector3 center, MeReal *radius);
/** Its point that is farthest in the world direction @a inDir. */
MEPUBLIC void MEAPI McdGeometryInstanceMaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir,
                                                    MeReal *const outPoint);

ME_END_C

#endif
