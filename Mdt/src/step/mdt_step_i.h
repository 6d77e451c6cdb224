/* Inside Mdt: the stages of a step (its working data: mdt_island_i.h).
 *
 *     stage       file              reads -> writes
 *     partition   mdt_island.c      bodies, constraints -> the world's partitions; wakes what is tied to awake bodies
 *     rest        mdt_sleep.c       motion of the last step -> bodies that are put to sleep
 *                 mdt_certificate.c what has changed since the last step -> partitions whose last answer holds again
 *     pack        mdt_pack.c        forces, impulses, gravity -> loads of Kea's bodies; scratch, start
 *                 mdt_choice.c      records of partitions -> which of Kea's solvers
 *                 mdt_contacts.c    the manifolds of contacts -> kea.manifolds
 *     rows        mdt_rows.c        poses, velocities, parameters of the part -> kea.rows of joints; contacts', by Kea
 *     solve       MdtKeaSolve       kea.rows, kea.manifolds -> their forces; kea.report
 *     integrate   MdtKeaIntegrate   those -> the states of Kea's bodies
 *     unpack      mdt_unpack.c      forces of rows -> constraints; states -> what programs see of bodies
 *
 * mdt_parallel.c takes partitions through these stages: one after the other, or by the world's workers; many of few
 * bodies together, as batches (mdt_batch.c).
 * Rows, solve, integrate and the constraints' part of unpack are repeated for every part that a step is taken in
 * (mdt_subdivide.c). A part is the whole step where nothing divides it.
 */
#ifndef MDT_STEP_I_H
#define MDT_STEP_I_H

#include "island/mdt_choice_i.h"

/* ---- the stages -------------------------------------------------------------------------------------------------- */

/* Pack, the parts, and unpack: moves a partition on by its h (mdt_step.c). */
void mdt_islandStep(MdtIsland *p);
/* All partitions of a step, by its workers (mdt_parallel.c); one of them. */
void mdt_islandsStep(MdtWorldID w, double h, MeBool safely);
void mdt_islandAdvance(MdtIsland *p, MeBool safely);
/* Moves the world on by h seconds; safely: each partition by what its safe time allows of them. */
void mdt_worldStep(MdtWorldID w, double h, MeBool safely);
/* Rows and solve, of a part of the step of these seconds. Nothing has moved yet: it may be thrown away. */
void mdt_substepSolve(MdtIsland *p, double substep);
/* The same by itself: rows; impacts of a timed part, and solve. */
void mdt_substepMakeRows(MdtIsland *p, double substep);
void mdt_substepSolveRows(MdtIsland *p);
/* Integrate, and unpack of the constraints; writes isStopped. */
void mdt_substepIntegrate(MdtIsland *p);

/* Finds the batches of a step, with a team's help unless it is null; such a one; takes it, instead of its members'
 * steps (mdt_batch.c). */
void mdt_batchesFind(MdtWorldID w, double h, MeBool safely, MeTeam *team);
MdtIsland mdt_batchOf(MdtWorldID w, int batch, double h);
void mdt_batchAdvance(MdtIsland *p);

/* The rows that the partition's joints and contacts have as they are now. */
int mdt_rowsCount(MdtIsland *p);
/* Counts joints and contacts, before the choice of a solver. */
void mdt_islandCount(MdtIsland *p);
/* Takes scratch memory, and loads into Kea's bodies. False, with a message: the partition is too large. */
MeBool mdt_islandPack(MdtIsland *p);
void mdt_islandRelease(MdtIsland *p);

/* ---- contacts, as Kea takes them (mdt_contacts.c) ---- */

/* How many manifolds of Kea's a group's are; the bytes that so many of a partition need; where these are. */
int mdt_contactsCount(const MdtManifold *first);
size_t mdt_contactsSize(int count);
void mdt_contactsLayOut(MdtIsland *p, void *memory, int count);
/* For the step: a group's manifolds, from that one on; returns the next one, and adds what is wrong with their
 * surfaces. For a part of it that is not the first, of the fast solver: where points are. */
int mdt_contactsPack(const MdtIsland *p, const MdtManifold *first, int at, int *problems);
void mdt_contactsCarry(MdtIsland *p);
/* This share of their forces is added to what the step has done; these are the points' forces, and whether they are a
 * guess at those of the next part. */
void mdt_contactsAddForces(MdtIsland *p, double share);
void mdt_contactsClearForces(MdtIsland *p);
void mdt_contactsUnpack(MdtIsland *p, MeBool isGuess);
double mdt_contactsPenetration(const MdtIsland *p);

/* Takes the step in parts, within its budget of work, until its bodies are stopped (mdt_subdivide.c). */
void mdt_islandSubdivide(MdtIsland *p);
/* A part of the step begins: its parameters, Kea's arrays; bodies meet in it; it has been integrated. */
void mdt_substepBegin(MdtIsland *p, double substep);
void mdt_substepImpact(MdtIsland *p);
void mdt_substepEnd(MdtIsland *p);
/* Takes a part, which so many halvings have made, in halves where its motion is violent; the same when its rows are
 * made. */
void mdt_substepAdvance(MdtIsland *p, double substep, int halvings);
void mdt_substepAdvanceRows(MdtIsland *p, double substep, int halvings);
/* Whether parts may be taken in stages of order 4; takes one so, as far as that goes (mdt_compose.c). */
MeBool mdt_mayCompose(const MdtIsland *p);
void mdt_substepCompose(MdtIsland *p, double substep);
/* The budget of a solve; the cost of the last one. */
void mdt_budgetGrant(MdtIsland *p);
void mdt_budgetDraw(MdtIsland *p);

/* Makes the rows of a part, after MdtKeaInit (mdt_rows.c). */
void mdt_rowsMake(MdtIsland *p);
/* For Kea: the rows of joints, and their errors, were the bodies elsewhere. The context is the island. */
void MEAPI mdt_rowsMove(void *island, const MdtKeaTransformation poses[]);
void MEAPI mdt_rowsErrors(void *island, const MdtKeaTransformation poses[], double errors[]);
/* The system as a constraint sees it in this part, but for its first row. */
void mdt_rowsContext(const MdtIsland *p, MdtConstraintID c, const MdtKeaVelocity *worldVelocity, MdtBclContext *x);
/* Leaves out rows of contacts until the partition, which has that many, has at most `max`, in the documented order
 * (mdt_cap.c). Returns how many it has then. */
int mdt_capRows(MdtIsland *p, int rows, int max);

/* Constraints of any kind: their forces are empty; the impulses of an impact, those of a part count among them; read
 * back. */
void mdt_unpackBegin(MdtIsland *p);
void mdt_unpackImpact(MdtIsland *p);
void mdt_unpackConstraints(MdtIsland *p);
/* Bodies, at the end of the step. */
void mdt_unpackBodies(MdtIsland *p);
/* Fallback: bodies whose next state is not finite keep their pose, with velocity 0. */
void mdt_unpackStopped(MdtIsland *p);

/* ---- steps by safe time (mdt_lag.c) ------------------------------------------------------------------------------ */

/* How far a partition may move: the shortest safe time of its bodies, within bounds. */
double mdt_lagSafeStep(const MdtIsland *p);
/* The partition has advanced by h: subtracts it from the lag of its bodies. */
void mdt_lagSet(const MdtIsland *p, double remainingTime);

/* Draws what MdtWorldSetDebugDrawing has chosen (mdt_debug.c). */
void mdt_debugDraw(MdtWorldID w);
/* Check builds, before a step of h seconds: warns of a world without gravity in which nothing moves. */
void mdt_idleWatch(MdtWorldID w, double h);

/* ---- the report (mdt_report.c); r is never null, a step that is not reported asks for nothing ------------------ */

/* A step begins, its partitions are known. */
void mdt_reportStep(MdtWorldID w);
/* A partition begins: its report, null if there is none, and how it is timed. */
void mdt_reportBegin(MdtIsland *p);
/* The stage ends. */
void mdt_reportLap(MdtIsland *p, MdtReportStage stage);
/* Reports the cost of a solve; its stage ends. */
void mdt_reportSolve(MdtIsland *p);
/* A part was integrated: its errors, before anything is read back. */
void mdt_reportSubstep(MdtReport *r, const MdtIsland *p, MeBool isFinite);
/* The partition is done, or was put to rest. */
void mdt_reportEnd(MdtIsland *p);
/* A batch begins, with a report of its own, if there is one; that of a member, when the batch is done; all batches
 * are. */
void mdt_reportBatch(MdtIsland *p, MdtReport *r);
void mdt_reportMember(const MdtIsland *p, const MdtMember *m, int rows, double penetration);
void mdt_reportBatchesEnd(MdtWorldID w);
/* All partitions are done. */
void mdt_reportStepEnd(MdtWorldID w);

#endif
