/** @file MdtContact.h
 *  Contacts: points where two bodies, or a body and the world, touch (Dynamics guide ch. 3, "MdtContact").
 *
 *  A contact is created when bodies touch, enabled for a step, and destroyed or moved before the next. Its normal is
 *  the direction in which the first body is pushed. Its parameters determine friction and rebound
 *  (MdtContactParams.h). All vectors are in the world frame; a contact does not move with the bodies.
 *
 *  Bad input gets a warning and changes nothing, as in MdtConstraint.h.
 */
#ifndef MDTCONTACT_H
#define MDTCONTACT_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** The end of a list of contacts: null. */
extern MEPUBLIC const MdtContactID MdtContactInvalidID;

/**
 * Creates a contact, disabled, at the origin, with the normal (0, 1, 0), penetration 0 and default parameters. The
 * world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. The
 * guide's sample passes the two bodies as well: MdtContactCreate(world, body0, body1) attaches the contact to them.
 */
MEPUBLIC MdtContactID MEAPI MdtContactCreate(const MdtWorldID w);
/** Implements MdtContactCreate with three arguments. */
MEPUBLIC MdtContactID MEAPI MdtContactCreateBetween(const MdtWorldID w, const MdtBodyID b1, const MdtBodyID b2);
#ifdef __cplusplus
ME_END_C
inline MdtContactID MdtContactCreate(MdtWorldID w, MdtBodyID b1, MdtBodyID b2) {
    return MdtContactCreateBetween(w, b1, b2);
}
ME_BEGIN_C
#else
#define MDT_FOURTH(a, b, c, d, ...)      d
#define MdtContactCreateWith1(w)         (MdtContactCreate)(w)
#define MdtContactCreateWith3(w, b1, b2) MdtContactCreateBetween((w), (b1), (b2))
#define MdtContactCreate(...)                                                                                          \
    MDT_FOURTH(__VA_ARGS__, MdtContactCreateWith3, MdtContactCreate_takes_1_or_3_arguments, MdtContactCreateWith1, 0)  \
    (__VA_ARGS__)
#endif
/** Sets everything but the bodies to the defaults of a new contact. */
MEPUBLIC void MEAPI MdtContactReset(const MdtContactID c);
/** The contact as a constraint. Null if @a c is null. */
MEPUBLIC MdtConstraintID MEAPI MdtContactQuaConstraint(const MdtContactID c);
/** The constraint as a contact; null if it is none. */
MEPUBLIC MdtContactID MEAPI MdtConstraintDCastContact(const MdtConstraintID c);

/** @name Geometry
 *  @{ */
/** m, world frame. */
MEPUBLIC void MEAPI MdtContactSetPosition(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z);
/** m, world frame; 0 by default. */
MEPUBLIC void MEAPI MdtContactGetPosition(const MdtContactID c, MeVector3 v);
/** Normalized here; a zero normal gets a warning. A primary direction that was set is projected on the new plane. */
MEPUBLIC void MEAPI MdtContactSetNormal(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z);
/** Unit vector, world frame: the first body is pushed along it. Default (0, 1, 0). */
MEPUBLIC void MEAPI MdtContactGetNormal(const MdtContactID c, MeVector3 v);
/** m; positive for an overlap. Negative for a gap: the contact lets the bodies close the gap, but not overlap. */
MEPUBLIC void MEAPI MdtContactSetPenetration(const MdtContactID c, const MeReal p);
/** m; 0 by default. */
MEPUBLIC MeReal MEAPI MdtContactGetPenetration(const MdtContactID c);
/**
 * Position, m, and penetration, m, computed in double between bodies whose transforms were read from
 * MdtBodyGetTransformPtr. The rounding of these transforms to MeReal is compensated, so that single precision adds no
 * noise to bodies at rest, or rolling far away. Set bodies, normal and radii before. Beyond Karma.
 */
MEPUBLIC void MEAPI MdtContactSetExact(const MdtContactID c, const double position[3], const double penetration);
/**
 * m, >= 0: radius of the body's surface at the contact, if it is a sphere, or a cylinder with the normal across its
 * axis: it rolls. 0, the default: a corner, an edge or a face, which rotates with the body. Within a step contacts move
 * with the bodies.
 */
MEPUBLIC void MEAPI MdtContactSetRadius(const MdtContactID c, const unsigned int bodyindex, const MeReal radius);
/** m, of the body of index 0 or 1; 0, the default: none. */
MEPUBLIC MeReal MEAPI MdtContactGetRadius(const MdtContactID c, const unsigned int bodyindex);
/**
 * The body touches with the point of a circle that lies farthest along the normal, as the rims of coins do: radius, m,
 * >= 0, and axis, in the world frame, of any length but 0. Radius 0, the default: no circle. The circle takes
 * precedence over the radius of MdtContactSetRadius. MdtContactGetRim returns the radius and writes the axis, zero if
 * there is no circle. Beyond Karma.
 */
MEPUBLIC void MEAPI MdtContactSetRim(const MdtContactID c, const unsigned int bodyindex, const MeReal radius,
                                     const MeVector3 axis);
/** m, of the body of index 0 or 1; writes the axis, a unit vector in the world frame. */
MEPUBLIC MeReal MEAPI MdtContactGetRim(const MdtContactID c, const unsigned int bodyindex, MeVector3 axis);
/**
 * The body touches with an edge, or with the side of a capsule, whose radius is that of MdtContactSetRadius: the axis
 * along it, in the world frame, of any length. As something round rolls over it, the normal turns about this axis. 0,
 * the default: no edge. Removes a circle (MdtContactSetRim). MdtContactGetEdge tells whether there is one, and writes
 * its unit axis, zero if there is none. Beyond Karma.
 */
MEPUBLIC void MEAPI MdtContactSetEdge(const MdtContactID c, const unsigned int bodyindex, const MeVector3 axis);
/** Writes the axis of the body of index 0 or 1; MEFALSE by default. */
MEPUBLIC MeBool MEAPI MdtContactGetEdge(const MdtContactID c, const unsigned int bodyindex, MeVector3 axis);
/**
 * Whether a vertex of the body touches: within a step the contact then moves with this body, as when a box rocks on
 * its corners. False, the default: the contact moves with the rotation that both bodies have in common. A circle or a
 * radius takes precedence. Beyond Karma.
 */
MEPUBLIC void MEAPI MdtContactSetVertex(const MdtContactID c, const unsigned int bodyindex, const MeBool isVertex);
/** MEFALSE by default. */
MEPUBLIC MeBool MEAPI MdtContactIsVertex(const MdtContactID c, const unsigned int bodyindex);
/** Feature id: a number by which the contact's maker recognizes it in the next step. Not used otherwise. Default 0. */
MEPUBLIC void MEAPI MdtContactSetFeature(const MdtContactID c, const MeU32 feature);
/** 0 by default. */
MEPUBLIC MeU32 MEAPI MdtContactGetFeature(const MdtContactID c);
/** The primary direction; its component along the normal is removed. Needed only for anisotropic friction, else one is
 *  chosen. The secondary direction is normal x primary. */
MEPUBLIC void MEAPI MdtContactSetDirection(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z);
/** Unit vector, world frame: the primary direction, set or chosen. */
MEPUBLIC void MEAPI MdtContactGetDirection(const MdtContactID c, MeVector3 v);
/** @} */

/** @name Parameters
 *  @{ */
/** Pointer to the contact's own parameters, for reading and writing; valid as long as the contact. */
MEPUBLIC MdtContactParamsID MEAPI MdtContactGetParams(const MdtContactID c);
/** Copies all of @a p. */
MEPUBLIC void MEAPI MdtContactSetParams(const MdtContactID c, const MdtContactParamsID p);
/** m/s, velocity of the world's surface at the contact (MdtConstraintSetWorldLinearVelocity). */
MEPUBLIC void MEAPI MdtContactSetWorldVelocity(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z);
/** m/s; 0 by default. */
MEPUBLIC void MEAPI MdtContactGetWorldVelocity(const MdtContactID c, MeVector3 v);
/** @} */

/** m/s, the present velocity of the first body relative to the second at the contact. */
MEPUBLIC void MEAPI MdtContactGetRelativeVelocity(const MdtContactID c, MeVector3 v);

/** @name A linked list of contacts for their maker (collision uses it)
 *  @{ */
/** Sets the contact after @a c in the maker's list. */
MEPUBLIC void MEAPI MdtContactSetNext(const MdtContactID c, const MdtContactID nc);
/** MdtContactInvalidID at the end. */
MEPUBLIC MdtContactID MEAPI MdtContactGetNext(const MdtContactID c);
/** @} */

/** The group that the contact belongs to (MdtContactGroup.h); null if there is none. */
MEPUBLIC MdtContactGroupID MEAPI MdtContactGetContactGroup(const MdtContactID c);

/** @name Functions that every constraint has, under its own name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtContactDestroy(const MdtContactID j);
/** Lets it act. No effect on a contact in a group. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtContactEnable(const MdtContactID j);
/** Ends its effect and wakes its sleeping bodies. No effect on a contact in a group. */
MEPUBLIC void MEAPI MdtContactDisable(const MdtContactID j);
/** Of a contact in a group: whether the group is enabled. */
MEPUBLIC MeBool MEAPI MdtContactIsEnabled(const MdtContactID j);
/** Attaches it; at most one body may be null, the world. A contact in a group has the group's bodies: a warning. */
MEPUBLIC void MEAPI MdtContactSetBodies(const MdtContactID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtContactGetBody(const MdtContactID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1 in the last step, normal force and friction; 0 before the first. */
MEPUBLIC void MEAPI MdtContactGetForce(const MdtContactID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: the moment of that force about the body's centre of mass at the start of the step. Torques of
 *  rolling and spinning friction are left out. */
MEPUBLIC void MEAPI MdtContactGetTorque(const MdtContactID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtContactGetWorld(const MdtContactID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtContactSetUserData(const MdtContactID j, void *data);
/** The pointer of MdtContactSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtContactGetUserData(const MdtContactID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first. In a group the order of adding counts instead. */
MEPUBLIC void MEAPI MdtContactSetSortKey(const MdtContactID j, const MeI32 key);
/** The key of MdtContactSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtContactGetSortKey(const MdtContactID j);
/** @} */

ME_END_C

#endif
