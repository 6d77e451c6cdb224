/* Angular3: the bodies keep their relative orientation and may translate freely (Dynamics guide ch. 3, "MdtAngular3").
 *
 * The joint has three rows, of the relative orientation of the frames (bcl_orientationRows); with rotation enabled
 * (Angular2) the two rows of a hinge that keep the primary axes parallel.
 *
 * With finite stiffness and damping the joint is a damped spring, whose torque on body 0 is -k θ n - c ω at any angle:
 * θ n is the rotation vector between the frames, or, with rotation enabled, between the primary axes. The spring has a
 * row about each axis of frame 0, or about those across its primary axis; their errors are the vector's components.
 */
#include "bcl_i.h"

static void reset(MdtBclConstraint *c) {
    bcl_resetFrames(c);
    c->of.angular = (MdtBclAngular){.stiffness = MEINFINITY, .damping = MEINFINITY};
}

/* The relative orientation to be kept is the one at the time of attachment. */
static void attached(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    bcl_matchFrame1Axes(c, pose);
}

/* Setting axes later changes the axis of rotation, not the relative orientation to be kept: frame 1 is turned within
 * its body as frame 0 was, F_1' = F_1 F_0ᵀ F_0'. */
static void axesSet(MdtBclConstraint *c, const MdtBclFrame before[2], const MdtKeaTransformation *const pose[2]) {
    (void)pose;
    double third[2][3], *set[2] = {c->frame[1].primary, c->frame[1].ortho};
    const double *now[2] = {c->frame[0].primary, c->frame[0].ortho};
    for (int k = 0; k < 2; k++)
        keaCross(third[k], before[k].primary, before[k].ortho);
    for (int i = 0; i < 2; i++) {
        keaScale(set[i], keaDot(before[0].primary, now[i]), before[1].primary);
        keaAddScaled(set[i], keaDot(before[0].ortho, now[i]), before[1].ortho);
        keaAddScaled(set[i], keaDot(third[0], now[i]), third[1]);
    }
}

static int countRows(const MdtBclConstraint *c) {
    return c->of.angular.rotates ? 2 : 3;
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    c->isDegenerate = !c->of.angular.rotates && bcl_isNearHalfTurn(c, x, NULL);
    return countRows(c);
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    if (c->of.angular.rotates)
        bcl_alignErrors(c, pose, e);
    else
        bcl_orientationErrors(c, pose, NULL, e);
}

/* The rotation vector from the primary axis `to` of frame 1 to that of frame 0, in the axes of frame 0: its first
 * component is 0. For opposite axes, where its direction is undefined, it is 0. */
static void primaryAxisRotation(double axes[3][3], const double to[3], double rotation[3]) {
    const double y = keaDot(axes[1], to), z = keaDot(axes[2], to), sine = keaHypotenuse(y, z);
    const double scale = sine > 0 ? atan2(sine, keaDot(axes[0], to)) / sine : 0;
    rotation[0] = 0;
    rotation[1] = scale * z;
    rotation[2] = -scale * y;
}

static void fillSprings(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclAngular *joint = &c->of.angular;
    double axes[3][3], rotation[3], turn[4], to[3];
    bcl_axes(axes, c, 0, x->pose[0]);
    if (joint->rotates) {
        keaApply(to, x->pose[1]->R, c->frame[1].primary);
        primaryAxisRotation(axes, to, rotation);
    } else {
        bcl_relativeOrientation(turn, c, x->pose, NULL);
        bcl_rotationVector(turn, rotation);
    }
    const int count = countRows(c), first = 3 - count;
    for (int i = 0; i < count; i++) {
        bcl_spinRow(x, axes[first + i], &rows[i]);
        bcl_makeSpring(&rows[i], rotation[first + i], joint->stiffness, joint->damping);
    }
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclAngular *joint = &c->of.angular;
    if (bcl_isSpring(joint->stiffness, joint->damping))
        fillSprings(c, x, rows);
    else if (joint->rotates)
        bcl_alignRows(c, x, rows);
    else
        bcl_orientationRows(c, x, NULL, rows);
}

const MdtBclType bcl_angular3 = {.name = "Angular3",
                                 .maxRows = MdtBclGETMAXROWSANGULAR3,
                                 .reset = reset,
                                 .prepare = prepare,
                                 .fill = fill,
                                 .errors = errors,
                                 .attached = attached,
                                 .axesSet = axesSet,
                                 .degenerate = "its bodies are half a turn away from how they were attached"};
