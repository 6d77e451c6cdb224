/* Inside Mst: the bridge's record of a pair, its touch, and the events that are made of touches. */
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

/* Touches of the first block, and so many blocks at most, each twice as large as the last: as many as an int counts. */
enum { MST_TOUCH_BLOCK = 64, MST_TOUCH_BLOCKS = 24 };

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

#endif
