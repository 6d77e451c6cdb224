/* Scenes that start over again and again, on one thread and on several: is there ever a difference?
 *
 *     longrun [--steps N] [--workers N] [--seed N]
 *
 * Ten million steps and two workers if not given; another seed is another run. All small scenes of the twelve lie side
 * by side in one universe, and in another one just like it that has workers. A step of the universe is a step of each
 * of its scenes: so many are counted. From time to time a scene starts over, with other velocities, and a box of a rain
 * over all of them is destroyed and made anew. Once a second all bodies' states are compared. Ends with 1 where they
 * differ, or where a body is nowhere, and says in which step. */
#include "twelve.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SMALL = TWELVE - 1, /* all but the heap, which comes first */
    ACROSS = 4,         /* scenes in a row */
    RAIN = 16,
    FRAMES = 60,  /* between two looks */
    RESTART = 11, /* frames, between two starts: each scene goes on for two seconds */
};

static const double spacing = 60; /* m, as wide as the widest scene */

/* Of a body, as its scene starts. */
typedef struct Start {
    MeVector3 position, velocity, spin;
    MeVector4 quaternion;
} Start;

/* A universe with all scenes. */
typedef struct Side {
    MstUniverseID u;
    Place place[SMALL];
    Start start[SMALL][TWELVE_MODELS];
    McdGeometryID drop;
    McdModelID rain[RAIN];
    unsigned int seed;
} Side;

static Side sides[2];

/* ---- making ------------------------------------------------------------------------------------------------------ */

static void noteStart(Start *s, McdModelID m) {
    McdModelDynamicsGetPosition(m, s->position);
    McdModelDynamicsGetQuaternion(m, s->quaternion);
    McdModelDynamicsGetLinearVelocity(m, s->velocity);
    McdModelDynamicsGetAngularVelocity(m, s->spin);
}

static double placeX(int i) {
    return spacing * (i % ACROSS);
}

static double placeZ(int i) {
    return spacing * (i / ACROSS);
}

static void makeDrop(Side *s, int i) {
    const double where = twelve_random(&s->seed, 0, SMALL);
    const double x = placeX((int)where) + twelve_random(&s->seed, -1, 3), y = twelve_random(&s->seed, 5, 8);
    s->rain[i] = MstModelAndBodyCreate(s->u, s->drop, 500);
    McdModelDynamicsSetPosition(s->rain[i], x, y, placeZ((int)where));
}

static void make(Side *s, MeTaskPoolID pool, unsigned int seed) {
    s->u = twelve_makeUniverse();
    s->seed = seed;
    for (int i = 0; i < SMALL; i++) {
        Place *p = &s->place[i];
        twelve_make(p, &twelve[i + 1], s->u, placeX(i), placeZ(i));
        for (int k = 0; k < p->count; k++)
            noteStart(&s->start[i][k], p->model[k]);
    }
    s->drop = McdBoxCreate(s->u->frame, .3, .4, .3);
    for (int i = 0; i < RAIN; i++)
        makeDrop(s, i);
    MdtWorldSetTaskPool(s->u->world, pool);
}

/* ---- going on ---------------------------------------------------------------------------------------------------- */

static void startOver(Side *s, McdModelID m, const Start *start) {
    MeVector3 v;
    McdModelDynamicsSetPosition(m, start->position[0], start->position[1], start->position[2]);
    McdModelDynamicsSetQuaternion(m, start->quaternion[0], start->quaternion[1], start->quaternion[2],
                                  start->quaternion[3]);
    for (int k = 0; k < 3; k++)
        v[k] = start->velocity[k] + (MeReal)twelve_random(&s->seed, -.2, .2);
    McdModelDynamicsSetLinearVelocity(m, v[0], v[1], v[2]);
    McdModelDynamicsSetAngularVelocity(m, start->spin[0], start->spin[1], start->spin[2]);
    McdModelDynamicsEnable(m);
}

static void restart(Side *s, int count) {
    const int scene = count % SMALL;
    for (int k = 0; k < s->place[scene].count; k++)
        startOver(s, s->place[scene].model[k], &s->start[scene][k]);
    MstModelAndBodyDestroy(s->rain[count % RAIN]);
    makeDrop(s, count % RAIN);
}

static void step(Side *s, long frame) {
    if (frame % RESTART == RESTART - 1)
        restart(s, (int)(frame / RESTART));
    MstUniverseStep(s->u, 1. / 60);
}

static void compare(long frame) {
    const unsigned int alone = twelve_state(sides[0].u->world), many = twelve_state(sides[1].u->world);
    if (alone == many && twelve_isFinite(sides[0].u->world))
        return;
    printf("frame %ld: %08x on one thread, %08x on several\n", frame, alone, many);
    exit(1);
}

static void tell(long frame, long frames) {
    printf("%ld of %ld steps without a difference\n", (frame + 1) * SMALL, frames * SMALL);
    fflush(stdout);
}

static void run(long frames) {
    for (long frame = 0; frame < frames; frame++) {
        step(&sides[0], frame);
        step(&sides[1], frame);
        if (frame % FRAMES == FRAMES - 1 || frame + 1 == frames)
            compare(frame);
        if (frame % (100 * FRAMES) == 100 * FRAMES - 1 || frame + 1 == frames)
            tell(frame, frames);
    }
}

int main(int argc, char **argv) {
    double steps = 1e7;
    int workers = 2, seed = 1;
    for (int i = 1; i + 1 < argc; i += 2)
        if (strcmp(argv[i], "--steps") == 0)
            steps = atof(argv[i + 1]);
        else if (strcmp(argv[i], "--workers") == 0)
            workers = atoi(argv[i + 1]);
        else if (strcmp(argv[i], "--seed") == 0)
            seed = atoi(argv[i + 1]);
    if (argc % 2 == 0 || !(steps >= SMALL) || workers < 2)
        return fputs("longrun [--steps N] [--workers N] [--seed N]\n", stderr), 2;
    MeTaskPoolID pool = MeTaskPoolCreate(workers);
    make(&sides[0], NULL, (unsigned int)seed);
    make(&sides[1], pool, (unsigned int)seed);
    run((long)(steps / SMALL));
    for (int i = 0; i < 2; i++)
        MstUniverseDestroy(sides[i].u);
    MeTaskPoolDestroy(pool);
    return 0;
}
