/* Linear1: a point of body 0 stays in a plane of body 1 (Dynamics guide ch. 3, "MdtLinear1").
 *
 *     φ = n·(P_0 - P_1),   n the primary axis of frame 1, which is the plane's normal.
 */
#include "bcl_i.h"

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    (void)c, (void)x;
    return 1;
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    bcl_axisErrors(c, pose, 0, 1, e);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    bcl_axisRows(c, x, 0, 1, rows);
}

const MdtBclType bcl_linear1 = {.name = "Linear1",
                                .maxRows = MdtBclGETMAXROWSLINEAR1,
                                .reset = bcl_resetFrames,
                                .prepare = prepare,
                                .fill = fill,
                                .errors = errors};
