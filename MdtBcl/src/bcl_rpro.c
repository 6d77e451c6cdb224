/* RPRO (relative position, relative orientation): the attachments coincide, and the program sets the relative
 * orientation of the frames; the forces are bounded (Dynamics guide ch. 3, "MdtRPROJoint").
 *
 *     φ_1..3 = e_i·(P_0 - P_1), e_i the axes of frame 1
 *     φ_4..6: frame 0 is frame 1 rotated by the target q (bcl_orientationRows)
 *
 * With w the angular velocity of q in the axes of frame 1 and T the target frame, the angular rows have the target
 * -γ φ / h + T_i·w. As position rows, they constrain the orientation at the end of the step to the q of that time,
 * rotated by h w. The force or torque of each row is bounded by its strength: at the bound the joint yields. At an
 * angular error θ the Jacobian of an angular row is shorter by the factor cos θ/2, so that the bound of its multiplier
 * is divided by this factor.
 */
#include "bcl_i.h"
#include <string.h>

static void reset(MdtBclConstraint *c) {
    MdtBclRelative *r = &c->of.relative;
    bcl_resetFrames(c);
    memset(r, 0, sizeof *r);
    r->quaternion[0] = 1;
    for (int i = 0; i < 3; i++)
        r->linear[i] = r->angular[i] = MEINFINITY;
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    MdtBclRelative *r = &c->of.relative;
    double turn[4];
    bcl_turnAfter(r->quaternion, r->velocity, x->elapsed, r->now);
    bcl_turnAfter(r->quaternion, r->velocity, x->elapsed + x->parameters.stepsize, r->then);
    bcl_relativeOrientation(turn, c, x->pose, r->now);
    bcl_orientationRate(turn, r->now, r->velocity, r->rotation);
    keaScale(r->rotation, x->parameters.stepsize, r->rotation);
    MEASSERT(isfinite(keaDot(r->rotation, r->rotation)));
    c->isDegenerate = bcl_isNearHalfTurn(c, x, r->now);
    return 6;
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    const MdtBclRelative *r = &c->of.relative;
    bcl_axisErrors(c, pose, 0, 3, e);
    bcl_orientationErrors(c, pose, r->then, e + 3);
    keaAddScaled(e + 3, 1, r->rotation);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclRelative *r = &c->of.relative;
    bcl_axisRows(c, x, 0, 3, rows);
    bcl_orientationRows(c, x, r->now, rows + 3);
    for (int i = 0; i < 3; i++) {
        rows[3 + i].drift = r->rotation[i] / x->parameters.stepsize;
        rows[3 + i].target += rows[3 + i].drift;
        rows[i].upper = bcl_boundOf(r->linear[i]);
        rows[i].lower = -rows[i].upper;
        rows[3 + i].upper = bcl_boundOf(r->angular[i]) / fmax(keaLength(rows[3 + i].J[0].ang), 1e-3);
        rows[3 + i].lower = -rows[3 + i].upper;
    }
}

const MdtBclType bcl_rproJoint = {.name = "RPROJoint",
                                  .maxRows = MdtBclGETMAXROWSRPROJOINT,
                                  .reset = reset,
                                  .prepare = prepare,
                                  .fill = fill,
                                  .errors = errors,
                                  .degenerate = "it is half a turn away from its relative quaternion"};
