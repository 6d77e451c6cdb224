/* The clock of the programs here, and the median of what it measured. Include first: it chooses what the C library
 * shows. */
#ifndef BENCH_TIMING_H
#define BENCH_TIMING_H

#define _POSIX_C_SOURCE 199309L /* clock_gettime */
#include <stdlib.h>
#include <time.h>

/* s */
static inline double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* s, that all threads of the process have had. */
static inline double cpuTime(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline int timing_compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sorts them; what stands at three quarters of them, say, is times[3 * n / 4] then. */
static inline double median(double times[], int n) {
    qsort(times, (size_t)n, sizeof *times, timing_compare);
    return times[n / 2];
}

#endif
