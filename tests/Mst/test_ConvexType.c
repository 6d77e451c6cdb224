/* Convex shapes of a program, by their support function (McdConvexType.h), as bodies in a world. */
#include "own_shapes.h"
#include "universe.h"
#include <stdatomic.h>

static MeMatrix4 ground[20];
static int grounds;
static MeBool isGroundKinematic; /* each is a kinematic body at rest */
static MeU32 seed;

static double between(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (seed / 4294967296.);
}

static void begin(double gravity, double friction) {
    universe_begin(&MstUniverseGrowingSizes);
    grounds = 0;
    isGroundKinematic = MEFALSE;
    seed = 1;
    MdtWorldSetGravity(u->world, 0, 0, (MeReal)-gravity);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal)friction, 0);
}

static void addFixed(McdGeometryID g, double x, double y, double z) {
    MeMatrix4Ptr tm = ground[grounds++];
    if (isGroundKinematic) {
        const McdModelID m = McdModelCreate(g);
        McdModelSetBody(m, MdtBodyCreate(u->world));
        McdSpaceInsertModel(u->space, m);
        MdtBodySetKinematic(McdModelGetBody(m), METRUE);
        McdModelDynamicsSetPosition(m, (MeReal)x, (MeReal)y, (MeReal)z);
        MdtBodyEnable(McdModelGetBody(m));
        return;
    }
    MeMatrix4TMMakeIdentity(tm);
    MeVector3Set(tm[3], (MeReal)x, (MeReal)y, (MeReal)z);
    MstFixedModelCreate(u, g, tm);
}

static McdModelID put(McdGeometryID g, double x, double y, double z) {
    const McdModelID m = MstModelAndBodyCreate(u, g, 1000);
    McdModelDynamicsSetPosition(m, (MeReal)x, (MeReal)y, (MeReal)z);
    MdtBodyEnable(McdModelGetBody(m));
    return m;
}

static double coordinate(McdModelID m, int axis) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    return (double)p[axis];
}

/* A tapered capsule whose middle of mass is the origin of its body's. */
static McdModelID putTaper(double lower, double upper, double length, double x, double y, double z) {
    MeMatrix4 at;
    MeMatrix3 inertia;
    MeReal volume;
    McdGeometryID g = taper_create(u->frame, lower, upper, length);
    McdModelID m = put(g, x, y, z);
    McdGeometryGetMassProperties(g, at, inertia, &volume);
    MdtBodySetCenterOfMassRelativePosition(McdModelGetBody(m), at[3]);
    return m;
}

/* ---- standing, lying --------------------------------------------------------------------------------------------- */

TEST(a_stack_of_five_stands) {
    McdModelID m[5];
    begin(9.81, .5);
    universe_addFloor();
    for (int i = 0; i < 5; i++)
        m[i] = put(brick_create(u->frame, 1, 1, .5, 0), .05 * (i % 2), .03 * (i % 3), .25 + .5 * i);
    universe_step(600);
    for (int i = 0; i < 5; i++) {
        assert_near(coordinate(m[i], 0), .05 * (i % 2), 1e-7);
        assert_near(coordinate(m[i], 1), .03 * (i % 3), 1e-7);
        assert_near(coordinate(m[i], 2), .25 + .5 * i, TOL(1e-6, 1e-6));
        ck_assert(!MdtBodyIsEnabled(McdModelGetBody(m[i])));
    }
}

/* It lies on the line that touches both balls: its axis rises by the angle whose sine is the difference of the radii
 * over the length. */
TEST(a_tapered_capsule_lies_on_its_side) {
    begin(9.81, .8);
    universe_addFloor();
    McdModelID m = putTaper(.3, .15, .6, 0, 0, .3);
    MdtBodySetQuaternion(McdModelGetBody(m), MeSqrt((MeReal).5), MeSqrt((MeReal).5), 0, 0);
    universe_step(600);
    const MeMatrix4Ptr tm = McdModelGetTransformPtr(m);
    assert_near(tm[2][2], -.15 / .6, 1e-3); /* gaps of round surfaces below a thousandth of the size are kept */
    ck_assert(!MdtBodyIsEnabled(McdModelGetBody(m)));
}

TEST(a_capsule_rolls_as_a_sphyl_does) {
    double way[2];
    for (int own = 0; own < 2; own++) {
        begin(9.81, .8);
        universe_addFloor();
        McdModelID m = put(own ? can_create(u->frame, .3, 1, 1) : McdSphylCreate(u->frame, (MeReal).3, 1), 0, 0, .3);
        MdtBodySetQuaternion(McdModelGetBody(m), MeSqrt((MeReal).5), MeSqrt((MeReal).5), 0, 0);
        MdtBodySetLinearVelocity(McdModelGetBody(m), 2, 0, 0);
        MdtBodySetAngularVelocity(McdModelGetBody(m), 0, (MeReal)(2 / .3), 0);
        universe_step(300);
        way[own] = coordinate(m, 0);
        assert_near(coordinate(m, 1), 0, TOL(1e-5, 1e-9));
        assert_near(coordinate(m, 2), .3, TOL(1e-6, 1e-9));
    }
    assert_near(way[0], 10, TOL(1e-4, 1e-9));
    assert_near(way[1], way[0], TOL(1e-4, 1e-7));
}

/* ---- rocking ----------------------------------------------------------------------------------------------------- */

typedef struct Rock {
    double frequency, kept; /* over the formula's; amplitude at the end over that of the beginning */
} Rock;

/* An ellipsoid rocks about y on a plane, without slip. With half axes a along x and c along z the surface has the
 * radius R = a² / c at the bottom, the energy is m g (R - c) θ² / 2 + m (k² + c²) θ'² / 2, k² = (a² + c²) / 5. */
static Rock rock(double a, double b, double c, int rate, double amplitude) {
    enum { SECONDS = 10 };
    begin(9.81, 1);
    universe_addFloor();
    MdtWorldSetAutoDisable(u->world, 0);
    MdtBodyID body = McdModelGetBody(put(ellipsoid_create(u->frame, a, b, c), 0, 0, c));
    const double w = sqrt(9.81 * (a * a / c - c) / ((a * a + c * c) / 5 + c * c));
    MdtBodySetAngularVelocity(body, 0, (MeReal)(amplitude * w), 0);
    MdtBodySetLinearVelocity(body, (MeReal)(amplitude * w * c), 0, 0);
    double first = 0, last = 0, before = 1, begun = 0, end = 0;
    int crossings = 0;
    for (int i = 0; i < SECONDS * rate; i++) {
        MeVector3 spin;
        MstUniverseStep(u, (MeReal)(1. / rate));
        MdtBodyGetAngularVelocity(body, spin);
        const double now = (double)spin[1];
        if (now < 0 && before >= 0) {
            last = (i + before / (before - now)) / rate;
            first = crossings++ ? first : last;
        }
        before = now;
        begun = i < 2 * rate ? fmax(begun, fabs(now)) : begun;
        end = i > (SECONDS - 2) * rate ? fmax(end, fabs(now)) : end;
    }
    return (Rock){2 * 3.14159265358979324 * (crossings - 1) / (last - first) / w, end / begun};
}

TEST(an_ellipsoid_rocks_at_the_frequency_of_the_formula) {
    const double axes[][3] = {{.5, .4, .3}, {.5, .5, .45}, {5, 2, 3}};
    for (int i = 0; i < 3; i++) {
        const Rock r = rock(axes[i][0], axes[i][1], axes[i][2], 240, .01);
        assert_near(r.frequency, 1, 2e-3);
        assert_near(r.kept, 1, 2e-2);
    }
}

/* ---- terrain ----------------------------------------------------------------------------------------------------- */

enum { LIST, FIELD, MESH, BOXES, TERRAINS, CELLS = 16 };

static MeVector3 vertex[(CELLS + 1) * (CELLS + 1)];
static int corner[6 * CELLS * CELLS];
static MeReal height[(CELLS + 1) * (CELLS + 1)];

static double heightAt(int i, int j) {
    const double edge = (i == 0 || i == CELLS || j == 0 || j == CELLS) ? 3 : 0;
    return .3 * sin(1.3 * i) * cos(.9 * j) + edge;
}

static int MEAPI allTriangles(McdModelPair *p, McdUserTriangle *t, MeVector3 at, MeReal radius, int max) {
    int count = 0;
    (void)p;
    for (int i = 0; i < 2 * CELLS * CELLS && count < max; i++) {
        const MeReal *v = vertex[corner[3 * i]];
        if (MeFabs(v[0] - at[0]) > radius + 2 || MeFabs(v[1] - at[1]) > radius + 2)
            continue;
        t[count].normal = 0;
        t[count].flags = kMcdTriangleUseSmallestPenetration | kMcdTriangleUseEdges;
        for (int k = 0; k < 3; k++)
            t[count].vertices[k] = &vertex[corner[3 * i + k]];
        t[count++].triangleData.tag = i;
    }
    return count;
}

/* A hollow of 16 m by 16 m with bumps, x and y from -8 to 8. */
static void addTerrain(int kind) {
    MeVector3 low = {-8, -8, -5}, high = {8, 8, 5};
    int n = 0;
    for (int j = 0; j <= CELLS; j++)
        for (int i = 0; i <= CELLS; i++) {
            const int at = j * (CELLS + 1) + i;
            MeVector3Set(vertex[at], (MeReal)(i - 8), (MeReal)(j - 8), (MeReal)heightAt(i, j));
            height[at] = (MeReal)heightAt(i, j);
        }
    for (int j = 0; j < CELLS; j++)
        for (int i = 0; i < CELLS; i++) {
            const int at = j * (CELLS + 1) + i,
                      quad[6] = {at, at + 1, at + CELLS + 2, at, at + CELLS + 2, at + CELLS + 1};
            memcpy(corner + n, quad, sizeof quad);
            n += 6;
        }
    if (kind == LIST)
        addFixed(McdTriangleListCreate(u->frame, low, high, 2 * CELLS * CELLS, allTriangles), 0, 0, 0);
    else if (kind == FIELD)
        addFixed(McdRGHeightFieldCreate(u->frame, height, CELLS + 1, CELLS + 1, 1, 1, -8, -8), 0, 0, 0);
    else if (kind == MESH)
        addFixed(
            McdMeshCreate(u->frame, (const MeVector3 *)vertex, (CELLS + 1) * (CELLS + 1), corner, 2 * CELLS * CELLS, 0),
            0, 0, 0);
    else
        for (int i = 0; i < 2; i++) {
            addFixed(McdBoxCreate(u->frame, 8, 16, 1), i ? 4 : -4, 0, -.5);
            addFixed(brick_create(u->frame, 1, 16, 6, 0), i ? 8 : -8, 0, 2);
            addFixed(brick_create(u->frame, 16, 1, 6, 0), 0, i ? 8 : -8, 2);
        }
}

static McdModelID putAny(int i, double x, double y, double z) {
    McdModelID m;
    const double a = between(.1, .4), b = between(.1, .4), c = between(.1, .4);
    if (i % 4 == 0)
        m = put(ellipsoid_create(u->frame, a, b, c), x, y, z);
    else if (i % 4 == 1)
        m = putTaper(a, b, fabs(a - b) + c, x, y, z);
    else if (i % 4 == 2)
        m = put(brick_create(u->frame, 2 * a, 2 * b, 2 * c, i % 8 == 2 ? .05 : 0), x, y, z);
    else
        m = put(can_create(u->frame, a, 2 * b, i % 8 == 3), x, y, z);
    const double spin = between(-3, 3), tumble = between(-3, 3);
    McdModelDynamicsSetAngularVelocity(m, (MeReal)spin, (MeReal)tumble, (MeReal)-spin);
    return m;
}

/* On terrain that is fixed, or a kinematic body. */
LOOP_TEST(all_shapes_come_to_rest_on_terrain, 0, 2 * TERRAINS) {
    enum { COUNT = 16 };
    McdModelID m[COUNT];
    int asleep = 0;
    begin(9.81, .6);
    MdtContactParamsSetRollingFriction(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal).02);
    MdtContactParamsSetSpinningFriction(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal).02);
    isGroundKinematic = _i >= TERRAINS;
    addTerrain(_i % TERRAINS);
    for (int i = 0; i < COUNT; i++)
        m[i] = putAny(i, -4.5 + 3 * (i % 4), -4.5 + 3 * (i / 4), 2 + .3 * (i % 3));
    universe_step(900);
    for (int i = 0; i < COUNT; i++) {
        ck_assert_msg(coordinate(m[i], 2) > -.4 && fabs(coordinate(m[i], 0)) < 8 && fabs(coordinate(m[i], 1)) < 8,
                      "body %d is at %g %g %g", i, coordinate(m[i], 0), coordinate(m[i], 1), coordinate(m[i], 2));
        asleep += !MdtBodyIsEnabled(McdModelGetBody(m[i]));
    }
    ck_assert_int_ge(asleep, COUNT - 3);
}

/* ---- seams ------------------------------------------------------------------------------------------------------- */

/* A tile of 2 by 4 by 1 m by its corners, in a frame that is turned about x, so that no face is across an axis. */
static void addTurnedTile(double x) {
    const double cosine = .8, sine = .6;
    Gem gem = {.count = 8};
    for (int i = 0; i < 8; i++) {
        const double y = i & 1 ? 2 : -2, z = i & 2 ? .5 : -.5;
        gem.corner[i][0] = i & 4 ? 1 : -1;
        gem.corner[i][1] = cosine * y + sine * z;
        gem.corner[i][2] = cosine * z - sine * y;
    }
    MeMatrix4Ptr tm = ground[grounds++];
    MeMatrix4TMMakeIdentity(tm);
    MeVector3Set(tm[1], 0, (MeReal)cosine, (MeReal)sine);
    MeVector3Set(tm[2], 0, (MeReal)-sine, (MeReal)cosine);
    MeVector3Set(tm[3], (MeReal)x, 0, (MeReal)-.5);
    MstFixedModelCreate(u, gem_create(u->frame, &gem), tm);
}

/* Tiles of a program's shapes beside boxes: what slides or rolls over them neither stops nor hops. */
TEST(seams_between_bricks_and_boxes_are_not_felt) {
    for (int kind = 0; kind < 4; kind++) {
        begin(9.81, 0);
        for (int i = 0; i < 8; i++)
            if (i % 3 == 2)
                addTurnedTile(-2 + 2 * i);
            else
                addFixed(i % 3 ? brick_create(u->frame, 2, 4, 1, 0) : McdBoxCreate(u->frame, 2, 4, 1), -2 + 2 * i, 0,
                         -.5);
        McdModelID m = kind == 0   ? put(brick_create(u->frame, .4, .4, .2, 0), 0, 0, .1)
                       : kind == 1 ? put(McdBoxCreate(u->frame, (MeReal).4, (MeReal).4, (MeReal).2), 0, 0, .1)
                       : kind == 2 ? put(ellipsoid_create(u->frame, .2, .2, .2), 0, 0, .2)
                                   : put(McdSphereCreate(u->frame, (MeReal).2), 0, 0, .2);
        McdModelDynamicsSetLinearVelocity(m, 5, 0, 0);
        const double z = coordinate(m, 2);
        double max = z, min = z;
        for (int i = 0; i < 120; i++) {
            universe_step(1);
            max = fmax(max, coordinate(m, 2));
            min = fmin(min, coordinate(m, 2));
        }
        /* Contacts with the turned tile are searched, to 1e-9 of its size. */
        assert_near(coordinate(m, 0), 10, TOL(1e-4, 2e-8));
        assert_near(max, z, TOL(1e-6, 2e-8));
        assert_near(min, z, TOL(1e-6, 2e-8));
    }
}

/* ---- sweeps ------------------------------------------------------------------------------------------------------ */

/* Thin walls at x = 5: a list, a mesh, a box, a brick, a plane, an ellipsoid. */
static void addWall(int kind) {
    static const int index[6] = {0, 1, 2, 0, 2, 3};
    static MeVector3 v[4] = {{5, -9, -9}, {5, -9, 9}, {5, 9, 9}, {5, 9, -9}};
    static MeMatrix4 facing = {{0, 1, 0, 0}, {0, 0, 1, 0}, {-1, 0, 0, 0}, {5, 0, 0, 1}};
    MeMatrix4TMMakeIdentity(facing);
    MeVector3Set(facing[0], 0, 1, 0);
    MeVector3Set(facing[1], 0, 0, -1);
    MeVector3Set(facing[2], -1, 0, 0);
    facing[3][0] = 5;
    if (kind == 0)
        MstFixedModelCreate(u, McdPlaneCreate(u->frame), facing);
    else if (kind == 1)
        addFixed(McdMeshCreateWithFlags(u->frame, (const MeVector3 *)v, 4, index, 2, 0, kMcdMeshTwoSided), 0, 0, 0);
    else if (kind == 2)
        addFixed(McdBoxCreate(u->frame, (MeReal).01, 18, 18), 5.005, 0, 0);
    else if (kind == 3)
        addFixed(brick_create(u->frame, .01, 18, 18, 0), 5.005, 0, 0);
    else
        addFixed(ellipsoid_create(u->frame, .02, 40, 40), 5.02, 0, 0);
}

LOOP_TEST(fast_shapes_stop_at_walls, 0, 5) {
    for (int i = 0; i < 24; i++) {
        begin(0, .3);
        seed = (MeU32)(7 + i);
        addWall(_i);
        const double x = between(-3, 0), y = between(-1, 1), z = between(-1, 1);
        McdModelID m = putAny(i, x, y, z);
        const double speed = pow(10, between(0, 3));
        McdModelSetSwept(m, METRUE);
        McdModelDynamicsSetLinearVelocity(m, (MeReal)speed, (MeReal)between(-.1 * speed, .1 * speed), 0);
        for (int k = 0; k < 300 && k * speed / 60 < 12; k++) {
            universe_step(1);
            ck_assert_msg(coordinate(m, 0) < 5.1, "shape %d at %g m/s is at %g", i, speed, coordinate(m, 0));
        }
    }
}

/* ---- determinism ------------------------------------------------------------------------------------------------- */

static void makeHeap(McdModelID *m, int count) {
    begin(9.81, .5);
    addTerrain(BOXES);
    for (int i = 0; i < count; i++)
        m[i] = putAny(i, -3 + 1.5 * (i % 5), -3 + 1.5 * (i / 5 % 5), .5 + 1. * (i / 25));
}

static void runHeap(int workers, MeReal poses[][12]) {
    enum { COUNT = 50 };
    McdModelID m[COUNT];
    MeTaskPoolID pool = workers ? MeTaskPoolCreate(workers) : 0;
    makeHeap(m, COUNT);
    if (pool)
        MdtWorldSetTaskPool(u->world, pool);
    universe_step(100);
    for (int i = 0; i < COUNT; i++) {
        const MeMatrix4Ptr tm = McdModelGetTransformPtr(m[i]);
        for (int k = 0; k < 12; k++)
            poses[i][k] = tm[k / 3][k % 3];
    }
    if (pool) {
        MdtWorldSetTaskPool(u->world, 0);
        MeTaskPoolDestroy(pool);
    }
}

TEST(a_heap_is_the_same_on_any_number_of_threads) {
    static MeReal one[50][12], other[50][12];
    runHeap(0, one);
    for (int workers = 1; workers <= 3; workers += 2) {
        runHeap(workers, other);
        ck_assert_int_eq(memcmp(one, other, sizeof one), 0);
    }
}

/* ---- pits, drops ------------------------------------------------------------------------------------------------- */

#ifdef TEST_IS_SLOW
enum { PITS = 1, DROPS = 3 };
#else
enum { PITS = 3, DROPS = 12 };
#endif

/* Bricks poured into a pit come to rest, none deep in another: the lowest lies on its side. */
LOOP_TEST(a_pit_of_bricks_falls_asleep, 0, PITS) {
    enum { BRICKS = 80 };
    const double size = _i == 0 ? .1 : _i == 1 ? .01 : 1, wall = 20 * size, pit = 3 * size;
    McdModelID m[BRICKS];
    double lowest = INFINITY;
    begin(9.8, .5);
    McdGeometryID brick = brick_create(u->frame, size / 2, size / 2, size, 0);
    addFixed(McdBoxCreate(u->frame, (MeReal)wall, (MeReal)wall, (MeReal)wall), 0, 0, -wall / 2);
    for (int i = 0; i < 4; i++) {
        const double side = (i % 2 ? -1 : 1) * (pit + wall / 2);
        addFixed(McdBoxCreate(u->frame, (MeReal)wall, (MeReal)wall, (MeReal)(2 * wall)), i < 2 ? side : 0,
                 i < 2 ? 0 : side, 0);
    }
    for (int i = 0; i < BRICKS; i++) {
        const double turn[4] = {between(.01, 1), between(0, 1), between(0, 1), between(0, 1)};
        m[i] = put(brick, (i % 4 - 1.5) * 1.3 * size, (i / 4 % 4 - 1.5) * 1.3 * size, (1 + i / 16 * 1.3) * size);
        McdModelDynamicsSetQuaternion(m[i], (MeReal)turn[0], (MeReal)turn[1], (MeReal)turn[2], (MeReal)turn[3]);
    }
    universe_step(600);
    for (int i = 0; i < BRICKS; i++) {
        ck_assert_msg(!MdtBodyIsEnabled(McdModelGetBody(m[i])), "brick %d is awake", i);
        lowest = fmin(lowest, coordinate(m[i], 2));
    }
    assert_near(lowest, .25 * size, .002 * size);
}

/* m: the largest overlap with the plane z = 0 of what falls onto it. */
static double deepestDrop(McdGeometryID g, const McdConvexFunctions *functions, const void *data) {
    const MeReal spin[3] = {(MeReal)between(-5, 5), (MeReal)between(-5, 5), (MeReal)between(-5, 5)};
    const double turn[4] = {between(.1, 1), between(-1, 1), between(-1, 1), between(-1, 1)};
    const McdModelID m = put(g, 0, 0, between(.2, .4));
    MeMatrix4Ptr tm = McdModelGetTransformPtr(m);
    double deepest = 0;
    McdModelDynamicsSetQuaternion(m, (MeReal)turn[0], (MeReal)turn[1], (MeReal)turn[2], (MeReal)turn[3]);
    McdModelDynamicsSetAngularVelocity(m, spin[0], spin[1], spin[2]);
    for (int i = 0; i < 120; i++) {
        double p[3], low = (double)tm[3][2];
        universe_step(1);
        const double down[3] = {-(double)tm[0][2], -(double)tm[1][2], -(double)tm[2][2]};
        functions->support(data, down, p);
        low = (double)tm[3][2] - (p[0] * down[0] + p[1] * down[1] + p[2] * down[2]);
        deepest = fmax(deepest, -low);
    }
    MstModelAndBodyDestroy(m);
    return deepest;
}

static McdGeometryID makeDropped(int kind, MeBool isOwn, double size) {
    const MeReal radius = (MeReal)(.3 * size), length = (MeReal)size;
    if (kind == 2)
        return isOwn ? brick_create(u->frame, size, .8 * size, .6 * size, 0)
                     : McdBoxCreate(u->frame, length, (MeReal)(.8 * size), (MeReal)(.6 * size));
    if (isOwn)
        return can_create(u->frame, (double)radius, size, kind == 0);
    return kind == 0 ? McdSphylCreate(u->frame, radius, length) : McdCylinderCreate(u->frame, radius, length);
}

/* A capsule whose ends are round by its support function, a cylinder, a box: no deeper than the library's own, with
 * both solvers. */
LOOP_TEST(what_is_dropped_goes_no_deeper_than_its_twin, 0, 6) {
    const double size = .1;
    const Can can = {.3 * size, .5 * size, _i / 2 == 0};
    const Brick brick = {{.5 * size, .4 * size, .3 * size}, 0};
    const MeBool isBox = _i / 2 == 2;
    for (int own = 0; own < 2; own++) {
        double deepest = 0;
        begin(9.8, .5);
        MdtWorldSetSolver(u->world, _i % 2 ? MdtSolverFast : MdtSolverExact);
        addFixed(McdPlaneCreate(u->frame), 0, 0, 0);
        McdGeometryID g = makeDropped(_i / 2, own, size);
        for (int i = 0; i < DROPS; i++)
            deepest =
                fmax(deepest, isBox ? deepestDrop(g, &brickFunctions, &brick) : deepestDrop(g, &canFunctions, &can));
        assert_near(deepest, 0, .02 * size);
    }
}

/* ---- nearly flat, rounded, inconsistent -------------------------------------------------------------------------- */

static atomic_long supportCalls;

/* |x/a|^p + |y/b|^p + |z/c|^p = 1: nearly flat, nowhere quite. */
typedef struct Super {
    double half[3], power;
} Super;

static void MEAPI superSupport(const void *data, const double d[3], double point[3]) {
    const Super *s = data;
    const double dual = s->power / (s->power - 1);
    double sum = 0;
    atomic_fetch_add(&supportCalls, 1);
    for (int i = 0; i < 3; i++)
        sum += pow(fabs(s->half[i] * d[i]), dual);
    for (int i = 0; i < 3; i++)
        point[i] = copysign(s->half[i] * pow(fabs(s->half[i] * d[i]) / pow(sum, 1 / dual), 1 / (s->power - 1)), d[i]);
}

/* A box whose corners have a relative noise of 1e-7, and one with edges rounded by .02 m, in single precision. */
static void MEAPI noisySupport(const void *data, const double d[3], double point[3]) {
    const double *half = data, hash = sin(d[0] * 12.9898 + d[1] * 78.233 + d[2] * 37.719) * 43758.5453;
    atomic_fetch_add(&supportCalls, 1);
    for (int i = 0; i < 3; i++)
        point[i] = copysign(half[i], d[i]) * (1 + 1e-7 * (hash - floor(hash)));
}

static void MEAPI floatSupport(const void *data, const double d[3], double point[3]) {
    const double *half = data;
    atomic_fetch_add(&supportCalls, 1);
    for (int i = 0; i < 3; i++) {
        const float along = (float)d[i];
        point[i] = (double)(copysignf((float)half[i] - .02f, along) + .02f * along);
    }
}

/* Any points. */
static void MEAPI randomSupport(const void *data, const double d[3], double point[3]) {
    const double *half = data, hash = sin(d[0] * 12.9898 + d[1] * 78.233 + d[2] * 37.719) * 43758.5453;
    for (int i = 0; i < 3; i++)
        point[i] = half[i] * (2 * fmod((hash - floor(hash)) * (i == 0 ? 1 : i == 1 ? 7919 : 104729), 1) - 1);
}

static McdGeometryID makeShape(McdConvexSupportFn support, size_t size, const void *data) {
    const McdConvexFunctions functions = {.support = support};
    return McdConvexCreate(u->frame, McdFrameworkRegisterConvexType(u->frame, "Shape", size, &functions), data);
}

/* Steps until all bodies are asleep; returns the support calls a step. */
static long stepToSleep(int maxSteps) {
    int steps = 0;
    atomic_store(&supportCalls, 0);
    while (MdtWorldGetEnabledBodies(u->world) > 0 && steps < maxSteps) {
        universe_step(1);
        steps++;
    }
    ck_assert_int_eq(MdtWorldGetEnabledBodies(u->world), 0);
    return atomic_load(&supportCalls) / steps;
}

static void putSuperTower(const Super *s, double lean) {
    begin(9.8, .6);
    MdtContactParamsID params = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetRollingFriction(params, (MeReal).01);
    MdtContactParamsSetSpinningFriction(params, (MeReal).01);
    addFixed(McdPlaneCreate(u->frame), 0, 0, 0);
    McdGeometryID g = makeShape(superSupport, sizeof *s, s);
    for (int i = 0; i < 4; i++)
        put(g, lean * i, .03 * (i % 3), .32 + .62 * i);
}

/* The mean of leans, as in double precision one of them takes thrice as many calls as another. */
LOOP_TEST(towers_of_superellipsoids_fall_asleep, 0, 2) {
    enum { LEANS = 5 };
    const Super s = {{.5, .4, .3}, _i ? 20 : 8};
    long calls = 0;
    for (int i = 0; i < LEANS; i++) {
        putSuperTower(&s, .012 + .004 * i);
        calls += stepToSleep(60);
    }
    ck_assert_int_le(calls / LEANS, 1500);
}

LOOP_TEST(heaps_of_boxes_in_single_precision_fall_asleep, 0, 2) {
    static const double half[3] = {.5, .4, .3};
    begin(9.8, .6);
    addFixed(McdPlaneCreate(u->frame), 0, 0, 0);
    McdGeometryID g = makeShape(_i ? floatSupport : noisySupport, sizeof half, half);
    for (int i = 0; i < 24; i++) {
        const double turn = .7 * i;
        McdModelID m = put(g, i % 3 * .8 - .8, i / 3 % 3 * .8 - .8, .9 + .9 * (i / 9));
        McdModelDynamicsSetQuaternion(m, (MeReal)cos(turn), (MeReal)(.6 * sin(turn)), (MeReal)(.8 * sin(turn)), 0);
    }
    ck_assert_int_le(stepToSleep(600), _i ? 22000 : 2000);
}

TEST(points_of_no_shape_are_warned_of_and_have_no_mass) {
    static const double half[3] = {.5, .5, .5};
    MeMatrix4 at;
    MeMatrix3 inertia;
    MeReal volume;
    begin(9.8, .6);
    McdGeometryID g = makeShape(randomSupport, sizeof half, half);
    assert_warned("not the farthest of one shape");
    McdGeometryGetMassProperties(g, at, inertia, &volume);
    assert_warned("not those of a solid");
    ck_assert(volume == 0);
}

/* ---- change ------------------------------------------------------------------------------------------------------ */

TEST(what_lies_on_a_shape_that_shrinks_wakes_and_falls) {
    begin(9.81, .5);
    McdGeometryID table = brick_create(u->frame, 4, 4, 2, 0);
    addFixed(table, 0, 0, -1);
    McdModelID m = put(brick_create(u->frame, 1, 1, 1, 0), 0, 0, .5);
    universe_step(300);
    ck_assert(!MdtBodyIsEnabled(McdModelGetBody(m)));
    McdConvexSetData(table, &(Brick){{2, 2, .5}, 0});
    universe_step(300);
    assert_near(coordinate(m, 2), 0, TOL(1e-6, 1e-6));
}
