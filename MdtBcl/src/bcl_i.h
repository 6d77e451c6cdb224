/* Inside Bcl: rows, errors and limits that several joints are made of. */
#ifndef BCL_I_H
#define BCL_I_H

#include "MdtBcl.h"
#include "MdtKeaMath.h"
#include "MeAssert.h"
#include "MeMath.h"

extern const MdtBclType bcl_bsJoint, bcl_hinge, bcl_prismatic, bcl_carWheel, bcl_contact, bcl_contactGroup,
    bcl_fixedPath, bcl_rproJoint, bcl_universal, bcl_skeletal, bcl_linear1, bcl_linear2, bcl_angular3, bcl_spring6,
    bcl_spring, bcl_coneLimit, bcl_user, bcl_fpfoJoint;

/* Axes whose angle has a smaller sine count as parallel: their cross product has no direction. */
#define BCL_PARALLEL 1e-6

/* Attachment frames at the bodies' centres, primary axis x, second axis y. */
void bcl_resetFrames(MdtBclConstraint *c);

/* A row between the constraint's bodies without Jacobian or target: two-sided, softness ε. */
void bcl_startRow(MdtKeaRow *row, const MdtBclContext *x);

/* Makes a row a position row: its target s = -γ φ / h corrects the part γ of the error φ (Baumgarte), met at the step's
 * end. */
void bcl_aimAtZero(MdtKeaRow *row, const MdtBclContext *x, double error);

/* Invariants of rows, for any values that a program writes into public parameters (which may make errors and targets
 * infinite): Jacobians are finite, bounds leave room for a force, no compliance, spring or friction feeds energy. */
MeBool bcl_areRows(const MdtKeaRow rows[], int count);

/* Invariants of the setters: a vector has length 1; a frame's two axes have, and are orthogonal. */
MeBool bcl_isUnit(const double d[3]);
MeBool bcl_isFrame(const MdtBclFrame *frame);

/* The rate J v of a row with the given velocities. */
double bcl_rate(const MdtKeaRow *row, const MdtKeaVelocity *const velocity[2]);

/* Makes a row a damped spring with this error. */
void bcl_makeSpring(MdtKeaRow *row, double error, double stiffness, double damping);

/* Makes a row a motor, or a brake: J v = velocity with |λ| <= force. Without ε: on a velocity row it would act as
 * viscosity, and a brake would creep under load. */
void bcl_makeMotor(MdtKeaRow *row, MeReal velocity, MeReal force);

/* Whether stiffness and damping describe a spring: infinite ones mean a rigid joint or a hard stop. */
MeBool bcl_isSpring(MeReal stiffness, MeReal damping);

/* Negates the Jacobian of a row. */
void bcl_negate(MdtKeaRow *row);

/* N: a bound as a program may have written it: HUGE_VAL for MEINFINITY, 0 for negative numbers and NaN. */
double bcl_boundOf(MeReal value);

/* The vector from a body's centre to its attachment, and the attachment itself, in the world frame. */
void bcl_arm(double arm[3], const MdtBclConstraint *c, int k, const MdtKeaTransformation *pose);
void bcl_attachment(double point[3], const MdtBclConstraint *c, int k, const MdtKeaTransformation *pose);

/* Three rows that hold the two attachments together, and their errors. */
void bcl_pointRows(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[3]);
void bcl_pointErrors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double errors[3]);

/* The row of d·(P_0 - P_1), P the attachments, d a world direction fixed in the body of side `carrier`; NO_CARRIER: the
 * row of the distance, where d is its direction. */
enum { NO_CARRIER = -1 };
void bcl_alongRow(const MdtBclConstraint *c, const MdtBclContext *x, const double d[3], int carrier, MdtKeaRow *row);

/* d = P_0 - P_1, P the attachments, m, world. */
void bcl_separation(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double d[3]);

/* A frame's axes in the world frame: primary, ortho, and their cross product. */
void bcl_axes(double axes[3][3], const MdtBclConstraint *c, int k, const MdtKeaTransformation *pose);

/* The row of a·b, a fixed in the body of side 0 and b in that of side 1 (world frame). */
void bcl_dotRow(const MdtBclContext *x, const double a[3], const double b[3], MdtKeaRow *row);

/* The row of body 0 turning against body 1 about a world axis. */
void bcl_spinRow(const MdtBclContext *x, const double axis[3], MdtKeaRow *row);

/* The rotation vector, rad, of a unit quaternion with w >= 0; it has the same coordinates in both frames. */
void bcl_rotationVector(const double turn[4], double rotation[3]);

/* Two rows that hold the primary axis of side 1 along that of side 0, and their errors. */
void bcl_alignRows(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[2]);
void bcl_alignErrors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double errors[2]);

/* The orientation of frame 0 relative to a target frame, which is frame 1 turned by q (null: frame 1), as a quaternion
 * with w >= 0. bcl_turnRows: three rows that hold twice its vector part at 0, in the axes of the target frame;
 * bcl_turnErrors: their errors. */
void bcl_turnBetween(double turn[4], const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2],
                     const double q[4]);
/* Whether the turn is within 0.1 degrees of half a turn, where the rows are singular. */
MeBool bcl_isHalfATurn(const double turn[4]);
void bcl_turnRows(const MdtBclConstraint *c, const MdtBclContext *x, const double q[4], MdtKeaRow rows[3]);
void bcl_turnErrors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], const double q[4],
                    double errors[3]);

/* Sets the axes, or the position, of frame 1 so that it coincides with frame 0 at these poses. */
void bcl_matchAxes(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]);
void bcl_matchPositions(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]);

/* Limit and motor of a coordinate with the rate J v, J that of the row `coordinate`. bcl_limitPrepare takes the present
 * value of the coordinate (without offset) and returns the number of rows; bcl_limitFill writes them. */
int bcl_limitPrepare(MdtBclLimit *limit, const MdtBclContext *x, const MdtKeaRow *coordinate, double measured);
void bcl_limitFill(const MdtBclLimit *limit, const MdtBclContext *x, const MdtKeaRow *coordinate, MdtKeaRow rows[]);
void bcl_limitReadBack(MdtBclLimit *limit, double measured, double rate, const MdtKeaRow rows[]);
MeBool bcl_limitIsMeasured(const MdtBclLimit *limit);

/* Writes the errors of the limit's rows for a value of the coordinate (without offset). Returns the number of rows. */
int bcl_limitErrors(const MdtBclLimit *limit, double measured, double errors[]);

#endif
