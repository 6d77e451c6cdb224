/* Movers: bodies whose motion the program gives (kinematic bodies).
 *
 * Nothing acts on a mover, and it acts on all that touches it or is tied to it, in any partition: for constraints it is
 * a world that moves. Its motion during a step is known before: the centre of mass moves with constant velocity, and
 * the body turns with constant angular velocity. These are the body's velocities or, with a target, those that reach it
 * at the end of the step. After a step to a target the body stands still until there is a new one, or new velocities.
 */
#include "MdtInternal.h"
#include "MeAssert.h"
#include "record/mdt_record_i.h"
#include <string.h>

/* ---- the beginning and the end of a mover's life ---- */

/* Removes the contacts that collision detection has found: they are ordered by which of the bodies is a mover. */
static void removeFoundContacts(MdtBodyID b) {
    for (MdtAttachment *at = b->attachments, *next; at; at = next) {
        const MdtConstraintID c = mdt_attachmentOwner(at);
        next = at->next;
        if (!(c->record.flags & MDT_BRIDGED))
            continue;
        mdt_constraintDeactivate(c);
        mdt_constraintRemove(c);
    }
}

/* Ends what joints remember of the last step. */
static void clearConstraints(MdtBodyID b) {
    removeFoundContacts(b);
    for (MdtAttachment *at = b->attachments; at; at = at->next) {
        mdt_constraintClearWarmStart(mdt_attachmentOwner(at));
        mdt_constraintDisturb(mdt_attachmentOwner(at));
    }
}

static MeBool isOf(const MdtJoint *j, const MdtBody *b) {
    return j && (j->base.side[0].body == b || j->base.side[1].body == b);
}

/* Attaches the mimics of the body's joints anew: to bodies that the program does not move. */
static void attachMimics(MdtBodyID b) {
    for (MdtLink *link = b->world->mimics > 0 ? b->world->constraints.first : NULL; link; link = link->next) {
        MdtJoint *mimic = mdt_asJoint(mdt_linkOwner(link));
        MdtBodyID bodies[2];
        if (!mimic || mimic->bcl.type != MdtBclMIMIC)
            continue;
        MdtJoint *const source[2] = {mimic->bcl.of.coupling.joint[0], mimic->bcl.of.coupling.joint[1]};
        if (!source[0] || !source[1] || !(isOf(source[0], b) || isOf(source[1], b)))
            continue;
        mdt_mimicFindBodies(source, bodies);
        if (bodies[0])
            mdt_constraintAttach(&mimic->base, bodies[0], bodies[1]);
    }
}

static void setKinematic(MdtBodyID b, MeBool isKinematic, const char *caller) {
    if (isKinematic == (b->mover != NULL))
        return;
    MeStageBegin(&b->world->stage, MDT_GUARD_GRAPH); /* defers calls of the program's handlers */
    if (b->record.flags & MDT_ASLEEP)
        mdt_bodyEnable(b);
    if (!isKinematic)
        mdt_moverFree(b);
    else if (!mdt_moverMake(b, caller))
        isKinematic = MEFALSE;
    clearConstraints(b);
    attachMimics(b);
    mdt_bodyApplyLocks(b);
    mdt_bodyRestart(b);
    mdt_graphChanged(b->world);
    MeStageEnd(&b->world->stage, MDT_GUARD_GRAPH);
}

static void MEAPI applyDeferredKinematic(const MeLater *later) {
    const MdtBodyID b = mdt_deferredBody(later);
    if (b)
        setKinematic(b, (MeBool)later->number, "MdtBodySetKinematic");
}

void MEAPI MdtBodySetKinematic(const MdtBodyID b, const MeBool kinematic) {
    MDT_NEED_BODY(b, );
    const MeLater later = {
        .carryOut = applyDeferredKinematic, .object = b, .serial = b->link.serial, .number = kinematic != 0};
    if (mdt_deferIfGuarded(b->world, MDT_GUARD_CONSTRAINTS, __func__, &later) == MeWhenNow)
        setKinematic(b, kinematic != 0, __func__);
}

MeBool MEAPI MdtBodyIsKinematic(const MdtBodyID b) {
    MDT_NEED_BODY(b, 0);
    return b->mover != NULL;
}

MeBool MEAPI MdtBodyIsMover(const MdtBodyID b) {
    MEASSERT(b);
    return b->mover != NULL;
}

MeBool MEAPI MdtBodyIsHidden(const MdtBodyID b) {
    MEASSERT(b);
    return b->mover && b->mover->isHidden;
}

MdtBodyID MEAPI MdtWorldNextHidden(const MdtWorldID w, const MdtBodyID b) {
    const MdtMover *m = b ? b->mover->next : w->movers;
    while (m && !m->isHidden)
        m = m->next;
    return m ? m->body : NULL;
}

/* ---- targets ---- */

void MEAPI MdtBodyMoveTo(const MdtBodyID b, const MeVector3 position, const MeVector4 quaternion) {
    MDT_CHANGE_BODY(b);
    if (!mdt_isPointer(__func__, "the position", position) || !mdt_isPointer(__func__, "the quaternion", quaternion) ||
        !mdt_isPositionValid(__func__, "the position", b->world, position[0], position[1], position[2]))
        return;
    const double p[3] = {position[0], position[1], position[2]};
    double q[4] = {quaternion[0], quaternion[1], quaternion[2], quaternion[3]};
    if (!mdt_normalizeQuaternion(__func__, q))
        return;
    if (!b->mover) {
        MeWarning(1, "%s: the body is not kinematic (MdtBodySetKinematic); nothing is changed", __func__);
        return;
    }
    mdt_bodyCentrePose(b, p, q, &b->mover->target);
    b->mover->hasTarget = METRUE;
}

/* ---- the step ---- */

/* rad/s: the angular velocity of the shorter rotation from q0 to q1 in h seconds. */
static void turnBetween(const double q0[4], const double q1[4], double h, double w[3]) {
    double back[4], turn[4];
    keaQuaternionConjugate(back, q0);
    keaQuaternionProduct(turn, q1, back);
    const double half = keaLength(turn + 1), angle = 2 * atan2(half, fabs(turn[0]));
    keaScale(w, half > 0 ? (turn[0] < 0 ? -1 : 1) * angle / (half * h) : 0, turn + 1);
}

static void setVelocities(MdtBodyID b, const double v[3], const double w[3]) {
    keaCopy(b->kea.velocity, v);
    MdtKeaBodySetAngularVelocity(&b->kea, w);
    mdt_bodyShow(b);
}

/* Sets the velocities of a body that has a target, or had one in the last step. */
static void followTarget(MdtMover *m, double h) {
    static const double none[3];
    MdtBodyID b = m->body;
    mdt_bodyAcceptVelocities(b);
    if (m->hasTarget) {
        double v[3], w[3];
        keaSubtract(v, m->target.position, b->kea.position);
        keaScale(v, 1 / h, v);
        turnBetween(b->kea.quaternion, m->target.quaternion, h, w);
        setVelocities(b, v, w);
        m->wasLed = METRUE;
    } else if (m->wasLed) {
        if (memcmp(&m->led, &b->velocity, sizeof m->led) == 0) /* else the program has set new ones */
            setVelocities(b, none, none);
        m->wasLed = MEFALSE;
    }
    m->led = b->velocity;
}

/* rad/s: the angular velocity with which the Cayley map turns a body by the angle h |w|. */
static void chordOf(const double w[3], double h, double chord[3]) {
    const double half = 0.5 * h * keaLength(w), max = 0.25 * ME_PI;
    keaScale(chord, half > 0 && half < max ? tan(half) / half : 1, w);
}

static MeBool isMotion(const MdtKeaVelocity *v) {
    return keaDot(v->lin, v->lin) + keaDot(v->ang, v->ang) > 0;
}

static void beginMover(MdtMover *m, double h) {
    const MdtBodyID b = m->body;
    followTarget(m, h);
    memset(&m->kea.velocity, 0, sizeof m->kea.velocity);
    if (b->record.flags & MDT_ENABLED)
        mdt_bodyVelocity(b, &m->kea.velocity);
    keaSubtract(m->kea.jump.lin, m->kea.velocity.lin, m->before.lin);
    keaSubtract(m->kea.jump.ang, m->kea.velocity.ang, m->before.ang);
    m->isMoving = isMotion(&m->kea.velocity) || isMotion(&m->before);
    keaCopy(m->kea.position, b->kea.position);
    memcpy(m->kea.quaternion, b->kea.quaternion, sizeof m->kea.quaternion);
    keaCopy(m->kea.chord.lin, m->kea.velocity.lin);
    chordOf(m->kea.velocity.ang, h, m->kea.chord.ang);
    mdt_bodySaveStart(b);
    for (MdtAttachment *at = b->attachments; at && m->isMoving; at = at->next)
        mdt_constraintDisturb(mdt_attachmentOwner(at));
}

MeBool MEAPI MdtBodyIsMoving(const MdtBodyID b) {
    MEASSERT(b->mover);
    return isMotion(&b->mover->kea.velocity);
}

MeBool MEAPI MdtWorldHasMovingMovers(const MdtWorldID w) {
    for (const MdtMover *m = w->movers; m; m = m->next)
        if (isMotion(&m->kea.velocity))
            return METRUE;
    return MEFALSE;
}

void MEAPI MdtWorldBeginMovers(const MdtWorldID w, const MeReal h) {
    MEASSERT(h > 0);
    for (MdtMover *m = w->movers; m; m = m->next)
        beginMover(m, (double)h);
}

/* The pose of a mover after some time of its step. */
static void poseAfter(const MdtMover *m, double time, MdtPose *pose) {
    double rotation[3], turn[4];
    keaCopy(pose->position, m->kea.position);
    keaAddScaled(pose->position, time, m->kea.velocity.lin);
    keaScale(rotation, time, m->kea.velocity.ang);
    keaQuaternionExp(turn, rotation);
    keaQuaternionProduct(pose->quaternion, turn, m->kea.quaternion);
    keaQuaternionNormalize(pose->quaternion);
}

/* Places the body. Its velocity stays: the angular momentum is that with the inertia's new attitude. */
static void placeMover(MdtMover *m, const MdtPose *pose) {
    const MdtBodyID b = m->body;
    double w[3];
    MdtKeaBodyGetAngularVelocity(&b->kea, w);
    keaCopy(b->kea.position, pose->position);
    memcpy(b->kea.quaternion, pose->quaternion, sizeof b->kea.quaternion);
    MdtKeaBodySetAngularVelocity(&b->kea, w);
    mdt_bodyShow(b);
}

MeBool MEAPI MdtBodyPlaceMover(const MdtBodyID b, const MeReal time) {
    MdtPose pose;
    const unsigned long moves = b->moves;
    MEASSERT(b->mover);
    if (!isMotion(&b->mover->kea.velocity))
        return MEFALSE;
    poseAfter(b->mover, (double)time, &pose);
    placeMover(b->mover, (double)time < b->world->lastStep ? &pose : &b->mover->end);
    return b->moves != moves;
}

void MEAPI MdtWorldPlaceMovers(const MdtWorldID w, const MeReal time) {
    for (MdtMover *m = w->movers; m; m = m->next)
        MdtBodyPlaceMover(m->body, time);
}

static void endMover(MdtMover *m, double h) {
    const MdtBodyID b = m->body;
    MdtBodyResetForces(b);
    MdtBodyResetImpulses(b);
    if (!(b->record.flags & MDT_ENABLED))
        return;
    if (m->hasTarget)
        m->end = m->target;
    else
        poseAfter(m, h, &m->end);
    m->hasTarget = MEFALSE;
    m->before = m->kea.velocity;
    if (isMotion(&m->kea.velocity)) {
        placeMover(m, &m->end);
        mdt_bodyClampPosition(b);
        mdt_bodyShow(b);
        m->led = b->velocity;
    }
    mdt_bodyAge(b, h);
}

void mdt_moversEnd(MdtWorldID w, double h) {
    for (MdtMover *m = w->movers; m; m = m->next)
        endMover(m, h);
}
