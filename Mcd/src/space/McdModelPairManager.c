/* Pairs of models with their phases: records in a list, in the order of activation, and in a hash table by their
 * models. */
#include "McdModelPairManager.h"

#include "McdInteractions.h"
#include "pair/mcd_pair_i.h"
#include <stdint.h>
#include <string.h>

typedef struct Record {
    McdModelPair pair;             /* first: a pair's pointer is its record's */
    struct Record *before, *after; /* in the list; `after` also links free records */
    struct Record *next;           /* with the same hash */
} Record;

struct McdModelPairManager {
    int size, used;
    MeU32 step; /* counts changes that invalidate iterators */
    MeBool hasWarned;
    McdSpacePoolErrorFnPtr poolFull;
    Record *record, *firstFree, *first, *last;
    Record **bucket; /* the hash table: `size` heads */
    MeStage stage;   /* active during calls of the program's functions */
};

/* Whether pairs may be added and removed. False, with a message naming the function, in callbacks of the manager. */
static MeBool mayChange(McdModelPairManagerID manager, const char *function) {
    return MeStageIsFree(&manager->stage, function);
}

static void callGoodbye(McdModelPairManager *manager, McdModelPair *p) {
    if (!p->m_cachedData)
        return;
    MeStageBegin(&manager->stage, 0);
    McdGoodbye(p);
    MeStageEnd(&manager->stage, 0);
}

static MeBool isManager(McdModelPairManagerID manager, const char *function) {
    if (!manager) {
        MeWarning(1, "%s: the manager is null", function);
        return MEFALSE;
    }
    MEASSERT(manager->used >= 0 && manager->used <= manager->size);
    MEASSERT((manager->used == manager->size) == (manager->firstFree == NULL));
    return METRUE;
}

/* ---- creation, destruction --------------------------------------------------------------------------------------- */

McdModelPairManagerID MEAPI McdModelPairManagerCreate(int size) {
    if (size < 1) {
        MeWarning(1, "McdModelPairManagerCreate: size is %d, which must be 1 or more", size);
        return 0;
    }
    const size_t bytes = sizeof(McdModelPairManager) + (size_t)size * (sizeof(Record) + sizeof(Record *));
    McdModelPairManager *manager = MeMemoryTakeZeroed(1, bytes, "McdModelPairManagerCreate", "pairs");
    if (!manager)
        return 0;
    manager->size = size;
    manager->record = (Record *)(manager + 1);
    manager->bucket = (Record **)(manager->record + size);
    for (int i = size; i > 0; i--) {
        manager->record[i - 1].after = manager->firstFree;
        manager->firstFree = &manager->record[i - 1];
    }
    return manager;
}

void MEAPI McdModelPairManagerDestroy(McdModelPairManager *manager) {
    if (!manager || !mayChange(manager, "McdModelPairManagerDestroy"))
        return;
    for (Record *r = manager->first; r; r = r->after)
        callGoodbye(manager, &r->pair);
    MeMemoryGive(manager);
}

/* ---- hash table -------------------------------------------------------------------------------------------------- */

/* Finds the pointer to the pair's record in its bucket, or the null pointer where it would be inserted; the order of
 * the models does not matter. */
static Record **findSlot(McdModelPairManager *manager, McdModelID m1, McdModelID m2) {
    const uintptr_t key = ((uintptr_t)m1 ^ (uintptr_t)m2) / sizeof(McdModelRecord);
    Record **place = &manager->bucket[key % (uintptr_t)manager->size];
    for (; *place; place = &(*place)->next) {
        const McdModelPair *p = &(*place)->pair;
        if ((p->model1 == m1 && p->model2 == m2) || (p->model1 == m2 && p->model2 == m1))
            break;
    }
    return place;
}

static MeBool isActive(const Record *r) {
    return r && r->pair.phase != kMcdFFStateGoodbye;
}

McdModelPairID MEAPI McdModelPairManagerGetPair(McdModelPairManagerID manager, McdModelID m1, McdModelID m2) {
    Record *r = isManager(manager, "McdModelPairManagerGetPair") ? *findSlot(manager, m1, m2) : NULL;
    return isActive(r) ? &r->pair : 0;
}

int MEAPI McdModelPairManagerGetSize(McdModelPairManagerID manager) {
    return isManager(manager, "McdModelPairManagerGetSize") ? manager->size : 0;
}

/* ---- adding and removing --------------------------------------------------------------------- */

static void reportNoRoom(McdModelPairManager *manager, McdModelID m1, McdModelID m2) {
    if (!manager->poolFull && !manager->hasWarned)
        MeWarning(1, "McdModelPairManagerActivate: there are %d pairs: raise McdModelPairManagerCreate's size",
                  manager->size);
    manager->hasWarned = METRUE;
    if (!manager->poolFull)
        return;
    MeStageBegin(&manager->stage, 0);
    const MeProgramCall before = MeProgramEnter("McdModelPairManagerSetPoolFullHandler");
    manager->poolFull(m1, m2);
    MeProgramLeave(&before);
    MeStageEnd(&manager->stage, 0);
}

/* For checks: the list has all used records, and the hash table finds each of them. */
static MeBool isListGood(McdModelPairManager *manager) {
    int count = 0;
    for (Record *r = manager->first; r; r = r->after, count++)
        if (*findSlot(manager, r->pair.model1, r->pair.model2) != r || r->pair.phase == kMcdFFStateInactive ||
            (r->after ? r->after->before : manager->last) != r)
            return MEFALSE;
    return count == manager->used;
}

static void appendRecord(McdModelPairManager *manager, Record *r) {
    MEASSERT(manager->used < manager->size);
    r->before = manager->last;
    r->after = NULL;
    *(manager->last ? &manager->last->after : &manager->first) = r;
    manager->last = r;
    manager->used++;
    MEVALIDATE(isListGood(manager));
}

MeBool MEAPI McdModelPairManagerActivate(McdModelPairManagerID manager, McdModelID model1, McdModelID model2) {
    if (!isManager(manager, "McdModelPairManagerActivate") ||
        !mcd_modelsMakeAPair(model1, model2, "McdModelPairManagerActivate") ||
        !mayChange(manager, "McdModelPairManagerActivate"))
        return MEFALSE;
    Record **place = findSlot(manager, model1, model2), *r = *place;
    if (isActive(r))
        return METRUE;
    if (!r && !manager->firstFree) {
        reportNoRoom(manager, model1, model2);
        return MEFALSE;
    }
    manager->step++;
    if (r) {
        r->pair.phase = kMcdFFStateStaying;
        return METRUE;
    }
    r = manager->firstFree;
    manager->firstFree = r->after;
    memset(r, 0, sizeof *r);
    r->pair.model1 = model1;
    r->pair.model2 = model2;
    r->pair.phase = kMcdFFStateHello;
    MEASSERT(*place == NULL);
    *place = r;
    appendRecord(manager, r);
    return METRUE;
}

static void removePair(McdModelPairManager *manager, Record *r) {
    Record **place = findSlot(manager, r->pair.model1, r->pair.model2);
    MEASSERT(*place == r);
    callGoodbye(manager, &r->pair);
    *place = r->next;
    *(r->before ? &r->before->after : &manager->first) = r->after;
    *(r->after ? &r->after->before : &manager->last) = r->before;
    r->pair.phase = kMcdFFStateInactive;
    r->after = manager->firstFree;
    manager->firstFree = r;
    manager->used--;
    MEVALIDATE(isListGood(manager));
}

MeBool MEAPI McdModelPairManagerDeactivate(McdModelPairManagerID manager, McdModelID model1, McdModelID model2) {
    Record *r = isManager(manager, "McdModelPairManagerDeactivate") ? *findSlot(manager, model1, model2) : NULL;
    if (!isActive(r) || !mayChange(manager, "McdModelPairManagerDeactivate"))
        return MEFALSE;
    manager->step++;
    if (r->pair.phase == kMcdFFStateHello)
        removePair(manager, r);
    else
        r->pair.phase = kMcdFFStateGoodbye;
    return METRUE;
}

void MEAPI McdModelPairManagerFlush(McdModelPairManagerID manager) {
    if (!isManager(manager, "McdModelPairManagerFlush") || !mayChange(manager, "McdModelPairManagerFlush"))
        return;
    manager->step++;
    for (Record *r = manager->first, *after; r; r = after) {
        after = r->after;
        if (r->pair.phase == kMcdFFStateGoodbye)
            removePair(manager, r);
        else
            r->pair.phase = kMcdFFStateStaying;
    }
}

/* ---- copying to containers --------------------------------------------------------------------------------------- */

void MEAPI McdModelPairManagerResetIterator(McdModelPairManagerID manager, McdSpacePairIterator *iterator) {
    if (!isManager(manager, "McdModelPairManagerResetIterator"))
        return;
    if (!iterator) {
        MeWarning(1, "McdModelPairManagerResetIterator: the iterator is null");
        return;
    }
    memset(iterator, 0, sizeof *iterator);
    iterator->step = manager->step;
}

/* Copies the pairs of a phase, except the first *done ones, to array, at most `room`; advances *done. Returns their
 * number; *isMore becomes true if there are more. */
static int copyPairsOfPhase(const McdModelPairManager *manager, McdModelPairPhase phase, int *done,
                            McdModelPair **array, int room, MeBool *isMore) {
    int seen = 0, count = 0;
    for (Record *r = manager->first; r; r = r->after) {
        if (r->pair.phase != phase || seen++ < *done)
            continue;
        if (count < room)
            array[count] = &r->pair;
        *isMore |= count++ >= room;
    }
    count = MeMIN(count, room);
    *done += count;
    return count;
}

/* Fills the container with goodbye pairs, then hello pairs, then staying ones; pairs of a phase come only after all
 * of the phase before. True if there are more. */
static MeBool fillContainer(const McdModelPairManager *manager, McdSpacePairIterator *it, McdModelPairContainer *c,
                            MeBool withStaying) {
    MeBool isMore = MEFALSE;
    c->goodbyeFirst = 0;
    c->goodbyeEnd = copyPairsOfPhase(manager, kMcdFFStateGoodbye, &it->goodbye, c->array, c->size, &isMore);
    c->helloFirst = c->goodbyeEnd;
    c->helloEnd = c->helloFirst + copyPairsOfPhase(manager, kMcdFFStateHello, &it->hello, c->array + c->helloFirst,
                                                   c->size - c->helloFirst, &isMore);
    c->stayingFirst = c->stayingEnd = c->helloEnd;
    if (withStaying)
        c->stayingEnd += copyPairsOfPhase(manager, kMcdFFStateStaying, &it->staying, c->array + c->stayingFirst,
                                          c->size - c->stayingFirst, &isMore);
    MEASSERT(c->stayingEnd <= c->size);
    return isMore;
}

static MeBool getPairs(McdModelPairManager *manager, McdSpacePairIterator *it, McdModelPairContainer *c,
                       MeBool withStaying, const char *function) {
    if (!isManager(manager, function))
        return MEFALSE;
    if (!it || !c || !c->array || c->size < 1) {
        MeWarning(1, "%s: no iterator, or no container", function);
        return MEFALSE;
    }
    McdModelPairContainerReset(c);
    if (it->step == manager->step)
        return fillContainer(manager, it, c, withStaying);
    MeWarning(1, "%s: pairs came or went since McdModelPairManagerResetIterator", function);
    return MEFALSE;
}

MeBool MEAPI McdModelPairManagerGetPairs(McdModelPairManagerID manager, McdSpacePairIterator *iterator,
                                         McdModelPairContainer *container) {
    return getPairs(manager, iterator, container, METRUE, "McdModelPairManagerGetPairs");
}

MeBool MEAPI McdModelPairManagerGetTransitions(McdModelPairManagerID manager, McdSpacePairIterator *iterator,
                                               McdModelPairContainer *container) {
    return getPairs(manager, iterator, container, MEFALSE, "McdModelPairManagerGetTransitions");
}

void MEAPI McdModelPairManagerSetPoolFullHandler(McdModelPairManagerID manager, McdSpacePoolErrorFnPtr handler) {
    if (isManager(manager, "McdModelPairManagerSetPoolFullHandler"))
        manager->poolFull = handler;
}

McdSpacePoolErrorFnPtr MEAPI McdModelPairManagerGetPoolFullHandler(McdModelPairManagerID manager) {
    return isManager(manager, "McdModelPairManagerGetPoolFullHandler") ? manager->poolFull : 0;
}
