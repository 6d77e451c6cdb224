/* Documented behaviours: single joints (Dynamics guide ch. 3).
 *
 * Already proved elsewhere:
 *   ball and socket: the attachments coincide                  test_BSJoint: the_points_stay_together
 *   hinge: rotation about one axis only                        test_Hinge: only_the_angle_is_free
 *   hinge: the angle counts full turns                         test_Hinge: the_angle_counts_full_turns
 *   hinge: limits may lie beyond ±pi, and none is missed       test_Hinge: stops_lie_beyond_full_turns
 *   each joint removes its freedoms and no others              test_Joints: removed_freedoms_stay_removed_and_...
 *   prismatic: it reads zero where the axis was set            test_Prismatic: zero_is_where_the_bodies_were_...
 *   angular: orientation, axis, spring                         test_Angular3
 *   car wheel: suspension, its stops, lock, hinge angle        test_CarWheel
 *   fixed path: with and without the velocity, forces          test_FixedPath
 *   RPRO: driven by quaternion and rate, up to its strength    test_RPROJoint
 *   spring: spring, rod, string and elastic, defaults          test_Spring
 *   cone limit: rows, side, twist, pi                          test_ConeLimit
 *   skeletal: both angles of the cone, the twist               test_Skeletal
 */
#include "behaviour.h"

static const double edges[3] = {1, .6, .4};

static MdtBodyID boxAt(MdtWorldID w, double mass, double x, double y, double z) {
    return scene_box(w, mass, edges, x, y, z);
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
        MdtBodyAddTorque(held, .1, .2, -.1);
        MdtBodyAddTorque(loose, .1, .2, -.1);
        MdtWorldStep(w, FRAME);
    }
    assert_position(held, 0, 0, 0, TOL(1e-6, 9e-14));
    const double turn = turnBetween(held, loose);
    MdtWorldDestroy(w);
    return turn;
}

/* "BSJoint": all rotations are free: a body held at its centre of mass turns as a free one does, but for the Cayley
 * map of bodies in joints, a relative error of (ω h)²/12 in the angle, which falls with the square of the step. */
TEST(a_ball_and_socket_leaves_all_rotations_free) {
    const double coarse = turnOfHeld(1), fine = turnOfHeld(4);
    assert_below(coarse, .01);
    assert_near(coarse / fine, 16, TOL(.02, .04));
}

/* "Hinge Actuators": powered, or at a limit, a hinge costs six rows; so does a slider. */
TEST(at_a_limit_or_powered_hinge_and_slider_cost_six_rows) {
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
TEST(a_car_wheel_s_axes_are_fixed_in_chassis_and_wheel_and_perpendicular) {
    Wheel s = makeWheel(0, 0);
    MdtCarWheelSetSteeringLimitedForceMotor(s.joint, 0, 0);
    for (int i = 0; i < 300; i++) {
        MeVector3 steering, hinge, up, along;
        MdtBodyAddTorque(s.chassis, 3, 20 * sin(.05 * i), -2);
        MdtBodyAddTorque(s.wheel, 0, .3, 2);
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
    ck_assert(fabs(MdtCarWheelGetSteeringAngle(s.joint)) > .1);
    MdtWorldDestroy(s.world);
}

/* A mass on a spring to the world's origin. */
static MdtSpringID springTo(MdtWorldID w, MdtBodyID b) {
    MdtSpringID j = MdtSpringCreate(w);
    MdtSpringSetBodies(j, b, 0);
    MdtSpringSetPosition(j, 0, coordinate(b, 0), coordinate(b, 1), coordinate(b, 2));
    MdtSpringSetPosition(j, 1, 0, 0, 0);
    MdtSpringEnable(j);
    return j;
}

/* User Guide ch. 3, "Spring": solved as a constraint; a hard one, a rod, answers in a step whatever the masses. */
TEST(a_rod_answers_at_once_whatever_the_masses) {
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
