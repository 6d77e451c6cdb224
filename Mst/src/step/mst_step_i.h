/* Inside Mst: the stages from pairs of models to contacts of their bodies.
 *
 *     stage     file              reads -> writes
 *     pairs     MstBridge.c       pairs of the space -> the bridge's pair buffer; hello and goodbye pairs
 *     collide   mst_collide.c     models, poses, motion of bodies; manifold and touch of the pair -> findings of a run;
 *                                 Mcd's record of the pair's last test
 *     update    mst_update.c      findings with persisting contacts -> manifold and touch of the pair
 *     commit    mst_commit.c      all other findings -> manifolds, touches, safe times of bodies; callbacks of the
 *                                 program; the step's list of touches
 *     touches   mst_touch.c       contacts of a pair -> its touch
 *     sub-steps mst_continuous.c  findings of fast models -> safe times; the world's step, in sub-steps
 *     events    MstEvents.c       touches, forces of their contacts -> events; callbacks of the program
 *
 * Collide and commit alternate, run by run (MstHandleCollisions): a run has as many pairs as stay in the L1 cache
 * between the two. Collide and update call no function of the program, allocate nothing from a pool, and write to
 * nothing that two pairs share, with two exceptions: Mcd stamps a model at its first comparison in a round, and a
 * body's certificate of rest may be ended, which any number of threads may do. If the test or the contacts of a pair
 * involve a function of the program, collide leaves the test to commit, and the pair is the last one of its run.
 *
 * With workers (mst_workers.c), all models are stamped first. Then all workers collide runs of pairs that call no
 * program, some runs ahead of the calling thread, which commits them in order. In the first sub-step no pair depends on
 * what is committed for another one, so the contacts are the same as without workers.
 *
 *     data                                written by
 *     McdModelPair.test, .stand           Mcd, when collide compares the pair; commit, if it tests the pair or could
 *                                         not create a touch
 *     McdModelPair.responseData, .forget  commit (mst_commit.c, mst_touch.c)
 *     MstRun                              collide; commit, for a pair that it tests
 *     MstTouch                            update and commit (of the last test; mst_touch.c: of this step); events
 *     manifolds                           Mdt, called by update and commit
 *     versions of materials               commit
 *     MdtBody's safe time                 commit (mst_continuous.c)
 */
#ifndef MST_STEP_I_H
#define MST_STEP_I_H

#include "touch/mst_touch_i.h"

/* ---- the bridge (MstBridge.c) ----------------------------------------------------------------------------------- */

/* Begin and end the stages in which pairs are handled: callbacks' removals of the framework's models and of the world's
 * bodies are deferred. The world may be null. */
void mst_guardPairs(MstBridgeRecord *b, McdFrameworkID frame, MdtWorldID w);
void mst_releasePairs(MstBridgeRecord *b, McdFrameworkID frame, MdtWorldID w);
/* MstBridgeUpdateContacts without its checks: for the bridge itself and MstUniverseStep, whose stages are active. */
void mst_updateContacts(MstBridgeRecord *b, McdSpaceID s, MdtWorldID w);
/* Begins a round: inputs of models and materials are compared anew, as the program may have changed them. */
void mst_beginRound(MstBridgeRecord *b);
/* Allocates a run: contactMax contacts for one pair, and some more for the others. False: no memory, and the run is
 * unchanged. */
MeBool mst_runInit(MstRun *run, int contactMax, const char *function);
void mst_runTerm(MstRun *run);

/* ---- workers (mst_workers.c) ------------------------------------------------------------------------------------- */

/* Stamps the awake models by the workers, before `count` pairs are handled; nothing if that does not pay. */
void mst_stampModelsByWorkers(MstBridgeRecord *b, int count, McdSpaceID s, MdtWorldID w);
/* Collides by the workers and commits the first pairs of an array; returns their number. 0: there are no workers, or
 * the first pair involves a function of the program or a sensor. */
int mst_handlePairsByWorkers(MstBridgeRecord *b, McdModelPair *const pairs[], int count, MdtWorldID w);
void mst_workersTerm(MstBridgeRecord *b);

/* ---- collide (mst_collide.c) ------------------------------------------------------------------------------------- */

/* Collides and updates pairs from the start of the array until the run is full or a pair has to be tested in the commit
 * stage; returns how many pairs it has handled. */
int mst_collideRun(const MstBridgeRecord *b, MstRun *run, McdModelPair *const pairs[], int count);
/* Prefetches pairs that follow pairs[i] (`count` pairs in all), and their models. */
void mst_prefetchModels(McdModelPair *const pairs[], int i, int count);
/* Tests a pair and writes the run's result. False: their geometry types have no interaction. */
MeBool mst_intersectPair(MstRun *run, McdModelPair *p);
/* Tests a pair whose test may call functions of the program, and adds its contacts to the run. */
void mst_testPair(MstBridgeRecord *b, MstRun *run, MstFinding *f);
/* Removes invalid contacts, which a function of the program has made, from the run's result, with a warning. */
void mst_checkContacts(MstBridgeRecord *b, MstRun *run);
/* Sets isHeldApart of each pair: a joint between its bodies disables their collision. Before any pair is collided, as
 * commit changes the bodies' lists of constraints. */
void mst_markNoCollidePairs(McdModelPair *const pairs[], int count);
/* True if neither a function of the program nor a sensor is involved in the pair's outcome. */
MeBool mst_isPlainPair(const MstBridgeRecord *b, const McdModelPair *p);
/* Adds the contacts of the run's result to the run's. */
void mst_convertContacts(const MstBridgeRecord *b, MstRun *run, MstFinding *f);
/* Whether the pair of materials has a callback for collisions or contacts. */
MeBool mst_hasCallback(const MstMaterialPair *materials);
/* The version of the pose of the model's body (MdtBodyGetMoves); 0 without a body. */
unsigned long mst_moveCountOf(McdModelID m);

/* ---- update (mst_update.c) --------------------------------------------------------------------------------------- */

/* Updates the contacts and the touch of a collided pair, if no other pair is affected; then sets f->updated. May also
 * reduce the outcome to MST_NOTHING. */
void mst_updatePair(const MstBridgeRecord *b, const MstRun *run, MstFinding *f);
/* Moves the pair's contacts with its bodies. */
void mst_carryContacts(const MstFinding *f);
/* Records the poses and materials for which the contacts were made. Fast pairs, pairs with callbacks, and pairs whose
 * group has fewer contacts than were found are marked instead, so that they are tested in every step. */
void mst_recordTest(const MstFinding *f, int numContacts, unsigned long version);

/* ---- commit (mst_commit.c) --------------------------------------------------------------------------------------- */

/* Commits the findings of a run, in order. */
void mst_commitRun(MstBridgeRecord *b, MstRun *run, MdtWorldID w);
/* Joins the pair's bodies into one partition, even without contacts. */
void mst_joinPartitions(MstBridgeRecord *b, McdModelPair *p, MdtWorldID w);
/* True if both models have the same body: they make no contacts. */
static inline MeBool mst_isOneBody(const McdModelPair *p) {
    return mst_bodyOf(p->model1) && mst_bodyOf(p->model1) == mst_bodyOf(p->model2);
}

/* ---- continuous motion (mst_continuous.c) ------------------------------------------------------------------------ */

/* Whether the pair may get contacts in a sub-step after the first. */
MeBool mst_mayCollide(const McdModelPair *p);
/* Whether the pair's lagging body, which may not get contacts, has to stop before it touches the other one. */
MeBool mst_mustClampLagging(const McdModelPair *p);
/* s: how long a fast pair may move before an impact, at most the time that its bodies move in this sub-step.
 * hasContacts: its contacts hold what is in touch; else that is no obstacle. */
MeReal mst_timeToImpact(const MstBridgeRecord *b, McdModelPair *p, MeBool hasContacts);
/* s: how long the pair's lagging body may move before it reaches the other one, which has advanced. */
MeReal mst_timeToWait(const MstBridgeRecord *b, McdModelPair *p);
/* Limits the safe time of the pair's lagging body to the finding's timeToImpact. */
void mst_clampLaggingBody(MstBridgeRecord *b, const MstFinding *f);
/* Limits the safe times of the bodies of a fast pair to the time of their impact, if it is within the step.
 * hasContacts: the pair has contacts. */
void mst_clampFastPair(MstBridgeRecord *b, const MstFinding *f, MeBool hasContacts, MdtWorldID w);
/* Limits the safe times of what would reach bodies that are stopped. */
void mst_clampFollowers(MstBridgeRecord *b, McdModelPair *const pairs[], int count);
/* Whether the body is in a large partition, which is costly to solve and on which a single pair has little effect. */
MeBool mst_isInLargeIsland(MdtBodyID body);
/* Whether both bodies are in one large partition. Their impacts do not divide its step: they get contacts ahead
 * of the impact, as slow models do. */
MeBool mst_isWithinLargeIsland(const McdModelPair *p);
/* Removes the safe times of all bodies, as a sub-step begins. */
void mst_clearSafeTimes(MstBridgeRecord *b);
/* Steps the world after the contacts were made: in sub-steps, if a fast model has an impact. */
void mst_stepWorld(MstUniverse *u, MeReal step);

#endif
