/* How exact Karma is in the scenes: tables of errors that must not be exceeded. */
#include "bounds.h"
#include "karma_test.h"
#include "scenes_i.h"

static const Scene *find(const char *name) {
    const Scene *const unlisted[] = {&scenes_longTower, &scenes_longCards};
    for (int i = 0; i < 2; i++)
        if (strcmp(unlisted[i]->name, name) == 0)
            return unlisted[i];
    const Scene *s = scene_find(name);
    ck_assert_msg(s != NULL, "no scene '%s'", name);
    return s;
}

/* Says so if it is not kept. */
static bool isKept(const SceneBound *b, const RunResult *r, int substeps) {
    const double bound = TOL(b->single, b->twice), error = r->errors[b->error];
    const bool is = r->outcome == RUN_HOLDS && error <= bound;
    margin_note(b->scene, b->error, error, 0, bound);
    if (r->outcome != RUN_HOLDS)
        printf("%s with %d sub-steps fails after %g s\n", b->scene, substeps, r->simulated);
    else if (!is)
        printf("%s with %d sub-steps: %s = %.3g, not below %g\n", b->scene, substeps,
               find(b->scene)->errors[b->error].name, error, bound);
    return is;
}

static bool isSameRun(const SceneBound *a, const SceneBound *b) {
    return strcmp(a->scene, b->scene) == 0 && a->substeps == b->substeps;
}

int bounds_countBroken(const SceneBound bounds[], int count, const Engine *engine, int setting) {
    RunResult r = {.outcome = RUN_FAILS};
    int broken = 0;
    for (int i = 0; i < count; i++) {
        const SceneBound *b = &bounds[i];
        if (i == 0 || !isSameRun(b - 1, b))
            r = run_scene(find(b->scene), engine, setting, b->substeps, 1e9);
        broken += !isKept(b, &r, b->substeps);
    }
    return broken;
}

static bool endsAlike(const SceneBound *b, const RunResult *r, const RunResult *again) {
    if (r->hash != again->hash)
        printf("%s: two runs differ\n", b->scene);
    return r->hash == again->hash;
}

int bounds_countBrokenCases(const SceneBound bounds[], int count, const Engine *engine, int setting) {
    enum { FINER = 4 };
    RunResult r = {.outcome = RUN_FAILS}, fine = r;
    int broken = 0;
    for (int i = 0; i < count; i++) {
        const SceneBound *b = &bounds[i];
        if (i == 0 || !isSameRun(b - 1, b)) {
            r = run_scene(find(b->scene), engine, setting, b->substeps, 1e9);
            fine = run_scene(find(b->scene), engine, setting, FINER * b->substeps, 1e9);
            const RunResult again = run_scene(find(b->scene), engine, setting, b->substeps, 1e9);
            broken += !endsAlike(b, &r, &again);
        }
        broken += !isKept(b, &r, b->substeps);
        broken += !isKept(b, &fine, FINER * b->substeps);
    }
    return broken;
}
