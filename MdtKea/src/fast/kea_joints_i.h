/* Inside Kea: joints of the fast solver (kea_joints.c). */
#ifndef KEA_JOINTS_I_H
#define KEA_JOINTS_I_H

#include "fast/kea_fast_i.h"

/* A row, with impulses in N s and rates in m/s. */
typedef struct KeaJointRow {
    double J[2][6]; /* copy of the system's row, close in memory to the other data of passes */
    const MdtKeaRow *row;
    int node[2], edge;          /* indices in the block's graph; -1: the world, no edge */
    MeBool isInactive, isRigid; /* the row has no force; displacements remove its position error */
    double length;              /* m per unit of the row's coordinate: 1, or the bodies' size */
    double perSize;             /* of the smaller body's size, per unit of the row's coordinate */
    double perSquare;           /* 1/length²: makes squares of impulses of all rows comparable */
    double invEffectiveMass;    /* J M⁻¹ Jᵀ, 1/kg */
    double weight;              /* kg, rows without bounds: 1 / (E + N) */
    double *response; /* rows with bounds, six numbers by node: S⁻¹ Jᵀ, the block's velocities per unit of impulse */
    double invMassInBlock;                   /* J S⁻¹ Jᵀ, 1/kg; 0: not computed yet */
    double target, compliance, lower, upper; /* m/s; 1/kg; N s */
    double targetError;     /* m, target of the error at the end of the step, without the part due to compliance */
    double jointError;      /* m, the error after motion with the end velocities, which displacements are to remove */
    double residual;        /* m/s or m, the residual in this pass */
    double impulse, before; /* N s, and one pass earlier */
} KeaJointRow;

/* A body with joints. */
typedef struct KeaJointBody {
    int body, motion;       /* index in the system; index of its KeaMotion */
    double inertia[3][3];   /* kg m² (world), with the stiffness added if isStiff */
    MeBool isStiff;         /* the geometric stiffness is not negligible */
    double stiffness[3][3]; /* kg m²: geometric stiffness by its joints' impulses */
    double load, spread;    /* N s: sum of its joints' impulses |P|; N m² s: sum of |P| r², r the arms */
} KeaJointBody;

/* Bodies that joints connect, directly or through others, and their rows: first those that its factor contains, without
 * bounds and, unless it is wide, springs with bounds in both directions; then the others. */
typedef struct KeaJointBlock {
    int firstNode, numNodes;
    int firstRow, firstSpring, firstBounded,
        endRow; /* indices of its first row, of the first of these springs, of the first of the others, and behind its
                   last row */
    KeaFactor *factor;
    char *numbers;     /* memory of the factor's numbers */
    MeBool isMean;     /* rows are those of the middle of the step, and bodies may be moved by mean velocities */
    MeBool isWide;     /* more than KEA_WIDE_BLOCK bodies: rows with bounds act on their own two bodies only */
    MeBool isSound;    /* the factorization has succeeded */
    MeBool isInverted; /* the factor's blocks are inverted */
} KeaJointBlock;

typedef struct KeaJoints {
    int numBlocks, numNodes, numRows; /* of all blocks */
    KeaJointBlock *block;
    KeaJointBody *body;       /* by block */
    KeaJointRow *row;         /* by block */
    double (*x)[6];           /* by block and node: right sides, and solutions */
    double (*v)[6];           /* by block and node: motions or displacements, in double */
    double *errors;           /* by the system's row */
    int *parent, *node, *sum; /* by body: scratch */
    const MdtKeaRow **sorted; /* by block: scratch */
    KeaGraph graph;           /* scratch */
} KeaJoints;

/* Lays out the arrays in `memory`; null: only measures. Returns their bytes. */
size_t kea_jointsLayOut(const MdtKeaSystem *s, KeaJoints *j, char *memory);
/* Sets up and factors the blocks. `place`: by body, its place among motions. For the rest of the solve, rows have the
 * Jacobians of the middle, and the inertia of bodies, in invMass and `predicted`, is that of the predicted end; in
 * blocks of first order it has geometric stiffness added. False: no memory. */
MeBool kea_jointsBegin(MdtKeaSystem *s, const int place[], KeaJoints *j);
/* Whether all blocks have been factored; the joints of others have no force in this step. */
MeBool kea_jointsAreSound(const KeaJoints *j);
/* Multiplications of a pass; of the assembly and factorization of all blocks. */
double kea_jointsWorkOfPass(const KeaJoints *j);
double kea_jointsWorkOfFactors(const KeaJoints *j);
/* Adds M⁻¹ Jᵀ p of all impulses to the motions: the warm start. */
void kea_jointsApplyImpulses(const MdtKeaSystem *s, KeaJoints *j, KeaMotion motion[]);
/* Multiplies all impulses by a share. */
void kea_jointsScaleImpulses(KeaJoints *j, double share);
/* Solves the velocities of each block once, from impulses extrapolated by beta. Returns the criterion of restarts
 * (KeaKernel.pass). */
double kea_jointsSolveVelocities(const MdtKeaSystem *s, KeaJoints *j, KeaMotion motion[], double beta);
/* m/s: the largest violation of the rows' laws. Raises *excess to the largest ratio of a violation to its tolerance. */
double kea_jointsResidual(const KeaJoints *j, const KeaMotion motion[], const KeaTolerance *t, double *excess);
/* Sets the velocities that bodies of first-order blocks are moved by to the end velocities, θ = 1, since their rows are
 * those of the poses at the start. */
void kea_jointsMoveByEnd(const KeaJoints *j, const KeaMotion motion[], KeaMotion move[], float theta[]);
/* The largest error of joints and stops at the start, relative to the smaller body's size. */
double kea_jointsOpening(const KeaJoints *j);
/* Evaluates position errors at the end poses, displacements included. Returns the largest part that is to be corrected,
 * relative to the smaller body's size. */
double kea_jointsFindErrors(MdtKeaSystem *s, KeaJoints *j, const KeaMotion displacement[]);
/* Evaluates the rows' Jacobians at the end poses, and factors the blocks with them. */
void kea_jointsRelinearize(MdtKeaSystem *s, KeaJoints *j, const KeaMotion displacement[]);
/* Factors the blocks again, after the rows' Jacobians have changed. */
void kea_jointsRefactor(const MdtKeaSystem *s, KeaJoints *j);
/* Makes a pass over displacements, which removes position errors. Returns the largest error before it, relative to the
 * smaller body's size. */
double kea_jointsCorrectPositions(const MdtKeaSystem *s, KeaJoints *j, KeaMotion displacement[]);
/* Sets the target of stops that were hit to their rebound. Returns whether there are any. */
MeBool kea_jointsSetRebounds(KeaJoints *j);
/* J: the work that motors, springs and moving worlds do by the impulses; rebounds do none. */
double kea_jointsWorkOfDrives(const KeaJoints *j);
/* Adds the changes of momenta by the impulses, N s and N m s, to `change`, by place. */
void kea_jointsAddImpulses(const KeaJoints *j, double (*change)[6]);
/* Removes the effect of geometric stiffness from the angular momenta at the end. */
void kea_jointsRemoveStiffness(MdtKeaSystem *s, const KeaJoints *j);
/* Sets the angular momenta of bodies in blocks solved at the middle to those of the velocities found, at the end
 * orientations. With the momenta found instead, a thin bar that spins would get a velocity that its joint forbids, by
 * the error of the predicted orientation times I_max / I_min, which grows from step to step (Mst_Order_Joints). */
void kea_jointsSetMomenta(MdtKeaSystem *s, const KeaJoints *j);
/* Writes the forces of the system's rows. */
void kea_jointsReturnForces(MdtKeaSystem *s, const KeaJoints *j);

#endif
