/* A small generator, so that a failure can be repeated from the seed that it printed. */
#ifndef RANDOM_NUMBERS_H
#define RANDOM_NUMBERS_H

static unsigned long long state = 1;

static inline double uniform(double low, double high) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return low + (high - low) * (double)(state >> 11) / 9007199254740992.0;
}

static inline int below(int n) {
    return (int)uniform(0, n);
}

#endif
