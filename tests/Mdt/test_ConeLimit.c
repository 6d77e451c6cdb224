/* The cone limit: an axis that stays inside a cone. A bar of the mass 2 hangs on a ball and socket at the origin, 0.5 m
 * from its centre; the cone is about -y. */
#include "measure.h"

static const double mass = 2, arm = .5, halfAngle = .5, pi = 3.14159265358979323846;

typedef struct {
    MdtWorldID world;
    MdtBodyID bar;
    MdtBSJointID ball;
    MdtConeLimitID cone;
} Hung;

static Hung hang(double inertia) {
    Hung s;
    s.world = scene_world(1, 2, 0);
    MdtWorldSetEpsilon(s.world, 0);
    s.bar = scene_body(s.world, mass, 0, -arm, 0);
    MdtBodySetSphericalInertiaTensor(s.bar, inertia);
    s.ball = scene_ball(s.world, s.bar, 0, 0, 0, 0);
    s.cone = MdtConeLimitCreate(s.world);
    MdtConeLimitSetBodies(s.cone, s.bar, 0);
    MdtConeLimitSetAxis(s.cone, 0, -1, 0);
    MdtConeLimitSetConeHalfAngle(s.cone, halfAngle);
    MdtConeLimitEnable(s.cone);
    return s;
}

static double angleOf(Hung s) {
    double axis[3], down[3] = {0, -1, 0};
    measure_turnOut(s.bar, down, axis);
    return atan2(sqrt(axis[0] * axis[0] + axis[2] * axis[2]), -axis[1]);
}

static int rowsOf(Hung s) {
    return MdtConstraintGetRowCount(MdtConeLimitQuaConstraint(s.cone));
}

static void pull(Hung s, double x, double z) {
    MdtWorldSetGravity(s.world, x, 0, z);
}

/* Turning about z and the velocity of the centre that goes with it. */
static void swingAboutZ(Hung s, double rate) {
    MdtBodySetAngularVelocity(s.bar, 0, 0, rate);
    MdtBodySetLinearVelocity(s.bar, rate * arm, 0, 0);
}

TEST(inside_the_cone_it_has_no_row) {
    Hung s = hang(.1);
    double t[3];
    swingAboutZ(s, .5);
    for (int i = 0; i < 40; i++) {
        MdtWorldStep(s.world, FRAME);
        ck_assert_int_eq(rowsOf(s), 0);
        read_torque(MdtConeLimitQuaConstraint(s.cone), 0, t);
        assert_vec3_near(t, 0, 0, 0, 0);
    }
    assert_near(angleOf(s), 40 * .5 * (double)FRAME, TOL(1e-5, 1e-5));
}

/* A bar pulled to the side, from all directions, comes to rest on it: m g l cos θ on the limit. */
TEST(it_rests_on_its_side) {
    for (int k = 0; k < 8; k++) {
        Hung s = hang(.1);
        const double way = k * pi / 4;
        double t[3], max = 0;
        pull(s, 10 * cos(way), 10 * sin(way));
        for (int i = 0; i < 300; i++) {
            MdtWorldStep(s.world, FRAME);
            max = fmax(max, angleOf(s));
        }
        assert_near(max, halfAngle, TOL(5e-7, 3e-9));
        assert_near(angleOf(s), halfAngle, TOL(5e-7, 6e-10));
        ck_assert_int_eq(rowsOf(s), 1);
        read_torque(MdtConeLimitQuaConstraint(s.cone), 0, t);
        const double torque = mass * 10 * arm * cos(halfAngle); /* gravity's axis: (x, 0, z) cross y */
        assert_vec3_near(t, torque * sin(way), 0, -torque * cos(way), TOL(9e-6, 2e-6));
    }
}

TEST(a_hit_takes_the_speed_and_gives_none_back) {
    Hung s = hang(.1);
    double max = 0, w[3];
    swingAboutZ(s, 3);
    for (int i = 0; i < 60; i++) {
        MdtWorldStep(s.world, FRAME);
        max = fmax(max, angleOf(s));
    }
    assert_near(max, halfAngle, TOL(5e-7, 3e-11));
    assert_near(angleOf(s), halfAngle, TOL(5e-7, 4e-9));
    measure_rate(s.bar, w);
    assert_vec3_near(w, 0, 0, 0, TOL(1e-6, 6e-9));
}

/* Round along the side, pressed to it. */
TEST(a_bar_that_circles_stays_in_the_cone) {
    Hung s = hang(.01);
    double max = 0, min = 9;
    pull(s, 0, 0);
    MdtBodySetPosition(s.bar, arm * sin(.45), -arm * cos(.45), 0);
    MdtBodySetQuaternion(s.bar, cos(.225), 0, 0, sin(.225));
    MdtBodySetLinearVelocity(s.bar, 0, 0, 2);
    for (int i = 0; i < 600; i++) {
        MdtWorldStep(s.world, FRAME);
        max = fmax(max, angleOf(s));
        if (i > 100)
            min = fmin(min, angleOf(s));
    }
    assert_below(max, halfAngle + 5e-3);
    assert_below(halfAngle - 5e-3, min);
}

/* A body without a joint is turned onto the soft side by a torque and swings about the balance. */
TEST(a_soft_cone_is_a_damped_spring) {
    const double ks[] = {20, 80}, ds[] = {.02, .1}, inertia = .4, torque = .6, h = FRAME;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            MdtWorldID w = scene_world(1, 1, 0);
            MdtBodyID b = scene_body(w, 1, 0, 0, 0);
            MdtConeLimitID cone = MdtConeLimitCreate(w);
            Swing swing = {0};
            MdtBodySetSphericalInertiaTensor(b, inertia);
            MdtConeLimitSetBodies(cone, 0, b);
            MdtConeLimitSetConeHalfAngle(cone, halfAngle);
            MdtConeLimitSetStiffness(cone, ks[i]);
            MdtConeLimitSetDamping(cone, ds[j]);
            MdtConeLimitEnable(cone);
            const double start = halfAngle + .5 * torque / ks[i]; /* it stays beyond the stop */
            MdtBodySetQuaternion(b, cos(start / 2), 0, 0, sin(start / 2));
            const double w0 = sqrt(ks[i] / inertia), decay = ds[j] / (2 * inertia);
            for (int n = 0; n < 3000 && swing.crossings < 9; n++) {
                double x[3] = {1, 0, 0}, axis[3];
                MdtBodyAddTorque(b, 0, 0, torque);
                MdtWorldStep(w, FRAME);
                measure_turnOut(b, x, axis);
                swing_add(&swing, atan2(axis[1], axis[0]) - halfAngle - torque / ks[i]);
            }
            ck_assert_int_eq(swing.crossings, 9);
            swing_check(&swing, w0, decay, h, TOL(2e-5, 2e-7));
        }
}

/* Spinning about the bar's own axis, at rest on the side or not. */
TEST(the_twist_is_free) {
    Hung s = hang(.1);
    double w[3], axis[3], down[3] = {0, -1, 0};
    pull(s, 10, 0);
    steps(s.world, 120, FRAME);
    measure_turnOut(s.bar, down, axis);
    MdtBodySetAngularVelocity(s.bar, 4 * axis[0], 4 * axis[1], 4 * axis[2]);
    for (int i = 0; i < 120; i++) {
        MdtWorldStep(s.world, FRAME);
        measure_rate(s.bar, w);
        measure_turnOut(s.bar, down, axis);
        assert_near(keaDot(w, axis), 4, TOL(4e-6, 4e-13));
        assert_near(angleOf(s), halfAngle, TOL(5e-7, 4e-9));
    }
}

/* It rested on its side, and is put along the axis: all is as if the cone was disabled, which writes and reads none of
 * the rows of the joint after it. */
TEST(what_has_left_the_side_leaves_no_row_behind) {
    double angle[2];
    for (int isDisabled = 0; isDisabled < 2; isDisabled++) {
        Hung s = hang(.1);
        MdtConstraintSetSortKey(MdtBSJointQuaConstraint(s.ball), 1);
        pull(s, 10, 0);
        steps(s.world, 120, FRAME);
        ck_assert_int_eq(rowsOf(s), 1);
        pull(s, 0, 0);
        MdtBodySetPosition(s.bar, 0, -arm, 0);
        MdtBodySetQuaternion(s.bar, 1, 0, 0, 0);
        swingAboutZ(s, .1);
        if (isDisabled)
            MdtConeLimitDisable(s.cone);
        MdtWorldStep(s.world, FRAME);
        ck_assert(isDisabled || rowsOf(s) == 0);
        angle[isDisabled] = angleOf(s);
    }
    ck_assert(angle[0] == angle[1]);
}

TEST(pi_is_no_limit) {
    Hung s = hang(.1);
    double w[3];
    MdtConeLimitSetConeHalfAngle(s.cone, pi);
    swingAboutZ(s, 4);
    for (int i = 0; i < 200; i++) {
        MdtWorldStep(s.world, FRAME);
        ck_assert_int_eq(rowsOf(s), 0);
    }
    measure_rate(s.bar, w);
    assert_near(w[2], 4, TOL(4e-6, 4e-13));
}

/* Down to the 5 degrees that the guide allows, and beyond a right angle. */
TEST(half_angles_from_5_to_170_degrees) {
    const double angles[] = {5, 30, 90, 120, 170};
    for (int k = 0; k < 5; k++) {
        MdtWorldID w = scene_world(1, 1, 0);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MdtConeLimitID cone = MdtConeLimitCreate(w);
        const double limit = angles[k] * pi / 180;
        double x[3] = {1, 0, 0}, axis[3], max = 0;
        MdtWorldSetEpsilon(w, 0);
        MdtConeLimitSetBodies(cone, b, 0);
        MdtConeLimitSetConeHalfAngle(cone, limit);
        MdtConeLimitEnable(cone);
        for (int n = 0; n < 300; n++) {
            MdtBodyAddTorque(b, 0, 0, .5);
            MdtWorldStep(w, FRAME);
            measure_turnOut(b, x, axis);
            max = fmax(max, fabs(atan2(axis[1], axis[0])));
        }
        assert_near(max, limit, TOL(2e-6, 4e-11));
        assert_near(atan2(axis[1], axis[0]), limit, TOL(2e-6, 2e-11));
    }
}

/* A start outside: γ of the excess is taken away each step. */
TEST(from_outside_it_is_drawn_in) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtConeLimitID cone = MdtConeLimitCreate(w);
    double x[3] = {1, 0, 0}, axis[3];
    MdtWorldSetEpsilon(w, 0);
    MdtWorldSetGamma(w, .25);
    MdtConeLimitSetBodies(cone, b, 0);
    MdtConeLimitSetConeHalfAngle(cone, .5);
    MdtConeLimitEnable(cone);
    MdtBodySetQuaternion(b, cos(.5), 0, 0, sin(.5));
    /* a new velocity every time: else it swings on inwards */
    for (int n = 1; n <= 20; n++) {
        MdtBodySetAngularVelocity(b, 0, 0, 0);
        MdtWorldStep(w, FRAME);
        measure_turnOut(b, x, axis);
        assert_near(atan2(axis[1], axis[0]), .5 + .5 * pow(.75, n), TOL(1e-6, 5e-10));
    }
}

/* ---- whips ---- */

enum { LINKS = 8 };

/* A whip of links of 1 kg with cones of `degrees`, held at the origin, that begins level, with 10 t at its end. It
 * turns with `spin` rad/s upward and `aside` rad/s sidewise. Returns its largest gap in a second, m. */
static double swingWhip(double degrees, double spin, double aside, int *factorizations, int *max) {
    static const double length = .4;
    MdtWorldID w = scene_world(LINKS, 2 * LINKS, 9.81);
    MdtBodyID link[LINKS];
    double gap = 0;
    MdtWorldSetEpsilon(w, 0);
    MdtWorldEnableReport(w);
    for (int i = 0; i < LINKS; i++) {
        const double mass1 = i == LINKS - 1 ? 1e4 : 1, x = (i + .5) * length;
        MeMatrix3 inertia;
        link[i] = scene_body(w, mass1, x, 0, 0);
        MdtMakeInertiaTensorBox(mass1, length, .1 * length, .1 * length, inertia);
        if (i == LINKS - 1)
            MdtMakeInertiaTensorSphere(mass1, length, inertia);
        MdtBodySetInertiaTensor(link[i], inertia);
        MdtBodySetAngularVelocity(link[i], 0, aside, spin);
        MdtBodySetLinearVelocity(link[i], 0, spin * x, -aside * x);
        scene_ball(w, link[i], i > 0 ? link[i - 1] : 0, i * length, 0, 0);
        if (i == 0)
            continue;
        MdtConeLimitID cone = MdtConeLimitCreate(w);
        MdtConeLimitSetBodies(cone, link[i], link[i - 1]);
        MdtConeLimitSetConeHalfAngle(cone, degrees * pi / 180);
        MdtConeLimitEnable(cone);
    }
    *factorizations = *max = 0;
    for (int step = 0; step < 60; step++) {
        MdtReport report;
        MdtWorldStep(w, FRAME);
        MdtWorldGetReport(w, &report);
        ck_assert_int_eq(report.fallbacks, 0);
        *factorizations += report.factorizations;
        *max = report.factorizations > *max ? report.factorizations : *max;
        gap = fmax(gap, report.jointGap);
    }
    return gap;
}

/* Light links whose axes are pressed against narrow cones converge, although the cones' rims turn directions of their
 * torques far within a step. */
TEST(a_whip_of_narrow_cones_holds) {
    static const double cases[][3] = {{3, 0, .3}, {3, 0, 1}, {1, -1.5, .5}, {3, 2, 1}, {1, 1, -.7}};
    for (int k = 0; k < 5; k++) {
        int factorizations, max;
        const double gap = swingWhip(cases[k][0], cases[k][1], cases[k][2], &factorizations, &max);
        assert_below(gap, 1e-6);
        assert_below(factorizations, 60 * 60); /* 26 to 53 a step; without tangent passes 64 to 93 */
        assert_below(max, 400);
    }
}
