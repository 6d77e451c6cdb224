/* Parameters of vehicles: what is wrong with them. */
#include "vehicle/mst_vehicle_i.h"

double mst_curveAt(const MstCurve *c, double x) {
    int i = 0;
    while (i < c->count && (double)c->point[i].x < x)
        i++;
    if (i == 0 || i == c->count)
        return (double)c->point[i == 0 ? 0 : c->count - 1].y;
    const double x0 = (double)c->point[i - 1].x, x1 = (double)c->point[i].x;
    const double y0 = (double)c->point[i - 1].y, y1 = (double)c->point[i].y;
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
}

static MeBool isCurve(const MstCurve *c) {
    if (c->count < 1 || c->count > MST_CURVE_POINTS)
        return MEFALSE;
    for (int i = 0; i < c->count; i++)
        if (!MeRealIsValid(c->point[i].x) || !MeRealIsValid(c->point[i].y) ||
            (i > 0 && !(c->point[i].x > c->point[i - 1].x)))
            return MEFALSE;
    return METRUE;
}

static MeBool areBetween(const MeReal value[], int count, double low, double high) {
    for (int i = 0; i < count; i++)
        if (!((double)value[i] >= low && (double)value[i] <= high))
            return MEFALSE;
    return METRUE;
}

static const double large = 1e15, small = 1e-9; /* beyond, products of parameters leave the numbers of MeReal */

/* Whether they span a plane. */
static MeBool areAxes(const MeVector3 forward, const MeVector3 up) {
    double f[3], u[3], across[3];
    for (int i = 0; i < 3; i++) {
        f[i] = (double)forward[i];
        u[i] = (double)up[i];
    }
    const double size = keaLength(f) * keaLength(u);
    keaCross(across, f, u);
    return size > 1e-12 && size < large && keaLength(across) > 1e-3 * size;
}

const char *mst_vehicleFault(const MstVehicleParams *p) {
    const MeReal notNegative[] = {p->engineInertia, p->engineBraking, p->shiftUp, p->shiftDown, p->shiftTime, p->drag};
    if (!areAxes(p->forward, p->up))
        return "forward or up is zero or not finite, or they are parallel";
    if ((unsigned int)p->cast > kMstVehicleBodies)
        return "cast is none of MstVehicleCast";
    if (!isCurve(&p->torque))
        return "torque is no curve: 1 .. MST_CURVE_POINTS points, with rising x";
    if (!areBetween(&p->idle, 1, small, (double)p->redline) || !((double)p->redline < large) || p->idle == p->redline)
        return "idle is not > 0 and < redline";
    if (!areBetween(notNegative, 6, 0, large))
        return "engineInertia, engineBraking, shiftUp, shiftDown, shiftTime or drag is negative or not finite";
    if (p->gears < 1 || p->gears > MST_VEHICLE_GEARS)
        return "gears is not 1 .. MST_VEHICLE_GEARS";
    if (!areBetween(p->gear, p->gears, small, 1e6) || !areBetween(&p->reverse, 1, small, 1e6) ||
        !areBetween(&p->finalDrive, 1, small, 1e6))
        return "a gear, reverse or finalDrive is not > 0, or beyond 1e6";
    if (!areBetween(&p->axleLock, 1, 0, 1) || !areBetween(&p->centreLock, 1, 0, 1))
        return "axleLock or centreLock is not 0 .. 1";
    if (!(p->steeringRate > 0) || !areBetween(&p->leanLimit, 1, 0, 1.4) ||
        !areBetween(&p->leanFrequency, 1, small, 1e6))
        return "steeringRate or leanFrequency is not > 0, or leanLimit is not 0 .. 1.4";
    return p->cast == kMstVehicleBodies && p->leanLimit > 0 ? "leanLimit is for wheels that are cast" : 0;
}

static MeBool isTyre(const MstCurve *c) {
    double peak = 0;
    if (!isCurve(c) || !(c->point[0].x >= 0))
        return MEFALSE;
    for (int i = 0; i < c->count; i++) {
        if (!((double)c->point[i].y >= 0 && (double)c->point[i].y < 1e6 && (double)c->point[i].x < 1e6))
            return MEFALSE;
        peak = (double)c->point[i].x > 1e-4 ? fmax(peak, (double)c->point[i].y) : peak;
    }
    for (int i = 0; i < c->count; i++)
        if ((double)c->point[i].x <= 1e-4 && (double)c->point[i].y >= peak)
            return MEFALSE;
    return peak > 1e-6;
}

const char *mst_wheelFault(const MstWheelParams *p) {
    const MeReal positive[] = {p->radius, p->width, p->bump};
    const MeReal notNegative[] = {p->droop, p->stiffness, p->dampingRatio, p->antiRoll,
                                  p->brake, p->handbrake, p->drive,        p->rollingResistance};
    if (!areBetween(p->position, 3, -16777216, 16777216))
        return "position is not finite, or beyond 2^24";
    if (!areBetween(positive, 3, small, 16777216))
        return "radius, width or bump is not > 0, or beyond 2^24";
    if (!areBetween(&p->inertia, 1, 1e-18, 1e18))
        return "inertia is not > 0, or beyond 1e18";
    if (!areBetween(notNegative, 8, 0, large))
        return "droop, stiffness, dampingRatio, antiRoll, brake, handbrake, drive or rollingResistance is negative or "
               "not finite";
    if (!(p->stiffness > 0) && !areBetween(&p->frequency, 1, small, 1e6))
        return "frequency is not > 0, or beyond 1e6, and there is no stiffness";
    if (p->axle < 0 || !areBetween(&p->steering, 1, -1.5, 1.5))
        return "axle is negative, or steering is not -1.5 .. 1.5";
    return isTyre(&p->along) && isTyre(&p->across)
               ? 0
               : "along or across is no tyre: a curve from x >= 0 on, y >= 0, its peak > 0 at x > 1e-4";
}
