/* Wheels that are bodies: cylinders on MdtCarWheel joints, which touch the ground by contacts.
 *
 * They are placed anew where the program has put the chassis elsewhere. A ray finds what they stand on, for what
 * programs read. */
#include "vehicle/mst_vehicle_i.h"
#include "McdCylinder.h"
#include "McdModel.h"
#include "MdtBody.h"
#include "MdtCarWheel.h"
#include "MdtWorld.h"

static MeBool isThere(const MstWheel *w) {
    return w->model && McdModelIsValid(w->model) && McdModelGetSerial(w->model) == w->modelSerial &&
           mst_bodyOf(w->model);
}

MeBool mst_wheelHasBody(const MstWheel *w) {
    return isThere(w) && w->carWheel;
}

/* ---- life -------------------------------------------------------------------------------------------------------- */

/* A wheel's place and axes in the world: x forwards, z along the axle. */
static void poseOf(const MstVehicle *v, const MstWheel *w, const MdtKeaTransformation *chassis,
                   MdtKeaTransformation *pose) {
    double x[3], y[3], z[3], place[3];
    for (int i = 0; i < 3; i++)
        place[i] = (double)w->params.position[i];
    keaApply(x, chassis->R, v->forward);
    keaApply(z, chassis->R, v->left);
    keaCross(y, z, x);
    for (int i = 0; i < 3; i++) {
        pose->R[i][0] = x[i];
        pose->R[i][1] = y[i];
        pose->R[i][2] = z[i];
    }
    keaApply(pose->pos, chassis->R, place);
    keaAddScaled(pose->pos, 1, chassis->pos);
}

static void placeBody(const MstVehicle *v, const MstWheel *w, MdtBodyID b, const MdtKeaTransformation *chassis) {
    MdtKeaTransformation pose;
    MeVector3 velocity, spin, at;
    double q[4];
    const MdtBodyID wheel = mst_bodyOf(w->model);
    poseOf(v, w, chassis, &pose);
    keaQuaternionFromMatrix(q, (const double(*)[3])pose.R);
    for (int i = 0; i < 3; i++)
        at[i] = (MeReal)pose.pos[i];
    MdtBodySetPosition(wheel, at[0], at[1], at[2]);
    MdtBodySetQuaternion(wheel, (MeReal)q[0], (MeReal)q[1], (MeReal)q[2], (MeReal)q[3]);
    MdtBodyGetVelocityAtPoint(b, at, velocity);
    MdtBodyGetAngularVelocity(b, spin);
    MdtBodySetLinearVelocity(wheel, velocity[0], velocity[1], velocity[2]);
    MdtBodySetAngularVelocity(wheel, spin[0], spin[1], spin[2]);
}

static void makeJoint(const MstVehicle *v, MstWheel *w, MdtBodyID b, const MdtKeaTransformation *chassis) {
    double up[3], left[3];
    MeVector3 at;
    MdtBodyGetPosition(mst_bodyOf(w->model), at);
    keaApply(up, chassis->R, v->up);
    keaApply(left, chassis->R, v->left);
    w->carWheel = MdtCarWheelCreate(v->universe->world);
    if (!w->carWheel)
        return;
    MdtCarWheelSetBodies(w->carWheel, b, mst_bodyOf(w->model));
    MdtCarWheelSetPosition(w->carWheel, at[0], at[1], at[2]);
    MdtCarWheelSetSteeringAndHingeAxes(w->carWheel, (MeReal)up[0], (MeReal)up[1], (MeReal)up[2], (MeReal)left[0],
                                       (MeReal)left[1], (MeReal)left[2]);
    MdtCarWheelSetSteeringLock(w->carWheel, w->params.steering == 0);
    MdtCarWheelEnable(w->carWheel);
}

/* In a change block of its own unless one is open. */
static MeBool insert(McdSpaceID s, McdModelID m) {
    const MeBool isOpen = McdSpaceIsChanging(s) != 0;
    if (!isOpen)
        McdSpaceBeginChanges(s);
    const MeBool isDone = McdSpaceInsertModel(s, m) != 0;
    if (!isOpen)
        McdSpaceEndChanges(s);
    return isDone;
}

/* A solid cylinder about z. */
static void setMass(MdtBodyID b, double mass, double radius, double width) {
    const MeReal along = (MeReal)(mass * radius * radius / 2);
    const MeReal across = (MeReal)(mass * (3 * radius * radius + width * width) / 12);
    MeMatrix3 tensor = {{across, 0, 0}, {0, across, 0}, {0, 0, along}};
    MdtBodySetMass(b, (MeReal)mass);
    MdtBodySetInertiaTensor(b, (const MeVector3 *)tensor);
}

/* Null, after a message: no room. */
static McdModelID makeModel(const MstVehicle *v, const MstWheel *w, double mass) {
    const McdModelID m = McdModelCreate(w->shape);
    const MdtBodyID b = m ? MdtBodyCreate(v->universe->world) : 0;
    if (!b || !insert(v->universe->space, m)) {
        if (m)
            McdModelDestroy(m);
        if (b)
            MdtBodyDestroy(b);
        return 0;
    }
    McdModelSetBody(m, b);
    MdtBodyEnable(b);
    setMass(b, mass, (double)w->params.radius, (double)w->params.width);
    return m;
}

void mst_wheelMakeBody(const MstVehicle *v, MstWheel *w, MdtBodyID b, const MdtKeaTransformation *chassis) {
    const double radius = (double)w->params.radius, mass = 2 * (double)w->params.inertia / (radius * radius);
    w->shape = (McdGeometryID)McdCylinderCreate(v->universe->frame, w->params.radius, w->params.width);
    w->model = w->shape ? makeModel(v, w, mass) : 0;
    if (!w->model)
        return;
    w->modelSerial = McdModelGetSerial(w->model);
    McdModelSetMaterial(w->model, (int)McdModelGetMaterial(v->chassis));
    McdSpaceDisablePair(w->model, v->chassis);
    placeBody(v, w, b, chassis);
    makeJoint(v, w, b, chassis);
}

void mst_wheelEndBody(MstWheel *w) {
    if (isThere(w) && w->carWheel)
        MdtCarWheelDestroy(w->carWheel);
    if (isThere(w)) {
        const MdtBodyID b = mst_bodyOf(w->model);
        McdModelDestroy(w->model);
        MdtBodyDestroy(b);
    }
    w->model = 0;
}

/* ---- the step ---------------------------------------------------------------------------------------------------- */

/* The engine turns the wheel, beyond any speed, with what its brake leaves of the torque; or the brake holds it. */
static void turn(const MstWheel *w) {
    static const MeReal fastest = (MeReal)1e4; /* rad/s */
    const double torque = w->own.drive, net = fabs(torque) - w->brake;
    const MeReal velocity = net <= 0 ? 0 : torque > 0 ? fastest : -fastest;
    MdtCarWheelSetHingeLimitedForceMotor(w->carWheel, velocity, (MeReal)fabs(net));
}

/* N m: of the steering's motor, twice what friction of the wheel's load has at its radius. */
static double steeringTorque(const MstVehicle *v, const MstWheel *w) {
    const double g = fabs(v->load[4]), weightless = 10 * (double)v->universe->sizes.lengthScale;
    return 2 * (g > 0 ? g : weightless) * w->mass * (double)w->params.radius;
}

static void suspend(const MstVehicle *v, const MstWheel *w) {
    const double bump = (double)w->params.bump, droop = w->length - bump;
    MdtCarWheelSetSuspension(w->carWheel, (MeReal)w->stiffness, (MeReal)w->own.damping, 0, (MeReal)-droop, (MeReal)bump,
                             (MeReal)(bump - w->freeLength));
    if (w->params.steering != 0)
        MdtCarWheelSetSteeringPositionMotor(w->carWheel, (MeReal)-w->steering, 20, 1, (MeReal)steeringTorque(v, w));
}

static void read(MstWheel *w) {
    MdtBclGroundWheel *d = &w->own;
    d->spin = (double)MdtCarWheelGetHingeAngleRate(w->carWheel);
    d->length = (double)w->params.bump - (double)MdtCarWheelGetSuspensionHeight(w->carWheel);
    d->load = fmax(w->stiffness * (w->freeLength - d->length), 0);
}

void mst_wheelBodyDrive(const MstVehicle *v, const MstWheel *w) {
    if (!mst_wheelHasBody(w))
        return;
    suspend(v, w);
    turn(w);
}

void mst_wheelBodyFollow(const MstVehicle *v, const MstWheel *w, MdtBodyID b, const MdtKeaTransformation *chassis) {
    if (mst_wheelHasBody(w))
        placeBody(v, w, b, chassis);
}

void mst_wheelBodyShow(MstWheel *w) {
    if (!mst_wheelHasBody(w))
        return;
    read(w);
    memcpy(w->transform, MdtBodyGetTransformPtr(mst_bodyOf(w->model)), sizeof w->transform);
}
