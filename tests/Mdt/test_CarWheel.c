/* The car wheel: suspension, stops, steering and rolling, and a chassis on four of them.
 *
 * The quarter car: a chassis that can only go up and down, on one wheel that the ground keeps at its height. The
 * steering axis is y, the hinge axis z. */
#include "measure.h"

static const double chassisMass = 20, wheelInertia = .1, g = 9.81, pi = 3.14159265358979323846;

typedef struct {
    MdtWorldID world;
    MdtBodyID chassis, wheel;
    MdtCarWheelID joint;
} Car;

static MdtBodyID makeWheel(MdtWorldID w, double x, double y, double z) {
    MdtBodyID wheel = scene_body(w, 5, x, y, z);
    MdtBodySetSphericalInertiaTensor(wheel, wheelInertia);
    return wheel;
}

static MdtCarWheelID join(MdtWorldID w, MdtBodyID chassis, MdtBodyID wheel, double x, double y, double z) {
    MdtCarWheelID j = MdtCarWheelCreate(w);
    MdtCarWheelSetBodies(j, chassis, wheel);
    MdtCarWheelSetPosition(j, x, y, z);
    MdtCarWheelSetSteeringAndHingeAxes(j, 0, 1, 0, 0, 0, 1);
    MdtCarWheelEnable(j);
    return j;
}

/* The ground: the wheel's centre stays at its height. */
static void putOnGround(MdtWorldID w, MdtBodyID wheel, double x, double y, double z) {
    MdtLinear1ID plane = MdtLinear1Create(w);
    MdtLinear1SetBodies(plane, wheel, 0);
    MdtLinear1SetPosition(plane, x, y, z);
    MdtLinear1SetAxis(plane, 0, 1, 0);
    MdtLinear1Enable(plane);
}

static void guide(MdtWorldID w, MdtBodyID chassis) {
    MdtPrismaticID rail = MdtPrismaticCreate(w);
    MdtPrismaticSetBodies(rail, chassis, 0);
    MdtPrismaticSetAxis(rail, 0, 1, 0);
    MdtPrismaticEnable(rail);
}

static Car quarterCar(double gravity) {
    const double edge[3] = {2, .4, 1};
    Car c;
    c.world = scene_world(2, 4, gravity);
    MdtWorldSetEpsilon(c.world, 0);
    c.chassis = scene_box(c.world, chassisMass, edge, 0, 1, 0);
    c.wheel = makeWheel(c.world, 0, .3, 0);
    guide(c.world, c.chassis);
    putOnGround(c.world, c.wheel, 0, .3, 0);
    c.joint = join(c.world, c.chassis, c.wheel, 0, .3, 0);
    return c;
}

/* A wheel on the world in place of a chassis, without gravity: for steering and rolling. */
static Car lonelyWheel(void) {
    Car c;
    c.world = scene_world(1, 1, 0);
    MdtWorldSetEpsilon(c.world, 0);
    c.chassis = NULL;
    c.wheel = makeWheel(c.world, 0, 0, 0);
    c.joint = join(c.world, NULL, c.wheel, 0, 0, 0);
    return c;
}

static double chassisHeight(Car c) {
    double p[3];
    measure_position(c.chassis, p);
    return p[1];
}

/* ---- suspension ---- */

TEST(the_suspension_rests_where_its_spring_carries_the_load) {
    const double kps[] = {500, 2000, 8000}, references[] = {0, .1, -.2};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            Car c = quarterCar(g);
            const double sag = chassisMass * g / kps[i];
            double f[3];
            MdtCarWheelSetSuspension(c.joint, kps[i], 300, 0, -2, 2, references[k]);
            steps(c.world, 1200, FRAME);
            assert_near(MdtCarWheelGetSuspensionHeight(c.joint), references[k] + sag, TOL(5e-7, 5e-14));
            assert_near(MdtCarWheelGetSuspensionRate(c.joint), 0, 3e-10);
            assert_near(chassisHeight(c), 1 - references[k] - sag, TOL(1e-6, 2e-13));
            read_force(MdtCarWheelQuaConstraint(c.joint), 0, f);
            assert_vec3_near(f, 0, chassisMass * g, 0, TOL(1e-4, 2e-11));
        }
}

TEST(the_suspension_is_a_damped_spring) {
    const double kps[] = {400, 1600, 6400}, kds[] = {0, 20, 60};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            Car c = quarterCar(g);
            Swing swing = {0};
            const double w0 = sqrt(kps[i] / chassisMass), decay = kds[k] / (2 * chassisMass), h = FRAME;
            const double rest = chassisMass * g / kps[i];
            MdtCarWheelSetSuspension(c.joint, kps[i], kds[k], 0, -10, 10, 0);
            for (int n = 0; n < 3000 && swing.crossings < 9; n++) {
                MdtWorldStep(c.world, FRAME);
                swing_add(&swing, (double)MdtCarWheelGetSuspensionHeight(c.joint) - rest);
            }
            ck_assert_int_eq(swing.crossings, 9);
            swing_check(&swing, w0, decay, h, TOL(1e-5, 1e-8));
        }
}

/* The measured rate is that of the measured height, which goes on by the mean of the rates at a step's ends. */
TEST(the_suspension_rate_is_the_height_s) {
    Car c = quarterCar(g);
    MdtCarWheelSetSuspension(c.joint, 1000, 50, 0, -1, 1, 0);
    double before = 0, rateBefore = 0;
    for (int n = 0; n < 100; n++) {
        MdtWorldStep(c.world, FRAME);
        const double height = MdtCarWheelGetSuspensionHeight(c.joint), rate = MdtCarWheelGetSuspensionRate(c.joint);
        assert_near(.5 * (rateBefore + rate), (height - before) / (double)FRAME, TOL(2e-5, 1e-13));
        before = height;
        rateBefore = rate;
    }
}

/* The load is more than the spring carries before the high stop, or it is turned round before the low one. */
TEST(hard_stops_are_not_passed) {
    for (int side = -1; side <= 1; side += 2) {
        Car c = quarterCar(g * side);
        const double stop = side > 0 ? .07 : -.05;
        double max = 0;
        MdtCarWheelSetSuspension(c.joint, 500, 20, 0, -.05, .07, 0);
        for (int n = 0; n < 300; n++) {
            MdtWorldStep(c.world, FRAME);
            max = fmax(max, side * (double)MdtCarWheelGetSuspensionHeight(c.joint));
        }
        assert_near(max, stop * side, TOL(7e-8, 3e-12));
        assert_near(MdtCarWheelGetSuspensionHeight(c.joint), stop, TOL(7e-8, 2e-12));
        ck_assert_int_eq(MdtConstraintGetRowCount(MdtCarWheelQuaConstraint(c.joint)),
                         6); /* 3, steering, spring, stop */
    }
}

/* As a joint gives way by ε F h²/γ, so does a stop of this softness. */
TEST(a_soft_stop_gives_way_by_its_softness) {
    const double softness[] = {.01, .1}, h = FRAME, gamma = .2;
    for (int i = 0; i < 2; i++) {
        Car c = quarterCar(g);
        MdtWorldSetGamma(c.world, gamma);
        MdtCarWheelSetSuspension(c.joint, 0, 0, softness[i], -.05, .07, 0);
        steps(c.world, 2000, FRAME);
        const double sag = softness[i] * chassisMass * g * h * h / gamma;
        assert_near((double)MdtCarWheelGetSuspensionHeight(c.joint) - (double)(MeReal).07, sag,
                    TOL(1e-5, 7e-10) * sag + TOL(1e-7, 1e-9));
    }
}

TEST(without_a_suspension_the_wheel_slides_freely) {
    Car c = quarterCar(g);
    MdtWorldStep(c.world, FRAME);
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtCarWheelQuaConstraint(c.joint)), 4);
    const double start = chassisHeight(c);
    double v[3];
    measure_velocity(c.chassis, v);
    steps(c.world, 29, FRAME);
    const double t = 29 * (double)FRAME;
    assert_near(start - chassisHeight(c), -v[1] * t + g * t * t / 2, TOL(2e-6, 2e-13));
}

/* ---- steering ---- */

static void twistWheel(Car c, double torque) {
    MdtBodyAddTorque(c.wheel, 0, torque, 0);
}

static double steeringOf(Car c) {
    double z[3];
    const double hinge[3] = {0, 0, 1};
    measure_turnOut(c.wheel, hinge, z);
    return atan2(z[0], z[2]); /* of the wheel about y */
}

TEST(a_locked_wheel_keeps_the_angle_0) {
    Car c = lonelyWheel();
    MdtCarWheelSetSteeringLimitedForceMotor(c.joint, 3, 10); /* rests while locked */
    MdtCarWheelSetSteeringLock(c.joint, 1);
    MdtBodySetAngularVelocity(c.wheel, 0, 0, 10);
    for (int n = 0; n < 300; n++) {
        double t[3];
        twistWheel(c, 5 * sin(.1 * n));
        MdtWorldStep(c.world, FRAME);
        assert_near(MdtCarWheelGetSteeringAngle(c.joint), 0, TOL(1e-6, 9e-14));
        assert_near(steeringOf(c), 0, TOL(1e-6, 9e-14));
        read_torque(MdtCarWheelQuaConstraint(c.joint), 1, t);
        assert_near(t[1], -5 * sin(.1 * n), TOL(5e-6, 4e-12));
    }
    assert_near(MdtCarWheelGetHingeAngleRate(c.joint), 10, TOL(1e-5, 9e-13)); /* it rolls on */
}

TEST(a_new_wheel_s_steering_holds_its_angle) {
    Car c = lonelyWheel();
    for (int n = 0; n < 100; n++) {
        twistWheel(c, 100);
        MdtWorldStep(c.world, FRAME);
    }
    assert_near(steeringOf(c), 0, TOL(1e-6, 9e-14)); /* a hundred steps, each to 1e-10 */
}

/* The motor turns the wheel against the chassis; the angle is that of the chassis against the wheel. */
TEST(the_steering_motor_moves_and_stops) {
    Car c = lonelyWheel();
    const double speed = .5, force = .02, h = FRAME;
    MdtCarWheelSetSteeringLimitedForceMotor(c.joint, speed, force);
    /* At its speed the motor drives the angle itself: the mean rate is the one whose midpoint turn is that, and the
     * velocity stage gives the speed. After a step at its strength a joint is taken by backward Euler: the wheel turns
     * by the rate that it gets. */
    const double driven = 2 * tan(.5 * speed * h) / h, gain = force / wheelInertia * h;
    double angle = 0, rate = 0, used = 0;
    for (int n = 1; n <= 240; n++) {
        MdtWorldStep(c.world, FRAME);
        const int isAtStrength = used > .5 * gain;
        const double pushed = rate + gain, mean = isAtStrength ? pushed : .5 * (rate + pushed);
        const double next = fmin(isAtStrength ? driven : speed, pushed);
        angle += midpoint_turn(fmin(driven, mean), h);
        used = fabs(next - rate);
        rate = next;
        assert_near(steeringOf(c), angle, TOL(2e-6, 8e-10));
        assert_near(MdtCarWheelGetSteeringAngle(c.joint), -angle, TOL(2e-6, 8e-10));
        assert_near(MdtCarWheelGetSteeringAngleRate(c.joint), -rate, TOL(5e-7, 2e-10));
    }
    MdtCarWheelSetSteeringLimitedForceMotor(c.joint, 0, force);
    steps(c.world, 240, FRAME);
    angle = steeringOf(c);
    for (int n = 0; n < 60; n++) { /* less than the motor holds */
        twistWheel(c, .9 * force);
        MdtWorldStep(c.world, FRAME);
    }
    assert_near(steeringOf(c), angle, TOL(1e-6, 2e-9));
    double w[3];
    twistWheel(c, 3 * force); /* and more */
    MdtWorldStep(c.world, FRAME);
    measure_rate(c.wheel, w);
    assert_near(w[1], 2 * force / wheelInertia * h, TOL(7e-9, 3e-9));
}

TEST(a_motor_without_force_lets_the_steering_go) {
    const MeReal forces[] = {0, -1};
    for (int i = 0; i < 2; i++) {
        Car c = lonelyWheel();
        double w[3];
        MdtCarWheelSetSteeringLimitedForceMotor(c.joint, 1, forces[i]);
        MdtBodySetAngularVelocity(c.wheel, 0, 2, 0);
        steps(c.world, 100, FRAME);
        measure_rate(c.wheel, w);
        assert_vec3_near(w, 0, 2, 0, TOL(1e-6, 2e-13));
        ck_assert_int_eq(MdtConstraintGetRowCount(MdtCarWheelQuaConstraint(c.joint)), 3);
    }
}

TEST(the_steering_angle_goes_from_minus_pi_to_pi) {
    Car c = lonelyWheel();
    MdtCarWheelSetSteeringLimitedForceMotor(c.joint, -2, 1000);
    double angle = 0;
    for (int n = 0; n < 300; n++) {
        MdtWorldStep(c.world, FRAME);
        angle += 2 * (double)FRAME;
        assert_near(remainder((double)MdtCarWheelGetSteeringAngle(c.joint) - angle, 2 * pi), 0, TOL(2e-6, 8e-10));
        ck_assert(fabs(MdtCarWheelGetSteeringAngle(c.joint)) <= pi + 1e-6);
    }
}

/* One axis after the other, in any order, on a wheel that stands turned: straight on is as it stands then. */
TEST(axes_set_one_by_one_count_from_where_the_bodies_stand) {
    for (int order = 0; order < 2; order++) {
        Car c = lonelyWheel();
        double R[3][3], before[3][3];
        MdtCarWheelDisable(c.joint);
        MdtCarWheelReset(c.joint); /* steering z, hinge y: each new axis is along an old one */
        MdtBodySetQuaternion(c.wheel, .6, .4, -.5, .3);
        for (int i = 0; i < 2; i++) {
            if (i == order)
                MdtCarWheelSetSteeringAxis(c.joint, 0, 2, 0);
            else
                MdtCarWheelSetHingeAxis(c.joint, 0, 0, 3);
        }
        MdtCarWheelSetSteeringLock(c.joint, 1);
        MdtCarWheelEnable(c.joint);
        measure_rotation(c.wheel, before);
        steps(c.world, 10, FRAME);
        measure_rotation(c.wheel, R);
        for (int i = 0; i < 3; i++)
            assert_vec3_near(R[i], before[i][0], before[i][1], before[i][2], TOL(1e-6, 9e-14));
        assert_near(MdtCarWheelGetSteeringAngle(c.joint), 0, TOL(1e-6, 9e-14));
        assert_near(MdtCarWheelGetHingeAngle(c.joint), 0, TOL(1e-6, 9e-14)); /* an arc cosine at 1 */
        MeVector3 axis;
        MdtCarWheelGetSteeringAxis(c.joint, axis);
        assert_vec3_near(axis, 0, 1, 0, TOL(1e-6, 9e-14));
        MdtCarWheelGetHingeAxis(c.joint, axis);
        assert_vec3_near(axis, 0, 0, 1, TOL(1e-6, 9e-14));
    }
}

/* ---- rolling ---- */

TEST(the_hinge_motor_drives_and_brakes) {
    Car c = lonelyWheel();
    const double force = .3, speed = 12, h = FRAME;
    double w[3], t[3];
    MdtCarWheelSetHingeLimitedForceMotor(c.joint, speed, force);
    for (int n = 1; n <= 300; n++) {
        MdtWorldStep(c.world, FRAME);
        measure_rate(c.wheel, w);
        const double rate = fmin(speed, force / wheelInertia * n * h);
        assert_vec3_near(w, 0, 0, rate, TOL(2e-5, 2e-12));
        assert_near(MdtCarWheelGetHingeAngleRate(c.joint), rate, TOL(2e-5, 2e-12));
        read_torque(MdtCarWheelQuaConstraint(c.joint), 0, t);
        if (rate < speed)
            assert_near(t[2], -force, TOL(3e-7, 3e-14)); /* on the chassis */
    }
    MdtCarWheelSetHingeLimitedForceMotor(c.joint, 0, force);
    for (int n = 1; n <= 300; n++) {
        MdtWorldStep(c.world, FRAME);
        const double rate = fmax(0, speed - force / wheelInertia * n * h);
        assert_near(MdtCarWheelGetHingeAngleRate(c.joint), rate, TOL(2e-5, 2e-12));
    }
    MdtBodyAddTorque(c.wheel, 0, 0, .9 * force); /* the brake holds */
    MdtWorldStep(c.world, FRAME);
    assert_near(MdtCarWheelGetHingeAngleRate(c.joint), 0, TOL(1e-6, 9e-14));
}

/* The wheel turns round and round; the angle goes up and down between 0 and pi. */
TEST(the_hinge_angle_is_between_0_and_pi) {
    Car c = lonelyWheel();
    double angle = 0;
    MdtBodySetAngularVelocity(c.wheel, 0, 0, 7);
    for (int n = 0; n < 200; n++) {
        MdtWorldStep(c.world, FRAME);
        angle += midpoint_turn(7, FRAME);
        assert_near(MdtCarWheelGetHingeAngle(c.joint), acos(cos(angle)), TOL(3e-6, 2e-12));
        ck_assert(MdtCarWheelGetHingeAngle(c.joint) >= 0 && MdtCarWheelGetHingeAngle(c.joint) <= (MeReal)(pi + 1e-6));
    }
}

static void giveWheelShape(MdtBodyID wheel) {
    MeMatrix3 I;
    MdtMakeInertiaTensorBox(10, .6, .6, .2, I);
    MdtBodySetMass(wheel, 10);
    MdtBodySetInertiaTensor(wheel, I);
}

/* The wheel rolls half a radian a step; it is steered all the same by what the motor says. */
TEST(a_rolling_wheel_is_steered) {
    Car c = lonelyWheel();
    giveWheelShape(c.wheel);
    MdtBodySetAngularVelocity(c.wheel, 0, 0, 30);
    MdtCarWheelSetSteeringLimitedForceMotor(c.joint, 1, 1000);
    for (int n = 0; n < 120; n++) {
        MdtWorldStep(c.world, FRAME);
        double z[3];
        const double hinge[3] = {0, 0, 1};
        measure_turnOut(c.wheel, hinge, z);
        assert_near(z[1], 0, TOL(1e-6, 3e-9));
        assert_near(MdtCarWheelGetHingeAngleRate(c.joint), 30, 5e-3);
        assert_near(steeringOf(c), (n + 1) * (double)FRAME, TOL(2e-6, 4e-8));
    }
}

/* A car that goes round in circles: the motor that holds the steering does. */
TEST(a_rolling_wheel_in_a_bend_does_not_steer_itself) {
    Car c;
    c.world = scene_world(2, 1, 0);
    MdtWorldSetEpsilon(c.world, 0);
    c.chassis = scene_body(c.world, 1000, 0, 0, 0);
    MdtBodySetSphericalInertiaTensor(c.chassis, 1000000);
    c.wheel = makeWheel(c.world, 0, 0, 0);
    giveWheelShape(c.wheel);
    c.joint = join(c.world, c.chassis, c.wheel, 0, 0, 0);
    MdtBodySetAngularVelocity(c.chassis, 0, 1, 0);
    MdtBodySetAngularVelocity(c.wheel, 0, 1, 30);
    for (int n = 0; n < 600; n++) {
        MdtWorldStep(c.world, FRAME);
        assert_near(MdtCarWheelGetSteeringAngle(c.joint), 0, TOL(1e-6, 2e-7));
    }
}
