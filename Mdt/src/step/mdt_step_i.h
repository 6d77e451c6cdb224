/* Inside Mdt: the stages of a step (its working data: mdt_island_i.h).
 *
 *     stage       file              reads -> writes
 *     partition   mdt_island.c      bodies, constraints -> the world's partitions; wakes bodies connected to awake ones
 *     rest        mdt_sleep.c       motion of the last step -> bodies that fall asleep
 *                 mdt_certificate.c changes since the last step -> partitions whose last answer holds again
 *     pack        mdt_pack.c        forces, impulses, gravity -> loads of Kea's bodies; scratch, start
 *                 mdt_choice.c      records of partitions -> choice of Kea's solver
 *                 mdt_contacts.c    the manifolds of contacts -> kea.manifolds
 *     rows        mdt_rows.c        poses, velocities, parameters of the part -> kea.rows of joints; of contacts: Kea
 *     solve       MdtKeaSolve       kea.rows, kea.manifolds -> their forces; kea.report
 *     integrate   MdtKeaIntegrate   those -> states of Kea's bodies
 *     unpack      mdt_unpack.c      forces of rows -> constraints; states -> public transforms and velocities
 *
 * mdt_parallel.c takes partitions through these stages: one after the other, or by the world's workers, and small ones
 * together as batches (mdt_batch.c). Rows, solve, integrate and the constraints' share of unpack are repeated for each
 * part of a step (mdt_subdivide.c). If nothing divides the step, it is one part.
 */
#ifndef MDT_STEP_I_H
#define MDT_STEP_I_H

#include "island/mdt_choice_i.h"

/* ---- the stages -------------------------------------------------------------------------------------------------- */

/* Advances a partition by its h: pack, the parts, and unpack (mdt_step.c). */
void mdt_islandStep(MdtIsland *p);
/* Steps all partitions, by the world's workers (mdt_parallel.c). mdt_islandAdvance steps one of them. */
void mdt_islandsStep(MdtWorldID w, double h, MeBool stopAtSafeTime);
void mdt_islandAdvance(MdtIsland *p, MeBool stopAtSafeTime);
/* Advances the world by h seconds; stopAtSafeTime: each partition only as far as its safe time allows. */
void mdt_worldStep(MdtWorldID w, double h, MeBool stopAtSafeTime);
/* Makes and solves the rows of a part of so many seconds. No body has moved afterwards: the result may be discarded. */
void mdt_substepSolve(MdtIsland *p, double substep);
/* The same in two calls: makes the rows; resolves impacts at the start of a timed part, and solves. */
void mdt_substepMakeRows(MdtIsland *p, double substep);
void mdt_substepSolveRows(MdtIsland *p);
/* Integrates the part and unpacks the constraints; sets isStopped. */
void mdt_substepIntegrate(MdtIsland *p);

/* mdt_batchesFind finds the batches of a step; `team` helps, null: none. mdt_batchOf is the working data of a batch;
 * mdt_batchAdvance steps it, in place of its members (mdt_batch.c). */
void mdt_batchesFind(MdtWorldID w, double h, MeBool stopAtSafeTime, MeTeam *team);
MdtIsland mdt_batchOf(const MdtWorld *w, int batch, double h);
void mdt_batchAdvance(MdtIsland *p);

/* Counts the present rows of the partition's joints and contacts. */
int mdt_rowsCount(MdtIsland *p);
/* Counts joints and contacts, before mdt_choiceSolver. */
void mdt_islandCount(MdtIsland *p);
/* Allocates scratch memory, and writes loads to Kea's bodies. False, with a warning, if the partition is too large. */
MeBool mdt_islandPack(MdtIsland *p);
void mdt_islandRelease(MdtIsland *p);

/* ---- contacts in Kea's form (mdt_contacts.c) ---- */

/* The number of Kea's manifolds that a group needs; the bytes of `count` manifolds; places a partition's manifolds in
 * memory. */
int mdt_contactsCount(const MdtManifold *first);
size_t mdt_contactsSize(int count);
void mdt_contactsLayOut(MdtIsland *p, void *memory, int count);
/* mdt_contactsPack writes a group's manifolds from index `at` on for the step, adds problem flags of their surfaces,
 * and returns the next index. mdt_contactsCarry updates positions and depths for further parts, for the fast solver.
 * */
int mdt_contactsPack(const MdtIsland *p, const MdtManifold *first, int at, int *problems);
void mdt_contactsCarry(const MdtIsland *p);
/* mdt_contactsAddForces adds `share` times the points' forces to the means over the step; mdt_contactsClearForces
 * zeroes them; mdt_contactsUnpack copies them to the contacts, with isGuess as warm start of the next part. */
void mdt_contactsAddForces(const MdtIsland *p, double share);
void mdt_contactsClearForces(const MdtIsland *p);
/* Keeps the forces of an exact answer that was declined, and makes them the first guess of the next solve. */
void mdt_contactsKeepDeclined(const MdtIsland *p);
void mdt_contactsGuessDeclined(const MdtIsland *p);
void mdt_contactsUnpack(const MdtIsland *p, MeBool isGuess);
double mdt_contactsPenetration(const MdtIsland *p);

/* Whether a mover crushes bodies, by the answer for a part (mdt_crush.c); the record keeps it. mdt_crushUndoImpact
 * gives bodies the velocities of the step's start if an impact has crushed them; mdt_crushCapSpeeds limits those at the
 * end of a step that has to the fastest at its start. */
MeBool mdt_isCrushed(const MdtIsland *p);
void mdt_crushUndoImpact(const MdtIsland *p);
void mdt_crushCapSpeeds(const MdtIsland *p);
/* Advances the step in parts, within its work budget, or until the bodies are stopped (mdt_subdivide.c). */
void mdt_islandSubdivide(MdtIsland *p);
/* mdt_substepBegin sets the parameters and Kea's arrays of a part; mdt_substepImpact resolves an impact at its start;
 * mdt_substepEnd, after integration, adds its time to that of the step. */
void mdt_substepBegin(MdtIsland *p, double substep);
void mdt_substepImpact(MdtIsland *p);
void mdt_substepReflected(MdtIsland *p);
void mdt_substepEnd(MdtIsland *p);
/* Advances by a part, the result of `halvings` halvings, and halves it further if its motion is violent.
 * mdt_substepAdvanceRows needs the part's rows. */
void mdt_substepAdvance(MdtIsland *p, double substep, int halvings);
void mdt_substepAdvanceRows(MdtIsland *p, double substep, int halvings);
/* True if parts may be integrated with order 4; integrates a part so, as far as possible (mdt_compose.c). */
MeBool mdt_mayCompose(const MdtIsland *p);
void mdt_substepCompose(MdtIsland *p, double substep);
/* mdt_budgetGrant sets the budget of the next solve; mdt_budgetDraw subtracts the cost of the last one. */
void mdt_budgetGrant(MdtIsland *p);
void mdt_budgetDraw(MdtIsland *p);

/* Makes the rows of a part, after MdtKeaInit (mdt_rows.c). */
void mdt_rowsMake(MdtIsland *p);
/* Callbacks of Kea for other poses of the bodies: the joints' rows, and their errors. The context is the island. */
void MEAPI mdt_rowsUpdateJacobians(void *island, const MdtKeaTransformation poses[]);
void MEAPI mdt_rowsErrors(void *island, const MdtKeaTransformation poses[], double errors[]);
/* The number of stops without a row that the solved part passes; they get rows from now on. */
int mdt_rowsPassed(const MdtIsland *p);
/* The poses of a joint's sides after a share of the part: of their bodies in `poses`, or the world's. A mover's is
 * written to `memory`; share 1/2: the mean of start and end. Both have MdtBclMAXSIDES entries. */
void mdt_jointPoses(const MdtIsland *p, const MdtJoint *j, double share, const MdtKeaTransformation poses[],
                    const MdtKeaTransformation *pose[], MdtKeaTransformation memory[]);
/* The data of the system for a joint in this part, with these poses. */
void mdt_jointContext(const MdtIsland *p, MdtJoint *j, double share, const MdtKeaTransformation poses[],
                      MdtBclContext *x);
/* Leaves out rows of contacts, in the documented order (mdt_cap.c), until at most `max` of the partition's `rows` rows
 * are left. Returns the number of rows left. */
int mdt_capRows(MdtIsland *p, int rows, int max);

/* Forces of joints and contacts: mdt_unpackBegin zeroes them at the start of a step; mdt_unpackImpact adds the impulses
 * of an impact; mdt_unpackConstraints reads them back after a part. */
void mdt_unpackBegin(const MdtIsland *p);
void mdt_unpackImpact(const MdtIsland *p);
void mdt_unpackConstraints(const MdtIsland *p);
/* Reads back the states of bodies at the end of the step. */
void mdt_unpackBodies(MdtIsland *p);
/* Fallback: bodies whose next state is not finite keep their pose, with velocity 0. */
void mdt_unpackStopped(const MdtIsland *p);

/* ---- steps by safe time (mdt_lag.c) ------------------------------------------------------------------------------ */

/* s: the shortest safe time of some bodies, at most `max`. */
double mdt_minSafeTime(MdtBodyID const bodies[], int count, double max);
/* s: the time by which a partition may advance: the shortest safe time of its bodies, within bounds. */
double mdt_lagSafeStep(const MdtIsland *p);
/* Subtracts the advance h of a partition from the remaining time of the step, as the lag of its bodies. */
void mdt_lagSet(const MdtIsland *p, double remainingTime);

/* Draws what MdtWorldSetDebugDrawing has selected (mdt_debug.c). */
void mdt_debugDraw(MdtWorldID w);
/* Check builds, at the start of a step of h seconds: warns if nothing moves in a world without gravity. */
void mdt_idleCheck(MdtWorldID w, double h);

/* ---- the report (mdt_report.c); called only if the step is reported -------------------------------------------- */

/* At the start of a step, when its partitions are known. */
void mdt_reportStep(MdtWorldID w);
/* At the start of a partition: sets its report, null if there is none, and how it is timed. */
void mdt_reportBegin(MdtIsland *p);
/* Ends a stage: adds the time since the last call to it. */
void mdt_reportLap(MdtIsland *p, MdtReportStage stage);
/* Reports the cost of a solve, and ends its stage. */
void mdt_reportSolve(MdtIsland *p);
/* Reports the errors of a part that has been integrated, before anything is read back. */
void mdt_reportSubstep(MdtReport *r, const MdtIsland *p, MeBool isFinite);
/* At the end of a partition, also of one that was put to sleep. */
void mdt_reportEnd(MdtIsland *p);
/* At the start of a batch: sets its own report, if steps are reported. mdt_reportMember writes a member's report after
 * the batch; mdt_reportBatchesEnd is called after all batches. */
void mdt_reportBatch(MdtIsland *p, MdtReport *r);
void mdt_reportMember(const MdtIsland *p, const MdtMember *m, int rows, double penetration);
void mdt_reportBatchesEnd(MdtWorldID w);
/* At the end of the step. */
void mdt_reportStepEnd(MdtWorldID w);

#endif
