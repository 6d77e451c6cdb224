/* Inside Mdt: the working data of a partition in a step, and how partitions are found, put to rest and to sleep. The
 * stages of the step are in mdt_step_i.h.
 */
#ifndef MDT_ISLAND_I_H
#define MDT_ISLAND_I_H

#include "record/mdt_point_i.h"
#include <float.h>

/* Beside each manifold of Kea's: whose points it has. */
typedef struct MdtIslandManifold {
    /* pack */
    MdtPoint *point[MdtKeaMANIFOLDPOINTS];
    /* unpack */
    double mean[MdtKeaMANIFOLDPOINTS][3]; /* N, of the parts of the step that are done, on the first body */
} MdtIslandManifold;

/* Whether a part is a stage of order 4 (mdt_compose.c), and in which direction of time. */
typedef enum MdtStage { MDT_STAGE_NONE, MDT_STAGE_FORWARD, MDT_STAGE_BACK } MdtStage;

/* One partition in one step. Each group of fields names its only writer. */
typedef struct MdtIsland {
    /* mdt_islandOf; mdt_parallel.c */
    MdtWorldID world;
    MdtWorker *worker; /* the worker that steps it, */
    MeTeam *team;      /* and the team that helps; null: none */
    int number, numBodies, numActing;
    MdtSolver solver;        /* that the program wants */
    MdtIslandRecord *record; /* what is kept of it from step to step */
    MdtBodyID *bodies;
    MdtConstraintID *acting; /* joints and manifolds */
    /* mdt_batch.c */
    const MdtMember *member; /* partitions that it is made of; */
    int numMembers;          /* 0: it is one */
    double whole;            /* s, the argument of MdtWorldStep */
    /* mdt_step.c, mdt_lag.c */
    double h; /* s, by which the partition is moved on: `whole`, or what its safe time allows of it */
    /* mdt_report.c */
    MdtReport *report;     /* null: it is off */
    MeBool isTimedByStage; /* else together with others */
    MeU64 lap, *clock;     /* ticks, when the stage began that is being timed: the world's, or of many workers `lap` */
    /* pack */
    void *scratch;                         /* Kea's arrays, and behind them */
    MeBool isFast;                         /* Kea's fast solver is chosen, or has taken over (mdt_subdivide.c); */
    MdtReportWhy why;                      /* also mdt_batch.c, mdt_choice.c */
    int numContacts, numJoints, jointRows; /* of all joints, at most */
    MeBool hasUserRows;                    /* a joint's rows are the program's */
    MeBool mayBeFast;                      /* the fast solver is able to take it */
    MeBool bounces, losesEnergy;           /* a contact has restitution; one has less than 1 */
    MdtIslandManifold *manifolds;          /* beside kea.manifolds */
    MdtKeaSystem kea; /* its parameters: mdt_subdivide.c; its arrays and answers: rows, MdtKea; its bodies:
                                     mdt_islandOf, mdt_batch.c */
    /* subdivide */
    MdtBclSolverParameters parameters; /* of the part that is being taken */
    double elapsed;                    /* s, of the step before that part */
    double work;                       /* multiplications that the step may still cost; MDT_NO_BOUND: any number */
    int iterations;                    /* of Newton's method, the same; 0: any number */
    double exactWork, fastWork, min;   /* multiplications that it has cost so far, and that the exact solver needs */
    double excess;                     /* of the fast solver's last answer */
    MeBool hasDeclined;                /* the exact solver has */
    MeBool hadImpact;                  /* there was an impact at the start of a part */
    MeBool isStopped;                  /* mdt_step.c: the part's answer was not finite, and its bodies stay */
    /* mdt_compose.c */
    MdtStage stage;
    double forward; /* the sum of the stages that go forward, over the part that they make up */
    /* rows */
    MeBool isDegenerate; /* some joint was in this step */
    int numRows;         /* of the part: of joints, and that the contacts have, or would have for the exact solver */
    MeBool isCapped;     /* contacts, or their friction, were left out */
} MdtIsland;

#define MDT_NO_BOUND DBL_MAX

/* Bodies, or manifolds, that a worker takes at a time: .5 us each in pack, against 1 to begin and end a loop. With half
 * as many and twice as many, a heap of 1000 boxes takes the same time, within 5 % (bench/threads). */
enum { MDT_RANGE = 64 };

/* Bodies, or constraints, ahead of the one that a loop works on, whose memory is asked for: as KEA_AHEAD, with which it
 * was measured. */
enum { MDT_AHEAD = 4 };

/* s, by which the part takes the step on. */
static inline double mdt_substepTime(const MdtIsland *p) {
    return p->stage == MDT_STAGE_BACK ? -p->parameters.stepsize : p->parameters.stepsize;
}
static inline MeBool mdt_bounces(const MdtBclContactParams *params) {
    return (params->options & MdtBclContactOptionBounce) && params->restitution > 0;
}
static inline MeBool mdt_isInBatch(const MdtWorld *w, int partition) {
    return w->batches.count > 0 && w->batches.isIn[partition];
}

/* ---- partitions (mdt_island.c) ---- */

/* Finds the partitions of this step; bodies tied to awake ones wake. The graph stays as it is until the
 * end: what the program calls for in its callbacks is done then. */
void mdt_islandsBegin(MdtWorldID w);
void mdt_islandsEnd(MdtWorldID w);
/* Makes the lists of their constraints for programs; what programs see of one partition then: it is not disabled. */
void mdt_islandsList(MdtWorldID w);
MdtPartitionInfo mdt_islandInfo(MdtWorldID w, int p);
/* A partition of this step, to be moved on by h seconds; shows it, and those before it, to the program's callback. */
MdtIsland mdt_islandOf(MdtWorldID w, int number, double h);
void mdt_islandShow(const MdtIsland *p);

/* ---- sleep (mdt_sleep.c) ---- */

void mdt_bodySleep(MdtBodyID b);
/* Wakes the sleepers of which an input has changed since they fell asleep, before a step of h seconds. */
void mdt_sleepersWake(MdtWorldID w, double h);
/* The forces of those that sleep on are over with the step. */
void mdt_sleepersEndForces(MdtWorldID w);
/* All sleepers, as something has changed that concerns each of them. */
void mdt_sleepersWakeAll(MdtWorldID w);

/* Whether the world puts the partition to rest; that it rests. */
MeBool mdt_islandIsToSleep(const MdtIsland *p);
void mdt_islandSleep(const MdtIsland *p);

/* ---- the rest certificate (mdt_certificate.c) ---- */

/* A step begins; whether a partition's last answer holds again; taking it, instead
 * of all other stages. */
void mdt_certificatesBegin(MdtWorldID w);
MeBool mdt_certificateIsValid(const MdtIsland *p);
void mdt_certificateApply(MdtIsland *p);
/* Whether this step's answer may hold in the next one; then its bodies stay where they were, and get a certificate. */
MeBool mdt_islandIsSettled(MdtIsland *p);
void mdt_islandResetPoses(MdtIsland *p);
void mdt_islandCertify(MdtIsland *p, MeBool isSettled);
/* Whether a partition has a certificate, or gets one by itself if it is calm in one step more; counts the calm steps of
 * a batch's members. */
MeBool mdt_certificateIsNear(const MdtWorld *w, int partition);
void mdt_membersCountCalm(MdtIsland *p);
/* The parameters of its constraints are what it rests with; whether those of a body still are, of which programs may
 * have changed some without a word. */
void mdt_constraintsCertify(const MdtIsland *p);
MeBool mdt_areConstraintsCertified(MdtBodyID b);

#endif
