/* Linear2: a point of body 0 stays on a line of body 1 (Dynamics guide ch. 3, "MdtLinear2").
 *
 *     φ_1,2 = u·d, v·d,   d = P_0 - P_1,   u and v at right angles to the line, the primary axis of frame 1.
 */
#include "bcl_i.h"

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    (void)c, (void)x;
    return 2;
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    bcl_axisErrors(c, pose, 1, 2, e);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    bcl_axisRows(c, x, 1, 2, rows);
}

const MdtBclType bcl_linear2 = {.name = "Linear2",
                                .maxRows = MdtBclGETMAXROWSLINEAR2,
                                .reset = bcl_resetFrames,
                                .prepare = prepare,
                                .fill = fill,
                                .errors = errors};
