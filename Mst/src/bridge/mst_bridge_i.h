/* Inside Mst: the bridge's record, its materials, runs of pairs, and detection of the program's changes. */
#ifndef MST_BRIDGE_I_H
#define MST_BRIDGE_I_H

#include "bridge/mst_pair_i.h"
#include "McdSpace.h"
#include "MdtInternal.h"
#include "MstModelDynamics.h"
#include "MstUtils.h"

enum { MST_BRIDGE = 0x4d425244, MST_UNIVERSE = 0x4d554e49, MST_CONTACTS = 40, MST_PAIRS = 1000, MST_MATERIALS = 10000 };

/* Whether the pointer is a live object of that kind; always true without checks of handles. */
#if KARMA_CHECK
#define MST_IS_KNOWN(p, kind) MeHandleIsLive((p), (kind))
#else
#define MST_IS_KNOWN(p, kind) METRUE
#endif
void mst_warnGone(const void *p, const char *what, const char *function);

/* The parameters of a pair of materials, and copies of them to detect changes, as programs write them at any time. */
typedef struct MstMaterialRecord {
    MstMaterialPair pair, seen; /* pair: the public part, first; seen: copy at the last comparison */
    MdtBclContactParams known;  /* copy of the parameters when mst_moved.c last compared them */
    unsigned long version;      /* version number of the present state */
    unsigned long comparedIn;   /* the last round of the bridge in which `pair` was compared with `seen` */
} MstMaterialRecord;

/* ---- what collide hands to commit (mst_step_i.h) ---- */

/* Pairs of a run: touches, pairs and manifolds take 900 bytes per pair; with their findings they fit into 32 kB. In a
 * heap of 1000 boxes, half as many and twice as many cost the same. */
enum { MST_RUN = 32 };
/* The minimum number of runs for which workers are woken. A run takes some 20 us in a heap of boxes; a sleeping thread
 * takes up to .35 ms to wake on a virtual machine. */
enum { MST_MIN_RUNS = 4 };
/* The maximum number of runs that workers may be ahead of the calling thread: two for each of eight cores. */
enum { MST_AHEAD = 16 };

/* The maximum number of steps in which contacts are moved with their bodies instead of found anew. Each step rounds the
 * normal to MeReal: 64 random roundings of half of 2^-24 add up to 2.4e-7, as much as one rounding of a transform. */
enum { MST_CARRIES = 64 };
/* Bytes of a group with up to four contacts (MdtManifold), for prefetching. */
enum { MST_GROUP = 8 * ME_CACHE_LINE };

typedef enum MstOutcome {
    MST_NOTHING,   /* nothing to do */
    MST_KEPT,      /* the contacts stay as they are */
    MST_CARRIED,   /* the contacts move with their bodies */
    MST_TESTED,    /* the contacts are replaced by those found */
    MST_TO_TEST,   /* commit tests the pair and replaces its contacts */
    MST_TO_REMOVE, /* a joint disables the collision: contacts and touch are removed */
    MST_TO_SENSE,  /* a model is a sensor: commit tests the pair, for events only */
    MST_TO_WAIT    /* one body lags and must not push the other, which has advanced already */
} MstOutcome;

/* The result of collide for one pair. */
typedef struct MstFinding {
    McdModelPair *pair;
    MstMaterialPair *materials; /* parameters of the models' materials */
    MstOutcome outcome;
    MeBool isFast;         /* one of the models is fast: its motion is continuous in this step */
    MeBool hasMoved[2];    /* MST_CARRIED: which bodies of the pair's group have moved */
    MeBool hasInteraction; /* MST_TESTED: the geometry types have an interaction, which has found the contacts */
    int first, count;      /* MST_TESTED: the contacts found, a range of MstRun.found */
    MeReal separation;     /* m, the least separation of these contacts */
    MeReal timeToImpact;   /* s, mst_timeToImpact; MST_UNKNOWN: not computed */
    MstTouch *updated;     /* the pair's touch if mst_updatePair has done all but append it to the lists; else null */
    MeBool isUndecided;    /* with `updated`: the touch is undecided */
} MstFinding;

/* Findings of consecutive pairs, with the buffers for their computation. */
typedef struct MstRun {
    int pairCount, foundCount;
    MstFinding finding[MST_RUN];
    MdtFoundContact *found;    /* contacts of all pairs of the run; capacity foundMax */
    McdContact *contacts;      /* contacts of the pair that was tested last; capacity contactMax */
    McdIntersectResult result; /* result for the pair that was tested last */
    MdtContactID *made;        /* dynamics contacts made from a pair's contacts; capacity contactMax */
    int contactMax, foundMax;
} MstRun;

/* What the program has given a model without a body that it moves (mst_moved.c). */
typedef struct MstMoved {
    MeMatrix4 seen;      /* its transform when it was last compared */
    MeReal *velocity[2]; /* pointers to its linear and angular velocity; null: none */
} MstMoved;

/* A body that lags, and the velocities that were taken from it (MdtBodyPause), m/s, rad/s. */
typedef struct MstPaused {
    MdtBodyID body;
    double velocity[2][3];
} MstPaused;

/* ---- the bridge ---- */

struct MstBridgeRecord {
    MstBridge bridge; /* the public part: first */
    MeU32 magic;
    MeHandle handle;
    McdFrameworkID frame;
    MeLimit materialLimit;
    unsigned int materialRoom, materialCount;
    MstMaterialRecord **materials; /* the pair (m1 >= m2) is materials[m1][m2] */
    unsigned long lastVersion;     /* the largest version of any material record */
    unsigned long round;           /* number of the present round: only callbacks change inputs within one */
    unsigned long allComparedIn;   /* the last round that computed the versions of all materials before its pairs */
    MeBool isPairsSizeSet;         /* the program has set the size of bridge.pairs, which then does not grow */
    MstRun run;
    MstRun *runsAhead; /* MST_AHEAD runs for workers; null until workers are first used */
    int runsSearched;  /* number of runs that the next search for plain pairs covers (mst_workers.c) */
    MstEvents events;
    MdtBodyID *clamped; /* bodies that have a safe time in this sub-step */
    int clampedCount, clampedMax;
    MstPaused *paused; /* bodies that lag after the last sub-step (mst_continuous.c) */
    int pausedCount, pausedMax;
    MeBool isStraight;   /* they go on without turning */
    MeBool isPushing;    /* they are at rest, and movers push them: no body gets a safe time */
    McdModelID placed;   /* the mover's model that was placed last for a pair; null: none yet */
    MeReal ahead;        /* s, the longest time by which a model may advance in this sub-step */
    MeBool hasNoCollide; /* some joint of the world disabled the collision of its bodies as this container began */
    int substep;         /* index of the sub-step; in the first, 0, all bodies move */
    MeReal reuse;        /* MstBridgeSetContactReuse */
    MstModelRef *thawed; /* models to freeze again after their pairs were tested (mst_moved.c) */
    int thawedCount, thawedMax;
    unsigned int nextMaterial[2]; /* next pair of materials that compareSomeMaterials compares (mst_moved.c) */
    MeStage stage;                /* guards the bridge while it runs callbacks */
    MeBool hasWarned[2]; /* warnings given: [0] of bodies of other worlds, [1] of invalid contacts from callbacks */
};

/* The levels of a bridge's stage (MeInternal.h). While pairs are handled, stages of the framework's models and of the
 * world's bodies are active, too: objects that callbacks destroy are removed when the stage ends. */
enum {
    MST_GUARD_BRIDGE, /* destroying the bridge is refused, and in a universe's step the universe */
    MST_GUARD_PAIRS   /* resizing the bridge's buffers is deferred, while pairs are handled */
};

/* A model's body: McdModelGetBody without its check of the handle, which costs a lock. */
static inline MdtBodyID mst_bodyOf(McdModelID m) {
    return m->mBody;
}

/* The model's body if forces move it; null: none, or the program moves it. */
static inline MdtBodyID mst_freeBodyOf(McdModelID m) {
    return m->mBody && !MdtBodyIsMover(m->mBody) ? m->mBody : 0;
}
/* Whether the second model's body is the first of the pair's group: fixed models and movers come second. */
static inline MeBool mst_isSwapped(const McdModelPair *p) {
    return !mst_freeBodyOf(p->model1) && mst_freeBodyOf(p->model2);
}

/* Makes room for one more element in an array of `count` elements, `array` being the address of the pointer to it, and
 * *max its capacity. False, after MeFatalError: no memory, and the array is unchanged. */
static inline MeBool mst_reserveOne(void *array, int count, int *max, size_t size, const char *what) {
    const int more = *max ? 2 * *max : 64;
    if (count < *max)
        return METRUE;
    if (!MeMemoryGrow(array, (size_t)count, (size_t)more, size, "MstBridgeUpdateContacts", what))
        return MEFALSE;
    *max = more;
    return METRUE;
}

/* ---- materials (mst_material.c) -------------------------------------------------------------------------------- */

/* The record of a live bridge; null, with a warning, for anything else. */
MstBridgeRecord *mst_bridgeCheck(MstBridgeID b, const char *function);
/* The parameters of two materials; an unknown material counts as the default one. */
MstMaterialPair *mst_materialPair(const MstBridgeRecord *b, MstMaterialID m1, MstMaterialID m2);
/* The parameters at a contact: children of aggregates and triangles of meshes may have materials of their own. */
MstMaterialPair *mst_materialsOf(const MstBridgeRecord *b, const McdContact *c);
/* Adds a material: its pairs with itself and all earlier ones. False, after a fatal error: no memory. */
MeBool mst_materialAdd(MstBridgeRecord *b, const char *function);
/* The version of a pair of materials: a number that changes with its parameters and callbacks. */
unsigned long mst_materialVersion(MstBridgeRecord *b, MstMaterialPair *pair);
/* Whether the versions of all pairs of materials were computed in this round; mst_currentVersion returns them then. */
static inline MeBool mst_areVersionsCurrent(const MstBridgeRecord *b) {
    return b->allComparedIn == b->round;
}
static inline unsigned long mst_currentVersion(const MstMaterialPair *pair) {
    return ((const MstMaterialRecord *)pair)->version;
}

/* ---- what programs change (mst_moved.c) -------------------------------------------------------------------------- */

/* At the beginning of a step: unfreezes frozen models that the program has changed, finds models without a body that it
 * moves, and wakes bodies whose contacts have changed parameters. The world may be null. */
void mst_applyProgramChanges(MstBridgeRecord *b, McdSpaceID s, MdtWorldID w);
/* Wakes the bodies of all touches between a pair of materials. */
void mst_wakeBodiesOfMaterials(const MstBridgeRecord *b, const MstMaterialPair *changed);
/* Freezes the models again that mst_applyProgramChanges unfroze, unless their bodies are awake now. */
void mst_refreezeModels(MstBridgeRecord *b);
/* Adds a vector to what is known of models that the program moves. */
void mst_shiftMoved(MdtWorldID w, const double by[3]);
/* Lets models that the program moves follow their transforms in the next step, of `step` s. */
void mst_followMoved(MdtWorldID w, MeReal step);

#endif
