/** @file McdContact.h
 *  Further properties of contacts, and contact reduction.
 */
#ifndef MCDCONTACT_H
#define MCDCONTACT_H

#include "McdCTypes.h"

ME_BEGIN_C

/**
 * The separation (m) in double precision, before rounding to McdContact.separation. If the program has made the contact
 * or changed its separation: McdContact.separation. 0, with a warning, for null. Beyond Karma.
 */
MEPUBLIC double MEAPI McdContactGetSeparation(const McdContact *c);
/**
 * The position (m, world) in double precision, before rounding to McdContact.position. If the program has made the
 * contact or changed its position: McdContact.position. For null: a warning, and position is not written. Beyond Karma.
 */
MEPUBLIC void MEAPI McdContactGetPosition(const McdContact *c, double position[3]);
/**
 * The radius (m) of a model's surface at the contact, where it is round: that of a sphere or, for a line contact, of
 * the circle across the line. If the model rotates about the centre of that circle, which is
 *     for the first model:   position + (separation / 2 + radius) normal
 *     for the second model:  position - (separation / 2 + radius) normal,
 * its surface rolls: the contact point does not move with the model, and separation and normal do not change.
 * - sphere, both ends and the side of a sphyl: the radius; fat convex mesh: its fatness;
 * - side of a cylinder or cone, if the normal is within .05 rad of the side's normal: the radius there, for a cone
 *   along its normal (from the surface to its axis);
 * - 0 for everything else: faces, edges, corners, rims of discs, planes, triangles.
 * @param side 0: the first model (instance1); 1: the second. For other values and for null: 0, with a warning.
 * Also 0 if the program has made the contact or changed its separation. Beyond Karma.
 */
MEPUBLIC double MEAPI McdContactGetRadius(const McdContact *c, int side);

/**
 * The circle about a model's axis on which the contact lies: for cylinders and cones, on their rims and sides. Returns
 * its radius (m) and writes its axis (unit, world), which passes through the model's centre: however the model rotates,
 * the contact is the point of this circle that is farthest towards the other model. 0, and the axis is not written, for
 * other geometries, and for discs whose axis is within .05 rad of the normal. `side` and bad arguments as for
 * McdContactGetRadius; the models must be where they were tested. Beyond Karma.
 */
MEPUBLIC double MEAPI McdContactGetRim(const McdContact *c, int side, double axis[3]);

/**
 * Whether a model touches with an edge, or with the side of a capsule or cylinder: the line along it, about which the
 * normal turns as something round rolls over it. Writes its axis (unit, world). False, and nothing is written, for
 * faces, vertices and round ends, and for triangles that it rolls onto within the step. `side` and bad arguments as for
 * McdContactGetRim. Beyond Karma.
 */
MEPUBLIC MeBool MEAPI McdContactGetEdge(const McdContact *c, int side, double axis[3]);

/**
 * Whether a vertex of a polyhedral model touches: the contact point then moves with this model. False for points
 * inside of edges and faces, for round surfaces, and for rims. `side` and bad arguments as for McdContactGetRadius.
 * Beyond Karma.
 */
MEPUBLIC MeBool MEAPI McdContactIsVertex(const McdContact *c, int side);

/**
 * The material of a model at the contact: that of the mesh's triangle (McdMesh.h) or else of the child shape (instance1
 * or instance2). `side` and bad arguments as for McdContactGetRadius. Beyond Karma.
 */
MEPUBLIC unsigned int MEAPI McdContactGetMaterial(const McdContact *c, int side);

/**
 * Contact reduction: chooses the deepest contact and, one by one, at most @a nContacts_dest that need support most:
 * those that overlap most where bodies tilt and the chosen ones do not overlap. A difference of normals counts as a
 * distance. Contacts that cannot overlap then are left out. They are copied in their original order.
 * @param avgNormal        the faces' normal, for faceNormalsFirst; may be null.
 * @param contacts_src     nContacts_src contacts; may be the same array as contacts_dst.
 * @param faceNormalsFirst if true, contacts within 8 degrees of avgNormal are chosen before all others.
 * @param scale            the size of the models (m): contacts nearer than 1e-6 of it count as one; <= 0: 1.
 * Contacts that are not finite are left out. Allocates memory for the duration of the call.
 * @return the number of contacts written; 0, with a warning, for null arrays or a negative count.
 */
MEPUBLIC int MEAPI McdContactSimplify(const MeReal *avgNormal, McdContact *contacts_src, const int nContacts_src,
                                      McdContact *contacts_dst, const int nContacts_dest, const int faceNormalsFirst,
                                      const MeReal scale);

ME_END_C

#endif
