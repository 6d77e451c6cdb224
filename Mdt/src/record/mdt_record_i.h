/* Inside Mdt: bodies and joints, what they do in a step, and what waits for the end of a stage. */
#ifndef MDT_RECORD_I_H
#define MDT_RECORD_I_H

#include "base/mdt_world_i.h"

/* ---- bodies ---- */

void mdt_bodyShow(MdtBodyID b); /* refreshes what programs see from the state in kea */
/* m: the offset between a world position found with the body's shown transform and that with its state in double. */
void mdt_bodyLostByRounding(const MdtBody *b, const double point[3], double lost[3]);
void mdt_bodyVelocity(const MdtBody *b, MdtKeaVelocity *v); /* with `spin`: as last shown */
void mdt_bodyAcceptVelocities(MdtBodyID b); /* takes over velocities that were written through pointers */
void mdt_bodyKeepWithinReach(MdtBodyID b);  /* stops a body that has come to the bound of positions */
void mdt_bodyEnable(MdtBodyID b);           /* MdtBodyEnable and MdtBodyDisable, in a stage of the world, too */
void mdt_bodyDisable(MdtBodyID b);
void mdt_bodyAge(MdtBodyID b, double h); /* after a step of h seconds */
MeBool mdt_bodyIsFast(const MdtBody *b); /* above the world's thresholds of velocities */
void mdt_bodyWakeIfAsleep(MdtBodyID b);
/* Loads of this step, part of a frame of so many seconds, into kea; empties the accumulators. Momenta that are given as
 * the step begins wait for the joints (mdt_islandKick), if there are any. */
void mdt_bodyPack(MdtBodyID b, double frame, MeBool hasJoints);
/* The step begins with the body's state as it is now. */
void mdt_bodyNoteStart(MdtBodyID b);
void mdt_bodyTerm(MdtBodyID b); /* detaches its constraints, returns the record */

/* ---- a body that stays in its place (mdt_stay.c) ---- */

/* Its program has put it elsewhere: it has not stayed anywhere yet. */
void mdt_stayForget(MdtBodyID b);
/* After a step of h seconds. */
void mdt_stayCount(MdtBodyID b, double h);
/* Has it stayed where it is for long? */
MeBool mdt_staysInPlace(const MdtBody *b);
/* Would it hardly move in the next second, as it moves now? */
MeBool mdt_isQuiet(const MdtBody *b);
/* Would it move by a change of momentum, N s and N m s, in h seconds? */
MeBool mdt_wouldMove(const MdtBody *b, const double push[3], const double angularImpulse[3], double h);

/* ---- forces that go on (mdt_force.c) ---- */

/* A frame begins: adds the correction for forces that were given in the last one, too, to the kick of the body. */
void mdt_forceBegin(MdtBodyID b);
/* Hands the forces of a frame of so many seconds to kea, and empties the accumulators. */
void mdt_forceApply(MdtBodyID b, double frame);
/* Those that the step began with act in the rest of it, too. */
void mdt_forceKeep(MdtBodyID b);
/* The program has moved or changed the body: forces begin anew. */
void mdt_forceForget(MdtBodyID b);

/* ---- constraints ---- */

/* Marks that a program has a pointer to its parameters, and may write them without a setter. */
void mdt_constraintWatch(MdtConstraintID c);

/* One more, or less, of the constraints that the world has room for: joints, groups, contacts. False, with a warning
 * that names the caller: there is no more room. */
MeBool mdt_constraintCount(MdtWorldID w, const char *caller);
void mdt_constraintUncount(MdtWorldID w);

/* Creates a joint of a type for the API function `caller`, with its defaults. Null when the world is full. */
MdtJoint *mdt_jointCreate(MdtWorldID w, MdtBclJointType type, const char *caller);
/* The joint if it is live and of the type; else null, with a warning. */
MdtJoint *mdt_jointOfType(void *handle, MdtBclJointType type, const char *caller);
/* The joint goes, and its switch with it (mdt_no_collide.c). */
void mdt_noCollideForget(MdtJoint *j);
/* The constraint as a joint of the type for MdtConstraintDCast*: null, without a warning, when it is another. */
void *mdt_jointCast(MdtConstraintID c, MdtBclJointType type, const char *caller);
/* The kind of a constraint: a point is a contact, a manifold a group, or the contact that is alone in it. */
MdtBclJointType mdt_constraintType(const MdtBaseConstraint *c);
static inline const char *mdt_constraintName(const MdtBaseConstraint *c) {
    return MdtBclTypeOf(mdt_constraintType(c))->name;
}
/* True for a body index of 0 or 1; else a warning. */
MeBool mdt_isSide(const char *caller, unsigned int bodyindex);
/* Makes p unit and o unit and orthogonal to p. False, with a warning, when a length or the angle between them is 0. */
MeBool mdt_makeAxes(const char *caller, double p[3], double o[3]);
/* Sets the axis of one side of a joint with two axes at right angles: the primary of side 0, the second of side 1.
 * Both frames are aligned with it as the bodies stand now. */
void mdt_constraintSetCrossAxis(MdtConstraintID c, const char *caller, int side, MeReal x, MeReal y, MeReal z);
/* A vector at right angles to p. */
void mdt_chooseOrthogonal(const double p[3], double o[3]);
void mdt_constraintAttach(MdtConstraintID c, MdtBodyID b0, MdtBodyID b1);
void mdt_constraintDetach(MdtConstraintID c, int side);
/* Detaches it and takes it from the world's list; the record is the caller's to return. */
void mdt_constraintTerm(MdtConstraintID c);
/* Disables a joint or a manifold; destroys a joint, a group or a contact: now, in a stage of the world, too. */
void mdt_constraintDeactivate(MdtConstraintID c);
void mdt_constraintRemove(MdtConstraintID c);
/* Where both sides are now: a body's centre of mass, or the world. */
void mdt_constraintPoses(MdtConstraintID c, MdtKeaTransformation pose[2]);
/* The body's centre of mass was moved within it: the attachment stays where it is in the world. */
void mdt_constraintReframe(MdtConstraintID c, int side, const MdtKeaBody *before, const MdtKeaBody *after);
/* Clears the warm start: the forces of the last step are no guess for the next. */
void mdt_constraintForget(MdtConstraintID c);
/* Its force and torque in the last step; of a group the sum over its contacts. */
void mdt_constraintSetForce(MdtConstraintID c, const MdtKeaForcePair *force);
void mdt_jointFree(MdtJoint *j); /* memory that it has outside of its record */

/* Constraints in the order of simulation as programs see them: a group is followed by its contacts, and of a manifold
 * of one contact only that is seen. Null after the last. */
MdtConstraintID mdt_constraintShown(MdtConstraintID c);
MdtConstraintID mdt_constraintAfter(MdtConstraintID c);
/* Calls back for a joint or a manifold, and for the contacts of a group. */
void mdt_constraintVisit(MdtConstraintID base, MdtConstraintIteratorCBPtr cb, void *data);
/* The next of those that are attached to a body. */
MdtConstraintID mdt_constraintAfterOf(MdtBodyID b, MdtConstraintID c);

/* The problem of a contact whose friction cannot act, or has no bound, unless it was set up like that; 0: none. A
 * warning of each problem, once a world. */
int mdt_surfaceProblem(const MdtBclContactParams *params);
void mdt_surfaceWarn(MdtWorldID w, int problems);

/* Resets a limit and copies the public properties of another, which may be itself. */
void mdt_limitAssign(MdtLimitID to, const MdtBclLimit *from);

/* ---- what programs forget (mdt_forgotten.c) ---- */

/* A step of h seconds begins: warns of motors on joints that were never enabled, and of centres of mass that were not
 * set. */
void mdt_forgottenWatch(MdtWorldID w, double h);
/* Warns, if it touches something, that the body is too heavy for the world's epsilon. */
void mdt_forgottenScale(MdtBodyID b);

/* ---- joints that break (mdt_break.c) ---- */

/* A step begins; it ends; a constraint is destroyed. */
void mdt_breakBegin(MdtWorldID w);
void mdt_breakEnd(MdtWorldID w);
void mdt_breakForget(MdtJoint *j);

/* ---- stages (mdt_stage.c) ------------------------------------------------------------------------------------- */

/* What must stay as it is while a stage calls the program (MeInternal.h). Each level includes those before it. */
enum {
    MDT_GUARD_WORLD = 0,               /* the world itself */
    MDT_GUARD_BODIES = MDT_BODY_GUARD, /* records of bodies: pairs of models are handled */
    MDT_GUARD_CONSTRAINTS, /* records of constraints, to which bodies they are attached, and the order: lists
                                        are walked */
    MDT_GUARD_GRAPH,       /* what is enabled: there are partitions; a body's handler runs */
    MDT_GUARD_STATES       /* poses, velocities, masses, options of joints: partitions are being solved */
};
/* MeStageWhen; what has to wait is in the world's list then. */
MeWhen mdt_when(MdtWorldID w, int level, const char *caller, const MeLater *later);
/* May the body's state be changed? Else a message that names the caller: its partition is being solved. */
MeBool mdt_mayChangeState(const MdtBody *b, const char *caller);
/* Destroys a body: now, or when the stage ends that holds it, or its models. */
void mdt_bodyDestroy(MdtBodyID b, const char *caller);
/* Is it what was meant when something was put off? Else null. */
MdtBodyID mdt_laterBody(const MeLater *later);
MdtConstraintID mdt_laterConstraint(const MeLater *later);

/* A body whose state, or what moves it, is to be changed. */
#define MDT_CHANGE_BODY(b)                                                                                             \
    do {                                                                                                               \
        if (!mdt_isBody((b), __func__) || !mdt_mayChangeState((b), __func__))                                          \
            return;                                                                                                    \
    } while (0)

#endif
