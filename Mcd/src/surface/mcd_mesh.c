/* Contacts of a convex shape with a surface of triangles, without ghost contacts at internal edges. The triangles
 * near the shape are gathered into the query's memory, and then pass through the stages of mcd_mesh_stages_i.h. */
#include "surface/mcd_mesh_stages_i.h"
#include "convex/mcd_landing_i.h"
#include "convex/mcd_nearfield_i.h"
#include "surface/mcd_scratch_i.h"
#include <string.h>

/* ---- memory ------------------------------------------------------------------------------------------------------ */

MeBool mcd_meshReserve(McdMesh *mesh, int triangles) {
    if (triangles <= mesh->max)
        return METRUE;
    const int n = mesh->count, max = MeMAX(triangles, 2 * mesh->max);
    if (!MCD_MESH_GROW(mesh->triangle, n, max) || !MCD_MESH_GROW(mesh->place, 3 * n, 3 * max) ||
        !MCD_MESH_GROW(mesh->cornerOf, 0, 3 * max) || !MCD_MESH_GROW(mesh->firstOf, 0, 3 * max + 1) ||
        !MCD_MESH_GROW(mesh->usersOf, 0, 3 * max) || !MCD_MESH_GROW(mesh->fan, 0, 3 * max) ||
        !MCD_MESH_GROW(mesh->slot, 0, 12 * max))
        return MEFALSE;
    mesh->max = max;
    return METRUE;
}

/* ---- gathering --------------------------------------------------------------------------------------------------- */

MeU32 mcd_meshHash(MeU32 a, MeU32 b) {
    MeU32 h = a * 0x9e3779b1u ^ (b + 0x85ebca6bu + (a << 6) + (a >> 2));
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    return h ^ h >> 13;
}

MeU32 mcd_meshHashOfPoint(const double place[3]) {
    MeU32 key = 1;
    for (int i = 0; i < 3; i++) {
        const double value = place[i] + 0.0; /* -0 becomes 0 */
        MeU32 half[2];
        memcpy(half, &value, sizeof value);
        key = mcd_meshHash(mcd_meshHash(key, half[0]), half[1]);
    }
    return key;
}

/* Whether the triangle's bounding box overlaps the query's box and ball. Other triangles touch nothing, and do not
 * matter as neighbours: only edges and corners within box and ball are examined (isWithinQuery,
 * mcd_mesh_topology.c). */
static MeBool overlapsQuery(const McdMeshQuery *q, const double corner[3][3]) {
    double square = 0;
    for (int i = 0; i < 3; i++) {
        const double a = corner[0][i], b = corner[1][i], c = corner[2][i];
        const double low = a < b ? (a < c ? a : c) : b < c ? b : c, high = a > b ? (a > c ? a : c) : b > c ? b : c;
        if (!(low <= q->high[i] && high >= q->low[i]))
            return MEFALSE;
        const double outside = q->ball[i] < low ? low - q->ball[i] : q->ball[i] > high ? q->ball[i] - high : 0;
        square += outside * outside;
    }
    return square <= q->ballRadius * q->ballRadius;
}

/* Whether the axes are the query's own, as of most grounds. */
static MeBool areAligned(const double axis[3][3]) {
    static const double own[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return memcmp(axis, own, sizeof own) == 0;
}

/* Sets corners and normal, which are given in the mesh's frame. */
static void placeTriangle(const McdMeshQuery *q, const double corner[3][3], const double normal[3],
                          McdMeshTriangle *t) {
    const double(*axis)[3] = (const double(*)[3])q->axis;
    for (int i = 0; i < 3; i++) {
        t->normal[i] = normal[0] * axis[0][i] + normal[1] * axis[1][i] + normal[2] * axis[2][i];
        for (int k = 0; k < 3; k++)
            t->corner[i][k] =
                q->place[k] + corner[i][0] * axis[0][k] + corner[i][1] * axis[1][k] + corner[i][2] * axis[2][k];
    }
}

void mcd_meshAdd(McdMeshQuery *q, const double corner[3][3], const double *normal, int flags, const int *vertex,
                 McdElementData element) {
    McdMesh *mesh = q->mesh;
    const double(*axis)[3] = (const double(*)[3])q->axis;
    double own[3];
    if (!overlapsQuery(q, corner))
        return;
    if (!mcd_triangleNormal(corner, normal, own)) {
        mesh->skipped++;
        return;
    }
    if (!mcd_meshReserve(mesh, mesh->count + 1))
        return;
    McdMeshTriangle *t = &mesh->triangle[mesh->count];
    memcpy(mesh->place[3 * mesh->count], corner, 3 * sizeof *corner);
    if (areAligned(axis)) {
        mcd_copy(t->normal, own);
        for (int i = 0; i < 3; i++)
            mcd_mad(t->corner[i], q->place, 1, corner[i]);
    } else {
        placeTriangle(q, corner, own, t);
    }
    if (vertex)
        memcpy(t->vertex, vertex, sizeof t->vertex);
    t->flags = flags;
    t->element = element;
    t->isPatch = MEFALSE;
    mesh->count++;
    MEASSERT(mesh->count <= mesh->max && isfinite(mcd_dot(t->normal, t->normal)));
    MEASSERT(mcd_isUnit(own));
}

/* Whether the box of the shape overlaps the plane of the triangle, or may do so after rounding. */
static MeBool overlapsPlane(const McdMeshQuery *q, const double corner[3][3]) {
    double edge[2][3], normal[3], offset[3], size[3] = {0, 0, 0}, reach = 0;
    mcd_sub(edge[0], corner[1], corner[0]);
    mcd_sub(edge[1], corner[2], corner[0]);
    mcd_sub(offset, q->own, corner[0]);
    mcd_cross(normal, edge[0], edge[1]);
    for (int k = 0; k < 3; k++) {
        reach += q->half[k] * fabs(mcd_dot(q->side[k], normal));
        size[0] += fabs(edge[0][k]);
        size[1] += fabs(edge[1][k]);
        size[2] += fabs(offset[k]);
    }
    const double rounding = 8 * DBL_EPSILON * size[0] * size[1] * size[2];
    const double gap = fabs(mcd_dot(offset, normal)) - reach - rounding;
    return !(gap > 0 && gap * gap > q->reach * q->reach * mcd_dot(normal, normal));
}

MeBool mcd_meshIsNear(const McdMeshQuery *q, const double corner[3][3]) {
    MEASSERT(q->isForContacts);
    if (!overlapsPlane(q, corner))
        return MEFALSE;
    for (int i = 0; i < 3; i++) {
        const double a = mcd_heightOver(corner[0], q->own, q->side[i]),
                     b = mcd_heightOver(corner[1], q->own, q->side[i]),
                     c = mcd_heightOver(corner[2], q->own, q->side[i]), reach = q->half[i] + q->reach;
        if ((a > reach && b > reach && c > reach) || (a < -reach && b < -reach && c < -reach))
            return MEFALSE;
    }
    return METRUE;
}

static MeBool isAnyNear(const McdMeshQuery *q) {
    for (int i = 0; i < q->mesh->count; i++)
        if (mcd_meshIsNear(q, mcd_constRows(&q->mesh->place[3 * i])))
            return METRUE;
    return MEFALSE;
}

/* ---- the shape's bounds ------------------------------------------------------------------------------------------ */

/* The shape's extent along an axis, as heights over a point. */
static void extentAlong(const McdShape *s, const double axis[3], const double point[3], double *low, double *high) {
    double back[3], far[3], near[3];
    mcd_scale(back, axis, -1);
    mcd_support(s, axis, far);
    mcd_support(s, back, near);
    *low = mcd_heightOver(near, point, axis);
    *high = mcd_heightOver(far, point, axis);
}

/* Computes the bounding box along the shape's own axes: centre and half extents. */
static void boundAlongShape(McdMeshQuery *q) {
    mcd_copy(q->box, q->shape.place);
    for (int i = 0; i < 3; i++) {
        double low, high;
        extentAlong(&q->shape, q->shape.axis[i], q->shape.place, &low, &high);
        mcd_mad(q->box, q->box, (low + high) / 2, q->shape.axis[i]);
        q->half[i] = (high - low) / 2;
        MEASSERT(!(q->half[i] < -1e-9 * (q->shape.extent + mcd_length(q->shape.place))));
    }
}

/* Sets that box in the mesh's frame. The frame's axes are of unit length up to rounding. */
static void placeBoxInMesh(McdMeshQuery *q) {
    double size = 0;
    for (int i = 0; i < 3; i++) {
        q->own[i] = mcd_heightOver(q->box, q->place, q->axis[i]);
        size += fabs(q->own[i]) + q->half[i];
        for (int k = 0; k < 3; k++)
            q->side[k][i] = mcd_dot(q->shape.axis[k], q->axis[i]);
    }
    q->reach = q->margin + MCD_MESH_OVERLAP * q->shape.extent + 4 * (double)ME_EPSILON * size;
    q->isForContacts = METRUE;
}

/* Computes the shape's bounding box in the mesh's axes: the corners `low` and `high`, enlarged by the margin; the
 * centre and `radius`, half the diagonal without the margin. */
static void boundInMeshAxes(McdMeshQuery *q) {
    const double grow = q->margin + 1e-9 * q->shape.extent;
    double sum = 0;
    mcd_copy(q->centre, q->place);
    for (int i = 0; i < 3; i++) {
        double low, high;
        extentAlong(&q->shape, q->axis[i], q->place, &low, &high);
        mcd_mad(q->centre, q->centre, (low + high) / 2, q->axis[i]);
        sum += (high - low) * (high - low) / 4;
        q->low[i] = low - grow;
        q->high[i] = high + grow;
    }
    q->radius = sqrt(sum);
}

/* Computes a bounding ball of shape and margin: about the shape's origin or about the box's centre, whichever is
 * smaller. */
static void boundByBall(McdMeshQuery *q) {
    const MeBool isOriginBetter = q->shape.extent < q->radius;
    for (int i = 0; i < 3; i++)
        q->ball[i] = mcd_heightOver(isOriginBetter ? q->shape.place : q->centre, q->place, q->axis[i]);
    q->ballRadius = (isOriginBetter ? q->shape.extent : q->radius) + q->margin;
    MEASSERT(!(q->ballRadius < q->margin));
}

/* For checks: whether the ball, in the mesh's frame, contains the shape's support points along the axes of both
 * frames. */
static MeBool isShapeInBall(const McdMeshQuery *q) {
    for (int i = 0; i < 12; i++) {
        double d[3], point[3], own[3];
        mcd_scale(d, i < 6 ? q->axis[i / 2] : q->shape.axis[i / 2 - 3], i % 2 ? -1 : 1);
        mcd_support(&q->shape, d, point);
        mcd_sub(point, point, q->place);
        for (int k = 0; k < 3; k++)
            own[k] = mcd_dot(point, q->axis[k]) - q->ball[k];
        if (mcd_length(own) > q->ballRadius * (1 + 1e-6) + 1e-6 * mcd_length(point)) /* the axes are single precision */
            return MEFALSE;
    }
    return METRUE;
}

static MeBool areAxesOrthonormal(const McdMeshQuery *q) {
    double x[3];
    mcd_cross(x, q->axis[0], q->axis[1]);
    for (int i = 0; i < 3; i++)
        if (fabs(mcd_length(q->axis[i]) - 1) > 1e-6)
            return MEFALSE;
    return fabs(fabs(mcd_dot(x, q->axis[2])) - 1) < 1e-6;
}

/* Sets the shape's displacement relative to the mesh until the next test, limited to the margin within which triangles
 * are gathered (of a fast model at most its radius). */
static void findDisplacement(McdMeshQuery *q) {
    double arm[3];
    mcd_sub(arm, q->shape.place, q->place);
    mcd_pairDisplacement(q->pair, arm, q->displacement);
    const double length = mcd_length(q->displacement);
    if (length > q->margin)
        mcd_scale(q->displacement, q->displacement, q->margin / length);
    MEASSERT(!(mcd_length(q->displacement) > q->margin * (1 + 1e-9)));
}

/* ---- the query --------------------------------------------------------------------------------------------------- */

/* Sets the frames and the box of the query, by its margin. False for a shape that is not convex or has no transform. */
static MeBool placeQuery(McdMeshQuery *q, McdGeometryInstance *ins1, McdGeometryInstance *ins2) {
    const MeMatrix4Ptr tm = mcd_instanceTM(ins2);
    mcd_pairOrigin(ins1, ins2, q->origin);
    if (!mcd_shapeOf(ins1, q->origin, &q->shape))
        return MEFALSE;
    for (int i = 0; i < 3; i++) {
        mcd_fromReal(q->axis[i], tm[i]);
        q->place[i] = (double)tm[3][i] - q->origin[i];
    }
    boundInMeshAxes(q);
    return METRUE;
}

static MeBool beginQuery(McdMeshQuery *q, McdModelPair *p) {
    const McdReach reach = mcd_pairReach(p);
    q->pair = p;
    q->margin = reach.margin;
    q->mayLand = MEFALSE;
    MEASSERT(!(q->margin < 0));
    if (!placeQuery(q, &mcd_record(p->model1)->instance, &mcd_record(p->model2)->instance))
        return MEFALSE;
    q->mayLand =
        q->shape.hull && reach.approach > mcd_mayEnter * q->shape.extent && mcd_landingForecast(reach, &q->forecast);
    findDisplacement(q);
    boundAlongShape(q);
    placeBoxInMesh(q);
    boundByBall(q);
    MEVALIDATE(!areAxesOrthonormal(q) || !mcd_shapeIsKnown(&q->shape) || isShapeInBall(q));
    return METRUE;
}

static void gatherTriangles(McdMeshQuery *q) {
    McdMesh *mesh = q->mesh;
    mesh->count = mesh->contactCount = mesh->skipped = mesh->vertexCount = 0;
    mcd_kindOf(mcd_record(q->pair->model2)->instance.geometry)->gather(q);
    MEASSERT(q->mesh->count <= q->mesh->max && q->mesh->contactCount == 0);
    if (mesh->skipped)
        MeDebug(3, "McdIntersect: %d triangles without area were skipped", mesh->skipped);
}

/* The element of a contact's triangle; in a patch, of the triangle at the contact. */
static McdElementData elementOf(const McdMeshQuery *q, const McdMeshContact *c) {
    double offset[3], place[3], slack[3];
    if (!q->mesh->triangle[0].isPatch)
        return c->element;
    mcd_mad(offset, c->position, -c->separation / 2, c->normal);
    mcd_sub(offset, offset, q->place);
    for (int i = 0; i < 3; i++) {
        place[i] = mcd_dot(offset, q->axis[i]);
        slack[i] = 1e-6 * (q->high[i] - q->low[i]);
    }
    const McdGeometry *g = mcd_record(q->pair->model2)->instance.geometry;
    return mcd_kindOf(g)->elementAt(g, place, slack, c->element);
}

static void addToResult(McdMeshQuery *q, McdIntersectResult *result) {
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
        m.point[0].isVertex[0] = c->isVertex;
        m.point[0].isVertex[1] = MEFALSE;
        m.point[0].feature = c->feature;
        McdContact *added = mcd_resultAdd(result, &m, q->origin, ins1, ins2);
        if (added) {
            added->element2 = elementOf(q, c);
            added->dims = c->dims;
            mcd_toReal(added->edge, c->edge);
        }
    }
}

MeBool mcd_meshMayIntersect(const McdModelPair *p, McdGeometryType surface, const McdIntersectResult *result,
                            const char *function) {
    return mcd_areGiven(function, p, result, result) && mcd_resultHasRoom(result, function) &&
           mcd_modelCheck(p->model1, function) && mcd_modelCheck(p->model2, function) &&
           mcd_geometryIs(mcd_record(p->model2)->instance.geometry, surface, function) && mcd_pairIsPlaced(p, function);
}

int MEAPI mcd_meshIntersect(McdModelPair *p, McdIntersectResult *result) {
    McdFramework *frame = mcd_record(p->model1)->frame;
    McdMeshQuery q;
    int touches = 0;
    mcd_resultBegin(result, p);
    if (!beginQuery(&q, p))
        return 0;
    q.scratch = mcd_scratchAcquire(frame, "McdIntersect");
    if (!q.scratch)
        return 0;
    q.mesh = &q.scratch->mesh;
    gatherTriangles(&q);
    if (isAnyNear(&q)) {
        mcd_meshAddAround(&q);
        mcd_meshBuildAdjacency(q.mesh);
        mcd_meshFindContacts(&q);
        mcd_meshMarkEdges(&q);
        mcd_meshSweep(&q);
        mcd_meshReduceContacts(&q, result->contactMaxCount);
        addToResult(&q, result);
        touches = mcd_resultEnd(result);
    }
    mcd_scratchRelease(frame, q.scratch);
    return touches;
}

/* ---- the framework's table --------------------------------------------------------------------------------------- */

MeBool mcd_meshRegister(McdFramework *frame, McdGeometryType type, McdGeometryType meshType, McdIntersectFn function) {
    McdInteractions interactions = {0, 0, function, 0};
    return mcd_interactionRegister(frame, type, meshType, &interactions);
}
