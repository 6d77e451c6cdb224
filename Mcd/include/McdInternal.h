/** @file McdInternal.h
 *  For Mst, which makes frameworks and spaces of its universes' sizes, and knows no geometry types. Not installed.
 */
#ifndef MCDINTERNAL_H
#define MCDINTERNAL_H

#include "McdCTypes.h"
#include "MeInternal.h"
#include "MeTeam.h"

ME_BEGIN_C

/** @name Names of limits
 *  What a message tells the program to raise where there is no room for more, instead of the arguments of McdInit and
 *  McdSpaceAxisSortCreate. Strings that stay. Each limit is spoken of once then.
 *  @{ */
MEPUBLIC void MEAPI McdFrameworkRenameLimits(McdFrameworkID frame, const char *types, const char *models,
                                             const char *instances);
MEPUBLIC void MEAPI McdSpaceRenameLimits(McdSpaceID s, const char *models, const char *pairs);
/** @} */

/** The number of hello, staying and goodbye pairs; outside of change blocks. */
MEPUBLIC int MEAPI McdSpaceGetPairCount(McdSpaceID s);

/** @name Frozen models that change
 *  @{ */
/** A frozen model that is not as it was when its box was made; @a hasMoved: its matrix is another. */
typedef void(MEAPI *McdFrozenVisit)(McdModelID m, MeBool hasMoved, void *context);
/** Visits such models; some are looked at in each call, in turn, and all of them after a call that has changed a shape
 *  or a model of the framework. The visit may freeze and unfreeze models. */
MEPUBLIC void MEAPI McdSpaceVisitChangedFrozen(McdSpaceID s, McdFrozenVisit visit, void *context);
/** Whether its matrix was another when its box was made the last time but one. */
MEPUBLIC MeBool MEAPI McdModelHasMoved(McdModelID cm);
/** It has changed: McdSpaceVisitChangedFrozen visits it in its next call, if it is frozen then. */
MEPUBLIC void MEAPI McdModelStir(McdModelID cm);
/** How far the point of a model, world, was moved with it when its box was made last, m; zero and MEFALSE where it was
 *  not, or farther than its own size, as by a program that puts it elsewhere. */
MEPUBLIC MeBool MEAPI McdModelGetDisplacement(McdModelID cm, const MeVector3 point, MeVector3 displacement);
/** @} */

/** @name Stages (MeInternal.h, mcd_stage.c)
 *  @{ */
enum {
    MCD_MODELS_GUARD = 1 /**< the level at which models and their pairs stay */
};
MEPUBLIC MeStage *MEAPI McdFrameworkGetStage(McdFrameworkID frame);
/** That of the model's framework, if it is held at that level; else null. */
MEPUBLIC MeStage *MEAPI McdModelGetGuardStage(McdModelID cm);
/** May its transform's pointer be set? Else a message: it is being tested. */
MEPUBLIC MeBool MEAPI McdModelMayBePlaced(McdModelID cm, const char *function);
/** Whether its body is to go when the stage ends: it makes no more contacts. */
MEPUBLIC void MEAPI McdModelSetGone(McdModelID cm, MeBool isGone);
/** Is one of the pair's models to go when the stage ends? */
MEPUBLIC MeBool MEAPI McdModelPairIsLeaving(const McdModelPair *p);
/** Live ones? */
MEPUBLIC MeBool MEAPI McdFrameworkIsValid(McdFrameworkID frame);
MEPUBLIC MeBool MEAPI McdSpaceIsValid(McdSpaceID s);
/** The framework that a live space was made in. */
MEPUBLIC McdFrameworkID MEAPI McdSpaceGetFramework(McdSpaceID s);
/** What collides its pairs, and keeps records of them: null at first. */
MEPUBLIC void *MEAPI McdSpaceGetCollider(McdSpaceID s);
MEPUBLIC void MEAPI McdSpaceSetCollider(McdSpaceID s, void *collider);
/** Has it got another body than it was tested with, so that its pairs' contacts are not its own any more? Forgets all
 *  of them (McdModelPair.forget). */
MEPUBLIC void MEAPI McdModelForgetPairs(McdModelID cm);
/** Its transform is gone: it has no box and no pairs until it is placed again; it is not frozen any more. */
MEPUBLIC void MEAPI McdModelDropBox(McdModelID cm);
/** McdSpaceBeginChanges and McdSpaceEndChanges by whoever holds the models. */
MEPUBLIC void MEAPI McdSpaceOpen(McdSpaceID s);
MEPUBLIC void MEAPI McdSpaceClose(McdSpaceID s);
/** @} */

/** @name Workers
 *  @{ */
/** Sets the workers that update the boxes of models; null: the calling thread alone. */
MEPUBLIC void MEAPI McdSpaceSetTeam(McdSpaceID s, MeTeam *team);
/** McdModelPairLookAtModels for all models that are not frozen, by the space's workers. */
MEPUBLIC void MEAPI McdSpaceLookAtModels(McdSpaceID s);
/** @} */

/** @name Change detection: tests that need not be repeated
 *  @{ */
/** Begins a round: until the next one, models do not change, and each is compared with its last inputs once. */
MEPUBLIC void MEAPI McdFrameworkBeginRound(McdFrameworkID frame);
/** Whether the result of a pair's last test is still valid. */
typedef enum McdPairChange {
    McdPairHasChanged,  /**< unknown: test it; that test is noted */
    McdPairHasMoved,    /**< little relative motion since the last test: its contacts may be moved with the models */
    McdPairIsSeparated, /**< less relative motion than the gap at the last test: another would find nothing, either */
    McdPairIsUnchanged, /**< all inputs are equal, to the last bit, to those of the last McdModelPairLook */
} McdPairChange;
/** Compares both models with their last inputs, unless that was done in this round. After it McdModelPairLook writes to
 *  the pair only, so that several threads may call it for different pairs. */
MEPUBLIC void MEAPI McdModelPairLookAtModels(const McdModelPair *p);
/** Whether both models have been compared in this round. */
MEPUBLIC MeBool MEAPI McdModelPairHasSeenModels(const McdModelPair *p);
/** Compares a pair with its last test. Other results than McdPairHasChanged are given only for convex models, planes,
 *  height fields, and aggregates of these whose parts have no materials of their own, with the library's own
 *  interactions, without callbacks, and with unchanged sizes, places of parts and margins; with height fields only
 *  while each model that @a mayMove is frozen; and only models that @a mayMove have moved since the last call.
 *  McdPairIsSeparated: since the last test (McdModelPairNoteTest) no point has moved relative to the other model by as
 *  much as the models were separated then (McdModelPairNoteSeparated). McdPairHasMoved: else no point of the smaller
 *  model by more than @a part of its size, or a quarter of the margin of the pair; who tests such a pair all the same
 *  calls McdModelPairNoteTest before. */
MEPUBLIC McdPairChange MEAPI McdModelPairLook(McdModelPair *p, MeReal part, const MeBool mayMove[2]);
/** What of a pair's models decides how it is handled; flags. */
typedef enum McdPairTrait {
    McdPairIsAsleep = 1,  /**< both are frozen in their space (McdSpaceModelIsFrozen) */
    McdPairHasSensor = 2, /**< one is a sensor at least */
    McdPairIsFast = 4,    /**< one has a fast margin at least (McdModelGetFastMargin) */
    McdPairIsGone = 8,    /**< one is to be destroyed, or to leave its space, when the stage ends */
} McdPairTrait;
/** The traits of a pair, and the materials of its models. Of a model that is gone, with a warning: none, and 0. */
MEPUBLIC MeU32 MEAPI McdModelPairGetTraits(const McdModelPair *p, MeU32 material[2]);
/** Does no function of the program run in the pair's test, of all parts of its models, and do all its contacts have
 *  the models' materials? Never where something else than two convex models or planes is fast, as the search for its
 *  time of touch asks the space. */
MEPUBLIC MeBool MEAPI McdModelPairIsPlain(const McdModelPair *p);
/** McdIntersect of such a pair, without its checks, once its models have been compared in this round. Returns what that
 *  would. */
MEPUBLIC MeBool MEAPI McdModelPairIntersectPlain(McdModelPair *p, McdIntersectResult *result);
/** Stores the inputs of the test that follows, though the last one may hold. */
MEPUBLIC void MEAPI McdModelPairNoteTest(McdModelPair *p);
/** Stores the gap that the test has found, m, a lower bound (McdIntersectResult.apart); 0: unknown, or none. */
MEPUBLIC void MEAPI McdModelPairNoteSeparated(McdModelPair *p, MeReal apart);
/** Whether one of the models is a box that may not move, and the other one is flush with a face of it, over which it
 *  will slide, notwithstanding all the contacts that a test of the pair has found. */
MEPUBLIC MeBool MEAPI McdModelPairPassesSeam(const McdModelPair *p, const MeBool mayMove[2],
                                             const McdContact contacts[], int count);
/** Invalidates the last test: the next McdModelPairLook returns McdPairHasChanged. */
MEPUBLIC void MEAPI McdModelPairForgetTest(McdModelPair *p);
/** @} */

/** A contact in double precision, world frame; of each surface how round it is there, model1's first. */
typedef struct McdExactContact {
    double position[3], separation, radius[2]; /**< m */
    double rim[2], axis[2][3];                 /**< m, unit; an axis is set only where there is a rim */
} McdExactContact;
/** What McdContactGetPosition, McdContactGetSeparation, McdContactGetRadius and McdContactGetRim tell, in one call and
 *  without their checks: @a c is a contact. */
MEPUBLIC void MEAPI McdContactGetExact(const McdContact *c, McdExactContact *exact);

/** @name Kinds of geometries
 *  MEFALSE, with a warning, for what is no model.
 *  @{ */
/** Is it one convex shape, which can be cast (McdSpaceCastGeometry)? */
MEPUBLIC MeBool MEAPI McdModelIsConvex(McdModelID cm);
/** Is it a surface of triangles, which McdSafeTime does not support? */
MEPUBLIC MeBool MEAPI McdModelIsSurface(McdModelID cm);
/** @} */

ME_END_C

#endif
