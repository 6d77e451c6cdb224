/* A worker: a process of this machine that makes runs, one after the other, whatever these do to their process.
 *
 * Numbers of runs and results go through memory that pool and worker share, the worker's desk, and not through pipes: a
 * run may close, read or write descriptors as it likes. A worker has only its standard ones and those that the scene's
 * library opened when it was loaded. Its output is a pipe of its own, of which the pool shows a part. It has a process
 * group of its own: signals to the group stay there, and children of a run end with the worker. */
#include "sweep_i.h"
#include <errno.h>
#include <fcntl.h>
#include <fenv.h>
#include <math.h>
#include <semaphore.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* Two rings. No more than SWEEP_SHARE runs are given and not answered, so that no place is written before it has been
 * read. */
struct SweepDesk {
    sem_t waiting;         /* runs that the worker has not begun */
    long run[SWEEP_SHARE]; /* by the pool */
    atomic_ulong answered; /* by the worker, as the rest */
    SweepAnswer answer[SWEEP_SHARE];
};

/* ---- in the worker ----------------------------------------------------------------------------------------------- */

static SweepAnswer makeRun(const SweepPlan *plan, long run) {
    SweepAnswer a = {.run = run};
    double value[SWEEP_PARAMETERS];
    fesetenv(FE_DFL_ENV); /* of the run before */
    sweep_planValues(plan, run, value);
    for (int i = 0; i < SWEEP_RESULTS; i++)
        a.result[i] = NAN;
    a.status = plan->scene->run(value, a.result);
    fflush(stdout);
    return a;
}

/* A worker without a pool has nothing to live for. The run before may have wished otherwise. */
static void dieWith(pid_t pool) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != pool)
        _exit(0);
}

_Noreturn static void work(SweepDesk *desk, const SweepPlan *plan, pid_t pool) {
    const pid_t self = getpid();
    for (unsigned long count = 0;; count++) {
        dieWith(pool);
        while (sem_wait(&desk->waiting) != 0)
            continue; /* a signal that the scene handles */
        const SweepAnswer a = makeRun(plan, desk->run[count % SWEEP_SHARE]);
        if (getpid() != self)
            _exit(0); /* a process that the run forked has returned from it, too */
        desk->answer[count % SWEEP_SHARE] = a;
        atomic_store(&desk->answered, count + 1);
        kill(pool, SIGCHLD);
    }
}

static void useFile(int from, int to) {
    if (from >= 0 && from != to)
        dup2(from, to);
}

/* Forked from the pool, it makes itself at home: nothing of the pool stays within reach of a run. */
_Noreturn static void beWorker(const SweepCrew *crew, SweepDesk *desk, int output, pid_t pool) {
    setpgid(0, 0);
    useFile(open("/dev/null", O_RDONLY), STDIN_FILENO);
    useFile(output, STDOUT_FILENO);
    useFile(output, STDERR_FILENO);
    sweep_sceneCloseOthers();
    setvbuf(stdout, NULL, _IOLBF, 0);
    for (int i = 0; i < crew->count; i++)
        if (crew->worker[i].desk)
            munmap(crew->worker[i].desk, sizeof *desk);
    signal(SIGCHLD, SIG_DFL);
    signal(SIGPIPE, SIG_IGN); /* what it prints is of no importance, nor whether there is room in files */
    signal(SIGXFSZ, SIG_IGN);
    sigprocmask(SIG_SETMASK, &crew->signals, NULL);
    work(desk, crew->plan, pool);
}

/* ---- in the pool ------------------------------------------------------------------------------------------------- */

/* Null: there is none. */
static SweepDesk *makeDesk(void) {
    SweepDesk *desk = mmap(NULL, sizeof *desk, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (desk == MAP_FAILED)
        return NULL;
    sem_init(&desk->waiting, 1, 0);
    return desk;
}

static bool startOn(SweepCrew *crew, SweepDesk *desk, SweepWorker *w) {
    int output[2];
    const pid_t pool = getpid();
    if (pipe(output) != 0)
        return false;
    fflush(NULL);
    const pid_t process = fork();
    if (process == 0)
        beWorker(crew, desk, output[1], pool);
    const int error = errno;
    close(output[1]);
    if (process < 0) {
        close(output[0]);
        errno = error;
        return false;
    }
    setpgid(process, process);
    fcntl(output[0], F_SETFL, O_NONBLOCK);
    *w = (SweepWorker){.process = process, .output = output[0], .desk = desk, .lateIn = -1};
    return true;
}

bool sweep_workerStart(SweepCrew *crew, SweepWorker *w) {
    SweepDesk *desk = makeDesk();
    if (desk && startOn(crew, desk, w))
        return true;
    const int error = errno;
    if (desk)
        munmap(desk, sizeof *desk);
    errno = error;
    return false;
}

void sweep_workerGive(SweepWorker *w, long run, double now) {
    if (w->given == 0)
        w->since = now;
    w->run[w->given] = run;
    w->desk->run[(w->taken + (unsigned long)w->given++) % SWEEP_SHARE] = run;
    sem_post(&w->desk->waiting);
}

SweepTaken sweep_workerTake(SweepWorker *w, SweepAnswer *a, double now) {
    const unsigned long answered = atomic_load(&w->desk->answered);
    if (answered == w->taken)
        return SWEEP_NONE;
    *a = w->desk->answer[w->taken % SWEEP_SHARE];
    if (answered - w->taken > (unsigned long)w->given || a->run != w->run[0])
        return SWEEP_RUBBISH;
    w->taken++;
    w->since = now;
    memmove(w->run, w->run + 1, (size_t)--w->given * sizeof *w->run);
    return SWEEP_TAKEN;
}

void sweep_workerEnd(SweepWorker *w) {
    w->isEnded = true;
    kill(w->process, SIGKILL);
}

bool sweep_workerIsDead(const SweepWorker *w) {
    siginfo_t info = {0};
    return waitid(P_PID, (id_t)w->process, &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == w->process;
}

int sweep_workerBury(SweepWorker *w) {
    int status = 0;
    kill(-w->process, SIGKILL); /* what its runs have left; as long as it is not waited for, the number is its own */
    while (waitpid(w->process, &status, 0) < 0 && errno == EINTR)
        continue;
    if (w->output >= 0)
        close(w->output);
    munmap(w->desk, sizeof *w->desk);
    *w = (SweepWorker){.output = -1};
    return status;
}
