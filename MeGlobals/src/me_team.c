/* Teams of workers: parallel loops, run by the program's tasks (MeTeam.h).
 *
 * The items of a loop are divided into one share per worker. A worker first processes its own share, then the remaining
 * items of others. A share is one atomic word: the loop's number, the number of items, and the next item. Only the
 * opening thread writes the loop's description, while no item is being processed: a worker that has claimed an item may
 * read it until the item is done; a worker that comes too late claims nothing. The items of a pipe are all in one
 * share, from which they are claimed as buffers become free. Data that different threads write are in different cache
 * lines.
 */
#define _POSIX_C_SOURCE 199309L /* sched_yield */
#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMath.h"
#include "MeProfile.h"
#include "MeTeam.h"
#include <fenv.h>
#include <sched.h>
#include <stdatomic.h>
#include <string.h>

enum { ITEM_BITS = 20 };            /* bits of an index, and of a count, in a claim; the loop's number has the rest */
enum { MAX_AHEAD = 64 };            /* maximum number of buffers of a pipe */
enum { SPINS_BEFORE_YIELD = 2000 }; /* some 50 us: longer than the time between two loops of a solver's pass */

typedef struct Share {
    _Alignas(ME_CACHE_LINE) _Atomic(MeU64) claim;
} Share;

typedef struct Worker {
    _Alignas(ME_CACHE_LINE) MeTeam *team;
    int index;
    void *task;               /* identifier of the program's task; null: none is enqueued */
    MeU64 busy;               /* ticks of work; written by the worker */
    MeMessageBuffer messages; /* messages of a loop's items; written by the worker */
} Worker;

/* The loop that all workers run now. */
typedef struct Loop {
    MeTeamWork work; /* in a pipe: make */
    void *context;
    int items;
} Loop;

/* Its address identifies a thread. */
static _Thread_local char threadMark;

struct MeTeam {
    MeEnqueueTaskCB enqueue;
    MeFinishTaskCB finish;
    void *userContext;
    int size, depth;
    MeBool isRunning, isTimed, isKept, hasTasks; /* hasTasks: the workers' tasks are enqueued */
    MeTeamWatchCB watch;
    void *watchContext;
    Worker *worker;
    Loop loop;
    const char *opener;                                 /* threadMark of the opening thread, */
    const char *caller;                                 /* its MeCallerSet, */
    fenv_t arithmetic;                                  /* and its floating-point environment */
    _Alignas(ME_CACHE_LINE) atomic_uint number;         /* number of the loop; odd while the team is closed */
    _Alignas(ME_CACHE_LINE) atomic_int done;            /* completed items of a loop */
    Share share[MeTaskMaxWorkers];                      /* of a loop */
    Share pipe;                                         /* share of all items of a pipe */
    Share used;                                         /* of a pipe: number of buffers, and of used items */
    _Alignas(ME_CACHE_LINE) atomic_int made[MAX_AHEAD]; /* by buffer: 1 + the last item made in it */
    MeMessageBuffer messages[MAX_AHEAD];                /* messages of that item */
};

static MeU64 packClaim(MeU64 number, int items, int next) {
    MEASSERT(items >= 0 && items < 1 << ITEM_BITS && next >= 0 && next < 1 << ITEM_BITS);
    return number << 2 * ITEM_BITS | (MeU64)items << ITEM_BITS | (MeU64)next;
}

static MeU64 loopNumberOf(MeU64 claim) {
    return claim >> 2 * ITEM_BITS;
}

static int nextItemOf(MeU64 claim) {
    return (int)(claim & ((1u << ITEM_BITS) - 1));
}

static int itemCountOf(MeU64 claim) {
    return (int)(claim >> ITEM_BITS & ((1u << ITEM_BITS) - 1));
}

static void spinOrYield(int *spins) {
    if (++*spins > SPINS_BEFORE_YIELD)
        sched_yield();
#if defined(__x86_64__) || defined(__i386__)
    else
        __builtin_ia32_pause();
#endif
}

/* ---- life -------------------------------------------------------------------------------------------------------- */

MeTeam *MEAPI MeTeamCreate(int workers, MeEnqueueTaskCB enqueue, MeFinishTaskCB finish, void *userContext,
                           const char *function) {
    MEASSERT(workers >= 1 && workers <= MeTaskMaxWorkers && (workers == 1 || (enqueue && finish)));
    MeTeam *t = MeMemoryTakeAligned(1, sizeof *t, ME_CACHE_LINE, function, "a team of workers");
    Worker *worker =
        t ? MeMemoryTakeAligned((size_t)workers, sizeof *worker, ME_CACHE_LINE, function, "workers") : NULL;
    if (!worker) {
        MeMemoryGiveAligned(t);
        return NULL;
    }
    memset(t, 0, sizeof *t);
    memset(worker, 0, (size_t)workers * sizeof *worker);
    t->enqueue = enqueue;
    t->finish = finish;
    t->userContext = userContext;
    t->size = workers;
    t->worker = worker;
    atomic_init(&t->number, 1);
    for (int i = 0; i < workers; i++) {
        worker[i].team = t;
        worker[i].index = i;
    }
    return t;
}

void MEAPI MeTeamDestroy(MeTeam *t) {
    if (!t)
        return;
    MEASSERT(t->depth == 0);
    MeMemoryGiveAligned(t->worker);
    MeMemoryGiveAligned(t);
}

int MEAPI MeTeamGetSize(const MeTeam *t) {
    return t ? t->size : 1;
}

void MEAPI MeTeamTime(MeTeam *t, MeBool isTimed) {
    if (!t)
        return;
    t->isTimed = isTimed;
    for (int i = 0; i < t->size; i++)
        t->worker[i].busy = 0;
}

double MEAPI MeTeamGetBusyTime(const MeTeam *t, int worker) {
    return t && worker >= 0 && worker < t->size ? (double)t->worker[worker].busy / (double)MeProfileGetClockSpeed() : 0;
}

void MEAPI MeTeamWatch(MeTeam *t, MeTeamWatchCB watch, void *watchContext) {
    if (!t)
        return;
    MEASSERT(t->depth == 0 && !t->hasTasks);
    t->watch = watch;
    t->watchContext = watchContext;
}

/* ---- what a worker does ------------------------------------------------------------------------------------------ */

/* Claims the next item of a share; -1: none is left. */
static int claimItem(Share *share) {
    MeU64 claim = atomic_load_explicit(&share->claim, memory_order_acquire);
    while (nextItemOf(claim) < itemCountOf(claim))
        if (atomic_compare_exchange_weak_explicit(&share->claim, &claim, claim + 1, memory_order_acq_rel,
                                                  memory_order_acquire))
            return nextItemOf(claim);
    return -1;
}

/* startClock and stopClock add the time between them to a worker's busy time. */
static MeU64 startClock(const MeTeam *t) {
    MeProfileTimerResult now = {0};
    if (t->isTimed)
        MeProfileGetTimerValue(&now);
    return now.ticks;
}

static void stopClock(MeTeam *t, int worker, MeU64 start) {
    t->worker[worker].busy += startClock(t) - start;
}

/* The first item of a worker's share; for share = size, the number of items. */
static int firstItemOf(const MeTeam *t, int share) {
    MEASSERT(share >= 0 && share <= t->size);
    return (int)((long)t->loop.items * share / t->size);
}

static void notifyObserver(const MeTeam *t, MeTeamEvent event, int number, int ahead) {
    if (t->watch)
        t->watch(&(MeTeamNews){event, number, ahead}, t->watchContext);
}

/* Processes the remaining items of a share; returns their number. */
static int runShare(MeTeam *t, int share, int worker) {
    int done = 0;
    for (int item = claimItem(&t->share[share]); item >= 0; item = claimItem(&t->share[share]), done++) {
        t->worker[worker].messages.key = firstItemOf(t, share) + item;
        t->loop.work(t->loop.context, firstItemOf(t, share) + item, worker);
        notifyObserver(t, MeTeamItemDone, firstItemOf(t, share) + item, 0);
    }
    return done;
}

static void runLoop(MeTeam *t, int worker) {
    const MeU64 start = startClock(t);
    MeMessageBuffer *const before = MeMessagesBuffer(&t->worker[worker].messages);
    int done = 0;
    for (int i = 0; i < t->size; i++)
        done += runShare(t, (worker + i) % t->size, worker);
    MeMessagesBuffer(before);
    stopClock(t, worker, start);
    if (done > 0)
        atomic_fetch_add_explicit(&t->done, done, memory_order_release);
}

/* ---- pipes ---- */

/* Claims the next item of a pipe for which a buffer is free; -1: none now, or all are claimed. */
static int claimPipeItem(MeTeam *t) {
    MeU64 claim = atomic_load_explicit(&t->pipe.claim, memory_order_acquire);
    while (nextItemOf(claim) < itemCountOf(claim)) {
        const MeU64 used = atomic_load_explicit(&t->used.claim, memory_order_acquire);
        if (loopNumberOf(used) != loopNumberOf(claim) || nextItemOf(claim) >= nextItemOf(used) + itemCountOf(used))
            return -1;
        if (atomic_compare_exchange_weak_explicit(&t->pipe.claim, &claim, claim + 1, memory_order_acq_rel,
                                                  memory_order_acquire))
            return nextItemOf(claim);
    }
    return -1;
}

static MeBool hasUnclaimedItems(const MeTeam *t) {
    const MeU64 claim = atomic_load_explicit(&t->pipe.claim, memory_order_relaxed);
    return nextItemOf(claim) < itemCountOf(claim);
}

/* Makes one item of a pipe, if one can be claimed. */
static MeBool makePipeItem(MeTeam *t, int worker) {
    const MeU64 start = startClock(t);
    const int item = claimPipeItem(t);
    if (item < 0)
        return MEFALSE;
    const int ahead = itemCountOf(atomic_load_explicit(&t->used.claim, memory_order_relaxed));
    MEASSERT(ahead >= 1 && ahead <= MAX_AHEAD);
    MeMessageBuffer *const before = MeMessagesBuffer(&t->messages[item % ahead]);
    t->loop.work(t->loop.context, item, worker);
    notifyObserver(t, MeTeamItemDone, item, 0);
    MeMessagesBuffer(before);
    stopClock(t, worker, start); /* before the item is published, as the opening thread may read the time then */
    atomic_store_explicit(&t->made[item % ahead], item + 1, memory_order_release);
    return METRUE;
}

static void makePipeItems(MeTeam *t, int worker) {
    for (int spins = 0; hasUnclaimedItems(t);)
        if (makePipeItem(t, worker))
            spins = 0;
        else
            spinOrYield(&spins);
}

/* ---- tasks ------------------------------------------------------------------------------------------------------- */

static void runLoopsUntilClosed(MeTeam *t, int worker) {
    unsigned int seen = 0;
    for (int spins = 0;;) {
        const unsigned int number = atomic_load_explicit(&t->number, memory_order_acquire);
        if (number & 1) /* closed */
            return;
        if (number == seen) {
            spinOrYield(&spins);
            continue;
        }
        seen = number;
        spins = 0;
        runLoop(t, worker);
        makePipeItems(t, worker);
    }
}

/* The task of a worker while the team is open. Sets the opener's floating-point environment and caller name, as threads
 * of the program may have others. Does nothing if it is called on the opening thread, as it is enqueued. */
static void MEAPI runWorkerTask(void *context) {
    Worker *w = context;
    MeTeam *t = w->team;
    fenv_t before;
    if (t->opener == &threadMark)
        return;
    fegetenv(&before);
    MEASSERT(w->index >= 1 && w->index < t->size);
    fesetenv(&t->arithmetic);
    const char *callerBefore = MeCallerSet(NULL);
    MeCallerSet(t->caller);
    runLoopsUntilClosed(t, w->index);
    MeCallerSet(NULL);
    MeCallerSet(callerBefore);
    fesetenv(&before);
}

static void advanceLoopNumber(MeTeam *t, unsigned int step) {
    const unsigned int number = atomic_load_explicit(&t->number, memory_order_relaxed);
    atomic_store_explicit(&t->number, number + step, memory_order_release);
}

/* For messages: the function that sets the program's task callbacks (MdtWorldSetTaskPool sets those of a pool). */
static const char setBy[] = "MdtWorldSetTaskCallbacks";

static void *enqueueTask(MeTeam *t, int worker) {
    const MeProgramCall before = MeProgramEnter(setBy);
    void *const task = t->enqueue(runWorkerTask, &t->worker[worker], t->userContext);
    MeProgramLeave(&before);
    return task;
}

static void finishTask(MeTeam *t, int worker) {
    const MeProgramCall before = MeProgramEnter(setBy);
    t->finish(t->worker[worker].task, t->userContext);
    MeProgramLeave(&before);
}

static void enqueueWorkers(MeTeam *t) {
    MEASSERT(!t->hasTasks);
    t->opener = &threadMark;
    t->caller = MeCallerName(NULL);
    fegetenv(&t->arithmetic);
    t->hasTasks = METRUE;
    advanceLoopNumber(t, 1);
    for (int i = 1; i < t->size; i++)
        t->worker[i].task = enqueueTask(t, i);
}

static void finishWorkers(MeTeam *t) {
    MEASSERT(t->hasTasks);
    advanceLoopNumber(t, 1);
    for (int i = 1; i < t->size; i++) {
        if (t->worker[i].task)
            finishTask(t, i);
        t->worker[i].task = NULL;
    }
    t->hasTasks = MEFALSE;
}

void MEAPI MeTeamOpen(MeTeam *t) {
    if (t && t->depth++ == 0 && !t->hasTasks)
        enqueueWorkers(t);
}

void MEAPI MeTeamClose(MeTeam *t) {
    if (!t || --t->depth > 0)
        return;
    MEASSERT(t->depth == 0 && !t->isRunning);
    if (!t->isKept)
        finishWorkers(t);
}

void MEAPI MeTeamKeep(MeTeam *t) {
    if (t)
        t->isKept = METRUE;
}

void MEAPI MeTeamRelease(MeTeam *t) {
    if (!t)
        return;
    MEASSERT(t->depth == 0);
    t->isKept = MEFALSE;
    if (t->hasTasks)
        finishWorkers(t);
}

/* ---- loops ------------------------------------------------------------------------------------------------------- */

static MeBool isSerial(const MeTeam *t, int items) {
    return !t || t->size == 1 || t->depth == 0 || t->isRunning || items <= 1;
}

/* Sets the loop that workers will run; returns its number. No worker reads it now, as none has an item. */
static MeU64 setLoop(MeTeam *t, int items, MeTeamWork work, void *context) {
    MEASSERT(items < 1 << ITEM_BITS);
    t->isRunning = METRUE;
    t->loop = (Loop){.work = work, .context = context, .items = items};
    atomic_store_explicit(&t->done, 0, memory_order_relaxed);
    return atomic_load_explicit(&t->number, memory_order_relaxed) + 2;
}

/* Sends the workers' messages in the order of items. */
static void sendMessages(MeTeam *t) {
    MeMessageBuffer *buffered[MeTaskMaxWorkers];
    for (int i = 0; i < t->size; i++)
        buffered[i] = &t->worker[i].messages;
    MeMessagesSend(buffered, t->size);
}

static void runSerially(MeTeam *t, int items, MeTeamWork work, void *context) {
    const MeBool isObserved = t && t->depth > 0 && !t->isRunning && items == 1; /* reported as a loop of the team */
    if (isObserved)
        notifyObserver(t, MeTeamLoopBegins, items, 0);
    for (int i = 0; i < items; i++)
        work(context, i, 0);
    if (isObserved) {
        notifyObserver(t, MeTeamItemDone, 0, 0);
        notifyObserver(t, MeTeamLoopEnds, items, 0);
    }
}

void MEAPI MeTeamRun(MeTeam *t, int items, MeTeamWork work, void *context) {
    if (isSerial(t, items)) {
        runSerially(t, items, work, context);
        return;
    }
    notifyObserver(t, MeTeamLoopBegins, items, 0);
    const MeU64 number = setLoop(t, items, work, context);
    for (int i = 0; i < t->size; i++)
        atomic_store_explicit(&t->share[i].claim, packClaim(number, firstItemOf(t, i + 1) - firstItemOf(t, i), 0),
                              memory_order_release);
    advanceLoopNumber(t, 2);
    runLoop(t, 0);
    for (int spins = 0; atomic_load_explicit(&t->done, memory_order_acquire) < items;)
        spinOrYield(&spins);
    MEASSERT(atomic_load_explicit(&t->done, memory_order_relaxed) == items);
    t->isRunning = MEFALSE;
    sendMessages(t);
    notifyObserver(t, MeTeamLoopEnds, items, 0);
}

typedef struct Ranges {
    MeTeamRangeWork work;
    void *context;
    int count, size;
} Ranges;

static void MEAPI runRange(void *context, int item, int worker) {
    const Ranges *r = context;
    const int first = item * r->size, end = r->count - first < r->size ? r->count : first + r->size;
    r->work(r->context, first, end, worker);
}

void MEAPI MeTeamRunRanges(MeTeam *t, int count, int size, MeTeamRangeWork work, void *context) {
    MEASSERT(size >= 1);
    MEASSERT(count >= 0);
    if (!t && count <= size) {
        if (count > 0)
            work(context, 0, count, 0);
        return;
    }
    Ranges ranges = {work, context, count, size};
    MeTeamRun(t, count / size + (count % size > 0), runRange, &ranges);
}

static void pipeSerially(int items, MeTeamWork make, MeTeamWork use, void *context) {
    for (int i = 0; i < items; i++) {
        make(context, i, 0);
        use(context, i, 0);
    }
}

void MEAPI MeTeamPipe(MeTeam *t, int items, int ahead, MeTeamWork make, MeTeamWork use, void *context) {
    MEASSERT(ahead >= 1);
    if (isSerial(t, items)) {
        pipeSerially(items, make, use, context);
        return;
    }
    const int buffers = MeMIN(ahead, MAX_AHEAD);
    notifyObserver(t, MeTeamPipeBegins, items, buffers);
    const MeU64 number = setLoop(t, items, make, context);
    for (int i = 0; i < buffers; i++)
        atomic_store_explicit(&t->made[i], 0, memory_order_relaxed);
    atomic_store_explicit(&t->used.claim, packClaim(number, buffers, 0), memory_order_release);
    atomic_store_explicit(&t->pipe.claim, packClaim(number, items, 0), memory_order_release);
    advanceLoopNumber(t, 2);
    for (int i = 0; i < items; i++) {
        for (int spins = 0; atomic_load_explicit(&t->made[i % buffers], memory_order_acquire) != i + 1;)
            if (!makePipeItem(t, 0))
                spinOrYield(&spins);
        MeMessagesSend((MeMessageBuffer *[]){&t->messages[i % buffers]}, 1);
        use(context, i, 0);
        notifyObserver(t, MeTeamItemUsed, i, 0);
        atomic_store_explicit(&t->used.claim, packClaim(number, buffers, i + 1), memory_order_release);
    }
    t->isRunning = MEFALSE;
    notifyObserver(t, MeTeamLoopEnds, items, 0);
}
