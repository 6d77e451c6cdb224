/** @file McdContact.h
 *  What a contact knows beyond its members, and fewer contacts for nearly the same support (User Guide ch. 4, "Testing
 *  for Collisions").
 */
#ifndef MCDCONTACT_H
#define MCDCONTACT_H

#include "McdCTypes.h"

ME_BEGIN_C

/**
 * The separation (m) in double precision, as it was found: in single precision, McdContact.separation is that number
 * rounded. Where a program has made the contact, or written another separation into it, that one. 0, with a warning,
 * for null. Beyond Karma.
 */
MEPUBLIC double MEAPI McdContactGetSeparation(const McdContact *c);
/**
 * The position (m, world) in double precision; where a program has made the contact, or written another position into
 * it, that one. For null: a warning, and position is left alone. Beyond Karma.
 */
MEPUBLIC void MEAPI McdContactGetPosition(const McdContact *c, double position[3]);
/**
 * How round the surface of a model is at the contact: the radius (m) of the ball, or of the circle across a line of
 * touch, that its surface is there. When the model turns about the middle of that circle, which is
 *     on the surface of the first model:   position + (separation / 2 + radius) normal
 *     on the surface of the second model:  position - (separation / 2 + radius) normal,
 * the surface rolls: the place of contact does not go with it, nor do separation and normal change.
 * - sphere, both ends and the side of a sphyl: the radius; fat convex mesh: its fatness;
 * - side of a cylinder or cone, where the normal is across it to within .05 rad: the radius there, for a cone along its
 *   normal (from the surface to its axis);
 * - 0 for all else: faces, edges, corners, rims of discs, planes, triangles.
 * @param side 0: the first model (instance1); 1: the second. For another, and for null: 0, with a warning.
 * 0 too where a program has made the contact, or written another separation into it. Beyond Karma.
 */
MEPUBLIC double MEAPI McdContactGetRadius(const McdContact *c, int side);

/**
 * The circle that a model touches with: the rims of cylinders and cones, and their sides, across the axis. Returns its
 * radius (m) and writes its axis (unit, world), which goes through the middle of the model: however the model turns, it
 * is the point of this circle farthest towards the other model that touches. 0, and the axis as it was, where there is
 * none: other geometries, and discs whose axis is within .05 rad of the normal. Side and bad input as for
 * McdContactGetRadius; the models must be where they were tested. Beyond Karma.
 */
MEPUBLIC double MEAPI McdContactGetRim(const McdContact *c, int side, double axis[3]);

/**
 * Chooses at most @a nContacts_dest contacts that support as well as all of them do: spread out as far as possible,
 * different normals, the deepest among them. They are copied in the order they had.
 * @param avgNormal        the direction that faces have, for faceNormalsFirst; may be null.
 * @param contacts_src     nContacts_src contacts; may be the same array as contacts_dst.
 * @param faceNormalsFirst if true, contacts within 8 degrees of avgNormal are chosen before all others.
 * @param scale            the size of the models (m): contacts nearer than 1e-6 of it count as one; <= 0: 1.
 * Contacts with numbers that are not finite are left out. Takes memory for the time of the call.
 * @return how many were written; 0, with a warning, for null arrays or a count of contacts below 0.
 */
MEPUBLIC int MEAPI McdContactSimplify(const MeReal *avgNormal, McdContact *contacts_src, const int nContacts_src,
                                      McdContact *contacts_dst, const int nContacts_dest, const int faceNormalsFirst,
                                      const MeReal scale);

ME_END_C

#endif
