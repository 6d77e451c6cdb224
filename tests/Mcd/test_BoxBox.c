/* Boxes on boxes: 20 000 poses x { aligned, tilted by at most a milliradian, any } x { boxes, slabs 1:50 } against the
 * separating axes, tried one by one. */
#include "karma_test.h"
#include "convex/mcd_vector_i.h"
#include "reference.h"

enum { POSES = 20000 };
enum { ALIGNED, TILTED, ANY };

/* Of the smaller box's extent. */
static const double depthError = 1e-6, surfaceError = 6e-6, marginPart = .01;

static double deepest(const McdManifold *m) {
    double s = INFINITY;
    for (int i = 0; i < m->count; i++)
        s = fmin(s, m->point[i].separation);
    return s;
}

typedef struct Pose {
    McdShape a, b;
    double size, margin;
    int up;        /* the axis of b along which a stands on it, in other poses than ANY */
    MeBool isFull; /* a stands with its whole middle on b: a full manifold is due */
} Pose;

/* a on a face of b: a little in it or above it, moved aside by part of their sizes; then both turned alike. */
static void stand(Pose *p, int kind, Random *r) {
    const int k = (int)(3 * random_unit(r)), i = (k + 1) % 3, j = (k + 2) % 3;
    const double side = random_unit(r) < .5 ? -1 : 1;
    double d[3], axis[3], overlap[2];
    const double height = random_between(r, -.02, .005) * fmin(p->a.size[k], p->b.size[k]);
    d[k] = side * (p->a.size[k] + p->b.size[k] + height);
    d[i] = random_between(r, -.7, .7) * (p->a.size[i] + p->b.size[i]);
    d[j] = random_between(r, -.7, .7) * (p->a.size[j] + p->b.size[j]);
    overlap[0] = p->a.size[i] + p->b.size[i] - fabs(d[i]);
    overlap[1] = p->a.size[j] + p->b.size[j] - fabs(d[j]);
    p->up = k;
    /* The way along the face's normal is the shortest, and the milliradian stays within the margin. */
    p->isFull = fmin(overlap[0], overlap[1]) > .1 * fmin(p->a.size[k], p->b.size[k]);
    p->margin = fabs(height) + 3e-3 * p->a.extent;
    random_direction(r, axis);
    if (kind == TILTED)
        shape_rotate(&p->a, axis, random_between(r, 0, 1e-3));
    shape_move(&p->a, d[0], d[1], d[2]);
}

static Pose makePose(int kind, MeBool slab, double scale, Random *r) {
    Pose p;
    double axis[3];
    shape_random(&p.a, SHAPE_BOX, scale, slab, r);
    shape_random(&p.b, SHAPE_BOX, scale, slab && random_unit(r) < .5, r);
    p.size = fmin(p.a.extent, p.b.extent);
    p.margin = marginPart * p.size;
    if (kind == ANY) {
        random_direction(r, axis);
        shape_rotateRandomly(&p.a, r);
        const double reach = random_between(r, 0, .8) * (p.a.extent + p.b.extent);
        shape_move(&p.a, reach * axis[0], reach * axis[1], reach * axis[2]);
        p.isFull = 0;
    } else {
        stand(&p, kind, r);
    }
    for (int i = 0; i < 2; i++) {
        const double angle = random_between(r, -3, 3);
        random_direction(r, axis);
        shape_rotate(&p.a, axis, angle);
        shape_rotate(&p.b, axis, angle);
    }
    return p;
}

/* Each point is between two points of the surfaces that are its separation apart. */
static void assertOnSurfaces(const Pose *p, const McdManifold *m) {
    for (int i = 0; i < m->count; i++) {
        double onA[3], onB[3];
        mcd_mad(onA, m->point[i].position, m->point[i].separation / 2, m->normal);
        mcd_mad(onB, m->point[i].position, -m->point[i].separation / 2, m->normal);
        assert_near(reference_outside(&p->a, onA), 0, surfaceError * p->size);
        assert_near(reference_outside(&p->b, onB), 0, surfaceError * p->size);
    }
}

static void assertFull(const Pose *p, const McdManifold *m) {
    assert_near(fabs(mcd_dot(m->normal, p->b.axis[p->up])), 1, 1e-6);
    ck_assert_int_eq(m->count, 4);
}

static void assertDifferent(const McdManifold *m) {
    for (int i = 0; i < m->count; i++)
        for (int j = 0; j < i; j++)
            ck_assert_uint_ne(m->point[i].feature, m->point[j].feature);
}

static void comparePoses(int kind, MeBool slab) {
    int touching = 0, full = 0;
    for (int i = 0; i < POSES; i++) {
        Random r = {.state = (unsigned long long)(1 + i + POSES * (2 * kind + slab))};
        const double scale = i % 4 == 0 ? 1e-3 : i % 4 == 1 ? 1e3 : 1;
        Pose p;
        McdManifold m;
        double n[3];
        for (int k = 0; k < 8; k++)
            random_unit(&r);
        p = makePose(kind, slab, scale, &r);
        const double expected = reference_axes(&p.a, &p.b, n);
        mcd_convexManifold(&p.a, &p.b, (McdReach){.margin = p.margin}, &m);
        if (expected > 0) { /* the axes give a bound only */
            ck_assert(m.count == 0 || deepest(&m) >= expected - depthError * p.size);
        } else {
            ck_assert_int_ge(m.count, 1);
            assert_near(deepest(&m), expected, depthError * p.size);
            assert_near(reference_along(&p.a, &p.b, m.normal), expected, depthError * p.size);
        }
        if (m.count)
            assert_near(mcd_length(m.normal), 1, 4e-14);
        touching += m.count > 0;
        assertOnSurfaces(&p, &m);
        assertDifferent(&m);
        if (p.isFull) {
            assertFull(&p, &m);
            full++;
        }
    }
    ck_assert_int_gt(touching, kind == ANY ? POSES / 4 : POSES * 9 / 10);
    ck_assert_int_gt(full, kind == ANY ? -1 : POSES / 2);
}

LOOP_TEST(poses_of_boxes, 0, 3) {
    comparePoses(_i, 0);
}

LOOP_TEST(poses_of_slabs, 0, 3) {
    comparePoses(_i, 1);
}

/* ---- single cases ---------------------------------------------------------------------------------------- */

static void cubes(McdShape *a, McdShape *b) {
    shape_box(a, .5, .5, .5);
    shape_box(b, .5, .5, .5);
}

TEST(a_cube_on_another_touches_with_its_four_corners) {
    McdShape a, b;
    McdManifold m;
    cubes(&a, &b);
    shape_move(&a, 0, 0, 1); /* exactly */
    ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = 0}, &m), 4);
    assert_vec3_near(m.normal, 0, 0, 1, 0);
    for (int i = 0; i < 4; i++) {
        assert_near(m.point[i].separation, 0, 1e-15);
        assert_vec3_near(m.point[i].position, m.point[i].position[0] < 0 ? -.5 : .5,
                         m.point[i].position[1] < 0 ? -.5 : .5, .5, 5e-16);
    }
}

TEST(contacts_end_where_the_margin_does) {
    McdShape a, b;
    McdManifold m;
    cubes(&a, &b);
    shape_move(&a, 0, 0, 1.01);
    ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = .0099}, &m), 0);
    ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = .0101}, &m), 4);
    assert_near(m.point[0].separation, .01, 9e-17);
    assert_near(m.point[0].position[2], .505, 5e-16);
}

TEST(with_no_margin_only_what_is_inside_counts) {
    const double y[3] = {0, 1, 0};
    McdShape a, b;
    McdManifold m;
    cubes(&a, &b);
    shape_rotate(&a, y, 1e-3);
    shape_move(&a, 0, 0, 1);
    ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = 0}, &m), 2);
    for (int i = 0; i < 2; i++) {
        ck_assert_double_le(m.point[i].separation, 0);
        ck_assert_double_gt(m.point[i].position[0], .49); /* the side that is lower */
    }
    ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = .0011}, &m), 4);
}

TEST(one_within_the_other) {
    McdShape a, b;
    McdManifold m;
    shape_box(&a, .1, .1, .1);
    shape_box(&b, 1, 2, 3);
    shape_move(&a, .3, 0, 0);
    ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = 0}, &m), 4);
    assert_vec3_near(m.normal, 1, 0, 0, 0);
    assert_near(m.point[0].separation, -.8, 1e-15);
    shape_move(&a, -.3, 0, 0); /* concentric */
    ck_assert_int_ge(mcd_convexManifold(&a, &b, (McdReach){.margin = 0}, &m), 1);
    assert_near(mcd_length(m.normal), 1, 1e-15);
    assert_near(m.point[0].separation, -1.1, 1e-15);
}

static MeBool touchesAt(const McdManifold *m, double x, double y, double tolerance) {
    for (int i = 0; i < m->count; i++)
        if (hypot(m->point[i].position[0] - x, m->point[i].position[1] - y) < tolerance)
            return METRUE;
    return MEFALSE;
}

/* Two cubes meet in an octagon, the upper one tilted about one of its edges: it stands on both ends of that edge. */
LOOP_TEST(a_leaning_cube_stands_on_both_ends_of_an_edge, 0, 2 * 8) {
    const double pi = 3.14159265358979323846, z[3] = {0, 0, 1}, radius = .5 / cos(pi / 8);
    const double tilt = _i < 8 ? 1e-2 : 5e-3, towards = _i % 8 * pi / 4;
    const double axis[3] = {-sin(towards), cos(towards), 0};
    McdShape a, b;
    McdManifold m;
    cubes(&a, &b);
    shape_rotate(&a, z, pi / 4);
    shape_rotate(&a, axis, tilt);
    shape_move(&a, 0, 0, .5 + .5 * cos(tilt) + .5 * sin(tilt));
    ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = 2 * tilt}, &m), 4);
    for (int side = -1; side <= 1; side += 2)
        ck_assert(touchesAt(&m, radius * cos(towards + side * pi / 8), radius * sin(towards + side * pi / 8), tilt));
}

TEST(crossed_edges_touch_in_one_point) {
    const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
    McdShape a, b;
    McdManifold m;
    cubes(&a, &b);
    shape_rotate(&a, x, 3.14159265358979323846 / 4);
    shape_rotate(&b, y, 3.14159265358979323846 / 4);
    shape_move(&a, 0, 0, sqrt(2) - .01);
    ck_assert_int_ge(mcd_convexManifold(&a, &b, (McdReach){.margin = 0}, &m), 1);
    assert_vec3_near(m.normal, 0, 0, 1, 9e-16);
    assert_near(deepest(&m), -.01, 9e-17);
}

/* Nearest with a corner to a corner: no axis of the fifteen shows it. */
TEST(corners_apart) {
    McdShape a, b;
    McdManifold m;
    cubes(&a, &b);
    shape_move(&a, 1.003, 1.004, 1.012);
    ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = .0129}, &m), 0);
    ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = .0131}, &m), 1);
    assert_near(m.point[0].separation, .013, 2e-16);
    assert_vec3_near(m.normal, 3. / 13, 4. / 13, 12. / 13, 9e-14);
}

TEST(features_stay_while_a_box_slides) {
    McdShape a, b;
    McdManifold m, before = {.count = 0};
    for (int i = 0; i < 100; i++) {
        const double y[3] = {0, 1, 0};
        shape_box(&a, .5, .5, .5);
        shape_box(&b, 2, 2, 2);
        shape_rotate(&a, y, 1e-5 * sin(i));
        shape_move(&a, .01 * i, .003 * i, 2.5 - 1e-5 * i);
        ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = .01}, &m), 4);
        for (int k = 0; k < 4 && i; k++)
            ck_assert_uint_eq(m.point[k].feature, before.point[k].feature);
        before = m;
    }
}

/* Of two bars that lie across each other, the direction across two edges is then a face's to 1e-8, and mostly better by
 * as much: the face's it is all the same, so that normal and features stay. */
TEST(a_face_goes_before_edges_of_boxes_turned_by_1e_8) {
    int better = 0;
    Random r = {.state = 7};
    McdShape a, b;
    McdManifold m, flat;
    shape_box(&a, .7, .3, .3);
    shape_box(&b, .3, .7, .5);
    shape_move(&a, .02, .03, .79);
    ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = 0}, &flat), 4);
    for (int i = 0; i < 300; i++) {
        double axis[3], n[3];
        shape_box(&a, .7, .3, .3);
        random_direction(&r, axis);
        shape_rotate(&a, axis, 1e-8);
        shape_move(&a, .02, .03, .79);
        ck_assert_int_eq(mcd_convexManifold(&a, &b, (McdReach){.margin = 0}, &m), 4);
        const double onFace = fmax(reference_along(&a, &b, a.axis[2]), reference_along(&a, &b, b.axis[2]));
        better += reference_axes(&a, &b, n) > onFace;
        assert_near(mcd_dot(m.normal, a.axis[2]), 1, 1e-15);
        assert_near(sqrt(mcd_distanceSquared(m.normal, a.axis[2])), 0, 1e-15);
        for (int k = 0; k < 4; k++)
            ck_assert_uint_eq(m.point[k].feature, flat.point[k].feature);
    }
    ck_assert_int_gt(better, 50); /* edges have been better indeed */
}
