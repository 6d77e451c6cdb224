/** @file MdtBclTypes.h
 *  What the basic constraint library keeps of a joint, a limit and a contact (Dynamics guide ch. 3).
 *
 *  Programs meet these types through MdtTypes.h. The structures of limits and contact parameters may be read and
 *  written directly; the functions of MdtLimit.h and MdtContactParams.h do it with checks.
 */
#ifndef MDTBCLTYPES_H
#define MDTBCLTYPES_H

#include "MdtKea.h"

ME_BEGIN_C

/** The kinds of constraint. */
typedef enum MdtBclJointType {
    MdtBclBSJOINT = 0,
    MdtBclHINGE = 1,
    MdtBclPRISMATIC = 2,
    MdtBclCARWHEEL = 3,
    MdtBclCONTACT = 4,
    MdtBclCONTACTGROUP = 5,
    MdtBclFIXEDPATH = 6,
    MdtBclRPROJOINT = 7,
    MdtBclUNIVERSAL = 8,
    MdtBclSKELETAL = 9,
    MdtBclLINEAR1 = 10,
    MdtBclLINEAR2 = 11,
    MdtBclANGULAR3 = 12,
    MdtBclSPRING6 = 13,
    MdtBclSPRING = 14,
    MdtBclCONELIMIT = 15,
    MdtBclUSER = 16,
    MdtBclFPFOJOINT = 17,
} MdtBclJointType;

#define MdtBclNO_BODY MdtKeaWORLD /**< In place of a body's index: the world. */

/** One stop of a limit (Dynamics guide ch. 3, "The Single Joint Limit"). m and N, or rad and N m. */
typedef struct MdtBclSingleLimit {
    MeReal damping;     /**< N s/m, >= 0; used when stiffness is at most the limit's threshold. Default 0. */
    MeReal restitution; /**< 0..1, rebound speed over impact speed at a hard stop. Default 1. */
    MeReal stiffness;   /**< N/m, >= 0; MEINFINITY (the default) makes the stop hard. */
    MeReal stop;        /**< m, where the stop is. Default 0. */
} MdtBclSingleLimit;

/** The limits and the motor of one degree of freedom of a joint (Dynamics guide ch. 3, "Joint Limit"). */
typedef struct MdtBclLimit {
    MdtBclSingleLimit limit[2]; /**< lower and upper stop */
    MeReal position;            /**< m, the coordinate at the last step's end, offset included */
    MeReal velocity;            /**< m/s, its rate */
    MeReal offset;              /**< m, what is added to the measured coordinate */
    MeReal stiffnessThreshold;  /**< N/m; above it a stop is hard, at or below it a damped spring */
    MeReal desired_vel;         /**< m/s, what the motor aims at */
    MeReal fmax;                /**< N, the most that the motor may push, either way */
    MeReal lock;                /**< m, where the lock holds the coordinate */
    MeReal lockForce;           /**< N, the most that the lock holds with, either way */
    MeBool bLocked;             /**< the lock holds; the motor then rests */
    MeBool bPowered;            /**< the motor runs */
    MeBool bMotorTracks;        /**< it moves the coordinate by the step's length times its velocity in every step */
    MeBool bActive;             /**< the stops act */
    MeBool bCalculatePosition;  /**< the coordinate is measured though neither of the above is set */
    /* Kept by the library from step to step. */
    double measured;     /**< m, the coordinate without offset; an angle counts full turns */
    MeBool isMeasured;   /**< `measured` holds a value to count on from */
    int rows;            /**< which rows are in this step's system: 1 motor, 2 lower stop, 4 upper stop, 8 lock */
    double stopForce[2]; /**< N, of the stops in the last step, >= 0 */
} MdtBclLimit;

typedef enum MdtContactType {
    MdtContactTypeUnknown = -1,
    MdtContactTypeFrictionZero = 0, /**< no friction */
    MdtContactTypeFriction1D = 1,   /**< friction along the primary direction only */
    MdtContactTypeFriction2D = 2,   /**< friction in both directions of the contact plane */
} MdtContactType;

typedef enum MdtFrictionModel {
    MdtFrictionModelUnknown = -1,
    MdtFrictionModelBox = 0,         /**< a constant bound, friction1 or friction2, whatever the normal force */
    MdtFrictionModelNormalForce = 1, /**< Coulomb: the bound is the coefficient times the normal force */
    MdtFrictionModelCone = 2,        /**< the same for both directions together, with the primary coefficient */
} MdtFrictionModel;

/** Which of a contact's parameters are in use. The functions of MdtContactParams.h set them. */
typedef enum MdtBclContactOption {
    MdtBclContactOptionUseDirection = 1,       /**< the primary direction was set, not chosen */
    MdtBclContactOptionBounce = 2,             /**< restitution */
    MdtBclContactOptionSoft = 4,               /**< softness */
    MdtBclContactOptionAdhesive = 8,           /**< max_adhesive_force */
    MdtBclContactOptionSlip1 = 16,             /**< slip1 */
    MdtBclContactOptionSlip2 = 32,             /**< slip2 */
    MdtBclContactOptionSlide1 = 64,            /**< slide1 */
    MdtBclContactOptionSlide2 = 128,           /**< slide2 */
    MdtBclContactOptionTypeSet = 512,          /**< the type was chosen, not left at its default */
    MdtBclContactOptionBoundSet = 1024,        /**< friction1 or friction2 was */
    MdtBclContactOptionUseWorldVelocity = 256, /**< the world's velocity at the contact was set */
} MdtBclContactOption;

/** The properties of a contact (Dynamics guide ch. 3, "The MdtBclContactParams Structure"). */
typedef struct MdtBclContactParams {
    MdtContactType type;
    MdtFrictionModel model1; /**< along the primary direction */
    MdtFrictionModel model2; /**< along the secondary direction */
    int options;             /**< MdtBclContactOption, or-ed */
    union {
        MeReal FrictionCoefficient; /**< of the normal-force model, along the primary direction */
        MeReal frictioncoeff1;      /**< the same member under the name that 1.2 gave it */
    };
    union {
        MeReal FrictionCoefficient2; /**< the same along the secondary direction */
        MeReal frictioncoeff2;       /**< the same member under the name that 1.2 gave it */
    };
    MeReal restitution;        /**< 0..1 */
    MeReal velThreshold;       /**< m/s, slower impacts do not bounce */
    MeReal softness;           /**< 1/kg, added to the world's epsilon along this contact's normal */
    MeReal max_adhesive_force; /**< N, how hard the contact may pull */
    MeReal friction1;          /**< N, bound of the box model, primary direction; MEINFINITY: none */
    MeReal friction2;          /**< N, the same along the secondary direction */
    MeReal slip1;              /**< m/s per N along the primary direction */
    MeReal slip2;              /**< m/s per N along the secondary direction */
    MeReal slide1;             /**< m/s, surface velocity along the primary direction */
    MeReal slide2;             /**< m/s, the same along the secondary direction */
} MdtBclContactParams;

/** The rows of a constraint that a program writes (MdtBcl.h). */
typedef struct MdtKeaConstraints MdtKeaConstraints;

/**
 * Writes the rows of a user constraint for one step, with MdtBclAddRow. @a constraint is what
 * MdtUserConstraintSetFunction was given; @a tlist and @a blist are the poses and Kea's bodies of the constraint's body
 * 0 and body 1 (the world: the identity and null); @a params is the step's MdtBclSolverParameters. What it may do else:
 * docs/simulation.md, "Callbacks".
 */
typedef void(MEAPI *MdtBclAddConstraintFn)(MdtKeaConstraints *const keaConstraints, void *const constraint,
                                           const MdtKeaTransformation *const tlist, MdtKeaBody *const blist[],
                                           const void *const params);

/** A step's parameters, for the rows. */
typedef struct MdtBclSolverParameters {
    double stepsize;    /**< s */
    double epsilon;     /**< 1/kg, the world's, made fit for this length of step */
    double gamma;       /**< fraction of an error that one step removes, made fit for this length of step */
    double softening;   /**< what epsilon was multiplied by to make it fit; for other compliances of its kind */
    MeBool hasContacts; /**< something in the partition may be hit */
} MdtBclSolverParameters;

ME_END_C

#endif
