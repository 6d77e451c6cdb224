/* Parts of which tutorials make graphics of vehicles. */
#ifndef PARTS_H
#define PARTS_H

#include "MeViewer.h"

/* A box of a size along x, y, z, with its centre at a point of the frame of the transform tm. */
RGraphic *partBox(RRender *rc, float lx, float ly, float lz, MeReal x, MeReal y, MeReal z, const float color[4],
                  MeMatrix4Ptr tm);
/* A wheel about z: a tyre, and a rim with a bar across, which makes its rotation visible. */
void partWheel(RRender *rc, float radius, float width, MeMatrix4Ptr tm);

#endif
