/* Bodies come to rest on bumps, which they touch with few of many points. */
#include "universe.h"

#include "McdTriangleList.h"

#include <math.h>
#include <string.h>

enum { SAMPLES = 41, CELLS = SAMPLES - 1 };

static const double cell = .5;
static MeReal heights[SAMPLES * SAMPLES];
static MeVector3 vertex[SAMPLES * SAMPLES];
static MeMatrix4 place = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

static void makeHeights(double bumps, int seed) {
    for (int i = 0; i < SAMPLES * SAMPLES; i++) {
        heights[i] = bumps * sin(1.3 * i + seed);
        MeVector3Set(vertex[i], cell * (i % SAMPLES - CELLS / 2), cell * (i / SAMPLES - CELLS / 2), heights[i]);
    }
}

static void addTriangle(McdUserTriangle *t, int a, int b, int c) {
    t->vertices[0] = &vertex[a];
    t->vertices[1] = &vertex[b];
    t->vertices[2] = &vertex[c];
    t->normal = 0;
    t->flags = kMcdTriangleUseSmallestPenetration | kMcdTriangleUseEdges;
    t->triangleData.ptr = t->vertices[0];
}

static int MEAPI findTriangles(McdModelPair *pair, McdUserTriangle *triangle, MeVector3 at, MeReal radius, int max) {
    int low[2], high[2], count = 0;
    (void)pair;
    for (int k = 0; k < 2; k++) {
        low[k] = (int)fmax(floor((double)(at[k] - radius) / cell) + CELLS / 2, 0);
        high[k] = (int)fmin(floor((double)(at[k] + radius) / cell) + CELLS / 2, CELLS - 1);
    }
    for (int j = low[1]; j <= high[1]; j++)
        for (int i = low[0]; i <= high[0] && count + 2 <= max; i++) {
            const int a = j * SAMPLES + i;
            addTriangle(&triangle[count++], a, a + 1, a + SAMPLES + 1);
            addTriangle(&triangle[count++], a, a + SAMPLES + 1, a + SAMPLES);
        }
    return count;
}

static McdGeometryID makeList(void) {
    const double reach = cell * CELLS / 2;
    MeVector3 low, high;
    MeVector3Set(low, -reach, -reach, -1);
    MeVector3Set(high, reach, reach, 1);
    return McdTriangleListCreate(u->frame, low, high, 1000, findTriangles);
}

static McdGeometryID makeField(void) {
    const double reach = cell * CELLS / 2;
    return McdRGHeightFieldCreate(u->frame, heights, SAMPLES, SAMPLES, cell, cell, -reach, -reach);
}

static McdGeometryID makePlank(void) {
    return McdBoxCreate(u->frame, 1, .4, .2);
}

static McdGeometryID makeCube(void) {
    return McdBoxCreate(u->frame, 1, 1, 1);
}

static McdGeometryID makeDisc(void) {
    return McdCylinderCreate(u->frame, .5, .2);
}

static McdGeometryID makeHull(void) {
    MeVector3 corner[8];
    for (int i = 0; i < 8; i++)
        MeVector3Set(corner[i], i & 1 ? .5 : -.5, i & 2 ? .2 : -.2, i & 4 ? .1 : -.1);
    return McdConvexMeshCreateHull(u->frame, (const MeVector3 *)corner, 8, 0);
}

static McdGeometryID makeSphyl(void) {
    return McdSphylCreate(u->frame, .25, .5);
}

static McdGeometryID makeBall(void) {
    return McdSphereCreate(u->frame, .3);
}

static McdGeometryID makeLog(void) {
    return McdCylinderCreate(u->frame, .2, 1.2);
}

static double rolling; /* m, and of spinning */

/* Whether a body of that shape that is laid on the bumps sleeps within 40 s. */
static MeBool comesToRest(McdGeometryID (*makeGround)(void), McdGeometryID (*makeShape)(void), double bumps, int seed) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, -9.8);
    const MdtContactParamsID surface = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetSurface(surface, .5, 0);
    MdtContactParamsSetRollingFriction(surface, (MeReal)rolling);
    MdtContactParamsSetSpinningFriction(surface, (MeReal)rolling);
    makeHeights(bumps, seed);
    MstFixedModelCreate(u, makeGround(), place);
    McdModelID m = MstModelAndBodyCreate(u, makeShape(), 500);
    McdModelDynamicsSetPosition(m, .013 * seed, .021 * seed, .6 + bumps);
    for (int i = 0; i < 40 * 60 && McdModelDynamicsIsEnabled(m); i++)
        universe_step(1);
    return !McdModelDynamicsIsEnabled(m);
}

static int countRocking(McdGeometryID (*makeShape)(void)) {
    static const double bumps[] = {.01, .03, .09};
    static const int seeds[] = {12, 13, 18, 20};
    int rocking = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 4; k++) {
            rocking += !comesToRest(makeField, makeShape, bumps[i], seeds[k]);
            rocking += !comesToRest(makeList, makeShape, bumps[i], seeds[k]);
        }
    return rocking;
}

TEST(planks_come_to_rest_on_bumps) {
    ck_assert_int_eq(countRocking(makePlank), 0);
}

TEST(cubes_come_to_rest_on_bumps) {
    ck_assert_int_eq(countRocking(makeCube), 0);
}

TEST(discs_come_to_rest_on_bumps) {
    ck_assert_int_eq(countRocking(makeDisc), 0);
}

TEST(hulls_come_to_rest_on_bumps) {
    ck_assert_int_eq(countRocking(makeHull), 0);
}

/* Without it 14 sphyls, 19 balls and 8 logs of 24 roll to and fro for ever. */
TEST(what_rolls_comes_to_rest_on_bumps_by_rolling_friction) {
    rolling = .01;
    ck_assert_int_eq(countRocking(makeSphyl), 0);
    ck_assert_int_eq(countRocking(makeBall), 0);
    ck_assert_int_eq(countRocking(makeLog), 0);
}

static unsigned int seed;

/* -1/2 .. 1/2 */
static MeReal randomly(void) {
    seed = seed * 1664525u + 1013904223u;
    return (MeReal)((seed >> 8) / 16777216. - .5);
}

/* m: of a box's lowest corner. */
static double lowestOf(McdModelID m, const double side[3]) {
    MeMatrix4 tm;
    MdtBodyGetTransform(McdModelGetBody(m), tm);
    double low = tm[3][2];
    for (int k = 0; k < 3; k++)
        low -= fabs((double)tm[k][2]) * side[k] / 2;
    return low;
}

/* Sides: how deep its lowest corner comes, after it was thrown onto flat ground. */
static double depthOfThrown(McdGeometryID (*makeGround)(void), const double side[3], double restitution) {
    double low = 0;
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, -9.8);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), .5, (MeReal)restitution);
    makeHeights(0, 0);
    MstFixedModelCreate(u, makeGround(), place);
    McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, side[0], side[1], side[2]), 1000);
    McdModelDynamicsSetPosition(m, .3, .1, side[0]);
    McdModelDynamicsSetQuaternion(m, randomly(), randomly(), randomly(), randomly());
    McdModelDynamicsSetAngularVelocity(m, 20 * randomly(), 20 * randomly(), 20 * randomly());
    for (int i = 0; i < 5 * 60; i++) {
        universe_step(1);
        low = fmin(low, lowestOf(m, side));
    }
    return -low / side[2];
}

/* Had only the contacts of their lower edge, and fell through: 11 of 20 planks. The smallest, which gravity moves by
 * half its thickness in a step, overlaps by .06 of it, on a plane as well. */
TEST(thin_boxes_do_not_sink_into_flat_triangles) {
    static const double side[][3] = {{1, .2, .1}, {.8, .4, .2}, {.05, .05, .005}}, restitution[] = {0, .3, .6};
    seed = 777;
    for (int i = 0; i < 3; i++)
        for (int e = 0; e < 3; e++)
            for (int k = 0; k < 10; k++) {
                const double deep = depthOfThrown(k % 2 ? makeList : makeField, side[i], restitution[e]);
                ck_assert_msg(deep < .1, "box %d of %g m, restitution %g: %g of its thickness deep", k, side[i][0],
                              restitution[e], deep);
            }
}
