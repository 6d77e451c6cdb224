/* Aggregates: their elements; box, bounding sphere and mass properties, computed from those of the elements. */
#include "McdAggregate.h"
#include "model/mcd_geometries_i.h"
#include "convex/mcd_kind_i.h"
#include "geometry/mcd_geometry_i.h"
#include <math.h>
#include <string.h>

static McdAggregate *aggregateOf(McdGeometryID g, const char *function) {
    return mcd_geometryIs(g, kMcdGeometryTypeAggregate, function) ? (McdAggregate *)g : 0;
}

static const MeMatrix4 identity = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

/* ---- creation, destruction --------------------------------------------------------------------------------------- */

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

/* ---- elements ---------------------------------------------------------------------------------------------------- */

/* Whether the aggregate `child` is the geometry g or, at any level, an element of it. */
static MeBool isChildOf(const McdAggregate *child, const McdGeometry *g) {
    if (g == &child->head)
        return METRUE;
    const McdAggregate *a = mcd_asAggregate(g);
    for (int i = 0; a && i < a->count; i++)
        if (isChildOf(child, a->element[i].geometry))
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
    if (isChildOf(a, geom)) {
        MeWarning(1, "McdAggregateAddElement: the aggregate would contain itself");
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

/* The element number i; null, with a warning, if there is none. */
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
    if (!mcd_mayChangeShapes(id->frame, "McdAggregateRemoveElement"))
        return;
    McdGeometryDecrementReferenceCount(element->geometry);
    a->count--;
    MEASSERT(i <= a->count && a->count < a->max);
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
    if (element) /* the program may write to it */
        mcd_geometryChanged(id);
    return element ? element->relTM : 0;
}

/* ---- parts of an instance ---------------------------------------------------------------------------------------- */

/* Visits a part; finalTM is null if none was given. */
typedef void (*ChildFn)(McdGeometryInstance *child, const MeMatrix4Ptr finalTM, void *data);

/* Visits all parts with a valid transform: the children of a model's instance or, for an instance without a model
 * (McdGeometry.h), temporary instances. */
static void forEachChild(McdGeometryInstance *ins, const MeMatrix4Ptr finalTM, ChildFn f, void *data) {
    const McdAggregate *a = (const McdAggregate *)ins->geometry;
    McdGeometryInstance *child = ins->firstChild;
    for (int i = 0; ins->model ? child != 0 : i < a->count; i++) {
        McdGeometryInstance made;
        const int number = ins->model ? child->element : i;
        MeMatrix4 tm, end;
        MEASSERT(number >= 0 && number < a->count);
        if (!ins->model) {
            memset(&made, 0, sizeof made);
            made.geometry = a->element[i].geometry;
            MeMatrix4TMCompound(tm, mcd_const(a->element[i].relTM), mcd_const(ins->tm));
            made.tm = tm;
        }
        if (finalTM)
            MeMatrix4TMCompound(end, mcd_const(a->element[number].relTM), mcd_const(finalTM));
        if (!ins->model)
            mcd_instanceEnter(&made);
        if (mcd_instanceIsPlaced(ins->model ? child : &made)) /* an element's transform may be invalid */
            f(ins->model ? child : &made, finalTM ? end : 0, data);
        if (!ins->model)
            mcd_instanceLeave(&made);
        child = ins->model ? child->nextSibling : 0;
    }
}

/* ---- extent ------------------------------------------------------------------------------------------------------ */

typedef struct Extent {
    MeVector3 min, max;
    MeBool isSet, tight;
} Extent;

static void addBox(McdGeometryInstance *child, const MeMatrix4Ptr finalTM, void *data) {
    Extent *e = data;
    if (!mcd_instanceUpdateAABB(child, finalTM, e->tight))
        return;
    for (int i = 0; i < 3; i++) {
        e->min[i] = e->isSet ? MeMIN(e->min[i], child->min[i]) : child->min[i];
        e->max[i] = e->isSet ? MeMAX(e->max[i], child->max[i]) : child->max[i];
    }
    e->isSet = METRUE;
}

/* For checks: whether the boxes of a model's parts are within the box of the whole. */
static MeBool areChildrenWithin(const McdGeometryInstance *ins, const Extent *e) {
    for (McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling)
        for (int i = 0; mcd_instanceIsPlaced(child) && i < 3; i++)
            if (child->min[i] < e->min[i] || child->max[i] > e->max[i])
                return MEFALSE;
    return METRUE;
}

void MEAPI McdAggregateUpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight) {
    if (!mcd_instanceIs(ins, kMcdGeometryTypeAggregate, "McdAggregateUpdateAABB"))
        return;
    Extent e = {{0, 0, 0}, {0, 0, 0}, MEFALSE, tight};
    const MeReal *place = mcd_instanceTM(ins)[3];
    forEachChild(ins, finalTM, addBox, &e);
    MEVALIDATE(areChildrenWithin(ins, &e));
    if (e.isSet)
        McdGeometryInstanceSetAABB(ins, e.min, e.max);
    else
        McdGeometryInstanceSetAABB(ins, place, place);
}

typedef struct Farthest {
    MeReal *direction, *point;
    double max;
    MeBool isSet;
} Farthest;

static void addPoint(McdGeometryInstance *child, const MeMatrix4Ptr finalTM, void *data) {
    Farthest *f = data;
    MeVector3 point;
    (void)finalTM;
    if (!mcd_instanceMaximumPoint(child, f->direction, point))
        return;
    double height = 0;
    for (int k = 0; k < 3; k++)
        height += (double)point[k] * (double)f->direction[k];
    if (f->isSet && !(height > f->max))
        return;
    f->isSet = METRUE;
    f->max = height;
    MeVector3Copy(f->point, point);
}

void MEAPI McdAggregateMaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir, MeReal *const outPoint) {
    if (!mcd_areGiven(__func__, inDir, outPoint, outPoint))
        return;
    MeVector3Set(outPoint, 0, 0, 0);
    if (!mcd_instanceIs(ins, kMcdGeometryTypeAggregate, "McdAggregateMaximumPoint"))
        return;
    Farthest f = {inDir, outPoint, 0, MEFALSE};
    MeVector3Copy(outPoint, mcd_instanceTM(ins)[3]);
    forEachChild(ins, 0, addPoint, &f);
}

typedef struct Ball {
    double centre[3], radius;
} Ball;

/* Computes the bounding sphere of element i in the aggregate's frame; false if the element has no valid transform. */
static MeBool ballOf(const McdAggregate *a, int i, Ball *ball) {
    const MeVector4 *tm = mcd_const(a->element[i].relTM);
    MeVector3 center;
    MeReal radius;
    double local[3];
    if (!mcd_isValidTransform(tm))
        return MEFALSE;
    McdGeometryGetBSphere(a->element[i].geometry, center, &radius);
    mcd_fromReal(local, center);
    for (int k = 0; k < 3; k++)
        ball->centre[k] = mcd_placedCoordinate(tm, local, k);
    ball->radius = (double)radius;
    return METRUE;
}

/* The smallest sphere around all elements' spheres with its centre at the centre of their bounding box. */
static Ball ballAroundBalls(const McdAggregate *a) {
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    Ball one, all = {{0, 0, 0}, 0};
    for (int i = 0; i < a->count; i++)
        for (int k = 0; ballOf(a, i, &one) && k < 3; k++) {
            low[k] = MeMIN(low[k], one.centre[k] - one.radius);
            high[k] = MeMAX(high[k], one.centre[k] + one.radius);
        }
    for (int k = 0; k < 3; k++)
        all.centre[k] = low[k] <= high[k] ? (double)mcd_clampReal(low[k] / 2 + high[k] / 2) : 0;
    for (int i = 0; i < a->count; i++)
        if (ballOf(a, i, &one))
            all.radius = MeMAX(all.radius, sqrt(mcd_distanceSquared(one.centre, all.centre)) + one.radius);
    return all;
}

static Ball ballAroundBox(McdGeometryID g) {
    MeVector3 low, high;
    Ball ball;
    McdGeometryGetAABB(g, identity, low, high);
    for (int k = 0; k < 3; k++)
        ball.centre[k] = (double)(low[k] / 2 + high[k] / 2);
    double corner[3];
    mcd_fromReal(corner, high);
    ball.radius = sqrt(mcd_distanceSquared(corner, ball.centre));
    return ball;
}

static MeReal boundingRadius(const McdGeometry *g, MeVector3 center) {
    Ball ball = ballAroundBalls((const McdAggregate *)g);
    const Ball other = ballAroundBox((McdGeometryID)g);
    if (((const McdAggregate *)g)->count && other.radius < ball.radius)
        ball = other;
    mcd_toReal(center, ball.centre);
    return mcd_clampReal(ball.radius);
}

/* ---- mass -------------------------------------------------------------------------------------------------------- */

/* inertia += volume (d.d 1 - d d^T) */
static void addParallelAxes(double inertia[3][3], double volume, const double d[3]) {
    const double square = mcd_dot(d, d);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            inertia[i][k] += volume * ((i == k ? square : 0) - d[i] * d[k]);
}

/* sum += R^T I R; the rows of R are the axes of I */
static void addRotated(double sum[3][3], const MeMatrix3 inertia, const MeMatrix4 tm) {
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++)
                    sum[i][k] += (double)tm[a][i] * (double)inertia[a][b] * (double)tm[b][k];
}

/* The mass properties of an element along its own axes; tm gets these axes in the aggregate's frame. False if it has
 * none. */
static MeBool massOf(const McdAggregateElement *element, MeMatrix4 tm, MeMatrix3 inertia, double *volume) {
    MeMatrix4 own;
    MeReal v;
    if (!McdGeometryGetMassProperties(element->geometry, own, inertia, &v) || !mcd_isValidTransform(element->relTM))
        return MEFALSE;
    MeMatrix4TMCompound(tm, mcd_const(own), element->relTM);
    *volume = (double)v;
    return METRUE;
}

static void addVolume(McdMass *sum, const McdAggregateElement *element) {
    MeMatrix4 tm;
    MeMatrix3 inertia;
    double volume;
    if (!massOf(element, tm, inertia, &volume))
        return;
    sum->volume += volume;
    for (int i = 0; i < 3; i++)
        sum->centre[i] += volume * (double)tm[3][i];
}

static void addInertia(McdMass *sum, const McdAggregateElement *element) {
    MeMatrix4 tm;
    MeMatrix3 inertia;
    double volume, arm[3];
    if (!massOf(element, tm, inertia, &volume))
        return;
    for (int i = 0; i < 3; i++)
        arm[i] = (double)tm[3][i] - sum->centre[i];
    addRotated(sum->inertia, (const MeVector3 *)inertia, mcd_const(tm));
    addParallelAxes(sum->inertia, volume, arm);
}

static void addMass(const McdGeometry *g, McdMass *sum) {
    const McdAggregate *a = (const McdAggregate *)g;
    for (int i = 0; i < a->count; i++)
        addVolume(sum, &a->element[i]);
    for (int i = 0; i < 3; i++)
        sum->centre[i] = sum->volume > 0 ? sum->centre[i] / sum->volume : 0;
    for (int i = 0; i < a->count; i++)
        addInertia(sum, &a->element[i]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < i; k++)
            sum->inertia[i][k] = sum->inertia[k][i] = (sum->inertia[i][k] + sum->inertia[k][i]) / 2;
}

/* ---- the type ---------------------------------------------------------------------------------------------------- */

static void draw(const McdGeometry *g, const MeMatrix4 tm, const MeReal colour[3]) {
    const McdAggregate *a = (const McdAggregate *)g;
    for (int i = 0; i < a->count; i++) {
        MeMatrix4 place;
        MeMatrix4TMCompound(place, mcd_const(a->element[i].relTM), tm);
        McdGeometryDebugDraw(a->element[i].geometry, place, colour);
    }
}

static const McdKind kind = {MCD_KIND_FUNCTIONS(Aggregate, release)};
MCD_DEFINE_TYPE(Aggregate, addMass)
