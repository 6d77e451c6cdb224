/* The one universe of a test, which goes at the test's end. */
#ifndef UNIVERSE_H
#define UNIVERSE_H

#include "Mst.h"
#include "karma_test.h"

static MstUniverseID u;

static inline void universe_end(void *none) {
    (void)none;
    MstUniverseDestroy(u);
    u = 0;
}

/* In the place of the last one. */
static inline void universe_begin(const MstUniverseSizes *sizes) {
    if (u)
        MstUniverseDestroy(u);
    else
        test_finally(universe_end, NULL);
    u = MstUniverseCreate(sizes);
}

/* The plane z = 0. */
static inline McdModelID universe_addFloor(void) {
    static MeMatrix4 tm = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    return MstFixedModelCreate(u, McdPlaneCreate(u->frame), tm);
}

static inline void universe_step(int n) {
    while (n--)
        MstUniverseStep(u, 1. / 60);
}

#endif
