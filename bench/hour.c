/* Energy and momentum over an hour of game time, one step a frame of 1/60 s, in all engines: as CSV.
 *
 *     hour [--minutes N] [--peer FILE]        60
 *
 * A pendulum, a box that tumbles without gravity, and a quadruped robot that turns without gravity, its legs on hinges.
 * The largest errors so far, after a hundredth, a tenth and all of the time: of the energy over its scale (m g l, or
 * the kinetic energy at the start), of the angular momentum about the origin over that at the start, of the linear one
 * over the mass times 1 m/s. Nothing is put to sleep and nothing is damped. A run may take `budget` seconds. */
#include "timing.h"

#include "engines.h"
#include "run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct Hour {
    const char *name;
    bool hasMomentum; /* it is not tied to the world */
    SceneWorld world;
    double scale; /* J */
} Hour;

typedef struct Sums {
    double energy, linear[3], angular[3];
} Sums;

static const double budget = 60; /* s */

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* I spin in the world's axes, and m r x v. */
static void addMomentum(const SceneBody *b, const SceneState *s, Sums *sums) {
    double inertia[3], local[3], own[3], arm[3];
    scene_inertia(b, inertia);
    scene_rotateBack(s->quaternion, s->spin, local);
    for (int i = 0; i < 3; i++)
        local[i] *= inertia[i];
    scene_rotate(s->quaternion, local, own);
    cross(s->position, s->velocity, arm);
    for (int i = 0; i < 3; i++) {
        sums->linear[i] += b->mass * s->velocity[i];
        sums->angular[i] += own[i] + b->mass * arm[i];
    }
}

static Sums sumUp(const SceneWorld *w, const SceneState states[]) {
    Sums sums = {.energy = scene_energy(w, states)};
    for (int i = 0; i < w->numBodies; i++)
        addMomentum(&w->bodies[i], &states[i], &sums);
    return sums;
}

static double distance(const double a[3], const double b[3]) {
    const double off[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(scene_dot(off, off));
}

static void readStates(const Engine *e, EngineWorld *w, int n, SceneState states[]) {
    for (int i = 0; i < n; i++)
        e->getState(w, i, &states[i]);
}

static double massOf(const SceneWorld *w) {
    double mass = 0;
    for (int i = 0; i < w->numBodies; i++)
        mass += w->bodies[i].mass;
    return mass;
}

static void tell(const Hour *h, const Engine *e, int setting, double minutes, const double worst[3],
                 const char *outcome) {
    printf("%s,%s,%s,%g,%s,%.3g,", h->name, e->name, e->settings[setting], minutes, outcome, worst[0]);
    if (h->hasMomentum)
        printf("%.3g,%.3g\n", worst[1], worst[2]);
    else
        puts(",");
    fflush(stdout);
}

static void note(double *worst, double error) {
    if (!(error <= *worst))
        *worst = error;
}

/* The clock is looked at once a second of game time. */
static void run(const Hour *h, const Engine *e, int setting, double minutes) {
    SceneState states[SCENE_MAX_BODIES];
    const int frames = (int)lround(3600 * minutes), n = h->world.numBodies;
    const double start = now(), mass = massOf(&h->world);
    double worst[3] = {0, 0, 0};
    EngineWorld *w = run_make(e, setting, &h->world);
    readStates(e, w, n, states);
    const Sums first = sumUp(&h->world, states);
    for (int i = 1; i <= frames; i++) {
        e->step(w, SCENE_FRAME);
        readStates(e, w, n, states);
        const Sums is = sumUp(&h->world, states);
        note(&worst[0], fabs(is.energy - first.energy) / h->scale);
        note(&worst[1], distance(is.angular, first.angular) / sqrt(scene_dot(first.angular, first.angular)));
        note(&worst[2], distance(is.linear, first.linear) / mass);
        if (i == frames / 100 || i == frames / 10 || i == frames)
            tell(h, e, setting, i / 3600., worst, isfinite(worst[0]) ? "holds" : "fails");
        if (i % 60 == 0 && now() - start > budget) {
            tell(h, e, setting, i / 3600., worst, "too slow");
            break;
        }
    }
    e->destroy(w);
}

/* All its parts turn about the same axis through the origin of the base. */
static void letFloat(SceneWorld *w) {
    static const double spin[3] = {.5, 2, .3}; /* rad/s */
    memset(w->gravity, 0, sizeof w->gravity);
    for (int i = 0; i < w->numBodies; i++) {
        SceneBody *b = &w->bodies[i];
        double arm[3];
        memset(b->force, 0, sizeof b->force);
        for (int c = 0; c < 3; c++)
            arm[c] = b->start.position[c] - w->bodies[0].start.position[c];
        memcpy(b->start.spin, spin, sizeof spin);
        cross(spin, arm, b->start.velocity);
    }
}

static Hour *make(const char *name, const char *scene, bool hasMomentum) {
    Hour *h = calloc(1, sizeof *h);
    const Scene *s = scene_find(scene);
    if (!h || !s)
        abort();
    h->name = name;
    h->hasMomentum = hasMomentum;
    s->build(s, &h->world);
    if (h->world.numBodies > 1)
        letFloat(&h->world);
    const SceneBody *b = &h->world.bodies[0];
    h->scale = hasMomentum ? scene_startEnergy(&h->world) : b->mass * -h->world.gravity[1] * b->start.position[0];
    return h;
}

/* Settings whose dynamics without contact differ. */
static bool isCompared(const Engine *e, int setting) {
    return strncmp(e->name, "Karma", 5) != 0 || setting != ENGINE_DEFAULTS;
}

int main(int argc, char *argv[]) {
    double minutes = 60;
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], "--minutes") == 0 && i + 1 < argc)
            minutes = atof(argv[++i]);
        else if (strcmp(argv[i], "--peer") != 0 || ++i == argc || !engines_addPeer(argv[i]))
            return fputs("usage: hour [--minutes N] [--peer FILE]\n", stderr), 2;
    puts("scene,engine,setting,minutes,outcome,energy,angular momentum,momentum");
    Hour *hours[] = {make("pendulum", "pendulum", false), make("box that tumbles", "tumbling", true),
                     make("quadruped that turns", "sim-energy", true)};
    for (int i = 0; i < 3; i++) {
        for (int e = 0; engines[e]; e++)
            for (int s = 0; engines[e]->settings[s] && engines_isForScene(engines[e], &hours[i]->world); s++)
                if (isCompared(engines[e], s))
                    run(hours[i], engines[e], s, minutes);
        free(hours[i]);
    }
    return 0;
}
