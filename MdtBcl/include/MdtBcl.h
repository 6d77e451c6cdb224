/** @file MdtBcl.h
 *  The basic constraint library: joints, limits and contacts as rows for Kea.
 *
 *  Each constraint type has a file, with its equation, and an entry in a table of functions (MdtBclType). Bcl reads
 *  poses and velocities, does not know of bodies or worlds, and allocates no memory. In each step Mdt calls for every
 *  constraint of a partition `prepare` (counts its rows), `fill` (writes them) and, with the poses at the end of the
 *  step, `readBack` (stores what programs may query). In between, Kea's iterations call `errors` with trial poses.
 */
#ifndef MDTBCL_H
#define MDTBCL_H

#include "MdtBclTypes.h"

ME_BEGIN_C

/** @name Maximal number of rows of each constraint type
 *  @{ */
#define MdtBclGETMAXROWSBSJOINT     3 /**< Without the 3 of a position motor. */
#define MdtBclGETMAXROWSHINGE       8 /**< 5 of the joint, 1 for motor or lock, 1 for each stop. */
#define MdtBclGETMAXROWSPRISMATIC   8 /**< As of a hinge. */
#define MdtBclGETMAXROWSCARWHEEL    8 /**< 3 of the joint; 1 each for steering, spring, hinge motor; 2 stops. */
#define MdtBclGETMAXROWSCONTACT     3
#define MdtBclGETMAXROWSFIXEDPATH   3
#define MdtBclGETMAXROWSRPROJOINT   6
#define MdtBclGETMAXROWSUNIVERSAL   4
#define MdtBclGETMAXROWSSKELETAL    7 /**< 3 of the joint, 2 for swing, 2 for twist; without those of a motor. */
#define MdtBclGETMAXROWSLINEAR1     1
#define MdtBclGETMAXROWSLINEAR2     2
#define MdtBclGETMAXROWSANGULAR3    3
#define MdtBclGETMAXROWSSPRING6     6
#define MdtBclGETMAXROWSSPRING      3 /**< A motor, and two stops or the row of a spring; 1 of a rod. */
#define MdtBclGETMAXROWSCONELIMIT   1
#define MdtBclGETMAXROWSFPFOJOINT   6
#define MdtBclGETMAXROWSGEAR        1
#define MdtBclGETMAXROWSPULLEY      1
#define MdtBclGETMAXROWSMIMIC       6 /**< 1, or a split row of 2 and the room that it takes (MdtKea.h). */
#define MdtBclGETMAXROWSGROUNDWHEEL 6 /**< Suspension, its stop, tyre along and across, anti-roll bar, lean. */
#define MdtBclGETMAXROWSUSER        12
#define MdtBclGETMAXROWS            12 /**< of any constraint */
/** @} */

/** Attachment frame of a constraint, in the frame of a body (origin at its centre of mass), or of the world. */
typedef struct MdtBclFrame {
    double position[3]; /**< m */
    double primary[3];  /**< unit */
    double ortho[3];    /**< unit, at right angles to primary */
} MdtBclFrame;

/** Angular3. MEINFINITY in stiffness or damping: the orientation is rigid. */
typedef struct MdtBclAngular {
    MeReal stiffness; /**< N m/rad */
    MeReal damping;   /**< N m s/rad */
    MeBool rotates;   /**< the bodies may rotate about the primary axis (Angular2) */
} MdtBclAngular;

/** A relative orientation that changes. */
typedef struct MdtBclTargetTurn {
    double quaternion[4]; /**< w x y z, unit, of frame 0 relative to frame 1, now */
    double velocity[3];   /**< rad/s, its angular velocity, in the axes of frame 1 */
} MdtBclTargetTurn;

/** A position motor of a relative orientation: BSJoint, Skeletal. */
typedef struct MdtBclTurnServo {
    MdtBclServo motor;
    MdtBclTargetTurn target;
    /* Set by the library. */
    double now[4];     /**< the target at the start of the sub-step */
    double axis[3][3]; /**< unit, principal axes of the effective inertia, in the axes of the target */
    double inertia[3]; /**< kg m², about them; 0: nothing can turn */
} MdtBclTurnServo;

/** FixedPath. */
typedef struct MdtBclPath {
    double velocity[2][3]; /**< m/s, of the attachment points relative to their bodies, in body frames */
    /* Set by the library. */
    double place[2][3]; /**< m, body frames, the attachment points at the start of the step */
    double start[3];    /**< m/s, world: difference of both velocities at the start of the sub-step */
    double stepsize;    /**< s, of the sub-step */
} MdtBclPath;

/** RPRO. */
typedef struct MdtBclRelative {
    double quaternion[4];         /**< w x y z, target orientation of frame 0 relative to frame 1 */
    double velocity[3];           /**< rad/s, angular velocity of this target, in the axes of frame 1 */
    MeReal linear[3], angular[3]; /**< N, N m, strengths along the axes of frame 1, about those of the target */
    /* Set by the library: the target quaternion at the start and at the end of the sub-step, and the change of the
     * angular rows' errors by the rotation of the target in between. */
    double now[4], then[4], rotation[3];
} MdtBclRelative;

/** How a Spring constrains the distance (bcl_spring.c). */
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
    MeBool lengthIsSet; /**< the program has set the rest length; else it is the distance at attachment */
    /* Set by the library. */
    double direction[3]; /**< unit, from the second attachment to the first */
    double length;       /**< m */
    MdtBclDistanceKind kind;
} MdtBclDistance;

/** Spring6: three linear springs, then three angular ones. */
typedef struct MdtBclSprings {
    MeReal stiffness[6];     /**< N/m, N m/rad; MEINFINITY: rigid */
    MeReal damping[6];       /**< N s/m, N m s/rad */
    MdtBclServo motor[6];    /**< which replace springs whose motor has a frequency */
    double position[3];      /**< m, target of the attachment of frame 0, along the axes of frame 1, now */
    double velocity[3];      /**< m/s, of this target */
    MdtBclTargetTurn target; /**< of the angular springs and motors */
    /* Set by the library: the target's position at the start of the sub-step, its orientation there and at the end, the
     * rates of the angular rows that follow from its velocity, and their change in rigid directions. */
    double place[3], now[4], then[4], rate[3], rotation[3];
} MdtBclSprings;

/** ConeLimit: the upper stop of the limit is the half angle. */
typedef struct MdtBclCone {
    MdtBclLimit limit;
    MeReal stiffness, damping; /**< N m/rad, N m s/rad; MEINFINITY in either: a hard stop */
    double normal[3];          /**< set by the library: unit, world, axis of the rotation that increases the angle */
} MdtBclCone;

/** A velocity motor. */
typedef struct MdtBclMotor {
    MeReal velocity; /**< rad/s */
    MeReal force;    /**< N m, its largest torque in either direction */
} MdtBclMotor;

/** CarWheel. */
typedef struct MdtBclCarWheel {
    MdtBclMotor steering, rolling;
    MdtBclServo servo;           /**< position motor of the steering, which replaces `steering` if it has a frequency */
    MeReal target;               /**< rad, of this motor, as steeringAngle */
    MeBool isLocked;             /**< the steering is locked */
    MeReal kp, kd;               /**< N/m, N s/m, of the suspension */
    MeReal softness;             /**< 1/kg, compliance of the suspension's stops */
    MeReal low, high, reference; /**< m, heights of the wheel along the steering axis: stops, unloaded spring */
    /* Written by readBack. */
    double height, heightRate;          /**< m, m/s */
    double steeringAngle, steeringRate; /**< rad, rad/s */
    double hingeAngle, hingeRate;       /**< rad, rad/s */
    /* Set by the library. */
    int rows;            /**< set of this step's rows (flags in bcl_carwheel.c) */
    double startAngle;   /**< rad, of the wheel about the steering axis at the start of the step */
    double stopForce[2]; /**< N, >= 0, of the lower and the upper stop in the last step */
} MdtBclCarWheel;

/** How the swing of a Skeletal is limited. */
typedef enum MdtSkeletalConeOption {
    MdtSkeletalConeOptionFree = 0,
    MdtSkeletalConeOptionSlot = 1, /**< in the primary plane only, up to the primary angle */
    MdtSkeletalConeOptionCone = 2,
    MdtSkeletalConeOptionFixed = 3,
} MdtSkeletalConeOption;

/** How the twist of a Skeletal is limited. */
typedef enum MdtSkeletalTwistOption {
    MdtSkeletalTwistOptionFree = 0,
    MdtSkeletalTwistOptionLimited = 1,
    MdtSkeletalTwistOptionFixed = 2,
} MdtSkeletalTwistOption;

/** Skeletal. MEINFINITY in a stiffness or damping: a hard limit. */
typedef struct MdtBclSkeletal {
    MeReal primary, secondary, twist; /**< rad */
    MeReal coneStiffness, coneDamping, twistStiffness, twistDamping;
    MdtSkeletalConeOption coneOption;
    MdtSkeletalTwistOption twistOption;
    /* Set by the library. */
    MdtBclLimit cone, turn; /**< of swing and twist */
    double scale;           /**< 1/rad, |∇f| of the cone at the start of the step (bcl_skeletal.c) */
    MdtBclTurnServo servo;
} MdtBclSkeletal;

/** What a coordinate measures of its moving frame relative to its base frame (bcl_coupling.c). */
typedef enum MdtBclCoordinateKind {
    MdtBclCoordinateAngle = 0,    /**< rad about the primary axis, full turns counted */
    MdtBclCoordinateSlide = 1,    /**< m along the base's primary axis */
    MdtBclCoordinateDistance = 2, /**< m between the positions */
} MdtBclCoordinateKind;

#define MdtBclNO_SIDE  (-1) /**< The world, in place of a side of the constraint. */
#define MdtBclMAXSIDES 4    /**< Of a mimic, which has those of two joints; of other constraints 2. */

/** A coordinate of a coupling. */
typedef struct MdtBclCoordinate {
    MdtBclCoordinateKind kind;
    int side[2];          /**< in whose body the moving and the base frame are: a side, or MdtBclNO_SIDE */
    MdtBclFrame frame[2]; /**< the moving and the base frame */
    double factor;        /**< of the coordinate in the sum */
    /* Set by the library. */
    double measured;     /**< rad or m, at the start of the sub-step */
    double turned;       /**< rad, by which the angle is expected to change in the sub-step */
    double direction[3]; /**< unit, world, of the distance: the last one that it had */
    MeBool isMeasured;
} MdtBclCoordinate;

/** Gear, Pulley, Mimic: the sum of two coordinates times their factors is constant. */
typedef struct MdtBclCoupling {
    MdtBclCoordinate coordinate[2];
    double constant;    /**< of the sum; rad or m */
    MdtBclLimit slack;  /**< of the sum minus the constant, if isSlack */
    MeBool isSlack;     /**< the sum may be smaller: a rope */
    MeBool lengthIsSet; /**< Pulley: the program has set the constant */
    int housing;        /**< Gear: the side that carries both shafts, or MdtBclNO_SIDE */
    int numSides;       /**< 2; Mimic: up to MdtBclMAXSIDES */
    MeBool isReady;     /**< Mimic: both joints act */
    double offset;      /**< Mimic, rad or m */
    void *joint[2];     /**< Mimic: Mdt's joints, or null */
} MdtBclCoupling;

/** Where a wheel without a body touches: along its suspension, along the normal, in its plane. */
typedef enum MdtBclWheelShape { MdtBclWheelRay = 0, MdtBclWheelSphere = 1, MdtBclWheelDisc = 2 } MdtBclWheelShape;

/** GroundWheel: a wheel that rolls on a plane of the ground (bcl_groundwheel.c). */
typedef struct MdtBclGroundWheel {
    MdtBclWheelShape shape;
    double radius, distance;               /**< m: of the wheel; from its centre to the plane that it touches */
    double mass;                           /**< kg, that it carries */
    MeBool isOnGround;                     /**< else the wheel hangs, without rows */
    MeBool isParked;                       /**< a brake stops a wheel of the vehicle: θ = 1 */
    double stiffness, damping, freeLength; /**< N/m, N s/m, m: length of the unloaded suspension */
    double low;                            /**< m: length at the stop */
    double barStiffness;                   /**< N/m: of an anti-roll bar to a wheel on the same ground; 0: none */
    double barBound[2];                    /**< N, of its force on this wheel's load, <= 0 and >= 0 */
    MdtBclFrame twin[2];                   /**< that wheel's frames, as of the joint */
    double twinDistance, twinFreeLength;   /**< m, likewise */
    MdtBclWheelShape twinShape;
    double inertia, drive, brake; /**< kg m², N m, N m: torque of the engine; the largest one of brakes */
    double slip[2];               /**< m/s per N: of the tyre along and across */
    double bound[2];              /**< N: the largest tyre forces */
    double lean, leanRate, leanStiffness, leanDamping; /**< rad, rad/s, N m/rad, N m s/rad: of a motorcycle: from its
                                                            balance, and of that */
    double spin, angle; /**< rad/s, rad: of the wheel relative to the chassis; rolls forwards if > 0 */
    /* Written by readBack. */
    double length, lengthRate;    /**< m, m/s */
    double load;                  /**< N, along the plane's normal */
    double slope;                 /**< cosine of the suspension's angle to it */
    double springForce, barForce; /**< N, along the suspension; barForce: from this wheel's joint on it, and off the
                                       other one */
    double force[3];              /**< N, of the tyre on the chassis, along and across; [2]: 0 */
    double velocity[3];           /**< m/s, of the chassis at the contact relative to the ground, likewise */
    /* Set by the library. */
    double gain;      /**< m/s, by which velocity[0] has changed in the last step */
    double stopForce; /**< N, of the stop in the last step */
    double direction; /**< -1, 0 or 1: the direction of its spin, which the brake opposes */
    MeBool isLocked;  /**< its brake stops the spin in this step */
    int rows;         /**< set of this step's rows */
} MdtBclGroundWheel;

struct MdtBclContext;

/** The list of rows that a program's function adds to a user constraint (MdtBclAddRow). */
struct MdtKeaConstraints {
    MdtKeaRow *rows;
    int numRows, maxRows;
    const struct MdtBclContext *context;
};

/** UserConstraint. */
typedef struct MdtBclUser {
    MdtBclAddConstraintFn function; /**< null: no rows */
    void *owner;                    /**< passed to the function as `constraint` */
    MdtKeaRow *rows;                /**< capacity MdtBclGETMAXROWSUSER */
    int numRows;
} MdtBclUser;

/** Bcl's data of a constraint. */
typedef struct MdtBclConstraint {
    MdtBclJointType type;
    MdtBclFrame frame[2]; /**< by body */
    MeBool isDegenerate;  /**< its rows are singular at the present poses (MdtBclType.degenerate) */
    union {
        MdtBclLimit limit;     /**< hinge, prismatic */
        MdtBclTurnServo servo; /**< ball and socket */
        MdtBclAngular angular;
        MdtBclPath path;
        MdtBclRelative relative;
        MdtBclDistance distance;
        MdtBclSprings springs;
        MdtBclCone cone;
        MdtBclCarWheel wheel;
        MdtBclSkeletal skeletal;
        MdtBclGroundWheel groundWheel;
        MdtBclUser user;
        MdtBclCoupling coupling;
    } of;
} MdtBclConstraint;

/** The bodies and parameters of a constraint in one step. The world stands for a missing body: it is at the origin, has
 *  inverse mass 0, and the velocity of the world if the constraint was given one. Sides beyond the second one are set
 *  for a mimic that has them. */
typedef struct MdtBclContext {
    MdtBclSolverParameters parameters;
    double elapsed;                                   /**< s, from the start of the step to that of this sub-step */
    MeBool isUpdate;                                  /**< of a row only J, arms, bends and bounds are read */
    int body[MdtBclMAXSIDES];                         /**< indices in Kea's system, or MdtBclNO_BODY */
    int firstRow;                                     /**< index of the constraint's first row */
    MdtKeaBody *kea[2];                               /**< null: the world */
    const MdtKeaTransformation *pose[MdtBclMAXSIDES]; /**< present */
    MdtKeaTransformation moverPose[MdtBclMAXSIDES]; /**< what `pose` points to where a mover is in the world's place */
    const MdtKeaVelocity *velocity[MdtBclMAXSIDES]; /**< present */
    const MdtKeaVelocity *predicted[2];             /**< at the end of the step without constraints */
    const MdtKeaInverseMassMatrix *invMass[2];      /**< present */
} MdtBclContext;

/** The functions of a constraint type. */
typedef struct MdtBclType {
    const char *name;
    int maxRows;
    /** Rows keep the Jacobians and bounds of `fill` through the step: it looks ahead. Else they are those of the mean
     *  of the poses at the start and the end, which is found by passes. */
    MeBool keepsRows;
    /** Sets every property to its default. */
    void (*reset)(MdtBclConstraint *c);
    /** Measures the joint's coordinates and chooses the rows of this step. Returns their number. */
    int (*prepare)(MdtBclConstraint *c, const MdtBclContext *x);
    /** Writes exactly as many rows as prepare counted. */
    void (*fill)(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]);
    /** Writes the errors of the position rows with the bodies at these poses. Null for types without position rows. */
    void (*errors)(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double errors[]);
    /** With the bodies at these poses at the end of a solved sub-step: returns the number of stops without a row that
     *  they pass, which `prepare` gives one from now on. Null for types without limits of angles. */
    int (*passed)(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]);
    /** Stores what programs may query after the step; x has the poses and velocities at its end. May be null. */
    void (*readBack)(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]);
    /** Called after bodies were attached, after an attachment point was moved, and after the axes of both sides were
     *  set, with the bodies' poses at that time. Any may be null. */
    void (*attached)(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]);
    void (*positioned)(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]);
    void (*axesSet)(MdtBclConstraint *c, const MdtBclFrame before[2], const MdtKeaTransformation *const pose[2]);
    /** Text of the warning that is given when `prepare` finds the constraint degenerate. */
    const char *degenerate;
} MdtBclType;

/** Converts contact parameters to the surface of a manifold, Kea's record of contacts. */
MEPUBLIC void MEAPI MdtBclContactSurface(const MdtBclContactParams *params, MdtKeaSurface *surface);

/** The table entry of a constraint type; null for an unknown type. Those of contacts and contact groups have no
 *  functions. */
MEPUBLIC const MdtBclType *MEAPI MdtBclTypeOf(MdtBclJointType type);

/**
 * Appends a row to a user constraint; to be called by its MdtBclAddConstraintFn. The row joins the constraint's two
 * bodies and has the world's epsilon, no bounds, and zeros elsewhere: the program sets J (of body 0 and body 1, in the
 * world frame), target, and optionally bounds, softness, or spring. Null, with a warning, if the list is full or null.
 */
MEPUBLIC MdtKeaRow *MEAPI MdtBclAddRow(MdtKeaConstraints *list);

/** Pose (identity), velocity (0) and inverse mass (0) of the world. */
extern MEPUBLIC const MdtKeaTransformation MdtBclWorldPose;
extern MEPUBLIC const MdtKeaVelocity MdtBclWorldVelocity;
extern MEPUBLIC const MdtKeaInverseMassMatrix MdtBclWorldInvMass;

/** Sets a stop to its defaults: stop 0, restitution 1, stiffness MEINFINITY, damping 0. */
MEPUBLIC void MEAPI MdtBclSingleLimitReset(MdtBclSingleLimit *stop);
/** Sets a limit to its defaults: two default stops, inactive, not powered, nothing measured. */
MEPUBLIC void MEAPI MdtBclLimitReset(MdtBclLimit *limit);
/** Sets contact parameters to their defaults (Dynamics guide ch. 3, the table after MdtContactParamsReset). */
MEPUBLIC void MEAPI MdtBclContactParamsReset(MdtBclContactParams *params);

/** Sets the zero of a Skeletal's twist to its twist at these poses. */
MEPUBLIC void MEAPI MdtBclSkeletalZeroTwist(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]);

/** What the coupling's sum lacks of its constant at these poses: the sum minus the constant, rad or m. */
MEPUBLIC double MEAPI MdtBclCouplingError(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]);
/** A coordinate of a coupling at these poses, rad or m. */
MEPUBLIC double MEAPI MdtBclCouplingCoordinate(const MdtBclConstraint *c, int which,
                                               const MdtKeaTransformation *const pose[2]);
/** Makes the coordinates of a gear 0 at these poses. */
MEPUBLIC void MEAPI MdtBclGearEngage(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]);

ME_END_C

#endif
