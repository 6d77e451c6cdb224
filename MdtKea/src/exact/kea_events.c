/* Events at which a timed step is divided: times of impact, and times at which sliding stops.
 *
 * In a timed step bodies move with their mean velocities, x⁺ = x + h (v + v⁺)/2, and closed contacts constrain the
 * velocity at the end. This is exact for constant forces; a step that moves bodies with v⁺ has the error a h²/2. The
 * step is divided where forces change discontinuously:
 *
 *   an impact: an open contact's gap, φ + J v t + J (v⁺ - v) t²/2h, vanishes at some t, its time of impact;
 *   a stop:    a sliding contact would stick or slide back at the end. With friction still against the slip velocity u
 *              of the start, the slip vanishes at t = h |u| / (|u| - u⁺·u/|u|). What sticks to a mover does not slide
 *              because its velocity changes: u is the slip before that.
 *
 * Impacts that are all too slow to rebound may follow each other without end (chattering, report.trembles). The owner
 * then does not divide the step, or has such contacts act from its start (holdsSlow): a contact with the gap φ and the
 * rate a touches at the end if J v⁺ = -2 φ/h - a, since bodies move with the mean rate. One that closes earlier is
 * stopped.
 */
#include "kea_i.h"
#include "common/kea_policy_i.h"
#include "MeAssert.h"
#include <string.h>

/* m/s: J v of a row at the end of the step without constraint forces. */
static double freeRate(const MdtKeaSystem *s, const MdtKeaRow *row) {
    double rate = row->turning;
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            rate += kea_rateAlong(&row->J[k], &s->predicted[row->body[k]]);
    return rate;
}

/* m/s: the rate of a contact at the start. One that a mover leaves, as a deck that drops, stays closed if the body
 * comes along by itself: its rate is that before the mover's change. */
static double leavingRate(const MdtKeaSystem *s, int i) {
    const MdtKeaRow *row = &s->rows[i];
    const MeBool comesAlong = row->jump > 0 && freeRate(s, row) - row->drift <= 0;
    return kea_startRate(s, i) - (comesAlong ? row->jump : 0);
}

/* A contact that overlaps is open if it leaves by more than γ of its overlap in the step; else the overlap of one that
 * rebounds in each step would stay. Where rebounds lose next to nothing it stays: displacement against loads is a gain
 * of energy. */
MeBool kea_isContactOpen(const MdtKeaSystem *s, int i, double speed) {
    const MdtKeaRow *row = &s->rows[i];
    const double overlap = -row->error, least = s->parameters.gamma * overlap / s->parameters.stepsize;
    const MeBool sheds =
        row->restitution <= kea_lossyRestitution && overlap > kea_touchingGap * kea_smallerExtent(s, row->body);
    return !kea_isTouching(s, row) || leavingRate(s, i) > keaMax(kea_separatingSpeed * speed, sheds ? least : 0);
}

/* ---- which systems are timed ---- */

/* Springs exclude timed steps: their forces change within a step, and stiff ones need the damping of θ = 1. Overlaps do
 * not: a body that was hit in the last step, and had no contact with the next one yet, meets it late. */
MeBool MEAPI MdtKeaBounces(const MdtKeaSystem *s) {
    const double minSpeed = kea_minReboundSpeed * kea_eventSpeed(s), reach = kea_reach * s->parameters.stepsize;
    MeBool bounces = MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (row->spring)
            return MEFALSE;
        if (row->contact != i)
            continue;
        const double rate = keaMin(kea_startRate(s, i), freeRate(s, row) - row->drift);
        const MeBool isFast = -rate > row->threshold && -rate * row->restitution > minSpeed;
        if (isFast && row->error + reach * rate < 0)
            bounces = METRUE;
    }
    return bounces;
}

MeBool MEAPI MdtKeaRolls(const MdtKeaSystem *s) {
    MeBool hasContact = MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        const MeBool isStop = row->position && kea_mayReachBound(row);
        const MeBool isRound = row->radius[0] > 0 || row->radius[1] > 0;
        if (row->contact < 0 && (row->spring || isStop))
            return MEFALSE;
        if (row->contact == i && (!isRound || row->error < -kea_nearbyGap * kea_smallerExtent(s, row->body)))
            return MEFALSE;
        hasContact = hasContact || row->contact >= 0;
    }
    return hasContact;
}

/* Whether a touching contact neither separates nor rebounds; speed: the load speed. */
static MeBool isPersistent(double rate, double restitution, double speed) {
    return rate <= kea_separatingSpeed * speed && -rate * restitution <= kea_minReboundSpeed * speed;
}

MeBool MEAPI MdtKeaContactHolds(const MdtKeaBody *const bodies[2], double gap, double rate, double restitution,
                                double loadSpeed) {
    double extent = HUGE_VAL;
    for (int k = 0; k < 2; k++)
        if (bodies[k])
            extent = keaMin(extent, kea_bodyExtent(bodies[k]));
    return gap < kea_touchingGap * extent && isPersistent(rate, restitution, loadSpeed);
}

int MEAPI MdtKeaHeldBodies(const MdtKeaSystem *s) {
    const double speed = kea_eventSpeed(s);
    int *isConstrained = s->work->parent, count = 0;
    memset(isConstrained, 0, (size_t)s->numBodies * sizeof *isConstrained);
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        const MeBool isJoint = row->contact < 0, isNormal = row->contact == i;
        if (!isJoint &&
            !(isNormal && kea_isTouching(s, row) && isPersistent(kea_startRate(s, i), row->restitution, speed)))
            continue;
        for (int k = 0; k < 2; k++)
            if (row->body[k] >= 0)
                isConstrained[row->body[k]] = 1;
    }
    for (int b = 0; b < s->numBodies; b++)
        count += isConstrained[b];
    return count;
}

/* ---- impacts ---- */

typedef struct Impact {
    double time, speed; /* s into the step, HUGE_VAL: none; over the least speed that divides the step */
    double approach;    /* m/s: of the bodies at that time */
} Impact;

/* The approach of the contact with normal row i, whose rate changes linearly to endRate within the step. */
typedef struct Course {
    double start, acceleration, time; /* m/s, m/s², s: of the impact; HUGE_VAL: none */
} Course;

static Course courseOf(const MdtKeaSystem *s, int i, double endRate) {
    const MdtKeaRow *row = &s->rows[i];
    Course c = {.start = kea_startRate(s, i)};
    c.acceleration = (endRate - row->drift - c.start) / s->parameters.stepsize;
    c.time = kea_timeOfImpact(row->error, c.start, c.acceleration);
    return c;
}

static Impact impactOf(const MdtKeaSystem *s, int i, double endRate, double speed) {
    const Course c = courseOf(s, i, endRate);
    if (c.time == HUGE_VAL)
        return (Impact){HUGE_VAL, 0, 0};
    const double gained = c.acceleration * s->parameters.stepsize;
    const double min = kea_minDividingSpeed(s->rows[i].restitution, gained, speed);
    const double approach = -(c.start + c.acceleration * c.time);
    return (Impact){c.time, approach / min, approach};
}

/* ---- slow contacts, closed from the start instead ---- */

/* Whether a contact, whose rate changes linearly to endRate, has an impact within the step that is too slow to rebound.
 * With holdsSlow, it then acts from the start of the step instead. */
static MeBool closesSlowly(const MdtKeaSystem *s, int i, double endRate, double speed) {
    const Impact m = impactOf(s, i, endRate, speed);
    return s->parameters.holdsSlow && m.time < s->parameters.stepsize && m.speed <= 1;
}

void kea_markOpenContacts(MdtKeaSystem *s) {
    const double speed = kea_eventSpeed(s);
    const MeBool waits = kea_impactsWait(s, speed);
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact == i)
            s->rows[i].isOpen =
                (kea_isContactOpen(s, i, speed) && !closesSlowly(s, i, freeRate(s, &s->rows[i]), speed)) ||
                (waits && kea_isBlow(s, i, speed));
}

int kea_closeSlowContacts(MdtKeaSystem *s) {
    const double speed = kea_eventSpeed(s);
    int count = 0;
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact == i && s->rows[i].isOpen && closesSlowly(s, i, kea_endRate(s, i), speed)) {
            s->rows[i].isOpen = MEFALSE;
            count++;
        }
    return count;
}

/* ---- events ---- */

/* s: the time of the last impact of open contacts up to the time `end`. */
static double lastImpact(const MdtKeaSystem *s, double end, double speed) {
    double last = 0;
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact == i && s->rows[i].isOpen) {
            const double time = impactOf(s, i, kea_endRate(s, i), speed).time;
            last = time <= end ? keaMax(last, time) : last;
        }
    return last;
}

/* The time of the first impact of open contacts, or the last one that is simultaneous with it (kea_impact_time.c), and
 * the largest speed of all impacts within the step. The speed of those that cannot chatter does not matter. */
static Impact firstImpact(const MdtKeaSystem *s, double speed) {
    Impact first = {HUGE_VAL, 0, 0};
    double end = HUGE_VAL;
    kea_setDepths(s, speed);
    for (int i = 0; i < s->numRows; i++) {
        if (s->rows[i].contact != i || !s->rows[i].isOpen)
            continue;
        const Impact m = impactOf(s, i, kea_endRate(s, i), speed);
        first.time = keaMin(first.time, m.time);
        if (m.time == HUGE_VAL)
            continue;
        end = keaMin(end, m.time + kea_delayOfImpact(s, i, keaMin(s->rows[i].error, 0), m.approach));
        if (m.time < s->parameters.stepsize)
            first.speed = keaMax(first.speed,
                                 s->parameters.holdsSlow || kea_mayChatter(s, &s->rows[i], speed) ? m.speed : HUGE_VAL);
    }
    if (end > first.time && end < HUGE_VAL)
        first.time = lastImpact(s, end, speed);
    return first;
}

double kea_freeTimeOfImpact(const MdtKeaSystem *s, int i) {
    return courseOf(s, i, freeRate(s, &s->rows[i])).time;
}

double kea_firstEventOfFlight(const MdtKeaSystem *s) {
    double first = s->parameters.stepsize;
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact == i)
            first = keaMin(first, kea_freeTimeOfImpact(s, i));
    return first;
}

/* The slip velocity of a friction row or cone. */
typedef struct Slip {
    double start[2], size; /* m/s, at the start, and its norm */
    double end[2];         /* m/s, at the end */
    int row[2];            /* the second is -1 if there is no cone */
} Slip;

/* The slip of friction row i, or of the cone that it begins. */
static Slip slipOf(const MdtKeaSystem *s, int i) {
    Slip slip = {.row = {i, s->rows[i].partner}};
    double before[2] = {0, 0};
    for (int k = 0; k < 2 && slip.row[k] >= 0; k++) {
        slip.start[k] = kea_startRate(s, slip.row[k]);
        slip.end[k] = kea_endRate(s, slip.row[k]) - s->rows[slip.row[k]].target;
        before[k] = slip.start[k] - s->rows[slip.row[k]].jump;
    }
    slip.size = keaHypotenuse(slip.start[0], slip.start[1]);
    if (keaHypotenuse(before[0], before[1]) < slip.size) {
        memcpy(slip.start, before, sizeof before);
        slip.size = keaHypotenuse(before[0], before[1]);
    }
    return slip;
}

/* Whether the contact sticks at the end, or slides back. */
static MeBool stopsSliding(const MdtKeaSystem *s, const Slip *slip) {
    const KeaProblemRow *p = &s->work->problem.row[slip->row[0]];
    const double force = keaHypotenuse(p->p, slip->row[1] >= 0 ? s->work->problem.row[slip->row[1]].p : 0);
    const MeBool sticks = force < (1 - kea_stickMargin) * p->friction * s->work->problem.row[p->normal].p;
    return sticks || slip->start[0] * slip->end[0] + slip->start[1] * slip->end[1] < 0;
}

/* Finds contacts that slide faster than minSpeed and stop within the step, and fixes their friction against the slip of
 * the start (isForced). Friction with slip is left out: below its bound the force is proportional to the speed, and the
 * contact stops without a discontinuity. Returns the number of contacts; a cone counts once. */
static int fixStoppingFriction(MdtKeaSystem *s, double minSpeed) {
    int count = 0;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i], *partner = row->partner >= 0 ? &s->rows[row->partner] : NULL;
        const MeBool isViscous = row->softness > 0 || (partner && partner->softness > 0);
        if (row->normal < 0 || (partner && row->partner < i) || s->rows[row->contact].isOpen)
            continue;
        if (isViscous || row->isForced)
            continue;
        const Slip slip = slipOf(s, i);
        if (kea_lengthOf(s, row) * slip.size <= minSpeed || !stopsSliding(s, &slip))
            continue;
        for (int k = 0; k < 2 && slip.row[k] >= 0; k++) {
            s->rows[slip.row[k]].isForced = METRUE;
            s->rows[slip.row[k]].forced = -slip.start[k] / slip.size;
        }
        count++;
    }
    return count;
}

/* s: the first time at which a contact with fixed friction (isForced) stops sliding; HUGE_VAL: none. */
static double firstEndOfSliding(const MdtKeaSystem *s) {
    const double h = s->parameters.stepsize;
    double first = HUGE_VAL;
    for (int i = 0; i < s->numRows; i++) {
        if (!s->rows[i].isForced || (s->rows[i].partner >= 0 && s->rows[i].partner < i))
            continue;
        const Slip slip = slipOf(s, i);
        MEASSERT(slip.size > 0);
        const double end = (slip.start[0] * slip.end[0] + slip.start[1] * slip.end[1]) / slip.size;
        if (end < slip.size)
            first = keaMin(first, h * slip.size / (slip.size - end));
    }
    return first;
}

double kea_firstEvent(MdtKeaSystem *s, MeBool *mustRepeat) {
    const double speed = kea_eventSpeed(s);
    *mustRepeat = !s->parameters.holdsSlow && fixStoppingFriction(s, kea_separatingSpeed * speed) > 0;
    const Impact impact = firstImpact(s, speed);
    const double stop = firstEndOfSliding(s);
    MEASSERT(!(impact.time < 0) && !(stop < 0));
    s->report.trembles = impact.time < s->parameters.stepsize && impact.speed <= 1;
    return keaMin(impact.time, stop);
}

void kea_releaseFriction(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].isForced = MEFALSE;
}
