/* Pairs that hardly move are not tested again (MstBridgeSetContactReuse): what a program does to them is seen at once,
 * and a crowd comes to rest as it does without. Nor are those that do not move at all. */
#include "universe.h"
#include "McdInternal.h"

/* Cubes, cubes of two parts, cubes on a height field, and on a list of the same triangles. */
enum { CUBES, OF_PARTS, ON_FIELD, ON_LIST, KINDS };
enum { SIDE = 41 };                               /* points of the field, 1 m apart */
enum { ROWS = 9, BOXES = ROWS * (ROWS + 1) / 2 }; /* 45: a crowd is more than 32 */

static McdGeometryID box; /* what each model is, or has twice as a part */
static McdModelID model[BOXES], ground;
static MeMatrix4 groundPlace;
static MeReal height[SIDE * SIDE];

/* A cube of two halves, which abut at a vertical face across the pyramid's plane. */
static McdGeometryID makeOfParts(void) {
    const McdAggregateID both = McdAggregateCreate(u->frame, 2);
    MeMatrix4 place;
    MeMatrix4TMMakeIdentity(place);
    box = McdBoxCreate(u->frame, .5, 1, 1);
    for (int i = 0; i < 2; i++) {
        place[3][0] = (MeReal)(i ? .25 : -.25);
        McdAggregateAddElement(both, box, place);
    }
    return both;
}

static int calls; /* of the list's callback */

static void putPoint(MeVector3 *point, int x, int y, McdUserTriangle *t, int corner) {
    MeVector3Set(point[y * SIDE + x], (MeReal)(x - SIDE / 2), (MeReal)(y - SIDE / 2), height[y * SIDE + x]);
    t->vertices[corner] = &point[y * SIDE + x];
}

/* The triangles of the field's cells within the radius. */
static int MEAPI giveTriangles(McdModelPair *pair, McdUserTriangle *triangle, MeVector3 at, MeReal radius, int max) {
    static MeVector3 point[SIDE * SIDE];
    int count = 0;
    (void)pair;
    calls++;
    for (int y = 0; y + 1 < SIDE; y++)
        for (int x = 0; x + 1 < SIDE; x++) {
            if (MeFabs(at[0] - (MeReal)(x - SIDE / 2) - (MeReal).5) > radius + (MeReal).5 ||
                MeFabs(at[1] - (MeReal)(y - SIDE / 2) - (MeReal).5) > radius + (MeReal).5)
                continue;
            for (int half = 0; half < 2 && count < max; half++) {
                McdUserTriangle *t = &triangle[count++];
                putPoint(point, x, y, t, 0);
                putPoint(point, x + 1, y + half, t, 1);
                putPoint(point, x + 1 - half, y + 1, t, 2);
                t->flags = (McdTriangleFlags)(kMcdTriangleUseSmallestPenetration | kMcdTriangleUseEdges);
            }
        }
    return count;
}

static McdGeometryID makeGround(int kind) {
    MeVector3 low = {-20, -20, -1}, high = {20, 20, 1};
    if (kind == ON_FIELD)
        return McdRGHeightFieldCreate(u->frame, height, SIDE, SIDE, 1, 1, -20, -20);
    return kind == ON_LIST ? McdTriangleListCreate(u->frame, low, high, 200, giveTriangles)
                           : McdBoxCreate(u->frame, 40, 40, 1);
}

/* Cubes in a vertical pyramid, of which each row stands 2 mm above the one below. */
static void build(double part, int kind) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    sizes.dynamicConstraintsMaxCount = 2000;
    universe_begin(&sizes);
    MdtWorldSetGravity(u->world, 0, 0, -9.81);
    MdtWorldSetEpsilon(u->world, 0);
    MdtWorldSetWorkBudget(u->world, 0);
    MdtWorldSetSolver(u->world, MdtSolverExact); /* what rests does not move at all, so that only the cache shows */
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldEnableReport(u->world);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), .5, 0);
    MstBridgeSetContactReuse(u->bridge, part);
    MeMatrix4TMMakeIdentity(groundPlace);
    memset(height, 0, sizeof height);
    if (kind >= ON_FIELD)
        groundPlace[3][2] = (MeReal).5;
    ground = MstFixedModelCreate(u, makeGround(kind), groundPlace);
    box = McdBoxCreate(u->frame, 1, 1, 1);
    const McdGeometryID cube = kind == OF_PARTS ? makeOfParts() : box;
    int n = 0;
    for (int row = 0; row < ROWS; row++)
        for (int i = 0; i < ROWS - row; i++) {
            model[n] = MstModelAndBodyCreate(u, cube, 1);
            McdModelDynamicsSetPosition(model[n++], 1.02 * (i - .5 * (ROWS - row - 1)), 0, 1 + 1.002 * row);
        }
    ck_assert_int_eq(n, BOXES);
}

static void step(int count) {
    universe_step(count);
}

static double heightOf(McdModelID m) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    return (double)p[2];
}

/* The deepest contact of the body, m. */
static double depthOf(McdModelID m) {
    double deepest = -HUGE_VAL;
    const MdtBodyID b = McdModelGetBody(m);
    for (MdtContactID c = MdtBodyGetFirstContact(b); c; c = MdtBodyGetNextContact(b, c))
        deepest = fmax(deepest, MdtContactGetPenetration(c));
    return deepest;
}

/* Makes the step's contacts, and no step. */
static void findContacts(void) {
    McdSpaceUpdateAll(u->space);
    MstBridgeUpdateContacts(u->bridge, u->space, u->world);
}

LOOP_TEST(a_crowd_comes_to_rest_as_it_does_without, (int)TOL(0, ON_FIELD), KINDS) {
    double tested[BOXES];
    build(0, _i);
    step(120);
    for (int i = 0; i < BOXES; i++)
        tested[i] = heightOf(model[i]);
    build(MST_CONTACT_REUSE, _i);
    step(120);
    for (int i = 0; i < BOXES; i++)
        assert_near(heightOf(model[i]), tested[i], TOL(2e-6, 1e-6));
    MdtReport r;
    ck_assert(MdtWorldGetReport(u->world, &r));
    ck_assert_int_eq(r.way, MdtReportWayRest);
}

/* Each is less than what a pair may move without a test. */
LOOP_TEST(a_change_by_the_program_is_seen, 0, KINDS) {
    MeVector3 p;
    build(MST_CONTACT_REUSE, _i);
    step(90);
    const double before = depthOf(model[0]);
    McdModelDynamicsGetPosition(model[0], p);
    McdModelDynamicsSetPosition(model[0], p[0], p[1], p[2] - (MeReal)1e-4);
    findContacts();
    assert_near(depthOf(model[0]), before + 1e-4, 1e-6);
    McdModelDynamicsSetPosition(model[0], p[0], p[1], p[2]);
    findContacts();
    assert_near(depthOf(model[0]), before, 1e-6);
    McdBoxGetRadii(box)[2] = (MeReal).5001; /* all of them, by 1e-4 on either side */
    findContacts();
    assert_near(depthOf(model[0]), before + 2e-4, 1e-6); /* that of the box above it */
    McdBoxGetRadii(box)[2] = (MeReal).5;
    findContacts();
    assert_near(depthOf(model[0]), before, 1e-6);
    groundPlace[3][2] += (MeReal)1e-4; /* programs move fixed models by their matrix */
    McdModelUpdate(ground);
    findContacts();
    assert_near(depthOf(model[0]), before + 1e-4, 1e-6);
    for (int i = 0; i < SIDE * SIDE; i++)
        height[i] = (MeReal)1e-4;
    findContacts();
    assert_near(depthOf(model[0]), before + (_i >= ON_FIELD ? 2e-4 : 1e-4), 1e-6);
}

/* ---- surfaces of triangles --------------------------------------------------------------------------------------- */

static MdtContactID groundContact(McdModelID m) {
    const MdtBodyID b = McdModelGetBody(m);
    MdtContactID c = MdtBodyGetFirstContact(b);
    while (c && MdtContactGetBody(c, 1))
        c = MdtBodyGetNextContact(b, c);
    return c;
}

/* A depth that no test finds is still there unless the model has been tested against the ground. */
static MeBool isTested(McdModelID m) {
    const MeReal mark = .25, depth = MdtContactGetPenetration(groundContact(m));
    MdtContactSetPenetration(groundContact(m), mark);
    findContacts();
    const MeBool isMarked = MdtContactGetPenetration(groundContact(m)) == mark;
    if (isMarked)
        MdtContactSetPenetration(groundContact(m), depth);
    return !isMarked;
}

static MeReal *heightAt(int x, int y) {
    return &height[(y + SIDE / 2) * SIDE + x + SIDE / 2];
}

/* _i: on a field, on a list. */
LOOP_TEST(a_box_at_rest_on_triangles_is_tested_while_it_is_awake, ON_FIELD, KINDS) {
    build(MST_CONTACT_REUSE, _i);
    step(120);
    for (int i = 0; i < ROWS; i++)
        ck_assert_msg(isTested(model[i]), "box %d", i);
}

static int pairCalls;
static MeBool MEAPI countPair(McdIntersectResult *result, MdtContactGroupID group) {
    (void)result;
    (void)group;
    pairCalls++;
    return METRUE;
}

static McdModelPair *groundPair(McdModelID m) {
    const McdModelPairContainer *pairs = u->bridge->pairs;
    for (int i = pairs->helloFirst; i < pairs->stayingEnd; i++) {
        McdModelPair *p = pairs->array[i];
        if ((p->model1 == m && p->model2 == ground) || (p->model2 == m && p->model1 == ground))
            return p;
    }
    ck_abort_msg("no pair with the ground");
    return NULL;
}

static MeBool persists(McdModelID m) {
    int count, found = 0;
    const MstEvent *e = MstUniverseGetEvents(u, &count);
    for (int i = 0; i < count; i++)
        if ((e[i].model1 == m && e[i].model2 == ground) || (e[i].model2 == m && e[i].model1 == ground))
            found += e[i].kind == MstEventPersist ? 1 : 100;
    return found == 1;
}

/* What lies still touches still, is found again where the program has taken its contacts away, and is shown to a
 * callback that is set later. */
LOOP_TEST(what_lies_still_on_triangles_touches_them, ON_FIELD, KINDS) {
    build(0, _i);
    step(120);
    for (int i = 0; i < 10; i++) {
        step(1);
        ck_assert_msg(persists(model[0]), "step %d", i);
    }
    MdtContactGroupReset(groundPair(model[0])->responseData);
    ck_assert(!groundContact(model[0]));
    findContacts();
    ck_assert(groundContact(model[0]));
    MstBridgeSetPerPairCB(u->bridge, 0, 0, countPair);
    pairCalls = 0;
    findContacts();
    ck_assert_int_ge(pairCalls, ROWS);
}

enum { ON_HILLS = 8 };

/* Each kind of shape on hills, two of each, apart from each other. */
static int buildOnHills(McdModelID on[ON_HILLS], int kind) {
    int n = 0;
    build(MST_CONTACT_REUSE, kind);
    for (int i = 0; i < BOXES; i++)
        MstModelAndBodyDestroy(model[i]);
    MdtWorldSetSolver(u->world, MdtSolverAuto);
    MdtWorldSetEpsilon(u->world, 1e-4);
    for (int i = 0; i < SIDE * SIDE; i++)
        height[i] = (MeReal)(.3 * sin(i % SIDE) * cos(.7 * (i / SIDE)));
    if (kind == ON_FIELD)
        McdRGHeightFieldUpdateHeights(McdModelGetGeometry(ground));
    McdSpaceUnfreezeModel(ground); /* so that it gets the box of these heights */
    for (; n < ON_HILLS; n++) {
        const McdGeometryID shape[] = {McdBoxCreate(u->frame, 1, .7, .5), makeOfParts(),
                                       McdCylinderCreate(u->frame, .4, .6), McdSphylCreate(u->frame, .3, .5)};
        on[n] = MstModelAndBodyCreate(u, shape[n % 4], 1);
        McdModelDynamicsSetPosition(on[n], 3 * (n % 4) - 5.3, 3.1 * (n / 4) - 5.2, 1.6);
    }
    return n;
}

/* Digs away single heights now and then. */
static void dig(int i, MeBool isTold) {
    if (i % 40 != 0)
        return;
    *heightAt(i / 40 % 9 - 4, i / 40 % 7 - 3) -= (MeReal).05;
    if (isTold)
        McdGeometryUpdate(McdModelGetGeometry(ground));
}

/* A list's callback is called in every step all the same. */
LOOP_TEST(bodies_that_are_awake_meet_what_is_dug_away_told_or_not, ON_FIELD, KINDS) {
    enum { STEPS = 500 };
    static MeMatrix4 kept[STEPS][ON_HILLS];
    McdModelID on[ON_HILLS];
    int called[2];
    for (int isTold = 0; isTold < 2; isTold++) {
        const int n = buildOnHills(on, _i);
        calls = 0;
        for (int i = 0; i < STEPS; i++) {
            dig(i, isTold);
            step(1);
            for (int k = 0; k < n; k++)
                if (!isTold)
                    memcpy(kept[i][k], MdtBodyGetTransformPtr(McdModelGetBody(on[k])), sizeof kept[i][k]);
                else
                    ck_assert_msg(
                        memcmp(kept[i][k], MdtBodyGetTransformPtr(McdModelGetBody(on[k])), sizeof kept[i][k]) == 0,
                        "step %d, body %d", i, k);
        }
        called[isTold] = calls;
    }
    ck_assert_int_eq(called[0], called[1]);
    ck_assert((called[0] > 0) == (_i == ON_LIST));
}

/* ---- asleep on surfaces ------------------------------------------------------------------------------------------ */

/* One cube asleep on level ground, with a pit in a corner: the ground's box is the same whatever is dug away. Another
 * box may change the last bits of contacts, and so wake what sleeps. */
static void putToSleep(int kind) {
    build(MST_CONTACT_REUSE, kind);
    height[SIDE * SIDE - 1] = -1;
    McdGeometryUpdate(McdModelGetGeometry(ground));
    MdtWorldSetAutoDisable(u->world, METRUE);
    for (int i = 1; i < BOXES; i++)
        MstModelAndBodyDestroy(model[i]);
    step(200);
    ck_assert(!MdtBodyIsEnabled(McdModelGetBody(model[0])));
}

/* All of it, or another corner of the ground. */
static void lower(MeBool isAll) {
    for (int i = 0; i < (isAll ? SIDE * SIDE : 1); i++)
        height[i] -= (MeReal).1;
}

/* _i: on a field, on a list. The ground is frozen, as MstFixedModelCreate leaves it. */
LOOP_TEST(a_sleeper_meets_what_was_dug_away_when_told, ON_FIELD, KINDS) {
    putToSleep(_i);
    const double before = heightOf(model[0]);
    lower(METRUE);
    McdGeometryUpdate(McdModelGetGeometry(ground));
    step(1);
    ck_assert(MdtBodyIsEnabled(McdModelGetBody(model[0])));
    step(100);
    assert_near(heightOf(model[0]), before - .1, 1e-5);
}

LOOP_TEST(a_sleeper_meets_what_was_dug_away_without_a_call_when_woken, ON_FIELD, KINDS) {
    putToSleep(_i);
    const double before = heightOf(model[0]);
    lower(METRUE);
    step(100);
    ck_assert(!MdtBodyIsEnabled(McdModelGetBody(model[0])));
    assert_near(heightOf(model[0]), before, 0);
    MdtBodyEnable(McdModelGetBody(model[0]));
    step(100);
    assert_near(heightOf(model[0]), before - .1, 1e-5);
}

LOOP_TEST(a_sleeper_sleeps_on_where_its_own_ground_is_the_same, ON_FIELD, KINDS) {
    putToSleep(_i);
    for (int i = 0; i < 3; i++) {
        lower(MEFALSE);
        McdGeometryUpdate(McdModelGetGeometry(ground));
        step(2);
        ck_assert(!MdtBodyIsEnabled(McdModelGetBody(model[0])));
    }
}

/* A field that is not frozen is no reason to test what sleeps on it. */
TEST(on_a_field_that_is_not_frozen_sleepers_are_not_tested) {
    putToSleep(ON_FIELD);
    McdSpaceUnfreezeModel(ground);
    step(2);
    lower(METRUE);
    step(2);
    ck_assert(!MdtBodyIsEnabled(McdModelGetBody(model[0])));
    McdGeometryUpdate(McdModelGetGeometry(ground));
    step(1);
    ck_assert(MdtBodyIsEnabled(McdModelGetBody(model[0])));
}

/* The sum over the body's contacts, m. */
static double depthsOf(McdModelID m) {
    double sum = 0;
    const MdtBodyID b = McdModelGetBody(m);
    for (MdtContactID c = MdtBodyGetFirstContact(b); c; c = MdtBodyGetNextContact(b, c))
        sum += (double)MdtContactGetPenetration(c);
    return sum;
}

/* The box at the top is tilted by less than what asks for a test: so are the depths of its four corners. */
LOOP_TEST(depths_follow_the_bodies, 0, KINDS) {
    double max = 0;
    build(MST_CONTACT_REUSE, _i);
    const McdModelID top = model[BOXES - 1];
    step(90);
    const double still = depthsOf(top);
    const MeReal lift = (MeReal)9.8 * MdtBodyGetMass(McdModelGetBody(top)); /* nearly its weight: a slow fall */
    for (int i = 0; i < 12; i++) {
        MdtBodySetAngularVelocity(McdModelGetBody(top), i % 3 ? .02 : -.02, .01, 0);
        MdtBodyAddForce(McdModelGetBody(top), 0, 0, lift);
        step(1);
        findContacts();
        const double carried = depthsOf(top);
        max = fmax(max, fabs(carried - still));
        MstBridgeSetContactReuse(u->bridge, 0);
        findContacts();
        assert_near(depthsOf(top), carried, TOL(1e-6, 1e-9));
        MstBridgeSetContactReuse(u->bridge, MST_CONTACT_REUSE);
    }
    ck_assert_msg(max > 1e-4, "the corners moved by %g in all", max);
}

TEST(bad_input_changes_nothing) {
    build(MST_CONTACT_REUSE, CUBES);
    assert_refused(MstBridgeSetContactReuse, u->bridge, -1);
    assert_refused(MstBridgeSetContactReuse, u->bridge, 2);
    assert_near(MstBridgeGetContactReuse(u->bridge), (double)(MeReal)MST_CONTACT_REUSE, 0);
    assert_none(MstBridgeGetContactReuse, 0);
}
