/* Triangle meshes of graphics, and of files. */
#include "MeAppMesh.h"
#include "McdMesh.h"
#include "MeInternal.h"
#include "MeMemory.h"
#include "MeMessage.h"
#include "MeViewer.h"
#include "RMesh.h"
#include "me_app_i.h"

/* The graphic's vertices, three for each triangle, and their numbers in order: a mesh welds them. */
static void readTriangles(const RGraphic *rg, MeVector3 *point, int *index) {
    for (int i = 0; i < rg->m_pObject->m_nNumVertices; i++) {
        const RObjectVertex *v = &rg->m_pVertices[i];
        MeVector3Set(point[i], (MeReal)v->m_X, (MeReal)v->m_Y, (MeReal)v->m_Z);
        index[i] = i;
    }
}

McdMeshID MEAPI MeAppMeshCreate(McdFrameworkID frame, const RGraphic *rg) {
    if (!frame || !rg || rg->m_pObject->m_nNumVertices < 3) {
        MeWarning(1, "MeAppMeshCreate: %s", frame ? "rg is null, or has no triangles" : "frame is null");
        return 0;
    }
    const int count = rg->m_pObject->m_nNumVertices;
    MeVector3 *point = MeMemoryAPI.create((size_t)count * sizeof *point);
    int *index = MeMemoryAPI.create((size_t)count * sizeof *index);
    McdMeshID mesh = 0;
    if (point && index) {
        readTriangles(rg, point, index);
        mesh = McdMeshCreate(frame, (const MeVector3 *)point, count, index, count / 3, 0);
    } else
        MeFatalError(1, "MeAppMeshCreate: no memory");
    if (point)
        MeMemoryAPI.destroy(point);
    if (index)
        MeMemoryAPI.destroy(index);
    return mesh;
}

static McdMeshID loadMesh(McdFrameworkID frame, RRender *rc, const char *filename, MeReal scale) {
    static const float white[4] = {1, 1, 1, 1};
    RGraphic *rg = RGraphicLoadMesh(rc, filename, (AcmeReal)scale, white, 0);
    if (!rg)
        return 0;
    McdMeshID mesh = MeAppMeshCreate(frame, rg);
    RGraphicDelete(rc, rg, 0);
    return mesh;
}

McdMeshID MEAPI MeAppMeshFromFile(McdFrameworkID frame, RRender *rc, const char *filename, MeReal scale) {
    ME_RETURN_UNDER_OWN_NAME(McdMeshID, loadMesh(frame, rc, filename, scale));
}
