/** @file MeDict.h
 *  Dictionaries: nodes ordered by keys; search, insertion and removal take logarithmic time. MdtUpdatePartitions uses
 *  one.
 *
 *  A node has a data pointer of the program and, while it is in a dictionary, a key, which must not change meanwhile.
 *  The program provides the memory of nodes (MeDictNodeInit) or has them allocated one by one (MeDictNodeCreate); keys
 *  and data are always the program's. Members of the structures are private. Every function warns of a null pointer,
 *  and then does nothing or returns 0. A dictionary may be used by one thread at a time.
 */
#ifndef MEDICT_H
#define MEDICT_H

#include "MePrecision.h"
#include <limits.h>

ME_BEGIN_C

#define DICTCOUNT_T_MAX ULONG_MAX /**< As maxcount: no limit. */

typedef struct MeDict MeDict;
typedef struct MeDictNode MeDictNode;

/** Returns a value less than, equal to or greater than 0 if key1 is before, equal to or after key2. */
typedef int(MEAPI *MeDictCompareFn)(const void *key1, const void *key2);
/** Allocates a node that is in no dictionary; null if there is none. */
typedef MeDictNode *(MEAPI *MeDictAllocFn)(void *context);
/** Frees such a node. */
typedef void(MEAPI *MeDictFreeFn)(MeDictNode *node, void *context);
/** Called with a node; may remove it from the dictionary. */
typedef void(MEAPI *MeDictProcessFn)(MeDict *dict, MeDictNode *node, void *context);

struct MeDictNode {
    MeDictNode *child[2], *parent;
    MeDict *dict; /* null: none */
    const void *key;
    void *data;
    MeU32 priority;
};

struct MeDict {
    MeDictNode *root;
    unsigned long count, maxCount;
    MeDictCompareFn compare;
    MeDictAllocFn alloc;
    MeDictFreeFn free;
    void *context;
    MeU32 seed;
    MeBool allowsDupes, isCreated;
};

/** A dictionary that is being filled in order. Its members are private. */
typedef struct MeDictLoad {
    MeDict *dict;
    MeDictNode *last;
} MeDictLoad;

/** @name Life
 *  @{ */
/** Initializes an empty dictionary in the program's memory, for at most maxcount nodes. Null for a null argument. */
MEPUBLIC MeDict *MEAPI MeDictInit(MeDict *dict, unsigned long maxcount, MeDictCompareFn compare);
/** Allocates an empty dictionary; null, after MeFatalError, without memory. Free it with MeDictDestroy. */
MEPUBLIC MeDict *MEAPI MeDictCreate(unsigned long maxcount, MeDictCompareFn compare);
/** Initializes an empty dictionary in the program's memory, with the limit, comparison, allocator and handling of equal
 *  keys of another one. */
MEPUBLIC void MEAPI MeDictInitLike(MeDict *dict, const MeDict *like);
/** Have two dictionaries the same comparison, allocator and handling of equal keys? */
MEPUBLIC int MEAPI MeDictSimilar(const MeDict *dict1, const MeDict *dict2);
/** Destroys a dictionary made by MeDictCreate. If it is not empty, warns and removes the nodes. */
MEPUBLIC void MEAPI MeDictDestroy(MeDict *dict);
/** Allows equal keys; later nodes come after earlier ones. Default: not allowed. */
MEPUBLIC void MEAPI MeDictAllowDupes(MeDict *dict);
/** Sets the allocator for MeDictAllocInsert and MeDictDeleteFree; both null: MeDictNodeCreate and MeDictNodeDestroy. */
MEPUBLIC void MEAPI MeDictSetAllocator(MeDict *dict, MeDictAllocFn alloc, MeDictFreeFn freeNode, void *context);
/** @} */

/** @name Nodes
 *  @{ */
/** Prepares a node in memory of the program for insertion, with its data. Returns the node. */
MEPUBLIC MeDictNode *MEAPI MeDictNodeInit(MeDictNode *node, void *data);
/** Null, after MeFatalError, if there is no memory. */
MEPUBLIC MeDictNode *MEAPI MeDictNodeCreate(void *data);
/** Destroys a node made by MeDictNodeCreate; a node in a dictionary is kept, with a warning. */
MEPUBLIC void MEAPI MeDictNodeDestroy(MeDictNode *node);
/** The data of a node: given at MeDictNodeInit or MeDictNodeCreate, changed by MeDictNodePut. */
MEPUBLIC void *MEAPI MeDictNodeGet(MeDictNode *node);
/** Replaces the data; the old ones are not freed. */
MEPUBLIC void MEAPI MeDictNodePut(MeDictNode *node, void *data);
/** The node's key; null while it is in no dictionary. */
MEPUBLIC const void *MEAPI MeDictNodeGetKey(MeDictNode *node);
/** 1 while the node is in some dictionary, else 0. */
MEPUBLIC int MEAPI MeDictNodeIsInADict(MeDictNode *node);
/** @} */

/** @name Insertion and removal
 *  @{ */
/** Inserts a node. Warns and does nothing if the dictionary is full, the node is in one already, or the key exists. */
MEPUBLIC void MEAPI MeDictInsert(MeDict *dict, MeDictNode *node, const void *key);
/** Inserts a newly allocated node with the given data; returns 1 on success. */
MEPUBLIC int MEAPI MeDictAllocInsert(MeDict *dict, const void *key, void *data);
/** Removes a node and returns it; null, with a warning, if it is not in this dictionary. */
MEPUBLIC MeDictNode *MEAPI MeDictDelete(MeDict *dict, MeDictNode *node);
/** Removes a node and frees it by the allocator. */
MEPUBLIC void MEAPI MeDictDeleteFree(MeDict *dict, MeDictNode *node);
/** MeDictDeleteFree of all nodes. */
MEPUBLIC void MEAPI MeDictFreeNodes(MeDict *dict);
MEPUBLIC void MEAPI MeDictFree(MeDict *dict); /**< The same as MeDictFreeNodes. */
/**
 * Moves the nodes of source to dict, which must be similar (MeDictSimilar), otherwise warns and moves none. Nodes whose
 * keys exist in dict remain in source, unless equal keys are allowed; so do nodes that exceed dict's limit, with a
 * warning.
 */
MEPUBLIC void MEAPI MeDictMerge(MeDict *dict, MeDict *source);
/** Begins filling an empty dictionary with nodes in the order of their keys, in constant time per node. If it is not
 *  empty, warns, and nothing is inserted. */
MEPUBLIC void MEAPI MeDictLoadBegin(MeDictLoad *load, MeDict *dict);
/** Inserts the next node. Warns and does nothing if its key is before the last one, or in the cases of MeDictInsert. */
MEPUBLIC void MEAPI MeDictLoadNext(MeDictLoad *load, MeDictNode *node, const void *key);
/** Ends filling a dictionary. */
MEPUBLIC void MEAPI MeDictLoadEnd(MeDictLoad *load);
/** @} */

/** @name Search
 *  Functions that return a node return null if there is none.
 *  @{ */
/** The first node with the key. */
MEPUBLIC MeDictNode *MEAPI MeDictLookup(MeDict *dict, const void *key);
/** The first node whose key is not before the given one. */
MEPUBLIC MeDictNode *MEAPI MeDictLowerBound(MeDict *dict, const void *key);
/** The last node whose key is not after the given one. */
MEPUBLIC MeDictNode *MEAPI MeDictUpperBound(MeDict *dict, const void *key);
/** The nodes with the smallest and the largest key, by the dictionary's comparison. */
MEPUBLIC MeDictNode *MEAPI MeDictFirst(MeDict *dict);
/** The node with the largest key; null if the dictionary is empty. */
MEPUBLIC MeDictNode *MEAPI MeDictLast(MeDict *dict);
/** The neighbour of a node in the order of keys; null at the end. */
MEPUBLIC MeDictNode *MEAPI MeDictNext(MeDict *dict, MeDictNode *node);
/** The node before; null at the first. */
MEPUBLIC MeDictNode *MEAPI MeDictPrev(MeDict *dict, MeDictNode *node);
/** The number of nodes; it is full at the maximum of MeDictInit. */
MEPUBLIC unsigned long MEAPI MeDictCount(MeDict *dict);
/** Whether it has no nodes. */
MEPUBLIC int MEAPI MeDictIsEmpty(MeDict *dict);
/** Whether it has the largest number of nodes. */
MEPUBLIC int MEAPI MeDictIsFull(MeDict *dict);
/** Is this node in the dictionary? */
MEPUBLIC int MEAPI MeDictContains(MeDict *dict, MeDictNode *node);
/** Calls f for every node, in order. */
MEPUBLIC void MEAPI MeDictProcess(MeDict *dict, void *context, MeDictProcessFn f);
/** Are the keys in order and the links consistent? Takes linear time. */
MEPUBLIC int MEAPI MeDictVerify(MeDict *dict);
/** @} */

ME_END_C

#endif
