/** @file McdModel.h
 *  Models: geometries at places, which collide.
 *
 *  Pointers given to a model (transforms, velocities) are kept, not copied. A model in a space is updated by the
 *  space, other models by McdModelUpdate. The framework owns models; McdModelDestroy destroys one.
 */
#ifndef MCDMODEL_H
#define MCDMODEL_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** @name Creation and destruction
 *  @{ */
/**
 * Creates a model of a geometry: no transform, no velocities, material 0, not in a space. Null, with a warning, if @a g
 * is not a geometry, and when McdInit's modelCount, or for aggregates its instanceCount, is reached.
 */
MEPUBLIC McdModelID MEAPI McdModelCreate(McdGeometryID g);
/** Destroys a model and removes it from its space: its pairs end immediately, without a goodbye. Null, and a model
 *  that was destroyed with its framework, are ignored (see McdCTypes.h). */
MEPUBLIC void MEAPI McdModelDestroy(McdModelID cm);
/** Resets a model to the state after its creation, except its geometry and its space. */
MEPUBLIC void MEAPI McdModelReset(McdModelID cm);
/** Whether it is a live model. */
MEPUBLIC MeBool MEAPI McdModelIsValid(McdModelID cm);
/** The model's number in the order of creation in its framework, from 1 on, never reused. 0 if it is not a model. */
MEPUBLIC MeU64 MEAPI McdModelGetSerial(McdModelID cm);
/** @} */

/** @name Shape
 *  @{ */
/** The geometry of its creation, or of McdModelSetGeometry. */
MEPUBLIC McdGeometryID MEAPI McdModelGetGeometry(McdModelID cm);
/** Sets another geometry of the same framework. To or from an aggregate only while the model is not in a space, else
 *  a warning. The mass of its body does not change. */
MEPUBLIC void MEAPI McdModelSetGeometry(McdModelID cm, McdGeometryID g);
/** The number of its geometry's type, as McdGeometryGetType. */
MEPUBLIC McdGeometryType MEAPI McdModelGetGeometryType(McdModelID cm);
/** What the model has of its geometry (McdGeometryInstance.h): transform, box, material and, of an aggregate, child
 *  instances. The model owns it. */
MEPUBLIC McdGeometryInstanceID MEAPI McdModelGetGeometryInstance(McdModelID cm);
/** The box along the world's axes, as of the last update. */
MEPUBLIC void MEAPI McdModelGetAABB(McdModelID cm, MeVector3 minCorner, MeVector3 maxCorner);
/** A bounding sphere of the model, its centre in the world. */
MEPUBLIC void MEAPI McdModelGetBSphere(McdModelID cm, MeVector3 center, MeReal *radius);
/** @} */

/** @name Transform and velocity
 *  @{ */
/** The model's transform (the product, if it is relative); null if none was set. */
MEPUBLIC MeMatrix4Ptr MEAPI McdModelGetTransformPtr(McdModelID cm);
/** Sets the transform, by pointer; null: none. */
MEPUBLIC void MEAPI McdModelSetTransformPtr(const McdModelID cm, const MeMatrix4Ptr geometryTM);
/**
 * Places the model relative to a reference: compoundTM = relTM then refTM, computed at every update. All three pointers
 * are kept. If @a own is true, relTM and compoundTM were allocated by MeMemoryAPI.create and are freed with the model.
 */
MEPUBLIC void MEAPI McdModelSetRelativeTransformPtrs(McdModelID cm, MeMatrix4 relTM, MeMatrix4 refTM,
                                                     MeMatrix4 compoundTM, MeBool own);
/** The pointers relTM and refTM; null if none are set. */
MEPUBLIC void MEAPI McdModelGetRelativeTransformPtrs(McdModelID cm, MeMatrix4Ptr *relTM, MeMatrix4Ptr *refTM);
/** Makes the model relative to its current transform, which becomes the reference: copies relTM, and allocates the
 *  product. Null: ends that, the reference becomes the transform. */
MEPUBLIC void MEAPI McdModelSetRelativeTransform(McdModelID cm, MeMatrix4 relTM);
/** The relative transform, or null. */
MEPUBLIC MeMatrix4Ptr MEAPI McdModelGetRelativeTransform(McdModelID cm);
/** Computes the product immediately. */
MEPUBLIC void MEAPI McdModelCompoundTransforms(McdModelID cm);
/** Velocities in the world frame, by pointer: m/s of the transform's origin, and rad/s; null: none. Used by
 *  McdSafeTime and by path updates. */
MEPUBLIC void MEAPI McdModelSetLinearVelocityPtr(McdModelID cm, MeReal *velocity);
/** The same for the rotation, rad/s. A model with a body has the body's. */
MEPUBLIC void MEAPI McdModelSetAngularVelocityPtr(McdModelID cm, MeReal *velocity);
/** The pointer set last; null by default. */
MEPUBLIC MeReal *MEAPI McdModelGetLinearVelocityPtr(McdModelID cm);
/** The pointer set last; null by default. */
MEPUBLIC MeReal *MEAPI McdModelGetAngularVelocityPtr(McdModelID cm);
/** @} */

/** @name Updating
 *  @{ */
/** Updates the model to its transform: calls the update callback, places children, updates boxes. */
MEPUBLIC void MEAPI McdModelUpdate(McdModelID cm);
/** McdModelUpdate, with boxes around the motion of the next motionDuration (s) at the current velocities. */
MEPUBLIC void MEAPI McdModelUpdatePath(McdModelID cm, MeReal motionDuration);
/** McdModelUpdate in the form that McdSpaceSetAABBFn requires. */
MEPUBLIC void MEAPI McdModelUpdatePathCompatible(McdModelID cm, MeReal dummy);
/** Called when the model is updated, before its boxes are computed (docs/simulation.md, "Callbacks"); null: none. */
MEPUBLIC void MEAPI McdModelSetUpdateCallback(McdModelID cm, McdModelUpdateFnPtr f);
/** Null by default. */
MEPUBLIC McdModelUpdateFnPtr MEAPI McdModelGetUpdateCallback(McdModelID cm);
/** @} */

/** @name Collision
 *  @{ */
/** The space that the model is in, or null. */
MEPUBLIC McdSpaceID MEAPI McdModelGetSpace(McdModelID cm);
/** The material: 0 or more; default 0. It selects the Simulation Toolkit's contact parameters. */
MEPUBLIC void MEAPI McdModelSetMaterial(McdModelID cm, int material);
/** 0 by default. */
MEPUBLIC unsigned int MEAPI McdModelGetMaterial(McdModelID cm);
/**
 * The contact tolerance, >= 0, m. There are contacts where the gap between two models is at most the sum of their
 * tolerances, so that resting contacts persist.
 */
MEPUBLIC void MEAPI McdModelSetContactTolerance(McdModelID cm, MeReal tolerance);
/** m. Default .01 of the length scale (McdFrameworkGetDefaultContactTolerance). */
MEPUBLIC MeReal MEAPI McdModelGetContactTolerance(McdModelID cm);
/**
 * Continuous collision detection: whether the space enlarges the model's box along its motion, so that it finds pairs
 * that the model would otherwise jump over (see McdSpacePathUpdateAll and McdSafeTime). In a universe, MstUniverseStep
 * then moves it from impact to impact. It suffices that one of two models is swept. Default: no.
 */
MEPUBLIC void MEAPI McdModelSetSwept(McdModelID cm, MeBool swept);
/** MEFALSE by default. */
MEPUBLIC MeBool MEAPI McdModelIsSwept(McdModelID cm);
/**
 * The gap (m) up to which a fast model gets contacts; 0 if it is not fast. A swept model is fast if, at the space's
 * last update, some point of it could move farther than half of the model's thickness in the look-ahead time. Impacts
 * beyond that gap, and their times, are found by McdSafeTime. Beyond Karma.
 */
MEPUBLIC MeReal MEAPI McdModelGetFastMargin(McdModelID cm);
/**
 * A sensor reports overlaps and pushes nothing: the Simulation Toolkit makes events of its pairs (MstEvents.h) and no
 * contacts. Default: no. Legal anywhere. Beyond Karma.
 */
MEPUBLIC void MEAPI McdModelSetSensor(McdModelID cm, MeBool sensor);
/** MEFALSE by default. */
MEPUBLIC MeBool MEAPI McdModelIsSensor(McdModelID cm);
/**
 * Collision filter: two models form a pair only if the category of each has a bit that is set in the mask of the other.
 * Default: category 1, mask 0xffffffff. For two models of the same group, if that is not 0, only the group counts: a
 * positive one always makes pairs, a negative one never. Default 0. Legal anywhere. In a space a change takes effect at
 * the end of the next change block: pairs say hello or goodbye; for two frozen models, hello is delayed until one of
 * them is unfrozen. Beyond Karma.
 */
MEPUBLIC void MEAPI McdModelSetFilter(McdModelID cm, MeU32 category, MeU32 mask);
/** The group of McdModelSetFilter; 0: none. */
MEPUBLIC void MEAPI McdModelSetFilterGroup(McdModelID cm, int group);
/** 1 by default. */
MEPUBLIC MeU32 MEAPI McdModelGetFilterCategory(McdModelID cm);
/** 0xffffffff by default. */
MEPUBLIC MeU32 MEAPI McdModelGetFilterMask(McdModelID cm);
/** 0 by default. */
MEPUBLIC int MEAPI McdModelGetFilterGroup(McdModelID cm);
/** Sort key, 0 .. 32767: pairs are in the order of sort keys, then of creation. Default 0. Not while in a space. */
MEPUBLIC void MEAPI McdModelSetSortKey(McdModelID cm, MeI16 key);
/** 0 by default. */
MEPUBLIC MeI16 MEAPI McdModelGetSortKey(McdModelID cm);
/** Index for McduRequestTable: 0 .. its idMaxCount - 1. Default: McdModelGetDefaultRequestID(). */
MEPUBLIC void MEAPI McdModelSetRequestID(McdModelID cm, int requestId);
/** McdModelGetDefaultRequestID() by default. */
MEPUBLIC int MEAPI McdModelGetRequestID(McdModelID cm);
#define McdModelGetDefaultRequestID() 0
/** Called after McdIntersect for each pair of this model (docs/simulation.md, "Callbacks"); null: none. */
MEPUBLIC void MEAPI McdModelSetIntersectCallback(McdModelID cm, McdModelIntersectFnPtr fn);
/** Null by default. */
MEPUBLIC McdModelIntersectFnPtr MEAPI McdModelGetIntersectCallback(McdModelID cm);
/** @} */

/** @name The program's data
 *  @{ */
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI McdModelSetUserData(McdModelID cm, void *data);
/** The pointer of McdModelSetUserData; null by default. */
MEPUBLIC void *MEAPI McdModelGetUserData(McdModelID cm);
/** The body; the Simulation Toolkit's McdModelSetBody and McdModelGetBody know its type. */
MEPUBLIC void MEAPI McdModelSetBodyData(McdModelID cm, void *body);
/** The pointer of McdModelSetBodyData; null by default. */
MEPUBLIC void *MEAPI McdModelGetBodyData(McdModelID cm);
/** @} */

ME_END_C

#endif
