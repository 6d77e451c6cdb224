/* What a heap of boxes costs in a universe while it falls and settles: the way and the time of each step, and what
 * swept models (MstUniverse's continuous motion) add where nothing is fast.
 *
 *     heap [--boxes N] [--steps N] [--side M] [--budget W] [--exact] [--awake] [--swept]
 *
 * 300 boxes, 900 steps, 4 m, a budget of 200 if not given. Boxes of 1 m and 1 kg, turned any way, fall onto each other
 * on M m by M m; epsilon 0, the friction cone, steps of 1/60 s, and the solver may take W million multiplications a
 * partition's step (MdtWorldSetWorkBudget); with --exact it is the exact one (MdtWorldSetSolver). With --awake nothing
 * is put to sleep. `outside` is everything but the solve: collision, contacts, partitions, rows, integration. Every
 * hundred steps are told by themselves, with the depths and the energy at their end. With --swept, the same heap again,
 * all of it swept, in the same run, step by step in turn. */
#include "timing.h"

#include "MdtReport.h"
#include "Mst.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct Heap {
    MstUniverseID universe;
    double *times, *outside; /* s: of a step, and of all in it but the solve */
    MdtReport report;        /* of the last step */
    int steps, inexact, rested;
    double worst; /* m/s, residual of an inexact step */
} Heap;

static double randomFrom(unsigned int *seed, double low, double high) {
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(*seed >> 8) / (1 << 24);
}

static void setContacts(MstUniverseID u) {
    MdtContactParamsID p = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetType(p, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(p, MdtFrictionModelCone);
    MdtContactParamsSetFrictionCoeffecient(p, (MeReal)0.5);
}

static MstUniverseID makeUniverse(int boxes) {
    static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    sizes.dynamicBodiesMaxCount = (unsigned int)boxes;
    sizes.collisionModelsMaxCount = (unsigned int)boxes + 1;
    sizes.collisionPairsMaxCount = 40 * (unsigned int)boxes + 100;
    sizes.dynamicConstraintsMaxCount = 60 * (unsigned int)boxes + 100;
    const MstUniverseID u = MstUniverseCreate(&sizes);
    if (!u)
        abort();
    MdtWorldSetGravity(u->world, 0, (MeReal)-9.81, 0);
    MdtWorldSetEpsilon(u->world, 0);
    MdtWorldEnableReport(u->world);
    setContacts(u);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
    return u;
}

static Heap makeHeap(int boxes, int steps, int side, double budget, MeBool isSwept) {
    Heap h = {.universe = makeUniverse(boxes),
              .times = calloc((size_t)steps, sizeof(double)),
              .outside = calloc((size_t)steps, sizeof(double)),
              .rested = -1};
    const McdGeometryID cube = McdBoxCreate(h.universe->frame, 1, 1, 1);
    const int layer = MeMAX(side * side / 4, 1);
    unsigned int seed = 1;
    if (!h.times || !h.outside)
        abort();
    MdtWorldSetWorkBudget(h.universe->world, (MeReal)budget);
    for (int i = 0; i < boxes; i++) {
        const McdModelID m = MstModelAndBodyCreate(h.universe, cube, 1);
        MeReal q[4];
        const double x = randomFrom(&seed, -.5, .5) * side, z = randomFrom(&seed, -.5, .5) * side;
        for (int k = 0; k < 4; k++)
            q[k] = (MeReal)randomFrom(&seed, -.5, .5);
        McdModelDynamicsSetPosition(m, (MeReal)x, (MeReal)(2 + 1.2 * (i / layer)), (MeReal)z);
        McdModelDynamicsSetQuaternion(m, q[0], q[1], q[2], q[3]);
        McdModelSetSwept(m, isSwept);
    }
    return h;
}

enum { STRETCH = 100 }; /* steps */

/* Mean and largest overlap, m. */
static void measureDepths(const Heap *h, double *mean, double *max) {
    int count = 0;
    *mean = *max = 0;
    for (MdtBodyID b = MdtBodyGetFirst(h->universe->world); b; b = MdtBodyGetNext(b))
        for (MdtContactID c = MdtBodyGetFirstContact(b); c; c = MdtBodyGetNextContact(b, c), count++) {
            const double depth = fmax((double)MdtContactGetPenetration(c), 0);
            *mean += depth;
            *max = fmax(*max, depth);
        }
    *mean /= count > 0 ? count : 1;
}

static void tellStretch(const Heap *h) {
    double times[STRETCH], outside[STRETCH], sum = 0, mean, max;
    const int from = h->steps - STRETCH;
    memcpy(times, h->times + from, sizeof times);
    memcpy(outside, h->outside + from, sizeof outside);
    for (int i = 0; i < STRETCH; i++)
        sum += times[i];
    measureDepths(h, &mean, &max);
    const double middle = median(times, STRETCH), middleOutside = median(outside, STRETCH);
    printf(
        "to %5d  mean %.3f ms, median %.3f ms, outside %.3f ms, worst %.1f ms; overlaps %.3g m on average, %.3g m at "
        "most; %.3g J; %d awake\n",
        h->steps, 1e3 * sum / STRETCH, 1e3 * middle, 1e3 * middleOutside, 1e3 * times[STRETCH - 1], mean, max,
        (double)h->report.kineticEnergy, MdtWorldGetEnabledBodies(h->universe->world));
}

static void step(Heap *h) {
    MdtReport report;
    const double start = now();
    MstUniverseStep(h->universe, (MeReal)(1.0 / 60));
    h->times[h->steps] = h->outside[h->steps] = now() - start;
    if (MdtWorldGetReport(h->universe->world, &report)) {
        h->outside[h->steps] -= (double)report.time[MdtReportStageSolve];
        h->report = report;
        h->inexact += report.fallbacks > 0;
        h->worst = fmax(h->worst, report.fallbacks > 0 ? (double)report.residualVelocity : 0);
    }
    h->steps++;
    if (h->steps % STRETCH == 0)
        tellStretch(h);
    if (MdtWorldGetEnabledBodies(h->universe->world) > 0)
        h->rested = -1;
    else if (h->rested < 0)
        h->rested = h->steps;
}

static void tell(Heap *h, const char *name) {
    double sum = 0;
    for (int i = 0; i < h->steps; i++)
        sum += h->times[i];
    const double middle = median(h->times, h->steps), outside = median(h->outside, h->steps);
    printf("%-8s all %.2f s, median %.3f ms, outside %.3f ms, 95 %% %.1f ms, worst %.1f ms; %d of %d steps inexact, by "
           "%.2g "
           "m/s at most; ",
           name, sum, 1e3 * middle, 1e3 * outside, 1e3 * h->times[h->steps * 95 / 100], 1e3 * h->times[h->steps - 1],
           h->inexact, h->steps, h->worst);
    printf(h->rested < 0 ? "not at rest\n" : "at rest after %d\n", h->rested);
    free(h->times);
    free(h->outside);
    MstUniverseDestroy(h->universe);
}

static void choose(Heap *h, MeBool isExact, MeBool isAwake) {
    if (isExact)
        MdtWorldSetSolver(h->universe->world, MdtSolverExact);
    MdtWorldSetAutoDisable(h->universe->world, !isAwake);
}

static int countOf(const char *text) {
    const int n = text ? atoi(text) : 0;
    if (n > 0)
        return n;
    fputs("heap: a count is 1 or more\n", stderr);
    exit(2);
}

int main(int argc, char **argv) {
    int boxes = 300, steps = 900, side = 4;
    double budget = 200;
    MeBool isCompared = MEFALSE, isExact = MEFALSE, isAwake = MEFALSE;
    for (int i = 1; i < argc; i++)
        if (!strcmp(argv[i], "--boxes"))
            boxes = countOf(argv[++i]);
        else if (!strcmp(argv[i], "--steps"))
            steps = countOf(argv[++i]);
        else if (!strcmp(argv[i], "--side"))
            side = countOf(argv[++i]);
        else if (!strcmp(argv[i], "--budget"))
            budget = countOf(argv[++i]);
        else if (!strcmp(argv[i], "--exact"))
            isExact = METRUE;
        else if (!strcmp(argv[i], "--awake"))
            isAwake = METRUE;
        else if (!strcmp(argv[i], "--swept"))
            isCompared = METRUE;
        else
            return fputs("heap [--boxes N] [--steps N] [--side M] [--budget W] [--exact] [--awake] [--swept]\n",
                         stderr),
                   2;
    Heap plain = makeHeap(boxes, steps, side, budget, MEFALSE), swept = {.times = NULL};
    choose(&plain, isExact, isAwake);
    if (isCompared) {
        swept = makeHeap(boxes, steps, side, budget, METRUE);
        choose(&swept, isExact, isAwake);
    }
    for (int i = 0; i < steps; i++) {
        step(&plain);
        if (isCompared)
            step(&swept);
    }
    tell(&plain, "plain");
    if (isCompared)
        tell(&swept, "swept");
    return 0;
}
