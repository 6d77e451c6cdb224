/* Inside Mcd: contacts at internal faces of compounds. */
#ifndef MCD_COMPOUND_H
#define MCD_COMPOUND_H

#include "mcd_scratch_i.h"

/* The contacts of two parts that have one normal, as a range of the scratch's contacts. Only mcd_dropInternalContacts
 * writes it: first the range and the parts, then what follows from the contacts, last what is dropped. */
typedef struct McdPartManifold {
    int first, count;
    McdGeometryInstance *part[2];  /* of the first model and of the second */
    McdGeometryInstance *cover[2]; /* the part of the same model that covers part[i] there; null: none does */
    double lean; /* 0: it is on the surface of both models; else the sine of the angle by which the normal leans over a
                    flush face, or mcd_coveredLean: it is no normal of the whole */
    double skin; /* m, of the covered parts: what is lower is flush */
    double separation; /* m, the least */
    MeBool isDropped;
} McdPartManifold;

static const double mcd_coveredLean = 2;

/* Which part of its model it is, as a number. */
MeU32 mcd_partPath(const McdGeometryInstance *part);

/* Takes the contacts at internal faces of either model from the scratch's first `count` contacts, which are those of
 * the pair's parts, one pair of parts after the other. Returns how many remain: one at least, if there were any. */
int mcd_dropInternalContacts(const McdModelPair *p, McdScratch *scratch, int count);

#endif
