/* API of the six springs. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Spring6, MdtBclSPRING6)

MDT_JOINT_DATA(Spring6, MdtBclSPRING6, MdtBclSprings, springs)

typedef enum { stiffness, damping } Property;
enum { LINEAR = 0, ANGULAR = 3 };

/* The springs of a joint; null, with a warning, for a bad handle or axis index. */
static Data *findSprings(MdtSpring6ID j, const char *caller, int axis) {
    Data *s = dataOf(j, caller);
    if (!s || (axis >= 0 && axis <= 2))
        return s;
    MeWarning(1, "%s: the axis index is %d, it must be 0, 1 or 2", caller, axis);
    return NULL;
}

/* Address of a spring's property; null, with a warning, for a bad handle or axis index. */
static MeReal *findProperty(MdtSpring6ID j, const char *caller, int kind, int axis, Property property) {
    Data *s = findSprings(j, caller, axis);
    if (!s)
        return NULL;
    return property == stiffness ? &s->stiffness[kind + axis] : &s->damping[kind + axis];
}

void MEAPI MdtSpring6SetLinearStiffness(const MdtSpring6ID j, int axisindex, MeReal s) {
    mdt_setNonNegative(__func__, "the stiffness", findProperty(j, __func__, LINEAR, axisindex, stiffness), s);
}

MeReal MEAPI MdtSpring6GetLinearStiffness(const MdtSpring6ID j, int axisindex) {
    const MeReal *place = findProperty(j, __func__, LINEAR, axisindex, stiffness);
    return place ? *place : 0;
}

void MEAPI MdtSpring6SetLinearDamping(const MdtSpring6ID j, int axisindex, MeReal d) {
    mdt_setNonNegative(__func__, "the damping", findProperty(j, __func__, LINEAR, axisindex, damping), d);
}

MeReal MEAPI MdtSpring6GetLinearDamping(const MdtSpring6ID j, int axisindex) {
    const MeReal *place = findProperty(j, __func__, LINEAR, axisindex, damping);
    return place ? *place : 0;
}

void MEAPI MdtSpring6SetAngularStiffness(const MdtSpring6ID j, int axisindex, MeReal s) {
    mdt_setNonNegative(__func__, "the stiffness", findProperty(j, __func__, ANGULAR, axisindex, stiffness), s);
}

MeReal MEAPI MdtSpring6GetAngularStiffness(const MdtSpring6ID j, int axisindex) {
    const MeReal *place = findProperty(j, __func__, ANGULAR, axisindex, stiffness);
    return place ? *place : 0;
}

void MEAPI MdtSpring6SetAngularDamping(const MdtSpring6ID j, int axisindex, MeReal d) {
    mdt_setNonNegative(__func__, "the damping", findProperty(j, __func__, ANGULAR, axisindex, damping), d);
}

MeReal MEAPI MdtSpring6GetAngularDamping(const MdtSpring6ID j, int axisindex) {
    const MeReal *place = findProperty(j, __func__, ANGULAR, axisindex, damping);
    return place ? *place : 0;
}

/* ---- motors and targets ---- */

void MEAPI MdtSpring6SetLinearMotor(const MdtSpring6ID j, int axisindex, MeReal frequency, MeReal dampingRatio,
                                    MeReal forceLimit) {
    Data *s = findSprings(j, __func__, axisindex);
    if (s)
        mdt_setServo(__func__, &s->motor[LINEAR + axisindex], frequency, dampingRatio, forceLimit);
}

void MEAPI MdtSpring6SetAngularMotor(const MdtSpring6ID j, int axisindex, MeReal frequency, MeReal dampingRatio,
                                     MeReal torqueLimit) {
    Data *s = findSprings(j, __func__, axisindex);
    if (s)
        mdt_setServo(__func__, &s->motor[ANGULAR + axisindex], frequency, dampingRatio, torqueLimit);
}

/* A rigid direction goes to its target with a velocity, unlike a gap that the program has made otherwise. */
static void moveByTarget(MdtSpring6ID j, const char *function) {
    mdt_jointOfType(j, MdtBclSPRING6, function)->gap = 0;
}

void MEAPI MdtSpring6SetTargetPosition(const MdtSpring6ID j, const MeVector3 position, const MeVector3 velocity) {
    static const MeReal none[3] = {0, 0, 0};
    Data *s = dataOf(j, __func__);
    const MeReal *v = velocity ? velocity : none;
    if (!s || !mdt_isPointer(__func__, "the position", position) ||
        !mdt_isFinite3(__func__, "the position", position[0], position[1], position[2]) ||
        !mdt_isFinite3(__func__, "the velocity", v[0], v[1], v[2]))
        return;
    mdt_fromReal(s->position, position);
    mdt_fromReal(s->velocity, v);
    moveByTarget(j, __func__);
}

void MEAPI MdtSpring6GetTargetPosition(const MdtSpring6ID j, MeVector3 position) {
    const Data *s = mdt_isResult(__func__, position, 3) ? dataOf(j, __func__) : NULL;
    if (s)
        mdt_toReal(position, s->position);
}

void MEAPI MdtSpring6SetTargetQuaternion(const MdtSpring6ID j, const MeVector4 q, const MeVector3 w) {
    Data *s = dataOf(j, __func__);
    if (!s)
        return;
    mdt_setTargetTurn(__func__, &s->target, q, w);
    moveByTarget(j, __func__);
}

void MEAPI MdtSpring6GetTargetQuaternion(const MdtSpring6ID j, MeVector4 q) {
    const Data *s = mdt_isResult(__func__, q, 4) ? dataOf(j, __func__) : NULL;
    for (int i = 0; s && i < 4; i++)
        q[i] = (MeReal)s->target.quaternion[i];
}

/* ---- a moving world ---- */

void MEAPI MdtSpring6SetWorldLinearVelocity(const MdtSpring6ID j, MeReal vx, MeReal vy, MeReal vz) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclSPRING6, __func__);
    if (c)
        ME_UNDER_OWN_NAME(MdtConstraintSetWorldLinearVelocity(&c->base, vx, vy, vz));
}

void MEAPI MdtSpring6SetWorldAngularVelocity(const MdtSpring6ID j, MeReal vx, MeReal vy, MeReal vz) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclSPRING6, __func__);
    if (c)
        ME_UNDER_OWN_NAME(MdtConstraintSetWorldAngularVelocity(&c->base, vx, vy, vz));
}

void MEAPI MdtSpring6GetWorldLinearVelocity(const MdtSpring6ID j, MeVector3 v) {
    MdtJoint *c = mdt_isResult(__func__, v, 3) ? mdt_jointOfType(j, MdtBclSPRING6, __func__) : NULL;
    if (c)
        MdtConstraintGetWorldLinearVelocity(&c->base, v);
}

void MEAPI MdtSpring6GetWorldAngularVelocity(const MdtSpring6ID j, MeVector3 v) {
    MdtJoint *c = mdt_isResult(__func__, v, 3) ? mdt_jointOfType(j, MdtBclSPRING6, __func__) : NULL;
    if (c)
        MdtConstraintGetWorldAngularVelocity(&c->base, v);
}
