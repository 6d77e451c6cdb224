/* The built-in pool of threads: a queue of tasks (MeTask.h). */
#define _POSIX_C_SOURCE 199309L /* pthread, sched_yield */
#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMath.h"
#include "MeMessage.h"
#include "MeTask.h"
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>

/* Number of polls for a task, or for its end, before a thread sleeps, some 20 us: a step opens its teams in quick
 * succession, and waking a thread takes as long. */
enum { SPINS_BEFORE_SLEEP = 1000 };

static void pauseBriefly(void) {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#else
    sched_yield();
#endif
}

typedef enum TaskState { TASK_FREE, TASK_QUEUED, TASK_RUNNING, TASK_DONE } TaskState;

typedef struct Task {
    MeTaskCB call;
    void *context;
    _Atomic(TaskState) state; /* written only with the pool's lock held, like all members of the pool */
    struct Task *next;        /* in the queue or the free list */
} Task;

struct MeTaskPool {
    int workers, numThreads;
    pthread_t thread[MeTaskMaxWorkers];
    pthread_mutex_t lock;
    pthread_cond_t workAvailable, taskDone;
    Task *first, *last, *free;
    MeBool isEnding;
    atomic_int queued; /* queued tasks: polled by threads without the lock */
    int numUnfinished; /* tasks for which MeTaskPoolFinish has not returned */
};

/* ---- the queue, with the lock held ---- */

static void appendTask(MeTaskPoolID p, Task *task) {
    MEASSERT((p->first == NULL) == (atomic_load_explicit(&p->queued, memory_order_relaxed) == 0));
    task->state = TASK_QUEUED;
    task->next = NULL;
    if (p->first)
        p->last->next = task;
    else
        p->first = task;
    p->last = task;
    atomic_fetch_add_explicit(&p->queued, 1, memory_order_relaxed);
}

static Task *popFirst(MeTaskPoolID p) {
    Task *task = p->first;
    if (!task)
        return NULL;
    MEASSERT(task->state == TASK_QUEUED);
    p->first = task->next;
    task->state = TASK_RUNNING;
    atomic_fetch_sub_explicit(&p->queued, 1, memory_order_relaxed);
    return task;
}

static void runTask(MeTaskPoolID p, Task *task) {
    MEASSERT(task->state == TASK_RUNNING);
    pthread_mutex_unlock(&p->lock);
    task->call(task->context);
    pthread_mutex_lock(&p->lock);
    task->state = TASK_DONE;
    pthread_cond_broadcast(&p->taskDone);
}

/* ---- threads ---- */

static void spinForWork(MeTaskPoolID p) {
    for (int i = 0; i < SPINS_BEFORE_SLEEP && atomic_load_explicit(&p->queued, memory_order_relaxed) == 0; i++)
        pauseBriefly();
}

static void *threadMain(void *pool) {
    MeTaskPoolID p = pool;
    pthread_mutex_lock(&p->lock);
    while (!p->isEnding) {
        Task *task = popFirst(p);
        if (task) {
            runTask(p, task);
            pthread_mutex_unlock(&p->lock);
            spinForWork(p);
            pthread_mutex_lock(&p->lock);
        } else
            pthread_cond_wait(&p->workAvailable, &p->lock);
    }
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

static void endThreads(MeTaskPoolID p) {
    pthread_mutex_lock(&p->lock);
    p->isEnding = METRUE;
    pthread_cond_broadcast(&p->workAvailable);
    pthread_mutex_unlock(&p->lock);
    for (int i = 0; i < p->numThreads; i++)
        pthread_join(p->thread[i], NULL);
}

static void freePool(MeTaskPoolID p) {
    MEASSERT(!p->first);
    MEASSERT(p->numUnfinished == 0);
    while (p->free) {
        Task *task = p->free;
        p->free = task->next;
        MeMemoryGive(task);
    }
    pthread_cond_destroy(&p->taskDone);
    pthread_cond_destroy(&p->workAvailable);
    pthread_mutex_destroy(&p->lock);
    MeMemoryGive(p);
}

static MeTaskPoolID createPool(int workers) {
    MeTaskPoolID p = MeMemoryTakeZeroed(1, sizeof *p, "MeTaskPoolCreate", "a pool of threads");
    if (!p)
        return NULL;
    p->workers = workers;
    atomic_init(&p->queued, 0);
    pthread_mutex_init(&p->lock, NULL);
    pthread_cond_init(&p->workAvailable, NULL);
    pthread_cond_init(&p->taskDone, NULL);
    return p;
}

MeTaskPoolID MEAPI MeTaskPoolCreate(int workers) {
    const int clamped = MeCLAMP(workers, 1, MeTaskMaxWorkers);
    if (clamped != workers)
        MeWarning(1, "MeTaskPoolCreate: %d workers: there must be 1 .. %d; there are %d", workers, MeTaskMaxWorkers,
                  clamped);
    MeTaskPoolID p = createPool(clamped);
    while (p && p->numThreads < clamped - 1) {
        if (pthread_create(&p->thread[p->numThreads], NULL, threadMain, p) != 0) {
            MeWarning(1, "MeTaskPoolCreate: the system starts no more than %d threads of %d", p->numThreads,
                      clamped - 1);
            MeTaskPoolDestroy(p);
            return NULL;
        }
        p->numThreads++;
    }
    return p;
}

/* Whether there are unfinished tasks; if so, with a message. During a step the workers' tasks wait for loops, and
 * joining the threads would never end. */
static MeBool isInUse(MeTaskPoolID p) {
    pthread_mutex_lock(&p->lock);
    const MeBool hasUnfinished = p->numUnfinished > 0;
    pthread_mutex_unlock(&p->lock);
    if (hasUnfinished)
        MeProgramRefuse("MeTaskPoolDestroy", "there are unfinished tasks");
    return hasUnfinished;
}

void MEAPI MeTaskPoolDestroy(MeTaskPoolID p) {
    if (!p || !MeProgramMayChange("MeTaskPoolDestroy") || isInUse(p))
        return;
    endThreads(p);
    freePool(p);
}

int MEAPI MeTaskPoolGetWorkers(MeTaskPoolID p) {
    return p ? p->workers : 1;
}

/* ---- tasks ---- */

static Task *allocateTask(MeTaskPoolID p) {
    Task *task = p->free;
    if (task)
        p->free = task->next;
    else
        task = MeMemoryTake(1, sizeof *task, "MeTaskPoolEnqueue", "a task");
    return task;
}

void *MEAPI MeTaskPoolEnqueue(MeTaskCB call, void *context, void *pool) {
    MeTaskPoolID p = pool;
    if (!p || !call) {
        MeWarning(1, "MeTaskPoolEnqueue: the %s is null", p ? "task" : "pool");
        return NULL;
    }
    pthread_mutex_lock(&p->lock);
    Task *task = allocateTask(p);
    if (task) {
        task->call = call;
        task->context = context;
        appendTask(p, task);
        p->numUnfinished++;
        pthread_cond_signal(&p->workAvailable);
    }
    pthread_mutex_unlock(&p->lock);
    if (!task)
        call(context);
    return task;
}

static void spinUntilDone(const Task *task) {
    for (int i = 0; i < SPINS_BEFORE_SLEEP && task->state == TASK_RUNNING; i++)
        pauseBriefly();
}

/* Runs queued tasks itself while the awaited one is queued, so that a pool without threads runs them, too. */
void MEAPI MeTaskPoolFinish(void *userTask, void *pool) {
    MeTaskPoolID p = pool;
    Task *task = userTask;
    if (!p || !task) {
        MeWarning(1, "MeTaskPoolFinish: the %s is null", p ? "task" : "pool");
        return;
    }
    spinUntilDone(task);
    pthread_mutex_lock(&p->lock);
    while (task->state != TASK_DONE) {
        Task *other = task->state == TASK_QUEUED ? popFirst(p) : NULL;
        if (other)
            runTask(p, other);
        else
            pthread_cond_wait(&p->taskDone, &p->lock);
    }
    task->state = TASK_FREE;
    MEASSERT(p->numUnfinished > 0);
    p->numUnfinished--;
    task->next = p->free;
    p->free = task;
    pthread_mutex_unlock(&p->lock);
}
