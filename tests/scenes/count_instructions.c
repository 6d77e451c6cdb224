/* Runs the first frames of a scene in Karma, rigid, one step a frame: for counting instructions.
 *
 *     count_instructions SCENE FRAMES */
#include "run.h"

#include <stdio.h>
#include <stdlib.h>

#ifdef _ME_API_DOUBLE
#define KARMA engine_karma_double
#else
#define KARMA engine_karma_single
#endif

int main(int argc, char *argv[]) {
    const Scene *wanted = argc == 3 ? scene_find(argv[1]) : NULL;
    if (!wanted)
        return fputs("count_instructions SCENE FRAMES\n", stderr), 2;
    Scene scene = *wanted;
    scene.duration = atoi(argv[2]) * SCENE_FRAME;
    return run_scene(&scene, &KARMA, ENGINE_RIGID, 1, 1e9).outcome == RUN_HOLDS ? 0 : 1;
}
