/* The work budget of a solve, and the report of the work done. */
#include "kea_i.h"
#include "common/kea_policy_i.h"
#include "MeAssert.h"

/* An iteration cap also limits the number of passes by sweeps: a program that sets it wants cheaper steps. At most half
 * of the remaining work is reserved for sweeps. */
void kea_setBudget(MdtKeaSystem *s, double share, int sweptPasses) {
    MEASSERT(share > 0 && share <= 1 && sweptPasses >= 0);
    KeaProblem *q = &s->work->problem;
    q->maxIterations = s->parameters.maxIterations;
    if (q->maxIterations > 0 && q->maxIterations < sweptPasses)
        sweptPasses = 1 + q->maxIterations;
    q->maxWork = share * s->parameters.maxWork;
    q->sweptPasses = sweptPasses;
    q->reserve = s->parameters.mayDecline ? 0
                                          : keaMin(sweptPasses * kea_problemWorkOfSweptPass(q, KEA_SWEEPS),
                                                   0.5 * keaMax(q->maxWork - q->counts.work, 0));
    MEASSERT(q->maxWork >= 0 && q->reserve >= 0);
    q->counts.isLimited = MEFALSE;
}

void kea_reportWork(MdtKeaSystem *s) {
    const KeaCounts *counts = &s->work->problem.counts;
    s->report.iterations = counts->iterations;
    s->report.factorizations = counts->factorizations;
    s->report.freezes = counts->freezes;
    s->report.work = counts->work;
    if (counts->isLimited) /* since the last kea_setBudget */
        s->report.limited = s->report.capped = METRUE;
}
