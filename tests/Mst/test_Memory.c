/* The memory contract of MeMemory.h, for a whole universe: only the program's functions, in pairs, no resize, no nulls,
 * nothing left; and a failing allocation is a fatal error, and then nothing worse. */
#include "whole.h"
#include <stdint.h>

/* ---- the program's functions, which know their blocks ------------------------------------------------------------ */

enum { ROOM = 1 << 16, NONE = 0, PLAIN = 1, ALIGNED = 2 };

typedef struct Known {
    const void *block;
    int kind; /* NONE with a block: it was destroyed */
} Known;

static struct {
    Known known[ROOM];
    int used; /* places */
    int live, calls;
    int foreign, mismatched, nulls, resizes; /* what must not be */
    int failFrom, failTo;                    /* calls that find no memory; 0: none */
    int failed;
} memory;

static Known *placeOf(const void *block) {
    size_t at = (size_t)((uintptr_t)block * 0x9e3779b97f4a7c15ull >> 48);
    while (memory.known[at].block && memory.known[at].block != block)
        at = (at + 1) % ROOM;
    return &memory.known[at];
}

static MeBool fails(void) {
    memory.calls++;
    const MeBool isToFail = memory.failFrom && memory.calls >= memory.failFrom && memory.calls <= memory.failTo;
    memory.failed += isToFail;
    return isToFail;
}

static void *enter(void *block, int kind) {
    Known *place = placeOf(block);
    memory.used += !place->block;
    ck_assert_int_lt(memory.used, ROOM / 2);
    ck_assert(place->kind == NONE);
    place->block = block;
    place->kind = kind;
    memory.live++;
    return block;
}

/* With the same rubbish in it every time. */
static void *MEAPI create(size_t bytes) {
    return fails() ? NULL : enter(memset(malloc(bytes ? bytes : 1), 0xa5, bytes), PLAIN);
}

static void *MEAPI createAligned(size_t bytes, unsigned int alignment) {
    const size_t whole = (bytes + alignment - 1) / alignment * alignment;
    return fails() ? NULL : enter(memset(aligned_alloc(alignment, whole), 0xa5, bytes), ALIGNED);
}

static void *MEAPI resize(void *const block, size_t bytes) {
    (void)block, (void)bytes;
    memory.resizes++;
    return NULL;
}

static void leave(void *const block, int kind) {
    Known *place = placeOf(block);
    memory.nulls += !block;
    memory.foreign += block && place->kind == NONE;
    memory.mismatched += block && place->kind != NONE && place->kind != kind;
    if (!block || place->kind == NONE)
        return;
    place->kind = NONE;
    memory.live--;
    free(block);
}

static void MEAPI destroy(void *const block) {
    leave(block, PLAIN);
}

static void MEAPI destroyAligned(void *const block) {
    leave(block, ALIGNED);
}

static MeMemoryAPIStruct before;

static void replaceAll(int failFrom, int failTo) {
    memset(&memory, 0, sizeof memory);
    memory.failFrom = failFrom;
    memory.failTo = failTo;
    before = MeMemoryAPI;
    MeMemoryAPI = (MeMemoryAPIStruct){create, createAligned, resize, destroy, destroyAligned};
}

static void putBack(void) {
    MeMemoryAPI = before;
    ck_assert_int_eq(memory.nulls, 0);
    ck_assert_int_eq(memory.foreign, 0);
    ck_assert_int_eq(memory.mismatched, 0);
    ck_assert_int_eq(memory.resizes, 0);
    ck_assert_int_eq(memory.live, 0);
}

/* ---- the contract ------------------------------------------------------------------------------------------------ */

static Whole whole;

static MstUniverseSizes fixedSizes(void) {
    return (MstUniverseSizes){100, 1000, 0, 100, 1000, 100, 10, 1, 1};
}

/* What was made is there, and moves. */
static void assertWhole(void) {
    MdtReport report;
    int count;
    MstUniverseGetEvents(whole.u, &count);
    MdtWorldGetReport(whole.u->world, &report);
    ck_assert_int_gt(count, 0);
    ck_assert_int_gt(report.constraints, 10);
    ck_assert_int_eq(MdtWorldGetTotalBodies(whole.u->world), 17 + whole.count);
    ck_assert_int_eq(whole.count, 10);
}

static void runWhole(const MstUniverseSizes *sizes) {
    replaceAll(0, 0);
    ck_assert(whole_begin(&whole, sizes));
    whole_run(&whole, 15);
    assert_silent();
    assertWhole();
    whole_end(&whole);
    ck_assert_int_gt(memory.calls, 100);
    putBack();
}

TEST(a_universe_takes_all_memory_from_the_programs_functions_and_returns_it) {
    const MstUniverseSizes fixed = fixedSizes();
    runWhole(&fixed);
}

TEST(so_does_one_that_grows) {
    runWhole(&MstUniverseGrowingSizes);
}

/* What is left in it goes with it. */
TEST(models_with_transforms_of_their_own_are_reset_and_destroyed_without_nulls) {
    replaceAll(0, 0);
    ck_assert(whole_begin(&whole, NULL));
    const McdModelID m = whole_add(&whole, McdBoxCreate(whole.u->frame, 1, 1, 1), 0, 0, 3);
    MeMatrix4 aside;
    MeMatrix4TMMakeIdentity(aside);
    for (int i = 0; i < 3; i++)
        McdModelSetRelativeTransform(m, aside);
    McdModelReset(m);
    McdModelSetBody(m, 0);
    whole_end(&whole);
    putBack();
}

/* ---- memory that fails ------------------------------------------------------------------------------------------- */

static void assertFinite(void) {
    for (int i = 0; i < whole.count; i++) {
        MeVector3 p;
        const MdtBodyID b = McdModelGetBody(whole.model[i]);
        MdtBodyGetPosition(b, p);
        ck_assert(MeRealIsValid(p[0]) && MeRealIsValid(p[1]) && MeRealIsValid(p[2]));
    }
}

static int fatals, nameless;

static void MEAPI_CDECL onFatal(const int level, const char *const format, va_list ap) {
    char text[300];
    (void)level;
    vsnprintf(text, sizeof text, format, ap);
    fatals++;
    nameless += !strstr(text, "memory");
}

static void MEAPI_CDECL ignore(const int level, const char *const format, va_list ap) {
    (void)level, (void)format, (void)ap;
}

/* Runs the universe while calls `from` to `to` find no memory. False: there were not so many. */
static MeBool survives(const MstUniverseSizes *sizes, int from, int to) {
    const MeHandler fatal = MeSetFatalErrorHandler(onFatal), warning = MeSetWarningHandler(ignore);
    fatals = nameless = 0;
    replaceAll(from, to);
    if (whole_begin(&whole, sizes)) {
        whole_run(&whole, 1);
        assertFinite();
        whole_end(&whole);
    }
    const int failed = memory.failed;
    putBack();
    MeSetFatalErrorHandler(fatal);
    MeSetWarningHandler(warning);
    ck_assert_msg(fatals >= failed, "from allocation %d on: %d failed, %d fatal errors", from, failed, fatals);
    ck_assert_int_eq(nameless, 0);
    return failed > 0;
}

/* Every n-th in sanitized builds, where this takes minutes. */
#ifdef TEST_IS_SLOW
enum { EVERY = 7 };
#else
enum { EVERY = 1 };
#endif

static int survivesEach(const MstUniverseSizes *sizes, int more) {
    int n = 1;
    while (survives(sizes, n, more ? n + more : n))
        n += EVERY;
    return n;
}

TEST(every_failing_allocation_is_a_fatal_error_and_nothing_worse) {
    const MstUniverseSizes fixed = fixedSizes();
    ck_assert_int_gt(survivesEach(&fixed, 0), 150);
}

TEST(so_it_is_where_the_universe_grows) {
    ck_assert_int_gt(survivesEach(&MstUniverseGrowingSizes, 0), 200);
}

/* 'A failed third allocation' crashed in MdtKeaCacheCreate, which was not looked at. */
TEST(a_universe_survives_that_there_is_no_memory_from_somewhere_on) {
    ck_assert_int_gt(survivesEach(&MstUniverseGrowingSizes, 1000000), 200);
}
