/* Inside Mcd: continuous collision: moving shapes and times of impact. */
#ifndef MCD_MOTION_H
#define MCD_MOTION_H

#include "model/mcd_frame_i.h"

/* Shapes count as touching if they are nearer than this fraction of the smaller one's extent. */
#define MCD_TOUCH 1e-4

/* Moves a shape for a time, s, at constant velocity (of its origin) and angular velocity; its axes rotate exactly.
 * Not for triangles. */
void mcd_shapeMove(const McdShape *s, const double velocity[3], const double spin[3], double time, McdShape *moved);

/* Safe-time functions for the interactions' tables: two convex models; a convex model and a plane. */
int MEAPI mcd_safeTimeConvex(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result);
int MEAPI mcd_safeTimePlane(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result);

#endif
