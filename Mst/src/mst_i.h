/* Inside Mst: the bridge's record, and what its files share. */
#ifndef MST_I_H
#define MST_I_H

#include "McdModelPairContainer.h"
#include "McdSpace.h"
#include "MstBridge.h"
#include "MstModelDynamics.h"
#include "MstUtils.h"

enum { MST_BRIDGE = 0x4d425244, MST_UNIVERSE = 0x4d554e49, MST_CONTACTS = 40, MST_PAIRS = 1000 };

typedef struct MstBridgeRecord {
    MstBridge bridge; /* what programs see: first */
    MeU32 magic;
    McdFrameworkID frame;
    unsigned int materialMax, materialCount;
    MstMaterialPair *materials; /* of the pair (m1 >= m2): materials[m1 (m1 + 1) / 2 + m2] */
    McdContact *contacts;       /* of the pair that is being handled */
    MdtContactID *done;         /* what they have become */
    unsigned int contactMax;
} MstBridgeRecord;

/* The record of a live bridge; null, with a warning, for anything else. */
MstBridgeRecord *mst_bridgeCheck(MstBridgeID b, const char *function);
/* What holds between two materials; unknown ones count as the default one. */
MstMaterialPair *mst_materialPair(MstBridgeRecord *b, MstMaterialID m1, MstMaterialID m2);

/* Makes the contacts of a pair whose models may touch. */
void mst_pairCollide(MstBridgeRecord *b, McdModelPair *p, MdtWorldID w);
/* Destroys the contacts of a pair. */
void mst_pairForget(McdModelPair *p);

#endif
