/* Hinge: the bodies turn about a common axis (Dynamics guide ch. 3, "MdtHinge").
 *
 *     φ_1..3 = (x_0 + R_0 p_0) - (x_1 + R_1 p_1)      the attachments coincide
 *     φ_4 = u_0 · a_1,  φ_5 = v_0 · a_1               the axis a_1 of body 1 is parallel to a_0
 *
 * with u_0, v_0 and a_0 = u_0 x v_0 fixed in body 0.
 *
 * The angle is that of body 0 relative to body 1, positive about the axis by the right-hand rule:
 *     θ = atan2(u_0 · (a_1 x u_1), u_0 · u_1),   dθ/dt = a·(ω_0 - ω_1),   full turns counted by the limit.
 */
#include "bcl_i.h"

static void reset(MdtBclConstraint *c) {
    bcl_resetFrames(c);
    MdtBclLimitReset(&c->of.limit);
}

/* The row of the angle: rotation about the axis. */
static void angleRow(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow *row) {
    bcl_startRow(row, x);
    keaApply(row->J[0].ang, x->pose[0]->R, c->frame[0].primary);
    keaScale(row->J[0].ang, 1 / keaLength(row->J[0].ang), row->J[0].ang);
    keaScale(row->J[1].ang, -1, row->J[0].ang);
}

/* rad: the angle with full turns, which are counted from the last measured angle. turned: the expected change since. */
static double measureAngle(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double turned) {
    double u0[3], u1[3], a1[3], across[3];
    keaApply(u0, pose[0]->R, c->frame[0].ortho);
    keaApply(u1, pose[1]->R, c->frame[1].ortho);
    keaApply(a1, pose[1]->R, c->frame[1].primary);
    keaCross(across, a1, u1);
    const double angle = atan2(keaDot(u0, across), keaDot(u0, u1));
    if (!c->of.limit.isMeasured)
        return angle;
    const double turn = 6.283185307179586476925;
    return angle + turn * nearbyint((c->of.limit.measured + turned - angle) / turn);
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    MdtKeaRow row;
    angleRow(c, x, &row);
    const double angle = bcl_limitIsMeasured(&c->of.limit) ? measureAngle(c, x->pose, 0) : 0;
    return 5 + bcl_limitPrepare(&c->of.limit, x, &row, angle);
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    bcl_separation(c, pose, e);
    bcl_alignErrors(c, pose, e + 3);
    if (c->of.limit.rows)
        bcl_limitErrors(&c->of.limit, measureAngle(c, pose, 0), e + 5);
}

static int passed(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    return c->of.limit.bActive ? bcl_limitPassed(&c->of.limit, measureAngle(c, pose, 0)) : 0;
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    MdtKeaRow angle;
    bcl_pointRows(c, x, rows);
    bcl_alignRows(c, x, rows + 3);
    angleRow(c, x, &angle);
    bcl_limitFill(&c->of.limit, x, &angle, 5, rows + 5);
}

static void readBack(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]) {
    MdtKeaRow row;
    if (!bcl_limitIsMeasured(&c->of.limit)) {
        c->of.limit.isMeasured = MEFALSE; /* full turns are not counted while the angle is not measured */
        return;
    }
    angleRow(c, x, &row);
    const double rate = bcl_rate(&row, x->velocity);
    bcl_limitReadBack(&c->of.limit, measureAngle(c, x->pose, 2 * atan(0.5 * rate * x->parameters.stepsize)), rate,
                      rows + 5);
}

const MdtBclType bcl_hinge = {.name = "Hinge",
                              .maxRows = MdtBclGETMAXROWSHINGE,
                              .reset = reset,
                              .prepare = prepare,
                              .fill = fill,
                              .errors = errors,
                              .passed = passed,
                              .readBack = readBack};
