/* Inside Mcd: working memory of a query, which is not shared.
 *
 * A query takes a scratch from its framework and gives it back at its end; a nested query, and one in another thread,
 * takes another one. There are as many as queries ever ran at once, each as large as the largest query that had it, so
 * that nothing is allocated once a program's queries repeat. What is in it from before means nothing: the same query
 * gives the same bits with any of them. */
#ifndef MCD_SCRATCH_H
#define MCD_SCRATCH_H

#include "surface/mcd_mesh_i.h"

/* The contacts of two parts that have one normal, as a range of the scratch's contacts. Only mcd_dropInternalContacts
 * writes it: first the range and the parts, then what follows from the contacts, last what is dropped. */
typedef struct McdChildManifold {
    int first, count;
    McdGeometryInstance *child[2]; /* of the first model and of the second */
    McdGeometryInstance *cover[2]; /* the part of the same model that covers part[i] there; null: none does */
    double lean; /* 0: it is on the surface of both models; else the sine of the angle by which the normal leans over a
                    flush face, or mcd_coveredLean: it is no normal of the whole */
    double skin; /* m, of the covered parts: what is lower is flush */
    double separation; /* m, the least */
    MeBool isDropped;
} McdChildManifold;

typedef struct McdScratch {
    struct McdScratch *next; /* of the free ones */
    McdMesh mesh;
    McdUserTriangle *triangle; /* zeros between queries: programs need not set all members */
    int triangleRoom;
    McdContact *contact; /* contactRoom */
    void *choice;        /* mcd_simplifyBytes(contactRoom) */
    int contactRoom;
    McdChildManifold *manifold; /* manifoldRoom */
    int manifoldRoom;
} McdScratch;

/* Null, after a fatal error that names the function, if there is no memory. May be called in any thread. */
McdScratch *mcd_scratchAcquire(McdFramework *frame, const char *function);
void mcd_scratchGive(McdFramework *frame, McdScratch *scratch);
/* All of them; no query is running. */
void mcd_scratchFreeAll(McdFramework *frame);

/* Room for so many, of which the first `used` are kept; false, after a fatal error, if there is no memory. */
MeBool mcd_scratchReserveContacts(McdScratch *scratch, int used, int count);
MeBool mcd_scratchReserveTriangles(McdScratch *scratch, int count);
/* None is kept. */
MeBool mcd_scratchReserveManifolds(McdScratch *scratch, int count);

#endif
