/* The corners of the map of stability: Karma holds there with the map's longest step. */
#include "karma_test.h"
#include "run.h"
#include "scene.h"

#include <math.h>

#ifdef _ME_API_DOUBLE
#define KARMA &engine_karma_double
#else
#define KARMA &engine_karma_single
#endif

static void assert_holds(const Scene *map, double parameter, int count) {
    Scene cell = *map;
    cell.parameter = parameter;
    cell.count = count;
    const RunResult run = run_scene(&cell, KARMA, ENGINE_RIGID, 1, INFINITY);
    ck_assert_msg(run.outcome == RUN_HOLDS, "%s, parameter %g, %d bodies: fails after %g s, errors %g %g", map->name,
                  parameter, count, run.simulated, run.errors[0], run.errors[1]);
}

static void assert_corners_hold(const Scene *map, double parameter, int count) {
    assert_holds(map, 1, 2);
    assert_holds(map, 1, count);
    assert_holds(map, parameter, 2);
    assert_holds(map, parameter, count);
}

TEST(chains_hold_any_mass) {
    assert_corners_hold(&scenes_mapChain, 1e6, 60);
}

TEST(towers_hold_any_mass) {
    assert_corners_hold(&scenes_mapTower, 1e6, 20);
}

TEST(beams_hold_on_springs_of_any_stiffness) {
    assert_corners_hold(&scenes_mapBeam, 1e5, 60);
}
