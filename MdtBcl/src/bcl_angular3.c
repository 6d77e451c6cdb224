/* Angular3: the bodies keep their orientation to each other and are free to move (Dynamics guide ch. 3, "MdtAngular3").
 *
 * Three rows of the turn between the frames (bcl_turnRows). With the rotation enabled it is Angular2: the two rows that
 * hold the primary axes together, as in a hinge. With finite stiffness and damping the rows are damped springs.
 */
#include "bcl_i.h"

static void reset(MdtBclConstraint *c) {
    bcl_resetFrames(c);
    c->of.angular = (MdtBclAngular){.stiffness = MEINFINITY, .damping = MEINFINITY};
}

/* The orientation that the bodies have when they are attached is the one to keep. */
static void attached(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    bcl_matchAxes(c, pose);
}

/* Axes that were set later name the axis of rotation and leave that orientation: frame 1 turns within its body as frame
 * 0 has within its own, F_1' = F_1 F_0ᵀ F_0'. */
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

static int countOf(const MdtBclConstraint *c) {
    return c->of.angular.rotates ? 2 : 3;
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    double turn[4];
    bcl_turnBetween(turn, c, x->pose, NULL);
    c->isDegenerate = !c->of.angular.rotates && bcl_isHalfATurn(turn);
    return countOf(c);
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    if (c->of.angular.rotates)
        bcl_alignErrors(c, pose, e);
    else
        bcl_turnErrors(c, pose, NULL, e);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclAngular *joint = &c->of.angular;
    if (joint->rotates)
        bcl_alignRows(c, x, rows);
    else
        bcl_turnRows(c, x, NULL, rows);
    if (!bcl_isSpring(joint->stiffness, joint->damping))
        return;
    for (int i = 0; i < countOf(c); i++) {
        rows[i].position = MEFALSE;
        rows[i].target = 0;
        bcl_makeSpring(&rows[i], rows[i].error, joint->stiffness, joint->damping);
    }
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
