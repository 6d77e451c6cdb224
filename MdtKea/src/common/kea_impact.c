/* Simultaneous impacts: velocities change in an instant, by the law of restitution (kea_restitution.c).
 *
 * They are resolved in rounds (generalized reflections: Smith et al., Reflections on Simultaneous Impact, 2012): each
 * reflects all contacts that approach at once, until nothing rebounds by more than a fiftieth of the first rebound. So
 * only the last ball of a Newton's cradle leaves, and a box that lands flat does not turn. A round that would gain
 * energy is interpolated with the one without restitution (kea_energy.c).
 */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

double kea_startRate(const MdtKeaSystem *s, int i) {
    const MdtKeaRow *row = &s->rows[i];
    double rate = -row->target;
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            rate += keaDot(row->J[k].lin, s->velocity[row->body[k]].lin) +
                    keaDot(row->J[k].ang, s->velocity[row->body[k]].ang);
    return row->contact == i ? rate + row->target - row->drift : rate;
}

double kea_eventSpeed(const MdtKeaSystem *s) {
    double speed = 0;
    for (int i = 0; i < s->numBodies; i++)
        speed =
            keaMax(speed, keaLength(s->bodies[i]->velocity) + s->work->body[i].size * keaLength(s->velocity[i].ang));
    return keaMax(kea_loadSpeed(s), kea_unloadedSpeed * speed);
}

MeBool kea_isTouching(const MdtKeaSystem *s, const MdtKeaRow *row) {
    return row->error < kea_touchingGap * kea_smallerSize(s, row->body);
}

/* ---- the problem of an instant ---- */

void kea_setInstantMetric(MdtKeaSystem *s, int i) {
    KeaProblem *q = &s->work->problem;
    KeaMetric *B = &q->metric[i];
    const double *I = s->bodies[i]->moments;
    B->linear = 1 / s->bodies[i]->invMass;
    kea_inertia(s->bodies[i], s->bodies[i]->quaternion, B->angular);
    kea_invert(B->inverse, (const double(*)[3])B->angular);
    q->length[i] = sqrt(keaMax(I[0], keaMax(I[1], I[2])) * s->bodies[i]->invMass);
    memset(q->load[i], 0, sizeof q->load[i]);
}

void kea_setInstantRow(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const MdtKeaRow *row = &s->rows[i];
    for (int k = 0; k < 2; k++) {
        p->body[k] = row->body[k];
        keaCopy(p->J[k], row->J[k].lin);
        keaCopy(p->J[k] + 3, row->J[k].ang);
    }
    p->normal = row->normal;
    p->partner = row->partner;
    p->friction = row->friction;
    /* a bounded force has no impulse in an instant */
    p->lower = row->normal >= 0 || row->lower == -HUGE_VAL ? -HUGE_VAL : 0;
    p->upper = row->normal >= 0 || row->upper == HUGE_VAL ? HUGE_VAL : 0;
    p->E = row->contact == i ? 0 : row->softness;
    p->p = p->p0 = 0;
    p->isForced = p->isCheckedElsewhere = p->isOut = MEFALSE;
    p->state = KEA_HELD;
}

/* Whether a row has an impulse in an instant: touching contacts, joints without bounds, and stops that are reached. */
static MeBool actsInInstant(const MdtKeaSystem *s, int i) {
    const MdtKeaRow *row = &s->rows[i];
    if (row->contact >= 0)
        return kea_isTouching(s, &s->rows[row->contact]);
    if (row->spring)
        return MEFALSE;
    const MeBool isStop = row->position && (row->lower == -HUGE_VAL) != (row->upper == HUGE_VAL);
    return isStop ? row->error <= 0 : row->lower == -HUGE_VAL && row->upper == HUGE_VAL;
}

/* N s: what a body's impulses are compared with. One that is all but at rest beside moving ones is solved for to what
 * an impact's passes leave of their speed, not to ten digits of its own. */
static double scaleOf(const MdtKeaSystem *s, int i) {
    const KeaProblem *q = &s->work->problem;
    const double own = keaLength(s->velocity[i].lin) + q->length[i] * keaLength(s->velocity[i].ang);
    return q->metric[i].linear * keaMax(own + kea_impactTolerance / kea_newtonTolerance * s->work->speed,
                                        kea_leastSpeed(q->length[i], s->parameters.stepsize));
}

/* The inner problem of the rows that act in an instant; work->activeRow maps its rows to those of the system. */
static void setProblem(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    int *place = s->work->problemRowOf;
    q->numBodies = s->numBodies;
    q->numRows = 0;
    for (int i = 0; i < s->numBodies; i++) {
        kea_setInstantMetric(s, i);
        q->scale[i] = scaleOf(s, i);
    }
    for (int i = 0; i < s->numRows; i++)
        if (actsInInstant(s, i)) {
            place[i] = q->numRows;
            s->work->activeRow[q->numRows] = i;
            kea_setInstantRow(s, i, &q->row[q->numRows++]);
        }
    for (int k = 0; k < q->numRows; k++) {
        KeaProblemRow *p = &q->row[k];
        p->normal = p->normal >= 0 ? place[p->normal] : p->normal;
        p->partner = p->partner >= 0 ? place[p->partner] : p->partner;
    }
}

/* ---- one round ---- */

/* m/s: the change of a row's rate that is aimed at: 0 of joints; stops are not passed. */
static double changeOfRate(const MdtKeaSystem *s, int i, const double target[]) {
    const MdtKeaRow *row = &s->rows[i];
    if (row->contact >= 0)
        return (row->contact == i ? target[i] : 0) - kea_startRate(s, i);
    return row->lower == -HUGE_VAL && row->upper == HUGE_VAL ? 0 : row->drift - row->target - kea_startRate(s, i);
}

/* One round: the contacts in `takesPart` (by normal row) get their target velocities, joints hold,
 * the rest does nothing. The change of velocities is left in `change`. */
static void solveRound(MdtKeaSystem *s, const double target[], const char takesPart[], double (*change)[6]) {
    KeaProblem *q = &s->work->problem;
    double start = -1;
    for (int k = 0; k < q->numRows; k++) {
        KeaProblemRow *p = &q->row[k];
        const int i = s->work->activeRow[k], contact = s->rows[i].contact;
        p->isOff = (contact >= 0 && !takesPart[contact]) || p->Aii == 0;
        p->p = p->p0 = 0;
        p->frictionBound = HUGE_VAL;
        p->Jd = 0;
        p->r = changeOfRate(s, i, target);
    }
    for (int b = 0; b < s->numBodies; b++) {
        memset(change[b], 0, sizeof change[b]);
        memset(q->load[b], 0, sizeof q->load[b]);
    }
    for (int pass = 0; pass < KEA_MAX_IMPACT_PASSES; pass++) {
        for (int i = 0; i < q->numRows; i++)
            q->row[i].N = keaMax(kea_proximalContact[0] * pow(kea_proximalContact[0] / kea_proximalContact[1], -pass),
                                 kea_proximalContact[KEA_PROXIMAL_LEVELS - 1]) *
                          q->row[i].Aii;
        for (int i = 0; i < q->numRows; i++)
            if (q->row[i].partner > i)
                q->row[i].N = q->row[q->row[i].partner].N = keaMax(q->row[i].N, q->row[q->row[i].partner].N);
        if (pass > 0)
            kea_frictionApproachBounds(q, pass);
        kea_problemSolve(q, METRUE);
        kea_problemAccumulate(q, change);
        const double residual = kea_problemResidual(q, NULL);
        start = start < 0 ? residual : start;
        if ((pass > 0 && residual <= kea_impactTolerance * (start + s->work->speed)) || q->counts.isLimited)
            break;
    }
}

static void addChange(MdtKeaSystem *s, double (*change)[6]) {
    for (int b = 0; b < s->numBodies; b++) {
        keaAddScaled(s->velocity[b].lin, 1, change[b]);
        keaAddScaled(s->velocity[b].ang, 1, change[b] + 3);
    }
}

/* The velocities at the start, as the limiter of energy takes them. */
static double (*startVelocities(const MdtKeaSystem *s))[6] {
    for (int b = 0; b < s->numBodies; b++) {
        keaCopy(s->work->velocity[b], s->velocity[b].lin);
        keaCopy(s->work->velocity[b] + 3, s->velocity[b].ang);
    }
    return s->work->velocity;
}

static double energyWith(const MdtKeaSystem *s, double (*change)[6]) {
    return kea_kineticEnergy(s, startVelocities(s), change);
}

/* Whether the change does not add energy; false if it is not finite, as where friction bounds do not converge. */
static MeBool isAffordable(const MdtKeaSystem *s, double (*change)[6]) {
    return energyWith(s, change) <= energyWith(s, NULL) * (1 + kea_energyRounding);
}

/* Adds the plastic change, and the largest part of the difference to the elastic one that adds no energy. */
static void blend(MdtKeaSystem *s, double (*elastic)[6], double (*plastic)[6]) {
    const double before = energyWith(s, NULL);
    MEASSERT(isAffordable(s, plastic));
    const double share =
        isfinite(energyWith(s, elastic)) ? kea_elasticShare(s, startVelocities(s), elastic, plastic, before) : 0;
    addChange(s, plastic);
    for (int b = 0; share > 0 && b < s->numBodies; b++) {
        for (int k = 0; k < 3; k++) {
            s->velocity[b].lin[k] += share * (elastic[b][k] - plastic[b][k]);
            s->velocity[b].ang[k] += share * (elastic[b][3 + k] - plastic[b][3 + k]);
        }
    }
    MEASSERT(energyWith(s, NULL) <= before * (1 + kea_assertedRounding));
}

static void storeImpulses(MdtKeaSystem *s) {
    const KeaProblem *q = &s->work->problem;
    for (int k = 0; k < q->numRows; k++)
        if (!q->row[k].isOff)
            s->rows[s->work->activeRow[k]].force += q->row[k].p;
}

/* ---- approaching contacts ---- */

/* kg */
static double totalMass(const MdtKeaSystem *s) {
    double sum = 0;
    for (int i = 0; i < s->numBodies; i++)
        sum += 1 / s->bodies[i]->invMass;
    return sum;
}

/* Of the event speed: approaches slower than this are no impact. A soft contact yields to its load with J v⁺ = -h E λ,
 * where λ is at most the weight of all bodies. */
static double minImpactSpeedOf(const MdtKeaRow *row, double mass) {
    return keaMin(kea_minImpactSpeed + row->softness * mass, kea_softContactSpeed);
}

MeBool MEAPI MdtKeaMeets(const MdtKeaSystem *s) {
    const double speed = kea_eventSpeed(s), mass = totalMass(s);
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact == i && kea_isTouching(s, &s->rows[i]) &&
            kea_startRate(s, i) < -minImpactSpeedOf(&s->rows[i], mass) * speed)
            return METRUE;
    return MEFALSE;
}

MeBool MEAPI MdtKeaTrembles(const MdtKeaSystem *s) {
    const double speed = kea_eventSpeed(s), mass = totalMass(s);
    MeBool approaches = MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (row->contact != i)
            continue;
        const MeBool isTouching = kea_isTouching(s, row);
        const double rate = kea_startRate(s, i);
        if (rate < -kea_minReboundSpeed * speed && (isTouching || row->error + s->parameters.stepsize * rate < 0))
            return MEFALSE;
        approaches =
            approaches || (isTouching && rate < -keaMax(kea_partingSpeed, minImpactSpeedOf(row, mass)) * speed);
    }
    return approaches;
}

/* The touching contacts that approach faster than `slowest` (takesPart). Returns the speed with which the fastest of
 * them rebounds; 0: none does. */
static double findImpacts(MdtKeaSystem *s, double slowest, double minReboundSpeed, char takesPart[]) {
    double fastest = 0;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        const double speed = -kea_startRate(s, i);
        takesPart[i] = (char)(row->contact == i && kea_isTouching(s, row) && speed > slowest);
        if (takesPart[i])
            fastest = keaMax(fastest, kea_reboundOfImpact(row->restitution, row->threshold, speed, minReboundSpeed));
    }
    return fastest;
}

/* The velocities with which they separate. Beside a contact that rebounds the slow ones do so too: stopped, one would
 * dissipate p v / 2, with an impulse p that comes from the others and may be large. */
static void setTargets(const MdtKeaSystem *s, const char takesPart[], double target[]) {
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        target[i] = takesPart[i] ? kea_reboundOfImpact(row->restitution, row->threshold, -kea_startRate(s, i), 0) : 0;
    }
}

/* ---- rounds ---- */

/* False: every change of velocity would add energy; the contacts are left to the solve of the step. */
static MeBool applyRound(MdtKeaSystem *s, const double target[], const char takesPart[]) {
    solveRound(s, target, takesPart, s->work->added);
    if (isAffordable(s, s->work->added)) {
        storeImpulses(s);
        addChange(s, s->work->added);
        return METRUE;
    }
    memset(s->work->target + s->numRows, 0, (size_t)s->numRows * sizeof(double));
    solveRound(s, s->work->target + s->numRows, takesPart, s->work->plastic);
    if (!isAffordable(s, s->work->plastic))
        return MEFALSE;
    storeImpulses(s);
    blend(s, s->work->added, s->work->plastic);
    return METRUE;
}

static void selectTouching(MdtKeaSystem *s, double target[], char takesPart[]) {
    for (int i = 0; i < s->numRows; i++) {
        target[i] = 0;
        takesPart[i] = (char)(s->rows[i].contact == i && kea_isTouching(s, &s->rows[i]));
    }
}

static void commitVelocities(MdtKeaSystem *s) {
    for (int b = 0; b < s->numBodies; b++) {
        keaCopy(s->bodies[b]->velocity, s->velocity[b].lin);
        MdtKeaBodySetAngularVelocity(s->bodies[b], s->velocity[b].ang);
    }
}

MeBool kea_impact(MdtKeaSystem *s) {
    double *target = s->work->target;
    char *takesPart = s->work->takesPart;
    const double minReboundSpeed = kea_minReboundSpeed * kea_eventSpeed(s);
    s->work->speed = 0;
    for (int b = 0; b < s->numBodies; b++)
        s->work->speed = keaMax(s->work->speed, keaLength(s->velocity[b].lin));
    setProblem(s);
    if (!kea_problemBegin(&s->work->problem, s->cache))
        return MEFALSE;
    kea_setBudget(s, 1, 1);
    const double before = energyWith(s, NULL);
    kea_problemSetEffectiveMasses(&s->work->problem);
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].force = 0;
    const double slowest = kea_velocityTolerance * keaMax(kea_eventSpeed(s), s->work->speed);
    double first = 0; /* m/s: the fastest rebound of the first round */
    for (int round = 0; round < KEA_MAX_ROUNDS; round++) {
        const double fastest = findImpacts(s, slowest, minReboundSpeed, takesPart);
        first = keaMax(first, fastest);
        if (!(fastest > kea_lastRound * first))
            break;
        setTargets(s, takesPart, target);
        if (!applyRound(s, target, takesPart) || s->work->problem.counts.isLimited)
            break;
    }
    selectTouching(s, target, takesPart);
    applyRound(s, target, takesPart);
    MEASSERT(!(energyWith(s, NULL) > before * (1 + kea_assertedRounding)));
    commitVelocities(s);
    kea_reportWork(s);
    return METRUE;
}
