/* The null geometry, without extent. */
#include "McdNull.h"
#include "convex/mcd_kind_i.h"
#include "geometry/mcd_geometry_i.h"

static void support(const McdGeometry *g, const double direction[3], double point[3]) {
    (void)g;
    (void)direction;
    point[0] = point[1] = point[2] = 0;
}

static const McdKind kind = {MCD_KIND_FUNCTIONS(Null, mcd_geometryFree), .isStatic = METRUE, .isEmpty = METRUE};

static MeReal boundingRadius(const McdGeometry *g, MeVector3 center) {
    (void)g;
    (void)center;
    return 0;
}

static void draw(const McdGeometry *g, const MeMatrix4 tm, const MeReal colour[3]) {
    (void)g;
    (void)tm;
    (void)colour;
}

MCD_DEFINE_GEOMETRY_TYPE(Null, mcd_addNoMass)

McdNullID MEAPI McdNullCreate(McdFramework *frame) {
    return (McdNullID)mcd_geometryCreate(frame, kMcdGeometryTypeNull, sizeof(McdNull), "McdNullCreate");
}
