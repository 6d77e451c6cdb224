/* Pools of both kinds: records, order, limits, misuse. */
#include "karma_test.h"

#include "MePool.h"

#include <limits.h>
#include <stdint.h>

typedef struct {
    double position[3];
    char name[5];
} Record;

static const struct MePoolAPI *const kinds[] = {&MePoolFixedAPI, &MePoolMallocAPI};
static const MePoolType types[] = {MePoolFIXED, MePoolMALLOC};
enum { capacity = 50 };

TEST(records_are_apart_and_aligned) {
    static const int alignments[] = {1, 4, 16, 128};
    for (int i = 0; i < 8; i++) {
        MePool pool;
        char *records[capacity];
        const int alignment = alignments[i / 2], size = alignment == 1 ? 1 : (int)sizeof(Record);
        ck_assert(kinds[i % 2]->init(&pool, size, capacity, alignment));
        ck_assert_ptr_eq(pool.api, kinds[i % 2]);
        ck_assert_int_eq(pool.type, types[i % 2]);
        for (int j = 0; j < capacity; j++) {
            records[j] = pool.api->getStruct(&pool);
            ck_assert_ptr_nonnull(records[j]);
            ck_assert_uint_eq((uintptr_t)records[j] % (unsigned int)alignment, 0);
            memset(records[j], j, (size_t)size);
        }
        ck_assert_int_eq(pool.api->getUsed(&pool), capacity);
        for (int j = 0; j < capacity; j++) {
            for (int k = 0; k < size; k++)
                ck_assert_int_eq(records[j][k], j);
        }
        pool.api->destroy(&pool);
        ck_assert_int_eq(pool.type, MePoolNULL);
    }
}

/* In every order: what has been put back does not disturb what is out. */
TEST(records_come_and_go) {
    for (int i = 0; i < 2; i++) {
        MePool pool;
        int *records[capacity] = {NULL}, out = 0;
        unsigned int random = 1;
        ck_assert(kinds[i]->init(&pool, sizeof(int), capacity, sizeof(int)));
        for (int j = 0; j < 10000; j++) {
            random = random * 1664525u + 1013904223u;
            const int n = (int)(random >> 16) % capacity;
            if (records[n] == NULL) {
                records[n] = pool.api->getStruct(&pool);
                ck_assert_ptr_nonnull(records[n]);
                *records[n] = n;
                out++;
            } else {
                ck_assert_int_eq(*records[n], n);
                pool.api->putStruct(&pool, records[n]);
                records[n] = NULL;
                out--;
            }
            ck_assert_int_eq(pool.api->getUsed(&pool), out);
        }
        ck_assert_int_gt(out, 0);
        pool.api->destroy(&pool); /* with what is out: the leak check would tell */
    }
}

TEST(fixed_pool_has_a_limit) {
    MePool pool;
    ck_assert(MePoolFixedAPI.init(&pool, sizeof(Record), 3, 16));
    ck_assert_int_eq(MePoolFixedAPI.getCount(&pool), 3);
    void *last = NULL;
    for (int i = 0; i < 3; i++)
        last = MePoolFixedAPI.getStruct(&pool);
    assert_silent();
    ck_assert_ptr_null(MePoolFixedAPI.getStruct(&pool));
    assert_warned("all 3 records");
    ck_assert_int_eq(MePoolFixedAPI.getUsed(&pool), 3);
    MePoolFixedAPI.putStruct(&pool, last);
    ck_assert_ptr_eq(MePoolFixedAPI.getStruct(&pool), last);
    MePoolFixedAPI.destroy(&pool);
}

TEST(pool_of_no_records) {
    MePool pool;
    ck_assert(MePoolFixedAPI.init(&pool, sizeof(Record), 0, 16));
    ck_assert_ptr_null(MePoolFixedAPI.getStruct(&pool));
    assert_warned("all 0 records");
    MePoolFixedAPI.destroy(&pool);
}

TEST(malloc_pool_has_no_limit) {
    MePool pool;
    ck_assert(MePoolMallocAPI.init(&pool, sizeof(Record), 3, 16));
    ck_assert_int_eq(MePoolMallocAPI.getCount(&pool), 0);
    for (int i = 0; i < 1000; i++)
        ck_assert_ptr_nonnull(MePoolMallocAPI.getStruct(&pool));
    MePoolMallocAPI.destroy(&pool);
}

TEST(fixed_order_is_the_same_after_reset) {
    MePool pool;
    void *first[4];
    ck_assert(MePoolFixedAPI.init(&pool, sizeof(Record), 4, 16));
    for (int i = 0; i < 4; i++) {
        first[i] = MePoolFixedAPI.getStruct(&pool);
        ck_assert(i == 0 || (char *)first[i] > (char *)first[i - 1]);
    }
    MePoolFixedAPI.putStruct(&pool, first[1]);
    MePoolFixedAPI.putStruct(&pool, first[3]);
    MePoolFixedAPI.reset(&pool);
    ck_assert_int_eq(MePoolFixedAPI.getUsed(&pool), 0);
    for (int i = 0; i < 4; i++)
        ck_assert_ptr_eq(MePoolFixedAPI.getStruct(&pool), first[i]);
    MePoolFixedAPI.destroy(&pool);
}

TEST(malloc_pool_is_reset) {
    MePool pool;
    ck_assert(MePoolMallocAPI.init(&pool, sizeof(Record), 0, 16));
    for (int i = 0; i < 5; i++)
        ck_assert_ptr_nonnull(MePoolMallocAPI.getStruct(&pool));
    MePoolMallocAPI.reset(&pool);
    ck_assert_int_eq(MePoolMallocAPI.getUsed(&pool), 0);
    MePoolMallocAPI.putStruct(&pool, MePoolMallocAPI.getStruct(&pool));
    ck_assert_int_eq(MePoolMallocAPI.getUsed(&pool), 0);
    MePoolMallocAPI.destroy(&pool);
}

TEST(what_is_not_out_is_not_taken) {
    MePool pool;
    Record other;
    ck_assert(MePoolFixedAPI.init(&pool, sizeof(Record), 4, 16));
    char *const record = MePoolFixedAPI.getStruct(&pool);
    char *const bad[] = {(char *)&other, record + 1, record + pool.stride, record - pool.stride,
                         record + 4 * pool.stride};
    for (int i = 0; i < 5; i++) {
        MePoolFixedAPI.putStruct(&pool, bad[i]);
        assert_warned("MePoolFixedAPI.putStruct");
    }
    MePoolFixedAPI.putStruct(&pool, NULL);
    ck_assert_int_eq(MePoolFixedAPI.getUsed(&pool), 1);
    MePoolFixedAPI.putStruct(&pool, record);
    assert_silent();
    MePoolFixedAPI.putStruct(&pool, record);
    assert_warned("MePoolFixedAPI.putStruct");
    ck_assert_int_eq(MePoolFixedAPI.getUsed(&pool), 0);
    MePoolFixedAPI.destroy(&pool);
}

TEST(bad_numbers_warn) {
    static const int bad[][2] = {{0, 16}, {-1, 16}, {8, 0}, {8, -16}, {8, 24}, {INT_MAX, 16}};
    MePool pool;
    for (int i = 0; i < 12; i++) {
        ck_assert(!kinds[i % 2]->init(&pool, bad[i / 2][0], 4, bad[i / 2][1]));
        assert_warned("init");
        ck_assert_int_eq(pool.type, MePoolNULL);
    }
    ck_assert(!MePoolFixedAPI.init(&pool, 8, -1, 16));
    assert_warned("-1 records");
}

static void assertAllWarn(const struct MePoolAPI *api, MePool *pool) {
    char record[64];
    api->reset(pool);
    assert_warned("reset");
    api->destroy(pool);
    assert_warned("destroy");
    ck_assert_ptr_null(api->getStruct(pool));
    assert_warned("getStruct");
    api->putStruct(pool, record);
    assert_warned("putStruct");
    ck_assert_int_eq(api->getUsed(pool), 0);
    assert_warned("getUsed");
    ck_assert_int_eq(api->getCount(pool), 0);
    assert_warned("getCount");
}

TEST(null_and_other_pools_warn) {
    for (int i = 0; i < 2; i++) {
        MePool pool;
        ck_assert(!kinds[i]->init(NULL, 8, 4, 16));
        assert_warned("init");
        assertAllWarn(kinds[i], NULL);
        ck_assert(kinds[i]->init(&pool, 8, 4, 16));
        assertAllWarn(kinds[1 - i], &pool);
        pool.api->destroy(&pool);
        assertAllWarn(kinds[i], &pool);
    }
}
