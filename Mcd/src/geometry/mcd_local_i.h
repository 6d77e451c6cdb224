/* Inside Mcd: helpers of the geometry types. Each type has, in its own frame and in double, a support function and a
 * function that clips a line. Boxes, support points and line segment tests in the world are derived from these. */
#ifndef MCD_LOCAL_H
#define MCD_LOCAL_H

#include "model/mcd_geometries_i.h"
#include "pair/mcd_pair_i.h"
#include <float.h>
#include <math.h>
#include <string.h>

#define MCD_PI 3.14159265358979323846

/* ---- sizes ----------------------------------------------------------------------------------------------------- */

/* Whether a size is > 0 and not too small or large for single precision; if not, warns with the function's name. */
MeBool mcd_sizeIsGood(MeReal size, const char *what, const char *function);
/* Whether the instance is of a live geometry of that type and has a valid transform; warns if not. */
MeBool mcd_instanceIs(McdGeometryInstanceID ins, McdGeometryType type, const char *function);

#ifndef _ME_API_DOUBLE
/* nextafterf(r, FLT_MAX) if isNext, else r; branchless, since that is unpredictable. The bits of positive floats are
 * in their order, those of negative floats in the opposite order; -0 counts as 0. */
static inline float mcd_nextAboveIf(float r, int isNext) {
    MeI32 bits;
    r += 0.0f;
    memcpy(&bits, &r, sizeof bits);
    bits += (1 - 2 * (r < 0)) & -(isNext & (r < FLT_MAX)); /* not for NaN */
    memcpy(&r, &bits, sizeof r);
    return r;
}
#endif

/* The smallest MeReal that is not below x, and the largest that is not above x. */
static inline MeReal mcd_roundUp(double x) {
    MeReal r = (MeReal)x;
#ifndef _ME_API_DOUBLE
    r = mcd_nextAboveIf(r, !((double)r >= x));
#endif
    MEASSERT(!((double)r < x) || x > (double)MEINFINITY);
    return r;
}
static inline MeReal mcd_roundDown(double x) {
    return -mcd_roundUp(-x);
}

/* ---- boxes, support points ------------------------------------------------------------------- */

/* The geometry's support point in a direction of any length; any point for a zero direction. */
typedef void (*McdLocalSupportFn)(const McdGeometry *g, const double direction[3], double point[3]);

/* The extent along world axis i of the geometry at tm: of sum tm[j][i] x_j, so the direction in its own frame is
 * tm[.][i]. Enlarged by a bound of the rounding errors. */
static inline void mcd_localExtent(const McdGeometry *g, const MeVector4 *tm, int i, McdLocalSupportFn support,
                                   double *low, double *high) {
    const double d[3] = {(double)tm[0][i], (double)tm[1][i], (double)tm[2][i]}, back[3] = {-d[0], -d[1], -d[2]};
    const double place = (double)tm[3][i];
    double highest[3], lowest[3], slack = fabs(place);
    support(g, d, highest);
    support(g, back, lowest);
    for (int k = 0; k < 3; k++)
        slack += fabs(d[k] * highest[k]) + fabs(d[k] * lowest[k]);
    slack *= 4 * DBL_EPSILON;
    *low = place + d[0] * lowest[0] + d[1] * lowest[1] + d[2] * lowest[2] - slack;
    *high = place + d[0] * highest[0] + d[1] * highest[1] + d[2] * highest[2] + slack;
}

/* Sets the instance's box. Inline, as the extents, so that each type's support function is compiled into the loops:
 * boxes are updated in every step. */
static inline void mcd_localUpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM,
                                       McdLocalSupportFn support) {
    MeVector3 min, max;
    for (int i = 0; i < 3; i++) {
        double low, high, finalLow, finalHigh;
        mcd_localExtent(ins->geometry, mcd_const(mcd_instanceTM(ins)), i, support, &low, &high);
        if (finalTM) {
            mcd_localExtent(ins->geometry, mcd_const(finalTM), i, support, &finalLow, &finalHigh);
            low = MeMIN(low, finalLow);
            high = MeMAX(high, finalHigh);
        }
        min[i] = mcd_roundDown(low);
        max[i] = mcd_roundUp(high);
        MEASSERT(!(min[i] > max[i]));
    }
    McdGeometryInstanceSetAABB(ins, min, max);
}

void mcd_localMaximumPoint(McdGeometryInstanceID ins, const MeReal *direction, MeReal *point,
                           McdLocalSupportFn support);
/* Implements Mcd...GetXYAABB of a type: sets the bounds; 0, with a warning, for bad arguments. */
void mcd_localXYAABB(McdGeometryID g, McdGeometryType type, const MeMatrix4Ptr tm, MeReal bounds[4],
                     McdLocalSupportFn support, const char *function);

/* For geometries that are bounded by a box in their own frame only. */
void mcd_boxSupport(const MeReal *min, const MeReal *max, const double direction[3], double point[3]);
MeReal mcd_boxBSphere(const MeReal *min, const MeReal *max, MeVector3 center); /* sets the centre, returns the radius */

/* ---- line segments ----------------------------------------------------------------------------------------------- */

/* A line from + t along, and its interval in <= t <= out inside all solids that it was clipped by. The normal is
 * that of the surface at t = in. An empty interval has in > out. */
typedef struct McdClip {
    double from[3], along[3];
    double in, out;
    double normal[3];
} McdClip;

MeBool mcd_clipIsEmpty(const McdClip *c);
void mcd_clipInterval(McdClip *c, double in, double out, const double normal[3]); /* normal: of the surface at `in` */
void mcd_clipHalfSpace(McdClip *c, const double normal[3], double offset); /* normal . x <= offset; unit normal */
void mcd_clipBall(McdClip *c, const double centre[3], double radius);
void mcd_clipCylinder(McdClip *c, const double point[3], const double axis[3], double radius); /* infinite; unit axis */
/* Clips by all points within radius of the segment from a to b, whose length is not 0. */
void mcd_clipCapsule(McdClip *c, const double a[3], const double b[3], double radius);
/* Extends the interval to that of another solid; the union of both solids must be convex. */
void mcd_clipUnion(McdClip *c, const McdClip *other);
void mcd_clipAt(const McdClip *c, double t, double point[3]);

/* Transforms a world point to the frame at tm; false if the result is not finite. */
MeBool mcd_toLocal(const MeVector4 *tm, const MeReal *world, double local[3]);
/* Fills the result, except the model, for a hit at a fraction of the segment, with a normal in the frame at tm.
 * Returns 1. */
int mcd_writeSegmentHit(const MeVector4 *tm, const MeReal *from, const MeReal *to, double fraction,
                        const double normal[3], McdLineSegIntersectResult *hit);

/* Clips a line, initially unclipped, by the geometry. */
typedef void (*McdLocalClipFn)(const McdGeometry *g, McdClip *c);

/* Implements an McdLineSegIntersectFnPtr by a type's clip function. */
int mcd_localLineSegment(McdModelID cm, const MeReal *from, const MeReal *to, McdLineSegIntersectResult *result,
                         McdLocalClipFn clip);

/* ---- mass -------------------------------------------------------------------------------------------------------- */

typedef struct McdMass {
    double volume, centre[3], inertia[3][3]; /* about the centre */
} McdMass;

/* Writes the results of an McdGeometryGetMassPropertiesFnPtr. Returns 1; without volume, or if it or the inertia exceed
 * MeReal: 0, and zero results. */
MeI16 mcd_massStore(const McdMass *m, MeMatrix4 relTM, MeMatrix3 inertia, MeReal *volume);
/* Sets volume and principal moments x, y, z of a shape whose centre of mass is the origin. */
void mcd_massDiagonal(McdMass *m, double volume, double x, double y, double z);
/* For checks: whether the inertia can be that of a mass: symmetric, and each moment at most the sum of the others. */
MeBool mcd_isInertiaGood(const McdMass *m);
/* Of geometries without mass. */
static inline void mcd_addNoMass(const McdGeometry *g, McdMass *sum) {
    (void)g;
    (void)sum;
}

/* ---- drawing ----------------------------------------------------------------------------------------------------- */

enum { MCD_DRAW_SIDES = 16 }; /* segments of a circle */

void mcd_drawLine(const MeVector4 *tm, const MeReal colour[3], const double a[3], const double b[3]);
void mcd_drawBox(const MeVector4 *tm, const MeReal colour[3], const MeReal *min, const MeReal *max);
/* Draws an arc of an ellipse from angle 0: centre + u cos + v sin, in `pieces` of the MCD_DRAW_SIDES segments of a
 * full turn. */
void mcd_drawArc(const MeVector4 *tm, const MeReal colour[3], const double centre[3], const double u[3],
                 const double v[3], int pieces);
/* Draws a circle about the z axis. */
void mcd_drawCircle(const MeVector4 *tm, const MeReal colour[3], double z, double radius);
/* Draws four lines between two circles about the z axis. */
void mcd_drawSides(const MeVector4 *tm, const MeReal colour[3], double z1, double radius1, double z2, double radius2);

#endif
