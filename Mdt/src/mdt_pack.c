/* Pack: scratch memory for a partition's step, and what acts on its bodies. */
#include "MeAssert.h"
#include "mdt_step_i.h"
#include <limits.h>
#include <string.h>

static int mostRows(const MdtIsland *p) {
    int rows = 0;
    for (int i = 0; i < p->numConstraints; i++)
        rows += p->constraints[i]->type->maxRows;
    return rows;
}

/* Room for Kea's arrays and, behind them, the state at the start. */
static MeBool takeScratch(MdtIsland *p) {
    const size_t bytes = MdtKeaScratchSize(p->numBodies, p->kea.maxRows);
    const size_t total = bytes + (size_t)p->numBodies * sizeof *p->start;
    char *scratch = total <= INT_MAX ? MeChunkGetMem(&p->world->scratch, (int)total) : NULL;
    if (!scratch) {
        MeWarning(2, "MdtWorldStep: partition %d (%d bodies, %d rows) is too large for the solver and is not moved",
                  p->number, p->numBodies, p->kea.maxRows);
        return MEFALSE;
    }
    p->scratch = scratch;
    p->start = (MdtStart *)(void *)(scratch + bytes);
    return METRUE;
}

static void setSystem(MdtIsland *p) {
    p->kea.numBodies = p->numBodies;
    p->kea.bodies = p->world->keaOf + p->world->bodyStart[p->number];
    p->kea.maxRows = mostRows(p);
    p->kea.errors = mdt_rowsErrors;
    p->kea.jacobians = mdt_rowsMove;
    p->kea.cache = p->world->keaCache;
    p->kea.context = p;
}

static void addGravity(MdtWorldID w, MdtBodyID b) {
    for (int i = 0; i < 3; i++)
        b->kea.force[i] += b->mass * (double)w->params.gravity[i];
}

static void packBodies(MdtIsland *p) {
    for (int i = 0; i < p->numBodies; i++) {
        MEASSERT(p->bodies[i]->partition == p->number && (p->bodies[i]->flags & MDT_ENABLED));
        p->bodies[i]->index = i;
        mdt_bodyPack(p->bodies[i]);
        addGravity(p->world, p->bodies[i]);
    }
}

static void rememberStart(MdtIsland *p) {
    for (int i = 0; i < p->numBodies; i++) {
        mdt_bodyVelocity(p->bodies[i], &p->start[i].velocity);
        keaCopy(p->start[i].position, p->bodies[i]->kea.position);
        memcpy(p->start[i].quaternion, p->bodies[i]->kea.quaternion, sizeof p->start[i].quaternion);
    }
}

MeBool mdt_islandPack(MdtIsland *p) {
    setSystem(p);
    if (!takeScratch(p))
        return MEFALSE;
    packBodies(p);
    rememberStart(p);
    return METRUE;
}

void mdt_islandRelease(MdtIsland *p) {
    MEASSERT(p->scratch && p->start);
    MeChunkPutMem(&p->world->scratch, p->scratch);
    p->scratch = NULL;
    p->start = NULL;
}
