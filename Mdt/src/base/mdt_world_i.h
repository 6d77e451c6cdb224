/* Inside Mdt: the record of a world, which owns all others. */
#ifndef MDT_WORLD_I_H
#define MDT_WORLD_I_H

#include "base/mdt_manifold_i.h"
#include "base/mdt_partition_i.h"

struct MdtWorld {
    unsigned int magic;
    MdtWorldParams params;
    MdtPartitionParams sleepParams;
    MeBool hasVelThresh, hasAccThresh; /* the program has set these fields of `sleepParams` */
    MeBool hasThresholds;              /* the program has set any threshold */
    MeReal epsilon, gamma, minSafeTime;
    int maxLcpIterations;
    MeReal workBudget; /* millions of multiplications per step of a partition; 0: unlimited */
    MdtSolver solver;
    MdtSolverCB solverCb; /* null: `solver` holds for all partitions */
    void *solverCbData;
    MeBool isSolverWarned; /* the warning about an invalid result of solverCb was given */
    MeReal accuracy;       /* m/s; negative: derived from gravity and the step */
    int subSteps;
    int order;         /* order of the integration scheme: 2, or 4 for partitions without contacts (mdt_compose.c) */
    int timedBodies;   /* largest number of bodies of partitions with timed contacts */
    int maxMatrixSize; /* cap on the rows of a partition */
    MdtContactImportanceCBPtr importance;         /* null: the deepest contacts matter most */
    int *sizeLog, sizeLogLength;                  /* owned by the program; null: none */
    MdtBodyHandler bodyEnabled, bodyDisabled;     /* the program's; null: none */
    MdtBodyHandler modelsEnabled, modelsDisabled; /* Mst's, called before the program's; null: none */
    const MdtBodyUser *bodyUser;                  /* callbacks of the owner of bodies' models (Mst); null: none */
    MdtPartitionEndCB partitionCb;                /* null: the world decides which partitions fall asleep */
    void *partitionCbData;
    MdtPartitionOutput output;
    MdtPool bodyPool, hiddenPool, jointPool, manifoldPool, extraPool;
    MdtMover *movers;            /* the newest one first */
    MdtList bodies, constraints; /* constraints: joints, and manifolds except those that continue a group */
    MeLimit constraintLimit;     /* for numConstraints: joints, groups and contacts together */
    int numConstraints;
    MdtSurfaces surfaces;
    unsigned long nextSerial;
    int enabledBodies, asleepBodies, enabledConstraints;
    int enabledJoints;       /* how many of the enabled constraints are joints */
    int watchedSteps;        /* steps that mdt_forgotten.c has watched */
    MeBool expectsCentre;    /* mdt_forgotten.c is to check a body for an unset centre of mass */
    MeBool isCentreWarned;   /* the warning about an unset centre of mass was given */
    MeBool isScaleWarned;    /* the warning about the mass scale was given */
    double sinkingMass;      /* kg, the mass that this warning reports */
    int breakable;           /* number of constraints with a break limit */
    int numNoCollide;        /* number of joints whose bodies do not collide with each other */
    int userConstraints;     /* number of constraints whose rows a callback of the program makes */
    int mimics;              /* number of mimics, whose joints may be destroyed before them */
    MdtConstraintID *broken; /* joints that broke in the last step; capacity constraintRoom */
    int numBroken;
    MdtBreakCBPtr breakCb; /* null: none */
    double lastStep;       /* s, length of the last step; 0 before the first */
    struct {
        MeBool isOver;         /* no more checks: gravity was set, something has acted, or the warning was given */
        double time;           /* s, for which nothing has acted on the bodies */
        unsigned long sum;     /* checksum of the number of bodies and their poses */
    } idle;                    /* mdt_idle.c */
    unsigned long certificate; /* number of the certificate of rest that is valid now (mdt_certificate.c) */
    double calmStepsToCertify; /* calm steps after which bodies are certified */
    MdtCertificateInputs certificateInputs; /* the inputs that the valid certificate holds for */
    int surfaceWarnings;                    /* bit set of the warnings that were given (MdtContactParams.c) */
    MdtWorker *workers; /* array of numWorkers; the first one is of the thread that steps the world */
    int numWorkers;
    MeTeam *team;  /* null: there is only one worker */
    int *taskOf;   /* partitions sorted by task, then where each task begins among them (mdt_parallel.c) */
    MeStage stage; /* current level: MDT_GUARD_... */

    /* Capacities of the arrays of a step, which grow only before a step (mdt_worldReserve). */
    int bodyRoom, constraintRoom;
    MdtGraph graph;
    /* this step's partitions: partition p has the bodies bodyOf[bodyStart[p] .. bodyStart[p+1]), and so on */
    int numPartitions;
    MdtBodyID *bodyOf;
    MdtConstraintID *actingOf;
    MdtKeaBody **keaOf; /* parallel to bodyOf */
    int *bodyStart, *actingStart;
    MdtIslandRecord *record, *lastRecord; /* by partition; lastRecord: of the last step's, while new ones are found */
    double credit[MDT_ACCOUNTS];          /* balance of each account, multiplications (mdt_choice.c) */
    MdtBatches batches;
    /* bodies' constraints by partition as programs see them, with contacts; made on request (mdt_islandsList) */
    MdtConstraintID *constraintOf;
    int *constraintStart;

    MdtDebugDrawOptions debugDraw; /* 0: nothing */

    MeBool isReported;
    MdtReport *reports; /* by partition of the last step; null until the report is first enabled */
    int reportRoom;
    int numReports; /* MDT_NO_REPORTS: the report is off, or there was no step yet */
    MdtTiming timing;

    MeHandle handle;
};

/* The callbacks of the owner of the body's models; null: it has none. */
static inline const MdtBodyUser *mdt_userOf(const MdtBody *b) {
    return b->record.flags & MDT_MODELLED ? b->world->bodyUser : NULL;
}

/* Make a body a mover of its world, or none (mdt_movers.c). False, after a fatal error: no memory. */
MeBool mdt_moverMake(MdtBodyID b, const char *caller);
void mdt_moverFree(MdtBodyID b);

/* Call it when the set of enabled constraints, their bodies, or the order has changed. Creating and destroying does not
 * count: a new constraint is not enabled yet, and one is disabled before it is destroyed. */
static inline void mdt_graphChanged(MdtWorldID w) {
    w->graph.changes++;
}

#endif
