/* Eight courses of bricks without mortar, each half a brick on from the last one, which a heavy ball brings down. */
#ifndef WALL_H
#define WALL_H

#include "Mst.h"

enum { WALL_COURSES = 8, WALL_BRICKS = 7 /* of a course */ };

/* On a floor at y = 0, of a material that has friction and does not rebound. Returns how many bodies there are. */
static inline int wall_make(MstUniverseID u) {
    const MeReal size[3] = {.5, .3, .25};
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), .5, 0);
    for (int i = 0; i < WALL_COURSES; i++)
        for (int k = 0; k < WALL_BRICKS; k++) {
            const McdModelID brick = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, size[0], size[1], size[2]), 300);
            const MeReal x = size[0] * ((MeReal)k + (MeReal)(i % 2) / 2), y = size[1] * ((MeReal)i + (MeReal).5);
            McdModelDynamicsSetPosition(brick, x, y, 0);
        }
    const McdModelID ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .4), 500);
    McdModelDynamicsSetPosition(ball, size[0] * WALL_BRICKS / 2, 1.2, 5);
    McdModelDynamicsSetLinearVelocity(ball, 0, 0, -10);
    return WALL_COURSES * WALL_BRICKS + 1;
}

#endif
