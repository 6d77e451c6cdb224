/* An arm of 1 kg and 1 m on a hinge, level at first: a motor of at most 10 N m lifts it to a stop at 45 degrees. After
 * 5 s a cube of 20 kg falls 1 m onto its tip, beats it down, and slides off; the arm comes back.
 *
 * At the stop the motor gives all it has, 10 N m, gravity takes m g l/2 cos 45 = 3.4684 of it, and the stop the rest,
 * 6.5316. What passes as contacts is made by hand, in the plane of the arm. */
#include "Mdt.h"
#include "karma_test.h"

static const double pi = 3.14159265358979323846, gravity = 9.81;
static const double motorTorque = 10, motorRate = 50;       /* N m, rad/s */
static const double cubeMass = 20, cubeHalf = .1, fall = 1; /* kg, m, m */
static const double settling = 5, frame = 1.0 / 60;         /* s */
static const double armWidth = .05;                         /* m, to either side, where it touches the cube */
enum { MAX_CONTACTS = 16 };

/* What is asserted. The goals are 1e-6 of all of them, and rest. */
typedef struct Bound {
    const char *what;
    double single, twice; /* by precision */
} Bound;
enum { ANGLE, REST, TORQUE, OVERSHOOT, GAP, GAP_AFTER, GAIN, BOUNDS };
static const Bound bounds[BOUNDS] = {
    [ANGLE] = {"angle against 45 degrees, at rest, rad", 1e-6, 1e-9},
    [REST] = {"speed at rest, rad/s", 1e-7, 1e-7},
    [TORQUE] = {"a torque at rest, relative", 1e-6, 5e-7},
    [OVERSHOOT] = {"angle beyond the stop at any time, rad", 1e-6, 1e-8},
    [GAP] = {"gap of the hinge before the cube, m", 1e-6, 1e-9},
    [GAP_AFTER] = {"gap of the hinge from then on, m", 1e-4, 1e-4},
    [GAIN] = {"energy that nothing has brought, J", 1e-3, 1e-8},
};

typedef struct Arm {
    MdtWorldID world;
    MdtBodyID body, cube;
    MdtHingeID motor, stop; /* the same hinge, or two where their torques are to be told apart */
    MdtContactID contacts[MAX_CONTACTS];
    int numContacts;
    double worst[BOUNDS];
} Arm;

static void note(Arm *a, int which, double error) {
    if (!(error <= a->worst[which]))
        a->worst[which] = error;
}

/* Building */

static MdtBodyID addBody(MdtWorldID w, double mass, double lx, double ly, double lz, double x, double y) {
    const MdtBodyID b = MdtBodyCreate(w);
    MeMatrix3 inertia;
    MdtMakeInertiaTensorBox(mass, lx, ly, lz, inertia);
    MdtBodySetMass(b, mass);
    MdtBodySetInertiaTensor(b, inertia);
    MdtBodySetPosition(b, x, y, 0);
    MdtBodyEnable(b);
    return b;
}

static MdtHingeID addHinge(const Arm *a) {
    const MdtHingeID j = MdtHingeCreate(a->world);
    MdtHingeSetBodies(j, a->body, 0);
    MdtHingeSetPosition(j, 0, 0, 0);
    MdtHingeSetAxis(j, 0, 0, 1);
    MdtHingeEnable(j);
    return j;
}

static void setStop(MdtLimitID limit) {
    const MdtSingleLimitID stops[2] = {MdtLimitGetLowerLimit(limit), MdtLimitGetUpperLimit(limit)};
    MdtSingleLimitSetStop(stops[0], -2 * pi);
    MdtSingleLimitSetStop(stops[1], pi / 4);
    MdtSingleLimitSetRestitution(stops[1], 0);
    MdtLimitActivateLimits(limit, 1);
}

static Arm makeArm(int hinges) {
    Arm a = {.numContacts = 0};
    a.world = MdtWorldCreate(2, 2 + MAX_CONTACTS);
    MdtWorldSetAutoDisable(a.world, 0);
    MdtWorldSetEpsilon(a.world, 0);
    MdtWorldSetGravity(a.world, 0, -gravity, 0);
    a.body = addBody(a.world, 1, 1, 1e-3, 1e-3, .5, 0);
    a.motor = addHinge(&a);
    a.stop = hinges > 1 ? addHinge(&a) : a.motor;
    MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(a.motor), motorRate, motorTorque);
    setStop(MdtHingeGetLimit(a.stop));
    return a;
}

/* Measuring */

typedef struct Pose {
    double x, y, cosine, sine, vx, vy, rate;
} Pose;

static Pose poseOf(MdtBodyID b) {
    MeVector3 p, v, w;
    MeMatrix3 r;
    MdtBodyGetPosition(b, p);
    MdtBodyGetOrientation(b, r);
    MdtBodyGetLinearVelocity(b, v);
    MdtBodyGetAngularVelocity(b, w);
    return (Pose){p[0], p[1], r[0][0], r[1][0], v[0], v[1], w[2]};
}

static double angleOf(const Arm *a) {
    const Pose p = poseOf(a->body);
    return atan2(p.sine, p.cosine);
}

static double energyOf(MdtBodyID b) {
    return (double)MdtBodyGetKineticEnergy(b) + (double)MdtBodyGetMass(b) * gravity * poseOf(b).y;
}

/* The energy of all, less what the motor has done: it can only fall. */
static double balance(const Arm *a) {
    return energyOf(a->body) + (a->cube ? energyOf(a->cube) : 0) - motorTorque * angleOf(a);
}

/* About the hinge's axis, on the arm, in the last step. */
static double torqueOf(const Arm *a, MdtHingeID j) {
    MeVector3 force, torque;
    const Pose p = poseOf(a->body);
    MdtHingeGetForce(j, 0, force);
    MdtHingeGetTorque(j, 0, torque);
    return (double)torque[2] + p.x * (double)force[1] - p.y * (double)force[0];
}

static void watch(Arm *a) {
    const Pose p = poseOf(a->body);
    note(a, OVERSHOOT, angleOf(a) - pi / 4);
    note(a, a->cube ? GAP_AFTER : GAP, hypot(p.x - .5 * p.cosine, p.y - .5 * p.sine));
}

/* Contacts in the plane: each is two, at either side of it */

static void addContacts(Arm *a, double x, double y, double nx, double ny, double depth) {
    for (int side = -1; side <= 1; side += 2) {
        ck_assert_int_lt(a->numContacts, MAX_CONTACTS);
        const MdtContactID c = MdtContactCreate(a->world);
        const MdtContactParamsID p = MdtContactGetParams(c);
        MdtContactSetBodies(c, a->cube, a->body);
        MdtContactSetPosition(c, x, y, side * armWidth);
        MdtContactSetNormal(c, nx, ny, 0);
        MdtContactSetPenetration(c, depth);
        MdtContactParamsSetType(p, MdtContactTypeFriction2D);
        MdtContactParamsSetFrictionModel(p, MdtFrictionModelCone);
        MdtContactParamsSetFrictionCoeffecient(p, .5);
        MdtContactEnable(c);
        a->contacts[a->numContacts++] = c;
    }
}

/* The tip against the nearest face of the cube. */
static void touchTip(Arm *a, const Pose *arm, const Pose *cube, double reach) {
    const double x = arm->x + .5 * arm->cosine, y = arm->y + .5 * arm->sine, dx = x - cube->x, dy = y - cube->y;
    const double u = dx * cube->cosine + dy * cube->sine, v = dy * cube->cosine - dx * cube->sine;
    const double depth = cubeHalf - fmax(fabs(u), fabs(v));
    const double nu = fabs(u) > fabs(v) ? -copysign(1, u) : 0, nv = nu == 0 ? -copysign(1, v) : 0;
    if (depth > -reach && fmin(fabs(u), fabs(v)) < cubeHalf)
        addContacts(a, x, y, nu * cube->cosine - nv * cube->sine, nu * cube->sine + nv * cube->cosine, depth);
}

/* The corners of the cube against the side of the arm where its centre is. */
static void touchCorners(Arm *a, const Pose *arm, const Pose *cube, double reach) {
    const double side = copysign(1, (cube->y - arm->y) * arm->cosine - (cube->x - arm->x) * arm->sine);
    for (int k = 0; k < 4; k++) {
        const double u = k & 1 ? cubeHalf : -cubeHalf, v = k & 2 ? cubeHalf : -cubeHalf;
        const double x = cube->x + u * cube->cosine - v * cube->sine, y = cube->y + u * cube->sine + v * cube->cosine;
        const double dx = x - arm->x, dy = y - arm->y;
        const double along = dx * arm->cosine + dy * arm->sine, above = dy * arm->cosine - dx * arm->sine;
        const double depth = -side * above;
        if (fabs(along) < .5 && depth > -reach && depth < cubeHalf)
            addContacts(a, x, y, -side * arm->sine, side * arm->cosine, depth);
    }
}

static void setContacts(Arm *a, double h) {
    const Pose arm = poseOf(a->body), cube = poseOf(a->cube);
    const double speed = hypot(cube.vx, cube.vy) + fabs(cube.rate) * 2 * cubeHalf + fabs(arm.rate);
    while (a->numContacts > 0)
        MdtContactDestroy(a->contacts[--a->numContacts]);
    touchTip(a, &arm, &cube, .02 * cubeHalf + h * speed);
    touchCorners(a, &arm, &cube, .02 * cubeHalf + h * speed);
}

/* Running */

static void run(Arm *a, double duration, int substeps) {
    const double h = frame / substeps;
    const long n = lround(duration / h);
    for (long i = 0; i < n; i++) {
        if (a->cube)
            setContacts(a, h);
        MdtWorldStep(a->world, h);
        watch(a);
    }
}

/* Over the last second of `duration`; any motion is a buzz. */
static void runAndRest(Arm *a, double duration, int substeps) {
    run(a, duration - 1, substeps);
    for (long i = 0; i < 60; i++) {
        run(a, frame, substeps);
        note(a, ANGLE, fabs(angleOf(a) - pi / 4));
        note(a, REST, fabs(poseOf(a->body).rate));
    }
}

static void check(const Arm *a, int substeps) {
    for (int i = 0; i < BOUNDS; i++)
        ck_assert_msg(a->worst[i] <= TOL(bounds[i].single, bounds[i].twice), "%s, %d sub-steps: %g, not below %g",
                      bounds[i].what, substeps, a->worst[i], TOL(bounds[i].single, bounds[i].twice));
}

static const int substeps[] = {1, 4};
enum { RATES = sizeof substeps / sizeof *substeps };

TEST(the_motor_holds_the_arm_at_its_stop) {
    for (int i = 0; i < RATES; i++) {
        Arm a = makeArm(1);
        runAndRest(&a, settling, substeps[i]);
        note(&a, TORQUE, fabs(torqueOf(&a, a.motor) / (.5 * gravity * cos(pi / 4)) - 1));
        check(&a, substeps[i]);
        MdtWorldDestroy(a.world);
    }
}

/* Motor and stop are of two hinges in one place: ten rows, of which five say nothing new, and the two torques about the
 * axis, which nothing else can bring. */
TEST(the_stop_takes_what_the_motor_gives_too_much) {
    for (int i = 0; i < RATES; i++) {
        Arm a = makeArm(2);
        runAndRest(&a, settling, substeps[i]);
        note(&a, TORQUE, fabs(torqueOf(&a, a.motor) / motorTorque - 1));
        note(&a, TORQUE, fabs(torqueOf(&a, a.stop) / (.5 * gravity * cos(pi / 4) - motorTorque) - 1));
        assert_near(torqueOf(&a, a.stop), -6.5316, 1e-3);
        check(&a, substeps[i]);
        MdtWorldDestroy(a.world);
    }
}

/* The cube weighs more than the motor can bear. */
TEST(the_arm_comes_back_when_a_cube_has_beaten_it_down) {
    for (int i = 0; i < RATES; i++) {
        Arm a = makeArm(1);
        double lowest = 0;
        run(&a, settling, substeps[i]);
        a.cube = addBody(a.world, cubeMass, 2 * cubeHalf, 2 * cubeHalf, 2 * cubeHalf, cos(pi / 4),
                         sin(pi / 4) + cubeHalf + fall);
        const double before = balance(&a);
        for (int k = 0; k < 240; k++) {
            run(&a, frame, substeps[i]);
            lowest = fmin(lowest, angleOf(&a));
            note(&a, GAIN, balance(&a) - before);
        }
        runAndRest(&a, 1, substeps[i]);
        assert_below(lowest, -.5);
        assert_below(poseOf(a.cube).y, -10);
        check(&a, substeps[i]);
        MdtWorldDestroy(a.world);
    }
}
