/* GroundWheel: a wheel without a body, between a chassis, body 0, and a plane of the ground, body 1 or the world
 * (MstVehicle).
 *
 * s is the primary axis of frame 0, up along the suspension, f its second axis, along which the wheel rolls; a its
 * position, where the wheel's centre is at suspension length 0; n and p are the primary axis and the position of frame
 * 1, the plane. With d the distance of the centre from the plane, the wheel touches the plane at q:
 *     L = (n·(a - p) - d) / (n·s),   q = a - L s - d t / (n·t)
 * where t is s for a ray, n for a sphere, and n without its part along the axle for a disc
 *     spring: the force -k (L - l) - c dL/dt, which only pushes, along n / (n·s): the gradient of L at q
 *     stop:   L >= low
 *     along x, the intersection of wheel plane and ground, and along y = n x x, tyre forces F within bounds:
 *         v_x⁺ - R ω⁺ = -C_x F_x,   v_y⁺ = -C_y F_y          v: of the chassis at q, relative to the ground
 *     bar:    the force -k ((L - l) - (L - l of the other wheel)) of an anti-roll bar, on both
 *     lean:   the torque -k φ - c (dφ/dt - rate) about f, φ the lean of a motorcycle to the left; off the ground, too
 *
 * The wheel's spin ω, relative to the chassis, obeys I (ω⁺ - ω) = h (T - R F_x), T the torque of engine and brake.
 * Eliminated, it is a compliance: v_x⁺ = R (ω + h T/I) - h (R²/I + C_x/h) F_x. A wheel that its brake stops has ω⁺ = 0,
 * and F_x is such that the brake can do so.
 */
#include "bcl_i.h"
#include <string.h>

static const double fastest = 1e7; /* rad/s, m/s: of wheels with any parameters */

enum { SPRING = 1, STOP = 2, TYRE = 4, LEAN = 8, BAR = 16 };

static void reset(MdtBclConstraint *c) {
    static const MdtBclFrame standard = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
    c->frame[0] = c->frame[1] = standard;
    memset(&c->of.groundWheel, 0, sizeof c->of.groundWheel);
    c->of.groundWheel.radius = c->of.groundWheel.inertia = 1;
}

/* The frames of a wheel in the world, and the centres of mass of chassis and ground. */
typedef struct Place {
    double s[3], f[3], a[3], n[3], p[3], centre[2][3];
} Place;

/* Where the wheel touches the plane. */
typedef struct Touch {
    double n[3], q[3], arm[2][3]; /* arm: from the centres to q */
    double slope, length;         /* n·s, L */
    MeBool isFar;                 /* of a trial pose that is no wheel's: nothing acts */
} Touch;

static void placeAt(const MdtBclFrame frame[2], const MdtKeaTransformation *const pose[2], Place *at) {
    keaApply(at->s, pose[0]->R, frame[0].primary);
    keaApply(at->f, pose[0]->R, frame[0].ortho);
    keaApply(at->a, pose[0]->R, frame[0].position);
    keaAddScaled(at->a, 1, pose[0]->pos);
    keaApply(at->n, pose[1]->R, frame[1].primary);
    keaApply(at->p, pose[1]->R, frame[1].position);
    keaAddScaled(at->p, 1, pose[1]->pos);
    keaCopy(at->centre[0], pose[0]->pos);
    keaCopy(at->centre[1], pose[1]->pos);
}

/* Turns a vector by the Cayley map of the rotation vector 2 u. */
static void turn(const double u[3], double v[3]) {
    const double share = 2 / (1 + keaDot(u, u));
    double once[3], twice[3];
    keaCross(once, u, v);
    keaCross(twice, u, once);
    keaAddScaled(v, share, once);
    keaAddScaled(v, share, twice);
}

/* Moves a point that is fixed in a body: its centre is displaced, and the body turns by that rotation. */
static void carry(const double centre[3], const double displacement[3], const double u[3], double point[3]) {
    double arm[3];
    keaSubtract(arm, point, centre);
    turn(u, arm);
    keaCopy(point, centre);
    keaAddScaled(point, 1, displacement);
    keaAddScaled(point, 1, arm);
}

/* Where all is after the step if bodies have the accelerations of the last one, with θ of their displacement. */
static void advance(const MdtBclContext *x, double theta, Place *at) {
    const double h = x->parameters.stepsize;
    for (int k = 0; k < 2; k++) {
        double displacement[3], u[3];
        keaScale(displacement, h, x->velocity[k]->lin);
        keaScale(u, h / 2, x->velocity[k]->ang);
        if (x->kea[k]) {
            keaAddScaled(displacement, theta * h * h, x->kea[k]->acceleration);
            keaAddScaled(u, theta * h * h / 2, x->kea[k]->acceleration + 3);
        }
        if (keaDot(displacement, displacement) + keaDot(u, u) == 0)
            continue;
        carry(at->centre[k], displacement, u, k == 0 ? at->a : at->p);
        keaAddScaled(at->centre[k], 1, displacement);
        turn(u, k == 0 ? at->s : at->n);
        if (k == 0)
            turn(u, at->f);
    }
}

static void setMean(double mean[3], const double a[3], const double b[3]) {
    for (int i = 0; i < 3; i++)
        mean[i] = 0.5 * (a[i] + b[i]);
}

static void meanPlace(const Place *a, const Place *b, Place *mean) {
    setMean(mean->s, a->s, b->s);
    setMean(mean->f, a->f, b->f);
    setMean(mean->a, a->a, b->a);
    setMean(mean->n, a->n, b->n);
    setMean(mean->p, a->p, b->p);
    setMean(mean->centre[0], a->centre[0], b->centre[0]);
    setMean(mean->centre[1], a->centre[1], b->centre[1]);
}

static double slopeOf(const Place *at) {
    static const double minSlope = 0.05;
    return keaMax(keaDot(at->n, at->s), minSlope);
}

static double lengthOf(const Place *at, double d) {
    double from[3];
    keaSubtract(from, at->a, at->p);
    return (keaDot(at->n, from) - d) / slopeOf(at);
}

/* reach, m: lever arms are no longer than that allows, where trial poses are far from the ground. */
static void touchAt(const Place *at, double d, MdtBclWheelShape shape, double reach, Touch *w) {
    static const double minSlope = 0.05, farthest = 1e3;
    const double *t = shape == MdtBclWheelRay ? at->s : at->n;
    double axle[3], across[3];
    w->slope = slopeOf(at);
    w->length = lengthOf(at, d);
    w->isFar = !(fabs(w->length) < farthest * reach);
    keaCopy(w->n, at->n);
    keaCopy(w->q, at->a);
    keaAddScaled(w->q, -keaMin(keaMax(w->length, -reach), reach), at->s);
    if (shape == MdtBclWheelDisc) {
        keaCross(axle, at->s, at->f);
        keaCopy(across, at->n);
        keaAddScaled(across, -keaDot(at->n, axle), axle);
        t = across;
    }
    keaAddScaled(w->q, -d / keaMax(keaDot(at->n, t), minSlope), t);
    for (int k = 0; k < 2; k++)
        keaSubtract(w->arm[k], w->q, at->centre[k]);
}

static double reachOf(const MdtBclGroundWheel *g) {
    return 4 * (g->radius + fabs(g->freeLength));
}

static void touch(const MdtBclGroundWheel *g, const Place *at, Touch *w) {
    touchAt(at, g->distance, g->shape, reachOf(g), w);
}

/* Adds to a row the chassis' motion at q relative to the ground, along a direction. */
static void addGroundRow(const Touch *w, const double direction[3], double factor, MdtKeaRow *row) {
    for (int k = 0; k < 2; k++) {
        double lin[3], ang[3];
        keaScale(lin, w->isFar ? 0 : k == 0 ? factor : -factor, direction);
        keaCross(ang, w->arm[k], lin);
        keaAddScaled(row->J[k].lin, 1, lin);
        keaAddScaled(row->J[k].ang, 1, ang);
    }
}

static void groundRow(const MdtBclContext *x, const Touch *w, const double direction[3], double factor,
                      MdtKeaRow *row) {
    bcl_startRow(row, x);
    addGroundRow(w, direction, factor, row);
    keaCopy(row->arm[0], w->arm[0]);
    keaCopy(row->arm[1], w->arm[1]);
}

/* m/s: the rate of L at these velocities. */
static double lengthRate(const Touch *w, const MdtKeaVelocity *const velocity[2]) {
    double rate = 0;
    for (int k = 0; k < 2 && !w->isFar; k++) {
        double v[3];
        keaCross(v, velocity[k]->ang, w->arm[k]);
        keaAddScaled(v, 1, velocity[k]->lin);
        rate += (k == 0 ? 1 : -1) * keaDot(w->n, v);
    }
    return rate / w->slope;
}

static MeBool isNearStop(const MdtBclGroundWheel *g, const MdtBclContext *x, const Touch *w) {
    const double z = w->length - g->low, rate = keaMin(lengthRate(w, x->velocity), lengthRate(w, x->predicted));
    return z <= 0 || g->stopForce > 0 || z + 2 * x->parameters.stepsize * rate < 0;
}

/* N: the force along x that stops the mass that the wheel carries within a step, if all else goes on, or as much of it
 * as the tyre transmits. */
static double stoppingForce(const MdtBclGroundWheel *g, double h) {
    const double force = g->force[0] - g->mass * (g->velocity[0] + g->gain) / h;
    return g->isOnGround ? fmin(fmax(force, -g->bound[0]), g->bound[0]) : 0;
}

/* N m: the torque of the brake that stops the wheel's spin within a step under the force F_x. */
static double stoppingTorque(const MdtBclGroundWheel *g, double h, double force) {
    return g->inertia * g->spin / h + g->drive - g->radius * force;
}

/* The direction in which a wheel turns, or will turn. */
static double directionOf(const MdtBclGroundWheel *g, double h) {
    const double direction = g->spin != 0 ? g->spin : stoppingTorque(g, h, stoppingForce(g, h));
    return direction > 0 ? 1 : direction < 0 ? -1 : 0;
}

static int countRows(const MdtBclGroundWheel *g) {
    return (g->rows & SPRING ? 3 : 0) + ((g->rows & STOP) != 0) + ((g->rows & BAR) != 0) + ((g->rows & LEAN) != 0);
}

static MeBool needsStop(const MdtBclConstraint *c, const MdtBclContext *x) {
    const MdtBclGroundWheel *g = &c->of.groundWheel;
    Place at;
    Touch w;
    placeAt(c->frame, x->pose, &at);
    touch(g, &at, &w);
    return isNearStop(g, x, &w);
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    MdtBclGroundWheel *g = &c->of.groundWheel;
    const double h = x->parameters.stepsize;
    g->rows = 0;
    g->isLocked = g->brake > 0 && fabs(stoppingTorque(g, h, stoppingForce(g, h))) <= g->brake;
    g->direction = directionOf(g, h);
    if (g->leanStiffness > 0)
        g->rows = LEAN;
    if (g->isOnGround)
        g->rows |= SPRING | TYRE | (needsStop(c, x) ? STOP : 0) | (g->barStiffness > 0 ? BAR : 0);
    return countRows(g);
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    const MdtBclGroundWheel *g = &c->of.groundWheel;
    Place at;
    if (!(g->rows & STOP))
        return;
    placeAt(c->frame, pose, &at);
    e[1] = lengthOf(&at, g->distance) - g->low;
}

/* Where all is in the step: at its start, in the mean, at the end. */
typedef struct Course {
    Place start, mean, end;
} Course;

static void courseOf(const MdtBclFrame frame[2], const MdtBclContext *x, MeBool isParked, Course *course) {
    placeAt(frame, x->pose, &course->start);
    course->end = course->start;
    advance(x, isParked ? 1 : 0.5, &course->end);
    meanPlace(&course->start, &course->end, &course->mean);
}

static void barRow(const MdtBclGroundWheel *g, const MdtBclContext *x, const Touch *w, double length, MdtKeaRow *row) {
    Course other;
    Touch twin;
    courseOf(g->twin, x, g->isParked, &other);
    touchAt(&other.mean, g->twinDistance, g->twinShape, reachOf(g), &twin);
    bcl_startRow(row, x);
    addGroundRow(w, w->n, 1 / w->slope, row);
    addGroundRow(&twin, twin.n, -1 / twin.slope, row);
    const double twinLength = lengthOf(&other.start, g->twinDistance);
    bcl_makeSpring(row, length - g->freeLength - (twinLength - g->twinFreeLength), g->barStiffness, 0);
    row->lower = g->barBound[0];
    row->upper = g->barBound[1];
}

static void rollingRow(const MdtBclGroundWheel *g, const MdtBclContext *x, MdtKeaRow *row) {
    const double h = x->parameters.stepsize, middle = stoppingTorque(g, h, 0) / g->radius;
    row->upper = g->bound[0];
    row->lower = -g->bound[0];
    row->softness = g->slip[0] / h;
    if (g->isLocked) {
        const double low = middle - g->brake / g->radius, high = middle + g->brake / g->radius;
        row->lower = fmin(fmax(low, row->lower), row->upper);
        row->upper = fmax(fmin(high, row->upper), row->lower);
        return;
    }
    row->softness += g->radius * g->radius / g->inertia;
    const double tread = g->radius * (g->spin + h * (g->drive - g->direction * g->brake) / g->inertia);
    row->target = row->drift = keaMin(keaMax(tread, -fastest), fastest);
}

static void leanRow(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow *row) {
    const MdtBclGroundWheel *g = &c->of.groundWheel;
    double forward[3];
    keaApply(forward, x->pose[0]->R, c->frame[0].ortho);
    bcl_spinRow(x, forward, row);
    bcl_negate(row);
    bcl_makeSpring(row, g->lean, g->leanStiffness, g->leanDamping);
    row->target = g->leanRate;
}

/* x: where wheel plane and ground intersect; y = n x x. */
static void tyreAxes(const Place *at, double x[3], double y[3]) {
    double axle[3];
    keaCross(axle, at->s, at->f);
    keaCross(x, axle, at->n);
    keaScale(x, 1 / keaMax(keaLength(x), 1e-9), x);
    keaCross(y, at->n, x);
}

/* The tyre's velocities are those at the end of the step. A parked vehicle moves by these (θ = 1), along a chord, as
 * does ground that moves: so it does not creep. */
static void tyreRows(const MdtBclGroundWheel *g, const MdtBclContext *x, const Course *course, MdtKeaRow rows[2]) {
    const Place *at = g->isParked ? &course->mean : &course->end;
    double along[3], across[3];
    Touch w;
    touch(g, at, &w);
    tyreAxes(at, along, across);
    groundRow(x, &w, along, 1, &rows[0]);
    rollingRow(g, x, &rows[0]);
    rows[0].backward = g->isParked;
    groundRow(x, &w, across, 1, &rows[1]);
    rows[1].upper = g->bound[1];
    rows[1].lower = -g->bound[1];
    rows[1].softness = g->slip[1] / x->parameters.stepsize;
}

/* The rows on the ground: spring, stop, tyre along and across, bar. */
static void groundRows(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclGroundWheel *g = &c->of.groundWheel;
    Course course;
    Touch w;
    courseOf(c->frame, x, g->isParked, &course);
    touch(g, &course.mean, &w);
    const double length = lengthOf(&course.start, g->distance);
    groundRow(x, &w, w.n, 1 / w.slope, rows);
    bcl_makeSpring(rows, keaMax(length, g->low) - g->freeLength, g->stiffness, g->damping); /* from its stop on */
    rows++->lower = 0;
    if (g->rows & STOP) {
        groundRow(x, &w, w.n, 1 / w.slope, rows);
        rows->error = length - g->low;
        bcl_makeStop(rows++, x);
    }
    tyreRows(g, x, &course, rows);
    if (g->rows & BAR)
        barRow(g, x, &w, length, rows + 2);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclGroundWheel *g = &c->of.groundWheel;
    if (g->rows & SPRING)
        groundRows(c, x, rows);
    if (g->rows & LEAN)
        leanRow(c, x, rows + countRows(g) - 1);
    MEVALIDATE(bcl_areRows(rows, countRows(g)));
}

static void spin(MdtBclGroundWheel *g, double h) {
    const double before = g->spin, direction = g->direction;
    g->spin = g->isLocked ? 0 : before + h * (g->drive - direction * g->brake - g->radius * g->force[0]) / g->inertia;
    if (g->brake > 0 && g->spin * direction < 0)
        g->spin = 0; /* brakes do not turn it back */
    g->spin = fmin(fmax(g->spin, -fastest), fastest);
    g->angle = remainder(g->angle + h * (before + g->spin) / 2, 6.283185307179586476925);
}

/* What the rows on the ground have done. */
static void readGround(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]) {
    MdtBclGroundWheel *g = &c->of.groundWheel;
    const MdtKeaRow *tyre = rows + (g->rows & STOP ? 2 : 1);
    Place at;
    Touch w;
    placeAt(c->frame, x->pose, &at);
    touch(g, &at, &w);
    g->length = w.length;
    g->stopForce = g->rows & STOP ? rows[1].force : 0;
    g->springForce = rows[0].force;
    g->barForce = g->rows & BAR ? tyre[2].force : 0;
    g->slope = w.slope;
    g->load = keaMax(g->springForce + g->stopForce + g->barForce, 0) / w.slope;
    g->lengthRate = lengthRate(&w, x->velocity);
    for (int i = 0; i < 2; i++) {
        g->force[i] = tyre[i].force;
        g->velocity[i] = bcl_rate(&tyre[i], x->velocity);
    }
}

static void readBack(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]) {
    MdtBclGroundWheel *g = &c->of.groundWheel;
    const double before = g->velocity[0];
    g->lengthRate = g->load = g->stopForce = g->springForce = g->barForce = 0;
    keaZero(g->force);
    keaZero(g->velocity);
    if (g->rows & SPRING)
        readGround(c, x, rows);
    spin(g, x->parameters.stepsize);
    g->gain = g->velocity[0] - before;
}

const MdtBclType bcl_groundWheel = {.name = "GroundWheel",
                                    .maxRows = MdtBclGETMAXROWSGROUNDWHEEL,
                                    .keepsRows = METRUE,
                                    .reset = reset,
                                    .prepare = prepare,
                                    .fill = fill,
                                    .errors = errors,
                                    .readBack = readBack};
