/* What rag dolls cost that fall on a plane and come to lie, in factorizations, and how exact they are meanwhile. Box3D
 * opens their necks by 6e-4 m. */
#include "universe.h"
#include "ragdoll.h"

#ifdef TEST_IS_SLOW
enum { DOLLS = 2, STEPS = 60 };
#else
enum { DOLLS = 10, STEPS = 180 };
#endif

enum { DEAR = 100 }; /* factorizations */

static Doll doll[DOLLS];

static double between(double from, double to) {
    static unsigned int seed = 1;
    seed = seed * 1664525u + 1013904223u;
    return from + (to - from) * (seed >> 8) / (1 << 24);
}

/* Thrown and turning in any way, far from each other. */
static void makeDolls(void) {
    static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, -9.81, 0);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldEnableReport(u->world);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), .5, 0);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
    for (int i = 0; i < DOLLS; i++) {
        const double feet[3] = {7. * i, between(.05, 1), 0};
        double v[3], w[3];
        for (int k = 0; k < 3; k++)
            v[k] = between(-2, 2), w[k] = between(-3, 3);
        doll_make(&doll[i], u, feet);
        doll_throw(&doll[i], v, w);
    }
}

typedef struct Cost {
    double sum;
    int max, dear, inexact; /* dear: steps of more than DEAR */
} Cost;

static void note(Cost *cost) {
    MdtReport r;
    for (int i = 0; i < MdtWorldGetReportCount(u->world); i++) {
        ck_assert(MdtWorldGetPartitionReport(u->world, i, &r));
        cost->sum += r.factorizations;
        cost->max = r.factorizations > cost->max ? r.factorizations : cost->max;
        cost->dear += r.factorizations > DEAR;
        cost->inexact += r.fallbacks > 0;
    }
}

TEST(dolls_that_fall_cost_few_factorizations_and_stay_together) {
    Cost cost = {0};
    double open = 0, overrun = 0;
    makeDolls();
    for (int i = 0; i < STEPS; i++) {
        MstUniverseStep(u, 1. / 60);
        note(&cost);
        for (int k = 0; k < DOLLS; k++) {
            open = fmax(open, doll_opening(&doll[k]));
            overrun = fmax(overrun, doll_overrun(&doll[k]));
        }
    }
    printf("%.1f factorizations of a doll's step, %d at most, more than %d in %d steps; joints open by %.1e m, limits "
           "overrun by %.1e rad\n",
           cost.sum / (DOLLS * STEPS), cost.max, DEAR, cost.dear, open, overrun);
    assert_below(cost.sum, 20 * DOLLS * STEPS);
    ck_assert_int_le(100 * cost.dear, 2 * DOLLS * STEPS);
    ck_assert_int_le(1000 * cost.inexact, DOLLS * STEPS); /* contacts that may stick or slip: no answer settles */
    assert_below(open, 5e-5);
    assert_below(overrun, .02);
}
