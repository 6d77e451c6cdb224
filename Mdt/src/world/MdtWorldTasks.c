/* A world's workers: their number, and the memory of each. */
#include "MdtInternal.h"
#include "MeAssert.h"
#include "world/mdt_workers_i.h"
#include <string.h>

/* ---- memory of workers ---- */

static void termWorker(MdtWorker *worker) {
    MEASSERT(!worker->messages.first);
    MeChunkTerm(&worker->scratch);
    MeChunkTerm(&worker->ranking);
    MdtKeaCacheDestroy(worker->keaCache);
}

static MeBool initWorker(MdtWorker *worker) {
    memset(worker, 0, sizeof *worker);
    MeChunkInit(&worker->scratch, 16);
    MeChunkInit(&worker->ranking, 16);
    worker->keaCache = MdtKeaCacheCreate();
    return worker->keaCache != NULL;
}

static void termWorkers(MdtWorldID w, int kept) {
    while (w->numWorkers > kept)
        termWorker(&w->workers[--w->numWorkers]);
}

MeBool mdt_workersInit(MdtWorldID w, int count, const char *caller) {
    const int before = w->numWorkers;
    if (count > before &&
        !MeMemoryGrow(&w->workers, (size_t)before, (size_t)count, sizeof *w->workers, caller, "workers"))
        return MEFALSE;
    while (w->numWorkers < count)
        if (!initWorker(&w->workers[w->numWorkers++])) {
            termWorkers(w, before);
            return MEFALSE;
        }
    termWorkers(w, count);
    return METRUE;
}

void mdt_workersTerm(MdtWorldID w) {
    MeTeamDestroy(w->team);
    w->team = NULL;
    termWorkers(w, 0);
    MeMemoryGive(w->workers);
}

/* ---- setting the workers ---- */

static void setWorkers(MdtWorldID w, int count, MeEnqueueTaskCB enqueue, MeFinishTaskCB finish, void *userContext,
                       const char *caller) {
    MeTeam *team = count > 1 ? MeTeamCreate(count, enqueue, finish, userContext, caller) : NULL;
    if ((count > 1 && !team) || !mdt_workersInit(w, count, caller)) {
        MeTeamDestroy(team);
        return;
    }
    MeTeamDestroy(w->team);
    w->team = team;
    MeTeamTime(team, METRUE);
}

void MEAPI MdtWorldSetTaskCallbacks(const MdtWorldID w, const int workerCount, const MeEnqueueTaskCB enqueue,
                                    const MeFinishTaskCB finish, void *const userContext) {
    MDT_NEED_WORLD(w, );
    if (workerCount < 1 || workerCount > MeTaskMaxWorkers)
        MeWarning(1, "MdtWorldSetTaskCallbacks: %d workers: there must be 1 .. %d; nothing is changed", workerCount,
                  MeTaskMaxWorkers);
    else if (workerCount > 1 && (!enqueue || !finish))
        MeWarning(1, "MdtWorldSetTaskCallbacks: %s is null; nothing is changed", enqueue ? "finish" : "enqueue");
    else if (MeStageIsFree(&w->stage, __func__))
        setWorkers(w, workerCount, enqueue, finish, userContext, __func__);
}

void MEAPI MdtWorldSetTaskPool(const MdtWorldID w, const MeTaskPoolID pool) {
    MDT_NEED_WORLD(w, );
    if (MeStageIsFree(&w->stage, __func__))
        setWorkers(w, MeTaskPoolGetWorkers(pool), MeTaskPoolEnqueue, MeTaskPoolFinish, pool, __func__);
}

int MEAPI MdtWorldGetWorkerCount(const MdtWorldID w) {
    MDT_NEED_WORLD(w, 1);
    return w->numWorkers;
}

MeReal MEAPI MdtWorldGetWorkerTime(const MdtWorldID w, const int worker) {
    MDT_NEED_WORLD(w, 0);
    if (worker >= 0 && worker < w->numWorkers)
        return (MeReal)MeTeamGetBusyTime(w->team, worker);
    MeWarning(1, "MdtWorldGetWorkerTime: there is no worker %d; there are %d", worker, w->numWorkers);
    return 0;
}

MeTeam *MEAPI MdtWorldGetTeam(const MdtWorldID w) {
    MDT_NEED_WORLD(w, NULL);
    return w->team;
}
