/* Flat parts of an indexed mesh: neighbours across edges, and patches of triangles that lie in one plane.
 *
 * A shape that is near triangles of one patch only, none at the patch's border, is near a plane: no border or fold can
 * be within the query's box, since it would belong to a triangle there. */
#include "convex/mcd_vector_i.h"
#include "surface/mcd_mesh_data_i.h"
#include "surface/mcd_mesh_stages_i.h"
#include <float.h>
#include <limits.h>
#include <string.h>

/* ---- neighbours -------------------------------------------------------------------------------------------------- */

/* The directed edges by the vertex at which they begin: edge 3 i + k is that of triangle i from its corner k. Those of
 * vertex v are edge[first[v] .. first[v + 1] - 1]. */
typedef struct Edges {
    int *first, *edge;
} Edges;

static MeBool sortEdges(const McdBvhTriangles *t, Edges *e, const char *function) {
    const int count = 3 * t->count;
    e->first = MeMemoryTakeZeroed((size_t)t->vertexCount + 1, sizeof *e->first, function, "neighbours");
    e->edge = MeMemoryTake((size_t)count, sizeof *e->edge, function, "neighbours");
    if (!e->first || !e->edge)
        return MEFALSE;
    for (int i = 0; i < count; i++)
        e->first[t->index[i]]++;
    for (int v = 1; v <= t->vertexCount; v++) /* the end of each list; filling moves it to the beginning */
        e->first[v] += e->first[v - 1];
    for (int i = count - 1; i >= 0; i--)
        e->edge[--e->first[t->index[i]]] = i;
    return METRUE;
}

static int endOf(const McdBvhTriangles *t, int edge) {
    return t->index[edge % 3 == 2 ? edge - 2 : edge + 1];
}

/* The only edge from one vertex to another; -1: there is none, or several. */
static int onlyEdge(const McdBvhTriangles *t, const Edges *e, int from, int to) {
    int only = -1;
    for (int i = e->first[from]; i < e->first[from + 1]; i++) {
        if (endOf(t, e->edge[i]) != to)
            continue;
        if (only >= 0)
            return -1;
        only = e->edge[i];
    }
    return only;
}

MeBool mcd_meshDataFindNeighbours(McdMeshData *data, const char *function) {
    const McdBvhTriangles *t = &data->triangles;
    Edges e = {0, 0};
    data->neighbour = MeMemoryTake(3 * (size_t)t->count, sizeof *data->neighbour, function, "neighbours");
    const MeBool isSorted = data->neighbour && sortEdges(t, &e, function);
    if (isSorted)
        memset(data->neighbour, -1, 3 * (size_t)t->count * sizeof *data->neighbour);
    for (int i = 0; isSorted && i < 3 * t->count; i++) {
        const int from = t->index[i], to = endOf(t, i), opposite = from < to ? onlyEdge(t, &e, to, from) : -1;
        if (opposite < 0 || onlyEdge(t, &e, from, to) != i)
            continue;
        data->neighbour[i] = opposite / 3;
        data->neighbour[opposite] = i / 3;
    }
    MeMemoryGive(e.first);
    MeMemoryGive(e.edge);
    return isSorted;
}

/* ---- patches ----------------------------------------------------------------------------------------------------- */

/* Values of McdMeshData.patch: p >= 0 inside of patch p, ~p at its border. */
enum { NO_AREA = INT_MIN, NOT_KNOWN = INT_MIN + 1 };

static int patchOf(int value) {
    return value < 0 ? ~value : value;
}

typedef struct Plane {
    double normal[3], offset, size; /* size: a sum of absolute values, for rounding */
} Plane;

static const MeReal one[3] = {1, 1, 1};

static MeBool planeOf(const McdMeshData *data, int triangle, Plane *plane) {
    double corner[3][3];
    mcd_meshDataCorners(data, triangle, one, corner);
    if (!mcd_triangleNormal(mcd_constRows(corner), 0, plane->normal))
        return MEFALSE;
    plane->offset = mcd_dot(plane->normal, corner[0]);
    plane->size = 0;
    for (int i = 0; i < 3; i++)
        plane->size += fabs(plane->normal[i] * corner[0][i]);
    return METRUE;
}

/* Whether the triangle lies in the plane, up to the rounding of its corners' heights, and faces the same way. */
static MeBool liesIn(const McdMeshData *data, int triangle, const Plane *plane) {
    double corner[3][3], normal[3];
    mcd_meshDataCorners(data, triangle, one, corner);
    for (int k = 0; k < 3; k++) {
        double height = -plane->offset, size = plane->size;
        for (int i = 0; i < 3; i++) {
            height += plane->normal[i] * corner[k][i];
            size += fabs(plane->normal[i] * corner[k][i]);
        }
        if (!(fabs(height) <= 8 * DBL_EPSILON * size))
            return MEFALSE;
    }
    return mcd_triangleNormal(mcd_constRows(corner), 0, normal) && mcd_dot(normal, plane->normal) > 0;
}

/* Gives the triangles that lie in a triangle's plane, and are connected with it, its number as patch. */
static void growPatch(McdMeshData *data, int seed, int *stack) {
    Plane plane;
    int count = 0;
    if (!planeOf(data, seed, &plane)) {
        data->patch[seed] = NO_AREA;
        return;
    }
    data->patch[seed] = seed;
    stack[count++] = seed;
    while (count) {
        const int *neighbour = &data->neighbour[3 * (size_t)stack[--count]];
        for (int k = 0; k < 3; k++)
            if (neighbour[k] >= 0 && data->patch[neighbour[k]] == NOT_KNOWN && liesIn(data, neighbour[k], &plane)) {
                data->patch[neighbour[k]] = seed;
                stack[count++] = neighbour[k];
                MEASSERT(count <= data->triangles.count);
            }
    }
}

static MeBool isInside(const McdMeshData *data, int triangle) {
    for (int k = 0; k < 3; k++) {
        const int n = data->neighbour[3 * (size_t)triangle + (size_t)k];
        if (n < 0 || data->patch[n] == NO_AREA || patchOf(data->patch[n]) != patchOf(data->patch[triangle]))
            return MEFALSE;
    }
    return METRUE;
}

void mcd_meshDataFindPatches(McdMeshData *data, int *stack) {
    const int count = data->triangles.count;
    for (int i = 0; i < count; i++)
        data->patch[i] = NOT_KNOWN;
    for (int i = 0; i < count; i++)
        if (data->patch[i] == NOT_KNOWN)
            growPatch(data, i, stack);
    for (int i = 0; i < count; i++)
        if (data->patch[i] >= 0 && !isInside(data, i))
            data->patch[i] = ~data->patch[i];
}

/* ---- the patch of some triangles --------------------------------------------------------------------------------- */

int mcd_meshDataPatchOf(const McdMeshData *data, const int *triangle, int count) {
    int last = -1;
    for (int i = 0; i < count; i++) {
        const int patch = data->patch[triangle[i]];
        if (patch == NO_AREA)
            continue;
        if (patch < 0 || (last >= 0 && data->patch[last] != patch))
            return -1;
        last = triangle[i];
    }
    return last;
}
