/* Spaces that look ahead: contacts with a gap, of models that would meet within the time, and those of a ball where its
 * way leads over triangles. */
#include "Mcd.h"
#include "karma_test.h"

static McdFrameworkID frame;
static McdSpaceID space;
static McdModelID model[2];
static MeMatrix4 place[2];
static MeVector3 velocity[2];

static void setUp(void) {
    frame = McdInit(0, 4, 0, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    McdFrameworkSetDefaultContactTolerance(frame, 0);
    space = McdSpaceAxisSortCreate(frame, McdAllAxes, 4, 4);
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
TEST_FIXTURE(setUp, tearDown)

/* How many contacts the balls have with a gap between them; -1: they are no pair. */
static int contactsAt(double gap) {
    McdSpacePairIterator iterator;
    McdModelPair *array[8];
    McdModelPairContainer pairs;
    McdContact contact[4];
    McdIntersectResult result;
    MeMatrix4TMSetPosition(place[1], 2 + gap, 0, 0);
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

TEST(without_it_balls_that_are_apart_have_no_contact) {
    ck_assert(McdSpaceGetLookAhead(space) == 0);
    MeVector3Set(velocity[0], 6, 0, 0);
    ck_assert_int_eq(contactsAt(.05), -1);
}

TEST(what_may_meet_within_the_time_has_a_contact) {
    McdSpaceSetLookAhead(space, .1);
    MeVector3Set(velocity[0], 6, 0, 0); /* .6 m in that time */
    ck_assert_int_eq(contactsAt(.59), 1);
    ck_assert_int_eq(contactsAt(.61), -1);
}

TEST(it_is_the_relative_velocity_that_counts) {
    McdSpaceSetLookAhead(space, .1);
    MeVector3Set(velocity[0], 6, 0, 0);
    MeVector3Set(velocity[1], 6, 0, 0);
    ck_assert_int_eq(contactsAt(.1), 0);
    MeVector3Set(velocity[1], -3, 0, 0);
    ck_assert_int_eq(contactsAt(.89), 1);
    ck_assert_int_eq(contactsAt(.91), -1);
}

/* 6 m/s each, across each other: sqrt(2) times as much, though each by itself looks .6 m ahead. */
TEST(velocities_across_each_other_count_by_their_difference) {
    McdSpaceSetLookAhead(space, .1);
    MeVector3Set(velocity[0], 6, 0, 0);
    MeVector3Set(velocity[1], 0, 6, 0);
    ck_assert_int_eq(contactsAt(.848), 1);
    ck_assert_int_eq(contactsAt(.849), 0);
    MeVector3Set(velocity[1], 0, 0, -2);
    ck_assert_int_eq(contactsAt(.632), 1);
    ck_assert_int_eq(contactsAt(.633), 0);
}

TEST(none_looks_farther_than_its_radius) {
    McdSpaceSetLookAhead(space, 1);
    MeVector3Set(velocity[0], 500, 0, 0);
    ck_assert_int_eq(contactsAt(.99), 1);
    ck_assert_int_eq(contactsAt(1.01), -1);
}

TEST(a_frozen_model_looks_nowhere) {
    McdSpaceSetLookAhead(space, .1);
    MeVector3Set(velocity[0], 6, 0, 0);
    ck_assert_int_eq(contactsAt(.5), 1);
    McdSpaceFreezeModel(model[0]);
    ck_assert_int_eq(contactsAt(.5), -1);
}

TEST(bad_times_are_refused) {
    McdSpaceSetLookAhead(space, 2);
    McdSpaceSetLookAhead(space, -1);
    assert_warned("duration");
    McdSpaceSetLookAhead(space, NAN);
    assert_warned("duration");
    ck_assert(McdSpaceGetLookAhead(space) == 2);
    McdSpaceSetLookAhead(0, 1);
    assert_warned("no space");
}

/* ---- a ball that rolls over triangles ---------------------------------------------------------------------------- */

/* A ball of .4 m lies on a level cell, .05 m before the edge to a cell that rises by `rise`, and moves along x with the
 * speed. Returns its contacts, with normals upward. */
static int contactsBeforeEdge(double rise, double speed, McdContact contact[8]) {
    static MeReal heights[6];
    static MeMatrix4 at, ground;
    static MeVector3 v;
    McdSpacePairIterator iterator;
    McdModelPair *array[8];
    McdModelPairContainer pairs;
    McdIntersectResult result;
    for (int i = 0; i < 6; i++)
        heights[i] = i % 3 == 2 ? (MeReal)rise : 0;
    MeMatrix4TMMakeIdentity(ground);
    MeMatrix4TMMakeIdentity(at);
    MeMatrix4TMSetPosition(at, .95, .5, .4);
    MeVector3Set(v, speed, 0, 0);
    for (int i = 0; i < 2; i++)
        McdSpaceRemoveModel(model[i]);
    const McdModelID ball = McdModelCreate(McdSphereCreate(frame, .4));
    const McdModelID field = McdModelCreate(McdRGHeightFieldCreate(frame, heights, 3, 2, 1, 1, 0, 0));
    McdModelSetTransformPtr(ball, at);
    McdModelSetTransformPtr(field, ground);
    McdModelSetLinearVelocityPtr(ball, v);
    McdSpaceSetLookAhead(space, .1);
    McdSpaceInsertModel(space, ball);
    McdSpaceInsertModel(space, field);
    McdSpaceUpdateAll(space);
    McdModelPairContainerInit(&pairs, array, 8);
    McdSpacePairIteratorBegin(space, &iterator);
    McdSpaceGetPairs(space, &iterator, &pairs);
    ck_assert(pairs.helloFirst != pairs.stayingEnd);
    memset(&result, 0, sizeof result);
    result.contacts = contact;
    result.contactMaxCount = 8;
    ck_assert(McdIntersect(pairs.array[pairs.helloFirst], &result));
    for (int i = 0; i < result.contactCount; i++) /* as the ball is pushed: either may be the pair's first model */
        MeVector3MultiplyScalar(contact[i].normal, contact[i].normal, contact[i].normal[2] < 0 ? -1 : 1);
    return result.contactCount;
}

TEST(a_ball_has_a_contact_with_the_rise_that_it_comes_to) {
    const double rise = .1, up = 1 / hypot(1, rise);
    McdContact contact[8];
    ck_assert_int_eq(contactsBeforeEdge(rise, 2, contact), 2);
    const McdContact *ahead = contact[0].normal[0] < 0 ? &contact[0] : &contact[1];
    const McdContact *level = ahead == contact ? &contact[1] : &contact[0];
    assert_near(level->separation, 0, TOL(1e-6, 1e-14));
    assert_near(level->normal[2], 1, TOL(1e-6, 1e-14));
    assert_near(ahead->separation, (.05 * rise + .4) * up - .4, TOL(1e-6, 1e-14));
    assert_near(ahead->normal[0], -rise * up, TOL(1e-6, 1e-14));
}

TEST(a_ball_that_does_not_come_to_the_rise_has_none) {
    McdContact contact[8];
    ck_assert_int_eq(contactsBeforeEdge(.1, -2, contact), 1);
    assert_near(contact[0].normal[2], 1, TOL(1e-6, 1e-14));
}

TEST(a_ball_before_a_rise_that_is_farther_than_its_way_has_none) {
    McdContact contact[8];
    ck_assert_int_eq(contactsBeforeEdge(.1, .2, contact), 1);
    assert_near(contact[0].normal[2], 1, TOL(1e-6, 1e-14));
}

/* Moved across the normal, by the way's length along the level, it touches the slope. */
TEST(a_balls_normal_is_that_of_the_chord_where_the_surface_falls) {
    const double fall = .1, up = 1 / hypot(1, fall), speed = 2, way = .1 * speed;
    McdContact contact[8];
    ck_assert_int_eq(contactsBeforeEdge(-fall, speed, contact), 1);
    const double drop = ((way - .05) * fall + .4) * up - .4; /* of the slope's plane below the ball at the way's end */
    const double chord[2] = {way - drop * fall * up, -drop * up}, length = hypot(chord[0], chord[1]);
    assert_near(contact[0].separation, 0, TOL(1e-6, 1e-14));
    assert_near(contact[0].normal[0], -chord[1] / length, TOL(1e-6, 1e-14));
    assert_near(contact[0].normal[2], chord[0] / length, TOL(1e-6, 1e-14));
}
