/* Pairs of convex shapes of all kinds against a slow reference (HARD-CASES: exact depths, full manifolds). */
#include "karma_test.h"
#include "mcd_vector.h"
#include "reference.h"

/* Of the smaller shape's extent. */
static const double depthError = 1e-6;

static double sizeOf(const McdShape *a, const McdShape *b) {
    return fmin(a->extent, b->extent);
}

static char what[80]; /* is being compared */

static double deepest(const McdManifold *m) {
    double s = INFINITY;
    for (int i = 0; i < m->count; i++)
        s = fmin(s, m->point[i].separation);
    return s;
}

/* What holds of every manifold. */
static void assertSound(const McdShape *a, const McdShape *b, double margin, const McdManifold *m) {
    const double size = sizeOf(a, b), large = fmax(a->extent, b->extent);
    const double n = reference_along(a, b, m->normal);
    assert_near(mcd_length(m->normal), 1, 1e-12);
    ck_assert_int_ge(m->count, 1);
    ck_assert_int_le(m->count, MCD_MANIFOLD_POINTS);
    const double off = (deepest(m) - n) / size;
    ck_assert_msg(fabs(off) <= depthError + 1e-13 * large / size,
                  "%s: separation %.12g, along its normal %.12g, off by %g", what, deepest(m), n, off);
    for (int i = 0; i < m->count; i++) {
        ck_assert(isfinite(m->point[i].position[0] + m->point[i].position[1] + m->point[i].position[2]));
        ck_assert_double_le(m->point[i].separation, margin);
        for (int j = 0; j < i; j++)
            ck_assert_msg(m->point[i].feature != m->point[j].feature, "%s: two points with feature %08x", what,
                          m->point[i].feature);
    }
}

/* How a pair lies: alike, alike to a milliradian, or any way; overlapping, b's centre within a. */
enum { ALIGNED, TILTED, ANY, POSES };

static void placePair(McdShape *a, McdShape *b, int pose, double margin, Random *r) {
    double axis[3], n[3];
    random_direction(r, axis);
    if (pose == TILTED)
        shape_rotate(a, axis, random_between(r, 0, 1e-3));
    if (pose == ANY) {
        shape_rotateRandomly(a, r);
        random_direction(r, n);
    } else {
        mcd_set(n, 0, 0, 0);
        n[(int)(3 * random_unit(r))] = random_unit(r) < .5 ? -1 : 1;
        shape_move(a, random_between(r, -.3, .3) * b->extent, random_between(r, -.3, .3) * b->extent,
                   random_between(r, -.3, .3) * b->extent);
    }
    /* Out of the other along n, then in again a little or much. */
    const double in =
        random_unit(r) < .7 ? random_between(r, -margin, .05 * sizeOf(a, b)) : random_between(r, 0, sizeOf(a, b));
    const double k = -reference_along(a, b, n) - in;
    shape_move(a, k * n[0], k * n[1], k * n[2]);
    Random same = *r;
    shape_rotateRandomly(a, r);
    *r = same;
    shape_rotateRandomly(b, r);
}

static double worst;

static void comparePair(int kindA, int kindB, int pose, double scale, MeBool slab, Random *r) {
    McdShape a, b;
    McdManifold m;
    double n[3];
    shape_random(&a, kindA, scale, slab, r);
    shape_random(&b, kindB, scale, slab && random_unit(r) < .5, r);
    const double size = sizeOf(&a, &b), margin = .01 * size;
    placePair(&a, &b, pose, margin, r);
    snprintf(what, sizeof what, "%s, %s, %s%s, scale %g", shape_name[kindA], shape_name[kindB],
             pose == ALIGNED  ? "aligned"
             : pose == TILTED ? "tilted"
                              : "any",
             slab ? ", slab" : "", scale);
    const double expected = reference_distance(&a, &b, 400, n);
    const int count = mcd_convexManifold(&a, &b, margin, &m);
    if (expected > margin) {
        ck_assert_int_eq(count, 0);
        return;
    }
    if (expected < margin - depthError * size)
        ck_assert_msg(count > 0, "%s: no contact at %g", what, expected);
    if (!count)
        return;
    assertSound(&a, &b, margin, &m);
    worst = fmax(worst, (expected - deepest(&m)) / size);
    ck_assert_msg(deepest(&m) >= expected - depthError * size, "%s: %.12g instead of %.12g, off by %g of size", what,
                  deepest(&m), expected, (expected - deepest(&m)) / size);
}

START_TEST(depths_are_those_of_the_reference) {
    for (int i = 0; i < SHAPE_KINDS; i++)
        for (int j = i; j < SHAPE_KINDS; j++) {
            Random r = {.state = (unsigned long long)(1000 + 100 * i + j)};
            worst = -INFINITY;
            const int count = getenv("NEARFIELD_POSES") ? atoi(getenv("NEARFIELD_POSES")) : 60;
            for (int k = 0; k < count; k++)
                comparePair(k & 1 ? i : j, k & 1 ? j : i, k % POSES,
                            k % 7 == 0   ? 1e-3
                            : k % 7 == 1 ? 1e3
                                         : 1,
                            k % 5 == 0, &r);
            if (getenv("NEARFIELD_POSES"))
                printf("%-9s %-9s worst %.2g\n", shape_name[i], shape_name[j], worst);
        }
}
END_TEST

static void tests(TCase *t) {
    tcase_set_timeout(t, 0);
    tcase_add_test(t, depths_are_those_of_the_reference);
}

TEST_MAIN("Convex", tests)
