/* Queries of bodies that a step has moved: they see them where they are now, compounds too. */
#include "McdInternal.h"
#include "McdModelPair.h"
#include "MstMover.h"
#include "universe.h"

#define STEP (1. / 60)

enum { BOX, COMPOUND, NESTED, SHAPES };
static const MeReal size = 4; /* m, of each shape: a cube */

static McdGeometryID compoundOf(McdGeometryID g) {
    const McdAggregateID a = McdAggregateCreate(u->frame, 1);
    MeMatrix4 tm;
    MeMatrix4TMMakeIdentity(tm);
    McdAggregateAddElement(a, g, tm);
    return a;
}

static McdGeometryID shapeOf(int shape) {
    McdGeometryID g = McdBoxCreate(u->frame, size, size, size);
    for (int i = 0; i < shape; i++)
        g = compoundOf(g);
    return g;
}

static void begin(void) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, 0);
}

/* A cube that moves up by `way` m in a step. */
static McdModelID addMoving(int shape, MeBool isKinematic, double way) {
    const McdModelID m = MstModelAndBodyCreate(u, shapeOf(shape), 1);
    MdtBodySetKinematic(McdModelGetBody(m), isKinematic);
    McdModelDynamicsSetLinearVelocity(m, 0, 0, (MeReal)(way / STEP));
    return m;
}

static double topOf(McdModelID m) {
    return (double)McdModelGetTransformPtr(m)[3][2] + size / 2;
}

/* Whether what is at that height is hit along x: by a ray, a cast ball, a segment; and overlaps a ball there. */
static int countHits(McdModelID m, double height) {
    const McdGeometryID ball = McdSphereCreate(u->frame, (MeReal).001);
    const MeVector3 by = {20, 0, 0};
    MeVector3 from = {-10, 0, (MeReal)height}, to = {10, 0, (MeReal)height};
    McdLineSegIntersectResult segment;
    McdCastResult hit;
    McdModelID found;
    MeMatrix4 tm;
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMSetPosition(tm, from[0], from[1], from[2]);
    int hits = McdSpaceCastRay(u->space, from, by, 0, 0, &hit) && hit.model == m;
    hits += McdSpaceCastGeometry(u->space, ball, (const MeVector4 *)tm, by, 0, 0, &hit) && hit.model == m;
    hits += McdSpaceGetLineSegFirstIntersection(u->space, from, to, &segment) && segment.model == m;
    hits += McdLineSegIntersect(m, from, to, &segment) != 0;
    tm[3][0] = 0;
    hits += McdSpaceOverlapGeometry(u->space, ball, (const MeVector4 *)tm, 0, 0, &found, 1) == 1;
    return hits;
}

LOOP_TEST(a_step_s_motion_is_seen_at_once, 0, 2 * SHAPES) {
    enum { ALL = 5 };
    const double way[] = {.02, .1, 1};
    for (int i = 0; i < 3; i++) {
        begin();
        const McdModelID m = addMoving(_i / 2, _i % 2 != 0, way[i]);
        universe_step(20);
        McdSpaceEndChanges(u->space);
        ck_assert_int_eq(countHits(m, topOf(m) - .4 * way[i]), ALL);
        ck_assert_int_eq(countHits(m, topOf(m) - size - .4 * way[i]), 0);
        McdSpaceBeginChanges(u->space);
    }
}

LOOP_TEST(distances_are_those_of_now, 0, 2 * SHAPES) {
    McdClosestResult closest;
    McdDistanceResult distance;
    MeMatrix4 tm;
    begin();
    const McdModelID m = addMoving(_i / 2, _i % 2 != 0, .1), other = addMoving(_i / 2, METRUE, -.1);
    McdModelDynamicsSetPosition(other, 0, 0, 12);
    universe_step(20);
    const McdGeometryID ball = McdSphereCreate(u->frame, (MeReal).5);
    MeMatrix4TMMakeIdentity(tm);
    tm[3][2] = (MeReal)(topOf(m) + .6);
    McdSpaceEndChanges(u->space);
    ck_assert(McdSpaceGetClosest(u->space, ball, (const MeVector4 *)tm, 1, 0, 0, &closest) && closest.model == m);
    assert_near(closest.distance, .1, TOL(1e-6, 1e-14));
    McdModelPair *pair = McdModelPairCreate(m, other);
    McdHello(pair);
    ck_assert(McdDistance(pair, &distance));
    assert_near(distance.distance, topOf(other) - size - topOf(m), TOL(1e-5, 1e-13));
    McdGoodbye(pair);
    McdModelPairDestroy(pair);
    McdSpaceBeginChanges(u->space);
}

/* A model asked for what overlaps it, as its own part and as that of others. */
LOOP_TEST(overlaps_of_models_are_those_of_now, 0, SHAPES) {
    McdModelID found[2];
    begin();
    const McdModelID m = addMoving(_i, MEFALSE, .5), ahead = addMoving(_i, METRUE, 0);
    const McdModelID behind = addMoving(_i, METRUE, 0);
    McdModelSetSensor(m, METRUE);
    universe_step(19);
    McdModelDynamicsSetPosition(ahead, 0, 0, (MeReal)(19 * .5 + 4.25));
    McdModelDynamicsSetPosition(behind, 0, 0, (MeReal)(19 * .5 - 3.75));
    universe_step(1);
    McdSpaceEndChanges(u->space);
    ck_assert_int_eq(McdSpaceOverlapModel(u->space, m, 0, 0, found, 2), 1);
    ck_assert_ptr_eq(found[0], ahead);
    McdSpaceBeginChanges(u->space);
}

/* ---- movers ---- */

/* A character on a lift of `shape` that has gone to its place in the step before. */
LOOP_TEST(movers_stand_on_what_carries_them, 0, 2 * SHAPES) {
    MstMoverParams params;
    MstMoverResult at = {.flags = 0};
    begin();
    MdtWorldSetGravity(u->world, 0, 0, -10);
    const McdModelID deck = addMoving(_i / 2, METRUE, 0);
    MstMoverSetDefaults(&params, u);
    const MeVector3 place = {0, 0, size / 2};
    universe_step(1);
    const MstMoverID mover = MstMoverCreate(u, &params, place);
    double height = 0;
    for (int i = 0; i < 60; i++) {
        MeVector3 to = {0, 0, 0}, want = {0, 0, at.flags & kMstMoverOnGround ? 0 : at.velocity[2] - 10 * (MeReal)STEP};
        MeVector4 q = {1, 0, 0, 0};
        height += (_i % 2 ? -1 : 1) * fmin(.1 * i, 4) * STEP;
        to[2] = (MeReal)height;
        MdtBodyMoveTo(McdModelGetBody(deck), to, q);
        universe_step(1);
        MstMoverMove(mover, want, (MeReal)STEP, &at);
        if (i > 2)
            assert_near((double)at.position[2] - topOf(deck), params.skin, TOL(3e-6, 2e-14));
    }
    MstMoverDestroy(mover);
}

/* ---- the simulation does not depend on them ---- */

static McdGeometryID dumbbell(void) {
    const McdAggregateID a = McdAggregateCreate(u->frame, 2);
    MeMatrix4 tm;
    MeMatrix4TMMakeIdentity(tm);
    for (int i = -1; i <= 1; i += 2) {
        tm[3][0] = (MeReal)(.5 * i);
        McdAggregateAddElement(a, McdBoxCreate(u->frame, (MeReal).6, (MeReal).5, (MeReal).4), tm);
    }
    return a;
}

enum { DUMBBELLS = 6 };

/* Dumbbells fall onto one that is fixed, which is moved away and back between steps; and one is disabled by hand as it
 * falls past. */
static void fall(MeBool areAsked, MeMatrix4 end[DUMBBELLS]) {
    static MeMatrix4 fixedTM;
    McdModelID model[DUMBBELLS];
    McdCastResult hit;
    begin();
    MdtWorldSetGravity(u->world, 0, 0, -10);
    universe_addFloor();
    MeMatrix4TMMakeIdentity(fixedTM);
    fixedTM[3][2] = 1;
    MstFixedModelCreate(u, dumbbell(), fixedTM);
    for (int i = 0; i < DUMBBELLS; i++) {
        model[i] = MstModelAndBodyCreate(u, dumbbell(), 10);
        McdModelDynamicsSetPosition(model[i], (MeReal)(.3 * (i % 3)), (MeReal)(.1 * i), (MeReal)(2.5 + 1.2 * i));
        MdtBodySetAngularVelocity(McdModelGetBody(model[i]), (MeReal)i, 1, 0);
    }
    for (int i = 0; i < 150; i++) {
        universe_step(1);
        if (i == 20)
            MdtBodyDisable(McdModelGetBody(model[2]));
        fixedTM[3][0] += 5;
        McdSpaceEndChanges(u->space);
        for (int k = 0; k < 50 && areAsked; k++) {
            const MeVector3 from = {(MeReal)(.13 * k - 1), 0, 10}, by = {0, (MeReal).1, -20};
            McdSpaceCastRay(u->space, from, by, 0, 0, &hit);
        }
        McdSpaceBeginChanges(u->space);
        fixedTM[3][0] -= 5;
    }
    for (int i = 0; i < DUMBBELLS; i++)
        MeMatrix4Copy(end[i], (const MeVector4 *)McdModelGetTransformPtr(model[i]));
}

TEST(what_is_asked_changes_nothing) {
    MeMatrix4 end[2][DUMBBELLS];
    fall(MEFALSE, end[0]);
    fall(METRUE, end[1]);
    ck_assert(memcmp(end[0], end[1], sizeof end[0]) == 0);
}

/* ---- another shape in a child's place ---- */

TEST(a_child_may_get_another_shape) {
    McdCastResult hit;
    const MeVector3 from = {0, 0, 9}, by = {0, 0, -20};
    begin();
    const McdModelID m = addMoving(COMPOUND, MEFALSE, .1);
    const McdGeometryID small = McdBoxCreate(u->frame, 1, 1, 1);
    McdGeometryInstanceSetGeometry(McdGeometryInstanceGetChild(McdModelGetGeometryInstance(m), 0), small);
    universe_step(5);
    McdSpaceEndChanges(u->space);
    ck_assert(McdSpaceCastRay(u->space, from, by, 0, 0, &hit) && hit.model == m);
    assert_near(hit.position[2], (double)McdModelGetTransformPtr(m)[3][2] + .5, TOL(1e-6, 1e-14));
    McdSpaceBeginChanges(u->space);
}
