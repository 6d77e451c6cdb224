/* Inside Kea: the working data of a step and the functions that its files share.
 *
 *     kea_system.c            public entry points: memory, MdtKeaSolve, MdtKeaImpact, MdtKeaIntegrate
 *
 *   exact/, a step by Newton's method to the tolerance:
 *     kea_step.c              one step: passes of linearization, then the velocity stage
 *     kea_scheme.c            time integration: end states from the unknowns u, residual of momentum, derivatives
 *     kea_contact.c           rows of contacts, from manifolds
 *     kea_rows.c              linearization of rows; the choice of θ per body
 *     kea_bend.c              how directions of angular rows turn, in the inner problem
 *     kea_dual.c              the inner problem solved for the joints' impulses (dual)
 *     kea_redundancy.c        redundant joints: the impulses of least norm
 *     kea_velocity.c          the velocity stage: projects the end velocities onto the rows at the end poses
 *     kea_spin.c              conserves the angular momentum of groups that nothing fixed acts on
 *     kea_events.c            times of impact and of the end of sliding within a timed step
 *     kea_flight.c            ballistic bodies, advanced from impact to impact
 *     kea_reverse.c           steps back in time
 *
 *   fast/, a step by passes over manifolds (fast/kea_fast_i.h)
 *
 *   common/, laws and measures that do not depend on the solver:
 *     kea_policy_i.h          all tuned constants
 *     kea_anchor.c            positions of contacts, and how their lever arms change
 *     kea_body.c              a body at the start and at the end of a step
 *     kea_budget.c            the work budget of a solve
 *     kea_carry.c             what sticks to movers moves with them
 *     kea_guess.c             cold start: a guess at the forces of new contacts
 *     kea_rates.c             rates of rows, J v; which rows may reach a bound
 *     kea_residual.c          residuals and the test of convergence
 *     kea_energy.c            kinetic energy and its limit
 *     kea_restitution.c       the law of restitution
 *     kea_impact_time.c       times of impact
 *     kea_impact.c            simultaneous impacts
 *     kea_project.c           position projection: removes overlaps
 *     kea_kick.c              impulses at the start of a step, transmitted by joints
 *     kea_lock.c              axes along which bodies do not move
 *     kea_rotation.c          inertia, free rotation
 *     kea_free.c              end poses; motion of bodies without rows
 *
 *   inner/, the inner problem: bodies with a quadratic metric, rows with bounds and cones, independent of any step:
 *     kea_problem_i.h, .c     its data, its residual
 *     kea_newton.c            its solution by semismooth Newton, with the bodies' velocities as unknowns
 *     kea_states.c            its solution by an active set method, from given states of the rows
 *     kea_friction.c          updates of friction bounds between two of its solves
 *     kea_sweep.c             its solution by sweeps, when the work budget is used up
 *     kea_factor.c            sparse factorization: the numeric phase
 *     kea_structure.c, kea_order.c      the symbolic phase: structure, order of elimination
 *     kea_graph.c             the graph of bodies, with an edge for each pair that rows join
 *     kea_cache.c             cached structures, and the memory of all factors
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

/* The state of a body at the end of the step, not yet committed. */
typedef struct KeaEnd {
    double position[3], quaternion[4], velocity[3], angularMomentum[3];
    double theta; /* the body has been moved by (1 - θ) v + θ v⁺ */
} KeaEnd;

/* The working data of a body in a step. */
typedef struct KeaBody {
    double theta;           /* θ of u: 1/2, midpoint rule; 1, backward Euler. Division by either is exact */
    double moveTheta;       /* θ of an untied body's displacement: 1/2; 1 if 1/2 would press a contact deeper */
    double size;            /* m, the largest radius of gyration */
    int locked;             /* MdtKeaBody.locked */
    MeBool isSpatial;       /* its angular velocity is integrated in world axes, without gyroscopic term */
    double axes[3][3];      /* principal axes at the start, as columns */
    double spin[3];         /* rad/s at the start, in principal axes; in world axes if isSpatial */
    double inertia[3][3];   /* kg m², world, at the start; set if isSpatial */
    double freeMomentum[3]; /* kg m²/s, angular, at the end without rows */
    double u[6];            /* the unknown: mean velocity of the step, m/s and rad/s (world) */
    double endAxes[3][3];
    double endVelocity[6]; /* m/s, rad/s (world) */
    double errorScale[2];  /* m, rad: its share of the scales of linear and angular position errors (kea_residual.c) */
    double depth;          /* m: of its deepest contact that rests (kea_setDepths) */
    MeBool isTied;         /* a joint or a spring constrains its displacement (kea_markTied) */
    MeBool isFree;         /* no row acts on it: it moves as a free body */
} KeaBody;

/* The graph of joints (kea_dual.c): nodes are joints, edges are bodies that two joints share. */
typedef struct KeaDual {
    KeaFactor *factor; /* null: the primal problem is solved instead */
    int numNodes, numEdges;
    int *start, *size;           /* by node: its first row and their number */
    int (*edges)[2], (*side)[2]; /* by edge: its two nodes, and which body of each (0 or 1) is the shared one */
    int *lastJoined;             /* by node: the last node that an edge joined it with */
    int *first, (*next)[2];   /* list heads by body, links by node and side: the joints of a body, as 2 node + side */
    double *x;                /* by row: right side, then solution */
    double (*response)[2][6]; /* by row: B⁻¹ Jᵀ of each body */
} KeaDual;

/* Scales of speeds and impulses in timed steps. */
typedef struct KeaEventScale {
    double speed;   /* m/s: kea_eventSpeed */
    double fastest; /* m/s: speed of the fastest body */
    double mass;    /* kg: mass of all bodies */
} KeaEventScale;

/* Bodies in flight (exact/kea_flight.c). */
typedef struct KeaFlight {
    KeaEventScale scale;        /* at the start of the flight */
    double end, min;            /* s: end of the step; shortest advance after an impact that was predicted too early */
    double *time;               /* s, by body: the time that it has been advanced to */
    double *impactTime;         /* s, by contact: its next predicted impact; -HUGE_VAL: it is part of the present one */
    int *start, *list;          /* the contacts of body b: list[start[b] .. start[b + 1]) */
    int *body, numBodies;       /* the bodies that take part in the present impact */
    char *isInvolved;           /* by body: it takes part in the present impact */
    int *touching, numTouching; /* the touching contacts of these bodies */
    int impacts, misses;        /* impacts so far; impacts that were predicted too early */
} KeaFlight;

/* What carries a body (kea_carry.c): a mover, or a jointed body, by its index + 1; neither: nothing. */
typedef struct KeaCarrier {
    const MdtKeaMover *mover;
    int body;
} KeaCarrier;

typedef struct MdtKeaWork {
    struct KeaContact *contact; /* common/kea_anchor_i.h; kept through the sub-steps of a step */
    int numContacts;
    int contactPasses; /* of the solve: those in which contacts followed the bodies */
    KeaBody *body;
    KeaEnd *end;
    MdtKeaTransformation *endPose, *meanPose; /* by body */
    double *endErrors;                        /* by row: φ at the end poses */
    double *movingRate;                       /* m/s, by row (kea_setMovingRates) */
    MdtKeaJBlockPair *savedJ;                 /* by row */
    double (*bestU)[6], *bestP;               /* by body, by row: u and p of the best pass so far */
    double (*tangentU)[6], *tangentP;         /* u, p of the best tangent pass that closes joints to rounding */
    /* s, by body, for tangent problems: a change dw of w changes cay(h w) by the rotation vector (turnDerivative dw) */
    double (*turnDerivative)[3][3];
    double (*added)[6];              /* by body: change of velocity, m/s, rad/s; in the projection of pose, m, rad */
    double (*plastic)[6];            /* by body: change of velocity without restitution, m/s, rad/s */
    double speed;                    /* m/s: speed of the fastest body in an impact */
    double *target;                  /* two arrays by row: targets of impacts, m/s, or of the projection, m */
    double (*velocity)[6];           /* by body: input of the energy limiter, m/s, rad/s */
    double *savedP;                  /* by row: impulses, saved while the inner problem solves something else */
    char *isIncluded;                /* by row: it takes part in an impact or a projection */
    KeaCarrier *carrier;             /* by body: what it sticks to (kea_carry.c) */
    int *activeRow, *problemRowOf;   /* impacts: system row of a problem row; problem row of a system row */
    int *activeBody, *problemBodyOf; /* the same for bodies; -1: not part of the impact */
    int *parent;                     /* union-find by body, the world last */
    KeaProblem problem;
    KeaDual dual;
    KeaFlight flight;
    MeBool hasLocks;          /* some body has locked axes */
    MeBool hasLoops;          /* joints form a loop */
    MeBool isInconsistent;    /* joints contradict each other: some keep a residual above the tolerance */
    MeBool hasJoints;         /* there are rows other than those of contacts (kea_beginRows) */
    MeBool areRowsFixed;      /* there are rows, and all of them are MdtKeaRow.isFixed */
    MeBool usesTangentAnswer; /* the answer is tangentU, tangentP: symmetric passes did not improve it */
} MdtKeaWork;

/* ---- kea_body.c ---- */

/* MdtKeaInit for body i: computes pose, velocity, inverse mass and prediction from its state and loads. */
void kea_beginBody(MdtKeaSystem *s, int i);
/* Sets the inverse inertia, and the predicted angular velocity, to those of another orientation than the start's. */
void kea_orientInertia(MdtKeaSystem *s, int i, const double quaternion[4]);
/* MdtKeaIntegrate for body i: sets its state and acceleration from its end state. */
void kea_commitBody(MdtKeaSystem *s, int i);

/* ---- kea_lock.c ---- */

/* Sets to 0 the components of a velocity, a momentum or a Jacobian along locked axes. */
static inline void kea_dropLocked(int locked, double x[6]) {
    if (!locked)
        return;
    keaDropAxes(locked, x);
    keaDropAxes(locked >> 3, x + 3);
}
/* Sets to 0 the rows and columns of locked rotations. */
void kea_dropLockedRotations(int locked, double M[3][3]);
/* Drops the part of a row's Jacobian along locked axes. If little else is left, the row is 0 (kea_minMobility). */
void kea_dropLockedOfRow(const MdtKeaSystem *s, const int body[2], double (*J)[6]);
static inline void kea_lockRow(const MdtKeaSystem *s, const int body[2], double (*J)[6]) {
    if (s->work->hasLocks)
        kea_dropLockedOfRow(s, body, J);
}
/* Whether locks leave a contact nothing to act on: its normal is along locked axes. */
MeBool kea_isContactLocked(const MdtKeaSystem *s, const MdtKeaManifold *m, const double arm[2][3]);
/* Whether the inertia is constant in world axes during a step, and free rotation has no gyroscopic term. */
static inline MeBool kea_isSteady(const MdtKeaBody *body) {
    return !(body->flags & MdtKeaBodyFlagAddCoriolisForce) || (body->locked & MdtKeaLOCKEDROTATIONS) != 0;
}

/* ---- kea_guess.c ---- */

/* Guesses the forces of contacts at the start of a step, and writes them as warm start, if no force is known. */
void kea_guessContactForces(MdtKeaSystem *s);

/* ---- kea_rotation.c ---- */

/* The orientation q1 after h seconds of free rotation from q0 with the constant angular momentum L (world). */
void kea_rotateFree(const MdtKeaBody *body, const double q0[4], const double L[3], double h, double q1[4]);
/* Replaces the rotation from q0 to q1, of angle a, by one of angle 2 atan(a/2) about the same axis, the Cayley map of
 * its rotation vector, which moves points along chords as displacements by mean velocities do. A rotation by more than
 * kea_maxChord is left unchanged. */
void kea_rotateByChord(const double q0[4], double q1[4]);
/* The angular velocity w (world) of a body at orientation q from its angular momentum L (world), and the inverse. */
void kea_angularVelocity(const MdtKeaBody *body, const double q[4], const double L[3], double w[3]);
void kea_angularMomentum(const MdtKeaBody *body, const double q[4], const double w[3], double L[3]);
/* The principal axes in the world, as columns of R; and, from given axes and moments, the angular velocity and the
 * inverse inertia tensor, so that callers that need both compute the axes once. */
void kea_principalAxes(const MdtKeaBody *body, const double q[4], double R[3][3]);
void kea_angularVelocityBy(const double moments[3], const double R[3][3], const double L[3], double w[3]);
void kea_inverseInertiaBy(const double moments[3], const double R[3][3], double inverse[3][3]);
/* The inertia tensor in world axes at orientation q. */
void kea_inertia(const MdtKeaBody *body, const double q[4], double inertia[3][3]);
/* Of three principal moments: the smallest, the largest, and whether they are equal but for rounding. kea_turnsFar:
 * whether a rotation by an angle, rad, is more than `far` for the midpoint rule, whose error is proportional to the
 * relative difference of the moments. */
static inline double kea_minOf(const double I[3]) {
    return keaMin(I[0], keaMin(I[1], I[2]));
}
static inline double kea_maxOf(const double I[3]) {
    return keaMax(I[0], keaMax(I[1], I[2]));
}
MeBool kea_hasEqualMoments(const double I[3]);
MeBool kea_turnsFar(const double I[3], double angle, double far);
/* m, the largest radius of gyration. */
double kea_bodyExtent(const MdtKeaBody *body);
/* The inverse of any regular matrix. */
void kea_invert(double inverse[3][3], const double M[3][3]);
/* The largest absolute value of the entries. */
double kea_largestEntry(const double M[3][3]);
/* Sets the negative eigenvalues of a symmetric matrix to 0, unless all of them are above -harmless. */
void kea_clampPositive(double K[3][3], double harmless);

/* Adds the geometric stiffness of an impulse P, N s, at the lever arm r, m, which rotates with the body:
 * K += factor S, S the symmetric part of -[P]x[r]x = (P·r) 1 - r Pᵀ. */
static inline void kea_addGeometricStiffness(double K[3][3], double factor, const double P[3], const double r[3]) {
    const double Pr = keaDot(P, r);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            K[i][j] += factor * ((i == j ? Pr : 0) - 0.5 * (r[i] * P[j] + r[j] * P[i]));
}

/* ---- kea_step.c ---- */

/* Finds the forces of the system's rows and the end states of the bodies. */
void kea_exactSolve(MdtKeaSystem *s);

/* ---- kea_scheme.c ---- */

/* Sets the fields of KeaBody that are constant in the step. */
void kea_beginBodies(MdtKeaSystem *s);
/* Guesses u by the accelerations of the last step; after kea_beginRows, which chooses θ. */
void kea_guessMotion(MdtKeaSystem *s);
/* Computes end states and poses of all bodies from u. */
void kea_moveBodies(MdtKeaSystem *s);
/* m/s, rad/s: the velocity that a body is moved by in the step; with byEnd, for untied bodies, their v⁺. */
void kea_moveVelocity(const MdtKeaSystem *s, int body, MeBool byEnd, double move[6]);
/* Sets load and metric of the inner problem: the residual of momentum without rows, and its derivative with respect to
 * u, made symmetric and positive definite. */
void kea_linearizeBodies(MdtKeaSystem *s);
/* Whether kea_linearizeBodies and kea_linearizeRows keep the metric and the effective masses, since the factors of the
 * first pass are kept: those of rows that are fixed change with the orientation of bodies alone. */
static inline MeBool kea_keepsMetric(const MdtKeaSystem *s) {
    return s->work->problem.isChord && s->work->problem.isFactored;
}
/* Sets the exact, unsymmetric derivative of the momentum, for the tangent problem; after kea_linearizeBodies. */
void kea_differentiateBodies(MdtKeaSystem *s);
/* Computes end velocities from the impulses, so that momentum is conserved exactly even if passes have not
 * converged. */
void kea_balanceMomentum(MdtKeaSystem *s);
/* The inertia tensor (world) of a body at its end pose; at its start pose if isSpatial. */
void kea_endInertia(const MdtKeaSystem *s, int i, double inertia[3][3]);

/* ---- kea_bend.c ---- */

/* Adds inactive rows for bends behind the problem's rows of the system. */
void kea_beginBends(MdtKeaSystem *s);
/* Sets them from their rows' impulses and bends; before effective masses are set. */
void kea_linearizeBends(MdtKeaSystem *s);
/* Leaves them out of solves until the next linearization. */
void kea_disableBends(MdtKeaSystem *s);

/* ---- kea_rows.c ---- */

/* Chooses the rows that can act in this step and θ of the bodies; sets the fields of the problem's rows that are
 * constant in the step. */
void kea_beginRows(MdtKeaSystem *s);
/* Evaluates the Jacobians of the joints' rows at these poses; withBounds: their bounds, too. */
void kea_refreshRows(MdtKeaSystem *s, const MdtKeaTransformation poses[], MeBool withBounds);
/* Sets T of the tangent problem: the derivative of the error at the end for position and spring rows, J for velocity
 * rows; after kea_differentiateBodies. */
void kea_differentiateRows(MdtKeaSystem *s);
/* Sets the Jacobians of contacts that move with bodies, in the middle and at the end of the step, from the
 * displacements by u; before kea_setMovingRates. Those of tied bodies follow in the first pass only. Returns whether
 * any has changed its place. */
MeBool kea_moveContacts(MdtKeaSystem *s, MeBool isFirst);
/* Whether a body is moved by u: it is tied, or the step is timed, as impacts are located along this displacement.
 * Others are moved by v + moveTheta (v⁺ - v). False for the world, -1. */
MeBool kea_isMovedByU(const MdtKeaSystem *s, int body);
/* Sets isTied of all bodies from the rows of joints. */
void kea_markTied(MdtKeaSystem *s);
void kea_copyJacobian(const MdtKeaSystem *s, KeaProblemRow *p, const MdtKeaJBlockPair J);
/* Sets movingRate of contacts whose lever arms change in the step: the difference between the rate that the row
 * constrains and J v, with the J along which its impulse acts; after kea_moveBodies. */
void kea_setMovingRates(MdtKeaSystem *s);
/* Sets r, E and N of each row of the inner problem; after kea_linearizeBodies. */
void kea_linearizeRows(MdtKeaSystem *s);
/* Activates contacts that were inactive (out of reach) and would be penetrated at the end of the step; sets θ = 1 for
 * bodies of stops that act. */
void kea_admitContacts(MdtKeaSystem *s);
/* Chooses moveTheta of untied bodies, and moves the bodies again. A body is moved by the mean of its velocities at the
 * start and the end, which is of second order, unless this presses a contact deeper than the end velocity does, which
 * is what contacts constrain: then by the end velocity. */
void kea_chooseMoveThetas(MdtKeaSystem *s);

/* ---- kea_contact.c ---- */

/* Copies the forces of contact rows to the manifolds' points. */
void kea_returnContactForces(MdtKeaSystem *s);

/* ---- kea_impact_time.c ---- */

/* m/s: an impact that is slower does not divide a step unless another one is faster. gained: by how much the rate of
 * the contact changes in the step; speed: kea_eventSpeed. */
double kea_minDividingSpeed(double restitution, double gained, double speed);
/* Whether the contact with normal row i touches, and its bodies approach each other; speed: kea_eventSpeed. */
MeBool kea_isBlow(const MdtKeaSystem *s, int i, double speed);
/* Sets the depth of each body. */
void kea_setDepths(const MdtKeaSystem *s, double speed);
/* s: how long the contact with normal row i, with a gap and an approach speed, may wait for simultaneous impacts. */
double kea_delayOfImpact(const MdtKeaSystem *s, int i, double gap, double approach);
/* Whether blows are to wait, at the start of the step, for simultaneous ones. Sets depths. */
MeBool kea_impactsWait(const MdtKeaSystem *s, double speed);
/* Whether slow impacts of the contact may follow each other without end; speed: kea_eventSpeed. Those of a round
 * surface with the surroundings do not if they lose all, and the body is faster than its loads change it: it comes to
 * the facets of its path one after the other, and goes on along each. */
MeBool kea_mayChatter(const MdtKeaSystem *s, const MdtKeaRow *row, double speed);
/* s: the first t >= 0 at which gap + a t + b t²/2 becomes negative; HUGE_VAL: none. */
double kea_timeOfImpact(double gap, double a, double b);

/* ---- kea_restitution.c ---- */

/* The relative motion of two bodies along a direction. */
typedef struct KeaApproach {
    double rate, predicted; /* m/s, positive: separating; now, and at the end of the step without rows */
    double fastest;      /* m/s: lower bound of the rate in the step: the sum over both bodies of the smaller of present
                               and predicted rate. A supported body does not fall as predicted */
    double acceleration; /* m/s², in the last step */
} KeaApproach;

/* m/s: by how much the rate of a point changes in the step because it is on the face of a mover that turns. */
double kea_turningRate(const MdtKeaSystem *s, const MdtKeaManifold *m, const double arm[2][3]);
/* The approach along a row's direction. */
KeaApproach kea_approachOfRow(const MdtKeaSystem *s, const MdtKeaRow *row);
/* The approach of a point along the manifold's normal; arms point from the bodies' centres, or the world's origin, to
 * the point. */
KeaApproach kea_approachOfPoint(const MdtKeaSystem *s, const MdtKeaManifold *m, const double arm[2][3]);
/* Whether the bodies touch, or may touch within the step; gap in m. */
MeBool kea_mayTouch(const MdtKeaSystem *s, const MdtKeaBodyIndexPair body, const KeaApproach *a, double gap);
/* m/s, >= 0: the separating velocity by the law of restitution, or 0. kea_reboundOfImpact: after an impact that is
 * resolved at its time, with the approach speed `speed`, if this exceeds minSpeed; fall: what loads have added to its
 * square since the surfaces met. kea_reboundInStep: at the end of a step that contains the impact and leaves the share
 * `left` of an overlap. */
double kea_reboundOfImpact(double restitution, double threshold, double speed, double fall, double minSpeed);
double kea_reboundInStep(const MdtKeaSystem *s, const KeaApproach *a, double gap, double left, double restitution,
                         double threshold);
/* The rate that a contact has at least at the end of a step: fixed - share times that of its start. */
typedef struct KeaHop {
    double fixed, share; /* m/s; share: 0 or 1 */
} KeaHop;

/* Of a contact with restitution 1 that does not rebound in the step; min: m/s, the bound of what does not hop. */
KeaHop kea_hopInStep(const MdtKeaSystem *s, const MdtKeaBodyIndexPair body, const KeaApproach *a, double depth,
                     double threshold, double min);
/* Sets `bounces`, `rebound` and `hop` of all rows, and the targets of those that hop. */
void kea_setRebounds(MdtKeaSystem *s);

/* ---- kea_rates.c ---- */

/* m/s: the rate J v of one body of a row. */
static inline double kea_rateAlong(const MdtKeaJBlock *J, const MdtKeaVelocity *v) {
    return keaDot(J->lin, v->lin) + keaDot(J->ang, v->ang);
}

/* Whether a row may reach a bound in this step: one-sided rows always, rows with two bounds if the last force was more
 * than half of one of them. */
MeBool kea_mayReachBound(const MdtKeaRow *row);
/* Whether the bodies of a row are integrated by backward Euler (θ = 1): the row says so, or it is a spring that is too
 * stiff for the midpoint rule. */
MeBool kea_isBackward(const MdtKeaSystem *s, const MdtKeaRow *row);
/* Copies a body's Jacobian to six numbers in a row. */
static inline void kea_copyBlock(double J[6], const MdtKeaJBlock *block) {
    keaCopy(J, block->lin);
    keaCopy(J + 3, block->ang);
}
/* Adds the rate of a record, without its tail, at the end velocities to `rate`. */
static inline double kea_addEndRate(const MdtKeaSystem *s, const KeaProblemRow *p, double rate) {
    for (int k = 0; k < 2; k++)
        if (p->body[k] >= 0)
            rate += kea_bodyRate(p->J[k], s->work->body[p->body[k]].endVelocity);
    return rate;
}
/* The same with the mean velocities of the step. */
static inline double kea_addMeanRate(const MdtKeaSystem *s, const KeaProblemRow *p, double rate) {
    for (int k = 0; k < 2; k++)
        if (p->body[k] >= 0)
            rate += kea_bodyRate(p->J[k], s->work->body[p->body[k]].u);
    return rate;
}
/* m/s: rate of row i at the end velocities, with its moving rate. */
static inline double kea_endRate(const MdtKeaSystem *s, int i) {
    const KeaProblemRow *p = &s->work->problem.row[i];
    const double rate = kea_addEndRate(s, p, s->work->movingRate[i]);
    return p->isSplit ? kea_addEndRate(s, p + 1, rate) : rate;
}
/* m/s: J u of row i, with the mean velocities of the step. */
static inline double kea_meanRate(const MdtKeaSystem *s, int i) {
    const KeaProblemRow *p = &s->work->problem.row[i];
    const double rate = kea_addMeanRate(s, p, 0);
    return p->isSplit ? kea_addMeanRate(s, p + 1, rate) : rate;
}
/* m per unit of a row's coordinate: 1 for a linear row, the larger radius of gyration of its bodies for an angular
 * one. */
static inline double kea_lengthOf(const MdtKeaSystem *s, const MdtKeaRow *row) {
    double size = 0;
    for (int k = 0; k < 2; k++) {
        if (row->body[k] >= 0 && keaDot(row->J[k].lin, row->J[k].lin) > 0)
            return 1;
        size = row->body[k] >= 0 ? keaMax(size, s->work->body[row->body[k]].size) : size;
    }
    return size > 0 ? size : 1; /* both sides of a split row's head or tail may be moved by the program */
}
/* m: the smaller radius of gyration of two bodies, the scale of gaps and depths between them. */
double kea_smallerExtent(const MdtKeaSystem *s, const int body[2]);
/* Call the owner's functions, if there are any: for Jacobians at the poses after a share of the sub-step; for errors at
 * the end poses. */
void kea_evaluateJacobians(MdtKeaSystem *s, const MdtKeaTransformation poses[], double share);
void kea_evaluateErrors(MdtKeaSystem *s, double errors[]);
/* Save and restore the Jacobians of all rows (work->savedJ). */
void kea_saveJacobians(MdtKeaSystem *s);
void kea_restoreJacobians(MdtKeaSystem *s);
/* Saves the impulses of all rows (work->savedP). */
void kea_saveImpulses(MdtKeaSystem *s);
/* m/s: the absolute value of a target rate `speed`, if the bounds of the row allow the force that enforces it, else 0:
 * one-sided rows, of stops and contacts, only push, and have no effect while there is a gap. */
double kea_pushSpeed(const MdtKeaSystem *s, const MdtKeaRow *row, double speed);

/* ---- kea_spin.c ---- */

/* Gives groups of bodies that nothing fixed acts on the angular momentum that their loads leave them; after the
 * projection of velocities, and before their energy is limited. */
void kea_keepSpin(MdtKeaSystem *s);

/* ---- kea_events.c ---- */

/* Sets isOpen of all contacts at the start of a timed step. */
void kea_markOpenContacts(MdtKeaSystem *s);
/* For holdsSlow: clears isOpen of contacts whose impact, as predicted by the last solve, is within the step and too
 * slow to rebound. Returns their number. */
int kea_closeSlowContacts(MdtKeaSystem *s);
/* s: the time of the first impact or end of sliding within the step; HUGE_VAL: none. Sets *mustRepeat if contacts stop
 * sliding: the direction of their friction is then fixed against the sliding of the start (isForced), and the caller
 * has to solve again and to call again for the time. kea_releaseFriction undoes the fixing. */
double kea_firstEvent(MdtKeaSystem *s, MeBool *mustRepeat);
void kea_releaseFriction(MdtKeaSystem *s);
/* s: the time of the first impact of ballistic motion, at most the length of the step. */
double kea_firstEventOfFlight(const MdtKeaSystem *s);
/* s: the time of impact of the contact with normal row i if no row exerts a force; HUGE_VAL: none. */
double kea_freeTimeOfImpact(const MdtKeaSystem *s, int i);
/* Whether the contact with normal row i has a gap, or separates; speed: kea_eventSpeed. */
MeBool kea_isContactOpen(const MdtKeaSystem *s, int i, double speed);

/* ---- kea_impact.c ---- */

/* The scales of all bodies in their present state; after MdtKeaInit. */
KeaEventScale kea_eventScale(const MdtKeaSystem *s);
/* Resolves all impacts at the start of the step: sets velocities of bodies, and impulses in rows[i].force. False: no
 * memory. */
MeBool kea_resolveImpacts(MdtKeaSystem *s, const KeaEventScale *scale);
/* Whether impacts would chatter (MdtKeaTrembles). */
MeBool kea_impactsChatter(const MdtKeaSystem *s, const KeaEventScale *scale);
/* m/s: the scale of speeds in timed steps: the change of velocity by the loads in one step, or a small fraction of the
 * bodies' speeds if that is more. */
double kea_eventSpeed(const MdtKeaSystem *s);
/* Whether the contact of a normal row touches: its gap is below a tolerance, which is larger for one that has carried a
 * load and moves with a rolling body. */
MeBool kea_isTouching(const MdtKeaSystem *s, const MdtKeaRow *row);
/* m/s: J v - s of row i at the start; J v - drift if it is a normal row. */
double kea_startRate(const MdtKeaSystem *s, int i);
/* Set a body and a row of the inner problem of an instant, such as an impact: inertia at the start pose, no loads, no
 * springs. */
void kea_setInstantBody(KeaProblem *q, int b, const MdtKeaBody *body);
void kea_setInstantRow(const MdtKeaSystem *s, int i, KeaProblemRow *p);

/* ---- kea_carry.c ---- */

/* Displaces bodies that stick to movers whose velocity has changed, after the solve. */
void kea_carryBodies(MdtKeaSystem *s);

/* ---- kea_project.c ---- */

/* Reduces overlaps by displacing bodies, without changing velocities. */
void kea_projectPositions(MdtKeaSystem *s);
/* Whether the row is a position row without bounds. */
MeBool kea_isRigidJoint(const MdtKeaRow *row);
/* Finds the smallest change of the bodies, work->added, in the metric of the instant (kea_setInstantBody), that changes
 * the rows with isIncluded by `target`. */
void kea_solveInstant(MdtKeaSystem *s, const double target[]);

/* ---- kea_budget.c ---- */

/* Sets the cap on the work of the inner problem to a share of the whole solve's, and reserves a part of it for this
 * number of passes by sweeps. It holds until the next call. */
void kea_setBudget(MdtKeaSystem *s, double share, int sweptPasses);
/* Copies the counts of work to the report. */
void kea_reportWork(MdtKeaSystem *s);

/* ---- kea_free.c ---- */

/* Sets the end pose of body i from its KeaEnd, and its mean pose. */
void kea_setPoses(MdtKeaSystem *s, int i);
/* Set the end states of all bodies with isFree, or of body i, to those of free motion. */
void kea_moveFreeBodies(MdtKeaSystem *s);
void kea_moveFreeBody(MdtKeaSystem *s, int i);

/* ---- kea_energy.c ---- */

/* J: kinetic energy at velocity + change, of the bodies of the inner problem; change may be null. */
double kea_kineticEnergy(const MdtKeaSystem *s, double (*velocity)[6], double (*change)[6]);
/* J: an upper bound of the kinetic energy at the end: that at the start plus the work of loads, springs, motors and
 * moving attachments or surfaces. */
double kea_energyAllowed(const MdtKeaSystem *s);
/* J: kinetic energy of the whole partition at the speed with which the largest joint error is corrected. */
double kea_energyOfCorrection(const MdtKeaSystem *s);
/* Limits displacements against the loads: if these would take more than the kinetic energy of the bodies that rows act
 * on, plus the energy that the correction of errors needs, scales u of these bodies down until they take exactly that.
 * False: nothing was scaled. */
MeBool kea_limitDisplacements(const MdtKeaSystem *s);
/* The largest a in [0, 1] for which velocity + plastic + a (elastic - plastic) has at most the energy `allowed`. */
double kea_elasticShare(const MdtKeaSystem *s, double (*velocity)[6], double (*elastic)[6], double (*plastic)[6],
                        double allowed);
/* Fallback for a step that has not converged: writes the `change` that scales the velocities of all bodies that rows
 * act on down to the energy `allowed`. False: the energy is not higher, or only free bodies move. */
MeBool kea_scaleVelocities(const MdtKeaSystem *s, double (*velocity)[6], double allowed, double (*change)[6]);

/* ---- kea_residual.c ---- */

/* Residuals of a pass, in units of their tolerances (kea_policy_i.h): converged if below 1. */
typedef struct KeaResiduals {
    double position, velocity, momentum, worst;
    double attachment; /* the largest position error, in units of the rounding of the joints' attachments */
    double impulse;    /* N s: the largest change of an impulse that would remove a violation of a velocity row */
    double resolution; /* m/s: the tolerance of `velocity` */
} KeaResiduals;

/* m/s: the speed at which a body moves in the step by a double's rounding of its size: a slower one counts as resting.
 * Without this floor, a body that a motor has stopped in a world without loads would be solved in every step. */
static inline double kea_minSpeed(double size, double stepsize) {
    return DBL_EPSILON * size / stepsize;
}
/* m/s: the largest kea_minSpeed of all bodies. */
double kea_minSpeedOfAll(const MdtKeaSystem *s);
/* m/s: the largest change of a body's velocity by loads in the step. */
double kea_loadSpeed(const MdtKeaSystem *s);
/* m/s: scales of velocities, to which tolerances are relative. kea_bodySpeedScale: of the bodies' velocities and their
 * changes by loads, at least kea_minSpeedOfAll. kea_rowSpeedScale: of changes by springs and motors with the present
 * impulses. */
double kea_bodySpeedScale(const MdtKeaSystem *s);
double kea_rowSpeedScale(const MdtKeaSystem *s);
/* m/s: what the rounding of the poses that collision reads leaves in the rate of a contact, as the surface point of a
 * body that rolls or spins is known to that. */
double kea_roundingOfRates(const MdtKeaSystem *s);
/* Residuals of the present iterate, relative to the speed scale `speed`; after a linearization. Writes report.error. */
KeaResiduals kea_residuals(MdtKeaSystem *s, double speed);
/* The largest joint error that the step should have corrected and has not, relative to the smaller body's size. */
double kea_uncorrectedOpening(const MdtKeaSystem *s);
MeBool kea_isConverged(const KeaResiduals *e);
/* Whether the residuals are within `margin` times the loose tolerances, within which an answer is reported as exact;
 * kea_isMotionExactEnough: those of positions and momenta only, whatever the velocity residual is. */
MeBool kea_isExactEnough(const KeaResiduals *e, double margin);
MeBool kea_isMotionExactEnough(const KeaResiduals *e, double margin);
/* Sets errorScale of a body, after it has been moved. */
void kea_setErrorScales(MdtKeaSystem *s, int body);
/* Marks inconsistent joints, which contradict each other; after every pass. kea_isConflicting: whether the residual of
 * such a joint exceeds the rounding of attachments; kea_isInconsistent: whether it exceeds the position tolerance. */
void kea_markInconsistentJoints(MdtKeaSystem *s);
MeBool kea_isConflicting(const MdtKeaSystem *s);
MeBool kea_isInconsistent(const MdtKeaSystem *s);

/* ---- kea_dual.c ---- */

/* Chooses the primal or the dual factorization by flop count; dual.factor is null for the primal one. */
void kea_dualChooseFactor(MdtKeaSystem *s);
/* Solves the inner problem for the joints' impulses. False: kea_dualChooseFactor has chosen the primal factorization,
 * the budget is used up, or the factorization failed. */
MeBool kea_dualSolve(MdtKeaSystem *s);

/* ---- kea_redundancy.c ---- */

/* Whether joints form a loop, the world counted as a body. */
MeBool kea_hasLoops(const MdtKeaSystem *s);

/* Replaces the impulses of redundant joints by those of least norm with the same resultant on each body; overwrites the
 * metric. */
void kea_minimizeRedundantForces(MdtKeaSystem *s);

/* ---- kea_velocity.c ---- */

/* Corrects the end velocities after discontinuities, and limits their energy. */
void kea_velocityStage(MdtKeaSystem *s);
/* Limits the kinetic energy if contacts that move have added to it by more than kea_rollingGain. */
void kea_limitRolling(MdtKeaSystem *s);

#endif
