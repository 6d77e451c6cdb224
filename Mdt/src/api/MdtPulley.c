/* API of the pulley. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Pulley, MdtBclPULLEY)
MDT_JOINT_DATA(Pulley, MdtBclPULLEY, MdtBclCoupling, coupling)

typedef struct {
    MdtKeaTransformation of[2];
    const MdtKeaTransformation *at[2];
} Poses;

static MdtJoint *jointAt(MdtPulleyID j, Poses *poses) {
    MdtJoint *c = (MdtJoint *)(void *)j;
    mdt_constraintPoses(&c->base, poses->of);
    poses->at[0] = &poses->of[0];
    poses->at[1] = &poses->of[1];
    return c;
}

/* Measures the length again, unless the program has set it. */
static void remeasure(MdtPulleyID j) {
    Poses poses;
    MdtJoint *c = jointAt(j, &poses);
    c->type->positioned(&c->bcl, poses.at);
}

void MEAPI MdtPulleySetPosition(const MdtPulleyID j, const unsigned int bodyindex, const MeReal x, const MeReal y,
                                const MeReal z) {
    if (dataOf(j, __func__))
        mdt_constraintBodySetPosition((MdtConstraintID)j, bodyindex, x, y, z, __func__);
}

void MEAPI MdtPulleyGetPosition(const MdtPulleyID j, const unsigned int bodyindex, MeVector3 position) {
    if (mdt_isResult(__func__, position, 3) && dataOf(j, __func__))
        mdt_constraintBodyGetPosition((MdtConstraintID)j, bodyindex, position, __func__);
}

void MEAPI MdtPulleySetWheel(const MdtPulleyID j, const unsigned int bodyindex, const MeReal x, const MeReal y,
                             const MeReal z) {
    Data *d = dataOf(j, __func__);
    if (!d || !mdt_isSide(__func__, bodyindex) ||
        !mdt_isPositionValid(__func__, "the position", ((MdtConstraintID)j)->world, x, y, z))
        return;
    const double wheel[3] = {x, y, z};
    keaCopy(d->coordinate[bodyindex].frame[1].position, wheel);
    remeasure(j);
}

void MEAPI MdtPulleyGetWheel(const MdtPulleyID j, const unsigned int bodyindex, MeVector3 position) {
    const Data *d = mdt_isResult(__func__, position, 3) ? dataOf(j, __func__) : NULL;
    if (d && mdt_isSide(__func__, bodyindex))
        mdt_toReal(position, d->coordinate[bodyindex].frame[1].position);
}

void MEAPI MdtPulleySetRatio(const MdtPulleyID j, const MeReal ratio) {
    Data *d = dataOf(j, __func__);
    if (!d || !mdt_isPositive(__func__, "the ratio", ratio))
        return;
    d->coordinate[1].factor = ratio;
    remeasure(j);
}

MDT_JOINT_GETTER(Pulley, Ratio, (MeReal)d->coordinate[1].factor)

void MEAPI MdtPulleySetLength(const MdtPulleyID j, const MeReal length) {
    Data *d = dataOf(j, __func__);
    if (!d || !mdt_isNotBelow(__func__, "the length", length, 0) ||
        !mdt_isFinite3(__func__, "the length", length, 0, 0))
        return;
    d->constant = length;
    d->lengthIsSet = METRUE;
}

MDT_JOINT_GETTER(Pulley, Length, mdt_real(d->constant))

void MEAPI MdtPulleySetSlack(const MdtPulleyID j, const MeBool isSlack) {
    Data *d = dataOf(j, __func__);
    if (d)
        d->isSlack = isSlack != 0;
}

MeBool MEAPI MdtPulleyGetSlack(const MdtPulleyID j) {
    const Data *d = dataOf(j, __func__);
    return d && d->isSlack;
}

MeReal MEAPI MdtPulleyGetDistance(const MdtPulleyID j, const unsigned int bodyindex) {
    Poses poses;
    if (!dataOf(j, __func__) || !mdt_isSide(__func__, bodyindex))
        return 0;
    const MdtJoint *c = jointAt(j, &poses);
    return mdt_real(MdtBclCouplingCoordinate(&c->bcl, (int)bodyindex, poses.at));
}

MeReal MEAPI MdtPulleyGetTension(const MdtPulleyID j) {
    const Data *d = dataOf(j, __func__);
    if (!d)
        return 0;
    const MdtJoint *c = (const MdtJoint *)(const void *)j;
    const int side = c->base.side[0].body ? 0 : 1;
    const double pull = keaLength(c->force.body[side].lin);
    return mdt_real(side == 0 ? pull : pull / d->coordinate[1].factor);
}
