/* Ball and socket: a point of one body stays on a point of the other (Dynamics guide ch. 3, "MdtBSJoint").
 *
 *     φ = (x_0 + R_0 p_0) - (x_1 + R_1 p_1) = 0,   three rows along the world axes.
 *
 * A position motor adds three rows, of the orientation of frame 0 in frame 1 (bcl_servo.c).
 */
#include "bcl_i.h"

static void reset(MdtBclConstraint *c) {
    bcl_resetFrames(c);
    bcl_resetTurnServo(&c->of.servo);
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    return 3 + bcl_turnServoPrepare(c, &c->of.servo, x);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    bcl_pointRows(c, x, rows);
    if (bcl_isServo(&c->of.servo.motor))
        bcl_turnServoFill(c, &c->of.servo, x, rows + 3);
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    bcl_separation(c, pose, e);
}

const MdtBclType bcl_bsJoint = {.name = "BSJoint",
                                .maxRows = MdtBclGETMAXROWSBSJOINT + 3, /* and a position motor */
                                .reset = reset,
                                .prepare = prepare,
                                .fill = fill,
                                .errors = errors};
