/* The workers of this machine: which runs they get, what becomes of their rows, and what is done when they die.
 *
 * A worker that dies is reported, and another takes its place. The run in which it died is the first one of the new
 * process, so that it cannot suffer twice from what ran before; it is tried three times in all. The rest of the dead
 * worker's share goes to whoever is free. The pool keeps the time: it kills a worker whose run takes longer than the
 * limit, whatever that does with signals. SIGCHLD says that a worker has an answer, or has died. */
#include "sweep_i.h"
#include <errno.h>
#include <math.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { TRIES = 3 };           /* of a run that ends its process: a killed worker is no fault of the run */
enum { PRINTED = 10000 };     /* bytes that are shown of what a run prints: 10000 runs fill no more than 100 MB */
static const double AWAY = 1; /* s between two looks at the clock; longer, and karma-sweep itself was stopped */

struct SweepPool {
    SweepCrew crew;
    SweepClient client;
    int limit;
    double clock, looked;    /* s: time that runs had, and of the last look at the system's clock */
    double missedAt;         /* clock of the last attempt to start a process in vain */
    sigset_t awake;          /* signals that are blocked while it waits */
    bool isShort, isFlooded; /* said once: there are fewer processes; a run prints too much */
    long *again;             /* runs of workers that died */
    long againCount, againRoom;
    unsigned char *tries; /* by run: workers that died in it */
};

/* ---- clock ------------------------------------------------------------------------------------------------------- */

static double systemTime(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void lookAtClock(SweepPool *pool) {
    const double now = systemTime();
    pool->clock += fmin(now - pool->looked, AWAY);
    pool->looked = now;
}

/* ---- workers ----------------------------------------------------------------------------------------------------- */

static bool areAnyAlive(const SweepCrew *crew) {
    for (int i = 0; i < crew->count; i++)
        if (crew->worker[i].process > 0)
            return true;
    return false;
}

/* With fewer processes than were wanted it takes longer; with none it ends. */
static bool hire(SweepPool *pool, SweepWorker *w) {
    if (sweep_workerStart(&pool->crew, w))
        return true;
    const char *why = strerror(errno);
    if (!areAnyAlive(&pool->crew))
        sweep_fail(
            "no worker process can be started: %s: make room (ulimit -u, ulimit -n, memory), and start again: the "
            "journal has all rows so far",
            why);
    if (!pool->isShort)
        sweep_say("a worker process cannot be started: %s: the others go on; fewer are asked for by -workers", why);
    pool->isShort = true;
    pool->missedAt = pool->clock;
    return false;
}

static void hireMissing(SweepPool *pool) {
    for (int i = 0; i < pool->crew.count; i++)
        if (pool->crew.worker[i].process == 0 && pool->clock - pool->missedAt >= 1 &&
            !hire(pool, &pool->crew.worker[i]))
            return;
}

/* ---- output ------------------------------------------------------------------------------------------------------ */

static void show(const char *text, size_t size) {
    while (size > 0) {
        const ssize_t written = write(STDERR_FILENO, text, size);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return; /* nobody looks */
        text += written;
        size -= (size_t)written;
    }
}

/* What runs print goes to stderr, but for floods. Which run has printed it is known but nearly: the worker may be a run
 * ahead of what the pool knows. */
static void relay(SweepPool *pool, SweepWorker *w) {
    char text[4096];
    ssize_t got = -1;
    for (int turn = 0; turn < 16 && (got = read(w->output, text, sizeof text)) > 0; turn++) {
        const size_t left = w->printed <= PRINTED ? PRINTED - w->printed : 0;
        const bool isCutOff = w->printed <= PRINTED && (size_t)got > left;
        show(text, (size_t)got < left ? (size_t)got : left);
        w->printed += (size_t)got;
        if (isCutOff)
            show("\n", 1);
        if (isCutOff && !pool->isFlooded)
            sweep_say("run %ld, or one near it, prints more than %d bytes: what runs print beyond that is not shown",
                      w->run[0], PRINTED);
        pool->isFlooded |= isCutOff;
    }
    if (got == 0) { /* closed by the run */
        close(w->output);
        w->output = -1;
    }
}

/* ---- a worker has died ------------------------------------------------------------------------------------------- */

static void tryAgain(SweepPool *pool, long run) {
    if (pool->againCount == pool->againRoom) {
        pool->againRoom = 2 * pool->againRoom + 16;
        pool->again = realloc(pool->again, (size_t)pool->againRoom * sizeof *pool->again);
        if (!pool->again)
            sweep_fail("no memory");
    }
    pool->again[pool->againCount++] = run;
}

static void sayDeath(pid_t process, int status, long run, const char *then) {
    char how[64];
    if (WIFSIGNALED(status))
        snprintf(how, sizeof how, "was ended by signal %d (%s)", WTERMSIG(status), strsignal(WTERMSIG(status)));
    else
        snprintf(how, sizeof how, "left with exit code %d", WEXITSTATUS(status));
    if (run >= 0)
        sweep_say("worker process %ld %s in run %ld: %s", (long)process, how, run, then);
    else
        sweep_say("worker process %ld %s while it waited", (long)process, how);
}

/* Says how it ended, and returns the status of its run if that is not tried again. */
static const char *judge(SweepPool *pool, const SweepWorker *dead, int status) {
    const long run = dead->given > 0 ? dead->run[0] : -1;
    if (run >= 0 && run == dead->lateIn) {
        sweep_say("worker process %ld took more than %d s (-limit) in run %ld: it is ended", (long)dead->process,
                  pool->limit, run);
        return "late";
    }
    /* A run that had just been begun when the one before was found late is no cause. */
    const bool isFault = run >= 0 && dead->lateIn < 0;
    const bool isOver = isFault && ++pool->tries[run] >= TRIES;
    sayDeath(dead->process, status, run, isOver ? "given up" : "its share is run again");
    return isOver ? "died" : NULL;
}

static void bury(SweepPool *pool, SweepWorker *w) {
    relay(pool, w);
    const SweepWorker dead = *w;
    const char *end = judge(pool, &dead, sweep_workerBury(w));
    for (int i = dead.given - 1; i >= 1; i--)
        tryAgain(pool, dead.run[i]);
    const bool isHired = hire(pool, w);
    if (end)
        pool->client.row(pool->client.data, dead.run[0], end);
    else if (dead.given > 0 && isHired)
        sweep_workerGive(w, dead.run[0], pool->clock);
    else if (dead.given > 0)
        tryAgain(pool, dead.run[0]);
}

/* ---- runs and rows ----------------------------------------------------------------------------------------------- */

static void sendRow(const SweepPool *pool, const SweepAnswer *a) {
    char text[SWEEP_ROW], number[40];
    int length = snprintf(text, sizeof text, a->status == 0 ? "ok" : "failed(%d)", a->status);
    for (int i = 0; i < pool->crew.plan->scene->resultCount && a->status == 0; i++) {
        sweep_number(number, sizeof number, a->result[i]);
        length += snprintf(text + length, sizeof text - (size_t)length, " %s", number);
    }
    pool->client.row(pool->client.data, a->run, text);
}

static void takeAnswers(SweepPool *pool, SweepWorker *w) {
    SweepAnswer a;
    SweepTaken taken;
    while ((taken = sweep_workerTake(w, &a, pool->clock)) == SWEEP_TAKEN) {
        relay(pool, w);
        w->printed = 0;
        sendRow(pool, &a);
    }
    if (taken == SWEEP_RUBBISH && !w->isEnded)
        sweep_workerEnd(w);
}

static long takeRun(SweepPool *pool) {
    return pool->againCount > 0 ? pool->again[--pool->againCount] : pool->client.take(pool->client.data);
}

/* Evenly: each worker gets its next run before any gets the one after it. */
static bool giveRuns(SweepPool *pool) {
    bool areAny = false;
    for (int depth = 0; depth < SWEEP_SHARE; depth++)
        for (int i = 0; i < pool->crew.count; i++) {
            SweepWorker *w = &pool->crew.worker[i];
            if (w->process == 0 || w->given != depth)
                continue;
            const long run = takeRun(pool);
            if (run < 0)
                break;
            sweep_workerGive(w, run, pool->clock);
        }
    for (int i = 0; i < pool->crew.count; i++)
        areAny |= pool->crew.worker[i].given > 0;
    return areAny || pool->againCount > 0;
}

/* ---- course ------------------------------------------------------------------------------------------------------ */

static double timeLeft(const SweepPool *pool, const SweepWorker *w) {
    return pool->limit > 0 && w->given > 0 && !w->isEnded ? w->since + pool->limit - pool->clock : INFINITY;
}

/* Until a worker has something to say, or a run's time is over, or so many ms are. */
static void waitForWorkers(SweepPool *pool, int wait) {
    struct pollfd file[SWEEP_WORKERS];
    double seconds = wait / 1e3;
    for (int i = 0; i < pool->crew.count; i++) {
        SweepWorker *w = &pool->crew.worker[i];
        file[i] = (struct pollfd){.fd = w->process > 0 ? w->output : -1, .events = POLLIN};
        seconds = fmax(fmin(seconds, timeLeft(pool, w)), 0);
    }
    const struct timespec t = {(time_t)seconds, (long)((seconds - floor(seconds)) * 1e9)};
    if (ppoll(file, (nfds_t)pool->crew.count, &t, &pool->awake) <= 0)
        return;
    for (int i = 0; i < pool->crew.count; i++)
        if (file[i].revents)
            relay(pool, &pool->crew.worker[i]);
}

bool sweep_poolTurn(SweepPool *pool, int wait) {
    hireMissing(pool);
    const bool areAny = giveRuns(pool);
    waitForWorkers(pool, wait);
    lookAtClock(pool);
    for (int i = 0; i < pool->crew.count; i++) {
        SweepWorker *w = &pool->crew.worker[i];
        if (w->process == 0)
            continue;
        const bool isDead = sweep_workerIsDead(w); /* its last answers are taken after that */
        takeAnswers(pool, w);
        if (isDead)
            bury(pool, w);
        else if (timeLeft(pool, w) <= 0) {
            w->lateIn = w->run[0];
            sweep_workerEnd(w);
        }
    }
    return areAny;
}

/* ---- life -------------------------------------------------------------------------------------------------------- */

static void wake(int number) {
    (void)number; /* it ends ppoll */
}

static void takeSignals(SweepPool *pool) {
    struct sigaction action = {.sa_handler = wake, .sa_flags = SA_RESTART};
    sigset_t child;
    sigemptyset(&child);
    sigaddset(&child, SIGCHLD);
    sigprocmask(SIG_BLOCK, &child, &pool->crew.signals);
    pool->awake = pool->crew.signals;
    sigdelset(&pool->awake, SIGCHLD);
    sigaction(SIGCHLD, &action, NULL);
}

SweepPool *sweep_poolCreate(const SweepPlan *plan, int workers, int limit, const SweepClient *client) {
    SweepPool *pool = sweep_memory(1, sizeof *pool);
    pool->crew.plan = plan;
    pool->crew.count = workers < SWEEP_WORKERS ? workers : SWEEP_WORKERS;
    pool->client = *client;
    pool->limit = limit;
    pool->looked = systemTime();
    pool->missedAt = -INFINITY;
    pool->tries = sweep_memory((size_t)plan->runs, sizeof *pool->tries);
    takeSignals(pool);
    hireMissing(pool);
    return pool;
}

void sweep_poolDestroy(SweepPool *pool) {
    for (int i = 0; i < pool->crew.count; i++)
        if (pool->crew.worker[i].process > 0) {
            sweep_workerEnd(&pool->crew.worker[i]);
            sweep_workerBury(&pool->crew.worker[i]);
        }
    signal(SIGCHLD, SIG_DFL);
    sigprocmask(SIG_SETMASK, &pool->crew.signals, NULL);
    free(pool->again);
    free(pool->tries);
    free(pool);
}
