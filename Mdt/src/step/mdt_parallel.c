/* A world's partitions, by its workers.
 *
 *     put to rest      one after the other, on the calling thread: programs are told
 *     in batches       many that have few bodies each, by the fast solver as one system (mdt_batch.c): a task each
 *     together         a partition that is a large share of all work: one after the other, each by all workers (Kea's
 *                      fast solver divides it among them)
 *     at once          all others: tasks of about the same size, the largest partitions first
 *
 * The rule for order: partitions share no body and no constraint, so that a step of one neither reads nor writes what
 * is another's. A worker has scratch memory, and a cache that finds what it would make anew; neither shows in an
 * answer. Messages wait, and are sent in the partitions' order. Where a program's function is called in the middle of a
 * partition's step, partitions are stepped one after the other, in their order.
 */
#include "MeAssert.h"
#include "step/mdt_step_i.h"

/* The least size of a task, in bodies and constraints: 150 us where these are chains of balls; taking it costs less
 * than 1. */
enum { TASK_SIZE = 32 };
/* The least size of a step for which workers are called: .6 ms of such chains. A sleeping thread needs up to .35 ms to
 * wake, on a virtual machine. */
enum { STEP_SIZE = 4 * TASK_SIZE };
enum { SIZES = 32 }; /* powers of two */

/* ---- rest, and one after the other ---- */

static void sleepIfDue(MdtIsland *p, MeBool safely) {
    const double remainingTime = p->h;
    MeBool *isDisabled = &p->world->output.info[p->number].isDisabled;
    if (!p->world->partitionCb) /* else it has said so */
        *isDisabled = mdt_islandIsToSleep(p);
    if (!*isDisabled)
        return;
    if (safely)
        p->h = mdt_lagSafeStep(p);
    mdt_lagSet(p, remainingTime);
    mdt_islandSleep(p);
    p->h = remainingTime;
}

static void sleepAllDue(MdtWorldID w, double h, MeBool safely) {
    for (int i = 0; i < w->numPartitions; i++) {
        MdtIsland p = mdt_islandOf(w, i, h);
        sleepIfDue(&p, safely);
    }
}

static void advanceInOrder(MdtWorldID w, double h, MeBool safely) {
    mdt_batchesFind(w, h, safely, NULL);
    for (int i = 0; i < w->batches.count; i++) {
        MdtIsland p = mdt_batchOf(w, i, h);
        mdt_batchAdvance(&p);
    }
    mdt_reportBatchesEnd(w);
    for (int i = 0; i < w->numPartitions; i++) {
        if (mdt_isInBatch(w, i))
            continue;
        MdtIsland p = mdt_islandOf(w, i, h);
        mdt_islandAdvance(&p, safely);
    }
}

/* The callback sees a partition when those before it have been stepped, and says whether it is put to rest. */
static void showInOrder(MdtWorldID w, double h, MeBool safely) {
    mdt_islandsList(w);
    for (int i = 0; i < w->numPartitions; i++) {
        MdtIsland p = mdt_islandOf(w, i, h);
        mdt_islandShow(&p);
        sleepIfDue(&p, safely);
        MeStageBegin(&w->stage, MDT_GUARD_STATES);
        mdt_islandAdvance(&p, safely);
        MeStageEnd(&w->stage, MDT_GUARD_STATES);
    }
}

/* ---- by workers ---- */

typedef struct Stepping {
    MdtWorldID world;
    double h;
    MeBool safely;
    int numTasks;
    int *partition, *firstOf; /* by task: firstOf[t] .. firstOf[t + 1] */
} Stepping;

static int sizeOfPartition(const MdtWorld *w, int i) {
    return w->bodyStart[i + 1] - w->bodyStart[i] + w->actingStart[i + 1] - w->actingStart[i];
}

static int sizeOfAllPartitions(const MdtWorld *w) {
    return w->bodyStart[w->numPartitions] + w->actingStart[w->numPartitions];
}

/* More than one worker's share of all work, and enough of it for the fast solver. */
static MeBool isForTeam(const MdtWorld *w, int i) {
    const int bodies = w->bodyStart[i + 1] - w->bodyStart[i];
    return bodies >= MDT_LARGE_ISLAND && !w->record[i].isExactFirst && mdt_choiceRequested(w, i) != MdtSolverExact &&
           (double)sizeOfPartition(w, i) * w->numWorkers > (double)sizeOfAllPartitions(w);
}

/* Steps a partition, or a batch, on a worker's memory; what it has to say is held. */
static void stepOn(const Stepping *s, MdtIsland *p, int worker, MeTeam *team) {
    p->worker = &s->world->workers[worker];
    p->team = team;
    p->clock = &p->lap;
    MeMessageBuffer *const before = MeMessagesBuffer(&p->worker->messages);
    p->worker->messages.key = p->number;
    if (p->numMembers > 0)
        mdt_batchAdvance(p);
    else
        mdt_islandAdvance(p, s->safely);
    MeMessagesBuffer(before);
}

static void stepPartition(const Stepping *s, int partition, int worker, MeTeam *team) {
    MdtIsland p = mdt_islandOf(s->world, partition, s->h);
    stepOn(s, &p, worker, team);
}

static void stepBatch(const Stepping *s, int batch, int worker) {
    MdtIsland p = mdt_batchOf(s->world, batch, s->h);
    stepOn(s, &p, worker, NULL);
}

static void advanceByTeam(const Stepping *s) {
    for (int i = 0; i < s->world->numPartitions; i++)
        if (isForTeam(s->world, i))
            stepPartition(s, i, 0, s->world->team);
}

static int log2Of(int size) {
    int log = 0;
    while (size >>= 1)
        log++;
    return log;
}

/* Is it none of those that are taken by all workers, and in no batch? */
static MeBool isForOneWorker(const MdtWorld *w, int i) {
    return !mdt_isInBatch(w, i) && !isForTeam(w, i);
}

/* Sorts the other partitions by size, in powers of two, the largest first: a counting sort. Returns how many. */
static int sortPartitions(Stepping *s) {
    int first[SIZES + 1] = {0};
    const MdtWorld *w = s->world;
    for (int i = 0; i < w->numPartitions; i++)
        if (isForOneWorker(w, i))
            first[SIZES - log2Of(sizeOfPartition(w, i))]++;
    for (int k = 0; k < SIZES; k++)
        first[k + 1] += first[k];
    for (int i = 0; i < w->numPartitions; i++)
        if (isForOneWorker(w, i))
            s->partition[first[SIZES - 1 - log2Of(sizeOfPartition(w, i))]++] = i;
    return first[SIZES - 1];
}

static void makeTasks(Stepping *s) {
    const int count = sortPartitions(s);
    int size = 0;
    s->numTasks = 0;
    s->firstOf[0] = 0;
    for (int i = 0; i < count; i++) {
        size += sizeOfPartition(s->world, s->partition[i]);
        if (size < TASK_SIZE && i + 1 < count)
            continue;
        s->firstOf[++s->numTasks] = i + 1;
        size = 0;
    }
}

/* Batches are the first tasks. */
static void MEAPI doTask(void *context, int task, int worker) {
    const Stepping *s = context;
    const int batches = s->world->batches.count, own = task - batches;
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

static void advanceByWorkers(MdtWorldID w, double h, MeBool safely) {
    Stepping s = {.world = w, .h = h, .safely = safely, .partition = w->taskOf, .firstOf = w->taskOf + w->bodyRoom};
    MeTeamOpen(w->team);
    mdt_batchesFind(w, h, safely, w->team);
    advanceByTeam(&s);
    makeTasks(&s);
    MeTeamRun(w->team, w->batches.count + s.numTasks, doTask, &s);
    MeTeamClose(w->team);
    sendMessages(w);
}

/* ---- all partitions ---- */

/* Rows that the program writes, or ranks. */
static MeBool callsProgram(const MdtWorld *w) {
    return w->userConstraints > 0 || w->importance;
}

static void warnOfSurfaces(MdtWorldID w) {
    for (int i = 0; i < w->numWorkers; i++) {
        mdt_surfaceWarn(w, w->workers[i].surfaceProblems);
        w->workers[i].surfaceProblems = 0;
    }
}

void mdt_islandsStep(MdtWorldID w, double h, MeBool safely) {
    w->batches.count = 0;
    mdt_choicesBegin(w, METRUE);
    if (w->partitionCb)
        showInOrder(w, h, safely);
    else {
        sleepAllDue(w, h, safely);
        MeStageBegin(&w->stage, MDT_GUARD_STATES);
        if (w->team && !callsProgram(w) && sizeOfAllPartitions(w) >= STEP_SIZE)
            advanceByWorkers(w, h, safely);
        else
            advanceInOrder(w, h, safely);
        MeStageEnd(&w->stage, MDT_GUARD_STATES);
    }
    mdt_choicesEnd(w);
    warnOfSurfaces(w);
}
