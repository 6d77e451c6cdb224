/* The path of a partition's step: which of Kea's solvers, how many impacts, and its record in the report. */
#include "island/mdt_choice_i.h"

void mdt_islandSetFast(MdtIsland *p, MeBool isFast) {
    MEASSERT(!isFast || p->mayBeFast || p->numMembers > 0);
    p->isFast = isFast;
    p->kea.parameters.solver = isFast ? MdtKeaSolverFast : MdtKeaSolverExact;
    p->kea.maxRows = p->jointRows + (isFast ? 0 : p->numContacts * MdtBclGETMAXROWSCONTACT);
    p->kea.maxContacts = isFast ? 0 : p->numContacts;
}

/* Impacts of large islands with elastic contacts are timed although some bodies are constrained, with a solve at each
 * event; impacts of other large islands only while all bodies are in flight. */
int mdt_maxConstrained(const MdtIsland *p) {
    if (p->world->timedBodies == 0 || (p->numBodies >= MDT_LARGE_ISLAND && p->losesEnergy))
        return 0;
    return MeMAX(p->world->timedBodies, p->numBodies / MDT_CONSTRAINED_SHARE);
}

/* ---- records in the report ---- */

void mdt_reportPath(MdtReport *r, MdtReportWay path) {
    if (path > r->way)
        r->way = path;
}

void mdt_reportImpact(MdtReport *r) {
    mdt_reportPath(r, MdtReportWayTimed);
}

void mdt_reportEvent(MdtReport *r) {
    r->events++;
    mdt_reportPath(r, MdtReportWayTimed);
}

/* Each impact begins a part, except the one that ends the flight: its part is counted later. */
void mdt_reportFlight(MdtReport *r, int impacts, MeBool isEnded) {
    MEASSERT(impacts >= 0);
    r->events += impacts;
    r->parts += impacts > 0 && isEnded ? impacts - 1 : impacts;
    mdt_reportPath(r, MdtReportWayTimed);
}

void mdt_reportComposed(MdtReport *r) {
    r->composed++;
}

void mdt_reportCertified(MdtReport *r) {
    r->parts = r->rested = 1;
    mdt_reportPath(r, MdtReportWayRest);
}

void mdt_reportDivision(MdtReport *r) {
    mdt_reportPath(r, MdtReportWayDivided);
}
