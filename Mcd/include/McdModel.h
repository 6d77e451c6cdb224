/** @file McdModel.h
 *  Models: geometries at places, which collide (User Guide ch. 4, "Explanation of Model, Geometry, and Body").
 *
 *  Pointers given to a model (transforms, velocities) are kept, not copied. A model in a space is updated by the space;
 *  one that is in none by McdModelUpdate. The framework owns models; McdModelDestroy gives one back.
 */
#ifndef MCDMODEL_H
#define MCDMODEL_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** @name Life
 *  @{ */
/**
 * Creates a model of a geometry: no transform, no velocities, material 0, not in a space. Null, with a warning, for
 * what is no geometry and when McdInit's modelCount, or for aggregates its instanceCount, is reached.
 */
MEPUBLIC McdModelID MEAPI McdModelCreate(McdGeometryID g);
/** Destroys a model, taking it out of its space if it is in one: its pairs end at once, without a goodbye. Null, and a
 *  model that has gone with its framework, does nothing (see McdCTypes.h). */
MEPUBLIC void MEAPI McdModelDestroy(McdModelID cm);
/** As new, but for its geometry and its space. */
MEPUBLIC void MEAPI McdModelReset(McdModelID cm);
/** Is it a live model? */
MEPUBLIC MeBool MEAPI McdModelIsValid(McdModelID cm);
/** Its index in the order of creation in its framework, from 1 on, never used again. 0 for what is no model. */
MEPUBLIC MeU64 MEAPI McdModelGetSerial(McdModelID cm);
/** @} */

/** @name Shape
 *  @{ */
MEPUBLIC McdGeometryID MEAPI McdModelGetGeometry(McdModelID cm);
/** Another geometry of the same framework; to or from an aggregate only while the model is in no space, else a warning.
 *  The mass of its body stays. */
MEPUBLIC void MEAPI McdModelSetGeometry(McdModelID cm, McdGeometryID g);
MEPUBLIC McdGeometryType MEAPI McdModelGetGeometryType(McdModelID cm);
MEPUBLIC McdGeometryInstanceID MEAPI McdModelGetGeometryInstance(McdModelID cm);
/** The box along the world's axes, as of the last update. */
MEPUBLIC void MEAPI McdModelGetAABB(McdModelID cm, MeVector3 minCorner, MeVector3 maxCorner);
/** A sphere around the model, its centre in the world. */
MEPUBLIC void MEAPI McdModelGetBSphere(McdModelID cm, MeVector3 center, MeReal *radius);
/** @} */

/** @name Place and motion
 *  @{ */
/** Where the model is; null where nothing was set. With relative transforms: the product. */
MEPUBLIC MeMatrix4Ptr MEAPI McdModelGetTransformPtr(McdModelID cm);
/** Sets the transform, by pointer. */
MEPUBLIC void MEAPI McdModelSetTransformPtr(const McdModelID cm, const MeMatrix4Ptr geometryTM);
/**
 * Puts the model relative to something: compoundTM = relTM then refTM, computed at every update. All three pointers are
 * kept; if @a own is true they came from MeMemoryAPI.create (relTM and compoundTM) and are destroyed with the model.
 */
MEPUBLIC void MEAPI McdModelSetRelativeTransformPtrs(McdModelID cm, MeMatrix4 relTM, MeMatrix4 refTM,
                                                     MeMatrix4 compoundTM, MeBool own);
/** Two of those pointers; null where none is set. */
MEPUBLIC void MEAPI McdModelGetRelativeTransformPtrs(McdModelID cm, MeMatrix4Ptr *relTM, MeMatrix4Ptr *refTM);
/** Copies relTM; the present transform becomes the reference, and the model keeps the product. Null: no longer. */
MEPUBLIC void MEAPI McdModelSetRelativeTransform(McdModelID cm, MeMatrix4 relTM);
/** The relative transform, or null. */
MEPUBLIC MeMatrix4Ptr MEAPI McdModelGetRelativeTransform(McdModelID cm);
/** Computes the product now. */
MEPUBLIC void MEAPI McdModelCompoundTransforms(McdModelID cm);
/** Velocities, world frame, by pointer: m/s of the transform's origin, and rad/s. McdSafeTime and paths use them. */
MEPUBLIC void MEAPI McdModelSetLinearVelocityPtr(McdModelID cm, MeReal *velocity);
MEPUBLIC void MEAPI McdModelSetAngularVelocityPtr(McdModelID cm, MeReal *velocity);
MEPUBLIC MeReal *MEAPI McdModelGetLinearVelocityPtr(McdModelID cm);
MEPUBLIC MeReal *MEAPI McdModelGetAngularVelocityPtr(McdModelID cm);
/** @} */

/** @name Updating
 *  @{ */
/** Takes note that the transform has changed: calls the update callback, renews children and boxes. */
MEPUBLIC void MEAPI McdModelUpdate(McdModelID cm);
/** The same, with boxes around the motion of the next motionDuration (s) at the present velocities. */
MEPUBLIC void MEAPI McdModelUpdatePath(McdModelID cm, MeReal motionDuration);
/** McdModelUpdate, in the form of McdSpaceSetAABBFn. */
MEPUBLIC void MEAPI McdModelUpdatePathCompatible(McdModelID cm, MeReal dummy);
/** Called as the model is updated, before its boxes are made (docs/simulation.md, "Callbacks"); null: nothing. */
MEPUBLIC void MEAPI McdModelSetUpdateCallback(McdModelID cm, McdModelUpdateFnPtr f);
MEPUBLIC McdModelUpdateFnPtr MEAPI McdModelGetUpdateCallback(McdModelID cm);
/** @} */

/** @name Collision
 *  @{ */
/** The space the model is in, or null. */
MEPUBLIC McdSpaceID MEAPI McdModelGetSpace(McdModelID cm);
/** 0 or more; the default is 0. The Simulation Toolkit's contact parameters go by it. */
MEPUBLIC void MEAPI McdModelSetMaterial(McdModelID cm, int material);
MEPUBLIC unsigned int MEAPI McdModelGetMaterial(McdModelID cm);
/**
 * Contacts are made where the gap between two models is at most the sum of their tolerances: >= 0, m. So resting
 * contacts do not come and go.
 */
MEPUBLIC void MEAPI McdModelSetContactTolerance(McdModelID cm, MeReal tolerance);
MEPUBLIC MeReal MEAPI McdModelGetContactTolerance(McdModelID cm);
/**
 * Fast models: whether the space looks ahead along the motion of this model, so that it meets what it would jump over
 * (see McdSpacePathUpdateAll and McdSafeTime). In a universe, MstUniverseStep moves it continuously then: up to what it
 * meets, and on from there. Default: no.
 */
MEPUBLIC void MEAPI McdModelSetSwept(McdModelID cm, MeBool swept);
MEPUBLIC MeBool MEAPI McdModelIsSwept(McdModelID cm);
/**
 * Of a model that is swept and, as of its space's last update, so fast that in the time that the space looks ahead some
 * point of it may get farther than half of its thickness: how near it must be to have contacts, m. Whom it meets on
 * its way, and when, McdSafeTime says. 0: it is not fast. Beyond Karma.
 */
MEPUBLIC MeReal MEAPI McdModelGetFastMargin(McdModelID cm);
/**
 * A sensor tells what overlaps it and pushes nothing: the Simulation Toolkit makes events of its pairs (MstEvents.h)
 * and no contacts. Default: no. Legal anywhere. Beyond Karma.
 */
MEPUBLIC void MEAPI McdModelSetSensor(McdModelID cm, MeBool sensor);
MEPUBLIC MeBool MEAPI McdModelIsSensor(McdModelID cm);
/**
 * Which models it meets: two make a pair only if each one's category has a bit that is in the other one's mask.
 * Default: category 1, mask 0xffffffff. Two models of the same group, if that is not 0, go by the group alone: a
 * positive one always makes pairs, a negative one never. Default 0. Legal anywhere; in a space from the end of the next
 * change block on, where pairs say hello or goodbye; pairs of two frozen models say nothing before one is unfrozen, but
 * for goodbyes. Beyond Karma.
 */
MEPUBLIC void MEAPI McdModelSetFilter(McdModelID cm, MeU32 category, MeU32 mask);
MEPUBLIC void MEAPI McdModelSetFilterGroup(McdModelID cm, int group);
MEPUBLIC MeU32 MEAPI McdModelGetFilterCategory(McdModelID cm);
MEPUBLIC MeU32 MEAPI McdModelGetFilterMask(McdModelID cm);
MEPUBLIC int MEAPI McdModelGetFilterGroup(McdModelID cm);
/** 0 .. 32767: pairs come in the order of sort keys, then of creation. Default 0. Not while in a space. */
MEPUBLIC void MEAPI McdModelSetSortKey(McdModelID cm, MeI16 key);
MEPUBLIC MeI16 MEAPI McdModelGetSortKey(McdModelID cm);
/** A number for McduRequestTable: 0 .. its idMaxCount - 1. Default: McdModelGetDefaultRequestID(). */
MEPUBLIC void MEAPI McdModelSetRequestID(McdModelID cm, int requestId);
MEPUBLIC int MEAPI McdModelGetRequestID(McdModelID cm);
#define McdModelGetDefaultRequestID() 0
/** Called after McdIntersect with each pair of this model (docs/simulation.md, "Callbacks"). */
MEPUBLIC void MEAPI McdModelSetIntersectCallback(McdModelID cm, McdModelIntersectFnPtr fn);
MEPUBLIC McdModelIntersectFnPtr MEAPI McdModelGetIntersectCallback(McdModelID cm);
/** @} */

/** @name The program's
 *  @{ */
MEPUBLIC void MEAPI McdModelSetUserData(McdModelID cm, void *data);
MEPUBLIC void *MEAPI McdModelGetUserData(McdModelID cm);
/** The body; the Simulation Toolkit's McdModelSetBody and McdModelGetBody know its type. */
MEPUBLIC void MEAPI McdModelSetBodyData(McdModelID cm, void *body);
MEPUBLIC void *MEAPI McdModelGetBodyData(McdModelID cm);
/** @} */

ME_END_C

#endif
