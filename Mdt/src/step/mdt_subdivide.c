/* The parts of a partition's step: sub-steps, division at events, and halves where motion is violent.
 *
 *     whole step -> sub-steps (MdtWorldSetSubSteps) -> up to the next event, in partitions of few bodies in contact
 *                                                   -> halves, if joints turn too violently for the whole sub-step
 *                                                   -> stages of order 4, each as above (mdt_compose.c)
 *
 * A partition's step has one budget of work (MdtWorldSetWorkBudget) and of iterations (MdtWorldSetMaxLCPIterations).
 * Every solve draws from it: of whole steps, sub-steps, halves, events and impacts, also if the solve is discarded.
 * When it is used up, Kea's answers come from sweeps, and the step is not divided further.
 */
#include "MeAssert.h"
#include "step/mdt_step_i.h"

enum { MAX_HALVINGS = 6 };

/* ---- the budget ---- */

/* A step by safe time gets its share of the budget, at least a sixteenth: the bridge makes at most 16 parts
 * (mst_continuous.c). */
static void beginBudget(MdtIsland *p) {
    const double budget = mdt_choiceBudget(p) * MeMAX(p->numMembers, 1), min = 1. / 16;
    p->work = budget > 0 ? budget * fmax(p->h / p->whole, min) : MDT_NO_BOUND;
    p->iterations = p->world->maxLcpIterations;
}

/* Reserves all but `share` of the remaining work for later parts. Returns the reserve, which the caller adds back. */
static double reserveWork(MdtIsland *p, double share) {
    MEASSERT(share > 0 && share <= 1);
    const double reserve = p->work < MDT_NO_BOUND ? (1 - share) * p->work : 0;
    p->work -= reserve;
    return reserve;
}

/* Kea's budgets are at least 1, since 0 means unlimited. A solve that may decline the step is also limited to what is
 * left of the partition's share of exact work. */
void mdt_budgetGrant(MdtIsland *p) {
    const double share = p->kea.parameters.mayDecline ? p->record->share - p->exactWork : MDT_NO_BOUND;
    const double work = fmin(p->work, share);
    p->kea.parameters.ordinaryWork = mdt_choicePayment(p);
    p->kea.parameters.maxWork = work < MDT_NO_BOUND ? fmax(work, 1) : 0;
    p->kea.parameters.maxIterations = p->world->maxLcpIterations == 0 ? 0 : p->iterations > 1 ? p->iterations : 1;
}

void mdt_budgetDraw(MdtIsland *p) {
    const MdtKeaReport *cost = &p->kea.report;
    MEASSERT(cost->work >= 0 && cost->iterations >= 0);
    p->work = p->work < MDT_NO_BOUND ? fmax(p->work - cost->work, 0) : MDT_NO_BOUND;
    MEASSERT(p->work >= 0 && p->work <= MDT_NO_BOUND);
    p->iterations -= p->iterations < cost->iterations ? p->iterations : cost->iterations;
    *(p->isFast ? &p->fastWork : &p->exactWork) += cost->work;
    if (cost->declined) {
        p->hasDeclined = METRUE;
        p->minExactWork = cost->least;
    }
    if (p->isFast)
        p->excess = cost->excess;
    if (p->report)
        p->report->work += (MeReal)(1e-6 * cost->work);
}

/* ---- one part ---- */

/* Sets γ' and ε' of a part of length H/n so that n parts reduce errors as a whole step of length H does, and contacts
 * give way under a load F as in a whole step: 1 - γ = (1 - γ')^n, ε' F (H/n)² / γ' = ε F H² / γ. H is the step that the
 * program requested: if safe times let a partition advance by less, it removes a smaller fraction of its errors, at the
 * same speed γ φ / H. */
static void setSubstep(MdtIsland *p, double substep) {
    MEASSERT(substep > 0 && substep <= p->h * (1 + 1e-9) && p->h <= p->whole * (1 + 1e-9));
    const double n = p->whole / substep * (p->stage == MDT_STAGE_NONE ? 1 : p->forward), gamma = p->world->gamma;
    p->parameters.stepsize = substep;
    p->parameters.gamma = n > 1 ? 1 - pow(1 - gamma, 1 / n) : gamma;
    p->parameters.softening = gamma > 0 ? n * n * p->parameters.gamma / gamma : n;
    if (p->stage != MDT_STAGE_NONE) {
        p->parameters.gamma = p->stage == MDT_STAGE_BACK ? 0 : p->parameters.gamma;
        p->parameters.softening = 0;
    }
    p->parameters.epsilon = p->parameters.softening * (double)p->world->epsilon;
    MEASSERT(p->parameters.softening >= 0 && p->parameters.gamma >= 0 && p->parameters.gamma <= 1);
    p->kea.parameters.stepsize = substep;
    p->kea.parameters.elapsed = p->elapsed;
    p->kea.parameters.late = p->late;
    p->kea.parameters.isBack = p->stage == MDT_STAGE_BACK;
    p->kea.parameters.epsilon = p->parameters.epsilon;
    p->kea.parameters.softening = p->parameters.softening;
    p->kea.parameters.gamma = p->parameters.gamma;
    p->kea.parameters.isPart = p->h < p->whole;
    p->kea.parameters.mayDecline = substep * p->world->subSteps >= p->whole * (1 - 1e-9) && mdt_choiceHasShare(p);
}

void mdt_substepBegin(MdtIsland *p, double substep) {
    if (p->report && p->elapsed > 0)
        mdt_reportLap(p, MdtReportStageIntegrate);
    setSubstep(p, substep);
    MdtKeaInit(&p->kea, p->scratch);
    if (p->isFast && p->elapsed > 0)
        mdt_contactsCarry(p);
}

void mdt_substepImpact(MdtIsland *p) {
    p->hadImpact = METRUE;
    mdt_budgetGrant(p);
    MdtKeaImpact(&p->kea);
    mdt_budgetDraw(p);
    mdt_crushUndoImpact(p);
    mdt_reportPath(p->report, MdtReportWayTimed);
    mdt_unpackImpact(p);
    if (MdtKeaFlies(&p->kea))
        return;
    MdtKeaInit(&p->kea, p->scratch);
    mdt_rowsMake(p);
}

/* After reflections: makes the rows again. */
void mdt_substepReflected(MdtIsland *p) {
    p->hadImpact = METRUE;
    mdt_budgetDraw(p);
    mdt_unpackImpact(p);
    mdt_contactsClearForces(p);
    MdtKeaInit(&p->kea, p->scratch);
    mdt_rowsMake(p);
}

/* Applies the impulses that bodies got before the step; joints transmit them immediately. */
static void applyKick(MdtIsland *p) {
    if (p->numJoints == 0 || p->isFast || !MdtKeaIsKicked(&p->kea))
        return;
    mdt_substepMakeRows(p, p->h);
    mdt_budgetGrant(p);
    MdtKeaKick(&p->kea);
    mdt_budgetDraw(p);
    for (int i = 0; i < p->numBodies; i++) {
        MdtKeaBodyGetAngularVelocity(&p->bodies[i]->kea, p->bodies[i]->spin);
        mdt_bodySaveStart(p->bodies[i]);
    }
}

/* Warns of an inexact solve only if the program can do something about it: take shorter steps, or raise a cap that it
 * has set. All inexact solves are in the report (fallbacks). */
static void warnOfSolver(const MdtIsland *p) {
    const MeBool isMendable = p->kea.report.violent || p->kea.parameters.maxIterations > 0;
    if (p->kea.report.capped && !p->isDegenerate && isMendable) /* degenerate joints have their own warning */
        MeWarning(2,
                  "%s: partition %d (%d rows) could not be solved in the iterations that it has, the forces are "
                  "inexact; raise MdtWorldSetMaxLCPIterations or epsilon, or take shorter steps",
                  MeCallerName("MdtWorldStep"), p->number, p->numRows);
    else if (p->kea.report.limited)
        MeDebug(2, "MdtWorldStep: partition %d (%d rows) has used up its work (MdtWorldSetWorkBudget)", p->number,
                p->numRows);
    else if (p->kea.report.capped)
        MeDebug(2, "MdtWorldStep: partition %d (%d rows): the friction of redundant contacts did not settle", p->number,
                p->numRows);
    if (p->kea.report.conflicting)
        MeDebug(2, "MdtWorldStep: partition %d (%d rows) has contradictory constraints, a compromise was taken",
                p->number, p->numRows);
}

void mdt_substepEnd(MdtIsland *p) {
    warnOfSolver(p);
    p->elapsed += mdt_substepTime(p);
    if (p->stage != MDT_STAGE_NONE)
        p->kea.parameters.pair = p->kea.parameters.pair == MdtKeaPairFirst ? MdtKeaPairSecond : MdtKeaPairFirst;
    MEASSERT(p->elapsed <= p->h * (1 + 1e-6));
}

/* ---- halves ---- */

/* m/s: the velocity that gravity gives a body in the time. */
static double fallSpeed(const MdtIsland *p, double time) {
    const MeReal *g = p->world->params.gravity;
    return sqrt((double)(g[0] * g[0] + g[1] * g[1] + g[2] * g[2])) * time;
}

/* What to do after the solve of a part. */
typedef enum AfterSolve {
    INTEGRATE,       /* accept the answer */
    SWITCH_TO_FAST,  /* let the fast solver solve the rest of the step */
    SWITCH_TO_EXACT, /* let the exact solver redo the part */
    HALVE,           /* advance by two halves instead */
    SOLVE_REFUSED    /* Kea refused to solve it, and it cannot be halved: solve it as it is */
} AfterSolve;

/* When the work of the step has run out, joints may be open, so that bodies come apart, and contacts may lack support,
 * so that bodies pass through obstacles: then the fast solver takes over. Falling dolls opened by 3 mm in a step that
 * used up its share of exact work; 100 boxes in one place passed through the floor. */
static AfterSolve chooseAfterSolve(const MdtIsland *p, int halvings) {
    const double maxOpening = 1e-3,
                 unsupported = 0.5; /* of a body's size; of the velocity that gravity gives in the step */
    const MdtKeaReport *r = &p->kea.report;
    const MeBool haveJointsOpened = r->opens || (r->limited && r->opening > maxOpening && mdt_choiceHasShare(p));
    const MeBool isUnsupported = r->limited && p->numJoints == 0 && p->h == p->whole &&
                                 p->world->maxLcpIterations == 0 && r->residual > unsupported * fallSpeed(p, p->whole);
    const MeBool mayDivide = halvings < MAX_HALVINGS && p->work > 2 * r->least; /* with work for two solves */
    const MeBool maySwitch = !p->isFast && p->mayBeFast && (p->numContacts > 0 || r->opens);
    if (r->declined)
        return SWITCH_TO_FAST;
    if (mdt_choiceNeedsExact(p))
        return SWITCH_TO_EXACT;
    if (r->violent && mayDivide)
        return HALVE;
    if (r->refused)
        return SOLVE_REFUSED;
    return maySwitch && (haveJointsOpened || isUnsupported || mdt_isCrushed(p)) ? SWITCH_TO_FAST : INTEGRATE;
}

/* What only turns too far is no warm start (isHalved): each part is to be solved to its own tolerance. */
static void advanceHalves(MdtIsland *p, double substep, int halvings) {
    mdt_reportPath(p->report, MdtReportWayDivided);
    const double reserve = reserveWork(p, 0.5);
    const MeBool wasHalved = p->isHalved;
    p->isHalved = wasHalved || !p->kea.report.refused;
    mdt_substepAdvance(p, 0.5 * substep, halvings + 1);
    p->work += reserve;
    if (!p->isStopped)
        mdt_substepAdvance(p, 0.5 * substep, halvings + 1);
    p->isHalved = wasHalved;
}

/* Solves the rows, and again with those of stops that the answer passes. */
static void solveWithStops(MdtIsland *p, double substep) {
    enum { MAX_SOLVES = 4 };
    const MdtKeaReport *r = &p->kea.report;
    mdt_substepSolveRows(p);
    for (int i = 1; i < MAX_SOLVES && p->numJoints > 0 && !p->isFast; i++) {
        if (r->violent || r->limited || r->declined || mdt_rowsPassed(p) == 0)
            return;
        mdt_substepSolve(p, substep);
    }
}

void mdt_substepAdvanceRows(MdtIsland *p, double substep, int halvings) {
    MEASSERT(halvings >= 0 && halvings <= MAX_HALVINGS);
    p->kea.parameters.mayRefuse = halvings < MAX_HALVINGS;
    solveWithStops(p, substep);
    switch (chooseAfterSolve(p, halvings)) {
    case INTEGRATE:
        mdt_substepIntegrate(p);
        return;
    case HALVE:
        advanceHalves(p, substep, halvings);
        return;
    case SWITCH_TO_FAST:
        mdt_contactsKeepDeclined(p);
        mdt_choiceSwitchToFast(p);
        break;
    case SWITCH_TO_EXACT:
        if (p->hasDeclined && p->numJoints == 0)
            mdt_contactsGuessDeclined(p);
        mdt_choiceSwitchToExact(p);
        break;
    case SOLVE_REFUSED:
        halvings = MAX_HALVINGS;
        break;
    }
    mdt_substepAdvance(p, substep, halvings);
}

void mdt_substepAdvance(MdtIsland *p, double substep, int halvings) {
    mdt_substepMakeRows(p, substep);
    mdt_substepAdvanceRows(p, substep, halvings);
}

/* ---- events ---- */

/* True if the solve of the part has converged, or its residual displaces bodies by less than 1e-7 of g h², their fall
 * in a step: in very short parts rounding leaves a residual above the tolerance. */
static MeBool isAccurate(const MdtIsland *p) {
    const double fall = fallSpeed(p, p->h) * p->h;
    const double displacement = p->kea.report.residual * p->parameters.stepsize;
    const MeBool isNear =
        !p->kea.report.violent && displacement < 1e-7 * fall; /* violent means that positions have not converged */
    return !p->kea.report.capped || (isNear && !p->kea.report.limited);
}

/* Largest number of factorizations of a timed part: if it takes more, contacts do not settle, and each further event
 * would cost as much. /2 fails Mst_Cases_Defaults: stacks_stand_by_default in double, x2 Mst_Spikes:
 * a_row_of_dominoes. */
enum { MDT_MAX_FACTORIZATIONS = 96 };

static void reportEvents(MdtIsland *p, int count) {
    mdt_reportPath(p->report, MdtReportWayTimed);
    if (p->report)
        p->report->events += count;
}

/* Advances bodies in flight through at most maxImpacts impacts, until one is constrained or the part, of `remaining` s,
 * ends. */
static void followFlight(MdtIsland *p, double remaining, double min, int maxImpacts) {
    mdt_budgetGrant(p);
    const double flown = MdtKeaFly(&p->kea, min, maxImpacts);
    MEASSERT(flown > 0 && flown <= remaining * (1 + 1e-9));
    mdt_budgetDraw(p);
    setSubstep(p, flown);
    p->hadImpact = p->hadImpact || p->kea.report.impacts > 0;
    mdt_unpackImpact(p);
    mdt_contactsClearForces(p);
    reportEvents(p, p->kea.report.impacts);
    if (p->report) /* each impact begins a part; that of the impact that ends the flight is counted later */
        p->report->parts += p->kea.report.impacts - (p->kea.report.impacts > 0 && flown < remaining);
}

/* True if joints or closed contacts constrain too many of the bodies for a solve at each event. */
static MeBool hasTooManyConstrained(const MdtIsland *p) {
    return p->numBodies > p->world->timedBodies && MdtKeaHeldBodies(&p->kea) > mdt_maxConstrained(p);
}

typedef enum TimedResult {
    TIMED,     /* solved up to the next event, or through a flight's impacts */
    NOT_TIMED, /* not to be timed: inexact, too expensive, or impacts chatter */
    VIOLENT    /* not solved: the motion is too violent for a part of this length */
} TimedResult;

/* Solves a timed part up to the next event, at most for `remaining` s. */
static TimedResult solveToEvent(MdtIsland *p, double remaining, double min, int maxImpacts) {
    const MdtKeaReport *r = &p->kea.report;
    p->kea.parameters.timed = METRUE;
    mdt_substepMakeRows(p, remaining);
    if (hasTooManyConstrained(p) || (!p->kea.parameters.holdsSlow && MdtKeaTrembles(&p->kea)))
        return NOT_TIMED;
    mdt_substepSolveRows(p);
    const MeBool hasEvent = r->event < remaining - min;
    const MeBool chatters = hasEvent && r->trembles; /* slow impacts would follow each other endlessly */
    if (!isAccurate(p) || r->factorizations > MDT_MAX_FACTORIZATIONS || chatters || r->twisted || mdt_isCrushed(p) ||
        p->record->crushed > 0)
        return r->violent ? VIOLENT : NOT_TIMED;
    if (!hasEvent)
        return TIMED;
    if (r->ballistic) {
        followFlight(p, remaining, min, maxImpacts);
    } else {
        reportEvents(p, 1);
        mdt_substepSolve(p, fmax(r->event, min));
    }
    return isAccurate(p) ? TIMED : r->violent ? VIOLENT : NOT_TIMED;
}

/* Calls solveToEvent, and halves the part as long as the motion is violent. */
static TimedResult solveToEventOrHalf(MdtIsland *p, double remaining, double min, int maxImpacts) {
    TimedResult result = solveToEvent(p, remaining, min, maxImpacts);
    for (double ahead = remaining; result == VIOLENT && ahead >= 0.2 * remaining;) {
        ahead *= 0.5;
        result = solveToEvent(p, ahead, min, maxImpacts);
    }
    return result;
}

static MeBool isStill(const MdtKeaManifold *m, int side) {
    return m->body[side] < 0 && !m->worldVelocity;
}

/* The number of contacts of round surfaces with surroundings that stay: a ball meets each at most once in a part. */
static int countRound(const MdtIsland *p) {
    int count = 0;
    for (int i = 0; i < p->kea.numManifolds && !p->kea.parameters.holdsSlow; i++) {
        const MdtKeaManifold *m = &p->kea.manifolds[i];
        count += (m->radius[0] > 0 && isStill(m, 1)) || (m->radius[1] > 0 && isStill(m, 0)) ? m->numPoints : 0;
    }
    return count;
}

/* Largest number of events that divide a part. A landing column of n balls has n (n + 1)/2 impacts, as the lowest ball
 * hits the ground once for each of them; so has each column of a heap as high as it is wide, (n + 1)/2 per ball.
 * Without rebounds: one event, and another that follows from it, as when a box lands on one edge and then on the
 * other; later contacts are solved at the end of the step, at most one step late. */
static int maxEvents(const MdtIsland *p) {
    enum { EVENTS = 8, PLASTIC_EVENTS = 2, MAX_ROUND = 16 };
    int high = 1;
    if (!p->bounces)
        return PLASTIC_EVENTS + MeMIN(countRound(p), MAX_ROUND);
    while (high * high * high < p->numBodies)
        high++;
    return EVENTS + p->numBodies * (high + 1) / 2;
}

/* Advances by a part with timed contacts, divided at each event. After too many events, or an inexact solve, the rest
 * is one part without timing. A body that rolls on a surface of triangles meets some of them slowly in nearly every
 * step: with holdsSlow such contacts do not divide the part. */
static void advanceTimed(MdtIsland *p, double substep) {
    const double min = 1e-9 * substep;
    p->kea.parameters.holdsSlow = p->numJoints > 0 && !p->bounces;
    const int max = maxEvents(p);
    const double reserve = 0.5 * p->work; /* reserve for the rest after the events */
    double remaining = substep;
    for (int events = 0; remaining > min && !p->isStopped; events += MeMAX(p->kea.report.impacts, 1)) {
        if (events >= max || p->work < reserve || solveToEventOrHalf(p, remaining, min, max - events) != TIMED) {
            p->kea.parameters.timed = MEFALSE;
            mdt_substepAdvance(p, remaining, 0);
            return;
        }
        MEASSERT(p->parameters.stepsize > 0 && p->parameters.stepsize <= remaining * (1 + 1e-9));
        remaining -= p->parameters.stepsize;
        mdt_substepIntegrate(p);
    }
}

/* True if contacts are timed: in partitions of few bodies without joints, or whose contacts all roll. With restitution
 * also in larger ones with few bodies constrained by joints or closed contacts, such as a swarm of flying balls. With
 * joints and restitution only if an impact is predicted, and not in a step by safe time, which ends at impacts anyway.
 * */
static MeBool isTimed(MdtIsland *p, double substep) {
    const int max = p->world->timedBodies;
    if (max == 0 || p->numActing == 0 || p->isFast || p->record->crushed > 0)
        return MEFALSE;
    if (p->numJoints == 0 && p->numBodies <= max)
        return METRUE;
    const MeBool mayRoll = !p->bounces && p->numContacts > 0 && p->numBodies <= max;
    if (!(p->bounces || mayRoll) || (p->numJoints > 0 && p->h < p->whole))
        return MEFALSE;
    mdt_substepBegin(p, substep);
    mdt_rowsMake(p);
    if (mayRoll)
        return MdtKeaRolls(&p->kea);
    return !hasTooManyConstrained(p) && (p->numJoints == 0 || MdtKeaBounces(&p->kea));
}

/* Advances by a part of the fast solver, divided where bodies meet: a contact that closes within a part would act from
 * its start. */
static void advanceToImpacts(MdtIsland *p, double substep) {
    const double min = 1e-2 * substep, end = p->elapsed + substep;
    const int max = maxEvents(p);
    for (int events = 0; events < max && !p->isStopped; events++) {
        const double remaining = end - p->elapsed;
        if (remaining < 2 * min)
            break;
        mdt_substepMakeRows(p, remaining);
        const double time = MdtKeaTimeOfImpact(&p->kea);
        if (time < min || time > remaining - min)
            break;
        reportEvents(p, 1);
        p->kea.parameters.collidesAtEnd = METRUE;
        mdt_substepAdvance(p, time, 0);
        p->kea.parameters.collidesAtEnd = MEFALSE;
        p->kea.parameters.collidesAtStart = METRUE;
    }
    if (!p->isStopped)
        mdt_substepAdvance(p, end - p->elapsed, 0);
    p->kea.parameters.collidesAtStart = MEFALSE;
}

/* ---- sub-steps ---- */

void mdt_islandSubdivide(MdtIsland *p) {
    const int n = p->world->subSteps;
    MEASSERT(p->elapsed == 0 && !p->isStopped);
    const double substep = p->h / n;
    beginBudget(p);
    p->parameters.hasContacts = p->numContacts > 0;
    applyKick(p);
    for (int i = 0; i < n && !p->isStopped; i++) {
        const double reserve = reserveWork(p, 1. / (n - i));
        p->kea.parameters.timed = MEFALSE; /* the last sub-step may have set it */
        if (isTimed(p, substep))
            advanceTimed(p, substep);
        else if (p->kea.parameters.followsContacts && p->isFast)
            advanceToImpacts(p, substep);
        else if (mdt_mayCompose(p))
            mdt_substepCompose(p, substep);
        else
            mdt_substepAdvance(p, substep, 0);
        p->work += reserve;
    }
}
