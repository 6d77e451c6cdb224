/* The law of restitution.
 *
 * A contact or stop with the approach speed u separates with e u if u is above its threshold, else with 0 (Newton's
 * law). There are two cases:
 *
 *   an impact that is resolved at its time: u is the speed at that time, and has to be above a minimum, too;
 *   an impact within a step: if the bodies collide in the step, faster than the acceleration of one step explains (else
 *   resting bodies would rattle), the velocity at the end of the step is e u with u² = rate² + 2 gap a: the speed at
 *   which the gap closes under the acceleration a of the last step.
 *
 * A contact that is found late, at the depth d, approaches faster than the surfaces met, by the loads' acceleration a:
 * u² = rate² - 2 d a. At this depth it separates with v, v² = (e u)² + 2 d a, so that it leaves the surface with e u.
 *
 * A contact without loss, e = 1, that is too slow to be reflected (kea_reflect.c) and falls back within the step would
 * hop several times in it. It hovers instead: with the rate v at the start it has -v at the end, so that the mean rate
 * is 0, and with it the work of the impulse. One that does not come down in the step is free: its bound is the rate
 * with which it would touch at the end. With e < 1 hops soon end, and what hops is stopped.
 */
#include "common/kea_anchor_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"

/* ---- approach ---- */

/* Adds the part of one body, with the row's Jacobian J. */
static void addApproachOfBody(const MdtKeaSystem *s, int body, const MdtKeaJBlock *J, KeaApproach *a) {
    const double now = kea_rateAlong(J, &s->velocity[body]), then = kea_rateAlong(J, &s->predicted[body]);
    a->rate += now;
    a->predicted += then;
    a->fastest += keaMin(now, then);
    a->acceleration += kea_rateAlong(J, &s->bodies[body]->lastStep);
}

/* Adds the rate due to a moving world, which is constant. */
static void addWorldRate(double rate, KeaApproach *a) {
    a->rate += rate;
    a->predicted += rate;
    a->fastest += rate;
}

/* m/s: the velocity of a side of the manifold at its point, less that of the side's centre. */
static void velocityAt(const MdtKeaVelocity *side, const double arm[3], double v[3]) {
    keaCross(v, side->ang, arm);
    keaAddScaled(v, 1, side->lin);
}

/* The rate is n·(v - f), with v of the other side, and f = c + w x r of the face at the same point. n turns with w, and
 * r changes by v - c: the acceleration is (w x n)·(v - f) - n·(w x (v - c)). */
double kea_turningRate(const MdtKeaSystem *s, const MdtKeaManifold *m, const double arm[2][3]) {
    const int k = m->body[0] < 0 ? 0 : 1;
    const MdtKeaVelocity *face = m->worldVelocity;
    double turn[3], v[3], f[3], slip[3], change[3];
    if (m->body[k] >= 0 || m->body[1 - k] < 0 || !m->mover || !face)
        return 0;
    keaCross(turn, face->ang, m->normal);
    if (s->parameters.stepsize * keaLength(turn) <= kea_minTurn)
        return 0;
    velocityAt(&s->velocity[m->body[1 - k]], arm[1 - k], v);
    velocityAt(face, arm[k], f);
    keaSubtract(slip, v, f);
    keaAddScaled(v, -1, face->lin);
    keaCross(change, face->ang, v);
    return (k == 1 ? 1 : -1) * s->parameters.stepsize * (keaDot(turn, slip) - keaDot(m->normal, change));
}

static void addTurning(double turning, KeaApproach *a) {
    a->predicted += turning;
    a->fastest += keaMin(turning, 0);
}

KeaApproach kea_approachOfRow(const MdtKeaSystem *s, const MdtKeaRow *row) {
    KeaApproach a = {0, 0, 0, 0};
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            addApproachOfBody(s, row->body[k], &row->J[k], &a);
    addWorldRate(-row->drift, &a);
    addTurning(row->turning, &a);
    return a;
}

KeaApproach kea_approachOfPoint(const MdtKeaSystem *s, const MdtKeaManifold *m, const double arm[2][3]) {
    KeaApproach a = {0, 0, 0, 0};
    for (int k = 0; k < 2; k++) {
        MdtKeaJBlock J;
        keaScale(J.lin, k == 0 ? 1 : -1, m->normal);
        keaCross(J.ang, arm[k], J.lin);
        if (m->body[k] >= 0)
            addApproachOfBody(s, m->body[k], &J, &a);
        else if (m->worldVelocity)
            addWorldRate(kea_rateAlong(&J, m->worldVelocity), &a);
    }
    addTurning(kea_turningRate(s, m, arm), &a);
    return a;
}

MeBool kea_mayTouch(const MdtKeaSystem *s, const MdtKeaBodyIndexPair body, const KeaApproach *a, double gap) {
    return gap < kea_touchingGap * kea_smallerExtent(s, body) || s->parameters.stepsize * a->fastest < -gap;
}

/* ---- the law ---- */

double kea_reboundOfImpact(double restitution, double threshold, double speed, double fall, double minSpeed) {
    MEASSERT(restitution >= 0 && restitution <= 1 && fall >= 0);
    const double late = restitution > 0 && fall < speed * speed ? fall : 0, square = speed * speed - late;
    const MeBool rebounds = speed > 0 && sqrt(square) > keaMax(threshold, minSpeed);
    return rebounds ? sqrt(restitution * restitution * square + late) : 0;
}

/* m/s: the largest change of the rate in one step that needs no impact: by loads, or by the acceleration of the last
 * step, which includes constraint forces. */
static double changeWithoutImpact(const MdtKeaSystem *s, const KeaApproach *a) {
    const double loads = fabs(a->predicted - a->rate), before = s->parameters.stepsize * fabs(a->acceleration);
    return kea_ownChangeMargin * keaMax(loads, before);
}

double kea_reboundInStep(const MdtKeaSystem *s, const KeaApproach *a, double gap, double left, double restitution,
                         double threshold) {
    const double fall = 2 * keaMax(-gap, 0) * keaMax(a->rate - a->predicted, 0) / s->parameters.stepsize;
    const MeBool isHit = gap + s->parameters.stepsize * a->predicted < 0;
    if (!isfinite(a->rate) || !isfinite(a->acceleration)) /* overflow: the step will not be committed */
        return 0;
    if (!(restitution > 0) || !isHit || !(a->rate < -keaMax(threshold, changeWithoutImpact(s, a))))
        return 0;
    const double late = fall < a->rate * a->rate ? fall : 0;
    const double square = a->rate * a->rate + 2 * keaMax(gap, 0) * keaMax(-a->acceleration, 0) - late;
    return sqrt(restitution * restitution * square + left * late);
}

/* ---- hops ---- */

/* m/s: the largest change of a body's velocity by its loads in the step. */
static double loadSpeedOf(const MdtKeaSystem *s, const MdtKeaBodyIndexPair body) {
    double speed = 0;
    for (int k = 0; k < 2; k++) {
        double change[3];
        if (body[k] < 0)
            continue;
        keaSubtract(change, s->predicted[body[k]].lin, s->velocity[body[k]].lin);
        speed = keaMax(speed, keaLength(change));
    }
    return speed;
}

/* Whether a contact is calm: it touches, and moves more slowly than what chatters. */
static MeBool isCalm(const MdtKeaSystem *s, const MdtKeaBodyIndexPair body, double rate, double gap) {
    return fabs(rate) <= kea_separatingSpeed * loadSpeedOf(s, body) &&
           gap < kea_restingDepth * kea_smallerExtent(s, body);
}

KeaHop kea_hopInStep(const MdtKeaSystem *s, const MdtKeaBodyIndexPair body, const KeaApproach *a, double depth,
                     double threshold, double min) {
    const double h = s->parameters.stepsize, load = a->predicted - a->rate, gap = keaMax(-depth, 0);
    const KeaHop none = {min, 0}, free = {-2 * gap / h, 1}, hop = {0, 1};
    if (!(depth < kea_touchingGap * kea_smallerExtent(s, body)) || isCalm(s, body, a->rate, gap))
        return none;
    if (gap + h * (a->rate + 0.5 * load) >= 0)
        return free.fixed - a->rate < min ? free : none;
    const double speed2 = a->rate * a->rate - 2 * gap * load / h; /* m²/s²: with which it meets */
    return a->rate >= 0 || speed2 > threshold * threshold ? hop : none;
}

/* Sets the target of a contact that hops. */
static void setHop(const MdtKeaSystem *s, MdtKeaRow *row) {
    const KeaApproach a = kea_approachOfRow(s, row);
    const KeaHop hop = kea_hopInStep(s, row->body, &a, -row->error, row->threshold, row->target - row->drift);
    row->target = row->drift + hop.fixed;
    row->hop = hop.share;
}

/* ---- all rows ---- */

void kea_setRebounds(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++) {
        MdtKeaRow *row = &s->rows[i];
        row->rebound = row->hop = 0;
        if (row->restitution > 0) {
            const KeaApproach a = kea_approachOfRow(s, row);
            row->rebound =
                kea_reboundInStep(s, &a, row->error, 1 - s->parameters.gamma, row->restitution, row->threshold);
        }
        row->bounces = row->rebound > 0;
        if (row->restitution == 1 && row->contact == i && !row->bounces && !s->parameters.timed)
            setHop(s, row);
    }
}
