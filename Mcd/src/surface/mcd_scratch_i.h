/* Inside Mcd: scratch memory of a query.
 *
 * A query acquires a scratch from its framework and returns it at its end; a nested query, or one in another thread,
 * acquires another one. There are as many scratches as queries ever ran at once, each as large as its largest query
 * needed: once a program's queries repeat, nothing is allocated. Results do not depend on a scratch's old contents. */
#ifndef MCD_SCRATCH_H
#define MCD_SCRATCH_H

#include "surface/mcd_mesh_i.h"

/* The contacts of two parts that have one normal, as a range of the scratch's contacts. Only
 * mcd_dropInternalContacts writes it: first the range and the parts, then the members derived from the contacts,
 * last isDropped. */
typedef struct McdChildManifold {
    int first, count;
    McdGeometryInstance *child[2]; /* of the first model, of the second */
    McdGeometryInstance *cover[2]; /* the part of the same model that covers child[i] there; null: none */
    double lean;       /* sine of the normal's angle to a flush face's; or mcd_coveredLean; 0: on both surfaces */
    double skin;       /* m, of the covered parts: lower steps are flush */
    double separation; /* m, the smallest of the contacts */
    MeBool isDropped;
} McdChildManifold;

typedef struct McdScratch {
    struct McdScratch *next; /* in the free list */
    McdMesh mesh;
    McdUserTriangle *triangle; /* triangleRoom; zeros between queries: programs need not set all members */
    int triangleRoom;
    McdContact *contact; /* contactRoom elements */
    void *choice;        /* for mcd_simplify: mcd_simplifyBytes(contactRoom) bytes */
    int contactRoom;
    McdChildManifold *manifold; /* manifoldRoom elements */
    int manifoldRoom;
    void *near, *nearChild, *nearModel; /* of McdNear.c */
    int *number;                        /* numberRoom numbers of triangles, for gather functions */
    int numberRoom;
} McdScratch;

/* Acquires a scratch; null, after a fatal error that names the function, if there is no memory. Thread-safe. */
McdScratch *mcd_scratchAcquire(McdFramework *frame, const char *function);
void mcd_scratchRelease(McdFramework *frame, McdScratch *scratch);
/* Frees all scratches of a framework; no query may be running. */
void mcd_scratchFreeAll(McdFramework *frame);

/* Ensure room for `count` elements, keeping the first `used`; false, after a fatal error, if there is no memory. */
MeBool mcd_scratchReserveContacts(McdScratch *scratch, int used, int count);
MeBool mcd_scratchReserveTriangles(McdScratch *scratch, int count);
MeBool mcd_scratchReserveNumbers(McdScratch *scratch, int used, int count);
/* Keeps no elements. */
MeBool mcd_scratchReserveManifolds(McdScratch *scratch, int count);

#endif
