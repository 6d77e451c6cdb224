/* A car of any size on a plane: the helpers of the tests of vehicles. Lengths in units of `size`, masses by density. */
#ifndef VEHICLE_H
#define VEHICLE_H

#include "MstVehicle.h"
#include "universe.h"
#include <math.h>

#define GRAVITY 9.8

enum { FRONT_LEFT, FRONT_RIGHT, REAR_LEFT, REAR_RIGHT, WHEELS };

/* What a test varies. */
typedef struct Setup {
    double size, mass, h; /* 1: a car; kg; s */
    MstVehicleCast cast;
} Setup;

static const Setup setups[] = {{1, 1200, 1. / 60, kMstVehicleRay},
                               {.5, 100, 1. / 240, kMstVehicleRay},
                               {3, 40000, 1. / 30, kMstVehicleRay},
                               {1, 1200, 1. / 120, kMstVehicleSphere},
                               {1, 1200, 1. / 60, kMstVehicleCylinder}};
enum { SETUPS = sizeof setups / sizeof *setups };

static Setup now;
static double metre = 1; /* in units of length */
static MstVehicleID car;
static MdtBodyID body;
static MstVehicleParams params;
static MstWheelParams wheels[WHEELS];

/* A tyre whose force rises to mu at a slip, and stays there. */
static inline MstCurve tyre(double slip, double mu) {
    return (MstCurve){3, {{0, 0}, {(MeReal)slip, (MeReal)mu}, {100, (MeReal)mu}}};
}

/* The parameters of a car: the front steers, the rear drives; no losses. */
static inline void setCar(const Setup *s) {
    MstUniverseSizes sizes = MstUniverseGrowingSizes;
    sizes.lengthScale = (MeReal)metre;
    now = *s;
    now.size *= metre;
    universe_begin(&sizes);
    MdtWorldSetGravity(u->world, 0, 0, (MeReal)(-GRAVITY * metre));
    MdtWorldSetAutoDisable(u->world, 0);
    MstVehicleSetDefaults(&params, u);
    params.cast = s->cast;
    params.drag = params.engineInertia = params.engineBraking = params.shiftTime = 0;
    params.steeringRate = MEINFINITY;
    params.torque = (MstCurve){1, {{0, (MeReal)(.15 * s->mass * metre * now.size)}}};
    for (int i = 0; i < WHEELS; i++) {
        MstWheelParams *w = &wheels[i];
        MstWheelSetDefaults(w, u);
        w->radius = (MeReal)(.32 * now.size);
        w->width = (MeReal)(.2 * now.size);
        w->position[0] = (MeReal)((i < REAR_LEFT ? 1.3 : -1.3) * now.size);
        w->position[1] = (MeReal)((i % 2 ? -.75 : .75) * now.size);
        w->position[2] = (MeReal)(-.2 * now.size);
        w->bump = (MeReal)(.12 * now.size);
        w->inertia = (MeReal)(1e-6 * s->mass * now.size * now.size);
        w->rollingResistance = 0;
        w->brake = (MeReal)(10 * s->mass * metre * now.size);
        w->handbrake = (MeReal)(10 * s->mass * metre * now.size);
        w->axle = i / 2;
        w->steering = i < REAR_LEFT ? (MeReal).6 : 0;
        w->drive = i < REAR_LEFT ? 0 : 1;
        w->along = w->across = tyre(.08, 1);
    }
}

/* Puts the car, of setCar, level above the plane z = 0, where its wheels touch it, or higher. The chassis, a box, is
 * out of the way. */
static inline void putCar(double higher) {
    const MeReal l = (MeReal)(4 * now.size), w = (MeReal)(1.6 * now.size), t = (MeReal)(.4 * now.size);
    const McdModelID chassis =
        MstModelAndBodyCreate(u, McdBoxCreate(u->frame, l, w, t), (MeReal)(now.mass / (double)(l * w * t)));
    ck_assert(chassis);
    body = McdModelGetBody(chassis);
    MdtBodySetPosition(body, 0, 0, (MeReal)(.52 * now.size + higher));
    car = MstVehicleCreate(u, chassis, &params);
    ck_assert(car);
    for (int i = 0; i < WHEELS; i++)
        ck_assert_int_eq(MstVehicleAddWheel(car, &wheels[i]), i);
}

static inline void drive(double throttle, double steering, double brake, double handbrake) {
    MstVehicleDrive(car, (MeReal)throttle, (MeReal)steering, (MeReal)brake, (MeReal)handbrake);
}

static inline void run(double time) {
    const int steps = (int)(time / now.h + .5);
    for (int i = 0; i < steps; i++)
        MstUniverseStep(u, (MeReal)now.h);
}

static inline double place(int axis) {
    MeVector3 p;
    MdtBodyGetPosition(body, p);
    return (double)p[axis];
}

static inline double velocity(int axis) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(body, v);
    return (double)v[axis];
}

static inline void setSpeed(double speed) {
    MdtBodySetLinearVelocity(body, (MeReal)speed, 0, 0);
}

static inline MstWheelState wheel(int i) {
    MstWheelState state;
    MstVehicleGetWheel(car, i, &state);
    return state;
}

#endif
