/* Car: a car to drive over hills, over a ramp and through a pile of crates (User Guide, chapter 3, "The Car Wheel
 * Constraint", and chapter 5, "The Bridge").
 *
 * Five bodies: a chassis, whose geometry is an aggregate of two boxes, and four wheels, which touch the ground as
 * balls. Four MdtCarWheels tie them together: springs, steering, and hinge motors of limited force, which are the
 * engine, the brakes and the handbrake. The engine has a curve of torque and a gearbox; both driven wheels get the same
 * torque, as from a differential. The ground is a height field, the ramp a convex mesh; the bridge makes all contacts.
 *
 * Left alone the car drives itself round a course. Take the wheel with the arrow keys: watch the springs work (the four
 * heights in the status line), the gears change, and how many wheels are on the ground over the ramp.
 */
#include "drive.h"
#include "parts.h"
#include "play.h"
#include "terrain.h"
#include <stdio.h>

enum { FRONT_LEFT, FRONT_RIGHT, REAR_LEFT, REAR_RIGHT, WHEELS };
enum { GEARS = 4, CRATES = 10 };

static const MeReal chassisMass = 1000, wheelMass = 20; /* kg */
static const MeReal radius = (MeReal)0.36;              /* m, of a wheel */
static const MeReal wheelbase = (MeReal)2.4;            /* m, from axle to axle */
static const MeReal track = (MeReal)1.7;                /* m, from the left wheels to the right ones */
static const MeReal rideHeight = (MeReal)0.27;          /* m, of the chassis' middle above the wheels' */
static const MeReal stiffness = 25000, damping = 2500;  /* N/m and N s/m, of one wheel's suspension */
static const MeReal max = (MeReal)0.55;                 /* rad, of the steering */
static const MeReal brakeTorque = 600;                  /* N m, at each wheel */
static const MeReal handbrakeTorque = 3000;             /* N m, at each rear wheel: it locks */
static const MeReal drag = (MeReal)0.8;                 /* N / (m/s)² */

static const MeReal gearRatio[GEARS] = {14, 8, (MeReal)5.5, (MeReal)4.1}; /* engine's turns for one of the wheels */
static const MeReal idle = 1000, shiftDown = 2200, shiftUp = 5200, fastest = 6500; /* turns a minute, of the engine */

/* The course that the car drives by itself, from point to point. */
static const MeReal course[][2] = {{20, -8},  {40, -8}, {52, 14},   {36, 40},   {0, 48},
                                   {-36, 40}, {-54, 8}, {-52, -16}, {-40, -14}, {-20, -8}};
enum { COURSE = sizeof course / sizeof course[0] };

static McdModelID chassis, wheel[WHEELS], crate[CRATES];
static MdtCarWheelID joint[WHEELS];
static MstMaterialID wheelMaterial;
static MeAppTerrain *terrain;
static MeMatrix4 rampTM, lowerTM, cabinTM;

static MeBool isAutomatic, handbrake;
static int gear, target; /* gear: 0 to GEARS - 1, or -1 for reverse; target: of the course */
static MeReal steering;  /* rad, positive to the left */
static MeReal torque;    /* N m, of the engine */

/* ---- motion ----------------------------------------------------------------------------------------------------- */

static MdtBodyID body(void) {
    return McdModelGetBody(chassis);
}

/* Forward is +x, left is -z. */
static MeReal wheelX(int i) {
    return i < REAR_LEFT ? wheelbase / 2 : -wheelbase / 2;
}

static MeReal wheelZ(int i) {
    return i % 2 ? track / 2 : -track / 2;
}

/* m/s, forward */
static MeReal speedOf(void) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(body(), v);
    return MeVector3Dot(v, MdtBodyGetTransformPtr(body())[0]);
}

/* Turns a minute, of the engine: it turns as the rear wheels do, and does not stall. */
static MeReal engineSpeed(void) {
    const MeReal rate =
        (MdtCarWheelGetHingeAngleRate(joint[REAR_LEFT]) + MdtCarWheelGetHingeAngleRate(joint[REAR_RIGHT])) / 2;
    return MeMAX(idle, MeFabs(rate) * gearRatio[MeMAX(gear, 0)] * 30 / ME_PI);
}

/* N m at full throttle: the most, 120, at 4000 turns a minute. */
static MeReal torqueAt(MeReal turns) {
    const MeReal x = (turns - 4000) / 5000;
    return 120 * (1 - x * x);
}

/* ---- the driver ------------------------------------------------------------------------------------------------- */

/* Round the course at 9 m/s, slower in bends. */
static MeReal driveCourse(int *pedal) {
    *pedal = speedOf() < 9 - 8 * MeFabs(steering);
    return MeAtan(wheelbase * driveAlong(body(), course, COURSE, &target));
}

/* The fastest bend costs 7 m/s² to the side. */
static MeReal maxSteering(void) {
    const MeReal v = speedOf();
    return MeMIN(max, MeAtan(wheelbase * 7 / MeMAX(v * v, 1)));
}

/* What the driver does with the pedals (1: forward, -1: brake or back) and where the steering is to be. */
static MeReal askDriver(int *pedal) {
    if (driveForward() || driveLeft())
        isAutomatic = MEFALSE;
    if (isAutomatic)
        return driveCourse(pedal);
    *pedal = driveForward();
    return (MeReal)driveLeft() * max;
}

/* The steering wheel turns at 1.5 rad/s. */
static void turnSteering(MeReal wanted) {
    const MeReal limit = maxSteering(), further = (MeReal)1.5 * playFrame;
    steering += MeCLAMP(MeCLAMP(wanted, -limit, limit) - steering, -further, further);
}

/* ---- the car's machinery ---------------------------------------------------------------------------------------- */

/* The inner front wheel runs on a smaller circle than the outer one and has to be turned further. */
static void steerWheel(int i) {
    const MeReal t = MeTan(steering), wanted = MeAtan2(wheelbase * t, wheelbase + wheelZ(i) * t);
    MdtCarWheelSetSteeringPositionMotor(joint[i], -wanted, 20, 1,
                                        2000); /* the angle is the chassis' against the wheel */
}

static void changeGear(int pedal) {
    const MeReal v = speedOf(), turns = engineSpeed();
    if (pedal < 0 && v < (MeReal)0.5)
        gear = -1;
    else if (gear < 0 && pedal > 0)
        gear = 0;
    else if (gear >= 0 && gear + 1 < GEARS && turns > shiftUp)
        gear++;
    else if (gear > 0 && turns < shiftDown)
        gear--;
}

/* A wheel's motor: the engine turns it up to its own greatest speed, a brake holds it; off the pedals the engine
 * drags. */
static void driveWheel(int i, int pedal) {
    const MeBool isRear = i >= REAR_LEFT, braking = pedal < 0 && gear >= 0;
    const MeReal ratio = gearRatio[MeMAX(gear, 0)] * (gear < 0 ? -1 : 1);
    if (isRear && handbrake)
        MdtCarWheelSetHingeLimitedForceMotor(joint[i], 0, handbrakeTorque);
    else if (braking)
        MdtCarWheelSetHingeLimitedForceMotor(joint[i], 0, brakeTorque);
    else if (isRear && pedal)
        MdtCarWheelSetHingeLimitedForceMotor(joint[i], fastest * ME_PI / 30 / ratio, torque * MeFabs(ratio) / 2);
    else
        MdtCarWheelSetHingeLimitedForceMotor(joint[i], 0, isRear ? 40 : 0);
}

static void resistAir(void) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(body(), v);
    const MeReal k = -drag * MeVector3Magnitude(v);
    MdtBodyAddForce(body(), k * v[0], k * v[1], k * v[2]);
}

static void control(void) {
    int pedal = 0;
    turnSteering(askDriver(&pedal));
    if (pedal || steering != 0)
        MdtBodyEnable(body()); /* a parked car sleeps */
    changeGear(pedal);
    torque = pedal > 0 || (pedal < 0 && gear < 0) ? torqueAt(engineSpeed()) : 0;
    for (int i = 0; i < WHEELS; i++) {
        if (i < REAR_LEFT)
            steerWheel(i);
        driveWheel(i, pedal);
    }
    resistAir();
}

/* ---- keys and status -------------------------------------------------------------------------------------------- */

static void placeCar(MeReal x, MeReal z) {
    playPlace(chassis, x, radius + rideHeight, z, 1, 0);
    for (int i = 0; i < WHEELS; i++)
        playPlace(wheel[i], x + wheelX(i), radius, z + wheelZ(i), 1, 0);
    gear = 0;
    steering = 0;
    handbrake = MEFALSE;
}

/* A triangle of crates, across the car's way. */
static void placeCrates(void) {
    int n = 0;
    for (int row = 0; row < 4; row++)
        for (int i = 0; i < 4 - row; i++, n++)
            playPlace(crate[n], 26, (MeReal)(0.35 + 0.7 * row), (MeReal)(0.8 * (i - (3 - row) / 2.) - 8), 1, 0);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    placeCar(-26, -8);
    placeCrates();
    isAutomatic = METRUE;
    target = 0;
    MeAppFollow(playApp, body(), 9, .22f);
    RCameraRotateAngle(playRc, -.6f); /* a little from the side */
}

static void MEAPI toggleAutomatic(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    isAutomatic = !isAutomatic;
}

static void MEAPI toggleHandbrake(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    handbrake = !handbrake;
}

/* Puts a car that has rolled over back on its wheels, where it is. */
static void MEAPI upright(RRender *context, void *userdata) {
    const MeReal *at = MdtBodyGetTransformPtr(body())[3];
    const MeReal x = at[0], y = at[1] + 1, z = at[2];
    (void)context, (void)userdata;
    placeCar(x, z);
    MdtBodySetPosition(body(), x, y, z);
    for (int i = 0; i < WHEELS; i++)
        MdtBodySetPosition(McdModelGetBody(wheel[i]), x + wheelX(i), y - rideHeight, z + wheelZ(i));
}

static int wheelsOnGround(void) {
    int count = 0;
    for (int i = 0; i < WHEELS; i++) {
        MdtContactID c = MdtBodyGetFirstContact(McdModelGetBody(wheel[i]));
        while (c && MdtContactGetPenetration(c) < (MeReal)-0.001)
            c = MdtBodyGetNextContact(McdModelGetBody(wheel[i]), c);
        count += c != 0;
    }
    return count;
}

/* m/s, turns a minute, N m, degrees and degrees a second, wheels on the ground, m, cm */
static void showFigures(void) {
    static const char *const gearName[] = {"R", "1", "2", "3", "4"};
    char text[320];
    MeVector3 w;
    const MeReal *at = MdtBodyGetTransformPtr(body())[3];
    MdtBodyGetAngularVelocity(body(), w);
    int n = snprintf(text, sizeof text, "speed %.2f m/s  gear %s  %.0f rpm  steer %+.2f deg  turn %+.2f deg/s",
                     (double)speedOf(), gearName[gear + 1], (double)engineSpeed(), (double)(steering * 180 / ME_PI),
                     (double)(w[1] * 180 / ME_PI));
    n += snprintf(text + n, sizeof text - (size_t)n, "  down %d of 4  x %.2f y %.3f z %.2f m  springs",
                  wheelsOnGround(), (double)at[0], (double)at[1], (double)at[2]);
    for (int i = 0; i < WHEELS; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, " %+.1f",
                      (double)MdtCarWheelGetSuspensionHeight(joint[i]) * 100);
    snprintf(text + n, sizeof text - (size_t)n, " cm");
    RRenderSetStatusText(playRc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    control();
    MstUniverseStep(playUniverse, playFrame);
    showFigures();
}

/* ---- what there is ---------------------------------------------------------------------------------------------- */

/* The lower box carries a cabin; the centre of mass is lower than both boxes' middle, where engine and axles are. */
static void createChassis(void) {
    const MeVector3 low = {0, (MeReal)-0.2, 0};
    const McdFrameworkID frame = playUniverse->frame;
    const McdGeometryID whole = McdAggregateCreate(frame, 2);
    MeMatrix4TMMakeIdentity(lowerTM);
    MeMatrix4TMMakeIdentity(cabinTM);
    MeVector3Set(cabinTM[3], (MeReal)-0.25, (MeReal)0.45, 0);
    McdAggregateAddElement(whole, McdBoxCreate(frame, (MeReal)3.6, (MeReal)0.45, (MeReal)1.35), lowerTM);
    McdAggregateAddElement(whole, McdBoxCreate(frame, (MeReal)1.6, (MeReal)0.45, (MeReal)1.2), cabinTM);
    chassis = MstModelAndBodyCreate(playUniverse, whole, 300);
    MdtBodySetMass(body(), chassisMass);
    MstAutoSetInertialTensor(chassis);
    MdtBodySetCenterOfMassRelativePosition(body(), low);
}

static void createWheel(int i) {
    wheel[i] = MstModelAndBodyCreate(playUniverse, McdSphereCreate(playUniverse->frame, radius), 100);
    MdtBodySetMass(McdModelGetBody(wheel[i]), wheelMass);
    MstAutoSetInertialTensor(wheel[i]);
    McdModelSetMaterial(wheel[i], (int)wheelMaterial);
    McdSpaceDisablePair(wheel[i], chassis);
}

/* The reference is where the spring has no force: so much lower that the car at rest stands at height 0. */
static void createJoint(int i) {
    const MeReal sag = chassisMass * (MeReal)9.81 / 4 / stiffness;
    joint[i] = MdtCarWheelCreate(playUniverse->world);
    MdtCarWheelSetBodies(joint[i], body(), McdModelGetBody(wheel[i]));
    MdtCarWheelSetPosition(joint[i], wheelX(i), radius, wheelZ(i));
    MdtCarWheelSetSteeringAndHingeAxes(joint[i], 0, 1, 0, 0, 0, -1); /* rolling forward is positive about -z */
    MdtCarWheelSetSteeringLock(joint[i], i >= REAR_LEFT);
    MdtCarWheelSetSuspension(joint[i], stiffness, damping, 0, (MeReal)-0.18, (MeReal)0.18, -sag);
    MdtCarWheelEnable(joint[i]);
}

static void createCar(void) {
    wheelMaterial = MstBridgeGetNewMaterial(playUniverse->bridge);
    MdtContactParamsID rubber = playContact(wheelMaterial, MstBridgeGetDefaultMaterial());
    MdtContactParamsSetSurface(rubber, 1, 0);
    createChassis();
    for (int i = 0; i < WHEELS; i++)
        createWheel(i);
    placeCar(0, 0); /* wheels and chassis as for driving straight on, then the joints */
    for (int i = 0; i < WHEELS; i++)
        createJoint(i);
}

/* A wedge to jump from, 1.1 m high. */
static void createRamp(void) {
    static const MeVector3 corner[6] = {{-4, 0, -2}, {-4, 0, 2},           {3, 0, -2},
                                        {3, 0, 2},   {3, (MeReal)1.1, -2}, {3, (MeReal)1.1, 2}};
    MeMatrix4TMMakeIdentity(rampTM);
    MeVector3Set(rampTM[3], 8, 0, -8);
    playFixed(McdConvexMeshCreateHull(playUniverse->frame, corner, 6, 0), rampTM, RPalette[1]);
}

static void createWorld(void) {
    static const float wood[4] = {.76f, .58f, .36f, 1};
    const McdGeometryID cube = McdBoxCreate(playUniverse->frame, (MeReal)0.7, (MeReal)0.7, (MeReal)0.7);
    MeAppTerrainCreateModel(terrain, playUniverse);
    MeAppTerrainShow(terrain, playRc);
    createRamp();
    for (int i = 0; i < CRATES; i++)
        crate[i] = playModel(cube, 40, 0, 0, 0, wood);
}

static void createCarGraphics(void) {
    const float glass[4] = {.45f, .62f, .72f, 1}, lamp[4] = {.97f, .93f, .70f, 1}, bar[4] = {.30f, .32f, .36f, 1};
    const float paint[4] = {.76f, .20f, .17f, 1};
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(body());
    partBox(playRc, 3.6f, .38f, 1.35f, 0, (MeReal)-0.03, 0, paint, tm);
    partBox(playRc, 1.0f, .08f, 1.2f, (MeReal)1.15, (MeReal)0.19, 0, paint, tm);
    partBox(playRc, .6f, .08f, 1.2f, (MeReal)-1.4, (MeReal)0.19, 0, paint, tm);
    partBox(playRc, 1.6f, .34f, 1.14f, (MeReal)-0.25, (MeReal)0.37, 0, glass, tm);
    partBox(playRc, 1.62f, .1f, 1.2f, (MeReal)-0.25, (MeReal)0.6, 0, paint, tm);
    for (int side = -1; side <= 1; side += 2) {
        partBox(playRc, .05f, .14f, .3f, (MeReal)1.8, (MeReal)0.03, (MeReal)(0.45 * side), lamp, tm);
        partBox(playRc, .05f, .1f, .25f, (MeReal)-1.8, (MeReal)0.03, (MeReal)(0.5 * side), RPalette[1], tm);
        partBox(playRc, .1f, .14f, 1.5f, (MeReal)(1.82 * side), (MeReal)-0.2, 0, bar, tm);
        partBox(playRc, .12f, .12f, 1.6f, (MeReal)(1.2 * side), (MeReal)-0.16, 0, bar, tm);
    }
    for (int i = 0; i < WHEELS; i++)
        partWheel(playRc, (float)radius, .26f, MdtBodyGetTransformPtr(McdModelGetBody(wheel[i])));
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "A car, hills, a ramp and some crates.",
        "$UP - throttle",
        "$DOWN - brake; standing: back",
        "$LEFT, $RIGHT - steer",
        "$ACTION1 - handbrake on or off",
        "$ACTION2 - start again",
        "$ACTION3 - let the car drive itself, or stop that",
        "$ACTION4 - back on its wheels",
        "The figures: m/s, turns a minute, N m, degrees, degrees a second, wheels on the ground, m, cm.",
    };
    terrain = terrainCreate(30, 3);
    if (!terrain || !playStart(argc, argv, "Car", 1 + WHEELS + CRATES))
        return 1;
    createWorld();
    createCar();
    createCarGraphics();
    playHelp(help, 9);
    RRenderSetActionNCallBack(playRc, 1, toggleHandbrake, 0);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, toggleAutomatic, 0);
    RRenderSetActionNCallBack(playRc, 4, upright, 0);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
