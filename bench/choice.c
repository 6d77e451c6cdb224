/* What the choice of a solver costs and what it does to the result: automatic, fast, exact (MdtWorldSetSolver).
 *
 *     choice [--scene NAME] [--steps N] [--only auto|fast|exact] [--budget M]
 *     choice --list
 *
 * Scenes whose names begin with NAME, all if it is not given; N steps instead of the scene's own time, M millions of
 * multiplications instead of the default as the bound on work (MdtWorldSetWorkBudget). Universes with their defaults, y
 * up, friction .5, steps of 1/60 s; nothing sleeps. A line for each scene and each setting: the time of a step and its
 * work (MdtReport; the same on every machine), the scene's error, marked if it is not acceptable, and one more figure;
 * and of all scenes the deepest overlap, the widest gap of a joint and the most energy gained in a step for each kg
 * (springs and motors give it, too). The ratios at the end are to the one of fast and exact with less work
 * whose error is acceptable, in time and in work; none: neither is, or it was not run. */
#include "timing.h"

#include "choice_scenes.h"

#include <stdio.h>

enum { SETTINGS = 3 };

static const char *const settingName[SETTINGS] = {"auto", "fast", "exact"};
static const MdtSolver setting[SETTINGS] = {MdtSolverAuto, MdtSolverFast, MdtSolverExact};
static double budget = -1; /* negative: the world's own */

typedef struct Result {
    double mean, worst, work, worstWork; /* s; millions of multiplications */
    double error, also, deepest, gap, gain;
} Result;

/* ---- running ----------------------------------------------------------------------------------------------------- */

/* Takes a step and adds to the result what it cost and did. */
static void step(int i, Result *r) {
    MdtReport report;
    const double began = now();
    advance(i);
    const double took = now() - began;
    note(i);
    MdtWorldGetReport(universe->world, &report);
    r->mean += took;
    r->worst = fmax(r->worst, took);
    r->work += (double)report.work;
    r->worstWork = fmax(r->worstWork, (double)report.work);
    r->deepest = fmax(r->deepest, deepest);
}

/* With sub-steps it is the reference. */
static Result run(const Variant *v, int steps, MdtSolver solver, int subSteps) {
    Result r = {0};
    makeUniverse(solver);
    if (budget >= 0)
        MdtWorldSetWorkBudget(universe->world, (MeReal)budget);
    MdtWorldSetSubSteps(universe->world, subSteps);
    makeScene(v);
    for (int i = 0; i < steps; i++)
        step(i, &r);
    r.mean /= steps;
    r.work /= steps;
    r.gap = widest;
    r.gain = gained;
    r.error = v->scene->measure->error();
    r.also = v->scene->measure->also();
    if (subSteps > 1)
        McdModelDynamicsGetPosition(model[watched], reference);
    MstUniverseDestroy(universe);
    return r;
}

/* Of fast and exact, the cheaper one whose error is acceptable; null: neither. */
static const Result *bestOf(const Scene *scene, const Result r[SETTINGS]) {
    const Result *best = NULL;
    for (int k = 1; k < SETTINGS; k++)
        if (fabs(r[k].error) <= scene->acceptable && (!best || r[k].work < best->work))
            best = &r[k];
    return best;
}

static void tell(const Variant *v, const char *name, const Result *r, const Result *best) {
    const Measure *m = v->scene->measure;
    printf("| %s | %s | %.3f | %.2f | %.3f | %.2f | %s %.3g%s | %s %.3g | %.1e | %.1e | %.1e |", v->name, name,
           1e3 * r->mean, 1e3 * r->worst, r->work, r->worstWork, m->what, r->error,
           fabs(r->error) <= v->scene->acceptable ? "" : " !", m->alsoWhat, r->also, r->deepest, r->gap, r->gain);
    if (best)
        printf(" %.2f | %.2f |\n", r->mean / best->mean, r->work / best->work);
    else
        printf(" none | none |\n");
    fflush(stdout);
}

static void compare(const Variant *v, int steps, int only) {
    Result r[SETTINGS] = {{0}};
    if (steps == 0)
        steps = (int)(v->scene->time / h + .5);
    if (v->scene->measure->error == fromReference)
        run(v, steps, MdtSolverExact, 8);
    for (int k = 0; k < SETTINGS; k++)
        if (only < 0 || only == k)
            r[k] = run(v, steps, setting[k], 1);
    for (int k = 0; k < SETTINGS; k++)
        if (only < 0 || only == k)
            tell(v, settingName[k], &r[k], only < 0 ? bestOf(v->scene, r) : NULL);
}

static int usage(void) {
    fprintf(stderr, "usage: choice [--scene NAME] [--steps N] [--only auto|fast|exact] [--budget M] | --list\n");
    return 2;
}

static int settingNamed(const char *name) {
    for (int k = 0; k < SETTINGS; k++)
        if (strcmp(name, settingName[k]) == 0)
            return k;
    return -1;
}

/* The name itself, or its beginning up to a value. */
static MeBool isMeant(const char *wanted, const char *name) {
    const size_t n = strlen(wanted);
    return n == 0 || (strncmp(wanted, name, n) == 0 && (name[n] == 0 || name[n] == '-'));
}

int main(int argc, char **argv) {
    const MeBool isList = argc == 2 && strcmp(argv[1], "--list") == 0;
    const char *wanted = "";
    int steps = 0, only = -1, found = 0;
    Variant v;
    for (int i = 1; !isList && i < argc; i += 2) {
        const char *value = i + 1 < argc ? argv[i + 1] : "";
        if (!(strcmp(argv[i], "--scene") == 0 && *(wanted = value)) &&
            !(strcmp(argv[i], "--steps") == 0 && (steps = atoi(value)) >= 1) &&
            !(strcmp(argv[i], "--budget") == 0 && *value && (budget = atof(value)) >= 0) &&
            !(strcmp(argv[i], "--only") == 0 && (only = settingNamed(value)) >= 0))
            return usage();
    }
    if (!isList)
        printf("| scene | solver | ms a step | worst | work, 1e6 multiplications a step | worst | error | also | "
               "deepest overlap, m | joints open, m | gains in a step, J/kg | time to the cheaper | work to it |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const Scene *scene = scenes; scene < scenes + SCENES; scene++)
        for (int number = 0; number < VALUES * VALUES * VALUES; number++) {
            if (!makeVariant(&v, scene, number) || !isMeant(wanted, v.name))
                continue;
            found++;
            if (isList)
                printf("%s\n", v.name);
            else
                compare(&v, steps, only);
        }
    return found ? 0 : usage();
}
