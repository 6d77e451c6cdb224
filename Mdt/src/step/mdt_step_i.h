/* Inside Mdt: the working data of a partition in a step, and the stages of the step.
 *
 *     stage       file              reads -> writes
 *     partition   mdt_island.c      bodies, constraints -> the world's partitions; wakes what is tied to awake bodies
 *     rest        mdt_sleep.c       motion of the last step -> bodies that are put to sleep
 *                 mdt_rest.c        what has changed since the last step -> partitions whose last answer holds again
 *     pack        mdt_pack.c        forces, impulses, gravity -> loads of Kea's bodies; scratch, start
 *                 mdt_choice.c      records of partitions -> which of Kea's solvers
 *                 mdt_contacts.c    the manifolds of contacts -> kea.manifolds
 *     rows        mdt_rows.c        poses, velocities, parameters of the part -> kea.rows of joints; contacts', by Kea
 *     solve       MdtKeaSolve       kea.rows, kea.manifolds -> their forces; kea.report
 *     integrate   MdtKeaIntegrate   those -> the states of Kea's bodies
 *     unpack      mdt_unpack.c      forces of rows -> constraints; states -> what programs see of bodies
 *
 * mdt_parallel.c takes partitions through these stages: one after the other, or by the world's workers; many of few
 * bodies together, as batches (mdt_batch.c).
 * Rows, solve, integrate and the constraints' part of unpack are repeated for every part that a step is taken in
 * (mdt_subdivide.c). A part is the whole step where nothing divides it.
 */
#ifndef MDT_STEP_I_H
#define MDT_STEP_I_H

#include "mdt_manifold_i.h"
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
    double exactWork, fastWork, least; /* multiplications that it has cost so far, and that the exact solver needs */
    double excess;                     /* of the fast solver's last answer */
    MeBool hasDeclined;                /* the exact solver has */
    MeBool hasMet;                     /* there was an impact at the start of a part */
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

static inline MdtJoint *mdt_asJoint(MdtConstraintID c) {
    return mdt_isJoint(c) ? (MdtJoint *)(void *)c : NULL;
}
static inline MdtManifold *mdt_asManifold(MdtConstraintID c) {
    return (MdtManifold *)(void *)c;
}
/* s, by which the part takes the step on. */
static inline double mdt_partTime(const MdtIsland *p) {
    return p->stage == MDT_STAGE_BACK ? -p->parameters.stepsize : p->parameters.stepsize;
}
static inline MeBool mdt_bounces(const MdtBclContactParams *params) {
    return (params->options & MdtBclContactOptionBounce) && params->restitution > 0;
}
/* ---- the stages -------------------------------------------------------------------------------------------------- */

/* Pack, the parts, and unpack: moves a partition on by its h (mdt_step.c). */
void mdt_islandStep(MdtIsland *p);
/* All partitions of a step, by its workers (mdt_parallel.c); one of them. */
void mdt_islandsStep(MdtWorldID w, double h, MeBool safely);
void mdt_islandTake(MdtIsland *p, MeBool safely);
/* Moves the world on by h seconds; safely: each partition by what its safe time allows of them. */
void mdt_worldStep(MdtWorldID w, double h, MeBool safely);
/* Rows and solve, of a part of the step of these seconds. Nothing has moved yet: it may be thrown away. */
void mdt_partSolve(MdtIsland *p, double part);
/* The same by itself: rows; impacts of a timed part, and solve. */
void mdt_partMakeRows(MdtIsland *p, double part);
void mdt_partSolveRows(MdtIsland *p);
/* Integrate, and unpack of the constraints; writes isStopped. */
void mdt_partIntegrate(MdtIsland *p);

/* A partition of this step, to be moved on by h seconds; shows it, and those before it, to the program's callback. */
MdtIsland mdt_islandOf(MdtWorldID w, int number, double h);
void mdt_islandShow(const MdtIsland *p);

/* Whether the world puts the partition to rest; that it rests (mdt_sleep.c). */
MeBool mdt_islandIsToSleep(const MdtIsland *p);
void mdt_islandSleep(const MdtIsland *p);

/* The rest certificate (mdt_rest.c): a step begins; whether a partition's last answer holds again; taking it, instead
 * of all other stages. */
void mdt_restBegin(MdtWorldID w);
MeBool mdt_restHolds(const MdtIsland *p);
void mdt_restKeep(MdtIsland *p);
/* Whether this step's answer may hold in the next one; then its bodies stay where they were, and get a certificate. */
MeBool mdt_restIsSettled(MdtIsland *p);
void mdt_restStay(MdtIsland *p);
void mdt_restCertify(MdtIsland *p, MeBool isSettled);
/* Whether a partition has a certificate, or gets one by itself if it is calm in one step more; counts the calm steps of
 * a batch's members. */
MeBool mdt_restIsNear(const MdtWorld *w, int partition);
void mdt_restCountCalm(MdtIsland *p);
/* The parameters of its constraints are what it rests with; whether those of a body still are, of which programs may
 * have changed some without a word. */
void mdt_restCertifyConstraints(const MdtIsland *p);
MeBool mdt_restAreConstraintsAsCertified(MdtBodyID b);

/* Finds the batches of a step, with a team's help unless it is null; such a one; takes it, instead of its members'
 * steps (mdt_batch.c). */
void mdt_batchesFind(MdtWorldID w, double h, MeBool safely, MeTeam *team);
MdtIsland mdt_batchOf(MdtWorldID w, int batch, double h);
void mdt_batchTake(MdtIsland *p);
static inline MeBool mdt_isInBatch(const MdtWorld *w, int partition) {
    return w->batches.count > 0 && w->batches.isIn[partition];
}

/* The rows that the partition's joints and contacts have as they are now. */
int mdt_rowsCount(MdtIsland *p);
/* Counts joints and contacts, before the choice of a solver. */
void mdt_islandCount(MdtIsland *p);
/* Takes scratch memory, and loads into Kea's bodies. False, with a message: the partition is too large. */
MeBool mdt_islandPack(MdtIsland *p);
void mdt_islandRelease(MdtIsland *p);
/* Which of Kea's solvers takes the parts from now on. The scratch memory that was taken for the exact one is enough for
 * the fast one. */
void mdt_islandSetFast(MdtIsland *p, MeBool isFast);

/* ---- the choice of solver (mdt_choice.c) ---- */

/* A step, or another part of one, begins: asks the program for the solver of each partition (MdtWorldSetSolverCB),
 * gives out shares of exact work; and ends. What the program wants for one. */
void mdt_choicesBegin(MdtWorldID w, MeBool isStep);
void mdt_choicesEnd(MdtWorldID w);
MdtSolver mdt_choiceWanted(const MdtWorld *w, int partition);
/* A partition's record gets what is known of one that it had bodies in. */
void mdt_recordJoin(MdtIslandRecord *to, const MdtIslandRecord *from);
/* Whether Kea's fast solver begins the step; writes why. */
MeBool mdt_choiceIsFast(MdtIsland *p);
/* Whether nothing in it touches the world. */
MeBool mdt_choiceIsInFlight(const MdtIsland *p);
/* Multiplications that a step of it may cost; 0: any number. Whether the exact solver has begun the step with a share
 * of exact work, and may decline it. */
double mdt_choiceBudget(const MdtIsland *p);
MeBool mdt_choiceHasShare(const MdtIsland *p);
/* The fast solver takes the rest of the step from the exact one. */
void mdt_choiceTakeOver(MdtIsland *p);
/* Whether the exact solver takes a part that the fast one has solved, since its answer does not meet the accuracy; it
 * does. */
MeBool mdt_choiceTurns(const MdtIsland *p);
void mdt_choiceTurn(MdtIsland *p);
/* The step has ended: writes what is known of it to the record, its own or that of a member. */
void mdt_choiceNote(const MdtIsland *p, MdtIslandRecord *r);

/* ---- contacts, as Kea takes them (mdt_contacts.c) ---- */

/* How many manifolds of Kea's a group's are; the bytes that so many of a partition need; where these are. */
int mdt_contactsCount(const MdtManifold *first);
size_t mdt_contactsSize(int count);
void mdt_contactsLayOut(MdtIsland *p, void *memory, int count);
/* For the step: a group's manifolds, from that one on; returns the next one, and adds what is wrong with their
 * surfaces. For a part of it that is not the first, of the fast solver: where points are. */
int mdt_contactsPack(const MdtIsland *p, const MdtManifold *first, int at, int *problems);
void mdt_contactsCarry(MdtIsland *p);
/* This share of their forces is added to what the step has done; these are the points' forces, and whether they are a
 * guess at those of the next part. */
void mdt_contactsAddForces(MdtIsland *p, double share);
void mdt_contactsClearForces(MdtIsland *p);
void mdt_contactsUnpack(MdtIsland *p, MeBool isGuess);
double mdt_contactsPenetration(const MdtIsland *p);

/* Takes the step in parts, within its budget of work, until its bodies are stopped (mdt_subdivide.c). */
void mdt_islandSubdivide(MdtIsland *p);
/* How many bodies may be held, at most, in a partition whose impacts are met in time, one after the other; 0: none. */
int mdt_mostHeld(const MdtIsland *p);
/* A part of the step begins: its parameters, Kea's arrays; bodies meet in it; it has been integrated. */
void mdt_partBegin(MdtIsland *p, double part);
void mdt_partImpact(MdtIsland *p);
void mdt_partEnd(MdtIsland *p);
/* Takes a part, which so many halvings have made, in halves where its motion is violent; the same when its rows are
 * made. */
void mdt_partTake(MdtIsland *p, double part, int halvings);
void mdt_partTakeMade(MdtIsland *p, double part, int halvings);
/* Whether parts may be taken in stages of order 4; takes one so, as far as that goes (mdt_compose.c). */
MeBool mdt_mayCompose(const MdtIsland *p);
void mdt_partCompose(MdtIsland *p, double part);
/* The budget of a solve; the cost of the last one. */
void mdt_budgetGrant(MdtIsland *p);
void mdt_budgetDraw(MdtIsland *p);

/* Makes the rows of a part, after MdtKeaInit (mdt_rows.c). */
void mdt_rowsMake(MdtIsland *p);
/* For Kea: the rows of joints, and their errors, were the bodies elsewhere. The context is the island. */
void MEAPI mdt_rowsMove(void *island, const MdtKeaTransformation poses[]);
void MEAPI mdt_rowsErrors(void *island, const MdtKeaTransformation poses[], double errors[]);
/* The system as a constraint sees it in this part, but for its first row. */
void mdt_rowsContext(const MdtIsland *p, MdtConstraintID c, const MdtKeaVelocity *worldVelocity, MdtBclContext *x);
/* Leaves out rows of contacts until the partition, which has that many, has at most `most`, in the documented order
 * (mdt_cap.c). Returns how many it has then. */
int mdt_capRows(MdtIsland *p, int rows, int most);

/* Constraints of any kind: their forces are empty; the impulses of an impact, those of a part count among them; read
 * back. */
void mdt_unpackBegin(MdtIsland *p);
void mdt_unpackImpact(MdtIsland *p);
void mdt_unpackConstraints(MdtIsland *p);
/* Bodies, at the end of the step. */
void mdt_unpackBodies(MdtIsland *p);
/* Fallback: bodies whose next state is not finite keep their pose, with velocity 0. */
void mdt_unpackStopped(MdtIsland *p);

/* ---- steps by safe time (mdt_lag.c) ------------------------------------------------------------------------------ */

/* How far a partition may move: the shortest safe time of its bodies, within bounds. */
double mdt_lagSafeStep(const MdtIsland *p);
/* The partition has advanced by h: subtracts it from the lag of its bodies. */
void mdt_lagSet(const MdtIsland *p, double lack);

#endif
