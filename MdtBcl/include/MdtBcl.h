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

/** @name The most rows that a constraint of each kind has
 *  @{ */
#define MdtBclGETMAXROWSBSJOINT   3
#define MdtBclGETMAXROWSHINGE     8 /**< 5, one for the motor or the lock, one for each stop. */
#define MdtBclGETMAXROWSPRISMATIC 8 /**< The same. */
#define MdtBclGETMAXROWSCARWHEEL  8 /**< 3, steering, spring, two stops, the hinge motor. */
#define MdtBclGETMAXROWSCONTACT   3
#define MdtBclGETMAXROWSFIXEDPATH 3
#define MdtBclGETMAXROWSRPROJOINT 6
#define MdtBclGETMAXROWSUNIVERSAL 4
#define MdtBclGETMAXROWSSKELETAL  7 /**< 3, two for the swing, two for the twist. */
#define MdtBclGETMAXROWSLINEAR1   1
#define MdtBclGETMAXROWSLINEAR2   2
#define MdtBclGETMAXROWSANGULAR3  3
#define MdtBclGETMAXROWSSPRING6   6
#define MdtBclGETMAXROWSSPRING    3 /**< 1; a motor and two stops where it is neither a rod nor a spring. */
#define MdtBclGETMAXROWSCONELIMIT 1
#define MdtBclGETMAXROWSFPFOJOINT 6
#define MdtBclGETMAXROWSUSER      12
#define MdtBclGETMAXROWS          12 /**< of any constraint */
/** @} */

/** Where a constraint is attached to a body: in the frame of its centre of mass, or in the world's. */
typedef struct MdtBclFrame {
    double position[3]; /**< m */
    double primary[3];  /**< unit */
    double ortho[3];    /**< unit, at right angles to primary */
} MdtBclFrame;

/** Angular3: MEINFINITY in either holds the orientation rigidly. */
typedef struct MdtBclAngular {
    MeReal stiffness; /**< N m/rad */
    MeReal damping;   /**< N m s/rad */
    MeBool rotates;   /**< about the primary axis: Angular2 */
} MdtBclAngular;

/** FixedPath. */
typedef struct MdtBclPath {
    double velocity[2][3]; /**< m/s, of the attachments in their bodies' frames */
    /* Kept by the library. */
    double place[2][3]; /**< m, the attachments at the start of the step */
    double start[3];    /**< m/s, how fast the two move apart as the part of the step begins */
    double stepsize;    /**< s */
} MdtBclPath;

/** RPRO. */
typedef struct MdtBclRelative {
    double quaternion[4];         /**< w x y z, of frame 0 in frame 1 */
    double velocity[3];           /**< rad/s, of that, in the axes of frame 1 */
    MeReal linear[3], angular[3]; /**< N, N m, strengths, in the axes of frame 1 and of the wanted frame */
    /* Kept by the library: the target quaternion at the start and the end of the part of the step, and the rotation
     * between. */
    double now[4], then[4], rotation[3];
} MdtBclRelative;

/** What a distance is: see bcl_spring.c. */
typedef enum MdtBclDistanceKind {
    MdtBclDistanceLimits = 0,
    MdtBclDistanceRod = 1,
    MdtBclDistanceSpring = 2,
} MdtBclDistanceKind;

#define MDTBCL_SPRING_STIFFNESS 10 /**< N/m, of a new MdtSpring */
#define MDTBCL_SPRING_DAMPING   1  /**< N s/m, of a new MdtSpring */

/** Spring. */
typedef struct MdtBclDistance {
    MdtBclLimit limit;
    MeBool lengthIsSet; /**< by the program; else both stops are where the bodies were attached */
    /* Kept by the library. */
    double direction[3]; /**< unit, from the second attachment to the first */
    double length;       /**< m */
    MdtBclDistanceKind kind;
} MdtBclDistance;

/** Spring6: three linear springs, then three angular ones. */
typedef struct MdtBclSprings {
    MeReal stiffness[6]; /**< N/m, N m/rad; MEINFINITY holds */
    MeReal damping[6];   /**< N s/m, N m s/rad */
} MdtBclSprings;

/** ConeLimit: the upper stop of the limit is the half angle. */
typedef struct MdtBclCone {
    MdtBclLimit limit;
    MeReal stiffness, damping; /**< N m/rad, N m s/rad; MEINFINITY in either is hard */
    double normal[3];          /**< kept by the library: unit, about which the angle grows */
} MdtBclCone;

/** A velocity motor. */
typedef struct MdtBclMotor {
    MeReal velocity; /**< rad/s */
    MeReal force;    /**< N m, its bound, either way */
} MdtBclMotor;

/** CarWheel. */
typedef struct MdtBclCarWheel {
    MdtBclMotor steering, rolling;
    MeBool isLocked;             /**< the steering */
    MeReal kp, kd;               /**< N/m, N s/m, of the suspension */
    MeReal softness;             /**< 1/kg, of its stops */
    MeReal low, high, reference; /**< m, heights of the wheel along the steering axis */
    /* Read back. */
    double height, heightRate;          /**< m, m/s */
    double steeringAngle, steeringRate; /**< rad, rad/s */
    double hingeAngle, hingeRate;       /**< rad, rad/s */
    /* Kept by the library. */
    int rows;
    double startAngle;   /**< rad, of the wheel about the steering axis, as the step begins */
    double stopForce[2]; /**< N */
} MdtBclCarWheel;

/** How the swing of a Skeletal is limited. */
typedef enum MdtSkeletalConeOption {
    MdtSkeletalConeOptionFree = 0,
    MdtSkeletalConeOptionSlot = 1, /**< in the primary plane only, up to the primary angle */
    MdtSkeletalConeOptionCone = 2,
    MdtSkeletalConeOptionFixed = 3,
} MdtSkeletalConeOption;

/** How its twist is limited. */
typedef enum MdtSkeletalTwistOption {
    MdtSkeletalTwistOptionFree = 0,
    MdtSkeletalTwistOptionLimited = 1,
    MdtSkeletalTwistOptionFixed = 2,
} MdtSkeletalTwistOption;

/** Skeletal. Stiffness and damping: MEINFINITY in either is hard. */
typedef struct MdtBclSkeletal {
    MeReal primary, secondary, twist; /**< rad */
    MeReal coneStiffness, coneDamping, twistStiffness, twistDamping;
    MdtSkeletalConeOption coneOption;
    MdtSkeletalTwistOption twistOption;
    /* Kept by the library. */
    MdtBclLimit cone, turn;
    double scale; /**< 1/rad, of the cone's coordinate as the step begins */
} MdtBclSkeletal;

struct MdtBclContext;

/** The rows of a constraint that a program writes: see MdtBclAddRow. */
struct MdtKeaConstraints {
    MdtKeaRow *rows;
    int numRows, maxRows;
    const struct MdtBclContext *context;
};

/** UserConstraint. */
typedef struct MdtBclUser {
    MdtBclAddConstraintFn function; /**< null: no rows */
    void *owner;                    /**< what the function is given as the constraint */
    MdtKeaRow *rows;                /**< room for MdtBclGETMAXROWSUSER */
    int numRows;
} MdtBclUser;

/** What Bcl keeps of a constraint. */
typedef struct MdtBclConstraint {
    MdtBclJointType type;
    MdtBclFrame frame[2]; /**< by body */
    MeBool isDegenerate;  /**< it stands where its rows lose their meaning (MdtBclType) */
    union {
        MdtBclLimit limit; /**< hinge, prismatic */
        MdtBclAngular angular;
        MdtBclPath path;
        MdtBclRelative relative;
        MdtBclDistance distance;
        MdtBclSprings springs;
        MdtBclCone cone;
        MdtBclCarWheel wheel;
        MdtBclSkeletal skeletal;
        MdtBclUser user;
    } of;
} MdtBclConstraint;

/** A constraint's surroundings in one step. The world is a body at the origin that has no inverse mass; where the
 *  constraint was given a velocity of the world, that is its velocity. */
typedef struct MdtBclContext {
    MdtBclSolverParameters parameters;
    double elapsed;                            /**< s, of the step before this part of it; 0 if it is not divided */
    MdtKeaBodyIndexPair body;                  /**< indices in Kea's system, or MdtBclNO_BODY */
    int firstRow;                              /**< index of the constraint's first row */
    MdtKeaBody *kea[2];                        /**< null: the world */
    const MdtKeaTransformation *pose[2];       /**< now */
    const MdtKeaVelocity *velocity[2];         /**< now */
    const MdtKeaVelocity *predicted[2];        /**< at the end of the step, were there no constraints */
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
    /** Told when bodies were attached, when an attachment was moved, when the axes of both sides were set, with the
     *  poses that the bodies have then. Any may be null. */
    void (*attached)(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]);
    void (*positioned)(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]);
    void (*axesSet)(MdtBclConstraint *c, const MdtBclFrame before[2], const MdtKeaTransformation *const pose[2]);
    /** What is wrong where `prepare` finds the constraint degenerate, for the warning. */
    const char *degenerate;
} MdtBclType;

/** What the parameters of contacts say to Kea, which takes contacts as manifolds. */
MEPUBLIC void MEAPI MdtBclContactSurface(const MdtBclContactParams *params, MdtKeaSurface *surface);

/** The table's entry, or null for a type that this library does not have. Contacts and contact groups have a name, and
 *  no functions. */
MEPUBLIC const MdtBclType *MEAPI MdtBclTypeOf(MdtBclJointType type);

/**
 * The next row of a constraint that a program writes, to be called by its MdtBclAddConstraintFn. The row joins the
 * constraint's two bodies, has the world's epsilon, no bounds, and zeros: the program fills in J (body 0 and body 1,
 * rows of the world frame), target, and where it likes bounds, softness, or spring. Null, with a warning, when there is
 * no room.
 */
MEPUBLIC MdtKeaRow *MEAPI MdtBclAddRow(MdtKeaConstraints *list);

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

/** Makes the twist that a Skeletal has at these poses its zero. */
MEPUBLIC void MEAPI MdtBclSkeletalZeroTwist(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]);

ME_END_C

#endif
