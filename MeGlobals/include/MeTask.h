/** @file MeTask.h
 *  Tasks: how a step's work gets onto several threads.
 *
 *  Karma starts no thread by itself. A world steps on the thread that calls it until it is given workers
 *  (MdtWorldSetTaskPool, MdtWorldSetTaskCallbacks): either a pool of this file, or functions that hand tasks to the
 *  program's own job system. A step gives the same bits whatever runs its tasks, and on however many threads.
 *
 *  A task is a function and its context. Karma enqueues at most as many tasks at a time as there are workers beside the
 *  calling thread, and that thread works too: a task that is started late, or only as it is waited for, costs time and
 *  nothing else.
 */
#ifndef METASK_H
#define METASK_H

#include "MePrecision.h"

ME_BEGIN_C

/** What a task does: it is called once, on any thread. */
typedef void(MEAPI *MeTaskCB)(void *taskContext);

/** @name How tasks are run
 *  While a world steps these may not destroy it, step it or move its bodies: such calls are refused, with a warning.
 *  What of it they create or destroy waits until the step is done (docs/simulation.md, "Callbacks").
 *  @{ */

/** Has @a task called with @a taskContext, once, by any thread: now, before this returns; soon; or only when
 *  MeFinishTaskCB waits for it.
 *  @return what identifies the task to MeFinishTaskCB; null: it has been called already */
typedef void *(MEAPI *MeEnqueueTaskCB)(MeTaskCB task, void *taskContext, void *userContext);

/** Returns once the task has been called and has returned. May call it, or others, meanwhile. */
typedef void(MEAPI *MeFinishTaskCB)(void *userTask, void *userContext);
/** @} */

/** Threads that wait for tasks. */
typedef struct MeTaskPool *MeTaskPoolID;

enum {
    MeTaskMaxWorkers = 64 /**< More are not made use of. */
};

/**
 * Starts threads that sleep until there is something to do.
 * @param workers how many threads work at once, the one that steps a world included: this many less one are started. At
 *        least 1, at most MeTaskMaxWorkers; other numbers warn, and the next of these is taken.
 * @return null, with a warning or a fatal error, if they cannot be had
 */
MEPUBLIC MeTaskPoolID MEAPI MeTaskPoolCreate(int workers);

/** Ends the threads and frees the pool. No world may use it any more. Null does nothing. While there are tasks that are
 *  not finished, in a callback in the middle of a step: a warning, and nothing is done. */
MEPUBLIC void MEAPI MeTaskPoolDestroy(MeTaskPoolID pool);

/** As many as MeTaskPoolCreate was asked for, or took; 1 for null. */
MEPUBLIC int MEAPI MeTaskPoolGetWorkers(MeTaskPoolID pool);

/** @name A pool as callbacks
 *  What MdtWorldSetTaskPool gives a world; programs may use them for tasks of their own. @a pool is a MeTaskPoolID. Any
 *  number of threads may call them at once.
 *  @{ */
MEPUBLIC void *MEAPI MeTaskPoolEnqueue(MeTaskCB task, void *taskContext, void *pool);
MEPUBLIC void MEAPI MeTaskPoolFinish(void *userTask, void *pool);
/** @} */

ME_END_C

#endif
