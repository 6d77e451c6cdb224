/* Axes of the world along which bodies do not move, or about which they do not turn: exactly, while all else goes on as
 * it would. By either solver. */
#include "scene.h"

static const double gravity = 9.8;

enum { SOLVERS = 3, AXES = 6, ALL = MdtLockTranslation | MdtLockRotation };

static MdtWorldID open(int solver) {
    MdtWorldID w = scene_world(16, 64, gravity);
    MdtWorldSetSolver(w, (MdtSolver)solver);
    return w;
}

static double at(MdtBodyID b, int k) {
    MeVector3 x;
    MdtBodyGetPosition(b, x);
    return (double)x[k];
}

/* A component of the velocity, or of the angular velocity. */
static double speed(MdtBodyID b, int axis) {
    MeVector3 v[2];
    MdtBodyGetLinearVelocity(b, v[0]);
    MdtBodyGetAngularVelocity(b, v[1]);
    return (double)v[axis / 3][axis % 3];
}

static double turned(MdtBodyID b, int k) {
    MeVector4 q;
    MdtBodyGetQuaternion(b, q);
    return (double)q[k];
}

static double energyOf(MdtBodyID b) {
    return (double)MdtBodyGetKineticEnergy(b) + (double)MdtBodyGetMass(b) * gravity * at(b, 1);
}

static void askew(MdtBodyID b) {
    MdtBodySetQuaternion(b, (MeReal).6, (MeReal).3, (MeReal)-.5, (MeReal).4);
}

/* ---- without constraints ---- */

static MdtBodyID ball(MdtWorldID w, int axes) {
    const MdtBodyID b = scene_body(w, 2, .5, -.25, .125);
    MdtBodySetSphericalInertiaTensor(b, (MeReal).7);
    MdtBodySetLockedAxes(b, axes);
    return b;
}

static void push(MdtBodyID b, int step) {
    MdtBodyAddForce(b, 3, -2, 5);
    MdtBodyAddTorque(b, (MeReal).1, (MeReal).3, (MeReal)-.2);
    if (step == 7)
        MdtBodyAddImpulse(b, 1, 2, 3);
    if (step == 9)
        MdtBodySetAngularVelocity(b, 1, -1, 2);
    if (step == 11) {
        MeReal *v = MdtBodyGetLinearVelocityPtr(b);
        v[0] = 3, v[1] = -1, v[2] = 1;
    }
}

/* A ball's free axes do not feel the locked ones. */
LOOP_TEST(locked_axes_stay_and_others_go_on, 0, ALL + 1) {
    static const double start[3] = {.5, -.25, .125};
    MdtWorldID w = open(_i % SOLVERS);
    const MdtBodyID b = ball(w, _i), other = ball(w, MdtLockNone);
    ck_assert_int_eq(MdtBodyGetLockedAxes(b), _i);
    for (int step = 0; step < 60; step++) {
        push(b, step);
        push(other, step);
        MdtWorldStep(w, FRAME);
        for (int k = 0; k < AXES; k++) {
            const MeBool isLocked = _i >> k & 1;
            assert_near(speed(b, k), isLocked ? 0 : speed(other, k), isLocked || k < 3 ? 0 : TOL(1e-5, 1e-13));
            if (k < 3)
                assert_near(at(b, k), isLocked ? start[k] : at(other, k), 0);
        }
        for (int k = 0; k < 4 && _i >> 3 == 7; k++)
            assert_near(turned(b, k), k == 0, 0);
    }
}

/* A box that lies askew: what turns it about one free axis is the moment about that axis alone. */
LOOP_TEST(one_free_rotation_has_the_moment_about_its_axis, 0, 3) {
    static const double edge[3] = {.5, 1, 2};
    MdtWorldID w = open(0);
    const MdtBodyID b = scene_box(w, 3, edge, 0, 0, 0);
    MeMatrix3 I, R;
    double moment = 0;
    askew(b);
    MdtBodyGetInertiaTensor(b, I);
    MdtBodyGetOrientation(b, R);
    for (int k = 0; k < 3; k++)
        moment += (double)I[k][k] * (double)R[_i][k] * (double)R[_i][k];
    MdtBodySetLockedAxes(b, ALL & ~(MdtLockRotationX << _i));
    for (int i = 0; i < 120; i++) {
        MdtBodyAddTorque(b, 1, 1, 1);
        MdtWorldStep(w, FRAME);
    }
    for (int k = 0; k < 3; k++)
        assert_near(speed(b, 3 + k), k == _i ? 2 / moment : 0, k == _i ? TOL(1e-6, 1e-13) : 0);
    assert_near(MdtBodyGetKineticEnergy(b), 2 / moment, TOL(1e-6, 1e-13));
}

/* A box between two free rotations, after 4 s without loads. Its energy, J; angle: a number of its attitude. */
static double spinBetweenTwo(double h, double *angle) {
    static const double edge[3] = {.5, 1, 2};
    MdtWorldID w = open(0);
    const MdtBodyID b = scene_box(w, 3, edge, 0, 0, 0);
    MdtWorldSetGravity(w, 0, 0, 0);
    askew(b);
    MdtBodySetLockedAxes(b, MdtLockRotationZ);
    MdtBodySetAngularVelocity(b, 2, 3, 4);
    for (int i = 0; i < (int)(4 / h + .5); i++) {
        MdtWorldStep(w, (MeReal)h);
        assert_near(speed(b, 5), 0, 0);
    }
    *angle = turned(b, 0);
    return (double)MdtBodyGetKineticEnergy(b);
}

/* The moments between two free rotations turn with the body, and its angular momentum about them stays: of second order
 * in the step. .500397558 and 2.39169836 J are the limit. */
TEST(two_free_rotations_keep_their_energy_and_momentum) {
    double angle[2];
    const double energy[2] = {spinBetweenTwo(1. / 60, &angle[0]), spinBetweenTwo(1. / 120, &angle[1])};
    for (int k = 0; k < 2; k++) {
        const double h2 = k == 0 ? 1 : .25;
        assert_near(energy[k], 2.39169836 + h2 * 8.94e-5, TOL(1e-5, 1e-5));
        assert_near(angle[k], .500397558 - h2 * 2.555e-4, TOL(1e-5, 1e-5));
    }
}

LOOP_TEST(an_impulse_off_centre_moves_a_point_mass, 0, SOLVERS) {
    MdtWorldID w = open(_i);
    const MdtBodyID b = ball(w, MdtLockRotation);
    MdtWorldSetGravity(w, 0, 0, 0);
    MdtBodyAddImpulseAtPosition(b, 1, 2, 3, 7, -8, 9);
    for (int i = 0; i < 10; i++)
        MdtWorldStep(w, FRAME);
    for (int k = 0; k < AXES; k++)
        assert_near(speed(b, k), k < 3 ? .5 * (k + 1) : 0, 0);
}

/* ---- joints ---- */

/* A chain whose bodies ball joints and locks keep in a plane, beside one on hinges; of one bar, a pendulum. */
LOOP_TEST(ball_joints_in_a_plane_are_hinges, 0, 2 * SOLVERS) {
    static const double edge[3] = {.3, 1, .2};
    const int bars = _i < SOLVERS ? 1 : 3;
    MdtWorldID w = open(_i % SOLVERS);
    MdtBodyID bar[2][3];
    for (int i = 0; i < bars; i++) {
        for (int k = 0; k < 2; k++)
            bar[k][i] = scene_box(w, 2, edge, .5 + i, 0, 4 * k);
        MdtBodySetLockedAxes(bar[0][i], MdtLockToPlaneXY);
        scene_ball(w, bar[0][i], i > 0 ? bar[0][i - 1] : NULL, i, 0, 0);
        scene_hinge(w, bar[1][i], i > 0 ? bar[1][i - 1] : NULL, i, 0, 4, 0, 0, 1);
    }
    /* a chain only until it whips, where steps are no longer small */
    for (int step = 0; step < (bars == 1 ? 600 : 30); step++) {
        double energy = 0;
        MdtWorldStep(w, FRAME);
        for (int i = 0; i < bars; i++) {
            energy += energyOf(bar[0][i]);
            for (int k = 0; k < 2; k++)
                assert_near(at(bar[0][i], k), at(bar[1][i], k), TOL(2e-6, bars == 1 ? 1e-8 : 1e-9));
            assert_near(at(bar[0][i], 2), 0, 0);
            assert_near(fabs(turned(bar[0][i], 1)) + fabs(turned(bar[0][i], 2)), 0, 0);
        }
        if (bars == 1)
            assert_near(energy, 0, 5e-3); /* of the midpoint rule, at 19.6 J */
    }
}

/* A hinge in a direction that is locked welds: its rows and the locks ask for the same. */
LOOP_TEST(joints_across_locks_hold, 0, SOLVERS) {
    static const double edge[3] = {.3, 1, .2};
    static const double axis[][3] = {{1, 0, 0}, {0, 0, 1}, {.6, 0, .8}, {.48, .6, .64}};
    for (int k = 0; k < 4; k++) {
        MdtWorldID w = open(_i);
        const MdtBodyID b = scene_box(w, 2, edge, .5, 0, 0);
        MdtBodySetLockedAxes(b, MdtLockToPlaneXY);
        scene_hinge(w, b, NULL, 0, 0, 0, axis[k][0], axis[k][1], axis[k][2]);
        for (int i = 0; i < 300; i++)
            MdtWorldStep(w, FRAME);
        assert_near(at(b, 2), 0, 0);
        if (k == 1)
            assert_near(hypot(at(b, 0), at(b, 1)), .5, 1e-6);
        else /* epsilon lets it sag */
            assert_near(fabs(at(b, 0) - .5) + fabs(at(b, 1)), 0, 1e-3);
    }
}

/* What is locked carries: the joint need not. */
LOOP_TEST(a_lock_carries_a_weight, 0, SOLVERS) {
    MdtWorldID w = open(_i);
    const MdtBodyID b = scene_body(w, 2, 0, 0, 0);
    const MdtBSJointID j = scene_ball(w, b, NULL, 0, 0, 0);
    MeVector3 f;
    MdtBodySetLockedAxes(b, MdtLockTranslationY);
    for (int i = 0; i < 60; i++)
        MdtWorldStep(w, FRAME);
    MdtBSJointGetForce(j, 0, f);
    assert_vec3_near(f, 0, 0, 0, 1e-9);
    assert_near(at(b, 1), 0, 0);
}

/* ---- the property ---- */

TEST(a_lock_stops_and_lets_go) {
    static const double edge[3] = {.5, 1, 2};
    MdtWorldID w = open(0);
    const MdtBodyID b = scene_box(w, 3, edge, 0, 0, 0), never = scene_box(w, 3, edge, 0, 0, 0);
    for (int k = 0; k < 2; k++) {
        askew(k ? never : b);
        MdtBodySetLinearVelocity(k ? never : b, 1, 2, 3);
        MdtBodySetAngularVelocity(k ? never : b, 1, 2, 3);
    }
    MdtBodySetLockedAxes(b, MdtLockTranslationX | MdtLockRotationY | MdtLockRotationZ);
    for (int k = 0; k < AXES; k++)
        assert_near(speed(b, k), k == 1 ? 2 : k == 2 ? 3 : k == 3 ? 1 : 0, TOL(1e-6, 1e-14));
    MdtBodySetLockedAxes(b, MdtLockNone);
    MdtBodySetLinearVelocity(b, 1, 2, 3);
    MdtBodySetAngularVelocity(b, 1, 2, 3);
    for (int i = 0; i < 60; i++)
        MdtWorldStep(w, FRAME);
    for (int k = 0; k < AXES; k++)
        assert_near(speed(b, k), speed(never, k), 0); /* as if it had never been locked */
}

LOOP_TEST(a_lock_wakes_a_sleeper, 0, 2) {
    MdtWorldID w = open(0);
    const MdtBodyID b = scene_body(w, 2, 0, 0, 0);
    scene_ball(w, b, NULL, 0, 0, 0);
    MdtWorldSetAutoDisable(w, 1);
    for (int i = 0; i < 300 && MdtBodyIsEnabled(b); i++)
        MdtWorldStep(w, FRAME);
    ck_assert(!MdtBodyIsEnabled(b));
    MdtBodySetLockedAxes(b, _i == 0 ? MdtLockNone : MdtLockRotation); /* one that changes nothing does not */
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(MdtBodyIsEnabled(b), _i);
}

TEST(a_kinematic_body_has_no_locks_until_it_is_free_again) {
    const MeVector3 place = {1, 2, 3};
    const MeVector4 quarter = {(MeReal).70710678, 0, (MeReal).70710678, 0};
    MdtWorldID w = open(0);
    const MdtBodyID b = scene_body(w, 2, 0, 0, 0);
    MdtBodySetLockedAxes(b, ALL);
    MdtBodySetKinematic(b, METRUE);
    MdtBodyMoveTo(b, place, quarter);
    MdtWorldStep(w, FRAME);
    for (int k = 0; k < 3; k++)
        assert_near(at(b, k), place[k], TOL(1e-6, 1e-14));
    assert_near(turned(b, 2), .70710678, 1e-6);
    MdtBodySetKinematic(b, MEFALSE);
    for (int i = 0; i < 30; i++)
        MdtWorldStep(w, FRAME);
    for (int k = 0; k < 3; k++)
        assert_near(at(b, k), place[k], TOL(1e-6, 1e-14));
    ck_assert_int_eq(MdtBodyGetLockedAxes(b), ALL);
}

TEST(locks_are_copied_and_reset) {
    MdtWorldID w = open(0);
    const MdtBodyID b = ball(w, MdtLockToPlaneXY), copy = MdtBodyCopy(b, w);
    ck_assert_int_eq(MdtBodyGetLockedAxes(copy), MdtLockToPlaneXY);
    MdtBodySetLinearVelocity(copy, 1, 1, 1);
    assert_near(speed(copy, 2), 0, 0);
    MdtBodyReset(copy);
    ck_assert_int_eq(MdtBodyGetLockedAxes(copy), MdtLockNone);
    MdtBodySetLinearVelocity(copy, 1, 1, 1);
    assert_near(speed(copy, 2), 1, 0);
}

TEST(no_sum_of_axes_is_refused) {
    MdtWorldID w = open(0);
    const MdtBodyID b = ball(w, MdtLockRotation);
    assert_refused(MdtBodySetLockedAxes, b, -1);
    assert_refused(MdtBodySetLockedAxes, b, ALL + 1);
    assert_refused(MdtBodySetLockedAxes, NULL, 0);
    assert_none(MdtBodyGetLockedAxes, NULL);
    ck_assert_int_eq(MdtBodyGetLockedAxes(b), MdtLockRotation);
}
