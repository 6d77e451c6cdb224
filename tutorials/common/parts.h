/* What tutorials put the looks of their vehicles together from. */
#ifndef PARTS_H
#define PARTS_H

#include "MeViewer.h"

/* A box of a size along x, y, z, its middle at a place of the frame that tm is the transform of. */
RGraphic *partBox(RRender *rc, float lx, float ly, float lz, MeReal x, MeReal y, MeReal z, const float color[4],
                  MeMatrix4Ptr tm);
/* A wheel about z: a tyre, and a rim with a bar across, so that one sees it turn. */
void partWheel(RRender *rc, float radius, float width, MeMatrix4Ptr tm);

#endif
