/* Floors of tiles: what slides over a seam between two fixed boxes does not notice it, and a step stops it. */
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

static void tests(TCase *t) {
    tcase_add_test(t, a_seam_between_fixed_boxes_is_not_felt);
    tcase_add_test(t, a_step_of_a_thousandth_of_the_size_stops_a_box);
    tcase_add_test(t, what_is_flush_to_a_ten_thousandth_of_its_radius_passes);
}

TEST_MAIN("Seams", tests)
