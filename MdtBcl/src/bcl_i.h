/* Inside Bcl: the parts that several joints are made of. */
#ifndef BCL_I_H
#define BCL_I_H

#include "MdtBcl.h"
#include "MdtKeaMath.h"

extern const MdtBclType bcl_bsJoint, bcl_hinge, bcl_contact;

/* Attachment frames at the bodies' centres, primary axis x, second axis y. */
void bcl_resetFrames(MdtBclConstraint *c);

/* A row between the constraint's bodies without Jacobian or target: two-sided, softness ε. */
void bcl_startRow(MdtKeaRow *row, const MdtBclContext *x);

/* Makes a row pull its error back: s = -γ φ / h, checked at the step's end. */
void bcl_aimAtZero(MdtKeaRow *row, const MdtBclContext *x, double error);

/* The rate J v of a row with the given velocities. */
double bcl_rate(const MdtKeaRow *row, const MdtKeaVelocity *const velocity[2]);

/* How much the rate of a row changes in one step without an impact: by gravity and loads, or as it did in the last step,
 * which knows the other constraints. An approach that is no faster is the step's doing, and does not bounce. */
double bcl_ownChange(const MdtKeaRow *row, const MdtBclContext *x);

/* J M⁻¹ Jᵀ of one row: the acceleration per unit force of free bodies. */
double bcl_mobility(const MdtKeaRow *row, const MdtBclContext *x);

/* The vector from a body's centre to its attachment, and the attachment itself, in the world frame. */
void bcl_arm(double arm[3], const MdtBclConstraint *c, int k, const MdtKeaTransformation *pose);
void bcl_attachment(double point[3], const MdtBclConstraint *c, int k, const MdtKeaTransformation *pose);

/* Three rows that hold the two attachments together, and their errors. */
void bcl_pointRows(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[3]);
void bcl_pointErrors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double errors[3]);

/* Limits and motors of a coordinate whose rate is J v (J: of a row of the joint). bcl_limitPrepare takes the
 * coordinate as measured now (without offset) and returns the number of rows; bcl_limitFill writes them. */
int bcl_limitPrepare(MdtBclLimit *limit, const MdtBclContext *x, const MdtKeaRow *coordinate, double measured);
void bcl_limitFill(const MdtBclLimit *limit, const MdtBclContext *x, const MdtKeaRow *coordinate, MdtKeaRow rows[]);
void bcl_limitReadBack(MdtBclLimit *limit, double measured, double rate, const MdtKeaRow rows[]);
MeBool bcl_limitIsMeasured(const MdtBclLimit *limit);

#endif
