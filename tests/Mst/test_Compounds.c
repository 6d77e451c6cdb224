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

/* ---- the centre of mass ---- */

/* A part at a place, turned about an axis, in an aggregate of its own. */
static McdGeometryID placed(McdGeometryID part, const MeMatrix4 place) {
    const McdAggregateID whole = McdAggregateCreate(u->frame, 1);
    McdAggregateAddElement(whole, part, (MeVector4 *)place);
    return whole;
}

/* The world's place of a point of a model. */
static void pointOf(McdModelID m, const MeVector3 point, MeVector3 at) {
    MeMatrix4TMTransform(at, (const MeVector4 *)McdModelGetTransformPtr(m), point);
}

/* A box far from the origin of its aggregate, and turned there, moves as the same box alone does: thrown, turned, and
 * falling on a floor on its edge. */
LOOP_TEST(a_compound_has_its_centre_where_the_mass_is, 0, 3) {
    static const MeVector3 axis = {1, 2, -1}, corner = {(MeReal).2, (MeReal).4, (MeReal).6}, none = {0, 0, 0};
    MeMatrix4 at, back;
    MeVector4 turn;
    MeVector3 one, two;
    begin(.5);
    MdtWorldSetSolver(u->world, (MdtSolver)_i);
    MeMatrix4TMMakeIdentity(at);
    MeQuaternionMake(turn, axis, (MeReal)1.1);
    MeMatrix4TMSetRotationFromQuaternion(at, turn);
    at[3][0] = 3, at[3][1] = -2, at[3][2] = 1;
    const McdGeometryID box = McdBoxCreate(u->frame, (MeReal).4, (MeReal).8, (MeReal)1.2);
    const McdModelID plain = MstModelAndBodyCreate(u, box, 500);
    const McdModelID whole = MstModelAndBodyCreateWithCenter(u, placed(box, (const MeVector4 *)at), 500);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorPlace);
    const MdtBodyID body[2] = {McdModelGetBody(plain), McdModelGetBody(whole)};
    MeMatrix4Copy(back, (const MeVector4 *)at);
    MeMatrix4TMInvert(back);
    back[3][2] += 5;
    MdtBodySetPosition(body[0], 0, 10, 5);
    MdtBodySetTransform(body[1], (const MeVector4 *)back);
    for (int k = 0; k < 2; k++) {
        MdtBodySetLinearVelocity(body[k], 1, 0, 2);
        MdtBodySetAngularVelocity(body[k], 1, 2, (MeReal)-.5);
    }
    assert_near(MdtBodyGetMass(body[1]), 500 * .4 * .8 * 1.2, TOL(1e-3, 1e-12));
    for (int i = 0; i < 60; i++) {
        step(1);
        MeVector3 inPart;
        MeMatrix4TMTransform(inPart, (const MeVector4 *)at, corner);
        pointOf(plain, corner, one);
        pointOf(whole, inPart, two);
        assert_vec3_near(two, one[0], one[1] - 10, one[2], TOL(1e-4, 1e-11));
        MeMatrix4TMTransform(inPart, (const MeVector4 *)at, none);
        pointOf(whole, inPart, two);
        MdtBodyGetCenterOfMassPosition(body[1], one);
        assert_vec3_near(two, one[0], one[1], one[2], TOL(1e-5, 1e-13));
    }
    step(240); /* it has fallen on the floor */
    for (int k = 0; k < 2; k++) {
        MdtBodyGetCenterOfMassPosition(body[k], one);
        ck_assert(one[2] < (MeReal).7 && one[2] > (MeReal).19);
    }
}

/* Two cubes: mass, centre and moments by Steiner. */
TEST(a_hammer_turns_about_its_centre_of_mass) {
    MeMatrix4 at;
    MeMatrix3 inertia;
    MeVector3 centre;
    begin(0);
    const McdAggregateID hammer = McdAggregateCreate(u->frame, 2);
    MeMatrix4TMMakeIdentity(at);
    McdAggregateAddElement(hammer, McdBoxCreate(u->frame, 1, 1, 1), at);
    at[3][0] = 3;
    McdAggregateAddElement(hammer, McdBoxCreate(u->frame, 2, 2, 2), at);
    const McdModelID m = MstModelAndBodyCreateWithCenter(u, hammer, 10);
    const MdtBodyID b = McdModelGetBody(m);
    const double masses[] = {10, 80}, middle = 80 * 3. / 90;
    const double along = 10 / 6. + 80 * 4 / 6., across = along + masses[0] * middle * middle + 80 * pow(3 - middle, 2);
    MdtBodyGetCenterOfMassRelativePosition(b, centre);
    assert_vec3_near(centre, middle, 0, 0, TOL(1e-6, 1e-14));
    MdtBodyGetInertiaTensor(b, inertia);
    assert_near(inertia[0][0] + inertia[1][1] + inertia[2][2], along + 2 * across, TOL(1e-3, 1e-11));
    MdtWorldSetGravity(u->world, 0, 0, 0);
    MdtBodySetAngularVelocity(b, 0, 0, 3);
    step(60);
    MdtBodyGetCenterOfMassPosition(b, centre);
    assert_vec3_near(centre, middle, 0, 0, TOL(1e-6, 1e-14));
    assert_near(coordinate(m, 0), middle - middle * cos(3), 2e-3);
    assert_none(MstModelAndBodyCreateWithCenter, u, NULL, 10);
    assert_refused(MstAutoSetMassAndCenter, b, m, -1);
}
