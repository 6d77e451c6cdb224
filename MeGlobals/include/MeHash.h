/** @file MeHash.h
 *  Hash tables: pointers by keys, found in constant time.
 *
 *  Keys and data are the program's and must stay while they are in the table; functions to free them may be set. What a
 *  key is, the hash and comparison functions say: by default its address counts, and for keys that point to ints or
 *  strings there are functions here. Set functions while the table is empty. Every function warns of a null pointer,
 *  and then does nothing or gives 0. A table is for one thread at a time.
 */
#ifndef MEHASH_H
#define MEHASH_H

#include "MePrecision.h"

ME_BEGIN_C

/** A number from 0 to size - 1, the same for keys that are equal. */
typedef int(MEAPI *MeHashFunc)(const void *key, int size);
/** 0 for keys that are equal. */
typedef int(MEAPI *MeHashCompareFunc)(const void *key1, const void *key2);
/** Frees a key or a datum. */
typedef void(MEAPI *MeHashFreeFunc)(void *const item);

/** An entry. Its members are private. */
typedef struct MeHashBucket {
    const void *key;
    void *datum;
    struct MeHashBucket *next;           /* of the same hash */
    struct MeHashBucket *before, *after; /* in the order in which they came */
} MeHashBucket;

/** A table. Its members are private. */
typedef struct MeHash {
    MeHashBucket **bucket, *first, *last;
    int size, population;
    MeHashFunc hash;
    MeHashCompareFunc compare;
    MeHashFreeFunc keyFree, datumFree;
} MeHash;

/** Where one is in a table. Its members are private. */
typedef struct MeHashIterator {
    const MeHash *table;
    const MeHashBucket *next;
} MeHashIterator;

/** Makes an empty table of so many buckets, 1 or more: best about as many as there will be entries, of which there may
 *  be any number. Null, with a warning, for less than 1, and, after MeFatalError, without memory. */
MEPUBLIC MeHash *MEAPI MeHashCreate(int size);
/** Frees the table and what is in it, by the functions that were set. */
MEPUBLIC void MEAPI MeHashDestroy(MeHash *table);
/** Empties the table, and frees what was in it by the functions that were set. */
MEPUBLIC void MEAPI MeHashReset(MeHash *table);

/** @name What keys are, and who frees them
 *  Null: the default again, the key's address; nobody.
 *  @{ */
MEPUBLIC void MEAPI MeHashSetHashFunc(MeHash *table, MeHashFunc hash);
MEPUBLIC void MEAPI MeHashSetKeyCompareFunc(MeHash *table, MeHashCompareFunc compare);
MEPUBLIC void MEAPI MeHashSetKeyFreeFunc(MeHash *table, MeHashFreeFunc keyFree);
MEPUBLIC void MEAPI MeHashSetDatumFreeFunc(MeHash *table, MeHashFreeFunc datumFree);
MEPUBLIC int MEAPI MeHashInt(const void *i, int size);                  /**< The key points to an int. */
MEPUBLIC int MEAPI MeHashIntCompare(const void *k1, const void *k2);    /**< For ints. */
MEPUBLIC int MEAPI MeHashString(const void *i, int size);               /**< The key is a string. */
MEPUBLIC int MEAPI MeHashStringCompare(const void *k1, const void *k2); /**< For strings. */
/** @} */

/** @name Entries
 *  @{ */
/** Puts a datum in. Where there is one with that key, it replaces that one, which is returned and not freed; the key
 *  stays the one that was there. Else returns null. */
MEPUBLIC void *MEAPI MeHashInsert(const void *key, const void *datum, MeHash *table);
/** The datum with that key; null: none. */
MEPUBLIC void *MEAPI MeHashLookup(const void *key, const MeHash *table);
/** Takes the entry with that key out; its key is freed by the function that was set, its datum is returned. Null:
 *  none. */
MEPUBLIC void *MEAPI MeHashDelete(const void *key, MeHash *table);
/** How many entries there are. */
MEPUBLIC int MEAPI MeHashPopulation(const MeHash *table);
/** Begins with the entry that came first; returns i. The table must not lose entries until the last one was seen. */
MEPUBLIC MeHashIterator *MEAPI MeHashInitIterator(MeHashIterator *i, const MeHash *table);
/** The datum of the next entry, in the order in which they came; null after the last. */
MEPUBLIC void *MEAPI MeHashGetDatum(MeHashIterator *i);
/** @} */

ME_END_C

#endif
