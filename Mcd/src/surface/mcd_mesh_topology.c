/* The admissible normals of a surface of triangles: adjacency by vertices, and the Voronoi regions of edges and
 * corners. */
#include "surface/mcd_mesh_stages_i.h"
#include <string.h>

enum { NOT_KNOWN, CLOSED, OPEN }; /* values of McdMesh.fan */

/* ---- adjacency --------------------------------------------------------------------------------------------------- */

static MeBool arePointsEqual(const double a[3], const double b[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Gives corners with equal coordinates the same vertex number, in the order of their occurrence, by a hash table
 * with open addressing, at most half full. Returns the number of vertices. */
static int numberCorners(McdMesh *mesh) {
    int slots = 1, vertexCount = 0;
    while (slots < 6 * mesh->count)
        slots *= 2;
    MEASSERT(slots <= 12 * mesh->max);
    for (int i = 0; i < slots; i++)
        mesh->slot[i] = -1;
    for (int corner = 0; corner < 3 * mesh->count; corner++) {
        McdMeshTriangle *t = &mesh->triangle[corner / 3];
        int *slot = &mesh->slot[t->key[corner % 3] & ((MeU32)slots - 1)];
        while (*slot >= 0 && !arePointsEqual(mesh->place[mesh->cornerOf[*slot]], mesh->place[corner]))
            slot = slot + 1 < mesh->slot + slots ? slot + 1 : mesh->slot;
        if (*slot < 0) {
            mesh->cornerOf[vertexCount] = corner;
            *slot = vertexCount++;
        }
        t->vertex[corner % 3] = *slot;
    }
    return vertexCount;
}

/* For checks: each vertex lists exactly the triangles that have it, ascending, all with the same coordinates there. */
static MeBool isAdjacencyGood(const McdMesh *mesh, int vertexCount) {
    for (int v = 0; v < vertexCount; v++) {
        const double *place = 0;
        for (int i = mesh->firstOf[v]; i < mesh->firstOf[v + 1]; i++) {
            const int triangle = mesh->usersOf[i], *of = mesh->triangle[triangle].vertex;
            const int at = of[0] == v ? 0 : of[1] == v ? 1 : 2;
            if (of[at] != v || (place && mesh->usersOf[i - 1] > triangle) ||
                (place && !arePointsEqual(mesh->place[3 * triangle + at], place)))
                return MEFALSE;
            place = mesh->place[3 * triangle + at];
        }
    }
    return METRUE;
}

static void setKeys(McdMesh *mesh) {
    for (int i = 0; i < 3 * mesh->count; i++)
        mesh->triangle[i / 3].key[i % 3] = mcd_meshHashOfPoint(mesh->place[i]);
}

void mcd_meshBuildAdjacency(McdMesh *mesh) {
    setKeys(mesh);
    const int vertexCount = mesh->vertexCount ? mesh->vertexCount : numberCorners(mesh);
    for (int v = 0; v <= vertexCount; v++)
        mesh->firstOf[v] = 0;
    for (int i = 0; i < 3 * mesh->count; i++)
        mesh->firstOf[mesh->triangle[i / 3].vertex[i % 3]]++;
    for (int v = 1; v <= vertexCount; v++) /* the end of each list; filling moves it to the beginning */
        mesh->firstOf[v] += mesh->firstOf[v - 1];
    for (int i = 3 * mesh->count - 1; i >= 0; i--)
        mesh->usersOf[--mesh->firstOf[mesh->triangle[i / 3].vertex[i % 3]]] = i / 3;
    for (int v = 0; v < vertexCount; v++)
        mesh->fan[v] = NOT_KNOWN;
    MEASSERT(vertexCount <= 3 * mesh->max && mesh->firstOf[0] == 0 && mesh->firstOf[vertexCount] == 3 * mesh->count);
    MEVALIDATE(isAdjacencyGood(mesh, vertexCount));
}

/* ---- Voronoi regions --------------------------------------------------------------------------------------------- */

int mcd_meshFarthestCorners(const McdMeshTriangle *t, const double direction[3]) {
    /* Heights count as equal if they differ by less than this fraction of the corners' distance. */
    static const double sameHeight = 1e-5;
    double height[3], max = -INFINITY;
    int mask = 0, top = 0;
    for (int i = 0; i < 3; i++) {
        height[i] = mcd_dot(t->corner[i], direction);
        if (height[i] > max) {
            max = height[i];
            top = i;
        }
    }
    for (int i = 0; i < 3; i++)
        if (max - height[i] <= sameHeight * sqrt(mcd_distanceSquared(t->corner[i], t->corner[top])))
            mask |= 1 << i;
    MEASSERT(mask & 1 << top);
    return mask;
}

MeBool mcd_meshHasVertex(const McdMeshTriangle *t, int v) {
    return t->vertex[0] == v || t->vertex[1] == v || t->vertex[2] == v;
}

/* Whether the triangle rises above the plane through its vertex v or, unless end is -1, through its edge from v to
 * end. */
static MeBool risesAbovePlane(const McdMeshTriangle *t, int v, int end, const double normal[3]) {
    int at = 0;
    while (t->vertex[at] != v)
        at++;
    MEASSERT(at < 3); /* the vertex is one of the triangle's */
    for (int k = 1; k < 3; k++) {
        const int far = (at + k) % 3, third = (at + 3 - k) % 3;
        double d[3];
        if (t->vertex[far] == end)
            continue;
        mcd_sub(d, t->corner[far], t->corner[at]);
        if (end >= 0) { /* the component orthogonal to the edge */
            double e[3];
            mcd_sub(e, t->corner[third], t->corner[at]);
            mcd_mad(d, d, -mcd_dot(d, e) / mcd_dot(e, e), e);
        }
        if (mcd_dot(d, normal) > MCD_MESH_RISES * mcd_length(d))
            return METRUE;
    }
    return MEFALSE;
}

/* The region of a normal at the triangle's corner v or, unless end is -1, at its edge from v to end. */
static McdMeshRegion regionAtBorder(const McdMesh *mesh, const McdMeshTriangle *t, int v, int end, MeBool isSharp,
                                    const double normal[3]) {
    MeBool hasNeighbour = MEFALSE;
    for (int i = mesh->firstOf[v]; i < mesh->firstOf[v + 1]; i++) {
        const McdMeshTriangle *neighbour = &mesh->triangle[mesh->usersOf[i]];
        if (neighbour == t || (end >= 0 && !mcd_meshHasVertex(neighbour, end)))
            continue;
        hasNeighbour = METRUE;
        if (risesAbovePlane(neighbour, v, end, normal))
            return MCD_INTERNAL_REGION;
    }
    return isSharp ? MCD_BORDER_REGION : hasNeighbour ? MCD_INTERNAL_REGION : MCD_FLAT_BORDER;
}

/* Whether the edge, or the corner if from == to, is within the query's box and ball. Outside of these, neighbours
 * may be missing. */
static MeBool isWithinQuery(const McdMeshQuery *q, const McdMeshTriangle *t, int from, int to) {
    const double(*place)[3] = (const double(*)[3]) & q->mesh->place[3 * (t - q->mesh->triangle)];
    double along[3], offset[3];
    for (int i = 0; i < 3; i++)
        if (fmin(place[from][i], place[to][i]) > q->high[i] || fmax(place[from][i], place[to][i]) < q->low[i])
            return MEFALSE;
    mcd_sub(along, place[to], place[from]);
    mcd_sub(offset, q->ball, place[from]);
    const double square = mcd_dot(along, along);
    if (square > 0)
        mcd_mad(offset, offset, -MeCLAMP(mcd_dot(offset, along) / square, 0, 1), along);
    return mcd_dot(offset, offset) <= q->ballRadius * q->ballRadius;
}

/* The triangle's farthest corners along the normal determine its feature: one a corner, two an edge, three the face. */
McdMeshRegion mcd_meshRegion(const McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3]) {
    const int mask = mcd_meshFarthestCorners(t, normal);
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3, last = (i + 2) % 3;
        const MeBool isEdge = mask == (1 << i | 1 << next), isCorner = mask == 1 << i;
        const MeBool isSharp = (t->flags & kMcdTriangleUseEdge0 << i) != 0;
        const MeBool isLastSharp = (t->flags & kMcdTriangleUseEdge0 << last) != 0;
        if (!isEdge && !isCorner)
            continue;
        if (!isWithinQuery(q, t, i, isEdge ? next : i))
            return MCD_INTERNAL_REGION;
        return regionAtBorder(q->mesh, t, t->vertex[i], isEdge ? t->vertex[next] : -1,
                              isSharp && (isEdge || isLastSharp), normal);
    }
    return MCD_FACE_REGION;
}

/* ---- flat surroundings ------------------------------------------------------------------------------------------- */

/* Whether the triangle has a coplanar neighbour across its edge from one vertex to the other, with the opposite
 * half-edge. */
static MeBool hasCoplanarNeighbour(const McdMesh *mesh, const McdMeshTriangle *t, int from, int to) {
    for (int i = mesh->firstOf[from]; i < mesh->firstOf[from + 1]; i++) {
        const McdMeshTriangle *n = &mesh->triangle[mesh->usersOf[i]];
        const int *v = n->vertex;
        const MeBool hasOpposite =
            (v[0] == to && v[1] == from) || (v[1] == to && v[2] == from) || (v[2] == to && v[0] == from);
        if (n != t && hasOpposite && mcd_meshAreParallel(n->normal, t->normal))
            return METRUE;
    }
    return MEFALSE;
}

/* Whether coplanar triangles form a closed fan around the vertex. */
static MeBool isFanClosed(const McdMesh *mesh, int v) {
    const McdMeshTriangle *first = &mesh->triangle[mesh->usersOf[mesh->firstOf[v]]];
    for (int i = mesh->firstOf[v]; i < mesh->firstOf[v + 1]; i++) {
        const McdMeshTriangle *t = &mesh->triangle[mesh->usersOf[i]];
        if (!mcd_meshAreParallel(t->normal, first->normal))
            return MEFALSE;
        for (int k = 0; k < 3; k++) {
            const int from = t->vertex[k], to = t->vertex[(k + 1) % 3];
            if ((from == v || to == v) && !hasCoplanarNeighbour(mesh, t, from, to))
                return MEFALSE;
        }
    }
    return METRUE;
}

static MeBool isVertexFlat(McdMesh *mesh, int v) {
    if (mesh->fan[v] == NOT_KNOWN)
        mesh->fan[v] = isFanClosed(mesh, v) ? CLOSED : OPEN;
    return mesh->fan[v] == CLOSED;
}

MeBool mcd_meshHasOnlyFaceNormal(const McdMeshQuery *q, const McdMeshTriangle *t) {
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3, v = t->vertex[i], end = t->vertex[next];
        if (isVertexFlat(q->mesh, v))
            continue;
        if (isWithinQuery(q, t, i, i))
            return MEFALSE;
        if (!isVertexFlat(q->mesh, end) && isWithinQuery(q, t, i, next) && !hasCoplanarNeighbour(q->mesh, t, v, end))
            return MEFALSE;
    }
    return METRUE;
}
