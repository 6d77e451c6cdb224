/* Contacts of a convex shape with a surface of triangles, without ghost contacts at internal edges. */
#include "mcd_mesh_i.h"
#include "mcd_nearfield_i.h"
#include "mcd_scratch_i.h"
#include "mcd_spread_i.h"
#include <string.h>

/* Directions that differ by less (rad) are one. */
#define SAME_DIRECTION 1e-4
/* A neighbour rises above a plane if its angle (rad) with it is larger; much smaller than SAME_DIRECTION, so that a
 * normal which is no face's is noticed. */
#define RISES 1e-6
/* Corners whose heights over a plane differ by a smaller part of their distance are equally high. */
#define SAME_HEIGHT 1e-5
/* How far beside a border the surface is looked for, relative to the shape's extent. */
#define BESIDE 1e-5
/* What is over a triangle, relative to the shape's extent: neighbours overlap by that, so that nothing slips
 * between. */
#define OVER 1e-9
/* Normals within this cosine of each other make one manifold: 1.1 degrees. */
#define SAME_MANIFOLD .9998

enum { NOT_KNOWN, CLOSED, OPEN }; /* McdMesh.fan */

/* ---- memory ------------------------------------------------------------------------------------------------------ */

void mcd_meshFree(McdMesh *mesh) {
    void *block[] = {mesh->triangle,     mesh->place, mesh->slot,    mesh->cornerOf, mesh->firstOf,
                     mesh->usersOf,      mesh->fan,   mesh->contact, mesh->cluster,  mesh->merged,
                     mesh->contactOrder, mesh->spots, mesh->kept};
    for (size_t i = 0; i < sizeof block / sizeof *block; i++)
        MeMemoryGive(block[i]);
    memset(mesh, 0, sizeof *mesh);
}

#define GROW(pointer, used, count)                                                                                     \
    MeMemoryGrow(&(pointer), (size_t)(used), (size_t)(count), sizeof *(pointer), "McdIntersect",                       \
                 "triangles and contacts")

MeBool mcd_meshReserve(McdMesh *mesh, int triangles) {
    if (triangles <= mesh->max)
        return METRUE;
    const int n = mesh->count, max = MeMAX(triangles, 2 * mesh->max);
    if (!GROW(mesh->triangle, n, max) || !GROW(mesh->place, 3 * n, 3 * max) || !GROW(mesh->cornerOf, 0, 3 * max) ||
        !GROW(mesh->firstOf, 0, 3 * max + 1) || !GROW(mesh->usersOf, 0, 3 * max) || !GROW(mesh->fan, 0, 3 * max) ||
        !GROW(mesh->slot, 0, 12 * max))
        return MEFALSE;
    mesh->max = max;
    return METRUE;
}

static MeBool reserveContacts(McdMesh *mesh, int contacts) {
    if (contacts <= mesh->contactMax)
        return METRUE;
    const int n = mesh->contactCount, max = MeMAX(contacts, 2 * mesh->contactMax + 64);
    McdSpot *spots = mesh->spots;
    if (!GROW(mesh->contact, n, max) || !GROW(mesh->cluster, 0, max) || !GROW(mesh->merged, 0, max) ||
        !GROW(mesh->contactOrder, 0, max) || !GROW(spots, 0, max))
        return MEFALSE;
    mesh->spots = spots;
    if (!GROW(mesh->kept, 0, max))
        return MEFALSE;
    mesh->contactMax = max;
    return METRUE;
}

/* ---- order ------------------------------------------------------------------------------------------------------- */

typedef int (*Compare)(const McdMesh *mesh, int a, int b);

static void siftDown(const McdMesh *mesh, Compare compare, int *index, int root, int end) {
    for (int child = 2 * root + 1; child < end; root = child, child = 2 * root + 1) {
        if (child + 1 < end && compare(mesh, index[child], index[child + 1]) < 0)
            child++;
        if (compare(mesh, index[root], index[child]) >= 0)
            return;
        const int swap = index[root];
        index[root] = index[child];
        index[child] = swap;
    }
}

/* By a heap: qsort may allocate. */
static void sortIndices(const McdMesh *mesh, Compare compare, int *index, int count) {
    for (int i = count / 2 - 1; i >= 0; i--)
        siftDown(mesh, compare, index, i, count);
    for (int end = count - 1; end > 0; end--) {
        const int swap = index[0];
        index[0] = index[end];
        index[end] = swap;
        siftDown(mesh, compare, index, 0, end);
    }
}

static int comparePoints(const double a[3], const double b[3]) {
    for (int i = 0; i < 3; i++)
        if (a[i] != b[i])
            return a[i] < b[i] ? -1 : 1;
    return 0;
}

static int compareContacts(const McdMesh *mesh, int a, int b) {
    const McdMeshContact *x = &mesh->contact[a], *y = &mesh->contact[b];
    if (x->isCut != y->isCut)
        return x->isCut - y->isCut;
    if (x->feature != y->feature)
        return x->feature < y->feature ? -1 : 1;
    const int order = comparePoints(x->position, y->position);
    return order ? order : a - b;
}

/* ---- triangles --------------------------------------------------------------------------------------------------- */

static MeU32 mix(MeU32 a, MeU32 b) {
    MeU32 h = a * 0x9e3779b1u ^ (b + 0x85ebca6bu + (a << 6) + (a >> 2));
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    return h ^ h >> 13;
}

static MeU32 keyOf(const double place[3]) {
    MeU32 key = 1;
    for (int i = 0; i < 3; i++) {
        const double value = place[i] + 0.0; /* -0 is 0 */
        MeU32 half[2];
        memcpy(half, &value, sizeof value);
        key = mix(mix(key, half[0]), half[1]);
    }
    return key;
}

static MeBool isNearBox(const McdMeshQuery *q, const double corner[3][3]) {
    for (int i = 0; i < 3; i++) {
        const double low = fmin(corner[0][i], fmin(corner[1][i], corner[2][i]));
        const double high = fmax(corner[0][i], fmax(corner[1][i], corner[2][i]));
        if (!(low <= q->high[i] && high >= q->low[i]))
            return MEFALSE;
    }
    return METRUE;
}

static void toQuery(const McdMeshQuery *q, const double in[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = q->place[i] + in[0] * q->axis[0][i] + in[1] * q->axis[1][i] + in[2] * q->axis[2][i];
}

void mcd_meshAdd(McdMeshQuery *q, const double corner[3][3], const double *normal, int flags, const int *vertex,
                 McdElementData element) {
    McdMesh *mesh = q->mesh;
    double own[3];
    if (!mcd_triangleNormal(corner, normal, own)) {
        mesh->skipped++;
        return;
    }
    if (!isNearBox(q, corner) || !mcd_meshReserve(mesh, mesh->count + 1))
        return;
    McdMeshTriangle *t = &mesh->triangle[mesh->count];
    for (int i = 0; i < 3; i++) {
        t->normal[i] = own[0] * q->axis[0][i] + own[1] * q->axis[1][i] + own[2] * q->axis[2][i];
        mcd_copy(mesh->place[3 * mesh->count + i], corner[i]);
        toQuery(q, corner[i], t->corner[i]);
        t->key[i] = keyOf(corner[i]);
    }
    if (vertex)
        memcpy(t->vertex, vertex, sizeof t->vertex);
    t->flags = flags;
    t->element = element;
    mesh->count++;
    MEASSERT(mesh->count <= mesh->max && isfinite(mcd_dot(t->normal, t->normal)));
    MEASSERT(mcd_isUnit(own));
}

/* A power of 2 that leaves half of the slots empty. */
static int slotCount(const McdMesh *mesh) {
    int count = 1;
    while (count < 6 * mesh->count)
        count *= 2;
    return count;
}

/* The number of the vertex at a corner, a new one if there is none yet: -1 is an empty slot. */
static int vertexAt(McdMesh *mesh, int slots, int corner, int *vertexCount) {
    const MeU32 mask = (MeU32)slots - 1;
    MeU32 at = mesh->triangle[corner / 3].key[corner % 3] & mask;
    for (; mesh->slot[at] >= 0; at = (at + 1) & mask)
        if (comparePoints(mesh->place[mesh->cornerOf[mesh->slot[at]]], mesh->place[corner]) == 0)
            return mesh->slot[at];
    mesh->cornerOf[*vertexCount] = corner;
    return mesh->slot[at] = (*vertexCount)++;
}

/* Numbers the corners in the order in which they come. Returns how many vertices there are. */
static int numberCorners(McdMesh *mesh) {
    const int slots = slotCount(mesh);
    int vertexCount = 0;
    for (int i = 0; i < slots; i++)
        mesh->slot[i] = -1;
    for (int i = 0; i < 3 * mesh->count; i++)
        mesh->triangle[i / 3].vertex[i % 3] = vertexAt(mesh, slots, i, &vertexCount);
    return vertexCount;
}

/* Where the first triangle of a vertex has it. */
static const double *placeOf(const McdMesh *mesh, int v) {
    const int first = mesh->usersOf[mesh->firstOf[v]], *of = mesh->triangle[first].vertex;
    return mesh->place[3 * first + (of[0] == v ? 0 : of[1] == v ? 1 : 2)];
}

/* Adjacency is symmetric: a vertex lists just the triangles that have it, in their order, and is where their
 * corners are. */
static MeBool areCornersJoined(const McdMesh *mesh, int vertexCount) {
    for (int v = 0; v < vertexCount; v++)
        for (int i = mesh->firstOf[v]; i < mesh->firstOf[v + 1]; i++) {
            const int *of = mesh->triangle[mesh->usersOf[i]].vertex, at = of[0] == v ? 0 : of[1] == v ? 1 : 2;
            if (of[at] != v || (i > mesh->firstOf[v] && mesh->usersOf[i - 1] > mesh->usersOf[i]) ||
                comparePoints(mesh->place[3 * mesh->usersOf[i] + at], placeOf(mesh, v)) != 0)
                return MEFALSE;
        }
    return METRUE;
}

/* Lists the triangles at each vertex. */
static void buildAdjacency(McdMesh *mesh) {
    const int vertexCount = mesh->vertexCount ? mesh->vertexCount : numberCorners(mesh);
    for (int v = 0; v <= vertexCount; v++)
        mesh->firstOf[v] = 0;
    for (int i = 0; i < 3 * mesh->count; i++)
        mesh->firstOf[mesh->triangle[i / 3].vertex[i % 3]]++;
    for (int v = 1; v <= vertexCount; v++) /* now where each ends; filling moves that to where it begins */
        mesh->firstOf[v] += mesh->firstOf[v - 1];
    for (int i = 3 * mesh->count - 1; i >= 0; i--)
        mesh->usersOf[--mesh->firstOf[mesh->triangle[i / 3].vertex[i % 3]]] = i / 3;
    MEASSERT(vertexCount <= 3 * mesh->max && mesh->firstOf[0] == 0 && mesh->firstOf[vertexCount] == 3 * mesh->count);
    for (int v = 0; v < vertexCount; v++)
        mesh->fan[v] = NOT_KNOWN;
    MEVALIDATE(areCornersJoined(mesh, vertexCount));
}

/* ---- which normals are the surface's ----------------------------------------------------------------------------- */

/* Where a contact normal lies among those that the surface has around a triangle (its Voronoi regions). */
typedef enum Region {
    FACE_REGION,   /* the triangle's own normal */
    BORDER_REGION, /* between those of an edge or a corner */
    INTERNAL,      /* nowhere: a neighbour rises above the plane across the normal, as at internal edges */
    FLAT_BORDER    /* at an open border whose flags leave only the face's normal */
} Region;

/* The corners that are farthest in the direction, to within the tolerance: a sum of 1, 2, 4. */
static int farthestCorners(const McdMeshTriangle *t, const double direction[3]) {
    double height[3], most = -INFINITY;
    int mask = 0, top = 0;
    for (int i = 0; i < 3; i++) {
        height[i] = mcd_dot(t->corner[i], direction);
        if (height[i] > most) {
            most = height[i];
            top = i;
        }
    }
    for (int i = 0; i < 3; i++)
        if (most - height[i] <= SAME_HEIGHT * sqrt(mcd_distanceSquared(t->corner[i], t->corner[top])))
            mask |= 1 << i;
    MEASSERT(mask & 1 << top);
    return mask;
}

/* Does the triangle rise above the plane through its vertex v (and other, if that is not -1)? */
static MeBool risesFrom(const McdMeshTriangle *t, int v, int other, const double normal[3]) {
    int at = 0;
    while (t->vertex[at] != v)
        at++;
    MEASSERT(at < 3); /* it is a triangle of that vertex */
    for (int k = 1; k < 3; k++) {
        const int far = (at + k) % 3, third = (at + 3 - k) % 3;
        double d[3];
        if (t->vertex[far] == other)
            continue;
        mcd_sub(d, t->corner[far], t->corner[at]);
        if (other >= 0) { /* straight away from the edge */
            double e[3];
            mcd_sub(e, t->corner[third], t->corner[at]);
            mcd_mad(d, d, -mcd_dot(d, e) / mcd_dot(e, e), e);
        }
        if (mcd_dot(d, normal) > RISES * mcd_length(d))
            return METRUE;
    }
    return MEFALSE;
}

static MeBool hasVertex(const McdMeshTriangle *t, int v) {
    return t->vertex[0] == v || t->vertex[1] == v || t->vertex[2] == v;
}

static Region regionAtCorner(const McdMesh *mesh, const McdMeshTriangle *t, int v, int other, MeBool isSharp,
                             const double normal[3]) {
    MeBool hasNeighbour = MEFALSE;
    for (int i = mesh->firstOf[v]; i < mesh->firstOf[v + 1]; i++) {
        const McdMeshTriangle *neighbour = &mesh->triangle[mesh->usersOf[i]];
        if (neighbour == t || (other >= 0 && !hasVertex(neighbour, other)))
            continue;
        hasNeighbour = METRUE;
        if (risesFrom(neighbour, v, other, normal))
            return INTERNAL;
    }
    return isSharp ? BORDER_REGION : hasNeighbour ? INTERNAL : FLAT_BORDER;
}

static MeBool edgeIsSharp(const McdMeshTriangle *t, int edge) {
    return (t->flags & kMcdTriangleUseEdge0 << edge) != 0;
}

/* Is the edge or corner within the query's box and ball? Beyond them neighbours may be missing. */
static MeBool isWithinQuery(const McdMeshQuery *q, const McdMeshTriangle *t, int from, int to) {
    const double(*place)[3] = (const double(*)[3]) & q->mesh->place[3 * (t - q->mesh->triangle)];
    double along[3], off[3];
    for (int i = 0; i < 3; i++)
        if (fmin(place[from][i], place[to][i]) > q->high[i] || fmax(place[from][i], place[to][i]) < q->low[i])
            return MEFALSE;
    mcd_sub(along, place[to], place[from]);
    mcd_sub(off, q->ball, place[from]);
    const double square = mcd_dot(along, along);
    if (square > 0)
        mcd_mad(off, off, -MeCLAMP(mcd_dot(off, along) / square, 0, 1), along);
    return mcd_dot(off, off) <= q->ballRadius * q->ballRadius;
}

static Region regionOf(const McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3]) {
    const McdMesh *mesh = q->mesh;
    const int mask = farthestCorners(t, normal);
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3, last = (i + 2) % 3;
        if ((mask == (1 << i | 1 << next) && !isWithinQuery(q, t, i, next)) ||
            (mask == 1 << i && !isWithinQuery(q, t, i, i)))
            return INTERNAL;
        if (mask == (1 << i | 1 << next))
            return regionAtCorner(mesh, t, t->vertex[i], t->vertex[next], edgeIsSharp(t, i), normal);
        if (mask == 1 << i)
            return regionAtCorner(mesh, t, t->vertex[i], -1, edgeIsSharp(t, i) && edgeIsSharp(t, last), normal);
    }
    return FACE_REGION;
}

/* ---- flat surroundings ------------------------------------------------------------------------------------- */

static MeBool areParallel(const double a[3], const double b[3]) {
    return mcd_distanceSquared(a, b) < RISES * RISES;
}

/* Does the triangle's border run from one vertex straight to the other? */
static MeBool hasSide(const McdMeshTriangle *t, int from, int to) {
    for (int i = 0; i < 3; i++)
        if (t->vertex[i] == from && t->vertex[(i + 1) % 3] == to)
            return METRUE;
    return MEFALSE;
}

/* Has the triangle a coplanar neighbour across its edge from one vertex to the other? */
static MeBool continuesAcross(const McdMesh *mesh, const McdMeshTriangle *t, int from, int to) {
    for (int i = mesh->firstOf[from]; i < mesh->firstOf[from + 1]; i++) {
        const McdMeshTriangle *neighbour = &mesh->triangle[mesh->usersOf[i]];
        if (neighbour != t && hasSide(neighbour, to, from) && areParallel(neighbour->normal, t->normal))
            return METRUE;
    }
    return MEFALSE;
}

/* Is the vertex surrounded by coplanar triangles? */
static MeBool fanIsClosed(const McdMesh *mesh, int v) {
    const McdMeshTriangle *first = &mesh->triangle[mesh->usersOf[mesh->firstOf[v]]];
    for (int i = mesh->firstOf[v]; i < mesh->firstOf[v + 1]; i++) {
        const McdMeshTriangle *t = &mesh->triangle[mesh->usersOf[i]];
        if (!areParallel(t->normal, first->normal))
            return MEFALSE;
        for (int k = 0; k < 3; k++) {
            const int from = t->vertex[k], to = t->vertex[(k + 1) % 3];
            if ((from == v || to == v) && !continuesAcross(mesh, t, from, to))
                return MEFALSE;
        }
    }
    return METRUE;
}

static MeBool isSurrounded(McdMesh *mesh, int v) {
    if (mesh->fan[v] == NOT_KNOWN)
        mesh->fan[v] = fanIsClosed(mesh, v) ? CLOSED : OPEN;
    return mesh->fan[v] == CLOSED;
}

/* Is every other normal than the face's INTERNAL? */
static MeBool hasOnlyFaceNormal(const McdMeshQuery *q, const McdMeshTriangle *t) {
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        if (isSurrounded(q->mesh, t->vertex[i]))
            continue;
        if (isWithinQuery(q, t, i, i))
            return MEFALSE;
        if (!isSurrounded(q->mesh, t->vertex[next]) && isWithinQuery(q, t, i, next) &&
            !continuesAcross(q->mesh, t, t->vertex[i], t->vertex[next]))
            return MEFALSE;
    }
    return METRUE;
}

/* ---- contacts of one triangle ------------------------------------------------------------------------------------ */

/* Which way a normal points, roughly: tells contacts of one corner with two faces from each other. */
static MeU32 sectorOf(const double normal[3]) {
    MeU32 sector = 0;
    for (int i = 0; i < 3; i++)
        sector = 32 * sector + (MeU32)mcd_floorBetween(normal[i] * 8 + 8.5, 0, 31);
    return sector;
}

static void addContact(McdMeshQuery *q, const McdMeshTriangle *t, const double position[3], const double normal[3],
                       double separation, MeU32 feature, MeBool isCut) {
    McdMesh *mesh = q->mesh;
    if (!reserveContacts(mesh, mesh->contactCount + 1))
        return;
    McdMeshContact *c = &mesh->contact[mesh->contactCount++];
    MEASSERT(mesh->contactCount <= mesh->contactMax && separation <= q->margin + OVER * q->shape.extent);
    MEASSERT(isfinite(mcd_dot(normal, normal)) && !isnan(separation));
    mcd_copy(c->position, position);
    mcd_copy(c->normal, normal);
    c->separation = separation;
    const double out[3] = {-normal[0], -normal[1], -normal[2]};
    c->radius = mcd_surfaceRadius(&q->shape, out, position);
    c->feature = mix(feature, sectorOf(normal));
    c->element = t->element;
    c->isCut = isCut;
}

/* Of the edge or corner that is farthest along the normal; the same for all triangles that share it. */
static MeU32 featureToward(const McdMeshTriangle *t, const double normal[3]) {
    const int mask = farthestCorners(t, normal);
    MeU32 sum = 0;
    for (int i = 0; i < 3; i++)
        if (mask & 1 << i)
            sum += t->key[i];
    return sum;
}

static void addManifold(McdMeshQuery *q, const McdMeshTriangle *t, const McdManifold *m) {
    const MeU32 feature = featureToward(t, m->normal);
    for (int i = 0; i < m->count; i++)
        addContact(q, t, m->point[i].position, m->normal, m->point[i].separation,
                   mix(feature, mcd_featureNumber(m->point[i].feature)), METRUE);
}

typedef struct Polygon {
    int count;
    double point[MCD_FACE_POINTS + 4][3];
    MeU32 name[MCD_FACE_POINTS + 4];
    MeBool isCut[MCD_FACE_POINTS + 4]; /* no corner of the shape's face */
} Polygon;

static void appendPoint(Polygon *p, const double point[3], MeU32 name, MeBool isCut) {
    if (p->count == MCD_FACE_POINTS + 4)
        return;
    p->isCut[p->count] = isCut;
    mcd_copy(p->point[p->count], point);
    p->name[p->count++] = name;
}

/* Cuts off what is beyond the plane inward . x = offset; keeps points, lines and polygons what they are. */
static void cut(const Polygon *in, const double inward[3], double offset, double tolerance, MeU32 edgeName,
                Polygon *out) {
    out->count = 0;
    for (int i = 0; i < in->count; i++) {
        const int next = (i + 1) % in->count;
        const double a = mcd_dot(in->point[i], inward) - offset, b = mcd_dot(in->point[next], inward) - offset;
        if (a >= -tolerance)
            appendPoint(out, in->point[i], in->name[i], in->isCut[i]);
        if ((a >= -tolerance) == (b >= -tolerance) || (in->count == 2 && i == 1))
            continue;
        double d[3], at[3];
        mcd_sub(d, in->point[next], in->point[i]);
        mcd_mad(at, in->point[i], MeCLAMP(a / (a - b), 0, 1), d);
        appendPoint(out, at, mix(in->name[i] + in->name[next], edgeName), METRUE);
    }
    MEASSERT(out->count <= in->count + 2); /* of a convex polygon a line cuts two sides at most, but for rounding */
}

/* The unit vector across edge i, in the triangle's plane, towards its inside. */
static void inwardOf(const McdMeshTriangle *t, int i, double inward[3]) {
    double edge[3], across[3];
    mcd_sub(edge, t->corner[(i + 1) % 3], t->corner[i]);
    mcd_cross(inward, t->normal, edge);
    mcd_sub(across, t->corner[(i + 2) % 3], t->corner[i]);
    mcd_scale(inward, inward, (mcd_dot(inward, across) < 0 ? -1 : 1) / mcd_length(inward));
    MEASSERT(mcd_dot(inward, across) >= 0); /* the third corner is inside */
}

/* The part of the shape's face that looks at the triangle and is above (or below) it, seen along the normal. */
static void cutByTriangle(const McdMeshTriangle *t, double tolerance, const Polygon *p, Polygon *part) {
    Polygon a, b;
    const Polygon *from[3] = {p, &a, &b};
    Polygon *to[3] = {&a, &b, part};
    part->count = 0;
    for (int i = 0; i < 3 && from[i]->count; i++) {
        double inward[3];
        inwardOf(t, i, inward);
        cut(from[i], inward, mcd_dot(t->corner[i], inward), tolerance, t->key[i] + t->key[(i + 1) % 3], to[i]);
    }
}

/* The shape's face that looks along a direction, as a polygon. */
static void polygonToward(const McdShape *shape, const double direction[3], Polygon *p) {
    McdFace face;
    mcd_faceToward(shape, direction, &face);
    p->count = 0;
    for (int i = 0; i < face.count; i++)
        appendPoint(p, face.point[i], mix(face.id, face.name[i]), MEFALSE);
}

/* The shape's farthest point in a direction, which need not be on that face. */
static void pointToward(const McdShape *shape, const double direction[3], Polygon *p) {
    double point[3];
    mcd_coreSupport(shape, direction, point);
    p->count = 0;
    appendPoint(p, point, 0, MEFALSE);
}

/* Adds the points that are within the margin; false if there are none. *least is the least separation so far; onlyBelow
 * takes only deeper points. */
static MeBool addAlong(McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3], const Polygon *p,
                       MeBool onlyBelow, double *least) {
    MeBool any = MEFALSE;
    for (int i = 0; i < p->count; i++) {
        double off[3], at[3];
        mcd_sub(off, p->point[i], t->corner[0]);
        const double separation = mcd_dot(off, normal) - q->shape.rounding;
        if (separation > q->margin || (onlyBelow && separation >= *least - OVER * q->shape.extent))
            continue;
        mcd_mad(at, p->point[i], -(q->shape.rounding + separation / 2), normal);
        addContact(q, t, at, normal, separation, p->name[i], p->isCut[i]);
        *least = fmin(*least, separation);
        any = METRUE;
    }
    return any;
}

/* Contacts along a triangle's normal (either side's): the shape's face, clipped to the triangle grown by the
 * tolerance, and its support point. False if there are none. */
static MeBool addClippedContacts(McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3], double tolerance) {
    Polygon p, part;
    double back[3], least = INFINITY;
    mcd_scale(back, normal, -1);
    polygonToward(&q->shape, back, &p);
    cutByTriangle(t, tolerance * q->shape.extent, &p, &part);
    const MeBool any = addAlong(q, t, normal, &part, MEFALSE, &least);
    pointToward(&q->shape, back, &p);
    cutByTriangle(t, tolerance * q->shape.extent, &p, &part);
    return addAlong(q, t, normal, &part, METRUE, &least) || any;
}

/* The side on which contacts are: 1 is the normal's. */
static double sideOf(const McdMeshTriangle *t, double towards, double centreHeight) {
    if (!(t->flags & kMcdTriangleTwoSided))
        return 1;
    return (fabs(towards) > .5 ? towards : centreHeight) < 0 ? -1 : 1;
}

static double heightOfCentre(const McdMeshQuery *q, const McdMeshTriangle *t) {
    double off[3];
    mcd_sub(off, q->centre, t->corner[0]);
    return mcd_dot(off, t->normal);
}

/* From the middle of the shape's box to its farthest point in a direction of length 1, at most. */
static double reachAlong(const McdMeshQuery *q, const double direction[3]) {
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += q->half[i] * fabs(mcd_dot(q->shape.axis[i], direction));
    return sum;
}

/* Is a part of the shape's box over the triangle, or below it, or nearly? */
static MeBool isAbove(const McdMeshQuery *q, const McdMeshTriangle *t) {
    for (int i = 0; i < 3; i++) {
        double inward[3], off[3];
        inwardOf(t, i, inward);
        mcd_sub(off, q->box, t->corner[i]);
        if (mcd_dot(off, inward) + reachAlong(q, inward) < -q->margin - OVER * q->shape.extent)
            return MEFALSE;
    }
    return METRUE;
}

/* The heights over the triangle's plane between which the shape is. */
static void heightsOver(const McdMeshQuery *q, const McdMeshTriangle *t, double *low, double *high) {
    double back[3], point[3], off[3];
    mcd_scale(back, t->normal, -1);
    mcd_support(&q->shape, back, point);
    mcd_sub(off, point, t->corner[0]);
    *low = mcd_dot(off, t->normal);
    mcd_support(&q->shape, t->normal, point);
    mcd_sub(off, point, t->corner[0]);
    *high = mcd_dot(off, t->normal);
}

/* Is the triangle within the shape's box, or no farther from it than the margin? */
static MeBool isNearShape(const McdMeshQuery *q, const McdMeshTriangle *t) {
    for (int i = 0; i < 3; i++) {
        double low = INFINITY, high = -INFINITY;
        for (int k = 0; k < 3; k++) {
            double off[3];
            mcd_sub(off, t->corner[k], q->box);
            low = fmin(low, mcd_dot(off, q->shape.axis[i]));
            high = fmax(high, mcd_dot(off, q->shape.axis[i]));
        }
        const double reach = q->half[i] + q->margin + OVER * q->shape.extent;
        if (low > reach || high < -reach)
            return MEFALSE;
    }
    return METRUE;
}

static MeBool intersectsTriangle(const McdMeshQuery *q, const McdMeshTriangle *t, McdManifold *m) {
    McdShape triangle;
    if (!isNearShape(q, t))
        return MEFALSE;
    mcd_triangleShape(t->corner, &triangle);
    return mcd_convexManifold(&q->shape, &triangle, q->margin, m) > 0;
}

/* The part of the way between two points that is over the triangle, as 0 <= in <= out <= 1; false if none is. */
static MeBool clipToTriangle(const McdMeshTriangle *t, const double from[3], const double to[3], double tolerance,
                             double *in, double *out) {
    *in = 0;
    *out = 1;
    for (int i = 0; i < 3; i++) {
        double inward[3], off[3];
        inwardOf(t, i, inward);
        mcd_sub(off, from, t->corner[i]);
        const double a = mcd_dot(off, inward) + tolerance;
        mcd_sub(off, to, t->corner[i]);
        const double b = mcd_dot(off, inward) + tolerance;
        if (a < 0 && b < 0)
            return MEFALSE;
        if (a < 0)
            *in = fmax(*in, a / (a - b));
        if (b < 0)
            *out = fmin(*out, a / (a - b));
    }
    MEASSERT(*in >= 0 && *in <= 1 && *out >= 0 && *out <= 1);
    return *in <= *out;
}

static MeBool sharesBorder(const McdMeshTriangle *t, const McdMeshTriangle *other, int mask) {
    for (int i = 0; i < 3; i++)
        if (mask & 1 << i && !hasVertex(other, t->vertex[i]))
            return MEFALSE;
    return METRUE;
}

/* T-junctions: does the surface continue beside the triangle, above the plane across the normal, although no corner is
 * shared? A point a small step beyond the border, beside the contact, is looked up. */
static MeBool continuesBeside(const McdMeshQuery *q, const McdMeshTriangle *t, const McdManifold *m) {
    const McdManifoldPoint *p = &m->point[0];
    const double step = BESIDE * q->shape.extent;
    const int mask = farthestCorners(t, m->normal);
    double at[3], out[3], away = -INFINITY, in, end;
    for (int i = 1; i < m->count; i++)
        if (m->point[i].separation < p->separation)
            p = &m->point[i];
    mcd_mad(out, m->normal, -mcd_dot(m->normal, t->normal), t->normal);
    mcd_scale(out, out, 1 / mcd_length(out));
    mcd_sub(at, p->position, t->corner[0]);
    mcd_mad(at, p->position, -mcd_dot(at, t->normal), t->normal);
    for (int i = 0; i < 3; i++)
        away = fmax(away, mcd_dot(t->corner[i], out));
    mcd_mad(at, at, away - mcd_dot(at, out) + step, out);
    for (int i = 0; i < q->mesh->count; i++) {
        const McdMeshTriangle *other = &q->mesh->triangle[i];
        double off[3], d[3];
        mcd_sub(off, at, other->corner[0]);
        const double height = mcd_dot(off, other->normal);
        if (other == t || fabs(height) > step || sharesBorder(t, other, mask) ||
            !clipToTriangle(other, at, at, OVER * q->shape.extent, &in, &end))
            continue;
        mcd_scale(d, out, step);
        mcd_mad(d, d, -height, other->normal);
        if (mcd_dot(d, m->normal) > SAME_DIRECTION * step)
            return METRUE;
    }
    return MEFALSE;
}

/* Contacts along the normal that the narrow phase finds, if the surface has it there, else along the face's. False
 * if the shape does not touch the triangle. */
static MeBool addSearchedContacts(McdMeshQuery *q, McdMeshTriangle *t) {
    McdManifold m;
    if (!intersectsTriangle(q, t, &m))
        return MEFALSE;
    const double height = heightOfCentre(q, t), side = sideOf(t, mcd_dot(m.normal, t->normal), height);
    double face[3];
    mcd_scale(face, t->normal, side);
    const double towards = mcd_dot(m.normal, face);
    const MeBool shortest = (t->flags & kMcdTriangleUseSmallestPenetration) != 0;
    Region region = regionOf(q, t, m.normal);
    if ((region == BORDER_REGION || region == FLAT_BORDER) && continuesBeside(q, t, &m))
        region = INTERNAL;
    const MeBool isFace =
        mcd_distanceSquared(m.normal, face) < SAME_DIRECTION * SAME_DIRECTION || (region == FACE_REGION && towards > 0);
    if (region == FLAT_BORDER && towards < .5) /* pushed from the side, where there is nothing to push */
        return METRUE;
    const MeBool isFromBehind = !(t->flags & kMcdTriangleTwoSided) && towards < -SAME_DIRECTION;
    if (isFace || !shortest || region != BORDER_REGION || isFromBehind) {
        if (isFace || side * height >= 0)
            t->facing = (int)side;
        if (t->facing && addClippedContacts(q, t, face, OVER))
            return METRUE;
        /* a normal that is the face's to within the tolerance belongs to a point that is so far beside the face */
        if (isFace && addClippedContacts(q, t, face, SAME_DIRECTION))
            return METRUE;
        if (!isFace)
            return METRUE;
        mcd_copy(m.normal, face);
    }
    addManifold(q, t, &m);
    return METRUE;
}

/* ---- contacts along the face's normal ---------------------------------------------------------------------------- */

static MeBool areInOnePlane(const McdMeshQuery *q, const McdMeshTriangle *a, const McdMeshTriangle *b) {
    double off[3];
    if (1 - fabs(mcd_dot(a->normal, b->normal)) > RISES * RISES)
        return MEFALSE;
    mcd_sub(off, b->corner[0], a->corner[0]);
    return fabs(mcd_dot(off, a->normal)) <= RISES * q->shape.extent;
}

/* Do triangles in t's plane cover the way, and does the last of them face along that normal? */
static MeBool isPathCovered(const McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3],
                            const double from[3], const double to[3]) {
    double reached = 0, in, out;
    for (MeBool isFarther = METRUE; isFarther;) {
        isFarther = MEFALSE;
        for (int i = 0; i < q->mesh->count; i++) {
            const McdMeshTriangle *other = &q->mesh->triangle[i];
            if ((!other->facing && !other->isPending) || !areInOnePlane(q, t, other) ||
                !clipToTriangle(other, from, to, OVER * q->shape.extent, &in, &out) || in > reached)
                continue;
            if (out == 1 && other->facing * mcd_dot(other->normal, normal) > 0)
                return METRUE;
            isFarther = isFarther || out > reached;
            reached = fmax(reached, out);
        }
    }
    return MEFALSE;
}

static void pointOnSurface(const McdMeshContact *c, double foot[3]) {
    mcd_mad(foot, c->position, -c->separation / 2, c->normal);
}

/* Where the line from a contact point below the plane to the shape's highest point crosses the plane; false if all
 * of the shape is below. */
static MeBool entryThroughPlane(const McdMeshQuery *q, const McdMeshContact *c, double through[3]) {
    double foot[3], point[3], highest[3], off[3];
    pointOnSurface(c, foot);
    mcd_mad(point, c->position, c->separation / 2, c->normal);
    mcd_support(&q->shape, c->normal, highest);
    mcd_sub(off, highest, foot);
    const double height = mcd_dot(off, c->normal);
    if (height <= 0)
        return MEFALSE;
    mcd_sub(off, highest, point);
    mcd_mad(through, point, c->separation / (c->separation - height), off);
    MEASSERT(c->separation <= 0); /* between both: no division by 0 */
    return METRUE;
}

/* Does the shape touch the triangle, over or below which these contacts lie? */
static MeBool touchesAtContacts(const McdMeshQuery *q, const McdMeshTriangle *t, int first) {
    McdManifold m;
    for (int i = first; i < q->mesh->contactCount; i++) {
        const McdMeshContact *c = &q->mesh->contact[i];
        double through[3], in, out;
        if (c->separation >= 0 || (entryThroughPlane(q, c, through) &&
                                   clipToTriangle(t, through, through, OVER * q->shape.extent, &in, &out)))
            return METRUE;
    }
    return first < q->mesh->contactCount && intersectsTriangle(q, t, &m);
}

/* Contacts along the face's normal, where the neighbours leave no other. False if the shape does not touch the
 * triangle. */
static MeBool addFaceContacts(McdMeshQuery *q, const McdMeshTriangle *t) {
    const int first = q->mesh->contactCount;
    double face[3];
    mcd_scale(face, t->normal, t->facing);
    addClippedContacts(q, t, face, OVER);
    if (touchesAtContacts(q, t, first))
        return METRUE;
    q->mesh->contactCount = first;
    return MEFALSE;
}

/* The least separation of the first contacts from the triangle's plane. */
static double leastSeparationOnPlane(const McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3],
                                     int count) {
    double least = INFINITY;
    for (int i = 0; i < count; i++) {
        const McdMeshContact *c = &q->mesh->contact[i];
        double off[3];
        pointOnSurface(c, off);
        mcd_sub(off, off, t->corner[0]);
        if (c->separation < least && areParallel(c->normal, normal) &&
            fabs(mcd_dot(off, normal)) <= RISES * q->shape.extent)
            least = c->separation;
    }
    return least;
}

/* Adds contacts of coplanar neighbours that were not hit directly: points below the triangle that are as deep as the
 * deepest contact with its plane, if the surface covers the way from there to where the shape enters the plane. */
static void addCoplanarContacts(McdMeshQuery *q, const McdMeshTriangle *t) {
    McdMesh *mesh = q->mesh;
    double face[3], foot[3], through[3];
    const int first = mesh->contactCount;
    int count = first;
    mcd_scale(face, t->normal, t->facing < 0 ? -1 : 1);
    if (!addClippedContacts(q, t, face, OVER))
        return;
    const double deep = leastSeparationOnPlane(q, t, face, first) + OVER * q->shape.extent;
    for (int i = first; i < mesh->contactCount; i++) {
        const McdMeshContact *c = &mesh->contact[i];
        pointOnSurface(c, foot);
        if (c->separation < 0 && c->separation <= deep && entryThroughPlane(q, c, through) &&
            isPathCovered(q, t, face, foot, through))
            mesh->contact[count++] = *c;
    }
    mesh->contactCount = count;
}

/* The heights of a shape's lowest and highest points, and of its middle between them. */
static MeBool areHeightsGood(const McdMeshQuery *q, const McdMeshTriangle *t, double low, double high) {
    double off[3];
    mcd_sub(off, q->shape.place, t->corner[0]);
    const double place = mcd_dot(off, t->normal), slack = 1e-6 * q->shape.extent + 1e-9 * fabs(place);
    return !mcd_shapeIsRigid(&q->shape) || !mcd_isUnit(t->normal) ||
           (low <= high + slack && high <= place + q->shape.extent + slack && low >= place - q->shape.extent - slack);
}

/* Sets facing and isPending; both stay false for triangles out of reach. */
static void classifyTriangle(McdMeshQuery *q, McdMeshTriangle *t) {
    double low, high;
    t->facing = 0;
    t->isPending = MEFALSE;
    if (!isAbove(q, t))
        return;
    heightsOver(q, t, &low, &high);
    MEVALIDATE(areHeightsGood(q, t, low, high));
    if (low > q->margin || high < -q->margin)
        return;
    t->isPending = METRUE;
    if (t->flags & kMcdTriangleTwoSided)
        t->facing = !hasOnlyFaceNormal(q, t) ? 0 : low + high < 0 ? -1 : 1;
    else
        t->facing = heightOfCentre(q, t) >= 0 && hasOnlyFaceNormal(q, t);
}

/* The first pending triangle, if all pending ones are coplanar and face the same way; else null. */
static const McdMeshTriangle *commonPlane(const McdMeshQuery *q) {
    const McdMeshTriangle *first = 0;
    for (int i = 0; i < q->mesh->count; i++) {
        const McdMeshTriangle *t = &q->mesh->triangle[i];
        double off[3];
        if (!t->isPending)
            continue;
        if (!first)
            first = t;
        mcd_sub(off, t->corner[0], first->corner[0]);
        if (!t->facing || t->facing != first->facing || !areParallel(t->normal, first->normal) ||
            fabs(mcd_dot(off, first->normal)) > OVER * q->shape.extent)
            return 0;
    }
    return first;
}

static const McdMeshTriangle *triangleBelow(const McdMeshQuery *q, const double point[3]) {
    double in, out;
    for (int i = 0; i < q->mesh->count; i++) {
        const McdMeshTriangle *t = &q->mesh->triangle[i];
        if (t->isPending && clipToTriangle(t, point, point, OVER * q->shape.extent, &in, &out))
            return t;
    }
    return 0;
}

/* Contacts of the points within the margin of the plane; false if no triangle is below one of them. */
static MeBool addPointsOverPlane(McdMeshQuery *q, const double normal[3], const Polygon *p, MeBool onlyBelow,
                                 double *least) {
    for (int i = 0; i < p->count; i++) {
        Polygon one = {.count = 0};
        const McdMeshTriangle *t = triangleBelow(q, p->point[i]);
        if (!t)
            return MEFALSE;
        appendPoint(&one, p->point[i], p->name[i], MEFALSE);
        addAlong(q, t, normal, &one, onlyBelow, least);
    }
    return METRUE;
}

/* Where all pending triangles are one plane that reaches beyond the shape's face, contacts are those with the
 * plane. False if that is not so. */
static MeBool addPlaneContacts(McdMeshQuery *q) {
    const McdMeshTriangle *t = commonPlane(q);
    Polygon p;
    double face[3], back[3], least = INFINITY;
    if (!t)
        return MEFALSE;
    mcd_scale(face, t->normal, t->facing);
    mcd_scale(back, face, -1);
    polygonToward(&q->shape, back, &p);
    if (addPointsOverPlane(q, face, &p, MEFALSE, &least)) {
        pointToward(&q->shape, back, &p);
        if (addPointsOverPlane(q, face, &p, METRUE, &least))
            return METRUE;
    }
    q->mesh->contactCount = 0;
    return MEFALSE;
}

static void addAllContacts(McdMeshQuery *q) {
    McdMesh *mesh = q->mesh;
    for (int i = 0; i < mesh->count; i++)
        classifyTriangle(q, &mesh->triangle[i]);
    if (addPlaneContacts(q))
        return;
    for (int i = 0; i < mesh->count; i++) {
        McdMeshTriangle *t = &mesh->triangle[i];
        if (t->isPending)
            t->isPending = t->facing ? !addFaceContacts(q, t) : !addSearchedContacts(q, t);
    }
    for (int i = 0; i < mesh->count; i++)
        if (mesh->triangle[i].isPending)
            addCoplanarContacts(q, &mesh->triangle[i]);
    MEASSERT(mesh->contactCount >= 0 && mesh->contactCount <= mesh->contactMax);
}

/* Tunnelling: nothing pushes to the front, and the shape's middle is behind a one-sided triangle by less than half
 * of its radius. Contacts with the nearest such triangle, and those of the same normal, push it back. */
static void recoverFromBehind(McdMeshQuery *q) {
    const McdMeshTriangle *nearest = 0;
    McdManifold m;
    double least = fmin(q->radius, q->shape.extent) / 2;
    for (int i = 0; i < q->mesh->count; i++) {
        const McdMeshTriangle *t = &q->mesh->triangle[i];
        const double behind = -heightOfCentre(q, t);
        if (t->flags & kMcdTriangleTwoSided || behind < 0 || behind >= least || !intersectsTriangle(q, t, &m))
            continue;
        least = behind;
        nearest = t;
    }
    for (int i = 0; nearest && i < q->mesh->count; i++) {
        const McdMeshTriangle *t = &q->mesh->triangle[i];
        if (mcd_dot(t->normal, nearest->normal) > SAME_MANIFOLD && intersectsTriangle(q, t, &m))
            addClippedContacts(q, t, t->normal, OVER);
    }
}

/* ---- manifolds --------------------------------------------------------------------------------------------------- */

static MeBool isDuplicate(const McdMesh *mesh, int count, const McdMeshContact *c, double same) {
    for (int i = 0; i < count; i++)
        if (mcd_distanceSquared(mesh->cluster[i].position, c->position) <= same * same)
            return METRUE;
    return MEFALSE;
}

/* Moves the first contact and those of nearly its normal from contactOrder to the cluster, without duplicates; returns
 * their number. */
static int takeCluster(McdMesh *mesh, int *left, double same) {
    const McdMeshContact *first = &mesh->contact[mesh->contactOrder[0]];
    int count = 0, rest = 0;
    for (int i = 0; i < *left; i++) {
        const McdMeshContact *c = &mesh->contact[mesh->contactOrder[i]];
        if (i > 0 && mcd_dot(c->normal, first->normal) <= SAME_MANIFOLD)
            mesh->contactOrder[rest++] = mesh->contactOrder[i];
        else if (!isDuplicate(mesh, count, c, same))
            mesh->cluster[count++] = *c;
    }
    MEASSERT(rest < *left && count >= 1); /* at least the first one */
    *left = rest;
    return count;
}

static int keepSpread(McdMesh *mesh, McdMeshContact *contact, int count, int wanted, double same) {
    McdSpot *spot = mesh->spots;
    for (int i = 0; i < count; i++) {
        mcd_copy(spot[i].position, contact[i].position);
        mcd_copy(spot[i].normal, contact[i].normal);
        spot[i].separation = contact[i].separation;
    }
    const int keptCount = mcd_spread(spot, count, wanted, same, mesh->kept);
    for (int i = 0; i < keptCount; i++) {
        MEASSERT(mesh->kept[i] >= i); /* ascending: none is overwritten before it is moved */
        contact[i] = contact[mesh->kept[i]];
    }
    return keptCount;
}

/* Up to four contacts for each normal, and no more in all than the result has place for. */
static void reduceContacts(McdMeshQuery *q, int max) {
    McdMesh *mesh = q->mesh;
    const double same = 1e-6 * q->shape.extent;
    int left = mesh->contactCount, count = 0;
    for (int i = 0; i < left; i++)
        mesh->contactOrder[i] = i;
    sortIndices(mesh, compareContacts, mesh->contactOrder, left);
    McdMeshContact *out = mesh->merged;
    while (left) {
        const int size = takeCluster(mesh, &left, same);
        const int keptCount = keepSpread(mesh, mesh->cluster, size, MCD_MANIFOLD_POINTS, same);
        for (int i = 0; i < keptCount; i++)
            mesh->cluster[i].dims = mcd_regionDims(keptCount);
        memcpy(out + count, mesh->cluster, (size_t)keptCount * sizeof *out);
        count += keptCount;
    }
    if (count > max)
        count = keepSpread(mesh, out, count, max, same);
    MEASSERT(count <= MeMIN(max, mesh->contactCount));
    mesh->merged = mesh->contact;
    mesh->contact = out;
    mesh->contactCount = count;
}

static void handOver(McdMeshQuery *q, McdIntersectResult *result) {
    McdGeometryInstance *ins1 = &mcd_record(q->pair->model1)->instance;
    McdGeometryInstance *ins2 = &mcd_record(q->pair->model2)->instance;
    for (int i = 0; i < q->mesh->contactCount; i++) {
        const McdMeshContact *c = &q->mesh->contact[i];
        McdManifold m;
        m.count = 1;
        mcd_copy(m.normal, c->normal);
        mcd_copy(m.point[0].position, c->position);
        m.point[0].separation = c->separation;
        m.point[0].radius[0] = c->radius;
        m.point[0].radius[1] = 0;
        m.point[0].feature = c->feature;
        McdContact *added = mcd_resultAdd(result, &m, q->origin, ins1, ins2);
        if (added) {
            added->element2 = c->element;
            added->dims = c->dims;
        }
    }
}

/* ---- the query --------------------------------------------------------------------------------------------------- */

static void placeMesh(McdMeshQuery *q, const McdGeometryInstance *ins) {
    const MeMatrix4Ptr tm = mcd_instanceTM((McdGeometryInstance *)ins);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            q->axis[i][k] = (double)tm[i][k];
        q->place[i] = (double)tm[3][i] - q->origin[i];
    }
}

/* The shape's box along its own axes. */
static void boxShape(McdMeshQuery *q) {
    mcd_copy(q->box, q->shape.place);
    for (int i = 0; i < 3; i++) {
        double back[3], far[3], near[3];
        mcd_scale(back, q->shape.axis[i], -1);
        mcd_support(&q->shape, q->shape.axis[i], far);
        mcd_support(&q->shape, back, near);
        mcd_sub(far, far, q->shape.place);
        mcd_sub(near, near, q->shape.place);
        const double low = mcd_dot(near, q->shape.axis[i]), high = mcd_dot(far, q->shape.axis[i]);
        mcd_mad(q->box, q->box, (low + high) / 2, q->shape.axis[i]);
        q->half[i] = (high - low) / 2;
        MEASSERT(!(q->half[i] < -1e-9 * (q->shape.extent + mcd_length(q->shape.place))));
    }
}

static void boundShape(McdMeshQuery *q) {
    double sum = 0;
    mcd_copy(q->centre, q->place);
    for (int i = 0; i < 3; i++) {
        double back[3], far[3], near[3];
        mcd_scale(back, q->axis[i], -1);
        mcd_support(&q->shape, q->axis[i], far);
        mcd_support(&q->shape, back, near);
        mcd_sub(far, far, q->place);
        mcd_sub(near, near, q->place);
        const double low = mcd_dot(near, q->axis[i]), high = mcd_dot(far, q->axis[i]);
        const double grow = q->margin + 1e-9 * q->shape.extent;
        mcd_mad(q->centre, q->centre, (low + high) / 2, q->axis[i]);
        sum += (high - low) * (high - low) / 4;
        q->low[i] = low - grow;
        q->high[i] = high + grow;
    }
    q->radius = sqrt(sum);
}

/* A ball around the shape and the margin: the smaller one of two that are at hand. */
static void findBall(McdMeshQuery *q) {
    double off[3];
    const MeBool isCompact = q->shape.extent < q->radius;
    mcd_sub(off, isCompact ? q->shape.place : q->centre, q->place);
    for (int i = 0; i < 3; i++)
        q->ball[i] = mcd_dot(off, q->axis[i]);
    q->ballRadius = (isCompact ? q->shape.extent : q->radius) + q->margin;
}

/* Does the ball, in the mesh's frame, hold the shape's farthest points along its own axes and the mesh's? */
static MeBool isShapeInBall(const McdMeshQuery *q) {
    for (int i = 0; i < 12; i++) {
        double d[3], point[3], own[3];
        mcd_scale(d, i < 6 ? q->axis[i / 2] : q->shape.axis[i / 2 - 3], i % 2 ? -1 : 1);
        mcd_support(&q->shape, d, point);
        mcd_sub(point, point, q->place);
        for (int k = 0; k < 3; k++)
            own[k] = mcd_dot(point, q->axis[k]) - q->ball[k];
        if (mcd_length(own) > q->ballRadius * (1 + 1e-6) + 1e-6 * mcd_length(point)) /* axes of single precision */
            return MEFALSE;
    }
    return METRUE;
}

static MeBool areAxesUnit(const McdMeshQuery *q) {
    double x[3];
    mcd_cross(x, q->axis[0], q->axis[1]);
    return fabs(mcd_length(q->axis[0]) - 1) < 1e-6 && fabs(mcd_length(q->axis[1]) - 1) < 1e-6 &&
           fabs(fabs(mcd_dot(x, q->axis[2])) - 1) < 1e-6;
}

/* Finds the contacts in the query's memory and hands them over. */
static int intersect(McdMeshQuery *q, McdIntersectResult *result, McdMeshGather gather) {
    McdMesh *mesh = q->mesh;
    mesh->count = mesh->contactCount = mesh->skipped = mesh->vertexCount = 0;
    gather(q);
    if (mesh->skipped)
        MeDebug(3, "McdIntersect: %d triangles without area were skipped", mesh->skipped);
    if (!mesh->count)
        return 0;
    buildAdjacency(mesh);
    addAllContacts(q);
    if (!mesh->contactCount)
        recoverFromBehind(q);
    reduceContacts(q, result->contactMaxCount);
    handOver(q, result);
    return mcd_resultEnd(result);
}

int mcd_meshIntersect(McdModelPair *p, McdIntersectResult *result, McdMeshGather gather) {
    McdMeshQuery q;
    McdGeometryInstance *ins1 = &mcd_record(p->model1)->instance, *ins2 = &mcd_record(p->model2)->instance;
    McdFramework *frame = mcd_record(p->model1)->frame;
    mcd_resultBegin(result, p);
    q.pair = p;
    q.margin = mcd_pairMargin(p);
    mcd_pairOrigin(ins1, ins2, q.origin);
    if (!mcd_shapeOf(ins1, q.origin, &q.shape))
        return 0;
    placeMesh(&q, ins2);
    boundShape(&q);
    boxShape(&q);
    findBall(&q);
    MEVALIDATE(!areAxesUnit(&q) || !mcd_shapeIsRigid(&q.shape) || isShapeInBall(&q));
    q.scratch = mcd_scratchTake(frame, "McdIntersect");
    if (!q.scratch)
        return 0;
    q.mesh = &q.scratch->mesh;
    const int touches = intersect(&q, result, gather);
    mcd_scratchGive(frame, q.scratch);
    return touches;
}

/* ---- the framework's table --------------------------------------------------------------------------------------- */

MeBool mcd_meshRegister(McdFramework *frame, McdGeometryType type, McdGeometryType meshType, McdIntersectFn function) {
    McdInteractions interactions = {0, 0, function, 0};
    McdFrameworkSetInteractions(frame, type, meshType, &interactions);
    return frame != 0;
}
