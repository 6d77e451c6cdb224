/* Partitions: sets of bodies that constraints connect (Dynamics guide ch. 1, "Partitioning the World").
 *
 * Contacts with the world, and with movers, do not connect bodies: two boxes on the ground are two partitions. A set
 * with one enabled body becomes enabled as a whole. Partitions are numbered by their first body, and their bodies and
 * constraints keep the world's order, so that the same scene is always solved in the same order.
 *
 * Method: union-find with path halving on the bodies' indices in that order, one walk over the constraints, and a
 * counting sort. The partitions are kept while the graph has not changed (MdtGraph.changes).
 */
#include "MeAssert.h"
#include "MeDict.h"
#include "MeInternal.h"
#include "island/mdt_choice_i.h"
#include <string.h>

enum { NONE = -1 };

/* ---- the graph ---- */

static int rootOf(int parent[], int place) {
    while (parent[place] != place) {
        MEASSERT(parent[place] < place);
        parent[place] = parent[parent[place]]; /* path halving */
        place = parent[place];
    }
    return place;
}

/* Unites two sets. The root of a set is its first body. */
static void uniteSets(MdtGraph *g, int a, int b) {
    const int ra = rootOf(g->parent, a), rb = rootOf(g->parent, b);
    const int first = ra < rb ? ra : rb, second = ra < rb ? rb : ra;
    MEASSERT(second < g->numBodies);
    g->parent[second] = first;
    g->isAwake[first] = g->isAwake[first] || g->isAwake[second];
}

static void numberBodies(MdtWorldID w) {
    MdtGraph *g = &w->graph;
    int n = 0;
    for (MdtLink *link = w->bodies.first; link; link = link->next, n++) {
        MdtBodyID b = mdt_linkOwner(link);
        b->place = b->mover ? NONE : n;
        MEASSERT(n < w->bodyRoom);
        g->body[n] = b;
        g->parent[n] = n;
        g->isEnabled[n] = g->isAwake[n] = (b->record.flags & MDT_ENABLED) && !b->mover;
    }
    MEASSERT(n == w->bodies.count);
    g->numBodies = n;
}

/* The place of the body of a side; NONE: the world, or a mover. */
static int placeOf(const MdtBaseConstraint *c, int side) {
    return c->side[side].body ? c->side[side].body->place : NONE;
}

/* Unites the bodies of each acting constraint, and lists the acting constraints. Their records are scattered in memory;
 * the last step's list predicts which ones come next, for prefetching. */
static void uniteBodies(MdtWorldID w) {
    MdtGraph *g = &w->graph;
    const int before = g->numActing;
    int n = 0;
    for (MdtLink *link = w->constraints.first; link; link = link->next) {
        MdtConstraintID c = mdt_linkOwner(link);
        if (n + MDT_AHEAD < before)
            me_prefetch(g->acting[n + MDT_AHEAD], sizeof *c);
        const int place[2] = {placeOf(c, 0), placeOf(c, 1)};
        if (!(c->record.flags & MDT_ENABLED) || (place[0] == NONE && place[1] == NONE))
            continue;
        MEVALIDATE(place[0] == NONE || g->body[place[0]] == c->side[0].body);
        MEVALIDATE(place[1] == NONE || g->body[place[1]] == c->side[1].body);
        if (place[0] != NONE && place[1] != NONE)
            uniteSets(g, place[0], place[1]);
        MEASSERT(n < w->constraintRoom);
        g->acting[n] = c;
        g->actsOn[n++] = place[0] != NONE ? place[0] : place[1];
    }
    MEASSERT(n <= w->constraints.count);
    g->numActing = n;
}

/* ---- partitions ---- */

/* Numbers the awake sets and counts their bodies into bodyStart[partition + 1]. The root is the first body of its set.
 * */
static void numberIslands(MdtWorldID w) {
    MdtGraph *g = &w->graph;
    w->numPartitions = 0;
    w->bodyStart[0] = w->actingStart[0] = 0;
    for (int i = 0; i < g->numBodies; i++) {
        const int root = rootOf(g->parent, i);
        g->partition[i] = NONE;
        if (!g->isAwake[root])
            continue;
        if (!g->isEnabled[i] && !(g->body[i]->record.flags & MDT_ENABLED)) /* unless a callback has enabled it */
            mdt_bodyEnable(g->body[i]);
        if (root == i) {
            g->partition[i] = w->numPartitions++;
            w->bodyStart[w->numPartitions] = w->actingStart[w->numPartitions] = 0;
        }
        g->partition[i] = g->partition[root];
        MEASSERT(g->partition[i] >= 0 && g->partition[i] < w->numPartitions);
        w->bodyStart[g->partition[i] + 1]++;
    }
}

/* Turns the counts in start[partition + 1] into the index of each partition's first entry. */
static void sumCounts(MdtWorldID w) {
    for (int p = 0; p < w->numPartitions; p++) {
        w->bodyStart[p + 1] += w->bodyStart[p];
        w->actingStart[p + 1] += w->actingStart[p];
    }
}

static void countActing(MdtWorldID w) {
    const MdtGraph *g = &w->graph;
    for (int i = 0; i < g->numActing; i++) {
        const int p = g->partition[g->actsOn[i]];
        if (p != NONE)
            w->actingStart[p + 1]++;
    }
}

static void sortBodies(MdtWorldID w) {
    for (int i = 0; i < w->graph.numBodies; i++) {
        MdtBodyID b = w->graph.body[i];
        b->partition = w->graph.partition[i];
        if (b->partition == NONE)
            continue;
        const int at = w->bodyStart[b->partition]++;
        MEASSERT(at < w->bodyStart[b->partition + 1] || b->partition + 1 == w->numPartitions);
        w->bodyOf[at] = b;
        w->keaOf[at] = &b->kea;
    }
}

static void sortActing(MdtWorldID w) {
    const MdtGraph *g = &w->graph;
    for (int i = 0; i < g->numActing; i++) {
        const int p = g->partition[g->actsOn[i]];
        MEASSERT(p == NONE || w->actingStart[p] < w->constraintRoom);
        if (p != NONE)
            w->actingOf[w->actingStart[p]++] = g->acting[i];
    }
}

/* Merges the records of the last step's partitions into those of the partitions that have their bodies now. */
static void mergeRecords(MdtWorldID w, int numBefore) {
    MdtIslandRecord *const before = w->record;
    w->record = w->lastRecord;
    w->lastRecord = before;
    MEASSERT(w->numPartitions <= w->bodyRoom);
    memset(w->record, 0, (size_t)w->numPartitions * sizeof *w->record);
    for (int i = 0; i < w->graph.numBodies; i++) {
        const int from = w->graph.body[i]->partition, to = w->graph.partition[i];
        if (to != NONE && from != NONE && from < numBefore)
            mdt_recordMerge(&w->record[to], &before[from]);
    }
}

/* Undoes the counting sort's shift: it has moved each start to its partition's end, which is the next one's start. */
static void restoreStarts(MdtWorldID w) {
    for (int p = w->numPartitions; p > 0; p--) {
        w->bodyStart[p] = w->bodyStart[p - 1];
        w->actingStart[p] = w->actingStart[p - 1];
    }
    w->bodyStart[0] = w->actingStart[0] = 0;
    MEASSERT(w->bodyStart[w->numPartitions] <= w->bodies.count);
    MEASSERT(w->actingStart[w->numPartitions] <= w->constraints.count);
}

/* Leaves no partition: nothing moves. */
static void clearIslands(MdtWorldID w) {
    w->numPartitions = 0;
    for (MdtLink *link = w->bodies.first; link; link = link->next)
        ((MdtBodyID)mdt_linkOwner(link))->partition = NONE;
}

/* True if every partition has its own bodies, and only constraints that act on its bodies. */
static MeBool areSeparate(const MdtWorld *w) {
    for (int p = 0; p < w->numPartitions; p++) {
        for (int i = w->bodyStart[p]; i < w->bodyStart[p + 1]; i++)
            if (w->bodyOf[i]->partition != p)
                return MEFALSE;
        for (int i = w->actingStart[p]; i < w->actingStart[p + 1]; i++)
            for (int k = 0; k < 2; k++)
                if (mdt_sideBody(w->actingOf[i], k) && w->actingOf[i]->side[k].body->partition != p)
                    return MEFALSE;
    }
    return METRUE;
}

static void findIslands(MdtWorldID w) {
    mdt_listSort(&w->bodies);
    mdt_listSort(&w->constraints);
    numberBodies(w);
    uniteBodies(w);
    const int numBefore = w->numPartitions;
    numberIslands(w);
    mergeRecords(w, numBefore);
    countActing(w);
    sumCounts(w);
    sortBodies(w);
    sortActing(w);
    restoreStarts(w);
}

static void updateIslands(MdtWorldID w) {
    const int room = w->bodyRoom + w->constraintRoom;
    const MeBool isRoom = mdt_worldReserve(w, w->bodies.count, w->numConstraints, "MdtWorldStep");
    if (room != w->bodyRoom + w->constraintRoom) { /* the arrays have been reallocated */
        w->graph.numActing = 0;
        mdt_graphChanged(w);
    }
    if (!isRoom) {
        clearIslands(w);
        return;
    }
    if (w->graph.seen != w->graph.changes) {
        findIslands(w);
        w->graph.seen = w->graph.changes; /* the bodies enabled meanwhile are in their partitions */
    }
    MEASSERT(w->bodyStart[w->numPartitions] <= w->bodies.count);
    MEVALIDATE(areSeparate(w));
}

void mdt_islandsBegin(MdtWorldID w) {
    MeStageBegin(&w->stage, MDT_GUARD_GRAPH);
    updateIslands(w);
}

void mdt_islandsEnd(MdtWorldID w) {
    MeStageEnd(&w->stage, MDT_GUARD_GRAPH);
}

/* Lists a constraint under its public handle, a group before its contacts. Returns the next index. */
static int listConstraint(MdtWorldID w, MdtConstraintID base, int at) {
    MEASSERT(at < w->numConstraints);
    w->constraintOf[at++] = mdt_constraintPublicHandle(base);
    if (!mdt_isManifold(base) || (base->record.flags & MDT_LONE))
        return at;
    for (MdtPoint *p = mdt_pointFirst((MdtManifold *)(void *)base); p; p = mdt_pointAfter(p))
        w->constraintOf[at++] = (MdtConstraintID)(void *)p;
    return at;
}

void mdt_islandsList(MdtWorldID w) {
    int at = 0;
    const MeBool isRoom = /* callbacks may have created constraints since */
        w->numConstraints <= w->constraintRoom ||
        MeMemoryGrow(&w->constraintOf, 0, (size_t)w->numConstraints, sizeof *w->constraintOf, "MdtWorldStep",
                     "the constraints of a step");
    w->output.constraints = w->constraintOf;
    for (int p = 0; p < w->numPartitions; p++) {
        w->constraintStart[p] = at;
        for (int i = w->actingStart[p]; isRoom && i < w->actingStart[p + 1]; i++)
            at = listConstraint(w, w->actingOf[i], at);
    }
    w->constraintStart[w->numPartitions] = at;
    MEASSERT(at <= w->numConstraints);
}

MdtPartitionInfo mdt_islandInfo(const MdtWorld *w, int p) {
    MEASSERT(p >= 0 && p < w->numPartitions && w->bodyStart[p] < w->bodyStart[p + 1]);
    return (MdtPartitionInfo){.firstBody = w->bodyStart[p],
                              .numBodies = w->bodyStart[p + 1] - w->bodyStart[p],
                              .firstConstraint = w->constraintStart[p],
                              .numConstraints = w->constraintStart[p + 1] - w->constraintStart[p]};
}

MdtIsland mdt_islandOf(const MdtWorld *w, int number, double h) {
    MEASSERT(number >= 0 && number < w->numPartitions && h >= 0);
    return (MdtIsland){.world = w,
                       .worker = &w->workers[0],
                       .number = number,
                       .solver = mdt_choiceRequested(w, number),
                       .record = &w->record[number],
                       .numBodies = w->bodyStart[number + 1] - w->bodyStart[number],
                       .numActing = w->actingStart[number + 1] - w->actingStart[number],
                       .bodies = w->bodyOf + w->bodyStart[number],
                       .acting = w->actingOf + w->actingStart[number],
                       .kea.bodies = w->keaOf + w->bodyStart[number],
                       .whole = w->lastStep,
                       .h = h};
}

void mdt_islandShow(MdtWorldID w, int number) {
    MdtPartitionOutput *po = &w->output;
    po->info[number] = mdt_islandInfo(w, number);
    po->numPartitions = number + 1;
    if (!w->partitionCb) /* the callback has unset itself */
        return;
    const MeProgramCall before = MeProgramEnter("MdtWorldSetPartitionCB");
    w->partitionCb(po, w->partitionCbData);
    MeProgramLeave(&before);
}

/* ---- functions for programs (MdtPartition.h) ---- */

/* The world of the first live body in the list; null if there is none. */
static MdtWorldID worldOf(MeDict *list) {
    for (MeDictNode *node = list ? MeDictFirst(list) : NULL; node; node = MeDictNext(list, node))
        if (mdt_isBody(MeDictNodeGet(node), "MdtUpdatePartitions"))
            return ((MdtBodyID)MeDictNodeGet(node))->world;
    return NULL;
}

/* Marks partitions without a listed body by isDisabled, which is used until MdtUpdatePartitions returns. */
static void markListed(MdtWorldID w, MeDict *list) {
    for (int p = 0; p < w->numPartitions; p++)
        w->output.info[p].isDisabled = METRUE;
    for (MeDictNode *node = MeDictFirst(list); node; node = MeDictNext(list, node)) {
        const MdtBodyID b = MeDictNodeGet(node);
        if (!mdt_isBody(b, "MdtUpdatePartitions"))
            continue;
        if (b->world != w)
            MeWarning(1, "MdtUpdatePartitions: a body belongs to another world; it is left out");
        else if (b->partition >= 0)
            w->output.info[b->partition].isDisabled = MEFALSE;
    }
}

void MEAPI MdtUpdatePartitions(MeDict *enabledBodyList, MdtPartitionOutput *po, const MdtPartitionEndCB pcb,
                               void *pcbdata) {
    if (!mdt_isPointer(__func__, "the partition output", po) ||
        !mdt_isPointer(__func__, "the list of bodies", enabledBodyList))
        return;
    const MdtWorldID w = worldOf(enabledBodyList);
    po->numPartitions = 0;
    if (!w || !MeStageIsFree(&w->stage, __func__))
        return;
    mdt_islandsBegin(w);
    mdt_islandsList(w);
    markListed(w, enabledBodyList);
    *po = w->output;
    po->numPartitions = 0;
    const MeProgramCall before = MeProgramEnter(__func__);
    for (int p = 0; p < w->numPartitions; p++) {
        if (w->output.info[p].isDisabled)
            continue;
        po->info[po->numPartitions++] = mdt_islandInfo(w, p);
        if (pcb)
            pcb(po, pcbdata);
    }
    MeProgramLeave(&before);
    mdt_islandsEnd(w);
}
