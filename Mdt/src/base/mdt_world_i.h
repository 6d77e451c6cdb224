/* Inside Mdt: the record of a world, which owns all others. */
#ifndef MDT_WORLD_I_H
#define MDT_WORLD_I_H

#include "base/mdt_manifold_i.h"
#include "base/mdt_partition_i.h"

struct MdtWorld {
    unsigned int magic;
    MdtWorldParams params;
    MdtPartitionParams sleepParams;
    MeBool hasVelThresh, hasAccThresh; /* of `sleepParams`, the program has set them, */
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
    MeBool isCentreWarned;   /* and has, */
    MeBool isScaleWarned;    /* and has of the mass scale */
    double sinkingMass;      /* kg, of which it warns */
    int breakable;           /* constraints with a limit */
    int numNoCollide;        /* joints whose bodies do not collide with each other */
    int userConstraints;     /* whose rows a function of the program makes */
    MdtConstraintID *broken; /* in the last step; constraintRoom */
    int numBroken;
    MdtBreakCBPtr breakCb; /* null: none */
    double lastStep;       /* s, 0 before the first */
    struct {
        MeBool isOver;                      /* gravity was set, something has acted, or the warning was given */
        double time;                        /* s, in which nothing has acted on the bodies, */
        unsigned long sum;                  /* which were as many, and where they are now */
    } idle;                                 /* mdt_idle.c */
    unsigned long certificate;              /* of rest, valid now (mdt_certificate.c) */
    double calmStepsToCertify;              /* after which it is given */
    MdtCertificateInputs certificateInputs; /* with which it was */
    int surfaceWarnings;                    /* MdtContactParams.c: which were given */
    MdtWorker *workers;                     /* numWorkers of them; the first is the thread that steps the world */
    int numWorkers;
    MeTeam *team;  /* null: there is one worker */
    int *taskOf;   /* partitions by task, and where tasks begin among them (mdt_parallel.c) */
    MeStage stage; /* at which of the levels MDT_GUARD_... it is */

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

/* The set of enabled constraints, their bodies, or the order has changed. Creating and destroying do not count: a new
 * constraint is not enabled yet, and one is disabled before it is destroyed. */
static inline void mdt_graphChanged(MdtWorldID w) {
    w->graph.changes++;
}

#endif
