/** @file MdtBclTypes.h
 *  Types of the basic constraint library: joint types, limits and contact parameters (Dynamics guide ch. 3).
 *
 *  Programs get these types by including MdtTypes.h. They may read and write limits and contact parameters directly, or
 *  by the functions of MdtLimit.h and MdtContactParams.h, which check what they are given.
 */
#ifndef MDTBCLTYPES_H
#define MDTBCLTYPES_H

#include "MdtKea.h"

ME_BEGIN_C

/** Types of constraints. */
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
    MdtBclGEAR = 18,
    MdtBclPULLEY = 19,
    MdtBclMIMIC = 20,
    MdtBclGROUNDWHEEL = 21, /**< of MstVehicle, which makes them */
} MdtBclJointType;

#define MdtBclNO_BODY MdtKeaWORLD /**< The world, in place of a body's index. */

/** One stop of a limit (Dynamics guide ch. 3, "The Single Joint Limit"). Units: m and N; of an angle rad and N m. */
typedef struct MdtBclSingleLimit {
    MeReal damping;     /**< N s/m, >= 0; used when stiffness is at most the limit's threshold. Default 0. */
    MeReal restitution; /**< 0..1, rebound speed over impact speed at a hard stop. Default 1. */
    MeReal stiffness;   /**< N/m, >= 0; MEINFINITY (the default) makes the stop hard. */
    MeReal stop;        /**< m, the coordinate of the stop. Default 0. */
} MdtBclSingleLimit;

/** A position motor: a damped spring to a target, which accelerates what it moves as an oscillator of this frequency
 *  and damping, whatever its mass; the force is bounded. */
typedef struct MdtBclServo {
    MeReal frequency;    /**< Hz, undamped; 0: off */
    MeReal dampingRatio; /**< 1: critically damped */
    MeReal force;        /**< N, or N m: the largest in either direction; MEINFINITY: unbounded */
} MdtBclServo;

/** The limits and the motor of one degree of freedom of a joint (Dynamics guide ch. 3, "Joint Limit"). */
typedef struct MdtBclLimit {
    MdtBclSingleLimit limit[2]; /**< lower and upper stop */
    MeReal position;            /**< m, the coordinate at the last step's end, offset included */
    MeReal velocity;            /**< m/s, its rate */
    MeReal offset;              /**< m, added to the measured coordinate */
    MeReal stiffnessThreshold;  /**< N/m; above it a stop is hard, at or below it a damped spring */
    MeReal desired_vel;         /**< m/s, target velocity of the motor */
    MeReal fmax;                /**< N, largest force of the motor in either direction */
    MeReal target;              /**< m, of a position motor, now: in a step it moves with desired_vel */
    MeReal frequency;           /**< Hz, undamped, of a position motor; 0: a velocity motor */
    MeReal dampingRatio;        /**< of a position motor; 1: critically damped */
    MeReal lock;                /**< m, the value at which the lock keeps the coordinate */
    MeReal lockForce;           /**< N, largest force of the lock in either direction */
    MeBool bLocked;             /**< the lock is on, which turns the motor off */
    MeBool bPowered;            /**< the motor is on */
    MeBool bMotorTracks;        /**< the motor drives the displacement of a step, desired_vel times its length, instead
                                     of the velocity at its end */
    MeBool bActive;             /**< the stops are on */
    MeBool bCalculatePosition;  /**< the coordinate is measured even with lock, motor and stops off */
    /* Set by the library, and kept from step to step. */
    double measured;     /**< m, the coordinate without offset; an angle counts full turns */
    MeBool isMeasured;   /**< `measured` is valid: full turns are counted from it */
    int rows;            /**< which rows are in this step's system: 1 motor, 2 lower stop, 4 upper stop, 8 lock */
    double stopForce[2]; /**< N, of the stops in the last step, >= 0 */
    int watched[2];      /**< sub-steps for which a stop that was passed without a row has one in any case */
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
    MdtFrictionModelCone = 2,        /**< Coulomb's cone: both directions together, with the primary coefficient */
} MdtFrictionModel;

/** Flags of the contact parameters that are in use. The functions of MdtContactParams.h set them. */
typedef enum MdtBclContactOption {
    MdtBclContactOptionUseDirection = 1,       /**< the program has set the primary direction */
    MdtBclContactOptionBounce = 2,             /**< restitution */
    MdtBclContactOptionSoft = 4,               /**< softness */
    MdtBclContactOptionAdhesive = 8,           /**< max_adhesive_force */
    MdtBclContactOptionSlip1 = 16,             /**< slip1 */
    MdtBclContactOptionSlip2 = 32,             /**< slip2 */
    MdtBclContactOptionSlide1 = 64,            /**< slide1 */
    MdtBclContactOptionSlide2 = 128,           /**< slide2 */
    MdtBclContactOptionTypeSet = 512,          /**< the program has set the type */
    MdtBclContactOptionBoundSet = 1024,        /**< the program has set friction1 or friction2 */
    MdtBclContactOptionUseWorldVelocity = 256, /**< the program has set the world's velocity at the contact */
} MdtBclContactOption;

/** The properties of a contact (Dynamics guide ch. 3, "The MdtBclContactParams Structure"). */
typedef struct MdtBclContactParams {
    MdtContactType type;
    MdtFrictionModel model1; /**< along the primary direction */
    MdtFrictionModel model2; /**< along the secondary direction */
    int options;             /**< set of MdtBclContactOption */
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
    MeReal max_adhesive_force; /**< N, largest force with which the contact may pull */
    MeReal friction1;          /**< N, bound of the box model, primary direction; MEINFINITY: none */
    MeReal friction2;          /**< N, the same along the secondary direction */
    MeReal slip1;              /**< m/s per N along the primary direction */
    MeReal slip2;              /**< m/s per N along the secondary direction */
    MeReal slide1;             /**< m/s, surface velocity along the primary direction */
    MeReal slide2;             /**< m/s, the same along the secondary direction */
    MeReal rollingFriction;    /**< m, >= 0: the largest torque against rolling over the normal force. Beyond Karma */
    MeReal spinningFriction;   /**< m, >= 0: the same against spinning about the normal. Beyond Karma */
} MdtBclContactParams;

/** The list of rows that a program's function adds to a user constraint (MdtBcl.h). */
typedef struct MdtKeaConstraints MdtKeaConstraints;

/**
 * Writes the rows of a user constraint for one step, with MdtBclAddRow. @a constraint is what
 * MdtUserConstraintSetFunction was given; @a tlist and @a blist are the poses and Kea's bodies of the constraint's body
 * 0 and body 1 (the world: the identity and null); @a params is the step's MdtBclSolverParameters. What else the
 * function may do is in docs/simulation.md, "Callbacks".
 */
typedef void(MEAPI *MdtBclAddConstraintFn)(MdtKeaConstraints *const keaConstraints, void *const constraint,
                                           const MdtKeaTransformation *const tlist, MdtKeaBody *const blist[],
                                           const void *const params);

/** The parameters of a step, or sub-step, that rows depend on. */
typedef struct MdtBclSolverParameters {
    double stepsize;    /**< s */
    double epsilon;     /**< 1/kg, the world's, converted to this length of sub-step */
    double gamma;       /**< fraction of an error that a step removes, converted to this length of sub-step */
    double softening;   /**< factor of that conversion of epsilon, which other compliances of its kind get, too */
    MeBool hasContacts; /**< the partition has contacts */
} MdtBclSolverParameters;

ME_END_C

#endif
