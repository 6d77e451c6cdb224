/* Spheres. */
#include "McdSphere.h"
#include "convex/mcd_kind_i.h"
#include "geometry/mcd_geometry_i.h"

static const McdSphere *get(const McdGeometry *g) {
    return (const McdSphere *)g;
}

static void support(const McdGeometry *g, const double d[3], double point[3]) {
    const double length = mcd_length(d);
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

/* ---- the type ---------------------------------------------------------------------------------------------------- */

static MeReal boundingRadius(const McdGeometry *g, MeVector3 center) {
    (void)center;
    return get(g)->radius;
}

static void addMass(const McdGeometry *g, McdMass *sum) {
    const double r = (double)get(g)->radius, volume = 4. / 3 * MCD_PI * r * r * r, moment = .4 * volume * r * r;
    mcd_massDiagonal(sum, volume, moment, moment, moment);
}

static void draw(const McdGeometry *g, const MeMatrix4 tm, const MeReal colour[3]) {
    const double r = (double)get(g)->radius, origin[3] = {0, 0, 0}, x[3] = {r, 0, 0}, y[3] = {0, r, 0},
                 z[3] = {0, 0, r};
    mcd_drawArc(tm, colour, origin, x, y, MCD_DRAW_SIDES);
    mcd_drawArc(tm, colour, origin, y, z, MCD_DRAW_SIDES);
    mcd_drawArc(tm, colour, origin, z, x, MCD_DRAW_SIDES);
}

MCD_DEFINE_GEOMETRY_TYPE(Sphere, addMass)
