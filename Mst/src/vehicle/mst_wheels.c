/* Wheels: the mass that each carries, the ground below, the tyre's forces, the transform that is drawn. */
#include "vehicle/mst_vehicle_i.h"
#include "McdQuery.h"
#include "MdtBody.h"
#include "MdtWorld.h"
#include <float.h>

/* ---- balance ----------------------------------------------------------------------------------------------------- */

/* Solves A x = b, A symmetric and positive definite, in place. */
static void solve3(double A[3][3], double x[3]) {
    for (int i = 0; i < 3; i++)
        for (int k = i + 1; k < 3; k++) {
            const double factor = A[k][i] / A[i][i];
            for (int j = i; j < 3; j++)
                A[k][j] -= factor * A[i][j];
            x[k] -= factor * x[i];
        }
    for (int i = 2; i >= 0; i--) {
        for (int k = i + 1; k < 3; k++)
            x[i] -= A[i][k] * x[k];
        x[i] /= A[i][i];
    }
}

/* The masses that wheels carry: of those that balance the chassis the ones with the smallest sum of squares, which are
 * linear in the wheels' places. */
static void distribute(MstVehicle *v, const double centre[3], double mass) {
    const int count = v->wheelCount;
    double A[3][3] = {{0}}, x[3] = {mass, 0, 0}, size = 0;
    double place[MST_VEHICLE_WHEELS][3];
    for (int i = 0; i < count; i++) {
        double from[3];
        for (int k = 0; k < 3; k++)
            from[k] = (double)v->wheel[i]->params.position[k] - centre[k];
        place[i][0] = 1;
        place[i][1] = keaDot(from, v->forward);
        place[i][2] = keaDot(from, v->left);
        size = fmax(size, keaDot(from, from));
        for (int k = 0; k < 3; k++)
            for (int j = 0; j < 3; j++)
                A[k][j] += place[i][k] * place[i][j];
    }
    A[1][1] += 1e-12 * size + DBL_MIN; /* wheels may be in one line */
    A[2][2] += 1e-12 * size + DBL_MIN;
    solve3(A, x);
    for (int i = 0; i < count; i++)
        v->wheel[i]->mass = fmax(keaDot(place[i], x), 0.02 * mass / count);
}

static void placeWheel(const MstVehicle *v, MstWheel *w, double g) {
    const MstWheelParams *p = &w->params;
    const double rate = 2 * ME_PI * (double)p->frequency, bump = (double)p->bump;
    MdtBclGroundWheel *d = w->data;
    d->stiffness = w->stiffness = p->stiffness > 0 ? (double)p->stiffness : w->mass * rate * rate;
    d->damping = 2 * (double)p->dampingRatio * sqrt(d->stiffness * w->mass);
    d->freeLength = w->freeLength = bump + w->mass * g / d->stiffness;
    d->low = 0;
    d->mass = w->mass;
    d->radius = (double)p->radius;
    d->shape = (MdtBclWheelShape)v->params.cast;
    w->length = p->droop > 0 ? bump + (double)p->droop : d->freeLength;
    if (v->load[4] == 0)
        w->length = fmax(w->length, bump);
    for (int k = 0; k < 3; k++)
        w->position[k] = (double)p->position[k] + bump * v->up[k];
    if (!d->isOnGround)
        d->length = w->length;
}

void mst_vehicleBalance(MstVehicle *v, MdtBodyID b) {
    MeVector3 centre, gravity;
    double load[5];
    MdtBodyGetCenterOfMassRelativePosition(b, centre);
    MdtWorldGetGravity(v->universe->world, gravity);
    load[0] = (double)MdtBodyGetMass(b);
    for (int i = 0; i < 3; i++)
        load[1 + i] = (double)centre[i];
    load[4] = (double)(MeVector3Magnitude(gravity) * MdtBodyGetGravityFactor(b));
    if (memcmp(load, v->load, sizeof load) == 0)
        return;
    memcpy(v->load, load, sizeof load);
    distribute(v, load + 1, load[0]);
    for (int i = 0; i < v->wheelCount; i++) {
        v->wheel[i]->data = mst_wheelData(v->wheel[i], b);
        if (v->wheel[i]->data)
            placeWheel(v, v->wheel[i], fabs(load[4]));
    }
}

/* ---- the ground -------------------------------------------------------------------------------------------------- */

MeBool mst_wheelHasGround(const MstWheel *w) {
    return w->ground && McdModelIsValid(w->ground) && McdModelGetSerial(w->ground) == w->groundSerial;
}

static int MEAPI isGround(McdModelID cm, void *vehicle) {
    const MstVehicle *v = vehicle;
    for (int i = 0; i < v->wheelCount && v->params.cast == kMstVehicleBodies; i++)
        if (cm == v->wheel[i]->model)
            return 0;
    if (cm == v->chassis || (mst_bodyOf(cm) && mst_bodyOf(cm) == mst_bodyOf(v->chassis)))
        return 0;
    return v->params.filter ? v->params.filter(cm, v->params.filterData) : McdQueryByPairs(cm, v->chassis);
}

MeBool mst_wheelIsGroundChanged(const MstVehicle *v, const MstWheel *w) {
    if (!w->ground)
        return MEFALSE;
    if (!mst_wheelHasGround(w) || !McdModelGetSpace(w->ground) || McdModelIsSensor(w->ground) ||
        !isGround(w->ground, (void *)v))
        return METRUE;
    return !mst_freeBodyOf(w->ground) && McdModelGetStamp(w->ground) != w->groundStamp;
}

/* Whether its shape is cast, not a ray. */
static MeBool isShape(const MstWheel *w) {
    return w->shape && !w->model;
}

/* A point of the chassis in the world. */
static void toWorld(const MdtKeaTransformation *pose, const double local[3], double world[3]) {
    keaApply(world, pose->R, local);
    keaAddScaled(world, 1, pose->pos);
}

void mst_wheelSteer(const MstVehicle *v, MstWheel *w, double angle) {
    w->steering = angle;
    keaScale(w->forward, cos(angle), v->forward);
    keaAddScaled(w->forward, sin(angle), v->left);
    keaCross(w->axle, v->up, w->forward);
}

static void setAxes(MeMatrix4 tm, const double x[3], const double y[3], const double z[3], const double position[3]) {
    for (int k = 0; k < 3; k++) {
        tm[0][k] = (MeReal)x[k];
        tm[1][k] = (MeReal)y[k];
        tm[2][k] = (MeReal)z[k];
        tm[3][k] = (MeReal)position[k];
    }
    tm[0][3] = tm[1][3] = tm[2][3] = 0;
    tm[3][3] = 1;
}

/* The path of the wheel's centre, or of the end of a ray: from above its stop, so that it finds ground that is near. */
typedef struct Path {
    double start[3], by[3], up[3], length;
} Path;

static void pathOf(const MstVehicle *v, const MstWheel *w, const MdtKeaTransformation *pose, Path *path) {
    const double radius = (double)w->params.radius;
    toWorld(pose, w->position, path->start);
    keaApply(path->up, pose->R, v->up);
    keaAddScaled(path->start, radius, path->up);
    path->length = w->length + (isShape(w) ? 1 : 2) * radius;
    keaScale(path->by, -path->length, path->up);
}

static void castRays(const MstVehicle *v, const Path path[], McdCastResult hit[]) {
    McdRay ray[MST_VEHICLE_WHEELS];
    for (int i = 0; i < v->wheelCount; i++)
        for (int k = 0; k < 3; k++) {
            ray[i].from[k] = (MeReal)path[i].start[k];
            ray[i].by[k] = (MeReal)path[i].by[k];
        }
    McdSpaceCastRays(v->universe->space, ray, v->wheelCount, isGround, (void *)(size_t)v, hit);
}

static void castShapes(const MstVehicle *v, const MdtKeaTransformation *pose, const Path path[], McdCastResult hit[]) {
    McdShapeCast cast[MST_VEHICLE_WHEELS];
    for (int i = 0; i < v->wheelCount; i++) {
        const MstWheel *w = v->wheel[i];
        double x[3], y[3], z[3];
        keaApply(x, pose->R, w->forward);
        keaApply(z, pose->R, w->axle);
        keaCross(y, z, x);
        cast[i].geometry = w->shape;
        setAxes(cast[i].tm, x, y, z, path[i].start);
        for (int k = 0; k < 3; k++)
            cast[i].by[k] = (MeReal)path[i].by[k];
    }
    McdSpaceCastGeometries(v->universe->space, cast, v->wheelCount, isGround, (void *)(size_t)v, hit);
}

/* Casts each wheel along its path. */
static void castAll(const MstVehicle *v, const MdtKeaTransformation *pose, const Path path[], McdCastResult hit[]) {
    if (v->wheelCount > 0 && isShape(v->wheel[0]))
        castShapes(v, pose, path, hit);
    else
        castRays(v, path, hit);
}

static const MstBridgeRecord *bridgeOf(const MstVehicle *v) {
    const MstUniverse *u = v->universe;
    return u->bridge && MeHandleIsLive(u->bridge, MST_BRIDGE) ? (const MstBridgeRecord *)u->bridge : 0;
}

MeBool mst_vehicleHasMaterial(const MstVehicle *v, int material) {
    const MstBridgeRecord *b = bridgeOf(v);
    return material == -1 || (material >= 0 && b && (unsigned)material < b->materialCount);
}

/* The coefficient of friction of contacts; 1: the program has not set it. */
static double coefficientOf(const MdtBclContactParams *params) {
    if (params->type == MdtContactTypeFrictionZero)
        return params->options & MdtBclContactOptionTypeSet ? 0 : 1;
    return params->model1 == MdtFrictionModelBox ? 1 : (double)params->frictioncoeff1;
}

/* The factor of the tyre's curves on ground of a material. */
static double frictionOn(const MstVehicle *v, const MstWheel *w, MstMaterialID ground) {
    static const double min = 1e-3; /* a tyre without any friction has no slip at its peak */
    const MstBridgeRecord *b = w->params.material >= 0 ? bridgeOf(v) : 0;
    if (!b || ground >= b->materialCount || (unsigned)w->params.material >= b->materialCount)
        return 1;
    const MstMaterialPair *pair = mst_materialPair(b, (MstMaterialID)w->params.material, ground);
    return keaMax(coefficientOf(&pair->params), min);
}

/* Takes what the cast has hit, if it is no wall, and measures how far the wheel's centre is from its plane. False: the
 * wheel hangs. */
static MeBool findGround(const MstVehicle *v, MstWheel *w, const Path *path, const McdCastResult *hit) {
    static const double minSlope = 0.2; /* cosine of the suspension's angle to the normal: steeper ground is a wall */
    double from[3];
    w->ground = 0;
    w->friction = 1;
    if (!hit->model)
        return MEFALSE;
    for (int k = 0; k < 3; k++) {
        w->normal[k] = (double)hit->normal[k];
        w->point[k] = (double)hit->position[k];
        from[k] = path->start[k] + (double)hit->fraction * path->by[k] - w->point[k];
    }
    const double slope = keaDot(w->normal, path->up);
    if (!(slope >= minSlope))
        return MEFALSE;
    w->data->distance = isShape(w) ? keaDot(from, w->normal) : (double)w->params.radius * slope;
    w->data->length = (double)hit->fraction * path->length - (isShape(w) ? 1 : 2) * (double)w->params.radius;
    w->friction = frictionOn(v, w, hit->material);
    w->ground = hit->model;
    w->groundSerial = McdModelGetSerial(hit->model);
    w->groundStamp = McdModelGetStamp(hit->model);
    return METRUE;
}

static void placeJoint(const MstVehicle *v, MstWheel *w, MdtBodyID b) {
    MdtWheelPlace place;
    const MdtBodyID found = w->ground ? mst_bodyInWorld(v, w->ground) : 0, ground = found != b ? found : 0;
    keaCopy(place.position, w->position);
    keaCopy(place.up, v->up);
    keaCopy(place.forward, w->forward);
    keaCopy(place.point, w->point);
    keaCopy(place.normal, w->ground ? w->normal : v->up);
    MdtGroundWheelPlace(w->joint, &place, ground);
}

/* ---- the tyre ---------------------------------------------------------------------------------------------------- */

/* Friction over normalized slip s, of a tyre along or across. */
static double frictionPerSlip(const MstWheel *w, int k, double s) {
    const double minSlip = 1e-4, at = fmax(s, minSlip);
    return mst_curveAt(k == 0 ? &w->params.along : &w->params.across, at * w->peak[k]) / at;
}

/* The tyre's law of this step. At slips below the peak it is linear: the secant of the curve at the last step's slip,
 * bounded by what the ellipse leaves of the force in the other direction. Beyond the peak the tyre slides: the forces
 * are those of the curves, in the direction of the last step's slip.
 * Slips that friction can stop within a step are below the peak: so a parked tyre sticks. */
static void setTyre(MstWheel *w, double h) {
    MdtBclGroundWheel *d = w->data;
    const double tread = d->radius * d->spin, speed = fmax(fabs(d->velocity[0]), fabs(tread));
    const double weight = w->stiffness * (w->freeLength - (double)w->params.bump); /* that it carries at rest */
    const double load = w->friction * fmax(fmax(d->load, 1e-3 * weight), 1e-12 * w->stiffness * w->freeLength);
    const double slide[2] = {d->velocity[0] - tread, d->velocity[1]};
    double unit[2], s = 0;
    for (int k = 0; k < 2; k++) {
        unit[k] = slide[k] / fmax(w->peak[k] * speed, w->peakForce[k] * load / w->mass * h + DBL_MIN);
        s += unit[k] * unit[k];
        w->slip[k] = speed > 0 ? (k == 0 ? -1 : 1) * slide[k] / speed : 0;
    }
    s = sqrt(s);
    for (int k = 0; k < 2; k++) {
        const double max = w->peakForce[k] * load, at = fmin(s, 1);
        const double other = w->peakForce[1 - k] * load, used = fmin(fabs(d->force[1 - k]) / fmax(other, DBL_MIN), 1);
        d->slip[k] = w->peak[k] * speed / fmax(frictionPerSlip(w, k, at) * load, DBL_MIN);
        d->bound[k] =
            s <= 1 ? max * sqrt(fmax(1 - used * used, 0.01)) : frictionPerSlip(w, k, s) * load * fabs(unit[k]);
    }
}

/* Anti-roll bars: one row for both wheels if they stand on the same. A wheel that hangs is held between spring and bar,
 * which are in series for the other one. On different bodies each wheel has the other one's last compression. */
static void setBar(MstWheel *w, MstWheel *other) {
    MdtBclGroundWheel *d = w->data, *o = other->data;
    const double bar = ((double)w->params.antiRoll + (double)other->params.antiRoll) / 2;
    d->barStiffness = o->barStiffness = 0;
    if (!(bar > 0) || !(d->isOnGround || o->isOnGround))
        return;
    if (d->isOnGround && o->isOnGround && MdtGroundWheelJoin(w->joint, other->joint, bar))
        return;
    for (int k = 0; k < 2; k++) {
        MdtBclGroundWheel *one = k == 0 ? d : o, *two = k == 0 ? o : d;
        const double stiffness = two->isOnGround ? bar : bar * two->stiffness / (bar + two->stiffness);
        const double zero = one->freeLength - (two->isOnGround ? two->freeLength - two->length : 0);
        one->freeLength = (one->stiffness * one->freeLength + stiffness * zero) / (one->stiffness + stiffness);
        one->stiffness += stiffness;
    }
}

/* The bar's force is in the joint of the first wheel. */
static void shareBar(const MstWheel *w) {
    const MdtBclGroundWheel *d = w->data;
    MdtBclGroundWheel *o = w->twin ? w->twin->data : 0;
    if (d && o && d->barForce != 0 && o->isOnGround)
        o->load = fmax(o->load - d->barForce / o->slope, 0);
}

/* ---- the step ---------------------------------------------------------------------------------------------------- */

/* Whether in the last step a brake has stopped a wheel on the ground that does not slide. */
static MeBool isParked(const MstVehicle *v) {
    static const double sliding = 1 - 1e-6; /* of its bound: the force of a tyre that slides, but for rounding */
    for (int i = 0; i < v->wheelCount; i++) {
        const MdtBclGroundWheel *d = v->wheel[i]->data;
        if (d && d->isOnGround && d->isLocked && fabs(d->force[0]) < sliding * d->bound[0] && !v->wheel[i]->model)
            return METRUE;
    }
    return MEFALSE;
}

static void setData(MstWheel *w, MeBool isOnGround, MeBool isParked, double h) {
    MdtBclGroundWheel *d = w->data;
    d->isParked = isParked;
    if (isOnGround && !d->isOnGround)
        d->load = d->stiffness * fmax(d->freeLength - d->length, 0);
    d->isOnGround = isOnGround;
    d->barStiffness = 0;
    d->stiffness = w->stiffness;
    d->freeLength = w->freeLength;
    d->inertia = w->inertia;
    d->drive = w->torque;
    d->brake = w->brake;
    if (!isOnGround)
        d->length = w->length;
    setTyre(w, h);
}

void mst_vehicleCast(MstVehicle *v, MdtBodyID b, double h) {
    MdtKeaTransformation pose;
    Path path[MST_VEHICLE_WHEELS];
    McdCastResult hit[MST_VEHICLE_WHEELS];
    MdtBodyGetExactPose(b, &pose);
    for (int i = 0; i < v->wheelCount; i++)
        pathOf(v, v->wheel[i], &pose, &path[i]);
    castAll(v, &pose, path, hit);
    const MeBool isAnyParked = isParked(v);
    for (int i = 0; i < v->wheelCount; i++) {
        MstWheel *w = v->wheel[i];
        if (!w->data)
            continue;
        setData(w, findGround(v, w, &path[i], &hit[i]), isAnyParked, h);
        if (!w->model)
            placeJoint(v, w, b);
    }
    for (int i = 0; i < v->wheelCount; i++) {
        MstWheel *w = v->wheel[i];
        if (w->isFirst && w->data && w->twin->data && !w->model)
            setBar(w, w->twin);
    }
}

void mst_vehicleShow(MstVehicle *v, MdtBodyID b) {
    MdtKeaTransformation pose;
    MdtBodyGetExactPose(b, &pose);
    for (int i = 0; i < v->wheelCount; i++) {
        MstWheel *w = v->wheel[i];
        double place[3], centre[3], x[3], y[3], z[3], turned[3];
        const double length = w->data ? w->data->length : w->length, angle = w->data ? w->data->angle : 0;
        if (w->model) {
            mst_wheelBodyShow(w);
            continue;
        }
        shareBar(w);
        keaCopy(place, w->position);
        keaAddScaled(place, -length, v->up);
        toWorld(&pose, place, centre);
        keaScale(turned, cos(angle), w->forward); /* rolls from up to forward */
        keaAddScaled(turned, -sin(angle), v->up);
        keaApply(x, (const double(*)[3])pose.R, turned);
        keaApply(z, (const double(*)[3])pose.R, w->axle);
        keaCross(y, z, x);
        setAxes(w->transform, x, y, z, centre);
    }
}
