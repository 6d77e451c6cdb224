/* Batches: many small partitions (islands), solved by the fast solver as one system, so that different partitions fill
 * its SIMD lanes: debris, balls on terrain, a collapsed wall. Solved alone, each would take the exact solver 3 to 50 us
 * per step (bench/debris), or fill one of eight lanes of the fast one.
 *
 *     candidates   partitions of few bodies, with constraints and not near rest; if they have enough bodies together:
 *     members      those without joints and restitution, not in flight, for which the fast solver is chosen
 *                  (mdt_choice.c)
 *     batches      consecutive members, each batch with a minimum number of bodies
 *
 * No constraint couples two members. The solver writes no body before its whole solution is known: if that is not
 * finite, or gains energy, the members are stepped one by one instead. The residual is known for the batch only, so a
 * partition that has been calm for long leaves the batch and gets its rest certificate alone (mdt_certificate.c).
 */
#include "MeAssert.h"
#include "MeInternal.h"
#include "step/mdt_step_i.h"
#include <string.h>

/* ---- candidates ---- */

/* The number of bodies of a partition if it is small and has constraints; else 0. */
static int countIfSmall(const MdtWorld *w, int partition) {
    const int bodies = w->bodyStart[partition + 1] - w->bodyStart[partition];
    return bodies < MDT_LARGE_ISLAND && w->actingStart[partition + 1] > w->actingStart[partition] ? bodies : 0;
}

/* Writes the candidates to the array of members. Returns their number, and in `bodies` that of their bodies. Partitions
 * that safe times limit to a part of the step are no candidates. */
static int findCandidates(MdtWorldID w, double h, MeBool stopAtSafeTime, int *bodies) {
    int count = 0;
    *bodies = 0;
    for (int i = 0; i < w->numPartitions; i++) {
        if (countIfSmall(w, i) == 0 || w->output.info[i].isDisabled || mdt_certificateIsNear(w, i))
            continue;
        const MdtIsland p = mdt_islandOf(w, i, h);
        if (stopAtSafeTime && mdt_lagSafeStep(&p) != h)
            continue;
        MEASSERT(count < w->bodyRoom);
        w->batches.member[count++].partition = i;
        *bodies += p.numBodies;
    }
    return count;
}

/* ---- members ---- */

typedef struct Choosing {
    MdtWorldID world;
    double h;
} Choosing;

/* Partitions in flight are excluded: a system without contacts with the world is advanced by its mean velocity
 * (kea_fast.c), a batch is not. For results independent of threads (rule in MeTeam.h), the choice for a partition reads
 * and writes its own bodies only. */
static void MEAPI chooseMembers(void *context, int first, int end, int worker) {
    const Choosing *c = context;
    MdtBatches *b = &c->world->batches;
    (void)worker;
    for (int i = first; i < end; i++) {
        MdtIsland p = mdt_islandOf(c->world, b->member[i].partition, c->h);
        mdt_islandCount(&p);
        const MeBool isPlain = p.numJoints == 0 && !p.bounces;
        const MeBool isUnmet = p.record->excess > 1 && p.record->share > 0; /* the exact solver may have to redo it */
        b->isIn[p.number] = isPlain && !isUnmet && !mdt_choiceIsInFlight(&p) && mdt_choiceSolver(&p) == MdtSolverFast;
    }
}

static void addMember(MdtWorldID w, int partition) {
    MdtBatches *b = &w->batches;
    MdtMember *m = &b->member[b->numMembers++];
    const int bodies = w->bodyStart[partition + 1] - w->bodyStart[partition];
    const int acting = w->actingStart[partition + 1] - w->actingStart[partition];
    m->partition = partition;
    MEASSERT(m == b->member || m[-1].partition < partition);
    MEASSERT(m->firstBody + bodies <= b->bodyRoom && m->firstActing + acting <= b->actingRoom);
    memcpy(b->body + m->firstBody, w->bodyOf + w->bodyStart[partition], (size_t)bodies * sizeof *b->body);
    memcpy(b->kea + m->firstBody, w->keaOf + w->bodyStart[partition], (size_t)bodies * sizeof *b->kea);
    memcpy(b->acting + m->firstActing, w->actingOf + w->actingStart[partition], (size_t)acting * sizeof *b->acting);
    m[1].firstBody = m->firstBody + bodies;
    m[1].firstActing = m->firstActing + acting;
}

/* Candidates are read from the same array to which members are written, ahead of these. */
static void findMembers(MdtWorldID w, double h, MeTeam *team, int candidates) {
    MdtBatches *b = &w->batches;
    Choosing choosing = {w, h};
    memset(b->isIn, 0, (size_t)w->numPartitions * sizeof *b->isIn);
    MeTeamRunRanges(team, candidates, MDT_RANGE, chooseMembers, &choosing);
    b->numMembers = 0;
    b->member[0].firstBody = b->member[0].firstActing = 0;
    for (int i = 0; i < candidates; i++) {
        const int partition = b->member[i].partition;
        MEASSERT(b->numMembers <= i);
        if (b->isIn[partition])
            addMember(w, partition);
    }
    MEASSERT(b->member[b->numMembers].firstBody <= w->bodyRoom);
    MEASSERT(b->member[b->numMembers].firstActing <= w->constraintRoom);
}

static void makeBatches(MdtBatches *b) {
    b->count = 0;
    b->firstMember[0] = 0;
    for (int i = 1; i <= b->numMembers; i++) {
        const int first = b->firstMember[b->count];
        if (b->member[i].firstBody - b->member[first].firstBody >= MDT_LARGE_ISLAND || i == b->numMembers)
            b->firstMember[++b->count] = i;
    }
    MEASSERT(b->numMembers == 0 || b->firstMember[b->count] == b->numMembers);
}

void mdt_batchesFind(MdtWorldID w, double h, MeBool stopAtSafeTime, MeTeam *team) {
    int bodies = 0;
    w->batches.count = 0;
    for (int i = 0; i < w->numPartitions; i++)
        bodies += countIfSmall(w, i);
    if ((!w->solverCb && w->solver == MdtSolverExact) || bodies < MDT_LARGE_ISLAND)
        return;
    const int candidates = findCandidates(w, h, stopAtSafeTime, &bodies);
    if (bodies < MDT_LARGE_ISLAND)
        return;
    findMembers(w, h, team, candidates);
    makeBatches(&w->batches);
}

/* ---- the step of a batch ---- */

MdtIsland mdt_batchOf(const MdtWorld *w, int batch, double h) {
    const MdtBatches *b = &w->batches;
    const MdtMember *first = &b->member[b->firstMember[batch]], *end = &b->member[b->firstMember[batch + 1]];
    MdtIsland p = mdt_islandOf(w, first->partition, h);
    p.member = first;
    p.numMembers = (int)(end - first);
    p.why = MdtReportWhyDear;
    p.numBodies = end->firstBody - first->firstBody;
    p.numActing = end->firstActing - first->firstActing;
    p.bodies = b->body + first->firstBody;
    p.kea.bodies = b->kea + first->firstBody;
    p.acting = b->acting + first->firstActing;
    MEASSERT(batch < b->count && p.numMembers > 0 && p.numBodies > 0);
    return p;
}

/* Finds the rows and the deepest overlap of a member, whose manifolds begin at `at`; returns the index behind them.
 * Manifolds are in the order of the members' constraints. */
static int measureMember(const MdtIsland *p, const MdtMember *m, int at, int *rows, double *penetration) {
    const int end = m[1].firstBody - p->member->firstBody;
    *rows = 0;
    *penetration = 0;
    for (; at < p->kea.numManifolds; at++) {
        const MdtKeaManifold *manifold = &p->kea.manifolds[at];
        if (MeMAX(manifold->body[0], manifold->body[1]) >= end)
            break;
        for (int k = 0; k < manifold->numPoints; k++) {
            *rows += manifold->point[k].numRows;
            *penetration = fmax(*penetration, manifold->point[k].depth);
        }
    }
    return at;
}

static void reportMembers(const MdtIsland *p) {
    int at = 0;
    for (const MdtMember *m = p->member; m < p->member + p->numMembers; m++) {
        double penetration;
        int rows;
        at = measureMember(p, m, at, &rows, &penetration);
        if (m->partition < p->world->sizeLogLength)
            p->world->sizeLog[m->partition] = rows;
        if (p->report)
            mdt_reportMember(p, m, rows, penetration);
    }
    MEASSERT(at == p->kea.numManifolds);
}

static void unpackBatch(MdtIsland *p) {
    mdt_membersCountCalm(p);
    mdt_unpackBodies(p);
    for (const MdtMember *m = p->member; m < p->member + p->numMembers; m++)
        mdt_choiceRecordStep(p, &p->world->record[m->partition]);
    if (p->report)
        mdt_reportLap(p, MdtReportStageIntegrate);
    if (p->report || p->world->sizeLogLength > 0)
        reportMembers(p);
}

/* Steps each member alone for the rest of the step. */
static void stepMembersOneByOne(const MdtIsland *p) {
    for (const MdtMember *m = p->member; m < p->member + p->numMembers; m++) {
        MEASSERT(p->h > p->elapsed);
        MdtIsland own = mdt_islandOf(p->world, m->partition, p->h - p->elapsed);
        own.worker = p->worker;
        p->worker->messages.key = m->partition;
        mdt_islandAdvance(&own, MEFALSE);
    }
}

/* If the solution is discarded, the bodies are as at the start of the part, with their loads. */
void mdt_batchAdvance(MdtIsland *p) {
    MdtReport report;
    mdt_reportBatch(p, &report);
    mdt_lagSet(p, p->h);
    const MeBool isPacked = mdt_islandPack(p);
    if (isPacked) {
        mdt_islandSubdivide(p);
        if (!p->isStopped)
            unpackBatch(p);
        for (int i = 0; i < p->numBodies && p->isStopped; i++)
            mdt_forceContinue(p->bodies[i]);
        mdt_islandRelease(p);
    }
    if (!isPacked || p->isStopped)
        stepMembersOneByOne(p);
}
