/* Cylinders about z. */
#include "McdCylinder.h"
#include "convex/mcd_kind_i.h"
#include "geometry/mcd_geometry_i.h"

static const McdCylinder *get(const McdGeometry *g) {
    return (const McdCylinder *)g;
}

static void support(const McdGeometry *g, const double d[3], double point[3]) {
    const double across = sqrt(d[0] * d[0] + d[1] * d[1]), r = (double)get(g)->radius;
    point[0] = across > 0 ? r * d[0] / across : 0;
    point[1] = across > 0 ? r * d[1] / across : 0;
    point[2] = d[2] < 0 ? -(double)get(g)->halfHeight : (double)get(g)->halfHeight;
}

static void clip(const McdGeometry *g, McdClip *c) {
    const double origin[3] = {0, 0, 0}, up[3] = {0, 0, 1}, down[3] = {0, 0, -1};
    mcd_clipHalfSpace(c, up, (double)get(g)->halfHeight);
    mcd_clipHalfSpace(c, down, (double)get(g)->halfHeight);
    mcd_clipCylinder(c, origin, up, (double)get(g)->radius);
}

MCD_DEFINE_LINE_SEGMENT(Cylinder)

/* ---- narrow phase ---------------------------------------------------------------------------------------------- */

static void setShape(const McdGeometry *g, McdShape *s) {
    const double r = (double)get(g)->radius, h = (double)get(g)->halfHeight;
    mcd_discsShape(s, r, r, 2 * h, h);
}

/* Visits the edges of a prism with that many sides. */
static void visitEdges(const McdGeometry *g, int sides, McdEdgeVisit visit, void *context) {
    const double r = (double)get(g)->radius, h = (double)get(g)->halfHeight;
    for (int i = 0; i < sides; i++) {
        const double from = 2 * (double)ME_PI * i / sides, to = 2 * (double)ME_PI * (i + 1) / sides;
        const double low[2][3] = {{r * cos(from), r * sin(from), -h}, {r * cos(to), r * sin(to), -h}};
        const double high[2][3] = {{low[0][0], low[0][1], h}, {low[1][0], low[1][1], h}};
        visit(context, low[0], high[0]);
        visit(context, low[0], low[1]);
        visit(context, high[0], high[1]);
    }
}

static const McdKind kind = {MCD_KIND_FUNCTIONS(Cylinder, mcd_geometryFree),
                             .size = sizeof(McdCylinder),
                             .setShape = setShape,
                             .support = mcd_discsSupport,
                             .face = mcd_discsFace,
                             .bounds = mcd_discsBounds,
                             .radius = mcd_discsRadius,
                             .rim = mcd_discsRim,
                             .rank = MCD_RANK_CYLINDER,
                             .flatAxes = 4,
                             .edges = visitEdges};

static MeBool sizesAreGood(MeReal r, MeReal h, const char *function) {
    return mcd_sizeIsGood(r, "radius", function) && mcd_sizeIsGood(h, "height", function);
}

McdCylinderID MEAPI McdCylinderCreate(McdFramework *frame, MeReal r, MeReal h) {
    if (!sizesAreGood(r, h, "McdCylinderCreate"))
        return 0;
    McdCylinder *c = mcd_geometryCreate(frame, kMcdGeometryTypeCylinder, sizeof *c, "McdCylinderCreate");
    if (c) {
        c->radius = r;
        c->halfHeight = h / 2;
    }
    return (McdCylinderID)c;
}

static MeBool isCylinder(McdGeometryID g, const char *function) {
    return mcd_geometryIs(g, kMcdGeometryTypeCylinder, function);
}

MeReal MEAPI McdCylinderGetRadius(McdCylinderID g) {
    return isCylinder(g, "McdCylinderGetRadius") ? get(g)->radius : 0;
}

MeReal MEAPI McdCylinderGetHeight(McdCylinderID g) {
    return isCylinder(g, "McdCylinderGetHeight") ? 2 * get(g)->halfHeight : 0;
}

MeReal MEAPI McdCylinderGetHalfHeight(McdCylinderID g) {
    return isCylinder(g, "McdCylinderGetHalfHeight") ? get(g)->halfHeight : 0;
}

void MEAPI McdCylinderSetRadius(McdCylinderID g, MeReal r) {
    if (isCylinder(g, "McdCylinderSetRadius") && mcd_sizeIsGood(r, "radius", "McdCylinderSetRadius")) {
        ((McdCylinder *)g)->radius = r;
        mcd_geometryChanged(g);
    }
}

void MEAPI McdCylinderSetHeight(McdCylinderID g, MeReal h) {
    if (isCylinder(g, "McdCylinderSetHeight") && mcd_sizeIsGood(h, "height", "McdCylinderSetHeight")) {
        ((McdCylinder *)g)->halfHeight = h / 2;
        mcd_geometryChanged(g);
    }
}

void MEAPI McdCylinderSetGeometricalParameters(McdCylinderID g, MeReal inRadius, MeReal inHeight) {
    if (!isCylinder(g, "McdCylinderSetGeometricalParameters") ||
        !sizesAreGood(inRadius, inHeight, "McdCylinderSetGeometricalParameters"))
        return;
    ((McdCylinder *)g)->radius = inRadius;
    ((McdCylinder *)g)->halfHeight = inHeight / 2;
    mcd_geometryChanged(g);
}

void MEAPI McdCylinderGetXYAABB(McdGeometry *g, MeMatrix4 tm, MeReal bounds[4]) {
    mcd_localXYAABB(g, kMcdGeometryTypeCylinder, tm, bounds, support, __func__);
}

void MEAPI McdCylinderMaximumPointLocal(McdGeometry *g, MeReal *const inDir, MeReal *const outPoint) {
    if (!mcd_areGiven(__func__, inDir, outPoint, outPoint))
        return;
    double d[3], p[3] = {0, 0, 0};
    mcd_fromReal(d, inDir);
    const MeBool isGood = isCylinder(g, "McdCylinderMaximumPointLocal");
    if (isGood && mcd_areInRange(inDir, 3))
        support(g, d, p);
    else if (isGood)
        MeWarning(1, "McdCylinderMaximumPointLocal: the direction is not finite");
    mcd_toReal(outPoint, p);
}

/* ---- the type ---------------------------------------------------------------------------------------------------- */

static MeReal boundingRadius(const McdGeometry *g, MeVector3 center) {
    const double r = (double)get(g)->radius, h = (double)get(g)->halfHeight;
    (void)center;
    return mcd_roundUp(sqrt(r * r + h * h));
}

/* I_zz = m r^2 / 2, I_xx = m (r^2 / 4 + h^2 / 3) with half height h. */
static void addMass(const McdGeometry *g, McdMass *sum) {
    const double r = (double)get(g)->radius, h = (double)get(g)->halfHeight;
    const double mass = MCD_PI * r * r * 2 * h, across = mass * (r * r / 4 + h * h / 3);
    mcd_massDiagonal(sum, mass, across, across, mass * r * r / 2);
}

static void draw(const McdGeometry *g, const MeMatrix4 tm, const MeReal colour[3]) {
    const double r = (double)get(g)->radius, h = (double)get(g)->halfHeight;
    mcd_drawCircle(tm, colour, h, r);
    mcd_drawCircle(tm, colour, -h, r);
    mcd_drawSides(tm, colour, -h, r, h, r);
}

MCD_DEFINE_GEOMETRY_TYPE(Cylinder, addMass)
