/* Where a joint loses its meaning: everything stays finite, one warning is given when it comes there and not one a
 * step, and another when it comes there again. */
#include "measure.h"

typedef struct {
    MdtWorldID world;
    MdtBodyID body[2];
} Two;

static const double half = 1.5707963267948966; /* of pi */

/* Two boxes, the second beside the first along x. */
static Two makeTwo(double distance) {
    const double edge[3] = {.4, .6, .5};
    Two s;
    s.world = scene_world(2, 4, 0);
    for (int k = 0; k < 2; k++)
        s.body[k] = scene_box(s.world, 1 + k, edge, k * distance, 0, 0);
    return s;
}

/* Turned by an angle about a unit axis. */
static void turn(MdtBodyID b, double angle, double x, double y, double z) {
    const double s = sin(angle / 2);
    MdtBodySetQuaternion(b, cos(angle / 2), s * x, s * y, s * z);
}

static void stand(MdtBodyID b) {
    MdtBodySetLinearVelocity(b, 0, 0, 0);
    MdtBodySetAngularVelocity(b, 0, 0, 0);
}

static void assertFinite(Two s) {
    for (int k = 0; k < 2; k++) {
        double p[3], v[3], w[3];
        measure_position(s.body[k], p);
        measure_velocity(s.body[k], v);
        measure_rate(s.body[k], w);
        ck_assert_msg(keaLength(p) < 1e3 && keaLength(v) < 1e3 && keaLength(w) < 1e3, "body %d: %g m, %g m/s, %g rad/s",
                      k, keaLength(p), keaLength(v), keaLength(w));
    }
}

/* The bodies are put back to the place again and again, so that the joint stays there. */
static void stay(Two s, int n, void (*place)(Two)) {
    for (int i = 0; i < n; i++) {
        place(s);
        MdtWorldStep(s.world, FRAME);
        assertFinite(s);
    }
}

/* One warning for a stay, none elsewhere, one more for the next stay; left alone in the end it stays finite. */
static void check(Two s, void (*there)(Two), void (*elsewhere)(Two), const char *word) {
    stay(s, 10, elsewhere);
    assert_silent();
    for (int again = 0; again < 2; again++) {
        stay(s, 20, there);
        ck_assert_msg(caught.warnings == 1, "%d warnings of '%s'", caught.warnings, word);
        assert_warned(word);
        stay(s, 20, elsewhere);
        assert_silent();
    }
    there(s);
    for (int i = 0; i < 120; i++) {
        const double f[3] = {3, -2, 1}, t[3] = {.3, .2, -.1};
        add_force(s.body[0], f);
        add_torque(s.body[1], t);
        MdtWorldStep(s.world, FRAME);
        assertFinite(s);
    }
    messages_forget();
}

static void apart(Two s, double distance) {
    for (int k = 0; k < 2; k++) {
        MdtBodySetPosition(s.body[k], k * distance, 0, 0);
        turn(s.body[k], 0, 1, 0, 0);
        stand(s.body[k]);
    }
}

static void asMade(Two s) {
    apart(s, 1);
}

static void coinciding(Two s) {
    apart(s, 0);
}

/* Body 1 turned by a right angle, or half a turn, about z; the point between them at x = 0.5 stays. */
static void turned(Two s, double angle) {
    asMade(s);
    turn(s.body[1], angle, 0, 0, 1);
    MdtBodySetPosition(s.body[1], .5 + .5 * cos(angle), .5 * sin(angle), 0);
}

static void bent(Two s) {
    turned(s, half);
}

static void slightlyBent(Two s) {
    turned(s, .5 * half);
}

static void opposite(Two s) {
    turned(s, 2 * half);
}

TEST(a_universal_joint_bent_by_a_right_angle) {
    Two s = makeTwo(1);
    MdtUniversalID j = MdtUniversalCreate(s.world);
    MdtUniversalSetBodies(j, s.body[0], s.body[1]);
    MdtUniversalSetPosition(j, .5, 0, 0);
    MdtUniversalSetAxis(j, 0, 0, 0, 1);
    MdtUniversalSetAxis(j, 1, 0, 1, 0);
    MdtUniversalEnable(j);
    check(s, bent, slightlyBent, "90 degrees");
}

/* In the middle of the cone, where it has no row, it is forgotten too. */
TEST(a_cone_limit_with_its_axes_opposite) {
    void (*const elsewhere[])(Two) = {slightlyBent, asMade};
    for (int k = 0; k < 2; k++) {
        Two s = makeTwo(1);
        MdtConeLimitID j = MdtConeLimitCreate(s.world);
        MdtConeLimitSetBodies(j, s.body[0], s.body[1]);
        MdtConeLimitSetConeHalfAngle(j, 1);
        MdtConeLimitEnable(j);
        check(s, opposite, elsewhere[k], "parallel");
    }
}

TEST(a_cone_limit_without_a_cone) {
    Two s = makeTwo(1);
    MdtConeLimitID j = MdtConeLimitCreate(s.world);
    MdtConeLimitSetBodies(j, s.body[0], s.body[1]);
    MdtConeLimitSetConeHalfAngle(j, 0);
    MdtConeLimitEnable(j);
    check(s, asMade, slightlyBent, "parallel");
}

/* It pushes about y then, whatever plane it had before it was reset. */
TEST(a_cone_limit_that_had_no_plane_yet) {
    Two s = makeTwo(1);
    MdtConeLimitID j = MdtConeLimitCreate(s.world);
    MdtWorldSetEpsilon(s.world, 0);
    for (int isReset = 0; isReset < 2; isReset++) {
        double w[2][3];
        MdtConeLimitReset(j);
        MdtConeLimitSetBodies(j, s.body[0], s.body[1]);
        MdtConeLimitSetConeHalfAngle(j, 0);
        MdtConeLimitEnable(j);
        asMade(s);
        MdtBodySetAngularVelocity(s.body[1], 0, 1, 0);
        MdtWorldStep(s.world, FRAME);
        for (int k = 0; k < 2; k++)
            measure_rate(s.body[k], w[k]);
        assert_near(w[1][1] - w[0][1], 0, TOL(1e-6, 1e-9));
        slightlyBent(s);
        MdtWorldStep(s.world, FRAME);
    }
    messages_forget();
}

static void spring(double stiffness, const char *word) {
    Two s = makeTwo(1);
    MdtSpringID j = MdtSpringCreate(s.world);
    MdtSpringSetBodies(j, s.body[0], s.body[1]);
    MdtSpringSetStiffness(j, stiffness);
    MdtSpringEnable(j);
    check(s, coinciding, asMade, word);
}

TEST(a_spring_without_length) {
    spring(30, "coincide");
}

TEST(a_rod_without_length) {
    spring(MEINFINITY, "coincide");
}

TEST(an_rpro_joint_half_a_turn_off) {
    Two s = makeTwo(1);
    MdtRPROJointID j = MdtRPROJointCreate(s.world);
    MdtRPROJointSetBodies(j, s.body[0], s.body[1]);
    MdtRPROJointSetAttachmentPosition(j, .5, 0, 0, 0);
    MdtRPROJointSetAttachmentPosition(j, -.5, 0, 0, 1);
    MdtRPROJointEnable(j);
    check(s, opposite, slightlyBent, "half a turn");
}

TEST(a_skeletal_joint_swung_to_the_opposite) {
    Two s = makeTwo(1);
    MdtSkeletalID j = MdtSkeletalCreate(s.world);
    MdtSkeletalSetBodies(j, s.body[0], s.body[1]);
    MdtSkeletalSetPosition(j, .5, 0, 0);
    MdtSkeletalEnable(j);
    check(s, opposite, slightlyBent, "swing");
}

TEST(six_springs_half_a_turn_off) {
    Two s = makeTwo(1);
    MdtSpring6ID j = MdtSpring6Create(s.world);
    MdtSpring6SetBodies(j, s.body[0], s.body[1]);
    MdtSpring6SetPosition(j, .5, 0, 0);
    for (int i = 0; i < 3; i++)
        MdtSpring6SetAngularStiffness(j, i, MEINFINITY);
    MdtSpring6Enable(j);
    check(s, opposite, slightlyBent, "half a turn");
}

/* Joints that hold an orientation: the bodies were put where none of them leads. */
TEST(held_orientations_half_a_turn_off) {
    for (int kind = 0; kind < 3; kind++) {
        Two s = makeTwo(1);
        MdtConstraintID c = kind == 0   ? MdtAngular3QuaConstraint(MdtAngular3Create(s.world))
                            : kind == 1 ? MdtFPFOJointQuaConstraint(MdtFPFOJointCreate(s.world))
                                        : MdtPrismaticQuaConstraint(MdtPrismaticCreate(s.world));
        MdtConstraintSetBodies(c, s.body[0], s.body[1]);
        MdtConstraintEnable(c);
        check(s, opposite, slightlyBent, "half a turn");
    }
}

/* Without angular springs nothing is lost by turning. */
TEST(linear_springs_may_turn) {
    Two s = makeTwo(1);
    MdtSpring6ID j = MdtSpring6Create(s.world);
    MdtSpring6SetBodies(j, s.body[0], s.body[1]);
    MdtSpring6SetPosition(j, .5, 0, 0);
    MdtSpring6SetLinearStiffness(j, 0, 10);
    MdtSpring6Enable(j);
    stay(s, 20, opposite);
}

TEST(a_car_wheel_whose_axes_are_parallel) {
    Two s = makeTwo(1);
    MdtCarWheelID j = MdtCarWheelCreate(s.world);
    MdtCarWheelSetBodies(j, s.body[0], s.body[1]);
    MdtCarWheelSetPosition(j, .5, 0, 0);
    MdtCarWheelSetSteeringAxis(j, 0, 1, 0);
    MdtCarWheelSetHingeAxis(j, 1, 0, 0);
    MdtCarWheelEnable(j);
    check(s, bent, slightlyBent, "parallel");
}

/* Axes without length, or parallel ones, are refused; the joint works on with those that it has. */
TEST(axes_that_span_no_plane_are_refused) {
    Two s = makeTwo(1);
    MdtConstraintID all[] = {
        MdtHingeQuaConstraint(MdtHingeCreate(s.world)), MdtSkeletalQuaConstraint(MdtSkeletalCreate(s.world)),
        MdtUniversalQuaConstraint(MdtUniversalCreate(s.world)), MdtSpring6QuaConstraint(MdtSpring6Create(s.world))};
    for (int i = 0; i < 4; i++) {
        MeVector3 p, o;
        MdtConstraintSetBodies(all[i], s.body[0], s.body[1]);
        assert_silent();
        assert_refused(MdtConstraintSetAxes, all[i], 1, 2, 3, 2, 4, 6);
        MdtConstraintSetAxes(all[i], 1, 2, 3, -1, -2, -3);
        assert_warned("parallel");
        assert_refused(MdtConstraintSetAxes, all[i], 0, 0, 0, 1, 0, 0);
        assert_refused(MdtConstraintBodySetAxes, all[i], 1, 0, 0, 1, 0, 0, 1);
        assert_refused(MdtConstraintSetAxis, all[i], 0, 0, 0);
        for (unsigned int k = 0; k < 2; k++) {
            MdtConstraintBodyGetAxes(all[i], k, p, o);
            assert_vec3_near(p, 1, 0, 0, 0);
            assert_vec3_near(o, 0, 1, 0, 0);
        }
    }
    assert_refused(MdtUniversalSetAxis, MdtConstraintDCastUniversal(all[2]), 1, 0, 0, 0);
}
