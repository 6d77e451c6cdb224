/* Dynamics guide, chapter 2, "Getting Started": the program Drop, put together from the chapter's fragments. The
 * viewer's main loop RRun is played by a function that does what the guide says of it; with the viewer the tutorial
 * Drop does it. */
#include "Mdt/behaviour.h"

/* "Setting the Timestep for the Simulation" */
/* Simulation time step in seconds */
static MeReal step = 0.03;

static MdtWorldID world;
static MdtBodyID body;

typedef struct {
    MeMatrix4Ptr m_matrix;
} Graphic; /* what is drawn; the guide's sphereG points to one */
static Graphic sphere, *sphereG = &sphere;

/* "Defining a Body" */
static void Reset(void) {
    MdtBodySetPosition(body, 0, 10, 0);
    MdtBodySetLinearVelocity(body, 0, 0, 0);
    MdtBodySetAngularVelocity(body, 0, 0, 0);
    MdtBodySetQuaternion(body, 1, 0, 0, 0);
}

/* "Stepping Through Time" */
static void Tick(void) {
    MdtWorldStep(world, step);
    sphereG->m_matrix = MdtBodyGetTransformPtr(body);
}

/* "Cleaning Up" */
static void cleanup(void) {
    MdtWorldDestroy(world);
}

static void Run(int frames) {
    while (frames--)
        Tick();
}

static void makeDrop(void) {
    world = MdtWorldCreate(1, 0);
    MdtWorldSetGravity(world, 0, -(MeReal)(9.8), 0);
    body = MdtBodyCreate(world);
    MdtBodyEnable(body);
    Reset();
}

/* "Initializing the World": maxBodies and maxConstraints are the most that the world holds. */
TEST(initializing_the_world) {
    world = MdtWorldCreate(1, 0);
    ck_assert_int_eq(MdtWorldGetMaxBodies(world), 1);
    ck_assert_int_eq(MdtWorldGetMaxConstraints(world), 0);
    ck_assert(MdtBodyCreate(world) != 0);
    messages_catch();
    ck_assert(MdtBodyCreate(world) == 0);
    assert_warned("maxBodies");
    ck_assert(MdtBSJointCreate(world) == 0);
    assert_warned("maxConstraints");
    messages_release();
    cleanup();
}

/* "Setting the Gravity of the World": in any direction, of any size. */
TEST(setting_the_gravity) {
    makeDrop();
    MeVector3 g;
    MdtWorldGetGravity(world, g);
    assert_vec3_near(g, 0, -9.8, 0, TOL(1e-6, 9e-13));
    MdtWorldSetGravity(world, 1, 2, -3);
    Run(1);
    assert_velocity(body, .03, .06, -.09, TOL(9e-8, 8e-15));
    cleanup();
}

/* "Defining a Body": the table of default values. */
TEST(default_values_of_a_body) {
    world = MdtWorldCreate(1, 0);
    body = MdtBodyCreate(world);
    MeMatrix3 inertia;
    MeVector4 q;
    MeVector3 v;
    assert_near(MdtBodyGetMass(body), 1, 0);
    MdtBodyGetInertiaTensor(body, inertia);
    for (int i = 0; i < 3; i++)
        assert_vec3_near(inertia[i], i == 0 ? .4 : 0, i == 1 ? .4 : 0, i == 2 ? .4 : 0, TOL(1e-7, 9e-14));
    MdtBodyGetQuaternion(body, q);
    ck_assert(q[0] == 1 && q[1] == 0 && q[2] == 0 && q[3] == 0);
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(body);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            ck_assert(tm[i][k] == (i == k));
    MdtBodyGetFastSpinAxis(body, v);
    assert_vec3_near(v, 0, 1, 0, 0);
    void (*const zero[])(const MdtBodyID, MeVector3) = {
        MdtBodyGetPosition,           MdtBodyGetForce,           MdtBodyGetTorque,
        MdtBodyGetLinearVelocity,     MdtBodyGetAngularVelocity, MdtBodyGetLinearAcceleration,
        MdtBodyGetAngularAcceleration};
    for (size_t i = 0; i < sizeof zero / sizeof *zero; i++) {
        zero[i](body, v);
        assert_vec3_near(v, 0, 0, 0, 0);
    }
    assert_near(MdtBodyGetLinearVelocityDamping(body), 0, 0);
    assert_near(MdtBodyGetAngularVelocityDamping(body), 0, 0);
    ck_assert(!MdtBodyIsEnabled(body)); /* "By default, bodies are disabled from simulation." */
    cleanup();
}

/* "Defining a Body": what mutators set, accessors get; the Enter key starts the fall again, the same one. */
TEST(reset_and_accessors) {
    makeDrop();
    MeVector3 first, second;
    Run(40);
    MdtBodyGetPosition(body, first);
    Reset();
    assert_position(body, 0, 10, 0, 0);
    assert_velocity(body, 0, 0, 0, 0);
    assert_spin(body, 0, 0, 0, 0);
    Run(40);
    MdtBodyGetPosition(body, second);
    ck_assert(memcmp(first, second, sizeof first) == 0);
    cleanup();
}

/* "Stepping Through Time": the ball falls as one does, after n steps by g (n h)²/2; the graphic has the body's matrix.
 * "The time increment does [not] need to be fixed." */
TEST(a_ball_falls_freely) {
    makeDrop();
    const double h = step;
    for (int n = 1; n <= 100; n++) {
        Run(1);
        assert_near(sphereG->m_matrix[3][1], 10 - 9.8 * h * h * n * n / 2, TOL(2e-5, 4e-12));
        assert_velocity(body, 0, -9.8 * h * n, 0, TOL(2e-5, 3e-12));
    }
    Reset();
    double t = 0;
    for (int n = 0; n < 100; n++) {
        step = (MeReal)(n % 2 ? .01 : .02);
        t += (double)step;
        Run(1);
    }
    step = (MeReal)0.03;
    assert_velocity(body, 0, -9.8 * t, 0, TOL(2e-5, 2e-12));
    assert_near(sphereG->m_matrix[3][1], 10 - 4.9 * t * t, TOL(3e-6, 2e-13));
    cleanup();
}

/* "Geometric Properties": without an inertia tensor of its own a long body behaves wrongly, with one rightly: a torque
 * about its long axis turns it faster. */
TEST(inertia_tensors_follow_the_geometry) {
    world = MdtWorldCreate(1, 0);
    body = MdtBodyCreate(world);
    MeMatrix3 bar;
    MdtMakeInertiaTensorBox(12, 2, .2, .2, bar);
    assert_near(bar[0][0], .08, TOL(8e-8, 8e-15));
    assert_near(bar[1][1], 4.04, TOL(4e-6, 4e-13));
    MdtBodySetMass(body, 12);
    MdtBodySetInertiaTensor(body, bar);
    MdtBodyEnable(body);
    MdtBodyAddTorque(body, 1, 0, 0);
    Run(1);
    assert_spin(body, .03 / .08, 0, 0, TOL(1e-6, 9e-14));
    MdtBodySetAngularVelocity(body, 0, 0, 0);
    MdtBodyAddTorque(body, 0, 1, 0);
    Run(1);
    assert_near(spin(body, 1), .03 / 4.04, TOL(8e-9, 7e-16));
    cleanup();
}
