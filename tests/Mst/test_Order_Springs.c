/* The order of springs, soft stops and contacts of jointed bodies: what they should keep, they keep. */
#include "universe.h"

static const double gravity = 9.81, pi = 3.14159265358979323846;
static const double sizes[] = {.05, .3, 2};

static double step;

static void begin(double h, double g) {
    universe_begin(&MstUniverseGrowingSizes);
    step = h;
    MdtWorldSetGravity(u->world, 0, 0, -g);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), 0, 0);
}

static void stepFor(double seconds) {
    for (int i = 0; i < seconds / step; i++)
        MstUniverseStep(u, step);
}

static MdtBodyID add(McdGeometryID geometry, double mass, double x, double z) {
    const McdModelID model = MstModelAndBodyCreate(u, geometry, 1);
    const MdtBodyID body = McdModelGetBody(model);
    MstAutoSetMassProperties(body, model, mass / MdtBodyGetMass(body));
    MdtBodySetPosition(body, x, 0, z);
    return body;
}

static double heightOf(MdtBodyID body) {
    MeVector3 x;
    MdtBodyGetPosition(body, x);
    return (double)x[2];
}

static void soften(MdtSingleLimitID stop, double at, double stiffness) {
    MdtSingleLimitSetStop(stop, at);
    MdtSingleLimitSetStiffness(stop, stiffness);
    MdtSingleLimitSetDamping(stop, 0);
}

static MdtLimitID slide(MdtBodyID body, MdtBodyID other) {
    const MdtPrismaticID joint = MdtPrismaticCreate(u->world);
    MdtPrismaticSetBodies(joint, body, other);
    MdtPrismaticSetAxis(joint, 0, 0, 1);
    MdtPrismaticEnable(joint);
    return MdtPrismaticGetLimit(joint);
}

/* ---- soft stops give back what they take ---- */

/* The speed with which a slider leaves its undamped stop, over that with which it meets it. */
static double returned(double size, double frequency, double reached, MeBool isBetweenTwo) {
    const double w = 2 * pi * frequency, speed = size;
    begin(step, 0);
    const MdtBodyID body = add(McdBoxCreate(u->frame, size, size, .1 * size), 2, 0, 0);
    const MdtBodyID other = isBetweenTwo ? add(McdBoxCreate(u->frame, size, size, .1 * size), 2, 0, -size) : 0;
    const MdtLimitID limit = slide(body, other);
    const double mass = isBetweenTwo ? 1 : 2;
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(limit), -100 * size);
    soften(MdtLimitGetUpperLimit(limit), reached * speed * step, mass * w * w);
    MdtLimitActivateLimits(limit, METRUE);
    MdtBodySetLinearVelocity(body, 0, 0, isBetweenTwo ? speed / 2 : speed);
    if (other)
        MdtBodySetLinearVelocity(other, 0, 0, -speed / 2);
    stepFor((reached + 4) * step + .5 / frequency);
    return -(double)MdtLimitGetVelocity(limit) / speed;
}

/* Up to a frequency at which w h is 2; had given back a quarter at 10 Hz, 60 Hz. */
TEST(undamped_soft_stops_return_the_speed) {
    for (int i = 0; i < 3; i++)
        for (double turn = .03; turn < 1.95; turn *= 1.4)
            for (double reached = 1.1; reached < 2; reached += .13) {
                step = i == 1 ? 1. / 240 : 1. / 60;
                const double frequency = turn / (2 * pi * step);
                assert_near(returned(sizes[i], frequency, reached, MEFALSE), 1, TOL(2e-5, 1e-7));
                assert_near(returned(sizes[i], frequency, reached, METRUE), 1, TOL(2e-3, 2e-3));
            }
}

/* ---- elastics ---- */

/* A ball falls .8 of the length of a slack cord, which throws it back: the height that it lacks, over its whole way. */
static double lostHeight(double length, double frequency) {
    const double w = 2 * pi * frequency, start = -.2 * length, sag = gravity / (w * w);
    const double stretch = sag + sqrt(sag * sag + 2 * sag * .8 * length);
    begin(step, gravity);
    const MdtBodyID ball = add(McdSphereCreate(u->frame, .05 * length), 1, .001 * length, start);
    const MdtSpringID cord = MdtSpringCreate(u->world);
    MdtSpringSetBodies(cord, ball, 0);
    MdtSpringSetPosition(cord, 1, 0, 0, 0);
    MdtSpringSetNaturalLength(cord, length);
    soften(MdtLimitGetUpperLimit(MdtSpringGetLimit(cord)), length, w * w);
    soften(MdtLimitGetLowerLimit(MdtSpringGetLimit(cord)), length, 0);
    MdtSpringEnable(cord);
    double top = -HUGE_VAL, before = 0;
    MeBool hasTurned = MEFALSE;
    for (int i = 0; i < 10 * sqrt(length) / step + 100; i++) {
        MstUniverseStep(u, step);
        const double z = heightOf(ball);
        hasTurned = hasTurned || (z > before && z < -.9 * length);
        if (hasTurned && z < before)
            break;
        top = hasTurned ? fmax(top, z) : top;
        before = z;
    }
    return (start - top) / (.8 * length + stretch);
}

/* Had risen to .57 of its height at w h = .95. A step's end is up to g h² / 8 below the top. */
TEST(a_slack_elastic_throws_a_ball_back_to_its_height) {
    static const double lengths[] = {.3, 2, 10};
    for (int i = 0; i < 3; i++)
        for (double turn = .05; turn < 1.95; turn *= 1.5)
            for (int k = 1; k <= 4; k *= 4) {
                step = 1. / (60 * k);
                const double lost = lostHeight(lengths[i], turn / (2 * pi * step));
                ck_assert_msg(lost < gravity * step * step / lengths[i] + 2e-3 && lost > -1e-3,
                              "%g m, w h %g, step %g: %g lost", lengths[i], turn, step, lost);
            }
}
