/** @file MdtWorld.h
 *  Worlds: creating them, their parameters, stepping (Dynamics guide ch. 2, 4 and 5).
 *
 *  A new world has no gravity: call MdtWorldSetGravity. Bodies take part in steps after MdtBodyEnable.
 *
 *  Worlds are independent of each other. One thread at a time may use a world and its objects; different threads may
 *  step different worlds. A null or destroyed world gets a warning and a neutral result everywhere. A number that is
 *  not finite, or out of its range, gets a warning and changes nothing.
 */
#ifndef MDTWORLD_H
#define MDTWORLD_H

#include "MdtTypes.h"
#include "MeTask.h"

ME_BEGIN_C

/**
 * Creates a world with room for @a maxBodies bodies and @a maxConstraints joints and contacts.
 *
 * @a lengthScale [m] and @a massScale [kg] are size and mass of a typical object: the defaults of bodies and the
 * thresholds of sleep scale with them, and epsilon with 1/massScale: 0.0001 for 1 kg, as in the Dynamics guide. (A
 * universe's world is stiffer: MstUniverseCreate.) Both forms of the guides compile: MdtWorldCreate(maxBodies,
 * maxConstraints), with scales of 1, and the form with all four arguments. Scales that are not positive and finite get
 * a warning and count as 1.
 *
 * Returns the world, or null when there is no memory. Destroy it with MdtWorldDestroy. All memory for bodies and
 * constraints is allocated here, through MeMemoryAPI, except 0.6 kB by the first force or impulse on a body. With
 * MeNoLimit nothing is allocated at first, and the world grows when it is full; handles and pointers stay valid, and
 * results are the same. Dynamics guide ch. 2, "Initializing the World".
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

/** Destroys a world with all its bodies and constraints, whose handles become invalid. Dynamics guide ch. 2. */
MEPUBLIC void MEAPI MdtWorldDestroy(const MdtWorldID w);
/** Destroys all bodies and constraints of a world, but keeps its parameters and callbacks. Not allowed in callbacks of
 *  a step. */
MEPUBLIC void MEAPI MdtWorldReset(const MdtWorldID w);
/** MdtWorldReset, which also resets gravity, epsilon, gamma, the cap on rows, the minimum safe time and auto-disabling
 *  to those of a new world with the same length and mass scales. Not allowed in callbacks of a step. */
MEPUBLIC void MEAPI MdtWorldReCreate(const MdtWorldID w);
/** The largest size of scratch memory, in bytes, that a step of the world has used. */
MEPUBLIC int MEAPI MdtWorldGetMaxMemoryPoolUsed(const MdtWorldID w);

/**
 * Advances the world by @a stepSize seconds: finds its partitions, puts partitions at rest to sleep, computes the
 * forces of constraints (Kea) and the new velocities and positions. On return bodies, transforms, forces and limit
 * positions are those of the new time, and the force and torque accumulators of simulated bodies are zero. The step
 * size may differ from call to call. A step size that is not positive and finite gets a warning, and nothing moves.
 * Dynamics guide ch. 2, "Stepping Through Time".
 */
MEPUBLIC void MEAPI MdtWorldStep(const MdtWorldID w, const MeReal stepSize);

/**
 * Like MdtWorldStep, but advances each partition only by the shortest safe time of its bodies (MdtBodySetSafeTime), at
 * least by MdtWorldGetMinSafeTime and at most by @a stepSize.
 */
MEPUBLIC void MEAPI MdtWorldStepSafeTime(const MdtWorldID w, const MeReal stepSize);
/**
 * Advances the partitions that MdtWorldStepSafeTime has left behind by the lag of their bodies (MdtBodyGetLag), but at
 * most by the shortest of their safe times, which may be 0. Forces that were added for the step act in its rest as
 * well. A partition with an awake body that has no lag is not advanced; bodies that a partition wakes get its lag.
 * This function puts nothing to sleep, calls no partition callback, and does not change the report. Lag that is left
 * when the next step begins is lost. Returns the number of partitions that it advanced. Beyond Karma.
 */
MEPUBLIC int MEAPI MdtWorldStepRest(const MdtWorldID w);
/** The number of bodies with a lag. Beyond Karma. */
MEPUBLIC int MEAPI MdtWorldGetLaggingBodies(const MdtWorldID w);

/**
 * Gravity, m/s², world frame. Default 0. A change wakes sleeping bodies. Check builds warn once if this was never
 * called, and nothing acts on the world's bodies in a second of steps: no velocity, force, impulse or constraint.
 */
MEPUBLIC void MEAPI MdtWorldSetGravity(const MdtWorldID w, const MeReal gx, const MeReal gy, const MeReal gz);
/** m/s²; 0 by default. */
MEPUBLIC void MEAPI MdtWorldGetGravity(const MdtWorldID w, MeVector3 g);

/** @name Epsilon and gamma (Dynamics guide ch. 5, "The Meaning of Epsilon and Gamma")
 *  Epsilon [1/kg], >= 0: the compliance (CFM) of joints, and of contacts along their normals; 0 is rigid. Under a load
 *  F they give way by epsilon F h² / gamma, h the step: by 1.4 mm per tonne at 60 Hz and the defaults. A warning is
 *  given once if bodies sink into contacts by a fiftieth of the length scale. Angular constraints have the compliance
 *  epsilon / lengthScale², as if the load acted at a lever arm of the length scale. Default 0.0001 / massScale; a
 *  universe sets its own (MstUniverseCreate). A value that a program sets is absolute, whatever massScale is.
 *
 *  Friction, motors and brakes have no epsilon. They act on velocities, so compliance would be viscosity: bodies that
 *  friction can hold would creep. For surfaces that yield, set slip (MdtContactParamsSetPrimarySlip).
 *
 *  Gamma, 0..1: the fraction of a constraint's error that one step removes (ERP). Default 0.2. In large contact islands
 *  (docs/solver.md, "Crowds") overlaps of few contacts are removed faster, by up to 1 - (1 - gamma)^4.4 per step.
 *  @{ */
/** 1/kg. A number that is negative or not finite gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtWorldSetEpsilon(const MdtWorldID w, const MeReal e);
/** 1/kg; 0.0001 / massScale by default, less in a universe. */
MEPUBLIC MeReal MEAPI MdtWorldGetEpsilon(const MdtWorldID w);
/** Outside of 0..1: a warning, and nothing is changed. 0 corrects no errors. */
MEPUBLIC void MEAPI MdtWorldSetGamma(const MdtWorldID w, const MeReal g);
/** 0.2 by default. */
MEPUBLIC MeReal MEAPI MdtWorldGetGamma(const MdtWorldID w);
/** Sets gamma for steps of @a aTimeStep so that errors decay in the same time as with @a aGamma at @a aRefStep:
 *  1 - (1 - aGamma)^(aTimeStep / aRefStep), since T / h steps leave (1 - gamma)^(T / h) of an error after the time T.
 *  Times are in seconds, positive. Call it again when the step size changes. */
MEPUBLIC void MEAPI MdtWorldSetGammaWithRefTimeStep(const MdtWorldID w, const MeReal aGamma, const MeReal aRefStep,
                                                    const MeReal aTimeStep);
/** @} */

/** @name Putting bodies to sleep (Dynamics guide ch. 4, "Enabling/Disabling Bodies")
 *  A partition is disabled ("falls asleep") when all its bodies have been enabled for the alive window, are below the
 *  thresholds, and would not move noticeably within the next second (five alive times). The thresholds are for the
 *  squares of velocity, angular velocity, acceleration and angular acceleration. Bodies that only jitter in place may
 *  fall asleep at any acceleration. docs/simulation.md, "Sleep", has the rule, and what wakes them. On by default.
 *
 *  A partition stays enabled while a motor drives one of its joints, at any speed; while its attachment to the world
 *  moves; and while a contact with a moving surface pushes one of its bodies (MdtContactParamsSetPrimarySlide,
 *  MdtConstraintSetWorldLinearVelocity).
 *
 *  The thresholds are squares, >= 0. Initially they are the values of MdtDefaults.h, those of velocity and
 *  acceleration times the square of the length scale. That of acceleration is limited to a tenth of gravity.
 *  MdtWorldSetGravity adapts these two until the program sets them. After the program has set one, the thresholds
 *  alone decide. They are for seconds: a program with another unit of time sets all of them, and the alive time. A
 *  negative threshold gets a warning and changes nothing.
 *  @{ */
/** METRUE, the default: bodies at rest fall asleep. MEFALSE: none does any more; those that sleep stay asleep. */
MEPUBLIC void MEAPI MdtWorldSetAutoDisable(const MdtWorldID w, const MeBool d);
/** METRUE by default. */
MEPUBLIC MeBool MEAPI MdtWorldGetAutoDisable(const MdtWorldID w);
/** m²/s². Default 0.02 lengthScale². */
MEPUBLIC void MEAPI MdtWorldSetAutoDisableVelocityThreshold(const MdtWorldID w, const MeReal vt);
/** m²/s². */
MEPUBLIC MeReal MEAPI MdtWorldGetAutoDisableVelocityThreshold(const MdtWorldID w);
/** rad²/s². Default 0.001. */
MEPUBLIC void MEAPI MdtWorldSetAutoDisableAngularVelocityThreshold(const MdtWorldID w, const MeReal avt);
/** rad²/s². */
MEPUBLIC MeReal MEAPI MdtWorldGetAutoDisableAngularVelocityThreshold(const MdtWorldID w);
/** m²/s⁴. Default 0.5 lengthScale², at most the square of a tenth of gravity. */
MEPUBLIC void MEAPI MdtWorldSetAutoDisableAccelerationThreshold(const MdtWorldID w, const MeReal at);
/** m²/s⁴; before the program sets it, adapted by MdtWorldSetGravity. */
MEPUBLIC MeReal MEAPI MdtWorldGetAutoDisableAccelerationThreshold(const MdtWorldID w);
/** rad²/s⁴. Default 0.002. */
MEPUBLIC void MEAPI MdtWorldSetAutoDisableAngularAccelerationThreshold(const MdtWorldID w, const MeReal aat);
/** rad²/s⁴. */
MEPUBLIC MeReal MEAPI MdtWorldGetAutoDisableAngularAccelerationThreshold(const MdtWorldID w);
/** Alive time, s: how long a body stays enabled after it was enabled. Default 0.2 s. Replaces a window in steps. */
MEPUBLIC void MEAPI MdtWorldSetAutoDisableAliveTime(const MdtWorldID w, const MeReal aw);
/** The alive time, s; a window in steps is converted with the length of the last step (1/60 s before the first). */
MEPUBLIC MeReal MEAPI MdtWorldGetAutoDisableAliveTime(const MdtWorldID w);
/** The alive window in steps, rounded up; an alive time is converted with the length of the last step. */
MEPUBLIC int MEAPI MdtWorldGetAutoDisableAliveWindow(const MdtWorldID w);
/** Sets the alive window in steps, as in the Dynamics guide. Replaces an alive time. The User Guide passes seconds
 *  under this name: a floating-point argument is taken as seconds, an integer as steps. */
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

/** @name Minimum safe time: the shortest advance by MdtWorldStepSafeTime, s, > 0. Default 0.001 s.
 *  @{ */
/** A number that is not positive and finite gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtWorldSetMinSafeTime(const MdtWorldID w, const MeReal t);
/** s; 0.001 by default. */
MEPUBLIC MeReal MEAPI MdtWorldGetMinSafeTime(const MdtWorldID w);
/** @} */

/** @name Counting
 *  @{ */
MEPUBLIC int MEAPI MdtWorldGetMaxBodies(const MdtWorldID w);      /**< MeNoLimit: no limit. */
MEPUBLIC int MEAPI MdtWorldGetMaxConstraints(const MdtWorldID w); /**< MeNoLimit: no limit. */
/** All bodies: enabled, disabled and asleep. */
MEPUBLIC int MEAPI MdtWorldGetTotalBodies(const MdtWorldID w);
/** All joints, and all contacts and contact groups that a program or a bridge made. */
MEPUBLIC int MEAPI MdtWorldGetTotalConstraints(const MdtWorldID w);
/** Without those that sleep; a world at rest has 0. */
MEPUBLIC int MEAPI MdtWorldGetEnabledBodies(const MdtWorldID w);
/** Enabled joints, contact groups, and contacts outside of groups, those of sleeping bodies included. */
MEPUBLIC int MEAPI MdtWorldGetEnabledConstraints(const MdtWorldID w);
/** @} */

/** Calls @a cb for every constraint of the world, in the order of sort keys and creation; it may destroy constraints
 *  (docs/simulation.md, "Callbacks"). */
MEPUBLIC void MEAPI MdtWorldForAllConstraints(const MdtWorldID w, MdtConstraintIteratorCBPtr cb, void *ccbdata);

/** Clears the forces, torques and impulses that have been added to all bodies of the world. */
MEPUBLIC void MEAPI MdtWorldResetForces(const MdtWorldID w);

/** kg/m³: the density of 1 massScale per lengthScale cubed. */
MEPUBLIC MeReal MEAPI MdtWorldGetDefaultDensity(const MdtWorldID w);

/**
 * The number of equal sub-steps into which a step is divided, 1..1000, by default 1. Collision is not tested in
 * between; loads and contacts stay the same. Epsilon and gamma keep their meaning for the whole step. Errors decrease
 * with the square of the number.
 */
MEPUBLIC void MEAPI MdtWorldSetSubSteps(const MdtWorldID w, const int n);
/** 1 by default. */
MEPUBLIC int MEAPI MdtWorldGetSubSteps(const MdtWorldID w);

/**
 * The order of the integration scheme, 2 (default) or 4: the power of the step size with which errors decrease. Order 4
 * is for partitions of joints only, and costs two to eight times as much: each sub-step is composed of ten of order 2,
 * two of them backward in time. The error of a pendulum at 60 Hz is a hundred thousandth of that of order 2
 * (docs/solver.md, "Order 4").
 *
 * Such partitions have no contacts; their joints have no motors, no strengths, no stops within reach, no springs that
 * are damped or too stiff for the step, no attachments with a velocity of their own; their bodies have no damping, and
 * their Coriolis term is enabled. All other partitions are of order 2: for the whole step, or from the stage on in
 * which a stop comes within reach; MdtReport.composed counts compositions. Forces of the program are constant within a
 * step, so they should not depend on the state. Epsilon counts as 0 in these partitions. Another order gets a warning,
 * and nothing is changed. Beyond Karma.
 */
MEPUBLIC void MEAPI MdtWorldSetIntegratorOrder(const MdtWorldID w, const int order);
/** 2 by default. */
MEPUBLIC int MEAPI MdtWorldGetIntegratorOrder(const MdtWorldID w);

/**
 * Timed contacts: the largest number of bodies, by default 8, of partitions whose impacts are resolved at their time;
 * 0: none. In such partitions bodies move with their mean velocities, and a step is divided when bodies collide or
 * begin to stick. They are partitions
 *
 * - of up to this number of bodies with contacts only, or with joints, but without springs and stops, if all contacts
 *   are round, such as a car's wheels;
 * - with restitution, in which joints and touching contacts constrain at most this number of bodies, or a quarter of
 *   them (with 64 bodies or more: none, unless the restitution is 1); if there are joints, only without springs.
 *
 * In all others impacts are early or late by up to a step; energy is not gained.
 */
MEPUBLIC void MEAPI MdtWorldSetTimedContacts(const MdtWorldID w, const int bodies);
/** 8 by default. */
MEPUBLIC int MEAPI MdtWorldGetTimedContacts(const MdtWorldID w);

/** Sets the callbacks for bodies that are enabled or disabled: by the program, by falling asleep or by waking; null:
 *  none. A body that is destroyed while it is enabled counts as disabled, with a call in which MdtBodyIsValid is false;
 *  a disabled or sleeping one is destroyed without a call. A universe freezes and unfreezes collision models by
 *  handlers of its own (MstSetWorldHandlers, User Guide ch. 5), which are called before these. docs/simulation.md,
 *  "Callbacks", lists what they may do. */
MEPUBLIC void MEAPI MdtWorldSetBodyHandlers(const MdtWorldID w, MdtBodyHandler enabled, MdtBodyHandler disabled);

/** @name The cap on the Newton iterations of a partition's step (Karma: pivoting iterations)
 *  0, the default: no cap; only the work budget bounds the step. With a cap a step costs less and its forces are
 *  inexact: they keep their bounds, energy does not grow, contacts give way a little, and a warning is given. Each
 *  part into which a step is divided (MdtReport) gets at least one iteration.
 *  @{ */
/** A negative number gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtWorldSetMaxLCPIterations(const MdtWorldID w, const int mi);
/** 0, the default: no cap. */
MEPUBLIC int MEAPI MdtWorldGetMaxLCPIterations(const MdtWorldID w);
/** @} */

/** @name The work budget: the largest cost of a partition in one step
 *
 *  In millions of multiplications, counted in factorizations and in visits of rows. So the cost, and with it the
 *  result, is the same on every machine. A million takes some .3 ms on one core of a virtual AMD EPYC. Sub-steps,
 *  halves of violent motion, events and impacts of a partition's step draw from one budget. If safe times divide a
 *  step, each part has its share, at least a sixteenth.
 *
 *  Newton's method may use half of it, or three eighths if friction bounds do not settle. After that, the best answer
 *  so far is improved iteratively: up to eight passes of accelerated sweeps over the rows (projected Gauss-Seidel),
 *  each with a direct solve of the joint rows without bounds. Such an answer conserves momentum and keeps bounds, and
 *  energy does not grow beyond the work of loads, springs and motors. Contacts and stops give way by the remaining
 *  error, mostly 1e-4 m/s, which later steps remove (gamma). If the answer would open joints by a twentieth of a body,
 *  or leave contacts half of the velocity that gravity gives in the step, the fast solver solves the rest of the step
 *  (MdtWorldSetSolver). Partitions of 3000 rows or more get only a few sweeps in each pass; they need a larger budget.
 *  MdtReport has the results (`way`, `limited`, `fallbacks`, `residualVelocity`).
 *
 *  The budget does not limit making the rows, a few visits of each row, and one such answer for each part.
 *
 *  Default 400; the exact steps of MdtSolverAuto draw from accounts that are shares of it. The first step of a tower
 *  of 100 layers of three planks, solved exactly (MdtWorldSetSolver), takes 38. The hard cases in docs/lab/accuracy.md
 *  take 17 at most (100 links with 1e5 kg), one Newton iteration of 30 boxes in a heap 0.1. 0: unlimited, with
 *  accounts as by default. Beyond Karma.
 *  @{ */
/** Millions of multiplications. A negative number gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtWorldSetWorkBudget(const MdtWorldID w, const MeReal work);
/** Millions of multiplications; 400 by default. */
MEPUBLIC MeReal MEAPI MdtWorldGetWorkBudget(const MdtWorldID w);
/** @} */

/** @name The choice of solver: exact or fast
 *
 *  Exact: Newton's method, to the tolerances in docs/lab/accuracy.md. Fast: an iterative method in single precision
 *  that visits contacts in passes, more of them for higher piles and larger mass ratios. It leaves small velocities at
 *  contacts (MdtReport, `residualVelocity`, `excess`), by which bodies sink and creep a little until they rest.
 *
 *  MdtSolverAuto, the default, uses the exact solver if that costs no more than the fast one, or if the world's
 *  accounts of exact work pay for it: smaller amounts for partitions whose last step the exact solver solved; larger
 *  amounts for partitions whose fast answer misses the accuracy (MdtWorldSetAccuracy), which have no contacts or whose
 *  bodies bounce, or which are new. docs/solver.md, "Crowds", has the table; MdtReport.why names the row that applied.
 *
 *  Whatever is chosen, partitions with rows from callbacks, with more rows than the cap, and, with MdtSolverFast,
 *  without contacts, are solved exactly. With MdtSolverAuto the fast solver solves partitions of more bodies than
 *  MdtWorldSetTimedContacts without a contact with the world.
 *  Beyond Karma.
 *  @{ */
typedef enum MdtSolver {
    MdtSolverAuto,
    MdtSolverExact,
    MdtSolverFast,
} MdtSolver;
/** Another value gets a warning, and nothing is changed. */
MEPUBLIC void MEAPI MdtWorldSetSolver(const MdtWorldID w, const MdtSolver solver);
/** MdtSolverAuto by default. A callback of MdtWorldSetSolverCB has priority. */
MEPUBLIC MdtSolver MEAPI MdtWorldGetSolver(const MdtWorldID w);
/** Returns the solver for a partition, whose bodies are in the order of simulation. */
typedef MdtSolver(MEAPI *MdtSolverCB)(MdtBodyID const bodies[], int numBodies, void *data);
/** Calls @a cb, with @a data, for the solver of each awake partition, in place of the choice of MdtWorldSetSolver: in
 *  every step, and in MdtWorldStepRest, on the calling thread, before any of the partitions is simulated, in the order
 *  of MdtBodyGetPartition. Objects that it creates, enables or destroys are processed after the step
 *  (docs/simulation.md, "Callbacks"); its result must depend on data of the bodies only. A partition at rest is solved
 *  again if its solver differs from that of the last step. An invalid result counts as MdtSolverAuto, with a warning
 *  for the first one. Null, the default: one choice for all partitions. */
MEPUBLIC void MEAPI MdtWorldSetSolverCB(const MdtWorldID w, MdtSolverCB cb, void *data);
/** @} */

/** @name Threads
 *  A world is stepped by the calling thread and, with more than one worker, by further threads; in a universe these
 *  also test pairs (docs/threads.md). By default there is one worker, the calling thread. Results are the same bit for
 *  bit with any number of workers.
 *
 *  Callbacks of the program are called on the calling thread only, one at a time, with two exceptions: several workers
 *  may call memory functions (MeMemory.h) at once, and a fatal error is handled on the thread on which it occurs.
 *  Messages of workers are sent when all partitions are done, in the order of partitions.
 *
 *  A world with constraints whose rows a callback makes (MdtUserConstraint.h), with an importance callback or a
 *  partition callback, is stepped by the calling thread alone. docs/threads.md has an example of callbacks. Beyond
 *  Karma.
 *  @{ */
/**
 * Uses the program's job system for tasks.
 * @param workerCount 1 .. MeTaskMaxWorkers: the number of threads that work at once, with the calling one; with 1 there
 *        are no tasks
 * @param enqueue, finish callbacks as in MeTask.h, called on the calling thread; null only for one worker.
 *        docs/simulation.md, "Callbacks", lists what they may do
 * @param userContext passed to both
 * Invalid numbers and null functions get a warning, and nothing is changed; so does a call in the middle of a step.
 */
MEPUBLIC void MEAPI MdtWorldSetTaskCallbacks(const MdtWorldID w, const int workerCount, const MeEnqueueTaskCB enqueue,
                                             const MeFinishTaskCB finish, void *const userContext);
/** Uses a pool for tasks; the pool must live as long as the world, or until another call; several worlds may share it.
 *  Null: one worker. In the middle of a step: a warning, and nothing is changed. */
MEPUBLIC void MEAPI MdtWorldSetTaskPool(const MdtWorldID w, const MeTaskPoolID pool);
/** 1 by default: the calling thread. */
MEPUBLIC int MEAPI MdtWorldGetWorkerCount(const MdtWorldID w);
/** s: the time that a worker, 0 .. MdtWorldGetWorkerCount - 1, has spent on tasks since the workers were set; 0 if
 *  there is one worker. Another index gets a warning, and 0. */
MEPUBLIC MeReal MEAPI MdtWorldGetWorkerTime(const MdtWorldID w, const int worker);
/** @} */

/** @name The accuracy of the fast solver
 *  The largest velocity error of a contact between bodies of equal mass at rest, m/s; less for contacts that carry the
 *  load of others, and under heavier bodies; more while velocities change (docs/solver.md, "Crowds"). While the mean
 *  error is larger, the solver makes more passes, up to six times as many; if the error of a contact is larger, the
 *  exact solver redoes the step, as far as the accounts allow. 0: the automatic choice uses the exact solver.
 *  Negative, the default: 1e-4 of the velocity that gravity gives in a step, in partitions with joints 1e-2 of it;
 *  without gravity, of a tenth of the length scale per second. Bodies slower than 1e-3 of that velocity, or slower
 *  than a tenth of an accuracy that was set, count as resting. Beyond Karma.
 *  @{ */
/** m/s. A number that is not finite gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtWorldSetAccuracy(const MdtWorldID w, const MeReal velocity);
/** The value that was set, or else the default for the last step's length and partitions without joints. */
MEPUBLIC MeReal MEAPI MdtWorldGetAccuracy(const MdtWorldID w);
/** @} */

/** @name The cap on a partition's rows (Dynamics guide ch. 4, "Limiting the Matrix Size")
 *  If a partition has more rows than @a size (positive; default INT_MAX), rows of contacts are left out of the step:
 *  first friction rows, then contacts between bodies, then contacts with the world, each from the shallowest to the
 *  deepest. Joints keep their rows, and every contact group keeps one contact, so more than @a size rows may be left.
 *  @{ */
/** Rows. A number that is not positive gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtWorldSetMaxMatrixSize(const MdtWorldID w, const int size);
/** Rows; INT_MAX by default. */
MEPUBLIC int MEAPI MdtWorldGetMaxMatrixSize(const MdtWorldID w);
/** The importance that @a cb returns replaces depth, and the distinction between bodies and world. Null restores the
 *  default. It must not move bodies; objects that it creates or destroys are processed later (docs/simulation.md,
 *  "Callbacks"). */
MEPUBLIC void MEAPI MdtWorldSetContactImportanceCB(const MdtWorldID w, MdtContactImportanceCBPtr cb);
/** Every step writes the number of rows of partition i to @a sizeLog[i], for the first @a logSize partitions, and 0 to
 *  the remaining entries. The program owns the array, which must live until the log is set again; null, or a size of
 *  0, ends it. */
MEPUBLIC void MEAPI MdtWorldSetMatrixSizeLog(const MdtWorldID w, int *const sizeLog, const int logSize);
/** @} */

/** @name Joints that break (MdtConstraintSetBreakLimits)
 *  @{ */
/** The joints that broke in the last step, by sort keys, then creation; null for one that has been destroyed since. The
 *  world owns the array, which is valid until the next step. @a count receives their number. */
MEPUBLIC const MdtConstraintID *MEAPI MdtWorldGetBrokenJoints(const MdtWorldID w, int *count);
/** Sets the callback for joints that break: called for each of them at the end of the step, in the order of
 *  MdtWorldGetBrokenJoints. It may do anything but step or destroy the world (docs/simulation.md, "Callbacks"). Null,
 *  the default: none. */
MEPUBLIC void MEAPI MdtWorldSetBreakCB(const MdtWorldID w, MdtBreakCBPtr cb);
/** @} */

/** Sets what each step draws at its end by MeDebugDrawAPI (MeDebugDraw.h); a viewer's context shows it until the next
 *  tick. A sum of options; 0, the default: nothing. Other values get a warning and change nothing. */
MEPUBLIC void MEAPI MdtWorldSetDebugDrawing(const MdtWorldID w, const MdtDebugDrawOptions drawOptions);

ME_END_C

#endif
