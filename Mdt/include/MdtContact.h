/** @file MdtContact.h
 *  Contacts: points where two bodies, or a body and the world, touch (Dynamics guide ch. 3, "MdtContact").
 *
 *  A contact is created when bodies touch, enabled for a step, and destroyed or moved before the next. Its normal is
 *  the way in which the first body is pushed. What happens along the surface is said by its parameters
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
/** What the form with three arguments stands for. */
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
/** The contact as a constraint. Null for null. */
MEPUBLIC MdtConstraintID MEAPI MdtContactQuaConstraint(const MdtContactID c);
/** The constraint as a contact; null when it is none. */
MEPUBLIC MdtContactID MEAPI MdtConstraintDCastContact(const MdtConstraintID c);

/** @name Geometry
 *  @{ */
MEPUBLIC void MEAPI MdtContactSetPosition(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtContactGetPosition(const MdtContactID c, MeVector3 v);
/** Normalized; a zero normal gets a warning. A primary direction that was set is kept as far as it is tangential. */
MEPUBLIC void MEAPI MdtContactSetNormal(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtContactGetNormal(const MdtContactID c, MeVector3 v);
/** m; positive where the bodies overlap, negative for a gap, which the contact lets the bodies close and no more. */
MEPUBLIC void MEAPI MdtContactSetPenetration(const MdtContactID c, const MeReal p);
MEPUBLIC MeReal MEAPI MdtContactGetPenetration(const MdtContactID c);
/**
 * Position, m, and penetration, m, as they were found in double between bodies whose transforms were read from
 * MdtBodyGetTransformPtr. What those lost by rounding to MeReal is put back, so that single precision adds no noise to
 * a body that rests, or rolls far away. Bodies, normal and radii must be set before. Beyond Karma.
 */
MEPUBLIC void MEAPI MdtContactSetExact(const MdtContactID c, const double position[3], const double penetration);
/**
 * m, >= 0: the surface of the body of this side is a sphere of that radius there, or a cylinder that the normal goes
 * across, and rolls on; 0, the default: it is a corner, an edge or a face, which turns with the body. Within a step
 * contacts move with the bodies.
 */
MEPUBLIC void MEAPI MdtContactSetRadius(const MdtContactID c, const unsigned int bodyindex, const MeReal radius);
MEPUBLIC MeReal MEAPI MdtContactGetRadius(const MdtContactID c, const unsigned int bodyindex);
/**
 * The surface of the body of this side touches with the point of a circle that lies farthest along the normal, as rims
 * of coins do: radius, m, >= 0, and axis, in the world's axes, of any length but 0. 0, the default: there is none. It
 * comes before the radius that MdtContactSetRadius sets. MdtContactGetRim returns the radius and writes the axis, zero
 * where there is no circle. Beyond Karma.
 */
MEPUBLIC void MEAPI MdtContactSetRim(const MdtContactID c, const unsigned int bodyindex, const MeReal radius,
                                     const MeVector3 axis);
MEPUBLIC MeReal MEAPI MdtContactGetRim(const MdtContactID c, const unsigned int bodyindex, MeVector3 axis);
/** A number by which the maker of contacts knows this one again in the next step. Nothing else uses it. Default 0. */
MEPUBLIC void MEAPI MdtContactSetFeature(const MdtContactID c, const MeU32 feature);
MEPUBLIC MeU32 MEAPI MdtContactGetFeature(const MdtContactID c);
/** The primary direction, at right angles to the normal (the part along the normal is taken off). Needed only where
 *  friction differs with direction; else one is chosen. The secondary direction is normal x primary. */
MEPUBLIC void MEAPI MdtContactSetDirection(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtContactGetDirection(const MdtContactID c, MeVector3 v);
/** @} */

/** @name Parameters
 *  @{ */
/** The contact's own parameters, to read and to write; they live as long as the contact. */
MEPUBLIC MdtContactParamsID MEAPI MdtContactGetParams(const MdtContactID c);
/** Copies all of @a p. */
MEPUBLIC void MEAPI MdtContactSetParams(const MdtContactID c, const MdtContactParamsID p);
/** m/s of the world's surface at the contact: MdtConstraintSetWorldLinearVelocity. */
MEPUBLIC void MEAPI MdtContactSetWorldVelocity(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtContactGetWorldVelocity(const MdtContactID c, MeVector3 v);
/** @} */

/** m/s, of the first body against the second at the contact, now. */
MEPUBLIC void MEAPI MdtContactGetRelativeVelocity(const MdtContactID c, MeVector3 v);

/** @name A list of contacts, kept by whoever makes them (collision uses it)
 *  @{ */
MEPUBLIC void MEAPI MdtContactSetNext(const MdtContactID c, const MdtContactID nc);
/** MdtContactInvalidID at the end. */
MEPUBLIC MdtContactID MEAPI MdtContactGetNext(const MdtContactID c);
/** @} */

/** The group that the contact belongs to (MdtContactGroup.h); null: none. */
MEPUBLIC MdtContactGroupID MEAPI MdtContactGetContactGroup(const MdtContactID c);

/** @name What every constraint has, under its own name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h).
 *  @{ */
MEPUBLIC void MEAPI MdtContactDestroy(const MdtContactID j);
MEPUBLIC void MEAPI MdtContactEnable(const MdtContactID j);
MEPUBLIC void MEAPI MdtContactDisable(const MdtContactID j);
MEPUBLIC MeBool MEAPI MdtContactIsEnabled(const MdtContactID j);
MEPUBLIC void MEAPI MdtContactSetBodies(const MdtContactID j, const MdtBodyID b1, const MdtBodyID b2);
MEPUBLIC MdtBodyID MEAPI MdtContactGetBody(const MdtContactID j, const unsigned int bodyindex);
MEPUBLIC void MEAPI MdtContactGetForce(const MdtContactID j, const unsigned int bodyindex, MeVector3 force);
MEPUBLIC void MEAPI MdtContactGetTorque(const MdtContactID j, const unsigned int bodyindex, MeVector3 torque);
MEPUBLIC MdtWorldID MEAPI MdtContactGetWorld(const MdtContactID j);
MEPUBLIC void MEAPI MdtContactSetUserData(const MdtContactID j, void *data);
MEPUBLIC void *MEAPI MdtContactGetUserData(const MdtContactID j);
MEPUBLIC void MEAPI MdtContactSetSortKey(const MdtContactID j, const MeI32 key);
MEPUBLIC MeI32 MEAPI MdtContactGetSortKey(const MdtContactID j);
/** @} */

ME_END_C

#endif
