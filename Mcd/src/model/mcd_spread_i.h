/* Inside Mcd: contact reduction: which of many contacts to keep. */
#ifndef MCD_SPREAD_H
#define MCD_SPREAD_H

#include "McdCTypes.h"
#include <stddef.h>

/* A contact's properties that the choice depends on. */
typedef struct McdSpot {
    double position[3], normal[3], separation;
    double distance2; /* used by mcd_spread: squared difference from the chosen spots */
} McdSpot;

/* Chooses at most `maxCount` spots and writes their indices in ascending order; returns their number.
 *
 * Spots with one normal: the extreme ones, so that they span a large area; inner spots only if they are deeper.
 * Spots with several normals: starting with the deepest, repeatedly the one that differs most from the chosen ones
 * in position or normal. Spots within `same` (m) of a chosen one are left out. */
int mcd_spread(McdSpot *spot, int count, int maxCount, double same, int *kept);

/* McdContactSimplify in given memory of mcd_simplifyBytes(count) bytes; faceNormal may be null. */
size_t mcd_simplifyBytes(int count);
int mcd_simplify(const McdContact *from, int count, McdContact *to, int maxCount, const MeReal *faceNormal, double same,
                 void *memory);

#endif
