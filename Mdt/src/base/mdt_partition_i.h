/* Inside Mdt: what a world keeps of its partitions, and of the workers that step them. */
#ifndef MDT_PARTITION_I_H
#define MDT_PARTITION_I_H

#include "base/mdt_base_i.h"
#include "MeChunk.h"
#include "MeTeam.h"

enum { MDT_TIMED_BODIES = 8, MDT_NO_REPORTS = -1 };
/* Bodies, at least, that make batches (mdt_batch.c), partitions that all workers take together (mdt_parallel.c), and
 * islands of which impacts that take energy are followed only while all fly (mdt_maxConstrained). */
enum { MDT_LARGE_ISLAND = 64 };
/* One of so many bodies that bounce may be held, for their impacts to be met in time. Measured, and no test tells 4
 * from 8: 216 balls a hundredth apart that land with 4 m/s lose 4, 4, 2 and 14 % of the energy in 5 s with 2, 4, 8, 16,
 * those a fiftieth apart .2 % with each. */
enum { MDT_CONSTRAINED_SHARE = 4 };
/* Of a body's size: how far joints may be open at rest. As much as overlaps may be there. */
#define MDT_MAX_JOINT_ERROR 1e-4

/* A world's accounts of exact work (mdt_choice.c). */
typedef enum MdtAccount { MDT_OPTIONAL, MDT_NEEDED, MDT_ACCOUNTS } MdtAccount;

/* What is known of a partition from step to step (mdt_choice.c). */
typedef struct MdtIslandRecord {
    int steps;       /* that it has taken by the engine's choice, up to 2 */
    float exactWork; /* multiplications that an exact step takes, a body; 0: none was taken */
    float fastWork;  /* those of the exact solver in the time of a fast step, a body */
    MeBool hasNoContacts;
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
typedef struct MdtCertificateInputs {
    double h, gravity[3], epsilon, gamma, workBudget, accuracy;
    MdtContactImportanceCBPtr importance;
    int maxLcpIterations, subSteps, timedBodies, maxMatrixSize, solver, order;
} MdtCertificateInputs;

/* A worker's own memory while it steps partitions, and its results that concern all of them. */
typedef struct MdtWorker {
    MeChunk scratch, ranking; /* of Kea and contacts; of contacts, to rank them */
    MdtKeaCache *keaCache;
    MeMessageBuffer messages; /* by partition */
    int surfaceProblems;      /* of contacts that it packed (MdtContactParams.c) */
} MdtWorker;

#endif
