/* Dictionaries: a treap (Seidel, Aragon), a search tree by keys and a heap by random priorities. Its depth is that of a
 * tree with nodes inserted in random order, O(log n), for any order of insertions. The random numbers are the same in
 * every run. */
#include "MeDict.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMessage_i.h"
#include <string.h>

/* ---- life ------------------------------------------------------------------------------------------------------ */

MeDict *MEAPI MeDictInit(MeDict *dict, unsigned long maxcount, MeDictCompareFn compare) {
    if (!me_isGiven(dict, "dictionary", __func__) || !me_isGiven((const void *)(size_t)compare, "comparison", __func__))
        return NULL;
    memset(dict, 0, sizeof *dict);
    dict->maxCount = maxcount;
    dict->compare = compare;
    dict->seed = 1;
    return dict;
}

MeDict *MEAPI MeDictCreate(unsigned long maxcount, MeDictCompareFn compare) {
    if (!me_isGiven((const void *)(size_t)compare, "comparison", __func__))
        return NULL;
    MeDict *dict = MeMemoryTake(1, sizeof *dict, __func__, "a dictionary");
    if (!dict)
        return NULL;
    MeDictInit(dict, maxcount, compare);
    dict->isCreated = METRUE;
    return dict;
}

void MEAPI MeDictInitLike(MeDict *dict, const MeDict *like) {
    if (!me_isGiven(dict, "dictionary", __func__) || !me_isGiven(like, "dictionary to be like", __func__))
        return;
    const MeDict model = *like; /* `like` may be `dict` */
    memset(dict, 0, sizeof *dict);
    dict->maxCount = model.maxCount;
    dict->compare = model.compare;
    dict->alloc = model.alloc;
    dict->free = model.free;
    dict->context = model.context;
    dict->allowsDupes = model.allowsDupes;
    dict->seed = 1;
}

int MEAPI MeDictSimilar(const MeDict *dict1, const MeDict *dict2) {
    return me_isGiven(dict1, "dictionary", __func__) && me_isGiven(dict2, "second dictionary", __func__) &&
           dict1->compare == dict2->compare && dict1->alloc == dict2->alloc && dict1->free == dict2->free &&
           dict1->context == dict2->context && !dict1->allowsDupes == !dict2->allowsDupes;
}

void MEAPI MeDictDestroy(MeDict *dict) {
    if (!me_isGiven(dict, "dictionary", __func__))
        return;
    if (!dict->isCreated) {
        MeWarning(1, "MeDictDestroy: MeDictCreate has not made this dictionary");
        return;
    }
    if (dict->count)
        MeWarning(1, "MeDictDestroy: there are %lu nodes in it", dict->count);
    while (dict->root)
        MeDictDelete(dict, dict->root);
    MeMemoryGive(dict);
}

void MEAPI MeDictAllowDupes(MeDict *dict) {
    if (me_isGiven(dict, "dictionary", __func__))
        dict->allowsDupes = METRUE;
}

void MEAPI MeDictSetAllocator(MeDict *dict, MeDictAllocFn alloc, MeDictFreeFn freeNode, void *context) {
    if (!me_isGiven(dict, "dictionary", __func__))
        return;
    if (!alloc != !freeNode) {
        MeWarning(1, "MeDictSetAllocator: one of the two functions is null; nothing is changed");
        return;
    }
    dict->alloc = alloc;
    dict->free = freeNode;
    dict->context = context;
}

/* ---- nodes ----------------------------------------------------------------------------------------------------- */

MeDictNode *MEAPI MeDictNodeInit(MeDictNode *node, void *data) {
    if (!me_isGiven(node, "node", __func__))
        return NULL;
    memset(node, 0, sizeof *node);
    node->data = data;
    return node;
}

MeDictNode *MEAPI MeDictNodeCreate(void *data) {
    MeDictNode *node = MeMemoryTake(1, sizeof *node, __func__, "a node");
    return node ? MeDictNodeInit(node, data) : NULL;
}

void MEAPI MeDictNodeDestroy(MeDictNode *node) {
    if (!me_isGiven(node, "node", __func__))
        return;
    if (node->dict)
        MeWarning(1, "MeDictNodeDestroy: the node is in a dictionary: see MeDictDelete");
    else
        MeMemoryGive(node);
}

void *MEAPI MeDictNodeGet(MeDictNode *node) {
    return me_isGiven(node, "node", __func__) ? node->data : NULL;
}

void MEAPI MeDictNodePut(MeDictNode *node, void *data) {
    if (me_isGiven(node, "node", __func__))
        node->data = data;
}

const void *MEAPI MeDictNodeGetKey(MeDictNode *node) {
    return me_isGiven(node, "node", __func__) ? node->key : NULL;
}

int MEAPI MeDictNodeIsInADict(MeDictNode *node) {
    return me_isGiven(node, "node", __func__) && node->dict;
}

/* ---- the tree -------------------------------------------------------------------------------------------------- */

/* The pointer that refers to a node: its parent's or the root. */
static MeDictNode **linkTo(MeDict *dict, MeDictNode *node) {
    MeDictNode *parent = node->parent;
    return parent ? &parent->child[parent->child[1] == node] : &dict->root;
}

/* Tree rotation: a node takes the place of its parent, which becomes its child on the other side. */
static void rotateUp(MeDict *dict, MeDictNode *node) {
    MeDictNode *parent = node->parent;
    const int side = parent->child[1] == node;
    MeDictNode *inner = node->child[!side];
    *linkTo(dict, parent) = node;
    node->parent = parent->parent;
    node->child[!side] = parent;
    parent->parent = node;
    parent->child[side] = inner;
    if (inner)
        inner->parent = parent;
}

/* A random priority by Knuth's linear congruential generator, with the upper half mixed into the lower one. */
static MeU32 drawPriority(MeDict *dict) {
    dict->seed = dict->seed * 1664525u + 1013904223u;
    return dict->seed ^ dict->seed >> 16;
}

/* Inserts a node as a leaf, then rotates it up until its priority is at most its parent's. */
static void insertLeaf(MeDict *dict, MeDictNode *node, MeDictNode *parent, MeDictNode **place) {
    MEASSERT(*place == NULL);
    *place = node;
    node->parent = parent;
    node->priority = drawPriority(dict);
    while (node->parent && node->parent->priority < node->priority)
        rotateUp(dict, node);
}

static void insertNode(MeDict *dict, MeDictNode *node) {
    MeDictNode **place = &dict->root, *parent = NULL;
    while (*place) {
        parent = *place;
        place = &parent->child[dict->compare(node->key, parent->key) >= 0];
    }
    insertLeaf(dict, node, parent, place);
}

/* Rotates a node down until it is a leaf, then removes it. */
static void removeNode(MeDict *dict, MeDictNode *node) {
    MEASSERT(dict->count > 0 && dict->root != NULL);
    while (node->child[0] || node->child[1]) {
        MeDictNode *left = node->child[0], *right = node->child[1];
        rotateUp(dict, !left || (right && right->priority > left->priority) ? right : left);
    }
    *linkTo(dict, node) = NULL;
    node->parent = NULL;
}

static MeDictNode *extremeNode(MeDictNode *node, int side) {
    while (node && node->child[side])
        node = node->child[side];
    return node;
}

static MeDictNode *neighbour(MeDictNode *node, int side) {
    if (node->child[side])
        return extremeNode(node->child[side], !side);
    while (node->parent && node->parent->child[side] == node)
        node = node->parent;
    return node->parent;
}

/* The last node whose key is before (orEqual: not after) the given one; null if there is none. */
static MeDictNode *lastBefore(MeDict *dict, const void *key, MeBool orEqual) {
    MeDictNode *found = NULL;
    for (MeDictNode *node = dict->root; node;) {
        const int order = dict->compare(node->key, key);
        const MeBool isBefore = orEqual ? order <= 0 : order < 0;
        found = isBefore ? node : found;
        node = node->child[isBefore];
    }
    return found;
}

/* ---- in and out ------------------------------------------------------------------------------------------------ */

static MeBool mayInsert(MeDict *dict, const MeDictNode *node, const char *function) {
    if (node->dict)
        MeWarning(1, "%s: the node is in a dictionary already", function);
    else if (dict->count >= dict->maxCount)
        MeWarning(1, "%s: there are %lu nodes already: raise MeDictInit's maxcount", function, dict->count);
    else
        return METRUE;
    return MEFALSE;
}

static void initNodeInDict(MeDict *dict, MeDictNode *node, const void *key) {
    node->child[0] = node->child[1] = NULL;
    node->key = key;
    node->dict = dict;
    dict->count++;
    MEASSERT(dict->count <= dict->maxCount);
}

void MEAPI MeDictInsert(MeDict *dict, MeDictNode *node, const void *key) {
    if (!me_isGiven(dict, "dictionary", __func__) || !me_isGiven(node, "node", __func__) ||
        !mayInsert(dict, node, __func__))
        return;
    if (!dict->allowsDupes && MeDictLookup(dict, key)) {
        MeWarning(1, "MeDictInsert: there is a node with that key: see MeDictAllowDupes");
        return;
    }
    initNodeInDict(dict, node, key);
    insertNode(dict, node);
}

static void freeNode(MeDict *dict, MeDictNode *node) {
    if (dict->free)
        dict->free(node, dict->context);
    else
        MeDictNodeDestroy(node);
}

int MEAPI MeDictAllocInsert(MeDict *dict, const void *key, void *data) {
    if (!me_isGiven(dict, "dictionary", __func__))
        return 0;
    MeDictNode *node = dict->alloc ? dict->alloc(dict->context) : MeDictNodeCreate(data);
    if (!node)
        return 0;
    node->data = data;
    MeDictInsert(dict, node, key);
    const MeBool isIn = node->dict == dict;
    if (!isIn)
        freeNode(dict, node);
    return isIn;
}

MeDictNode *MEAPI MeDictDelete(MeDict *dict, MeDictNode *node) {
    if (!me_isGiven(dict, "dictionary", __func__) || !me_isGiven(node, "node", __func__))
        return NULL;
    if (node->dict != dict) {
        MeWarning(1, "MeDictDelete: the node is not in this dictionary");
        return NULL;
    }
    removeNode(dict, node);
    node->dict = NULL;
    node->key = NULL;
    dict->count--;
    return node;
}

void MEAPI MeDictDeleteFree(MeDict *dict, MeDictNode *node) {
    MeBool isOut;
    ME_UNDER_OWN_NAME(isOut = MeDictDelete(dict, node) != 0);
    if (isOut)
        freeNode(dict, node);
}

void MEAPI MeDictFreeNodes(MeDict *dict) {
    while (me_isGiven(dict, "dictionary", __func__) && dict->root)
        MeDictDeleteFree(dict, dict->root);
}

void MEAPI MeDictFree(MeDict *dict) {
    if (me_isGiven(dict, "dictionary", __func__))
        MeDictFreeNodes(dict);
}

void MEAPI MeDictMerge(MeDict *dict, MeDict *source) {
    if (!me_isGiven(dict, "dictionary", __func__) || !me_isGiven(source, "source", __func__) || dict == source)
        return;
    if (!MeDictSimilar(dict, source)) {
        MeWarning(1, "MeDictMerge: the dictionaries are not similar: see MeDictSimilar");
        return;
    }
    for (MeDictNode *node = extremeNode(source->root, 0), *next; node; node = next) {
        const void *key = node->key;
        next = neighbour(node, 1);
        if (!dict->allowsDupes && MeDictLookup(dict, key))
            continue;
        if (dict->count >= dict->maxCount) {
            MeWarning(1, "MeDictMerge: there are %lu nodes already: raise MeDictInit's maxcount", dict->count);
            return;
        }
        MeDictDelete(source, node);
        MeDictInsert(dict, node, key);
    }
    MEVALIDATE(MeDictVerify(dict) && MeDictVerify(source));
}

void MEAPI MeDictLoadBegin(MeDictLoad *load, MeDict *dict) {
    if (!me_isGiven(load, "load", __func__) || !me_isGiven(dict, "dictionary", __func__))
        return;
    if (dict->count)
        MeWarning(1, "MeDictLoadBegin: there are %lu nodes in the dictionary", dict->count);
    load->dict = dict->count ? NULL : dict;
    load->last = NULL;
}

void MEAPI MeDictLoadNext(MeDictLoad *load, MeDictNode *node, const void *key) {
    if (!me_isGiven(load, "load", __func__) ||
        !me_isGiven(load->dict, "empty dictionary: see MeDictLoadBegin", __func__) ||
        !me_isGiven(node, "node", __func__) || !mayInsert(load->dict, node, __func__))
        return;
    MeDict *dict = load->dict;
    MeDictNode *last = load->last;
    const int order = last ? dict->compare(last->key, key) : -1;
    if (order > 0 || (order == 0 && !dict->allowsDupes)) {
        MeWarning(1, "MeDictLoadNext: the key is not after that of the last node");
        return;
    }
    MEASSERT(last == extremeNode(dict->root, 1));
    initNodeInDict(dict, node, key);
    insertLeaf(dict, node, last, last ? &last->child[1] : &dict->root);
    load->last = node;
}

void MEAPI MeDictLoadEnd(MeDictLoad *load) {
    if (!me_isGiven(load, "load", __func__))
        return;
    MEVALIDATE(!load->dict || MeDictVerify(load->dict));
    load->dict = NULL;
    load->last = NULL;
}

/* ---- finding --------------------------------------------------------------------------------------------------- */

MeDictNode *MEAPI MeDictLookup(MeDict *dict, const void *key) {
    if (!me_isGiven(dict, "dictionary", __func__))
        return NULL;
    MeDictNode *node = MeDictLowerBound(dict, key);
    return node && dict->compare(node->key, key) == 0 ? node : NULL;
}

MeDictNode *MEAPI MeDictLowerBound(MeDict *dict, const void *key) {
    if (!me_isGiven(dict, "dictionary", __func__))
        return NULL;
    MeDictNode *before = lastBefore(dict, key, MEFALSE);
    return before ? neighbour(before, 1) : extremeNode(dict->root, 0);
}

MeDictNode *MEAPI MeDictUpperBound(MeDict *dict, const void *key) {
    return me_isGiven(dict, "dictionary", __func__) ? lastBefore(dict, key, METRUE) : NULL;
}

MeDictNode *MEAPI MeDictFirst(MeDict *dict) {
    return me_isGiven(dict, "dictionary", __func__) ? extremeNode(dict->root, 0) : NULL;
}

MeDictNode *MEAPI MeDictLast(MeDict *dict) {
    return me_isGiven(dict, "dictionary", __func__) ? extremeNode(dict->root, 1) : NULL;
}

static MeDictNode *checkedNeighbour(MeDict *dict, MeDictNode *node, int side, const char *function) {
    if (!me_isGiven(dict, "dictionary", function) || !me_isGiven(node, "node", function))
        return NULL;
    if (node->dict == dict)
        return neighbour(node, side);
    MeWarning(1, "%s: the node is not in this dictionary", function);
    return NULL;
}

MeDictNode *MEAPI MeDictNext(MeDict *dict, MeDictNode *node) {
    return checkedNeighbour(dict, node, 1, __func__);
}

MeDictNode *MEAPI MeDictPrev(MeDict *dict, MeDictNode *node) {
    return checkedNeighbour(dict, node, 0, __func__);
}

unsigned long MEAPI MeDictCount(MeDict *dict) {
    return me_isGiven(dict, "dictionary", __func__) ? dict->count : 0;
}

int MEAPI MeDictIsEmpty(MeDict *dict) {
    return me_isGiven(dict, "dictionary", __func__) && dict->count == 0;
}

int MEAPI MeDictIsFull(MeDict *dict) {
    return me_isGiven(dict, "dictionary", __func__) && dict->count >= dict->maxCount;
}

int MEAPI MeDictContains(MeDict *dict, MeDictNode *node) {
    return me_isGiven(dict, "dictionary", __func__) && me_isGiven(node, "node", __func__) && node->dict == dict;
}

void MEAPI MeDictProcess(MeDict *dict, void *context, MeDictProcessFn f) {
    if (!me_isGiven(dict, "dictionary", __func__) || !me_isGiven((const void *)(size_t)f, "function", __func__))
        return;
    for (MeDictNode *node = extremeNode(dict->root, 0), *next; node; node = next) {
        next = neighbour(node, 1);
        f(dict, node, context);
    }
}

/* ---- checking -------------------------------------------------------------------------------------------------- */

static MeBool areLinksValid(const MeDict *dict, const MeDictNode *node) {
    for (int side = 0; side < 2; side++) {
        const MeDictNode *child = node->child[side];
        if (child && (child->parent != node || child->priority > node->priority))
            return MEFALSE;
    }
    return node->dict == dict;
}

int MEAPI MeDictVerify(MeDict *dict) {
    unsigned long count = 0;
    if (!me_isGiven(dict, "dictionary", __func__))
        return 0;
    for (MeDictNode *node = extremeNode(dict->root, 0), *last = NULL; node; last = node, node = neighbour(node, 1)) {
        const int order = last ? dict->compare(last->key, node->key) : -1;
        if (!areLinksValid(dict, node) || order > 0 || (order == 0 && !dict->allowsDupes))
            return 0;
        count++;
    }
    return count == dict->count;
}
