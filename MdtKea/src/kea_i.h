/* Inside Kea: the working data of a step and the functions that its files share.
 *
 *     kea_system.c            memory, predictions, integration: the front door, with MdtKeaSolve and MdtKeaImpact
 *
 *   exact/, a step by Newton's method to the tolerance:
 *     kea_step.c              one step: passes of linearization, then the velocity stage
 *     kea_scheme.c            where unknown velocities take the bodies, the momentum that is missing, its derivative
 *     kea_contact.c           rows of contacts, from manifolds; kea_anchor.c: where these are
 *     kea_rows.c              linearization of rows; theta
 *     kea_dual.c              the inner problem by the joints' side
 *     kea_redundancy.c        of redundant joints' impulses, the smallest
 *     kea_velocity.c          the velocity stage: what joints and contacts allow where the bodies have arrived
 *     kea_events.c            what divides a step of contacts in time
 *
 *   fast/, a step by passes over manifolds (fast/kea_fast_i.h)
 *
 *   common/, laws and measures that do not depend on the solver:
 *     kea_policy_i.h          every constant that is a choice
 *     kea_budget.c            the work that a solve may take
 *     kea_rates.c             rates of rows; which may reach a bound
 *     kea_residual.c          how far an answer is from the laws; converged
 *     kea_energy.c            kinetic energy, the one limiter
 *     kea_restitution.c       the law of restitution
 *     kea_impact.c            impacts
 *     kea_project.c           bodies moved out of each other
 *     kea_rotation.c          inertia, free rotation
 *     kea_free.c              where bodies arrive; free motion
 *
 *   inner/, the inner problem, which knows bodies with a quadratic metric and rows with bounds and cones, but no step:
 *     kea_problem_i.h, .c     its data, its measure of error
 *     kea_newton.c            its solution: semismooth Newton on the bodies' side
 *     kea_friction.c          friction bounds between two of its solves
 *     kea_sweep.c             its solution by sweeps, when work runs out
 *     kea_factor.c            sparse factorization: numbers
 *     kea_structure.c, kea_order.c                its structure, the order of elimination
 *     kea_graph.c             the graph that rows make of bodies
 *     kea_cache.c             kept structures, and the memory of all factors
 *
 * inner/ calls no other room, common/ only inner/; exact/ and fast/ call both, but not each other
 * (tests/structure/check_includes.py).
 */
#ifndef KEA_I_H
#define KEA_I_H

#include "MdtKea.h"
#include "MdtKeaMath.h"
#include "inner/kea_problem_i.h"

/* The state of a body at the end of the step, while the step is being found. */
typedef struct KeaEnd {
    double position[3], quaternion[4], velocity[3], angularMomentum[3];
} KeaEnd;

/* A body on its way through a step. */
typedef struct KeaBody {
    double theta;           /* 1/2: midpoint rule; 1: backward Euler */
    double size;            /* m, radius of gyration */
    MeBool isSpatial;       /* its angular velocity changes in the world's axes: no gyroscopic term */
    double axes[3][3];      /* principal axes at the start, as columns */
    double spin[3];         /* rad/s at the start, in principal axes; of a spatial body in the world's */
    double inertia[3][3];   /* kg m², world, at the start; of a spatial body */
    double freeVelocity[3]; /* at the end, without rows */
    double freeMomentum[3]; /* angular, at the end, without rows */
    double scale;           /* N s: what an impulse is compared with */
    double u[6];            /* the unknown: m/s and rad/s with which it moves through the step */
    double endAxes[3][3];
    double endVelocity[6]; /* m/s, rad/s (world) */
    MeBool isFree;         /* no row acts on it: it moves as a free body */
} KeaBody;

/* The graph of joints (kea_dual.c). */
typedef struct KeaDual {
    KeaFactor *factor; /* null: the bodies' side is taken */
    int numNodes, numEdges;
    int *start, *size;           /* by node: its rows */
    int (*edges)[2], (*side)[2]; /* of an edge: its nodes, and on which side each has the shared body */
    int *met;                    /* by node: the last one that it was joined with */
    int *first, (*next)[2];      /* by body, by node and side: lists of 2 node + side */
    double *x;                   /* by row */
} KeaDual;

typedef struct MdtKeaWork {
    struct KeaContact *contact; /* exact/kea_contact_i.h; kept through the parts of a step */
    int numContacts;
    KeaBody *body;
    KeaEnd *end;
    MdtKeaTransformation *endPose, *meanPose; /* by body */
    double *endErrors;                        /* by row: φ at the end */
    double *ahead;                            /* m/s, by row: see kea_rateAhead */
    MdtKeaJBlockPair *keptJ;                  /* by row */
    double (*bestU)[6], *bestP;               /* by body, by row: of the best pass so far */
    double (*nearU)[6], *nearP;               /* of the best tangent pass within the rounding of attachments */
    double (*added)[6];                       /* by body: what the velocity stage has found */
    double (*plastic)[6], speed;              /* of impacts */
    double *target;        /* by row, twice: what impacts, m/s, or projection, m, ask of normal rows */
    double (*velocity)[6]; /* by body: what the limiter of energy starts from */
    double *keptP;         /* by row: impulses while the inner problem is lent */
    char *takesPart;
    int *acting, *placeOf; /* of impacts: the row of each of the problem's rows; by row: its place among these */
    int *parent;           /* by body, and one more */
    KeaProblem problem;
    KeaDual dual;
    MeBool hasLoops;     /* of joints */
    MeBool isCompromise; /* some joints miss their aims, if only by rounding, since others contradict them */
    MeBool hasJoints;    /* of rows that are no contacts' */
    MeBool isSettled;    /* the passes have ended with position errors within the rounding of attachments */
} MdtKeaWork;

/* ---- kea_rotation.c ---- */

/* The orientation q1 after h seconds of free rotation from q0 with the angular momentum L (world, constant). */
void kea_rotateFree(const MdtKeaBody *body, const double q0[4], const double L[3], double h, double q1[4]);
/* The angular velocity (world) of a body at orientation q with angular momentum L, and the other way round. */
void kea_angularVelocity(const MdtKeaBody *body, const double q[4], const double L[3], double w[3]);
void kea_angularMomentum(const MdtKeaBody *body, const double q[4], const double w[3], double L[3]);
/* The inertia tensor, and its inverse, in world axes at orientation q. */
void kea_inertia(const MdtKeaBody *body, const double q[4], double inertia[3][3]);
/* m, the largest radius of gyration. */
double kea_sizeOf(const MdtKeaBody *body);
void kea_inverseInertia(const MdtKeaBody *body, const double q[4], double inverse[3][3]);
/* Of any tensor that has an inverse. */
void kea_invert(double inverse[3][3], const double M[3][3]);
/* The smallest eigenvalue of a symmetric matrix. */
double kea_leastEigenvalue(const double S[3][3]);
/* Eigenvalues of a symmetric matrix, left on the diagonal of S, and eigenvectors, as the columns of V. */
void kea_eigen(double S[3][3], double V[3][3]);
/* Takes its negative eigenvalues from a symmetric matrix, unless these are less than `harmless`. */
void kea_clampPositive(double K[3][3], double harmless);

/* ---- kea_step.c ---- */

/* Finds the forces of the system's rows, and where the bodies will be. */
void kea_exactSolve(MdtKeaSystem *s);

/* ---- kea_scheme.c ---- */

/* What is fixed through the step. */
void kea_beginBodies(MdtKeaSystem *s);
/* The first guess of the unknowns; needs theta. */
void kea_guessMotion(MdtKeaSystem *s);
/* Where u takes the bodies: ends and poses. */
void kea_moveBodies(MdtKeaSystem *s);
/* Metric and load of the problem: the momentum that rows must give, and how it changes with u. */
void kea_linearizeBodies(MdtKeaSystem *s);
/* The derivative of the momentum itself, for the tangent problem; after kea_linearizeBodies. */
void kea_differentiateBodies(MdtKeaSystem *s);
/* The derivative of cay(h w) with w, as a turn in the world's axes. */
void kea_turnDerivative(double D[3][3], const double w[3], double h);
/* Velocities at the end from the impulses, so that momentum is kept whatever else is left over. */
void kea_balanceMomentum(MdtKeaSystem *s);
/* The inertia tensor (world) where the body has arrived. */
void kea_endInertia(const MdtKeaSystem *s, int i, double inertia[3][3]);

/* ---- kea_rows.c ---- */

/* Reach, theta, and what of the problem's rows stays as it is. */
void kea_beginRows(MdtKeaSystem *s);
/* Jacobians at these poses, and bounds that depend on them. */
void kea_refreshRows(MdtKeaSystem *s, const MdtKeaTransformation poses[], MeBool withBounds);
/* The derivatives of the rows' errors at the end, for the tangent problem; of those that ask for velocities, their
 * Jacobians. */
void kea_differentiateRows(MdtKeaSystem *s);
/* By how much the rates of contacts that move, where they are asked for, differ from those along the J that impulses
 * act by; after kea_moveBodies. */
void kea_rateAhead(MdtKeaSystem *s);
/* The residual r of each row; after kea_linearizeBodies. */
void kea_linearizeRows(MdtKeaSystem *s);
/* Contacts that were thought out of reach and are reached. Returns whether there were any. */
MeBool kea_admitContacts(MdtKeaSystem *s);
/* Whether a spring is followed by the end of the step instead of its middle (θ = 1). */
MeBool kea_isTooStiff(const MdtKeaSystem *s, const MdtKeaRow *row);

/* ---- kea_contact.c ---- */

/* Writes the forces of the rows that were made of contacts to the manifolds' points. */
void kea_returnContacts(MdtKeaSystem *s);

/* ---- kea_restitution.c ---- */

/* How two sides come together along a direction. */
typedef struct KeaApproach {
    double rate, predicted; /* m/s, positive apart: now; at the end of the step without rows */
    double fastest;         /* m/s: the least that it may become. Other contacts may hold either body at its velocity of
                               now: of two that stand on each other, the lower one does not fall */
    double acceleration;    /* m/s², in the last step */
} KeaApproach;

KeaApproach kea_approachOfRow(const MdtKeaSystem *s, const MdtKeaRow *row);
/* Along the manifold's normal; arms are from the bodies' centres, or the world's origin, to the point. */
KeaApproach kea_approachOfPoint(const MdtKeaSystem *s, const MdtKeaManifold *m, const double arm[2][3]);
/* Whether the sides touch, or may within the step. */
MeBool kea_mayTouch(const MdtKeaSystem *s, const KeaApproach *a, double gap);
/* m/s, the velocity apart: after an impact; at the end of the step, 0 where it is not hit. */
double kea_reboundOfImpact(double restitution, double threshold, double speed, double gate);
double kea_reboundInStep(const MdtKeaSystem *s, const KeaApproach *a, double gap, double restitution, double threshold);
/* Writes which rows bounce in this step, and how fast. */
void kea_setRebounds(MdtKeaSystem *s);

/* ---- kea_rates.c ---- */

/* Stops, and joints that are about to give way; those whose strength is far off hold as if they had no bound. */
MeBool kea_mayReachBound(const MdtKeaRow *row);
/* The rate of a row at the end. */
double kea_endRate(const MdtKeaSystem *s, int i);
/* The rate of a row through the step. */
double kea_meanRate(const MdtKeaSystem *s, int i);
/* m per unit of a row's coordinate: an angle moves a body's parts by its size. */
double kea_lengthOf(const MdtKeaSystem *s, const MdtKeaRow *row);
/* Keeps the rows' Jacobians while others take their place, and brings them back. */
void kea_keepRows(MdtKeaSystem *s);
void kea_recallRows(MdtKeaSystem *s);
/* m/s: what a row pushes for of a speed that it aims at; a stop with room left, and a contact with a gap, for none. */
double kea_pushSpeed(const MdtKeaSystem *s, const MdtKeaRow *row, double speed);

/* ---- kea_events.c ---- */

/* Which contacts are closed. */
void kea_timedBegin(MdtKeaSystem *s);
/* When something happens within the step (HUGE_VAL: nothing); `mustRepeat`: only after another solve is it known, in
 * which contacts that stop slide on. kea_releaseSlides takes that back. */
double kea_firstEvent(MdtKeaSystem *s, MeBool *mustRepeat);
void kea_releaseSlides(MdtKeaSystem *s);
/* The same where no row acts; at most the step. */
double kea_firstEventOfFlight(const MdtKeaSystem *s);

/* ---- kea_impact.c ---- */

/* Finds the velocities after all blows of this moment, and the impulses. False: there was no memory. */
MeBool kea_impact(MdtKeaSystem *s);
/* m/s: what speeds of contacts in time are compared with: the load speed; without loads, a little of the bodies'
 * speeds. */
double kea_eventSpeed(const MdtKeaSystem *s);
/* Whether a contact's gap counts as none. */
MeBool kea_isTouching(const MdtKeaSystem *s, const MdtKeaRow *row);
/* The rate of a row at the start, against its target; of a normal row against its drift. */
double kea_startRate(const MdtKeaSystem *s, int i);
/* A body, a row of the inner problem for what happens in no time: masses at the start, no loads, no springs. */
void kea_setInstantMetric(MdtKeaSystem *s, int i);
void kea_setInstantRow(const MdtKeaSystem *s, int i, KeaProblemRow *p);

/* ---- kea_project.c ---- */

/* Moves bodies out of each other, without velocity. */
void kea_project(MdtKeaSystem *s);

/* ---- kea_budget.c ---- */

/* Sets the budget of what follows: this share of the whole solve's; of it, so many passes by sweeps are reserved for
 * when it runs out. */
void kea_setBudget(MdtKeaSystem *s, double share, int sweptPasses);
/* Writes what it has cost. */
void kea_reportWork(MdtKeaSystem *s);

/* ---- kea_free.c ---- */

/* The poses of body i at the end, from its KeaEnd, and in the middle. */
void kea_setPoses(MdtKeaSystem *s, int i);
/* Bodies that no row acts on take the free motion instead. */
void kea_moveFreely(MdtKeaSystem *s);

/* ---- kea_energy.c ---- */

/* J, in the metric of the inner problem; change may be null. */
double kea_kineticEnergy(const MdtKeaSystem *s, double (*velocity)[6], double (*change)[6]);
/* J: the energy that there can be: what the step started with, and what loads, springs, motors and
 * whatever else moves have done in it. */
double kea_energyAllowed(const MdtKeaSystem *s);
/* J: the whole partition at the speed at which the worst error of its joints is taken away. */
double kea_energyOfCorrection(const MdtKeaSystem *s);
/* Shortens the way of the bodies that rows act on to where loads have taken all energy that there was. They may be
 * lifted by an error that is taken away. False: there is enough. */
MeBool kea_stopShort(const MdtKeaSystem *s);
/* The largest share a in [0, 1] for which velocity + plastic + a (elastic - plastic) has no more energy than
 * allowed. */
double kea_elasticShare(const MdtKeaSystem *s, double (*velocity)[6], double (*elastic)[6], double (*plastic)[6],
                        double allowed);
/* The last resort of a step whose motion was not found: `change` takes the velocities of all bodies that rows act on
 * down to the energy allowed. False: there is nothing to change. */
MeBool kea_slowDown(const MdtKeaSystem *s, double (*velocity)[6], double allowed, double (*change)[6]);

/* ---- kea_residual.c ---- */

/* How far a pass is from the laws, in tolerances (kea_policy_i.h). */
typedef struct KeaResiduals {
    double position, velocity, momentum, worst;
    double attachment; /* the position error, in roundings of where joints are attached */
    double impulse;    /* N s, that the velocity would take */
    double resolution; /* m/s, of the velocity: its tolerance */
} KeaResiduals;

/* m/s: by how much the loads change velocities in a step, at most. */
double kea_loadSpeed(const MdtKeaSystem *s);
/* m/s: what velocities are compared with: those of the bodies, and what loads, springs and motors do to them. */
double kea_speedOf(const MdtKeaSystem *s);
/* After a linearization. Writes report.error. */
KeaResiduals kea_residuals(MdtKeaSystem *s, double speed);
MeBool kea_isConverged(const KeaResiduals *e);
/* Not converged, but within this times what is reported as exact. */
MeBool kea_isExactEnough(const KeaResiduals *e, double margin);
/* After every pass: which joints are inconsistent; whether such miss their aims by more than attachments are known, and
 * whether by anything at all. */
void kea_noteInconsistent(MdtKeaSystem *s);
MeBool kea_isConflicting(const MdtKeaSystem *s);
MeBool kea_isCompromise(const MdtKeaSystem *s);

/* ---- kea_dual.c ---- */

/* Chooses the primal or dual factorization by flop count. */
void kea_dualBegin(MdtKeaSystem *s);
/* Solves the inner problem by the joints' side. False: that is not possible here. */
MeBool kea_dualSolve(MdtKeaSystem *s);

/* ---- kea_redundancy.c ---- */

/* Whether joints, and the world, make a loop. */
MeBool kea_hasLoops(const MdtKeaSystem *s);

/* Of impulses that do the same, the smallest; the metric is lost. */
void kea_shareForces(MdtKeaSystem *s);

/* ---- kea_velocity.c ---- */

void kea_velocityStage(MdtKeaSystem *s);

#endif
