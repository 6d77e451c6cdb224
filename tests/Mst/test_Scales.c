/* Scales: the same scene with its lengths, masses and times in other units. Units are powers of two, which rounding
 * does not tell apart: the motion is the same to the last bit, and so is what it costs, unless a number somewhere has a
 * unit of its own. Under one gravity, 9.81 m/s², the unit of time is the root of that of length: a doll of a metre
 * falls as one of a millimetre in slow motion. */
#include "universe.h"

enum { MAX = 100 };

/* Powers of two. */
typedef struct Units {
    int length, mass, time;
} Units;

static Units units;
static McdModelID model[MAX];
static int count;
static MeMatrix4 place;

static MeReal inUnits(double value, int length, int mass, int time) {
    return (MeReal)ldexp(value, length * units.length + mass * units.mass + time * units.time);
}

static MeReal lengthOf(double value) {
    return inUnits(value, 1, 0, 0);
}

static MeReal speedOf(double value) {
    return inUnits(value, 1, 0, -1);
}

static MeReal turnOf(double value) {
    return inUnits(value, 0, 0, -1);
}

static MeReal densityOf(double value) {
    return inUnits(value, -3, 1, 0);
}

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

static MdtContactParamsID surface(void) {
    return MstBridgeGetContactParams(u->bridge, 0, 0);
}

/* Defaults that are in seconds, which a world does not know another unit for; and epsilon, whose default takes steps of
 * 1/60 s (test_Defaults). */
static void setTimes(void) {
    const MdtWorldID w = u->world;
    const MeReal t = inUnits(1, 0, 0, 1), t2 = t * t;
    MdtWorldSetAutoDisableVelocityThreshold(w, MdtWorldGetAutoDisableVelocityThreshold(w) / t2);
    MdtWorldSetAutoDisableAngularVelocityThreshold(w, MdtWorldGetAutoDisableAngularVelocityThreshold(w) / t2);
    MdtWorldSetAutoDisableAccelerationThreshold(w, MdtWorldGetAutoDisableAccelerationThreshold(w) / (t2 * t2));
    MdtWorldSetAutoDisableAngularAccelerationThreshold(w, MdtWorldGetAutoDisableAngularAccelerationThreshold(w) /
                                                              (t2 * t2));
    MdtWorldSetAutoDisableAliveTime(w, MdtWorldGetAutoDisableAliveTime(w) * t);
    MdtWorldSetMinSafeTime(w, MdtWorldGetMinSafeTime(w) * t);
    MdtWorldSetEpsilon(w, inUnits(1e-12, 0, -1, 0));
    MdtContactParamsSetRestitutionThreshold(surface(), MdtContactParamsGetRestitutionThreshold(surface()) / t);
}

static void makeFloor(void) {
    universe_addFloor();
}

static McdModelID add(McdGeometryID shape, double x, double y, double z) {
    const McdModelID m = MstModelAndBodyCreate(u, shape, densityOf(1000));
    McdModelDynamicsSetPosition(m, lengthOf(x), lengthOf(y), lengthOf(z));
    model[count++] = m;
    return m;
}

static McdGeometryID box(double x, double y, double z) {
    return McdBoxCreate(u->frame, lengthOf(x), lengthOf(y), lengthOf(z));
}

static McdGeometryID ball(double radius) {
    return McdSphereCreate(u->frame, lengthOf(radius));
}

static void makeTower(void) {
    makeFloor();
    for (int i = 0; i < 5; i++)
        add(box(1, 1, 1), .02 * i, 0, .55 + 1.05 * i);
}

static void makeRolling(void) {
    makeFloor();
    McdModelDynamicsSetLinearVelocity(add(ball(.5), 0, 0, .5), speedOf(3), speedOf(.5), 0);
}

static MdtHingeID hinge(McdModelID a, McdModelID b, double x, double y, double z) {
    const MdtHingeID j = MdtHingeCreate(u->world);
    MdtHingeSetBodies(j, McdModelGetBody(a), b ? McdModelGetBody(b) : 0);
    MdtHingeSetPosition(j, lengthOf(x), lengthOf(y), lengthOf(z));
    MdtHingeSetAxis(j, 0, 1, 0);
    if (b)
        McdSpaceDisablePair(a, b);
    return j;
}

/* Of eight links, and a motor turns the fourth. */
static void makeChain(void) {
    for (int i = 0; i < 8; i++) {
        add(box(.9, .1, .1), .5 + i, 0, 0);
        const MdtHingeID j = hinge(model[i], i > 0 ? model[i - 1] : 0, i, 0, 0);
        MdtHingeEnable(j);
        if (i != 3)
            continue;
        MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(j), turnOf(6), inUnits(3000, 2, 1, -2));
        MdtLimitActivateMotor(MdtHingeGetLimit(j), METRUE);
    }
}

/* Turned any way, above each other, and apart: impulses of what touches in flight fall until they underflow. */
static void makeHeap(void) {
    unsigned int seed = 1;
    makeFloor();
    for (int i = 0; i < 80; i++) {
        double x[6];
        for (int k = 0; k < 6; k++) {
            seed = seed * 1664525u + 1013904223u;
            x[k] = (double)(seed >> 8) / (1 << 24) - .5;
        }
        add(box(1, 1, 1), 2 * (i % 4) + .2 * x[0], .2 * x[1], 1 + 1.8 * (i / 4));
        McdModelDynamicsSetQuaternion(model[i], x[2], x[3], x[4], x[5]);
    }
}

/* 66 boxes with gaps: the fast solver's. */
static void makePyramid(void) {
    const McdGeometryID cube = box(1, 1, 1);
    makeFloor();
    for (int row = 0; row < 11; row++)
        for (int i = 0; i < 11 - row; i++)
            add(cube, 1.05 * i + .525 * row, 0, .52 + 1.02 * row);
}

enum { CELLS = 8 };
static MeVector3 corner[CELLS + 1][CELLS + 1];

static int MEAPI triangles(McdModelPair *pair, McdUserTriangle *out, MeVector3 at, MeReal radius, int max) {
    int found = 0;
    (void)pair;
    for (int i = 0; i < 2 * CELLS * CELLS && found < max; i++) {
        const int x = i / 2 / CELLS, y = i / 2 % CELLS, upper = i % 2;
        MeVector3 *const c[3] = {&corner[x][y], upper ? &corner[x + 1][y + 1] : &corner[x + 1][y],
                                 upper ? &corner[x][y + 1] : &corner[x + 1][y + 1]};
        McdUserTriangle *t = &out[found++];
        memset(t, 0, sizeof *t);
        for (int k = 0; k < 3; k++)
            t->vertices[k] = c[k];
        t->flags = (McdTriangleFlags)(kMcdTriangleUseSmallestPenetration | kMcdTriangleUseEdges);
    }
    (void)at;
    (void)radius;
    return found;
}

/* A ball of radius .3 and a box roll and slide into a bowl of triangles. */
static void makeBowl(void) {
    MeVector3 low = {lengthOf(-4), lengthOf(-4), lengthOf(-1)}, high = {lengthOf(4), lengthOf(4), lengthOf(4)};
    for (int i = 0; i <= CELLS; i++)
        for (int k = 0; k <= CELLS; k++) {
            const double x = i - CELLS / 2, y = k - CELLS / 2;
            MeVector3Set(corner[i][k], lengthOf(x), lengthOf(y), lengthOf(.05 * (x * x + y * y)));
        }
    MeMatrix4TMMakeIdentity(place);
    MstFixedModelCreate(u, McdTriangleListCreate(u->frame, low, high, 2 * CELLS * CELLS + 1, triangles), place);
    add(ball(.3), 2.1, .4, 1);
    add(box(.5, .4, .3), -1.9, -.7, 1);
}

/* ---- a doll ------------------------------------------------------------------------------------------------------ */

typedef struct Part {
    int above; /* the part it hangs on */
    double size[3], at[3], joint[3];
    double bend; /* rad, of a hinge, to one side; 0: a ball joint with a cone */
    double cone;
} Part;

static const Part part[] = {
    {-1, {.3, .2, .2}, {0, 0, 1}, {0, 0, 0}, 0, 0},
    {0, {.36, .2, .4}, {0, 0, 1.3}, {0, 0, 1.1}, 0, .5},
    {1, {.2, .2, .24}, {0, 0, 1.66}, {0, 0, 1.5}, 0, .6},
    {1, {.12, .12, .3}, {-.26, 0, 1.35}, {-.26, 0, 1.48}, 0, 1.4},
    {1, {.12, .12, .3}, {.26, 0, 1.35}, {.26, 0, 1.48}, 0, 1.4},
    {3, {.1, .1, .3}, {-.26, 0, 1.02}, {-.26, 0, 1.18}, -2.2, 0},
    {4, {.1, .1, .3}, {.26, 0, 1.02}, {.26, 0, 1.18}, -2.2, 0},
    {0, {.14, .14, .4}, {-.1, 0, .72}, {-.1, 0, .9}, 0, .9},
    {0, {.14, .14, .4}, {.1, 0, .72}, {.1, 0, .9}, 0, .9},
    {7, {.12, .12, .4}, {-.1, 0, .3}, {-.1, 0, .5}, 2.2, 0},
    {8, {.12, .12, .4}, {.1, 0, .3}, {.1, 0, .5}, 2.2, 0},
};
enum { PARTS = sizeof part / sizeof *part };

static void bend(const Part *p, McdModelID m, McdModelID above) {
    const MdtHingeID j = MdtHingeCreate(u->world);
    const MdtLimitID limit = MdtHingeGetLimit(j);
    const MdtSingleLimitID stop[2] = {MdtLimitGetLowerLimit(limit), MdtLimitGetUpperLimit(limit)};
    MdtHingeSetBodies(j, McdModelGetBody(m), McdModelGetBody(above));
    MdtHingeSetPosition(j, lengthOf(p->joint[0]), lengthOf(p->joint[1]), lengthOf(p->joint[2]));
    MdtHingeSetAxis(j, 1, 0, 0);
    MdtSingleLimitSetStop(stop[0], fmin(p->bend, 0));
    MdtSingleLimitSetStop(stop[1], fmax(p->bend, 0));
    for (int k = 0; k < 2; k++)
        MdtSingleLimitSetRestitution(stop[k], 0);
    MdtLimitActivateLimits(limit, METRUE);
    MdtHingeEnable(j);
}

static void swing(const Part *p, McdModelID m, McdModelID above) {
    const MdtBSJointID j = MdtBSJointCreate(u->world);
    const MdtConeLimitID limit = MdtConeLimitCreate(u->world);
    MdtBSJointSetBodies(j, McdModelGetBody(m), McdModelGetBody(above));
    MdtBSJointSetPosition(j, lengthOf(p->joint[0]), lengthOf(p->joint[1]), lengthOf(p->joint[2]));
    MdtBSJointEnable(j);
    MdtConeLimitSetBodies(limit, McdModelGetBody(m), McdModelGetBody(above));
    MdtConeLimitSetAxes(limit, 0, 0, 1, 1, 0, 0);
    MdtConeLimitSetConeHalfAngle(limit, p->cone);
    MdtConeLimitEnable(limit);
}

static void makeDoll(void) {
    makeFloor();
    for (int i = 0; i < PARTS; i++) {
        const Part *p = &part[i];
        add(box(p->size[0], p->size[1], p->size[2]), p->at[0], p->at[1], p->at[2]);
        if (i == 0)
            continue;
        if (p->bend == 0)
            swing(p, model[i], model[p->above]);
        else
            bend(p, model[i], model[p->above]);
        McdSpaceDisablePair(model[i], model[p->above]);
    }
    for (int i = 0; i < PARTS; i++) {
        McdModelDynamicsSetLinearVelocity(model[i], speedOf(1), speedOf(.5), speedOf(.3));
        MdtBodySetAngularVelocity(McdModelGetBody(model[i]), turnOf(.2), turnOf(.1), 0);
    }
}

/* ---- comparing --------------------------------------------------------------------------------------------------- */

typedef struct Scene {
    const char *name;
    void (*make)(void);
    int steps;
    double restitution;
} Scene;

static const Scene scenes[] = {
    {"tower of 5", makeTower, 120, 0},       {"5 bouncing boxes", makeTower, 60, .6},
    {"rolling ball", makeRolling, 120, 0},   {"chain of hinges", makeChain, 120, 0},
    {"bowl of triangles", makeBowl, 120, 0}, {"doll", makeDoll, 120, 0},
    {"pyramid of 66", makePyramid, 60, 0},
};
enum { SCENES = sizeof scenes / sizeof *scenes, STEPS = 120, STATE = 13 };

/* The motion without units, step by step, and what it cost. */
typedef struct Run {
    double state[STEPS][MAX][STATE];
    int contacts, factorizations, parts, passes, events, fallbacks, asleepFrom;
    double work;
} Run;

static void begin(const Scene *scene, Units in) {
    MstUniverseSizes sizes = MstUniverseGrowingSizes;
    units = in;
    count = 0;
    sizes.lengthScale = lengthOf(1);
    sizes.massScale = inUnits(1, 0, 1, 0);
    universe_begin(&sizes);
    setTimes();
    MdtWorldSetGravity(u->world, 0, 0, inUnits(-9.81, 1, 0, -2));
    MdtWorldEnableReport(u->world);
    MdtContactParamsSetSurface(surface(), .5, scene->restitution);
    scene->make();
    for (int i = 0; i < count; i++)
        MdtBodyEnable(McdModelGetBody(model[i]));
}

static void look(MdtBodyID b, double state[STATE]) {
    MeVector3 x, v, w;
    MeVector4 q;
    MdtBodyGetPosition(b, x);
    MdtBodyGetQuaternion(b, q);
    MdtBodyGetLinearVelocity(b, v);
    MdtBodyGetAngularVelocity(b, w);
    for (int k = 0; k < 3; k++) {
        state[k] = (double)(x[k] / lengthOf(1));
        state[3 + k] = (double)(v[k] / speedOf(1));
        state[6 + k] = (double)(w[k] / turnOf(1));
    }
    for (int k = 0; k < 4; k++)
        state[9 + k] = (double)q[k];
}

static void noteCost(Run *run, int step) {
    MdtReport r;
    ck_assert(MdtWorldGetReport(u->world, &r));
    run->contacts += r.constraints;
    run->factorizations += r.factorizations;
    run->parts += r.parts;
    run->passes += r.passes;
    run->events += r.events;
    run->fallbacks += r.fallbacks;
    run->work += (double)r.work;
    if (run->asleepFrom == 0 && MdtWorldGetEnabledBodies(u->world) == 0)
        run->asleepFrom = step;
}

static void play(const Scene *scene, Units in, Run *run) {
    memset(run, 0, sizeof *run);
    begin(scene, in);
    for (int step = 0; step < scene->steps; step++) {
        MstUniverseStep(u, inUnits((double)(MeReal)(1. / 60), 0, 0, 1));
        noteCost(run, step);
        for (int i = 0; i < count; i++)
            look(McdModelGetBody(model[i]), run->state[step][i]);
    }
}

/* Of the larger of 1 and the unit in which the state is told. */
static double difference(const Run *a, const Run *b, int steps) {
    double max = 0;
    for (int step = 0; step < steps; step++)
        for (int i = 0; i < MAX; i++)
            for (int k = 0; k < STATE; k++)
                max = fmax(max, fabs(a->state[step][i][k] - b->state[step][i][k]));
    return max;
}

static Run one, other;

static void assertSameCost(const char *name) {
    ck_assert_msg(one.contacts == other.contacts && one.factorizations == other.factorizations &&
                      one.parts == other.parts && one.passes == other.passes && one.events == other.events &&
                      one.fallbacks == other.fallbacks && one.work == other.work,
                  "%s: %d and %d contacts, %d and %d factorizations, %d and %d parts, work %g and %g", name,
                  one.contacts, other.contacts, one.factorizations, other.factorizations, one.parts, other.parts,
                  one.work, other.work);
    ck_assert_msg(one.asleepFrom == other.asleepFrom, "%s: asleep from step %d and %d", name, one.asleepFrom,
                  other.asleepFrom);
}

/* 1 mm, 1 km; 1e-6, 1e6 kg; a step of 17 s and of 16 us. */
static const Units others[] = {{-10, 0, -5}, {10, 0, 5}, {0, -20, 0}, {0, 20, 0}, {0, 0, 10}, {0, 0, -10}, {-10, 0, 0}};
enum { OTHERS = sizeof others / sizeof *others };

/* Velocities of bodies at rest may underflow: rounding depends on the scale then. */
LOOP_TEST(scenes_are_the_same_at_any_scale_to_the_last_bit, 0, SCENES) {
    const Scene *scene = &scenes[_i];
    play(scene, (Units){0, 0, 0}, &one);
    printf("%s: %d factorizations, %.4g million multiplications\n", scene->name, one.factorizations, one.work);
    for (int k = 0; k < OTHERS; k++) {
        play(scene, others[k], &other);
        const double off = difference(&one, &other, scene->steps);
        ck_assert_msg(off <= TOL(FLT_MIN, DBL_MIN), "%s, lengths by 2^%d, masses by 2^%d, times by 2^%d: off by %g",
                      scene->name, others[k].length, others[k].mass, others[k].time, off);
        assertSameCost(scene->name);
    }
}

/* Where masses or velocities are still smaller, the fast solver's floats underflow: by 1e-22 of the size, which the
 * heap, where everything is hit by something, makes four times as much in each step. */
TEST(so_is_a_falling_heap_but_for_underflow) {
    static const Scene heap = {"heap of 80", makeHeap, 60, 0};
    static const Units less[] = {{-6, 0, -3}, {10, 0, 5}, {0, 20, 0}, {0, 0, -10}};
    play(&heap, (Units){0, 0, 0}, &one);
    for (size_t k = 0; k < sizeof less / sizeof *less; k++) {
        play(&heap, less[k], &other);
        assert_below(difference(&one, &other, heap.steps), 1e-15);
        assertSameCost(heap.name);
    }
}

/* ---- at 60 Hz and 9.81 m/s², with the defaults that follow the scales -------------------------------------------- */

static MeBool isAwake(int i) {
    return MdtBodyIsEnabled(McdModelGetBody(model[i]));
}

static double heightOf(int i) {
    MeVector3 p;
    MdtBodyGetPosition(McdModelGetBody(model[i]), p);
    return (double)(p[2] / lengthOf(1));
}

static void beginAtScale(int length) {
    MstUniverseSizes sizes = MstUniverseGrowingSizes;
    units = (Units){length, 0, 0};
    count = 0;
    sizes.lengthScale = lengthOf(1);
    universe_begin(&sizes);
    MdtWorldSetGravity(u->world, 0, 0, -9.81);
    MdtContactParamsSetSurface(surface(), .5, 0);
    makeFloor();
}

/* A box of 1 km falls for 17 s from where it is left. With a threshold of accelerations that grows with the scale, 700
 * m/s², it fell asleep after .2 s. */
TEST(what_falls_is_awake_and_what_lies_sleeps) {
    for (int length = -10; length <= 10; length += 5) {
        beginAtScale(length);
        add(box(1, 1, 1), 0, 0, 2);
        MdtBodyEnable(McdModelGetBody(model[0]));
        for (int i = 0; i < 1600 && isAwake(0); i++) {
            MstUniverseStep(u, 1. / 60);
            ck_assert_msg(isAwake(0) || heightOf(0) < .51, "asleep %g of its size above the ground, length 2^%d",
                          heightOf(0) - .5, length);
        }
        ck_assert_msg(!isAwake(0), "awake, length 2^%d", length);
        assert_near(heightOf(0), .5, TOL(1e-5, 1e-6));
    }
    messages_forget();
}

/* .02 and .5 of the guide are for 1 m; above 1.4 m a tenth of gravity is less. */
TEST(thresholds_of_rest_grow_with_the_scale_up_to_a_tenth_of_gravity) {
    beginAtScale(-3);
    assert_near_rel(MdtWorldGetAutoDisableVelocityThreshold(u->world), .02 / 64, 1e-6);
    assert_near_rel(MdtWorldGetAutoDisableAccelerationThreshold(u->world), .5 / 64, 1e-6);
    beginAtScale(3);
    const double tenth = .981 * .981;
    assert_near_rel(MdtWorldGetAutoDisableAccelerationThreshold(u->world), tenth, 1e-6);
    assert_near_rel(MdtWorldGetAutoDisableVelocityThreshold(u->world), .02 * tenth / .5, 1e-6);
    MdtWorldSetAutoDisableAccelerationThreshold(u->world, 3);
    MdtWorldSetGravity(u->world, 0, 0, -2);
    assert_near_rel(MdtWorldGetAutoDisableAccelerationThreshold(u->world), 3, 1e-6);
    assert_near_rel(MdtWorldGetAutoDisableVelocityThreshold(u->world), .02 * .04 / .5, 1e-6);
    MdtWorldSetGravity(u->world, 0, 0, 0);
    assert_near_rel(MdtWorldGetAutoDisableVelocityThreshold(u->world), .02 * 64, 1e-6);
}
