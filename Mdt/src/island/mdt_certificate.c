/* Rest certificate: a partition at rest is not solved again as long as nothing has changed since the last step.
 *
 * A step settles a partition if it was taken whole, if Kea's answer is within its tolerances, and if all bodies are at
 * rest: either their velocities are below Kea's resting speed, or, in large islands (ignoresSway), their forces
 * balance and they are slower than the accuracy. Below the exact solver's resting speed gamma has no position errors
 * left to relax; with the fast solver, bodies have to be calm until gamma has removed the errors (calmStepsToCertify).
 * The bodies then keep their poses bit for bit, so that the same contacts are found again. If the inputs of the next
 * step are the same to the last bit, so are the forces, and the step only has to compare the inputs of each body. The
 * bodies' times go on, so that they fall asleep as usual.
 *
 * Inputs, and how their changes are detected:
 *     of the world           a copy of them (MdtCertificateInputs)
 *     bodies, contacts,      each setter ends the certificates of the bodies concerned (mdt_bodyDisturb); renewing
 *     the graph              a contact with equal values is no change
 *     forces, velocities     compared with those that the last step began with, or has shown
 *     parameters of joints   a 64-bit hash of all of a joint's data in MdtBcl, if an API call has had the joint as
 *                            argument since, or if the program has a pointer to them; different data have the same
 *                            hash with a probability of 2^-64
 */
#include "MeAssert.h"
#include "island/mdt_choice_i.h"
#include <limits.h>
#include <string.h>

/* ---- inputs ---- */

/* Steps in which gamma reduces errors to a thousandth: (1 - γ)^n = 1e-3. */
static double relaxationSteps(const MdtWorld *w) {
    const double gamma = w->gamma;
    MEASSERT(gamma >= 0 && gamma <= 1);
    return gamma > 0 && gamma < 1 ? ceil(log(1e-3) / log1p(-gamma)) : 1;
}

void mdt_certificatesBegin(MdtWorldID w) {
    MdtCertificateInputs now;
    MEASSERT(w->lastStep > 0);
    memset(&now, 0, sizeof now);
    now.h = w->lastStep;
    mdt_fromReal(now.gravity, w->params.gravity);
    now.epsilon = (double)w->epsilon;
    now.gamma = (double)w->gamma;
    now.workBudget = (double)w->workBudget;
    now.accuracy = mdt_worldAccuracy(w, w->lastStep, MEFALSE);
    now.importance = w->importance;
    now.maxLcpIterations = w->maxLcpIterations;
    now.subSteps = w->subSteps;
    now.order = w->order;
    now.timedBodies = w->timedBodies;
    now.maxMatrixSize = w->maxMatrixSize;
    now.solver = (int)w->solver;
    if (memcmp(&now, &w->certificateInputs, sizeof now) != 0)
        w->certificate++;
    w->certificateInputs = now;
    w->calmStepsToCertify = relaxationSteps(w);
}

/* A hash of a record's bytes, word by word: the multiplier is 2^64 over the golden ratio, and the shift mixes high bits
 * into the low ones. */
static MeU64 hashOf(const void *record, size_t size) {
    const char *bytes = record;
    MeU64 hash = 0;
    for (size_t at = 0; at < size; at += sizeof hash) {
        MeU64 word = 0;
        memcpy(&word, bytes + at, size - at < sizeof word ? size - at : sizeof word);
        hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

/* True if the constraint's parameters have the hash of the certified step. */
static MeBool hasCertifiedParameters(MdtConstraintID c) {
    const MdtJoint *j = mdt_asJoint(c);
    if (j)
        return j->certified == hashOf(&j->bcl, sizeof j->bcl);
    for (const MdtManifold *block = mdt_asManifold(c); block; block = block->next)
        for (const MdtExtra *extra = block->extras; extra; extra = extra->next)
            if ((extra->record.flags & MDT_WATCHED) && extra->certified != hashOf(&extra->params, sizeof extra->params))
                return MEFALSE;
    return METRUE;
}

MeBool mdt_jointIsCertified(const MdtJoint *j) {
    return j->certified == hashOf(&j->bcl, sizeof j->bcl);
}

void mdt_jointCertify(MdtJoint *j) {
    j->certified = hashOf(&j->bcl, sizeof j->bcl);
}

static void certifyConstraint(MdtConstraintID c) {
    MdtJoint *j = mdt_asJoint(c);
    if (j)
        mdt_jointCertify(j);
    for (MdtManifold *block = j ? NULL : mdt_asManifold(c); block; block = block->next)
        for (MdtExtra *extra = block->extras; extra; extra = extra->next)
            if (extra->record.flags & MDT_WATCHED)
                extra->certified = hashOf(&extra->params, sizeof extra->params);
}

/* Each constraint is checked by one of its bodies: the first one or, if that is not simulated, the second. */
MeBool mdt_areConstraintsCertified(MdtBodyID b) {
    if (!(b->record.flags & (MDT_WATCHED | MDT_TOUCHED)))
        return METRUE;
    for (const MdtAttachment *at = b->attachments; at; at = at->next) {
        const MdtConstraintID c = mdt_attachmentOwner(at);
        const MdtBody *first = c->side[0].body;
        const MeBool isVisited = mdt_attachmentSide(at) == 0 || !first || first->mover ||
                                 !(first->record.flags & (MDT_ENABLED | MDT_ASLEEP));
        const MeBool mayDiffer = (c->record.flags & MDT_ENABLED) && (c->record.flags & (MDT_WATCHED | MDT_TOUCHED));
        if (!isVisited)
            continue;
        if (mayDiffer && !hasCertifiedParameters(c))
            return MEFALSE;
        c->record.flags &= ~MDT_TOUCHED;
    }
    b->record.flags &= ~MDT_TOUCHED;
    return METRUE;
}

/* Velocities are compared because programs write them through pointers. */
MeBool mdt_certificateIsValid(const MdtIsland *p) {
    for (int i = 0; i < p->numBodies; i++) {
        const MdtBody *b = p->bodies[i];
        if (b->certificate != p->world->certificate)
            return MEFALSE;
        const MdtForces *f = b->forces;
        const MeBool hasSameForces = !f || (memcmp(f->load, f->lastLoad, sizeof f->load) == 0 &&
                                            memcmp(f->impulse, mdt_noForces.impulse, sizeof f->impulse) == 0);
        if (!hasSameForces || memcmp(&b->velocity, &b->shown, sizeof b->velocity) != 0 ||
            !mdt_areConstraintsCertified(p->bodies[i]))
            return MEFALSE;
    }
    return p->h >= p->whole;
}

/* ---- the step of a partition whose certificate holds ---- */

/* Writes the number of rows of the last solve to the size log. */
static void logRows(const MdtIsland *p) {
    int rows = 0;
    for (int i = 0; i < p->numActing; i++)
        rows += MdtConstraintGetRowCount(p->acting[i]);
    p->world->sizeLog[p->number] = rows;
}

void mdt_certificateApply(const MdtIsland *p) {
    for (int i = 0; i < p->numBodies; i++) {
        MdtBodyID b = p->bodies[i];
        MEASSERT(b->lag == 0 && b->lastAdvance == p->h && b->enabledTime > 0);
        if (!(b->record.flags & MDT_FORCED))
            mdt_forceRestart(b);
        MdtBodyResetForces(b);
        mdt_bodyAge(b, p->h);
    }
    if (p->number < p->world->sizeLogLength)
        logRows(p);
    mdt_reportPath(p->report, MdtReportWayRest);
    if (p->report)
        p->report->parts = p->report->rested = 1;
}

/* ---- certifying ---- */

/* m/s: the speed of rest, for mean velocities of a step. Each row's velocity error is within its tolerance; independent
 * errors along a chain of n bodies add up to sqrt(n) times that (3 times in a tower of 20 boxes). */
static double restingSpeed(const MdtIsland *p) {
    if (p->isFast)
        return p->kea.report.resolution;
    for (int i = 0; i < p->kea.numRows; i++)
        if (p->kea.rows[i].spring || p->kea.rows[i].position)
            return 0; /* these approach equilibrium asymptotically: any threshold would stop them too early */
    return sqrt(p->numBodies) * p->kea.report.resolution;
}

/* m/s: the larger of the speed of the centre of mass and that of rotation at the radius of gyration. */
static double bodySpeed(const MdtBody *b, const MdtKeaVelocity *v) {
    return fmax(keaLength(v->lin), keaLength(v->ang) * mdt_bodyRadius(b));
}

/* m/s, rad/s: the displacement of the step over h. It includes position corrections, which velocities do not. */
static MdtKeaVelocity meanVelocity(const MdtIsland *p, int i) {
    MdtKeaVelocity mean;
    double turn[4];
    MEASSERT(p->h > 0);
    mdt_bodyMotionSince(p->bodies[i], &p->bodies[i]->start.pose, mean.lin, turn);
    keaScale(mean.lin, 1 / p->h, mean.lin);
    keaScale(mean.ang, 2 / p->h, turn + 1);
    return mean;
}

/* Ratio of the accuracy to the fast solver's resting speed (kea_restingShare). */
enum { MDT_SWAY = 10 };

/* What an island's contacts allow bodies that are nearly at rest. */
typedef struct AtContacts {
    MeBool ignoresSway; /* bodies may be stopped although they sway: forces balance loads, and speeds are below the
                           accuracy. A heap sways within its resting depths for a long time, and the same forces hold it
                           at rest. Not with joints, whose errors decay more slowly, nor with contacts that roll or have
                           no friction, where slow motion goes on */
    MeBool mayCreep; /* slip or moving surfaces keep bodies moving, perhaps more slowly than the fast solver's resting
                           speed */
} AtContacts;

static AtContacts allowedAtContacts(const MdtIsland *p) {
    AtContacts allowed = {p->isFast && p->numJoints == 0, MEFALSE};
    for (int i = 0; i < p->kea.numManifolds && p->isFast; i++) {
        const MdtKeaManifold *m = &p->kea.manifolds[i];
        const MdtKeaSurface *s = &m->surface;
        const MeBool isRound = m->radius[0] > 0 || m->radius[1] > 0;
        const MeBool hasFriction =
            (s->coefficient[0] > 0 || s->bound[0] > 0) && (s->isCone || s->coefficient[1] > 0 || s->bound[1] > 0);
        allowed.ignoresSway = allowed.ignoresSway && !isRound && hasFriction;
        allowed.mayCreep |= s->slip[0] != 0 || s->slip[1] != 0 || s->slide[0] != 0 || s->slide[1] != 0;
    }
    return allowed;
}

/* Whether some of the island's bodies are at rest in this step. The factor 2: with the midpoint rule an error of the
 * mean velocity is twice as large at either end of the step. */
static MeBool areCalm(const MdtIsland *p, int first, int end) {
    const double speed = restingSpeed(p);
    const MeBool isStanding = allowedAtContacts(p).ignoresSway;
    const double maxAtEnds = (isStanding ? MDT_SWAY : 2) * speed, maxMean = (isStanding ? MDT_SWAY : 1) * speed;
    for (int i = first; i < end; i++) {
        const MdtBody *b = p->bodies[i];
        const MdtKeaVelocity mean = meanVelocity(p, i), *start = &b->start.velocity;
        MdtKeaVelocity last, gain; /* not yet shown */
        keaCopy(last.lin, b->kea.velocity);
        MdtKeaBodyGetAngularVelocity(&b->kea, last.ang);
        keaSubtract(gain.lin, last.lin, start->lin);
        keaSubtract(gain.ang, last.ang, start->ang);
        if (bodySpeed(b, start) > maxAtEnds || bodySpeed(b, &mean) > maxMean)
            return MEFALSE;
        if (isStanding ? bodySpeed(b, &gain) > speed : bodySpeed(b, &last) > maxAtEnds)
            return MEFALSE;
    }
    return METRUE;
}

/* For results independent of threads (rule in MeTeam.h), a range writes to its own bodies only, here and in
 * certifyBodies. */
static void MEAPI clearCalmSteps(void *island, int first, int end, int worker) {
    const MdtIsland *p = island;
    (void)worker;
    for (int i = first; i < end; i++)
        p->bodies[i]->calmSteps = 0;
}

/* Counts this step as calm for some bodies; the count restarts when a body loses its certificate. Returns their
 * smallest count. */
static int countCalmStep(const MdtIsland *p, int first, int end) {
    int fewest = INT_MAX;
    MEASSERT(end > first);
    for (int i = first; i < end; i++) {
        MdtBodyID b = p->bodies[i];
        b->calmSteps = b->certificate ? 0 : b->calmSteps + 1;
        fewest = MeMIN(fewest, b->calmSteps);
    }
    return fewest;
}

/* An island with rows from a callback is never settled, as the callback's next result may differ. Joint errors are
 * checked, too: passes that alternate between joints and contacts reduce them more slowly than the resting speed of the
 * fast solver shows. */
MeBool mdt_islandIsSettled(MdtIsland *p) {
    const MdtKeaReport *r = &p->kea.report;
    if (!areCalm(p, 0, p->numBodies)) {
        MeTeamRunRanges(p->team, p->numBodies, MDT_RANGE, clearCalmSteps, p);
        return MEFALSE;
    }
    MEASSERT(p->world->calmStepsToCertify >= 1);
    const MeBool isCalmLongEnough = countCalmStep(p, 0, p->numBodies) >= (p->isFast ? p->world->calmStepsToCertify : 1);
    const MeBool isWhole = p->h >= p->whole && p->parameters.stepsize >= p->h && !p->hadImpact;
    const MeBool isExact = !r->capped && !r->limited && !r->violent && !r->conflicting && !p->isDegenerate;
    const MeBool areJointsClosed = !p->isFast || r->opening <= MDT_MAX_JOINT_ERROR;
    const MeBool dependsOnCallback = p->hasUserRows || (p->world->importance && p->isCapped);
    return isCalmLongEnough && isWhole && isExact && areJointsClosed && !dependsOnCallback && p->numRows > 0 &&
           r->residual <= r->resolution && !allowedAtContacts(p).mayCreep;
}

void mdt_islandResetPoses(const MdtIsland *p) {
    static const double none[3] = {0, 0, 0};
    const MeBool isStanding = allowedAtContacts(p).ignoresSway;
    for (int i = 0; i < p->numBodies; i++) {
        MdtKeaBody *b = &p->bodies[i]->kea;
        keaCopy(b->position, p->bodies[i]->start.pose.position);
        memcpy(b->quaternion, p->bodies[i]->start.pose.quaternion, sizeof b->quaternion);
        if (isStanding) {
            keaZero(b->velocity);
            MdtKeaBodySetAngularVelocity(b, none);
        }
    }
}

typedef struct Certifying {
    const MdtIsland *p;
    MeBool isSettled;
} Certifying;

static void MEAPI certifyBodies(void *context, int first, int end, int worker) {
    const Certifying *c = context;
    (void)worker;
    for (int i = first; i < end; i++) {
        MdtBodyID b = c->p->bodies[i];
        b->certificate = c->isSettled ? c->p->world->certificate : 0;
    }
}

void mdt_constraintsCertify(const MdtIsland *p) {
    for (int i = 0; i < p->numActing; i++)
        if (mdt_isJoint(p->acting[i]) || (p->acting[i]->record.flags & MDT_WATCHED))
            certifyConstraint(p->acting[i]);
}

void mdt_islandCertify(const MdtIsland *p, MeBool isSettled) {
    Certifying certifying = {p, isSettled};
    MEASSERT(p->world->certificate != 0 && p->elapsed > 0);
    MeTeamRunRanges(p->team, p->numBodies, MDT_RANGE, certifyBodies, &certifying);
    if (isSettled)
        mdt_constraintsCertify(p);
}

/* ---- batches ---- */

MeBool mdt_certificateIsNear(const MdtWorld *w, int partition) {
    MEASSERT(partition >= 0 && partition < w->numPartitions);
    const double enough = w->calmStepsToCertify - 1;
    for (int i = w->bodyStart[partition]; i < w->bodyStart[partition + 1]; i++)
        if (w->bodyOf[i]->certificate == 0 && w->bodyOf[i]->calmSteps < enough)
            return MEFALSE;
    return METRUE;
}

void mdt_membersCountCalm(MdtIsland *p) {
    for (const MdtMember *m = p->member; m < p->member + p->numMembers; m++) {
        const int first = m->firstBody - p->member->firstBody, end = m[1].firstBody - p->member->firstBody;
        MEASSERT(first >= 0 && first < end && end <= p->numBodies);
        if (areCalm(p, first, end))
            countCalmStep(p, first, end);
        else
            clearCalmSteps(p, first, end, 0);
    }
    mdt_islandCertify(p, MEFALSE);
}
