/* The default memory functions; that all memory comes from those that are set; what happens when there is
 * none. */
#include "karma_test.h"

#include "MeChunk.h"
#include "MeCommandLine.h"
#include "MeMemory.h"
#include "MePool.h"
#include "MeProfile.h"

#include <stdint.h>

/* ---- the defaults ---- */

TEST(created_memory_is_usable) {
    static const size_t sizes[] = {0, 1, 7, 4096, 1000000};
    for (int i = 0; i < 5; i++) {
        char *const block = MeMemoryAPI.create(sizes[i]);
        ck_assert_ptr_nonnull(block);
        memset(block, 1, sizes[i]);
        MeMemoryAPI.destroy(block);
    }
    MeMemoryAPI.destroy(NULL);
}

TEST(aligned_memory_is_aligned) {
    for (unsigned int alignment = 1; alignment <= 65536; alignment *= 2) {
        for (size_t bytes = 0; bytes < 100; bytes += 33) {
            char *const block = MeMemoryAPI.createAligned(bytes, alignment);
            ck_assert_ptr_nonnull(block);
            ck_assert_uint_eq((uintptr_t)block % alignment, 0);
            memset(block, 1, bytes);
            MeMemoryAPI.destroyAligned(block);
        }
    }
    MeMemoryAPI.destroyAligned(NULL);
}

TEST(resized_memory_keeps_its_contents) {
    char *block = MeMemoryAPI.resize(NULL, 4);
    ck_assert_ptr_nonnull(block);
    memcpy(block, "abc", 4);
    block = MeMemoryAPI.resize(block, 100000);
    ck_assert_ptr_nonnull(block);
    ck_assert_str_eq(block, "abc");
    block = MeMemoryAPI.resize(block, 0);
    ck_assert_ptr_nonnull(block);
    MeMemoryAPI.destroy(block);
}

/* The size is volatile so that the compiler does not notice that it is absurd. */
TEST(impossible_sizes_give_null) {
    volatile size_t absurd = SIZE_MAX;
    ck_assert_ptr_null(MeMemoryAPI.createAligned(absurd, 64));
    ck_assert_ptr_null(MeMemoryAPI.createAligned(absurd - 63, 64));
}

/* ---- functions of the program's own ---- */

static MeMemoryAPIStruct standard;
static int blocks, requests, budget;

static void *countedCreate(size_t bytes) {
    requests++;
    if (budget-- <= 0)
        return NULL;
    blocks++;
    return standard.create(bytes);
}

static void *countedCreateAligned(size_t bytes, unsigned int alignment) {
    requests++;
    if (budget-- <= 0)
        return NULL;
    blocks++;
    return standard.createAligned(bytes, alignment);
}

static void *forbiddenResize(void *const block, size_t bytes) {
    (void)block, (void)bytes;
    ck_abort_msg("Karma called resize");
    return NULL;
}

static void countedDestroy(void *const block) {
    blocks -= block != NULL;
    standard.destroy(block);
}

static void countedDestroyAligned(void *const block) {
    blocks -= block != NULL;
    standard.destroyAligned(block);
}

/* From here to memoryRelease() there are `available` blocks to be had. */
static void memoryCatch(int available) {
    standard = MeMemoryAPI;
    blocks = requests = 0;
    budget = available;
    MeMemoryAPI = (MeMemoryAPIStruct){countedCreate, countedCreateAligned, forbiddenResize, countedDestroy,
                                      countedDestroyAligned};
}

static void memoryRelease(void) {
    MeMemoryAPI = standard;
}

static const char *words[] = {"program", "-gl"};
static const MeProfileTimerMode timer = {kMeProfileCounterModeFlops};

/* Each uses one part of the library, and says whether it got all memory that it wanted. */
static MeBool useOptions(void) {
    MeCommandLineOptions *const options = MeCommandLineOptionsCreate(2, words);
    MeCommandLineOptionsDestroy(options);
    return options != NULL;
}

static MeBool useChunk(void) {
    MeChunk chunk;
    MeChunkInit(&chunk, 16);
    void *const mem = MeChunkGetMem(&chunk, 100);
    MeChunkPutMem(&chunk, mem);
    ck_assert(!MeChunkIsInUse(&chunk));
    ck_assert_int_eq(MeChunkGetCurrentSize(&chunk), mem ? 1024 : 0);
    MeChunkTerm(&chunk);
    return mem != NULL;
}

static MeBool useFixedPool(void) {
    MePool pool;
    const MeBool made = MePoolFixedAPI.init(&pool, 8, 10, 16);
    ck_assert_int_eq(pool.type, made ? MePoolFIXED : MePoolNULL);
    if (made)
        pool.api->destroy(&pool);
    return made;
}

static MeBool useMallocPool(void) {
    MePool pool;
    ck_assert(MePoolMallocAPI.init(&pool, 8, 0, 16));
    const MeBool both = pool.api->getStruct(&pool) != NULL && pool.api->getStruct(&pool) != NULL;
    pool.api->destroy(&pool);
    return both;
}

static MeBool useProfile(void) {
    MeProfileStartTiming(timer, kMeProfileLogAll);
    MeProfileStartSection("a", 0);
    MeProfileStartSection("b", 0);
    MeProfileEndSection("b");
    MeProfileEndSection("a");
    MeProfileStopTiming();
    return caught.fatal == 0;
}

static MeBool useTic(void) {
    ticInit();
    tic("a");
    tic(NULL);
    ticCleanup();
    return caught.fatal == 0;
}

static MeBool (*const uses[])(void) = {useOptions, useChunk, useFixedPool, useMallocPool, useProfile, useTic};
enum { numUses = sizeof uses / sizeof uses[0] };

TEST(all_memory_comes_from_the_api) {
    for (int i = 0; i < numUses; i++) {
        memoryCatch(1000);
        ck_assert(uses[i]());
        memoryRelease();
        ck_assert_int_gt(requests, 0);
        ck_assert_int_eq(blocks, 0);
    }
}

/* With memory for nothing, one block, two ... until it is enough: a fatal error, no crash, nothing lost. */
TEST(out_of_memory_is_a_fatal_error) {
    for (int i = 0; i < numUses; i++) {
        MeBool enough = MEFALSE;
        int failures = 0;
        for (int available = 0; !enough; available++) {
            messages_forget();
            memoryCatch(available);
            enough = uses[i]();
            memoryRelease();
            ck_assert_int_eq(blocks, 0);
            if (!enough) {
                failures++;
                ck_assert_int_gt(caught.fatal, 0);
                ck_assert_ptr_nonnull(strstr(caught.last, "no memory for"));
            }
            ck_assert_int_lt(available, 100);
        }
        ck_assert_int_gt(failures, 0);
    }
    messages_forget();
}

/* A chunk that cannot grow has lost nothing but its size. */
TEST(chunk_recovers_when_there_is_memory_again) {
    MeChunk chunk;
    memoryCatch(1);
    MeChunkInit(&chunk, 16);
    MeChunkPutMem(&chunk, MeChunkGetMem(&chunk, 100));
    ck_assert_ptr_null(MeChunkGetMem(&chunk, 5000));
    ck_assert_int_eq(caught.fatal, 1);
    ck_assert(!MeChunkIsInUse(&chunk));
    budget = 1;
    ck_assert_ptr_nonnull(MeChunkGetMem(&chunk, 5000));
    MeChunkPutMem(&chunk, chunk.mem);
    MeChunkTerm(&chunk);
    memoryRelease();
    ck_assert_int_eq(blocks, 0);
    messages_forget();
}
