/* Spring6: six springs between the attachment frames (User Guide ch. 3 names it a configurable compliance).
 *
 *     φ_1..3 = e_i·(P_0 - P_1), e_i the axes of frame 1,   φ_4..6: the rotation vector between the frames, along e_i.
 *
 * from a target that may move: its position along e_i is subtracted, and the rotation is the one from its orientation,
 * about its axes. Each spring has a stiffness and a damping. With both 0 it has no row; with either infinite its
 * direction is rigid. A direction with a position motor (bcl_servo.c) has its row instead.
 */
#include "bcl_i.h"
#include <string.h>

static void reset(MdtBclConstraint *c) {
    MdtBclSprings *s = &c->of.springs;
    bcl_resetFrames(c);
    memset(s, 0, sizeof *s);
    for (int i = 0; i < 6; i++)
        s->motor[i] = (MdtBclServo){.dampingRatio = 1, .force = MEINFINITY};
    bcl_resetTurn(&s->target);
}

/* Whether the direction i, 0 to 5, has a row: its motor's or, without a motor, that of its spring. */
static MeBool hasRow(const MdtBclSprings *s, int i) {
    if (s->motor[i].frequency > 0)
        return bcl_isServo(&s->motor[i]);
    return s->stiffness[i] > 0 || s->damping[i] > 0;
}

static MeBool isRigid(const MdtBclSprings *s, int i) {
    return !(s->motor[i].frequency > 0) && !bcl_isSpring(s->stiffness[i], s->damping[i]);
}

/* Sets the rates of the angular rows due to the target's angular velocity: of springs, and of rigid directions. */
static void setTurnRates(MdtBclConstraint *c, const MdtBclContext *x) {
    MdtBclSprings *s = &c->of.springs;
    double turn[4], rate[3];
    bcl_relativeOrientation(turn, c, x->pose, s->now);
    bcl_turnVelocity(s->now, s->target.velocity, s->rate);
    bcl_orientationRate(turn, s->now, s->target.velocity, rate);
    for (int i = 0; i < 3; i++)
        if (isRigid(s, 3 + i))
            s->rate[i] = rate[i];
    keaScale(s->rotation, x->parameters.stepsize, rate);
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    MdtBclSprings *s = &c->of.springs;
    int count[2] = {0, 0}; /* linear, angular */
    for (int i = 0; i < 6; i++)
        count[i / 3] += hasRow(s, i);
    keaCopy(s->place, s->position);
    keaAddScaled(s->place, x->elapsed, s->velocity);
    bcl_turnAfter(s->target.quaternion, s->target.velocity, x->elapsed, s->now);
    bcl_turnAfter(s->target.quaternion, s->target.velocity, x->elapsed + x->parameters.stepsize, s->then);
    setTurnRates(c, x);
    c->isDegenerate = count[1] > 0 && bcl_isNearHalfTurn(c, x, s->now);
    return count[0] + count[1];
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    const MdtBclSprings *s = &c->of.springs;
    double all[6];
    bcl_axisErrors(c, pose, 0, 3, all);
    keaAddScaled(all, -1, s->place);
    bcl_orientationErrors(c, pose, s->then, all + 3);
    keaAddScaled(all + 3, 1, s->rotation);
    for (int i = 0, n = 0; i < 6; i++)
        if (hasRow(s, i))
            e[n++] = all[i];
}

/* The six rows along the axes of frame 1 and about those of the target, and the strains of their springs, m or rad. */
static void springRows(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[6], double strain[6]) {
    const MdtBclSprings *s = &c->of.springs;
    double axes[3][3], about[3][3], turn[4];
    bcl_axes(axes, c, 1, x->pose[1]);
    bcl_targetAxes(about, c, x->pose[1], s->now);
    bcl_axisErrors(c, x->pose, 0, 3, strain);
    keaAddScaled(strain, -1, s->place);
    bcl_relativeOrientation(turn, c, x->pose, s->now);
    bcl_rotationVector(turn, strain + 3);
    for (int i = 0; i < 3; i++) {
        bcl_alongRow(c, x, axes[i], 1, &rows[i]);
        bcl_spinRow(x, about[i], &rows[3 + i]);
    }
}

/* Copies the rigid directions' rows to `rigid`. Returns their number. */
static int copyRigid(const MdtBclSprings *s, const MdtKeaRow rows[6], MdtKeaRow rigid[6]) {
    int count = 0;
    for (int i = 0; i < 6; i++)
        if (isRigid(s, i))
            rigid[count++] = rows[i];
    return count;
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclSprings *s = &c->of.springs;
    MdtKeaRow spring[6], locked[3], rigid[6];
    double strain[6];
    springRows(c, x, spring, strain);
    bcl_orientationRows(c, x, s->now, locked);
    const int count = copyRigid(s, spring, rigid);
    for (int i = 0, n = 0; i < 6; i++) {
        if (!hasRow(s, i))
            continue;
        MdtKeaRow *row = &rows[n++];
        const double rate = i < 3 ? s->velocity[i] : s->rate[i - 3];
        *row = spring[i];
        if (s->motor[i].frequency > 0)
            bcl_makeServo(row, x, &s->motor[i], strain[i], rate, bcl_effectiveMass(x, rigid, count, row));
        else if (!isRigid(s, i))
            bcl_makeSpring(row, strain[i], s->stiffness[i], s->damping[i]);
        else if (i < 3)
            bcl_makePosition(row, x, strain[i]);
        else
            *row = locked[i - 3];
        if (!(s->motor[i].frequency > 0)) {
            row->target += rate;
            row->drift += rate;
        }
    }
}

const MdtBclType bcl_spring6 = {.name = "Spring6",
                                .maxRows = MdtBclGETMAXROWSSPRING6,
                                .reset = reset,
                                .prepare = prepare,
                                .fill = fill,
                                .errors = errors,
                                .degenerate = "its frames are half a turn apart"};
