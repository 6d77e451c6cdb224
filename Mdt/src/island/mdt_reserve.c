/* Capacity of the arrays of a world's steps: partitions, batches and tasks. */
#include "MeAssert.h"
#include "MeInternal.h"
#include "island/mdt_choice_i.h"

/* ---- tasks ---- */

/* The partitions sorted by task, and the start of each task with an end entry. */
size_t mdt_tasksSize(size_t bodies) {
    return 2 * bodies + 1;
}

/* ---- batches ---- */

static MeBool reserveBatches(MdtBatches *b, size_t n, const char *caller) {
    return MeMemoryGrow(&b->firstMember, 0, n + 1, sizeof *b->firstMember, caller, "batches") &&
           MeMemoryGrow(&b->member, 0, n + 1, sizeof *b->member, caller, "batches") &&
           MeMemoryGrow(&b->isIn, 0, n, sizeof *b->isIn, caller, "batches") &&
           MeMemoryGrow(&b->body, 0, n, sizeof *b->body, caller, "batches") &&
           MeMemoryGrow(&b->kea, 0, n, sizeof *b->kea, caller, "batches");
}

MeBool mdt_batchesReserve(MdtBatches *b, int bodies, int acting, const char *caller) {
    if (bodies > b->bodyRoom && !reserveBatches(b, (size_t)bodies, caller))
        return MEFALSE;
    b->bodyRoom = MeMAX(b->bodyRoom, bodies);
    if (acting > b->actingRoom && !MeMemoryGrow(&b->acting, 0, (size_t)acting, sizeof *b->acting, caller, "batches"))
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

/* Only the records of partitions keep their contents. */
static MeBool reserveBodies(MdtWorldID w, int bodies, const char *caller) {
    const size_t n = (size_t)MeMAX(bodies, 2 * w->bodyRoom), records = (size_t)w->numPartitions;
    MEASSERT(w->numPartitions <= w->bodyRoom);
    if (bodies <= w->bodyRoom)
        return METRUE;
    if (!MeMemoryGrow(&w->bodyOf, 0, n, sizeof *w->bodyOf, caller, "the bodies of a step") ||
        !MeMemoryGrow(&w->keaOf, 0, n, sizeof *w->keaOf, caller, "the bodies of a step") ||
        !MeMemoryGrow(&w->graph.body, 0, n, sizeof *w->graph.body, caller, "the bodies of a step") ||
        !MeMemoryGrow(&w->graph.parent, 0, n, sizeof *w->graph.parent, caller, "the bodies of a step") ||
        !MeMemoryGrow(&w->graph.isEnabled, 0, n, sizeof *w->graph.isEnabled, caller, "the bodies of a step") ||
        !MeMemoryGrow(&w->graph.isAwake, 0, n, sizeof *w->graph.isAwake, caller, "the bodies of a step") ||
        !MeMemoryGrow(&w->graph.partition, 0, n, sizeof *w->graph.partition, caller, "the bodies of a step") ||
        !MeMemoryGrow(&w->bodyStart, 0, n + 1, sizeof *w->bodyStart, caller, "partitions") ||
        !MeMemoryGrow(&w->actingStart, 0, n + 1, sizeof *w->actingStart, caller, "partitions") ||
        !MeMemoryGrow(&w->constraintStart, 0, n + 1, sizeof *w->constraintStart, caller, "partitions") ||
        !MeMemoryGrow(&w->record, records, n, sizeof *w->record, caller, "partitions") ||
        !MeMemoryGrow(&w->lastRecord, 0, n, sizeof *w->lastRecord, caller, "partitions") ||
        !MeMemoryGrow(&w->output.info, 0, n, sizeof *w->output.info, caller, "partitions") ||
        !MeMemoryGrow(&w->taskOf, 0, mdt_tasksSize(n), sizeof *w->taskOf, caller, "tasks"))
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
    if (!MeMemoryGrow(&w->constraintOf, 0, n, sizeof *w->constraintOf, caller, "the constraints of a step") ||
        !MeMemoryGrow(&w->actingOf, 0, n, sizeof *w->actingOf, caller, "the constraints of a step") ||
        !MeMemoryGrow(&w->graph.acting, 0, n, sizeof *w->graph.acting, caller, "the constraints of a step") ||
        !MeMemoryGrow(&w->graph.actsOn, 0, n, sizeof *w->graph.actsOn, caller, "the constraints of a step") ||
        !MeMemoryGrow(&w->broken, broken, n, sizeof *w->broken, caller, "broken joints"))
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
