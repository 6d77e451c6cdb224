/* A program's own convex shapes: types whose functions are made from the program's support function. */
#include "McdConvexType.h"
#include "McdAggregate.h"
#include "convex/mcd_sampled_i.h"
#include "geometry/mcd_geometry_i.h"
#include "geometry/mcd_moments_i.h"
#include <stdalign.h>

typedef struct McdConvexRecord {
    McdGeometry head;
    McdSampled shape;
    MeU64 version; /* counts changes of the data, and of what they point to */
    alignas(max_align_t) unsigned char data[];
} McdConvexRecord;

static const McdConvexRecord *get(const McdGeometry *g) {
    return (const McdConvexRecord *)g;
}

/* ---- boxes, spheres, support points ------------------------------------------------------------------------------ */

/* The farthest point, with the rounding, in a direction of any length. */
static void support(const McdGeometry *g, const double d[3], double point[3]) {
    const McdSampled *s = &get(g)->shape;
    const double length = mcd_length(d);
    double n[3] = {0, 0, 1};
    if (length > 0 && length < INFINITY)
        mcd_scale(n, d, 1 / length);
    mcd_sampledCall(s, n, point);
    mcd_mad(point, point, s->rounding, n);
}

/* As mcd_localUpdateAABB, but for points that may be wrong. */
static void MEAPI updateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight) {
    MeVector3 min, max;
    (void)tight;
    for (int i = 0; i < 3; i++) {
        double low, high, finalLow, finalHigh;
        mcd_localExtent(ins->geometry, mcd_const(mcd_instanceTM(ins)), i, support, &low, &high);
        finalLow = low;
        finalHigh = high;
        if (finalTM)
            mcd_localExtent(ins->geometry, mcd_const(finalTM), i, support, &finalLow, &finalHigh);
        min[i] = mcd_roundDown(fmin(fmin(low, high), fmin(finalLow, finalHigh)));
        max[i] = mcd_roundUp(fmax(fmax(low, high), fmax(finalLow, finalHigh)));
    }
    McdGeometryInstanceSetAABB(ins, min, max);
}

static void MEAPI maximumPoint(McdGeometryInstanceID ins, MeReal *const inDir, MeReal *const outPoint) {
    mcd_localMaximumPoint(ins, inDir, outPoint, support);
}

static void MEAPI boundingSphere(const McdGeometryID g, MeVector3 center, MeReal *radius) {
    MeVector3Set(center, 0, 0, 0);
    *radius = mcd_roundUp(get(g)->shape.extent);
}

/* ---- mass -------------------------------------------------------------------------------------------------------- */

/* False, with a warning: the program's functions gave what no solid has. */
static MeBool isSolid(const McdSampled *s, const McdMass *mass, MeBool isInRange) {
    const MeBool isGood = isInRange && mcd_isInertiaGood(mass);
    if (!isGood)
        MeWarning(1,
                  "McdFrameworkRegisterConvexType: the mass properties of %s are not those of a solid: there are none",
                  s->type->name);
    return isGood;
}

typedef struct Solid {
    McdMoments moments; /* about `centre` */
    double centre[3];
} Solid;

static void addTriangle(void *context, const double corner[3][3]) {
    Solid *solid = context;
    double t[4][3] = {{0}}, n[3];
    for (int i = 0; i < 3; i++)
        mcd_sub(t[i], corner[i], solid->centre);
    mcd_cross(n, t[0], t[1]);
    mcd_momentsAddSimplex(&solid->moments, mcd_dot(n, t[2]) / 6, mcd_constRows(t), 4);
}

/* a + k b */
static void addMoments(McdMoments *a, double k, const McdMoments *b) {
    a->m += k * b->m;
    mcd_mad(a->first, a->first, k, b->first);
    for (int i = 0; i < 3; i++)
        mcd_mad(a->second[i], a->second[i], k, b->second[i]);
}

/* The polyhedron of support points is inside of the shape. On smooth surfaces its moments have errors of the square of
 * the grid's step, which the difference of two grids removes (Richardson); those of polyhedra are exact. */
static MeBool massOfSamples(const McdSampled *s, McdMass *mass) {
    Solid fine = {.centre = {0, 0, 0}}, coarse;
    double half[3];
    mcd_sampledBox(s, fine.centre, half);
    coarse = fine;
    mcd_sampledTriangles(s, half, MCD_GRID, addTriangle, &fine);
    mcd_sampledTriangles(s, half, MCD_GRID / 2, addTriangle, &coarse);
    McdMoments better = fine.moments;
    addMoments(&better, 1. / 3, &fine.moments);
    addMoments(&better, -1. / 3, &coarse.moments);
    const double min = 1e-9 * s->extent * s->extent * s->extent; /* less is a flat shape's rounding */
    if (!(better.m > min) || !isfinite(better.m))
        return MEFALSE;
    mcd_momentsMass(&better, fine.centre, mass);
    return isSolid(s, mass, METRUE);
}

static MeBool massOfProgram(const McdSampled *s, McdMass *mass) {
    const MeProgramCall before = MeProgramEnterQuiet("McdFrameworkRegisterConvexType");
    s->type->functions.mass(s->data, &mass->volume, mass->centre, mass->inertia);
    MeProgramLeave(&before);
    MeBool isInRange = mass->volume > 0 && mcd_isInRange3(mass->centre);
    for (int i = 0; i < 3; i++)
        isInRange = isInRange && mcd_isInRange3(mass->inertia[i]);
    return isSolid(s, mass, isInRange);
}

static MeI16 MEAPI massProperties(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 inertia, MeReal *volume) {
    const McdSampled *s = &get(g)->shape;
    McdMass mass = {.volume = 0};
    if (!(s->type->functions.mass ? massOfProgram : massOfSamples)(s, &mass))
        mass = (McdMass){.volume = 0};
    return mcd_massStore(&mass, relTM, inertia, volume);
}

/* ---- drawing ----------------------------------------------------------------------------------------------------- */

typedef struct Drawing {
    const MeVector4 *tm;
    const MeReal *colour;
} Drawing;

static void drawTriangle(void *context, const double corner[3][3]) {
    const Drawing *d = context;
    for (int i = 0; i < 3; i++)
        if (mcd_distanceSquared(corner[i], corner[(i + 1) % 3]) > 0)
            mcd_drawLine(d->tm, d->colour, corner[i], corner[(i + 1) % 3]);
}

static void MEAPI draw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3]) {
    enum { COUNT = 5 };
    Drawing d = {tm, colour};
    double centre[3], half[3];
    mcd_sampledBox(&get(g)->shape, centre, half);
    mcd_sampledTriangles(&get(g)->shape, half, COUNT, drawTriangle, &d);
}

/* ---- line segments ----------------------------------------------------------------------------------------------- */

/* The shape in its own frame, in double. */
static void ownShape(const McdGeometry *g, McdShape *s) {
    memset(s, 0, sizeof *s);
    mcd_shapeSizes((McdGeometryID)g, s);
    for (int i = 0; i < 3; i++)
        s->axis[i][i] = 1;
}

/* Advances from plane to plane: the plane through the shape's point nearest to a point of the line, orthogonal to the
 * direction between both, has the shape on its other side. */
static MeBool enterByDistances(const McdShape *s, const McdClip *c, double from, double *t, double normal[3]) {
    enum { STEPS = 100 };
    for (int i = 0; i < STEPS; i++) {
        double point[3];
        mcd_clipAt(c, from, point);
        const double gap = mcd_pointGap(s, point, normal), closing = -mcd_dot(normal, c->along);
        if (gap <= 1e-10 * s->extent) {
            *t = from;
            return METRUE;
        }
        if (!(closing > 0) || !(gap < INFINITY))
            return MEFALSE;
        from += gap / closing;
        if (from > 1)
            return MEFALSE;
    }
    *t = from;
    return METRUE;
}

static MeBool enterByProgram(const McdSampled *s, const McdClip *c, double *t, double normal[3]) {
    const MeProgramCall before = MeProgramEnterQuiet("McdFrameworkRegisterConvexType");
    const MeBool isHit = s->type->functions.ray(s->data, c->from, c->along, t, normal) != 0;
    MeProgramLeave(&before);
    return isHit && *t >= 0 && *t <= 1 && mcd_isInRange3(normal);
}

/* Only lines that begin outside have a normal; where they leave is not searched. */
static void clip(const McdGeometry *g, McdClip *c) {
    static const double centre[3] = {0, 0, 0};
    const McdSampled *sampled = &get(g)->shape;
    McdClip ball = *c;
    McdShape s;
    double t = 0, normal[3] = {0, 0, 1};
    mcd_clipBall(&ball, centre, sampled->extent);
    const double from = fmax(ball.in, 0);
    MeBool isHit = !mcd_clipIsEmpty(&ball) && from <= 1 && ball.out >= 0;
    if (isHit) {
        ownShape(g, &s);
        if (from == 0 && mcd_pointGap(&s, c->from, normal) <= 0)
            return; /* it begins inside */
        isHit = sampled->type->functions.ray ? enterByProgram(sampled, c, &t, normal)
                                             : enterByDistances(&s, c, from, &t, normal);
    }
    mcd_clipInterval(c, isHit ? t : HUGE_VAL, isHit ? HUGE_VAL : -HUGE_VAL, normal);
}

static int MEAPI lineSegment(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,
                             McdLineSegIntersectResult *outOverlap) {
    return mcd_localLineSegment(cm, inOrig, inDest, outOverlap, clip);
}

/* ---- the type ---------------------------------------------------------------------------------------------------- */

static void setShape(const McdGeometry *g, McdShape *s) {
    s->sampled = &get(g)->shape;
    s->rounding = s->sampled->rounding;
    s->extent = s->sampled->extent;
}

/* For McdGeometryUpdate: what the data point to may have changed. */
static void update(McdGeometry *g) {
    McdConvexRecord *record = (McdConvexRecord *)g;
    const McdSampled before = record->shape;
    if (!MeProgramMayChange("McdGeometryUpdate")) /* its own support function calls it */
        return;
    if (mcd_sampledMeasure(&record->shape)) {
        MeMemoryGive(before.features);
        record->version++;
        return;
    }
    record->shape = before;
    MeWarning(1, "McdGeometryUpdate: the support function of %s gives no shape now; the one before stays",
              before.type->name);
}

static void MEAPI release(McdGeometryID g) {
    MeMemoryGive(((McdConvexRecord *)g)->shape.features);
    MeMemoryGive(g);
}

static void fillKind(McdSampledType *type) {
    type->kind = (McdKind){.type = -1,
                           .size = sizeof(McdConvexRecord) + type->dataSize,
                           .destroy = release,
                           .box = updateAABB,
                           .sphere = boundingSphere,
                           .farthest = maximumPoint,
                           .mass = massProperties,
                           .draw = draw,
                           .setShape = setShape,
                           .support = mcd_sampledSupport,
                           .face = mcd_sampledFace,
                           .radius = mcd_sampledRadius,
                           .rim = mcd_sampledRim,
                           .isSampled = METRUE,
                           .update = update,
                           .rank = MCD_RANK_OTHER};
}

static McdSampledType *makeType(const char *name, size_t dataSize, const McdConvexFunctions *functions) {
    const char *const given = name ? name : "(no name)";
    McdSampledType *type =
        MeMemoryTakeZeroed(1, sizeof *type + strlen(given) + 1, "McdFrameworkRegisterConvexType", "a geometry type");
    if (!type)
        return 0;
    strcpy(type->name, given);
    type->functions = *functions;
    type->dataSize = dataSize;
    fillKind(type);
    return type;
}

static McdSampledType *typeOf(const McdFramework *frame, int number) {
    const McdKind *kind = number >= 0 && number < frame->typeCount ? frame->types[number].kind : 0;
    return kind && kind->isSampled ? (McdSampledType *)(void *)frame->types[number].ownKind : 0;
}

static MeBool areSame(const McdSampledType *type, const char *name, size_t dataSize, const McdConvexFunctions *f) {
    const McdConvexFunctions *own = &type->functions;
    return strcmp(type->name, name ? name : "(no name)") == 0 && type->dataSize == dataSize &&
           own->support == f->support && own->rounding == f->rounding && own->mass == f->mass && own->ray == f->ray;
}

static McdSampledType *findType(const McdFramework *frame, const char *name, size_t dataSize,
                                const McdConvexFunctions *functions) {
    for (int i = 0; i < frame->typeCount; i++) {
        McdSampledType *type = typeOf(frame, i);
        if (type && areSame(type, name, dataSize, functions))
            return type;
    }
    return 0;
}

static void registerInteractions(McdFramework *frame, const McdSampledType *type, const char *function) {
    mcd_kindRegisterInteractions(frame, &type->kind, function);
    McdFrameworkSetLineSegInteraction(frame, type->kind.type, lineSegment);
    if (McdFrameworkTypeIsRegistered(frame, kMcdGeometryTypeAggregate))
        McdAggregateGenericRegisterInteractions(frame);
}

int MEAPI McdFrameworkRegisterConvexType(McdFrameworkID frame, const char *typeName, size_t dataSize,
                                         const McdConvexFunctions *functions) {
    if (!mcd_frameCheck(frame, __func__) || !MeStageIsFree(&frame->stage, __func__))
        return 0;
    if (!functions || !functions->support || dataSize > (1u << 30)) {
        MeWarning(1, "%s: %s", __func__,
                  !functions            ? "functions is null"
                  : !functions->support ? "there is no support function: set functions->support"
                                        : "dataSize is larger than a gigabyte");
        return 0;
    }
    McdSampledType *type = findType(frame, typeName, dataSize, functions);
    if (!type) {
        type = makeType(typeName, dataSize, functions);
        type = type ? mcd_frameAddType(frame, &type->kind, type->name, __func__) : 0;
    }
    if (!type)
        return 0;
    registerInteractions(frame, type, __func__);
    return type->kind.type;
}

MeBool MEAPI McdFrameworkTypeIsConvex(McdFrameworkID frame, int typeId) {
    return mcd_frameCheck(frame, __func__) && typeOf(frame, typeId) != 0;
}

/* ---- shapes ------------------------------------------------------------------------------------------------------ */

/* Sets the data and what follows from them; false, with a warning: they give no shape. */
static MeBool setData(McdConvexRecord *record, const void *data, const char *function) {
    memmove(record->data, data, record->shape.type->dataSize); /* it may be the shape's own */
    if (mcd_sampledMeasure(&record->shape))
        return METRUE;
    MeWarning(1,
              "%s: the support function of %s, or its rounding, gives numbers that are not finite, or a shape without "
              "extent",
              function, record->shape.type->name);
    return MEFALSE;
}

McdGeometryID MEAPI McdConvexCreate(McdFrameworkID frame, int typeId, const void *data) {
    McdSampledType *type = mcd_frameCheck(frame, __func__) ? typeOf(frame, typeId) : 0;
    if (!type) {
        if (frame)
            MeWarning(1, "%s: %d is no type of McdFrameworkRegisterConvexType", __func__, typeId);
        return 0;
    }
    if (!data && type->dataSize > 0) {
        MeWarning(1, "%s: data is null: %s has %zu bytes of it", __func__, type->name, type->dataSize);
        return 0;
    }
    McdConvexRecord *record =
        mcd_geometryCreate(frame, (McdGeometryType)typeId, sizeof *record + type->dataSize, __func__);
    if (!record)
        return 0;
    record->shape.type = type;
    record->shape.data = record->data;
    if (setData(record, data ? data : "", __func__))
        return &record->head;
    mcd_geometryDestroy(&record->head);
    return 0;
}

static McdConvexRecord *recordOf(McdGeometryID g, const char *function) {
    if (!mcd_geometryType(g, function))
        return 0;
    if (mcd_kindOf(g) && mcd_kindOf(g)->isSampled)
        return (McdConvexRecord *)g;
    MeWarning(1, "%s: the geometry is a %s, not of a type of McdFrameworkRegisterConvexType", function,
              McdGeometryGetTypeName(g));
    return 0;
}

const void *MEAPI McdConvexGetData(McdGeometryID g) {
    const McdConvexRecord *record = recordOf(g, __func__);
    return record ? record->data : 0;
}

void MEAPI McdConvexSetData(McdGeometryID g, const void *data) {
    McdConvexRecord *record = recordOf(g, __func__);
    if (!record || !MeProgramMayChange(__func__) || !mcd_mayChangeShapes(g->frame, __func__))
        return;
    const size_t size = record->shape.type->dataSize;
    const McdSampled before = record->shape;
    void *old = MeMemoryTake(1, size + 1, __func__, "the data before");
    if (!old || (!data && size > 0)) {
        if (old)
            MeWarning(1, "%s: data is null: %s has %zu bytes of it", __func__, before.type->name, size);
        MeMemoryGive(old);
        return;
    }
    memcpy(old, record->data, size);
    if (setData(record, data ? data : old, __func__)) {
        MeMemoryGive(before.features);
    } else {
        memcpy(record->data, old, size);
        record->shape = before;
    }
    MeMemoryGive(old);
    record->version++;
    mcd_geometryMarkModels(g);
}
