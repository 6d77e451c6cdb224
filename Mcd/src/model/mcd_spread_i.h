/* Inside Mcd: which of many contacts to keep. */
#ifndef MCD_SPREAD_H
#define MCD_SPREAD_H

#include "McdCTypes.h"
#include <stddef.h>

/* The criteria of the choice. */
typedef struct McdSpot {
    double position[3], normal[3], separation;
    double distance2; /* mcd_spread's own: how much it differs from what is chosen */
} McdSpot;

/* Chooses at most `maxCount` of the spots and writes their indices in ascending order; returns how many.
 *
 * Spots of one normal: the ends of what they cover and its corners, so that the area they span is large; inner spots
 * only if they are deeper. Spots of several normals: one after the other the one that differs most, in place or
 * normal, from those chosen, beginning with the deepest. Spots nearer to a chosen one than `same` are left out. */
int mcd_spread(McdSpot *spot, int count, int maxCount, double same, int *kept);

/* McdContactSimplify in memory of mcd_simplifyBytes(count); faceNormal may be null. */
size_t mcd_simplifyBytes(int count);
int mcd_simplify(const McdContact *from, int count, McdContact *to, int maxCount, const MeReal *faceNormal, double same,
                 void *memory);

#endif
