/* Shared by the geometry types: conversions from a geometry's own frame, in double, to the world and MeReal. */
#include "geometry/mcd_local_i.h"
#include "MeDebugDraw.h"
#include <string.h>

/* ---- sizes ----------------------------------------------------------------------------------------------------- */

MeBool mcd_sizeIsGood(MeReal size, const char *what, const char *function) {
    if (size >= (MeReal)FLT_MIN && size <= (MeReal)(FLT_MAX / 4))
        return METRUE;
    MeWarning(1, "%s: the %s is %g, not a number > 0%s", function, what, (double)size,
              size > 0 && size < 1 ? " of single precision" : "");
    return MEFALSE;
}

MeBool mcd_instanceIs(McdGeometryInstanceID ins, McdGeometryType type, const char *function) {
    if (!ins || !MCD_IS_KNOWN(ins, MCD_INSTANCE)) {
        mcd_warnGone(ins, "instance", function);
        return MEFALSE;
    }
    if (mcd_instanceIsPlaced(ins))
        return mcd_geometryIs(ins->geometry, type, function);
    MeWarning(1, "%s: the instance has no transform, or one that is not finite, or flat", function);
    return MEFALSE;
}

/* ---- boxes, support points ------------------------------------------------------------------- */

void mcd_localXYAABB(McdGeometryID g, McdGeometryType type, const MeMatrix4Ptr tm, MeReal bounds[4],
                     McdLocalSupportFn support, const char *function) {
    if (!mcd_areGiven(function, tm, bounds, bounds))
        return;
    MeVectorSetZero(bounds, 4);
    if (!mcd_geometryIs(g, type, function))
        return;
    if (!mcd_isValidTransform(mcd_const(tm))) {
        MeWarning(1, "%s: tm is no transform, or not finite; the bounds are 0", function);
        return;
    }
    for (int i = 0; i < 2; i++) {
        double low, high;
        mcd_localExtent(g, mcd_const(tm), i, support, &low, &high);
        bounds[2 * i] = mcd_roundDown(low);
        bounds[2 * i + 1] = mcd_roundUp(high);
    }
}

void mcd_localMaximumPoint(McdGeometryInstanceID ins, const MeReal *direction, MeReal *point,
                           McdLocalSupportFn support) {
    const MeMatrix4Ptr tm = mcd_instanceTM(ins);
    double d[3], p[3];
    if (!mcd_areInRange(direction, 3)) {
        MeWarning(1, "Mcd...MaximumPoint: the direction is not finite");
        MeVector3Copy(point, tm[3]);
        return;
    }
    for (int j = 0; j < 3; j++) {
        d[j] = 0;
        for (int i = 0; i < 3; i++)
            d[j] += (double)tm[j][i] * (double)direction[i];
    }
    support(ins->geometry, d, p);
    for (int i = 0; i < 3; i++)
        point[i] = mcd_clampReal(mcd_placedCoordinate(mcd_const(tm), p, i));
}

void mcd_boxSupport(const MeReal *min, const MeReal *max, const double direction[3], double point[3]) {
    for (int i = 0; i < 3; i++)
        point[i] = (double)(direction[i] > 0 ? max[i] : min[i]);
}

MeReal mcd_boxBSphere(const MeReal *min, const MeReal *max, MeVector3 center) {
    MeReal sum = 0;
    for (int i = 0; i < 3; i++) {
        center[i] = mcd_clampReal((double)(min[i] / 2 + max[i] / 2));
        sum += (max[i] - min[i]) * (max[i] - min[i]);
    }
    return mcd_clampReal((double)(MeSqrt(sum) / 2));
}

/* ---- line segments ----------------------------------------------------------------------------------------------- */

MeBool mcd_clipIsEmpty(const McdClip *c) {
    return !(c->in <= c->out);
}

void mcd_clipAt(const McdClip *c, double t, double point[3]) {
    mcd_mad(point, c->from, t, c->along);
}

static void clipAll(McdClip *c) {
    c->in = HUGE_VAL;
    c->out = -HUGE_VAL;
}

void mcd_clipInterval(McdClip *c, double in, double out, const double normal[3]) {
    if (in > c->in) {
        c->in = in;
        mcd_copy(c->normal, normal);
    }
    c->out = MeMIN(c->out, out);
}

void mcd_clipHalfSpace(McdClip *c, const double normal[3], double offset) {
    const double gap = offset - mcd_dot(normal, c->from), speed = mcd_dot(normal, c->along);
    if (speed < 0)
        mcd_clipInterval(c, gap / speed, HUGE_VAL, normal);
    else if (speed > 0)
        mcd_clipInterval(c, -HUGE_VAL, gap / speed, normal);
    else if (gap < 0)
        clipAll(c);
}

/* Clips the line r + t v, relative to a centre, by |r + t v| <= radius. Computes from the line's point nearest to
 * the centre, which is accurate for a line that begins far away. */
static void clipRound(McdClip *c, const double r[3], const double v[3], double radius) {
    const double vv = mcd_dot(v, v), nearest = vv > 0 ? -mcd_dot(r, v) / vv : 0;
    double p[3], normal[3];
    mcd_mad(p, r, nearest, v);
    const double inside = radius * radius - mcd_dot(p, p);
    if (inside < 0) {
        clipAll(c);
    } else if (vv > 0) {
        const double half = sqrt(inside / vv);
        MEASSERT(half >= 0 && radius > 0);
        for (int k = 0; k < 3; k++)
            normal[k] = (p[k] - half * v[k]) / radius;
        mcd_clipInterval(c, nearest - half, nearest + half, normal);
    }
}

void mcd_clipBall(McdClip *c, const double centre[3], double radius) {
    double r[3];
    mcd_sub(r, c->from, centre);
    clipRound(c, r, c->along, radius);
}

void mcd_clipCylinder(McdClip *c, const double point[3], const double axis[3], double radius) {
    double r[3], v[3];
    mcd_sub(r, c->from, point);
    mcd_mad(r, r, -mcd_dot(r, axis), axis);
    mcd_mad(v, c->along, -mcd_dot(c->along, axis), axis);
    clipRound(c, r, v, radius);
}

void mcd_clipUnion(McdClip *c, const McdClip *other) {
    if (mcd_clipIsEmpty(other))
        return;
    if (mcd_clipIsEmpty(c)) {
        *c = *other;
        return;
    }
    if (other->in < c->in) {
        c->in = other->in;
        mcd_copy(c->normal, other->normal);
    }
    c->out = MeMAX(c->out, other->out);
}

void mcd_clipCapsule(McdClip *c, const double a[3], const double b[3], double radius) {
    double axis[3], back[3];
    mcd_sub(axis, b, a);
    const double length = mcd_length(axis);
    for (int k = 0; k < 3; k++)
        axis[k] /= length;
    mcd_scale(back, axis, -1);
    McdClip first = *c, second = *c;
    mcd_clipHalfSpace(c, axis, mcd_dot(axis, b));
    mcd_clipHalfSpace(c, back, -mcd_dot(axis, a));
    mcd_clipCylinder(c, a, axis, radius);
    mcd_clipBall(&first, a, radius);
    mcd_clipBall(&second, b, radius);
    mcd_clipUnion(c, &first);
    mcd_clipUnion(c, &second);
}

static void toLocal(const MeVector4 *tm, const double v[3], double out[3]) {
    for (int j = 0; j < 3; j++)
        out[j] = (double)tm[j][0] * v[0] + (double)tm[j][1] * v[1] + (double)tm[j][2] * v[2];
}

MeBool mcd_toLocal(const MeVector4 *tm, const MeReal *world, double local[3]) {
    double offset[3];
    for (int i = 0; i < 3; i++)
        offset[i] = (double)world[i] - (double)tm[3][i];
    toLocal(tm, offset, local);
    return isfinite(local[0] + local[1] + local[2]);
}

int mcd_writeSegmentHit(const MeVector4 *tm, const MeReal *from, const MeReal *to, double fraction,
                        const double normal[3], McdLineSegIntersectResult *hit) {
    double length = 0;
    MEASSERT(fraction >= 0 && fraction <= 1);
    for (int i = 0; i < 3; i++) {
        const double along = (double)to[i] - (double)from[i];
        length += along * along;
        hit->position[i] = mcd_clampReal((double)from[i] + fraction * along);
        hit->normal[i] =
            (MeReal)((double)tm[0][i] * normal[0] + (double)tm[1][i] * normal[1] + (double)tm[2][i] * normal[2]);
    }
    hit->distance = mcd_clampReal(fraction * sqrt(length));
    return 1;
}

int mcd_localLineSegment(McdModelID cm, const MeReal *from, const MeReal *to, McdLineSegIntersectResult *result,
                         McdLocalClipFn clip) {
    McdGeometryInstance *ins = &mcd_record(cm)->instance;
    if (!mcd_instanceIsPlaced(ins))
        return 0;
    const MeVector4 *tm = mcd_const(mcd_instanceTM(ins));
    const double inside[3] = {0, 0, 0};
    double displacement[3];
    McdClip c = {.in = -HUGE_VAL, .out = HUGE_VAL};
    for (int i = 0; i < 3; i++)
        displacement[i] = (double)to[i] - (double)from[i];
    if (!mcd_toLocal(tm, from, c.from))
        return 0;
    toLocal(tm, displacement, c.along);
    clip(ins->geometry, &c);
    if (mcd_clipIsEmpty(&c) || c.in > 1 || c.out < 0)
        return 0;
    MEASSERT(!(c.in > 0) || isfinite(mcd_dot(c.normal, c.normal))); /* its length may have lost digits far away */
    result->model = cm;
    return mcd_writeSegmentHit(tm, from, to, MeMAX(c.in, 0), c.in > 0 ? c.normal : inside, result);
}

/* ---- mass -------------------------------------------------------------------------------------------------------- */

MeBool mcd_isInertiaGood(const McdMass *m) {
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double others = m->inertia[j][j] + m->inertia[k][k];
        if (m->inertia[i][i] < 0 || m->inertia[i][i] > others * (1 + 1e-6) || m->inertia[i][j] != m->inertia[j][i])
            return MEFALSE;
    }
    return METRUE;
}

MeI16 mcd_massStore(const McdMass *m, MeMatrix4 relTM, MeMatrix3 inertia, MeReal *volume) {
    const double greatest = MeMAX3(m->inertia[0][0], m->inertia[1][1], m->inertia[2][2]);
    MeMatrix4TMMakeIdentity(relTM);
    memset(inertia, 0, sizeof(MeMatrix3));
    *volume = 0;
    if (!(m->volume > 0) || !(m->volume <= (double)MEINFINITY) || !(greatest <= (double)MEINFINITY))
        return 0;
    *volume = (MeReal)m->volume;
    for (int i = 0; i < 3; i++) {
        relTM[3][i] = (MeReal)m->centre[i];
        for (int j = 0; j < 3; j++)
            inertia[i][j] = (MeReal)m->inertia[i][j];
    }
    return 1;
}

void mcd_massDiagonal(McdMass *m, double volume, double x, double y, double z) {
    *m = (McdMass){volume, {0, 0, 0}, {{x, 0, 0}, {0, y, 0}, {0, 0, z}}};
    MEASSERT(mcd_isInertiaGood(m));
}

/* ---- drawing ----------------------------------------------------------------------------------------------------- */

static void toWorld(const MeVector4 *tm, const double p[3], MeVector3 out) {
    for (int i = 0; i < 3; i++)
        out[i] = (MeReal)mcd_placedCoordinate(tm, p, i);
}

void mcd_drawLine(const MeVector4 *tm, const MeReal colour[3], const double a[3], const double b[3]) {
    MeVector3 start, end;
    toWorld(tm, a, start);
    toWorld(tm, b, end);
    const MeProgramCall before = MeProgramEnterQuiet("MeDebugDrawAPI.line");
    MeDebugDrawAPI.line(start, end, colour[0], colour[1], colour[2]);
    MeProgramLeave(&before);
}

void mcd_drawBox(const MeVector4 *tm, const MeReal colour[3], const MeReal *min, const MeReal *max) {
    for (int k = 0; k < 8; k++)
        for (int bit = 1; bit < 8; bit *= 2) {
            double a[3], b[3];
            if (k & bit)
                continue;
            for (int i = 0; i < 3; i++) {
                a[i] = (double)(k & 1 << i ? max[i] : min[i]);
                b[i] = (double)((k | bit) & 1 << i ? max[i] : min[i]);
            }
            mcd_drawLine(tm, colour, a, b);
        }
}

void mcd_drawArc(const MeVector4 *tm, const MeReal colour[3], const double centre[3], const double u[3],
                 const double v[3], int pieces) {
    const double step = 2 * MCD_PI / MCD_DRAW_SIDES;
    double last[3] = {0, 0, 0};
    for (int n = 0; n <= pieces; n++) {
        double p[3];
        mcd_mad(p, centre, cos(n * step), u);
        mcd_mad(p, p, sin(n * step), v);
        if (n > 0)
            mcd_drawLine(tm, colour, last, p);
        mcd_copy(last, p);
    }
}

void mcd_drawCircle(const MeVector4 *tm, const MeReal colour[3], double z, double radius) {
    const double centre[3] = {0, 0, z}, u[3] = {radius, 0, 0}, v[3] = {0, radius, 0};
    mcd_drawArc(tm, colour, centre, u, v, MCD_DRAW_SIDES);
}

void mcd_drawSides(const MeVector4 *tm, const MeReal colour[3], double z1, double radius1, double z2, double radius2) {
    const double direction[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int i = 0; i < 4; i++) {
        const double a[3] = {radius1 * direction[i][0], radius1 * direction[i][1], z1};
        const double b[3] = {radius2 * direction[i][0], radius2 * direction[i][1], z2};
        mcd_drawLine(tm, colour, a, b);
    }
}
