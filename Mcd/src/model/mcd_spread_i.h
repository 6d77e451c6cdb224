/* Inside Mcd: contact reduction: which of many contacts to keep. */
#ifndef MCD_SPREAD_H
#define MCD_SPREAD_H

#include "McdCTypes.h"
#include <stddef.h>

/* A contact's properties that the choice depends on. */
typedef struct McdSpot {
    double at[6]; /* position, normal; mcd_spread scales the normal */
    double separation;
    double support; /* used by mcd_spread: the separation that the chosen spots leave to this one */
} McdSpot;

/* Chooses at most `maxCount` spots that support the others (mcd_spread.c), and writes their indices in ascending order;
 * returns their number. Spots within `same` (m) of a chosen one are left out, unless they are deeper. */
int mcd_spread(McdSpot *spot, int count, int maxCount, double same, int *kept);
void mcd_sortAscending(int *kept, int count);

/* McdContactSimplify in given memory of mcd_simplifyBytes(count) bytes; faceNormal may be null. */
size_t mcd_simplifyBytes(int count);
int mcd_simplify(const McdContact *from, int count, McdContact *to, int maxCount, const MeReal *faceNormal, double same,
                 void *memory);

#endif
