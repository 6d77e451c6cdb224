/* The fixed-path joint: what hangs on a moved point follows it, with the forces of the motion. */
#include "measure.h"

static const double g = 9.81;

typedef struct {
    MdtWorldID world;
    MdtBodyID body;
    MdtFixedPathID joint;
} Hung;

/* A body of the mass 2, attached at the point `arm` of its own frame to the world's point 0. */
static Hung hang(double gravity, const double arm[3]) {
    const double edge[3] = {.3, .8, .2};
    Hung s;
    s.world = scene_world(2, 2, gravity);
    MdtWorldSetEpsilon(s.world, 0);
    s.body = scene_box(s.world, 2, edge, -arm[0], -arm[1], -arm[2]);
    s.joint = MdtFixedPathCreate(s.world);
    MdtFixedPathSetBodies(s.joint, s.body, 0);
    MdtFixedPathSetPosition(s.joint, 0, arm[0], arm[1], arm[2]);
    MdtFixedPathEnable(s.joint);
    return s;
}

static void setPath(Hung s, double x, double vx) {
    MdtFixedPathSetPosition(s.joint, 1, x, 0, 0);
    MdtFixedPathSetVelocity(s.joint, 1, vx, 0, 0);
}

static const double centre[3] = {0, 0, 0};

/* ---- a pendulum whose pivot moves: x = A sin w t ---- */

static const double amplitude = .3, frequency = 2.5;

static double pivot(double t) {
    return amplitude * sin(frequency * t);
}

/* The angle from the vertical, by Runge and Kutta:
 *     (I + m l²) θ'' = -m l (g sin θ + x'' cos θ). */
static double pendulumAcceleration(double t, double angle) {
    const double l = .4, inertia = 2 * (.3 * .3 + .8 * .8) / 12 + 2 * l * l;
    const double pull = -amplitude * frequency * frequency * sin(frequency * t);
    return -2 * l / inertia * (g * sin(angle) + pull * cos(angle));
}

static double referenceAngle(double start, double end) {
    const int n = 40000;
    const double h = end / n;
    double x = start, v = 0;
    for (int i = 0; i < n; i++) {
        const double t = i * h, a1 = pendulumAcceleration(t, x);
        const double v2 = v + .5 * h * a1, a2 = pendulumAcceleration(t + .5 * h, x + .5 * h * v);
        const double v3 = v + .5 * h * a2, a3 = pendulumAcceleration(t + .5 * h, x + .5 * h * v2);
        const double v4 = v + h * a3, a4 = pendulumAcceleration(t + h, x + h * v3);
        x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
        v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    return x;
}

/* It hangs still from its pivot, which moves already. */
static void throwPendulum(MdtBodyID bar) {
    MdtBodySetLinearVelocity(bar, amplitude * frequency, 0, 0);
}

/* The top end of the bar is led along the path with the mean velocity of each step. */
static double simulatedAngle(double start, double end, double h, double *apart) {
    const double top[3] = {0, .4, 0};
    Hung s = hang(g, top);
    const int n = (int)lround(end / h);
    double up[3], y[3] = {0, 1, 0}, point[3];
    MdtBodySetQuaternion(s.body, cos(start / 2), 0, 0, sin(start / 2));
    MdtBodySetPosition(s.body, .4 * sin(start), -.4 * cos(start), 0);
    throwPendulum(s.body);
    *apart = 0;
    for (int i = 0; i < n; i++) {
        setPath(s, pivot(i * h), (pivot((i + 1) * h) - pivot(i * h)) / h);
        MdtWorldStep(s.world, h);
        measure_pointOut(s.body, top, point);
        point[0] -= pivot((i + 1) * h);
        *apart = fmax(*apart, keaLength(point));
    }
    measure_turnOut(s.body, y, up);
    return atan2(-up[0], up[1]);
}

TEST(a_pendulum_on_a_moving_pivot) {
    const double start = .6, end = 4, exact = referenceAngle(start, end);
    double error[3], apart;
    for (int k = 0; k < 3; k++) {
        const double h = 1.0 / (64 << k);
        error[k] = fabs(simulatedAngle(start, end, h, &apart) - exact);
        assert_below(apart, TOL(2e-6, 1e-7));
    }
    assert_below(error[0], 4e-3);
    assert_near(error[0] / error[1], 4, .1); /* of second order */
    assert_near(error[1] / error[2], 4, TOL(.04, .05));
}

/* ---- velocity ---- */

TEST(with_the_velocity_the_body_does_not_lag) {
    Hung s = hang(0, centre);
    const double u = 3, h = FRAME;
    double p[3], f[3];
    for (int i = 0; i < 120; i++) {
        setPath(s, u * i * h, u);
        MdtWorldStep(s.world, FRAME);
        measure_position(s.body, p);
        assert_near(p[0], u * (i + 1) * h, TOL(2e-6, 6e-13));
        read_force(MdtFixedPathQuaConstraint(s.joint), 0, f);
        assert_near(f[0], i == 0 ? 2 * u / h : 0, TOL(2e-3, 9e-11)); /* starting takes an impulse; then nothing */
    }
}

/* Each step removes γ of the gap, and the path adds u h to it: u h / γ. */
TEST(without_the_velocity_it_lags_by_the_relaxation) {
    const double gammas[] = {.1, .2, .5, 1}, u = 3, h = FRAME;
    for (int k = 0; k < 4; k++) {
        Hung s = hang(0, centre);
        double p[3];
        MdtWorldSetGamma(s.world, gammas[k]);
        for (int i = 0; i < 300; i++) {
            setPath(s, u * i * h, 0);
            MdtWorldStep(s.world, FRAME);
        }
        measure_position(s.body, p);
        assert_near(u * 300 * h - p[0], u * h / gammas[k], TOL(3e-6, 7e-14));
    }
}

/* x = A sin w t with its velocity: F = m x'', to first order in the step, and the weight besides. */
TEST(the_force_is_that_of_the_motion) {
    Hung s = hang(g, centre);
    const double h = .002;
    MdtBodySetLinearVelocity(s.body, amplitude * frequency, 0, 0);
    for (int i = 0; i < 1000; i++) {
        const double t = i * h;
        double f[3];
        setPath(s, pivot(t), amplitude * frequency * cos(frequency * t));
        MdtWorldStep(s.world, h);
        read_force(MdtFixedPathQuaConstraint(s.joint), 0, f);
        if (i > 50) { /* the velocity at the start is that of the middle of a step */
            const double wanted = -2 * amplitude * frequency * frequency * sin(frequency * t);
            assert_vec3_near(f, wanted, 2 * g, 0, TOL(2, .3) * amplitude * pow(frequency, 3) * h + TOL(2e-2, 1e-4));
        }
    }
}

/* The velocity of the path's start, not its mean, leaves h² x'' / (2 γ). */
TEST(an_accelerated_path_is_followed_to_second_order) {
    Hung s = hang(0, centre);
    const double a = 4, h = FRAME, gamma = .2;
    double p[3];
    MdtWorldSetGamma(s.world, gamma);
    for (int i = 0; i < 120; i++) {
        setPath(s, .5 * a * i * h * i * h, a * i * h);
        MdtWorldStep(s.world, FRAME);
    }
    measure_position(s.body, p);
    assert_near(.5 * a * 120 * h * 120 * h - p[0], .5 * a * h * h / gamma, TOL(2e-6, 7e-14));
}

/* ---- a path in a body ---- */

/* A ball on a rail of a freely turning body: the place that the program gives on the body's x-axis, in either order. */
TEST(a_path_in_a_turning_body) {
    for (unsigned int rail = 0; rail < 2; rail++) {
        const double edge[3] = {2, .3, .4}, h = FRAME;
        MdtWorldID w = scene_world(2, 1, 0);
        MdtWorldSetEpsilon(w, 0);
        MdtBodyID body = scene_box(w, 4, edge, 0, 0, 0), ball = scene_body(w, 1, .5, .2, 0);
        MdtFixedPathID j = MdtFixedPathCreate(w);
        double p[2][3], L[2][3], q[2][3], M[2][3];
        if (rail == 0)
            MdtFixedPathSetBodies(j, body, ball);
        else
            MdtFixedPathSetBodies(j, ball, body);
        MdtFixedPathEnable(j);
        MdtBodySetAngularVelocity(body, .3, -.5, 2);
        measure_momentum(body, p[0], L[0]);
        measure_momentum(ball, p[1], L[1]);
        for (int i = 0; i < 300; i++) {
            const double x = .5 + .3 * sin(2 * i * h), next = .5 + .3 * sin(2 * (i + 1) * h);
            double wanted[3], at[3], local[3] = {next, .2, 0};
            MdtFixedPathSetPosition(j, rail, x, .2, 0);
            MdtFixedPathSetVelocity(j, rail, (next - x) / h, 0, 0);
            MdtWorldStep(w, FRAME);
            measure_pointOut(body, local, wanted);
            measure_position(ball, at);
            for (int n = 0; n < 3; n++)
                assert_near(at[n], wanted[n], TOL(7e-7, 9e-10));
        }
        measure_momentum(body, q[0], M[0]);
        measure_momentum(ball, q[1], M[1]);
        for (int n = 0; n < 3; n++)
            assert_near(q[0][n] + q[1][n], p[0][n] + p[1][n], TOL(1e-6, 9e-14));
    }
}

/* Positions are in the body's frame, which is not that of its centre of mass. */
TEST(the_frame_is_the_body_s_not_its_centre_of_mass_s) {
    Hung s = hang(g, centre);
    const MeVector3 offset = {.1, -.3, .2};
    MeVector3 back;
    MdtBodySetCenterOfMassRelativePosition(s.body, offset);
    MdtFixedPathSetPosition(s.joint, 0, .5, .1, -.2);
    MdtFixedPathGetPosition(s.joint, 0, back);
    assert_vec3_near(back, .5, .1, -.2, TOL(5e-7, 5e-14));
    MdtFixedPathSetVelocity(s.joint, 0, 1, 2, 3);
    MdtFixedPathGetVelocity(s.joint, 0, back);
    assert_vec3_near(back, 1, 2, 3, TOL(1e-6, 3e-13));
    MdtFixedPathSetVelocity(s.joint, 0, 0, 0, 0);
    steps(s.world, 100, FRAME);
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(s.body);
    for (int n = 0; n < 3; n++) {
        const double at = .5 * (double)tm[0][n] + .1 * (double)tm[1][n] - .2 * (double)tm[2][n] + (double)tm[3][n];
        assert_near(at, 0, TOL(1e-6, 1e-9));
    }
}
