/* Hilly ground for tutorials that drive: points over a square grid, y up. Level round the middle, hills around it, and
 * a rim that keeps everything in. */
#ifndef TERRAIN_H
#define TERRAIN_H

#include "Mcd.h"
#include "MeViewer.h"

enum { TERRAIN_POINTS = 97 }; /* along each side */

/* Point (i, j) is at x = (i - 48) cell, z = (48 - j) cell. The cell of (i, j) and (i+1, j+1) has two triangles on
 * either side of the line between these points. */
extern MeVector3 terrainPoint[TERRAIN_POINTS][TERRAIN_POINTS]; /* [j][i] */

/* Makes the points: a cell's side, how far the level part reaches from the middle, how high hills are (m). */
void terrainMake(MeReal cell, MeReal level, MeReal hills);
MeReal terrainCell(void);
/* Corner 0, 1 or 2 of triangle 0 or 1 of a cell; they run counter-clockwise as seen from above. */
MeVector3 *terrainCorner(int i, int j, int triangle, int corner);
/* How it looks: level ground and hills. */
void terrainGraphic(RRender *rc);
/* The height field of these points, and the transform that its model needs: the field's z is the world's y. */
McdGeometryID terrainHeightField(McdFrameworkID frame, MeMatrix4 tm);

#endif
