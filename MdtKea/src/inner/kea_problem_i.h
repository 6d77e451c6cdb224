/* Inside Kea: the inner problem, which every pass of a step and every impact solves.
 *
 * Bodies i have 6 unknowns d_i, a metric B_i (symmetric, positive) and a load g_i; rows have impulses p within bounds:
 *
 *     B d + g = Jᵀ p,       J d + E p = r   where p is within its bounds,
 *
 * and at a bound J d + E p - r has the sign that the bound allows (complementarity). The bound of a friction row is μ
 * times the p of its normal row; two friction rows may share a cone. Without friction, the solution is the minimum of a
 * convex function.
 *
 * In the tangent problem rows are T d + E p = r, with T the derivative of their errors at the end of the step, while
 * impulses still act along J in its middle, and B is the exact derivative of the momentum. This is Newton's method for
 * the whole step: unsymmetric, but quadratically convergent. The symmetric problem diverges, even from the solution, if
 * T and J differ in sign, as when a linkage passes its change point within the step.
 *
 * Rows may be rigid (E = 0) or redundant, since the primal problem is solved by the proximal point method with the
 * parameter N (augmented Lagrangian), (E + N) p = r - J d + N p0, then p0 := p; N has no effect on the converged
 * answer.
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

/* KEA_IDLE: at a bound; KEA_ACTIVE: within the bounds; KEA_SLIPS: at the friction bound. */
typedef enum KeaRowState { KEA_IDLE, KEA_ACTIVE, KEA_SLIPS } KeaRowState;

typedef struct KeaProblemRow {
    double J[2][6];
    int body[2]; /* indices of the problem's bodies, or MdtKeaWORLD */
    int edge;    /* index of the graph's edge; -1: the row has one body, or isOut */
    int normal, partner;
    MeBool isSplit, isTail; /* MdtKeaRow; the tail has no impulse of its own, and what is said of A_ii is the head's */
    int bent;               /* of a bend: the row whose direction turns (kea_bend.c) */
    double friction;
    double lower, upper;      /* N s */
    double E;                 /* 1/kg */
    double N;                 /* 1/kg, parameter of the proximal point method */
    double r;                 /* m/s */
    double p0, p;             /* N s */
    double y, yRate;          /* N s, p without bounds, and its derivative along the search direction */
    double affine;            /* N s, p as an affine function of d for fixed states (kea_states.c), not clamped */
    double along, across;     /* sliding rows: component of the unit direction of sliding; kg, stiffness across it */
    double frictionBound;     /* N s, R of the row or of its cone */
    double keptJd, keptBound; /* saved Jd and frictionBound */
    double lastBound, lastBoundError; /* N s, R and μ p_n - R in the last kea_frictionIterateBounds */
    double Jd, Je;                    /* m/s, J d, and the same of the search direction (T in a tangent problem) */
    double previousP, bestP;          /* N s, sweeps: p before the last one; p of the smallest objective */
    double Aii;                       /* 1/kg, J B⁻¹ Jᵀ: the inverse of the effective mass */
    double AiiLinear;                 /* 1/kg, the part of Aii due to translation, without lever arms */
    double weight[2];                 /* by body: |J| with lengths in units of the body's size */
    MeBool isForced;                  /* the direction of sliding is known: p is `forced` times the friction bound */
    double forced;
    MeBool isUnmet, isInconsistent; /* a joint that kept most of its residual in the last pass; in the last two */
    MeBool isCheckedElsewhere;      /* kea_problemResidual skips the row: its position error is checked instead */
    MeBool isInactive;              /* p is constant */
    MeBool isDeactivated;           /* temporarily inactive, during kea_problemSolveJoints */
    MeBool isOut;                   /* inactive in all solves of the step: the graph has no edge for it */
    KeaRowState state, factored;    /* present state; state when the matrix was factored */
} KeaProblemRow;

typedef struct KeaCounts {
    int iterations, factorizations;
    int freezes;      /* passes with frozen friction bounds */
    int stuck;        /* 1: friction bounds have not converged in the last pass, or were frozen */
    int level;        /* index of N in kea_proximalContact */
    int slow;         /* passes that have left more than half of the residual */
    double work;      /* multiplications */
    MeBool isLimited; /* the budget is used up: from now on, solves are by sweeps */
} KeaCounts;

typedef struct KeaProblem {
    int numBodies, numRows;
    KeaProblemRow *row;
    double (*tangent)[2][6];        /* by row: T of a tangent problem, else unused */
    KeaMetric *metric;              /* by body */
    double (*tangentInertia)[3][3]; /* by body: in a tangent problem in place of metric.angular */
    double (*load)[6], (*d)[6];     /* g, d */
    double (*savedD)[6];            /* saved d of the convex problem; in sweeps, d before the last sweep */
    double (*gradient)[6];          /* B d + g - Jᵀ p in the last iteration */
    double (*direction)[6];         /* search direction of the last iteration */
    double *scale, *length;         /* by body: N s, scale of its impulses; m, its size */
    double *tolerance;              /* by body: N s, tolerance of its gradient */
    double *x;                      /* right side, then solution, in the order of the factor's unknowns */
    KeaGraph graph;                 /* bodies, with an edge for each pair that rows join */
    KeaFactor *factor;
    MeBool hasFriction; /* some friction bound depends on a normal force */
    MeBool hasBounds;   /* some row has bounds of any kind */
    MeBool hasTangent;  /* T and tangentInertia are set: coupled solves use the tangent problem */
    MeBool isTangent;   /* the solve in progress is of the tangent problem */
    MeBool isSingular;  /* the last solve of the tangent problem failed */
    MeBool isLinear;    /* J, T and N are the same in successive solves: factors may be kept */
    MeBool isChord;     /* successive solves of the passes differ little but in loads and r: factors are kept, too */
    MeBool isFactored;  /* the factors are those of a tangent, linear or chord problem of this step */
    int factoredLevel;  /* counts.level of these factors */
    MeBool isWarm;      /* coupled solves start with the states that follow from p */
    int maxIterations;  /* cap on the iterations of all solves together; 0: none */
    double maxWork;     /* cap on their work; 0: none */
    double reserve;     /* the part of maxWork that is reserved for sweeps */
    int sweptPasses;    /* remaining passes by sweeps, which share the remaining work */
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

/* J v of one body: the sum of its linear and its angular part, each rounded (unlike kea_dot6). */
static inline double kea_bodyRate(const double J[6], const double v[6]) {
    return keaDot(J, v) + keaDot(J + 3, v + 3);
}

/* J v of a row without its tail; v by body. */
static inline double kea_recordRate(const KeaProblemRow *row, double (*const v)[6]) {
    double rate = 0;
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            rate += kea_bodyRate(row->J[k], v[row->body[k]]);
    return rate;
}

/* J v of a row; v by body. */
static inline double kea_rowRate(const KeaProblemRow *row, double (*const v)[6]) {
    const double rate = kea_recordRate(row, v);
    return row->isSplit ? rate + kea_recordRate(row + 1, v) : rate;
}

/* Adds Jᵀ p of a row without its tail to `total`, by body. */
static inline void kea_addRecordForce(double (*total)[6], const KeaProblemRow *row, double p) {
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            kea_addScaled6(total[row->body[k]], p, row->J[k]);
}

/* Adds Jᵀ p of a row to `total`, by body. */
static inline void kea_addRowForce(double (*total)[6], const KeaProblemRow *row, double p) {
    kea_addRecordForce(total, row, p);
    if (row->isSplit)
        kea_addRecordForce(total, row + 1, p);
}

/* N s: the impulse of row i, of a tail that of its head. */
static inline double kea_impulseOf(const KeaProblem *q, int i) {
    return q->row[i].isTail ? q->row[i - 1].p : q->row[i].p;
}

/* r = B d */
static inline void kea_applyMetric(double r[6], const KeaMetric *B, const double d[6]) {
    for (int i = 0; i < 3; i++)
        r[i] = B->linear * d[i];
    keaApply(r + 3, B->angular, d + 3);
}

/* N s: the friction bound by the present normal impulse, μ p of the row's normal row. */
static inline double kea_frictionBound(const KeaProblem *q, const KeaProblemRow *row) {
    return row->friction * keaMax(q->row[row->normal].p, 0);
}

/* ---- kea_problem.c ---- */
void kea_problemLayOut(KeaProblem *q, int numBodies, int maxRows, KeaArena *arena);
/* Finds the graph of the rows and its factor in the cache. False: no memory. */
MeBool kea_problemBegin(KeaProblem *q, struct MdtKeaCache *cache);
/* Sets Aii, AiiLinear and weight of all rows, from the metric. */
void kea_problemSetEffectiveMasses(KeaProblem *q);
/* Gives both rows of each cone the larger N of the two. */
void kea_problemShareN(KeaProblem *q);
/* Whether the budget is enough for one more Newton iteration; kea_problemMaySpend also sets isLimited if it is not.
 * `unsymmetric`: of the coupled problem. */
MeBool kea_problemHasBudget(const KeaProblem *q, MeBool unsymmetric);
MeBool kea_problemMaySpend(KeaProblem *q, MeBool unsymmetric);
/* Multiplications of one Newton iteration. */
double kea_problemIterationWork(const KeaProblem *q, MeBool unsymmetric);
/* Multiplications of a linearization of all rows and bodies. */
double kea_problemWorkOfLinearization(const KeaProblem *q);
void kea_problemAddWork(KeaProblem *q, double work);
/* m/s: the largest projected residual of all rows: A_ii times the change of p that would make the row alone fulfil its
 * law within its bounds. Writes the largest such change, N s, to `impulse` unless null. */
double kea_problemResidual(const KeaProblem *q, double *impulse);
/* Adds d to `total`, and its effect to loads and r, so that the next solve finds the remaining change. */
void kea_problemAccumulate(KeaProblem *q, double (*total)[6]);
/* aᵀ B b / 2: J, if a and b are velocities. */
double kea_energyOf(const KeaMetric *B, const double a[6], const double b[6]);
/* ---- kea_newton.c ---- */
/* Solves the convex problem with the fixed friction bounds `frictionBound`; if `coupled`, the problem in which they are
 * μ p_n of the solution. False: the coupled problem did not converge, and the solution is that of the convex one; or
 * the budget is used up, and the solution is by sweeps. */
MeBool kea_problemSolve(KeaProblem *q, MeBool coupled);
/* Solves a tangent, linear or chord problem with the factors of the last one. False: states or N have changed, or the
 * solve does not converge; then d is 0 and p unchanged. */
MeBool kea_problemRefine(KeaProblem *q);
/* The largest |B d + g - Jᵀ p| of a body at d = 0, in tolerances. */
double kea_problemError(KeaProblem *q);
/* Solves for the impulses of unbounded rows (joints) with all others fixed: one linear solve, which lowers the
 * objective as a sweep does. Needs d and Jd. */
void kea_problemSolveJoints(KeaProblem *q);
/* ---- kea_sweep.c ---- */
/* Solves by sweeps, within a share of the remaining work, but at least by KEA_FEWEST_SWEEPS. Needs the metric's inverse
 * and Aii. */
void kea_problemSweep(KeaProblem *q);
/* Multiplications of a pass by this number of sweeps: of its linearization and its solve. */
double kea_problemWorkOfSweptPass(const KeaProblem *q, int sweeps);
/* Whether one more pass of KEA_FEWEST_SWEEPS is within the budget. */
MeBool kea_problemMaySweep(const KeaProblem *q);
/* ---- kea_friction.c ---- */
/* The largest relative difference of a friction bound from μ p of its normal row. */
double kea_frictionBoundsError(const KeaProblem *q);
/* Sets every friction bound to μ p of its normal row. */
void kea_frictionSetBounds(KeaProblem *q);
/* Makes one accelerated step of the fixed point iteration of the friction bounds. */
void kea_frictionIterateBounds(KeaProblem *q, int pass);

#endif
