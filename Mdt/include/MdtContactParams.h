/** @file MdtContactParams.h
 *  The properties of contacts (Dynamics guide ch. 3, "The MdtBclContactParams Structure").
 *
 *  A set of parameters belongs to a contact (MdtContactGetParams), or is a program's own MdtBclContactParams that it
 *  copies into contacts. "Friction" sets both directions where no direction is named. A null set, a number that is not
 *  finite or out of its range gets a warning and changes nothing; accessors then return 0.
 *
 *  Friction needs three things: a type, a model, and the model's force or coefficient. A coefficient alone does
 *  nothing; a type alone is friction without bound. MdtContactParamsSetSurface sets all of them. If some are missing,
 *  the step gives a warning, once for each world and kind of omission, of a type alone, which the guides use, a MeInfo;
 *  not if the type FrictionZero, or a friction of MEINFINITY, was set by its function, which shows that it is meant.
 */
#ifndef MDTCONTACTPARAMS_H
#define MDTCONTACTPARAMS_H

#include "MdtTypes.h"

ME_BEGIN_C

/**
 * The usual surface: Coulomb friction with the coefficient @a friction (>= 0) in every direction, and @a restitution,
 * 0..1. Stands for type MdtContactTypeFriction2D (FrictionZero for 0), both models MdtFrictionModelCone, which has the
 * normal force of the very step as its bound, both coefficients, and MdtContactParamsSetRestitution. All else stays.
 * Beyond Karma.
 */
MEPUBLIC void MEAPI MdtContactParamsSetSurface(const MdtContactParamsID p, MeReal friction, MeReal restitution);
/** Defaults: no friction, box model without bound, no restitution, velocity threshold 0.001 m/s, all else 0. The
 *  parameters of new contacts, and of new materials of a bridge, have the threshold times the length scale. */
MEPUBLIC void MEAPI MdtContactParamsReset(const MdtContactParamsID p);

/** @name Kind of friction
 *  @{ */
MEPUBLIC void MEAPI MdtContactParamsSetType(const MdtContactParamsID p, MdtContactType t);
MEPUBLIC MdtContactType MEAPI MdtContactParamsGetType(const MdtContactParamsID p);
MEPUBLIC void MEAPI MdtContactParamsSetFrictionModel(const MdtContactParamsID p, MdtFrictionModel m);
MEPUBLIC void MEAPI MdtContactParamsSetPrimaryFrictionModel(const MdtContactParamsID p, MdtFrictionModel m);
MEPUBLIC void MEAPI MdtContactParamsSetSecondaryFrictionModel(const MdtContactParamsID p, MdtFrictionModel m);
MEPUBLIC MdtFrictionModel MEAPI MdtContactParamsGetPrimaryFrictionModel(const MdtContactParamsID p);
MEPUBLIC MdtFrictionModel MEAPI MdtContactParamsGetSecondaryFrictionModel(const MdtContactParamsID p);
/** @} */

/** @name Friction: N for the box model, >= 0, MEINFINITY for no sliding at all
 *  @{ */
MEPUBLIC void MEAPI MdtContactParamsSetFriction(const MdtContactParamsID p, MeReal f);
MEPUBLIC void MEAPI MdtContactParamsSetPrimaryFriction(const MdtContactParamsID p, MeReal f);
MEPUBLIC void MEAPI MdtContactParamsSetSecondaryFriction(const MdtContactParamsID p, MeReal f);
MEPUBLIC MeReal MEAPI MdtContactParamsGetPrimaryFriction(const MdtContactParamsID p);
MEPUBLIC MeReal MEAPI MdtContactParamsGetSecondaryFriction(const MdtContactParamsID p);
/** @} */

/** @name Friction coefficient of the normal-force model, >= 0 (the spelling is the interface's)
 *  @{ */
MEPUBLIC void MEAPI MdtContactParamsSetFrictionCoeffecient(const MdtContactParamsID p, MeReal f);
MEPUBLIC void MEAPI MdtContactParamsSetPrimaryFrictionCoeffecient(const MdtContactParamsID p, MeReal f);
MEPUBLIC void MEAPI MdtContactParamsSetSecondaryFrictionCoeffecient(const MdtContactParamsID p, MeReal f);
MEPUBLIC MeReal MEAPI MdtContactParamsGetPrimaryFrictionCoeffecient(const MdtContactParamsID p);
MEPUBLIC MeReal MEAPI MdtContactParamsGetSecondaryFrictionCoeffecient(const MdtContactParamsID p);
/** @} */

/** @name Slip: tangential velocity per tangential force, m/s per N, >= 0; 0 turns it off
 *  The surface gives way at a velocity of slip times the tangential force of the contact. A body that is pushed with a
 *  force reaches the velocity slip times force with a time constant of slip times mass.
 *  @{ */
MEPUBLIC void MEAPI MdtContactParamsSetSlip(const MdtContactParamsID p, MeReal f);
MEPUBLIC void MEAPI MdtContactParamsSetPrimarySlip(const MdtContactParamsID p, MeReal s);
MEPUBLIC void MEAPI MdtContactParamsSetSecondarySlip(const MdtContactParamsID p, MeReal s);
MEPUBLIC MeReal MEAPI MdtContactParamsGetPrimarySlip(const MdtContactParamsID p);
MEPUBLIC MeReal MEAPI MdtContactParamsGetSecondarySlip(const MdtContactParamsID p);
/** @} */

/** @name Slide: velocity of the second body's surface that carries the first body along, m/s; needs friction
 *  @{ */
MEPUBLIC void MEAPI MdtContactParamsSetPrimarySlide(const MdtContactParamsID p, MeReal s);
MEPUBLIC void MEAPI MdtContactParamsSetSecondarySlide(const MdtContactParamsID p, MeReal s);
MEPUBLIC MeReal MEAPI MdtContactParamsGetPrimarySlide(const MdtContactParamsID p);
MEPUBLIC MeReal MEAPI MdtContactParamsGetSecondarySlide(const MdtContactParamsID p);
/** @} */

/** @name Restitution: rebound speed over impact speed, 0..1, for impacts above the threshold [m/s, >= 0]
 *  Bodies that close no faster than by the acceleration of one step are at rest against each other and do not bounce.
 *  @{ */
MEPUBLIC void MEAPI MdtContactParamsSetRestitution(const MdtContactParamsID p, MeReal r);
MEPUBLIC MeReal MEAPI MdtContactParamsGetRestitution(const MdtContactParamsID p);
MEPUBLIC void MEAPI MdtContactParamsSetRestitutionThreshold(const MdtContactParamsID p, MeReal v);
MEPUBLIC MeReal MEAPI MdtContactParamsGetRestitutionThreshold(const MdtContactParamsID p);
/** @} */

/** @name Softness: compliance along this contact's normal besides the world's epsilon, 1/kg, >= 0
 *  A load F rests softness F h² / gamma deep. Prevents jitter (Dynamics guide ch. 5); 0.0001 is a typical value.
 *  @{ */
MEPUBLIC void MEAPI MdtContactParamsSetSoftness(const MdtContactParamsID p, MeReal s);
MEPUBLIC MeReal MEAPI MdtContactParamsGetSoftness(const MdtContactParamsID p);
/** @} */

/** @name Adhesion: the force with which the contact may pull, N, >= 0; MEINFINITY: it never lets go
 *  @{ */
MEPUBLIC void MEAPI MdtContactParamsSetMaxAdhesiveForce(const MdtContactParamsID p, MeReal s);
MEPUBLIC MeReal MEAPI MdtContactParamsGetMaxAdhesiveForce(const MdtContactParamsID p);
/** @} */

ME_END_C

#endif
