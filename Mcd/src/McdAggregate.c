/* Aggregates: their elements; AABB, bounding sphere and mass properties of the whole from those of the elements. */
#include "McdAggregate.h"
#include "mcd_geometries_i.h"
#include "mcd_kind_i.h"
#include "mcd_local_i.h"
#include <math.h>
#include <string.h>

static McdAggregate *aggregateOf(McdGeometryID g, const char *function) {
    return mcd_geometryIs(g, kMcdGeometryTypeAggregate, function) ? (McdAggregate *)g : 0;
}

static const MeMatrix4 identity = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

/* ---- life -------------------------------------------------------------------------------------------------------- */

McdAggregateID MEAPI McdAggregateCreate(McdFramework *frame, int maxChildren) {
    if (maxChildren < 1) {
        MeWarning(1, "McdAggregateCreate: maxChildren is %d (> 0)", maxChildren);
        return 0;
    }
    McdAggregate *a = mcd_geometryCreate(frame, kMcdGeometryTypeAggregate, sizeof *a, "McdAggregateCreate");
    if (!a)
        return 0;
    a->element = MeMemoryTake((size_t)maxChildren, sizeof *a->element, "McdAggregateCreate", "elements");
    if (!a->element) {
        McdGeometryDestroy(&a->head);
        return 0;
    }
    a->max = maxChildren;
    return &a->head;
}

static void MEAPI release(McdGeometryID g) {
    McdAggregate *a = (McdAggregate *)g;
    for (int i = 0; i < a->count; i++)
        McdGeometryDecrementReferenceCount(a->element[i].geometry);
    MeMemoryGive(a->element);
    MeMemoryGive(a);
}

MCD_DEFINE_DESTROY(Aggregate)

/* ---- elements ---------------------------------------------------------------------------------------------------- */

static MeBool isPartOf(const McdAggregate *part, const McdGeometry *g) {
    if (g == &part->head)
        return METRUE;
    const McdAggregate *a = mcd_partsOf(g);
    for (int i = 0; a && i < a->count; i++)
        if (isPartOf(part, a->element[i].geometry))
            return METRUE;
    return MEFALSE;
}

int MEAPI McdAggregateAddElement(McdAggregateID id, McdGeometryID geom, MeMatrix4 relTM) {
    McdAggregate *a = aggregateOf(id, "McdAggregateAddElement");
    if (!a || !mcd_geometryType(geom, "McdAggregateAddElement"))
        return -1;
    if (a->count == a->max) {
        MeWarning(1, "McdAggregateAddElement: there are %d elements: raise McdAggregateCreate's maxChildren", a->max);
        return -1;
    }
    if (!mcd_geometryBelongs(geom, a->head.frame, "McdAggregateAddElement"))
        return -1;
    if (isPartOf(a, geom)) {
        MeWarning(1, "McdAggregateAddElement: the aggregate would be its own part");
        return -1;
    }
    McdAggregateElement *element = &a->element[a->count];
    element->geometry = geom;
    MeMatrix4Copy(element->relTM, relTM ? mcd_const(relTM) : identity);
    McdGeometryIncrementReferenceCount(geom);
    MEASSERT(a->count < a->max && geom->referenceCount > 0);
    mcd_geometryChanged(id);
    return a->count++;
}

/* The element; null, with a warning, if there is none of that number. */
static McdAggregateElement *elementOf(McdAggregateID id, int i, const char *function) {
    McdAggregate *a = aggregateOf(id, function);
    if (!a)
        return 0;
    if (i >= 0 && i < a->count)
        return &a->element[i];
    MeWarning(1, "%s: there is no element %d: there are %d", function, i, a->count);
    return 0;
}

void MEAPI McdAggregateRemoveElement(McdAggregateID id, int i) {
    const McdAggregateElement *element = elementOf(id, i, "McdAggregateRemoveElement");
    if (!element)
        return;
    McdAggregate *a = (McdAggregate *)id;
    if (a->head.referenceCount > 0) {
        MeWarning(1, "McdAggregateRemoveElement: %d models or aggregates use the aggregate", a->head.referenceCount);
        return;
    }
    McdGeometryDecrementReferenceCount(element->geometry);
    a->count--;
    memmove(&a->element[i], &a->element[i + 1], (size_t)(a->count - i) * sizeof *a->element);
}

int MEAPI McdAggregateGetElementCount(McdAggregateID id) {
    const McdAggregate *a = aggregateOf(id, "McdAggregateGetElementCount");
    return a ? a->count : 0;
}

int MEAPI McdAggregateGetElementCountMax(McdAggregateID id) {
    const McdAggregate *a = aggregateOf(id, "McdAggregateGetElementCountMax");
    return a ? a->max : 0;
}

McdGeometryID MEAPI McdAggregateGetElementGeometry(McdAggregateID id, int i) {
    const McdAggregateElement *element = elementOf(id, i, "McdAggregateGetElementGeometry");
    return element ? element->geometry : 0;
}

MeMatrix4Ptr MEAPI McdAggregateGetElementTransformPtr(McdAggregateID id, int i) {
    McdAggregateElement *element = elementOf(id, i, "McdAggregateGetElementTransformPtr");
    if (element) /* programs write to it */
        mcd_geometryChanged(id);
    return element ? element->relTM : 0;
}

/* ---- parts of an instance ---------------------------------------------------------------------------------------- */

/* Visits a part; finalTM is null if none was given. */
typedef void (*PartFn)(McdGeometryInstance *part, const MeMatrix4Ptr finalTM, void *data);

/* Visits all parts: children of a model's instance; of an instance without a model (McdGeometry.h) temporary ones. */
static void forEachPart(McdGeometryInstance *ins, const MeMatrix4Ptr finalTM, PartFn f, void *data) {
    const McdAggregate *a = (const McdAggregate *)ins->geometry;
    McdGeometryInstance *child = ins->firstChild;
    for (int i = 0; ins->model ? child != 0 : i < a->count; i++) {
        McdGeometryInstance made;
        const int number = ins->model ? child->element : i;
        MeMatrix4 tm, end;
        if (!ins->model) {
            memset(&made, 0, sizeof made);
            made.geometry = a->element[i].geometry;
            MeMatrix4TMCompound(tm, mcd_const(a->element[i].relTM), mcd_const(ins->tm));
            made.tm = tm;
        }
        if (finalTM)
            MeMatrix4TMCompound(end, mcd_const(a->element[number].relTM), mcd_const(finalTM));
        f(ins->model ? child : &made, finalTM ? end : 0, data);
        child = ins->model ? child->nextSibling : 0;
    }
}

/* ---- extent ------------------------------------------------------------------------------------------------------ */

typedef struct Extent {
    MeVector3 min, max;
    MeBool isSet, tight;
} Extent;

static void addBox(McdGeometryInstance *part, const MeMatrix4Ptr finalTM, void *data) {
    Extent *e = data;
    const McdTypeRecord *type = mcd_geometryType(part->geometry, "McdAggregateUpdateAABB");
    if (!type || !type->getAABB)
        return;
    type->getAABB(part, finalTM, e->tight);
    for (int i = 0; i < 3; i++) {
        e->min[i] = e->isSet ? MeMIN(e->min[i], part->min[i]) : part->min[i];
        e->max[i] = e->isSet ? MeMAX(e->max[i], part->max[i]) : part->max[i];
    }
    e->isSet = METRUE;
}

/* Are the boxes of a model's parts in that of the whole? */
static MeBool arePartsWithin(const McdGeometryInstance *ins, const Extent *e) {
    for (const McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling)
        for (int i = 0; i < 3; i++)
            if (child->min[i] < e->min[i] || child->max[i] > e->max[i])
                return MEFALSE;
    return METRUE;
}

void MEAPI McdAggregateUpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight) {
    if (!mcd_instanceIs(ins, kMcdGeometryTypeAggregate, "McdAggregateUpdateAABB"))
        return;
    Extent e = {{0, 0, 0}, {0, 0, 0}, MEFALSE, tight};
    const MeReal *place = mcd_instanceTM(ins)[3];
    forEachPart(ins, finalTM, addBox, &e);
    MEVALIDATE(arePartsWithin(ins, &e));
    if (e.isSet)
        McdGeometryInstanceSetAABB(ins, e.min, e.max);
    else
        McdGeometryInstanceSetAABB(ins, place, place);
}

typedef struct Farthest {
    MeReal *direction, *point;
    MeReal most;
    MeBool isSet;
} Farthest;

static void addPoint(McdGeometryInstance *part, const MeMatrix4Ptr finalTM, void *data) {
    Farthest *f = data;
    MeVector3 point;
    const McdTypeRecord *type = mcd_geometryType(part->geometry, "McdAggregateMaximumPoint");
    (void)finalTM;
    if (!type || !type->maximumPoint)
        return;
    type->maximumPoint(part, f->direction, point);
    const MeReal height = MeVector3Dot(point, f->direction);
    if (f->isSet && height <= f->most)
        return;
    f->isSet = METRUE;
    f->most = height;
    MeVector3Copy(f->point, point);
}

void MEAPI McdAggregateMaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir, MeReal *const outPoint) {
    if (!mcd_instanceIs(ins, kMcdGeometryTypeAggregate, "McdAggregateMaximumPoint"))
        return;
    Farthest f = {inDir, outPoint, 0, MEFALSE};
    MeVector3Copy(outPoint, mcd_instanceTM(ins)[3]);
    forEachPart(ins, 0, addPoint, &f);
}

/* The ball of element i in the aggregate's frame. */
static void ballOf(const McdAggregate *a, int i, MeVector3 centre, MeReal *radius) {
    MeVector3 local;
    McdGeometryGetBSphere(a->element[i].geometry, local, radius);
    MeMatrix4TMTransform(centre, mcd_const(a->element[i].relTM), local);
}

static MeReal ballAroundBalls(const McdAggregate *a, MeVector3 center) {
    MeVector3 c, low = {0, 0, 0}, high = {0, 0, 0};
    MeReal r, radius = 0;
    for (int i = 0; i < a->count; i++) { /* its middle is that of the balls' box */
        ballOf(a, i, c, &r);
        for (int k = 0; k < 3; k++) {
            low[k] = i ? MeMIN(low[k], c[k] - r) : c[k] - r;
            high[k] = i ? MeMAX(high[k], c[k] + r) : c[k] + r;
        }
    }
    for (int k = 0; k < 3; k++)
        center[k] = low[k] / 2 + high[k] / 2;
    for (int i = 0; i < a->count; i++) {
        ballOf(a, i, c, &r);
        radius = MeMAX(radius, MeVector3Distance(c, center) + r);
    }
    return radius;
}

static MeReal ballAroundBox(McdGeometryID g, MeVector3 center) {
    MeVector3 low, high;
    McdGeometryGetAABB(g, identity, low, high);
    for (int k = 0; k < 3; k++)
        center[k] = low[k] / 2 + high[k] / 2;
    return MeVector3Distance(high, center);
}

void MEAPI McdAggregateGetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius) {
    if (!mcd_geometryIs(g, kMcdGeometryTypeAggregate, "McdAggregateGetBSphere"))
        return;
    MeVector3 middle;
    *radius = ballAroundBalls((const McdAggregate *)g, center);
    const MeReal other = ballAroundBox(g, middle);
    if (((const McdAggregate *)g)->count && other < *radius) {
        MeVector3Copy(center, middle);
        *radius = other;
    }
}

/* ---- mass -------------------------------------------------------------------------------------------------------- */

typedef struct Mass {
    double volume, centre[3], inertia[3][3]; /* about the origin of the frame */
} Mass;

/* inertia += volume (d.d 1 - d d^T) */
static void addParallelAxes(double inertia[3][3], double volume, const double d[3]) {
    const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            inertia[i][k] += volume * ((i == k ? square : 0) - d[i] * d[k]);
}

/* sum += R^T I R, with the axes of I as rows of R */
static void addTurned(double sum[3][3], const MeMatrix3 inertia, const MeMatrix4 tm) {
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++)
                    sum[i][k] += (double)tm[a][i] * (double)inertia[a][b] * (double)tm[b][k];
}

static void addMass(Mass *sum, const McdAggregateElement *element) {
    MeMatrix4 own, tm;
    MeMatrix3 inertia;
    MeReal volume;
    if (!McdGeometryGetMassProperties(element->geometry, own, inertia, &volume))
        return;
    MeMatrix4TMCompound(tm, mcd_const(own), element->relTM);
    const double place[3] = {(double)tm[3][0], (double)tm[3][1], (double)tm[3][2]};
    sum->volume += (double)volume;
    for (int i = 0; i < 3; i++)
        sum->centre[i] += (double)volume * place[i];
    addTurned(sum->inertia, (const MeVector3 *)inertia, mcd_const(tm));
    addParallelAxes(sum->inertia, (double)volume, place);
}

MeI16 MEAPI McdAggregateGetMassProperties(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 m, MeReal *volume) {
    if (!mcd_geometryIs(g, kMcdGeometryTypeAggregate, "McdAggregateGetMassProperties"))
        return 0;
    const McdAggregate *a = (const McdAggregate *)g;
    Mass sum;
    memset(&sum, 0, sizeof sum);
    for (int i = 0; i < a->count; i++)
        addMass(&sum, &a->element[i]);
    MeMatrix4TMMakeIdentity(relTM);
    memset(m, 0, sizeof(MeMatrix3));
    *volume = (MeReal)sum.volume;
    if (!(sum.volume > 0))
        return 0;
    for (int i = 0; i < 3; i++) {
        sum.centre[i] /= sum.volume;
        relTM[3][i] = (MeReal)sum.centre[i];
    }
    addParallelAxes(sum.inertia, -sum.volume, sum.centre);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            m[i][k] = (MeReal)((sum.inertia[i][k] + sum.inertia[k][i]) / 2);
    MEASSERT(!(sum.inertia[0][0] < 0 || sum.inertia[1][1] < 0 || sum.inertia[2][2] < 0));
    return 1;
}

/* ---- the type ---------------------------------------------------------------------------------------------------- */

void MEAPI McdAggregateDebugDraw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3]) {
    if (!mcd_geometryIs(g, kMcdGeometryTypeAggregate, "McdAggregateDebugDraw"))
        return;
    const McdAggregate *a = (const McdAggregate *)g;
    for (int i = 0; i < a->count; i++) {
        MeMatrix4 place;
        MeMatrix4TMCompound(place, mcd_const(a->element[i].relTM), tm);
        McdGeometryDebugDraw(a->element[i].geometry, place, colour);
    }
}

MeI16 MEAPI McdAggregateGetTypeId(void) {
    return kMcdGeometryTypeAggregate;
}

char *MEAPI McdAggregateGetTypeName(McdGeometryID g) {
    (void)g;
    return (char *)"Aggregate";
}

static const McdKind kind = {MCD_KIND_FUNCTIONS(Aggregate, release)};

void MEAPI McdAggregateRegisterType(McdFramework *frame) {
    mcd_kindRegister(frame, &kind, "McdAggregateRegisterType");
}
