/* How errors fall with the length of the step: convergence orders, sub-steps, and what a load does to a soft joint. */
#include "measure.h"

enum { MAX = 16 };

/* ---- references ---- */

typedef void (*Rates)(const double y[], double rates[]);

/* Runge and Kutta's method of order 4 with steps so short that its own error is rounding. */
static void integrate(int n, Rates rates, double duration, int count, double y[]) {
    const double h = duration / count, weight[] = {1. / 6, 1. / 3, 1. / 3, 1. / 6}, reach[] = {0, .5, .5, 1};
    for (int i = 0; i < count; i++) {
        double k[4][MAX], at[MAX], next[MAX];
        memcpy(next, y, (size_t)n * sizeof *y);
        for (int stage = 0; stage < 4; stage++) {
            for (int c = 0; c < n; c++)
                at[c] = y[c] + (stage > 0 ? h * reach[stage] * k[stage - 1][c] : 0);
            rates(at, k[stage]);
            for (int c = 0; c < n; c++)
                next[c] += h * weight[stage] * k[stage][c];
        }
        memcpy(y, next, (size_t)n * sizeof *y);
    }
}

/* ---- orders ---- */

/* A scene after `duration` in steps of h, each divided into `parts`: what is measured, and how many numbers. */
typedef int (*Run)(double duration, double h, int parts, double result[]);

static double distance(int n, const double *a, const double *b) {
    double max = 0;
    for (int i = 0; i < n; i++)
        max = fmax(max, fabs(a[i] - b[i]));
    return max;
}

static double errorOf(Run run, double duration, double h, int parts, const double *reference) {
    double result[MAX];
    const int n = run(duration, h, parts, result);
    return distance(n, result, reference);
}

/* Every halving divides the error by 2^order. */
static void assertOrder(const char *what, Run run, double duration, double h, double order, double within,
                        const double *reference) {
    double before = errorOf(run, duration, h, 1, reference);
    for (int i = 0; i < 2; i++) {
        const double now = errorOf(run, duration, h *= .5, 1, reference), measured = log2(before / now);
        ck_assert_msg(fabs(measured - order) <= within, "%s, h = 1/%g: order %g, error %g", what, 1 / h, measured, now);
        before = now;
    }
}

/* n parts of a step are as good as n steps, but for what Kea is content with at every step. */
static void assertPartsAreSteps(const char *what, Run run, double duration, double h, const double *reference) {
    for (int parts = 2; parts <= 8; parts *= 2) {
        const double divided = errorOf(run, duration, h, parts, reference);
        const double shorter = errorOf(run, duration, h / parts, 1, reference);
        ck_assert_msg(fabs(divided - shorter) <= TOL(1e-3, 1e-4) * shorter, "%s, %d parts: %g, not %g", what, parts,
                      divided, shorter);
    }
}

/* ---- scenes ---- */

static const double g = 9.8125; /* m/s², the same in both precisions */

static int integratorOrder; /* of the worlds that the test makes from here on */

static void run(MdtWorldID w, double duration, double h, int parts) {
    MdtWorldSetSubSteps(w, parts);
    MdtWorldSetIntegratorOrder(w, integratorOrder);
    steps(w, (int)lround(duration / h), h);
}

/* The bar, let go when it is level: the angle from there. */
static int pendulum(double duration, double h, int parts, double result[]) {
    HingedBar s = scene_hingedBar(g);
    double p[3];
    run(s.world, duration, h, parts);
    measure_position(s.bar, p);
    result[0] = atan2(-p[1], p[0]);
    return 1;
}

static void pendulumRates(const double y[], double rates[]) {
    const double inertia = .25 + (1 + 1e-6) / 12;
    rates[0] = y[1];
    rates[1] = .5 * g / inertia * cos(y[0]);
}

/* Another bar at the end of the first. */
static int doublePendulum(double duration, double h, int parts, double result[]) {
    const double edge[3] = {1, 1e-3, 1e-3};
    HingedBar s = scene_hingedBar(g);
    MdtBodyID second = scene_box(s.world, 1, edge, 1.5, 0, 0);
    scene_hinge(s.world, second, s.bar, 1, 0, 0, 0, 0, 1);
    run(s.world, duration, h, parts);
    measure_position(s.bar, result);
    measure_position(second, result + 3);
    return 6;
}

/* Lagrange's equations of the two bars, angles from level, downwards: mass 1, length 1, inertia I about the centre.
 * T = (I + 5/4) a'²/2 + (I + 1/4) b'²/2 + cos(a - b) a' b'/2,   V = -g (3/2 sin a + 1/2 sin b) */
static void doublePendulumRates(const double y[], double rates[]) {
    const double I = (1 + 1e-6) / 12, c = .5 * cos(y[0] - y[1]), s = .5 * sin(y[0] - y[1]);
    const double A = I + 1.25, B = I + .25, det = A * B - c * c;
    const double p = -s * y[3] * y[3] + 1.5 * g * cos(y[0]), q = s * y[2] * y[2] + .5 * g * cos(y[1]);
    rates[0] = y[2];
    rates[1] = y[3];
    rates[2] = (B * p - c * q) / det;
    rates[3] = (A * q - c * p) / det;
}

enum { LINKS = 3 };
static const double stiffness = 100, damping = .5, rest = .75;

/* Bodies of the mass 1 in a row on springs, the first on the world; they are thrown across it. */
static int springChain(double duration, double h, int parts, double result[]) {
    MdtWorldID w = scene_world(LINKS, LINKS, 0);
    MdtBodyID body[LINKS];
    for (int i = 0; i < LINKS; i++) {
        body[i] = scene_body(w, 1, i + 1, 0, 0);
        MdtBodySetLinearVelocity(body[i], 0, i + 1., 0);
        MdtSpringID spring = MdtSpringCreate(w);
        MdtSpringSetBodies(spring, body[i], i > 0 ? body[i - 1] : 0);
        MdtSpringSetPosition(spring, 0, i + 1., 0, 0);
        MdtSpringSetPosition(spring, 1, (MeReal)i, 0, 0);
        MdtSpringSetNaturalLength(spring, rest);
        MdtSpringSetStiffness(spring, stiffness);
        MdtSpringSetDamping(spring, damping);
        MdtSpringEnable(spring);
    }
    run(w, duration, h, parts);
    for (int i = 0; i < LINKS; i++) {
        double p[3];
        measure_position(body[i], p);
        result[2 * i] = p[0];
        result[2 * i + 1] = p[1];
    }
    return 2 * LINKS;
}

static void springChainRates(const double y[], double rates[]) {
    const double *v = y + 2 * LINKS;
    memcpy(rates, v, 2 * LINKS * sizeof *v);
    memset(rates + 2 * LINKS, 0, 2 * LINKS * sizeof *v);
    for (int i = 0; i < LINKS; i++) {
        double way[2], speed[2];
        for (int c = 0; c < 2; c++) {
            way[c] = y[2 * i + c] - (i > 0 ? y[2 * i - 2 + c] : 0);
            speed[c] = v[2 * i + c] - (i > 0 ? v[2 * i - 2 + c] : 0);
        }
        const double length = hypot(way[0], way[1]), rate = (way[0] * speed[0] + way[1] * speed[1]) / length;
        const double pull = (stiffness * (length - rest) + damping * rate) / length;
        for (int c = 0; c < 2; c++) {
            rates[2 * LINKS + 2 * i + c] -= pull * way[c];
            if (i > 0)
                rates[2 * LINKS + 2 * i - 2 + c] += pull * way[c];
        }
    }
}

static const double moments[3] = {1, 2, 3.5}, spin[3] = {1, 2, .5};

/* A body with three moments of inertia turns without a load: its axes. */
static int freeRotation(double duration, double h, int parts, double result[]) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MeMatrix3 inertia = {{0}};
    double R[3][3];
    for (int i = 0; i < 3; i++)
        inertia[i][i] = (MeReal)moments[i];
    MdtBodySetInertiaTensor(b, inertia);
    MdtBodySetAngularVelocity(b, spin[0], spin[1], spin[2]);
    run(w, duration, h, parts);
    measure_rotation(b, R);
    memcpy(result, R, sizeof R);
    return 9;
}

/* Euler's equations, and R' = R [ω]x. */
static void freeRotationRates(const double y[], double rates[]) {
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        rates[9 + i] = (moments[j] - moments[k]) / moments[i] * y[9 + j] * y[9 + k];
        for (int r = 0; r < 3; r++)
            rates[3 * r + i] = y[3 * r + j] * y[9 + k] - y[3 * r + k] * y[9 + j];
    }
}

/* ---- tests ---- */

static void pendulumReference(double duration, double *angle) {
    double y[MAX] = {0};
    integrate(2, pendulumRates, duration, 20000, y);
    *angle = y[0];
}

TEST(a_pendulum_from_level_is_of_order_2) {
    double angle;
    pendulumReference(1.5, &angle);
    assertOrder("pendulum", pendulum, 1.5, 1. / 64, 2, .02, &angle);
    assertPartsAreSteps("pendulum", pendulum, 1.5, 1. / 32, &angle);
    assert_below(errorOf(pendulum, 1.5, 1. / 64, 1, &angle), 5e-3);
}

static void doublePendulumReference(double duration, double place[6]) {
    double y[MAX] = {0};
    integrate(4, doublePendulumRates, duration, 20000, y);
    const double p[] = {.5 * cos(y[0]), -.5 * sin(y[0]), 0, cos(y[0]) + .5 * cos(y[1]), -sin(y[0]) - .5 * sin(y[1]), 0};
    memcpy(place, p, sizeof p);
}

TEST(a_double_pendulum_is_of_order_2) {
    double place[6];
    doublePendulumReference(1, place);
    assertOrder("double pendulum", doublePendulum, 1, 1. / 128, 2, .02, place);
    assertPartsAreSteps("double pendulum", doublePendulum, 1, 1. / 64, place);
}

TEST(a_chain_of_springs_is_of_order_2) {
    double y[MAX] = {1, 0, 2, 0, 3, 0, 0, 1, 0, 2, 0, 3};
    integrate(4 * LINKS, springChainRates, 1, 20000, y);
    assertOrder("springs", springChain, 1, 1. / 128, 2, .02, y);
    assertPartsAreSteps("springs", springChain, 1, 1. / 64, y);
}

TEST(free_rotation_is_of_order_4) {
    double y[MAX] = {1, 0, 0, 0, 1, 0, 0, 0, 1, spin[0], spin[1], spin[2]};
    integrate(12, freeRotationRates, 128, 100000, y);
    assertOrder("rotation", freeRotation, 128, 1. / 4, 4, .1, y);
    assertPartsAreSteps("rotation", freeRotation, 128, 1, y);
}

/* The slope of the error from 1 to .4 of h, from 1/`rate` s on: longer steps have the velocity stage's jerks, and of
 * shorter ones the error is what Kea is content with, 1e-10 of a step's way. */
static double slopeOf(Run scene, double duration, double rate, const double *reference) {
    const double coarse = errorOf(scene, duration, 1 / rate, 1, reference);
    const double fine = errorOf(scene, duration, .4 / rate, 1, reference);
    return log(coarse / fine) / log(2.5);
}

/* In double precision: single has no digits for that. */
LOOP_TEST(pendulums_of_order_4_are_of_order_4, 0, sizeof(MeReal) == sizeof(double)) {
    double y[2] = {0, 0}, place[6];
    integrate(2, pendulumRates, 1, 20000, y);
    doublePendulumReference(1, place);
    integratorOrder = 4;
    const double single = slopeOf(pendulum, 1, 24, y), two = slopeOf(doublePendulum, 1, 48, place);
    ck_assert_msg(fabs(single - 4) <= .2, "pendulum: order %g", single);
    ck_assert_msg(fabs(two - 4) <= .2, "double pendulum: order %g", two);
}

/* A hundredth of the error at 60 Hz, in either precision but for what a float's digits hide. */
TEST(order_4_has_a_hundredth_of_the_error_at_60_hz) {
    double y[2] = {0, 0}, place[6];
    integrate(2, pendulumRates, 1, 20000, y);
    doublePendulumReference(1, place);
    const double pendulum2 = errorOf(pendulum, 1, 1. / 60, 1, y),
                 double2 = errorOf(doublePendulum, 1, 1. / 60, 1, place);
    integratorOrder = 4;
    const double pendulum4 = errorOf(pendulum, 1, 1. / 60, 1, y),
                 double4 = errorOf(doublePendulum, 1, 1. / 60, 1, place);
    ck_assert_msg(pendulum4 < TOL(2e-4, 2e-5) * pendulum2, "pendulum: %g, %g", pendulum2, pendulum4);
    ck_assert_msg(double4 < TOL(1e-3, 1e-3) * double2, "double pendulum: %g, %g", double2, double4);
}

/* A fast heavy top, whose steps are divided: where its centre is after a second. */
static int top(double duration, double h, int parts, double result[]) {
    const double edge[3] = {.2, .02, .2};
    MdtWorldID w = scene_world(1, 1, g);
    MdtBodyID b = scene_box(w, 1, edge, 0, .1, 0);
    scene_ball(w, b, 0, 0, 0, 0);
    MdtBodySetAngularVelocity(b, 1, 100, 0);
    MdtBodySetLinearVelocity(b, 0, 0, .1);
    MdtWorldSetEpsilon(w, 0);
    run(w, duration, h, parts);
    measure_position(b, result);
    return 3;
}

TEST(a_fast_top_of_order_4_is_divided_evenly) {
    double place[3];
    integratorOrder = 4;
    top(1, 1. / 960, 1, place);
    const double error4 = errorOf(top, 1, 1. / 60, 1, place);
    integratorOrder = 2;
    const double error2 = errorOf(top, 1, 1. / 60, 1, place);
    ck_assert_msg(error4 < TOL(.05, .01) * error2, "%g, %g", error4, error2);
    ck_assert_msg(error2 > 1e-5, "%g", error2);
}

/* Turned round, the motion is taken back. */
TEST(order_4_goes_back_where_it_came_from) {
    HingedBar s = scene_hingedBar(g);
    double before[3], after[3];
    MeVector3 v, w;
    MdtWorldSetIntegratorOrder(s.world, 4);
    measure_position(s.bar, before);
    steps(s.world, 300, FRAME);
    MdtBodyGetLinearVelocity(s.bar, v);
    MdtBodyGetAngularVelocity(s.bar, w);
    MdtBodySetLinearVelocity(s.bar, -v[0], -v[1], -v[2]);
    MdtBodySetAngularVelocity(s.bar, -w[0], -w[1], -w[2]);
    steps(s.world, 300, FRAME);
    measure_position(s.bar, after);
    ck_assert_msg(distance(3, before, after) < TOL(1e-4, 1e-7), "%g", distance(3, before, after));
}

/* How many sub-steps of a step were composed. */
static int composedOf(MdtWorldID w) {
    MdtReport r;
    MdtWorldSetIntegratorOrder(w, 4);
    MdtWorldEnableReport(w);
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(MdtWorldGetReport(w, &r), 1);
    return r.composed;
}

static int composedBar(void (*change)(HingedBar s)) {
    HingedBar s = scene_hingedBar(g);
    if (change)
        change(s);
    const int composed = composedOf(s.world);
    return composed;
}

static void divide(HingedBar s) {
    MdtWorldSetSubSteps(s.world, 3);
}
static void soften(HingedBar s) {
    MdtWorldSetEpsilon(s.world, 1e-4);
}
static void damp(HingedBar s) {
    MdtBodySetLinearVelocityDamping(s.bar, .1);
}
static void drive(HingedBar s) {
    MdtLimitActivateMotor(s.limit, 1);
    MdtLimitSetLimitedForceMotor(s.limit, 1, 1);
}
static void stop(HingedBar s) {
    MdtLimitActivateLimits(s.limit, 1);
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(s.limit), 0);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(s.limit), 1);
}
static void touch(HingedBar s) {
    MdtContactID c = MdtContactCreate(s.world);
    MdtContactSetBodies(c, s.bar, 0);
    MdtContactSetPosition(c, 1, 0, 0);
    MdtContactSetNormal(c, 0, 1, 0);
    MdtContactEnable(c);
}

TEST(order_4_is_for_what_can_be_reversed) {
    ck_assert_int_eq(composedBar(NULL), 1);
    ck_assert_int_eq(composedBar(soften), 1);
    ck_assert_int_eq(composedBar(divide), 3);
    ck_assert_int_eq(composedBar(damp), 0);
    ck_assert_int_eq(composedBar(drive), 0);
    ck_assert_int_eq(composedBar(stop), 0);
    ck_assert_int_eq(composedBar(touch), 0);
}

/* What cannot be composed is, to the last bit, what it is with order 2. */
TEST(others_are_as_with_order_2) {
    double place[2][3];
    for (int i = 0; i < 2; i++) {
        HingedBar s = scene_hingedBar(g);
        stop(s);
        MdtWorldSetIntegratorOrder(s.world, i ? 4 : 2);
        MdtBodySetLinearVelocityDamping(s.bar, .1);
        steps(s.world, 60, FRAME);
        measure_position(s.bar, place[i]);
    }
    ck_assert(memcmp(place[0], place[1], sizeof place[0]) == 0);
}

/* A stop that comes within reach in the middle of a step: it holds. */
TEST(a_stop_in_the_way_of_order_4_holds) {
    HingedBar s = scene_hingedBar(g);
    double p[3], lowest = 0;
    MdtLimitActivateLimits(s.limit, 1);
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(s.limit), -1);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(s.limit), 1);
    MdtSingleLimitSetRestitution(MdtLimitGetLowerLimit(s.limit), 0);
    MdtSingleLimitSetRestitution(MdtLimitGetUpperLimit(s.limit), 0);
    MdtWorldSetIntegratorOrder(s.world, 4);
    for (int i = 0; i < 600; i++) {
        MdtWorldStep(s.world, FRAME);
        measure_position(s.bar, p);
        lowest = fmax(lowest, fabs(atan2(p[1], p[0])));
    }
    ck_assert_msg(lowest < 1.001, "%g rad", lowest);
    ck_assert_msg(fabs(fabs(atan2(p[1], p[0])) - 1) < 1e-3, "%g rad", atan2(p[1], p[0]));
}

TEST(the_order_is_2_or_4) {
    MdtWorldID w = scene_world(1, 1, 0);
    ck_assert_int_eq(MdtWorldGetIntegratorOrder(w), 2);
    MdtWorldSetIntegratorOrder(w, 4);
    assert_refused(MdtWorldSetIntegratorOrder, w, 3);
    ck_assert_int_eq(MdtWorldGetIntegratorOrder(w), 4);
}

/* A load F on a joint comes to rest ε F h²/γ away, h the whole step, in however many parts it is done. Kea is content
 * with an error of 1e-12 of a body's size (the radius of gyration), of which a part of the step takes only `share`
 * away. */
TEST(the_sag_of_a_load_is_epsilon_force_over_gamma) {
    const double loads[] = {10, 100}, lengths[] = {1. / 30, 1. / 60}, gammas[] = {.2, 1}, epsilons[] = {.1, 1e-4};
    for (int k = 0; k < 64; k++) {
        const int parts = 1 << (k & 3);
        const double F = loads[k >> 2 & 1];
        const MeReal h = lengths[k >> 3 & 1], gamma = (MeReal)gammas[k >> 4 & 1];
        const MeReal epsilon = epsilons[k >> 5 & 1];
        MdtWorldID w = scene_world(1, 1, F);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MdtBSJointID joint = MdtBSJointCreate(w);
        double p[3];
        MeMatrix3 inertia;
        MdtBodyGetInertiaTensor(b, inertia);
        const double size = sqrt(inertia[0][0]);
        MdtWorldSetEpsilon(w, epsilon);
        MdtWorldSetGamma(w, gamma);
        MdtWorldSetSubSteps(w, parts);
        MdtBSJointSetBodies(joint, b, 0);
        MdtBSJointSetPosition(joint, 0, 0, 0);
        MdtBSJointEnable(joint);
        steps(w, 1000, h);
        measure_position(b, p);
        const double sag = (double)epsilon * F * (double)h * (double)h / (double)gamma;
        const double share = 1 - pow(1 - (double)gamma, 1. / parts), allowed = 1e-6 * sag + 1e-12 * size / share;
        ck_assert_msg(fabs(-p[1] - sag) <= allowed, "ε %g, γ %g, h 1/%g, F %g, %d parts: %.9g, not %.9g (off by %.2g)",
                      epsilon, gamma, 1 / (double)h, F, parts, -p[1], sag, -p[1] / sag - 1);
        ck_assert(p[0] == 0 && p[2] == 0);
    }
}

static void beginWithOrder2(void) {
    integratorOrder = 2;
}
TEST_FIXTURE(beginWithOrder2, NULL)
