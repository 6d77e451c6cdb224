/* Continuous motion: what is fast meets what is in its way, in time, and all of the step is simulated. */
#include "universe.h"

#define STEP (1. / 60)

static MeMatrix4 place;
static MeU32 seed;

static void setUp(void) {
    universe_begin(0);
    MdtWorldSetGravity(u->world, 0, 0, 0);
    MdtWorldSetAutoDisable(u->world, 0);
    MeMatrix4TMMakeIdentity(place);
    seed = 1;
}

TEST_FIXTURE(setUp, NULL)

static double fraction(void) {
    seed = seed * 1664525u + 1013904223u;
    return seed / 4294967296.;
}

static double between(double low, double high) {
    return low + (high - low) * fraction();
}

static void step(void) {
    MstUniverseStep(u, STEP);
}

static void setRestitution(double e) {
    MdtContactParamsSetRestitution(MstBridgeGetContactParams(u->bridge, 0, 0), e);
}

static McdModelID makeBall(double radius) {
    McdModelID m = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, radius), 1000);
    McdModelSetSwept(m, METRUE);
    return m;
}

static void put(McdModelID m, const double at[3], const double velocity[3]) {
    McdModelDynamicsSetPosition(m, at[0], at[1], at[2]);
    McdModelDynamicsSetLinearVelocity(m, velocity[0], velocity[1], velocity[2]);
}

static void velocityOf(McdModelID m, double v[3]) {
    MeVector3 real;
    McdModelDynamicsGetLinearVelocity(m, real);
    for (int i = 0; i < 3; i++)
        v[i] = (double)real[i];
}

static double coordinate(McdModelID m, int axis) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    return (double)p[axis];
}

/* ---- bullets ----------------------------------------------------------------------------------------------------- */

/* A shot at the plane x = 0 from the side of negative x. Returns whether it went through; else all of its velocity is
 * as restitution has it, and it is where it came to in the time. */
static MeBool shoot(McdModelID ball, double radius, double wall, double e) {
    const double speed = between(50, 1500), distance = between(1, 40);
    const double to[3] = {0, between(-3, 3), between(-3, 3)};
    const double from[3] = {-distance, to[1] + between(-.8, .8) * distance, to[2] + between(-.8, .8) * distance};
    double v[3], now[3], way = 0;
    for (int i = 0; i < 3; i++)
        way += (to[i] - from[i]) * (to[i] - from[i]);
    for (int i = 0; i < 3; i++)
        v[i] = speed * (to[i] - from[i]) / sqrt(way);
    put(ball, from, v);
    int steps = 0;
    memcpy(now, v, sizeof now);
    for (; now[0] > 0 && coordinate(ball, 0) < 0 && steps < 100; steps++) {
        step();
        velocityOf(ball, now);
    }
    if (coordinate(ball, 0) > 0)
        return METRUE;
    assert_near_rel(now[0], -e * v[0], TOL(1e-5, 4e-14));
    assert_near(now[1], v[1], speed * TOL(1e-6, 6e-15));
    assert_near(now[2], v[2], speed * TOL(1e-6, 6e-15));
    const double met = (distance - radius - wall) / v[0]; /* s, and the time after it is not lost */
    assert_near(coordinate(ball, 0), -radius - wall - e * v[0] * (steps * STEP - met),
                TOL(1e-5, 4e-8) * (1 + distance));
    return MEFALSE;
}

TEST(no_bullet_tunnels_a_wall_of_two_centimetres) {
    MstFixedModelCreate(u, McdBoxCreate(u->frame, .02, 8, 8), place);
    McdModelID ball = makeBall(.05);
    setRestitution(.5);
    for (int i = 0; i < 1000; i++)
        ck_assert_msg(!shoot(ball, .05, .01, .5), "shot %d", i);
}

/* A wall that has lost its transform keeps its box, and with that its pairs: there is nothing to stop at. */
TEST(a_bullet_flies_on_where_a_wall_has_lost_its_transform) {
    for (int isReset = 0; isReset < 2; isReset++)
        for (int isCompound = 0; isCompound < 2; isCompound++) {
            setUp();
            McdGeometryID shape = McdBoxCreate(u->frame, .02, 8, 8);
            if (isCompound) {
                const McdAggregateID all = McdAggregateCreate(u->frame, 1);
                McdAggregateAddElement(all, shape, place);
                shape = all;
            }
            const McdModelID wall = MstFixedModelCreate(u, shape, place), ball = makeBall(.05);
            const double from[3] = {-10.5, 0, 0}, v[3] = {600, 0, 0};
            put(ball, from, v); /* the wall is in the box of its second step */
            step();
            if (isReset)
                McdModelReset(wall);
            else
                McdModelSetTransformPtr(wall, 0);
            step();
            assert_warned("transform");
            assert_near(coordinate(ball, 0), 9.5, TOL(1e-5, 1e-12));
        }
}

TEST(without_the_switch_they_tunnel) {
    int tunnels = 0;
    MstFixedModelCreate(u, McdBoxCreate(u->frame, .02, 8, 8), place);
    for (int i = 0; i < 100; i++) {
        McdModelID ball = makeBall(.05);
        McdModelSetSwept(ball, MEFALSE);
        const double from[3] = {between(-40, -1), 0, 0}, v[3] = {between(50, 1500), 0, 0};
        put(ball, from, v);
        for (int k = 0; k < 60; k++)
            step();
        tunnels += coordinate(ball, 0) > 0;
        MstModelAndBodyDestroy(ball);
    }
    ck_assert_int_gt(tunnels, 80);
}

/* The wall is a sheet of two triangles, or a field on its side; both face -x. */
static MeReal heights[9 * 9];
static MeVector3 corner[4] = {{0, -4, -4}, {0, 4, -4}, {0, 4, 4}, {0, -4, 4}};

static int MEAPI sheet(McdModelPair *pair, McdUserTriangle *triangle, MeVector3 pos, MeReal radius, int max) {
    static const int of[2][3] = {{0, 2, 1}, {0, 3, 2}};
    (void)pair, (void)pos, (void)radius;
    for (int i = 0; i < 2 && i < max; i++) {
        memset(&triangle[i], 0, sizeof triangle[i]);
        for (int c = 0; c < 3; c++)
            triangle[i].vertices[c] = &corner[of[i][c]];
        triangle[i].flags = kMcdTriangleStandard;
    }
    return MeMIN(2, max);
}

TEST(no_bullet_tunnels_a_triangle_list) {
    MeVector3 low = {0, -4, -4}, high = {0, 4, 4};
    MstFixedModelCreate(u, McdTriangleListCreate(u->frame, low, high, 8, sheet), place);
    McdModelID ball = makeBall(.05);
    setRestitution(.5);
    for (int i = 0; i < 1000; i++)
        ck_assert_msg(!shoot(ball, .05, 0, .5), "shot %d", i);
}

TEST(no_bullet_tunnels_a_height_field) {
    memset(heights, 0, sizeof heights);
    MeVector3Set(place[0], 0, 0, 1); /* its z is the world's -x */
    MeVector3Set(place[1], 0, 1, 0);
    MeVector3Set(place[2], -1, 0, 0);
    MstFixedModelCreate(u, McdRGHeightFieldCreate(u->frame, heights, 9, 9, 1, 1, -4, -4), place);
    McdModelID ball = makeBall(.05);
    setRestitution(.5);
    for (int i = 0; i < 1000; i++)
        ck_assert_msg(!shoot(ball, .05, 0, .5), "shot %d", i);
}

/* Between two walls 1 m apart, at 137 m/s: three impacts in a step. */
TEST(a_bullet_meets_several_walls_in_a_step) {
    static MeMatrix4 other;
    setRestitution(1);
    MeMatrix4TMMakeIdentity(other);
    other[3][0] = 1;
    MstFixedModelCreate(u, McdBoxCreate(u->frame, .02, 8, 8), place);
    MstFixedModelCreate(u, McdBoxCreate(u->frame, .02, 8, 8), other);
    McdModelID ball = makeBall(.05);
    const double from[3] = {.5, 0, 0}, v[3] = {137, 0, 0}, room = 1 - .02 - .1;
    put(ball, from, v);
    for (int i = 1; i <= 60; i++) {
        step();
        const double path = fmod(137 * STEP * i + room / 2, 2 * room); /* to and fro */
        const double expected = .06 + (path < room ? path : 2 * room - path);
        assert_near(coordinate(ball, 0), expected, TOL(5e-4, 3e-10));
    }
}

/* ---- rods -------------------------------------------------------------------------------------------------------- */

/* Which side of the rod's middle line the post at (d, 0) is on; 0: the rod does not reach it. */
static double sideOf(McdModelID rod, double d) {
    const MeMatrix4Ptr tm = McdModelGetTransformPtr(rod);
    const double x = d - (double)tm[3][0], y = -(double)tm[3][1];
    const double along = fabs((double)tm[0][0] * x + (double)tm[0][1] * y);
    return along < 1 ? (double)tm[0][0] * y - (double)tm[0][1] * x : 0;
}

/* 2 m, 2 x 2 cm; 60 rad/s, so 1 rad a step; the post 2 cm thick. */
static MeBool spin(MeBool isHinged) {
    const double d = between(.2, .95), angle = between(.15, ME_PI - .15);
    MeBool isThrough = MEFALSE;
    place[3][0] = (MeReal)d;
    MstFixedModelCreate(u, McdCylinderCreate(u->frame, .01, 4), place);
    McdModelID rod = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 2, .02, .02), 1000);
    McdModelSetSwept(rod, METRUE);
    McdModelDynamicsSetQuaternion(rod, cos(angle / 2), 0, 0, sin(angle / 2));
    McdModelDynamicsSetAngularVelocity(rod, 0, 0, 60);
    if (isHinged) {
        MdtHingeID hinge = MdtHingeCreate(u->world);
        MdtHingeSetBodies(hinge, McdModelGetBody(rod), 0);
        MdtHingeSetPosition(hinge, 0, 0, 0);
        MdtHingeSetAxis(hinge, 0, 0, 1);
        MdtHingeEnable(hinge);
    }
    for (int i = 0; i < 60; i++) {
        const double before = sideOf(rod, d);
        step();
        isThrough = isThrough || before * sideOf(rod, d) < 0;
    }
    return isThrough;
}

#ifdef TEST_IS_SLOW
enum { RODS = 40 };
#else
enum { RODS = 300 };
#endif

TEST(no_rod_tunnels_a_post) {
    for (int i = 0; i < RODS; i++) {
        universe_begin(0);
        MdtWorldSetGravity(u->world, 0, 0, 0);
        MeMatrix4TMMakeIdentity(place);
        setRestitution(1);
        ck_assert_msg(!spin(i % 2), "rod %d", i);
    }
}

/* ---- bodies among themselves ------------------------------------------------------------------------------------- */

/* A bullet of m at v sticks to a plate of M: both go on at m v / (m + M). */
TEST(a_bullet_pushes_a_plate) {
    McdModelID plate = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, .02, 4, 4), 100);
    McdModelID ball = makeBall(.05);
    const double m = MdtBodyGetMass(McdModelGetBody(ball)), M = (double)MdtBodyGetMass(McdModelGetBody(plate));
    const double from[3] = {-7, 0, 0}, v[3] = {900, 0, 0};
    double after[3];
    put(ball, from, v);
    for (int i = 0; i < 30; i++)
        step();
    velocityOf(plate, after);
    assert_near_rel(after[0], m * 900 / (m + M), TOL(1e-5, 9e-15));
    velocityOf(ball, after);
    assert_near_rel(after[0], m * 900 / (m + M), TOL(1e-5, 7e-13));
    const double met = (7 - .06) / 900;
    assert_near_rel(coordinate(plate, 0), (30 * STEP - met) * m * 900 / (m + M), TOL(5e-6, 9e-15));
}

TEST(bullets_meet_each_other) {
    McdModelID a = makeBall(.05), b = makeBall(.05);
    const double left[3] = {-9, 0, 0}, right[3] = {9, .02, 0}, v[3] = {700, 0, 0}, back[3] = {-800, 0, 0};
    double va[3], vb[3];
    setRestitution(1);
    put(a, left, v);
    put(b, right, back);
    for (int i = 0; i < 3; i++)
        step();
    velocityOf(a, va);
    velocityOf(b, vb);
    ck_assert(va[0] < 0 && vb[0] > 0);
    for (int i = 0; i < 3; i++)
        assert_near(va[i] + vb[i], v[i] + back[i], TOL(1e-3, 9e-13));
    assert_near_rel(va[0] * va[0] + va[1] * va[1] + vb[0] * vb[0] + vb[1] * vb[1], 700. * 700 + 800. * 800,
                    TOL(1e-5, 1e-9));
}

/* Two shapes that meet, one of them swept: the fast one, or the one that is slow or at rest. */
static McdGeometryID anyShape(double r) {
    const MeReal s = (MeReal)r;
    switch ((int)between(0, 4)) {
    case 0:
        return McdSphereCreate(u->frame, s);
    case 1:
        return McdBoxCreate(u->frame, 2 * s, s, s / 2);
    case 2:
        return McdSphylCreate(u->frame, s / 2, s);
    default:
        return McdCylinderCreate(u->frame, s, s / 2);
    }
}

static double logBetween(double low, double high) {
    return exp(between(log(low), log(high)));
}

/* Returns whether they have met. */
static MeBool meetHeadOn(void) {
    static const double steps[3] = {1. / 30, 1. / 60, 1. / 240}, ratios[5] = {0, .1, .5, 1, 3};
    static const MdtSolver solvers[3] = {MdtSolverAuto, MdtSolverExact, MdtSolverFast};
    const double h = steps[(int)between(0, 3)], speed = logBetween(10, 1000),
                 r[2] = {logBetween(.03, .3), logBetween(.03, .3)};
    const double v[2] = {speed, -speed * ratios[(int)between(0, 5)]}, aside = .2 * (r[0] + r[1]) * between(-1, 1);
    const double time = (4 * (r[0] + r[1]) + (v[0] - v[1]) * h * between(2, 3)) / (v[0] - v[1]);
    const int swept = (int)between(0, 2);
    McdModelID m[2];
    double now[2][3];
    MdtWorldSetSolver(u->world, solvers[(int)between(0, 3)]);
    for (int i = 0; i < 2; i++) {
        const double at[3] = {-v[i] * time, i * aside, 0}, velocity[3] = {v[i], 0, 0};
        m[i] = MstModelAndBodyCreate(u, anyShape(r[i]), 1000);
        put(m[i], at, velocity);
        McdModelSetSwept(m[i], i == swept);
        McdModelDynamicsSetQuaternion(m[i], (MeReal)between(-1, 1), (MeReal)between(-1, 1), (MeReal)between(-1, 1), 1);
    }
    for (int i = 0; i < (int)(time / h) + 3; i++)
        MstUniverseStep(u, (MeReal)h);
    velocityOf(m[0], now[0]);
    velocityOf(m[1], now[1]);
    for (int i = 0; i < 2; i++)
        MstModelAndBodyDestroy(m[i]);
    return fabs(now[0][0] - v[0]) > 1e-3 * speed || fabs(now[1][0] - v[1]) > 1e-3 * speed;
}

TEST(it_suffices_that_one_of_two_is_swept) {
    enum { COUNT = 200 };
    int met = 0;
    setRestitution(0);
    for (int i = 0; i < COUNT; i++)
        met += meetHeadOn();
    ck_assert_int_eq(met, COUNT);
}

/* A wall of boxes that sleeps: the bullet wakes it, does not go through, and loses what the boxes gain. A large one is
 * not held back by the bullet. */
static void shootWall(int columns, int rows) {
    enum { MAX = 64 };
    McdModelID box[MAX];
    double momentum = 0, v[3], x = 0;
    const int count = columns * rows, hit = columns / 2 + columns * (rows / 2);
    MdtWorldSetGravity(u->world, 0, 0, -10);
    MdtWorldSetAutoDisable(u->world, 1);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), place);
    McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    for (int i = 0; i < count; i++) {
        box[i] = MstModelAndBodyCreate(u, cube, 10);
        const double at[3] = {0, i % columns, i / columns + .5}, still[3] = {0, 0, 0};
        put(box[i], at, still);
    }
    for (int i = 0; i < 600 && McdModelDynamicsIsEnabled(box[hit]); i++)
        step();
    ck_assert(!McdModelDynamicsIsEnabled(box[hit]));
    McdModelID ball = makeBall(.05);
    const double from[3] = {-20, columns / 2 + .3, rows / 2 + .4}, fast[3] = {600, 0, 0};
    put(ball, from, fast);
    for (int i = 0; i < 4; i++)
        step();
    ck_assert(McdModelDynamicsIsEnabled(box[hit]));
    for (int i = 0; i < count; i++) {
        velocityOf(box[i], v);
        momentum += v[0] * (double)MdtBodyGetMass(McdModelGetBody(box[i]));
    }
    velocityOf(ball, v);
    const double m = MdtBodyGetMass(McdModelGetBody(ball));
    assert_near_rel(momentum + m * v[0], m * 600, TOL(2e-6, 9e-15)); /* the floor's friction took some */
    const MeMatrix4Ptr tm = McdModelGetTransformPtr(box[hit]);       /* in its frame the ball is before its face */
    for (int i = 0; i < 3; i++)
        x += (coordinate(ball, i) - coordinate(box[hit], i)) * (double)tm[0][i];
    assert_below(x, -.5);
}

TEST(a_bullet_breaks_a_sleeping_wall) {
    shootWall(3, 3);
}

TEST(a_bullet_breaks_a_large_wall) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    sizes.dynamicConstraintsMaxCount = 4000;
    universe_begin(&sizes);
    shootWall(8, 6);
}

/* ---- the step ---------------------------------------------------------------------------------------------------- */

/* A ball that is thrown on the floor, with its weight, an added force and a restitution. */
TEST(forces_act_in_all_parts_of_a_step) {
    const double from[3] = {0, 0, 20}, v[3] = {0, 0, -30}, time = 100 * STEP;
    setRestitution(.8);
    MdtWorldSetGravity(u->world, 0, 0, -10);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), place);
    McdModelID ball = makeBall(.05);
    put(ball, from, v);
    for (int i = 0; i < 100; i++) {
        McdModelDynamicsAddForce(ball, 0, 0, -10);
        step();
    }
    const double g = 10 + 10 / (double)MdtBodyGetMass(McdModelGetBody(ball));
    const double speed = sqrt(30 * 30 + 2 * g * (20 - .05)), rest = time - (speed - 30) / g;
    const double early = g / 2 * STEP * STEP; /* the impact is looked for with the velocity at the step's begin */
    assert_near(coordinate(ball, 2), .05 + .8 * speed * rest - g / 2 * rest * rest, early);
}

TEST(an_impact_in_the_middle_of_a_step_is_one_event) {
    MstFixedModelCreate(u, McdBoxCreate(u->frame, .02, 8, 8), place);
    McdModelID ball = makeBall(.05);
    const double from[3] = {-5, 0, 0}, v[3] = {400, 0, 0}, m = (double)MdtBodyGetMass(McdModelGetBody(ball));
    int count;
    setRestitution(.5);
    put(ball, from, v);
    step();
    const MstEvent *event = MstUniverseGetEvents(u, &count);
    ck_assert(count == 1 && event->kind == MstEventBegin);
    assert_near_rel(event->impulse, 1.5 * 400 * m, TOL(1e-5, 2e-14));
    assert_near_rel(event->approachSpeed, 400, TOL(1e-6, 9e-15));
    assert_vec3_near(event->position, -.01, 0, 0, TOL(9e-6, 9e-15));
    assert_vec3_near(event->normal, -1, 0, 0, TOL(1e-6, 9e-15));
    step();
    ck_assert(MstUniverseGetEvents(u, &count)->kind == MstEventEnd && count == 1);
}

/* ---- what is behind what was hit --------------------------------------------------------------------------------- */

/* A bullet hits a box at any time of a step; the box flies at another one, which has made its step already. The deepest
 * overlap of both, m. */
static double overlapBehind(double gap, double speed, double when) {
    const double bullet[3] = {-.3 - speed * STEP * when, 0, 0}, v[3] = {speed, 0, 0}, at[3] = {.4 + gap, 0, 0};
    const McdGeometryID cube = McdBoxCreate(u->frame, .4, .4, .4);
    const McdModelID hit = MstModelAndBodyCreate(u, cube, 15), behind = MstModelAndBodyCreate(u, cube, 15);
    double deepest = 0;
    McdModelDynamicsSetPosition(behind, at[0], at[1], at[2]);
    put(makeBall(.1), bullet, v);
    for (int i = 0; i < 6; i++) {
        step();
        deepest = fmax(deepest, .4 - (coordinate(behind, 0) - coordinate(hit, 0)));
    }
    return deepest;
}

TEST(what_a_bullet_hits_stops_at_what_is_behind) {
    static const double speeds[] = {50, 100, 200, 400};
    for (int gap = 1; gap <= 8; gap++)
        for (int s = 0; s < 4; s++)
            for (int when = 1; when < 10; when += 2) {
                setUp();
                assert_below(overlapBehind(.01 * gap, speeds[s], .1 * when), TOL(4e-6, 2e-12));
            }
}

/* Balls one behind the other meet a wall: none goes through the one before it, which stops in the middle of a step. */
TEST(balls_in_a_row_do_not_pass_each_other) {
    enum { BALLS = 5 };
    static const double speeds[] = {20, 50, 200, 800}, gaps[] = {.01, .03, .1, .3, 1, 2};
    for (int s = 0; s < 4; s++)
        for (int g = 0; g < 6; g++)
            for (int when = 0; when < 8; when++) {
                McdModelID ball[BALLS];
                setUp();
                MstFixedModelCreate(u, McdBoxCreate(u->frame, .02, 50, 50), place);
                for (int i = 0; i < BALLS; i++) {
                    const double v[3] = {speeds[s], 0, 0};
                    const double from[3] = {-.2 - v[0] * STEP * when / 8 - (gaps[g] + .2) * i, 0, 0};
                    put(ball[i] = makeBall(.1), from, v);
                }
                for (int i = 0; i < 6; i++) {
                    step();
                    assert_below(coordinate(ball[0], 0), -.1);
                    for (int k = 1; k < BALLS; k++)
                        assert_below(.2 - 2e-3, coordinate(ball[k - 1], 0) - coordinate(ball[k], 0));
                }
            }
}

/* ---- crowds ------------------------------------------------------------------------------------------------------ */

static void beginCrowd(void) {
    setUp();
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, 0);
    MdtWorldSetAutoDisable(u->world, 0);
}

/* A wall of boxes that touch each other flies at a thin wall: all of its partition is stopped. */
TEST(a_wall_that_flies_tunnels_nothing) {
    enum { SIDE = 6 };
    static const double speeds[] = {30, 150, 500};
    for (int s = 0; s < 3; s++)
        for (int when = 0; when < 8; when += 3) {
            McdModelID box[SIDE * SIDE];
            beginCrowd();
            MstFixedModelCreate(u, McdBoxCreate(u->frame, .02, 8, 8), place);
            const McdGeometryID cube = McdBoxCreate(u->frame, .2, .2, .2);
            for (int i = 0; i < SIDE * SIDE; i++) {
                const double v[3] = {speeds[s], 0, 0};
                const double from[3] = {-.3 - v[0] * STEP * (2 + .125 * when), .2 * (i % SIDE), .2 * (i / SIDE)};
                box[i] = MstModelAndBodyCreate(u, cube, 1000);
                McdModelSetSwept(box[i], METRUE);
                put(box[i], from, v);
            }
            for (int i = 0; i < 10; i++)
                step();
            for (int i = 0; i < SIDE * SIDE; i++)
                assert_below(coordinate(box[i], 0), 0);
        }
}

#ifndef TEST_IS_SLOW
/* m, the deepest overlap that a contact tells. */
static double deepestOverlap(void) {
    double deepest = 0;
    for (MdtBodyID b = MdtBodyGetFirst(u->world); b; b = MdtBodyGetNext(b))
        for (MdtContactID c = MdtBodyGetFirstContact(b); c; c = MdtBodyGetNextContact(b, c))
            deepest = fmax(deepest, (double)MdtContactGetPenetration(c));
    return deepest;
}

/* Boxes rain on each other at up to 20 m/s. The deepest overlap of a step on average, m, from the first second on. */
static double overlapOfRain(MeBool isSwept) {
    enum { BOXES = 250, STEPS = 220, FALL = 60 };
    double sum = 0;
    beginCrowd();
    MdtWorldSetGravity(u->world, 0, 0, -9.81);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), place);
    const McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    for (int i = 0; i < BOXES; i++) {
        const McdModelID m = MstModelAndBodyCreate(u, cube, 1);
        McdModelDynamicsSetPosition(m, between(-2, 2), between(-2, 2), 2 + 1.2 * (i / 4));
        McdModelDynamicsSetQuaternion(m, between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
        McdModelSetSwept(m, isSwept);
    }
    for (int i = 0; i < STEPS; i++) {
        step();
        sum += i < FALL ? 0 : deepestOverlap();
    }
    return sum / (STEPS - FALL);
}

TEST(a_crowd_that_is_swept_overlaps_little_more_than_one_that_is_not) {
    assert_below(overlapOfRain(METRUE), 1.5 * overlapOfRain(MEFALSE));
}
#endif

/* ---- impulses ---------------------------------------------------------------------------------------------------- */

/* A ball at rest, asleep or not, swept or not, gets its speed by an impulse, .1 m before a wall. Where it is then. */
static double throwByImpulse(MeBool isAsleep, MeBool isSwept, double speed, double thickness) {
    const double still[3] = {0, 0, 0}, from[3] = {-thickness / 2 - .2, 0, 0};
    setUp();
    MstFixedModelCreate(u, McdBoxCreate(u->frame, thickness, 8, 8), place);
    const McdModelID ball = makeBall(.1);
    const MdtBodyID body = McdModelGetBody(ball);
    McdModelSetSwept(ball, isSwept);
    put(ball, from, still);
    MdtWorldSetAutoDisable(u->world, METRUE);
    for (int i = 0; i < (isAsleep ? 200 : 1); i++)
        step();
    ck_assert(MdtBodyIsEnabled(body) != isAsleep);
    MdtBodyAddImpulse(body, speed * (double)MdtBodyGetMass(body), 0, 0);
    for (int i = 0; i < 10; i++)
        step();
    return coordinate(ball, 0);
}

TEST(what_an_impulse_throws_meets_the_wall_in_its_first_step) {
    for (int isAsleep = 0; isAsleep < 2; isAsleep++)
        for (double speed = 5; speed <= 1000; speed *= 1.3) {
            assert_below(throwByImpulse(isAsleep, METRUE, speed, .02), 0);
            if (speed < 25) /* it goes less than the wall's thickness in a step, and does not sink in */
                assert_below(throwByImpulse(isAsleep, MEFALSE, speed, 1), -.6 + 1e-3);
        }
}
