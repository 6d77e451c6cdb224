/* The report's sweep of settings, for karma-sweep: a run of a scene by a solver with a number of sub-steps, and its
 * errors.
 *
 * Nothing is timed: runs share the machine, and a table is to have the same bytes whatever else that does. So runs are
 * not bounded by seconds either, but by their steps times bodies, a parameter. */
#include "KarmaSweep.h"

#include "engines.h"
#include "run.h"

#include <math.h>
#include <stdlib.h>

/* In the order of parameters[]. Sub-steps are powers of two: halving what is left to a step is what changes errors. */
enum { SCENE, SOLVER, SUBSTEPS, MAX };
/* What a run says that made no errors. */
enum { IMPOSSIBLE = 1, TOO_MUCH };

/* Places of the first two are set when it is known how many there are. With the most steps here all scenes and solvers
 * take one and a half minutes on two cores; the report gives the sweep three. */
static SweepParameter parameters[] = {
    {"scene", 0, 0, 1}, {"solver", 0, 0, 1}, {"sub-steps [power of 2]", 0, 4, 5}, {"most [body steps]", 4e4, 4e4, 1}};
static const char *const results[] = {"fails",   "simulated s", "body steps", "value", "goal",
                                      "value 2", "goal 2",      "value 3",    "goal 3"};

static double bodySteps(const Scene *scene, int substeps) {
    SceneWorld *world = calloc(1, sizeof *world);
    if (!world)
        abort();
    scene->build(scene, world);
    const double n = world->numBodies * ceil(scene->duration / scene_frame(scene)) * substeps;
    free(world);
    return n;
}

static int tell(const Scene *scene, const RunResult *run, double steps, double *result) {
    *result++ = run->outcome == RUN_FAILS;
    *result++ = run->simulated;
    *result++ = steps;
    for (int k = 0; k < SCENE_MAX_ERRORS && scene->errors[k].name; k++) {
        *result++ = run->errors[k];
        *result++ = scene->errors[k].goal;
    }
    return 0;
}

static int run(const double *parameter, double *result) {
    const Scene *scene = scenes[(int)parameter[SCENE]];
    const EngineSolver solver = engines_solver((int)parameter[SOLVER]);
    const int substeps = (int)ldexp(1, (int)parameter[SUBSTEPS]);
    const double steps = bodySteps(scene, substeps);
    if (!engines_isSolverForScene(solver, scene) || run_lack(scene, solver.engine, solver.setting))
        return IMPOSSIBLE;
    if (scene->isCrowd || steps > parameter[MAX])
        return TOO_MUCH;
    const RunResult made = run_scene(scene, solver.engine, solver.setting, substeps, INFINITY);
    return tell(scene, &made, steps, result);
}

static const SweepScene sweep = {
    SWEEP_VERSION, "settings", sizeof parameters / sizeof *parameters, parameters, sizeof results / sizeof *results,
    results,       run};

static void setPlaces(SweepParameter *p, int count) {
    p->largest = count - 1;
    p->count = count;
}

SWEEP_EXPORT const SweepScene *sweepScene(void) {
    int numScenes = 0, numSolvers = 0;
    while (scenes[numScenes])
        numScenes++;
    while (engines_solver(numSolvers).engine)
        numSolvers++;
    setPlaces(&parameters[SCENE], numScenes);
    setPlaces(&parameters[SOLVER], numSolvers);
    return &sweep;
}
