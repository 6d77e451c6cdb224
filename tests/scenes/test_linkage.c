/* A parallelogram linkage: two cranks of .3 m on the world, 1 m apart, and a coupler between their tips, of 1 kg each,
 * on hinges, under gravity. A motor turns one of the cranks. Twice a turn all links are in line: there the antiparallel
 * branch crosses the parallel one, on which momentum carries the cranks on. */
#include "Mdt.h"
#include "karma_test.h"

static const double pi = 3.14159265358979323846, gravity = 9.81;
static const double crank = .3, coupler = 1, thickness = .05; /* m */
static const double strength = 1e4;                           /* N m: as good as unlimited */
static const double frame = 1.0 / 60;                         /* s */
enum { PHASES = 8 };
static const double speeds[] = {.25, .5, 1, 1.5, 2, 3, 4}; /* turns a second */
/* s: the slowest have the least momentum, and fail at one passage of hundreds. */
static const double durations[] = {60, 60, 6, 6, 6, 6, 6};
enum { SPEEDS = sizeof speeds / sizeof *speeds };

/* On the antiparallel branch one crank turns back 1.9 times as fast as the other turns on: .1 rad a step and more, at
 * the slowest. On the parallel one they were never 1e-3 apart. */
static const double apart = .05;     /* rad */
static const double gapBound = 1e-6; /* m: a step through a change point may leave what attachments are rounded by */

static MdtBodyID addBar(MdtWorldID w, double length, double x, double y, double angle) {
    const MdtBodyID b = MdtBodyCreate(w);
    MeMatrix3 inertia;
    MdtMakeInertiaTensorBox(1, length, thickness, thickness, inertia);
    MdtBodySetMass(b, 1);
    MdtBodySetInertiaTensor(b, inertia);
    MdtBodySetPosition(b, x, y, 0);
    MdtBodySetQuaternion(b, cos(angle / 2), 0, 0, sin(angle / 2));
    MdtBodyEnable(b);
    return b;
}

static MdtHingeID addHinge(MdtWorldID w, MdtBodyID a, MdtBodyID b, double x, double y) {
    const MdtHingeID j = MdtHingeCreate(w);
    MdtHingeSetBodies(j, a, b);
    MdtHingeSetPosition(j, x, y, 0);
    MdtHingeSetAxis(j, 0, 0, 1);
    MdtHingeEnable(j);
    return j;
}

typedef struct Linkage {
    MdtWorldID world;
    MdtBodyID cranks[2];
} Linkage;

static Linkage makeLinkage(double phase, int driven, double speed) {
    Linkage l = {.world = MdtWorldCreate(3, 4)};
    MdtWorldSetAutoDisable(l.world, 0);
    MdtWorldSetEpsilon(l.world, 0);
    MdtWorldSetGravity(l.world, 0, -gravity, 0);
    MdtWorldEnableReport(l.world);
    const double x = crank * cos(phase), y = crank * sin(phase);
    const MdtBodyID bar = addBar(l.world, coupler, coupler / 2 + x, y, 0);
    for (int i = 0; i < 2; i++) {
        l.cranks[i] = addBar(l.world, crank, i * coupler + x / 2, y / 2, phase);
        addHinge(l.world, bar, l.cranks[i], i * coupler + x, y);
        const MdtHingeID j = addHinge(l.world, l.cranks[i], 0, i * coupler, 0);
        if (i == driven)
            MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(j), 2 * pi * speed, strength);
    }
    return l;
}

static double angleOf(MdtBodyID b) {
    MeMatrix3 r;
    MdtBodyGetOrientation(b, r);
    return atan2(r[0][1], r[0][0]);
}

/* Runs it until the cranks are on different branches. Returns when, or the duration; adds to what the reports have
 * told. */
static double run(double phase, int driven, double speed, double duration, double *gap, int *conflicts) {
    const Linkage l = makeLinkage(phase, driven, speed);
    double time = 0;
    for (; time < duration; time += frame) {
        MdtReport r;
        MdtWorldStep(l.world, frame);
        ck_assert(MdtWorldGetReport(l.world, &r));
        *gap = fmax(*gap, r.jointGap);
        *conflicts += r.conflicts;
        if (!(fabs(remainder(angleOf(l.cranks[0]) - angleOf(l.cranks[1]), 2 * pi)) < apart))
            break;
    }
    MdtWorldDestroy(l.world);
    return fmin(time, duration);
}

/* 2 x 7 x 8 runs: 3648 passages of change points. */
TEST(momentum_chooses_the_branch_at_a_change_point) {
    double gap = 0;
    int conflicts = 0;
    for (int i = 0; i < SPEEDS; i++)
        for (int driven = 0; driven < 2; driven++)
            for (int k = 0; k < PHASES; k++) {
                const double phase = .3 + .7853 * k + .01 * k * k;
                const double time = run(phase, driven, speeds[i], durations[i], &gap, &conflicts);
                ck_assert_msg(time == durations[i],
                              "%g turns a second, motor on %d, from %g rad: antiparallel after %g s", speeds[i], driven,
                              phase, time);
            }
    assert_below(gap, gapBound);
    ck_assert_int_eq(conflicts, 0);
}
