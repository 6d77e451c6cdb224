/* Inside Mdt: surfaces, the parameters of contacts. Contacts with the same parameters share one surface. */
#ifndef MDT_SURFACE_I_H
#define MDT_SURFACE_I_H

#include "MdtBcl.h"
#include "MeInternal.h"

/* Its parameters do not change, and it does not move, while it is in use. */
typedef struct MdtSurface {
    MdtBclContactParams params;
    struct MdtSurface *next; /* next in its bucket, or in the free list */
    int users;               /* number of contacts that have it */
} MdtSurface;

/* A world's surfaces: a hash table with chains. */
typedef struct MdtSurfaces {
    struct MdtSurfaceBlock *blocks;
    MdtSurface **bucket; /* numBuckets, a power of two */
    MdtSurface *firstFree;
    MdtSurface standard; /* the default parameters; always there */
    int numBuckets, count;
} MdtSurfaces;

/* False, after a fatal error, if there is no memory. */
MeBool mdt_surfacesInit(MdtSurfaces *s, MeReal lengthScale, const char *caller);
void mdt_surfacesTerm(MdtSurfaces *s);

/* The surface with exactly these parameters; counts one more user. The surface of the default parameters if there is no
 * memory for a new one, after a fatal error. */
const MdtSurface *mdt_surfaceAcquire(MdtSurfaces *s, const MdtBclContactParams *params);
/* Counts one user less; a surface without users is freed. */
void mdt_surfaceRelease(MdtSurfaces *s, const MdtSurface *surface);

#endif
