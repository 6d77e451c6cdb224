/* What the farfield of moving boxes costs: boxes of 1 m at random places in a cube, some of which move.
 *
 *     farfield [--boxes N] [--moving PERCENT] [--speed V] [--steps N]         10000, 5, 5, 600 if not given
 *
 * The same boxes move all the time, at V m/s and steps of 1/60 s, and turn back at the walls. A step is: renew the
 * boxes of those that moved, end the block, get the pairs. "all": by McdSpaceUpdateAll, which renews every box. */
#include "timing.h"

#include "McdFrame.h"
#include "McdGeometry.h"
#include "McdGeometryInstance.h"
#include "McdModel.h"
#include "McdSpace.h"
#include "MeMemory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double speed = 5;                               /* m/s */
static const double stepTime = 1.0 / 60, perBox = 2.7; /* s, m^3 of the cube */

/* ---- the motion ----------------------------------------------------------------------------------------------- */

typedef struct Motion {
    int boxes, moving; /* those from 0 to moving - 1 move */
    double side;
    double (*place)[3], (*velocity)[3];
} Motion;

static double randomUpTo(unsigned long long *seed, double max) {
    *seed = *seed * 6364136223846793005ull + 1442695040888963407ull;
    return max * (double)(*seed >> 11) / 9007199254740992.0;
}

static Motion makeMotion(int boxes, double percent) {
    Motion m = {.boxes = boxes, .moving = (int)(boxes * percent / 100), .side = cbrt(perBox * boxes)};
    unsigned long long seed = 1;
    m.place = calloc((size_t)boxes, sizeof *m.place);
    m.velocity = calloc((size_t)boxes, sizeof *m.velocity);
    if (!m.place || !m.velocity)
        abort();
    for (int i = 0; i < boxes; i++) {
        double length = 0;
        for (int k = 0; k < 3; k++) {
            m.place[i][k] = randomUpTo(&seed, m.side);
            m.velocity[i][k] = randomUpTo(&seed, 2) - 1;
            length += m.velocity[i][k] * m.velocity[i][k];
        }
        for (int k = 0; k < 3; k++)
            m.velocity[i][k] *= speed / sqrt(length);
    }
    return m;
}

static void move(Motion *m) {
    for (int i = 0; i < m->moving; i++)
        for (int k = 0; k < 3; k++) {
            m->place[i][k] += stepTime * m->velocity[i][k];
            if (m->place[i][k] < 0 || m->place[i][k] > m->side)
                m->velocity[i][k] = copysign(m->velocity[i][k], m->side / 2 - m->place[i][k]);
        }
}

static void destroyMotion(Motion *m) {
    free(m->place);
    free(m->velocity);
}

/* ---- Karma ----------------------------------------------------------------------------------------------------- */

enum { CRATE = kMcdGeometryFirstUserType };

static void MEAPI crateDestroy(McdGeometryID g) {
    MeMemoryAPI.destroy(g);
}

static void MEAPI crateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight) {
    const MeMatrix4Ptr tm = McdGeometryInstanceGetTransformPtr(ins);
    MeVector3 low, high;
    (void)finalTM;
    (void)tight;
    for (int i = 0; i < 3; i++) {
        low[i] = tm[3][i] - (MeReal).5;
        high[i] = tm[3][i] + (MeReal).5;
    }
    McdGeometryInstanceSetAABB(ins, low, high);
}

typedef struct Scene {
    McdFrameworkID frame;
    McdGeometryID crate;
    McdSpaceID space;
    McdModelID *model;
    MeMatrix4 *tm;
    McdModelPairContainer *pairs;
    size_t bytes; /* given so far */
} Scene;

static size_t bytesGiven; /* by MeMemoryAPI */

static void *MEAPI countingCreate(size_t bytes) {
    size_t *p = malloc(bytes + 16);
    if (!p)
        abort();
    *p = bytes;
    bytesGiven += bytes;
    return (char *)p + 16;
}

static void MEAPI countingDestroy(void *const block) {
    if (!block)
        return;
    size_t *p = (size_t *)(void *)((char *)block - 16);
    bytesGiven -= *p;
    free(p);
}

static void *MEAPI countingResize(void *const block, size_t bytes) {
    void *bigger = countingCreate(bytes);
    if (block) {
        const size_t old = *(size_t *)(void *)((char *)block - 16);
        memcpy(bigger, block, old < bytes ? old : bytes);
        countingDestroy(block);
    }
    return bigger;
}

static void place(const Scene *s, const Motion *m, int i) {
    for (int k = 0; k < 3; k++)
        s->tm[i][3][k] = (MeReal)m->place[i][k];
}

static void makeScene(Scene *s, const Motion *m) {
    static char name[] = "crate";
    const int pairMax = 40 * m->boxes;
    s->frame = McdInit(1, m->boxes, 0, 1);
    McdFrameworkRegisterGeometryType(s->frame, CRATE, name, crateDestroy, crateAABB, 0, 0, 0, 0);
    s->crate = MeMemoryAPI.create(sizeof *s->crate);
    McdGeometryInit(s->crate, s->frame, CRATE);
    s->model = calloc((size_t)m->boxes, sizeof *s->model);
    s->tm = calloc((size_t)m->boxes, sizeof *s->tm);
    s->pairs = McdModelPairContainerCreate(pairMax);
    const size_t before = bytesGiven;
    s->space = McdSpaceAxisSortCreate(s->frame, McdAllAxes, m->boxes, pairMax);
    for (int i = 0; i < m->boxes; i++) {
        MeMatrix4TMMakeIdentity(s->tm[i]);
        place(s, m, i);
        s->model[i] = McdModelCreate(s->crate);
        McdModelSetTransformPtr(s->model[i], s->tm[i]);
        McdModelSetContactTolerance(s->model[i], (MeReal).01);
        McdSpaceInsertModel(s->space, s->model[i]);
        McdSpaceUpdateModel(s->model[i]);
    }
    McdSpaceBuild(s->space);
    McdSpaceEndChanges(s->space);
    s->bytes = bytesGiven - before;
}

static void step(Scene *s, const Motion *m, int isAll) {
    for (int i = 0; i < m->moving; i++)
        place(s, m, i);
    McdSpaceBeginChanges(s->space);
    if (isAll)
        McdSpaceUpdateAll(s->space);
    else
        for (int i = 0; i < m->moving; i++)
            McdSpaceUpdateModel(s->model[i]);
    McdSpaceEndChanges(s->space);
    McdSpacePairIterator it;
    McdSpacePairIteratorBegin(s->space, &it);
    McdSpaceGetPairs(s->space, &it, s->pairs);
}

static void destroyScene(Scene *s) {
    McdSpaceDestroy(s->space);
    McdModelPairContainerDestroy(s->pairs);
    McdFrameworkDestroyAllModelsAndGeometries(s->frame);
    McdTerm(s->frame);
    free(s->model);
    free(s->tm);
}

static int steps = 600;

static double measure(int boxes, double percent, int isAll) {
    Motion m = makeMotion(boxes, percent);
    Scene s;
    double *times = calloc((size_t)steps, sizeof *times), changes = 0;
    if (!times)
        abort();
    const double start = now();
    makeScene(&s, &m);
    const double making = now() - start;
    for (int i = 0; i < steps; i++) {
        move(&m);
        const double before = now();
        step(&s, &m, isAll);
        times[i] = now() - before;
        changes += s.pairs->goodbyeEnd - s.pairs->goodbyeFirst + s.pairs->helloEnd - s.pairs->helloFirst;
    }
    const double us = 1e6 * median(times, steps);
    printf("%-8s%10.1f%10d%12.1f%12.0f%12.1f\n", isAll ? "all" : "moved", us, s.pairs->stayingEnd - s.pairs->helloFirst,
           changes / steps, (double)s.bytes / boxes, 1e3 * making);
    destroyScene(&s);
    destroyMotion(&m);
    free(times);
    return us;
}

static void usage(void) {
    fputs("usage: farfield [--boxes N] [--moving PERCENT] [--speed V] [--steps N]\n", stderr);
    exit(2);
}

int main(int argc, char *argv[]) {
    int boxes = 10000;
    double percent = 5;
    for (int i = 1; i + 1 < argc; i += 2)
        if (strcmp(argv[i], "--boxes") == 0)
            boxes = atoi(argv[i + 1]);
        else if (strcmp(argv[i], "--moving") == 0)
            percent = atof(argv[i + 1]);
        else if (strcmp(argv[i], "--speed") == 0)
            speed = atof(argv[i + 1]);
        else if (strcmp(argv[i], "--steps") == 0)
            steps = atoi(argv[i + 1]);
        else
            usage();
    if (argc % 2 == 0 || boxes < 1 || steps < 1 || !(percent >= 0 && percent <= 100))
        usage();
    MeMemoryAPI.create = countingCreate;
    MeMemoryAPI.resize = countingResize;
    MeMemoryAPI.destroy = countingDestroy;
    printf("%s precision; %d boxes, %g %% moving at %g m/s; bytes: of the space, without the "
           "tree\n%-8s%10s%10s%12s%12s%12s\n",
           sizeof(MeReal) == sizeof(double) ? "double" : "single", boxes, percent, speed, "", "us/step", "pairs",
           "changes", "bytes/model", "making ms");
    measure(boxes, percent, 0);
    measure(boxes, percent, 1);
    return 0;
}
