/* The order of both solvers' motion with joints: of bars that swing, or turn. A box that lies on the ground is tied to
 * them by a spring without stiffness, so that the partition has contacts, which the fast solver is asked for. */
#include "Mst.h"
#include "karma_test.h"
#include <string.h>

static const double gravity = 9.81;
static double length, thickness, height;

static MstUniverseID u;
static MdtBodyID bar[2];
static double step;
static MdtSolver solver;

static const MdtSolver solvers[] = {MdtSolverFast, MdtSolverExact};
enum { SOLVERS = sizeof solvers / sizeof *solvers };

static void tearDown(void) {
    MstUniverseDestroy(u);
}

static void begin(void) {
    tearDown();
    u = MstUniverseCreate(&MstUniverseGrowingSizes);
    MdtWorldSetSolver(u->world, solver);
    MdtWorldSetTimedContacts(u->world, 0);
    MdtWorldSetGravity(u->world, 0, 0, (MeReal)-gravity);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldEnableReport(u->world);
    bar[0] = bar[1] = 0;
}

static void setUp(void) {
    step = 1. / 60;
    length = 1;
    thickness = .1;
    height = 5;
    u = MstUniverseCreate(0);
}
TEST_FIXTURE(setUp, tearDown)

/* Of 1 kg, along x from x0 on, without a model. */
static MdtBodyID makeBar(double x0) {
    const double along = thickness * thickness / 6, across = (length * length + thickness * thickness) / 12;
    MeMatrix3 inertia;
    const MdtBodyID body = MdtBodyCreate(u->world);
    memset(inertia, 0, sizeof inertia);
    inertia[0][0] = (MeReal)along;
    inertia[1][1] = inertia[2][2] = (MeReal)across;
    MdtBodySetMass(body, 1);
    MdtBodySetInertiaTensor(body, inertia);
    MdtBodySetPosition(body, (MeReal)(x0 + length / 2), 0, (MeReal)height);
    MdtBodyEnable(body);
    return body;
}

static void joinByHinge(MdtBodyID a, MdtBodyID b, double x, const MeVector3 axis) {
    const MdtHingeID hinge = MdtHingeCreate(u->world);
    const MdtConstraintID c = MdtHingeQuaConstraint(hinge);
    MdtHingeSetBodies(hinge, a, b);
    MdtConstraintSetPosition(c, (MeReal)x, 0, (MeReal)height);
    MdtConstraintSetAxis(c, axis[0], axis[1], axis[2]);
    MdtHingeEnable(hinge);
}

static void tieBox(MdtBodyID body) {
    static MeMatrix4 ground;
    MeMatrix4TMMakeIdentity(ground);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), ground);
    const MdtBodyID box = McdModelGetBody(MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 1, 1, 1), 1));
    const MdtSpringID spring = MdtSpringCreate(u->world);
    MdtBodySetPosition(box, 0, 0, (MeReal).5);
    MdtSpringSetBodies(spring, body, box);
    MdtSpringSetStiffness(spring, 0);
    MdtSpringSetDamping(spring, 0);
    MdtSpringEnable(spring);
}

static void hang(int count, const MeVector3 axis) {
    for (int i = 0; i < count; i++) {
        bar[i] = makeBar(length * i);
        joinByHinge(bar[i], i > 0 ? bar[i - 1] : 0, length * i, axis);
    }
    tieBox(bar[0]);
}

static void stepFor(double seconds) {
    for (int i = 0, n = (int)lround(seconds / step); i < n; i++)
        MstUniverseStep(u, (MeReal)step);
    MdtReport r;
    ck_assert(MdtWorldGetReport(u->world, &r));
    ck_assert_int_eq(r.way == MdtReportWayFast, solver == MdtSolverFast);
}

/* J, of the bars, against the height of the hinge. */
static double energy(void) {
    double sum = 0;
    for (int i = 0; i < 2 && bar[i]; i++) {
        MeVector3 x, v, w;
        MeMatrix4 tm;
        MdtBodyGetPosition(bar[i], x);
        MdtBodyGetLinearVelocity(bar[i], v);
        MdtBodyGetAngularVelocity(bar[i], w);
        MdtBodyGetTransform(bar[i], tm);
        const double v2 = (double)MeVector3Dot(v, v), w2 = (double)MeVector3Dot(w, w);
        const double along = (double)MeVector3Dot(w, tm[0]);
        sum += gravity * ((double)x[2] - height) + .5 * v2 +
               .5 * (w2 - along * along) * (length * length + thickness * thickness) / 12 +
               .5 * along * along * thickness * thickness / 6;
    }
    return sum;
}

static const MeVector3 level = {0, 1, 0}, upright = {0, 0, 1};

static double lossOfSwing(void) {
    begin();
    hang(1, level);
    stepFor(10);
    return fabs(energy()) / (gravity * length / 2);
}

/* From level: of gravity's work down to the lowest place the fast solver loses 3e-3, the exact one 4e-6; with half the
 * step less than a quarter of that, to rounding. */
LOOP_TEST(a_bar_that_swings_keeps_its_energy, 0, SOLVERS) {
    solver = solvers[_i];
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
    solver = solvers[_i];
    height = 20;
    for (int i = 0; i < 27; i++) {
        length = lengths[i / 9];
        thickness = shares[i / 3 % 3] * length;
        const double spin = turns[i % 3] / step;
        begin();
        hang(1, upright);
        MdtBodySetAngularVelocity(bar[0], 0, 0, (MeReal)spin);
        MdtBodySetLinearVelocity(bar[0], 0, (MeReal)(spin * length / 2), 0);
        const double before = energy(), turn = turns[i % 3];
        stepFor(10);
        const double max = solver == MdtSolverExact ? 1e-6 : turn < .2 ? 1e-4 : 1e-3;
        ck_assert_msg(fabs(energy() - before) < max * before, "length %g, thickness %g, %g rad a step: %g of 1", length,
                      thickness, turn, energy() / before - 1);
    }
}

/* Where the lower of two bars is that fall from level. */
static void fallFor(double seconds, MeVector3 place) {
    begin();
    hang(2, level);
    stepFor(seconds);
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
    solver = MdtSolverExact;
    step = 1. / 1920;
    fallFor(seconds, reference);
    solver = solvers[_i];
    step = 1. / 60;
    const double whole = fallError(seconds, reference);
    step = 1. / 120;
    const double half = fallError(seconds, reference);
    step = 1. / 240;
    const double quarter = fallError(seconds, reference);
    assert_below(3.5, whole / half);
    assert_below(3.5, half / quarter);
    assert_below(whole / half, 5);
    assert_below(half / quarter, 5);
}
