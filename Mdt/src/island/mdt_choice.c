/* The choice between Kea's solvers for a partition's step: the first row whose condition holds.
 *
 *     condition                                                                   solver   MdtReportWhy
 *     1  the program requests a solver, or an accuracy of 0                       that     Asked
 *     2  the program makes rows, a mimic has a split row, there are more than     exact    Unfit
 *        the cap, or all impacts are elastic, few contacts persist and there
 *        are no joints
 *     3  impacts are not met in time, and no contact is with the world             fast     Flight
 *     4  exact costs no more than fast, or without contacts up to a hundred       exact    Cheap
 *        times as much
 *     5  the world's accounts of exact work pay it                                exact    Afforded
 *     6  otherwise                                                                fast     Dear
 *     7  the exact solver declines the step, as it costs more than expected, or   fast     TakenOver
 *        leaves joints open: for the rest of the step
 *     8  the fast answer is worthless (mdt_lostExcess): the step is solved again  exact    Afforded
 *
 * The cost is predicted from the last steps (MdtIslandRecord). There are two accounts; each step pays into both:
 *
 *     MDT_OPTIONAL   if the exact solver solved the last step, as long as the account lasts
 *     MDT_NEEDED     for partitions whose fast answer missed the accuracy; without contacts, as the fast solver damps
 *                    oscillations; whose bodies bounce, as the fast solver loses successive rebounds; and in their
 *                    first steps, which have no warm start
 *
 * A partition whose last step the fast solver solved to the accuracy stays with it: as the solvers stop bodies at
 * different speeds, each change between them disturbs bodies that come to rest.
 * The accounts pay no step that costs both far more than the fast solver's (mdt_maxOfFast) and more than one step
 * pays in, unless the fast answer is worthless: light bodies under a heavy one that lands would sink for ever. For
 * these partitions the whole account of needed work is kept ready (`reserve`).
 *
 * Shares are assigned before any partition is stepped, in the order of partitions, by multiplications and never by
 * time, so that results do not depend on threads. Unused work is returned. After the fast solver has missed the
 * accuracy, it is tried again after 1, 2, 4 and so on steps; then its answer is accepted only if it meets the
 * accuracy, or if there is no share. Without contacts the exact solver redoes such a step at any cost, as remaining
 * joint errors may drive the joints.
 */
#include "island/mdt_choice_i.h"

/* By account, relative to the work budget (MdtWorldSetWorkBudget): the payment per step, and the largest balance. With
 * the default of 400 millions, of which one takes .3 ms: the optional account pays .3 ms per step; a tower of 100
 * layers of planks has come to rest for 130. For the needed account: a bridge of 30 planks with ten thousand times a
 * plank's weight takes 2 to 15 per step; the first step of that tower 38. All steps after first ones together get
 * mdt_stepShare. */
static const double mdt_payment[MDT_ACCOUNTS] = {1 / 400., 4 / 400.}, mdt_creditLimit[MDT_ACCOUNTS] = {150 / 400., 1};
static const double mdt_stepShare = 30 / 400.;
/* Relative to the work budget: the fast solver's reserve, which the exact solver may not use. */
static const double mdt_fastReserve = 1. / 8;
/* Multiplications: replaces the work budget in worlds without one. */
static const double mdt_unboundedBudget = 400e6;
/* Multiplications of an exact step over the square of the number of bodies, as long as the cost is unknown: the work of
 * factoring space-filling structures, and more than enough for chains of up to 60 bodies. */
static const double mdt_guessedWork = 600;
/* Multiplications of the exact solver, per body, in the time of a fast step with its minimum of passes: until known. */
static const double mdt_guessedFastWork = 1e4;
/* Multiplications of the fast solver, which computes eight at a time, in the time of one of the exact solver. */
static const double mdt_exactTime = 4;
/* Largest cost of an exact step that the accounts pay, relative to a fast step. A bridge of 30 planks that carries ten
 * thousand times its weight costs 8 to 64; wedged contacts cost any number: ten boxes took 300 factorizations without
 * gain. With a limit of 32 a shaken tower of 20 cubes sinks by .4 mm (Mst_Cases_Stacks). */
static const double mdt_maxOfFast = 100;
/* MdtReport.excess above which the fast solver's answer is worthless: bodies lack support. Slabs of 100 kg to 1000 t
 * that land on 16 to 250 cubes leave 2e3 to 1e8, heaps of equal bodies up to 100. */
static const double mdt_lostExcess = 1e3;
/* Decay per step of the predicted exact cost while the exact solver is not used: to one half after 138 steps. */
static const double mdt_forgetting = 0.995;
/* Weight of a step's cost in the predicted one, so that a single expensive step does not end exact steps. */
static const double mdt_newShare = 0.125;
/* Largest number of steps until the fast solver is tried again. */
enum { MDT_WAIT_LIMIT = 64 };

/* ---- the program's request ---- */

static MdtSolver solverOfProgram(MdtWorldID w, MdtBodyID *bodies, int numBodies) {
    const MeProgramCall before = MeProgramEnter("MdtWorldSetSolverCB");
    const MdtSolver solver = w->solverCb(bodies, numBodies, w->solverCbData);
    MeProgramLeave(&before);
    if (mdt_isSolver(solver))
        return solver;
    if (!w->isSolverWarned)
        MeWarning(1, "MdtWorldSetSolverCB: the callback returned %d, which is no solver: MdtSolverAuto is taken",
                  (int)solver);
    w->isSolverWarned = METRUE;
    return MdtSolverAuto;
}

static void readSolversOfProgram(MdtWorldID w) {
    for (int i = 0; w->solverCb && i < w->numPartitions; i++) {
        const int first = w->bodyStart[i], end = w->bodyStart[i + 1];
        const MdtSolver solver = solverOfProgram(w, w->bodyOf + first, end - first);
        for (int k = first; k < end && w->record[i].requested != solver; k++)
            mdt_bodyDisturb(w->bodyOf[k]);
        w->record[i].requested = solver;
    }
}

MdtSolver mdt_choiceRequested(const MdtWorld *w, int partition) {
    MEASSERT(partition >= 0 && partition < w->numPartitions);
    const MdtSolver solver = w->solverCb ? w->record[partition].requested : w->solver;
    return solver == MdtSolverAuto && w->accuracy == 0 ? MdtSolverExact : solver;
}

/* ---- the accounts ---- */

void mdt_recordMerge(MdtIslandRecord *to, const MdtIslandRecord *from) {
    MEASSERT(from->steps >= 0 && from->steps <= 2 && from->stepsUntilRetry >= 0 &&
             from->stepsUntilRetry <= MDT_WAIT_LIMIT);
    to->exactWork = fmaxf(to->exactWork, from->exactWork);
    to->fastWork = fmaxf(to->fastWork, from->fastWork);
    to->excess = fmaxf(to->excess, from->excess);
    to->isUnfit = to->isUnfit || from->isUnfit;
    to->hasNoContacts = to->hasNoContacts && from->hasNoContacts;
    to->wasExact = to->wasExact || from->wasExact;
    to->crushed = fmaxf(to->crushed, from->crushed);
    to->requested = from->requested;
    to->steps = MeMAX(to->steps, from->steps);
    to->stepsUntilRetry = MeMAX(to->stepsUntilRetry, from->stepsUntilRetry);
    to->stepsSinceTry = MeMAX(to->stepsSinceTry, from->stepsSinceTry);
}

static double budgetOf(const MdtWorld *w) {
    return w->workBudget > 0 ? 1e6 * (double)w->workBudget : mdt_unboundedBudget;
}

static int countBodies(const MdtWorld *w, int partition) {
    MEASSERT(w->bodyStart[partition + 1] > w->bodyStart[partition]);
    return w->bodyStart[partition + 1] - w->bodyStart[partition];
}

/* Whether the partition's bodies have certificates of the same step, and may be left unsolved: not if a body without
 * one has come to them. */
static MeBool areCertified(const MdtWorld *w, int partition) {
    for (int i = w->bodyStart[partition]; i < w->bodyStart[partition + 1]; i++)
        if (w->bodyOf[i]->certificate == 0)
            return MEFALSE;
    return METRUE;
}

static MdtShareClass shareClassOf(const MdtWorld *w, int partition) {
    const MdtIslandRecord *r = &w->record[partition];
    if (mdt_choiceRequested(w, partition) != MdtSolverAuto ||
        w->actingStart[partition + 1] == w->actingStart[partition])
        return MDT_NO_NEED;
    if (areCertified(w, partition))
        return MDT_CERTIFIED;
    return r->steps < 2                  ? MDT_FIRST
           : r->excess > mdt_lostExcess  ? MDT_LOST
           : r->excess > 1 || r->isUnfit ? MDT_UNMET
           : r->wasExact                 ? MDT_STAYS_EXACT
                                         : MDT_STAYS_FAST;
}

/* Multiplications: the predicted cost of an exact step. */
static double predictedWork(const MdtWorld *w, int partition) {
    const MdtIslandRecord *r = &w->record[partition];
    const double n = countBodies(w, partition);
    MEASSERT(r->exactWork >= 0);
    return n * (r->exactWork == 0 ? mdt_guessedWork * n : (double)r->exactWork);
}

/* Multiplications of the exact solver in the time of a fast step. */
static double fastStepWork(const MdtWorld *w, int partition) {
    const double fast = (double)w->record[partition].fastWork;
    MEASSERT(fast >= 0);
    return countBodies(w, partition) * (fast > 0 ? fast : mdt_guessedFastWork);
}

/* Multiplications of an exact step that needs no account: as much as a fast step costs; without contacts up to a
 * hundred times as much, since the fast solver damps oscillations. */
static double freeWorkOf(const MdtWorld *w, int partition) {
    const MdtIslandRecord *r = &w->record[partition];
    if (r->hasNoContacts)
        return fmin(mdt_maxOfFast * fastStepWork(w, partition), mdt_stepShare * budgetOf(w));
    return r->fastWork > 0 ? fastStepWork(w, partition) : 0;
}

/* Assigns shares from an account to partitions of a class that have none yet, as far as `funds` last. Returns the
 * remaining funds. */
static double assignShares(MdtWorldID w, MdtShareClass shareClass, MeBool isExactFirst, MdtAccount account,
                           double funds) {
    for (int i = 0; i < w->numPartitions; i++) {
        MdtIslandRecord *r = &w->record[i];
        const double need = predictedWork(w, i);
        const MeBool isOutOfProportion = /* costs far more than a fast step, and more than one step pays in */
            need > mdt_payment[MDT_OPTIONAL] * budgetOf(w) && need > mdt_maxOfFast * fastStepWork(w, i);
        if (r->share > 0 || need > funds || r->shareClass != shareClass)
            continue;
        if (isOutOfProportion && shareClass > MDT_LOST && !r->isUnfit)
            continue;
        r->share = r->drawn = need;
        r->account = account;
        r->isExactFirst =
            isExactFirst || r->isUnfit || (shareClass == MDT_UNMET && r->stepsSinceTry <= r->stepsUntilRetry);
        w->credit[account] -= need;
        funds -= need;
        MEASSERT(funds >= 0 && w->credit[account] >= 0);
    }
    return funds;
}

/* Assigns shares to partitions whose exact step costs no more than the account-free work. */
static void assignFreeShares(MdtWorldID w) {
    for (int i = 0; i < w->numPartitions; i++) {
        MdtIslandRecord *r = &w->record[i];
        const double freeWork = freeWorkOf(w, i);
        r->drawn = r->loan = 0;
        r->shareClass = shareClassOf(w, i);
        r->isExactFirst = r->shareClass >= MDT_LOST && predictedWork(w, i) <= freeWork;
        r->share = r->isExactFirst ? freeWork : 0;
    }
}

/* Lends funds to partitions that have a share, in proportion to their bodies, for steps that cost more than predicted:
 * either to those of class MDT_FIRST, or to all others. */
static void lendFunds(MdtWorldID w, MeBool isFirst, double funds) {
    double bodies = 0;
    for (int i = 0; i < w->numPartitions; i++)
        if (w->record[i].share > 0 && isFirst == (w->record[i].shareClass == MDT_FIRST))
            bodies += countBodies(w, i);
    for (int i = 0; i < w->numPartitions && bodies > 0; i++)
        if (w->record[i].share > 0 && isFirst == (w->record[i].shareClass == MDT_FIRST)) {
            const double loan = funds * countBodies(w, i) / bodies;
            w->record[i].loan = loan;
            w->record[i].share += loan;
            w->credit[MDT_NEEDED] -= loan;
        }
}

/* Lends what is left of the account of needed work, in proportion to bodies, to partitions for which it suffices. */
static void lendReserves(MdtWorldID w) {
    const double funds = w->credit[MDT_NEEDED];
    double bodies = 0;
    for (int i = 0; i < w->numPartitions; i++)
        bodies += w->record[i].shareClass >= MDT_FIRST ? countBodies(w, i) : 0;
    for (int i = 0; i < w->numPartitions; i++) {
        const double reserve = w->record[i].shareClass >= MDT_FIRST ? funds * countBodies(w, i) / bodies : 0;
        w->record[i].reserve = predictedWork(w, i) <= w->record[i].share + reserve ? reserve : 0;
        w->credit[MDT_NEEDED] -= w->record[i].reserve;
    }
}

static void divideAccounts(MdtWorldID w) {
    const double limit = mdt_stepShare * budgetOf(w);
    assignFreeShares(w);
    assignShares(w, MDT_FIRST, METRUE, MDT_NEEDED, w->credit[MDT_NEEDED]);
    assignShares(w, MDT_LOST, METRUE, MDT_NEEDED, w->credit[MDT_NEEDED]);
    assignShares(w, MDT_STAYS_EXACT, METRUE, MDT_OPTIONAL, fmin(limit, w->credit[MDT_OPTIONAL]));
    double left = assignShares(w, MDT_UNMET, MEFALSE, MDT_NEEDED, fmin(limit, w->credit[MDT_NEEDED]));
    left = assignShares(w, MDT_STAYS_EXACT, MEFALSE, MDT_NEEDED, left);
    assignShares(w, MDT_CERTIFIED, METRUE, MDT_OPTIONAL, w->credit[MDT_OPTIONAL]);
    lendFunds(w, MEFALSE, left);
    lendFunds(w, METRUE, w->credit[MDT_NEEDED]);
    lendReserves(w);
}

static void payAccounts(MdtWorldID w) {
    for (int i = 0; i < MDT_ACCOUNTS; i++)
        w->credit[i] = fmin(w->credit[i] + mdt_payment[i] * budgetOf(w), mdt_creditLimit[i] * budgetOf(w));
}

void mdt_choicesReset(MdtWorldID w) {
    for (int i = 0; i < MDT_ACCOUNTS; i++)
        w->credit[i] = DBL_MAX; /* the next payment clamps it to the limit */
}

void mdt_choicesBegin(MdtWorldID w, MeBool isStep) {
    readSolversOfProgram(w);
    if (isStep)
        payAccounts(w);
    divideAccounts(w);
}

void mdt_choicesEnd(MdtWorldID w) {
    for (int i = 0; i < w->numPartitions; i++) {
        MEASSERT(w->record[i].drawn >= 0 && w->record[i].account < MDT_ACCOUNTS);
        w->credit[w->record[i].account] += w->record[i].drawn;
        w->credit[MDT_NEEDED] = fmax(w->credit[MDT_NEEDED] + w->record[i].loan + w->record[i].reserve, 0);
    }
}

/* ---- the choice ---- */

/* True if no contact is with the world: then the partition carries no weight, and forces come from collisions and
 * overlaps only. */
MeBool mdt_choiceIsInFlight(const MdtIsland *p) {
    for (int i = 0; i < p->numActing; i++)
        if (!mdt_sideBody(p->acting[i], 0) || !mdt_sideBody(p->acting[i], 1))
            return MEFALSE;
    return METRUE;
}

/* m/s: closing speed of the two bodies at the contact. */
static double closingSpeedAt(const MdtPoint *point) {
    const MdtBaseConstraint *base = &mdt_manifoldOf(point)->base;
    double normal[3], sum = 0;
    mdt_pointNormal(point, normal);
    for (int k = 0; k < 2; k++) {
        const MdtBody *b = base->side[k].body;
        double arm[3], v[3], w[3], turn[3];
        if (!b)
            continue;
        mdt_fromReal(v, b->velocity.lin);
        mdt_fromReal(w, b->velocity.ang);
        keaSubtract(arm, point->position, b->kea.position);
        keaCross(turn, w, arm);
        sum += (k == 0 ? -1 : 1) * (keaDot(normal, v) + keaDot(normal, turn));
    }
    return sum;
}

/* Number of manifolds with a persistent contact, which constrains its bodies; stops counting at max + 1. */
static int countPersistent(const MdtIsland *p, int max) {
    double g[3];
    int count = 0;
    mdt_fromReal(g, p->world->params.gravity);
    for (int i = 0; i < p->numActing && count <= max; i++) {
        MeBool isPersistent = MEFALSE;
        for (const MdtPoint *at = mdt_pointFirst(mdt_asManifold(p->acting[i])); at && !isPersistent;
             at = mdt_pointAfter(at)) {
            const MdtBaseConstraint *base = &mdt_manifoldOf(at)->base;
            const MdtKeaBody *bodies[2];
            for (int k = 0; k < 2; k++)
                bodies[k] = mdt_sideBody(base, k) ? &base->side[k].body->kea : NULL;
            isPersistent = MdtKeaContactHolds(bodies, -at->depth, -closingSpeedAt(at), mdt_pointParams(at)->restitution,
                                              keaLength(g) * p->h);
        }
        count += isPersistent;
    }
    return count;
}

static MdtReportWhy reasonForExact(const MdtIsland *p) {
    return p->record->share == 0                    ? MdtReportWhyUnfit
           : p->record->drawn + p->record->loan > 0 ? MdtReportWhyAfforded
                                                    : MdtReportWhyCheap;
}

/* Rows 1 to 6 of the table. Unfit: the impacts of elastic bodies, of which only few are constrained, are solved one
 * after the other (mdt_subdivide.c); the fast solver loses successive rebounds. Flight: with the fast solver the centre
 * of mass of a swarm moves as a free body; the exact one uses end velocities where it does not time contacts. Unfit
 * without contacts: errors that the fast solver leaves may drive the joints, so its answer has to meet the accuracy. */
static MdtReportWhy findReason(const MdtIsland *p) {
    const MdtIslandRecord *r = p->record;
    const MeBool isLarge = p->numBodies > p->world->timedBodies && p->numContacts > 0 && !p->bounces;
    const MeBool keepsEnergy = p->bounces && !p->losesEnergy && p->numJoints == 0;
    const MeBool isUnmet = p->numContacts == 0 && r->excess > 1 && r->stepsSinceTry <= r->stepsUntilRetry;
    if (p->solver == MdtSolverExact)
        return MdtReportWhyAsked;
    if (p->solver == MdtSolverAuto && isLarge && p->mayBeFast && mdt_choiceIsInFlight(p))
        return MdtReportWhyFlight;
    if (!p->mayBeFast || (p->numContacts == 0 && p->solver == MdtSolverFast))
        return MdtReportWhyUnfit;
    if (p->solver == MdtSolverFast)
        return MdtReportWhyAsked;
    if (keepsEnergy && countPersistent(p, mdt_maxConstrained(p)) <= mdt_maxConstrained(p))
        return MdtReportWhyUnfit;
    if (r->isExactFirst)
        return reasonForExact(p);
    return isUnmet ? MdtReportWhyUnfit : MdtReportWhyDear;
}

MdtSolver mdt_choiceSolver(MdtIsland *p) {
    p->why = findReason(p);
    const MdtSolver solver = p->why == MdtReportWhyAsked    ? p->solver
                             : p->why >= MdtReportWhyFlight ? MdtSolverFast
                                                            : MdtSolverExact;
    MEASSERT(solver == MdtSolverExact || p->mayBeFast);
    return solver;
}

/* ---- the step ---- */

MeBool mdt_choiceHasShare(const MdtIsland *p) {
    const MeBool isSatisfied = p->record->fastWork > 0 && p->record->excess <= 1;
    return !p->isFast && (p->why == MdtReportWhyCheap || p->why == MdtReportWhyAfforded) &&
           (isSatisfied || p->numContacts > 0);
}

double mdt_choicePayment(const MdtIsland *p) {
    return mdt_payment[MDT_NEEDED] * budgetOf(p->world);
}

/* Further parts of a step that has not been declined may use more than its share. */
double mdt_choiceBudget(const MdtIsland *p) {
    const double all = 1e6 * (double)p->world->workBudget;
    const double max = !p->isFast && p->numContacts > 0 && p->mayBeFast ? (1 - mdt_fastReserve) * all : all;
    if (mdt_choiceHasShare(p) && p->numContacts > 0)
        return fmin(fmax(p->record->share, 2 * mdt_stepShare * budgetOf(p->world)), all > 0 ? max : MDT_NO_BOUND);
    return max;
}

void mdt_choiceSwitchToFast(MdtIsland *p) {
    MEASSERT(!p->isFast && p->mayBeFast);
    p->why = MdtReportWhyTakenOver;
    p->work = p->world->workBudget > 0 ? fmax(budgetOf(p->world) - p->exactWork, mdt_fastReserve * budgetOf(p->world))
                                       : MDT_NO_BOUND;
    mdt_islandSetFast(p, METRUE);
}

/* Whether the fast answer is worthless: but for joints, whose errors are corrected later, and for bodies that movers
 * leave no room. */
static MeBool isLost(const MdtIsland *p) {
    return p->isFast && p->solver == MdtSolverAuto && p->mayBeFast && p->numJoints == 0 && p->record->crushed == 0 &&
           p->kea.report.excess > mdt_lostExcess;
}

MeBool mdt_choiceNeedsExact(const MdtIsland *p) {
    const MeBool mustBeAccurate = p->numContacts == 0; /* without contacts: see findReason */
    const MeBool isAllowed = p->why == MdtReportWhyDear
                                 ? p->record->share > 0 || mustBeAccurate
                                 : p->why == MdtReportWhyTakenOver && mustBeAccurate && p->hasDeclined;
    if (isLost(p))
        return p->record->reserve > 0 && p->numMembers == 0 && p->elapsed == 0;
    return isAllowed && p->numMembers == 0 && p->elapsed == 0 && p->kea.report.excess > 1;
}

void mdt_choiceSwitchToExact(MdtIsland *p) {
    MEASSERT(p->isFast && p->numMembers == 0);
    if (isLost(p)) {
        p->kea.parameters.acceptable = p->kea.report.residual;
        p->record->share += p->record->reserve;
        p->record->loan += p->record->reserve;
        p->record->reserve = 0;
        p->declinedWork = p->exactWork;
        p->hasDeclined = MEFALSE;
    }
    p->why = p->numContacts == 0 ? MdtReportWhyUnfit : reasonForExact(p);
    mdt_islandSetFast(p, MEFALSE);
    const double budget = mdt_choiceBudget(p);
    p->work = budget > 0 ? fmax(budget - p->exactWork, 1) : MDT_NO_BOUND;
}

/* Records a fast step, whose accuracy decides when the fast solver is tried next. */
static void recordFastStep(const MdtIsland *p, MdtIslandRecord *r) {
    MEASSERT(p->numBodies > 0 && !(p->excess < 0));
    r->excess = (float)(p->numJoints > 0 ? fmin(p->excess, mdt_lostExcess) : p->excess);
    r->stepsUntilRetry = r->excess <= 1            ? 0
                         : r->stepsUntilRetry == 0 ? 1
                                                   : MeMIN(2 * r->stepsUntilRetry, MDT_WAIT_LIMIT);
    r->stepsSinceTry = 0;
    r->fastWork = (float)(p->fastWork / p->numBodies / (p->numContacts > 0 ? mdt_exactTime : 1));
}

/* The cost of an exact step for predictions. A declined step would have cost more than it did. A first step without
 * warm start needs more factorizations than those that follow: one of them is counted. */
static double exactWorkOf(const MdtIsland *p, const MdtIslandRecord *r) {
    const double work = p->exactWork - p->declinedWork;
    if (p->hasDeclined)
        return fmax(2 * work, p->minExactWork);
    return r->steps == 0 ? work / MeMAX(1, p->kea.report.factorizations) : work;
}

static void recordExactStep(const MdtIsland *p, MdtIslandRecord *r) {
    const double share = p->hasDeclined || r->steps < 2 ? 1 : mdt_newShare;
    r->exactWork += (float)(share * (exactWorkOf(p, r) / p->numBodies - (double)r->exactWork));
    MEASSERT(r->exactWork >= 0);
}

/* Returns the unused share to the account. Work is charged first to the account's share, then to the loan. */
static void returnUnusedShare(const MdtIsland *p, MdtIslandRecord *r) {
    const double used = r->share > 0 ? fmax(p->exactWork - (r->share - r->drawn - r->loan), 0) : 0;
    r->loan -= fmax(used - r->drawn, 0);
    r->drawn = fmax(r->drawn - used, 0);
    MEASSERT(r->drawn >= 0 && r->drawn <= r->share);
}

void mdt_choiceRecordStep(const MdtIsland *p, MdtIslandRecord *r) {
    r->stepsSinceTry++;
    r->crushed = fmaxf(r->crushed - (float)p->h, 0);
    if (p->fastWork > 0)
        recordFastStep(p, r);
    if (p->exactWork > 0 || p->hasDeclined)
        recordExactStep(p, r);
    else
        r->exactWork *= (float)mdt_forgetting;
    r->steps = p->solver == MdtSolverAuto ? MeMIN(r->steps + 1, 2) : 0; /* a choice of the program restarts the count */
    r->hasNoContacts = p->numContacts == 0;
    r->isUnfit = r->hasNoContacts || p->bounces;
    r->wasExact = p->exactWork > 0 && !p->hasDeclined;
    returnUnusedShare(p, r);
}
