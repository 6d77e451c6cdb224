/* Inside Mst: what another room may do to a universe: stand round its steps. */
#ifndef MST_UNIVERSE_I_H
#define MST_UNIVERSE_I_H

#include "MstUniverse.h"

/* Takes one step. False, after a message: the universe has lost a part meanwhile, and there was none. */
typedef MeBool (*MstStepFn)(MstUniverseID u, MeReal step);

/* Stands round the steps of one universe: the head of its owner's record. */
typedef struct MstStepHook {
    /* A step of that universe: calls `stepOnce`, or does not return. May remove the hook before it. */
    void (*step)(struct MstStepHook *hook, MstUniverseID u, MeReal step, MstStepFn stepOnce);
    void (*destroy)(struct MstStepHook *hook); /* with the universe */
} MstStepHook;

/* Where a universe keeps its hook, or null; null, with a warning, for anything else than a universe. */
MstStepHook **mst_universeHook(MstUniverseID u, const char *function);
/* What a universe's world has as its epsilon, 1/kg. */
double mst_epsilonOf(const MstUniverseSizes *sizes);

#endif
