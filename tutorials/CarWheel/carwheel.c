/* CarWheel: a small car (Dynamics guide, chapter 3, "MdtCarWheel" and "How to Use Contacts").
 *
 * Four joints tie four wheels to a chassis. Each lets its wheel roll about the hinge axis, turn about the steering axis
 * and slide along it against a damped spring, the suspension. The rear wheels' steering is locked, and their hinge
 * motors are the engine; the front wheels' steering motors turn them to the angle that is wanted.
 *
 * The program itself finds where the wheels touch the ground, as Bounce does: a wheel is a disc, the ground a plane
 * with some bumps, which are cylinders lying across the road. One contact per wheel, with friction in proportion to
 * the load (the normal-force model): that is what carries, drives and steers the car.
 *
 * Left alone the car follows the dashed line; the arrow keys take the wheel.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RParameter.h"
#include "RGeometryUtils.h"
#include "parts.h"
#include <stdio.h>
#include <stdlib.h>

enum { FRONT_LEFT, FRONT_RIGHT, REAR_LEFT, REAR_RIGHT, WHEELS };

#define RINGS 8 /* turns of a spring's coil */

/* A bump: a cylinder along z whose middle is so far below the ground that it reaches bumpHeight above it. */
typedef struct {
    MeReal x, z, width;
} Bump;

static const MeReal step = (MeReal)(1.0 / 60);         /* s */
static const MeReal chassisMass = 600, wheelMass = 30; /* kg */
static const MeReal radius = (MeReal)0.45;             /* m, of a wheel */
static const MeReal wheelbase = (MeReal)2.4;           /* m, from axle to axle */
static const MeReal track = (MeReal)1.8;               /* m, from the left wheels to the right ones */
static const MeReal rideHeight = (MeReal)0.35;         /* m, of the chassis' centre above the wheels' */
static const MeReal torque = 600;      /* N m, of the engine at each rear wheel; the brake has as much */
static const MeReal friction = 1;      /* coefficient */
static const MeReal stiffness = 15000; /* N/m, of one wheel's suspension */
static const MeReal bumpRadius = (MeReal)1.5, bumpHeight = (MeReal)0.22; /* m */
static const Bump bumps[] = {{-3, 0, 5}, {1, 0, 5}, {4, -17, 2}, {-2, -15, 2}};
static const MeReal straight = 12,
                    bend = 8; /* m: the route is two straights of twice that length and two half circles */

static MdtWorldID world;
static MdtBodyID chassis, wheel[WHEELS];
static MdtCarWheelID joint[WHEELS];
static MdtContactID contact[WHEELS]; /* of the last step; 0: the wheel was in the air */

static MeReal speed, steering; /* m/s and rad, positive to the left: what the driver wants */
static int isAutomatic;
static MeReal damping = 1500; /* N s/m, of one wheel's suspension */

static RRender *rc;
static MeMatrix4 ringTM[WHEELS][RINGS];
static MeVector3 lookAt;

/* Forward is +x, left is -z. */
static MeReal wheelX(int i) {
    return i < REAR_LEFT ? wheelbase / 2 : -wheelbase / 2;
}

static MeReal wheelZ(int i) {
    return i % 2 ? track / 2 : -track / 2;
}

static void place(MdtBodyID body, MeReal x, MeReal y, MeReal z) {
    MdtBodySetPosition(body, x, y, z);
    MdtBodySetQuaternion(body, 1, 0, 0, 0);
    MdtBodySetLinearVelocity(body, 0, 0, 0);
    MdtBodySetAngularVelocity(body, 0, 0, 0);
    MdtBodyEnable(body);
}

static void placeCar(MeReal x, MeReal z) {
    place(chassis, x, radius + rideHeight, z);
    for (int i = 0; i < WHEELS; i++)
        place(wheel[i], x + wheelX(i), radius, z + wheelZ(i));
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    placeCar(1 - straight, 0);
    isAutomatic = 1;
    speed = (MeReal)5.5;
    steering = 0;
    MdtBodyGetPosition(chassis, lookAt);
}

/* The reference is where the spring has no force: so much lower that the car at rest stands at height 0. */
static void applySuspension(void) {
    const MeReal sag = chassisMass * (MeReal)9.8 / 4 / stiffness;
    for (int i = 0; i < WHEELS; i++)
        MdtCarWheelSetSuspension(joint[i], stiffness, damping, 0, (MeReal)-0.25, (MeReal)0.25, -sag);
}

static void MEAPI driveByHand(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    isAutomatic = 0;
}

static void MEAPI brake(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    isAutomatic = 0;
    speed = 0;
}

static void MEAPI straightOn(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    isAutomatic = 0;
    steering = 0;
}

static void MEAPI toggleDamping(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    damping = damping > 1000 ? 200 : 1500;
    applySuspension();
}

/* Follows the route: its curvature, less what takes the car back when it is off to the left, or points to the left. */
static void steerAlongRoute(void) {
    const MeReal *at = MdtBodyGetTransformPtr(chassis)[3], *forward = MdtBodyGetTransformPtr(chassis)[0];
    MeReal way[2] = {at[2] > -bend ? 1 : -1, 0}, curvature = 0, off = way[0] * (-bend - at[2]) + bend;
    if (MeFabs(at[0]) > straight) {
        const MeReal x = at[0] - (at[0] > 0 ? straight : -straight), z = at[2] + bend, r = MeSqrt(x * x + z * z);
        way[0] = z / r;
        way[1] = -x / r;
        curvature = 1 / bend;
        off = bend - r;
    }
    /* In a bend the rear axle's middle, which rolls straight ahead, is half the wheelbase behind. */
    const MeReal turned = forward[0] * way[1] - forward[2] * way[0] + curvature * wheelbase / 2;
    steering = MeAtan(wheelbase * (curvature - (MeReal)0.15 * off - (MeReal)0.8 * turned));
}

/* The inner front wheel runs on a smaller circle than the outer one and has to be turned further. */
static void steerWheel(int i) {
    const MeReal t = MeTan(steering), wanted = MeAtan2(wheelbase * t, wheelbase + wheelZ(i) * t);
    MdtCarWheelSetSteeringPositionMotor(joint[i], -wanted, 20, 1,
                                        2000); /* the angle is the chassis' against the wheel */
}

/* In a bend the rear wheels, too, run on circles of different radii: an electronic differential. */
static void driveWheel(int i) {
    const MeReal circle = 1 + wheelZ(i) * MeTan(steering) / wheelbase;
    const MeBool isDriven = i >= REAR_LEFT || speed == 0; /* the brake acts on all wheels */
    MdtCarWheelSetHingeLimitedForceMotor(joint[i], circle * speed / radius, isDriven ? torque : 0);
}

static void control(void) {
    if (isAutomatic)
        steerAlongRoute();
    for (int i = 0; i < WHEELS; i++) {
        if (i < REAR_LEFT)
            steerWheel(i);
        driveWheel(i);
    }
}

/* How deep the disc round a point is in the ground, and the normal there. The deepest place counts. */
static MeReal touch(const MeReal at[3], MeVector3 normal) {
    MeReal deepest = radius - at[1];
    MeVector3Set(normal, 0, 1, 0);
    for (size_t i = 0; i < sizeof bumps / sizeof bumps[0]; i++) {
        const MeReal x = at[0] - bumps[i].x, y = at[1] - (bumpHeight - bumpRadius), d = MeSqrt(x * x + y * y);
        if (MeFabs(at[2] - bumps[i].z) > bumps[i].width / 2 || radius + bumpRadius - d < deepest)
            continue;
        deepest = radius + bumpRadius - d;
        MeVector3Set(normal, x / d, y / d, 0);
    }
    return deepest;
}

static void createContact(int i) {
    const MeReal *at = MdtBodyGetTransformPtr(wheel[i])[3];
    MeVector3 n;
    const MeReal penetration = touch(at, n);
    if (penetration <
        (MeReal)-0.02) /* a little above the ground the contact lets the wheel come down, and no further */
        return;
    contact[i] = MdtContactCreate(world, wheel[i], 0);
    MdtContactSetPosition(contact[i], at[0] - radius * n[0], at[1] - radius * n[1], at[2]);
    MdtContactSetNormal(contact[i], n[0], n[1], n[2]);
    MdtContactSetPenetration(contact[i], penetration);
    MdtContactSetRadius(contact[i], 0, radius); /* round: the wheel rolls */
    MdtContactParamsSetSurface(MdtContactGetParams(contact[i]), friction, 0);
    MdtContactEnable(contact[i]);
}

static void renewContacts(void) {
    for (int i = 0; i < WHEELS; i++) {
        if (contact[i]) {
            MdtContactDisable(contact[i]);
            MdtContactDestroy(contact[i]);
            contact[i] = 0;
        }
        createContact(i);
    }
}

/* The coils: from beside the wheel's middle to a mount at the chassis. */
static void drawSprings(void) {
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(chassis);
    MeMatrix3 body, upright, R;
    MdtBodyGetOrientation(chassis, body);
    MeMatrix3MakeRotationX(upright, ME_PI / 2);
    MeMatrix3MultiplyMatrix(R, body, upright);
    for (int i = 0; i < WHEELS; i++) {
        const MeReal low = MdtCarWheelGetSuspensionHeight(joint[i]) - rideHeight, high = (MeReal)0.35;
        for (int k = 0; k < RINGS; k++) {
            const MeVector3 at = {wheelX(i), low + (high - low) * ((MeReal)k + (MeReal)0.5) / RINGS,
                                  wheelZ(i) * (MeReal)0.7};
            MeVector3 p;
            MeMatrix4TMTransform(p, tm, at);
            MeMatrix4TMMakeFromRotationAndPosition(ringTM[i][k], R, p[0], p[1], p[2]);
        }
    }
}

/* The camera glides after the car. */
static void follow(void) {
    MeVector3 at;
    MdtBodyGetPosition(chassis, at);
    MeVector3Lerp(lookAt, lookAt, at, (MeReal)0.15);
    const AcmeVector3 p = {(float)lookAt[0], .6f, (float)lookAt[2]};
    RCameraSetLookAt(rc, p);
}

static void showFigures(void) {
    char text[220];
    MeVector3 v, w, at;
    MdtBodyGetLinearVelocity(chassis, v);
    MdtBodyGetAngularVelocity(chassis, w);
    MdtBodyGetPosition(chassis, at);
    const double moving = sqrt((double)v[0] * v[0] + (double)v[2] * v[2]);
    int n = snprintf(text, sizeof text,
                     "speed %.2f m/s    steering %+.1f deg    turns %+.2f deg/s    x %.2f m    left %.3f m", moving,
                     (double)steering * 180 / (double)ME_PI, (double)w[1] * 180 / (double)ME_PI, (double)at[0],
                     -(double)at[2]);
    snprintf(
        text + n, sizeof text - (size_t)n, "    suspension (cm) %+.1f %+.1f %+.1f %+.1f",
        (double)MdtCarWheelGetSuspensionHeight(joint[0]) * 100, (double)MdtCarWheelGetSuspensionHeight(joint[1]) * 100,
        (double)MdtCarWheelGetSuspensionHeight(joint[2]) * 100, (double)MdtCarWheelGetSuspensionHeight(joint[3]) * 100);
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    control();
    renewContacts();
    MdtWorldStep(world, step);
    drawSprings();
    follow();
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createWheel(int i) {
    MeMatrix3 inertia;
    wheel[i] = MdtBodyCreate(world);
    MdtBodySetMass(wheel[i], wheelMass);
    MdtMakeInertiaTensorSphere(wheelMass, radius, inertia); /* 2/5 m r^2 */
    MdtBodySetInertiaTensor(wheel[i], inertia);
}

static void createDynamics(void) {
    MeMatrix3 inertia;
    world = MdtWorldCreate(1 + WHEELS, 2 * WHEELS, 1, 100); /* typical sizes: 1 m, 100 kg */
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    MdtWorldSetAutoDisable(world, 0); /* a parked car is ready to go */
    chassis = MdtBodyCreate(world);
    MdtBodySetMass(chassis, chassisMass);
    MdtMakeInertiaTensorBox(chassisMass, 3, (MeReal)0.6, (MeReal)1.2, inertia);
    MdtBodySetInertiaTensor(chassis, inertia);
    for (int i = 0; i < WHEELS; i++)
        createWheel(i);
    placeCar(0, 0); /* wheels and chassis as for driving straight on, then the joints */
    for (int i = 0; i < WHEELS; i++) {
        joint[i] = MdtCarWheelCreate(world);
        MdtCarWheelSetBodies(joint[i], chassis, wheel[i]);
        MdtCarWheelSetPosition(joint[i], wheelX(i), radius, wheelZ(i));
        MdtCarWheelSetSteeringAndHingeAxes(joint[i], 0, 1, 0, 0, 0, -1); /* rolling forward is positive about -z */
        MdtCarWheelSetSteeringLock(joint[i], i >= REAR_LEFT);
        MdtCarWheelEnable(joint[i]);
    }
    applySuspension();
}

/* Wheels, springs and their mounts. */
static void createWheelGraphics(void) {
    for (int i = 0; i < WHEELS; i++) {
        partWheel(rc, (float)radius, .3f, MdtBodyGetTransformPtr(wheel[i]));
        for (int k = 0; k < RINGS; k++)
            RGraphicTorusCreate(rc, .07f, .12f, RPalette[4], ringTM[i][k]);
        partBox(rc, .3f, .06f, (float)track * .8f, wheelX(i), (MeReal)0.36, 0, RPalette[7],
                MdtBodyGetTransformPtr(chassis));
    }
}

static void createChassisGraphics(void) {
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(chassis);
    partBox(rc, 3.1f, .3f, .9f, 0, 0, 0, RPalette[0], tm);
    partBox(rc, 1.7f, .26f, .9f, (MeReal)-0.55, (MeReal)0.28, 0, RPalette[0], tm);
    partBox(rc, 1.1f, .42f, .84f, (MeReal)-0.55, (MeReal)0.62, 0, RPalette[5], tm);
    partBox(rc, 1.2f, .05f, .92f, (MeReal)-0.55, (MeReal)0.85, 0, RPalette[0], tm);
    partBox(rc, .06f, .14f, .7f, (MeReal)1.56, (MeReal)0.05, 0, RPalette[4], tm);
}

/* A point of the route, so many metres from the start of the first straight. */
static void routeAt(MeReal s, AcmeVector3 p) {
    const MeReal arc = ME_PI * bend, lap = 2 * (2 * straight + arc), half = lap / 2;
    const MeReal side = s < half ? 1 : -1, on = s < half ? s : s - half;
    const MeReal a = (on - 2 * straight) / bend, x = on < 2 * straight ? on - straight : straight + bend * MeSin(a);
    const MeReal z = on < 2 * straight ? bend : bend * MeCos(a);
    p[0] = (float)(side * x);
    p[1] = .02f;
    p[2] = (float)(side * z - bend);
}

/* The part of a cylinder that is above the ground: its surface, and the two ends as fans of triangles. */
static void createBump(const Bump *bump) {
    enum { SEGMENTS = 24 };
    const MeReal max = MeAcos(1 - bumpHeight / bumpRadius), w = bump->width / 2;
    RGraphic *g = RGraphicCreateEmpty(12 * SEGMENTS);
    RObjectVertex *v = g->m_pVertices;
    for (int i = 0; i < SEGMENTS; i++) {
        MeVector3 p[2], n[2], corner[2][2];
        for (int k = 0; k < 2; k++) {
            const MeReal a = max * (2 * ((MeReal)i + (MeReal)k) / SEGMENTS - 1);
            MeVector3Set(n[k], MeSin(a), MeCos(a), 0);
            MeVector3Set(p[k], bump->x + bumpRadius * n[k][0], bumpHeight + bumpRadius * (n[k][1] - 1), bump->z);
        }
        for (int end = 0; end < 2; end++) {
            const MeReal z = bump->z + (end ? w : -w);
            const MeVector3 foot = {bump->x, 0, z}, out = {0, 0, end ? 1 : -1};
            for (int k = 0; k < 2; k++)
                MeVector3Set(corner[end][k], p[k][0], p[k][1], z);
            RSetVertex(v++, foot, out, 0, 0);
            RSetVertex(v++, corner[end][1 - end], out, 0, 0);
            RSetVertex(v++, corner[end][end], out, 0, 0);
        }
        RSetVertex(v++, corner[0][0], n[0], 0, 0);
        RSetVertex(v++, corner[1][0], n[0], 0, 0);
        RSetVertex(v++, corner[1][1], n[1], 0, 0);
        RSetVertex(v++, corner[0][0], n[0], 0, 0);
        RSetVertex(v++, corner[1][1], n[1], 0, 0);
        RSetVertex(v++, corner[0][1], n[1], 0, 0);
    }
    g->m_pObject->m_nNumVertices = 12 * SEGMENTS;
    RGraphicSetColor(g, RPalette[1]);
    RGraphicAddToList(rc, g, 0);
}

static void createGround(void) {
    const float ground[4] = {.82f, .83f, .80f, 1};
    const MeReal lap = 4 * straight + 2 * ME_PI * bend;
    for (size_t i = 0; i < sizeof bumps / sizeof bumps[0]; i++)
        createBump(&bumps[i]);
    for (int i = 0; i < 100; i++) {
        AcmeVector3 from, to;
        routeAt(lap * (MeReal)i / 100, from);
        routeAt(lap * ((MeReal)i + (MeReal)0.6) / 100, to);
        RLineAdd(rc, from, to, 1, 1, 1);
    }
    RGraphicGroundPlaneCreate(rc, 120, 2, ground, 0);
}

static void createGraphics(void) {
    createWheelGraphics();
    createChassisGraphics();
    createGround();
    RCameraSetView(rc, 11, .45f, .26f);
}

static void createControls(void) {
    static const char *const help[] = {
        "A car whose wheels steer, drive and spring.",
        "$ACTION2 - start again and follow the line",
        "$ACTION3 - wheels straight",
        "$ACTION4 - brake",
        "$ACTION5 - good or worn dampers",
    };
    static const RParameter parameters[] = {
        {"speed", "m/s", &speed, -3, 12, (MeReal)0.5, .less = "Down", .more = "Up", .changed = driveByHand},
        {"steering to the left", "rad", &steering, (MeReal)-0.6, (MeReal)0.6, (MeReal)0.05, .less = "Right",
         .more = "Left", .changed = driveByHand},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: CarWheel");
    RRenderSetAppName(rc, "CarWheel");
    RRenderCreateUserHelp(rc, help, 5);
    RRenderCreateParameters(rc, parameters, 2);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, straightOn, 0);
    RRenderSetActionNCallBack(rc, 4, brake, 0);
    RRenderSetActionNCallBack(rc, 5, toggleDamping, 0);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    rc = RRenderContextCreate(options, 0, 1);
    RRenderRefuseOptions(rc, options);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 1;
    createDynamics();
    createGraphics();
    createControls();
    Reset(rc, 0);

    atexit(cleanup);
    RRun(rc, Tick); /* does not return */
    return 0;
}
