/* Rigid bodies: properties, state, forces. */
#include "MdtInternal.h"
#include "record/mdt_record_i.h"
#include "record/mdt_named_i.h"
#include "MeAssert.h"
#include <string.h>

/* A function that returns a property of the body b, which may be hidden; `none` for a bad handle. */
#define BODY_GETTER(Type, function, none, value)                                                                       \
    Type MEAPI function(const MdtBodyID b) {                                                                           \
        return mdt_isAnyBody(b, __func__) ? (value) : (none);                                                          \
    }

#define BODY_VECTOR_GETTER(function, vector)                                                                           \
    void MEAPI function(const MdtBodyID b, MeVector3 v) {                                                              \
        if (mdt_isResult(__func__, v, 3) && mdt_isBody(b, __func__))                                                   \
            mdt_toReal(v, vector);                                                                                     \
    }

/* ---- poses: the body's frame (p, q) and the centre of mass (x, qc); (c, t) is its pose in the body's frame:
 *          x = p + R(q) c,   qc = q t ---- */

static void getFrameQuaternion(const MdtBody *b, double q[4]) {
    double back[4];
    keaQuaternionConjugate(back, b->centre.quaternion);
    keaQuaternionProduct(q, b->kea.quaternion, back);
}

/* The axes of a body's frame of attitude q, the columns of R, and the offset R(q) c of the centre of mass, in the
 * world. */
static void getCentreOffset(const MdtBody *b, const double q[4], double R[3][3], double offset[3]) {
    keaQuaternionToMatrix(R, q);
    keaApply(offset, (const double(*)[3])R, b->centre.position);
}

static MeBool isUnit4(const double q[4]) {
    return fabs(q[0] * q[0] + keaDot(q + 1, q + 1) - 1) < 1e-6;
}

/* The pose of the body's frame from that of the centre of mass: position, attitude, and its axes, the columns of R. */
static void getFrameAxes(const MdtBody *b, double p[3], double q[4], double R[3][3]) {
    double offset[3];
    getFrameQuaternion(b, q);
    getCentreOffset(b, q, R, offset);
    keaSubtract(p, b->kea.position, offset);
}

static void getFrame(const MdtBody *b, double p[3], double q[4]) {
    double R[3][3];
    getFrameAxes(b, p, q, R);
}

/* Clears the initial guess of the acceleration: the program has changed the body's motion. */
static void clearAccelerationGuess(MdtBodyID b) {
    mdt_bodyDisturb(b);
    memset(b->kea.acceleration, 0, sizeof b->kea.acceleration);
}

static double distanceSquared(const double a[3], const double b[3]) {
    double d[3];
    keaSubtract(d, a, b);
    return keaDot(d, d);
}

/* Restarts the program's forces (mdt_force.c) if the program changes a velocity by more than the thresholds of sleep.
 * Smaller changes, such as setting the same velocity again or projecting it on a plane, let them go on. */
static void restartForceIfFast(MdtBodyID b, const double v[3], const double w[3]) {
    const MdtPartitionParams *sleepParams = &b->world->sleepParams;
    double spin[3];
    MdtKeaBodyGetAngularVelocity(&b->kea, spin);
    if (distanceSquared(b->kea.velocity, v) > (double)sleepParams->vel_thresh ||
        distanceSquared(spin, w) > (double)sleepParams->velrot_thresh)
        mdt_forceRestart(b);
}

/* Clears the initial guess of the acceleration and the warm start of the body's constraints: its pose has changed. */
static void clearWarmStarts(MdtBodyID b) {
    clearAccelerationGuess(b);
    for (MdtAttachment *a = b->attachments; a; a = a->next) {
        mdt_constraintClearWarmStart(mdt_attachmentOwner(a));
        mdt_constraintDisturb(mdt_attachmentOwner(a)); /* its other body is affected, too */
    }
}

/* Restarts the times from which the body may fall asleep. */
static void restartSleepTime(MdtBodyID b) {
    b->enabledTime = b->aliveTime = 0;
    b->aliveSteps = 0;
    mdt_stayRestart(b);
}

/* Notifies the body's user that the program has moved a disabled body. A sleeping body is left out, since it wakes and
 * is then updated anyway. */
static void notifyMoved(MdtBodyID b) {
    if (mdt_userOf(b) && !(b->record.flags & (MDT_ENABLED | MDT_ASLEEP)))
        mdt_userOf(b)->moved(b);
}

void mdt_bodyCentrePose(const MdtBody *b, const double p[3], const double q[4], MdtPose *pose) {
    double R[3][3], offset[3];
    getCentreOffset(b, q, R, offset);
    keaCopy(pose->position, p);
    keaAddScaled(pose->position, 1, offset);
    keaQuaternionProduct(pose->quaternion, q, b->centre.quaternion);
    keaQuaternionNormalize(pose->quaternion);
}

void mdt_bodyRestart(MdtBodyID b) {
    mdt_forceRestart(b);
    clearAccelerationGuess(b);
    restartSleepTime(b);
    memset(&b->kea.lastStep, 0, sizeof b->kea.lastStep);
}

/* Sets the inertia that Kea is to use. With locked rotations it depends on the attitude q. */
static void setKeaInertia(MdtBodyID b, const double q[4]) {
    double inertia[3][3] = {{0}};
    const MeBool full = (b->kea.flags & MdtKeaBodyFlagIsNonSpherical) != 0;
    const double mean = (b->inertia[0][0] + b->inertia[1][1] + b->inertia[2][2]) / 3;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inertia[i][j] = full ? b->inertia[i][j] : i == j ? mean : 0;
    if (b->kea.locked & MdtKeaLOCKEDROTATIONS)
        mdt_lockInertia(b->kea.locked >> 3, q, inertia);
    const MeBool isGood = MdtKeaBodySetInertia(&b->kea, (const double(*)[3])inertia);
    MEASSERT(isGood);
    (void)isGood;
}

/* Places the frame. The velocities stay, so the angular momentum changes with the attitude. */
static void setFrame(MdtBodyID b, const double p[3], const double q[4]) {
    const MdtPartitionParams *sleepParams = &b->world->sleepParams;
    const double h2 = b->world->lastStep * b->world->lastStep;
    const MdtPose before = mdt_bodyPose(b);
    MdtPose after;
    double w[3], moved[3], turned[4];
    MEASSERT(isUnit4(q) && isUnit4(b->centre.quaternion));
    mdt_bodyAcceptVelocities(b);
    keaCopy(w, b->spin);
    mdt_bodyCentrePose(b, p, q, &after);
    keaCopy(b->kea.position, after.position);
    memcpy(b->kea.quaternion, after.quaternion, sizeof b->kea.quaternion);
    if (b->kea.locked)
        setKeaInertia(b, b->kea.quaternion);
    MdtKeaBodySetAngularVelocity(&b->kea, w);
    mdt_bodyMotionSince(b, &before, moved, turned);
    if (keaDot(moved, moved) > h2 * (double)sleepParams->vel_thresh ||
        4 * keaDot(turned + 1, turned + 1) > h2 * (double)sleepParams->velrot_thresh)
        mdt_forceRestart(b);
    clearWarmStarts(b);
    restartSleepTime(b); /* its history belongs to another place */
    mdt_bodyShow(b);
    notifyMoved(b);
}

static void writeTransform(MeMatrix4 tm, const double p[3], const double R[3][3]) {
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            tm[i][j] = (MeReal)R[j][i]; /* row i of the transform is the frame's axis i */
        tm[i][3] = 0;
        tm[3][i] = (MeReal)p[i];
    }
    tm[3][3] = 1;
}

void mdt_bodyShow(MdtBodyID b) {
    MdtKeaTransformation frame;
    double q[4], R[3][3];
    getFrameAxes(b, frame.pos, q, frame.R);
    if (memcmp(&b->frame, &frame, sizeof frame) != 0) {
        b->frame = frame;
        b->moves++;
    }
    MEASSERT(isfinite((double)(MeReal)keaLength(b->kea.position)));
    writeTransform(b->transform, frame.pos, (const double(*)[3])frame.R);
    keaQuaternionToMatrix(R, b->kea.quaternion);
    writeTransform(b->centreTransform, b->kea.position, (const double(*)[3])R);
    MdtKeaBodyGetAngularVelocity(&b->kea, b->spin);
    mdt_toReal(b->velocity.lin, b->kea.velocity);
    mdt_toReal(b->velocity.ang, b->spin);
    b->shown = b->velocity;
}

int MEAPI MdtBodyGetManifoldCount(const MdtBodyID b) {
    MEASSERT(b);
    return b->manifolds;
}

unsigned long MEAPI MdtBodyGetMoves(const MdtBodyID b) {
    MEASSERT(b);
    return b->moves;
}

MeBool MEAPI MdtBodyMovedByStep(const MdtBodyID b, unsigned long moves) {
    MEASSERT(b);
    return b->start.moves == moves && b->moves == moves + 1;
}

void mdt_bodyRoundingOffset(const MdtBody *b, const double point[3], double lost[3]) {
    double offset[3], local[3];
    for (int i = 0; i < 3; i++)
        offset[i] = point[i] - (double)b->transform[3][i];
    for (int i = 0; i < 3; i++)
        local[i] = offset[0] * (double)b->transform[i][0] + offset[1] * (double)b->transform[i][1] +
                   offset[2] * (double)b->transform[i][2];
    keaApply(lost, b->frame.R, local);
    for (int i = 0; i < 3; i++)
        lost[i] += b->frame.pos[i] - point[i];
}

BODY_GETTER(MeReal, MdtBodyGetPositionBound, 0, (MeReal)mdt_worldBound(b->world))

void mdt_bodyClampPosition(MdtBodyID b) {
    static const double none[3] = {0, 0, 0};
    const double max = mdt_worldBound(b->world);
    double *at = b->kea.position;
    if (fabs(at[0]) < max && fabs(at[1]) < max && fabs(at[2]) < max)
        return;
    for (int i = 0; i < 3; i++)
        at[i] = fmin(fmax(at[i], -max), max);
    keaZero(b->kea.velocity);
    MdtKeaBodySetAngularVelocity(&b->kea, none);
    clearAccelerationGuess(b);
    mdt_forceRestart(b);
    if (!(b->record.flags & MDT_FAR))
        MeWarning(2,
                  "%s: a body (sort key %d) has come to %g m, where positions have no digits left, and is "
                  "stopped; disable or destroy what leaves the scene",
                  MeCallerName("MdtWorldStep"), b->link.sortKey, max);
    b->record.flags |= MDT_FAR;
}

static MeBool isPositionValid(const char *caller, MdtBodyID b, MeReal x, MeReal y, MeReal z) {
    if (!mdt_isPositionValid(caller, "the position", b->world, x, y, z))
        return MEFALSE;
    b->record.flags &= ~MDT_FAR;
    return METRUE;
}

/* Compares bit by bit; three memcmp of fixed size compile without a call. */
static MeBool areSameBits3(const MeReal *a, const MeReal *b) {
    return memcmp(a, b, sizeof *a) == 0 && memcmp(a + 1, b + 1, sizeof *a) == 0 && memcmp(a + 2, b + 2, sizeof *a) == 0;
}

void mdt_bodyAcceptVelocities(MdtBodyID b) {
    const MeBool linear = !areSameBits3(b->velocity.lin, b->shown.lin);
    const MeBool angular = !areSameBits3(b->velocity.ang, b->shown.ang);
    if (!linear && !angular)
        return;
    if (!mdt_areFinite(b->velocity.lin) || !mdt_areFinite(b->velocity.ang)) {
        MeWarning(1, "A velocity that is not finite was written through a body's pointer; it is ignored");
    } else {
        double v[3], w[3];
        mdt_fromReal(v, b->velocity.lin);
        mdt_fromReal(w, b->velocity.ang);
        keaDropAxes(b->kea.locked, v);
        keaDropAxes(b->kea.locked >> 3, w);
        restartForceIfFast(b, linear ? v : b->kea.velocity, angular ? w : b->spin);
        if (linear)
            keaCopy(b->kea.velocity, v);
        if (angular)
            MdtKeaBodySetAngularVelocity(&b->kea, w);
        clearAccelerationGuess(b);
    }
    mdt_bodyShow(b);
}

void mdt_bodyVelocity(const MdtBody *b, MdtKeaVelocity *v) {
    keaCopy(v->lin, b->kea.velocity);
    keaCopy(v->ang, b->spin);
}

/* ---- mass and inertia ---- */

/* Changes the inertia and keeps the angular velocity, but for what `locked` axes leave of it. */
static void changeInertia(MdtBodyID b, int locked) {
    double w[3];
    mdt_bodyDisturb(b);
    mdt_bodyAcceptVelocities(b);
    MdtKeaBodyGetAngularVelocity(&b->kea, w);
    b->kea.locked = locked;
    setKeaInertia(b, b->kea.quaternion);
    keaDropAxes(locked, b->kea.velocity);
    keaDropAxes(locked >> 3, w);
    MdtKeaBodySetAngularVelocity(&b->kea, w);
    mdt_bodyShow(b);
}

/* Whether the inertia between free rotations changes with the attitude that they lead to: about one axis it does not.
 * */
static MeBool turnsInertia(const MdtBody *b) {
    const int rotations = b->kea.locked >> 3;
    return (rotations == 1 || rotations == 2 || rotations == 4) && (b->kea.flags & MdtKeaBodyFlagIsNonSpherical);
}

void mdt_bodyApplyLocks(MdtBodyID b) {
    const int locked = b->mover ? 0 : b->lockedAxes;
    if (locked != b->kea.locked)
        changeInertia(b, locked);
}

void mdt_bodyLockRotations(MdtBodyID b) {
    changeInertia(b, b->kea.locked | MdtKeaLOCKEDROTATIONS);
}

void mdt_bodyTurnInertia(MdtBodyID b, double time) {
    double turn[4], q[4], w[3];
    if (!turnsInertia(b))
        return;
    keaScale(w, time, b->spin);
    keaQuaternionExp(turn, w);
    keaQuaternionProduct(q, turn, b->kea.quaternion);
    setKeaInertia(b, q);
}

static void setKeaFlag(MdtBodyID b, int flag, MeBool on) {
    if (on != ((b->kea.flags & flag) != 0))
        mdt_bodyDisturb(b);
    b->kea.flags = on ? b->kea.flags | flag : b->kea.flags & ~flag;
}

static void setNoFastSpinAxis(MdtBodyID b) {
    b->fastSpinAxis[0] = MDTBODY_DEFAULT_FAST_SPIN_X;
    b->fastSpinAxis[1] = MDTBODY_DEFAULT_FAST_SPIN_Y;
    b->fastSpinAxis[2] = MDTBODY_DEFAULT_FAST_SPIN_Z;
    setKeaFlag(b, MdtKeaBodyFlagUseFastSpin, MEFALSE);
}

static void setDefaults(MdtBodyID b) {
    const double m = b->world->params.massScale, l = b->world->params.lengthScale;
    b->kea = (MdtKeaBody){.quaternion = {1, 0, 0, 0},
                          .damping = {MDTBODY_DEFAULT_LINEAR_DAMPING, MDTBODY_DEFAULT_ANGULAR_DAMPING},
                          .flags = MdtKeaBodyFlagIsNonSpherical | MdtKeaBodyFlagAddCoriolisForce};
    b->centre = (MdtPose){.quaternion = {1, 0, 0, 0}};
    b->mass = MDTBODY_DEFAULT_MASS * m;
    b->kea.invMass = 1 / b->mass;
    memset(b->inertia, 0, sizeof b->inertia);
    for (int i = 0; i < 3; i++)
        b->inertia[i][i] = MDTBODY_DEFAULT_INERTIA * m * l * l;
    setKeaInertia(b, b->kea.quaternion);
    b->gravityFactor = 1;
    b->lockedAxes = MdtLockNone;
    b->maxSpeed[0] = b->maxSpeed[1] = MEINFINITY;
    keaZero(b->push);
    b->theta = 0.5;
    b->safeTime = MEINFINITY;
    mdt_bodyDisturb(b);
    if (b->forces)
        *b->forces = mdt_noForces;
    setNoFastSpinAxis(b);
    mdt_bodyShow(b);
}

/* ---- life ---- */

MdtBodyID MEAPI MdtBodyCreate(const MdtWorldID w) {
    MDT_NEED_WORLD(w, NULL);
    MdtBodyID b = mdt_poolGet(&w->bodyPool, MDT_BODY, __func__);
    if (!b)
        return NULL;
    b->world = w;
    b->partition = -1;
    setDefaults(b);
    mdt_listAppend(&w->bodies, &b->link, w->nextSerial++);
    return b;
}

/* Detaches a constraint of a body that is destroyed. Contact groups of the bridge are destroyed. */
static void releaseConstraint(MdtAttachment *at) {
    MdtConstraintID c = mdt_attachmentOwner(at);
    mdt_constraintDeactivate(c);
    if (c->record.flags & MDT_BRIDGED)
        mdt_constraintRemove(c);
    else
        mdt_constraintDetach(c, mdt_attachmentSide(at));
}

void mdt_bodyTerm(MdtBodyID b) {
    MdtWorldID w = b->world;
    b->record.flags |= MDT_CONDEMNED;
    MeStageBegin(&w->stage, MDT_GUARD_GRAPH); /* defers calls of the program's handlers */
    mdt_bodyDisable(b);
    if (mdt_userOf(b))
        mdt_userOf(b)->leave(b);
    while (b->attachments)
        releaseConstraint(b->attachments);
    MEASSERT(!b->attachments && !(b->record.flags & (MDT_ENABLED | MDT_ASLEEP)));
    MEASSERT(b->manifolds == 0);
    mdt_listRemove(&w->bodies, &b->link);
    mdt_moverFree(b);
    mdt_forcesFree(b);
    mdt_poolPut(&w->bodyPool, b);
    MeStageEnd(&w->stage, MDT_GUARD_GRAPH);
}

/* ---- hidden bodies ---- */

MdtBodyID MEAPI MdtBodyCreateHidden(const MdtWorldID w, const MeMatrix4 tm) {
    MdtBodyID b = mdt_poolGet(&w->hiddenPool, MDT_BODY, "MstBridgeUpdateContacts");
    if (!b)
        return NULL;
    b->world = w;
    setDefaults(b);
    b->record.flags |= MDT_ENABLED;
    if (!mdt_moverMake(b, "MstBridgeUpdateContacts") || !MdtBodyFollow(b, tm)) {
        MdtBodyDestroyHidden(b);
        return NULL;
    }
    b->mover->isHidden = METRUE;
    MdtBodyJump(b);
    return b;
}

void MEAPI MdtBodyJump(const MdtBodyID b) {
    keaCopy(b->kea.position, b->mover->target.position);
    memcpy(b->kea.quaternion, b->mover->target.quaternion, sizeof b->kea.quaternion);
    b->mover->hasTarget = MEFALSE;
    clearWarmStarts(b);
    mdt_bodyShow(b);
}

void MEAPI MdtBodySetHiddenUser(const MdtBodyID b, void *model, void *data, const MdtBodyUser *user) {
    MEASSERT(b->mover && b->mover->isHidden);
    b->model = model;
    b->userData = data;
    b->mover->user = user;
}

void MEAPI MdtBodyDestroyHidden(const MdtBodyID b) {
    MdtWorldID w = b->world;
    while (b->attachments)
        releaseConstraint(b->attachments);
    mdt_moverFree(b);
    mdt_forcesFree(b);
    mdt_poolPut(&w->hiddenPool, b);
}

void MEAPI MdtBodyDestroy(const MdtBodyID b) {
    if (mdt_mayDestroyBody(b, __func__))
        mdt_bodyDestroy(b, __func__);
}

MdtBodyID MEAPI MdtBodyCopy(const MdtBodyID b, const MdtWorldID w) {
    MDT_NEED_BODY(b, NULL);
    MDT_NEED_WORLD(w, NULL);
    MdtBodyID copy = MdtBodyCreate(w);
    if (!copy)
        return NULL;
    MdtBody made = *copy;
    mdt_bodyAcceptVelocities(b);
    *copy = *b;
    copy->record = made.record;
    copy->record.flags = b->record.flags;
    copy->link = made.link;
    copy->link.sortKey = b->link.sortKey;
    w->bodies.isSorted = MEFALSE;
    copy->world = w;
    copy->attachments = NULL;
    copy->manifolds = 0;
    copy->forces = NULL;
    if (b->forces && mdt_forcesMake(copy, __func__))
        *copy->forces = *b->forces;
    else
        copy->record.flags &= ~MDT_FORCED;
    copy->model = NULL;
    copy->mover = NULL;
    if (b->mover && mdt_moverMake(copy, __func__)) {
        copy->mover->target = b->mover->target;
        copy->mover->hasTarget = b->mover->hasTarget;
    }
    copy->record.flags &= ~(MDT_ENABLED | MDT_ASLEEP | MDT_CONDEMNED | MDT_MODELLED);
    copy->partition = -1;
    if (b->record.flags & MDT_ENABLED)
        MdtBodyEnable(copy);
    return copy;
}

void MEAPI MdtBodyReset(const MdtBodyID b) {
    MDT_CHANGE_BODY(b);
    setDefaults(b);
    MdtBodyWakeIfAsleep(b);
}

static void endSleep(MdtBodyID b) {
    if (!(b->record.flags & MDT_ASLEEP))
        return;
    MEASSERT(!(b->record.flags & MDT_ENABLED));
    b->record.flags &= ~MDT_ASLEEP;
    b->world->asleepBodies--;
    MEASSERT(b->world->asleepBodies >= 0);
}

/* Calls the handlers of Mst and of the program. Objects that the program's destroys, enables or disables are processed
 * after its return. */
static void callHandlers(MdtBodyID b, MdtBodyHandler ofModels, MdtBodyHandler handler) {
    MdtWorldID w = b->world;
    if (ofModels)
        ofModels(b);
    if (!handler)
        return;
    MeStageBegin(&w->stage, MDT_GUARD_GRAPH);
    const MeProgramCall before = MeProgramEnter("MdtWorldSetBodyHandlers");
    handler(b);
    MeProgramLeave(&before);
    MeStageEnd(&w->stage, MDT_GUARD_GRAPH);
}

void mdt_bodyEnable(MdtBodyID b) {
    endSleep(b);
    b->aliveTime = 0;
    b->aliveSteps = 0;
    if (b->record.flags & MDT_ENABLED)
        return;
    b->record.flags |= MDT_ENABLED;
    mdt_graphChanged(b->world);
    mdt_forceRestart(b);
    clearAccelerationGuess(b);
    restartSleepTime(b);
    b->world->enabledBodies++;
    MEASSERT(b->world->enabledBodies <= b->world->bodies.count);
    callHandlers(b, b->world->modelsEnabled, b->world->bodyEnabled);
}

void mdt_bodyDisable(MdtBodyID b) {
    endSleep(b);
    if (!(b->record.flags & MDT_ENABLED))
        return;
    b->record.flags &= ~MDT_ENABLED;
    mdt_graphChanged(b->world);
    b->lag = 0;
    restartSleepTime(b);
    b->partition = -1;
    b->world->enabledBodies--;
    MEASSERT(b->world->enabledBodies >= 0);
    callHandlers(b, b->world->modelsDisabled, b->world->bodyDisabled);
}

static void MEAPI applyDeferredEnabling(const MeLater *later) {
    MdtBodyID b = mdt_deferredBody(later);
    if (b && later->number)
        MdtBodyEnable(b);
    else if (b)
        MdtBodyDisable(b);
}

static MeBool mayEnableNow(MdtBodyID b, MeBool isEnabled, const char *caller) {
    const MeLater later = {
        .carryOut = applyDeferredEnabling, .object = b, .serial = b->link.serial, .number = (long)isEnabled};
    return mdt_deferIfGuarded(b->world, MDT_GUARD_GRAPH, caller, &later) == MeWhenNow;
}

void MEAPI MdtBodyEnable(const MdtBodyID b) {
    MDT_NEED_BODY(b, );
    if (mayEnableNow(b, METRUE, __func__))
        mdt_bodyEnable(b);
}

void MEAPI MdtBodyEndSleep(const MdtBodyID b) {
    if (!MeStageIsActive(&b->world->stage, MDT_GUARD_GRAPH))
        endSleep(b);
}

MeBool MEAPI MdtBodyWakeIfAsleep(const MdtBodyID b) {
    MEASSERT(b);
    const MeBool isAsleep = (b->record.flags & MDT_ASLEEP) != 0;
    if (isAsleep)
        MdtBodyEnable(b);
    return isAsleep;
}

void MEAPI MdtBodyDisable(const MdtBodyID b) {
    MDT_NEED_BODY(b, );
    if (mayEnableNow(b, MEFALSE, __func__))
        mdt_bodyDisable(b);
}

BODY_GETTER(MeBool, MdtBodyIsEnabled, 0, (b->record.flags & MDT_ENABLED) != 0)

BODY_GETTER(MeReal, MdtBodyGetEnabledTime, 0, (MeReal)b->enabledTime)

static MeBool isFast(const MdtBody *b, const MdtPartitionParams *params) {
    return keaDot(b->kea.velocity, b->kea.velocity) >= (double)params->vel_thresh ||
           keaDot(b->spin, b->spin) >= (double)params->velrot_thresh;
}

static MeBool isAccelerated(const MdtBody *b, const MdtPartitionParams *params) {
    return keaDot(b->kea.lastStep.lin, b->kea.lastStep.lin) >= (double)params->acc_thresh ||
           keaDot(b->kea.lastStep.ang, b->kea.lastStep.ang) >= (double)params->accrot_thresh;
}

MeBool mdt_bodyIsFast(const MdtBody *b) {
    return isFast(b, &b->world->sleepParams);
}

void mdt_bodyAge(MdtBodyID b, double h) {
    MEASSERT(h > 0 && (b->record.flags & MDT_ENABLED));
    b->enabledTime += h;
    b->aliveTime += h;
    b->aliveSteps++;
    mdt_stayUpdate(b, h);
}

/* An accelerated body that stays in its place does not count as moving: the acceleration is solver jitter. */
MeBool MEAPI MdtBodyIsMovingTest(const MdtBodyID b, const MdtPartitionParams *params) {
    MDT_NEED_BODY(b, 0);
    if (!mdt_isPointer(__func__, "the thresholds", params))
        return MEFALSE;
    mdt_bodyAcceptVelocities(b);
    return isFast(b, params) || (isAccelerated(b, params) && !mdt_bodyStaysInPlace(b));
}

/* Sets the kick: the impulses that wait for the step, without their parts along locked axes. */
static void setKick(MdtBodyID b) {
    memcpy(b->kea.kick, mdt_forcesOf(b)->impulse, sizeof b->kea.kick);
    keaDropAxes(b->kea.locked, b->kea.kick[0]);
    keaDropAxes(b->kea.locked >> 3, b->kea.kick[1]);
}

/* Adds the impulses that wait for the step to the momenta. Only for bodies without joints: joints would have to
 * distribute the impulses. */
static void addKick(MdtBodyID b) {
    keaAddScaled(b->kea.velocity, b->kea.invMass, b->kea.kick[0]);
    if (keaDot(b->kea.kick[1], b->kea.kick[1]) > 0) {
        keaAddScaled(b->kea.angularMomentum, 1, b->kea.kick[1]);
        MdtKeaBodyGetAngularVelocity(&b->kea, b->spin);
    }
    memset(b->kea.kick, 0, sizeof b->kea.kick);
}

static MeBool hasJoint(const MdtBody *b) {
    for (const MdtAttachment *at = b->attachments; at; at = at->next)
        if (mdt_asJoint(mdt_attachmentOwner(at)))
            return METRUE;
    return MEFALSE;
}

/* Wakes a sleeper for its impulse; false: the impulse is too small to do so by itself. */
static MeBool wakeForImpulse(MdtBodyID b, double h) {
    if (!(b->record.flags & MDT_ASLEEP))
        return METRUE;
    if (!mdt_bodyWouldMove(b, b->forces->impulse, h))
        return MEFALSE;
    mdt_bodyEnable(b);
    return METRUE;
}

void MEAPI MdtWorldApplyImpulses(const MdtWorldID w, const MeReal h) {
    MEASSERT(w && h > 0);
    MeStageBegin(&w->stage, MDT_GUARD_CONSTRAINTS); /* defers calls of the program's handlers */
    for (MdtLink *link = w->bodies.first; link; link = link->next) {
        const MdtBodyID b = mdt_linkOwner(link);
        if (memcmp(mdt_forcesOf(b)->impulse, mdt_noForces.impulse, sizeof mdt_noForces.impulse) == 0 || b->mover ||
            (b->record.flags & MDT_CONDEMNED) || hasJoint(b) || !wakeForImpulse(b, (double)h) ||
            !(b->record.flags & MDT_ENABLED))
            continue;
        mdt_bodyAcceptVelocities(b);
        setKick(b);
        addKick(b);
        MdtBodyResetImpulses(b);
        mdt_bodyShow(b);
        mdt_bodyDisturb(b);
    }
    MeStageEnd(&w->stage, MDT_GUARD_CONSTRAINTS);
}

void mdt_bodySaveStart(MdtBodyID b) {
    mdt_bodyVelocity(b, &b->start.velocity);
    b->start.pose = mdt_bodyPose(b);
    b->start.moves = b->moves;
    b->kea.fall = 0;
    if (b->forces)
        mdt_bodyMomenta(b, b->forces->momentum);
}

void mdt_bodyPack(MdtBodyID b, double frame, MeBool hasJoints) {
    MEASSERT(b->mass > 0 && b->kea.invMass > 0 && (b->record.flags & MDT_ENABLED));
    MEASSERT(isfinite(keaDot(b->kea.position, b->kea.position)));
    MEASSERT(fabs(1 - sqrt(keaDot(b->kea.quaternion + 1, b->kea.quaternion + 1) +
                           b->kea.quaternion[0] * b->kea.quaternion[0])) < 1e-6);
    mdt_bodyAcceptVelocities(b);
    if (b->mass > b->world->sinkingMass)
        mdt_forgottenScale(b);
    setKick(b);
    mdt_forceBegin(b);
    if (!hasJoints)
        addKick(b);
    mdt_forceApply(b, frame);
    mdt_bodyTurnInertia(b, 0.5 * frame);
    MEASSERT(isfinite(b->kea.force[0] + b->kea.force[1] + b->kea.force[2]));
    MdtBodyResetImpulses(b);
}

/* ---- the frame ---- */

void MEAPI MdtBodySetPosition(const MdtBodyID b, const MeReal x, const MeReal y, const MeReal z) {
    MDT_CHANGE_BODY(b);
    if (!isPositionValid(__func__, b, x, y, z))
        return;
    const double to[3] = {x, y, z};
    double p[3], q[4];
    getFrame(b, p, q);
    setFrame(b, to, q);
    MdtBodyWakeIfAsleep(b);
}

void MEAPI MdtBodyGetPosition(const MdtBodyID b, MeVector3 p) {
    if (!mdt_isResult(__func__, p, 3) || !mdt_isBody(b, __func__))
        return;
    memcpy(p, b->transform[3], sizeof(MeVector3));
}

static void rotateFrame(MdtBodyID b, const double q[4]) {
    double p[3], old[4];
    getFrame(b, p, old);
    setFrame(b, p, q);
    MdtBodyWakeIfAsleep(b);
}

void MEAPI MdtBodySetQuaternion(const MdtBodyID b, const MeReal qw, const MeReal qx, const MeReal qy, const MeReal qz) {
    MDT_CHANGE_BODY(b);
    double q[4] = {qw, qx, qy, qz};
    if (mdt_normalizeQuaternion(__func__, q))
        rotateFrame(b, q);
}

void MEAPI MdtBodyGetQuaternion(const MdtBodyID b, MeVector4 q) {
    if (!mdt_isResult(__func__, q, 4) || !mdt_isBody(b, __func__))
        return;
    double turn[4];
    getFrameQuaternion(b, turn);
    for (int i = 0; i < 4; i++)
        q[i] = (MeReal)turn[i];
}

/* True if the matrix is orthonormal to 1 %. */
static MeBool isRotation(const double R[3][3]) {
    double across[3];
    keaCross(across, R[0], R[1]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double expected = i == j ? 1 : 0;
            if (!(fabs(keaDot(R[i], R[j]) - expected) < 0.01) || !(fabs(across[j] - R[2][j]) < 0.03))
                return MEFALSE;
        }
    return METRUE;
}

/* The quaternion of the rotation nearest to a matrix that is one to 1 %; otherwise warns. */
static MeBool toRotation(const char *caller, const double R[3][3], double q[4]) {
    if (!isRotation(R)) {
        MeWarning(1, "%s: the matrix is no rotation; nothing is changed", caller);
        return MEFALSE;
    }
    keaQuaternionFromMatrix(q, R);
    return METRUE;
}

void MEAPI MdtBodySetOrientation(const MdtBodyID b, const MeMatrix3 R) {
    MDT_CHANGE_BODY(b);
    if (!mdt_isPointer(__func__, "the orientation", R))
        return;
    double r[3][3], q[4];
    for (int i = 0; i < 3; i++)
        mdt_fromReal(r[i], R[i]);
    if (toRotation(__func__, (const double(*)[3])r, q))
        rotateFrame(b, q);
}

void MEAPI MdtBodyGetOrientation(const MdtBodyID b, MeMatrix3 R) {
    if (!mdt_isResult(__func__, (MeReal *)R, 9) || !mdt_isBody(b, __func__))
        return;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            R[i][j] = b->transform[j][i];
}

/* Splits an OpenGL transform into translation and rotation. False, with a warning, if it is not a valid one. */
static MeBool splitTransform(const char *caller, const MeMatrix4 tm, double p[3], double q[4]) {
    double R[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            R[i][j] = tm[j][i];
    mdt_fromReal(p, tm[3]);
    return mdt_isFinite3(caller, "the translation", tm[3][0], tm[3][1], tm[3][2]) &&
           toRotation(caller, (const double(*)[3])R, q);
}

void MEAPI MdtBodySetTransform(const MdtBodyID b, const MeMatrix4 tm) {
    MDT_CHANGE_BODY(b);
    double p[3], q[4];
    if (!mdt_isPointer(__func__, "the transform", tm) || !splitTransform(__func__, tm, p, q) ||
        !isPositionValid(__func__, b, tm[3][0], tm[3][1], tm[3][2]))
        return;
    setFrame(b, p, q);
    MdtBodyWakeIfAsleep(b);
}

void MEAPI MdtBodyGetTransform(const MdtBodyID b, MeMatrix4 m) {
    if (!mdt_isResult(__func__, (MeReal *)m, 16) || !mdt_isBody(b, __func__))
        return;
    memcpy(m, b->transform, sizeof b->transform);
}

BODY_GETTER(MeMatrix4Ptr, MdtBodyGetTransformPtr, NULL, b->transform)

static MeBool isWithinBound(const MdtWorld *w, const double p[3]) {
    const double max = mdt_worldBound(w);
    return fabs(p[0]) <= max && fabs(p[1]) <= max && fabs(p[2]) <= max;
}

MeBool MEAPI MdtBodyFollow(const MdtBodyID b, const MeMatrix4 tm) {
    double R[3][3], p[3], q[4];
    MEASSERT(b->mover);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            R[i][j] = tm[j][i];
    mdt_fromReal(p, tm[3]);
    if (!isWithinBound(b->world, p) || !isRotation((const double(*)[3])R))
        return MEFALSE;
    keaQuaternionFromMatrix(q, (const double(*)[3])R);
    mdt_bodyCentrePose(b, p, q, &b->mover->target);
    b->mover->hasTarget = METRUE;
    return METRUE;
}

/* ---- the centre of mass ---- */

/* True if the centre of mass is within the bound of positions, both in the body's frame and in the world. */
static MeBool isCentreInBound(const char *caller, const MdtBody *b, const double centre[3]) {
    double p[3], q[4], R[3][3], at[3];
    getFrame(b, p, q);
    keaQuaternionToMatrix(R, q);
    keaApply(at, (const double(*)[3])R, centre);
    keaAddScaled(p, 1, at);
    return mdt_isPositionValid(caller, "the centre of mass", b->world, (MeReal)centre[0], (MeReal)centre[1],
                               (MeReal)centre[2]) &&
           mdt_isPositionValid(caller, "the centre of mass, in the world,", b->world, (MeReal)p[0], (MeReal)p[1],
                               (MeReal)p[2]);
}

/* Changes the centre of mass's pose in the body. The body's frame and its attachments stay where they are. */
static void setCentre(const char *caller, MdtBodyID b, const double centre[3], const double turn[4]) {
    double p[3], q[4];
    const MdtKeaBody before = b->kea;
    if (!isCentreInBound(caller, b, centre))
        return;
    b->record.flags &= ~MDT_OFF_CENTRE;
    getFrame(b, p, q);
    keaCopy(b->centre.position, centre);
    memcpy(b->centre.quaternion, turn, sizeof b->centre.quaternion);
    setFrame(b, p, q);
    for (MdtAttachment *at = b->attachments; at; at = at->next)
        mdt_constraintReframe(mdt_attachmentOwner(at), mdt_attachmentSide(at), &before, &b->kea);
    MdtBodyWakeIfAsleep(b);
}

void MEAPI MdtBodySetCenterOfMassRelativePosition(const MdtBodyID b, const MeVector3 pos) {
    MDT_CHANGE_BODY(b);
    if (!mdt_isPointer(__func__, "the position", pos))
        return;
    double centre[3];
    mdt_fromReal(centre, pos);
    setCentre(__func__, b, centre, b->centre.quaternion);
}

BODY_VECTOR_GETTER(MdtBodyGetCenterOfMassRelativePosition, b->centre.position)

void MEAPI MdtBodySetCenterOfMassRelativeTransform(const MdtBodyID b, const MeMatrix4 t) {
    MDT_CHANGE_BODY(b);
    double centre[3], turn[4];
    if (mdt_isPointer(__func__, "the transform", t) && splitTransform(__func__, t, centre, turn))
        setCentre(__func__, b, centre, turn);
}

void MEAPI MdtBodyGetCenterOfMassRelativeTransform(const MdtBodyID b, MeMatrix4 t) {
    if (!mdt_isResult(__func__, (MeReal *)t, 16) || !mdt_isBody(b, __func__))
        return;
    double R[3][3];
    keaQuaternionToMatrix(R, b->centre.quaternion);
    writeTransform(t, b->centre.position, (const double(*)[3])R);
}

void MEAPI MdtBodySetCenterOfMassPosition(const MdtBodyID b, const MeVector3 pos) {
    MDT_CHANGE_BODY(b);
    if (!mdt_isPointer(__func__, "the position", pos) || !isPositionValid(__func__, b, pos[0], pos[1], pos[2]))
        return;
    mdt_fromReal(b->kea.position, pos);
    mdt_forceRestart(b);
    clearWarmStarts(b);
    restartSleepTime(b);
    mdt_bodyAcceptVelocities(b);
    mdt_bodyShow(b);
    notifyMoved(b);
    MdtBodyWakeIfAsleep(b);
}

void MEAPI MdtBodyGetCenterOfMassPosition(const MdtBodyID b, MeVector3 pos) {
    if (!mdt_isResult(__func__, pos, 3) || !mdt_isBody(b, __func__))
        return;
    memcpy(pos, b->centreTransform[3], sizeof(MeVector3));
}

BODY_GETTER(MeMatrix4Ptr, MdtBodyGetCenterOfMassTransformPtr, NULL, b->centreTransform)

/* ---- motion ---- */

void MEAPI MdtBodySetLinearVelocity(const MdtBodyID b, const MeReal dx, const MeReal dy, const MeReal dz) {
    MDT_CHANGE_BODY(b);
    if (!mdt_isFinite3(__func__, "the velocity", dx, dy, dz))
        return;
    double v[3] = {dx, dy, dz};
    keaDropAxes(b->kea.locked, v);
    mdt_bodyAcceptVelocities(b);
    restartForceIfFast(b, v, b->spin);
    keaCopy(b->kea.velocity, v);
    clearAccelerationGuess(b);
    mdt_bodyShow(b);
    MdtBodyWakeIfAsleep(b);
}

void MEAPI MdtBodyGetLinearVelocity(const MdtBodyID b, MeVector3 v) {
    if (!mdt_isResult(__func__, v, 3) || !mdt_isBody(b, __func__))
        return;
    mdt_bodyAcceptVelocities(b);
    memcpy(v, b->velocity.lin, sizeof b->velocity.lin);
}

BODY_GETTER(MeReal *, MdtBodyGetLinearVelocityPtr, NULL, b->velocity.lin)

void MEAPI MdtBodySetAngularVelocity(const MdtBodyID b, const MeReal wx, const MeReal wy, const MeReal wz) {
    MDT_CHANGE_BODY(b);
    if (!mdt_isFinite3(__func__, "the angular velocity", wx, wy, wz))
        return;
    double w[3] = {wx, wy, wz};
    keaDropAxes(b->kea.locked >> 3, w);
    mdt_bodyAcceptVelocities(b);
    restartForceIfFast(b, b->kea.velocity, w);
    MdtKeaBodySetAngularVelocity(&b->kea, w);
    clearAccelerationGuess(b);
    mdt_bodyShow(b);
    MdtBodyWakeIfAsleep(b);
}

void MEAPI MdtBodyGetAngularVelocity(const MdtBodyID b, MeVector3 v) {
    if (!mdt_isResult(__func__, v, 3) || !mdt_isBody(b, __func__))
        return;
    mdt_bodyAcceptVelocities(b);
    memcpy(v, b->velocity.ang, sizeof b->velocity.ang);
}

BODY_GETTER(MeReal *, MdtBodyGetAngularVelocityPtr, NULL, b->velocity.ang)

BODY_VECTOR_GETTER(MdtBodyGetLinearAcceleration, b->kea.lastStep.lin)

BODY_VECTOR_GETTER(MdtBodyGetAngularAcceleration, b->kea.lastStep.ang)

void MEAPI MdtBodyGetVelocityAtPoint(const MdtBodyID body, MeVector3 p, MeVector3 v) {
    if (!mdt_isPointer(__func__, "the point", p) || !mdt_isPointer(__func__, "the result", v))
        return;
    const double point[3] = {p[0], p[1], p[2]};
    v[0] = v[1] = v[2] = 0;
    if (!mdt_isFinite3(__func__, "the point", (MeReal)point[0], (MeReal)point[1], (MeReal)point[2]))
        return;
    if (!mdt_isAnyBody(body, __func__))
        return;
    double arm[3], turning[3];
    mdt_bodyAcceptVelocities(body);
    keaSubtract(arm, point, body->kea.position);
    keaCross(turning, body->spin, arm);
    keaAddScaled(turning, 1, body->kea.velocity);
    mdt_toReal(v, turning);
}

MeReal MEAPI MdtBodyGetKineticEnergy(const MdtBodyID b) {
    MDT_NEED_BODY(b, 0);
    mdt_bodyAcceptVelocities(b);
    return mdt_real(0.5 *
                    (b->mass * keaDot(b->kea.velocity, b->kea.velocity) + keaDot(b->spin, b->kea.angularMomentum)));
}

/* ---- mass ---- */

void MEAPI MdtBodySetMass(const MdtBodyID b, const MeReal mass) {
    MDT_CHANGE_BODY(b);
    if (!mdt_isPositive(__func__, "the mass", mass))
        return;
    if ((double)mass != b->mass)
        mdt_bodyDisturb(b);
    b->mass = (double)mass;
    b->kea.invMass = 1 / b->mass;
}

BODY_GETTER(MeReal, MdtBodyGetMass, 0, (MeReal)b->mass)

static MeBool areMomentsInRange(const double moments[3]) {
    return mdt_isPositiveInRange((MeReal)moments[0]) && mdt_isPositiveInRange((MeReal)moments[1]) &&
           mdt_isPositiveInRange((MeReal)moments[2]);
}

void MEAPI MdtBodySetInertiaTensor(const MdtBodyID b, const MeMatrix3 i) {
    MDT_CHANGE_BODY(b);
    if (!mdt_isPointer(__func__, "the tensor", i))
        return;
    double tensor[3][3];
    MdtKeaBody trial;
    for (int k = 0; k < 3; k++)
        mdt_fromReal(tensor[k], i[k]);
    if (!mdt_areFinite(i[0]) || !mdt_areFinite(i[1]) || !mdt_areFinite(i[2]) ||
        !MdtKeaBodySetInertia(&trial, (const double(*)[3])tensor) || !areMomentsInRange(trial.moments)) {
        MeWarning(1,
                  "%s: the tensor must be symmetric and positive definite, of moments that single precision can have; "
                  "nothing is changed",
                  __func__);
        return;
    }
    memcpy(b->inertia, tensor, sizeof tensor);
    changeInertia(b, b->kea.locked);
}

void MEAPI MdtBodyGetInertiaTensor(const MdtBodyID b, MeMatrix3 i) {
    if (!mdt_isResult(__func__, (MeReal *)i, 9) || !mdt_isBody(b, __func__))
        return;
    for (int k = 0; k < 3; k++)
        mdt_toReal(i[k], b->inertia[k]);
}

void MEAPI MdtBodySetSphericalInertiaTensor(const MdtBodyID b, const MeReal i) {
    MDT_CHANGE_BODY(b);
    if (!mdt_isPositive(__func__, "the moment of inertia", i) ||
        !mdt_isFinite3(__func__, "the moment of inertia", i, i, i))
        return;
    memset(b->inertia, 0, sizeof b->inertia);
    for (int k = 0; k < 3; k++)
        b->inertia[k][k] = (double)i;
    changeInertia(b, b->kea.locked);
}

void MEAPI MdtBodyEnableNonSphericalInertia(const MdtBodyID b) {
    MDT_CHANGE_BODY(b);
    setKeaFlag(b, MdtKeaBodyFlagIsNonSpherical, METRUE);
    changeInertia(b, b->kea.locked);
}

void MEAPI MdtBodyDisableNonSphericalInertia(const MdtBodyID b) {
    MDT_CHANGE_BODY(b);
    setKeaFlag(b, MdtKeaBodyFlagIsNonSpherical, MEFALSE);
    changeInertia(b, b->kea.locked);
}

BODY_GETTER(MeBool, MdtBodyNonSphericalInertiaIsEnabled, 0, (b->kea.flags & MdtKeaBodyFlagIsNonSpherical) != 0)

void MEAPI MdtBodyEnableCoriolisForce(const MdtBodyID b) {
    MDT_CHANGE_BODY(b);
    setKeaFlag(b, MdtKeaBodyFlagAddCoriolisForce, METRUE);
}

void MEAPI MdtBodyDisableCoriolisForce(const MdtBodyID b) {
    MDT_CHANGE_BODY(b);
    setKeaFlag(b, MdtKeaBodyFlagAddCoriolisForce, MEFALSE);
}

/* In the rest of a step the last part's forces go on (mdt_forceContinue). */
void MEAPI MdtBodyGetLoadAcceleration(const MdtBodyID b, MeVector3 a) {
    MDT_NEED_BODY(b, );
    const MdtForces *f = mdt_forcesOf(b);
    for (int i = 0; i < 3; i++) {
        const double force = f->load[0][i] + (b->lag > 0 ? f->lastLoad[0][i] : 0);
        a[i] = !(b->kea.locked >> i & 1)
                   ? mdt_real(b->gravityFactor * (double)b->world->params.gravity[i] + force * b->kea.invMass)
                   : 0;
    }
}

void MEAPI MdtBodyGetFreeAcceleration(const MdtBodyID b, MeVector3 a) {
    MDT_NEED_BODY(b, );
    if (b->record.flags & MDT_ENABLED)
        MdtBodyGetLoadAcceleration(b, a);
    else
        MeVector3Set(a, 0, 0, 0);
}

/* Euler's equations: I_i dw_i/dt = (I_j - I_k) w_j w_k about the principal axes. The momentum L and the energy T stay,
 * so that |w_i| is at most L / I_i and sqrt(2 T / I_i). */
MeReal MEAPI MdtBodyGetFreeSpinRate(const MdtBodyID b) {
    MDT_NEED_BODY(b, 0);
    const double *I = b->kea.moments, momentum = keaLength(b->kea.angularMomentum);
    const double energy = fmax(keaDot(b->kea.angularMomentum, b->spin), 0); /* twice the energy */
    double max[3], square = 0;
    for (int i = 0; i < 3; i++)
        max[i] = fmin(momentum / I[i], sqrt(energy / I[i]));
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double rate = (I[j] - I[k]) / I[i] * max[j] * max[k];
        square += rate * rate;
    }
    return mdt_real(sqrt(square));
}

BODY_GETTER(MeBool, MdtBodyCoriolisForceIsEnabled, 0, (b->kea.flags & MdtKeaBodyFlagAddCoriolisForce) != 0)

/* ---- forces ---- */

/* Adds v, at a point (null: at the centre of mass), to a sum of forces and torques, or of impulses. */
static void addWithMoment(const MdtBody *b, const double v[3], const double *point, double sum[2][3]) {
    keaAddScaled(sum[0], 1, v);
    if (!point)
        return;
    double arm[3], turn[3];
    keaSubtract(arm, point, b->kea.position);
    keaCross(turn, arm, v);
    keaAddScaled(sum[1], 1, turn);
}

static void addForce(MdtBodyID b, const double f[3], const double *point, const char *caller) {
    MdtForces *forces = mdt_forcesMake(b, caller);
    if (!forces)
        return;
    b->record.flags |= MDT_FORCED;
    addWithMoment(b, f, point, forces->load);
}

void MEAPI MdtBodyAddForce(const MdtBodyID b, const MeReal fx, const MeReal fy, const MeReal fz) {
    MDT_NEED_BODY(b, );
    const double f[3] = {fx, fy, fz};
    if (mdt_isFinite3(__func__, "the force", fx, fy, fz))
        addForce(b, f, NULL, __func__);
}

void MEAPI MdtBodyAddForceAtPosition(const MdtBodyID b, const MeReal fx, const MeReal fy, const MeReal fz,
                                     const MeReal px, const MeReal py, const MeReal pz) {
    MDT_NEED_BODY(b, );
    const double f[3] = {fx, fy, fz}, p[3] = {px, py, pz};
    if (mdt_isFinite3(__func__, "the force", fx, fy, fz) && mdt_isFinite3(__func__, "the position", px, py, pz))
        addForce(b, f, p, __func__);
}

void MEAPI MdtBodyAddTorque(const MdtBodyID b, const MeReal tx, const MeReal ty, const MeReal tz) {
    MDT_NEED_BODY(b, );
    const double t[3] = {tx, ty, tz};
    MdtForces *forces = mdt_isFinite3(__func__, "the torque", tx, ty, tz) ? mdt_forcesMake(b, __func__) : NULL;
    if (!forces)
        return;
    b->record.flags |= MDT_FORCED;
    keaAddScaled(forces->load[1], 1, t);
}

static void addImpulse(MdtBodyID b, const double i[3], const double *point, const char *caller) {
    MdtForces *forces = mdt_forcesMake(b, caller);
    if (forces)
        addWithMoment(b, i, point, forces->impulse);
}

void MEAPI MdtBodyAddImpulse(const MdtBodyID b, const MeReal ix, const MeReal iy, const MeReal iz) {
    MDT_NEED_BODY(b, );
    const double i[3] = {ix, iy, iz};
    if (mdt_isFinite3(__func__, "the impulse", ix, iy, iz))
        addImpulse(b, i, NULL, __func__);
}

void MEAPI MdtBodyAddImpulseAtPosition(const MdtBodyID b, const MeReal ix, const MeReal iy, const MeReal iz,
                                       const MeReal px, const MeReal py, const MeReal pz) {
    MDT_NEED_BODY(b, );
    const double i[3] = {ix, iy, iz}, p[3] = {px, py, pz};
    if (mdt_isFinite3(__func__, "the impulse", ix, iy, iz) && mdt_isFinite3(__func__, "the position", px, py, pz))
        addImpulse(b, i, p, __func__);
}

BODY_VECTOR_GETTER(MdtBodyGetForce, mdt_forcesOf(b)->load[0])

BODY_VECTOR_GETTER(MdtBodyGetTorque, mdt_forcesOf(b)->load[1])

void MEAPI MdtBodyResetImpulses(const MdtBodyID b) {
    if (!mdt_isAnyBody(b, __func__))
        return;
    if (b->forces)
        memset(b->forces->impulse, 0, sizeof b->forces->impulse);
}

/* ---- damping and fast spin ---- */

static void setDamping(MdtBodyID b, int k, MeReal d, const char *caller) {
    if (!mdt_isNotBelow(caller, "the damping", d, 0))
        return;
    if (b->kea.damping[k] != (double)d)
        mdt_bodyDisturb(b);
    b->kea.damping[k] = d;
}

void MEAPI MdtBodySetLinearVelocityDamping(const MdtBodyID b, const MeReal d) {
    MDT_CHANGE_BODY(b);
    setDamping(b, 0, d, __func__);
}

BODY_GETTER(MeReal, MdtBodyGetLinearVelocityDamping, 0, (MeReal)b->kea.damping[0])

void MEAPI MdtBodySetAngularVelocityDamping(const MdtBodyID b, const MeReal d) {
    MDT_CHANGE_BODY(b);
    setDamping(b, 1, d, __func__);
}

BODY_GETTER(MeReal, MdtBodyGetAngularVelocityDamping, 0, (MeReal)b->kea.damping[1])

/* ---- locked axes ---- */

void MEAPI MdtBodySetLockedAxes(const MdtBodyID b, const int axes) {
    MDT_CHANGE_BODY(b);
    if (axes & ~(MdtLockTranslation | MdtLockRotation)) {
        MeWarning(1, "%s: %d is no sum of MdtLockedAxes (at most %d); nothing is changed", __func__, axes,
                  MdtLockTranslation | MdtLockRotation);
        return;
    }
    b->lockedAxes = axes;
    mdt_bodyApplyLocks(b);
}

BODY_GETTER(int, MdtBodyGetLockedAxes, MdtLockNone, b->lockedAxes)

/* ---- gravity factor and speed caps ---- */

void MEAPI MdtBodySetGravityFactor(const MdtBodyID b, const MeReal factor) {
    MDT_CHANGE_BODY(b);
    if (!mdt_isFinite3(__func__, "the factor", factor, factor, factor))
        return;
    if ((double)factor != b->gravityFactor)
        mdt_bodyDisturb(b);
    b->gravityFactor = (double)factor;
}

BODY_GETTER(MeReal, MdtBodyGetGravityFactor, 0, (MeReal)b->gravityFactor)

static void setMaxSpeed(MdtBodyID b, int k, MeReal max, const char *caller) {
    if (!mdt_isNotBelow(caller, "the speed", max, 0))
        return;
    if ((double)max != b->maxSpeed[k])
        mdt_bodyDisturb(b);
    b->maxSpeed[k] = (double)max;
}

void MEAPI MdtBodySetMaxLinearSpeed(const MdtBodyID b, const MeReal max) {
    MDT_CHANGE_BODY(b);
    setMaxSpeed(b, 0, max, __func__);
}

BODY_GETTER(MeReal, MdtBodyGetMaxLinearSpeed, 0, (MeReal)b->maxSpeed[0])

void MEAPI MdtBodySetMaxAngularSpeed(const MdtBodyID b, const MeReal max) {
    MDT_CHANGE_BODY(b);
    setMaxSpeed(b, 1, max, __func__);
}

BODY_GETTER(MeReal, MdtBodyGetMaxAngularSpeed, 0, (MeReal)b->maxSpeed[1])

/* Angular momentum is linear in the angular velocity: one factor scales both. */
void mdt_bodyCapSpeeds(MdtBodyID b) {
    const double *max = b->maxSpeed, square[2] = {keaDot(b->kea.velocity, b->kea.velocity), keaDot(b->spin, b->spin)};
    if (square[0] <= max[0] * max[0] && square[1] <= max[1] * max[1])
        return;
    if (square[0] > max[0] * max[0])
        keaScale(b->kea.velocity, max[0] / sqrt(square[0]), b->kea.velocity);
    if (square[1] > max[1] * max[1])
        keaScale(b->kea.angularMomentum, max[1] / sqrt(square[1]), b->kea.angularMomentum);
    mdt_bodyShow(b);
}

void MEAPI MdtBodySetFastSpinAxis(const MdtBodyID b, const MeReal x, const MeReal y, const MeReal z) {
    MDT_CHANGE_BODY(b);
    if (!mdt_isFinite3(__func__, "the axis", x, y, z))
        return;
    const double axis[3] = {x, y, z}, length = keaLength(axis);
    if (!mdt_isPositive(__func__, "the axis' length", (MeReal)length))
        return;
    for (int i = 0; i < 3; i++)
        b->fastSpinAxis[i] = (MeReal)(axis[i] / length);
    setKeaFlag(b, MdtKeaBodyFlagUseFastSpin, METRUE);
}

void MEAPI MdtBodyGetFastSpinAxis(const MdtBodyID b, MeVector3 v) {
    if (!mdt_isResult(__func__, v, 3) || !mdt_isBody(b, __func__))
        return;
    memcpy(v, b->fastSpinAxis, sizeof b->fastSpinAxis);
}

void MEAPI MdtBodySetNoFastSpinAxis(const MdtBodyID b) {
    MDT_CHANGE_BODY(b);
    setNoFastSpinAxis(b);
}

/* ---- bookkeeping ---- */

BODY_GETTER(MdtWorldID, MdtBodyGetWorld, NULL, b->world)

void MEAPI MdtBodySetUserData(const MdtBodyID b, void *d) {
    MDT_NEED_BODY(b, );
    b->userData = d;
}

void MEAPI MdtBodySetModel(const MdtBodyID b, void *model) {
    MDT_NEED_BODY(b, );
    if (mdt_userOf(b) && model != b->model)
        MeWarning(1, "%s: the body has models of its own; see McdModelSetBody; nothing is changed", __func__);
    else
        b->model = model;
}

BODY_GETTER(MeBool, MdtBodyHasUser, MEFALSE, mdt_userOf(b) != NULL)

void MEAPI MdtBodySetUser(const MdtBodyID b, void *model, const MdtBodyUser *user) {
    MDT_NEED_BODY(b, );
    b->model = model;
    b->record.flags = user ? b->record.flags | MDT_MODELLED : b->record.flags & ~MDT_MODELLED;
    b->world->bodyUser = user ? user : b->world->bodyUser;
}

BODY_GETTER(void *, MdtBodyGetModel, NULL, b->model)

BODY_GETTER(void *, MdtBodyGetUserData, NULL, b->userData)

static void MEAPI applyDeferredSortKey(const MeLater *later) {
    if (mdt_deferredBody(later))
        MdtBodySetSortKey(later->object, (MeI32)later->number);
}

void MEAPI MdtBodySetSortKey(const MdtBodyID b, const MeI32 key) {
    MDT_NEED_BODY(b, );
    if (!mdt_isSortKey(__func__, key))
        return;
    const MeLater later = {.carryOut = applyDeferredSortKey, .object = b, .serial = b->link.serial, .number = key};
    if (mdt_deferIfGuarded(b->world, MDT_GUARD_GRAPH, __func__, &later) != MeWhenNow)
        return;
    mdt_listSetKey(&b->world->bodies, &b->link, key);
    mdt_graphChanged(b->world);
}

BODY_GETTER(MeI32, MdtBodyGetSortKey, 0, b->link.sortKey)

int MEAPI MdtBodyGetPartitionSize(const MdtBodyID b) {
    if (!mdt_isAnyBody(b, __func__))
        return 0;
    const int p = b->partition;
    return p >= 0 && p < b->world->numPartitions ? b->world->bodyStart[p + 1] - b->world->bodyStart[p] : 0;
}

BODY_GETTER(int, MdtBodyGetPartition, -1, b->partition)

void MEAPI MdtBodySetSafeTime(const MdtBodyID b, const MeReal t) {
    MDT_NEED_BODY(b, );
    if (mdt_isNotBelow(__func__, "the safe time", t, 0))
        b->safeTime = t;
}

BODY_GETTER(MeReal, MdtBodyGetLag, 0, (MeReal)b->lag)

BODY_GETTER(MeReal, MdtBodyGetPart, 0, (MeReal)b->lastAdvance)

BODY_GETTER(MeReal, MdtBodyGetSafeTime, 0, b->safeTime)

void MEAPI MdtBodyLog(const MdtBodyID b) {
    MDT_NEED_BODY(b, );
    MeVector4 q;
    MeVector3 v, w;
    MdtBodyGetQuaternion(b, q);
    MdtBodyGetLinearVelocity(b, v);
    MdtBodyGetAngularVelocity(b, w);
    const MeReal *p = b->transform[3];
    MeLog(0, "body %lu: %s, mass %g, sort key %d", b->link.serial, MdtBodyIsEnabled(b) ? "enabled" : "disabled",
          b->mass, b->link.sortKey);
    MeLog(0, "  position (%g, %g, %g)", (double)p[0], (double)p[1], (double)p[2]);
    MeLog(0, "  quaternion (%g, %g, %g, %g)", (double)q[0], (double)q[1], (double)q[2], (double)q[3]);
    MeLog(0, "  velocity (%g, %g, %g)", (double)v[0], (double)v[1], (double)v[2]);
    MeLog(0, "  angular velocity (%g, %g, %g)", (double)w[0], (double)w[1], (double)w[2]);
}

MdtBodyID MEAPI MdtBodyGetFirst(const MdtWorldID w) {
    MDT_NEED_WORLD(w, NULL);
    mdt_listSort(&w->bodies);
    return w->bodies.first ? mdt_linkOwner(w->bodies.first) : NULL;
}

BODY_GETTER(MdtBodyID, MdtBodyGetNext, NULL, b->link.next ? mdt_linkOwner(b->link.next) : NULL)

/* ---- the body's constraints ---- */

static MdtConstraintID firstConstraint(MdtBodyID b) {
    return b->attachments ? mdt_constraintPublicHandle(mdt_attachmentOwner(b->attachments)) : NULL;
}

MdtConstraintID MEAPI MdtBodyGetFirstConstraint(MdtBodyID b) {
    MDT_NEED_BODY(b, NULL);
    return firstConstraint(b);
}

MdtConstraintID MEAPI MdtBodyGetNextConstraint(MdtBodyID b, MdtConstraintID c) {
    MDT_NEED_BODY(b, NULL);
    MDT_NEED_CONSTRAINT(c, NULL);
    return mdt_constraintNextOfBody(b, c);
}

static MdtContactID findContactFrom(MdtBodyID b, MdtConstraintID c) {
    while (c && mdt_constraintType(c) != MdtBclCONTACT)
        c = mdt_constraintNextOfBody(b, c);
    return (MdtContactID)c;
}

MdtContactID MEAPI MdtBodyGetFirstContact(MdtBodyID b) {
    MDT_NEED_BODY(b, NULL);
    return findContactFrom(b, firstConstraint(b));
}

MdtContactID MEAPI MdtBodyGetNextContact(MdtBodyID b, MdtContactID c) {
    MDT_NEED_BODY(b, NULL);
    MDT_NEED_CONSTRAINT((MdtConstraintID)c, NULL);
    return findContactFrom(b, mdt_constraintNextOfBody(b, (MdtConstraintID)c));
}

/* A constraint that the callback attaches is put at the head of the list, which has been visited already. */
void MEAPI MdtBodyForAllConstraints(const MdtBodyID b, MdtConstraintIteratorCBPtr cb, void *ccbdata) {
    MDT_NEED_BODY(b, );
    if (!mdt_isPointer(__func__, "the callback", (const void *)(size_t)cb))
        return;
    MdtWorldID w = b->world;
    MeStageBegin(&w->stage, MDT_GUARD_CONSTRAINTS);
    const MeProgramCall before = MeProgramEnter(__func__);
    for (MdtAttachment *at = b->attachments; at; at = at->next)
        mdt_constraintVisit(mdt_attachmentOwner(at), cb, ccbdata);
    MeProgramLeave(&before);
    MeStageEnd(&w->stage, MDT_GUARD_CONSTRAINTS);
}

/* ---- for all constraints of a body, or its contacts ---- */

/* Destroys or disables the constraints now or, if a stage of the world guards them, when it ends. Calls that the
 * program's handlers make meanwhile are deferred. */
static void removeConstraints(MdtBodyID b, MeBool contactsOnly, MeBool isToDestroy, const char *caller) {
    MdtWorldID w = b->world;
    const MeWhen when = MeStageWhen(&w->stage, isToDestroy ? MDT_GUARD_CONSTRAINTS : MDT_GUARD_GRAPH, caller);
    if (when == MeWhenNever)
        return;
    MeStageBegin(&w->stage, MDT_GUARD_GRAPH);
    for (MdtAttachment *at = b->attachments, *next; at; at = next) {
        const MdtConstraintID c = mdt_attachmentOwner(at), handle = mdt_constraintPublicHandle(c);
        next = at->next;
        if ((contactsOnly && mdt_isJoint(c)) || mdt_constraintIsCondemned(handle))
            continue;
        if (isToDestroy)
            when == MeWhenNow ? mdt_constraintRemove(handle) : mdt_constraintDestroy(handle, caller);
        else
            when == MeWhenNow ? mdt_constraintDeactivate(c) : mdt_constraintDisable(handle, caller);
    }
    MeStageEnd(&w->stage, MDT_GUARD_GRAPH);
}

void MEAPI MdtBodyDestroyConstraints(const MdtBodyID b) {
    MDT_NEED_BODY(b, );
    removeConstraints(b, MEFALSE, METRUE, __func__);
}

void MEAPI MdtBodyDestroyContacts(const MdtBodyID b) {
    MDT_NEED_BODY(b, );
    removeConstraints(b, METRUE, METRUE, __func__);
}

void MEAPI MdtBodyDisableConstraints(const MdtBodyID b) {
    MDT_NEED_BODY(b, );
    removeConstraints(b, MEFALSE, MEFALSE, __func__);
}

void MEAPI MdtBodyDisableContacts(const MdtBodyID b) {
    MDT_NEED_BODY(b, );
    removeConstraints(b, METRUE, MEFALSE, __func__);
}
