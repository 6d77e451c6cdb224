/* API of the RPRO joint. */
#include "api/mdt_api_i.h"
#include <string.h>

MDT_JOINT_BASICS(RPROJoint, MdtBclRPROJOINT)
MDT_JOINT_DATA(RPROJoint, MdtBclRPROJOINT, MdtBclRelative, relative)

static void copyQuaternion(MeVector4 q, const double from[4]) {
    for (int i = 0; i < 4; i++)
        q[i] = (MeReal)from[i];
}

/* ---- the target orientation ---- */

void MEAPI MdtRPROJointSetRelativeQuaternion(const MdtRPROJointID j, const MeVector4 q) {
    Data *r = dataOf(j, __func__);
    if (!r || !mdt_isPointer(__func__, "the quaternion", q))
        return;
    double unit[4] = {q[0], q[1], q[2], q[3]};
    if (mdt_normalizeQuaternion(__func__, unit))
        memcpy(r->quaternion, unit, sizeof unit);
}

void MEAPI MdtRPROJointGetRelativeQuaternion(const MdtRPROJointID j, MeVector4 q) {
    const Data *r = mdt_isResult(__func__, q, 4) ? dataOf(j, __func__) : NULL;
    if (r)
        copyQuaternion(q, r->quaternion);
}

void MEAPI MdtRPROJointSetRelativeAngularVelocity(MdtRPROJointID j, MeVector3 w) {
    Data *r = dataOf(j, __func__);
    if (r && mdt_isPointer(__func__, "the velocity", w) && mdt_isFinite3(__func__, "the velocity", w[0], w[1], w[2]))
        mdt_fromReal(r->velocity, w);
}

void MEAPI MdtRPROJointGetRelativeAngularVelocity(const MdtRPROJointID j, MeVector3 w) {
    const Data *r = mdt_isResult(__func__, w, 3) ? dataOf(j, __func__) : NULL;
    if (r)
        mdt_toReal(w, r->velocity);
}

/* ---- the attachment frames ---- */

void MEAPI MdtRPROJointSetAttachmentPosition(const MdtRPROJointID j, const MeReal x, const MeReal y, const MeReal z,
                                             const unsigned int bodyindex) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclRPROJOINT, __func__);
    if (c)
        ME_UNDER_OWN_NAME(MdtConstraintBodySetPositionRel(&c->base, bodyindex, x, y, z));
}

void MEAPI MdtRPROJointGetAttachmentPosition(const MdtRPROJointID j, const unsigned int bodyindex, MeVector3 position) {
    MdtJoint *c = mdt_isResult(__func__, position, 3) ? mdt_jointOfType(j, MdtBclRPROJOINT, __func__) : NULL;
    if (c)
        ME_UNDER_OWN_NAME(MdtConstraintBodyGetPositionRel(&c->base, bodyindex, position));
}

void MEAPI MdtRPROJointSetAttachmentQuaternion(const MdtRPROJointID j, const MeReal q0, const MeReal q1,
                                               const MeReal q2, const MeReal q3, const unsigned int bodyindex) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclRPROJOINT, __func__);
    double unit[4] = {q0, q1, q2, q3}, R[3][3];
    if (!c || !mdt_isSide(__func__, bodyindex) || !mdt_normalizeQuaternion(__func__, unit))
        return;
    keaQuaternionToMatrix(R, unit);
    for (int i = 0; i < 3; i++) {
        c->bcl.frame[bodyindex].primary[i] = R[i][0];
        c->bcl.frame[bodyindex].ortho[i] = R[i][1];
    }
}

void MEAPI MdtRPROJointGetAttachmentQuaternion(const MdtRPROJointID j, const unsigned int bodyindex,
                                               MeVector4 quaternion) {
    MdtJoint *c = mdt_isResult(__func__, quaternion, 4) ? mdt_jointOfType(j, MdtBclRPROJOINT, __func__) : NULL;
    if (!c || !mdt_isSide(__func__, bodyindex))
        return;
    const MdtBclFrame *frame = &c->bcl.frame[bodyindex];
    double third[3], R[3][3], q[4];
    keaCross(third, frame->primary, frame->ortho);
    for (int i = 0; i < 3; i++) {
        R[i][0] = frame->primary[i];
        R[i][1] = frame->ortho[i];
        R[i][2] = third[i];
    }
    keaQuaternionFromMatrix(q, (const double(*)[3])R);
    copyQuaternion(quaternion, q);
}

/* ---- other names of these functions ---- */

void MEAPI MdtRPROJointGetAttachmentOrientation(const MdtRPROJointID j, const unsigned int bodyindex,
                                                MeVector4 quaternion) {
    ME_UNDER_OWN_NAME(MdtRPROJointGetAttachmentQuaternion(j, bodyindex, quaternion));
}

void MEAPI MdtRPROJointGetPosition(const MdtRPROJointID j, const unsigned int bodyindex, MeVector3 position) {
    ME_UNDER_OWN_NAME(MdtRPROJointGetAttachmentPosition(j, bodyindex, position));
}

void MEAPI MdtRPROJointSetPosition(const MdtRPROJointID j, const MeReal x, const MeReal y, const MeReal z,
                                   const unsigned int bodyindex) {
    ME_UNDER_OWN_NAME(MdtRPROJointSetAttachmentPosition(j, x, y, z, bodyindex));
}

/* ---- strengths ---- */

static void setStrength(MeReal strength[3], const char *caller, MeReal x, MeReal y, MeReal z) {
    const MeReal s[3] = {x, y, z};
    for (int i = 0; i < 3; i++)
        if (!mdt_isNotBelow(caller, "a strength", s[i], 0))
            return;
    memcpy(strength, s, sizeof s);
}

void MEAPI MdtRPROJointSetLinearStrength(const MdtRPROJointID j, const MeReal sX, const MeReal sY, const MeReal sZ) {
    Data *r = dataOf(j, __func__);
    if (r)
        setStrength(r->linear, __func__, sX, sY, sZ);
}

void MEAPI MdtRPROJointSetAngularStrength(const MdtRPROJointID j, const MeReal sX, const MeReal sY, const MeReal sZ) {
    Data *r = dataOf(j, __func__);
    if (r)
        setStrength(r->angular, __func__, sX, sY, sZ);
}

void MEAPI MdtRPROJointGetLinearStrength(const MdtRPROJointID j, MeVector3 v) {
    const Data *r = mdt_isResult(__func__, v, 3) ? dataOf(j, __func__) : NULL;
    if (r)
        memcpy(v, r->linear, sizeof r->linear);
}

void MEAPI MdtRPROJointGetAngularStrength(const MdtRPROJointID j, MeVector3 v) {
    const Data *r = mdt_isResult(__func__, v, 3) ? dataOf(j, __func__) : NULL;
    if (r)
        memcpy(v, r->angular, sizeof r->angular);
}
