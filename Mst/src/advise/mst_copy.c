/* Runs a setting in a copy of the process (MstAdvise.h): fork, with a record in shared memory.
 *
 * The record's layout is fixed beforehand, for a number of samples of a number of bodies. The copy writes it step by
 * step, so that the results of a copy that crashes or is ended are available up to then. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS, fork */
#include "MdtBody.h"
#include "MdtConstraint.h"
#include "MdtContactGroup.h"
#include "MdtWorld.h"
#include "MeAssert.h"
#include "MeMath.h"
#include "advise/mst_advise_i.h"
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* ---- the record -------------------------------------------------------------------------------------------------- */

static size_t sampleBytes(const MstRecordSize *size) {
    return sizeof(MstMoment) + (size_t)size->bodies * sizeof(MstSample);
}

size_t mst_recordBytes(const MstRecordSize *size) {
    return sizeof(MstRecord) + (size_t)size->samples * sampleBytes(size);
}

MstMoment *mst_recordMoment(const MstRecord *r, int sample) {
    return (MstMoment *)(r + 1) + sample;
}

MstSample *mst_recordSamples(const MstRecord *r, const MstRecordSize *size, int sample) {
    MstSample *first = (MstSample *)(mst_recordMoment(r, size->samples));
    return first + (size_t)sample * (size_t)size->bodies;
}

MstRecord *mst_recordCreate(const MstRecordSize *size) {
    void *memory = mmap(NULL, mst_recordBytes(size), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return memory == MAP_FAILED ? NULL : memory;
}

void mst_recordDestroy(MstRecord *r, const MstRecordSize *size) {
    if (r)
        munmap(r, mst_recordBytes(size));
}

/* ---- clocks ------------------------------------------------------------------------------------------------------ */

static double secondsOf(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double mst_clock(void) {
    return secondsOf(CLOCK_MONOTONIC);
}

/* ---- in the copy ------------------------------------------------------------------------------------------------- */

/* Discards the copy's texts: the original process prints the same ones. */
static void discardOutput(void) {
    const int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere < 0)
        return;
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
}

/* Limits the CPU time, s, so that a copy that hangs ends even if the original process has ended. */
static void limitCpuTime(double seconds) {
    const struct rlimit limit = {(rlim_t)ceil(seconds) + 1, (rlim_t)ceil(seconds) + 2};
    setrlimit(RLIMIT_CPU, &limit);
}

static void becomeCopy(MstUniverseID u, const MstSetting *const setting[], int count, double limit) {
    discardOutput();
    limitCpuTime(limit);
    MdtWorldSetTaskPool(u->world, 0); /* threads do not survive fork */
    MdtWorldEnableReport(u->world);
    for (int i = 0; i < count; i++)
        mst_settingApply(u, setting[i]);
}

void mst_copyStepBegins(MstCopy *c) {
    c->stepBegin = secondsOf(CLOCK_THREAD_CPUTIME_ID);
}

static double radiusOfGyration(MdtBodyID b) {
    MeMatrix3 inertia;
    MdtBodyGetInertiaTensor(b, inertia);
    return sqrt((double)(inertia[0][0] + inertia[1][1] + inertia[2][2]) / (2 * (double)MdtBodyGetMass(b)));
}

static void sampleBody(MdtBodyID b, MstSample *s) {
    MeVector3 p, v, w;
    MeVector4 q;
    MdtBodyGetPosition(b, p);
    MdtBodyGetQuaternion(b, q);
    MdtBodyGetLinearVelocity(b, v);
    MdtBodyGetAngularVelocity(b, w);
    for (int i = 0; i < 3; i++)
        s->position[i] = (double)p[i], s->velocity[i] = (double)v[i], s->angularVelocity[i] = (double)w[i];
    for (int i = 0; i < 4; i++)
        s->quaternion[i] = (double)q[i];
    s->radius = radiusOfGyration(b);
}

static void sampleBodies(const MstCopy *c, MdtWorldID w) {
    MstRecord *r = c->record;
    MstMoment *moment = mst_recordMoment(r, r->sampleCount);
    MstSample *s = mst_recordSamples(r, &c->size, r->sampleCount);
    MeVector3 g, p;
    *moment = (MstMoment){0, 0, 0};
    MdtWorldGetGravity(w, g);
    for (MdtBodyID b = MdtBodyGetFirst(w); b; b = MdtBodyGetNext(b)) {
        MdtBodyGetPosition(b, p);
        const double kinetic = (double)MdtBodyGetKineticEnergy(b);
        moment->kinetic += kinetic;
        moment->energy += kinetic - (double)MdtBodyGetMass(b) * (double)MeVector3Dot(g, p);
        if (moment->bodies < c->size.bodies)
            sampleBody(b, &s[moment->bodies]);
        moment->bodies++;
    }
    r->sampleCount++;
}

/* Whether a body moves in a step by more than its radius of gyration, and so may pass another one. A guess, as bodies
 * have no shapes. */
static MeBool hasFastBody(MdtWorldID w, double step) {
    MeVector3 v;
    for (MdtBodyID b = MdtBodyGetFirst(w); b; b = MdtBodyGetNext(b)) {
        MdtBodyGetLinearVelocity(b, v);
        if ((double)MeVector3Magnitude(v) * step > radiusOfGyration(b))
            return METRUE;
    }
    return MEFALSE;
}

static void MEAPI recordConstraint(MdtConstraintID c, void *traits) {
    MstSceneTraits *t = traits;
    if (MdtConstraintDCastContactGroup(c) || MdtConstraintDCastContact(c))
        t->hasContacts = METRUE;
    else
        t->hasJoints = METRUE;
}

static void recordTraits(MstRecord *r, MdtWorldID w, double step) {
    MstSceneTraits *t = &r->traits;
    MdtReport report;
    if (!t->hasContacts || !t->hasJoints)
        MdtWorldForAllConstraints(w, recordConstraint, t);
    if (!t->hasFastBodies)
        t->hasFastBodies = hasFastBody(w, step);
    for (int i = 0; i < MdtWorldGetReportCount(w); i++) {
        MdtWorldGetPartitionReport(w, i, &report);
        t->usesFastSolver |= report.way == MdtReportWayFast;
        t->usesExactSolver |= t->hasContacts && report.way >= MdtReportWayExact;
        t->exceedsBudget |= report.limited > 0;
        t->hasLargeIsland |= report.bodies > 32; /* see MstBridgeSetContactReuse */
    }
}

static void recordReport(MstRecord *r, MdtWorldID w) {
    MdtReport report;
    if (!MdtWorldGetReport(w, &report)) {
        r->isReporting = 0;
        return;
    }
    r->work += (double)report.work;
    r->penetration = fmax(r->penetration, (double)report.penetration);
    r->jointGap = fmax(r->jointGap, (double)report.jointGap);
    r->residualVelocity = fmax(r->residualVelocity, (double)report.residualVelocity);
}

void mst_copyStepEnds(MstCopy *c, MstUniverseID u, double step) {
    const double elapsed = secondsOf(CLOCK_THREAD_CPUTIME_ID) - c->stepBegin;
    MstRecord *r = c->record;
    if (r->steps >= c->size.warmUp)
        r->time += elapsed;
    recordReport(r, u->world);
    recordTraits(r, u->world, step);
    if ((r->steps + 1) % c->size.stride == 0 && r->sampleCount < c->size.samples)
        sampleBodies(c, u->world);
    if (++r->steps >= c->size.steps)
        _exit(0);
}

/* ---- in the original process ------------------------------------------------------------------------------------- */

/* Waits until the copy has ended, and kills it after `limit` s. */
static void awaitCopy(pid_t copy, double limit) {
    const double end = mst_clock() + limit;
    const struct timespec pause = {0, 1000000};
    for (;;) {
        const pid_t gone = waitpid(copy, NULL, WNOHANG);
        if (gone == copy || (gone < 0 && errno != EINTR))
            return;
        if (mst_clock() > end) {
            kill(copy, SIGKILL);
            waitpid(copy, NULL, 0);
            return;
        }
        nanosleep(&pause, NULL);
    }
}

MeBool mst_copyRun(MstCopy *c, MstUniverseID u, const MstSetting *const setting[], int count, double limit) {
    memset(c->record, 0, sizeof *c->record);
    c->record->isReporting = 1;
    fflush(NULL); /* otherwise the copy would print buffered output again */
    const pid_t copy = fork();
    if (copy == 0) {
        becomeCopy(u, setting, count, limit);
        return METRUE;
    }
    if (copy > 0)
        awaitCopy(copy, limit);
    return MEFALSE;
}
