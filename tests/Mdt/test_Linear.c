/* Linear1 and Linear2: a point of the first body in a plane, or on a line, of the second. */
#include "measure.h"

static const double g = 9.81;
static const double normal[3] = {.6, .8, 0};

static MdtLinear1ID plane(MdtWorldID w, MdtBodyID a, MdtBodyID b, const double p[3], const double n[3]) {
    MdtLinear1ID j = MdtLinear1Create(w);
    MdtLinear1SetBodies(j, a, b);
    MdtLinear1SetPosition(j, p[0], p[1], p[2]);
    MdtLinear1SetAxis(j, n[0], n[1], n[2]);
    MdtLinear1Enable(j);
    return j;
}

static MdtLinear2ID line(MdtWorldID w, MdtBodyID a, MdtBodyID b, const double p[3], const double d[3]) {
    MdtLinear2ID j = MdtLinear2Create(w);
    MdtLinear2SetBodies(j, a, b);
    MdtLinear2SetPosition(j, p[0], p[1], p[2]);
    MdtLinear2SetDirection(j, d[0], d[1], d[2]);
    MdtLinear2Enable(j);
    return j;
}

static MdtWorldID makeWorld(double gravity) {
    MdtWorldID w = scene_world(3, 4, gravity);
    MdtWorldSetEpsilon(w, 0);
    return w;
}

/* After n steps under a constant acceleration a from rest: exactly a t²/2. */
static double fallen(double a, int n) {
    return a * n * n / 2 / 3600;
}

static const double centre[3] = {0, 0, 0};

/* On a plane of 36.9 degrees a body slides with g sin: along the fall line (.8, -.6), 0.6 g. */
TEST(a_body_slides_on_a_slanting_plane) {
    MdtWorldID w = makeWorld(g);
    MdtBodyID b = scene_body(w, 2, 0, 0, 0);
    MdtLinear1ID j = plane(w, b, 0, centre, normal);
    double p[3], f[3];
    MdtBodySetLinearVelocity(b, 0, 0, 1);
    MdtBodySetAngularVelocity(b, 1, 2, 3);
    for (int i = 1; i <= 120; i++) {
        const double way = fallen(.6 * g, i);
        MdtWorldStep(w, FRAME);
        measure_position(b, p);
        assert_vec3_near(p, .8 * way, -.6 * way, i / 60., TOL(2e-5, 2e-11));
        read_force(MdtLinear1QuaConstraint(j), 0, f);
        assert_vec3_near(f, 2 * g * .8 * normal[0], 2 * g * .8 * normal[1], 0, TOL(2e-5, 2e-11));
    }
    measure_rate(b, p);
    assert_vec3_near(p, 1, 2, 3, TOL(1e-6, 3e-13)); /* a sphere that turns at its centre of mass */
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtLinear1QuaConstraint(j)), 1);
}

/* A pendulum on a cart without mass: a body on a rail by a point above it swings about its centre of mass, which comes
 * straight down and up: θ'' (I + m l² sin²θ) = -m l sin θ (g + l θ'² cos θ). For small swings w² = m g l / I. */
TEST(a_body_on_a_rail_swings) {
    const double l = .5, inertia = .4, h = FRAME, angle = .02, rail[3] = {1, 0, 0}, top[3] = {0, .5, 0};
    MdtWorldID w = makeWorld(g);
    MdtBodyID b = scene_body(w, 1, 0, -l, 0);
    Swing swing = {0};
    double p[3];
    MdtBodySetSphericalInertiaTensor(b, inertia);
    line(w, b, 0, centre, rail);
    MdtBodySetQuaternion(b, cos(angle / 2), 0, 0, sin(angle / 2));
    MdtBodySetPosition(b, 0, -l * cos(angle), 0);
    for (int i = 0; i < 600; i++) {
        double R[3][3], end[3];
        MdtWorldStep(w, FRAME);
        measure_rotation(b, R);
        swing_add(&swing, atan2(R[1][0], R[0][0]));
        measure_pointOut(b, top, end);
        assert_near(end[1], 0, TOL(1e-6, 3e-11));
        measure_position(b, p);
        assert_near(p[0], 0, TOL(1e-6, 9e-14));
    }
    const double w0 = sqrt(g * l / inertia);
    assert_near_rel(swing_frequency(&swing, h), midpoint_frequency(w0, 0, h), 5e-4);
}
