/* Random numbers, and the values that break things. */
#include "fuzz.h"

#include <float.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "MeMath.h"

/* splitmix64 */
uint64_t fuzzBits(FuzzRandom *random) {
    uint64_t z = random->state += 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
}

int fuzzBelow(FuzzRandom *random, int count) {
    return (int)((fuzzBits(random) >> 32) % (uint64_t)count);
}

MeBool fuzzChance(FuzzRandom *random, int percent) {
    return fuzzBelow(random, 100) < percent;
}

MeBool fuzzIsNasty(FuzzRandom *random) {
    return fuzzChance(random, random->nasty);
}

double fuzzUniform(FuzzRandom *random, double lower, double upper) {
    return lower + (upper - lower) * (double)(fuzzBits(random) >> 11) * 0x1p-53;
}

static double saneReal(FuzzRandom *random) {
    const double sign = fuzzChance(random, 30) ? -1 : 1;
    switch (fuzzBelow(random, 6)) {
    case 0:
        return 0;
    case 1:
        return sign;
    case 2:
        return sign * fuzzBelow(random, 10);
    case 3:
        return sign * pow(10, fuzzUniform(random, -3, 3));
    default:
        return sign * fuzzUniform(random, 0, 2);
    }
}

static double nastyReal(FuzzRandom *random) {
    static const double values[] = {0,       -0.0,        1,           -1,      (double)ME_EPSILON,
                                    FLT_MIN, FLT_MIN / 8, -FLT_MIN,    1e-20,   1e-30,
                                    1e-10,   1e5,         16777216,    1e10,    1e20,
                                    1e30,    FLT_MAX,     3e38,        1e300,   (double)MEINFINITY,
                                    NAN,     INFINITY,    2147483648., DBL_MIN, 4e-324};
    const double sign = fuzzChance(random, 25) ? -1 : 1;
    return sign * values[fuzzBelow(random, sizeof values / sizeof values[0])];
}

double fuzzReal(FuzzRandom *random) {
    return (double)(MeReal)(fuzzIsNasty(random) ? nastyReal(random) : saneReal(random));
}

long fuzzInteger(FuzzRandom *random) {
    static const int values[] = {0,  1,  -1,  2,   INT_MAX, INT_MIN, -2,    31,    32,     63,     64,
                                 65, 99, 100, 127, 128,     255,     32767, 32768, 100000, 1 << 20};
    if (fuzzIsNasty(random))
        return values[fuzzBelow(random, sizeof values / sizeof values[0])];
    return fuzzChance(random, 70) ? fuzzBelow(random, 4) : fuzzBelow(random, 20);
}

static void rigid(FuzzRandom *random, MeReal *tm) {
    MeVector4 q;
    double length = 0;
    for (int i = 0; i < 4; i++) {
        const double x = fuzzUniform(random, -1, 1);
        q[i] = (MeReal)x;
        length += x * x;
    }
    if (length < 1e-3 || fuzzChance(random, 30)) /* unturned, as most things in worlds are */
        q[0] = 1, q[1] = q[2] = q[3] = 0, length = 1;
    for (int i = 0; i < 4; i++)
        q[i] /= (MeReal)sqrt(length);
    MeMatrix4 m;
    MeMatrix4TMMakeIdentity(m);
    MeQuaternionToTM(m, q);
    for (int i = 0; i < 3; i++)
        m[3][i] = (MeReal)(fuzzChance(random, 20) ? 0 : fuzzUniform(random, -2, 2));
    memcpy(tm, m, sizeof m);
}

/* What is no rigid transform, or a rigid one far away. */
static void spoil(FuzzRandom *random, MeReal *tm) {
    const int i = fuzzBelow(random, 16);
    switch (fuzzBelow(random, 7)) {
    case 0:
        tm[i] = (MeReal)nastyReal(random);
        return;
    case 1: /* a scale, maybe 0, or mirrored */
        for (int k = 0; k < 12; k++)
            tm[k] *= (MeReal)(k % 4 < 3 ? nastyReal(random) : 1);
        return;
    case 2: /* a shear, or no matrix at all */
        for (int k = 0; k < 12; k++)
            tm[k] = (MeReal)saneReal(random);
        return;
    case 3:
        for (int k = 0; k < 16; k++)
            tm[k] = (MeReal)nastyReal(random);
        return;
    case 4:
        memset(tm, 0, 16 * sizeof tm[0]);
        return;
    default: /* far away */
        tm[12 + i % 3] = (MeReal)nastyReal(random);
    }
}

void fuzzMatrix(FuzzRandom *random, MeReal *tm) {
    rigid(random, tm);
    if (fuzzIsNasty(random))
        spoil(random, tm);
}

void fuzzWrite(FuzzLine *line, const char *format, ...) {
    va_list ap;
    va_start(ap, format);
    const int more = vsnprintf(line->text + line->used, line->size - line->used, format, ap);
    va_end(ap);
    if (more > 0 && (line->used += (size_t)more) >= line->size)
        line->used = line->size - 1;
}

void fuzzWriteReal(FuzzLine *line, double x) {
    char digits[40];
    for (int count = 6; count <= 17; count += count == 6 ? 3 : 8) {
        snprintf(digits, sizeof digits, "%.*g", count, x);
        if (isnan(x) || (double)(MeReal)strtod(digits, NULL) == x)
            break;
    }
    fuzzWrite(line, "%s", digits);
}
