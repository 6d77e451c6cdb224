/* Bodies that nothing touches: falling, damping, momentum, tumbling. */
#include "measure.h"

/* Free flight takes the mean of the velocities: exact under a constant force, whatever the step. */
TEST(free_fall_is_the_closed_form_to_rounding) {
    const double steplengths[] = {1.0 / 30, 1.0 / 60, 1e-3};
    for (int k = 0; k < 3; k++) {
        const MeReal h = steplengths[k], g = (MeReal)9.8;
        const int n = 600;
        MdtWorldID w = scene_world(1, 0, 9.8);
        MdtBodyID b = scene_body(w, 3, 0, 10, 0);
        MeVector3 p, v;
        steps(w, n, h);
        MdtBodyGetPosition(b, p);
        MdtBodyGetLinearVelocity(b, v);
        const double fallen = .5 * (double)g * pow((double)h * n, 2);
        assert_near_rel(v[1], -(double)g * h * n, TOL(1e-7, 1e-13));
        assert_near_rel((double)p[1] - 10, -fallen, TOL(1e-6, 1e-13));
        ck_assert(p[0] == 0 && p[2] == 0);
    }
}

/* With damping d the velocity is the exact solution of dv/dt = g - d v at every step:
 * v_n = v∞ + (v_0 - v∞) r^n with r = exp(-d h), and x_n = h sum of the means (v_0 + v_1)/2..(v_n-1 + v_n)/2. */
TEST(damped_projectile_follows_the_exponential) {
    const MeReal h = FRAME, g = (MeReal)9.8, d = (MeReal)0.7;
    const int n = 300;
    MdtWorldID w = scene_world(1, 0, 9.8);
    MdtBodyID b = scene_body(w, 2, 0, 0, 0);
    MdtBodySetLinearVelocity(b, 4, 6, 0);
    MdtBodySetLinearVelocityDamping(b, d);
    steps(w, n, h);
    MeVector3 p, v;
    MdtBodyGetPosition(b, p);
    MdtBodyGetLinearVelocity(b, v);
    const double r = exp(-(double)d * h), rn = pow(r, n), sum = .5 * (1 + r) * (1 - rn) / (1 - r);
    const double limit = -(double)g / d;
    assert_near(v[0], 4 * rn, TOL(2e-7, 2e-14));
    assert_near(v[1], limit + (6 - limit) * rn, TOL(3e-6, 1e-12));
    assert_near(p[0], h * 4 * sum, TOL(2e-6, 5e-13));
    assert_near(p[1], h * (n * limit + (6 - limit) * sum), TOL(2e-5, 4e-12));
}

TEST(angular_damping_slows_a_spin_by_the_exponential) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtBodySetAngularVelocity(b, 0, 3, 0);
    MdtBodySetAngularVelocityDamping(b, .5);
    steps(w, 120, FRAME);
    MeVector3 v;
    MdtBodyGetAngularVelocity(b, v);
    assert_near(v[1], 3 * exp(-.5 * 120 * (double)FRAME), TOL(1e-6, 1e-13));
}

TEST(a_free_body_keeps_its_momenta) {
    const double edge[3] = {1, .6, .2};
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_box(w, 2, edge, 1, 2, 3);
    MdtBodySetQuaternion(b, .8, .2, -.5, .1);
    MdtBodySetLinearVelocity(b, 1, -2, .5);
    MdtBodySetAngularVelocity(b, 3, -4, 2);
    double p[2][3], L[2][3];
    measure_momentum(b, p[0], L[0]);
    steps(w, 600, FRAME);
    measure_momentum(b, p[1], L[1]);
    for (int i = 0; i < 3; i++) {
        assert_near(p[1][i], p[0][i], TOL(2e-4, 1e-11));
        assert_near(L[1][i], L[0][i], TOL(2e-4, 1e-11));
    }
}

/* What an impulse gives a body as a step begins is not among what the step adds. */
TEST(an_impulse_is_no_acceleration) {
    const double edge[3] = {1, 1, 1};
    MeVector3 acceleration, spin;
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_box(w, 1, edge, 0, 0, 0);
    MdtBodyAddImpulseAtPosition(b, 1, 0, 0, 0, .5, 0);
    MdtWorldStep(w, FRAME);
    MdtBodyGetAngularVelocity(b, spin);
    assert_near(spin[2], -3, TOL(1e-6, 1e-14));
    MdtBodyGetLinearAcceleration(b, acceleration);
    assert_near(MeVector3Magnitude(acceleration), 0, 1e-12);
    MdtBodyGetAngularAcceleration(b, acceleration);
    assert_near(MeVector3Magnitude(acceleration), 0, 1e-12);
}

/* Any inertia tensor may be set in a frame that is not its own. */
TEST(a_tilted_tensor_moves_like_a_tilted_body) {
    const double edge[3] = {1, .6, .2};
    MdtWorldID w = scene_world(2, 0, 0);
    MdtBodyID plain = scene_box(w, 1, edge, 0, 0, 0), tilted = scene_body(w, 1, 5, 0, 0);
    const MeReal c = .8, s = (MeReal).6; /* about z */
    MeMatrix3 I, tensor;
    MdtBodyGetInertiaTensor(plain, I);
    const MeMatrix3 T = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            tensor[i][j] = T[i][0] * I[0][0] * T[j][0] + T[i][1] * I[1][1] * T[j][1] + T[i][2] * I[2][2] * T[j][2];
    MdtBodySetInertiaTensor(tilted, tensor);
    MdtBodySetOrientation(plain, T);
    MdtBodySetAngularVelocity(plain, 1, 4, 2);
    MdtBodySetAngularVelocity(tilted, 1, 4, 2);
    for (int i = 0; i < 120; i++) {
        MeVector3 a, b;
        MdtWorldStep(w, FRAME);
        MdtBodyGetAngularVelocity(plain, a);
        MdtBodyGetAngularVelocity(tilted, b);
        assert_vec3_near(b, a[0], a[1], a[2], TOL(5e-6, 5e-13));
    }
}

/* A rotation of more than a turn per step is no matter for a body that spins about its own axis. */
TEST(fast_spin_is_exact) {
    const double edge[3] = {1, .2, 1};
    const MeReal rate = 400;
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_box(w, 1, edge, 0, 0, 0);
    MdtBodySetAngularVelocity(b, 0, rate, 0);
    MdtBodySetFastSpinAxis(b, 0, 1, 0);
    steps(w, 60, FRAME);
    MeVector4 q;
    MdtBodyGetQuaternion(b, q);
    const double half = .5 * (double)rate * 60 * (double)FRAME;
    assert_near(fabs(q[0]), fabs(cos(half)), TOL(5e-7, 6e-13));
    assert_near(q[1], 0, 9e-14);
}

TEST(spherical_inertia_and_no_coriolis_keep_the_angular_velocity) {
    const double edge[3] = {1, .6, .2};
    for (int way = 0; way < 2; way++) {
        MdtWorldID w = scene_world(1, 0, 0);
        MdtBodyID b = scene_box(w, 1, edge, 0, 0, 0);
        MdtBodySetAngularVelocity(b, 1, 2, 3);
        if (way == 0)
            MdtBodyDisableNonSphericalInertia(b);
        else
            MdtBodyDisableCoriolisForce(b);
        steps(w, 300, FRAME);
        MeVector3 v;
        MdtBodyGetAngularVelocity(b, v);
        assert_vec3_near(v, 1, 2, 3, TOL(3e-6, 1e-12));
    }
}

/* v = F h / m for a force, I / m for an impulse, however long the step; a force lasts for one step. */
TEST(forces_last_a_step_and_impulses_do_not_depend_on_it) {
    const MeReal h[] = {.1, .001};
    for (int k = 0; k < 2; k++) {
        MdtWorldID w = scene_world(2, 0, 0);
        MdtBodyID pushed = scene_body(w, 2, 0, 0, 0), hit = scene_body(w, 2, 0, 5, 0);
        MdtBodyAddForce(pushed, 3, 0, 0);
        MdtBodyAddForce(pushed, 0, 5, 0);
        MdtBodyAddTorque(pushed, 0, 0, .2);
        MdtBodyAddImpulse(hit, 0, 0, 4);
        steps(w, 3, h[k]);
        MeVector3 v;
        MdtBodyGetLinearVelocity(pushed, v);
        assert_vec3_near(v, 1.5 * (double)h[k], 2.5 * (double)h[k], 0, TOL(1e-7, 9e-14));
        MdtBodyGetAngularVelocity(pushed, v);
        assert_vec3_near(v, 0, 0, .5 * (double)h[k], TOL(1e-7, 9e-14)); /* 0.2 / 0.4 */
        MdtBodyGetLinearVelocity(hit, v);
        assert_vec3_near(v, 0, 0, 2, TOL(1e-7, 2e-13));
        MdtBodyGetForce(pushed, v);
        assert_vec3_near(v, 0, 0, 0, 0);
    }
}

/* A force beside the centre of mass also turns: torque (P - x) × F. */
TEST(force_at_a_position_adds_its_torque) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 1, 1, 1, 1);
    MdtBodyAddForceAtPosition(b, 0, 0, 2, 4, 1, 1);
    MeVector3 t;
    MdtBodyGetTorque(b, t);
    assert_vec3_near(t, 0, -6, 0, TOL(1e-6, 6e-13));
    MdtBodyResetForces(b);
    MdtBodyGetTorque(b, t);
    assert_vec3_near(t, 0, 0, 0, 0);
}

/* A long body on a ball-and-socket joint, of the size 1 and 2^-10: its moments are 1 and 1e-15 kg m2 then, and it is no
 * sphere for that. Powers of two round alike, so that all motion is the same to the last digits. */
TEST(a_body_tumbles_alike_at_any_scale) {
    MeVector3 p[2], spin[2];
    for (int k = 0; k < 2; k++) {
        const double size = k ? 1. / 1024 : 1, mass = size * size * size;
        const double edge[3] = {2 * size, size, .5 * size};
        MdtWorldID w = MdtWorldCreate(1, 1, size, mass);
        MdtWorldSetAutoDisable(w, 0);
        MdtWorldSetEpsilon(w, 0);
        MdtWorldSetGravity(w, 0, -10 * size, 0);
        MdtBodyID b = scene_box(w, mass, edge, size, 0, 0);
        scene_ball(w, b, 0, 0, 0, 0);
        MdtBodySetAngularVelocity(b, 1, 2, 3);
        MdtBodySetLinearVelocity(b, 0, 3 * size, -2 * size);
        steps(w, 120, FRAME);
        MdtBodyGetPosition(b, p[k]);
        MdtBodyGetAngularVelocity(b, spin[k]);
        for (int i = 0; i < 3; i++)
            p[k][i] /= (MeReal)size;
        MdtWorldDestroy(w);
    }
    for (int i = 0; i < 3; i++) {
        assert_near(p[1][i], p[0][i], TOL(1e-6, 1e-11));
        assert_near(spin[1][i], spin[0][i], TOL(1e-5, 1e-10));
    }
}
