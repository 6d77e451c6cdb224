/* Flight: bouncing bodies without joints and closed contacts are advanced on ballistic paths from impact to impact.
 *
 * Without rows a body's path is known until its next impact. Each body has its own time, up to which it has been
 * advanced, and each contact the predicted time of its next impact. The contact with the earliest time is resolved: its
 * bodies are advanced to that time, bodies that touch them take part in the impact (kea_impact.c), and the next impacts
 * of all their contacts are predicted anew. Other bodies are not visited: the cost of an impact does not depend on
 * their number.
 *
 * Flight ends with the step, or after an impact that leaves a contact closed: from then on rows act.
 */
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include "exact/kea_contact_i.h"
#include <string.h>

/* ---- bodies ---- */

/* Sets pose, velocity and prediction of body b from its state at time t, for the remaining step. */
static void predictBodyFrom(MdtKeaSystem *s, int b, double t) {
    s->parameters.stepsize = s->work->flight.end - t;
    kea_beginBody(s, b);
}

/* Computes the end state of body b at time t, without committing it. */
static void findStateAt(MdtKeaSystem *s, int b, double t) {
    MEASSERT(t >= s->work->flight.time[b]);
    s->parameters.stepsize = t - s->work->flight.time[b];
    kea_beginBody(s, b);
    kea_moveFreeBody(s, b);
}

/* Commits the motion of body b up to time t, and predicts it for the remaining step. The world, b < 0, is ignored. */
static void advanceBodyTo(MdtKeaSystem *s, int b, double t) {
    if (b < 0)
        return;
    MEASSERT(t >= s->work->flight.time[b] && t < s->work->flight.end);
    if (t > s->work->flight.time[b]) {
        const double fall = s->bodies[b]->fall;
        findStateAt(s, b, t);
        kea_commitBody(s, b);
        s->bodies[b]->fall = fall; /* MdtKeaIntegrate adds that of the whole flight */
        s->work->flight.time[b] = t;
    }
    predictBodyFrom(s, b, t);
}

/* Computes the end states of all bodies at time t, for MdtKeaIntegrate. Sets their start velocities so that the
 * accelerations that MdtKeaIntegrate stores are those since each body's last impact. */
static void endFlight(MdtKeaSystem *s, double t) {
    for (int b = 0; b < s->numBodies; b++) {
        const double leg = t - s->work->flight.time[b];
        double w[3];
        s->work->body[b].isFree = METRUE;
        findStateAt(s, b, t);
        if (leg <= 0)
            continue;
        kea_angularVelocity(s->bodies[b], s->work->end[b].quaternion, s->work->end[b].angularMomentum, w);
        for (int k = 0; k < 3; k++) { /* MdtKeaIntegrate divides by t, not by leg */
            const double v = s->work->end[b].velocity[k];
            s->velocity[b].lin[k] = v - (v - s->velocity[b].lin[k]) * t / leg;
            s->velocity[b].ang[k] = w[k] - (w[k] - s->velocity[b].ang[k]) * t / leg;
        }
    }
    s->parameters.stepsize = t;
}

/* ---- contacts ---- */

/* The body k of contact c; negative: the world. */
static int bodyOf(const MdtKeaSystem *s, int c, int k) {
    return s->work->contact[c].manifold->body[k];
}

/* Lists the contacts of each body, by a counting sort. */
static void listContactsOfBodies(MdtKeaSystem *s) {
    KeaFlight *f = &s->work->flight;
    memset(f->start, 0, ((size_t)s->numBodies + 1) * sizeof *f->start);
    for (int c = 0; c < s->work->numContacts; c++)
        for (int k = 0; k < 2; k++)
            if (bodyOf(s, c, k) >= 0)
                f->start[bodyOf(s, c, k)]++;
    for (int b = 0; b < s->numBodies; b++)
        f->start[b + 1] += f->start[b];
    for (int c = s->work->numContacts - 1; c >= 0; c--)
        for (int k = 0; k < 2; k++)
            if (bodyOf(s, c, k) >= 0)
                f->list[--f->start[bodyOf(s, c, k)]] = c;
    MEASSERT(f->start[0] == 0);
}

/* Whether the owner has removed all rows of contact c. */
static MeBool isLeftOut(const MdtKeaSystem *s, int c) {
    return s->work->contact[c].at->numRows == 0;
}

/* The contact with the earliest predicted impact; -1: none before the end of the step. */
static int earliestImpact(const MdtKeaSystem *s) {
    const double *impactTime = s->work->flight.impactTime;
    double time = s->work->flight.end;
    int first = -1;
    for (int c = 0; c < s->work->numContacts; c++)
        if (impactTime[c] < time) {
            time = impactTime[c];
            first = c;
        }
    return first;
}

/* Makes the normal row of a contact, whose bodies have been advanced, as the only row of the system. */
static void makeNormalRow(MdtKeaSystem *s, int c) {
    KeaContact *contact = &s->work->contact[c];
    kea_contactChooseRows(s, contact);
    contact->at->numRows = 1;
    s->numRows = 0;
    kea_contactMakeRows(s, contact, 0);
}

/* Predicts the next impact of contact c, whose bodies are at time t. */
static void predictImpact(MdtKeaSystem *s, int c, double t) {
    if (isLeftOut(s, c))
        return;
    makeNormalRow(s, c);
    s->rows[0].isOpen = METRUE;
    s->work->flight.impactTime[c] = t + kea_freeTimeOfImpact(s, 0);
}

/* ---- impacts ---- */

/* Adds body b to those of the impact, if it is not among them yet; the world is ignored. */
static void addFlightBody(MdtKeaSystem *s, int b) {
    KeaFlight *f = &s->work->flight;
    if (b < 0 || f->isInvolved[b])
        return;
    f->isInvolved[b] = 1;
    MEASSERT(f->numBodies < s->numBodies);
    f->body[f->numBodies++] = b;
}

/* Adds all bodies that touch a body of the impact at time t, directly or through others, and makes rows of their
 * touching contacts. All bodies that have a contact with one of them are advanced to that time. */
static void collectTouching(MdtKeaSystem *s, double t) {
    KeaFlight *f = &s->work->flight;
    s->numRows = f->numTouching = 0;
    for (int n = 0; n < f->numBodies; n++)
        for (int i = f->start[f->body[n]]; i < f->start[f->body[n] + 1]; i++) {
            const int c = f->list[i], first = s->numRows;
            KeaContact *contact = &s->work->contact[c];
            if (isLeftOut(s, c) || f->impactTime[c] == -HUGE_VAL) /* its rows are made already */
                continue;
            for (int k = 0; k < 2; k++)
                advanceBodyTo(s, bodyOf(s, c, k), t);
            kea_contactChooseRows(s, contact);
            kea_contactMakeRows(s, contact, -1 - c);
            if (!kea_isTouching(s, &s->rows[first])) {
                s->numRows = first;
                continue;
            }
            f->impactTime[c] = -HUGE_VAL;
            MEASSERT(f->numTouching < s->work->numContacts);
            f->touching[f->numTouching++] = c;
            for (int k = 0; k < 2; k++)
                addFlightBody(s, bodyOf(s, c, k));
        }
}

/* Whether flight may go on after the impact: all its contacts separate, and no body rotates so far in the remaining
 * step that the rates of its contacts do not predict the next impact. */
static MeBool areSeparated(const MdtKeaSystem *s) {
    const KeaFlight *f = &s->work->flight;
    for (int i = 0; i < f->numTouching; i++)
        if (!kea_isContactOpen(s, s->work->contact[f->touching[i]].firstRow, f->scale.speed))
            return MEFALSE;
    for (int n = 0; n < f->numBodies; n++) {
        const int b = f->body[n];
        const MeBool isFast = s->parameters.stepsize * keaLength(s->velocity[b].ang) > kea_maxTurn;
        for (int i = f->start[b]; isFast && i < f->start[b + 1]; i++)
            if (!s->work->contact[f->list[i]].isAboutCentre[bodyOf(s, f->list[i], 0) == b ? 0 : 1])
                return MEFALSE;
    }
    return METRUE;
}

/* Resolves the predicted impact of contact c at time t. False: rows act from time t on. */
static MeBool resolveImpact(MdtKeaSystem *s, int c, double t) {
    KeaFlight *f = &s->work->flight;
    for (int k = 0; k < 2; k++)
        advanceBodyTo(s, bodyOf(s, c, k), t);
    makeNormalRow(s, c);
    if (!kea_isTouching(s, &s->rows[0])) { /* predicted too early: the body's rotation has moved the contact */
        predictImpact(s, c, t);
        f->impactTime[c] = keaMax(f->impactTime[c], t + f->min);
        f->misses++;
        return METRUE;
    }
    f->numBodies = 0;
    for (int k = 0; k < 2; k++)
        addFlightBody(s, bodyOf(s, c, k));
    collectTouching(s, t);
    if (kea_impactsChatter(s, &f->scale)) /* too slow to rebound */
        return MEFALSE;
    const MeBool isDone = kea_resolveImpacts(s, &f->scale), isSeparated = isDone && areSeparated(s);
    for (int i = 0; i < f->numTouching; i++)
        kea_contactAddForces(s, &s->work->contact[f->touching[i]]);
    for (int n = 0; n < f->numBodies; n++)
        f->isInvolved[f->body[n]] = 0;
    for (int n = 0; n < f->numBodies && isSeparated; n++)
        for (int i = f->start[f->body[n]]; i < f->start[f->body[n] + 1]; i++)
            predictImpact(s, f->list[i], t);
    f->impacts++;
    return isSeparated;
}

/* Predicts the first impact of each contact; min: s, the shortest advance after a wrong prediction. */
static void beginFlight(MdtKeaSystem *s, double min) {
    KeaFlight *f = &s->work->flight;
    f->scale = kea_eventScale(s);
    f->end = s->parameters.stepsize;
    f->min = min;
    f->impacts = f->misses = 0;
    listContactsOfBodies(s);
    for (int b = 0; b < s->numBodies; b++) {
        f->time[b] = 0;
        f->isInvolved[b] = 0;
    }
    for (int c = 0; c < s->work->numContacts; c++) {
        f->impactTime[c] = isLeftOut(s, c) ? HUGE_VAL : kea_freeTimeOfImpact(s, s->work->contact[c].firstRow);
        keaZero(s->work->contact[c].at->force);
    }
}

double MEAPI MdtKeaFly(MdtKeaSystem *s, double min, int maxImpacts) {
    const KeaFlight *f = &s->work->flight;
    const double elapsed = s->parameters.elapsed;
    double t, work = 0;
    MEASSERT(min > 0 && min < s->parameters.stepsize);
    beginFlight(s, min);
    for (MeBool flies = METRUE; flies;) {
        const int c = earliestImpact(s);
        t = c < 0 ? f->end : f->impactTime[c];
        /* misses are few, since a new prediction is right to the next order; each one advances by at least f->min */
        if (c < 0 || f->impacts == maxImpacts || f->misses > maxImpacts ||
            (s->parameters.maxWork > 0 && work > s->parameters.maxWork))
            break;
        s->parameters.elapsed = elapsed + t;
        s->report.work = 0;
        flies = resolveImpact(s, c, t);
        work += s->report.work;
    }
    t = keaMax(t, min);
    endFlight(s, t);
    s->numRows = 0;
    s->parameters.elapsed = elapsed;
    s->report.work = work;
    s->report.impacts = f->impacts;
    MEASSERT(t >= min && t <= f->end);
    return t;
}
