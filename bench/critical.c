/* What more cores would gain (critical.h).
 *
 * A universe is stepped with as many workers as there would be cores, whose tasks wait until the calling thread has
 * done all their work: so each item of a loop is timed alone, on a warm core. Then the times of each loop are put onto
 * the workers as me_team.c hands out items: to each its own share, then what others have left; a pipe's one after the
 * other, while worker 0 uses them in their order. What is between loops takes as long as it took. Not in it: what a
 * core waits for another one's cache, and for memory that all share. */
#include "timing.h"

#include "MdtInternal.h"
#include "MeInternal.h"
#include "MeProfile.h"
#include "critical.h"

#include <stdio.h>
#include <string.h>

#define LOOP 1e-6 /* s, to begin and end a loop (MeTeam.h) */

enum { MAX_CORES = 16, MAX_STAGES = 32 };

/* Where one thread works alone. */
typedef struct Stage {
    char name[40];
    double time; /* s */
} Stage;

typedef struct Watch {
    int cores;
    double last; /* s, when the last thing was told */
    int isInLoop;
    int items, ahead;
    double *made, *used; /* s, by item of the loop; `room` of each */
    int room;
    double work, span; /* s, of all that was told: on one core, and on so many */
    Stage stage[MAX_STAGES];
    int stages;
} Watch;

/* ---- tasks that wait --------------------------------------------------------------------------------------------- */

static MeTaskCB waiting[MAX_CORES];
static void *waitingContext[MAX_CORES];
static int numWaiting;

static void *MEAPI keepTask(MeTaskCB task, void *taskContext, void *userContext) {
    (void)userContext;
    waiting[numWaiting] = task;
    waitingContext[numWaiting] = taskContext;
    return &waiting[numWaiting++];
}

static void MEAPI runTask(void *userTask, void *userContext) {
    const long i = (MeTaskCB *)userTask - waiting;
    (void)userContext;
    waiting[i](waitingContext[i]);
    numWaiting--;
}

/* ---- putting items onto cores ------------------------------------------------------------------------------------ */

/* The first item of the share of a core, or behind the last one's. */
static int startOf(const Watch *w, int core) {
    return (int)((long)w->items * core / w->cores);
}

static int earliest(const double free[], int cores) {
    int first = 0;
    for (int i = 1; i < cores; i++)
        first = free[i] < free[first] ? i : first;
    return first;
}

static double latest(const double free[], int cores) {
    double last = free[0];
    for (int i = 1; i < cores; i++)
        last = free[i] > last ? free[i] : last;
    return last;
}

static double spanOfLoop(const Watch *w) {
    double free[MAX_CORES] = {0};
    int next[MAX_CORES];
    for (int i = 0; i < w->cores; i++)
        next[i] = startOf(w, i);
    for (int left = w->items; left > 0; left--) {
        const int core = earliest(free, w->cores);
        int share = core;
        while (next[share] == startOf(w, share + 1))
            share = (share + 1) % w->cores;
        free[core] += w->made[next[share]++];
    }
    return latest(free, w->cores);
}

/* Core 0 makes items too, where the next one to be used is not begun. */
static double spanOfPipe(const Watch *w, double *doneAt) {
    double free[MAX_CORES] = {0};
    for (int made = 0, used = 0; used < w->items;) {
        const int core = earliest(free, w->cores);
        const int mayMake = made < w->items && made < used + w->ahead;
        if (core == 0 && used < made && doneAt[used] <= free[0])
            free[0] += w->used[used], used++;
        else if (mayMake)
            free[core] += w->made[made], doneAt[made] = free[core], made++;
        else if (core == 0)
            free[0] = doneAt[used];
        else
            free[core] = made == w->items ? 1e9 : free[0] + 1e-9; /* until a buffer is free, or no more */
    }
    return free[0];
}

/* ---- what is told ------------------------------------------------------------------------------------------------ */

static void addAlone(Watch *w, double time, const char *suffix) {
    const char *section = MeProfileCurrentSection();
    char name[sizeof w->stage->name];
    int i = 0;
    snprintf(name, sizeof name, "%s%s", section ? section : "the rest", suffix);
    while (i < w->stages && strcmp(w->stage[i].name, name) != 0)
        i++;
    if (i == MAX_STAGES)
        abort();
    if (i == w->stages) {
        w->stage[w->stages++] = (Stage){.time = 0};
        memcpy(w->stage[i].name, name, sizeof name);
    }
    w->stage[i].time += time;
    w->work += time;
    w->span += time;
}

static void beginLoop(Watch *w, const MeTeamNews *news) {
    w->items = news->number;
    w->ahead = news->ahead;
    if (w->items <= w->room)
        return;
    w->room = 2 * w->items;
    w->made = realloc(w->made, (size_t)w->room * sizeof *w->made);
    w->used = realloc(w->used, (size_t)w->room * sizeof *w->used);
    if (!w->made || !w->used)
        abort();
}

static void endLoop(Watch *w) {
    double *doneAt = w->ahead ? calloc((size_t)w->items, sizeof *doneAt) : NULL;
    for (int i = 0; i < w->items; i++)
        w->work += w->made[i] + (w->ahead ? w->used[i] : 0);
    w->span += (w->ahead ? spanOfPipe(w, doneAt) : spanOfLoop(w)) + (w->cores > 1 ? LOOP : 0);
    free(doneAt);
}

/* Before another section begins: what has been done since was of this one, unless an item is at work. */
static void MEAPI hearSection(void *watch) {
    Watch *w = watch;
    if (w->isInLoop)
        return;
    addAlone(w, now() - w->last, "");
    w->last = now();
}

static void MEAPI hear(const MeTeamNews *news, void *watch) {
    Watch *w = watch;
    const double time = now() - w->last;
    switch (news->event) {
    case MeTeamLoopBegins:
    case MeTeamPipeBegins:
        addAlone(w, time, "");
        beginLoop(w, news);
        w->isInLoop = 1;
        break;
    case MeTeamItemDone:
        w->made[news->number] = time;
        break;
    case MeTeamItemUsed:
        w->used[news->number] = time;
        break;
    case MeTeamLoopEnds:
        if (news->number == 1)
            addAlone(w, w->made[0], ", loops of one item");
        else
            endLoop(w);
        w->isInLoop = 0;
        break;
    }
    w->last = now();
}

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

/* Warm: the first step finds no pair that it knows. */
static void stepWatched(Watch *w, MstUniverseID u) {
    MstUniverseStep(u, (MeReal)(1. / 60));
    w->work = w->span = 0;
    w->stages = 0;
}

static void run(Watch *w, MstUniverseID u, int steps) {
    MdtWorldSetTaskCallbacks(u->world, w->cores, keepTask, runTask, NULL);
    MeTeamWatch(MdtWorldGetTeam(u->world), hear, w);
    w->last = now();
    stepWatched(w, u);
    w->last = now();
    for (int i = 0; i < steps; i++) {
        MstUniverseStep(u, (MeReal)(1. / 60));
        addAlone(w, now() - w->last, "");
        w->last = now();
    }
    MstUniverseDestroy(u);
}

static int byTime(const void *a, const void *b) {
    const double x = ((const Stage *)a)->time, y = ((const Stage *)b)->time;
    return (x < y) - (x > y);
}

static void tellAlone(Watch *w) {
    double all = 0;
    qsort(w->stage, (size_t)w->stages, sizeof *w->stage, byTime);
    for (int i = 0; i < w->stages; i++)
        all += w->stage[i].time;
    printf("   alone %.1f %%:", 100 * all / w->work);
    for (int i = 0; i < w->stages && w->stage[i].time > .004 * w->work; i++)
        printf(" %s %.1f%s", w->stage[i].name, 100 * w->stage[i].time / w->work, i + 1 < w->stages ? ";" : "");
    printf("\n");
}

void critical_tell(const char *name, MstUniverseID (*make)(void), int steps) {
    const MeProfileTimerMode mode = {kMeProfileCounterModeFlops};
    Watch w = {.room = 0};
    MeProfileStartTiming(mode, kMeProfileDontLog);
    MeProfileWatch(hearSection, &w);
    printf("%-14s", name);
    for (int cores = 2; cores <= MAX_CORES; cores *= 2) {
        w.cores = cores;
        run(&w, make(), steps);
        printf(" %6.2f", w.work / w.span);
        fflush(stdout);
    }
    tellAlone(&w);
    MeProfileWatch(NULL, NULL);
    MeProfileStopTiming();
    free(w.made);
    free(w.used);
}
