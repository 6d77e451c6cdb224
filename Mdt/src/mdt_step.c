/* One step of a world (Dynamics guide ch. 2; User Guide ch. 2, "MdtWorldStep"):
 *
 *     partitions -> rest -> for each partition: pack -> rows -> solve -> integrate -> unpack
 *
 * Rows, solve and integrate are repeated with halves of the step where joints turn too violently for the whole of it.
 */
#include "mdt_i.h"
#include "MeAssert.h"
#include "MeProfile.h"
#include <float.h>
#include <limits.h>
#include <string.h>

/* One partition on its way through a step. */
typedef struct Partition {
    MdtWorldID world;
    int number, numBodies, numConstraints;
    MdtBodyID *bodies;
    MdtConstraintID *constraints;
    double h;                          /* s, by which it is moved on */
    double whole;                      /* s, the step that the program asked for, of which h may be a part */
    MdtBclSolverParameters parameters; /* of the part of it that is being taken */
    double elapsed;                    /* s, before that part */
    double work;                       /* multiplications that it may still cost; NO_BOUND: any number */
    int iterations;                    /* of Newton's method, the same; 0: any number */
    MeBool isDegenerate;               /* some joint was in this step */
    MdtKeaSystem kea;
    MdtReport *report; /* null: it is off */
} Partition;

/* A body as the step begins. */
typedef struct Start {
    MdtKeaVelocity velocity;
    double position[3];
} Start;

enum { MAX_HALVINGS = 6 };
#define NO_BOUND DBL_MAX

static Partition partitionNumber(MdtWorldID w, int number, double h) {
    const int bodies = w->bodyStart[number], constraints = w->constraintStart[number];
    Partition p = {.world = w, .number = number, .h = h, .whole = w->lastStep};
    p.numBodies = w->bodyStart[number + 1] - bodies;
    p.numConstraints = w->constraintStart[number + 1] - constraints;
    p.bodies = w->bodyOf + bodies;
    p.constraints = w->constraintOf + constraints;
    p.kea.numBodies = p.numBodies;
    p.kea.bodies = w->keaOf + bodies;
    return p;
}

/* ---- rest ---- */

/* A body that is still coming out of an overlap has no velocity, but it is under way. */
static MeBool isPushedOut(MdtBodyID b, const MdtPartitionParams *rest) {
    const double slow = 1e-4; /* of vel_thresh: squares of velocities */
    return keaDot(b->push, b->push) > slow * (double)rest->vel_thresh;
}

static MeBool isAtRest(const Partition *p) {
    const MdtPartitionParams *rest = &p->world->rest;
    for (int i = 0; i < p->numBodies; i++) {
        MdtBodyID b = p->bodies[i];
        const MeBool isYoung =
            rest->alive_window < 0 ? b->enabledTime < (double)rest->alive_time : b->enabledSteps < rest->alive_window;
        if (isYoung || b->enabledSteps == 0 || MdtBodyIsMovingTest(b, rest) || isPushedOut(b, rest))
            return MEFALSE;
    }
    return METRUE;
}

static void putToSleep(const Partition *p) {
    for (int i = 0; i < p->numBodies; i++)
        mdt_bodySleep(p->bodies[i]);
}

/* ---- pack ---- */

static void addGravity(MdtWorldID w, MdtBodyID b) {
    for (int i = 0; i < 3; i++)
        b->kea.force[i] += b->mass * (double)w->params.gravity[i];
}

/* A part of H / n takes the n-th part of a step's relaxation, and a load sags as it would in a whole one:
 *     1 - γ = (1 - γ')^n,   ε' F (H/n)² / γ' = ε F H² / γ.
 * H is the step that the program asked for: a partition that its safe time moves on by less takes that share of an error away,
 * however short it is, at the same speed γ φ / H. */
static void setPart(Partition *p, double part) {
    MEASSERT(part > 0 && part <= p->h * (1 + 1e-9) && p->h <= p->whole * (1 + 1e-9));
    const double n = p->whole / part, gamma = p->world->gamma;
    p->parameters.stepsize = part;
    p->parameters.gamma = n > 1 ? 1 - pow(1 - gamma, 1 / n) : gamma;
    p->parameters.softening = gamma > 0 ? n * n * p->parameters.gamma / gamma : n;
    p->parameters.epsilon = p->parameters.softening * (double)p->world->epsilon;
    p->kea.parameters.stepsize = part;
    p->kea.parameters.gamma = p->parameters.gamma;
    p->kea.parameters.isPart = p->h < p->whole;
}

static void packBodies(Partition *p) {
    for (int i = 0; i < p->numBodies; i++) {
        MEASSERT(p->bodies[i]->partition == p->number && (p->bodies[i]->flags & MDT_ENABLED));
        p->bodies[i]->index = i;
        mdt_bodyPack(p->bodies[i]);
        addGravity(p->world, p->bodies[i]);
    }
}

/* ---- rows ---- */

static void setContext(const Partition *p, MdtConstraintID c, MdtBclContext *x) {
    const MdtKeaSystem *kea = &p->kea;
    x->parameters = p->parameters;
    x->elapsed = p->elapsed;
    x->firstRow = c->firstRow;
    for (int k = 0; k < 2; k++) {
        MdtBodyID b = c->side[k].body;
        x->body[k] = b ? b->index : MdtBclNO_BODY;
        x->kea[k] = b ? &b->kea : NULL;
        x->pose[k] = b ? &kea->pose[b->index] : &MdtBclWorldPose;
        x->velocity[k] = b ? &kea->velocity[b->index] : &c->worldVelocity;
        x->predicted[k] = b ? &kea->predicted[b->index] : &c->worldVelocity;
        x->acceleration[k] = b ? &b->acceleration : &MdtBclWorldVelocity;
        x->invMass[k] = b ? &kea->invMass[b->index] : &MdtBclWorldInvMass;
    }
}

/* The rows speak of the velocity of one side against the other; of the world's it is known. */
static void subtractWorldVelocity(MdtConstraintID c, MdtKeaRow *row) {
    double rate = 0;
    for (int k = 0; k < 2; k++)
        if (row->body[k] == MdtBclNO_BODY)
            rate += keaDot(row->J[k].lin, c->worldVelocity.lin) + keaDot(row->J[k].ang, c->worldVelocity.ang);
    row->target -= rate;
    row->drift -= rate;
}

/* Once when a joint comes there, not at every step, or part of one, that it stays. */
static void noteDegenerate(Partition *p, MdtConstraintID c) {
    p->isDegenerate = p->isDegenerate || c->bcl.isDegenerate;
    if (!c->bcl.isDegenerate || c->isDegenerate)
        return;
    c->isDegenerate = METRUE;
    if (c->wasDegenerate)
        return;
    c->world->degenerate++;
    MeWarning(2, "MdtWorldStep: a %s (sort key %d) cannot work as it stands: %s", c->type->name, c->link.sortKey,
              c->type->degenerate);
}

static int countRows(Partition *p) {
    MdtBclContext x;
    int rows = 0;
    for (int i = 0; i < p->numConstraints; i++) {
        MdtConstraintID c = p->constraints[i];
        setContext(p, c, &x);
        c->isDropped = MEFALSE;
        c->numRows = c->type->prepare(&c->bcl, &x);
        MEASSERT(c->numRows >= 0 && c->numRows <= c->type->maxRows);
        noteDegenerate(p, c);
        mdt_checkSurface(c);
        rows += c->numRows;
    }
    return rows;
}

static void fillRows(Partition *p) {
    MdtKeaSystem *kea = &p->kea;
    MdtBclContext x;
    for (int i = 0; i < p->numConstraints; i++) {
        MdtConstraintID c = p->constraints[i];
        c->firstRow = kea->numRows;
        setContext(p, c, &x);
        if (c->numRows > 0)
            c->type->fill(&c->bcl, &x, kea->rows + c->firstRow);
        for (int r = 0; r < c->numRows; r++) {
            MdtKeaRow *row = &kea->rows[c->firstRow + r];
            subtractWorldVelocity(c, row);
            row->owner = i;
            row->force = c->numWarm == c->numRows ? c->warm[r] : row->force;
            row->ripple = c->numWarm == c->numRows ? c->ripple[r] : 0;
        }
        kea->numRows += c->numRows;
        MEASSERT(kea->numRows <= kea->maxRows);
    }
}

/* Count, leave out what is too much, fill. */
static void makeRows(Partition *p) {
    MdtWorldID w = p->world;
    const int rows = countRows(p);
    if (rows > w->maxMatrixSize)
        mdt_capRows(w, p->constraints, p->numConstraints, rows, w->maxMatrixSize);
    fillRows(p);
    if (p->number < w->sizeLogLength)
        w->sizeLog[p->number] = p->kea.numRows;
}

/* Rows of joints move with the bodies; contacts stay as they were found. */
static void MEAPI jointJacobians(void *context, const MdtKeaTransformation poses[]) {
    const Partition *p = context;
    MdtKeaRow rows[MdtBclGETMAXROWS];
    MdtBclContext x;
    for (int i = 0; i < p->numConstraints; i++) {
        MdtConstraintID c = p->constraints[i];
        if (c->numRows == 0 || c->type == MdtBclTypeOf(MdtBclCONTACT))
            continue;
        setContext(p, c, &x);
        for (int k = 0; k < 2; k++)
            if (c->side[k].body)
                x.pose[k] = &poses[c->side[k].body->index];
        c->type->fill(&c->bcl, &x, rows);
        for (int r = 0; r < c->numRows; r++) {
            MdtKeaRow *row = &p->kea.rows[c->firstRow + r];
            memcpy(row->J, rows[r].J, sizeof row->J);
            memcpy(row->arm, rows[r].arm, sizeof row->arm);
            row->lower = rows[r].lower;
            row->upper = rows[r].upper;
        }
    }
}

static void MEAPI positionErrors(void *context, const MdtKeaTransformation poses[], double errors[]) {
    const Partition *p = context;
    for (int i = 0; i < p->numConstraints; i++) {
        MdtConstraintID c = p->constraints[i];
        const MdtKeaTransformation *pose[2];
        if (!c->type->errors)
            continue;
        for (int k = 0; k < 2; k++)
            pose[k] = c->side[k].body ? &poses[c->side[k].body->index] : &MdtBclWorldPose;
        c->type->errors(&c->bcl, pose, errors + c->firstRow);
    }
}

/* ---- unpack ---- */

static void beginConstraints(Partition *p) {
    for (int i = 0; i < p->numConstraints; i++) {
        p->constraints[i]->wasDegenerate = p->constraints[i]->isDegenerate;
        p->constraints[i]->isDegenerate = MEFALSE;
        memset(&p->constraints[i]->force, 0, sizeof p->constraints[i]->force);
        keaZero(p->constraints[i]->normalForce);
    }
}

/* The force of a divided step is the mean over its parts. */
static void addForces(MdtConstraintID c, const MdtKeaRow *row, double share) {
    for (int k = 0; k < 2; k++) {
        keaAddScaled(c->force.body[k].lin, share * row->force, row->J[k].lin);
        keaAddScaled(c->force.body[k].ang, share * row->force, row->J[k].ang);
    }
}

/* A group's forces and rows are those of its contacts. It comes before them. */
static void addToGroup(MdtConstraintID c, const MdtKeaRow rows[], double share) {
    MdtConstraintID group = c->group;
    for (int r = 0; r < c->numRows; r++)
        addForces(group, &rows[r], share);
    if (c->numRows > 0)
        keaAddScaled(group->normalForce, share * rows[0].force, c->bcl.of.contact.normal);
}

static void unpackConstraints(Partition *p) {
    MdtBclContext x;
    for (int i = 0; i < p->numConstraints; i++) {
        MdtConstraintID c = p->constraints[i];
        const MdtKeaRow *rows = p->kea.rows + c->firstRow;
        for (int r = 0; r < c->numRows; r++)
            addForces(c, &rows[r], p->parameters.stepsize / p->h);
        const MeBool isLong = p->parameters.stepsize > 0.1 * p->h; /* the forces of a shorter part are no guess */
        c->numWarm = isLong ? c->numRows : 0;
        for (int r = 0; r < c->numRows; r++)
            c->warm[r] = rows[r].force, c->ripple[r] = rows[r].ripple;
        if (c->group)
            addToGroup(c, rows, p->parameters.stepsize / p->h);
        setContext(p, c, &x);
        if (c->isDropped)
            c->bcl.of.contact.normalForce = 0;
        else if (c->type->readBack)
            c->type->readBack(&c->bcl, &x, rows);
    }
}

static void velocityOf(MdtBodyID b, MdtKeaVelocity *v) {
    keaCopy(v->lin, b->kea.velocity);
    MdtKeaBodyGetAngularVelocity(&b->kea, v->ang);
}

static void rememberStart(Partition *p, Start start[]) {
    for (int i = 0; i < p->numBodies; i++) {
        velocityOf(p->bodies[i], &start[i].velocity);
        keaCopy(start[i].position, p->bodies[i]->kea.position);
    }
}

/* Bodies move with their velocity at the end of the step, or with its mean. */
static void notePush(MdtBodyID b, const Start *start, const MdtKeaVelocity *end, double h) {
    double beyondEnd[3], beyondMean[3];
    for (int k = 0; k < 3; k++) {
        const double way = (b->kea.position[k] - start->position[k]) / h;
        beyondEnd[k] = way - end->lin[k];
        beyondMean[k] = way - 0.5 * (start->velocity.lin[k] + end->lin[k]);
    }
    keaCopy(b->push, keaLength(beyondEnd) < keaLength(beyondMean) ? beyondEnd : beyondMean);
}

static void unpackBodies(Partition *p, const Start start[]) {
    for (int i = 0; i < p->numBodies; i++) {
        MdtBodyID b = p->bodies[i];
        MdtKeaVelocity end;
        velocityOf(b, &end);
        for (int k = 0; k < 3; k++) {
            b->acceleration.lin[k] = (end.lin[k] - start[i].velocity.lin[k]) / p->h;
            b->acceleration.ang[k] = (end.ang[k] - start[i].velocity.ang[k]) / p->h;
        }
        notePush(b, &start[i], &end, p->h);
        b->enabledTime += p->h;
        b->enabledSteps++;
        mdt_bodyNoteSlow(b, p->h);
        mdt_bodyKeepWithinReach(b);
        mdt_bodyShow(b);
    }
}

/* The last resort: bodies whose next state is not finite stay where they are and stop. */
static void stopBodies(Partition *p) {
    static const double none[3] = {0, 0, 0};
    MeWarning(2, "MdtWorldStep: partition %d (%d bodies) would leave the finite numbers; its bodies are stopped",
              p->number, p->numBodies);
    for (int i = 0; i < p->numBodies; i++) {
        keaZero(p->bodies[i]->kea.velocity);
        MdtKeaBodySetAngularVelocity(&p->bodies[i]->kea, none);
        mdt_bodyShow(p->bodies[i]);
    }
}

/* What an inexact solve is, the report says (MdtReport's fallbacks). A warning is for what somebody can mend: motion that the
 * step is too long for, or a cap that the program has set. */
static void warnOfSolver(const Partition *p) {
    const MeBool isMendable = p->kea.report.violent || p->kea.parameters.maxIterations > 0;
    if (p->kea.report.capped && !p->isDegenerate && isMendable) /* degenerate: that has been said */
        MeWarning(
            2,
            "MdtWorldStep: partition %d (%d rows) could not be solved in the iterations that it has, the forces are "
            "inexact; raise MdtWorldSetMaxLCPIterations or epsilon, or take shorter steps",
            p->number, p->kea.numRows);
    else if (p->kea.report.limited)
        MeDebug(2, "MdtWorldStep: partition %d (%d rows) has used up its work (MdtWorldSetWorkBudget)", p->number,
                p->kea.numRows);
    else if (p->kea.report.capped)
        MeDebug(2, "MdtWorldStep: partition %d (%d rows): the friction of redundant contacts did not settle", p->number,
                p->kea.numRows);
    if (p->kea.report.conflicting)
        MeDebug(2, "MdtWorldStep: partition %d (%d rows) has contradictory constraints, a compromise was taken",
                p->number, p->kea.numRows);
}

/* ---- for callbacks of the program (MdtMainLoop.h) ---- */

static MeBool hasPartition(const MdtPartitionOutput *po, int i, const char *caller) {
    if (!mdt_isPointer(caller, "the partition output", po))
        return MEFALSE;
    if (i >= 0 && i < po->numPartitions)
        return METRUE;
    MeWarning(1, "%s: there is no partition %d", caller, i);
    return MEFALSE;
}

void MEAPI MdtAutoDisableLastPartition(MdtPartitionOutput *po, void *cbdata) {
    (void)cbdata;
    if (!hasPartition(po, po ? po->numPartitions - 1 : 0, __func__))
        return;
    const Partition p = partitionNumber(po->world, po->numPartitions - 1, 0);
    po->info[p.number].isDisabled = po->world->rest.autoDisable && isAtRest(&p);
}

MeReal MEAPI MdtPartitionGetSafeTime(MdtPartitionOutput *po, int i) {
    if (!hasPartition(po, i, __func__))
        return 0;
    double safe = (double)MEINFINITY;
    for (int k = 0; k < po->info[i].numBodies; k++)
        safe = fmin(safe, (double)po->bodies[po->info[i].firstBody + k]->safeTime);
    return (MeReal)safe;
}

unsigned int MEAPI MdtUnpackForces(const MdtKeaForcePair *force, const unsigned int partitionindex,
                                   MdtPartitionOutput *po) {
    if (!mdt_isPointer(__func__, "the forces", force) || !hasPartition(po, (int)partitionindex, __func__))
        return 0;
    const MdtPartitionInfo *info = &po->info[partitionindex];
    for (int i = 0; i < info->numConstraints; i++)
        po->constraints[info->firstConstraint + i]->force = force[i];
    return (unsigned int)info->numConstraints;
}

/* ---- the step ---- */

static int mostRows(const Partition *p) {
    int rows = 0;
    for (int i = 0; i < p->numConstraints; i++)
        rows += p->constraints[i]->type->maxRows;
    return rows;
}

/* Room for Kea's arrays and, behind them, the state at the start. */
static void *takeScratch(Partition *p, Start **start) {
    const size_t bytes = MdtKeaScratchSize(p->numBodies, p->kea.maxRows);
    const size_t total = bytes + (size_t)p->numBodies * sizeof **start;
    char *scratch = total <= INT_MAX ? MeChunkGetMem(&p->world->scratch, (int)total) : NULL;
    if (!scratch)
        MeWarning(2, "MdtWorldStep: partition %d (%d bodies, %d rows) is too large for the solver and is not moved",
                  p->number, p->numBodies, p->kea.maxRows);
    else
        *start = (Start *)(void *)(scratch + bytes);
    return scratch;
}

/* ---- what a step may cost ----
 *
 * A partition's step has one budget of work (MdtWorldSetWorkBudget) and of iterations (MdtWorldSetMaxLCPIterations). Every
 * solve draws from it: of whole steps, sub-steps, halves, events and impacts, those that are thrown away included. When it
 * is used up, Kea answers by sweeps, and the step is divided no further. */

/* A part by safe time gets its share of the budget; the bridge may take 16 of them (mst_continuous.c). */
static void beginBudget(Partition *p) {
    const double budget = (double)p->world->workBudget, least = 1. / 16;
    p->work = budget > 0 ? 1e6 * budget * fmax(p->h / p->whole, least) : NO_BOUND;
    p->iterations = p->world->maxLcpIterations;
}

/* What is left is kept for later but for this share; the caller gives it back. */
static double keepWork(Partition *p, double share) {
    const double kept = p->work < NO_BOUND ? (1 - share) * p->work : 0;
    p->work -= kept;
    return kept;
}

/* The least of either is not none, which would mean any number. */
static void setMeans(Partition *p) {
    p->kea.parameters.maxWork = p->work < NO_BOUND ? fmax(p->work, 1) : 0;
    p->kea.parameters.maxIterations = p->world->maxLcpIterations == 0 ? 0 : p->iterations > 1 ? p->iterations : 1;
}

static void drawMeans(Partition *p) {
    const MdtKeaReport *cost = &p->kea.report;
    MEASSERT(cost->work >= 0 && cost->iterations >= 0);
    p->work = p->work < NO_BOUND ? fmax(p->work - cost->work, 0) : NO_BOUND;
    MEASSERT(p->work >= 0 && p->work <= NO_BOUND);
    p->iterations -= p->iterations < cost->iterations ? p->iterations : cost->iterations;
    if (p->report)
        p->report->work += (MeReal)(1e-6 * cost->work);
}

/* Whether both halves of the part would have enough for some passes. */
static MeBool mayDivide(const Partition *p, int halvings) {
    enum { PASSES = 8 };
    return halvings < MAX_HALVINGS && p->work > 2 * PASSES * p->kea.report.least;
}

/* Impacts at the start of a part: their impulses count as forces of the whole step. */
static void meet(Partition *p, void *scratch) {
    if (!MdtKeaMeets(&p->kea))
        return;
    setMeans(p);
    MdtKeaImpact(&p->kea);
    drawMeans(p);
    if (p->report)
        mdt_reportImpact(p->report);
    for (int i = 0; i < p->numConstraints; i++) {
        MdtConstraintID c = p->constraints[i];
        for (int r = 0; r < c->numRows; r++)
            addForces(c, &p->kea.rows[c->firstRow + r], 1 / p->h);
        if (c->group)
            addToGroup(c, p->kea.rows + c->firstRow, 1 / p->h);
    }
    MdtKeaInit(&p->kea, scratch);
    makeRows(p);
}

static void solvePart(Partition *p, void *scratch, double part) {
    if (p->report && p->elapsed > 0)
        mdt_reportLap(p->world, p->report, MdtReportStageIntegrate);
    MeProfileStartSection("Rows", 0);
    setPart(p, part);
    MdtKeaInit(&p->kea, scratch);
    makeRows(p);
    if (p->kea.parameters.timed)
        meet(p, scratch);
    MeProfileEndSection("Rows");
    if (p->report && p->kea.numRows > 0)
        mdt_reportLap(p->world, p->report, MdtReportStageRows);
    MeProfileStartSection("Solve", 0);
    setMeans(p);
    MdtKeaSolve(&p->kea);
    drawMeans(p);
    MeProfileEndSection("Solve");
    if (p->report)
        mdt_reportSolve(p->world, p->report, &p->kea);
}

static MeBool integratePart(Partition *p) {
    MeProfileStartSection("Integrate", 0);
    const MeBool isFinite = MdtKeaIntegrate(&p->kea);
    if (p->report)
        mdt_reportPart(p->report, &p->kea, p->constraints, p->numConstraints, isFinite);
    if (isFinite)
        unpackConstraints(p);
    else
        stopBodies(p);
    warnOfSolver(p);
    p->elapsed += p->parameters.stepsize;
    MEASSERT(p->elapsed <= p->h * (1 + 1e-6));
    MeProfileEndSection("Integrate");
    return isFinite;
}

/* Takes one part of the step, in halves where its motion is violent. False: the bodies were stopped. */
static MeBool takePart(Partition *p, void *scratch, double part, int halvings) {
    p->kea.parameters.mayRefuse = halvings < MAX_HALVINGS;
    solvePart(p, scratch, part);
    if (!p->kea.report.violent)
        return integratePart(p);
    if (!mayDivide(p, halvings))
        return p->kea.report.refused ? takePart(p, scratch, part, MAX_HALVINGS) : integratePart(p);
    if (p->report)
        mdt_reportDivision(p->report);
    const double kept = keepWork(p, 0.5);
    const MeBool isTaken = takePart(p, scratch, 0.5 * part, halvings + 1);
    p->work += kept;
    return isTaken && takePart(p, scratch, 0.5 * part, halvings + 1);
}

/* Was the part solved, or so nearly that what is wrong with velocities takes nothing farther than 1e-7 of a step's fall, as
 * in parts that are short against rounding? */
static MeBool isFollowed(const Partition *p) {
    const MeReal *g = p->world->params.gravity;
    const double fall = sqrt((double)(g[0] * g[0] + g[1] * g[1] + g[2] * g[2])) * p->h * p->h;
    const double way = p->kea.report.residual * p->parameters.stepsize;
    const MeBool isNear = !p->kea.report.violent && way < 1e-7 * fall; /* violent: the motion itself was not found */
    return !p->kea.report.capped || (isNear && !p->kea.report.limited);
}

/* Up to the next event, at most for `rest`. False where that could not be followed. */
static MeBool solveToEvent(Partition *p, void *scratch, double rest, double least) {
    p->kea.parameters.timed = METRUE;
    solvePart(p, scratch, rest);
    if (!isFollowed(p))
        return MEFALSE;
    if (p->kea.report.event >= rest - least)
        return METRUE;
    if (p->report)
        mdt_reportEvent(p->report);
    solvePart(p, scratch, fmax(p->kea.report.event, least));
    return isFollowed(p);
}

/* The same, nearer by halves while the motion is violent. */
static MeBool solveToEventOrHalf(Partition *p, void *scratch, double rest, double least) {
    for (double ahead = rest; !solveToEvent(p, scratch, ahead, least); ahead *= 0.5)
        if (!p->kea.report.violent || ahead < 0.2 * rest)
            return MEFALSE;
    return METRUE;
}

/* A part of the step of a partition whose contacts are met in time: up to the next event, and on. When there are too many of
 * them, or they cannot be followed so exactly, the rest is taken as it is elsewhere. */
static MeBool takeInTime(Partition *p, void *scratch, double part) {
    enum { MAX_EVENTS = 8 };
    const double least = 1e-9 * part;
    double rest = part;
    for (int events = 0; rest > least; events++) {
        if (events == MAX_EVENTS || !solveToEventOrHalf(p, scratch, rest, least)) {
            p->kea.parameters.timed = MEFALSE;
            return takePart(p, scratch, rest, 0);
        }
        rest -= p->parameters.stepsize;
        if (!integratePart(p))
            return MEFALSE;
    }
    return METRUE;
}

/* Few bodies that only touch. */
static MeBool isTimed(const Partition *p) {
    if (p->numBodies > p->world->timedBodies || p->numConstraints == 0)
        return MEFALSE;
    for (int i = 0; i < p->numConstraints; i++)
        if (p->constraints[i]->type != MdtBclTypeOf(MdtBclCONTACT) &&
            p->constraints[i]->type != MdtBclTypeOf(MdtBclCONTACTGROUP))
            return MEFALSE;
    return METRUE;
}

static MeBool takeSubSteps(Partition *p, void *scratch) {
    const int n = p->world->subSteps;
    const MeBool timed = isTimed(p);
    for (int i = 0; i < n; i++) {
        const double kept = keepWork(p, 1. / (n - i));
        if (!(timed ? takeInTime(p, scratch, p->h / n) : takePart(p, scratch, p->h / n, 0)))
            return MEFALSE;
        p->work += kept;
    }
    return METRUE;
}

static void stepPartition(Partition *p) {
    Start *start = NULL;
    p->kea.maxRows = mostRows(p);
    p->kea.errors = positionErrors;
    p->kea.jacobians = jointJacobians;
    p->kea.cache = p->world->keaCache;
    p->kea.context = p;
    void *scratch = takeScratch(p, &start);
    if (!scratch)
        return;
    packBodies(p);
    rememberStart(p, start);
    beginConstraints(p);
    beginBudget(p);
    if (takeSubSteps(p, scratch))
        unpackBodies(p, start);
    MeChunkPutMem(&p->world->scratch, scratch);
}

/* How far a partition may move: the shortest safe time of its bodies, within bounds. */
static double safeStep(const Partition *p) {
    double safe = p->h;
    for (int i = 0; i < p->numBodies; i++)
        safe = fmin(safe, (double)p->bodies[i]->safeTime);
    return fmin(p->h, fmax(safe, (double)p->world->minSafeTime));
}

/* What a program's callback sees: the partitions up to this one. */
static void showPartition(MdtWorldID w, int number) {
    MdtPartitionOutput *po = &w->output;
    po->info[number] = mdt_partitionInfo(w, number);
    po->numPartitions = number + 1;
    w->partitionCb(po, w->partitionCbData);
}

static MeBool isToRest(MdtWorldID w, const Partition *p) {
    if (w->partitionCb)
        return w->output.info[p->number].isDisabled;
    return w->rest.autoDisable && isAtRest(p);
}

/* The partition is moved on by p->h, of what it lacks. */
static void setLag(const Partition *p, double lack) {
    MEASSERT(lack >= p->h);
    for (int i = 0; i < p->numBodies; i++) {
        p->bodies[i]->lag = lack - p->h;
        p->bodies[i]->part = p->h;
    }
}

static void stepPartitions(MdtWorldID w, double h, MeBool safely) {
    for (int i = 0; i < w->numPartitions; i++) {
        Partition p = partitionNumber(w, i, h);
        if (safely)
            p.h = safeStep(&p);
        if (w->partitionCb)
            showPartition(w, i);
        p.report = w->isReported ? mdt_reportOf(w, i) : NULL;
        setLag(&p, h);
        if (isToRest(w, &p))
            putToSleep(&p);
        else
            stepPartition(&p);
        if (p.report)
            mdt_reportEnd(w, p.report, i);
    }
    if (w->isReported)
        mdt_reportStepEnd(w);
}

static void stepWorld(MdtWorldID w, double h, MeBool safely) {
    MeProfileStartSection("Dynamics", 0);
    MeProfileStartSection("Partition", 0);
    w->lastStep = h;
    for (int i = 0; i < w->sizeLogLength; i++)
        w->sizeLog[i] = 0;
    mdt_breakBegin(w);
    mdt_partitionsUpdate(w);
    if (w->isReported)
        mdt_reportStep(w);
    MeProfileEndSection("Partition");
    stepPartitions(w, h, safely);
    MeProfileEndSection("Dynamics");
    if (w->debugDraw)
        mdt_debugDraw(w);
    mdt_breakEnd(w);
}

void MEAPI MdtWorldStep(const MdtWorldID w, const MeReal stepSize) {
    MDT_NEED_WORLD(w, );
    if (mdt_isPositive(__func__, "the step size", stepSize))
        stepWorld(w, (double)stepSize, MEFALSE);
}

void MEAPI MdtWorldStepSafeTime(const MdtWorldID w, const MeReal stepSize) {
    MDT_NEED_WORLD(w, );
    if (mdt_isPositive(__func__, "the step size", stepSize))
        stepWorld(w, (double)stepSize, METRUE);
}

/* ---- the rest of a step ---- */

/* What all bodies of the partition lack, but for those that have just been woken; 0: one of them lacks nothing. */
static double lagOf(const Partition *p) {
    double least = INFINITY;
    for (int i = 0; i < p->numBodies; i++)
        if (p->bodies[i]->enabledSteps > 0)
            least = fmin(least, p->bodies[i]->lag);
    return least < INFINITY ? least : 0;
}

/* Is the part too short to be taken? A velocity that is found from positions has their rounding over the part: 2^-53 of 1 km in
 * 2^-14 of 1/60 s is 1e-7 m/s. A body that passes its own size in a hundredth of the step moves by less than 1 % of it. */
static MeBool isTooShort(const Partition *p) {
    enum { PARTS = 1 << 14 };
    return !(p->h * PARTS > p->whole);
}

static MeBool stepRest(MdtWorldID w, int number) {
    Partition p = partitionNumber(w, number, 0);
    const double lag = lagOf(&p);
    p.h = lag;
    for (int i = 0; i < p.numBodies; i++)
        p.h = fmin(p.h, (double)p.bodies[i]->safeTime);
    if (isTooShort(&p))
        return MEFALSE;
    for (int i = 0; i < p.numBodies; i++)
        mdt_bodyKeepForces(p.bodies[i]);
    stepPartition(&p);
    setLag(&p, lag);
    return METRUE;
}

int MEAPI MdtWorldStepRest(const MdtWorldID w) {
    MDT_NEED_WORLD(w, 0);
    int moved = 0;
    mdt_partitionsUpdate(w);
    for (int i = 0; i < w->numPartitions; i++)
        moved += stepRest(w, i);
    mdt_breakEnd(w);
    return moved;
}

int MEAPI MdtWorldGetLaggingBodies(const MdtWorldID w) {
    MDT_NEED_WORLD(w, 0);
    int count = 0;
    for (MdtLink *link = w->bodies.first; link; link = link->next)
        count += ((MdtBodyID)link->owner)->lag > 0;
    return count;
}
