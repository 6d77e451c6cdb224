/* Linear1: a point of body 0 stays in a plane of body 1 (Dynamics guide ch. 3, "MdtLinear1").
 *
 *     φ = n·(P_0 - P_1),   n the primary axis of frame 1, which is the plane's normal.
 */
#include "bcl_i.h"

static void reset(MdtBclConstraint *c) {
    bcl_resetFrames(c);
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    (void)c, (void)x;
    return 1;
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    double normal[3], d[3];
    keaApply(normal, pose[1]->R, c->frame[1].primary);
    bcl_separation(c, pose, d);
    e[0] = keaDot(normal, d);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    double normal[3], e;
    keaApply(normal, x->pose[1]->R, c->frame[1].primary);
    errors(c, x->pose, &e);
    bcl_alongRow(c, x, normal, 1, &rows[0]);
    bcl_aimAtZero(&rows[0], x, e);
}

const MdtBclType bcl_linear1 = {.name = "Linear1",
                                .maxRows = MdtBclGETMAXROWSLINEAR1,
                                .reset = reset,
                                .prepare = prepare,
                                .fill = fill,
                                .errors = errors};
