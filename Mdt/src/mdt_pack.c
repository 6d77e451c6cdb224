/* Pack: scratch memory for a partition's step, and what acts on its bodies. */
#include "MeAssert.h"
#include "mdt_step_i.h"
#include <limits.h>
#include <string.h>

/* Counts the joints, the contacts, and the rows that there may be for Kea. */
static int mostRows(MdtIsland *p) {
    int rows = 0;
    p->numJoints = p->numContacts = 0;
    for (int i = 0; i < p->numActing; i++) {
        const MdtJoint *j = mdt_asJoint(p->acting[i]);
        rows += j ? j->type->maxRows : 0;
        p->numJoints += j != NULL;
        p->numContacts += j ? 0 : mdt_asManifold(p->acting[i])->numPoints;
    }
    const int contactRows = p->numContacts * MdtBclGETMAXROWSCONTACT;
    p->isFast = mdt_crowdIsChosen(p, rows + contactRows);
    return rows + (p->isFast ? 0 : contactRows);
}

/* Room for Kea's arrays and, behind them, the manifolds. */
static MeBool takeScratch(MdtIsland *p) {
    const size_t bytes = MdtKeaScratchSize(p->numBodies, p->kea.maxRows, p->kea.maxContacts);
    const int manifolds = mdt_contactsCount(p);
    const size_t total = bytes + mdt_contactsSize(manifolds);
    char *scratch = total <= INT_MAX ? MeChunkGetMem(&p->worker->scratch, (int)total) : NULL;
    if (!scratch) {
        MeWarning(2, "MdtWorldStep: partition %d (%d bodies, %d rows) is too large for the solver and is not moved",
                  p->number, p->numBodies, p->kea.maxRows);
        return MEFALSE;
    }
    p->scratch = scratch;
    mdt_contactsLayOut(p, scratch + bytes, manifolds);
    return METRUE;
}

static void setSystem(MdtIsland *p) {
    p->kea.numBodies = p->numBodies;
    p->kea.bodies = p->world->keaOf + p->world->bodyStart[p->number];
    p->kea.maxRows = mostRows(p);
    p->kea.maxContacts = p->isFast ? 0 : p->numContacts;
    p->kea.errors = p->numJoints > 0 ? mdt_rowsErrors : NULL;
    p->kea.jacobians = p->numJoints > 0 ? mdt_rowsMove : NULL;
    p->kea.cache = p->worker->keaCache;
    p->kea.team = p->team;
    p->kea.context = p;
    p->kea.parameters.solver = p->isFast ? MdtKeaSolverFast : MdtKeaSolverExact;
    p->kea.parameters.accuracy = mdt_worldAccuracy(p->world, p->h);
}

static void addGravity(MdtWorldID w, MdtBodyID b) {
    for (int i = 0; i < 3; i++)
        b->kea.force[i] += b->mass * (double)w->params.gravity[i];
}

static void rememberStart(MdtBodyID b) {
    mdt_bodyVelocity(b, &b->start.velocity);
    keaCopy(b->start.position, b->kea.position);
    memcpy(b->start.quaternion, b->kea.quaternion, sizeof b->start.quaternion);
    b->start.moves = b->moves;
}

static void MEAPI packBodies(void *island, int first, int end, int worker) {
    const MdtIsland *p = island;
    (void)worker;
    for (int i = first; i < end; i++) {
        MEASSERT(p->bodies[i]->partition == p->number && (p->bodies[i]->record.flags & MDT_ENABLED));
        p->bodies[i]->index = i;
        mdt_bodyPack(p->bodies[i]);
        addGravity(p->world, p->bodies[i]);
        rememberStart(p->bodies[i]);
    }
}

MeBool mdt_islandPack(MdtIsland *p) {
    setSystem(p);
    if (!takeScratch(p))
        return MEFALSE;
    MeTeamRunRanges(p->team, p->numBodies, MDT_RANGE, packBodies, p);
    mdt_contactsPack(p);
    return METRUE;
}

void mdt_islandRelease(MdtIsland *p) {
    MEASSERT(p->scratch);
    MeChunkPutMem(&p->worker->scratch, p->scratch);
    p->scratch = NULL;
}
