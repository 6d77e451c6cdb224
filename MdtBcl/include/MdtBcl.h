/** @file MdtBcl.h
 *  The basic constraint library: joints, limits and contacts as rows for Kea (User Guide ch. 2, "BCL").
 *
 *  Each kind of constraint is one file with its equation, and one entry of a table: how many rows it has now, what
 *  they are, and what to note after the step. Bcl knows poses and velocities, not bodies or worlds, and allocates
 *  nothing. Mdt calls, for every constraint of a partition, `prepare` (which counts), then `fill`, then, with the
 *  poses of the step's end, `readBack`; and `errors` for poses in between, while Kea looks for the forces.
 */
#ifndef MDTBCL_H
#define MDTBCL_H

#include "MdtBclTypes.h"

ME_BEGIN_C

#define MdtBclGETMAXROWSBSJOINT 3
#define MdtBclGETMAXROWSHINGE   8 /**< 5, one for the motor, one for each stop; 5 while it turns freely. */
#define MdtBclGETMAXROWSCONTACT 3
#define MdtBclGETMAXROWS        8 /**< of any constraint */

/** Where a constraint is attached to a body: in the frame of its centre of mass, or in the world's. */
typedef struct MdtBclFrame {
    double position[3]; /**< m */
    double primary[3];  /**< unit */
    double ortho[3];    /**< unit, at right angles to primary */
} MdtBclFrame;

/** A contact's geometry and parameters. World frame. */
typedef struct MdtBclContact {
    double position[3];  /**< m */
    double normal[3];    /**< unit, the way the first body is pushed */
    double direction[3]; /**< unit, primary direction, at right angles to the normal */
    double penetration;  /**< m, positive: overlap; negative: gap */
    MdtBclContactParams params;
    /* Kept by the library. */
    double anchor[2][3]; /**< m, the surface points of the two bodies, in the frames of their centres of mass */
    double point[3];     /**< m, position, and */
    double depth;        /**< m, penetration: as set, then carried along with the bodies through a divided step */
    double normalForce;  /**< N, of the last step */
    int rows;            /**< friction rows of this step's system: 1 primary, 2 secondary */
} MdtBclContact;

/** What Bcl keeps of a constraint. */
typedef struct MdtBclConstraint {
    MdtBclJointType type;
    MdtBclFrame frame[2]; /**< by body */
    union {
        MdtBclLimit limit;     /**< hinge */
        MdtBclContact contact; /**< contact */
    } of;
} MdtBclConstraint;

/** A constraint's surroundings in one step. The world is a body at the origin that has no inverse mass; where the
 *  constraint was given a velocity of the world, that is its velocity. */
typedef struct MdtBclContext {
    MdtBclSolverParameters parameters;
    MeBool isContinued;                        /**< a later part of a step that was divided */
    MdtKeaBodyIndexPair body;                  /**< indices in Kea's system, or MdtBclNO_BODY */
    int firstRow;                              /**< index of the constraint's first row */
    const MdtKeaTransformation *pose[2];       /**< now */
    const MdtKeaVelocity *velocity[2];         /**< now */
    const MdtKeaVelocity *predicted[2];        /**< at the end of the step, were there no constraints */
    const MdtKeaVelocity *acceleration[2];     /**< in the last step, 1/s of a velocity's units */
    const MdtKeaInverseMassMatrix *invMass[2]; /**< now */
} MdtBclContext;

/** What a kind of constraint can do. */
typedef struct MdtBclType {
    const char *name;
    int maxRows;
    /** Sets every property to its default. */
    void (*reset)(MdtBclConstraint *c);
    /** Measures the joint, decides which rows are needed in this step, and returns how many. */
    int (*prepare)(MdtBclConstraint *c, const MdtBclContext *x);
    /** Writes exactly as many rows as prepare counted. */
    void (*fill)(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]);
    /** The errors of the position rows were the bodies at these poses. Null where there are none. */
    void (*errors)(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double errors[]);
    /** Notes what programs may ask for after the step; x holds the poses and velocities of its end. May be null. */
    void (*readBack)(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]);
} MdtBclType;

/** The table's entry, or null for a type that this library does not have. */
MEPUBLIC const MdtBclType *MEAPI MdtBclTypeOf(MdtBclJointType type);

/** The pose, velocity and inverse mass of the world. */
extern MEPUBLIC const MdtKeaTransformation MdtBclWorldPose;
extern MEPUBLIC const MdtKeaVelocity MdtBclWorldVelocity;
extern MEPUBLIC const MdtKeaInverseMassMatrix MdtBclWorldInvMass;

/** Sets a stop to its defaults: stop 0, restitution 1, stiffness MEINFINITY, damping 0. */
MEPUBLIC void MEAPI MdtBclSingleLimitReset(MdtBclSingleLimit *stop);
/** Sets a limit to its defaults: two default stops, inactive, not powered, nothing measured. */
MEPUBLIC void MEAPI MdtBclLimitReset(MdtBclLimit *limit);
/** Sets contact parameters to their defaults (Dynamics guide ch. 3, the table after MdtContactParamsReset). */
MEPUBLIC void MEAPI MdtBclContactParamsReset(MdtBclContactParams *params);

ME_END_C

#endif
