/* Inside Mcd: what geometries that have a box in their own frame do with it, and line segments in that frame. */
#ifndef MCD_BOUNDS_H
#define MCD_BOUNDS_H

#include "mcd_i.h"

/* The instance's box from one in its own frame; also around the same box at finalTM, if that is not null. */
void mcd_boxUpdateAABB(McdGeometryInstance *ins, const MeReal *min, const MeReal *max, const MeMatrix4Ptr finalTM);
void mcd_boxBSphere(const MeReal *min, const MeReal *max, MeVector3 center, MeReal *radius);
void mcd_boxMaximumPoint(McdGeometryInstance *ins, const MeReal *min, const MeReal *max, const MeReal *direction,
                         MeReal *point);
void mcd_boxDebugDraw(const MeReal *min, const MeReal *max, const MeMatrix4 tm, const MeReal colour[3]);

/* A world point in the frame at tm. */
void mcd_toLocal(MeMatrix4Ptr tm, const MeReal *world, double local[3]);
/* Fills the result for a hit at a part of the segment, with a normal in the frame at tm. Returns 1. */
int mcd_segmentHit(MeMatrix4Ptr tm, const MeReal *from, const MeReal *to, double part, const double normal[3],
                   McdLineSegIntersectResult *hit);

#endif
