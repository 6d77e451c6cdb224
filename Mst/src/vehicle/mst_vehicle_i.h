/* Inside Mst: vehicles. In each step: drive (engine, gears and brakes give each wheel its torques), cast (each wheel
 * finds its ground, and gets the data of its joint: MdtBclGroundWheel), then the world's step, then show. */
#ifndef MST_VEHICLE_I_H
#define MST_VEHICLE_I_H

#include "MstVehicle.h"
#include "McdInternal.h"
#include "MdtInternal.h"
#include "MdtKeaMath.h"
#include "bridge/mst_bridge_i.h"
#include <math.h>
#include <string.h>

enum { MST_VEHICLE = 0x4d564548 };

typedef struct MstWheel {
    MstWheelParams params;
    MdtConstraintID joint; /* valid if its serial is still the same */
    MeU64 serial;
    MdtBclGroundWheel *data;      /* of the joint, in this step; null: it is gone */
    McdGeometryID shape;          /* that is cast; null: a ray */
    double peak[2], peakForce[2]; /* slip and friction at the tyre's peaks */
    double position[3];           /* chassis' frame: of its centre at suspension length 0, the stop */
    double length;                /* m, of the suspension at its unloaded end, where the wheel hangs */
    double mass;                  /* kg, of the chassis that it carries */
    double inertia;               /* kg m², with its part of the engine's */
    double torque, brake;         /* N m, of this step */
    double steering;              /* rad */
    double forward[3], axle[3];   /* by it: the direction in which it rolls, its axle, to the left; chassis' frame */
    double slip[2];
    double friction;              /* of the ground: the factor of the tyre's curves */
    struct MstWheel *twin;        /* the other one of the axle's first two wheels; null: none */
    MeBool isFirst;               /* of the two */
    double stiffness, freeLength; /* of the spring alone: N/m, m */
    McdModelID model; /* of a wheel that is a body, valid if its serial number is still the same; its joint */
    MeU64 modelSerial;
    MdtCarWheelID carWheel;
    MdtBclGroundWheel own; /* its data, in the place of those of a joint */
    McdModelID ground;     /* valid if its serial number is still the same */
    MeU64 groundSerial;
    MeU64 groundStamp;          /* McdModelGetStamp of it at the cast */
    double point[3], normal[3]; /* of the ground's plane, world */
    MeMatrix4 transform;
} MstWheel;

struct MstVehicle {
    MeU32 magic;
    MeHandle handle;
    MstUniverseID universe;
    struct MstVehicle *next; /* in the universe's list, in the order of creation */
    McdModelID chassis;      /* valid if its serial number is still the same */
    MeU64 chassisSerial;
    MstVehicleParams params;
    double up[3], forward[3], left[3]; /* unit, chassis' frame */
    MstWheel *wheel[MST_VEHICLE_WHEELS];
    int wheelCount;
    double throttle, steering, brake, handbrake; /* as the program drives */
    MeBool hasChanged;                           /* since the last step */
    double lock;                                 /* -1 .. 1, of the steering now */
    double steered;                              /* the lock by which wheels stand; beyond 1: to be found anew */
    MeBool isAutomatic, isDriving;               /* isDriving: this step's throttle acts on the wheels */
    int gear;
    double shiftLeft;                  /* s, until the gear is in */
    double engineSpeed;                /* rad/s */
    double load[5];                    /* mass, its centre and gravity for which the wheels' springs were computed */
    double clutch[MST_VEHICLE_WHEELS]; /* N m, of this step, of the locks of differentials */
    double lean, leanRate;             /* rad, rad/s: that a motorcycle's balance keeps */
    MdtKeaTransformation seen;         /* the chassis' pose after the last step */
    MeBool isActive;                   /* in this step */
    double step;                       /* s, its length */
};

/* The chassis' body; null: it is gone. */
MdtBodyID mst_vehicleBody(const MstVehicle *v);
/* The body of a model; null: it has none in the vehicle's world. */
MdtBodyID mst_bodyInWorld(const MstVehicle *v, McdModelID cm);
/* The wheels' masses, springs and places, after the chassis' mass has changed. */
void mst_vehicleBalance(MstVehicle *v, MdtBodyID b);
/* Its data for this step; null: it is gone. */
MdtBclGroundWheel *mst_wheelData(MstWheel *w, MdtBodyID b);
/* m/s, forwards. */
double mst_vehicleSpeed(const MstVehicle *v, MdtBodyID b);
/* Torques of engine and brakes, the steering, the gears; forces of the air and of balance. */
void mst_vehicleDrive(MstVehicle *v, MdtBodyID b, double h);
/* Locks of differentials: their torques in this step, after the cast; what is left to them after the step. */
void mst_vehicleLock(MstVehicle *v, MdtBodyID b, double h);
void mst_vehicleEqualize(MstVehicle *v, MdtBodyID b, double h);
/* Sets a wheel's steering, and the axes that follow from it. */
void mst_wheelSteer(const MstVehicle *v, MstWheel *w, double angle);
/* Whether what a wheel stands on is still there. */
MeBool mst_wheelHasGround(const MstWheel *w);
/* Whether what a wheel stands on has moved or is gone. */
MeBool mst_wheelIsGroundChanged(const MstVehicle *v, const MstWheel *w);
/* Finds the ground of all wheels, and writes their joints' data. */
void mst_vehicleCast(MstVehicle *v, MdtBodyID b, double h);
/* Wheels that are bodies: made and ended; placed with the chassis; driven; shown. */
void mst_wheelMakeBody(const MstVehicle *v, MstWheel *w, MdtBodyID b, const MdtKeaTransformation *chassis);
void mst_wheelEndBody(MstWheel *w);
MeBool mst_wheelHasBody(const MstWheel *w);
void mst_wheelBodyFollow(const MstVehicle *v, const MstWheel *w, MdtBodyID b, const MdtKeaTransformation *chassis);
void mst_wheelBodyDrive(const MstVehicle *v, const MstWheel *w);
void mst_wheelBodyShow(MstWheel *w);
/* Transforms of wheels. */
void mst_vehicleShow(MstVehicle *v, MdtBodyID b);
/* Whether a wheel's material is one of the bridge's, or none. */
MeBool mst_vehicleHasMaterial(const MstVehicle *v, int material);
double mst_curveAt(const MstCurve *c, double x);
/* What is wrong with parameters; null: nothing. */
const char *mst_vehicleFault(const MstVehicleParams *p);
const char *mst_wheelFault(const MstWheelParams *p);

/* ---- for the universe ---- */

/* At the beginning of a step; before the world's step, and after it. */
void mst_vehiclesFollow(const MstUniverse *u);
void mst_vehiclesBegin(MstUniverse *u, MeReal step);
void mst_vehiclesEnd(const MstUniverse *u);
void mst_vehiclesShift(const MstUniverse *u, const double by[3]);
/* When the universe ends. */
void mst_vehiclesDestroy(MstUniverse *u);

#endif
