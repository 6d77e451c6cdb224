/* Inside Mdt: the records of worlds, bodies and constraints, and functions shared by the files of this library.
 *
 * Ownership: a world owns pools of records, which never move: bodies, joints, and the manifolds of contacts
 * (mdt_manifold_i.h). Live records are linked into the world's lists in the order of simulation: sort key, then
 * creation. A joint, or a manifold, is also linked into the lists of its bodies. A body's authoritative state is the
 * double one in `kea`; what programs point at is refreshed from it.
 */
#ifndef MDT_I_H
#define MDT_I_H

#include "Mdt.h"
#include "MdtBcl.h"
#include "MdtInternal.h"
#include "MdtKeaMath.h"
#include "MeChunk.h"
#include "MeInternal.h"
#include "MeMessage.h"
#include "MeTeam.h"
#include "mdt_surface_i.h"
#include <stddef.h>
#include <stdint.h>

/* ---- records and pools --------------------------------------------------------------------------------------- */

/* The head of every record. */
typedef struct MdtRecord {
    unsigned int magic; /* says what it is; 0: not in use */
    int flags;
    union {
        MeHandle handle;        /* while it lives */
        struct MdtRecord *free; /* next in the pool's free list */
    };
} MdtRecord;

enum {
    MDT_WORLD = 0x4b57524c,
    MDT_BODY = 0x4b424459,
    MDT_JOINT = 0x4b4a4e54,
    MDT_MANIFOLD = 0x4b4d4e46,
    MDT_POINT = 0x4b504e54, /* within a manifold */
    MDT_EXTRA = 0x4b585452,
};

/* Records of one size, in one block, or, where there is no limit to them, in blocks of which each is as large as all
 * before it together. Freed ones are reused last, so that a stale handle is noticed for as long as possible. */
typedef struct MdtPool {
    void *blocks; /* each begins with a pointer to the one before it */
    size_t recordSize;
    MeLimit limit;
    const char *what; /* "bodies" */
    int room, used;   /* records in all blocks */
    char *fresh;      /* the first of the newest block that has never been in use; its memory has not been touched */
    int numFresh;
    MdtRecord *firstFree, *lastFree;
} MdtPool;

/* Before the first record; recordSize, what and limit are set. Takes all memory that there will be, if there is a
 * limit. */
MeBool mdt_poolInit(MdtPool *pool, const char *caller);
void mdt_poolTerm(MdtPool *pool);
/* Zeroed but for its head; null, with a message that names the caller, when there is no room. */
void *mdt_poolGet(MdtPool *pool, unsigned int magic, const char *caller);
void mdt_poolPut(MdtPool *pool, void *record);

/* ---- the list of a world's bodies, or constraints ------------------------------------------------------------ */

typedef struct MdtLink {
    struct MdtLink *next, *previous;
    unsigned long serial; /* counts creations in the world */
    MeI32 sortKey;
} MdtLink;

/* The record that a link is part of: a body, a joint, a manifold. */
static inline void *mdt_linkOwner(const MdtLink *link) {
    return (char *)link - sizeof(MdtRecord);
}

typedef struct MdtList {
    MdtLink *first, *last;
    int count;
    MeBool isSorted;
} MdtList;

void mdt_listAppend(MdtList *list, MdtLink *link, unsigned long serial);
void mdt_listRemove(MdtList *list, MdtLink *link);
void mdt_listSetKey(MdtList *list, MdtLink *link, MeI32 key);
void mdt_listSort(MdtList *list); /* by key, then serial; a merge sort that allocates nothing */

/* ---- bodies -------------------------------------------------------------------------------------------------- */

typedef struct MdtAttachment MdtAttachment;

/* A body as its last step, or the last part of it that was taken by safe time, began. */
typedef struct MdtStart {
    MdtKeaVelocity velocity;
    double position[3], quaternion[4]; /* of the centre of mass */
    unsigned long moves;               /* MdtBody.moves then, and when the step was done */
    unsigned long movesAfter;
} MdtStart;

/* For how long a body has hardly moved, and near which pose it swings (mdt_sleep.c). */
typedef struct MdtStay {
    double way[6];                     /* m, in the last second: that it moved, and turned at its radius */
    double most;                       /* m, of that, in the last second */
    double position[3], quaternion[4]; /* of the centre of mass */
    double time;                       /* s, for which it has been near there */
    double farthest;                   /* m, that it was away from there, */
    double known;                      /* and when it came back last */
    double reach;                      /* m: it swung by little before, and would still be within this; 0: it did not */
    int returns;                       /* how often it has come back to half of the farthest */
    MeBool isBack;
} MdtStay;

/* How the force on a body answers to its motion: sums over frames (mdt_force.c). */
typedef struct MdtFeedback {
    double along[3];     /* the direction of the force's last change, */
    double change;       /* N s, N m s: and the change along it */
    double before[2][3]; /* kg m/s or kg m²/s: the mean momentum of the frame before, and its change */
    double sum[3][5];    /* addToFit: of products of 1, p, q of the frame before with 1, p, q, f, p² + q² */
    int frames;
    int steady; /* frames since its change turned round */
    int growth; /* frames, near such ones, in which the force was larger than before, less others */
} MdtFeedback;

/* What a program applied to a body for the last frame. */
typedef struct MdtApplied {
    double force[3], torque[3]; /* N, N m */
    double momentum[2][3];      /* kg m/s, kg m²/s, as the last step, or part of it, began */
    double time;                /* s, of that frame; 0: it applied nothing, or has moved the body since */
    MdtFeedback pushing, turning;
} MdtApplied;

enum {
    MDT_ENABLED = 1,    /* takes part in the simulation */
    MDT_ASLEEP = 2,     /* was disabled by the world, not by the program */
    MDT_FAR = 4,        /* was stopped at the bound of positions, with a warning */
    MDT_WATCHED = 8,    /* programs write its parameters through a pointer; of a body: those of a constraint of it */
    MDT_LONE = 16,      /* a manifold of one contact that is in no group */
    MDT_SWAPPED = 32,   /* a group that was attached as (null, body) */
    MDT_APART = 64,     /* a joint whose bodies do not collide with each other; a body that has or had such a joint */
    MDT_FORCED = 128,   /* a body whose program has given a force, be it 0, for the step that comes */
    MDT_KEPT = 256,     /* a body whose force goes on for the rest of the step in which it was given */
    MDT_TOUCHED = 1024, /* a joint that a program may have changed by a call; of a body: one of its joints is */
    MDT_TOLD = 512,     /* a body, or a joint, of which the program was warned (mdt_force.c, mdt_forgotten.c) */
    MDT_WAS_ENABLED = 2048, /* a joint that has been enabled */
    MDT_OFF_CENTRE = 4096,  /* a body whose program has yet to say where its centre of mass is */
    MDT_CONDEMNED = 8192,   /* is being destroyed, or will be when a stage ends (mdt_stage.c) */
    MDT_BRIDGED = 16384,    /* a group that a bridge made and keeps */
};

/* Fields that are read together share cache lines of 64 bytes, in single precision (records begin with one). */
/* A body's frame in double: its transform, but for rounding. */
typedef struct MdtFrame {
    double position[3], axes[3][3]; /* m; its axes are columns */
} MdtFrame;

struct MdtBody {
    MdtRecord record;
    MdtLink link;
    /* what collision reads and events read */
    MeMatrix4 transform;                 /* what programs see of the pose */
    MeVector3 velocity, angularVelocity; /* what programs see of the velocities, and may write */
    unsigned long moves;                 /* counts how often `frame` became another */
    /* the graph */
    int partition; /* in this step; -1: none */
    int index;     /* in Kea's arrays, in this step */
    int place;     /* in the order of simulation, when partitions were found last */
    int calmSteps; /* in a row, in which all velocities of its partition were below Kea's threshold of rest */
    MdtWorldID world;
    MdtAttachment *attachments; /* its joints and manifolds, */
    int manifolds;              /* and how many of these are manifolds */
    /* read for partitions at rest */
    unsigned long certificate;                     /* of rest, the world's when it was given, or MDT_SLEEPS; 0: none */
    MeVector3 shownVelocity, shownAngularVelocity; /* as last written by the library: a difference was written by a
                                                      program */
    double force[3], torque[3];                    /* N, N m, added since the last step */
    double impulse[3], twist[3];                   /* N s, N m s, the same */
    double lag, part;                              /* s: time by which it is behind its world; its last step */
    double enabledTime;                            /* s */
    int enabledSteps;
    double aliveTime; /* s, since MdtBodyEnable was called last, though it may have been enabled already */
    int aliveSteps;
    MeReal safeTime;
    MdtSolver solver; /* the answer of MdtSolverCB for its partition, if there is one (mdt_choice.c) */

    MdtKeaBody kea; /* the centre of mass: the authoritative state */
    MdtStart start;
    double push[3]; /* m/s: displacement of the last step over h, less the velocity: position
                                           correction */
    MdtStay stay;
    double theta; /* 1/2 to 1: it moved by (1 - θ) v + θ v⁺ in the last step */
    MdtApplied applied;
    double centre[3];     /* m, of mass, in the body's frame */
    double centreTurn[4]; /* w x y z, axes of the centre of mass to the body's frame */
    /* as last shown, by setters, and at a step's end; of `kea` */
    MdtFrame frame;
    double spin[3];            /* rad/s; in a step, with the twist that it began with */
    MeMatrix4 centreTransform; /* what programs see of the centre's pose */

    double mass;          /* kg */
    double inertia[3][3]; /* kg m², as set */
    MeReal linearDamping, angularDamping;
    MeVector3 fastSpinAxis;
    void *userData, *model;
    const MdtBodyUser *user; /* of what `model` is; null: nobody needs to know */
};
#ifndef _ME_API_DOUBLE
_Static_assert(offsetof(MdtBody, transform) == 64, "a pose is one line");
#endif

void mdt_bodyShow(MdtBodyID b); /* refreshes what programs see from the state in kea */
/* m: the offset between a world position found with the body's shown transform and that with its state in double. */
void mdt_bodyLostByRounding(const MdtBody *b, const double point[3], double lost[3]);
void mdt_bodyVelocity(const MdtBody *b, MdtKeaVelocity *v); /* with `spin`: as last shown */
void mdt_bodyAcceptVelocities(MdtBodyID b); /* takes over velocities that were written through pointers */
double mdt_worldBound(const MdtWorld *w);   /* m: of positions */
void mdt_bodyKeepWithinReach(MdtBodyID b);  /* stops a body that has come to the bound of positions */
void mdt_bodyEnable(MdtBodyID b);           /* MdtBodyEnable and MdtBodyDisable, in a stage of the world, too */
void mdt_bodyDisable(MdtBodyID b);
void mdt_bodyAge(MdtBodyID b, double h); /* after a step of h seconds */
MeBool mdt_bodyIsFast(const MdtBody *b); /* above the world's thresholds of velocities */

/* ---- sleep (mdt_sleep.c) ---- */

void mdt_bodySleep(MdtBodyID b);
void mdt_bodyWakeIfAsleep(MdtBodyID b);
/* Its program has put it elsewhere: it has not stayed anywhere yet. */
void mdt_stayForget(MdtBodyID b);
/* After a step of h seconds. */
void mdt_stayCount(MdtBodyID b, double h);
/* Has it stayed where it is for long? Would it hardly move in the next second? */
MeBool mdt_staysInPlace(const MdtBody *b);
MeBool mdt_isQuiet(const MdtBody *b);
/* Would it move by a change of momentum, N s and N m s, in h seconds? */
MeBool mdt_wouldMove(const MdtBody *b, const double push[3], const double twist[3], double h);
/* Wakes the sleepers of which an input has changed since they fell asleep, before a step of h seconds. */
void mdt_sleepersWake(MdtWorldID w, double h);
/* The forces of those that sleep on are over with the step. */
void mdt_sleepersEndForces(MdtWorldID w);
/* All sleepers, as something has changed that concerns each of them. */
void mdt_sleepersWakeAll(MdtWorldID w);

/* Loads of this step, part of a frame of so many seconds, into kea; empties the accumulators. Momenta that are given as
 * the step begins wait for the joints (mdt_islandKick), if there are any. */
void mdt_bodyPack(MdtBodyID b, double frame, MeBool hasJoints);
/* The step begins with the body's state as it is now. */
void mdt_bodyNoteStart(MdtBodyID b);
void mdt_bodyTerm(MdtBodyID b); /* detaches its constraints, returns the record */

/* ---- forces that go on (mdt_force.c) ---- */

/* A frame begins: adds the correction for forces that were given in the last one, too, to the kick of the body. */
void mdt_forceBegin(MdtBodyID b);
/* Hands the forces of a frame of so many seconds to kea, and empties the accumulators. */
void mdt_forceApply(MdtBodyID b, double frame);
/* Those that the step began with act in the rest of it, too. */
void mdt_forceKeep(MdtBodyID b);
/* The program has moved or changed the body: forces begin anew. */
void mdt_forceForget(MdtBodyID b);

/* The certificate of bodies that are asleep. */
#define MDT_SLEEPS ((unsigned long)-1)

/* An input of the body's next step has changed: its rest certificate ends, or its sleep as the next step begins. Any
 * number of threads may call this at once, as contacts are updated. */
static inline void mdt_bodyDisturb(MdtBodyID b) {
    if (__atomic_load_n(&b->certificate, __ATOMIC_RELAXED) == 0)
        return;
    __atomic_store_n(&b->calmSteps, 0, __ATOMIC_RELAXED);
    __atomic_store_n(&b->certificate, 0, __ATOMIC_RELAXED);
}

/* ---- constraints --------------------------------------------------------------------------------------------- */

/* One side of a constraint, linked into its body's list. */
struct MdtAttachment {
    MdtBodyID body; /* null: the world, or nothing yet */
    MdtAttachment *next, *previous;
};

/* The head of joints and manifolds. A contact has none: an MdtConstraintID may also be a point of a manifold, and every
 * function of the API that takes one says what it does then. */
struct MdtBaseConstraint {
    MdtRecord record;
    MdtLink link;
    MdtWorldID world;
    MdtAttachment side[2];
};

/* A record lies at a multiple of 16, so the address of an attachment tells which side it is. */
_Static_assert(offsetof(MdtBaseConstraint, side) % 16 == 8 && sizeof(MdtAttachment) % 16 == 8, "sides alternate");
static inline int mdt_attachmentSide(const MdtAttachment *at) {
    return (uintptr_t)at % 16 == 8 ? 0 : 1;
}
static inline MdtConstraintID mdt_attachmentOwner(const MdtAttachment *at) {
    return (MdtConstraintID)(void *)((char *)(at - mdt_attachmentSide(at)) - offsetof(MdtBaseConstraint, side));
}

/* A joint, spring or limit: any constraint that is no contact. */
typedef struct MdtJoint {
    MdtBaseConstraint base;
    void *userData;
    const MdtBclType *type;
    MdtBclConstraint bcl;
    MdtKeaVelocity worldVelocity;
    MdtKeaForcePair force;          /* in the last step */
    MeU64 certified;                /* a hash of `bcl` as the certified step left it, then */
    MeReal breakForce, breakTorque; /* N, N m; MEINFINITY: it does not break */

    int firstRow, numRows;                                   /* in this step */
    double warm[MdtBclGETMAXROWS], ripple[MdtBclGETMAXROWS]; /* N, m/s, of the rows in the last step, */
    int numWarm;                                             /* if there are as many */
    MeBool isDegenerate, wasDegenerate;                      /* in this step, in the last one */
    MeBool isDriven; /* in the last step: its motor ran, or what it is attached to moved */
} MdtJoint;

static inline MeBool mdt_isJoint(const MdtBaseConstraint *c) {
    return c->record.magic == MDT_JOINT;
}

/* An input of the constraint's rows has changed. */
static inline void mdt_constraintDisturb(MdtConstraintID c) {
    for (int k = 0; k < 2; k++)
        if (c->side[k].body && (c->record.flags & MDT_ENABLED))
            mdt_bodyDisturb(c->side[k].body);
}

/* A call of the program has had to do with a joint: it may have changed it. */
static inline void mdt_constraintTouch(MdtConstraintID c) {
    if (c->record.magic != MDT_JOINT || (c->record.flags & MDT_TOUCHED))
        return;
    c->record.flags |= MDT_TOUCHED;
    for (int k = 0; k < 2; k++)
        if (c->side[k].body)
            c->side[k].body->record.flags |= MDT_TOUCHED;
}

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
/* The joint goes, and its switch with it (mdt_apart.c). */
void mdt_apartForget(MdtJoint *j);
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
/* Is the list of a body's constraints linked both ways? */
MeBool mdt_attachmentsAreLinked(const MdtBody *b);
void mdt_constraintDetach(MdtConstraintID c, int side);
/* Detaches it and takes it from the world's list; the record is the caller's to return. */
void mdt_constraintTerm(MdtConstraintID c);
/* Disables a joint or a manifold; destroys a joint, a group or a contact: now, in a stage of the world, too. */
void mdt_constraintOff(MdtConstraintID c);
void mdt_constraintRemove(MdtConstraintID c);
/* Will it be destroyed when a stage ends? */
MeBool mdt_constraintIsCondemned(const MdtBaseConstraint *c);
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

/* The four functions that every joint has: a joint is a constraint and nothing else, so handles convert by a cast. */
#define MDT_JOINT_BASICS(Joint, TYPE)                                                                                  \
    Mdt##Joint##ID MEAPI Mdt##Joint##Create(const MdtWorldID w) {                                                      \
        return (Mdt##Joint##ID)mdt_jointCreate(w, TYPE, __func__);                                                     \
    }                                                                                                                  \
    MDT_JOINT_CASTS(Joint, TYPE)
#define MDT_JOINT_CASTS(Joint, TYPE)                                                                                   \
    void MEAPI Mdt##Joint##Reset(const Mdt##Joint##ID j) {                                                             \
        MdtJoint *c = mdt_jointOfType(j, TYPE, __func__);                                                              \
        if (c)                                                                                                         \
            c->type->reset(&c->bcl);                                                                                   \
    }                                                                                                                  \
    MdtConstraintID MEAPI Mdt##Joint##QuaConstraint(const Mdt##Joint##ID j) {                                          \
        return (MdtConstraintID)j;                                                                                     \
    }                                                                                                                  \
    Mdt##Joint##ID MEAPI MdtConstraintDCast##Joint(const MdtConstraintID c) {                                          \
        return mdt_jointCast(c, TYPE, __func__);                                                                       \
    }

/* The problem of a contact whose friction cannot act, or has no bound, unless it was set up like that; 0: none. A
 * warning of each problem, once a world. */
int mdt_surfaceProblem(const MdtBclContactParams *params);
void mdt_surfaceWarn(MdtWorldID w, int problems);

/* Resets a limit and copies the public properties of another, which may be itself. */
void mdt_limitAssign(MdtLimitID to, const MdtBclLimit *from);

enum { MDT_TIMED_BODIES = 8, MDT_NO_REPORTS = -1 };
/* Bodies, at least, that make batches (mdt_batch.c), partitions that all workers take together (mdt_parallel.c), and
 * crowds of which impacts that take energy are followed only while all fly (mdt_mostHeld). */
enum { MDT_CROWD = 64 };
/* One of so many bodies that bounce may be held, for their impacts to be met in time. Measured, and no test tells 4
 * from 8: 216 balls a hundredth apart that land with 4 m/s lose 4, 4, 2 and 14 % of the energy in 5 s with 2, 4, 8, 16,
 * those a fiftieth apart .2 % with each. */
enum { MDT_HELD = 4 };
/* Of a body's size: how far joints may be open at rest. As much as overlaps may be there. */
#define MDT_CLOSED 1e-4
MeBool mdt_isSolver(MdtSolver solver);
/* m/s: the residual that a step of h seconds may leave (MdtWorldSetAccuracy); below which bodies rest. */
double mdt_worldAccuracy(const MdtWorld *w, double h, MeBool hasJoints);
double mdt_worldRestSpeed(const MdtWorld *w, double h);

/* A world's accounts of exact work (mdt_choice.c). */
typedef enum MdtAccount { MDT_WANTED, MDT_NEEDED, MDT_ACCOUNTS } MdtAccount;

/* What is known of a partition from step to step (mdt_choice.c). */
typedef struct MdtIslandRecord {
    int steps;       /* that it has taken by the engine's choice, up to 2 */
    float exactWork; /* multiplications that an exact step takes, a body; 0: none was taken */
    float fastWork;  /* those of the exact solver in the time of a fast step, a body */
    MeBool isAlone;  /* nothing touches */
    MeBool isUnfit;  /* the fast solver is not for it: nothing touches, or bodies bounce */
    MeBool isUnmet;  /* the fast solver's last answer did not meet the accuracy; */
    int wait, since; /* steps until it is tried again then, and since it was */
    MeBool wasExact; /* the exact solver has taken the last step */
    /* this step */
    MeBool isExactFirst; /* the exact solver begins */
    MdtAccount account;  /* that pays it, */
    double share;        /* multiplications that it may take, */
    double drawn, loan;  /* of these from that account, and lent by MDT_NEEDED; after the step what is left */
} MdtIslandRecord;

struct MdtIsland;
/* A partition that is stepped together with others, and where its own begin among theirs. */
typedef struct MdtMember {
    int partition, firstBody, firstActing;
} MdtMember;

/* The batches of a step (mdt_batch.c). */
typedef struct MdtBatches {
    int bodyRoom, actingRoom;
    int count, numMembers;
    int *firstMember;        /* by batch, and the end */
    MdtMember *member;       /* and the end */
    MeBool *isIn;            /* by partition, if there are batches */
    MdtBodyID *body;         /* of members, */
    MdtKeaBody **kea;        /* parallel to it, */
    MdtConstraintID *acting; /* and what acts on them */
} MdtBatches;

/* The world's accounts are full (mdt_choice.c). */
void mdt_choicesReset(MdtWorldID w);
size_t mdt_tasksSize(size_t bodies); /* ints that the tasks of so many bodies need */

/* ---- worlds -------------------------------------------------------------------------------------------------- */

/* Bodies and the constraints that tie them, when partitions were found last (mdt_island.c). */
typedef struct MdtGraph {
    unsigned long changes; /* of the graph or its order, counted by each change (mdt_graphChanged), */
    unsigned long seen;    /* up to when the partitions are right */
    int numBodies, numActing;
    MdtBodyID *body;         /* by place, bodyRoom */
    int *parent;             /* by place: of union-find */
    MeBool *isEnabled;       /* by place, */
    MeBool *isAwake;         /* and of a set's first body: some body of it is */
    int *partition;          /* by place: as in the bodies, which are not in the cache */
    MdtConstraintID *acting; /* joints and manifolds that act on bodies, constraintRoom */
    int *actsOn;             /* by acting constraint: the place of one of its bodies */
} MdtGraph;

/* The world's inputs of a step of any partition. They are compared as bytes, so there is no padding. */
typedef struct MdtRestInputs {
    double h, gravity[3], epsilon, gamma, workBudget, accuracy;
    MdtContactImportanceCBPtr importance;
    int maxLcpIterations, subSteps, timedBodies, maxMatrixSize, solver, order;
} MdtRestInputs;

/* A worker's own memory while it steps partitions, and its results that concern all of them. */
typedef struct MdtWorker {
    MeChunk scratch, ranking; /* of Kea and contacts; of contacts, to rank them */
    MdtKeaCache *keaCache;
    MeHeldMessages messages; /* by partition */
    int surfaceProblems;     /* of contacts that it packed (MdtContactParams.c) */
} MdtWorker;

struct MdtWorld {
    unsigned int magic;
    MdtWorldParams params;
    MdtPartitionParams rest;
    MeBool hasVelThresh, hasAccThresh; /* of `rest`, the program has set them, */
    MeBool hasThresholds;              /* or any */
    MeReal epsilon, gamma, minSafeTime;
    int maxLcpIterations;
    MeReal workBudget; /* millions of multiplications of a partition's step; 0: no bound */
    MdtSolver solver;
    MdtSolverCB solverCb; /* null: `solver` for all partitions */
    void *solverCbData;
    MeBool isSolverWarned; /* of an answer that is no solver */
    MeReal accuracy;       /* m/s; negative: derived */
    int subSteps;
    int order;                                /* of the scheme, 2 or 4, where nothing touches (mdt_compose.c) */
    int timedBodies;                          /* most bodies of a partition whose contacts are met in time */
    int maxMatrixSize;                        /* rows of a partition */
    MdtContactImportanceCBPtr importance;     /* null: depth */
    int *sizeLog, sizeLogLength;              /* the program's, null: none */
    MdtBodyHandler bodyEnabled, bodyDisabled; /* null: none */
    MdtPartitionEndCB partitionCb;            /* null: the world puts partitions to rest by itself */
    void *partitionCbData;
    MdtPartitionOutput output;
    MdtPool bodyPool, jointPool, manifoldPool, extraPool;
    MdtList bodies, constraints; /* joints, and manifolds but for those that continue a group's */
    MeLimit constraintLimit;     /* for all of numConstraints: joints, groups, contacts */
    int numConstraints;
    MdtSurfaces surfaces;
    unsigned long nextSerial;
    int enabledBodies, asleepBodies, enabledConstraints;
    int enabledJoints;       /* of the enabled constraints */
    int watchedSteps;        /* of mdt_forgotten.c, */
    MeBool expectsCentre;    /* which is to warn of a body's centre of mass, */
    MeBool isCentreTold;     /* and has, */
    MeBool isScaleTold;      /* and has of the mass scale */
    double sinkingMass;      /* kg, of which it warns */
    int breakable;           /* constraints with a limit */
    int apart;               /* joints whose bodies do not collide with each other */
    int userConstraints;     /* whose rows a function of the program makes */
    MdtConstraintID *broken; /* in the last step; constraintRoom */
    int numBroken;
    MdtBreakCBPtr breakCb; /* null: none */
    double lastStep;       /* s, 0 before the first */
    struct {
        MeBool isOver;         /* gravity was set, something has acted, or the warning was given */
        double time;           /* s, in which nothing has acted on the bodies, */
        unsigned long sum;     /* which were as many, and where they are now */
    } idle;                    /* mdt_idle.c */
    unsigned long certificate; /* of rest, valid now (mdt_rest.c) */
    double calmStepsToRest;    /* after which it is given */
    MdtRestInputs restInputs;  /* with which it was */
    int surfaceWarnings;       /* MdtContactParams.c: which were given */
    MdtWorker *workers;        /* numWorkers of them; the first is the thread that steps the world */
    int numWorkers;
    MeTeam *team;  /* null: there is one worker */
    int *taskOf;   /* partitions by task, and where tasks begin among them (mdt_parallel.c) */
    MeStage stage; /* at which of the levels MDT_HOLD_... it is held */

    /* Arrays of a step have room for so many; they are made larger before a step only (mdt_worldReserve). */
    int bodyRoom, constraintRoom;
    MdtGraph graph;
    /* this step's partitions: partition p has the bodies bodyOf[bodyStart[p] .. bodyStart[p+1]) and so on */
    int numPartitions;
    MdtBodyID *bodyOf;
    MdtConstraintID *actingOf;
    MdtKeaBody **keaOf; /* parallel to bodyOf */
    int *bodyStart, *actingStart;
    MdtIslandRecord *record, *lastRecord; /* by partition; those of the partitions before, while these are found */
    double credit[MDT_ACCOUNTS];          /* multiplications (mdt_choice.c) */
    MdtBatches batches;
    /* the same as programs see it, contacts among them; made when they ask (mdt_islandsList) */
    MdtConstraintID *constraintOf;
    int *constraintStart;

    MdtDebugDrawOptions debugDraw; /* 0: nothing */

    MeBool isReported;
    MdtReport *reports; /* by partition of the last step; null until the report is enabled for the first time */
    int reportRoom;
    int numReports;                     /* MDT_NO_REPORTS: the report is off, or no step was taken yet */
    MeU64 lap;                          /* ticks, when the stage began that is being timed; of one worker alone */
    int firstUntimed;                   /* partitions from this one on have no time yet */
    double stageShare[MdtReportStages]; /* how a small partition's time divides, as last seen; 0: none was */

    MeHandle handle;
};

/* Sets the number of workers, with their own memory except for scratch of steps. False: no memory, and nothing has
 * changed. Ends all of them (MdtWorldTasks.c). */
MeBool mdt_workersInit(MdtWorldID w, int count, const char *caller);
void mdt_workersTerm(MdtWorldID w);

/* Room for the batches of so many bodies, and constraints that act on them. False: no memory (mdt_batch.c). */
MeBool mdt_batchesReserve(MdtBatches *b, int bodies, int acting, const char *caller);
void mdt_batchesTerm(MdtBatches *b);

/* Room for so many bodies and constraints in the arrays of a step. False: no memory. */
MeBool mdt_worldReserve(MdtWorldID w, int bodies, int constraints, const char *caller);

/* The set of enabled constraints, their bodies, or the order has changed. Creating and destroying do not count: a new
 * constraint is not enabled yet, and one is disabled before it is destroyed. */
static inline void mdt_graphChanged(MdtWorldID w) {
    w->graph.changes++;
}

/* Finds the partitions of this step; bodies tied to awake ones wake (mdt_island.c). The graph stays as it is until the
 * end: what the program calls for in its callbacks is done then. */
void mdt_islandsBegin(MdtWorldID w);
void mdt_islandsEnd(MdtWorldID w);
/* Makes the lists of their constraints for programs; what programs see of one partition then: it is not disabled. */
void mdt_islandsList(MdtWorldID w);
MdtPartitionInfo mdt_islandInfo(MdtWorldID w, int p);

/* Draws what MdtWorldSetDebugDrawing has chosen (mdt_debug.c). */
void mdt_debugDraw(MdtWorldID w);
/* Check builds, before a step of h seconds: warns of a world without gravity in which nothing moves. */
void mdt_idleWatch(MdtWorldID w, double h);

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

/* ---- the report (mdt_report.c); r is never null, a step that is not reported asks for nothing ------------------ */

/* A step begins, its partitions are known. */
void mdt_reportStep(MdtWorldID w);
/* A partition begins: its report, null if there is none, and how it is timed. */
struct MdtIsland;
void mdt_reportBegin(struct MdtIsland *p);
/* The stage ends. */
void mdt_reportLap(struct MdtIsland *p, MdtReportStage stage);
/* Notes a way that a part was taken in. */
void mdt_reportWay(MdtReport *r, MdtReportWay way);
/* Notes an impact at the start of a part; a part that ends early, at an event; a step that is halved. */
void mdt_reportImpact(MdtReport *r);
void mdt_reportEvent(MdtReport *r);
void mdt_reportFlight(MdtReport *r, int impacts, MeBool isHeld);
void mdt_reportDivision(MdtReport *r);
/* A sub-step was of order 4. */
void mdt_reportComposed(MdtReport *r);
/* The last step's answer was taken without a solve. */
void mdt_reportRest(MdtReport *r);
/* Reports the cost of a solve; its stage ends. */
void mdt_reportSolve(struct MdtIsland *p);
/* A part was integrated: its errors, before anything is read back. */
void mdt_reportPart(MdtReport *r, const struct MdtIsland *p, MeBool isFinite);
/* The partition is done, or was put to rest. */
void mdt_reportEnd(struct MdtIsland *p);
/* A batch begins, with a report of its own, if there is one; that of a member, when the batch is done; all batches
 * are. */
void mdt_reportBatch(struct MdtIsland *p, MdtReport *r);
void mdt_reportMember(const struct MdtIsland *p, const MdtMember *m, int rows, double penetration);
void mdt_reportBatchesEnd(MdtWorldID w);
/* All partitions are done. */
void mdt_reportStepEnd(MdtWorldID w);

/* ---- stages (mdt_stage.c) ------------------------------------------------------------------------------------- */

/* What must stay as it is while a stage calls the program (MeInternal.h). Each level includes those before it. */
enum {
    MDT_HOLD_WORLD = 0,              /* the world itself */
    MDT_HOLD_BODIES = MDT_BODY_HELD, /* records of bodies: pairs of models are handled */
    MDT_HOLD_CONSTRAINTS,            /* records of constraints, to which bodies they are attached, and the order: lists
                                        are walked */
    MDT_HOLD_GRAPH,                  /* what is enabled: there are partitions; a body's handler runs */
    MDT_HOLD_STATES                  /* poses, velocities, masses, options of joints: partitions are being solved */
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

/* ---- checks -------------------------------------------------------------------------------------------------- */

/* True for a live handle; else a warning that names the caller. */
MeBool mdt_isWorld(const MdtWorld *w, const char *caller);
MeBool mdt_isBody(const MdtBody *b, const char *caller);
MeBool mdt_isConstraint(const MdtBaseConstraint *c, const char *caller);
/* True for finite numbers; else a warning. */
MeBool mdt_isFinite(const char *caller, const char *what, MeReal x);
/* The same of vectors; no number is larger than those of single precision, so that products of some are finite. */
MeBool mdt_isFinite3(const char *caller, const char *what, MeReal x, MeReal y, MeReal z);
MeBool mdt_areFinite(const MeReal v[3]); /* without one */
/* Within the bound of positions, too. */
MeBool mdt_isPlace(const char *caller, const char *what, const MdtWorld *w, MeReal x, MeReal y, MeReal z);
/* True for lower <= x; else a warning. */
MeBool mdt_isAtLeast(const char *caller, const char *what, MeReal x, MeReal lower);
MeBool mdt_isUsable(MeReal x); /* positive, and within what single precision can have */
MeBool mdt_isPositive(const char *caller, const char *what, MeReal x);
MeBool mdt_isSortKey(const char *caller, MeI32 key);
MeBool mdt_isPointer(const char *caller, const char *what, const void *p);
/* True for a place to write n numbers to, which are zeroed: the neutral result. */
MeBool mdt_isResult(const char *caller, MeReal *result, int n);
/* Stores x >= 0; else a warning. A null place, of a joint that was none, is left alone. */
void mdt_setAtLeast0(const char *caller, const char *what, MeReal *place, MeReal x);
/* Stores an angle, clamped to 0..pi; a warning for one that is not finite. */
void mdt_setAngle(const char *caller, const char *what, MeReal *place, MeReal x);
/* Warns of one that has gone while any world lives, and of null. */
MeBool mdt_mayDestroyBody(const MdtBody *b, const char *caller);
/* "caller: the constraint has been destroyed, or never was one" */
void mdt_warnGone(const char *caller, const char *what);
/* How many worlds live: one more, or one less. */
void mdt_countWorlds(int change);

#define MDT_NEED_WORLD(w, otherwise)                                                                                   \
    do {                                                                                                               \
        if (!mdt_isWorld((w), __func__))                                                                               \
            return otherwise;                                                                                          \
    } while (0)
#define MDT_NEED_BODY(b, otherwise)                                                                                    \
    do {                                                                                                               \
        if (!mdt_isBody((b), __func__))                                                                                \
            return otherwise;                                                                                          \
    } while (0)
/* A body whose state, or what moves it, is to be changed. */
#define MDT_CHANGE_BODY(b)                                                                                             \
    do {                                                                                                               \
        if (!mdt_isBody((b), __func__) || !mdt_mayChangeState((b), __func__))                                          \
            return;                                                                                                    \
    } while (0)
#define MDT_NEED_CONSTRAINT(c, otherwise)                                                                              \
    do {                                                                                                               \
        if (!mdt_isConstraint((c), __func__))                                                                          \
            return otherwise;                                                                                          \
    } while (0)

/* ---- MeReal and double --------------------------------------------------------------------------------------- */

/* What MeReal has no number for is MEINFINITY. */
static inline MeReal mdt_real(double x) {
    const double most = (double)MEINFINITY;
    return (MeReal)(x > most ? most : x < -most ? -most : x);
}

/* Zero times infinity is no number: three are looked at at once, as this is done for all that moves. */
static inline void mdt_toReal(MeVector3 r, const double v[3]) {
    r[0] = (MeReal)v[0], r[1] = (MeReal)v[1], r[2] = (MeReal)v[2];
    if (!(0 * r[0] + 0 * r[1] + 0 * r[2] <= 0))
        r[0] = mdt_real(v[0]), r[1] = mdt_real(v[1]), r[2] = mdt_real(v[2]);
}

static inline void mdt_fromReal(double r[3], const MeVector3 v) {
    r[0] = v[0], r[1] = v[1], r[2] = v[2];
}

#endif
