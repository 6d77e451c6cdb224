/* What all constraints have: bodies, frames, forces read back. */
#include "MeAssert.h"
#include "mdt_i.h"
#include <string.h>

/* ---- life ---- */

MdtConstraintID mdt_constraintCreate(MdtWorldID w, MdtBclJointType type, const char *caller) {
    if (!mdt_isWorld(w, caller))
        return NULL;
    MdtConstraintID c = mdt_poolGet(&w->constraintPool, MDT_CONSTRAINT, caller);
    if (!c)
        return NULL;
    c->world = w;
    c->type = MdtBclTypeOf(type);
    c->bcl.type = type;
    c->side[0].constraint = c->side[1].constraint = c;
    c->breakForce = c->breakTorque = MEINFINITY;
    c->isWatched = type != MdtBclCONTACT && type != MdtBclCONTACTGROUP;
    c->type->reset(&c->bcl);
    mdt_listAppend(&w->constraints, &c->link, c, w->nextSerial++);
    return c;
}

void mdt_constraintFree(MdtConstraintID c) {
    if (c->bcl.type == MdtBclUSER)
        MeMemoryGive(c->bcl.of.user.rows);
}

void mdt_constraintTerm(MdtConstraintID c) {
    if (c->bcl.type == MdtBclCONTACTGROUP)
        mdt_groupTerm(c);
    if (c->group)
        mdt_groupForget(c);
    MdtConstraintDisable(c);
    mdt_constraintDetach(c, 0);
    mdt_constraintDetach(c, 1);
    MEASSERT(!c->side[0].body && !c->side[1].body && !c->group && !(c->flags & MDT_ENABLED));
    mdt_constraintFree(c);
    mdt_breakForget(c);
    mdt_listRemove(&c->world->constraints, &c->link);
    mdt_poolPut(&c->world->constraintPool, c);
}

MdtConstraintID mdt_constraintOfType(void *handle, MdtBclJointType type, const char *caller) {
    MdtConstraintID c = handle;
    if (!mdt_isConstraint(c, caller))
        return NULL;
    if (c->bcl.type == type)
        return c;
    MeWarning(1, "%s: the constraint is a %s, not a %s", caller, c->type->name, MdtBclTypeOf(type)->name);
    return NULL;
}

void *mdt_constraintCast(MdtConstraintID c, MdtBclJointType type, const char *caller) {
    return mdt_isConstraint(c, caller) && c->bcl.type == type ? c : NULL;
}

void MEAPI MdtConstraintDestroy(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, );
    mdt_constraintTerm(c);
}

void mdt_constraintForget(MdtConstraintID c) {
    c->numWarm = 0;
    if (c->type == MdtBclTypeOf(MdtBclCONTACT))
        c->bcl.of.contact.normalForce = 0;
}

void MEAPI MdtConstraintEnable(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, );
    if ((c->flags & MDT_ENABLED) || c->group)
        return;
    if (!c->side[0].body && !c->side[1].body) {
        MeWarning(1, "MdtConstraintEnable: the %s is attached to no body; it stays disabled", c->type->name);
        return;
    }
    c->flags |= MDT_ENABLED;
    mdt_graphChanged(c->world);
    mdt_constraintForget(c);
    mdt_constraintDisturb(c);
    c->world->enabledConstraints++;
}

void MEAPI MdtConstraintDisable(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, );
    if (!(c->flags & MDT_ENABLED))
        return;
    c->flags &= ~MDT_ENABLED;
    mdt_graphChanged(c->world);
    mdt_constraintDisturb(c);
    c->world->enabledConstraints--;
    MEASSERT(c->world->enabledConstraints >= 0);
    for (int k = 0; k < 2; k++) /* what it held in its sleep has to be looked at */
        if (c->side[k].body)
            mdt_bodyWakeIfAsleep(c->side[k].body);
}

MeBool MEAPI MdtConstraintIsEnabled(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, 0);
    return ((c->group ? c->group->flags : c->flags) & MDT_ENABLED) != 0;
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
    at->body = NULL;
    at->next = at->previous = NULL;
}

static void attach(MdtConstraintID c, int side, MdtBodyID b) {
    MdtAttachment *at = &c->side[side];
    mdt_constraintDetach(c, side);
    at->body = b;
    if (!b)
        return;
    MEASSERT(!at->next && !at->previous && at->constraint == c && b->world == c->world);
    at->next = b->attachments;
    if (at->next)
        at->next->previous = at;
    b->attachments = at;
    b->flags |= c->isWatched ? MDT_WATCHED : 0;
    mdt_graphChanged(c->world);
    mdt_constraintDisturb(c);
    MEVALIDATE(mdt_attachmentsAreLinked(b));
}

void mdt_constraintWatch(MdtConstraintID c) {
    c->isWatched = METRUE;
    for (int k = 0; k < 2; k++)
        if (c->side[k].body)
            c->side[k].body->flags |= MDT_WATCHED;
    mdt_constraintDisturb(c);
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

/* Poses as Bcl's functions take them. */
typedef struct {
    MdtKeaTransformation of[2];
    const MdtKeaTransformation *at[2];
} Poses;

static void takePoses(MdtConstraintID c, Poses *poses) {
    mdt_constraintPoses(c, poses->of);
    poses->at[0] = &poses->of[0];
    poses->at[1] = &poses->of[1];
}

static void notifyPositioned(MdtConstraintID c) {
    Poses poses;
    takePoses(c, &poses);
    if (c->type->positioned)
        c->type->positioned(&c->bcl, poses.at);
}

static void notifyAttached(MdtConstraintID c) {
    Poses poses;
    takePoses(c, &poses);
    if (c->type->attached)
        c->type->attached(&c->bcl, poses.at);
    if (c->type->positioned)
        c->type->positioned(&c->bcl, poses.at);
}

static void notifyAxesSet(MdtConstraintID c, const MdtBclFrame before[2]) {
    Poses poses;
    takePoses(c, &poses);
    if (c->type->axesSet)
        c->type->axesSet(&c->bcl, before, poses.at);
}

void mdt_constraintAttach(MdtConstraintID c, MdtBodyID b0, MdtBodyID b1) {
    attach(c, 0, b0);
    attach(c, 1, b1);
    mdt_constraintForget(c);
    notifyAttached(c);
}

/* In a group with the world the first body is the one that moves. */
static void attachGroup(MdtConstraintID c, MdtBodyID b1, MdtBodyID b2) {
    c->isSwapped = b1 == NULL;
    mdt_constraintAttach(c, b1 ? b1 : b2, b1 ? b2 : NULL);
    mdt_groupAttachContacts(c);
}

void MEAPI MdtConstraintSetBodies(const MdtConstraintID c, const MdtBodyID b1, const MdtBodyID b2) {
    MDT_NEED_CONSTRAINT(c, );
    if (!mayAttach(c, b1, __func__) || !mayAttach(c, b2, __func__))
        return;
    if (b1 == b2) {
        MeWarning(1, "MdtConstraintSetBodies: %s; nothing is changed",
                  b1 ? "the two bodies are the same" : "both bodies are null");
        return;
    }
    if (c->flags & MDT_ENABLED)
        MeWarning(1, "MdtConstraintSetBodies: the %s is enabled; disable it before changing its bodies", c->type->name);
    if (c->group)
        MeWarning(1, "MdtConstraintSetBodies: the contact belongs to a group, whose bodies it has; nothing is changed");
    else if (c->bcl.type == MdtBclCONTACTGROUP)
        attachGroup(c, b1, b2);
    else
        mdt_constraintAttach(c, b1, b2);
}

MeBool mdt_isSide(const char *caller, unsigned int bodyindex) {
    if (bodyindex < 2)
        return METRUE;
    MeWarning(1, "%s: the body index is %u, it must be 0 or 1", caller, bodyindex);
    return MEFALSE;
}

MdtBodyID MEAPI MdtConstraintGetBody(const MdtConstraintID c, const unsigned int bodyindex) {
    MDT_NEED_CONSTRAINT(c, NULL);
    return mdt_isSide(__func__, bodyindex) ? c->side[bodyindex].body : NULL;
}

/* ---- frames: stored in the frame of the body's centre of mass, or the world's ---- */

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

void mdt_constraintReframe(MdtConstraintID c, int side, const MdtKeaBody *before, const MdtKeaBody *after) {
    MdtBclFrame *frame = &c->bcl.frame[side];
    MdtKeaTransformation from, to;
    double world[3];
    poseOfKea(before, &from);
    poseOfKea(after, &to);
    keaApply(world, (const double(*)[3])from.R, frame->position);
    keaAddScaled(world, 1, from.pos);
    keaSubtract(world, world, to.pos);
    keaApplyTransposed(frame->position, (const double(*)[3])to.R, world);
    double *axes[] = {frame->primary, frame->ortho};
    for (int i = 0; i < 2; i++) {
        keaApply(world, (const double(*)[3])from.R, axes[i]);
        keaApplyTransposed(axes[i], (const double(*)[3])to.R, world);
    }
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

static void turnToBody(MdtConstraintID c, int side, const double world[3], double local[3]) {
    MdtKeaTransformation pose;
    poseOf(c, side, &pose);
    keaApplyTransposed(local, (const double(*)[3])pose.R, world);
}

static void turnToWorld(MdtConstraintID c, int side, const double local[3], double world[3]) {
    MdtKeaTransformation pose;
    poseOf(c, side, &pose);
    keaApply(world, (const double(*)[3])pose.R, local);
}

/* The side by which a whole constraint is described: the first that is a body. */
static int mainSide(MdtConstraintID c) {
    return c->side[0].body ? 0 : 1;
}

static MeBool isContact(MdtConstraintID c, const char *caller) {
    if (c->bcl.type != MdtBclCONTACT)
        return MEFALSE;
    MeWarning(1, "%s: a contact has no frames in its bodies; see MdtContact.h", caller);
    return METRUE;
}

void MEAPI MdtConstraintSetPosition(const MdtConstraintID c, const MeReal x, const MeReal y, const MeReal z) {
    MdtConstraintBodySetPosition(c, 0, x, y, z);
    MdtConstraintBodySetPosition(c, 1, x, y, z);
}

void MEAPI MdtConstraintGetPosition(const MdtConstraintID c, MeVector3 p) {
    if (!mdt_isResult(__func__, p, 3) || !mdt_isConstraint(c, __func__))
        return;
    MdtConstraintBodyGetPosition(c, (unsigned int)mainSide(c), p);
}

void MEAPI MdtConstraintBodySetPosition(const MdtConstraintID c, const unsigned int bodyindex, const MeReal x,
                                        const MeReal y, const MeReal z) {
    MDT_NEED_CONSTRAINT(c, );
    if (isContact(c, __func__) || !mdt_isSide(__func__, bodyindex) || !mdt_isFinite3(__func__, "the position", x, y, z))
        return;
    const double world[3] = {x, y, z};
    pointToBody(c, (int)bodyindex, world, c->bcl.frame[bodyindex].position);
    notifyPositioned(c);
}

void MEAPI MdtConstraintBodyGetPosition(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p) {
    if (!mdt_isResult(__func__, p, 3) || !mdt_isConstraint(c, __func__))
        return;
    if (isContact(c, __func__) || !mdt_isSide(__func__, bodyindex))
        return;
    double world[3];
    pointToWorld(c, (int)bodyindex, c->bcl.frame[bodyindex].position, world);
    mdt_toReal(p, world);
}

void MEAPI MdtConstraintBodySetPositionRel(const MdtConstraintID c, const unsigned int bodyindex, const MeReal x,
                                           const MeReal y, const MeReal z) {
    MDT_NEED_CONSTRAINT(c, );
    if (isContact(c, __func__) || !mdt_isSide(__func__, bodyindex) || !mdt_isFinite3(__func__, "the position", x, y, z))
        return;
    const double local[3] = {x, y, z};
    keaCopy(c->bcl.frame[bodyindex].position, local);
    notifyPositioned(c);
}

void MEAPI MdtConstraintBodyGetPositionRel(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p) {
    if (!mdt_isResult(__func__, p, 3) || !mdt_isConstraint(c, __func__))
        return;
    if (!isContact(c, __func__) && mdt_isSide(__func__, bodyindex))
        mdt_toReal(p, c->bcl.frame[bodyindex].position);
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

/* By leaving out p's smallest component. */
void mdt_chooseOrthogonal(const double p[3], double o[3]) {
    const double a[3] = {fabs(p[0]), fabs(p[1]), fabs(p[2])};
    const int least = a[0] <= a[1] && a[0] <= a[2] ? 0 : a[1] <= a[2] ? 1 : 2;
    double unit[3] = {0, 0, 0};
    unit[least] = 1;
    keaCross(o, p, unit);
}

static void setAxesOf(MdtConstraintID c, int side, const double p[3], const double o[3]) {
    turnToBody(c, side, p, c->bcl.frame[side].primary);
    turnToBody(c, side, o, c->bcl.frame[side].ortho);
}

static void setBothAxes(MdtConstraintID c, const double p[3], const double o[3]) {
    const MdtBclFrame before[2] = {c->bcl.frame[0], c->bcl.frame[1]};
    setAxesOf(c, 0, p, o);
    setAxesOf(c, 1, p, o);
    notifyAxesSet(c, before);
}

void MEAPI MdtConstraintSetAxis(const MdtConstraintID c, const MeReal px, const MeReal py, const MeReal pz) {
    MDT_NEED_CONSTRAINT(c, );
    double p[3] = {px, py, pz}, o[3];
    mdt_chooseOrthogonal(p, o);
    if (isContact(c, __func__) || !mdt_makeAxes(__func__, p, o))
        return;
    setBothAxes(c, p, o);
}

void MEAPI MdtConstraintSetAxes(const MdtConstraintID c, const MeReal px, const MeReal py, const MeReal pz,
                                const MeReal ox, const MeReal oy, const MeReal oz) {
    MDT_NEED_CONSTRAINT(c, );
    double p[3] = {px, py, pz}, o[3] = {ox, oy, oz};
    if (isContact(c, __func__) || !mdt_makeAxes(__func__, p, o))
        return;
    setBothAxes(c, p, o);
}

void MEAPI MdtConstraintBodySetAxes(const MdtConstraintID c, const unsigned int bodyindex, const MeReal px,
                                    const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                    const MeReal oz) {
    MDT_NEED_CONSTRAINT(c, );
    double p[3] = {px, py, pz}, o[3] = {ox, oy, oz};
    if (!isContact(c, __func__) && mdt_isSide(__func__, bodyindex) && mdt_makeAxes(__func__, p, o))
        setAxesOf(c, (int)bodyindex, p, o);
}

void MEAPI MdtConstraintBodySetAxesRel(const MdtConstraintID c, const unsigned int bodyindex, const MeReal px,
                                       const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                       const MeReal oz) {
    MDT_NEED_CONSTRAINT(c, );
    double p[3] = {px, py, pz}, o[3] = {ox, oy, oz};
    if (isContact(c, __func__) || !mdt_isSide(__func__, bodyindex) || !mdt_makeAxes(__func__, p, o))
        return;
    keaCopy(c->bcl.frame[bodyindex].primary, p);
    keaCopy(c->bcl.frame[bodyindex].ortho, o);
}

static void setCrossFrame(MdtConstraintID c, int side, const double own[3], const double second[3]) {
    setAxesOf(c, side, side == 0 ? own : second, side == 0 ? second : own);
}

/* As the bodies stand now, each side has the other's axis, made orthogonal to its own, as its second one: that is what
 * angles are counted from. Where the two are parallel, since the other has yet to be set, it is chosen. */
void mdt_constraintSetCrossAxis(MdtConstraintID c, const char *caller, int side, MeReal x, MeReal y, MeReal z) {
    double axis[3] = {x, y, z}, other[3], second[3], back[3];
    turnToWorld(c, 1 - side, side == 0 ? c->bcl.frame[1].ortho : c->bcl.frame[0].primary, other);
    const MeBool isParallel = fabs(keaDot(axis, other)) > 0.999 * keaLength(axis);
    keaCopy(second, other);
    if (isParallel)
        mdt_chooseOrthogonal(axis, second);
    if (!mdt_makeAxes(caller, axis, second))
        return;
    setCrossFrame(c, side, axis, second);
    keaCopy(back, axis);
    if (!isParallel && mdt_makeAxes(caller, other, back))
        setCrossFrame(c, 1 - side, other, back);
}

static void zeroAxes(MeVector3 p, MeVector3 o) {
    for (int i = 0; i < 3; i++) {
        if (p)
            p[i] = 0;
        if (o)
            o[i] = 0;
    }
}

/* Either result may be null: that axis is not asked for. */
static void getAxes(MdtConstraintID c, int side, MeVector3 p, MeVector3 o) {
    double axis[3];
    if (p) {
        turnToWorld(c, side, c->bcl.frame[side].primary, axis);
        mdt_toReal(p, axis);
    }
    if (o) {
        turnToWorld(c, side, c->bcl.frame[side].ortho, axis);
        mdt_toReal(o, axis);
    }
}

void MEAPI MdtConstraintGetAxes(const MdtConstraintID c, MeVector3 p, MeVector3 o) {
    zeroAxes(p, o);
    MDT_NEED_CONSTRAINT(c, );
    if (!isContact(c, __func__))
        getAxes(c, mainSide(c), p, o);
}

void MEAPI MdtConstraintBodyGetAxes(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p, MeVector3 o) {
    zeroAxes(p, o);
    MDT_NEED_CONSTRAINT(c, );
    if (!isContact(c, __func__) && mdt_isSide(__func__, bodyindex))
        getAxes(c, (int)bodyindex, p, o);
}

void MEAPI MdtConstraintBodyGetAxis(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 a) {
    MdtConstraintBodyGetAxes(c, bodyindex, a, NULL);
}

void MEAPI MdtConstraintBodyGetAxesRel(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p,
                                       MeVector3 o) {
    zeroAxes(p, o);
    MDT_NEED_CONSTRAINT(c, );
    if (isContact(c, __func__) || !mdt_isSide(__func__, bodyindex))
        return;
    if (p)
        mdt_toReal(p, c->bcl.frame[bodyindex].primary);
    if (o)
        mdt_toReal(o, c->bcl.frame[bodyindex].ortho);
}

/* ---- what it did ---- */

void MEAPI MdtConstraintGetForce(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 f) {
    if (!mdt_isResult(__func__, f, 3) || !mdt_isConstraint(c, __func__))
        return;
    if (mdt_isSide(__func__, bodyindex))
        mdt_toReal(f, c->force.body[bodyindex].lin);
}

void MEAPI MdtConstraintGetTorque(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 t) {
    if (!mdt_isResult(__func__, t, 3) || !mdt_isConstraint(c, __func__))
        return;
    if (mdt_isSide(__func__, bodyindex))
        mdt_toReal(t, c->force.body[bodyindex].ang);
}

int MEAPI MdtConstraintGetRowCount(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, 0);
    int rows = c->numRows;
    for (MdtConstraintID contact = c->firstContact; contact; contact = contact->nextInGroup)
        rows += contact->numRows;
    return rows;
}

/* ---- a moving world ---- */

static void setWorldVelocity(MdtConstraintID c, const char *caller, double v[3], MeReal x, MeReal y, MeReal z) {
    if (!mdt_isConstraint(c, caller) || !mdt_isFinite3(caller, "the velocity", x, y, z))
        return;
    if (v[0] != (double)x || v[1] != (double)y || v[2] != (double)z)
        mdt_constraintDisturb(c);
    v[0] = x, v[1] = y, v[2] = z;
}

void MEAPI MdtConstraintSetWorldLinearVelocity(const MdtConstraintID c, const MeReal vx, const MeReal vy,
                                               const MeReal vz) {
    setWorldVelocity(c, __func__, c ? c->worldVelocity.lin : NULL, vx, vy, vz);
}

void MEAPI MdtConstraintSetWorldAngularVelocity(const MdtConstraintID c, const MeReal ax, const MeReal ay,
                                                const MeReal az) {
    setWorldVelocity(c, __func__, c ? c->worldVelocity.ang : NULL, ax, ay, az);
}

void MEAPI MdtConstraintGetWorldLinearVelocity(const MdtConstraintID c, MeVector3 lv) {
    if (!mdt_isResult(__func__, lv, 3) || !mdt_isConstraint(c, __func__))
        return;
    mdt_toReal(lv, c->worldVelocity.lin);
}

void MEAPI MdtConstraintGetWorldAngularVelocity(const MdtConstraintID c, MeVector3 av) {
    if (!mdt_isResult(__func__, av, 3) || !mdt_isConstraint(c, __func__))
        return;
    mdt_toReal(av, c->worldVelocity.ang);
}

/* ---- bookkeeping ---- */

MdtWorldID MEAPI MdtConstraintGetWorld(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, NULL);
    return c->world;
}

void MEAPI MdtConstraintSetUserData(const MdtConstraintID c, void *d) {
    MDT_NEED_CONSTRAINT(c, );
    c->userData = d;
}

void *MEAPI MdtConstraintGetUserData(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, NULL);
    return c->userData;
}

void MEAPI MdtConstraintSetSortKey(const MdtConstraintID c, MeI32 key) {
    MDT_NEED_CONSTRAINT(c, );
    if (!mdt_isSortKey(__func__, key))
        return;
    mdt_listSetKey(&c->world->constraints, &c->link, key);
    mdt_graphChanged(c->world);
}

MeI32 MEAPI MdtConstraintGetSortKey(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, 0);
    return c->link.sortKey;
}

MdtConstraintID MEAPI MdtConstraintGetFirst(const MdtWorldID w) {
    MDT_NEED_WORLD(w, NULL);
    mdt_listSort(&w->constraints);
    return w->constraints.first ? w->constraints.first->owner : NULL;
}

MdtConstraintID MEAPI MdtConstraintGetNext(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, NULL);
    return c->link.next ? c->link.next->owner : NULL;
}
