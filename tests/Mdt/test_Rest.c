/* Partitions, and putting them to rest (Dynamics guide ch. 1 and 4). */
#include "scene.h"

TEST(an_enabled_body_wakes_what_is_tied_to_it) {
    MdtWorldID w = scene_world(3, 2, 10);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0), b = MdtBodyCreate(w), loose = MdtBodyCreate(w);
    MdtBSJointID j = MdtBSJointCreate(w);
    MdtBSJointSetBodies(j, a, b);
    MdtWorldStep(w, FRAME);
    ck_assert(!MdtBodyIsEnabled(b)); /* the joint is not enabled */
    MdtBSJointEnable(j);
    MdtWorldStep(w, FRAME);
    ck_assert(MdtBodyIsEnabled(b) && !MdtBodyIsEnabled(loose));
    ck_assert_int_eq(MdtWorldGetEnabledBodies(w), 2);
}

/* A body on a floor, by a contact that stays as it is. */
static MdtBodyID restingBody(MdtWorldID w) {
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtContactID c = MdtContactCreate(w, b, 0);
    MdtContactParamsSetType(MdtContactGetParams(c), MdtContactTypeFriction2D);
    MdtContactEnable(c);
    return b;
}

/* In a world of its own, in which bodies stay awake for five steps: by their number, or by their time. */
static MdtBodyID restingForFiveSteps(int way) {
    const MdtWorldID w = scene_world(1, 1, 10);
    MdtWorldSetAutoDisable(w, 1);
    if (way == 0)
        MdtWorldSetAutoDisableAliveWindow(w, 5);
    else
        MdtWorldSetAutoDisableAliveTime(w, 5 * FRAME);
    return restingBody(w);
}

static int stepsUntilDisabled(MdtBodyID b) {
    int steps = 0;
    for (; MdtBodyIsEnabled(b) && steps < 100; steps++)
        MdtWorldStep(MdtBodyGetWorld(b), FRAME);
    return steps;
}

TEST(a_resting_body_is_disabled_after_the_alive_window) {
    for (int way = 0; way < 2; way++) {
        const MdtBodyID b = restingForFiveSteps(way);
        const int steps = stepsUntilDisabled(b);
        ck_assert_msg(steps >= 6 && steps <= 7, "disabled in step %d", steps);
        ck_assert_int_eq(MdtWorldGetEnabledBodies(MdtBodyGetWorld(b)), 0);
        assert_near(MdtBodyGetEnabledTime(b), 0, 0);
    }
}

/* As by a program that pulls at it, with forces that it can still bear; and then no more. */
TEST(a_body_that_is_enabled_before_each_step_stays_awake) {
    for (int way = 0; way < 2; way++) {
        const MdtBodyID b = restingForFiveSteps(way);
        for (int i = 0; i < 100; i++) {
            MdtBodyEnable(b);
            MdtWorldStep(MdtBodyGetWorld(b), FRAME);
            ck_assert_msg(MdtBodyIsEnabled(b), "disabled in step %d", i);
        }
        const int steps = stepsUntilDisabled(b);
        ck_assert_msg(steps >= 5 && steps <= 6, "disabled %d steps later", steps);
    }
}

/* It has rested for almost as long as it takes; then the program takes it elsewhere, where nothing holds it. */
/* What creeps below the thresholds when it is put to rest stands: for the solver, and for who reads by a getter or a
 * pointer. */
TEST(a_body_that_rests_shows_no_velocity) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    const MeReal *const shown[2] = {MdtBodyGetLinearVelocityPtr(b), MdtBodyGetAngularVelocityPtr(b)};
    MdtWorldSetAutoDisable(w, 1);
    MdtBodySetLinearVelocity(b, 1e-4, -2e-4, 3e-4);
    MdtBodySetAngularVelocity(b, 3e-4, 2e-4, -1e-4);
    for (int i = 0; i < 600 && MdtBodyIsEnabled(b); i++) {
        assert_vec3_near(shown[0], 1e-4, -2e-4, 3e-4, 1e-10);
        assert_vec3_near(shown[1], 3e-4, 2e-4, -1e-4, 1e-10);
        MdtWorldStep(w, FRAME);
    }
    ck_assert(!MdtBodyIsEnabled(b));
    MeVector3 v[2];
    MdtBodyGetLinearVelocity(b, v[0]);
    MdtBodyGetAngularVelocity(b, v[1]);
    for (int k = 0; k < 2; k++) {
        assert_vec3_near(v[k], 0, 0, 0, 0);
        assert_vec3_near(shown[k], 0, 0, 0, 0);
    }
}

TEST(a_body_that_is_put_elsewhere_is_not_at_rest) {
    MdtWorldID w = scene_world(1, 1, 10);
    MdtWorldSetAutoDisable(w, 1);
    MdtWorldSetAutoDisableAliveWindow(w, 10);
    MdtBodyID b = restingBody(w);
    MeVector3 p;
    for (int i = 0; i < 10; i++)
        MdtWorldStep(w, FRAME);
    ck_assert(MdtBodyIsEnabled(b));
    MdtBodyDestroyConstraints(b);
    MdtBodySetPosition(b, 0, 5, 0);
    for (int i = 0; i < 60; i++)
        MdtWorldStep(w, FRAME);
    MdtBodyGetPosition(b, p);
    assert_near(p[1], 0, 2e-3);
}

TEST(auto_disable_can_be_switched_off) {
    MdtWorldID w = scene_world(1, 1, 10);
    MdtBodyID b = restingBody(w);
    steps(w, 100, FRAME);
    ck_assert(MdtBodyIsEnabled(b));
    assert_near(MdtBodyGetEnabledTime(b), 100 * (double)FRAME, TOL(1e-5, 2e-8));
}

/* All four values must be below their thresholds, which are squares: accelerations, and their changes. */
TEST(each_threshold_keeps_a_body_awake) {
    for (int what = 0; what < 4; what++)
        for (int above = 0; above < 2; above++) {
            MdtWorldID w = scene_world(1, 0, 0);
            MdtBodyID b = scene_body(w, 1, 0, 0, 0);
            MdtWorldSetAutoDisable(w, 1);
            MdtWorldSetAutoDisableVelocityThreshold(w, what == 0 ? (MeReal)4 : 1000);
            MdtWorldSetAutoDisableAngularVelocityThreshold(w, what == 1 ? (MeReal)4 : 1000);
            MdtWorldSetAutoDisableAccelerationThreshold(w, what == 2 ? (MeReal)4 : 1000);
            MdtWorldSetAutoDisableAngularAccelerationThreshold(w, what == 3 ? (MeReal)4 : 1000);
            const MeReal x = above ? (MeReal)2.1 : (MeReal)1.9;
            if (what == 0)
                MdtBodySetLinearVelocity(b, x, 0, 0);
            if (what == 1)
                MdtBodySetAngularVelocity(b, 0, x, 0);
            for (int i = 0; i < 30; i++) {
                const MeReal push = i % 2 ? 0 : x;
                if (what == 2)
                    MdtBodyAddForce(b, 0, 0, push);
                if (what == 3)
                    MdtBodyAddTorque(b, push * (MeReal).4, 0, 0);
                MdtWorldStep(w, FRAME);
                if (!MdtBodyIsEnabled(b))
                    break;
            }
            ck_assert_msg(MdtBodyIsEnabled(b) == above, "threshold %d, above %d", what, above);
        }
}

TEST(a_partition_rests_as_a_whole) {
    MdtWorldID w = scene_world(2, 3, 10);
    MdtBodyID a = restingBody(w), b = scene_body(w, 1, 1, 0, 0);
    MdtBSJointID j = MdtBSJointCreate(w); /* b swings from a */
    MdtBSJointSetBodies(j, a, b);
    MdtBSJointSetPosition(j, 0, 0, 0);
    MdtBSJointEnable(j);
    MdtWorldSetAutoDisable(w, 1);
    steps(w, 60, FRAME);
    ck_assert(MdtBodyIsEnabled(a) && MdtBodyIsEnabled(b));
}

static MdtBodyID sleeper(MdtWorldID w) {
    MdtBodyID b = restingBody(w);
    MdtWorldSetAutoDisable(w, 1);
    steps(w, 30, FRAME);
    ck_assert(!MdtBodyIsEnabled(b));
    return b;
}

TEST(setters_forces_and_enabling_wake_a_sleeper) {
    for (int way = 0; way < 8; way++) {
        MdtWorldID w = scene_world(2, 3, 10);
        MdtBodyID b = sleeper(w);
        MeVector3 v;
        switch (way) {
        case 0:
            MdtBodySetPosition(b, 0, 1, 0);
            break;
        case 1:
            MdtBodySetQuaternion(b, 1, 1, 0, 0);
            break;
        case 2:
            MdtBodySetLinearVelocity(b, 1, 0, 0);
            break;
        case 3:
            MdtBodySetAngularVelocity(b, 1, 0, 0);
            break;
        case 4:
            MdtBodyAddForce(b, 5, 0, 0);
            break;
        case 5:
            MdtBodyAddTorque(b, 0, 5, 0);
            break;
        case 6:
            MdtBodyAddImpulse(b, 1, 0, 0);
            break;
        case 7:
            MdtBodyGetLinearVelocityPtr(b)[0] = 1;
            break;
        }
        MdtWorldStep(w, FRAME);
        ck_assert_msg(MdtBodyIsEnabled(b), "way %d", way);
        MdtBodyGetForce(b, v);
        assert_vec3_near(v, 0, 0, 0, 0);
    }
}

/* A box of 1 kg whose radius of gyration is .63 m is woken by what gives it 1.6 cm/s, at once or in steps that follow
 * each other. What does not is over with its step, as what a body at rest bears. */
TEST(a_slight_push_is_over_with_its_step_and_one_that_goes_on_wakes) {
    for (int way = 0; way < 3; way++) {
        MdtWorldID w = scene_world(1, 1, 10);
        MdtBodyID b = sleeper(w);
        MeVector3 v;
        int steps = 0;
        for (; !MdtBodyIsEnabled(b) && steps < 100; steps++) {
            if (way < 2 || steps % 2)
                MdtBodyAddForce(b, way == 1 ? (MeReal)1.2 : (MeReal).5, 0, 0);
            MdtWorldStep(w, FRAME);
            MdtBodyGetForce(b, v);
            assert_vec3_near(v, 0, 0, 0, 0);
        }
        ck_assert_int_eq(steps, way == 0 ? 2 : way == 1 ? 1 : 100);
        MdtBodyGetPosition(b, v);
        assert_near(v[0], 0, TOL(1e-6, 1e-12));
    }
}

/* The force under which it fell asleep is what it rests under: it wakes when that ends, or grows. */
TEST(a_force_under_which_it_rests_does_not_wake_it_and_its_end_does) {
    for (int way = 0; way < 2; way++) {
        MdtWorldID w = scene_world(1, 0, 10);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MeVector3 p;
        MdtWorldSetAutoDisable(w, 1);
        for (int i = 0; i < 600; i++) {
            MdtBodyAddForce(b, 0, 10, 0);
            MdtWorldStep(w, FRAME);
            ck_assert(MdtBodyIsEnabled(b) || i > 10);
        }
        ck_assert(!MdtBodyIsEnabled(b));
        MdtBodyGetPosition(b, p);
        assert_vec3_near(p, 0, 0, 0, 0);
        for (int i = 0; i < 60; i++) {
            if (way)
                MdtBodyAddForce(b, 0, 11, 0);
            MdtWorldStep(w, FRAME);
        }
        MdtBodyGetLinearVelocity(b, p);
        /* it goes on, and so grows within the step before */
        assert_near(p[1], way ? 1 + FRAME / 2 : -10, TOL(2e-5, 1e-9));
    }
}

/* Both hover by forces of the program; one is pushed, and wakes the other, whose force acts in that step, too. */
TEST(a_force_acts_on_what_its_neighbour_wakes) {
    MdtWorldID w = scene_world(2, 1, 10);
    MdtBodyID b[2] = {scene_body(w, 1, 0, 0, 0), scene_body(w, 1, 1, 0, 0)};
    MdtBSJointID j = MdtBSJointCreate(w);
    MeVector3 v;
    MdtBSJointSetBodies(j, b[0], b[1]);
    MdtBSJointSetPosition(j, .5, 0, 0);
    MdtBSJointEnable(j);
    MdtWorldSetAutoDisable(w, 1);
    for (int i = 0; i < 62; i++) {
        for (int k = 0; k < 2; k++)
            MdtBodyAddForce(b[k], 0, 10, 0);
        if (i == 60)
            ck_assert(!MdtBodyIsEnabled(b[0]) && !MdtBodyIsEnabled(b[1]));
        if (i == 60)
            MdtBodySetLinearVelocity(b[0], 0, 0, 1);
        MdtWorldStep(w, FRAME);
    }
    for (int k = 0; k < 2; k++) {
        ck_assert(MdtBodyIsEnabled(b[k]));
        MdtBodyGetLinearVelocity(b[k], v);
        assert_near(v[1], 0, TOL(1e-5, 1e-9));
    }
}

/* Whichever step it begins in: also that in which the body would fall asleep. */
TEST(a_force_that_begins_while_it_falls_asleep_moves_it) {
    for (int way = 0; way < 2; way++)
        for (int first = 0; first < 30; first++) {
            MdtWorldID w = scene_world(1, 0, 0);
            MdtBodyID b = scene_body(w, 1, 0, 0, 0);
            MeVector3 v;
            MdtWorldSetAutoDisable(w, 1);
            if (way)
                MdtWorldSetAutoDisableAccelerationThreshold(w, .5);
            for (int i = 0; i < first + 30; i++) {
                if (i >= first)
                    MdtBodyAddForce(b, 0, 60, 0);
                MdtWorldStep(w, FRAME);
            }
            MdtBodyGetLinearVelocity(b, v);
            assert_near(v[1], 30, TOL(1e-4, 1e-9));
        }
}

/* What falls asleep at once is woken as ever. */
TEST(a_push_wakes_without_an_alive_time) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MeVector3 v;
    MdtWorldSetAutoDisable(w, 1);
    MdtWorldSetAutoDisableAliveTime(w, 0);
    steps(w, 3, FRAME);
    ck_assert(!MdtBodyIsEnabled(b));
    MdtBodyAddForce(b, 0, 60, 0);
    MdtWorldStep(w, FRAME);
    MdtBodyGetLinearVelocity(b, v);
    assert_near(v[1], 1, TOL(1e-6, 1e-12));
}

/* On a body that the program has disabled, first or second. */
TEST(a_motor_wakes_what_hangs_on_a_disabled_body) {
    for (int side = 0; side < 2; side++) {
        MdtWorldID w = scene_world(2, 1, 0);
        MdtBodyID fixed = scene_body(w, 1, 0, 0, 0), b = scene_body(w, 1, 1, 0, 0);
        MdtHingeID j = MdtHingeCreate(w);
        MeVector3 v;
        MdtHingeSetBodies(j, side ? b : fixed, side ? fixed : b);
        MdtHingeSetPosition(j, 1, 0, 0);
        MdtHingeSetAxis(j, 0, 1, 0);
        MdtHingeEnable(j);
        MdtBodyDisable(fixed);
        MdtWorldSetAutoDisable(w, 1);
        steps(w, 60, FRAME);
        ck_assert(!MdtBodyIsEnabled(b));
        MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(j), 1, 100);
        steps(w, 3, FRAME);
        MdtBodyGetAngularVelocity(b, v);
        ck_assert(MdtBodyIsEnabled(b) && fabs(v[1]) > .5); /* it turns the other, too */
    }
}

TEST(a_body_that_the_program_disabled_stays_so) {
    MdtWorldID w = scene_world(1, 1, 10);
    MdtBodyID b = restingBody(w);
    MdtBodyDisable(b);
    MdtBodyAddForce(b, 500, 0, 0);
    MdtBodySetLinearVelocity(b, 3, 0, 0);
    MdtWorldStep(w, FRAME);
    ck_assert(!MdtBodyIsEnabled(b));
}

/* Whichever axis is the slim one: the torque that is too much is that about it. */
TEST(a_slight_torque_wakes_a_slim_sleeper) {
    const double slim = .125, rate = 2.5e-2; /* rad/s: what wakes it turns it so fast in a step */
    for (int axis = 0; axis < 3; axis++)
        for (int tooMuch = 0; tooMuch < 2; tooMuch++) {
            MdtWorldID w = scene_world(1, 0, 0);
            MdtBodyID b = scene_body(w, 1, 0, 0, 0);
            MeMatrix3 inertia = {{2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
            inertia[axis][axis] = (MeReal)slim;
            MdtBodySetInertiaTensor(b, inertia);
            MdtWorldSetAutoDisable(w, 1);
            for (int i = 0; i < 100 && MdtBodyIsEnabled(b); i++)
                MdtWorldStep(w, FRAME);
            ck_assert(!MdtBodyIsEnabled(b));
            const MeReal torque = slim * rate * 60 * (tooMuch ? 1.01 : .99);
            MdtBodyAddTorque(b, axis == 0 ? torque : 0, axis == 1 ? torque : 0, axis == 2 ? torque : 0);
            MdtWorldStep(w, FRAME);
            ck_assert_int_eq(MdtBodyIsEnabled(b) != 0, tooMuch);
        }
}

TEST(a_contact_with_a_moving_body_wakes_a_sleeper) {
    MdtWorldID w = scene_world(2, 3, 10);
    MdtBodyID b = sleeper(w), mover = scene_body(w, 1, 0, 1, 0);
    MdtWorldStep(w, FRAME);
    ck_assert(!MdtBodyIsEnabled(b));
    MdtContactID c = MdtContactCreate(w, mover, b);
    MdtContactEnable(c);
    MdtWorldStep(w, FRAME);
    ck_assert(MdtBodyIsEnabled(b));
}

/* On a spring without damping. */
static MdtWorldID swing(double amplitude, double stiffness, double damping, MdtBodyID *b) {
    MdtWorldID w = scene_world(1, 1, 0);
    *b = scene_body(w, 1, amplitude, 0, 0);
    MdtSpringID s = MdtSpringCreate(w);
    MdtSpringSetBodies(s, *b, 0);
    MdtSpringSetPosition(s, 0, amplitude, 0, 0);
    MdtSpringSetPosition(s, 1, -1, 0, 0);
    MdtSpringSetNaturalLength(s, 1);
    MdtSpringSetStiffness(s, stiffness);
    MdtSpringSetDamping(s, damping);
    MdtSpringEnable(s);
    MdtWorldSetAutoDisable(w, 1);
    return w;
}

/* What trembles or swings by less than 2.5 % of its radius of gyration to either side, as its solver may make it, is at
 * rest after one second to twenty, at whatever acceleration. What swings by more stays awake, though it is slower than
 * the thresholds, and also where it turns. */
TEST(what_trembles_is_put_to_rest_and_what_swings_is_not) {
    const struct {
        double amplitude, stiffness;
        MeBool isAwake;
    } cases[] = {{5e-4, 2500, MEFALSE}, {7e-4, 10, MEFALSE}, {.015, 10, MEFALSE}, {.02, 10, METRUE}, {.03, 1, METRUE}};
    for (int i = 0; i < 5; i++) {
        MdtBodyID b;
        MdtWorldID w = swing(cases[i].amplitude, cases[i].stiffness, 0, &b);
        for (int step = 0; step < 59; step++)
            MdtWorldStep(w, FRAME);
        ck_assert(MdtBodyIsEnabled(b));
        for (int step = 0; step < 1500; step++)
            MdtWorldStep(w, FRAME);
        ck_assert_msg(!MdtBodyIsEnabled(b) == !cases[i].isAwake, "case %d", i);
    }
}

/* A spring that is damped a hundred times beyond critically, such as a door closer's, has moved for 20 s. */
TEST(what_creeps_to_its_balance_gets_there) {
    MdtBodyID b;
    MdtWorldID w = swing(.5, 10, 200, &b);
    MeVector3 p;
    for (int i = 0; i < 100 * 60; i++)
        MdtWorldStep(w, FRAME);
    MdtBodyGetPosition(b, p);
    assert_near(p[0], .5 * exp(-5), .03);
    for (int i = 0; i < 200 * 60; i++)
        MdtWorldStep(w, FRAME);
    ck_assert(!MdtBodyIsEnabled(b));
}

/* Below all thresholds, a body that is pushed gently gains speed all the same. */
TEST(what_begins_to_move_slowly_stays_awake) {
    const double pushes[] = {.01, .02, .1, .6};
    for (int i = 0; i < 4; i++) {
        MdtWorldID w = scene_world(1, 1, 0);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MeVector3 v;
        MdtWorldSetAutoDisable(w, 1);
        for (int step = 0; step < 1000; step++) {
            MdtBodyAddForce(b, pushes[i], 0, 0);
            MdtWorldStep(w, FRAME);
        }
        MdtBodyGetLinearVelocity(b, v);
        assert_near(v[0], pushes[i] * 1000 * FRAME, TOL(1e-5, 1e-13) * 5);
    }
}

/* So does what drifts, or turns, with nothing that would ever stop it. */
TEST(what_moves_uniformly_goes_on) {
    for (int turns = 0; turns < 2; turns++)
        for (double speed = .1; speed > 2e-3; speed /= 2) {
            MdtWorldID w = scene_world(1, 1, 0);
            MdtBodyID b = scene_body(w, 1, 0, 0, 0);
            MeVector3 v;
            MdtWorldSetAutoDisable(w, 1);
            if (turns)
                MdtBodySetAngularVelocity(b, 0, 0, speed / .6);
            else
                MdtBodySetLinearVelocity(b, speed, 0, 0);
            steps(w, 1200, FRAME);
            ck_assert_msg(MdtBodyIsEnabled(b), "asleep at %g m/s", speed);
            (turns ? MdtBodyGetAngularVelocity : MdtBodyGetLinearVelocity)(b, v);
            assert_near_rel(v[turns ? 2 : 0], turns ? speed / .6 : speed, TOL(1e-6, 1e-12));
        }
}

/* Motors, paths and worlds that move drive a body however slowly; a motor that is held by something does not. */
TEST(what_is_driven_stays_awake_at_any_speed) {
    double limit = 10; /* and others, which are rounded in various ways */
    for (int way = 0; way < 4; way++)
        for (double speed = .1; speed > 1e-6; speed /= 10, limit *= 1.7) {
            HingedBar s = scene_hingedBar(0);
            MdtFixedPathID path = 0;
            MdtWorldSetAutoDisable(s.world, 1);
            if (way < 2)
                MdtLimitSetLimitedForceMotor(s.limit, speed, limit);
            if (way == 1) { /* against its stop */
                MdtSingleLimitSetStop(MdtLimitGetLowerLimit(s.limit), -1);
                MdtSingleLimitSetStop(MdtLimitGetUpperLimit(s.limit), 0);
                MdtSingleLimitSetRestitution(MdtLimitGetUpperLimit(s.limit), 0);
                MdtLimitActivateLimits(s.limit, 1);
            }
            if (way == 2) {
                MdtHingeDestroy(s.hinge);
                path = MdtFixedPathCreate(s.world);
                MdtFixedPathSetBodies(path, s.bar, 0);
                MdtFixedPathEnable(path);
                MdtFixedPathSetVelocity(path, 1, speed, 0, 0);
            }
            if (way == 3)
                MdtConstraintSetWorldLinearVelocity(MdtHingeQuaConstraint(s.hinge), speed, 0, 0);
            steps(s.world, 300, FRAME);
            ck_assert_msg(!MdtBodyIsEnabled(s.bar) == (way == 1), "way %d, speed %g", way, speed);
        }
}

/* A belt that is slower than the threshold (.1 m/s) carries on what is young; once asleep, it stood still. */
TEST(a_surface_that_moves_keeps_awake_what_it_carries) {
    for (int way = 0; way < 3; way++) {
        const double speed = way ? .05 : 0;
        MeVector3 at;
        MdtWorldID w = scene_world(1, 1, 10);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MdtContactID c = MdtContactCreate(w, b, 0);
        MdtContactSetNormal(c, 0, 1, 0);
        MdtContactSetDirection(c, 1, 0, 0);
        MdtContactParamsSetSurface(MdtContactGetParams(c), 1, 0);
        if (way == 1)
            MdtContactParamsSetPrimarySlide(MdtContactGetParams(c), speed);
        if (way == 2)
            MdtConstraintSetWorldLinearVelocity(MdtContactQuaConstraint(c), speed, 0, 0);
        MdtContactEnable(c);
        MdtWorldSetAutoDisable(w, 1);
        for (int i = 0; i < 120; i++) {
            MdtWorldStep(w, FRAME);
            MdtBodyGetPosition(b, at);
            if (MdtBodyIsEnabled(b))
                MdtContactSetPosition(c, at[0], at[1], at[2]);
        }
        ck_assert_int_eq(MdtBodyIsEnabled(b), speed > 0);
        assert_near(at[0], 2 * speed, 1e-3);
    }
}
