/* The fast solver by itself. Bodies are of 1 kg and 1 kg m², so that sizes are 1 m; y is up, and loads give 1/8 m/s in
 * a step. */
#include "system.h"

static const double h = 1. / 64, gravity = 8;
static MdtKeaManifold manifold[MAX_BODIES];

/* Manifolds are of a point between the first body and the ground. Any residual is small enough. */
static void begin(int numBodies, int numManifolds, int maxRows) {
    system_begin(numBodies, maxRows, 0, h);
    for (int i = 0; i < numBodies; i++)
        setBody(i, 1, 1, 0);
    memset(manifold, 0, sizeof manifold);
    for (int i = 0; i < numManifolds; i++)
        manifold[i] =
            (MdtKeaManifold){.body = {0, MdtKeaWORLD}, .numPoints = 1, .normal = {0, 1, 0}, .direction = {1, 0, 0}};
    s.numManifolds = numManifolds;
    s.manifolds = manifold;
    s.parameters =
        (MdtKeaParameters){.stepsize = h, .gamma = 0.25, .softening = 1, .solver = MdtKeaSolverFast, .accuracy = 1e9};
}

static void solve(void) {
    system_init();
    step();
    end();
}

/* A column that has just been put together; its bodies are of 1 kg, but for the last one. */
static void solveColumn(int count, double last, double accuracy) {
    begin(count, count, 0);
    for (int i = 0; i < count; i++) {
        const double m = i + 1 < count ? 1 : last;
        body[i].invMass = 1 / m;
        body[i].force[1] = -gravity * m;
        body[i].position[1] = i + 0.5;
        manifold[i].body[0] = i;
        manifold[i].body[1] = i - 1;
        manifold[i].point[0].position[1] = i;
    }
    s.parameters.accuracy = accuracy;
    solve();
}

TEST(passes_end_where_the_accuracy_is_met) {
    int before = 0;
    for (double accuracy = 1e-2; accuracy > 1e-6; accuracy *= 0.1) {
        solveColumn(4, 1, accuracy);
        ck_assert_int_ge(s.report.iterations, before);
        assert_below(s.report.excess, 1);
        before = s.report.iterations;
    }
}

/* A residual that is harmless between equal bodies is not where a light body carries a heavy one: what passes cannot
 * settle is told. */
TEST(mass_ratios_ask_for_smaller_residuals) {
    solveColumn(2, 1, 1e-3);
    assert_below(s.report.excess, 1);
    solveColumn(2, 1e4, 1e-3);
    assert_below(10, s.report.excess);
}

/* m by which a body that rests with that overlap is lifted in a step. */
static double liftAt(double depth) {
    begin(1, 1, 0);
    manifold[0].point[0].depth = depth;
    solve();
    return body[0].position[1];
}

TEST(overlaps_are_taken_away_but_for_those_of_rest) {
    ck_assert(liftAt(1e-5) == 0);
    for (double depth = 1e-3; depth < 1; depth *= 10) {
        assert_below(0.5 * depth, liftAt(depth));
        assert_below(liftAt(depth), depth);
    }
}

/* m/s with which a contact, or a joint, of that compliance gives way to a load: E p of the impulse p that leaves it
 * that velocity. */
TEST(compliance_yields_to_a_load) {
    const double soft[] = {1.6e-3, .1, 10};
    for (int i = 0; i < 3; i++) {
        const double yield = gravity * h * soft[i] / (1 + soft[i]);
        begin(1, 1, 0);
        body[0].force[1] = -gravity;
        s.parameters.epsilon = soft[i];
        solve();
        assert_near(body[0].velocity[1], -yield, 1e-7);
        begin(1, 0, 1);
        body[0].force[0] = gravity;
        system_init();
        MdtKeaRow *row = addAlongX(0, MdtKeaWORLD);
        row->position = METRUE;
        row->softness = soft[i];
        step();
        end();
        assert_near(body[0].velocity[0], yield, 1e-7);
    }
}

/* Of a ball that meets the ground with 1 m/s. */
TEST(no_restitution_gains_energy) {
    for (double more = 1e-6; more < 1; more *= 10) {
        begin(1, 1, 0);
        body[0].velocity[1] = -1;
        manifold[0].surface.restitution = 1 + more;
        solve();
        assert_near(body[0].velocity[1], 1, 1e-5);
    }
}

/* m/s along the ground, with friction without bound, of a body that is pulled along it and pressed on it by `down`. */
static double speedOfHeld(double down) {
    begin(1, 1, 0);
    body[0].force[0] = gravity;
    body[0].force[1] = -down;
    manifold[0].surface.coefficient[0] = manifold[0].surface.coefficient[1] = HUGE_VAL;
    solve();
    return body[0].velocity[0];
}

TEST(friction_without_bound_holds_with_any_load) {
    assert_near(speedOfHeld(1e-6 * gravity), 0, 1e-7);
    assert_near(speedOfHeld(-gravity), gravity * h, 1e-7);
}
