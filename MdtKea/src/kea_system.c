/* The system of one partition: its memory, the choice of solver, and whether end states may be committed. */
#include "kea_i.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include "MeTeam.h"
#include "common/kea_policy_i.h"
#include "exact/kea_contact_i.h"
#include "fast/kea_fast_i.h"
#include <stdint.h>
#include <string.h>

/* Sets the system's arrays; without memory in the arena it only measures them. */
static void layOutSystem(MdtKeaSystem *s, KeaArena *arena) {
    const size_t n = (size_t)s->numBodies, m = (size_t)s->maxRows;
    KEA_CARVE(arena, s->pose, n);
    KEA_CARVE(arena, s->velocity, n);
    KEA_CARVE(arena, s->predicted, n);
    KEA_CARVE(arena, s->invMass, n);
    KEA_CARVE(arena, s->rows, m);
    KEA_CARVE(arena, s->moves, m);
    MdtKeaWork *work = kea_carve(arena, 1, sizeof *work), measured;
    s->work = work;
    if (!work)
        work = &measured;
    KEA_CARVE(arena, work->contact, (size_t)s->maxContacts);
    KEA_CARVE(arena, work->body, n);
    KEA_CARVE(arena, work->end, n);
    KEA_CARVE(arena, work->endPose, n);
    KEA_CARVE(arena, work->meanPose, n);
    KEA_CARVE(arena, work->endErrors, m);
    KEA_CARVE(arena, work->movingRate, m);
    KEA_CARVE(arena, work->savedJ, m);
    KEA_CARVE(arena, work->bestU, n);
    KEA_CARVE(arena, work->bestP, m);
    KEA_CARVE(arena, work->tangentU, n);
    KEA_CARVE(arena, work->tangentP, m);
    KEA_CARVE(arena, work->turnDerivative, n);
    KEA_CARVE(arena, work->added, n);
    KEA_CARVE(arena, work->plastic, n);
    KEA_CARVE(arena, work->target, 2 * m);
    KEA_CARVE(arena, work->velocity, n);
    KEA_CARVE(arena, work->savedP, m);
    KEA_CARVE(arena, work->isIncluded, m);
    KEA_CARVE(arena, work->carrier, n);
    KEA_CARVE(arena, work->activeRow, m);
    KEA_CARVE(arena, work->problemRowOf, m);
    KEA_CARVE(arena, work->activeBody, n);
    KEA_CARVE(arena, work->problemBodyOf, n);
    KEA_CARVE(arena, work->parent, n + 1);
    KEA_CARVE(arena, work->flight.time, n);
    KEA_CARVE(arena, work->flight.start, n + 1);
    KEA_CARVE(arena, work->flight.body, n);
    KEA_CARVE(arena, work->flight.isInvolved, n);
    KEA_CARVE(arena, work->flight.impactTime, (size_t)s->maxContacts);
    KEA_CARVE(arena, work->flight.list, 2 * (size_t)s->maxContacts);
    KEA_CARVE(arena, work->flight.touching, (size_t)s->maxContacts);
    KEA_CARVE(arena, work->dual.start, m + 1);
    KEA_CARVE(arena, work->dual.size, m);
    KEA_CARVE(arena, work->dual.edges, m);
    KEA_CARVE(arena, work->dual.side, m);
    KEA_CARVE(arena, work->dual.lastJoined, m);
    KEA_CARVE(arena, work->dual.first, n);
    KEA_CARVE(arena, work->dual.next, m);
    KEA_CARVE(arena, work->dual.x, m);
    KEA_CARVE(arena, work->dual.response, m);
    kea_problemLayOut(&work->problem, s->numBodies, s->maxRows, arena);
}

size_t MEAPI MdtKeaScratchSize(int numBodies, int maxRows, int maxContacts) {
    MdtKeaSystem s;
    memset(&s, 0, sizeof s);
    s.numBodies = numBodies > 0 ? numBodies : 0;
    s.maxRows = maxRows > 0 ? maxRows : 0;
    s.maxContacts = maxContacts > 0 ? maxContacts : 0;
    KeaArena measure = {NULL, 0};
    layOutSystem(&s, &measure);
    return measure.used;
}

int MEAPI MdtKeaMemoryRequired(const int num_rows_exc_padding[], int num_partitions, int max_rows, int max_bodies) {
    size_t max = 0;
    for (int i = 0; i < num_partitions; i++) {
        const int rows = num_rows_exc_padding ? num_rows_exc_padding[i] : max_rows;
        const size_t bytes = MdtKeaScratchSize(max_bodies, rows, rows);
        max = bytes > max ? bytes : max;
    }
    return max > (size_t)INT32_MAX ? INT32_MAX : (int)max;
}

static void prefetchBody(const MdtKeaSystem *s, int i, int end) {
    if (i + KEA_AHEAD < end)
        me_prefetch(s->bodies[i + KEA_AHEAD], sizeof *s->bodies[i]);
}

/* Computes the start values of a range of bodies. Like commitBodies it writes only to bodies of its range, as the rule
 * for order demands (MeTeam.h). */
static void MEAPI beginBodies(void *system, int first, int end, int worker) {
    MdtKeaSystem *s = system;
    (void)worker;
    for (int i = first; i < end; i++) {
        prefetchBody(s, i, end);
        kea_beginBody(s, i);
    }
}

static MeBool hasLocks(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        if (s->work->body[i].locked)
            return METRUE;
    return MEFALSE;
}

void MEAPI MdtKeaInit(MdtKeaSystem *s, void *scratch) {
    KeaArena arena = {scratch, 0};
    MEASSERTALIGNED(scratch, 16);
    MEASSERT(s->numBodies >= 0 && s->maxRows >= 0 && s->maxContacts >= 0);
    s->numRows = 0;
    memset(&s->report, 0, sizeof s->report);
    layOutSystem(s, &arena);
    s->work->numContacts = 0;
    MeTeamRunRanges(s->team, s->numBodies, KEA_BODY_CHUNK, beginBodies, s);
    s->work->hasLocks = hasLocks(s);
    if (s->parameters.elapsed == 0)
        kea_guessContactForces(s);
}

void MEAPI MdtKeaSolve(MdtKeaSystem *s) {
    MEASSERT(s->parameters.stepsize > 0 && s->parameters.gamma >= 0 && s->parameters.gamma <= 1);
    MEASSERT(s->numRows >= 0 && s->numRows <= s->maxRows);
    memset(&s->report, 0, sizeof s->report);
    s->report.event = s->parameters.stepsize;
    kea_setRebounds(s);
    if (s->parameters.solver == MdtKeaSolverFast) {
        kea_fastSolve(s);
    } else {
        kea_exactSolve(s);
        kea_returnContactForces(s);
    }
    kea_carryBodies(s);
}

void MEAPI MdtKeaImpact(MdtKeaSystem *s) {
    const KeaEventScale scale = kea_eventScale(s);
    if (kea_resolveImpacts(s, &scale))
        kea_returnContactForces(s);
}

/* Whether all values are finite as MeReal, in which programs read the state. */
static MeBool isInRange(const double *v, int n) {
    for (int i = 0; i < n; i++)
        if (!(fabs(v[i]) <= (double)MEINFINITY))
            return MEFALSE;
    return METRUE;
}

/* Whether the end state of a body, and the angular velocity that follows from it, are finite as MeReal. */
static MeBool mayCommit(const MdtKeaBody *body, const KeaEnd *end) {
    if (!isInRange(end->position, 3) || !isInRange(end->quaternion, 4) || !isInRange(end->velocity, 3) ||
        !isInRange(end->angularMomentum, 3))
        return MEFALSE;
    return keaLength(end->angularMomentum) / kea_minOf(body->moments) <= (double)MEINFINITY; /* a bound of |w| */
}

static void MEAPI commitBodies(void *system, int first, int end, int worker) {
    MdtKeaSystem *s = system;
    (void)worker;
    for (int i = first; i < end; i++) {
        prefetchBody(s, i, end);
        kea_commitBody(s, i);
    }
}

/* Whether the forces of all points are finite: in a very long step they can overflow while end states do not. */
static MeBool areForcesFinite(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numManifolds; i++)
        for (int k = 0; k < s->manifolds[i].numPoints; k++) {
            const double *force = s->manifolds[i].point[k].force;
            if (!isfinite(force[0] + force[1] + force[2]))
                return MEFALSE;
        }
    return METRUE;
}

const MdtKeaTransformation *MEAPI MdtKeaEndPoses(const MdtKeaSystem *s) {
    return s->work->endPose;
}

MeBool MEAPI MdtKeaIntegrate(MdtKeaSystem *s) {
    if (!areForcesFinite(s))
        return MEFALSE;
    for (int i = 0; i < s->numBodies; i++)
        if (!mayCommit(s->bodies[i], &s->work->end[i]))
            return MEFALSE;
    MeTeamRunRanges(s->team, s->numBodies, KEA_BODY_CHUNK, commitBodies, s);
    return METRUE;
}
