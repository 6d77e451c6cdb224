/* Flight: bodies that bounce, and that nothing holds, follow their own paths from impact to impact.
 *
 * Without rows a body's path is known until it is hit. So each body has a time of its own, up to which it has been
 * moved, and each contact the time at which its bodies meet next. The contact that meets first comes next: its bodies
 * are moved to that time, and those that touch them take part in the impact (kea_impact.c); then the contacts of all of
 * these find anew when they meet. What the others do does not matter: an impact costs as much among many bodies as
 * among few bodies.
 *
 * Flight ends with the step, or with an impact after which a contact is closed: from there on rows act.
 */
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include "exact/kea_contact_i.h"
#include <string.h>

/* ---- bodies ---- */

/* What is known of a body by its state at time t, with the rest of the step before it. */
static void beginAt(MdtKeaSystem *s, int b, double t) {
    s->parameters.stepsize = s->work->flight.end - t;
    kea_beginBody(s, b);
}

/* Moves a body on to time t; its state there is an end state, not yet committed. */
static void flyTo(MdtKeaSystem *s, int b, double t) {
    s->parameters.stepsize = t - s->work->flight.time[b];
    kea_beginBody(s, b);
    kea_moveFreeBody(s, b);
}

static void moveTo(MdtKeaSystem *s, int b, double t) {
    if (b < 0)
        return;
    MEASSERT(t >= s->work->flight.time[b] && t < s->work->flight.end);
    if (t > s->work->flight.time[b]) {
        flyTo(s, b, t);
        kea_commitBody(s, b);
        s->work->flight.time[b] = t;
    }
    beginAt(s, b, t);
}

/* Moves all bodies on to time t, for MdtKeaIntegrate. Accelerations are those of the last leg. */
static void endFlight(MdtKeaSystem *s, double t) {
    for (int b = 0; b < s->numBodies; b++) {
        const double leg = t - s->work->flight.time[b];
        double w[3];
        s->work->body[b].isFree = METRUE;
        flyTo(s, b, t);
        if (leg <= 0)
            continue;
        kea_angularVelocity(s->bodies[b], s->work->end[b].quaternion, s->work->end[b].angularMomentum, w);
        for (int k = 0; k < 3; k++) { /* as if it had flown like that all the time */
            const double v = s->work->end[b].velocity[k];
            s->velocity[b].lin[k] = v - (v - s->velocity[b].lin[k]) * t / leg;
            s->velocity[b].ang[k] = w[k] - (w[k] - s->velocity[b].ang[k]) * t / leg;
        }
    }
    s->parameters.stepsize = t;
}

/* ---- contacts ---- */

static int bodyOf(const MdtKeaSystem *s, int c, int k) {
    return s->work->contact[c].manifold->body[k];
}

/* Sorts contacts by their bodies: a counting sort. */
static void listContacts(MdtKeaSystem *s) {
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
}

/* The owner may have left out all of its rows. */
static MeBool isLeftOut(const MdtKeaSystem *s, int c) {
    return s->work->contact[c].at->numRows == 0;
}

/* -1: nothing meets before the end. */
static int earliest(const MdtKeaSystem *s) {
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

/* Makes the normal row of a contact whose bodies are at time t, as the system's only one. */
static void makeNormalRow(MdtKeaSystem *s, int c) {
    KeaContact *contact = &s->work->contact[c];
    kea_contactChooseRows(s, contact);
    contact->at->numRows = 1;
    s->numRows = 0;
    kea_contactMakeRows(s, contact, 0);
}

/* When they meet next. */
static void findMeeting(MdtKeaSystem *s, int c, double t) {
    if (isLeftOut(s, c))
        return;
    makeNormalRow(s, c);
    s->rows[0].isOpen = METRUE;
    s->work->flight.impactTime[c] = t + kea_freeTimeOfImpact(s, 0);
}

/* ---- impacts ---- */

static void addFlightBody(MdtKeaSystem *s, int b) {
    KeaFlight *f = &s->work->flight;
    if (b < 0 || f->isIn[b])
        return;
    f->isIn[b] = 1;
    f->body[f->numBodies++] = b;
}

/* The bodies that take part in an impact at time t, and rows of all contacts at which they touch. All bodies that have
 * a contact with one of them are moved to that time. */
static void gather(MdtKeaSystem *s, double t) {
    KeaFlight *f = &s->work->flight;
    s->numRows = f->numTouching = 0;
    for (int n = 0; n < f->numBodies; n++)
        for (int i = f->start[f->body[n]]; i < f->start[f->body[n] + 1]; i++) {
            const int c = f->list[i], first = s->numRows;
            KeaContact *contact = &s->work->contact[c];
            if (isLeftOut(s, c) || f->impactTime[c] == -HUGE_VAL) /* it is among them */
                continue;
            for (int k = 0; k < 2; k++)
                moveTo(s, bodyOf(s, c, k), t);
            kea_contactChooseRows(s, contact);
            kea_contactMakeRows(s, contact, -1 - c);
            if (!kea_isTouching(s, &s->rows[first])) {
                s->numRows = first;
                continue;
            }
            f->impactTime[c] = -HUGE_VAL;
            f->touching[f->numTouching++] = c;
            for (int k = 0; k < 2; k++)
                addFlightBody(s, bodyOf(s, c, k));
        }
}

/* Whether all part, and no body turns so far that its contacts do not tell when it meets the next one. */
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

static void addImpulses(MdtKeaSystem *s) {
    const KeaFlight *f = &s->work->flight;
    for (int i = 0; i < f->numTouching; i++)
        kea_contactAddForces(s, &s->work->contact[f->touching[i]]);
}

/* False: rows act from time t on. */
static MeBool collide(MdtKeaSystem *s, int c, double t) {
    KeaFlight *f = &s->work->flight;
    for (int k = 0; k < 2; k++)
        moveTo(s, bodyOf(s, c, k), t);
    makeNormalRow(s, c);
    if (!kea_isTouching(s, &s->rows[0])) { /* a turn has changed the path that was foreseen */
        findMeeting(s, c, t);
        f->impactTime[c] = keaMax(f->impactTime[c], t + f->min);
        f->misses++;
        return METRUE;
    }
    f->numBodies = 0;
    for (int k = 0; k < 2; k++)
        addFlightBody(s, bodyOf(s, c, k));
    gather(s, t);
    if (kea_impactsChatter(s, &f->scale)) /* too slow to rebound */
        return MEFALSE;
    const MeBool isDone = kea_impact(s, &f->scale), isSeparated = isDone && areSeparated(s);
    addImpulses(s);
    for (int n = 0; n < f->numBodies; n++)
        f->isIn[f->body[n]] = 0;
    for (int n = 0; n < f->numBodies && isSeparated; n++)
        for (int i = f->start[f->body[n]]; i < f->start[f->body[n] + 1]; i++)
            findMeeting(s, f->list[i], t);
    f->impacts++;
    return isSeparated;
}

static void beginFlight(MdtKeaSystem *s, double min) {
    KeaFlight *f = &s->work->flight;
    f->scale = kea_eventScale(s);
    f->end = s->parameters.stepsize;
    f->min = min;
    f->impacts = f->misses = 0;
    listContacts(s);
    for (int b = 0; b < s->numBodies; b++) {
        f->time[b] = 0;
        f->isIn[b] = 0;
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
        const int c = earliest(s);
        t = c < 0 ? f->end : f->impactTime[c];
        /* misses are few, as a time that is foreseen anew is right to the next order; each would cost f->least */
        if (c < 0 || f->impacts == maxImpacts || f->misses > maxImpacts ||
            (s->parameters.maxWork > 0 && work > s->parameters.maxWork))
            break;
        s->parameters.elapsed = elapsed + t;
        s->report.work = 0;
        flies = collide(s, c, t);
        work += s->report.work;
    }
    t = keaMax(t, min);
    endFlight(s, t);
    s->numRows = 0;
    s->parameters.elapsed = elapsed;
    s->report.work = work;
    s->report.impacts = f->impacts;
    return t;
}
