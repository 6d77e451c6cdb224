/* The ground of tutorials that drive: level round the middle, hills around it, and a rim that keeps everything in. */
#ifndef TERRAIN_H
#define TERRAIN_H

#include "MeAppTerrain.h"

/* How far the level part reaches from the middle, how high hills are (m). To be called before playStart: the terrain
 * then ends after the universe. Null if there is no memory. */
MeAppTerrain *terrainCreate(MeReal level, MeReal hills);

#endif
