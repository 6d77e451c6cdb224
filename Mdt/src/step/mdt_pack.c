/* Pack: scratch memory for a partition's step, loads of its bodies, manifolds of its contacts. */
#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMath.h"
#include "step/mdt_step_i.h"
#include <limits.h>
#include <string.h>

/* ---- acting constraints, in chunks ---- */

/* Counts of the constraints of a chunk, and properties found while they are packed. */
typedef struct Chunk {
    int rows, joints, points, manifolds; /* rows: upper bound, of joints */
    int angularRows;                     /* of contacts with rolling or spinning friction */
    int firstManifold, surfaceProblems;
    MeBool hasUserRows, hasSplitRows, bounces, losesEnergy;
} Chunk;

/* For results independent of threads (rule in MeTeam.h), chunks depend on the number of constraints only, and so do the
 * indices of the manifolds that each chunk writes; counts are summed in the order of chunks. */
enum { MAX_CHUNKS = 128 };

typedef struct Acting {
    MdtIsland *p;
    int chunkSize, numChunks;
    Chunk chunk[MAX_CHUNKS];
} Acting;

/* Records the surface of a number of points. */
static void recordSurface(const MdtBclContactParams *params, int points, Chunk *c) {
    c->angularRows += points * ((params->rollingFriction > 0 ? 2 : 0) + (params->spinningFriction > 0));
    if (!mdt_hasRestitution(params))
        return;
    c->bounces = METRUE;
    c->losesEnergy = c->losesEnergy || (double)params->restitution < 1;
}

/* Adds a manifold's counts to those of a chunk. Without extras all points of a record have the record's surface. */
static void addManifoldTo(const MdtManifold *m, Chunk *c) {
    c->points += m->numPoints;
    c->manifolds += mdt_contactsCount(m);
    for (const MdtManifold *block = m->numPoints > 0 ? m : NULL; block; block = block->next) {
        if (!block->extras)
            recordSurface(&block->surface->params, MDT_POINTS, c);
        for (const MdtPoint *at = mdt_pointIn(block, 0); at && block->extras; at = mdt_pointIn(block, at->slot + 1))
            recordSurface(mdt_pointParams(at), 1, c);
    }
}

static void MEAPI countChunk(void *context, int item, int worker) {
    Acting *a = context;
    const int first = item * a->chunkSize, end = MeMIN(first + a->chunkSize, a->p->numActing);
    Chunk c = {0};
    (void)worker;
    for (int i = first; i < end; i++) {
        if (i + MDT_AHEAD < end)
            me_prefetch(a->p->acting[i + MDT_AHEAD], sizeof(MdtManifold));
        MdtJoint *j = mdt_asJoint(a->p->acting[i]);
        c.rows += j ? j->type->maxRows : 0;
        c.joints += j != NULL;
        c.hasUserRows |= j && j->bcl.type == MdtBclUSER;
        c.hasSplitRows |= j && j->bcl.type == MdtBclMIMIC && mdt_mimicUpdate(j);
        if (!j)
            addManifoldTo(mdt_asManifold(a->p->acting[i]), &c);
    }
    a->chunk[item] = c;
}

static void MEAPI packChunk(void *context, int item, int worker) {
    Acting *a = context;
    const int first = item * a->chunkSize, end = MeMIN(first + a->chunkSize, a->p->numActing);
    Chunk *c = &a->chunk[item];
    int at = c->firstManifold;
    (void)worker;
    for (int i = first; i < end; i++) {
        if (i + MDT_AHEAD < end)
            me_prefetch(a->p->acting[i + MDT_AHEAD], sizeof(MdtManifold));
        if (mdt_isManifold(a->p->acting[i]))
            at = mdt_contactsPack(a->p, mdt_asManifold(a->p->acting[i]), at, &c->surfaceProblems);
    }
    MEASSERT(at == c->firstManifold + c->manifolds);
}

/* Counts the constraints of all chunks; returns the sums. */
static Chunk countActing(Acting *a) {
    MdtIsland *p = a->p;
    Chunk all = {0};
    a->chunkSize = MeMAX(MDT_RANGE, (p->numActing + MAX_CHUNKS - 1) / MAX_CHUNKS);
    a->numChunks = (p->numActing + a->chunkSize - 1) / a->chunkSize;
    MEASSERT(a->numChunks <= MAX_CHUNKS);
    MeTeamRun(p->team, a->numChunks, countChunk, a);
    for (int i = 0; i < a->numChunks; i++) {
        a->chunk[i].firstManifold = all.manifolds;
        all.rows += a->chunk[i].rows;
        all.joints += a->chunk[i].joints;
        all.points += a->chunk[i].points;
        all.angularRows += a->chunk[i].angularRows;
        all.manifolds += a->chunk[i].manifolds;
        all.hasUserRows |= a->chunk[i].hasUserRows;
        all.hasSplitRows |= a->chunk[i].hasSplitRows;
        all.bounces |= a->chunk[i].bounces;
        all.losesEnergy |= a->chunk[i].losesEnergy;
    }
    return all;
}

static void packContacts(Acting *a) {
    MeTeamRun(a->p->team, a->numChunks, packChunk, a);
    for (int i = 0; i < a->numChunks; i++)
        a->p->worker->surfaceProblems |= a->chunk[i].surfaceProblems;
}

/* ---- the system ---- */

/* Allocates scratch memory for Kea's arrays, followed by the manifolds. False, with a warning, if it is too large. */
static MeBool allocateScratch(MdtIsland *p, int manifolds) {
    const size_t bytes = MdtKeaScratchSize(p->numBodies, p->kea.maxRows, p->kea.maxContacts);
    const size_t total = bytes + mdt_contactsSize(manifolds);
    char *scratch = total <= INT_MAX ? MeChunkGetMem(&p->worker->scratch, (int)total) : NULL;
    if (!scratch) {
        MeWarning(2, "%s: partition %d (%d bodies, %d rows) is too large for the solver and is not moved",
                  MeCallerName("MdtWorldStep"), p->number, p->numBodies, p->kea.maxRows);
        return MEFALSE;
    }
    p->scratch = scratch;
    mdt_contactsLayOut(p, scratch + bytes, manifolds);
    return METRUE;
}

/* Allocates scratch memory for the exact solver, too, if it may redo a step of the fast one. */
static MeBool allocateScratchForBoth(MdtIsland *p, int manifolds) {
    const MeBool isFast = p->isFast;
    if (p->numMembers == 0 && (p->record->share > 0 || p->record->reserve > 0))
        mdt_islandSetFast(p, MEFALSE);
    const MeBool isDone = allocateScratch(p, manifolds);
    mdt_islandSetFast(p, isFast);
    return isDone;
}

static void storeCounts(MdtIsland *p, const Chunk *all) {
    p->numJoints = all->joints;
    p->jointRows = all->rows;
    p->numContacts = all->points;
    p->hasUserRows = all->hasUserRows;
    p->contactRows = p->numContacts * MdtBclGETMAXROWSCONTACT + all->angularRows;
    p->mayBeFast = p->jointRows + p->contactRows <= p->world->maxMatrixSize && !p->hasUserRows &&
                   !all->hasSplitRows; /* the fast solver has no cap, cannot update rows of callbacks,
                                                             and has no split rows */
    p->bounces = all->bounces;
    p->losesEnergy = all->losesEnergy;
}

static void setSystem(MdtIsland *p) {
    mdt_islandSetFast(p, p->numMembers > 0 || mdt_choiceSolver(p) == MdtSolverFast);
    p->kea.numBodies = p->numBodies;
    p->kea.errors = p->numJoints > 0 ? mdt_rowsErrors : NULL;
    p->kea.jacobians = p->numJoints > 0 ? mdt_rowsUpdateJacobians : NULL;
    p->kea.cache = p->worker->keaCache;
    p->kea.team = p->team;
    p->kea.context = p;
    p->kea.parameters.accuracy = mdt_worldAccuracy(p->world, p->h, p->numJoints > 0);
    p->kea.parameters.restSpeed = mdt_worldCalmSpeed(p->world, p->h);
    p->kea.parameters.followsContacts =
        p->numMembers == 0 && p->numJoints == 0 && !p->bounces && p->numBodies <= p->world->timedBodies;
    MEASSERT(p->kea.parameters.accuracy >= 0 && p->kea.parameters.restSpeed > 0);
}

/* ---- bodies ---- */

static void addGravity(const MdtWorld *w, MdtBodyID b) {
    for (int i = 0; i < 3; i++)
        b->kea.force[i] += b->gravityFactor * b->mass * (double)w->params.gravity[i];
}

static void completeLoad(const MdtIsland *p, MdtBodyID b) {
    if (!p->isPushed) {
        addGravity(p->world, b);
        return;
    }
    keaZero(b->kea.force);
    keaZero(b->kea.torque);
}

/* For results independent of threads (rule in MeTeam.h), a range writes to its own bodies only. */
static void MEAPI packBodies(void *island, int first, int end, int worker) {
    const MdtIsland *p = island;
    (void)worker;
    for (int i = first; i < end; i++) {
        MEASSERT(p->bodies[i]->partition >= p->number && (p->bodies[i]->record.flags & MDT_ENABLED));
        p->bodies[i]->index = i;
        mdt_bodyPack(p->bodies[i], p->whole, p->numJoints > 0 && !p->isFast);
        completeLoad(p, p->bodies[i]);
        keaDropAxes(p->bodies[i]->kea.locked, p->bodies[i]->kea.force);
        keaDropAxes(p->bodies[i]->kea.locked >> 3, p->bodies[i]->kea.torque);
        mdt_bodySaveStart(p->bodies[i]);
    }
}

void mdt_islandCount(MdtIsland *p) {
    Acting acting;
    acting.p = p;
    const Chunk all = countActing(&acting);
    storeCounts(p, &all);
}

MeBool mdt_islandPack(MdtIsland *p) {
    Acting acting; /* not initialized, as most partitions use one chunk only */
    acting.p = p;
    MEASSERT(!p->scratch);
    const Chunk all = countActing(&acting);
    storeCounts(p, &all);
    setSystem(p);
    if (!allocateScratchForBoth(p, all.manifolds))
        return MEFALSE;
    MeTeamRunRanges(p->team, p->numBodies, MDT_RANGE, packBodies, p);
    packContacts(&acting);
    return METRUE;
}

void mdt_islandRelease(MdtIsland *p) {
    MEASSERT(p->scratch);
    MeChunkPutMem(&p->worker->scratch, p->scratch);
    p->scratch = NULL;
}
