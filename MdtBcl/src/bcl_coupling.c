/* Gear, Pulley, Mimic: couplings of two coordinates q_0 and q_1 of the bodies.
 *
 *     φ = f_0 q_0 + f_1 q_1 - c,    f factors, c constant
 *
 * A coordinate is that of a moving frame m relative to a base frame b. Each frame is fixed in a body of the constraint,
 * or in the world:
 *
 *     angle      q = atan2(v_m · (a_m x v_b), v_m · v_b),  dq/dt = a_m·(ω_m - ω_b),  full turns counted
 *     slide      q = a_b · (P_m - P_b)
 *     distance   q = |P_m - P_b|
 *
 * with P the position, a the primary and v the second axis of a frame. Gear: two angles, or an angle and the slide of a
 * rack. Pulley: two distances to the points where a rope is turned round; with slack, φ <= 0. Mimic: the coordinates of
 * two other joints, whose frames Mdt copies before each step; it has up to four bodies, and then a split row.
 *
 * The turns are counted from the last measured angle, and the expected change since; so an angle has the rounding of
 * its own size only, however long a shaft spins.
 */
#include "bcl_i.h"
#include <string.h>

/* m: at a smaller distance its direction is undefined, and the last one is used. */
static const double noDistance = 1e-9;

/* ---- frames ---- */

static const MdtKeaTransformation *poseOf(const MdtBclCoordinate *q, int which,
                                          const MdtKeaTransformation *const pose[2]) {
    return q->side[which] == MdtBclNO_SIDE ? &MdtBclWorldPose : pose[q->side[which]];
}

/* The vector from the body's centre of mass to the frame's position, world axes. */
static void armOf(const MdtBclCoordinate *q, int which, const MdtKeaTransformation *const pose[2], double arm[3]) {
    keaApply(arm, poseOf(q, which, pose)->R, q->frame[which].position);
}

/* P_m - P_b */
static void separationOf(const MdtBclCoordinate *q, const MdtKeaTransformation *const pose[2], double d[3]) {
    double base[3];
    armOf(q, 0, pose, d);
    armOf(q, 1, pose, base);
    keaAddScaled(d, 1, poseOf(q, 0, pose)->pos);
    keaAddScaled(base, 1, poseOf(q, 1, pose)->pos);
    keaSubtract(d, d, base);
}

/* A frame's primary axis in the world; unit also where the pose is a mean of two. */
static void axisOf(const MdtBclCoordinate *q, int which, const MdtKeaTransformation *const pose[2], double axis[3]) {
    keaApply(axis, poseOf(q, which, pose)->R, q->frame[which].primary);
    keaScale(axis, 1 / keaLength(axis), axis);
}

/* ---- values ---- */

/* rad; turned: the expected change since the last measurement. */
static double angleOf(const MdtBclCoordinate *q, const MdtKeaTransformation *const pose[2], double turned) {
    double moving[3], base[3], axis[3], across[3];
    keaApply(moving, poseOf(q, 0, pose)->R, q->frame[0].ortho);
    keaApply(base, poseOf(q, 1, pose)->R, q->frame[1].ortho);
    keaApply(axis, poseOf(q, 0, pose)->R, q->frame[0].primary);
    keaCross(across, axis, base);
    const double angle = atan2(keaDot(moving, across), keaDot(moving, base));
    const double turn = 6.283185307179586476925;
    return q->isMeasured ? angle + turn * nearbyint((q->measured + turned - angle) / turn) : angle;
}

static double valueOf(const MdtBclCoordinate *q, const MdtKeaTransformation *const pose[2], double turned) {
    double d[3], axis[3];
    if (q->kind == MdtBclCoordinateAngle)
        return angleOf(q, pose, turned);
    separationOf(q, pose, d);
    if (q->kind == MdtBclCoordinateDistance)
        return keaLength(d);
    axisOf(q, 1, pose, axis);
    return keaDot(axis, d);
}

/* φ at these poses; share: of the expected change of angles. */
static double errorOf(const MdtBclCoupling *u, const MdtKeaTransformation *const pose[2], double share) {
    double sum = -u->constant;
    for (int i = 0; i < 2; i++)
        sum += u->coordinate[i].factor * valueOf(&u->coordinate[i], pose, share * u->coordinate[i].turned);
    return sum;
}

/* ---- rows ---- */

/* The rows of a sum: the row, and the tail that it has if there are more than two sides. */
enum { MAX_ROWS = 2 };

/* Adds a direction d, that acts on body `side` at a lever arm, to the sum. The arm of a sum is the mean by length. */
static void addLinear(MdtKeaRow rows[], int side, double factor, const double d[3], const double arm[3]) {
    double moment[3];
    if (side == MdtBclNO_SIDE || factor == 0)
        return;
    MdtKeaJBlock *J = &rows[side / 2].J[side % 2];
    double *mean = rows[side / 2].arm[side % 2];
    const double before = keaLength(J->lin), share = fabs(factor) / (before + fabs(factor));
    keaCross(moment, arm, d);
    keaAddScaled(J->lin, factor, d);
    keaAddScaled(J->ang, factor, moment);
    keaScale(mean, 1 - share, mean);
    keaAddScaled(mean, share, arm);
}

static void addAngular(MdtKeaRow rows[], int side, double factor, const double axis[3]) {
    if (side != MdtBclNO_SIDE)
        keaAddScaled(rows[side / 2].J[side % 2].ang, factor, axis);
}

/* If d is fixed in the base's body, the lever arm there ends at the moving frame (bcl_alongRow). */
static void addAlong(MdtKeaRow rows[], const MdtBclCoordinate *q, const MdtBclContext *x, double factor,
                     const double d[3]) {
    double arm[3], separation[3];
    armOf(q, 0, x->pose, arm);
    addLinear(rows, q->side[0], factor, d, arm);
    armOf(q, 1, x->pose, arm);
    separationOf(q, x->pose, separation);
    if (q->kind == MdtBclCoordinateSlide)
        keaAddScaled(arm, 1, separation);
    addLinear(rows, q->side[1], -factor, d, arm);
}

/* The unit direction of a distance. */
static void directionOf(const MdtBclCoordinate *q, const MdtKeaTransformation *const pose[2], double d[3]) {
    separationOf(q, pose, d);
    const double length = keaLength(d);
    if (length < noDistance)
        keaCopy(d, q->direction);
    else
        keaScale(d, 1 / length, d);
}

/* Adds `factor` times the coordinate's Jacobian to the sum. */
static void addCoordinate(MdtKeaRow rows[], const MdtBclCoordinate *q, const MdtBclContext *x, double factor) {
    double d[3];
    if (q->kind == MdtBclCoordinateDistance)
        directionOf(q, x->pose, d);
    else
        axisOf(q, q->kind == MdtBclCoordinateAngle ? 0 : 1, x->pose, d);
    if (q->kind != MdtBclCoordinateAngle) {
        addAlong(rows, q, x, factor, d);
        return;
    }
    addAngular(rows, q->side[0], factor, d);
    addAngular(rows, q->side[1], -factor, d);
}

static MeBool hasTail(const MdtBclCoupling *u) {
    return u->numSides > 2;
}

static void startRows(const MdtBclCoupling *u, const MdtBclContext *x, MdtKeaRow rows[]) {
    bcl_startRow(&rows[0], x);
    if (!hasTail(u))
        return;
    rows[0].isSplit = METRUE;
    rows[1] = rows[0];
    rows[1].isSplit = MEFALSE;
    rows[1].isTail = rows[1].position = METRUE;
    rows[1].lower = rows[1].upper = 0;
    for (int k = 0; k < 2; k++)
        rows[1].body[k] = 2 + k < u->numSides ? x->body[2 + k] : MdtBclNO_BODY;
}

/* The row of the sum, and its tail. */
static void sumRows(const MdtBclCoupling *u, const MdtBclContext *x, MdtKeaRow rows[]) {
    startRows(u, x, rows);
    for (int i = 0; i < 2; i++)
        addCoordinate(rows, &u->coordinate[i], x, u->coordinate[i].factor);
}

/* m/s or rad/s: the rate of a row and its tail. */
static double rateOf(const MdtBclCoupling *u, const MdtBclContext *x, const MdtKeaRow rows[]) {
    double rate = 0;
    for (int k = 0; k < u->numSides; k++) {
        const MdtKeaJBlock *J = &rows[k / 2].J[k % 2];
        rate += keaDot(J->lin, x->velocity[k]->lin) + keaDot(J->ang, x->velocity[k]->ang);
    }
    return rate;
}

/* rad: the change of an angle in a sub-step with the present velocities. Rotations in a step are Cayley maps. */
static double changeOf(const MdtBclCoupling *u, const MdtBclCoordinate *q, const MdtBclContext *x) {
    MdtKeaRow rows[MAX_ROWS];
    if (q->kind != MdtBclCoordinateAngle)
        return 0;
    startRows(u, x, rows);
    addCoordinate(rows, q, x, 1);
    return 2 * atan(0.5 * rateOf(u, x, rows) * x->parameters.stepsize);
}

/* ---- all couplings ---- */

static void reset(MdtBclConstraint *c) {
    MdtBclCoupling *u = &c->of.coupling;
    bcl_resetFrames(c);
    memset(u, 0, sizeof *u);
    MdtBclLimitReset(&u->slack);
    u->slack.bActive = METRUE;
    u->slack.limit[0].stop = -MEINFINITY;
    u->slack.limit[1].restitution = 0;
    u->housing = MdtBclNO_SIDE;
    u->numSides = 2;
    for (int k = 0; k < 2; k++) {
        u->coordinate[k] = (MdtBclCoordinate){.side = {k, MdtBclNO_SIDE}, .factor = 1, .direction = {1, 0, 0}};
        u->coordinate[k].frame[0] = u->coordinate[k].frame[1] = c->frame[k];
    }
}

/* Gear, Pulley: the constraint's frames are the moving ones. */
static void useFrames(MdtBclConstraint *c) {
    for (int k = 0; c->type != MdtBclMIMIC && k < 2; k++)
        c->of.coupling.coordinate[k].frame[0] = c->frame[k];
}

static void measure(MdtBclCoordinate *q, const MdtBclContext *x, double turned) {
    q->measured = valueOf(q, x->pose, turned);
    q->isMeasured = METRUE;
    if (q->kind == MdtBclCoordinateDistance)
        directionOf(q, x->pose, q->direction);
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    MdtBclCoupling *u = &c->of.coupling;
    MdtKeaRow rows[MAX_ROWS];
    useFrames(c);
    for (int k = 0; k < 2; k++) {
        measure(&u->coordinate[k], x, 0);
        u->coordinate[k].turned = changeOf(u, &u->coordinate[k], x);
    }
    if (!u->isSlack)
        return hasTail(u) ? 2 : 1;
    sumRows(u, x, rows);
    return bcl_limitPrepare(&u->slack, x, rows, errorOf(u, x->pose, 0));
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    const MdtBclCoupling *u = &c->of.coupling;
    if (u->isSlack)
        bcl_limitErrors(&u->slack, errorOf(u, pose, 1), e);
    else
        e[0] = errorOf(u, pose, 1);
    if (hasTail(u))
        e[1] = 0;
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclCoupling *u = &c->of.coupling;
    if (u->isSlack) {
        MdtKeaRow sum[MAX_ROWS];
        sumRows(u, x, sum);
        bcl_limitFill(&u->slack, x, sum, 0, rows);
        return;
    }
    sumRows(u, x, rows);
    bcl_makePosition(&rows[0], x, errorOf(u, x->pose, 0));
}

static void readBack(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]) {
    MdtBclCoupling *u = &c->of.coupling;
    MdtKeaRow sum[MAX_ROWS];
    for (int k = 0; k < 2; k++)
        measure(&u->coordinate[k], x, changeOf(u, &u->coordinate[k], x));
    sumRows(u, x, sum);
    if (u->isSlack)
        bcl_limitReadBack(&u->slack, errorOf(u, x->pose, 0), rateOf(u, x, sum), rows);
}

double MEAPI MdtBclCouplingError(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    MdtBclConstraint copy = *c;
    useFrames(&copy);
    return errorOf(&copy.of.coupling, pose, 0);
}

double MEAPI MdtBclCouplingCoordinate(const MdtBclConstraint *c, int which, const MdtKeaTransformation *const pose[2]) {
    MdtBclConstraint copy = *c;
    MEASSERT(which == 0 || which == 1);
    useFrames(&copy);
    return valueOf(&copy.of.coupling.coordinate[which], pose, 0);
}

/* ---- Gear ---- */

/* Sets the base frame of a coordinate to the moving one at these poses. */
static void matchBase(MdtBclCoordinate *q, const MdtKeaTransformation *const pose[2]) {
    const MdtKeaTransformation *moving = poseOf(q, 0, pose), *base = poseOf(q, 1, pose);
    double v[3];
    keaApply(v, moving->R, q->frame[0].primary);
    keaApplyTransposed(q->frame[1].primary, base->R, v);
    keaApply(v, moving->R, q->frame[0].ortho);
    keaApplyTransposed(q->frame[1].ortho, base->R, v);
    armOf(q, 0, pose, v);
    keaAddScaled(v, 1, moving->pos);
    keaSubtract(v, v, base->pos);
    keaApplyTransposed(q->frame[1].position, base->R, v);
}

void MEAPI MdtBclGearEngage(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    MdtBclCoupling *u = &c->of.coupling;
    useFrames(c);
    for (int k = 0; k < 2; k++) {
        MdtBclCoordinate *q = &u->coordinate[k];
        q->side[1] = u->housing == k ? MdtBclNO_SIDE : u->housing;
        matchBase(q, pose);
        q->isMeasured = MEFALSE;
        q->measured = q->turned = 0;
    }
}

static void gearAxesSet(MdtBclConstraint *c, const MdtBclFrame before[2], const MdtKeaTransformation *const pose[2]) {
    (void)before;
    MdtBclGearEngage(c, pose);
}

const MdtBclType bcl_gear = {.name = "Gear",
                             .maxRows = MdtBclGETMAXROWSGEAR,
                             .reset = reset,
                             .prepare = prepare,
                             .fill = fill,
                             .errors = errors,
                             .readBack = readBack,
                             .positioned = MdtBclGearEngage,
                             .axesSet = gearAxesSet};

/* ---- Pulley ---- */

static void resetPulley(MdtBclConstraint *c) {
    reset(c);
    for (int k = 0; k < 2; k++)
        c->of.coupling.coordinate[k].kind = MdtBclCoordinateDistance;
}

/* The length is that at the time of attachment, unless the program has set one. */
static void pulleyPositioned(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    MdtBclCoupling *u = &c->of.coupling;
    useFrames(c);
    if (!u->lengthIsSet)
        u->constant += errorOf(u, pose, 0);
}

static int preparePulley(MdtBclConstraint *c, const MdtBclContext *x) {
    const int rows = prepare(c, x);
    c->isDegenerate = MEFALSE;
    for (int k = 0; k < 2; k++)
        c->isDegenerate |= x->body[k] != MdtBclNO_BODY && c->of.coupling.coordinate[k].measured < noDistance;
    return rows;
}

const MdtBclType bcl_pulley = {.name = "Pulley",
                               .maxRows = MdtBclGETMAXROWSPULLEY,
                               .reset = resetPulley,
                               .prepare = preparePulley,
                               .fill = fill,
                               .errors = errors,
                               .readBack = readBack,
                               .positioned = pulleyPositioned,
                               .degenerate = "an end of its rope is at its wheel, which gives it no direction"};

/* ---- Mimic ---- */

static void resetMimic(MdtBclConstraint *c) {
    reset(c);
    c->of.coupling.coordinate[0].factor = -1;
}

static int prepareMimic(MdtBclConstraint *c, const MdtBclContext *x) {
    c->isDegenerate = !c->of.coupling.isReady;
    return c->isDegenerate ? 0 : prepare(c, x);
}

static void mimicErrors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    if (c->of.coupling.isReady)
        errors(c, pose, e);
}

static void readBackMimic(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]) {
    if (c->of.coupling.isReady)
        readBack(c, x, rows);
}

const MdtBclType bcl_mimic = {.name = "Mimic",
                              .maxRows = MdtBclGETMAXROWSMIMIC,
                              .reset = resetMimic,
                              .prepare = prepareMimic,
                              .fill = fill,
                              .errors = mimicErrors,
                              .readBack = readBackMimic,
                              .degenerate =
                                  "a joint that it couples is disabled, destroyed or attached to other bodies"};
