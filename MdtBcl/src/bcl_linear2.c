/* Linear2: a point of body 0 stays on a line of body 1 (Dynamics guide ch. 3, "MdtLinear2").
 *
 *     φ_1,2 = u·d, v·d,   d = P_0 - P_1,   u and v at right angles to the line, the primary axis of frame 1.
 */
#include "bcl_i.h"

static void reset(MdtBclConstraint *c) {
    bcl_resetFrames(c);
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    (void)c, (void)x;
    return 2;
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    double axes[3][3], d[3];
    bcl_axes(axes, c, 1, pose[1]);
    bcl_separation(c, pose, d);
    e[0] = keaDot(axes[1], d);
    e[1] = keaDot(axes[2], d);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    double axes[3][3], e[2];
    bcl_axes(axes, c, 1, x->pose[1]);
    errors(c, x->pose, e);
    for (int i = 0; i < 2; i++) {
        bcl_alongRow(c, x, axes[1 + i], 1, &rows[i]);
        bcl_aimAtZero(&rows[i], x, e[i]);
    }
}

const MdtBclType bcl_linear2 = {.name = "Linear2",
                                .maxRows = MdtBclGETMAXROWSLINEAR2,
                                .reset = reset,
                                .prepare = prepare,
                                .fill = fill,
                                .errors = errors};
