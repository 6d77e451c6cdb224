/* How much of their tolerances the comparisons use. With KARMA_TEST_MARGINS=file each place that compares appends a
 * line at the end of its program: file:line, precision, comparisons, the largest share of the tolerance that was used,
 * the share that 4 units in the last place would be, and the tolerance where the largest share was used. */
#include <float.h>

#include "karma_test.h"

#ifdef _ME_API_DOUBLE
static const double unit = DBL_EPSILON;
#else
static const double unit = FLT_EPSILON;
#endif

enum { PLACES = 4096 };

typedef struct {
    const char *file;
    int line;
    long count;
    double used, floor, tolerance;
} Place;

static Place places[PLACES];
static const char *path;

static void append(void) {
    FILE *const out = fopen(path, "a");
    if (!out)
        return;
    for (const Place *p = places; p < places + PLACES; p++)
        if (p->file)
            fprintf(out, "%s:%d %s %ld %.3g %.3g %.3g\n", p->file, p->line, TOL("single", "double"), p->count, p->used,
                    p->floor, p->tolerance);
    fclose(out);
}

static int isWanted(void) {
    static int isKnown;
    if (!isKnown) {
        isKnown = 1;
        path = getenv("KARMA_TEST_MARGINS");
        if (path)
            atexit(append);
    }
    return path != NULL;
}

static Place *placeOf(const char *file, int line) {
    for (size_t i = (size_t)line; i < (size_t)line + PLACES; i++) {
        Place *p = &places[i % PLACES];
        if (!p->file) {
            p->file = file;
            p->line = line;
        }
        if (p->line == line && !strcmp(p->file, file))
            return p;
    }
    return NULL;
}

void margin_note(const char *file, int line, double actual, double expected, double tolerance) {
    if (!isWanted() || !(tolerance > 0) || !isfinite(tolerance) || !isfinite(actual) || !isfinite(expected))
        return;
    Place *const p = placeOf(file, line);
    if (!p)
        return;
    const double used = fabs(actual - expected) / tolerance;
    const double size = fmax(fabs(actual), expected == 0 ? 1 : fabs(expected)); /* what cancels to 0 is of about 1 */
    if (!p->count++ || used > p->used) {
        p->used = used;
        p->tolerance = tolerance;
    }
    p->floor = fmax(p->floor, 4 * unit * size / tolerance);
}
