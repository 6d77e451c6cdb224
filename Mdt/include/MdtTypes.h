/** @file MdtTypes.h
 *  The types of Karma Dynamics: handles, parameters, callbacks.
 *
 *  A handle is a pointer to an object that a world owns. It is valid until the object is destroyed, alone or with its
 *  world. Functions that get a null handle, or one of a destroyed object, warn and return a neutral result (0, null or
 *  zeros). The check build (KARMA_CHECK) also detects handles of destroyed worlds, and pointers that never were
 *  handles.
 */
#ifndef MDTTYPES_H
#define MDTTYPES_H

#include "MdtBcl.h"
#include "MePrecision.h"

ME_BEGIN_C

typedef struct MdtWorld MdtWorld;
typedef struct MdtBody MdtBody;
typedef struct MdtBaseConstraint MdtBaseConstraint;
typedef struct MdtBSJoint MdtBSJoint;
typedef struct MdtHinge MdtHinge;
typedef struct MdtPrismatic MdtPrismatic;
typedef struct MdtUniversal MdtUniversal;
typedef struct MdtAngular3 MdtAngular3;
typedef struct MdtCarWheel MdtCarWheel;
typedef struct MdtLinear1 MdtLinear1;
typedef struct MdtLinear2 MdtLinear2;
typedef struct MdtFixedPath MdtFixedPath;
typedef struct MdtFPFOJoint MdtFPFOJoint;
typedef struct MdtRPROJoint MdtRPROJoint;
typedef struct MdtSpring MdtSpring;
typedef struct MdtSpring6 MdtSpring6;
typedef struct MdtConeLimit MdtConeLimit;
typedef struct MdtSkeletal MdtSkeletal;
typedef struct MdtUserConstraint MdtUserConstraint;
typedef struct MdtGear MdtGear;
typedef struct MdtPulley MdtPulley;
typedef struct MdtMimic MdtMimic;
typedef struct MdtContact MdtContact;
typedef struct MdtContactGroup MdtContactGroup;

typedef MdtWorld *MdtWorldID;
typedef MdtBody *MdtBodyID;
typedef MdtBaseConstraint *MdtConstraintID;
typedef MdtBSJoint *MdtBSJointID;
typedef MdtHinge *MdtHingeID;
typedef MdtPrismatic *MdtPrismaticID;
typedef MdtUniversal *MdtUniversalID;
typedef MdtAngular3 *MdtAngular3ID;
typedef MdtCarWheel *MdtCarWheelID;
typedef MdtLinear1 *MdtLinear1ID;
typedef MdtLinear2 *MdtLinear2ID;
typedef MdtFixedPath *MdtFixedPathID;
typedef MdtFPFOJoint *MdtFPFOJointID;
typedef MdtRPROJoint *MdtRPROJointID;
typedef MdtSpring *MdtSpringID;
typedef MdtSpring6 *MdtSpring6ID;
typedef MdtConeLimit *MdtConeLimitID;
typedef MdtSkeletal *MdtSkeletalID;
typedef MdtUserConstraint *MdtUserConstraintID;
typedef MdtGear *MdtGearID;
typedef MdtPulley *MdtPulleyID;
typedef MdtMimic *MdtMimicID;
typedef MdtContact *MdtContactID;
typedef MdtContactGroup *MdtContactGroupID;
typedef MdtBclLimit *MdtLimitID;
typedef MdtBclSingleLimit *MdtSingleLimitID;
typedef MdtBclContactParams *MdtContactParamsID;

/** Parameters of the whole world. */
typedef struct MdtWorldParams {
    MeVector4 gravity;  /**< m/s²; the fourth component is 0 */
    MeReal lengthScale; /**< m, the size of a typical object */
    MeReal massScale;   /**< kg, the mass of a typical object */
} MdtWorldParams;

/** The conditions for putting a partition to sleep. Values are compared with squares of magnitudes (Dynamics guide ch.
 *  4). */
typedef struct MdtPartitionParams {
    MeBool autoDisable;   /**< whether partitions are put to sleep at all */
    MeReal vel_thresh;    /**< m²/s² */
    MeReal velrot_thresh; /**< rad²/s² */
    MeReal acc_thresh;    /**< m²/s⁴ */
    MeReal accrot_thresh; /**< rad²/s⁴ */
    MeReal alive_time;    /**< s for which a body stays enabled after it was enabled, unless alive_window is set */
    int alive_window;     /**< the same in steps; -1: alive_time is used */
} MdtPartitionParams;

/** What is drawn of a step (MdtWorldSetDebugDrawing): a sum of these. */
typedef enum MdtDebugDrawOptions {
    MdtDebugDrawContacts = 1,    /**< A yellow line of .3 m along the normal of each contact. */
    MdtDebugDrawContactForce = 2 /**< A red line along each contact's force: .1 m for 1 m/s² of the first body. */
} MdtDebugDrawOptions;

/** The partitions of a step, for callbacks (MdtPartition.h). */
typedef struct MdtPartitionOutput MdtPartitionOutput;

/** @name Callbacks of the program; docs/simulation.md, "Callbacks", lists what each may do
 *  @{ */
/** Called for each partition, which is the last one of @a po (MdtWorldSetPartitionCB). */
typedef void(MEAPI *MdtPartitionEndCB)(MdtPartitionOutput *po, void *pcbdata);

/** Returns how important a contact is. When the cap on the matrix size is exceeded, the least important contacts lose
 *  their rows first. The result must depend on the contact only, and the callback must not change anything. */
typedef MeReal(MEAPI *MdtContactImportanceCBPtr)(const MdtContactID c);

/** Called when a body has been enabled, or disabled, by the program or by the world. Objects that it destroys, enables
 *  or disables are processed after all handlers have been called. */
typedef void(MEAPI *MdtBodyHandler)(const MdtBodyID b);
/** Called for each constraint with the @a ccbdata that the program passed. Objects that it destroys are destroyed after
 *  the last call. */
typedef void(MEAPI *MdtConstraintIteratorCBPtr)(const MdtConstraintID c, void *ccbdata);

/** Called for a joint that broke in the last step; it may destroy that joint and other objects. */
typedef void(MEAPI *MdtBreakCBPtr)(const MdtConstraintID c);
/** @} */

ME_END_C

#endif
