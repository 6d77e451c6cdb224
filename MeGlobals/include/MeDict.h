/** @file MeDict.h
 *  Dictionaries: nodes in the order of their keys, found, put in and taken out in logarithmic time. MdtUpdatePartitions
 *  takes one (User Guide ch. 2).
 *
 *  A node carries a pointer of the program's and, while it is in a dictionary, its key, which must not change
 *  meanwhile. Nodes are the program's, in its own memory (MeDictNodeInit) or made one by one (MeDictNodeCreate); keys
 *  and what nodes point to are its own in any case. Members of the structures are private. Every function warns of a
 *  null pointer, and then does nothing or gives 0. A dictionary is for one thread at a time.
 */
#ifndef MEDICT_H
#define MEDICT_H

#include "MePrecision.h"
#include <limits.h>

ME_BEGIN_C

#define DICTCOUNT_T_MAX ULONG_MAX /**< As a maxcount: no limit. */

typedef struct MeDict MeDict;
typedef struct MeDictNode MeDictNode;

/** Less than, equal to or greater than 0, as key1 is before, the same as or after key2. */
typedef int(MEAPI *MeDictCompareFn)(const void *key1, const void *key2);
/** Gives a node that is in no dictionary; null if there is none. */
typedef MeDictNode *(MEAPI *MeDictAllocFn)(void *context);
/** Takes such a node back. */
typedef void(MEAPI *MeDictFreeFn)(MeDictNode *node, void *context);
/** Sees a node; may take it out of the dictionary. */
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
/** Makes an empty dictionary of memory that is the program's, for at most maxcount nodes. Null for a null argument. */
MEPUBLIC MeDict *MEAPI MeDictInit(MeDict *dict, unsigned long maxcount, MeDictCompareFn compare);
/** The same in memory of its own; null, after MeFatalError, if there is none. MeDictDestroy gives it back. */
MEPUBLIC MeDict *MEAPI MeDictCreate(unsigned long maxcount, MeDictCompareFn compare);
/** Makes an empty dictionary of memory that is the program's, with the limit, the order, the allocator and the leave
 *  for equal keys of another one. */
MEPUBLIC void MEAPI MeDictInitLike(MeDict *dict, const MeDict *like);
/** Have two dictionaries the same order, the same allocator, and the same leave for equal keys? */
MEPUBLIC int MEAPI MeDictSimilar(const MeDict *dict1, const MeDict *dict2);
/** Destroys a dictionary that MeDictCreate made. One that is not empty gets a warning; its nodes are in none then. */
MEPUBLIC void MEAPI MeDictDestroy(MeDict *dict);
/** Lets several nodes have the same key; later ones come after earlier ones. Default: not. */
MEPUBLIC void MEAPI MeDictAllowDupes(MeDict *dict);
/** Where MeDictAllocInsert gets nodes and MeDictDeleteFree puts them; both null: MeDictNodeCreate and
 *  MeDictNodeDestroy. */
MEPUBLIC void MEAPI MeDictSetAllocator(MeDict *dict, MeDictAllocFn alloc, MeDictFreeFn freeNode, void *context);
/** @} */

/** @name Nodes
 *  @{ */
MEPUBLIC MeDictNode *MEAPI MeDictNodeInit(MeDictNode *node, void *data);
/** Null, after MeFatalError, if there is no memory. */
MEPUBLIC MeDictNode *MEAPI MeDictNodeCreate(void *data);
/** Destroys a node that MeDictNodeCreate made; one that is in a dictionary gets a warning and stays. */
MEPUBLIC void MEAPI MeDictNodeDestroy(MeDictNode *node);
MEPUBLIC void *MEAPI MeDictNodeGet(MeDictNode *node);
MEPUBLIC void MEAPI MeDictNodePut(MeDictNode *node, void *data);
/** Null while it is in no dictionary. */
MEPUBLIC const void *MEAPI MeDictNodeGetKey(MeDictNode *node);
MEPUBLIC int MEAPI MeDictNodeIsInADict(MeDictNode *node);
/** @} */

/** @name In and out
 *  @{ */
/** Puts a node in. A full dictionary, a node that is in one, and a key that is there already get a warning. */
MEPUBLIC void MEAPI MeDictInsert(MeDict *dict, MeDictNode *node, const void *key);
/** The same with a node of the allocator's that carries data; 1 if it is in now. */
MEPUBLIC int MEAPI MeDictAllocInsert(MeDict *dict, const void *key, void *data);
/** Takes a node out, and returns it; null, with a warning, if it is not in this dictionary. */
MEPUBLIC MeDictNode *MEAPI MeDictDelete(MeDict *dict, MeDictNode *node);
/** The same, and back to the allocator. */
MEPUBLIC void MEAPI MeDictDeleteFree(MeDict *dict, MeDictNode *node);
/** MeDictDeleteFree of all nodes. */
MEPUBLIC void MEAPI MeDictFreeNodes(MeDict *dict);
MEPUBLIC void MEAPI MeDictFree(MeDict *dict); /**< The same. */
/**
 * Moves the nodes of source to dict, which must be similar (MeDictSimilar), else it warns and moves none. Nodes whose
 * keys are in dict already stay in source, unless equal keys are allowed; and, with a warning, those for which dict is
 * too full.
 */
MEPUBLIC void MEAPI MeDictMerge(MeDict *dict, MeDict *source);
/** Begins to fill an empty dictionary with nodes in the order of their keys, which takes constant time for each. One
 *  that is not empty gets a warning; nothing is put in then. */
MEPUBLIC void MEAPI MeDictLoadBegin(MeDictLoad *load, MeDict *dict);
/** Puts the next node in. A key before that of the last one gets a warning, as does what MeDictInsert warns of. */
MEPUBLIC void MEAPI MeDictLoadNext(MeDictLoad *load, MeDictNode *node, const void *key);
/** Ends that. */
MEPUBLIC void MEAPI MeDictLoadEnd(MeDictLoad *load);
/** @} */

/** @name Finding
 *  Null where there is none.
 *  @{ */
/** The first node with that key. */
MEPUBLIC MeDictNode *MEAPI MeDictLookup(MeDict *dict, const void *key);
/** The first node whose key is not before that one. */
MEPUBLIC MeDictNode *MEAPI MeDictLowerBound(MeDict *dict, const void *key);
/** The last node whose key is not after that one. */
MEPUBLIC MeDictNode *MEAPI MeDictUpperBound(MeDict *dict, const void *key);
MEPUBLIC MeDictNode *MEAPI MeDictFirst(MeDict *dict);
MEPUBLIC MeDictNode *MEAPI MeDictLast(MeDict *dict);
MEPUBLIC MeDictNode *MEAPI MeDictNext(MeDict *dict, MeDictNode *node);
MEPUBLIC MeDictNode *MEAPI MeDictPrev(MeDict *dict, MeDictNode *node);
MEPUBLIC unsigned long MEAPI MeDictCount(MeDict *dict);
MEPUBLIC int MEAPI MeDictIsEmpty(MeDict *dict);
MEPUBLIC int MEAPI MeDictIsFull(MeDict *dict);
/** Is that very node in it? */
MEPUBLIC int MEAPI MeDictContains(MeDict *dict, MeDictNode *node);
/** Calls f for every node, in order. */
MEPUBLIC void MEAPI MeDictProcess(MeDict *dict, void *context, MeDictProcessFn f);
/** Is it in order, and are its links sound? Takes time in proportion to its nodes. */
MEPUBLIC int MEAPI MeDictVerify(MeDict *dict);
/** @} */

ME_END_C

#endif
