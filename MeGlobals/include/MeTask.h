/** @file MeTask.h
 *  Tasks: run parts of a step on several threads.
 *
 *  Karma starts no thread by itself. A world steps on the calling thread until it is given workers
 *  (MdtWorldSetTaskPool, MdtWorldSetTaskCallbacks): either a pool of this file, or callbacks that pass tasks to the
 *  program's own job system. A step gives the same bits for any scheduling of its tasks and any number of threads.
 *
 *  A task is a function and its context. Karma enqueues at most one task at a time per worker other than the calling
 *  thread, which works, too: a task that starts late, or only when it is waited for, costs nothing but time.
 */
#ifndef METASK_H
#define METASK_H

#include "MePrecision.h"

ME_BEGIN_C

/** The function of a task: called once, on any thread. */
typedef void(MEAPI *MeTaskCB)(void *taskContext);

/** @name Callbacks that run tasks
 *  While a world steps, these callbacks must not destroy it, step it or move its bodies: such calls are refused, with a
 *  warning. Creation and destruction of its objects are deferred to the end of the step (docs/simulation.md,
 *  "Callbacks").
 *  @{ */

/** Calls @a task with @a taskContext once, on any thread: before this returns, later, or when MeFinishTaskCB waits for
 *  it.
 *  @return an identifier of the task for MeFinishTaskCB; null: the task has been called already */
typedef void *(MEAPI *MeEnqueueTaskCB)(MeTaskCB task, void *taskContext, void *userContext);

/** Waits until the task has returned. May run it, or others, meanwhile. */
typedef void(MEAPI *MeFinishTaskCB)(void *userTask, void *userContext);
/** @} */

/** A pool of threads that run tasks. */
typedef struct MeTaskPool *MeTaskPoolID;

enum {
    MeTaskMaxWorkers = 64 /**< Maximum number of workers. */
};

/**
 * Creates a pool of threads, which sleep until there are tasks.
 * @param workers the number of threads that work at the same time, including the one that steps a world: workers - 1
 * threads are started. Clamped, with a warning, to 1 .. MeTaskMaxWorkers.
 * @return null, with a warning or a fatal error, if the threads cannot be created
 */
MEPUBLIC MeTaskPoolID MEAPI MeTaskPoolCreate(int workers);

/** Ends the threads and frees the pool. No world may use it any more. Null does nothing. With unfinished tasks (in a
 *  callback during a step) it warns and does nothing. */
MEPUBLIC void MEAPI MeTaskPoolDestroy(MeTaskPoolID pool);

/** The number of workers; 1 for null. */
MEPUBLIC int MEAPI MeTaskPoolGetWorkers(MeTaskPoolID pool);

/** @name A pool as callbacks
 *  The callbacks that MdtWorldSetTaskPool sets; programs may use them for their own tasks. @a pool is a MeTaskPoolID.
 *  Thread-safe.
 *  @{ */
/** A MeEnqueueTaskCB. Null, with a warning, for a null pool or task. */
MEPUBLIC void *MEAPI MeTaskPoolEnqueue(MeTaskCB task, void *taskContext, void *pool);
/** A MeFinishTaskCB: the waiting thread runs tasks meanwhile. */
MEPUBLIC void MEAPI MeTaskPoolFinish(void *userTask, void *pool);
/** @} */

ME_END_C

#endif
