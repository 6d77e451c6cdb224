/* Crates: boxes along the world's axes, a geometry type of a program's own, and a space to put them in. For tests of
 * what depends on boxes alone. */
#ifndef CRATES_H
#define CRATES_H

#include "McdFrame.h"
#include "karma_test.h"

enum { CRATE = kMcdGeometryFirstUserType, CRATES = 400 };

typedef struct Crate {
    McdGeometry head;
    MeVector3 half;
} Crate;

typedef struct Yard {
    McdFrameworkID frame;
    McdSpaceID space;
    int count;
    McdModelID model[CRATES];
    McdGeometryID shape[CRATES];
    MeMatrix4 tm[CRATES];
    McdModelPairContainer *pairs;
} Yard;

static void MEAPI crateDestroy(McdGeometryID g) {
    MeMemoryAPI.destroy(g);
}

static const MeReal *halfOf(McdGeometryInstanceID ins) {
    return ((const Crate *)McdGeometryInstanceGetGeometry(ins))->half;
}

static void MEAPI crateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight) {
    const MeMatrix4Ptr tm = McdGeometryInstanceGetTransformPtr(ins);
    MeVector3 low, high;
    (void)tight;
    for (int i = 0; i < 3; i++) {
        const MeReal to = finalTM ? finalTM[3][i] : tm[3][i];
        low[i] = MeMIN(tm[3][i], to) - halfOf(ins)[i];
        high[i] = MeMAX(tm[3][i], to) + halfOf(ins)[i];
    }
    McdGeometryInstanceSetAABB(ins, low, high);
}

/* Where the segment enters the crate, by the slabs. */
static int MEAPI crateLineSegment(const McdModelID cm, MeReal *const from, MeReal *const to,
                                  McdLineSegIntersectResult *hit) {
    const MeMatrix4Ptr tm = McdModelGetTransformPtr(cm);
    const MeReal *half = halfOf(McdModelGetGeometryInstance(cm));
    double first = 0, last = 1, length = 0;
    for (int i = 0; i < 3; i++) {
        const double by = (double)to[i] - (double)from[i], start = (double)from[i] - (double)tm[3][i];
        length += by * by;
        if (by == 0 && fabs(start) > (double)half[i])
            return 0;
        if (by == 0)
            continue;
        const double a = (-(double)half[i] - start) / by, b = ((double)half[i] - start) / by;
        first = fmax(first, fmin(a, b));
        last = fmin(last, fmax(a, b));
    }
    if (first > last)
        return 0;
    hit->model = cm;
    hit->distance = (MeReal)(first * sqrt(length));
    MeVector3Set(hit->normal, 0, 0, 0);
    for (int i = 0; i < 3; i++)
        hit->position[i] = from[i] + (MeReal)first * (to[i] - from[i]);
    return 1;
}

static inline McdGeometryID crateCreate(McdFrameworkID frame, MeReal x, MeReal y, MeReal z) {
    Crate *c = MeMemoryAPI.create(sizeof *c);
    McdGeometryInit(&c->head, frame, CRATE);
    MeVector3Set(c->half, x / 2, y / 2, z / 2);
    return &c->head;
}

static inline void yardMakeWith(Yard *y, int axes, int objects, int pairs) {
    static char name[] = "crate";
    memset(y, 0, sizeof *y);
    y->frame = McdInit(1, CRATES, 0, 1);
    McdFrameworkRegisterGeometryType(y->frame, CRATE, name, crateDestroy, crateAABB, 0, 0, 0, 0);
    McdFrameworkSetLineSegInteraction(y->frame, CRATE, crateLineSegment);
    y->space = McdSpaceAxisSortCreate(y->frame, axes, objects, pairs);
    y->pairs = McdModelPairContainerCreate(10000);
}

static inline void yardMake(Yard *y) {
    yardMakeWith(y, McdAllAxes, CRATES, 10000);
}

static inline void yardDestroy(Yard *y) {
    McdSpaceDestroy(y->space);
    McdFrameworkDestroyAllModelsAndGeometries(y->frame);
    McdTerm(y->frame);
    McdModelPairContainerDestroy(y->pairs);
    y->frame = 0;
}

/* A crate of that size at a place, in no space; no contact tolerance. */
static inline McdModelID yardCrate(Yard *y, MeReal x, MeReal px, MeReal py, MeReal pz) {
    const int i = y->count++;
    y->shape[i] = crateCreate(y->frame, x, x, x);
    y->model[i] = McdModelCreate(y->shape[i]);
    MeMatrix4TMMakeIdentity(y->tm[i]);
    MeMatrix4TMSetPosition(y->tm[i], px, py, pz);
    McdModelSetTransformPtr(y->model[i], y->tm[i]);
    McdModelSetContactTolerance(y->model[i], 0);
    return y->model[i];
}

/* The same, in the space and updated. */
static inline McdModelID yardPut(Yard *y, MeReal size, MeReal px, MeReal py, MeReal pz) {
    const McdModelID m = yardCrate(y, size, px, py, pz);
    ck_assert(McdSpaceInsertModel(y->space, m));
    McdSpaceUpdateModel(m);
    return m;
}

static inline void yardMove(Yard *y, int i, MeReal px, MeReal py, MeReal pz) {
    MeMatrix4TMSetPosition(y->tm[i], px, py, pz);
    McdSpaceUpdateModel(y->model[i]);
}

/* Ends the block, gets the pairs of the step, begins the next block. */
static inline void yardStep(Yard *y) {
    McdSpacePairIterator it;
    McdSpaceEndChanges(y->space);
    McdSpacePairIteratorBegin(y->space, &it);
    ck_assert_int_eq(McdSpaceGetPairs(y->space, &it, y->pairs), 0);
}

/* How many pairs of each kind the step had. Does not begin the next block. */
#define assert_pairs(y, hello, staying, goodbye)                                                                       \
    do {                                                                                                               \
        ck_assert_int_eq(McdModelPairContainerGetHelloCount((y)->pairs), hello);                                       \
        ck_assert_int_eq(McdModelPairContainerGetStayingCount((y)->pairs), staying);                                   \
        ck_assert_int_eq(McdModelPairContainerGetGoodbyeCount((y)->pairs), goodbye);                                   \
    } while (0)
/* A step, its pairs, and the next block. */
#define assert_step(y, hello, staying, goodbye)                                                                        \
    do {                                                                                                               \
        yardStep(y);                                                                                                   \
        assert_pairs(y, hello, staying, goodbye);                                                                      \
        McdSpaceBeginChanges((y)->space);                                                                              \
    } while (0)

#endif
