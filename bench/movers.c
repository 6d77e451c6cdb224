/* What characters cost: movers (MstMover.h) that walk over a mesh of hilly ground, turn where it ends, and climb what
 * lies in their way.
 *
 *     movers [--movers N] [--side M] [--steps N]
 *
 * 1000 movers, 224 squares of two triangles a side (100 352 triangles), 300 steps of 1/60 s. Squares of .5 m; hills of
 * .3 m, kerbs of .2 m. */
#include "timing.h"

#include "McdMesh.h"
#include "Mst.h"
#include "MstMover.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double square = .5; /* m */

static double heightAt(int i, int j) {
    return .3 * sin(.2 * i) * cos(.17 * j) + (i / 16 + j / 16) % 2 * .2;
}

static McdMeshID createGround(MstUniverseID u, int side) {
    const int n = side + 1;
    MeVector3 *v = malloc(sizeof *v * (size_t)(n * n));
    int *t = malloc(sizeof *t * 6 * (size_t)(side * side)), *next = t;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            v[j * n + i][0] = (MeReal)(square * (i - side / 2));
            v[j * n + i][1] = (MeReal)(square * (j - side / 2));
            v[j * n + i][2] = (MeReal)heightAt(i, j);
        }
    for (int j = 0; j < side; j++)
        for (int i = 0; i < side; i++) {
            const int a = j * n + i;
            const int two[6] = {a, a + 1, a + n + 1, a, a + n + 1, a + n};
            memcpy(next, two, sizeof two);
            next += 6;
        }
    const McdMeshID mesh = McdMeshCreate(u->frame, v, n * n, t, 2 * side * side, 0);
    free(v);
    free(t);
    return mesh;
}

typedef struct Walker {
    MstMoverID mover;
    MstMoverResult result;
    double heading, fall; /* rad; m/s */
} Walker;

/* One step: ahead at 3 m/s, falling while in the air, back to the middle where the ground ends. */
static void walk(Walker *w, double edge, double step) {
    const MeReal *p = w->result.position;
    if (fmax(fabs((double)p[0]), fabs((double)p[1])) > edge)
        w->heading = atan2(-(double)p[1], -(double)p[0]);
    w->fall = w->result.flags & kMstMoverOnGround ? 0 : w->fall - 9.81 * step;
    const MeVector3 v = {(MeReal)(3 * cos(w->heading)), (MeReal)(3 * sin(w->heading)), (MeReal)w->fall};
    MstMoverMove(w->mover, v, (MeReal)step, &w->result);
}

static void run(int movers, int side, int steps) {
    static MeMatrix4 here = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    const double edge = square * (side / 2 - 4), step = 1. / 60;
    const MstUniverseID u = MstUniverseCreate(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, (MeReal)-9.81);
    MstFixedModelCreate(u, createGround(u, side), here);
    MstUniverseStep(u, (MeReal)step);

    MstMoverParams params;
    MstMoverSetDefaults(&params, u);
    Walker *w = calloc((size_t)movers, sizeof *w);
    double *times = malloc(sizeof *times * (size_t)steps), sum = 0;
    for (int i = 0; i < movers; i++) {
        const double around = 2.399963 * i, far = .9 * edge * sqrt((i + .5) / movers); /* evenly on a disc */
        const MeVector3 at = {(MeReal)(far * cos(around)), (MeReal)(far * sin(around)), 1};
        w[i] = (Walker){.mover = MstMoverCreate(u, &params, at), .heading = 7. * i};
    }
    long ground = 0;
    for (int s = 0; s < steps; s++) {
        const double start = now();
        for (int i = 0; i < movers; i++)
            walk(&w[i], edge, step);
        sum += times[s] = now() - start;
        for (int i = 0; i < movers; i++)
            ground += (w[i].result.flags & kMstMoverOnGround) != 0;
    }
    const double middle = median(times, steps);
    printf("%d movers on %d triangles: mean %.2f ms a step, median %.2f, worst %.2f; %.1f %% of the steps on ground\n",
           movers, 2 * side * side, 1e3 * sum / steps, 1e3 * middle, 1e3 * times[steps - 1],
           100. * (double)ground / movers / steps);
    for (int i = 0; i < movers; i++)
        MstMoverDestroy(w[i].mover);
    free(w);
    free(times);
    MstUniverseDestroy(u);
}

int main(int argc, char **argv) {
    int movers = 1000, side = 224, steps = 300;
    for (int i = 1; i < argc; i += 2) {
        int *number = strcmp(argv[i], "--movers") == 0  ? &movers
                      : strcmp(argv[i], "--side") == 0  ? &side
                      : strcmp(argv[i], "--steps") == 0 ? &steps
                                                        : 0;
        if (!number || i + 1 == argc || (*number = atoi(argv[i + 1])) < 1) {
            fprintf(stderr, "usage: movers [--movers N] [--side M] [--steps N]\n");
            return 2;
        }
    }
    run(movers, side, steps);
    return 0;
}
