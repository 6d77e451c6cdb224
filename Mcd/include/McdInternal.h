/** @file McdInternal.h
 *  For Mst, which creates frameworks and spaces for its universes and does not know geometry types. Not installed.
 */
#ifndef MCDINTERNAL_H
#define MCDINTERNAL_H

#include "McdQuery.h"
#include "McdSpace.h"
#include "MeInternal.h"
#include "MeTeam.h"

ME_BEGIN_C

/** @name Names of limits
 *  Sets the names of the settings to raise that warnings give when a limit is reached, instead of the arguments of
 *  McdInit and McdSpaceAxisSortCreate. The strings must remain valid. After renaming, each limit warns once.
 *  @{ */
MEPUBLIC void MEAPI McdFrameworkRenameLimits(McdFrameworkID frame, const char *types, const char *models,
                                             const char *instances);
MEPUBLIC void MEAPI McdSpaceRenameLimits(McdSpaceID s, const char *models, const char *pairs);
/** @} */

/** The number of hello, staying and goodbye pairs; outside of change blocks. */
MEPUBLIC int MEAPI McdSpaceGetPairCount(McdSpaceID s);

/** @name Frozen models that change
 *  @{ */
/** Visits a frozen model that differs from when its box was made; @a hasMoved: its matrix differs. */
typedef void(MEAPI *McdFrozenVisit)(McdModelID m, MeBool hasMoved, void *context);
/** Visits frozen models that have changed. Each call compares some of the frozen models, in turn; after a call that
 *  changed a shape or a model of the framework, all of them. The visit may freeze and unfreeze models. */
MEPUBLIC void MEAPI McdSpaceVisitChangedFrozen(McdSpaceID s, McdFrozenVisit visit, void *context);
/** Visits the models without a body that are not frozen and whose transform has changed in the open change block;
 *  @a before: their transform before that. */
typedef void(MEAPI *McdMovedVisit)(McdModelID m, MeMatrix4 before, void *context);
MEPUBLIC void MEAPI McdSpaceVisitMoved(McdSpaceID s, McdMovedVisit visit, void *context);
/** Places the model by a mover's transform, which is in the place of the program's until this is called with null.
 *  McdModelGetTransformPtr still returns the program's. */
MEPUBLIC void MEAPI McdModelPlaceBy(McdModelID cm, MeMatrix4Ptr mover);
/** Places the model by a copy of a transform, which goes with the model. False, after a fatal error: no memory. */
MEPUBLIC MeBool MEAPI McdModelPlaceAtCopy(McdModelID cm, const MeMatrix4 tm);
/** The transform that places the model; and the program's, up to date, of a model that a mover places. */
MEPUBLIC MeMatrix4Ptr MEAPI McdModelGetPlace(McdModelID cm);
MEPUBLIC MeMatrix4Ptr MEAPI McdModelGetGiven(McdModelID cm);
/** A number of a valid model that Mst keeps there; of a new model all bits are set (MstSensorSetMask). */
MEPUBLIC void MEAPI McdModelSetSensorMask(McdModelID cm, MeU32 mask);
MEPUBLIC MeU32 MEAPI McdModelGetSensorMask(McdModelID cm);
/** The framework's models in the order of creation: the one after @a cm, or the first one if that is null. */
MEPUBLIC McdModelID MEAPI McdFrameworkNextModel(McdFrameworkID frame, McdModelID cm);
/** Whether the model's transform is the one that it was last compared with (McdModelPairCompare). */
MEPUBLIC MeBool MEAPI McdModelIsCurrent(McdModelID cm);
/** The version of what the model was last compared with: it changes with the last bit of its pose and shape. */
MEPUBLIC MeU64 MEAPI McdModelGetStamp(McdModelID cm);
/** Adds a vector to what is derived from a model's transform, which has got it already: it counts as unmoved, if it was
 *  current before. Its space is in a change block. */
MEPUBLIC void MEAPI McdModelShift(McdModelID cm, const double by[3], MeBool wasCurrent);
/** Marks the model as changed: if it is frozen then, the next McdSpaceVisitChangedFrozen visits it. */
MEPUBLIC void MEAPI McdModelMarkChanged(McdModelID cm);
/** @} */

/** @name Stages (MeInternal.h, mcd_stage.c)
 *  @{ */
/** Levels of a stage: objects that must not change while the program is called. Each level includes those before it. */
enum {
    MCD_GUARD_FRAME,  /**< the framework and its spaces */
    MCD_GUARD_MODELS, /**< models and their pairs, geometries, change blocks */
    MCD_GUARD_SHAPES  /**< transform pointers, geometries of models, boxes in the tree */
};
MEPUBLIC MeStage *MEAPI McdFrameworkGetStage(McdFrameworkID frame);
/** The stage of the model's framework if it guards models; else null. */
MEPUBLIC MeStage *MEAPI McdModelGetGuardStage(McdModelID cm);
/** Whether the model's transform pointer may be set; if not, a message: the model is being tested. */
MEPUBLIC MeBool MEAPI McdModelMayBePlaced(McdModelID cm, const char *function);
/** Sets whether the model's body will be destroyed at the end of the stage: then the model makes no more contacts. */
MEPUBLIC void MEAPI McdModelSetGone(McdModelID cm, MeBool isGone);
/** Whether one of the pair's models, or its body, will be destroyed or removed at the end of the stage. */
MEPUBLIC MeBool MEAPI McdModelPairIsLeaving(const McdModelPair *p);
/** One of the models is moved by forces: warns, once for two types, if both are surfaces, which never touch. */
MEPUBLIC void MEAPI McdModelPairWarnOfSurfaces(const McdModelPair *p);
/** Whether it is a live framework; a live space. */
MEPUBLIC MeBool MEAPI McdFrameworkIsValid(McdFrameworkID frame);
MEPUBLIC MeBool MEAPI McdSpaceIsValid(McdSpaceID s);
/** The framework of a live space. */
MEPUBLIC McdFrameworkID MEAPI McdSpaceGetFramework(McdSpaceID s);
/** The object that collides the space's pairs and keeps records of them; initially null. */
MEPUBLIC void *MEAPI McdSpaceGetCollider(McdSpaceID s);
MEPUBLIC void MEAPI McdSpaceSetCollider(McdSpaceID s, void *collider);
/** Forgets the contacts of all pairs of the model (McdModelPair.forget): for a model that has got another body than
 *  its pairs were tested with. */
MEPUBLIC void MEAPI McdModelForgetPairs(McdModelID cm);
/** For a model whose transform was removed: drops its box, and unfreezes it; it has no pairs until it is placed
 *  again. */
MEPUBLIC void MEAPI McdModelDropBox(McdModelID cm);
/** McdSpaceBeginChanges by the owner of the models, unless the space is changing already: without checks and
 *  deferral. */
MEPUBLIC void MEAPI McdSpaceBeginOwnChanges(McdSpaceID s);
/** @} */

/** Whether queries are legal in a change block, too: they find models by their boxes as of the last update. */
MEPUBLIC void MEAPI McdSpaceAllowQueries(McdSpaceID s, MeBool on);

/** @name Workers
 *  @{ */
/** Sets the worker threads that update the boxes of models; null: the calling thread only. */
MEPUBLIC void MEAPI McdSpaceSetTeam(McdSpaceID s, MeTeam *team);
/** Compares all models that are not frozen with their last inputs (McdModelPairCompareModels), by the space's
 *  workers. */
MEPUBLIC void MEAPI McdSpaceCompareModels(McdSpaceID s);
/** @} */

/** Sets how a body falls from rest before the next test, m: where hulls will land then are contacts. Initially 0. */
MEPUBLIC void MEAPI McdFrameworkSetFall(McdFrameworkID frame, const double fall[3]);

/** @name Change detection: tests that need not be repeated
 *  @{ */
/** Begins a round: models do not change until the next one, and each is compared with its last inputs at most once. */
MEPUBLIC void MEAPI McdFrameworkBeginRound(McdFrameworkID frame);
/** Whether the result of a pair's last test is still valid. */
typedef enum McdPairChange {
    McdPairHasChanged,  /**< unknown: test it; the test's inputs have been stored */
    McdPairHasMoved,    /**< small relative motion since the last test: its contacts may be moved along */
    McdPairIsSeparated, /**< less relative motion than the gap at the last test: it would find no contacts */
    McdPairIsUnchanged, /**< all inputs equal those of the last McdModelPairCompare, to the last bit */
} McdPairChange;
/** Compares both models with their last inputs, unless that was done in this round. After that McdModelPairCompare
 *  writes only to the pair, so several threads may call it for different pairs. */
MEPUBLIC void MEAPI McdModelPairCompareModels(const McdModelPair *p);
/** Whether both models have been compared in this round. */
MEPUBLIC MeBool MEAPI McdModelPairHasComparedModels(const McdModelPair *p);
/** Compares a pair with its last test. Results other than McdPairHasChanged require: convex models, planes, height
 *  fields, or aggregates of these whose parts have no materials of their own; the library's interactions; no
 *  callbacks; unchanged sizes, places of parts and margins; with height fields, that each model that @a mayMove is
 *  frozen; and that only models that @a mayMove have moved since the last call.
 *  McdPairIsSeparated: since the last test (McdModelPairStoreTest) no point has moved relative to the other model by
 *  as much as their gap then (McdModelPairStoreGap). McdPairHasMoved: otherwise, if no point of the smaller
 *  model has moved by more than @a part of its size, or a quarter of the pair's margin; if such a pair is tested all
 *  the same, call McdModelPairStoreTest before. */
MEPUBLIC McdPairChange MEAPI McdModelPairCompare(McdModelPair *p, MeReal part, const MeBool mayMove[2]);
/** Properties of a pair's models that decide how the pair is handled; flags. */
typedef enum McdPairTrait {
    McdPairIsAsleep = 1,  /**< both are frozen in their space (McdSpaceModelIsFrozen) */
    McdPairHasSensor = 2, /**< at least one is a sensor */
    McdPairIsFast = 4,    /**< one is fast (McdModelGetFastMargin), or one is swept and the other one quick */
    McdPairIsGone = 8,    /**< one will be destroyed, or removed from its space, at the end of the stage */
} McdPairTrait;
/** The traits of a pair, and the materials of its models. If a model has been destroyed: 0 and material 0, with a
 *  warning. */
MEPUBLIC MeU32 MEAPI McdModelPairGetTraits(const McdModelPair *p, MeU32 material[2]);
/** m: the gap up to which a pair gets contacts that has the trait McdPairIsFast. */
MEPUBLIC MeReal MEAPI McdModelPairGetFastMargin(const McdModelPair *p);
/** Whether the pair's test, including all parts of its models, calls no function of the program, and all its
 *  contacts have the models' materials. Never if the pair is fast, unless both are convex models or planes: parts and
 *  triangles may involve the program in the search for the time of impact. */
MEPUBLIC MeBool MEAPI McdModelPairIsPlain(const McdModelPair *p);
/** McdIntersect of such a pair, without checks; its models must have been compared in this round. Returns as
 *  McdIntersect. */
MEPUBLIC MeBool MEAPI McdModelPairIntersectPlain(McdModelPair *p, McdIntersectResult *result);
/** Stores the current inputs as those of the test that follows, even if the last test may still be valid. */
MEPUBLIC void MEAPI McdModelPairStoreTest(McdModelPair *p);
/** Stores the gap found by the test, m, a lower bound (McdIntersectResult.apart); 0: unknown, or none. */
MEPUBLIC void MEAPI McdModelPairStoreGap(McdModelPair *p, MeReal apart);
/** Replaces the contacts of a result with a fixed model that lie at internal edges, where a face of the fixed model
 *  continues a face of another fixed model, by contacts along the face's normal, if there are any. Returns whether
 *  the result depends on other models nearby: then the caller must repeat the test even if the pair has not changed
 *  (McdModelPairForgetTest). */
MEPUBLIC MeBool MEAPI McdModelPairReplaceInternal(const McdModelPair *p, const MeBool mayMove[2],
                                                  McdIntersectResult *result);
/** Invalidates the last test: the next McdModelPairCompare returns McdPairHasChanged. */
MEPUBLIC void MEAPI McdModelPairForgetTest(McdModelPair *p);
/** @} */

/** A contact in double precision, world frame, with the curvature of both surfaces there; index 0: model1. */
typedef struct McdExactContact {
    double position[3], separation, radius[2]; /**< m */
    double rim[2], axis[2][3];                 /**< m, unit: axes of rims or, where the rim is 0, edges; 0: none */
    MeBool isVertex[2];
} McdExactContact;
/** The results of McdContactGetPosition, McdContactGetSeparation, McdContactGetRadius, McdContactGetRim,
 *  McdContactIsVertex and, where the other side is round, McdContactGetEdge in one call, without their checks: @a c
 *  must be a contact. */
MEPUBLIC void MEAPI McdContactGetExact(const McdContact *c, McdExactContact *exact);

/** @name Continuous motion
 *  @{ */
/** How a model moves: it turns about @a centre. World frame. */
typedef struct McdMotion {
    MeVector3 centre, velocity, spin; /**< m, m/s, rad/s */
    MeVector3 acceleration;           /**< m/s², of the centre, unless contacts hold it */
    MeReal spinRate;                  /**< rad/s², >= 0: how fast the spin may change, which is not known */
} McdMotion;
/** What becomes of parts that are within the margin at the start. */
typedef enum McdNearParts {
    kMcdNearPass,  /**< Nothing: they are no obstacle. */
    kMcdNearYield, /**< Contacts hold them: they may move until they are deeper than now by the margin. */
    kMcdNearBlock  /**< They must not come nearer: the time is 0 if they do. */
} McdNearParts;
/** s, at most @a maxTime: how long a pair may move before the impact of any of their parts: the time at which parts
 *  touch that are now farther apart than the margin, which is the fast one, or the contact tolerances of a pair that is
 *  not fast. Nearer parts: see McdNearParts. Parts are convex shapes, planes and triangles. What recedes, slides along
 *  or comes nearer so slowly that contacts cope is no impact. Of types with interactions of the program, what
 *  McdSafeTime says, unless they touch. maxTime: there is none. */
MEPUBLIC MeReal MEAPI McdModelPairImpactTime(McdModelPair *p, const McdMotion motion[2], MeReal maxTime,
                                             McdNearParts near);
/** @} */

/** @name Parts near a capsule (McdNear.c), for capsules that the program moves
 *  Coordinates are along the world's axes, relative to an origin.
 *  @{ */
typedef struct McdNear McdNear;
/** A segment with a rounding; radius 0 and equal ends: a point. */
typedef struct McdCapsule {
    double end[2][3], radius; /**< m */
} McdCapsule;
/** The gap between a part and a capsule, as of McdClosestResult. */
typedef struct McdNearGap {
    double distance;    /**< m; negative: the depth */
    double position[3]; /**< on the part */
    double normal[3];   /**< to the capsule */
} McdNearGap;
/** Gathers what is within a box: convex parts, planes, single triangles; in the order of sort keys, then creation of
 *  models. Also inside of change blocks, with the boxes of the last update. Sensors are left out as by queries, and
 *  models that @a filter refuses. Null, after a warning, if there is no space or no memory. */
MEPUBLIC McdNear *MEAPI McdNearBegin(McdSpaceID s, const double origin[3], const double low[3], const double high[3],
                                     McdLineSegIntersectEnableCallback filter, void *filterData);
MEPUBLIC void MEAPI McdNearEnd(McdNear *n);
MEPUBLIC int MEAPI McdNearGetCount(const McdNear *n);
/** The model of part i, and the part. */
MEPUBLIC McdModelID MEAPI McdNearGetModel(const McdNear *n, int i);
MEPUBLIC McdGeometryInstanceID MEAPI McdNearGetInstance(const McdNear *n, int i);
/** Measures the gap of a capsule from part i if it is at most @a reach; false: it is larger, or a triangle that is not
 *  two-sided is seen from behind. */
MEPUBLIC MeBool MEAPI McdNearMeasure(const McdNear *n, int i, const McdCapsule *c, double reach, McdNearGap *gap);
/** @} */

/** @name Rays and shapes side by side, of the wheels of a vehicle
 *  @{ */
typedef struct McdRay {
    MeVector3 from, by; /**< finite */
} McdRay;
/** McdSpaceCastRay of each, but the space is searched once for all and the filter is asked once about a model. Of a ray
 *  that hits nothing the result's model is null. */
MEPUBLIC void MEAPI McdSpaceCastRays(McdSpaceID s, const McdRay rays[], int count,
                                     McdLineSegIntersectEnableCallback filter, void *filterData,
                                     McdCastResult results[]);
typedef struct McdShapeCast {
    McdGeometryID geometry;
    MeMatrix4 tm;
    MeVector3 by; /**< finite */
} McdShapeCast;
/** The same for McdSpaceCastGeometry. */
MEPUBLIC void MEAPI McdSpaceCastGeometries(McdSpaceID s, const McdShapeCast casts[], int count,
                                           McdLineSegIntersectEnableCallback filter, void *filterData,
                                           McdCastResult results[]);
/** @} */

/** @name Kinds of geometries
 *  MEFALSE, with a warning, if it is not a model.
 *  @{ */
/** Whether parts or triangles of it may have materials of their own. */
MEPUBLIC MeBool MEAPI McdModelMayHaveMaterials(McdModelID cm);
/** @} */

ME_END_C

#endif
