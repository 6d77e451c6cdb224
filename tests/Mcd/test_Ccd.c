/* An independent oracle: libccd, which this library does not use, must agree about what overlaps, and never know a
 * shorter way out. How often its depths are wrong where things rest on each other is counted and shown. */
#include "karma_test.h"
#include "convex/mcd_vector_i.h"
#include "reference.h"

#include <ccd/ccd.h>

enum { POSES = 200, RESTING = 1000 };
static const int kind[] = {SHAPE_BOX, SHAPE_SPHERE, SHAPE_CYLINDER, SHAPE_SPHYL, SHAPE_CONE, SHAPE_HULL};
enum { KINDS = sizeof kind / sizeof *kind };

static double sizeOf(const McdShape *a, const McdShape *b) {
    return fmin(a->extent, b->extent);
}

/* ---- our shapes for libccd, by the reference's formulas --------------------------------------------------------- */

static void ccdSupport(const void *shape, const ccd_vec3_t *direction, ccd_vec3_t *out) {
    const double length = mcd_length(direction->v);
    double n[3];
    mcd_scale(n, direction->v, 1 / length);
    reference_support(shape, n, out->v);
}

/* A point within: cones and hulls have their origin there too. */
static void ccdCentre(const void *shape, ccd_vec3_t *out) {
    mcd_copy(out->v, ((const McdShape *)shape)->place);
}

static ccd_t makeCcd(double tolerance) {
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = ccd.support2 = ccdSupport;
    ccd.center1 = ccd.center2 = ccdCentre;
    ccd.max_iterations = 1000;
    ccd.epa_tolerance = ccd.mpr_tolerance = tolerance;
    return ccd;
}

/* ---- any way ----------------------------------------------------------------------------------------------------- */

/* From a tenth of the smaller one within each other to as much apart, or anywhere deep within. */
static void placeAnyWay(McdShape *a, McdShape *b, Random *r) {
    double n[3];
    shape_rotateRandomly(a, r);
    shape_rotateRandomly(b, r);
    random_direction(r, n);
    const double size = sizeOf(a, b);
    const double in = random_unit(r) < .5 ? random_between(r, -.1, .1) : random_between(r, 0, 1);
    const double k = -reference_along(a, b, n) - in * size;
    shape_move(a, k * n[0], k * n[1], k * n[2]);
}

typedef struct Answers {
    int overlapping, apart;
    int longer; /* libccd's way out is longer by more than 1 % */
} Answers;

static void askBoth(int kindA, int kindB, Random *r, Answers *answers) {
    McdShape a, b;
    double onA[3], onB[3], n[3];
    ccd_real_t depth = 0;
    ccd_vec3_t direction, position;
    shape_random(&a, kindA, 1, 0, r);
    shape_random(&b, kindB, 1, 0, r);
    placeAnyWay(&a, &b, r);
    const double size = sizeOf(&a, &b), ours = mcd_convexDistance(&a, &b, onA, onB, n);
    const ccd_t ccd = makeCcd(1e-9 * size);
    if (fabs(ours) < 1e-6 * size)
        return;
    ck_assert_msg(ccdGJKIntersect(&a, &b, &ccd) == (ours < 0), "%s, %s: a distance of %g is not libccd's answer",
                  shape_name[kindA], shape_name[kindB], ours);
    if (ours > 0) {
        answers->apart++;
        return;
    }
    answers->overlapping++;
    ck_assert_int_eq(ccdMPRPenetration(&a, &b, &ccd, &depth, &direction, &position), 0);
    ck_assert_msg(depth >= -ours - 1e-7 * size, "%s, %s: a depth of %.9g, but libccd's way out is %.9g",
                  shape_name[kindA], shape_name[kindB], -ours, depth);
    answers->longer += !(depth <= -1.01 * ours);
}

TEST(libccd_agrees_and_knows_no_shorter_way_out) {
    int overlapping = 0, longer = 0;
    for (int i = 0; i < KINDS; i++)
        for (int j = i; j < KINDS; j++) {
            Random r = {.state = (unsigned long long)(500 + 10 * i + j)};
            Answers answers = {0, 0, 0};
            for (int k = 0; k < POSES; k++)
                askBoth(kind[k & 1 ? i : j], kind[k & 1 ? j : i], &r, &answers);
            ck_assert_int_gt(answers.overlapping, POSES / 3);
            ck_assert_int_gt(answers.apart, POSES / 10);
            overlapping += answers.overlapping;
            longer += answers.longer;
        }
    printf("any way: libccd's depth is more than 1 %% too large: MPR %.1f %%\n", 100. * longer / overlapping);
}

/* ---- resting ----------------------------------------------------------------------------------------------------- */

/* a on b's top, up to a twentieth in it, tilted by up to a milliradian, and both turned alike. */
static void placeResting(McdShape *a, McdShape *b, Random *r) {
    const double up[3] = {0, 0, 1};
    double axis[3];
    random_direction(r, axis);
    shape_rotate(a, axis, random_between(r, 0, 1e-3));
    shape_move(a, random_between(r, -.3, .3), random_between(r, -.3, .3), 0);
    shape_move(a, 0, 0, -reference_along(a, b, up) - random_between(r, .005, .05) * sizeOf(a, b));
    const Random same = *r;
    shape_rotateRandomly(a, r);
    *r = same;
    shape_rotateRandomly(b, r);
}

static MeBool isOff(int failed, double depth, double expected) {
    return failed || !(fabs(depth - expected) <= .01 * expected);
}

/* Ours are right by the reference, so what differs is libccd's error. */
static void countWrong(int kindA, int kindB) {
    Random r = {.state = 77};
    int byEpa = 0, byMpr = 0;
    for (int i = 0; i < RESTING; i++) {
        McdShape a, b;
        double onA[3], onB[3], n[3];
        ccd_real_t epa = 0, mpr = 0;
        ccd_vec3_t direction, position;
        shape_random(&a, kindA, 1, 0, &r);
        shape_random(&b, kindB, 1, 0, &r);
        placeResting(&a, &b, &r);
        const double ours = -mcd_convexDistance(&a, &b, onA, onB, n);
        if (kindA == SHAPE_BOX && kindB == SHAPE_BOX)
            assert_near(ours, -reference_axes(&a, &b, n), 1e-6 * sizeOf(&a, &b));
        else
            assert_near(ours, -reference_distance(&a, &b, 10, n), 1e-6 * sizeOf(&a, &b));
        const ccd_t ccd = makeCcd(1e-6);
        const int noEpa = ccdGJKPenetration(&a, &b, &ccd, &epa, &direction, &position);
        const int noMpr = ccdMPRPenetration(&a, &b, &ccd, &mpr, &direction, &position);
        byEpa += isOff(noEpa, epa, ours);
        byMpr += isOff(noMpr, mpr, ours);
    }
    printf("%s on %s, tilted by up to 1 mrad: libccd's depth is off by more than 1 %%, or none: EPA %.1f %%, MPR %.1f "
           "%%\n",
           shape_name[kindA], shape_name[kindB], 100. * byEpa / RESTING, 100. * byMpr / RESTING);
}

TEST(resting_depths_are_exact_where_those_of_libccd_are_not) {
    countWrong(SHAPE_BOX, SHAPE_BOX);
    countWrong(SHAPE_CYLINDER, SHAPE_BOX);
}
