/* FPFO (fixed position, fixed orientation): the bodies are rigidly joined (Dynamics guide ch. 3, "MdtFPFOJoint").
 *
 *     φ_1..3 = P_0 - P_1,   φ_4..6: the frames have one orientation (bcl_orientationRows).
 */
#include "bcl_i.h"

/* Keeps the relative pose that the bodies had when they were attached. */
static void attached(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    bcl_matchFrame1Axes(c, pose);
    bcl_matchFrame1Position(c, pose);
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    c->isDegenerate = bcl_isNearHalfTurn(c, x, NULL);
    return 6;
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    bcl_separation(c, pose, e);
    bcl_orientationErrors(c, pose, NULL, e + 3);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    bcl_pointRows(c, x, rows);
    bcl_orientationRows(c, x, NULL, rows + 3);
}

const MdtBclType bcl_fpfoJoint = {.name = "FPFOJoint",
                                  .maxRows = MdtBclGETMAXROWSFPFOJOINT,
                                  .reset = bcl_resetFrames,
                                  .prepare = prepare,
                                  .fill = fill,
                                  .errors = errors,
                                  .attached = attached,
                                  .degenerate = "its bodies are half a turn away from how they were attached"};
