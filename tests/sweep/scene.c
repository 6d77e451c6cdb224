/* A scene for the tests of karma-sweep: results that anybody can compute; runs that fail, crash, hang or do what a run
 * should not, on demand. */
#define _GNU_SOURCE /* setitimer, usleep */
#include "KarmaSweep.h"
#include <fcntl.h>
#include <fenv.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

enum { A, B, MISHAP };
static const SweepParameter parameters[] = {{"a [m]", 0, 3, 4}, {"b", -1, 1, 3}, {"mishap", 0, 0, 1}};
static const char *const results[] = {"product [m]", "root", "nothing"};

/* Microseconds that a run takes. */
static void delay(void) {
    const char *text = getenv("SWEEP_TEST_DELAY");
    if (text)
        usleep((unsigned int)strtoul(text, NULL, 10));
}

/* ---- mishaps; each returns what the run returns ------------------------------------------------------------------ */

static int nothing(void) {
    return 0;
}

static int isKilled(void) {
    return raise(SIGKILL);
}

static int hangs(void) {
    return pause();
}

static int fails(void) {
    return 7;
}

static int stops(void) {
    return raise(SIGSTOP);
}

static void handle(int number) {
    (void)number;
}

static int handlesAllSignals(void) {
    for (int i = 1; i < NSIG; i++)
        signal(i, handle);
    return 0;
}

static int blocksAllSignals(void) {
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, NULL);
    while (pause() < 0)
        continue;
    return 0;
}

static int handlesAndLoops(void) {
    handlesAllSignals();
    while (pause() < 0)
        continue;
    return 0;
}

static int becomesAnother(void) {
    return execl("/bin/sleep", "sleep", "100", (char *)NULL);
}

static int closesAll(void) {
    for (int i = 0; i < 256; i++)
        close(i);
    return 0;
}

static int closesStreams(void) {
    fclose(stdin);
    fclose(stdout);
    fclose(stderr);
    return 0;
}

/* Whatever is open: rows that nobody asked for, and the end of what is in files. */
static int writesToAll(void) {
    const char *rubbish = "3 ok 666 666 666\n";
    char byte[16];
    for (int i = 0; i < 256; i++) {
        fcntl(i, F_SETFL, O_NONBLOCK);
        if (read(i, byte, sizeof byte) < 0 || write(i, rubbish, strlen(rubbish)) < 0 || ftruncate(i, 0) != 0)
            continue;
    }
    return 0;
}

static int leavesChild(void) {
    if (fork() == 0) {
        signal(SIGHUP, SIG_IGN);
        sleep(100);
        _exit(0);
    }
    return 0;
}

static int returnsTwice(void) {
    return fork() == 0 ? 9 : 0;
}

static int leaves(void) {
    exit(0);
    return 0;
}

static int leavesAtOnce(void) {
    _exit(3);
    return 0;
}

static int aborts(void) {
    abort();
    return 0;
}

static int prints(void) {
    for (int i = 0; i < 20000; i++)
        printf("a line of no importance, number %d\n", i);
    return fprintf(stderr, "the end\n") < 0;
}

static int roundsUp(void) {
    return fesetround(FE_UPWARD);
}

static int killsGroup(void) {
    return kill(0, SIGTERM);
}

/* The next run in this process is hit. */
static int leavesTimer(void) {
    const struct itimerval soon = {.it_value = {.tv_usec = 1000}};
    return setitimer(ITIMER_REAL, &soon, NULL);
}

static int (*const mishaps[])(void) = {
    nothing,         isKilled,       hangs,     fails,         stops,       handlesAllSignals, blocksAllSignals,
    handlesAndLoops, becomesAnother, closesAll, closesStreams, writesToAll, leavesChild,       returnsTwice,
    leaves,          leavesAtOnce,   aborts,    prints,        roundsUp,    killsGroup,        leavesTimer};

static int run(const double *p, double *result) {
    delay();
    result[0] = p[A] * p[B];
    result[1] = sqrt(p[A] + 10);
    return p[A] == 2 ? mishaps[(int)p[MISHAP]]() : 0;
}

static const SweepScene scene = {SWEEP_VERSION, "test", 3, parameters, 3, results, run};

SWEEP_EXPORT const SweepScene *sweepScene(void) {
    return &scene;
}
