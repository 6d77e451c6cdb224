/* How interactions fill a McdIntersectResult. */
#include "mcd_shape.h"
#include "mcd_spread.h"
#include "mcd_vector.h"

/* How much the gap of two models may shrink before they are asked again. */
static double approach(const McdModelRecord *a, const McdModelRecord *b) {
    const double time = fmax((double)a->lookAhead, (double)b->lookAhead), most = (double)a->ahead + (double)b->ahead;
    double square = 0;
    if (!(most > 0))
        return 0;
    for (int i = 0; i < 3; i++) {
        const double va = a->linearVelocity ? (double)a->linearVelocity[i] : 0;
        const double vb = b->linearVelocity ? (double)b->linearVelocity[i] : 0;
        square += (va - vb) * (va - vb);
    }
    return fmin(most, time * sqrt(square) + (double)a->turnAhead + (double)b->turnAhead);
}

double mcd_pairMargin(const McdModelPair *p) {
    const McdModelRecord *a = mcd_record(p->model1), *b = mcd_record(p->model2);
    if (a->isFast || b->isFast) /* what is there now: what comes, McdSafeTime says */
        return fmax(a->isFast ? (double)a->ahead : 0, b->isFast ? (double)b->ahead : 0);
    return (double)a->tolerance + (double)b->tolerance + approach(a, b);
}

void mcd_resultBegin(McdIntersectResult *result, McdModelPair *p) {
    result->pair = p;
    result->contactCount = 0;
    result->touch = 0;
    MeVector3Set(result->normal, 0, 0, 0);
}

MeU32 mcd_featureMix(MeU32 feature, MeU32 part) {
    return (feature ^ part) * 0x9e3779b1u + (feature >> 15);
}

/* Which of the manifold's points there is place for, as ascending indices; returns how many. */
static int choose(const McdManifold *m, int place, int kept[MCD_MANIFOLD_POINTS]) {
    McdSpot spot[MCD_MANIFOLD_POINTS];
    for (int i = 0; i < m->count; i++) {
        kept[i] = i;
        mcd_copy(spot[i].position, m->point[i].position);
        mcd_copy(spot[i].normal, m->normal);
        spot[i].separation = m->point[i].separation;
    }
    return place >= m->count ? m->count : mcd_spread(spot, m->count, place, 0, kept);
}

void mcd_resultAdd(McdIntersectResult *result, const McdManifold *m, const double origin[3], McdGeometryInstanceID ins1,
                   McdGeometryInstanceID ins2, int element1, int element2) {
    int kept[MCD_MANIFOLD_POINTS];
    const int count = choose(m, result->contactMaxCount - result->contactCount, kept);
    for (int i = 0; i < count; i++) {
        const McdManifoldPoint *point = &m->point[kept[i]];
        McdContact *c = &result->contacts[result->contactCount++];
        for (int k = 0; k < 3; k++) {
            c->position[k] = (MeReal)(origin[k] + point->position[k]);
            c->normal[k] = (MeReal)m->normal[k];
        }
        c->separation = (MeReal)point->separation;
        c->feature = point->feature;
        c->instance1 = ins1;
        c->instance2 = ins2;
        c->element1 = element1;
        c->element2 = element2;
    }
}

int mcd_resultEnd(McdIntersectResult *result) {
    MeVector3 sum = {0, 0, 0};
    for (int i = 0; i < result->contactCount; i++)
        MeVector3Add(sum, sum, result->contacts[i].normal);
    const MeReal length = MeVector3Magnitude(sum);
    if (length > ME_SMALL_EPSILON)
        MeVector3MultiplyScalar(result->normal, sum, 1 / length);
    else if (result->contactCount) /* they cancel: the first stands for them */
        MeVector3Copy(result->normal, result->contacts[0].normal);
    result->touch = result->contactCount > 0;
    return result->touch;
}
