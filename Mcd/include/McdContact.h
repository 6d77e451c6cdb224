/** @file McdContact.h
 *  Fewer contacts for nearly the same support (User Guide ch. 4, "Testing for Collisions").
 */
#ifndef MCDCONTACT_H
#define MCDCONTACT_H

#include "McdCTypes.h"

ME_BEGIN_C

/**
 * Chooses at most @a nContacts_dest contacts that support as well as all of them do: spread out as far as possible,
 * different normals, the deepest among them. They are copied in the order they had.
 * @param avgNormal        the direction that faces have, for faceNormalsFirst; may be null.
 * @param contacts_src     nContacts_src contacts; may be the same array as contacts_dst.
 * @param faceNormalsFirst if true, contacts within 8 degrees of avgNormal are chosen before all others.
 * @param scale            the size of the models (m): contacts nearer than 1e-6 of it count as one; <= 0: 1.
 * Takes memory for the time of the call.
 * @return how many were written; 0, with a warning, for null arrays or a count of contacts below 0.
 */
MEPUBLIC int MEAPI McdContactSimplify(const MeReal *avgNormal, McdContact *contacts_src, const int nContacts_src,
                                      McdContact *contacts_dst, const int nContacts_dest, const int faceNormalsFirst,
                                      const MeReal scale);

ME_END_C

#endif
