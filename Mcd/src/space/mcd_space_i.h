/* Inside Mcd: the records of spaces: proxies, links and pairs of the broad phase.
 *
 * A model in a space is a proxy: its box of the last update, and a fat box around that which is in the tree. A link
 * joins two proxies whose fat boxes overlap, or that are disabled; links are found by a hash table and hang in a list
 * at each of their proxies. A link whose exact boxes overlap has a pair, which is what programs see. Pairs of two
 * frozen models are silent: they hang at their links and are in no list, so that they cost no time. Links between
 * frozen models that have no pair are dropped, and found again when one of them is unfrozen.
 *
 * At the end of a block only what changed is looked at: proxies that left their fat box are looked up in the tree for
 * new links, and the links of proxies that changed at all are classified anew.
 *
 * Proxies and links are known by their index, and move when there is no room for more; a model's pointer to its proxy
 * is set anew then. Pairs never move.
 */
#ifndef MCD_SPACE_I_H
#define MCD_SPACE_I_H

#include "McdSpace.h"
#include "MeTeam.h"
#include "pair/mcd_pair_i.h"
#include "space/mcd_tree_i.h"
#include <stdbool.h>

enum { MCD_NONE = -1 };
/* Models that a worker updates at a time: .5 us each, against 1 to begin and end a loop. With half as many and twice as
 * many, a heap of 1000 boxes takes the same time, within 5 % (bench/threads). Fewer than so many ranges are not worth
 * waking a thread for. */
enum { MCD_RANGE = 64, MCD_MIN_RANGES = 4 };
/* Links that a worker looks through at a time: some 10 us, against 1 to begin and end a loop. */
enum { MCD_LINK_RANGE = 1024 };
/* Pairs in the first block, and so many blocks at most, each twice as large as the last: as many as an int counts. */
enum { MCD_PAIR_BLOCK = 128, MCD_PAIR_BLOCKS = 23 };

/* Two cache lines of 64 bytes, in single precision: an update of models that are where they were, and the
 * classification of near pairs, read the first one only. */
typedef struct McdProxy {
    _Alignas(ME_CACHE_LINE) MeReal min[3];
    MeReal max[3], tolerance; /* m: margin of contacts, mcd_modelReach */
    bool hasBox : 1, isFrozen : 1;
    bool isDirty : 1;     /* its links are to be classified */
    bool isAwake : 1;     /* linked by previousAwake, nextAwake; a frozen one until the next update unlinks it */
    bool isUnbounded : 1; /* in McdSpace.unbounded, not in the tree */
    bool isMoved : 1;     /* its fat box is new: look for links */
    bool isWarned : 1;    /* of its transform */
    McdFilter filter;     /* the model's */
    int nextAwake;        /* the next one that is updated */
    McdCullingTable *table;
    McdModelRecord *model; /* null: free */

    McdTreeBox fat;
    int cullingIndex, cullingID;
    int firstLink, previousAwake;
    int previous, next; /* in the order of insertion; next also links the free ones */
    McdTreeLeaf *leaf;  /* null: no box yet, or without bounds */
    MeU64 order;        /* the model's place in the order of pairs: sort key, then creation */
} McdProxy;

_Static_assert((offsetof(McdProxy, fat) == ME_CACHE_LINE && sizeof(McdProxy) == 2 * ME_CACHE_LINE) ||
                   sizeof(MeReal) > 4,
               "two lines");

typedef struct McdPairRecord McdPairRecord;
struct McdPairRecord {
    _Alignas(ME_CACHE_LINE) McdModelPair pair; /* what programs see: first */
    McdPairRecord *nextFree;
    MeBool wasSilent; /* when it said goodbye: it is among the goodbyes only */
};

_Static_assert(offsetof(McdModelPair, responseData) == ME_CACHE_LINE, "McdModelPairLook reads one line");

typedef struct McdPairEntry {
    MeU64 order2, order1; /* of model2 and model1 */
    union {
        McdPairRecord *record;
        int link;
    };
} McdPairEntry;

typedef struct McdPairList {
    McdPairEntry *entry;
    int count, max;
} McdPairList;

/* Of each pair of near boxes, together 256 bytes in single precision (docs/lab/speed.md, "At rest"). */
typedef struct McdLink {
    int proxy[2]; /* proxy[0] comes later in the order: it is model1; MCD_NONE: the link is free */
    int previous[2], next[2];
    int nextInHash;             /* also links the free ones */
    bool isDisabled, isWaiting; /* waiting for room among the pairs */
    bool isSilent;              /* its pair stays, but both models are frozen: it is in no list */
    McdPairRecord *record;
} McdLink;

_Static_assert(sizeof(McdPairRecord) == 3 * ME_CACHE_LINE || sizeof(MeReal) > 4, "three lines");
_Static_assert(sizeof(McdLink) <= 40 && sizeof(McdPairEntry) <= 24, "256 bytes with a pair's record");

struct _McdSpace {
    MeU32 magic;
    MeHandle handle;
    McdFramework *frame;
    int axes;
    MeLimit modelLimit, pairLimit;
    MeBool isChanging;
    MeBool isInner;                 /* a callback of a stage has opened a block, which is done when the stage ends */
    MeBool isOpenedLater;           /* for it, a block was opened then */
    MeBool isUpdating;              /* callbacks of the program are running */
    MeBool isFirstBlock, isUpdated; /* the block that creation opened; McdSpaceUpdateAll was called in it */
    MeU32 step;
    MeReal lookAhead; /* s */
    McdSpaceUpdateAABBFnPtr update;
    McdSpacePoolErrorFnPtr poolFull;
    MeBool queriesHitSensors;
    void *userData;
    void *collider; /* see McdSpaceSetCollider */

    McdProxy *proxy; /* proxyRoom; moves when there is no room for another one */
    int proxyRoom;
    int proxyCount, firstProxy, lastProxy, freeProxy;
    MeU64 changesSeen;         /* of the framework's, by mcd_frozen.c, */
    int nextLook;              /* whose turn begins behind this proxy */
    int firstAwake, lastAwake; /* what is updated: frozen models cost no time */
    int *awake, awakeCount;    /* the same, as they were listed for workers; MCD_NONE: not since; proxyRoom */
    MeU8 *updates;             /* beside awake: an McdBoxUpdate */
    MeTeam *team;              /* workers; null: none */
    int *dirty, dirtyCount;    /* proxies; proxyRoom */
    int *found, *foundEnd;     /* beside dirty: what workers have found (mcd_pairs.c) */
    int foundRoom, foundEndRoom;
    int *unbounded, unboundedCount; /* proxies that are in no tree; proxyRoom */
    McdTree *tree;

    McdLink *link;
    int linkMax, freeLink, linkCount;
    MeU8 *changes; /* beside link: which are to be classified, as workers have found (mcd_pairs.c) */
    int changesRoom;
    int *hash, hashSize; /* a power of 2, or 0 */

    /* All lists of pairs have room for all records in the blocks, and wanted for all links: only making these larger
     * can fail for want of memory, and then nothing has begun yet. */
    McdPairRecord *block[MCD_PAIR_BLOCKS];
    int blockCount, liveCount, waitingCount;
    McdPairRecord *freePair;
    MeBool isStale; /* there are erased pairs in the lists: their phase is kMcdFFStateInactive */
    McdPairList hello, staying, goodbye, pending;
    McdPairList silenced, woken; /* of the block that ends: out of, and back to, the staying ones */
    McdSpacePairIterator own;    /* of the calls without an iterator */
};

/* ---- proxies (McdSpace.c) ---------------------------------------------------------------------------------------- */

MeBool mcd_spaceCheck(McdSpaceID s, const char *function);
/* Is it a space outside a change block? Ends the first block, if McdSpaceUpdateAll was called in it. */
MeBool mcd_spaceIsReady(McdSpaceID s, const char *function);

/* ---- links and pairs (mcd_pairs.c) ------------------------------------------------------------------------------- */

void mcd_proxyTouch(McdSpace *s, int proxy);          /* its links are classified at the end of the block */
void mcd_pairsForgetProxy(McdSpace *s, int proxy);    /* drops its links; its pairs say goodbye */
void mcd_pairsEraseProxy(McdSpace *s, int proxy);     /* drops its links and its pairs, which say nothing */
void mcd_pairsForgetContacts(McdSpace *s, int proxy); /* what Mst has of its pairs, which stay */
void mcd_pairsTidy(McdSpace *s);                      /* takes erased pairs out of the lists */
MeBool mcd_pairsDisable(McdSpace *s, int a, int b);   /* false: no memory */
void mcd_pairsEnable(McdSpace *s, int a, int b);
MeBool mcd_pairsAreEnabled(const McdSpace *s, int a, int b); /* neither disabled, culled nor filtered */
void mcd_pairsBegin(McdSpace *s);                            /* a block begins: goodbyes become invalid */
void mcd_pairsEnd(McdSpace *s);                              /* a block ends: finds the pairs */
void mcd_pairsDestroy(McdSpace *s);

/* ---- queries ----------------------------------------------------------------------------------------------------- */

/* Calls visit for each model that may overlap a box (world); of those in the tree and those without bounds. */
void mcd_spaceOverlap(const McdSpace *s, const double min[3], const double max[3], McdTreeVisit visit, void *context);
/* The same for a moving box, see mcd_treeCast. */
void mcd_spaceCast(const McdSpace *s, const double from[3], const double by[3], const double half[3], double fraction,
                   McdTreeCastVisit visit, void *context);
/* Does a query meet a model: none that is to go, nor one that the filter keeps out, nor sensors, unless the space's
 * queries meet these. The function is the query. */
MeBool mcd_passesFilter(const McdSpace *s, McdModelID cm, McdLineSegIntersectEnableCallback filter, void *filterData,
                        const char *function);
/* McdSpaceGetLineSegFirstEnabledIntersection, by the name of the function. */
int mcd_firstIntersection(McdSpaceID s, MeReal *from, MeReal *to, McdLineSegIntersectEnableCallback filter,
                          void *filterData, McdLineSegIntersectResult *result, const char *function);
/* Outward to float. */
void mcd_treeBox(const double min[3], const double max[3], McdTreeBox *box);

#endif
