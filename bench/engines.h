/* The engines of a program: those that were built in, and those of --peer. */
#ifndef BENCH_ENGINES_H
#define BENCH_ENGINES_H

#include "engine.h"

/* Karma with contacts of the scene's code, for scenes without contact; Karma as a universe, for those with; peers. They
 * end with a null. */
extern const Engine *engines[];
/* In words, which engines are not there and what brings them; ends with a null. */
extern const char *const engines_absent[];

/* An engine with one of its settings. */
typedef struct EngineSolver {
    const Engine *engine; /* null: none */
    int setting;
} EngineSolver;

/* The n-th of all engines' settings, in their order; none beyond the last. */
EngineSolver engines_solver(int n);

/* Karma with contacts of the scene's code; Karma as a universe. */
bool engines_isWorld(const Engine *e);
bool engines_isUniverse(const Engine *e);

/* An engine of Karma's that the scene is not for: what it has not is the ground, or the lack of one. */
bool engines_isForScene(const Engine *e, const SceneWorld *world);
/* The same of a solver; and where its answer is another one's, bit for bit (two workers), there is no use in it. */
bool engines_isSolverForScene(EngineSolver solver, const Scene *scene);

/* A peer from outside: a shared library with an Engine called `engine`. False, with a message, if it is none. */
bool engines_addPeer(const char *file);

#endif
