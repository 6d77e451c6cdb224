/* Inside Mcd: contacts at internal faces of compounds. */
#ifndef MCD_COMPOUND_H
#define MCD_COMPOUND_H

#include "surface/mcd_scratch_i.h"

static const double mcd_coveredLean = 2;

/* Which part of its model it is, as a number. */
MeU32 mcd_childPath(const McdGeometryInstance *child);

/* Takes the contacts at internal faces of either model from the scratch's first `count` contacts, which are those of
 * the pair's parts, one pair of parts after the other. Returns how many remain: one at least, if there were any. */
int mcd_dropInternalContacts(const McdModelPair *p, McdScratch *scratch, int count);

#endif
