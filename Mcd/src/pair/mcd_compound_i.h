/* Inside Mcd: removal of contacts at internal faces of compounds. */
#ifndef MCD_COMPOUND_H
#define MCD_COMPOUND_H

#include "convex/mcd_seam_i.h"
#include "surface/mcd_scratch_i.h"

/* McdChildManifold.lean of covered contacts, whose normal is none of the compound's: larger than any sine. */
static const double mcd_coveredLean = 2;

/* Mixes a hash of both parts' paths in their models (the index of the element at each level) into the features of a
 * result's contacts from number `first` on: contacts of other parts have other features. */
void mcd_mixChildPaths(McdIntersectResult *result, int first, const McdGeometryInstance *child1,
                       const McdGeometryInstance *child2);

/* Removes the contacts at internal faces of either model from the scratch's first `count` contacts, which are those
 * of the pair's parts, one pair of parts after the other. Returns the number that remain: at least one, if there
 * were any. */
int mcd_dropInternalContacts(const McdModelPair *p, McdScratch *scratch, int count);

#endif
