/* Spaces that look ahead: contacts with a gap, of models that would meet within the time. */
#include "Mcd.h"
#include "karma_test.h"

static McdFrameworkID frame;
static McdSpaceID space;
static McdModelID model[2];
static MeMatrix4 place[2];
static MeVector3 velocity[2];

static void setUp(void) {
    frame = McdInit(0, 2, 0, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    McdFrameworkSetDefaultContactTolerance(frame, 0);
    space = McdSpaceAxisSortCreate(frame, McdAllAxes, 2, 2);
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMMakeIdentity(place[i]);
        MeVector3Set(velocity[i], 0, 0, 0);
        model[i] = McdModelCreate(McdSphereCreate(frame, 1));
        McdModelSetTransformPtr(model[i], place[i]);
        McdModelSetLinearVelocityPtr(model[i], velocity[i]);
        McdSpaceInsertModel(space, model[i]);
    }
}

static void tearDown(void) {
    McdSpaceDestroy(space);
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    McdTerm(frame);
}

/* How many contacts the balls have with a gap between them; -1: they are no pair. */
static int contactsAt(double gap) {
    McdSpacePairIterator iterator;
    McdModelPair *array[8];
    McdModelPairContainer pairs;
    McdContact contact[4];
    McdIntersectResult result;
    MeMatrix4TMSetPosition(place[1], (MeReal)(2 + gap), 0, 0);
    McdSpaceUpdateAll(space);
    if (McdSpaceIsChanging(space))
        McdSpaceEndChanges(space);
    McdModelPairContainerInit(&pairs, array, 8);
    McdSpacePairIteratorBegin(space, &iterator);
    McdSpaceGetPairs(space, &iterator, &pairs);
    if (pairs.helloFirst == pairs.stayingEnd)
        return -1;
    memset(&result, 0, sizeof result);
    result.contacts = contact;
    result.contactMaxCount = 4;
    ck_assert(McdIntersect(pairs.array[pairs.helloFirst], &result));
    if (result.contactCount)
        assert_near(contact[0].separation, gap, TOL(2e-6, 3e-15));
    return result.contactCount;
}

START_TEST(without_it_balls_that_are_apart_have_no_contact) {
    ck_assert(McdSpaceGetLookAhead(space) == 0);
    MeVector3Set(velocity[0], 6, 0, 0);
    ck_assert_int_eq(contactsAt(.05), -1);
}
END_TEST

START_TEST(what_may_meet_within_the_time_has_a_contact) {
    McdSpaceSetLookAhead(space, (MeReal).1);
    MeVector3Set(velocity[0], 6, 0, 0); /* .6 m in that time */
    ck_assert_int_eq(contactsAt(.59), 1);
    ck_assert_int_eq(contactsAt(.61), -1);
}
END_TEST

START_TEST(it_is_the_relative_velocity_that_counts) {
    McdSpaceSetLookAhead(space, (MeReal).1);
    MeVector3Set(velocity[0], 6, 0, 0);
    MeVector3Set(velocity[1], 6, 0, 0);
    ck_assert_int_eq(contactsAt(.1), 0);
    MeVector3Set(velocity[1], -3, 0, 0);
    ck_assert_int_eq(contactsAt(.89), 1);
    ck_assert_int_eq(contactsAt(.91), -1);
}
END_TEST

/* 6 m/s each, across each other: sqrt(2) times as much, though each by itself looks .6 m ahead. */
START_TEST(velocities_across_each_other_count_by_their_difference) {
    McdSpaceSetLookAhead(space, (MeReal).1);
    MeVector3Set(velocity[0], 6, 0, 0);
    MeVector3Set(velocity[1], 0, 6, 0);
    ck_assert_int_eq(contactsAt(.848), 1);
    ck_assert_int_eq(contactsAt(.849), 0);
    MeVector3Set(velocity[1], 0, 0, -2);
    ck_assert_int_eq(contactsAt(.632), 1);
    ck_assert_int_eq(contactsAt(.633), 0);
}
END_TEST

START_TEST(none_looks_farther_than_its_radius) {
    McdSpaceSetLookAhead(space, 1);
    MeVector3Set(velocity[0], 500, 0, 0);
    ck_assert_int_eq(contactsAt(.99), 1);
    ck_assert_int_eq(contactsAt(1.01), -1);
}
END_TEST

START_TEST(a_frozen_model_looks_nowhere) {
    McdSpaceSetLookAhead(space, (MeReal).1);
    MeVector3Set(velocity[0], 6, 0, 0);
    ck_assert_int_eq(contactsAt(.5), 1);
    McdSpaceFreezeModel(model[0]);
    ck_assert_int_eq(contactsAt(.5), -1);
}
END_TEST

START_TEST(bad_times_are_refused) {
    McdSpaceSetLookAhead(space, 2);
    messages_catch();
    McdSpaceSetLookAhead(space, -1);
    assert_warned("duration");
    McdSpaceSetLookAhead(space, (MeReal)NAN);
    assert_warned("duration");
    ck_assert(McdSpaceGetLookAhead(space) == 2);
    McdSpaceSetLookAhead(0, 1);
    assert_warned("no space");
    messages_release();
}
END_TEST

static void tests(TCase *t) {
    tcase_add_checked_fixture(t, setUp, tearDown);
    tcase_add_test(t, without_it_balls_that_are_apart_have_no_contact);
    tcase_add_test(t, what_may_meet_within_the_time_has_a_contact);
    tcase_add_test(t, it_is_the_relative_velocity_that_counts);
    tcase_add_test(t, velocities_across_each_other_count_by_their_difference);
    tcase_add_test(t, none_looks_farther_than_its_radius);
    tcase_add_test(t, a_frozen_model_looks_nowhere);
    tcase_add_test(t, bad_times_are_refused);
}

TEST_MAIN("LookAhead", tests)
