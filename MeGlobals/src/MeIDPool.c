/* Pools of ids: one bit per id. */
#include "MeIDPool.h"

#include "MeAssert.h"
#include "MeMath.h"
#include "MeInternal.h"
#include "MeMessage_i.h"
#include <limits.h>
#include <string.h>

enum { BITS = 32, MAX = INT_MAX / BITS * BITS }; /* a multiple of the word size, at most INT_MAX */

static MeBool isPool(const MeIDPool *pool, const char *function) {
    if (!me_isGiven(pool, "pool", function))
        return MEFALSE;
    MEASSERT(pool->count >= 0 && pool->firstFree >= 0 && pool->firstFree <= BITS * pool->words);
    return METRUE;
}

static MeBool isTaken(const MeIDPool *pool, int id) {
    return id >= 0 && id / BITS < pool->words && (pool->taken[id / BITS] >> id % BITS & 1);
}

static int countTaken(const MeIDPool *pool) {
    int count = 0;
    for (int id = 0; id < BITS * pool->words; id++)
        count += isTaken(pool, id);
    return count;
}

MeIDPool *MEAPI MeIDPoolCreate(void) {
    return MeMemoryTakeZeroed(1, sizeof(MeIDPool), __func__, "a pool of identifiers");
}

void MEAPI MeIDPoolDestroy(MeIDPool *pool) {
    if (!isPool(pool, __func__))
        return;
    MeMemoryGive(pool->taken);
    MeMemoryGive(pool);
}

void MEAPI MeIDPoolReset(MeIDPool *pool) {
    if (!isPool(pool, __func__))
        return;
    if (pool->words)
        memset(pool->taken, 0, (size_t)pool->words * sizeof *pool->taken);
    pool->firstFree = pool->count = 0;
}

static MeBool growPool(MeIDPool *pool, int words, const char *function) {
    if (words <= pool->words)
        return METRUE;
    if (!MeMemoryGrow(&pool->taken, (size_t)pool->words, (size_t)words, sizeof *pool->taken, function, "identifiers"))
        return MEFALSE;
    memset(pool->taken + pool->words, 0, (size_t)(words - pool->words) * sizeof *pool->taken);
    pool->words = words;
    return METRUE;
}

void MEAPI MeIDPoolCopy(MeIDPool *to, MeIDPool *from) {
    if (!isPool(to, __func__) || !isPool(from, __func__) || to == from || !growPool(to, from->words, __func__))
        return;
    MeIDPoolReset(to);
    if (from->words)
        memcpy(to->taken, from->taken, (size_t)from->words * sizeof *to->taken);
    to->firstFree = from->firstFree;
    to->count = from->count;
}

int MEAPI MeIDPoolRequestID(MeIDPool *pool) {
    if (!isPool(pool, __func__))
        return -1;
    const int id = pool->firstFree;
    if (id >= MAX) {
        MeWarning(1, "MeIDPoolRequestID: all %d numbers are taken", MAX);
        return -1;
    }
    if (id / BITS >= pool->words && !growPool(pool, MeMIN(MeMAX(2 * pool->words, 1), MAX / BITS), __func__))
        return -1;
    MEASSERT(!isTaken(pool, id));
    pool->taken[id / BITS] |= (MeU32)1 << id % BITS;
    pool->count++;
    while (pool->firstFree < BITS * pool->words && isTaken(pool, pool->firstFree))
        pool->firstFree++;
    MEASSERT(isTaken(pool, id) && !isTaken(pool, pool->firstFree));
    return id;
}

void MEAPI MeIDPoolReturnID(MeIDPool *pool, int id) {
    if (!isPool(pool, __func__))
        return;
    if (!isTaken(pool, id)) {
        MeWarning(1, "MeIDPoolReturnID: %d is not taken", id);
        return;
    }
    pool->taken[id / BITS] &= ~((MeU32)1 << id % BITS);
    pool->count--;
    pool->firstFree = MeMIN(pool->firstFree, id);
    MEVALIDATE(countTaken(pool) == pool->count);
}

MeBool MEAPI MeIDPoolIsEmpty(MeIDPool *pool) {
    return isPool(pool, __func__) && pool->count >= MAX;
}
