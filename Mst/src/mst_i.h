/* Inside Mst: the bridge's record, and what its files share. */
#ifndef MST_I_H
#define MST_I_H

#include "McdModelPairContainer.h"
#include "McdSpace.h"
#include "MdtConstraint.h"
#include "MstBridge.h"
#include "MstEvents.h"
#include "MstModelDynamics.h"
#include "MstUtils.h"

enum { MST_BRIDGE = 0x4d425244, MST_UNIVERSE = 0x4d554e49, MST_CONTACTS = 40, MST_PAIRS = 1000 };

typedef struct MstBridgeRecord MstBridgeRecord;
typedef struct MstTouch MstTouch;

/* A model that may have been destroyed since. */
typedef struct MstModelRef {
    McdModelID model;
    MeU64 serial;
} MstModelRef;

/* What events know of a pair: from its first contact until the space takes the pair back. */
struct MstTouch {
    MstBridgeRecord *bridge;
    McdModelPair *pair;
    MstTouch *previous, *next; /* of the bridge's; next also links the free ones */
    MstModelRef model[2];
    MstMaterialID material[2];
    MeBool isTouching; /* as of the last step */
    MeBool isSensor;
    /* of this step: */
    MeBool isListed, hasContacts;
    MeReal separation, tolerance;   /* the least of its contacts as the step began; of both models */
    MeReal approachSpeed;           /* the largest */
    MeReal impulse, largestImpulse; /* of all contacts, of one */
    MeVector3 position, normal;     /* of that one; of sensors the deepest */
};

/* Events, and for each the serials of its two models: whether a handle still means the same one. */
typedef struct MstEventList {
    MstEvent *event;
    MeU64 (*serial)[2];
    int count, max;
} MstEventList;

/* What a bridge knows of touches. */
typedef struct MstEvents {
    MstTouch *first, *free; /* of all pairs that have or had contacts */
    MstTouch **listed;      /* those of this step, in the order of the space's pairs */
    int listedCount, listedMax;
    MstEventList done, ended; /* of the step just done, and ends since then */
    MdtWorldID world;         /* whose joints broke */
    int firstBreak;           /* from this event on */
} MstEvents;

struct MstBridgeRecord {
    MstBridge bridge; /* what programs see: first */
    MeU32 magic;
    McdFrameworkID frame;
    unsigned int materialMax, materialCount;
    MstMaterialPair *materials; /* of the pair (m1 >= m2): materials[m1 (m1 + 1) / 2 + m2] */
    McdContact *contacts;       /* of the pair that is being handled */
    MdtContactID *done;         /* what they have become */
    unsigned int contactMax;
    MstEvents events;
};

/* The record of a live bridge; null, with a warning, for anything else. */
MstBridgeRecord *mst_bridgeCheck(MstBridgeID b, const char *function);
/* What holds between two materials; unknown ones count as the default one. */
MstMaterialPair *mst_materialPair(MstBridgeRecord *b, MstMaterialID m1, MstMaterialID m2);

/* Touches (MstEvents.c): a step begins; a pair has been looked at, with or without contacts; all is forgotten. */
void mst_eventsBegin(MstBridgeRecord *b);
void mst_touchNote(MstBridgeRecord *b, McdModelPair *p);
void mst_touchNoteSensor(MstBridgeRecord *b, McdModelPair *p, const McdIntersectResult *result);
/* Ends the touch of a pair that goes. */
void MEAPI mst_touchForget(McdModelPair *p);
void mst_eventsTerm(MstBridgeRecord *b);

/* Makes the contacts of a pair whose models may touch. */
void mst_pairCollide(MstBridgeRecord *b, McdModelPair *p, MdtWorldID w);
/* Destroys the contacts of a pair. */
void mst_pairForget(McdModelPair *p);

#endif
