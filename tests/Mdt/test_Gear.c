/* Gears: wheels on parallel and on crossed shafts, racks, housings. A wheel of the moment 2 about z drives one of the
 * moment 3; both are spheres to everything else. */
#include "MdtInternal.h"
#include "measure.h"

static const double moment[2] = {2, 3};

typedef struct {
    MdtWorldID world;
    MdtBodyID wheel[2];
    MdtHingeID shaft[2];
    MdtGearID gear;
} Pair;

static MdtBodyID makeWheel(MdtWorldID w, double inertia, double x) {
    const MeMatrix3 I = {{(MeReal)inertia, 0, 0}, {0, (MeReal)inertia, 0}, {0, 0, (MeReal)inertia}};
    MdtBodyID b = scene_body(w, 1, x, 0, 0);
    MdtBodySetInertiaTensor(b, I);
    return b;
}

/* first: which wheel is made first. */
static Pair makePair(int n0, int n1, double scale, int first) {
    Pair s;
    s.world = scene_world(2, 3, 0);
    MdtWorldSetEpsilon(s.world, 0);
    for (int i = 0; i < 2; i++) {
        const int k = i ^ first;
        s.wheel[k] = makeWheel(s.world, scale * moment[k], k);
        s.shaft[k] = scene_hinge(s.world, s.wheel[k], 0, k, 0, 0, 0, 0, 1);
    }
    s.gear = MdtGearCreate(s.world);
    MdtGearSetBodies(s.gear, s.wheel[0], s.wheel[1]);
    MdtGearSetAxis(s.gear, 0, 0, 1);
    MdtGearSetTeeth(s.gear, n0, n1);
    MdtGearEnable(s.gear);
    return s;
}

static double rateOf(MdtBodyID b) {
    double w[3];
    measure_rate(b, w);
    return w[2];
}

static void spin(Pair s, double rate, double ratio) {
    MdtBodySetAngularVelocity(s.wheel[0], 0, 0, rate);
    MdtBodySetAngularVelocity(s.wheel[1], 0, 0, -ratio * rate);
}

static double energyOf(Pair s) {
    return .5 * moment[0] * pow(rateOf(s.wheel[0]), 2) + .5 * moment[1] * pow(rateOf(s.wheel[1]), 2);
}

/* ---- motion ---- */

/* A torque at the first wheel feels I_0 + n² I_1. */
TEST(the_second_wheel_adds_its_inertia_times_the_ratio_squared) {
    static const int teeth[][2] = {{30, 10}, {10, 30}, {1, 1}, {-20, 10}, {100, 1}};
    for (int t = 0; t < 5; t++)
        for (int part = 1; part <= 8; part *= 2)
            for (int first = 0; first < 2; first++) {
                const double n = (double)teeth[t][0] / teeth[t][1], torque = 4;
                const double a = torque / (moment[0] + n * n * moment[1]);
                Pair s = makePair(teeth[t][0], teeth[t][1], 1, first);
                for (int i = 0; i < 30 * part; i++) {
                    MdtBodyAddTorque(s.wheel[0], 0, 0, torque);
                    MdtWorldStep(s.world, (MeReal)(1. / (30 * part)));
                }
                assert_near_rel(rateOf(s.wheel[0]), a, TOL(1e-6, 2e-7));
                assert_near_rel(rateOf(s.wheel[1]), -n * a, TOL(1e-6, 2e-7));
                assert_near(MdtGearGetError(s.gear), 0, 1e-8);
            }
}

/* A pendulum whose wheel drives another one: (m l² + n² I) θ'' = -m g l sin θ. Its period is of second order in h. */
static double angleOfPendulum(double h) {
    const double mass = 2, n = 3, g = 10;
    MdtWorldID w = scene_world(2, 3, g);
    MdtBodyID bob = makeWheel(w, 1, 1), wheel = makeWheel(w, moment[1], 5);
    MdtBodySetMass(bob, mass);
    MdtWorldSetEpsilon(w, 0);
    scene_hinge(w, bob, 0, 0, 0, 0, 0, 0, 1);
    scene_hinge(w, wheel, 0, 5, 0, 0, 0, 0, 1);
    MdtGearID gear = MdtGearCreate(w);
    MdtGearSetBodies(gear, bob, wheel);
    MdtGearSetAxis(gear, 0, 0, 1);
    MdtGearSetRatio(gear, n);
    MdtGearEnable(gear);
    steps(w, (int)(1.5 / h + .5), (MeReal)h);
    assert_near(MdtGearGetCoordinate(gear, 1), -n * (double)MdtGearGetCoordinate(gear, 0), TOL(2e-6, 1e-9));
    return MdtGearGetCoordinate(gear, 0);
}

/* The same by small steps of the classical method of order 4. */
static double angleOfEquation(void) {
    const double inertia = 1 + 2 + 9 * moment[1], h = 1e-4;
    double x = 0, v = 0;
    for (int i = 0; i < 15000; i++) {
        double k[4], l[4], dx = 0, dv = 0;
        for (int j = 0; j < 4; j++) {
            const double part = j == 0 ? 0 : j == 3 ? h : h / 2;
            k[j] = v + part * (j > 0 ? l[j - 1] : 0);
            l[j] = -2 * 10 * cos(x + part * (j > 0 ? k[j - 1] : 0)) / inertia;
            dx += h / 6 * (j == 0 || j == 3 ? 1 : 2) * k[j];
            dv += h / 6 * (j == 0 || j == 3 ? 1 : 2) * l[j];
        }
        x += dx;
        v += dv;
    }
    return x;
}

TEST(a_quarter_of_the_error_with_half_of_the_step) {
    const double exact = angleOfEquation();
    double error[4];
    for (int i = 0; i < 4; i++)
        error[i] = angleOfPendulum(1. / (30 << i)) - exact;
    for (int i = 0; i < 3; i++)
        assert_near(error[i] / error[i + 1], 4, TOL(.5, .2));
    ck_assert(fabs(error[3]) < 2e-5);
}

/* Also where a wheel turns by 5 rad in a step. */
TEST(wheels_that_spin_keep_energy_and_ratio) {
    static const double rate[] = {.1, 1, 10, 100};
    for (int i = 0; i < 4; i++)
        for (int part = 1; part <= 4; part *= 2) {
            Pair s = makePair(30, 10, 1, 0);
            spin(s, rate[i], 3);
            const double before = energyOf(s);
            steps(s.world, 200, (MeReal)(1. / (30 * part)));
            assert_near_rel(energyOf(s), before, TOL(1e-6, 1e-10));
            assert_near(rateOf(s.wheel[1]) / rateOf(s.wheel[0]), -3, TOL(1e-6, 1e-9));
        }
}

/* A thousand seconds at 100 rad/s: 16 000 turns of the second wheel. The angle of a step lags, as that of hinges does,
 * where the faster wheel turns by 1.7 rad in it. */
TEST(the_phase_does_not_drift_in_an_hour) {
#ifdef TEST_IS_SLOW
    enum { SECONDS = 20 };
#else
    enum { SECONDS = 1000 };
#endif
    Pair s = makePair(30, 10, 1, 0);
    double max = 0;
    spin(s, 100 / 3., 3);
    for (int i = 0; i < 60 * SECONDS; i++) {
        MdtWorldStep(s.world, FRAME);
        max = fmax(max, fabs((double)MdtGearGetError(s.gear)));
    }
    assert_near(max, 0, 1e-8); /* rad: rounding of 100 000 rad */
    assert_near_rel(MdtGearGetCoordinate(s.gear, 1), -100. * SECONDS, .17);
    /* As seen from outside: the marks of both wheels. */
    double R[2][3][3];
    for (int k = 0; k < 2; k++)
        measure_rotation(s.wheel[k], R[k]);
    const double turn0 = atan2(R[0][1][0], R[0][0][0]), turn1 = atan2(R[1][1][0], R[1][0][0]);
    assert_near(remainder(3 * turn0 + turn1, 2 * 3.14159265358979323846), 0, TOL(2e-6, 1e-8));
}

/* Under load, with the world's epsilon: the sag of a joint, which does not grow. */
TEST(the_phase_does_not_creep_under_load) {
    Pair s = makePair(30, 10, 1, 0);
    MdtWorldSetEpsilon(s.world, 1e-4);
    double after[2];
    for (int run = 0; run < 2; run++) {
        for (int i = 0; i < 600; i++) {
            MdtBodyAddTorque(s.wheel[0], 0, 0, 30);
            MdtBodyAddTorque(s.wheel[1], 0, 0, 10);
            MdtWorldStep(s.world, FRAME);
        }
        after[run] = MdtGearGetError(s.gear);
    }
    assert_near(after[0], 1e-4 * 10 / (3600 * .2), 1e-7); /* epsilon F h² / gamma */
    assert_near(after[1], after[0], TOL(1e-9, 1e-11));
}

/* A heavy wheel on a light one, and the other way round. */
TEST(moments_may_differ_by_ten_thousand) {
    for (int k = 0; k < 2; k++) {
        MdtWorldID w = scene_world(2, 3, 0);
        MdtWorldSetEpsilon(w, 0);
        MdtBodyID a = makeWheel(w, k ? 1e4 : 1, 0), b = makeWheel(w, k ? 1 : 1e4, 1);
        scene_hinge(w, a, 0, 0, 0, 0, 0, 0, 1);
        scene_hinge(w, b, 0, 1, 0, 0, 0, 0, 1);
        MdtGearID gear = MdtGearCreate(w);
        MdtGearSetBodies(gear, a, b);
        MdtGearSetAxis(gear, 0, 0, 1);
        MdtGearSetRatio(gear, 2);
        MdtGearEnable(gear);
        for (int i = 0; i < 60; i++) {
            MdtBodyAddTorque(a, 0, 0, 100);
            MdtWorldStep(w, FRAME);
        }
        assert_near_rel(rateOf(a), 100 / (k ? 1e4 + 4 : 1 + 4e4), TOL(1e-5, 1e-7));
        assert_near_rel(rateOf(b), -2 * rateOf(a), TOL(1e-5, 1e-7));
    }
}

/* ---- kinds ---- */

/* Bevel wheels: the first about z, the second about x. */
TEST(shafts_may_cross) {
    MdtWorldID w = scene_world(2, 3, 0);
    MdtBodyID a = makeWheel(w, 1, 0), b = makeWheel(w, 1, 1);
    scene_hinge(w, a, 0, 0, 0, 0, 0, 0, 1);
    scene_hinge(w, b, 0, 1, 0, 0, 1, 0, 0);
    MdtGearID gear = MdtGearCreate(w);
    MdtGearSetBodies(gear, a, b);
    MdtGearBodySetAxis(gear, 0, 0, 0, 2);
    MdtGearBodySetAxis(gear, 1, 3, 0, 0);
    MdtGearSetRatio(gear, 2);
    MdtGearEnable(gear);
    MeVector3 axis;
    MdtGearBodyGetAxis(gear, 1, axis);
    assert_vec3_near(axis, 1, 0, 0, 1e-6);
    MdtBodySetAngularVelocity(a, 0, 0, 1);
    steps(w, 60, FRAME);
    double rate[3];
    measure_rate(b, rate);
    assert_near(rate[0], -2 * rateOf(a), TOL(1e-6, 1e-9));
    assert_near(rateOf(a), .2, TOL(1e-5, 1e-5)); /* the impulse of the gear: 1 / (1 + 4) */
}

/* A pinion of the radius .25, of the moment 2, and a rack of the mass 3, on which 10 N act. */
TEST(a_rack_moves_by_the_radius_times_the_angle) {
    for (int sign = -1; sign <= 1; sign += 2) {
        MdtWorldID w = scene_world(2, 3, 0);
        MdtWorldSetEpsilon(w, 0);
        const double edge[3] = {1, .1, .1}, r = .25 * sign;
        MdtBodyID pinion = makeWheel(w, 2, 0), rack = scene_box(w, 3, edge, 0, -.25, 0);
        scene_hinge(w, pinion, 0, 0, 0, 0, 0, 0, 1);
        MdtPrismaticID rail = MdtPrismaticCreate(w);
        MdtPrismaticSetBodies(rail, rack, 0);
        MdtPrismaticSetAxis(rail, 1, 0, 0);
        MdtPrismaticEnable(rail);
        MdtGearID gear = MdtGearCreate(w);
        MdtGearSetBodies(gear, pinion, rack);
        MdtGearBodySetAxis(gear, 0, 0, 0, 1);
        MdtGearBodySetAxis(gear, 1, 1, 0, 0);
        MdtGearSetRack(gear, (MeReal)r);
        MdtGearEnable(gear);
        for (int i = 0; i < 120; i++) {
            MdtBodyAddForce(rack, 10, 0, 0);
            MdtWorldStep(w, FRAME);
        }
        const double a = 10 / (3 + 2 / (r * r)), x = .5 * a * 4,
                     lag = pow(2 * a / r / 60, 2) / 12; /* of a turn in a step */
        double p[3], f[3];
        MeVector3 read;
        measure_position(rack, p);
        assert_near(p[0], x, lag * x);
        assert_near_rel(rateOf(pinion), -2 * a / r, lag);
        assert_near(MdtGearGetCoordinate(gear, 0), -x / r, lag * x / fabs(r));
        MdtGearGetForce(gear, 1, read);
        for (int i = 0; i < 3; i++)
            f[i] = read[i];
        assert_near_rel(f[0], 3 * a - 10, lag);
        assert_near(f[1] + f[2], 0, 1e-6);
        assert_near(MdtGearGetError(gear), 0, 1e-8);
        const double by[3] = {64, -32, 8};
        ck_assert(MdtWorldShift(w, by));
        assert_near(MdtGearGetError(gear), 0, 1e-8);
    }
}

/* A planet on an arm that turns about the sun's axis: the ring is the world, the arm the housing. The ring has three
 * times the teeth: seen from the arm the planet turns by -3 times the arm's angle, seen from outside by -2. */
TEST(the_housing_may_be_one_of_the_bodies) {
    for (int first = 0; first < 2; first++) {
        MdtWorldID w = scene_world(2, 3, 0);
        MdtWorldSetEpsilon(w, 0);
        MdtBodyID body[2];
        for (int i = 0; i < 2; i++)
            body[i ^ first] = makeWheel(w, 1, (i ^ first) == 0 ? 1 : 0);
        MdtBodyID planet = body[0], arm = body[1];
        scene_hinge(w, arm, 0, 0, 0, 0, 0, 0, 1);
        scene_hinge(w, planet, arm, 1, 0, 0, 0, 0, 1);
        MdtGearID gear = MdtGearCreate(w);
        MdtGearSetBodies(gear, planet, arm);
        MdtGearSetAxis(gear, 0, 0, 1);
        MdtGearSetHousing(gear, arm);
        MdtGearSetRatio(gear, (MeReal)(1 / 3.));
        MdtGearEnable(gear);
        MdtBodyAddTorque(arm, 0, 0, 60);
        MdtWorldStep(w, FRAME); /* 1 N m s on I_arm + m r² + 4 I_planet = 6 */
        assert_near(rateOf(arm), 1. / 6, TOL(1e-6, 1e-8));
        assert_near(rateOf(planet), -2. / 6, TOL(1e-6, 1e-7));
        steps(w, 600, FRAME);
        assert_near(rateOf(arm), 1. / 6, TOL(1e-5, 1e-5));
        assert_near(MdtGearGetError(gear), 0, 1e-8);
    }
}

/* ---- life ---- */

/* A change of the ratio while the wheels turn leaves them where they are. */
TEST(another_ratio_engages_anew) {
    Pair s = makePair(1, 1, 1, 0);
    spin(s, 5, 1);
    steps(s.world, 60, FRAME);
    assert_near(MdtGearGetCoordinate(s.gear, 0), 120 * atan(5 / 120.), TOL(1e-5, 1e-6)); /* the midpoint rule's turn */
    MdtGearSetTeeth(s.gear, 2, 1);
    assert_near(MdtGearGetCoordinate(s.gear, 0), 0, 1e-12);
    ck_assert(MdtGearGetRatio(s.gear) == 2);
    steps(s.world, 1, FRAME);
    assert_near(rateOf(s.wheel[1]), -2 * rateOf(s.wheel[0]), TOL(1e-5, 1e-8));
    assert_near(MdtGearGetError(s.gear), 0, 1e-8);
    MdtBodySetQuaternion(s.wheel[0], 0, 0, 0, 1); /* half a turn by hand: an error that is corrected */
    ck_assert(fabs((double)MdtGearGetError(s.gear)) > 1);
    MdtGearEngage(s.gear);
    assert_near(MdtGearGetError(s.gear), 0, 1e-12);
}

/* The gear joins partitions: what sleeps wakes when its partner is pushed. */
TEST(a_wheel_wakes_its_partner) {
    Pair s = makePair(2, 1, 1, 0);
    MdtWorldSetAutoDisable(s.world, 1);
    steps(s.world, 300, FRAME);
    ck_assert(!MdtBodyIsEnabled(s.wheel[0]) && !MdtBodyIsEnabled(s.wheel[1]));
    MdtBodyEnable(s.wheel[0]);
    MdtBodySetAngularVelocity(s.wheel[0], 0, 0, 3);
    steps(s.world, 2, FRAME);
    ck_assert(MdtBodyIsEnabled(s.wheel[1]) && fabs(rateOf(s.wheel[1])) > .1);
}

/* A centre of mass that is moved, and an origin, change nothing. */
TEST(frames_follow_the_centre_of_mass) {
    static const MeVector3 centre[2] = {{(MeReal).1, 0, 0}, {(MeReal).2, 0, 0}};
    Pair s = makePair(2, 1, 1, 0);
    spin(s, 1, 2);
    steps(s.world, 30, FRAME);
    MdtBodySetCenterOfMassRelativePosition(s.wheel[1], centre[0]);
    assert_near(MdtGearGetError(s.gear), 0, 1e-8);
    MdtGearSetHousing(s.gear, s.wheel[1]);
    steps(s.world, 30, FRAME);
    MdtBodySetCenterOfMassRelativePosition(s.wheel[1], centre[1]);
    assert_near(MdtGearGetError(s.gear), 0, 1e-8);
}
