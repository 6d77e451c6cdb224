/* Sets: dictionaries whose keys are the items. */
#include "MeSet.h"

#include "MeAssert.h"
#include "MeMath.h"
#include "MeInternal.h"
#include "MeMessage_i.h"
#include <limits.h>
#include <string.h>

static MeBool isSet(const MeSet *s, const char *function) {
    if (!me_isGiven(s, "set", function))
        return MEFALSE;
    MEASSERT((s->dict.count == 0) == (s->dict.root == NULL));
    MEASSERT(s->isCreated || (int)s->dict.count == s->pool.used);
    return METRUE;
}

MeSet *MEAPI MeSetCreate(MeDictCompareFn cmp) {
    if (!me_isGiven((const void *)(size_t)cmp, "comparison", __func__))
        return NULL;
    MeSet *s = MeMemoryTakeZeroed(1, sizeof *s, __func__, "a set");
    if (!s)
        return NULL;
    MeDictInit(&s->dict, INT_MAX, cmp);
    s->isCreated = METRUE;
    return s;
}

/* A stand-in for a missing comparison; the set has no room for items then. */
static int MEAPI compareAsEqual(const void *key1, const void *key2) {
    (void)key1;
    (void)key2;
    return 0;
}

void MEAPI MeSetInit(MeSet *s, MeDictNode *nodemem, int maxnode, MeDictCompareFn cmp) {
    if (!me_isGiven(s, "set", __func__))
        return;
    memset(s, 0, sizeof *s);
    MePoolxInit(&s->pool, nodemem, sizeof(MeDictNode),
                me_isGiven((const void *)(size_t)cmp, "comparison", __func__) ? maxnode : 0);
    MeDictInit(&s->dict, (unsigned long)s->pool.count, cmp ? cmp : compareAsEqual);
    MePoolxUseWithDict(&s->pool, &s->dict);
}

void MEAPI MeSetDestroy(MeSet *s) {
    if (!isSet(s, __func__))
        return;
    MeDictFreeNodes(&s->dict);
    s->next = NULL;
    if (s->isCreated)
        MeMemoryGive(s);
}

int MEAPI MeSetAdd(MeSet *s, void *item) {
    if (!isSet(s, __func__) || MeDictLookup(&s->dict, item))
        return 0;
    if (MeDictIsFull(&s->dict)) {
        MeWarning(1, "MeSetAdd: there are %d items already: raise MeSetInit's maxnode", (int)s->dict.count);
        return 0;
    }
    s->next = NULL;
    return MeDictAllocInsert(&s->dict, item, item);
}

static void *unlinkNode(MeSet *s, MeDictNode *node) {
    if (!node)
        return NULL;
    void *item = MeDictNodeGet(node);
    s->next = NULL;
    MeDictDeleteFree(&s->dict, node);
    return item;
}

int MEAPI MeSetRemove(MeSet *s, void *item) {
    MeDictNode *node = isSet(s, __func__) ? MeDictLookup(&s->dict, item) : NULL;
    if (node)
        unlinkNode(s, node);
    return node != NULL;
}

int MEAPI MeSetContains(MeSet *s, void *item) {
    return isSet(s, __func__) && MeDictLookup(&s->dict, item) != NULL;
}

int MEAPI MeSetSize(MeSet *s) {
    return isSet(s, __func__) ? (int)s->dict.count : 0;
}

int MEAPI MeSetIsFull(MeSet *s) {
    return isSet(s, __func__) && MeDictIsFull(&s->dict);
}

void *MEAPI MeSetPop(MeSet *s) {
    return isSet(s, __func__) ? unlinkNode(s, MeDictLast(&s->dict)) : NULL;
}

void *MEAPI MeSetPopFirst(MeSet *s) {
    return isSet(s, __func__) ? unlinkNode(s, MeDictFirst(&s->dict)) : NULL;
}

void *MEAPI MeSetIteratorNext(MeSet *s) {
    if (!isSet(s, __func__))
        return NULL;
    s->next = s->next ? MeDictNext(&s->dict, s->next) : MeDictFirst(&s->dict);
    return s->next ? MeDictNodeGet(s->next) : NULL;
}
