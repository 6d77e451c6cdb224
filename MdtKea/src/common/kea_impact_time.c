/* When contacts that are open will close: the times at which a step is divided.
 *
 * Where a contact that rests overlaps by d, the gaps of its bodies are known no better than d, and impacts that follow
 * each other by less are simultaneous. A table that rocks on two legs, which have sunk in by d, meets the ground with
 * the inner edges of the other two first, when the outer edges are still as high as that. One impact after the other
 * would take less energy than both together. So an impact waits until those that are simultaneous have come up, as long
 * as nothing becomes deeper than d by it.
 */
#include "common/kea_anchor_i.h"
#include "common/kea_policy_i.h"
#include "kea_i.h"

double kea_minDividingSpeed(double restitution, double gained, double speed) {
    if (restitution > 0)
        return kea_minReboundSpeed * speed;
    return keaMin(kea_minPlasticSpeed * speed, keaMax(kea_minOwnSpeed * fabs(gained), kea_minBlowSpeed * speed));
}

MeBool kea_mayChatter(const MdtKeaSystem *s, const MdtKeaRow *row, double speed) {
    for (int k = 0; k < 2; k++)
        if (row->body[1 - k] < 0 && row->radius[k] > 0 && row->drift == 0)
            return row->restitution > 0 || keaLength(s->velocity[row->body[k]].lin) < speed;
    return METRUE;
}

double kea_timeOfImpact(double gap, double a, double b) {
    gap = keaMax(gap, 0);
    const double root = a * a - 2 * b * gap;
    if (root < 0)
        return HUGE_VAL;
    if (a < 0)
        return 2 * gap / (-a + sqrt(root));
    return b < 0 ? (a + sqrt(root)) / -b : HUGE_VAL;
}

/* ---- simultaneous impacts ---- */

MeBool kea_isBlow(const MdtKeaSystem *s, int i, double speed) {
    return kea_isTouching(s, &s->rows[i]) && -kea_startRate(s, i) > kea_separatingSpeed * speed;
}

void kea_setDepths(const MdtKeaSystem *s, double speed) {
    for (int b = 0; b < s->numBodies; b++)
        s->work->body[b].depth = 0;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (row->contact != i || row->error >= 0 || kea_isBlow(s, i, speed))
            continue;
        const double depth = keaMin(-row->error, kea_waitingDepth * kea_smallerExtent(s, row->body));
        for (int k = 0; k < 2; k++)
            if (row->body[k] >= 0)
                s->work->body[row->body[k]].depth = keaMax(s->work->body[row->body[k]].depth, depth);
    }
}

double kea_delayOfImpact(const MdtKeaSystem *s, int i, double gap, double approach) {
    const MdtKeaRow *row = &s->rows[i];
    double depth = kea_touchingGap * kea_smallerExtent(s, row->body);
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            depth = keaMax(depth, s->work->body[row->body[k]].depth);
    return approach > 0 ? keaMax(gap + depth, 0) / approach : 0;
}

MeBool kea_impactsWait(const MdtKeaSystem *s, double speed) {
    double end = HUGE_VAL;
    kea_setDepths(s, speed);
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact == i && kea_isBlow(s, i, speed))
            end = keaMin(end, kea_delayOfImpact(s, i, s->rows[i].error, -kea_startRate(s, i)));
    for (int i = 0; i < s->numRows && end < HUGE_VAL; i++)
        if (s->rows[i].contact == i && !kea_isTouching(s, &s->rows[i]) && s->rows[i].error < end * -kea_startRate(s, i))
            return METRUE;
    return MEFALSE;
}

/* ---- the fast solver ---- */

/* m/s²: the acceleration of a gap in the last step. The point is one of the body, which turns with it; the farthest
 * point of a rim stays where it is. */
static double accelerationOf(const MdtKeaSystem *s, const MdtKeaManifold *m, const KeaApproach *a,
                             const double arm[2][3]) {
    const MeBool isRim = m->rim[0] > 0 || m->rim[1] > 0;
    double along = isRim ? 0 : a->acceleration;
    for (int k = 0; k < 2; k++) {
        const double side = k == 0 ? 1 : -1, *spin = kea_sideVelocity(s, m, k)->ang;
        double once[3], inward[3];
        keaCross(once, spin, arm[k]);
        keaCross(inward, spin, once);
        if (!isRim)
            along += side * keaDot(inward, m->normal);
        else if (m->body[k] >= 0)
            along += side * keaDot(s->bodies[m->body[k]]->lastStep.lin, m->normal);
    }
    return along;
}

/* s: the time of the impact of a point with a gap, under the acceleration of the last step, or that of the loads if it
 * was a jerk; HUGE_VAL: none that divides the step. speed: kea_eventSpeed. */
static double timeOfPoint(const MdtKeaSystem *s, const MdtKeaManifold *m, const MdtKeaPoint *point, double speed) {
    const double h = s->parameters.stepsize, touching = point->guess[0] > 0 ? kea_nearbyGap : kea_touchingGap;
    double arm[2][3];
    if (!(-point->depth > touching * kea_smallerExtent(s, m->body)))
        return HUGE_VAL;
    kea_armsTo(s, m, point->position, arm);
    const KeaApproach a = kea_approachOfPoint(s, m, (const double(*)[3])arm);
    double acceleration = accelerationOf(s, m, &a, (const double(*)[3])arm);
    if (0.5 * h * fabs(acceleration) > fabs(a.rate) + kea_loadSpeed(s))
        acceleration = (a.predicted - a.rate) / h;
    const double time = kea_timeOfImpact(-point->depth, a.rate, acceleration);
    return a.rate + acceleration * time < -kea_minDividingSpeed(0, h * acceleration, speed) ? time : HUGE_VAL;
}

double MEAPI MdtKeaTimeOfImpact(const MdtKeaSystem *s) {
    const double speed = kea_eventSpeed(s);
    double first = s->parameters.stepsize;
    for (int i = 0; i < s->numManifolds; i++)
        for (int k = 0; k < s->manifolds[i].numPoints; k++)
            first = keaMin(first, timeOfPoint(s, &s->manifolds[i], &s->manifolds[i].point[k], speed));
    return first;
}
