/* Breaking joints: joints are disabled when their force, or torque about their position, exceeds a limit in a step. */
#include "MeAssert.h"
#include "record/mdt_record_i.h"

/* ---- limits ---- */

static MeBool isBreakable(const MdtJoint *j) {
    return j->breakForce < MEINFINITY || j->breakTorque < MEINFINITY;
}

/* The joint; null, with a warning, for a contact or a group. */
static MdtJoint *jointOf(MdtConstraintID c, const char *caller) {
    if (!mdt_isJoint(c))
        MeWarning(1, "%s: a %s does not break; nothing is changed", caller, mdt_constraintName(c));
    return mdt_asJoint(c);
}

void MEAPI MdtConstraintSetBreakLimits(const MdtConstraintID c, const MeReal force, const MeReal torque) {
    MDT_NEED_CONSTRAINT(c, );
    MdtJoint *j = jointOf(c, __func__);
    if (!j || !mdt_isNotBelow(__func__, "the force", force, 0) || !mdt_isNotBelow(__func__, "the torque", torque, 0))
        return;
    c->world->breakable -= isBreakable(j);
    j->breakForce = force;
    j->breakTorque = torque;
    c->world->breakable += isBreakable(j);
    MEASSERT(c->world->breakable >= 0 && c->world->breakable <= c->world->jointPool.used);
}

MeReal MEAPI MdtConstraintGetBreakForce(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, 0);
    return mdt_isJoint(c) ? mdt_asJoint(c)->breakForce : MEINFINITY;
}

MeReal MEAPI MdtConstraintGetBreakTorque(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, 0);
    return mdt_isJoint(c) ? mdt_asJoint(c)->breakTorque : MEINFINITY;
}

/* ---- loads ---- */

/* The torque about the joint's position p: T - (p - c) x F, with T the torque about the body's centre of mass c. */
static void torqueAtJoint(MdtJoint *j, int side, double torque[3]) {
    const MdtKeaForce *load = &j->force.body[side];
    MdtKeaTransformation pose[2];
    double arm[3], lever[3];
    mdt_constraintPoses(&j->base, pose);
    keaApply(arm, (const double(*)[3])pose[side].R, j->bcl.frame[side].position);
    keaCross(lever, arm, load->lin);
    keaSubtract(torque, load->ang, lever);
}

void MEAPI MdtConstraintGetJointTorque(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 t) {
    if (!mdt_isResult(__func__, t, 3) || !mdt_isConstraint(c, __func__) || !mdt_isSide(__func__, bodyindex))
        return;
    MdtJoint *j = jointOf(c, __func__);
    double torque[3];
    if (!j || !c->side[bodyindex].body)
        return;
    torqueAtJoint(j, (int)bodyindex, torque);
    mdt_toReal(t, torque);
}

/* ---- breaking ---- */

static MeBool isOverloaded(MdtJoint *j) {
    const int side = j->base.side[0].body ? 0 : 1;
    double torque[3];
    torqueAtJoint(j, side, torque);
    return keaLength(j->force.body[side].lin) > (double)j->breakForce || keaLength(torque) > (double)j->breakTorque;
}

/* True if the joint was part of this step's system. */
static MeBool wasStepped(const MdtBaseConstraint *c) {
    for (int k = 0; k < 2; k++)
        if (c->side[k].body && c->side[k].body->partition >= 0 && (c->side[k].body->record.flags & MDT_ENABLED))
            return (c->record.flags & MDT_ENABLED) != 0;
    return MEFALSE;
}

void mdt_breakBegin(MdtWorldID w) {
    w->numBroken = 0;
}

/* Disables overloaded joints. That wakes bodies; joints that the handlers of bodies destroy are destroyed afterwards.
 * */
static void breakJoints(MdtWorldID w) {
    MeStageBegin(&w->stage, MDT_GUARD_GRAPH);
    for (MdtLink *link = w->constraints.first; link && w->breakable; link = link->next) {
        MdtConstraintID c = mdt_linkOwner(link);
        MdtJoint *j = mdt_asJoint(c);
        if (!j || !isBreakable(j) || !wasStepped(c) || !isOverloaded(j))
            continue;
        mdt_constraintDeactivate(c);
        MEASSERT(w->numBroken < w->constraintRoom);
        w->broken[w->numBroken++] = c;
    }
    MeStageEnd(&w->stage, MDT_GUARD_GRAPH);
}

void mdt_breakEnd(MdtWorldID w) {
    const int before = w->numBroken; /* those of earlier parts of the step were reported */
    breakJoints(w);
    const MeProgramCall call = MeProgramEnter("MdtWorldSetBreakCB");
    for (int i = before; i < w->numBroken && w->breakCb; i++)
        if (w->broken[i])
            w->breakCb(w->broken[i]);
    MeProgramLeave(&call);
}

void mdt_breakForget(MdtJoint *j) {
    const MdtConstraintID c = &j->base;
    c->world->breakable -= isBreakable(j);
    MEASSERT(c->world->breakable >= 0);
    for (int i = 0; i < c->world->numBroken; i++)
        if (c->world->broken[i] == c)
            c->world->broken[i] = NULL;
}

const MdtConstraintID *MEAPI MdtWorldGetBrokenJoints(const MdtWorldID w, int *count) {
    if (count)
        *count = 0;
    MDT_NEED_WORLD(w, NULL);
    if (count)
        *count = w->numBroken;
    return w->broken;
}

void MEAPI MdtWorldSetBreakCB(const MdtWorldID w, MdtBreakCBPtr cb) {
    MDT_NEED_WORLD(w, );
    w->breakCb = cb;
}
