/* The angular joint: an orientation is kept, the place is free; Angular2 with a free rotation; and the angular spring.
 * */
#include "measure.h"

static const double edge[3] = {.5, .8, .3};

/* The largest difference of two rotations' entries. */
static double difference(const double A[3][3], const double B[3][3]) {
    double worst = 0;
    for (int n = 0; n < 9; n++)
        worst = fmax(worst, fabs(A[n / 3][n % 3] - B[n / 3][n % 3]));
    return worst;
}

static void relativeRotation(MdtBodyID a, MdtBodyID b, double M[3][3]) {
    double A[3][3], B[3][3];
    measure_rotation(a, A);
    measure_rotation(b, B);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            M[i][j] = B[0][i] * A[0][j] + B[1][i] * A[1][j] + B[2][i] * A[2][j];
}

static void shove(MdtBodyID b, Random *r) {
    double f[3], t[3];
    random_vector(r, 5, f);
    random_vector(r, 2, t);
    add_force(b, f);
    add_torque(b, t);
}

/* As the bodies stand when they are attached, whatever happened before and whatever axis is set later. */
TEST(the_orientation_at_attaching_is_kept) {
    for (int variant = 0; variant < 4; variant++) {
        MdtWorldID w = scene_world(2, 1, 0);
        MdtWorldSetEpsilon(w, 0);
        MdtBodyID a = scene_box(w, 2, edge, 0, 0, 0), b = variant % 2 == 0 ? scene_box(w, 1, edge, 1, 1, 0) : NULL;
        MdtAngular3ID j = MdtAngular3Create(w);
        Random random = {5};
        double start[3][3], now[3][3], p[3];
        MdtBodySetQuaternion(a, .3, .5, -.7, .4);
        if (b)
            MdtBodySetQuaternion(b, -.4, .6, .1, .7);
        MdtAngular3SetBodies(j, a, b);
        if (variant >= 2)
            MdtAngular3SetAxis(j, 1, 2, -1);
        MdtAngular3Enable(j);
        relativeRotation(a, b, start);
        for (int i = 0; i < 200; i++) {
            shove(a, &random);
            MdtWorldStep(w, FRAME);
            relativeRotation(a, b, now);
            assert_below(difference((const double(*)[3])now, (const double(*)[3])start), TOL(2e-6, 1e-8));
        }
        measure_position(a, p);
        ck_assert(keaLength(p) > .1); /* it goes where it likes */
    }
}

/* Attached, turned out of that, then given an axis: they turn back to how they were attached. */
TEST(an_axis_that_is_set_elsewhere_leaves_the_orientation) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtBodyID a = scene_box(w, 2, edge, 0, 0, 0), b = scene_box(w, 1, edge, 1, 1, 0);
    MdtAngular3ID j = MdtAngular3Create(w);
    double start[3][3], now[3][3];
    MdtWorldSetEpsilon(w, 0);
    MdtBodySetQuaternion(a, .3, .5, -.7, .4);
    MdtAngular3SetBodies(j, a, b);
    relativeRotation(a, b, start);
    MdtBodySetQuaternion(a, .4, .6, -.6, .2);
    relativeRotation(a, b, now);
    ck_assert(difference((const double(*)[3])now, (const double(*)[3])start) > .1);
    MdtAngular3SetAxis(j, 1, 2, -1);
    MdtAngular3Enable(j);
    steps(w, 300, FRAME);
    relativeRotation(a, b, now);
    assert_below(difference((const double(*)[3])now, (const double(*)[3])start), TOL(2e-6, 1e-8));
}

/* Two bodies that are held turn as one about the pair's moments; their places do not know of one another. */
TEST(it_gives_no_force) {
    MdtWorldID w = scene_world(2, 1, 10);
    MdtBodyID a = scene_box(w, 2, edge, 0, 0, 0), b = scene_box(w, 1, edge, 1, 1, 0);
    MdtAngular3ID j = MdtAngular3Create(w);
    double f[3], p[3], rate[3], other[3];
    MdtAngular3SetBodies(j, a, b);
    MdtAngular3Enable(j);
    MdtBodySetSphericalInertiaTensor(a, .2);
    MdtBodySetSphericalInertiaTensor(b, .3);
    for (int i = 0; i < 60; i++) {
        MdtBodyAddForce(a, 2, 0, 0);
        MdtBodyAddTorque(b, 0, 0, 1);
        MdtWorldStep(w, FRAME);
        read_force(MdtAngular3QuaConstraint(j), 0, f);
        assert_vec3_near(f, 0, 0, 0, 0);
    }
    measure_position(a, p);
    assert_near(p[0], .5, TOL(1e-6, 5e-14)); /* exact under a constant force */
    measure_rate(a, rate);
    measure_rate(b, other);
    assert_vec3_near(rate, 0, 0, 1 / .5, TOL(2e-6, 4e-10)); /* 1 N m for 1 s on 0.2 + 0.3 */
    assert_vec3_near(other, 0, 0, 1 / .5, TOL(2e-6, 3e-10));
}

/* Switched off again, it is drawn back to the orientation that is kept. */
TEST(rotation_disabled_again) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID b = scene_box(w, 2, edge, 0, 0, 0);
    MdtAngular3ID j = MdtAngular3Create(w);
    double R[3][3], start[3][3];
    measure_rotation(b, start);
    MdtAngular3SetBodies(j, b, 0);
    MdtAngular3SetAxis(j, 0, 0, 1);
    MdtAngular3EnableRotation(j, 1);
    MdtAngular3Enable(j);
    MdtBodySetAngularVelocity(b, 0, 0, 1);
    steps(w, 60, FRAME);
    measure_rotation(b, R);
    assert_near(atan2(R[1][0], R[0][0]), 60 * midpoint_turn(1, FRAME), TOL(1e-6, 9e-14));
    MdtAngular3EnableRotation(j, 0);
    steps(w, 200, FRAME);
    measure_rotation(b, R);
    assert_below(difference((const double(*)[3])R, (const double(*)[3])start), TOL(1e-6, 1e-7));
}

/* I θ'' = -k θ - c θ'. About an axis across the free one, and without a free one about any. */
TEST(the_angular_spring_swings) {
    const double ks[] = {5, 20}, cs[] = {0, .1}, inertia = .4, h = FRAME, amplitude = .02;
    for (int rotates = 0; rotates < 2; rotates++)
        for (int i = 0; i < 4; i++) {
            const double k = ks[i / 2], c = cs[i % 2];
            MdtWorldID w = scene_world(1, 1, 0);
            MdtBodyID b = scene_body(w, 1, 0, 0, 0);
            MdtAngular3ID j = MdtAngular3Create(w);
            Swing swing = {0};
            MdtBodySetSphericalInertiaTensor(b, inertia);
            MdtAngular3SetBodies(j, b, 0);
            MdtAngular3SetAxis(j, 0, 1, 0);
            MdtAngular3EnableRotation(j, rotates);
            MdtAngular3SetStiffness(j, k);
            MdtAngular3SetDamping(j, c);
            MdtAngular3Enable(j);
            MdtBodySetQuaternion(b, cos(amplitude / 2), 0, 0, sin(amplitude / 2));
            const double w0 = sqrt(k / inertia), decay = c / (2 * inertia);
            for (int n = 0; n < 3000 && swing.crossings < 11; n++) {
                double x[3] = {1, 0, 0}, axis[3];
                MdtWorldStep(w, FRAME);
                measure_turnOut(b, x, axis);
                swing_add(&swing, atan2(axis[1], axis[0]));
            }
            ck_assert_int_eq(swing.crossings, 11);
            swing_check(&swing, w0, decay, h, TOL(2e-5, 2e-7));
        }
}

/* T = -k θ however far it is turned, θ in the middle of the step: θ + h w/4 with w = h T/I at its end. About
 * an axis across the free one, and without a free one about any. */
TEST(the_angular_spring_is_linear_in_the_angle) {
    for (int rotates = 0; rotates < 2; rotates++)
        for (int degrees = 30; degrees <= 150; degrees += 30) {
            const double angle = degrees * 3.14159265358979323846 / 180, inertia = .4, h = 1e-3;
            MdtWorldID w = scene_world(1, 1, 0);
            MdtBodyID b = scene_body(w, 1, 0, 0, 0);
            MdtAngular3ID j = MdtAngular3Create(w);
            double t[3];
            MdtAngular3SetBodies(j, b, 0);
            MdtAngular3SetAxis(j, 0, 1, 0);
            MdtAngular3EnableRotation(j, rotates);
            MdtAngular3SetStiffness(j, 2);
            MdtAngular3SetDamping(j, 0);
            MdtAngular3Enable(j);
            MdtBodySetSphericalInertiaTensor(b, inertia);
            MdtBodySetQuaternion(b, cos(angle / 2), 0, 0, sin(angle / 2));
            MdtWorldStep(w, h);
            read_torque(MdtAngular3QuaConstraint(j), 0, t);
            assert_vec3_near(t, 0, 0, -2 * angle / (1 + 2 * h * h / (4 * inertia)), TOL(5e-6, 5e-13));
        }
}

/* One infinite value is enough: rigid. */
TEST(as_long_as_one_value_is_infinite_it_is_rigid) {
    for (int which = 0; which < 2; which++) {
        MdtWorldID w = scene_world(1, 1, 0);
        MdtWorldSetEpsilon(w, 0);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MdtAngular3ID j = MdtAngular3Create(w);
        double R[3][3];
        MdtAngular3SetBodies(j, b, 0);
        if (which == 0)
            MdtAngular3SetStiffness(j, 1);
        else
            MdtAngular3SetDamping(j, 1);
        MdtAngular3Enable(j);
        for (int i = 0; i < 60; i++) {
            MdtBodyAddTorque(b, 5, 5, 5);
            MdtWorldStep(w, FRAME);
        }
        measure_rotation(b, R);
        assert_near(R[0][0] + R[1][1] + R[2][2], 3, TOL(1e-6, 3e-13));
    }
}
