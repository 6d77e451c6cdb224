/* Inside Bcl: the building blocks of joints, which are rows, errors and limits. */
#ifndef BCL_I_H
#define BCL_I_H

#include "MdtBcl.h"
#include "MdtKeaMath.h"
#include "MeAssert.h"
#include "MeMath.h"

extern const MdtBclType bcl_bsJoint, bcl_hinge, bcl_prismatic, bcl_carWheel, bcl_contact, bcl_contactGroup,
    bcl_fixedPath, bcl_rproJoint, bcl_universal, bcl_skeletal, bcl_linear1, bcl_linear2, bcl_angular3, bcl_spring6,
    bcl_spring, bcl_coneLimit, bcl_user, bcl_fpfoJoint, bcl_gear, bcl_pulley, bcl_mimic, bcl_groundWheel;

/* Sine of the angle below which two axes count as parallel: their cross product has no direction. */
#define BCL_PARALLEL 1e-6

/* Sets both attachment frames to the bodies' centres of mass, with primary axis x and second axis y. */
void bcl_resetFrames(MdtBclConstraint *c);

/* Initializes a row between the constraint's bodies: two-sided, with softness ε, Jacobian and target 0. */
void bcl_startRow(MdtKeaRow *row, const MdtBclContext *x);

/* Sets the bend of a row of the swing (MdtKeaRow): its direction turns by `curvature` of what the primary axes move at
 * right angles to it, relative to each other. */
void bcl_bendRow(const MdtBclConstraint *c, const MdtBclContext *x, double curvature, MdtKeaRow *row);

/* Makes a row a position row, which constrains φ at the end of the step: its target s = -γ φ / h removes the fraction γ
 * of the error φ (Baumgarte). */
void bcl_makePosition(MdtKeaRow *row, const MdtBclContext *x, double error);

/* Checks invariants of rows: Jacobians are finite, lower <= upper, and no compliance, stiffness, damping or friction
 * coefficient is negative. Errors and targets are not checked: public parameters of a program may make them
 * infinite. */
MeBool bcl_areRows(const MdtKeaRow rows[], int count);

/* Check what setters guarantee: d has length 1; the axes of a frame have length 1 and are orthogonal. */
MeBool bcl_isUnit(const double d[3]);
MeBool bcl_isFrame(const MdtBclFrame *frame);

/* The rate J v of a row at the given velocities. */
double bcl_rate(const MdtKeaRow *row, const MdtKeaVelocity *const velocity[2]);

/* Makes a row a damped spring with this error. */
void bcl_makeSpring(MdtKeaRow *row, double error, double stiffness, double damping);

/* Makes a row a motor, or a brake: J v = velocity with |λ| <= force. Its softness is 0, since ε on a velocity row acts
 * as viscosity: a brake would creep under load. */
void bcl_makeMotor(MdtKeaRow *row, MeReal velocity, MeReal force);

/* Whether stiffness and damping are those of a spring: both are finite. Otherwise the joint is rigid, or the stop
 * hard. */
MeBool bcl_isSpring(MeReal stiffness, MeReal damping);

/* Negates the Jacobian of a row. */
void bcl_negate(MdtKeaRow *row);

/* N: converts a bound that a program has set: HUGE_VAL for MEINFINITY, 0 for negative numbers and NaN. */
double bcl_boundOf(MeReal value);

/* The vector from the centre of mass of body k to its attachment point, and this point, in the world frame. */
void bcl_arm(double arm[3], const MdtBclConstraint *c, int k, const MdtKeaTransformation *pose);
void bcl_attachment(double point[3], const MdtBclConstraint *c, int k, const MdtKeaTransformation *pose);

/* m, world: the separation P_0 - P_1 of the attachment points; and three rows, along the world axes, that keep it 0. */
void bcl_separation(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double d[3]);
void bcl_pointRows(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[3]);

/* The row of d·(P_0 - P_1), P the attachment points, d a world direction fixed in body `carrier` (0 or 1). NO_CARRIER:
 * the row of the distance |P_0 - P_1|, whose direction is d. */
enum { NO_CARRIER = -1 };
void bcl_alongRow(const MdtBclConstraint *c, const MdtBclContext *x, const double d[3], int carrier, MdtKeaRow *row);

/* Rows of the separation along `count` axes of frame 1, from the axis `first` on, and their errors. */
void bcl_axisRows(const MdtBclConstraint *c, const MdtBclContext *x, int first, int count, MdtKeaRow rows[]);
void bcl_axisErrors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], int first, int count,
                    double errors[]);

/* A frame's axes in the world frame: primary, ortho, and their cross product. */
void bcl_axes(double axes[3][3], const MdtBclConstraint *c, int k, const MdtKeaTransformation *pose);

/* The row of a·b, with a fixed in body 0 and b in body 1 (world frame). */
void bcl_dotRow(const MdtBclContext *x, const double a[3], const double b[3], MdtKeaRow *row);

/* The row of the angular velocity of body 0 relative to body 1 about a world axis. */
void bcl_spinRow(const MdtBclContext *x, const double axis[3], MdtKeaRow *row);

/* The rotation vector, rad, of a unit quaternion with w >= 0. Its coordinates in both frames are equal. */
void bcl_rotationVector(const double turn[4], double rotation[3]);

/* Two rows that keep the primary axis of frame 1 parallel to that of frame 0, and their errors. */
void bcl_alignRows(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[2]);
void bcl_alignErrors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double errors[2]);

/* The orientation of frame 0 relative to a target frame, which is frame 1 rotated by q (null: frame 1), as a quaternion
 * with w >= 0. bcl_orientationRows: three rows that constrain twice its vector part to 0, in the axes of the target
 * frame; bcl_orientationErrors: their errors; bcl_isNearHalfTurn: whether the rotation is within 0.1 degrees of half a
 * turn, where the rows are singular. */
void bcl_relativeOrientation(double turn[4], const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2],
                             const double q[4]);
MeBool bcl_isNearHalfTurn(const MdtBclConstraint *c, const MdtBclContext *x, const double q[4]);
void bcl_orientationRows(const MdtBclConstraint *c, const MdtBclContext *x, const double q[4], MdtKeaRow rows[3]);
void bcl_orientationErrors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], const double q[4],
                           double errors[3]);

/* The axes of the target frame in the world: frame 1 turned by q (null: frame 1). */
void bcl_targetAxes(double axes[3][3], const MdtBclConstraint *c, const MdtKeaTransformation *pose, const double q[4]);

/* Position motors (bcl_servo.c). bcl_effectiveMass: kg, that the bodies show along a row while `count` rows hold; 0:
 * infinite, or in an update. bcl_makeServo makes a row the motor's, with its error, the velocity of its target, and
 * this mass. */
MeBool bcl_isServo(const MdtBclServo *m);
double bcl_effectiveMass(const MdtBclContext *x, const MdtKeaRow rigid[], int count, const MdtKeaRow *row);
void bcl_makeServo(MdtKeaRow *row, const MdtBclContext *x, const MdtBclServo *m, double error, double velocity,
                   double mass);

/* Targets that turn: their quaternion after a time; the components of their velocity in the target's axes. */
void bcl_resetTurn(MdtBclTargetTurn *t);
void bcl_turnAfter(const double quaternion[4], const double velocity[3], double time, double q[4]);
void bcl_turnVelocity(const double q[4], const double velocity[3], double local[3]);
/* The rate of bcl_orientationRows due to the angular velocity ω of the target q: G Tᵀ F_1 ω, with G of these rows. */
void bcl_orientationRate(const double turn[4], const double q[4], const double velocity[3], double rate[3]);

/* The rows of an orientation's motor: prepare returns their number, 0 or 3. */
void bcl_resetTurnServo(MdtBclTurnServo *t);
int bcl_turnServoPrepare(const MdtBclConstraint *c, MdtBclTurnServo *t, const MdtBclContext *x);
void bcl_turnServoFill(const MdtBclConstraint *c, const MdtBclTurnServo *t, const MdtBclContext *x, MdtKeaRow rows[3]);

/* Sets the axes, or the position, of frame 1 so that it coincides with frame 0 at these poses. */
void bcl_matchFrame1Axes(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]);
void bcl_matchFrame1Position(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]);

/* Whether a stop of a limit is hard: its stiffness is infinite or above the threshold. */
MeBool bcl_isStopHard(const MdtBclLimit *limit, int side);
/* Sets stiffness and damping of a stop: hard if either is infinite. */
void bcl_setStopSpring(MdtBclSingleLimit *stop, MeReal stiffness, MeReal damping);
/* Makes a row, whose error is the distance to a hard stop, the one-sided position row of that stop. */
void bcl_makeStop(MdtKeaRow *row, const MdtBclContext *x);

/* Limit and motor of a coordinate: `coordinate` is a row with the coordinate's J, so that its rate is J v; `measured`
 * is its present value without offset. bcl_limitPrepare chooses the rows and returns their number; bcl_limitFill writes
 * them, behind `rigid` rows of the joint that hold its other directions; bcl_limitReadBack stores position, rate and
 * stop forces after the step. bcl_limitIsMeasured: whether the limit needs the value. */
int bcl_limitPrepare(MdtBclLimit *limit, const MdtBclContext *x, const MdtKeaRow *coordinate, double measured);
void bcl_limitFill(const MdtBclLimit *limit, const MdtBclContext *x, const MdtKeaRow *coordinate, int rigid,
                   MdtKeaRow rows[]);
void bcl_limitReadBack(MdtBclLimit *limit, double measured, double rate, const MdtKeaRow rows[]);
MeBool bcl_limitIsMeasured(const MdtBclLimit *limit);

/* The number of rows that bcl_limitPrepare chose. */
int bcl_limitRows(const MdtBclLimit *limit);
/* Drops the rows of the stops and, unless keepsMotor, that of motor or lock. Returns the number of rows that remain. */
int bcl_limitKeepMotor(MdtBclLimit *limit, MeBool keepsMotor);

/* The number of hard stops without a row that the angle passes by more than a milliradian; they get rows now. */
int bcl_limitPassed(MdtBclLimit *limit, double measured);

/* Writes the errors of the limit's rows at a value of the coordinate (without offset). Returns the number of rows. */
int bcl_limitErrors(const MdtBclLimit *limit, double measured, double errors[]);

#endif
