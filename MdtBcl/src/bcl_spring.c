/* Spring: constrains the distance of the attachment points as a rod, a string or a spring does (Dynamics guide ch. 3,
 * "MdtSpring").
 *
 *     φ = |P_0 - P_1| - l,   J_0 = [n, r_0 x n],   J_1 = -[n, r_1 x n],   n the direction from P_1 to P_0.
 *
 * The distance is the coordinate of a limit. Both stops hard and at the same length: a rod, φ = 0. Both soft and at the
 * same length: a damped spring, with the stiffness and damping of the upper stop above this length, and of the lower
 * one below it. Anything else, such as a string or an elastic, one of whose stops has no force: the limit itself, with
 * hard stops as position rows, as n changes with the bodies. The limit's motor or lock has a row of its own, before
 * these; a rod has none.
 */
#include "bcl_i.h"
#include <string.h>

/* m: at a smaller distance n is undefined, and its last value is used. */
static const double noLength = 1e-9;

static void reset(MdtBclConstraint *c) {
    MdtBclDistance *s = &c->of.distance;
    bcl_resetFrames(c);
    memset(s, 0, sizeof *s);
    MdtBclLimitReset(&s->limit);
    s->limit.bActive = METRUE;
    for (int side = 0; side < 2; side++) {
        s->limit.limit[side].stiffness = (MeReal)MDTBCL_SPRING_STIFFNESS;
        s->limit.limit[side].damping = (MeReal)MDTBCL_SPRING_DAMPING;
    }
    s->direction[0] = 1;
}

static double distanceOf(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    double d[3];
    bcl_separation(c, pose, d);
    return keaLength(d);
}

/* The rest length is the distance at the time of attachment, unless the program has set one. */
static void positioned(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    MdtBclDistance *s = &c->of.distance;
    if (s->lengthIsSet)
        return;
    s->limit.limit[0].stop = s->limit.limit[1].stop = (MeReal)distanceOf(c, pose);
}

/* Whether a soft stop has a force. */
static MeBool hasForce(const MdtBclSingleLimit *stop) {
    return stop->stiffness > 0 || stop->damping > 0;
}

static MdtBclDistanceKind kindOf(const MdtBclLimit *limit) {
    const MeBool isOneLength = limit->limit[0].stop == limit->limit[1].stop && limit->bActive;
    if (isOneLength && bcl_isStopHard(limit, 0) && bcl_isStopHard(limit, 1))
        return MdtBclDistanceRod;
    const MeBool isElastic = !hasForce(&limit->limit[0]) || !hasForce(&limit->limit[1]);
    if (isOneLength && !bcl_isStopHard(limit, 0) && !bcl_isStopHard(limit, 1) && !isElastic)
        return MdtBclDistanceSpring;
    return MdtBclDistanceLimits;
}

/* The row of the distance. */
static void distanceRow(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow *row) {
    double d[3];
    bcl_separation(c, x->pose, d);
    const double length = keaLength(d);
    if (length < noLength)
        keaCopy(d, c->of.distance.direction);
    else
        keaScale(d, 1 / length, d);
    MEASSERT(!isfinite(length) || bcl_isUnit(d)); /* not finite: a pose has overflowed */
    bcl_alongRow(c, x, d, NO_CARRIER, row);
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    MdtBclDistance *s = &c->of.distance;
    MdtKeaRow row;
    double d[3];
    bcl_separation(c, x->pose, d);
    s->length = keaLength(d);
    c->isDegenerate = s->length < noLength;
    if (!c->isDegenerate)
        keaScale(s->direction, 1 / s->length, d);
    distanceRow(c, x, &row);
    s->kind = kindOf(&s->limit);
    const int count = bcl_limitPrepare(&s->limit, x, &row, s->length);
    if (s->kind == MdtBclDistanceLimits)
        return count;
    return 1 + bcl_limitKeepMotor(&s->limit, s->kind == MdtBclDistanceSpring);
}

/* m: the length beyond the rest length. */
static double strain(const MdtBclLimit *limit, double length) {
    return length + (double)limit->offset - (double)limit->limit[0].stop;
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    const MdtBclDistance *s = &c->of.distance;
    if (s->kind == MdtBclDistanceRod)
        e[0] = strain(&s->limit, distanceOf(c, pose));
    else
        bcl_limitErrors(&s->limit, distanceOf(c, pose), e);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclDistance *s = &c->of.distance;
    MdtKeaRow row;
    distanceRow(c, x, &row);
    const double e = strain(&s->limit, s->length);
    bcl_limitFill(&s->limit, x, &row, 0, rows);
    rows += bcl_limitRows(&s->limit);
    if (s->kind == MdtBclDistanceRod) {
        *rows = row;
        bcl_makePosition(rows, x, e);
    } else if (s->kind == MdtBclDistanceSpring) {
        const MdtBclSingleLimit *side = &s->limit.limit[e > 0];
        *rows = row;
        bcl_makeSpring(rows, e, side->stiffness, side->damping);
    }
}

static void readBack(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]) {
    MdtBclDistance *s = &c->of.distance;
    MdtKeaRow row;
    distanceRow(c, x, &row);
    bcl_limitReadBack(&s->limit, distanceOf(c, x->pose), bcl_rate(&row, x->velocity), rows);
}

const MdtBclType bcl_spring = {.name = "Spring",
                               .maxRows = MdtBclGETMAXROWSSPRING,
                               .reset = reset,
                               .prepare = prepare,
                               .fill = fill,
                               .errors = errors,
                               .readBack = readBack,
                               .positioned = positioned,
                               .degenerate = "its two ends coincide and give it no direction"};
