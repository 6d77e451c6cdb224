/* Floors of tiles: what slides over a seam does not notice it, and a step stops it: between two fixed boxes, two parts
 * of an aggregate, two rectangles of a triangle list. */
#include "whole.h"

static MstUniverseID u;
static MeMatrix4 tiles[2];

/* Two tiles that meet at x = 0; the second one's top is as much higher. */
static void makeFloor(double step) {
    u = MstUniverseCreate(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, -10);
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMMakeIdentity(tiles[i]);
        tiles[i][3][0] = i ? 50 : -50;
        tiles[i][3][2] = (MeReal)(i ? step - 1 : -1);
        MstFixedModelCreate(u, McdBoxCreate(u->frame, 100, 10, 2), tiles[i]);
    }
}

enum { BOX, TALL, HULL, CYLINDER, BALL, KINDS };

static McdGeometryID makeShape(int kind, double *height) {
    MeVector3 corners[8];
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++)
            corners[i][k] = (MeReal)((i >> k & 1 ? 1 : -1) * (k == 2 ? .05 : .2));
    *height = (const double[]){.05, .5, .05, .2, .2}[kind];
    switch (kind) {
    case HULL:
        return McdConvexMeshCreateHull(u->frame, (const MeVector3 *)corners, 8, 0);
    case CYLINDER:
        return McdCylinderCreate(u->frame, (MeReal).2, (MeReal).4);
    case BALL:
        return McdSphereCreate(u->frame, (MeReal).2);
    default:
        return McdBoxCreate(u->frame, (MeReal).4, (MeReal).4, (MeReal)(2 * *height));
    }
}

/* How far it slides in a second, of v m. */
static double slide(int kind, double v, int rate, double step) {
    double height;
    MeVector3 p;
    makeFloor(step);
    McdModelID m = MstModelAndBodyCreate(u, makeShape(kind, &height), 1000);
    McdModelDynamicsSetPosition(m, (MeReal)-.5, 0, (MeReal)height);
    McdModelDynamicsSetLinearVelocity(m, (MeReal)v, 0, 0);
    for (int i = 0; i < rate; i++)
        MstUniverseStep(u, (MeReal)(1. / rate));
    McdModelDynamicsGetPosition(m, p);
    MstUniverseDestroy(u);
    return (double)p[0] + .5;
}

START_TEST(a_seam_between_fixed_boxes_is_not_felt) {
    const double speeds[] = {.8, 1, 5, 20}; /* with 1 a step ends at the seam */
    const int rates[] = {30, 60, 240};
    for (int kind = 0; kind < KINDS; kind++)
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 3; k++)
                assert_near_rel(slide(kind, speeds[i], rates[k], 0), speeds[i], TOL(1e-5, 1e-9));
}
END_TEST

/* It is stopped after .3 m, and moves away with some 2 % of its speed, as the floors have no friction. */
START_TEST(a_step_of_a_thousandth_of_the_size_stops_a_box) {
    for (int kind = 0; kind <= HULL; kind += HULL)
        assert_near(slide(kind, .8, 60, 5e-4), .29, .015);
}
END_TEST

START_TEST(what_is_flush_to_a_ten_thousandth_of_its_radius_passes) {
    const double radius = sqrt(.2 * .2 + .2 * .2 + .05 * .05);
    assert_near(slide(BOX, .8, 60, .7e-4 * radius), .8, .01);
    assert_near(slide(BOX, .8, 60, 1.5e-4 * radius), .29, .015);
}
END_TEST

/* ---- the same floor of boxes, of parts, of triangles ------------------------------------------------------------- */

enum { OF_BOXES, OF_PARTS, OF_TRIANGLES, FLOORS };
static const char *const floorName[FLOORS] = {"boxes", "parts", "triangles"};

typedef struct Floor {
    double size; /* m; lengths are in it: */
    double gap;  /* between the tiles; below 0 they overlap */
    double step; /* from the first to the second */
    double yaw;  /* rad, of the seam about z */
    double fold; /* rad, of the second tile about the seam, upward */
} Floor;

static MeVector3 corners[2][4]; /* of both tops */

static int MEAPI giveTops(McdModelPair *pair, McdUserTriangle *triangle, MeVector3 at, MeReal radius, int max) {
    enum { TRIANGLES = 4 };
    (void)pair, (void)at, (void)radius, (void)max;
    memset(triangle, 0, TRIANGLES * sizeof *triangle);
    for (int i = 0; i < TRIANGLES; i++) {
        const int half = i % 2;
        const int vertex[3] = {0, 1 + half, 2 + half};
        for (int k = 0; k < 3; k++)
            triangle[i].vertices[k] = &corners[i / 2][vertex[k]];
        triangle[i].flags = (McdTriangleFlags)(kMcdTriangleUseSmallestPenetration | kMcdTriangleUseEdges);
    }
    return TRIANGLES;
}

enum { LENGTH = 10, WIDTH = 10, HEIGHT = 2 }; /* of a tile */

/* The frame of a tile, and the corners of its top. */
static void placeTile(int i, const Floor *f) {
    const double fold = i ? f->fold : 0, c = cos(f->yaw), s = sin(f->yaw);
    const double axis[3][3] = {
        {cos(fold) * c, cos(fold) * s, sin(fold)}, {-s, c, 0}, {-sin(fold) * c, -sin(fold) * s, cos(fold)}};
    const double edge[3] = {i ? f->gap * c : 0, i ? f->gap * s : 0, i ? f->step : 0};
    const double away = i ? 1 : -1;
    MeMatrix4TMMakeIdentity(tiles[i]);
    for (int k = 0; k < 3; k++) {
        for (int a = 0; a < 3; a++)
            tiles[i][a][k] = (MeReal)axis[a][k];
        tiles[i][3][k] = (MeReal)(f->size * (edge[k] + away * LENGTH / 2. * axis[0][k] - HEIGHT / 2. * axis[2][k]));
        for (int q = 0; q < 4; q++) {
            const double x = (q == 0 || q == 3) == (i == 0) ? away * LENGTH : 0, y = (q < 2 ? -.5 : .5) * WIDTH;
            corners[i][q][k] = (MeReal)(f->size * (edge[k] + x * axis[0][k] + y * axis[1][k]));
        }
    }
}

static void layFloor(int kind, const Floor *f) {
    static MeMatrix4 place;
    const MeReal size = (MeReal)f->size;
    MeVector3 low = {-30 * size, -30 * size, -30 * size}, high = {30 * size, 30 * size, 30 * size};
    const McdAggregateID parts = kind == OF_PARTS ? McdAggregateCreate(u->frame, 2) : 0;
    MeMatrix4TMMakeIdentity(place);
    for (int i = 0; i < 2; i++) {
        placeTile(i, f);
        if (kind == OF_TRIANGLES)
            continue;
        const McdGeometryID tile = McdBoxCreate(u->frame, LENGTH * size, WIDTH * size, HEIGHT * size);
        if (kind == OF_PARTS)
            McdAggregateAddElement(parts, tile, tiles[i]);
        else
            MstFixedModelCreate(u, tile, tiles[i]);
    }
    if (kind == OF_PARTS)
        MstFixedModelCreate(u, parts, place);
    if (kind == OF_TRIANGLES)
        MstFixedModelCreate(u, McdTriangleListCreate(u->frame, low, high, 5, giveTops), place);
}

/* How far a box, cylinder or ball slides in 1.5 s, of 1.2 sizes. */
static double slideOver(int kind, int shape, const Floor *f) {
    const MeReal s = (MeReal)f->size;
    MstUniverseSizes sizes = MstUniverseGrowingSizes;
    MeVector3 p;
    sizes.lengthScale = s;
    u = MstUniverseCreate(&sizes);
    MdtWorldSetGravity(u->world, 0, 0, -10 * s);
    layFloor(kind, f);
    const McdGeometryID g = shape == BOX    ? McdBoxCreate(u->frame, (MeReal).4 * s, (MeReal).4 * s, (MeReal).1 * s)
                            : shape == BALL ? McdSphereCreate(u->frame, (MeReal).2 * s)
                                            : McdCylinderCreate(u->frame, (MeReal).2 * s, (MeReal).4 * s);
    const McdModelID m = MstModelAndBodyCreate(u, g, 1000 / (s * s * s));
    McdModelDynamicsSetPosition(m, (MeReal)-.5 * s, 0, (MeReal)(shape == BOX ? .05 : .2) * s);
    McdModelDynamicsSetLinearVelocity(m, (MeReal).8 * s, 0, 0);
    for (int i = 0; i < 90; i++)
        MstUniverseStep(u, (MeReal)(1. / 60));
    McdModelDynamicsGetPosition(m, p);
    MstUniverseDestroy(u);
    return (double)p[0] / f->size + .5;
}

static const int sliders[] = {BOX, CYLINDER, BALL};

static void assertNotFelt(int floor, const Floor *f, const char *what, double tolerance) {
    for (int i = 0; i < 3; i++) {
        const double way = slideOver(floor, sliders[i], f);
        ck_assert_msg(fabs(way - 1.2) <= tolerance, "%s, %s, shape %d: %g instead of 1.2", floorName[floor], what,
                      sliders[i], way);
    }
}

START_TEST(tiles_that_abut_or_overlap_are_one_floor_at_any_size_and_angle) {
    const double sizes[] = {.01, 1, 100}, overlaps[] = {0, 1e-3, .1}, yaws[] = {.35, .785};
    for (int i = 0; i < 3; i++)
        assertNotFelt(_i, &(Floor){.size = sizes[i]}, "size", TOL(2e-5, 1e-8));
    for (int i = 0; i < 3; i++)
        assertNotFelt(_i, &(Floor){.size = 1, .gap = -overlaps[i]}, "overlap", TOL(2e-5, 1e-8));
    for (int i = 0; i < 2; i++)
        assertNotFelt(_i, &(Floor){.size = 1, .yaw = yaws[i]}, "yaw", TOL(2e-5, 1e-8));
}
END_TEST

/* Triangles are neighbours by equal corners: a gap is a border. */
START_TEST(a_small_gap_between_tiles_is_not_felt) {
    const double gaps[] = {1e-5, 1e-3};
    for (int i = 0; i < 2; i++)
        for (int floor = OF_BOXES; floor <= OF_PARTS; floor++)
            assertNotFelt(floor, &(Floor){.size = 1, .gap = gaps[i]}, "gap", TOL(2e-5, 1e-8));
}
END_TEST

/* Up, and down. */
START_TEST(a_step_of_a_hundred_thousandth_is_not_felt) {
    for (int i = 0; i < 2; i++)
        for (int floor = OF_BOXES; floor <= OF_PARTS; floor++)
            assertNotFelt(floor, &(Floor){.size = 1, .step = i ? -1e-5 : 1e-5}, "step", 2e-4);
}
END_TEST

START_TEST(a_step_of_a_thousandth_stops_a_box_on_any_floor) {
    const double way = slideOver(_i, BOX, &(Floor){.size = 1, .step = 1e-3}); /* .3 to it, and slowly away again */
    ck_assert_msg(way > .25 && way < .3, "%s: %g", floorName[_i], way);
}
END_TEST

START_TEST(a_ball_rolls_over_a_fold_of_any_floor) {
    const double angle = 1. / 57;
    const double up = slideOver(_i, BALL, &(Floor){.size = 1, .fold = angle});
    const double down = slideOver(_i, BALL, &(Floor){.size = 1, .fold = -angle});
    ck_assert_msg(up > 1.1 && up < 1.15 && down > 1.24 && down < 1.28, "up %g, down %g", up, down);
}
END_TEST

/* 1 and 5 degrees. */
START_TEST(all_shapes_slide_over_a_fold_down_of_parts_and_triangles) {
    const double angles[] = {1. / 57, 5. / 57};
    for (int floor = OF_PARTS; floor <= OF_TRIANGLES; floor++)
        for (int i = 0; i < 2; i++)
            for (int k = 0; k < 3; k++)
                ck_assert_double_gt(slideOver(floor, sliders[k], &(Floor){.size = 1, .fold = -angles[i]}), 1.2);
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, a_seam_between_fixed_boxes_is_not_felt);
    tcase_add_test(t, a_step_of_a_thousandth_of_the_size_stops_a_box);
    tcase_add_test(t, what_is_flush_to_a_ten_thousandth_of_its_radius_passes);
    tcase_add_loop_test(t, tiles_that_abut_or_overlap_are_one_floor_at_any_size_and_angle, 0, FLOORS);
    tcase_add_test(t, a_small_gap_between_tiles_is_not_felt);
    tcase_add_test(t, a_step_of_a_hundred_thousandth_is_not_felt);
    tcase_add_loop_test(t, a_step_of_a_thousandth_stops_a_box_on_any_floor, 0, FLOORS);
    tcase_add_loop_test(t, a_ball_rolls_over_a_fold_of_any_floor, 0, FLOORS);
    tcase_add_test(t, all_shapes_slide_over_a_fold_down_of_parts_and_triangles);
}

TEST_MAIN("Seams", tests)
