/* What Karma's libraries share: memory that reports its failure, and the table of live objects. */
#include "MeInternal.h"
#include "karma_test.h"
#include <pthread.h>
#include <stdint.h>

static void *MEAPI createNothing(size_t bytes) {
    (void)bytes;
    return NULL;
}

static void *MEAPI createNothingAligned(size_t bytes, unsigned int alignment) {
    (void)bytes, (void)alignment;
    return NULL;
}

static void MEAPI refuseNull(void *const block) {
    ck_assert(block != NULL);
    free(block);
}

/* One failing allocation is one fatal error that says who wanted what. */
static void assertFatal(const char *what) {
    ck_assert_int_eq(caught.fatal, 1);
    ck_assert_msg(strstr(caught.last, "Caller") && strstr(caught.last, what), "%s", caught.last);
    caught.fatal = 0;
}

TEST(failing_allocations_name_who_wanted_what) {
    const MeMemoryAPIStruct before = MeMemoryAPI;
    int *block = MeMemoryTake(3, sizeof *block, "Caller", "numbers");
    block[2] = 5;
    MeMemoryAPI.create = createNothing;
    MeMemoryAPI.createAligned = createNothingAligned;
    ck_assert(MeMemoryTake(7, 8, "Caller", "things") == NULL);
    assertFatal("things");
    ck_assert(MeMemoryTakeZeroed(7, 8, "Caller", "zeros") == NULL);
    assertFatal("zeros");
    ck_assert(MeMemoryTakeAligned(7, 8, 64, "Caller", "rows") == NULL);
    assertFatal("rows");
    ck_assert(!MeMemoryGrow(&block, 3, 6, sizeof *block, "Caller", "more numbers"));
    assertFatal("more numbers");
    ck_assert_int_eq(block[2], 5);
    MeMemoryAPI = before;
    MeMemoryGive(block);
}

TEST(more_than_there_can_be_is_no_memory) {
    ck_assert(MeMemoryTake(SIZE_MAX / 4, 8, "Caller", "too much") == NULL);
    assertFatal("too much");
    ck_assert(MeMemoryTakeAligned(SIZE_MAX / 4, 8, 16, "Caller", "too much") == NULL);
    assertFatal("too much");
}

TEST(growing_keeps_what_is_used_and_nulls_are_not_destroyed) {
    const MeMemoryAPIStruct before = MeMemoryAPI;
    int *block = NULL;
    MeMemoryAPI.destroy = refuseNull;
    MeMemoryAPI.destroyAligned = refuseNull;
    for (int count = 1; count <= 1024; count *= 2) {
        ck_assert(MeMemoryGrow(&block, (size_t)count / 2, (size_t)count, sizeof *block, "Caller", "numbers"));
        for (int i = 0; i < count / 2; i++)
            ck_assert_int_eq(block[i], i);
        for (int i = count / 2; i < count; i++)
            block[i] = i;
    }
    MeMemoryGive(block);
    MeMemoryGive(NULL);
    MeMemoryGiveAligned(NULL);
    MeMemoryAPI = before;
}

TEST(aligned_blocks_are_aligned) {
    for (unsigned int alignment = 16; alignment <= 256; alignment *= 2) {
        char *block = MeMemoryTakeAligned(33, 7, alignment, "Caller", "rows");
        ck_assert((uintptr_t)block % alignment == 0);
        memset(block, 1, 33 * 7);
        MeMemoryGiveAligned(block);
    }
}

typedef struct Thing {
    int contents[3];
    MeHandle handle;
} Thing;

enum { APPLE = 0x4150504c, PEAR = 0x50454152 };

TEST(handles_are_live_from_entering_to_leaving) {
    enum { COUNT = 50000 };
    Thing *thing = calloc(COUNT, sizeof *thing);
    for (int i = 0; i < COUNT; i++)
        MeHandleEnter(&thing[i].handle, &thing[i], APPLE);
    for (int i = 0; i < COUNT; i += 3)
        MeHandleLeave(&thing[i].handle);
    for (int i = 0; i < COUNT; i++) {
        ck_assert_int_eq(MeHandleIsLive(&thing[i], APPLE), i % 3 != 0);
        ck_assert(!MeHandleIsLive(&thing[i], PEAR));
        ck_assert(!MeHandleIsLive(&thing[i].contents[1], APPLE));
    }
    for (int i = 0; i < COUNT; i++) {
        MeHandleLeave(&thing[i].handle); /* twice does nothing */
        ck_assert(!MeHandleIsLive(&thing[i], APPLE));
    }
    ck_assert(!MeHandleIsLive(NULL, APPLE));
    free(thing);
}

/* The same addresses' buckets from both sides; each thread sees its own. */
static void *enterAndLeave(void *context) {
    Thing thing[64];
    memset(thing, 0, sizeof thing);
    for (int round = 0; round < 200; round++) {
        for (int i = 0; i < 64; i++)
            MeHandleEnter(&thing[i].handle, &thing[i], APPLE);
        for (int i = 0; i < 64; i++)
            if (!MeHandleIsLive(&thing[i], APPLE))
                *(int *)context = 1;
        for (int i = 0; i < 64; i++)
            MeHandleLeave(&thing[i].handle);
    }
    return NULL;
}

TEST(two_threads_enter_and_leave_at_once) {
    pthread_t thread[2];
    int isLost[2] = {0, 0};
    for (int t = 0; t < 2; t++)
        ck_assert_int_eq(pthread_create(&thread[t], NULL, enterAndLeave, &isLost[t]), 0);
    for (int t = 0; t < 2; t++)
        pthread_join(thread[t], NULL);
    ck_assert(!isLost[0] && !isLost[1]);
}
