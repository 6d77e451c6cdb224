/* Partitions: sets of bodies that constraints tie together (Dynamics guide ch. 1, "Partitioning the World").
 *
 * The world joins nothing: two boxes on the ground are two partitions. A set with one enabled body is enabled whole.
 * Partitions are numbered by their first body, and their bodies and constraints keep the world's order, so that the
 * same scene is solved in the same order every time.
 */
#include "MeAssert.h"
#include "MeDict.h"
#include "mdt_step_i.h"

static MdtBodyID rootOf(MdtBodyID b) {
    while (b->setParent != b) {
        b->setParent = b->setParent->setParent; /* path halving */
        b = b->setParent;
    }
    return b;
}

static void join(MdtBodyID a, MdtBodyID b) {
    MdtBodyID ra = rootOf(a), rb = rootOf(b);
    if (ra == rb)
        return;
    rb->setParent = ra;
    ra->setIsAwake = ra->setIsAwake || rb->setIsAwake;
}

static void startSets(MdtWorldID w) {
    for (MdtLink *link = w->bodies.first; link; link = link->next) {
        MdtBodyID b = link->owner;
        if (mdt_bodyIsPushedAwake(b))
            MdtBodyEnable(b);
        b->setParent = b;
        b->setIsAwake = (b->flags & MDT_ENABLED) != 0;
        b->partition = -1;
    }
}

static void joinSets(MdtWorldID w) {
    for (MdtLink *link = w->constraints.first; link; link = link->next) {
        MdtConstraintID c = link->owner;
        if (mdt_constraintActs(c) && c->side[0].body && c->side[1].body)
            join(c->side[0].body, c->side[1].body);
    }
}

/* Numbers the awake sets and counts their bodies into bodyStart[partition + 1]. */
static void numberPartitions(MdtWorldID w) {
    w->numPartitions = 0;
    w->bodyStart[0] = w->constraintStart[0] = 0;
    for (MdtLink *link = w->bodies.first; link; link = link->next) {
        MdtBodyID b = link->owner, root = rootOf(b);
        if (!root->setIsAwake)
            continue;
        if (!(b->flags & MDT_ENABLED))
            MdtBodyEnable(b);
        if (root->partition < 0) {
            root->partition = w->numPartitions++;
            w->bodyStart[w->numPartitions] = w->constraintStart[w->numPartitions] = 0;
        }
        b->partition = root->partition;
        w->bodyStart[b->partition + 1]++;
    }
}

/* The partition of an enabled constraint; -1: it acts on nothing that moves. */
static int partitionOf(MdtConstraintID c) {
    if (!mdt_constraintActs(c))
        return -1;
    for (int k = 0; k < 2; k++)
        if (c->side[k].body)
            return c->side[k].body->partition;
    return -1;
}

static void countConstraints(MdtWorldID w) {
    for (MdtLink *link = w->constraints.first; link; link = link->next) {
        const int p = partitionOf(link->owner);
        if (p >= 0)
            w->constraintStart[p + 1] += 1 + ((MdtConstraintID)link->owner)->numContacts;
    }
    for (int p = 0; p < w->numPartitions; p++) {
        w->bodyStart[p + 1] += w->bodyStart[p];
        w->constraintStart[p + 1] += w->constraintStart[p];
    }
}

/* A stable counting sort: the starts move to the ends, which are the next partition's starts, and are moved back. */
static void sortIntoPartitions(MdtWorldID w) {
    for (MdtLink *link = w->bodies.first; link; link = link->next) {
        MdtBodyID b = link->owner;
        if (b->partition < 0)
            continue;
        const int at = w->bodyStart[b->partition]++;
        MEASSERT(at < w->bodyStart[b->partition + 1] || b->partition + 1 == w->numPartitions);
        w->bodyOf[at] = b;
        w->keaOf[at] = &b->kea;
    }
    for (MdtLink *link = w->constraints.first; link; link = link->next) {
        MdtConstraintID c = link->owner;
        const int p = partitionOf(c);
        if (p < 0)
            continue;
        w->constraintOf[w->constraintStart[p]++] = c;
        for (MdtConstraintID contact = c->firstContact; contact; contact = contact->nextInGroup)
            w->constraintOf[w->constraintStart[p]++] = contact; /* a group is followed by its contacts */
    }
    for (int p = w->numPartitions; p > 0; p--) {
        w->bodyStart[p] = w->bodyStart[p - 1];
        w->constraintStart[p] = w->constraintStart[p - 1];
    }
    w->bodyStart[0] = w->constraintStart[0] = 0;
    MEASSERT(w->bodyStart[w->numPartitions] <= w->bodies.count);
    MEASSERT(w->constraintStart[w->numPartitions] <= w->constraints.count);
}

/* There are none, and nothing moves. */
static void dropPartitions(MdtWorldID w) {
    w->numPartitions = 0;
    for (MdtLink *link = w->bodies.first; link; link = link->next)
        ((MdtBodyID)link->owner)->partition = -1;
}

/* Has every partition its own bodies, and only constraints that act on one of them? */
static MeBool areSeparate(const MdtWorld *w) {
    for (int p = 0; p < w->numPartitions; p++) {
        for (int i = w->bodyStart[p]; i < w->bodyStart[p + 1]; i++)
            if (w->bodyOf[i]->partition != p)
                return MEFALSE;
        for (int i = w->constraintStart[p]; i < w->constraintStart[p + 1]; i++)
            for (int k = 0; k < 2; k++)
                if (w->constraintOf[i]->side[k].body && w->constraintOf[i]->side[k].body->partition != p)
                    return MEFALSE;
    }
    return METRUE;
}

void mdt_islandsUpdate(MdtWorldID w) {
    if (!mdt_worldReserve(w, w->bodies.count, w->constraints.count, "MdtWorldStep")) {
        dropPartitions(w);
        return;
    }
    mdt_listSort(&w->bodies);
    mdt_listSort(&w->constraints);
    startSets(w);
    joinSets(w);
    numberPartitions(w);
    countConstraints(w);
    sortIntoPartitions(w);
    MEASSERT(w->bodyStart[w->numPartitions] <= w->bodies.count);
    MEASSERT(w->constraintStart[w->numPartitions] <= w->constraints.count);
    MEVALIDATE(areSeparate(w));
}

MdtPartitionInfo mdt_islandInfo(MdtWorldID w, int p) {
    return (MdtPartitionInfo){.firstBody = w->bodyStart[p],
                              .numBodies = w->bodyStart[p + 1] - w->bodyStart[p],
                              .firstConstraint = w->constraintStart[p],
                              .numConstraints = w->constraintStart[p + 1] - w->constraintStart[p]};
}

MdtIsland mdt_islandOf(MdtWorldID w, int number, double h) {
    const MdtPartitionInfo info = mdt_islandInfo(w, number);
    return (MdtIsland){.world = w,
                       .number = number,
                       .numBodies = info.numBodies,
                       .numConstraints = info.numConstraints,
                       .bodies = w->bodyOf + info.firstBody,
                       .constraints = w->constraintOf + info.firstConstraint,
                       .whole = w->lastStep,
                       .h = h};
}

void mdt_islandShow(const MdtIsland *p) {
    MdtPartitionOutput *po = &p->world->output;
    po->info[p->number] = mdt_islandInfo(p->world, p->number);
    po->numPartitions = p->number + 1;
    p->world->partitionCb(po, p->world->partitionCbData);
}

/* ---- for programs (MdtPartition.h) ---- */

/* The world of the first body in the list; null: there is none. */
static MdtWorldID worldOf(MeDict *list) {
    for (MeDictNode *node = list ? MeDictFirst(list) : NULL; node; node = MeDictNext(list, node))
        if (mdt_isBody(MeDictNodeGet(node), "MdtUpdatePartitions"))
            return ((MdtBodyID)MeDictNodeGet(node))->world;
    return NULL;
}

/* isDisabled says, for the moment, that a partition was not asked for. */
static void chooseListed(MdtWorldID w, MeDict *list) {
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
    if (!w)
        return;
    mdt_islandsUpdate(w);
    chooseListed(w, enabledBodyList);
    *po = w->output;
    po->numPartitions = 0;
    for (int p = 0; p < w->numPartitions; p++) {
        if (w->output.info[p].isDisabled)
            continue;
        po->info[po->numPartitions++] = mdt_islandInfo(w, p);
        if (pcb)
            pcb(po, pcbdata);
    }
}
