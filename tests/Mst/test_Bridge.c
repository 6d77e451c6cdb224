/* The bridge: the material table, its callbacks, contact groups from touch to goodbye. */
#include "universe.h"

static McdModelID floorModel, ball;
static int called;
static MeBool answer;

static void setUp(void) {
    universe_begin(0);
    floorModel = universe_addFloor();
    ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, 1), 1);
    McdModelDynamicsSetPosition(ball, 0, 0, .99);
    called = 0;
    answer = METRUE;
}

TEST_FIXTURE(setUp, NULL)

static void step(void) {
    MstUniverseStep(u, 1. / 60);
}

static MdtContactID onlyContact(void) {
    MdtContactID c = MdtBodyGetFirstContact(McdModelGetBody(ball));
    ck_assert(!c || !MdtBodyGetNextContact(McdModelGetBody(ball), c));
    return c;
}

/* ---- pairs that stand still -------------------------------------------------------------------------------------- */

enum { TOWER = 6, STILL_STEPS = 200, HIT = 60, CHANGE = 120 };

static void MEAPI goOn(McdIntersectResult *result) {
    (void)result;
    called++;
}

/* A tower that touches without weight, so that nothing moves to the last bit, until a ball hits it; later one of its
 * boxes grows, and friction goes. A callback has every pair tested in every step. */
static void playTower(MeBool isTested, MeVector3 place[TOWER + 1]) {
    const McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1), other = McdBoxCreate(u->frame, 1, 1, 1);
    McdModelID model[TOWER + 1];
    if (isTested)
        MstBridgeSetIntersectCB(u->bridge, 0, 0, goOn);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), .5, .3);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    for (int i = 0; i < TOWER; i++) {
        model[i] = MstModelAndBodyCreate(u, i == 2 ? other : cube, 1);
        McdModelDynamicsSetPosition(model[i], 20, 0, .5 + i);
    }
    model[TOWER] = ball;
    McdModelDynamicsSetPosition(ball, 10, 0, 2.2);
    McdModelDynamicsSetLinearVelocity(ball, 8.5 / (HIT / 60.), 0, 0);
    for (int i = 0; i < STILL_STEPS; i++) {
        if (i == CHANGE)
            McdBoxGetRadii(other)[2] = (MeReal).52;
        if (i == CHANGE + 10)
            MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), .01, 0);
        step();
    }
    for (int i = 0; i <= TOWER; i++)
        McdModelDynamicsGetPosition(model[i], place[i]);
}

TEST(what_is_not_tested_again_goes_on_as_if_it_were) {
    MeVector3 tested[TOWER + 1], kept[TOWER + 1];
    playTower(METRUE, tested);
    ck_assert_int_gt(called, STILL_STEPS);
    setUp();
    playTower(MEFALSE, kept);
    for (int i = 0; i <= TOWER; i++)
        ck_assert_msg(memcmp(tested[i], kept[i], sizeof kept[i]) == 0, "%d: (%g, %g, %g), and (%g, %g, %g)", i,
                      tested[i][0], tested[i][1], tested[i][2], kept[i][0], kept[i][1], kept[i][2]);
    ck_assert(kept[TOWER - 1][0] != 20); /* it was hit */
}

/* A world whose constraints are all in use: the ball that touches, and does not move, gets its contact once there is
 * room. */
TEST(a_pair_that_found_no_room_is_tested_again) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    sizes.dynamicConstraintsMaxCount = 2; /* a group and its contact */
    universe_begin(&sizes);
    universe_addFloor();
    ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, 1), 1);
    McdModelDynamicsSetPosition(ball, 0, 0, 1); /* touches: nothing pushes it */
    const MdtBSJointID first = MdtBSJointCreate(u->world), second = MdtBSJointCreate(u->world);
    for (int i = 0; i < 3; i++)
        step();
    messages_forget();
    ck_assert_ptr_null(onlyContact());
    MdtBSJointDestroy(first);
    MdtBSJointDestroy(second);
    step();
    ck_assert_ptr_nonnull(onlyContact());
}

/* ---- materials --------------------------------------------------------------------------------------------------- */

TEST(materials_are_numbered_from_the_default_one) {
    ck_assert_uint_eq(MstBridgeGetDefaultMaterial(), 0);
    for (unsigned int i = 1; i < 10; i++)
        ck_assert_uint_eq(MstBridgeGetNewMaterial(u->bridge), i);
    ck_assert_uint_eq(MstBridgeGetNewMaterial(u->bridge), 0);
    assert_warned("materialsMaxCount");
}

TEST(pairs_of_materials_are_unordered) {
    MstMaterialID a = MstBridgeGetNewMaterial(u->bridge), b = MstBridgeGetNewMaterial(u->bridge);
    ck_assert_ptr_eq(MstBridgeGetContactParams(u->bridge, a, b), MstBridgeGetContactParams(u->bridge, b, a));
    ck_assert_ptr_ne(MstBridgeGetContactParams(u->bridge, a, b), MstBridgeGetContactParams(u->bridge, a, a));
    ck_assert_ptr_ne(MstBridgeGetContactParams(u->bridge, a, 0), MstBridgeGetContactParams(u->bridge, b, 0));
    ck_assert_ptr_eq(MstBridgeGetContactParams(u->bridge, 7, 0), MstBridgeGetContactParams(u->bridge, 0, 0));
    assert_warned("no material 7");
}

TEST(a_contact_has_its_materials_parameters) {
    MstMaterialID rubber = MstBridgeGetNewMaterial(u->bridge);
    MdtContactParamsSetRestitution(MstBridgeGetContactParams(u->bridge, rubber, 0), .75);
    McdModelSetMaterial(ball, (int)rubber);
    step();
    assert_near(MdtContactParamsGetRestitution(MdtContactGetParams(onlyContact())), .75, TOL(1e-7, 7e-15));
}

TEST(bad_bridges_are_refused) {
    MstBridgeDestroy(0);
    assert_silent();
    ck_assert_ptr_null(MstBridgeGetContactParams(0, 0, 0));
    assert_warned("no bridge");
    MstBridgeID b = MstBridgeCreate(u->frame, 0);
    assert_warned("maxMaterials");
    ck_assert_uint_eq(MstBridgeGetNewMaterial(b), 0);
    assert_warned("maxMaterials");
    MstBridgeSetContactBufferSize(b, 0);
    assert_warned("0 contacts");
    MstBridgeSetModelPairBufferSize(b, 1);
    assert_warned("1 pairs");
    MstBridgeDestroy(b);
}

/* ---- contacts ---------------------------------------------------------------------------------------------------- */

TEST(a_touch_makes_a_contact_of_its_depth) {
    MeVector3 p, n;
    step();
    MdtContactID c = onlyContact();
    MdtContactGetPosition(c, p);
    MdtContactGetNormal(c, n);
    assert_vec3_near(p, 0, 0, -.005, TOL(1e-6, 9e-15));
    assert_vec3_near(n, 0, 0, 1, TOL(1e-6, 9e-15));
    assert_near(MdtContactGetPenetration(c), .01, TOL(1e-7, 1e-15));
    ck_assert_ptr_eq(MdtContactGetBody(c, 0), McdModelGetBody(ball));
    ck_assert_ptr_null(MdtContactGetBody(c, 1));
    ck_assert(MdtContactGroupIsEnabled(MdtContactGetContactGroup(c)));
}

TEST(a_contact_that_lasts_is_the_same_object) {
    step();
    MdtContactID c = onlyContact();
    for (int i = 0; i < 5; i++)
        step();
    ck_assert_ptr_eq(onlyContact(), c);
}

enum { CORNERS = 4, CROSSINGS = 8 };

typedef struct Seen {
    MdtContactID contact;
    MeU32 feature;
    MeVector3 place;
} Seen;

static int contactsOf(MdtBodyID body, Seen seen[], int max) {
    int count = 0;
    for (MdtContactID c = MdtBodyGetFirstContact(body); c; c = MdtBodyGetNextContact(body, c)) {
        ck_assert_int_lt(count, max);
        seen[count].contact = c;
        seen[count].feature = MdtContactGetFeature(c);
        MdtContactGetPosition(c, seen[count++].place);
    }
    return count;
}

/* Two equal cubes, one on the other. Turned by a hundredth, two edges cross two others where each corner lay before. */
TEST(a_contact_goes_on_as_the_nearest_point_where_its_feature_changes) {
    static MeMatrix4 below = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {9, 0, 5, 1}};
    const McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    const McdModelID box = MstModelAndBodyCreate(u, cube, 1);
    const MeReal half = .005;
    Seen before[CORNERS], after[CROSSINGS];
    int kept = 0, changed = 0;
    MstFixedModelCreate(u, cube, below);
    McdModelDynamicsSetPosition(box, 9, 0, 5.999);
    step();
    ck_assert_int_eq(contactsOf(McdModelGetBody(box), before, CORNERS), CORNERS);
    McdModelDynamicsSetQuaternion(box, MeCos(half), 0, 0, MeSin(half));
    step();
    const int count = contactsOf(McdModelGetBody(box), after, CROSSINGS);
    for (int i = 0; i < CORNERS; i++)
        for (int k = 0; k < count; k++) {
            MeVector3 way;
            MeVector3Subtract(way, after[k].place, before[i].place);
            if (before[i].contact != after[k].contact)
                continue;
            ck_assert(MeVector3Magnitude(way) < (MeReal).02); /* half an edge turns by .005 */
            changed += before[i].feature != after[k].feature;
            kept++;
        }
    ck_assert_int_eq(kept, CORNERS);
    ck_assert_int_gt(changed, 0);
}

TEST(the_group_stays_without_touch_and_goes_at_goodbye) {
    step();
    MdtContactGroupID group = MdtContactGetContactGroup(onlyContact());
    McdModelDynamicsSetPosition(ball, 0, 0, 1.015); /* boxes near, to within the tolerances */
    McdModelSetContactTolerance(ball, .02);
    McdModelSetContactTolerance(floorModel, 0);
    step();
    McdModelSetContactTolerance(ball, .001);
    McdModelDynamicsSetPosition(ball, 0, 0, 1.0005);
    step();
    ck_assert_int_eq(MdtWorldGetTotalConstraints(u->world) > 0, 1);
    ck_assert_ptr_nonnull(group);
    McdModelDynamicsSetPosition(ball, 0, 0, 3);
    step();
    ck_assert_int_eq(MdtWorldGetTotalConstraints(u->world), 0);
}

/* A plane's model comes first in the pair or second: the body is pushed out either way. */
/* All records of the world's constraints are used anew, one of them as another pair's group or a program's own. */
TEST(a_group_that_the_program_destroys_is_not_the_pairs_any_more) {
    const MdtBodyID body = McdModelGetBody(ball);
    step();
    for (int i = 0; i < 2; i++) {
        MdtContactGroupID mine[500];
        int count = 0;
        ck_assert_ptr_nonnull(onlyContact());
        if (i == 0)
            MdtBodyDestroyConstraints(body);
        else
            MdtBodyDestroyContacts(body);
        ck_assert_ptr_null(MdtBodyGetFirstConstraint(body));
        while (count < 500 && (mine[count] = MdtContactGroupCreate(u->world)) != 0)
            count++;
        ck_assert_int_ge(count, 100);
        MdtContactGroupDestroy(mine[0]); /* room for the pair's new one, and its contact */
        MdtContactGroupDestroy(mine[1]);
        step();
        ck_assert_ptr_nonnull(onlyContact());
        for (int k = 2; k < count; k++) {
            ck_assert_int_eq(MdtContactGroupGetCount(mine[k]), 0);
            ck_assert_ptr_null(MdtContactGroupGetGenerator(mine[k]));
            ck_assert_ptr_null(MdtContactGroupGetBody(mine[k], 0));
            MdtContactGroupDestroy(mine[k]);
        }
        ck_assert_int_eq(MdtContactGroupGetCount(MdtContactGetContactGroup(onlyContact())), 1);
    }
}

TEST(only_the_second_model_having_a_body_is_as_good) {
    MstModelAndBodyDestroy(ball);
    MstFixedModelDestroy(floorModel);
    ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, 1), 1);
    McdModelDynamicsSetPosition(ball, 0, 0, .99);
    floorModel = universe_addFloor();
    step();
    MeVector3 n;
    MdtContactGetNormal(onlyContact(), n);
    assert_vec3_near(n, 0, 0, 1, TOL(1e-6, 9e-15));
    ck_assert_ptr_eq(MdtContactGetBody(onlyContact(), 0), McdModelGetBody(ball));
}

/* ---- callbacks --------------------------------------------------------------------------------------------------- */

static void MEAPI cull(McdIntersectResult *result) {
    called++;
    ck_assert(result->pair->model1 == ball || result->pair->model2 == ball);
    if (!answer)
        result->contactCount = 0;
}

TEST(the_intersect_callback_may_cull) {
    MstBridgeSetIntersectCB(u->bridge, 0, 0, cull);
    ck_assert(MstBridgeGetIntersectCB(u->bridge, 0, 0) == cull);
    step();
    ck_assert(called == 1 && onlyContact());
    answer = MEFALSE;
    step();
    ck_assert(called == 2 && !onlyContact());
}

static MeBool MEAPI perContact(McdIntersectResult *result, McdContact *colC, MdtContactID dynC) {
    called++;
    ck_assert(result->contactCount == 1 && colC == result->contacts);
    MdtContactParamsSetRestitution(MdtContactGetParams(dynC), .5);
    return answer;
}

TEST(the_per_contact_callback_may_change_and_delete) {
    MstBridgeSetPerContactCB(u->bridge, 0, 0, perContact);
    ck_assert(MstBridgeGetPerContactCB(u->bridge, 0, 0) == perContact);
    step();
    ck_assert_int_eq(called, 1);
    assert_near(MdtContactParamsGetRestitution(MdtContactGetParams(onlyContact())), .5, TOL(1e-7, 5e-15));
    answer = MEFALSE;
    step();
    ck_assert(!onlyContact());
}

static MeBool MEAPI perPair(McdIntersectResult *result, MdtContactGroupID group) {
    called++;
    ck_assert(MdtContactGroupGetCount(group) == result->contactCount);
    return answer;
}

TEST(the_per_pair_callback_may_delete_all) {
    MstBridgeSetPerPairCB(u->bridge, 0, 0, perPair);
    ck_assert(MstBridgeGetPerPairCB(u->bridge, 0, 0) == perPair);
    step();
    ck_assert(called == 1 && onlyContact());
    answer = MEFALSE;
    step();
    ck_assert(!onlyContact());
    answer = METRUE;
    step();
    ck_assert(onlyContact() && called == 3);
}

/* The guide's own loop, with the transitions' short form. */
TEST(the_loop_may_be_the_programs) {
    McdSpacePairIterator iterator;
    McdSpaceUpdateAll(u->space);
    McdSpaceEndChanges(u->space);
    McdSpacePairIteratorBegin(u->space, &iterator);
    McdModelPairContainerReset(u->bridge->pairs);
    ck_assert(!McdSpaceGetPairs(u->space, &iterator, u->bridge->pairs));
    MstHandleTransitions(u->bridge->pairs);
    MstHandleCollisions(u->bridge->pairs, u->space, u->world, u->bridge);
    McdSpaceBeginChanges(u->space);
    ck_assert(onlyContact());
}
