/* The triangle list: a box, and a callback that knows what is in it. */
#include "McdTriangleList.h"
#include "mcd_geometries.h"
#include "mcd_local.h"
#include <math.h>
#include <string.h>

static McdTriangleListRecord *listOf(McdGeometryID g, const char *function) {
    return mcd_geometryIs(g, kMcdGeometryTypeTriangleList, function) ? (McdTriangleListRecord *)g : 0;
}

static void gather(McdMeshQuery *q);

/* ---- life -------------------------------------------------------------------------------------------------------- */

static MeBool isBox(const MeReal *min, const MeReal *max) {
    for (int i = 0; min && max && i < 3; i++)
        if (!(min[i] <= max[i]) || !MeRealIsValid(min[i]) || !MeRealIsValid(max[i]))
            return MEFALSE;
    return min && max;
}

/* Place for what the callback hands over; false if there is no memory. */
static MeBool makeRoom(McdTriangleListRecord *list, int count) {
    /* zeroed: the triangleData of programs that do not set it */
    McdUserTriangle *found = MeMemoryTakeZeroed((size_t)count, sizeof *found, "McdTriangleListCreate", "triangles");
    if (!found)
        return MEFALSE;
    MeMemoryGive(list->list.list);
    list->list.list = found;
    list->list.triangleMaxCount = list->room = count;
    list->hasWarned = MEFALSE;
    return METRUE;
}

McdTriangleListID MEAPI McdTriangleListCreate(McdFramework *frame, MeVector3 min, MeVector3 max, int triangleMaxCount,
                                              McdTriangleListFnPtr f) {
    if (!isBox(min, max) || triangleMaxCount < 1) {
        MeWarning(1, "McdTriangleListCreate: the box needs min <= max; triangleMaxCount is %d (> 0)", triangleMaxCount);
        return 0;
    }
    McdTriangleListRecord *list =
        mcd_geometryCreate(frame, kMcdGeometryTypeTriangleList, sizeof *list, "McdTriangleListCreate");
    if (!list)
        return 0;
    if (!makeRoom(list, triangleMaxCount)) {
        McdGeometryDestroy(&list->list.head);
        return 0;
    }
    MeVector3Copy(list->min, min);
    MeVector3Copy(list->max, max);
    list->generate = f;
    list->mesh.gather = gather;
    return &list->list.head;
}

static void MEAPI release(McdGeometryID g) {
    McdTriangleListRecord *list = (McdTriangleListRecord *)g;
    MeMemoryGive(list->list.list);
    mcd_meshFree(&list->mesh);
    MeMemoryGive(list);
}

/* ---- what it is made of -------------------------------------------------------------------------------------------- */

void MEAPI McdTriangleListGetBoundingBox(McdTriangleListID g, MeVector3 min, MeVector3 max) {
    const McdTriangleListRecord *list = listOf(g, "McdTriangleListGetBoundingBox");
    MeVector3Set(min, 0, 0, 0);
    MeVector3Set(max, 0, 0, 0);
    if (!list)
        return;
    MeVector3Copy(min, list->min);
    MeVector3Copy(max, list->max);
}

void MEAPI McdTriangleListSetBoundingBox(McdTriangleListID g, MeVector3 min, MeVector3 max) {
    McdTriangleListRecord *list = listOf(g, "McdTriangleListSetBoundingBox");
    if (!list)
        return;
    if (!isBox(min, max)) {
        MeWarning(1, "McdTriangleListSetBoundingBox: the box needs min <= max");
        return;
    }
    MeVector3Copy(list->min, min);
    MeVector3Copy(list->max, max);
}

McdTriangleListFnPtr MEAPI McdTriangleListGetGenerator(McdTriangleListID g) {
    const McdTriangleListRecord *list = listOf(g, "McdTriangleListGetGenerator");
    return list ? list->generate : 0;
}

void MEAPI McdTriangleListSetGenerator(McdTriangleListID g, McdTriangleListFnPtr f) {
    McdTriangleListRecord *list = listOf(g, "McdTriangleListSetGenerator");
    if (list)
        list->generate = f;
}

int MEAPI McdTriangleListGetMaxTriangles(McdTriangleListID g) {
    const McdTriangleListRecord *list = listOf(g, "McdTriangleListGetMaxTriangles");
    return list ? list->list.triangleMaxCount : 0;
}

void MEAPI McdTriangleListSetMaxTriangles(McdTriangleListID g, int max) {
    McdTriangleListRecord *list = listOf(g, "McdTriangleListSetMaxTriangles");
    if (list && max < 1)
        MeWarning(1, "McdTriangleListSetMaxTriangles: max is %d (> 0)", max);
    else if (list)
        makeRoom(list, max);
}

void *MEAPI McdTriangleListGetUserData(McdTriangleListID g) {
    const McdTriangleListRecord *list = listOf(g, "McdTriangleListGetUserData");
    return list ? list->list.userData : 0;
}

void MEAPI McdTriangleListSetUserData(McdTriangleListID g, void *data) {
    McdTriangleListRecord *list = listOf(g, "McdTriangleListSetUserData");
    if (list)
        list->list.userData = data;
}

/* ---- the type's functions ------------------------------------------------------------------------------------------- */

static void support(const McdGeometry *g, const double direction[3], double point[3]) {
    const McdTriangleListRecord *list = (const McdTriangleListRecord *)g;
    mcd_boxSupport(list->min, list->max, direction, point);
}

MCD_DEFINE_GEOMETRY_TYPE(TriangleList, release)

void MEAPI McdTriangleListGetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius) {
    if (!mcd_geometryIs(g, kMcdGeometryTypeTriangleList, "McdTriangleListGetBSphere"))
        return;
    const McdTriangleListRecord *list = (const McdTriangleListRecord *)g;
    mcd_boxBSphere(list->min, list->max, center, radius);
}

MeI16 MEAPI McdTriangleListGetMassProperties(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 m, MeReal *volume) {
    (void)g;
    MeMatrix4TMMakeIdentity(relTM);
    memset(m, 0, sizeof(MeMatrix3));
    *volume = 0;
    return 0;
}

void MEAPI McdTriangleListDebugDraw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3]) {
    if (!mcd_geometryIs(g, kMcdGeometryTypeTriangleList, "McdTriangleListDebugDraw"))
        return;
    const McdTriangleListRecord *list = (const McdTriangleListRecord *)g;
    mcd_drawBox(tm, colour, list->min, list->max);
}

/* ---- triangles -------------------------------------------------------------------------------------------------------- */

/* Programs may have written another number. */
static void takeMaxCount(McdTriangleListRecord *list) {
    const int count = list->list.triangleMaxCount;
    if (count == list->room)
        return;
    if (count < 1)
        MeWarning(1, "McdTriangleList: triangleMaxCount is %d (> 0); it stays %d", count, list->room);
    if (count < 1 || !makeRoom(list, count))
        list->list.triangleMaxCount = list->room;
}

/* What the callback has near a point of the list's frame; never more than there is place for. */
static int find(McdTriangleListRecord *list, McdModelPair *p, const double centre[3], double radius) {
    MeVector3 pos = {(MeReal)centre[0], (MeReal)centre[1], (MeReal)centre[2]};
    double reach = radius; /* with what rounding takes from it */
    for (int i = 0; i < 3; i++)
        reach += fabs((double)pos[i] - centre[i]);
    if (!list->generate)
        return 0;
    takeMaxCount(list);
    const int count = list->generate(p, list->list.list, pos, mcd_roundUp(reach), list->room);
    if (count >= list->room && !list->hasWarned) {
        list->hasWarned = METRUE;
        MeWarning(2,
                  "McdTriangleList: the callback gave %d triangles, as many as there is place for: contacts may be "
                  "missing; raise McdTriangleListCreate's triangleMaxCount",
                  count);
    }
    return MeCLAMP(count, 0, list->room);
}

static MeBool cornersOf(const McdUserTriangle *t, double corner[3][3]) {
    for (int i = 0; i < 3; i++) {
        if (!t->vertices[i])
            return MEFALSE;
        for (int k = 0; k < 3; k++)
            corner[i][k] = (double)(*t->vertices[i])[k];
    }
    return METRUE;
}

static const double *normalOf(const McdUserTriangle *t, double normal[3]) {
    for (int k = 0; t->normal && k < 3; k++)
        normal[k] = (double)(*t->normal)[k];
    return t->normal ? normal : 0;
}

static void gather(McdMeshQuery *q) {
    McdTriangleListRecord *list = (McdTriangleListRecord *)mcd_record(q->pair->model2)->instance.geometry;
    double corner[3][3], normal[3];
    const int count = find(list, q->pair, q->ball, q->ballRadius);
    if (!mcd_meshReserve(q->mesh, count))
        return;
    for (int i = 0; i < count; i++) {
        const McdUserTriangle *t = &list->list.list[i];
        if (cornersOf(t, corner))
            mcd_meshAdd(q, (const double(*)[3])corner, normalOf(t, normal), (int)t->flags, t->triangleData);
    }
}

static int intersect(McdModelPair *p, McdIntersectResult *result) {
    McdTriangleListRecord *list = (McdTriangleListRecord *)mcd_record(p->model2)->instance.geometry;
    if (!mcd_geometryIs(&list->list.head, kMcdGeometryTypeTriangleList, "Mcd...TriangleListIntersect"))
        return 0;
    return mcd_meshIntersect(p, result, &list->mesh, gather);
}

/* ---- interactions ----------------------------------------------------------------------------------------------------- */

MCD_MESH_INTERACTIONS(TriangleList, intersect)

/* ---- line segments ------------------------------------------------------------------------------------------------------- */

static int MEAPI meetSegment(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,
                             McdLineSegIntersectResult *outOverlap) {
    const McdGeometryInstance *ins = &mcd_record(cm)->instance;
    McdTriangleListRecord *list = (McdTriangleListRecord *)ins->geometry;
    double from[3], to[3], middle[3], normal[3] = {0, 0, 1}, least = 2;
    if (!mcd_toLocal(mcd_const(ins->tm), inOrig, from) || !mcd_toLocal(mcd_const(ins->tm), inDest, to))
        return 0;
    double length = 0;
    for (int i = 0; i < 3; i++) {
        middle[i] = (from[i] + to[i]) / 2;
        length += (to[i] - from[i]) * (to[i] - from[i]);
    }
    McdModelPair pair;
    memset(&pair, 0, sizeof pair);
    pair.model1 = pair.model2 = cm;
    const int count = find(list, &pair, middle, sqrt(length) / 2);
    for (int i = 0; i < count; i++) {
        double corner[3][3], own[3], given[3], part, hit[3];
        const McdUserTriangle *t = &list->list.list[i];
        if (!cornersOf(t, corner) || !mcd_triangleNormal((const double(*)[3])corner, normalOf(t, given), own))
            continue;
        if (mcd_segmentTriangle((const double(*)[3])corner, own, (t->flags & kMcdTriangleTwoSided) != 0, from, to,
                                &part, hit) &&
            part < least) {
            least = part;
            memcpy(normal, hit, sizeof normal);
        }
    }
    return least <= 1 && mcd_segmentHit(mcd_const(ins->tm), inOrig, inDest, least, normal, outOverlap);
}

void MEAPI McdTriangleListLineSegmentRegisterInteraction(McdFramework *frame) {
    McdFrameworkSetLineSegInteraction(frame, kMcdGeometryTypeTriangleList, meetSegment);
}
