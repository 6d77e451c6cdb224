/* Pulleys: Atwood's machine, also swinging, tackles, slack ropes. */
#include "MdtInternal.h"
#include "measure.h"

typedef struct {
    MdtWorldID world;
    MdtBodyID load[2];
    MdtPulleyID pulley;
} Atwood;

static const double gravity = 10;

/* Two loads 5 m below wheels at the height 0. */
static Atwood makeAtwood(double m0, double m1, double ratio, int isSlack, int first) {
    const double mass[2] = {m0, m1};
    Atwood s;
    s.world = scene_world(4, 8, gravity);
    MdtWorldSetEpsilon(s.world, 0);
    for (int i = 0; i < 2; i++) {
        const int k = i ^ first;
        s.load[k] = scene_body(s.world, mass[k], k, -5, 0);
    }
    s.pulley = MdtPulleyCreate(s.world);
    MdtPulleySetBodies(s.pulley, s.load[0], s.load[1]);
    MdtPulleySetWheel(s.pulley, 0, 0, 0, 0);
    MdtPulleySetWheel(s.pulley, 1, 1, 0, 0);
    MdtPulleySetRatio(s.pulley, (MeReal)ratio);
    MdtPulleySetSlack(s.pulley, isSlack);
    MdtPulleyEnable(s.pulley);
    return s;
}

static double speedOf(MdtBodyID b) {
    double v[3];
    measure_velocity(b, v);
    return v[1];
}

static double sumOf(Atwood s, double ratio) {
    double p[2][3], wheel[3] = {1, 0, 0};
    for (int k = 0; k < 2; k++)
        measure_position(s.load[k], p[k]);
    keaSubtract(p[1], p[1], wheel);
    return keaLength(p[0]) + ratio * keaLength(p[1]);
}

/* The second load falls with a = (m_1 - r m_0) g / (m_1 + r² m_0), the first rises with r a; tension m_0 (g + r a). */
TEST(atwoods_machine) {
    static const double mass[][2] = {{1, 3}, {3, 1}, {1, 1}, {1, 1e4}, {1e4, 1}, {.01, .02}};
    for (int m = 0; m < 6; m++)
        for (int ratio = 1; ratio <= 2; ratio++)
            for (int variant = 0; variant < 4; variant++)
                for (int part = 1; part <= 8; part *= 2) {
                    const double m0 = mass[m][0], m1 = mass[m][1], r = ratio;
                    const double a = (m1 - r * m0) * gravity / (m1 + r * r * m0), time = 8 / 30.;
                    Atwood s = makeAtwood(m0, m1, r, variant & 1, variant >> 1);
                    ck_assert(fabs((double)MdtPulleyGetLength(s.pulley) - 5 * (1 + r)) < 1e-6);
                    steps(s.world, 8 * part, (MeReal)(1. / (30 * part)));
                    assert_near(speedOf(s.load[1]), -a * time, TOL(4e-6, 1e-7));
                    assert_near(speedOf(s.load[0]), r * a * time, TOL(4e-6, 1e-7));
                    assert_near_rel(MdtPulleyGetTension(s.pulley), m0 * (gravity + r * a), TOL(1e-5, 1e-6));
                    assert_near(sumOf(s, r), 5 * (1 + r), TOL(2e-6, 1e-7));
                }
}

/* A load that swings, with the other one as its counterweight: energy is kept to second order, the length to
 * rounding. */
static double energyOf(Atwood s) {
    double sum = 0;
    for (int k = 0; k < 2; k++) {
        double p[3], v[3];
        measure_position(s.load[k], p);
        measure_velocity(s.load[k], v);
        sum += (double)MdtBodyGetMass(s.load[k]) * (.5 * keaDot(v, v) + gravity * p[1]);
    }
    return sum;
}

static double worstEnergy(int part) {
    Atwood s = makeAtwood(1, 3, 1, 0, 0);
    MdtBodySetPosition(s.load[0], (MeReal)(-2 * sin(1.2)), (MeReal)(-2 * cos(1.2)), 0);
    MdtBodySetPosition(s.load[1], 1, -3, 0);
    MdtPulleySetWheel(s.pulley, 1, 1, 0, 0); /* measures the length again */
    const double start = energyOf(s);
    double max = 0;
    for (int i = 0; i < 300 * part; i++) {
        MdtWorldStep(s.world, (MeReal)(1. / (30 * part)));
        max = fmax(max, fabs(energyOf(s) - start));
        assert_near(sumOf(s, 1), 5, TOL(2e-6, 1e-8));
    }
    return max;
}

TEST(a_swinging_machine_keeps_its_energy) {
    const double coarse = worstEnergy(2), fine = worstEnergy(4);
    ck_assert_msg(coarse < .3 && fine < .4 * coarse, "%g J, with half of the step %g J, of 97 J", coarse, fine);
}

/* Thrown up, the first load leaves the rope slack: it flies, and the other one falls, until the rope is taut. */
TEST(a_slack_rope_does_not_push) {
    Atwood s = makeAtwood(1, 1, 1, 1, 0);
    MdtBodySetLinearVelocity(s.load[0], 0, 4, 0);
    MdtBodySetLinearVelocity(s.load[1], 0, 1, 0);
    steps(s.world, 6, FRAME);
    assert_near(speedOf(s.load[0]), 4 - gravity * .1, TOL(2e-6, 1e-7));
    assert_near(speedOf(s.load[1]), 1 - gravity * .1, TOL(2e-6, 1e-7));
    ck_assert(MdtPulleyGetTension(s.pulley) == 0);
    Atwood stiff = makeAtwood(1, 1, 1, 0, 0);
    MdtBodySetLinearVelocity(stiff.load[0], 0, 4, 0);
    MdtBodySetLinearVelocity(stiff.load[1], 0, 1, 0);
    steps(stiff.world, 6, FRAME);
    assert_near(speedOf(stiff.load[0]) + speedOf(stiff.load[1]), 0, TOL(2e-5, 2e-5));
}

/* The loads fall freely by 1 m before the rope is taut, with the same speed: there it stops both at once. */
TEST(a_slack_rope_stops_what_falls_into_it) {
    Atwood s = makeAtwood(1, 1, 1, 1, 0);
    MdtPulleySetLength(s.pulley, 12);
    double lowest = 0;
    for (int i = 0; i < 120; i++) {
        MdtWorldStep(s.world, FRAME);
        lowest = fmax(lowest, sumOf(s, 1) - 12);
    }
    assert_near(lowest, 0, TOL(5e-6, 1e-6));
    assert_near(speedOf(s.load[0]), 0, TOL(1e-4, 1e-4));
    assert_near_rel(MdtPulleyGetTension(s.pulley), gravity, TOL(1e-4, 1e-4));
}

/* The heavier load stands on the ground: the rope carries the weight of the other one, by either solver. */
TEST(a_load_that_stands) {
    for (int run = 0; run < 4; run++) {
        Atwood s = makeAtwood(5, 2, 1, run & 1, 0);
        MdtWorldSetSolver(s.world, run & 2 ? MdtSolverFast : MdtSolverExact);
        MdtContactID ground = MdtContactCreateBetween(s.world, s.load[0], NULL);
        MdtContactSetPosition(ground, 0, -5, 0);
        MdtContactSetNormal(ground, 0, 1, 0);
        MdtContactEnable(ground);
        MdtWorldEnableReport(s.world);
        MdtReport report;
        steps(s.world, 30, FRAME);
        MdtWorldGetReport(s.world, &report);
        ck_assert_int_eq(report.way == MdtReportWayFast, (run & 2) != 0);
        steps(s.world, 30, FRAME);
        MeVector3 f;
        MdtContactGetForce(ground, 0, f);
        assert_near(f[1], 3 * gravity, TOL(1e-3, 1e-3));
        assert_near(MdtPulleyGetTension(s.pulley), 2 * gravity, TOL(1e-3, 1e-3));
        assert_near(speedOf(s.load[1]), 0, TOL(1e-5, 1e-5));
    }
}

/* A winch: the program changes the length. */
TEST(a_length_that_changes_lifts) {
    Atwood s = makeAtwood(1, 1, 1, 1, 0);
    for (int i = 0; i < 300; i++) {
        MdtPulleySetLength(s.pulley, (MeReal)(10 - .5 * i / 60.));
        MdtWorldStep(s.world, FRAME);
    }
    /* gamma of an error is removed in a step, so that it lags by (1 - gamma) / gamma of a step's change */
    assert_near(sumOf(s, 1), 10 - .5 * (299 - 4) / 60, TOL(1e-5, 1e-6));
}

/* Wheels in the world go with it when the origin is moved. */
TEST(wheels_move_with_the_origin) {
    static const double by[3] = {64, -32, 8};
    Atwood s = makeAtwood(1, 3, 1, 0, 0);
    steps(s.world, 30, FRAME);
    const double before = MdtPulleyGetDistance(s.pulley, 0);
    ck_assert(MdtWorldShift(s.world, by));
    MeVector3 wheel;
    MdtPulleyGetWheel(s.pulley, 1, wheel);
    assert_vec3_near(wheel, 65, -32, 8, 0);
    assert_near(MdtPulleyGetDistance(s.pulley, 0), before, TOL(1e-6, 1e-12));
    steps(s.world, 30, FRAME);
    assert_near(speedOf(s.load[1]), -5, TOL(1e-5, 1e-6));
}

/* One end in the world: the rope only holds the other one, as a rod. */
TEST(one_end_may_be_the_world) {
    for (int which = 0; which < 2; which++) {
        Atwood s = makeAtwood(1, 1, 1, 0, 0);
        MdtPulleyDisable(s.pulley);
        MdtPulleySetBodies(s.pulley, which ? s.load[0] : NULL, which ? NULL : s.load[1]);
        MdtPulleyEnable(s.pulley);
        steps(s.world, 60, FRAME);
        assert_near(speedOf(s.load[1 - which]), 0, TOL(1e-6, 1e-9));
        assert_near(speedOf(s.load[which]), -gravity, TOL(1e-5, 1e-7));
        assert_near_rel(MdtPulleyGetTension(s.pulley), gravity, TOL(1e-6, 1e-8));
    }
}

/* A load that is drawn into its wheel passes it: nothing is infinite, and it is warned of at the wheel. */
TEST(a_load_passes_its_wheel) {
    Atwood s = makeAtwood(1, 3, 1, 0, 0);
    for (int i = 0; i < 240; i++) {
        MdtWorldStep(s.world, FRAME);
        ck_assert(isfinite(energyOf(s)));
    }
    MdtBodySetPosition(s.load[0], 0, 0, 0);
    MdtWorldStep(s.world, FRAME);
    ck_assert(isfinite(energyOf(s)) && caught.warnings > 0 && strstr(caught.last, "Pulley"));
    messages_forget();
}
