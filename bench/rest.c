/* What boxes cost that stand still, and what it took to bring them there.
 *
 *     rest [--steps N] [--budget M]    200 to settle and 200 that are timed; no bound on work (MdtWorldSetWorkBudget)
 *
 * Boxes of 1 m and 1 kg on a plane in a universe with its defaults, friction .5, steps of 1/60 s; nothing sleeps: 1 kg
 * under 1e6 kg, one box on a slope on which it sticks, and on one on which it slides, a tower of 20, 100 columns of 10,
 * pyramids of 210 and 820 with gaps of .1 m in their rows. */
#include "timing.h"

#include "MdtReport.h"
#include "Mst.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX = 1000 };

static MstUniverseID universe;
static McdGeometryID cube;
static McdModelID model[MAX];
static int boxes;
static double budget; /* millions of multiplications; 0: no bound */

static void makeUniverse(void) {
    static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    universe = MstUniverseCreate(&MstUniverseGrowingSizes);
    if (!universe)
        abort();
    MdtWorldSetGravity(universe->world, 0, (MeReal)-9.81, 0);
    MdtWorldSetAutoDisable(universe->world, MEFALSE);
    MdtWorldSetWorkBudget(universe->world, (MeReal)budget);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(universe->bridge, 0, 0), (MeReal).5, 0);
    MstFixedModelCreate(universe, McdPlaneCreate(universe->frame), floorTM);
    cube = McdBoxCreate(universe->frame, 1, 1, 1);
    boxes = 0;
}

static void placeMass(double mass, double x, double y, double z) {
    model[boxes] = MstModelAndBodyCreate(universe, cube, (MeReal)mass);
    McdModelDynamicsSetPosition(model[boxes++], (MeReal)x, (MeReal)y, (MeReal)z);
}

static void place(double x, double y, double z) {
    placeMass(1, x, y, z);
}

static void makeHeavyOnLight(int ratio) {
    place(0, .5, 0);
    placeMass(ratio, 0, 1.5, 0);
}

/* On a slope of that part of the friction coefficient, in percent: below 100 the box sticks, above it slides. */
static void makeSlope(int percent) {
    const double angle = atan(.5 * percent / 100);
    MdtWorldSetGravity(universe->world, (MeReal)(9.81 * sin(angle)), (MeReal)(-9.81 * cos(angle)), 0);
    place(0, .5, 0);
    MdtBodyEnable(McdModelGetBody(model[0]));
}

static void makeTower(int height) {
    for (int i = 0; i < height; i++)
        place(0, .5 + i, 0);
}

static void makeColumns(int side) {
    for (int i = 0; i < side * side * side; i++)
        place(2 * (i / (side * side)), .5 + i % side, 2 * (i / side % side));
}

static void makePyramid(int rows) {
    for (int row = 0; row < rows; row++)
        for (int i = 0; i < rows - row; i++)
            place(1.1 * (i + .5 * row), .5 + row, 0);
}

/* m, of the last box, which is on top. */
static double heightOfLast(void) {
    MeVector3 p;
    McdModelDynamicsGetPosition(model[boxes - 1], p);
    return (double)p[1];
}

/* Millions of multiplications that the first step takes, which has no forces to begin with. */
static double takeFirstStep(void) {
    MdtReport report;
    MdtWorldEnableReport(universe->world);
    MstUniverseStep(universe, (MeReal)(1. / 60));
    const double work = MdtWorldGetReport(universe->world, &report) ? (double)report.work : 0;
    MdtWorldDisableReport(universe->world);
    return work;
}

/* s, of one step. */
static double step(void) {
    const double start = now();
    MstUniverseStep(universe, (MeReal)(1. / 60));
    return now() - start;
}

static void run(const char *name, void (*make)(int), int size, int steps) {
    double *times = calloc((size_t)steps, sizeof *times), settling = 0;
    if (!times)
        abort();
    makeUniverse();
    make(size);
    const double before = heightOfLast(), work = takeFirstStep();
    for (int i = 0; i < steps; i++)
        settling += step();
    for (int i = 0; i < steps; i++)
        times[i] = step();
    const double middle = median(times, steps);
    printf("| %s | %d | %.0f | %.1f | %.4f | %.4f | %.1e |\n", name, boxes, work, 1e3 * settling / steps, 1e3 * middle,
           1e3 * times[steps - 1], fabs(heightOfLast() - before));
    MstUniverseDestroy(universe);
    free(times);
}

int main(int argc, char **argv) {
    int steps = 200, given = argc % 2 == 1;
    for (int i = 1; given && i < argc; i += 2) {
        given = strcmp(argv[i], "--steps") == 0 || strcmp(argv[i], "--budget") == 0;
        if (strcmp(argv[i], "--steps") == 0)
            steps = atoi(argv[i + 1]);
        else
            budget = atof(argv[i + 1]);
    }
    if (!given || steps < 1 || !(budget >= 0)) {
        fprintf(stderr, "usage: rest [--steps N] [--budget M]\n");
        return 2;
    }
    printf("| scene | boxes | first step, 1e6 multiplications | settling, ms a step | at rest, median ms | worst ms "
           "| top sinks, m |\n");
    printf("|---|---|---|---|---|---|---|\n");
    run("1 kg under 1e6 kg", makeHeavyOnLight, 1000000, steps);
    run("slope, sticks", makeSlope, 67, steps);
    run("slope, slides", makeSlope, 133, steps);
    run("tower", makeTower, 20, steps);
    run("columns", makeColumns, 10, steps);
    run("pyramid of 20 rows", makePyramid, 20, steps);
    run("pyramid of 40 rows", makePyramid, 40, steps);
    return 0;
}
