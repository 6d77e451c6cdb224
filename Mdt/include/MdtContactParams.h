/** @file MdtContactParams.h
 *  The properties of contacts (Dynamics guide ch. 3, "The MdtBclContactParams Structure").
 *
 *  A set of parameters belongs to a contact (MdtContactGetParams), or is the program's own MdtBclContactParams, which
 *  it copies into contacts. Functions without "Primary" or "Secondary" in their name set both directions. A null set,
 *  and a number that is not finite or out of its range, gets a warning and changes nothing; accessors then return 0.
 *
 *  Friction needs three settings: a type, a model, and the model's force or coefficient. A coefficient alone has no
 *  effect; a type alone is friction without bound. MdtContactParamsSetSurface sets all of them. If some are missing, a
 *  step gives a warning, once per world and kind of omission; for a type alone, which the guides use, a MeInfo. No
 *  message is given if the type FrictionZero, or a friction of MEINFINITY, was set by its function, since that is
 *  intended.
 */
#ifndef MDTCONTACTPARAMS_H
#define MDTCONTACTPARAMS_H

#include "MdtTypes.h"

ME_BEGIN_C

/**
 * The usual surface: Coulomb friction with the coefficient @a friction (>= 0) in every direction, and @a restitution,
 * 0..1. Sets the type MdtContactTypeFriction2D (FrictionZero for 0), both models to MdtFrictionModelCone, which is
 * bound by the normal force of the same step, both coefficients, and the restitution. Other parameters do not change.
 * Beyond Karma.
 */
MEPUBLIC void MEAPI MdtContactParamsSetSurface(const MdtContactParamsID p, MeReal friction, MeReal restitution);
/** Defaults: no friction, box model without bound, no restitution, velocity threshold 0.001 m/s, all else 0. In the
 *  parameters of new contacts, and of a bridge's new materials, the threshold is multiplied by the length scale. */
MEPUBLIC void MEAPI MdtContactParamsReset(const MdtContactParamsID p);

/** @name Kind of friction
 *  A value that is none of the enumeration (MdtBclTypes.h) gets a warning and changes nothing.
 *  @{ */
/** None, along the primary direction, or in the contact plane. Default MdtContactTypeFrictionZero. */
MEPUBLIC void MEAPI MdtContactParamsSetType(const MdtContactParamsID p, MdtContactType t);
/** MdtContactTypeFrictionZero by default. */
MEPUBLIC MdtContactType MEAPI MdtContactParamsGetType(const MdtContactParamsID p);
/** Whether the bound of friction is a force, or a coefficient times the normal force for each direction or for both
 *  together (the cone). Default MdtFrictionModelBox. */
MEPUBLIC void MEAPI MdtContactParamsSetFrictionModel(const MdtContactParamsID p, MdtFrictionModel m);
/** The model along the primary direction only. */
MEPUBLIC void MEAPI MdtContactParamsSetPrimaryFrictionModel(const MdtContactParamsID p, MdtFrictionModel m);
/** The model along the secondary direction only; used with MdtContactTypeFriction2D. */
MEPUBLIC void MEAPI MdtContactParamsSetSecondaryFrictionModel(const MdtContactParamsID p, MdtFrictionModel m);
/** MdtFrictionModelBox by default. */
MEPUBLIC MdtFrictionModel MEAPI MdtContactParamsGetPrimaryFrictionModel(const MdtContactParamsID p);
/** MdtFrictionModelBox by default. */
MEPUBLIC MdtFrictionModel MEAPI MdtContactParamsGetSecondaryFrictionModel(const MdtContactParamsID p);
/** @} */

/** @name Friction force of the box model, N, >= 0; MEINFINITY, the default: no sliding
 *  It is a force and no coefficient, and acts only with a type and the box model: MdtContactParamsSetSurface sets
 *  Coulomb's friction.
 *  @{ */
/** N, in both directions. */
MEPUBLIC void MEAPI MdtContactParamsSetFriction(const MdtContactParamsID p, MeReal f);
/** N, along the primary direction. */
MEPUBLIC void MEAPI MdtContactParamsSetPrimaryFriction(const MdtContactParamsID p, MeReal f);
/** N, along the secondary direction. */
MEPUBLIC void MEAPI MdtContactParamsSetSecondaryFriction(const MdtContactParamsID p, MeReal f);
/** N; MEINFINITY by default. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetPrimaryFriction(const MdtContactParamsID p);
/** N; MEINFINITY by default. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetSecondaryFriction(const MdtContactParamsID p);
/** @} */

/** @name Friction coefficient of the normal-force model and of the cone, >= 0, default 0 (the misspelling is Karma's)
 *  @{ */
/** Without unit, in both directions. No effect with the box model or the type FrictionZero. */
MEPUBLIC void MEAPI MdtContactParamsSetFrictionCoeffecient(const MdtContactParamsID p, MeReal f);
/** Along the primary direction. */
MEPUBLIC void MEAPI MdtContactParamsSetPrimaryFrictionCoeffecient(const MdtContactParamsID p, MeReal f);
/** Along the secondary direction. */
MEPUBLIC void MEAPI MdtContactParamsSetSecondaryFrictionCoeffecient(const MdtContactParamsID p, MeReal f);
/** 0 by default. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetPrimaryFrictionCoeffecient(const MdtContactParamsID p);
/** 0 by default. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetSecondaryFrictionCoeffecient(const MdtContactParamsID p);
/** @} */

/** @name Slip: tangential velocity per tangential force, m/s per N, >= 0; 0, the default: no slip
 *  The surfaces slide at a velocity of slip times the tangential force of the contact. A body under a constant force
 *  approaches the velocity slip times force with the time constant slip times mass.
 *  @{ */
/** m/s per N, in both directions. */
MEPUBLIC void MEAPI MdtContactParamsSetSlip(const MdtContactParamsID p, MeReal f);
/** m/s per N, along the primary direction. */
MEPUBLIC void MEAPI MdtContactParamsSetPrimarySlip(const MdtContactParamsID p, MeReal s);
/** m/s per N, along the secondary direction. */
MEPUBLIC void MEAPI MdtContactParamsSetSecondarySlip(const MdtContactParamsID p, MeReal s);
/** m/s per N; 0 by default. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetPrimarySlip(const MdtContactParamsID p);
/** m/s per N; 0 by default. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetSecondarySlip(const MdtContactParamsID p);
/** @} */

/** @name Slide: velocity of the second body's surface, which carries the first body along, m/s; needs friction
 *  Along the primary and the secondary direction of the contact (MdtContactSetDirection). Default 0.
 *  @{ */
/** m/s, along the primary direction; either sign. */
MEPUBLIC void MEAPI MdtContactParamsSetPrimarySlide(const MdtContactParamsID p, MeReal s);
/** m/s, along the secondary direction; either sign. */
MEPUBLIC void MEAPI MdtContactParamsSetSecondarySlide(const MdtContactParamsID p, MeReal s);
/** m/s; 0 by default. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetPrimarySlide(const MdtContactParamsID p);
/** m/s; 0 by default. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetSecondarySlide(const MdtContactParamsID p);
/** @} */

/** @name Rolling and spinning friction, m, >= 0; 0: none, the default. Beyond Karma.
 *  The largest torque with which the contact resists rolling (about axes at right angles to the normal) and spinning
 *  (about the normal) is this length times the normal force. It is the distance by which the normal force acts ahead of
 *  the centre of the contact: for spinning, 2/3 of the radius of a contact patch times its coefficient of friction. A
 *  ball of radius R that rolls with the speed v on a floor comes to rest after 7/10 v² R / (r g), with the rolling
 *  friction r, and stays on a slope up to r / R. Independent of the other friction, which rolling needs.
 *  @{ */
/** m, against rolling; for a car's tyre on asphalt some 0.01 of its radius. */
MEPUBLIC void MEAPI MdtContactParamsSetRollingFriction(const MdtContactParamsID p, MeReal r);
/** m; 0 by default. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetRollingFriction(const MdtContactParamsID p);
/** m, against spinning about the normal. */
MEPUBLIC void MEAPI MdtContactParamsSetSpinningFriction(const MdtContactParamsID p, MeReal r);
/** m; 0 by default. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetSpinningFriction(const MdtContactParamsID p);
/** @} */

/** @name Restitution: rebound speed over impact speed, 0..1, for impacts above the threshold [m/s, >= 0]
 *  Bodies whose closing speed is at most what their acceleration gives in one step count as resting, and do not bounce.
 *  @{ */
/** 0: no rebound, the default; 1: with the full speed. */
MEPUBLIC void MEAPI MdtContactParamsSetRestitution(const MdtContactParamsID p, MeReal r);
/** 0 by default. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetRestitution(const MdtContactParamsID p);
/** m/s: slower impacts do not rebound. */
MEPUBLIC void MEAPI MdtContactParamsSetRestitutionThreshold(const MdtContactParamsID p, MeReal v);
/** m/s; 0.001 by default, in new contacts and materials times the length scale. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetRestitutionThreshold(const MdtContactParamsID p);
/** @} */

/** @name Softness: compliance along this contact's normal, added to the world's epsilon, 1/kg, >= 0
 *  A load F sinks by softness F h² / gamma. Prevents jitter (Dynamics guide ch. 5); 0.0001 is a typical value.
 *  @{ */
/** 1/kg. A number that is negative or not finite gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtContactParamsSetSoftness(const MdtContactParamsID p, MeReal s);
/** 1/kg; 0 by default. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetSoftness(const MdtContactParamsID p);
/** @} */

/** @name Adhesion: the largest pulling force of the contact, N, >= 0, default 0
 *  MEINFINITY: the bodies never separate.
 *  @{ */
/** N. It pulls while the bodies are within the contact's reach: a contact must be there. */
MEPUBLIC void MEAPI MdtContactParamsSetMaxAdhesiveForce(const MdtContactParamsID p, MeReal s);
/** N; 0 by default. */
MEPUBLIC MeReal MEAPI MdtContactParamsGetMaxAdhesiveForce(const MdtContactParamsID p);
/** @} */

ME_END_C

#endif
