/* Floors of two tiles: a body slides over the seam between them as over a single tile, and a step stops the body. The
 * tiles are fixed boxes, parts of an aggregate, or rectangles of a triangle list. */
#include "universe.h"
#include "whole.h"

static MeMatrix4 tiles[2];

/* Lays two tiles that meet at x = 0; the second tile's top is higher by `step`. */
static void makeFloor(double step) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, -10);
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMMakeIdentity(tiles[i]);
        tiles[i][3][0] = i ? 50 : -50;
        tiles[i][3][2] = (i ? step - 1 : -1);
        MstFixedModelCreate(u, McdBoxCreate(u->frame, 100, 10, 2), tiles[i]);
    }
}

enum { BOX, TALL, HULL, CYLINDER, BALL, CAPSULE, KINDS };

/* A shape with an axis lies along y. */
static McdGeometryID makeShape(int kind, double size, double *height) {
    const MeReal s = size;
    MeVector3 corners[8];
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++)
            corners[i][k] = ((i >> k & 1 ? 1 : -1) * (k == 2 ? .05 : .2)) * s;
    *height = size * (const double[]){.05, .5, .05, .2, .2, .2}[kind];
    switch (kind) {
    case HULL:
        return McdConvexMeshCreateHull(u->frame, (const MeVector3 *)corners, 8, 0);
    case CYLINDER:
        return McdCylinderCreate(u->frame, .2 * s, .4 * s);
    case BALL:
        return McdSphereCreate(u->frame, .2 * s);
    case CAPSULE:
        return McdSphylCreate(u->frame, .2 * s, .4 * s);
    default:
        return McdBoxCreate(u->frame, .4 * s, .4 * s, 2 * *height);
    }
}

/* Creates a body half a size before the seam, which moves toward the seam. */
static McdModelID putBody(int kind, double size, double speed) {
    double height;
    const McdGeometryID shape = makeShape(kind, size, &height);
    const McdModelID m = MstModelAndBodyCreate(u, shape, 1000 / (size * size * size));
    McdModelDynamicsSetPosition(m, -.5 * size, 0, height);
    if (kind == CAPSULE)
        McdModelDynamicsSetQuaternion(m, MeSqrt(.5), MeSqrt(.5), 0, 0);
    McdModelDynamicsSetLinearVelocity(m, speed * size, 0, 0);
    return m;
}

/* The displacement in one second, m; without a seam v. */
static double slide(int kind, double v, int rate, double step) {
    MeVector3 p;
    makeFloor(step);
    const McdModelID m = putBody(kind, 1, v);
    for (int i = 0; i < rate; i++)
        MstUniverseStep(u, 1. / rate);
    McdModelDynamicsGetPosition(m, p);
    return p[0] + .5;
}

TEST(a_seam_between_fixed_boxes_is_not_felt) {
    const double speeds[] = {.8, 1, 5, 20}; /* with 1 a step ends at the seam */
    const int rates[] = {30, 60, 240};
    for (int kind = 0; kind < KINDS; kind++)
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 3; k++)
                assert_near_rel(slide(kind, speeds[i], rates[k], 0), speeds[i], TOL(1e-5, 1e-9));
}

/* The body is stopped after .3 m and rebounds with about 2 % of its speed, as the floors have no friction. */
TEST(a_step_of_a_thousandth_of_the_size_stops_a_box) {
    for (int kind = 0; kind <= HULL; kind += HULL)
        assert_near(slide(kind, .8, 60, 5e-4), .29, .015);
}

TEST(what_is_flush_to_a_ten_thousandth_of_its_radius_passes) {
    const double radius = sqrt(.2 * .2 + .2 * .2 + .05 * .05);
    assert_near(slide(BOX, .8, 60, .7e-4 * radius), .8, .01);
    assert_near(slide(BOX, .8, 60, 1.5e-4 * radius), .29, .015);
}

/* ---- the same floor of boxes, of parts, of triangles ------------------------------------------------------------- */

enum { OF_BOXES, OF_PARTS, OF_TRIANGLES, FLOORS };
static const char *const floorName[FLOORS] = {"boxes", "parts", "triangles"};

typedef struct Floor {
    double size;   /* m: the unit of the lengths below */
    double gap;    /* between the tiles; below 0 they overlap */
    double step;   /* up from the first tile to the second */
    double yaw;    /* rad, of the seam about z */
    double fold;   /* rad, of the second tile about the seam, upward */
    double speed;  /* m/s; 0: .8 */
    double length; /* of a tile; 0: 10, or 30 if the speed is above 1 */
} Floor;

static double lengthOf(const Floor *f) {
    return f->length > 0 ? f->length : f->speed > 1 ? 30 : 10;
}

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

enum { WIDTH = 10, HEIGHT = 2 }; /* of a tile */

/* Sets the frame of a tile and the corners of its top. */
static void placeTile(int i, const Floor *f) {
    const double fold = i ? f->fold : 0, c = cos(f->yaw), s = sin(f->yaw);
    const double axis[3][3] = {
        {cos(fold) * c, cos(fold) * s, sin(fold)}, {-s, c, 0}, {-sin(fold) * c, -sin(fold) * s, cos(fold)}};
    const double edge[3] = {i ? f->gap * c : 0, i ? f->gap * s : 0, i ? f->step : 0};
    const double away = i ? 1 : -1;
    MeMatrix4TMMakeIdentity(tiles[i]);
    for (int k = 0; k < 3; k++) {
        for (int a = 0; a < 3; a++)
            tiles[i][a][k] = axis[a][k];
        tiles[i][3][k] = (f->size * (edge[k] + away * lengthOf(f) / 2 * axis[0][k] - HEIGHT / 2. * axis[2][k]));
        for (int q = 0; q < 4; q++) {
            const double x = (q == 0 || q == 3) == (i == 0) ? away * lengthOf(f) : 0, y = (q < 2 ? -.5 : .5) * WIDTH;
            corners[i][q][k] = (f->size * (edge[k] + x * axis[0][k] + y * axis[1][k]));
        }
    }
}

static void layFloor(int kind, const Floor *f) {
    static MeMatrix4 place;
    const MeReal size = f->size;
    MeVector3 low = {-60 * size, -60 * size, -60 * size}, high = {60 * size, 60 * size, 60 * size};
    const McdAggregateID parts = kind == OF_PARTS ? McdAggregateCreate(u->frame, 2) : 0;
    MeMatrix4TMMakeIdentity(place);
    for (int i = 0; i < 2; i++) {
        placeTile(i, f);
        if (kind == OF_TRIANGLES)
            continue;
        const McdGeometryID tile = McdBoxCreate(u->frame, lengthOf(f) * size, WIDTH * size, HEIGHT * size);
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

static double speedOf(const Floor *f) {
    return f->speed > 0 ? f->speed : .8;
}

/* The number of steps of 1/60 s in which a body passes the seam. */
static int stepsOf(const Floor *f) {
    return (int)ceil(60 * fmax(1.5, 10 / speedOf(f) * (speedOf(f) > 1)) - 1e-9);
}

/* The displacement of a body in that time on a single tile, in sizes. */
static double freeWay(const Floor *f) {
    return speedOf(f) * stepsOf(f) / 60;
}

/* The displacement of a body in that time on a floor, in sizes. */
static double slideOver(int kind, int shape, const Floor *f) {
    const MeReal s = f->size;
    MstUniverseSizes sizes = MstUniverseGrowingSizes;
    MeVector3 p;
    sizes.lengthScale = s;
    universe_begin(&sizes);
    MdtWorldSetGravity(u->world, 0, 0, -10 * s);
    layFloor(kind, f);
    const McdModelID m = putBody(shape, f->size, speedOf(f));
    universe_step(stepsOf(f));
    McdModelDynamicsGetPosition(m, p);
    return p[0] / f->size + .5;
}

static const int sliders[] = {BOX, CYLINDER, BALL, CAPSULE, HULL};
enum { SLIDERS = 5 };

static void assertNotFelt(int floor, const Floor *f, const char *what, double tolerance) {
    for (int i = 0; i < SLIDERS; i++) {
        const double way = slideOver(floor, sliders[i], f);
        ck_assert_msg(fabs(way - 1.2) <= tolerance, "%s, %s, shape %d: %g instead of 1.2", floorName[floor], what,
                      sliders[i], way);
    }
}

LOOP_TEST(tiles_that_abut_or_overlap_are_one_floor_at_any_size_and_angle, 0, FLOORS) {
    const double sizes[] = {.01, 1, 100}, overlaps[] = {0, 1e-3, .1}, yaws[] = {.35, .785};
    for (int i = 0; i < 3; i++)
        assertNotFelt(_i, &(Floor){.size = sizes[i]}, "size", TOL(2e-5, 1e-8));
    for (int i = 0; i < 3; i++)
        assertNotFelt(_i, &(Floor){.size = 1, .gap = -overlaps[i]}, "overlap", TOL(2e-5, 1e-8));
    for (int i = 0; i < 2; i++)
        assertNotFelt(_i, &(Floor){.size = 1, .yaw = yaws[i]}, "yaw", TOL(2e-5, 1e-8));
}

TEST(a_small_gap_between_tiles_is_not_felt) {
    const double gaps[] = {1e-5, 1e-3};
    for (int i = 0; i < 2; i++)
        for (int floor = 0; floor < FLOORS; floor++)
            assertNotFelt(floor, &(Floor){.size = 1, .gap = gaps[i]}, "gap", TOL(1e-4, 1e-4));
}

/* Steps up and down. */
TEST(a_step_of_a_hundred_thousandth_is_not_felt) {
    for (int i = 0; i < 2; i++)
        for (int floor = 0; floor < FLOORS; floor++)
            assertNotFelt(floor, &(Floor){.size = 1, .step = i ? -1e-5 : 1e-5}, "step", 2e-4);
}

/* A box slides .3 sizes to the step, and then slowly back. */
static void assertStopped(int floor, const Floor *f) {
    const double way = slideOver(floor, BOX, f);
    ck_assert_msg(way > .25 && way < .3, "%s, size %g, tiles of %g: %g", floorName[floor], f->size, f->length, way);
}

LOOP_TEST(a_step_of_a_thousandth_stops_a_box_on_any_floor, 0, FLOORS) {
    const double sizes[] = {.1, 1, 10}, lengths[] = {10, 100};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++)
            assertStopped(_i, &(Floor){.size = sizes[i], .step = 1e-3, .length = lengths[k]});
}

LOOP_TEST(a_ball_rolls_over_a_fold_of_any_floor, 0, FLOORS) {
    const double angle = 1. / 57;
    const double up = slideOver(_i, BALL, &(Floor){.size = 1, .fold = angle});
    const double down = slideOver(_i, BALL, &(Floor){.size = 1, .fold = -angle});
    ck_assert_msg(up > 1.1 && up < 1.15 && down > 1.24 && down < 1.28, "up %g, down %g", up, down);
}

/* 1 and 5 degrees. */
TEST(all_shapes_slide_over_a_fold_down_of_any_floor) {
    const double angles[] = {1. / 57, 5. / 57};
    for (int floor = 0; floor < FLOORS; floor++)
        for (int i = 0; i < 2; i++)
            for (int k = 0; k < SLIDERS; k++)
                ck_assert_double_gt(slideOver(floor, sliders[k], &(Floor){.size = 1, .fold = -angles[i]}), 1.2);
}

/* The displacements on the three floors are equal to within 1 %, and at least `min` of that on a single tile. */
static void assertAlike(int shape, const Floor *f, double min) {
    double way[FLOORS], shortest = INFINITY, longest = 0;
    for (int i = 0; i < FLOORS; i++) {
        way[i] = slideOver(i, shape, f) / freeWay(f);
        shortest = fmin(shortest, way[i]);
        longest = fmax(longest, way[i]);
    }
    ck_assert_msg(longest - shortest <= .01 * fmax(longest, 1) && shortest >= min,
                  "shape %d, size %g, %g m/s, gap %g, step %g, fold %g: %g %g %g of the free way", shape, f->size,
                  f->speed, f->gap, f->step, f->fold, way[OF_BOXES], way[OF_PARTS], way[OF_TRIANGLES]);
}

#ifdef TEST_IS_SLOW
enum { SIZES = 1 };
#else
enum { SIZES = 3 };
#endif

/* One loop for each shape. */
LOOP_TEST(boxes_parts_and_triangles_are_one_floor, 0, 4) {
    static const int shapes[] = {BOX, HULL, BALL, CAPSULE};
    static const double sizes[] = {1, .1, 10};
    const double speeds[] = {0, 1, 5, 20};
    const double folds[] = {0, .2, 1, 3, 10, 20, 30}, gaps[] = {1e-4, 1e-3, 5e-3, 1e-2, 2e-2};
    const double steps[] = {1e-4, 1e-3, 3e-3, 1e-2}, radian = 3.14159265358979 / 180;
    for (int i = 0; i < SIZES; i++)
        for (int k = 0; k < 4; k++) {
            const Floor level = {.size = sizes[i], .speed = speeds[k]};
            Floor f = level;
            for (int j = 0; j < 7; j++, f = level) {
                f.fold = -folds[j] * radian;
                assertAlike(shapes[_i], &f, .995);
            }
            for (int j = 0; j < 5; j++, f = level) {
                f.gap = gaps[j];
                assertAlike(shapes[_i], &f, .995);
            }
            for (int j = 0; j < 4; j++, f = level) {
                f.step = -steps[j];
                assertAlike(shapes[_i], &f, .995);
            }
            f.fold = radian;
            assertAlike(shapes[_i], &f, .7);
        }
}

/* ---- edges of the surface ---------------------------------------------------------------------------------------- */

/* A wall at the end of the floor, upright or leaning outward. */
LOOP_TEST(a_wall_stops_what_slides_along_the_floor, 0, FLOORS) {
    const double angles[] = {90, 80, 70};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < SLIDERS; k++) {
            const Floor f = {.size = 1, .fold = angles[i] * 3.14159265358979 / 180};
            const double way = slideOver(_i, sliders[k], &f);
            ck_assert_msg(way < .42, "%s, wall of %g degrees, shape %d: %g", floorName[_i], angles[i], sliders[k], way);
        }
}

/* A body beside the floor's end, its centre at the height of the top, moves toward the floor for a second, without
 * gravity. */
LOOP_TEST(the_outer_edge_of_a_floor_stops_what_comes_from_outside, 0, FLOORS) {
    for (int k = 0; k < SLIDERS; k++) {
        MeVector3 p;
        universe_begin(&MstUniverseGrowingSizes);
        layFloor(_i, &(Floor){.size = 1});
        const McdModelID m = putBody(sliders[k], 1, 0);
        McdModelDynamicsSetPosition(m, 10.5, 0, 0);
        McdModelDynamicsSetLinearVelocity(m, -.8, 0, 0);
        universe_step(60);
        McdModelDynamicsGetPosition(m, p);
        ck_assert_msg(p[0] > 10.19, "%s, shape %d: at %g", floorName[_i], sliders[k], p[0]);
    }
}

/* A gap of one size, into which each body fits. */
LOOP_TEST(a_wide_gap_between_tiles_has_walls, 0, FLOORS) {
    for (int k = 0; k < SLIDERS; k++) {
        MeVector3 p;
        universe_begin(&MstUniverseGrowingSizes);
        layFloor(_i, &(Floor){.size = 1, .gap = 1});
        const McdModelID m = putBody(sliders[k], 1, 0);
        McdModelDynamicsSetPosition(m, .5, 0, 0);
        McdModelDynamicsSetLinearVelocity(m, .8, 0, 0);
        universe_step(60);
        McdModelDynamicsGetPosition(m, p);
        ck_assert_msg(p[0] < .81, "%s, shape %d: at %g", floorName[_i], sliders[k], p[0]);
    }
}

/* A body that slides beyond the end of the floor falls. */
LOOP_TEST(a_floor_does_not_hold_what_is_beyond_its_end, 0, FLOORS) {
    for (int k = 0; k < SLIDERS; k++) {
        MeVector3 p;
        universe_begin(&MstUniverseGrowingSizes);
        MdtWorldSetGravity(u->world, 0, 0, -10);
        layFloor(_i, &(Floor){.size = 1});
        const McdModelID m = putBody(sliders[k], 1, 0);
        McdModelDynamicsGetPosition(m, p);
        McdModelDynamicsSetPosition(m, 9.5, 0, p[2]);
        McdModelDynamicsSetLinearVelocity(m, .8, 0, 0);
        universe_step(90);
        McdModelDynamicsGetPosition(m, p);
        ck_assert_msg(p[0] > 10.5 && p[2] < -.5, "%s, shape %d: at %g %g", floorName[_i], sliders[k], p[0], p[2]);
    }
}

/* The first tile is replaced by a plane at the height of the second tile's top. */
TEST(a_tile_that_is_flush_with_a_plane_is_not_felt) {
    MeVector3 p;
    for (int k = 0; k < SLIDERS; k++) {
        universe_begin(&MstUniverseGrowingSizes);
        MdtWorldSetGravity(u->world, 0, 0, -10);
        universe_addFloor();
        placeTile(1, &(Floor){.size = 1});
        MstFixedModelCreate(u, McdBoxCreate(u->frame, 10, 10, 2), tiles[1]);
        const McdModelID m = putBody(sliders[k], 1, .8);
        universe_step(90);
        McdModelDynamicsGetPosition(m, p);
        assert_near(p[0] + .5, 1.2, TOL(2e-5, 1e-8));
    }
}

static int contactsOf(McdModelID m) {
    int count = 0;
    for (MdtContactID c = MdtBodyGetFirstContact(McdModelGetBody(m)); c;
         c = MdtBodyGetNextContact(McdModelGetBody(m), c))
        count++;
    return count;
}

/* A box at rest before the second tile, without gravity, touches the first tile only. When the first tile is destroyed,
 * the second tile's edge becomes an outer edge. */
TEST(an_edge_is_tested_again_when_its_neighbour_goes) {
    universe_begin(&MstUniverseGrowingSizes);
    const Floor f = {.size = 1};
    McdModelID tile[2];
    for (int i = 0; i < 2; i++) {
        placeTile(i, &f);
        tile[i] = MstFixedModelCreate(u, McdBoxCreate(u->frame, 10, 10, 2), tiles[i]);
    }
    const McdModelID m = putBody(BOX, 1, 0);
    McdModelDynamicsSetPosition(m, -.203, 0, .05);
    universe_step(3);
    ck_assert_int_eq(contactsOf(m), 4);
    MstFixedModelDestroy(tile[0]);
    MstUniverseStep(u, 1. / 60);
    MstUniverseStep(u, 1. / 60);
    ck_assert_int_eq(contactsOf(m), 2);
}

/* ---- edges that are nearly parallel to a body -------------------------------------------------------------------- */

enum { WHOLE, TWO_BOXES, TWO_PARTS };

/* One tile, or two that meet at x = 0. */
static void layTiles(int floor) {
    const McdGeometryID tile = McdBoxCreate(u->frame, floor == WHOLE ? 20 : 10, 10, 2);
    const McdAggregateID both = McdAggregateCreate(u->frame, 2);
    const MeVector3 origin = {0, 0, 0};
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMMakeIdentity(tiles[i]);
        MeVector3Set(tiles[i][3], floor == WHOLE ? 0 : i ? 5 : -5, 0, -1);
        McdAggregateAddElement(both, tile, tiles[i]);
        if (floor == TWO_BOXES || (floor == WHOLE && i == 0))
            MstFixedModelCreate(u, tile, tiles[i]);
    }
    if (floor == TWO_PARTS)
        MstFixedModelCreateAt(u, both, origin, NULL);
}

/* m/s: the vertical velocity after a step of a capsule or cylinder that rolls toward the edge at x = 0. It lies along
 * y but for small angles, and touches the floor. */
static double riseOf(int kind, int floor, double speed, double way, double yaw, double tilt) {
    double height;
    MeVector3 v;
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, -10);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), .5, 0);
    layTiles(floor);
    const McdModelID m = MstModelAndBodyCreate(u, makeShape(kind, 1, &height), 1000);
    const double half = (double)ME_PI / 4 + tilt / 2;
    McdModelDynamicsSetPosition(m, -way, 0, height);
    McdModelDynamicsSetQuaternion(m, cos(half) * cos(yaw / 2), sin(half) * cos(yaw / 2), sin(half) * sin(yaw / 2),
                                  cos(half) * sin(yaw / 2));
    McdModelDynamicsSetLinearVelocity(m, speed, 0, 0);
    McdModelDynamicsSetAngularVelocity(m, 0, speed / height, 0);
    MstUniverseStep(u, 1. / 60);
    McdModelDynamicsGetLinearVelocity(m, v);
    return v[2];
}

/* The contact that is nearest to the edge is at it, the other one of the same normal beside it. */
TEST(an_edge_that_is_nearly_parallel_to_a_body_is_not_felt) {
    static const double angles[] = {-3e-3, -3e-4, -1e-4, 0, 1e-4, 1e-3};
    enum { ANGLES = sizeof angles / sizeof *angles };
    for (int i = 0; i < ANGLES * ANGLES; i++)
        for (double way = .01; way < .2; way *= 2.5)
            for (int kind = CYLINDER; kind <= CAPSULE; kind += CAPSULE - CYLINDER) {
                const double yaw = angles[i % ANGLES], tilt = angles[i / ANGLES], speed = 5 + 15 * (i % 3);
                const double rise = riseOf(kind, WHOLE, speed, way, yaw, tilt);
                for (int floor = TWO_BOXES; floor <= TWO_PARTS; floor++)
                    assert_near(riseOf(kind, floor, speed, way, yaw, tilt), rise, TOL(.08, .08));
            }
}
