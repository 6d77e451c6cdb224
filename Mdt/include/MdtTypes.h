/** @file MdtTypes.h
 *  The types of Karma Dynamics: handles, parameters, callbacks.
 *
 *  A handle is a pointer to something that a world owns. It stays valid until the thing is destroyed, alone or with
 *  its world. Functions that are given a null handle, or one that has been destroyed, warn and return a neutral
 *  result (0, null or zeros); the check build (KARMA_CHECK) also notices handles of destroyed worlds and pointers that
 *  never were handles.
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
typedef MdtContact *MdtContactID;
typedef MdtContactGroup *MdtContactGroupID;
typedef MdtBclLimit *MdtLimitID;
typedef MdtBclSingleLimit *MdtSingleLimitID;
typedef MdtBclContactParams *MdtContactParamsID;

/** What holds for the whole world. */
typedef struct MdtWorldParams {
    MeVector4 gravity;  /**< m/s², the fourth is 0 */
    MeReal lengthScale; /**< m, the size of a typical object */
    MeReal massScale;   /**< kg, the mass of a typical object */
} MdtWorldParams;

/** When a partition is put to rest. All values that are compared are squares of magnitudes (Dynamics guide ch. 4). */
typedef struct MdtPartitionParams {
    MeBool autoDisable;   /**< whether it happens at all */
    MeReal vel_thresh;    /**< m²/s² */
    MeReal velrot_thresh; /**< rad²/s² */
    MeReal acc_thresh;    /**< m²/s⁴ */
    MeReal accrot_thresh; /**< rad²/s⁴ */
    MeReal alive_time;    /**< s that a body stays enabled after it was enabled; not used when alive_window is set */
    int alive_window;     /**< the same in steps; -1: alive_time counts */
} MdtPartitionParams;

/** What of a step is drawn (MdtWorldSetDebugDrawing); a sum. */
typedef enum MdtDebugDrawOptions {
    MdtDebugDrawContacts = 1,    /**< A yellow line of .3 m along the normal of each contact. */
    MdtDebugDrawContactForce = 2 /**< A red line along each contact's force: .1 m for 1 m/s² of its first body's. */
} MdtDebugDrawOptions;

/** The partitions of a step (MdtPartition.h). */
typedef struct MdtPartitionOutput MdtPartitionOutput;

/** @name Functions of the program: what each may do has docs/simulation.md, "Callbacks"
 *  @{ */
/** Shown the last partition of @a po. */
typedef void(MEAPI *MdtPartitionEndCB)(MdtPartitionOutput *po, void *pcbdata);

/** How much a contact matters, for the cap on the matrix size: the least important ones lose their rows first. It must
 *  depend on nothing but the contact, and change nothing. */
typedef MeReal(MEAPI *MdtContactImportanceCBPtr)(const MdtContactID c);

/** Called when a body has been enabled, or disabled: by the program, or by the world. What it destroys, enables or
 *  disables waits until all handlers have been called. */
typedef void(MEAPI *MdtBodyHandler)(const MdtBodyID b);
/** Called for each constraint; @a ccbdata is what the caller passed. What it destroys goes after the last call. */
typedef void(MEAPI *MdtConstraintIteratorCBPtr)(const MdtConstraintID c, void *ccbdata);

/** Called for a joint that broke in the step just done; it may be destroyed, as may anything else. */
typedef void(MEAPI *MdtBreakCBPtr)(const MdtConstraintID c);
/** @} */

ME_END_C

#endif
