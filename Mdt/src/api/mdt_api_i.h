/* Inside Mdt: declarations that the files of the API share. */
#ifndef MDT_API_I_H
#define MDT_API_I_H

#include "record/mdt_point_i.h"
#include "record/mdt_named_i.h"

/* The four functions that every joint has. A joint's handle is a constraint's handle, so that they convert by a cast.
 * */
#define MDT_JOINT_BASICS(Joint, TYPE)                                                                                  \
    Mdt##Joint##ID MEAPI Mdt##Joint##Create(const MdtWorldID w) {                                                      \
        return (Mdt##Joint##ID)mdt_jointCreate(w, TYPE, __func__);                                                     \
    }                                                                                                                  \
    MDT_JOINT_CASTS(Joint, TYPE)
#define MDT_JOINT_CASTS(Joint, TYPE)                                                                                   \
    void MEAPI Mdt##Joint##Reset(const Mdt##Joint##ID j) {                                                             \
        MdtJoint *c = mdt_jointOfType(j, TYPE, __func__);                                                              \
        if (c)                                                                                                         \
            c->type->reset(&c->bcl);                                                                                   \
    }                                                                                                                  \
    MdtConstraintID MEAPI Mdt##Joint##QuaConstraint(const Mdt##Joint##ID j) {                                          \
        return (MdtConstraintID)j;                                                                                     \
    }                                                                                                                  \
    Mdt##Joint##ID MEAPI MdtConstraintDCast##Joint(const MdtConstraintID c) {                                          \
        return mdt_jointCast(c, TYPE, __func__);                                                                       \
    }

/* The data of a joint's type, for the macros below: dataOf is null, with a warning, for a handle that is no such joint.
 */
#define MDT_JOINT_DATA(Joint, TYPE, DataOfType, member)                                                                \
    typedef DataOfType Data;                                                                                           \
    static Data *dataOf(Mdt##Joint##ID j, const char *caller) {                                                        \
        MdtJoint *c = mdt_jointOfType(j, TYPE, caller);                                                                \
        return c ? &c->bcl.of.member : NULL;                                                                           \
    }
/* A function that returns a number of a joint's data, d. */
#define MDT_JOINT_GETTER(Joint, Name, value)                                                                           \
    MeReal MEAPI Mdt##Joint##Get##Name(const Mdt##Joint##ID j) {                                                       \
        const Data *d = dataOf(j, __func__);                                                                           \
        return d ? value : 0;                                                                                          \
    }
/* Two functions that set and return a number of a joint's data. `store` checks and stores it: mdt_setNonNegative or
 * mdt_setAngle. */
#define MDT_JOINT_PROPERTY(Joint, Name, store, what, member)                                                           \
    void MEAPI Mdt##Joint##Set##Name(const Mdt##Joint##ID j, const MeReal x) {                                         \
        Data *d = dataOf(j, __func__);                                                                                 \
        store(__func__, what, d ? &d->member : NULL, x);                                                               \
    }                                                                                                                  \
    MDT_JOINT_GETTER(Joint, Name, d->member)

/* The functions of a joint with a limit. */
#define MDT_JOINT_LIMIT(Joint, TYPE, member)                                                                           \
    MdtLimitID MEAPI Mdt##Joint##GetLimit(const Mdt##Joint##ID j) {                                                    \
        MdtJoint *c = mdt_jointOfType(j, TYPE, __func__);                                                              \
        if (c)                                                                                                         \
            mdt_constraintMarkWatched(&c->base);                                                                       \
        return c ? &c->bcl.of.member : NULL;                                                                           \
    }                                                                                                                  \
    void MEAPI Mdt##Joint##SetLimit(const Mdt##Joint##ID j, const MdtLimitID NewLimit) {                               \
        MdtJoint *c = mdt_jointOfType(j, TYPE, __func__);                                                              \
        if (c && mdt_isPointer(__func__, "the limit", NewLimit))                                                       \
            mdt_limitAssign(&c->bcl.of.member, NewLimit);                                                              \
    }

/* The functions of a joint whose relative orientation has a position motor. */
#define MDT_JOINT_TURN_MOTOR(Joint, TYPE, member)                                                                      \
    void MEAPI Mdt##Joint##SetPositionMotor(const Mdt##Joint##ID j, const MeReal frequency, const MeReal dampingRatio, \
                                            const MeReal torqueLimit) {                                                \
        MdtJoint *c = mdt_jointOfType(j, TYPE, __func__);                                                              \
        if (c)                                                                                                         \
            mdt_setServo(__func__, &c->bcl.of.member.motor, frequency, dampingRatio, torqueLimit);                     \
    }                                                                                                                  \
    void MEAPI Mdt##Joint##SetMotorTarget(const Mdt##Joint##ID j, const MeVector4 q, const MeVector3 w) {              \
        MdtJoint *c = mdt_jointOfType(j, TYPE, __func__);                                                              \
        if (c)                                                                                                         \
            mdt_setTargetTurn(__func__, &c->bcl.of.member.target, q, w);                                               \
    }                                                                                                                  \
    void MEAPI Mdt##Joint##GetMotorTarget(const Mdt##Joint##ID j, MeVector4 q) {                                       \
        const MdtJoint *c = mdt_isResult(__func__, q, 4) ? mdt_jointOfType(j, TYPE, __func__) : NULL;                  \
        for (int i = 0; c && i < 4; i++)                                                                               \
            q[i] = (MeReal)c->bcl.of.member.target.quaternion[i];                                                      \
    }

/* Position and depth of a contact now: moved along with its bodies since the step began. */
void mdt_pointGetCurrent(const MdtPoint *p, double time, double position[3], double *depth);

#endif
