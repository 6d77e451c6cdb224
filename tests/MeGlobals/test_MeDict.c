/* Dictionaries: order, against an array that is kept in order; duplicates, limits, allocators, bad input. */
#include "MeDict.h"
#include "karma_test.h"

enum { ROOM = 500 };

static MeDict dict;
static MeDictNode node[ROOM];
static int key[ROOM];
static int given, taken;

static int MEAPI compare(const void *a, const void *b) {
    const int x = *(const int *)a, y = *(const int *)b;
    return (x > y) - (x < y);
}

static void setUp(void) {
    MeDictInit(&dict, ROOM, compare);
    for (int i = 0; i < ROOM; i++)
        MeDictNodeInit(&node[i], &key[i]);
    given = taken = 0;
}
TEST_FIXTURE(setUp, NULL)

static void put(int i, int value) {
    key[i] = value;
    MeDictInsert(&dict, &node[i], &key[i]);
}

static int valueOf(MeDictNode *n) {
    return *(const int *)MeDictNodeGetKey(n);
}

/* Nodes come and go at random; each key is there or not. */
TEST(it_is_in_order_whatever_comes_and_goes) {
    MeBool isIn[ROOM] = {0};
    MeU32 seed = 7;
    for (int round = 0; round < 20000; round++) {
        seed = seed * 1664525u + 1013904223u;
        const int i = (int)(seed >> 8) % ROOM;
        if (isIn[i])
            ck_assert_ptr_eq(MeDictDelete(&dict, &node[i]), &node[i]);
        else
            put(i, i);
        isIn[i] = !isIn[i];
        if (round % 500)
            continue;
        ck_assert(MeDictVerify(&dict));
        MeDictNode *n = MeDictFirst(&dict);
        for (int k = 0; k < ROOM; k++) {
            MeDictNode *low = MeDictLowerBound(&dict, &k), *high = MeDictUpperBound(&dict, &k);
            ck_assert_ptr_eq(MeDictLookup(&dict, &k), isIn[k] ? &node[k] : NULL);
            ck_assert(low == n && (!isIn[k] || high == n));
            ck_assert(isIn[k] || high == (n ? MeDictPrev(&dict, n) : MeDictLast(&dict)));
            n = isIn[k] ? MeDictNext(&dict, n) : n;
        }
        ck_assert_ptr_null(n);
    }
}

static int depth(const MeDictNode *n) {
    if (!n)
        return 0;
    const int left = depth(n->child[0]), right = depth(n->child[1]);
    return 1 + (left > right ? left : right);
}

TEST(it_stays_flat_when_keys_come_in_order) {
    for (int i = 0; i < ROOM; i++)
        put(i, i);
    ck_assert_int_lt(depth(dict.root), 30); /* log2(500) = 9; a list would have 500 */
}

TEST(equal_keys_are_in_the_order_in_which_they_came) {
    put(0, 5);
    put(1, 5);
    assert_warned("AllowDupes");
    MeDictAllowDupes(&dict);
    for (int i = 1; i < 50; i++)
        put(i, 5);
    MeDictNode *n = MeDictLookup(&dict, &key[0]);
    for (int i = 0; i < 50; i++, n = MeDictNext(&dict, n))
        ck_assert_ptr_eq(n, &node[i]);
    ck_assert(MeDictUpperBound(&dict, &key[0]) == &node[49] && MeDictVerify(&dict));
}

static MeDictNode *MEAPI give(void *context) {
    given++;
    return given <= *(int *)context ? MeDictNodeCreate(0) : NULL;
}

static void MEAPI take(MeDictNode *n, void *context) {
    (void)context;
    taken++;
    MeDictNodeDestroy(n);
}

static void MEAPI dropOdd(MeDict *d, MeDictNode *n, void *context) {
    ++*(int *)context;
    if (valueOf(n) % 2)
        MeDictDeleteFree(d, n);
}

TEST(nodes_may_come_from_an_allocator) {
    static const int keys[] = {3, 1, 4, 2, 9};
    int room = 4, seen = 0;
    MeDict *own = MeDictCreate(10, compare);
    MeDictSetAllocator(own, give, take, &room);
    for (int i = 0; i < 5; i++)
        ck_assert_int_eq(MeDictAllocInsert(own, &keys[i], &room), i < 4);
    ck_assert(MeDictCount(own) == 4 && MeDictNodeGet(MeDictFirst(own)) == &room);
    MeDictProcess(own, &seen, dropOdd);
    ck_assert(seen == 4 && taken == 2 && MeDictCount(own) == 2);
    MeDictFreeNodes(own);
    ck_assert(taken == 4 && MeDictIsEmpty(own));
    MeDictSetAllocator(own, 0, 0, 0);
    ck_assert_int_eq(MeDictAllocInsert(own, &keys[0], &room), 1);
    MeDictFreeNodes(own);
    MeDictDestroy(own);
}

TEST(bad_input_warns) {
    MeDict *own = MeDictCreate(1, compare);
    key[0] = 1;
    ck_assert(!MeDictInit(0, 1, compare) && !MeDictCreate(1, 0));
    assert_warned("the comparison is null");
    MeDictInsert(own, &node[0], &key[0]);
    assert_silent();
    ck_assert(MeDictIsFull(own) && MeDictNodeIsInADict(&node[0]) && !MeDictContains(&dict, &node[0]));
    MeDictInsert(&dict, &node[0], &key[0]);
    assert_warned("in a dictionary");
    MeDictInsert(own, &node[1], &key[1]);
    assert_warned("maxcount");
    ck_assert_ptr_null(MeDictDelete(&dict, &node[0]));
    assert_warned("not in this");
    ck_assert_ptr_null(MeDictNext(&dict, &node[0]));
    assert_warned("not in this");
    MeDictNodeDestroy(&node[0]);
    assert_warned("MeDictDelete");
    MeDictDestroy(&dict);
    assert_warned("MeDictCreate");
    MeDictDestroy(own);
    assert_warned("1 nodes");
    ck_assert(!MeDictNodeIsInADict(&node[0]) && !MeDictNodeGetKey(&node[0]));
    MeDictNodePut(&node[0], own);
    ck_assert(MeDictNodeGet(&node[0]) == (void *)own && MeDictCount(0) == 0 && !MeDictFirst(0));
    assert_warned("the dictionary is null");
}
