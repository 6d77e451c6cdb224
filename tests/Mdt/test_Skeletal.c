/* The skeletal joint: an elliptical cone and a limited twist. A bar of the mass 2 is held at the origin by a joint to
 * the world, its axis x, its second axis y; its centre is 0.5 m along x. */
#include "measure.h"

static const double mass = 2, arm = .5, pi = 3.14159265358979323846;
static const double primary = .3, secondary = .8;

typedef struct {
    MdtWorldID world;
    MdtBodyID bar;
    MdtSkeletalID joint;
} Bar;

static Bar makeBar(void) {
    Bar s;
    s.world = scene_world(1, 1, 0);
    MdtWorldSetEpsilon(s.world, 0);
    s.bar = scene_body(s.world, mass, arm, 0, 0);
    MdtBodySetSphericalInertiaTensor(s.bar, .1);
    s.joint = MdtSkeletalCreate(s.world);
    MdtSkeletalSetBodies(s.joint, s.bar, 0);
    MdtSkeletalSetPosition(s.joint, 0, 0, 0);
    MdtSkeletalSetAxes(s.joint, 1, 0, 0, 0, 1, 0);
    MdtSkeletalSetConePrimaryLimitAngle(s.joint, primary);
    MdtSkeletalSetConeSecondaryLimitAngle(s.joint, secondary);
    MdtSkeletalEnable(s.joint);
    return s;
}

/* Where the bar's axis is: the angle from x times its direction in the (y, z) plane; and the twist, what is left of the
 * turn when the way of the axis along a great circle is taken out. */
static void measureSwing(MdtBodyID b, double swing[2], double *twist) {
    double R[3][3], q[4];
    measure_rotation(b, R);
    const double sine = sqrt(R[1][0] * R[1][0] + R[2][0] * R[2][0]), angle = atan2(sine, R[0][0]);
    swing[0] = sine > 1e-12 ? angle * R[1][0] / sine : 0;
    swing[1] = sine > 1e-12 ? angle * R[2][0] / sine : 0;
    keaQuaternionFromMatrix(q, (const double(*)[3])R);
    *twist = remainder(2 * atan2(q[1], q[0]), 2 * pi);
}

static double coneShare(const double swing[2]) {
    return sqrt(pow(swing[0] / primary, 2) + pow(swing[1] / secondary, 2));
}

static void pull(Bar s, double y, double z) {
    MdtWorldSetGravity(s.world, 0, y, z);
}

static int rowsOf(Bar s) {
    return MdtConstraintGetRowCount(MdtSkeletalQuaConstraint(s.joint));
}

static void assertAttached(Bar s) {
    double p[3], end[3] = {-arm, 0, 0};
    measure_pointOut(s.bar, end, p);
    assert_vec3_near(p, 0, 0, 0, TOL(1e-6, 2e-9));
}

/* ---- swing ---- */

/* The primary angle towards the second axis, the secondary one towards the third. */
LOOP_TEST(each_angle_holds_towards_its_axis, 0, 4) {
    const int axis = _i / 2, side = _i % 2 ? 1 : -1;
    const double limit = axis ? secondary : primary;
    Bar s = makeBar();
    double swing[2], twist, max = 0;
    pull(s, axis ? 0 : 10 * side, axis ? 10 * side : 0);
    for (int i = 0; i < 300; i++) {
        MdtWorldStep(s.world, FRAME);
        measureSwing(s.bar, swing, &twist);
        max = fmax(max, swing[axis] * side);
        assertAttached(s);
    }
    assert_near(max, limit, TOL(8e-7, 3e-9));
    assert_near(swing[axis], side * limit, TOL(8e-7, 1e-10)); /* to a position row's tolerance, of 1 rad */
    assert_near(swing[1 - axis], 0, TOL(1e-6, 9e-14));
    ck_assert_int_eq(rowsOf(s), 4);
}

/* Between them the ellipse: pulled there and damped, the bar rests where its potential energy on it is least. */
TEST(between_them_it_is_an_ellipse) {
    for (int k = 1; k < 8; k++) {
        Bar s = makeBar();
        const double way = k * pi / 4 + .2, y = 10 * cos(way), z = 10 * sin(way);
        double swing[2], twist, best = 0, bestAt = 0;
        pull(s, y, z);
        MdtSkeletalSetTwistOption(s.joint, MdtSkeletalTwistOptionFree);
        MdtBodySetLinearVelocityDamping(s.bar, 3);
        MdtBodySetAngularVelocityDamping(s.bar, 3);
        for (int i = 0; i < 1500; i++) {
            MdtWorldStep(s.world, FRAME);
            measureSwing(s.bar, swing, &twist);
            assert_below(coneShare(swing), 1 + 5e-3);
        }
        assert_near(coneShare(swing), 1, TOL(1e-6, 1e-9));
        for (int i = 0; i < 100000; i++) {
            const double a = i * 2 * pi / 100000, e[2] = {primary * cos(a), secondary * sin(a)};
            const double size = sqrt(e[0] * e[0] + e[1] * e[1]), depth = sin(size) / size * (e[0] * y + e[1] * z);
            if (depth > best)
                best = depth, bestAt = a;
        }
        assert_near(swing[0], primary * cos(bestAt), 8e-5);
        assert_near(swing[1], secondary * sin(bestAt), 2e-4);
    }
}

/* m g l cos θ = k (θ - limit). */
TEST(a_soft_cone_gives_way_by_torque_over_stiffness) {
    const double ks[] = {20, 100, 500};
    for (int k = 0; k < 3; k++) {
        Bar s = makeBar();
        double swing[2], twist;
        pull(s, 10, 0);
        MdtSkeletalSetConeStiffness(s.joint, ks[k]);
        MdtSkeletalSetConeDamping(s.joint, 4);
        steps(s.world, 1500, FRAME);
        measureSwing(s.bar, swing, &twist);
        assert_near(ks[k] * (swing[0] - primary), mass * 10 * arm * cos(swing[0]), TOL(9e-5, 9e-8));
    }
}

/* ---- twist ---- */

static void twistBar(Bar s, double torque) {
    double x[3] = {1, 0, 0}, axis[3];
    measure_turnOut(s.bar, x, axis);
    keaScale(axis, torque, axis);
    add_torque(s.bar, axis);
}

TEST(the_twist_stops_at_its_limit) {
    for (int side = -1; side <= 1; side += 2) {
        Bar s = makeBar();
        double swing[2], twist, max = 0, t[3];
        MdtSkeletalSetTwistLimitAngle(s.joint, .6);
        for (int i = 0; i < 200; i++) {
            twistBar(s, side);
            MdtWorldStep(s.world, FRAME);
            measureSwing(s.bar, swing, &twist);
            max = fmax(max, twist * side);
        }
        assert_near(max, .6, TOL(6e-7, 4e-11));
        assert_near(twist, .6 * side, TOL(1e-6, 2e-10));
        read_torque(MdtSkeletalQuaConstraint(s.joint), 0, t);
        assert_vec3_near(t, -side, 0, 0, TOL(1e-6, 9e-14));
        ck_assert_int_eq(rowsOf(s), 4);
    }
}

/* The twist is what is left besides the swing, wherever the bar is swung to. */
TEST(the_twist_limit_holds_while_swung) {
    Bar s = makeBar();
    double swing[2], twist;
    pull(s, 5, 10);
    MdtSkeletalSetTwistLimitAngle(s.joint, .25);
    MdtBodySetLinearVelocityDamping(s.bar, 2);
    MdtBodySetAngularVelocityDamping(s.bar, 2);
    for (int i = 0; i < 1500; i++) {
        twistBar(s, i < 750 ? 2 : -2);
        MdtWorldStep(s.world, FRAME);
        measureSwing(s.bar, swing, &twist);
        assert_below(fabs(twist), .25 + 5e-3);
        if (i == 749)
            assert_near(twist, .25, TOL(3e-7, 3e-10));
    }
    assert_near(twist, -.25, TOL(3e-7, 3e-14));
    assert_near(coneShare(swing), 1, TOL(1e-6, 2e-10));
}

TEST(a_soft_twist_gives_way_by_torque_over_stiffness) {
    Bar s = makeBar();
    double swing[2], twist;
    MdtSkeletalSetTwistLimitAngle(s.joint, .2);
    MdtSkeletalSetTwistStiffness(s.joint, 25);
    MdtSkeletalSetTwistDamping(s.joint, 2);
    for (int i = 0; i < 1000; i++) {
        twistBar(s, 5);
        MdtWorldStep(s.world, FRAME);
    }
    measureSwing(s.bar, swing, &twist);
    assert_near(twist, .2 + 5. / 25, TOL(4e-7, 6e-10));
}

TEST(the_present_twist_becomes_its_zero) {
    Bar s = makeBar();
    double swing[2], twist;
    MdtSkeletalDisable(s.joint);
    MdtBodySetQuaternion(s.bar, cos(.5), sin(.5), 0, 0); /* 1 rad, beyond the limit */
    MdtSkeletalSetTwistLimitAngle(s.joint, .2);
    MdtSkeletalZeroTwist(s.joint);
    MdtSkeletalEnable(s.joint);
    steps(s.world, 10, FRAME);
    measureSwing(s.bar, swing, &twist);
    assert_near(twist, 1, TOL(1e-6, 9e-14));
    for (int i = 0; i < 200; i++) {
        twistBar(s, 2);
        MdtWorldStep(s.world, FRAME);
    }
    measureSwing(s.bar, swing, &twist);
    assert_near(twist, 1.2, TOL(1e-6, 2e-12));
    for (int i = 0; i < 200; i++) {
        twistBar(s, -2);
        MdtWorldStep(s.world, FRAME);
    }
    measureSwing(s.bar, swing, &twist);
    assert_near(twist, .8, TOL(1e-6, 4e-10));
}

/* ---- options ---- */

TEST(free_options_leave_a_ball_and_socket) {
    Bar s = makeBar();
    double swing[2], twist, max = 0, maxTwist = 0;
    MdtSkeletalSetConeOption(s.joint, MdtSkeletalConeOptionFree);
    MdtSkeletalSetTwistOption(s.joint, MdtSkeletalTwistOptionFree);
    pull(s, 10, 0);
    MdtBodySetAngularVelocity(s.bar, 2, 0, 0);
    for (int i = 0; i < 120; i++) {
        MdtWorldStep(s.world, FRAME);
        measureSwing(s.bar, swing, &twist);
        max = fmax(max, fabs(swing[0]));
        maxTwist = fmax(maxTwist, fabs(twist));
        ck_assert_int_eq(rowsOf(s), 3);
    }
    assert_below(1.5, max);
    assert_below(1.5, maxTwist);
}

TEST(angles_of_pi_are_no_limits) {
    Bar s = makeBar();
    MdtSkeletalSetConePrimaryLimitAngle(s.joint, 4); /* clamped */
    MdtSkeletalSetConeSecondaryLimitAngle(s.joint, 4);
    MdtSkeletalSetTwistLimitAngle(s.joint, 4);
    pull(s, 10, 3);
    for (int i = 0; i < 120; i++) {
        MdtWorldStep(s.world, FRAME);
        ck_assert_int_eq(rowsOf(s), 3);
    }
}

TEST(in_a_slot_it_swings_in_the_primary_plane) {
    Bar s = makeBar();
    double swing[2], twist, max = 0;
    MdtSkeletalSetConeOption(s.joint, MdtSkeletalConeOptionSlot);
    pull(s, 5, 20);
    for (int i = 0; i < 300; i++) {
        MdtWorldStep(s.world, FRAME);
        measureSwing(s.bar, swing, &twist);
        assert_near(swing[1], 0, TOL(1e-6, 4e-9));
        max = fmax(max, swing[0]);
    }
    assert_near(max, primary, TOL(3e-7, 6e-11));
    assert_near(swing[0], primary, TOL(3e-7, 5e-10));
    ck_assert_int_eq(rowsOf(s), 5); /* 3, the slot, its end */
}

TEST(what_is_fixed_is_held) {
    Bar s = makeBar();
    double swing[2], twist;
    MdtSkeletalSetConeOption(s.joint, MdtSkeletalConeOptionFixed);
    pull(s, 10, 10);
    for (int i = 0; i < 100; i++) { /* the swing is, the twist is limited */
        twistBar(s, 1);
        MdtWorldStep(s.world, FRAME);
        measureSwing(s.bar, swing, &twist);
        assert_near(swing[0], 0, TOL(1e-6, 8e-10));
        assert_near(swing[1], 0, TOL(1e-6, 2e-9));
    }
    assert_near(twist, pi / 4, TOL(1e-6, 3e-11));
    s = makeBar();
    MdtSkeletalSetConeOption(s.joint, MdtSkeletalConeOptionFixed);
    MdtSkeletalSetTwistOption(s.joint, MdtSkeletalTwistOptionFixed);
    pull(s, 10, 10);
    for (int i = 0; i < 100; i++) {
        twistBar(s, 1);
        MdtWorldStep(s.world, FRAME);
    }
    measureSwing(s.bar, swing, &twist);
    assert_vec3_near(((const double[3]){swing[0], swing[1], twist}), 0, 0, 0, TOL(1e-6, 9e-10));
    ck_assert_int_eq(rowsOf(s), 6);
    s = makeBar();
    MdtSkeletalSetTwistOption(s.joint, MdtSkeletalTwistOptionFixed);
    pull(s, 10, 10);
    for (int i = 0; i < 300; i++) {
        twistBar(s, 1);
        MdtWorldStep(s.world, FRAME);
        measureSwing(s.bar, swing, &twist);
        assert_near(twist, 0, TOL(1e-6, 5e-10));
    }
    assert_near(coneShare(swing), 1, TOL(1e-6, 4e-10));
}
