/* The one universe of a program, as tests/Mst/universe.h is of a test. */
#ifndef UNIVERSE_H
#define UNIVERSE_H

#include "Mst.h"

static MstUniverseID u;

static inline void universe_end(void) {
    if (u)
        MstUniverseDestroy(u);
    u = 0;
}

/* In the place of the last one. */
static inline void universe_begin(const MstUniverseSizes *sizes) {
    universe_end();
    u = MstUniverseCreate(sizes);
}

#endif
