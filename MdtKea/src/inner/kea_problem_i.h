/* Inside Kea: the problem that every pass of a step, and every impact, comes down to.
 *
 * Bodies i with unknowns d_i (6), a metric B_i (symmetric, positive) and a load g_i; rows with p within bounds:
 *
 *     B d + g = Jᵀ p,       J d + E p = r   where p is within its bounds,
 *
 * p at a bound where J d + E p - r has the sign that the bound allows. Bounds of friction rows are μ times the p of
 * their normal row; two friction rows may share a cone. Without friction this is the minimum of a convex function.
 *
 * In a tangent problem d changes rows by the derivative T of their errors at the end of the step, while their impulses
 * act along J at its middle, and B is the derivative of the momentum itself: T d + E p = r. That is Newton's method for
 * the step, unsymmetric, and quadratic where the symmetric one diverges: where T and J differ in sign, as when a
 * linkage passes its change point within the step, the latter leaves the answer that it has found.
 *
 * Rows that are rigid, E = 0, or redundant make no trouble: the method works on the bodies' side, with a softness N of
 * its own that it takes out again (a proximal point: (E + N) p = r - J d + N p0, then p0 := p).
 */
#ifndef KEA_PROBLEM_I_H
#define KEA_PROBLEM_I_H

#include "MdtKea.h"
#include "MdtKeaMath.h"
#include "common/kea_arena_i.h"
#include "inner/kea_factor_i.h"
#include "inner/kea_graph_i.h"

typedef struct KeaMetric {
    double linear;        /* kg, times the unit matrix */
    double angular[3][3]; /* kg m² */
    double inverse[3][3]; /* of angular */
} KeaMetric;

typedef enum KeaRowState { KEA_IDLE, KEA_HELD, KEA_SLIPS } KeaRowState; /* at a bound; within; on the cone */

typedef struct KeaProblemRow {
    double J[2][6];
    int body[2]; /* MdtKeaWORLD: none */
    int edge;    /* of the graph, -1: one body */
    int normal, partner;
    double friction;
    double lower, upper;  /* N s */
    double E;             /* 1/kg */
    double N;             /* 1/kg, the method's own softness */
    double r;             /* m/s */
    double p0, p;         /* N s */
    double y;             /* N s, what p would be without bounds */
    double affine;        /* N s, p as the last states have it, bounds or not */
    double along, across; /* of what slides: its part of the direction; kg, the stiffness across that */
    double frictionBound; /* N s, of the row or its cone, as last set */
    double keptJd, keptBound;
    double lastBound, lastBoundError; /* N s, of the last approach to the bounds that the normal forces give */
    double Jd, Je;                    /* along d, along the search direction */
    double last, best;                /* N s, before the last sweep; with the least energy of all sweeps */
    double size;                      /* J B⁻¹ Jᵀ, 1/kg */
    double weight[2];                 /* by body: the momentum, in its scale, that a unit of p gives */
    MeBool isForced;                  /* p is `forced` times the friction bound: the direction of sliding is known */
    double forced;
    MeBool isUnmet, isInconsistent; /* a joint that left most of its residual: in the last pass, in the last two */
    MeBool isElsewhere;             /* its law is checked by others (kea_problemResidual) */
    MeBool isOff;                   /* takes no part: p stays what it is; */
    MeBool isAside;                 /* for the time being; */
    MeBool isOut;                   /* for good: it has no place in the matrix */
    KeaRowState state, factored;    /* now; when the matrix was factored */
} KeaProblemRow;

typedef struct KeaCounts {
    int iterations, factorizations, freezes, stuck, level;
    double work;      /* multiplications */
    MeBool isLimited; /* the work or the iterations have run out: from there on, solves are by sweeps */
} KeaCounts;

typedef struct KeaProblem {
    int numBodies, numRows;
    KeaProblemRow *row;
    double (*tangent)[2][6];            /* by row: T of a tangent problem, else unused */
    KeaMetric *metric;                  /* by body */
    double (*turning)[3][3];            /* by body: in a tangent problem in place of metric.angular */
    double (*load)[6], (*d)[6];         /* g, d */
    double (*kept)[6];                  /* d before the friction bounds were coupled */
    double (*gradient)[6], (*along)[6]; /* of the last iteration */
    double *scale, *length;             /* by body: N s, m, what gradients are compared with */
    double *allowed;                    /* by body: N s, of its gradient */
    double *x;                          /* unknowns as the factor has them */
    KeaGraph graph;                     /* of the bodies, by rows that join two */
    KeaFactor *factor;
    MeBool hasFriction; /* friction that depends on normal forces */
    MeBool hasBounds;   /* of any kind */
    MeBool hasTangent;  /* T and the derivatives of momenta are there: coupled solves are of the tangent problem; */
    MeBool isTangent;   /* what is being solved is one; */
    MeBool isSingular;  /* that failed in the last solve */
    MeBool isLinear;    /* J, T and N stay what they are from solve to solve */
    MeBool isFactored;  /* the factors are those of a tangent or linear problem of this step, */
    int factoredLevel;  /* with this level of N */
    MeBool isWarm;      /* p tell the states of the rows: coupled solves begin with these */
    int maxIterations;  /* of all solves together; 0: no cap */
    double maxWork;     /* the same; 0: no cap */
    double reserve;     /* of it, that is kept for sweeps, */
    int sweptPasses;    /* that share what work is left when it runs out */
    KeaCounts counts;
} KeaProblem;

static inline double kea_dot6(const double a[6], const double b[6]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5];
}

/* r += s a */
static inline void kea_addScaled6(double *restrict r, double s, const double *restrict a) {
    for (int i = 0; i < 6; i++)
        r[i] += s * a[i];
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
/* Sizes of the rows, from the metric. */
void kea_problemMeasure(KeaProblem *q);
/* Whether the budget, of work and of iterations, has room for one more of Newton's; the second notes that the solve is
 * limited from now on if it has not. `unsymmetric`: of the coupled problem. */
MeBool kea_problemHasBudget(const KeaProblem *q, MeBool unsymmetric);
MeBool kea_problemMaySpend(KeaProblem *q, MeBool unsymmetric);
/* Multiplications of one iteration: the matrix and its factors, a solution with them, and some visits of each row. */
double kea_problemIterationWork(const KeaProblem *q, MeBool unsymmetric);
void kea_problemSpend(KeaProblem *q, double work);
/* How far the rows' laws are from being kept by d and p, m/s, without what their own softness takes; and in impulses,
 * N s, if asked for. */
double kea_problemResidual(const KeaProblem *q, double *impulse);
/* Adds d to `total` and makes it part of the load and the targets: the next solve asks for what is left. */
void kea_problemCarryOn(KeaProblem *q, double (*total)[6]);
/* The product of two velocities in a metric, halved: of one with itself its kinetic energy. */
double kea_energyOf(const KeaMetric *B, const double a[6], const double b[6]);
/* ---- kea_newton.c ---- */
/* Solves with the friction bounds in `frictionBound`; coupled, goes on to those of the solution itself. False: that
 * did not converge, and the solution is the one with these; or work or iterations ran out, and it is by sweeps. */
MeBool kea_problemSolve(KeaProblem *q, MeBool coupled);
/* A tangent or a linear problem with the factors of the last one, where states and N are the same. False: d is 0, p are
 * kept. */
MeBool kea_problemRefine(KeaProblem *q);
/* How far B d + g is from Jᵀ p, in tolerances. */
double kea_problemError(KeaProblem *q);
/* The rows without bounds alone, exactly, where all others have the impulses that they have: one linear solve, which
 * lowers the energy, as a sweep does. Needs d and Jd; and its work, 0 where there are no such rows. */
void kea_problemSolveJoints(KeaProblem *q);
double kea_problemWorkOfJoints(const KeaProblem *q);
/* ---- kea_sweep.c ---- */
/* Solves by sweeps, in a share of what work is left, but at least a few. Needs the metric's inverse and the sizes. */
void kea_problemSweep(KeaProblem *q);
/* The work of a solve by so many sweeps, and of the linearization that goes with it. */
double kea_problemSweptPass(const KeaProblem *q, int sweeps);
/* Whether there is work, and a pass, left for one with the fewest. */
MeBool kea_problemMaySweep(const KeaProblem *q);
/* ---- kea_friction.c ---- */
/* How far the friction bounds are from μ p of their normal rows, relative. */
double kea_frictionBoundsError(const KeaProblem *q);
/* Sets every friction bound to μ p of its normal row. */
void kea_frictionRenewBounds(KeaProblem *q);
/* Takes every friction bound towards it: all the way in the first passes, later on with what the last call has
 * taught. */
void kea_frictionApproachBounds(KeaProblem *q, int pass);

#endif
