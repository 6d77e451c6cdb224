/* Documented behaviours: single joints (Dynamics guide ch. 3).
 *
 * Already proved elsewhere:
 *   ball and socket: the attachments coincide                  test_BSJoint: the_points_stay_together
 *   hinge: rotation about one axis only                        test_Hinge: only_the_angle_is_free
 *   hinge: the angle counts full turns                         test_Hinge: the_angle_counts_full_turns
 *   hinge: limits may lie beyond ±pi, and none is missed       test_Hinge: stops_lie_beyond_full_turns
 */
#include "behaviour.h"

/* A body of some mass and extent that is pushed and turned every which way. */
static const double edges[3] = {1, .6, .4};

static MdtBodyID boxAt(MdtWorldID w, double mass, double x, double y, double z) {
    return scene_box(w, mass, edges, x, y, z);
}

static void shake(MdtBodyID b, int i) {
    MdtBodyAddForce(b, (MeReal)(8 * sin(.11 * i)), (MeReal)(6 * cos(.07 * i)), (MeReal)(5 * sin(.05 * i + 1)));
    MdtBodyAddTorque(b, (MeReal)cos(.09 * i), (MeReal)(.8 * sin(.06 * i)), (MeReal)(.7 * cos(.04 * i + 2)));
}

static double dot(const MeVector3 a, const MeVector3 b) {
    return (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
}

/* The angle of the turn that takes the orientation of a to that of b. */
static double turnBetween(MdtBodyID a, MdtBodyID b) {
    MeVector4 p, q = {1, 0, 0, 0};
    double w = 0, x[3] = {0};
    MdtBodyGetQuaternion(a, p);
    if (b)
        MdtBodyGetQuaternion(b, q);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        w += (double)p[i + 1] * q[i + 1];
        x[i] = (double)p[0] * q[i + 1] - (double)q[0] * p[i + 1] - (double)p[j + 1] * q[k + 1] +
               (double)p[k + 1] * q[j + 1];
    }
    w += (double)p[0] * q[0];
    return 2 * atan2(sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), fabs(w));
}

/* How far a body that is held at its centre of mass turns away from a free one in two seconds of a torque. */
static double turnOfHeld(int subSteps) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtWorldSetSubSteps(w, subSteps);
    MdtBodyID held = boxAt(w, 1, 0, 0, 0), loose = boxAt(w, 1, 5, 0, 0);
    MdtBSJointID j = MdtBSJointCreate(w);
    MdtBSJointSetBodies(j, held, 0);
    MdtBSJointEnable(j);
    for (int i = 0; i < 120; i++) {
        MdtBodyAddTorque(held, (MeReal).1, (MeReal).2, (MeReal)-.1);
        MdtBodyAddTorque(loose, (MeReal).1, (MeReal).2, (MeReal)-.1);
        MdtWorldStep(w, FRAME);
    }
    assert_position(held, 0, 0, 0, TOL(1e-6, 9e-14));
    const double turn = turnBetween(held, loose);
    MdtWorldDestroy(w);
    return turn;
}

/* "BSJoint": all rotations are free: a body held at its centre of mass turns as a free one does, but for the Cayley
 * map of bodies in joints, a relative error of (ω h)²/12 in the angle, which falls with the square of the step. */
START_TEST(a_ball_and_socket_leaves_all_rotations_free) {
    const double coarse = turnOfHeld(1), fine = turnOfHeld(4);
    assert_below(coarse, .01);
    assert_near(coarse / fine, 16, TOL(.02, .04));
}
END_TEST

/* "Hinge Actuators": powered, or at a limit, a hinge costs six rows; so does a slider. */
START_TEST(at_a_limit_or_powered_hinge_and_slider_cost_six_rows) {
    for (int slider = 0; slider < 2; slider++)
        for (int way = 0; way < 3; way++) {
            MdtWorldID w = scene_world(1, 1, 0);
            MdtWorldSetEpsilon(w, 0);
            MdtBodyID b = boxAt(w, 1, 0, 0, 0);
            MdtHingeID h = slider ? 0 : MdtHingeCreate(w);
            MdtPrismaticID p = slider ? MdtPrismaticCreate(w) : 0;
            MdtConstraintID c = slider ? MdtPrismaticQuaConstraint(p) : MdtHingeQuaConstraint(h);
            MdtConstraintSetBodies(c, b, 0);
            MdtLimitID limit = slider ? MdtPrismaticGetLimit(p) : MdtHingeGetLimit(h);
            if (way == 1)
                MdtLimitSetLimitedForceMotor(limit, 1, 1);
            if (way == 2) { /* pressed against its upper stop, which is where it stands */
                MdtSingleLimitSetStop(MdtLimitGetLowerLimit(limit), -1);
                MdtSingleLimitSetRestitution(MdtLimitGetUpperLimit(limit), 0);
                MdtLimitActivateLimits(limit, 1);
                MdtBodyAddForce(b, 1, 0, 0);
                MdtBodyAddTorque(b, 1, 0, 0);
            }
            MdtConstraintEnable(c);
            MdtWorldStep(w, FRAME);
            ck_assert_int_eq(MdtConstraintGetRowCount(c), way ? 6 : 5);
            if (way == 2)
                assert_near(MdtLimitGetPosition(limit), 0, TOL(1e-6, 9e-14));
            MdtWorldDestroy(w);
        }
}
END_TEST

/* "Prismatic": one translation, along the axis, and no rotation; it reads zero where the bodies stood when the axis was
 * set. */
START_TEST(a_slider_slides_along_its_axis_and_does_not_turn) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID rail = boxAt(w, 5, 0, 0, 0), slide = boxAt(w, 1, 1, 2, 0);
    MdtPrismaticID j = MdtPrismaticCreate(w);
    MdtPrismaticSetBodies(j, rail, slide);
    MdtPrismaticSetAxis(j, 0, 3, 4);
    MdtLimitID limit = MdtPrismaticGetLimit(j);
    MdtLimitCalculatePosition(limit, 1);
    MdtPrismaticEnable(j);
    MdtWorldStep(w, FRAME);
    assert_near(MdtLimitGetPosition(limit), 0, TOL(1e-6, 9e-14));
    MeVector3 axis, p, q, away;
    double farthest = 0;
    for (int i = 0; i < 240; i++) {
        shake(rail, i);
        shake(slide, 2 * i + 9);
        MdtWorldStep(w, FRAME);
        assert_near(turnBetween(rail, slide), 0, TOL(1e-6, 9e-14));
        MdtPrismaticGetAxis(j, axis);
        MdtConstraintBodyGetPosition(MdtPrismaticQuaConstraint(j), 0, p);
        MdtConstraintBodyGetPosition(MdtPrismaticQuaConstraint(j), 1, q);
        for (int k = 0; k < 3; k++)
            away[k] = (MeReal)((double)p[k] - q[k]);
        const double along = dot(away, axis);
        assert_near(sqrt(fmax(0, dot(away, away) - along * along)), 0, TOL(8e-4, 6e-8) * (1 + fabs(along)));
        farthest = fmax(farthest, fabs((double)MdtLimitGetPosition(limit)));
    }
    ck_assert_msg(farthest > .5, "it slid by %g only", farthest);
    MdtWorldDestroy(w);
}
END_TEST

/* "Universal": the two axes have a common point and stay perpendicular. */
START_TEST(a_universal_joint_keeps_its_axes_perpendicular) {
    MdtWorldID w = scene_world(2, 2, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID a = boxAt(w, 1, 0, 0, 0), b = boxAt(w, 2, 0, 0, 1);
    MdtUniversalID j = MdtUniversalCreate(w);
    MdtUniversalSetBodies(j, a, b);
    MdtUniversalSetPosition(j, 0, 0, (MeReal).5);
    MdtUniversalSetAxis(j, 0, 1, 0, 0);
    MdtUniversalSetAxis(j, 1, 0, 1, 0);
    MdtUniversalEnable(j);
    MdtConeLimitID cone = MdtConeLimitCreate(w); /* keeps it away from the bend of 90 degrees, as the guide advises */
    MdtConeLimitSetBodies(cone, a, b);
    MdtConeLimitSetAxis(cone, 0, 0, 1);
    MdtConeLimitSetConeHalfAngle(cone, (MeReal)(PI / 3));
    MdtConeLimitEnable(cone);
    double bend = 0;
    for (int i = 0; i < 600; i++) {
        MeVector3 p, q;
        shake(a, i);
        shake(b, 3 * i + 5);
        MdtWorldStep(w, FRAME);
        MdtUniversalGetAxis(j, 0, p);
        MdtUniversalGetAxis(j, 1, q);
        assert_near(dot(p, q), 0, TOL(1e-6, 5e-9));
        assert_near(gapOf(MdtUniversalQuaConstraint(j)), 0, TOL(1e-6, 2e-9));
        bend = fmax(bend, turnBetween(a, b));
    }
    ck_assert_msg(bend > .5, "it bent by %g only", bend);
    MdtWorldDestroy(w);
}
END_TEST

/* "Angular3": the orientation to each other at SetBodies is kept, the position is free. */
START_TEST(an_angular_joint_keeps_the_orientation_and_frees_the_position) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID a = boxAt(w, 1, 0, 0, 0), b = boxAt(w, 2, 3, 0, 0);
    MdtBodySetQuaternion(b, 2, 1, 0, (MeReal).5);
    const double turn = turnBetween(a, b);
    ck_assert(turn > .9);
    MdtAngular3ID j = MdtAngular3Create(w);
    MdtAngular3SetBodies(j, a, b);
    MdtAngular3Enable(j);
    MdtBodySetLinearVelocity(a, 1, 2, 3);
    for (int i = 0; i < 300; i++) {
        MdtBodyAddTorque(a, (MeReal)sin(.1 * i), (MeReal).3, (MeReal)cos(.05 * i));
        MdtWorldStep(w, FRAME);
        assert_near(turnBetween(a, b), turn, TOL(1e-6, 1e-13));
    }
    assert_velocity(a, 1, 2, 3, TOL(1e-6, 3e-13));
    assert_velocity(b, 0, 0, 0, TOL(1e-6, 9e-14));
    MdtWorldDestroy(w);
}
END_TEST

/* "MdtAngular3EnableRotation": rotation about the axis is freed, the axis itself is kept. */
START_TEST(enabling_rotation_frees_an_angular_joint_about_its_axis) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtAngular3ID j = MdtAngular3Create(w);
    MdtAngular3SetBodies(j, b, 0);
    MdtAngular3SetAxis(j, 0, 1, 0);
    ck_assert(!MdtAngular3RotationIsEnabled(j));
    MdtAngular3Enable(j);
    MdtBodyAddTorque(b, 2, 4, -3);
    MdtWorldStep(w, FRAME);
    assert_spin(b, 0, 0, 0, TOL(1e-6, 9e-14));
    MdtAngular3EnableRotation(j, 1);
    ck_assert(MdtAngular3RotationIsEnabled(j));
    MdtBodyAddTorque(b, 2, 4, -3);
    MdtWorldStep(w, FRAME);
    assert_spin(b, 0, 4 / .4 * (double)FRAME, 0, TOL(1e-6, 9e-14));
    MdtWorldDestroy(w);
}
END_TEST

/* "Springing and damping can be set to introduce some softness around the upright": I θ'' = -k θ - d θ'. */
START_TEST(an_angular_joint_with_stiffness_is_an_angular_spring) {
    const double k = 4, d = .2, decay = d / (2 * .4), omega = sqrt(k / .4 - decay * decay);
    MdtWorldID w = scene_world(1, 1, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtAngular3ID j = MdtAngular3Create(w);
    MdtAngular3SetBodies(j, b, 0);
    MdtAngular3SetStiffness(j, (MeReal)k);
    MdtAngular3SetDamping(j, (MeReal)d);
    MdtAngular3Enable(j);
    MdtBodySetAngularVelocity(b, 0, 0, 1);
    for (int i = 1; i <= 240; i++) {
        MdtWorldStep(w, (MeReal).002);
        MeVector4 q;
        MdtBodyGetQuaternion(b, q);
        const double t = .002 * i, angle = exp(-decay * t) * sin(omega * t) / omega;
        assert_near(2 * asin((double)q[3]), angle, 5e-6);
    }
    MdtWorldDestroy(w);
}
END_TEST

/* A chassis that is held in place, and a wheel beside it; steering and suspension upwards, the hinge along z. */
typedef struct {
    MdtWorldID world;
    MdtBodyID chassis, wheel;
    MdtCarWheelID joint;
} Wheel;

static Wheel makeWheel(double gravity, double hold) {
    Wheel s;
    s.world = scene_world(2, 2, gravity);
    MdtWorldSetEpsilon(s.world, 0);
    s.chassis = boxAt(s.world, 50, 0, 0, 0);
    s.wheel = scene_body(s.world, 2, 0, 0, 1);
    s.joint = MdtCarWheelCreate(s.world);
    MdtCarWheelSetBodies(s.joint, s.chassis, s.wheel);
    MdtCarWheelSetPosition(s.joint, 0, 0, 1);
    MdtCarWheelSetSteeringAxis(s.joint, 0, 1, 0);
    MdtCarWheelSetHingeAxis(s.joint, 0, 0, 1);
    MdtCarWheelEnable(s.joint);
    if (hold > 0) {
        MdtFPFOJointID fixed = MdtFPFOJointCreate(s.world);
        MdtFPFOJointSetBodies(fixed, s.chassis, 0);
        MdtFPFOJointEnable(fixed);
    }
    return s;
}

/* "CarWheel": body 1 is the chassis, body 2 the wheel, attached at its centre; the steering axis is fixed in the
 * chassis, the hinge axis in the wheel, and they stay perpendicular. */
START_TEST(a_car_wheel_s_axes_are_fixed_in_chassis_and_wheel_and_perpendicular) {
    Wheel s = makeWheel(0, 0);
    MdtCarWheelSetSteeringLimitedForceMotor(s.joint, 0, 0);
    for (int i = 0; i < 300; i++) {
        MeVector3 steering, hinge, up, along;
        MdtBodyAddTorque(s.chassis, 3, (MeReal)(20 * sin(.05 * i)), -2);
        MdtBodyAddTorque(s.wheel, 0, (MeReal).3, 2);
        MdtWorldStep(s.world, FRAME);
        MdtCarWheelGetSteeringAxis(s.joint, steering);
        MdtCarWheelGetHingeAxis(s.joint, hinge);
        for (int k = 0; k < 3; k++) {
            up[k] = MdtBodyGetTransformPtr(s.chassis)[1][k];
            along[k] = MdtBodyGetTransformPtr(s.wheel)[2][k];
        }
        assert_near(dot(steering, up), 1, TOL(1e-6, 9e-14));
        assert_near(dot(hinge, along), 1, TOL(1e-6, 9e-14));
        assert_near(dot(steering, hinge), 0, TOL(1e-6, 2e-9));
    }
    ck_assert(fabs((double)MdtCarWheelGetSteeringAngle(s.joint)) > .1);
    MdtWorldDestroy(s.world);
}
END_TEST

/* "MdtCarWheelSetSuspension": a spring Kp and a damper Kd, which rest where they balance the load: Kp (height -
 * reference) = -m g. (Both guides print + kd × velocity; a damper opposes the rate.) */
START_TEST(a_suspension_rests_where_it_balances_the_load) {
    Wheel s = makeWheel(10, 1);
    MdtCarWheelSetSuspension(s.joint, 400, 40, 0, -1, 1, (MeReal).1);
    for (int i = 0; i < 600; i++)
        MdtWorldStep(s.world, FRAME);
    assert_near(MdtCarWheelGetSuspensionHeight(s.joint), .1 - 2 * 10 / 400., TOL(5e-8, 6e-11));
    assert_near(MdtCarWheelGetSuspensionRate(s.joint), 0, TOL(1e-6, 1e-8));
    assert_near(coordinate(s.wheel, 1), .1 - 2 * 10 / 400., TOL(5e-8, 2e-11));
    MdtBodyAddImpulse(s.wheel, 0, 2, 0); /* 1 m/s: it is slowed down, not driven on */
    /* m z'' = -400 z - 40 z' from 1 m/s, by the midpoint rule */
    const double h = (double)FRAME, m = 2, k = 400, d = 40;
    double highest = -1, z = 0, v = 1;
    for (int i = 0; i < 60; i++) {
        MdtWorldStep(s.world, FRAME);
        const double drag = h / m * (k * h / 2 + d) / 2, next = (v - h * k / m * z - drag * v) / (1 + drag);
        z += h * (v + next) / 2;
        v = next;
        assert_near(coordinate(s.wheel, 1), .05 + z, TOL(8e-8, 2e-10));
        highest = fmax(highest, coordinate(s.wheel, 1));
    }
    /* which is the top of exp(-10 t) sin(10 t) / 10 to (ω h)²/12, with ω² = 400 / 2 */
    assert_near(highest - .05, exp(-PI / 4) * sin(PI / 4) / 10, 200 * h * h / 12 * highest);
    MdtWorldDestroy(s.world);
}
END_TEST

/* "limit_softness 0": the stops of the suspension are hard. */
START_TEST(a_suspension_stops_hard_at_its_limits) {
    for (int side = -1; side <= 1; side += 2) {
        Wheel s = makeWheel(0, 1);
        MdtCarWheelSetSuspension(s.joint, 10, 1, 0, (MeReal)-.2, (MeReal).3, 0);
        for (int i = 0; i < 600; i++) {
            MdtBodyAddForce(s.wheel, 0, (MeReal)(500 * side), 0);
            MdtWorldStep(s.world, FRAME);
            const double height = MdtCarWheelGetSuspensionHeight(s.joint);
            ck_assert_msg(height < .3 + 1e-5 && height > -.2 - 1e-5, "height %g", height);
        }
        assert_near(MdtCarWheelGetSuspensionHeight(s.joint), side > 0 ? .3 : -.2, TOL(3e-7, 7e-11));
        MdtWorldDestroy(s.world);
    }
}
END_TEST

/* "MdtCarWheelSetSteeringLock": locked, the angle stays 0. */
START_TEST(a_locked_steering_stays_at_angle_0) {
    Wheel s = makeWheel(0, 1);
    MdtCarWheelSetSteeringLock(s.joint, 1);
    ck_assert(MdtCarWheelIsSteeringLocked(s.joint));
    for (int i = 0; i < 120; i++) {
        MdtBodyAddTorque(s.wheel, 0, 100, 0);
        MdtWorldStep(s.world, FRAME);
        assert_near(MdtCarWheelGetSteeringAngle(s.joint), 0, TOL(1e-6, 9e-14));
    }
    MdtWorldDestroy(s.world);
}
END_TEST

/* "MdtCarWheelGetHingeAngle": between 0 and pi in the Dynamics guide, which wins; the User Guide says 2 pi. */
START_TEST(a_wheel_s_hinge_angle_lies_between_0_and_pi) {
    Wheel s = makeWheel(0, 1);
    MdtCarWheelSetHingeLimitedForceMotor(s.joint, 5, 1000);
    double lowest = 9, highest = -9;
    for (int i = 0; i < 300; i++) {
        MdtWorldStep(s.world, FRAME);
        const double angle = MdtCarWheelGetHingeAngle(s.joint);
        lowest = fmin(lowest, angle);
        highest = fmax(highest, angle);
        if (i > 1)
            assert_near(fabs((double)MdtCarWheelGetHingeAngleRate(s.joint)), 5, TOL(5e-6, 5e-13));
    }
    ck_assert_msg(lowest >= 0 && lowest < .1, "lowest %g", lowest);
    ck_assert_msg(highest <= PI + 1e-6 && highest > PI - .1, "highest %g", highest);
    MdtWorldDestroy(s.world);
}
END_TEST

/* "Linear1" and "Linear2": a point of one body stays in a plane, or on a line, of the other. */
START_TEST(linear1_keeps_a_point_in_a_plane_and_linear2_on_a_line) {
    for (int line = 0; line < 2; line++) {
        MdtWorldID w = scene_world(2, 1, 0);
        MdtWorldSetEpsilon(w, 0);
        MdtBodyID a = boxAt(w, 1, 0, 1, 0), b = boxAt(w, 3, 0, 0, 0);
        MdtConstraintID c =
            line ? MdtLinear2QuaConstraint(MdtLinear2Create(w)) : MdtLinear1QuaConstraint(MdtLinear1Create(w));
        MdtConstraintSetBodies(c, a, b);
        MdtConstraintSetPosition(c, 0, (MeReal).5, 0);
        MdtConstraintSetAxis(c, 1, 2, 2);
        MdtConstraintEnable(c);
        double farthest = 0;
        for (int i = 0; i < 300; i++) {
            MeVector3 p, q, axis, ortho, away;
            shake(a, i);
            shake(b, 2 * i + 7);
            MdtWorldStep(w, FRAME);
            MdtConstraintBodyGetPosition(c, 0, p);
            MdtConstraintBodyGetPosition(c, 1, q);
            MdtConstraintBodyGetAxes(c, 1, axis, ortho);
            for (int k = 0; k < 3; k++)
                away[k] = (MeReal)((double)p[k] - q[k]);
            const double along = dot(away, axis), across = sqrt(fmax(0, dot(away, away) - along * along));
            assert_near(line ? across : along, 0, (TOL(2e-3, 1e-5)) * (1 + across + fabs(along)));
            farthest = fmax(farthest, line ? fabs(along) : across);
        }
        ck_assert_msg(farthest > .5, "it moved by %g only", farthest);
        MdtWorldDestroy(w);
    }
}
END_TEST

/* "FixedPath": a ball and socket whose attachment the program moves, every step; with the velocity it follows without
 * lag, without it is pulled after by relaxation. bodyindex says in whose frame: 1 is the world's here. */
START_TEST(a_fixed_path_carries_the_body_and_the_velocity_makes_it_exact) {
    for (int with = 0; with < 2; with++) {
        MdtWorldID w = scene_world(1, 1, 0);
        MdtWorldSetEpsilon(w, 0);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MdtFixedPathID j = MdtFixedPathCreate(w);
        MdtFixedPathSetBodies(j, b, 0);
        MdtFixedPathEnable(j);
        const double h = (double)FRAME;
        double lag = 0;
        for (int i = 0; i < 300; i++) {
            const double t = i * h;
            MdtFixedPathSetPosition(j, 1, (MeReal)t, 0, 0); /* 1 m/s along x */
            if (with)
                MdtFixedPathSetVelocity(j, 1, 1, 0, 0);
            MdtWorldStep(w, FRAME);
            lag = t + h - coordinate(b, 0);
        }
        if (with)
            assert_near(lag, 0, TOL(3e-6, 9e-14));
        else
            ck_assert_msg(lag > h, "lag %g", lag);
        assert_velocity(b, 1, 0, 0, TOL(8e-6, 2e-13));
        MdtWorldDestroy(w);
    }
}
END_TEST

/* "FixedPath": the pendulum that hangs from the moving point swings in response, and gravity's pull is fed back. */
START_TEST(a_fixed_path_feeds_the_forces_back) {
    const double edge[3] = {.1, 1, .1};
    MdtWorldID w = scene_world(1, 1, 10);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID b = scene_box(w, 2, edge, 0, 0, 0);
    MdtFixedPathID j = MdtFixedPathCreate(w);
    MdtFixedPathSetBodies(j, b, 0);
    MdtFixedPathSetPosition(j, 0, 0, (MeReal).5, 0); /* the upper end of the bar, in its own frame */
    MdtFixedPathSetPosition(j, 1, 0, (MeReal).5, 0);
    MdtFixedPathEnable(j);
    MdtWorldStep(w, FRAME);
    assert_near(forceOn(MdtFixedPathQuaConstraint(j), 0, 1), 20, TOL(2e-5, 2e-11));
    double swing = 0;
    for (int i = 0; i < 120; i++) {
        const double t = i * (double)FRAME, a = 3; /* a point that speeds up with 3 m/s² */
        MdtFixedPathSetPosition(j, 1, (MeReal)(a * t * t / 2), (MeReal).5, 0);
        MdtFixedPathSetVelocity(j, 1, (MeReal)(a * t), 0, 0);
        MdtWorldStep(w, FRAME);
        swing = fmin(swing, (double)MdtBodyGetTransformPtr(b)[1][0]);
        swing = fmin(swing, -fabs((double)MdtBodyGetTransformPtr(b)[1][0]));
    }
    assert_near(asin(-swing), 2 * atan(.3), .05); /* about atan(a/g), and as far beyond */
    MdtWorldDestroy(w);
}
END_TEST

/* "FPFO": rigid in all six directions; deprecated. */
START_TEST(fpfo_is_fully_rigid) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID a = boxAt(w, 1, 0, 0, 0), b = boxAt(w, 2, 1, 0, 0);
    MdtBodySetQuaternion(b, 1, (MeReal).2, (MeReal).3, 0);
    const double turn = turnBetween(a, b);
    MdtFPFOJointID j = MdtFPFOJointCreate(w);
    MdtFPFOJointSetBodies(j, a, b);
    MdtFPFOJointEnable(j);
    for (int i = 0; i < 300; i++) {
        shake(a, i);
        shake(b, 3 * i);
        MdtWorldStep(w, FRAME);
        MeVector3 p, q;
        MdtBodyGetPosition(a, p);
        MdtBodyGetPosition(b, q);
        assert_near(distance(p, q), 1, TOL(3e-6, 2e-9));
        assert_near(turnBetween(a, b), turn, TOL(2e-6, 7e-14));
    }
    MdtWorldDestroy(w);
}
END_TEST

/* "RPRO": the relative quaternion and angular velocity, given every step, drive the orientation; the place is kept. */
START_TEST(rpro_is_driven_by_quaternion_and_angular_velocity) {
    MdtWorldID w = scene_world(1, 1, 10);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID b = boxAt(w, 1, 0, 0, 0);
    MdtRPROJointID j = MdtRPROJointCreate(w);
    MdtRPROJointSetBodies(j, b, 0);
    MdtRPROJointEnable(j);
    const double rate = 2, h = (double)FRAME;
    for (int i = 0; i < 180; i++) {
        const double half = .5 * rate * h * i;
        MeVector4 q = {(MeReal)cos(half), 0, (MeReal)sin(half), 0}, now;
        MeVector3 omega = {0, (MeReal)rate, 0};
        MdtRPROJointSetRelativeQuaternion(j, q);
        MdtRPROJointSetRelativeAngularVelocity(j, omega);
        MdtWorldStep(w, FRAME);
        MdtBodyGetQuaternion(b, now);
        const double then = half + .5 * rate * h;
        assert_near(fabs((double)now[0] * cos(then) + (double)now[2] * sin(then)), 1, TOL(1e-6, 9e-14));
        /* the rows measure the sine of half the angle from the start's quaternion: cos(ω h/2) of the rate at the end;
         * a quaternion's rounding by 6e-8 makes 60 times that as a rate */
        assert_spin(b, 0, rate / cos(rate * h / 2), 0, TOL(4e-6, 7e-11));
        assert_position(b, 0, 0, 0, TOL(1e-6, 9e-14));
    }
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtRPROJointQuaConstraint(j)), 6);
    MdtWorldDestroy(w);
}
END_TEST

/* "MdtRPROJointSetLinearStrength": with a finite strength the joint gives way where more force would be needed, and
 * comes back; with MEINFINITY it is always kept. */
START_TEST(rpro_gives_way_beyond_its_strength) {
    for (int angular = 0; angular < 2; angular++) {
        MdtWorldID w = scene_world(1, 1, 0);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MdtRPROJointID j = MdtRPROJointCreate(w);
        MdtRPROJointSetBodies(j, b, 0);
        MdtRPROJointEnable(j);
        for (int finite = 0; finite < 2; finite++) {
            if (finite && !angular)
                MdtRPROJointSetLinearStrength(j, 10, 10, 10);
            if (finite && angular)
                MdtRPROJointSetAngularStrength(j, 10, 10, 10);
            for (int i = 0; i < 2; i++) { /* 9 holds, 12 moves it with 2; without limit 12 holds */
                const double load = i ? 12 : 9;
                MdtBodyAddForce(b, 0, angular ? 0 : (MeReal)load, 0);
                MdtBodyAddTorque(b, 0, angular ? (MeReal)load : 0, 0);
                MdtWorldStep(w, FRAME);
                const double moved = angular ? spin(b, 1) * .4 : velocity(b, 1);
                if (finite && i)
                    assert_near(moved, 2 * (double)FRAME, 9e-5);
                else
                    assert_near(moved, 0, 3e-4);
            }
        }
        steps(w, 120, FRAME);
        assert_position(b, 0, 0, 0, TOL(1e-6, 9e-14));
        assert_near(turnBetween(b, 0), 0, TOL(1e-6, 9e-14));
        MdtWorldDestroy(w);
    }
}
END_TEST

/* A mass on a spring to the world's origin. */
static MdtSpringID springTo(MdtWorldID w, MdtBodyID b) {
    MdtSpringID j = MdtSpringCreate(w);
    MdtSpringSetBodies(j, b, 0);
    MdtSpringSetPosition(j, 0, (MeReal)coordinate(b, 0), (MeReal)coordinate(b, 1), (MeReal)coordinate(b, 2));
    MdtSpringSetPosition(j, 1, 0, 0, 0);
    MdtSpringEnable(j);
    return j;
}

/* "Spring": F = -k (d - l); it turns nothing. */
START_TEST(a_spring_pulls_with_k_times_the_extension) {
    const double lengths[] = {.5, 1, 2};
    for (int i = 0; i < 3; i++) {
        MdtWorldID w = scene_world(1, 1, 0);
        MdtBodyID b = boxAt(w, 1, 1, 0, 0);
        MdtSpringID j = springTo(w, b);
        MdtSpringSetNaturalLength(j, (MeReal)lengths[i]);
        MdtSpringSetStiffness(j, 20);
        MdtSpringSetDamping(j, 0);
        MdtWorldStep(w, (MeReal).001);
        assert_near(forceOn(MdtSpringQuaConstraint(j), 0, 0), -20 * (1 - lengths[i]), 1e-3);
        assert_near(velocity(b, 0), -20 * (1 - lengths[i]) * .001, 1e-6);
        assert_spin(b, 0, 0, 0, 0);
        MdtWorldDestroy(w);
    }
}
END_TEST

/* "Both soft: a spring; both hard: a rod; upper hard, lower free: a string; mixed: an elastic", which may be stretched
 * but not compressed. Pushed in and pulled out by a force of 5 N for a second, from its length of 1 m. */
START_TEST(a_spring_can_be_a_spring_a_rod_a_string_or_an_elastic) {
    enum { SPRING, ROD, STRING, ELASTIC };
    for (int kind = SPRING; kind <= ELASTIC; kind++)
        for (int side = -1; side <= 1; side += 2) {
            MdtWorldID w = scene_world(1, 1, 0);
            MdtWorldSetEpsilon(w, 0);
            MdtBodyID b = boxAt(w, 1, 1, 0, 0);
            MdtSpringID j = springTo(w, b);
            MdtLimitID limit = MdtSpringGetLimit(j);
            MdtSingleLimitID lower = MdtLimitGetLowerLimit(limit), upper = MdtLimitGetUpperLimit(limit);
            MdtSingleLimitSetRestitution(lower, 0);
            MdtSingleLimitSetRestitution(upper, 0);
            if (kind == ROD)
                MdtSpringSetStiffness(j, MEINFINITY);
            if (kind == STRING) {
                MdtSingleLimitSetStiffness(upper, MEINFINITY);
                MdtSingleLimitSetStiffness(lower, 0);
                MdtSingleLimitSetDamping(lower, 0);
            }
            if (kind == ELASTIC)
                MdtSingleLimitSetStiffness(lower, MEINFINITY);
            for (int i = 0; i < 30; i++) {
                MdtBodyAddForce(b, (MeReal)(5 * side), 0, 0);
                MdtWorldStep(w, FRAME);
            }
            const double moved = side * (coordinate(b, 0) - 1);
            const MeBool yields = kind == SPRING || (kind == STRING && side < 0) || (kind == ELASTIC && side > 0);
            if (yields)
                ck_assert_msg(moved > .1, "kind %d side %d moved by %g", kind, side, moved);
            else
                assert_near(moved, 0, TOL(1e-6, 7e-12));
            MdtWorldDestroy(w);
        }
}
END_TEST

/* "The default is spring-like, with two soft, damped limits, both at the initial separation": a new spring is at rest,
 * and comes back to rest. */
START_TEST(a_new_spring_is_soft_damped_and_at_its_length) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtBodyID b = boxAt(w, 1, 0, 3, 0);
    springTo(w, b);
    steps(w, 60, FRAME);
    assert_position(b, 0, 3, 0, TOL(1e-6, 3e-13));
    MdtBodyAddImpulse(b, 0, 1, 0);
    steps(w, 10, FRAME);
    ck_assert_msg(coordinate(b, 1) > 3.05, "it did not give");
    steps(w, 1800, FRAME);
    assert_position(b, 0, 3, 0, TOL(3e-6, 7e-8));
    MdtWorldDestroy(w);
}
END_TEST

/* User Guide ch. 3, "Spring": solved as a constraint; a hard one, a rod, answers in a step whatever the masses. */
START_TEST(a_rod_answers_at_once_whatever_the_masses) {
    const double masses[] = {.01, 1, 1000};
    for (int i = 0; i < 3; i++) {
        MdtWorldID w = scene_world(1, 1, 0);
        MdtWorldSetEpsilon(w, 0);
        MdtBodyID b = scene_body(w, masses[i], 1, 0, 0);
        MdtSpringID j = springTo(w, b);
        MdtSpringSetStiffness(j, MEINFINITY);
        MdtLimitID limit = MdtSpringGetLimit(j);
        MdtSingleLimitSetRestitution(MdtLimitGetLowerLimit(limit), 0);
        MdtSingleLimitSetRestitution(MdtLimitGetUpperLimit(limit), 0);
        MdtBodySetLinearVelocity(b, 1, 0, 0);
        MdtWorldStep(w, FRAME);
        assert_near(coordinate(b, 0), 1, TOL(1e-6, 9e-14));
        assert_near(velocity(b, 0), 0, TOL(1e-6, 3e-13));
        MdtWorldDestroy(w);
    }
}
END_TEST

/* A body held at its centre, and a cone about the world's x. */
typedef struct {
    MdtWorldID world;
    MdtBodyID body;
    MdtConeLimitID cone;
} Cone;

static Cone makeCone(double halfAngle) {
    Cone s;
    s.world = scene_world(1, 2, 0);
    MdtWorldSetEpsilon(s.world, 0);
    s.body = scene_body(s.world, 1, 0, 0, 0);
    MdtBSJointID ball = MdtBSJointCreate(s.world);
    MdtBSJointSetBodies(ball, s.body, 0);
    MdtBSJointEnable(ball);
    s.cone = MdtConeLimitCreate(s.world);
    MdtConeLimitSetBodies(s.cone, s.body, 0);
    if (halfAngle > 0)
        MdtConeLimitSetConeHalfAngle(s.cone, (MeReal)halfAngle);
    MdtConeLimitEnable(s.cone);
    return s;
}

static double coneAngle(Cone s) {
    const MeMatrix4Ptr tm = MdtBodyGetTransformPtr(s.body);
    return atan2(sqrt((double)tm[0][1] * tm[0][1] + (double)tm[0][2] * tm[0][2]), (double)tm[0][0]);
}

/* "ConeLimit": no row inside, one at the limit, which is not passed. */
START_TEST(a_cone_limit_has_no_row_inside_and_one_at_its_side) {
    Cone s = makeCone(.8);
    MdtBodySetAngularVelocity(s.body, 0, 1, (MeReal).5);
    MeBool reached = 0;
    for (int i = 0; i < 120; i++) {
        MdtBodyAddTorque(s.body, 0, (MeReal).1, (MeReal).05);
        MdtWorldStep(s.world, FRAME);
        const int rows = MdtConstraintGetRowCount(MdtConeLimitQuaConstraint(s.cone));
        assert_below(coneAngle(s), .8 + TOL(1e-5, 1e-6));
        if (coneAngle(s) < .75)
            ck_assert_int_eq(rows, 0);
        if (coneAngle(s) > .8 - 1e-5) {
            ck_assert_int_eq(rows, 1);
            reached = 1;
        }
    }
    ck_assert_msg(reached, "it never came to the side: %g", coneAngle(s));
    MdtWorldDestroy(s.world);
}
END_TEST

/* "Note that the cone limit does not place a limit on the 'twist' freedom." */
START_TEST(a_cone_limit_leaves_the_twist_free) {
    Cone s = makeCone(.3);
    MdtBodySetAngularVelocity(s.body, 2, 0, 0);
    steps(s.world, 300, FRAME);
    assert_spin(s.body, 2, 0, 0, TOL(2e-6, 2e-13));
    MdtWorldDestroy(s.world);
}
END_TEST

/* "Defaults to ME_PI at reset, which is effectively no limit." */
START_TEST(a_cone_of_half_angle_pi_is_no_limit) {
    Cone s = makeCone(0);
    assert_near(MdtConeLimitGetConeHalfAngle(s.cone), PI, TOL(1e-6, 3e-13));
    MdtBodySetAngularVelocity(s.body, 0, 3, 0);
    double max = 0;
    for (int i = 0; i < 300; i++) {
        MdtWorldStep(s.world, FRAME);
        max = fmax(max, coneAngle(s));
        assert_spin(s.body, 0, 3, 0, TOL(3e-6, 3e-13));
    }
    ck_assert_msg(max > PI - .05, "it came to %g only", max);
    MdtWorldDestroy(s.world);
}
END_TEST

/* User Guide app. D, "MdtSkeletal": a ball and socket, an elliptical cone, and a limit of the twist; pi/4 each at
 * first. */
START_TEST(a_skeletal_joint_limits_an_elliptical_cone_and_the_twist) {
    const MeReal torque[3][3] = {{0, 2, 0}, {0, 0, 2}, {2, 0, 0}};
    for (int way = 0; way < 3; way++) {
        MdtWorldID w = scene_world(1, 1, 0);
        MdtWorldSetEpsilon(w, 0);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MdtSkeletalID j = MdtSkeletalCreate(w);
        MdtSkeletalSetBodies(j, b, 0);
        assert_near(MdtSkeletalGetConePrimaryLimitAngle(j), PI / 4, TOL(1e-6, 7e-14));
        assert_near(MdtSkeletalGetTwistLimitAngle(j), PI / 4, TOL(1e-6, 7e-14));
        MdtSkeletalSetConePrimaryLimitAngle(j, (MeReal).5);
        MdtSkeletalSetConeSecondaryLimitAngle(j, (MeReal).9);
        MdtSkeletalSetTwistLimitAngle(j, (MeReal).3);
        MdtSkeletalSetConeOption(j, MdtSkeletalConeOptionCone);
        MdtSkeletalSetTwistOption(j, MdtSkeletalTwistOptionLimited);
        MdtSkeletalEnable(j);
        for (int i = 0; i < 240; i++) {
            MdtBodyAddTorque(b, torque[way][0], torque[way][1], torque[way][2]);
            MdtWorldStep(w, FRAME);
        }
        const double wanted[] = {.9, .5,
                                 .3}; /* about y the axis swings towards the third axis, about z to the second */
        assert_near(turnBetween(b, 0), wanted[way], TOL(9e-7, 3e-9));
        assert_position(b, 0, 0, 0, TOL(1e-6, 9e-14));
        MdtWorldDestroy(w);
    }
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, a_ball_and_socket_leaves_all_rotations_free);
    tcase_add_test(t, at_a_limit_or_powered_hinge_and_slider_cost_six_rows);
    tcase_add_test(t, a_slider_slides_along_its_axis_and_does_not_turn);
    tcase_add_test(t, a_universal_joint_keeps_its_axes_perpendicular);
    tcase_add_test(t, an_angular_joint_keeps_the_orientation_and_frees_the_position);
    tcase_add_test(t, enabling_rotation_frees_an_angular_joint_about_its_axis);
    tcase_add_test(t, an_angular_joint_with_stiffness_is_an_angular_spring);
    tcase_add_test(t, a_car_wheel_s_axes_are_fixed_in_chassis_and_wheel_and_perpendicular);
    tcase_add_test(t, a_suspension_rests_where_it_balances_the_load);
    tcase_add_test(t, a_suspension_stops_hard_at_its_limits);
    tcase_add_test(t, a_locked_steering_stays_at_angle_0);
    tcase_add_test(t, a_wheel_s_hinge_angle_lies_between_0_and_pi);
    tcase_add_test(t, linear1_keeps_a_point_in_a_plane_and_linear2_on_a_line);
    tcase_add_test(t, a_fixed_path_carries_the_body_and_the_velocity_makes_it_exact);
    tcase_add_test(t, a_fixed_path_feeds_the_forces_back);
    tcase_add_test(t, fpfo_is_fully_rigid);
    tcase_add_test(t, rpro_is_driven_by_quaternion_and_angular_velocity);
    tcase_add_test(t, rpro_gives_way_beyond_its_strength);
    tcase_add_test(t, a_spring_pulls_with_k_times_the_extension);
    tcase_add_test(t, a_spring_can_be_a_spring_a_rod_a_string_or_an_elastic);
    tcase_add_test(t, a_new_spring_is_soft_damped_and_at_its_length);
    tcase_add_test(t, a_rod_answers_at_once_whatever_the_masses);
    tcase_add_test(t, a_cone_limit_has_no_row_inside_and_one_at_its_side);
    tcase_add_test(t, a_cone_limit_leaves_the_twist_free);
    tcase_add_test(t, a_cone_of_half_angle_pi_is_no_limit);
    tcase_add_test(t, a_skeletal_joint_limits_an_elliptical_cone_and_the_twist);
}

TEST_MAIN("Behaviours_Joints", tests)
