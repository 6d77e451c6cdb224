/* Inside Mdt: the record of a body. */
#ifndef MDT_BODY_I_H
#define MDT_BODY_I_H

#include "base/mdt_base_i.h"

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
    double displacement[6];            /* m, in the last second: that it moved, and turned at its radius */
    double maxDisplacement;            /* m, of that, in the last second */
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
    MDT_ENABLED = 1,     /* takes part in the simulation */
    MDT_ASLEEP = 2,      /* was disabled by the world, not by the program */
    MDT_FAR = 4,         /* was stopped at the bound of positions, with a warning */
    MDT_WATCHED = 8,     /* programs write its parameters through a pointer; of a body: those of a constraint of it */
    MDT_LONE = 16,       /* a manifold of one contact that is in no group */
    MDT_SWAPPED = 32,    /* a group that was attached as (null, body) */
    MDT_NO_COLLIDE = 64, /* a joint whose bodies do not collide with each other; a body that has or had such a joint */
    MDT_FORCED = 128,    /* a body whose program has given a force, be it 0, for the step that comes */
    MDT_KEPT = 256,      /* a body whose force goes on for the rest of the step in which it was given */
    MDT_TOUCHED = 1024,  /* a joint that a program may have changed by a call; of a body: one of its joints is */
    MDT_WARNED = 512,    /* a body, or a joint, of which the program was warned (mdt_force.c, mdt_forgotten.c) */
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
    double impulse[3], angularImpulse[3];          /* N s, N m s, the same */
    double lag, lastAdvance;                       /* s: time by which it is behind its world; its last step */
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

#endif
