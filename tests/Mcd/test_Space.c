/* The rules of spaces, one by one (User Guide ch. 4). */
#include "crates.h"

static Yard yard, *const y = &yard;

static void tearDown(void) {
    if (y->frame)
        yardDestroy(y);
}
TEST_FIXTURE(NULL, tearDown)

TEST(starts_inside_a_block) {
    yardMake(y);
    ck_assert_int_ne(McdSpaceIsChanging(y->space), 0);
    McdSpaceEndChanges(y->space);
    ck_assert_int_eq(McdSpaceIsChanging(y->space), 0);
    McdSpaceBeginChanges(y->space);
    ck_assert_int_ne(McdSpaceIsChanging(y->space), 0);
}

TEST(pairs_say_hello_stay_and_say_goodbye) {
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0), b = yardPut(y, 1, .9, 0, 0);
    yardStep(y);
    assert_pairs(y, 1, 0, 0);
    McdModelPair *pair = y->pairs->array[y->pairs->helloFirst];
    ck_assert_ptr_eq(pair->model1, b);
    ck_assert_ptr_eq(pair->model2, a);
    ck_assert_int_eq(pair->phase, kMcdFFStateHello);
    pair->userData = y;
    for (int i = 0; i < 3; i++) {
        McdSpaceBeginChanges(y->space);
        yardMove(y, 1, (MeReal).9 + (MeReal)i / 100, 0, 0);
        yardStep(y);
        assert_pairs(y, 0, 1, 0);
        ck_assert_ptr_eq(y->pairs->array[y->pairs->stayingFirst], pair);
        ck_assert_int_eq(pair->phase, kMcdFFStateStaying);
        ck_assert_ptr_eq(pair->userData, y);
    }
    McdSpaceBeginChanges(y->space);
    yardMove(y, 1, 2, 0, 0);
    yardStep(y);
    assert_pairs(y, 0, 0, 1);
    ck_assert_ptr_eq(y->pairs->array[0], pair);
    ck_assert_int_eq(pair->phase, kMcdFFStateGoodbye);
    ck_assert_ptr_eq(pair->model1, b);
    McdSpaceBeginChanges(y->space);
    assert_step(y, 0, 0, 0);
    yardMove(y, 1, 0, 0, 0);
    yardStep(y);
    assert_pairs(y, 1, 0, 0);
    ck_assert_ptr_null(y->pairs->array[y->pairs->helloFirst]->userData);
}

TEST(boxes_are_exact_and_grown_by_tolerances) {
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0), b = yardPut(y, 1, 1.0625, 0, 0);
    assert_step(y, 0, 0, 0); /* their fat boxes overlap */
    McdModelSetContactTolerance(a, .03125);
    McdModelSetContactTolerance(b, .03125);
    assert_step(y, 0, 0, 0); /* not updated */
    McdSpaceUpdateModel(a);
    McdSpaceUpdateModel(b);
    assert_step(y, 1, 0, 0); /* just touching */
    McdModelSetContactTolerance(a, 0);
    McdSpaceUpdateModel(a);
    assert_step(y, 0, 0, 1);
}

TEST(only_the_axes_that_were_asked_for_are_tested) {
    const int axes[3] = {McdXAxis, McdYAxis | McdZAxis, McdZAxis};
    static const int expected[3] = {0, 1, 1};
    for (int i = 0; i < 3; i++) {
        yardMakeWith(y, axes[i], 10, 10);
        yardPut(y, 1, 0, 0, 0);
        yardPut(y, 1, 500, 0, 0);
        assert_step(y, expected[i], 0, 0);
        yardMove(y, 1, 501, 0, 0);
        assert_step(y, 0, expected[i], 0);
        yardMove(y, 1, 501, 0, 3);
        assert_step(y, 0, 0, expected[i]);
        yardDestroy(y);
    }
}

TEST(insertion_does_not_update) {
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0), b = yardCrate(y, 1, 0, 0, 0), c = yardCrate(y, 1, 0, 0, 0);
    McdModelUpdate(c);
    ck_assert(McdSpaceInsertModel(y->space, b));
    ck_assert(McdSpaceInsertModel(y->space, c));
    ck_assert_ptr_eq(McdModelGetSpace(c), y->space);
    ck_assert_int_eq(McdSpaceGetModelCount(y->space), 3);
    assert_step(y, 1, 0, 0); /* a and c: b has no box yet */
    McdSpaceUpdateModel(b);
    assert_step(y, 2, 1, 0);
    ck_assert(!McdSpaceInsertModel(y->space, a));
    assert_warned("already");
}

TEST(what_is_not_updated_keeps_its_box) {
    yardMake(y);
    yardPut(y, 1, 0, 0, 0);
    yardPut(y, 1, 0, 0, 0);
    assert_step(y, 1, 0, 0);
    MeMatrix4TMSetPosition(y->tm[1], 5, 0, 0);
    assert_step(y, 0, 1, 0);
    McdSpaceUpdateAll(y->space);
    assert_step(y, 0, 0, 1);
}

TEST(removal_says_goodbye) {
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0);
    yardPut(y, 1, 0, 0, 0);
    yardPut(y, 1, 0, 0, 0);
    assert_step(y, 3, 0, 0);
    ck_assert(McdSpaceRemoveModel(a));
    ck_assert_ptr_null(McdModelGetSpace(a));
    assert_step(y, 0, 1, 2);
    assert_step(y, 0, 1, 0);
    ck_assert(McdSpaceInsertModel(y->space, a));
    assert_step(y, 2, 1, 0);
    ck_assert(McdSpaceRemoveModel(a)); /* out and in again in one block: its old pairs go, and new ones come */
    ck_assert(McdSpaceInsertModel(y->space, a));
    assert_step(y, 2, 1, 2);
    assert_step(y, 0, 3, 0);
    ck_assert(McdSpaceRemoveModel(a));
    assert_none(McdSpaceRemoveModel, a);
}

TEST(pairs_of_frozen_models_are_not_reported) {
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0), b = yardPut(y, 1, 0, 0, 0);
    yardPut(y, 1, 0, 0, 0);
    ck_assert(!McdSpaceModelIsFrozen(a));
    assert_step(y, 3, 0, 0);
    ck_assert(McdSpaceFreezeModel(a));
    ck_assert(McdSpaceModelIsFrozen(a) && McdSpaceIsFrozen(a));
    assert_step(y, 0, 3, 0);
    ck_assert(McdSpaceFreezeModel(b));
    assert_step(y, 0, 2, 0);
    assert_step(y, 0, 2, 0);
    ck_assert(McdSpaceUnfreezeModel(a));
    assert_step(y, 0, 3, 0);
}

/* Two crates that overlap, their pair with a program's data, both frozen for a step. Inside a block. */
static McdModelPair *asleep(void *data) {
    yardMake(y);
    yardPut(y, 1, 0, 0, 0);
    yardPut(y, 1, .5, 0, 0);
    yardStep(y);
    assert_pairs(y, 1, 0, 0);
    McdModelPair *pair = y->pairs->array[y->pairs->helloFirst];
    pair->userData = data;
    McdSpaceFreezeModel(y->model[0]);
    McdSpaceFreezeModel(y->model[1]);
    McdSpaceBeginChanges(y->space);
    assert_step(y, 0, 0, 0);
    ck_assert_ptr_eq(pair->userData, data);
    ck_assert_int_eq(pair->phase, kMcdFFStateStaying);
    return pair;
}

/* The step has that pair, of that phase, and no other. */
static void assertOnly(const McdModelPair *pair, McdModelPairPhase phase) {
    const int isStaying = phase == kMcdFFStateStaying;
    yardStep(y);
    assert_pairs(y, 0, isStaying, !isStaying);
    ck_assert_ptr_eq(y->pairs->array[isStaying ? y->pairs->stayingFirst : y->pairs->goodbyeFirst], pair);
    ck_assert_int_eq(pair->phase, phase);
    McdSpaceBeginChanges(y->space);
}

TEST(pairs_of_frozen_models_stay) {
    int data;
    McdModelPair *pair = asleep(&data);
    for (int i = 0; i < 4; i++) { /* either one, and again */
        McdSpaceUnfreezeModel(y->model[i & 1]);
        assertOnly(pair, kMcdFFStateStaying);
        ck_assert_ptr_eq(pair->userData, &data);
        McdSpaceFreezeModel(y->model[i & 1]);
        assert_step(y, 0, 0, 0);
    }
    McdSpaceUnfreezeModel(y->model[0]); /* and back, within a block */
    McdSpaceFreezeModel(y->model[0]);
    assert_step(y, 0, 0, 0);
}

TEST(pairs_of_frozen_models_say_goodbye_when_they_moved) {
    McdModelPair *pair = asleep(0);
    MeMatrix4TMSetPosition(y->tm[1], 5, 0, 0);
    McdSpaceUpdateAll(y->space);
    assert_step(y, 0, 0, 0); /* its box is as it was */
    McdSpaceUnfreezeModel(y->model[1]);
    McdSpaceUpdateAll(y->space);
    assertOnly(pair, kMcdFFStateGoodbye);
    assert_step(y, 0, 0, 0);
    yardMove(y, 1, 0, 0, 0);
    assert_step(y, 1, 0, 0);
    yardMove(y, 1, 5, 0, 0); /* away and frozen in one block */
    McdSpaceFreezeModel(y->model[1]);
    assert_step(y, 0, 0, 1);
}

TEST(pairs_of_frozen_models_say_goodbye_when_they_are_cut) {
    McdModelPair *pair = asleep(0);
    ck_assert(McdSpaceRemoveModel(y->model[0]));
    assertOnly(pair, kMcdFFStateGoodbye);
    assert_step(y, 0, 0, 0);
    yardDestroy(y);

    pair = asleep(0); /* removed and put in again */
    ck_assert(McdSpaceRemoveModel(y->model[0]) && McdSpaceInsertModel(y->space, y->model[0]));
    yardStep(y);
    assert_pairs(y, 1, 0, 1);
    ck_assert_ptr_eq(y->pairs->array[y->pairs->goodbyeFirst], pair);
    ck_assert_ptr_ne(y->pairs->array[y->pairs->helloFirst], pair);
    yardDestroy(y);

    pair = asleep(0);
    ck_assert(McdSpaceDisablePair(y->model[0], y->model[1]));
    assertOnly(pair, kMcdFFStateGoodbye);
    ck_assert(McdSpaceEnablePair(y->model[0], y->model[1]));
    assert_step(y, 0, 0, 0);
    McdSpaceUnfreezeModel(y->model[0]);
    assert_step(y, 1, 0, 0);
    yardDestroy(y);

    pair = asleep(0);
    McdCullingTable *table = McdCullingTableCreate(1);
    McdCullingTableSet(table, 0, 0, 1);
    for (int i = 0; i < 2; i++)
        McdSpaceSetModelCullingParameters(y->space, y->model[i], table, 0, 0);
    assertOnly(pair, kMcdFFStateGoodbye);
    yardDestroy(y);
    McdCullingTableDestroy(table);
}

TEST(models_that_were_frozen_when_they_met_say_hello_when_one_is_unfrozen) {
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0), b = yardPut(y, 1, 0, 0, 0);
    McdSpaceFreezeModel(a);
    McdSpaceFreezeModel(b);
    assert_step(y, 0, 0, 0);
    McdSpaceUnfreezeModel(b);
    assert_step(y, 1, 0, 0);
}

/* The framework erases the pairs of its models, silent ones as well; their memory serves the next ones. */
TEST(pairs_of_frozen_models_go_with_their_models) {
    for (int isRemoved = 0; isRemoved < 2; isRemoved++) {
        McdModelPair *pair = asleep(0);
        if (isRemoved) /* it said goodbye in this block already */
            McdSpaceRemoveModel(y->model[0]);
        McdFrameworkDestroyAllModelsAndGeometries(y->frame);
        y->count = 0;
        yardPut(y, 1, 0, 0, 0);
        yardPut(y, 1, 0, 0, 0);
        yardStep(y);
        assert_pairs(y, 1, 0, 0);
        ck_assert_ptr_eq(y->pairs->array[y->pairs->helloFirst], pair);
        yardDestroy(y);
    }
}

/* Silent pairs need their place: with room for one, another pair waits until it says goodbye. */
TEST(pairs_of_frozen_models_keep_their_place) {
    yardMakeWith(y, McdAllAxes, 10, 1);
    const McdModelID a = yardPut(y, 1, 0, 0, 0), b = yardPut(y, 1, 0, 0, 0);
    assert_step(y, 1, 0, 0);
    McdSpaceFreezeModel(a);
    McdSpaceFreezeModel(b);
    assert_step(y, 0, 0, 0);
    yardPut(y, 1, 9, 0, 0);
    yardPut(y, 1, 9, 0, 0);
    assert_step(y, 0, 0, 0);
    assert_warned("pairCount");
    McdSpaceRemoveModel(a);
    assert_step(y, 1, 0, 1);
}

TEST(frozen_models_keep_their_boxes) {
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0);
    yardPut(y, 1, 0, 0, 0);
    McdSpaceFreezeModel(a);
    MeMatrix4TMSetPosition(y->tm[0], 9, 0, 0);
    McdSpaceUpdateAll(y->space);
    assert_step(y, 1, 0, 0);
    McdSpaceUpdateModel(a);
    assert_warned("frozen");
    McdSpaceUnfreezeModel(a);
    McdSpaceUpdateModel(a);
    assert_step(y, 0, 0, 1);
    McdSpaceEndChanges(y->space); /* freezing is legal outside, and counts from the next block on */
    ck_assert(McdSpaceFreezeModel(a) && McdSpaceUnfreezeModel(a));
    McdSpaceBeginChanges(y->space);
}

static int updated[CRATES];

static void MEAPI countUpdate(McdModelID m, MeReal duration) {
    int i = 0;
    (void)duration;
    while (y->model[i] != m)
        i++;
    updated[i]++;
    McdModelUpdate(m);
    McdSpaceFreezeModel(m); /* a callback may do that */
    if (updated[i] != 3)
        McdSpaceUnfreezeModel(m);
}

/* Models are updated as often as they are not frozen, whatever is frozen, removed and put in before. */
TEST(frozen_models_are_not_updated) {
    enum { COUNT = 7 };
    static const int freeze[] = {3, 0, 6, 5, 4, 2, 1};
    yardMake(y);
    for (int i = 0; i < COUNT; i++)
        yardPut(y, 1, (MeReal)(3 * i), 0, 0);
    McdSpaceEndChanges(y->space);
    McdSpaceSetAABBFn(y->space, countUpdate);
    memset(updated, 0, sizeof updated);
    for (int n = 0; n < COUNT; n++) {
        int expected[COUNT];
        for (int i = 0; i < COUNT; i++)
            expected[i] = updated[i] + !McdSpaceModelIsFrozen(y->model[i]);
        McdSpaceUpdateAll(y->space);
        for (int i = 0; i < COUNT; i++)
            ck_assert_int_eq(updated[i], expected[i]);
        McdSpaceBeginChanges(y->space);
        if (n % 2)
            ck_assert(McdSpaceRemoveModel(y->model[freeze[n]]) && McdSpaceInsertModel(y->space, y->model[freeze[n]]));
        ck_assert(McdSpaceFreezeModel(y->model[freeze[n]]));
        ck_assert(n % 3 || McdSpaceUnfreezeModel(y->model[freeze[n / 2]]));
        McdSpaceEndChanges(y->space);
    }
    for (int i = 0; i < COUNT; i++)
        McdSpaceFreezeModel(y->model[i]);
    const int before = updated[0];
    McdSpaceUpdateAll(y->space);
    ck_assert_int_eq(updated[0], before);
    for (int i = 0; i < COUNT; i++) {
        updated[i] = 10;
        McdSpaceUnfreezeModel(y->model[i]);
    }
    McdSpaceUpdateAll(y->space);
    for (int i = 0; i < COUNT; i++)
        ck_assert_int_eq(updated[i], 11);
}

TEST(disabled_pairs_say_goodbye_and_come_back) {
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0), b = yardPut(y, 1, 0, 0, 0), c = yardPut(y, 1, 50, 0, 0);
    assert_step(y, 1, 0, 0);
    ck_assert(McdSpacePairIsEnabled(a, b));
    ck_assert(McdSpaceDisablePair(b, a));
    ck_assert(!McdSpacePairIsEnabled(a, b));
    assert_step(y, 0, 0, 1);
    yardMove(y, 1, 30, 0, 0);
    assert_step(y, 0, 0, 0);
    yardMove(y, 1, 0, 0, 0);
    assert_step(y, 0, 0, 0);
    ck_assert(McdSpaceEnablePair(a, b));
    assert_step(y, 1, 0, 0);
    ck_assert(McdSpaceDisablePair(a, c)); /* before they meet */
    yardMove(y, 2, 0, 0, 0);
    assert_step(y, 1, 1, 0);
    ck_assert(McdSpaceRemoveModel(c) && McdSpaceInsertModel(y->space, c)); /* forgotten */
    ck_assert(McdSpacePairIsEnabled(a, c));
    assert_step(y, 2, 1, 1);
}

TEST(culling_tables_disable) {
    yardMake(y);
    McdCullingTable *table = McdCullingTableCreate(3), *other = McdCullingTableCreate(3);
    McdCullingTableSet(table, 2, 1, 1);
    McdCullingTableSet(other, 2, 1, 1);
    const McdModelID a = yardCrate(y, 1, 0, 0, 0), b = yardCrate(y, 1, 0, 0, 0);
    ck_assert(McdSpaceInsertModelWithCulling(y->space, a, table, 1, 7));
    ck_assert(McdSpaceInsertModelWithCulling(y->space, b, table, 2, 7));
    McdSpaceUpdateAll(y->space);
    assert_step(y, 0, 0, 0);
    ck_assert(!McdSpacePairIsEnabled(a, b));
    McdSpaceSetModelCullingParameters(y->space, b, table, 2, 8); /* another ID */
    assert_step(y, 1, 0, 0);
    McdSpaceSetModelCullingParameters(y->space, b, table, 2, 7);
    assert_step(y, 0, 0, 1);
    McdSpaceSetModelCullingParameters(y->space, b, other, 2, 7); /* another table */
    assert_step(y, 1, 0, 0);
    McdSpaceSetModelCullingParameters(y->space, b, table, 0, 7); /* a flag that is not set */
    assert_step(y, 0, 1, 0);
    McdSpaceSetModelCullingParameters(y->space, b, table, 2, 7);
    assert_step(y, 0, 0, 1);
    McdSpaceSetModelCullingParameters(y->space, b, 0, 0, 0); /* none */
    assert_step(y, 1, 0, 0);
    assert_silent();
    McdSpaceSetModelCullingParameters(y->space, b, table, 3, 7);
    assert_warned("cullingIndex");
    yardDestroy(y);
    McdCullingTableDestroy(table);
    McdCullingTableDestroy(other);
}

static int refused;
static void MEAPI countRefused(McdModelID a, McdModelID b) {
    ck_assert_ptr_ne(a, b);
    refused++;
}

TEST(pairs_without_room_come_when_there_is_some) {
    yardMakeWith(y, McdAllAxes, 10, 4);
    refused = 0;
    McdSpaceSetPoolFullHandler(y->space, countRefused);
    ck_assert_ptr_eq((void *)McdSpaceGetPoolFullHandler(y->space), (void *)countRefused);
    for (int i = 0; i < 4; i++)
        yardPut(y, 1, 0, 0, 0);
    assert_step(y, 4, 0, 0);
    assert_warned("pairCount");
    ck_assert_int_eq(refused, 2);
    assert_step(y, 0, 4, 0);
    ck_assert_int_eq(refused, 2);
    yardMove(y, 0, 9, 0, 0); /* its three pairs go, and two were waiting */
    assert_step(y, 2, 1, 3);
    assert_step(y, 0, 3, 0);
}

TEST(full_spaces_say_so) {
    yardMakeWith(y, McdAllAxes, 2, 4);
    yardPut(y, 1, 0, 0, 0);
    yardPut(y, 1, 0, 0, 0);
    const McdModelID c = yardCrate(y, 1, 0, 0, 0);
    ck_assert(!McdSpaceInsertModel(y->space, c));
    assert_warned("objectCount");
    McdSpaceRemoveModel(y->model[0]);
    ck_assert(McdSpaceInsertModel(y->space, c));
}

TEST(functions_are_legal_inside_or_outside) {
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0), b = yardPut(y, 1, 0, 0, 0), c = yardCrate(y, 1, 0, 0, 0);
    MeVector3 from = {0, 0, 0}, to = {1, 0, 0};
    McdLineSegIntersectResult hit;
    McdSpacePairIterator it;
    assert_refused(McdSpaceBeginChanges, y->space);
    assert_refused(McdSpacePairIteratorBegin, y->space, &it);
    assert_none(McdSpaceGetPairs, y->space, &it, y->pairs);
    assert_none(McdSpaceGetTransitions, y->space, &it, y->pairs);
    assert_none(McdSpaceGetLineSegFirstIntersection, y->space, from, to, &hit);
    assert_none(McdSpaceGetLineSegIntersections, y->space, from, to, &hit, 1);
    assert_refused(McdSpaceSetAABBFn, y->space, McdModelUpdatePathCompatible);
    McdSpaceEndChanges(y->space);
    assert_silent();
    assert_refused(McdSpaceEndChanges, y->space);
    assert_none(McdSpaceInsertModel, y->space, c);
    assert_none(McdSpaceInsertModelWithCulling, y->space, c, 0, 0, 0);
    assert_none(McdSpaceRemoveModel, a);
    assert_refused(McdSpaceUpdateModel, a);
    assert_refused(McdSpaceUpdateModels, y->space);
    assert_none(McdSpaceDisablePair, a, b);
    assert_none(McdSpaceEnablePair, a, b);
    assert_refused(McdSpaceSetModelCullingParameters, y->space, a, 0, 0, 0);
    ck_assert_int_eq(McdSpaceGetModelCount(y->space), 2);
    McdSpaceBeginChanges(y->space);
    assert_step(y, 0, 1, 0); /* none of it did anything */
}

TEST(updating_all_outside_is_a_block_of_its_own) {
    McdSpacePairIterator it;
    yardMake(y);
    yardPut(y, 1, 0, 0, 0);
    yardPut(y, 1, 0, 0, 0);
    McdSpaceBuild(y->space);
    for (int i = 0; i < 3; i++) { /* a program that never ends a block: the first one ends here too */
        McdSpaceUpdateAll(y->space);
        McdSpacePairIteratorBegin(y->space, &it);
        ck_assert_int_eq(McdSpaceGetPairs(y->space, &it, y->pairs), 0);
        assert_pairs(y, i == 0, i > 0, 0);
        ck_assert_int_eq(McdSpaceIsChanging(y->space), 0);
    }
    MeMatrix4TMSetPosition(y->tm[0], 3, 0, 0);
    McdSpaceUpdateAll(y->space);
    McdSpacePairIteratorBegin(y->space, &it);
    ck_assert_int_eq(McdSpaceGetPairs(y->space, &it, y->pairs), 0);
    assert_pairs(y, 0, 0, 1);
}

static int updates;
static void MEAPI farAway(McdModelID m, MeReal duration) {
    const MeVector3 low = {100, 100, 100}, high = {101, 101, 101};
    (void)duration;
    updates++;
    McdGeometryInstanceSetAABB(McdModelGetGeometryInstance(m), low, high);
}

TEST(programs_may_make_the_boxes) {
    yardMake(y);
    yardPut(y, 1, 0, 0, 0);
    yardPut(y, 1, 50, 0, 0);
    assert_step(y, 0, 0, 0);
    McdSpaceEndChanges(y->space);
    updates = 0;
    McdSpaceSetAABBFn(y->space, farAway);
    McdSpaceUpdateAll(y->space);
    McdSpaceBeginChanges(y->space);
    ck_assert_int_eq(updates, 2);
    assert_step(y, 0, 1, 0);
    McdSpaceEndChanges(y->space);
    McdSpaceSetAABBFn(y->space, 0);
    McdSpaceBeginChanges(y->space);
    McdSpaceUpdateAll(y->space);
    assert_step(y, 0, 0, 1);
    ck_assert_int_eq(updates, 2);
}

TEST(swept_models_have_boxes_around_their_motion) {
    MeVector3 fast = {100, 0, 0};
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0);
    yardPut(y, 1, 5, 0, 0);
    McdModelSetLinearVelocityPtr(a, fast);
    assert_step(y, 0, 0, 0);
    McdSpacePathUpdateAll(y->space, .1);
    assert_step(y, 0, 0, 0);
    McdModelSetSwept(a, 1);
    McdSpacePathUpdateAll(y->space, .1);
    assert_step(y, 1, 0, 0);
    McdSpaceUpdateAll(y->space);
    assert_step(y, 0, 0, 1);
    McdSpacePathUpdateAll(y->space, NAN);
    assert_warned("duration");
}

TEST(bad_transforms_warn_once_and_keep_the_box) {
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0), b = yardPut(y, 1, 0, 0, 0);
    assert_step(y, 1, 0, 0);
    y->tm[0][3][1] = (MeReal)NAN;
    McdSpaceUpdateAll(y->space);
    assert_warned("finite");
    McdModelSetTransformPtr(b, 0);
    McdSpaceUpdateModel(b);
    assert_warned("transform");
    for (int i = 0; i < 3; i++) {
        McdSpaceUpdateAll(y->space);
        assert_step(y, 0, 1, 0);
    }
    assert_silent();
    MeVector3 low, high;
    McdModelGetAABB(a, low, high);
    assert_vec3_near(low, -.5, -.5, -.5, 0);
    y->tm[0][3][1] = 7;
    McdSpaceUpdateAll(y->space);
    assert_step(y, 0, 0, 1);
    y->tm[0][3][1] = (MeReal)INFINITY;
    McdSpaceUpdateAll(y->space);
    assert_warned("finite");
}

TEST(boxes_without_bounds_meet_everything) {
    yardMake(y);
    yardPut(y, 1e12, 0, 0, -5e11);
    for (int i = 0; i < 10; i++)
        yardPut(y, 1, (MeReal)(100 * i), 0, (MeReal)(i % 2 ? 0 : 1e6));
    assert_step(y, 5, 0, 0);
    McdSpaceRemoveModel(y->model[0]);
    assert_step(y, 0, 0, 5);
}

TEST(models_are_listed_in_the_order_of_insertion) {
    McdSpaceModelIterator it;
    McdModelID m;
    int n = 0;
    yardMake(y);
    for (int i = 0; i < 5; i++)
        yardPut(y, 1, 0, 0, 0);
    McdSpaceRemoveModel(y->model[1]);
    McdSpaceInsertModel(y->space, y->model[1]);
    static const int order[5] = {0, 2, 3, 4, 1};
    McdSpaceModelIteratorBegin(y->space, &it);
    while (McdSpaceGetModel(y->space, &it, &m)) {
        ck_assert_ptr_eq(m, y->model[order[n++]]);
        ck_assert(McdSpaceRemoveModel(m)); /* the one just got may go */
    }
    ck_assert_int_eq(n, 5);
    ck_assert_ptr_null(m);
    ck_assert_int_eq(McdSpaceGetModelCount(y->space), 0);
}

TEST(the_framework_takes_models_out) {
    yardMake(y);
    for (int i = 0; i < 20; i++)
        yardPut(y, 1, 0, 0, 0);
    assert_step(y, 190, 0, 0);
    McdSpaceEndChanges(y->space);
    McdFrameworkDestroyAllModelsAndGeometries(y->frame);
    ck_assert_int_eq(McdSpaceGetModelCount(y->space), 0);
    ck_assert_int_eq(McdSpaceGetPairs(y->space, y->pairs), 0);
    assert_pairs(y, 0, 0, 0);
    McdSpaceBeginChanges(y->space);
    assert_step(y, 0, 0, 0);
    y->count = 0;
    yardPut(y, 1, 0, 0, 0);
    yardPut(y, 1, 0, 0, 0);
    assert_step(y, 1, 0, 0);
}

TEST(destroying_a_space_frees_its_models) {
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0);
    yardPut(y, 1, 0, 0, 0);
    assert_step(y, 1, 0, 0);
    McdSpaceDestroy(y->space);
    ck_assert_ptr_null(McdModelGetSpace(a));
    y->space = McdSpaceAxisSortCreate(y->frame, McdAllAxes, 5, 5);
    ck_assert(McdSpaceInsertModel(y->space, a));
}

TEST(bad_arguments_warn) {
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0), loose = yardCrate(y, 1, 0, 0, 0);
    McdModelID m;
    assert_none(McdSpaceAxisSortCreate, 0, McdAllAxes, 5, 5);
    ck_assert_ptr_null(McdSpaceAxisSortCreate((McdFrameworkID)(size_t)McdAllAxes, 50, 100, 1)); /* Karma 1.0's form */
    assert_warned("1.0");
    ck_assert_ptr_null(McdSpaceAxisSortCreate(y->frame, 0, 5, 5));
    assert_warned("axes");
    ck_assert_ptr_null(McdSpaceAxisSortCreate(y->frame, 8, 5, 5));
    assert_warned("axes");
    ck_assert_ptr_null(McdSpaceAxisSortCreate(y->frame, 7, 0, 5));
    assert_warned("objectCount");
    ck_assert_ptr_null(McdSpaceAxisSortCreate(y->frame, 7, 5, -1));
    assert_warned("pairCount");
    assert_refused(McdSpaceUpdateAll, 0);
    assert_none(McdSpaceInsertModel, y->space, 0);
    ck_assert(!McdSpaceFreezeModel(loose));
    assert_warned("no space");
    ck_assert(!McdSpaceEnablePair(a, a));
    assert_warned("two models");
    ck_assert(!McdSpacePairIsEnabled(a, loose));
    assert_warned("no space");
    assert_none(McdSpaceGetModel, y->space, 0, &m);
    McdSpaceDestroy(0);
    int mine;
    McdSpaceSetUserData(y->space, &mine);
    ck_assert_ptr_eq(McdSpaceGetUserData(y->space), &mine);
}

TEST(the_form_of_karma_1_1_has_an_argument_more) {
    yardMake(y);
    int evaluated = 0;
    const McdSpaceID s = McdSpaceAxisSortCreate(y->frame, McdAllAxes, 5, 7, ++evaluated);
    ck_assert_ptr_nonnull(s);
    ck_assert_int_eq(evaluated, 1);
    McdSpaceDestroy(s);
    ck_assert_ptr_null(McdSpaceAxisSortCreate(y->frame, McdAllAxes, 5, 0, 1));
    assert_warned("pairCount");
}
