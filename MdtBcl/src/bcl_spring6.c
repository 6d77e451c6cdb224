/* Spring6: six springs between the attachment frames (User Guide ch. 3 names it a configurable compliance).
 *
 *     φ_1..3 = e_i·(P_0 - P_1), e_i the axes of frame 1,   φ_4..6: the turn between the frames (bcl_turnRows).
 *
 * Each has its stiffness and damping. One without either has no row; one of infinite stiffness is held.
 */
#include "bcl_i.h"
#include <string.h>

static void reset(MdtBclConstraint *c) {
    bcl_resetFrames(c);
    memset(&c->of.springs, 0, sizeof c->of.springs);
}

static MeBool acts(const MdtBclSprings *s, int i) {
    return s->stiffness[i] > 0 || s->damping[i] > 0;
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    double turn[4];
    int count[2] = {0, 0}; /* linear, angular */
    for (int i = 0; i < 6; i++)
        count[i / 3] += acts(&c->of.springs, i);
    bcl_turnBetween(turn, c, x->pose, NULL);
    c->isDegenerate = count[1] > 0 && bcl_isHalfATurn(turn);
    return count[0] + count[1];
}

static void allErrors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[6]) {
    double axes[3][3], d[3];
    bcl_axes(axes, c, 1, pose[1]);
    bcl_separation(c, pose, d);
    for (int i = 0; i < 3; i++)
        e[i] = keaDot(axes[i], d);
    bcl_turnErrors(c, pose, NULL, e + 3);
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    double all[6];
    allErrors(c, pose, all);
    for (int i = 0, n = 0; i < 6; i++)
        if (acts(&c->of.springs, i))
            e[n++] = all[i];
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclSprings *s = &c->of.springs;
    MdtKeaRow all[6];
    double axes[3][3], e[6];
    bcl_axes(axes, c, 1, x->pose[1]);
    allErrors(c, x->pose, e);
    for (int i = 0; i < 3; i++)
        bcl_alongRow(c, x, axes[i], 1, &all[i]);
    bcl_turnRows(c, x, NULL, all + 3);
    for (int i = 0, n = 0; i < 6; i++) {
        if (!acts(s, i))
            continue;
        MdtKeaRow *row = &rows[n++];
        *row = all[i];
        row->position = MEFALSE;
        row->target = 0;
        if (bcl_isSpring(s->stiffness[i], s->damping[i]))
            bcl_makeSpring(row, e[i], s->stiffness[i], s->damping[i]);
        else
            bcl_aimAtZero(row, x, e[i]);
    }
}

const MdtBclType bcl_spring6 = {.name = "Spring6",
                                .maxRows = MdtBclGETMAXROWSSPRING6,
                                .reset = reset,
                                .prepare = prepare,
                                .fill = fill,
                                .errors = errors,
                                .degenerate = "its frames are half a turn apart"};
