/* Vehicles: their life, what the program asks of them, and their steps. */
#include "vehicle/mst_vehicle_i.h"
#include "McdCylinder.h"
#include "McdGeometry.h"
#include "McdSphere.h"
#include "MdtBody.h"
#include "MdtWorld.h"
#include "MeMessage.h"

static MeBool isVehicle(MstVehicleID v, const char *function) {
    if (v && MST_IS_KNOWN(v, MST_VEHICLE) && v->magic == MST_VEHICLE)
        return METRUE;
    mst_warnGone(v, "vehicle", function);
    return MEFALSE;
}

/* ---- defaults ---------------------------------------------------------------------------------------------------- */

static MeBool isUniverse(const void *params, MstUniverseID u, const char *function) {
    const char *member = !params ? "params" : !u || !MST_IS_KNOWN(u, MST_UNIVERSE) ? "universe" : 0;
    if (member)
        MeWarning(1, "%s: the %s is null, or has been destroyed", function, member);
    return !member;
}

static void setAxes(MstVehicleParams *params, MdtWorldID w) {
    MeVector3 gravity;
    MdtWorldGetGravity(w, gravity);
    const MeReal g = MeVector3Magnitude(gravity);
    params->up[2] = g > 0 ? 0 : 1;
    for (int i = 0; i < 3 && g > 0; i++)
        params->up[i] = -gravity[i] / g;
    params->forward[MeFabs(params->up[0]) < (MeReal)0.7 ? 0 : 1] = 1;
}

void MEAPI MstVehicleSetDefaults(MstVehicleParams *params, MstUniverseID u) {
    static const MeReal ratio[] = {(MeReal)3.6, (MeReal)2.1, (MeReal)1.4, 1, (MeReal)0.8};
    if (!isUniverse(params, u, "MstVehicleSetDefaults"))
        return;
    const MeReal length = u->sizes.lengthScale, mass = u->sizes.massScale, torque = mass * length * length;
    *params = (MstVehicleParams){
        .torque = {4, {{1000, 120 * torque}, {3000, 180 * torque}, {5000, 190 * torque}, {6500, 140 * torque}}},
        .idle = 900,
        .redline = 6500,
        .engineInertia = (MeReal)0.15 * torque,
        .engineBraking = 40 * torque,
        .gears = 5,
        .reverse = (MeReal)3.4,
        .finalDrive = (MeReal)3.9,
        .shiftUp = 5800,
        .shiftDown = 2200,
        .shiftTime = (MeReal)0.2,
        .steeringRate = 3,
        .drag = (MeReal)0.4 * mass / length,
        .leanFrequency = 2};
    memcpy(params->gear, ratio, sizeof ratio);
    setAxes(params, u->world);
}

void MEAPI MstWheelSetDefaults(MstWheelParams *params, MstUniverseID u) {
    static const MstCurve tyre = {
        5, {{0, 0}, {(MeReal)0.05, (MeReal)0.75}, {(MeReal)0.1, 1}, {(MeReal)0.3, (MeReal)0.9}, {1, (MeReal)0.8}}};
    if (!isUniverse(params, u, "MstWheelSetDefaults"))
        return;
    const MeReal length = u->sizes.lengthScale, mass = u->sizes.massScale, torque = mass * length * length;
    *params = (MstWheelParams){.radius = (MeReal)0.32 * length,
                               .width = (MeReal)0.2 * length,
                               .inertia = 1 * torque,
                               .bump = (MeReal)0.12 * length,
                               .frequency = (MeReal)1.5,
                               .dampingRatio = (MeReal)0.4,
                               .brake = 1500 * torque,
                               .rollingResistance = (MeReal)0.012,
                               .along = tyre,
                               .across = tyre,
                               .material = -1};
}

/* ---- life -------------------------------------------------------------------------------------------------------- */

static void setParams(MstVehicleID v, const MstVehicleParams *p) {
    v->params = *p;
    for (int i = 0; i < 3; i++) {
        v->forward[i] = (double)p->forward[i];
        v->up[i] = (double)p->up[i];
    }
    keaScale(v->forward, 1 / keaLength(v->forward), v->forward);
    keaAddScaled(v->up, -keaDot(v->up, v->forward), v->forward);
    keaScale(v->up, 1 / keaLength(v->up), v->up);
    keaCross(v->left, v->up, v->forward);
    v->engineSpeed = (double)p->idle * ME_PI / 30;
}

static void append(MstVehicleID v) {
    MstVehicleID *last = &v->universe->vehicles;
    while (*last)
        last = &(*last)->next;
    *last = v;
}

static MeBool hasVehicle(const MstUniverse *u, McdModelID chassis) {
    for (const MstVehicle *v = u->vehicles; v; v = v->next)
        if (v->chassis == chassis && v->chassisSerial == McdModelGetSerial(chassis))
            return METRUE;
    return MEFALSE;
}

MstVehicleID MEAPI MstVehicleCreate(MstUniverseID u, McdModelID chassis, const MstVehicleParams *params) {
    const char *fault = !u || !MST_IS_KNOWN(u, MST_UNIVERSE)    ? "the universe is null, or has been destroyed"
                        : !chassis || !McdModelIsValid(chassis) ? "the chassis is null, or has been destroyed"
                        : !params                               ? "params is null"
                        : !McdModelGetBody(chassis)             ? "the chassis has no body"
                        : MdtBodyGetWorld(McdModelGetBody(chassis)) != u->world
                            ? "the chassis belongs to another universe"
                        : hasVehicle(u, chassis) ? "the chassis has a vehicle: destroy that first, or add wheels to it"
                                                 : mst_vehicleFault(params);
    if (fault) {
        MeWarning(1, "MstVehicleCreate: %s", fault);
        return 0;
    }
    MstVehicleID v = MeMemoryTakeZeroed(1, sizeof *v, "MstVehicleCreate", "a vehicle");
    if (!v)
        return 0;
    v->magic = MST_VEHICLE;
    v->universe = u;
    v->chassis = chassis;
    v->chassisSerial = McdModelGetSerial(chassis);
    v->isAutomatic = METRUE;
    v->gear = 1;
    setParams(v, params);
    append(v);
    MeHandleEnter(&v->handle, v, MST_VEHICLE);
    return v;
}

static void freeVehicle(MstVehicleID v) {
    for (int i = 0; i < v->wheelCount; i++)
        MeMemoryGive(v->wheel[i]);
    MeHandleLeave(&v->handle);
    v->magic = 0;
    MeMemoryGive(v);
}

static void MEAPI destroyDeferred(const MeLater *later) {
    if (MeHandleIsLive(later->object, MST_VEHICLE))
        MstVehicleDestroy(later->object);
}

/* The stage that is active while vehicles are visited; null: the program has destroyed the bridge. */
static MeStage *stageOf(const MstUniverse *u) {
    return u->bridge && MeHandleIsLive(u->bridge, MST_BRIDGE) ? &((MstBridgeRecord *)u->bridge)->stage : 0;
}

static void removeWheels(const MstVehicle *v) {
    const MeBool hasWorld = MdtWorldIsValid(v->universe->world);
    for (int i = 0; i < v->wheelCount; i++) {
        if (hasWorld)
            MdtGroundWheelDestroy(v->wheel[i]->joint, v->wheel[i]->serial);
        if (hasWorld)
            mst_wheelEndBody(v->wheel[i]);
        if (v->wheel[i]->shape && mst_vehicleBody(v)) /* else the framework destroys it */
            McdGeometryDestroy(v->wheel[i]->shape);
    }
}

void MEAPI MstVehicleDestroy(MstVehicleID v) {
    if (!v || !isVehicle(v, "MstVehicleDestroy"))
        return;
    const MeLater later = {.carryOut = destroyDeferred, .object = v};
    MeStage *stage = stageOf(v->universe);
    const MeWhen when = stage ? MeStageWhen(stage, MST_GUARD_PAIRS, "MstVehicleDestroy") : MeWhenNow;
    if (when == MeWhenStageEnds)
        MeStageDefer(stage, MST_GUARD_PAIRS, &later, "MstVehicleDestroy");
    if (when != MeWhenNow)
        return;
    MstVehicleID *at = &v->universe->vehicles;
    while (*at != v)
        at = &(*at)->next;
    *at = v->next;
    removeWheels(v);
    freeVehicle(v);
}

void mst_vehiclesDestroy(MstUniverse *u) {
    while (u->vehicles) {
        MstVehicleID v = u->vehicles;
        u->vehicles = v->next;
        freeVehicle(v);
    }
}

MdtBodyID mst_vehicleBody(const MstVehicle *v) {
    const MeBool isSame = McdModelIsValid(v->chassis) && McdModelGetSerial(v->chassis) == v->chassisSerial;
    return isSame ? mst_bodyInWorld(v, v->chassis) : 0;
}

MdtBodyID mst_bodyInWorld(const MstVehicle *v, McdModelID cm) {
    const MdtBodyID b = mst_bodyOf(cm);
    return b && MdtBodyGetWorld(b) == v->universe->world ? b : 0;
}

/* ---- wheels ------------------------------------------------------------------------------------------------------ */

static void findPeaks(MstWheel *w) {
    const MstCurve *const curve[2] = {&w->params.along, &w->params.across};
    w->peakForce[0] = w->peakForce[1] = 0;
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < curve[k]->count; i++)
            if ((double)curve[k]->point[i].y > w->peakForce[k]) {
                w->peakForce[k] = (double)curve[k]->point[i].y;
                w->peak[k] = (double)curve[k]->point[i].x;
            }
}

/* False: the shape to cast could not be created. */
static MeBool makeShape(const MstVehicle *v, MstWheel *w) {
    const McdFrameworkID frame = v->universe->frame;
    if (v->params.cast == kMstVehicleSphere)
        w->shape = (McdGeometryID)McdSphereCreate(frame, w->params.radius);
    if (v->params.cast == kMstVehicleCylinder)
        w->shape = (McdGeometryID)McdCylinderCreate(frame, w->params.radius, w->params.width);
    return v->params.cast == kMstVehicleRay || w->shape;
}

/* The joint of a wheel that is cast, or the body of one that is a body. False, after a message: no room. */
static MeBool makeWheel(MstVehicleID v, MstWheel *w, MdtBodyID body) {
    if (v->params.cast == kMstVehicleBodies) {
        MdtBodyGetExactPose(body, &v->seen);
        mst_wheelMakeBody(v, w, body, &v->seen);
        return mst_wheelHasBody(w);
    }
    if (makeShape(v, w))
        w->joint = MdtGroundWheelCreate(body, &w->serial);
    return w->joint != 0;
}

/* Whether a wheel before this one is of the same axle. */
static MeBool isOnEarlierAxle(const MstVehicle *v, int wheel) {
    for (int i = 0; i < wheel; i++)
        if (v->wheel[i]->params.axle == v->wheel[wheel]->params.axle)
            return METRUE;
    return MEFALSE;
}

/* Ties the first two wheels of each axle. */
static void pairWheels(const MstVehicle *v) {
    for (int i = 0; i < v->wheelCount; i++) {
        v->wheel[i]->twin = 0;
        v->wheel[i]->isFirst = MEFALSE;
    }
    for (int i = 0; i < v->wheelCount; i++)
        for (int k = i + 1; k < v->wheelCount && !isOnEarlierAxle(v, i) && !v->wheel[i]->twin; k++)
            if (v->wheel[k]->params.axle == v->wheel[i]->params.axle) {
                v->wheel[i]->twin = v->wheel[k];
                v->wheel[i]->isFirst = METRUE;
                v->wheel[k]->twin = v->wheel[i];
            }
}

/* What follows from the parameters of all wheels. */
static void fitWheels(MstVehicleID v, MdtBodyID body) {
    pairWheels(v);
    v->load[0] = 0;
    v->steered = 2;
    mst_vehicleBalance(v, body);
    mst_vehicleShow(v, body);
}

/* What is wrong with a wheel's parameters for this vehicle; null: nothing. */
static const char *faultOf(const MstVehicle *v, MdtBodyID body, const MstWheelParams *params) {
    return !params                                        ? "params is null"
           : !body                                        ? "the chassis has been destroyed"
           : !mst_vehicleHasMaterial(v, params->material) ? "material is neither -1 nor one of the bridge's"
                                                          : mst_wheelFault(params);
}

int MEAPI MstVehicleAddWheel(MstVehicleID v, const MstWheelParams *params) {
    if (!isVehicle(v, "MstVehicleAddWheel"))
        return -1;
    const MdtBodyID body = mst_vehicleBody(v);
    const char *fault =
        v->wheelCount == MST_VEHICLE_WHEELS ? "the vehicle has MST_VEHICLE_WHEELS wheels" : faultOf(v, body, params);
    if (fault || !MeProgramMayChange("MstVehicleAddWheel")) {
        if (fault)
            MeWarning(1, "MstVehicleAddWheel: %s", fault);
        return -1;
    }
    MstWheel *w = MeMemoryTakeZeroed(1, sizeof *w, "MstVehicleAddWheel", "a wheel");
    if (!w)
        return -1;
    w->params = *params;
    w->friction = 1;
    findPeaks(w);
    mst_wheelSteer(v, w, 0);
    if (!makeWheel(v, w, body)) {
        mst_wheelEndBody(w);
        if (w->shape)
            McdGeometryDestroy(w->shape);
        MeMemoryGive(w);
        return -1;
    }
    v->wheel[v->wheelCount++] = w;
    fitWheels(v, body);
    return v->wheelCount - 1;
}

static MstWheel *wheelOf(MstVehicleID v, int i, const char *function) {
    if (!isVehicle(v, function))
        return 0;
    if (i >= 0 && i < v->wheelCount)
        return v->wheel[i];
    MeWarning(1, "%s: the vehicle has no wheel %d; it has %d", function, i, v->wheelCount);
    return 0;
}

/* The chassis' body; null, with a warning: it has been destroyed. */
static MdtBodyID bodyOf(MstVehicleID v, const char *function) {
    const MdtBodyID b = isVehicle(v, function) ? mst_vehicleBody(v) : 0;
    if (!b && v && MST_IS_KNOWN(v, MST_VEHICLE))
        MeWarning(1, "%s: the vehicle's chassis has been destroyed: destroy the vehicle, too", function);
    return b;
}

/* Gives the wheel the shape of its new size. False, after a message: there is none, and it stays as it is. */
static MeBool remakeShape(const MstVehicle *v, MstWheel *w, const MstWheelParams *params) {
    MstWheel made = {.params = *params};
    if (!w->shape || (params->radius == w->params.radius && params->width == w->params.width))
        return METRUE;
    if (!makeShape(v, &made))
        return MEFALSE;
    McdGeometryDestroy(w->shape);
    w->shape = made.shape;
    return METRUE;
}

MeBool MEAPI MstVehicleSetWheelParams(MstVehicleID v, int wheel, const MstWheelParams *params) {
    MstWheel *w = wheelOf(v, wheel, "MstVehicleSetWheelParams");
    if (!w)
        return MEFALSE;
    const MdtBodyID body = mst_vehicleBody(v);
    const char *fault =
        w->model ? "the wheel is a body: its parameters are those that it was added with" : faultOf(v, body, params);
    if (fault)
        MeWarning(1, "MstVehicleSetWheelParams: %s; nothing is changed", fault);
    if (fault || !MeProgramMayChange("MstVehicleSetWheelParams") || !remakeShape(v, w, params))
        return MEFALSE;
    w->params = *params;
    findPeaks(w);
    fitWheels(v, body);
    v->hasChanged = METRUE;
    return METRUE;
}

MeBool MEAPI MstVehicleGetWheelParams(MstVehicleID v, int wheel, MstWheelParams *params) {
    const MstWheel *w = wheelOf(v, wheel, "MstVehicleGetWheelParams");
    if (w && !params)
        MeWarning(1, "MstVehicleGetWheelParams: params is null");
    if (!w || !params)
        return MEFALSE;
    *params = w->params;
    return METRUE;
}

MdtBclGroundWheel *mst_wheelData(MstWheel *w, MdtBodyID b) {
    return !w->model ? MdtGroundWheelGet(w->joint, w->serial, b) : mst_wheelHasBody(w) ? &w->own : 0;
}

/* ---- driving ----------------------------------------------------------------------------------------------------- */

static void set(MstVehicleID v, double *to, MeReal value, double low) {
    const double now = fmin(fmax((double)value, low), 1);
    v->hasChanged = v->hasChanged || now != *to;
    *to = now;
}

void MEAPI MstVehicleDrive(MstVehicleID v, MeReal throttle, MeReal steering, MeReal brake, MeReal handbrake) {
    if (!bodyOf(v, "MstVehicleDrive"))
        return;
    if (!MeRealIsValid(throttle) || !MeRealIsValid(steering) || !MeRealIsValid(brake) || !MeRealIsValid(handbrake)) {
        MeWarning(1, "MstVehicleDrive: a number is not finite; nothing is changed");
        return;
    }
    set(v, &v->throttle, throttle, -1);
    set(v, &v->steering, steering, -1);
    set(v, &v->brake, brake, 0);
    set(v, &v->handbrake, handbrake, 0);
}

void MEAPI MstVehicleSetGear(MstVehicleID v, int gear) {
    if (!isVehicle(v, "MstVehicleSetGear"))
        return;
    if (gear < -1 || gear > v->params.gears) {
        MeWarning(1, "MstVehicleSetGear: the gear is %d, it must be -1 .. %d; nothing is changed", gear,
                  v->params.gears);
        return;
    }
    v->hasChanged = v->hasChanged || gear != v->gear;
    v->isAutomatic = MEFALSE;
    v->gear = gear;
    v->shiftLeft = 0;
}

int MEAPI MstVehicleGetGear(MstVehicleID v) {
    return isVehicle(v, "MstVehicleGetGear") ? v->gear : 0;
}

void MEAPI MstVehicleSetAutomatic(MstVehicleID v, MeBool on) {
    if (!isVehicle(v, "MstVehicleSetAutomatic"))
        return;
    v->isAutomatic = on != 0;
    if (on && v->gear == 0)
        v->gear = 1;
}

MeBool MEAPI MstVehicleGetAutomatic(MstVehicleID v) {
    return isVehicle(v, "MstVehicleGetAutomatic") && v->isAutomatic;
}

/* ---- what it does ------------------------------------------------------------------------------------------------ */

MeReal MEAPI MstVehicleGetSpeed(MstVehicleID v) {
    const MdtBodyID b = bodyOf(v, "MstVehicleGetSpeed");
    return b ? (MeReal)mst_vehicleSpeed(v, b) : 0;
}

MeReal MEAPI MstVehicleGetEngineSpeed(MstVehicleID v) {
    return isVehicle(v, "MstVehicleGetEngineSpeed") ? (MeReal)(v->engineSpeed * 30 / ME_PI) : 0;
}

McdModelID MEAPI MstVehicleGetChassis(MstVehicleID v) {
    return isVehicle(v, "MstVehicleGetChassis") && mst_vehicleBody(v) ? v->chassis : 0;
}

int MEAPI MstVehicleGetWheelCount(MstVehicleID v) {
    return isVehicle(v, "MstVehicleGetWheelCount") ? v->wheelCount : 0;
}

MeMatrix4Ptr MEAPI MstVehicleGetWheelTransformPtr(MstVehicleID v, int wheel) {
    MstWheel *w = wheelOf(v, wheel, "MstVehicleGetWheelTransformPtr");
    return w ? w->transform : 0;
}

static void writeContact(const MstWheel *w, const MdtBclGroundWheel *g, MstWheelState *state) {
    const double bump = (double)w->params.bump;
    state->compression = (MeReal)(bump - g->length);
    state->spin = (MeReal)g->spin;
    state->angle = (MeReal)g->angle;
    if (!g->isOnGround || !mst_wheelHasGround(w))
        return;
    state->ground = w->ground;
    state->load = (MeReal)g->load;
    state->speed = (MeReal)g->velocity[0];
    for (int i = 0; i < 2; i++) {
        state->force[i] = (MeReal)g->force[i];
        state->slip[i] = (MeReal)w->slip[i];
    }
    for (int i = 0; i < 3; i++) {
        state->position[i] = (MeReal)w->point[i];
        state->normal[i] = (MeReal)w->normal[i];
    }
}

void MEAPI MstVehicleGetWheel(MstVehicleID v, int wheel, MstWheelState *state) {
    if (state)
        memset(state, 0, sizeof *state);
    MstWheel *w = wheelOf(v, wheel, "MstVehicleGetWheel");
    const MdtBodyID b = w ? mst_vehicleBody(v) : 0;
    const MdtBclGroundWheel *g = b ? mst_wheelData(w, b) : 0;
    if (!state || !w)
        return;
    state->steering = (MeReal)w->steering;
    if (g)
        writeContact(w, g, state);
}

/* ---- the step ---------------------------------------------------------------------------------------------------- */

/* Whether a sleeping vehicle has to wake. */
static MeBool isToWake(const MstVehicle *v) {
    MeBool isToWake = v->hasChanged || v->throttle != 0;
    for (int i = 0; i < v->wheelCount; i++)
        isToWake = isToWake || mst_wheelIsGroundChanged(v, v->wheel[i]);
    return isToWake;
}

static void begin(MstVehicle *v, double h) {
    const MdtBodyID b = mst_vehicleBody(v);
    v->isActive = MEFALSE;
    if (!b || (!MdtBodyIsEnabled(b) && !(isToWake(v) && MdtBodyWakeIfAsleep(b))))
        return;
    v->isActive = METRUE;
    v->step = h;
    for (int i = 0; i < v->wheelCount; i++)
        v->wheel[i]->data = mst_wheelData(v->wheel[i], b);
    mst_vehicleBalance(v, b);
    mst_vehicleDrive(v, b, h);
    mst_vehicleCast(v, b, h);
    mst_vehicleLock(v, b, h);
    for (int i = 0; i < v->wheelCount; i++)
        if (v->wheel[i]->model && v->wheel[i]->data)
            mst_wheelBodyDrive(v, v->wheel[i]);
    v->hasChanged = MEFALSE;
}

void mst_vehiclesFollow(const MstUniverse *u) {
    for (MstVehicle *v = u->vehicles; v; v = v->next) {
        const MdtBodyID b = v->params.cast == kMstVehicleBodies ? mst_vehicleBody(v) : 0;
        MdtKeaTransformation pose;
        if (!b)
            continue;
        MdtBodyGetExactPose(b, &pose);
        for (int i = 0; i < v->wheelCount && memcmp(&pose, &v->seen, sizeof pose) != 0; i++)
            mst_wheelBodyFollow(v, v->wheel[i], b, &pose);
        v->seen = pose;
    }
}

void mst_vehiclesBegin(MstUniverse *u, MeReal step) {
    if (!u->vehicles)
        return;
    MeStageBegin(stageOf(u), MST_GUARD_PAIRS);
    McdSpaceAllowQueries(u->space, METRUE);
    for (MstVehicle *v = u->vehicles; v; v = v->next)
        begin(v, (double)step);
    McdSpaceAllowQueries(u->space, MEFALSE);
    MeStageEnd(stageOf(u), MST_GUARD_PAIRS);
}

void mst_vehiclesEnd(const MstUniverse *u) {
    for (MstVehicle *v = u->vehicles; v; v = v->next) {
        const MdtBodyID body = v->isActive ? mst_vehicleBody(v) : 0;
        if (!body)
            continue;
        mst_vehicleEqualize(v, body, v->step);
        mst_vehicleShow(v, body);
        MdtBodyGetExactPose(body, &v->seen);
    }
}

void mst_vehiclesShift(const MstUniverse *u, const double by[3]) {
    for (MstVehicle *v = u->vehicles; v; v = v->next)
        for (int k = 0; k < 3; k++) {
            v->seen.pos[k] += by[k];
            for (int i = 0; i < v->wheelCount; i++) {
                v->wheel[i]->point[k] += by[k];
                v->wheel[i]->transform[3][k] = (MeReal)((double)v->wheel[i]->transform[3][k] + by[k]);
            }
        }
}
