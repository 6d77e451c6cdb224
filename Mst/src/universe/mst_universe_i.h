/* Inside Mst: a hook around the steps of a universe, for advice (mst_advise_i.h). */
#ifndef MST_UNIVERSE_I_H
#define MST_UNIVERSE_I_H

#include "MstUniverse.h"

/* Makes one step. False, after a message: a member of the universe has been destroyed, and no step was made. */
typedef MeBool (*MstStepFn)(MstUniverseID u, MeReal step);

/* Wraps the steps of one universe; the first member of its owner's record. */
typedef struct MstStepHook {
    /* Called for each step: calls `stepOnce`, or does not return. May remove the hook before that. */
    void (*step)(struct MstStepHook *hook, MstUniverseID u, MeReal step, MstStepFn stepOnce);
    void (*destroy)(struct MstStepHook *hook); /* called when the universe is destroyed */
} MstStepHook;

/* The address of a universe's hook pointer; null, with a warning, if it is not a universe. */
MstStepHook **mst_universeHook(MstUniverseID u, const char *function);
/* Whether the universe is whole, and no stage of it is active. False: with a message. */
MeBool mst_universeIsFree(MstUniverseID u, const char *function);
/* The epsilon of a universe's world, 1/kg. */
double mst_epsilonForSizes(const MstUniverseSizes *sizes);

#endif
