/* Prints what each of the twelve scenes comes to after a second: its name, and a hash of its bodies' state.
 *
 *     states [--workers N] [SCENE ...]
 *
 * Ends with 1 where a body is nowhere. */
#include "twelve.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAMES = 60 };

static MeBool isWanted(const char *name, int count, char **names) {
    for (int i = 0; i < count; i++)
        if (strcmp(names[i], name) == 0)
            return METRUE;
    return count == 0;
}

static MeBool run(const TwelveScene *s, MeTaskPoolID pool) {
    static Place place;
    const MstUniverseID u = twelve_makeUniverse();
    twelve_make(&place, s, u, 0, 0);
    MdtWorldSetTaskPool(u->world, pool);
    for (int i = 0; i < FRAMES; i++)
        MstUniverseStep(u, 1. / 60);
    const MeBool isFinite = twelve_isFinite(u->world);
    printf("%s %08x\n", s->name, twelve_state(u->world));
    fflush(stdout);
    MstUniverseDestroy(u);
    return isFinite;
}

int main(int argc, char **argv) {
    const MeBool areWorkers = argc > 2 && strcmp(argv[1], "--workers") == 0;
    const int first = areWorkers ? 3 : 1;
    MeTaskPoolID pool = areWorkers ? MeTaskPoolCreate(atoi(argv[2])) : NULL;
    MeBool areFinite = METRUE;
    for (int i = 0; i < TWELVE; i++)
        if (isWanted(twelve[i].name, argc - first, argv + first))
            areFinite &= run(&twelve[i], pool);
    MeTaskPoolDestroy(pool);
    return areFinite ? 0 : 1;
}
