/* How exact Karma is in the scenes: tables of errors that must not be exceeded. For tests. */
#ifndef SCENES_BOUNDS_H
#define SCENES_BOUNDS_H

#include "run.h"

typedef struct SceneBound {
    const char *scene;    /* in the list, or scenes_longTower, scenes_longCards */
    int substeps, error;  /* the index of the error */
    double single, twice; /* by precision */
} SceneBound;

/* Runs the scenes, each once where its bounds stand together, and returns how many bounds are broken. All of them are
 * looked at and told of, so that one look shows what has changed. */
int bounds_countBroken(const SceneBound bounds[], int count, const Engine *engine, int setting);

/* The same, and of each scene: two runs end bit for bit alike, and with four sub-steps the same bounds hold. */
int bounds_countBrokenCases(const SceneBound bounds[], int count, const Engine *engine, int setting);

#endif
