/* Inside Kea: joints of the fast solver (kea_joints.c). */
#ifndef KEA_JOINTS_I_H
#define KEA_JOINTS_I_H

#include "fast/kea_fast_i.h"

/* A row, in N s and m/s. */
typedef struct KeaJointRow {
    const MdtKeaRow *row;
    int node[2], edge;    /* of the block; -1: the world; none */
    MeBool isOff, isHeld; /* it does nothing; its error is taken away by displacements */
    double length;        /* m per unit of the row: 1, or the bodies' size */
    double size;          /* J M⁻¹ Jᵀ, 1/kg */
    double weight;        /* kg, of a row without bounds: 1 / (E + N) */
    double *response;     /* of a row with bounds, by node, six: what the block does for a unit of impulse; */
    double blockSize;     /* J response; 0: not found yet */
    double target, compliance, lower, upper;
    double wanted;  /* m, the error at the end, but for what the compliance adds */
    double gap;     /* m, what the velocities leave to displacements */
    double missing; /* m/s or m, in this pass */
    double impulse, before;
} KeaJointRow;

/* A body that joints hold. */
typedef struct KeaJointBody {
    int body, motion;
    double inertia[3][3]; /* kg m² (world), with the stiffness if */
    MeBool isStiff;
    double stiffness[3][3]; /* kg m²: geometric, of its joints' impulses */
} KeaJointBody;

/* Bodies that joints tie together, directly or through others, and their rows: those without bounds first. */
typedef struct KeaJointBlock {
    int firstNode, numNodes, firstRow, numRows, numTied;
    KeaFactor *factor;
    char *numbers;  /* the factor's */
    MeBool isWide;  /* of so many bodies that rows with bounds act on their own two only */
    MeBool isSound; /* the factor is there */
} KeaJointBlock;

typedef struct KeaJoints {
    int numBlocks;
    KeaJointBlock *block;
    KeaJointBody *body;       /* by block */
    KeaJointRow *row;         /* by block */
    double (*x)[6];           /* by block and node: what a pass asks for, and what it gives */
    double *errors;           /* by the system's row */
    int *parent, *node, *sum; /* by body: scratch */
    const MdtKeaRow **sorted; /* by block: scratch */
    KeaGraph graph;           /* scratch */
} KeaJoints;

/* Bytes of the arrays; with memory, lays them out. */
size_t kea_jointsLayOut(const MdtKeaSystem *s, KeaJoints *j, char *memory);
/* By body, its place among motions. What turns under load has more inertia from here on, and is predicted to turn less.
 * False: no memory. */
MeBool kea_jointsBegin(MdtKeaSystem *s, const int place[], KeaJoints *j);
/* Has every block its factor? Joints of others do nothing. */
MeBool kea_jointsAreSound(const KeaJoints *j);
/* Multiplications of a pass; of getting ready. */
double kea_jointsWorkOfPass(const KeaJoints *j);
double kea_jointsWorkBeside(const KeaJoints *j);
/* Adds what the impulses do to the bodies. */
void kea_jointsApply(const MdtKeaSystem *s, KeaJoints *j, KeaMotion motion[]);
/* Takes a share of all impulses. */
void kea_jointsScale(KeaJoints *j, double share);
/* A pass over velocities; returns how much goes against the extrapolation by beta. */
double kea_jointsPass(const MdtKeaSystem *s, KeaJoints *j, KeaMotion motion[], double beta);
/* m/s */
double kea_jointsResidual(const KeaJoints *j, const KeaMotion motion[]);
/* Errors at the bodies' ends as they are now, displacements included; returns the largest, of a body's size. */
double kea_jointsAdvance(MdtKeaSystem *s, KeaJoints *j, const KeaMotion way[]);
/* Their derivatives there. */
void kea_jointsTurn(MdtKeaSystem *s, KeaJoints *j, const KeaMotion way[]);
/* The rows' Jacobians are others now. */
void kea_jointsRefill(const MdtKeaSystem *s, KeaJoints *j);
/* A pass over displacements. */
void kea_jointsPush(const MdtKeaSystem *s, KeaJoints *j, KeaMotion way[]);
/* Stops that were hit part with their rebound; whether there are any. */
MeBool kea_jointsRebound(KeaJoints *j);
/* What the rows do to momenta, by place. */
void kea_jointsAddImpulses(const KeaJoints *j, double (*change)[6]);
/* What stiffness does to the momenta at the end, once they are found. */
void kea_jointsSetMomenta(MdtKeaSystem *s, const KeaJoints *j);
void kea_jointsReturn(MdtKeaSystem *s, const KeaJoints *j);

#endif
