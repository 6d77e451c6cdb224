/* Inside Mdt: bodies and joints, their part in a step, and calls that are deferred to the end of a stage. */
#ifndef MDT_RECORD_I_H
#define MDT_RECORD_I_H

#include "base/mdt_world_i.h"

/* ---- bodies ---- */

void mdt_bodyShow(MdtBodyID b); /* updates the public transforms and velocities from the state in kea */
/* The difference, m, between a world point in the body's state in double and in its public transform, which is rounded,
 * for a point that is fixed in the body. */
void mdt_bodyRoundingOffset(const MdtBody *b, const double point[3], double lost[3]);
void mdt_bodyVelocity(const MdtBody *b, MdtKeaVelocity *v); /* angular: `spin`, as last shown */
void mdt_bodyAcceptVelocities(MdtBodyID b); /* applies velocities that the program has written through pointers */
void mdt_bodyClampPosition(MdtBodyID b);    /* clamps the position to its bound and stops the body there */
void mdt_bodyCapSpeeds(MdtBodyID b);        /* scales its shown velocities down to its largest speeds */
void mdt_bodyLockRotations(MdtBodyID b);    /* until mdt_bodyApplyLocks: the body stops turning */
void mdt_bodyApplyLocks(MdtBodyID b);       /* after its locked axes were set, or it became or ceased to be a mover */
/* Sets the inertia between two free rotations to that of the attitude in so many seconds; the momentum stays. */
void mdt_bodyTurnInertia(MdtBodyID b, double time);
/* Reduces a tensor in the body's axes to that between free rotations, in world axes, at the attitude q (mdt_lock.c). */
void mdt_lockInertia(int rotations, const double q[4], double inertia[3][3]);
void mdt_bodyEnable(MdtBodyID b); /* MdtBodyEnable and MdtBodyDisable, but never deferred */
void mdt_bodyDisable(MdtBodyID b);
void mdt_bodyAge(MdtBodyID b, double h); /* adds a step of h seconds to its times */
MeBool mdt_bodyIsFast(const MdtBody *b); /* a velocity is at or above the world's sleep threshold */
/* Passes the loads of this step to kea and clears the accumulators. frame: s, the time of the program's frame, of which
 * this step is a part. Impulses are added to the momenta, unless there are joints: then mdt_islandKick applies them. */
void mdt_bodyPack(MdtBodyID b, double frame, MeBool hasJoints);
/* Stores the body's present state as the start of its step. */
void mdt_bodySaveStart(MdtBodyID b);
void mdt_bodyTerm(MdtBodyID b); /* detaches its constraints and frees the record */
/* The pose of the centre of mass when the body's frame is at p with the attitude q. */
void mdt_bodyCentrePose(const MdtBody *b, const double p[3], const double q[4], MdtPose *pose);
/* Ends what the body remembers of earlier steps. */
void mdt_bodyRestart(MdtBodyID b);

/* ---- movers (mdt_mover.c) ---- */

/* Moves all movers by the motion of the step, which MdtWorldBeginMovers has set. */
void mdt_moversEnd(MdtWorldID w, double h);

/* ---- bodies that stay near a pose (mdt_stay.c) ---- */

/* Restarts the observation: the program has moved the body. */
void mdt_stayRestart(MdtBodyID b);
/* Updates the observation after a step of h seconds. */
void mdt_stayUpdate(MdtBodyID b, double h);
/* True if the body has stayed near its place for a second, including small oscillations. */
MeBool mdt_bodyStaysInPlace(const MdtBody *b);
/* True if the body, with its present motion, would hardly move in the next second. */
MeBool mdt_bodyIsQuiet(const MdtBody *b);
/* True if a change of momentum, N s and N m s, that acts in h seconds would move the body visibly. */
MeBool mdt_bodyWouldMove(const MdtBody *b, double push[2][3], double h);

/* ---- forces in successive steps (mdt_force.c) ---- */

/* The forces of the program on a body: for reading; for writing, allocated if needed: null, after a fatal error, if
 * there is no memory. */
static inline const MdtForces *mdt_forcesOf(const MdtBody *b) {
    return b->forces ? b->forces : &mdt_noForces;
}
MdtForces *mdt_forcesMake(MdtBodyID b, const char *caller);
void mdt_forcesFree(MdtBodyID b);                              /* sets `forces` to null */
void mdt_bodyMomenta(const MdtBody *b, double momentum[2][3]); /* kg m/s, kg m²/s */
/* At the start of a frame: if the program has applied a force in the last frame and in this one, adds the correction to
 * the body's kick. */
void mdt_forceBegin(MdtBodyID b);
/* Passes the forces of a frame, of `frame` seconds, to kea and clears the accumulators. */
void mdt_forceApply(MdtBodyID b, double frame);
/* Makes the forces of the step's start act in a further part of the step as well. */
void mdt_forceContinue(MdtBodyID b);
/* Restarts the history of forces: the program has moved or changed the body. */
void mdt_forceRestart(MdtBodyID b);

/* ---- constraints ---- */

/* Marks that the program has a pointer to the constraint's parameters, and may write them without a setter. */
void mdt_constraintMarkWatched(MdtConstraintID c);

/* Count one more, and one less, of the world's constraints (joints, groups, contacts). False, with a warning that names
 * the caller, if the world is full. */
MeBool mdt_constraintCount(MdtWorldID w, const char *caller);
void mdt_constraintUncount(MdtWorldID w);

/* Creates a joint of a type, with its defaults, for the API function `caller`. Null, with a warning, if the world is
 * full. */
MdtJoint *mdt_jointCreate(MdtWorldID w, MdtBclJointType type, const char *caller);
/* The joint if it is live and of the type; else null, with a warning. */
MdtJoint *mdt_jointOfType(void *handle, MdtBclJointType type, const char *caller);
/* Removes a joint that is destroyed from the count of no-collide joints (mdt_no_collide.c). */
void mdt_noCollideForget(MdtJoint *j);
/* The constraint as a joint of the type, for MdtConstraintDCast*; null, without a warning, if it has another type. */
void *mdt_jointCast(MdtConstraintID c, MdtBclJointType type, const char *caller);
/* The type of a constraint: contact for a point and for the manifold of a single contact, group for other manifolds. */
MdtBclJointType mdt_constraintType(const MdtBaseConstraint *c);
static inline const char *mdt_constraintName(const MdtBaseConstraint *c) {
    return MdtBclTypeOf(mdt_constraintType(c))->name;
}
/* True for a body index of 0 or 1; otherwise warns. */
MeBool mdt_isSide(const char *caller, unsigned int bodyindex);
/* Makes p unit and o unit and orthogonal to p. False, with a warning, when a length or the angle between them is 0. */
MeBool mdt_makeAxes(const char *caller, double p[3], double o[3]);
/* Sets the axis of one side of a joint with two axes at right angles: the primary axis of side 0, the second axis of
 * side 1. Updates the other axes of both frames in the bodies' present poses. */
void mdt_constraintSetCrossAxis(MdtConstraintID c, const char *caller, int side, MeReal x, MeReal y, MeReal z);
/* A vector at right angles to p. */
void mdt_chooseOrthogonal(const double p[3], double o[3]);
void mdt_constraintAttach(MdtConstraintID c, MdtBodyID b0, MdtBodyID b1);
void mdt_constraintDetach(MdtConstraintID c, int side);
/* Detaches a constraint and removes it from the world's list; the caller has to free the record. */
void mdt_constraintTerm(MdtConstraintID c);
/* Disable a joint or a manifold; destroy a joint, a group or a contact. Never deferred. */
void mdt_constraintDeactivate(MdtConstraintID c);
void mdt_constraintRemove(MdtConstraintID c);
/* The poses of both sides' frames: of the body's centre of mass, or the world's. */
void mdt_constraintPoses(MdtConstraintID c, MdtKeaTransformation pose[2]);
/* Transforms an attachment into the new frame of the body's centre of mass; it stays where it is in the world. */
void mdt_constraintReframe(MdtConstraintID c, int side, const MdtKeaBody *before, const MdtKeaBody *after);
/* Clears the warm start: the next step does not begin with the last forces. */
void mdt_constraintClearWarmStart(MdtConstraintID c);
/* Sets the force and torque that are read back as those of the last step. */
void mdt_constraintSetForce(MdtConstraintID c, const MdtKeaForcePair *force);
void mdt_jointFree(MdtJoint *j); /* frees memory that is not part of its record */

/* The public handle of a record: of a manifold with a single contact, that contact. Iteration follows the order of
 * simulation, with a group before its contacts; null after the last. */
MdtConstraintID mdt_constraintPublicHandle(MdtConstraintID c);
MdtConstraintID mdt_constraintNext(MdtConstraintID c);
/* Calls `cb` for a joint, a contact, or a group and its contacts. */
void mdt_constraintVisit(MdtConstraintID base, MdtConstraintIteratorCBPtr cb, void *data);
/* The next constraint that is attached to the body. */
MdtConstraintID mdt_constraintNextOfBody(MdtBodyID b, MdtConstraintID c);

/* A problem flag if the friction of these parameters cannot act, or is unbounded without being set so; 0: none.
 * mdt_surfaceWarn warns of a set of such problems, each once per world. */
int mdt_surfaceProblem(const MdtBclContactParams *params);
void mdt_surfaceWarn(MdtWorldID w, int problems);

/* Resets a limit and copies the public properties of another, which may be itself. */
void mdt_limitAssign(MdtLimitID to, const MdtBclLimit *from);

/* ---- common omissions of programs (mdt_forgotten.c) ---- */

/* At the start of a step of h seconds: warns of running motors on joints that were never enabled, and of centres of
 * mass that were not set. */
void mdt_forgottenCheck(MdtWorldID w, double h);
/* Warns that a body which has contacts is too heavy for the world's epsilon. */
void mdt_forgottenScale(MdtBodyID b);

/* ---- joints that break (mdt_break.c) ---- */

/* At the start of a step; at its end or that of a part; when a joint is destroyed. */
void mdt_breakBegin(MdtWorldID w);
void mdt_breakEnd(MdtWorldID w);
void mdt_breakForget(MdtJoint *j);

/* ---- mimics (mdt_mimic.c) ---- */

/* At the start of a step: copies the frames of the mimicked joints, and finds out whether both act. Returns whether the
 * mimic has a split row. */
MeBool mdt_mimicUpdate(MdtJoint *mimic);
/* The two bodies to which a mimic is attached: one of each joint that the program does not move, if there is. */
void mdt_mimicFindBodies(MdtJoint *const source[2], MdtBodyID bodies[2]);
/* When a joint is destroyed: mimics of it have it no more. */
void mdt_mimicForget(MdtJoint *j);

/* ---- stages (mdt_stage.c) ------------------------------------------------------------------------------------- */

/* Levels of guards: the data that must not change while a stage calls the program (MeInternal.h). Each level includes
 * the levels before it. */
enum {
    MDT_GUARD_WORLD = 0,               /* the world itself */
    MDT_GUARD_BODIES = MDT_BODY_GUARD, /* records of bodies: while pairs of models are processed */
    MDT_GUARD_CONSTRAINTS,             /* records of constraints, their bodies and their order: while lists
                                        are iterated */
    MDT_GUARD_GRAPH, /* which objects are enabled: while partitions are in use, or a body's handler runs */
    MDT_GUARD_STATES /* poses, velocities, masses, options of joints: while partitions are solved */
};
/* MeStageWhen for a level; also puts the call `later` into the world's list if it has to wait for the stage's end. */
MeWhen mdt_deferIfGuarded(MdtWorldID w, int level, const char *caller, const MeLater *later);
/* True if the body's state may be changed; otherwise a message that names the caller: its partition is being solved. */
MeBool mdt_mayChangeState(const MdtBody *b, const char *caller);
/* Destroys a body now, or when the stage of the world, or of its models, ends that guards it. */
void mdt_bodyDestroy(MdtBodyID b, const char *caller);
/* The object of a deferred call; null if it has been destroyed meanwhile, even if its record is in use again. */
MdtBodyID mdt_deferredBody(const MeLater *later);
MdtConstraintID mdt_deferredConstraint(const MeLater *later);

/* Returns from an API function that changes a body, with a warning or message, unless the body may be changed now. */
#define MDT_CHANGE_BODY(b)                                                                                             \
    do {                                                                                                               \
        if (!mdt_isBody((b), __func__) || !mdt_mayChangeState((b), __func__))                                          \
            return;                                                                                                    \
    } while (0)

#endif
