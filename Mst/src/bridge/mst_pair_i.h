/* Inside Mst: touches (the bridge's records of pairs), and the events made from them. */
#ifndef MST_PAIR_I_H
#define MST_PAIR_I_H

#include "McdModelPairContainer.h"
#include "MdtConstraint.h"
#include "MeInternal.h"
#include "MstBridge.h"
#include "MstEvents.h"
#include <stdbool.h>
#include <stddef.h>

enum { MST_UNKNOWN = -1 };

/* Number of touches in the first block, and maximum number of blocks, each twice as large as the previous one: together
 * as many as an int counts. */
enum { MST_TOUCH_BLOCK = 64, MST_TOUCH_BLOCKS = 24 };

typedef struct MstBridgeRecord MstBridgeRecord;
typedef struct MstTouch MstTouch;

/* A model handle with the model's serial number, which reveals whether the model was destroyed. */
typedef struct MstModelRef {
    McdModelID model;
    MeU64 serial;
} MstModelRef;

/* The bridge's record of a pair, from its first contact until the space releases the pair. */
struct MstTouch {
    /* Read or written in every step: one cache line in single precision. First the state at the last test of the
     * pair, up to `carried`; the members after `listedIn` are of the step of that list. */
    _Alignas(ME_CACHE_LINE) unsigned long moves[2]; /* mst_moveCountOf; updated when contacts are carried */
    unsigned long version;                          /* version of its materials' record */
    int found;              /* contacts that the last test found; MST_UNKNOWN: some are missing */
    int carried;            /* number of times that they were carried since that test */
    unsigned long listedIn; /* number of the last list that it was in: mst_touchIsListed */
    bool wasTouching;       /* state before the step of that list; see mst_touchIsTouching */
    bool isTouching;        /* state after that step; while undecided, without forces */
    bool isSensor;          /* a model is a sensor */
    bool hasContacts;       /* the pair has contacts */
    bool isUndecided;       /* contact forces decide whether it touches: MstEvents.undecided */
    MeReal lag;             /* s, lag of its bodies when `impulse` was last summed; MEINFINITY: not yet in this step */
    MeReal separation;      /* m, the least separation of its contacts at the beginning of the step */
    MeReal tolerance;       /* m, sum of both models */
    MeReal impulse;         /* N s, sum over all contacts */
    /* Reset in every step; of persisting touches, computed only if the program wants events. */
    McdModelPair *pair; /* null: the touch is free */
    MstBridgeRecord *bridge;
    MstMaterialID material[2];
    MeReal approachSpeed;       /* m/s, the largest of its contacts */
    MeReal deepest;             /* m, the separation at `position`; used until impulses select the contact */
    MeReal largestImpulse;      /* N s, of one contact */
    MeVector3 position, normal; /* those of the contact with the largest impulse; sensors: the deepest one */
    /* Written when the touch is allocated. */
    MstModelRef model[2];
    MstTouch *nextFree;
};

#ifndef _ME_API_DOUBLE
_Static_assert(offsetof(MstTouch, pair) == ME_CACHE_LINE && offsetof(MstTouch, model) <= 2 * ME_CACHE_LINE,
               "two cache lines for what a step reads and writes");
_Static_assert(sizeof(MstTouch) == 3 * ME_CACHE_LINE, "and one for the models");
#endif

/* Events, each with the serial numbers of its models, which reveal whether a handle still means the same model. */
typedef struct MstEventList {
    MstEvent *event;
    MeU64 (*serial)[2];
    int count, max;
} MstEventList;

/* All touches of a bridge, and the lists of events made from them. */
typedef struct MstEvents {
    MstTouch *block[MST_TOUCH_BLOCKS]; /* all touches, free ones too */
    int blockCount;
    MstTouch *free;
    unsigned long list; /* the number of this step's list */
    MstTouch **listed;  /* touches of this step in the order of the space's pairs; null: removed since */
    int listedCount, listedMax;
    MstTouch **undecided; /* those of them for which contact forces decide whether they touch */
    int undecidedCount, undecidedMax;
    MeBool isPending;         /* the step is done, but its list of events has not been made yet */
    int callbacks;            /* material pairs with a touch callback; if any, the list is made at once */
    MstEventList done, ended; /* done: events of the last step; ended: ends of touches since then */
    MdtWorldID world;         /* the world that was stepped */
    int firstBreak;           /* index of the first break in `done` */
} MstEvents;

#endif
