/* Blows: crowds of balls that keep their energy, a cradle of pendulums, a stack that settles, with what a world does by
 * default. */
#include "universe.h"

#define RADIUS  .5
#define GRAVITY 9.81
static const double unitDensity = 6 / 3.14159265358979324; /* kg/m³: of a ball of 1 kg */

static void begin(double restitution, double tolerance) {
    universe_begin(&MstUniverseGrowingSizes);
    McdFrameworkSetDefaultContactTolerance(u->frame, tolerance);
    MdtWorldSetGravity(u->world, 0, 0, -GRAVITY);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldEnableReport(u->world);
    const MdtContactParamsID p = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetType(p, MdtContactTypeFrictionZero);
    MdtContactParamsSetRestitution(p, restitution);
}

static const MeVector3 hull[] = {{(MeReal).4, 0, 0},  {(MeReal)-.4, 0, 0}, {0, (MeReal).3, 0},
                                 {0, (MeReal)-.3, 0}, {0, 0, (MeReal).2},  {0, 0, (MeReal)-.2}};

static McdModelID add(McdGeometryID shape, double x, double y, double z) {
    const McdModelID m = MstModelAndBodyCreate(u, shape, unitDensity);
    McdModelDynamicsSetPosition(m, x, y, z);
    return m;
}

static McdGeometryID makeBall(void) {
    return McdSphereCreate(u->frame, RADIUS);
}

static McdGeometryID makeCube(void) {
    return McdBoxCreate(u->frame, 2 * RADIUS, 2 * RADIUS, 2 * RADIUS);
}

/* ---- a crowd ----------------------------------------------------------------------------------------------------- */

enum { SIDE = 6, BALLS = SIDE * SIDE * SIDE, WALLS = 4 };

static McdModelID ball[BALLS];
static MeMatrix4 place[WALLS + 1];

/* In -1..1, the same in every run. */
static double random1(unsigned int *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 8) / 8388608. - 1;
}

static void addFixed(int i, double sx, double sy, double sz, double x, double y, double z) {
    MeMatrix4TMMakeIdentity(place[i]);
    MeMatrix4TMSetPosition(place[i], x, y, z);
    MstFixedModelCreate(u, McdBoxCreate(u->frame, sx, sy, sz), place[i]);
}

/* A lattice of balls, so far apart, each a little off its place and with a speed of its own, on a floor. */
static void fillCrowd(double apart, MeBool hasWalls) {
    unsigned int seed = 1;
    const McdGeometryID shape = makeBall();
    const double half = .5 * SIDE * apart + 2, off = .2 * (apart - 2 * RADIUS);
    addFixed(0, 400, 400, 4, 0, 0, -2);
    for (int i = 0; hasWalls && i < WALLS; i++) {
        const double at = i % 2 ? half : -half;
        addFixed(1 + i, i < 2 ? 4 : 200, i < 2 ? 200 : 4, 200, i < 2 ? at : 0, i < 2 ? 0 : at, 50);
    }
    for (int i = 0; i < BALLS; i++) {
        double at[3], v[3];
        const int cell[3] = {i / (SIDE * SIDE), i / SIDE % SIDE, i % SIDE};
        for (int k = 0; k < 3; k++) {
            at[k] = apart * (cell[k] - (k < 2 ? .5 * (SIDE - 1) : 0)) + off * random1(&seed);
            v[k] = random1(&seed);
        }
        ball[i] = add(shape, at[0], at[1], RADIUS + off + at[2]);
        McdModelDynamicsSetLinearVelocity(ball[i], v[0], v[1], v[2]);
    }
}

static double energyOfCrowd(void) {
    double sum = 0;
    for (int i = 0; i < BALLS; i++) {
        const MdtBodyID b = McdModelGetBody(ball[i]);
        MeVector3 at;
        MdtBodyGetPosition(b, at);
        sum += (double)MdtBodyGetKineticEnergy(b) + GRAVITY * ((double)at[2] - RADIUS);
    }
    return sum;
}

/* Energy after some steps, of that at the start; `work`: millions of multiplications in a step. */
static double playSteps(double apart, MeBool hasWalls, int steps, double *work) {
    begin(1, .25); /* contacts with wide gaps tie the crowd into one partition */
    fillCrowd(apart, hasWalls);
    const double start = energyOfCrowd();
    *work = 0;
    for (int i = 0; i < steps; i++) {
        MdtReport r;
        MstUniverseStep(u, 1. / 60);
        ck_assert(MdtWorldGetReport(u->world, &r));
        *work += (double)r.work / steps;
    }
    const double left = energyOfCrowd() / start;
    assert_silent();
    return left;
}

/* As one step for all, in double precision the three left .88, .71, .37 of their energy, for 9.7, 4.4, 161 million
 * multiplications. */
static double playCrowd(double apart, MeBool hasWalls, double *work) {
    return playSteps(apart, hasWalls, 300, work);
}

TEST(an_elastic_crowd_keeps_its_energy) {
    double work;
    assert_near(playCrowd(1.5, MEFALSE, &work), 1, 1e-5);
    assert_below(work, 2);
    assert_near(playCrowd(2.5, METRUE, &work), 1, 1e-5);
    assert_below(work, 4);
    assert_near(playCrowd(1.5, METRUE, &work), 1, 1e-5);
    assert_below(work, 20);
}

/* A fiftieth of a ball apart, they meet by dozens in a step, and many touch at once. */
TEST(so_does_a_dense_one) {
    double work;
    assert_near(playSteps(1.02, MEFALSE, 90, &work), 1, 1e-3);
}

/* ---- two balls --------------------------------------------------------------------------------------------------- */

/* One at rest is hit by another, aside of its centre: what is along the line of centres at that moment is passed on,
 * and nothing turns, however far they come in a step. */
static void hitAside(double aside, double restitution, double h) {
    MeVector3 v[2], w;
    begin(restitution, .01);
    MdtWorldSetGravity(u->world, 0, 0, 0);
    const McdGeometryID shape = makeBall();
    const McdModelID rests = add(shape, 0, 0, 0), flies = add(shape, aside, 0, 1.3);
    const double n[3] = {-aside, 0, -sqrt(1 - aside * aside)}, passed = .5 * (1 + restitution) * -5 * n[2];
    McdModelDynamicsSetLinearVelocity(flies, 0, 0, -5);
    for (int i = 0; i < .3 / h; i++)
        MstUniverseStep(u, h);
    MdtBodyGetLinearVelocity(McdModelGetBody(rests), v[0]);
    MdtBodyGetLinearVelocity(McdModelGetBody(flies), v[1]);
    for (int i = 0; i < 3; i++) {
        assert_near(v[0][i], passed * n[i], TOL(1e-5, 1e-5));
        assert_near(v[1][i], (i == 2 ? -5 : 0) - passed * n[i], TOL(1e-5, 1e-5));
    }
    MdtBodyGetAngularVelocity(McdModelGetBody(rests), w);
    assert_below(MeVector3Magnitude(w), 1e-6);
}

TEST(balls_are_hit_along_the_line_of_their_centres) {
    static const double aside[] = {0, .1, .3, .6, .9}, rate[] = {30, 60, 240};
    for (int i = 0; i < 5; i++)
        for (int k = 0; k < 3; k++) {
            hitAside(aside[i], 1, 1 / rate[k]);
            hitAside(aside[i], .5, 1 / rate[k]);
        }
}

/* ---- pendulums --------------------------------------------------------------------------------------------------- */

enum { ROW = 5 };
static const double length = 4, angle = .7; /* m, rad: of the first one at the start */

static void hang(McdModelID m, double x, MeBool onHinge) {
    const MdtBodyID b = McdModelGetBody(m);
    if (onHinge) {
        const MdtHingeID j = MdtHingeCreate(u->world);
        MdtHingeSetBodies(j, b, 0);
        MdtHingeSetPosition(j, x, 0, length);
        MdtHingeSetAxis(j, 0, 1, 0);
        MdtHingeEnable(j);
    } else {
        const MdtBSJointID j = MdtBSJointCreate(u->world);
        MdtBSJointSetBodies(j, b, 0);
        MdtBSJointSetPosition(j, x, 0, length);
        MdtBSJointEnable(j);
    }
}

typedef struct Cradle {
    McdGeometryID (*makeShape)(void);
    MeBool onHinge;
    double gap; /* of a diameter */
    double restitution, h;
} Cradle;

/* The heights, of the first one's at the start, that the bodies rise to after the blow. */
static void playPendulums(const Cradle *c, double top[ROW]) {
    McdModelID m[ROW];
    begin(c->restitution, .1);
    for (int i = 0; i < ROW; i++) {
        const double x = 2 * RADIUS * (1 + c->gap) * i;
        m[i] = add(c->makeShape(), x, 0, 0);
        hang(m[i], x, c->onHinge);
        top[i] = 0;
    }
    McdModelDynamicsSetPosition(m[0], -length * sin(angle), 0, length * (1 - cos(angle)));
    McdModelDynamicsSetQuaternion(m[0], cos(.5 * angle), 0, sin(.5 * angle), 0);
    const double period = 2 * 3.14159265358979324 * sqrt(length / GRAVITY) * (1 + angle * angle / 16);
    for (double time = c->h; time < .6 * period; time += c->h) {
        MstUniverseStep(u, c->h);
        for (int i = 0; time > .3 * period && i < ROW; i++) {
            MeVector3 at;
            McdModelDynamicsGetPosition(m[i], at);
            top[i] = fmax(top[i], (double)at[2] / (length * (1 - cos(angle))));
        }
    }
    assert_silent();
}

/* Each blow hands (1 + e)/2 of the speed on. */
static void assertLastRises(McdGeometryID (*makeShape)(void)) {
    static const double gaps[] = {0, .02, .1}, restitutions[] = {1, .9}, steps[] = {1. / 60, 1. / 25};
    for (int k = 0; k < 24; k++) {
        const Cradle c = {makeShape, k / 12, gaps[k % 3], restitutions[k / 3 % 2], steps[k / 6 % 2]};
        double top[ROW];
        playPendulums(&c, top);
        assert_near_rel(top[ROW - 1], pow((1 + c.restitution) / 2, 2 * (ROW - 1)), .02);
        for (int i = 0; i < ROW - 1; i++)
            assert_below(top[i], .02);
    }
}

/* By one step for all the last one rose to .25 of it, or .16. */
TEST(the_last_pendulum_rises_as_high_as_it_must) {
    assertLastRises(makeBall);
}

/* Two of five balls are let go side by side, nearly touching: they swing as if alone, and the last two take over.
 * Returns the energy after four swings, of that at the start; *top: how high the last ball rises, of where the first
 * one began. */
static double playTwo(double radius, double gap, double h, double *top) {
    const double way = 10 * radius, begins = .8, period = 2 * 3.14159265358979324 * sqrt(way / GRAVITY);
    McdModelID m[ROW];
    double energy = 0;
    begin(1, .1 * radius);
    for (int i = 0; i < ROW; i++) {
        const double x = (2 * radius + gap) * i, turn = i < 2 ? begins : 0;
        m[i] = add(McdSphereCreate(u->frame, radius), x - way * sin(turn), 0, -way * cos(turn));
        McdModelDynamicsSetQuaternion(m[i], cos(turn / 2), 0, sin(turn / 2), 0);
        const MdtHingeID j = MdtHingeCreate(u->world);
        MdtHingeSetBodies(j, McdModelGetBody(m[i]), 0);
        MdtHingeSetPosition(j, x, 0, 0);
        MdtHingeSetAxis(j, 0, 1, 0);
        MdtHingeEnable(j);
    }
    *top = 0;
    for (double time = 0; time < 4 * period; time += h) {
        MeVector3 at;
        MstUniverseStep(u, h);
        McdModelDynamicsGetPosition(m[ROW - 1], at);
        if (time < .75 * period)
            *top = fmax(*top, ((double)at[2] / way + 1) / (1 - cos(begins)));
    }
    for (int i = 0; i < ROW; i++) {
        MeVector3 at, v, w;
        McdModelDynamicsGetPosition(m[i], at);
        McdModelDynamicsGetLinearVelocity(m[i], v);
        McdModelDynamicsGetAngularVelocity(m[i], w);
        energy += GRAVITY * ((double)at[2] + way) + (double)MeVector3Dot(v, v) / 2 +
                  .2 * radius * radius * (double)MeVector3Dot(w, w);
    }
    return energy / (2 * GRAVITY * way * (1 - cos(begins)));
}

/* Before, what hung touching was damped. They kept .04 to .9 of it. */
TEST(two_balls_that_swing_side_by_side_keep_their_energy) {
    static const double radii[] = {.02, .1, 1}, steps[] = {1. / 30, 1. / 60, 1. / 240}, gaps[] = {0, 1e-4, 1e-2};
    for (int k = 0; k < 27; k++) {
        const double radius = radii[k % 3], gap = gaps[k / 9];
        const double turn = steps[k / 3 % 3] * sqrt(GRAVITY / (10 * radius)); /* rad, of the swing in a step */
        double top;
        const double left = playTwo(radius, gap * radius, steps[k / 3 % 3], &top);
        ck_assert_msg(fabs(left - 1) < 5e-4 + .04 * turn * turn && top > .99 && top < 1.002,
                      "%g m, gap %g, step %g: energy %g, top %g", radius, gap, steps[k / 3 % 3], left, top);
    }
    assert_silent();
}

/* They meet face to face, by four contacts each. */
TEST(so_does_the_last_of_boxes) {
    assertLastRises(makeCube);
}

/* ---- momentum ---------------------------------------------------------------------------------------------------- */

static McdGeometryID makeAny(int kind) {
    switch (kind) {
    case 0:
        return McdSphereCreate(u->frame, (MeReal).3);
    case 1:
        return McdBoxCreate(u->frame, (MeReal).6, (MeReal).4, (MeReal).3);
    case 2:
        return McdCylinderCreate(u->frame, (MeReal).3, (MeReal).3);
    default:
        return McdConvexMeshCreateHull(u->frame, hull, 6, 0);
    }
}

/* By how much the momentum of two bodies that meet changes, of the sum of its parts. */
static double momentumLost(int kinds[2], double friction, double h, unsigned int seed) {
    McdModelID m[2];
    double sum[3] = {0, 0, 0}, all = 0, max = 0;
    begin(0, .1);
    MdtWorldSetGravity(u->world, 0, 0, 0);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal)friction, 0);
    for (int i = 0; i < 2; i++) {
        const double side = i ? 1 : -1, y = .2 * random1(&seed), z = .2 * random1(&seed);
        m[i] = MstModelAndBodyCreate(u, makeAny(kinds[i]), 1000);
        McdModelDynamicsSetPosition(m[i], (MeReal)(.5 * side), (MeReal)y, (MeReal)z);
        const double a = random1(&seed), b = random1(&seed), c = random1(&seed);
        McdModelDynamicsSetQuaternion(m[i], (MeReal).5, (MeReal)a, (MeReal)b, (MeReal)c);
        McdModelDynamicsSetLinearVelocity(m[i], (MeReal)(-.6 * side), 0, 0);
        McdModelDynamicsSetAngularVelocity(m[i], (MeReal)(3 * c), (MeReal)(3 * a), (MeReal)(3 * b));
        const double mass = (double)MdtBodyGetMass(McdModelGetBody(m[i]));
        sum[0] -= mass * .6 * side;
        all += mass * .6;
    }
    for (double time = 0; time < 1.5; time += h) {
        double now[3] = {0, 0, 0};
        MstUniverseStep(u, (MeReal)h);
        for (int i = 0; i < 2; i++) {
            MeVector3 v;
            McdModelDynamicsGetLinearVelocity(m[i], v);
            for (int k = 0; k < 3; k++)
                now[k] += (double)MdtBodyGetMass(McdModelGetBody(m[i])) * (double)v[k];
        }
        for (int k = 0; k < 3; k++)
            max = fmax(max, fabs(now[k] - sum[k]) / all);
    }
    return max;
}

/* Where passes do not settle, velocities are scaled to the energy that there is: with those of the centre of mass the
 * momentum changed by up to .03. */
TEST(two_free_bodies_keep_their_momentum) {
    for (int k = 0; k < 400; k++) {
        int kinds[2] = {k % 4, k / 4 % 4};
        const double lost = momentumLost(kinds, k % 3 ? 0 : .5, k % 2 ? 1. / 30 : 1. / 60, 77 + 1000 * (unsigned int)k);
        ck_assert_msg(lost < TOL(1e-6, 1e-12), "shapes %d, %d, seed %d: %g", kinds[0], kinds[1], k, lost);
    }
}

/* ---- what comes to rest ------------------------------------------------------------------------------------------ */

enum { STACK = 8 };

static void dropStack(double restitution, int timedBodies, McdModelID m[STACK]) {
    unsigned int seed = 7;
    begin(restitution, .05);
    MdtWorldSetTimedContacts(u->world, timedBodies);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), .5, restitution);
    addFixed(0, 400, 400, 4, 0, 0, -2);
    for (int i = 0; i < STACK; i++) {
        const double x = .05 * random1(&seed), y = .05 * random1(&seed);
        m[i] = add(makeCube(), x, y, RADIUS + .05 + 1.03 * i);
        McdModelDynamicsSetQuaternion(m[i], 1, .3 * x, .3 * y, 0);
    }
}

/* Has nothing a speed that gravity does not give it within a step? */
static MeBool isCalm(const McdModelID m[STACK], double h) {
    for (int i = 0; i < STACK; i++) {
        MeVector3 v, w;
        McdModelDynamicsGetLinearVelocity(m[i], v);
        McdModelDynamicsGetAngularVelocity(m[i], w);
        if ((double)(MeVector3Magnitude(v) + MeVector3Magnitude(w) * (MeReal)RADIUS) > .5 * GRAVITY * h)
            return MEFALSE;
    }
    return METRUE;
}

typedef struct Calm {
    int steps, events;
    double work; /* millions of multiplications */
} Calm;

/* What calm steps took in 10 s: those that begin and end so. */
static Calm settle(double restitution, int timedBodies) {
    const double h = 1. / 60;
    McdModelID m[STACK];
    Calm calm = {0, 0, 0};
    MeBool wasCalm = MEFALSE;
    dropStack(restitution, timedBodies, m);
    for (int i = 0; i < 600; i++) {
        MdtReport r;
        MstUniverseStep(u, h);
        ck_assert(MdtWorldGetReport(u->world, &r));
        const MeBool isNow = isCalm(m, h);
        if (wasCalm && isNow) {
            calm.steps++;
            calm.events += r.events;
            calm.work += (double)r.work;
        }
        wasCalm = isNow;
    }
    assert_silent();
    return calm;
}

static void addCalm(Calm *sum, Calm c) {
    sum->steps += c.steps;
    sum->events += c.events;
    sum->work += c.work;
}

/* An attempt in time that is given up costs as much again as the step: 2.0 times the work in single precision, .3 in
 * double. Each slow impact divided it: 1750 events, 15 times the work in double. */
TEST(what_trembles_divides_no_step) {
    Calm inTime = {0, 0, 0}, atOnce = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        addCalm(&inTime, settle(.3 * k, STACK));
        addCalm(&atOnce, settle(.3 * k, 0));
    }
    ck_assert_int_gt(inTime.steps, 1500);
    ck_assert_int_gt(atOnce.steps, 1500);
    ck_assert_int_le(inTime.events, 10);
    assert_below(inTime.work, 3 * atOnce.work);
}

/* Where a step ends within a thousandth of it before the blow, the arc of the string closes the gap that straight
 * motion leaves. Three of these steps were solved as one, in which nothing rebounds, and the last one rose to .25. */
TEST(a_step_may_end_at_the_blow) {
    for (int i = 0; i < 400; i++) {
        const Cradle c = {makeBall, MEFALSE, .02, 1, .085 * (1 + 4e-4 * i)};
        double top[ROW];
        playPendulums(&c, top);
        assert_near_rel(top[ROW - 1], 1, .02);
    }
}
