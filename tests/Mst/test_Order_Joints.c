/* The order of both solvers' motion with joints: of bars that swing, or turn. A box that lies on the ground is tied to
 * them by a spring without stiffness, so that the partition has contacts, which the fast solver is asked for. */
#include "order.h"

static double length, thickness, height;
static MdtBodyID bar[2];

static void setUp(int which) {
    solver = solvers[which];
    step = 1. / 60;
    length = 1;
    thickness = .1;
    height = 5;
}

static void begin(void) {
    order_begin();
    MdtWorldEnableReport(u->world);
    bar[0] = bar[1] = 0;
}

/* Of 1 kg, along x from x0 on, without a model. */
static MdtBodyID makeBar(double x0) {
    const double along = thickness * thickness / 6, across = (length * length + thickness * thickness) / 12;
    MeMatrix3 inertia;
    const MdtBodyID body = MdtBodyCreate(u->world);
    memset(inertia, 0, sizeof inertia);
    inertia[0][0] = along;
    inertia[1][1] = inertia[2][2] = across;
    MdtBodySetMass(body, 1);
    MdtBodySetInertiaTensor(body, inertia);
    MdtBodySetPosition(body, (x0 + length / 2), 0, height);
    MdtBodyEnable(body);
    return body;
}

static void tieBox(MdtBodyID body) {
    universe_addFloor();
    const MdtBodyID box = order_addBox(1, 1, 1);
    const MdtSpringID spring = MdtSpringCreate(u->world);
    MdtBodySetPosition(box, 0, 0, .5);
    MdtSpringSetBodies(spring, body, box);
    MdtSpringSetStiffness(spring, 0);
    MdtSpringSetDamping(spring, 0);
    MdtSpringEnable(spring);
}

static void hang(int count, const MeVector3 axis) {
    for (int i = 0; i < count; i++) {
        bar[i] = makeBar(length * i);
        order_join(MdtHingeCreate(u->world), bar[i], i > 0 ? bar[i - 1] : 0, length * i, height, axis);
    }
    tieBox(bar[0]);
}

static void stepAll(double seconds) {
    MdtReport r;
    stepFor(seconds);
    ck_assert(MdtWorldGetReport(u->world, &r));
    ck_assert_int_eq(r.way == MdtReportWayFast, solver == MdtSolverFast);
}

/* J, of the bars, against the height of the hinge. */
static double energy(void) {
    double sum = 0;
    for (int i = 0; i < 2 && bar[i]; i++) {
        MeVector3 x;
        MdtBodyGetPosition(bar[i], x);
        sum += gravity * ((double)x[2] - height) + MdtBodyGetKineticEnergy(bar[i]);
    }
    return sum;
}

static double lossOfSwing(void) {
    begin();
    hang(1, level);
    stepAll(10);
    return fabs(energy()) / (gravity * length / 2);
}

/* From level: of gravity's work down to the lowest place the fast solver loses 3e-3, the exact one 4e-6; with half the
 * step less than a quarter of that, to rounding. */
LOOP_TEST(a_bar_that_swings_keeps_its_energy, 0, SOLVERS) {
    setUp(_i);
    double before = solver == MdtSolverFast ? 1e-2 : 1e-5;
    for (step = 1. / 60; step > 1. / 250; step /= 2) {
        const double loss = lossOfSwing();
        assert_below(loss, before);
        before = loss / 4 + 1e-5;
    }
}

/* Bars of all sizes, up to .45 rad a step. Thin ones are the hard case: their moments of inertia differ by up to 5000
 * times, and a small error of the angular momentum is a large velocity about the long axis. */
LOOP_TEST(a_bar_that_turns_steadily_keeps_its_energy, 0, SOLVERS) {
    static const double lengths[] = {.1, 1, 10}, shares[] = {.01, .1, .5}, turns[] = {.1, .27, .45};
    setUp(_i);
    height = 20;
    for (int i = 0; i < 27; i++) {
        length = lengths[i / 9];
        thickness = shares[i / 3 % 3] * length;
        const double spin = turns[i % 3] / step;
        begin();
        hang(1, upright);
        MdtBodySetAngularVelocity(bar[0], 0, 0, spin);
        MdtBodySetLinearVelocity(bar[0], 0, (spin * length / 2), 0);
        const double before = energy(), turn = turns[i % 3];
        stepAll(10);
        const double max = solver == MdtSolverExact ? 1e-6 : turn < .2 ? 1e-4 : 1e-3;
        ck_assert_msg(fabs(energy() - before) < max * before, "length %g, thickness %g, %g rad a step: %g of 1", length,
                      thickness, turn, energy() / before - 1);
    }
}

/* Where the lower of two bars is that fall from level. */
static void fallFor(double seconds, MeVector3 place) {
    begin();
    hang(2, level);
    stepAll(seconds);
    MdtBodyGetPosition(bar[1], place);
}

static double fallError(double seconds, const MeVector3 reference) {
    MeVector3 place;
    fallFor(seconds, place);
    return hypot((double)place[0] - (double)reference[0], (double)place[2] - (double)reference[2]);
}

/* With half the step a quarter of the error. */
LOOP_TEST(two_bars_fall_with_an_error_of_second_order, 0, SOLVERS) {
    const double seconds = .8;
    MeVector3 reference;
    double error[3];
    setUp(_i);
    solver = MdtSolverExact;
    step = 1. / 1920;
    fallFor(seconds, reference);
    solver = solvers[_i];
    for (int i = 0; i < 3; i++) {
        step = 1. / (60 << i);
        error[i] = fallError(seconds, reference);
        assert_near(i > 0 ? error[i - 1] / error[i] : 4.25, 4.25, .75);
    }
}
