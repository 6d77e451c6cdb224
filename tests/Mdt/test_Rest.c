/* Partitions, and putting them to rest (Dynamics guide ch. 1 and 4). */
#include "scene.h"

START_TEST(constraints_join_bodies_and_the_world_joins_nothing) {
    MdtWorldID w = scene_world(5, 4, 0);
    MdtBodyID b[5];
    for (int i = 0; i < 5; i++)
        b[i] = scene_body(w, 1, i, 0, 0);
    const int pairs[][2] = {{0, 3}, {1, -1}, {2, -1}, {3, 4}};
    for (int i = 0; i < 4; i++) {
        MdtBSJointID j = MdtBSJointCreate(w);
        MdtBSJointSetBodies(j, b[pairs[i][0]], pairs[i][1] < 0 ? 0 : b[pairs[i][1]]);
        MdtBSJointEnable(j);
    }
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(MdtBodyGetPartition(b[0]), 0);
    ck_assert_int_eq(MdtBodyGetPartition(b[1]), 1);
    ck_assert_int_eq(MdtBodyGetPartition(b[2]), 2);
    ck_assert_int_eq(MdtBodyGetPartition(b[3]), 0);
    ck_assert_int_eq(MdtBodyGetPartition(b[4]), 0);
    MdtWorldDestroy(w);
}
END_TEST

START_TEST(an_enabled_body_wakes_what_is_tied_to_it) {
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
    MdtWorldDestroy(w);
}
END_TEST

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

START_TEST(a_resting_body_is_disabled_after_the_alive_window) {
    for (int way = 0; way < 2; way++) {
        const MdtBodyID b = restingForFiveSteps(way);
        const int steps = stepsUntilDisabled(b);
        ck_assert_msg(steps >= 6 && steps <= 7, "disabled in step %d", steps);
        ck_assert_int_eq(MdtWorldGetEnabledBodies(MdtBodyGetWorld(b)), 0);
        assert_near(MdtBodyGetEnabledTime(b), 0, 0);
        MdtWorldDestroy(MdtBodyGetWorld(b));
    }
}
END_TEST

/* As by a program that pulls at it, with forces that it can still bear; and then no more. */
START_TEST(a_body_that_is_enabled_before_each_step_stays_awake) {
    for (int way = 0; way < 2; way++) {
        const MdtBodyID b = restingForFiveSteps(way);
        for (int i = 0; i < 100; i++) {
            MdtBodyEnable(b);
            MdtWorldStep(MdtBodyGetWorld(b), FRAME);
            ck_assert_msg(MdtBodyIsEnabled(b), "disabled in step %d", i);
        }
        const int steps = stepsUntilDisabled(b);
        ck_assert_msg(steps >= 5 && steps <= 6, "disabled %d steps later", steps);
        MdtWorldDestroy(MdtBodyGetWorld(b));
    }
}
END_TEST

/* It has rested for almost as long as it takes; then the program takes it elsewhere, where nothing holds it. */
/* What creeps below the thresholds when it is put to rest stands: for the solver, and for who reads by a getter or a
 * pointer. */
START_TEST(a_body_that_rests_shows_no_velocity) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    const MeReal *const shown[2] = {MdtBodyGetLinearVelocityPtr(b), MdtBodyGetAngularVelocityPtr(b)};
    MdtWorldSetAutoDisable(w, 1);
    MdtBodySetLinearVelocity(b, (MeReal)1e-4, (MeReal)-2e-4, (MeReal)3e-4);
    MdtBodySetAngularVelocity(b, (MeReal)3e-4, (MeReal)2e-4, (MeReal)-1e-4);
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
    MdtWorldDestroy(w);
}
END_TEST

START_TEST(a_body_that_is_put_elsewhere_is_not_at_rest) {
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
    MdtWorldDestroy(w);
}
END_TEST

START_TEST(auto_disable_can_be_switched_off) {
    MdtWorldID w = scene_world(1, 1, 10);
    MdtBodyID b = restingBody(w);
    steps(w, 100, FRAME);
    ck_assert(MdtBodyIsEnabled(b));
    assert_near(MdtBodyGetEnabledTime(b), 100 * (double)FRAME, TOL(1e-5, 2e-8));
    MdtWorldDestroy(w);
}
END_TEST

/* All four values must be below their thresholds, which are squares. Pushes are to and fro: what gains speed moves. */
START_TEST(each_threshold_keeps_a_body_awake) {
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
                const MeReal push = i % 2 ? -x : x;
                if (what == 2)
                    MdtBodyAddForce(b, 0, 0, push);
                if (what == 3)
                    MdtBodyAddTorque(b, push * (MeReal).4, 0, 0);
                MdtWorldStep(w, FRAME);
                if (!MdtBodyIsEnabled(b))
                    break;
            }
            ck_assert_msg(MdtBodyIsEnabled(b) == above, "threshold %d, above %d", what, above);
            MdtWorldDestroy(w);
        }
}
END_TEST

START_TEST(a_partition_rests_as_a_whole) {
    MdtWorldID w = scene_world(2, 3, 10);
    MdtBodyID a = restingBody(w), b = scene_body(w, 1, 1, 0, 0);
    MdtBSJointID j = MdtBSJointCreate(w); /* b swings from a */
    MdtBSJointSetBodies(j, a, b);
    MdtBSJointSetPosition(j, 0, 0, 0);
    MdtBSJointEnable(j);
    MdtWorldSetAutoDisable(w, 1);
    steps(w, 60, FRAME);
    ck_assert(MdtBodyIsEnabled(a) && MdtBodyIsEnabled(b));
    MdtWorldDestroy(w);
}
END_TEST

static MdtBodyID sleeper(MdtWorldID w) {
    MdtBodyID b = restingBody(w);
    MdtWorldSetAutoDisable(w, 1);
    steps(w, 30, FRAME);
    ck_assert(!MdtBodyIsEnabled(b));
    return b;
}

START_TEST(setters_forces_and_enabling_wake_a_sleeper) {
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
        MdtWorldDestroy(w);
    }
}
END_TEST

/* A force too small to move the body faster than the thresholds waits (Dynamics guide ch. 4: thresholds of force and
 * torque; the User Guide says that no force wakes a body). */
START_TEST(a_slight_force_does_not_wake_a_sleeper) {
    MdtWorldID w = scene_world(1, 1, 10);
    MdtBodyID b = sleeper(w);
    MeVector3 v;
    MdtBodyAddForce(b, (MeReal).5, 0, 0); /* 0.5² < 0.5 */
    MdtWorldStep(w, FRAME);
    ck_assert(!MdtBodyIsEnabled(b));
    MdtBodyGetForce(b, v);
    assert_vec3_near(v, .5, 0, 0, 0);
    MdtWorldDestroy(w);
}
END_TEST

START_TEST(a_body_that_the_program_disabled_stays_so) {
    MdtWorldID w = scene_world(1, 1, 10);
    MdtBodyID b = restingBody(w);
    MdtBodyDisable(b);
    MdtBodyAddForce(b, 500, 0, 0);
    MdtBodySetLinearVelocity(b, 3, 0, 0);
    MdtWorldStep(w, FRAME);
    ck_assert(!MdtBodyIsEnabled(b));
    MdtWorldDestroy(w);
}
END_TEST

/* Whichever axis is the slim one: the torque that is too much is that about it. */
START_TEST(a_slight_torque_wakes_a_slim_sleeper) {
    const MeReal threshold = (MeReal).25, slim = (MeReal).125; /* the square of 1/2 rad/s^2 */
    for (int axis = 0; axis < 3; axis++)
        for (int tooMuch = 0; tooMuch < 2; tooMuch++) {
            MdtWorldID w = scene_world(1, 0, 0);
            MdtBodyID b = scene_body(w, 1, 0, 0, 0);
            MeMatrix3 inertia = {{2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
            inertia[axis][axis] = slim;
            MdtBodySetInertiaTensor(b, inertia);
            MdtWorldSetAutoDisable(w, 1);
            MdtWorldSetAutoDisableAngularAccelerationThreshold(w, threshold);
            for (int i = 0; i < 100 && MdtBodyIsEnabled(b); i++)
                MdtWorldStep(w, FRAME);
            ck_assert(!MdtBodyIsEnabled(b));
            const MeReal torque = slim / 2 * (MeReal)(tooMuch ? 1.01 : .99);
            MdtBodyAddTorque(b, axis == 0 ? torque : 0, axis == 1 ? torque : 0, axis == 2 ? torque : 0);
            MdtWorldStep(w, FRAME);
            ck_assert_int_eq(MdtBodyIsEnabled(b) != 0, tooMuch);
            MdtWorldDestroy(w);
        }
}
END_TEST

START_TEST(a_contact_with_a_moving_body_wakes_a_sleeper) {
    MdtWorldID w = scene_world(2, 3, 10);
    MdtBodyID b = sleeper(w), mover = scene_body(w, 1, 0, 1, 0);
    MdtWorldStep(w, FRAME);
    ck_assert(!MdtBodyIsEnabled(b));
    MdtContactID c = MdtContactCreate(w, mover, b);
    MdtContactEnable(c);
    MdtWorldStep(w, FRAME);
    ck_assert(MdtBodyIsEnabled(b));
    MdtWorldDestroy(w);
}
END_TEST

/* Pushed to and fro, or always one way, harder than the threshold of accelerations. */
static int stepsAwake(MdtWorldID w, MdtBodyID b, MeBool toAndFro) {
    int i = 0;
    for (; i < 100 && MdtBodyIsEnabled(b); i++) {
        MdtBodyAddForce(b, (MeReal)(toAndFro && i % 2 ? -1.2 : 1.2), 0, 0);
        MdtWorldStep(w, FRAME);
    }
    return i;
}

START_TEST(what_trembles_is_put_to_rest_and_what_starts_is_not) {
    for (int toAndFro = 0; toAndFro < 2; toAndFro++) {
        MdtWorldID w = scene_world(1, 1, 0);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MdtWorldSetAutoDisable(w, 1);
        const int steps = stepsAwake(w, b, toAndFro);
        if (toAndFro)
            ck_assert_msg(30 <= steps && steps <= 33, "asleep after %d steps", steps);
        else
            ck_assert_int_eq(steps, 100);
        MdtWorldDestroy(w);
    }
}
END_TEST

/* Below all thresholds, a body that is pushed gently gains speed all the same. */
START_TEST(what_begins_to_move_slowly_stays_awake) {
    const double pushes[] = {.01, .1, .6};
    for (int i = 0; i < 3; i++) {
        MdtWorldID w = scene_world(1, 1, 0);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MeVector3 v;
        MdtWorldSetAutoDisable(w, 1);
        for (int step = 0; step < 300; step++) {
            MdtBodyAddForce(b, (MeReal)pushes[i], 0, 0);
            MdtWorldStep(w, FRAME);
        }
        MdtBodyGetLinearVelocity(b, v);
        assert_near(v[0], pushes[i] * 300 * FRAME, TOL(1e-6, 1e-14) * 5);
        MdtWorldDestroy(w);
    }
}
END_TEST

/* .02 m/s²: after 5 s it is still slower than the threshold. */
START_TEST(what_begins_to_move_has_twenty_five_alive_times) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    int steps = 0;
    MdtWorldSetAutoDisable(w, 1);
    for (; MdtBodyIsEnabled(b) && steps < 1000; steps++) {
        MdtBodyAddForce(b, (MeReal).02, 0, 0);
        MdtWorldStep(w, FRAME);
    }
    ck_assert_int_ge(steps, 295);
    ck_assert_int_le(steps, 310);
    MdtWorldDestroy(w);
}
END_TEST

/* Two that swing a quarter of a period apart, slower than the thresholds, with a rod's length between them that no
 * spring holds: one of them gains at any time, and yet they sleep: the second after its first gain, which begins a
 * quarter of a period after the other's and lasts one. */
START_TEST(what_swings_slowly_is_put_to_rest) {
    MdtWorldID w = scene_world(2, 3, 0);
    MdtBodyID b[2] = {scene_body(w, 1, (MeReal).03, 0, 0), scene_body(w, 1, 0, 1, 0)};
    const double quarter = ME_PI / 2 / MeSqrt((MeReal)10); /* s, of 1 kg on the spring's 10 N/m */
    MdtWorldSetAutoDisable(w, 1);
    for (int i = 0; i < 3; i++) {
        MdtSpringID s = MdtSpringCreate(w);
        MdtSpringSetBodies(s, b[i % 2], i < 2 ? 0 : b[1]);
        MdtSpringSetPosition(s, 0, i < 2 ? 0 : (MeReal).03, i == 1, 0);
        MdtSpringSetPosition(s, 1, i < 2 ? -1 : 0, i != 0, 0);
        MdtSpringSetNaturalLength(s, 1);
        MdtSpringSetStiffness(s, i < 2 ? 10 : 0);
        MdtSpringSetDamping(s, 0);
        MdtSpringEnable(s);
    }
    MdtBodySetLinearVelocity(b[1], (MeReal)(.03 * sqrt(10)), 0, 0);
    double t = 0;
    while (MdtBodyIsEnabled(b[0]) && t < 8 * quarter) {
        MdtWorldStep(w, FRAME);
        t += FRAME;
    }
    ck_assert_msg(t < 2.1 * quarter, "asleep after %g quarters", t / quarter);
    MdtWorldDestroy(w);
}
END_TEST

/* A belt that is slower than the threshold (.1 m/s) carries on what is young; once asleep, it stood still. */
START_TEST(a_surface_that_moves_keeps_awake_what_it_carries) {
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
            MdtContactParamsSetPrimarySlide(MdtContactGetParams(c), (MeReal)speed);
        if (way == 2)
            MdtConstraintSetWorldLinearVelocity(MdtContactQuaConstraint(c), (MeReal)speed, 0, 0);
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
        MdtWorldDestroy(w);
    }
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, a_surface_that_moves_keeps_awake_what_it_carries);
    tcase_add_test(t, what_begins_to_move_slowly_stays_awake);
    tcase_add_test(t, what_begins_to_move_has_twenty_five_alive_times);
    tcase_add_test(t, what_swings_slowly_is_put_to_rest);
    tcase_add_test(t, what_trembles_is_put_to_rest_and_what_starts_is_not);
    tcase_add_test(t, constraints_join_bodies_and_the_world_joins_nothing);
    tcase_add_test(t, an_enabled_body_wakes_what_is_tied_to_it);
    tcase_add_test(t, a_resting_body_is_disabled_after_the_alive_window);
    tcase_add_test(t, a_body_that_is_enabled_before_each_step_stays_awake);
    tcase_add_test(t, a_body_that_rests_shows_no_velocity);
    tcase_add_test(t, a_body_that_is_put_elsewhere_is_not_at_rest);
    tcase_add_test(t, auto_disable_can_be_switched_off);
    tcase_add_test(t, each_threshold_keeps_a_body_awake);
    tcase_add_test(t, a_partition_rests_as_a_whole);
    tcase_add_test(t, setters_forces_and_enabling_wake_a_sleeper);
    tcase_add_test(t, a_slight_force_does_not_wake_a_sleeper);
    tcase_add_test(t, a_slight_torque_wakes_a_slim_sleeper);
    tcase_add_test(t, a_body_that_the_program_disabled_stays_so);
    tcase_add_test(t, a_contact_with_a_moving_body_wakes_a_sleeper);
}

TEST_MAIN("Rest", tests)
