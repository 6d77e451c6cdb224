/* What all fuzzers do: their options, the stored findings, runs until calls or time are used up, and the report. */
#define _DEFAULT_SOURCE /* mkdir, strdup */
#include "fuzz.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MAX_FINDINGS = 100 };

typedef struct Options {
    uint64_t seed;
    int first; /* number of a run */
    long calls;
    double seconds, shortening;
    int length, max;
    MeBool isLoud;
    const char *save, *corpus;
    char **files;
    int numFiles;
} Options;

typedef struct Findings {
    char why[MAX_FINDINGS][FUZZ_WHY];
    int times[MAX_FINDINGS];
    int count;
} Findings;

static const char help[] =
    "usage: %s [options] [FILE ...]    makes random calls until one breaks something\n"
    "  --seed S        of the first run, a number (1); the same seed makes the same calls\n"
    "  --first N       the run to begin with (0): `--seed S --first N --calls 1` repeats a run that is named so\n"
    "  --calls N       ends after the run in which there have been so many (100000)\n"
    "  --seconds T     or after so long\n"
    "  --length N      calls of a run (%d)\n"
    "  --most N        ends when so many different faults were found (10)\n"
    "  --shorten T     leaves out calls of a finding for at most so many seconds (30)\n"
    "  --corpus DIR    makes the stored calls in DIR/*.txt first\n"
    "  --save DIR      stores what is found there\n"
    "  --loud          shows the calls and what the library says\n"
    "  FILE ...        makes the calls in these files, and no others\n"
    "Exit status: 0 nothing was found, 1 something was, 2 it could not run.\n";

static MeBool readOption(Options *o, const char *name, const char *value) {
    char *end = "x";
    if (strcmp(name, "--seed") == 0)
        o->seed = strtoull(value, &end, 0);
    else if (strcmp(name, "--first") == 0)
        o->first = (int)strtol(value, &end, 0);
    else if (strcmp(name, "--calls") == 0)
        o->calls = strtol(value, &end, 0);
    else if (strcmp(name, "--seconds") == 0)
        o->seconds = strtod(value, &end);
    else if (strcmp(name, "--shorten") == 0)
        o->shortening = strtod(value, &end);
    else if (strcmp(name, "--length") == 0)
        o->length = (int)strtol(value, &end, 0);
    else if (strcmp(name, "--most") == 0)
        o->max = (int)strtol(value, &end, 0);
    else if (strcmp(name, "--save") == 0)
        o->save = value, end = "";
    else if (strcmp(name, "--corpus") == 0)
        o->corpus = value, end = "";
    return *end == 0;
}

static MeBool readOptions(Options *o, int argc, char **argv) {
    int i = 1;
    for (; i < argc && argv[i][0] == '-'; i++) {
        if (strcmp(argv[i], "--loud") == 0)
            o->isLoud = METRUE;
        else if (i + 1 >= argc || !readOption(o, argv[i], argv[i + 1]))
            return MEFALSE;
        else
            i++;
    }
    o->files = argv + i;
    o->numFiles = argc - i;
    return o->length > 0 && o->max > 0;
}

/* ---- lines ---- */

static char **split(char *text, int *count) {
    char **lines = NULL;
    *count = 0;
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        if (line[0] == '#' || line[0] == '(')
            continue;
        lines = realloc(lines, (size_t)(*count + 1) * sizeof *lines);
        if (!lines)
            exit(2);
        lines[(*count)++] = line;
    }
    return lines;
}

static char *readText(const char *path) {
    FILE *file = fopen(path, "rb");
    char *text = calloc(1, FUZZ_BYTES);
    if (file && text)
        text[fread(text, 1, FUZZ_BYTES - 1, file)] = 0;
    if (file)
        fclose(file);
    return file ? text : (free(text), NULL);
}

/* ---- findings ---- */

static MeBool note(Findings *f, const char *why) {
    for (int i = 0; i < f->count; i++)
        if (strcmp(f->why[i], why) == 0)
            return f->times[i]++, MEFALSE;
    if (f->count == MAX_FINDINGS)
        return MEFALSE;
    strcpy(f->why[f->count], why);
    f->times[f->count++] = 1;
    return METRUE;
}

static void save(const Options *o, const FuzzTarget *target, char **lines, int count, const char *why, int number) {
    char path[1024];
    if (mkdir(o->save, 0777) != 0 && errno != EEXIST)
        perror(o->save);
    snprintf(path, sizeof path, "%s/%s-%llu-%d.txt", o->save, target->name, (unsigned long long)o->seed, number);
    FILE *file = fopen(path, "w");
    if (!file) {
        perror(path);
        return;
    }
    fprintf(file, "# %s\n", why);
    for (int i = 0; i < count; i++)
        fprintf(file, "%s\n", lines[i]);
    fclose(file);
    printf("stored in %s\n", path);
}

static void tell(const Options *o, const FuzzTarget *target, const FuzzOutcome *found, int number) {
    int count;
    char *text = strdup(found->text);
    char **lines = split(text, &count);
    const FuzzOrder all = {.lines = lines, .count = count};
    const FuzzOutcome again = fuzzRun(target, &all);
    printf("%s: FOUND %s\nrun %d of seed %llu, after %d calls", target->name, found->why, number,
           (unsigned long long)o->seed, found->calls);
    fflush(stdout);
    if (strcmp(again.why, found->why) == 0) {
        count = fuzzShorten(target, lines, count, found->why, o->shortening);
        printf("; these do:\n");
    } else {
        printf("; made again they %s%s:\n", again.isFound ? "end otherwise, " : "pass", again.why);
    }
    for (int i = 0; i < count; i++)
        printf("    %s\n", lines[i]);
    if (o->save)
        save(o, target, lines, count, found->why, number);
    fflush(stdout);
    free(lines);
    free(text);
}

/* ---- what is run ---- */

static MeBool runFile(const Options *o, const FuzzTarget *target, const char *path) {
    char *text = readText(path);
    if (!text) {
        perror(path);
        exit(2);
    }
    int count;
    char **lines = split(text, &count);
    const FuzzOrder order = {.lines = lines, .count = count, .isLoud = o->isLoud};
    const FuzzOutcome outcome = fuzzRun(target, &order);
    if (outcome.isFound)
        printf("%s: FOUND %s\nby the %d calls in %s\n", target->name, outcome.why, count, path);
    free(lines);
    free(text);
    return outcome.isFound;
}

static int byName(const struct dirent **a, const struct dirent **b) {
    return strcmp((*a)->d_name, (*b)->d_name);
}

static int isText(const struct dirent *entry) {
    const char *dot = strrchr(entry->d_name, '.');
    return dot && strcmp(dot, ".txt") == 0;
}

static int runCorpus(const Options *o, const FuzzTarget *target) {
    struct dirent **entries;
    const int count = scandir(o->corpus, &entries, isText, byName);
    int found = 0;
    if (count < 0) {
        perror(o->corpus);
        exit(2);
    }
    for (int i = 0; i < count; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", o->corpus, entries[i]->d_name);
        found += runFile(o, target, path);
        free(entries[i]);
    }
    free(entries);
    printf("%s: %d stored runs, %d of which fail\n", target->name, count, found);
    return found;
}

static int runSeed(const Options *o, const FuzzTarget *target) {
    static Findings findings;
    const double start = fuzzClock();
    long calls = 0;
    int number = o->first;
    for (; calls < o->calls && findings.count < o->max; number++) {
        if (o->seconds > 0 && fuzzClock() - start > o->seconds)
            break;
        FuzzRandom mix = {o->seed, 0, 0}; /* runs of one seed have nothing in common with those of the next */
        const uint64_t seed = fuzzBits(&mix) + (uint64_t)number;
        const FuzzOrder order = {.seed = seed, .run = number, .count = o->length, .isLoud = o->isLoud};
        const FuzzOutcome outcome = fuzzRun(target, &order);
        calls += outcome.calls;
        if (outcome.isFound && note(&findings, outcome.why))
            tell(o, target, &outcome, number);
    }
    for (int i = 0; i < findings.count; i++)
        printf("%s: %d times %s\n", target->name, findings.times[i], findings.why[i]);
    printf("%s: seed %llu, %ld calls in %d runs, %.0f s, %d different faults\n", target->name,
           (unsigned long long)o->seed, calls, number - o->first, fuzzClock() - start, findings.count);
    return findings.count;
}

int fuzzMain(int argc, char **argv, const FuzzTarget *target) {
    Options o = {1, 0, 100000, 0, 30, target->length, 10, MEFALSE, NULL, NULL, NULL, 0};
    if (!readOptions(&o, argc, argv)) {
        fprintf(stderr, help, argv[0], target->length);
        return 2;
    }
    int found = 0;
    if (o.corpus)
        found += runCorpus(&o, target);
    for (int i = 0; i < o.numFiles; i++)
        found += runFile(&o, target, o.files[i]);
    if (o.numFiles == 0)
        found += runSeed(&o, target);
    return found > 0;
}

#if defined __clang__ || defined __SANITIZE_ADDRESS__
/* Of AddressSanitizer: memory that there is not is null; leaks are not looked for, as runs end in their middle. */
const char *__asan_default_options(void);
__attribute__((visibility("default"), used)) const char *__asan_default_options(void) {
    return "allocator_may_return_null=1:detect_leaks=0:handle_abort=1";
}
#endif
