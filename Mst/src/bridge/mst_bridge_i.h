/* Inside Mst: the bridge's record, its materials, runs of pairs, what programs change beside the simulation. */
#ifndef MST_BRIDGE_I_H
#define MST_BRIDGE_I_H

#include "bridge/mst_pair_i.h"
#include "McdSpace.h"
#include "MdtInternal.h"
#include "MstModelDynamics.h"
#include "MstUtils.h"

enum { MST_BRIDGE = 0x4d425244, MST_UNIVERSE = 0x4d554e49, MST_CONTACTS = 40, MST_PAIRS = 1000, MST_MATERIALS = 10000 };

/* Whether the pointer is a live object of that kind; check builds only. */
#if KARMA_CHECK
#define MST_IS_KNOWN(p, kind) MeHandleIsLive((p), (kind))
#else
#define MST_IS_KNOWN(p, kind) METRUE
#endif
void mst_warnGone(const void *p, const char *what, const char *function);

/* The parameters of two materials, and a copy to detect changes: programs write them at any time. */
typedef struct MstMaterialRecord {
    MstMaterialPair pair, seen; /* first: what programs see; as of the last look, */
    MdtBclContactParams known;  /* the parameters, as mst_moved.c last saw them */
    unsigned long version;      /* since when it has been like that, */
    unsigned long lookedIn;     /* and the bridge's round in which that was */
} MstMaterialRecord;

/* ---- what collide hands to commit (mst_step_i.h) ---- */

/* Pairs of a run: their touches, pairs and manifolds, 900 bytes each, and what is found of them fit into 32 kB.
 * In a heap of 1000 boxes, half as many and twice as many cost the same. */
enum { MST_RUN = 32 };
/* The least number of runs for which workers are woken: some 20 us each in a heap of boxes, while a sleeping thread
 * takes up to .35 ms to wake on a virtual machine. */
enum { MST_MIN_RUNS = 4 };
/* Runs that workers may be ahead of the calling thread: two for each of eight cores. */
enum { MST_AHEAD = 16 };

/* How many steps contacts are carried along with their bodies before they are found anew. Each step rounds the normal
 * to MeReal: 64 random roundings of half of 2^-24 add up to 2.4e-7, as one rounding of a transform. */
enum { MST_CARRIES = 64 };
/* Bytes of a group with up to four contacts (MdtManifold), to fetch ahead. */
enum { MST_GROUP = 8 * ME_CACHE_LINE };

typedef enum MstOutcome {
    MST_NOTHING,   /* nothing to do */
    MST_KEPT,      /* the contacts stay as they are */
    MST_CARRIED,   /* they move with their bodies */
    MST_TESTED,    /* they become those that were found */
    MST_TO_TEST,   /* the same, but commit has to test the pair */
    MST_TO_REMOVE, /* a joint disables their collision: contacts and touch are removed */
    MST_TO_SENSE,  /* a model is a sensor: test it, for events only */
    MST_TO_WAIT    /* one body lags, and must not push the other, which has advanced already */
} MstOutcome;

/* The result of collide for one pair. */
typedef struct MstFinding {
    McdModelPair *pair;
    MstMaterialPair *materials; /* of its models */
    MstOutcome outcome;
    MeBool isFast;      /* a model is, so that its motion is continuous in this step */
    MeBool hasMoved[2]; /* MST_CARRIED: the bodies of its group */
    MeBool isKnown;     /* MST_TESTED: there is an interaction, which has found the contacts */
    int first, count;   /* the same: contacts, in MstRun.found */
    MeReal separation;  /* m, the least of these */
    MeReal timeToTouch; /* s; MST_UNKNOWN: not computed */
    MstTouch *updated;  /* is all that is left to do to list it? (mst_update.c) */
    MeBool isUndecided; /* the same: the touch is */
} MstFinding;

/* Findings of consecutive pairs, and the memory in which they are made. */
typedef struct MstRun {
    int pairCount, foundCount;
    MstFinding finding[MST_RUN];
    MdtFoundContact *found;    /* of all pairs; foundMax */
    McdContact *contacts;      /* of the pair that was tested last; contactMax */
    McdIntersectResult result; /* the same */
    MdtContactID *made;        /* what the contacts of a pair have become; the same */
    int contactMax, foundMax;
} MstRun;

/* ---- the bridge ---- */

struct MstBridgeRecord {
    MstBridge bridge; /* what programs see: first */
    MeU32 magic;
    MeHandle handle;
    McdFrameworkID frame;
    MeLimit materialLimit;
    unsigned int materialRoom, materialCount;
    MstMaterialRecord **materials; /* of the pair (m1 >= m2): materials[m1][m2] */
    unsigned long lastVersion;     /* counts changes of what holds between materials */
    unsigned long round;           /* of pairs, in which nothing changes but by callbacks */
    unsigned long allSeenIn;       /* the last one in which all versions were computed before its pairs */
    MeBool isPairsSizeSet;         /* by the program: bridge.pairs does not grow */
    MstRun run;
    MstRun *runsAhead; /* MST_AHEAD of them; null: no worker has helped yet */
    int runsLooked;    /* mst_workers.c: how many runs are looked through at once for pairs that workers may collide */
    MstEvents events;
    MdtBodyID *clamped; /* bodies that have a safe time in this part of the step */
    int clampedCount, clampedMax;
    MeReal ahead;        /* s, the longest that a model may move in this part of the step */
    MeBool hasNoCollide; /* some joint of the world lets its bodies pass through each other, as this container begins */
    int substep;         /* of the step: 0 is the first, in which all bodies move */
    MeReal reuse;        /* MstBridgeSetContactReuse */
    MstModelRef *thawed; /* models that are frozen again in the next step (mst_moved.c) */
    int thawedCount, thawedMax;
    unsigned int nextMaterial[2]; /* of the materials that it looks at, in turn */
    MeStage stage;                /* at which level it is held */
    MeBool hasWarned[2];          /* of models with bodies of other worlds; of contacts that a callback has made */
};

/* The levels of a bridge's stage (MeInternal.h). The framework's models are held, and the world's bodies, while pairs
 * are handled: what of them is destroyed in callbacks goes when that is done. */
enum {
    MST_GUARD_BRIDGE, /* the bridge, and in a universe's step the universe */
    MST_GUARD_PAIRS   /* its buffers: pairs are handled */
};

/* A model's body: McdModelGetBody without the question whether it is a model, which costs a lock. */
static inline MdtBodyID mst_bodyOf(McdModelID m) {
    return m->mBody;
}

/* ---- materials (mst_material.c) -------------------------------------------------------------------------------- */

/* The record of a live bridge; null, with a warning, for anything else. */
MstBridgeRecord *mst_bridgeCheck(MstBridgeID b, const char *function);
/* The parameters of two materials; an unknown material counts as the default one. */
MstMaterialPair *mst_materialPair(const MstBridgeRecord *b, MstMaterialID m1, MstMaterialID m2);
/* The parameters at a contact: parts of models may have materials of their own. */
MstMaterialPair *mst_materialsOf(const MstBridgeRecord *b, const McdContact *c);
/* One more material: its pairs with itself and all before it. False, after a fatal error: there is no memory. */
MeBool mst_materialAdd(MstBridgeRecord *b, const char *function);
/* A number that changes with anything that holds between two materials. */
unsigned long mst_materialVersion(MstBridgeRecord *b, MstMaterialPair *pair);
/* Are those of all materials known in this round? Then it is: */
static inline MeBool mst_areMaterialsSeen(const MstBridgeRecord *b) {
    return b->allSeenIn == b->round;
}
static inline unsigned long mst_versionSeen(const MstMaterialPair *pair) {
    return ((const MstMaterialRecord *)pair)->version;
}

/* ---- what programs change (mst_moved.c) -------------------------------------------------------------------------- */

/* A step begins: unfreezes frozen models that have changed, and wakes what touches with parameters that have. */
void mst_wakeChanged(MstBridgeRecord *b, McdSpaceID s);
/* Wakes the bodies that touch with a pair of materials. */
void mst_wakeTouching(const MstBridgeRecord *b, const MstMaterialPair *changed);
/* Its pairs have been tested: freezes again what has not moved. */
void mst_freezeAgain(MstBridgeRecord *b);
/* Whether a model without a body has moved, or did in the last step, so that commit has to set the velocities of the
 * pair's contacts; sets them. */
MeBool mst_isPushed(const McdModelPair *p);
void mst_push(const MstBridgeRecord *b, const McdModelPair *p);

#endif
