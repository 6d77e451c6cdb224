/* One step of one partition.
 *
 *     begin: what rows can act, how implicit each body is, the last step's answer as a guess
 *     passes: move by u; rows at the mean of the poses; the inner problem for what u lacks; until nothing lacks
 *     velocity stage: what joints and contacts allow where the bodies have arrived
 *
 * A pass is at once a Newton iteration for the geometry, a proximal step for rigid rows, and a renewal of the friction
 * bounds. Where the last answer still holds, no pass is needed and nothing is factored.
 */
#include "kea_i.h"
#include <string.h>

enum { HALVE = 6, FREEZE = 12, GIVE_UP = 60, AFTER = 4 };
static const double positionTolerance = 1e-10;              /* of a row's size */
static const double velocityTolerance = 1e-9;               /* of the partition's speed */
static const double momentumTolerance = 1e2;                /* of what the inner problem tolerates */
static const double looseMotion = 1e4, looseVelocity = 1e5; /* times these: good enough when passes have run out */

typedef struct Errors {
    double position, velocity, momentum, worst; /* in tolerances */
    double impulse;                             /* N s, that the velocity would take */
} Errors;

/* m/s: what velocities are compared with: those of the bodies, and what loads, springs and motors do to them. */
static double speedOf(const MdtKeaSystem *s) {
    double speed = 0;
    for (int i = 0; i < s->numBodies; i++) {
        const KeaBody *b = &s->work->body[i];
        double change[3];
        keaSubtract(change, b->freeVelocity, s->bodies[i]->velocity);
        speed = keaMax(speed, keaLength(change) + 0.1 * keaLength(b->freeVelocity) +
                                  0.1 * b->size * keaLength(s->predicted[i].ang));
    }
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact < 0 && !s->rows[i].position)
            speed = keaMax(speed, s->work->problem.row[i].size * fabs(s->work->problem.row[i].p));
    return speed + 1e-300;
}

static void linearize(MdtKeaSystem *s) {
    kea_moveBodies(s);
    kea_refreshRows(s, s->work->meanPose, METRUE);
    if (s->errors)
        s->errors(s->context, s->work->endPose, s->work->errors);
    kea_linearizeBodies(s);
    kea_linearizeRows(s);
}

static Errors errorsOf(MdtKeaSystem *s, double speed) {
    Errors e;
    e.position = kea_positionError(s) / positionTolerance;
    e.velocity = kea_problemResidual(&s->work->problem, &e.impulse) / (velocityTolerance * speed);
    e.momentum = kea_problemError(&s->work->problem) / momentumTolerance;
    e.worst = keaMax(e.position, keaMax(e.momentum, e.velocity));
    return e;
}

static void takePass(MdtKeaSystem *s) {
    const KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numBodies; i++)
        for (int k = 0; k < 6; k++)
            s->work->body[i].u[k] += q->d[i][k];
}

/* A program that caps iterations is in a hurry. */
static int lastRenewal(const MdtKeaSystem *s) {
    return s->parameters.maxIterations > 0 ? FREEZE : GIVE_UP;
}

/* Friction bounds follow the normal forces, later on more carefully; should that not settle, they are left where they are once the answer is good
 * enough, or in the end. */
static void solvePass(MdtKeaSystem *s, int pass, MeBool isGoodEnough) {
    KeaProblem *q = &s->work->problem;
    if (kea_dualSolve(s))
        return;
    const MeBool isFrozen = q->counts.stuck > 0 && pass >= (isGoodEnough ? FREEZE : lastRenewal(s));
    if (!isFrozen && pass > 0)
        kea_problemApproachRadii(q, pass < HALVE ? 1 : 0.5, pass > HALVE);
    q->counts.freezes += isFrozen;
    q->counts.stuck = !kea_problemSolve(q, !isFrozen) || isFrozen;
    q->counts.level += !q->counts.stuck || isFrozen;
}

static void keepBest(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        memcpy(s->work->bestU[i], s->work->body[i].u, sizeof s->work->bestU[i]);
    for (int i = 0; i < s->numRows; i++)
        s->work->bestP[i] = s->work->problem.row[i].p;
}

static void takeBest(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        memcpy(s->work->body[i].u, s->work->bestU[i], sizeof s->work->bestU[i]);
    for (int i = 0; i < s->numRows; i++)
        s->work->problem.row[i].p = s->work->bestP[i];
    linearize(s);
}

/* Whether it matters how a body is turned: not for a ball whose contacts all push towards its centre. */
static MeBool feelsItsTurn(const MdtKeaSystem *s, int body) {
    const double rounding = 1e-5; /* of what single precision says of contacts */
    if (!s->work->body[body].isSpatial)
        return METRUE;
    for (int i = 0; i < s->numRows; i++)
        for (int k = 0; k < 2; k++) {
            const int normal = s->rows[i].contact;
            if (s->rows[i].body[k] == body &&
                (normal < 0 || keaLength(s->rows[normal].J[k].ang) > rounding * s->work->body[body].size))
                return METRUE;
        }
    return MEFALSE;
}

/* The Cayley map turns a body by less than half a turn, however fast it is: near that, the velocity means nothing. */
static MeBool turnsOver(const MdtKeaSystem *s) {
    const double most = 2.5; /* rad as the velocity has it, 1.8 as the body turns */
    for (int i = 0; i < s->numBodies; i++)
        if (s->parameters.stepsize * keaLength(s->work->body[i].u + 3) > most && feelsItsTurn(s, i))
            return METRUE;
    return MEFALSE;
}

static void takePasses(MdtKeaSystem *s) {
    const int last = lastRenewal(s) + AFTER;
    double speed = 0, best = HUGE_VAL;
    Errors e = {.worst = HUGE_VAL};
    for (int pass = 0;; pass++) {
        linearize(s);
        speed = keaMax(speed, speedOf(s));
        e = errorsOf(s, speed);
        if (e.worst < best) {
            best = e.worst;
            keepBest(s);
        }
        if (e.worst < 1 || pass == last)
            break;
        solvePass(s, pass, e.velocity < looseVelocity);
        kea_noteStubborn(s, positionTolerance);
        takePass(s);
        kea_admitContacts(s);
        s->report.passes++;
    }
    if (!(e.worst <= best)) {
        takeBest(s);
        e = errorsOf(s, speed);
    }
    s->report.conflicting = kea_isConflicting(s, positionTolerance);
    s->report.violent = e.position > looseMotion || e.momentum > looseMotion || turnsOver(s);
    s->report.capped = s->report.violent || e.velocity > looseVelocity;
    s->report.residual = e.velocity * velocityTolerance * speed;
    s->report.force = e.impulse / s->parameters.stepsize;
}

static void setFree(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        s->work->body[i].isFree = METRUE;
    for (int i = 0; i < s->numRows; i++) {
        if (s->work->problem.row[i].isOff || (s->rows[i].contact >= 0 && s->work->problem.row[i].p == 0))
            continue;
        for (int k = 0; k < 2; k++)
            if (s->rows[i].body[k] >= 0)
                s->work->body[s->rows[i].body[k]].isFree = MEFALSE;
    }
}

static void returnForces(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].force = s->work->problem.row[i].p / s->parameters.stepsize;
}

/* Passes from the last answer. */
static void solveMotion(MdtKeaSystem *s) {
    kea_beginRows(s);
    kea_guessMotion(s);
    takePasses(s);
    kea_balanceMomentum(s);
}

/* A stop needs a second solve, in which what stops slides on; should it not stop within the step after all, the first
 * solution was right. */
static void solveInTime(MdtKeaSystem *s) {
    const double h = s->parameters.stepsize, late = 1e-6;
    MeBool mustRepeat, isNew;
    double event = kea_firstEvent(s, &mustRepeat);
    if (mustRepeat) {
        solveMotion(s);
        event = kea_firstEvent(s, &isNew);
        if (event > h * (1 + late)) {
            kea_releaseSlides(s);
            solveMotion(s);
        }
    }
    s->report.event = keaMin(event, h);
}

/* The midpoint rule follows a body whose moments differ only as long as it does not turn far in a step: a fast top would
 * precess wrongly. Bodies with contacts are left alone: what they lose is friction's. */
static MeBool turnsTooFar(const MdtKeaSystem *s) {
    const double far = 0.1; /* rad, times the moments' relative difference */
    for (int i = 0; i < s->numBodies; i++) {
        const double *I = s->bodies[i]->moments;
        const double most = keaMax(I[0], keaMax(I[1], I[2])), least = keaMin(I[0], keaMin(I[1], I[2]));
        const KeaBody *b = &s->work->body[i];
        if (b->theta < 1 && !b->isSpatial &&
            s->parameters.stepsize * keaLength(s->velocity[i].ang) * (most - least) > far * most)
            return METRUE;
    }
    return MEFALSE;
}

void MEAPI MdtKeaSolve(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    memset(&s->report, 0, sizeof s->report);
    s->report.event = s->parameters.stepsize;
    q->numBodies = s->numBodies;
    q->numRows = s->numRows;
    q->maxIterations = s->parameters.maxIterations;
    kea_beginBodies(s);
    if (s->parameters.timed)
        kea_timedBegin(s);
    kea_beginRows(s);
    if (s->parameters.mayRefuse && s->numRows > 0 && turnsTooFar(s)) {
        s->report.violent = METRUE;
        return;
    }
    s->report.capped = s->numRows > 0; /* until they are solved: there may be no memory */
    if (s->numRows > 0 && kea_problemBegin(q, s->cache)) {
        s->work->hasLoops = kea_hasLoops(s);
        kea_dualBegin(s);
        solveMotion(s);
        if (s->parameters.timed)
            solveInTime(s);
        setFree(s);
        if (!s->parameters.timed)
            kea_velocityStage(s);
        kea_shareForces(s);
        returnForces(s);
        s->report.iterations = q->counts.iterations;
        s->report.factorizations = q->counts.factorizations;
        s->report.freezes = q->counts.freezes;
    }
    kea_moveFreely(s);
    if (s->parameters.timed && s->numRows > 0)
        kea_project(s);
}
