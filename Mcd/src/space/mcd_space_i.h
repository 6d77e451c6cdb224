/* Inside Mcd: the records of spaces: proxies, links and pairs of the broad phase.
 *
 * A model in a space has a proxy: its exact box, as of the last update, and an enlarged (fat) box, which is in the
 * tree. A link joins two proxies whose fat boxes overlap, or that are disabled as a pair. Links are in a hash table,
 * and in a list of each of their proxies. A link whose exact boxes overlap has a pair, which programs see. A pair of
 * two frozen models is silent: it stays with its link but is in no list, so it costs no time. Links between frozen
 * models without a pair are dropped; they are found again when one of the models is unfrozen.
 *
 * At the end of a block only changes are processed: proxies that left their fat box are searched in the tree for new
 * links, and the links of all changed proxies are classified again.
 *
 * Proxies and links are referred to by index, since their arrays are reallocated when they grow; models' pointers to
 * proxies are updated then. Pairs never move.
 */
#ifndef MCD_SPACE_I_H
#define MCD_SPACE_I_H

#include "McdSpace.h"
#include "MeTeam.h"
#include "pair/mcd_pair_i.h"
#include "space/mcd_tree_i.h"
#include <stdbool.h>

enum { MCD_NONE = -1 };
/* Models that a worker updates at a time: .5 us each, against 1 us for starting and ending a loop. With half or
 * twice as many, a heap of 1000 boxes takes the same time to within 5 % (bench/threads). For fewer than
 * MCD_MIN_RANGES ranges no thread is woken. */
enum { MCD_RANGE = 64, MCD_MIN_RANGES = 4 };
/* Links that a worker examines at a time: some 10 us, against 1 us for starting and ending a loop. */
enum { MCD_LINK_RANGE = 1024 };
/* Pair records in the first block; each block is twice as large as the last. The maximum number of blocks is what an
 * int can count. */
enum { MCD_PAIR_BLOCK = 128, MCD_PAIR_BLOCKS = 23 };

/* In single precision two cache lines of 64 bytes. Updates of unmoved models and the classification of pairs read only
 * the first line. */
typedef struct McdProxy {
    _Alignas(ME_CACHE_LINE) MeReal min[3];
    MeReal max[3], tolerance; /* m: its share of the contact margin, mcd_modelMargin */
    bool hasBox : 1, isFrozen : 1;
    bool isDirty : 1;     /* its links must be classified */
    bool isAwake : 1;     /* in the list of nextAwake; a frozen one leaves it at the next update */
    bool isUnbounded : 1; /* in McdSpace.unbounded, not in the tree */
    bool isMoved : 1;     /* it has a new fat box: look for links */
    bool isWarned : 1;    /* its transform was warned about */
    McdFilter filter;     /* a copy of the model's */
    int nextAwake;        /* the next proxy that is updated */
    McdCullingTable *table;
    McdModelRecord *model; /* null: the proxy is free */

    McdTreeBox fat;
    int cullingIndex, cullingID;
    int firstLink, previousAwake;
    int previous, next; /* list in the order of insertion; next also links free proxies */
    McdTreeLeaf *leaf;  /* null: no box yet, or unbounded */
    MeU64 order;        /* order of pairs: the model's sort key, then its creation */
} McdProxy;

_Static_assert((offsetof(McdProxy, fat) == ME_CACHE_LINE && sizeof(McdProxy) == 2 * ME_CACHE_LINE) ||
                   sizeof(MeReal) > 4,
               "two lines");

typedef struct McdPairRecord McdPairRecord;
struct McdPairRecord {
    _Alignas(ME_CACHE_LINE) McdModelPair pair; /* the public part: first */
    McdPairRecord *nextFree;
    MeBool wasSilent; /* when it said goodbye: then it is in the list of goodbyes only */
};

_Static_assert(offsetof(McdModelPair, responseData) == ME_CACHE_LINE, "McdModelPairCompare reads one line");

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

/* Exists for each pair of near boxes; with the pair's record and list entry 256 bytes in single precision
 * (docs/lab/speed.md, "At rest"). */
typedef struct McdLink {
    int proxy[2]; /* proxy[0] is later in the order: it is model1; MCD_NONE: the link is free */
    int previous[2], next[2];
    int nextInHash;             /* also links free links */
    bool isDisabled, isWaiting; /* isWaiting: for room for its pair */
    bool isSilent;              /* its pair stays but is in no list, since both models are frozen */
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
    MeBool isInner;                 /* a callback began an inner block, to be applied when the stage ends */
    MeBool isOpenedLater;           /* that block has begun, for the inner block only, and ends with it */
    MeBool isUpdating;              /* callbacks of the program are running */
    MeBool isFirstBlock, isUpdated; /* it is in the block that its creation began; it has been updated in this block */
    MeU32 step;
    MeReal lookAhead; /* s */
    McdSpaceUpdateAABBFnPtr update;
    McdSpacePoolErrorFnPtr poolFull;
    MeBool queriesHitSensors, allowsQueries; /* allowsQueries: in change blocks, too */
    void *userData;
    void *collider; /* see McdSpaceSetCollider */

    McdProxy *proxy; /* proxyRoom elements; reallocated to grow */
    int proxyRoom;
    int proxyCount, firstProxy, lastProxy, freeProxy;
    MeU64 changesSeen;         /* McdFramework.changes when frozen models were last compared (mcd_frozen.c) */
    int lastCompared;          /* the frozen proxy compared last, in turn */
    int firstAwake, lastAwake; /* list of proxies that are updated; frozen models cost no time */
    int *awake, awakeCount;    /* the same as an array of proxyRoom for workers; awakeCount MCD_NONE: not up to date */
    MeU8 *updates;             /* parallel to awake: an McdBoxUpdate each */
    MeTeam *team;              /* workers; null: none */
    int *dirty, dirtyCount;    /* proxies that changed in this block; proxyRoom elements */
    int *found, *foundEnd;     /* parallel to dirty: results of workers (mcd_pairs.c) */
    int foundRoom, foundEndRoom;
    int *unbounded, unboundedCount; /* proxies that are not in the tree; proxyRoom elements */
    McdTree *tree;

    McdLink *link;
    int linkMax, freeLink, linkCount;
    MeU8 *changes; /* parallel to link: whether to classify it, as found by workers (mcd_pairs.c) */
    int changesRoom;
    int *hash, hashSize; /* a power of 2, or 0 */

    /* All lists of pairs have room for all records in the blocks, and `pending` for all links. So only the growth of
     * these can fail for lack of memory, and then nothing has been changed yet. */
    McdPairRecord *block[MCD_PAIR_BLOCKS];
    int blockCount, liveCount, waitingCount;
    McdPairRecord *freePair;
    MeBool isStale; /* the lists contain erased pairs: phase kMcdFFStateInactive */
    McdPairList hello, staying, goodbye, pending;
    McdPairList silenced, woken; /* in the current block: removed from, and returned to, the staying pairs */
    McdSpacePairIterator own;    /* for calls without an iterator */
};

/* ---- proxies (McdSpace.c) ---------------------------------------------------------------------------------------- */

MeBool mcd_spaceCheck(McdSpaceID s, const char *function);
/* Whether s is a space outside of change blocks; warns if not. Ends the first block, if McdSpaceUpdateAll was called
 * in it. */
MeBool mcd_spaceIsReady(McdSpaceID s, const char *function);

static inline int mcd_proxyIndex(const McdSpace *s, const McdProxy *p) {
    return (int)(p - s->proxy);
}

/* Has the space's workers process ranges of `size` of all `count` items (MeTeamRunRanges). */
static inline void mcd_spaceRunRanges(McdSpace *s, int count, int size, MeTeamRangeWork work, void *context) {
    MeTeamOpen(s->team);
    MeTeamRunRanges(s->team, count, size, work, context);
    MeTeamClose(s->team);
}

/* ---- links and pairs (mcd_pairs.c) ------------------------------------------------------------------------------- */

void mcd_proxyMarkDirty(McdProxy *p);      /* marks it dirty: its links are classified when the block ends */
void mcd_pairsForgetProxy(McdProxy *p);    /* drops its links; its pairs say goodbye */
void mcd_pairsEraseProxy(McdProxy *p);     /* drops its links and pairs, without goodbyes */
void mcd_pairsForgetContacts(McdProxy *p); /* forgets Mst's data of its pairs, which stay */
/* Whether the fat box contains the exact one, clamped to the tree's range. */
MeBool mcd_proxyIsWithinFatBox(const McdProxy *p);
void mcd_pairsRemoveErased(McdSpace *s);           /* removes erased pairs from the lists */
MeBool mcd_pairsDisable(McdProxy *a, McdProxy *b); /* false: no memory */
void mcd_pairsEnable(McdProxy *a, McdProxy *b);
MeBool mcd_pairsAreEnabled(const McdProxy *a, const McdProxy *b); /* neither disabled, culled nor filtered */
void mcd_pairsBegin(McdSpace *s);                                 /* as a block begins: goodbye pairs become invalid */
void mcd_pairsEnd(McdSpace *s);                                   /* as a block ends: finds the pairs */
void mcd_pairsDestroy(McdSpace *s);

/* ---- queries ----------------------------------------------------------------------------------------------------- */

/* Calls visit for each model whose box may overlap a box (world), in the tree or unbounded. */
void mcd_spaceOverlap(const McdSpace *s, const double min[3], const double max[3], McdTreeVisit visit, void *context);
/* Calls visit for each model that a moving box may hit, see mcd_treeCast. */
void mcd_spaceCast(const McdSpace *s, const double from[3], const double by[3], const double half[3], double fraction,
                   McdTreeCastVisit visit, void *context);
/* Whether a query may hit a model: not if it is being destroyed or removed, if the filter rejects it, or if it is a
 * sensor and the space's queries ignore sensors. function: the query's name. */
MeBool mcd_passesFilter(const McdSpace *s, McdModelID cm, McdLineSegIntersectEnableCallback filter, void *filterData,
                        const char *function);
/* McdSpaceGetLineSegFirstEnabledIntersection; warnings name `function`. */
int mcd_segmentFirstHit(McdSpaceID s, MeReal *from, MeReal *to, McdLineSegIntersectEnableCallback filter,
                        void *filterData, McdLineSegIntersectResult *result, const char *function);
void mcd_treeBox(const double min[3], const double max[3], McdTreeBox *box); /* rounds the box outward to float */

#endif
