/* Inside Mdt: surfaces, the parameters of contacts. Contacts of one pair of materials share one. */
#ifndef MDT_SURFACE_I_H
#define MDT_SURFACE_I_H

#include "MdtBcl.h"
#include "MeInternal.h"

/* Never changed while it is in use, and never moved. */
typedef struct MdtSurface {
    MdtBclContactParams params;
    struct MdtSurface *next; /* in its bucket, or of the free ones */
    int users;
} MdtSurface;

/* A world's surfaces: a hash table with chains. */
typedef struct MdtSurfaces {
    struct MdtSurfaceBlock *blocks;
    MdtSurface **bucket; /* numBuckets, a power of two */
    MdtSurface *firstFree;
    MdtSurface standard; /* the default parameters; always there */
    int numBuckets, count;
} MdtSurfaces;

/* False, after a fatal error: there is no memory. */
MeBool mdt_surfacesInit(MdtSurfaces *s, MeReal lengthScale, const char *caller);
void mdt_surfacesTerm(MdtSurfaces *s);

/* The surface with these parameters, to the last bit; one more contact has it. Where there is no memory for a new one,
 * after a fatal error, that of the default parameters. */
const MdtSurface *mdt_surfaceAcquire(MdtSurfaces *s, const MdtBclContactParams *params);
/* One contact less has it. */
void mdt_surfaceGive(MdtSurfaces *s, const MdtSurface *surface);

#endif
