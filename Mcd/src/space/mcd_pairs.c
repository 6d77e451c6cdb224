/* Links and pairs of a space: the broad phase's candidates, and the lists of hello, staying and goodbye pairs. */
#include "space/mcd_space_i.h"
#include "McdInteractions.h"
#include "McdInternal.h"
#include "MeInternal.h"
#include <stdio.h>
#include <string.h>

/* ---- memory ------------------------------------------------------------------------------------------------------ */

static const char caller[] = "McdSpaceEndChanges";

/* Ensures room for at least `needed` elements. False, after MeFatalError, if there is no memory; then nothing is
 * changed. */
static MeBool reserve(void *array, int *room, int needed, size_t size, const char *what) {
    int more = *room ? *room : 64;
    while (more < needed)
        more *= 2;
    if (*room >= needed)
        return METRUE;
    if (!MeMemoryGrow(array, (size_t)*room, (size_t)more, size, caller, what))
        return MEFALSE;
    *room = more;
    return METRUE;
}

static MeBool reserveList(McdPairList *list, int needed) {
    return reserve(&list->entry, &list->max, needed, sizeof *list->entry, "lists of pairs");
}

static void listAdd(McdPairList *list, const McdPairEntry *entry) {
    MEASSERT(list->count < list->max);
    list->entry[list->count++] = *entry;
}

static MeBool precedes(const McdPairEntry *a, const McdPairEntry *b) {
    return a->order2 != b->order2 ? a->order2 < b->order2 : a->order1 < b->order1;
}

/* A step of heapsort: moves an entry down in the heap until none of its children follows it in the order. */
static void siftDown(McdPairEntry *entry, int at, int count) {
    const McdPairEntry moved = entry[at];
    for (int child = 2 * at + 1; child < count; child = 2 * at + 1) {
        if (child + 1 < count && precedes(&entry[child], &entry[child + 1]))
            child++;
        if (!precedes(&moved, &entry[child]))
            break;
        entry[at] = entry[child];
        at = child;
    }
    entry[at] = moved;
}

static MeBool isSorted(const McdPairList *list) {
    for (int i = 1; i < list->count; i++)
        if (precedes(&list->entry[i], &list->entry[i - 1]))
            return MEFALSE;
    return METRUE;
}

/* Sorts by heapsort: in place, without allocation. */
static void listSort(McdPairList *list) {
    McdPairEntry *entry = list->entry;
    for (int i = list->count / 2 - 1; i >= 0; i--)
        siftDown(entry, i, list->count);
    for (int last = list->count - 1; last > 0; last--) {
        const McdPairEntry greatest = entry[0];
        entry[0] = entry[last];
        entry[last] = greatest;
        siftDown(entry, 0, last);
    }
    MEVALIDATE(isSorted(list));
}

/* Reserves all lists of pairs; a pair may be in each of them once. */
static MeBool reserveLists(McdSpace *s, int pairs) {
    return reserveList(&s->hello, pairs) && reserveList(&s->staying, pairs) && reserveList(&s->goodbye, pairs) &&
           reserveList(&s->silenced, pairs) && reserveList(&s->woken, pairs);
}

/* The size of a block of pair records: that of all earlier blocks together, plus that of the first. As with arrays
 * that double, a space whose number of pairs stays within a factor of two allocates nothing. */
static int sizeOfBlock(int block) {
    return MCD_PAIR_BLOCK << block;
}

static MeBool makePairBlock(McdSpace *s) {
    const int size = sizeOfBlock(s->blockCount), before = size - MCD_PAIR_BLOCK; /* records in all earlier blocks */
    if (s->blockCount == MCD_PAIR_BLOCKS || !reserveLists(s, before + size))
        return MEFALSE;
    McdPairRecord *record = MeMemoryTakeAligned((size_t)size, sizeof *record, ME_CACHE_LINE, caller, "pairs");
    if (!record)
        return MEFALSE;
    memset(record, 0, (size_t)size * sizeof *record);
    s->block[s->blockCount++] = record;
    for (int i = size - 1; i >= 0; i--) {
        record[i].nextFree = s->freePair;
        s->freePair = &record[i];
    }
    return METRUE;
}

static McdPairRecord *allocatePair(McdSpace *s) {
    if (!s->freePair && !makePairBlock(s))
        return 0;
    McdPairRecord *record = s->freePair;
    MEASSERT(record->pair.phase == kMcdFFStateInactive && !record->pair.model1);
    s->freePair = record->nextFree;
    return record;
}

static void forgetPair(McdPairRecord *record) {
    if (record->pair.forget)
        record->pair.forget(&record->pair);
}

static void releasePair(McdSpace *s, McdPairRecord *record) {
    forgetPair(record);
    memset(record, 0, sizeof *record);
    record->nextFree = s->freePair;
    s->freePair = record;
}

/* ---- links ------------------------------------------------------------------------------------------------------- */

static MeU32 hashOf(int a, int b) {
    const int low = b ^ ((a ^ b) & -(a < b)), high = a ^ b ^ low; /* branchless: the order is unpredictable */
    const MeU64 key = (MeU64)(MeU32)low << 32 | (MeU32)high;
    return (MeU32)(key * 0x9e3779b97f4a7c15ull >> 32);
}

static int *bucketOf(const McdSpace *s, int a, int b) {
    return &s->hash[hashOf(a, b) & (MeU32)(s->hashSize - 1)];
}

static int findLink(const McdSpace *s, int a, int b) {
    if (!s->hashSize)
        return MCD_NONE;
    for (int i = *bucketOf(s, a, b); i != MCD_NONE; i = s->link[i].nextInHash) {
        const int *p = s->link[i].proxy;
        if ((p[0] == a && p[1] == b) || (p[0] == b && p[1] == a))
            return i;
    }
    return MCD_NONE;
}

static void insertIntoHash(McdSpace *s, int i) {
    int *head = bucketOf(s, s->link[i].proxy[0], s->link[i].proxy[1]);
    MEASSERT(*head < s->linkMax && *head != i);
    s->link[i].nextInHash = *head;
    *head = i;
}

static void removeFromHash(McdSpace *s, int i) {
    int *at = bucketOf(s, s->link[i].proxy[0], s->link[i].proxy[1]);
    while (*at != i) {
        at = &s->link[*at].nextInHash;
        MEASSERT(*at != MCD_NONE);
    }
    *at = s->link[i].nextInHash;
}

static MeBool growHash(McdSpace *s) {
    const int size = s->hashSize ? 2 * s->hashSize : 128;
    if (!MeMemoryGrow(&s->hash, 0, (size_t)size, sizeof *s->hash, caller, "the table of pairs"))
        return MEFALSE;
    s->hashSize = size;
    for (int i = 0; i < size; i++)
        s->hash[i] = MCD_NONE;
    for (int i = 0; i < s->linkMax; i++)
        if (s->link[i].proxy[0] != MCD_NONE)
            insertIntoHash(s, i);
    return METRUE;
}

static MeBool growLinks(McdSpace *s) {
    const int first = s->linkMax;
    if (!reserveList(&s->pending, first + 1) || /* same capacity as `link`: both start at 64 and double */
        !reserve(&s->link, &s->linkMax, first + 1, sizeof *s->link, "near models"))
        return MEFALSE;
    MEASSERT(s->pending.max >= s->linkMax);
    for (int i = s->linkMax - 1; i >= first; i--) {
        s->link[i].proxy[0] = MCD_NONE;
        s->link[i].nextInHash = s->freeLink;
        s->freeLink = i;
    }
    return METRUE;
}

/* Inserts a link into the list of its proxy[end]; end: 0 or 1. */
static void linkIntoList(McdSpace *s, int i, int end) {
    McdProxy *p = &s->proxy[s->link[i].proxy[end]];
    const int next = p->firstLink;
    MEASSERT(p->model && next != i);
    s->link[i].previous[end] = MCD_NONE;
    s->link[i].next[end] = next;
    if (next != MCD_NONE)
        s->link[next].previous[s->link[next].proxy[1] == s->link[i].proxy[end]] = i;
    p->firstLink = i;
}

static void unlinkFromList(McdSpace *s, int i, int end) {
    const int proxy = s->link[i].proxy[end], previous = s->link[i].previous[end], next = s->link[i].next[end];
    MEASSERT((previous == MCD_NONE) == (s->proxy[proxy].firstLink == i));
    if (previous == MCD_NONE)
        s->proxy[proxy].firstLink = next;
    else
        s->link[previous].next[s->link[previous].proxy[1] == proxy] = next;
    if (next != MCD_NONE)
        s->link[next].previous[s->link[next].proxy[1] == proxy] = previous;
}

static int makeLink(McdSpace *s, int a, int b) {
    if ((s->freeLink == MCD_NONE && !growLinks(s)) || (s->linkCount >= s->hashSize && !growHash(s)))
        return MCD_NONE;
    const int i = s->freeLink;
    McdLink *link = &s->link[i];
    MEASSERT(a != b && link->proxy[0] == MCD_NONE);
    MEVALIDATE(findLink(s, a, b) == MCD_NONE);
    s->freeLink = link->nextInHash;
    s->linkCount++;
    memset(link, 0, sizeof *link);
    const int isSwapped = s->proxy[a].order < s->proxy[b].order;
    link->proxy[0] = isSwapped ? b : a;
    link->proxy[1] = isSwapped ? a : b;
    insertIntoHash(s, i);
    linkIntoList(s, i, 0);
    linkIntoList(s, i, 1);
    return i;
}

/* Frees a link that has no pair. */
static void dropLink(McdSpace *s, int i) {
    MEASSERT(!s->link[i].record && !s->link[i].isWaiting);
    removeFromHash(s, i);
    unlinkFromList(s, i, 0);
    unlinkFromList(s, i, 1);
    s->link[i].proxy[0] = MCD_NONE;
    s->link[i].nextInHash = s->freeLink;
    s->freeLink = i;
    s->linkCount--;
    MEASSERT(s->linkCount >= 0);
}

static int nextLink(const McdSpace *s, int i, int proxy) {
    return s->link[i].next[s->link[i].proxy[1] == proxy];
}

/* ---- classification ---------------------------------------------------------------------------------------------- */

static MeBool isCulled(const McdProxy *a, const McdProxy *b) {
    return a->table && a->table == b->table && a->cullingID == b->cullingID &&
           McdCullingTableGet(a->table, (MeU32)a->cullingIndex, (MeU32)b->cullingIndex);
}

/* Whether two boxes, grown by the tolerances, overlap on the space's axes (as McdNearby on all axes). */
static MeBool isNear(const McdSpace *s, const McdProxy *a, const McdProxy *b) {
    const MeReal margin = a->tolerance + b->tolerance;
    if (!a->hasBox || !b->hasBox)
        return MEFALSE;
    int separatedAxes = 0; /* branchless: the separating axis is unpredictable */
    for (int i = 0; i < 3; i++)
        separatedAxes |= ((a->min[i] - margin > b->max[i]) | (b->min[i] - margin > a->max[i])) << i;
    return !(separatedAxes & s->axes);
}

static MeBool fatBoxesOverlap(const McdSpace *s, const McdProxy *a, const McdProxy *b) {
    int separatedAxes = 0;
    for (int i = 0; i < 3; i++)
        separatedAxes |= ((a->fat.min[i] > b->fat.max[i]) | (b->fat.min[i] > a->fat.max[i])) << i;
    return !(separatedAxes & s->axes);
}

static McdPairEntry entryOf(const McdSpace *s, int i) {
    const McdLink *link = &s->link[i];
    return (McdPairEntry){.order2 = s->proxy[link->proxy[1]].order, .order1 = s->proxy[link->proxy[0]].order};
}

/* Ends the pair of a link: moves it to the goodbye pairs. */
static void sayGoodbye(McdSpace *s, int i) {
    McdLink *link = &s->link[i];
    McdPairEntry entry = entryOf(s, i);
    entry.record = link->record;
    link->record->pair.phase = kMcdFFStateGoodbye;
    link->record->wasSilent = link->isSilent;
    link->record = 0;
    link->isSilent = MEFALSE;
    s->liveCount--;
    MEASSERT(s->liveCount >= 0 && entry.order2 < entry.order1);
    listAdd(&s->goodbye, &entry);
}

/* Moves a pair between the staying pairs and the silent ones (pairs of two frozen models). */
static void switchSilent(McdSpace *s, int i) {
    McdLink *link = &s->link[i];
    McdPairEntry entry = entryOf(s, i);
    entry.record = link->record;
    link->isSilent = !link->isSilent;
    listAdd(link->isSilent ? &s->silenced : &s->woken, &entry);
}

static void stopWaiting(McdSpace *s, int i) {
    if (s->link[i].isWaiting)
        s->waitingCount--;
    MEASSERT(s->waitingCount >= 0);
    s->link[i].isWaiting = MEFALSE;
}

/* Queues a link for a pair (admitQueued). */
static void queueForRoom(McdSpace *s, int i) {
    McdPairEntry entry = entryOf(s, i);
    entry.link = i;
    s->link[i].isWaiting = METRUE;
    s->waitingCount++;
    listAdd(&s->pending, &entry);
}

/* Whether two models may collide at all: neither culled nor filtered out. */
static MeBool mayCollide(const McdProxy *a, const McdProxy *b) {
    return !isCulled(a, b) && !mcd_areFiltered(&a->filter, &b->filter);
}

static MeBool isPairOf(const McdSpace *s, const McdLink *link) {
    const McdProxy *a = &s->proxy[link->proxy[0]], *b = &s->proxy[link->proxy[1]];
    return !link->isDisabled && isNear(s, a, b) && mayCollide(a, b);
}

/* What changes about a link when it is classified. */
typedef enum LinkChange { NO_CHANGE, SILENCE_OR_WAKE, QUEUE, END } LinkChange;

static LinkChange changeOf(const McdSpace *s, const McdLink *link) {
    const McdProxy *a = &s->proxy[link->proxy[0]], *b = &s->proxy[link->proxy[1]];
    const MeBool areFrozen = a->isFrozen && b->isFrozen, isPair = isPairOf(s, link);
    if (isPair && link->record)
        return link->isSilent == areFrozen ? NO_CHANGE : SILENCE_OR_WAKE;
    if (isPair && !areFrozen)
        return link->isWaiting ? NO_CHANGE : QUEUE;
    if (link->record || link->isWaiting)
        return END;
    return link->isDisabled || (!areFrozen && fatBoxesOverlap(s, a, b)) ? NO_CHANGE : END;
}

/* Ends the pair of a link. Keeps the link if it is disabled, or if the fat boxes overlap and one model is not frozen;
 * drops it otherwise. */
static void endLink(McdSpace *s, int i) {
    const McdLink *link = &s->link[i];
    const McdProxy *a = &s->proxy[link->proxy[0]], *b = &s->proxy[link->proxy[1]];
    if (link->record)
        sayGoodbye(s, i);
    stopWaiting(s, i);
    if (!link->isDisabled && ((a->isFrozen && b->isFrozen) || !fatBoxesOverlap(s, a, b)))
        dropLink(s, i);
}

static void classifyPair(McdSpace *s, int i) {
    switch (changeOf(s, &s->link[i])) {
    case NO_CHANGE:
        break;
    case SILENCE_OR_WAKE:
        switchSilent(s, i);
        break;
    case QUEUE:
        queueForRoom(s, i);
        break;
    case END:
        endLink(s, i);
        break;
    }
}

/* ---- broad phase search ------------------------------------------------------------------------------------------ */

static MeBool isUnlinked(const McdSpace *s, int proxy, int other) {
    const McdProxy *a = &s->proxy[proxy], *b = &s->proxy[other];
    return other != proxy && !(a->isFrozen && b->isFrozen) && findLink(s, proxy, other) == MCD_NONE;
}

/* Number of proxies whose links are looked up in the hash table together, so that their cache misses overlap. 64 takes
 * the same time in a heap of 10 000 boxes. */
enum { LOOKUP_GROUP = 16 };

/* A search for the proxies that overlap a proxy's fat box and have no link with it. */
typedef struct Search {
    const McdSpace *space;
    int proxy, count;
    int other[LOOKUP_GROUP];
    MeBool (*visit)(void *context, int proxy, int other); /* called for each of them until it returns false */
    void *context;
    MeBool isComplete; /* no visit has returned false */
} Search;

static void visitUnlinked(Search *r) {
    const McdSpace *s = r->space;
    for (int i = 0; i < r->count && s->hashSize; i++) {
        const int first = *bucketOf(s, r->proxy, r->other[i]);
        if (first != MCD_NONE)
            ME_PREFETCH(&s->link[first]);
    }
    for (int i = 0; i < r->count && r->isComplete; i++)
        if (isUnlinked(s, r->proxy, r->other[i]))
            r->isComplete = r->visit(r->context, r->proxy, r->other[i]);
    r->count = 0;
}

static MeBool collectOverlap(void *context, int other) {
    Search *r = context;
    if (r->count == LOOKUP_GROUP)
        visitUnlinked(r);
    if (r->space->hashSize)
        ME_PREFETCH(bucketOf(r->space, r->proxy, other));
    r->other[r->count++] = other;
    return r->isComplete;
}

static MeBool addLink(void *space, int proxy, int other) {
    return makeLink(space, proxy, other) != MCD_NONE;
}

/* Visits the proxies whose fat boxes overlap that of a proxy. After a visit has returned false, a few more calls may
 * follow. */
static void visitOverlaps(const McdSpace *s, int proxy, McdTreeVisit visit, void *context) {
    McdTreeBox box = s->proxy[proxy].fat;
    for (int i = 0; i < 3; i++)
        if (!(s->axes & 1 << i)) {
            box.min[i] = (float)-MCD_TREE_REACH;
            box.max[i] = (float)MCD_TREE_REACH;
        }
    mcd_treeQuery(s->tree, &box, visit, context);
    for (int i = 0; i < s->unboundedCount; i++)
        if (fatBoxesOverlap(s, &s->proxy[proxy], &s->proxy[s->unbounded[i]]) && !visit(context, s->unbounded[i]))
            return;
}

static MeBool needsSearch(const McdProxy *p) {
    return p->isMoved && p->hasBox;
}

/* Makes the missing links of a proxy; false if there was not enough memory for all. */
static MeBool findLinks(McdSpace *s, int proxy) {
    Search search = {.space = s, .proxy = proxy, .visit = addLink, .context = s, .isComplete = METRUE};
    visitOverlaps(s, proxy, collectOverlap, &search);
    visitUnlinked(&search);
    return search.isComplete;
}

/* Deterministic with workers (MeTeam.h): these only search, each range writing to its own part of `found`; the
 * calling thread makes the links, in the same order as without workers. */

enum { FOUND_ROOM = 8 * MCD_RANGE }; /* capacity for the results of a range of MCD_RANGE dirty proxies */

typedef struct Range {
    int *found, count; /* the range's part of `found` */
} Range;

static MeBool storeFound(void *range, int proxy, int other) {
    Range *r = range;
    (void)proxy;
    if (r->count < FOUND_ROOM)
        r->found[r->count] = other;
    return r->count++ < FOUND_ROOM;
}

/* Searches for a range of dirty proxies. foundEnd of each proxy is where its results end in the range's part of
 * `found`; -1: no room, it must be searched again. */
static void MEAPI searchRange(void *space, int first, int end, int worker) {
    const McdSpace *s = space;
    Range r = {.found = s->found + first / MCD_RANGE * FOUND_ROOM};
    Search search = {.space = s, .visit = storeFound, .context = &r, .isComplete = METRUE};
    (void)worker;
    for (int i = first; i < end; i++) {
        search.proxy = s->dirty[i];
        if (search.isComplete && needsSearch(&s->proxy[search.proxy])) {
            visitOverlaps(s, search.proxy, collectOverlap, &search);
            visitUnlinked(&search);
        }
        s->foundEnd[i] = search.isComplete ? r.count : -1;
    }
}

/* Makes the links that the search for the proxy dirty[i] found, except those that exist already, since the search for
 * the other proxy found them, too. False: there is no memory. */
static MeBool makeFoundLinks(McdSpace *s, int i) {
    const int *found = s->found + i / MCD_RANGE * FOUND_ROOM, proxy = s->dirty[i];
    MeBool isDone = METRUE;
    for (int k = i % MCD_RANGE ? s->foundEnd[i - 1] : 0; k < s->foundEnd[i] && isDone; k++)
        isDone = !isUnlinked(s, proxy, found[k]) || addLink(s, proxy, found[k]);
    return isDone;
}

static MeBool reserveFound(McdSpace *s) {
    const int ranges = (s->dirtyCount + MCD_RANGE - 1) / MCD_RANGE;
    return reserve(&s->found, &s->foundRoom, ranges * FOUND_ROOM, sizeof *s->found, "near models") &&
           reserve(&s->foundEnd, &s->foundEndRoom, s->dirtyCount, sizeof *s->foundEnd, "near models");
}

/* Makes the missing links of all dirty proxies that have a new fat box. isMoved stays set where memory ran out. */
static void findAllLinks(McdSpace *s) {
    const MeBool isShared = s->team && s->dirtyCount >= MCD_MIN_RANGES * MCD_RANGE && reserveFound(s);
    if (isShared)
        mcd_spaceRunRanges(s, s->dirtyCount, MCD_RANGE, searchRange, s);
    for (int i = 0; i < s->dirtyCount; i++) {
        McdProxy *p = &s->proxy[s->dirty[i]];
        if (needsSearch(p))
            p->isMoved = !(isShared && s->foundEnd[i] >= 0 ? makeFoundLinks(s, i) : findLinks(s, s->dirty[i]));
        else
            p->isMoved = MEFALSE;
    }
}

static void classifyPairsOf(McdSpace *s, int proxy) {
    for (int i = s->proxy[proxy].firstLink, next; i != MCD_NONE; i = next) {
        const int first = s->link[i].proxy[0];
        next = nextLink(s, i, proxy);
        if (first == proxy || !s->proxy[first].isDirty) /* else the link is classified with its first proxy */
            classifyPair(s, i);
    }
}

/* Whether one of the link's proxies is dirty and classification will change the link. */
static MeBool needsClassification(const McdSpace *s, int i) {
    const int *p = s->link[i].proxy;
    return p[0] != MCD_NONE && (s->proxy[p[0]].isDirty || s->proxy[p[1]].isDirty) &&
           changeOf(s, &s->link[i]) != NO_CHANGE;
}

/* Marks the links of a range that must be classified. Deterministic (MeTeam.h): that depends only on the link and
 * its proxies, and nothing else is written. */
static void MEAPI markRange(void *space, int first, int end, int worker) {
    McdSpace *s = space;
    (void)worker;
    for (int i = first; i < end; i++)
        s->changes[i] = (MeU8)needsClassification(s, i);
}

/* Classifies links in memory order: workers mark those that will change; the calling thread classifies these in the
 * same order as without workers. */
static void classifyAll(McdSpace *s) {
    const MeBool isShared = s->team && s->linkMax >= MCD_MIN_RANGES * MCD_LINK_RANGE &&
                            reserve(&s->changes, &s->changesRoom, s->linkMax, sizeof *s->changes, "near models");
    if (isShared)
        mcd_spaceRunRanges(s, s->linkMax, MCD_LINK_RANGE, markRange, s);
    for (int i = 0; i < s->linkMax; i++)
        if (isShared ? s->changes[i] : needsClassification(s, i))
            classifyPair(s, i);
}

/* Classifies each link of the dirty proxies once; if many proxies are dirty, in memory order, which is faster. */
static void classifyPairs(McdSpace *s) {
    if (s->dirtyCount > s->proxyCount / 4) {
        classifyAll(s);
        return;
    }
    for (int i = 0; i < s->dirtyCount; i++)
        classifyPairsOf(s, s->dirty[i]);
}

/* ---- lists ------------------------------------------------------------------------------------------------------- */

/* Binary search in the sorted entry[first .. end - 1]: the index of the first entry that does not precede `other`. */
static int lowerBound(const McdPairEntry *entry, int first, int end, const McdPairEntry *other) {
    while (first < end) {
        const int middle = first + (end - first) / 2;
        if (precedes(&entry[middle], other))
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

static void moveEntries(McdPairEntry *entry, int to, int from, int count) {
    memmove(entry + to, entry + from, (size_t)count * sizeof *entry);
}

/* Merges a sorted list into the staying pairs, from the back, moving whole ranges; empties that list. */
static void addToStaying(McdSpace *s, McdPairList *list) {
    int end = s->staying.count, add = list->count;
    for (int i = 0; i < add; i++)
        listAdd(&s->staying, &list->entry[i]);
    McdPairEntry *entry = s->staying.entry;
    for (; add > 0; add--) {
        const int at = lowerBound(entry, 0, end, &list->entry[add - 1]);
        moveEntries(entry, at + add, at, end - at);
        entry[at + add - 1] = list->entry[add - 1];
        end = at;
    }
    list->count = 0;
    MEVALIDATE(isSorted(&s->staying));
}

static void helloBecomesStaying(McdSpace *s) {
    for (int i = 0; i < s->hello.count; i++) {
        McdModelPair *pair = &s->hello.entry[i].record->pair;
        if (pair->phase == kMcdFFStateHello) /* else it has said goodbye already */
            pair->phase = kMcdFFStateStaying;
    }
    addToStaying(s, &s->hello);
}

/* Removes the pairs of a sorted list from the staying pairs. */
static void dropFromStaying(McdSpace *s, const McdPairList *dropped) {
    McdPairEntry *entry = s->staying.entry;
    const int end = s->staying.count;
    int kept = 0, from = 0;
    for (int i = 0; i < dropped->count; i++) {
        const int at = lowerBound(entry, from, end, &dropped->entry[i]);
        if (at == end || entry[at].record != dropped->entry[i].record)
            continue;
        moveEntries(entry, kept, from, at - from);
        kept += at - from;
        from = at + 1;
    }
    if (from > kept)
        moveEntries(entry, kept, from, end - from);
    s->staying.count -= from - kept;
    MEASSERT(s->staying.count >= 0 && from - kept <= dropped->count);
}

static void updateStaying(McdSpace *s) {
    listSort(&s->goodbye);
    listSort(&s->silenced);
    listSort(&s->woken);
    dropFromStaying(s, &s->goodbye);
    dropFromStaying(s, &s->silenced);
    s->silenced.count = 0;
    addToStaying(s, &s->woken);
}

/* Makes the pair of a link. False if there is no memory; then the link keeps waiting. */
static MeBool sayHello(McdSpace *s, McdPairEntry entry) {
    McdLink *link = &s->link[entry.link];
    McdPairRecord *record = allocatePair(s);
    if (!record)
        return MEFALSE;
    record->pair.model1 = &s->proxy[link->proxy[0]].model->model;
    record->pair.model2 = &s->proxy[link->proxy[1]].model->model;
    record->pair.phase = kMcdFFStateHello;
    entry.record = record;
    listAdd(&s->hello, &entry);
    stopWaiting(s, (int)(link - s->link));
    MEASSERT(!link->record && !link->isSilent);
    link->record = record;
    s->liveCount++;
    return METRUE;
}

static void reportFull(McdSpace *s, int first) {
    char what[40];
    snprintf(what, sizeof what, "%d more pairs", s->pending.count - first);
    MeLimitWarn(&s->pairLimit, caller, what);
    const MeProgramCall before = MeProgramEnter("McdSpaceSetPoolFullHandler");
    for (int i = first; s->poolFull && i < s->pending.count; i++) {
        const McdLink *link = &s->link[s->pending.entry[i].link];
        s->poolFull(&s->proxy[link->proxy[0]].model->model, &s->proxy[link->proxy[1]].model->model);
    }
    MeProgramLeave(&before);
}

/* Rebuilds the queue from all waiting links: those that found no room earlier, and the new ones. */
static void requeueWaiting(McdSpace *s) {
    s->pending.count = 0;
    for (int i = 0; i < s->linkMax; i++)
        if (s->link[i].proxy[0] != MCD_NONE && s->link[i].isWaiting) {
            McdPairEntry entry = entryOf(s, i);
            entry.link = i;
            listAdd(&s->pending, &entry);
        }
}

/* Makes the pairs of the queued links, in order, up to the limit of pairs; the other links keep waiting. */
static void admitQueued(McdSpace *s) {
    const int newCount = s->pending.count;
    if (s->waitingCount > newCount)
        requeueWaiting(s);
    listSort(&s->pending);
    const MeLimit *limit = &s->pairLimit;
    int i = 0;
    while (i < s->pending.count && s->liveCount < limit->max && sayHello(s, s->pending.entry[i]))
        i++;
    if (i < s->pending.count && newCount && s->liveCount == limit->max)
        reportFull(s, i);
    s->pending.count = 0;
}

/* ---- the block --------------------------------------------------------------------------------------------------- */

void mcd_proxyMarkDirty(McdProxy *p) {
    McdSpace *s = p->model->space;
    if (p->isDirty)
        return;
    p->isDirty = METRUE;
    MEASSERT(s->dirtyCount < s->proxyRoom);
    s->dirty[s->dirtyCount++] = mcd_proxyIndex(s, p);
}

MeBool mcd_proxyIsWithinFatBox(const McdProxy *p) {
    for (int i = 0; i < 3; i++)
        if (fmax((double)p->min[i], -MCD_TREE_REACH) < (double)p->fat.min[i] ||
            fmin((double)p->max[i], MCD_TREE_REACH) > (double)p->fat.max[i])
            return MEFALSE;
    return METRUE;
}

void mcd_pairsBegin(McdSpace *s) {
    mcd_pairsRemoveErased(s);
    for (int i = 0; i < s->goodbye.count; i++)
        releasePair(s, s->goodbye.entry[i].record);
    s->goodbye.count = 0;
}

/* Keeps proxies dirty whose links could not be made for lack of memory: they are searched again in the next block. */
static void keepUnfinished(McdSpace *s) {
    int kept = 0;
    for (int i = 0; i < s->dirtyCount; i++) {
        McdProxy *p = &s->proxy[s->dirty[i]];
        MEASSERT(p->isDirty);
        p->isDirty = p->isMoved;
        if (p->isMoved)
            s->dirty[kept++] = s->dirty[i];
    }
    s->dirtyCount = kept;
}

/* For MEVALIDATE: whether a link is in the hash table, has its two models in descending order and, if it has a pair, a
 * live pair of these two models. */
static MeBool isLinkGood(const McdSpace *s, int i) {
    const McdLink *link = &s->link[i];
    const McdProxy *a = &s->proxy[link->proxy[0]], *b = &s->proxy[link->proxy[1]];
    if (!a->model || !b->model || !(a->order > b->order) || findLink(s, link->proxy[0], link->proxy[1]) != i)
        return MEFALSE;
    if (!link->record)
        return !link->isSilent;
    const McdModelPair *pair = &link->record->pair;
    return pair->model1 == &a->model->model && pair->model2 == &b->model->model && !link->isWaiting &&
           (pair->phase == kMcdFFStateHello || pair->phase == kMcdFFStateStaying);
}

static MeBool areLinksGood(const McdSpace *s) {
    int links = 0, pairs = 0, silent = 0, waiting = 0;
    for (int i = 0; i < s->linkMax; i++) {
        if (s->link[i].proxy[0] == MCD_NONE)
            continue;
        if (!isLinkGood(s, i))
            return MEFALSE;
        links++;
        pairs += s->link[i].record != 0;
        silent += s->link[i].isSilent;
        waiting += s->link[i].isWaiting;
    }
    return links == s->linkCount && pairs == s->liveCount && waiting == s->waitingCount &&
           pairs - silent == s->hello.count + s->staying.count;
}

/* For checks: the list is sorted, without duplicates, and all its pairs are in that phase. */
static MeBool isListGood(const McdPairList *list, McdModelPairPhase phase) {
    for (int i = 0; i < list->count; i++)
        if (list->entry[i].record->pair.phase != phase || (i && !precedes(&list->entry[i - 1], &list->entry[i])))
            return MEFALSE;
    return METRUE;
}

/* For checks: each proxy with a box is either in the tree or in the list of unbounded ones, and its fat box contains
 * the exact one. */
static MeBool areBoxesGood(const McdSpace *s) {
    int count = 0;
    for (int i = s->firstProxy; i != MCD_NONE; i = s->proxy[i].next, count++) {
        const McdProxy *p = &s->proxy[i];
        if (!p->model || p->model->proxy != p || p->model->space != s || p->hasBox != (p->leaf || p->isUnbounded) ||
            (p->leaf && p->isUnbounded) || (p->hasBox && !mcd_proxyIsWithinFatBox(p)))
            return MEFALSE;
    }
    return count == s->proxyCount && count <= s->proxyRoom;
}

void mcd_pairsEnd(McdSpace *s) {
    mcd_pairsRemoveErased(s);
    mcd_treeRebuildIfDeep(s->tree);
    findAllLinks(s);
    helloBecomesStaying(s);
    classifyPairs(s);
    keepUnfinished(s);
    updateStaying(s);
    admitQueued(s);
    MEASSERT(s->liveCount >= 0 && s->liveCount <= s->pairLimit.max && s->waitingCount >= 0);
    MEVALIDATE(areBoxesGood(s) && areLinksGood(s));
    MEVALIDATE(isListGood(&s->hello, kMcdFFStateHello) && isListGood(&s->staying, kMcdFFStateStaying) &&
               isListGood(&s->goodbye, kMcdFFStateGoodbye));
}

static void clearDirty(McdProxy *p) {
    McdSpace *s = p->model->space;
    int at = 0;
    if (!p->isDirty)
        return;
    while (s->dirty[at] != mcd_proxyIndex(s, p))
        at++;
    MEASSERT(at < s->dirtyCount);
    s->dirty[at] = s->dirty[--s->dirtyCount];
    p->isDirty = MEFALSE;
}

void mcd_pairsForgetProxy(McdProxy *p) {
    McdSpace *s = p->model->space;
    while (p->firstLink != MCD_NONE) {
        const int i = p->firstLink;
        if (s->link[i].record)
            sayGoodbye(s, i);
        stopWaiting(s, i);
        dropLink(s, i);
    }
    clearDirty(p);
}

void mcd_pairsForgetContacts(McdProxy *p) {
    const McdSpace *s = p->model->space;
    for (int i = p->firstLink; i != MCD_NONE; i = nextLink(s, i, mcd_proxyIndex(s, p))) {
        McdPairRecord *record = s->link[i].record;
        if (!record)
            continue;
        forgetPair(record);
        McdModelPairForgetTest(&record->pair);
    }
}

/* Erases a pair: calls the program's goodbye function if its hello function stored data. A pair that is in a list is
 * released later, when all erased pairs are removed from the lists (mcd_pairsRemoveErased). */
static void erasePair(McdSpace *s, McdPairRecord *record, MeBool isInLists) {
    forgetPair(record);
    if (record->pair.m_cachedData)
        McdGoodbye(&record->pair);
    record->pair.phase = kMcdFFStateInactive;
    if (isInLists)
        s->isStale = METRUE;
    else
        releasePair(s, record);
}

static void removeErased(McdSpace *s, McdPairList *list) {
    int kept = 0;
    for (int i = 0; i < list->count; i++) {
        McdPairRecord *record = list->entry[i].record;
        if (record->pair.phase == kMcdFFStateInactive)
            releasePair(s, record);
        else
            list->entry[kept++] = list->entry[i];
    }
    list->count = kept;
}

void mcd_pairsRemoveErased(McdSpace *s) {
    if (!s->isStale)
        return;
    removeErased(s, &s->hello);
    removeErased(s, &s->staying);
    removeErased(s, &s->goodbye);
    s->isStale = MEFALSE;
}

/* Erases the goodbye pairs of a model, which have no link any more. Inside a block they are also in another list,
 * unless they were silent. */
static void eraseGoodbyesOf(McdSpace *s, McdModelID cm) {
    int kept = 0;
    for (int i = 0; i < s->goodbye.count; i++) {
        McdPairRecord *record = s->goodbye.entry[i].record;
        const MeBool isOfModel = record->pair.model1 == cm || record->pair.model2 == cm;
        if (!isOfModel || !s->isChanging || record->wasSilent)
            s->goodbye.entry[kept++] = s->goodbye.entry[i];
        if (isOfModel)
            erasePair(s, record, METRUE);
    }
    s->goodbye.count = kept;
}

void mcd_pairsEraseProxy(McdProxy *p) {
    McdSpace *s = p->model->space;
    for (int i = p->firstLink; i != MCD_NONE; i = nextLink(s, i, mcd_proxyIndex(s, p))) {
        McdLink *link = &s->link[i];
        if (!link->record)
            continue;
        erasePair(s, link->record, !link->isSilent);
        link->record = 0;
        link->isSilent = MEFALSE;
        s->liveCount--;
    }
    eraseGoodbyesOf(s, &p->model->model);
    mcd_pairsForgetProxy(p);
}

void mcd_pairsDestroy(McdSpace *s) {
    for (int b = 0; b < s->blockCount; b++) {
        for (int i = 0; i < sizeOfBlock(b); i++) {
            if (s->block[b][i].pair.m_cachedData && s->block[b][i].pair.phase != kMcdFFStateGoodbye)
                McdGoodbye(&s->block[b][i].pair);
            s->block[b][i].pair.responseData = 0; /* owned by its world, which may have been destroyed before */
            forgetPair(&s->block[b][i]);
        }
        MeMemoryGiveAligned(s->block[b]);
    }
    MeMemoryGive(s->link);
    MeMemoryGive(s->hash);
    McdPairList *list[] = {&s->hello, &s->staying, &s->goodbye, &s->pending, &s->silenced, &s->woken};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        MeMemoryGive(list[i]->entry);
}

/* ---- pairs that never collide ------------------------------------------------------------------------------------ */

MeBool mcd_pairsDisable(McdProxy *a, McdProxy *b) {
    McdSpace *s = a->model->space;
    int i = findLink(s, mcd_proxyIndex(s, a), mcd_proxyIndex(s, b));
    if (i == MCD_NONE)
        i = makeLink(s, mcd_proxyIndex(s, a), mcd_proxyIndex(s, b));
    if (i == MCD_NONE)
        return MEFALSE;
    s->link[i].isDisabled = METRUE;
    mcd_proxyMarkDirty(a);
    return METRUE;
}

void mcd_pairsEnable(McdProxy *a, McdProxy *b) {
    McdSpace *s = a->model->space;
    const int i = findLink(s, mcd_proxyIndex(s, a), mcd_proxyIndex(s, b));
    if (i == MCD_NONE)
        return;
    s->link[i].isDisabled = MEFALSE;
    mcd_proxyMarkDirty(a);
}

MeBool mcd_pairsAreEnabled(const McdProxy *a, const McdProxy *b) {
    const McdSpace *s = a->model->space;
    const int i = findLink(s, mcd_proxyIndex(s, a), mcd_proxyIndex(s, b));
    return !(i != MCD_NONE && s->link[i].isDisabled) && mayCollide(a, b);
}
