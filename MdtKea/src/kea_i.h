/* Inside Kea: the working data of a step and the functions that its files share.
 *
 *     kea_system.c            memory, integration: the front door, with MdtKeaSolve and MdtKeaImpact
 *
 *   exact/, a step by Newton's method to the tolerance:
 *     kea_step.c              one step: passes of linearization, then the velocity stage
 *     kea_scheme.c            time integration: end poses from the unknowns u, the residual of momentum, its derivative
 *     kea_contact.c           rows of contacts, from manifolds
 *     kea_rows.c              linearization of rows; the choice of θ per body
 *     kea_dual.c              the inner problem solved for the joints' impulses (dual)
 *     kea_redundancy.c        redundant joints: the impulses of least norm
 *     kea_velocity.c          the velocity stage: projects the end velocities onto the rows at the end poses
 *     kea_events.c            times of impact and of stick within a timed step
 *     kea_flight.c            what flies from impact to impact
 *
 *   fast/, a step by passes over manifolds (fast/kea_fast_i.h)
 *
 *   common/, laws and measures that do not depend on the solver:
 *     kea_policy_i.h          every constant that is a choice
 *     kea_anchor.c            places of contacts, and how their lever arms move
 *     kea_body.c              a body as a step begins and ends
 *     kea_budget.c            the work that a solve may take
 *     kea_rates.c             rates of rows, J v; which rows may reach a bound
 *     kea_residual.c          residuals and the test of convergence
 *     kea_energy.c            kinetic energy and its limit
 *     kea_restitution.c       the law of restitution
 *     kea_impact.c            simultaneous impacts
 *     kea_project.c           position projection: removes overlaps
 *     kea_kick.c              momenta given as a step begins, shared by joints
 *     kea_rotation.c          inertia, free rotation
 *     kea_free.c              end poses; motion of bodies without rows
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
 * (tests/structure/rooms.py).
 */
#ifndef KEA_I_H
#define KEA_I_H

#include "MdtKea.h"
#include "MdtKeaMath.h"
#include "inner/kea_problem_i.h"
#include <float.h>

/* The state of a body at the end of the step, while the step is being found. */
typedef struct KeaEnd {
    double position[3], quaternion[4], velocity[3], angularMomentum[3];
    double theta; /* the body moved by (1 - θ) v + θ v⁺ */
} KeaEnd;

/* The working data of a body in a step. */
typedef struct KeaBody {
    double theta;           /* of u; 1/2: midpoint rule; 1: backward Euler (only these: dividing by it is exact) */
    double moveTheta;       /* of an untied body's displacement: 1/2; 1 where that would press a contact */
    double size;            /* m, radius of gyration */
    MeBool isSpatial;       /* its angular velocity changes in the world's axes: no gyroscopic term */
    double axes[3][3];      /* principal axes at the start, as columns */
    double spin[3];         /* rad/s at the start, in principal axes; of a spatial body in the world's */
    double inertia[3][3];   /* kg m², world, at the start; of a spatial body */
    double freeVelocity[3]; /* at the end, without rows */
    double freeMomentum[3]; /* angular, at the end, without rows */
    double scale;           /* N s: the impulses of the step, to which tolerances are relative */
    double u[6];            /* the unknown: mean velocity of the step, m/s and rad/s (world) */
    double endAxes[3][3];
    double endVelocity[6]; /* m/s, rad/s (world) */
    /* s, of tangent problems: a change dw of w changes cay(h w) by the rotation vector (turnDerivative dw), world */
    double turnDerivative[3][3];
    double distance; /* m, of its end from the origin */
    /* m, rad: the body's part in the scales of position errors (kea_residual.c) */
    double linearScale, angularScale;
    MeBool isUntied; /* no row of its displacement: it moves by v + moveTheta (v⁺ - v), not by u */
    MeBool isFree;   /* no row acts on it: it moves as a free body */
} KeaBody;

/* The graph of joints (kea_dual.c): nodes are joints, edges are bodies that two joints share. */
typedef struct KeaDual {
    KeaFactor *factor; /* null: the primal problem is solved instead */
    int numNodes, numEdges;
    int *start, *size;           /* by node: its rows */
    int (*edges)[2], (*side)[2]; /* of an edge: its nodes, and on which side each has the shared body */
    int *lastJoined;             /* by node: the last node that it got an edge to */
    int *first, (*next)[2];   /* list heads by body, links by node and side: the joints of a body, as 2 node + side */
    double *x;                /* by row */
    double (*response)[2][6]; /* by row: B⁻¹ Jᵀ of each body */
} KeaDual;

/* What speeds and impulses of timed parts are compared with. */
typedef struct KeaEventScale {
    double speed;   /* m/s: kea_eventSpeed */
    double fastest; /* m/s: of a body */
    double mass;    /* kg: of all bodies */
} KeaEventScale;

/* Bodies in flight (exact/kea_flight.c). */
typedef struct KeaFlight {
    KeaEventScale scale;        /* as flight began */
    double end, min;            /* s: of the step; the shortest time on to an impact that was foreseen too early */
    double *time;               /* s, by body: up to when it has been moved */
    double *impactTime;         /* s, by contact: when its bodies meet next; -HUGE_VAL: they do, in this impact */
    int *start, *list;          /* the contacts of body b: list[start[b] .. start[b + 1]) */
    int *body, numBodies;       /* those that take part in this impact, */
    char *isIn;                 /* by body: it is among them; */
    int *touching, numTouching; /* and their contacts that touch */
    int impacts, misses;        /* meetings so far, and those that were foreseen too early */
} KeaFlight;

typedef struct MdtKeaWork {
    struct KeaContact *contact; /* exact/kea_contact_i.h; kept through the parts of a step */
    int numContacts;
    KeaBody *body;
    KeaEnd *end;
    MdtKeaTransformation *endPose, *meanPose; /* by body */
    double *endErrors;                        /* by row: φ at the end poses */
    double *movingRate;                       /* m/s, by row (kea_setMovingRates) */
    MdtKeaJBlockPair *savedJ;                 /* by row */
    double (*bestU)[6], *bestP;               /* by body, by row: of the best pass so far */
    double (*tangentU)[6], *tangentP; /* of the best tangent pass with joint errors below the rounding of attachments */
    double (*added)[6];               /* by body: change of velocity found by the velocity stage, m/s, rad/s */
    double (*plastic)[6];             /* by body: change of velocity without restitution, m/s, rad/s */
    double speed;                     /* m/s: of the fastest body, in an impact */
    double *target;                   /* by row, twice: targets of normal rows, of impacts in m/s, of projection in m */
    double (*velocity)[6];            /* by body: input of the energy limit, m/s, rad/s */
    double *savedP;                   /* by row: impulses, while the inner problem is used for something else */
    char *isIncluded;                 /* by row: whether an impact or a projection has it */
    int *activeRow, *problemRowOf;    /* of impacts: system row of a problem row; problem row of a system row */
    int *activeBody, *problemBodyOf;  /* the same of bodies; -1: it has no part in the impact */
    int *parent;                      /* union-find, by body, the world last */
    KeaProblem problem;
    KeaDual dual;
    KeaFlight flight;
    MeBool hasLoops;          /* of joints */
    MeBool isInconsistent;    /* joints contradict each other: some keep a residual above tolerance */
    MeBool hasJoints;         /* there are rows that are not contacts' (kea_beginRows) */
    MeBool usesTangentAnswer; /* the answer is tangentU, tangentP: symmetric passes did not improve on it */
} MdtKeaWork;

/* ---- kea_body.c ---- */

/* What MdtKeaInit sets of one body, from its state and loads. */
void kea_beginBody(MdtKeaSystem *s, int i);
/* What MdtKeaIntegrate does with one body: its end state becomes its state. */
void kea_commitBody(MdtKeaSystem *s, int i);

/* ---- kea_guess.c ---- */

/* Writes the guess at the forces of contacts, as a step begins, if none are known. */
void kea_guessLoads(MdtKeaSystem *s);

/* ---- kea_rotation.c ---- */

/* The orientation q1 after h seconds of free rotation from q0 with the angular momentum L (world, constant). */
void kea_rotateFree(const MdtKeaBody *body, const double q0[4], const double L[3], double h, double q1[4]);
/* The rotation from q0 to q1, of the angle a, becomes that of 2 atan(a/2), Cayley's map of its rotation vector, which
 * takes points along chords as displacements by mean velocities do. A larger one than kea_maxChord stays. */
void kea_rotateByChord(const double q0[4], double q1[4]);
/* The angular velocity (world) of a body at orientation q with angular momentum L, and the other way round. */
void kea_angularVelocity(const MdtKeaBody *body, const double q[4], const double L[3], double w[3]);
void kea_angularMomentum(const MdtKeaBody *body, const double q[4], const double w[3], double L[3]);
/* The principal axes in the world, the columns of R; and of these and the moments, the angular velocity and the inverse
 * of the inertia tensor: for who needs more than one of them. */
void kea_principalAxes(const MdtKeaBody *body, const double q[4], double R[3][3]);
void kea_angularVelocityBy(const double moments[3], const double R[3][3], const double L[3], double w[3]);
void kea_inverseInertiaBy(const double moments[3], const double R[3][3], double inverse[3][3]);
/* The inertia tensor in world axes at orientation q. */
void kea_inertia(const MdtKeaBody *body, const double q[4], double inertia[3][3]);
/* m, the largest radius of gyration. */
double kea_bodyExtent(const MdtKeaBody *body);
/* The inverse of any regular matrix. */
void kea_invert(double inverse[3][3], const double M[3][3]);
/* The largest absolute value of an entry. */
double kea_largestEntry(const double M[3][3]);
/* Diagonalizes a symmetric matrix S in place: eigenvalues on its diagonal, eigenvectors as columns of V. */
void kea_eigen(double S[3][3], double V[3][3]);
/* Sets the negative eigenvalues of a symmetric matrix to 0, unless all of them are above -harmless. */
void kea_clampPositive(double K[3][3], double harmless);

/* ---- kea_step.c ---- */

/* Finds the forces of the system's rows, and where the bodies will be. */
void kea_exactSolve(MdtKeaSystem *s);

/* ---- kea_scheme.c ---- */

/* Sets the quantities of KeaBody that are constant in the step. */
void kea_beginBodies(MdtKeaSystem *s);
/* Initial guess of u by the accelerations of the last step; after kea_beginRows, which chooses θ. */
void kea_guessMotion(MdtKeaSystem *s);
/* End states and poses of all bodies from u. */
void kea_moveBodies(MdtKeaSystem *s);
/* m/s, rad/s: what moves a body in the step; or, of one that is untied, what would if it were moved by v⁺. */
void kea_moveOf(const MdtKeaSystem *s, int body, MeBool isOfEnd, double move[6]);
/* Load and metric of the inner problem: the residual of momentum without rows, and its derivative with u, symmetric and
 * positive definite. */
void kea_linearizeBodies(MdtKeaSystem *s);
/* The exact, unsymmetric derivative of the momentum, for the tangent problem; after kea_linearizeBodies. */
void kea_differentiateBodies(MdtKeaSystem *s);
/* Velocities at the end from the impulses: momentum is conserved exactly, also by an answer that has not converged. */
void kea_balanceMomentum(MdtKeaSystem *s);
/* The inertia tensor (world) where the body has arrived. */
void kea_endInertia(const MdtKeaSystem *s, int i, double inertia[3][3]);

/* ---- kea_rows.c ---- */

/* Which rows can act in this step, θ, and those members of the problem's rows that are constant in it. */
void kea_beginRows(MdtKeaSystem *s);
/* Jacobians, and on request bounds, of the joints' rows at these poses. */
void kea_refreshRows(MdtKeaSystem *s, const MdtKeaTransformation poses[], MeBool withBounds);
/* T of the tangent problem: of position and spring rows the derivative of the error at the end, of velocity rows J;
 * after kea_differentiateBodies. */
void kea_differentiateRows(MdtKeaSystem *s);
/* Of contacts whose lever arms change in the step: how much the rate at the pose where it is constrained exceeds J v
 * with the J that the impulse acts along; after kea_moveBodies. */
void kea_setMovingRates(MdtKeaSystem *s);
/* r, E and N of each row of the inner problem; after kea_linearizeBodies. */
void kea_linearizeRows(MdtKeaSystem *s);
/* Activates contacts that were inactive (out of reach) and would be passed through. */
void kea_admitContacts(MdtKeaSystem *s);
/* Untied bodies are moved by the mean of their velocities at the start and the end, of second order, unless that
 * presses a contact deeper than the end's velocities do, which contacts bound: then by these. */
void kea_chooseMoves(MdtKeaSystem *s);
/* Whether a spring is too stiff for the midpoint rule and is integrated by backward Euler (θ = 1). */
MeBool kea_isTooStiff(const MdtKeaSystem *s, const MdtKeaRow *row);

/* ---- kea_contact.c ---- */

/* Writes the forces of the rows that were made of contacts to the manifolds' points. */
void kea_returnContacts(MdtKeaSystem *s);

/* ---- kea_restitution.c ---- */

/* The relative motion of two bodies along a direction. */
typedef struct KeaApproach {
    double rate, predicted; /* m/s, positive apart: now; at the end of the step without rows */
    double fastest;      /* m/s: lower bound of the rate in the step, from the lesser of present and predicted rate of
                               each body: of two stacked bodies, the lower one does not fall as predicted */
    double acceleration; /* m/s², in the last step */
} KeaApproach;

KeaApproach kea_approachOfRow(const MdtKeaSystem *s, const MdtKeaRow *row);
/* Along the manifold's normal; arms are from the bodies' centres, or the world's origin, to the point. */
KeaApproach kea_approachOfPoint(const MdtKeaSystem *s, const MdtKeaManifold *m, const double arm[2][3]);
/* Whether the bodies touch, or may within the step; gap in m. */
MeBool kea_mayTouch(const MdtKeaSystem *s, const MdtKeaBodyIndexPair body, const KeaApproach *a, double gap);
/* m/s, >= 0: the separating velocity by the law of restitution, after an impact that is resolved when it happens,
 * faster than minSpeed; or at the end of a step that contains the impact, 0 where there is none. */
double kea_reboundOfImpact(double restitution, double threshold, double speed, double minSpeed);
double kea_reboundInStep(const MdtKeaSystem *s, const KeaApproach *a, double gap, double restitution, double threshold);
/* Sets `bounces` and `rebound` of all rows. */
void kea_setRebounds(MdtKeaSystem *s);

/* ---- kea_rates.c ---- */

/* Whether a row may be at a bound: one-sided rows always, two-sided ones only where the last force is near a bound. */
MeBool kea_mayReachBound(const MdtKeaRow *row);
/* m/s: J v of a row with the velocities at the end. */
double kea_endRate(const MdtKeaSystem *s, int i);
/* m/s: J u of a row, with the mean velocities of the step. */
double kea_meanRate(const MdtKeaSystem *s, int i);
/* m per unit of a row's coordinate: 1 of a linear row, the larger radius of gyration of an angular one. */
double kea_lengthOf(const MdtKeaSystem *s, const MdtKeaRow *row);
/* m: the smaller radius of gyration of a row's or a manifold's bodies, which gaps and depths are compared with. */
double kea_smallerExtent(const MdtKeaSystem *s, const int body[2]);
/* Save and restore the rows' Jacobians. */
void kea_keepRows(MdtKeaSystem *s);
void kea_recallRows(MdtKeaSystem *s);
/* m/s: the part of a target speed that a row's bounds let it push for: 0 of a stop or a contact with a gap. */
double kea_pushSpeed(const MdtKeaSystem *s, const MdtKeaRow *row, double speed);

/* ---- kea_events.c ---- */

/* Sets isOpen of all contacts. */
void kea_timedBegin(MdtKeaSystem *s);
/* Holds the contacts that meet slowly within the step, by the end of the last solve (holdsSlow); returns how many. */
int kea_closeSlowContacts(MdtKeaSystem *s);
/* s: the first impact or end of sliding within the step; HUGE_VAL: none. `mustRepeat`: contacts stop sliding, and their
 * friction is now fixed against the sliding of the start (isForced): solve and call again for the time.
 * kea_releaseSlides undoes that. */
double kea_firstEvent(MdtKeaSystem *s, MeBool *mustRepeat);
void kea_releaseSlides(MdtKeaSystem *s);
/* s: the first impact of ballistic motion; at most the step. */
double kea_firstEventOfFlight(const MdtKeaSystem *s);
/* s: when the bodies of an open contact meet, by its normal row and without forces of rows; HUGE_VAL: they do not. */
double kea_timeOfMeeting(const MdtKeaSystem *s, int i);
/* Whether a normal row's contact has a gap, or opens. */
MeBool kea_isContactOpen(const MdtKeaSystem *s, int i, double speed);

/* ---- kea_impact.c ---- */

/* Of all bodies, as they are now; after MdtKeaInit. */
KeaEventScale kea_eventScale(const MdtKeaSystem *s);
/* Velocities after all impacts at the start of the step, and the impulses. False: no memory. */
MeBool kea_impact(MdtKeaSystem *s, const KeaEventScale *scale);
/* MdtKeaTrembles. */
MeBool kea_trembles(const MdtKeaSystem *s, const KeaEventScale *scale);
/* m/s: the scale of speeds in timed steps: the change of velocity by the loads in one step, or a small share of the
 * bodies' speeds if that is more. */
double kea_eventSpeed(const MdtKeaSystem *s);
/* Whether a contact is closed: its gap is below a tolerance. */
MeBool kea_isTouching(const MdtKeaSystem *s, const MdtKeaRow *row);
/* m/s: J v - s of a row at the start; of a normal row J v - drift. */
double kea_startRate(const MdtKeaSystem *s, int i);
/* A body and a row of the inner problem for an instant: masses at the start pose, no loads, no springs. */
void kea_setInstantBody(KeaProblem *q, int b, const MdtKeaBody *body);
void kea_setInstantRow(const MdtKeaSystem *s, int i, KeaProblemRow *p);

/* ---- kea_project.c ---- */

/* Reduces overlaps by a displacement, without changing velocities. */
void kea_project(MdtKeaSystem *s);
/* Is it two-sided, without bounds? */
MeBool kea_isRigidJoint(const MdtKeaRow *row);
/* Least changes of the bodies in the metric of the instant (kea_setInstantBody), work->added, by which the rows that
 * take part change by `target`. */
void kea_solveInstant(MdtKeaSystem *s, const double target[]);

/* ---- kea_budget.c ---- */

/* Sets the budget of work up to the next call, a share of the whole solve's, and reserves part of it for so many passes
 * by sweeps. */
void kea_setBudget(MdtKeaSystem *s, double share, int sweptPasses);
/* Copies the counts of work into the report. */
void kea_reportWork(MdtKeaSystem *s);

/* ---- kea_free.c ---- */

/* The poses of body i at the end, from its KeaEnd, and in the middle. */
void kea_setPoses(MdtKeaSystem *s, int i);
/* End states of the bodies that no row acts on: free motion; of one body. */
void kea_moveFreely(MdtKeaSystem *s);
void kea_moveFree(MdtKeaSystem *s, int i);

/* ---- kea_energy.c ---- */

/* J: kinetic energy of velocity + change, of the bodies of the inner problem; change may be null. */
double kea_kineticEnergy(const MdtKeaSystem *s, double (*velocity)[6], double (*change)[6]);
/* J: an upper bound of the kinetic energy at the end: that of the start and the work of loads, springs, motors and
 * moving attachments or surfaces. */
double kea_energyAllowed(const MdtKeaSystem *s);
/* J: kinetic energy of the whole partition at the speed with which the largest joint error is corrected. */
double kea_energyOfCorrection(const MdtKeaSystem *s);
/* Scales u of the bodies that rows act on, where the loads would take more energy from them than there is, down to
 * where they have taken all. Energy for the correction of errors is allowed for. False: nothing to scale. */
MeBool kea_limitTravel(const MdtKeaSystem *s);
/* The largest share a in [0, 1] for which velocity + plastic + a (elastic - plastic) has no more energy than
 * allowed. */
double kea_elasticShare(const MdtKeaSystem *s, double (*velocity)[6], double (*elastic)[6], double (*plastic)[6],
                        double allowed);
/* Fallback for a step that has not converged: `change` scales the velocities of all bodies that rows act on down to the
 * energy allowed. False: they have no more than that. */
MeBool kea_scaleVelocities(const MdtKeaSystem *s, double (*velocity)[6], double allowed, double (*change)[6]);

/* ---- kea_residual.c ---- */

/* Residuals of a pass, in units of their tolerances (kea_policy_i.h): below 1 is converged. */
typedef struct KeaResiduals {
    double position, velocity, momentum, worst;
    double attachment; /* the position error over the rounding of the joints' attachments */
    double impulse;    /* N s, of the largest violation of a velocity row */
    double resolution; /* m/s, of the velocity: its tolerance */
} KeaResiduals;

/* m/s: slower, a body moves in the step by less than a double's rounding of its size, and is not told from one that
 * rests. Without this floor, what a motor has stopped in a world without loads is solved for again and again. */
static inline double kea_minSpeed(double size, double stepsize) {
    return DBL_EPSILON * size / stepsize;
}
/* The same, the greatest of all bodies. */
double kea_minSpeedOfAll(const MdtKeaSystem *s);
/* m/s: the largest change of a body's velocity by loads in the step. */
double kea_loadSpeed(const MdtKeaSystem *s);
/* m/s: the scale of velocities, to which tolerances are relative: of bodies and their changes by loads, at least
 * kea_minSpeedOfAll; and of their changes by springs and motors, with the present impulses. */
double kea_bodySpeedScale(const MdtKeaSystem *s);
double kea_rowSpeedScale(const MdtKeaSystem *s);
/* After a linearization. Writes report.error. */
KeaResiduals kea_residuals(MdtKeaSystem *s, double speed);
/* Of the smaller body's size: the most that a joint was to close and has not. */
double kea_openingLeft(const MdtKeaSystem *s);
MeBool kea_isConverged(const KeaResiduals *e);
/* Whether residuals are below margin times the loose tolerances, within which an answer is reported as exact; and those
 * of positions and momenta alone, whatever contacts' velocities are. */
MeBool kea_isExactEnough(const KeaResiduals *e, double margin);
MeBool kea_isMotionExactEnough(const KeaResiduals *e, double margin);
/* Sets the scales of its rows' errors that a body's motion gives, at its end position. */
void kea_setErrorScales(MdtKeaSystem *s, int body);
/* After every pass: marks inconsistent joints, which contradict each other. Whether the residual of one exceeds the
 * rounding of attachments; whether it exceeds the position tolerance. */
void kea_noteInconsistent(MdtKeaSystem *s);
MeBool kea_isConflicting(const MdtKeaSystem *s);
MeBool kea_isInconsistent(const MdtKeaSystem *s);

/* ---- kea_dual.c ---- */

/* Chooses the primal or dual factorization by flop count. */
void kea_dualBegin(MdtKeaSystem *s);
/* Solves the inner problem for the joints' impulses. False: kea_dualBegin has chosen the primal factorization, or the
 * factorization failed. */
MeBool kea_dualSolve(MdtKeaSystem *s);

/* ---- kea_redundancy.c ---- */

/* Whether joints, and the world, make a loop. */
MeBool kea_hasLoops(const MdtKeaSystem *s);

/* Replaces the impulses of redundant joints by those of least norm with the same resultant on each body; overwrites the
 * metric. */
void kea_minimizeRedundantForces(MdtKeaSystem *s);

/* ---- kea_velocity.c ---- */

/* Corrects the velocities at the end of the step. */
void kea_velocityStage(MdtKeaSystem *s);

#endif
