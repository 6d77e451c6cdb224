/** @file MeTeam.h
 *  Teams: parallel loops for Karma's own libraries, on top of a program's tasks (MeTask.h). Not installed.
 *
 *  A team is opened for a stretch of a step, runs loops, and is closed. Opening enqueues one task per worker, which
 *  waits for loops, spinning, until the team is closed: a loop costs no more than a microsecond to begin and to end.
 *  The opening thread is worker 0 and takes items too: it can do all of them, so that a loop ends even if no task is
 *  ever started.
 *
 *  The rule for order: which worker takes an item, and when, is left open. What a loop computes must not depend on it:
 *  an item writes to nothing that another item of its loop reads or writes, and sums over items are made afterwards, in
 *  the items' order, of what each has left. How many items there are must not depend on the number of workers.
 */
#ifndef METEAM_H
#define METEAM_H

#include "MeTask.h"

ME_BEGIN_C

typedef struct MeTeam MeTeam;

/** One item of a loop, done by that worker, 0 .. MeTeamGetSize - 1: for memory that workers have of their own. */
typedef void(MEAPI *MeTeamWork)(void *context, int item, int worker);

/** The items first .. end - 1 of a loop over ranges, by that worker. */
typedef void(MEAPI *MeTeamRangeWork)(void *context, int first, int end, int worker);

/** @name Life
 *  @{ */
/** With that many workers, at most MeTaskMaxWorkers. Null, after a fatal error, if there is no memory. */
MEPUBLIC MeTeam *MEAPI MeTeamCreate(int workers, MeEnqueueTaskCB enqueue, MeFinishTaskCB finish, void *userContext,
                                    const char *function);
/** Null is nothing. */
MEPUBLIC void MEAPI MeTeamDestroy(MeTeam *team);
/** 1 for null. */
MEPUBLIC int MEAPI MeTeamGetSize(const MeTeam *team);
/** @} */

/** @name Work
 *  All by the same thread. Open and close nest. Null is a team of the calling thread alone.
 *  @{ */
MEPUBLIC void MEAPI MeTeamOpen(MeTeam *team);
MEPUBLIC void MEAPI MeTeamClose(MeTeam *team);
/** From now on a team that has been opened stays so, whoever closes it, until it is released: a sleeping thread needs
 *  up to .35 ms to wake. Workers wait, spinning, while the calling thread does something alone in between. */
MEPUBLIC void MEAPI MeTeamKeep(MeTeam *team);
MEPUBLIC void MEAPI MeTeamRelease(MeTeam *team);
/** Does all items, and returns then. On the calling thread alone, in their order, where the team is not open, is null,
 *  or is in a loop already. Messages of the items reach the calling thread in the items' order, after the loop. */
MEPUBLIC void MEAPI MeTeamRun(MeTeam *team, int items, MeTeamWork work, void *context);
/** The same of so many things, in ranges of that size; the last one may be shorter. */
MEPUBLIC void MEAPI MeTeamRunRanges(MeTeam *team, int count, int size, MeTeamRangeWork work, void *context);
/**
 * Makes items on all workers, and uses them on the calling thread, each as soon as it and all before it are made: use
 * may write to what is shared, in the items' order. No more than @a ahead items are made and not used: item i has the
 * i % ahead-th of so many buffers. @a ahead is at least 1. Messages of making an item come before those of using it.
 */
MEPUBLIC void MEAPI MeTeamPipe(MeTeam *team, int items, int ahead, MeTeamWork make, MeTeamWork use, void *context);
/** @} */

/** @name Time
 *  What workers spend on items, if somebody wants to know.
 *  @{ */
/** From now on, or no longer; all times are 0 again. */
MEPUBLIC void MEAPI MeTeamTime(MeTeam *team, MeBool isTimed);
/** s, since then. */
MEPUBLIC double MEAPI MeTeamGetBusyTime(const MeTeam *team, int worker);
/** @} */

/** @name Watching
 *  For who asks what more workers would gain (bench/critical.c): all that an open team does is told as it is done, on
 *  the thread that has done it. Loops inside an item are a part of the item.
 *  @{ */
typedef enum MeTeamEvent {
    MeTeamLoopBegins,
    MeTeamPipeBegins,
    MeTeamItemDone, /**< of a pipe: made */
    MeTeamItemUsed,
    MeTeamLoopEnds /**< or the pipe */
} MeTeamEvent;

typedef struct MeTeamNews {
    MeTeamEvent event;
    int number; /**< of the item; where a loop or a pipe begins or ends, how many there are */
    int ahead;  /**< of a pipe that begins: how many items may be made and not used */
} MeTeamNews;

typedef void(MEAPI *MeTeamWatchCB)(const MeTeamNews *news, void *watchContext);

/** Null: nobody watches any more. Not while the team is open. */
MEPUBLIC void MEAPI MeTeamWatch(MeTeam *team, MeTeamWatchCB watch, void *watchContext);
/** @} */

ME_END_C

#endif
