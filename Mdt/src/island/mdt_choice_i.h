/* Inside Mdt: the choice between Kea's solvers, the path of a partition's step, and room for it. */
#ifndef MDT_CHOICE_I_H
#define MDT_CHOICE_I_H

#include "island/mdt_island_i.h"

/* ---- the choice of solver (mdt_choice.c) ---- */

/* A step, or another part of one, begins: asks the program for the solver of each partition (MdtWorldSetSolverCB),
 * gives out shares of exact work; and ends. What the program wants for one. */
void mdt_choicesBegin(MdtWorldID w, MeBool isStep);
void mdt_choicesEnd(MdtWorldID w);
MdtSolver mdt_choiceRequested(const MdtWorld *w, int partition);
/* A partition's record gets what is known of one that it had bodies in. */
void mdt_recordJoin(MdtIslandRecord *to, const MdtIslandRecord *from);
/* Whether Kea's fast solver begins the step; writes why. */
MeBool mdt_choiceIsFast(MdtIsland *p);
/* Whether nothing in it touches the world. */
MeBool mdt_choiceIsInFlight(const MdtIsland *p);
/* Multiplications that a step of it may cost; 0: any number. Whether the exact solver has begun the step with a share
 * of exact work, and may decline it. */
double mdt_choiceBudget(const MdtIsland *p);
MeBool mdt_choiceHasShare(const MdtIsland *p);
/* The fast solver takes the rest of the step from the exact one. */
void mdt_choiceSwitchToFast(MdtIsland *p);
/* Whether the exact solver takes a part that the fast one has solved, since its answer does not meet the accuracy; it
 * does. */
MeBool mdt_choiceNeedsExact(const MdtIsland *p);
void mdt_choiceSwitchToExact(MdtIsland *p);
/* The step has ended: writes what is known of it to the record, its own or that of a member. */
void mdt_choiceNote(const MdtIsland *p, MdtIslandRecord *r);
/* The world's accounts are full. */
void mdt_choicesReset(MdtWorldID w);

/* ---- the path of a step (mdt_path.c) ---- */

/* Which of Kea's solvers takes the parts from now on. The scratch memory that was taken for the exact one is enough for
 * the fast one. */
void mdt_islandSetFast(MdtIsland *p, MeBool isFast);
/* How many bodies may be held, at most, in a partition whose impacts are met in time, one after the other; 0: none. */
int mdt_maxConstrained(const MdtIsland *p);

/* A report notes the path of a sub-step. */
void mdt_reportPath(MdtReport *r, MdtReportWay path);
/* An impact at the start of a part; a part that ends early, at an event; a step that is halved. */
void mdt_reportImpact(MdtReport *r);
void mdt_reportEvent(MdtReport *r);
void mdt_reportFlight(MdtReport *r, int impacts, MeBool isEnded);
void mdt_reportDivision(MdtReport *r);
/* A sub-step was of order 4. */
void mdt_reportComposed(MdtReport *r);
/* The last step's answer was taken without a solve. */
void mdt_reportCertified(MdtReport *r);

/* ---- accuracy (mdt_accuracy.c) ---- */

/* m/s: the residual that a step of h seconds may leave (MdtWorldSetAccuracy); below which bodies rest. */
double mdt_worldAccuracy(const MdtWorld *w, double h, MeBool hasJoints);
double mdt_worldCalmSpeed(const MdtWorld *w, double h);

/* ---- room (mdt_reserve.c) ---- */

size_t mdt_tasksSize(size_t bodies); /* ints that the tasks of so many bodies need */

/* Room for the batches of so many bodies, and constraints that act on them. False: no memory. */
MeBool mdt_batchesReserve(MdtBatches *b, int bodies, int acting, const char *caller);
void mdt_batchesTerm(MdtBatches *b);

/* Room for so many bodies and constraints in the arrays of a step. False: no memory. */
MeBool mdt_worldReserve(MdtWorldID w, int bodies, int constraints, const char *caller);

#endif
