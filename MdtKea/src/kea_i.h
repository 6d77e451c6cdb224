/* Inside Kea: the working data of a system and the functions that its files share. */
#ifndef KEA_I_H
#define KEA_I_H

#include "MdtKea.h"
#include "MdtKeaMath.h"
#include "kea_mlcp_i.h"

/* The state of a body at the end of the step, while the step is being found. */
typedef struct KeaEnd {
    double position[3], quaternion[4], velocity[3], angularMomentum[3];
} KeaEnd;

typedef struct MdtKeaWork {
    double (*freeMomentum)[3];     /* by body: angular momentum at the end without constraints */
    double (*freeVelocity)[3];     /* by body: velocity at the end without constraints */
    KeaEnd *end;                   /* by body */
    MdtKeaTransformation *endPose; /* by body */
    MdtKeaJBlockPair *response;    /* by row: M⁻¹ Jᵀ, the acceleration per unit of the row's force */
    double *freeRate;              /* by row: J v*, m/s */
    double *shift;                 /* by row: what the nonlinear correction adds to the target, m/s */
    double *errors;                /* by row: φ at the end */
    double *matrix;                /* rows x rows: A */
    KeaMlcp mlcp;
} MdtKeaWork;

/* The orientation q1 after h seconds of free rotation from q0 with the angular momentum L (world, constant). */
void kea_rotateFree(const MdtKeaBody *body, const double q0[4], const double L[3], double h, double q1[4]);

/* The angular velocity (world) of a body at orientation q with angular momentum L, and the other way round. */
void kea_angularVelocity(const MdtKeaBody *body, const double q[4], const double L[3], double w[3]);
void kea_angularMomentum(const MdtKeaBody *body, const double q[4], const double w[3], double L[3]);

/* The inverse inertia tensor in world axes at orientation q. */
void kea_inverseInertia(const MdtKeaBody *body, const double q[4], double inverse[3][3]);

/* Fills response, freeRate and matrix from the rows. */
void kea_assemble(MdtKeaSystem *system);

/* Friction (kea_friction.c): the bounds of the first solve; new ones from its answer. Returns whether one moved that
 * matters. */
double kea_firstFrictionBound(const MdtKeaSystem *system, const MdtKeaRow *row);
MeBool kea_renewFriction(MdtKeaSystem *system);

/* The velocity that row i is left with against its target, m/s: zero where the force is free. */
double kea_slip(const MdtKeaSystem *system, int i);

/* Gives the rows that are springs their targets and softnesses; after kea_assemble. */
void kea_makeSprings(MdtKeaSystem *system);

/* Where the bodies end with the forces now in rows[].force: work->end and work->endPose. */
void kea_moveWithForces(MdtKeaSystem *system);

#endif
