/* Inside Mdt: the data that a world keeps of its partitions, and of the workers that step them. */
#ifndef MDT_PARTITION_I_H
#define MDT_PARTITION_I_H

#include "base/mdt_base_i.h"
#include "MeChunk.h"
#include "MeTeam.h"

enum { MDT_TIMED_BODIES = 8, MDT_NO_REPORTS = -1 };
/* Minimum number of bodies of batches (mdt_batch.c), which share the cost of setting up a solve: 600 tumbling or
 * rolling bodies take 2 % more instructions with half of it, 1 % fewer with twice of it. Also of partitions that all
 * workers step together (mdt_parallel.c), and of islands whose inelastic impacts are timed only while all bodies are in
 * flight (mdt_maxConstrained). */
enum { MDT_LARGE_ISLAND = 64 };
/* Islands with restitution are timed if touching contacts hold at most one in so many of their bodies. Measured, but no
 * test distinguishes 4 from 8: 216 balls a hundredth apart that land with 4 m/s lose 4, 4, 2 and 14 % of the energy in
 * 5 s balls a fiftieth apart .2 % with each. */
enum { MDT_CONSTRAINED_SHARE = 4 };
/* Largest error of joints at rest, relative to the size of a body. The same as for overlaps. */
#define MDT_MAX_JOINT_ERROR 1e-4

/* A world's accounts of exact work (mdt_choice.c): one for optional exact steps, one for needed ones. */
typedef enum MdtAccount { MDT_OPTIONAL, MDT_NEEDED, MDT_ACCOUNTS } MdtAccount;

/* Classes of partitions, by which shares of exact work are assigned (mdt_choice.c). */
typedef enum MdtShareClass {
    MDT_NO_NEED,     /* no constraints act on it, or the program has chosen */
    MDT_CERTIFIED,   /* will be solved only if an input has changed */
    MDT_FIRST,       /* in its first steps: the cost of a step with warm start is unknown */
    MDT_LOST,        /* the fast solver's answer is worthless */
    MDT_UNMET,       /* the fast solver missed the accuracy, or does not suit it */
    MDT_STAYS_EXACT, /* no need, and the exact solver solved the last step */
    MDT_STAYS_FAST   /* no need, and the fast solver solved the last step */
} MdtShareClass;

/* The state that a partition keeps from step to step (mdt_choice.c). */
typedef struct MdtIslandRecord {
    int steps;           /* steps with the automatic choice of solver, counted up to 2 */
    float exactWork;     /* multiplications of an exact step per body; 0: not measured yet */
    float fastWork;      /* per body: multiplications of the exact solver that take the time of a fast step */
    MdtSolver requested; /* the last answer of MdtSolverCB, if there is one */
    MeBool hasNoContacts;
    MeBool isUnfit; /* the fast solver does not suit it: there are no contacts, or bodies bounce */
    float excess;   /* of the fast solver's last answer (MdtReport.excess): above 1 it missed the accuracy */
    int stepsUntilRetry,
        stepsSinceTry; /* steps to wait before the fast solver is tried again; steps since its last try */
    MeBool wasExact;   /* the exact solver solved the last step */
    float crushed;     /* s left in which movers count as leaving bodies no room (mdt_crush.c) */
    /* fields of this step */
    MdtShareClass shareClass;
    MeBool isExactFirst; /* the exact solver is tried first */
    MdtAccount account;  /* the account that pays the exact work */
    double share;        /* multiplications that the exact solver may use */
    double reserve;      /* multiplications that it may use besides if the fast solver's answer is worthless */
    double drawn, loan;  /* parts of `share`: from `account`, and lent by MDT_NEEDED; after the step, what is unused */
} MdtIslandRecord;

/* A member of a batch: a partition that is solved together with others, and where its bodies and acting constraints
 * begin in the batch's arrays. */
typedef struct MdtMember {
    int partition, firstBody, firstActing;
} MdtMember;

/* The batches of a step (mdt_batch.c). */
typedef struct MdtBatches {
    int bodyRoom, actingRoom;
    int count, numMembers;
    int *firstMember;        /* by batch: index of its first member; with an end entry */
    MdtMember *member;       /* the members of all batches, one batch after the other; with an end entry */
    MeBool *isIn;            /* by partition: whether it is in a batch; valid if there are batches */
    MdtBodyID *body;         /* the bodies of the members */
    MdtKeaBody **kea;        /* parallel to `body` */
    MdtConstraintID *acting; /* constraints that act on them */
} MdtBatches;

/* Bodies and the constraints between them, as of when the partitions were last found (mdt_island.c). */
typedef struct MdtGraph {
    unsigned long changes; /* number of changes of the graph or its order (mdt_graphChanged) */
    unsigned long seen;    /* `changes` when the partitions were last found */
    int numBodies, numActing;
    MdtBodyID *body;         /* by place (MdtBody.place); capacity bodyRoom */
    int *parent;             /* by place: parent in the union-find forest */
    MeBool *isEnabled;       /* by place: whether the body is enabled */
    MeBool *isAwake;         /* by place of the first body of a set: whether some body of the set is awake */
    int *partition;          /* by place: copy of MdtBody.partition that stays in the cache */
    MdtConstraintID *acting; /* enabled joints and manifolds; capacity constraintRoom */
    int *actsOn;             /* parallel to `acting`: the place of one of the constraint's bodies */
} MdtGraph;

/* The world's parameters that enter the step of any partition. They are compared as bytes, so there is no padding. */
typedef struct MdtCertificateInputs {
    double h, gravity[3], epsilon, gamma, workBudget, accuracy;
    MdtContactImportanceCBPtr importance;
    int maxLcpIterations, subSteps, timedBodies, maxMatrixSize, solver, order;
} MdtCertificateInputs;

_Static_assert(sizeof(MdtCertificateInputs) == 8 * sizeof(double) + sizeof(MdtContactImportanceCBPtr) + 6 * sizeof(int),
               "compared as bytes: no padding");

/* Times of the stages of a step, for partitions that are stepped in order (mdt_report.c). */
typedef struct MdtTiming {
    MeU64 lap;                          /* ticks at the start of the stage that is being timed */
    int firstUntimed;                   /* first of the latest partitions that have no time yet */
    double stageShare[MdtReportStages]; /* fractions of a small partition's time; 0: not measured */
} MdtTiming;

/* The memory of one worker while it steps partitions, and its contributions to the world's results. */
typedef struct MdtWorker {
    MeChunk scratch, ranking; /* memory for Kea and manifolds; for ranking contacts (mdt_cap.c) */
    MdtKeaCache *keaCache;
    MeMessageBuffer messages; /* messages of its partitions, to be sent in the order of all partitions */
    int surfaceProblems;      /* incomplete friction settings of the contacts that it packed (MdtContactParams.c) */
} MdtWorker;

#endif
