/* Distribution of a world's partitions to its workers.
 *
 *     sleep            one after the other, on the calling thread, since programs are notified
 *     in batches       small partitions, which the fast solver solves together (mdt_batch.c): one task per batch
 *     together         a partition that is a large share of all work: one after the other, each by all workers (Kea's
 *                      fast solver divides it among them)
 *     in parallel      all others: tasks of about equal size, beginning with the largest partitions
 *
 * Order: results do not depend on the distribution. Partitions share no body and no constraint, so that the step of one
 * neither reads nor writes data of another. A worker's scratch memory and its cache of reusable results do not affect
 * answers. Messages are buffered and sent in the order of partitions. If a callback of the program is called in the
 * middle of a partition's step, partitions are stepped one after the other, in their order.
 */
#include "MeAssert.h"
#include "step/mdt_step_i.h"

/* Minimum size of a task, in bodies and constraints: 150 us for chains of balls; starting a task costs less than 1 us.
 * */
enum { TASK_SIZE = 32 };
enum { SIZE_CLASSES = 32 }; /* size classes of partitions: powers of two */

/* ---- sleep, and stepping in order ---- */

static void sleepIfDue(MdtIsland *p, MeBool stopAtSafeTime) {
    const double remainingTime = p->h;
    MeBool *isDisabled = &p->world->output.info[p->number].isDisabled;
    if (!p->world->partitionCb) /* else the callback has decided */
        *isDisabled = mdt_islandIsToSleep(p);
    if (!*isDisabled)
        return;
    if (stopAtSafeTime)
        p->h = mdt_lagSafeStep(p);
    mdt_lagSet(p, remainingTime);
    mdt_islandSleep(p);
    p->h = remainingTime;
}

static void sleepAllDue(MdtWorldID w, double h, MeBool stopAtSafeTime) {
    for (int i = 0; i < w->numPartitions; i++) {
        MdtIsland p = mdt_islandOf(w, i, h);
        sleepIfDue(&p, stopAtSafeTime);
    }
}

static void advanceInOrder(MdtWorldID w, double h, MeBool stopAtSafeTime) {
    mdt_batchesFind(w, h, stopAtSafeTime, NULL);
    for (int i = 0; i < w->batches.count; i++) {
        MdtIsland p = mdt_batchOf(w, i, h);
        mdt_batchAdvance(&p);
    }
    mdt_reportBatchesEnd(w);
    for (int i = 0; i < w->numPartitions; i++) {
        if (mdt_isInBatch(w, i))
            continue;
        MdtIsland p = mdt_islandOf(w, i, h);
        p.timing = &w->timing;
        mdt_islandAdvance(&p, stopAtSafeTime);
    }
}

/* The program's callback gets each partition after those before it have been stepped, and decides whether it sleeps. */
static void stepWithCallback(MdtWorldID w, double h, MeBool stopAtSafeTime) {
    mdt_islandsList(w);
    for (int i = 0; i < w->numPartitions; i++) {
        MdtIsland p = mdt_islandOf(w, i, h);
        p.timing = &w->timing;
        mdt_islandShow(w, i);
        sleepIfDue(&p, stopAtSafeTime);
        MeStageBegin(&w->stage, MDT_GUARD_STATES);
        mdt_islandAdvance(&p, stopAtSafeTime);
        MeStageEnd(&w->stage, MDT_GUARD_STATES);
    }
}

/* ---- stepping by workers ---- */

typedef struct Stepping {
    MdtWorldID world;
    double h;
    MeBool stopAtSafeTime;
    int numTasks;
    int *partition, *firstOf; /* task t has the entries firstOf[t] .. firstOf[t + 1] - 1 of `partition` */
} Stepping;

static int sizeOfPartition(const MdtWorld *w, int i) {
    return w->bodyStart[i + 1] - w->bodyStart[i] + w->actingStart[i + 1] - w->actingStart[i];
}

static int sizeOfAllPartitions(const MdtWorld *w) {
    return w->bodyStart[w->numPartitions] + w->actingStart[w->numPartitions];
}

/* True if the partition is more than one worker's share of all work, and large enough for the fast solver. */
static MeBool isForAllWorkers(const MdtWorld *w, int i) {
    const int bodies = w->bodyStart[i + 1] - w->bodyStart[i];
    return bodies >= MDT_LARGE_ISLAND && !w->record[i].isExactFirst && mdt_choiceRequested(w, i) != MdtSolverExact &&
           (double)sizeOfPartition(w, i) * w->numWorkers > (double)sizeOfAllPartitions(w);
}

/* Steps a partition or a batch with a worker's memory, and buffers its messages. */
static void stepOnWorker(const Stepping *s, MdtIsland *p, int worker, MeTeam *team) {
    MEASSERT(worker >= 0 && worker < s->world->numWorkers);
    p->worker = &s->world->workers[worker];
    p->team = team;
    MeMessageBuffer *const before = MeMessagesBuffer(&p->worker->messages);
    p->worker->messages.key = p->number;
    if (p->numMembers > 0)
        mdt_batchAdvance(p);
    else
        mdt_islandAdvance(p, s->stopAtSafeTime);
    MeMessagesBuffer(before);
}

static void stepPartition(const Stepping *s, int partition, int worker, MeTeam *team) {
    MdtIsland p = mdt_islandOf(s->world, partition, s->h);
    stepOnWorker(s, &p, worker, team);
}

static void stepBatch(const Stepping *s, int batch, int worker) {
    MdtIsland p = mdt_batchOf(s->world, batch, s->h);
    stepOnWorker(s, &p, worker, NULL);
}

static void advanceByTeam(const Stepping *s) {
    for (int i = 0; i < s->world->numPartitions; i++)
        if (isForAllWorkers(s->world, i))
            stepPartition(s, i, 0, s->world->team);
}

static int log2Of(int size) {
    MEASSERT(size > 0);
    int log = 0;
    while (size >>= 1)
        log++;
    return log;
}

/* True if neither all workers step the partition together, nor a batch has it. */
static MeBool isForOneWorker(const MdtWorld *w, int i) {
    return !mdt_isInBatch(w, i) && !isForAllWorkers(w, i);
}

/* Sorts these partitions by size class, the largest first, with a counting sort. Returns their number. */
static int sortPartitions(Stepping *s) {
    int first[SIZE_CLASSES + 1] = {0};
    const MdtWorld *w = s->world;
    for (int i = 0; i < w->numPartitions; i++)
        if (isForOneWorker(w, i))
            first[SIZE_CLASSES - log2Of(sizeOfPartition(w, i))]++;
    for (int k = 0; k < SIZE_CLASSES; k++)
        first[k + 1] += first[k];
    for (int i = 0; i < w->numPartitions; i++)
        if (isForOneWorker(w, i))
            s->partition[first[SIZE_CLASSES - 1 - log2Of(sizeOfPartition(w, i))]++] = i;
    return first[SIZE_CLASSES - 1];
}

static void makeTasks(Stepping *s) {
    const int count = sortPartitions(s);
    int size = 0;
    s->numTasks = 0;
    MEASSERT(count <= s->world->numPartitions);
    s->firstOf[0] = 0;
    for (int i = 0; i < count; i++) {
        size += sizeOfPartition(s->world, s->partition[i]);
        if (size < TASK_SIZE && i + 1 < count)
            continue;
        s->firstOf[++s->numTasks] = i + 1;
        size = 0;
    }
    MEASSERT(s->firstOf[s->numTasks] == count);
}

/* Runs a task: the first ones are batches. */
static void MEAPI runTask(void *context, int task, int worker) {
    const Stepping *s = context;
    const int batches = s->world->batches.count, own = task - batches;
    MEASSERT(own < s->numTasks);
    if (task < batches)
        stepBatch(s, task, worker);
    for (int i = own < 0 ? 0 : s->firstOf[own]; own >= 0 && i < s->firstOf[own + 1]; i++)
        stepPartition(s, s->partition[i], worker, NULL);
}

static void sendMessages(MdtWorldID w) {
    MeMessageBuffer *buffered[MeTaskMaxWorkers];
    for (int i = 0; i < w->numWorkers; i++)
        buffered[i] = &w->workers[i].messages;
    MeMessagesSend(buffered, w->numWorkers);
}

static void advanceByWorkers(MdtWorldID w, double h, MeBool stopAtSafeTime) {
    Stepping s = {.world = w,
                  .h = h,
                  .stopAtSafeTime = stopAtSafeTime,
                  .partition = w->taskOf,
                  .firstOf = w->taskOf + w->bodyRoom};
    MeTeamOpen(w->team);
    mdt_batchesFind(w, h, stopAtSafeTime, w->team);
    advanceByTeam(&s);
    makeTasks(&s);
    MeTeamRun(w->team, w->batches.count + s.numTasks, runTask, &s);
    MeTeamClose(w->team);
    sendMessages(w);
}

/* ---- all partitions ---- */

/* True if callbacks of the program make rows or rank contacts during the step. */
static MeBool needsCallbacks(const MdtWorld *w) {
    return w->userConstraints > 0 || w->importance;
}

static void warnOfSurfaces(MdtWorldID w) {
    for (int i = 0; i < w->numWorkers; i++) {
        mdt_surfaceWarn(w, w->workers[i].surfaceProblems);
        w->workers[i].surfaceProblems = 0;
    }
}

void mdt_islandsStep(MdtWorldID w, double h, MeBool stopAtSafeTime) {
    /* Minimum size of a step that is distributed: .6 ms for chains of balls. A sleeping thread needs up to .35 ms to
     * wake, on a virtual machine. */
    const int distributedSize = 4 * TASK_SIZE;
    w->batches.count = 0;
    mdt_choicesBegin(w, METRUE);
    if (w->partitionCb)
        stepWithCallback(w, h, stopAtSafeTime);
    else {
        sleepAllDue(w, h, stopAtSafeTime);
        MeStageBegin(&w->stage, MDT_GUARD_STATES);
        if (w->team && !needsCallbacks(w) && sizeOfAllPartitions(w) >= distributedSize)
            advanceByWorkers(w, h, stopAtSafeTime);
        else
            advanceInOrder(w, h, stopAtSafeTime);
        MeStageEnd(&w->stage, MDT_GUARD_STATES);
    }
    mdt_choicesEnd(w);
    warnOfSurfaces(w);
}
