/* How time grows with the number of bodies, contacts and joints, and what memory each takes, in all engines: as CSV.
 *
 *     scaling [--quick] [--peer FILE]
 *
 * Time: mean CPU time of a frame of 1/60 s, of 2 s, over four sizes of rag dolls (each a partition of its own), of a
 * heap that falls and of a pyramid that stands (one partition), of a hanging chain (one partition of joints). A size
 * that takes more than the budget is left out, and the larger ones with it. Memory: what the heap of the process has
 * grown by after ten frames, over that of an empty world, over the number: boxes that fly; what more boxes on the
 * ground take, over their four contacts; what more the links of a chain take, over their joints. */
#include "timing.h"

#include "engines.h"
#include "run.h"

#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SIZES = 4, MEASURED = 1000, FRAMES = 10 };

typedef struct Kind {
    const char *name, *unit, *scene;
    int sizes[SIZES]; /* of the unit */
    double parts;     /* the scene's count, over the size */
    double perSide;   /* the parameter, of a heap its side; 0: the size; less than 0: as it is */
} Kind;

static const Kind kinds[] = {
    {"rag dolls", "dolls", "ragdolls-100", {10, 20, 40, 80}, 11, -1},
    {"heap that falls", "boxes", "heap-1000", {125, 250, 500, 1000}, 1, 5},
    {"pyramid that stands", "rows", "pyramid-820", {5, 10, 20, 40}, 1, 0},
    {"hanging chain", "links", "chain-10", {10, 30, 100, 300}, 1, -1},
};

static Scene sizeOf(const Kind *k, int size) {
    Scene s = *scene_find(k->scene);
    s.count = (int)(k->parts * size);
    if (k->perSide > 0)
        s.parameter = k->perSide;
    else if (!(k->perSide < 0)) {
        s.parameter = size;
        s.count = size * (size + 1) / 2;
    }
    s.heaped = s.heaped ? s.count : 0;
    s.duration = 2;
    return s;
}

/* Settings that are compared in crowds. */
static bool isCompared(const Engine *e, int setting) {
    return e->crowds ? (e->crowds & 1u << setting) != 0 : setting < 2;
}

static void scale(const Kind *k, const Engine *e, int setting, double budget) {
    for (int i = 0; i < SIZES; i++) {
        const Scene s = sizeOf(k, k->sizes[i]);
        const char *lack = run_lack(&s, e, setting);
        if (lack)
            return;
        const RunResult r = run_scene(&s, e, setting, 1, budget);
        if (r.outcome == RUN_TIMES_OUT)
            return;
        printf("time,%s,%s,%s,%s,%d,%.6g,%s\n", k->name, k->unit, e->name, e->settings[setting], k->sizes[i],
               1e6 * r.cpu * SCENE_FRAME, r.outcome == RUN_FAILS ? "fails" : "holds");
        fflush(stdout);
    }
}

/* Memory */

static void addFlying(SceneWorld *w, int n) {
    for (int i = 0; i < n; i++)
        scene_addBox(w, 1, 1, 1, 1, 3 * (i % 32), 100, 3 * (i / 32))->friction = .5;
}

static void addStanding(SceneWorld *w, int n) {
    for (int i = 0; i < n; i++)
        scene_addBox(w, 1, 1, 1, 1, 3 * (i % 32), .5, 3 * (i / 32))->friction = .5;
}

/* Pairs of flying boxes on a joint. */
static void addJoined(SceneWorld *w, int n) {
    addFlying(w, n);
    for (int i = 1; i < n; i += 2)
        scene_join(w, SCENE_BALL_JOINT, i, i - 1, 3 * (i % 32) - 1.5, 100, 3 * (i / 32));
}

static double bytesInUse(void) {
    const struct mallinfo2 m = mallinfo2();
    return (double)m.uordblks + (double)m.hblkhd;
}

static double bytesOf(const Engine *e, int setting, void (*add)(SceneWorld *w, int n), int n) {
    SceneWorld *world = calloc(1, sizeof *world);
    SceneState s;
    if (!world)
        abort();
    world->gravity[1] = -9.81;
    world->collides = true;
    add(world, n);
    const double before = bytesInUse();
    EngineWorld *w = run_make(e, setting, world);
    for (int i = 0; i < FRAMES; i++) {
        e->getState(w, 0, &s); /* some build their world then */
        e->step(w, SCENE_FRAME);
    }
    const double bytes = bytesInUse() - before;
    e->destroy(w);
    free(world);
    return bytes;
}

/* Of a world with one box, what an engine has in any case. */
static void weigh(const Engine *e, int setting, int n) {
    const double empty = bytesOf(e, setting, addFlying, 1), flying = bytesOf(e, setting, addFlying, n) - empty;
    printf("memory,box that flies,bytes,%s,%s,%d,%.0f,holds\n", e->name, e->settings[setting], n, flying / n);
    printf("memory,contact of a box on the ground,bytes,%s,%s,%d,%.0f,holds\n", e->name, e->settings[setting], n,
           (bytesOf(e, setting, addStanding, n) - empty - flying) / (4 * n));
    printf("memory,ball joint,bytes,%s,%s,%d,%.0f,holds\n", e->name, e->settings[setting], n,
           (bytesOf(e, setting, addJoined, n) - empty - flying) / (n / 2));
    fflush(stdout);
}

static void weighAll(void) {
    SceneWorld crowd = {.collides = true, .numBodies = MEASURED};
    const Scene scene = {.name = ""};
    for (int e = 0; engines[e]; e++)
        if (engines_isForScene(engines[e], &crowd))
            weigh(engines[e], 0, engines[e]->lack && engines[e]->lack(&scene, &crowd, 0) ? MEASURED / 20 : MEASURED);
}

static void scaleAll(double budget) {
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        SceneWorld *world = calloc(1, sizeof *world);
        if (!world)
            abort();
        const Scene s = sizeOf(&kinds[k], kinds[k].sizes[0]);
        s.build(&s, world);
        for (int e = 0; engines[e]; e++)
            for (int i = 0; engines[e]->settings[i] && engines_isForScene(engines[e], world); i++)
                if (isCompared(engines[e], i))
                    scale(&kinds[k], engines[e], i, budget);
        free(world);
    }
}

int main(int argc, char *argv[]) {
    double budget = 6; /* s, that the CPU may take for a size */
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], "--quick") == 0)
            budget = .4;
        else if (strcmp(argv[i], "--peer") != 0 || ++i == argc || !engines_addPeer(argv[i]))
            return fputs("usage: scaling [--quick] [--peer FILE]\n", stderr), 2;
    puts("what,kind,unit,engine,setting,size,value,outcome");
    weighAll();
    scaleAll(budget);
    return 0;
}
