/* Simultaneous impacts: instantaneous changes of velocity by the law of restitution (kea_restitution.c).
 *
 * They are resolved in rounds (generalized reflections: Smith et al., Reflections on Simultaneous Impact, 2012): each
 * round reflects all approaching contacts at once, until no rebound is faster than a fiftieth of the first. So only the
 * last ball of a Newton's cradle leaves, and a box that lands flat does not rotate. A round that would add energy is
 * interpolated with the one without restitution (kea_energy.c).
 *
 * Only bodies that acting rows connect with an approaching contact take part: all others of the partition keep their
 * velocities, to the last bit.
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
            rate += kea_rateAlong(&row->J[k], &s->velocity[row->body[k]]);
    return row->contact == i ? rate + row->target - row->drift : rate;
}

double kea_eventSpeed(const MdtKeaSystem *s) {
    double speed = 0;
    for (int i = 0; i < s->numBodies; i++)
        speed =
            keaMax(speed, keaLength(s->bodies[i]->velocity) + s->work->body[i].size * keaLength(s->velocity[i].ang));
    return keaMax(kea_loadSpeed(s), kea_unloadedSpeed * speed);
}

KeaEventScale kea_eventScale(const MdtKeaSystem *s) {
    KeaEventScale scale = {.speed = kea_eventSpeed(s)};
    for (int b = 0; b < s->numBodies; b++) {
        scale.fastest = keaMax(scale.fastest, keaLength(s->velocity[b].lin));
        scale.mass += 1 / s->bodies[b]->invMass;
    }
    return scale;
}

MeBool kea_isTouching(const MdtKeaSystem *s, const MdtKeaRow *row) {
    const double gap = row->rolls && row->force > 0 ? kea_nearbyGap : kea_touchingGap;
    return row->error < gap * kea_smallerExtent(s, row->body);
}

/* ---- the inner problem of an instant ---- */

void kea_setInstantBody(KeaProblem *q, int b, const MdtKeaBody *body) {
    KeaMetric *B = &q->metric[b];
    B->linear = 1 / body->invMass;
    kea_inertia(body, body->quaternion, B->angular);
    kea_invert(B->inverse, (const double(*)[3])B->angular);
    q->length[b] = kea_bodyExtent(body);
    memset(q->load[b], 0, sizeof q->load[b]);
}

void kea_setInstantRow(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const MdtKeaRow *row = &s->rows[i];
    for (int k = 0; k < 2; k++) {
        p->body[k] = row->body[k];
        kea_copyBlock(p->J[k], &row->J[k]);
    }
    kea_lockRow(s, p->body, p->J);
    p->normal = row->normal;
    p->partner = row->partner;
    p->friction = row->friction;
    p->isSplit = row->isSplit;
    p->isTail = row->isTail;
    /* a force with a finite bound has no impulse in an instant */
    p->lower = row->normal >= 0 || row->lower == -HUGE_VAL ? -HUGE_VAL : 0;
    p->upper = row->normal >= 0 || row->upper == HUGE_VAL ? HUGE_VAL : 0;
    p->E = row->contact == i ? 0 : row->softness;
    p->p = p->p0 = 0;
    p->isForced = p->isCheckedElsewhere = p->isOut = MEFALSE;
    p->state = KEA_ACTIVE;
}

/* Whether a row can have an impulse in an instant: touching contacts, joints without bounds, stops that are reached. */
static MeBool actsInInstant(const MdtKeaSystem *s, int i) {
    const MdtKeaRow *row = &s->rows[i];
    if (row->contact >= 0)
        return kea_isTouching(s, &s->rows[row->contact]);
    if (row->spring)
        return MEFALSE;
    const MeBool isStop = row->position && (row->lower == -HUGE_VAL) != (row->upper == HUGE_VAL);
    return isStop ? row->error <= 0 : row->lower == -HUGE_VAL && row->upper == HUGE_VAL;
}

/* Whether row i is the normal row of a touching contact whose bodies approach each other faster than `slowest`, m/s. */
static MeBool isApproaching(const MdtKeaSystem *s, int i, double slowest) {
    return s->rows[i].contact == i && kea_isTouching(s, &s->rows[i]) && -kea_startRate(s, i) > slowest;
}

/* Adds a body to the problem, if it is not in it yet. */
static void addImpactBody(MdtKeaSystem *s, int b) {
    KeaProblem *q = &s->work->problem;
    if (s->work->problemBodyOf[b] >= 0)
        return;
    MEASSERT(q->numBodies < s->numBodies);
    s->work->activeBody[q->numBodies] = b;
    s->work->problemBodyOf[b] = q->numBodies++;
}

/* Begins union-find with each body of the rows in a set of its own, and none of them in the problem. */
static void beginBodySets(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        for (int k = 0; k < 2; k++)
            if (s->rows[i].body[k] >= 0) {
                s->work->parent[s->rows[i].body[k]] = s->rows[i].body[k];
                s->work->problemBodyOf[s->rows[i].body[k]] = -1;
            }
}

/* Adds to the problem, in the order of rows, all bodies that acting rows (work->isIncluded) connect with an approaching
 * contact. First the roots of their sets are added, which marks these sets. */
static void collectImpactBodies(MdtKeaSystem *s, double slowest) {
    KeaProblem *q = &s->work->problem;
    int *parent = s->work->parent, *place = s->work->problemBodyOf;
    beginBodySets(s);
    for (int i = 0; i < s->numRows; i++)
        if (s->work->isIncluded[i] && s->rows[i].body[0] >= 0 && s->rows[i].body[1] >= 0)
            kea_unite(parent, s->rows[i].body[0], s->rows[i].body[1]);
    q->numBodies = 0;
    for (int i = 0; i < s->numRows; i++) {
        const MeBool isReached = isApproaching(s, i, slowest);
        for (int k = 0; isReached && k < 2; k++)
            if (s->rows[i].body[k] >= 0)
                addImpactBody(s, kea_rootOf(parent, s->rows[i].body[k]));
    }
    for (int i = 0; i < s->numRows; i++)
        for (int k = 0; k < 2; k++)
            if (s->rows[i].body[k] >= 0 && place[kea_rootOf(parent, s->rows[i].body[k])] >= 0)
                addImpactBody(s, s->rows[i].body[k]);
}

/* N s: the scale of a body's impulses, to which its tolerance is relative. The body's own speed counts, and the
 * residual that the passes of an impact leave of the fastest body's speed: a body almost at rest beside fast ones would
 * never reach ten digits of its own speed. */
static double momentumScaleOf(const MdtKeaSystem *s, int b, const MdtKeaVelocity *v) {
    const KeaProblem *q = &s->work->problem;
    const double own = keaLength(v->lin) + q->length[b] * keaLength(v->ang);
    return q->metric[b].linear * keaMax(own + kea_impactTolerance / kea_newtonTolerance * s->work->speed,
                                        kea_minSpeed(q->length[b], s->parameters.stepsize));
}

/* Sets row k of the problem, which is row i of the system. */
static void setImpactRow(MdtKeaSystem *s, int k, int i) {
    KeaProblemRow *p = &s->work->problem.row[k];
    MEASSERT(k <= i && i < s->numRows);
    s->work->activeRow[k] = i;
    s->work->problemRowOf[i] = k;
    kea_setInstantRow(s, i, p);
    for (int side = 0; side < 2; side++)
        p->body[side] = p->body[side] >= 0 ? s->work->problemBodyOf[p->body[side]] : p->body[side];
}

/* Sets up the inner problem of the rows that act in an instant, on bodies that an impact faster than `slowest` may
 * move. work->activeRow and activeBody map its rows and bodies to those of the system. */
static void setImpactProblem(MdtKeaSystem *s, double slowest) {
    KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numRows; i++)
        s->work->isIncluded[i] = (char)actsInInstant(s, i);
    collectImpactBodies(s, slowest);
    for (int b = 0; b < q->numBodies; b++) {
        kea_setInstantBody(q, b, s->bodies[s->work->activeBody[b]]);
        q->scale[b] = momentumScaleOf(s, b, &s->velocity[s->work->activeBody[b]]);
    }
    q->numRows = 0;
    for (int i = 0; i < s->numRows; i++) {
        const int *body = s->rows[i].body;
        if (s->work->isIncluded[i] && s->work->problemBodyOf[body[body[0] >= 0 ? 0 : 1]] >= 0)
            setImpactRow(s, q->numRows++, i);
        if (q->numRows > 0 && q->row[q->numRows - 1].isSplit)
            setImpactRow(s, q->numRows++, i + 1);
    }
    for (int k = 0; k < q->numRows; k++) {
        KeaProblemRow *p = &q->row[k];
        p->normal = p->normal >= 0 ? s->work->problemRowOf[p->normal] : p->normal;
        p->partner = p->partner >= 0 ? s->work->problemRowOf[p->partner] : p->partner;
    }
}

/* ---- one round ---- */

/* m/s: the change of row i's rate that a round aims at: of contacts to the rates `target`, of stops to the rate of
 * their attachments; 0 for joints. */
static double targetChangeOfRate(const MdtKeaSystem *s, int i, const double target[]) {
    const MdtKeaRow *row = &s->rows[i];
    if (row->contact >= 0)
        return (row->contact == i ? target[i] : 0) - kea_startRate(s, i);
    return row->lower == -HUGE_VAL && row->upper == HUGE_VAL ? 0 : row->drift - row->target - kea_startRate(s, i);
}

/* One round: contacts with isIncluded (by normal row) get their target velocities, joints keep their rates, all other
 * rows are inactive. Writes the change of velocities to `change`. */
static void solveRound(MdtKeaSystem *s, const double target[], const char isIncluded[], double (*change)[6]) {
    KeaProblem *q = &s->work->problem;
    double start = -1;
    for (int k = 0; k < q->numRows; k++) {
        KeaProblemRow *p = &q->row[k];
        const int i = s->work->activeRow[k], contact = s->rows[i].contact;
        p->isInactive = (contact >= 0 && !isIncluded[contact]) || p->Aii == 0;
        p->p = p->p0 = 0;
        p->frictionBound = HUGE_VAL;
        p->Jd = 0;
        p->r = targetChangeOfRate(s, i, target);
    }
    for (int b = 0; b < q->numBodies; b++) {
        memset(change[b], 0, sizeof change[b]);
        memset(q->load[b], 0, sizeof q->load[b]);
    }
    for (int pass = 0; pass < KEA_MAX_IMPACT_PASSES; pass++) {
        for (int i = 0; i < q->numRows; i++)
            q->row[i].N = keaMax(kea_proximalContact[0] * pow(kea_proximalContact[0] / kea_proximalContact[1], -pass),
                                 kea_proximalContact[KEA_PROXIMAL_LEVELS - 1]) *
                          q->row[i].Aii;
        kea_problemShareN(q);
        if (pass > 0)
            kea_frictionIterateBounds(q, pass);
        q->isWarm = pass > 0; /* the first pass, a convex problem, shares impulses evenly */
        kea_problemSolve(q, METRUE);
        kea_problemAccumulate(q, change);
        const double residual = kea_problemResidual(q, NULL);
        start = start < 0 ? residual : start;
        if ((pass > 0 && residual <= kea_impactTolerance * (start + s->work->speed)) || q->counts.isLimited)
            break;
    }
}

/* The velocity of body b of the problem. */
static MdtKeaVelocity *impactVelocityOf(const MdtKeaSystem *s, int b) {
    return &s->velocity[s->work->activeBody[b]];
}

static void addVelocityChange(MdtKeaSystem *s, double (*change)[6]) {
    for (int b = 0; b < s->work->problem.numBodies; b++) {
        keaAddScaled(impactVelocityOf(s, b)->lin, 1, change[b]);
        keaAddScaled(impactVelocityOf(s, b)->ang, 1, change[b] + 3);
    }
}

/* The present velocities of the problem's bodies, copied to work->velocity, which the energy limiter reads. */
static double (*presentVelocities(const MdtKeaSystem *s))[6] {
    for (int b = 0; b < s->work->problem.numBodies; b++) {
        keaCopy(s->work->velocity[b], impactVelocityOf(s, b)->lin);
        keaCopy(s->work->velocity[b] + 3, impactVelocityOf(s, b)->ang);
    }
    return s->work->velocity;
}

/* J: kinetic energy of the problem's bodies after a change of their velocities; null: at present. */
static double energyAfter(const MdtKeaSystem *s, double (*change)[6]) {
    return kea_kineticEnergy(s, presentVelocities(s), change);
}

/* J: the work that the impulses of the last solve take from a moving world. */
static double workOfWorld(const MdtKeaSystem *s) {
    const KeaProblem *q = &s->work->problem;
    double work = 0;
    for (int k = 0; k < q->numRows; k++)
        if (!q->row[k].isInactive)
            work += q->row[k].p * s->rows[s->work->activeRow[k]].drift;
    return work;
}

/* Whether the change adds no energy but the work of the world; false if it is not finite, as when friction bounds do
 * not converge. */
static MeBool addsNoEnergy(const MdtKeaSystem *s, double (*change)[6], double work) {
    return energyAfter(s, change) <= (energyAfter(s, NULL) + keaMax(work, 0)) * (1 + kea_energyRounding);
}

/* Adds the plastic change plus the largest fraction of (elastic - plastic) with which no energy is added but `work`. */
static void addBlendedChange(MdtKeaSystem *s, double (*elastic)[6], double (*plastic)[6], double work) {
    const double before = energyAfter(s, NULL) + keaMax(work, 0);
    MEASSERT(addsNoEnergy(s, plastic, work));
    const double share =
        isfinite(energyAfter(s, elastic)) ? kea_elasticShare(s, presentVelocities(s), elastic, plastic, before) : 0;
    addVelocityChange(s, plastic);
    for (int b = 0; share > 0 && b < s->work->problem.numBodies; b++) {
        for (int k = 0; k < 3; k++) {
            impactVelocityOf(s, b)->lin[k] += share * (elastic[b][k] - plastic[b][k]);
            impactVelocityOf(s, b)->ang[k] += share * (elastic[b][3 + k] - plastic[b][3 + k]);
        }
    }
    MEASSERT(energyAfter(s, NULL) <= before * (1 + kea_assertedRounding));
}

/* Adds the impulses of the round to the rows. */
static void storeImpulses(MdtKeaSystem *s) {
    const KeaProblem *q = &s->work->problem;
    for (int k = 0; k < q->numRows; k++)
        if (!q->row[k].isInactive)
            s->rows[s->work->activeRow[k]].force += q->row[k].p;
}

/* ---- approaching contacts ---- */

/* The slowest approach that is an impact, as a fraction of the event speed. A soft contact yields to its load with
 * J v⁺ = -h E λ, where λ is at most the weight of all bodies. */
static double minImpactSpeedOf(const MdtKeaRow *row, double mass) {
    return keaMin(kea_minImpactSpeed + row->softness * mass, kea_softContactSpeed);
}

MeBool MEAPI MdtKeaMeets(const MdtKeaSystem *s) {
    const KeaEventScale scale = kea_eventScale(s);
    if (kea_impactsWait(s, scale.speed))
        return MEFALSE;
    for (int i = 0; i < s->numRows; i++)
        if (isApproaching(s, i, minImpactSpeedOf(&s->rows[i], scale.mass) * scale.speed))
            return METRUE;
    return MEFALSE;
}

MeBool kea_impactsChatter(const MdtKeaSystem *s, const KeaEventScale *scale) {
    const double speed = scale->speed;
    MeBool approaches = MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (row->contact != i)
            continue;
        const MeBool isTouching = kea_isTouching(s, row);
        const double rate = kea_startRate(s, i);
        if (rate < -kea_minDividingSpeed(row->restitution, HUGE_VAL, speed) &&
            (isTouching || row->error + s->parameters.stepsize * rate < 0))
            return MEFALSE;
        approaches = approaches || (isTouching && kea_mayChatter(s, row, speed) &&
                                    rate < -keaMax(kea_separatingSpeed, minImpactSpeedOf(row, scale->mass)) * speed);
    }
    return approaches;
}

MeBool MEAPI MdtKeaTrembles(const MdtKeaSystem *s) {
    const KeaEventScale scale = kea_eventScale(s);
    return kea_impactsChatter(s, &scale);
}

/* m²/s²: what the loads have added to the square of a contact's approach speed since its surfaces met. */
static double fallOf(const MdtKeaSystem *s, const MdtKeaRow *row) {
    double change = 0; /* m/s: the velocities that bodies have before the impact, less those by loads at the end */
    for (int k = 0; k < 2 && row->error < 0; k++)
        if (row->body[k] >= 0)
            change += keaDot(row->J[k].lin, s->bodies[row->body[k]]->velocity) -
                      keaDot(row->J[k].lin, s->predicted[row->body[k]].lin);
    return 2 * keaMax(-row->error, 0) * keaMax(change, 0) / s->parameters.stepsize;
}

/* m/s: the rebound of a contact, slower than minSpeed none. */
static double reboundOf(const MdtKeaSystem *s, int i, double minSpeed) {
    const MdtKeaRow *row = &s->rows[i];
    return kea_reboundOfImpact(row->restitution, row->threshold, -kea_startRate(s, i), fallOf(s, row), minSpeed);
}

/* m/s: of the touching contact that approaches fastest. */
static double fastestApproach(const MdtKeaSystem *s) {
    double fastest = 0;
    for (int k = 0; k < s->work->problem.numRows; k++)
        if (isApproaching(s, s->work->activeRow[k], fastest))
            fastest = -kea_startRate(s, s->work->activeRow[k]);
    return fastest;
}

/* Marks the touching contacts that take part in a round (isIncluded): those that approach faster than `slowest`, and
 * not far more slowly than the fastest one, which acts first: else it would depend on rounding how two balls that move
 * side by side hit a third. Returns the speed of the fastest rebound among them; 0: none rebounds. */
static double markApproachingContacts(MdtKeaSystem *s, double slowest, double minReboundSpeed, char isIncluded[]) {
    const double min = keaMax(slowest, kea_lastRound * fastestApproach(s));
    double fastest = 0;
    for (int k = 0; k < s->work->problem.numRows; k++) {
        const int i = s->work->activeRow[k];
        isIncluded[i] = (char)isApproaching(s, i, min);
        if (isIncluded[i])
            fastest = keaMax(fastest, reboundOf(s, i, minReboundSpeed));
    }
    return fastest;
}

/* Sets the velocities at which the included contacts are to separate, without a minimal speed: if one contact rebounds,
 * slow ones do so too. A contact that is stopped would dissipate p v / 2, with an impulse p that is due to the others
 * and may be large. */
static void setReboundTargets(const MdtKeaSystem *s, const char isIncluded[], double target[]) {
    for (int k = 0; k < s->work->problem.numRows; k++) {
        const int i = s->work->activeRow[k];
        target[i] = isIncluded[i] ? reboundOf(s, i, 0) : 0;
    }
}

/* ---- rounds ---- */

/* Solves a round and adds its change of velocities; if that would add energy, a part of it. False: even the change
 * without restitution would add energy. Nothing is changed then, and the solve of the step stops the contacts. */
static MeBool applyRound(MdtKeaSystem *s, const double target[], const char isIncluded[]) {
    solveRound(s, target, isIncluded, s->work->added);
    if (addsNoEnergy(s, s->work->added, workOfWorld(s))) {
        storeImpulses(s);
        addVelocityChange(s, s->work->added);
        return METRUE;
    }
    memset(s->work->target + s->numRows, 0, (size_t)s->numRows * sizeof(double));
    solveRound(s, s->work->target + s->numRows, isIncluded, s->work->plastic);
    const double work = workOfWorld(s);
    if (!addsNoEnergy(s, s->work->plastic, work))
        return MEFALSE;
    storeImpulses(s);
    addBlendedChange(s, s->work->added, s->work->plastic, work);
    return METRUE;
}

/* Prepares a last round, in which all contacts that still approach are stopped. */
static void includeAllContacts(MdtKeaSystem *s, double target[], char isIncluded[]) {
    for (int k = 0; k < s->work->problem.numRows; k++) {
        const int i = s->work->activeRow[k];
        target[i] = 0;
        isIncluded[i] = (char)(s->rows[i].contact == i);
    }
}

/* Writes the velocities to the bodies, and what MdtKeaInit derives from them. */
static void commitVelocities(MdtKeaSystem *s) {
    for (int b = 0; b < s->work->problem.numBodies; b++) {
        MdtKeaBody *body = s->bodies[s->work->activeBody[b]];
        keaCopy(body->velocity, impactVelocityOf(s, b)->lin);
        MdtKeaBodySetAngularVelocity(body, impactVelocityOf(s, b)->ang);
        kea_beginBody(s, s->work->activeBody[b]);
    }
}

MeBool kea_resolveImpacts(MdtKeaSystem *s, const KeaEventScale *scale) {
    double *target = s->work->target;
    char *isIncluded = s->work->isIncluded;
    const double minReboundSpeed = kea_minReboundSpeed * scale->speed;
    const double slowest = kea_velocityTolerance * keaMax(scale->speed, scale->fastest);
    MEASSERT(scale->speed >= 0 && scale->mass > 0);
    s->work->speed = scale->fastest;
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].force = 0;
    setImpactProblem(s, slowest);
    if (!kea_problemBegin(&s->work->problem, s->cache))
        return MEFALSE;
    kea_setBudget(s, 1, 1);
    kea_problemSetEffectiveMasses(&s->work->problem);
    double first = 0; /* m/s: the fastest rebound of the first round */
    for (int round = 0; round < KEA_MAX_ROUNDS; round++) {
        const double fastest = markApproachingContacts(s, slowest, minReboundSpeed, isIncluded);
        first = keaMax(first, fastest);
        if (!(fastest > kea_lastRound * first))
            break;
        setReboundTargets(s, isIncluded, target);
        if (!applyRound(s, target, isIncluded) || s->work->problem.counts.isLimited)
            break;
    }
    includeAllContacts(s, target, isIncluded);
    applyRound(s, target, isIncluded);
    commitVelocities(s);
    kea_reportWork(s);
    return METRUE;
}
