/* Triangle lists: a box, and a callback of the program that returns the triangles near a point. */
#include "McdTriangleList.h"
#include "model/mcd_geometries_i.h"
#include "convex/mcd_kind_i.h"
#include "geometry/mcd_geometry_i.h"
#include "surface/mcd_scratch_i.h"
#include <math.h>
#include <string.h>

static McdTriangleListRecord *listOf(McdGeometryID g, const char *function) {
    return mcd_geometryIs(g, kMcdGeometryTypeTriangleList, function) ? (McdTriangleListRecord *)g : 0;
}

/* ---- creation -------------------------------------------------------------------------------- */

static MeBool isBox(const MeReal *min, const MeReal *max) {
    for (int i = 0; min && max && i < 3; i++)
        if (!(min[i] <= max[i]))
            return MEFALSE;
    return min && max && mcd_areInRange(min, 3) && mcd_areInRange(max, 3);
}

/* Allocates the array that the callback fills; false if there is no memory. */
static MeBool reserveTriangles(McdTriangleListRecord *list, int count) {
    MEASSERT(count >= 1);
    /* zeroed, for callbacks that do not set triangleData */
    McdUserTriangle *generated =
        MeMemoryTakeZeroed((size_t)count, sizeof *generated, "McdTriangleListCreate", "triangles");
    if (!generated)
        return MEFALSE;
    MeMemoryGive(list->list.list);
    list->list.list = generated;
    list->list.triangleMaxCount = list->room = count;
    atomic_store(&list->hasWarned, 0);
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
    if (!reserveTriangles(list, triangleMaxCount)) {
        McdGeometryDestroy(&list->list.head);
        return 0;
    }
    MeVector3Copy(list->min, min);
    MeVector3Copy(list->max, max);
    list->generate = f;
    return &list->list.head;
}

static void MEAPI release(McdGeometryID g) {
    McdTriangleListRecord *list = (McdTriangleListRecord *)g;
    MeMemoryGive(list->list.list);
    MeMemoryGive(list);
}

/* ---- accessors ------------------------------------------------------------------------------- */

void MEAPI McdTriangleListGetBoundingBox(McdTriangleListID g, MeVector3 min, MeVector3 max) {
    if (!mcd_areGiven(__func__, min, max, max))
        return;
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
    else if (list && mcd_mayChangeShapes(list->list.head.frame, "McdTriangleListSetMaxTriangles"))
        reserveTriangles(list, max);
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

/* ---- the type's functions ---------------------------------------------------------------------------------------- */

static void support(const McdGeometry *g, const double direction[3], double point[3]) {
    const McdTriangleListRecord *list = (const McdTriangleListRecord *)g;
    mcd_boxSupport(list->min, list->max, direction, point);
}

static MeReal boundingRadius(const McdGeometry *g, MeVector3 center) {
    const McdTriangleListRecord *list = (const McdTriangleListRecord *)g;
    return mcd_boxBSphere(list->min, list->max, center);
}

static void draw(const McdGeometry *g, const MeMatrix4 tm, const MeReal colour[3]) {
    const McdTriangleListRecord *list = (const McdTriangleListRecord *)g;
    mcd_drawBox(tm, colour, list->min, list->max);
}

/* ---- triangles --------------------------------------------------------------------------------------------------- */

/* Resizes the array if the program has written another triangleMaxCount; restores that if it is bad. */
static void applyMaxCount(McdTriangleListRecord *list) {
    const int count = list->list.triangleMaxCount;
    if (count == list->room)
        return;
    if (count < 1)
        MeWarning(1, "McdTriangleList: triangleMaxCount is %d (> 0); it stays %d", count, list->room);
    if (count < 1 || !reserveTriangles(list, count))
        list->list.triangleMaxCount = list->room;
}

/* The triangles that the callback returned. */
typedef struct Generated {
    McdUserTriangle *triangle; /* room for `room` triangles */
    int count, room;
    MeBool isOwn; /* the list's array, which programs see; else the scratch's */
} Generated;

/* Acquires the array for the callback to fill: the list's own or, while another query uses that (in another thread,
 * or an enclosing one), the scratch's. False if there is no memory. */
static MeBool acquireArray(McdTriangleListRecord *list, McdScratch *scratch, Generated *generated) {
    *generated = (Generated){.isOwn = !atomic_exchange_explicit(&list->isInUse, 1, memory_order_acquire)};
    if (generated->isOwn) {
        applyMaxCount(list);
        generated->room = list->room;
        generated->triangle = list->list.list;
        return METRUE;
    }
    generated->room = list->list.triangleMaxCount < 1 ? list->room : list->list.triangleMaxCount;
    if (mcd_scratchReserveTriangles(scratch, generated->room))
        generated->triangle = scratch->triangle;
    return generated->triangle != 0;
}

static void releaseArray(McdTriangleListRecord *list, const Generated *generated) {
    MEASSERT(!generated->isOwn || atomic_load_explicit(&list->isInUse, memory_order_relaxed));
    if (generated->isOwn)
        atomic_store_explicit(&list->isInUse, 0, memory_order_release);
    else if (generated->triangle) /* zeros for the next callback, which need not set all members */
        memset(generated->triangle, 0, (size_t)generated->room * sizeof *generated->triangle);
}

/* Calls the callback for the triangles near a point of the list's frame; at most as many as there is room for.
 * releaseArray must follow. */
static void callGenerator(McdTriangleListRecord *list, McdModelPair *p, McdScratch *scratch, const double centre[3],
                          double radius, Generated *generated) {
    MeVector3 pos;
    mcd_toReal(pos, centre);
    double reach = radius; /* plus the rounding of the centre */
    for (int i = 0; i < 3; i++)
        reach += fabs((double)pos[i] - centre[i]);
    if (!acquireArray(list, scratch, generated) || !list->generate)
        return;
    McdFramework *frame = list->list.head.frame;
    MeStageBegin(&frame->stage, MCD_GUARD_SHAPES);
    const MeProgramCall before = MeProgramEnter("McdTriangleListSetGenerator");
    const int count = list->generate(p, generated->triangle, pos, mcd_roundUp(reach), generated->room);
    MeProgramLeave(&before);
    MeStageEnd(&frame->stage, MCD_GUARD_SHAPES);
    if (count >= generated->room && !atomic_exchange(&list->hasWarned, 1))
        MeWarning(2,
                  "McdTriangleList: the callback gave %d triangles, as many as there is place for: contacts may be "
                  "missing; raise McdTriangleListCreate's triangleMaxCount",
                  count);
    generated->count = MeCLAMP(count, 0, generated->room);
}

static MeBool cornersOf(const McdUserTriangle *t, double corner[3][3]) {
    for (int i = 0; i < 3; i++) {
        if (!t->vertices[i])
            return MEFALSE;
        mcd_fromReal(corner[i], *t->vertices[i]);
    }
    return METRUE;
}

static const double *normalOf(const McdUserTriangle *t, double normal[3]) {
    if (!t->normal)
        return 0;
    mcd_fromReal(normal, *t->normal);
    return normal;
}

static void gather(McdMeshQuery *q) {
    McdTriangleListRecord *list = (McdTriangleListRecord *)mcd_record(q->pair->model2)->instance.geometry;
    double corner[3][3], normal[3];
    Generated generated;
    callGenerator(list, q->pair, q->scratch, q->ball, q->ballRadius, &generated);
    const int count = mcd_meshReserve(q->mesh, generated.count) ? generated.count : 0;
    for (int i = 0; i < count; i++) {
        const McdUserTriangle *t = &generated.triangle[i];
        if (cornersOf(t, corner))
            mcd_meshAdd(q, mcd_constRows(corner), normalOf(t, normal), (int)t->flags, 0, t->triangleData);
    }
    releaseArray(list, &generated);
}

static const McdKind kind = {MCD_KIND_FUNCTIONS(TriangleList, release), .gather = gather, .callsProgram = METRUE,
                             .isStatic = METRUE};
MCD_DEFINE_GEOMETRY_TYPE(TriangleList, mcd_addNoMass)

/* ---- interactions ------------------------------------------------------------------------------------------------ */

MCD_MESH_INTERACTIONS(TriangleList)

/* ---- line segments ----------------------------------------------------------------------------------------------- */

/* Intersects a segment with the triangles. Returns the fraction of the segment at its first hit, with the normal and
 * the triangle's data; above 1: no hit. */
static double firstHit(const Generated *generated, const double from[3], const double to[3], double normal[3],
                       McdElementData *element) {
    double min = 2;
    MEASSERT(generated->count >= 0 && generated->count <= generated->room);
    for (int i = 0; i < generated->count; i++) {
        double corner[3][3], own[3], given[3], fraction, hit[3];
        const McdUserTriangle *t = &generated->triangle[i];
        if (!cornersOf(t, corner) || !mcd_triangleNormal(mcd_constRows(corner), normalOf(t, given), own))
            continue;
        if (mcd_segmentTriangle(mcd_constRows(corner), own, (t->flags & kMcdTriangleTwoSided) != 0, from, to, &fraction,
                                hit) &&
            fraction < min) {
            min = fraction;
            *element = t->triangleData;
            memcpy(normal, hit, sizeof hit);
        }
    }
    return min;
}

static int MEAPI intersectSegment(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,
                                  McdLineSegIntersectResult *outOverlap) {
    const McdGeometryInstance *ins = &mcd_record(cm)->instance;
    McdTriangleListRecord *list = (McdTriangleListRecord *)ins->geometry;
    McdFramework *frame = list->list.head.frame;
    double from[3], to[3], middle[3], normal[3] = {0, 0, 1}, length = 0;
    McdModelPair pair;
    Generated generated;
    if (!mcd_toLocal(mcd_const(ins->tm), inOrig, from) || !mcd_toLocal(mcd_const(ins->tm), inDest, to))
        return 0;
    for (int i = 0; i < 3; i++) {
        middle[i] = (from[i] + to[i]) / 2;
        length += (to[i] - from[i]) * (to[i] - from[i]);
    }
    McdScratch *scratch = mcd_scratchAcquire(frame, "McdLineSegIntersect");
    if (!scratch)
        return 0;
    memset(&pair, 0, sizeof pair);
    pair.model1 = pair.model2 = cm;
    callGenerator(list, &pair, scratch, middle, sqrt(length) / 2, &generated);
    const double min = firstHit(&generated, from, to, normal, &outOverlap->element);
    releaseArray(list, &generated);
    mcd_scratchRelease(frame, scratch);
    return min <= 1 && mcd_writeSegmentHit(mcd_const(ins->tm), inOrig, inDest, min, normal, outOverlap);
}

void MEAPI McdTriangleListLineSegmentRegisterInteraction(McdFramework *frame) {
    ME_UNDER_OWN_NAME(McdFrameworkSetLineSegInteraction(frame, kMcdGeometryTypeTriangleList, intersectSegment));
}
