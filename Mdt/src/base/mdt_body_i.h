/* Inside Mdt: the record of a body. */
#ifndef MDT_BODY_I_H
#define MDT_BODY_I_H

#include "base/mdt_base_i.h"
#include <math.h>
#include <string.h>

typedef struct MdtAttachment MdtAttachment;

/* Velocities that programs read: m/s, rad/s. */
typedef struct MdtPublicVelocity {
    MeVector3 lin, ang;
} MdtPublicVelocity;

/* A pose: m, and unit quaternion w x y z. */
typedef struct MdtPose {
    double position[3], quaternion[4];
} MdtPose;

/* The state of a body at the start of its last step, or of the last part of a step by safe times. */
typedef struct MdtStart {
    MdtKeaVelocity velocity;
    MdtPose pose;        /* of the centre of mass */
    unsigned long moves; /* MdtBody.moves at the start; ULONG_MAX after a step that did not change the pose just once */
} MdtStart;

/* Whether a body has stayed near one pose, and how it oscillates about it (mdt_stay.c). */
typedef struct MdtStay {
    double displacement[6]; /* m, over the last second: translation, and rotation times the body's radius */
    double maxDisplacement; /* m, the largest magnitude of `displacement` in the last second */
    MdtPose pose;           /* of the centre of mass */
    double time;            /* s, for which the body has been near that pose */
    double maxDistance;     /* m, the largest distance from that pose so far */
    double maxAtReturn;     /* m, `maxDistance` at the last return */
    double
        reach; /* m: after a small oscillation, the distance up to which the body still counts as oscillating; else 0 */
    int crossings; /* how often its distance has crossed half of `maxDistance`; even: it is nearer now */
} MdtStay;

/* Response of a program's force on a body to the body's motion: sums over frames (mdt_force.c). */
typedef struct MdtFeedback {
    double along[3];     /* unit vector along the last change of the force */
    double change;       /* N s, N m s: that change, signed */
    double before[2][3]; /* kg m/s or kg m²/s: of the frame before, the mean momentum and the momentum's change */
    double sum[3][5];    /* addToFit: products of (1, p, q) of the frame before with (1, p, q, f, p² + q²) */
    int frames;
    int steady; /* frames since the change of the force last reversed */
    int growth; /* score of frames in which the force grew while it alternated: those add, others subtract */
} MdtFeedback;

/* The forces that the program applies to a body: linear, about the centre of mass. */
typedef struct MdtForces {
    double load[2][3];     /* N, N m, added since the last step */
    double impulse[2][3];  /* N s, N m s, added since the last step */
    double lastLoad[2][3]; /* N, N m, of the last frame; of a sleeping body those under which it rests */
    double momentum[2][3]; /* kg m/s, kg m²/s, at the start of the last step or of its last part; of a sleeping body:
                              the sum of impulses that have not woken it yet */
    double time; /* s, length of the last frame; 0: the program applied nothing, or has moved the body since */
    MdtFeedback feedback[2];
} MdtForces;

/* The motion of a body that the program moves (mdt_mover.c). */
typedef struct MdtMover {
    MdtBodyID body;
    struct MdtMover *next, *previous; /* of the world's movers */
    MdtKeaMover kea;                  /* its motion in this step, or in the last one */
    MdtPose target;                   /* of the centre of mass */
    MdtPose end;                      /* of the centre of mass at the end of the step */
    MeBool isHidden;                  /* it is a hidden body (MdtInternal.h) */
    const MdtBodyUser *user;          /* of a hidden body */
    MeBool hasTarget;                 /* it is to be reached at the end of the next step */
    MeBool isMoving;                  /* in this step, or in the one before */
    MdtKeaVelocity before;            /* its velocity in the last step */
    MeBool wasLed;                    /* the last step has reached a target */
    MdtPublicVelocity led;            /* the velocities that followed from it */
} MdtMover;

/* The forces of a body to which the program has never applied any. */
extern const MdtForces mdt_noForces;

enum {
    MDT_ENABLED = 1,        /* the body or constraint takes part in the simulation */
    MDT_ASLEEP = 2,         /* a body that was disabled by the world, not by the program */
    MDT_FAR = 4,            /* a body that was stopped at the position limit, with a warning */
    MDT_WATCHED = 8,        /* a constraint whose parameters the program may write by pointer; a body with such a one */
    MDT_LONE = 16,          /* a manifold of one contact that is in no group */
    MDT_SWAPPED = 32,       /* a group that was attached as (null, body) */
    MDT_NO_COLLIDE = 64,    /* a joint whose bodies do not collide with each other; a body that has or had one */
    MDT_FORCED = 128,       /* a body to which the program has added a force, perhaps 0, since the last step */
    MDT_KEPT = 256,         /* a body whose force also acts in the rest of a step that safe times divide */
    MDT_TOUCHED = 1024,     /* a joint that an API call may have changed; a body with such a joint */
    MDT_WARNED = 512,       /* a body or joint whose warning was given (mdt_force.c, mdt_forgotten.c) */
    MDT_WAS_ENABLED = 2048, /* a joint that has been enabled */
    MDT_OFF_CENTRE = 4096,  /* a body whose centre of mass the program still has to set: a warning otherwise */
    MDT_CONDEMNED = 8192,   /* an object that is being destroyed, or will be when a stage ends (mdt_stage.c) */
    MDT_BRIDGED = 16384,    /* a contact group that the bridge (Mst) made and owns */
    MDT_MODELLED = 32768,   /* a body with models; MdtWorld.bodyUser notifies their owner */
};

/* Fields that are read together share cache lines of 64 bytes in single precision; the record starts at such a line. */
struct MdtBody {
    MdtRecord record;
    MdtLink link;
    /* read by collision detection and by events */
    MeMatrix4 transform;        /* the pose that programs read */
    MdtPublicVelocity velocity; /* programs may write it */
    unsigned long moves;        /* version number of `frame` */
    /* the graph */
    int partition; /* index of its partition in this step; -1: none */
    int index;     /* of the body in Kea's arrays of this step */
    int place;     /* index in the order of simulation when partitions were last found */
    int calmSteps; /* consecutive steps in which its partition was at rest (areCalm, mdt_certificate.c) */
    MdtWorldID world;
    MdtMover *mover;            /* null: forces move it; else its partition, index and place are -1 */
    MdtAttachment *attachments; /* list of its joints and manifolds */
    int manifolds;              /* number of manifolds among the attachments */
    /* fields that the rest certificate reads (mdt_certificate.c) */
    unsigned long certificate; /* the world's when the rest certificate was given; MDT_SLEEPS: asleep; 0: none */
    MdtPublicVelocity shown;   /* `velocity` as the library last wrote it; differs if the program has written it */
    MdtForces *forces;         /* null: the program has never applied a force or an impulse */
    double lag, lastAdvance;   /* s: time by which the body is behind its world; length of its last step or part */
    double enabledTime;        /* s; 0: it has not been stepped since it was enabled */
    double aliveTime;          /* s, since the last call of MdtBodyEnable, also if the body was enabled already */
    int aliveSteps;
    MeReal safeTime;

    MdtKeaBody kea; /* mass and motion of the centre of mass: the authoritative state */
    MdtStart start;
    double push[3]; /* m/s: position correction of the last step, displacement / h - velocity */
    MdtStay stay;
    double theta;   /* 1/2 to 1: in the last step the body moved by h ((1 - θ) v + θ v⁺) */
    MdtPose centre; /* of the centre of mass and its axes, in the body's frame */
    /* copies of the state in `kea`, written by setters and at the end of a step (mdt_bodyShow) */
    MdtKeaTransformation frame; /* the body's pose: `transform` before rounding */
    double spin[3];             /* rad/s; within a step with the attitude at the step's start */
    MeMatrix4 centreTransform;  /* the centre of mass's pose that programs read */

    double mass; /* kg */
    double gravityFactor;
    double maxSpeed[2];   /* m/s, rad/s; MEINFINITY: none */
    int lockedAxes;       /* as set; kea.locked: those that act */
    double inertia[3][3]; /* kg m², as set */
    MeVector3 fastSpinAxis;
    void *userData, *model;
};
#ifndef _ME_API_DOUBLE
_Static_assert(offsetof(MdtBody, transform) == 64, "a pose is one line");
#endif

/* The pose of the centre of mass. */
static inline MdtPose mdt_bodyPose(const MdtBody *b) {
    MdtPose pose;
    keaCopy(pose.position, b->kea.position);
    memcpy(pose.quaternion, b->kea.quaternion, sizeof pose.quaternion);
    return pose;
}
/* The motion of the centre of mass since a pose: displacement, m, and rotation. */
static inline void mdt_bodyMotionSince(const MdtBody *b, const MdtPose *pose, double moved[3], double turned[4]) {
    double back[4];
    keaSubtract(moved, b->kea.position, pose->position);
    keaQuaternionConjugate(back, pose->quaternion);
    keaQuaternionProduct(turned, b->kea.quaternion, back);
}
/* m: the largest radius of gyration. */
static inline double mdt_bodyRadius(const MdtBody *b) {
    const double *I = b->kea.moments;
    return sqrt(fmax(I[0], fmax(I[1], I[2])) * b->kea.invMass);
}

/* The certificate number of bodies that are asleep. */
#define MDT_SLEEPS ((unsigned long)-1)

/* Call it when an input of the body's next step has changed. Ends the body's rest certificate, or, as the next step
 * begins, its sleep. Several threads may call it at once, as they update contacts. */
static inline void mdt_bodyDisturb(MdtBodyID b) {
    if (__atomic_load_n(&b->certificate, __ATOMIC_RELAXED) == 0)
        return;
    __atomic_store_n(&b->calmSteps, 0, __ATOMIC_RELAXED);
    __atomic_store_n(&b->certificate, 0, __ATOMIC_RELAXED);
}

#endif
