/** @file MeTeam.h
 *  Teams: parallel loops for Karma's own libraries, run by the program's tasks (MeTask.h). Not installed.
 *
 *  A team is opened for a stage of a step, runs loops, and is closed. Opening enqueues one task per worker, which spins
 *  until the team is closed, waiting for loops: beginning and ending a loop costs no more than a microsecond. The
 *  opening thread is worker 0 and processes items, too; it can process all of them, so a loop ends even if no task ever
 *  starts.
 *
 *  The rule for order (determinism): it is undefined which worker processes an item, and when, so results must not
 *  depend on it. An item must not write data that another item of its loop reads or writes; sums over items are
 *  computed afterwards, in the order of items. The number of items must not depend on the number of workers.
 */
#ifndef METEAM_H
#define METEAM_H

#include "MeTask.h"

ME_BEGIN_C

typedef struct MeTeam MeTeam;

/** Processes one item of a loop on a worker, 0 .. MeTeamGetSize - 1, which selects per-worker memory. */
typedef void(MEAPI *MeTeamWork)(void *context, int item, int worker);

/** Processes the items first .. end - 1 of a loop over ranges, on a worker. */
typedef void(MEAPI *MeTeamRangeWork)(void *context, int first, int end, int worker);

/** @name Life
 *  @{ */
/** Creates a team of @a workers, at most MeTaskMaxWorkers. Null, after a fatal error, without memory. */
MEPUBLIC MeTeam *MEAPI MeTeamCreate(int workers, MeEnqueueTaskCB enqueue, MeFinishTaskCB finish, void *userContext,
                                    const char *function);
/** Destroys a team. Null does nothing. */
MEPUBLIC void MEAPI MeTeamDestroy(MeTeam *team);
/** The number of workers; 1 for null. */
MEPUBLIC int MEAPI MeTeamGetSize(const MeTeam *team);
/** @} */

/** @name Work
 *  To be called by one thread. Open and close may be nested. A null team runs everything on the calling thread.
 *  @{ */
/** Enqueues the tasks, one for each further worker, unless they still run. */
MEPUBLIC void MEAPI MeTeamOpen(MeTeam *team);
/** Waits for the tasks to end, unless MeTeamKeep was called. */
MEPUBLIC void MEAPI MeTeamClose(MeTeam *team);
/** Keeps the tasks of a team running when it is closed, until MeTeamRelease: a sleeping thread takes up to .35 ms to
 *  wake. Workers spin while the calling thread works alone in between. */
MEPUBLIC void MEAPI MeTeamKeep(MeTeam *team);
/** Ends the tasks that MeTeamKeep kept. Not while the team is open. */
MEPUBLIC void MEAPI MeTeamRelease(MeTeam *team);
/** Processes all items, then returns. If the team is null, not open, or in a loop already, the calling thread processes
 *  them alone, in order. Messages of the items are sent after the loop, in the order of items. */
MEPUBLIC void MEAPI MeTeamRun(MeTeam *team, int items, MeTeamWork work, void *context);
/** The same for @a count items in ranges of @a size; the last range may be shorter. */
MEPUBLIC void MEAPI MeTeamRunRanges(MeTeam *team, int count, int size, MeTeamRangeWork work, void *context);
/**
 * A pipeline: all workers run @a make for items; the calling thread runs @a use for each item, in order, as soon as it
 * and all earlier ones are made. So @a use may write shared data. At most @a ahead (>= 1) items are made and not yet
 * used: item i may use buffer i % ahead. Messages of making an item precede those of using it.
 */
MEPUBLIC void MEAPI MeTeamPipe(MeTeam *team, int items, int ahead, MeTeamWork make, MeTeamWork use, void *context);
/** @} */

/** @name Time
 *  The time that workers spend on items.
 *  @{ */
/** Switches timing on or off, and resets all times to 0. */
MEPUBLIC void MEAPI MeTeamTime(MeTeam *team, MeBool isTimed);
/** s spent on items since timing was switched on. */
MEPUBLIC double MEAPI MeTeamGetBusyTime(const MeTeam *team, int worker);
/** @} */

/** @name Watching
 *  For estimates of the gain by more workers (bench/critical.c): every event of an open team is reported on the thread
 *  where it happens. Loops inside an item are part of the item.
 *  @{ */
typedef enum MeTeamEvent {
    MeTeamLoopBegins,
    MeTeamPipeBegins,
    MeTeamItemDone, /**< in a pipe: made */
    MeTeamItemUsed,
    MeTeamLoopEnds /**< or a pipe ends */
} MeTeamEvent;

typedef struct MeTeamNews {
    MeTeamEvent event;
    int number; /**< index of the item; where a loop or a pipe begins or ends, the number of items */
    int ahead;  /**< where a pipe begins: the number of items that may be made and not used */
} MeTeamNews;

typedef void(MEAPI *MeTeamWatchCB)(const MeTeamNews *news, void *watchContext);

/** Sets the callback; null: none. Not while the team is open. */
MEPUBLIC void MEAPI MeTeamWatch(MeTeam *team, MeTeamWatchCB watch, void *watchContext);
/** @} */

ME_END_C

#endif
