/* The ground of driving tutorials: level around the middle, hills around it, and a rim that keeps everything inside. */
#ifndef TERRAIN_H
#define TERRAIN_H

#include "MeAppTerrain.h"

/* Creates the terrain: the radius of the level part and the height of hills (m). Call it before playStart, so that the
 * terrain is destroyed after the universe. Null if there is no memory. */
MeAppTerrain *terrainCreate(MeReal level, MeReal hills);

#endif
