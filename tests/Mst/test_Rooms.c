/* Continuous motion within levels: a swept body meets the walls of the model, list or field whose floor it touches. */
#include "McdMesh.h"
#include "universe.h"

static MeU32 seed;
static MeReal h;
static double thickness; /* m, of a room's walls that are boxes */

static double fraction(void) {
    seed = seed * 1664525u + 1013904223u;
    return seed / 4294967296.;
}

static double between(double low, double high) {
    return low + (high - low) * fraction();
}

/* ---- surfaces of rectangles, each of n x n cells ----------------------------------------------------------------- */

enum {
    MAX_CELLS = 8,
    MAX_VERTICES = 6 * (MAX_CELLS + 1) * (MAX_CELLS + 1),
    MAX_TRIANGLES = 12 * MAX_CELLS * MAX_CELLS
};

typedef struct Surface {
    MeVector3 vertex[MAX_VERTICES], normal[6];
    int corner[MAX_TRIANGLES][3], side[MAX_TRIANGLES];
    int vertices, triangles, sides;
} Surface;

static Surface surface[2];

/* Its corners run against the clock as seen from where it faces. */
static void addTriangle(Surface *s, int facing, int a, int b, int c) {
    int *corner = s->corner[s->triangles];
    corner[0] = a, corner[1] = facing > 0 ? b : c, corner[2] = facing > 0 ? c : b;
    s->side[s->triangles++] = s->sides - 1;
}

/* A rectangle from low to high, which are equal along `axis`. */
static void addSide(Surface *s, int axis, const double low[3], const double high[3], int facing, int n) {
    const int right = (axis + 1) % 3, up = (axis + 2) % 3, first = s->vertices;
    MeVector3Set(s->normal[s->sides], 0, 0, 0);
    s->normal[s->sides++][axis] = (MeReal)facing;
    for (int j = 0; j <= n; j++)
        for (int i = 0; i <= n; i++) {
            MeReal *v = s->vertex[s->vertices++];
            v[axis] = (MeReal)low[axis];
            v[right] = (MeReal)(low[right] + (high[right] - low[right]) * i / n);
            v[up] = (MeReal)(low[up] + (high[up] - low[up]) * j / n);
        }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const int at = first + j * (n + 1) + i;
            addTriangle(s, facing, at, at + 1, at + n + 2);
            addTriangle(s, facing, at, at + n + 2, at + n + 1);
        }
}

static MeBool isNear(const Surface *s, const int corner[3], const MeReal *at, MeReal radius) {
    for (int i = 0; i < 3; i++) {
        const MeReal a = s->vertex[corner[0]][i], b = s->vertex[corner[1]][i], c = s->vertex[corner[2]][i];
        if (MeMIN(a, MeMIN(b, c)) > at[i] + radius || MeMAX(a, MeMAX(b, c)) < at[i] - radius)
            return MEFALSE;
    }
    return METRUE;
}

static int MEAPI trianglesNear(McdModelPair *p, McdUserTriangle *t, MeVector3 at, MeReal radius, int max) {
    Surface *s = McdTriangleListGetUserData(McdModelGetGeometry(p->model2));
    int count = 0;
    for (int i = 0; i < s->triangles && count < max; i++) {
        if (!isNear(s, s->corner[i], at, radius))
            continue;
        for (int k = 0; k < 3; k++)
            t[count].vertices[k] = &s->vertex[s->corner[i][k]];
        t[count].normal = &s->normal[s->side[i]];
        t[count].flags = kMcdTriangleUseSmallestPenetration | kMcdTriangleUseEdges;
        t[count++].triangleData.tag = i;
    }
    return count;
}

static MeMatrix4 place[64]; /* of the fixed models and parts of a universe */
static int places;

static MeMatrix4Ptr placeAt(double x, double y, double z) {
    MeMatrix4Ptr tm = place[places++];
    MeMatrix4TMMakeIdentity(tm);
    MeVector3Set(tm[3], (MeReal)x, (MeReal)y, (MeReal)z);
    return tm;
}

static void addFixed(McdGeometryID g, double x, double y, double z) {
    MstFixedModelCreate(u, g, placeAt(x, y, z));
}

static void addSurface(Surface *s) {
    MeVector3 low = {-50, -50, -50}, high = {50, 50, 50};
    McdGeometryID g = McdTriangleListCreate(u->frame, low, high, s->triangles + 1, trianglesNear);
    McdTriangleListSetUserData(g, s);
    addFixed(g, 0, 0, 0);
}

static void addMesh(const Surface *s) {
    addFixed(McdMeshCreate(u->frame, s->vertex, s->vertices, s->corner[0], s->triangles, 0), 0, 0, 0);
}

/* ---- levels ------------------------------------------------------------------------------------------------------ */

/* A floor z = 0 and a wall x = 5. */
enum { ONE_LIST, TWO_LISTS, ONE_MESH, ONE_AGGREGATE, TWO_BOXES, ONE_FIELD, LEVELS };

static void addTriangles(int level) {
    const double floor[2][3] = {{-20, -5, 0}, {5, 5, 0}}, wall[2][3] = {{5, -5, 0}, {5, 5, 3}};
    const MeBool areTwo = level == TWO_LISTS;
    memset(surface, 0, sizeof surface);
    addSide(&surface[0], 2, floor[0], floor[1], 1, 1);
    addSide(&surface[areTwo], 0, wall[0], wall[1], -1, 1);
    if (level == ONE_MESH)
        addMesh(&surface[0]);
    for (int i = 0; i <= areTwo && level != ONE_MESH; i++)
        addSurface(&surface[i]);
}

static void addLevel(int level) {
    static MeReal height[81 * 21];
    const McdGeometryID floor = McdBoxCreate(u->frame, 40, 10, 1), wall = McdBoxCreate(u->frame, .02, 10, 3);
    for (int i = 0; i < 81 * 21; i++)
        height[i] = i % 81 > 50; /* the wall is a slope of 1 m over .5 m */
    if (level <= ONE_MESH) {
        addTriangles(level);
    } else if (level == ONE_FIELD) {
        addFixed(McdRGHeightFieldCreate(u->frame, height, 81, 21, .5, .5, -20, -5), 0, 0, 0);
    } else if (level == TWO_BOXES) {
        addFixed(floor, 0, 0, -.5);
        addFixed(wall, 5.01, 0, 1.5);
    } else {
        McdAggregateID both = McdAggregateCreate(u->frame, 2);
        McdAggregateAddElement(both, floor, placeAt(0, 0, -.5));
        McdAggregateAddElement(both, wall, placeAt(5.01, 0, 1.5));
        addFixed(both, 0, 0, 0);
    }
}

static void begin(double gravity, double friction, double restitution) {
    universe_begin(0);
    places = 0;
    MdtWorldSetGravity(u->world, 0, 0, (MeReal)-gravity);
    MdtWorldSetAutoDisable(u->world, 0);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal)friction, (MeReal)restitution);
    h = 1. / 60;
    thickness = .01;
}

static double coordinate(McdModelID m, int axis) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    return (double)p[axis];
}

static McdModelID addBody(McdGeometryID g, double x, double y, double z) {
    McdModelID m = MstModelAndBodyCreate(u, g, 1000);
    McdModelSetSwept(m, METRUE);
    McdModelDynamicsSetPosition(m, (MeReal)x, (MeReal)y, (MeReal)z);
    return m;
}

/* A ball of 10 cm at some speed against the wall, on the floor or above it. */
static void meetWall(int level, MeBool isRolling, double speed, double start) {
    begin(9.8, .5, 0);
    addLevel(level);
    McdModelID ball = addBody(McdSphereCreate(u->frame, .1), start, .3, isRolling ? .1 : .5);
    McdModelDynamicsSetLinearVelocity(ball, (MeReal)speed, 0, 0);
    McdModelDynamicsSetAngularVelocity(ball, 0, (MeReal)(isRolling ? speed / .1 : 0), 0);
    for (int i = 0; i < 30; i++) {
        MstUniverseStep(u, h);
        const double x = coordinate(ball, 0), ground = level == ONE_FIELD ? MeCLAMP(2 * (x - 5), 0, 1) : 0;
        ck_assert_msg((level == ONE_FIELD || x < 5) && coordinate(ball, 2) > ground, "level %d, %g m/s, from %g: at %g",
                      level, speed, start, x);
    }
}

TEST(a_ball_meets_the_wall_of_its_floor) {
    for (int level = 0; level < LEVELS; level++)
        for (double speed = 5; speed <= 1000; speed *= 3)
            for (int i = 0; i < 6; i++)
                meetWall(level, i % 2, speed, -2 + .137 * i);
}

/* ---- rooms ------------------------------------------------------------------------------------------------------- */

static const double room[3] = {4, 3, 2};
enum { WALLS, TILES, MESH, BOXES, COMPOUND, FIELD, ROOMS };
enum { BALL, BOX, SPHYL, HULL, CYLINDER, CONE, DUMBBELL, SHAPES };

static void addRoom(int kind) {
    static MeReal flat[7 * 6];
    const McdAggregateID all = McdAggregateCreate(u->frame, 6);
    memset(surface, 0, sizeof surface);
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            double low[3] = {0, 0, 0}, high[3], size[3], centre[3];
            memcpy(high, room, sizeof high);
            low[axis] = high[axis] = side * room[axis];
            addSide(&surface[0], axis, low, high, side ? -1 : 1, kind == TILES || kind == MESH ? MAX_CELLS : 1);
            for (int i = 0; i < 3; i++) {
                size[i] = i == axis ? thickness : room[i] + 2 * thickness;
                centre[i] = i == axis ? side * (room[i] + thickness) - thickness / 2 : room[i] / 2;
            }
            const McdGeometryID box = McdBoxCreate(u->frame, (MeReal)size[0], (MeReal)size[1], (MeReal)size[2]);
            McdAggregateAddElement(all, box, placeAt(centre[0], centre[1], centre[2]));
            if (kind == BOXES || (kind == FIELD && (axis < 2 || side > 0)))
                addFixed(box, centre[0], centre[1], centre[2]);
        }
    if (kind == FIELD)
        addFixed(McdRGHeightFieldCreate(u->frame, flat, 7, 6, 1, 1, -1, -1), 0, 0, 0);
    else if (kind == COMPOUND)
        addFixed(all, 0, 0, 0);
    else if (kind == MESH)
        addMesh(&surface[0]);
    else if (kind != BOXES)
        addSurface(&surface[0]);
}

/* Of opposite vertices, so that its origin is within. */
static McdGeometryID makeHull(double size) {
    MeVector3 vertex[12];
    for (int i = 0; i < 6; i++) {
        const double x[3] = {between(-1, 1), between(-1, 1), between(-1, 1)};
        const double length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
        for (int k = 0; k < 3; k++)
            vertex[i + 6][k] = -(vertex[i][k] = (MeReal)(x[k] / length * size / 2));
    }
    return McdConvexMeshCreateHull(u->frame, (const MeVector3 *)vertex, 12, 0);
}

static McdGeometryID makeDumbbell(MeReal s) {
    McdAggregateID a = McdAggregateCreate(u->frame, 3);
    const McdGeometryID end = McdSphereCreate(u->frame, (MeReal).2 * s);
    McdAggregateAddElement(a, end, placeAt(-.3 * (double)s, 0, 0));
    McdAggregateAddElement(a, end, placeAt(.3 * (double)s, 0, 0));
    McdAggregateAddElement(a, McdBoxCreate(u->frame, (MeReal).6 * s, (MeReal).1 * s, (MeReal).1 * s), placeAt(0, 0, 0));
    return a;
}

static McdGeometryID makeShape(int shape, double size) {
    const MeReal s = (MeReal)size;
    switch (shape) {
    case BALL:
        return McdSphereCreate(u->frame, s / 2);
    case BOX:
        return McdBoxCreate(u->frame, s, (MeReal).6 * s, (MeReal).4 * s);
    case SPHYL:
        return McdSphylCreate(u->frame, (MeReal).2 * s, (MeReal).6 * s);
    case HULL:
        return makeHull(size);
    case CYLINDER:
        return McdCylinderCreate(u->frame, (MeReal).3 * s, (MeReal).7 * s);
    case CONE:
        return McdConeCreate(u->frame, (MeReal).8 * s, (MeReal).4 * s);
    default:
        return makeDumbbell(s);
    }
}

static double logBetween(double low, double high) {
    return exp(between(log(low), log(high)));
}

static void throwAnyWay(McdModelID m, double speed, double size) {
    double d[3], length = 0;
    for (int i = 0; i < 3; i++) {
        d[i] = between(-1, 1);
        length += d[i] * d[i];
    }
    const double k = speed / sqrt(length), spin = between(0, 1) * speed / size;
    McdModelDynamicsSetLinearVelocity(m, (MeReal)(k * d[0]), (MeReal)(k * d[1]), (MeReal)(k * d[2]));
    McdModelDynamicsSetAngularVelocity(m, (MeReal)(spin * between(-1, 1)), (MeReal)(spin * between(-1, 1)),
                                       (MeReal)(spin * between(-1, 1)));
    McdModelDynamicsSetQuaternion(m, (MeReal)between(-1, 1), (MeReal)between(-1, 1), (MeReal)between(-1, 1), 1);
}

static MeBool isInRoom(McdModelID m) {
    for (int i = 0; i < 3; i++)
        if (!(coordinate(m, i) >= 0 && coordinate(m, i) <= room[i]))
            return MEFALSE;
    return METRUE;
}

/* Any size, speed, spin, step, friction, restitution, gravity and solver. */
static void throwInRoom(int kind, int shape, int number) {
    static const double steps[3] = {1. / 30, 1. / 60, 1. / 240};
    seed = (MeU32)(number * 7919 + shape * 104729 + 1);
    const double size = logBetween(.01, 1), speed = logBetween(1, 1000);
    begin(number % 2 ? 9.8 : 0, number % 3 * .5, number / 3 % 3 * .5);
    MdtWorldSetSolver(u->world, number / 2 % 2 ? MdtSolverFast : MdtSolverAuto);
    h = (MeReal)steps[number / 4 % 3];
    addRoom(kind);
    McdModelID m = addBody(makeShape(shape, size), between(1.2, 2.8), between(.9, 2.1), between(.8, 1.2));
    throwAnyWay(m, speed, size);
    for (int i = 0; i < 40; i++) {
        MstUniverseStep(u, h);
        ck_assert_msg(isInRoom(m), "room %d, shape %d, throw %d: %g m at %g m/s, step %d", kind, shape, number, size,
                      speed, i);
    }
}

#ifdef TEST_IS_SLOW
enum { THROWS = 4 };
#else
enum { THROWS = 12 };
#endif

TEST(nothing_leaves_a_room) {
    for (int kind = 0; kind < ROOMS; kind++)
        for (int shape = 0; shape < SHAPES; shape++)
            for (int i = 0; i < THROWS; i++)
                throwInRoom(kind, shape, i);
    messages_forget(); /* a body of 1 cm at 1e5 rad/s may exceed the solver's iterations */
}

static int oneOf(int count) {
    return (int)(fraction() * count);
}

/* Several bodies that meet each other, too: balls, cubes and others, in walls of 1 cm to 1 m. Returns how many of them
 * have left the room. */
static int throwMany(int kind, int number, int *count) {
    static const double steps[3] = {1. / 30, 1. / 60, 1. / 240};
    static const MdtSolver solvers[3] = {MdtSolverAuto, MdtSolverExact, MdtSolverFast};
    McdModelID m[20];
    int lost = 0;
    seed = (MeU32)(number * 7919 + kind * 104729 + 7);
    const double size = logBetween(.05, .3), speed = logBetween(10, 1000);
    begin(oneOf(2) * 9.8, oneOf(3) * .3, oneOf(4) / 3.);
    MdtWorldSetSolver(u->world, solvers[oneOf(3)]);
    h = (MeReal)steps[oneOf(3)];
    thickness = oneOf(2) ? 1 : .01;
    addRoom(kind);
    const int n = 1 + oneOf(20), shape = oneOf(3);
    const MeBool isSpinning = oneOf(4) > 0;
    for (int i = 0; i < n; i++) {
        const double edge = .577 * size; /* of a cube */
        m[i] = addBody(shape == 0   ? makeShape(BALL, size)
                       : shape == 1 ? McdBoxCreate(u->frame, (MeReal)edge, (MeReal)edge, (MeReal)edge)
                                    : makeShape(i % SHAPES, size),
                       .4 + .8 * (i % 5), .75 + 1.5 * (i / 5 % 2), .5 + i / 10);
        throwAnyWay(m[i], speed, isSpinning ? size : 1e9);
    }
    for (int i = 0; i < 40; i++) {
        MstUniverseStep(u, h);
        for (int k = 0; k < n; k++) {
            const MeReal lag = MdtBodyGetLag(McdModelGetBody(m[k]));
            ck_assert_msg(lag == 0 || lag * 16384 > h, "room %d, throw %d: rounding has left %g s", kind, number,
                          (double)lag);
        }
    }
    for (int i = 0; i < n; i++)
        lost += !isInRoom(m[i]);
    *count += n;
    return lost;
}

#ifndef CROWDS /* 1000: 60 000 bodies */
#ifdef TEST_IS_SLOW
#define CROWDS 3
#else
#define CROWDS 12
#endif
#endif

TEST(bodies_that_meet_leave_no_room) {
    int lost = 0, count = 0;
    for (int kind = 0; kind < ROOMS; kind++)
        for (int i = 0; i < CROWDS; i++)
            lost += throwMany(kind, i, &count);
    ck_assert_msg(lost == 0, "%d lost of %d", lost, count);
    messages_forget();
}

/* A ball falls on the floor. At the start of a step another one passes it from above so close to a tangent that they do
 * not get deep, and makes it faster: the time of its impact that was found before is too late. */
static void passAndPush(int number) {
    const double r = logBetween(.02, .2), speed = logBetween(50, 500), side = between(.1, .3);
    begin(0, 0, oneOf(3) / 2.);
    MdtWorldSetSolver(u->world, oneOf(2) ? MdtSolverExact : MdtSolverFast);
    addRoom(oneOf(ROOMS));
    const double z = fmin(r + between(.2, .9) * speed / 60, 1.4);
    McdModelID low = addBody(McdSphereCreate(u->frame, (MeReal)r), 2, 1.5, z);
    McdModelID high = addBody(McdSphereCreate(u->frame, (MeReal)r), 2, 1.5, z + 1.999 * r);
    McdModelDynamicsSetLinearVelocity(low, 0, 0, (MeReal)-speed);
    McdModelDynamicsSetLinearVelocity(high, (MeReal)(speed * 2), 0, (MeReal)(-speed * (1 + side)));
    for (int i = 0; i < 5; i++) {
        MstUniverseStep(u, h);
        ck_assert_msg(isInRoom(low) && isInRoom(high), "number %d, step %d", number, i);
    }
}

TEST(a_push_in_passing_is_met_in_time) {
    seed = 5;
    for (int i = 0; i < 200; i++)
        passAndPush(i);
}

/* To and fro along each axis: no time is lost in a thousand bounces, and no energy. */
TEST(a_ball_keeps_time_in_a_room) {
    const double radius = .05, start[3] = {1.1, 1.3, .9}, v[3] = {61, -47, 37};
    MeVector3 now;
    begin(0, 0, 1);
    addRoom(TILES);
    McdModelID ball = addBody(McdSphereCreate(u->frame, (MeReal)radius), start[0], start[1], start[2]);
    McdModelDynamicsSetLinearVelocity(ball, (MeReal)v[0], (MeReal)v[1], (MeReal)v[2]);
    for (int i = 1; i <= 1200; i++) {
        MstUniverseStep(u, h);
        for (int axis = 0; axis < 3; axis++) {
            const double way = room[axis] - 2 * radius;
            double path = fmod(start[axis] - radius + v[axis] * i / 60, 2 * way);
            path = path < 0 ? path + 2 * way : path;
            assert_near(coordinate(ball, axis), radius + (path < way ? path : 2 * way - path), TOL(2e-4, 1e-8));
        }
    }
    McdModelDynamicsGetLinearVelocity(ball, now);
    for (int axis = 0; axis < 3; axis++)
        assert_near_rel(fabs((double)now[axis]), fabs(v[axis]), TOL(1e-5, 1e-12));
}
