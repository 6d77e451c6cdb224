/** @file MeAppTerrain.h
 *  Terrain for demonstration programs: a square grid of heights computed by a function, as a height field for
 *  collision, as triangles for a triangle list, and as a graphic. An addition to the 1.2 interface.
 *
 *      static MeReal MEAPI hill(MeReal x, MeReal y, void *userdata) { return 3 * MeSin(x / 10) * MeCos(y / 10); }
 *      ...
 *      MeAppTerrain *terrain = MeAppTerrainCreateZUp(97, (MeReal)1.5, hill, 0);   // 144 m by 144 m about the origin
 *      MeAppTerrainCreateModel(terrain, universe);
 *      MeAppTerrainShow(terrain, app->rc);
 *
 *  A null terrain gets a warning; the call then does nothing and returns 0.
 */
#ifndef MEAPPTERRAIN_H
#define MEAPPTERRAIN_H

#include "MeAppTypes.h"

ME_BEGIN_C

typedef struct MeAppTerrain MeAppTerrain;

/** Returns the height (m) at a point: x and z if y is up, x and y if z is up. */
typedef MeReal(MEAPI *MeAppHeightCB)(MeReal x, MeReal across, void *userdata);

/** @name Life
 *  @{ */
/**
 * Creates a terrain of @a points by @a points heights (2 to 4097 per side), @a cell metres (> 0) apart, y up: point (i,
 * j) is at x = (i - points / 2) cell, z = (points / 2 - j) cell. Null, with a warning, for a bad argument.
 */
MEPUBLIC MeAppTerrain *MEAPI MeAppTerrainCreate(int points, MeReal cell, MeAppHeightCB height, void *userdata);
/** The same with z up, as in MeAppStart: point (i, j) is at y = (j - points / 2) cell. */
MEPUBLIC MeAppTerrain *MEAPI MeAppTerrainCreateZUp(int points, MeReal cell, MeAppHeightCB height, void *userdata);
/** Destroys a terrain. Call it after the universe of its model is destroyed. Null does nothing. */
MEPUBLIC void MEAPI MeAppTerrainDestroy(MeAppTerrain *t);
/** @} */

/** @name Use
 *  @{ */
/** Creates a fixed model of the terrain as a height field. It refers to heights and transform of the terrain, which
 * must outlive it.
 */
MEPUBLIC McdModelID MEAPI MeAppTerrainCreateModel(MeAppTerrain *t, MstUniverseID u);
/** Adds a graphic of the terrain, with level ground (height 0) in another colour than hills. It is a copy. */
MEPUBLIC void MEAPI MeAppTerrainShow(MeAppTerrain *t, RRender *rc);
/**
 * Corner 0, 1 or 2 of triangle 0 or 1 of the cell between (i, j) and (i + 1, j + 1), in the world frame, for triangle
 * lists (McdTriangleList.h): counter-clockwise seen from above. Owned by the terrain. Null, with a warning, if there is
 * no such corner.
 */
MEPUBLIC MeVector3 *MEAPI MeAppTerrainGetCorner(MeAppTerrain *t, int i, int j, int triangle, int corner);
/** Heights per side, as at creation. */
MEPUBLIC int MEAPI MeAppTerrainGetPoints(const MeAppTerrain *t);
/** m: the distance of two heights, as at creation. */
MEPUBLIC MeReal MEAPI MeAppTerrainGetCell(const MeAppTerrain *t);
/** @} */

ME_END_C

#endif
