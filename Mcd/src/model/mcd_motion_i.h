/* Inside Mcd: continuous collision: moving shapes and times of impact. */
#ifndef MCD_MOTION_H
#define MCD_MOTION_H

#include "model/mcd_frame_i.h"

/* Shapes count as touching if they are nearer than this fraction of the smaller one's extent. */
#define MCD_TOUCH 1e-4

/* A convex shape that turns about a pivot, which moves uniformly, or accelerates where no contacts hold it. Its axes
 * and place are those at time 0. */
typedef struct McdMover {
    McdShape start;
    double pivot[3], velocity[3], spin[3]; /* relative to the query's origin, m; m/s; rad/s */
    double acceleration[3];                /* m/s² */
    double spinRate;                       /* rad/s², how fast the spin may change */
    double bend;                           /* m/s², how fast the pivot may leave its uniform motion */
    double arm;                            /* m, from the pivot to the shape's origin */
} McdMover;

/* At rest. */
void mcd_moverInit(McdMover *m, const McdShape *start, const double pivot[3]);

/* A moving shape and an obstacle: another one, or a half-space at rest. */
typedef struct McdApproach {
    McdMover shape, other;
    MeBool isHalfSpace; /* the half-space below normal . x = offset instead of `other` */
    double normal[3], offset;
    const double *front; /* of a triangle without a back: its outward normal; else null */
    double touch;        /* m, the gap that counts as touching */
    double margin;       /* m, the gap up to which there are contacts, and the depth that is left to them */
    double time;         /* s, that is looked at: accelerations count by the mean velocity in it */
    MeBool isFalling;    /* there are accelerations */
    double slow;         /* m/s: slower approaches are left to contacts */
    McdNearParts near;   /* what becomes of what is within the margin at time 0 */
} McdApproach;

/* s: when the shape is to stop for an impact that begins from `from` to `to`; max: there is none (mcd_motion.c). What
 * touched at `from` already has been judged before, unless from is 0. */
double mcd_impactTime(const McdApproach *p, double from, double to, double max);

/* Safe-time functions for the interactions' tables: two convex models; a convex model and a plane. */
int MEAPI mcd_safeTimeConvex(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result);
int MEAPI mcd_safeTimePlane(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result);

#endif
