/** @file MdtKea.h
 *  Kea, the solver and integrator (Dynamics guide ch. 5; User Guide ch. 2, "Kea").
 *
 *  Kea knows arrays only: bodies with masses and states, and constraint rows. It knows nothing of joints, contacts or
 *  worlds. One system is one partition: n bodies and m rows. The unknown of a body is the velocity u = (v_m, w_m) with
 *  which it moves through a step of length h, and θ is 1/2 (midpoint rule) or, where a contact or a stop may act, 1:
 *
 *      x⁺ = x + h v_m,   q⁺ = cay(h w_m) q,   v⁺ = v + (v_m - v)/θ
 *      M (v⁺ - v_free) = Σ Jᵀ p               v_free: at the end without rows; p = h λ: the row's impulse, λ its force
 *      lower <= λ <= upper,  |λ| <= μ λ_normal or its cone
 *
 *  Rows act on the mean of the poses at the start and the end, for which φ⁺ - φ = h J u. A row whose force is within
 *  its bounds keeps its law; at a bound its velocity goes the way that the bound allows:
 *
 *      velocity row (contacts, motors)    J v⁺ = s - h E λ
 *      `position` row (joints, stops)     φ(x⁺) = φ(x) + h (s - h E λ)
 *      `spring` row                       λ = -stiffness φ - damping (J u - s)
 *
 *  For a joint row s = -γ φ / h and E = ε, which is the guide's (A + εI) x = b: γ is the fraction of the position
 *  error φ that one step takes away, ε [1/kg] the compliance: a joint that carries the weight F sags by ε F h² / γ.
 *  ε = 0 means rigid. What regularization the factorization needs is internal, relative, and taken out again.
 *
 *  After a discontinuity the velocity stage corrects v⁺: it finds the velocities nearest to it that joints, stops and
 *  contacts allow at the end poses. A timed system (MdtKeaParameters) has θ = 1/2 throughout, impacts of its own, and a
 *  velocity stage only where it has joints.
 *
 *  Contacts come as manifolds (MdtKeaManifold). The exact solver makes rows of them; the fast one, for many bodies with
 *  few joints, solves manifold by manifold: x⁺ = x + h v⁺ and a correction of overlaps, where v⁺ fulfils the contact
 *  laws to a given accuracy.
 *
 *      the owner               fills the manifolds, once for all parts of a step
 *      MdtKeaInit              reads bodies, parameters, numBodies, maxRows, maxContacts; writes pose, velocity,
 *                              predicted, invMass, numRows = 0
 *      the owner               writes the rows of its joints, numRows
 *      MdtKeaCountContactRows  reads manifolds; writes numRows of their points
 *      MdtKeaMakeContactRows   writes their rows and moves behind the others
 *      MdtKeaKick              reads rows of joints, kicks; writes velocities of bodies, report.work. MdtKeaInit is
 *                              called after it, and the rows are filled, again
 *      MdtKeaMeets             reads rows; writes nothing
 *      MdtKeaImpact            reads rows, parameters; writes velocities of bodies and what MdtKeaInit makes of them,
 *                              forces (N s), report.work and .limited
 *      MdtKeaFlies             reads rows, velocity, predicted; writes .isOpen of rows. If it says no, MdtKeaInit is
 *                              called, and the rows are filled, again after an impact
 *      MdtKeaFly               reads all of these; writes states of bodies, forces of points (N s), report
 *      MdtKeaSolve             reads all of these; calls errors and jacobians, by which J, arm and bounds of rows move;
 *                              writes forces of rows and points, .ripple, and report
 *      MdtKeaIntegrate         writes the state and the acceleration of bodies, pose and velocity of the end
 *
 *  Everything here is double, in single-precision builds too: positions, orientations and momenta keep their digits
 *  over long runs.
 */
#ifndef MDTKEA_H
#define MDTKEA_H

#include "MePrecision.h"
#include <stddef.h>

ME_BEGIN_C

#define MdtKeaBODYVER1          100  /**< The layout of MdtKeaBody that this header describes. */
#define MdtKeaMAXBODYCONSTRAINT 2    /**< A row joins at most this many bodies. */
#define MdtKeaWORLD             (-1) /**< In place of a body's index: the world, which does not move. */

typedef enum MdtKeaBodyFlag {
    MdtKeaBodyFlagUseFastSpin = 1,      /**< Kept for programs, as MdtBodySetFastSpin sets it; Kea does not read it. */
    MdtKeaBodyFlagIsConstrained = 2,    /**< Kept for programs; Kea does not read it. */
    MdtKeaBodyFlagIsNonSpherical = 4,   /**< Kept for programs, and for Mdt; Kea takes the moments as they are. */
    MdtKeaBodyFlagAddCoriolisForce = 8, /**< Free rotation keeps the angular momentum, not the angular velocity. */
} MdtKeaBodyFlag;

typedef struct MdtKeaVelocity {
    double lin[3]; /**< m/s */
    double ang[3]; /**< rad/s */
} MdtKeaVelocity;

/** A rigid body. Frames: world, but for `principal` and `moments`. */
typedef struct MdtKeaBody {
    /* state, advanced by Kea */
    double position[3];        /**< m, the centre of mass */
    double quaternion[4];      /**< w x y z, unit: body frame to world */
    double velocity[3];        /**< m/s, of the centre of mass */
    double angularMomentum[3]; /**< kg m²/s, about the centre of mass */
    /* constants, set by the owner */
    double invMass;        /**< 1/kg */
    double moments[3];     /**< kg m², principal moments of inertia, all positive */
    double principal[4];   /**< w x y z: principal axes to body frame */
    double linearDamping;  /**< 1/s: dv/dt = -d v */
    double angularDamping; /**< 1/s: dL/dt = -d L */
    int flags;             /**< MdtKeaBodyFlag */
    /* load of this step, set by the owner */
    double force[3];         /**< N, gravity included */
    double torque[3];        /**< N m, about the centre of mass */
    double kick[2][3];       /**< kg m/s, kg m²/s: momentum given as the step begins (MdtKeaKick, which zeroes it) */
    double fall;             /**< s²: how far a unit of acceleration has moved it since the owner set this to 0 */
    double acceleration[6];  /**< m/s², rad/s² (world), of the last part of a step: the warm start; 0: none */
    MdtKeaVelocity lastStep; /**< m/s², rad/s²: acceleration of the last whole step: an approach no faster than what it
                                  gives in one step is no impact (restitution) */
} MdtKeaBody;

/** Where a body is: world = R x + pos. */
typedef struct MdtKeaTransformation {
    double R[3][3];
    double pos[3]; /**< m */
} MdtKeaTransformation;

typedef struct MdtKeaForce {
    double lin[3]; /**< N */
    double ang[3]; /**< N m, about the centre of mass */
} MdtKeaForce;

/** What a constraint does to its two bodies. */
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
    double arm[2][3]; /**< m, lever arms of a position or spring row, from the centres of mass; 0 of an angular row */
    double error;     /**< φ, m: the position error (position rows, springs; of a contact the gap) */
    double target;    /**< s, m/s: target of the rate, with the bias that corrects the error (Baumgarte) */
    double drift;     /**< m/s: the part of the target without that bias: motion of attachments, or of the world */
    double softness;  /**< E, 1/kg: compliance (CFM): ε, or the row's own */
    double lower;     /**< N, -HUGE_VAL where there is none */
    double upper;     /**< N, HUGE_VAL where there is none */
    double friction;  /**< μ of a row that `normal` limits, else unused */
    int normal;       /**< -1, or the index of the row whose force times μ bounds this one, both ways */
    int partner;      /**< -1, or the index of the other friction row of a cone: |λ| <= μ λ_normal for the two */
    int owner;        /**< a number that identifies the row's constraint */
    int contact;      /**< -1, or the index of the normal row of the contact that this row is part of */
    MeBool moves;     /**< of a contact: its lever arms change within the step, see MdtKeaMove */
    MeBool isOpen;    /**< of a contact in a timed step: it has a gap or separates, and does not act */
    MeBool position;  /**< the row constrains φ at the end of the step (MdtKeaErrorFn); else the velocity */
    MeBool spring;    /**< A damped spring; its target is the rate at which it is at rest, and softness is not read. */
    double restitution; /**< of a contact or a stop, 0..1, */
    double threshold;   /**< m/s: for speeds above this */
    double radius[2];   /**< m, of a contact's normal row: of either body's surface where that is round, else 0 */
    MeBool bounces;     /**< Kea's own: an impact in this step has restitution */
    double rebound;     /**< m/s, > 0: its separating velocity at the end of the step */
    MeBool isForced;    /**< Kea's own: a friction row that slides in a known direction */
    double forced;      /**< its component of that direction: the force is this times the bound */
    double stiffness;   /**< N/m of a spring, >= 0 */
    double damping;     /**< N s/m of a spring, >= 0 */
    double ripple;      /**< m/s: in: residual of the row's end velocity in the last step; out: in this one */
    double force;       /**< λ, N: in: the warm start; out: the answer */
} MdtKeaRow;

enum { MdtKeaMANIFOLDPOINTS = 4 }; /**< Points that a manifold has at most. */

/** The surface of a manifold's contacts. */
typedef struct MdtKeaSurface {
    double coefficient[2]; /**< of friction along the primary and the secondary direction, times the normal force */
    double bound[2];       /**< N, of friction at each point, whatever its normal force */
    double slip[2];        /**< m/s per N, along either direction */
    double slide[2];       /**< m/s, surface velocity: the relative velocity to which friction drives */
    double softness;       /**< 1/kg, the contact's own; epsilon is in the parameters */
    double adhesion;       /**< N: bound of the pulling force of a point */
    double restitution;    /**< 0..1; 0: points do not bounce */
    double threshold;      /**< m/s: slower impacts have no restitution */
    MeBool isCone;         /**< friction along both directions together has the primary coefficient */
    MeBool isOneWay;       /**< there is none along the secondary direction */
} MdtKeaSurface;

/** A point of a manifold. The owner writes all but what is said to be Kea's. */
typedef struct MdtKeaPoint {
    double position[3]; /**< m, as the step begins */
    double depth;       /**< m, as the step begins; negative: a gap */
    double guess[3];    /**< N, normal, primary, secondary: the warm start; 0: none */
    MeBool isNew;       /**< there is none; where that is so of all, MdtKeaInit makes one for a step's first part */
    double force[3];    /**< N, the same: the answer (MdtKeaSolve); of an impact, N s (MdtKeaImpact) */
    double depthNow;    /**< m, as this part of the step begins (MdtKeaCountContactRows, of the exact solver) */
    int numRows;        /**< rows that the exact solver makes of it (the same): 1 and friction. The owner may leave out
                             friction, or all */
} MdtKeaPoint;

/** Contacts of two bodies that share a normal and a surface. World frame. The fast solver takes manifolds, the exact
 *  one makes rows of them. */
typedef struct MdtKeaManifold {
    MdtKeaBodyIndexPair body;
    int numPoints;
    double normal[3];    /**< unit, the direction in which the first body is pushed */
    double direction[3]; /**< unit, primary, at right angles to the normal */
    double radius[2];    /**< m, of the two surfaces where they are spherical; 0: a corner, an edge, a face */
    double rim[2];       /**< m, radii of the circles, such as rims of wheels, with which the surfaces touch; 0: none */
    double axis[2][3];   /**< unit, of these; unused where there is none */
    MdtKeaSurface surface;
    const MdtKeaVelocity *worldVelocity; /**< null: none; of the world's part, as if it were a body at the origin */
    MdtKeaPoint point[MdtKeaMANIFOLDPOINTS];
} MdtKeaManifold;

/** Which solver finds the forces of a system. */
typedef enum MdtKeaSolver {
    MdtKeaSolverExact, /**< rows, by Newton's method to the tolerance */
    MdtKeaSolverFast,  /**< manifolds, by accelerated passes: its time is proportional to the manifolds */
} MdtKeaSolver;

/** The Jacobian of a row of a contact whose lever arms change, later in the step. */
typedef struct MdtKeaMove {
    MdtKeaJBlockPair J;
    double rate; /**< m/s, change of the moving world's part of the rate since the start of the step */
} MdtKeaMove;
typedef MdtKeaMove MdtKeaMovePair[2]; /**< the mean of start and end; the end */

/** Place in a pair of midpoint steps: velocities along joint directions that one leaves, the next cancels. */
typedef enum MdtKeaPair {
    MdtKeaPairNone,
    MdtKeaPairFirst,  /**< no velocity stage but for rebounds */
    MdtKeaPairSecond, /**< velocity stage after discontinuities, but not against the alternating mode */
} MdtKeaPair;

/** Parameters of the whole system. The rows that the owner fills contain epsilon and gamma already. */
typedef struct MdtKeaParameters {
    double stepsize;   /**< s */
    double elapsed;    /**< s, of the step before this part of it; 0: the first part */
    MeBool isBack;     /**< this part goes back in time (MdtKeaReverse) */
    double epsilon;    /**< 1/kg, of contacts */
    double softening;  /**< by which a contact's own softness is multiplied, in a part of a step; else 1 */
    double gamma;      /**< the part of a position error that the step takes away, 0..1 */
    int maxIterations; /**< Newton iterations of the whole solve; 0: as many as it takes */
    double maxWork;    /**< multiplications of the whole solve, roughly; 0: as many as it takes */
    MeBool mayDecline; /**< an answer that takes more than maxWork need not be found */
    MeBool mayRefuse;  /**< a step in which bodies turn too far may be reported as violent without being solved */
    MeBool isPart;     /**< a part of a step by safe times: corrections of joints must not add energy */
    MdtKeaPair pair;   /**< a composition of higher order takes steps in pairs */
    MeBool timed;      /**< impacts are resolved at their time; bodies move with their mean velocities (θ = 1/2) */
    MeBool holdsSlow;  /**< a timed step is not divided where contacts meet too slowly to rebound, which are held from
                            its start on so that they touch at its end; nor where something comes to stick */
    MdtKeaSolver solver;
    double accuracy;  /**< m/s: the residual that a row may have, and more while bodies are accelerated */
    double restSpeed; /**< m/s, of the fast solver: slower bodies are not told from resting ones */
} MdtKeaParameters;

/** How a solve went. */
typedef struct MdtKeaReport {
    int passes;         /**< linearizations: 0 where the last step's answer still held */
    int iterations;     /**< of Newton's method in all passes */
    int factorizations; /**< of sparse matrices */
    int stages;         /**< velocity stages, 0 or 1 */
    int freezes;        /**< passes with frozen friction bounds, whose iteration did not converge */
    double work;        /**< multiplications, roughly: of factorizations, and of visits of rows */
    double least;       /**< the same: no solve can do with less, of a few linearizations or passes */
    MeBool limited;     /**< the work or the iterations that it was given ran out: the best answer so far, see capped */
    MeBool capped;      /**< passes, work or iterations ran out: the forces are within bounds, but not exact, and the
                             bodies have no more energy than loads, springs and motors explain */
    MeBool violent;     /**< positions have not converged: the step is too long for the motion */
    MeBool declined;    /**< the work that it takes is more than it was given, see MdtKeaParameters.mayDecline */
    MeBool refused;     /**< `violent` without having been solved, see MdtKeaParameters.mayRefuse */
    MeBool conflicting; /**< joints contradict each other: the answer is a compromise */
    double event;       /**< s: the first event of a timed step, which is to be divided there; none: its length */
    MeBool trembles;    /**< chattering: the only events are impacts, all too slow to rebound */
    MeBool ballistic;   /**< of a timed step: no row acts up to the event (MdtKeaFly) */
    int impacts;        /**< that MdtKeaFly has met */
    double excess;      /**< the largest residual in tolerances, its row's own: up to 1 the answer is accurate enough */
    double residual;   /**< m/s: the largest violation of J v⁺ = s - h E λ, but for rows at a bound that allows it */
    double resolution; /**< m/s: residuals up to this count as none; 0 where nothing was solved */
    double force;      /**< N: the largest change of a row's force that such a violation asks for */
    double error;      /**< m: the largest error left in a position row, against what it asked for */
    double opening;    /**< of the smaller body's size: the largest error of a position row that is not a contact's, as
                             the fast solver leaves it; of the exact one, what it was to correct and has not */
    MeBool opens;      /**< joints do, by a twentieth of a body or more: shorter steps, or the other solver, may close
                             them */
} MdtKeaReport;

/**
 * Errors φ of the system's rows were the bodies at `poses` (by body index). Writes errors[i] for every row i that is
 * marked `position`; other entries may be left alone. Called by MdtKeaSolve.
 */
typedef void(MEAPI *MdtKeaErrorFn)(void *context, const MdtKeaTransformation poses[], double errors[]);

/**
 * Writes J and arm of the system's rows that move with the bodies, were they at `poses`, whose matrices may be means of
 * rotations. Called by MdtKeaSolve, with errors.
 */
typedef void(MEAPI *MdtKeaJacobianFn)(void *context, const MdtKeaTransformation poses[]);

/** What Kea keeps from step to step, for speed only: the structure of matrices that have come up
 *  (MdtKeaCacheCreate). */
typedef struct MdtKeaCache MdtKeaCache;

/** One partition in one step. Fill in the first group, call MdtKeaInit, and read or write the rest. */
typedef struct MdtKeaSystem {
    MdtKeaParameters parameters;
    int numBodies;
    MdtKeaBody *const *bodies; /**< numBodies pointers */
    int maxRows;               /**< room for rows, those of contacts included */
    int maxContacts;           /**< room for points of manifolds that the exact solver makes rows of */
    MdtKeaManifold *manifolds; /**< the owner's, for all parts of a step; the force of their points is written */
    int numManifolds;
    MdtKeaErrorFn errors;       /**< may be null where no row is a position row */
    MdtKeaJacobianFn jacobians; /**< may be null: then J stays as it is */
    void *context;              /**< for both */
    MdtKeaCache *cache;         /**< of one system at a time */
    struct MeTeam *team;        /**< works on a large system together; null: the calling thread alone */

    MdtKeaTransformation *pose;       /**< by body, at the start; after MdtKeaIntegrate at the end */
    MdtKeaVelocity *velocity;         /**< by body, at the start; after MdtKeaIntegrate at the end */
    MdtKeaVelocity *predicted;        /**< by body, at the end were there no constraints, in the start's pose */
    MdtKeaInverseMassMatrix *invMass; /**< by body, at the start */
    MdtKeaRow *rows;                  /**< the owner fills rows[0..numRows), */
    MdtKeaMovePair *moves;            /**< and moves[i] of each rows[i] that moves */
    int numRows;
    MdtKeaReport report;     /**< set by MdtKeaSolve */
    struct MdtKeaWork *work; /**< Kea's own */
} MdtKeaSystem;

/** A cache for systems that are solved one after the other. Null when there is no memory. */
MEPUBLIC MdtKeaCache *MEAPI MdtKeaCacheCreate(void);
/** Destroys a cache; null is left alone. */
MEPUBLIC void MEAPI MdtKeaCacheDestroy(MdtKeaCache *cache);

/** Bytes of scratch memory that a system of this size needs (MdtKeaInit). */
MEPUBLIC size_t MEAPI MdtKeaScratchSize(int numBodies, int maxRows, int maxContacts);

/**
 * Lays out the system's arrays in @a scratch, which is aligned to 16 bytes and of MdtKeaScratchSize bytes, and computes
 * poses, velocities and predictions. The bodies are only read. The arrays live as long as the scratch memory. It is
 * called for each part of a step with the same memory, in which contacts keep how they are attached to their bodies.
 */
MEPUBLIC void MEAPI MdtKeaInit(MdtKeaSystem *system, void *scratch);

/**
 * Measures the contacts of the manifolds as this part of the step begins, and writes how many rows each point needs;
 * returns their sum. They are in no row yet: the owner may lower numRows of points. Of the fast solver's nothing is
 * measured, and no rows will be made.
 */
MEPUBLIC int MEAPI MdtKeaCountContactRows(MdtKeaSystem *system);

/** Writes those rows behind the owner's: of each point the normal, then friction. Nothing for the fast solver. */
MEPUBLIC void MEAPI MdtKeaMakeContactRows(MdtKeaSystem *system);

/**
 * Finds the forces of the system's rows, and where the bodies will be with them. Writes rows[i].force, the force of
 * the manifolds' points, and the report.
 * The bodies are only read, so a solve whose report says `violent` can be thrown away and repeated with a shorter step;
 * if it is kept, the position rows are met to first order. The answer is finite and within bounds as long as the rows
 * are finite.
 */
MEPUBLIC void MEAPI MdtKeaSolve(MdtKeaSystem *system);

/**
 * Advances the bodies to the end of the step, with the forces found by MdtKeaSolve. Returns true. Should a state not
 * be finite, in MeReal, or a point's force, no body is changed, and false is returned.
 */
MEPUBLIC MeBool MEAPI MdtKeaIntegrate(MdtKeaSystem *system);

/**
 * Whether there is an impact at the start of the step: a touching contact that approaches (timed systems). The rows are
 * filled; nothing is changed.
 */
MEPUBLIC MeBool MEAPI MdtKeaMeets(const MdtKeaSystem *system);

/**
 * Whether impacts would chatter: touching contacts approach (MdtKeaMeets), but all too slowly to rebound, and no open
 * contact is about to close faster. Events would then follow each other without end. The rows are filled; nothing is
 * changed.
 */
MEPUBLIC MeBool MEAPI MdtKeaTrembles(const MdtKeaSystem *system);

/**
 * Whether a step of the system is reversible: from its end, with velocities negated, a step of the same length returns
 * to the start, but for rounding. True for joints without bounds, targets and compliance, springs without damping that
 * are not too stiff for the midpoint rule, and bodies without damping; gamma is ignored. The rows are filled; nothing
 * is changed.
 */
MEPUBLIC MeBool MEAPI MdtKeaIsReversible(const MdtKeaSystem *system);

/** Whether some body turns too far for the midpoint rule in a step of so many seconds, were nothing in contact. Bodies
 *  are filled. */
MEPUBLIC MeBool MEAPI MdtKeaTurnsTooFar(const MdtKeaSystem *system, double step);

/** Negates the bodies' velocities and angular momenta. Call MdtKeaInit and fill the rows again after it. */
MEPUBLIC void MEAPI MdtKeaReverse(MdtKeaSystem *system);

/**
 * Whether an impact within the step is predicted that rebounds faster than half the change of velocity by loads in a
 * step, and there are no springs. The rows are filled; nothing is changed.
 */
MEPUBLIC MeBool MEAPI MdtKeaBounces(const MdtKeaSystem *system);

/**
 * Whether what joints tie rolls, and so may be timed though nothing bounces: all contacts are those of round surfaces,
 * none of which overlaps by more than what is near, and joints hold without bounds, or drive. Springs and stops need
 * the damping of θ = 1. The rows are filled; nothing is changed.
 */
MEPUBLIC MeBool MEAPI MdtKeaRolls(const MdtKeaSystem *system);

/**
 * The number of bodies with joints or closed contacts; contacts with a gap, or that separate, do not count. The rows
 * are filled; nothing is changed but scratch memory.
 */
MEPUBLIC int MEAPI MdtKeaHeldBodies(const MdtKeaSystem *system);
/**
 * Whether a contact holds its bodies: it touches, and neither parts nor is met so fast that it rebounds.
 *  @param bodies    of which one may be null, the world
 *  @param gap       m, negative where they overlap
 *  @param rate      m/s, at which the gap grows
 *  @param loadSpeed m/s, by which the loads change the bodies' velocities in a step
 */
MEPUBLIC MeBool MEAPI MdtKeaContactHolds(const MdtKeaBody *const bodies[2], double gap, double rate, double restitution,
                                         double loadSpeed);

/** Whether momentum was given to a body as the step begins (MdtKeaBody.kick). */
MEPUBLIC MeBool MEAPI MdtKeaIsKicked(const MdtKeaSystem *system);

/**
 * Adds the momenta that were given to bodies as the step begins, of which rigid joints pass on at once what they hold:
 * their rates stay as they are. Reads the rows of joints; the owner calls MdtKeaInit, and fills the rows, again.
 */
MEPUBLIC void MEAPI MdtKeaKick(MdtKeaSystem *system);

/**
 * An impact at the start of the step: changes the velocities of the bodies so that those that touch part with their
 * restitution times the speed with which they met, waves through rows of bodies and impacts at several points
 * included, never gaining energy. Writes the impulses, N s, into rows[i].force and the points' force, and what it has
 * cost into the report.
 */
MEPUBLIC void MEAPI MdtKeaImpact(MdtKeaSystem *system);

/** Whether no row of a timed system acts before its first event: it has no joints, and all contacts are open. Its rows
 *  are then read for that event alone, and those that were made before an impact will do. */
MEPUBLIC MeBool MEAPI MdtKeaFlies(MdtKeaSystem *system);

/**
 * Moves bodies that fly (MdtKeaFlies) on from impact to impact, each by itself, up to the end of the step or to the
 * first impact after which a contact is closed. Needs the rows of this step, and leaves none; MdtKeaIntegrate follows.
 * Writes the sums of the impulses, N s, into the points' force, and report.work and .impacts.
 * @param least       s, 0 < least < the step's: what counts as no time
 * @param maxImpacts after so many it ends
 * @return s, how far the bodies have come, least at the least; it is then the system's stepsize
 */
MEPUBLIC double MEAPI MdtKeaFly(MdtKeaSystem *system, double least, int maxImpacts);

/** The angular velocity of a body, rad/s, world frame. */
MEPUBLIC void MEAPI MdtKeaBodyGetAngularVelocity(const MdtKeaBody *body, double w[3]);

/** Sets the angular momentum so that the body turns with @a w, rad/s, world frame. */
MEPUBLIC void MEAPI MdtKeaBodySetAngularVelocity(MdtKeaBody *body, const double w[3]);

/**
 * Splits a symmetric inertia tensor (kg m², body frame) into the body's principal moments and axes. Returns false, and
 * leaves the body alone, when the tensor is not finite, not symmetric or not positive definite.
 */
MEPUBLIC MeBool MEAPI MdtKeaBodySetInertia(MdtKeaBody *body, const double inertia[3][3]);

/**
 * Bytes of scratch memory for solving partitions one after the other: the most that one of them needs
 * (User Guide App. C, "Memory Usage in Kea"). @a num_rows_exc_padding holds the rows of each partition; a null array
 * means one partition of @a max_rows. No partition has more than @a max_bodies bodies.
 */
MEPUBLIC int MEAPI MdtKeaMemoryRequired(const int num_rows_exc_padding[], int num_partitions, int max_rows,
                                        int max_bodies);

ME_END_C

#endif
