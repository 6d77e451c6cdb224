/* Characters that are moved: walls, corners, slopes, stairs, triangles, lifts, pushes. */
#include "MstMover.h"
#include "universe.h"
#include <math.h>

#define STEP    (1. / 60)
#define GRAVITY 9.8
static const double degree = ME_PI / 180;

enum { MAX_FIXED = 64 };
static MeMatrix4 fixedTM[MAX_FIXED];
static int fixedCount;
static MstMoverID mover;
static MstMoverResult at; /* after the last move */
static MeVector3 speed;   /* what the character wants */

static void destroyMover(void *none) {
    (void)none;
    MstMoverDestroy(mover);
    mover = 0;
}

static void begin(void) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, (MeReal)-GRAVITY);
    fixedCount = 0;
    MeVector3Set(speed, 0, 0, 0);
}

/* Turned by an angle about axis 0, 1 or 2. */
static McdModelID fixed(McdGeometryID g, double x, double y, double z, int axis, double angle) {
    MeMatrix4Ptr tm = fixedTM[fixedCount++];
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    MeMatrix4TMMakeIdentity(tm);
    tm[i][i] = tm[j][j] = (MeReal)cos(angle);
    tm[i][j] = (MeReal)sin(angle);
    tm[j][i] = (MeReal)-sin(angle);
    MeMatrix4TMSetPosition(tm, (MeReal)x, (MeReal)y, (MeReal)z);
    return MstFixedModelCreate(u, g, tm);
}

static McdModelID block(double lx, double ly, double lz, double x, double y, double z) {
    return fixed(McdBoxCreate(u->frame, (MeReal)lx, (MeReal)ly, (MeReal)lz), x, y, z, 0, 0);
}

/* After a first step, which makes the boxes of all models. */
static void create(const MstMoverParams *params, double x, double y, double z) {
    const MeVector3 place = {(MeReal)x, (MeReal)y, (MeReal)z};
    MstMoverParams defaults;
    MstMoverSetDefaults(&defaults, u);
    if (mover)
        MstMoverDestroy(mover);
    else
        test_finally(destroyMover, NULL);
    universe_step(1);
    mover = MstMoverCreate(u, params ? params : &defaults, place);
    ck_assert(mover);
    memset(&at, 0, sizeof at);
}

/* Walks towards `speed`, and falls, as a program's character does. */
static void walk(int steps) {
    for (int i = 0; i < steps; i++) {
        const MeReal fall = at.flags & kMstMoverOnGround ? 0 : at.velocity[2] - (MeReal)(GRAVITY * STEP);
        const MeVector3 velocity = {speed[0], speed[1], fall};
        MstMoverMove(mover, velocity, (MeReal)STEP, &at);
        universe_step(1);
    }
}

static void want(double vx, double vy) {
    MeVector3Set(speed, (MeReal)vx, (MeReal)vy, 0);
}

static const double skin = .02, radius = .3;

/* ---- ground and walls ---- */

TEST(it_falls_onto_the_floor_and_stands) {
    begin();
    universe_addFloor();
    create(0, 0, 0, 1);
    walk(60);
    ck_assert_int_eq(at.flags, kMstMoverOnGround);
    assert_near(at.position[2], skin, TOL(1e-6, 1e-6));
    walk(60);
    assert_near(at.position[0], 0, 1e-12);
    assert_near(at.position[2], skin, TOL(1e-6, 1e-6));
}

TEST(it_walks_at_its_speed_and_stops_at_a_wall) {
    begin();
    universe_addFloor();
    block(1, 10, 4, 3.5, 0, 2);
    create(0, 0, 0, .05);
    walk(10);
    want(3, 0);
    walk(30);
    assert_near(at.position[0], 1.5, TOL(1e-5, 1e-9));
    walk(60);
    assert_near(at.position[0], 3 - radius - skin, skin);
    ck_assert_int_eq(at.flags, kMstMoverOnGround | kMstMoverSide);
    assert_near(at.velocity[0], 0, TOL(1e-6, 1e-9));
    want(3, 3);
    walk(30);
    assert_near(at.position[1], 1.5, TOL(1e-3, 1e-3));
    ck_assert(at.position[0] + radius < 3);
}

/* Nothing is felt of the joints of a floor and a wall of tiles: neither speed nor height nor distance changes. */
LOOP_TEST(it_does_not_feel_flush_tiles, 0, 4) {
    static const double sizes[] = {.07, .15, .4, 1};
    const double tile = sizes[_i], end = fmin(4, 7 * tile);
    begin();
    universe_addFloor();
    for (int i = 0; i < 7; i++)
        for (int j = 0; j < 4; j++)
            block(tile, 2, .1, tile * (i + .5), 2 * j - 3, .05);
    for (int i = 0; i < 7; i++)
        block(tile, 1, 4, tile * (i + .5), 1, 2);
    create(0, .01, .5 - radius - skin, .1 + skin);
    want(1, .2);
    walk(2);
    const double x = (double)at.position[0], y = (double)at.position[1];
    int steps = 0;
    for (; (double)at.position[0] < end - .05; steps++) {
        walk(1);
        assert_near(at.position[0], x + (steps + 1) * STEP, TOL(1e-5, 1e-6));
        assert_near(at.position[1], y, TOL(1e-5, 1e-6));
        assert_near(at.position[2], .1 + skin, TOL(1e-5, 1e-6));
    }
    ck_assert_int_gt(steps, 5);
}

/* ---- corners ---- */

/* Two walls that meet at an angle; it runs into the corner from all sides. */
static void runIntoCorner(double angle, double heading) {
    const double start = .5 + (radius + .1) / sin(angle / 2), length = start + 20;
    begin();
    universe_addFloor();
    for (int i = 0; i < 2; i++) {
        const double a = (i ? 1 : -1) * angle / 2, out = i ? 1 : -1; /* the wall's direction; its body is outside */
        fixed(McdBoxCreate(u->frame, (MeReal)length, 1, 4), length / 2 * cos(a) - out * .5 * sin(a),
              length / 2 * sin(a) + out * .5 * cos(a), 2, 2, a);
    }
    create(0, start, 0, .05);
    walk(5);
    want(4 * cos(heading), 4 * sin(heading));
    walk(200);
}

static double gapOfWalls(double angle) {
    const double a = angle / 2;
    return fmin(sin(a) * (double)at.position[0] - cos(a) * (double)at.position[1],
                sin(a) * (double)at.position[0] + cos(a) * (double)at.position[1]) -
           radius;
}

LOOP_TEST(it_is_neither_through_nor_stuck_in_corners, 0, 12) {
    static const double angles[] = {1, 2, 3, 5, 10, 30, 60, 90, 120, 150, 175, 179};
    const double angle = angles[_i] * degree;
    for (int k = -2; k <= 2; k++) {
        runIntoCorner(angle, ME_PI + .2 * k);
        ck_assert_msg(gapOfWalls(angle) > 0, "angle %g heading %d: gap %g", angles[_i], k, gapOfWalls(angle));
        const double x = (double)at.position[0];
        want(4, 0);
        walk(30);
        ck_assert_msg((double)at.position[0] > x + 1.9, "angle %g heading %d: from %g to %g", angles[_i], k, x,
                      (double)at.position[0]);
    }
}

/* ---- slopes ---- */

LOOP_TEST(it_climbs_slopes_up_to_the_limit, 0, 6) {
    static const double angles[] = {10, 30, 48, 52, 65, 80};
    const double a = angles[_i] * degree;
    begin();
    universe_addFloor();
    fixed(McdBoxCreate(u->frame, 20, 20, 1), 10 * cos(a) + .5 * sin(a), 0, 10 * sin(a) - .5 * cos(a), 1, -a);
    create(0, -2, 0, .05);
    walk(5);
    want(3, 0);
    walk(100);
    if (a < 50 * degree) {
        assert_near(at.position[0], 3, .1);
        ck_assert_int_eq(at.flags & kMstMoverOnGround, kMstMoverOnGround);
        const double above = (double)at.position[2] * cos(a) - (double)at.position[0] * sin(a) - radius * (1 - cos(a));
        assert_near(above, skin, skin);
        const double x = (double)at.position[0], z = (double)at.position[2];
        want(0, 0); /* it does not creep */
        walk(60);
        assert_near(at.position[0], x, TOL(1e-5, 1e-5));
        assert_near(at.position[2], z, TOL(1e-5, 1e-5) + skin);
        want(-3, 0); /* down, without hops */
        for (int i = 0; i < 30; i++) {
            walk(1);
            ck_assert(at.flags & kMstMoverOnGround);
        }
        assert_near(at.position[0], x - 1.5, 1e-3);
    } else {
        ck_assert_msg((double)at.position[2] < .4, "climbed %g", (double)at.position[2]);
        ck_assert_msg((double)at.position[0] < .3, "came to %g", (double)at.position[0]);
    }
}

/* Where it cannot fall any further it stands, and may jump. */
TEST(it_stands_between_steep_slopes_and_jumps) {
    const double a = 60 * degree;
    begin();
    for (int side = -1; side <= 1; side += 2)
        fixed(McdBoxCreate(u->frame, 20, 20, 1), side * (10 * cos(a) + .5 * sin(a)), 0, 10 * sin(a) - .5 * cos(a), 1,
              -side * a);
    create(0, .2, 0, 2);
    walk(120);
    ck_assert_int_eq(at.flags & kMstMoverOnGround, kMstMoverOnGround);
    const double z = (double)at.position[2];
    assert_near(z + radius, (radius + skin) / cos(a), skin);
    walk(30);
    assert_near(at.position[2], z, TOL(1e-5, 1e-6));
    const MeVector3 jump = {0, 0, 4};
    MstMoverMove(mover, jump, (MeReal)STEP, &at);
    walk(5);
    ck_assert((double)at.position[2] > z + .2);
}

/* ---- stairs ---- */

LOOP_TEST(it_climbs_stairs_up_and_down, 0, 4) {
    static const double heights[] = {.05, .15, .3, .45}, depths[] = {.3, .25, .4, .5};
    const double rise = heights[_i], depth = depths[_i];
    begin();
    universe_addFloor();
    for (int i = 0; i < 10; i++)
        block(10, 4, rise, 5 + depth * i, 0, rise * (i + .5));
    create(0, -1, 0, .05);
    walk(5);
    want(2, 0);
    walk(240);
    const double top = 10 * rise;
    if (rise > .35) {
        ck_assert((double)at.position[2] < .1);
        return;
    }
    assert_near(at.position[0], 7, .15);
    assert_near(at.position[2], top + skin, TOL(1e-5, 1e-6));
    want(-2, 0);
    for (int i = 0; i < 240; i++) {
        walk(1);
        ck_assert_msg(at.flags & kMstMoverOnGround, "in the air at %g", (double)at.position[0]);
    }
    assert_near(at.position[2], skin, TOL(1e-5, 1e-6));
}

/* ---- lifts ---- */

static MdtBodyID platform(double x, double z, double vx, double vz) {
    const McdModelID cm = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 4, 4, 1), 1000);
    const MdtBodyID b = McdModelGetBody(cm);
    MdtBodySetPosition(b, (MeReal)x, 0, (MeReal)z);
    MdtBodySetKinematic(b, METRUE);
    MdtBodySetLinearVelocity(b, (MeReal)vx, 0, (MeReal)vz);
    return b;
}

LOOP_TEST(it_rides_lifts_and_ferries, 0, 6) {
    static const double vx[] = {0, 0, 3, -3, 2, 20}, vz[] = {2, -2, 0, 0, 5, 0};
    MeVector3 x;
    begin();
    const MdtBodyID lift = platform(0, -.5, 0, 0);
    create(0, 0, 0, .05);
    walk(10);
    MdtBodySetLinearVelocity(lift, (MeReal)vx[_i], 0, (MeReal)vz[_i]);
    walk(60);
    ck_assert(at.flags & kMstMoverOnGround);
    MdtBodyGetPosition(lift, x); /* one step later than the mover */
    assert_near(at.position[0], (double)x[0] - vx[_i] * STEP, TOL(1e-4, 1e-6));
    assert_near(at.position[2], (double)x[2] + .5 + skin - vz[_i] * STEP, TOL(1e-4, 1e-5));
    assert_near(at.groundVelocity[0], vx[_i], TOL(1e-3, 1e-6));
    const MeVector3 jump = {0, 0, 10};
    MstMoverMove(mover, jump, (MeReal)STEP, &at);
    assert_near(at.velocity[0], vx[_i], TOL(1e-3, 1e-6));
    assert_near(at.velocity[2], 10 + vz[_i], TOL(1e-3, 1e-6));
}

TEST(a_pusher_pushes_it_and_never_goes_through) {
    begin();
    universe_addFloor();
    const MdtBodyID wall = platform(-4, 1, 5, 0);
    create(0, 0, 0, .05);
    walk(90);
    MeVector3 x;
    MdtBodyGetPosition(wall, x);
    ck_assert_msg((double)at.position[0] - radius > (double)x[0] + 2 - 5 * STEP - skin, "%g %g", (double)at.position[0],
                  (double)x[0]);
}

/* ---- pushes ---- */

TEST(it_pushes_bodies_with_its_strength) {
    static const double masses[] = {10, 1000};
    for (int i = 0; i < 2; i++) {
        begin();
        universe_addFloor();
        MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), 0, 0);
        const McdModelID cm = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 1, 1, 1), (MeReal)masses[i]);
        const MdtBodyID b = McdModelGetBody(cm);
        MdtBodySetPosition(b, 1.5, 0, .5);
        create(0, 0, 0, .05);
        walk(10);
        want(2, 0);
        walk(60);
        MeVector3 v;
        MdtBodyGetLinearVelocity(b, v);
        ck_assert_msg((double)v[0] > 0 && (double)v[0] < 2.01, "%g", (double)v[0]);
        if (i == 0)
            assert_near(v[0], 2, .05);
        else
            ck_assert_msg((double)v[0] <= 500. / 1000 * 1 + .01, "%g", (double)v[0]);
    }
}

/* ---- crouching ---- */

TEST(it_stands_up_only_where_there_is_room) {
    begin();
    universe_addFloor();
    block(2, 2, 1, 3, 0, 1.7);
    create(0, 0, 0, .05);
    walk(5);
    ck_assert(MstMoverSetHeight(mover, (MeReal)1));
    want(3, 0);
    walk(60);
    ck_assert((double)at.position[0] > 2.5);
    ck_assert(!MstMoverSetHeight(mover, (MeReal)1.8));
    assert_near(MstMoverGetHeight(mover), 1, 1e-6);
    walk(60);
    ck_assert(MstMoverSetHeight(mover, (MeReal)1.8));
}

/* ---- triangles ---- */

enum { CELLS = 16, TRIANGLES = 2 * CELLS * CELLS + 40 };
static MeVector3 vertex[3 * TRIANGLES];
static int index_[3 * TRIANGLES];
static unsigned int seed;

static double between(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(seed >> 8) / 16777216.0;
}

/* Bumps of any steepness whose columns nearly meet in places, and thin triangles that stand about. */
static void roughGround(void) {
    MeReal height[CELLS + 1][CELLS + 1], aside[CELLS + 1][CELLS + 1];
    int n = 0;
    for (int j = 0; j <= CELLS; j++)
        for (int i = 0; i <= CELLS; i++) {
            height[j][i] = (MeReal)(between(0, 1) < .1 ? between(0, 2.5) : between(.01, .5));
            aside[j][i] = (MeReal)(between(0, 1) < .3 ? between(-.499, .499) : 0);
        }
    for (int k = 0; k < CELLS * CELLS; k++) {
        static const int corner[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
        for (int c = 0; c < 6; c++, n++) {
            const int i = k % CELLS + corner[c][0], j = k / CELLS + corner[c][1];
            MeVector3Set(vertex[n], (MeReal)i - CELLS / 2 + aside[j][i], (MeReal)j - CELLS / 2, height[j][i]);
        }
    }
    for (int k = 0; k < 40; k++, n += 3) {
        const double x = between(-8, 8), y = between(-8, 8), a = between(0, 6.28), l = between(.5, 4),
                     e = between(1e-4, 1e-2);
        MeVector3Set(vertex[n], (MeReal)x, (MeReal)y, (MeReal)between(.2, 1));
        MeVector3Set(vertex[n + 1], (MeReal)(x + l * cos(a)), (MeReal)(y + l * sin(a)), (MeReal)between(0, 1.5));
        MeVector3Set(vertex[n + 2], (MeReal)(x + e), (MeReal)(y + e), vertex[n][2] + (MeReal)e);
    }
    for (int i = 0; i < n; i++)
        index_[i] = i;
    const McdGeometryID mesh = (McdGeometryID)McdMeshCreateWithFlags(u->frame, (const MeVector3 *)vertex, n, index_,
                                                                     n / 3, 0, kMcdMeshTwoSided);
    fixed(mesh, 0, 0, 0, 0, 0);
}

static double gapAt(McdGeometryID capsule) {
    MeMatrix4 tm;
    McdClosestResult closest;
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMSetPosition(tm, at.position[0], at.position[1], at.position[2] + (MeReal).9);
    McdSpaceEndChanges(u->space);
    const int found = McdSpaceGetClosest(u->space, capsule, tm, (MeReal).02, 0, 0, &closest);
    McdSpaceBeginChanges(u->space);
    return found ? (double)closest.distance : .02;
}

/* The gap is never less than half of the skin, by another query; and it is never still for long. */
LOOP_TEST(it_runs_about_among_bumps_and_slivers, 0, 4) {
    static const double speeds[] = {3, 6, 15, 60};
    begin();
    seed = (unsigned int)_i + 1;
    universe_addFloor();
    for (int k = 0; k < 4; k++)
        block(k % 2 ? 40 : 2, k % 2 ? 2 : 40, 100, k == 0 ? 9 : k == 2 ? -9 : 0, k == 1 ? 9 : k == 3 ? -9 : 0, 50);
    roughGround();
    const McdGeometryID capsule = McdSphylCreate(u->frame, (MeReal)radius, (MeReal)1.2);
    create(0, 0, 0, 5);
    int still = 0;
    for (int k = 0; k < 600; k++) {
        if (k % 30 == 0) {
            const double a = between(0, 6.28), v = speeds[_i] * between(.3, 1);
            want(v * cos(a), v * sin(a));
        }
        const MeVector3 before = {at.position[0], at.position[1], at.position[2]};
        walk(1);
        still = MeVector3Dot(before, before) > 0 && memcmp(before, at.position, sizeof before) == 0 ? still + 1 : 0;
        ck_assert_int_lt(still, 200);
        ck_assert_msg(gapAt(capsule) > .0099, "step %d: gap %g", k, gapAt(capsule));
    }
    ck_assert(fabs((double)at.position[0]) < 8 && fabs((double)at.position[1]) < 8 && (double)at.position[2] > 0);
}

/* ---- what bodies do to it; repetition; misuse ---- */

TEST(a_body_that_slides_into_it_pushes_it) {
    begin();
    universe_addFloor();
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), 0, 0);
    const MdtBodyID b = McdModelGetBody(MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 1, 1, 1), 1000));
    MdtBodySetPosition(b, -2, 0, (MeReal).5);
    create(0, 0, 0, .05);
    walk(10);
    MdtBodySetLinearVelocity(b, 3, 0, 0);
    walk(60);
    MeVector3 x;
    MdtBodyGetPosition(b, x);
    ck_assert_msg((double)at.position[0] - radius > (double)x[0] + .5 - 3 * STEP - skin && (double)at.position[0] > .5,
                  "%g %g", (double)at.position[0], (double)x[0]);
}

/* The same models created in another order give the same bits if their sort keys are the same. */
TEST(the_order_of_creation_does_not_matter_beside_sort_keys) {
    MeVector3 end[2];
    for (int order = 0; order < 2; order++) {
        begin();
        universe_addFloor();
        for (int i = 0; i < 12; i++) {
            const int k = order ? 11 - i : i;
            const McdModelID cm = fixed(McdBoxCreate(u->frame, 1, 1, (MeReal)(.1 + .05 * k)), 1 + .7 * (k % 4),
                                        .6 * (k / 4), 0, 2, .3 * k);
            McdSpaceRemoveModel(cm);
            McdModelSetSortKey(cm, (MeI16)(k + 1));
            McdSpaceInsertModel(u->space, cm);
        }
        create(0, 0, 0, .05);
        want(2, .7);
        walk(150);
        MeVector3Copy(end[order], at.position);
    }
    ck_assert(memcmp(end[0], end[1], sizeof end[0]) == 0);
}

TEST(bad_arguments_are_refused) {
    MstMoverParams p;
    const MeVector3 place = {0, 0, 0}, bad = {(MeReal)NAN, 0, 0};
    begin();
    create(0, 1, 2, 3);
    MstMoverSetDefaults(&p, u);
    assert_refused(MstMoverSetDefaults, 0, u);
    assert_none(MstMoverCreate, 0, &p, place);
    assert_none(MstMoverCreate, u, 0, place);
    assert_none(MstMoverCreate, u, &p, bad);
    p.height = p.radius;
    assert_none(MstMoverCreate, u, &p, place);
    assert_refused(MstMoverMove, mover, bad, (MeReal)STEP, &at);
    assert_refused(MstMoverMove, mover, place, 0, &at);
    assert_refused(MstMoverMove, 0, place, (MeReal)STEP, &at);
    assert_refused(MstMoverSetPosition, mover, bad);
    assert_none(MstMoverSetHeight, mover, (MeReal).1);
    assert_none(MstMoverGetHeight, 0);
    MeVector3 x;
    MstMoverGetPosition(mover, x);
    assert_vec3_near(x, 1, 2, 3, 0);
}
