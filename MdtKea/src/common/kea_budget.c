/* How much work a solve may take, and what it has taken. */
#include "kea_i.h"
#include "common/kea_policy_i.h"

/* Under an iteration cap, the number of passes by sweeps is capped in proportion, as the cap is to make a step cheaper.
 * Sweeps get at most half of the work that is left. */
void kea_setBudget(MdtKeaSystem *s, double share, int sweptPasses) {
    KeaProblem *q = &s->work->problem;
    q->maxIterations = s->parameters.maxIterations;
    if (q->maxIterations > 0 && q->maxIterations < sweptPasses)
        sweptPasses = 1 + q->maxIterations;
    q->maxWork = share * s->parameters.maxWork;
    q->sweptPasses = sweptPasses;
    q->reserve = s->parameters.mayDecline ? 0
                                          : keaMin(sweptPasses * kea_problemSweptPass(q, KEA_SWEEPS),
                                                   0.5 * keaMax(q->maxWork - q->counts.work, 0));
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
