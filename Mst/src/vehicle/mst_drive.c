/* What drives a vehicle: engine, gears, brakes, steering; the forces of air and balance.
 *
 * A driven wheel takes a share of the engine's inertia while a gear is in: I + w G² I_engine, w its share of the
 * torque, G the gear. The engine then turns as the mean of the wheels; below its idle speed the clutch slips. */
#include "vehicle/mst_vehicle_i.h"
#include "MdtBody.h"
#include "MdtWorld.h"

static const double turns = ME_PI / 30; /* rad/s of a turn per minute */

static void fromReal(double out[3], const MeReal a[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = (double)a[i];
}

/* A direction of the chassis in the world. */
static void toWorld(MdtBodyID b, const double local[3], double world[3]) {
    MdtKeaTransformation pose;
    MdtBodyGetExactPose(b, &pose);
    keaApply(world, (const double(*)[3])pose.R, local);
}

double mst_vehicleSpeed(const MstVehicle *v, MdtBodyID b) {
    MeVector3 velocity;
    double forward[3], along[3];
    MdtBodyGetLinearVelocity(b, velocity);
    toWorld(b, v->forward, forward);
    fromReal(along, velocity);
    return keaDot(along, forward);
}

/* ---- steering ---------------------------------------------------------------------------------------------------- */

/* m: where a wheel is along the vehicle's forward and left axes. */
static double placeOf(const MstWheel *w, const double axis[3]) {
    return keaDot(w->position, axis);
}

/* The place along the vehicle halfway between its foremost and its hindmost wheel. */
static double middleOf(const MstVehicle *v) {
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < v->wheelCount; i++) {
        low = fmin(low, placeOf(v->wheel[i], v->forward));
        high = fmax(high, placeOf(v->wheel[i], v->forward));
    }
    return (low + high) / 2;
}

/* The mean place along the vehicle, and the mean angle at full lock, of the wheels ahead of its middle, or of those
 * behind. */
static double meanPlace(const MstVehicle *v, MeBool isAhead, double *angle) {
    const double middle = middleOf(v);
    double sum = 0;
    int count = 0;
    *angle = 0;
    for (int i = 0; i < v->wheelCount; i++) {
        const MstWheel *w = v->wheel[i];
        const double place = placeOf(w, v->forward);
        if ((place > middle) != (isAhead != 0))
            continue;
        sum += place;
        *angle += (double)w->params.steering;
        count++;
    }
    *angle /= count > 0 ? count : 1;
    return count > 0 ? sum / count : 0;
}

/* 1/m: curvature of the way. At the place `behind` the vehicle moves aside by `slope` of its way. */
static double curvatureOf(const MstVehicle *v, double lock, double *behind, double *slope) {
    double front, rear;
    const double base = meanPlace(v, METRUE, &front);
    *behind = meanPlace(v, MEFALSE, &rear);
    *slope = tan(lock * rear);
    return fabs(base - *behind) > 1e-9 ? (tan(lock * front) - *slope) / (base - *behind) : 0;
}

/* The lean of the chassis to the left, rad. */
static double leanOf(const MstVehicle *v, MdtBodyID b, const double gravity[3]) {
    double up[3], forward[3], level[3], left[3];
    toWorld(b, v->up, up);
    toWorld(b, v->forward, forward);
    keaScale(level, -1, gravity);
    keaCross(left, level, forward);
    return atan2(keaDot(up, left), keaDot(up, level));
}

/* A motorcycle turns no more than it leans, and then some, for which the balance lets it lean more. */
static double leanedCurvature(const MstVehicle *v, MdtBodyID b, double curvature, const double gravity[3]) {
    static const double further = 0.1; /* rad */
    const double speed = mst_vehicleSpeed(v, b), g = keaLength(gravity), lean = leanOf(v, b, gravity);
    const double max = fmin((double)v->params.leanLimit, fmax(curvature > 0 ? lean : -lean, 0) + further);
    const double limit = g * tan(max) / fmax(speed * speed, 1e-9);
    return fmin(fmax(curvature, -limit), limit);
}

/* The wheels of one that does not lean stand by the lock alone. */
static void steer(MstVehicle *v, MdtBodyID b, const double gravity[3], double h) {
    const double by = (double)v->params.steeringRate * h;
    double behind, slope;
    v->lock += fmin(fmax(v->steering - v->lock, -by), by);
    if (v->lock == v->steered && !(v->params.leanLimit > 0))
        return;
    v->steered = v->lock;
    const double target = curvatureOf(v, v->lock, &behind, &slope);
    const double curvature = v->params.leanLimit > 0 ? leanedCurvature(v, b, target, gravity) : target;
    const double upright =
        v->params.leanLimit > 0 ? fabs(cos(leanOf(v, b, gravity))) : 1; /* a wheel that leans turns more */
    for (int i = 0; i < v->wheelCount; i++) {
        MstWheel *w = v->wheel[i];
        const double ahead = placeOf(w, v->forward) - behind, aside = placeOf(w, v->left);
        const double toSide = upright * (slope + curvature * ahead);
        mst_wheelSteer(v, w, w->params.steering != 0 ? atan(toSide / fmax(1 - curvature * aside, 1e-3)) : 0);
    }
}

/* ---- engine and gears -------------------------------------------------------------------------------------------- */

/* Turns of the engine for one of the driven wheels, in a gear; 0: neutral. */
static double ratioOfGear(const MstVehicle *v) {
    const double last = (double)v->params.finalDrive;
    return v->gear > 0   ? (double)v->params.gear[v->gear - 1] * last
           : v->gear < 0 ? -(double)v->params.reverse * last
                         : 0;
}

static double ratioOf(const MstVehicle *v) {
    return v->shiftLeft > 0 ? 0 : ratioOfGear(v);
}

static double shareOf(const MstVehicle *v, const MstWheel *w) {
    double sum = 0;
    for (int i = 0; i < v->wheelCount; i++)
        sum += (double)v->wheel[i]->params.drive;
    return sum > 0 ? (double)w->params.drive / sum : 0;
}

static double spinOf(const MstWheel *w) {
    return w->data ? w->data->spin : 0;
}

/* rad/s: the mean of the driven wheels. */
static double drivenSpin(const MstVehicle *v) {
    double sum = 0;
    for (int i = 0; i < v->wheelCount; i++)
        sum += shareOf(v, v->wheel[i]) * spinOf(v->wheel[i]);
    return sum;
}

static void shift(MstVehicle *v, int gear) {
    v->gear = gear;
    v->shiftLeft = (double)v->params.shiftTime;
}

/* m/s, over the ground, forwards: the mean of the wheels that stand on it, or of the driven ones of them; off the
 * ground, and of wheels that are bodies, that of the chassis. Returns whether a wheel stands on it. */
static MeBool speedOverGround(const MstVehicle *v, MdtBodyID b, MeBool isOfDriven, double *speed) {
    double sum = 0;
    int count = 0;
    for (int i = 0; i < v->wheelCount; i++) {
        const MstWheel *w = v->wheel[i];
        if (!w->data || !w->data->isOnGround || (isOfDriven && !(w->params.drive > 0)))
            continue;
        sum += w->model ? mst_vehicleSpeed(v, b) : w->data->velocity[0];
        count++;
    }
    *speed = count > 0 ? sum / count : mst_vehicleSpeed(v, b);
    return count > 0;
}

/* m: the mean of the driven wheels. */
static double drivenRadius(const MstVehicle *v) {
    double sum = 0;
    for (int i = 0; i < v->wheelCount; i++)
        sum += shareOf(v, v->wheel[i]) * (double)v->wheel[i]->params.radius;
    return sum;
}

/* Changes gears by the turns that the engine would have if the wheels did not slip: what spins on ice gets no higher
 * gear, and wheels that brakes stop no lower one. In the air it changes none. */
static void changeGear(MstVehicle *v, MdtBodyID b) {
    double speed;
    const double radius = drivenRadius(v);
    if (v->shiftLeft > 0 || v->gear <= 0 || !(radius > 0) || !speedOverGround(v, b, METRUE, &speed))
        return;
    const double rpm = fabs(ratioOfGear(v) * speed) / radius / turns;
    if (v->gear < v->params.gears && rpm > (double)v->params.shiftUp)
        shift(v, v->gear + 1);
    else if (v->gear > 1 && rpm < (double)v->params.shiftDown)
        shift(v, v->gear - 1);
}

/* The automatic. Returns the throttle; what brakes instead is added to *brake. */
static double chooseGear(MstVehicle *v, MdtBodyID b, double *brake) {
    const double slow = (double)v->universe->sizes.lengthScale; /* m/s: below it, the direction may change */
    const double target = v->throttle;
    double speed;
    speedOverGround(v, b, MEFALSE, &speed);
    if (!v->isAutomatic)
        return fmax(target, 0);
    if (target != 0 && speed * target < 0 && fabs(speed) > slow) {
        *brake = fmax(*brake, fabs(target));
        return 0;
    }
    if (target < 0 && v->gear > 0)
        shift(v, -1);
    else if (target > 0 && v->gear < 0)
        shift(v, 1);
    else
        changeGear(v, b);
    return fabs(target);
}

/* N m, of the engine at its speed. */
static double engineTorque(const MstVehicle *v, double throttle, MeBool isSlipping) {
    const MstVehicleParams *p = &v->params;
    const double rpm = v->engineSpeed / turns, redline = (double)p->redline;
    const double drive = rpm < redline ? throttle * mst_curveAt(&p->torque, rpm) : 0;
    return drive - (isSlipping ? 0 : (1 - throttle) * (double)p->engineBraking * rpm / redline);
}

static void turnFreely(MstVehicle *v, double throttle, double h) {
    const double idle = (double)v->params.idle * turns, inertia = (double)v->params.engineInertia;
    const double max = (double)v->params.redline * turns;
    const double torque = engineTorque(v, v->shiftLeft > 0 ? 0 : throttle, MEFALSE);
    v->engineSpeed += inertia > 0 ? h * torque / inertia : 0;
    v->engineSpeed = fmin(fmax(v->engineSpeed, idle), max);
}

/* The torque of the engine at the driven wheels together. */
static double driveTorque(MstVehicle *v, double throttle, double h) {
    const double ratio = ratioOf(v), idle = (double)v->params.idle * turns;
    if (ratio == 0) {
        turnFreely(v, throttle, h);
        return 0;
    }
    const double speed = ratio * drivenSpin(v);
    v->engineSpeed = fmax(speed, idle);
    return ratio * engineTorque(v, throttle, speed < idle);
}

/* ---- forces on the chassis --------------------------------------------------------------------------------------- */

/* Implicit in the step, so that it never turns the motion back. */
static void resistAir(const MstVehicle *v, MdtBodyID b, double h) {
    MeVector3 velocity;
    double force[3];
    MdtBodyGetLinearVelocity(b, velocity);
    fromReal(force, velocity);
    const double rate = (double)v->params.drag * keaLength(force), mass = (double)MdtBodyGetMass(b);
    keaScale(force, -rate / (1 + h * rate / mass), force);
    if (rate > 0)
        MdtBodyAddLoad(b, force);
}

/* m: the height of the chassis' centre of mass over the line on which the wheels stand. */
static double heightOf(const MstVehicle *v, MdtBodyID b) {
    MeVector3 centre;
    double c[3], height = 0;
    MdtBodyGetCenterOfMassRelativePosition(b, centre);
    fromReal(c, centre);
    for (int i = 0; i < v->wheelCount; i++)
        height += (keaDot(c, v->up) - placeOf(v->wheel[i], v->up) + (double)v->wheel[i]->params.radius) / v->wheelCount;
    return height;
}

/* kg m²: of the chassis about that line. */
static double rollInertia(const MstVehicle *v, MdtBodyID b, double height) {
    MeMatrix3 tensor;
    double sum = 0;
    MdtBodyGetInertiaTensor(b, tensor);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            sum += v->forward[i] * (double)tensor[i][k] * v->forward[k];
    return sum + (double)MdtBodyGetMass(b) * height * height;
}

/* N m: by which gravity, and the curve that is driven, lean the chassis further to the left. */
static double leaningTorque(const MstVehicle *v, MdtBodyID b, const double gravity[3], double lean, double height) {
    MeVector3 spin;
    double turning[3];
    MdtBodyGetAngularVelocity(b, spin);
    fromReal(turning, spin);
    const double g = keaLength(gravity), aside = -mst_vehicleSpeed(v, b) * keaDot(turning, gravity) / g;
    return (double)MdtBodyGetMass(b) * height * (g * sin(lean) - aside * cos(lean));
}

/* The wheel whose joint carries the balance: one that does not steer, so that it looks ahead; null: none. */
static MstWheel *balancingWheel(const MstVehicle *v) {
    for (int i = 0; i < v->wheelCount; i++)
        if (v->wheel[i]->params.steering == 0 && v->wheel[i]->data)
            return v->wheel[i];
    return 0;
}

/* Moves the lean that the balance keeps towards a target, no faster than tyres can bear: what leans over pushes them
 * aside. It stops before the limit. */
static void moveLean(MstVehicle *v, double target, double h) {
    const double limit = (double)v->params.leanLimit;
    static const double frequency = 6, maxAcceleration = 4; /* rad/s, rad/s² */
    const double all = frequency * frequency * (target - v->lean - h * v->leanRate) - 2 * frequency * v->leanRate;
    const double acceleration = all / (1 + 2 * frequency * h + frequency * frequency * h * h);
    v->leanRate += h * fmin(fmax(acceleration, -maxAcceleration), maxAcceleration);
    v->leanRate = fmin(v->leanRate, sqrt(2 * maxAcceleration * fmax(limit - v->lean, 0)));
    v->leanRate = fmax(v->leanRate, -sqrt(2 * maxAcceleration * fmax(limit + v->lean, 0)));
    v->lean = fmin(fmax(v->lean + h * v->leanRate, -limit), limit);
}

/* A damped spring to the lean at which gravity and the curve are in balance, and what they lack of it on the way. */
static void balance(MstVehicle *v, MdtBodyID b, const double gravity[3], double h) {
    double behind, slope;
    MstWheel *w = v->params.leanLimit > 0 && keaLength(gravity) > 0 ? balancingWheel(v) : 0;
    if (!w)
        return;
    const double limit = (double)v->params.leanLimit, speed = mst_vehicleSpeed(v, b);
    const double curvature = curvatureOf(v, v->lock, &behind, &slope);
    const double target = fmin(fmax(atan(speed * speed * curvature / keaLength(gravity)), -limit), limit);
    const double rate = 2 * ME_PI * (double)v->params.leanFrequency, height = heightOf(v, b);
    const double inertia = rollInertia(v, b, height), lean = leanOf(v, b, gravity);
    const double before = v->leanRate;
    moveLean(v, target, h);
    const double torque = leaningTorque(v, b, gravity, lean, height) - inertia * (v->leanRate - before) / h;
    w->data->leanStiffness = inertia * rate * rate;
    w->data->lean = lean - v->lean + torque / w->data->leanStiffness;
    w->data->leanRate = v->leanRate;
    w->data->leanDamping = 2 * inertia * rate;
}

/* ---- the step ---------------------------------------------------------------------------------------------------- */

static void turnWheels(MstVehicle *v, double torque, double brake) {
    const double ratio = ratioOf(v), inertia = ratio * ratio * (double)v->params.engineInertia;
    for (int i = 0; i < v->wheelCount; i++) {
        MstWheel *w = v->wheel[i];
        const double share = shareOf(v, w), load = w->data ? w->data->load : 0;
        w->torque = share * torque;
        w->inertia = (double)w->params.inertia + (w->model ? 0 : share * inertia);
        w->brake = brake * (double)w->params.brake + v->handbrake * (double)w->params.handbrake +
                   (double)w->params.rollingResistance * load * (double)w->params.radius;
    }
}

void mst_vehicleDrive(MstVehicle *v, MdtBodyID b, double h) {
    MeVector3 g;
    double gravity[3], brake = v->brake;
    MdtWorldGetGravity(v->universe->world, g);
    fromReal(gravity, g);
    v->shiftLeft = fmax(v->shiftLeft - h, 0);
    steer(v, b, gravity, h);
    const double throttle = chooseGear(v, b, &brake);
    turnWheels(v, driveTorque(v, throttle, h), brake);
    resistAir(v, b, h);
    balance(v, b, gravity, h);
}
