/* Building blocks of joints: rows of parallel axes, orthogonal axes and relative orientations. */
#include "bcl_i.h"

void bcl_axes(double axes[3][3], const MdtBclConstraint *c, int k, const MdtKeaTransformation *pose) {
    MEVALIDATE(bcl_isFrame(&c->frame[k]));
    keaApply(axes[0], pose->R, c->frame[k].primary);
    keaApply(axes[1], pose->R, c->frame[k].ortho);
    keaCross(axes[2], axes[0], axes[1]);
}

/* d(a·b)/dt = (ω_0 x a)·b + a·(ω_1 x b) = ω_0·(a x b) + ω_1·(b x a). */
void bcl_dotRow(const MdtBclContext *x, const double a[3], const double b[3], MdtKeaRow *row) {
    bcl_startRow(row, x);
    keaCross(row->J[0].ang, a, b);
    keaCross(row->J[1].ang, b, a);
}

void bcl_spinRow(const MdtBclContext *x, const double axis[3], MdtKeaRow *row) {
    bcl_startRow(row, x);
    keaCopy(row->J[0].ang, axis);
    keaScale(row->J[1].ang, -1, axis);
}

/* u_0 · a_1 = v_0 · a_1 = 0, u_0 and v_0 at right angles to the primary axis of frame 0. */
void bcl_alignRows(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[2]) {
    double axes[3][3], a[3];
    bcl_axes(axes, c, 0, x->pose[0]);
    keaApply(a, x->pose[1]->R, c->frame[1].primary);
    for (int i = 0; i < 2; i++) {
        bcl_dotRow(x, axes[1 + i], a, &rows[i]);
        bcl_makePosition(&rows[i], x, keaDot(axes[1 + i], a));
    }
    MEVALIDATE(bcl_areRows(rows, 2));
}

void bcl_alignErrors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double errors[2]) {
    double axes[3][3], a[3];
    bcl_axes(axes, c, 0, pose[0]);
    keaApply(a, pose[1]->R, c->frame[1].primary);
    errors[0] = keaDot(axes[1], a);
    errors[1] = keaDot(axes[2], a);
}

void bcl_relativeOrientation(double turn[4], const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2],
                             const double q[4]) {
    double axes[2][3][3], R[3][3];
    bcl_axes(axes[0], c, 0, pose[0]);
    bcl_axes(axes[1], c, 1, pose[1]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            R[i][j] = keaDot(axes[1][i], axes[0][j]);
    keaQuaternionFromMatrix(turn, (const double(*)[3])R);
    if (q) {
        double back[4];
        keaQuaternionConjugate(back, q);
        keaQuaternionProduct(turn, back, turn);
    }
    if (turn[0] < 0)
        for (int i = 0; i < 4; i++)
            turn[i] = -turn[i];
}

MeBool bcl_isNearHalfTurn(const MdtBclConstraint *c, const MdtBclContext *x, const double q[4]) {
    double turn[4];
    bcl_relativeOrientation(turn, c, x->pose, q);
    return turn[0] < 1e-3;
}

void bcl_rotationVector(const double turn[4], double rotation[3]) {
    const double sine = keaLength(turn + 1);
    MEASSERT(turn[0] >= 0); /* the shorter of both rotations */
    keaScale(rotation, sine > 0 ? 2 * atan2(sine, turn[0]) / sine : 2, turn + 1);
}

void bcl_orientationErrors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], const double q[4],
                           double errors[3]) {
    double turn[4];
    bcl_relativeOrientation(turn, c, pose, q);
    keaScale(errors, 2, turn + 1);
}

void bcl_targetAxes(double axes[3][3], const MdtBclConstraint *c, const MdtKeaTransformation *pose, const double q[4]) {
    double frame[3][3], R[3][3];
    bcl_axes(frame, c, 1, pose);
    if (q) {
        keaQuaternionToMatrix(R, q);
    } else {
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                R[i][j] = i == j;
    }
    for (int j = 0; j < 3; j++) {
        keaZero(axes[j]);
        for (int i = 0; i < 3; i++)
            keaAddScaled(axes[j], R[i][j], frame[i]);
    }
}

/* φ = 2 v with the relative quaternion (w, v) in the axes of the target frame T. From d(w, v)/dt = 1/2 (0, ω)(w, v), ω
 * = Tᵀ(ω_0 - ω_1):
 *     dφ/dt = (w I - [v]x) ω.
 * The matrix is singular at half a turn only. */
void bcl_orientationRows(const MdtBclConstraint *c, const MdtBclContext *x, const double q[4], MdtKeaRow rows[3]) {
    double turn[4], T[3][3];
    bcl_relativeOrientation(turn, c, x->pose, q);
    bcl_targetAxes(T, c, x->pose[1], q);
    const double w = turn[0], *v = turn + 1;
    const double G[3][3] = {{w, v[2], -v[1]}, {-v[2], w, v[0]}, {v[1], -v[0], w}};
    for (int i = 0; i < 3; i++) {
        bcl_startRow(&rows[i], x);
        for (int j = 0; j < 3; j++)
            keaAddScaled(rows[i].J[0].ang, G[i][j], T[j]);
        keaScale(rows[i].J[1].ang, -1, rows[i].J[0].ang);
        bcl_makePosition(&rows[i], x, 2 * v[i]);
    }
    MEVALIDATE(bcl_areRows(rows, 3));
}

void bcl_matchFrame1Axes(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    double axis[3];
    keaApply(axis, pose[0]->R, c->frame[0].primary);
    keaApplyTransposed(c->frame[1].primary, pose[1]->R, axis);
    keaApply(axis, pose[0]->R, c->frame[0].ortho);
    keaApplyTransposed(c->frame[1].ortho, pose[1]->R, axis);
}
