/* Inside Mcd: continuous collision: moving shapes and times of impact. */
#ifndef MCD_MOTION_H
#define MCD_MOTION_H

#include "model/mcd_frame_i.h"

/* Shapes count as touching where they are nearer than this part of the smaller one's extent. */
#define MCD_TOUCH 1e-4

/* The shape after a time at constant velocity (of its origin) and spin; its axes turn exactly. Not for triangles. */
void mcd_shapeMove(const McdShape *s, const double velocity[3], const double spin[3], double time, McdShape *moved);

/* For the interactions' tables: two convex models; a convex one and a plane. */
int MEAPI mcd_safeTimeConvex(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result);
int MEAPI mcd_safeTimePlane(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result);

#endif
