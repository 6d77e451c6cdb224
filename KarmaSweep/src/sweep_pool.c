/* Processes of this machine that run the scene: a worker reads numbers of runs from a pipe and answers with rows.
 *
 * A worker that dies is reported, and another takes its place; the run in which it died is tried again, up to three
 * times, and what it was to do after that goes to whoever is free. A worker whose pool is gone reads the end of its
 * pipe, and ends. */
#define _DEFAULT_SOURCE /* alarm, kill */
#include "sweep_i.h"
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SHARE = 4 }; /* runs that wait in a worker's pipe, so that it need not wait for the pool */
enum { TRIES = 3 }; /* of a run that ends its process: a killed worker is no fault of the run */
enum { MOST_WORKERS = 256 };

typedef struct Worker {
    pid_t process;
    int to, from; /* pipes */
    long run[SHARE];
    int given; /* runs that it has not answered yet: run[0] is the one at work */
    char text[2 * SWEEP_ROW];
    size_t length;
} Worker;

typedef struct Trouble {
    long run;
    int tries;
} Trouble;

struct SweepPool {
    const SweepPlan *plan;
    SweepClient client;
    int limit;
    int count;
    Worker worker[MOST_WORKERS];
    long *again; /* runs of workers that died */
    long againCount, againRoom;
    Trouble *trouble; /* runs in which workers died */
    int troubleCount, troubleRoom;
};

/* ---- in a worker ------------------------------------------------------------------------------------------------- */

static void writeRow(int to, const SweepPlan *plan, long run, int status, const double *result) {
    char text[SWEEP_ROW], number[40];
    int length = snprintf(text, sizeof text, status == 0 ? "%ld ok" : "%ld failed(%d)", run, status);
    for (int i = 0; i < plan->scene->resultCount && status == 0; i++) {
        sweep_number(number, sizeof number, result[i]);
        length += snprintf(text + length, sizeof text - (size_t)length, " %s", number);
    }
    text[length++] = '\n';
    if (write(to, text, (size_t)length) != length) /* no more than PIPE_BUF: all or nothing */
        _exit(1);
}

_Noreturn static void work(const SweepPlan *plan, int limit, int from, int to) {
    double value[SWEEP_PARAMETERS], result[SWEEP_RESULTS];
    long run;
    signal(SIGPIPE, SIG_DFL);
    signal(SIGALRM, SIG_DFL);
    while (read(from, &run, sizeof run) == (ssize_t)sizeof run) {
        sweep_planValues(plan, run, value);
        for (int i = 0; i < SWEEP_RESULTS; i++)
            result[i] = NAN;
        alarm((unsigned int)limit); /* 0: none */
        const int status = plan->scene->run(value, result);
        alarm(0);
        writeRow(to, plan, run, status, result);
    }
    _exit(0);
}

/* ---- workers ----------------------------------------------------------------------------------------------------- */

/* A process of fork has all pipes of the pool: as long as it held one, its neighbour would not see the end of it. */
static void closePipes(const SweepPool *pool) {
    for (int i = 0; i < pool->count; i++)
        if (pool->worker[i].process > 0) {
            close(pool->worker[i].to);
            close(pool->worker[i].from);
        }
}

static void hire(SweepPool *pool, Worker *w) {
    int down[2], up[2];
    if (pipe(down) != 0 || pipe(up) != 0)
        sweep_fail("there are no more pipes: %s", strerror(errno));
    fflush(NULL);
    const pid_t process = fork();
    if (process < 0)
        sweep_fail("there are no more processes: %s", strerror(errno));
    if (process == 0) {
        closePipes(pool);
        close(down[1]);
        close(up[0]);
        work(pool->plan, pool->limit, down[0], up[1]);
    }
    close(down[0]);
    close(up[1]);
    fcntl(up[0], F_SETFL, O_NONBLOCK);
    w->process = process;
    w->to = down[1];
    w->from = up[0];
    w->given = 0;
    w->length = 0;
}

static void dismiss(Worker *w) {
    close(w->to);
    close(w->from);
    w->process = 0;
}

/* ---- runs that are tried again ----------------------------------------------------------------------------------- */

static void *room(void *block, long used, long count, size_t size) {
    void *larger = used < count ? block : realloc(block, (size_t)(2 * count + 16) * size);
    if (!larger)
        sweep_fail("no memory");
    return larger;
}

static void tryAgain(SweepPool *pool, long run) {
    pool->again = room(pool->again, pool->againCount, pool->againRoom, sizeof *pool->again);
    pool->againRoom = pool->againCount < pool->againRoom ? pool->againRoom : 2 * pool->againRoom + 16;
    pool->again[pool->againCount++] = run;
}

/* How often workers have died in this run, this time included. */
static int countTrouble(SweepPool *pool, long run) {
    for (int i = 0; i < pool->troubleCount; i++)
        if (pool->trouble[i].run == run)
            return ++pool->trouble[i].tries;
    pool->trouble = room(pool->trouble, pool->troubleCount, pool->troubleRoom, sizeof *pool->trouble);
    pool->troubleRoom = pool->troubleCount < pool->troubleRoom ? pool->troubleRoom : 2 * pool->troubleRoom + 16;
    pool->trouble[pool->troubleCount++] = (Trouble){run, 1};
    return 1;
}

/* ---- a worker has died ------------------------------------------------------------------------------------------- */

static void sayDeath(const Worker *w, int status, long run, const char *then) {
    char how[64];
    if (WIFSIGNALED(status))
        snprintf(how, sizeof how, "was ended by signal %d (%s)", WTERMSIG(status), strsignal(WTERMSIG(status)));
    else
        snprintf(how, sizeof how, "left with exit code %d", WEXITSTATUS(status));
    if (run >= 0)
        sweep_say("worker process %ld %s in run %ld: %s", (long)w->process, how, run, then);
    else
        sweep_say("worker process %ld %s while it waited", (long)w->process, how);
}

static void bury(SweepPool *pool, Worker *w) {
    int status = 0;
    while (waitpid(w->process, &status, 0) < 0 && errno == EINTR)
        continue;
    const long run = w->given > 0 ? w->run[0] : -1;
    const bool isLate = pool->limit > 0 && WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM;
    const bool isOver = run >= 0 && (isLate || countTrouble(pool, run) >= TRIES);
    sayDeath(w, status, run, isLate ? "it took too long" : isOver ? "given up" : "its share is run again");
    if (isOver)
        pool->client.row(pool->client.data, run, isLate ? "late" : "died");
    for (int i = w->given - 1; i >= (isOver ? 1 : 0); i--)
        tryAgain(pool, w->run[i]);
    dismiss(w);
    hire(pool, w);
}

/* ---- runs and rows ----------------------------------------------------------------------------------------------- */

static void takeRow(SweepPool *pool, Worker *w, const char *line) {
    char *row;
    const long run = strtol(line, &row, 10);
    if (w->given == 0 || run != w->run[0] || *row != ' ')
        sweep_fail("a worker has answered what nobody asked: %s", line);
    memmove(w->run, w->run + 1, (size_t)--w->given * sizeof *w->run);
    pool->client.row(pool->client.data, run, row + 1);
}

/* False: the worker is gone. */
static bool readRows(SweepPool *pool, Worker *w) {
    const ssize_t got = read(w->from, w->text + w->length, sizeof w->text - w->length);
    if (got < 0)
        return errno == EAGAIN || errno == EINTR;
    w->length += (size_t)got;
    for (char *end; (end = memchr(w->text, '\n', w->length)) != NULL;) {
        const size_t line = (size_t)(end + 1 - w->text);
        *end = 0;
        takeRow(pool, w, w->text);
        memmove(w->text, w->text + line, w->length -= line);
    }
    return got > 0;
}

static long takeRun(SweepPool *pool) {
    return pool->againCount > 0 ? pool->again[--pool->againCount] : pool->client.take(pool->client.data);
}

/* Evenly: each worker gets its next run before any gets the one after it. */
static bool giveRuns(SweepPool *pool) {
    bool areAny = false;
    for (int depth = 0; depth < SHARE; depth++)
        for (int i = 0; i < pool->count; i++) {
            Worker *w = &pool->worker[i];
            if (w->given == depth) {
                const long run = takeRun(pool);
                if (run < 0)
                    break;
                w->run[w->given++] = run;
                if (write(w->to, &run, sizeof run) != (ssize_t)sizeof run)
                    continue; /* it is gone: its pipe says so, too */
            }
            areAny |= w->given > 0;
        }
    for (int i = 0; i < pool->count; i++)
        areAny |= pool->worker[i].given > 0;
    return areAny;
}

bool sweep_poolTurn(SweepPool *pool, int wait) {
    struct pollfd file[MOST_WORKERS];
    const bool areAny = giveRuns(pool);
    for (int i = 0; i < pool->count; i++)
        file[i] = (struct pollfd){.fd = pool->worker[i].from, .events = POLLIN};
    if (poll(file, (nfds_t)pool->count, wait) > 0)
        for (int i = 0; i < pool->count; i++)
            if (file[i].revents && !readRows(pool, &pool->worker[i]))
                bury(pool, &pool->worker[i]);
    return areAny;
}

/* ---- life -------------------------------------------------------------------------------------------------------- */

SweepPool *sweep_poolCreate(const SweepPlan *plan, int workers, int limit, const SweepClient *client) {
    SweepPool *pool = sweep_memory(1, sizeof *pool);
    pool->plan = plan;
    pool->client = *client;
    pool->limit = limit;
    signal(SIGPIPE, SIG_IGN);
    for (int i = 0; i < workers && i < MOST_WORKERS; i++, pool->count++)
        hire(pool, &pool->worker[i]);
    return pool;
}

void sweep_poolDestroy(SweepPool *pool) {
    for (int i = 0; i < pool->count; i++) {
        const pid_t process = pool->worker[i].process;
        dismiss(&pool->worker[i]);
        waitpid(process, NULL, 0);
    }
    free(pool->again);
    free(pool->trouble);
    free(pool);
}
