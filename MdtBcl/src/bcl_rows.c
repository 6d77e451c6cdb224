/* Building blocks of joints: attachment frames, rows, coincident points. */
#include "bcl_i.h"
#include <string.h>

void bcl_resetFrames(MdtBclConstraint *c) {
    static const MdtBclFrame standard = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    c->frame[0] = c->frame[1] = standard;
}

static MeBool isFinite3(const double v[3]) {
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

/* bcl_areRows for one row. */
static MeBool isRow(const MdtKeaRow *row) {
    for (int k = 0; k < 2; k++)
        if (!isFinite3(row->J[k].lin) || !isFinite3(row->J[k].ang) || !isFinite3(row->arm[k]))
            return MEFALSE;
    return row->lower <= row->upper && row->softness >= 0 && row->stiffness >= 0 && row->damping >= 0 &&
           row->friction >= 0;
}

MeBool bcl_areRows(const MdtKeaRow rows[], int count) {
    for (int i = 0; i < count; i++)
        if (!isRow(&rows[i]))
            return MEFALSE;
    return METRUE;
}

static const double axisTolerance = 1e-5; /* axes may have been given in single precision */

MeBool bcl_isUnit(const double d[3]) {
    return fabs(keaDot(d, d) - 1) < axisTolerance;
}

MeBool bcl_isFrame(const MdtBclFrame *frame) {
    return bcl_isUnit(frame->primary) && bcl_isUnit(frame->ortho) &&
           fabs(keaDot(frame->primary, frame->ortho)) < axisTolerance;
}

void bcl_startRow(MdtKeaRow *row, const MdtBclContext *x) {
    MEASSERT(x->parameters.stepsize > 0 && x->parameters.epsilon >= 0);
    MEASSERT(x->body[0] != MdtBclNO_BODY || x->body[1] != MdtBclNO_BODY);
    MEASSERT(x->body[0] != x->body[1]);
    memset(row, 0, sizeof *row);
    row->body[0] = x->body[0];
    row->body[1] = x->body[1];
    row->softness = x->parameters.epsilon;
    row->lower = -HUGE_VAL;
    row->upper = HUGE_VAL;
    row->normal = row->partner = row->contact = -1;
}

void bcl_bendRow(const MdtBclConstraint *c, const MdtBclContext *x, double curvature, MdtKeaRow *row) {
    for (int k = 0; k < 2; k++) {
        double a[3];
        keaApply(a, x->pose[k]->R, c->frame[k].primary);
        keaCross(row->bend[k], row->J[k].ang, a);
    }
    row->curvature = curvature;
}

void bcl_makePosition(MdtKeaRow *row, const MdtBclContext *x, double error) {
    MEASSERT(x->parameters.gamma >= 0 && x->parameters.gamma <= 1);
    row->error = error;
    row->target = -x->parameters.gamma * error / x->parameters.stepsize;
    row->position = METRUE;
}

double bcl_rate(const MdtKeaRow *row, const MdtKeaVelocity *const velocity[2]) {
    double rate = 0;
    for (int k = 0; k < 2; k++)
        rate += keaDot(row->J[k].lin, velocity[k]->lin) + keaDot(row->J[k].ang, velocity[k]->ang);
    return rate;
}

void bcl_makeSpring(MdtKeaRow *row, double error, double stiffness, double damping) {
    MEASSERT(!row->position && !row->spring);
    row->spring = METRUE;
    row->error = error;
    row->stiffness = fmax(stiffness, 0);
    row->damping = fmax(damping, 0);
}

void bcl_makeMotor(MdtKeaRow *row, MeReal velocity, MeReal force) {
    MEASSERT(!row->position); /* a motor is a velocity row */
    row->target = velocity;
    row->upper = bcl_boundOf(force);
    row->lower = -row->upper;
    row->softness = 0;
}

MeBool bcl_isSpring(MeReal stiffness, MeReal damping) {
    return stiffness < MEINFINITY && damping < MEINFINITY;
}

void bcl_negate(MdtKeaRow *row) {
    MEASSERT(!row->position);
    for (int k = 0; k < 2; k++) {
        keaScale(row->J[k].lin, -1, row->J[k].lin);
        keaScale(row->J[k].ang, -1, row->J[k].ang);
    }
}

double bcl_boundOf(MeReal value) {
    return value >= MEINFINITY ? HUGE_VAL : value > 0 ? (double)value : 0;
}

void bcl_arm(double arm[3], const MdtBclConstraint *c, int k, const MdtKeaTransformation *pose) {
    keaApply(arm, pose->R, c->frame[k].position);
}

void bcl_attachment(double point[3], const MdtBclConstraint *c, int k, const MdtKeaTransformation *pose) {
    bcl_arm(point, c, k, pose);
    keaAddScaled(point, 1, pose->pos);
}

/* φ = (x_0 + r_0) - (x_1 + r_1), r = R p the arms. Along the world axis e:
 *     J_0 = [e, r_0 x e],   J_1 = -[e, r_1 x e],   since d(r·e)/dt = (ω x r)·e = ω·(r x e). */
void bcl_pointRows(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[3]) {
    double errors[3], arm[2][3];
    bcl_separation(c, x->pose, errors);
    bcl_arm(arm[0], c, 0, x->pose[0]);
    bcl_arm(arm[1], c, 1, x->pose[1]);
    for (int i = 0; i < 3; i++) {
        bcl_startRow(&rows[i], x);
        for (int k = 0; k < 2; k++) {
            rows[i].J[k].lin[i] = k == 0 ? 1 : -1;
            keaCross(rows[i].J[k].ang, arm[k], rows[i].J[k].lin);
            keaCopy(rows[i].arm[k], arm[k]);
        }
        bcl_makePosition(&rows[i], x, errors[i]);
    }
    MEVALIDATE(bcl_areRows(rows, 3));
}

void bcl_separation(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double d[3]) {
    double other[3];
    bcl_attachment(d, c, 0, pose[0]);
    bcl_attachment(other, c, 1, pose[1]);
    keaSubtract(d, d, other);
}

/* If d is fixed in body k, the derivative of d·(P_0 - P_1) has the additional term ω_k·(d x (P_0 - P_1)). Its effect is
 * that the lever arm of body k ends at the attachment point of the other body. */
void bcl_alongRow(const MdtBclConstraint *c, const MdtBclContext *x, const double d[3], int carrier, MdtKeaRow *row) {
    MEASSERT(carrier >= NO_CARRIER && carrier <= 1);
    bcl_startRow(row, x);
    for (int k = 0; k < 2; k++) {
        double arm[3];
        if (k == carrier) {
            bcl_attachment(arm, c, 1 - k, x->pose[1 - k]);
            keaSubtract(arm, arm, x->pose[k]->pos);
        } else {
            bcl_arm(arm, c, k, x->pose[k]);
        }
        keaScale(row->J[k].lin, k == 0 ? 1 : -1, d);
        keaCross(row->J[k].ang, arm, row->J[k].lin);
        keaCopy(row->arm[k], arm);
    }
    MEVALIDATE(!isFinite3(d) || bcl_areRows(row, 1)); /* NaN: a pose has overflowed */
}

void bcl_axisRows(const MdtBclConstraint *c, const MdtBclContext *x, int first, int count, MdtKeaRow rows[]) {
    double axes[3][3], errors[3];
    bcl_axes(axes, c, 1, x->pose[1]);
    bcl_axisErrors(c, x->pose, first, count, errors);
    for (int i = 0; i < count; i++) {
        bcl_alongRow(c, x, axes[first + i], 1, &rows[i]);
        bcl_makePosition(&rows[i], x, errors[i]);
    }
}

void bcl_axisErrors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], int first, int count,
                    double errors[]) {
    double axes[3][3], d[3];
    bcl_axes(axes, c, 1, pose[1]);
    bcl_separation(c, pose, d);
    for (int i = 0; i < count; i++)
        errors[i] = keaDot(axes[first + i], d);
}

void bcl_matchFrame1Position(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    double point[3];
    bcl_attachment(point, c, 0, pose[0]);
    keaSubtract(point, point, pose[1]->pos);
    keaApplyTransposed(c->frame[1].position, pose[1]->R, point);
}
