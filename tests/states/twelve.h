/* Twelve scenes whose every bit is known (states.txt), each of what games are made of: for the test that all builds end
 * alike, and for long runs of many of them side by side (longrun.c).
 *
 * Whatever a scene is built of is written out in numbers: where a sine is folded by the compiler it may be another one
 * than that of the C library. */
#ifndef TWELVE_H
#define TWELVE_H

#include "Mst.h"

enum { TWELVE = 12, TWELVE_MODELS = 512, TWELVE_FIXED = 4 };

/* A scene in a universe, and where: on the plane y = 0, y up. Its address stays as long as the universe. */
typedef struct Place {
    MstUniverseID u;
    double x, z;                     /* m */
    MeMatrix4 fixedTM[TWELVE_FIXED]; /* of what does not move */
    McdModelID model[TWELVE_MODELS]; /* what moves */
    int count, numFixed;
    unsigned int seed;
} Place;

typedef struct TwelveScene {
    const char *name;
    double width; /* m, along x and z: what a place of its own needs */
    void (*make)(Place *p);
} TwelveScene;

extern const TwelveScene twelve[TWELVE];

/* With gravity, friction and a floor. */
MstUniverseID twelve_makeUniverse(void);
/* Makes a scene there; p may hold anything. */
void twelve_make(Place *p, const TwelveScene *s, MstUniverseID u, double x, double z);

/* Evenly spread. */
double twelve_random(unsigned int *seed, double low, double high);

/* FNV-1a of transforms and velocities of all bodies, in their order. */
unsigned int twelve_state(MdtWorldID w);
/* Are all bodies where numbers can say? */
MeBool twelve_isFinite(MdtWorldID w);

#endif
