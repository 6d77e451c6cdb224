/* The velocity stage: the velocities at the end that joints, limits, motors and contacts allow where the bodies have
 * arrived, nearest to those that the positions came with.
 *
 *     min 1/2 |v - v⁺|²_M   over what the rows allow:   M (v - v⁺) = Jᵀ (p - p_1),  J at the end,
 *
 * where bounds and cones hold for the whole impulse p of the step: the stage may take some of p_1 back, as when a push
 * out of an overlap is not to go on as a motion. Energy can only fall, and what a rebound gives back is part of what
 * was there.
 *
 *   rigid joint  J v = 0        soft joint  J v + ε'/(1 - γ') p = -γ' φ⁺ / ((1 - γ') h)       motor  J v = s
 *   contact, limit: J v >= 0, or >= the rebound; only those that carry something; springs stay as they are.
 *
 * It is what makes impacts plastic that come through joints, and what quiets the undamped velocities of the midpoint
 * rule after a jerk. In calm motion there is nothing to do, and it is left out: done always, it would cost energy.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include <string.h>

enum { MAX_PASSES = 6 };
static const double calm = 0.05;      /* of a step's change of speed by the loads */
static const double tolerance = 1e-9; /* of the speed at which the stage starts */

static double loadSpeed(const MdtKeaSystem *s) {
    double speed = 0;
    for (int i = 0; i < s->numBodies; i++) {
        const KeaBody *b = &s->work->body[i];
        double change[3];
        keaSubtract(change, b->freeVelocity, s->bodies[i]->velocity);
        speed = keaMax(speed, keaLength(change));
    }
    return speed;
}

static MeBool isOneSided(const MdtKeaRow *row) {
    return (row->lower > -HUGE_VAL) != (row->upper < HUGE_VAL);
}

/* The joint's error goes on to be taken away at the same rate: what γ leaves of it, φ⁺ = (1 - γ) φ, asks for γ φ / h. */
static void jointLaw(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const MdtKeaRow *row = &s->rows[i];
    const double gamma = s->parameters.gamma, h = s->parameters.stepsize;
    p->r = row->drift;
    if (gamma >= 1)
        return;
    p->E = row->softness / (1 - gamma);
    p->r -= gamma * (s->work->errors[i] - h * row->drift) / ((1 - gamma) * h);
}

/* The row's law for the velocity, as what is to be added to the one at the end. */
static void setRow(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const MdtKeaRow *row = &s->rows[i];
    const MeBool isStop = row->contact == i || (row->position && isOneSided(row));
    p->p0 = p->p;
    p->Jd = p->E = p->r = 0;
    p->isElsewhere = MEFALSE;
    p->N = (row->position && !isOneSided(row) ? 1e-8 : 1e-6) * p->size;
    if (row->spring || p->size == 0)
        p->isOff = METRUE;
    else if (isStop)
        p->r = row->drift + row->rebound;
    else if (row->position)
        jointLaw(s, i, p);
    else
        p->r = row->target, p->E = row->softness;
    if (row->contact >= 0 ? s->work->problem.row[row->contact].p == 0 : isStop && p->p == 0)
        p->isOff = METRUE;
    p->r -= kea_endRate(s, i);
}

static void setMetric(MdtKeaSystem *s, int i) {
    KeaMetric *B = &s->work->problem.metric[i];
    B->linear = 1 / s->bodies[i]->invMass;
    kea_endInertia(s, i, B->angular);
    kea_invert(B->inverse, (const double(*)[3])B->angular);
}

/* Jᵀ p_1: what the rows have given already. */
static void setLoads(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numBodies; i++)
        memset(q->load[i], 0, sizeof q->load[i]);
    for (int i = 0; i < s->numRows; i++) {
        const KeaProblemRow *p = &q->row[i];
        for (int k = 0; k < 2; k++)
            for (int c = 0; c < 6 && p->body[k] >= 0; c++)
                q->load[p->body[k]][c] += p->p * p->J[k][c];
    }
}

static void setProblem(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    kea_refreshRows(s, s->work->endPose, MEFALSE); /* the impulse is one of the whole step */
    for (int i = 0; i < s->numBodies; i++)
        setMetric(s, i);
    kea_problemMeasure(q);
    for (int i = 0; i < s->numRows; i++)
        setRow(s, i, &q->row[i]);
    for (int i = 0; i < s->numRows; i++)
        if (q->row[i].partner > i)
            q->row[i].N = q->row[q->row[i].partner].N = keaMax(q->row[i].N, q->row[q->row[i].partner].N);
    setLoads(s);
}

static void addVelocities(MdtKeaSystem *s, double (*added)[6]) {
    for (int i = 0; i < s->numBodies; i++) {
        double dL[3];
        keaApply(dL, (const double(*)[3])s->work->problem.metric[i].angular, added[i] + 3);
        keaAddScaled(s->work->end[i].velocity, 1, added[i]);
        keaAddScaled(s->work->end[i].angularMomentum, 1, dL);
        for (int k = 0; k < 6; k++)
            s->work->body[i].endVelocity[k] += added[i][k];
    }
}

/* Whether there can be anything to do: midpoint bodies, rebounds, contacts that push out of an overlap. */
static MeBool mayBeNeeded(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        if (s->work->body[i].theta < 1)
            return METRUE;
    for (int i = 0; i < s->numRows; i++)
        if (s->work->problem.row[i].p > 0 && (s->rows[i].bounces || (s->rows[i].contact == i && s->rows[i].target > 0)))
            return METRUE;
    return MEFALSE;
}

/* Rebounds, and joints that are moved, whose velocity is known. */
static MeBool mustBe(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if ((s->work->problem.row[i].p > 0 && s->rows[i].bounces) ||
            (s->rows[i].position && !isOneSided(&s->rows[i]) && s->rows[i].drift != 0))
            return METRUE;
    return MEFALSE;
}

/* The change of velocities that the rows ask for. */
static void solveRows(MdtKeaSystem *s, double start, double (*added)[6]) {
    KeaProblem *q = &s->work->problem;
    memset(added, 0, (size_t)s->numBodies * sizeof *added);
    double residual = start;
    for (int pass = 0; pass < MAX_PASSES && residual > tolerance * start; pass++) {
        kea_problemRenewRadii(q);
        kea_problemSolve(q, METRUE);
        kea_problemCarryOn(q, added);
        residual = q->counts.isLimited ? 0 : kea_problemResidual(q, NULL);
    }
}

static MeBool rebounds(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].bounces && !s->work->problem.row[i].isOff)
            return METRUE;
    return MEFALSE;
}

/* The energy that there can be: what the step started with, and what loads, springs and motors have done in it. */
static double energyAllowed(const MdtKeaSystem *s) {
    double sum = 0;
    for (int b = 0; b < s->numBodies; b++) {
        const MdtKeaBody *body = s->bodies[b];
        const double *u = s->work->body[b].u;
        double dv[3], dL[3];
        keaSubtract(dv, s->work->body[b].freeVelocity, body->velocity);
        keaSubtract(dL, s->work->body[b].freeMomentum, body->angularMomentum);
        sum += 0.5 * (keaDot(body->velocity, body->velocity) / body->invMass +
                      keaDot(body->angularMomentum, s->velocity[b].ang));
        sum += keaDot(dv, u) / body->invMass + keaDot(dL, u + 3);
    }
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact < 0 && !s->rows[i].position)
            sum += s->work->problem.row[i].p * kea_meanRate(s, i);
    return sum;
}

/* Restitution and friction together, or restitution at several points, can ask for energy that is not there (Newton's
 * law has that flaw): then part of the rebound is taken back. */
static void limitEnergy(MdtKeaSystem *s, double start, double allowed) {
    KeaProblem *q = &s->work->problem;
    double c[3] = {-allowed * (1 + 1e-12), 0, 0}, v[6], step[6];
    for (int i = 0; i < s->numRows; i++)
        q->row[i].p = q->row[i].p0 = s->work->wanted[i];
    setProblem(s);
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].bounces && !q->row[i].isOff)
            q->row[i].r -= s->rows[i].rebound;
    solveRows(s, start, s->work->plastic);
    for (int b = 0; b < s->numBodies; b++) {
        for (int k = 0; k < 6; k++) {
            v[k] = s->work->body[b].endVelocity[k] + s->work->plastic[b][k];
            step[k] = s->work->added[b][k] - s->work->plastic[b][k];
        }
        c[0] += kea_energyOf(&q->metric[b], v, v);
        c[1] += 2 * kea_energyOf(&q->metric[b], v, step);
        c[2] += kea_energyOf(&q->metric[b], step, step);
    }
    const double share = kea_largestRoot(c);
    MEASSERT(share >= 0 && share <= 1);
    for (int b = 0; b < s->numBodies; b++)
        for (int k = 0; k < 6; k++)
            s->work->added[b][k] = s->work->plastic[b][k] + share * (s->work->added[b][k] - s->work->plastic[b][k]);
}

static double energyWith(const MdtKeaSystem *s, double (*added)[6]) {
    double sum = 0, v[6];
    for (int b = 0; b < s->numBodies; b++) {
        for (int k = 0; k < 6; k++)
            v[k] = s->work->body[b].endVelocity[k] + added[b][k];
        sum += kea_energyOf(&s->work->problem.metric[b], v, v);
    }
    return sum;
}

static void solveStage(MdtKeaSystem *s, double start, double allowed) {
    for (int i = 0; i < s->numRows; i++)
        s->work->wanted[i] = s->work->problem.row[i].p;
    s->report.stages++;
    solveRows(s, start, s->work->added);
    if (rebounds(s) && energyWith(s, s->work->added) > allowed)
        limitEnergy(s, start, allowed);
    addVelocities(s, s->work->added);
}

static double leftOver(const KeaProblemRow *p) {
    return p->E * p->p - p->r;
}

/* The undamped velocity of the midpoint rule changes its sign at every step; what motion itself leaves does not. */
static MeBool alternates(const MdtKeaSystem *s, double residual) {
    const double noise = 1e-9;
    if (residual < noise * loadSpeed(s))
        return MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        const double now = leftOver(&s->work->problem.row[i]), before = s->rows[i].ripple;
        const MeBool counts = s->rows[i].position && !s->work->problem.row[i].isOff;
        if (counts && now * before < 0 && fabs(now + before) < 0.5 * fabs(now - before) && fabs(now) > 0.1 * residual)
            return METRUE;
    }
    return MEFALSE;
}

static void noteRipples(MdtKeaSystem *s, MeBool isQuieted) {
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].ripple = isQuieted ? 0 : leftOver(&s->work->problem.row[i]);
}

/* Answers that are not the motion: cut short, or a compromise between joints that contradict each other, each of which takes
 * its error away at the cost of the others'. Parts of a step by safe times are watched as well, and so is what took many
 * passes: rows that contradict each other may be found to agree in a motion that has a hundred times the energy. */
static MeBool mustBeSlowed(const MdtKeaSystem *s) {
    enum { MANY_PASSES = 12 }; /* others take 3 to 6 */
    return s->report.capped || s->report.conflicting || s->report.passes > MANY_PASSES ||
           s->work->problem.counts.isLimited || s->parameters.isPart;
}

/* At the end, of the bodies that no row acts on; they keep it. */
static double freeEnergy(const MdtKeaSystem *s) {
    double sum = 0;
    for (int b = 0; b < s->numBodies; b++)
        if (s->work->body[b].isFree)
            sum +=
                kea_energyOf(&s->work->problem.metric[b], s->work->body[b].endVelocity, s->work->body[b].endVelocity);
    return sum;
}

/* The last resort of a step whose motion was not found: at least it is no faster than energy allows. */
static void slowDown(MdtKeaSystem *s, double allowed) {
    memset(s->work->added, 0, (size_t)s->numBodies * sizeof *s->work->added);
    const double energy = energyWith(s, s->work->added);
    if (energy <= allowed)
        return;
    const double kept = freeEnergy(s);
    if (!(energy > kept)) /* nothing but free bodies moves */
        return;
    const double less = sqrt(keaMax(allowed - kept, 0) / (energy - kept)) - 1;
    for (int b = 0; b < s->numBodies; b++)
        for (int k = 0; k < 6; k++)
            s->work->added[b][k] = s->work->body[b].isFree ? 0 : less * s->work->body[b].endVelocity[k];
    MEASSERT(!(energyWith(s, s->work->added) > keaMax(allowed, kept) + 1e-9 * energy));
    addVelocities(s, s->work->added);
}

void kea_velocityStage(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    if (!mayBeNeeded(s) && !mustBeSlowed(s))
        return;
    const MeBool isHit = mustBe(s);
    const double allowed = energyAllowed(s);
    kea_keepRows(s);
    setProblem(s);
    const double start = kea_problemResidual(q, NULL);
    const MeBool isNeeded = (isHit || start > calm * loadSpeed(s) || alternates(s, start)) && kea_problemMaySweep(q);
    noteRipples(s, isNeeded);
    if (isNeeded)
        solveStage(s, start, allowed);
    if (mustBeSlowed(s))
        slowDown(s, allowed);
    kea_recallRows(s);
}
