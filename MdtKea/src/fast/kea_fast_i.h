/* Inside Kea: the fast solver's data.
 *
 *     kea_fast.c          a step: groups of manifolds, passes for velocities, for positions, for rebounds; end states
 *     kea_regions.c       division of bodies into regions, and parallel loops over these
 *     kea_colour.c        graph colouring: groups of eight manifolds that share no body
 *     kea_gather.c        copies manifolds into groups, and forces back
 *     kea_lanes_i.h       eight floats at a time
 *     kea_kernel_i.h      the operations on groups, eight manifolds at a time
 *     kea_kernel.c, kea_kernel_avx2.c      the same, compiled for two widths of registers
 *
 * A manifold is solved as a block. With the centre c, the normal n, t1 along the primary direction, and t2 = n x t1,
 * its points are c + x t1 + y t2, and their velocities along n are
 *
 *     u_0 + x u_1 + y u_2,     u = (n·dv, -t2·dw, t1·dw),     dv, dw: of the first body relative to the second at c
 *
 * a system of rank 3 for any number of points. Impulses, N s, act on the first body; positive ones separate the bodies.
 */
#ifndef KEA_FAST_I_H
#define KEA_FAST_I_H

#include "kea_i.h"

/* Eight floats, one for each of eight manifolds (kea_lanes_i.h). */
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

/* A manifold's centre, at which friction acts, and its points' coordinates along t1 and t2. */
typedef struct KeaPatch {
    double centre[3], x[KEA_POINTS], y[KEA_POINTS]; /* m */
    double axis[3][3]; /* primary and secondary direction, normal, in the mean of the step */
    double arm[2][3];  /* m, lever arms from the bodies' centres to the centre, in the mean of the step */
    double added[3];   /* m/s, the rates at the end less those with these arms */
    double turned[3];  /* those along each axis at the end less those along its mean */
} KeaPatch;

/* Of a system with locked axes, by body: 1 along free translations, 0 along locked ones. */
typedef struct KeaLocks {
    KeaLanes3 free[2];
} KeaLocks;

/* Eight manifolds. Passes over velocities write the fields after `pass` only. In unused lanes both bodies are the
 * world. */
typedef struct KeaGroup {
    /* kea_colour.c */
    int manifold[KEA_LANES]; /* index of the system's manifold; -1: unused lane */
    int points;              /* maximal number of points of a manifold */
    /* kea_gather.c */
    int resistsRotation;    /* some manifold has rolling or spinning friction */
    int body[2][KEA_LANES]; /* index in arrays of KeaMotion: 0 for the world, else 1 + place of the body */
    KeaLocks *locks;        /* null: no body of the system has locked axes */
    KeaLanes3 normal, along, arm[2];
    KeaLanes invMass[2], invInertia[2][6];
    KeaLanes x[KEA_POINTS], y[KEA_POINTS]; /* m */
    KeaLanes size;                         /* m, of the smaller body */
    KeaLanes pressed;                      /* m, by how much the mean motion may press it deeper */
    KeaLanes gap[KEA_POINTS];              /* m; negative: overlap */
    KeaLanes slop[KEA_POINTS];             /* m, overlap that is not corrected: sag by epsilon, and rounding */
    KeaLanes bias[KEA_POINTS];             /* m/s, the lower bound of normal velocities */
    KeaLanes rebound[KEA_POINTS];          /* m/s, by restitution: bias of pushing points in a second solve; 0: none */
    KeaLanes compliance;                   /* 1/kg, of soft contacts; 0: rigid */
    KeaLanes correction; /* fraction of an overlap that a pass over displacements removes; 0: soft contact */
    KeaLanes min;        /* N s, the lower bound of normal impulses: 0, or minus adhesion */
    KeaLanes coefficient[2], bound[2];        /* friction: coefficient, and constant bound, N s */
    KeaLanes slip[2], slide[2];               /* friction: compliance, 1/kg; target velocity, m/s */
    KeaLanes lever[KEA_POINTS], torsionBound; /* friction about n: lever of a point, m; constant bound, N m s */
    KeaLanes rolling, spinning;               /* m, friction against rotation: bounds of torques over the load */
    KeaMask isPoint[KEA_POINTS], isCone, isOneWay;
    /* prepare */
    KeaLanes coupling[10]; /* 1/kg, matrix J M⁻¹ Jᵀ + E of the points' normals: rows of the upper triangle */
    KeaLanes response[KEA_POINTS]; /* kg, the inverses of its diagonal entries */
    KeaLanes direct[10];           /* kg, its inverse, or pseudo-inverse */
    KeaMask isDirect;              /* `direct` is well conditioned */
    KeaLanes frictionMass[3],
        torsionMass; /* effective masses of friction: kg, along t1, t2: 11 12 22; kg m², about n */
    /* blocks of the coupling J_f M⁻¹ J_nᵀ: changes of the rates along t1, t2, and about n by the sum of normal impulses
     * and their moments Σ x p, Σ y p; and of the rates along t1, t2 by friction about n */
    KeaLanes toSlide[2][3], toSpin[3], torsionToSlide[2];
    /* pass */
    KeaLanes impulse[KEA_POINTS], before[KEA_POINTS];      /* N s, normal; and one pass earlier */
    KeaLanes frictionImpulse[2], frictionImpulseBefore[2]; /* N s, friction along t1 and t2, at the centre */
    KeaLanes torsionImpulse, torsionImpulseBefore;         /* N m s, friction about n */
    KeaLanes rollingImpulse[2], rollingImpulseBefore[2];   /* N m s, rolling friction about t1 and t2 */
} KeaGroup;

/* Residuals after passes, by lane. max: the largest violation of the laws of contact, m/s; excess: the largest ratio of
 * a contact's violation to its tolerance (KeaTolerance); excessSquares: the sum of the squares of these ratios;
 * squares: the sum of the squared violations of all rows, (m/s)²; closing: the largest speed at which a deep overlap
 * grows, m/s (kea_smallOverlap). */
typedef struct KeaMeasure {
    KeaLanes max, excess, excessSquares, squares, closing;
} KeaMeasure;

/* The residual that a contact of two bodies may leave, m/s:
 *
 *     min((accuracy + kea_changeShare Δv) / max(1, P / (m_light (loadSpeed + Δv)), m_heavy / m_light),
 *         kea_restingDepth size / h)
 *
 * In a stack the errors of contacts add up, and a light body under a heavy one moves by the error of the heavy body's
 * load. Δv is the larger change of velocity of both bodies in the step, P the sum of the contact's normal impulses. */
typedef struct KeaTolerance {
    const float *change;       /* m/s, Δv by index of KeaMotion */
    float accuracy, loadSpeed; /* m/s */
    float stepsize;            /* s */
} KeaTolerance;

/* The operations on groups, in the order of a step, for one width of registers. */
typedef struct KeaKernel {
    /* Computes effective masses and couplings from what kea_fillGroups has written. */
    void (*prepare)(KeaGroup groups[], int count, float stepsize);
    /* Adds M⁻¹ Jᵀ p of all impulses to the motions: the warm start. */
    void (*apply)(const KeaGroup groups[], int count, KeaMotion motion[]);
    /* motion += beta (motion - before); before := the old motion. */
    void (*extrapolate)(KeaMotion motion[], KeaMotion before[], int count, float beta);
    /* Makes one pass over velocities, from impulses extrapolated by beta. Adds the criterion of restarts to `uphill`,
     * by lane: (guess - next)·(next - last), which is positive if extrapolation went too far. */
    void (*pass)(KeaGroup groups[], int count, KeaMotion motion[], float beta, float uphill[KEA_LANES]);
    /* If the velocities `move`, which bodies are to be moved by, press a contact deeper than `motion` by more than
     * kea_pressedDepth, sets `move` of its bodies to `motion`, and theta to 1. Returns whether any was changed. */
    MeBool (*choosePressed)(const KeaGroup groups[], int count, const KeaMotion motion[], float stepsize,
                            KeaMotion move[], float theta[]);
    /* Advances the gaps to the end of a step with these velocities. */
    void (*advance)(KeaGroup groups[], int count, const KeaMotion motion[], float stepsize);
    /* Makes one pass over displacements, which reduces overlaps. Returns whether a contact moved its bodies far enough
     * to open a joint. */
    MeBool (*push)(const KeaGroup groups[], int count, KeaMotion motion[]);
    /* Adds the residuals of these groups to `measure`. */
    void (*measure)(const KeaGroup groups[], int count, const KeaMotion motion[], const KeaTolerance *tolerance,
                    KeaMeasure *measure);
} KeaKernel;

extern const KeaKernel kea_kernel;
#ifdef KEA_HAS_AVX2
extern const KeaKernel kea_kernelAvx2;
#endif

/* ---- kea_gather.c ---- */

/* The arrays of a step that groups are filled from. */
typedef struct KeaGathering {
    const MdtKeaSystem *s;
    const int *place;                 /* by body */
    KeaPatch *patch;                  /* by manifold; written by kea_fillGroups */
    KeaMotion *motion, *displacement; /* by 1 + place; entries of moving worlds are written by kea_fillGroups */
} KeaGathering;

/* Fills groups from the manifolds chosen for their lanes. A moving world has a motion of its own for each manifold,
 * behind those of the bodies, and displacement 0. */
void kea_fillGroups(const KeaGathering *from, KeaGroup groups[], int count);
/* Sets lever arms anew for the motion that passes have found. Returns by how much rates have changed, m/s. */
double kea_renewArms(const KeaGathering *from, KeaGroup groups[], int count);
/* Sets inertia anew, after a change of invMass. The kernel then has to prepare. */
void kea_renewInertia(const KeaGathering *from, KeaGroup groups[], int count);
/* Adds the changes of momenta by the groups' impulses, N s and N m s, to `change`, by place. */
void kea_addImpulses(const KeaGathering *from, const KeaGroup groups[], int count, double (*change)[6]);
/* J: the work that moving worlds and surfaces, and the correction of overlaps of soft contacts, do by the groups'
 * impulses: each impulse times its target velocity. */
double kea_workOfSurfaces(const KeaGathering *from, const KeaGroup groups[], int count);
/* Multiplies all impulses by a share; 0 also clears impulses that are not finite. */
void kea_scaleImpulses(KeaGroup groups[], int count, float share);
/* Writes the forces of the manifolds' points. */
void kea_returnManifolds(const KeaGathering *from, const KeaGroup groups[], int count);

/* ---- kea_fast.c ---- */

/* Finds the forces of the system's manifolds and rows, and the end states of the bodies. */
void kea_fastSolve(MdtKeaSystem *s);

#endif
