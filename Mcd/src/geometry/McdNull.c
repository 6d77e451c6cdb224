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
MCD_DEFINE_GEOMETRY_TYPE(Null)

McdNullID MEAPI McdNullCreate(McdFramework *frame) {
    return (McdNullID)mcd_geometryCreate(frame, kMcdGeometryTypeNull, sizeof(McdNull), "McdNullCreate");
}

void MEAPI McdNullGetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius) {
    if (!mcd_areGiven(__func__, center, radius, radius))
        return;
    (void)g;
    MeVector3Set(center, 0, 0, 0);
    *radius = 0;
}

MeI16 MEAPI McdNullGetMassProperties(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 inertia, MeReal *volume) {
    (void)g;
    (void)relTM;
    (void)inertia;
    (void)volume;
    return 0;
}

void MEAPI McdNullDebugDraw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3]) {
    (void)g;
    (void)tm;
    (void)colour;
}
