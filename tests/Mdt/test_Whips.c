/* Chains of light links with stops and a heavy end, which swings them into their stops: what such a step costs. */
#include "scene.h"
#include <math.h>

enum { MAX_LINKS = 14 };

static const double length = .5; /* m, of a link; each has 1 kg */

typedef struct {
    int links;
    double degrees; /* of a stop, to each side; the first joint's are at 1.5 rad */
    double end;     /* kg, of the last link */
    double rate;    /* Hz */
} Whip;

typedef void Join(MdtWorldID w, MdtBodyID link, MdtBodyID before, double x, double stop);

static void joinByHinge(MdtWorldID w, MdtBodyID link, MdtBodyID before, double x, double stop) {
    MdtLimitID limit = MdtHingeGetLimit(scene_hinge(w, link, before, x, 0, 0, 0, 0, 1));
    for (int side = 0; side < 2; side++) {
        MdtSingleLimitID s = side ? MdtLimitGetUpperLimit(limit) : MdtLimitGetLowerLimit(limit);
        MdtSingleLimitSetStop(s, side ? stop : -stop);
        MdtSingleLimitSetRestitution(s, 0);
    }
    MdtLimitActivateLimits(limit, METRUE);
}

/* Lets it go level, for three seconds. Returns the largest number of factorizations of a step. */
static int swingWhip(const Whip *whip, Join *join) {
    const double edge[3] = {length, .2 * length, .2 * length};
    MdtWorldID w = scene_open(MAX_LINKS, MAX_LINKS, 9.81);
    MdtBodyID before = 0;
    int max = 0;
    MdtWorldSetEpsilon(w, 0);
    MdtWorldEnableReport(w);
    for (int i = 0; i < whip->links; i++) {
        const double mass = i == whip->links - 1 ? whip->end : 1;
        MdtBodyID link = scene_box(w, mass, edge, (i + .5) * length, 0, 0);
        join(w, link, before, i * length, i == 0 ? 1.5 : whip->degrees * 3.14159265358979 / 180);
        before = link;
    }
    for (int step = 0; step < 3 * whip->rate; step++) {
        MdtReport report;
        MdtWorldStep(w, (MeReal)(1 / whip->rate));
        MdtWorldGetReport(w, &report);
        ck_assert_int_eq(report.fallbacks, 0);
        assert_below(report.jointGap, 1e-5);
        max = report.factorizations > max ? report.factorizations : max;
    }
    MdtWorldDestroy(w);
    return max;
}

/* All stops are pressed at once: no pass may leave most of the error to the next. */
TEST(a_heavy_end_that_meets_stops_does_not_divide_the_step_again_and_again) {
    static const Whip whips[] = {
        {8, 3, 1e4, 60}, {8, 8, 1e4, 240}, {8, 3, 1e5, 30}, {14, 2, 1e4, 60}, {4, 20, 1e4, 120}};
    for (int k = 0; k < 5; k++) {
        const int max = swingWhip(&whips[k], joinByHinge);
        assert_below(max, 300);
    }
}
