/* Spheres. */
#include "McdSphere.h"
#include "convex/mcd_kind_i.h"
#include "geometry/mcd_geometry_i.h"

static const McdSphere *get(const McdGeometry *g) {
    return (const McdSphere *)g;
}

static void support(const McdGeometry *g, const double d[3], double point[3]) {
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; k++)
        point[k] = length > 0 ? (double)get(g)->radius * d[k] / length : 0;
}

static void clip(const McdGeometry *g, McdClip *c) {
    const double centre[3] = {0, 0, 0};
    mcd_clipBall(c, centre, (double)get(g)->radius);
}

MCD_DEFINE_LINE_SEGMENT(Sphere)

/* The core is a point, the rounding the radius. */
static void setShape(const McdGeometry *g, McdShape *s) {
    s->rounding = s->extent = (double)get(g)->radius;
}

static const McdKind kind = {MCD_KIND_FUNCTIONS(Sphere, mcd_geometryFree),
                             .size = sizeof(McdSphere),
                             .setShape = setShape,
                             .support = mcd_pointSupport,
                             .face = mcd_pointFace,
                             .rank = MCD_RANK_SPHERE};
MCD_DEFINE_GEOMETRY_TYPE(Sphere)

McdSphereID MEAPI McdSphereCreate(McdFramework *frame, MeReal r) {
    if (!mcd_sizeIsGood(r, "radius", "McdSphereCreate"))
        return 0;
    McdSphere *s = mcd_geometryCreate(frame, kMcdGeometryTypeSphere, sizeof *s, "McdSphereCreate");
    if (s)
        s->radius = r;
    return (McdSphereID)s;
}

MeReal MEAPI McdSphereGetRadius(McdSphereID g) {
    return mcd_geometryIs(g, kMcdGeometryTypeSphere, "McdSphereGetRadius") ? get(g)->radius : 0;
}

void MEAPI McdSphereSetRadius(McdSphereID g, MeReal r) {
    if (mcd_geometryIs(g, kMcdGeometryTypeSphere, "McdSphereSetRadius") &&
        mcd_sizeIsGood(r, "radius", "McdSphereSetRadius")) {
        ((McdSphere *)g)->radius = r;
        mcd_geometryChanged(g);
    }
}

void MEAPI McdSphereGetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius) {
    if (!mcd_areGiven(__func__, center, radius, radius))
        return;
    MeVector3Set(center, 0, 0, 0);
    *radius = mcd_geometryIs(g, kMcdGeometryTypeSphere, "McdSphereGetBSphere") ? get(g)->radius : 0;
}

MeI16 MEAPI McdSphereGetMassProperties(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 inertia, MeReal *volume) {
    if (!mcd_areGiven(__func__, relTM, inertia, volume))
        return 0;
    if (!mcd_geometryIs(g, kMcdGeometryTypeSphere, "McdSphereGetMassProperties"))
        return 0;
    const double r = (double)get(g)->radius, mass = 4. / 3 * MCD_PI * r * r * r, moment = .4 * mass * r * r;
    return mcd_massDiagonal(relTM, inertia, volume, mass, moment, moment, moment);
}

void MEAPI McdSphereDebugDraw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3]) {
    if (!mcd_areGiven(__func__, tm, colour, colour))
        return;
    if (!mcd_geometryIs(g, kMcdGeometryTypeSphere, "McdSphereDebugDraw"))
        return;
    const double r = (double)get(g)->radius, origin[3] = {0, 0, 0}, x[3] = {r, 0, 0}, y[3] = {0, r, 0},
                 z[3] = {0, 0, r};
    mcd_drawArc(tm, colour, origin, x, y, MCD_DRAW_SIDES);
    mcd_drawArc(tm, colour, origin, y, z, MCD_DRAW_SIDES);
    mcd_drawArc(tm, colour, origin, z, x, MCD_DRAW_SIDES);
}
