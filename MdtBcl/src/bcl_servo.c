/* Position motors: damped springs to a target, of a frequency and damping ratio that do not depend on masses.
 *
 * A coordinate q with the target t, the effective mass m and the angular frequency w = 2 π f has the force
 *
 *     λ = -k (q - t) - c (q' - t'),   k = m w²,   c = 2 ζ m w,   |λ| <= the bound
 *
 * and is a spring row of Kea, which is implicit: midpoint rule, or backward Euler where h w is beyond 2. Its mass is
 * the one that the joint's bodies show along the coordinate while the joint's other rows R hold,
 *
 *     1/m = A - B C⁻¹ Bᵀ,    A = J M⁻¹ Jᵀ, B = J M⁻¹ Rᵀ, C = R M⁻¹ Rᵀ         (Schur complement)
 *
 * so that of a door it is the moment of inertia about its hinge. Other joints of the bodies do not count.
 *
 * The midpoint rule damps a turn of the oscillation by π ζ (1 - (h w)² (1 - ζ²) / 6 + ...) in place of π ζ; c is
 * greater by this factor, so that no step makes the motion overshoot more than the oscillator does.
 *
 * An orientation has a row about each principal axis of the effective inertia, 1/m a 3 by 3 matrix. In these axes the
 * law is that of one oscillator in any pose: torque = -I (w² θ n + 2 ζ w ω), θ n the rotation vector from the target.
 */
#include "bcl_i.h"

enum { MAX_RIGID = 6, MAX_MOVED = 3 };

/* J_a M⁻¹ J_bᵀ */
static double product(const MdtBclContext *x, const MdtKeaRow *a, const MdtKeaRow *b) {
    double sum = 0, turned[3], moved[3];
    for (int k = 0; k < 2; k++) {
        keaApply(turned, (const double(*)[3])x->invMass[k]->inertia, a->J[k].ang);
        keaCopy(moved, a->J[k].lin);
        keaDropAxes(x->kea[k] ? x->kea[k]->locked : 0, moved);
        sum += x->invMass[k]->mass * keaDot(moved, b->J[k].lin) + keaDot(turned, b->J[k].ang);
    }
    return sum;
}

/* Sets the inverse effective mass of 1 to 3 rows, with `count` rows rigid: eliminates these from the matrix of all. A
 * such row that depends on earlier ones is left out. */
static void invertMass(const MdtBclContext *x, const MdtKeaRow rigid[], int count, const MdtKeaRow rows[], int moved,
                       double inverse[MAX_MOVED][MAX_MOVED]) {
    static const double dependent = 1e-10; /* of a row's own inverse mass: rounding of single precision, squared */
    const int all = count + moved;
    double A[MAX_RIGID + MAX_MOVED][MAX_RIGID + MAX_MOVED], own[MAX_RIGID];
    MEASSERT(count >= 0 && count <= MAX_RIGID && moved >= 1 && moved <= MAX_MOVED);
    for (int i = 0; i < all; i++)
        for (int j = 0; j <= i; j++)
            A[i][j] = A[j][i] =
                product(x, i < count ? &rigid[i] : &rows[i - count], j < count ? &rigid[j] : &rows[j - count]);
    for (int p = 0; p < count; p++)
        own[p] = A[p][p];
    for (int p = 0; p < count; p++) {
        if (!(A[p][p] > dependent * own[p]))
            continue;
        for (int i = p + 1; i < all; i++)
            for (int j = p + 1; j < all; j++)
                A[i][j] -= A[i][p] * A[p][j] / A[p][p];
    }
    for (int i = 0; i < moved; i++)
        for (int j = 0; j < moved; j++)
            inverse[i][j] = A[count + i][count + j];
}

double bcl_effectiveMass(const MdtBclContext *x, const MdtKeaRow rigid[], int count, const MdtKeaRow *row) {
    double inverse[MAX_MOVED][MAX_MOVED];
    if (x->isUpdate)
        return 0;
    invertMass(x, rigid, count, row, 1, inverse);
    return inverse[0][0] > 0 ? 1 / inverse[0][0] : 0;
}

MeBool bcl_isServo(const MdtBclServo *m) {
    return m->frequency > 0 && m->force > 0;
}

void bcl_makeServo(MdtKeaRow *row, const MdtBclContext *x, const MdtBclServo *m, double error, double velocity,
                   double mass) {
    const double w = 6.283185307179586476925 * (double)m->frequency, ratio = m->dampingRatio;
    const double turn = x->parameters.stepsize * w;
    const double lost = turn < 2 && ratio < 1 ? turn * turn * (1 - ratio * ratio) / 6 : 0;
    bcl_makeSpring(row, error, mass * w * w, 2 * ratio * (1 + lost) * mass * w);
    row->mass = mass;
    row->target = row->drift = velocity;
    row->upper = bcl_boundOf(m->force);
    row->lower = -row->upper;
}

/* ---- orientations ---- */

void bcl_resetTurn(MdtBclTargetTurn *t) {
    *t = (MdtBclTargetTurn){.quaternion = {1, 0, 0, 0}};
}

void bcl_turnAfter(const double quaternion[4], const double velocity[3], double time, double q[4]) {
    double turn[3], step[4];
    keaScale(turn, time, velocity);
    keaQuaternionExp(step, turn);
    keaQuaternionProduct(q, step, quaternion);
}

void bcl_turnVelocity(const double q[4], const double velocity[3], double local[3]) {
    double R[3][3];
    keaQuaternionToMatrix(R, q);
    keaApplyTransposed(local, (const double(*)[3])R, velocity);
}

void bcl_orientationRate(const double turn[4], const double q[4], const double velocity[3], double rate[3]) {
    double w[3];
    bcl_turnVelocity(q, velocity, w);
    keaCross(rate, w, turn + 1);
    keaAddScaled(rate, turn[0], w);
}

void bcl_resetTurnServo(MdtBclTurnServo *t) {
    *t = (MdtBclTurnServo){.motor.dampingRatio = 1, .motor.force = MEINFINITY};
    bcl_resetTurn(&t->target);
}

/* Sets the principal axes of the effective inertia, and the moments about them. */
static void setPrincipalAxes(const MdtBclConstraint *c, MdtBclTurnServo *t, const MdtBclContext *x) {
    MdtKeaRow rigid[3], rows[3];
    double T[3][3], A[MAX_MOVED][MAX_MOVED], V[3][3];
    bcl_pointRows(c, x, rigid);
    bcl_targetAxes(T, c, x->pose[1], t->now);
    for (int i = 0; i < 3; i++)
        bcl_spinRow(x, T[i], &rows[i]);
    invertMass(x, rigid, 3, rows, 3, A);
    MdtKeaDiagonalize(A, V);
    for (int i = 0; i < 3; i++) {
        t->inertia[i] = A[i][i] > 0 ? 1 / A[i][i] : 0;
        for (int k = 0; k < 3; k++)
            t->axis[i][k] = V[k][i];
    }
}

int bcl_turnServoPrepare(const MdtBclConstraint *c, MdtBclTurnServo *t, const MdtBclContext *x) {
    if (!bcl_isServo(&t->motor))
        return 0;
    bcl_turnAfter(t->target.quaternion, t->target.velocity, x->elapsed, t->now);
    setPrincipalAxes(c, t, x);
    return 3;
}

void bcl_turnServoFill(const MdtBclConstraint *c, const MdtBclTurnServo *t, const MdtBclContext *x, MdtKeaRow rows[3]) {
    double T[3][3], turn[4], error[3], rate[3];
    bcl_targetAxes(T, c, x->pose[1], t->now);
    bcl_relativeOrientation(turn, c, x->pose, t->now);
    bcl_rotationVector(turn, error);
    bcl_turnVelocity(t->now, t->target.velocity, rate);
    for (int i = 0; i < 3; i++) {
        double axis[3];
        keaApplyTransposed(axis, (const double(*)[3])T, t->axis[i]);
        bcl_spinRow(x, axis, &rows[i]);
        bcl_makeServo(&rows[i], x, &t->motor, keaDot(t->axis[i], error), keaDot(t->axis[i], rate), t->inertia[i]);
    }
}
