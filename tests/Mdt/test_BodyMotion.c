/* What a body has of its own in how it moves: its gravity factor, its speed caps. By either solver. */
#include "scene.h"

static const double gravity = 9.8;

enum { SOLVERS = 3 };

static MdtWorldID open(int solver) {
    MdtWorldID w = scene_world(4, 16, gravity);
    MdtWorldSetSolver(w, (MdtSolver)solver);
    return w;
}

static double heightOf(MdtBodyID b) {
    MeVector3 x;
    MdtBodyGetPosition(b, x);
    return (double)x[1];
}

static double speedOf(MdtBodyID b) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(b, v);
    return (double)MeVector3Magnitude(v);
}

static double spinOf(MdtBodyID b) {
    MeVector3 w;
    MdtBodyGetAngularVelocity(b, w);
    return (double)MeVector3Magnitude(w);
}

/* ---- gravity factor ---- */

LOOP_TEST(a_body_falls_by_its_part_of_gravity, 0, SOLVERS) {
    static const double factors[] = {0, 1, -1, .25, 3};
    static const int rates[] = {30, 240};
    for (int k = 0; k < 5; k++)
        for (int r = 0; r < 2; r++) {
            MdtWorldID w = open(_i);
            MdtBodyID b = scene_body(w, 5, 0, 1, 0);
            MdtBodySetGravityFactor(b, (MeReal)factors[k]);
            ck_assert(MdtBodyGetGravityFactor(b) == (MeReal)factors[k]);
            for (int i = 0; i < rates[r]; i++)
                MdtWorldStep(w, (MeReal)(1. / rates[r]));
            assert_near(heightOf(b), 1 - gravity * factors[k] / 2, TOL(1e-5, 1e-13));
            assert_near(speedOf(b), fabs(gravity * factors[k]), TOL(1e-4, 1e-12));
        }
}

/* Of a sleeper too, which wakes. */
LOOP_TEST(a_joint_carries_the_weight_of_the_factor, 0, SOLVERS) {
    static const double factors[] = {1, 4, 0, -.5};
    MdtWorldID w = open(_i);
    MdtBodyID b = scene_body(w, 2, 0, 0, 0);
    MdtBSJointID j = scene_ball(w, b, NULL, 0, 0, 0);
    MeVector3 f;
    MdtWorldSetAutoDisable(w, 1);
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < 90; i++)
            MdtWorldStep(w, FRAME);
        ck_assert(!MdtBodyIsEnabled(b));
        MdtBodySetGravityFactor(b, (MeReal)factors[k]);
        MdtWorldStep(w, FRAME);
        ck_assert(k == 0 || MdtBodyIsEnabled(b));
        for (int i = 0; i < 19; i++)
            MdtWorldStep(w, FRAME);
        MdtBSJointGetForce(j, 0, f);
        assert_vec3_near(f, 0, 2 * gravity * factors[k], 0, 1e-3);
    }
}

TEST(a_report_counts_the_energy_of_the_factor) {
    MdtWorldID w = open(1);
    MdtBodyID b = scene_body(w, 2, 0, 3, 0);
    MdtReport r;
    MdtBodySetGravityFactor(b, (MeReal)-2.5);
    MdtWorldEnableReport(w);
    for (int i = 0; i < 30; i++) {
        MdtWorldStep(w, FRAME);
        ck_assert(MdtWorldGetReport(w, &r));
        assert_near(r.kineticEnergy + r.potentialEnergy, -2 * -2.5 * -gravity * 3, TOL(1e-4, 1e-11));
    }
}

/* ---- speed caps ---- */

/* At the cap a step of the midpoint rule moves the body by h (v + g h / 2). */
LOOP_TEST(a_falling_body_keeps_to_its_cap, 0, SOLVERS) {
    static const double caps[] = {.5, 3, 50}, steps[] = {1. / 30, 1. / 240};
    for (int k = 0; k < 3; k++)
        for (int s = 0; s < 2; s++) {
            MdtWorldID w = open(_i);
            MdtBodyID b = scene_body(w, 3, 0, 0, 0);
            const double h = steps[s];
            MdtBodySetLinearVelocity(b, 0, (MeReal)(-2 * caps[k]), 0);
            MdtBodySetMaxLinearSpeed(b, (MeReal)caps[k]);
            ck_assert(MdtBodyGetMaxLinearSpeed(b) == (MeReal)caps[k]);
            MdtWorldStep(w, (MeReal)h);
            for (int i = 0; i < 30; i++) {
                const double before = heightOf(b);
                assert_near(speedOf(b), caps[k], TOL(1e-5, 1e-13) * caps[k]);
                MdtWorldStep(w, (MeReal)h);
                assert_near(before - heightOf(b), h * (caps[k] + gravity * h / 2), TOL(1e-5, 1e-12));
            }
        }
}

LOOP_TEST(a_body_that_is_turned_keeps_to_its_cap, 0, SOLVERS) {
    static const double edge[3] = {1, 2, 3};
    MdtWorldID w = open(_i);
    MdtBodyID b = scene_box(w, 3, edge, 0, 0, 0);
    double fastest = 0;
    MdtBodySetGravityFactor(b, 0);
    MdtBodySetMaxAngularSpeed(b, 4);
    MdtBodySetLinearVelocity(b, 30, 0, 0);
    for (int i = 0; i < 200; i++) {
        MdtBodyAddTorque(b, 10, 5, -7);
        MdtWorldStep(w, FRAME);
        fastest = fmax(fastest, spinOf(b));
        assert_near(speedOf(b), 30, TOL(1e-5, 1e-13));
    }
    assert_near(fastest, 4, TOL(1e-6, 1e-14));
    MdtBodySetMaxAngularSpeed(b, MEINFINITY);
    for (int i = 0; i < 60; i++) {
        MdtBodyAddTorque(b, 10, 5, -7);
        MdtWorldStep(w, FRAME);
    }
    ck_assert(spinOf(b) > 5);
}

LOOP_TEST(a_pendulum_keeps_to_its_cap_and_its_length, 0, SOLVERS) {
    MdtWorldID w = open(_i);
    MdtBodyID b = scene_body(w, 3, 2, 0, 0);
    MeVector3 x;
    double fastest = 0;
    scene_ball(w, b, NULL, 0, 0, 0);
    MdtBodySetMaxLinearSpeed(b, 2);
    for (int i = 0; i < 120; i++) {
        MdtWorldStep(w, FRAME);
        MdtBodyGetPosition(b, x);
        fastest = fmax(fastest, speedOf(b));
        assert_near(MeVector3Magnitude(x), 2, 1e-4);
    }
    assert_near(fastest, 2, TOL(1e-6, 1e-14));
}

/* ---- all of them ---- */

TEST(they_are_copied_and_reset) {
    MdtWorldID w = open(0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    ck_assert(MdtBodyGetGravityFactor(b) == 1);
    ck_assert(MdtBodyGetMaxLinearSpeed(b) == MEINFINITY && MdtBodyGetMaxAngularSpeed(b) == MEINFINITY);
    MdtBodySetGravityFactor(b, 2);
    MdtBodySetMaxLinearSpeed(b, 3);
    MdtBodySetMaxAngularSpeed(b, 0);
    MdtBodyID copy = MdtBodyCopy(b, w);
    ck_assert(MdtBodyGetGravityFactor(copy) == 2);
    ck_assert(MdtBodyGetMaxLinearSpeed(copy) == 3 && MdtBodyGetMaxAngularSpeed(copy) == 0);
    MdtBodyReset(copy);
    ck_assert(MdtBodyGetGravityFactor(copy) == 1 && MdtBodyGetMaxLinearSpeed(copy) == MEINFINITY);
}

TEST(bad_numbers_change_nothing) {
    MdtWorldID w = open(0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    assert_refused(MdtBodySetGravityFactor, b, NAN);
    assert_refused(MdtBodySetGravityFactor, b, INFINITY);
    assert_refused(MdtBodySetMaxLinearSpeed, b, -1);
    assert_refused(MdtBodySetMaxAngularSpeed, b, NAN);
    ck_assert(MdtBodyGetGravityFactor(b) == 1);
    ck_assert(MdtBodyGetMaxLinearSpeed(b) == MEINFINITY && MdtBodyGetMaxAngularSpeed(b) == MEINFINITY);
}
