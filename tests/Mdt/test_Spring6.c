/* Six springs: each direction has its own frequency, decay and compliance, and none costs nothing. */
#include "measure.h"

static const double mass = 2, inertia = .3;

typedef struct {
    MdtWorldID world;
    MdtBodyID body;
    MdtSpring6ID joint;
} Held;

static Held hold(void) {
    Held s;
    s.world = scene_world(2, 1, 0);
    MdtWorldSetEpsilon(s.world, 0);
    s.body = scene_body(s.world, mass, 1, 2, 3);
    MdtBodySetSphericalInertiaTensor(s.body, inertia);
    s.joint = MdtSpring6Create(s.world);
    MdtSpring6SetBodies(s.joint, s.body, 0);
    MdtSpring6SetPosition(s.joint, 1, 2, 3);
    MdtSpring6SetAxes(s.joint, 0, 1, 0, 0, 0, 1); /* axis 0 is y, 1 is z, 2 is x */
    MdtSpring6Enable(s.joint);
    return s;
}

static const int worldAxis[3] = {1, 2, 0};

static void setLinear(Held s, int axis, double k, double c) {
    MdtSpring6SetLinearStiffness(s.joint, axis, k);
    MdtSpring6SetLinearDamping(s.joint, axis, c);
}

static void setAngular(Held s, int axis, double k, double c) {
    MdtSpring6SetAngularStiffness(s.joint, axis, k);
    MdtSpring6SetAngularDamping(s.joint, axis, c);
}

static double offsetAlong(Held s, int axis) {
    static const double home[3] = {1, 2, 3};
    double p[3];
    measure_position(s.body, p);
    return p[worldAxis[axis]] - home[worldAxis[axis]];
}

/* The turn about a world axis, for turns about one axis only. */
static double turnAbout(Held s, int axis) {
    double R[3][3];
    const int a = worldAxis[axis], b = (a + 1) % 3, c = (a + 2) % 3;
    measure_rotation(s.body, R);
    return atan2(R[c][b], R[b][b]);
}

TEST(without_stiffness_it_does_nothing) {
    Held s = hold();
    double v[3], w[3];
    MdtBodySetLinearVelocity(s.body, 1, 2, 3);
    MdtBodySetAngularVelocity(s.body, 3, 2, 1);
    steps(s.world, 60, FRAME);
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtSpring6QuaConstraint(s.joint)), 0);
    measure_velocity(s.body, v);
    measure_rate(s.body, w);
    assert_vec3_near(v, 1, 2, 3, 0);
    assert_vec3_near(w, 3, 2, 1, TOL(1e-6, 3e-13));
}

TEST(each_axis_gives_way_by_force_over_stiffness) {
    const double k[3] = {50, 200, 1000}, kt[3] = {20, 60, 300}, force = 4, torque = .5;
    Held s = hold();
    for (int i = 0; i < 3; i++) {
        setLinear(s, i, k[i], 20);
        setAngular(s, i, kt[i], 4);
    }
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtSpring6QuaConstraint(s.joint)), 0); /* before its first step */
    for (int n = 0; n < 1200; n++) {
        MdtBodyAddForce(s.body, force, force, force);
        MdtBodyAddTorque(s.body, 0, torque, 0);
        MdtWorldStep(s.world, FRAME);
    }
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtSpring6QuaConstraint(s.joint)), 6);
    for (int i = 0; i < 3; i++)
        assert_near(offsetAlong(s, i), force / k[i], TOL(8e-7, 9e-11));
    assert_near(turnAbout(s, 0), torque / kt[0], TOL(3e-8, 3e-15));
    double f[3];
    read_force(MdtSpring6QuaConstraint(s.joint), 0, f);
    assert_vec3_near(f, -force, -force, -force, TOL(4e-6, 9e-8));
}

static void swingAt(int axis, double k, double c, MeBool isAngular) {
    Held s = hold();
    Swing swing = {0};
    const double h = FRAME, amplitude = isAngular ? .02 : .2, load = isAngular ? inertia : mass;
    const double w0 = sqrt(k / load), decay = c / (2 * load);
    double away[3] = {0, 0, 0};
    away[worldAxis[axis]] = amplitude;
    for (int i = 0; i < 3; i++) {
        setLinear(s, i, MEINFINITY, 0);
        setAngular(s, i, MEINFINITY, 0);
    }
    if (isAngular) {
        setAngular(s, axis, k, c);
        keaScale(away, sin(amplitude / 2) / amplitude, away);
        MdtBodySetQuaternion(s.body, cos(amplitude / 2), away[0], away[1], away[2]);
    } else {
        setLinear(s, axis, k, c);
        MdtBodySetPosition(s.body, 1 + away[0], 2 + away[1], 3 + away[2]);
    }
    for (int n = 0; n < 3000 && swing.crossings < 11; n++) {
        MdtWorldStep(s.world, FRAME);
        swing_add(&swing, isAngular ? turnAbout(s, axis) : offsetAlong(s, axis));
    }
    ck_assert_int_eq(swing.crossings, 11);
    swing_check(&swing, w0, decay, h, TOL(2e-5, 2e-7));
}

TEST(each_axis_swings_for_itself) {
    for (int axis = 0; axis < 3; axis++) {
        swingAt(axis, 40, 0, 0);
        swingAt(axis, 160, 1, 0);
        swingAt(axis, 6, 0, 1);
        swingAt(axis, 24, .1, 1);
    }
}

/* Damping alone: a dashpot, v = v_0 exp(-c t / m). */
TEST(damping_alone_is_a_dashpot) {
    Held s = hold();
    double v[3];
    setLinear(s, 0, 0, 3);
    MdtBodySetLinearVelocity(s.body, 0, 2, 1);
    for (int n = 1; n <= 120; n++) {
        MdtWorldStep(s.world, FRAME);
        measure_velocity(s.body, v);
        assert_vec3_near(v, 0, 2 * exp(-3 / mass * n / 60), 1, TOL(2e-4, 2e-4)); /* the midpoint rule */
    }
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtSpring6QuaConstraint(s.joint)), 1);
}

/* A world that moves where the dashpot is attached carries the body along. */
TEST(a_moving_world) {
    Held s = hold();
    MeVector3 v, w;
    for (int i = 0; i < 3; i++) {
        setLinear(s, i, 0, 10);
        setAngular(s, i, 0, 10);
    }
    MdtSpring6SetWorldLinearVelocity(s.joint, 1, 0, -2);
    MdtSpring6GetWorldLinearVelocity(s.joint, v);
    assert_vec3_near(v, 1, 0, -2, 0);
    steps(s.world, 600, FRAME);
    MdtBodyGetLinearVelocity(s.body, v);
    assert_vec3_near(v, 1, 0, -2, TOL(2e-6, 2e-8));
    MdtSpring6SetWorldLinearVelocity(s.joint, 0, 0, 0);
    MdtSpring6SetWorldAngularVelocity(s.joint, 0, .1, 0);
    MdtSpring6GetWorldAngularVelocity(s.joint, w);
    assert_vec3_near(w, 0, .1, 0, TOL(1e-8, 0));
    for (int i = 0; i < 3; i++)
        setLinear(s, i, 0, 0);
    steps(s.world, 600, FRAME);
    MdtBodyGetAngularVelocity(s.body, w);
    assert_vec3_near(w, 0, .1, 0, TOL(1e-6, 3e-9));
}
