/* Updates of friction bounds between solves of the inner problem: an accelerated fixed point iteration R = μ p_n(R). */
#include "common/kea_policy_i.h"
#include "inner/kea_problem_i.h"
#include <float.h>
#include <math.h>

double kea_frictionBoundsError(const KeaProblem *q) {
    double worst = 0;
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        if (row->normal < 0 || row->isInactive)
            continue;
        const double coulomb = kea_frictionBound(q, row);
        if (row->state == KEA_SLIPS || keaHypotenuse(row->p, row->partner >= 0 ? q->row[row->partner].p : 0) > coulomb)
            worst = keaMax(worst, fabs(row->frictionBound - coulomb) / (coulomb + DBL_MIN));
    }
    return worst;
}

void kea_frictionSetBounds(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++)
        if (q->row[i].normal >= 0)
            q->row[i].frictionBound = kea_frictionBound(q, &q->row[i]);
}

/* The coefficient t = f·Δf / |Δf|² of Anderson's acceleration, f = μ p_n - R the residual, Δf its change since the last
 * step. */
static double secant(const KeaProblem *q) {
    double above = 0, below = 0;
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        if (row->normal < 0 || !isfinite(row->frictionBound) || !isfinite(row->lastBoundError))
            continue;
        const double f = kea_frictionBound(q, row) - row->frictionBound, change = f - row->lastBoundError;
        above += f * change;
        below += change * change;
    }
    return below > 0 ? keaMin(keaMax(above / below, kea_minSecant), kea_maxSecant) : 0;
}

/* R' = R + β f - t (ΔR + β Δf): Anderson's acceleration (1965) with a history of one step. The relaxation β is 1 in the
 * first passes, then 1/2, which damps bounds that alternate between two values. */
void kea_frictionIterateBounds(KeaProblem *q, int pass) {
    const double share = pass < KEA_FULL_BOUND_PASSES ? 1 : 0.5, t = pass > KEA_FULL_BOUND_PASSES ? secant(q) : 0;
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        if (row->normal < 0)
            continue;
        const double bound = row->frictionBound, coulomb = kea_frictionBound(q, row), f = coulomb - bound;
        double next = isfinite(bound) ? bound + share * f : coulomb;
        if (t != 0 && isfinite(bound) && isfinite(row->lastBound))
            next -= t * (bound - row->lastBound + share * (f - row->lastBoundError));
        row->frictionBound = keaMax(next, 0);
        row->lastBound = bound;
        row->lastBoundError = f;
    }
}
