/* Indexed triangle meshes: records that share triangles and a tree, at scales of their own. */
#include "McdMesh.h"
#include "convex/mcd_kind_i.h"
#include "convex/mcd_vector_i.h"
#include "geometry/mcd_geometry_i.h"
#include "geometry/mcd_moments_i.h"
#include "surface/mcd_mesh_data_i.h"
#include "surface/mcd_scratch_i.h"

static McdMeshRecord *meshOf(McdGeometryID g, const char *function) {
    return mcd_geometryIs(g, kMcdGeometryTypeMesh, function) ? (McdMeshRecord *)g : 0;
}

static const McdMeshRecord *get(const McdGeometry *g) {
    return (const McdMeshRecord *)g;
}

/* ---- creation ---------------------------------------------------------------------------------------------------- */

/* Sets the box; both ends are rounded products of coordinates within it, as the corners are. */
static void updateBounds(McdMeshRecord *m) {
    MeVector3 min, max;
    mcd_bvhBounds(m->data->bvh, min, max);
    for (int i = 0; i < 3; i++) {
        m->low[i] = mcd_roundDown((double)min[i] * (double)m->scale[i]);
        m->high[i] = mcd_roundUp((double)max[i] * (double)m->scale[i]);
    }
    m->version++;
}

/* Creates a record of the data, and takes over a reference to it. */
static McdMeshID createRecord(McdFramework *frame, McdMeshData *data, const MeVector3 scale, const char *function) {
    McdMeshRecord *m = mcd_geometryCreate(frame, kMcdGeometryTypeMesh, sizeof *m, function);
    if (!m) {
        mcd_meshDataRelease(data);
        return 0;
    }
    m->data = data;
    MeVector3Copy(m->scale, scale);
    updateBounds(m);
    return &m->head;
}

/* Whether meshes may be created: as mcd_geometryCreate, before the work is done. */
static MeBool mayCreate(McdFramework *frame, const char *function) {
    if (!mcd_frameCheck(frame, function))
        return MEFALSE;
    if (frame->types[kMcdGeometryTypeMesh].isRegistered)
        return mcd_mayCreate(frame, function);
    MeWarning(1, "%s: register the type first, by McdMeshRegisterType", function);
    return MEFALSE;
}

static McdMeshID create(McdFramework *frame, const McdMeshInput *in, const char *function) {
    static const MeVector3 one = {1, 1, 1};
    enum { ALL = kMcdMeshBorrowVertices | kMcdMeshTwoSided, MAX = 500000000 };
    if (!in->vertex || !in->index || in->vertexCount < 1 || in->vertexCount > MAX || in->triangleCount < 1 ||
        in->triangleCount > MAX || (in->flags & ~ALL)) {
        MeWarning(1, "%s: %d vertices at %p, %d triangles at %p (1 to %d of each), flags %d", function, in->vertexCount,
                  (const void *)in->vertex, in->triangleCount, (const void *)in->index, (int)MAX, in->flags);
        return 0;
    }
    McdMeshData *data = mayCreate(frame, function) ? mcd_meshDataCreate(in, function) : 0;
    return data ? createRecord(frame, data, one, function) : 0;
}

McdMeshID MEAPI McdMeshCreate(McdFramework *frame, const MeVector3 *vertices, int vertexCount, const int *indices,
                              int triangleCount, const MeU32 *materials) {
    const McdMeshInput in = {vertices, vertexCount, indices, triangleCount, materials, kMcdMeshDefault};
    return create(frame, &in, "McdMeshCreate");
}

McdMeshID MEAPI McdMeshCreateWithFlags(McdFramework *frame, const MeVector3 *vertices, int vertexCount,
                                       const int *indices, int triangleCount, const MeU32 *materials, int flags) {
    const McdMeshInput in = {vertices, vertexCount, indices, triangleCount, materials, flags};
    return create(frame, &in, "McdMeshCreateWithFlags");
}

McdMeshID MEAPI McdMeshCreateScaled(McdMeshID mesh, const MeVector3 scale) {
    McdMeshRecord *m = meshOf(mesh, "McdMeshCreateScaled");
    if (!m || !mcd_areGiven(__func__, scale, scale, scale))
        return 0;
    for (int i = 0; i < 3; i++)
        if (!mcd_sizeIsGood(scale[i], "scale", "McdMeshCreateScaled"))
            return 0;
    MeVector3 product;
    for (int i = 0; i < 3; i++)
        product[i] = scale[i] * m->scale[i];
    m->data->references++;
    return createRecord(mesh->frame, m->data, product, "McdMeshCreateScaled");
}

static void MEAPI release(McdGeometryID g) {
    mcd_meshDataRelease(((McdMeshRecord *)g)->data);
    MeMemoryGive(g);
}

/* ---- vertices that move ------------------------------------------------------------------------------------------ */

/* Fits the tree, and the boxes of all meshes that share it. */
static void update(McdGeometry *g) {
    McdMeshData *data = get(g)->data;
    if (!mcd_mayChangeShapes(g->frame, "McdGeometryUpdate"))
        return;
    mcd_meshDataRefit(data, "McdGeometryUpdate");
    for (McdGeometry *other = g->frame->firstGeometry; other; other = other->next)
        if (other->type == kMcdGeometryTypeMesh && get(other)->data == data) {
            updateBounds((McdMeshRecord *)other);
            mcd_geometryMarkModels(other);
        }
}

void MEAPI McdMeshSetVertices(McdMeshID mesh, const MeVector3 *vertices) {
    McdMeshRecord *m = meshOf(mesh, "McdMeshSetVertices");
    if (!m || !mcd_areGiven(__func__, vertices, vertices, vertices) ||
        !mcd_mayChangeShapes(mesh->frame, "McdMeshSetVertices"))
        return;
    mcd_meshDataSetVertices(m->data, vertices);
    McdGeometryUpdate(mesh);
}

/* ---- accessors --------------------------------------------------------------------------------------------------- */

int MEAPI McdMeshGetFlags(McdMeshID mesh) {
    const McdMeshRecord *m = meshOf(mesh, "McdMeshGetFlags");
    return m ? m->data->flags : 0;
}

int MEAPI McdMeshGetVertexCount(McdMeshID mesh) {
    const McdMeshRecord *m = meshOf(mesh, "McdMeshGetVertexCount");
    return m ? m->data->triangles.vertexCount : 0;
}

int MEAPI McdMeshGetTriangleCount(McdMeshID mesh) {
    const McdMeshRecord *m = meshOf(mesh, "McdMeshGetTriangleCount");
    return m ? m->data->triangles.count : 0;
}

int MEAPI McdMeshGetLeftOutCount(McdMeshID mesh) {
    const McdMeshRecord *m = meshOf(mesh, "McdMeshGetLeftOutCount");
    return m ? m->data->leftOut : 0;
}

/* The mesh if it has a triangle of that number; else null, with a warning. */
static const McdMeshRecord *meshWithTriangle(McdMeshID mesh, int triangle, const char *function) {
    const McdMeshRecord *m = meshOf(mesh, function);
    if (m && triangle >= 0 && triangle < m->data->triangles.count)
        return m;
    if (m)
        MeWarning(1, "%s: there is no triangle %d: there are %d", function, triangle, m->data->triangles.count);
    return 0;
}

MeBool MEAPI McdMeshGetTriangle(McdMeshID mesh, int triangle, MeVector3 corner[3]) {
    double place[3][3];
    const McdMeshRecord *m = meshWithTriangle(mesh, triangle, "McdMeshGetTriangle");
    if (!m || !mcd_areGiven(__func__, corner, corner, corner) || mcd_meshDataIsPoint(m->data, triangle))
        return MEFALSE;
    mcd_meshDataCorners(m->data, triangle, m->scale, place);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            corner[k][i] = mcd_clampReal(place[k][i]);
    return METRUE;
}

static int material(const McdGeometry *g, int element) {
    const McdMeshData *data = get(g)->data;
    return data->material && element >= 0 && element < data->triangles.count ? (int)data->material[element] : -1;
}

int MEAPI McdMeshGetMaterial(McdMeshID mesh, int triangle) {
    const McdMeshRecord *m = meshWithTriangle(mesh, triangle, "McdMeshGetMaterial");
    return m ? material(&m->head, triangle) : -1;
}

MeBool MEAPI McdMeshIsClosed(McdMeshID mesh) {
    const McdMeshRecord *m = meshOf(mesh, "McdMeshIsClosed");
    return m && mcd_meshDataIsClosed(m->data);
}

/* ---- the type's functions ---------------------------------------------------------------------------------------- */

static void support(const McdGeometry *g, const double direction[3], double point[3]) {
    mcd_boxSupport(get(g)->low, get(g)->high, direction, point);
}

static MeReal boundingRadius(const McdGeometry *g, MeVector3 center) {
    return mcd_boxBSphere(get(g)->low, get(g)->high, center);
}

static void draw(const McdGeometry *g, const MeMatrix4 tm, const MeReal colour[3]) {
    const McdMeshRecord *m = get(g);
    for (int i = 0; i < m->data->triangles.count; i++) {
        double corner[3][3];
        mcd_meshDataCorners(m->data, i, m->scale, corner);
        for (int k = 0; k < 3; k++)
            mcd_drawLine(tm, colour, corner[k], corner[(k + 1) % 3]);
    }
}

/* The solid inside, by the divergence theorem: the sum of the tetrahedra of its triangles with any point. The box's
 * centre keeps them small. */
static void addMass(const McdGeometry *g, McdMass *sum) {
    const McdMeshRecord *m = get(g);
    McdMoments s = {0};
    double centre[3];
    if (!mcd_meshDataIsClosed(m->data))
        return;
    for (int i = 0; i < 3; i++)
        centre[i] = ((double)m->low[i] + (double)m->high[i]) / 2;
    for (int i = 0; i < m->data->triangles.count; i++) {
        double corner[4][3] = {{0}}, normal[3];
        mcd_meshDataCorners(m->data, i, m->scale, corner);
        for (int k = 0; k < 3; k++)
            mcd_sub(corner[k], corner[k], centre);
        mcd_cross(normal, corner[1], corner[2]);
        mcd_momentsAddSimplex(&s, mcd_dot(corner[0], normal) / 6, mcd_constRows(corner), 4);
    }
    if (s.m > 0) {
        mcd_momentsMass(&s, centre, sum);
        MEASSERT(mcd_isInertiaGood(sum));
    }
}

/* ---- triangles near a shape -------------------------------------------------------------------------------------- */

static int triangleFlags(const McdMeshRecord *m) {
    return kMcdTriangleUseSmallestPenetration | kMcdTriangleUseEdges |
           (m->data->flags & kMcdMeshTwoSided ? kMcdTriangleTwoSided : 0);
}

/* The numbers of the triangles whose boxes overlap the query's. */
typedef struct Found {
    McdScratch *scratch;
    int count;
} Found;

static MeBool addNumber(void *context, int triangle) {
    Found *found = context;
    if (!mcd_scratchReserveNumbers(found->scratch, found->count, found->count + 1))
        return MEFALSE;
    found->scratch->number[found->count++] = triangle;
    return METRUE;
}

/* Shell's method, in place. */
static void sortNumbers(int *number, int count) {
    for (int gap = count / 2; gap > 0; gap = gap == 2 ? 1 : gap * 5 / 11)
        for (int i = gap; i < count; i++) {
            const int moved = number[i];
            int at = i;
            for (; at >= gap && number[at - gap] > moved; at -= gap)
                number[at] = number[at - gap];
            number[at] = moved;
        }
}

static MeBool isAnyNear(const McdMeshQuery *q, const McdMeshRecord *m, int found) {
    MeBool isNear = !q->isForContacts;
    for (int i = 0; i < found && !isNear; i++) {
        double corner[3][3];
        mcd_meshDataCorners(m->data, q->scratch->number[i], m->scale, corner);
        isNear = mcd_meshIsNear(q, mcd_constRows(corner));
    }
    return isNear;
}

/* Adds the triangles in the order of their numbers: results do not depend on the tree. */
static void addTriangles(McdMeshQuery *q, const McdMeshRecord *m, int found) {
    sortNumbers(q->scratch->number, found);
    const int count = mcd_meshReserve(q->mesh, found) ? found : 0;
    for (int i = 0; i < count; i++) {
        const int triangle = q->scratch->number[i];
        double corner[3][3];
        mcd_meshDataCorners(m->data, triangle, m->scale, corner);
        mcd_meshAdd(q, mcd_constRows(corner), 0, triangleFlags(m), 0, (McdElementData){.tag = triangle});
    }
}

/* If the surface in the box, of which the scratch has the numbers, is a plane: adds one triangle that covers the box in
 * this plane. */
static MeBool addPatch(McdMeshQuery *q, const McdMeshRecord *m, int found) {
    const int triangle = mcd_meshDataPatchOf(m->data, q->scratch->number, found);
    double own[3][3], corner[3][3], normal[3], middle[3], u[3], w[3], size[3];
    if (triangle < 0)
        return MEFALSE;
    mcd_meshDataCorners(m->data, triangle, m->scale, own);
    if (!mcd_triangleNormal(mcd_constRows(own), 0, normal))
        return MEFALSE;
    mcd_mad(middle, q->ball, -mcd_heightOver(q->ball, own[0], normal), normal);
    mcd_basis(normal, u, w);
    mcd_sub(size, q->high, q->low);
    const double reach = 4 * mcd_length(size); /* the circle inside has half this radius */
    for (int k = 0; k < 3; k++) {
        mcd_mad(corner[k], middle, reach * cos(k * 2 * MCD_PI / 3), u);
        mcd_mad(corner[k], corner[k], reach * sin(k * 2 * MCD_PI / 3), w);
    }
    mcd_meshAdd(q, mcd_constRows(corner), normal, triangleFlags(m), 0, (McdElementData){.tag = triangle});
    if (q->mesh->count != 1)
        return MEFALSE;
    return q->mesh->triangle[0].isPatch = METRUE;
}

static void gather(McdMeshQuery *q) {
    const McdMeshRecord *m = get(mcd_record(q->pair->model2)->instance.geometry);
    Found found = {q->scratch, 0};
    double low[3], high[3];
    for (int i = 0; i < 3; i++) { /* the query's box with the rounding of the corners' products, before scaling */
        const double scale = (double)m->scale[i], slack = 4 * DBL_EPSILON * (fabs(q->low[i]) + fabs(q->high[i]));
        low[i] = (q->low[i] - slack) / scale;
        high[i] = (q->high[i] + slack) / scale;
    }
    mcd_bvhQuery(m->data->bvh, low, high, addNumber, &found);
    if (!addPatch(q, m, found.count) && isAnyNear(q, m, found.count))
        addTriangles(q, m, found.count);
}

/* The triangle of a patch that contains a point: that of which the point is the farthest inside. */
typedef struct Under {
    const McdMeshRecord *mesh;
    double place[3], inside;
    int triangle;
} Under;

static MeBool visitUnder(void *context, int triangle) {
    Under *under = context;
    double corner[3][3], normal[3], inside = INFINITY;
    mcd_meshDataCorners(under->mesh->data, triangle, under->mesh->scale, corner);
    if (!mcd_triangleNormal(mcd_constRows(corner), 0, normal))
        return METRUE;
    for (int k = 0; k < 3; k++) {
        double edge[3], inward[3];
        mcd_sub(edge, corner[(k + 1) % 3], corner[k]);
        mcd_cross(inward, normal, edge);
        inside = fmin(inside, mcd_heightOver(under->place, corner[k], inward) / mcd_length(edge));
    }
    if (under->triangle < 0 || inside > under->inside) {
        under->triangle = triangle;
        under->inside = inside;
    }
    return METRUE;
}

static McdElementData elementAt(const McdGeometry *g, const double place[3], const double slack[3],
                                McdElementData element) {
    const McdMeshRecord *m = get(g);
    Under under = {.mesh = m, .triangle = -1};
    double low[3], high[3];
    mcd_copy(under.place, place);
    for (int i = 0; i < 3; i++) {
        low[i] = (place[i] - slack[i]) / (double)m->scale[i];
        high[i] = (place[i] + slack[i]) / (double)m->scale[i];
    }
    mcd_bvhQuery(m->data->bvh, low, high, visitUnder, &under);
    return under.triangle < 0 ? element : (McdElementData){.tag = under.triangle};
}

static MeU32 segments(const McdModelID cm, const McdSegment segment[], int count, McdLineSegIntersectResult hit[]);
static int MEAPI intersectSegment(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,
                                  McdLineSegIntersectResult *outOverlap);

static const McdKind kind = {MCD_KIND_FUNCTIONS(Mesh, release),
                             .size = sizeof(McdMeshRecord),
                             .gather = gather,
                             .elementAt = elementAt,
                             .update = update,
                             .isStored = METRUE,
                             .material = material,
                             .isStatic = METRUE,
                             .segments = segments,
                             .segment = intersectSegment};
MCD_DEFINE_GEOMETRY_TYPE(Mesh, addMass)

MeBool MEAPI McdMeshRegisterInteractions(McdFramework *frame) {
    if (!mcd_frameCheck(frame, __func__))
        return MEFALSE;
    for (int type = 0; type < frame->typeCount; type++)
        if (frame->types[type].kind && frame->types[type].kind->setShape)
            mcd_meshRegister(frame, (McdGeometryType)type, kMcdGeometryTypeMesh, mcd_meshIntersect);
    return METRUE;
}

/* ---- line segments ----------------------------------------------------------------------------------------------- */

typedef struct Ray {
    const McdMeshRecord *mesh;
    double from[3], to[3];      /* in the mesh's frame, scaled */
    double fraction, normal[3]; /* of the first hit so far */
    int triangle;               /* -1: no hit so far */
} Ray;

static double hitTriangle(void *context, int number, int triangle, double fraction) {
    Ray *ray = (Ray *)context + number;
    double corner[3][3], normal[3], hit[3], here;
    mcd_meshDataCorners(ray->mesh->data, triangle, ray->mesh->scale, corner);
    if (!mcd_triangleNormal(mcd_constRows(corner), 0, normal) ||
        !mcd_segmentTriangle(mcd_constRows(corner), normal, (ray->mesh->data->flags & kMcdMeshTwoSided) != 0, ray->from,
                             ray->to, &here, hit) ||
        here > fraction || (here == fraction && ray->triangle >= 0 && triangle > ray->triangle))
        return fraction;
    mcd_copy(ray->normal, hit);
    ray->triangle = triangle;
    return ray->fraction = here;
}

/* Sets a ray to a segment, and what of it is cast in the tree's scale. False: its place is not finite in the mesh. */
static MeBool beginRay(Ray *ray, const McdGeometryInstance *ins, const McdSegment *s, double from[3], double by[3]) {
    *ray = (Ray){.mesh = get(ins->geometry), .triangle = -1};
    if (!mcd_toLocal(mcd_const(ins->tm), s->from, ray->from) || !mcd_toLocal(mcd_const(ins->tm), s->to, ray->to))
        return MEFALSE;
    for (int i = 0; i < 3; i++) {
        from[i] = ray->from[i] / (double)ray->mesh->scale[i];
        by[i] = (ray->to[i] - ray->from[i]) / (double)ray->mesh->scale[i];
    }
    return METRUE;
}

static MeBool writeRay(const Ray *ray, const McdGeometryInstance *ins, const McdSegment *s,
                       McdLineSegIntersectResult *hit) {
    if (ray->triangle < 0)
        return MEFALSE;
    hit->element.tag = ray->triangle;
    return mcd_writeSegmentHit(mcd_const(ins->tm), s->from, s->to, ray->fraction, ray->normal, hit) != 0;
}

static MeU32 segments(const McdModelID cm, const McdSegment segment[], int count, McdLineSegIntersectResult hit[]) {
    const McdGeometryInstance *ins = &mcd_record(cm)->instance;
    Ray ray[MCD_SEGMENTS];
    double from[MCD_SEGMENTS][3], by[MCD_SEGMENTS][3];
    int number[MCD_SEGMENTS], cast = 0;
    MeU32 hits = 0;
    for (int i = 0; i < count; i++)
        if (beginRay(&ray[cast], ins, &segment[i], from[cast], by[cast]))
            number[cast++] = i;
    if (cast)
        mcd_bvhCast(ray[0].mesh->data->bvh, cast, mcd_constRows(from), mcd_constRows(by), hitTriangle, ray);
    for (int k = 0; k < cast; k++)
        if (writeRay(&ray[k], ins, &segment[number[k]], &hit[number[k]]))
            hits |= 1u << number[k];
    return hits;
}

static int MEAPI intersectSegment(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,
                                  McdLineSegIntersectResult *outOverlap) {
    McdSegment s;
    MeVector3Copy(s.from, inOrig);
    MeVector3Copy(s.to, inDest);
    return (int)segments(cm, &s, 1, outOverlap);
}

void MEAPI McdMeshLineSegmentRegisterInteraction(McdFramework *frame) {
    ME_UNDER_OWN_NAME(McdFrameworkSetLineSegInteraction(frame, kMcdGeometryTypeMesh, intersectSegment));
}
