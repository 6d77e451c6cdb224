/** @file MeAppTerrain.h
 *  Terrain for demonstration programs: a square grid of heights that a function gives, as a height field
 *  to collide with, as triangles for a triangle list, and as a picture. An addition to the 1.2 interface.
 *
 *      static MeReal MEAPI hill(MeReal x, MeReal y, void *userdata) { return 3 * MeSin(x / 10) * MeCos(y / 10); }
 *      ...
 *      MeAppTerrain *terrain = MeAppTerrainCreateZUp(97, (MeReal)1.5, hill, 0);   // 144 m by 144 m round the origin
 *      MeAppTerrainCreateModel(terrain, universe);
 *      MeAppTerrainShow(terrain, app->rc);
 *
 *  A null terrain gets a warning; then the call does nothing and returns 0.
 */
#ifndef MEAPPTERRAIN_H
#define MEAPPTERRAIN_H

#include "MeAppTypes.h"

ME_BEGIN_C

typedef struct MeAppTerrain MeAppTerrain;

/** The height (m) at a place: its x and z where y is up, its x and y where z is. */
typedef MeReal(MEAPI *MeAppHeightCB)(MeReal x, MeReal across, void *userdata);

/** @name Life
 *  @{ */
/**
 * Heights at @a points by @a points places (2 to 4097 a side), @a cell metres (> 0) apart, y up: point (i, j) is at
 * x = (i - points / 2) cell, z = (points / 2 - j) cell. Null, with a warning, for a bad argument.
 */
MEPUBLIC MeAppTerrain *MEAPI MeAppTerrainCreate(int points, MeReal cell, MeAppHeightCB height, void *userdata);
/** The same with z up, as MeAppStart draws it: point (i, j) is at y = (j - points / 2) cell. */
MEPUBLIC MeAppTerrain *MEAPI MeAppTerrainCreateZUp(int points, MeReal cell, MeAppHeightCB height, void *userdata);
/** To be called after the universe of its model is destroyed. Null does nothing. */
MEPUBLIC void MEAPI MeAppTerrainDestroy(MeAppTerrain *t);
/** @} */

/** @name Use
 *  @{ */
/** A fixed model of the terrain as a height field. It reads heights and transform from the terrain, which outlives it.
 */
MEPUBLIC McdModelID MEAPI MeAppTerrainCreateModel(MeAppTerrain *t, MstUniverseID u);
/** Adds its picture, level ground (height 0) in another colour than hills. It is a copy. */
MEPUBLIC void MEAPI MeAppTerrainShow(MeAppTerrain *t, RRender *rc);
/**
 * Corner 0, 1 or 2 of triangle 0 or 1 of the cell of (i, j) and (i + 1, j + 1), as it is in the world, for triangle
 * lists (McdTriangleList.h): counter-clockwise as seen from above. It belongs to the terrain. Null, with a warning, if
 * there is no such corner.
 */
MEPUBLIC MeVector3 *MEAPI MeAppTerrainGetCorner(MeAppTerrain *t, int i, int j, int triangle, int corner);
MEPUBLIC int MEAPI MeAppTerrainGetPoints(const MeAppTerrain *t);
MEPUBLIC MeReal MEAPI MeAppTerrainGetCell(const MeAppTerrain *t);
/** @} */

ME_END_C

#endif
