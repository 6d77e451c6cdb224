/* One step of a world: its stages in their order (mdt_step_i.h; Dynamics guide ch. 2; User Guide ch. 2). */
#include "MdtInternal.h"
#include "MeProfile.h"
#include "step/mdt_step_i.h"

void mdt_substepMakeRows(MdtIsland *p, double substep) {
    MeProfileStartSection("Rows", 0);
    mdt_substepBegin(p, substep);
    mdt_rowsMake(p);
    MeProfileEndSection("Rows");
}

void mdt_substepSolveRows(MdtIsland *p) {
    MeProfileStartSection("Rows", 0);
    if (p->kea.parameters.timed && MdtKeaMeets(&p->kea))
        mdt_substepImpact(p);
    if (!p->kea.parameters.timed && p->bounces && MdtKeaReflect(&p->kea) > 0)
        mdt_substepReflected(p);
    MeProfileEndSection("Rows");
    if (p->report && p->numRows > 0)
        mdt_reportLap(p, MdtReportStageRows);
    MeProfileStartSection("Solve", 0);
    mdt_budgetGrant(p);
    MdtKeaSolve(&p->kea);
    mdt_budgetDraw(p);
    MeProfileEndSection("Solve");
    if (p->report)
        mdt_reportSolve(p);
}

void mdt_substepSolve(MdtIsland *p, double substep) {
    mdt_substepMakeRows(p, substep);
    mdt_substepSolveRows(p);
}

/* False for a batch whose impulses were scaled down to limit its energy, which affects all members. */
static MeBool isAcceptable(const MdtIsland *p) {
    return p->numMembers == 0 || !p->kea.report.capped || p->kea.report.limited;
}

static void endSubstep(MdtIsland *p, MeBool isFinite) {
    if (p->report)
        mdt_reportSubstep(p->report, p, isFinite);
    if (isFinite)
        mdt_unpackConstraints(p);
    else
        mdt_unpackStopped(p);
    mdt_substepEnd(p);
}

void mdt_substepIntegrate(MdtIsland *p) {
    MeProfileStartSection("Integrate", 0);
    p->isStopped = !isAcceptable(p) || !MdtKeaIntegrate(&p->kea);
    if (!p->isStopped || p->numMembers == 0)
        endSubstep(p, !p->isStopped);
    MeProfileEndSection("Integrate");
}

void mdt_islandStep(MdtIsland *p) {
    if (!mdt_islandPack(p))
        return;
    mdt_unpackBegin(p);
    mdt_islandSubdivide(p);
    MEASSERT(p->isStopped || fabs(p->elapsed - p->h) <= 1e-6 * p->h);
    if (!p->isStopped) {
        const MeBool isSettled = mdt_islandIsSettled(p);
        if (isSettled)
            mdt_islandResetPoses(p);
        mdt_crushCapSpeeds(p);
        mdt_unpackBodies(p);
        mdt_islandCertify(p, isSettled);
    }
    mdt_choiceRecordStep(p, p->record);
    mdt_islandRelease(p);
}

/* A partition that has been put to sleep is reported, too. */
void mdt_islandAdvance(MdtIsland *p, MeBool stopAtSafeTime) {
    const double remainingTime = p->h;
    if (stopAtSafeTime)
        p->h = mdt_lagSafeStep(p);
    mdt_reportBegin(p);
    if (!p->world->output.info[p->number].isDisabled) {
        mdt_lagSet(p, remainingTime);
        if (mdt_certificateIsValid(p))
            mdt_certificateApply(p);
        else
            mdt_islandStep(p);
    }
    if (p->report)
        mdt_reportEnd(p);
}

void mdt_worldStep(MdtWorldID w, double h, MeBool stopAtSafeTime) {
    MeProfileStartSection("Dynamics", 0);
    MeProfileStartSection("Partition", 0);
    MdtWorldBeginMovers(w, (MeReal)h);
    mdt_sleepersWakeChanged(w, h);
    mdt_islandsBegin(w); /* wakes bodies that are connected to awake ones */
    mdt_sleepersEndForces(w);
    mdt_certificatesBegin(w);
    if (w->isReported)
        mdt_reportStep(w);
    MeProfileEndSection("Partition");
    mdt_islandsStep(w, h, stopAtSafeTime);
    if (w->isReported)
        mdt_reportStepEnd(w);
    mdt_moversEnd(w, h);
    MeProfileEndSection("Dynamics");
    mdt_islandsEnd(w);
    if (w->debugDraw)
        mdt_debugDraw(w);
}
