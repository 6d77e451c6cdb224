/** @file MdtWorld.h
 *  Worlds: creating them, their parameters, stepping (Dynamics guide ch. 2, 4 and 5).
 *
 *  A new world has no gravity: MdtWorldSetGravity. Its bodies take part in a step once they are enabled, each by
 *  MdtBodyEnable.
 *
 *  Worlds are independent of each other. A world and what is in it belong to one thread at a time; different worlds
 *  may be stepped by different threads. A null or destroyed world gets a warning and a neutral result everywhere. A
 *  number that is not finite, or out of its range, gets a warning and leaves the old value.
 */
#ifndef MDTWORLD_H
#define MDTWORLD_H

#include "MdtTypes.h"
#include "MeTask.h"

ME_BEGIN_C

/**
 * Creates a world with room for @a maxBodies bodies and @a maxConstraints joints and contacts.
 *
 * @a lengthScale [m] and @a massScale [kg] say how large and heavy a typical object is: the defaults of bodies and the
 * thresholds of resting are scaled by them, and epsilon by 1/massScale: 0.0001 for 1 kg, as the Dynamics guide has it.
 * (A universe's world is stiffer: MstUniverseCreate.) Both forms of the guides compile: MdtWorldCreate(maxBodies,
 * maxConstraints), with scales of 1, and the form with all four. Scales that are not positive and finite get a warning
 * and count as 1.
 *
 * Returns the world, or null when there is no memory. Destroy it with MdtWorldDestroy. All memory for bodies and
 * constraints is allocated here, through MeMemoryAPI. With MeNoLimit the world begins without and grows when it is
 * full; handles and pointers stay, and the results are the same. Dynamics guide ch. 2, "Initializing the World".
 */
#ifdef __cplusplus
MEPUBLIC MdtWorldID MEAPI MdtWorldCreate(const unsigned int maxBodies, const unsigned int maxConstraints,
                                         const MeReal lengthScale = 1, const MeReal massScale = 1);
#else
MEPUBLIC MdtWorldID MEAPI MdtWorldCreate(const unsigned int maxBodies, const unsigned int maxConstraints,
                                         const MeReal lengthScale, const MeReal massScale);
#define MDT_FIFTH(a, b, c, d, e, ...)   e
#define MdtWorldCreateWith2(b, c)       (MdtWorldCreate)((b), (c), (MeReal)1, (MeReal)1)
#define MdtWorldCreateWith4(b, c, l, m) (MdtWorldCreate)((b), (c), (l), (m))
#define MdtWorldCreate(...)                                                                                            \
    MDT_FIFTH(__VA_ARGS__, MdtWorldCreateWith4, MdtWorldCreate_takes_2_or_4_arguments, MdtWorldCreateWith2,            \
              MdtWorldCreate_takes_2_or_4_arguments, 0)                                                                \
    (__VA_ARGS__)
#endif

/** Destroys a world with all its bodies and constraints; their handles end with it. Dynamics guide ch. 2. */
MEPUBLIC void MEAPI MdtWorldDestroy(const MdtWorldID w);
/** Destroys all bodies and constraints of a world. Its parameters and callbacks stay. Not from within a step's
 *  callback. */
MEPUBLIC void MEAPI MdtWorldReset(const MdtWorldID w);
/** The same; gravity, epsilon, gamma, the largest matrix, the least safe time and auto-disabling are then those of a
 *  new world of the same length and mass scales. Not from within a step's callback. */
MEPUBLIC void MEAPI MdtWorldReCreate(const MdtWorldID w);
/** How many bytes of scratch memory the world's steps have taken at most. */
MEPUBLIC int MEAPI MdtWorldGetMaxMemoryPoolUsed(const MdtWorldID w);

/**
 * Moves the world on by @a stepSize seconds: partitions it, puts resting partitions to sleep, finds the forces of the
 * constraints (Kea) and the new velocities and positions. On return bodies, transforms, forces read back and limit
 * positions are those of the new time, and the force and torque accumulators of the bodies that were simulated are
 * zero. The step size may differ from call to call. One that is not positive and finite gets a warning, and nothing
 * moves. Dynamics guide ch. 2, "Stepping Through Time".
 */
MEPUBLIC void MEAPI MdtWorldStep(const MdtWorldID w, const MeReal stepSize);

/**
 * Like MdtWorldStep, but a partition moves on only by the shortest safe time of its bodies (MdtBodySetSafeTime), at
 * least by MdtWorldGetMinSafeTime and at most by @a stepSize.
 */
MEPUBLIC void MEAPI MdtWorldStepSafeTime(const MdtWorldID w, const MeReal stepSize);
/**
 * Moves the partitions that MdtWorldStepSafeTime has left behind on, by what their bodies lack (MdtBodyGetLag), at most
 * by the shortest of their safe times, which may be 0. Forces that were added for the step act in the rest of it as
 * well. A partition in which an awake body is not behind stays where it is; bodies that it wakes are behind as it is.
 * It puts nothing to rest, calls no partition callback, and leaves the report as it was. What is lacking when the next
 * step begins is lost. Returns how many partitions it moved. Beyond Karma.
 */
MEPUBLIC int MEAPI MdtWorldStepRest(const MdtWorldID w);
/** How many bodies are behind. Beyond Karma. */
MEPUBLIC int MEAPI MdtWorldGetLaggingBodies(const MdtWorldID w);

/**
 * Gravity, m/s², world frame. Default 0. Another value wakes the bodies at rest. Check builds warn
 * once of a world for which this was never called, and on whose bodies nothing acts in a second of steps: no velocity,
 * force, impulse or constraint.
 */
MEPUBLIC void MEAPI MdtWorldSetGravity(const MdtWorldID w, const MeReal gx, const MeReal gy, const MeReal gz);
MEPUBLIC void MEAPI MdtWorldGetGravity(const MdtWorldID w, MeVector3 g);

/** @name Epsilon and gamma (Dynamics guide ch. 5, "The Meaning of Epsilon and Gamma")
 *  Epsilon [1/kg], >= 0: the compliance (CFM) of joints and of contacts along their normals; 0 is rigid. Under a load F
 *  they give way by epsilon F h² / gamma, h the step: by 1.4 mm for each tonne at 60 Hz and the defaults. What touches
 *  and so sinks by a fiftieth of the length scale is told of, once. Constraints
 *  of rotation have the compliance epsilon / lengthScale², as if the load acted at a lever arm of the length scale.
 *  Default 0.0001 / massScale; a universe sets its own (MstUniverseCreate). A value that a program sets is absolute,
 *  whatever massScale is.
 *
 *  Friction, motors and brakes have no epsilon. They act on velocities, so a compliance would be viscosity: a body that
 *  friction can hold would creep. Slip (MdtContactParamsSetPrimarySlip) makes a surface that gives way.
 *
 *  Gamma, 0..1: the fraction of a constraint's error that one step removes (ERP). Default 0.2. Where many bodies touch
 *  (docs/solver.md, "Crowds") overlaps of few contacts vanish sooner, by up to 1 - (1 - gamma)^4.4 a step.
 *  @{ */
MEPUBLIC void MEAPI MdtWorldSetEpsilon(const MdtWorldID w, const MeReal e);
MEPUBLIC MeReal MEAPI MdtWorldGetEpsilon(const MdtWorldID w);
MEPUBLIC void MEAPI MdtWorldSetGamma(const MdtWorldID w, const MeReal g);
MEPUBLIC MeReal MEAPI MdtWorldGetGamma(const MdtWorldID w);
/** Sets gamma for steps of @a aTimeStep so that errors die in the same time as with @a aGamma at @a aRefStep:
 *  1 - (1 - aGamma)^(aTimeStep / aRefStep), since T / h steps leave (1 - gamma)^(T / h) of an error after the time T.
 *  Times in seconds, positive. Call it again when the step changes. */
MEPUBLIC void MEAPI MdtWorldSetGammaWithRefTimeStep(const MdtWorldID w, const MeReal aGamma, const MeReal aRefStep,
                                                    const MeReal aTimeStep);
/** @} */

/** @name Putting bodies to rest (Dynamics guide ch. 4, "Enabling/Disabling Bodies")
 *  A partition is disabled ("falls asleep") when all its bodies have been enabled for the alive window, the squares of
 *  their velocity, angular velocity, acceleration and angular acceleration are below the thresholds, and the next
 *  second (five alive times) would not move one of them to speak of: docs/simulation.md, "Sleep", has the rule, and
 *  what wakes them. It stays enabled while a motor turns a joint of it, at whatever speed, while what it is attached to
 *  moves, and while a contact with a moving surface pushes one of them (MdtContactParamsSetPrimarySlide,
 *  MdtConstraintSetWorldLinearVelocity). On by default. What trembles in its place may sleep at any acceleration.
 *
 *  The thresholds are squares, >= 0. They start at the values of MdtDefaults.h, those of velocity and acceleration
 *  times the square of the length scale; the acceleration's is limited to a tenth of gravity, and both follow
 *  MdtWorldSetGravity until the program sets them. Once it has set one, what is below them is at rest, and nothing else
 *  is asked. They are for seconds; a program with another unit of time sets all of them, and the alive time.
 *  @{ */
MEPUBLIC void MEAPI MdtWorldSetAutoDisable(const MdtWorldID w, const MeBool d);
MEPUBLIC MeBool MEAPI MdtWorldGetAutoDisable(const MdtWorldID w);
MEPUBLIC void MEAPI MdtWorldSetAutoDisableVelocityThreshold(const MdtWorldID w, const MeReal vt);
MEPUBLIC MeReal MEAPI MdtWorldGetAutoDisableVelocityThreshold(const MdtWorldID w);
MEPUBLIC void MEAPI MdtWorldSetAutoDisableAngularVelocityThreshold(const MdtWorldID w, const MeReal avt);
MEPUBLIC MeReal MEAPI MdtWorldGetAutoDisableAngularVelocityThreshold(const MdtWorldID w);
MEPUBLIC void MEAPI MdtWorldSetAutoDisableAccelerationThreshold(const MdtWorldID w, const MeReal at);
MEPUBLIC MeReal MEAPI MdtWorldGetAutoDisableAccelerationThreshold(const MdtWorldID w);
MEPUBLIC void MEAPI MdtWorldSetAutoDisableAngularAccelerationThreshold(const MdtWorldID w, const MeReal aat);
MEPUBLIC MeReal MEAPI MdtWorldGetAutoDisableAngularAccelerationThreshold(const MdtWorldID w);
/** How long a body stays enabled after it was enabled, in seconds. Default 0.2 s. Replaces a window in steps. */
MEPUBLIC void MEAPI MdtWorldSetAutoDisableAliveTime(const MdtWorldID w, const MeReal aw);
/** In seconds; a window in steps is converted with the length of the last step (1/60 s before the first). */
MEPUBLIC MeReal MEAPI MdtWorldGetAutoDisableAliveTime(const MdtWorldID w);
/** In steps, rounded up; a window in seconds is converted with the length of the last step. */
MEPUBLIC int MEAPI MdtWorldGetAutoDisableAliveWindow(const MdtWorldID w);
/** The same in steps, as the Dynamics guide has it. Replaces a window in seconds. The User Guide passes seconds under
 *  this name: a float is taken as seconds, a whole number as steps. */
MEPUBLIC void MEAPI MdtWorldSetAutoDisableAliveWindow(const MdtWorldID w, const int aliveWindow);
#ifdef __cplusplus
ME_END_C
inline void MdtWorldSetAutoDisableAliveWindow(MdtWorldID w, float seconds) {
    MdtWorldSetAutoDisableAliveTime(w, (MeReal)seconds);
}
inline void MdtWorldSetAutoDisableAliveWindow(MdtWorldID w, double seconds) {
    MdtWorldSetAutoDisableAliveTime(w, (MeReal)seconds);
}
ME_BEGIN_C
#else
/* clang-format off */
#define MdtWorldSetAutoDisableAliveWindow(w, window)                                                                   \
    _Generic((window),                                                                                                 \
        float: MdtWorldSetAutoDisableAliveTime,                                                                        \
        double: MdtWorldSetAutoDisableAliveTime,                                                                       \
        default: (MdtWorldSetAutoDisableAliveWindow))((w), (window))
/* clang-format on */
#endif
/** @} */

/** @name Safe time: the shortest part of a step that MdtWorldStepSafeTime takes, s, > 0. Default 0.001 s.
 *  @{ */
MEPUBLIC void MEAPI MdtWorldSetMinSafeTime(const MdtWorldID w, const MeReal t);
MEPUBLIC MeReal MEAPI MdtWorldGetMinSafeTime(const MdtWorldID w);
/** @} */

/** @name Counting
 *  @{ */
MEPUBLIC int MEAPI MdtWorldGetMaxBodies(const MdtWorldID w);      /**< Or MeNoLimit. */
MEPUBLIC int MEAPI MdtWorldGetMaxConstraints(const MdtWorldID w); /**< The same. */
MEPUBLIC int MEAPI MdtWorldGetTotalBodies(const MdtWorldID w);
MEPUBLIC int MEAPI MdtWorldGetTotalConstraints(const MdtWorldID w);
MEPUBLIC int MEAPI MdtWorldGetEnabledBodies(const MdtWorldID w);
MEPUBLIC int MEAPI MdtWorldGetEnabledConstraints(const MdtWorldID w);
/** @} */

/** Calls @a cb for every constraint of the world, in the order of sort keys and creation; it may destroy them
 *  (docs/simulation.md, "Callbacks"). */
MEPUBLIC void MEAPI MdtWorldForAllConstraints(const MdtWorldID w, MdtConstraintIteratorCBPtr cb, void *ccbdata);

/** Zeroes the forces, torques and impulses that wait for all the world's bodies. */
MEPUBLIC void MEAPI MdtWorldResetForces(const MdtWorldID w);

/** The world's density of 1 massScale per lengthScale cubed, kg/m³. */
MEPUBLIC MeReal MEAPI MdtWorldGetDefaultDensity(const MdtWorldID w);

/**
 * Into how many equal parts a step divides itself, 1..1000, by default 1. Collision is not asked in between, loads and
 * contacts stay; epsilon and gamma keep their meaning for the whole step. Errors fall with the square of the number.
 */
MEPUBLIC void MEAPI MdtWorldSetSubSteps(const MdtWorldID w, const int n);
MEPUBLIC int MEAPI MdtWorldGetSubSteps(const MdtWorldID w);

/**
 * The order of the integration scheme, 2 (default) or 4: by which power of the step's length errors fall. Order 4 is
 * for partitions of joints only, and costs two to eight times as much: each sub-step is composed of ten of order 2, two
 * of them back in time. A pendulum at 60 Hz is a hundred thousand times as exact (docs/solver.md, "Order 4").
 *
 * Such partitions have no contacts; their joints no motors, no strengths, no stops within reach, no springs that are
 * damped or too stiff to be followed, no attachments that move by a velocity of their own; their bodies no damping and
 * their Coriolis term. All others are of order 2, in whole or from the stage on where a stop comes within reach;
 * MdtReport tells (`composed`). Forces of the program are constant within a step, so they should not depend on the
 * state. In these partitions epsilon is taken for 0. Another order: a warning, and nothing is changed. Beyond Karma.
 */
MEPUBLIC void MEAPI MdtWorldSetIntegratorOrder(const MdtWorldID w, const int order);
MEPUBLIC int MEAPI MdtWorldGetIntegratorOrder(const MdtWorldID w);

/**
 * Partitions of up to this many bodies that only touch, without joints, meet their contacts in time: bodies move with
 * their mean velocities, and a step is divided where bodies collide or come to stick. By default 8; 0: none. So do
 * those with joints where all that touches is round, as a car's wheels, without springs and stops; larger ones with
 * restitution of which no more bodies are held by touching contacts, or a quarter (of 64 bodies or more: none, unless
 * the restitution is 1); and joints between so many, when something bounces. Other partitions take each step at once,
 * right to first order, and never gain energy.
 */
MEPUBLIC void MEAPI MdtWorldSetTimedContacts(const MdtWorldID w, const int bodies);
MEPUBLIC int MEAPI MdtWorldGetTimedContacts(const MdtWorldID w);

/** Calls these when a body gets enabled and disabled, by the program, by rest or by being woken; null: nothing. The
 *  Simulation Toolkit freezes and unfreezes collision models so (User Guide ch. 5). What they may do:
 *  docs/simulation.md, "Callbacks". */
MEPUBLIC void MEAPI MdtWorldSetBodyHandlers(const MdtWorldID w, MdtBodyHandler enabled, MdtBodyHandler disabled);

/** @name The cap on the Newton iterations of a partition's step (Karma: pivoting iterations)
 *  0, the default: no cap; the work budget alone bounds the step. With a cap a step costs less and its forces are
 *  inexact: they keep their bounds, energy is not gained, contacts give way a little, and a warning says so. Each part
 *  that a step is divided into (MdtReport) takes at least one iteration.
 *  @{ */
MEPUBLIC void MEAPI MdtWorldSetMaxLCPIterations(const MdtWorldID w, const int mi);
MEPUBLIC int MEAPI MdtWorldGetMaxLCPIterations(const MdtWorldID w);
/** @} */

/** @name The budget of work: the largest cost of a partition in one step
 *
 *  In millions of multiplications, counted in factorizations and in visits of rows, so that it is the same on every
 *  machine, and the results with it. A million takes about a millisecond on one core of 2020. Sub-steps, halves of
 *  violent motion, events and impacts of a partition's step draw from one budget. If a step is taken in parts (safe
 *  times), each part has its share, at least a sixteenth.
 *
 *  Newton's method may use half of it, or three eighths if friction bounds do not settle. After that, the best answer
 *  so far is finished iteratively: up to eight passes of accelerated sweeps over the rows (projected Gauss-Seidel),
 *  each with a direct solve of the joint rows that have no bounds. Such an answer keeps momentum and bounds, and
 *  energy does not grow beyond what loads, springs and motors give. Contacts and stops give way by the rest of the
 *  error, mostly 1e-4 m/s, which later steps remove (gamma). Joints stay closed and contacts hold: where an answer
 *  would open joints by a twentieth of a body, or leave contacts half of what a body gains by falling in the step, the
 *  fast solver takes the rest of the step (MdtWorldSetSolver). Partitions of 3000 rows or more get only a few sweeps in
 *  each pass; they want a larger budget. MdtReport tells (`way`, `limited`, `fallbacks`, `residualVelocity`).
 *
 *  The making of the rows, a few visits of each, and one such answer for each part are done in any case.
 *
 *  Default 400; the exact steps that MdtSolverAuto takes draw from accounts that are shares of it. The first
 *  step of a tower of 100 layers of three planks, solved exactly (MdtWorldSetSolver), takes 38. The hard
 *  cases in docs/lab/accuracy.md take 17 at most (100 links with 1e5 kg), one Newton iteration of 30 boxes in a heap
 *  0.1. 0: no bound, and accounts as by default. Beyond Karma.
 *  @{ */
MEPUBLIC void MEAPI MdtWorldSetWorkBudget(const MdtWorldID w, const MeReal work);
MEPUBLIC MeReal MEAPI MdtWorldGetWorkBudget(const MdtWorldID w);
/** @} */

/** @name The choice of solver: exact or fast
 *
 *  Exact: Newton's method, to the tolerances that docs/lab/accuracy.md states. Fast: an iterative method in single
 *  precision that visits contacts in passes, more of them the higher a pile is and the more masses differ. It leaves
 *  small velocities at contacts (MdtReport, `residualVelocity`, `excess`), by which bodies sink and creep a little
 *  until they rest.
 *
 *  MdtSolverAuto, the default, takes the exact one where that costs no more than the fast one, or where the world's
 *  accounts of exact work pay it: for partitions of which the exact one has taken the last step as long as that is
 *  little, and for those of which the fast answer does not meet the accuracy (MdtWorldSetAccuracy), in which nothing
 *  touches or bodies bounce, and that have just been made, for more. docs/solver.md, "Crowds", has the table;
 *  MdtReport.why tells which row held.
 *
 *  Whatever is chosen, partitions with constraints whose rows the program makes, with more rows than the cap, and, with
 *  MdtSolverFast, without contacts, are solved exactly. With MdtSolverAuto partitions of more bodies than
 *  MdtWorldSetTimedContacts that touch nothing fixed are the fast solver's.
 *  Beyond Karma.
 *  @{ */
typedef enum MdtSolver {
    MdtSolverAuto,
    MdtSolverExact,
    MdtSolverFast,
} MdtSolver;
/** Anything else: a warning, and nothing is changed. */
MEPUBLIC void MEAPI MdtWorldSetSolver(const MdtWorldID w, const MdtSolver solver);
MEPUBLIC MdtSolver MEAPI MdtWorldGetSolver(const MdtWorldID w);
/** The solver for a partition of these bodies, which are in the order of simulation. */
typedef MdtSolver(MEAPI *MdtSolverCB)(MdtBodyID const bodies[], int numBodies, void *data);
/** Asks @a cb, with @a data, for the solver of each partition that is awake, in place of MdtWorldSetSolver: in every
 *  step, each sub-step, and MdtWorldStepRest, on the calling thread, before any of them is simulated, in the order of
 *  MdtBodyGetPartition. What it creates, enables or destroys waits until the step is done (docs/simulation.md,
 *  "Callbacks"); its answer may depend on nothing but what it reads of the bodies. What rests, and is to have
 *  another solver than in the last step, is solved again. An answer that is none of the three is MdtSolverAuto, with a
 *  warning for the first one. Null, the default: one choice for all. */
MEPUBLIC void MEAPI MdtWorldSetSolverCB(const MdtWorldID w, MdtSolverCB cb, void *data);
/** @} */

/** @name Threads
 *  A world is stepped by the calling thread and, if there is more than one worker, by others beside it; in a universe
 *  they also test pairs (docs/threads.md). One worker, the calling thread, is the default. The results have the same
 *  bits with any number of workers.
 *
 *  Functions of the program are called by the calling thread only, one after the other, with two exceptions: memory
 *  functions (MeMemory.h) may be called by several workers at once, and a fatal error is handled by the thread in which
 *  it happens. Messages of workers are given when the partitions are done, in the partitions' order.
 *
 *  A world with constraints whose rows the program makes (MdtUserConstraint.h), with an importance callback or a
 *  partition callback is stepped by the calling thread. docs/threads.md has an example of callbacks. Beyond Karma.
 *  @{ */
/**
 * Tasks go to the program's job system.
 * @param workerCount 1 .. MeTaskMaxWorkers: how many threads work at once, the calling one included; with 1 there are
 *        no tasks any more
 * @param enqueue, finish as MeTask.h says; null only for one worker. They are called on the calling thread. What they
 *        may do: docs/simulation.md, "Callbacks"
 * @param userContext handed to both
 * Bad numbers and null functions warn, and nothing is changed; so does a call in the middle of a step.
 */
MEPUBLIC void MEAPI MdtWorldSetTaskCallbacks(const MdtWorldID w, const int workerCount, const MeEnqueueTaskCB enqueue,
                                             const MeFinishTaskCB finish, void *const userContext);
/** Tasks go to a pool, which lives longer than the world or until another call; worlds may share it. Null: one worker
 *  again. In the middle of a step: a warning, and nothing is changed. */
MEPUBLIC void MEAPI MdtWorldSetTaskPool(const MdtWorldID w, const MeTaskPoolID pool);
MEPUBLIC int MEAPI MdtWorldGetWorkerCount(const MdtWorldID w);
/** s, that a worker, 0 .. MdtWorldGetWorkerCount - 1, has spent on tasks since the workers were set; 0 of a world with
 *  one. Another number warns, and is 0. */
MEPUBLIC MeReal MEAPI MdtWorldGetWorkerTime(const MdtWorldID w, const int worker);
/** @} */

/** @name The accuracy of the fast solver
 *  The error of the velocity at a contact that is borne where bodies of equal mass rest on each other, m/s; less under
 *  the load of others, and under heavier bodies, and more while velocities change (docs/solver.md, "Crowds"). While
 *  contacts have more in the mean, the solver takes more passes, up to six times as many; where one has more, the exact
 *  solver takes the step, if it may. 0: the automatic choice takes the exact solver. Negative, the default: 1e-4 of the
 *  velocity that gravity gives in a step, and of partitions with joints 1e-2 of it; without gravity of a tenth of the
 *  length scale in a second. Bodies that are slower than 1e-3 of that velocity, and than a tenth of an accuracy that is
 *  set, count as resting. Beyond Karma.
 *  @{ */
MEPUBLIC void MEAPI MdtWorldSetAccuracy(const MdtWorldID w, const MeReal velocity);
/** As it was set, or what the last step's length makes of the default where there are no joints. */
MEPUBLIC MeReal MEAPI MdtWorldGetAccuracy(const MdtWorldID w);
/** @} */

/** @name The cap on a partition's rows (Dynamics guide ch. 4, "Limiting the Matrix Size")
 *  If a partition has more rows than @a size (positive; default INT_MAX), rows of contacts are left out of the step:
 *  first friction rows, then contacts between bodies, then contacts with the world, each from the shallowest to the
 *  deepest. Joints keep their rows, and every contact group keeps one contact, so there may still be more than @a size.
 *  @{ */
MEPUBLIC void MEAPI MdtWorldSetMaxMatrixSize(const MdtWorldID w, const int size);
MEPUBLIC int MEAPI MdtWorldGetMaxMatrixSize(const MdtWorldID w);
/** The importance that @a cb returns takes the place of depth, and of the distinction between bodies and world. Null
 *  brings the default back. It may not move bodies; what it creates or destroys waits (docs/simulation.md,
 *  "Callbacks"). */
MEPUBLIC void MEAPI MdtWorldSetContactImportanceCB(const MdtWorldID w, MdtContactImportanceCBPtr cb);
/** Every step writes the rows of partition i to @a sizeLog[i], for the first @a logSize partitions, and 0 behind the
 *  last. The array is the program's and must live until the log is set anew; null, or a size of 0, ends it. */
MEPUBLIC void MEAPI MdtWorldSetMatrixSizeLog(const MdtWorldID w, int *const sizeLog, const int logSize);
/** @} */

/** @name Joints that break (MdtConstraintSetBreakLimits)
 *  @{ */
/** Those that broke in the last step, by sort keys, then creation; null in the place of one that was destroyed since.
 *  The array is the world's, and valid until the next step. @a count gets how many there are. */
MEPUBLIC const MdtConstraintID *MEAPI MdtWorldGetBrokenJoints(const MdtWorldID w, int *count);
/** Called for each of them at the end of the step, in that order, and may do anything but step or end the world
 *  (docs/simulation.md, "Callbacks"); null, the default: nothing. */
MEPUBLIC void MEAPI MdtWorldSetBreakCB(const MdtWorldID w, MdtBreakCBPtr cb);
/** @} */

/**
 * What each step draws when it ends, by MeDebugDrawAPI (MeDebugDraw.h); a viewer's context shows it until the next
 * tick. A sum of options; 0, the default: nothing. Other values get a warning and change nothing.
 */
MEPUBLIC void MEAPI MdtWorldSetDebugDrawing(const MdtWorldID w, const MdtDebugDrawOptions drawOptions);

ME_END_C

#endif
