/* Inside Mst: the stages from pairs of models to contacts of their bodies.
 *
 *     stage     file              reads -> writes
 *     pairs     MstBridge.c       the space's pairs -> the bridge's buffer of them; hello and goodbye pairs
 *     collide   mst_collide.c     models, poses, motion of bodies; the pair's manifold and touch -> a run's
 *                                 findings; of each pair, what Mcd keeps of its test
 *     update    mst_update.c      findings about contacts that go on -> the pair's manifold and touch
 *     commit    mst_commit.c      all other findings -> manifolds, touches, safe times of bodies; callbacks of the
 *                                 program; the step's list of touches
 *     touches   mst_touch.c       contacts of a pair -> its touch
 *     parts     mst_continuous.c  findings of fast models -> safe times; the world's step, in parts
 *     events    MstEvents.c       touches, forces of their contacts -> events; callbacks of the program
 *
 * Collide and commit take turns, run by run (MstHandleCollisions): a run is as many pairs as stay in the nearest cache
 * from one to the other. Collide and update call no function of the program, take nothing from a pool, and write to
 * nothing that two pairs share, but for the stamp that Mcd gives a model at its first look in a round, and for the mark
 * that a body's certificate of rest has ended, which any number of threads may set. A pair whose test or contacts
 * involve a function of the program is only looked at there: it ends the run, and commit tests it.
 *
 * With workers (mst_workers.c), models get their stamps first; then runs of pairs that call no program are collided by
 * all workers, some runs ahead of the calling thread, which commits them in their order. In the first part of a step no
 * pair depends on what is committed of another one, so that contacts are the same.
 *
 *     data                                owner: who writes it
 *     McdModelPair.test, .stand           Mcd, as collide looks at the pair; commit, where it tests it, or got no touch
 *     McdModelPair.responseData, .forget  commit (mst_commit.c, mst_touch.c)
 *     MstRun                              collide; commit, of a pair that it has to test
 *     MstTouch                            update and commit (of the last test; mst_touch.c: of this step); events
 *     manifolds                           Mdt, at the call of update and commit
 *     versions of materials               commit
 *     MdtBody's safe time                 commit (mst_continuous.c)
 */
#ifndef MST_STEP_I_H
#define MST_STEP_I_H

#include "touch/mst_touch_i.h"

/* ---- the bridge (MstBridge.c) ----------------------------------------------------------------------------------- */

/* For the time in which pairs of the space, which may be null, are handled for the world, which may be none. */
void mst_guardPairs(MstBridgeRecord *b, McdFrameworkID frame, MdtWorldID w);
void mst_releasePairs(MstBridgeRecord *b, McdFrameworkID frame, MdtWorldID w);
/* MstBridgeUpdateContacts, by who holds the bridge. */
void mst_updateContacts(MstBridgeRecord *b, McdSpaceID s, MdtWorldID w);
/* Begins a round of pairs: inputs are compared anew, as programs may have changed them before, or in a callback. */
void mst_beginRound(MstBridgeRecord *b);
/* Room for the contacts of one pair, and of the rest of a run. False: there is no memory, and the run is as it was. */
MeBool mst_runInit(MstRun *run, int contactMax, const char *function);
void mst_runTerm(MstRun *run);

/* ---- workers (mst_workers.c) ------------------------------------------------------------------------------------- */

/* So many pairs are about to be handled: looks at the models that move. */
void mst_lookByWorkers(MstBridgeRecord *b, int count, McdSpaceID s, MdtWorldID w);
/* Collides and commits some pairs, from the first on, by the workers; returns how many: none, where a function of
 * the program has to do with the first, or there are no workers. */
int mst_handleByWorkers(MstBridgeRecord *b, McdModelPair *const pairs[], int count, McdSpaceID s, MdtWorldID w);
void mst_workersTerm(MstBridgeRecord *b);

/* ---- collide (mst_collide.c) ------------------------------------------------------------------------------------- */

/* Looks at pairs from the first on, and tests them, until the run is full, or ends for another reason; returns how
 * many. */
int mst_collideRun(const MstBridgeRecord *b, MstRun *run, McdModelPair *const pairs[], int count, McdSpaceID s);
/* Asks for the memory of pairs that follow pairs[i], up to the last of them, and of their models. */
void mst_prefetchModels(McdModelPair *const pairs[], int i, int count);
/* Tests a pair: the run's result. False: no interaction of its types is known. */
MeBool mst_intersectPair(MstRun *run, McdModelPair *p);
/* Tests a pair whose test may call functions of the program; its contacts become part of the run's. */
void mst_testPair(MstBridgeRecord *b, MstRun *run, MstFinding *f);
/* Of the run's result, as a function of the program has left it: what is no contact is left out, with a warning. */
void mst_checkContacts(MstBridgeRecord *b, MstRun *run);
/* Notes of each pair whether a joint of its bodies lets them pass through each other: before any is collided, as commit
 * changes the lists in which bodies have their joints. */
void mst_noteNoCollide(McdModelPair *const pairs[], int count);
/* Is the pair's outcome found without a function of the program, and without a sensor? */
MeBool mst_isPlainPair(const MstBridgeRecord *b, const McdModelPair *p);
/* The run's result, as a callback left it, becomes part of its contacts. */
void mst_convertContacts(const MstBridgeRecord *b, MstRun *run, MstFinding *f);
/* Whether the pair of materials has a callback of contacts. */
MeBool mst_hasCallback(const MstMaterialPair *materials);
unsigned long mst_movesOf(McdModelID m);

/* ---- update (mst_update.c) --------------------------------------------------------------------------------------- */

/* Updates the contacts and the touch of a pair that has just been collided, if it may be done beside other pairs;
 * writes f->updated, or that nothing is left to do. */
void mst_updatePair(const MstBridgeRecord *b, const MstRun *run, MstFinding *f);
/* Its contacts move with its bodies. */
void mst_carry(const MstFinding *f);
/* Notes the state of the models that the contacts were made from. Not for pairs that are tested in every step: fast
 * ones, those with callbacks, and those whose group holds fewer contacts than were found. */
void mst_rememberTest(const MstFinding *f, int numContacts, unsigned long version);

/* ---- commit (mst_commit.c) --------------------------------------------------------------------------------------- */

void mst_commitRun(MstBridgeRecord *b, MstRun *run, McdSpaceID s, MdtWorldID w);
/* Joins the pair's bodies into one partition, whether they touch or not. */
void mst_pairTie(MstBridgeRecord *b, McdModelPair *p, MdtWorldID w);
/* Have both models the same body? They make no contacts. */
static inline MeBool mst_isOneBody(const McdModelPair *p) {
    return mst_bodyOf(p->model1) && mst_bodyOf(p->model1) == mst_bodyOf(p->model2);
}

/* ---- continuous motion (mst_continuous.c) ------------------------------------------------------------------------ */

/* Whether the pair may get contacts in a later part of the step. */
MeBool mst_mayCollide(const McdModelPair *p);
/* If not: whether its fast model has to wait for the other one. */
MeBool mst_mustWait(const McdModelPair *p);
/* s, for which the models of a pair without contacts do not touch, at most as long as they move in this part. */
MeReal mst_timeToTouch(const MstBridgeRecord *b, McdModelPair *p, McdSpaceID s);
/* Sets that time as the safe time of the body that has to wait. */
void mst_waitFor(MstBridgeRecord *b, const MstFinding *f);
/* For a pair with a fast model: sets the safe time of its bodies, if they meet now or later in the step. */
void mst_followFast(MstBridgeRecord *b, const MstFinding *f, MeBool hasContacts, McdSpaceID s, MdtWorldID w);
/* Is the body part of a large partition, in which a single pair matters little, and a solve costs much? */
MeBool mst_isInLargeIsland(MdtBodyID body);
/* A part of the step begins: no body has a safe time. */
void mst_clearSafeTimes(MstBridgeRecord *b);
/* The world's step after the contacts were made: in parts, where a fast model has an impact. */
void mst_stepWorld(MstUniverse *u, MeReal step);

#endif
