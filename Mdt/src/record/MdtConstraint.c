/* Functions of all constraints: bodies, frames, forces of the last step. */
#include "MeAssert.h"
#include "record/mdt_point_i.h"
#include "record/mdt_named_i.h"
#include <string.h>

/* ---- life ---- */

MeBool mdt_constraintCount(MdtWorldID w, const char *caller) {
    if (w->constraintLimit.max != MeNoLimit && w->numConstraints >= w->constraintLimit.max) {
        MeLimitWarn(&w->constraintLimit, caller, "more constraints");
        return MEFALSE;
    }
    w->numConstraints++;
    return METRUE;
}

void mdt_constraintUncount(MdtWorldID w) {
    w->numConstraints--;
    MEASSERT(w->numConstraints >= 0);
}

MdtJoint *mdt_jointCreate(MdtWorldID w, MdtBclJointType type, const char *caller) {
    if (!mdt_isWorld(w, caller) || !mdt_constraintCount(w, caller))
        return NULL;
    MdtJoint *j = mdt_poolGet(&w->jointPool, MDT_JOINT, caller);
    if (!j) {
        mdt_constraintUncount(w);
        return NULL;
    }
    j->base.world = w;
    j->type = MdtBclTypeOf(type);
    j->bcl.type = type;
    j->breakForce = j->breakTorque = MEINFINITY;
    j->base.record.flags = 0;
    w->userConstraints += type == MdtBclUSER;
    w->mimics += type == MdtBclMIMIC;
    j->type->reset(&j->bcl);
    MEASSERT(j->bcl.type == type && j->type->maxRows <= MdtBclGETMAXROWS);
    mdt_listAppend(&w->constraints, &j->base.link, w->nextSerial++);
    return j;
}

void mdt_jointFree(MdtJoint *j) {
    if (j->bcl.type == MdtBclUSER)
        MeMemoryGive(j->bcl.of.user.rows);
}

void mdt_constraintTerm(MdtConstraintID c) {
    mdt_constraintDeactivate(c);
    mdt_constraintDetach(c, 0);
    mdt_constraintDetach(c, 1);
    MEASSERT(!c->side[0].body && !c->side[1].body && !(c->record.flags & MDT_ENABLED));
    mdt_listRemove(&c->world->constraints, &c->link);
    mdt_graphChanged(c->world);
}

static void termJoint(MdtJoint *j) {
    mdt_constraintTerm(&j->base);
    mdt_jointFree(j);
    mdt_breakForget(j);
    mdt_noCollideForget(j);
    mdt_mimicForget(j);
    j->base.world->userConstraints -= j->bcl.type == MdtBclUSER;
    MEASSERT(j->base.world->userConstraints >= 0);
    mdt_constraintUncount(j->base.world);
    mdt_poolPut(&j->base.world->jointPool, j);
}

static MdtManifold *manifoldOf(MdtConstraintID c) {
    return mdt_isPoint(c) ? mdt_manifoldOf(mdt_asPoint(c)) : mdt_isManifold(c) ? (MdtManifold *)(void *)c : NULL;
}

/* The record that is attached to the bodies; of a contact, its manifold. */
static MdtConstraintID baseOf(MdtConstraintID c) {
    return mdt_isPoint(c) ? &mdt_manifoldOf(mdt_asPoint(c))->base : c;
}

static MeBool isGroupMember(MdtConstraintID c) {
    return mdt_isPoint(c) && mdt_isInGroup(mdt_asPoint(c));
}

MdtBclJointType mdt_constraintType(const MdtBaseConstraint *c) {
    if (mdt_isJoint(c))
        return ((const MdtJoint *)(const void *)c)->bcl.type;
    return mdt_isManifold(c) && !(c->record.flags & MDT_LONE) ? MdtBclCONTACTGROUP : MdtBclCONTACT;
}

static MeBool isOfType(MdtConstraintID c, MdtBclJointType type, const char *caller) {
    if (!mdt_isConstraint(c, caller))
        return MEFALSE;
    if (mdt_constraintType(c) == type)
        return METRUE;
    MeWarning(1, "%s: the constraint is a %s, not a %s", caller, mdt_constraintName(c), MdtBclTypeOf(type)->name);
    return MEFALSE;
}

MdtJoint *mdt_jointOfType(void *handle, MdtBclJointType type, const char *caller) {
    return isOfType(handle, type, caller) ? handle : NULL;
}

MdtPoint *mdt_pointOf(void *contact, const char *caller) {
    return isOfType(contact, MdtBclCONTACT, caller) ? contact : NULL;
}

MdtManifold *mdt_groupOf(void *group, const char *caller) {
    return isOfType(group, MdtBclCONTACTGROUP, caller) ? group : NULL;
}

void *mdt_jointCast(MdtConstraintID c, MdtBclJointType type, const char *caller) {
    return mdt_isConstraint(c, caller) && mdt_constraintType(c) == type ? c : NULL;
}

void mdt_constraintRemove(MdtConstraintID c) {
    if (mdt_isPoint(c))
        mdt_pointTerm(mdt_asPoint(c));
    else if (mdt_isManifold(c))
        mdt_manifoldTerm(manifoldOf(c));
    else
        termJoint(mdt_asJoint(c));
}

/* A contact that is to be destroyed is recognized by its own mark: its record may hold other contacts. */
static void MEAPI applyDeferredDestruction(const MeLater *later) {
    MdtConstraintID c = later->object;
    const MeBool isLive = mdt_isPoint(c) || mdt_deferredConstraint(later);
    if (isLive && mdt_constraintIsCondemned(c))
        mdt_constraintDestroy(c, NULL);
}

/* Marks a constraint to be destroyed when the stage ends. The holder of a group is cleared at once, as it may not live
 * until then. */
static void condemnConstraint(MdtConstraintID c) {
    if (mdt_isPoint(c)) {
        mdt_asPoint(c)->isCondemned = true;
        return;
    }
    c->record.flags |= MDT_CONDEMNED;
    if (mdt_isManifold(c) && manifoldOf(c)->holder)
        *manifoldOf(c)->holder = NULL;
    if (mdt_isManifold(c))
        manifoldOf(c)->holder = NULL;
}

/* caller: null for a deferred destruction. */
void mdt_constraintDestroy(MdtConstraintID c, const char *caller) {
    if (caller && !mdt_isConstraint(c, caller))
        return;
    if (caller && mdt_constraintIsCondemned(c)) {
        mdt_warnGone(caller, "constraint");
        return;
    }
    const MeLater later = {.carryOut = applyDeferredDestruction, .object = c, .serial = baseOf(c)->link.serial};
    const MeWhen when =
        mdt_deferIfGuarded(baseOf(c)->world, MDT_GUARD_CONSTRAINTS, caller ? caller : "MdtConstraintDestroy", &later);
    if (when == MeWhenNow)
        mdt_constraintRemove(c);
    else if (when == MeWhenStageEnds)
        condemnConstraint(c);
}

void mdt_constraintClearWarmStart(MdtConstraintID c) {
    if (mdt_isJoint(c)) {
        mdt_asJoint(c)->numWarm = 0;
        mdt_asJoint(c)->gap = mdt_asJoint(c)->gapBefore = HUGE_VAL;
    } else {
        mdt_manifoldClearWarmStart(manifoldOf(c));
    }
}

static void activateConstraint(MdtConstraintID c) {
    if (c->record.flags & MDT_ENABLED)
        return;
    MEASSERT(c->side[0].body || c->side[1].body);
    c->record.flags |= MDT_ENABLED;
    mdt_graphChanged(c->world);
    mdt_constraintClearWarmStart(c);
    mdt_constraintDisturb(c);
    c->world->enabledConstraints++;
    MEASSERT(c->world->enabledConstraints <= c->world->constraints.count);
    if (mdt_isJoint(c)) {
        c->world->enabledJoints++;
        c->record.flags |= MDT_WAS_ENABLED;
    }
}

void mdt_constraintDeactivate(MdtConstraintID c) {
    if (!(c->record.flags & MDT_ENABLED))
        return;
    mdt_constraintDisturb(c);
    c->record.flags &= ~MDT_ENABLED;
    mdt_graphChanged(c->world);
    c->world->enabledConstraints--;
    c->world->enabledJoints -= mdt_isJoint(c) != 0;
    MEASSERT(c->world->enabledConstraints >= c->world->enabledJoints && c->world->enabledJoints >= 0);
    for (int k = 0; k < 2; k++) /* the body may be resting on it */
        if (c->side[k].body && (c->side[k].body->record.flags & (MDT_ASLEEP | MDT_CONDEMNED)) == MDT_ASLEEP)
            mdt_bodyEnable(c->side[k].body);
}

static MeBool isAttached(const MdtBaseConstraint *c) {
    return c->side[0].body || c->side[1].body;
}

static void MEAPI applyDeferredEnabling(const MeLater *later) {
    const MdtConstraintID c = mdt_deferredConstraint(later);
    if (c && later->number && isAttached(c))
        activateConstraint(c);
    else if (c && !later->number)
        mdt_constraintDeactivate(c);
}

static MeBool mayEnableNow(MdtConstraintID c, MeBool isEnabled, const char *caller) {
    const MeLater later = {
        .carryOut = applyDeferredEnabling, .object = c, .serial = c->link.serial, .number = (long)isEnabled};
    return mdt_deferIfGuarded(c->world, MDT_GUARD_GRAPH, caller, &later) == MeWhenNow;
}

void mdt_constraintEnable(MdtConstraintID handle, const char *caller) {
    if (!mdt_isConstraint(handle, caller) || isGroupMember(handle))
        return;
    const MdtConstraintID c = baseOf(handle);
    if (!isAttached(c)) {
        MeWarning(1, "%s: the %s is attached to no body; it stays disabled", caller, mdt_constraintName(c));
        return;
    }
    if (mayEnableNow(c, METRUE, caller))
        activateConstraint(c);
}

void mdt_constraintDisable(MdtConstraintID handle, const char *caller) {
    if (!mdt_isConstraint(handle, caller) || isGroupMember(handle))
        return;
    if (mayEnableNow(baseOf(handle), MEFALSE, caller))
        mdt_constraintDeactivate(baseOf(handle));
}

MeBool mdt_constraintIsEnabled(MdtConstraintID c, const char *caller) {
    if (!mdt_isConstraint(c, caller))
        return MEFALSE;
    return (baseOf(c)->record.flags & MDT_ENABLED) != 0;
}

/* ---- attachment ---- */

void mdt_constraintDetach(MdtConstraintID c, int side) {
    MdtAttachment *at = &c->side[side];
    if (!at->body)
        return;
    mdt_constraintDisturb(c);
    MEASSERT(at->previous ? at->previous->next == at : at->body->attachments == at);
    MEASSERT(!at->next || at->next->previous == at);
    if (at->previous)
        at->previous->next = at->next;
    else
        at->body->attachments = at->next;
    if (at->next)
        at->next->previous = at->previous;
    at->body->manifolds -= !mdt_isJoint(c);
    MEASSERT(at->body->manifolds >= 0);
    at->body = NULL;
    at->next = at->previous = NULL;
}

static void attachSide(MdtConstraintID c, int side, MdtBodyID b) {
    MdtAttachment *at = &c->side[side];
    mdt_constraintDetach(c, side);
    at->body = b;
    if (!b)
        return;
    MEASSERT(!at->next && !at->previous && mdt_attachmentOwner(at) == c && b->world == c->world);
    at->next = b->attachments;
    if (at->next)
        at->next->previous = at;
    b->attachments = at;
    b->manifolds += !mdt_isJoint(c);
    b->record.flags |= c->record.flags & (MDT_WATCHED | MDT_TOUCHED | MDT_NO_COLLIDE);
    mdt_graphChanged(c->world);
    mdt_constraintDisturb(c);
    MEVALIDATE(mdt_attachmentsAreLinked(b));
}

void mdt_constraintMarkWatched(MdtConstraintID c) {
    c->record.flags |= MDT_WATCHED;
    for (int k = 0; k < 2; k++)
        if (c->side[k].body)
            c->side[k].body->record.flags |= MDT_WATCHED;
}

static MeBool mayAttach(MdtConstraintID c, MdtBodyID b, const char *caller) {
    if (!b)
        return METRUE;
    if (!mdt_isBody(b, caller))
        return MEFALSE;
    if (b->world == c->world)
        return METRUE;
    MeWarning(1, "%s: the body belongs to another world; nothing is changed", caller);
    return MEFALSE;
}

/* Poses in the form that the functions of Bcl's joint types take. */
typedef struct {
    MdtKeaTransformation of[2];
    const MdtKeaTransformation *at[2];
} Poses;

static void copyPoses(MdtConstraintID c, Poses *poses) {
    mdt_constraintPoses(c, poses->of);
    poses->at[0] = &poses->of[0];
    poses->at[1] = &poses->of[1];
}

/* Notifies the joint's type of a new position; isAttached: of new bodies first. */
static void notifyPositioned(MdtJoint *j, MeBool isAttached) {
    Poses poses;
    copyPoses(&j->base, &poses);
    if (isAttached && j->type->attached)
        j->type->attached(&j->bcl, poses.at);
    if (j->type->positioned)
        j->type->positioned(&j->bcl, poses.at);
}

static void notifyAxesSet(MdtJoint *j, const MdtBclFrame before[2]) {
    Poses poses;
    copyPoses(&j->base, &poses);
    if (j->type->axesSet)
        j->type->axesSet(&j->bcl, before, poses.at);
}

void mdt_constraintAttach(MdtConstraintID c, MdtBodyID b0, MdtBodyID b1) {
    MEASSERT(!b0 || b0 != b1);
    attachSide(c, 0, b0);
    attachSide(c, 1, b1);
    mdt_constraintClearWarmStart(c);
    if (mdt_isJoint(c))
        notifyPositioned(mdt_asJoint(c), METRUE);
}

/* In a group with the world the first side is the body. */
static void attachGroup(MdtConstraintID c, MdtBodyID b1, MdtBodyID b2) {
    c->record.flags = b1 ? c->record.flags & ~MDT_SWAPPED : c->record.flags | MDT_SWAPPED;
    mdt_constraintAttach(c, b1 ? b1 : b2, b1 ? b2 : NULL);
}

/* Does nothing if one of the bodies has been destroyed meanwhile. */
static void MEAPI applyDeferredAttachment(const MeLater *later) {
    const MdtConstraintID c = mdt_deferredConstraint(later);
    for (int k = 0; k < 2; k++)
        if (later->other[k] && !MeHandleIsLive(later->other[k], MDT_BODY))
            return;
    if (c)
        mdt_constraintSetBodies(mdt_constraintPublicHandle(c), later->other[0], later->other[1],
                                "MdtConstraintSetBodies");
}

void mdt_constraintSetBodies(MdtConstraintID c, MdtBodyID b1, MdtBodyID b2, const char *caller) {
    if (!mdt_isConstraint(c, caller))
        return;
    const MdtConstraintID base = baseOf(c);
    if (!mayAttach(base, b1, caller) || !mayAttach(base, b2, caller))
        return;
    if (b1 == b2) {
        MeWarning(1, "%s: %s; nothing is changed", caller, b1 ? "the two bodies are the same" : "both bodies are null");
        return;
    }
    if (isGroupMember(c)) {
        MeWarning(1, "%s: the contact belongs to a group, whose bodies it has; nothing is changed", caller);
        return;
    }
    if (base->record.flags & MDT_BRIDGED) {
        MeWarning(1, "%s: the group was made by a bridge, for two models that touch; nothing is changed", caller);
        return;
    }
    const MeLater later = {
        .carryOut = applyDeferredAttachment, .object = base, .other = {b1, b2}, .serial = base->link.serial};
    if (isAttached(base) && mdt_deferIfGuarded(base->world, MDT_GUARD_CONSTRAINTS, caller, &later) != MeWhenNow)
        return;
    if (base->record.flags & MDT_ENABLED)
        MeWarning(1, "%s: the %s is enabled; disable it before changing its bodies", caller, mdt_constraintName(c));
    if (mdt_isManifold(c))
        attachGroup(c, b1, b2);
    else
        mdt_constraintAttach(base, b1, b2);
}

MeBool mdt_isSide(const char *caller, unsigned int bodyindex) {
    if (bodyindex < 2)
        return METRUE;
    MeWarning(1, "%s: the body index is %u, it must be 0 or 1", caller, bodyindex);
    return MEFALSE;
}

MdtBodyID mdt_constraintGetBody(MdtConstraintID c, unsigned int bodyindex, const char *caller) {
    if (!mdt_isConstraint(c, caller))
        return NULL;
    const MdtBodyID b = mdt_isSide(caller, bodyindex) ? baseOf(c)->side[bodyindex].body : NULL;
    return b && !(b->mover && b->mover->isHidden) ? b : NULL;
}

/* ---- frames: in the coordinates of the body's centre of mass, or the world's ---- */

static void poseOfKea(const MdtKeaBody *b, MdtKeaTransformation *pose) {
    keaCopy(pose->pos, b->position);
    keaQuaternionToMatrix(pose->R, b->quaternion);
}

static void poseOf(MdtConstraintID c, int side, MdtKeaTransformation *pose) {
    MdtBodyID b = c->side[side].body;
    *pose = MdtBclWorldPose;
    if (b)
        poseOfKea(&b->kea, pose);
}

void mdt_constraintPoses(MdtConstraintID c, MdtKeaTransformation pose[2]) {
    poseOf(c, 0, &pose[0]);
    poseOf(c, 1, &pose[1]);
}

/* Transforms a frame; it stays where it is in the world. */
static void reframe(MdtBclFrame *frame, const MdtKeaTransformation *from, const MdtKeaTransformation *to) {
    double world[3];
    keaApply(world, from->R, frame->position);
    keaAddScaled(world, 1, from->pos);
    keaSubtract(world, world, to->pos);
    keaApplyTransposed(frame->position, to->R, world);
    double *axes[] = {frame->primary, frame->ortho};
    for (int i = 0; i < 2; i++) {
        keaApply(world, from->R, axes[i]);
        keaApplyTransposed(axes[i], to->R, world);
    }
}

void mdt_constraintReframe(MdtConstraintID c, int side, const MdtKeaBody *before, const MdtKeaBody *after) {
    if (!mdt_isJoint(c))
        return; /* contacts are stored in world coordinates */
    MdtBclConstraint *bcl = &mdt_asJoint(c)->bcl;
    MdtKeaTransformation from, to;
    poseOfKea(before, &from);
    poseOfKea(after, &to);
    reframe(&bcl->frame[side], &from, &to);
    for (int i = 0; bcl->type == MdtBclGEAR && i < 2; i++)
        if (bcl->of.coupling.coordinate[i].side[1] == side)
            reframe(&bcl->of.coupling.coordinate[i].frame[1], &from, &to);
}

static void pointToBody(MdtConstraintID c, int side, const double world[3], double local[3]) {
    MdtKeaTransformation pose;
    double arm[3];
    poseOf(c, side, &pose);
    keaSubtract(arm, world, pose.pos);
    keaApplyTransposed(local, (const double(*)[3])pose.R, arm);
}

static void pointToWorld(MdtConstraintID c, int side, const double local[3], double world[3]) {
    MdtKeaTransformation pose;
    poseOf(c, side, &pose);
    keaApply(world, (const double(*)[3])pose.R, local);
    keaAddScaled(world, 1, pose.pos);
}

static void rotateToBody(MdtConstraintID c, int side, const double world[3], double local[3]) {
    MdtKeaTransformation pose;
    poseOf(c, side, &pose);
    keaApplyTransposed(local, (const double(*)[3])pose.R, world);
}

static void rotateToWorld(MdtConstraintID c, int side, const double local[3], double world[3]) {
    MdtKeaTransformation pose;
    poseOf(c, side, &pose);
    keaApply(world, (const double(*)[3])pose.R, local);
}

/* The side whose frame stands for the whole constraint: the first one with a body. */
static int firstAttachedSide(MdtConstraintID c) {
    return c->side[0].body ? 0 : 1;
}

/* The constraint as a joint, for access to its frames; null, with a warning, for a contact or a bad handle. */
static MdtJoint *checkJoint(MdtConstraintID c, const char *caller) {
    if (!mdt_isConstraint(c, caller))
        return NULL;
    if (!mdt_isJoint(c))
        MeWarning(1, "%s: a contact has no frames in its bodies; see MdtContact.h", caller);
    return mdt_asJoint(c);
}

static void setPosition(MdtJoint *j, unsigned int side, const double world[3]) {
    pointToBody(&j->base, (int)side, world, j->bcl.frame[side].position);
    notifyPositioned(j, MEFALSE);
}

void mdt_constraintSetPosition(MdtConstraintID c, MeReal x, MeReal y, MeReal z, const char *caller) {
    MdtJoint *j = checkJoint(c, caller);
    if (!j || !mdt_isPositionValid(caller, "the position", c->world, x, y, z))
        return;
    const double world[3] = {x, y, z};
    setPosition(j, 0, world);
    setPosition(j, 1, world);
}

void mdt_constraintGetPosition(MdtConstraintID c, MeVector3 p, const char *caller) {
    if (!mdt_isResult(caller, p, 3) || !mdt_isConstraint(c, caller))
        return;
    mdt_constraintBodyGetPosition(c, (unsigned int)firstAttachedSide(baseOf(c)), p, caller);
}

void mdt_constraintBodySetPosition(MdtConstraintID c, unsigned int bodyindex, MeReal x, MeReal y, MeReal z,
                                   const char *caller) {
    MdtJoint *j = checkJoint(c, caller);
    if (!j || !mdt_isSide(caller, bodyindex) || !mdt_isPositionValid(caller, "the position", c->world, x, y, z))
        return;
    const double world[3] = {x, y, z};
    setPosition(j, bodyindex, world);
}

void mdt_constraintBodyGetPosition(MdtConstraintID c, unsigned int bodyindex, MeVector3 p, const char *caller) {
    if (!mdt_isResult(caller, p, 3))
        return;
    MdtJoint *j = checkJoint(c, caller);
    if (!j || !mdt_isSide(caller, bodyindex))
        return;
    double world[3];
    pointToWorld(c, (int)bodyindex, j->bcl.frame[bodyindex].position, world);
    mdt_toReal(p, world);
}

void MEAPI MdtConstraintBodySetPositionRel(const MdtConstraintID c, const unsigned int bodyindex, const MeReal x,
                                           const MeReal y, const MeReal z) {
    MdtJoint *j = checkJoint(c, __func__);
    if (!j || !mdt_isSide(__func__, bodyindex) || !mdt_isPositionValid(__func__, "the position", c->world, x, y, z))
        return;
    const double local[3] = {x, y, z};
    keaCopy(j->bcl.frame[bodyindex].position, local);
    notifyPositioned(j, MEFALSE);
}

void MEAPI MdtConstraintBodyGetPositionRel(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p) {
    if (!mdt_isResult(__func__, p, 3))
        return;
    MdtJoint *j = checkJoint(c, __func__);
    if (j && mdt_isSide(__func__, bodyindex))
        mdt_toReal(p, j->bcl.frame[bodyindex].position);
}

MeBool mdt_makeAxes(const char *caller, double p[3], double o[3]) {
    const double size = keaLength(p);
    if (size > 0 && isfinite(size)) {
        keaScale(p, 1 / size, p);
        const double before = keaLength(o);
        keaAddScaled(o, -keaDot(o, p), p);
        const double across = keaLength(o);
        if (across > 1e-6 * before && isfinite(across)) {
            keaScale(o, 1 / across, o);
            return METRUE;
        }
    }
    MeWarning(1, "%s: an axis is zero or not finite, or the two are parallel; nothing is changed", caller);
    return MEFALSE;
}

/* Crosses p with the unit vector of its smallest component. */
void mdt_chooseOrthogonal(const double p[3], double o[3]) {
    const double a[3] = {fabs(p[0]), fabs(p[1]), fabs(p[2])};
    const int min = a[0] <= a[1] && a[0] <= a[2] ? 0 : a[1] <= a[2] ? 1 : 2;
    double unit[3] = {0, 0, 0};
    unit[min] = 1;
    keaCross(o, p, unit);
}

static void setAxesOf(MdtJoint *j, int side, const double p[3], const double o[3]) {
    rotateToBody(&j->base, side, p, j->bcl.frame[side].primary);
    rotateToBody(&j->base, side, o, j->bcl.frame[side].ortho);
}

static void setBothAxes(MdtJoint *j, const double p[3], const double o[3]) {
    const MdtBclFrame before[2] = {j->bcl.frame[0], j->bcl.frame[1]};
    setAxesOf(j, 0, p, o);
    setAxesOf(j, 1, p, o);
    notifyAxesSet(j, before);
}

void mdt_constraintSetAxis(MdtConstraintID c, MeReal px, MeReal py, MeReal pz, const char *caller) {
    MdtJoint *j = checkJoint(c, caller);
    double p[3] = {px, py, pz}, o[3];
    mdt_chooseOrthogonal(p, o);
    if (!j || !mdt_makeAxes(caller, p, o))
        return;
    setBothAxes(j, p, o);
}

void mdt_constraintSetAxes(MdtConstraintID c, MeReal px, MeReal py, MeReal pz, MeReal ox, MeReal oy, MeReal oz,
                           const char *caller) {
    MdtJoint *j = checkJoint(c, caller);
    double p[3] = {px, py, pz}, o[3] = {ox, oy, oz};
    if (!j || !mdt_makeAxes(caller, p, o))
        return;
    setBothAxes(j, p, o);
}

void mdt_constraintBodySetAxes(MdtConstraintID c, unsigned int bodyindex, MeReal px, MeReal py, MeReal pz, MeReal ox,
                               MeReal oy, MeReal oz, const char *caller) {
    MdtJoint *j = checkJoint(c, caller);
    double p[3] = {px, py, pz}, o[3] = {ox, oy, oz};
    if (j && mdt_isSide(caller, bodyindex) && mdt_makeAxes(caller, p, o))
        setAxesOf(j, (int)bodyindex, p, o);
}

void mdt_constraintBodySetAxesRel(MdtConstraintID c, unsigned int bodyindex, MeReal px, MeReal py, MeReal pz, MeReal ox,
                                  MeReal oy, MeReal oz, const char *caller) {
    MdtJoint *j = checkJoint(c, caller);
    double p[3] = {px, py, pz}, o[3] = {ox, oy, oz};
    if (!j || !mdt_isSide(caller, bodyindex) || !mdt_makeAxes(caller, p, o))
        return;
    keaCopy(j->bcl.frame[bodyindex].primary, p);
    keaCopy(j->bcl.frame[bodyindex].ortho, o);
}

static void setCrossFrame(MdtJoint *j, int side, const double own[3], const double second[3]) {
    setAxesOf(j, side, side == 0 ? own : second, side == 0 ? second : own);
}

/* Makes the second axis of each side from the other side's axis, orthogonalized, in the bodies' present poses: angles
 * are measured from it. If both axes are parallel, as before the other one is set, the second axis is arbitrary. */
void mdt_constraintSetCrossAxis(MdtConstraintID c, const char *caller, int side, MeReal x, MeReal y, MeReal z) {
    MdtJoint *j = mdt_asJoint(c);
    double axis[3] = {x, y, z}, other[3], second[3], back[3];
    rotateToWorld(c, 1 - side, side == 0 ? j->bcl.frame[1].ortho : j->bcl.frame[0].primary, other);
    const MeBool isParallel = fabs(keaDot(axis, other)) > 0.999 * keaLength(axis);
    keaCopy(second, other);
    if (isParallel)
        mdt_chooseOrthogonal(axis, second);
    if (!mdt_makeAxes(caller, axis, second))
        return;
    setCrossFrame(j, side, axis, second);
    keaCopy(back, axis);
    if (!isParallel && mdt_makeAxes(caller, other, back))
        setCrossFrame(j, 1 - side, other, back);
}

static void zeroAxes(MeVector3 p, MeVector3 o) {
    for (int i = 0; i < 3; i++) {
        if (p)
            p[i] = 0;
        if (o)
            o[i] = 0;
    }
}

/* Reads a frame's axes in world coordinates; either result may be null. */
static void getAxes(MdtJoint *j, int side, MeVector3 p, MeVector3 o) {
    double axis[3];
    if (p) {
        rotateToWorld(&j->base, side, j->bcl.frame[side].primary, axis);
        mdt_toReal(p, axis);
    }
    if (o) {
        rotateToWorld(&j->base, side, j->bcl.frame[side].ortho, axis);
        mdt_toReal(o, axis);
    }
}

void mdt_constraintGetAxes(MdtConstraintID c, MeVector3 p, MeVector3 o, const char *caller) {
    zeroAxes(p, o);
    MdtJoint *j = checkJoint(c, caller);
    if (j)
        getAxes(j, firstAttachedSide(c), p, o);
}

void mdt_constraintBodyGetAxes(MdtConstraintID c, unsigned int bodyindex, MeVector3 p, MeVector3 o,
                               const char *caller) {
    zeroAxes(p, o);
    MdtJoint *j = checkJoint(c, caller);
    if (j && mdt_isSide(caller, bodyindex))
        getAxes(j, (int)bodyindex, p, o);
}

void MEAPI MdtConstraintBodyGetAxesRel(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p,
                                       MeVector3 o) {
    zeroAxes(p, o);
    MdtJoint *j = checkJoint(c, __func__);
    if (!j || !mdt_isSide(__func__, bodyindex))
        return;
    if (p)
        mdt_toReal(p, j->bcl.frame[bodyindex].primary);
    if (o)
        mdt_toReal(o, j->bcl.frame[bodyindex].ortho);
}

/* ---- forces of the last step ---- */

/* Adds a contact's force, at the contact's position, and its moments about the bodies' centres of mass. */
static void addContactForce(const MdtPoint *p, MdtKeaForcePair *sum) {
    const MdtBaseConstraint *base = &mdt_manifoldOf(p)->base;
    double force[3];
    mdt_fromReal(force, p->mean);
    for (int k = 0; k < 2; k++) {
        static const double origin[3] = {0, 0, 0};
        double arm[3], torque[3];
        keaSubtract(arm, p->position, base->side[k].body ? base->side[k].body->start.pose.position : origin);
        keaCross(torque, arm, force);
        keaAddScaled(sum->body[k].lin, k == 0 ? 1 : -1, force);
        keaAddScaled(sum->body[k].ang, k == 0 ? 1 : -1, torque);
    }
}

static MdtKeaForcePair forceOf(MdtConstraintID c) {
    MdtKeaForcePair sum = {{{{0, 0, 0}, {0, 0, 0}}}};
    if (mdt_isJoint(c))
        return mdt_asJoint(c)->force;
    if (mdt_isPoint(c))
        addContactForce(mdt_asPoint(c), &sum);
    else
        for (const MdtPoint *p = mdt_pointFirst(manifoldOf(c)); p; p = mdt_pointAfter(p))
            addContactForce(p, &sum);
    return sum;
}

void mdt_constraintSetForce(MdtConstraintID c, const MdtKeaForcePair *force) {
    if (mdt_isJoint(c))
        mdt_asJoint(c)->force = *force;
    else if (mdt_isPoint(c))
        mdt_toReal(mdt_asPoint(c)->mean, force->body[0].lin);
    mdt_constraintDisturb(baseOf(c)); /* its force no longer is the answer of a step */
}

static void getForce(MdtConstraintID c, unsigned int side, MeBool isTorque, MeVector3 result, const char *caller) {
    if (!mdt_isResult(caller, result, 3) || !mdt_isConstraint(c, caller) || !mdt_isSide(caller, side))
        return;
    const MdtKeaForcePair force = forceOf(c);
    mdt_toReal(result, isTorque ? force.body[side].ang : force.body[side].lin);
}

void mdt_constraintGetForce(MdtConstraintID c, unsigned int bodyindex, MeVector3 f, const char *caller) {
    getForce(c, bodyindex, MEFALSE, f, caller);
}

void mdt_constraintGetTorque(MdtConstraintID c, unsigned int bodyindex, MeVector3 t, const char *caller) {
    getForce(c, bodyindex, METRUE, t, caller);
}

/* Works for manifolds of single contacts, too, which the library passes. */
int MEAPI MdtConstraintGetRowCount(const MdtConstraintID c) {
    int rows = 0;
    MDT_NEED_CONSTRAINT(c, 0);
    if (mdt_isJoint(c))
        return mdt_asJoint(c)->numRows;
    if (mdt_isPoint(c))
        return mdt_asPoint(c)->numRows;
    for (const MdtPoint *p = mdt_pointFirst(manifoldOf(c)); p; p = mdt_pointAfter(p))
        rows += p->numRows;
    return rows;
}

/* ---- a moving world, and bookkeeping ---- */

/* The extra of a contact or a group, created if there is none. Null, with a warning, if there is no memory. */
static MdtExtra *makeExtra(MdtConstraintID c, const char *caller) {
    return mdt_isPoint(c) ? mdt_extraMake(mdt_blockOf(mdt_asPoint(c)), mdt_asPoint(c)->slot, caller)
                          : mdt_extraMake(manifoldOf(c), MDT_GROUP_SLOT, caller);
}

static const MdtExtra *extraOf(MdtConstraintID c) {
    return mdt_isPoint(c) ? mdt_extraOf(mdt_blockOf(mdt_asPoint(c)), mdt_asPoint(c)->slot)
                          : mdt_extraOf(manifoldOf(c), MDT_GROUP_SLOT);
}

/* The world velocity for writing; null, with a warning, if there is no memory. */
static MdtKeaVelocity *makeWorldVelocity(MdtConstraintID c, const char *caller) {
    MdtExtra *extra = mdt_isJoint(c) ? NULL : makeExtra(c, caller);
    return mdt_isJoint(c) ? &mdt_asJoint(c)->worldVelocity : extra ? &extra->worldVelocity : NULL;
}

static const MdtKeaVelocity *worldVelocityOf(MdtConstraintID c) {
    const MdtExtra *extra = mdt_isJoint(c) ? NULL : extraOf(c);
    return mdt_isJoint(c) ? &mdt_asJoint(c)->worldVelocity : extra ? &extra->worldVelocity : &MdtBclWorldVelocity;
}

static void setWorldVelocity(MdtConstraintID c, MeBool isAngular, MeReal x, MeReal y, MeReal z, const char *caller) {
    const double v[3] = {x, y, z};
    if (!mdt_isConstraint(c, caller) || !mdt_isFinite3(caller, "the velocity", x, y, z))
        return;
    MdtKeaVelocity *velocity = makeWorldVelocity(c, caller);
    if (!velocity)
        return;
    double *component = isAngular ? velocity->ang : velocity->lin;
    if (memcmp(component, v, sizeof v) != 0)
        mdt_constraintDisturb(baseOf(c));
    keaCopy(component, v);
}

void MEAPI MdtConstraintSetWorldLinearVelocity(const MdtConstraintID c, const MeReal vx, const MeReal vy,
                                               const MeReal vz) {
    setWorldVelocity(c, MEFALSE, vx, vy, vz, __func__);
}

void MEAPI MdtConstraintSetWorldAngularVelocity(const MdtConstraintID c, const MeReal ax, const MeReal ay,
                                                const MeReal az) {
    setWorldVelocity(c, METRUE, ax, ay, az, __func__);
}

void MEAPI MdtConstraintGetWorldLinearVelocity(const MdtConstraintID c, MeVector3 lv) {
    if (mdt_isResult(__func__, lv, 3) && mdt_isConstraint(c, __func__))
        mdt_toReal(lv, worldVelocityOf(c)->lin);
}

void MEAPI MdtConstraintGetWorldAngularVelocity(const MdtConstraintID c, MeVector3 av) {
    if (mdt_isResult(__func__, av, 3) && mdt_isConstraint(c, __func__))
        mdt_toReal(av, worldVelocityOf(c)->ang);
}

MdtWorldID mdt_constraintGetWorld(MdtConstraintID c, const char *caller) {
    if (!mdt_isConstraint(c, caller))
        return NULL;
    return baseOf(c)->world;
}

void mdt_constraintSetUserData(MdtConstraintID c, void *d, const char *caller) {
    if (!mdt_isConstraint(c, caller))
        return;
    MdtExtra *extra = mdt_isJoint(c) ? NULL : makeExtra(c, caller);
    if (mdt_isJoint(c))
        mdt_asJoint(c)->userData = d;
    else if (extra)
        extra->userData = d;
}

void *mdt_constraintGetUserData(MdtConstraintID c, const char *caller) {
    if (!mdt_isConstraint(c, caller))
        return NULL;
    const MdtExtra *extra = mdt_isJoint(c) ? NULL : extraOf(c);
    return mdt_isJoint(c) ? mdt_asJoint(c)->userData : extra ? extra->userData : NULL;
}

static void MEAPI applyDeferredSortKey(const MeLater *later) {
    const MdtConstraintID c = mdt_deferredConstraint(later);
    if (c)
        mdt_constraintSetSortKey(mdt_constraintPublicHandle(c), (MeI32)later->number, "MdtConstraintSetSortKey");
}

void mdt_constraintSetSortKey(MdtConstraintID c, MeI32 key, const char *caller) {
    if (!mdt_isConstraint(c, caller))
        return;
    if (!mdt_isSortKey(caller, key))
        return;
    if (isGroupMember(c)) {
        MdtExtra *extra = makeExtra(c, caller);
        if (extra)
            extra->sortKey = key;
        return;
    }
    const MdtConstraintID base = baseOf(c);
    const MeLater later = {
        .carryOut = applyDeferredSortKey, .object = base, .serial = base->link.serial, .number = key};
    if (mdt_deferIfGuarded(base->world, MDT_GUARD_CONSTRAINTS, caller, &later) != MeWhenNow)
        return;
    mdt_listSetKey(&base->world->constraints, &base->link, key);
    mdt_graphChanged(base->world);
}

MeI32 mdt_constraintGetSortKey(MdtConstraintID c, const char *caller) {
    if (!mdt_isConstraint(c, caller))
        return 0;
    if (!isGroupMember(c))
        return baseOf(c)->link.sortKey;
    const MdtExtra *extra = extraOf(c);
    return extra ? extra->sortKey : 0;
}

/* ---- iteration ---- */

MdtConstraintID mdt_constraintPublicHandle(MdtConstraintID c) {
    return c->record.flags & MDT_LONE ? (MdtConstraintID)(void *)mdt_pointFirst(manifoldOf(c)) : c;
}

/* The next contact of the same group; of a group, its first contact. */
static MdtConstraintID nextContact(MdtConstraintID c) {
    const MdtPoint *p = mdt_isPoint(c)      ? mdt_pointAfter(mdt_asPoint(c))
                        : mdt_isManifold(c) ? mdt_pointFirst(manifoldOf(c))
                                            : NULL;
    return (MdtConstraintID)(uintptr_t)p;
}

MdtConstraintID mdt_constraintNext(MdtConstraintID c) {
    const MdtConstraintID contact = nextContact(c);
    const MdtLink *next = baseOf(c)->link.next;
    return contact ? contact : next ? mdt_constraintPublicHandle(mdt_linkOwner(next)) : NULL;
}

MdtConstraintID mdt_constraintNextOfBody(MdtBodyID b, MdtConstraintID c) {
    const MdtConstraintID contact = nextContact(c), base = baseOf(c);
    if (contact)
        return contact;
    for (int k = 0; k < 2; k++)
        if (base->side[k].body == b)
            return base->side[k].next ? mdt_constraintPublicHandle(mdt_attachmentOwner(base->side[k].next)) : NULL;
    MeWarning(1, "MdtBodyGetNextConstraint: the constraint is not attached to the body");
    return NULL;
}

/* Of a group, visits the contacts that it had when the callback was called for the group. */
void mdt_constraintVisit(MdtConstraintID base, MdtConstraintIteratorCBPtr cb, void *data) {
    const MeBool isGroup = mdt_isManifold(base) && !(base->record.flags & MDT_LONE);
    const MdtConstraintID shown = mdt_constraintPublicHandle(base);
    unsigned int contacts = isGroup ? manifoldOf(base)->numPoints : 0;
    if (!mdt_constraintIsCondemned(shown))
        cb(shown, data);
    for (MdtPoint *p = contacts > 0 ? mdt_pointFirst(manifoldOf(base)) : NULL; p && contacts > 0; contacts--) {
        if (!p->isCondemned && !(base->record.flags & MDT_CONDEMNED))
            cb((MdtConstraintID)(void *)p, data);
        p = mdt_pointAfter(p);
    }
}

MdtConstraintID MEAPI MdtConstraintGetFirst(const MdtWorldID w) {
    MDT_NEED_WORLD(w, NULL);
    mdt_listSort(&w->constraints);
    return w->constraints.first ? mdt_constraintPublicHandle(mdt_linkOwner(w->constraints.first)) : NULL;
}

MdtConstraintID MEAPI MdtConstraintGetNext(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, NULL);
    return mdt_constraintNext(c);
}
