/* API of the six springs. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Spring6, MdtBclSPRING6)

typedef enum { stiffness, damping } Property;
enum { LINEAR = 0, ANGULAR = 3 };

/* Address of a spring's property; null, with a warning, for a bad handle or axis index. */
static MeReal *findProperty(MdtSpring6ID j, const char *caller, int kind, int axis, Property property) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclSPRING6, caller);
    if (!c)
        return NULL;
    if (axis < 0 || axis > 2) {
        MeWarning(1, "%s: the axis index is %d, it must be 0, 1 or 2", caller, axis);
        return NULL;
    }
    return property == stiffness ? &c->bcl.of.springs.stiffness[kind + axis] : &c->bcl.of.springs.damping[kind + axis];
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
