/* Pairs of convex shapes of all kinds against a slow reference (HARD-CASES: exact depths, full manifolds). */
#include "karma_test.h"
#include "convex/mcd_vector_i.h"
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
    assert_near(mcd_length(m->normal), 1, 2e-14);
    ck_assert_int_ge(m->count, 1);
    ck_assert_int_le(m->count, MCD_MANIFOLD_POINTS);
    const double off = (deepest(m) - n) / size;
    ck_assert_msg(fabs(off) <= depthError + 1e-13 * large / size,
                  "%s: separation %.12g, along its normal %.12g, off by %g", what, deepest(m), n, off);
    for (int i = 0; i < m->count; i++) {
        ck_assert(isfinite(m->point[i].position[0] + m->point[i].position[1] + m->point[i].position[2]));
        ck_assert_double_le(m->point[i].separation, margin);
        for (int j = 0; j < i; j++)
            ck_assert_msg(m->point[i].feature != m->point[j].feature, "%s: two points with feature %016llx", what,
                          (unsigned long long)m->point[i].feature);
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

/* The reference is a lower bound: what it finds nearer may be shown to be farther by a direction that it missed. */
static MeBool isShownApart(const McdShape *a, const McdShape *b, double margin) {
    double onA[3], onB[3], n[3];
    mcd_convexDistance(a, b, onA, onB, n);
    return reference_along(a, b, n) > margin;
}

static MeBool isSolid(const McdShape *s) {
    return s->kind->type == kMcdGeometryTypeBox || s->kind->type == kMcdGeometryTypeConvexMesh ||
           s->kind->rank == MCD_RANK_TRIANGLE;
}

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
    const double searched = reference_distance(&a, &b, 400, n);
    const double expected = isSolid(&a) && isSolid(&b) ? fmax(searched, reference_axes(&a, &b, n)) : searched;
    const int count = mcd_convexManifold(&a, &b, (McdReach){.margin = margin}, &m);
    if (expected > margin) {
        ck_assert_int_eq(count, 0);
        return;
    }
    if (expected < margin - depthError * size)
        ck_assert_msg(count > 0 || isShownApart(&a, &b, margin), "%s: no contact at %g", what, expected);
    if (!count)
        return;
    assertSound(&a, &b, margin, &m);
    worst = fmax(worst, (expected - deepest(&m)) / size);
    ck_assert_msg(deepest(&m) >= expected - depthError * size, "%s: %.12g instead of %.12g, off by %g of size", what,
                  deepest(&m), expected, (expected - deepest(&m)) / size);
}

#ifdef TEST_IS_SLOW
enum { POSES_OF_A_PAIR = 10 }; /* the reference takes most of the time */
#else
enum { POSES_OF_A_PAIR = 30 };
#endif

/* For long runs: NEARFIELD_POSES=60000 poses of each pair, a third of them of each kind, NEARFIELD_PAIR=hull-hull
 * only. */
static int posesOf(int i, int j) {
    const char *const poses = getenv("NEARFIELD_POSES"), *const only = getenv("NEARFIELD_PAIR");
    char pair[40];
    snprintf(pair, sizeof pair, "%s-%s", shape_name[i], shape_name[j]);
    return only && strcmp(only, pair) ? 0 : poses ? atoi(poses) : POSES_OF_A_PAIR;
}

TEST(depths_are_those_of_the_reference) {
    for (int i = 0; i < SHAPE_KINDS; i++)
        for (int j = i; j < SHAPE_KINDS; j++) {
            Random r = {.state = (unsigned long long)(1000 + 100 * i + j)};
            const int count = posesOf(i, j);
            worst = -INFINITY;
            for (int k = 0; k < count; k++)
                comparePair(k & 1 ? i : j, k & 1 ? j : i, k % POSES,
                            k % 7 == 0   ? 1e-3
                            : k % 7 == 1 ? 1e3
                                         : 1,
                            k % 5 == 0, &r);
            if (count && getenv("NEARFIELD_POSES"))
                printf("%-9s %-9s worst %.2g\n", shape_name[i], shape_name[j], worst);
        }
}

/* ---- properties ------------------------------------------------------------------------------------------ */

/* A pair of the kinds that overlaps or nearly touches, any way. */
static double anyPair(McdShape *a, McdShape *b, Random *r) {
    const int i = (int)(SHAPE_KINDS * random_unit(r)), j = (int)(SHAPE_KINDS * random_unit(r));
    const int pose = (int)(POSES * random_unit(r));
    shape_random(a, i, 1, random_unit(r) < .2, r);
    shape_random(b, j, 1, 0, r);
    placePair(a, b, pose, .01, r);
    snprintf(what, sizeof what, "%s, %s, pose %d", shape_name[i], shape_name[j], pose);
    return sizeOf(a, b);
}

TEST(pushed_out_by_the_depth_they_only_touch) {
    Random r = {.state = 7};
    for (int i = 0; i < 4000; i++) {
        McdShape a, b;
        McdManifold m;
        const double size = anyPair(&a, &b, &r);
        if (!mcd_convexManifold(&a, &b, (McdReach){.margin = 0}, &m))
            continue;
        const double k = -deepest(&m);
        shape_move(&a, k * m.normal[0], k * m.normal[1], k * m.normal[2]);
        mcd_convexManifold(&a, &b, (McdReach){.margin = .01 * size}, &m);
        ck_assert_msg(m.count > 0 && fabs(deepest(&m)) < depthError * size, "%s: %g after", what,
                      m.count ? deepest(&m) : INFINITY);
    }
}

TEST(swapping_the_shapes_turns_the_contacts_round) {
    Random r = {.state = 8};
    for (int i = 0; i < 4000; i++) {
        McdShape a, b;
        McdManifold m, n;
        const double size = anyPair(&a, &b, &r);
        mcd_convexManifold(&a, &b, (McdReach){.margin = .01 * size}, &m);
        mcd_convexManifold(&b, &a, (McdReach){.margin = .01 * size}, &n);
        ck_assert_msg((m.count > 0) == (n.count > 0), "%s: %d and %d points", what, m.count, n.count);
        if (!m.count)
            continue;
        ck_assert_msg(fabs(deepest(&m) - deepest(&n)) < depthError * size, "%s: %.10g and %.10g", what, deepest(&m),
                      deepest(&n));
        if (a.kind->type == b.kind->type)
            continue; /* of two ways out that are as short, the first shape's may be taken */
        for (int k = 0; k < 3; k++)
            ck_assert_double_eq(m.normal[k], -n.normal[k]);
        for (int k = 0; k < m.count; k++)
            assert_near(mcd_distanceSquared(m.point[k].position, n.point[k].position), 0, 0);
    }
}

TEST(turning_both_turns_the_contacts) {
    Random r = {.state = 9};
    for (int i = 0; i < 4000; i++) {
        McdShape a, b;
        McdManifold m, n;
        const double size = anyPair(&a, &b, &r);
        double axis[3];
        mcd_convexManifold(&a, &b, (McdReach){.margin = .01 * size}, &m);
        random_direction(&r, axis);
        shape_rotate(&a, axis, 2);
        shape_rotate(&b, axis, 2);
        shape_move(&a, 3, 4, 5);
        shape_move(&b, 3, 4, 5);
        mcd_convexManifold(&a, &b, (McdReach){.margin = .01 * size}, &n);
        if (m.count && deepest(&m) < .009 * size)
            ck_assert_msg(n.count && fabs(deepest(&m) - deepest(&n)) < depthError * size, "%s", what);
    }
}

TEST(supports_are_the_farthest_points) {
    Random r = {.state = 10};
    for (int i = 0; i < 20000; i++) {
        McdShape s;
        double n[3], point[3], expected[3];
        shape_random(&s, i % SHAPE_KINDS, 1, i % 3 == 0, &r);
        shape_rotateRandomly(&s, &r);
        random_direction(&r, n);
        mcd_support(&s, n, point);
        reference_support(&s, n, expected);
        assert_near(mcd_dot(point, n), mcd_dot(expected, n), 5e-15);
    }
}

TEST(the_distance_is_that_of_its_points) {
    Random r = {.state = 11};
    for (int i = 0; i < 4000; i++) {
        McdShape a, b;
        double onA[3], onB[3], n[3], d[3];
        const double size = anyPair(&a, &b, &r), k = random_between(&r, -.5, 2);
        double away[3];
        random_direction(&r, away);
        shape_move(&a, k * away[0], k * away[1], k * away[2]);
        const double distance = mcd_convexDistance(&a, &b, onA, onB, n);
        ck_assert(isfinite(distance));
        assert_near(mcd_length(n), 1, 7e-15);
        ck_assert_msg(fabs(reference_along(&a, &b, n) - distance) < depthError * size, "%s", what);
        mcd_sub(d, onA, onB);
        ck_assert_msg(fabs(mcd_dot(d, n) - distance) < depthError * size, "%s: %g, its points %g", what, distance,
                      mcd_dot(d, n));
        if (distance > .01)
            ck_assert_msg(fabs(mcd_length(d) - distance) < depthError * size, "%s: %g, its points %g", what, distance,
                          mcd_length(d));
        for (int c = 0; c < 64; c++) { /* each point is on or in its shape: no direction shows it outside */
            double e[3], top[3];
            random_direction(&r, e);
            reference_support(&a, e, top);
            ck_assert_msg(mcd_dot(onA, e) < mcd_dot(top, e) + 1e-5 * size, "%s", what);
            reference_support(&b, e, top);
            ck_assert_msg(mcd_dot(onB, e) < mcd_dot(top, e) + 1e-5 * size, "%s", what);
        }
    }
}

/* How far outside of a shape a point is; of a cylinder and of polyhedra exactly, of others as far as directions
 * show it. */
static double outsideOf(const McdShape *s, const double point[3], Random *r) {
    double off[3], max = -INFINITY;
    if (isSolid(s))
        return reference_outside(s, point);
    mcd_sub(off, point, s->place);
    const double along = mcd_dot(off, s->axis[2]), across = sqrt(fmax(mcd_dot(off, off) - along * along, 0));
    if (s->kind->type == kMcdGeometryTypeCylinder)
        return fmax(fabs(along) - s->low, across - s->size[0]);
    for (int c = 0; c < 64; c++) {
        double e[3], top[3];
        random_direction(r, e);
        reference_support(s, e, top);
        max = fmax(max, mcd_dot(point, e) - mcd_dot(top, e));
    }
    return max;
}

/* The worst of them, relative to the size: how far the points' difference is from the way out, and how far they are
 * outside of their shapes. */
static void measureEnds(int kindA, int kindB, int pose, double scale, Random *r, double *apart, double *outside) {
    McdShape a, b;
    double onA[3], onB[3], n[3], d[3];
    shape_random(&a, kindA, scale, random_unit(r) < .2, r);
    shape_random(&b, kindB, scale, random_unit(r) < .2, r);
    placePair(&a, &b, pose, 0, r);
    const double size = sizeOf(&a, &b), distance = mcd_convexDistance(&a, &b, onA, onB, n);
    if (distance > 0)
        return;
    mcd_sub(d, onA, onB);
    mcd_mad(d, d, -distance, n);
    *apart = fmax(*apart, mcd_length(d) / size);
    *outside = fmax(*outside, fmax(outsideOf(&a, onA, r), outsideOf(&b, onB, r)) / size);
}

TEST(the_points_of_overlapping_shapes_are_the_ends_of_the_shortest_way_out) {
    for (int i = 0; i < SHAPE_KINDS; i++)
        for (int j = i; j < SHAPE_KINDS; j++) {
            Random r = {.state = (unsigned long long)(7000 + 100 * i + j)};
            double apart = 0, outside = 0;
            for (int k = 0; k < 600; k++)
                measureEnds(k & 1 ? i : j, k & 1 ? j : i, k % POSES,
                            k % 7 == 0   ? 1e-3
                            : k % 7 == 1 ? 1e3
                                         : 1,
                            &r, &apart, &outside);
            ck_assert_msg(apart < 1e-10, "%s, %s: %g of the size apart", shape_name[i], shape_name[j], apart);
            ck_assert_msg(outside < 1e-6, "%s, %s: %g of the size outside", shape_name[i], shape_name[j], outside);
        }
}

/* ---- what lies on a face, or a plane --------------------------------------------------------------------- */

static const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
static const double right = 1.57079632679489662;

/* On a big box, and on the ground, whose tops are z = 0. */
static void assertStands(const McdShape *a, double margin, int points, double depth, double spread) {
    McdShape ground;
    McdManifold m;
    for (int isPlane = 0; isPlane < 2; isPlane++) {
        shape_box(&ground, 9, 9, 1);
        shape_move(&ground, 0, 0, -1);
        if (isPlane)
            mcd_planeManifold(a, z, 0, (McdReach){.margin = margin}, &m);
        else
            mcd_convexManifold(a, &ground, (McdReach){.margin = margin}, &m);
        ck_assert_int_eq(m.count, points);
        assert_vec3_near(m.normal, 0, 0, 1, 9e-16);
        assert_near(-deepest(&m), depth, 1e-7);
        for (int i = 0; i < points; i++) {
            assert_near(m.point[i].position[2], m.point[i].separation / 2, TOL(5e-10, 9e-16));
            for (int j = 0; j < i; j++) {
                ck_assert_double_ge(sqrt(mcd_distanceSquared(m.point[i].position, m.point[j].position)), spread);
                ck_assert_uint_ne(m.point[i].feature, m.point[j].feature);
            }
        }
    }
}

TEST(standing_and_lying) {
    for (int tilt = 0; tilt < 3; tilt++) {
        McdShape s;
        const double angle = tilt == 0 ? 0 : tilt == 1 ? 1e-7 : 1e-3, margin = .01;
        shape_cylinder(&s, .5, 1);
        shape_rotate(&s, x, angle);
        shape_move(&s, 0, 0, .999);
        assertStands(&s, margin, 4, .001 + cos(angle) - 1 + .5 * sin(angle), .4);
        shape_cylinder(&s, .5, 1);
        shape_rotate(&s, x, right + angle);
        shape_move(&s, 0, 0, .499);
        assertStands(&s, margin, 2, .001 + .5 * (cos(angle) - 1) + sin(angle), 1.9);
        shape_sphyl(&s, .5, 1);
        shape_rotate(&s, x, right + angle);
        shape_move(&s, 0, 0, .499);
        assertStands(&s, margin, 2, .001 + sin(angle), 1.9);
        shape_cone(&s, .5, 0, 1.5);
        shape_rotate(&s, x, angle);
        shape_move(&s, 0, 0, .499);
        assertStands(&s, margin, 4, .001 + .5 * (cos(angle) - 1) + .5 * sin(angle), .4);
        shape_hull(&s, hull_prism(6, .5, .5), 0);
        shape_rotate(&s, y, angle);
        shape_move(&s, 0, 0, .499);
        assertStands(&s, margin, 4, .001 + .5 * (cos(angle) - 1) + .5 * sin(angle), .4);
        shape_hull(&s, hull_prism(6, .5, .5), .1);
        shape_rotate(&s, y, angle);
        shape_move(&s, 0, 0, .599);
        assertStands(&s, margin, 4, .001 + .5 * (cos(angle) - 1) + .5 * sin(angle), .4);
        shape_box(&s, .5, .5, .5);
        shape_rotate(&s, y, angle);
        shape_move(&s, 0, 0, .499);
        assertStands(&s, margin, 4, .001 + .5 * (cos(angle) - 1) + .5 * sin(angle), .9);
    }
}

TEST(a_cone_lies_on_its_side) {
    McdShape s;
    shape_cone(&s, .5, 0, 1.5);
    /* The normal of the side that looks to -y, (0, -cos, sin), down. */
    shape_rotate(&s, x, right + atan2(.5, 1.5));
    const double down[3] = {0, 0, -1};
    double low[3];
    mcd_support(&s, down, low);
    shape_move(&s, 0, 0, -low[2] - .001);
    assertStands(&s, .01, 2, .001, 1.5);
}

TEST(one_cylinder_on_another) {
    McdShape a, b;
    McdManifold m;
    shape_cylinder(&a, .3, 1);
    shape_cylinder(&b, .5, 1);
    shape_move(&a, 0, 0, 1.999);
    ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = .01}, &m), 4);
    assert_vec3_near(m.normal, 0, 0, 1, 0);
    shape_cylinder(&a, .3, 1); /* lying along it */
    shape_move(&a, .799, 0, .5);
    ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = .01}, &m), 2);
    assert_vec3_near(m.normal, 1, 0, 0, 9e-16);
    for (int i = 0; i < 2; i++)
        assert_vec3_near(m.point[i].position, .4995, 0, i ? -.5 : 1, 9e-16);
    shape_cylinder(&a, .3, 1); /* lying across it */
    shape_rotate(&a, y, right);
    shape_move(&a, 0, .799, 0);
    ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = .01}, &m), 1);
    assert_vec3_near(m.normal, 0, 1, 0, TOL(5e-7, 9e-16));
    assert_near(m.point[0].separation, -.001, TOL(5e-10, 2e-15));
}

/* ---- where there is no direction, or no number ----------------------------------------------------------- */

static void assertAnswer(const McdShape *a, const McdShape *b, double separation) {
    McdManifold m;
    ck_assert_msg(mcd_convexManifold(a, b, (McdReach){.margin = 1e-6}, &m) > 0, "types %d and %d", a->kind->type,
                  b->kind->type);
    assert_near(mcd_length(m.normal), 1, 9e-16);
    ck_assert_msg(fabs(deepest(&m) - separation) < 1e-7, "types %d and %d: %.9g, expected %.9g", a->kind->type,
                  b->kind->type, deepest(&m), separation);
}

TEST(concentric_shapes_have_a_normal) {
    McdShape s[SHAPE_KINDS];
    const double corners[3][3] = {{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}};
    shape_sphere(&s[SHAPE_SPHERE], .5);
    shape_sphyl(&s[SHAPE_SPHYL], .5, 1);
    shape_box(&s[SHAPE_BOX], .5, .5, .5);
    shape_cylinder(&s[SHAPE_CYLINDER], .5, .5);
    shape_cone(&s[SHAPE_CONE], .5, .25, .75);
    shape_hull(&s[SHAPE_HULL], hull_prism(4, .5, .25), 0);
    shape_hull(&s[SHAPE_FAT_HULL], hull_prism(4, .5, .25), .1);
    mcd_triangleShape(corners, &s[SHAPE_TRIANGLE]);
    for (int i = 0; i < SHAPE_KINDS; i++)
        for (int j = 0; j < SHAPE_KINDS; j++) {
            double n[3];
            assertAnswer(&s[i], &s[j], reference_distance(&s[i], &s[j], 2000, n));
        }
}

TEST(flat_differences_have_a_normal_across) {
    const double corners[3][3] = {{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}};
    McdShape triangle, other;
    McdManifold m;
    mcd_triangleShape(corners, &triangle);
    shape_sphere(&other, .5); /* its centre in the triangle */
    assertAnswer(&other, &triangle, -.5);
    mcd_convexManifold(&other, &triangle, (McdReach){.margin = 0}, &m);
    assert_near(fabs(m.normal[2]), 1, 9e-16);
    shape_sphyl(&other, .5, 1);
    shape_rotate(&other, x, right); /* in its plane */
    assertAnswer(&other, &triangle, -.5);
    mcd_convexManifold(&other, &triangle, (McdReach){.margin = 0}, &m);
    assert_near(fabs(m.normal[2]), 1, 9e-16);
    McdShape crossing;
    shape_sphyl(&crossing, .5, 1);
    shape_rotate(&crossing, y, right);
    assertAnswer(&other, &crossing, -1);
    mcd_convexManifold(&other, &crossing, (McdReach){.margin = 0}, &m);
    assert_near(fabs(m.normal[2]), 1, 9e-16);
    assertAnswer(&other, &other, -1); /* parallel, the same */
}

TEST(what_is_no_number_touches_nothing) {
    for (int i = 0; i < SHAPE_KINDS; i++)
        for (int j = 0; j < SHAPE_KINDS; j++)
            for (int bad = 0; bad < 4; bad++) {
                Random r = {.state = 3};
                McdShape a, b;
                McdManifold m;
                shape_random(&a, i, 1, 0, &r);
                shape_random(&b, j, 1, 0, &r);
                (bad & 1 ? &a : &b)->place[bad & 2 ? 1 : 2] = bad & 2 ? NAN : INFINITY;
                ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = .01}, &m), 0);
            }
}

/* It is nowhere near: the distance has no bound, its points are the shapes' own places. */
TEST(what_is_no_number_is_infinitely_far_from_everything) {
    for (int i = 0; i < SHAPE_KINDS; i++)
        for (int j = 0; j < SHAPE_KINDS; j++)
            for (int bad = 0; bad < 2; bad++) {
                Random r = {.state = 3};
                McdShape a, b;
                double onA[3], onB[3], n[3];
                shape_random(&a, i, 1, 0, &r);
                shape_random(&b, j, 1, 0, &r);
                shape_move(&a, 1, 2, 3);
                shape_move(&b, -4, -5, -6);
                (bad ? &a : &b)->place[2] = NAN;
                ck_assert_double_eq(mcd_convexDistance(&a, &b, onA, onB, n), INFINITY);
                for (int k = 0; k < 3; k++) {
                    ck_assert(onA[k] == a.place[k] || (bad && k == 2 && isnan(onA[k])));
                    ck_assert(onB[k] == b.place[k] || (!bad && k == 2 && isnan(onB[k])));
                    ck_assert_double_eq(n[k], k == 2);
                }
            }
}

/* Balls and capsules end round, boxes do not: the points are on the surfaces, whichever is asked first. */
TEST(the_points_of_a_distance_are_on_the_surfaces) {
    for (int isTurned = 0; isTurned < 2; isTurned++)
        for (int apart = 0; apart < 2; apart++) {
            const double gap = apart ? .25 : -.125;
            McdShape ball, other[3];
            shape_sphere(&ball, .5);
            shape_move(&ball, 3, 1 + .25 + .5 + gap, -2);
            shape_sphere(&other[0], .25);
            shape_move(&other[0], 3, 1, -2);
            shape_box(&other[1], 2, .25, 2);
            shape_move(&other[1], 4, 1, -3);
            shape_sphyl(&other[2], .25, 2);
            shape_move(&other[2], 3, 1, -1.5);
            for (int i = 0; i < 3; i++) {
                double onBall[3], onOther[3], n[3];
                const double distance = isTurned ? mcd_convexDistance(&other[i], &ball, onOther, onBall, n)
                                                 : mcd_convexDistance(&ball, &other[i], onBall, onOther, n);
                assert_near(distance, gap, 1e-14);
                assert_vec3_near(n, 0, isTurned ? -1 : 1, 0, 1e-14);
                assert_vec3_near(onBall, 3, 1.25 + gap, -2, 1e-14);
                assert_vec3_near(onOther, 3, 1.25, -2, 1e-14);
            }
        }
}

/* Capsules of radius .25 and 2 m between their ends' centres, side by side, the second higher: the points are in the
 * middle of what is beside each other, or at the ends that are nearest. */
TEST(parallel_capsules_are_nearest_in_the_middle) {
    for (double up = -5; up <= 5; up += .25)
        for (int turn = 0; turn < 4; turn++) {
            McdShape a, b;
            double onA[3], onB[3], n[3], axis[3] = {.6, .8, 0};
            shape_sphyl(&a, .25, 1);
            shape_sphyl(&b, .25, 1);
            shape_move(&b, 1, 0, up);
            shape_rotate(&a, axis, .7 * turn);
            shape_rotate(&b, axis, .7 * turn);
            const double beyond = fmax(fabs(up) - 2, 0), side = up < 0 ? -1 : 1;
            const double middle = beyond > 0 ? side : up / 2;
            assert_near(mcd_convexDistance(&a, &b, onA, onB, n), hypot(1, beyond) - .5, 9e-15);
            mcd_sub(onA, onA, a.place);
            mcd_sub(onB, onB, b.place);
            assert_near(mcd_dot(onA, a.axis[2]), middle + .25 * beyond * side / hypot(1, beyond), 9e-15);
            assert_near(mcd_dot(onB, a.axis[2]), middle + beyond * side - up - .25 * beyond * side / hypot(1, beyond),
                        9e-15);
        }
}

/* A plane, a thin cone, a needle, a sheet: sizes that differ by millions. */
TEST(sizes_that_differ_much) {
    for (int i = 0; i < SHAPE_KINDS; i++)
        for (int j = 0; j < SHAPE_KINDS; j++) {
            Random r = {.state = 5};
            McdShape a, b;
            McdManifold m;
            shape_random(&a, i, 1e-3, 0, &r);
            shape_random(&b, j, 1e3, 0, &r);
            const double k = -reference_along(&a, &b, z) - 1e-4;
            shape_move(&a, 0, 0, k);
            mcd_convexManifold(&a, &b, (McdReach){.margin = 1e-5}, &m);
            for (int c = 0; c < m.count; c++)
                ck_assert(isfinite(m.point[c].separation) && m.point[c].separation <= 1e-5);
            if (m.count)
                assert_near(reference_along(&a, &b, m.normal), deepest(&m), TOL(1e-7, 2e-9) * a.extent);
        }
}
