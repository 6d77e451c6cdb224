/* Convex shapes at a place: their axes and support points. */
#include "convex/mcd_sampled_i.h"
#include "convex/mcd_vector_i.h"

#include <string.h>

/* ---- axes and places --------------------------------------------------------------------------------------- */

static MeBool areAxesRigid(const double axis[3][3]) {
    double x[3];
    mcd_cross(x, axis[0], axis[1]);
    return mcd_isUnit(axis[0]) && mcd_isUnit(axis[1]) && mcd_isUnit(axis[2]) && fabs(mcd_dot(x, axis[2]) - 1) < 1e-9;
}

MeBool mcd_shapeIsRigid(const McdShape *s) {
    return areAxesRigid(s->axis);
}

MeBool mcd_shapeIsKnown(const McdShape *s) {
    return !s->kind->isSampled && mcd_shapeIsRigid(s);
}

MeBool mcd_areResolved(const McdShape *a, const McdShape *b) {
    const double surface = MeMAX(a->extent, b->extent), place = MeMAX(mcd_length(a->place), mcd_length(b->place));
    return mcd_shapeIsKnown(a) && mcd_shapeIsKnown(b) && MeMAX(surface, place) <= 1e4 * mcd_pairSize(a, b);
}

/* Orthonormalizes in double precision a rotation that was rounded to single precision, so that a box's faces are
 * exactly orthogonal to its axes: R + (I - R R^T) R / 2, one step towards the nearest rotation. Other matrices are
 * left as they are. */
static void orthonormalizeAxes(double axis[3][3]) {
    static const double rounded = 1e-5, square = 1e-13;
    double error[3][3], old[3][3], max = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) {
            error[i][j] = error[j][i] = (i == j) - mcd_dot(axis[i], axis[j]);
            max = MeMAX(max, fabs(error[i][j]));
        }
    if (max < square || max > rounded)
        return;
    memcpy(old, axis, sizeof old);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            mcd_mad(axis[i], axis[i], error[i][j] / 2, old[j]);
    MEASSERT(fabs(mcd_dot(axis[0], axis[1])) < 1e-9 && mcd_isUnit(axis[2])); /* a step squares the error */
}

void mcd_shapeAxes(const MeMatrix4 tm, double axis[3][3]) {
    for (int i = 0; i < 3; i++)
        mcd_fromReal(axis[i], tm[i]);
    orthonormalizeAxes(axis);
}

MeBool mcd_isValidTransform(const MeVector4 *tm) {
    double axis[3][3], across[3], longest = 0; /* squared */
    if (!tm || !mcd_areInRange(tm[3], 3))
        return MEFALSE;
    for (int i = 0; i < 3; i++) {
        mcd_fromReal(axis[i], tm[i]);
        longest = fmax(longest, mcd_dot(axis[i], axis[i]));
    }
    mcd_cross(across, axis[0], axis[1]);
    return longest >= 1e-12 && longest <= 3e12 && fabs(mcd_dot(across, axis[2])) >= 1e-6 * longest * sqrt(longest);
}

/* ---- support points ---------------------------------------------------------------------------------------- */

void mcd_coreSupport(const McdShape *s, const double d[3], double point[3]) {
    s->kind->support(s, d, point);
}

/* For checks: whether the point is within the shape's extent of its place. */
static MeBool isWithinExtent(const McdShape *s, const double point[3]) {
    const double max = s->extent * (1 + 1e-6) + 4 * DBL_EPSILON * mcd_length(s->place);
    return !mcd_shapeIsKnown(s) || mcd_distanceSquared(point, s->place) <= max * max;
}

void mcd_support(const McdShape *s, const double direction[3], double point[3]) {
    mcd_coreSupport(s, direction, point);
    mcd_mad(point, point, s->rounding, direction);
    MEVALIDATE(!mcd_isUnit(direction) || isWithinExtent(s, point));
}

/* ---- round surfaces ---------------------------------------------------------------------------------------- */

double mcd_surfaceRadius(const McdShape *s, const double outward[3], const double point[3]) {
    return s->kind->radius ? s->kind->radius(s, outward, point) : s->rounding;
}

/* The support points in directions nearby lie on a line along an edge, far apart; a face has others across it. */
MeBool mcd_shapeEdge(const McdShape *s, const double outward[3], double axis[3]) {
    static const double nearby = 1e-3; /* rad */
    double across[2][3], point[4][3], longest[3] = {0, 0, 0};
    mcd_basis(outward, across[0], across[1]);
    for (int i = 0; i < 4; i++) {
        double direction[3], along[3];
        mcd_mad(direction, outward, i % 2 ? nearby : -nearby, across[i / 2]);
        mcd_coreSupport(s, direction, point[i]);
        mcd_sub(along, point[i], point[0]);
        if (mcd_length(along) > mcd_length(longest))
            mcd_copy(longest, along);
    }
    const double length = mcd_length(longest);
    if (!(length > nearby * s->extent))
        return MEFALSE;
    for (int i = 1; i < 4; i++) {
        double along[3], aside[3];
        mcd_sub(along, point[i], point[0]);
        mcd_cross(aside, along, longest);
        if (mcd_length(aside) > nearby * length * length)
            return MEFALSE;
    }
    mcd_scale(axis, longest, 1 / length);
    return METRUE;
}

MeBool mcd_shapeHasRim(const McdShape *s) {
    return s->kind->rim && (!s->kind->isSampled || s->sampled->features->hasDisc);
}

double mcd_shapeNoise(const McdShape *s) {
    return s->kind->isSampled ? s->sampled->noise : 0;
}

void mcd_shapeBounds(const McdShape *s, double low[3], double high[3]) {
    if (s->kind->bounds) {
        s->kind->bounds(s, low, high);
        return;
    }
    for (int i = 0; i < 3; i++) {
        double along[3] = {0, 0, 0}, point[3];
        along[i] = 1;
        mcd_support(s, along, point);
        high[i] = point[i];
        along[i] = -1;
        mcd_support(s, along, point);
        low[i] = point[i];
    }
}

/* ---- points ---- */

void mcd_pointSupport(const McdShape *s, const double d[3], double point[3]) {
    (void)d;
    mcd_copy(point, s->place);
}

void mcd_pointFace(const McdShape *s, const double direction[3], McdFace *f) {
    (void)direction;
    mcd_faceAdd(s, f, 0, 0, 0, 0);
}
