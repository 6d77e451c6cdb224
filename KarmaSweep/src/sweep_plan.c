/* Which values the parameters have in run i: any run can be made by itself, in whatever process. */
#include "sweep_i.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

void sweep_planInit(SweepPlan *p, const SweepScene *scene) {
    *p = (SweepPlan){.scene = scene};
    for (int i = 0; i < scene->parameterCount; i++)
        p->parameter[i] = scene->parameter[i];
}

/* ---- -set -------------------------------------------------------------------------------------------------------- */

/* "angle" names "angle [rad]". */
static bool isNamed(const char *name, const char *text, size_t length) {
    return strncmp(name, text, length) == 0 && (name[length] == 0 || strncmp(name + length, " [", 2) == 0);
}

static SweepParameter *find(SweepPlan *p, const char *text, size_t length) {
    for (int i = 0; i < p->scene->parameterCount; i++)
        if (isNamed(p->parameter[i].name, text, length))
            return &p->parameter[i];
    sweep_fail("-set %s: the scene has no parameter of that name; -list tells them", text);
}

/* "5", "5:6" or "5:6:7"; returns how many of the three there are, 0: something else. */
static int readPlaces(const char *text, double end[2], long *count) {
    char *rest = (char *)text;
    for (int i = 0; i < 2; i++) {
        const char *from = rest;
        end[i] = strtod(from, &rest);
        if (rest == from)
            return 0;
        if (*rest != ':')
            return *rest ? 0 : i + 1;
        rest++;
    }
    const char *from = rest;
    *count = strtol(from, &rest, 10);
    return rest == from || *rest ? 0 : 3;
}

void sweep_planSet(SweepPlan *p, const char *text) {
    const char *value = strchr(text, '='), *form = "name=value, name=least:largest or name=least:largest:count";
    double end[2];
    long count = 1;
    if (!value)
        sweep_fail("-set %s: write %s", text, form);
    SweepParameter *parameter = find(p, text, (size_t)(value - text));
    const int found = readPlaces(value + 1, end, &count);
    if (found == 0)
        sweep_fail("-set %s: write %s", text, form);
    end[1] = found > 1 ? end[1] : end[0];
    if (!(end[1] >= end[0]) || !isfinite(end[1] - end[0]) || count < 1 || count > SWEEP_RUNS)
        sweep_fail("-set %s: write %s, with finite numbers, least <= largest, and a count from 1 to %d", text, form,
                   SWEEP_RUNS);
    parameter->least = end[0];
    parameter->largest = end[1];
    parameter->count = found > 2 ? (int)count : found > 1 ? parameter->count : 1;
}

/* ---- the number of runs, and what they are ----------------------------------------------------------------------- */

static long sizeOfGrid(const SweepPlan *p) {
    double size = 1;
    for (int i = 0; i < p->scene->parameterCount; i++)
        size *= p->parameter[i].count;
    if (size > SWEEP_RUNS)
        sweep_fail("a grid of %.3g runs is too large: set fewer places, or take a sample (-sample)", size);
    return (long)size;
}

static uint64_t hashOfNumber(uint64_t hash, double x) {
    char text[40];
    sweep_number(text, sizeof text, x);
    return sweep_hash(hash, text, strlen(text) + 1);
}

static uint64_t idOf(const SweepPlan *p, uint64_t sceneId) {
    uint64_t hash = sweep_hash(SWEEP_HASH, &sceneId, sizeof sceneId);
    for (int i = 0; i < p->scene->parameterCount; i++) {
        hash = hashOfNumber(hashOfNumber(hash, p->parameter[i].least), p->parameter[i].largest);
        hash = hashOfNumber(hash, p->parameter[i].count);
    }
    return hashOfNumber(hashOfNumber(hashOfNumber(hash, p->isSample), (double)p->runs), (double)p->seed);
}

void sweep_planFinish(SweepPlan *p, long sample, unsigned long seed, uint64_t sceneId) {
    p->isSample = sample > 0;
    p->seed = seed;
    p->runs = p->isSample ? sample : sizeOfGrid(p);
    p->id = idOf(p, sceneId);
}

/* ---- values ------------------------------------------------------------------------------------------------------ */

/* The last parameter changes fastest. */
static void gridValues(const SweepPlan *p, long run, double *value) {
    for (int i = p->scene->parameterCount - 1; i >= 0; i--) {
        const SweepParameter *a = &p->parameter[i];
        const long place = run % a->count;
        run /= a->count;
        value[i] = place == a->count - 1 && place > 0
                       ? a->largest
                       : a->least + (a->count > 1 ? (a->largest - a->least) * (double)place / (a->count - 1) : 0);
    }
}

/* The digits of n in a base, mirrored at the point. */
static double radicalInverse(unsigned long n, unsigned int base) {
    double value = 0, digit = 1. / base;
    for (; n > 0; n /= base, digit /= base)
        value += (double)(n % base) * digit;
    return value;
}

/* splitmix64 (Steele, Lea, Flood 2014): 53 bits of it as 0..1. */
static double randomOf(uint64_t seed, uint64_t index) {
    uint64_t z = seed * 0x2545f4914f6cdd1du + (index + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.;
}

/* Halton's points (1960), shifted at random by the seed (Cranley, Patterson 1976): they fill the space evenly, and the
 * first n of a larger sample are the smaller one. */
static void sampleValues(const SweepPlan *p, long run, double *value) {
    static const unsigned int prime[SWEEP_PARAMETERS] = {2,  3,  5,  7,   11,  13,  17,  19,  23,  29, 31,
                                                         37, 41, 43, 47,  53,  59,  61,  67,  71,  73, 79,
                                                         83, 89, 97, 101, 103, 107, 109, 113, 127, 131};
    for (int i = 0; i < p->scene->parameterCount; i++) {
        const SweepParameter *a = &p->parameter[i];
        const double at = radicalInverse((unsigned long)run + 1, prime[i]) + randomOf(p->seed, (uint64_t)i);
        value[i] = a->least + (a->largest - a->least) * (at - floor(at));
    }
}

void sweep_planValues(const SweepPlan *p, long run, double *value) {
    if (p->isSample)
        sampleValues(p, run, value);
    else
        gridValues(p, run, value);
}
