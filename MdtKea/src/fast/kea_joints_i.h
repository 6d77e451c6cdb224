/* Inside Kea: joints of the fast solver (kea_joints.c). */
#ifndef KEA_JOINTS_I_H
#define KEA_JOINTS_I_H

#include "fast/kea_fast_i.h"

/* A row, in N s and m/s. */
typedef struct KeaJointRow {
    int index;     /* of the system's row */
    int motion[2]; /* by side; 0: the world */
    MeBool isOff, isBounded;
    MeBool isHeld;         /* its error is taken away by displacements */
    double response[2][6]; /* M⁻¹ Jᵀ, by side */
    double size;           /* J M⁻¹ Jᵀ */
    double target, compliance, lower, upper;
    double wanted; /* m, the error at the end, but for what the compliance adds */
    double gap;    /* m, what the velocities leave to displacements */
    double impulse, before;
} KeaJointRow;

/* The rows of bodies that are tied together; those without bounds first. */
typedef struct KeaJointBlock {
    int first, count, numFree;
    double *factor; /* of those without bounds: numFree by numFree, the lower triangle */
} KeaJointBlock;

typedef struct KeaJoints {
    int numBlocks;
    int *parent, *count; /* by body: scratch */
    KeaJointRow *row;    /* by block */
    KeaJointBlock *block;
    double *x, *errors; /* by row */
} KeaJoints;

/* Bytes of the arrays; with memory, lays them out. */
size_t kea_jointsLayOut(const MdtKeaSystem *s, KeaJoints *j, char *memory);
/* By body, its place among motions. False: no memory. */
MeBool kea_jointsBegin(MdtKeaSystem *s, const int place[], KeaJoints *j);
/* The rows' Jacobians are others now. */
void kea_jointsRefill(const MdtKeaSystem *s, KeaJoints *j);
/* Adds what the impulses do to the bodies. */
void kea_jointsApply(const MdtKeaSystem *s, const KeaJoints *j, KeaMotion motion[]);
/* A pass over velocities; returns how much goes against the extrapolation by beta. */
double kea_jointsPass(const MdtKeaSystem *s, KeaJoints *j, KeaMotion motion[], double beta);
/* m/s */
double kea_jointsResidual(const MdtKeaSystem *s, const KeaJoints *j, const KeaMotion motion[]);
/* Errors at the bodies' ends as they are now, displacements included; a pass over displacements. */
void kea_jointsAdvance(MdtKeaSystem *s, KeaJoints *j, const KeaMotion way[]);
void kea_jointsPush(const MdtKeaSystem *s, KeaJoints *j, KeaMotion way[]);
/* Stops that were hit part with their rebound; whether there are any. */
MeBool kea_jointsRebound(const MdtKeaSystem *s, KeaJoints *j);
/* What the rows do to momenta, by place. */
void kea_jointsAddImpulses(const MdtKeaSystem *s, const KeaJoints *j, double (*change)[6]);
void kea_jointsReturn(MdtKeaSystem *s, const KeaJoints *j);

#endif
