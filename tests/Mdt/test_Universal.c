/* The universal joint: it bends both ways and carries rotation round the bend, as Cardan's formula says. */
#include "measure.h"

static const double pi = 3.14159265358979323846;

typedef struct {
    MdtWorldID world;
    MdtBodyID shaft[2];
    MdtUniversalID joint;
    double axis[2][3]; /* of the shafts */
} Drive;

static void holdShaft(MdtWorldID w, MdtBodyID b, const double point[3], const double axis[3]) {
    scene_hinge(w, b, 0, point[0], point[1], point[2], axis[0], axis[1], axis[2]);
}

/* Two shafts that meet at the origin, joined in line along z, the joint's axes x in the first and y in the second. Then
 * the second is bent about x, and bearings hold both. */
static Drive makeDrive(double bend) {
    Drive s = {.axis = {{0, 0, 1}, {0, sin(bend), cos(bend)}}};
    s.world = scene_world(2, 3, 0);
    MdtWorldSetEpsilon(s.world, 1e-6); /* two bearings and a joint have rows to spare, not all alike */
    for (int k = 0; k < 2; k++) {
        s.shaft[k] = scene_body(s.world, 1, 0, 0, k - .5);
        MdtBodySetSphericalInertiaTensor(s.shaft[k], .1);
    }
    s.joint = MdtUniversalCreate(s.world);
    MdtUniversalSetBodies(s.joint, s.shaft[0], s.shaft[1]);
    MdtUniversalSetPosition(s.joint, 0, 0, 0);
    MdtUniversalSetAxis(s.joint, 0, 1, 0, 0);
    MdtUniversalSetAxis(s.joint, 1, 0, 1, 0);
    MdtUniversalEnable(s.joint);
    MdtBodySetPosition(s.shaft[1], 0, .5 * sin(bend), .5 * cos(bend));
    MdtBodySetQuaternion(s.shaft[1], cos(bend / 2), -sin(bend / 2), 0, 0);
    for (int k = 0; k < 2; k++) {
        double point[3];
        keaScale(point, k - .5, s.axis[k]);
        holdShaft(s.world, s.shaft[k], point, s.axis[k]);
    }
    return s;
}

/* How far a shaft has turned about its own axis: the spherical body's x-axis, which began across the bend. */
static double turnOf(Drive s, int k) {
    double x[3] = {1, 0, 0}, now[3], across[3];
    measure_turnOut(s.shaft[k], x, now);
    keaCross(across, s.axis[k], x);
    return atan2(keaDot(now, across), keaDot(now, x));
}

/* tan(out) = tan(in) cos(bend), the first yoke across the bend at the start. */
TEST(rotation_goes_round_a_bend_by_cardan_s_formula) {
    const double bends[] = {0, .3, .7, 1.2};
    for (int k = 0; k < 4; k++) {
        Drive s = makeDrive(bends[k]);
        MdtBodySetAngularVelocity(s.shaft[0], 0, 0, 3);
        for (int i = 0; i < 240; i++) {
            MdtWorldStep(s.world, FRAME);
            const double in = turnOf(s, 0), wanted = atan2(sin(in) * cos(bends[k]), cos(in));
            assert_near(remainder(turnOf(s, 1) - wanted, 2 * pi), 0, TOL(2e-6, 1e-8));
        }
    }
}

/* Torque through the joint: what turns the one shaft brakes the other, by the ratio of their rates. */
TEST(torque_is_carried_round_a_bend) {
    const double bend = .8;
    Drive s = makeDrive(bend);
    for (int i = 0; i < 60; i++) { /* at the start the second turns cos(bend) times as fast as the first */
        double t[3];
        keaScale(t, -2 / cos(bend), s.axis[1]);
        MdtBodyAddTorque(s.shaft[0], 0, 0, 2);
        add_torque(s.shaft[1], t);
        MdtWorldStep(s.world, FRAME);
    }
    assert_near(turnOf(s, 0), 0, TOL(1e-6, 3e-8));
    double w[3];
    measure_rate(s.shaft[0], w);
    assert_vec3_near(w, 0, 0, 0, TOL(2e-6, 3e-13));
}

/* Axes that are not at right angles when they are set are drawn there; each is what was set. */
TEST(axes_are_drawn_to_right_angles) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtUniversalID j = MdtUniversalCreate(w);
    MeVector3 a, o;
    MdtUniversalSetBodies(j, b, 0);
    MdtUniversalSetAxis(j, 0, 1, 0, 0);
    MdtUniversalSetAxis(j, 1, .6, .8, 0);
    MdtUniversalGetAxis(j, 0, a);
    MdtUniversalGetAxis(j, 1, o);
    assert_vec3_near(a, 1, 0, 0, TOL(1e-6, 9e-14));
    assert_vec3_near(o, .6, .8, 0, TOL(1e-6, 9e-14));
    MdtUniversalEnable(j);
    steps(w, 120, FRAME);
    MdtUniversalGetAxis(j, 0, a);
    MdtUniversalGetAxis(j, 1, o);
    assert_vec3_near(o, .6, .8, 0, TOL(1e-6, 9e-14));
    assert_vec3_near(a, .8, -.6, 0, TOL(1e-6, 2e-11));
}

/* Both axes at once, as the User Guide has it: the primary one for the first body, the second one for the other. */
TEST(both_axes_at_once) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtUniversalID j = MdtUniversalCreate(w);
    MeVector3 a, o;
    MdtUniversalSetBodies(j, scene_body(w, 1, 0, 0, 0), scene_body(w, 1, 1, 0, 0));
    MdtUniversalSetAxes(j, 0, 0, 2, 3, 0, 0);
    MdtUniversalGetAxis(j, 0, a);
    assert_vec3_near(a, 0, 0, 1, TOL(1e-6, 9e-14));
    MdtUniversalGetAxis(j, 1, a);
    assert_vec3_near(a, 1, 0, 0, TOL(1e-6, 9e-14));
    MdtUniversalGetAxes(j, 0, a, o);
    assert_vec3_near(o, 1, 0, 0, TOL(1e-6, 9e-14));
}
