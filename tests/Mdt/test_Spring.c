/* The spring: Hooke's law, its swing, and what its two stops make of it: rod, string, elastic. */
#include "measure.h"

static const double mass = 2, g = 9.81;

typedef struct {
    MdtWorldID world;
    MdtBodyID body;
    MdtSpringID spring;
    MdtLimitID limit;
} Hung;

/* A body `length` below the world's origin, on a spring to it that is attached there. */
static Hung hang(double gravity, double length) {
    Hung s;
    s.world = scene_world(2, 2, gravity);
    MdtWorldSetEpsilon(s.world, 0);
    s.body = scene_body(s.world, mass, 0, -length, 0);
    s.spring = MdtSpringCreate(s.world);
    MdtSpringSetBodies(s.spring, s.body, 0);
    MdtSpringSetPosition(s.spring, 1, 0, 0, 0);
    MdtSpringEnable(s.spring);
    s.limit = MdtSpringGetLimit(s.spring);
    return s;
}

static double lengthOf(Hung s) {
    double p[3];
    measure_position(s.body, p);
    return keaLength(p);
}

static void setStop(Hung s, int side, double stiffness, double damping, double restitution) {
    MdtSingleLimitID stop = side == 0 ? MdtLimitGetLowerLimit(s.limit) : MdtLimitGetUpperLimit(s.limit);
    MdtSingleLimitSetStiffness(stop, stiffness);
    MdtSingleLimitSetDamping(stop, damping);
    MdtSingleLimitSetRestitution(stop, restitution);
}

/* ---- spring ---- */

TEST(the_default_is_a_spring_at_the_distance_of_attaching) {
    Hung s = hang(0, .7);
    assert_near(MdtSingleLimitGetStop(MdtLimitGetLowerLimit(s.limit)), .7, TOL(1e-7, 7e-14));
    assert_near(MdtSingleLimitGetStop(MdtLimitGetUpperLimit(s.limit)), .7, TOL(1e-7, 7e-14));
    steps(s.world, 100, FRAME);
    assert_near(lengthOf(s), .7, TOL(1e-7, 7e-14)); /* it is at rest */
    MdtBodySetPosition(s.body, 0, -1, 0);
    steps(s.world, 4500, FRAME);
    assert_near(lengthOf(s), .7, TOL(1e-6, 3e-8)); /* and comes back, damped */
}

/* The User Guide's sample: boxes 6 m apart, attached 1 m inside of their centres, with a natural length of 4 m. By the
 * Dynamics guide's law, which holds, that is their distance: nothing moves. By the User Guide, which adds the length to
 * the initial separation, boxes come to rest 10 m apart: with the initial distance in the length, they do. */
TEST(the_natural_length_is_the_distance_without_load) {
    for (int added = 0; added < 2; added++) {
        const double initial = 4, length = 4 + added * initial;
        MdtWorldID w = scene_world(2, 1, 0);
        MdtBodyID box[2] = {scene_body(w, 100, 0, 3, 0), scene_body(w, 100, 0, -3, 0)};
        MdtSpringID spring = MdtSpringCreate(w);
        double p[2][3];
        MdtWorldSetEpsilon(w, 0);
        MdtSpringSetBodies(spring, box[0], box[1]);
        MdtSpringSetPosition(spring, 0, 0, 2, 0);
        MdtSpringSetPosition(spring, 1, 0, -2, 0);
        MdtSpringSetNaturalLength(spring, length);
        MdtSpringSetStiffness(spring, 1000);
        MdtSpringSetDamping(spring, 400);
        MdtSpringEnable(spring);
        steps(w, 900, FRAME);
        for (int i = 0; i < 2; i++)
            measure_position(box[i], p[i]);
        assert_near(p[0][1] - p[1][1], length + 2, TOL(2e-6, 3e-12));
        assert_near(p[0][1] + p[1][1], 0, TOL(2e-6, 3e-12));
    }
}

TEST(hooke_s_law) {
    const double ks[] = {50, 200, 1000}, lengths[] = {0, .5, 1};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            Hung s = hang(g, .7);
            double f[3];
            MdtSpringSetStiffness(s.spring, ks[i]);
            MdtSpringSetDamping(s.spring, 15);
            MdtSpringSetNaturalLength(s.spring, lengths[j]);
            steps(s.world, 2000, FRAME);
            assert_near(lengthOf(s), lengths[j] + mass * g / ks[i], TOL(2e-6, 1e-9));
            assert_near(MdtLimitGetPosition(s.limit), lengthOf(s), TOL(1e-6, 2e-13));
            read_force(MdtSpringQuaConstraint(s.spring), 0, f);
            assert_vec3_near(f, 0, mass * g, 0, TOL(2e-5, 5e-7));
        }
}

/* A body pushed together pushes back: -k (d - l) with d < l. */
TEST(it_resists_compression_too) {
    Hung s = hang(0, .7);
    double f[3];
    MdtSpringSetStiffness(s.spring, 100);
    MdtSpringSetDamping(s.spring, 20);
    for (int i = 0; i < 1000; i++) {
        MdtBodyAddForce(s.body, 0, 30, 0);
        MdtWorldStep(s.world, FRAME);
    }
    assert_near(lengthOf(s), .7 - .3, TOL(4e-7, 8e-10));
    read_force(MdtSpringQuaConstraint(s.spring), 0, f);
    assert_vec3_near(f, 0, -30, 0, TOL(3e-5, 5e-7));
}

TEST(it_swings_as_a_damped_spring) {
    const double ks[] = {20, 80, 320}, ds[] = {0, .5, 2};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            Hung s = hang(g, .7);
            Swing swing = {0};
            const double w0 = sqrt(ks[i] / mass), decay = ds[j] / (2 * mass), h = FRAME;
            const double rest = 5 + mass * g / ks[i];
            MdtSpringSetStiffness(s.spring, ks[i]);
            MdtSpringSetDamping(s.spring, ds[j]);
            MdtSpringSetNaturalLength(s.spring, 5);
            MdtBodySetPosition(s.body, 0, (MeReal) - (rest + .2), 0);
            for (int n = 0; n < 5000 && swing.crossings < 12; n++) {
                MdtWorldStep(s.world, FRAME);
                swing_add(&swing, lengthOf(s) - rest);
            }
            ck_assert_int_eq(swing.crossings, 12);
            swing_check(&swing, w0, decay, h, TOL(2e-5, 1e-8)); /* 0.3 mm are left of 20 cm, in single precision */
        }
}

/* Two bodies swing against each other with the reduced mass. */
TEST(between_two_bodies_the_reduced_mass_counts) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0), b = scene_body(w, 3, 1, 0, 0);
    MdtSpringID spring = MdtSpringCreate(w);
    Swing swing = {0};
    MdtSpringSetBodies(spring, a, b);
    MdtSpringSetStiffness(spring, 30);
    MdtSpringSetDamping(spring, 0);
    MdtSpringSetNaturalLength(spring, .8);
    MdtSpringEnable(spring);
    for (int n = 0; n < 2000 && swing.crossings < 20; n++) {
        double p[3], q[3];
        MdtWorldStep(w, FRAME);
        measure_position(a, p);
        measure_position(b, q);
        swing_add(&swing, q[0] - p[0] - .8);
        assert_near(p[0] + 3 * q[0], 3, TOL(3e-6, 3e-13));
    }
    swing_check(&swing, sqrt(30 / .75), 0, FRAME, TOL(1e-5, 1e-8));
}

/* Attached beside its centre, the body is turned by the spring, and nothing else holds its orientation. */
TEST(there_is_no_angular_constraint) {
    const double edge[3] = {1, .2, .2};
    Hung s = hang(g, 1);
    MeMatrix3 I;
    MdtMakeInertiaTensorBox(mass, edge[0], edge[1], edge[2], I);
    MdtBodySetInertiaTensor(s.body, I);
    MdtSpringSetPosition(s.spring, 0, .4, -1, 0);
    MdtBodySetAngularVelocityDamping(s.body, 2);
    MdtBodySetLinearVelocityDamping(s.body, 1);
    MdtSpringSetStiffness(s.spring, 200);
    steps(s.world, 3000, FRAME);
    double p[3], x[3] = {1, 0, 0}, axis[3];
    measure_position(s.body, p);
    measure_turnOut(s.body, x, axis);
    assert_near(p[0], 0, TOL(1e-6, 5e-12)); /* it hangs below, its long axis upright */
    assert_vec3_near(axis, 0, 1, 0, TOL(1e-6, 4e-12));
}

/* ---- rod, string, elastic ---- */

TEST(a_rod_keeps_its_length) {
    Hung s = hang(g, 1);
    double f[3];
    MdtSpringSetStiffness(s.spring, MEINFINITY);
    MdtBodySetLinearVelocity(s.body, 3, 0, 1);
    for (int i = 0; i < 600; i++) {
        MdtWorldStep(s.world, FRAME);
        assert_near(lengthOf(s), 1, TOL(1e-6, 3e-10));
        ck_assert_int_eq(MdtConstraintGetRowCount(MdtSpringQuaConstraint(s.spring)), 1);
    }
    s = hang(-g, 1); /* pushed, too: weight upwards, from the balance that it cannot leave by itself */
    MdtSpringSetStiffness(s.spring, MEINFINITY);
    steps(s.world, 60, FRAME);
    assert_near(lengthOf(s), 1, TOL(1e-6, 5e-12));
    read_force(MdtSpringQuaConstraint(s.spring), 0, f);
    assert_vec3_near(f, 0, -mass * g, 0, TOL(2e-5, 2e-11));
}

/* Natural length moves a rod's bodies. */
TEST(a_rod_of_another_length) {
    Hung s = hang(0, 1);
    MdtSpringSetStiffness(s.spring, MEINFINITY);
    MdtSpringSetNaturalLength(s.spring, 1.5);
    MdtWorldSetGamma(s.world, .25);
    for (int i = 1; i <= 30; i++) {
        MdtWorldStep(s.world, FRAME);
        assert_near(lengthOf(s), 1.5 - .5 * pow(.75, i), TOL(1e-6, 2e-13));
    }
}

TEST(a_string_pulls_and_does_not_push) {
    Hung s = hang(g, 1);
    double f[3];
    setStop(s, 0, 0, 0, 0);
    setStop(s, 1, MEINFINITY, 0, 0);
    MdtBodySetPosition(s.body, 0, -.5, 0); /* slack: it falls freely for 0.3 s */
    double max = 0;
    for (int i = 0; i < 18; i++) {
        MdtWorldStep(s.world, FRAME);
        read_force(MdtSpringQuaConstraint(s.spring), 0, f);
        assert_near(f[1], 0, 0);
    }
    assert_near(lengthOf(s), .5 + g / 2 * 18 * 18 / 3600, TOL(1e-6, 9e-14));
    for (int i = 0; i < 100; i++) {
        MdtWorldStep(s.world, FRAME);
        max = fmax(max, lengthOf(s));
    }
    assert_near(max, 1, TOL(1e-6, 2e-11));
    assert_near(lengthOf(s), 1, TOL(1e-6, 7e-13));
    read_force(MdtSpringQuaConstraint(s.spring), 0, f);
    assert_near(f[1], mass * g, TOL(2e-5, 2e-12));
}

/* An elastic stretches, and gets no shorter than its length: the other hard side. */
TEST(an_elastic_stretches_and_cannot_be_compressed) {
    Hung s = hang(g, 1);
    setStop(s, 0, MEINFINITY, 0, 0);
    setStop(s, 1, 100, 10, 0);
    steps(s.world, 1200, FRAME);
    assert_near(lengthOf(s), 1 + mass * g / 100, TOL(1e-6, 3e-10));
    for (int i = 0; i < 600; i++) {
        MdtBodyAddForce(s.body, 0, 50, 0);
        MdtWorldStep(s.world, FRAME);
        ck_assert(lengthOf(s) > 1 - 1e-6);
    }
    assert_near(lengthOf(s), 1, TOL(1e-6, 1e-11));
}

/* Above the threshold a stiffness is hard. */
TEST(the_threshold_makes_a_spring_a_rod) {
    Hung s = hang(g, 1);
    MdtSpringSetStiffness(s.spring, 50);
    MdtLimitSetStiffnessThreshold(s.limit, 49);
    steps(s.world, 120, FRAME);
    assert_near(lengthOf(s), 1, TOL(1e-6, 2e-11));
}

/* A limit of the program's own, copied into the spring: a string of 2 m, with a winch. */
TEST(a_winch) {
    Hung s = hang(g, 1);
    MdtBclLimit own;
    MdtLimitReset(&own);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(&own), 2);
    MdtSingleLimitSetStiffness(MdtLimitGetLowerLimit(&own), 0);
    MdtSingleLimitSetRestitution(MdtLimitGetUpperLimit(&own), 0);
    MdtLimitActivateLimits(&own, 1);
    MdtLimitSetLimitedForceMotor(&own, -.5, 100);
    MdtSpringSetLimit(s.spring, &own);
    steps(s.world, 60, FRAME);
    assert_near(lengthOf(s), .5 + .25 / 60, TOL(5e-7, 4e-10)); /* wound up; with half the speed in the first step */
    assert_near(MdtLimitGetVelocity(s.limit), -.5, TOL(5e-7, 7e-10));
    MdtLimitSetLimitedForceMotor(s.limit, 0, 5); /* too weak a brake */
    steps(s.world, 200, FRAME);
    assert_near(lengthOf(s), 2, TOL(1e-6, 2e-12));
}

/* ---- motors of all kinds ---- */

typedef struct {
    double step, frequency, stiffness;
    MeBool isFast; /* solver: by a contact that carries nothing, without which all is solved exactly */
} Setting;

/* Frame rates of 30 to 240 Hz, soft and stiff, both solvers. */
static Setting setting(int i) {
    return (Setting){1.0 / (30 << i % 4), .5 * (1 + i % 3), 40 * pow(5, i % 5), i % 2};
}

enum { SETTINGS = 12 };

static Hung hangFor(Setting x, double gravity, double length) {
    Hung s = hang(gravity, length);
    if (!x.isFast)
        return s;
    MdtContactID c = MdtContactCreateBetween(s.world, s.body, NULL);
    MdtContactSetPosition(c, 0, -1, 0);
    MdtContactSetNormal(c, 0, 0, 1);
    MdtContactParamsSetType(MdtContactGetParams(c), MdtContactTypeFrictionZero);
    MdtContactEnable(c);
    MdtWorldSetSolver(s.world, MdtSolverFast);
    return s;
}

/* A winch of speed v shortens an elastic that is stretched, against spring and load, to its hard stop. */
LOOP_TEST(a_winch_shortens_an_elastic, 0, SETTINGS) {
    const Setting x = setting(_i);
    Hung s = hangFor(x, g, 1);
    const double speed = .2 + .1 * (_i % 3), time = .5;
    setStop(s, 0, MEINFINITY, 0, 0);
    setStop(s, 1, x.stiffness, 5, 0);
    MdtBodySetPosition(s.body, 0, -2, 0);
    MdtLimitSetLimitedForceMotor(s.limit, (MeReal)-speed, 100000);
    MdtBodySetLinearVelocity(s.body, 0, (MeReal)speed, 0);
    steps(s.world, (int)(time / x.step + .5), (MeReal)x.step);
    assert_near(lengthOf(s), 2 - speed * time, TOL(8e-6, 7e-6));
    steps(s.world, (int)(10 / x.step), (MeReal)x.step);
    assert_near(lengthOf(s), 1, TOL(5e-7, 5e-10));
}

/* A position motor beside a spring: two springs side by side, k (d - l) + m w² (d - target) = m g. */
LOOP_TEST(a_position_motor_acts_beside_a_spring, 0, SETTINGS) {
    const Setting x = setting(_i);
    Hung s = hangFor(x, g, 1);
    const double w = 6.283185307179586 * x.frequency, motor = mass * w * w, target = 1.6;
    MdtSpringSetStiffness(s.spring, (MeReal)x.stiffness);
    MdtLimitSetPositionMotor(s.limit, (MeReal)target, (MeReal)x.frequency, 1, 1e5);
    steps(s.world, (int)(20 / x.step), (MeReal)x.step);
    assert_near(lengthOf(s), (mass * g + x.stiffness * 1 + motor * target) / (x.stiffness + motor), TOL(1e-5, 1e-5));
}

/* A lock holds the length of a spring up to its force, and no more. */
LOOP_TEST(a_lock_holds_a_spring, 0, SETTINGS) {
    const Setting x = setting(_i);
    Hung s = hangFor(x, g, 1);
    MdtSpringSetStiffness(s.spring, (MeReal)x.stiffness);
    MdtSpringSetDamping(s.spring, 20);
    MdtLimitSetLock(s.limit, (MeReal).8, 1e6);
    steps(s.world, (int)(5 / x.step), (MeReal)x.step);
    assert_near(lengthOf(s), .8, TOL(4e-7, 5e-8));
    MdtLimitSetLock(s.limit, (MeReal).8, 2);
    steps(s.world, (int)(60 / x.step), (MeReal)x.step);
    assert_near(lengthOf(s), fmax(.8, 1 + (mass * g - 2) / x.stiffness), TOL(1.5e-4, 1.5e-4));
}

/* The length of a rod is fixed: neither motor nor lock changes it, or the rod's force. */
LOOP_TEST(a_rod_has_no_motor, 0, SETTINGS) {
    const Setting x = setting(_i);
    Hung s = hangFor(x, g, 1);
    double f[3];
    MdtSpringSetStiffness(s.spring, MEINFINITY);
    if (_i % 3 == 0)
        MdtLimitSetPositionMotor(s.limit, (MeReal)1.5, (MeReal)x.frequency, 1, 1000);
    else if (_i % 3 == 1)
        MdtLimitSetLimitedForceMotor(s.limit, -1, 1000);
    else
        MdtLimitSetLock(s.limit, 2, 1000);
    steps(s.world, (int)(2 / x.step), (MeReal)x.step);
    assert_near(lengthOf(s), 1, TOL(5e-7, 2e-11));
    read_force(MdtSpringQuaConstraint(s.spring), 0, f);
    assert_near(f[1], mass * g, TOL(1e-5, 5e-6));
}

/* The ends that were set, in the world; and where they are now. */
TEST(the_ends_move_with_the_bodies) {
    Hung s = hang(0, 1);
    MeVector3 p;
    MdtSpringSetPosition(s.spring, 0, .5, -1, 0);
    MdtBodySetPosition(s.body, 3, 4, 5);
    MdtSpringGetPosition(s.spring, p, 0);
    assert_vec3_near(p, 3.5, 4, 5, TOL(1e-6, 5e-13));
    MdtSpringGetPosition(s.spring, p, 1);
    assert_vec3_near(p, 0, 0, 0, 0);
}
