/* What a scene needs of a physics engine, and no more. One file per engine fills in an Engine.
 *
 * An engine that Debian does not package stays outside: `bench --peer FILE` takes a shared library that shows an Engine
 * called `engine`, and the functions of tests/scenes/scene.h are there for it. */
#ifndef BENCH_ENGINE_H
#define BENCH_ENGINE_H

#include "contacts.h"
#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct EngineWorld EngineWorld; /* each engine's own */

typedef struct Engine {
    const char *name;
    const char *version;
    const char *about;           /* precision, and what of its defaults matters */
    const char *const *settings; /* names of its solvers, ends with a null */
    bool bounces;                /* has restitution */
    unsigned crowds;             /* which settings scenes of many bodies are compared with, a bit each; 0: all */
    /* In words, what else the scene needs that it has not, such as compounds; null: nothing. May be null. */
    const char *(*lack)(const Scene *scene, const SceneWorld *world, int setting);
    /* A world with the `setting`-th solver. Bodies collide, with each other and the ground, or do not. */
    EngineWorld *(*create)(int setting, const double gravity[3], bool collides);
    void (*addGround)(EngineWorld *w);                         /* the plane y = 0 */
    void (*addTerrain)(EngineWorld *w, const SceneTerrain *t); /* in its place; null: it has none */
    /* Bodies are numbered as they are added. */
    void (*addBody)(EngineWorld *w, const SceneBody *b);
    void (*addJoint)(EngineWorld *w, const SceneJoint *j);
    /* For an engine without collision: the contacts of the next step. Null: it finds them. */
    void (*setContacts)(EngineWorld *w, const SceneContact contacts[], int n);
    void (*step)(EngineWorld *w, double h);
    void (*getState)(EngineWorld *w, int body, SceneState *s);
    bool (*hasGivenUp)(EngineWorld *w); /* the engine itself says so; may be null */
    void (*destroy)(EngineWorld *w);
} Engine;

/* Karma's settings, all rigid but the defaults. Those after them: of a world with the scene's contacts its integrator
 * of order 4; of a universe its solver of contacts (MdtWorldSetSolver), the fast one ten times as accurate
 * (MdtWorldSetAccuracy), two workers. Or-ed with ENGINE_STRICT, for tests, a universe's step that is not exact counts
 * as giving up. */
enum { ENGINE_RIGID, ENGINE_DEFAULTS, ENGINE_ORDER_4 };
enum { ENGINE_EXACT = ENGINE_DEFAULTS + 1, ENGINE_FAST, ENGINE_FINE, ENGINE_TWO_WORKERS, ENGINE_STRICT = 16 };

extern const Engine engine_karma_single, engine_karma_double;       /* with contacts made by the scene's code */
extern const Engine engine_universe_single, engine_universe_double; /* Mcd's contacts, through the bridge */
extern const Engine engine_ode, engine_bullet, engine_mujoco;

#ifdef __cplusplus
}
#endif

#endif
