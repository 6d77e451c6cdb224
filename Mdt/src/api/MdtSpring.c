/* API of the spring. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Spring, MdtBclSPRING)
MDT_JOINT_LIMIT(Spring, MdtBclSPRING, distance.limit)
MDT_JOINT_DATA(Spring, MdtBclSPRING, MdtBclDistance, distance)

void MEAPI MdtSpringSetPosition(const MdtSpringID j, const unsigned int bodyindex, const MeReal x, const MeReal y,
                                const MeReal z) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclSPRING, __func__);
    if (c)
        mdt_constraintBodySetPosition(&c->base, bodyindex, x, y, z, __func__);
}

void MEAPI MdtSpringGetPosition(const MdtSpringID j, MeVector3 v, const unsigned int bodyindex) {
    MdtJoint *c = mdt_isResult(__func__, v, 3) ? mdt_jointOfType(j, MdtBclSPRING, __func__) : NULL;
    if (c)
        mdt_constraintBodyGetPosition(&c->base, bodyindex, v, __func__);
}

void MEAPI MdtSpringSetNaturalLength(const MdtSpringID j, const MeReal NewNaturalLength) {
    Data *s = dataOf(j, __func__);
    if (!s || !mdt_isNotBelow(__func__, "the length", NewNaturalLength, 0) ||
        !mdt_isFinite3(__func__, "the length", NewNaturalLength, 0, 0))
        return;
    s->limit.limit[0].stop = s->limit.limit[1].stop = NewNaturalLength;
    s->lengthIsSet = METRUE;
}

void MEAPI MdtSpringSetStiffness(const MdtSpringID j, const MeReal NewStiffness) {
    Data *s = dataOf(j, __func__);
    if (s && mdt_isNotBelow(__func__, "the stiffness", NewStiffness, 0))
        s->limit.limit[0].stiffness = s->limit.limit[1].stiffness = NewStiffness;
}

void MEAPI MdtSpringSetDamping(const MdtSpringID j, const MeReal NewDamping) {
    Data *s = dataOf(j, __func__);
    if (s && mdt_isNotBelow(__func__, "the damping", NewDamping, 0))
        s->limit.limit[0].damping = s->limit.limit[1].damping = NewDamping;
}
