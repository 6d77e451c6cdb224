/* The parts that a partition's step is taken in: sub-steps, up to events, and halves where motion is violent.
 *
 *     whole step -> sub-steps (MdtWorldSetSubSteps) -> up to the next event, where few bodies touch each other
 *                                                   -> halves, where joints turn too violently for the whole of it
 *                                                   -> stages of order 4, each as above (mdt_compose.c)
 *
 * A partition's step has one budget of work (MdtWorldSetWorkBudget) and of iterations (MdtWorldSetMaxLCPIterations).
 * Every solve draws from it: of whole steps, sub-steps, halves, events and impacts, those that are thrown away
 * included. When it is used up, Kea answers by sweeps, and the step is divided no further.
 */
#include "MeAssert.h"
#include "step/mdt_step_i.h"

enum { MAX_HALVINGS = 6 };

/* ---- the budget ---- */

/* A part by safe time gets its share of the budget; the bridge may take 16 of them (mst_continuous.c). */
static void beginBudget(MdtIsland *p) {
    const double budget = mdt_choiceBudget(p) * MeMAX(p->numMembers, 1), min = 1. / 16;
    p->work = budget > 0 ? budget * fmax(p->h / p->whole, min) : MDT_NO_BOUND;
    p->iterations = p->world->maxLcpIterations;
}

/* Reserves all but this share of the work that is left for later parts. Returns the reserve, which the caller adds
 * back. */
static double keepWork(MdtIsland *p, double share) {
    const double kept = p->work < MDT_NO_BOUND ? (1 - share) * p->work : 0;
    p->work -= kept;
    return kept;
}

/* Kea's budgets are at least 1, as 0 means unlimited. What may decline the step is bound by its share. */
void mdt_budgetGrant(MdtIsland *p) {
    const double share = p->kea.parameters.mayDecline ? p->record->share - p->exactWork : MDT_NO_BOUND;
    const double work = fmin(p->work, share);
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
        p->min = cost->least;
    }
    if (p->isFast)
        p->excess = cost->excess;
    if (p->report)
        p->report->work += (MeReal)(1e-6 * cost->work);
}

/* ---- one part ---- */

/* A part of H / n takes the n-th part of a step's relaxation, and a load sags as it would in a whole one:
 *     1 - γ = (1 - γ')^n,   ε' F (H/n)² / γ' = ε F H² / γ.
 * H is the step that the program asked for: a partition that its safe time moves on by less takes that share of an
 * error away, however short it is, at the same speed γ φ / H. */
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
    p->kea.parameters.stepsize = substep;
    p->kea.parameters.elapsed = p->elapsed;
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
    if (p->report)
        mdt_reportImpact(p->report);
    mdt_unpackImpact(p);
    if (MdtKeaFlies(&p->kea))
        return;
    MdtKeaInit(&p->kea, p->scratch);
    mdt_rowsMake(p);
}

/* Joints pass on at once what was given to their bodies as the step begins. */
static void kick(MdtIsland *p) {
    if (p->numJoints == 0 || p->isFast || !MdtKeaIsKicked(&p->kea))
        return;
    mdt_substepMakeRows(p, p->h);
    mdt_budgetGrant(p);
    MdtKeaKick(&p->kea);
    mdt_budgetDraw(p);
    for (int i = 0; i < p->numBodies; i++) {
        MdtKeaBodyGetAngularVelocity(&p->bodies[i]->kea, p->bodies[i]->spin);
        mdt_bodyNoteStart(p->bodies[i]);
    }
}

/* An inexact solve is reported (MdtReport's fallbacks). A warning is given only where the program can do something:
 * take shorter steps, or raise a cap that it has set. */
static void warnOfSolver(const MdtIsland *p) {
    const MeBool isMendable = p->kea.report.violent || p->kea.parameters.maxIterations > 0;
    if (p->kea.report.capped && !p->isDegenerate && isMendable) /* of degenerate joints there was a warning already */
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

/* m/s: what a body gains by falling in the time. */
static double fallIn(const MdtIsland *p, double time) {
    const MeReal *g = p->world->params.gravity;
    return sqrt((double)(g[0] * g[0] + g[1] * g[1] + g[2] * g[2])) * time;
}

/* What is done with the solve of a part. */
typedef enum AfterSolve {
    INTEGRATE,       /* its answer is taken */
    SWITCH_TO_FAST,  /* the fast solver takes the rest of the step */
    SWITCH_TO_EXACT, /* the exact solver takes the part instead of the fast one */
    HALVE,           /* both halves are taken instead */
    SOLVE_REFUSED    /* it was refused, and can not be halved: it is solved as it is */
} AfterSolve;

/* Joints that open would let bodies come apart, and contacts that do not act would let them pass through what they hit:
 * the work of the step has run out before these hold. Dolls that fall opened by 3 mm in a step where a share of exact
 * work was used up; 100 boxes in one place passed through the floor. */
static AfterSolve chooseAfterSolve(const MdtIsland *p, int halvings) {
    const double maxOpening = 1e-3,
                 unsupported = 0.5; /* of a body's size; of what a body gains by falling in the step */
    const MdtKeaReport *r = &p->kea.report;
    const MeBool haveJointsOpened = r->opens || (r->limited && r->opening > maxOpening && mdt_choiceHasShare(p));
    const MeBool isUnsupported = r->limited && p->numJoints == 0 && p->h == p->whole &&
                                 p->world->maxLcpIterations == 0 && r->residual > unsupported * fallIn(p, p->whole);
    const MeBool mayDivide = halvings < MAX_HALVINGS && p->work > 2 * r->least; /* there is work for two solves */
    const MeBool maySwitch = !p->isFast && p->mayBeFast && (p->numContacts > 0 || r->opens);
    if (r->declined)
        return SWITCH_TO_FAST;
    if (mdt_choiceNeedsExact(p))
        return SWITCH_TO_EXACT;
    if (r->violent && mayDivide)
        return HALVE;
    if (r->refused)
        return SOLVE_REFUSED;
    return (haveJointsOpened || isUnsupported) && maySwitch ? SWITCH_TO_FAST : INTEGRATE;
}

static void advanceHalves(MdtIsland *p, double substep, int halvings) {
    if (p->report)
        mdt_reportDivision(p->report);
    const double kept = keepWork(p, 0.5);
    mdt_substepAdvance(p, 0.5 * substep, halvings + 1);
    p->work += kept;
    if (!p->isStopped)
        mdt_substepAdvance(p, 0.5 * substep, halvings + 1);
}

void mdt_substepAdvanceRows(MdtIsland *p, double substep, int halvings) {
    p->kea.parameters.mayRefuse = halvings < MAX_HALVINGS;
    mdt_substepSolveRows(p);
    switch (chooseAfterSolve(p, halvings)) {
    case INTEGRATE:
        mdt_substepIntegrate(p);
        return;
    case HALVE:
        advanceHalves(p, substep, halvings);
        return;
    case SWITCH_TO_FAST:
        mdt_choiceSwitchToFast(p);
        break;
    case SWITCH_TO_EXACT:
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

/* Whether the solve of the part has converged, or its residual moves nothing by more than 1e-7 of the fall in a step, g
 * h²: in very short parts rounding leaves a residual above tolerance. */
static MeBool isFollowed(const MdtIsland *p) {
    const double fall = fallIn(p, p->h) * p->h;
    const double displacement = p->kea.report.residual * p->parameters.stepsize;
    const MeBool isNear =
        !p->kea.report.violent && displacement < 1e-7 * fall; /* violent: positions have not converged */
    return !p->kea.report.capped || (isNear && !p->kea.report.limited);
}

/* Factorizations of a timed part: where it takes more, contacts do not settle, and each further event would cost as
 * much. /2 fails Mst_Cases_Defaults: stacks_stand_by_default in double, x2 Mst_Spikes: a_row_of_dominoes. */
enum { MDT_FOLLOWING = 96 };

/* Takes what flies on, through at most so many impacts, until it is held or the part of `remaining` s ends. */
static void fly(MdtIsland *p, double remaining, double min, int maxImpacts) {
    mdt_budgetGrant(p);
    const double flown = MdtKeaFly(&p->kea, min, maxImpacts);
    mdt_budgetDraw(p);
    setSubstep(p, flown);
    p->hadImpact = p->hadImpact || p->kea.report.impacts > 0;
    mdt_unpackImpact(p);
    mdt_contactsClearForces(p);
    if (p->report)
        mdt_reportFlight(p->report, p->kea.report.impacts, flown < remaining);
}

/* Whether joints or closed contacts hold too many of its bodies for a solve at each event. */
static MeBool hasTooManyConstrained(const MdtIsland *p) {
    return p->numBodies > p->world->timedBodies && MdtKeaHeldBodies(&p->kea) > mdt_maxConstrained(p);
}

typedef enum Following {
    FOLLOWED,   /* solved up to the next event, or through at most so many impacts */
    UNFOLLOWED, /* not solved accurately, or too expensive to follow, or impacts chatter */
    VIOLENT     /* the same, since the motion is too violent for a part of this length */
} Following;

/* Solves a timed part up to the next event, at most `remaining` s. */
static Following solveToEvent(MdtIsland *p, double remaining, double min, int maxImpacts) {
    const MdtKeaReport *r = &p->kea.report;
    p->kea.parameters.timed = METRUE;
    mdt_substepMakeRows(p, remaining);
    if (hasTooManyConstrained(p) || (!p->kea.parameters.holdsSlow && MdtKeaTrembles(&p->kea)))
        return UNFOLLOWED;
    mdt_substepSolveRows(p);
    const MeBool hasEvent = r->event < remaining - min;
    const MeBool chatters = hasEvent && r->trembles; /* slow impacts would follow each other without end */
    if (!isFollowed(p) || r->factorizations > MDT_FOLLOWING || chatters)
        return r->violent ? VIOLENT : UNFOLLOWED;
    if (!hasEvent)
        return FOLLOWED;
    if (r->ballistic) {
        fly(p, remaining, min, maxImpacts);
    } else {
        if (p->report)
            mdt_reportEvent(p->report);
        mdt_substepSolve(p, fmax(r->event, min));
    }
    return isFollowed(p) ? FOLLOWED : r->violent ? VIOLENT : UNFOLLOWED;
}

/* The same, with the part halved while the motion is violent. */
static Following solveToEventOrHalf(MdtIsland *p, double remaining, double min, int maxImpacts) {
    Following following = solveToEvent(p, remaining, min, maxImpacts);
    for (double ahead = remaining; following == VIOLENT && ahead >= 0.2 * remaining;) {
        ahead *= 0.5;
        following = solveToEvent(p, ahead, min, maxImpacts);
    }
    return following;
}

/* The most events at which a part is divided. A column of n balls that lands has n (n + 1)/2 impacts, as the lowest one
 * hits the ground once for each of them; so has each column of a heap that is as high as it is wide, (n + 1)/2 for
 * each ball. Where nothing rebounds, one event, and another that follows from it, as where a box comes down on one edge
 * and then on the other: what meets after that is held at the end of the step, no more than a step too late. */
static int maxEvents(const MdtIsland *p) {
    enum { EVENTS = 8, PLASTIC_EVENTS = 2 };
    int high = 1;
    if (!p->bounces)
        return PLASTIC_EVENTS;
    while (high * high * high < p->numBodies)
        high++;
    return EVENTS + p->numBodies * (high + 1) / 2;
}

/* A part of the step with timed contacts: divided at each event. After too many events, or where a solve is not
 * accurate, the rest is one part that is not timed. What rolls on a surface of triangles meets some of them slowly in
 * nearly every step: these do not divide it. */
static void advanceTimed(MdtIsland *p, double substep) {
    const double min = 1e-9 * substep;
    const int max = maxEvents(p);
    const double kept = 0.5 * p->work; /* for what is left after the events */
    double remaining = substep;
    p->kea.parameters.holdsSlow = p->numJoints > 0 && !p->bounces;
    for (int events = 0; remaining > min && !p->isStopped; events += MeMAX(p->kea.report.impacts, 1)) {
        if (events >= max || p->work < kept || solveToEventOrHalf(p, remaining, min, max - events) != FOLLOWED) {
            p->kea.parameters.timed = MEFALSE;
            mdt_substepAdvance(p, remaining, 0);
            return;
        }
        remaining -= p->parameters.stepsize;
        mdt_substepIntegrate(p);
    }
}

/* Whether contacts are timed: in partitions of few bodies without joints, or of which all rolls that touches; with
 * restitution also in those in which only few bodies are held by joints or closed contacts, such as a swarm of flying
 * balls. With joints and restitution only if an impact is predicted; with joints not in a step by safe time, which ends
 * at impacts anyway. */
static MeBool isTimed(MdtIsland *p, double substep) {
    const int max = p->world->timedBodies;
    if (max == 0 || p->numActing == 0 || p->isFast)
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

/* ---- sub-steps ---- */

void mdt_islandSubdivide(MdtIsland *p) {
    const int n = p->world->subSteps;
    const double substep = p->h / n;
    beginBudget(p);
    p->parameters.hasContacts = p->numContacts > 0;
    kick(p);
    for (int i = 0; i < n && !p->isStopped; i++) {
        const double kept = keepWork(p, 1. / (n - i));
        p->kea.parameters.timed = MEFALSE; /* as the sub-step before this one may have been */
        if (isTimed(p, substep))
            advanceTimed(p, substep);
        else if (mdt_mayCompose(p))
            mdt_substepCompose(p, substep);
        else
            mdt_substepAdvance(p, substep, 0);
        p->work += kept;
    }
}
