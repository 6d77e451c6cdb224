/** @file McdGeometryInstance.h
 *  Instances: geometries at places, of which models are made.
 *
 *  The instance of an aggregate has one child per element. A child's transform is the element's, then the parent's;
 *  it is computed when the model is updated.
 */
#ifndef MCDGEOMETRYINSTANCE_H
#define MCDGEOMETRYINSTANCE_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** The instance's geometry. */
MEPUBLIC McdGeometryID MEAPI McdGeometryInstanceGetGeometry(McdGeometryInstanceID ins);
/** Sets another geometry, which must not be an aggregate, nor may the previous one be. */
MEPUBLIC void MEAPI McdGeometryInstanceSetGeometry(McdGeometryInstanceID ins, McdGeometryID g);
/** The type of the instance's geometry. */
MEPUBLIC McdGeometryType MEAPI McdGeometryInstanceGetGeometryType(McdGeometryInstanceID ins);
/** The child for element @a i of an aggregate; null if there is none. */
MEPUBLIC McdGeometryInstanceID MEAPI McdGeometryInstanceGetChild(McdGeometryInstanceID ins, int i);
/** The number of children; 0 if its geometry is not an aggregate. */
MEPUBLIC int MEAPI McdGeometryInstanceGetChildCount(McdGeometryInstanceID ins);
/** The parent of a child instance; null for a model's own instance. */
MEPUBLIC McdGeometryInstanceID MEAPI McdGeometryInstanceGetParent(McdGeometryInstanceID ins);
/** The model that the instance belongs to. */
MEPUBLIC McdModelID MEAPI McdGeometryInstanceGetModel(McdGeometryInstanceID ins);

/** The transform pointer that was set, or null. */
MEPUBLIC MeMatrix4Ptr MEAPI McdGeometryInstanceGetTransformPtr(const McdGeometryInstanceID ins);
/**
 * Sets the transform pointer, which is kept. For a model's own instance: the model's transform, as
 * McdModelSetTransformPtr. For a child: where its transform is written at every update of the model; null: nowhere.
 */
MEPUBLIC void MEAPI McdGeometryInstanceSetTransformPtr(const McdGeometryInstanceID ins, const MeMatrix4Ptr geometryTM);
/** The material of a child; a child without its own (the default) has its parent's. */
MEPUBLIC unsigned int MEAPI McdGeometryInstanceGetMaterial(McdGeometryInstanceID ins);
/** Sets the child's material: 0 or more; -1: the parent's. */
MEPUBLIC void MEAPI McdGeometryInstanceSetMaterial(McdGeometryInstanceID ins, int material);
/** Resets the instance: no transform pointer, and the parent's material (0 for a model's own instance). */
MEPUBLIC void MEAPI McdGeometryInstanceReset(McdGeometryInstanceID ins);

/** The box along the world's axes, as of the last update. */
MEPUBLIC void MEAPI McdGeometryInstanceGetAABB(McdGeometryInstanceID ins, MeVector3 minCorner, MeVector3 maxCorner);
/** Sets the instance's box: for the box functions of a program's geometry types. */
MEPUBLIC void MEAPI McdGeometryInstanceSetAABB(McdGeometryInstanceID ins, const MeVector3 minCorner,
                                               const MeVector3 maxCorner);
/** Updates the box: around the instance and, if finalTM is not null, around its motion to finalTM. */
MEPUBLIC void MEAPI McdGeometryInstanceUpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight);
/** Whether the boxes of both overlap. */
MEPUBLIC MeBool MEAPI McdGeometryInstanceOverlap(McdGeometryInstanceID ins1, McdGeometryInstanceID ins2);
/** A bounding sphere, its centre in the world. */
MEPUBLIC void MEAPI McdGeometryInstanceGetBSphere(const McdGeometryInstanceID ins, MeVector3 center, MeReal *radius);
/** The instance's point that is farthest in the world direction @a inDir. */
MEPUBLIC void MEAPI McdGeometryInstanceMaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir,
                                                    MeReal *const outPoint);

ME_END_C

#endif
