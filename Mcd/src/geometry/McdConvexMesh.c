/* Convex meshes: a hull, and all points within the fatness of it.
 *
 * A fat mesh consists of the hull, a prism on each face, a sector of a cylinder along each edge, and a sector of a
 * ball at each vertex. Line segments and mass properties are computed from these parts.
 */
#include "McdConvexMesh.h"
#include "McdConvexInteractions.h"
#include "McdTriangleList.h"
#include "convex/mcd_kind_i.h"
#include "geometry/mcd_geometry_i.h"
#include "geometry/mcd_moments_i.h"
#include <string.h>

static const McdConvexMesh *get(const McdGeometry *g) {
    return (const McdConvexMesh *)g;
}

static int farthestOfAll(const McdHull *h, const double d[3]) {
    int best = 0;
    double max = mcd_dot(h->vertex[0], d);
    for (int i = 1; i < h->vertexCount; i++) {
        const double x = mcd_dot(h->vertex[i], d);
        if (x > max) {
            max = x;
            best = i;
        }
    }
    return best;
}

static void support(const McdGeometry *g, const double d[3], double point[3]) {
    const McdHull *h = get(g)->hull;
    const double length = mcd_length(d), out = length > 0 ? (double)get(g)->fatness / length : 0;
    mcd_mad(point, h->vertex[farthestOfAll(h, d)], out, d);
}

/* ---- line segments ----------------------------------------------------------------------------------------------- */

static void clipByFaces(McdClip *c, const McdHull *h, double fatness) {
    for (int i = 0; i < h->faceCount && !mcd_clipIsEmpty(c); i++)
        mcd_clipHalfSpace(c, h->face[i].normal, h->face[i].offset + fatness);
}

/* Clips the line by the prism of height fatness on a face: between the face and its outer copy, within the face's
 * edges. */
static void clipByPrism(McdClip *c, const McdHull *h, const McdHullFace *face, double fatness) {
    const int *v = h->faceVertex + face->first;
    double inward[3];
    mcd_scale(inward, face->normal, -1);
    mcd_clipHalfSpace(c, face->normal, face->offset + fatness);
    mcd_clipHalfSpace(c, inward, -face->offset);
    for (int i = 0; i < face->count && !mcd_clipIsEmpty(c); i++) {
        const double *a = h->vertex[v[i]], *b = h->vertex[v[(i + 1) % face->count]];
        double along[3], out[3];
        mcd_sub(along, b, a);
        mcd_cross(out, along, face->normal);
        const double length = mcd_length(out);
        for (int k = 0; k < 3; k++)
            out[k] /= length;
        mcd_clipHalfSpace(c, out, mcd_dot(out, a));
    }
}

/* Clips the line by the fat mesh. The union of its parts is convex, so the line is inside from where it enters the
 * first part to where it leaves the last. */
static void clipFat(McdClip *c, const McdHull *h, double fatness) {
    const McdClip line = *c;
    clipByFaces(c, h, fatness); /* quick rejection: these half-spaces contain the mesh */
    if (mcd_clipIsEmpty(c) || c->in > 1 || c->out < 0)
        return;
    *c = line;
    clipByFaces(c, h, 0);
    for (int i = 0; i < h->faceCount; i++) {
        McdClip clipped = line;
        clipByPrism(&clipped, h, &h->face[i], fatness);
        mcd_clipUnion(c, &clipped);
    }
    for (int i = 0; i < h->edgeCount; i++) {
        McdClip clipped = line;
        mcd_clipCapsule(&clipped, h->vertex[h->edge[i][0]], h->vertex[h->edge[i][1]], fatness);
        mcd_clipUnion(c, &clipped);
    }
}

static void clip(const McdGeometry *g, McdClip *c) {
    if (get(g)->fatness > 0)
        clipFat(c, get(g)->hull, (double)get(g)->fatness);
    else
        clipByFaces(c, get(g)->hull, 0);
}

static void MEAPI release(McdGeometryID g) {
    mcd_hullDestroy(((McdConvexMesh *)g)->hull);
    MeMemoryGive(((McdConvexMesh *)g)->publicVertex);
    MeMemoryGive(g);
}

MCD_DEFINE_LINE_SEGMENT(ConvexMesh)

/* ---- narrow phase ---------------------------------------------------------------------------- */

static void setShape(const McdGeometry *g, McdShape *s) {
    s->hull = get(g)->hull;
    s->rounding = (double)get(g)->fatness;
    s->extent = mcd_length(s->hull->centre) + s->hull->extent + s->rounding;
}

/* The support vertex by hill climbing: on a convex polyhedron a vertex that is not lower than its neighbours is a
 * global maximum. */
static int farthestByClimbing(const McdHull *h, const double d[3]) {
    int here = 0, next = 0;
    double max = mcd_dot(h->vertex[0], d);
    do {
        here = next;
        for (int i = h->neighbourFirst[here]; i < h->neighbourFirst[here + 1]; i++) {
            const double x = mcd_dot(h->vertex[h->neighbour[i]], d);
            if (x > max) {
                max = x;
                next = h->neighbour[i];
            }
        }
    } while (next != here);
    /* Vertices that mcd_hull.c removed within its flatness are not in the graph, so a local maximum may be lower by
     * that much. */
    MEVALIDATE(max >= mcd_dot(h->vertex[farthestOfAll(h, d)], d) - 1e-6 * h->extent * mcd_length(d));
    return here;
}

static void hullSupport(const McdShape *s, const double d[3], double point[3]) {
    const double own[3] = {mcd_dot(s->axis[0], d), mcd_dot(s->axis[1], d), mcd_dot(s->axis[2], d)};
    const McdHull *h = s->hull;
    enum { SCANNED = 24 }; /* up to this number of vertices a linear search is faster than hill climbing */
    const int i = h->vertexCount <= SCANNED ? farthestOfAll(h, own) : farthestByClimbing(h, own);
    mcd_shapePoint(s, h->vertex[i][0], h->vertex[i][1], h->vertex[i][2], point);
}

static void hullFace(const McdShape *s, const double direction[3], McdFace *f) {
    double d[3];
    mcd_shapeToOwnAxes(s, direction, d);
    const McdHull *h = s->hull;
    int best = 0;
    double max = -INFINITY;
    for (int i = 0; i < h->faceCount; i++) {
        const double x = mcd_dot(h->face[i].normal, d);
        if (x > max) {
            max = x;
            best = i;
        }
    }
    const McdHullFace *face = &h->face[best];
    /* A face with more corners than there is room for is sampled evenly. */
    const int count = MeMIN(face->count, MCD_FACE_POINTS - 1);
    MEASSERT(face->count >= 3 && face->first >= 0);
    mcd_shapeDirection(s, face->normal[0], face->normal[1], face->normal[2], f->normal);
    f->id = (MeU32)best;
    for (int i = 0; i < count; i++) {
        const double *v = h->vertex[h->faceVertex[face->first + i * face->count / count]];
        mcd_faceAdd(s, f, v[0], v[1], v[2], (MeU32)i);
    }
}

static void visitEdges(const McdGeometry *g, int sides, McdEdgeVisit visit, void *context) {
    const McdHull *h = get(g)->hull;
    (void)sides;
    for (int f = 0; f < h->faceCount; f++)
        for (int i = 0; i < h->face[f].count; i++) {
            const int *corner = h->faceVertex + h->face[f].first;
            double from[3], to[3];
            mcd_fromReal(from, get(g)->publicVertex[corner[i]]);
            mcd_fromReal(to, get(g)->publicVertex[corner[(i + 1) % h->face[f].count]]);
            visit(context, from, to);
        }
}

static const McdKind kind = {MCD_KIND_FUNCTIONS(ConvexMesh, release),
                             .size = sizeof(McdConvexMesh),
                             .setShape = setShape,
                             .support = hullSupport,
                             .face = hullFace,
                             .rank = MCD_RANK_HULL,
                             .edges = visitEdges};

/* ---- creation -------------------------------------------------------------------------------- */

static MeBool isMesh(McdGeometryID g, const char *function) {
    return mcd_geometryIs(g, kMcdGeometryTypeConvexMesh, function);
}

/* Copies the vertices in MeReal, for programs. */
static MeVector3 *copyVertices(const McdHull *h, const char *function) {
    MeVector3 *v = MeMemoryTake((size_t)h->vertexCount, sizeof *v, function, "vertices");
    for (int i = 0; v && i < h->vertexCount; i++)
        mcd_toReal(v[i], h->vertex[i]);
    return v;
}

static McdConvexMeshID createFrom(McdFramework *frame, const double (*point)[3], int count, MeReal fatness,
                                  const char *function) {
    McdHull *hull = mcd_hullCreate(point, count, function);
    MeVector3 *publicVertex = hull ? copyVertices(hull, function) : 0;
    McdConvexMesh *m = publicVertex ? mcd_geometryCreate(frame, kMcdGeometryTypeConvexMesh, sizeof *m, function) : 0;
    if (m) {
        m->hull = hull;
        m->publicVertex = publicVertex;
        m->fatness = fatness;
        return (McdConvexMeshID)m;
    }
    MeMemoryGive(publicVertex);
    mcd_hullDestroy(hull);
    return 0;
}

McdConvexMeshID MEAPI McdConvexMeshCreateHull(McdFramework *frame, const MeVector3 *vertices, int vertexCount,
                                              MeReal fatnessRadius) {
    if (!mcd_frameCheck(frame, "McdConvexMeshCreateHull"))
        return 0;
    if (!vertices || vertexCount < 4) {
        MeWarning(1, "McdConvexMeshCreateHull: a hull has at least 4 vertices, not %d", vertices ? vertexCount : 0);
        return 0;
    }
    if (fatnessRadius != 0 && !mcd_sizeIsGood(fatnessRadius, "fatness", "McdConvexMeshCreateHull"))
        return 0;
    double(*point)[3] = MeMemoryTake((size_t)vertexCount, sizeof *point, "McdConvexMeshCreateHull", "vertices");
    if (!point)
        return 0;
    for (int i = 0; i < vertexCount; i++)
        mcd_fromReal(point[i], vertices[i]);
    McdConvexMeshID g = createFrom(frame, mcd_constRows(point), vertexCount, fatnessRadius, "McdConvexMeshCreateHull");
    MeMemoryGive(point);
    return g;
}

/* The points are rings at several latitudes of both half spheres, and the poles. */
McdConvexMeshID MEAPI McdConvexMeshCreateSphyl(McdFramework *frame, MeReal radius, MeReal height) {
    enum { AROUND = 16, RINGS = 4 };
    double point[2 * (AROUND * RINGS + 1)][3];
    int n = 0;
    if (!mcd_frameCheck(frame, "McdConvexMeshCreateSphyl") ||
        !mcd_sizeIsGood(radius, "radius", "McdConvexMeshCreateSphyl") ||
        !mcd_sizeIsGood(height, "height", "McdConvexMeshCreateSphyl"))
        return 0;
    const double r = (double)radius, h = (double)height / 2;
    for (int side = -1; side <= 1; side += 2) {
        for (int i = 0; i < RINGS; i++)
            for (int j = 0; j < AROUND; j++, n++) {
                const double up = i * MCD_PI / (2 * RINGS), around = j * 2 * MCD_PI / AROUND;
                point[n][0] = r * cos(up) * cos(around);
                point[n][1] = r * cos(up) * sin(around);
                point[n][2] = side * (h + r * sin(up));
            }
        point[n][0] = point[n][1] = 0;
        point[n++][2] = side * (h + r);
    }
    return createFrom(frame, mcd_constRows(point), n, 0, "McdConvexMeshCreateSphyl");
}

/* ---- polygons ---------------------------------------------------------------------------------------------------- */

MeReal MEAPI McdConvexMeshGetFatness(McdConvexMeshID mesh) {
    return isMesh(mesh, "McdConvexMeshGetFatness") ? get(mesh)->fatness : 0;
}

int MEAPI McdConvexMeshGetPolygonCount(McdConvexMeshID g) {
    return isMesh(g, "McdConvexMeshGetPolygonCount") ? get(g)->hull->faceCount : 0;
}

static const McdHullFace *faceOf(McdConvexMeshID g, int polyID, const char *function) {
    if (!isMesh(g, function))
        return 0;
    if (polyID >= 0 && polyID < get(g)->hull->faceCount)
        return &get(g)->hull->face[polyID];
    MeWarning(1, "%s: there is no polygon %d", function, polyID);
    return 0;
}

int MEAPI McdConvexMeshGetPolygonVertexCount(McdConvexMeshID g, int polyID) {
    const McdHullFace *f = faceOf(g, polyID, "McdConvexMeshGetPolygonVertexCount");
    return f ? f->count : 0;
}

void MEAPI McdConvexMeshGetPolygonNormal(McdConvexMeshID g, int polyID, MeVector3 normal) {
    if (!mcd_areGiven(__func__, normal, normal, normal))
        return;
    const McdHullFace *f = faceOf(g, polyID, "McdConvexMeshGetPolygonNormal");
    for (int k = 0; k < 3; k++)
        normal[k] = f ? (MeReal)f->normal[k] : 0;
}

static const MeReal *vertexOf(McdConvexMeshID g, int polyID, int vertexID, const char *function) {
    const McdHullFace *f = faceOf(g, polyID, function);
    if (f && vertexID >= 0 && vertexID < f->count)
        return get(g)->publicVertex[get(g)->hull->faceVertex[f->first + vertexID]];
    if (f)
        MeWarning(1, "%s: polygon %d has no vertex %d", function, polyID, vertexID);
    return 0;
}

void MEAPI McdConvexMeshGetPolygonVertex(McdConvexMeshID g, int polyID, int vertexID, MeVector3 vertex) {
    if (!mcd_areGiven(__func__, vertex, vertex, vertex))
        return;
    const MeReal *v = vertexOf(g, polyID, vertexID, "McdConvexMeshGetPolygonVertex");
    MeVector3Set(vertex, v ? v[0] : 0, v ? v[1] : 0, v ? v[2] : 0);
}

const MeReal *MEAPI McdConvexMeshGetPolygonVertexPtr(McdConvexMeshID g, int polyID, int vertexID) {
    return vertexOf(g, polyID, vertexID, "McdConvexMeshGetPolygonVertexPtr");
}

void MEAPI McdConvexMeshGetXYAABB(McdConvexMeshID g, MeMatrix4 tm, MeReal bounds[4]) {
    mcd_localXYAABB(g, kMcdGeometryTypeConvexMesh, tm, bounds, support, __func__);
}

/* ---- bounding sphere, drawing ---------------------------------------------------------------- */

static MeReal boundingRadius(const McdGeometry *g, MeVector3 center) {
    const McdHull *h = get(g)->hull;
    double max = 0;
    mcd_toReal(center, h->centre);
    for (int i = 0; i < h->vertexCount; i++) {
        double d[3];
        for (int k = 0; k < 3; k++)
            d[k] = h->vertex[i][k] - (double)center[k];
        max = MeMAX(max, mcd_dot(d, d));
    }
    return mcd_roundUp(sqrt(max) * (1 + 4 * DBL_EPSILON) + (double)get(g)->fatness);
}

static void draw(const McdGeometry *g, const MeMatrix4 tm, const MeReal colour[3]) {
    const McdHull *h = get(g)->hull;
    for (int i = 0; i < h->edgeCount; i++)
        mcd_drawLine(tm, colour, h->vertex[h->edge[i][0]], h->vertex[h->edge[i][1]]);
}

/* ---- mass -------------------------------------------------------------------------------------------------------- */

/* A vertex relative to the hull's centre. */
static void vertexAt(const McdHull *h, int vertex, double out[3]) {
    mcd_sub(out, h->vertex[vertex], h->centre);
}

/* Adds the triangles of a face or, if isSolid, the tetrahedra that these form with the centre. */
static void addFace(McdMoments *s, const McdHull *h, const McdHullFace *f, MeBool isSolid) {
    const int *v = h->faceVertex + f->first;
    for (int i = 1; i + 1 < f->count; i++) {
        double t[4][3] = {{0}}, u[3], w[3], n[3];
        vertexAt(h, v[0], t[0]);
        vertexAt(h, v[i], t[1]);
        vertexAt(h, v[i + 1], t[2]);
        mcd_sub(u, t[1], t[0]);
        mcd_sub(w, t[2], t[0]);
        mcd_cross(n, u, w);
        if (isSolid)
            mcd_momentsAddSimplex(s, mcd_dot(n, t[0]) / 6, mcd_constRows(t), 4);
        else
            mcd_momentsAddSimplex(s, mcd_dot(n, f->normal) / 2, mcd_constRows(t), 3);
    }
}

/* Adds the prism on a face: x = y + z n, y on the face, 0 <= z <= r. */
static void addPrism(McdMoments *s, const McdHull *h, const McdHullFace *f, double r) {
    McdMoments face = {0};
    addFace(&face, h, f, 0);
    s->m += r * face.m;
    mcd_mad(s->first, s->first, r, face.first);
    mcd_mad(s->first, s->first, face.m * r * r / 2, f->normal);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            s->second[i][j] += r * face.second[i][j];
    mcd_momentsAddSecond(s, r * r, face.first, f->normal);
    mcd_momentsAddSecond(s, face.m * r * r * r / 3, f->normal, f->normal);
}

/* Adds the sector at an edge: x = y + z n, y on the edge, 0 <= z <= r, n between the normals of both faces: n = a
 * cos t + b sin t, 0 <= t <= angle. Returns the angle. */
static double addSector(McdMoments *s, const McdHull *h, int edge, double r) {
    double p[3], q[3], middle[3], along[3], side[3], b[3], normals[3];
    const double *a = h->face[h->edgeFace[edge][0]].normal, *other = h->face[h->edgeFace[edge][1]].normal;
    vertexAt(h, h->edge[edge][0], p);
    vertexAt(h, h->edge[edge][1], q);
    mcd_cross(side, a, other);
    mcd_sub(along, q, p);
    const double sine = mcd_length(side), length = mcd_length(along), angle = atan2(sine, mcd_dot(a, other));
    for (int k = 0; k < 3; k++) {
        middle[k] = (p[k] + q[k]) / 2;
        b[k] = sine > 0 ? (other[k] - mcd_dot(a, other) * a[k]) / sine : 0;
        normals[k] = sin(angle) * a[k] + (1 - cos(angle)) * b[k]; /* the integral of n over t */
    }
    MEASSERT(angle >= 0 && length > 0);
    const double disc = angle * r * r / 2, ring = r * r * r / 3, quarter = r * r * r * r / 4;
    s->m += length * disc;
    mcd_mad(s->first, s->first, length * disc, middle);
    mcd_mad(s->first, s->first, length * ring, normals);
    mcd_momentsAddSecond(s, length * disc, middle, middle);
    mcd_momentsAddSecond(s, length * disc / 12, along, along);
    mcd_momentsAddSecond(s, 2 * length * ring, middle, normals);
    mcd_momentsAddSecond(s, length * quarter * (angle / 2 + sin(2 * angle) / 4), a, a);
    mcd_momentsAddSecond(s, length * quarter * (angle / 2 - sin(2 * angle) / 4), b, b);
    mcd_momentsAddSecond(s, length * quarter * sin(angle) * sin(angle), a, b);
    return angle;
}

/* Adds a part of the ball sector at a vertex v: x = v + z n, 0 <= z <= r, n in the spherical polygon between the
 * faces' normals, whose sides cross the edges at right angles. With the edge's direction e away from v, which is the
 * outward normal of the polygon's side,
 *     int 1 = 2 pi - the sum of the faces' angles at v,
 *     int n = -1/2 sum angle e,                          from div(a - (a.n) n) = -2 a.n
 * and n n^T summed over all vertices is that of a whole sphere, (int 1)/3 I. Terms with int 1 are added here, corner
 * by corner. Terms with int n cancel between both ends of an edge, except int (v n^T + n v^T), which addSides adds
 * edge by edge. */
static void addSolidAngle(McdMoments *s, const double v[3], double angle, double r) {
    const double ball = r * r * r / 3, fifth = r * r * r * r * r / 5;
    s->m += angle * ball;
    mcd_mad(s->first, s->first, angle * ball, v);
    mcd_momentsAddSecond(s, angle * ball, v, v);
    for (int k = 0; k < 3; k++)
        s->second[k][k] += fifth * angle / 3;
}

static double angleAt(const McdHull *h, const int *corner, int count, int i) {
    double p[3], q[3], v[3], n[3];
    vertexAt(h, corner[i], v);
    vertexAt(h, corner[(i + 1) % count], p);
    vertexAt(h, corner[(i + count - 1) % count], q);
    mcd_sub(p, p, v);
    mcd_sub(q, q, v);
    mcd_cross(n, p, q);
    return atan2(mcd_length(n), mcd_dot(p, q));
}

static void addCorners(McdMoments *s, const McdHull *h, double r) {
    double v[3];
    for (int i = 0; i < h->vertexCount; i++) {
        vertexAt(h, i, v);
        addSolidAngle(s, v, 2 * MCD_PI, r);
    }
    for (int i = 0; i < h->faceCount; i++)
        for (int k = 0; k < h->face[i].count; k++) {
            const int *corner = h->faceVertex + h->face[i].first;
            vertexAt(h, corner[k], v);
            addSolidAngle(s, v, -angleAt(h, corner, h->face[i].count, k), r);
        }
}

static void addSides(McdMoments *s, const McdHull *h, int edge, double angle, double r) {
    double a[3], b[3], along[3];
    vertexAt(h, h->edge[edge][0], a);
    vertexAt(h, h->edge[edge][1], b);
    mcd_sub(along, b, a);
    mcd_momentsAddSecond(s, angle * r * r * r * r / 4 / mcd_length(along), along, along);
}

static McdMoments momentsOf(const McdHull *h, double r) {
    McdMoments s = {0};
    for (int i = 0; i < h->faceCount; i++)
        addFace(&s, h, &h->face[i], 1);
    if (r > 0) {
        for (int i = 0; i < h->faceCount; i++)
            addPrism(&s, h, &h->face[i], r);
        for (int i = 0; i < h->edgeCount; i++)
            addSides(&s, h, i, addSector(&s, h, i, r), r);
        addCorners(&s, h, r);
    }
    MEASSERT(s.m > 0); /* fails if faces look inward */
    return s;
}

static void addMass(const McdGeometry *g, McdMass *sum) {
    const McdHull *h = get(g)->hull;
    const McdMoments s = momentsOf(h, (double)get(g)->fatness);
    mcd_momentsMass(&s, h->centre, sum);
    MEASSERT(mcd_isInertiaGood(sum));
}

MCD_DEFINE_GEOMETRY_TYPE(ConvexMesh, addMass)

/* ---- interactions ------------------------------------------------------------------------------------------------ */

/* In this file, so that programs without convex meshes do not link the triangle list. */
MeBool MEAPI McdConvexMeshPrimitivesRegisterInteractions(McdFramework *frame) {
    ME_RETURN_UNDER_OWN_NAME(
        MeBool, McdSphereConvexMeshRegisterInteraction(frame) && McdBoxConvexMeshRegisterInteraction(frame) &&
                    McdCylinderConvexMeshRegisterInteraction(frame) && McdSphylConvexMeshRegisterInteraction(frame) &&
                    McdConvexMeshPlaneRegisterInteraction(frame) && McdConvexMeshConvexMeshRegisterInteraction(frame) &&
                    McdConvexMeshTriangleListRegisterInteraction(frame));
}
