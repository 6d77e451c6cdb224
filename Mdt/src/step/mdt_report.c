/* The report of a step (MdtReport.h), which the stages write and programs read.
 *
 * Time is measured in laps: each reading of the clock ends one stage and begins the next. Small partitions are stepped
 * in less than a microsecond, so that readings for each stage would distort the result: one in sixteen of them is timed
 * by stage, and the others together.
 */
#include "step/mdt_step_i.h"
#include "MeAssert.h"
#include "MeMath.h"
#include "MeProfile.h"
#include <string.h>

enum { SMALL = 16, GROUP = 16 }; /* bodies and constraints of the largest small partition; partitions of a group */

/* ---- on and off ---- */

/* Reserves a report for each partition. */
static MeBool reserveReports(MdtWorldID w, int count, const char *caller) {
    if (count <= w->reportRoom)
        return METRUE;
    if (!MeMemoryGrow(&w->reports, 0, (size_t)count, sizeof *w->reports, caller, "reports of partitions"))
        return MEFALSE;
    w->reportRoom = count;
    return METRUE;
}

void MEAPI MdtWorldEnableReport(const MdtWorldID w) {
    MDT_NEED_WORLD(w, );
    if (w->isReported)
        return;
    if (!reserveReports(w, MeMAX(w->bodyRoom, 1), __func__))
        return;
    w->isReported = METRUE;
    w->numReports = MDT_NO_REPORTS;
}

/* The memory is kept, since a callback may call this in the middle of a step. */
void MEAPI MdtWorldDisableReport(const MdtWorldID w) {
    MDT_NEED_WORLD(w, );
    w->isReported = MEFALSE;
    w->numReports = MDT_NO_REPORTS;
}

MeBool MEAPI MdtWorldReportIsEnabled(const MdtWorldID w) {
    MDT_NEED_WORLD(w, MEFALSE);
    return w->isReported;
}

/* ---- writing during a step ---- */

static MeU64 ticksNow(void) {
    MeProfileTimerResult t;
    MeProfileGetTimerValue(&t);
    return t.ticks;
}

void mdt_reportStep(MdtWorldID w) {
    if (!reserveReports(w, w->bodyRoom, "MdtWorldStep")) {
        w->numReports = MDT_NO_REPORTS;
        return;
    }
    w->numReports = w->numPartitions;
    memset(w->reports, 0, (size_t)w->numReports * sizeof *w->reports);
    w->timing.firstUntimed = 0;
    w->timing.lap = ticksNow();
}

/* s: time since the last lap; begins a new one. */
static double lapTime(MeU64 *clock) {
    const MeU64 start = *clock;
    *clock = ticksNow();
    return (double)(*clock - start) / (double)MeProfileGetClockSpeed();
}

void mdt_reportLap(MdtIsland *p, MdtReportStage stage) {
    if (p->isTimedByStage)
        p->report->time[stage] += (MeReal)lapTime(p->timing ? &p->timing->lap : &p->lap);
}

/* True if a partition is timed by stage, instead of together with others: one in GROUP, those larger than SMALL, and
 * all of them if a partition callback runs in between, whose time must not be distributed. */
static MeBool isTimedByStage(const MdtWorld *w, int partition) {
    const int bodies = w->bodyStart[partition + 1] - w->bodyStart[partition];
    const int constraints = w->actingStart[partition + 1] - w->actingStart[partition];
    return w->partitionCb || partition % GROUP == 0 || bodies + constraints > SMALL ||
           (constraints > 0 && w->timing.stageShare[MdtReportStageSolve] == 0);
}

static double workOf(const MdtReport *r) {
    return r->bodies + r->rows;
}

/* Divides a partition's time among the stages; without rows all of it is integration. */
static void distributeToStages(MdtReport *r, double time, const double share[]) {
    static const double free[MdtReportStages] = {[MdtReportStageIntegrate] = 1};
    for (int i = 0; i < MdtReportStages; i++)
        r->time[i] = (MeReal)(time * (r->rows > 0 ? share[i] : free[i]));
}

/* Distributes the time since the last lap among the preceding partitions that were not timed by stage. */
static void distributeTime(const MdtWorld *w, MdtTiming *t, int end) {
    const double time = lapTime(&t->lap);
    MEASSERT(end >= t->firstUntimed);
    double work = 0;
    for (int i = t->firstUntimed; i < end; i++)
        work += mdt_isInBatch(w, i) ? 0 : workOf(&w->reports[i]);
    for (int i = t->firstUntimed; i < end; i++)
        if (!mdt_isInBatch(w, i))
            distributeToStages(&w->reports[i], time * workOf(&w->reports[i]) / work, t->stageShare);
    t->firstUntimed = end;
}

/* With several workers each partition is timed alone. */
void mdt_reportBegin(MdtIsland *p) {
    const MdtWorld *w = p->world;
    MEASSERT(p->number >= 0 && p->number < w->numPartitions);
    if (!w->isReported || p->number >= w->numReports)
        return;
    p->report = &w->reports[p->number];
    p->isTimedByStage = !p->timing || isTimedByStage(w, p->number);
    if (!p->timing)
        p->lap = ticksNow();
    else if (p->isTimedByStage)
        distributeTime(w, p->timing, p->number);
}

/* Stores each stage's fraction of a small partition's time, for partitions that are not timed by stage. */
static void storeStageShares(MdtTiming *t, const MdtReport *r) {
    double sum = 0;
    for (int i = 0; i < MdtReportStages; i++)
        sum += (double)r->time[i];
    MEASSERT(sum >= 0);
    for (int i = 0; i < MdtReportStages && sum > 0; i++)
        t->stageShare[i] = (double)r->time[i] / sum;
}

void mdt_reportStepEnd(MdtWorldID w) {
    if (w->timing.firstUntimed < w->numReports)
        distributeTime(w, &w->timing, w->numReports);
}

static void raiseMax(MeReal *worst, double x) {
    if ((MeReal)x > *worst)
        *worst = mdt_real(x);
}

void mdt_reportSolve(MdtIsland *p) {
    const MdtKeaSystem *kea = &p->kea;
    MdtReport *r = p->report;
    const int rows = p->numRows;
    if (rows == 0)
        return;
    mdt_reportLap(p, MdtReportStageSolve);
    r->rows = rows > r->rows ? rows : r->rows;
    r->passes += kea->report.passes;
    r->iterations += kea->report.iterations;
    r->factorizations += kea->report.factorizations;
    r->stages += kea->report.stages;
    r->freezes += kea->report.freezes;
    r->why = p->why;
    mdt_reportPath(r, p->isFast                        ? MdtReportWayFast
                      : kea->report.factorizations > 0 ? MdtReportWayExact
                                                       : MdtReportWayKept);
}

static void addSquare(double *sum, double x) {
    *sum += x * x;
}

/* The error of a position row; of a stop, which only pushes, how far it is passed. */
static double violationOf(const MdtKeaRow *row, double error) {
    return row->lower >= 0 ? fmin(error, 0) : row->upper <= 0 ? fmax(error, 0) : error;
}

/* Measures a joint's gap and angle at the end of a part. Its rows are orthogonal to each other, so that their errors
 * add up like components of a vector. The drift of moving attachments is subtracted. */
static void measureJoint(MdtReport *r, const MdtJoint *j, const MdtIsland *p) {
    const MdtKeaSystem *kea = &p->kea;
    const MdtKeaRow *rows = kea->rows + j->firstRow;
    const MdtKeaTransformation *pose[MdtBclMAXSIDES];
    MdtKeaTransformation memory[MdtBclMAXSIDES];
    double errors[MdtBclGETMAXROWS], linearError = 0, angularError = 0;
    mdt_jointPoses(p, j, 1, kea->pose, pose, memory);
    j->type->errors(&j->bcl, pose, errors);
    for (int i = 0; i < j->numRows; i++) {
        const MeBool isLinear =
            keaDot(rows[i].J[0].lin, rows[i].J[0].lin) + keaDot(rows[i].J[1].lin, rows[i].J[1].lin) > 0;
        if (rows[i].position && !rows[i].isTail)
            addSquare(isLinear ? &linearError : &angularError,
                      violationOf(&rows[i], errors[i] - kea->parameters.stepsize * (rows[i].drift + rows[i].carried)));
    }
    raiseMax(&r->jointGap, sqrt(linearError));
    raiseMax(&r->jointTurn, sqrt(angularError));
}

void mdt_reportSubstep(MdtReport *r, const MdtIsland *p, MeBool isFinite) {
    const MdtKeaSystem *kea = &p->kea;
    MEASSERT(kea->report.capped || !kea->report.limited);
    r->parts++;
    r->fallbacks += (kea->report.capped && !kea->report.declined) || !isFinite;
    r->conflicts += kea->report.conflicting;
    r->limited += kea->report.limited;
    if (kea->report.limited)
        mdt_reportPath(r, MdtReportWayLimited);
    raiseMax(&r->residualVelocity, kea->report.residual);
    raiseMax(&r->excess, kea->report.excess);
    raiseMax(&r->residualForce, kea->report.force);
    raiseMax(&r->jointError, kea->report.error);
    r->jointGap = r->jointTurn = 0;
    raiseMax(&r->penetration, mdt_contactsPenetration(p));
    const MdtJoint *j;
    for (int i = 0; (j = mdt_nextJoint(p, &i));)
        if (j->numRows > 0 && j->type->errors)
            measureJoint(r, j, p);
}

/* Uses the public angular velocity: in single precision it has as many digits as the report. */
static double kineticEnergyOf(const MdtBody *b) {
    double w[3];
    mdt_fromReal(w, b->velocity.ang);
    return 0.5 * (b->mass * keaDot(b->kea.velocity, b->kea.velocity) + keaDot(w, b->kea.angularMomentum));
}

static void reportEnergy(MdtReport *r, MdtBodyID const bodies[], int count, const MeReal gravity[]) {
    double kinetic = 0, potential = 0, g[3];
    mdt_fromReal(g, gravity);
    for (int i = 0; i < count; i++) {
        kinetic += kineticEnergyOf(bodies[i]);
        potential -= bodies[i]->gravityFactor * bodies[i]->mass * keaDot(g, bodies[i]->kea.position);
    }
    r->kineticEnergy = mdt_real(kinetic);
    r->potentialEnergy = mdt_real(potential);
}

/* Contacts and their groups both count as constraints. */
static int countConstraints(const MdtWorld *w, int partition) {
    int count = 0;
    for (int i = w->actingStart[partition]; i < w->actingStart[partition + 1]; i++) {
        const MdtConstraintID c = w->actingOf[i];
        count += mdt_isJoint(c) || !(c->record.flags & MDT_LONE);
        count += mdt_isJoint(c) ? 0 : mdt_asManifold(c)->numPoints;
    }
    return count;
}

void mdt_reportEnd(MdtIsland *p) {
    const MdtWorld *w = p->world;
    MdtReport *r = p->report;
    r->bodies = p->numBodies;
    r->constraints = countConstraints(w, p->number);
    reportEnergy(r, p->bodies, r->bodies, w->params.gravity);
    mdt_reportLap(p, MdtReportStageIntegrate);
    if (!p->isTimedByStage || !p->timing)
        return;
    p->timing->firstUntimed = p->number + 1;
    if (r->rows > 0 && r->bodies + r->constraints <= SMALL)
        storeStageShares(p->timing, r);
}

/* ---- batches ---- */

/* Batches are stepped before other partitions, and each has its own clock. */
void mdt_reportBatch(MdtIsland *p, MdtReport *r) {
    if (!p->world->isReported || p->world->numReports != p->world->numPartitions)
        return;
    memset(r, 0, sizeof *r);
    p->report = r;
    p->isTimedByStage = METRUE;
    p->lap = ticksNow();
}

/* Distributes work and time of the batch to a member, as for partitions that are timed together. */
void mdt_reportMember(const MdtIsland *p, const MdtMember *m, int rows, double penetration) {
    MdtReport *r = &p->world->reports[m->partition];
    *r = *p->report;
    r->bodies = m[1].firstBody - m->firstBody;
    r->constraints = countConstraints(p->world, m->partition);
    r->rows = rows;
    r->penetration = (MeReal)penetration;
    const double share = workOf(r) / (p->numBodies + p->numRows);
    MEASSERT(share >= 0 && share <= 1);
    r->work = (MeReal)(share * (double)p->report->work);
    for (int i = 0; i < MdtReportStages; i++)
        r->time[i] = (MeReal)(share * (double)p->report->time[i]);
    reportEnergy(r, p->bodies + (m->firstBody - p->member->firstBody), r->bodies, p->world->params.gravity);
}

void mdt_reportBatchesEnd(MdtWorldID w) {
    if (w->isReported && w->batches.count > 0)
        w->timing.lap = ticksNow();
}

/* ---- reading by programs ---- */

static void addCounts(MdtReport *sum, const MdtReport *r) {
    sum->bodies += r->bodies;
    sum->constraints += r->constraints;
    sum->rows += r->rows;
    sum->parts += r->parts;
    sum->rested += r->rested;
    sum->composed += r->composed;
    sum->events += r->events;
    sum->passes += r->passes;
    sum->iterations += r->iterations;
    sum->factorizations += r->factorizations;
    sum->stages += r->stages;
    sum->freezes += r->freezes;
    sum->fallbacks += r->fallbacks;
    sum->conflicts += r->conflicts;
    sum->limited += r->limited;
    sum->work += r->work;
}

static void raiseErrors(MdtReport *worst, const MdtReport *r) {
    worst->why = r->way > worst->way ? r->why : worst->why;
    mdt_reportPath(worst, r->way);
    raiseMax(&worst->residualVelocity, (double)r->residualVelocity);
    raiseMax(&worst->excess, (double)r->excess);
    raiseMax(&worst->residualForce, (double)r->residualForce);
    raiseMax(&worst->jointError, (double)r->jointError);
    raiseMax(&worst->jointGap, (double)r->jointGap);
    raiseMax(&worst->jointTurn, (double)r->jointTurn);
    raiseMax(&worst->penetration, (double)r->penetration);
}

static void sumReports(MdtReport *sum, const MdtReport reports[], int count) {
    double kinetic = 0, potential = 0, time[MdtReportStages] = {0};
    for (int i = 0; i < count; i++) {
        addCounts(sum, &reports[i]);
        raiseErrors(sum, &reports[i]);
        kinetic += (double)reports[i].kineticEnergy;
        potential += (double)reports[i].potentialEnergy;
        for (int k = 0; k < MdtReportStages; k++)
            time[k] += (double)reports[i].time[k];
    }
    sum->kineticEnergy = mdt_real(kinetic);
    sum->potentialEnergy = mdt_real(potential);
    for (int k = 0; k < MdtReportStages; k++)
        sum->time[k] = (MeReal)time[k];
}

/* True for a valid pointer to a report, which is zeroed as the neutral result. */
static MeBool isReport(const char *caller, MdtReport *r) {
    if (!mdt_isPointer(caller, "the report", r))
        return MEFALSE;
    memset(r, 0, sizeof *r);
    return METRUE;
}

MeBool MEAPI MdtWorldGetReport(const MdtWorldID w, MdtReport *report) {
    if (!isReport(__func__, report) || !mdt_isWorld(w, __func__) || w->numReports == MDT_NO_REPORTS)
        return MEFALSE;
    sumReports(report, w->reports, w->numReports);
    return METRUE;
}

int MEAPI MdtWorldGetReportCount(const MdtWorldID w) {
    MDT_NEED_WORLD(w, 0);
    return w->numReports == MDT_NO_REPORTS ? 0 : w->numReports;
}

MeBool MEAPI MdtWorldGetPartitionReport(const MdtWorldID w, const int partition, MdtReport *report) {
    if (!isReport(__func__, report) || !mdt_isWorld(w, __func__) || w->numReports == MDT_NO_REPORTS)
        return MEFALSE;
    if (partition < 0 || partition >= w->numReports) {
        MeWarning(1, "MdtWorldGetPartitionReport: there is no partition %d, the last step had %d", partition,
                  w->numReports);
        return MEFALSE;
    }
    *report = w->reports[partition];
    return METRUE;
}
