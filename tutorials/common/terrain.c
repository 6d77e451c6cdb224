#include "terrain.h"
#include "MeMath.h"
#include <stdlib.h>

enum { POINTS = 97 };
static const MeReal cell = (MeReal)1.5; /* m */

typedef struct {
    MeReal level, hills; /* m */
} Hills;

static MeAppTerrain *terrain;

/* Smoothstep: 0 to 1 for x from 0 to 1, with slope 0 at both ends. */
static MeReal smooth(MeReal x) {
    const MeReal t = MeCLAMP(x, 0, 1);
    return t * t * (3 - 2 * t);
}

static MeReal MEAPI heightAt(MeReal x, MeReal z, void *userdata) {
    const Hills *h = userdata;
    const MeReal half = POINTS / 2 * cell, fromMiddle = MeSqrt(x * x + z * z);
    const MeReal out = smooth((fromMiddle - h->level) / 12);
    const MeReal wave = MeSin((MeReal)0.17 * x + 1) * MeCos((MeReal)0.14 * z) + MeSin((MeReal)0.09 * (x + z));
    const MeReal rim = smooth((MeMAX(MeFabs(x), MeFabs(z)) / half - (MeReal)0.85) / (MeReal)0.15);
    return out * h->hills * ((MeReal)0.5 + (MeReal)0.25 * wave) + 3 * h->hills * rim;
}

static void MEAPI_CDECL end(void) {
    MeAppTerrainDestroy(terrain);
}

MeAppTerrain *terrainCreate(MeReal level, MeReal hills) {
    Hills h = {level, hills};
    terrain = MeAppTerrainCreate(POINTS, cell, heightAt, &h);
    atexit(end);
    return terrain;
}
