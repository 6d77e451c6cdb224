/* An arm of 1 kg and 1 m on a hinge, and a slider of 1 kg, are led along a path q(t) = sin t (1 + cos 3 t / 2), under
 * gravity: before every step the motor gets the mean velocity of the path in that step. */
#include "Mdt.h"
#include "karma_test.h"

static const double gravity = 9.81, frame = 1.0 / 60, duration = 5, strength = 1e4;

static double pathAt(double t) {
    return sin(t) * (1 + cos(3 * t) / 2);
}

typedef struct Machine {
    MdtWorldID world;
    MdtBodyID body;
    MdtLimitID limit;
} Machine;

static Machine makeMachine(MeBool slides, double force, MeBool tracks) {
    Machine m = {.world = MdtWorldCreate(1, 1)};
    MeMatrix3 inertia;
    MdtWorldSetAutoDisable(m.world, 0);
    MdtWorldSetEpsilon(m.world, 0);
    MdtWorldSetGravity(m.world, 0, -gravity, 0);
    m.body = MdtBodyCreate(m.world);
    MdtMakeInertiaTensorBox(1, 1, .1, .1, inertia);
    MdtBodySetMass(m.body, 1);
    MdtBodySetInertiaTensor(m.body, inertia);
    MdtBodySetPosition(m.body, .5, 0, 0);
    MdtBodyEnable(m.body);
    if (slides) {
        const MdtPrismaticID j = MdtPrismaticCreate(m.world);
        MdtPrismaticSetBodies(j, m.body, 0);
        MdtPrismaticSetAxis(j, 0, 1, 0);
        MdtPrismaticEnable(j);
        m.limit = MdtPrismaticGetLimit(j);
    } else {
        const MdtHingeID j = MdtHingeCreate(m.world);
        MdtHingeSetBodies(j, m.body, 0);
        MdtHingeSetPosition(j, 0, 0, 0);
        MdtHingeSetAxis(j, 0, 0, 1);
        MdtHingeEnable(j);
        m.limit = MdtHingeGetLimit(j);
    }
    MdtLimitSetLimitedForceMotor(m.limit, 0, force);
    MdtLimitSetMotorTracking(m.limit, tracks);
    return m;
}

/* The coordinate from the body's pose, which single precision does not round away as it does that of the limit. */
static double coordinateOf(const Machine *m, MeBool slides) {
    MeVector3 p;
    MdtBodyGetPosition(m->body, p);
    return slides ? (double)p[1] : atan2(p[1], p[0]);
}

/* The largest error against the path, and of the velocity against what was asked for. */
static double follow(MeBool slides, MeBool tracks, double *velocity) {
    const Machine m = makeMachine(slides, strength, tracks);
    const int n = (int)lround(duration / frame);
    double worst = 0;
    *velocity = 0;
    for (int i = 0; i < n; i++) {
        const double rate = (pathAt((i + 1) * frame) - pathAt(i * frame)) / frame;
        MdtLimitSetLimitedForceMotor(m.limit, rate, strength);
        MdtWorldStep(m.world, frame);
        worst = fmax(worst, fabs(coordinateOf(&m, slides) - pathAt((i + 1) * frame)));
        *velocity = fmax(*velocity, fabs((double)MdtLimitGetVelocity(m.limit) - rate));
    }
    MdtWorldDestroy(m.world);
    return worst;
}

TEST(a_tracking_motor_leads_along_a_path) {
    for (int slides = 0; slides < 2; slides++) {
        double velocity;
        const double error = follow(slides, METRUE, &velocity);
        assert_below(error, TOL(5e-6, 1e-7));
        assert_below(velocity, TOL(1e-5, 1e-7));
    }
}

TEST(a_motor_reaches_its_velocity_at_the_end_of_the_step) {
    for (int slides = 0; slides < 2; slides++) {
        double velocity;
        const double error = follow(slides, MEFALSE, &velocity);
        assert_below(velocity, TOL(1e-5, 1e-7));
        assert_below(error, .05);
    }
}

/* A constant force F on 1 kg, v < h F / m missing after a step: m v = F t until the velocity is reached. */
TEST(a_tracking_motor_has_no_more_than_its_force) {
    const double force = 2 + gravity, rate = 1;
    const Machine m = makeMachine(METRUE, force, METRUE);
    MdtLimitSetLimitedForceMotor(m.limit, rate, force);
    for (int i = 1; i <= 60; i++) {
        MdtWorldStep(m.world, frame);
        if (i * frame * 2 < rate)
            assert_near(MdtLimitGetVelocity(m.limit), 2 * i * frame, TOL(1e-5, 1e-8));
    }
    assert_near(MdtLimitGetVelocity(m.limit), rate, TOL(1e-5, 1e-8));
    MdtWorldDestroy(m.world);
}

/* Copied with the limit, gone with a reset; a null limit is told of. */
TEST(tracking_is_part_of_a_limit) {
    const Machine m = makeMachine(MEFALSE, 1, METRUE), other = makeMachine(METRUE, 1, MEFALSE);
    ck_assert(MdtLimitMotorIsTracking(m.limit) && !MdtLimitMotorIsTracking(other.limit));
    *other.limit = *m.limit;
    ck_assert(MdtLimitMotorIsTracking(other.limit));
    MdtLimitReset(m.limit);
    ck_assert(!MdtLimitMotorIsTracking(m.limit));
    MdtWorldDestroy(m.world);
    MdtWorldDestroy(other.world);
}

/* A motor that jumps from rest to a velocity v gives the velocity at the end of a step, so that the step of the jump
 * moves by the mean of 0 and v, h v / 2 less than v; one that tracks gives the mean. */
TEST(a_jump_of_the_velocity_costs_half_a_step_unless_the_motor_tracks) {
    const double rate = .5;
    enum { STEPS = 30 };
    for (int slides = 0; slides < 2; slides++)
        for (int tracks = 0; tracks < 2; tracks++) {
            const Machine m = makeMachine(slides, strength, tracks);
            MdtWorldSetGravity(m.world, 0, 0, 0);
            MdtLimitSetLimitedForceMotor(m.limit, rate, strength);
            for (int i = 0; i < STEPS; i++)
                MdtWorldStep(m.world, frame);
            assert_near(coordinateOf(&m, slides), rate * frame * (tracks ? STEPS : STEPS - .5), TOL(1e-5, 1e-5));
            MdtWorldDestroy(m.world);
        }
}
