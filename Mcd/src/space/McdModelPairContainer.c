/* Containers: arrays that a space fills with its pairs. */
#include "McdModelPairContainer.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMessage.h"
#include <string.h>

static MeBool checkContainer(const McdModelPairContainer *c, const char *function) {
    if (c && c->array)
        return METRUE;
    MeWarning(1, "%s: no container", function);
    return MEFALSE;
}

McdModelPairContainer *MEAPI McdModelPairContainerCreate(int size) {
    if (size < 1) {
        MeWarning(1, "McdModelPairContainerCreate: size is %d: it must be 1 or more", size);
        return 0;
    }
    McdModelPairContainer *c = MeMemoryTake(1, sizeof *c + (size_t)size * sizeof(McdModelPair *),
                                            "McdModelPairContainerCreate", "a container of pairs");
    if (c)
        McdModelPairContainerInit(c, (McdModelPair **)(void *)(c + 1), size);
    return c;
}

void MEAPI McdModelPairContainerDestroy(McdModelPairContainer *a) {
    MeMemoryGive(a);
}

void MEAPI McdModelPairContainerInit(McdModelPairContainer *c, McdModelPair **array, int size) {
    if (!c) {
        MeWarning(1, "McdModelPairContainerInit: no container");
        return;
    }
    if (!array || size < 1) {
        MeWarning(1, "McdModelPairContainerInit: no array, or its size, %d, is below 1", size);
        memset(c, 0, sizeof *c);
        return;
    }
    c->array = array;
    c->size = size;
    McdModelPairContainerReset(c);
}

void MEAPI McdModelPairContainerReset(McdModelPairContainer *c) {
    if (!checkContainer(c, "McdModelPairContainerReset"))
        return;
    c->goodbyeFirst = c->goodbyeEnd = 0;
    c->helloFirst = c->helloEnd = c->stayingFirst = c->stayingEnd = (c->size + 1) / 2;
}

MeBool MEAPI McdModelPairContainerInsertHelloPair(McdModelPairContainer *c, McdModelPairID p) {
    if (!checkContainer(c, "McdModelPairContainerInsertHelloPair") || c->helloFirst == c->goodbyeEnd)
        return MEFALSE;
    c->array[--c->helloFirst] = p;
    return METRUE;
}

MeBool MEAPI McdModelPairContainerInsertStayingPair(McdModelPairContainer *c, McdModelPairID p) {
    if (!checkContainer(c, "McdModelPairContainerInsertStayingPair") || c->stayingEnd == c->size)
        return MEFALSE;
    c->array[c->stayingEnd++] = p;
    return METRUE;
}

MeBool MEAPI McdModelPairContainerInsertGoodbyePair(McdModelPairContainer *c, McdModelPairID p) {
    if (!checkContainer(c, "McdModelPairContainerInsertGoodbyePair") || c->goodbyeEnd == c->helloFirst)
        return MEFALSE;
    c->array[c->goodbyeEnd++] = p;
    return METRUE;
}

/* Moves array[first .. last - 1] by `by` places. */
static void movePairs(McdModelPairContainer *c, int first, int last, int by) {
    MEASSERT(first + by >= 0 && first <= last && last + by <= c->size);
    memmove(c->array + first + by, c->array + first, (size_t)(last - first) * sizeof *c->array);
}

void MEAPI McdModelPairContainerRemovePair(McdModelPairContainer *c, McdModelPairID *p) {
    if (!checkContainer(c, "McdModelPairContainerRemovePair"))
        return;
    int at = 0;
    while (at < c->size && c->array + at != p)
        at++;
    if (at >= c->goodbyeFirst && at < c->goodbyeEnd)
        movePairs(c, at + 1, c->goodbyeEnd--, -1);
    else if (at >= c->helloFirst && at < c->helloEnd)
        movePairs(c, c->helloFirst++, at, 1);
    else if (at >= c->stayingFirst && at < c->stayingEnd)
        movePairs(c, at + 1, c->stayingEnd--, -1);
    else
        MeWarning(1, "McdModelPairContainerRemovePair: that is no place of a pair in the container");
}

/* Defines the functions that get a container's pairs of one phase, and their number. */
#define DEFINE_PHASE(Phase, first, end)                                                                                \
    McdModelPair **MEAPI McdModelPairContainerGet##Phase##Array(McdModelPairContainer *c, int *count) {                \
        const MeBool isGood = checkContainer(c, __func__);                                                             \
        if (count)                                                                                                     \
            *count = isGood ? c->end - c->first : 0;                                                                   \
        return isGood ? c->array + c->first : 0;                                                                       \
    }                                                                                                                  \
    int MEAPI McdModelPairContainerGet##Phase##Count(McdModelPairContainer *c) {                                       \
        return checkContainer(c, __func__) ? c->end - c->first : 0;                                                    \
    }
DEFINE_PHASE(Hello, helloFirst, helloEnd)
DEFINE_PHASE(Staying, stayingFirst, stayingEnd)
DEFINE_PHASE(Goodbye, goodbyeFirst, goodbyeEnd)

void MEAPI McdModelPairContainerIteratorInit(McdModelPairContainerIterator *it, McdModelPairContainer *c) {
    if (!it)
        MeWarning(1, "McdModelPairContainerIteratorInit: no iterator");
    else
        it->next = checkContainer(c, "McdModelPairContainerIteratorInit") ? c->helloFirst : 0;
}

void MEAPI McdModelPairContainerPrintStats(McdModelPairContainer *c) {
    if (checkContainer(c, "McdModelPairContainerPrintStats"))
        MeInfo(1, "pairs: %d hello, %d staying, %d goodbye, place for %d", c->helloEnd - c->helloFirst,
               c->stayingEnd - c->stayingFirst, c->goodbyeEnd - c->goodbyeFirst, c->size);
}

void MEAPI McdPairContainerPrintStats(McdModelPairContainer *c) {
    ME_UNDER_OWN_NAME(McdModelPairContainerPrintStats(c));
}
