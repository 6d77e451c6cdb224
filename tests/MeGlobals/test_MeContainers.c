/* Hash tables, heaps, sets, pools of numbers and of records in the program's memory, and the sphere around points. */
#include "MeBounding.h"
#include "MeHash.h"
#include "MeHeap.h"
#include "MeIDPool.h"
#include "MeMath.h"
#include "MeSet.h"
#include "karma_test.h"

enum { MANY = 1000 };

static int number[MANY];
static MeU32 seed;
static int freed;

static void setUp(void) {
    seed = 7;
    freed = 0;
    for (int i = 0; i < MANY; i++)
        number[i] = i;
}
TEST_FIXTURE(setUp, NULL)

static int randomBelow(int n) {
    seed = seed * 1664525u + 1013904223u;
    return (int)(seed >> 8) % n;
}

static int MEAPI compare(const void *a, const void *b) {
    const int x = *(const int *)a, y = *(const int *)b;
    return (x > y) - (x < y);
}

static void MEAPI count(void *const item) {
    (void)item;
    freed++;
}

/* ---- hash tables ---- */

/* Against an array of what is in it, in fewer buckets than entries. */
TEST(a_hash_table_has_what_was_put_in) {
    MeHash *table = MeHashCreate(37);
    void *held[MANY] = {0};
    int population = 0;
    MeHashSetHashFunc(table, MeHashInt);
    MeHashSetKeyCompareFunc(table, MeHashIntCompare);
    for (int round = 0; round < 20 * MANY; round++) {
        const int i = randomBelow(MANY), key = i;
        if (held[i] && round % 3) {
            ck_assert_ptr_eq(MeHashDelete(&key, table), held[i]);
            held[i] = NULL;
            population--;
        } else {
            void *datum = &number[randomBelow(MANY)];
            ck_assert_ptr_eq(MeHashInsert(&number[i], datum, table), held[i]);
            population += !held[i];
            held[i] = datum;
        }
        ck_assert_int_eq(MeHashPopulation(table), population);
        ck_assert_ptr_eq(MeHashLookup(&key, table), held[i]);
    }
    for (int i = 0; i < MANY; i++)
        ck_assert_ptr_eq(MeHashLookup(&number[i], table), held[i]);
    MeHashDestroy(table);
}

TEST(a_hash_table_is_walked_in_the_order_in_which_entries_came) {
    MeHash *table = MeHashCreate(5);
    MeHashIterator i;
    for (int k = 0; k < 20; k++)
        MeHashInsert(&number[k], &number[k], table);
    MeHashDelete(&number[0], table);
    MeHashDelete(&number[7], table);
    MeHashDelete(&number[19], table);
    MeHashInsert(&number[7], &number[7], table);
    ck_assert_ptr_eq(MeHashInitIterator(&i, table), &i);
    for (int k = 1; k < 19; k++)
        if (k != 7)
            ck_assert_ptr_eq(MeHashGetDatum(&i), &number[k]);
    ck_assert_ptr_eq(MeHashGetDatum(&i), &number[7]);
    ck_assert_ptr_null(MeHashGetDatum(&i));
    ck_assert_ptr_null(MeHashGetDatum(&i));
    MeHashDestroy(table);
}

TEST(keys_are_addresses_or_strings) {
    MeHash *table = MeHashCreate(8);
    char one[] = "wheel", same[] = "wheel";
    MeHashInsert(one, &number[1], table);
    ck_assert(MeHashLookup(one, table) == &number[1] && !MeHashLookup(same, table));
    MeHashReset(table);
    MeHashSetHashFunc(table, MeHashString);
    MeHashSetKeyCompareFunc(table, MeHashStringCompare);
    MeHashInsert(one, &number[1], table);
    ck_assert(MeHashLookup(same, table) == &number[1] && !MeHashLookup("axle", table));
    ck_assert(MeHashInsert(same, &number[2], table) == &number[1] && MeHashPopulation(table) == 1);
    MeHashDestroy(table);
}

TEST(a_hash_table_frees_what_it_loses) {
    MeHash *table = MeHashCreate(8);
    MeHashSetKeyFreeFunc(table, count);
    for (int i = 0; i < 10; i++)
        MeHashInsert(&number[i], &number[i], table);
    MeHashDelete(&number[3], table);
    ck_assert_int_eq(freed, 1);
    MeHashSetDatumFreeFunc(table, count);
    MeHashReset(table);
    ck_assert(freed == 19 && MeHashPopulation(table) == 0 && !MeHashLookup(&number[1], table));
    MeHashInsert(&number[1], &number[1], table);
    MeHashDestroy(table);
    ck_assert_int_eq(freed, 21);
}

static int MEAPI outside(const void *key, int size) {
    (void)key;
    return size;
}

TEST(hash_tables_warn_of_bad_input) {
    MeHashIterator i;
    assert_none(MeHashCreate, 0);
    MeHash *table = MeHashCreate(1);
    MeHashInsert(&number[0], &number[0], table);
    assert_silent();
    assert_refused(MeHashSetHashFunc, table, MeHashInt);
    assert_refused(MeHashSetKeyCompareFunc, table, MeHashIntCompare);
    MeHashReset(table);
    MeHashSetHashFunc(table, outside);
    MeHashInsert(&number[0], &number[0], table);
    assert_warned("hash function");
    assert_none(MeHashLookup, &number[0], NULL);
    assert_none(MeHashInsert, &number[0], &number[0], NULL);
    assert_none(MeHashDelete, &number[0], NULL);
    assert_refused(MeHashInitIterator, &i, NULL);
    ck_assert_ptr_null(MeHashGetDatum(&i));
    assert_none(MeHashString, NULL, 4);
    ck_assert_int_ne(MeHashIntCompare(NULL, &number[0]), 0);
    assert_warned("MeHashIntCompare");
    assert_refused(MeHashDestroy, NULL);
    MeHashDestroy(table);
}

/* ---- heaps ---- */

TEST(a_heap_gives_the_least_first) {
    MeHeap heap;
    void *memory[MANY];
    MeHeapInit(&heap, memory, MANY, compare);
    for (int i = 0; i < MANY; i++)
        number[i] = randomBelow(300);
    int in = 0;
    for (int i = 0; i < MANY; i++) {
        ck_assert(MeHeapPush(&heap, &number[i]));
        in++;
        if (i % 5 == 4) {
            MeHeapPop(&heap);
            in--;
        }
    }
    int last = -1;
    for (; in; in--) {
        const int here = *(int *)MeHeapPop(&heap);
        ck_assert_int_ge(here, last);
        last = here;
    }
    ck_assert_ptr_null(MeHeapPop(&heap));
}

TEST(heaps_warn_of_bad_input) {
    MeHeap own;
    void *memory[1];
    MeHeap *heap = MeHeapCreate(2, compare);
    ck_assert(MeHeapPush(heap, &number[2]) && MeHeapPush(heap, &number[1]));
    assert_silent();
    ck_assert(!MeHeapPush(heap, &number[0]));
    assert_warned("capacity");
    ck_assert_ptr_eq(MeHeapPop(heap), &number[1]);
    MeHeapDestroy(heap);
    MeHeapInit(&own, memory, 1, compare);
    assert_silent();
    assert_refused(MeHeapDestroy, &own);
    assert_refused(MeHeapInit, &own, NULL, 1, compare);
    ck_assert(!MeHeapPush(&own, &number[0]) && !MeHeapPop(&own));
    assert_warned("MeHeapPush");
    ck_assert(!MeHeapCreate(0, compare) && !MeHeapCreate(1, NULL));
    assert_warned("MeHeapCreate");
    assert_none(MeHeapPop, NULL);
}

/* ---- sets ---- */

static void checkSet(MeSet *s, const MeBool *isIn, int max) {
    int size = 0;
    for (int i = 0; i < max; i++) {
        ck_assert_int_eq(MeSetContains(s, &number[i]), isIn[i]);
        if (isIn[i])
            ck_assert_ptr_eq(MeSetIteratorNext(s), &number[i]);
        size += isIn[i];
    }
    ck_assert_ptr_null(MeSetIteratorNext(s));
    ck_assert_int_eq(MeSetSize(s), size);
}

TEST(a_set_has_each_item_once_and_in_order) {
    enum { MAX = 60 };
    MeDictNode nodes[MAX];
    MeSet own, *sets[2] = {&own, MeSetCreate(compare)};
    MeSetInit(&own, nodes, MAX, compare);
    for (int k = 0; k < 2; k++) {
        MeBool isIn[MAX] = {0};
        for (int round = 0; round < 2000; round++) {
            const int i = randomBelow(MAX);
            int copy = i;
            if (round & 1)
                ck_assert_int_eq(MeSetAdd(sets[k], &number[i]), !isIn[i]);
            else
                ck_assert_int_eq(MeSetRemove(sets[k], &copy), isIn[i]);
            isIn[i] = round & 1;
            if (round % 50 == 0)
                checkSet(sets[k], isIn, MAX);
        }
        MeSetAdd(sets[k], &number[0]);
        MeSetAdd(sets[k], &number[MAX - 1]);
        ck_assert(MeSetPop(sets[k]) == &number[MAX - 1] && MeSetPopFirst(sets[k]) == &number[0]);
        while (MeSetPop(sets[k]))
            ;
        ck_assert(MeSetSize(sets[k]) == 0 && !MeSetPopFirst(sets[k]));
        MeSetAdd(sets[k], &number[1]);
        MeSetDestroy(sets[k]);
    }
}

TEST(sets_warn_when_they_are_full_and_of_bad_input) {
    MeDictNode nodes[2];
    MeSet s;
    MeSetInit(&s, nodes, 2, compare);
    ck_assert(MeSetAdd(&s, &number[1]) && !MeSetIsFull(&s) && MeSetAdd(&s, &number[2]) && MeSetIsFull(&s));
    assert_silent();
    ck_assert(!MeSetAdd(&s, &number[3]));
    assert_warned("maxnode");
    MeSetDestroy(&s);
    MeSetInit(&s, nodes, 2, NULL);
    assert_warned("comparison");
    ck_assert(!MeSetAdd(&s, &number[3]));
    assert_none(MeSetCreate, NULL);
    ck_assert(!MeSetSize(NULL) && !MeSetPop(NULL) && !MeSetIteratorNext(NULL));
    assert_warned("MeSetIteratorNext");
}

/* ---- pools ---- */

TEST(the_least_number_that_is_not_taken_is_given) {
    MeIDPool *pool = MeIDPoolCreate(), *copy = MeIDPoolCreate();
    MeBool isTaken[300] = {0};
    for (int round = 0; round < 5000; round++) {
        if (randomBelow(100) < 55) {
            int min = 0;
            while (min < 300 && isTaken[min])
                min++;
            if (min == 300)
                break;
            ck_assert_int_eq(MeIDPoolRequestID(pool), min);
            isTaken[min] = METRUE;
        } else {
            const int id = randomBelow(300);
            if (isTaken[id])
                MeIDPoolReturnID(pool, id);
            isTaken[id] = MEFALSE;
        }
        ck_assert(!MeIDPoolIsEmpty(pool));
    }
    MeIDPoolCopy(copy, pool);
    ck_assert_int_eq(MeIDPoolRequestID(copy), MeIDPoolRequestID(pool));
    MeIDPoolReset(pool);
    ck_assert_int_eq(MeIDPoolRequestID(pool), 0);
    assert_refused(MeIDPoolReturnID, pool, 5);
    assert_refused(MeIDPoolReturnID, pool, -1);
    assert_refused(MeIDPoolReturnID, pool, 1 << 30);
    ck_assert_int_eq(MeIDPoolRequestID(NULL), -1);
    assert_warned("MeIDPoolRequestID");
    MeIDPoolDestroy(pool);
    MeIDPoolDestroy(copy);
}

/* Onto itself it changes nothing; onto a larger one it leaves nothing of that one's. */
TEST(numbers_are_copied_as_they_are) {
    MeIDPool *small = MeIDPoolCreate(), *large = MeIDPoolCreate();
    for (int i = 0; i < 5; i++)
        MeIDPoolRequestID(small);
    MeIDPoolReturnID(small, 2);
    for (int i = 0; i < 1000; i++)
        MeIDPoolRequestID(large);
    MeIDPoolCopy(small, small);
    assert_silent();
    MeIDPoolCopy(large, small);
    assert_silent();
    assert_refused(MeIDPoolCopy, small, NULL);
    assert_refused(MeIDPoolCopy, NULL, small);
    for (int k = 0; k < 2; k++) {
        MeIDPool *pool = k ? large : small;
        ck_assert_int_eq(MeIDPoolRequestID(pool), 2);
        for (int i = 5; i < 70; i++)
            ck_assert_int_eq(MeIDPoolRequestID(pool), i);
        MeIDPoolDestroy(pool);
    }
}

TEST(records_come_from_the_programs_memory) {
    struct {
        void *a, *b;
    } memory[3];
    MePoolx pool;
    MePoolxInit(&pool, memory, sizeof memory[0], 3);
    void *r[3];
    for (int i = 0; i < 3; i++) {
        r[i] = MePoolxGet(&pool);
        ck_assert_ptr_eq(r[i], &memory[i]);
    }
    ck_assert_ptr_null(MePoolxGet(&pool));
    memory[1].b = memory;
    MePoolxPut(&pool, r[1]);
    MePoolxPut(&pool, r[0]);
    ck_assert_ptr_eq(MePoolxGet(&pool), r[0]);
    ck_assert_ptr_eq(MePoolxGetZeroed(&pool), r[1]);
    ck_assert(!memory[1].a && !memory[1].b && !MePoolxGetZeroed(&pool));
    assert_refused(MePoolxPut, &pool, (char *)r[1] + 1);
    assert_refused(MePoolxPut, &pool, &pool);
    MePoolxPut(&pool, NULL);
    assert_silent();
    assert_refused(MePoolxInit, &pool, memory, 1, 3);
    ck_assert_ptr_null(MePoolxGet(&pool));
}

TEST(a_dictionary_may_take_nodes_from_such_a_pool) {
    MeDictNode nodes[2];
    MePoolx pool;
    MeDict dict;
    MeDictInit(&dict, 9, compare);
    MePoolxInit(&pool, nodes, sizeof nodes[0], 2);
    MePoolxUseWithDict(&pool, &dict);
    ck_assert(MeDictAllocInsert(&dict, &number[1], NULL) && MeDictAllocInsert(&dict, &number[2], NULL));
    ck_assert(!MeDictAllocInsert(&dict, &number[3], NULL));
    MeDictDeleteFree(&dict, MeDictFirst(&dict));
    ck_assert(MeDictAllocInsert(&dict, &number[3], NULL) && MeDictFirst(&dict) == &nodes[1]);
    MePoolx narrow;
    void *small[4];
    MePoolxInit(&narrow, small, sizeof(void *), 4);
    assert_refused(MePoolxUseWithDict, &narrow, &dict);
}

/* ---- the sphere around points ---- */

static MeReal squareRoot(double x) {
    return sqrt(x);
}

TEST(the_sphere_is_the_smallest) {
    MeVector3 centre, cube[9] = {{0}}, triangle[3] = {{-1, 0, 0}, {1, 0, 0}, {0, 0.5, 0}};
    MeReal radius;
    for (int i = 0; i < 8; i++)
        MeVector3Set(cube[i], i & 1 ? 3 : 1, i & 2 ? 1 : -1, i & 4 ? 6 : 4);
    MeVector3Set(cube[8], 2, 0, 5); /* inside */
    MeBoundingSphereCalc(cube, 9, centre, &radius);
    assert_vec3_near(centre, 2, 0, 5, TOL(2e-6, 1e-12));
    assert_near(radius, squareRoot(3), TOL(2e-6, 1e-12));
    MeBoundingSphereCalc(triangle, 3, centre, &radius); /* obtuse: its longest side is a diameter */
    assert_vec3_near(centre, 0, 0, 0, TOL(1e-6, 1e-12));
    assert_near(radius, 1, TOL(1e-6, 1e-12));
    MeVector3 regular[3] = {{1, 0, 2}, {-0.5, squareRoot(.75), 2}, {-0.5, -squareRoot(.75), 2}};
    MeBoundingSphereCalc(regular, 3, centre, &radius);
    assert_vec3_near(centre, 0, 0, 2, TOL(1e-6, 1e-12));
    assert_near(radius, 1, TOL(1e-6, 1e-12));
    MeVector3 line[3] = {{1, 1, 1}, {2, 2, 2}, {4, 4, 4}}, same[3] = {{7, 8, 9}, {7, 8, 9}, {7, 8, 9}};
    MeBoundingSphereCalc(line, 3, centre, &radius);
    assert_vec3_near(centre, 2.5, 2.5, 2.5, TOL(1e-6, 1e-12));
    MeBoundingSphereCalc(same, 3, centre, &radius);
    ck_assert(centre[0] == 7 && centre[1] == 8 && centre[2] == 9 && radius == 0);
}

/* Around points on a sphere all over, and others inside, it is that sphere; and nothing is outside. */
TEST(nothing_is_outside_the_sphere) {
    MeVector3 point[200], centre;
    MeReal radius;
    for (int round = 0; round < 50; round++) {
        const int n = round < 10 ? round + 1 : 200;
        for (int i = 0; i < n; i++) {
            for (int k = 0; k < 3; k++)
                point[i][k] = (MeReal)(randomBelow(20001) - 10000);
            MeVector3Normalize(point[i]);
            if (i & 1)
                MeVector3Scale(point[i], 0.75);
            MeVector3MultiplyAdd(point[i], 100, (MeVector3){1, 0, 0});
        }
        MeBoundingSphereCalc(point, n, centre, &radius);
        ck_assert(radius <= (MeReal)1.00001);
        if (n == 200) {
            assert_near(radius, 1, .02); /* 100 points leave gaps */
            assert_vec3_near(centre, 100, 0, 0, .1);
        }
        for (int i = 0; i < n; i++) {
            double d = 0;
            for (int k = 0; k < 3; k++)
                d += pow(point[i][k] - (double)centre[k], 2);
            ck_assert(sqrt(d) <= (double)radius);
        }
    }
}

TEST(the_sphere_of_bad_input_is_none) {
    MeVector3 point[2] = {{1, 2, 3}, {4, 5, 6}}, centre;
    MeReal radius = 9;
    assert_refused(MeBoundingSphereCalc, point, 0, centre, &radius);
    ck_assert(radius == 0 && centre[0] == 0);
    point[1][2] = NAN;
    MeBoundingSphereCalc(point, 2, centre, &radius);
    assert_warned("finite");
    ck_assert(radius == 0 && centre[0] == 0);
    assert_refused(MeBoundingSphereCalc, NULL, 2, NULL, NULL);
}
