/* The choice between Kea's solvers for a partition's step. The first row that holds:
 *
 *     condition                                                                   solver   MdtReportWhy
 *     1  the program asks for a solver, or for an accuracy of 0                   that     Asked
 *     2  the program makes rows, there are more than the cap, or all impacts      exact    Unfit
 *        are elastic, few contacts persist and there are no joints
 *     3  impacts are not met in time, and no contact is with the world             fast     Flight
 *     4  exact costs no more than fast; a hundred times as much if nothing        exact    Cheap
 *        touches
 *     5  the world's accounts of exact work pay it                                exact    Afforded
 *     6  else                                                                     fast     Dear
 *     7  the exact solver declines the step, which is dearer than was likely,     fast     TakenOver
 *        or leaves joints open: the rest of it
 *
 * What a step costs is known from the last one (MdtIslandRecord). There are two accounts, into which each step pays:
 *
 *     MDT_OPTIONAL   for any partition of which the exact solver has taken the last step, as long as it lasts
 *     MDT_NEEDED   where the fast answer does not meet the accuracy; where nothing touches, as the fast solver damps
 *                  what swings; where bodies bounce, as it loses rebounds that follow each other; and for first steps,
 *                  which have no forces to begin with
 *
 * Where the fast solver has taken the last step and met the accuracy, it goes on: what comes to rest is disturbed by
 * each change between them, as they stop it at different speeds.
 * They pay no step that is far dearer than the fast solver's (mdt_maxOfFast) and than what a step pays.
 *
 * Shares are given out before any partition is stepped, in their order, by multiplications and never by time, so that
 * threads change nothing; what is not used goes back. Where the fast solver has not met the accuracy, it is tried again
 * after 1, 2, 4 and so on steps; its answer is taken only if it is within it then, or if there is no share. Where
 * nothing touches, the exact solver takes the step then, whatever it costs: what is left of joints may drive them.
 */
#include "island/mdt_choice_i.h"

/* Of the work budget (MdtWorldSetWorkBudget), by account: what a step pays, and what it holds. Of the default of 400
 * millions, of which one takes .3 ms: optional steps, .3 ms a step; a tower of 100 layers of planks has come to rest
 * for 130. Needed ones: a bridge of 30 planks with ten thousand times a plank's weight takes 2 to 15 a step; the first
 * step of that tower 38. All steps after their first together take mdt_stepShare. */
static const double mdt_payment[MDT_ACCOUNTS] = {1 / 400., 4 / 400.}, mdt_creditLimit[MDT_ACCOUNTS] = {150 / 400., 1};
static const double mdt_stepShare = 30 / 400.;
/* The same, that the fast solver has at least where the exact one has used up what it may. */
static const double mdt_fastReserve = 1. / 8;
/* Multiplications, the budget of worlds without bound. */
static const double mdt_unboundedBudget = 400e6;
/* Multiplications of an exact step as long as none is known, over the square of the number of bodies: the work of
 * factors of what fills space, and of chains of up to 60 bodies more than enough. */
static const double mdt_guessedWork = 600;
/* The same in the time of the fast solver, a body, with the least passes. */
static const double mdt_guessedFastWork = 1e4;
/* Multiplications of the fast solver, which does eight at a time, in the time of one of the exact one. */
static const double mdt_exactTime = 4;
/* Of the time of the fast solver: what the accounts pay, at most. A bridge of 30 planks that carries ten thousand times
 * its weight takes 8 to 64; contacts that are wedged any number: ten boxes took 300 factorizations, and gained nothing.
 * With 32 a tower of 20 cubes that is shaken sinks by .4 mm (Mst_Cases_Stacks). */
static const double mdt_maxOfFast = 100;
/* What is left of a cost that was too much after a step without trying: half of it after 138. */
static const double mdt_forgetting = 0.995;
/* Of the cost that is expected: what a step's has in it, so that one that costs more does not end exact steps. */
static const double mdt_newShare = 0.125;
/* Steps after which the fast solver is tried again, at most. */
enum { MDT_WAIT_LIMIT = 64 };

/* ---- what the program wants ---- */

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
        for (int k = first; k < end; k++) {
            MdtBodyID b = w->bodyOf[k];
            if (b->solver != solver)
                mdt_bodyDisturb(b);
            b->solver = solver;
        }
    }
}

MdtSolver mdt_choiceRequested(const MdtWorld *w, int partition) {
    const MdtSolver solver = w->solverCb ? w->bodyOf[w->bodyStart[partition]]->solver : w->solver;
    return solver == MdtSolverAuto && w->accuracy == 0 ? MdtSolverExact : solver;
}

/* ---- the account ---- */

void mdt_recordJoin(MdtIslandRecord *to, const MdtIslandRecord *from) {
    to->exactWork = fmaxf(to->exactWork, from->exactWork);
    to->fastWork = fmaxf(to->fastWork, from->fastWork);
    to->isUnmet = to->isUnmet || from->isUnmet;
    to->isUnfit = to->isUnfit || from->isUnfit;
    to->hasNoContacts = to->hasNoContacts && from->hasNoContacts;
    to->wasExact = to->wasExact || from->wasExact;
    to->steps = MeMAX(to->steps, from->steps);
    to->wait = MeMAX(to->wait, from->wait);
    to->since = MeMAX(to->since, from->since);
}

static double budgetOf(const MdtWorld *w) {
    return w->workBudget > 0 ? 1e6 * (double)w->workBudget : mdt_unboundedBudget;
}

static int bodiesOf(const MdtWorld *w, int partition) {
    return w->bodyStart[partition + 1] - w->bodyStart[partition];
}

/* Who is given shares. */
typedef enum Standing {
    NO_NEED,   /* nothing acts on it, or the program has chosen */
    CERTIFIED, /* it will be stepped only if something has changed without a word */
    FIRST,     /* what a step with forces to begin with costs is not known yet */
    UNMET,     /* the fast solver has not met its accuracy, or is not for it */
    GOES_ON,   /* it has, or was not tried: the exact solver has taken the last step, */
    SATISFIED  /* or the fast one */
} Standing;

static Standing standingOf(const MdtWorld *w, int partition) {
    const MdtIslandRecord *r = &w->record[partition];
    if (mdt_choiceRequested(w, partition) != MdtSolverAuto ||
        w->actingStart[partition + 1] == w->actingStart[partition])
        return NO_NEED;
    if (w->bodyOf[w->bodyStart[partition]]->certificate != 0)
        return CERTIFIED;
    return r->steps < 2 ? FIRST : r->isUnmet || r->isUnfit ? UNMET : r->wasExact ? GOES_ON : SATISFIED;
}

/* Multiplications that an exact step is likely to take. */
static double needOf(const MdtWorld *w, int partition) {
    const MdtIslandRecord *r = &w->record[partition];
    const double n = bodiesOf(w, partition);
    return n * (r->exactWork == 0 ? mdt_guessedWork * n : (double)r->exactWork);
}

/* Multiplications in the time of a fast step. */
static double fastOf(const MdtWorld *w, int partition) {
    const double fast = (double)w->record[partition].fastWork;
    return bodiesOf(w, partition) * (fast > 0 ? fast : mdt_guessedFastWork);
}

/* Multiplications of an exact step that costs no more than a fast one, and where nothing touches a hundred times as
 * much, since the fast solver damps what swings. */
static double freeWorkOf(const MdtWorld *w, int partition) {
    const MdtIslandRecord *r = &w->record[partition];
    if (r->hasNoContacts)
        return fmin(mdt_maxOfFast * fastOf(w, partition), mdt_stepShare * budgetOf(w));
    return r->fastWork > 0 ? fastOf(w, partition) : 0;
}

/* Gives shares to those of this standing that have none and that the funds pay, which are part of an account; returns
 * what is left of these. */
static double giveShares(MdtWorldID w, Standing standing, MeBool isExactFirst, MdtAccount account, double funds) {
    for (int i = 0; i < w->numPartitions; i++) {
        MdtIslandRecord *r = &w->record[i];
        const double need = needOf(w, i);
        const MeBool isOutOfProportion = /* far more than a fast step, and than what a step is paid for anything */
            need > mdt_payment[MDT_OPTIONAL] * budgetOf(w) && need > mdt_maxOfFast * fastOf(w, i);
        if (r->share > 0 || need > funds || standingOf(w, i) != standing)
            continue;
        if (isOutOfProportion && standing != FIRST && !r->isUnfit)
            continue;
        r->share = r->drawn = need;
        r->account = account;
        r->isExactFirst = isExactFirst || r->isUnfit || (standing == UNMET && r->since <= r->wait);
        w->credit[account] -= need;
        funds -= need;
    }
    return funds;
}

/* Those of which an exact step takes no longer than a fast one. */
static void beginShares(MdtWorldID w) {
    for (int i = 0; i < w->numPartitions; i++) {
        MdtIslandRecord *r = &w->record[i];
        const double freeWork = freeWorkOf(w, i);
        const Standing standing = standingOf(w, i);
        r->drawn = r->loan = 0;
        r->isExactFirst = standing >= UNMET && needOf(w, i) <= freeWork;
        r->share = r->isExactFirst ? freeWork : 0;
    }
}

/* Lends to those of this standing, or to the others, that have a share, by their bodies, for steps that take more than
 * was likely. */
static void lend(MdtWorldID w, MeBool isFirst, double funds) {
    double bodies = 0;
    for (int i = 0; i < w->numPartitions; i++)
        if (w->record[i].share > 0 && isFirst == (standingOf(w, i) == FIRST))
            bodies += bodiesOf(w, i);
    for (int i = 0; i < w->numPartitions && bodies > 0; i++)
        if (w->record[i].share > 0 && isFirst == (standingOf(w, i) == FIRST)) {
            const double loan = funds * bodiesOf(w, i) / bodies;
            w->record[i].loan = loan;
            w->record[i].share += loan;
            w->credit[MDT_NEEDED] -= loan;
        }
}

static void divideAccounts(MdtWorldID w) {
    const double limit = mdt_stepShare * budgetOf(w);
    beginShares(w);
    giveShares(w, FIRST, METRUE, MDT_NEEDED, w->credit[MDT_NEEDED]);
    giveShares(w, GOES_ON, METRUE, MDT_OPTIONAL, fmin(limit, w->credit[MDT_OPTIONAL]));
    double left = giveShares(w, UNMET, MEFALSE, MDT_NEEDED, fmin(limit, w->credit[MDT_NEEDED]));
    left = giveShares(w, GOES_ON, MEFALSE, MDT_NEEDED, left);
    giveShares(w, CERTIFIED, METRUE, MDT_OPTIONAL, w->credit[MDT_OPTIONAL]);
    lend(w, MEFALSE, left);
    lend(w, METRUE, w->credit[MDT_NEEDED]);
}

static void pay(MdtWorldID w) {
    for (int i = 0; i < MDT_ACCOUNTS; i++)
        w->credit[i] = fmin(w->credit[i] + mdt_payment[i] * budgetOf(w), mdt_creditLimit[i] * budgetOf(w));
}

void mdt_choicesReset(MdtWorldID w) {
    for (int i = 0; i < MDT_ACCOUNTS; i++)
        w->credit[i] = DBL_MAX; /* as much as they can hold, when the next step pays */
}

void mdt_choicesBegin(MdtWorldID w, MeBool isStep) {
    readSolversOfProgram(w);
    if (isStep)
        pay(w);
    divideAccounts(w);
}

void mdt_choicesEnd(MdtWorldID w) {
    for (int i = 0; i < w->numPartitions; i++) {
        w->credit[w->record[i].account] += w->record[i].drawn;
        w->credit[MDT_NEEDED] = fmax(w->credit[MDT_NEEDED] + w->record[i].loan, 0);
    }
}

/* ---- the choice ---- */

/* Nothing in it touches the world: it carries no weight, and its forces come of meetings and of overlaps alone. */
MeBool mdt_choiceIsInFlight(const MdtIsland *p) {
    for (int i = 0; i < p->numActing; i++)
        if (!p->acting[i]->side[0].body || !p->acting[i]->side[1].body)
            return MEFALSE;
    return METRUE;
}

/* m/s, at which its bodies come nearer to each other there. */
static double approachAt(const MdtPoint *point) {
    const MdtBaseConstraint *base = &mdt_manifoldOf(point)->base;
    double normal[3], sum = 0;
    mdt_pointNormal(point, normal);
    for (int k = 0; k < 2; k++) {
        const MdtBody *b = base->side[k].body;
        double arm[3], v[3], w[3], turn[3];
        if (!b)
            continue;
        mdt_fromReal(v, b->velocity);
        mdt_fromReal(w, b->angularVelocity);
        keaSubtract(arm, point->position, b->kea.position);
        keaCross(turn, w, arm);
        sum += (k == 0 ? -1 : 1) * (keaDot(normal, v) + keaDot(normal, turn));
    }
    return sum;
}

/* Groups of contacts that hold their bodies; not more than one above `max` are counted. */
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
                bodies[k] = base->side[k].body ? &base->side[k].body->kea : NULL;
            isPersistent = MdtKeaContactHolds(bodies, -at->depth, -approachAt(at), mdt_pointParams(at)->restitution,
                                              keaLength(g) * p->h);
        }
        count += isPersistent;
    }
    return count;
}

static MdtReportWhy reasonForExact(const MdtIsland *p) {
    return p->record->share == 0 ? MdtReportWhyUnfit : p->record->drawn > 0 ? MdtReportWhyAfforded : MdtReportWhyCheap;
}

/* Rows 1 to 6 of the table. Bodies that keep their energy, of which only few are held, are met one after the other
 * (mdt_subdivide.c): the fast solver loses rebounds that follow each other. Of a swarm in flight the centre of mass
 * moves as a free body by the fast solver, which the exact one takes for what it does not meet in time to the end's
 * velocity. What the fast solver leaves of joints alone may drive them: its answer has to meet the accuracy. */
static MdtReportWhy reasonOf(const MdtIsland *p) {
    const MdtIslandRecord *r = p->record;
    const MeBool isLarge = p->numBodies > p->world->timedBodies && p->numContacts > 0 && !p->bounces;
    const MeBool keepsEnergy = p->bounces && !p->losesEnergy && p->numJoints == 0;
    const MeBool isUnmet = p->numContacts == 0 && r->isUnmet && r->since <= r->wait;
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

MeBool mdt_choiceIsFast(MdtIsland *p) {
    p->why = reasonOf(p);
    return p->why == MdtReportWhyAsked ? p->solver == MdtSolverFast : p->why >= MdtReportWhyFlight;
}

/* ---- the step ---- */

MeBool mdt_choiceHasShare(const MdtIsland *p) {
    const MeBool isSatisfied = p->record->fastWork > 0 && !p->record->isUnmet;
    return !p->isFast && (p->why == MdtReportWhyCheap || p->why == MdtReportWhyAfforded) &&
           (isSatisfied || p->numContacts > 0);
}

/* Parts of a step that has not been declined may take more than its share. */
double mdt_choiceBudget(const MdtIsland *p) {
    const double all = 1e6 * (double)p->world->workBudget;
    const double max = !p->isFast && p->numContacts > 0 && p->mayBeFast ? (1 - mdt_fastReserve) * all : all;
    if (mdt_choiceHasShare(p) && p->numContacts > 0)
        return fmin(fmax(p->record->share, 2 * mdt_stepShare * budgetOf(p->world)), all > 0 ? max : MDT_NO_BOUND);
    return max;
}

void mdt_choiceSwitchToFast(MdtIsland *p) {
    p->why = MdtReportWhyTakenOver;
    p->work = p->world->workBudget > 0 ? fmax(budgetOf(p->world) - p->exactWork, mdt_fastReserve * budgetOf(p->world))
                                       : MDT_NO_BOUND;
    mdt_islandSetFast(p, METRUE);
}

MeBool mdt_choiceNeedsExact(const MdtIsland *p) {
    const MeBool mustBeAccurate = p->numContacts == 0; /* joints alone */
    const MeBool isAllowed = p->why == MdtReportWhyDear
                                 ? p->record->share > 0 || mustBeAccurate
                                 : p->why == MdtReportWhyTakenOver && mustBeAccurate && p->hasDeclined;
    return isAllowed && p->numMembers == 0 && p->elapsed == 0 && p->kea.report.excess > 1;
}

void mdt_choiceSwitchToExact(MdtIsland *p) {
    p->why = p->numContacts == 0 ? MdtReportWhyUnfit : reasonForExact(p);
    mdt_islandSetFast(p, MEFALSE);
    const double budget = mdt_choiceBudget(p);
    p->work = budget > 0 ? fmax(budget - p->exactWork, 1) : MDT_NO_BOUND;
}

/* The fast solver's last answer decides when it is tried again. */
static void noteFast(const MdtIsland *p, MdtIslandRecord *r) {
    r->isUnmet = p->excess > 1;
    r->wait = !r->isUnmet ? 0 : r->wait == 0 ? 1 : MeMIN(2 * r->wait, MDT_WAIT_LIMIT);
    r->since = 0;
    r->fastWork = (float)(p->fastWork / p->numBodies / (p->numContacts > 0 ? mdt_exactTime : 1));
}

/* What an exact step has taken: one that was declined would have taken more; a first one has no forces to begin with,
 * and takes more factorizations than those that follow. */
static double exactWorkOf(const MdtIsland *p, const MdtIslandRecord *r) {
    if (p->hasDeclined)
        return fmax(2 * p->exactWork, p->min);
    return r->steps == 0 ? p->exactWork / MeMAX(1, p->kea.report.factorizations) : p->exactWork;
}

static void noteExact(const MdtIsland *p, MdtIslandRecord *r) {
    const double share = p->hasDeclined || r->steps < 2 ? 1 : mdt_newShare;
    r->exactWork += (float)(share * (exactWorkOf(p, r) / p->numBodies - (double)r->exactWork));
}

/* What it has used comes first of its own account, then of the loan, and of what is left for loans. */
static void giveBack(const MdtIsland *p, MdtIslandRecord *r) {
    const double used = r->share > 0 ? fmax(p->exactWork - (r->share - r->drawn - r->loan), 0) : 0;
    r->loan -= fmax(used - r->drawn, 0);
    r->drawn = fmax(r->drawn - used, 0);
}

void mdt_choiceNote(const MdtIsland *p, MdtIslandRecord *r) {
    r->since++;
    if (p->fastWork > 0)
        noteFast(p, r);
    if (p->exactWork > 0 || p->hasDeclined)
        noteExact(p, r);
    else
        r->exactWork *= (float)mdt_forgetting;
    r->steps = p->solver == MdtSolverAuto ? MeMIN(r->steps + 1, 2) : 0; /* what the program chose begins anew */
    r->hasNoContacts = p->numContacts == 0;
    r->isUnfit = r->hasNoContacts || p->bounces;
    r->wasExact = p->exactWork > 0 && !p->hasDeclined;
    giveBack(p, r);
}
