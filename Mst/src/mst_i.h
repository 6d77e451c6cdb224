/* Inside Mst: the bridge's record, and what its files share. */
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

enum { MST_UNKNOWN = -1 };
/* So often contacts are carried along with their bodies before they are found anew. Each time rounds the normal to
 * MeReal: 64 times half of 2^-24, in any direction, are 2.4e-7 in all, as one rounding of a transform. */
enum { MST_CARRIES = 64 };
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
    /* as of the last test of the pair: */
    unsigned long moves[2]; /* of its bodies */
    unsigned long version;  /* of what holds between its materials */
    int found;              /* contacts; MST_UNKNOWN: not all that were found became contacts */
    int carried;            /* how often they have been carried along since; `moves` is as of then */
    MeBool isSensor;
    /* of this step: */
    MeBool isListed, hasContacts;
    MeReal lag; /* s, of its bodies when its impulse was last added to; MEINFINITY: the step is whole yet */
    MeReal separation, tolerance; /* the least of its contacts as the step began; of both models */
    /* the same, but of a touch that goes on not before somebody asks: */
    MeReal approachSpeed;           /* the largest */
    MeReal deepest;                 /* the separation there, while no force says which place matters most */
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
    MeBool isPending;         /* the step is done, and its list has not been made: nobody has asked */
    int callbacks;            /* material pairs that have one: the list is made at once */
    MstEventList done, ended; /* of the step just done, and ends since then */
    MdtWorldID world;         /* whose joints broke */
    int firstBreak;           /* from this event on */
} MstEvents;

/* What holds between two materials, and whether that is what it was: programs write it at any time. */
typedef struct MstMaterialRecord {
    MstMaterialPair pair, seen; /* first: what programs see; as of the last look, */
    unsigned long version;      /* since when it has been like that, */
    unsigned long lookedIn;     /* and the bridge's round in which that was */
} MstMaterialRecord;

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
    McdContact *contacts;          /* of the pair that is being handled */
    MdtFoundContact *found;        /* what Mdt is told of them, */
    MdtContactID *done;            /* and what they have become */
    unsigned int contactMax;
    MstEvents events;
    MdtBodyID *hurried; /* bodies that have a safe time in this part of the step */
    int hurriedCount, hurriedMax;
    MeReal ahead; /* s, the longest that a model may move in this part of the step */
    int part;     /* of the step: 0 is the first, in which all bodies move */
    MeReal reuse; /* MstBridgeSetContactReuse */
};

/* The record of a live bridge; null, with a warning, for anything else. */
MstBridgeRecord *mst_bridgeCheck(MstBridgeID b, const char *function);
/* What holds between two materials; unknown ones count as the default one. */
MstMaterialPair *mst_materialPair(MstBridgeRecord *b, MstMaterialID m1, MstMaterialID m2);

/* A number that is another one as soon as anything is that holds between two materials. */
unsigned long mst_materialVersion(MstBridgeRecord *b, MstMaterialPair *pair);
/* Pairs are looked at: programs may have changed anything before, and in a callback. */
void mst_beginRound(MstBridgeRecord *b);

/* Touches (MstEvents.c): a step begins; a pair has been looked at, with or without contacts; all is forgotten. */
void mst_eventsBegin(MstBridgeRecord *b);
void mst_touchNote(MstBridgeRecord *b, McdModelPair *p, const McdIntersectResult *result);
/* The pair is as it was when that was last noted. */
void mst_touchNoteAgain(MstBridgeRecord *b, McdModelPair *p);
void mst_touchNoteSensor(MstBridgeRecord *b, McdModelPair *p, const McdIntersectResult *result);
/* Ends the touch of a pair that goes. */
void MEAPI mst_touchForget(McdModelPair *p);
void mst_eventsTerm(MstBridgeRecord *b);

/* How fast the models come nearer at a point, along the way in which the first one is pushed. */
MeReal mst_approachAt(const McdModelPair *p, MeVector3 point, const MeVector3 normal);
/* A contact's normal as it pushes the first model, whichever body its group has first. */
void mst_normalOf(const McdModelPair *p, MdtContactID c, MeVector3 normal);

/* Adds what contacts did in the part of the step just done. */
void mst_eventsGather(MstBridgeRecord *b);

/* Continuous motion (mst_continuous.c). May the pair have contacts in this part of the step? */
MeBool mst_mayMeet(MstBridgeRecord *b, McdModelPair *p, McdSpaceID s);
/* If a model of the pair is fast: gives its bodies a safe time, where they meet now or later in the step. */
void mst_followFast(MstBridgeRecord *b, McdModelPair *p, McdSpaceID s, MdtWorldID w, MeBool hasContacts);
/* Is the body part of a large partition, in which a single pair matters little, and a solve costs much? */
MeBool mst_isInCrowd(MdtBodyID body);
/* A part of the step begins: no body has a safe time. */
void mst_hurryNobody(MstBridgeRecord *b);
/* The world's step after the contacts were made: in parts, where something fast meets something. */
void mst_stepWorld(MstUniverse *u, MeReal step);
/* The pair's bodies are one partition, whether they touch or not. */
void mst_pairTie(McdModelPair *p, MdtWorldID w);

/* Makes the contacts of a pair whose models may touch. */
void mst_pairCollide(MstBridgeRecord *b, McdModelPair *p, McdSpaceID s, MdtWorldID w);
/* Destroys the contacts of a pair. */
void MEAPI mst_pairForget(McdModelPair *p);

#endif
