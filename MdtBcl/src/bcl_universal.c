/* Universal: a common point, and an axis of one body at right angles to an axis of the other (Dynamics guide ch. 3,
 * "MdtUniversal").
 *
 *     φ_1..3 = P_0 - P_1,   φ_4 = a·b,   a the primary axis of frame 0, b the second axis of frame 1.
 *
 * The shafts are the third axes of the frames, in line when the joint is set up. Bent by 90 degrees, the joint
 * transmits no torque between them.
 */
#include "bcl_i.h"

static void crossAxes(double a[3], double b[3], const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    keaApply(a, pose[0]->R, c->frame[0].primary);
    keaApply(b, pose[1]->R, c->frame[1].ortho);
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    const double rightAngle = 0.01; /* rad to either side */
    double axes[2][3][3];
    bcl_axes(axes[0], c, 0, x->pose[0]);
    bcl_axes(axes[1], c, 1, x->pose[1]);
    c->isDegenerate = fabs(keaDot(axes[0][2], axes[1][2])) < rightAngle;
    return 4;
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    double a[3], b[3];
    bcl_separation(c, pose, e);
    crossAxes(a, b, c, pose);
    e[3] = keaDot(a, b);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    double a[3], b[3];
    bcl_pointRows(c, x, rows);
    crossAxes(a, b, c, x->pose);
    bcl_dotRow(x, a, b, &rows[3]);
    bcl_makePosition(&rows[3], x, keaDot(a, b));
}

const MdtBclType bcl_universal = {.name = "Universal",
                                  .maxRows = MdtBclGETMAXROWSUNIVERSAL,
                                  .reset = bcl_resetFrames,
                                  .prepare = prepare,
                                  .fill = fill,
                                  .errors = errors,
                                  .degenerate = "it is bent by 90 degrees, where it carries no torque"};
