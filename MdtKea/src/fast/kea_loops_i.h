/* Inside Kea: the fast solver's loops over groups and bodies, on the workers of the system's team (MeTeam.h).
 *
 * The rule for order. Groups of one colour share no body: they are visited in any order, colour after colour. Groups
 * and bodies that do not read each other are visited in any order at once. In both cases in chunks, whose number and
 * ends depend on the groups alone; what chunks sum up they leave in their places of KeaLoops.partial, and it is summed
 * in the chunks' order. So the answer has the same bits for every number of workers, one included.
 */
#ifndef KEA_LOOPS_I_H
#define KEA_LOOPS_I_H

#include "fast/kea_fast_i.h"
#include "MeTeam.h"

/* A function of so many groups, or bodies, from the first on; `partial`: what the chunk may add up by lane, zeros, or
 * null for bodies. */
typedef void (*KeaChunkWork)(void *context, int first, int count, float partial[KEA_LANES]);

typedef struct KeaLoops {
    MeTeam *team;
    int firstGroup[KEA_COLOURS + 1]; /* of each colour, and behind the last */
    int firstChunk[KEA_COLOURS + 1]; /* the same */
    float (*partial)[KEA_LANES];     /* by chunk */
} KeaLoops;

/* How many chunks the groups have, whose first of each colour are written: for the memory of `partial`. */
int kea_loopsPlan(KeaLoops *loops);
/* Colour after colour; the partial results are added to `sum`, which may be null. */
void kea_overColours(KeaLoops *loops, KeaChunkWork work, void *context, float sum[KEA_LANES]);
/* All groups at once; `most` becomes the largest of itself and the partial results. */
void kea_mostOverGroups(KeaLoops *loops, KeaChunkWork work, void *context, float most[KEA_LANES]);
/* All groups at once, and all of so many bodies. */
void kea_overGroups(KeaLoops *loops, KeaChunkWork work, void *context);
void kea_overBodies(KeaLoops *loops, int count, KeaChunkWork work, void *context);

#endif
