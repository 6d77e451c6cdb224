/* The triangles of an indexed mesh: copied or borrowed, welded, and checked once. */
#include "surface/mcd_mesh_data_i.h"
#include "McdMesh.h"
#include "convex/mcd_kind_i.h"
#include "convex/mcd_vector_i.h"
#include "surface/mcd_mesh_stages_i.h"
#include <string.h>

/* ---- welding ----------------------------------------------------------------------------------------------------- */

static MeBool arePlacesEqual(const MeReal a[3], const MeReal b[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Sets first[v] to the first vertex with the same coordinates; -1 if they are not finite. By a hash table with open
 * addressing, at most half full. */
static MeBool findFirsts(const McdMeshInput *in, int *first, const char *function) {
    MeU32 slots = 2;
    while (slots < 2 * (MeU32)in->vertexCount)
        slots *= 2;
    int *slot = MeMemoryTake(slots, sizeof *slot, function, "welding");
    if (!slot)
        return MEFALSE;
    memset(slot, -1, slots * sizeof *slot);
    for (int v = 0; v < in->vertexCount; v++) {
        first[v] = -1;
        if (!mcd_areInRange(in->vertex[v], 3))
            continue;
        double place[3];
        mcd_fromReal(place, in->vertex[v]);
        MeU32 at = mcd_meshHashOfPoint(place) & (slots - 1);
        while (slot[at] >= 0 && !arePlacesEqual(in->vertex[slot[at]], in->vertex[v]))
            at = (at + 1) & (slots - 1);
        if (slot[at] < 0)
            slot[at] = v;
        first[v] = slot[at];
    }
    MeMemoryGive(slot);
    return METRUE;
}

/* ---- bad triangles ----------------------------------------------------------------------------------------------- */

/* The numbers of triangles that are left out, by the reason. */
typedef struct LeftOut {
    int noVertex, notFinite, noArea;
} LeftOut;

/* Writes the welded numbers of a triangle's corners. False, counted, if it has no good corners. */
static MeBool weldTriangle(const McdMeshInput *in, const int *first, int triangle, int out[3], LeftOut *leftOut) {
    const int *v = in->index + 3 * (size_t)triangle;
    for (int k = 0; k < 3; k++)
        if (v[k] < 0 || v[k] >= in->vertexCount) {
            leftOut->noVertex++;
            return MEFALSE;
        }
    for (int k = 0; k < 3; k++)
        out[k] = first[v[k]];
    if (out[0] >= 0 && out[1] >= 0 && out[2] >= 0)
        return METRUE;
    leftOut->notFinite++;
    return MEFALSE;
}

static MeBool hasArea(const McdMeshInput *in, const int v[3]) {
    double corner[3][3], normal[3];
    for (int k = 0; k < 3; k++)
        mcd_fromReal(corner[k], in->vertex[v[k]]);
    return mcd_triangleNormal(mcd_constRows(corner), 0, normal);
}

/* Welds all triangles. One without good corners becomes a point at some good vertex, which touches nothing. Returns the
 * number of triangles with an area. */
static int weldTriangles(const McdMeshInput *in, const int *first, int *index, LeftOut *leftOut) {
    int some = 0, good = 0;
    while (some < in->vertexCount && first[some] < 0)
        some++;
    for (int i = 0; some < in->vertexCount && i < in->triangleCount; i++) {
        int *v = index + 3 * (size_t)i;
        if (!weldTriangle(in, first, i, v, leftOut))
            v[0] = v[1] = v[2] = some;
        else if (hasArea(in, v))
            good++;
        else
            leftOut->noArea++;
    }
    return good;
}

static void warnOfLeftOut(const McdMeshInput *in, int good, const LeftOut *leftOut, const char *function) {
    if (good < in->triangleCount)
        MeWarning(good ? 2 : 1,
                  "%s: %d of %d triangles are left out: %d name a vertex that is none, %d have one that is not finite, "
                  "%d have no area",
                  function, in->triangleCount - good, in->triangleCount, leftOut->noVertex, leftOut->notFinite,
                  leftOut->noArea);
}

/* ---- life -------------------------------------------------------------------------------------------------------- */

/* Allocates the arrays, and copies what is not borrowed. */
static MeBool allocateArrays(McdMeshData *data, const McdMeshInput *in, const char *function) {
    const size_t vertices = (size_t)in->vertexCount, triangles = (size_t)in->triangleCount;
    data->index = MeMemoryTake(3 * triangles, sizeof *data->index, function, "triangles");
    data->patch = MeMemoryTake(triangles, sizeof *data->patch, function, "flat patches");
    if (!data->index || !data->patch)
        return MEFALSE;
    data->triangles = (McdBvhTriangles){in->vertex, data->index, in->vertexCount, in->triangleCount};
    if (in->material) {
        data->material = MeMemoryTake(triangles, sizeof *data->material, function, "materials");
        if (!data->material)
            return MEFALSE;
        memcpy(data->material, in->material, triangles * sizeof *data->material);
    }
    if (in->flags & kMcdMeshBorrowVertices)
        return METRUE;
    data->own = MeMemoryTake(vertices, sizeof *data->own, function, "vertices");
    if (!data->own)
        return MEFALSE;
    memcpy(data->own, in->vertex, vertices * sizeof *data->own);
    data->triangles.vertex = (const MeVector3 *)data->own;
    return METRUE;
}

/* Returns the number of good triangles; 0 also if there is no memory. */
static int weld(McdMeshData *data, const McdMeshInput *in, const char *function) {
    LeftOut leftOut = {0, 0, 0};
    int good = 0, *first = MeMemoryTake((size_t)in->vertexCount, sizeof *first, function, "welding");
    if (first && findFirsts(in, first, function)) {
        good = weldTriangles(in, first, data->index, &leftOut);
        warnOfLeftOut(in, good, &leftOut, function);
    }
    MeMemoryGive(first);
    data->leftOut = in->triangleCount - good;
    return good;
}

/* Finds patches; false, after a fatal error, if there is no memory. */
static MeBool findPatches(McdMeshData *data, const char *function) {
    int *stack = MeMemoryTake((size_t)data->triangles.count, sizeof *stack, function, "flat patches");
    if (stack)
        mcd_meshDataFindPatches(data, stack);
    MeMemoryGive(stack);
    return stack != 0;
}

static MeBool makeTree(McdMeshData *data, const char *function) {
    data->bvh = mcd_bvhCreate(&data->triangles);
    if (!data->bvh)
        MeFatalError(1, "%s: no memory for a tree of %d triangles", function, data->triangles.count);
    return data->bvh != 0;
}

McdMeshData *mcd_meshDataCreate(const McdMeshInput *in, const char *function) {
    McdMeshData *data = MeMemoryTakeZeroed(1, sizeof *data, function, "a mesh");
    if (!data)
        return 0;
    data->references = 1;
    data->flags = in->flags;
    if (allocateArrays(data, in, function) && weld(data, in, function) && mcd_meshDataFindNeighbours(data, function) &&
        findPatches(data, function) && makeTree(data, function))
        return data;
    mcd_meshDataRelease(data);
    return 0;
}

void mcd_meshDataRelease(McdMeshData *data) {
    MEASSERT(data->references > 0);
    if (--data->references > 0)
        return;
    if (data->bvh)
        mcd_bvhDestroy(data->bvh);
    MeMemoryGive(data->own);
    MeMemoryGive(data->index);
    MeMemoryGive(data->material);
    MeMemoryGive(data->neighbour);
    MeMemoryGive(data->patch);
    MeMemoryGive(data);
}

void mcd_meshDataSetVertices(McdMeshData *data, const MeVector3 *vertices) {
    if (data->own)
        memmove(data->own, vertices, (size_t)data->triangles.vertexCount * sizeof *vertices);
    else
        data->triangles.vertex = vertices;
}

void mcd_meshDataRefit(McdMeshData *data, const char *function) {
    mcd_bvhRefit(data->bvh, &data->triangles);
    if (!findPatches(data, function))
        memset(data->patch, -1, (size_t)data->triangles.count * sizeof *data->patch); /* all at a border: slower */
}

/* ---- triangles --------------------------------------------------------------------------------------------------- */

void mcd_meshDataCorners(const McdMeshData *data, int triangle, const MeReal scale[3], double corner[3][3]) {
    const McdBvhTriangles *t = &data->triangles;
    MEASSERT(triangle >= 0 && triangle < t->count);
    for (int k = 0; k < 3; k++) {
        const MeReal *v = t->vertex[t->index[3 * (size_t)triangle + (size_t)k]];
        for (int i = 0; i < 3; i++)
            corner[k][i] = (double)v[i] * (double)scale[i];
    }
}

MeBool mcd_meshDataIsPoint(const McdMeshData *data, int triangle) {
    const int *v = data->index + 3 * (size_t)triangle;
    return v[0] == v[1] && v[1] == v[2];
}

/* The border is the sum of all directed edges, where opposite ones cancel: the sum of their 64-bit hashes is zero. */
MeBool mcd_meshDataIsClosed(const McdMeshData *data) {
    const McdBvhTriangles *t = &data->triangles;
    MeU64 sum = 0;
    for (int i = 0; i < t->count; i++)
        for (int k = 0; k < 3; k++) {
            const MeU32 from = (MeU32)t->index[3 * (size_t)i + (size_t)k];
            const MeU32 to = (MeU32)t->index[3 * (size_t)i + (size_t)((k + 1) % 3)];
            const MeU32 low = MeMIN(from, to), high = MeMAX(from, to);
            const MeU64 hash = (MeU64)mcd_meshHash(low, high) << 32 | mcd_meshHash(high, ~low);
            sum += from == to ? 0 : from < to ? hash : 0 - hash;
        }
    return sum == 0;
}
