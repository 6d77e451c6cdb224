/* Convex hulls of graphics. */
#include "MeAppHull.h"
#include "McdConvexMesh.h"
#include "McdGeometry.h"
#include "MeMemory.h"
#include "MeMessage.h"
#include "MeViewer.h"
#include "me_app_i.h"

/* The graphic's vertices less a place. */
static McdConvexMeshID hullAround(McdFrameworkID frame, const RGraphic *rg, MeVector3 *points, const MeVector3 centre) {
    const int count = rg->m_pObject->m_nNumVertices;
    for (int i = 0; i < count; i++) {
        const RObjectVertex *v = &rg->m_pVertices[i];
        MeVector3Set(points[i], (MeReal)v->m_X - centre[0], (MeReal)v->m_Y - centre[1], (MeReal)v->m_Z - centre[2]);
    }
    return McdConvexMeshCreateHull(frame, (const MeVector3 *)points, count, 0);
}

McdConvexMeshID MEAPI MeAppHullCreate(McdFrameworkID frame, RRender *rc, RGraphic *rg, MeVector3 centre) {
    static const MeVector3 origin = {0, 0, 0};
    MeMatrix4 tm;
    MeMatrix3 moments;
    MeReal volume;
    if (!frame || !rc || !rg || rg->m_pObject->m_nNumVertices < 1) {
        MeWarning(1, "MeAppHullCreate: %s",
                  !frame ? "frame is null"
                  : !rc  ? "rc is null"
                         : "rg is null, or has no vertices");
        return 0;
    }
    MeVector3 *points = MeMemoryAPI.create((size_t)rg->m_pObject->m_nNumVertices * sizeof *points);
    if (!points) {
        MeFatalError(1, "MeAppHullCreate: no memory");
        return 0;
    }
    const McdConvexMeshID first = hullAround(frame, rg, points, origin);
    McdConvexMeshID hull = 0;
    if (first) {
        McdGeometryGetMassProperties(first, tm, moments, &volume);
        McdGeometryDestroy(first);
        hull = hullAround(frame, rg, points, tm[3]);
    }
    if (!hull)
        MeWarning(1, "MeAppHullCreate: the graphic's vertices span no volume");
    else {
        const MeVector3 back = {-tm[3][0], -tm[3][1], -tm[3][2]};
        RGraphicTranslateVertices(rc, rg, back);
        if (centre)
            MeVector3Copy(centre, tm[3]);
    }
    MeMemoryAPI.destroy(points);
    return hull;
}
