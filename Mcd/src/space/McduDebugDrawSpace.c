/* Draws all models of a space. In a file of its own, so that programs which only draw models do not link spaces. */
#include "McduDebugDraw.h"
#include "McdSpace.h"
#include "pair/mcd_pair_i.h"

void MEAPI McduDebugDrawSpace(const McdSpaceID space, McduDebugDrawFlags flags, const MeReal colour[3]) {
    McdSpaceModelIterator it;
    McdModelID model;
    if (!mcd_areGiven(__func__, space, colour, colour))
        return;
    McdSpaceModelIteratorBegin(space, &it);
    while (McdSpaceGetModel(space, &it, &model))
        if (!(flags & kMcduDebugDrawEnabledOnly) || !McdSpaceModelIsFrozen(model))
            McduDebugDrawModel(model, flags, colour);
}
