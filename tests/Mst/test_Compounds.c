/* Bodies that are aggregates of abutting boxes behave as solid ones do. */
#include "universe.h"

enum { CUBES = 5 };
static MeMatrix4 floorPlace;

static void begin(double friction) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, -9.81);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), friction, 0);
    MeMatrix4TMMakeIdentity(floorPlace);
}

/* A box cut across x into so many. */
static McdGeometryID boxInParts(int parts, double x, double y, double z) {
    const McdAggregateID whole = McdAggregateCreate(u->frame, parts);
    const McdGeometryID part = McdBoxCreate(u->frame, x / parts, y, z);
    for (int i = 0; i < parts; i++) {
        MeMatrix4 place;
        MeMatrix4TMMakeIdentity(place);
        place[3][0] = (MeReal)(x * ((i + .5) / parts - .5));
        McdAggregateAddElement(whole, part, place);
    }
    return whole;
}

static void step(int count) {
    universe_step(count);
}

static double coordinate(McdModelID m, int k) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    return (double)p[k];
}

/* rad: from how it lay at first. */
static double angleOf(McdModelID m) {
    MeVector4 q;
    McdModelDynamicsGetQuaternion(m, q);
    return 2 * sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

/* Where a box that slides at 5 m/s over a floor in so many parts is after 6 s, and how high it came. */
static double slide(int parts, McdGeometryID (*shape)(void), double friction, double *highest) {
    begin(friction);
    const McdModelID box = MstModelAndBodyCreate(u, shape(), 500);
    MstFixedModelCreate(u, boxInParts(parts, 40, 3, 1), floorPlace);
    McdModelDynamicsSetPosition(box, -15, 0, .75);
    McdModelDynamicsSetLinearVelocity(box, 5, .1, 0);
    *highest = 0;
    for (int i = 0; i < 360; i++) {
        step(1);
        *highest = fmax(*highest, coordinate(box, 2));
    }
    const double way = coordinate(box, 0);
    return way;
}

static McdGeometryID makeBox(void) {
    return McdBoxCreate(u->frame, .5, .5, .5);
}

static McdGeometryID makeBoxOfThree(void) {
    return boxInParts(3, .5, .5, .5);
}

/* 30 m without friction, or until it stops. */
TEST(a_box_slides_over_parts_as_over_one) {
    static McdGeometryID (*const shape[])(void) = {makeBox, makeBoxOfThree};
    static const double friction[] = {0, .2};
    for (int s = 0; s < 2; s++)
        for (int f = 0; f < 2; f++) {
            double high[2];
            const double way = slide(1, makeBox, friction[f], &high[0]) + 15;
            const double other = slide(8, shape[s], friction[f], &high[1]) + 15;
            assert_near_rel(other, way, TOL(5e-7, 1e-11));
            assert_near(high[1], high[0], TOL(4e-7, 1e-9));
        }
}

/* Cubes of one or two parts, a little deep in each other and tilted; every second one aside by half of that depth. */
static void stack(int parts, double tilt, McdModelID cube[CUBES]) {
    begin(.5);
    MstFixedModelCreate(u, boxInParts(parts, 4, 4, 1), floorPlace);
    for (int i = 0; i < CUBES; i++) {
        cube[i] = MstModelAndBodyCreate(u, boxInParts(parts, 1, 1, 1), 500);
        McdModelDynamicsSetPosition(cube[i], 5e-4 * (i % 2), 0, 1 + .999 * i - 1e-3);
        McdModelDynamicsSetQuaternion(cube[i], cos(tilt / 2), 0, sin(tilt / 2), 0);
    }
}

TEST(cubes_of_halves_stand_as_solid_ones) {
    static const double tilts[] = {0, 1e-3, -2e-2};
    for (int t = 0; t < 3; t++) {
        McdModelID cube[CUBES];
        double height[CUBES], aside[CUBES];
        stack(1, tilts[t], cube);
        step(300);
        for (int i = 0; i < CUBES; i++) {
            height[i] = coordinate(cube[i], 2);
            aside[i] = coordinate(cube[i], 0);
        }
        stack(2, tilts[t], cube);
        step(300);
        for (int i = 0; i < CUBES; i++) {
            assert_near(angleOf(cube[i]), 0, TOL(1e-5, 4e-6));
            assert_near(coordinate(cube[i], 2), height[i], (i + 1) * TOL(1e-5, 1e-6)); /* each contact has a gap */
            if (fabs(tilts[t]) < .01) /* beyond that, they fall onto an edge, and slide by a centimetre meanwhile */
                assert_near(coordinate(cube[i], 0), aside[i], 6e-6);
        }
    }
}

/* A small box below the joint of two parts of the floor, nearer to the inner faces of both than to the top. */
TEST(what_is_deep_between_parts_comes_out) {
    begin(.5);
    MstFixedModelCreate(u, boxInParts(4, 8, 2, 1), floorPlace);
    const McdModelID box = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, .2, .2, .2), 500);
    McdModelDynamicsSetPosition(box, 1e-3, 0, .45);
    step(240);
    assert_near(coordinate(box, 2), .6, TOL(8e-6, 1e-7));
}
