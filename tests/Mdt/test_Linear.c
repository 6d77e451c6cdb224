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
    MdtWorldDestroy(w);
}

/* A pole whose foot stays on the ground: it falls over, the foot slips, the centre comes straight down. */
TEST(the_point_is_in_the_plane_the_body_turns_about_it) {
    const double edge[3] = {.1, 2, .1}, foot[3] = {0, -1, 0}, up[3] = {0, 1, 0}, lean = .3;
    MdtWorldID w = makeWorld(g);
    MdtBodyID b = scene_box(w, 3, edge, 0, cos(lean), 0);
    double ground[3], p[3], end[3];
    MdtBodySetQuaternion(b, cos(lean / 2), 0, 0, sin(lean / 2));
    measure_pointOut(b, foot, ground);
    plane(w, b, 0, ground, up);
    for (int i = 0; i < 40; i++) {
        MdtWorldStep(w, FRAME);
        measure_pointOut(b, foot, end);
        assert_near(end[1], ground[1], TOL(1e-6, 3e-9));
        measure_position(b, p);
        assert_near(p[0], 0, TOL(1e-6, 9e-14));
    }
    ck_assert(p[1] < .9 * cos(lean));
    MdtWorldDestroy(w);
}

/* The second body carries the plane: it turns, and the point goes with it. */
TEST(the_plane_is_the_second_body_s) {
    const double edge[3] = {2, .1, 2};
    MdtWorldID w = makeWorld(0);
    MdtBodyID table = scene_box(w, 5, edge, 0, 0, 0), ball = scene_body(w, 1, .5, .3, 0);
    const double at[3] = {.5, .3, 0}, up[3] = {0, 1, 0};
    double p[3], local[3];
    plane(w, ball, table, at, up);
    MdtBodySetAngularVelocity(table, .3, 0, 1);
    for (int i = 0; i < 120; i++) {
        MdtWorldStep(w, FRAME);
        measure_position(ball, p);
        measure_pointIn(table, p, local);
        assert_near(local[1], .3, TOL(6e-7, 1e-11));
    }
    ck_assert(fabs(p[1] - .3) > .1);
    MdtWorldDestroy(w);
}

/* With the world first it is the body that has the plane, and the world the point. */
TEST(a_plane_of_a_body_on_a_point_of_the_world) {
    const double edge[3] = {2, .1, 2}, up[3] = {0, 1, 0};
    MdtWorldID w = makeWorld(g);
    MdtBodyID table = scene_box(w, 5, edge, 0, 0, 0);
    double local[3];
    plane(w, 0, table, centre, up);
    MdtBodySetAngularVelocity(table, 0, 0, .5);
    MdtBodySetLinearVelocity(table, 1, 0, 0);
    for (int i = 0; i < 60; i++) {
        MdtWorldStep(w, FRAME);
        measure_pointIn(table, centre, local);
        assert_near(local[1], 0, TOL(1e-6, 1e-9));
    }
    ck_assert(fabs(local[0]) > .3); /* it slides off */
    MdtWorldDestroy(w);
}

/* A bead on a wire that slants by 30 degrees: g / 2. */
TEST(a_bead_slides_on_a_wire) {
    const double wire[3] = {cos(.5235987755982988), -.5, 0};
    MdtWorldID w = makeWorld(g);
    MdtBodyID b = scene_body(w, 2, 0, 0, 0);
    MdtLinear2ID j = line(w, b, 0, centre, wire);
    MeVector3 d;
    double p[3];
    MdtBodySetLinearVelocity(b, 0, 0, 3); /* is taken away: the wire does not go there */
    for (int i = 1; i <= 120; i++) {
        const double way = fallen(g / 2, i);
        MdtWorldStep(w, FRAME);
        measure_position(b, p);
        assert_vec3_near(p, wire[0] * way, wire[1] * way, 0, TOL(2e-5, 4e-10));
    }
    MdtLinear2GetDirection(j, d);
    assert_vec3_near(d, wire[0], wire[1], 0, TOL(1e-6, 9e-14));
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtLinear2QuaConstraint(j)), 2);
    MdtWorldDestroy(w);
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
    MdtWorldDestroy(w);
}

/* The second body carries the line; with the world first, the body has the line and the world the point. */
TEST(the_line_is_the_second_body_s) {
    for (int withBall = 0; withBall < 2; withBall++) {
        const double edge[3] = {2, .1, .1}, at[3] = {.5, 0, 0}, rail[3] = {1, 0, 0};
        MdtWorldID w = makeWorld(0);
        MdtBodyID bar = scene_box(w, 5, edge, 0, 0, 0), ball = withBall ? scene_body(w, 1, .5, 0, 0) : NULL;
        double p[3], local[3];
        line(w, ball, bar, at, rail);
        MdtBodySetAngularVelocity(bar, 0, .2, 1);
        MdtBodySetLinearVelocity(bar, -.3, -.5, 0);
        for (int i = 0; i < 120; i++) {
            MdtWorldStep(w, FRAME);
            if (ball)
                measure_position(ball, p);
            else
                keaCopy(p, at);
            measure_pointIn(bar, p, local);
            assert_near(local[1], 0, TOL(1e-6, 4e-10));
            assert_near(local[2], 0, TOL(1e-6, 2e-10));
        }
        ck_assert(fabs(local[0] - .5) > .1);
        MdtWorldDestroy(w);
    }
}

/* Three planes through one point hold it, and share a load as their normals say. */
TEST(three_planes_hold_a_point) {
    MdtWorldID w = makeWorld(g);
    MdtBodyID b = scene_body(w, 3, 0, 0, 0);
    const double n[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, .6, .8}};
    MdtLinear1ID j[3];
    double p[3], f[3];
    for (int i = 0; i < 3; i++)
        j[i] = plane(w, b, 0, centre, n[i]);
    steps(w, 60, FRAME);
    measure_position(b, p);
    assert_vec3_near(p, 0, 0, 0, TOL(1e-7, 9e-14));
    read_force(MdtLinear1QuaConstraint(j[1]), 0, f);
    assert_vec3_near(f, 0, 3 * g, 0, TOL(3e-5, 2e-7));
    read_force(MdtLinear1QuaConstraint(j[2]), 0, f);
    assert_vec3_near(f, 0, 0, 0, TOL(1e-6, 8e-8));
    MdtWorldDestroy(w);
}
