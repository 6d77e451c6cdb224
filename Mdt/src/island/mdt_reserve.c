/* Capacity of the arrays of a world's steps: partitions, batches and tasks. */
#include "MeAssert.h"
#include "MeInternal.h"
#include "island/mdt_choice_i.h"

/* Reserves `count` elements of an array, of which the first `kept` ones stay. False, after a fatal error: no memory. */
#define GROW(array, kept, count, what) MeMemoryGrow(&(array), (kept), (count), sizeof *(array), caller, (what))

/* ---- tasks ---- */

/* The partitions sorted by task, and the start of each task with an end entry. */
size_t mdt_tasksSize(size_t bodies) {
    return 2 * bodies + 1;
}

/* ---- batches ---- */

static MeBool reserveBatches(MdtBatches *b, size_t n, const char *caller) {
    return GROW(b->firstMember, 0, n + 1, "batches") && GROW(b->member, 0, n + 1, "batches") &&
           GROW(b->isIn, 0, n, "batches") && GROW(b->body, 0, n, "batches") && GROW(b->kea, 0, n, "batches");
}

MeBool mdt_batchesReserve(MdtBatches *b, int bodies, int acting, const char *caller) {
    if (bodies > b->bodyRoom && !reserveBatches(b, (size_t)bodies, caller))
        return MEFALSE;
    b->bodyRoom = MeMAX(b->bodyRoom, bodies);
    if (acting > b->actingRoom && !GROW(b->acting, 0, (size_t)acting, "batches"))
        return MEFALSE;
    b->actingRoom = MeMAX(b->actingRoom, acting);
    return METRUE;
}

void mdt_batchesTerm(MdtBatches *b) {
    void *arrays[] = {b->firstMember, b->member, b->isIn, b->body, b->kea, b->acting};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        MeMemoryGive(arrays[i]);
}

/* ---- the world ---- */

/* Of these arrays only the records of partitions keep their contents. */
static MeBool reserveBodies(MdtWorldID w, int bodies, const char *caller) {
    const size_t n = (size_t)MeMAX(bodies, 2 * w->bodyRoom), records = (size_t)w->numPartitions;
    MEASSERT(w->numPartitions <= w->bodyRoom);
    if (bodies <= w->bodyRoom)
        return METRUE;
    if (!GROW(w->bodyOf, 0, n, "the bodies of a step") || !GROW(w->keaOf, 0, n, "the bodies of a step") ||
        !GROW(w->graph.body, 0, n, "the bodies of a step") || !GROW(w->graph.parent, 0, n, "the bodies of a step") ||
        !GROW(w->graph.isEnabled, 0, n, "the bodies of a step") ||
        !GROW(w->graph.isAwake, 0, n, "the bodies of a step") ||
        !GROW(w->graph.partition, 0, n, "the bodies of a step") || !GROW(w->bodyStart, 0, n + 1, "partitions") ||
        !GROW(w->actingStart, 0, n + 1, "partitions") || !GROW(w->constraintStart, 0, n + 1, "partitions") ||
        !GROW(w->record, records, n, "partitions") || !GROW(w->lastRecord, 0, n, "partitions") ||
        !GROW(w->output.info, 0, n, "partitions") || !GROW(w->taskOf, 0, mdt_tasksSize(n), "tasks"))
        return MEFALSE;
    w->bodyRoom = (int)n;
    MEASSERT(w->bodyRoom >= bodies);
    return METRUE;
}

/* The list of broken joints keeps its contents: further parts of the step may add to it. */
static MeBool reserveConstraints(MdtWorldID w, int constraints, const char *caller) {
    const size_t n = (size_t)MeMAX(constraints, 2 * w->constraintRoom), broken = (size_t)w->numBroken;
    MEASSERT(w->numBroken <= w->constraintRoom);
    if (constraints <= w->constraintRoom)
        return METRUE;
    if (!GROW(w->constraintOf, 0, n, "the constraints of a step") ||
        !GROW(w->actingOf, 0, n, "the constraints of a step") ||
        !GROW(w->graph.acting, 0, n, "the constraints of a step") ||
        !GROW(w->graph.actsOn, 0, n, "the constraints of a step") || !GROW(w->broken, broken, n, "broken joints"))
        return MEFALSE;
    w->constraintRoom = (int)n;
    return METRUE;
}

MeBool mdt_worldReserve(MdtWorldID w, int bodies, int constraints, const char *caller) {
    const MeBool isDone = reserveBodies(w, MeMAX(bodies, 1), caller) &&
                          reserveConstraints(w, MeMAX(constraints, 1), caller) &&
                          mdt_batchesReserve(&w->batches, w->bodyRoom, w->constraintRoom, caller);
    w->output.world = w;
    w->output.bodies = w->bodyOf;
    w->output.constraints = w->constraintOf;
    return isDone;
}
