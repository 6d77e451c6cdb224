/* Steps by safe time: a partition advances by the shortest safe time of its bodies; the rest of the step, its lag,
 * follows in parts (MdtWorldStepRest). */
#include "MeAssert.h"
#include "step/mdt_step_i.h"
#include <math.h>

double mdt_minSafeTime(MdtBodyID const bodies[], int count, double max) {
    double safe = max;
    for (int i = 0; i < count; i++)
        safe = fmin(safe, (double)bodies[i]->safeTime);
    return safe;
}

double mdt_lagSafeStep(const MdtIsland *p) {
    MEASSERT(p->h > 0);
    const double safe = mdt_minSafeTime(p->bodies, p->numBodies, p->h);
    return fmin(p->h, fmax(safe, (double)p->world->minSafeTime));
}

typedef struct Lagging {
    const MdtIsland *p;
    double remainingTime;
} Lagging;

/* For results independent of threads (rule in MeTeam.h), a range writes to its own bodies only. */
static void MEAPI setLags(void *context, int first, int end, int worker) {
    const Lagging *l = context;
    (void)worker;
    for (int i = first; i < end; i++) {
        l->p->bodies[i]->lag = l->remainingTime - l->p->h;
        l->p->bodies[i]->lastAdvance = l->p->h;
    }
}

void mdt_lagSet(const MdtIsland *p, double remainingTime) {
    Lagging lagging = {p, remainingTime};
    MEASSERT(remainingTime >= p->h);
    MeTeamRunRanges(p->team, p->numBodies, MDT_RANGE, setLags, &lagging);
}

/* s: the common lag of the partition's bodies, except those that have just been woken; 0 if one of them has no lag. */
static double commonLag(const MdtIsland *p) {
    double min = INFINITY;
    for (int i = 0; i < p->numBodies; i++)
        if (p->bodies[i]->enabledTime > 0)
            min = fmin(min, p->bodies[i]->lag);
    return min < INFINITY ? min : 0;
}

/* True if the part is too short to be integrated. A velocity that is computed from positions has their rounding error
 * over the part: 2^-53 of 1 km in 2^-14 of 1/60 s is 1e-7 m/s. A body that moves by its own size in a hundredth of the
 * step moves by less than 1 % of it in such a part. */
static MeBool isTooShort(const MdtIsland *p) {
    enum { MAX_SUBSTEPS = 1 << 14 };
    return !(p->h * MAX_SUBSTEPS > p->whole);
}

static MeBool advanceLag(MdtWorldID w, int number, MeBool isPushed) {
    MdtIsland p = mdt_islandOf(w, number, 0);
    const double lag = commonLag(&p);
    p.late = p.whole - lag;
    p.h = mdt_minSafeTime(p.bodies, p.numBodies, lag);
    p.isPushed = isPushed;
    if (isTooShort(&p))
        return MEFALSE;
    for (int i = 0; i < p.numBodies; i++)
        mdt_forceContinue(p.bodies[i]);
    mdt_islandStep(&p);
    if (!isPushed)
        mdt_lagSet(&p, lag);
    return METRUE;
}

/* Advances all partitions that lag; returns how many have moved. */
static int advanceLags(MdtWorldID w, MeBool isPushed) {
    int moved = 0;
    MeStageBegin(&w->stage, MDT_GUARD_WORLD);
    mdt_islandsBegin(w);
    mdt_choicesBegin(w, MEFALSE);
    MeStageBegin(&w->stage, MDT_GUARD_STATES);
    for (int i = 0; i < w->numPartitions; i++)
        moved += advanceLag(w, i, isPushed);
    mdt_choicesEnd(w);
    MeStageEnd(&w->stage, MDT_GUARD_STATES);
    mdt_islandsEnd(w);
    mdt_breakEnd(w);
    MeStageEnd(&w->stage, MDT_GUARD_WORLD);
    return moved;
}

int MEAPI MdtWorldAdvanceLag(const MdtWorldID w) {
    return advanceLags(w, MEFALSE);
}

void MEAPI MdtWorldPushLagging(const MdtWorldID w) {
    advanceLags(w, METRUE);
}

int MEAPI MdtWorldStepRest(const MdtWorldID w) {
    MDT_NEED_WORLD(w, 0);
    return MeStageIsFree(&w->stage, __func__) ? MdtWorldAdvanceLag(w) : 0;
}

int MEAPI MdtWorldGetLaggingBodies(const MdtWorldID w) {
    MDT_NEED_WORLD(w, 0);
    int count = 0;
    for (MdtLink *link = w->bodies.first; link; link = link->next)
        count += ((MdtBodyID)mdt_linkOwner(link))->lag > 0;
    return count;
}

MdtBodyID MEAPI MdtWorldNextLagging(const MdtWorldID w, const MdtBodyID b) {
    MdtLink *link = b ? b->link.next : w->bodies.first;
    while (link && !(((MdtBodyID)mdt_linkOwner(link))->lag > 0))
        link = link->next;
    return link ? (MdtBodyID)mdt_linkOwner(link) : NULL;
}

/* ---- bodies that lag after the last part ---- */

MeBool MEAPI MdtBodyHasJoints(const MdtBodyID b) {
    for (MdtAttachment *at = b->attachments; at; at = at->next)
        if (mdt_asJoint(mdt_attachmentOwner(at)))
            return METRUE;
    return MEFALSE;
}

static void setVelocities(MdtBodyID b, const double linear[3], const double angular[3]) {
    double v[3], w[3];
    keaCopy(v, linear);
    keaCopy(w, angular);
    keaDropAxes(b->kea.locked, v);
    keaDropAxes(b->kea.locked >> 3, w);
    keaCopy(b->kea.velocity, v);
    MdtKeaBodySetAngularVelocity(&b->kea, w);
    mdt_bodyShow(b);
}

void MEAPI MdtBodyPause(const MdtBodyID b, const MeBool translates, double velocity[2][3]) {
    static const double none[3];
    mdt_bodyAcceptVelocities(b);
    keaCopy(velocity[0], b->kea.velocity);
    keaCopy(velocity[1], b->spin);
    if (translates)
        mdt_bodyLockRotations(b);
    else
        setVelocities(b, none, none);
}

void MEAPI MdtBodyResume(const MdtBodyID b, const MeBool translates, const double velocity[2][3]) {
    mdt_bodyAcceptVelocities(b);
    mdt_bodyApplyLocks(b);
    setVelocities(b, translates ? b->kea.velocity : velocity[0], velocity[1]);
}
