/* The path of a partition's step: which of Kea's solvers, how many impacts, and its record in the report. */
#include "island/mdt_choice_i.h"

void mdt_islandSetFast(MdtIsland *p, MeBool isFast) {
    MEASSERT(!isFast || p->mayBeFast || p->numMembers > 0);
    p->isFast = isFast;
    p->kea.parameters.solver = isFast ? MdtKeaSolverFast : MdtKeaSolverExact;
    p->kea.maxRows = p->jointRows + (isFast ? 0 : p->contactRows);
    p->kea.maxContacts = isFast ? 0 : p->numContacts;
}

/* Impacts of large islands with elastic contacts are timed although some bodies are constrained, with a solve at each
 * event; impacts of other large islands only while all bodies are in flight. */
int mdt_maxConstrained(const MdtIsland *p) {
    if (p->world->timedBodies == 0 || (p->numBodies >= MDT_LARGE_ISLAND && p->losesEnergy))
        return 0;
    return MeMAX(p->world->timedBodies, p->numBodies / MDT_CONSTRAINED_SHARE);
}

void mdt_reportPath(MdtReport *r, MdtReportWay path) {
    if (r && path > r->way)
        r->way = path;
}
