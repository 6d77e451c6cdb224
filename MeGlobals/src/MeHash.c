/* Hash tables with chaining. All entries are also in one list, so that their order does not depend on addresses. */
#include "MeHash.h"

#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMessage_i.h"
#include <stdint.h>
#include <string.h>

static int countEntries(const MeHash *table) {
    int count = 0;
    for (const MeHashBucket *b = table->first; b; b = b->after)
        count++;
    return count;
}

static MeBool isTable(const MeHash *table, const char *function) {
    if (!me_isGiven(table, "table", function))
        return MEFALSE;
    MEASSERT(table->population >= 0 && (table->population == 0) == (table->first == NULL));
    return METRUE;
}

/* ---- hashes: FNV-1a (Fowler, Noll, Vo), 32 bits ---- */

static int hashBytes(const void *bytes, size_t count, int size) {
    MeU32 hash = 2166136261u;
    for (size_t i = 0; i < count; i++)
        hash = (hash ^ ((const unsigned char *)bytes)[i]) * 16777619u;
    return (int)(hash % (MeU32)size);
}

static int MEAPI hashAddress(const void *key, int size) {
    return hashBytes(&key, sizeof key, size);
}

static int MEAPI compareAddresses(const void *k1, const void *k2) {
    return k1 != k2;
}

static MeBool isHashable(const void *key, int size, const char *function) {
    if (!key || size < 1)
        MeWarning(1, "%s: the key is %p, the size is %d", function, key, size);
    return key && size >= 1;
}

int MEAPI MeHashInt(const void *i, int size) {
    return isHashable(i, size, __func__) ? hashBytes(i, sizeof(int), size) : 0;
}

int MEAPI MeHashString(const void *i, int size) {
    return isHashable(i, size, __func__) ? hashBytes(i, strlen(i), size) : 0;
}

int MEAPI MeHashIntCompare(const void *k1, const void *k2) {
    if (!isHashable(k1, 1, __func__) || !isHashable(k2, 1, __func__))
        return k1 != k2;
    const int a = *(const int *)k1, b = *(const int *)k2;
    return (a > b) - (a < b);
}

int MEAPI MeHashStringCompare(const void *k1, const void *k2) {
    if (!isHashable(k1, 1, __func__) || !isHashable(k2, 1, __func__))
        return k1 != k2;
    return strcmp(k1, k2);
}

/* ---- life ---- */

MeHash *MEAPI MeHashCreate(int size) {
    if (size < 1) {
        MeWarning(1, "MeHashCreate: size is %d, which must be 1 or more", size);
        return NULL;
    }
    const size_t bytes = (size_t)size * sizeof(MeHashBucket *);
    MeHash *table = MeMemoryTakeZeroed(1, sizeof *table + bytes, __func__, "a table");
    if (!table)
        return NULL;
    table->bucket = (MeHashBucket **)(table + 1);
    table->size = size;
    table->hash = hashAddress;
    table->compare = compareAddresses;
    return table;
}

void MEAPI MeHashReset(MeHash *table) {
    if (!isTable(table, __func__))
        return;
    for (MeHashBucket *b = table->first, *after; b; b = after) {
        after = b->after;
        if (table->keyFree)
            table->keyFree((void *)(size_t)b->key);
        if (table->datumFree)
            table->datumFree(b->datum);
        MeMemoryGive(b);
    }
    memset(table->bucket, 0, (size_t)table->size * sizeof *table->bucket);
    table->first = table->last = NULL;
    table->population = 0;
}

void MEAPI MeHashDestroy(MeHash *table) {
    if (!isTable(table, __func__))
        return;
    MeHashReset(table);
    MeMemoryGive(table);
}

/* Whether the table is empty: changing hash or comparison would lose entries. False: with a warning. */
static MeBool isEmpty(const MeHash *table, const char *function) {
    if (!isTable(table, function))
        return MEFALSE;
    if (table->population)
        MeWarning(1, "%s: there are %d entries in the table; nothing is changed", function, table->population);
    return !table->population;
}

void MEAPI MeHashSetHashFunc(MeHash *table, MeHashFunc hash) {
    if (isEmpty(table, __func__))
        table->hash = hash ? hash : hashAddress;
}

void MEAPI MeHashSetKeyCompareFunc(MeHash *table, MeHashCompareFunc compare) {
    if (isEmpty(table, __func__))
        table->compare = compare ? compare : compareAddresses;
}

void MEAPI MeHashSetKeyFreeFunc(MeHash *table, MeHashFreeFunc keyFree) {
    if (isTable(table, __func__))
        table->keyFree = keyFree;
}

void MEAPI MeHashSetDatumFreeFunc(MeHash *table, MeHashFreeFunc datumFree) {
    if (isTable(table, __func__))
        table->datumFree = datumFree;
}

/* ---- entries ---- */

/* The pointer that refers to the entry of a key, or the null pointer at the end of its chain. */
static MeHashBucket **findLink(const MeHash *table, const void *key, const char *function) {
    const int hash = table->hash(key, table->size);
    const MeBool isInside = hash >= 0 && hash < table->size;
    if (!isInside)
        MeWarning(1, "%s: the table's hash function gave %d, not 0 .. %d", function, hash, table->size - 1);
    MeHashBucket **place = &table->bucket[isInside ? hash : 0];
    while (*place && table->compare((*place)->key, key) != 0)
        place = &(*place)->next;
    return place;
}

void *MEAPI MeHashInsert(const void *key, const void *datum, MeHash *table) {
    if (!isTable(table, __func__))
        return NULL;
    MeHashBucket **place = findLink(table, key, __func__), *b = *place;
    if (b) {
        void *old = b->datum;
        b->datum = (void *)(size_t)datum;
        return old;
    }
    b = MeMemoryTake(1, sizeof *b, __func__, "an entry");
    if (!b)
        return NULL;
    *b = (MeHashBucket){.key = key, .datum = (void *)(size_t)datum, .before = table->last};
    *(table->last ? &table->last->after : &table->first) = b;
    MEASSERT(*place == NULL);
    table->last = *place = b;
    table->population++;
    return NULL;
}

void *MEAPI MeHashLookup(const void *key, const MeHash *table) {
    const MeHashBucket *b = isTable(table, __func__) ? *findLink(table, key, __func__) : NULL;
    return b ? b->datum : NULL;
}

void *MEAPI MeHashDelete(const void *key, MeHash *table) {
    if (!isTable(table, __func__))
        return NULL;
    MeHashBucket **place = findLink(table, key, __func__), *b = *place;
    if (!b)
        return NULL;
    void *datum = b->datum;
    *place = b->next;
    *(b->before ? &b->before->after : &table->first) = b->after;
    *(b->after ? &b->after->before : &table->last) = b->before;
    if (table->keyFree)
        table->keyFree((void *)(size_t)b->key);
    MeMemoryGive(b);
    table->population--;
    MEASSERT(table->population >= 0);
    MEVALIDATE(countEntries(table) == table->population);
    return datum;
}

int MEAPI MeHashPopulation(const MeHash *table) {
    return isTable(table, __func__) ? table->population : 0;
}

MeHashIterator *MEAPI MeHashInitIterator(MeHashIterator *i, const MeHash *table) {
    if (me_isGiven(i, "iterator", __func__)) {
        const MeBool isGiven = isTable(table, __func__);
        *i = (MeHashIterator){.table = isGiven ? table : NULL, .next = isGiven ? table->first : NULL};
    }
    return i;
}

void *MEAPI MeHashGetDatum(MeHashIterator *i) {
    if (!me_isGiven(i, "iterator", __func__) || !i->next)
        return NULL;
    void *datum = i->next->datum;
    i->next = i->next->after;
    return datum;
}
