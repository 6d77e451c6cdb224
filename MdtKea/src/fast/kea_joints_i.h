/* Inside Kea: joints of the fast solver (kea_joints.c). */
#ifndef KEA_JOINTS_I_H
#define KEA_JOINTS_I_H

#include "fast/kea_fast_i.h"

/* A row, with impulses in N s and rates in m/s. */
typedef struct KeaJointRow {
    double J[2][6]; /* copied from the system's row, to lie with what passes read */
    const MdtKeaRow *row;
    int node[2], edge;          /* of the block's graph; -1: the world; no edge */
    MeBool isInactive, isRigid; /* it is inactive; displacements remove its position error */
    double length;              /* m per unit of the row: 1, or the bodies' size */
    double perSize;             /* of the smaller body's size, per unit of the row */
    double perSquare;           /* 1/length², with which the squares of impulses of all rows are comparable */
    double invEffectiveMass;    /* J M⁻¹ Jᵀ, 1/kg */
    double weight;              /* kg, of a row without bounds: 1 / (E + N) */
    double *response; /* of a row with bounds, by node, six: S⁻¹ Jᵀ, the block's velocities by a unit of impulse */
    double invMassInBlock; /* J S⁻¹ Jᵀ, 1/kg; 0: not computed yet */
    double target, compliance, lower, upper;
    double targetError; /* m, the error that is aimed at for the end, without the compliance's part */
    double jointError;  /* m, the error with the end's velocities, which displacements are to remove */
    double residual;    /* m/s or m, the residual in this pass */
    double impulse, before;
} KeaJointRow;

/* A body that joints hold. */
typedef struct KeaJointBody {
    int body, motion;
    double inertia[3][3]; /* kg m² (world), with the stiffness added if isStiff */
    MeBool isStiff;
    double stiffness[3][3]; /* kg m²: geometric, of its joints' impulses */
} KeaJointBody;

/* Bodies that joints tie together, directly or through others, and their rows: those without bounds first. */
typedef struct KeaJointBlock {
    int firstNode, numNodes, firstRow, numRows, numTied;
    KeaFactor *factor;
    char *numbers;     /* the factor's */
    MeBool isWide;     /* of more than KEA_WIDE_BLOCK bodies: rows with bounds act on their own two only */
    MeBool isSound;    /* it has been factorized, */
    MeBool isInverted; /* and the factor's blocks are inverted */
} KeaJointBlock;

typedef struct KeaJoints {
    int numBlocks;
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

/* Bytes of the arrays; with memory, lays them out. */
size_t kea_jointsLayOut(const MdtKeaSystem *s, KeaJoints *j, char *memory);
/* `place`: of bodies, among motions. Adds geometric stiffness to the inertia of bodies, in invMass and `predicted`,
 * from here to the end of the solve. False: no memory. */
MeBool kea_jointsBegin(MdtKeaSystem *s, const int place[], KeaJoints *j);
/* Whether every block could be factorized; the joints of others have no force. */
MeBool kea_jointsAreSound(const KeaJoints *j);
/* Multiplications of a pass; of assembly and factorization. */
double kea_jointsWorkOfPass(const KeaJoints *j);
double kea_jointsWorkBeside(const KeaJoints *j);
/* Adds M⁻¹ Jᵀ p, of all impulses, to the motions: the warm start. */
void kea_jointsApply(const MdtKeaSystem *s, KeaJoints *j, KeaMotion motion[]);
/* Multiplies all impulses by a share. */
void kea_jointsScale(KeaJoints *j, double share);
/* A pass over velocities, from impulses extrapolated by beta; returns the criterion of restarts (KeaKernel.pass). */
double kea_jointsPass(const MdtKeaSystem *s, KeaJoints *j, KeaMotion motion[], double beta);
/* m/s, the largest violation of the rows' laws. */
double kea_jointsResidual(const KeaJoints *j, const KeaMotion motion[], const KeaTolerance *t, double *excess);
/* Bodies that joints hold are moved by the end's velocities, θ = 1: their rows are those of the start's poses. */
void kea_jointsMoveByEnd(const KeaJoints *j, const KeaMotion motion[], KeaMotion move[], float theta[]);
/* How far joints are open at the start, of a body's size. */
double kea_jointsOpening(const KeaJoints *j);
/* Evaluates position errors at the end's poses, displacements included; returns the largest, of a body's size. */
double kea_jointsAdvance(MdtKeaSystem *s, KeaJoints *j, const KeaMotion displacement[]);
/* Evaluates the rows' Jacobians there, and factorizes with them. */
void kea_jointsTurn(MdtKeaSystem *s, KeaJoints *j, const KeaMotion displacement[]);
/* Factorizes again, after the rows' Jacobians have changed. */
void kea_jointsRefill(const MdtKeaSystem *s, KeaJoints *j);
/* A pass over displacements, which removes position errors. Returns the largest that there was, as
 * kea_jointsAdvance. */
double kea_jointsPush(const MdtKeaSystem *s, KeaJoints *j, KeaMotion displacement[]);
/* Makes the rebound the target of stops that were hit; whether there are any. */
MeBool kea_jointsRebound(KeaJoints *j);
/* J, the work that motors, springs and worlds that move do by the impulses; a rebound does none. */
double kea_jointsWork(const KeaJoints *j);
/* Adds what the impulses change momenta by, N s and N m s, to `change`, by place. */
void kea_jointsAddImpulses(const KeaJoints *j, double (*change)[6]);
/* Takes the part of geometric stiffness out of the end's angular momenta, once they are found. */
void kea_jointsSetMomenta(MdtKeaSystem *s, const KeaJoints *j);
/* Writes the forces of the system's rows. */
void kea_jointsReturn(MdtKeaSystem *s, const KeaJoints *j);

#endif
