/** @file MeHash.h
 *  Hash tables: map keys to pointers, in constant time.
 *
 *  Keys and data are owned by the program and must exist while they are in the table; functions to free them may be
 *  set. The hash and comparison functions define the meaning of keys: by default a key's address, with functions here
 *  for keys that point to ints or strings. Set them while the table is empty. Every function warns of a null pointer,
 *  and then does nothing or returns 0. A table may be used by one thread at a time.
 */
#ifndef MEHASH_H
#define MEHASH_H

#include "MePrecision.h"

ME_BEGIN_C

/** Returns a number from 0 to size - 1, the same for equal keys. */
typedef int(MEAPI *MeHashFunc)(const void *key, int size);
/** Returns 0 for equal keys. */
typedef int(MEAPI *MeHashCompareFunc)(const void *key1, const void *key2);
/** Frees a key or a datum. */
typedef void(MEAPI *MeHashFreeFunc)(void *const item);

/** An entry. Its members are private. */
typedef struct MeHashBucket {
    const void *key;
    void *datum;
    struct MeHashBucket *next;           /* entries of the same hash */
    struct MeHashBucket *before, *after; /* entries in the order of insertion */
} MeHashBucket;

/** A table. Its members are private. */
typedef struct MeHash {
    MeHashBucket **bucket, *first, *last;
    int size, population;
    MeHashFunc hash;
    MeHashCompareFunc compare;
    MeHashFreeFunc keyFree, datumFree;
} MeHash;

/** The state of an iteration. */
typedef struct MeHashIterator {
    const MeHash *table;
    const MeHashBucket *next;
} MeHashIterator;

/** Creates an empty table with @a size buckets, 1 or more: best about the number of entries, which is not limited.
 *  Null: with a warning, for less than 1; after MeFatalError, without memory. */
MEPUBLIC MeHash *MEAPI MeHashCreate(int size);
/** Frees the table, and its keys and data by the functions that were set. */
MEPUBLIC void MEAPI MeHashDestroy(MeHash *table);
/** Removes all entries, and frees keys and data by the functions that were set. */
MEPUBLIC void MEAPI MeHashReset(MeHash *table);

/** @name Functions for keys and data
 *  Null restores the default: the key is its address; keys and data are not freed.
 *  @{ */
/** Changes where keys are found: only while the table is empty. */
MEPUBLIC void MEAPI MeHashSetHashFunc(MeHash *table, MeHashFunc hash);
/** Returns 0 for equal keys. Only while the table is empty. */
MEPUBLIC void MEAPI MeHashSetKeyCompareFunc(MeHash *table, MeHashCompareFunc compare);
/** Called with a key whose entry is removed. */
MEPUBLIC void MEAPI MeHashSetKeyFreeFunc(MeHash *table, MeHashFreeFunc keyFree);
/** Called with a datum that is removed or replaced. */
MEPUBLIC void MEAPI MeHashSetDatumFreeFunc(MeHash *table, MeHashFreeFunc datumFree);
MEPUBLIC int MEAPI MeHashInt(const void *i, int size);                  /**< The key points to an int. */
MEPUBLIC int MEAPI MeHashIntCompare(const void *k1, const void *k2);    /**< For ints. */
MEPUBLIC int MEAPI MeHashString(const void *i, int size);               /**< The key is a string. */
MEPUBLIC int MEAPI MeHashStringCompare(const void *k1, const void *k2); /**< For strings. */
/** @} */

/** @name Entries
 *  @{ */
/** Inserts a datum. If the key exists, replaces its datum and returns the old one without freeing it; the old key is
 *  kept. Otherwise returns null. */
MEPUBLIC void *MEAPI MeHashInsert(const void *key, const void *datum, MeHash *table);
/** The datum of a key; null if there is none. */
MEPUBLIC void *MEAPI MeHashLookup(const void *key, const MeHash *table);
/** Removes the entry of a key, frees the key by the function that was set, and returns the datum. Null if there is
 *  none. */
MEPUBLIC void *MEAPI MeHashDelete(const void *key, MeHash *table);
/** The number of entries. */
MEPUBLIC int MEAPI MeHashPopulation(const MeHash *table);
/** Starts an iteration at the first inserted entry; returns i. Do not remove entries until the iteration is done. */
MEPUBLIC MeHashIterator *MEAPI MeHashInitIterator(MeHashIterator *i, const MeHash *table);
/** The datum of the next entry, in the order of insertion; null after the last. */
MEPUBLIC void *MEAPI MeHashGetDatum(MeHashIterator *i);
/** @} */

ME_END_C

#endif
