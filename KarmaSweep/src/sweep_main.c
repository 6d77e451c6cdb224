/* karma-sweep: runs a scene over a grid or a sample of its parameters, on all processors of this machine or of several,
 * into one CSV file, whose bytes do not depend on how many those are. docs/sweep.md */
#define _DEFAULT_SOURCE
#include "sweep_i.h"
#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
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
    "A sweep that was stopped goes on where it was when it is started again with the same options.\n";

typedef struct Options {
    const char *scene, *out;
    const char *set[SWEEP_PARAMETERS];
    int setCount;
    long sample, workers, limit, silence;
    unsigned long seed;
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

/* ---- options ----------------------------------------------------------------------------------------------------- */

static long countOf(const char *option, const char *text) {
    char *end;
    errno = 0;
    const long value = text ? strtol(text, &end, 10) : -1;
    if (!text || end == text || *end || value < 0 || errno)
        sweep_fail("%s: a whole number has to follow", option);
    return value;
}

static void readOption(Options *o, int argc, char **argv, int *i) {
    const char *option = argv[*i], *value = *i + 1 < argc ? argv[*i + 1] : NULL;
    if (strcmp(option, "-again") == 0 || strcmp(option, "-list") == 0) {
        *(option[1] == 'a' ? &o->again : &o->list) = true;
        return;
    }
    if (strcmp(option, "-sample") == 0)
        o->sample = countOf(option, value);
    else if (strcmp(option, "-seed") == 0)
        o->seed = (unsigned long)countOf(option, value);
    else if (strcmp(option, "-workers") == 0)
        o->workers = countOf(option, value);
    else if (strcmp(option, "-limit") == 0)
        o->limit = countOf(option, value);
    else if (strcmp(option, "-silence") == 0)
        o->silence = countOf(option, value);
    else if (strcmp(option, "-out") == 0 && value)
        o->out = value;
    else if (strcmp(option, "-set") == 0 && value && o->setCount < SWEEP_PARAMETERS)
        o->set[o->setCount++] = value;
    else
        sweep_fail("%s is no option, or lacks its value\n%s", option, usage);
    ++*i;
}

static Options readOptions(int argc, char **argv) {
    Options o = {.silence = 10};
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], "-help") == 0 || strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            printf("%s", usage);
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
}

static int workersOf(const Options *o, SweepRanks ranks) {
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    if (o->workers > 0)
        return o->workers < 256 ? (int)o->workers : 256;
    return ranks.count > 1 || processors < 1 ? 1 : (int)processors;
}

static long countBad(const SweepJournal *j) {
    long bad = 0;
    for (long run = 0; run < j->plan->runs; run++)
        bad += strncmp(j->row[run], "ok ", 3) != 0;
    return bad;
}

static int lead(const Options *o, SweepRanks ranks, const SweepPlan *plan) {
    char out[4000], journalPath[4096];
    SweepJournal journal;
    snprintf(out, sizeof out, "%s%s", o->out ? o->out : plan->scene->name, o->out ? "" : ".csv");
    snprintf(journalPath, sizeof journalPath, "%s.journal", out);
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
    SweepRanks ranks = sweep_ranksBegin(&argc, &argv);
    const Options o = readOptions(argc, argv);
    ranks.silence = (int)o.silence;
    const SweepLoaded loaded = sweep_sceneLoad(o.scene);
    SweepPlan plan;
    int code = 0;
    sweep_planInit(&plan, loaded.scene);
    for (int i = 0; i < o.setCount; i++)
        sweep_planSet(&plan, o.set[i]);
    sweep_planFinish(&plan, o.sample, o.seed, loaded.id);
    if (o.list && ranks.rank == 0)
        list(&plan);
    else if (!o.list && ranks.rank == 0)
        code = lead(&o, ranks, &plan);
    else if (!o.list && !sweep_ranksFollow(&plan, workersOf(&o, ranks), (int)o.limit))
        _exit(0); /* MPI_Finalize would wait for the dead */
    sweep_ranksEnd(ranks);
    return code;
}
