/** @file MstVehicle.h
 *  Vehicles: a chassis on wheels with suspension, tyres, engine, gears and brakes. Beyond Karma.
 *
 *  The chassis is the program's: a model with a body. Wheels are added to it, and have no bodies: each is cast
 *  downwards along its suspension, in every step of the universe (MstUniverseStep). A spring and a tyre act between
 *  the chassis and the model that the cast hits, which is pushed in turn. Springs are solved implicitly, at any
 *  stiffness; a parked vehicle does not creep. The program drives (MstVehicleDrive) and draws
 *  (MstVehicleGetWheelTransformPtr).
 *
 *  Positions and directions of wheels are in the chassis' frame, that of its body (MdtBodyGetTransformPtr): `forward`
 *  and `up` of the parameters; left is up x forward. A wheel's place is where its centre is while the vehicle stands
 *  level: springs are preloaded for that, by the distribution of mass. Lean and steering are positive to the left.
 *
 *  Tyres: the slip along is (R w - v)/max(|v|, |R w|), R w the speed of the tread and v that of the wheel over ground;
 *  the slip across is the tangent of the slip angle. Both together make the ellipse: with s the length of (slip along /
 *  its peak, slip across / its peak), each force is that of its curve at s times its peak, times its share of s. Curves
 *  are followed by steps: in a step the force is linear, with the slope, and up to the bound, of the last step's slip.
 *
 *  A universe owns its vehicles, and ends them. Units: metres, seconds, kg, N, radians; of engines turns per minute.
 */
#ifndef MSTVEHICLE_H
#define MSTVEHICLE_H

#include "McdModel.h"
#include "McdSpace.h"
#include "MstTypes.h"

ME_BEGIN_C

typedef struct MstVehicle MstVehicle;
typedef MstVehicle *MstVehicleID;

enum {
    MST_CURVE_POINTS = 12,  /**< Largest number of points of a curve. */
    MST_VEHICLE_GEARS = 12, /**< Largest number of forward gears. */
    MST_VEHICLE_WHEELS = 32 /**< Largest number of wheels of a vehicle. */
};

typedef struct MstCurvePoint {
    MeReal x, y;
} MstCurvePoint;

/** A function by points with rising x: linear between them, constant beyond them. */
typedef struct MstCurve {
    int count; /**< 1 .. MST_CURVE_POINTS. */
    MstCurvePoint point[MST_CURVE_POINTS];
} MstCurve;

/** How wheels find the ground. */
typedef enum MstVehicleCast {
    kMstVehicleRay = 0,      /**< A ray from the wheel's centre: the cheapest. */
    kMstVehicleSphere = 1,   /**< A sphere of the wheel's radius, which rolls over edges. */
    kMstVehicleCylinder = 2, /**< A cylinder of the wheel's radius and width. */
    kMstVehicleBodies = 3 /**< Wheels are bodies: cylinders on MdtCarWheel joints, of the chassis' material, with a mass
                               that follows from the inertia. Contacts make their friction, not the tyre's curves, and
                               damp the ride by themselves; there are no anti-roll bars, no lean, and no inertia of the
                               engine, and locks of differentials act a step late. */
} MstVehicleCast;

/** What a vehicle is like. */
typedef struct MstVehicleParams {
    MeVector3 forward, up; /**< Not zero, and not parallel: up is made orthogonal to forward. */
    MstVehicleCast cast;
    MstCurve torque;                /**< N m of the engine at full throttle, by turns per minute. */
    MeReal idle, redline;           /**< Turns per minute, 0 < idle < redline: the engine's limits. */
    MeReal engineInertia;           /**< kg m², >= 0. */
    MeReal engineBraking;           /**< N m, >= 0, at the redline without throttle; less in proportion below it. */
    int gears;                      /**< 1 .. MST_VEHICLE_GEARS. */
    MeReal gear[MST_VEHICLE_GEARS]; /**< Turns of the engine for one of the final drive, > 0; falling. */
    MeReal reverse;                 /**< Likewise, > 0. */
    MeReal finalDrive;              /**< > 0, turns of it for one of the driven wheels. */
    MeReal shiftUp, shiftDown;      /**< Turns per minute at which the automatic changes gears: by the speed over the
                                         ground, as if wheels did not slip. */
    MeReal shiftTime;               /**< s, >= 0, without torque. */
    MeReal axleLock;     /**< 0 .. 1, differentials between the driven wheels of an axle. 0: open. 1: locked, the wheels
                            turn at one speed. Between: the share of half of the axle's torque that goes over to the
                            slower wheel as long as their speeds differ. */
    MeReal centreLock;   /**< Likewise, between the mean speeds of axles. */
    MeReal steeringRate; /**< 1/s, > 0: how fast the steering follows, as a share of full lock; MEINFINITY: at once. */
    MeReal drag;         /**< N s²/m², >= 0: force of the air over the square of the speed. */
    MeReal leanLimit;    /**< rad, 0 .. 1.4: a motorcycle that leans up to that into curves, and a twentieth further
                                 from side to side; 0: it does not lean. A torque on the chassis keeps its balance, so
                                 that it never falls: at least one wheel must not steer. */
    MeReal leanFrequency;                     /**< Hz, > 0, of that balance, with critical damping. */
    McdLineSegIntersectEnableCallback filter; /**< Only models for which it returns non-zero are ground; null: all that
                                                   would collide with the chassis. */
    void *filterData;
} MstVehicleParams;

/** What a wheel is like. */
typedef struct MstWheelParams {
    MeVector3 position;       /**< Of its centre, while the vehicle stands level. */
    MeReal radius, width;     /**< m, > 0. */
    MeReal inertia;           /**< kg m², > 0: about its axle. */
    MeReal bump, droop;       /**< m, > 0, >= 0: how far it moves up, to a stop, and down. droop 0: until its spring
                                     is unloaded. */
    MeReal frequency;         /**< Hz, > 0 unless there is a stiffness: of the share of the chassis that it carries. */
    MeReal stiffness;         /**< N/m, >= 0: used instead of the frequency if it is not 0. */
    MeReal dampingRatio;      /**< >= 0; 1: critical. */
    MeReal antiRoll;          /**< N/m, >= 0: of the bar between the first two wheels of its axle, for one of them. */
    int axle;                 /**< >= 0: wheels of the same axle share a differential and a bar. */
    MeReal steering;          /**< rad, -1.5 .. 1.5, at full lock, of a wheel in the middle: each stands tangential to
                                     the curve of all. */
    MeReal drive;             /**< >= 0: its share of the engine's torque; 0: not driven. */
    MeReal brake, handbrake;  /**< N m, >= 0. */
    MeReal rollingResistance; /**< >= 0, of its load: stops a vehicle that coasts. */
    MstCurve along, across;   /**< Tyre force over load, by slip: both from x >= 0 on, with a peak > 0 at x > 0. */
    int material;             /**< Of the bridge: the curves are multiplied by the coefficient of friction of its pair
                                   with the material of the ground there (of a mesh's triangle, its own), if the program
                                   has set that (MdtContactParamsSetSurface). -1, the default: they hold on any ground.
                                   Wheels that are bodies have the chassis' material. */
} MstWheelParams;

/** What a wheel does, after a step. World frame. */
typedef struct MstWheelState {
    McdModelID ground;          /**< What it stands on; null: nothing, and the next six are 0. */
    MeVector3 position, normal; /**< Of the contact; of length 1, off the ground. */
    MeReal load;                /**< N, along the normal. */
    MeReal force[2];            /**< N, of the tyre on the vehicle: forwards, to the left. */
    MeReal slip[2];             /**< Along: positive if it drives; across: positive if it slides to the left. */
    MeReal speed;               /**< m/s, over ground, forwards. */
    MeReal compression;         /**< m, from its place while the vehicle stands level; positive: up. */
    MeReal steering;            /**< rad */
    MeReal spin, angle;         /**< rad/s, rad: positive forwards; the angle within -pi .. pi. */
} MstWheelState;

/** Sets parameters of a passenger car for a universe: 100 kW, five gears, up against gravity, forward x, or y where x
 *  is up. Lengths, masses and forces are in its scales. */
MEPUBLIC void MEAPI MstVehicleSetDefaults(MstVehicleParams *params, MstUniverseID u);
/** Sets parameters of its wheel: radius .32 length scales, 1.5 Hz, tyres with a peak of 1 at a slip of .1; not steered,
 *  not driven, braked, at the origin. */
MEPUBLIC void MEAPI MstWheelSetDefaults(MstWheelParams *params, MstUniverseID u);
/** Creates a vehicle, without wheels, of a chassis: a model of the universe with a body. Null, with a warning, for bad
 *  parameters, and for a chassis that has a vehicle. */
MEPUBLIC MstVehicleID MEAPI MstVehicleCreate(MstUniverseID u, McdModelID chassis, const MstVehicleParams *params);
/** Destroys a vehicle, not its chassis. Null does nothing. */
MEPUBLIC void MEAPI MstVehicleDestroy(MstVehicleID v);
/** Adds a wheel, which takes one of the universe's constraints. Returns its number, from 0; -1, with a warning, for bad
 *  parameters. */
MEPUBLIC int MEAPI MstVehicleAddWheel(MstVehicleID v, const MstWheelParams *params);
/** Changes a wheel, its tyre, spring, radius or place, and wakes the vehicle. Ask MstVehicleGetWheelParams first, and
 *  change what is to differ. False, with a warning, and nothing changes, for bad parameters and wheels that are bodies.
 *  Legal between steps. */
MEPUBLIC MeBool MEAPI MstVehicleSetWheelParams(MstVehicleID v, int wheel, const MstWheelParams *params);
/** Writes the parameters of a wheel. False, with a warning, and nothing is written, if there is none of that number. */
MEPUBLIC MeBool MEAPI MstVehicleGetWheelParams(MstVehicleID v, int wheel, MstWheelParams *params);
/**
 * Drives, until the next call; wakes the vehicle if anything changes.
 * @param throttle  0 .. 1; with the automatic -1 .. 1: against the motion it brakes, then goes the other way
 * @param steering  -1 .. 1, positive to the left
 * @param brake     0 .. 1
 * @param handbrake 0 .. 1
 * Numbers beyond are clamped; if one is not finite, a warning, and nothing changes.
 */
MEPUBLIC void MEAPI MstVehicleDrive(MstVehicleID v, MeReal throttle, MeReal steering, MeReal brake, MeReal handbrake);
/** Puts a gear in, -1: reverse, 0: neutral, and ends the automatic. Beyond the gears: a warning, and nothing
 *  changes. */
MEPUBLIC void MEAPI MstVehicleSetGear(MstVehicleID v, int gear);
/** The gear that is in, also by the automatic: -1 reverse, 0 neutral, and between gears the next one. */
MEPUBLIC int MEAPI MstVehicleGetGear(MstVehicleID v);
/** The automatic chooses gears. Default: yes. */
MEPUBLIC void MEAPI MstVehicleSetAutomatic(MstVehicleID v, MeBool on);
/** METRUE by default; MEFALSE after MstVehicleSetGear. */
MEPUBLIC MeBool MEAPI MstVehicleGetAutomatic(MstVehicleID v);
/** m/s, of the chassis, forwards. */
MEPUBLIC MeReal MEAPI MstVehicleGetSpeed(MstVehicleID v);
/** Turns per minute. */
MEPUBLIC MeReal MEAPI MstVehicleGetEngineSpeed(MstVehicleID v);
/** Null, without a warning, after its chassis has been destroyed. */
MEPUBLIC McdModelID MEAPI MstVehicleGetChassis(MstVehicleID v);
/** 0, with a warning, for a bad handle. */
MEPUBLIC int MEAPI MstVehicleGetWheelCount(MstVehicleID v);
/** Writes what a wheel did in the last step; zeros, with a warning, if there is none of that number. */
MEPUBLIC void MEAPI MstVehicleGetWheel(MstVehicleID v, int wheel, MstWheelState *state);
/** The transform of a wheel after each step, for drawing: its z axis is the axle, to the left. Valid as long as the
 *  vehicle. Null, with a warning, if there is none of that number. */
MEPUBLIC MeMatrix4Ptr MEAPI MstVehicleGetWheelTransformPtr(MstVehicleID v, int wheel);

ME_END_C

#endif
