/* The choice between Kea's solvers: which partitions are the fast one's. */
#include "mdt_step_i.h"

/* ---- what the program wants ---- */

static MdtSolver askFor(MdtWorldID w, MdtBodyID *bodies, int numBodies) {
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

void mdt_crowdAsk(MdtWorldID w) {
    for (int i = 0; w->solverCb && i < w->numPartitions; i++) {
        const int first = w->bodyStart[i], end = w->bodyStart[i + 1];
        const MdtSolver solver = askFor(w, w->bodyOf + first, end - first);
        for (int k = first; k < end; k++) {
            MdtBodyID b = w->bodyOf[k];
            if (b->solver != solver)
                mdt_bodyDisturb(b);
            b->solver = solver;
        }
    }
}

MdtSolver mdt_crowdWanted(const MdtWorld *w, int partition) {
    return w->solverCb ? w->bodyOf[w->bodyStart[partition]]->solver : w->solver;
}

/* ---- what happens to it ---- */

/* m/s: of the bodies of a contact towards each other, by their velocities at the start of the step. */
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

/* Do bodies meet in this step faster than `least`, or are they pushed apart as fast? */
static MeBool meetsWith(const MdtIsland *p, const MdtManifold *m, double least) {
    for (const MdtPoint *at = mdt_pointFirst(m); at; at = mdt_pointAfter(at)) {
        if ((double)p->world->gamma * at->depth > least * p->h)
            return METRUE;
        const double approach = approachAt(at);
        if (approach > least && at->depth + approach * p->h > 0)
            return METRUE;
    }
    return MEFALSE;
}

/* m/s², by which only impacts change a velocity. */
static double leastOfImpacts(const MdtIsland *p) {
    double g[3];
    mdt_fromReal(g, p->world->params.gravity);
    return MDT_IMPACT * keaLength(g);
}

/* Was it hit in its last step? */
static MeBool isHit(const MdtBody *b, double least) {
    return keaLength(b->kea.lastStep.lin) > least;
}

/* Have bodies met in the last step, or do they in this one? Then their velocities change by far more than gravity
 * explains, and what follows is known no better than the law by which they part. */
static MeBool hasImpacts(const MdtIsland *p) {
    const double most = leastOfImpacts(p);
    for (int i = 0; i < p->numBodies; i++)
        if (isHit(p->bodies[i], most))
            return METRUE;
    for (int i = 0; i < p->numActing; i++)
        if (mdt_isManifold(p->acting[i]) && meetsWith(p, mdt_asManifold(p->acting[i]), most * p->h))
            return METRUE;
    return MEFALSE;
}

/* Partitions of so few bodies meet their contacts in time (MdtWorldSetTimedContacts). */
static MeBool isSmall(const MdtIsland *p) {
    return p->numBodies <= p->world->timedBodies;
}

/* A partition is disturbed from an impact on, or from a step in which contacts did not settle, until all its bodies are
 * slow. With joints, which go on swinging, it is until all are at rest (mdt_rest.c), and so it is among many that are
 * not at rest (mdt_batch.c); and so are few bodies that come out of a disturbed partition, since they may be slow and
 * wedged, and what the exact solver has worked at too long. So a partition does not change its solver to and fro. */
static MeBool isStillDisturbed(const MdtIsland *p, const MdtBody *b) {
    return b->unrest != MDT_CALM &&
           (p->numJoints > 0 || isSmall(p) || p->isAmongMany || mdt_bodyIsFast(b) ||
            b->settlingWork > mdt_mostSettlingWork);
}

/* One of few bodies is met in time, unless it is one of many. */
static MeBool mayBeDisturbed(const MdtIsland *p) {
    return !isSmall(p) || p->isAmongMany;
}

static MdtUnrest unrestOf(const MdtIsland *p) {
    MdtUnrest is = mayBeDisturbed(p) && (p->numBodies >= MDT_CROWD || hasImpacts(p)) ? MDT_HIT : MDT_CALM;
    for (int i = 0; i < p->numBodies && is != MDT_UNSETTLED; i++)
        if (isStillDisturbed(p, p->bodies[i]))
            is = MeMAX(is, p->bodies[i]->unrest);
    return is;
}

/* Takes the unrest of any body to all of them, and the most work of settling. */
static MeBool isDisturbed(const MdtIsland *p) {
    const MdtUnrest is = unrestOf(p);
    const double least = leastOfImpacts(p);
    double settlingWork = 0;
    for (int i = 0; i < p->numBodies; i++)
        settlingWork = fmax(settlingWork, p->bodies[i]->settlingWork);
    for (int i = 0; i < p->numBodies; i++) {
        MdtBody *b = p->bodies[i];
        b->unrest = is;
        b->settlingWork = settlingWork;
        b->wasHit = b->wasHit || isHit(b, least);
    }
    return is != MDT_CALM;
}

/* Does the program leave the choice to the engine, and bear a residual? */
static MeBool isLeftToChoose(const MdtIsland *p) {
    return p->solver == MdtSolverAuto && mdt_worldAccuracy(p->world, p->h) > 0;
}

/* Was one in MDT_COLLAPSED of its bodies hit since it rested? Not if the program wants the exact solver for all. */
static MeBool hasCollapsed(const MdtIsland *p) {
    int hit = 0;
    if (!isLeftToChoose(p))
        return MEFALSE;
    for (int i = 0; i < p->numBodies; i++)
        hit += p->bodies[i]->wasHit;
    return hit * MDT_COLLAPSED >= p->numBodies;
}

/* Multiplications: a work budget of the exact solver for what has collapsed. */
static double collapsedBudget(const MdtIsland *p) {
    return 1e6 * (double)p->world->workBudget * fmin(1, p->numBodies / (double)MDT_WHOLE_BUDGET);
}

double mdt_crowdBudget(const MdtIsland *p) {
    return !p->isFast && hasCollapsed(p) ? mdt_collapsedStepWork * collapsedBudget(p)
                                         : 1e6 * (double)p->world->workBudget;
}

/* How a collapsed pile comes to lie, wedged, is chance: the exact solver may take so much work to settle it, and no
 * more. What stands, leans or slides is solved exactly however long that takes. */
static void noteSettling(const MdtIsland *p) {
    const double budget = collapsedBudget(p), work = p->kea.report.work;
    if (p->isFast || budget == 0 || work <= mdt_freeWork * budget || !hasCollapsed(p))
        return;
    const double settlingWork = p->bodies[0]->settlingWork + work / budget - mdt_freeWork;
    for (int i = 0; i < p->numBodies; i++) {
        p->bodies[i]->settlingWork = settlingWork;
        p->bodies[i]->unrest = settlingWork > mdt_mostSettlingWork ? MDT_UNSETTLED : p->bodies[i]->unrest;
    }
}

/* Not what only lies or slides, without joints: towers and houses of cards stand more exactly by the exact solver. */
void mdt_crowdNote(const MdtIsland *p) {
    noteSettling(p);
    if (p->numJoints == 0 && !p->bounces)
        return;
    if (p->isFast || isSmall(p) || p->kea.parameters.timed)
        return;
    if (p->kea.report.factorizations <= MDT_SETTLING && !(p->kea.report.limited && p->numJoints > 0))
        return;
    for (int i = 0; i < p->numBodies; i++)
        p->bodies[i]->unrest = MDT_UNSETTLED;
}

/* Nothing in it touches the world: it carries no weight, and its forces come of meetings and of overlaps alone. */
MeBool mdt_crowdIsInFlight(const MdtIsland *p) {
    for (int i = 0; i < p->numActing; i++)
        if (!p->acting[i]->side[0].body || !p->acting[i]->side[1].body)
            return MEFALSE;
    return METRUE;
}

static MeBool holds(const MdtPoint *point, double loadSpeed) {
    const MdtBaseConstraint *base = &mdt_manifoldOf(point)->base;
    const MdtKeaBody *bodies[2];
    for (int k = 0; k < 2; k++)
        bodies[k] = base->side[k].body ? &base->side[k].body->kea : NULL;
    return MdtKeaContactHolds(bodies, -point->depth, -approachAt(point), mdt_pointParams(point)->restitution,
                              loadSpeed);
}

/* Impacts of a crowd that keeps its energy are followed also where some bodies are held, with a solve at each event; of
 * other crowds only as long as all bodies fly. */
int mdt_mostHeld(const MdtIsland *p) {
    if (p->world->timedBodies == 0 || (p->numBodies >= MDT_CROWD && p->losesEnergy))
        return 0;
    return MeMAX(p->world->timedBodies, p->numBodies / MDT_HELD);
}

/* Do its bodies meet in this step, and rebound? */
static MeBool rebounds(const MdtIsland *p, const MdtPoint *point, double loadSpeed) {
    const MdtBclContactParams *params = mdt_pointParams(point);
    return mdt_bounces(params) &&
           MdtKeaContactRebounds(-point->depth, -approachAt(point) - loadSpeed, params->restitution,
                                 params->velThreshold, loadSpeed, p->h);
}

static MeBool isUnsettled(const MdtIsland *p) {
    for (int i = 0; i < p->numBodies; i++)
        if (p->bodies[i]->unrest == MDT_UNSETTLED && isStillDisturbed(p, p->bodies[i]))
            return METRUE;
    return MEFALSE;
}

/* Bodies that bounce, of which only few are held, are met one after the other (mdt_subdivide.c), unless contacts do not
 * settle; with joints, which hold as contacts do, only in a step in which some rebound. */
static MeBool isMetInTime(const MdtIsland *p) {
    const int most = mdt_mostHeld(p);
    MeBool doesBounce = MEFALSE;
    double g[3];
    int holding = p->numJoints;
    if (!p->bounces || isUnsettled(p))
        return MEFALSE;
    mdt_fromReal(g, p->world->params.gravity);
    const double loadSpeed = keaLength(g) * p->h;
    for (int i = 0; i < p->numActing && holding <= most; i++) {
        if (mdt_isJoint(p->acting[i]))
            continue;
        MeBool isHeld = MEFALSE;
        for (const MdtPoint *at = mdt_pointFirst(mdt_asManifold(p->acting[i])); at; at = mdt_pointAfter(at)) {
            doesBounce = doesBounce ||
                         (p->numJoints > 0 ? rebounds(p, at, loadSpeed) : mdt_bounces(mdt_pointParams(at)));
            isHeld = isHeld || holds(at, loadSpeed);
        }
        holding += isHeld;
    }
    return doesBounce && holding <= most;
}

/* Rows of user constraints are the program's: how they move with the bodies is not known. */
static MeBool hasUserConstraints(const MdtIsland *p) {
    for (int i = 0; i < p->numActing && p->numJoints > 0; i++)
        if (mdt_isJoint(p->acting[i]) && mdt_constraintType(p->acting[i]) == MdtBclUSER)
            return METRUE;
    return MEFALSE;
}

/* The other body of a joint that acts; null: the world, or no such joint. */
static const MdtBody *jointedTo(const MdtAttachment *at) {
    const MdtConstraintID c = mdt_attachmentOwner(at);
    return mdt_isJoint(c) && (c->record.flags & MDT_ENABLED) ? c->side[1 - mdt_attachmentSide(at)].body : NULL;
}

/* How many bodies joints tie it to. */
static int neighboursOf(const MdtBody *b) {
    int count = 0;
    for (const MdtAttachment *at = b->attachments; at; at = at->next) {
        const MdtBody *other = jointedTo(at);
        const MdtAttachment *first = b->attachments;
        while (first != at && jointedTo(first) != other)
            first = first->next;
        count += other && first == at;
    }
    return count;
}

/* Do joints make a net of its bodies? */
static MeBool isNet(const MdtIsland *p) {
    int neighbours = 0;
    for (int i = 0; i < p->numBodies; i++)
        neighbours += neighboursOf(p->bodies[i]);
    return neighbours > MDT_NET_NEIGHBOURS * p->numBodies;
}

/* What joints alone hold is the exact solver's, which keeps its energy; but not nets that it cannot cope with: their
 * matrices fill in, and hanging flat they are singular. Its rows may not be more than the cap, as it leaves none out.
 */
static MeBool mayBeFast(const MdtIsland *p) {
    return (p->numContacts > 0 || (isUnsettled(p) && isNet(p))) &&
           p->jointRows + p->numContacts * MdtBclGETMAXROWSCONTACT <= p->world->maxMatrixSize && !hasUserConstraints(p);
}

MeBool mdt_crowdMayTakeOver(const MdtIsland *p) {
    return !p->isFast && p->numContacts > 0 && mayBeFast(p);
}

/* MdtReportWhyCalm: nothing has hit it, and it does not fly as a whole. */
static MdtReportWhy reasonForFast(const MdtIsland *p) {
    if (!isDisturbed(p))
        return !isSmall(p) && mdt_crowdIsInFlight(p) ? MdtReportWhyFlight : MdtReportWhyCalm;
    if (p->bodies[0]->unrest == MDT_UNSETTLED)
        return MdtReportWhyUnsettled;
    if (p->numBodies >= MDT_CROWD)
        return MdtReportWhyMany;
    return p->isAmongMany ? MdtReportWhyDebris : MdtReportWhyHit;
}

static MdtReportWhy reasonOf(const MdtIsland *p) {
    if (p->solver == MdtSolverExact)
        return MdtReportWhyAsked;
    if (!mayBeFast(p))
        return MdtReportWhyUnfit;
    if (!isLeftToChoose(p))
        return MdtReportWhyAsked;
    if (isSmall(p) && p->numJoints > 0)
        return MdtReportWhyCalm;
    return isMetInTime(p) ? MdtReportWhyBounce : reasonForFast(p);
}

MeBool mdt_crowdIsChosen(MdtIsland *p) {
    p->why = reasonOf(p);
    return p->why == MdtReportWhyAsked ? p->solver == MdtSolverFast : p->why >= MdtReportWhyMany;
}

MeBool mdt_crowdTakesRest(const MdtIsland *p) {
    return mdt_crowdMayTakeOver(p) && isLeftToChoose(p) && !isSmall(p) && reasonForFast(p) != MdtReportWhyCalm;
}

void mdt_crowdTakeOver(MdtIsland *p) {
    p->why = MdtReportWhyTakenOver;
    mdt_islandSetFast(p, METRUE);
}
