/* Inside Mdt: the choice between Kea's solvers, the path of a partition's step, and the capacity of its arrays. */
#ifndef MDT_CHOICE_I_H
#define MDT_CHOICE_I_H

#include "island/mdt_island_i.h"

/* ---- the choice of solver (mdt_choice.c) ---- */

/* At the start of a step or of a further part of it: queries the program's choice for each partition
 * (MdtWorldSetSolverCB), and assigns shares of exact work. At its end: returns unused shares. mdt_choiceRequested: the
 * program's choice for a partition. */
void mdt_choicesBegin(MdtWorldID w, MeBool isStep);
void mdt_choicesEnd(MdtWorldID w);
MdtSolver mdt_choiceRequested(const MdtWorld *w, int partition);
/* Merges the record of a partition of the last step into that of one that has bodies of it. */
void mdt_recordMerge(MdtIslandRecord *to, const MdtIslandRecord *from);
/* The solver that starts the step; sets p->why. */
MdtSolver mdt_choiceSolver(MdtIsland *p);
/* True if no contact of the partition is with the world. */
MeBool mdt_choiceIsInFlight(const MdtIsland *p);
/* Multiplications that its step may cost; 0: unlimited. mdt_choiceHasShare: true if the exact solver started the step
 * with a share of exact work, and may decline it. */
double mdt_choiceBudget(const MdtIsland *p);
MeBool mdt_choiceHasShare(const MdtIsland *p);
/* Multiplications that a step pays into the account of needed work. */
double mdt_choicePayment(const MdtIsland *p);
/* Makes the fast solver solve the rest of a step that the exact solver has started. */
void mdt_choiceSwitchToFast(MdtIsland *p);
/* True if the exact solver has to redo a part whose fast answer misses the accuracy. mdt_choiceSwitchToExact makes it
 * solve the part. */
MeBool mdt_choiceNeedsExact(const MdtIsland *p);
void mdt_choiceSwitchToExact(MdtIsland *p);
/* At the end of a step: updates the record of the partition, or of a member of the batch. */
void mdt_choiceRecordStep(const MdtIsland *p, MdtIslandRecord *r);
/* Sets the balances of the world's accounts to their limits. */
void mdt_choicesReset(MdtWorldID w);

/* ---- the path of a step (mdt_path.c) ---- */

/* Sets which of Kea's solvers solves the parts from now on. Scratch memory for the exact solver is enough for the fast
 * one. */
void mdt_islandSetFast(MdtIsland *p, MeBool isFast);
/* How many bodies may be constrained by contacts in a partition whose impacts are timed; 0: none. */
int mdt_maxConstrained(const MdtIsland *p);

/* Records the path of a sub-step, if the report is not null. */
void mdt_reportPath(MdtReport *r, MdtReportWay path);

/* ---- accuracy (mdt_accuracy.c) ---- */

/* m/s, for a step of h seconds: the residual that it may leave (MdtWorldSetAccuracy); mdt_worldCalmSpeed: the speed
 * below which bodies rest. */
double mdt_worldAccuracy(const MdtWorld *w, double h, MeBool hasJoints);
double mdt_worldCalmSpeed(const MdtWorld *w, double h);

/* ---- capacities (mdt_reserve.c) ---- */

size_t mdt_tasksSize(size_t bodies); /* number of ints that the tasks of `bodies` bodies need */

/* Reserves capacity in batches for so many bodies and acting constraints. False, after a fatal error: no memory. */
MeBool mdt_batchesReserve(MdtBatches *b, int bodies, int acting, const char *caller);
void mdt_batchesTerm(MdtBatches *b);

/* Reserves capacity for so many bodies and constraints in the arrays of a step. False, after a fatal error: no memory.
 * */
MeBool mdt_worldReserve(MdtWorldID w, int bodies, int constraints, const char *caller);

#endif
