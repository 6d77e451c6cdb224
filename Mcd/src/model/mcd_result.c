/* Converts manifolds to McdIntersectResult: margins, contacts, unique features, the mean normal. */
#include "convex/mcd_shape_i.h"
#include "convex/mcd_spread_i.h"
#include "convex/mcd_vector_i.h"
#include "model/mcd_result_i.h"

/* m: an upper bound of the approach of two models, with these velocities, before the next test. mayTurnRound: either
 * may rebound from others meanwhile, so relative velocity is no bound; then it is the sum of their travels. */
static double maxApproach(const McdModelRecord *a, const McdModelRecord *b, const MeReal *velocity1,
                          const MeReal *velocity2, MeBool mayTurnRound) {
    const double time = fmax((double)a->lookAhead, (double)b->lookAhead), max = (double)a->travel + (double)b->travel;
    double square = 0;
    if (!(max > 0) || mayTurnRound)
        return fmax(max, 0);
    for (int i = 0; i < 3; i++) {
        const double va = velocity1 ? (double)velocity1[i] : 0;
        const double vb = velocity2 ? (double)velocity2[i] : 0;
        square += (va - vb) * (va - vb);
    }
    return fmin(max, time * sqrt(square) + (double)a->turnTravel + (double)b->turnTravel);
}

/* Whether the impacts of the pair are predicted, so that it gets contacts of the current overlap only. */
static MeBool isTimed(const McdModelPair *p) {
    return !p->isWithinLargeIsland && mcd_areFast(mcd_record(p->model1), mcd_record(p->model2));
}

MeReal MEAPI McdModelPairGetFastMargin(const McdModelPair *p) {
    return MeMAX(mcd_record(p->model1)->fastMargin, mcd_record(p->model2)->fastMargin);
}

void MEAPI McdFrameworkSetFall(McdFrameworkID frame, const double fall[3]) {
    MEASSERT(frame);
    mcd_copy(frame->fall, fall);
}

/* The course of a model, or of a child of an aggregate, which turns with the whole. */
static void setCourse(const McdGeometryInstance *ins, double time, McdCourse *c) {
    const McdModelRecord *m = mcd_record(ins->model);
    const MeReal *at = ins->parent ? ins->placed[3] : ins->tm[3], *body = m->refTM ? m->refTM[3] : m->instance.tm[3];
    *c = (McdCourse){.isFree = m->linearVelocity != 0 && m->given == 0};
    for (int i = 0; i < 3; i++) {
        c->shift[i] = m->linearVelocity ? time * (double)m->linearVelocity[i] : 0;
        c->turn[i] = m->angularVelocity ? time * (double)m->angularVelocity[i] : 0;
        c->arm[i] = (double)body[i] - (double)at[i];
    }
    c->extent = ins->parent ? (double)m->reach : 0;
}

static void forecast(const McdReach *reach, McdForecast *f) {
    const McdModelRecord *a = mcd_record(reach->instance[0]->model), *b = mcd_record(reach->instance[1]->model);
    const double time = fmax((double)a->lookAhead, (double)b->lookAhead);
    for (int k = 0; k < 2; k++)
        setCourse(reach->instance[k], time, &f->course[k]);
    mcd_copy(f->fall, a->frame->fall);
}

static McdReach reachOf(const McdModelPair *p, const McdGeometryInstance *child1, const McdGeometryInstance *child2,
                        const MeReal *velocity1, const MeReal *velocity2) {
    const McdModelRecord *a = mcd_record(p->model1), *b = mcd_record(p->model2);
    if (isTimed(p))
        return (McdReach){.margin = (double)McdModelPairGetFastMargin(p)};
    const double approach = maxApproach(a, b, velocity1, velocity2, p->mayTurnRound);
    MEASSERT(a->tolerance >= 0 && b->tolerance >= 0 && !(approach < 0));
    return (McdReach){(double)a->tolerance + (double)b->tolerance + approach,
                      approach + mcd_length(a->frame->fall),
                      {child1, child2},
                      forecast};
}

McdReach mcd_pairReach(const McdModelPair *p) {
    const McdModelRecord *a = mcd_record(p->model1), *b = mcd_record(p->model2);
    return reachOf(p, &a->instance, &b->instance, a->linearVelocity, b->linearVelocity);
}

McdReach mcd_pairReachInRound(const McdModelPair *p) {
    const McdModelRecord *a = mcd_record(p->model1), *b = mcd_record(p->model2);
    return reachOf(p, &a->instance, &b->instance, a->inputs.velocity, b->inputs.velocity);
}

McdReach mcd_childReach(const McdModelPair *p, const McdGeometryInstance *child1, const McdGeometryInstance *child2) {
    MeVector3 memory[2];
    return reachOf(p, child1, child2, mcd_childVelocity(child1, memory[0]), mcd_childVelocity(child2, memory[1]));
}

void mcd_pairDisplacement(const McdModelPair *p, const double arm[3], double displacement[3]) {
    const McdModelRecord *a = mcd_record(p->model1), *b = mcd_record(p->model2);
    const double time = isTimed(p) ? 0 : fmax((double)a->lookAhead, (double)b->lookAhead);
    double spin[3] = {0, 0, 0}, turned[3];
    if (b->angularVelocity)
        mcd_fromReal(spin, b->angularVelocity);
    mcd_cross(turned, spin, arm);
    for (int i = 0; i < 3; i++)
        displacement[i] = time * ((a->linearVelocity ? (double)a->linearVelocity[i] : 0) -
                                  (b->linearVelocity ? (double)b->linearVelocity[i] : 0) - turned[i]);
}

MeBool mcd_resultHasRoom(const McdIntersectResult *result, const char *function) {
    if (result && result->contacts && result->contactMaxCount > 0)
        return METRUE;
    MeWarning(1, "%s: the result has no place for contacts: set contacts and contactMaxCount", function);
    return MEFALSE;
}

void mcd_resultBegin(McdIntersectResult *result, McdModelPair *p) {
    result->pair = p;
    result->contactCount = 0;
    result->touch = 0;
    result->apart = 0;
    MeVector3Set(result->normal, 0, 0, 0);
}

/* The finalizer of MurmurHash3, a bijection. */
static MeU64 mixBits(MeU64 x) {
    x ^= x >> 33;
    x *= 0xff51afd7ed558ccdull;
    x ^= x >> 33;
    x *= 0xc4ceb9fe1a85ec53ull;
    return x ^ x >> 33;
}

MeU32 mcd_featureMix(MeU32 feature, MeU32 component) {
    return (MeU32)mixBits((MeU64)component << 32 | feature);
}

MeU32 mcd_featureNumber(MeU64 feature) {
    const MeU32 a = (MeU32)(feature >> 32), b = (MeU32)feature;
    return a < 1u << 16 && b < 1u << 16 ? a << 16 | b : (MeU32)mixBits(feature);
}

/* Makes the feature ids of a result unique: of two equal hashes the later one is changed. */
static void makeFeaturesUnique(McdIntersectResult *result) {
    for (int i = 1; i < result->contactCount; i++)
        for (int k = 0; k < i; k++)
            if (result->contacts[k].feature == result->contacts[i].feature) {
                result->contacts[i].feature = mcd_featureMix(result->contacts[i].feature, 1);
                k = -1;
            }
}

/* Chooses the manifold's points to keep if there is not room for all; writes their ascending indices and returns
 * their number. */
static int choosePoints(const McdManifold *m, int room, int kept[MCD_MANIFOLD_POINTS]) {
    McdSpot spot[MCD_MANIFOLD_POINTS];
    for (int i = 0; i < m->count; i++)
        kept[i] = i;
    if (room >= m->count)
        return m->count;
    for (int i = 0; i < m->count; i++) {
        mcd_copy(spot[i].at, m->point[i].position);
        mcd_copy(spot[i].at + 3, m->normal);
        spot[i].separation = m->point[i].separation;
    }
    return mcd_spread(spot, m->count, room, 0, kept);
}

McdContact *mcd_resultAdd(McdIntersectResult *result, const McdManifold *m, const double origin[3],
                          McdGeometryInstanceID ins1, McdGeometryInstanceID ins2) {
    McdContact *first = &result->contacts[result->contactCount];
    int kept[MCD_MANIFOLD_POINTS];
    const int count = choosePoints(m, result->contactMaxCount - result->contactCount, kept);
    MEASSERT(m->count >= 0 && m->count <= MCD_MANIFOLD_POINTS && count <= m->count);
    MEASSERT(result->contactCount + count <= result->contactMaxCount);
    for (int i = 0; i < count; i++) {
        const McdManifoldPoint *point = &m->point[kept[i]];
        McdContact *c = &result->contacts[result->contactCount++];
        for (int k = 0; k < 3; k++) {
            c->exactPosition[k] = origin[k] + point->position[k];
            c->position[k] = mcd_clampReal(c->exactPosition[k]);
            c->normal[k] = (MeReal)m->normal[k];
        }
        c->separation = mcd_clampReal(point->separation);
        c->exactSeparation = point->separation;
        c->radius[0] = point->radius[0];
        c->radius[1] = point->radius[1];
        c->vertices = (point->isVertex[0] ? 1 : 0) | (point->isVertex[1] ? 2 : 0);
        c->edge[0] = c->edge[1] = c->edge[2] = 0;
        c->feature = mcd_featureNumber(point->feature);
        c->instance1 = ins1;
        c->instance2 = ins2;
        c->element1.ptr = c->element2.ptr = 0;
        c->dims = mcd_regionDims(m->count);
    }
    return count ? first : 0;
}

static MeBool hasUnitAxes(McdGeometryInstanceID ins) {
    const MeMatrix4Ptr tm = mcd_instanceTM(ins);
    for (int i = 0; i < 3; i++)
        if (!(MeFabs(MeVector3Dot(tm[i], tm[i]) - 1) < (MeReal)1e-4))
            return MEFALSE;
    return METRUE;
}

/* Whether the normal has length 1; not checked for transforms that are not rigid. */
static MeBool isNormalGood(const McdContact *c) {
    double n[3];
    mcd_fromReal(n, c->normal);
    return !hasUnitAxes(c->instance1) || !hasUnitAxes(c->instance2) || fabs(mcd_length(n) - 1) < 1e-3;
}

/* For checks: preconditions of contact response: finite numbers, unit normal, parts of the pair's models, and a
 * unique feature. */
static MeBool isContactGood(const McdIntersectResult *result, int i) {
    const McdContact *c = &result->contacts[i];
    for (int k = 0; k < i; k++)
        if (result->contacts[k].feature == c->feature)
            return MEFALSE;
    return mcd_areInRange(c->position, 3) && isNormalGood(c) && isfinite(c->exactSeparation) && c->radius[0] >= 0 &&
           c->radius[1] >= 0 && c->instance1->model == result->pair->model1 &&
           c->instance2->model == result->pair->model2;
}

/* For checks. Not where the program's functions may have changed the contacts, nor where models are so far away that
 * positions have too few digits to distinguish contacts. */
static MeBool areContactsGood(const McdIntersectResult *result) {
    const McdModelRecord *m[2] = {mcd_record(result->pair->model1), mcd_record(result->pair->model2)};
    for (int k = 0; k < 2; k++)
        if (m[k]->intersect || !(MeVector3Magnitude(m[k]->instance.max) < (MeReal)1e15))
            return METRUE;
    for (int i = 0; i < result->contactCount; i++)
        if (!isContactGood(result, i))
            return MEFALSE;
    return METRUE;
}

int mcd_resultEnd(McdIntersectResult *result) {
    MeReal sum[3] = {0, 0, 0};
    MEASSERT(result->contactCount >= 0 && result->contactCount <= result->contactMaxCount);
    if (!result->contactCount)
        return result->touch = 0;
    for (int i = 0; i < result->contactCount; i++)
        for (int k = 0; k < 3; k++)
            sum[k] += result->contacts[i].normal[k];
    const MeReal length = MeVector3Magnitude(sum);
    if (length > ME_SMALL_EPSILON)
        MeVector3MultiplyScalar(result->normal, sum, 1 / length);
    else /* the normals cancel: the first contact's */
        MeVector3Copy(result->normal, result->contacts[0].normal);
    makeFeaturesUnique(result);
    MEVALIDATE(areContactsGood(result));
    return result->touch = 1;
}
