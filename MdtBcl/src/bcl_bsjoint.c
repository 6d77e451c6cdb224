/* Ball and socket: a point of one body stays on a point of the other (Dynamics guide ch. 3, "MdtBSJoint").
 *
 *     φ = (x_0 + R_0 p_0) - (x_1 + R_1 p_1) = 0,   three rows along the world axes.
 */
#include "bcl_i.h"

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    (void)c, (void)x;
    return 3;
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    bcl_pointRows(c, x, rows);
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    bcl_separation(c, pose, e);
}

const MdtBclType bcl_bsJoint = {.name = "BSJoint",
                                .maxRows = MdtBclGETMAXROWSBSJOINT,
                                .reset = bcl_resetFrames,
                                .prepare = prepare,
                                .fill = fill,
                                .errors = errors};
