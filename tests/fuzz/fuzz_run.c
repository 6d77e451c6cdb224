/* One run in a process of its own, and what is found there; and the shortening of what was found. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS, setitimer */
#include "fuzz.h"

#include <errno.h>
#include <fcntl.h>
#include <malloc.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "MeMemory.h"
#include "MeMessage.h"

#if defined __SANITIZE_ADDRESS__
#define IS_SANITIZED 1
#elif defined __has_feature
#if __has_feature(address_sanitizer)
#define IS_SANITIZED 1
#endif
#endif
#ifndef IS_SANITIZED
#define IS_SANITIZED 0
#endif

/* What a run tells the process that began it. */
typedef struct Told {
    FuzzLine lines;
    size_t current; /* where the line begins that is being executed */
    int calls;
    char why[FUZZ_WHY];
    char text[FUZZ_BYTES];
} Told;

static Told *told;
static FILE *errors; /* what a run says on stderr */

double fuzzClock(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- in the run ---- */

enum { EXIT_FOUND = 77 };

void fuzzFail(const char *format, ...) {
    va_list ap;
    va_start(ap, format);
    vsnprintf(told->why, sizeof told->why, format, ap);
    va_end(ap);
    _exit(EXIT_FOUND);
}

static void MEAPI onFatalError(const int level, const char *const format, va_list ap) {
    (void)level;
    char text[MeMAXMESSAGE];
    vsnprintf(text, sizeof text, format, ap);
    if (strstr(text, "not true:"))
        fuzzFail("%s", text);
}

static void MEAPI ignore(const int level, const char *const format, va_list ap) {
    (void)level;
    char text[MeMAXMESSAGE];
    vsnprintf(text, sizeof text, format, ap); /* reads what is to be printed */
}

enum { LARGEST_BLOCK = 16 << 20, LARGEST_SUM = 256 << 20 };
static size_t inUse; /* bytes; threads of a run share it, and it need not be exact */

static void *MEAPI take(size_t bytes) {
    void *block = bytes > LARGEST_BLOCK || inUse > LARGEST_SUM ? NULL : malloc(bytes ? bytes : 1);
    inUse += block ? malloc_usable_size(block) : 0;
    return block;
}

static void *MEAPI takeAligned(size_t bytes, unsigned int alignment) {
    const size_t size = (bytes + alignment) / alignment * alignment;
    void *block = bytes > LARGEST_BLOCK || inUse > LARGEST_SUM ? NULL : aligned_alloc(alignment, size);
    inUse += block ? malloc_usable_size(block) : 0;
    return block;
}

static void MEAPI give(void *const block) {
    inUse -= block ? malloc_usable_size(block) : 0;
    free(block);
}

void fuzzCatchMessages(void) {
    MeMemoryAPI.create = take;
    MeMemoryAPI.destroy = give;
    MeMemoryAPI.createAligned = takeAligned;
    MeMemoryAPI.destroyAligned = give;
    MeSetFatalErrorHandler(onFatalError);
    MeSetWarningHandler(ignore);
    MeSetInfoHandler(ignore);
    MeSetDebugHandler(ignore);
    MeSetLogHandler(ignore);
}

static void say(const char *what) {
    if (write(STDERR_FILENO, what, strlen(what)) < 0)
        return;
}

static MeBool isLoud;

void fuzzNote(const char *line) {
    if (!isLoud)
        return;
    say("    in a callback: ");
    say(line);
    say("\n");
}

static void watch(const FuzzTarget *target) {
    const double seconds = target->patience * (IS_SANITIZED ? 4 : 1);
    struct itimerval timer = {{0, 0}, {(time_t)seconds, (suseconds_t)(1e6 * (seconds - (double)(time_t)seconds))}};
    setitimer(ITIMER_PROF, &timer, NULL);
}

static void execute(const FuzzTarget *target, const char *line) {
    static char copy[FUZZ_BYTES];
    snprintf(copy, sizeof copy, "%s", line);
    watch(target);
    told->calls++;
    target->execute(copy);
}

static void generate(const FuzzTarget *target, FuzzRandom *random, int index) {
    FuzzLine *const lines = &told->lines;
    if (lines->used + 4096 > lines->size)
        return;
    told->current = lines->used;
    target->generate(random, index, lines);
    execute(target, told->text + told->current);
    fuzzWrite(lines, "\n");
}

static void repeat(const FuzzTarget *target, const char *line) {
    told->current = told->lines.used;
    fuzzWrite(&told->lines, "%s", line);
    execute(target, line);
    fuzzWrite(&told->lines, "\n");
}

static void MEAPI sayWarning(const int level, const char *const format, va_list ap) {
    (void)level;
    char text[MeMAXMESSAGE + 8];
    vsnprintf(text, MeMAXMESSAGE, format, ap);
    strcat(text, "\n");
    say(text);
}

static void child(const FuzzTarget *target, const FuzzOrder *order) {
    static const int nastiness[] = {0, 1, 4, 12, 40};
    FuzzRandom random = {order->seed, 0, order->run};
    random.nasty = nastiness[fuzzBelow(&random, 5)];
    fuzzCatchMessages();
    isLoud = order->isLoud;
    if (isLoud)
        MeSetWarningHandler(sayWarning);
    watch(target);
    target->begin();
    for (int i = 0; i < order->count; i++) {
        if (order->lines)
            repeat(target, order->lines[i]);
        else
            generate(target, &random, i);
        if (order->isLoud) {
            say(told->text + told->current);
        }
    }
    told->current = told->lines.used;
    fuzzWrite(&told->lines, "(end)");
    watch(target);
    target->end();
    _exit(0);
}

/* ---- in the process that began it ---- */

/* The line of a sanitizer's report that says what it is about, without addresses. */
static MeBool readReport(char why[FUZZ_WHY]) {
    char line[1024];
    rewind(errors);
    while (fgets(line, sizeof line, errors)) {
        const char *at = strstr(line, "runtime error: ");
        if (!at)
            at = strstr(line, "SUMMARY: ");
        if (!at)
            continue;
        line[strcspn(line, "\n")] = 0;
        const char *address = strstr(line, " address 0x");
        snprintf(why, FUZZ_WHY, "%.*s", address ? (int)(address - line) : FUZZ_WHY - 1, line);
        return METRUE;
    }
    return MEFALSE;
}

static void nameOfLine(const char *line, char name[80]) {
    snprintf(name, 80, "%.*s", (int)strcspn(line, " \n"), line);
}

static void explain(int status, FuzzOutcome *outcome) {
    char name[80];
    nameOfLine(told->text + told->current, name);
    if (told->why[0])
        memcpy(outcome->why, told->why, FUZZ_WHY);
    else if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGPROF || WTERMSIG(status) == SIGALRM))
        snprintf(outcome->why, FUZZ_WHY, "does not end: %s", name);
    else if (readReport(outcome->why))
        return;
    else if (WIFSIGNALED(status))
        snprintf(outcome->why, FUZZ_WHY, "%s: %s", strsignal(WTERMSIG(status)), name);
    else
        snprintf(outcome->why, FUZZ_WHY, "ends the program (%d): %s", WEXITSTATUS(status), name);
}

static void quieten(void) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(fileno(errors), STDERR_FILENO);
}

static void beginTold(void) {
    if (!told) {
        told = mmap(NULL, sizeof *told, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        errors = tmpfile();
    }
    if (told == MAP_FAILED || !errors) {
        perror("fuzz");
        exit(2);
    }
    told->lines = (FuzzLine){told->text, FUZZ_BYTES, 0};
    told->text[0] = told->why[0] = 0;
    told->calls = 0;
    told->current = 0;
    rewind(errors);
    if (ftruncate(fileno(errors), 0) != 0)
        perror("fuzz");
}

FuzzOutcome fuzzRun(const FuzzTarget *target, const FuzzOrder *order) {
    FuzzOutcome outcome = {MEFALSE, "", NULL, 0};
    beginTold();
    fflush(NULL);
    const pid_t process = fork();
    if (process < 0) {
        perror("fuzz");
        exit(2);
    }
    if (process == 0) {
        if (!order->isLoud)
            quieten();
        alarm(600); /* one that waits uses no processor */
        child(target, order);
    }
    int status;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    outcome.isFound = status != 0;
    if (outcome.isFound)
        explain(status, &outcome);
    outcome.text = told->text;
    outcome.calls = told->calls;
    return outcome;
}

static MeBool isStillFound(const FuzzTarget *target, char **lines, int count, const char *why) {
    const FuzzOrder order = {.lines = lines, .count = count};
    return strcmp(fuzzRun(target, &order).why, why) == 0;
}

/* Tries it without each `chunk` lines in turn, from the end. */
static int leaveOut(const FuzzTarget *target, char **lines, int count, int chunk, const char *why, double until) {
    char **fewer = malloc((size_t)(count + 1) * sizeof *fewer);
    for (int end = count; fewer && end > 0 && fuzzClock() < until; end -= chunk) {
        const int begin = end > chunk ? end - chunk : 0;
        memcpy(fewer, lines, (size_t)begin * sizeof *lines);
        memcpy(fewer + begin, lines + end, (size_t)(count - end) * sizeof *lines);
        if (!isStillFound(target, fewer, count - (end - begin), why))
            continue;
        memcpy(lines, fewer, (size_t)(count - (end - begin)) * sizeof *lines);
        count -= end - begin;
    }
    free(fewer);
    return count;
}

int fuzzShorten(const FuzzTarget *target, char **lines, int count, const char *why, double seconds) {
    const double until = fuzzClock() + seconds;
    int before = 0;
    for (int chunk = count / 2; chunk > 1; chunk /= 2)
        count = leaveOut(target, lines, count, chunk, why, until);
    while (count != before && fuzzClock() < until) {
        before = count;
        count = leaveOut(target, lines, count, 1, why, until);
    }
    return count;
}
