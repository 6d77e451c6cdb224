/* Inside Mdt: the working data of a partition in a step; finding partitions, rest certificates, sleep. The stages of
 * the step are in mdt_step_i.h. */
#ifndef MDT_ISLAND_I_H
#define MDT_ISLAND_I_H

#include "record/mdt_point_i.h"
#include <float.h>

/* Parallel to each of Kea's manifolds: its source points. */
typedef struct MdtIslandManifold {
    /* pack */
    MdtPoint *point[MdtKeaMANIFOLDPOINTS];
    /* unpack */
    double mean[MdtKeaMANIFOLDPOINTS][3];     /* N, mean force on the first body over the finished parts of the step */
    double declined[MdtKeaMANIFOLDPOINTS][3]; /* N, by point: forces of an exact answer that was declined */
} MdtIslandManifold;

/* Whether a part of a step is a stage of the scheme of order 4 (mdt_compose.c), and its direction in time. */
typedef enum MdtStage { MDT_STAGE_NONE, MDT_STAGE_FORWARD, MDT_STAGE_BACK } MdtStage;

/* One partition in one step. Each group of fields is written by the file or stage that is named before it. */
typedef struct MdtIsland {
    /* written by mdt_islandOf, mdt_parallel.c */
    const MdtWorld *world; /* read only: several workers step partitions at once */
    MdtWorker *worker;     /* the worker that steps it */
    MeTeam *team;          /* the team that helps; null: none */
    int number, numBodies, numActing;
    MdtSolver solver;        /* requested by the program */
    MdtIslandRecord *record; /* the partition's state from step to step */
    MdtBodyID const *bodies;
    MdtConstraintID const *acting; /* joints and manifolds */
    /* mdt_batch.c */
    const MdtMember *member; /* the partitions of a batch */
    int numMembers;          /* 0: it is a single partition */
    double whole;            /* s, the step that the program requested (MdtWorldStep) */
    /* mdt_step.c, mdt_lag.c */
    double h;        /* s, time of the partition's step: `whole`, or less if limited by safe times */
    double late;     /* s, from the start of the movers' step to that of the partition's */
    MeBool isPushed; /* its bodies are at rest but for what movers do to them: no forces act */
    /* mdt_report.c */
    MdtReport *report;     /* null: the report is off */
    MeBool isTimedByStage; /* false: small partitions are timed together */
    MdtTiming *timing;     /* the world's, if partitions are stepped in order; null: `lap` times it alone */
    MeU64 lap;             /* ticks at the start of the stage that is being timed */
    /* pack */
    void *scratch;    /* scratch memory: Kea's arrays, then further ones */
    MeBool isFast;    /* Kea's fast solver solves it; also written by mdt_path.c */
    MdtReportWhy why; /* why that solver solves it; also written by mdt_batch.c, mdt_choice.c */
    int numContacts, numJoints;
    int jointRows, contactRows;   /* upper bounds, of all joints and of all contacts */
    MeBool hasUserRows;           /* a callback of the program makes some joint's rows */
    MeBool mayBeFast;             /* the fast solver can solve it */
    MeBool bounces, losesEnergy;  /* some contact has restitution; some restitution is below 1 */
    MdtIslandManifold *manifolds; /* parallel to kea.manifolds */
    MdtKeaSystem kea; /* parameters written by mdt_subdivide.c; arrays and answers by rows and MdtKea; bodies by
                                     mdt_islandOf, mdt_batch.c */
    /* subdivide */
    MdtBclSolverParameters parameters; /* parameters of the present part */
    double elapsed;                    /* s, of the step before the present part */
    MeBool isHalved;                   /* passes of a longer part have not converged */
    double work;                       /* multiplications left for the step; MDT_NO_BOUND: unlimited */
    int iterations;                    /* iterations of Newton's method left for the step; 0: unlimited */
    double exactWork, fastWork;        /* multiplications: cost so far of either solver */
    double declinedWork;               /* of exactWork: that of a declined solve that is made again */
    double minExactWork;               /* multiplications: lower bound of what a declined solve would cost */
    double excess;                     /* MdtReport.excess of the fast solver's last answer */
    MeBool hasDeclined;                /* the exact solver has declined the step */
    MeBool hadImpact;                  /* there was an impact at the start of a part */
    MeBool isStopped; /* the part's answer was not finite, and its bodies stay; written by mdt_step.c */
    /* mdt_compose.c */
    MdtStage stage;
    double forward; /* total length of the forward stages, relative to the part that they compose */
    /* rows */
    MeBool isDegenerate; /* some joint was degenerate in this step */
    int numRows;         /* rows of joints and contacts in the part, counted as for the exact solver */
    MeBool isCapped;     /* the cap left out contacts or their friction */
} MdtIsland;

#define MDT_NO_BOUND DBL_MAX

/* Bodies, or manifolds, per range of a parallel loop: .5 us each in pack, against 1 us to start and end a loop. With
 * half or twice the number a heap of 1000 boxes takes the same time within 5 % (bench/threads). */
enum { MDT_RANGE = 64 };

/* Prefetch distance: bodies, or constraints, ahead of the one that a loop processes. The same as KEA_AHEAD, which was
 * measured. */
enum { MDT_AHEAD = 4 };

/* s: signed time of the present part; negative for a backward stage. */
static inline double mdt_substepTime(const MdtIsland *p) {
    return p->stage == MDT_STAGE_BACK ? -p->parameters.stepsize : p->parameters.stepsize;
}
/* Iterates over the partition's joints: the first one from index *i on, with *i set behind it; null after the last. */
static inline MdtJoint *mdt_nextJoint(const MdtIsland *p, int *i) {
    MdtJoint *j = NULL;
    while (!j && p->numJoints > 0 && *i < p->numActing)
        j = mdt_asJoint(p->acting[(*i)++]);
    return j;
}
static inline MeBool mdt_hasRestitution(const MdtBclContactParams *params) {
    return (params->options & MdtBclContactOptionBounce) && params->restitution > 0;
}
static inline MeBool mdt_isInBatch(const MdtWorld *w, int partition) {
    return w->batches.count > 0 && w->batches.isIn[partition];
}

/* ---- partitions (mdt_island.c) ---- */

/* Finds the partitions of this step, and wakes bodies that are connected to awake ones. The graph does not change until
 * mdt_islandsEnd: changes that callbacks make are deferred. */
void mdt_islandsBegin(MdtWorldID w);
void mdt_islandsEnd(MdtWorldID w);
/* Lists the constraints of all partitions for programs. mdt_islandInfo: the public description of one, enabled. */
void mdt_islandsList(MdtWorldID w);
MdtPartitionInfo mdt_islandInfo(const MdtWorld *w, int p);
/* The working data of a partition, for a step of h seconds. mdt_islandShow passes the partition to the program's
 * callback, together with those before it. */
MdtIsland mdt_islandOf(const MdtWorld *w, int number, double h);
void mdt_islandShow(MdtWorldID w, int number);

/* ---- sleep (mdt_sleep.c) ---- */

void mdt_bodySleep(MdtBodyID b);
/* Wakes sleeping bodies whose inputs have changed since they fell asleep. At the start of a step of h seconds. */
void mdt_sleepersWakeChanged(MdtWorldID w, double h);
/* Ends the forces that were added for this step to bodies that sleep on. */
void mdt_sleepersEndForces(MdtWorldID w);
/* Ends the certificates of all sleeping bodies, so that they wake when the next step begins. */
void mdt_sleepersWakeAll(MdtWorldID w);

/* True if the partition is to fall asleep by the world's rule. mdt_islandSleep puts it to sleep. */
MeBool mdt_islandIsToSleep(const MdtIsland *p);
void mdt_islandSleep(const MdtIsland *p);

/* ---- the rest certificate (mdt_certificate.c) ---- */

/* mdt_certificatesBegin, at the start of a step, compares the world's inputs. mdt_certificateIsValid: true if the last
 * answer of a partition holds again. mdt_certificateApply uses it, in place of all other stages. */
void mdt_certificatesBegin(MdtWorldID w);
MeBool mdt_certificateIsValid(const MdtIsland *p);
void mdt_certificateApply(const MdtIsland *p);
/* True if this step's answer may hold in the next one; then the bodies are reset to their poses at the step's start,
 * and get a certificate. */
MeBool mdt_islandIsSettled(MdtIsland *p);
void mdt_islandResetPoses(const MdtIsland *p);
void mdt_islandCertify(const MdtIsland *p, MeBool isSettled);
/* True if all bodies of a partition have a certificate, or would get one after another calm step. mdt_membersCountCalm
 * counts calm steps of a batch's members. */
MeBool mdt_certificateIsNear(const MdtWorld *w, int partition);
void mdt_membersCountCalm(MdtIsland *p);
/* Stores the hashes of the parameters of a partition's constraints; compares those of a body's constraints that
 * programs may have changed. */
void mdt_constraintsCertify(const MdtIsland *p);
MeBool mdt_areConstraintsCertified(MdtBodyID b);
MeBool mdt_jointIsCertified(const MdtJoint *j); /* the same of one joint */
void mdt_jointCertify(MdtJoint *j);

#endif
