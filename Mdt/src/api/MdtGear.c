/* API of the gear. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Gear, MdtBclGEAR)
MDT_JOINT_DATA(Gear, MdtBclGEAR, MdtBclCoupling, coupling)

static void engage(MdtGearID j) {
    MdtJoint *c = (MdtJoint *)(void *)j;
    MdtKeaTransformation pose[2];
    mdt_constraintPoses(&c->base, pose);
    const MdtKeaTransformation *const at[2] = {&pose[0], &pose[1]};
    MdtBclGearEngage(&c->bcl, at);
}

/* True for a finite number other than 0; otherwise warns. */
static MeBool isFactor(const char *caller, const char *what, MeReal x) {
    if (mdt_isFinite3(caller, what, x, 0, 0) && x != 0)
        return METRUE;
    if (x == 0)
        MeWarning(1, "%s: %s is 0; nothing is changed", caller, what);
    return MEFALSE;
}

static void couple(MdtGearID j, Data *d, MdtBclCoordinateKind second, double factor) {
    d->coordinate[1].kind = second;
    d->coordinate[0].factor = factor;
    engage(j);
}

void MEAPI MdtGearSetRatio(const MdtGearID j, const MeReal ratio) {
    Data *d = dataOf(j, __func__);
    if (d && isFactor(__func__, "the ratio", ratio))
        couple(j, d, MdtBclCoordinateAngle, ratio);
}

void MEAPI MdtGearSetTeeth(const MdtGearID j, const int first, const int second) {
    Data *d = dataOf(j, __func__);
    if (!d)
        return;
    if (first == 0 || second == 0)
        MeWarning(1, "%s: a number of teeth is 0; nothing is changed", __func__);
    else
        couple(j, d, MdtBclCoordinateAngle, (double)first / second);
}

void MEAPI MdtGearSetRack(const MdtGearID j, const MeReal radius) {
    Data *d = dataOf(j, __func__);
    if (d && isFactor(__func__, "the radius", radius))
        couple(j, d, MdtBclCoordinateSlide, radius);
}

MDT_JOINT_GETTER(Gear, Ratio, (MeReal)d->coordinate[0].factor)

void MEAPI MdtGearBodySetAxis(const MdtGearID j, const unsigned int bodyindex, const MeReal x, const MeReal y,
                              const MeReal z) {
    const double p[3] = {x, y, z};
    double o[3];
    if (!dataOf(j, __func__))
        return;
    mdt_chooseOrthogonal(p, o);
    mdt_constraintBodySetAxes((MdtConstraintID)j, bodyindex, x, y, z, (MeReal)o[0], (MeReal)o[1], (MeReal)o[2],
                              __func__);
    engage(j);
}

void MEAPI MdtGearSetHousing(const MdtGearID j, const MdtBodyID housing) {
    Data *d = dataOf(j, __func__);
    if (!d || (housing && !mdt_isBody(housing, __func__)))
        return;
    const MdtAttachment *side = ((MdtConstraintID)j)->side;
    if (housing && housing != side[0].body && housing != side[1].body) {
        MeWarning(1, "%s: the housing is none of the gear's bodies; nothing is changed", __func__);
        return;
    }
    d->housing = !housing ? MdtBclNO_SIDE : housing == side[0].body ? 0 : 1;
    engage(j);
}

MdtBodyID MEAPI MdtGearGetHousing(const MdtGearID j) {
    const Data *d = dataOf(j, __func__);
    return d && d->housing != MdtBclNO_SIDE ? ((MdtConstraintID)j)->side[d->housing].body : NULL;
}

void MEAPI MdtGearEngage(const MdtGearID j) {
    if (dataOf(j, __func__))
        engage(j);
}

MeReal MEAPI MdtGearGetCoordinate(const MdtGearID j, const unsigned int bodyindex) {
    MdtKeaTransformation pose[2];
    if (!dataOf(j, __func__) || !mdt_isSide(__func__, bodyindex))
        return 0;
    mdt_constraintPoses((MdtConstraintID)j, pose);
    const MdtKeaTransformation *const at[2] = {&pose[0], &pose[1]};
    return mdt_real(MdtBclCouplingCoordinate(&((MdtJoint *)(void *)j)->bcl, (int)bodyindex, at));
}

MeReal MEAPI MdtGearGetError(const MdtGearID j) {
    MdtKeaTransformation pose[2];
    if (!dataOf(j, __func__))
        return 0;
    mdt_constraintPoses((MdtConstraintID)j, pose);
    const MdtKeaTransformation *const at[2] = {&pose[0], &pose[1]};
    return mdt_real(MdtBclCouplingError(&((MdtJoint *)(void *)j)->bcl, at));
}
