/* Inside Mst: the bridge's records, and the stages from pairs of models to contacts of their bodies.
 *
 *     stage     file              reads -> writes
 *     pairs     MstBridge.c       the space's pairs -> the bridge's buffer of them; hello and goodbye pairs
 *     collide   mst_collide.c     models, poses, motion of bodies; the pair's manifold and touch -> a run's
 *                                 findings; of each pair, what Mcd keeps of its test
 *     update    mst_update.c      findings about contacts that go on -> the pair's manifold and touch
 *     commit    mst_commit.c      all other findings -> manifolds, touches, safe times of bodies; callbacks of the
 *                                 program; the step's list of touches
 *     touches   mst_touch.c       contacts of a pair -> its touch
 *     parts     mst_continuous.c  findings of fast models -> safe times; the world's step, in parts
 *     events    MstEvents.c       touches, forces of their contacts -> events; callbacks of the program
 *
 * Collide and commit take turns, run by run (MstHandleCollisions): a run is as many pairs as stay in the nearest cache
 * from one to the other. Collide and update call no function of the program, take nothing from a pool, and write to
 * nothing that two pairs share, but for the stamp that Mcd gives a model at its first look in a round, and for the mark
 * that a body's certificate of rest has ended, which any number of threads may set. A pair whose test or contacts
 * involve a function of the program is only looked at there: it ends the run, and commit tests it; with a list of
 * triangles, only until it is known that these are as they were.
 *
 * With workers (mst_workers.c), models get their stamps first; then runs of pairs that call no program are collided by
 * all workers, some runs ahead of the calling thread, which commits them in their order. In the first part of a step no
 * pair depends on what is committed of another one, so that contacts are the same.
 *
 *     data                                owner: who writes it
 *     McdModelPair.test, .stand           Mcd, as collide looks at the pair; commit, where it tests it, or got no touch
 *     McdModelPair.responseData, .forget  commit (mst_commit.c, mst_touch.c)
 *     MstRun                              collide; commit, of a pair that it has to test
 *     MstTouch                            update and commit (of the last test; mst_touch.c: of this step); events
 *     manifolds                           Mdt, at the call of update and commit
 *     versions of materials               commit
 *     MdtBody's safe time                 commit (mst_continuous.c)
 */
#ifndef MST_I_H
#define MST_I_H

#include "McdModelPairContainer.h"
#include "McdSpace.h"
#include "MdtConstraint.h"
#include "MdtInternal.h"
#include "MeInternal.h"
#include "MstBridge.h"
#include "MstEvents.h"
#include "MstModelDynamics.h"
#include "MstUtils.h"
#include <stdbool.h>
#include <stddef.h>

enum { MST_UNKNOWN = -1 };
/* Pairs of a run: their touches, pairs and manifolds, 900 bytes each, and what is found of them fit into 32 kB.
 * In a heap of 1000 boxes, half as many and twice as many cost the same. */
enum { MST_RUN = 32 };
/* The least number of runs for which workers are woken: some 20 us each in a heap of boxes, while a sleeping thread
 * takes up to .35 ms to wake on a virtual machine. */
enum { MST_LEAST_RUNS = 4 };
/* Runs that workers may be ahead of the calling thread: two for each of eight cores. */
enum { MST_AHEAD = 16 };
/* Touches of the first block, and so many blocks at most, each twice as large as the last: as many as an int counts. */
enum { MST_TOUCH_BLOCK = 64, MST_TOUCH_BLOCKS = 24 };
/* How many steps contacts are carried along with their bodies before they are found anew. Each step rounds the normal
 * to MeReal: 64 random roundings of half of 2^-24 add up to 2.4e-7, as one rounding of a transform. */
enum { MST_CARRIES = 64 };
/* Bytes of a group with up to four contacts (MdtManifold), to fetch ahead. */
enum { MST_GROUP = 8 * ME_CACHE_LINE };
enum { MST_BRIDGE = 0x4d425244, MST_UNIVERSE = 0x4d554e49, MST_CONTACTS = 40, MST_PAIRS = 1000, MST_MATERIALS = 10000 };

/* Whether the pointer is a live object of that kind; check builds only. */
#if KARMA_CHECK
#define MST_IS_KNOWN(p, kind) MeHandleIsLive((p), (kind))
#else
#define MST_IS_KNOWN(p, kind) METRUE
#endif
void mst_warnGone(const void *p, const char *what, const char *function);

typedef struct MstBridgeRecord MstBridgeRecord;
typedef struct MstTouch MstTouch;

/* A model handle with its serial, by which a destroyed model is noticed. */
typedef struct MstModelRef {
    McdModelID model;
    MeU64 serial;
} MstModelRef;

/* The bridge's record of a pair, from its first contact until the space releases the pair. */
struct MstTouch {
    /* Read or written in every step: one cache line in single precision.
     * As of the last test of the pair: */
    _Alignas(ME_CACHE_LINE) unsigned long moves[2]; /* of its bodies */
    unsigned long version;                          /* of its materials' record */
    int found;                                      /* contacts; MST_UNKNOWN: not all that were found became contacts */
    int carried;                                    /* how often they have been carried since; `moves` is as of then */
    unsigned long listedIn;                         /* the list that it was last in: mst_touchIsListed */
    bool wasTouching;                               /* before the step of that list; mst_touchIsTouching */
    bool isTouching;                                /* after it; unless it is undecided, without its forces */
    bool isSensor;                                  /* as of that step, like the rest of the line */
    bool hasContacts;                               /* got any */
    bool isUndecided;                               /* forces say whether it touches: it is in that list, too */
    bool isPushed;                                  /* its contacts move with a model without a body (mst_moved.c) */
    MeReal lag;        /* s, of its bodies when `impulse` was last added to; MEINFINITY: the step is whole yet */
    MeReal separation; /* m, the least of its contacts as the step began */
    MeReal tolerance;  /* m, of both models */
    MeReal impulse;    /* N s, of all contacts */
    /* Cleared in every step; of a touch that goes on, found out only for a list of events. */
    McdModelPair *pair; /* null: the touch is free */
    MstBridgeRecord *bridge;
    MstMaterialID material[2];
    MeReal approachSpeed;       /* m/s, the largest */
    MeReal deepest;             /* m, the separation at `position`, while no force says which contact matters most */
    MeReal largestImpulse;      /* N s, of one contact */
    MeVector3 position, normal; /* of that one; of sensors the deepest */
    /* Written when the touch is taken. */
    MstModelRef model[2];
    MstTouch *nextFree;
};

#ifndef _ME_API_DOUBLE
_Static_assert(offsetof(MstTouch, pair) == ME_CACHE_LINE && offsetof(MstTouch, model) <= 2 * ME_CACHE_LINE,
               "two cache lines for what a step reads and writes");
_Static_assert(sizeof(MstTouch) == 3 * ME_CACHE_LINE, "and one for the models");
#endif

/* Events, and for each the serials of its two models: whether a handle still means the same one. */
typedef struct MstEventList {
    MstEvent *event;
    MeU64 (*serial)[2];
    int count, max;
} MstEventList;

/* All touches of a bridge, and the lists of events made of them. */
typedef struct MstEvents {
    MstTouch *block[MST_TOUCH_BLOCKS]; /* all touches, free ones too */
    int blockCount;
    MstTouch *free;
    unsigned long list; /* the number of this step's list */
    MstTouch **listed;  /* the touches of this step, in the order of the space's pairs, */
    int listedCount, listedMax;
    MstTouch **undecided; /* and those of them of which forces say whether they touch */
    int undecidedCount, undecidedMax;
    MeBool isPending;         /* the step is done, and its list of events has not been made yet */
    int callbacks;            /* material pairs that have one: the list is made at once */
    MstEventList done, ended; /* of the step just done, and ends since then */
    MdtWorldID world;         /* whose joints broke */
    int firstBreak;           /* from this event on */
} MstEvents;

/* The parameters of two materials, and a copy to detect changes: programs write them at any time. */
typedef struct MstMaterialRecord {
    MstMaterialPair pair, seen; /* first: what programs see; as of the last look, */
    MdtBclContactParams known;  /* the parameters, as mst_moved.c last saw them */
    unsigned long version;      /* since when it has been like that, */
    unsigned long lookedIn;     /* and the bridge's round in which that was */
} MstMaterialRecord;

/* ---- what collide hands to commit -------------------------------------------------------------------------------- */

typedef enum MstOutcome {
    MST_NOTHING,  /* nothing to do */
    MST_KEPT,     /* the contacts stay as they are */
    MST_CARRIED,  /* they move with their bodies */
    MST_TESTED,   /* they become those that were found */
    MST_TO_TEST,  /* the same, but commit has to test the pair */
    MST_TO_PART,  /* a joint disables their collision: contacts and touch are removed */
    MST_TO_SENSE, /* a model is a sensor: test it, for events only */
    MST_TO_WAIT   /* one body lags, and must not push the other, which has advanced already */
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
    MeBool areApart;     /* some joint of the world lets its bodies pass through each other, as this container begins */
    int part;            /* of the step: 0 is the first, in which all bodies move */
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
    MST_HOLD_BRIDGE, /* the bridge, and in a universe's step the universe */
    MST_HOLD_PAIRS   /* its buffers: pairs are handled */
};
/* For the time in which pairs of the space, which may be null, are handled for the world, which may be none. */
void mst_holdPairs(MstBridgeRecord *b, McdFrameworkID frame, MdtWorldID w);
void mst_releasePairs(MstBridgeRecord *b, McdFrameworkID frame, MdtWorldID w);
/* MstBridgeUpdateContacts, by who holds the bridge. */
void mst_updateContacts(MstBridgeRecord *b, McdSpaceID s, MdtWorldID w);
/* MstBridgeUpdateEvents, the same. */
void mst_updateEvents(MstBridgeRecord *b, MdtWorldID w);

/* A model's body: McdModelGetBody without the question whether it is a model, which costs a lock. */
static inline MdtBodyID mst_bodyOf(McdModelID m) {
    return m->mBody;
}

/* ---- MstBridge.c ------------------------------------------------------------------------------------------------- */

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
/* Begins a round of pairs: inputs are compared anew, as programs may have changed them before, or in a callback. */
void mst_beginRound(MstBridgeRecord *b);

/* Room for the contacts of one pair, and of the rest of a run. False: there is no memory, and the run is as it was. */
MeBool mst_runInit(MstRun *run, int contactMax, const char *function);
void mst_runTerm(MstRun *run);

/* ---- workers (mst_workers.c) ------------------------------------------------------------------------------------- */

/* So many pairs are about to be handled: looks at the models that move. */
void mst_lookByWorkers(MstBridgeRecord *b, int count, McdSpaceID s, MdtWorldID w);
/* Collides and commits some pairs, from the first on, by the workers; returns how many: none, where a function of
 * the program has to do with the first, or there are no workers. */
int mst_handleByWorkers(MstBridgeRecord *b, McdModelPair *const pairs[], int count, McdSpaceID s, MdtWorldID w);
void mst_workersTerm(MstBridgeRecord *b);

/* ---- collide (mst_collide.c) ------------------------------------------------------------------------------------- */

/* Looks at pairs from the first on, and tests them, until the run is full, or ends for another reason; returns how
 * many. */
int mst_collideRun(const MstBridgeRecord *b, MstRun *run, McdModelPair *const pairs[], int count, McdSpaceID s);
/* Asks for the memory of pairs that follow pairs[i], up to the last of them, and of their models. */
void mst_prefetchModels(McdModelPair *const pairs[], int i, int count);
/* Tests a pair: the run's result. False: no interaction of its types is known. */
MeBool mst_intersectPair(MstRun *run, McdModelPair *p);
/* Is a model flush with a face of a fixed box that it will slide over, notwithstanding all contacts of them
 * (mst_flush.c)? */
MeBool mst_passesFlush(const McdModelPair *p, const McdContact contacts[], int count);
/* Tests a pair that may have a list of triangles, whose callback is called; its contacts become part of the run's.
 * False: all triangles, the models and the materials are as in the last test, and the pair has its contacts still. */
MeBool mst_testPairIfChanged(MstBridgeRecord *b, MstRun *run, MstFinding *f);
/* Of the run's result, as a function of the program has left it: what is no contact is left out, with a warning. */
void mst_checkContacts(MstBridgeRecord *b, MstRun *run);
/* Notes of each pair whether a joint of its bodies lets them pass through each other: before any is collided, as commit
 * changes the lists in which bodies have their joints. */
void mst_noteHeldApart(McdModelPair *const pairs[], int count);
/* Is the pair's outcome found without a function of the program, and without a sensor? */
MeBool mst_isPlainPair(const MstBridgeRecord *b, const McdModelPair *p);
/* The run's result, as a callback left it, becomes part of its contacts. */
void mst_convertContacts(const MstBridgeRecord *b, MstRun *run, MstFinding *f);
/* Whether the pair of materials has a callback of contacts. */
MeBool mst_hasCallback(const MstMaterialPair *materials);
unsigned long mst_movesOf(McdModelID m);

/* ---- update (mst_update.c) --------------------------------------------------------------------------------------- */

/* Updates the contacts and the touch of a pair that has just been collided, if it may be done beside other pairs;
 * writes f->updated, or that nothing is left to do. */
void mst_updatePair(const MstBridgeRecord *b, const MstRun *run, MstFinding *f);
/* Its contacts move with its bodies. */
void mst_carry(const MstFinding *f);
/* Notes the state of the models that the contacts were made from. Not for pairs that are tested in every step: fast
 * ones, those with callbacks, and those whose group holds fewer contacts than were found. */
void mst_rememberTest(const MstFinding *f, int held, unsigned long version);

/* ---- commit (mst_commit.c) --------------------------------------------------------------------------------------- */

void mst_commitRun(MstBridgeRecord *b, MstRun *run, McdSpaceID s, MdtWorldID w);
/* Joins the pair's bodies into one partition, whether they touch or not. */
void mst_pairTie(MstBridgeRecord *b, McdModelPair *p, MdtWorldID w);
/* Have both models the same body? They make no contacts. */
static inline MeBool mst_isOneBody(const McdModelPair *p) {
    return mst_bodyOf(p->model1) && mst_bodyOf(p->model1) == mst_bodyOf(p->model2);
}
/* Destroys the contacts of a pair; the same as the space releases it. */
void mst_groupDestroy(McdModelPair *p);
void MEAPI mst_pairForget(McdModelPair *p);

/* ---- touches (mst_touch.c) --------------------------------------------------------------------------------------- */

/* Was it looked at in this step? */
static inline MeBool mst_touchIsListed(const MstEvents *e, const MstTouch *t) {
    return t->listedIn == e->list;
}
/* Does it touch, as of the last step that is done? Nothing is written to all touches when a step begins. */
static inline MeBool mst_touchIsTouching(const MstEvents *e, const MstTouch *t) {
    return mst_touchIsListed(e, t) ? t->wasTouching : t->isTouching;
}
/* From what is known of a touch, whether it touches. */
MeBool mst_touchTouches(const MstTouch *t);
/* The touch, about which something was noted, is one of this step's. */
void mst_touchList(MstEvents *e, MstTouch *t, MeBool isUndecided);
/* As mst_touchNote and mst_touchNoteAgain, for a pair that has a touch that is not listed yet. */
void mst_touchUpdate(const MstBridgeRecord *b, const McdModelPair *p, int held, int found, MeReal separation);
void mst_touchUpdateAgain(const MstBridgeRecord *b, const McdModelPair *p);
/* A pair was tested, and its group holds so many contacts now; the least separation of those found. */
void mst_touchNote(MstBridgeRecord *b, McdModelPair *p, int held, int found, MeReal separation);
/* The pair is unchanged since its touch was last noted. */
void mst_touchNoteAgain(MstBridgeRecord *b, McdModelPair *p);
void mst_touchNoteSensor(MstBridgeRecord *b, McdModelPair *p, const McdIntersectResult *result);
/* Notes the contacts of a group. */
void mst_touchNoteGroup(MstTouch *t, MdtContactGroupID group);
/* The touch is no longer among those of this step; it is free. */
void mst_touchUnlist(MstTouch *t);
void mst_touchGive(MstTouch *t);
/* Check: do touches and pairs refer to each other, and does the list hold exactly those marked as listed? */
MeBool mst_touchesAreConsistent(const MstEvents *e);
/* Returns their memory. Pairs know of none any more. */
void mst_touchesTerm(MstEvents *e);
/* s, by which the pair's bodies are behind their world: those that are tied move together. */
MeReal mst_lagOfPair(const McdModelPair *p);
/* m/s: the approach speed of the models at a point, along the normal, which pushes the first one. */
MeReal mst_approachAt(const McdModelPair *p, MeVector3 point, const MeVector3 normal);
/* A contact's normal as it pushes the first model, whichever body its group has first. */
void mst_normalOf(const McdModelPair *p, MdtContactID c, MeVector3 normal);

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

/* ---- events (MstEvents.c) ---------------------------------------------------------------------------------------- */

/* A step begins: the workers mark the touches of the last one as such. */
void mst_eventsBegin(MstBridgeRecord *b, MeTeam *team);
/* Adds what contacts did in the part of the step just done. */
void mst_eventsGather(MstBridgeRecord *b);
/* Ends the touch of a pair that goes. */
void MEAPI mst_touchForget(McdModelPair *p);
void mst_eventsTerm(MstBridgeRecord *b);

/* ---- continuous motion (mst_continuous.c) ------------------------------------------------------------------------ */

/* Whether the pair may get contacts in a later part of the step. */
MeBool mst_mayMeet(const McdModelPair *p);
/* If not: whether its fast model has to wait for the other one. */
MeBool mst_mustWait(const McdModelPair *p);
/* s, for which the models of a pair without contacts do not touch, at most as long as they move in this part. */
MeReal mst_timeToTouch(const MstBridgeRecord *b, McdModelPair *p, McdSpaceID s);
/* Sets that time as the safe time of the body that has to wait. */
void mst_waitFor(MstBridgeRecord *b, const MstFinding *f);
/* For a pair with a fast model: sets the safe time of its bodies, if they meet now or later in the step. */
void mst_followFast(MstBridgeRecord *b, const MstFinding *f, MeBool hasContacts, McdSpaceID s, MdtWorldID w);
/* Is the body part of a large partition, in which a single pair matters little, and a solve costs much? */
MeBool mst_isInCrowd(MdtBodyID body);
/* A part of the step begins: no body has a safe time. */
void mst_clearSafeTimes(MstBridgeRecord *b);
/* The world's step after the contacts were made: in parts, where a fast model has an impact. */
void mst_stepWorld(MstUniverse *u, MeReal step);

#endif
