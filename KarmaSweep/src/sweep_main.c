/* karma-sweep: runs a scene over a grid or a sample of its parameters, on all processors of this machine or of several,
 * into one CSV file, whose bytes do not depend on how many those are. docs/sweep.md */
#include "sweep_i.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char usage[] =
    "usage: karma-sweep SCENE [options]       SCENE: a shared library, or a .c file (KarmaSweep.h)\n"
    "       mpirun -n RANKS karma-sweep SCENE [options]\n"
    "  -out FILE          the table, at first NAME.csv, and beside it its journal, FILE.journal\n"
    "  -set NAME=VALUE    a parameter; NAME=LEAST:LARGEST its range, NAME=LEAST:LARGEST:COUNT its places on the grid\n"
    "  -sample N          N sets of parameters, evenly spread; without it, all of the grid\n"
    "  -seed N            of the sample, at first 0\n"
    "  -workers N         processes, of each rank; at first as many as there are processors, with MPI 1\n"
    "  -limit S           a run that takes more than S seconds is ended\n"
    "  -silence S         a rank that says nothing for S seconds is taken for dead, at first 10\n"
    "  -again             forgets what the journal has\n"
    "  -list              tells the parameters and results of the scene, and ends\n"
    "A sweep that was stopped goes on where it was when it is started again with the same options.\n"
    "Exit code: 0, 1 if some runs have no results, 2 if there is no table.\n";

enum { SETTINGS = 4 * SWEEP_PARAMETERS };

typedef struct Options {
    const char *scene, *out;
    const char *set[SETTINGS];
    int setCount;
    long sample, workers, limit, silence, seed;
    bool again, list;
} Options;

/* ---- messages, memory, numbers ----------------------------------------------------------------------------------- */

static void say(const char *format, va_list arguments) {
    char text[1024];
    vsnprintf(text, sizeof text, format, arguments);
    fprintf(stderr, "karma-sweep: %s\n", text);
}

void sweep_say(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say(format, arguments);
    va_end(arguments);
}

_Noreturn void sweep_fail(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say(format, arguments);
    va_end(arguments);
    exit(2);
}

void *sweep_memory(size_t count, size_t size) {
    void *block = calloc(count ? count : 1, size);
    if (!block)
        sweep_fail("no memory");
    return block;
}

uint64_t sweep_hash(uint64_t hash, const void *data, size_t size) {
    for (const unsigned char *byte = data; size > 0; size--)
        hash = (hash ^ *byte++) * 1099511628211u;
    return hash;
}

void sweep_number(char *text, size_t size, double x) {
    if (x != x) {
        snprintf(text, size, "nan"); /* printf writes a sign where there is one, which depends on the processor */
        return;
    }
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, size, "%.*g", digits, x);
        if (strtod(text, NULL) == x)
            return;
    }
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

static const char *kindOf(mode_t mode) {
    return S_ISDIR(mode) ? "a directory" : S_ISFIFO(mode) ? "a pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
}

void sweep_mustBeFile(const char *path, const char *scene) {
    struct stat status, other;
    const bool isThere = stat(path, &status) == 0;
    if (!isThere && lstat(path, &status) == 0)
        sweep_fail("%s is a link to what cannot be found: choose another -out", path);
    if (isThere && !S_ISREG(status.st_mode))
        sweep_fail("%s is %s, which would be lost: choose another -out, a file", path, kindOf(status.st_mode));
    if (isThere && stat(scene, &other) == 0 && other.st_dev == status.st_dev && other.st_ino == status.st_ino)
        sweep_fail("%s is the scene, which would be lost: choose another -out", path);
}

/* As one of them, a file of ours would get what others print. */
static void openStandardFiles(void) {
    int file;
    while ((file = open("/dev/null", O_RDWR)) >= 0 && file <= STDERR_FILENO)
        continue;
    close(file);
}

/* ---- options ----------------------------------------------------------------------------------------------------- */

/* Options with a number, and which it may be. */
typedef struct NumberOption {
    const char *name;
    long least, most;
} NumberOption;

enum { SAMPLE, SEED, WORKERS, LIMIT, SILENCE, NUMBERS };
static const NumberOption numbers[NUMBERS] = {{"-sample", 1, SWEEP_RUNS},
                                              {"-seed", 0, LONG_MAX},
                                              {"-workers", 1, SWEEP_WORKERS},
                                              {"-limit", 0, 100000000},
                                              {"-silence", 1, 100000000}};

static long numberOf(const NumberOption *option, const char *text) {
    char *end;
    errno = 0;
    const long value = text ? strtol(text, &end, 10) : -1;
    if (!text || end == text || *end || value < option->least || value > option->most || errno)
        sweep_fail("%s: a whole number has to follow, from %ld to %ld", option->name, option->least, option->most);
    return value;
}

static bool readNumber(Options *o, const char *option, const char *value) {
    long *const to[NUMBERS] = {&o->sample, &o->seed, &o->workers, &o->limit, &o->silence};
    for (int i = 0; i < NUMBERS; i++)
        if (strcmp(option, numbers[i].name) == 0) {
            *to[i] = numberOf(&numbers[i], value);
            return true;
        }
    return false;
}

static void readOption(Options *o, int argc, char **argv, int *i) {
    const char *option = argv[*i], *value = *i + 1 < argc ? argv[*i + 1] : NULL;
    if (strcmp(option, "-again") == 0 || strcmp(option, "-list") == 0) {
        *(option[1] == 'a' ? &o->again : &o->list) = true;
        return;
    }
    ++*i;
    if (readNumber(o, option, value))
        return;
    if (strcmp(option, "-out") == 0 && value && *value)
        o->out = value;
    else if (strcmp(option, "-set") == 0 && value && o->setCount == SETTINGS)
        sweep_fail("-set %s: more than %d of them: one for each parameter will do", value, SETTINGS);
    else if (strcmp(option, "-set") == 0 && value)
        o->set[o->setCount++] = value;
    else
        sweep_fail("%s is no option, or lacks its value\n%s", option, usage);
}

/* What was printed has to arrive. */
static void closeOutput(void) {
    if (fflush(stdout) != 0 || ferror(stdout))
        sweep_fail("the standard output cannot be written: %s", strerror(errno));
}

static Options readOptions(int argc, char **argv) {
    Options o = {.silence = 10};
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], "-help") == 0 || strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            printf("%s", usage);
            closeOutput();
            exit(0);
        } else if (argv[i][0] == '-')
            readOption(&o, argc, argv, &i);
        else if (!o.scene)
            o.scene = argv[i];
        else
            sweep_fail("%s: there is a scene already, %s", argv[i], o.scene);
    if (!o.scene)
        sweep_fail("which scene?\n%s", usage);
    return o;
}

/* ---- the course -------------------------------------------------------------------------------------------------- */

static void list(const SweepPlan *p) {
    for (int i = 0; i < p->scene->parameterCount; i++)
        printf("parameter %s: %.6g to %.6g, %d on the grid\n", p->parameter[i].name, p->parameter[i].least,
               p->parameter[i].largest, p->parameter[i].count);
    for (int i = 0; i < p->scene->resultCount; i++)
        printf("result %s\n", p->scene->result[i]);
    printf("%ld runs\n", p->runs);
    closeOutput();
}

static int workersOf(const Options *o, SweepRanks ranks) {
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    if (o->workers > 0)
        return (int)o->workers;
    return ranks.count > 1 || processors < 1 ? 1 : processors < SWEEP_WORKERS ? (int)processors : SWEEP_WORKERS;
}

static long countBad(const SweepJournal *j) {
    long bad = 0;
    for (long run = 0; run < j->plan->runs; run++)
        bad += strncmp(j->row[run], "ok ", 3) != 0;
    return bad;
}

enum { NAME = PATH_MAX - 16 }; /* of a table: its journal and draft have longer ones */

/* They are looked at before anything is made or run. */
static void nameFiles(const Options *o, const SweepPlan *plan, char out[NAME], char journal[NAME + 16]) {
    const char *name = o->out ? o->out : plan->scene->name, *type = o->out ? "" : ".csv";
    if (snprintf(out, NAME, "%s%s", name, type) >= NAME)
        sweep_fail("-out has a name of more than %d bytes: choose a shorter one", NAME - 1);
    snprintf(journal, NAME + 16, "%s.draft", out); /* sweep_journalWrite makes it */
    sweep_mustBeFile(journal, o->scene);
    snprintf(journal, NAME + 16, "%s.journal", out);
    sweep_mustBeFile(journal, o->scene);
    sweep_mustBeFile(out, o->scene);
}

static int lead(const Options *o, SweepRanks ranks, const SweepPlan *plan) {
    char out[NAME], journalPath[NAME + 16];
    SweepJournal journal;
    nameFiles(o, plan, out, journalPath);
    sweep_journalOpen(&journal, journalPath, plan, o->again);
    const long before = journal.done;
    sweep_ranksLead(ranks, plan, &journal, workersOf(o, ranks), (int)o->limit);
    sweep_journalWrite(&journal, out);
    const long bad = countBad(&journal);
    const bool isWithoutEnd = journal.isWithoutEnd;
    sweep_say("%s: %ld rows, %ld of them new, %ld without results", out, journal.done, journal.done - before, bad);
    sweep_journalClose(&journal);
    if (isWithoutEnd)
        _exit(bad > 0); /* MPI_Finalize would wait for the dead */
    return bad > 0;
}

int main(int argc, char **argv) {
    openStandardFiles();
    signal(SIGCHLD, SIG_DFL); /* whatever it was: ends of processes are to be seen */
    signal(SIGPIPE, SIG_IGN); /* writing fails instead, with a message */
    signal(SIGXFSZ, SIG_IGN);
    SweepRanks ranks = sweep_ranksBegin(&argc, &argv);
    const Options o = readOptions(argc, argv);
    ranks.silence = (int)o.silence;
    const SweepLoaded loaded = sweep_sceneLoad(o.scene);
    SweepPlan plan;
    int code = 0;
    sweep_planInit(&plan, loaded.scene);
    for (int i = 0; i < o.setCount; i++)
        sweep_planSet(&plan, o.set[i]);
    sweep_planFinish(&plan, o.sample, (unsigned long)o.seed, loaded.id);
    if (o.list && ranks.rank == 0)
        list(&plan);
    else if (!o.list && ranks.rank == 0)
        code = lead(&o, ranks, &plan);
    else if (!o.list && !sweep_ranksFollow(&plan, workersOf(&o, ranks), (int)o.limit))
        _exit(0); /* MPI_Finalize would wait for the dead */
    sweep_ranksEnd(ranks);
    return code;
}
