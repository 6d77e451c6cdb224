/* Sphyls (capsules): a cylinder about z between two half spheres. */
#include "McdSphyl.h"
#include "convex/mcd_kind_i.h"
#include "geometry/mcd_geometry_i.h"

static const McdSphyl *get(const McdGeometry *g) {
    return (const McdSphyl *)g;
}

static void support(const McdGeometry *g, const double d[3], double point[3]) {
    const double length = mcd_length(d);
    for (int k = 0; k < 3; k++)
        point[k] = length > 0 ? (double)get(g)->radius * d[k] / length : 0;
    point[2] += d[2] < 0 ? -(double)get(g)->halfHeight : (double)get(g)->halfHeight;
}

/* The line's overlap with the sphyl is the union of those with its three parts. */
static void clip(const McdGeometry *g, McdClip *c) {
    const double h = (double)get(g)->halfHeight, low[3] = {0, 0, -h}, high[3] = {0, 0, h};
    mcd_clipCapsule(c, low, high, (double)get(g)->radius);
}

MCD_DEFINE_LINE_SEGMENT(Sphyl)

/* ---- narrow phase: the core is a segment ---------------------------------------------------------------------- */

static void setShape(const McdGeometry *g, McdShape *s) {
    s->low = (double)get(g)->halfHeight;
    s->rounding = (double)get(g)->radius;
    s->extent = s->rounding + s->low;
}

static void farthestEnd(const McdShape *s, const double d[3], double point[3]) {
    mcd_shapePoint(s, 0, 0, copysign(s->low, mcd_dot(s->axis[2], d)), point);
}

static void face(const McdShape *s, const double direction[3], McdFace *f) {
    double d[3];
    mcd_shapeToOwnAxes(s, direction, d);
    const double across = sqrt(d[0] * d[0] + d[1] * d[1]);
    if (across > 0)
        mcd_shapeDirection(s, d[0] / across, d[1] / across, 0, f->normal);
    mcd_faceAdd(s, f, 0, 0, -s->low, 0);
    mcd_faceAdd(s, f, 0, 0, s->low, 1);
}

static const McdKind kind = {MCD_KIND_FUNCTIONS(Sphyl, mcd_geometryFree),
                             .size = sizeof(McdSphyl),
                             .setShape = setShape,
                             .support = farthestEnd,
                             .face = face,
                             .rank = MCD_RANK_SPHYL};

McdSphylID MEAPI McdSphylCreate(McdFramework *frame, MeReal r, MeReal h) {
    if (!mcd_sizeIsGood(r, "radius", "McdSphylCreate") || !mcd_sizeIsGood(h, "height", "McdSphylCreate"))
        return 0;
    McdSphyl *s = mcd_geometryCreate(frame, kMcdGeometryTypeSphyl, sizeof *s, "McdSphylCreate");
    if (s) {
        s->radius = r;
        s->halfHeight = h / 2;
    }
    return (McdSphylID)s;
}

static MeBool isSphyl(McdGeometryID g, const char *function) {
    return mcd_geometryIs(g, kMcdGeometryTypeSphyl, function);
}

MeReal MEAPI McdSphylGetRadius(McdSphylID s) {
    return isSphyl(s, "McdSphylGetRadius") ? get(s)->radius : 0;
}

MeReal MEAPI McdSphylGetHeight(McdSphylID s) {
    return isSphyl(s, "McdSphylGetHeight") ? 2 * get(s)->halfHeight : 0;
}

void MEAPI McdSphylSetRadius(McdSphylID s, MeReal r) {
    if (isSphyl(s, "McdSphylSetRadius") && mcd_sizeIsGood(r, "radius", "McdSphylSetRadius")) {
        ((McdSphyl *)s)->radius = r;
        mcd_geometryChanged(s);
    }
}

void MEAPI McdSphylSetHeight(McdSphylID s, MeReal h) {
    if (isSphyl(s, "McdSphylSetHeight") && mcd_sizeIsGood(h, "height", "McdSphylSetHeight")) {
        ((McdSphyl *)s)->halfHeight = h / 2;
        mcd_geometryChanged(s);
    }
}

/* ---- the type ---------------------------------------------------------------------------------------------------- */

static MeReal boundingRadius(const McdGeometry *g, MeVector3 center) {
    (void)center;
    return mcd_roundUp((double)get(g)->radius + (double)get(g)->halfHeight);
}

/* The centre of mass of each half ball is 3/8 r beyond the cylinder's end; its inertia about the centre of its flat
 * side is m 2/5 r^2. So I_xx of both about the origin is m (2/5 r^2 + h^2 + 3/4 h r), with their total mass m and
 * half height h. */
static void addMass(const McdGeometry *g, McdMass *sum) {
    const double r = (double)get(g)->radius, h = (double)get(g)->halfHeight;
    const double middle = MCD_PI * r * r * 2 * h, ends = 4. / 3 * MCD_PI * r * r * r;
    const double across = middle * (r * r / 4 + h * h / 3) + ends * (.4 * r * r + h * h + .75 * h * r);
    mcd_massDiagonal(sum, middle + ends, across, across, middle * r * r / 2 + .4 * ends * r * r);
}

static void draw(const McdGeometry *g, const MeMatrix4 tm, const MeReal colour[3]) {
    const double r = (double)get(g)->radius, h = (double)get(g)->halfHeight;
    mcd_drawCircle(tm, colour, h, r);
    mcd_drawCircle(tm, colour, -h, r);
    mcd_drawSides(tm, colour, -h, r, h, r);
    for (int side = -1; side <= 1; side += 2) {
        const double centre[3] = {0, 0, side * h}, x[3] = {r, 0, 0}, y[3] = {0, r, 0}, z[3] = {0, 0, side * r};
        mcd_drawArc(tm, colour, centre, x, z, MCD_DRAW_SIDES / 2);
        mcd_drawArc(tm, colour, centre, y, z, MCD_DRAW_SIDES / 2);
    }
}

MCD_DEFINE_GEOMETRY_TYPE(Sphyl, addMass)
