/* Events: begin, persist and end of touches, how hard they were, sensors, filters, broken joints, and what goes between
 * steps. */
#include "universe.h"

#define STEP (1. / 60)

static MeMatrix4 ground, place;
static McdModelID floorModel, ball;
static int calls[4];

static void setUp(void) {
    universe_begin(0);
    MdtWorldSetGravity(u->world, 0, 0, -10);
    MeMatrix4TMMakeIdentity(ground);
    MeMatrix4TMMakeIdentity(place);
    floorModel = MstFixedModelCreate(u, McdPlaneCreate(u->frame), ground);
    ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .5), 1);
    McdModelDynamicsSetPosition(ball, 0, 0, .5);
    memset(calls, 0, sizeof calls);
}

TEST_FIXTURE(setUp, NULL)

static void step(void) {
    MstUniverseStep(u, STEP);
}

static void setRestitution(double e) {
    MdtContactParamsSetRestitution(MstBridgeGetContactParams(u->bridge, 0, 0), e);
}

static int eventCount(void) {
    int count;
    MstUniverseGetEvents(u, &count);
    return count;
}

static const MstEvent *event(int i) {
    int count;
    const MstEvent *events = MstUniverseGetEvents(u, &count);
    ck_assert(i < count);
    return &events[i];
}

/* The only event of the last step. */
static const MstEvent *onlyEvent(MstEventKind kind) {
    ck_assert_int_eq(eventCount(), 1);
    ck_assert_int_eq(event(0)->kind, kind);
    return event(0);
}

static int countOf(MstEventKind kind) {
    int sum = 0;
    for (int i = 0; i < eventCount(); i++)
        sum += event(i)->kind == kind;
    return sum;
}

static void fallAsleep(void) {
    for (int i = 0; i < 600 && McdModelDynamicsIsEnabled(ball); i++)
        step();
    ck_assert(!McdModelDynamicsIsEnabled(ball));
}

/* A zone of 2 x 2 x 2 about a point, which is not frozen. */
static McdModelID makeZone(double x, double y, double z) {
    McdModelID zone = McdModelCreate(McdBoxCreate(u->frame, 2, 2, 2));
    MeMatrix4TMMakeIdentity(place);
    MeVector3Set(place[3], x, y, z);
    McdModelSetTransformPtr(zone, place);
    McdModelSetSensor(zone, METRUE);
    McdModelSetFilter(zone, 2, 1);
    McdModelSetFilter(floorModel, 4, 1);
    McdSpaceInsertModel(u->space, zone);
    McdSpaceUpdateModel(zone);
    return zone;
}

/* ---- touches ----------------------------------------------------------------------------------------------------- */

/* A ball that falls from rest by h meets the ground at sqrt(2 g h), and m (1 + e) of that is the impulse. */
TEST(a_bounce_is_a_begin_with_its_impulse_and_an_end) {
    const double mass = MdtBodyGetMass(McdModelGetBody(ball)), speed = sqrt(2 * 10 * 2.);
    setRestitution(.75);
    McdModelDynamicsSetPosition(ball, 0, 0, 2.5);
    int steps = 0;
    for (; steps < 100 && eventCount() == 0; steps++)
        step();
    ck_assert_int_eq(steps, 38); /* sqrt(2 h / g) = .632 s */
    const MstEvent *begin = onlyEvent(MstEventBegin);
    ck_assert(begin->model1 == ball && begin->model2 == floorModel && !begin->isSensor && !begin->joint);
    assert_near_rel(begin->impulse, 1.75 * mass * speed, TOL(1e-5, 2e-14));
    assert_near_rel(begin->approachSpeed, speed, TOL(1e-5, 2e-14));
    assert_vec3_near(begin->normal, 0, 0, 1, TOL(1e-6, 9e-15));
    assert_near(begin->position[0], 0, TOL(1e-6, 9e-15));
    step(); /* it has 4 mm of gap as this step begins, less than the tolerances */
    ck_assert(onlyEvent(MstEventPersist)->impulse == 0);
    step();
    const MstEvent *end = onlyEvent(MstEventEnd);
    ck_assert(end->model1 == ball && end->impulse == 0);
    step();
    ck_assert_int_eq(eventCount(), 0);
}

TEST(a_resting_ball_carries_its_weight_every_step) {
    const double mass = MdtBodyGetMass(McdModelGetBody(ball)), weight = 10 * mass;
    MdtWorldSetAutoDisable(u->world, 0);
    step();
    onlyEvent(MstEventBegin);
    for (int i = 0; i < 60; i++)
        step();
    for (int i = 0; i < 60; i++) {
        step();
        assert_near(onlyEvent(MstEventPersist)->impulse, weight * STEP,
                    mass * TOL(1e-5, 1e-9)); /* velocities' tolerance */
    }
    McdModelDynamicsSetPosition(ball, 0, 0, 2);
    step();
    onlyEvent(MstEventEnd);
}

TEST(a_touch_survives_sleep) {
    fallAsleep();
    for (int i = 0; i < 60; i++) {
        step();
        ck_assert_int_eq(eventCount(), 0);
    }
    McdModelDynamicsEnable(ball);
    step();
    onlyEvent(MstEventPersist);
    fallAsleep();
    McdModelDynamicsSetPosition(ball, 0, 0, 2);
    step();
    onlyEvent(MstEventEnd);
}

/* Looking ahead makes contacts of balls that pass each other: they do not touch. */
TEST(what_passes_by_does_not_touch) {
    McdModelID other = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .5), 1);
    MdtWorldSetGravity(u->world, 0, 0, 0);
    McdModelDynamicsSetPosition(ball, 0, 0, 5);
    McdModelDynamicsSetPosition(other, -2, 1.05, 5);
    McdModelDynamicsSetLinearVelocity(other, 10, 0, 0);
    for (int i = 0; i < 30; i++) {
        step();
        ck_assert_int_eq(eventCount(), 0);
    }
}

static MeBool MEAPI refuse(McdIntersectResult *result, McdContact *colC, MdtContactID dynC) {
    (void)result, (void)colC, (void)dynC;
    return MEFALSE;
}

TEST(contacts_that_a_callback_takes_away_do_not_count) {
    step();
    onlyEvent(MstEventBegin);
    MstBridgeSetPerContactCB(u->bridge, 0, 0, refuse);
    step();
    onlyEvent(MstEventEnd);
    step();
    ck_assert_int_eq(eventCount(), 0);
}

/* ---- callbacks --------------------------------------------------------------------------------------------------- */

static void MEAPI countCalls(const MstEvent *e) {
    calls[e->kind]++;
}

static void MEAPI destroyBall(const MstEvent *e) {
    if (e->model1 == ball && e->kind == MstEventBegin)
        MstModelAndBodyDestroy(ball);
    calls[e->kind] += e->model1 == 0;
}

TEST(materials_have_their_callbacks) {
    const MstMaterialID wood = MstBridgeGetNewMaterial(u->bridge);
    McdModelSetMaterial(ball, (int)wood);
    ck_assert(!MstBridgeGetTouchCB(u->bridge, wood, 0));
    MstBridgeSetTouchCB(u->bridge, wood, wood, countCalls);
    step();
    ck_assert_int_eq(calls[MstEventBegin], 0);
    MstBridgeSetTouchCB(u->bridge, 0, wood, countCalls);
    ck_assert(MstBridgeGetTouchCB(u->bridge, wood, 0) == countCalls);
    step();
    McdModelDynamicsSetPosition(ball, 0, 0, 2);
    step();
    ck_assert(calls[MstEventBegin] == 0 && calls[MstEventPersist] == 1 && calls[MstEventEnd] == 1);
    ck_assert(event(0)->material1 == wood && event(0)->material2 == 0);
}

TEST(a_callback_may_destroy_what_later_events_are_about) {
    McdModelID other = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .5), 1);
    McdModelDynamicsSetPosition(other, 0, .99, .5);
    MstBridgeSetTouchCB(u->bridge, 0, 0, destroyBall);
    step();
    ck_assert_int_eq(eventCount(), 3); /* ball, floor; other, floor; other, ball */
    ck_assert(!event(0)->model1 && event(0)->model2 == floorModel);
    ck_assert(event(1)->model1 == other && event(2)->model1 == other && !event(2)->model2);
    step();
    ck_assert_int_eq(countOf(MstEventEnd), 2);
}

/* ---- what goes between steps ------------------------------------------------------------------------------------- */

TEST(a_model_that_is_destroyed_ends_its_touches) {
    for (int isAsleep = 0; isAsleep < 2; isAsleep++) {
        step();
        if (isAsleep)
            fallAsleep();
        MstModelAndBodyDestroy(ball);
        step();
        const MstEvent *end = onlyEvent(MstEventEnd);
        ck_assert(!end->model1 && end->model2 == floorModel);
        step();
        ck_assert_int_eq(eventCount(), 0);
        ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .5), 1);
        McdModelDynamicsSetPosition(ball, 0, 0, .5);
    }
    step();
    onlyEvent(MstEventBegin);
    MstFixedModelDestroy(floorModel);
    ck_assert(event(0)->model1 == ball && !event(0)->model2);
    step();
    ck_assert(onlyEvent(MstEventEnd)->model1 == ball);
}

/* The pool gives a new model the record of an old one: the events know the difference. */
TEST(a_new_model_is_not_taken_for_an_old_one) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    sizes.collisionModelsMaxCount = 2;
    universe_begin(&sizes);
    floorModel = MstFixedModelCreate(u, McdPlaneCreate(u->frame), ground);
    ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .5), 1);
    McdModelDynamicsSetPosition(ball, 0, 0, .49);
    step();
    onlyEvent(MstEventBegin);
    MstModelAndBodyDestroy(ball);
    const McdModelID next = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .5), 1);
    ck_assert_ptr_eq(next, ball);
    ck_assert_ptr_null(event(0)->model1);
    McdModelDynamicsSetPosition(next, 5, 0, .49);
    step();
    ck_assert_int_eq(eventCount(), 2);
    ck_assert(event(0)->kind == MstEventEnd && !event(0)->model1);
    ck_assert(event(1)->kind == MstEventBegin && event(1)->model1 == next);
}

TEST(a_model_that_is_taken_out_by_hand_ends_its_touches) {
    step();
    McdSpaceRemoveModel(ball);
    step();
    ck_assert(onlyEvent(MstEventEnd)->model1 == ball);
    McdSpaceInsertModel(u->space, ball);
    step();
    onlyEvent(MstEventBegin);
    McdSpaceRemoveModel(ball);
    McdSpaceEndChanges(u->space); /* the program does not look at the pair that says goodbye */
    McdSpaceBeginChanges(u->space);
    McdModelDestroy(ball);
    step();
    ck_assert_ptr_null(onlyEvent(MstEventEnd)->model1);
}

TEST(all_may_be_destroyed_in_any_order) {
    step();
    McdFrameworkDestroyAllModelsAndGeometries(u->frame);
    MstUniverseStep(u, STEP);
    ck_assert(onlyEvent(MstEventEnd)->model1 == 0);
    floorModel = MstFixedModelCreate(u, McdPlaneCreate(u->frame), ground);
    ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .5), 1);
    step();
    MstBridgeDestroy(u->bridge);
    u->bridge = MstBridgeCreate(u->frame, 1);
    step();
    onlyEvent(MstEventBegin);
}

TEST(the_list_may_be_made_by_hand) {
    for (int i = 0; i < 3; i++) {
        McdSpaceUpdateAll(u->space);
        MstBridgeUpdateContacts(u->bridge, u->space, u->world);
        MdtWorldStep(u->world, STEP);
        if (i == 1) /* a program that does not want them does not ask */
            continue;
        MstBridgeUpdateEvents(u->bridge, u->world);
        onlyEvent(i == 0 ? MstEventBegin : MstEventPersist);
    }
}

enum { DROPPED = 30, ASKED_STEPS = 200 };

/* Balls and boxes that fall onto each other and bounce, one of them through a zone. */
static void makeCrowd(void) {
    const McdGeometryID shape[2] = {McdSphereCreate(u->frame, .5), McdBoxCreate(u->frame, 1, 1, 1)};
    setRestitution(.4);
    makeZone(0, 0, 3);
    for (int i = 0; i < DROPPED; i++) {
        const McdModelID m = MstModelAndBodyCreate(u, shape[i % 2], 1);
        McdModelDynamicsSetPosition(m, .31 * (i % 3), .23 * (i % 2), 2 + 1.1 * i);
    }
}

/* The events of every tenth step, as numbers; whether the others' were asked for must not matter. */
static int playCrowd(MeBool asksAlways, double *told, int max) {
    int count = 0;
    setUp();
    makeCrowd();
    for (int i = 1; i <= ASKED_STEPS; i++) {
        step();
        if (i % 10 == 0)
            for (int k = 0; k < eventCount(); k++) {
                const MstEvent *e = event(k);
                ck_assert_int_le(count + 10, max);
                told[count++] = (double)e->kind;
                told[count++] = (double)e->impulse;
                told[count++] = (double)e->approachSpeed;
                told[count++] = (double)e->isSensor;
                for (int j = 0; j < 3; j++) {
                    told[count++] = (double)e->position[j];
                    told[count++] = (double)e->normal[j];
                }
            }
        else if (asksAlways)
            eventCount();
    }
    return count;
}

TEST(the_list_is_the_same_whether_or_not_earlier_ones_were_asked_for) {
    enum { MAX = 100000 };
    static double always[MAX], sometimes[MAX];
    const int count = playCrowd(METRUE, always, MAX);
    ck_assert_int_gt(count, 1000);
    ck_assert_int_eq(playCrowd(MEFALSE, sometimes, MAX), count);
    for (int i = 0; i < count; i++)
        ck_assert_msg(always[i] == sometimes[i], "number %d: %.17g, and %.17g", i, always[i], sometimes[i]);
}

/* ---- sensors ----------------------------------------------------------------------------------------------------- */

TEST(a_sensor_tells_what_passes_and_does_not_push) {
    MdtWorldSetGravity(u->world, 0, 0, 0);
    McdModelDynamicsSetPosition(ball, -3.05, 0, 5);
    McdModelDynamicsSetLinearVelocity(ball, 6, 0, 0);
    const McdModelID zone = makeZone(0, 0, 5);
    int begin = 0, end = 0;
    for (int i = 1; i <= 60; i++) {
        step();
        if (countOf(MstEventBegin)) {
            ck_assert(event(0)->model1 == zone && event(0)->model2 == ball && event(0)->isSensor);
            assert_near(event(0)->approachSpeed, 6, TOL(1e-5, 6e-14));
            ck_assert(event(0)->impulse == 0);
            begin = i;
        }
        end = countOf(MstEventEnd) ? i : end;
        ck_assert_int_eq(eventCount(), begin && (!end || end == i));
    }
    ck_assert_int_eq(begin, 17); /* x = -1.5 at .2583 s; as a step begins, at 16 / 60 */
    ck_assert_int_eq(end, 47);   /* x = 1.5 at .7583 s */
    MeVector3 v;
    McdModelDynamicsGetLinearVelocity(ball, v);
    assert_vec3_near(v, 6, 0, 0, TOL(1e-6, 6e-14));
}

TEST(a_sensor_sees_what_sleeps_and_what_is_fixed) {
    fallAsleep();
    const McdModelID zone = makeZone(0, 0, .5);
    step();
    ck_assert(onlyEvent(MstEventBegin)->model2 == ball);
    ck_assert(!McdModelDynamicsIsEnabled(ball));
    step();
    onlyEvent(MstEventPersist);
    McdModelSetFilter(zone, 2, 1 | 4);
    McdModelSetFilter(floorModel, 4, 1 | 2);
    step();
    ck_assert_int_eq(eventCount(), 2);
    ck_assert(countOf(MstEventBegin) == 1 && countOf(MstEventPersist) == 1);
    place[3][2] = 7; /* the zone moves away */
    step();
    ck_assert(eventCount() == 2 && countOf(MstEventEnd) == 2);
    ck_assert(!McdModelDynamicsIsEnabled(ball));
}

TEST(a_sensor_keeps_what_falls_asleep_in_it) {
    const McdModelID zone = makeZone(0, 0, .5);
    step();
    ck_assert_int_eq(countOf(MstEventBegin), 2); /* with the floor, and with the zone */
    fallAsleep();
    for (int i = 0; i < 10; i++) {
        step();
        ck_assert(onlyEvent(MstEventPersist)->isSensor);
    }
    McdSpaceFreezeModel(zone);
    for (int i = 0; i < 10; i++) {
        step();
        ck_assert_int_eq(eventCount(), 0);
    }
    McdModelDynamicsSetPosition(ball, 0, 0, 5);
    step();
    ck_assert(eventCount() == 2 && countOf(MstEventEnd) == 2);
}

/* A zone over a floor, with a ball, a lift and a wall in it: each kind by its own. */
TEST(a_sensor_finds_the_kinds_of_its_mask) {
    static const MeVector3 wallPlace = {0, 2, 0};
    const McdModelID zone = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 8, 8, 2), 1);
    const McdModelID lift = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 1, 1, 1), 1);
    MdtBodySetKinematic(McdModelGetBody(zone), METRUE);
    MdtBodySetKinematic(McdModelGetBody(lift), METRUE);
    McdModelDynamicsSetPosition(lift, 3, 0, 1);
    MstFixedModelCreateAt(u, McdBoxCreate(u->frame, 1, 1, 1), wallPlace, 0);
    McdModelSetSensor(zone, METRUE);
    ck_assert(MstSensorGetMask(zone) == MstSensesAll);
    for (MeU32 mask = 0; mask <= MstSensesAll; mask++) {
        const int expected = 2 * !!(mask & MstSensesFixed) + !!(mask & MstSensesDynamic) + !!(mask & MstSensesMoved);
        int found = 0;
        MstSensorSetMask(zone, mask);
        ck_assert(MstSensorGetMask(zone) == mask);
        step();
        step();
        for (int i = 0; i < eventCount(); i++)
            found += event(i)->isSensor && event(i)->kind != MstEventEnd;
        ck_assert_int_eq(found, expected);
    }
    MstSensorSetMask(zone, MstSensesFixed);
    step();
    ck_assert_int_eq(countOf(MstEventEnd), 2);
    MstSensorSetMask(zone, 8);
    assert_warned("MstSensorSetMask");
    assert_none(MstSensorGetMask, NULL);
    assert_refused(MstSensorSetMask, NULL, 1);
}

TEST(sensors_do_not_see_each_other_and_may_become_solid) {
    const McdModelID zone = makeZone(0, 0, 1);
    McdModelSetFilter(zone, 1, 0xffffffffu);
    McdModelSetFilter(floorModel, 1, 0xffffffffu);
    McdModelSetSensor(ball, METRUE);
    step();
    ck_assert_int_eq(countOf(MstEventBegin), 2); /* each with the floor */
    ck_assert_int_eq(eventCount(), 2);
    McdModelSetSensor(zone, MEFALSE);
    McdModelSetSensor(ball, MEFALSE);
    ck_assert(!McdModelIsSensor(ball));
    step();
    ck_assert(countOf(MstEventBegin) == 1 &&
              countOf(MstEventPersist) == 1); /* ball and zone; ball and floor: solid now */
    ck_assert(event(0)->impulse > 0 || event(1)->impulse > 0 || event(2)->impulse > 0);
}

/* ---- filters ----------------------------------------------------------------------------------------------------- */

static int pairsNow(void) {
    McdSpacePairIterator it;
    enum { ROOM = 64 };
    McdModelPairContainer *pairs = McdModelPairContainerCreate(ROOM);
    McdSpaceEndChanges(u->space);
    McdSpacePairIteratorBegin(u->space, &it);
    McdSpaceGetPairs(u->space, &it, pairs);
    const int count = pairs->stayingEnd - pairs->helloFirst;
    MstHandleTransitionsOf(pairs);
    McdSpaceBeginChanges(u->space);
    McdModelPairContainerDestroy(pairs);
    return count;
}

TEST(filters_keep_models_apart) {
    const struct {
        MeU32 categoryA, maskA, categoryB, maskB;
        int groupA, groupB, meets;
    } cases[] = {{1, 0xffffffffu, 1, 0xffffffffu, 0, 0, 1},
                 {1, 2, 2, 1, 0, 0, 1},
                 {1, 2, 2, 4, 0, 0, 0},
                 {1, 4, 2, 1, 0, 0, 0},
                 {3, 4, 12, 2, 0, 0, 1},
                 {1, 0, 1, 1, 0, 0, 0},
                 {1, 1, 1, 1, -7, -7, 0},
                 {1, 0, 1, 0, 7, 7, 1},
                 {1, 1, 1, 1, -7, -8, 1},
                 {1, 1, 1, 1, -7, 0, 1},
                 {1, 0, 1, 0, 7, 8, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        McdModelSetFilter(ball, cases[i].categoryA, cases[i].maskA);
        McdModelSetFilter(floorModel, cases[i].categoryB, cases[i].maskB);
        McdModelSetFilterGroup(ball, cases[i].groupA);
        McdModelSetFilterGroup(floorModel, cases[i].groupB);
        step();
        ck_assert_msg(pairsNow() == cases[i].meets, "case %d", (int)i);
        ck_assert_int_eq(McdSpacePairIsEnabled(ball, floorModel), cases[i].meets);
        ck_assert_uint_eq(McdModelGetFilterCategory(ball), cases[i].categoryA);
        ck_assert_uint_eq(McdModelGetFilterMask(floorModel), cases[i].maskB);
        ck_assert_int_eq(McdModelGetFilterGroup(ball), cases[i].groupA);
    }
}

TEST(a_filter_may_change_while_models_touch) {
    for (int i = 0; i < 2; i++) {
        step();
        onlyEvent(MstEventBegin);
        ck_assert_int_eq(MdtWorldGetTotalConstraints(u->world), 2);
        McdModelSetFilter(ball, 1, 2);
        step();
        onlyEvent(MstEventEnd);
        ck_assert_int_eq(MdtWorldGetTotalConstraints(u->world), 0);
        McdModelSetFilter(ball, 1, 1);
        McdModelDynamicsSetPosition(ball, 0, 0, .49);
        McdModelDynamicsSetLinearVelocity(ball, 0, 0, 0);
    }
}

TEST(what_the_program_disabled_stays_so_when_its_support_goes) {
    step();
    McdModelDynamicsDisable(ball);
    MstFixedModelDestroy(floorModel);
    for (int i = 0; i < 30; i++)
        step();
    ck_assert(!McdModelDynamicsIsEnabled(ball));
}

/* ---- joints that break ------------------------------------------------------------------------------------------- */

TEST(broken_joints_are_in_the_list) {
    MdtBSJointID joint = MdtBSJointCreate(u->world);
    McdModelDynamicsSetPosition(ball, 0, 0, 5);
    MdtBSJointSetBodies(joint, McdModelGetBody(ball), 0);
    MdtBSJointSetPosition(joint, 0, 0, 5);
    MdtBSJointEnable(joint);
    step();
    ck_assert_int_eq(eventCount(), 0);
    MdtConstraintSetBreakLimits(MdtBSJointQuaConstraint(joint), 1, 1);
    step();
    ck_assert_ptr_eq(onlyEvent(MstEventBreak)->joint, MdtBSJointQuaConstraint(joint));
    ck_assert(!MdtBSJointIsEnabled(joint) && !event(0)->model1);
    MdtBSJointDestroy(joint);
    ck_assert_ptr_null(onlyEvent(MstEventBreak)->joint);
    step();
    ck_assert_int_eq(eventCount(), 0);
}

/* ---- order ------------------------------------------------------------------------------------------------------- */

/* Twenty balls in a heap, made in another order but with the same sort keys: the same pairs in the same order. */
static int heapEvents(int seed, int keys[][2], int room) {
    McdModelID balls[20];
    setUp();
    MstModelAndBodyDestroy(ball);
    for (int i = 0; i < 20; i++) {
        const int k = (i * 7 + seed * 3) % 20;
        balls[k] = McdModelCreate(McdSphereCreate(u->frame, .5));
        McdModelSetSortKey(balls[k], (MeI16)(k + 1));
        MdtBodyID b = MdtBodyCreate(u->world);
        MdtBodySetSortKey(b, k + 1);
        McdModelSetBody(balls[k], b);
        MdtBodySetPosition(b, (MeReal)(k % 4) * (MeReal).9, (MeReal)(k / 4 % 2) * (MeReal).9,
                           (MeReal).5 + (MeReal)(k / 8) * (MeReal).9);
        MdtBodyEnable(b);
        McdSpaceInsertModel(u->space, balls[k]);
    }
    step();
    const int count = eventCount();
    ck_assert(count < room);
    for (int i = 0; i < count; i++) {
        keys[i][0] = event(i)->model1 ? McdModelGetSortKey(event(i)->model1) : -1;
        keys[i][1] = McdModelGetSortKey(event(i)->model2);
    }
    return count;
}

TEST(the_order_is_that_of_sort_keys_whatever_was_made_first) {
    static int first[200][2], other[200][2];
    const int count = heapEvents(0, first, 200);
    ck_assert_int_gt(count, 30);
    for (int i = 1; i < count; i++)
        ck_assert(first[i][1] > first[i - 1][1] || (first[i][1] == first[i - 1][1] && first[i][0] > first[i - 1][0]));
    for (int seed = 1; seed < 5; seed++) {
        ck_assert_int_eq(heapEvents(seed, other, 200), count);
        ck_assert(memcmp(first, other, (size_t)count * sizeof *first) == 0);
    }
}

TEST(bad_arguments_warn) {
    int count = 7;
    ck_assert(!MstBridgeGetEvents(0, &count) && count == 0);
    assert_warned("no bridge");
    ck_assert_ptr_null(MstUniverseGetEvents(0, 0));
    assert_warned("MstUniverseGetEvents: null is no universe");
    MstBridgeUpdateEvents(0, u->world);
    assert_warned("no bridge");
    MstBridgeSetTouchCB(0, 0, 0, countCalls);
    assert_warned("no bridge");
    McdModelSetSensor(0, 1);
    assert_warned("no model");
    McdModelSetFilter(0, 1, 1);
    assert_warned("no model");
    ck_assert(McdModelGetFilterMask(0) == 0);
    assert_warned("no model");
    ck_assert(McdModelGetSerial(0) == 0);
}

/* Breaks stand behind touches in the list: the joint of the second event is the world's first broken one. */
TEST(a_break_and_a_touch_in_one_step) {
    McdModelID other = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .5), 1);
    MdtBSJointID joint[2];
    McdModelDynamicsSetPosition(other, 9, 0, 5);
    for (int i = 0; i < 2; i++) {
        joint[i] = MdtBSJointCreate(u->world);
        MdtBSJointSetBodies(joint[i], McdModelGetBody(other), 0);
        MdtBSJointSetPosition(joint[i], 9, i - .5, 5);
        MdtBSJointEnable(joint[i]);
        MdtConstraintSetBreakLimits(MdtBSJointQuaConstraint(joint[i]), .1, .1);
    }
    McdModelDynamicsSetPosition(ball, 0, 0, .495);
    step();
    ck_assert_int_eq(eventCount(), 3);
    ck_assert_int_eq(event(0)->kind, MstEventBegin);
    ck_assert(event(0)->model1 == ball || event(0)->model2 == ball);
    for (int i = 0; i < 2; i++) {
        ck_assert_int_eq(event(1 + i)->kind, MstEventBreak);
        ck_assert_ptr_eq(event(1 + i)->joint, MdtBSJointQuaConstraint(joint[i]));
    }
    MdtBSJointDestroy(joint[0]);
    ck_assert(!event(1)->joint && event(2)->joint == MdtBSJointQuaConstraint(joint[1]));
}

/* The ball is in the zone as each step begins, and hits a wall or two within: the zone tells it once a step, and does
 * not push. */
TEST(a_sensor_in_a_divided_step) {
    static MeMatrix4 at[2];
    MeVector3 v;
    int begins = 0, persists = 0, ends = 0;
    MdtWorldSetGravity(u->world, 0, 0, 0);
    setRestitution(1);
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMMakeIdentity(at[i]);
        MeVector3Set(at[i][3], i ? 2.01 : -2.01, 0, 5);
        MstFixedModelCreate(u, McdBoxCreate(u->frame, .02, 4, 4), at[i]);
    }
    const McdModelID zone = makeZone(0, 0, 5);
    McdModelDynamicsSetPosition(ball, 0, 0, 5);
    McdModelSetSwept(ball, METRUE);
    McdModelDynamicsSetLinearVelocity(ball, 240, 0, 0); /* 4 m a step, between walls 3 m apart for its centre */
    for (int i = 0; i < 30; i++) {
        step();
        int told = 0;
        for (int k = 0; k < eventCount(); k++) {
            if (event(k)->model1 != zone && event(k)->model2 != zone)
                continue;
            ck_assert(event(k)->isSensor && event(k)->impulse == 0);
            begins += event(k)->kind == MstEventBegin;
            persists += event(k)->kind == MstEventPersist;
            ends += event(k)->kind == MstEventEnd;
            told++;
        }
        ck_assert_int_le(told, 1);
        McdModelDynamicsGetLinearVelocity(ball, v);
        assert_near(fabs(v[0]), 240, TOL(1e-3, 1e-9));
    }
    ck_assert_int_eq(begins, 1); /* 3 m between the walls, and the zone with the ball is as wide */
    ck_assert_int_eq(persists, 29);
    ck_assert_int_eq(ends, 0);
}
