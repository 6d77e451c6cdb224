/* A triangle: as a convex shape, its normal, and its intersection with a segment. */
#include "convex/mcd_kind_i.h"
#include <string.h>

/* ---- the shape --------------------------------------------------------------------------------------------- */

static void triangleSupport(const McdShape *s, const double d[3], double point[3]) {
    int best = 0;
    for (int i = 1; i < 3; i++)
        if (mcd_dot(s->corner[i], d) > mcd_dot(s->corner[best], d))
            best = i;
    mcd_copy(point, s->corner[best]);
}

static void triangleFace(const McdShape *s, const double d[3], McdFace *f) {
    const MeBool isBack = mcd_dot(s->axis[2], d) < 0;
    mcd_scale(f->normal, s->axis[2], isBack ? -1 : 1);
    f->id = (MeU32)isBack;
    for (int i = 0; i < 3; i++) {
        const int corner = isBack ? 2 - i : i;
        mcd_copy(f->point[f->count], s->corner[corner]);
        f->name[f->count++] = (MeU32)corner;
    }
}

static const McdKind kind = {
    .support = triangleSupport, .face = triangleFace, .rank = MCD_RANK_TRIANGLE, .flatAxes = 4};

/* Sets the axes. The third one is the normal, by the right-hand rule; z for a triangle without area. */
static void setAxes(McdShape *shape) {
    double x[3], y[3], n[3];
    mcd_sub(x, shape->corner[1], shape->corner[0]);
    mcd_sub(y, shape->corner[2], shape->corner[0]);
    mcd_cross(n, x, y);
    const double length = mcd_length(n);
    for (int i = 0; i < 3; i++)
        shape->axis[2][i] = length > 0 ? n[i] / length : i == 2;
    mcd_basis(shape->axis[2], shape->axis[0], shape->axis[1]);
}

void mcd_triangleShape(const double corners[3][3], McdShape *shape) {
    memset(shape, 0, sizeof *shape);
    shape->kind = &kind;
    for (int i = 0; i < 3; i++) {
        mcd_copy(shape->corner[i], corners[i]);
        for (int j = 0; j < 3; j++)
            shape->place[j] += corners[i][j] / 3;
    }
    for (int i = 0; i < 3; i++)
        shape->extent = MeMAX(shape->extent, sqrt(mcd_distanceSquared(corners[i], shape->place)));
    setAxes(shape);
}

/* ---- its normal -------------------------------------------------------------------------------------------- */

static MeBool areCornersInRange(const double corner[3][3]) {
    return mcd_isInRange3(corner[0]) && mcd_isInRange3(corner[1]) && mcd_isInRange3(corner[2]);
}

/* The unit normal by the right-hand rule; false if the triangle has no area: if its height is less than 1e-7 of its
 * longest side. */
static MeBool unitNormalOf(const double corner[3][3], double normal[3]) {
    double e[3][3], longest = 0;
    for (int i = 0; i < 3; i++) {
        mcd_sub(e[i], corner[(i + 1) % 3], corner[i]);
        const double square = mcd_dot(e[i], e[i]);
        longest = MeMAX(longest, square);
    }
    mcd_cross(normal, e[0], e[1]);
    const double area = mcd_length(normal);
    if (!(area > 1e-7 * longest))
        return MEFALSE;
    mcd_scale(normal, normal, 1 / area);
    return METRUE;
}

MeBool mcd_triangleNormal(const double corner[3][3], const double *given, double normal[3]) {
    if (!areCornersInRange(corner) || !unitNormalOf(corner, normal))
        return MEFALSE;
    if (given && mcd_dot(given, normal) < 0)
        mcd_scale(normal, normal, -1);
    return METRUE;
}

/* ---- a segment --------------------------------------------------------------------------------------------- */

MeBool mcd_segmentTriangle(const double corner[3][3], const double normal[3], MeBool twoSided, const double from[3],
                           const double to[3], double *fraction, double hitNormal[3]) {
    double along[3], at[3];
    mcd_sub(along, to, from);
    const double fall = -mcd_dot(along, normal), height = mcd_heightOver(from, corner[0], normal);
    const double side = fall < 0 ? -1 : 1;
    if (fall == 0 || (side < 0 && !twoSided) || side * height < 0 || side * height > side * fall)
        return MEFALSE;
    *fraction = height / fall;
    MEASSERT(*fraction >= 0 && *fraction <= 1);
    mcd_mad(at, from, *fraction, along);
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3, last = (i + 2) % 3;
        double edge[3], inward[3];
        mcd_sub(edge, corner[next], corner[i]);
        mcd_cross(inward, normal, edge);
        const double width = mcd_heightOver(corner[last], corner[i], inward);
        const double inside = mcd_heightOver(at, corner[i], inward) * (width < 0 ? -1 : 1);
        if (inside < -1e-12 * fabs(width)) /* a point on an edge belongs to both of its triangles */
            return MEFALSE;
    }
    mcd_scale(hitNormal, normal, side);
    return METRUE;
}
