/* Inside Kea: the problem that every pass of a step, and every impact, comes down to.
 *
 * Bodies i with unknowns d_i (6), a metric B_i (symmetric, positive) and a load g_i; rows with p within bounds:
 *
 *     B d + g = Jᵀ p,       J d + E p = r   where p is within its bounds,
 *
 * and at a bound J d + E p - r has the sign that the bound allows (complementarity). Bounds of friction rows are μ
 * times the p of their normal row; two friction rows may share a cone. Without friction this is the minimum of a convex
 * function.
 *
 * In a tangent problem d changes rows by the derivative T of their errors at the end of the step, while their impulses
 * act along J at its middle, and B is the derivative of the momentum itself: T d + E p = r. That is Newton's method for
 * the whole step: unsymmetric, but quadratically convergent. The symmetric one diverges, even from the solution, where
 * T and J differ in sign, as when a linkage passes its change point within the step.
 *
 * Rows may be rigid (E = 0) or redundant: the primal problem is solved by the proximal point method with the parameter
 * N (augmented Lagrangian), (E + N) p = r - J d + N p0, then p0 := p; N has no effect on the converged answer.
 */
#ifndef KEA_PROBLEM_I_H
#define KEA_PROBLEM_I_H

#include "MdtKea.h"
#include "MdtKeaMath.h"
#include "common/kea_arena_i.h"
#include "inner/kea_doubles_i.h"
#include "inner/kea_factor_i.h"
#include "inner/kea_graph_i.h"

typedef struct KeaMetric {
    double linear;        /* kg, times the unit matrix */
    double angular[3][3]; /* kg m² */
    double inverse[3][3]; /* of angular */
} KeaMetric;

typedef enum KeaRowState { KEA_IDLE, KEA_ACTIVE, KEA_SLIPS } KeaRowState; /* at a bound; within bounds; on the cone */

typedef struct KeaProblemRow {
    double J[2][6];
    int body[2]; /* MdtKeaWORLD: none */
    int edge;    /* of the graph, -1: one body */
    int normal, partner;
    double friction;
    double lower, upper;  /* N s */
    double E;             /* 1/kg */
    double N;             /* 1/kg, parameter of the proximal point method */
    double r;             /* m/s */
    double p0, p;         /* N s */
    double y, yRate;      /* N s, p without bounds, and its derivative along the search direction */
    double affine;        /* N s, p as an affine function of d for fixed states (kea_states.c), not clamped */
    double along, across; /* sliding: component of the unit direction of sliding; kg, stiffness at right angles to it */
    double frictionBound; /* N s, R of the row or its cone */
    double keptJd, keptBound;
    double lastBound, lastBoundError; /* N s, R and μ p_n - R in the last kea_frictionApproachBounds */
    double Jd, Je;                    /* along d, along the search direction */
    double previousP, bestP;          /* N s, of sweeps: p before the last one; p of the least objective */
    double Aii;                       /* 1/kg, J B⁻¹ Jᵀ: the inverse of the effective mass, */
    double AiiLinear;                 /* and the part of it by translation, without lever arms */
    double weight[2];                 /* by body: |J| with lengths in units of the body's size */
    MeBool isForced;                  /* the direction of sliding is known: p is `forced` times the friction bound */
    double forced;
    MeBool isUnmet, isInconsistent; /* a joint that kept most of its residual in the last pass; in the last two */
    MeBool isCheckedElsewhere;      /* kea_problemResidual leaves it out: its error is checked in positions */
    MeBool isInactive;              /* inactive: p is constant */
    MeBool isAside;                 /* inactive during kea_problemSolveJoints */
    MeBool isOut;                   /* inactive in all solves of the step: it has no edge in the graph */
    KeaRowState state, factored;    /* now; when the matrix was factored */
} KeaProblemRow;

typedef struct KeaCounts {
    int iterations, factorizations;
    int freezes;      /* passes with frozen friction bounds */
    int stuck;        /* 1: in the last pass friction bounds did not converge, or were frozen */
    int level;        /* index of N in kea_proximalContact */
    double work;      /* multiplications */
    MeBool isLimited; /* the budget is used up: from there on, solves are by sweeps */
} KeaCounts;

typedef struct KeaProblem {
    int numBodies, numRows;
    KeaProblemRow *row;
    double (*tangent)[2][6];        /* by row: T of a tangent problem, else unused */
    KeaMetric *metric;              /* by body */
    double (*tangentInertia)[3][3]; /* by body: in a tangent problem in place of metric.angular */
    double (*load)[6], (*d)[6];     /* g, d */
    double (*savedD)[6];            /* d of the convex problem; of sweeps, d before the last one */
    double (*gradient)[6];          /* B d + g - Jᵀ p in the last iteration */
    double (*direction)[6];         /* search direction of the last iteration */
    double *scale, *length;         /* by body: N s, m, scales of the gradient */
    double *tolerance;              /* by body: N s, of its gradient */
    double *x;                      /* unknowns as the factor has them */
    KeaGraph graph;                 /* of the bodies, by rows that join two */
    KeaFactor *factor;
    MeBool hasFriction; /* friction that depends on normal forces */
    MeBool hasBounds;   /* of any kind */
    MeBool hasTangent;  /* T and tangentInertia are set: coupled solves are of the tangent problem */
    MeBool isTangent;   /* the solve in progress is of the tangent problem */
    MeBool isSingular;  /* the last solve of the tangent problem failed */
    MeBool isLinear;    /* J, T and N are constant from solve to solve */
    MeBool isFactored;  /* the factors are of a tangent or linear problem of this step */
    int factoredLevel;  /* counts.level of these factors */
    MeBool isWarm;      /* coupled solves begin with the states that follow from p */
    int maxIterations;  /* of all solves together; 0: no cap */
    double maxWork;     /* the same; 0: no cap */
    double reserve;     /* the part of maxWork that is reserved for sweeps */
    int sweptPasses;    /* passes by sweeps left, which share the work that is left */
    KeaCounts counts;
} KeaProblem;

static inline double kea_dot6(const double a[6], const double b[6]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5];
}

/* r += s a */
static inline void kea_addScaled6(double *restrict r, double s, const double *restrict a) {
    for (int i = 0; i < 6; i += 2)
        putTwo(r + i, twoAt(r + i) + s * twoAt(a + i));
}

/* r = B d */
static inline void kea_applyMetric(double r[6], const KeaMetric *B, const double d[6]) {
    for (int i = 0; i < 3; i++)
        r[i] = B->linear * d[i];
    keaApply(r + 3, B->angular, d + 3);
}

/* N s: μ p of the row's normal row. */
static inline double kea_frictionBound(const KeaProblem *q, const KeaProblemRow *row) {
    return row->friction * keaMax(q->row[row->normal].p, 0);
}

/* ---- kea_problem.c ---- */
void kea_problemLayOut(KeaProblem *q, int numBodies, int maxRows, KeaArena *arena);
/* Finds the graph of the rows and its factor in the cache. False: no memory. */
MeBool kea_problemBegin(KeaProblem *q, struct MdtKeaCache *cache);
/* Sets Aii, AiiLinear and weight of all rows, from the metric. */
void kea_problemSetEffectiveMasses(KeaProblem *q);
/* Whether the budget has room for one more Newton iteration; kea_problemMaySpend also sets isLimited if it has not.
 * `unsymmetric`: of the coupled problem. */
MeBool kea_problemHasBudget(const KeaProblem *q, MeBool unsymmetric);
MeBool kea_problemMaySpend(KeaProblem *q, MeBool unsymmetric);
/* Multiplications of one Newton iteration. */
double kea_problemIterationWork(const KeaProblem *q, MeBool unsymmetric);
void kea_problemAddWork(KeaProblem *q, double work);
/* The largest projected residual of all rows, m/s: A_ii times the change of p by which the row alone would fulfil its
 * law within its bounds. `impulse`, unless null: that change, N s. */
double kea_problemResidual(const KeaProblem *q, double *impulse);
/* Adds d to `total`, and moves it into loads and targets, so that the next solve is for the rest. */
void kea_problemAccumulate(KeaProblem *q, double (*total)[6]);
/* J: aᵀ B b / 2. */
double kea_energyOf(const KeaMetric *B, const double a[6], const double b[6]);
/* ---- kea_newton.c ---- */
/* Solves the convex problem with the fixed friction bounds in `frictionBound`; if `coupled`, then the problem in which
 * they are μ p_n of the solution. False: the coupled problem did not converge, and the solution is the convex one; or
 * the budget is used up, and it is by sweeps. */
MeBool kea_problemSolve(KeaProblem *q, MeBool coupled);
/* Solves a tangent or linear problem with the factors of the last one. False: states or N have changed, or it does not
 * converge; d is 0, p unchanged. */
MeBool kea_problemRefine(KeaProblem *q);
/* |B d + g - Jᵀ p| at d = 0, in tolerances. */
double kea_problemError(KeaProblem *q);
/* Solves for the impulses of unbounded rows (joints), all others fixed: one linear solve, which lowers the objective as
 * a sweep does. Needs d and Jd. Its work, multiplications: 0 where there are no such rows. */
void kea_problemSolveJoints(KeaProblem *q);
double kea_problemWorkOfJoints(const KeaProblem *q);
/* ---- kea_sweep.c ---- */
/* Solves by sweeps, within a share of the work that is left, but KEA_FEWEST_SWEEPS at least. Needs the metric's inverse
 * and Aii. */
void kea_problemSweep(KeaProblem *q);
/* Multiplications of a solve by so many sweeps and of its linearization. */
double kea_problemWorkOfSweptPass(const KeaProblem *q, int sweeps);
/* Whether one more pass of KEA_FEWEST_SWEEPS is within the budget. */
MeBool kea_problemMaySweep(const KeaProblem *q);
/* ---- kea_friction.c ---- */
/* The largest relative difference of a friction bound from μ p of its normal row. */
double kea_frictionBoundsError(const KeaProblem *q);
/* Sets every friction bound to μ p of its normal row. */
void kea_frictionRenewBounds(KeaProblem *q);
/* One accelerated step of the fixed point iteration of the friction bounds. */
void kea_frictionApproachBounds(KeaProblem *q, int pass);

#endif
