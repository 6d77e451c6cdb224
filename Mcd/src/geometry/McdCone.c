/* Cones and truncated cones about z, with their centre of mass at the origin. */
#include "McdCone.h"
#include "convex/mcd_kind_i.h"
#include "geometry/mcd_geometry_i.h"

static const McdCone *get(const McdGeometry *g) {
    return (const McdCone *)g;
}

/* Height and radius of both ends, in double. */
typedef struct Ends {
    double low, lowRadius, high, highRadius;
} Ends;

static Ends endsOf(const McdGeometry *g) {
    const double low = -(double)get(g)->lowerHeight;
    return (Ends){low, (double)get(g)->lowerRadius, low + (double)get(g)->length, (double)get(g)->upperRadius};
}

static void support(const McdGeometry *g, const double d[3], double point[3]) {
    const Ends e = endsOf(g);
    const double across = sqrt(d[0] * d[0] + d[1] * d[1]);
    const MeBool isHigh = across * e.highRadius + d[2] * e.high > across * e.lowRadius + d[2] * e.low;
    const double r = isHigh ? e.highRadius : e.lowRadius;
    point[0] = across > 0 ? r * d[0] / across : 0;
    point[1] = across > 0 ? r * d[1] / across : 0;
    point[2] = isHigh ? e.high : e.low;
}

/* ---- a line against the side: |p + t v|^2 <= (R + k t)^2, p and v orthogonal to the axis, R + k t >= 0 ---- */

static void sideNormal(const McdClip *c, double t, double slope, double normal[3]) {
    double p[3];
    mcd_clipAt(c, t, p);
    const double across = sqrt(p[0] * p[0] + p[1] * p[1]), length = sqrt(1 + slope * slope);
    normal[0] = across > 0 ? p[0] / (across * length) : 0;
    normal[1] = across > 0 ? p[1] / (across * length) : 0;
    normal[2] = across > 0 ? -slope / length : slope < 0 ? 1 : -1; /* at the tip */
}

/* Clips the line by the infinite cone of the side. It has been clipped between the ends, so R + k t >= 0. If a t^2 +
 * 2 b t + q <= 0 has two intervals, one of them belongs to the cone's mirror image beyond the tip. Parameters are
 * relative to `at`, which is near the cone. */
static void clipSide(McdClip *c, const Ends *e, double at) {
    const double slope = (e->highRadius - e->lowRadius) / (e->high - e->low);
    MEASSERT(e->high > e->low);
    double p[3], in = -HUGE_VAL, out = HUGE_VAL, normal[3] = {0, 0, 0};
    const double *v = c->along;
    mcd_clipAt(c, at, p);
    const double radius = e->lowRadius + slope * (p[2] - e->low), k = slope * v[2];
    const double a = v[0] * v[0] + v[1] * v[1] - k * k, b = p[0] * v[0] + p[1] * v[1] - radius * k;
    const double q = p[0] * p[0] + p[1] * p[1] - radius * radius;
    /* b^2 - a q without cancellation: (p x v)^2 is the squared distance of the line from the axis */
    const double turn = p[0] * v[1] - p[1] * v[0], u[2] = {radius * v[0] - k * p[0], radius * v[1] - k * p[1]};
    const double root2 = u[0] * u[0] + u[1] * u[1] - turn * turn;
    if (root2 < 0 || (a == 0 && b == 0)) {
        if (q > 0)
            c->in = HUGE_VAL;
        return;
    }
    const double sum = -(b + (b < 0 ? -sqrt(root2) : sqrt(root2)));
    const double t1 = a != 0 ? sum / a : b < 0 ? HUGE_VAL : -HUGE_VAL, t2 = sum != 0 ? q / sum : 0;
    if (a > 0 || (a == 0 && b != 0)) {
        in = MeMIN(t1, t2);
        out = MeMAX(t1, t2);
    } else if (k > 0) {
        in = MeMAX(t1, t2);
    } else {
        out = MeMIN(t1, t2);
    }
    if (in > -HUGE_VAL)
        sideNormal(c, at + in, slope, normal);
    mcd_clipInterval(c, at + in, at + out, normal);
}

static void clip(const McdGeometry *g, McdClip *c) {
    const Ends e = endsOf(g);
    const double up[3] = {0, 0, 1}, down[3] = {0, 0, -1}, *v = c->along;
    mcd_clipHalfSpace(c, up, e.high);
    mcd_clipHalfSpace(c, down, -e.low);
    const double vv = mcd_dot(v, v);
    if (mcd_clipIsEmpty(c))
        return;
    const double nearest = vv > 0 ? -mcd_dot(c->from, v) / vv : 0;
    clipSide(c, &e, MeCLAMP(nearest, c->in, c->out));
}

MCD_DEFINE_LINE_SEGMENT(Cone)

/* ---- narrow phase ---------------------------------------------------------------------------------------------- */

static void setShape(const McdGeometry *g, McdShape *s) {
    mcd_discsShape(s, (double)get(g)->lowerRadius, (double)get(g)->upperRadius, (double)get(g)->length,
                   (double)get(g)->lowerHeight);
}

static const McdKind kind = {MCD_KIND_FUNCTIONS(Cone, mcd_geometryFree),
                             .size = sizeof(McdCone),
                             .setShape = setShape,
                             .support = mcd_discsSupport,
                             .face = mcd_discsFace,
                             .bounds = mcd_discsBounds,
                             .radius = mcd_discsRadius,
                             .rim = mcd_discsRim,
                             .rank = MCD_RANK_CONE,
                             .flatAxes = 4};

/* ---- sizes ------------------------------------------------------------------------------------------------------- */

static MeBool isCone(McdGeometryID g, const char *function) {
    return mcd_geometryIs(g, kMcdGeometryTypeCone, function);
}

/* The centre of mass is l / 4 (r^2 + 2 r s + 3 s^2) / (r^2 + r s + s^2) above the base; s is the upper radius. */
static void setSizes(McdCone *c, MeReal length, MeReal lowerRadius, MeReal upperRadius) {
    const double s = (double)upperRadius / (double)MeMAX(lowerRadius, upperRadius);
    const double r = (double)lowerRadius / (double)MeMAX(lowerRadius, upperRadius);
    c->length = length;
    c->lowerRadius = lowerRadius;
    c->upperRadius = upperRadius;
    c->lowerHeight = (MeReal)((double)length / 4 * (r * r + 2 * r * s + 3 * s * s) / (r * r + r * s + s * s));
    MEASSERT(c->lowerHeight >= 0 && c->lowerHeight <= length);
}

McdConeID MEAPI McdConeCreate(McdFramework *frame, MeReal length, MeReal lowerRadius) {
    if (!mcd_sizeIsGood(length, "length", "McdConeCreate") || !mcd_sizeIsGood(lowerRadius, "radius", "McdConeCreate"))
        return 0;
    McdCone *c = mcd_geometryCreate(frame, kMcdGeometryTypeCone, sizeof *c, "McdConeCreate");
    if (c)
        setSizes(c, length, lowerRadius, 0);
    return (McdConeID)c;
}

static MeBool radiusIsGood(MeReal r, MeReal other, const char *what) {
    return (r == 0 && other != 0) || mcd_sizeIsGood(r, what, "McdConeSetGeometricalParameters");
}

void MEAPI McdConeSetGeometricalParameters(McdConeID g, MeReal length, MeReal lowerRadius, MeReal upperRadius) {
    if (isCone(g, "McdConeSetGeometricalParameters") &&
        mcd_sizeIsGood(length, "length", "McdConeSetGeometricalParameters") &&
        radiusIsGood(lowerRadius, upperRadius, "lower radius") &&
        radiusIsGood(upperRadius, lowerRadius, "upper radius")) {
        setSizes((McdCone *)g, length, lowerRadius, upperRadius);
        mcd_geometryChanged(g);
    }
}

MeReal MEAPI McdConeGetLength(McdConeID g) {
    return isCone(g, "McdConeGetLength") ? get(g)->length : 0;
}

MeReal MEAPI McdConeGetLowerRadius(McdConeID g) {
    return isCone(g, "McdConeGetLowerRadius") ? get(g)->lowerRadius : 0;
}

MeReal MEAPI McdConeGetUpperRadius(McdConeID g) {
    return isCone(g, "McdConeGetUpperRadius") ? get(g)->upperRadius : 0;
}

MeReal MEAPI McdConeGetLowerHeight(McdConeID g) {
    return isCone(g, "McdConeGetLowerHeight") ? get(g)->lowerHeight : 0;
}

MeReal MEAPI McdConeGetUpperHeight(McdConeID g) {
    return isCone(g, "McdConeGetUpperHeight") ? get(g)->length - get(g)->lowerHeight : 0;
}

MeReal MEAPI McdConeGetZOffset(McdConeID g) {
    return isCone(g, "McdConeGetZOffset") ? get(g)->length / 2 - get(g)->lowerHeight : 0;
}

/* ---- the type ---------------------------------------------------------------------------------------------------- */

/* The sphere through the rims of both ends. If its centre would be beyond an end, the centre of that end's disc is
 * used. */
static MeReal boundingRadius(const McdGeometry *g, MeVector3 center) {
    const Ends e = endsOf(g);
    double z =
        (e.high + e.low) / 2 + (e.highRadius - e.lowRadius) * (e.highRadius + e.lowRadius) / (2 * (e.high - e.low));
    z = (double)(MeReal)MeCLAMP(z, e.low, e.high);
    center[2] = (MeReal)z;
    return mcd_roundUp(MeMAX(sqrt((z - e.low) * (z - e.low) + e.lowRadius * e.lowRadius),
                             sqrt((e.high - z) * (e.high - z) + e.highRadius * e.highRadius)));
}

/* Integrals over discs of radius R(z): m = pi int R^2, I_zz = pi/2 int R^4, I_xx = I_zz/2 + pi int R^2 z^2. */
static void addMass(const McdGeometry *g, McdMass *sum) {
    const Ends e = endsOf(g);
    const double r = e.lowRadius, s = e.highRadius, l = e.high - e.low;
    const double mass = MCD_PI * l / 3 * (r * r + r * s + s * s);
    const double along =
        MCD_PI * l / 10 * (r * r * r * r + r * r * r * s + r * r * s * s + r * s * s * s + s * s * s * s);
    const double height = l / 4 * (r * r + 2 * r * s + 3 * s * s) / (r * r + r * s + s * s);
    const double fromBase = MCD_PI * l * l * l / 30 * (r * r + 3 * r * s + 6 * s * s);
    const double across = along / 2 + fromBase - mass * height * height;
    mcd_massDiagonal(sum, mass, across, across, along);
}

static void draw(const McdGeometry *g, const MeMatrix4 tm, const MeReal colour[3]) {
    const Ends e = endsOf(g);
    if (e.lowRadius > 0)
        mcd_drawCircle(tm, colour, e.low, e.lowRadius);
    if (e.highRadius > 0)
        mcd_drawCircle(tm, colour, e.high, e.highRadius);
    mcd_drawSides(tm, colour, e.low, e.lowRadius, e.high, e.highRadius);
}

MCD_DEFINE_GEOMETRY_TYPE(Cone, addMass)
