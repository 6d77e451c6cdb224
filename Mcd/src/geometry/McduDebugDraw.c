/* Draws boxes, geometries and models, line by line. */
#include "McduDebugDraw.h"
#include "geometry/mcd_local_i.h"

void MEAPI McduDebugDrawAABB(const MeVector3 min, const MeVector3 max, const MeReal colour[3]) {
    if (!mcd_areGiven(__func__, min, max, colour))
        return;
    static const MeMatrix4 world = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    mcd_drawBox(world, colour, min, max);
}

void MEAPI McduDebugDrawGeometry(const McdGeometryID geometry, const MeMatrix4Ptr tm, const MeReal colour[3]) {
    ME_UNDER_OWN_NAME(McdGeometryDebugDraw(geometry, tm, colour));
}

/* Draws by the type's registered function, so that types which the program does not use are not linked. */
static void drawTyped(McdGeometryID g, McdGeometryType type, const MeVector4 *tm, const MeReal colour[3],
                      const char *function) {
    if (mcd_areGiven(function, tm, colour, colour) && mcd_geometryIs(g, type, function))
        McdGeometryDebugDraw(g, (MeMatrix4Ptr)tm, colour);
}

void MEAPI McduDebugDrawSphere(const McdSphereID sphere, const MeMatrix4 tm, const MeReal colour[3]) {
    drawTyped(sphere, kMcdGeometryTypeSphere, tm, colour, "McduDebugDrawSphere");
}

void MEAPI McduDebugDrawBox(const McdBoxID box, const MeMatrix4 tm, const MeReal colour[3]) {
    drawTyped(box, kMcdGeometryTypeBox, tm, colour, "McduDebugDrawBox");
}

void MEAPI McduDebugDrawCylinder(const McdCylinderID cyl, const MeMatrix4 tm, const MeReal colour[3]) {
    drawTyped(cyl, kMcdGeometryTypeCylinder, tm, colour, "McduDebugDrawCylinder");
}

void MEAPI McduDebugDrawConvex(const McdConvexMeshID convex, const MeMatrix4 tm, const MeReal colour[3]) {
    drawTyped(convex, kMcdGeometryTypeConvexMesh, tm, colour, "McduDebugDrawConvex");
}

void MEAPI McduDebugDrawAggregate(const McdAggregateID agg, const MeMatrix4 tm, const MeReal colour[3]) {
    drawTyped(agg, kMcdGeometryTypeAggregate, tm, colour, "McduDebugDrawAggregate");
}

void MEAPI McduDebugDrawModel(const McdModelID model, McduDebugDrawFlags flags, const MeReal colour[3]) {
    if (!mcd_areGiven(__func__, colour, colour, colour))
        return;
    McdModelRecord *m = mcd_modelCheck(model, "McduDebugDrawModel");
    if (!m || !mcd_modelIsPlaced(m))
        return;
    if (flags & kMcduDebugDrawAABB)
        McduDebugDrawAABB(m->instance.min, m->instance.max, colour);
    if (flags & kMcduDebugDrawDetail)
        McdGeometryDebugDraw(m->instance.geometry, mcd_instanceTM(&m->instance), colour);
}

void MEAPI McdDebugDrawModelAABB(McdModelID cm) {
    static const MeReal white[3] = {1, 1, 1};
    if (mcd_modelCheck(cm, "McdDebugDrawModelAABB"))
        McduDebugDrawModel(cm, kMcduDebugDrawAABB, white);
}
