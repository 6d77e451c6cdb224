/* Continuous collision of models: the first impact of any of their parts and triangles (mcd_motion.c). */
#include "McdInteractions.h"
#include "McdInternal.h"
#include "convex/mcd_vector_i.h"
#include "model/mcd_geometries_i.h"
#include "model/mcd_motion_i.h"
#include "pair/mcd_pair_i.h"

/* A model's motion, relative to the pair's origin. */
typedef struct Motion {
    double centre[3], velocity[3], spin[3], acceleration[3], spinRate, bend; /* as of McdMover */
} Motion;

typedef struct Search {
    McdModelPair *pair;
    Motion motion[2];
    double origin[3];
    double margin, slow; /* as of McdApproach */
    McdNearParts near;
    MeBool isFalling;
    double whole, time; /* s, that is looked at; of the first impact so far */
} Search;

/* ---- motion ------------------------------------------------------------------------------------------------------ */

static void setMotion(Motion *m, const McdMotion *from, const double origin[3]) {
    mcd_fromReal(m->centre, from->centre);
    mcd_sub(m->centre, m->centre, origin);
    mcd_fromReal(m->velocity, from->velocity);
    mcd_fromReal(m->spin, from->spin);
    mcd_fromReal(m->acceleration, from->acceleration);
    m->spinRate = (double)from->spinRate;
    m->bend = 0;
}

/* The motion of one model as seen from the other, which is then at rest. If that one turns, with w, it is exact to
 * first order in time: the path bends by Coriolis' 2 w x v and the centrifugal w x (w x r). */
static Motion relativeMotion(const Motion *m, const Motion *other) {
    Motion relative = *m;
    double arm[3], velocity[3];
    mcd_sub(arm, m->centre, other->centre);
    mcd_cross(velocity, other->spin, arm);
    mcd_mad(velocity, velocity, 1, other->velocity);
    mcd_sub(relative.velocity, m->velocity, velocity);
    mcd_sub(relative.spin, m->spin, other->spin);
    mcd_sub(relative.acceleration, m->acceleration, other->acceleration);
    relative.spinRate = m->spinRate + other->spinRate;
    const double rate = mcd_length(other->spin);
    relative.bend = rate * (2 * mcd_length(relative.velocity) + rate * mcd_length(arm));
    return relative;
}

static void setMover(McdMover *mover, const McdShape *shape, const Motion *m) {
    mcd_moverInit(mover, shape, m->centre);
    mcd_copy(mover->velocity, m->velocity);
    mcd_copy(mover->spin, m->spin);
    mcd_copy(mover->acceleration, m->acceleration);
    mover->spinRate = m->spinRate;
    mover->bend = m->bend;
}

/* m: no point of the mover is farther from its pivot as that moves without acceleration. */
static double reachOf(const Search *s, const McdMover *m) {
    return m->arm + m->start.extent + (mcd_length(m->acceleration) + m->bend) * s->whole * s->time / 2;
}

static McdApproach approachOf(const Search *s, double extent) {
    return (McdApproach){.touch = MCD_TOUCH * extent,
                         .margin = s->margin,
                         .slow = s->slow,
                         .time = s->whole,
                         .isFalling = s->isFalling,
                         .near = s->near};
}

static void keepFirst(Search *s, const McdApproach *a, double from, double to) {
    s->time = mcd_impactTime(a, from, to, s->time);
}

/* ---- two convex shapes, a convex shape and a half-space ---------------------------------------------------------- */

/* Whether bounding spheres show that the shapes cannot be near within the time. */
static MeBool areTooFar(const Search *s, const McdMover *a, const McdMover *b) {
    double between[3], speed[3];
    mcd_sub(between, b->pivot, a->pivot);
    mcd_sub(speed, b->velocity, a->velocity);
    return mcd_length(between) - mcd_length(speed) * s->time > reachOf(s, a) + reachOf(s, b) + s->margin;
}

static void impactOfShapes(Search *s, const McdShape *a, const McdShape *b) {
    McdApproach approach = approachOf(s, MeMIN(a->extent, b->extent));
    setMover(&approach.shape, a, &s->motion[0]);
    setMover(&approach.other, b, &s->motion[1]);
    if (!areTooFar(s, &approach.shape, &approach.other))
        keepFirst(s, &approach, 0, s->time);
}

/* side: which of the models the shape belongs to; also below. */
static void impactOnPlane(Search *s, int side, const McdShape *shape, McdGeometryInstance *plane) {
    McdApproach approach = approachOf(s, shape->extent);
    const Motion m = relativeMotion(&s->motion[side], &s->motion[!side]);
    approach.isHalfSpace = METRUE;
    mcd_halfSpaceAt(mcd_const(mcd_instanceTM(plane)), s->origin, approach.normal, &approach.offset);
    setMover(&approach.shape, shape, &m);
    keepFirst(s, &approach, 0, s->time);
}

/* ---- triangles --------------------------------------------------------------------------------------------------- */

typedef struct Sweep {
    Search *search;
    McdApproach approach;
    McdMeshPath path;
} Sweep;

/* Whether the shape stays on one side of the triangle's plane during the piece, beyond the margin. */
static MeBool staysOnOneSide(const Sweep *w, const McdMeshTriangle *t) {
    const McdMover *m = &w->approach.shape;
    const double reach = reachOf(w->search, m) + w->approach.margin, speed = mcd_dot(m->velocity, t->normal);
    const double height = mcd_heightOver(m->pivot, t->corner[0], t->normal);
    const double start = height + speed * w->path.from, end = height + speed * w->path.to;
    return (start > reach && end > reach) || (start < -reach && end < -reach);
}

static void impactOnTriangle(Sweep *w, const McdMeshTriangle *t) {
    McdShape triangle;
    if (w->path.from > w->search->time || staysOnOneSide(w, t))
        return;
    w->approach.front = t->flags & kMcdTriangleTwoSided ? NULL : t->normal;
    mcd_triangleShape(t->corner, &triangle);
    mcd_moverInit(&w->approach.other, &triangle, triangle.place);
    keepFirst(w->search, &w->approach, w->path.from, MeMIN(w->path.to, w->search->time));
    w->path.last = w->search->time;
}

static void impactOnTriangles(void *sweep, McdMeshTriangle t[], int count) {
    for (int i = 0; i < count; i++)
        impactOnTriangle(sweep, &t[i]);
}

static void impactOnSurface(Search *s, int side, const McdShape *shape, McdGeometryInstance *surface) {
    Sweep w = {.search = s, .approach = approachOf(s, shape->extent), .path = {.last = s->time}};
    const Motion m = relativeMotion(&s->motion[side], &s->motion[!side]);
    setMover(&w.approach.shape, shape, &m);
    const double reach = reachOf(s, &w.approach.shape) + s->margin;
    for (int i = 0; i < 3; i++) {
        w.path.low[i] = m.centre[i] - reach;
        w.path.high[i] = m.centre[i] + reach;
        w.path.by[i] = m.velocity[i];
    }
    mcd_meshForEachAlong(surface, side ? s->pair->model2 : s->pair->model1, s->origin, &w.path, impactOnTriangles, &w);
}

/* ---- parts ------------------------------------------------------------------------------------------------------- */

/* Two parts whose types interact by functions of the program. */
static void impactByProgram(Search *s, McdGeometryInstance *a, McdGeometryInstance *b) {
    McdStandIn standIn[2];
    McdSafeTimeResult safe;
    McdModelPair pair = *s->pair;
    pair.model1 = mcd_standInBegin(&standIn[0], a);
    pair.model2 = mcd_standInBegin(&standIn[1], b);
    pair.m_cachedData = 0;
    if (McdSafeTime(&pair, (MeReal)s->time, &safe) && safe.time > 0)
        s->time = MeMIN(s->time, (double)safe.time);
    mcd_standInEnd(pair.model1, a);
    mcd_standInEnd(pair.model2, b);
}

/* A part that is a half-space or a surface, or has none of our shapes. */
static void impactOfWide(Search *s, int side, const McdShape *shape, McdGeometryInstance *other) {
    if (mcd_isSurface(other))
        impactOnSurface(s, side, shape, other);
    else if (mcd_isHalfSpace(other))
        impactOnPlane(s, side, shape, other);
}

static void impactOfLeaves(Search *s, McdGeometryInstance *a, McdGeometryInstance *b) {
    McdShape shape[2];
    if (!mcd_instanceIsPlaced(a) || !mcd_instanceIsPlaced(b))
        return;
    if (!mcd_typesAreBuiltIn(a->geometry->frame, a->geometry->type, b->geometry->type)) {
        impactByProgram(s, a, b);
        return;
    }
    const MeBool isConvex[2] = {mcd_shapeOf(a, s->origin, &shape[0]), mcd_shapeOf(b, s->origin, &shape[1])};
    if (isConvex[0] && isConvex[1])
        impactOfShapes(s, &shape[0], &shape[1]);
    else if (isConvex[0])
        impactOfWide(s, 0, &shape[0], b);
    else if (isConvex[1])
        impactOfWide(s, 1, &shape[1], a);
}

static void impactOfInstances(Search *s, McdGeometryInstance *a, McdGeometryInstance *b) {
    if (a->firstChild)
        for (McdGeometryInstance *child = a->firstChild; child; child = child->nextSibling)
            impactOfInstances(s, child, b);
    else if (b->firstChild)
        for (McdGeometryInstance *child = b->firstChild; child; child = child->nextSibling)
            impactOfInstances(s, a, child);
    else
        impactOfLeaves(s, a, b);
}

MeReal MEAPI McdModelPairImpactTime(McdModelPair *p, const McdMotion motion[2], MeReal maxTime, McdNearParts near) {
    McdModelRecord *a = mcd_record(p->model1), *b = mcd_record(p->model2);
    const double ahead = fmax((double)a->lookAhead, (double)b->lookAhead);
    const double margin = mcd_areFast(a, b) ? mcd_pairReach(p).margin : (double)a->tolerance + (double)b->tolerance;
    Search s = {.pair = p, .margin = margin, .near = near, .whole = (double)maxTime, .time = (double)maxTime};
    MEASSERT(maxTime >= 0);
    if (!mcd_modelIsPlaced(a) || !mcd_modelIsPlaced(b))
        return maxTime; /* it keeps its old box, and the pair with that */
    s.slow = margin / ahead;
    mcd_pairOrigin(&a->instance, &b->instance, s.origin);
    setMotion(&s.motion[0], &motion[0], s.origin);
    setMotion(&s.motion[1], &motion[1], s.origin);
    for (int i = 0; i < 3; i++)
        s.isFalling = s.isFalling || s.motion[0].acceleration[i] != s.motion[1].acceleration[i];
    impactOfInstances(&s, &a->instance, &b->instance);
    MEASSERT(s.time >= 0);
    return MeMIN((MeReal)s.time, maxTime);
}
