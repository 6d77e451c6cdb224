/* Rest certificate: a partition at rest, in which nothing has changed since the last step, is not solved again.
 *
 * A step settles a partition if it was taken whole, if Kea's answer is within its tolerances, and if all bodies are at
 * rest: their velocities below Kea's threshold of rest, or, in large islands (mayStand), in balance and slower than the
 * accuracy. Below the exact solver's threshold gamma has no position errors left to relax; by the fast one bodies have
 * to be calm until gamma has removed them (calmStepsToCertify). The bodies then stay where they are, bit for bit,
 * so that contacts are found again as they were. In the next step the inputs may be the same to the last bit: then so
 * are the forces, and the step costs a look at each body. Bodies age meanwhile, so that they are put to sleep as ever.
 *
 * Inputs, and how a change of them is noticed:
 *     of the world           a copy of them (MdtCertificateInputs)
 *     bodies, contacts,      whatever changes one takes the certificate from the bodies concerned (mdt_bodyDisturb); a
 *     the graph              contact that is renewed as it was is no change
 *     forces, velocities     compared with those that the last step began with, or has shown
 *     parameters of joints   a 64-bit hash of all that MdtBcl keeps of a joint, if a call has had to do with it since,
 *                            or programs have a pointer to them; two that differ are equal by a chance of 2^-64
 */
#include "MeAssert.h"
#include "island/mdt_choice_i.h"
#include <limits.h>
#include <string.h>

/* ---- inputs ---- */

/* Steps until the errors that gamma takes away are a thousandth: (1 - γ)^n = 1e-3. */
static double relaxationSteps(const MdtWorld *w) {
    const double gamma = w->gamma;
    return gamma > 0 && gamma < 1 ? ceil(log(1e-3) / log1p(-gamma)) : 1;
}

void mdt_certificatesBegin(MdtWorldID w) {
    MdtCertificateInputs now;
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

/* Word by word; the multiplier is 2^64 over the golden ratio, and the shift brings high bits down again. */
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

/* Whether the constraint's parameters are those that were certified. */
static MeBool isAsCertified(MdtConstraintID c) {
    const MdtJoint *j = mdt_asJoint(c);
    if (j)
        return j->certified == hashOf(&j->bcl, sizeof j->bcl);
    for (const MdtManifold *block = mdt_asManifold(c); block; block = block->next)
        for (const MdtExtra *extra = block->extras; extra; extra = extra->next)
            if ((extra->record.flags & MDT_WATCHED) && extra->certified != hashOf(&extra->params, sizeof extra->params))
                return MEFALSE;
    return METRUE;
}

static void certifyConstraint(MdtConstraintID c) {
    MdtJoint *j = mdt_asJoint(c);
    if (j)
        j->certified = hashOf(&j->bcl, sizeof j->bcl);
    for (MdtManifold *block = j ? NULL : mdt_asManifold(c); block; block = block->next)
        for (MdtExtra *extra = block->extras; extra; extra = extra->next)
            if (extra->record.flags & MDT_WATCHED)
                extra->certified = hashOf(&extra->params, sizeof extra->params);
}

/* Each constraint is visited from one of its bodies: the first, unless that is not simulated. */
MeBool mdt_areConstraintsCertified(MdtBodyID b) {
    if (!(b->record.flags & (MDT_WATCHED | MDT_TOUCHED)))
        return METRUE;
    for (const MdtAttachment *at = b->attachments; at; at = at->next) {
        const MdtConstraintID c = mdt_attachmentOwner(at);
        const MdtBody *first = c->side[0].body;
        const MeBool isVisited =
            mdt_attachmentSide(at) == 0 || !first || !(first->record.flags & (MDT_ENABLED | MDT_ASLEEP));
        const MeBool mayDiffer = (c->record.flags & MDT_ENABLED) && (c->record.flags & (MDT_WATCHED | MDT_TOUCHED));
        if (!isVisited)
            continue;
        if (mayDiffer && !isAsCertified(c))
            return MEFALSE;
        c->record.flags &= ~MDT_TOUCHED;
    }
    b->record.flags &= ~MDT_TOUCHED;
    return METRUE;
}

/* Programs write velocities through pointers, too. */
MeBool mdt_certificateIsValid(const MdtIsland *p) {
    for (int i = 0; i < p->numBodies; i++) {
        const MdtBody *b = p->bodies[i];
        if (b->certificate != p->world->certificate)
            return MEFALSE;
        const MeBool hasForces = memcmp(b->force, b->applied.force, sizeof b->force) == 0 &&
                                 memcmp(b->torque, b->applied.torque, sizeof b->torque) == 0;
        MeBool hasImpulse = MEFALSE;
        for (int k = 0; k < 3; k++)
            hasImpulse = hasImpulse || b->impulse[k] != 0 || b->angularImpulse[k] != 0;
        const MeBool hasVelocities =
            memcmp(b->velocity, b->shownVelocity, sizeof b->velocity) == 0 &&
            memcmp(b->angularVelocity, b->shownAngularVelocity, sizeof b->angularVelocity) == 0;
        if (!hasForces || hasImpulse || !hasVelocities || !mdt_areConstraintsCertified(p->bodies[i]))
            return MEFALSE;
    }
    return p->h >= p->whole;
}

/* ---- the step of a partition whose certificate holds ---- */

/* The size log gets as many rows as the last solve had. */
static void logRows(const MdtIsland *p) {
    int rows = 0;
    for (int i = 0; i < p->numActing; i++)
        rows += MdtConstraintGetRowCount(p->acting[i]);
    p->world->sizeLog[p->number] = rows;
}

void mdt_certificateApply(MdtIsland *p) {
    for (int i = 0; i < p->numBodies; i++) {
        MdtBodyID b = p->bodies[i];
        MEASSERT(b->lag == 0 && b->lastAdvance == p->h && b->enabledSteps > 0);
        if (!(b->record.flags & MDT_FORCED))
            mdt_forceForget(b);
        MdtBodyResetForces(b);
        mdt_bodyAge(b, p->h);
    }
    if (p->number < p->world->sizeLogLength)
        logRows(p);
    if (p->report)
        mdt_reportCertified(p->report);
}

/* ---- giving it ---- */

/* m/s: the threshold of rest, for mean velocities of a step. Each row's velocity error is within its tolerance;
 * independent errors along a chain of n bodies add up to sqrt(n) times that (3 times in a tower of 20 boxes). */
static double resolvedSpeed(const MdtIsland *p) {
    if (p->isFast)
        return p->kea.report.resolution;
    for (int i = 0; i < p->kea.numRows; i++)
        if (p->kea.rows[i].spring || p->kea.rows[i].position)
            return 0; /* they approach equilibrium asymptotically, at any speed: it would stop them too early */
    return sqrt(p->numBodies) * p->kea.report.resolution;
}

/* m/s: of the centre of mass, or of what turns about it at the radius of gyration. */
static double speedOf(const MdtBody *b, const MdtKeaVelocity *v) {
    const double *I = b->kea.moments;
    return fmax(keaLength(v->lin), keaLength(v->ang) * sqrt(fmax(I[0], fmax(I[1], I[2])) * b->kea.invMass));
}

/* m/s, rad/s: displacement of the step over h; it includes position corrections, which velocities do not. */
static MdtKeaVelocity meanVelocity(const MdtIsland *p, int i) {
    const MdtKeaBody *b = &p->bodies[i]->kea;
    MdtKeaVelocity mean;
    double back[4], turn[4];
    keaSubtract(mean.lin, b->position, p->bodies[i]->start.position);
    keaScale(mean.lin, 1 / p->h, mean.lin);
    keaQuaternionConjugate(back, p->bodies[i]->start.quaternion);
    keaQuaternionProduct(turn, b->quaternion, back);
    keaScale(mean.ang, 2 / p->h, turn + 1);
    return mean;
}

/* m/s: of the fast solver, ten times its threshold of rest is the accuracy (kea_restingShare). */
enum { MDT_SWAY = 10 };

/* Whether bodies stand where their forces balance their loads and they are slower than the accuracy: a heap sways
 * within its resting depths for long after. The same forces hold it standing. Joints close for longer; what rolls goes
 * on at any speed, and so does what slides without friction. */
static MeBool mayStand(const MdtIsland *p) {
    if (!p->isFast || p->numJoints > 0)
        return MEFALSE;
    for (int i = 0; i < p->kea.numManifolds; i++) {
        const MdtKeaManifold *m = &p->kea.manifolds[i];
        const MdtKeaSurface *s = &m->surface;
        const MeBool isRound = m->radius[0] > 0 || m->radius[1] > 0;
        const MeBool hasFriction =
            (s->coefficient[0] > 0 || s->bound[0] > 0) && (s->isCone || s->coefficient[1] > 0 || s->bound[1] > 0);
        if (isRound || !hasFriction)
            return MEFALSE;
    }
    return METRUE;
}

/* The factor 2: with the midpoint rule an error of the mean velocity is twice as large at either end of the step. */
static MeBool areCalm(const MdtIsland *p, int first, int end) {
    const double speed = resolvedSpeed(p);
    const MeBool isStanding = mayStand(p);
    const double maxAtEnds = (isStanding ? MDT_SWAY : 2) * speed, maxMean = (isStanding ? MDT_SWAY : 1) * speed;
    for (int i = first; i < end; i++) {
        const MdtBody *b = p->bodies[i];
        const MdtKeaVelocity mean = meanVelocity(p, i), *start = &b->start.velocity;
        MdtKeaVelocity last, gain; /* not yet shown */
        keaCopy(last.lin, b->kea.velocity);
        MdtKeaBodyGetAngularVelocity(&b->kea, last.ang);
        keaSubtract(gain.lin, last.lin, start->lin);
        keaSubtract(gain.ang, last.ang, start->ang);
        if (speedOf(b, start) > maxAtEnds || speedOf(b, &mean) > maxMean)
            return MEFALSE;
        if (isStanding ? speedOf(b, &gain) > speed : speedOf(b, &last) > maxAtEnds)
            return MEFALSE;
    }
    return METRUE;
}

/* The rule for order (MeTeam.h), here and as bodies are certified: a range writes to its own bodies alone. */
static void MEAPI forgetCalmSteps(void *island, int first, int end, int worker) {
    const MdtIsland *p = island;
    (void)worker;
    for (int i = first; i < end; i++)
        p->bodies[i]->calmSteps = 0;
}

/* Returns how many they have, the fewest. The count begins anew when a body loses its certificate. */
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

/* Contacts with slip or moving surfaces keep bodies in motion, be it below the fast solver's threshold of rest. */
static MeBool mayCreep(const MdtIsland *p) {
    for (int i = 0; i < p->kea.numManifolds && p->isFast; i++) {
        const MdtKeaSurface *s = &p->kea.manifolds[i].surface;
        if (s->slip[0] != 0 || s->slip[1] != 0 || s->slide[0] != 0 || s->slide[1] != 0)
            return METRUE;
    }
    return MEFALSE;
}

/* Not where rows depend on a function of the program, which may give another result in the next step. Where passes
 * alternate between joints and contacts, the joints' error decays more slowly than the fast solver's threshold of
 * rest. */
MeBool mdt_islandIsSettled(MdtIsland *p) {
    const MdtKeaReport *r = &p->kea.report;
    if (!areCalm(p, 0, p->numBodies)) {
        MeTeamRunRanges(p->team, p->numBodies, MDT_RANGE, forgetCalmSteps, p);
        return MEFALSE;
    }
    MEASSERT(p->world->calmStepsToCertify >= 1);
    const MeBool isForLong = countCalmStep(p, 0, p->numBodies) >= (p->isFast ? p->world->calmStepsToCertify : 1);
    const MeBool isWhole = p->h >= p->whole && p->parameters.stepsize >= p->h && !p->hadImpact;
    const MeBool isExact = !r->capped && !r->limited && !r->violent && !r->conflicting && !p->isDegenerate;
    const MeBool areClosed = !p->isFast || r->opening <= MDT_MAX_JOINT_ERROR;
    const MeBool isProgrammed = p->hasUserRows || (p->world->importance && p->isCapped);
    return isForLong && isWhole && isExact && areClosed && !isProgrammed && p->numRows > 0 &&
           r->residual <= r->resolution && !mayCreep(p);
}

void mdt_islandResetPoses(MdtIsland *p) {
    static const double none[3] = {0, 0, 0};
    const MeBool isStanding = mayStand(p);
    for (int i = 0; i < p->numBodies; i++) {
        MdtKeaBody *b = &p->bodies[i]->kea;
        keaCopy(b->position, p->bodies[i]->start.position);
        memcpy(b->quaternion, p->bodies[i]->start.quaternion, sizeof b->quaternion);
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

void mdt_islandCertify(MdtIsland *p, MeBool isSettled) {
    Certifying certifying = {p, isSettled};
    MEASSERT(p->world->certificate != 0 && p->elapsed > 0);
    MeTeamRunRanges(p->team, p->numBodies, MDT_RANGE, certifyBodies, &certifying);
    if (isSettled)
        mdt_constraintsCertify(p);
}

/* ---- of batches ---- */

MeBool mdt_certificateIsNear(const MdtWorld *w, int partition) {
    const double enough = w->calmStepsToCertify - 1;
    for (int i = w->bodyStart[partition]; i < w->bodyStart[partition + 1]; i++)
        if (w->bodyOf[i]->certificate == 0 && w->bodyOf[i]->calmSteps < enough)
            return MEFALSE;
    return METRUE;
}

void mdt_membersCountCalm(MdtIsland *p) {
    for (const MdtMember *m = p->member; m < p->member + p->numMembers; m++) {
        const int first = m->firstBody - p->member->firstBody, end = m[1].firstBody - p->member->firstBody;
        if (areCalm(p, first, end))
            countCalmStep(p, first, end);
        else
            forgetCalmSteps(p, first, end, 0);
    }
    mdt_islandCertify(p, MEFALSE);
}
