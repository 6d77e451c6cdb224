/** @file MdtKea.h
 *  Kea, the solver and integrator (Dynamics guide ch. 5; User Guide ch. 2, "Kea").
 *
 *  Kea works on arrays: bodies with masses and states, constraint rows, and manifolds of contacts. It does not know of
 *  joints or worlds. A system is one partition (island): n bodies and m rows. The unknown of a body is the velocity
 *  u = (v_m, w_m) with which it moves through a step of length h, and θ is 1/2 (midpoint rule) or, where a contact or a
 *  stop may act, 1:
 *
 *      x⁺ = x + h v_m,   q⁺ = cay(h w_m) q,   v⁺ = v + (v_m - v)/θ
 *      M (v⁺ - v_free) = Σ Jᵀ p               v_free: v⁺ without rows; p = h λ: the impulse of a row, λ its force
 *      lower <= λ <= upper,  |λ| <= μ λ_normal or its cone
 *
 *  J is that of the mean of the poses at the start and the end, for which φ⁺ - φ = h J u. While its force is within its
 *  bounds, a row obeys the law below; at a bound its velocity may deviate in the one direction that complementarity
 *  allows:
 *
 *      velocity row (contacts, motors)    J v⁺ = s - h E λ
 *      `position` row (joints, stops)     φ(x⁺) = φ(x) + h (s - h E λ)
 *      `spring` row                       λ = -stiffness φ - damping (J u - s), with the mean φ of the step
 *
 *  For a joint row s = -γ φ / h and E = ε, which is the guide's (A + εI) x = b: γ is the fraction of the position
 *  error φ that one step removes (ERP), ε [1/kg] the compliance (CFM): a joint that carries the weight F sags by
 *  ε F h² / γ. ε = 0 is rigid. The regularization that the factorization needs is internal and does not affect the
 *  converged answer.
 *
 *  After a discontinuity the velocity stage corrects v⁺: it finds the velocities nearest to v⁺ that joints, stops and
 *  contacts allow at the end poses. A timed system (MdtKeaParameters.timed) has θ = 1/2 throughout, resolves impacts at
 *  their times (MdtKeaImpact), and has a velocity stage only if it has joints.
 *
 *  Contacts are passed as manifolds (MdtKeaManifold). The exact solver converts them to rows. The fast solver, for many
 *  bodies with few joints, solves manifold by manifold: its v⁺ fulfils the contact laws to a given accuracy; bodies are
 *  moved by velocities between v and v⁺, and by a correction of overlaps.
 *
 *  A step, or each sub-step of it, is a sequence of calls:
 *
 *      the owner               fills the manifolds, once for all sub-steps
 *      MdtKeaInit              reads bodies, parameters, numBodies, maxRows, maxContacts; writes pose, velocity,
 *                              predicted, invMass, numRows = 0
 *      the owner               writes the rows of its joints, numRows
 *      MdtKeaCountContactRows  reads manifolds; writes numRows of their points
 *      MdtKeaMakeContactRows   writes rows of contacts, behind the owner's rows
 *      MdtKeaKick              reads rows of joints, kicks; writes velocities of bodies, report.work. Afterwards
 *                              MdtKeaInit is called, and rows are filled, again
 *      MdtKeaMeets             reads rows; writes nothing
 *      MdtKeaImpact            reads rows, parameters; writes velocities of bodies and what MdtKeaInit derives from
 *                              them, forces (N s), report.work and .limited
 *      MdtKeaFlies             reads rows, velocity, predicted; writes .isOpen of rows. If it returns false after an
 *                              impact, MdtKeaInit is called, and rows are filled, again
 *      MdtKeaFly               reads all of these; writes states of bodies, forces of points (N s), report
 *      MdtKeaSolve             reads all of these; calls errors and jacobians, which update J, arm and bounds of rows;
 *                              writes forces of rows and points, .ripple, and report
 *      MdtKeaIntegrate         writes state and acceleration of bodies, and pose and velocity at the end
 *
 *  All numbers are double, also in single-precision builds: positions, orientations and momenta keep their digits over
 *  long runs.
 */
#ifndef MDTKEA_H
#define MDTKEA_H

#include "MePrecision.h"
#include <stddef.h>

ME_BEGIN_C

#define MdtKeaBODYVER1          100  /**< The layout of MdtKeaBody that this header describes. */
#define MdtKeaMAXBODYCONSTRAINT 2    /**< Maximal number of bodies of a row that is not split. */
#define MdtKeaSPLITROOM         4    /**< Rows that a split row takes room for beside its two: pairs of bodies. */
#define MdtKeaWORLD             (-1) /**< The world, which does not move, in place of a body's index. */

typedef enum MdtKeaBodyFlag {
    MdtKeaBodyFlagUseFastSpin = 1,      /**< Of programs, as MdtBodySetFastSpin sets it; Kea does not read it. */
    MdtKeaBodyFlagIsConstrained = 2,    /**< Of programs; Kea does not read it. */
    MdtKeaBodyFlagIsNonSpherical = 4,   /**< Of programs and Mdt; Kea does not read it, but compares the moments. */
    MdtKeaBodyFlagAddCoriolisForce = 8, /**< Free rotation conserves the angular momentum, not the angular velocity. */
} MdtKeaBodyFlag;

typedef struct MdtKeaVelocity {
    double lin[3]; /**< m/s */
    double ang[3]; /**< rad/s */
} MdtKeaVelocity;

enum { MdtKeaLOCKEDROTATIONS = 8 + 16 + 32 }; /**< Of MdtKeaBody.locked. */

/** A rigid body. Frames: world, but for `principal` and `moments`. */
typedef struct MdtKeaBody {
    /* state, advanced by Kea */
    double position[3];        /**< m, the centre of mass */
    double quaternion[4];      /**< w x y z, unit: body frame to world */
    double velocity[3];        /**< m/s, of the centre of mass */
    double angularMomentum[3]; /**< kg m²/s, about the centre of mass */
    /* constants, set by the owner */
    double invMass;      /**< 1/kg */
    double moments[3];   /**< kg m², principal moments of inertia, all positive */
    double principal[4]; /**< w x y z: principal axes to body frame */
    double damping[2];   /**< 1/s: dv/dt = -damping[0] v, dL/dt = -damping[1] L */
    int flags;           /**< MdtKeaBodyFlag */
    int locked; /**< bits 0 to 2: no translation along the world's x, y, z; bits 3 to 5: no rotation about them.
                              Velocities, momenta and loads along these axes are 0. With a locked rotation `moments` and
                              `principal` are those of the inertia between free axes, in the world's frame */
    /* load of this step, set by the owner */
    double force[3];        /**< N, gravity included */
    double torque[3];       /**< N m, about the centre of mass */
    double kick[2][3];      /**< kg m/s, kg m²/s: impulse at the start of the step; MdtKeaKick applies and zeroes it */
    double fall;            /**< s²: displacement per unit of constant acceleration since the owner set this to 0 */
    double acceleration[6]; /**< m/s², rad/s² (world), of the last sub-step: the warm start; 0: none */
    MdtKeaVelocity lastStep; /**< m/s², rad/s²: acceleration of the last whole step. An approach that is no faster than
                                  this acceleration explains in one step has no restitution */
} MdtKeaBody;

/** The pose of a body: a point x of its frame is at R x + pos in the world. */
typedef struct MdtKeaTransformation {
    double R[3][3];
    double pos[3]; /**< m */
} MdtKeaTransformation;

/** A body whose motion is given (kinematic). Rows have the world in its place, which moves with it. */
typedef struct MdtKeaMover {
    double position[3], quaternion[4]; /**< m, the centre, and w x y z, at the start of the step */
    MdtKeaVelocity velocity;           /**< constant during the step */
    MdtKeaVelocity jump;               /**< its change since the last step */
    MdtKeaVelocity
        chord; /**< `velocity`, but its ang turns a body by the Cayley map as far in the step as `velocity` does */
} MdtKeaMover;

typedef struct MdtKeaForce {
    double lin[3]; /**< N */
    double ang[3]; /**< N m, about the centre of mass */
} MdtKeaForce;

/** Force and torque of a constraint on each of its two bodies. */
typedef struct MdtKeaForcePair {
    MdtKeaForce body[2];
} MdtKeaForcePair;

typedef struct MdtKeaInverseMassMatrix {
    double mass;          /**< 1/kg */
    double inertia[3][3]; /**< 1/(kg m²), world frame */
} MdtKeaInverseMassMatrix;

/** The Jacobian of a row for one body: the row's rate J v is the sum of lin·v + ang·ω over its bodies. */
typedef struct MdtKeaJBlock {
    double lin[3];
    double ang[3];
} MdtKeaJBlock;

typedef MdtKeaJBlock MdtKeaJBlockPair[2];
typedef int MdtKeaBodyIndexPair[2]; /**< Indices of the system's bodies, or MdtKeaWORLD. */

/** One row of the system. SI units for a linear row; an angular one has rad for m and N m for N. */
typedef struct MdtKeaRow {
    MdtKeaJBlockPair J;
    MdtKeaBodyIndexPair body;
    double arm[2][3];  /**< m, lever arms of a position or spring row, from the centres of mass; angular rows: 0 */
    double bend[2][3]; /**< angular position rows: direction along which J turns with either body */
    double curvature;  /**< rad that J turns for a rad along it; 0: none. A bend takes room for one more row */
    double error;      /**< φ, m: the position error (position rows, springs; of a contact the gap) */
    double target;     /**< s, m/s: target of the rate, with the bias that corrects the error (Baumgarte) */
    double drift;      /**< m/s: the target without that bias: the rate due to moving attachments or a moving world */
    double carried;    /**< m/s: the rate due to a mover alone, with which its pose changes the error, too */
    const MdtKeaVelocity *mover; /**< of a joint's mover, in place of the world; null: none */
    double turning;              /**< m/s, normal rows: change of the rate in the step as the face of a mover turns */
    double jump; /**< m/s, contacts: change of the rate at the start of the step, by its mover's (MdtKeaMover.jump) */
    double softness; /**< E, 1/kg: compliance (CFM): ε, or the row's own */
    double lower;    /**< N, lower bound of the force; -HUGE_VAL: none */
    double upper;    /**< N, upper bound of the force; HUGE_VAL: none */
    double friction; /**< μ of a friction row (`normal` >= 0), m for an angular one; else unused */
    int normal;      /**< -1, or the index of the row whose force times μ bounds this one's in both directions */
    int partner;     /**< -1, or the index of the other friction row of a cone: |λ| <= μ λ_normal for the pair */
    int owner;       /**< a number that identifies the row's constraint */
    int contact;     /**< -1, or the index of the normal row of the contact that this row belongs to */
    MeBool moves;    /**< contacts: the lever arms change within the step (MdtKeaMove) */
    MeBool rolls;    /**< contacts: and the point is on a round side, a rim or a vertex of a body that rotates */
    MeBool isOpen;   /**< contacts in a timed step: the contact has a gap or separates, and does not act */
    MeBool isFixed;  /**< of a joint: J and the bounds are the same at all poses (MdtKeaJacobianFn) */
    MeBool position; /**< the row constrains φ at the end of the step (MdtKeaErrorFn); else the velocity */
    MeBool
        isSplit; /**< exact solver: the row has more bodies, those of the next row, whose isTail is set. That row has J,
                         arm, position and the bounds 0, and no force; maxRows has room for MdtKeaSPLITROOM more */
    MeBool isTail;
    MeBool isUnbiased;  /**< position rows: the correction of the error leaves no velocity (split impulse) */
    MeBool backward;    /**< its bodies move with their velocities at the end of the step (θ = 1) */
    MeBool spring;      /**< a damped spring; the target is the rate without damping force; softness is not read */
    double restitution; /**< 0..1, of a contact or a stop */
    double threshold;   /**< m/s: slower impacts have no restitution */
    double radius[2];   /**< m, normal rows: radius of either body's surface if it is round, else 0 */
    MeBool bounces;     /**< set by Kea: an impact in this step has restitution */
    double rebound;     /**< m/s, > 0: its separating velocity at the end of the step */
    double hop;         /**< set by Kea: share of the rate at the start that is subtracted from the target */
    MeBool isForced;    /**< set by Kea: a friction row that slides in a known direction */
    double forced;      /**< component of this direction: the force is `forced` times the bound */
    double stiffness;   /**< N/m of a spring, >= 0 */
    double damping;     /**< N s/m of a spring, >= 0 */
    MeBool isStiff; /**< set by Kea: a spring that is too stiff for the mean force of the step has that of its end */
    double mass;    /**< kg: effective mass that a spring moves; 0: that of its bodies along the row alone */
    double ripple;  /**< m/s: in: residual of the row's end velocity in the last step; out: in this one */
    double force;   /**< λ, N: in: the warm start; out: the answer */
} MdtKeaRow;

enum { MdtKeaMANIFOLDPOINTS = 4 }; /**< Maximal number of points of a manifold. */

/** The surface of a manifold's contacts. */
typedef struct MdtKeaSurface {
    double coefficient[2]; /**< Coulomb coefficient of friction along the primary and the secondary direction */
    double bound[2];       /**< N, constant bound of the friction at a point, in place of a coefficient */
    double slip[2];        /**< m/s per N, along either direction */
    double slide[2];       /**< m/s, surface velocity: the relative velocity that friction drives the bodies to */
    double rolling;        /**< m, >= 0: the largest torque at right angles to the normal, over the normal force */
    double spinning;       /**< m, >= 0: the largest torque about the normal, over the normal force */
    double softness;       /**< 1/kg, the contact's own; epsilon is in the parameters */
    double adhesion;       /**< N: largest pulling force of a point */
    double restitution;    /**< 0..1; 0: points do not bounce */
    double threshold;      /**< m/s: slower impacts have no restitution */
    MeBool isCone;         /**< a cone bounds the friction along both directions, with the primary coefficient */
    MeBool isOneWay;       /**< no friction along the secondary direction */
} MdtKeaSurface;

/** A point of a manifold. Kea writes force, depthNow and numRows, the owner the rest. */
typedef struct MdtKeaPoint {
    double position[3]; /**< m, at the start of the step */
    double depth;       /**< m, at the start of the step; negative: a gap */
    double guess[3];    /**< N, normal, primary, secondary: the warm start; 0: none */
    MeBool isVertex[2]; /**< a vertex of that body touches: the point moves with it */
    MeBool isNew;       /**< no warm start. If all points are new, MdtKeaInit guesses forces for the first sub-step */
    double force[3];    /**< N, normal, primary, secondary: the answer of MdtKeaSolve; of MdtKeaImpact in N s */
    double depthNow;    /**< m, at the start of the sub-step (MdtKeaCountContactRows, exact solver) */
    int numRows;        /**< rows of the point in the exact solver (MdtKeaCountContactRows): normal, friction, rolling,
                             spinning. The owner may reduce it to 1 (the normal only) or to 0 */
} MdtKeaPoint;

/** Contacts of two bodies that share a normal and a surface. World frame. The fast solver solves manifolds, the exact
 *  one converts them to rows. */
typedef struct MdtKeaManifold {
    MdtKeaBodyIndexPair body;
    int numPoints;
    double normal[3];    /**< unit, the direction in which the first body is pushed */
    double direction[3]; /**< unit, primary, at right angles to the normal */
    double radius[2];    /**< m, of spherical surfaces; 0: a corner, an edge, a face */
    double rim[2];       /**< m, radii of the circles, such as rims of wheels, that touch; 0: none */
    double axis[2][3];   /**< unit, axes of these circles; unused without a circle */
    MdtKeaSurface surface;
    const MdtKeaVelocity *worldVelocity; /**< of the world's surface, as of a body at the origin; null: it is at rest */
    const MdtKeaMover *mover; /**< in place of the world: worldVelocity is its chord, about its centre; null: none */
    MdtKeaPoint point[MdtKeaMANIFOLDPOINTS];
} MdtKeaManifold;

/** Which solver finds the forces of a system. */
typedef enum MdtKeaSolver {
    MdtKeaSolverExact, /**< rows, by Newton's method to the tolerance */
    MdtKeaSolverFast,  /**< manifolds, by accelerated passes, in time proportional to their number */
} MdtKeaSolver;

/** The Jacobian, later in the step, of a contact row whose lever arms change. */
typedef struct MdtKeaMove {
    MdtKeaJBlockPair J;
    double rate; /**< m/s, change since the start of the step of the rate due to a moving world */
} MdtKeaMove;
typedef MdtKeaMove MdtKeaMovePair[2]; /**< in the middle of the step; at its end */

/** Position in a pair of midpoint steps: the second step cancels velocities along joint directions left by the
 * first. */
typedef enum MdtKeaPair {
    MdtKeaPairNone,
    MdtKeaPairFirst,  /**< no velocity stage but for rebounds */
    MdtKeaPairSecond, /**< velocity stage after discontinuities, but not against the alternating mode */
} MdtKeaPair;

/** Parameters of the whole system. The owner's rows have epsilon and gamma in their softness and target already. */
typedef struct MdtKeaParameters {
    double stepsize;     /**< s, of the step or sub-step */
    double elapsed;      /**< s, from the start of the step to that of this sub-step; 0: the first one */
    double late;         /**< s, from the start of the movers' step to that of this step */
    MeBool isBack;       /**< this sub-step goes back in time (MdtKeaReverse) */
    double epsilon;      /**< 1/kg, of contacts */
    double softening;    /**< factor of the softness of contact surfaces in a sub-step; 1 in a whole step */
    double gamma;        /**< fraction of a position error that the step removes, 0..1 */
    int maxIterations;   /**< cap on the Newton iterations, or the fast solver's passes, of the whole solve; 0: none */
    double maxWork;      /**< cap on the multiplications of the whole solve, roughly; 0: none */
    MeBool mayDecline;   /**< the solve may be declined if it would take more than maxWork */
    double ordinaryWork; /**< multiplications, of a solve that may be declined: after them a coarser answer will do */
    double acceptable;   /**< m/s: residual up to which an answer is not declined */
    MeBool mayRefuse;    /**< a step in which bodies turn too far may be reported as violent without being solved */
    MeBool isPart;       /**< a sub-step that ends at a safe time: corrections of joints must not add energy */
    MdtKeaPair pair;     /**< a composition of higher order takes steps in pairs */
    MeBool timed;        /**< impacts are resolved at their time; bodies move with their mean velocities (θ = 1/2) */
    MeBool holdsSlow;    /**< a timed step is not divided at impacts that are too slow to rebound: these contacts are
                            constrained from its start, so that they touch at its end; nor where sliding stops */
    MeBool followsContacts; /**< fast solver: contacts on vertices and rims move with their bodies within the step */
    MeBool collidesAtStart,
        collidesAtEnd; /**< fast solver: bodies meet at the start, or at the end, of this sub-step */
    MdtKeaSolver solver;
    double accuracy;  /**< m/s: residual that a row may have; more is allowed while bodies are accelerated */
    double restSpeed; /**< m/s, fast solver: slower bodies count as resting */
} MdtKeaParameters;

/** Cost and accuracy of a solve. */
typedef struct MdtKeaReport {
    int passes;         /**< linearizations; 0 if the last step's answer was within the tolerances */
    int iterations;     /**< of Newton's method in all passes; of the fast solver, passes */
    int factorizations; /**< of sparse matrices */
    int stages;         /**< velocity stages, 0 or 1 */
    int freezes;        /**< passes with frozen friction bounds, because their fixed point iteration did not converge */
    double work;        /**< multiplications, roughly: of factorizations, and of visits of rows */
    double least;       /**< multiplications, a lower bound of any solve: a few linearizations or passes */
    MeBool limited;     /**< the budget of work or iterations ran out: the answer is the best so far (see capped) */
    MeBool capped;      /**< passes, work or iterations ran out: the forces are within bounds, but not exact, and the
                             bodies have no more energy than loads, springs and motors explain */
    MeBool violent;     /**< positions have not converged: the step is too long for the motion */
    MeBool declined;    /**< the solve would take more than maxWork (MdtKeaParameters.mayDecline) */
    MeBool refused;     /**< `violent`, without having been solved (MdtKeaParameters.mayRefuse) */
    MeBool conflicting; /**< joints contradict each other: the answer is a compromise */
    double event;       /**< s: time of the first event, at which to divide a timed step; none: the step's length */
    MeBool trembles;    /**< chattering: the only events are impacts, all too slow to rebound */
    MeBool twisted;     /**< timed steps: a contact of jointed bodies pushes along two lines */
    MeBool ballistic;   /**< timed steps: no row acts up to the event (MdtKeaFly) */
    int impacts;        /**< number of impacts in MdtKeaFly */
    double excess;      /**< the largest ratio of a row's residual to its tolerance: up to 1 the answer is accurate */
    double residual;   /**< m/s: the largest violation of J v⁺ = s - h E λ, but for rows at a bound that allows it */
    double resolution; /**< m/s: residuals up to this count as 0; itself 0 if nothing was solved */
    double force;      /**< N: the largest change of a row's force that would remove its violation */
    double error;      /**< m: the largest part of a position row's error that was to be corrected and was not */
    double opening;    /**< of the smaller body's size: the largest error of a position row that is not a contact's: of
                             the fast solver all that is left, of the exact one what was to be corrected and was not */
    MeBool opens;      /**< joints open by a twentieth of a body or more: shorter steps, or the other solver, may close
                             them */
} MdtKeaReport;

/**
 * Writes errors[i], the error φ of row i with the bodies at `poses` (by body index), for every row i that is marked
 * `position`; other entries may be left unchanged. Called by MdtKeaSolve.
 */
typedef void(MEAPI *MdtKeaErrorFn)(void *context, const MdtKeaTransformation poses[], double errors[]);

/**
 * Writes J and arm of the system's rows that depend on the poses, with the bodies at `poses`. Matrices of `poses` may
 * be means of rotations. Called by MdtKeaSolve, with MdtKeaErrorFn.
 */
typedef void(MEAPI *MdtKeaJacobianFn)(void *context, const MdtKeaTransformation poses[]);

/** Cache, for speed only, of the structures of sparse matrices, which are kept from step to step
 *  (MdtKeaCacheCreate). */
typedef struct MdtKeaCache MdtKeaCache;

/** One partition in one step. The owner fills the first group and calls MdtKeaInit, which sets the pointers below. */
typedef struct MdtKeaSystem {
    MdtKeaParameters parameters;
    int numBodies;
    MdtKeaBody *const *bodies; /**< numBodies pointers */
    int maxRows;               /**< capacity for rows, those of contacts included */
    int maxContacts;           /**< capacity for points of manifolds that the exact solver converts to rows */
    MdtKeaManifold *manifolds; /**< the owner's, for all sub-steps; Kea writes the results of their points */
    int numManifolds;
    MdtKeaErrorFn errors;       /**< may be null if no row is a position row */
    MdtKeaJacobianFn jacobians; /**< may be null: J is constant */
    void *context;              /**< passed to both */
    double share;               /**< of the sub-step, at the end of which the poses are that these functions get; 1/2:
                                     means of start and end */
    MdtKeaCache *cache;         /**< may be shared by systems that are solved one after the other */
    struct MeTeam *team;        /**< threads that work on a large system; null: the calling thread alone */

    MdtKeaTransformation *pose; /**< by body, at the start; after MdtKeaIntegrate at the end */
    MdtKeaVelocity *velocity;   /**< by body, at the start; after MdtKeaIntegrate at the end */
    MdtKeaVelocity *predicted;  /**< by body, at the end without constraints; angular: by the inertia at the start */
    MdtKeaInverseMassMatrix *invMass; /**< by body, at the start */
    MdtKeaRow *rows;                  /**< the owner fills rows[0..numRows), */
    MdtKeaMovePair *moves;            /**< and moves[i] of each rows[i] with the flag `moves` */
    int numRows;
    MdtKeaReport report;     /**< set by MdtKeaSolve */
    struct MdtKeaWork *work; /**< private to Kea */
} MdtKeaSystem;

/** Creates a cache for systems that are solved one after the other. Null if there is no memory. */
MEPUBLIC MdtKeaCache *MEAPI MdtKeaCacheCreate(void);
/** Destroys a cache; null is allowed. */
MEPUBLIC void MEAPI MdtKeaCacheDestroy(MdtKeaCache *cache);

/** Bytes of scratch memory that a system of this size needs (MdtKeaInit). */
MEPUBLIC size_t MEAPI MdtKeaScratchSize(int numBodies, int maxRows, int maxContacts);

/**
 * Lays out the system's arrays in @a scratch, which is aligned to 16 bytes and has MdtKeaScratchSize bytes, and
 * computes poses, velocities and predictions. The bodies are only read. The arrays live as long as the scratch memory.
 * All sub-steps of a step use the same memory, in which contacts keep their attachment points.
 */
MEPUBLIC void MEAPI MdtKeaInit(MdtKeaSystem *system, void *scratch);

/**
 * Measures the contacts of the manifolds at the start of the sub-step and writes how many rows each point needs
 * (numRows); returns the sum. The rows do not exist yet: the owner may lower numRows of points. For the fast solver
 * rows are counted only: nothing is measured, and no rows will be made.
 */
MEPUBLIC int MEAPI MdtKeaCountContactRows(MdtKeaSystem *system);

/** Writes the rows of contacts behind the owner's: of each point the normal row, then friction rows. Does nothing for
 *  the fast solver. */
MEPUBLIC void MEAPI MdtKeaMakeContactRows(MdtKeaSystem *system);

/**
 * Finds the forces of the system's rows and the end states of the bodies under them. Writes rows[i].force, the force of
 * the manifolds' points, and the report.
 * The bodies are only read, so that a solve whose report says `violent` can be discarded and repeated with a shorter
 * step; if it is kept, the position rows are fulfilled to first order. If the rows are finite, the answer is finite and
 * within bounds.
 */
MEPUBLIC void MEAPI MdtKeaSolve(MdtKeaSystem *system);

/** The poses by body at the end of the step that MdtKeaSolve has found. */
MEPUBLIC const MdtKeaTransformation *MEAPI MdtKeaEndPoses(const MdtKeaSystem *system);

/**
 * Sets the bodies to their end states found by MdtKeaSolve or MdtKeaFly. Returns false, and changes no body, if a state
 * is not finite in MeReal or the force of a point is not finite; else true.
 */
MEPUBLIC MeBool MEAPI MdtKeaIntegrate(MdtKeaSystem *system);

/**
 * Whether an impact occurs at the start of the step: the bodies of a touching contact approach each other (timed
 * systems). Needs filled rows; changes nothing.
 */
MEPUBLIC MeBool MEAPI MdtKeaMeets(const MdtKeaSystem *system);

/**
 * Reflects, at the start of a sub-step that is not timed, the velocities of bodies whose contacts have restitution and
 * will meet within it (kea_reflect.c). Writes the impulses, N s, as forces of their points. Returns the number of
 * reflections; unless it is 0, MdtKeaInit has to be called and rows be filled again. Needs filled rows.
 */
MEPUBLIC int MEAPI MdtKeaReflect(MdtKeaSystem *system);

/**
 * Whether impacts would chatter, which would divide the step without end: bodies of touching contacts approach each
 * other (MdtKeaMeets), but all too slowly to rebound, and no open contact will close faster within the step. Needs
 * filled rows; changes nothing.
 */
MEPUBLIC MeBool MEAPI MdtKeaTrembles(const MdtKeaSystem *system);

/**
 * Whether a step of the system is reversible: from its end, with velocities negated, a step of the same length returns
 * to the start, but for rounding. True for joints without bounds, targets and compliance, springs without damping that
 * are not too stiff for the midpoint rule, and bodies without damping; gamma is ignored. Needs filled rows; changes
 * nothing.
 */
MEPUBLIC MeBool MEAPI MdtKeaIsReversible(const MdtKeaSystem *system);

/** Whether some body turns too far for the midpoint rule in a step of @a step seconds without contacts. Needs bodies
 *  only. */
MEPUBLIC MeBool MEAPI MdtKeaTurnsTooFar(const MdtKeaSystem *system, double step);

/** Negates the bodies' velocities and angular momenta. The owner then calls MdtKeaInit, and fills the rows, again. */
MEPUBLIC void MEAPI MdtKeaReverse(MdtKeaSystem *system);

/**
 * Whether an impact is predicted within the step that rebounds faster than half the change of velocity by loads in a
 * step, and there are neither springs nor overlaps whose bodies do not approach fast. Needs filled rows; changes
 * nothing.
 */
MEPUBLIC MeBool MEAPI MdtKeaBounces(const MdtKeaSystem *system);

/**
 * Whether a jointed system, such as a car, only rolls, and may be timed even if nothing bounces: all contacts are those
 * of round surfaces, with overlaps of at most a thousandth of the smaller body's size, and there are no springs and no
 * stops or joints that may reach a bound, which need the damping of θ = 1. False without contacts. Needs filled rows;
 * changes nothing.
 */
MEPUBLIC MeBool MEAPI MdtKeaRolls(const MdtKeaSystem *system);

/**
 * The number of bodies with joints or persistent contacts (MdtKeaContactHolds). Needs filled rows; changes scratch
 * memory only.
 */
MEPUBLIC int MEAPI MdtKeaHeldBodies(const MdtKeaSystem *system);
/**
 * Whether a contact persists: its bodies touch, and neither separate nor collide so fast that they rebound.
 *  @param bodies    one of them may be null: the world
 *  @param gap       m, negative: an overlap
 *  @param rate      m/s, at which the gap grows
 *  @param loadSpeed m/s, by which the loads change the bodies' velocities in a step
 */
MEPUBLIC MeBool MEAPI MdtKeaContactHolds(const MdtKeaBody *const bodies[2], double gap, double rate, double restitution,
                                         double loadSpeed);

/**
 * s: the time of the first impact of the system's manifolds within the step that is faster than a quarter of the change
 * of velocity by loads, if accelerations stay those of the last step; none: the step's length. Needs no rows; changes
 * nothing.
 */
MEPUBLIC double MEAPI MdtKeaTimeOfImpact(const MdtKeaSystem *system);

/** Whether some body has a kick, an impulse at the start of the step (MdtKeaBody.kick). */
MEPUBLIC MeBool MEAPI MdtKeaIsKicked(const MdtKeaSystem *system);

/**
 * Applies the kicks of the bodies. Rigid joints transmit them in the same instant: the rates of their rows do not
 * change. Reads the rows of joints. The owner then calls MdtKeaInit, and fills the rows, again.
 */
MEPUBLIC void MEAPI MdtKeaKick(MdtKeaSystem *system);

/**
 * Resolves the impacts at the start of the step: changes velocities so that colliding bodies separate with their
 * restitution times their approach speed. Handles simultaneous impacts at several points and their propagation through
 * rows of touching bodies, and never adds energy. Writes the impulses, N s, into rows[i].force and the points' force,
 * and its cost into the report.
 */
MEPUBLIC void MEAPI MdtKeaImpact(MdtKeaSystem *system);

/** Whether no row of a timed system acts before its first event: it has no joints, and all contacts are open. Its rows
 *  then only predict that event, so that rows made before an impact may be used. */
MEPUBLIC MeBool MEAPI MdtKeaFlies(MdtKeaSystem *system);

/**
 * Advances bodies in flight (MdtKeaFlies) from impact to impact, each on its own path, to the end of the step or to the
 * first impact after which a contact is closed. Needs the rows of this step and removes them; MdtKeaIntegrate follows.
 * Writes the sums of the impulses, N s, into the points' force, and report.work and .impacts.
 * @param least       s, 0 < least < the step's: the shortest time that is resolved
 * @param maxImpacts  the number of impacts after which it ends
 * @return s, the time that the bodies were advanced by, at least @a least; also written to the system's stepsize
 */
MEPUBLIC double MEAPI MdtKeaFly(MdtKeaSystem *system, double least, int maxImpacts);

/** m: the vector from the centre of a round surface, or of a rim (@a rim > 0, about @a axis), to its point that is
 *  farthest along the unit vector @a outward. 0 for a flat surface, whose radius and rim are 0. */
MEPUBLIC void MEAPI MdtKeaOffsetToSurface(double radius, double rim, const double axis[3], const double outward[3],
                                          double offset[3]);

/** The pose of a mover after @a time seconds of its step. */
MEPUBLIC void MEAPI MdtKeaMoverPose(const MdtKeaMover *mover, double time, MdtKeaTransformation *pose);

/** The angular velocity of a body, rad/s, world frame. */
MEPUBLIC void MEAPI MdtKeaBodyGetAngularVelocity(const MdtKeaBody *body, double w[3]);

/** Sets the angular momentum of a body from its angular velocity @a w, rad/s, world frame. */
MEPUBLIC void MEAPI MdtKeaBodySetAngularVelocity(MdtKeaBody *body, const double w[3]);

/**
 * Sets the body's principal moments and axes from a symmetric inertia tensor (kg m², body frame). Returns false, and
 * leaves the body unchanged, if the tensor is not finite, not symmetric or not positive definite.
 */
MEPUBLIC MeBool MEAPI MdtKeaBodySetInertia(MdtKeaBody *body, const double inertia[3][3]);

/** Makes a symmetric matrix @a S diagonal, by Jacobi rotations. The columns of @a V are its axes; those of a diagonal
 *  matrix are not changed. */
MEPUBLIC void MEAPI MdtKeaDiagonalize(double S[3][3], double V[3][3]);

/**
 * Bytes of scratch memory for solving partitions one after the other: the largest need of one of them
 * (User Guide App. C, "Memory Usage in Kea"). @a num_rows_exc_padding has the rows of each partition; a null array
 * means one partition of @a max_rows. No partition has more than @a max_bodies bodies.
 */
MEPUBLIC int MEAPI MdtKeaMemoryRequired(const int num_rows_exc_padding[], int num_partitions, int max_rows,
                                        int max_bodies);

ME_END_C

#endif
