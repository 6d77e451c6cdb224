/* Spring6: six springs between the attachment frames (User Guide ch. 3 names it a configurable compliance).
 *
 *     φ_1..3 = e_i·(P_0 - P_1), e_i the axes of frame 1,   φ_4..6: the rotation vector between the frames, along e_i.
 *
 * Each spring has a stiffness and a damping. With both 0 it has no row; with either infinite its direction is rigid.
 */
#include "bcl_i.h"
#include <string.h>

static void reset(MdtBclConstraint *c) {
    bcl_resetFrames(c);
    memset(&c->of.springs, 0, sizeof c->of.springs);
}

/* Whether the spring of direction i, 0 to 5, has a row. */
static MeBool hasRow(const MdtBclSprings *s, int i) {
    return s->stiffness[i] > 0 || s->damping[i] > 0;
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    int count[2] = {0, 0}; /* linear, angular */
    for (int i = 0; i < 6; i++)
        count[i / 3] += hasRow(&c->of.springs, i);
    c->isDegenerate = count[1] > 0 && bcl_isNearHalfTurn(c, x, NULL);
    return count[0] + count[1];
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    double all[6];
    bcl_axisErrors(c, pose, 0, 3, all);
    bcl_orientationErrors(c, pose, NULL, all + 3);
    for (int i = 0, n = 0; i < 6; i++)
        if (hasRow(&c->of.springs, i))
            e[n++] = all[i];
}

/* The six rows along and about the axes of frame 1, and the strains of their springs, m or rad. */
static void springRows(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[6], double strain[6]) {
    double axes[3][3], turn[4];
    bcl_axes(axes, c, 1, x->pose[1]);
    bcl_axisErrors(c, x->pose, 0, 3, strain);
    bcl_relativeOrientation(turn, c, x->pose, NULL);
    bcl_rotationVector(turn, strain + 3);
    for (int i = 0; i < 3; i++) {
        bcl_alongRow(c, x, axes[i], 1, &rows[i]);
        bcl_spinRow(x, axes[i], &rows[3 + i]);
    }
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclSprings *s = &c->of.springs;
    MdtKeaRow spring[6], locked[3];
    double strain[6];
    springRows(c, x, spring, strain);
    bcl_orientationRows(c, x, NULL, locked);
    for (int i = 0, n = 0; i < 6; i++) {
        if (!hasRow(s, i))
            continue;
        MdtKeaRow *row = &rows[n++];
        *row = spring[i];
        if (bcl_isSpring(s->stiffness[i], s->damping[i]))
            bcl_makeSpring(row, strain[i], s->stiffness[i], s->damping[i]);
        else if (i < 3)
            bcl_makePosition(row, x, strain[i]);
        else
            *row = locked[i - 3];
    }
}

const MdtBclType bcl_spring6 = {.name = "Spring6",
                                .maxRows = MdtBclGETMAXROWSSPRING6,
                                .reset = reset,
                                .prepare = prepare,
                                .fill = fill,
                                .errors = errors,
                                .degenerate = "its frames are half a turn apart"};
