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

/* The vectors of the equations above, world frame. */
typedef struct Wheel {
    double s[3], n[3], x[3], y[3], q[3];
    double slope, length; /* n·s, L */
    MeBool isFar;         /* of a trial pose that is no wheel's: nothing acts */
} Wheel;

/* reach, m: lever arms are no longer than that allows, where trial poses are far from the ground. */
static void measureAt(const MdtBclFrame frame[2], double d, MdtBclWheelShape shape, double reach,
                      const MdtKeaTransformation *const pose[2], Wheel *w) {
    static const double minSlope = 0.05, farthest = 1e3;
    double f[3], axle[3], p[3], from[3], t[3];
    keaApply(w->s, pose[0]->R, frame[0].primary);
    keaApply(f, pose[0]->R, frame[0].ortho);
    keaApply(w->n, pose[1]->R, frame[1].primary);
    keaApply(w->q, pose[0]->R, frame[0].position);
    keaAddScaled(w->q, 1, pose[0]->pos);
    keaApply(p, pose[1]->R, frame[1].position);
    keaAddScaled(p, 1, pose[1]->pos);
    keaSubtract(from, w->q, p);
    w->slope = fmax(keaDot(w->n, w->s), minSlope);
    w->length = (keaDot(w->n, from) - d) / w->slope;
    w->isFar = !(fabs(w->length) < farthest * reach);
    keaAddScaled(w->q, -fmin(fmax(w->length, -reach), reach), w->s);
    keaCross(axle, w->s, f);
    keaCopy(t, shape == MdtBclWheelRay ? w->s : w->n);
    if (shape == MdtBclWheelDisc)
        keaAddScaled(t, -keaDot(w->n, axle), axle);
    keaAddScaled(w->q, -d / fmax(keaDot(w->n, t), minSlope), t);
    keaCross(w->x, axle, w->n);
    keaScale(w->x, 1 / fmax(keaLength(w->x), 1e-9), w->x);
    keaCross(w->y, w->n, w->x);
}

static double reachOf(const MdtBclGroundWheel *g) {
    return 4 * (g->radius + fabs(g->freeLength));
}

static void measure(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], Wheel *w) {
    const MdtBclGroundWheel *g = &c->of.groundWheel;
    measureAt(c->frame, g->distance, g->shape, reachOf(g), pose, w);
}

/* The row of the chassis' motion at q relative to the ground, along a direction. */
static void groundRow(const MdtBclContext *x, const Wheel *w, const double direction[3], double factor,
                      MdtKeaRow *row) {
    bcl_startRow(row, x);
    for (int k = 0; k < 2; k++) {
        keaSubtract(row->arm[k], w->q, x->pose[k]->pos);
        keaScale(row->J[k].lin, w->isFar ? 0 : k == 0 ? factor : -factor, direction);
        keaCross(row->J[k].ang, row->arm[k], row->J[k].lin);
    }
}

static MeBool isNearStop(const MdtBclGroundWheel *g, const MdtBclContext *x, const Wheel *w) {
    MdtKeaRow row;
    groundRow(x, w, w->n, 1 / w->slope, &row);
    const double z = w->length - g->low, rate = fmin(bcl_rate(&row, x->velocity), bcl_rate(&row, x->predicted));
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

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    MdtBclGroundWheel *g = &c->of.groundWheel;
    const double h = x->parameters.stepsize;
    Wheel w;
    measure(c, x->pose, &w);
    g->rows = 0;
    g->isLocked = g->brake > 0 && fabs(stoppingTorque(g, h, stoppingForce(g, h))) <= g->brake;
    g->direction = directionOf(g, h);
    if (g->leanStiffness > 0)
        g->rows = LEAN;
    if (g->isOnGround)
        g->rows |= SPRING | TYRE | (isNearStop(g, x, &w) ? STOP : 0) | (g->barStiffness > 0 ? BAR : 0);
    return countRows(g);
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    const MdtBclGroundWheel *g = &c->of.groundWheel;
    Wheel w;
    if (!(g->rows & STOP))
        return;
    measure(c, pose, &w);
    e[1] = w.length - g->low;
}

static void springRow(const MdtBclGroundWheel *g, const MdtBclContext *x, const Wheel *w, MdtKeaRow *row) {
    groundRow(x, w, w->n, 1 / w->slope, row);
    bcl_makeSpring(row, w->length - g->freeLength, g->stiffness, g->damping);
    row->lower = 0;
}

static void barRow(const MdtBclGroundWheel *g, const MdtBclContext *x, const Wheel *w, MdtKeaRow *row) {
    MdtKeaRow other;
    Wheel twin;
    measureAt(g->twin, g->twinDistance, g->twinShape, reachOf(g), x->pose, &twin);
    groundRow(x, w, w->n, 1 / w->slope, row);
    groundRow(x, &twin, twin.n, 1 / twin.slope, &other);
    for (int k = 0; k < 2; k++) {
        keaAddScaled(row->J[k].lin, -1, other.J[k].lin);
        keaAddScaled(row->J[k].ang, -1, other.J[k].ang);
        keaZero(row->arm[k]);
    }
    bcl_makeSpring(row, w->length - g->freeLength - (twin.length - g->twinFreeLength), g->barStiffness, 0);
    row->lower = g->barBound[0];
    row->upper = g->barBound[1];
}

static void rollingRow(const MdtBclGroundWheel *g, const MdtBclContext *x, const Wheel *w, MdtKeaRow *row) {
    const double h = x->parameters.stepsize, middle = stoppingTorque(g, h, 0) / g->radius;
    groundRow(x, w, w->x, 1, row);
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
    row->target = row->drift = fmin(fmax(tread, -fastest), fastest);
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

/* The rows on the ground: spring, stop, tyre along and across, bar. */
static void groundRows(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclGroundWheel *g = &c->of.groundWheel;
    Wheel w;
    measure(c, x->pose, &w);
    springRow(g, x, &w, rows++);
    if (g->rows & STOP) {
        groundRow(x, &w, w.n, 1 / w.slope, rows);
        rows->error = w.length - g->low;
        bcl_makeStop(rows++, x);
    }
    rollingRow(g, x, &w, rows++);
    groundRow(x, &w, w.y, 1, rows);
    rows->upper = g->bound[1];
    rows->lower = -g->bound[1];
    rows->softness = g->slip[1] / x->parameters.stepsize;
    if (g->rows & BAR)
        barRow(g, x, &w, rows + 1);
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

static void readBack(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]) {
    MdtBclGroundWheel *g = &c->of.groundWheel;
    const double h = x->parameters.stepsize, before = g->velocity[0];
    Wheel w;
    measure(c, x->pose, &w);
    g->lengthRate = g->load = g->stopForce = g->springForce = g->barForce = 0;
    keaZero(g->force);
    keaZero(g->velocity);
    if (g->rows & SPRING) {
        const MdtKeaRow *tyre = rows + (g->rows & STOP ? 2 : 1);
        MdtKeaRow row;
        g->length = w.length;
        g->stopForce = g->rows & STOP ? rows[1].force : 0;
        g->springForce = rows[0].force;
        g->barForce = g->rows & BAR ? tyre[2].force : 0;
        g->slope = w.slope;
        g->load = fmax(g->springForce + g->stopForce + g->barForce, 0) / w.slope;
        groundRow(x, &w, w.n, 1 / w.slope, &row);
        g->lengthRate = bcl_rate(&row, x->velocity);
        for (int i = 0; i < 2; i++) {
            g->force[i] = tyre[i].force;
            g->velocity[i] = bcl_rate(&tyre[i], x->velocity);
        }
    }
    spin(g, h);
    g->gain = g->velocity[0] - before;
}

const MdtBclType bcl_groundWheel = {.name = "GroundWheel",
                                    .maxRows = MdtBclGETMAXROWSGROUNDWHEEL,
                                    .reset = reset,
                                    .prepare = prepare,
                                    .fill = fill,
                                    .errors = errors,
                                    .readBack = readBack};
