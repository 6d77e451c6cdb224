/* Fuzzers: programs that make random calls until one ends in an assertion, a crash, a hang or a NaN.
 *
 * A run is a sequence of calls, each a line of text, made in a process of its own (fuzz_run.c): so what breaks ends the
 * run only, can be repeated, and can be shortened by leaving lines out. What a fuzzer calls is its FuzzTarget.
 *
 * A seed and the number of a run give the same lines in every build of a precision; nothing depends on addresses or
 * time.
 */
#ifndef FUZZ_H
#define FUZZ_H

#include <stddef.h>
#include <stdint.h>

#include "MePrecision.h"

/* ---- random numbers and values ---- */

typedef struct FuzzRandom {
    uint64_t state;
    int nasty; /* how many of 100 values are such as no sane program passes; of a run */
    int run;   /* its number */
} FuzzRandom;

uint64_t fuzzBits(FuzzRandom *random);
int fuzzBelow(FuzzRandom *random, int count); /* 0 .. count - 1 */
MeBool fuzzChance(FuzzRandom *random, int percent);
MeBool fuzzIsNasty(FuzzRandom *random);                             /* as often as the run is nasty */
double fuzzUniform(FuzzRandom *random, double lower, double upper); /* a sane number */
double fuzzReal(FuzzRandom *random);                                /* any number, NaN and infinities too */
long fuzzInteger(FuzzRandom *random);                               /* any int */
void fuzzMatrix(FuzzRandom *random, MeReal *tm);                    /* a transform, mostly a rigid one */

/* ---- lines ---- */

typedef struct FuzzLine {
    char *text;
    size_t size, used;
} FuzzLine;

/* Appends; what does not fit is cut. */
void fuzzWrite(FuzzLine *line, const char *format, ...) __attribute__((__format__(__printf__, 2, 3)));
/* A number in the fewest digits that read back as the same MeReal. */
void fuzzWriteReal(FuzzLine *line, double x);

/* ---- what a fuzzer is ---- */

typedef struct FuzzTarget {
    const char *name;
    int length;      /* calls of a run */
    double patience; /* s on the processor that one call may take */
    void (*begin)(void);
    /* The next line of a run. */
    void (*generate)(FuzzRandom *random, int index, FuzzLine *line);
    /* Makes the call that a line says, which may be one of a stored run, and be changed. Unknown ones do nothing. */
    void (*execute)(char *line);
    void (*end)(void);
} FuzzTarget;

/* The process ends here: what has been found. In a run only. */
void fuzzFail(const char *format, ...) __attribute__((__format__(__printf__, 1, 2), noreturn));
/* Shown beside the calls by --loud, not stored: a line that was made by a callback. */
void fuzzNote(const char *line);
/* MeFatalError of an assertion is a finding; warnings, and fatal errors of memory, are not. Memory is scarce: large
 * blocks are refused. Called as a run begins. */
void fuzzCatchMessages(void);
/* main(): `--help` tells the options. */
int fuzzMain(int argc, char **argv, const FuzzTarget *target);

/* ---- between fuzz.c and fuzz_run.c ---- */

enum {
    FUZZ_BYTES = 1 << 20, /* bytes of the lines of a run */
    FUZZ_WHY = 400
};

/* What a run is to do: lines, or new ones of a seed. */
typedef struct FuzzOrder {
    char *const *lines; /* null: generate */
    uint64_t seed;
    int run, count;
    MeBool isLoud; /* messages are shown */
} FuzzOrder;

typedef struct FuzzOutcome {
    MeBool isFound;
    char why[FUZZ_WHY]; /* the same for the same fault */
    const char *text;   /* the lines that were made, up to the next run */
    int calls;
} FuzzOutcome;

FuzzOutcome fuzzRun(const FuzzTarget *target, const FuzzOrder *order);
/* Leaves out lines while the same is found; returns how many are left, at the beginning of lines[]. */
int fuzzShorten(const FuzzTarget *target, char **lines, int count, const char *why, double seconds);
double fuzzClock(void); /* s */

#endif
