/* Dictionaries that are filled in order, merged, made alike. */
#include "MeDict.h"
#include "karma_test.h"

enum { ROOM = 200 };

static MeDict dict, other;
static MeDictNode node[ROOM];
static int key[ROOM];

static int MEAPI compare(const void *a, const void *b) {
    const int x = *(const int *)a, y = *(const int *)b;
    return (x > y) - (x < y);
}

static int MEAPI backwards(const void *a, const void *b) {
    return compare(b, a);
}

static void setUp(void) {
    MeDictInit(&dict, ROOM, compare);
    MeDictInit(&other, ROOM, compare);
    for (int i = 0; i < ROOM; i++) {
        MeDictNodeInit(&node[i], NULL);
        key[i] = i;
    }
}
TEST_FIXTURE(setUp, NULL)

static int keyOf(MeDictNode *n) {
    return *(const int *)MeDictNodeGetKey(n);
}

TEST(nodes_loaded_in_order_are_found) {
    MeDictLoad load;
    MeDictLoadBegin(&load, &dict);
    for (int i = 0; i < ROOM; i++)
        MeDictLoadNext(&load, &node[i], &key[i]);
    MeDictLoadEnd(&load);
    ck_assert(MeDictVerify(&dict) && MeDictIsFull(&dict));
    for (int i = 0; i < ROOM; i++)
        ck_assert_ptr_eq(MeDictLookup(&dict, &key[i]), &node[i]);
}

TEST(what_is_not_in_order_is_not_loaded) {
    MeDictLoad load;
    MeDictLoadBegin(&load, &dict);
    MeDictLoadNext(&load, &node[5], &key[5]);
    assert_refused(MeDictLoadNext, &load, &node[4], &key[4]);
    key[6] = 5;
    assert_refused(MeDictLoadNext, &load, &node[6], &key[6]);
    assert_refused(MeDictLoadNext, &load, &node[5], &key[7]);
    MeDictLoadEnd(&load);
    ck_assert_uint_eq(MeDictCount(&dict), 1);
    assert_refused(MeDictLoadNext, &load, &node[8], &key[8]);
    assert_refused(MeDictLoadBegin, &load, &dict);
    assert_refused(MeDictLoadNext, &load, &node[8], &key[8]);
    assert_refused(MeDictLoadBegin, NULL, &dict);
    assert_refused(MeDictLoadEnd, NULL);
    ck_assert_uint_eq(MeDictCount(&dict), 1);
}

TEST(merging_moves_what_is_new) {
    for (int i = 0; i < 20; i++)
        MeDictInsert(i % 2 ? &dict : &other, &node[i], &key[i]);
    key[30] = 3;
    MeDictInsert(&other, &node[30], &key[30]);
    MeDictMerge(&dict, &other);
    ck_assert(MeDictCount(&dict) == 20 && MeDictCount(&other) == 1 && MeDictVerify(&dict) && MeDictVerify(&other));
    ck_assert_ptr_eq(MeDictFirst(&other), &node[30]);
    int i = 0;
    for (MeDictNode *n = MeDictFirst(&dict); n; n = MeDictNext(&dict, n))
        ck_assert_int_eq(keyOf(n), i++);
    MeDictAllowDupes(&dict);
    MeDictAllowDupes(&other);
    MeDictMerge(&dict, &other);
    ck_assert(MeDictCount(&dict) == 21 && MeDictIsEmpty(&other) && MeDictVerify(&dict));
}

TEST(merging_of_what_differs_or_does_not_fit_warns) {
    MeDict small, differs;
    MeDictInit(&small, 2, compare);
    MeDictInit(&differs, 2, backwards);
    for (int i = 0; i < 4; i++)
        MeDictInsert(&dict, &node[i], &key[i]);
    assert_refused(MeDictMerge, &differs, &dict);
    ck_assert(MeDictIsEmpty(&differs) && MeDictCount(&dict) == 4);
    assert_refused(MeDictMerge, &small, &dict);
    ck_assert(MeDictCount(&small) == 2 && MeDictCount(&dict) == 2);
    assert_refused(MeDictMerge, NULL, &dict);
}

TEST(alike_means_order_allocator_and_equal_keys) {
    MeDict like;
    ck_assert(MeDictSimilar(&dict, &other));
    MeDictAllowDupes(&dict);
    ck_assert(!MeDictSimilar(&dict, &other));
    MeDictInsert(&dict, &node[0], &key[0]);
    MeDictInitLike(&like, &dict);
    ck_assert(MeDictSimilar(&dict, &like) && MeDictIsEmpty(&like) && MeDictVerify(&like));
    MeDictInit(&other, DICTCOUNT_T_MAX, backwards);
    MeDictAllowDupes(&other);
    ck_assert(!MeDictSimilar(&dict, &other));
}

TEST(free_empties_it) {
    MeDictAllocInsert(&dict, &key[1], NULL);
    MeDictAllocInsert(&dict, &key[2], NULL);
    MeDictFree(&dict);
    ck_assert(MeDictIsEmpty(&dict));
}
