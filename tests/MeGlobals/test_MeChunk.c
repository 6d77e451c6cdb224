/* Chunks: growth, one piece at a time, modes, misuse. */
#include "karma_test.h"

#include "MeChunk.h"

#include <limits.h>
#include <stdint.h>

static MeChunk chunk;

static void init(void) {
    MeChunkInit(&chunk, 64);
}

static void term(void) {
    MeChunkTerm(&chunk);
    assert_silent();
}

TEST(new_chunk_is_empty) {
    init();
    ck_assert_int_eq(MeChunkGetAlignment(&chunk), 64);
    ck_assert_int_eq(MeChunkGetCurrentSize(&chunk), 0);
    ck_assert_int_eq(MeChunkGetMaxSize(&chunk), 0);
    ck_assert(!MeChunkIsInUse(&chunk));
    term();
}

TEST(chunk_grows_by_doubling_from_1024) {
    static const struct {
        int wanted, size, max;
    } steps[] = {{0, 1024, 0},        {10, 1024, 10},     {1024, 1024, 1024},   {1025, 2048, 1025},
                 {9000, 16384, 9000}, {100, 16384, 9000}, {16384, 16384, 16384}};
    init();
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        char *const mem = MeChunkGetMem(&chunk, steps[i].wanted);
        ck_assert_ptr_nonnull(mem);
        ck_assert_uint_eq((uintptr_t)mem % 64, 0);
        memset(mem, 1, (size_t)steps[i].wanted);
        ck_assert(MeChunkIsInUse(&chunk));
        ck_assert_int_eq(MeChunkGetCurrentSize(&chunk), steps[i].size);
        ck_assert_int_eq(MeChunkGetMaxSize(&chunk), steps[i].max);
        MeChunkPutMem(&chunk, mem);
        ck_assert(!MeChunkIsInUse(&chunk));
    }
    term();
}

TEST(kept_memory_is_the_same_again) {
    init();
    void *const mem = MeChunkGetMem(&chunk, 500);
    MeChunkPutMem(&chunk, mem);
    ck_assert_ptr_eq(MeChunkGetMem(&chunk, 700), mem);
    MeChunkPutMem(&chunk, mem);
    term();
}

TEST(memory_is_freed_on_put) {
    init();
    MeChunkSetMode(&chunk, kMeChunkModeFreeOnPut);
    MeChunkPutMem(&chunk, MeChunkGetMem(&chunk, 5000));
    ck_assert_int_eq(MeChunkGetCurrentSize(&chunk), 0);
    ck_assert_int_eq(MeChunkGetMaxSize(&chunk), 5000);
    MeChunkSetMode(&chunk, kMeChunkModeKeepOnPut);
    MeChunkPutMem(&chunk, MeChunkGetMem(&chunk, 100));
    ck_assert_int_eq(MeChunkGetCurrentSize(&chunk), 1024);
    term();
}

TEST(initial_size_is_reserved) {
    init();
    MeChunkSetAuto(&chunk, 3000);
    ck_assert_int_eq(MeChunkGetCurrentSize(&chunk), 4096);
    ck_assert_int_eq(MeChunkGetMaxSize(&chunk), 0);
    ck_assert(!MeChunkIsInUse(&chunk));
    void *const reserved = chunk.mem;
    MeChunkSetAuto(&chunk, 100);
    ck_assert_ptr_eq(MeChunkGetMem(&chunk, 4096), reserved);
    MeChunkPutMem(&chunk, reserved);
    term();
}

TEST(one_piece_at_a_time) {
    init();
    void *const mem = MeChunkGetMem(&chunk, 10);
    ck_assert_ptr_null(MeChunkGetMem(&chunk, 10));
    assert_warned("MeChunkGetMem: the memory is in use");
    MeChunkSetAuto(&chunk, 5000);
    assert_warned("MeChunkSetAuto: the memory is in use");
    ck_assert_int_eq(MeChunkGetCurrentSize(&chunk), 1024);
    MeChunkPutMem(&chunk, mem);
    assert_refused(MeChunkPutMem, &chunk, mem);
    term();
}

TEST(foreign_memory_is_not_taken) {
    char other[16];
    init();
    void *const mem = MeChunkGetMem(&chunk, 10);
    assert_refused(MeChunkPutMem, &chunk, other);
    MeChunkPutMem(&chunk, NULL);
    ck_assert(MeChunkIsInUse(&chunk));
    MeChunkPutMem(&chunk, mem);
    term();
}

TEST(negative_sizes_warn) {
    init();
    ck_assert_ptr_null(MeChunkGetMem(&chunk, -1));
    assert_warned("size -1");
    assert_none(MeChunkGetMem, &chunk, INT_MIN);
    assert_refused(MeChunkSetAuto, &chunk, -1);
    ck_assert(!MeChunkIsInUse(&chunk));
    term();
}

TEST(term_frees_what_is_out) {
    init();
    ck_assert_ptr_nonnull(MeChunkGetMem(&chunk, 10));
    assert_refused(MeChunkTerm, &chunk);
    ck_assert(!MeChunkIsInUse(&chunk));
    ck_assert_int_eq(MeChunkGetAlignment(&chunk), 64);
    MeChunkPutMem(&chunk, MeChunkGetMem(&chunk, 10)); /* as good as new */
    term();
}

TEST(bad_alignments_warn) {
    static const int bad[] = {0, -16, 24, INT_MIN};
    for (int i = 0; i < 4; i++) {
        MeChunkInit(&chunk, bad[i]);
        assert_warned("alignment");
        ck_assert_int_eq(MeChunkGetAlignment(&chunk), 16);
    }
}

TEST(bad_modes_warn) {
    init();
    MeChunkSetMode(&chunk, (kMeChunkMode)3);
    assert_warned("3 is not a mode");
    ck_assert_int_eq(chunk.mode, kMeChunkModeKeepOnPut);
    term();
}

TEST(null_chunks_warn) {
    assert_refused(MeChunkInit, NULL, 16);
    assert_refused(MeChunkTerm, NULL);
    assert_refused(MeChunkSetMode, NULL, kMeChunkModeKeepOnPut);
    assert_refused(MeChunkSetAuto, NULL, 1);
    assert_none(MeChunkGetMem, NULL, 1);
    assert_refused(MeChunkPutMem, NULL, &chunk);
    assert_none(MeChunkIsInUse, NULL);
    assert_none(MeChunkGetCurrentSize, NULL);
    assert_none(MeChunkGetMaxSize, NULL);
    assert_none(MeChunkGetAlignment, NULL);
}
