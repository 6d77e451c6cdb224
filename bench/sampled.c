/* What a pair costs in which one shape is a program's, known by its support function alone (McdConvexType.h), beside
 * libccd with the same support functions: nanoseconds per pair, and the errors of its depths and directions against
 * ours, which tests/Mcd/test_Sampled.c compares with a slow search.
 *
 *     sampled [--rounds COUNT] */
#include "timing.h"

#include "model/mcd_result_i.h"
#include "own_shapes.h"
#include "reference.h"

#include <ccd/ccd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PAIRS = 1000 };
enum { TOUCHING, DEEP, APART, POSES };
static const char *const poseName[POSES] = {"touching", "deep", "apart"};
enum { ELLIPSOID, TAPER, BRICK, OWN };
static const char *const ownName[OWN] = {"ellipsoid", "taper", "brick"};
static McdShape a[PAIRS], b[PAIRS];
static McdFrameworkID frame;

static void shapeOf(McdGeometryID g, McdShape *s) {
    memset(s, 0, sizeof *s);
    mcd_shapeSizes(g, s);
    for (int i = 0; i < 3; i++)
        s->axis[i][i] = 1;
}

static void makeOwn(McdShape *s, int kind, Random *r) {
    const double x = random_between(r, .3, 1), y = random_between(r, .3, 1), z = random_between(r, .3, 1);
    shapeOf(kind == ELLIPSOID ? ellipsoid_create(frame, x / 2, y / 2, z / 2)
            : kind == TAPER   ? taper_create(frame, x / 2, y / 2, fabs(x - y) / 2 + z)
                              : brick_create(frame, x, y, z, 0),
            s);
}

static void makePair(McdShape *x, McdShape *y, int kindX, int kindY, int pose, Random *r) {
    double onX[3], onY[3], n[3];
    makeOwn(x, kindX, r);
    if (kindY < OWN)
        makeOwn(y, kindY, r);
    else
        shape_random(y, kindY - OWN, 1, 0, r);
    shape_rotateRandomly(x, r);
    shape_rotateRandomly(y, r);
    random_direction(r, n);
    shape_move(x, 3 * n[0], 3 * n[1], 3 * n[2]);
    const double depth = pose == TOUCHING ? 1e-4 : pose == DEEP ? .2 : -.005;
    const double out = -depth - mcd_convexDistance(x, y, onX, onY, n);
    shape_move(x, out * n[0], out * n[1], out * n[2]);
}

static double timeOurs(int rounds, int *contacts) {
    double best = INFINITY;
    for (int i = 0; i < rounds; i++) {
        const double begin = now();
        *contacts = 0;
        for (int k = 0; k < PAIRS; k++) {
            McdManifold m;
            *contacts += mcd_convexManifold(&a[k], &b[k], (McdReach){.margin = .01}, &m);
        }
        best = fmin(best, (now() - begin) / PAIRS);
    }
    return best;
}

/* ---- libccd ------------------------------------------------------------------------------------------------------ */

static void ccdSupport(const void *shape, const ccd_vec3_t *direction, ccd_vec3_t *out) {
    const double length = sqrt(ccdVec3Dot(direction, direction));
    double n[3] = {direction->v[0] / length, direction->v[1] / length, direction->v[2] / length};
    mcd_support(shape, n, out->v);
}

static void ccdCentre(const void *shape, ccd_vec3_t *out) {
    const McdShape *s = shape;
    mcd_copy(out->v, s->place);
}

typedef int (*Penetration)(const void *x, const void *y, const ccd_t *ccd, ccd_real_t *depth, ccd_vec3_t *direction,
                           ccd_vec3_t *place);

/* Time, and the mean and largest error of the depth where it finds one; how many it does not find. */
static double timeCcd(Penetration find, int rounds, double *mean, double *worst, int *missed) {
    ccd_t ccd;
    double best = INFINITY;
    CCD_INIT(&ccd);
    ccd.support1 = ccd.support2 = ccdSupport;
    ccd.center1 = ccd.center2 = ccdCentre;
    ccd.max_iterations = 1000;
    ccd.epa_tolerance = ccd.mpr_tolerance = 1e-6;
    for (int i = 0; i < rounds; i++) {
        const double begin = now();
        *mean = *worst = 0;
        *missed = 0;
        for (int k = 0; k < PAIRS; k++) {
            ccd_real_t depth = 0;
            ccd_vec3_t direction, place;
            if (find(&a[k], &b[k], &ccd, &depth, &direction, &place) != 0)
                ++*missed;
            else
                *mean += depth;
        }
        best = fmin(best, (now() - begin) / PAIRS);
    }
    *mean = 0;
    for (int k = 0; k < PAIRS; k++) {
        double onA[3], onB[3], n[3];
        ccd_real_t depth = 0;
        ccd_vec3_t direction, place;
        const double ours = -mcd_convexDistance(&a[k], &b[k], onA, onB, n);
        if (find(&a[k], &b[k], &ccd, &depth, &direction, &place) != 0)
            continue;
        const double error = isfinite(depth) ? fabs(depth - ours) : 1;
        *mean += error / PAIRS;
        *worst = fmax(*worst, error);
    }
    return best;
}

int main(int argc, char **argv) {
    const int rounds = argc > 2 && !strcmp(argv[1], "--rounds") ? atoi(argv[2]) : 20;
    static const int kinds[] = {SHAPE_SPHERE, SHAPE_BOX, SHAPE_CYLINDER, SHAPE_HULL, SHAPE_TRIANGLE};
    frame = (McdInit)(0, 4, 4, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    for (int i = 0; i < OWN; i++)
        for (int j = 0; j < 1 + (int)(sizeof kinds / sizeof *kinds); j++) {
            const int other = j == 0 ? i : OWN + kinds[j - 1];
            printf("%-9s %-9s", ownName[i], j == 0 ? ownName[i] : shape_name[kinds[j - 1]]);
            for (int pose = 0; pose < POSES; pose++) {
                Random r = {.state = 1};
                double mean = 0, worst = 0;
                int contacts = 0, missed = 0;
                for (int k = 0; k < PAIRS; k++)
                    makePair(&a[k], &b[k], i, other, pose, &r);
                const double ours = timeOurs(rounds, &contacts);
                printf("  %s: %.0f ns (%.1f)", poseName[pose], 1e9 * ours, (double)contacts / PAIRS);
                if (pose == APART)
                    continue;
                const double epa = timeCcd(ccdGJKPenetration, rounds, &mean, &worst, &missed);
                printf(", ccd EPA %.0f (err %.1e, max %.1e, none %d)", 1e9 * epa, mean, worst, missed);
                const double mpr = timeCcd(ccdMPRPenetration, rounds, &mean, &worst, &missed);
                printf(", MPR %.0f (err %.1e, max %.1e, none %d);", 1e9 * mpr, mean, worst, missed);
            }
            printf("\n");
        }
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    McdTerm(frame);
    return 0;
}
