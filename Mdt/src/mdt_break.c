/* Joints that break: whose force, or torque about their position, was larger in a step than they bear. */
#include "MeAssert.h"
#include "mdt_i.h"

/* ---- limits ---- */

static MeBool isBreakable(const MdtBaseConstraint *c) {
    return c->breakForce < MEINFINITY || c->breakTorque < MEINFINITY;
}

static MeBool isJoint(MdtConstraintID c, const char *caller) {
    if (c->bcl.type != MdtBclCONTACT && c->bcl.type != MdtBclCONTACTGROUP)
        return METRUE;
    MeWarning(1, "%s: a %s does not break; nothing is changed", caller, c->type->name);
    return MEFALSE;
}

void MEAPI MdtConstraintSetBreakLimits(const MdtConstraintID c, const MeReal force, const MeReal torque) {
    MDT_NEED_CONSTRAINT(c, );
    if (!isJoint(c, __func__) || !mdt_isAtLeast(__func__, "the force", force, 0) ||
        !mdt_isAtLeast(__func__, "the torque", torque, 0))
        return;
    c->world->breakable -= isBreakable(c);
    c->breakForce = force;
    c->breakTorque = torque;
    c->world->breakable += isBreakable(c);
}

MeReal MEAPI MdtConstraintGetBreakForce(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, 0);
    return c->breakForce;
}

MeReal MEAPI MdtConstraintGetBreakTorque(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, 0);
    return c->breakTorque;
}

/* ---- what it carries ---- */

/* T - (p - c) x F: of the torque about the body's centre of mass c, what remains about the position p. */
static void torqueAtJoint(MdtConstraintID c, int side, double torque[3]) {
    const MdtKeaForce *load = &c->force.body[side];
    MdtKeaTransformation pose[2];
    double arm[3], lever[3];
    mdt_constraintPoses(c, pose);
    keaApply(arm, (const double(*)[3])pose[side].R, c->bcl.frame[side].position);
    keaCross(lever, arm, load->lin);
    keaSubtract(torque, load->ang, lever);
}

void MEAPI MdtConstraintGetJointTorque(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 t) {
    if (!mdt_isResult(__func__, t, 3) || !mdt_isConstraint(c, __func__) || !mdt_isSide(__func__, bodyindex) ||
        !c->side[bodyindex].body || !isJoint(c, __func__))
        return;
    double torque[3];
    torqueAtJoint(c, (int)bodyindex, torque);
    mdt_toReal(t, torque);
}

/* ---- breaking ---- */

static MeBool isOverloaded(MdtConstraintID c) {
    const int side = c->side[0].body ? 0 : 1;
    double torque[3];
    torqueAtJoint(c, side, torque);
    return keaLength(c->force.body[side].lin) > (double)c->breakForce || keaLength(torque) > (double)c->breakTorque;
}

/* Did it act in this step? */
static MeBool wasStepped(const MdtBaseConstraint *c) {
    for (int k = 0; k < 2; k++)
        if (c->side[k].body && c->side[k].body->partition >= 0 && (c->side[k].body->flags & MDT_ENABLED))
            return mdt_constraintActs(c);
    return MEFALSE;
}

void mdt_breakBegin(MdtWorldID w) {
    w->numBroken = 0;
}

static void breakJoints(MdtWorldID w) {
    for (MdtLink *link = w->constraints.first; link && w->breakable; link = link->next) {
        MdtConstraintID c = link->owner;
        if (!isBreakable(c) || !wasStepped(c) || !isOverloaded(c))
            continue;
        MdtConstraintDisable(c);
        MEASSERT(c->bcl.type != MdtBclCONTACT && c->bcl.type != MdtBclCONTACTGROUP);
        w->broken[w->numBroken++] = c;
    }
}

void mdt_breakEnd(MdtWorldID w) {
    const int before = w->numBroken; /* in earlier parts of the step */
    breakJoints(w);
    for (int i = before; i < w->numBroken && w->breakCb; i++)
        if (w->broken[i])
            w->breakCb(w->broken[i]);
}

void mdt_breakForget(MdtConstraintID c) {
    c->world->breakable -= isBreakable(c);
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
