/* Interactions of aggregates: a mid phase over pairs of parts, each tested by the interaction of the parts' types. */
#include "McdAggregate.h"
#include "pair/mcd_compound_i.h"
#include "model/mcd_geometries_i.h"
#include "convex/mcd_kind_i.h"
#include "pair/mcd_pair_i.h"
#include <string.h>

/* ---- pairs of parts ---------------------------------------------------------------------------------------------- */

/* An iteration over all pairs of parts of two models. */
typedef struct ChildPairs ChildPairs;
struct ChildPairs {
    McdModelPair *pair;
    MeReal margin; /* m: pairs of parts whose boxes are farther apart are skipped; negative: none are skipped */
    void (*visit)(ChildPairs *, McdModelPair *childPair, McdGeometryInstance *child1, McdGeometryInstance *child2);
    /* As `visit`, for two convex parts with the library's interaction: without stand-in models. May be null. Returns
     * false if it does not support the pair: then `visit` is called. */
    MeBool (*visitConvex)(ChildPairs *, McdGeometryInstance *child1, McdGeometryInstance *child2);
    MeReal minGap; /* m: a lower bound of the gap over all pairs of parts so far; 0: unknown */
    void *data;
};

/* Whether two boxes are within the margin. The gap of boxes farther apart bounds the gap of the parts from below. */
static MeBool areNear(ChildPairs *m, const McdGeometryInstance *a, const McdGeometryInstance *b) {
    MeReal gap = -MEINFINITY;
    for (int i = 0; i < 3 && m->margin >= 0; i++)
        gap = MeMAX(gap, MeMAX(a->min[i] - b->max[i], b->min[i] - a->max[i]));
    if (m->margin < 0 || !(gap > m->margin))
        return METRUE;
    m->minGap = MeMIN(m->minGap, gap);
    return MEFALSE;
}

static MeBool isAggregate(const McdGeometryInstance *ins) {
    return mcd_asAggregate(ins->geometry) != 0;
}

static MeBool areConvex(const McdGeometryInstance *a, const McdGeometryInstance *b) {
    return mcd_isConvex(a) && mcd_isConvex(b) &&
           mcd_typesAreBuiltIn(a->geometry->frame, a->geometry->type, b->geometry->type);
}

static void visitChildPair(ChildPairs *m, McdGeometryInstance *a, McdGeometryInstance *b) {
    McdStandIn standIn[2];
    MEASSERT(!a->firstChild && !b->firstChild && a->model == m->pair->model1 && b->model == m->pair->model2);
    if (m->visitConvex && areConvex(a, b) && m->visitConvex(m, a, b))
        return;
    McdModelPair childPair = *m->pair;
    childPair.model1 = mcd_standInBegin(&standIn[0], a);
    childPair.model2 = mcd_standInBegin(&standIn[1], b);
    childPair.m_cachedData = 0;
    McdHello(&childPair);
    m->visit(m, &childPair, a, b);
    McdGoodbye(&childPair);
    mcd_standInEnd(childPair.model1, a);
    mcd_standInEnd(childPair.model2, b);
}

/* Visits all pairs of parts, in the order of the elements. */
static void visitChildPairsOf(ChildPairs *m, McdGeometryInstance *a, McdGeometryInstance *b) {
    if (!areNear(m, a, b))
        return;
    if (isAggregate(a))
        for (McdGeometryInstance *child = a->firstChild; child; child = child->nextSibling)
            visitChildPairsOf(m, child, b);
    else if (isAggregate(b))
        for (McdGeometryInstance *child = b->firstChild; child; child = child->nextSibling)
            visitChildPairsOf(m, a, child);
    else
        visitChildPair(m, a, b);
}

static void visitAllChildPairs(ChildPairs *m) {
    visitChildPairsOf(m, &mcd_record(m->pair->model1)->instance, &mcd_record(m->pair->model2)->instance);
}

/* ---- contacts ---------------------------------------------------------------------------------------------------- */

typedef struct Gathering {
    McdScratch *scratch; /* contains the contacts */
    int count;
    int maxPerPair; /* maximum number of contacts of two parts */
} Gathering;

/* A hash of a part's path in its model: the index of the element at each level. */
static MeU32 childPath(const McdGeometryInstance *child) {
    MeU32 path = 0;
    for (; child->parent; child = child->parent)
        path = mcd_featureMix(path, (MeU32)child->element + 1);
    MEASSERT(child == &mcd_record(child->model)->instance);
    return path;
}

void mcd_mixChildPaths(McdIntersectResult *result, int first, const McdGeometryInstance *child1,
                       const McdGeometryInstance *child2) {
    const MeU32 path = first < result->contactCount ? mcd_featureMix(childPath(child1), childPath(child2)) : 0;
    for (int i = first; i < result->contactCount; i++)
        result->contacts[i].feature = mcd_featureMix(result->contacts[i].feature, path);
}

/* Prepares a result whose contacts are appended to the gathered ones; false: there is no memory. */
static MeBool beginResult(Gathering *g, McdIntersectResult *result) {
    if (!mcd_scratchReserveContacts(g->scratch, g->count, g->count + g->maxPerPair))
        return MEFALSE;
    memset(result, 0, sizeof *result);
    result->contacts = g->scratch->contact + g->count;
    result->contactMaxCount = g->maxPerPair;
    return METRUE;
}

static void appendResult(Gathering *g, McdIntersectResult *result, McdGeometryInstance *child1,
                         McdGeometryInstance *child2) {
    mcd_mixChildPaths(result, 0, child1, child2);
    for (int i = 0; i < result->contactCount; i++) {
        result->contacts[i].instance1 = child1;
        result->contacts[i].instance2 = child2;
    }
    g->count += result->contactCount;
    MEASSERT(g->count <= g->scratch->contactRoom);
}

static void gatherContacts(ChildPairs *m, McdModelPair *childPair, McdGeometryInstance *child1,
                           McdGeometryInstance *child2) {
    McdIntersectResult result;
    m->minGap = 0;
    if (beginResult(m->data, &result) && mcd_intersect(childPair, &result))
        appendResult(m->data, &result, child1, child2);
}

static MeBool gatherConvexContacts(ChildPairs *m, McdGeometryInstance *child1, McdGeometryInstance *child2) {
    McdIntersectResult result;
    if (McdModelPairGetRequestPtr(m->pair)->faceNormalsFirst)
        return MEFALSE;
    if (!beginResult(m->data, &result))
        return METRUE;
    if (!mcd_convexInstances(child1, child2, mcd_childReach(m->pair, child1, child2), &result))
        return MEFALSE;
    m->minGap = MeMIN(m->minGap, result.apart); /* 0 if there are contacts */
    appendResult(m->data, &result, child1, child2);
    return METRUE;
}

static int MEAPI intersect(McdModelPair *p, McdIntersectResult *result) {
    McdFramework *frame = mcd_record(p->model1)->frame;
    Gathering g = {mcd_scratchAcquire(frame, "McdIntersect"), 0, MeMAX(result->contactMaxCount, 1)};
    ChildPairs m = {p, (MeReal)mcd_pairReach(p).margin, gatherContacts, gatherConvexContacts, MEINFINITY, &g};
    mcd_resultBegin(result, p);
    if (!g.scratch)
        return 0;
    visitAllChildPairs(&m);
    g.count = mcd_dropInternalContacts(p, g.scratch, g.count);
    McdContact *found = g.scratch->contact;
    if (g.count > result->contactMaxCount)
        g.count = mcd_simplify(found, g.count, found, result->contactMaxCount, 0, 1e-6 * (double)frame->lengthScale,
                               g.scratch->choice);
    MEASSERT(g.count >= 0 && g.count <= result->contactMaxCount);
    if (g.count)
        memcpy(result->contacts, found, (size_t)g.count * sizeof *result->contacts);
    result->contactCount = g.count;
    result->apart = m.minGap < MEINFINITY ? m.minGap : 0;
    mcd_scratchRelease(frame, g.scratch);
    return mcd_resultEnd(result);
}

/* ---- safe time --------------------------------------------------------------------------------------------------- */

static void keepEarliest(ChildPairs *m, McdModelPair *childPair, McdGeometryInstance *child1,
                         McdGeometryInstance *child2) {
    McdSafeTimeResult *best = m->data, here;
    (void)child1;
    (void)child2;
    if (McdSafeTime(childPair, best->time, &here) && here.time < best->time)
        *best = here;
}

static int MEAPI safeTime(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result) {
    ChildPairs m = {p, -1, keepEarliest, 0, 0, result};
    result->time = maxTime;
    visitAllChildPairs(&m);
    MEASSERT(result->time >= 0 && result->time <= maxTime);
    result->pair = p;
    return 1;
}

/* ---- line segments ----------------------------------------------------------------------------------------------- */

static int firstHitOfInstance(McdGeometryInstance *ins, MeReal *from, MeReal *to, McdLineSegIntersectResult *best,
                              int hits) {
    if (isAggregate(ins)) {
        for (McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling)
            hits = firstHitOfInstance(child, from, to, best, hits);
        return hits;
    }
    McdStandIn s;
    McdLineSegIntersectResult here;
    const McdModelID child = mcd_standInBegin(&s, ins);
    const MeBool isHit = mcd_lineSegIntersect(child, from, to, &here);
    mcd_standInEnd(child, ins);
    if (!isHit || (hits && here.distance >= best->distance))
        return hits;
    here.instance = ins;
    *best = here;
    return 1;
}

static int MEAPI intersectSegment(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,
                                  McdLineSegIntersectResult *outOverlap) {
    const int hits = firstHitOfInstance(&mcd_record(cm)->instance, inOrig, inDest, outOverlap, 0);
    outOverlap->model = cm;
    return hits;
}

void MEAPI McdAggregateLineSegmentRegisterInteraction(McdFramework *frame) {
    ME_UNDER_OWN_NAME(McdFrameworkSetLineSegInteraction(frame, kMcdGeometryTypeAggregate, intersectSegment));
}

/* ---- registration ------------------------------------------------------------------------------------------------ */

MeBool MEAPI McdAggregateGenericRegisterInteractions(McdFrameworkID frame) {
    McdInteractions interactions = {0, 0, intersect, safeTime};
    if (!mcd_frameCheck(frame, "McdAggregateGenericRegisterInteractions"))
        return MEFALSE;
    for (int type = 0; type < frame->typeCount; type++)
        if (type != kMcdGeometryTypeNull && !McdFrameworkGetInteractions(frame, kMcdGeometryTypeAggregate, type) &&
            !McdFrameworkGetInteractions(frame, type, kMcdGeometryTypeAggregate))
            mcd_interactionRegister(frame, kMcdGeometryTypeAggregate, type, &interactions);
    return METRUE;
}

void MEAPI McdAggregateRegisterInteractions(McdFrameworkID frame) {
    ME_UNDER_OWN_NAME(if (McdAggregateGenericRegisterInteractions(frame))
                          McdAggregateLineSegmentRegisterInteraction(frame));
}
