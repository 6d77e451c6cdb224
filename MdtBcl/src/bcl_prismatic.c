/* Prismatic: the bodies slide along a common axis and do not turn (Dynamics guide ch. 3, "MdtPrismatic").
 *
 *     φ_1,2 = u·d, v·d with d = P_0 - P_1 and u, v at right angles to the axis of frame 1
 *     φ_3..5: the frames have one orientation (bcl_orientationRows)
 *
 * The coordinate is the displacement a·d of body 0 relative to body 1 along the axis a, zero at the poses at which the
 * axis was set.
 */
#include "bcl_i.h"

static void reset(MdtBclConstraint *c) {
    bcl_resetFrames(c);
    MdtBclLimitReset(&c->of.limit);
}

/* The present poses define displacement 0 and the relative orientation to be kept. */
static void attached(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    bcl_matchFrame1Axes(c, pose);
    bcl_matchFrame1Position(c, pose);
}

static void axesSet(MdtBclConstraint *c, const MdtBclFrame before[2], const MdtKeaTransformation *const pose[2]) {
    (void)before;
    bcl_matchFrame1Position(c, pose);
}

static double displacement(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    double along;
    bcl_axisErrors(c, pose, 0, 1, &along);
    return along;
}

/* The row of the displacement. */
static void axisRow(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow *row) {
    double axes[3][3];
    bcl_axes(axes, c, 1, x->pose[1]);
    bcl_alongRow(c, x, axes[0], 1, row);
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    MdtKeaRow row;
    c->isDegenerate = bcl_isNearHalfTurn(c, x, NULL);
    axisRow(c, x, &row);
    return 5 + bcl_limitPrepare(&c->of.limit, x, &row, displacement(c, x->pose));
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    bcl_axisErrors(c, pose, 1, 2, e);
    bcl_orientationErrors(c, pose, NULL, e + 2);
    bcl_limitErrors(&c->of.limit, displacement(c, pose), e + 5);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    MdtKeaRow along;
    bcl_axisRows(c, x, 1, 2, rows);
    bcl_orientationRows(c, x, NULL, rows + 2);
    axisRow(c, x, &along);
    bcl_limitFill(&c->of.limit, x, &along, 5, rows + 5);
}

static void readBack(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]) {
    MdtKeaRow row;
    axisRow(c, x, &row);
    bcl_limitReadBack(&c->of.limit, displacement(c, x->pose), bcl_rate(&row, x->velocity), rows + 5);
}

const MdtBclType bcl_prismatic = {.name = "Prismatic",
                                  .maxRows = MdtBclGETMAXROWSPRISMATIC,
                                  .reset = reset,
                                  .prepare = prepare,
                                  .fill = fill,
                                  .errors = errors,
                                  .readBack = readBack,
                                  .attached = attached,
                                  .axesSet = axesSet,
                                  .degenerate = "its bodies are half a turn away from how they were attached"};
