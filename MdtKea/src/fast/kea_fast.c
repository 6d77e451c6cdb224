/* The fast solver: one step of many touching bodies, in time proportional to the number of manifolds.
 *
 *     velocities   block Gauss-Seidel over the manifolds, eight at a time, region by region (kea_regions_i.h), with
 *                  Nesterov's extrapolation of the impulses within the step and its restart (O'Donoghue and Candès
 *                  2015, "Adaptive restart for accelerated gradient schemes"): gaps may close, but not become overlaps
 *     displacement by the mean of the velocities at the start and the end; by the latter if the mean would press a
 *                  contact deeper
 *     positions    passes without friction over displacements, which reduce overlaps without changing velocities (split
 *                  impulses)
 *     rebounds     passes over velocities once more, with restitution at pushing points, after bodies were moved
 *
 * Velocities are linear in the impulses: the velocities of extrapolated impulses are the extrapolated velocities.
 * Passes work in single precision; the momenta at the end are summed in double from the impulses, which are equal and
 * opposite for both bodies.
 */
#include "fast/kea_joints_i.h"
#include "fast/kea_regions_i.h"
#include "inner/kea_factor_i.h"
#include "common/kea_machine_i.h"
#include "common/kea_policy_i.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include <string.h>

/* The state of a step; its arrays are in the cache's scratch memory. */
typedef struct Step {
    MdtKeaSystem *s;
    const KeaKernel *kernel;
    KeaRegions regions;
    KeaMotion *motion, *before,
        *displacement;   /* index 0: the world; 1 + place: bodies; then one for each manifold, for moving worlds */
    KeaPatch *patch;     /* by manifold */
    KeaMotion *move;     /* the velocities that bodies are moved by, (1 - θ) v + θ v⁺ */
    float *thetas;       /* by motion: θ, 1/2 or, if that would press a contact, 1 */
    float *speedChange;  /* by motion: m/s, change of velocity in the step (findSpeedChangesOf) */
    double (*change)[6]; /* by place: N s, N m s, change of momentum by impulses */
    double (*turned)[4]; /* by place: the orientation at the end, without `displacement` */
    KeaGroup *groups;
    KeaLocks *locks; /* by group; null: no body has locked axes */
    int numGroups;
    KeaJoints joints;
    double fall[3];     /* m, correction of all positions (setFall) */
    double mean[3];     /* m/s, the bodies' mean velocity */
    double speed;       /* m/s, root mean square of the bodies' speeds relative to the mean velocity (findSpeed) */
    MeBool isMoving;    /* most bodies are fast (findSpeed) */
    double loadSpeed;   /* m/s, largest change of a body's velocity by loads in the step */
    double theta, beta; /* of Nesterov's extrapolation */
    double maxTheta;    /* upper limit of theta */
} Step;

typedef struct Passes {
    int min, max;
} Passes;

/* Residuals after passes, over all lanes (KeaMeasure). In tolerances: excess, the largest of all; meanExcess, the root
 * mean square of contacts; ofJoints, the largest of joints. */
typedef struct Residual {
    double max, excess, meanExcess, ofJoints, squares, closing;
} Residual;

static const KeaKernel *kernelOfMachine(void) {
#ifdef KEA_HAS_AVX2
    if (kea_machineHasAvx2())
        return &kea_kernelAvx2;
#endif
    return &kea_kernel;
}

static size_t layOutStep(Step *p, char *memory) {
    const size_t n = (size_t)p->s->numBodies, m = (size_t)p->s->numManifolds, motions = 1 + n + m;
    KeaArena arena = {memory, 0};
    KEA_CARVE(&arena, p->motion, motions);
    KEA_CARVE(&arena, p->before, motions);
    KEA_CARVE(&arena, p->displacement, motions);
    KEA_CARVE(&arena, p->move, motions);
    KEA_CARVE(&arena, p->thetas, motions);
    KEA_CARVE(&arena, p->speedChange, motions);
    KEA_CARVE(&arena, p->patch, m);
    KEA_CARVE(&arena, p->change, n);
    KEA_CARVE(&arena, p->turned, n);
    kea_regionsLayOut(&p->regions, &arena);
    return arena.used;
}

/* ---- begin ---- */

static void setMotionsOf(void *context, KeaNode *node) {
    const Step *p = context;
    for (int i = node->firstPlace; i < node->firstPlace + node->numPlaces; i++) {
        const MdtKeaVelocity *v = &p->s->predicted[p->regions.body[i]];
        KeaMotion *m = &p->motion[1 + i];
        for (int k = 0; k < 3; k++) {
            m->lin[k] = (float)v->lin[k];
            m->ang[k] = (float)v->ang[k];
        }
        m->lin[3] = m->ang[3] = 0;
    }
}

static void setMotions(Step *p) {
    memset(p->motion, 0, sizeof *p->motion);
    memset(p->speedChange, 0, (size_t)(1 + p->s->numBodies + p->s->numManifolds) * sizeof *p->speedChange);
    kea_visitRegions(&p->regions, setMotionsOf, p);
}

static KeaGathering gathering(const Step *p) {
    return (KeaGathering){p->s, p->regions.place, p->patch, p->motion, p->displacement};
}

static void fillGroups(void *context, KeaNode *node) {
    const Step *p = context;
    const KeaGathering from = gathering(p);
    KeaGroup *groups = p->groups + node->firstGroup;
    kea_groupManifolds(&p->regions, node, p->groups);
    for (int i = 0; i < node->numGroups; i++)
        groups[i].locks = p->locks ? &p->locks[node->firstGroup + i] : NULL;
    kea_fillGroups(&from, groups, node->numGroups);
    p->kernel->prepare(groups, node->numGroups, (float)p->s->parameters.stepsize);
}

static MeBool allocateGroups(Step *p) {
    p->numGroups = kea_colourManifolds(&p->regions);
    MEASSERT(p->numGroups <= p->s->numManifolds);
    const size_t each = sizeof *p->groups + (p->s->work->hasLocks ? sizeof *p->locks : 0);
    p->groups = kea_cacheScratch(p->s->cache, KEA_GROUP_BLOCK, (size_t)p->numGroups * each);
    if (!p->groups)
        return MEFALSE;
    p->locks = p->s->work->hasLocks ? (KeaLocks *)(void *)(p->groups + p->numGroups) : NULL;
    memset(p->locks ? (void *)p->locks : p->groups, 0, p->locks ? (size_t)p->numGroups * sizeof *p->locks : 0);
    kea_visitNodes(&p->regions, fillGroups, p);
    return METRUE;
}

static MeBool beginStep(Step *p) {
    MdtKeaSystem *s = p->s;
    char *memory = kea_cacheScratch(s->cache, KEA_STEP_BLOCK, layOutStep(p, NULL));
    if (!memory)
        return MEFALSE;
    layOutStep(p, memory);
    kea_regionsDivide(&p->regions);
    if (!kea_jointsBegin(s, p->regions.place, &p->joints))
        return MEFALSE;
    setMotions(p);
    return allocateGroups(p);
}

static void applyGroups(void *context, KeaNode *node) {
    const Step *p = context;
    p->kernel->apply(p->groups + node->firstGroup, node->numGroups, p->motion);
}

/* Copies the velocities of a region's bodies to p->before. */
static void saveMotions(void *context, KeaNode *node) {
    const Step *p = context;
    memcpy(p->before + 1 + node->firstPlace, p->motion + 1 + node->firstPlace,
           (size_t)node->numPlaces * sizeof *p->motion);
}

/* Adds the changes of velocity by all impulses to the motions. */
static void applyImpulses(Step *p) {
    kea_visitNodesByDepth(&p->regions, applyGroups, p);
    kea_jointsApplyImpulses(p->s, &p->joints, p->motion);
}

/* ---- sums ---- */

/* The sum over the regions of node->sum[k], a result of the last loop over bodies. */
static double sumOverRegions(const KeaRegions *r, int k) {
    double sum = 0;
    for (int n = r->count; n < 2 * r->count; n++)
        sum += r->node[n].sum[k];
    return sum;
}

static double maxOverRegions(const KeaRegions *r, int k) {
    double max = 0;
    for (int n = r->count; n < 2 * r->count; n++)
        max = keaMax(max, r->node[n].sum[k]);
    return max;
}

/* ---- passes ---- */

/* The sum over all nodes of node->lanes, a result of the last loop over groups. */
static double sumOverNodes(const KeaRegions *r) {
    double sum = 0;
    for (int n = 1; n < 2 * r->count; n++)
        for (int i = 0; i < KEA_LANES; i++)
            sum += (double)r->node[n].lanes[i];
    return sum;
}

/* Whether node->sum[0] is not 0 in any node. */
static MeBool isAnyOverNodes(const KeaRegions *r) {
    for (int n = 1; n < 2 * r->count; n++)
        if (r->node[n].sum[0] != 0)
            return METRUE;
    return MEFALSE;
}

static Residual residualOverNodes(const KeaRegions *r) {
    Residual all = {0};
    for (int n = 1; n < 2 * r->count; n++)
        for (int i = 0; i < KEA_LANES; i++) {
            const KeaMeasure *m = &r->node[n].measure;
            all.max = keaMax(all.max, (double)m->max[i]);
            all.excess = keaMax(all.excess, (double)m->excess[i]);
            all.squares += (double)m->squares[i];
            all.meanExcess += (double)m->excessSquares[i];
            all.closing = keaMax(all.closing, (double)m->closing[i]);
        }
    return all;
}

static void restartExtrapolation(Step *p) {
    p->theta = 1;
    p->beta = 0;
}

/* Restarts the extrapolation with a limit on theta. Coulomb friction has no potential that passes lower, and
 * extrapolation may amplify its residual from pass to pass in few contacts of many, which does not show in the
 * criterion of restarts. */
static void limitExtrapolation(Step *p) {
    restartExtrapolation(p);
    p->maxTheta = kea_limitedTheta;
}

/* One pass over a node: extrapolates its bodies, then visits its manifolds. Regions come before the cuts between them,
 * so that both bodies of a manifold have been extrapolated. */
static void passNode(void *context, KeaNode *node) {
    const Step *p = context;
    const float beta = (float)p->beta;
    memset(node->lanes, 0, sizeof node->lanes);
    p->kernel->extrapolate(p->motion + 1 + node->firstPlace, p->before + 1 + node->firstPlace, node->numPlaces, beta);
    p->kernel->pass(p->groups + node->firstGroup, node->numGroups, p->motion, beta, node->lanes);
}

/* Sets the change of each body's velocity in the step, m/s; that of rotation counts at the radius of gyration. */
static void findSpeedChangesOf(void *context, KeaNode *node) {
    const Step *p = context;
    for (int i = node->firstPlace; i < node->firstPlace + node->numPlaces; i++) {
        const int body = p->regions.body[i];
        const MdtKeaVelocity *v = &p->s->velocity[body];
        double change[2][3];
        for (int k = 0; k < 3; k++) {
            change[0][k] = (double)p->motion[1 + i].lin[k] - v->lin[k];
            change[1][k] = (double)p->motion[1 + i].ang[k] - v->ang[k];
        }
        p->speedChange[1 + i] = (float)(keaLength(change[0]) + p->s->work->body[body].size * keaLength(change[1]));
    }
}

static KeaTolerance toleranceOf(const Step *p) {
    return (KeaTolerance){.change = p->speedChange,
                          .accuracy = (float)p->s->parameters.accuracy,
                          .loadSpeed = (float)p->loadSpeed,
                          .stepsize = (float)p->s->parameters.stepsize};
}

/* Measures the residuals of a node's groups. */
static void measureGroups(void *context, KeaNode *node) {
    const Step *p = context;
    const KeaTolerance allowed = toleranceOf(p);
    memset(&node->measure, 0, sizeof node->measure);
    p->kernel->measure(p->groups + node->firstGroup, node->numGroups, p->motion, &allowed, &node->measure);
}

/* Makes passes with Nesterov's extrapolation. It is restarted after a pass that changes impulses in the opposite
 * direction. */
static void iteratePasses(Step *p, int passes) {
    for (int i = 0; i < passes; i++) {
        kea_visitNodesByDepth(&p->regions, passNode, p);
        const double ofJoints = kea_jointsSolveVelocities(p->s, &p->joints, p->motion, (double)(float)p->beta);
        const double next = 0.5 * (1 + sqrt(1 + 4 * p->theta * p->theta));
        MEASSERT(p->theta >= 1 && p->maxTheta >= 1);
        p->beta = (p->theta - 1) / next;
        p->theta = keaMin(next, p->maxTheta);
        if (sumOverNodes(&p->regions) + ofJoints > 0)
            restartExtrapolation(p);
    }
    p->s->report.iterations += passes;
}

/* Measures the residuals of contacts and joints. Writes the largest to the report. */
static Residual measureAll(Step *p) {
    const KeaTolerance allowed = toleranceOf(p);
    kea_visitRegions(&p->regions, findSpeedChangesOf, p);
    kea_visitNodes(&p->regions, measureGroups, p);
    Residual r = residualOverNodes(&p->regions);
    r.meanExcess = p->s->numManifolds > 0 ? sqrt(r.meanExcess / p->s->numManifolds) : 0;
    r.max = keaMax(kea_jointsResidual(&p->joints, p->motion, &allowed, &r.ofJoints), r.max);
    r.excess = keaMax(r.excess, r.ofJoints);
    p->s->report.residual = r.max;
    p->s->report.excess = r.excess;
    return r;
}

/* m/s: the change of a body's velocity by its loads in the step. */
static double loadSpeedOf(const MdtKeaSystem *s, int body) {
    double load[3];
    keaSubtract(load, s->predicted[body].lin, s->velocity[body].lin);
    return keaLength(load);
}

/* Sums up v² and v of the bodies of a region: sum[0], and sum[1] to sum[3]. */
static void sumSpeeds(void *context, KeaNode *node) {
    const Step *p = context;
    memset(node->sum, 0, sizeof node->sum);
    for (int i = node->firstPlace; i < node->firstPlace + node->numPlaces; i++) {
        const double *v = p->s->velocity[p->regions.body[i]].lin;
        node->sum[0] += keaDot(v, v);
        keaAddScaled(node->sum + 1, 1, v);
    }
}

/* Counts bodies that are faster than their loads make them in a step. Both their speed and their speed relative to the
 * mean velocity must be: otherwise a pile would count as moving when few flying bodies have hit it (which changes the
 * mean), or when it is on a train. */
static void countFastBodies(void *context, KeaNode *node) {
    const Step *p = context;
    node->sum[0] = 0;
    for (int i = node->firstPlace; i < node->firstPlace + node->numPlaces; i++) {
        const int body = p->regions.body[i];
        const double *v = p->s->velocity[body].lin;
        double relative[3];
        keaSubtract(relative, v, p->mean);
        node->sum[0] += keaMin(keaLength(v), keaLength(relative)) > loadSpeedOf(p->s, body);
    }
}

/* Sets the mean velocity, the speed relative to it, and isMoving: most bodies are fast. */
static void findSpeed(Step *p) {
    const double n = p->s->numBodies;
    kea_visitRegions(&p->regions, sumSpeeds, p);
    double spread = sumOverRegions(&p->regions, 0) / n;
    for (int k = 0; k < 3; k++) {
        p->mean[k] = sumOverRegions(&p->regions, 1 + k) / n;
        spread -= p->mean[k] * p->mean[k];
    }
    p->speed = sqrt(keaMax(spread, 0));
    kea_visitRegions(&p->regions, countFastBodies, p);
    p->isMoving = sumOverRegions(&p->regions, 0) > 0.5 * n;
}

/* Whether the residual is small enough in the mean: large residuals of few contacts do not justify passes over all of
 * them. While bodies move, the next step reduces the residual further, except that of deep overlaps that grow. */
static MeBool isResidualSmall(const Step *p, const Residual *r) {
    return (r->meanExcess <= kea_passedExcess && r->ofJoints <= 1) ||
           (p->isMoving && r->closing <= kea_impactAccuracy * p->speed);
}

/* Multiplications of one pass over velocities; of all passes over displacements and preparation together. */
static double workOfPass(const Step *p) {
    return (double)p->numGroups * KEA_LANES * KEA_MANIFOLD_VISIT + kea_jointsWorkOfPass(&p->joints);
}
static double workOutsidePasses(const Step *p) {
    return KEA_POSITION_PASSES * workOfPass(p) + (double)p->s->numManifolds * KEA_MANIFOLD_PREPARATION +
           kea_jointsWorkOfFactors(&p->joints);
}

/* Chooses the minimal and maximal number of passes, within the rest of the budget. */
static Passes choosePasses(Step *p) {
    const double max = p->s->parameters.maxWork;
    const int cap = p->s->parameters.maxIterations > 0 ? p->s->parameters.maxIterations : KEA_MAX_PASSES;
    const double paid =
        max > 0 ? (max - workOutsidePasses(p)) / workOfPass(p) - p->s->report.iterations : KEA_MAX_PASSES;
    const double affordable = keaMin(keaMax(paid, 1), cap);
    p->s->report.limited |= affordable < KEA_MIN_PASSES;
    p->s->report.capped |= p->s->report.limited;
    p->s->report.least = workOutsidePasses(p) + KEA_MIN_PASSES * workOfPass(p);
    MEASSERT(affordable >= 1);
    return (Passes){(int)keaMin(KEA_MIN_PASSES, affordable), (int)keaMin(KEA_MAX_PASSES, affordable)};
}

/* Makes the minimal number of passes, then more, up to the maximum, while the residual is too large. If additional
 * passes have increased the residual, and not because a deep overlap grows, which only many passes can stop, a last
 * round of KEA_MIN_PASSES with limited extrapolation follows. */
static void findVelocities(Step *p) {
    const Passes passes = choosePasses(p);
    restartExtrapolation(p);
    p->maxTheta = HUGE_VAL;
    iteratePasses(p, passes.min);
    Residual before, now = measureAll(p);
    for (int done = passes.min, end = passes.max; done < end && !isResidualSmall(p, &now);) {
        const int more = end - done < KEA_MORE_PASSES ? end - done : KEA_MORE_PASSES;
        iteratePasses(p, more);
        before = now;
        now = measureAll(p);
        done += more;
        if (now.squares > before.squares && now.closing == 0 && p->maxTheta == HUGE_VAL) {
            limitExtrapolation(p);
            end = done + KEA_MIN_PASSES < end ? done + KEA_MIN_PASSES : end;
        }
    }
}

/* ---- rebounds ---- */

/* Sets the target of pushing points to their rebound; sum[0] := 1 if there is one. */
static void setReboundsOf(void *context, KeaNode *node) {
    const Step *p = context;
    node->sum[0] = 0;
    for (int i = node->firstGroup; i < node->firstGroup + node->numGroups; i++)
        for (int k = 0; k < KEA_POINTS; k++)
            for (int lane = 0; lane < KEA_LANES; lane++) {
                KeaGroup *g = &p->groups[i];
                if (g->rebound[k][lane] > 0 && g->impulse[k][lane] > 0) {
                    g->bias[k][lane] = g->rebound[k][lane];
                    node->sum[0] = 1;
                }
            }
}

/* ---- end ---- */

static void addImpulses(void *context, KeaNode *node) {
    const Step *p = context;
    const KeaGathering from = gathering(p);
    for (int i = node->firstPlace; i < node->firstPlace + node->numPlaces; i++)
        memset(p->change[i], 0, sizeof p->change[i]);
    kea_addImpulses(&from, p->groups + node->firstGroup, node->numGroups, p->change);
}

/* Sets velocities and angular momenta at the end from the changes of momentum. */
static void setEndMomentaOfNode(void *context, KeaNode *node) {
    const Step *p = context;
    for (int i = node->firstPlace; i < node->firstPlace + node->numPlaces; i++) {
        const int body = p->regions.body[i];
        const KeaBody *b = &p->s->work->body[body];
        KeaEnd *end = &p->s->work->end[body];
        kea_dropLocked(b->locked, p->change[i]);
        keaCopy(end->velocity, p->s->predicted[body].lin);
        keaAddScaled(end->velocity, p->s->bodies[body]->invMass, p->change[i]);
        keaCopy(end->angularMomentum, b->freeMomentum);
        keaAddScaled(end->angularMomentum, 1, p->change[i] + 3);
    }
}

static void setEndMomenta(Step *p) {
    kea_visitNodesByDepth(&p->regions, addImpulses, p);
    kea_jointsAddImpulses(&p->joints, p->change);
    kea_visitRegions(&p->regions, setEndMomentaOfNode, p);
}

/* ---- contacts that move in the step ---- */

static void renewArmsOf(void *context, KeaNode *node) {
    const Step *p = context;
    const KeaGathering from = gathering(p);
    node->sum[0] = kea_renewArms(&from, p->groups + node->firstGroup, node->numGroups);
}

/* Sets the inertia of a region's bodies to that of their orientation at the end. */
static void turnInertiaOf(void *context, KeaNode *node) {
    const Step *p = context;
    for (int place = node->firstPlace; place < node->firstPlace + node->numPlaces; place++) {
        const int i = p->regions.body[place];
        const MdtKeaBody *body = p->s->bodies[i];
        double L[3], end[4];
        keaScale(L, 0.5, body->angularMomentum);
        keaAddScaled(L, 0.5, p->s->work->end[i].angularMomentum);
        kea_rotateFree(body, body->quaternion, L, p->s->parameters.stepsize, end);
        kea_orientInertia(p->s, i, end);
    }
}

static void prepareAgain(void *context, KeaNode *node) {
    const Step *p = context;
    const KeaGathering from = gathering(p);
    KeaGroup *groups = p->groups + node->firstGroup;
    kea_renewInertia(&from, groups, node->numGroups);
    p->kernel->prepare(groups, node->numGroups, (float)p->s->parameters.stepsize);
}

/* The largest node->sum[0] of all nodes. */
static double maxOverNodes(const KeaRegions *r) {
    double max = 0;
    for (int n = 1; n < 2 * r->count; n++)
        max = keaMax(max, r->node[n].sum[0]);
    return max;
}

/* Passes again with the lever arms of the motion that the last passes have found, until they do not change, and with
 * the inertia at the end, by which the angular velocity there follows from the momentum. False: they did not settle. */
static MeBool settleContacts(Step *p) {
    for (int round = 0; round < KEA_ARM_ROUNDS; round++) {
        kea_visitNodes(&p->regions, renewArmsOf, p);
        setEndMomenta(p);
        if (maxOverNodes(&p->regions) <= p->s->parameters.accuracy)
            return METRUE;
        kea_visitRegions(&p->regions, turnInertiaOf, p);
        kea_visitNodes(&p->regions, prepareAgain, p);
        setMotions(p);
        applyImpulses(p);
        kea_visitRegions(&p->regions, saveMotions, p);
        findVelocities(p);
    }
    return MEFALSE;
}

/* ---- energy guard ---- */

/* Computes the change of a region's kinetic energy by the impulses, J, and its kinetic energy with the loads only; both
 * with the inertia of the start's poses. */
static void sumEnergy(void *context, KeaNode *node) {
    const Step *p = context;
    const MdtKeaSystem *s = p->s;
    node->sum[0] = node->sum[1] = 0;
    for (int i = node->firstPlace; i < node->firstPlace + node->numPlaces; i++) {
        const int body = p->regions.body[i];
        const KeaBody *b = &s->work->body[body];
        const KeaEnd *end = &s->work->end[body];
        const double mass = 1 / s->bodies[body]->invMass;
        double w[3];
        keaApply(w, (const double(*)[3])s->invMass[body].inertia, end->angularMomentum);
        const double before = mass * keaDot(s->predicted[body].lin, s->predicted[body].lin) +
                              keaDot(s->predicted[body].ang, b->freeMomentum);
        node->sum[0] += 0.5 * (mass * keaDot(end->velocity, end->velocity) + keaDot(w, end->angularMomentum) - before);
        node->sum[1] += 0.5 * before;
    }
}

/* Computes the change of a region's kinetic energy in the step beyond the work of the loads along the mean motion, J,
 * and its kinetic energy with the loads only. */
static void sumEnergyGained(void *context, KeaNode *node) {
    const Step *p = context;
    const MdtKeaSystem *s = p->s;
    node->sum[0] = node->sum[1] = 0;
    for (int i = node->firstPlace; i < node->firstPlace + node->numPlaces; i++) {
        const int body = p->regions.body[i];
        const MdtKeaBody *b = s->bodies[body];
        const MdtKeaVelocity *start = &s->velocity[body];
        const KeaEnd *end = &s->work->end[body];
        const double half = 0.5 * s->parameters.stepsize, mass = 1 / b->invMass;
        double w[3], twist[3], path[3];
        keaApply(w, (const double(*)[3])s->invMass[body].inertia, end->angularMomentum);
        for (int k = 0; k < 3; k++) {
            path[k] = half * (start->lin[k] + end->velocity[k]);
            twist[k] = half * (start->ang[k] + w[k]);
        }
        node->sum[0] += 0.5 * (mass * keaDot(end->velocity, end->velocity) + keaDot(w, end->angularMomentum) -
                               mass * keaDot(start->lin, start->lin) - keaDot(start->ang, b->angularMomentum)) -
                        keaDot(b->force, path) - keaDot(b->torque, twist);
        node->sum[1] += 0.5 * (mass * keaDot(s->predicted[body].lin, s->predicted[body].lin) +
                               keaDot(s->predicted[body].ang, s->work->body[body].freeMomentum));
    }
}

static void sumWork(void *context, KeaNode *node) {
    const Step *p = context;
    const KeaGathering from = gathering(p);
    node->sum[0] = kea_workOfSurfaces(&from, p->groups + node->firstGroup, node->numGroups);
}

/* J: an upper bound of the energy that motors, springs, conveyor belts and moving worlds have added. By the laws of
 * contacts, and of rows J v⁺ = t - E p within bounds, the impulses p add p·J v⁺ - |Jᵀp|²/2 <= p·(t - E p). */
static double workOfDrives(Step *p) {
    double work = kea_jointsWorkOfDrives(&p->joints);
    kea_visitNodes(&p->regions, sumWork, p);
    for (int n = 1; n < 2 * p->regions.count; n++)
        work += p->regions.node[n].sum[0];
    return work;
}

/* Whether the answer has more energy than the drives explain, as `sum` has it. */
static MeBool isMoreThanDriven(Step *p, void (*sum)(void *, KeaNode *), double room) {
    kea_visitRegions(&p->regions, sum, p);
    const double gained = sumOverRegions(&p->regions, 0), all = sumOverRegions(&p->regions, 1);
    return gained > room * all && gained - workOfDrives(p) > room * all;
}

static MeBool isEnergyGained(Step *p) {
    return isMoreThanDriven(p, sumEnergy, kea_energyRoom);
}

/* Solves again from zero impulses, point by point and without extrapolation, so that each visit lowers the
 * objective. */
static void solveByDescent(Step *p) {
    kea_scaleImpulses(p->groups, p->numGroups, 0);
    kea_jointsScaleImpulses(&p->joints, 0);
    for (int i = 0; i < p->numGroups; i++)
        memset(&p->groups[i].isDirect, 0, sizeof p->groups[i].isDirect);
    setMotions(p);
    for (int i = choosePasses(p).max; i > 0; i--) {
        restartExtrapolation(p);
        iteratePasses(p, 1);
    }
    measureAll(p);
    setEndMomenta(p);
}

/* Scales all impulses P by the largest share s <= 1 that adds no more energy than s times the work of the drives; the
 * energy changes by s P·v + s² |P|²/2 (norm by M⁻¹). A pass over the joints follows, since scaling violates their rows;
 * it only removes energy. */
static void limitImpulses(Step *p) {
    const MdtKeaSystem *s = p->s;
    double linear = -workOfDrives(p), square = 0;
    for (int i = 0; i < s->numBodies; i++) {
        const double *change = p->change[p->regions.place[i]];
        double turned[3];
        keaApply(turned, (const double(*)[3])s->invMass[i].inertia, change + 3);
        linear += keaDot(change, s->predicted[i].lin) + keaDot(change + 3, s->predicted[i].ang);
        square += 0.5 * (s->invMass[i].mass * keaDot(change, change) + keaDot(change + 3, turned));
    }
    const double share = keaMin(keaMax(-linear / square, 0), 1);
    kea_scaleImpulses(p->groups, p->numGroups, (float)share);
    kea_jointsScaleImpulses(&p->joints, share);
    setMotions(p);
    applyImpulses(p);
    kea_jointsSolveVelocities(p->s, &p->joints, p->motion, 0);
    setEndMomenta(p);
}

/* Finds the largest component of a region's linear velocities, and the largest change of one since p->before. */
static void compareMotions(void *context, KeaNode *node) {
    const Step *p = context;
    node->sum[0] = node->sum[1] = 0;
    for (int i = node->firstPlace; i < node->firstPlace + node->numPlaces; i++)
        for (int k = 0; k < 3; k++) {
            const double now = (double)p->motion[1 + i].lin[k], before = (double)p->before[1 + i].lin[k];
            node->sum[0] = keaMax(node->sum[0], fabs(now - before));
            node->sum[1] = keaMax(node->sum[1], fabs(now));
        }
}

/* Recomputes the velocities, which passes accumulate in single precision, from the impulses, for the rest of the step.
 * False: they differ by more than ten rest speeds, since rounding of large intermediate impulses matters; in a pyramid
 * of 40 rows it is .1 to 1 of one. */
static MeBool doMotionsMatchImpulses(Step *p) {
    kea_visitRegions(&p->regions, saveMotions, p);
    setMotions(p);
    applyImpulses(p);
    kea_visitRegions(&p->regions, compareMotions, p);
    const double lost = maxOverRegions(&p->regions, 0), speed = maxOverRegions(&p->regions, 1);
    return lost <= 10 * p->s->parameters.restSpeed + kea_impactAccuracy * speed;
}

/* Solves again by descent if the answer has gained energy or is inaccurate, since masses or levers differ too much for
 * single precision; if it then still gains energy, by rounding, scales all impulses. */
static void guardEnergy(Step *p) {
    if (!isEnergyGained(p) && doMotionsMatchImpulses(p))
        return;
    solveByDescent(p);
    if (!isEnergyGained(p))
        return;
    limitImpulses(p);
    p->s->report.capped = METRUE;
}

/* ---- contacts that are followed ---- */

static void restoreInertiaOf(void *context, KeaNode *node) {
    const Step *p = context;
    for (int place = node->firstPlace; place < node->firstPlace + node->numPlaces; place++)
        kea_orientInertia(p->s, p->regions.body[place], p->s->bodies[p->regions.body[place]]->quaternion);
}

/* Lets contacts move with their bodies. Where they do not settle, or gain energy, they move as was predicted. False: no
 * memory. */
static MeBool followContacts(Step *p) {
    if (settleContacts(p) && !isMoreThanDriven(p, sumEnergyGained, kea_followedRoom))
        return METRUE;
    kea_visitRegions(&p->regions, restoreInertiaOf, p);
    setMotions(p);
    if (!allocateGroups(p))
        return MEFALSE;
    applyImpulses(p);
    kea_visitRegions(&p->regions, saveMotions, p);
    findVelocities(p);
    return METRUE;
}

/* ---- end poses ---- */

/* Sets p->move to the mean of the velocities at start and end, θ = 1/2. */
static void setMeansOf(void *context, KeaNode *node) {
    const Step *p = context;
    for (int place = node->firstPlace; place < node->firstPlace + node->numPlaces; place++) {
        const MdtKeaVelocity *v = &p->s->velocity[p->regions.body[place]];
        const KeaMotion *end = &p->motion[1 + place];
        KeaMotion *mean = &p->move[1 + place];
        *mean = *end;
        for (int k = 0; k < 3; k++) {
            mean->lin[k] = (float)(0.5 * (v->lin[k] + (double)end->lin[k]));
            mean->ang[k] = (float)(0.5 * (v->ang[k] + (double)end->ang[k]));
        }
        p->thetas[1 + place] = (float)0.5;
    }
}

/* Sets the velocities that bodies are moved by to the means, with θ = 1/2; those of moving worlds to their own. */
static void setMeans(Step *p) {
    const int n = p->s->numBodies, m = p->s->numManifolds;
    p->move[0] = p->motion[0];
    p->thetas[0] = 1;
    memcpy(p->move + 1 + n, p->motion + 1 + n, (size_t)m * sizeof *p->move);
    for (int i = 1 + n; i < 1 + n + m; i++)
        p->thetas[i] = 1;
    kea_visitRegions(&p->regions, setMeansOf, p);
}

static void choosePressedOf(void *context, KeaNode *node) {
    const Step *p = context;
    node->sum[0] = p->kernel->choosePressed(p->groups + node->firstGroup, node->numGroups, p->motion,
                                            (float)p->s->parameters.stepsize, p->move, p->thetas);
}

/* Chooses θ of the displacement. Bodies are moved by the mean of their velocities at the start and the end, which is of
 * second order; or, if that presses a contact deeper than the end velocities do (these are what contacts constrain), by
 * the end velocities. */
static void chooseThetas(Step *p) {
    setMeans(p);
    kea_jointsMoveByEnd(&p->joints, p->motion, p->move, p->thetas);
    for (int sweep = 0; sweep < KEA_PRESSED_SWEEPS; sweep++) {
        kea_visitNodesByDepth(&p->regions, choosePressedOf, p);
        if (!isAnyOverNodes(&p->regions))
            return;
    }
}

/* θ of a body's displacement. */
static double thetaOf(const Step *p, int body) {
    return (double)p->thetas[1 + p->regions.place[body]];
}

/* Sets `fall`, a displacement of all bodies of a partition without contact or joint to the world, so that its centre of
 * mass moves by the mean of its velocities at the start and the end, though some bodies are moved by θ = 1. */
static void setFall(Step *p) {
    const MdtKeaSystem *s = p->s;
    double mass = 0;
    keaZero(p->fall);
    if (s->work->hasLocks) /* the world holds the body */
        return;
    for (int i = 0; i < s->numManifolds; i++)
        if (s->manifolds[i].body[0] < 0 || s->manifolds[i].body[1] < 0)
            return;
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].body[0] < 0 || s->rows[i].body[1] < 0)
            return;
    for (int i = 0; i < s->numBodies; i++) {
        const double m = 1 / s->bodies[i]->invMass, missed = m * (thetaOf(p, i) - 0.5);
        keaAddScaled(p->fall, missed, s->velocity[i].lin);
        keaAddScaled(p->fall, -missed, s->work->end[i].velocity);
        mass += m;
    }
    MEASSERT(mass > 0);
    keaScale(p->fall, s->parameters.stepsize / mass, p->fall);
}

/* Prefetches the data of the body KEA_AHEAD places ahead: bodies with adjacent places are not adjacent in the
 * system. */
static void prefetchBody(const Step *p, const KeaNode *node, int place) {
    if (place + KEA_AHEAD >= node->firstPlace + node->numPlaces)
        return;
    const int i = p->regions.body[place + KEA_AHEAD];
    me_prefetch(p->s->bodies[i], sizeof *p->s->bodies[i]);
    me_prefetch(&p->s->work->end[i], sizeof *p->s->work->end);
}

/* Sets the orientations at the end: free rotation with the angular momentum (1 - θ) L + θ L⁺, by the chord
 * (kea_rotateByChord), as points of contact are moved. */
static void rotateFreely(void *context, KeaNode *node) {
    const Step *p = context;
    for (int place = node->firstPlace; place < node->firstPlace + node->numPlaces; place++) {
        const int i = p->regions.body[place];
        const MdtKeaBody *body = p->s->bodies[i];
        const double theta = (double)p->thetas[1 + place];
        double L[3];
        prefetchBody(p, node, place);
        keaScale(L, 1 - theta, body->angularMomentum);
        keaAddScaled(L, theta, p->s->work->end[i].angularMomentum);
        kea_rotateFree(body, body->quaternion, L, p->s->parameters.stepsize, p->turned[place]);
        kea_rotateByChord(body->quaternion, p->turned[place]);
    }
}

/* Sets the end pose of a body: it is moved by its velocities, then by the displacement of position passes. */
static void setEndPose(const Step *p, int place) {
    MdtKeaSystem *s = p->s;
    const int i = p->regions.body[place];
    const double h = s->parameters.stepsize;
    const KeaMotion *displacement = &p->displacement[1 + place];
    KeaEnd *end = &s->work->end[i];
    const double out[3] = {(double)displacement->ang[0], (double)displacement->ang[1], (double)displacement->ang[2]};
    double turn[4];
    end->theta = (double)p->thetas[1 + place];
    MEASSERT(end->theta == 0.5 || end->theta == 1);
    keaCopy(end->position, s->bodies[i]->position);
    keaAddScaled(end->position, (1 - end->theta) * h, s->bodies[i]->velocity);
    keaAddScaled(end->position, end->theta * h, end->velocity);
    keaAddScaled(end->position, 1, p->fall);
    for (int k = 0; k < 3; k++)
        end->position[k] += (double)displacement->lin[k];
    keaQuaternionExp(turn, out);
    keaQuaternionProduct(end->quaternion, turn, p->turned[place]);
    keaQuaternionNormalize(end->quaternion);
    keaCopy(s->work->endPose[i].pos, end->position);
    keaQuaternionToMatrix(s->work->endPose[i].R, end->quaternion);
}

static void setEndPosesOf(void *context, KeaNode *node) {
    for (int place = node->firstPlace; place < node->firstPlace + node->numPlaces; place++) {
        prefetchBody(context, node, place);
        setEndPose(context, place);
    }
}

static void setEndPoses(Step *p) {
    kea_visitRegions(&p->regions, setEndPosesOf, p);
}

/* Advances the gaps of a node to the end of the step, and clears displacements. */
static void advanceNode(void *context, KeaNode *node) {
    const Step *p = context;
    memset(p->displacement + 1 + node->firstPlace, 0, (size_t)node->numPlaces * sizeof *p->displacement);
    p->kernel->advance(p->groups + node->firstGroup, node->numGroups, p->move, (float)p->s->parameters.stepsize);
}

static void pushNode(void *context, KeaNode *node) {
    const Step *p = context;
    node->sum[0] = p->kernel->push(p->groups + node->firstGroup, node->numGroups, p->displacement);
}

/* Makes the passes over displacements of some rounds: over contacts, and over joints while these are open. Returns
 * whether contacts have opened joints. */
static MeBool runPositionPasses(Step *p, int roundCount, double jointError) {
    MeBool isPushed = MEFALSE;
    for (int i = 0; i < roundCount * (KEA_POSITION_PASSES / KEA_JOINT_ROUNDS); i++) {
        kea_visitNodesByDepth(&p->regions, pushNode, p);
        const MeBool isMoved = isAnyOverNodes(&p->regions); /* so far that joints open */
        if (isMoved || jointError > kea_closedJoint)
            jointError = kea_jointsCorrectPositions(p->s, &p->joints, p->displacement);
        isPushed |= isMoved;
    }
    return isPushed;
}

/* Corrects positions with joints by Newton's method in rounds. Each evaluates the errors of joints, and their Jacobians
 * if the last round has not reduced the errors enough. Contacts take part in the first KEA_JOINT_ROUNDS only, which are
 * joined to one if joints are closed already. Reports the step as violent if joints have opened further all the
 * same. */
static void correctJointedPositions(Step *p) {
    const double start = kea_jointsOpening(&p->joints);
    double before = HUGE_VAL;
    kea_saveJacobians(p->s);
    for (int round = 0;; round++) {
        setEndPoses(p);
        if (round == KEA_MAX_JOINT_ROUNDS)
            break;
        const double jointError = kea_jointsFindErrors(p->s, &p->joints, p->displacement);
        const MeBool areClosed = jointError <= kea_closedJoint;
        if (round >= KEA_JOINT_ROUNDS && areClosed)
            break;
        if (round > 0 && !areClosed && jointError > kea_refinedShare * before)
            kea_jointsRelinearize(p->s, &p->joints, p->displacement);
        before = jointError;
        if (round >= KEA_JOINT_ROUNDS) {
            kea_jointsCorrectPositions(p->s, &p->joints, p->displacement);
        } else if (!areClosed) {
            runPositionPasses(p, 1, jointError);
        } else if (runPositionPasses(p, KEA_JOINT_ROUNDS - round, jointError)) {
            round = KEA_JOINT_ROUNDS - 1; /* all passes of contacts are done */
        } else {
            kea_jointsCorrectPositions(p->s, &p->joints,
                                       p->displacement); /* otherwise small errors would add up over steps */
            setEndPoses(p);
            break;
        }
    }
    kea_restoreJacobians(p->s);
    p->s->report.violent = p->s->report.opens = p->s->report.opening > start + kea_violentOpening;
}

static void findPositions(Step *p) {
    memset(p->displacement, 0, sizeof *p->displacement);
    kea_visitNodes(&p->regions, advanceNode, p);
    kea_visitRegions(&p->regions, rotateFreely, p);
    if (p->joints.numBlocks > 0) {
        correctJointedPositions(p);
        return;
    }
    for (int i = 0; i < KEA_POSITION_PASSES; i++)
        kea_visitNodesByDepth(&p->regions, pushNode, p);
    setEndPoses(p);
}

/* Whether a displacement is 0. */
static MeBool isZero(const KeaMotion *displacement) {
    for (int k = 0; k < 3; k++)
        if (displacement->lin[k] != 0 || displacement->ang[k] != 0)
            return MEFALSE;
    return METRUE;
}

/* Sets isFree of bodies that got neither an impulse nor a displacement. */
static void markFreeBodies(void *context, KeaNode *node) {
    const Step *p = context;
    for (int i = node->firstPlace; i < node->firstPlace + node->numPlaces; i++)
        p->s->work->body[p->regions.body[i]].isFree =
            isZero(&p->displacement[1 + i]) && keaLength(p->change[i]) + keaLength(p->change[i] + 3) == 0;
}

/* Writes counts and work to the report. */
static void writeReport(Step *p) {
    MdtKeaReport *r = &p->s->report;
    r->passes = 1;
    r->resolution = p->s->parameters.restSpeed;
    r->work = r->iterations * workOfPass(p) + workOutsidePasses(p);
    r->capped = r->capped || !kea_jointsAreSound(&p->joints);
}

static void returnGroups(void *context, KeaNode *node) {
    const Step *p = context;
    const KeaGathering from = gathering(p);
    kea_returnManifolds(&from, p->groups + node->firstGroup, node->numGroups);
}

static void clearForces(MdtKeaSystem *s) {
    for (int i = 0; i < s->numManifolds; i++)
        for (int k = 0; k < s->manifolds[i].numPoints; k++)
            keaZero(s->manifolds[i].point[k].force);
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].force = 0;
}

/* Moves all bodies by their loads alone. */
static void moveAllFreely(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        s->work->body[i].isFree = METRUE;
    kea_moveFreeBodies(s);
}

/* There is no memory. */
static void giveUp(MdtKeaSystem *s) {
    s->report.capped = METRUE;
    clearForces(s);
    moveAllFreely(s);
}

void kea_fastSolve(MdtKeaSystem *s) {
    KeaNode nodes[KEA_MAX_NODES]; /* not initialized: 24 kB, of which most partitions use two nodes */
    Step p = {.s = s, .kernel = kernelOfMachine(), .regions = {.s = s, .team = s->team, .node = nodes}};
    if (s->numManifolds == 0 && s->numRows == 0) {
        s->report.passes = 1;
        s->report.resolution = s->parameters.restSpeed;
        moveAllFreely(s);
        return;
    }
    if (!beginStep(&p)) {
        giveUp(s);
        return;
    }
    findSpeed(&p);
    p.loadSpeed = kea_loadSpeed(s);
    applyImpulses(&p);
    kea_visitRegions(&p.regions, saveMotions, &p);
    findVelocities(&p);
    if (s->parameters.followsContacts && !followContacts(&p)) {
        giveUp(s);
        return;
    }
    setEndMomenta(&p);
    guardEnergy(&p);
    kea_jointsRemoveStiffness(s, &p.joints);
    chooseThetas(&p);
    setFall(&p);
    findPositions(&p);
    kea_jointsSetMomenta(s, &p.joints);
    kea_visitNodes(&p.regions, setReboundsOf, &p);
    const MeBool doRebound = isAnyOverNodes(&p.regions);
    if (kea_jointsSetRebounds(&p.joints) || doRebound) {
        kea_jointsRefactor(s, &p.joints);
        findVelocities(&p);
        setEndMomenta(&p);
        if (isEnergyGained(&p)) /* by Newton's law of restitution at several points together */
            limitImpulses(&p);
        kea_jointsRemoveStiffness(s, &p.joints);
        kea_jointsSetMomenta(s, &p.joints);
    }
    writeReport(&p);
    kea_visitNodes(&p.regions, returnGroups, &p);
    kea_jointsReturnForces(s, &p.joints);
    kea_visitRegions(&p.regions, markFreeBodies, &p);
    kea_moveFreeBodies(s);
}
