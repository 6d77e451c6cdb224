/* Inside Kea: the fast solver's data.
 *
 *     kea_fast.c          a step: groups of manifolds, passes for velocities, for positions, for rebounds; the end
 *     kea_regions.c       bodies in regions, and loops over these, on several threads
 *     kea_colour.c        manifolds that share no body, in groups of eight
 *     kea_gather.c        copies manifolds into groups, and forces back
 *     kea_lanes_i.h       eight floats at a time
 *     kea_kernel_i.h      the operations on groups, eight manifolds at a time
 *     kea_kernel.c, kea_kernel_avx2.c      the same, compiled for two widths of registers
 *
 * A manifold is solved as a whole. About its centre c, with the normal n, t1 along the primary direction, and
 * t2 = n x t1, its points are c + x t1 + y t2, and the velocities along n of all of them are
 *
 *     u_0 + x u_1 + y u_2,     u = (n·dv, -t2·dw, t1·dw),     dv, dw: of the first body against the second at c
 *
 * a system of rank 3 whatever their number. Impulses are in N s, on the first body, positive where they push apart.
 */
#ifndef KEA_FAST_I_H
#define KEA_FAST_I_H

#include "kea_i.h"

/* Eight floats, one of each of eight manifolds (kea_lanes_i.h). */
enum { KEA_LANES = 8 };
typedef float KeaLanes __attribute__((vector_size(4 * 8)));
typedef int KeaMask __attribute__((vector_size(4 * 8))); /* by lane: 0, or -1 for true */

typedef struct KeaLanes3 {
    KeaLanes x, y, z;
} KeaLanes3;

enum { KEA_POINTS = MdtKeaMANIFOLDPOINTS };

/* A body's velocity, m/s and rad/s, or its displacement, m and rad. */
typedef struct KeaMotion {
    _Alignas(16) float lin[4];
    float ang[4];
} KeaMotion;

/* A manifold's centre, and its points along t1 and t2. */
typedef struct KeaPatch {
    double centre[3], across[3], x[KEA_POINTS], y[KEA_POINTS]; /* m; across: t2 */
    double arm[2][3]; /* m, from the bodies to the centre, the mean of the start and the end of the step */
} KeaPatch;

/* Eight manifolds. Passes over velocities write the last fields only. Lanes that are not in use have the world as
 * both bodies. */
typedef struct KeaGroup {
    /* kea_colour.c */
    int manifold[KEA_LANES]; /* -1: the lane is not in use */
    int points;              /* of a manifold, at most */
    /* kea_gather.c */
    int body[2][KEA_LANES]; /* of KeaMotions: 0 is the world, the others 1 + their place */
    KeaLanes3 normal, along, arm[2];
    KeaLanes invMass[2], invInertia[2][6];
    KeaLanes x[KEA_POINTS], y[KEA_POINTS]; /* m */
    KeaLanes size;                         /* m, of the smaller body */
    KeaLanes gap[KEA_POINTS];              /* m; negative: overlap */
    KeaLanes slop[KEA_POINTS];             /* m, overlap that is allowed: epsilon under load, and rounding */
    KeaLanes bias[KEA_POINTS];             /* m/s, the lower bound of normal velocities */
    KeaLanes rebound[KEA_POINTS]; /* m/s, by restitution: the bias of points that push, in a second solve; 0: none */
    KeaLanes compliance;          /* 1/kg, of soft contacts */
    KeaLanes correction;          /* the share of an overlap that one pass over displacements removes */
    KeaLanes min;                 /* N s, the lower bound of normal impulses: 0, or minus adhesion */
    KeaLanes coefficient[2], bound[2];        /* of friction: of the normal impulse, and N s */
    KeaLanes slip[2], slide[2];               /* 1/kg, compliance of friction; m/s, velocity of the surface */
    KeaLanes lever[KEA_POINTS], torsionBound; /* m, N m s: of friction's moment about n */
    KeaMask isPoint[KEA_POINTS], isCone, isOneWay;
    /* prepare */
    KeaLanes coupling[10];         /* 1/kg, J M⁻¹ Jᵀ + E of the points' normals: the rows of its upper triangle */
    KeaLanes response[KEA_POINTS]; /* kg, the inverse of its diagonal */
    KeaLanes direct[10];           /* kg, its inverse, or pseudo-inverse */
    KeaMask isDirect;              /* that is well enough conditioned */
    KeaLanes frictionMass[3], torsionMass; /* kg, of friction along t1 and t2: 11 12 22; kg m², about n */
    /* the same of the coupling J_f M⁻¹ J_nᵀ: rates along t1, t2, and about n, by the sum of normal impulses and their
     * moments Σ x p, Σ y p; and along t1, t2 by friction about n */
    KeaLanes toSlide[2][3], toSpin[3], torsionToSlide[2];
    /* pass */
    KeaLanes impulse[KEA_POINTS], before[KEA_POINTS];      /* N s, and one pass earlier */
    KeaLanes frictionImpulse[2], frictionImpulseBefore[2]; /* of friction: along t1 and t2, at the centre */
    KeaLanes torsionImpulse, torsionImpulseBefore;         /* N m s, about n */
} KeaGroup;

/* What is left after passes, by lane: m/s, the residual, which is the largest violation of the laws of contact; the
 * same in tolerances (KeaTolerance), each contact's own, and the sum of the squares of all; (m/s)², the sum of the
 * squares of all rows; m/s, the largest speed at which deep overlaps grow (kea_smallOverlap). */
typedef struct KeaMeasure {
    float max[KEA_LANES], excess[KEA_LANES], excessSquares[KEA_LANES], squares[KEA_LANES], closing[KEA_LANES];
} KeaMeasure;

/* The residual that a contact of two bodies may leave, m/s:
 *
 *     min((accuracy + kea_changeShare Δv) / max(1, P / (m_light (loadSpeed + Δv)), m_heavy / m_light),
 *         kea_stepShare size / h)
 *
 * In a stack the contacts' errors add up, and a light body under a heavy one moves by the error of the latter's load.
 * Δv is the larger change of velocity of the two in the step, P the sum of the contact's normal impulses. */
typedef struct KeaTolerance {
    const float *change;       /* m/s, Δv by motion */
    float accuracy, loadSpeed; /* m/s */
    float stepsize;            /* s */
} KeaTolerance;

/* What passes over groups do, in their order, for one width of registers. */
typedef struct KeaKernel {
    /* Effective masses, from what kea_fillGroups has written. */
    void (*prepare)(KeaGroup groups[], int count, float stepsize);
    /* Adds M⁻¹ Jᵀ p, of all impulses, to the motions: the warm start. */
    void (*apply)(const KeaGroup groups[], int count, KeaMotion motion[]);
    /* motion += beta (motion - before), and before becomes what motion was. */
    void (*extrapolate)(KeaMotion motion[], KeaMotion before[], int count, float beta);
    /* One pass over velocities, from impulses extrapolated by beta. Adds to `uphill`, by lane, (guess - next)·(next -
     * last), which is positive where extrapolation went too far: the criterion of restarts. */
    void (*pass)(KeaGroup groups[], int count, KeaMotion motion[], float beta, float uphill[KEA_LANES]);
    /* Bodies that are moved by `move` become such as are moved by `motion`, with theta 1, where the former presses a
     * contact deeper by more than kea_pressedDepth. Whether there are new ones. */
    MeBool (*choosePressed)(const KeaGroup groups[], int count, const KeaMotion motion[], float stepsize,
                            KeaMotion move[], float theta[]);
    /* Turns gaps into those at the end of a step with these velocities. */
    void (*advance)(KeaGroup groups[], int count, const KeaMotion motion[], float stepsize);
    /* One pass over displacements, which reduces overlaps; whether one moves far enough to open a joint. */
    MeBool (*push)(const KeaGroup groups[], int count, KeaMotion motion[]);
    /* Adds what these groups leave. */
    void (*measure)(const KeaGroup groups[], int count, const KeaMotion motion[], const KeaTolerance *tolerance,
                    KeaMeasure *measure);
} KeaKernel;

extern const KeaKernel kea_kernel;
#ifdef KEA_HAS_AVX2
extern const KeaKernel kea_kernelAvx2;
#endif

/* ---- kea_gather.c ---- */

/* The step that groups are filled from. */
typedef struct KeaGathering {
    const MdtKeaSystem *s;
    const int *place;                 /* by body */
    KeaPatch *patch;                  /* by manifold; written by kea_fillGroups */
    KeaMotion *motion, *displacement; /* of worlds that move, see kea_fillGroups */
} KeaGathering;

/* Fills groups, whose manifolds are chosen. A world that moves has a motion of its own for each manifold, behind the
 * bodies', without displacement. */
void kea_fillGroups(const KeaGathering *from, KeaGroup groups[], int count);
/* Adds what the groups' impulses change momenta by, N s and N m s, to `change`, by place. */
void kea_addImpulses(const KeaGathering *from, const KeaGroup groups[], int count, double (*change)[6]);
/* J, the work that what drives the groups' bodies does by their impulses: each times the velocity that it is for. */
double kea_workOfSurfaces(const KeaGathering *from, const KeaGroup groups[], int count);
/* Multiplies all impulses by a share; by 0 also such as are not finite. */
void kea_scaleImpulses(KeaGroup groups[], int count, float share);
/* Writes the forces of the manifolds' points. */
void kea_returnManifolds(const KeaGathering *from, const KeaGroup groups[], int count);

/* ---- kea_fast.c ---- */

/* Finds the forces of the system's manifolds and rows, and the bodies' state at the end. */
void kea_fastSolve(MdtKeaSystem *s);

#endif
