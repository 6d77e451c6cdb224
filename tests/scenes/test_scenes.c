/* The scenes' right answers, their contacts, and Karma in them: so that what bench stands on cannot rot. */
#include "karma_test.h"
#include "reference.h"
#include "run.h"

#ifdef _ME_API_DOUBLE
#define KARMA &engine_karma_double
#else
#define KARMA &engine_karma_single
#endif

static const double pi = 3.14159265358979323846;

static const Scene *find(const char *name) {
    const Scene *s = scene_find(name);
    ck_assert_msg(s != NULL, "no scene '%s'", name);
    return s;
}

static RunResult run(const char *scene, int substeps) {
    const RunResult r = run_scene(find(scene), KARMA, 0, substeps, 1e9);
    ck_assert_msg(r.outcome == RUN_HOLDS, "%s with %d sub-steps fails after %g s", scene, substeps, r.simulated);
    return r;
}

/* The right answers */

START_TEST(pendulum_periods_are_the_elliptic_integral) {
    assert_near_rel(reference_pendulumPeriod(1e-6, 2), pi, 1e-12);
    /* K(1/sqrt 2) = 1.85407467730137 */
    assert_near_rel(reference_pendulumPeriod(pi / 2, 1), 4 * 1.85407467730137, 1e-14);
    assert_near_rel(reference_pendulumPeriod(pi / 3, 1), 2 * pi * 1.07318200714936, 1e-14);
}
END_TEST

START_TEST(tumbling_flips_when_the_literature_says) {
    const double inertia[3] = {.4 / 12, 1.04 / 12, 1.36 / 12}, spin[3] = {.01, 5, 0};
    const ReferenceTumbling r = reference_tumbling(inertia, spin, 60);
    ck_assert_int_eq(r.flips, 12);
    assert_near(r.firstFlip, 2.4543, 5e-5);
    assert_near(r.energy, 0, 1e-12);
}
END_TEST

START_TEST(slides_and_rolls_are_the_closed_forms) {
    const double along = 9.81 * sin(atan(.5)), across = 9.81 * cos(atan(.5));
    assert_near(reference_slide(along, across, .3, 2), 3.509732, 1e-6);
    assert_near(reference_slide(along, across, .45, 2), .877433, 1e-6);
    assert_near(reference_slide(along, across, .55, 2), 0, 0);
    assert_near(reference_rollingSpeed(10), 7.142857, 1e-6);
    assert_near(reference_rollingDistance(10, .3, 9.81, 2), 15.672610, 1e-6);
    assert_near(reference_rollingDistance(10, .3, 9.81, .5), 10 * .5 - .3 * 9.81 * .125, 1e-12);
}
END_TEST

/* The worlds */

START_TEST(every_scene_starts_joined_and_is_measured_as_it_starts) {
    for (int i = 0; scenes[i]; i++) {
        SceneWorld w = {.numBodies = 0};
        SceneState states[SCENE_MAX_BODIES];
        SceneTrace t = {.isDone = false};
        scenes[i]->build(scenes[i], &w);
        ck_assert_int_gt(w.numBodies, 0);
        ck_assert_int_le(w.numBodies, SCENE_MAX_BODIES);
        for (int b = 0; b < w.numBodies; b++)
            states[b] = w.bodies[b].start;
        assert_below(scene_gap(&w, states), 1e-14);
        t.energy = scene_startEnergy(&w);
        scenes[i]->observe(&t, &w, states, 0);
        for (int k = 0; k < SCENE_MAX_ERRORS && scenes[i]->errors[k].name && strcmp(scenes[i]->name, "rolling"); k++)
            assert_below(t.worst[k], 1e-12);
    }
}
END_TEST

START_TEST(gaps_and_energies_are_those_of_the_states) {
    SceneWorld w = {.numBodies = 0};
    SceneState states[SCENE_MAX_BODIES];
    find("chain-level")->build(find("chain-level"), &w);
    for (int b = 0; b < w.numBodies; b++)
        states[b] = w.bodies[b].start;
    const double before = scene_energy(&w, states);
    states[4].position[1] += .25;
    states[4].velocity[0] = 3;
    states[4].spin[1] = 2;
    assert_near(scene_gap(&w, states), .25, 1e-14);
    /* m g y + m v² / 2 + I w² / 2, I = m (.5² + .1²) / 12 */
    assert_near(scene_energy(&w, states) - before, 9.81 * .25 + 4.5 + .26 / 12 * 2, 1e-10);
    states[4] = w.bodies[4].start;
    states[4].quaternion[0] = 0; /* half a turn about z swaps the two ends */
    states[4].quaternion[3] = 1;
    assert_near(scene_gap(&w, states), .5, 1e-14);
}
END_TEST

/* Contacts */

/* Two cubes of 1 m, the upper one moved and turned about y. */
static int stackContacts(double x, double y, double turn, SceneContact contacts[]) {
    SceneWorld w = {.numBodies = 0};
    scene_addBox(&w, 1, 1, 1, 1, 0, 10, 0)->friction = .3;
    SceneBody *upper = scene_addBox(&w, 1, 1, 1, 1, x, 10 + y, 0);
    upper->friction = .5;
    upper->start.quaternion[0] = cos(turn / 2);
    upper->start.quaternion[2] = sin(turn / 2);
    const SceneState states[2] = {w.bodies[0].start, w.bodies[1].start};
    return scene_contacts(&w, states, SCENE_FRAME, contacts);
}

START_TEST(faces_meet_where_they_overlap) {
    SceneContact c[SCENE_MAX_CONTACTS];
    ck_assert_int_eq(stackContacts(.25, .999, 0, c), 4);
    for (int i = 0; i < 4; i++) {
        assert_near(c[i].depth, .001, 1e-12);
        assert_near(c[i].friction, .5, 0);
        /* the normal pushes the first body away from the other */
        assert_vec3_near(c[i].normal, 0, c[i].body == 1 ? 1 : -1, 0, 1e-12);
        assert_near(fabs(c[i].point[0] - .125), .375, 2e-6);
        assert_near(fabs(c[i].point[2]), .5, 2e-6);
    }
    ck_assert_int_eq(stackContacts(0, 1, pi / 4, c), 8);
    ck_assert_int_eq(stackContacts(0, 1.1, 0, c), 0);
    ck_assert_int_eq(stackContacts(1.1, .9, 0, c), 0);
}
END_TEST

START_TEST(corners_and_spheres_meet_the_ground) {
    SceneContact c[SCENE_MAX_CONTACTS];
    SceneWorld w = {.numBodies = 0};
    scene_addBox(&w, 1, 1, 2, 3, 0, .99, 0);
    scene_addSphere(&w, 1, .5, 9, .501, 0);
    scene_addSphere(&w, 1, .5, 9, .6, 5)->start.velocity[1] = -12;
    scene_addSphere(&w, 1, .5, 9, .6, 9);
    const SceneState states[4] = {w.bodies[0].start, w.bodies[1].start, w.bodies[2].start, w.bodies[3].start};
    ck_assert_int_eq(scene_contacts(&w, states, SCENE_FRAME, c), 6);
    for (int i = 0; i < 6; i++) {
        ck_assert_int_eq(c[i].body, i < 4 ? 0 : i - 3);
        assert_near(c[i].depth, i < 4 ? .01 : i == 4 ? -.001 : -.1, 1e-12);
        assert_vec3_near(c[i].normal, 0, 1, 0, 0);
    }
}
END_TEST

/* A run tells what breaks: an engine that loses its numbers, and one in which nothing moves. */

static double stillY;
static int stillBodies;

static EngineWorld *stillCreate(int setting, const double gravity[3], bool collides) {
    (void)setting, (void)gravity, (void)collides;
    stillBodies = 0;
    return NULL;
}
static void stillAddBody(EngineWorld *w, const SceneBody *b) {
    (void)w, (void)b;
    stillBodies++;
}
static void stillAddJoint(EngineWorld *w, const SceneJoint *j) {
    (void)w, (void)j;
}
static void stillStep(EngineWorld *w, double h) {
    (void)w, (void)h;
}
static void stillGetState(EngineWorld *w, int body, SceneState *s) {
    (void)w, (void)body;
    *s = (SceneState){.position = {1, stillY, 0}, .quaternion = {1}};
}
static void stillDestroy(EngineWorld *w) {
    (void)w;
}

START_TEST(a_run_tells_what_breaks) {
    const Engine still = {.create = stillCreate,
                          .addBody = stillAddBody,
                          .addJoint = stillAddJoint,
                          .step = stillStep,
                          .getState = stillGetState,
                          .destroy = stillDestroy};
    stillY = 0;
    RunResult r = run_scene(find("pendulum"), &still, 0, 1, 1e9);
    ck_assert_int_eq(stillBodies, 1);
    ck_assert_int_eq(r.outcome, RUN_HOLDS);
    ck_assert(isinf(r.errors[0]));
    assert_near(r.errors[1], 0, 0);
    stillY = NAN;
    r = run_scene(find("pendulum"), &still, 0, 1, 1e9);
    ck_assert_int_eq(r.outcome, RUN_FAILS);
    assert_near(r.simulated, SCENE_FRAME, 1e-12);
    stillY = 0;
    r = run_scene(find("pendulum"), &still, 0, 1, -1);
    ck_assert_int_eq(r.outcome, RUN_TIMES_OUT);
    ck_assert(!run_isPossible(find("bounce"), &still) && run_isPossible(find("pendulum"), &still));
}
END_TEST

/* Karma, as accurate as it is today */

START_TEST(pendulums_keep_time_at_second_order) {
    const char *const names[] = {"pendulum", "hinge"};
    for (int i = 0; i < 2; i++) {
        const RunResult once = run(names[i], 1), fourTimes = run(names[i], 4);
        assert_below(once.errors[0], 3.3e-4);
        assert_below(fourTimes.errors[0], 2.1e-5);
        assert_below(once.errors[1], .03);
        assert_below(fourTimes.errors[1], .0075);
        assert_below(once.errors[2], TOL(3e-7, 2e-10));
    }
}
END_TEST

START_TEST(a_chain_keeps_together) {
    const RunResult r = run("chain-10", 1);
    assert_below(r.errors[0], TOL(4e-6, 1e-11));
    assert_below(r.errors[1], 2e-3);
}
END_TEST

START_TEST(tumbling_keeps_its_energy_and_its_flips) {
    const RunResult r = run("tumbling", 1);
    assert_below(r.errors[0], TOL(5e-7, 2e-10));
    assert_below(r.errors[1], 2e-6);
    assert_near(r.errors[2], 0, 0);
}
END_TEST

START_TEST(a_projectile_is_off_by_half_a_step_of_gravity) {
    assert_near(run("projectile", 1).errors[0], 9.81 * SCENE_FRAME * 5 / 2, TOL(1e-4, 1e-9));
}
END_TEST

START_TEST(heavy_rests_on_light) {
    const char *const names[] = {"heavy-100", "heavy-1e4", "heavy-1e6"};
    for (int i = 0; i < 3; i++) {
        const RunResult r = run(names[i], 1);
        assert_below(r.errors[1], TOL(2e-7, 1e-11));
        assert_below(r.errors[2], 1e-9);
    }
}
END_TEST

START_TEST(friction_holds_lets_slide_and_rolls) {
    const RunResult slope = run("incline", 1), ball = run("rolling", 1);
    assert_below(slope.errors[0], .03);
    assert_below(slope.errors[1], 1e-12);
    assert_below(slope.errors[2], 1e-9);
    assert_below(ball.errors[0], TOL(1e-7, 1e-13));
    assert_below(ball.errors[1], 1.6e-3);
}
END_TEST

START_TEST(balls_bounce) {
    const RunResult r = run("bounce", 1);
    assert_below(r.errors[0], 1e-4);
    assert_below(r.errors[1], .03);
    assert_below(r.errors[2], .1);
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, pendulum_periods_are_the_elliptic_integral);
    tcase_add_test(t, tumbling_flips_when_the_literature_says);
    tcase_add_test(t, slides_and_rolls_are_the_closed_forms);
    tcase_add_test(t, every_scene_starts_joined_and_is_measured_as_it_starts);
    tcase_add_test(t, gaps_and_energies_are_those_of_the_states);
    tcase_add_test(t, faces_meet_where_they_overlap);
    tcase_add_test(t, corners_and_spheres_meet_the_ground);
    tcase_add_test(t, a_run_tells_what_breaks);
    tcase_add_test(t, pendulums_keep_time_at_second_order);
    tcase_add_test(t, a_chain_keeps_together);
    tcase_add_test(t, tumbling_keeps_its_energy_and_its_flips);
    tcase_add_test(t, a_projectile_is_off_by_half_a_step_of_gravity);
    tcase_add_test(t, heavy_rests_on_light);
    tcase_add_test(t, friction_holds_lets_slide_and_rolls);
    tcase_add_test(t, balls_bounce);
}
TEST_MAIN("scenes", tests)
