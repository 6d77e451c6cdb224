/* The scenes' right answers, their contacts, and Karma in them: so that what bench stands on cannot rot. */
#include "bounds.h"
#include "karma_test.h"
#include "reference.h"
#include "run.h"
#include "scenes_i.h"

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

/* The right answers */

TEST(pendulum_periods_are_the_elliptic_integral) {
    assert_near_rel(reference_pendulumPeriod(1e-6, 2), pi, 1e-12);
    /* K(1/sqrt 2) = 1.85407467730137 */
    assert_near_rel(reference_pendulumPeriod(pi / 2, 1), 4 * 1.85407467730137, 1e-14);
    assert_near_rel(reference_pendulumPeriod(pi / 3, 1), 2 * pi * 1.07318200714936, 1e-14);
}

TEST(tumbling_flips_when_the_literature_says) {
    const double inertia[3] = {.4 / 12, 1.04 / 12, 1.36 / 12}, spin[3] = {.01, 5, 0};
    const ReferenceTumbling r = reference_tumbling(inertia, spin, 60);
    ck_assert_int_eq(r.flips, 12);
    assert_near(r.firstFlip, 2.4543, 5e-5);
    assert_near(r.energy, 0, 1e-12);
}

TEST(slides_and_rolls_are_the_closed_forms) {
    const double along = 9.81 * sin(atan(.5)), across = 9.81 * cos(atan(.5));
    assert_near(reference_slide(along, across, .3, 2), 3.509732, 1e-6);
    assert_near(reference_slide(along, across, .45, 2), .877433, 1e-6);
    assert_near(reference_slide(along, across, .55, 2), 0, 0);
    assert_near(reference_stop(3, .45, 9.81), 1.019368, 1e-6);
    assert_near(reference_rollingSpeed(10, 0), 7.142857, 1e-6);
    assert_near(reference_rollingDistance(10, 0, .3, 9.81, 2), 15.672610, 1e-6);
    assert_near(reference_rollingDistance(10, 0, .3, 9.81, .5), 10 * .5 - .3 * 9.81 * .125, 1e-12);
    assert_near(reference_rollingSpeed(10, -20), 1.428571, 1e-6);
    assert_near(reference_rollingDistance(10, -20, .3, 9.81, 4), 18.196343, 1e-6);
    /* one that spins too fast is pushed on; 5 v + 2 r w = 7 v at the end */
    assert_near(reference_rollingSpeed(0, 7), 2, 1e-12);
    assert_near(reference_rollingDistance(0, 7, .3, 9.81, .5), .3 * 9.81 * .125, 1e-12);
}

TEST(blocks_topple_when_they_must) {
    ck_assert(!reference_topples(.25, .5, 3, .45, 9.81));
    ck_assert(!reference_topples(.25, .5, 3, .51, 9.81)); /* it rocks, by .38 of the .46 rad that it needs */
    ck_assert(reference_topples(.25, .5, 3, .52, 9.81));
    ck_assert(reference_topples(.25, .5, 3, .55, 9.81));
    ck_assert(!reference_topples(.25, .5, .5, .55, 9.81)); /* too slow: 1/8 J a kg, and it needs .58 */
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Of a disc of 1 kg that has gone round by an angle: its centre, from the middle, and its momentum about that. */
static void discAt(const ReferenceDisc *d, double rate, double angle, double centre[3], double momentum[3]) {
    const double out[3] = {cos(angle), 0, -sin(angle)}, c = cos(d->lean), s = sin(d->lean);
    double axis[3], spin[3];
    for (int i = 0; i < 3; i++) {
        const double up = i == 1, e = c * up - s * out[i];
        axis[i] = s * up + c * out[i];
        spin[i] = rate * up - rate * d->circle / d->radius * axis[i];
        centre[i] = d->circle * out[i] + d->radius * e + d->halfWidth * axis[i];
    }
    const double about = scene_dot(spin, axis);
    for (int i = 0; i < 3; i++)
        momentum[i] = d->across * spin[i] + (d->along - d->across) * about * axis[i];
}

/* Euler's laws by differences: what pushes the centre round is the ground's force, and its moment about the centre
 * turns the momentum. */
TEST(a_rolling_disc_goes_round_as_its_momentum_asks) {
    static const double h = 1e-3;
    static const ReferenceDisc discs[] = {{.5, .05, .125, .0633, pi / 6, 1.5}, {.1, .001, .005, .0025, 1.2, .3}};
    for (int k = 0; k < 2; k++) {
        const ReferenceDisc *d = &discs[k];
        const double rate = reference_rollingDisc(d, 9.81);
        double centre[3][3], momentum[3][3], force[3], arm[3], moment[3];
        for (int i = 0; i < 3; i++)
            discAt(d, rate, (i - 1) * h, centre[i], momentum[i]);
        for (int i = 0; i < 3; i++) {
            force[i] = (centre[0][i] - 2 * centre[1][i] + centre[2][i]) * rate * rate / (h * h) + 9.81 * (i == 1);
            arm[i] = d->circle * (i == 0) - centre[1][i];
        }
        cross(arm, force, moment);
        for (int i = 0; i < 3; i++)
            assert_near(moment[i], (momentum[2][i] - momentum[0][i]) * rate / (2 * h), 1e-5);
    }
}

/* What a top keeps: its energy, its momentum about the upright and about its axis, and the length of that axis. One
 * that is upright stays so, and one that leans goes round slowly at m g l / L, with a ripple (Omega/nutation)². */
TEST(tops_keep_what_they_must_and_go_round_as_they_must) {
    const double across = .0134, weight = .981, lean = .5, momentum = 5;
    double y[6] = {sin(lean), cos(lean), 0, momentum * sin(lean), momentum * cos(lean), 0};
    const double twice = momentum * momentum / across + 2 * weight * cos(lean), upright = y[4];
    reference_top(y, across, weight, 3);
    assert_near(scene_dot(y, y), 1, 1e-12);
    assert_near(scene_dot(y, y + 3), momentum, 1e-11);
    assert_near(y[4], upright, 1e-12);
    assert_near(scene_dot(y + 3, y + 3) / across + 2 * weight * y[1], twice, 1e-8);
    const double slow = weight / momentum, nutation = momentum / across;
    assert_near(atan2(-y[5], y[3]), slow * 3, 10 * slow / nutation);
    double up[6] = {0, 1, 0, 0, momentum, 0};
    reference_top(up, across, weight, 3);
    assert_near(up[1], 1, 0);
}

/* Whether steps of 50 us are fine enough for a top like the scene's: one long span against many short ones, whose steps
 * are half as long. */
TEST(tops_are_integrated_until_they_converge) {
    double coarse[6] = {.6, .8, 0, .4, .5, .2}, fine[6] = {.6, .8, 0, .4, .5, .2};
    reference_top(coarse, .0134, .981, 5);
    for (int i = 0; i < 200000; i++)
        reference_top(fine, .0134, .981, 2.5e-5);
    for (int i = 0; i < 6; i++)
        assert_near(coarse[i], fine[i], 5e-11); /* (omega h)^5 / 120 a step, omega = 50 */
}

/* The worlds */

TEST(every_scene_starts_joined_and_is_measured_as_it_starts) {
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
        for (int k = 0; k < SCENE_MAX_ERRORS && scenes[i]->errors[k].name; k++)
            assert_below(t.worst[k], 1e-12);
    }
}

TEST(gaps_and_energies_are_those_of_the_states) {
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

/* There is room for the teeth to both sides all the time, and never for a whole tooth: over a tooth of the small wheel,
 * by steps of 1/100. They start in the middle of a gap, so what is free turns to the other side with the wheels. */
TEST(gears_have_room_and_cannot_skip) {
    const double teeth = 2 * pi / 12;
    for (int i = 0; i < 100; i++)
        for (int side = -1; side < 2; side += 2) {
            const double play = scenes_gearPlay(i * teeth / 100, side);
            ck_assert(play > .02 && play < .05); /* of .26 rad */
            assert_near(scenes_gearPlay((i + 100) * teeth / 100, side), play, 1e-9);
            assert_near(scenes_gearPlay(-i * teeth / 100, -side), play, 1e-9);
        }
}

/* Wheels touch the ground where a car starts; the slope is one plane, its heights without rounding. */
TEST(terrain_lies_under_the_wheels) {
    const char *const names[] = {"terrain-roll", "terrain-car"};
    for (int n = 0; n < 2; n++) {
        static SceneWorld w;
        w = (SceneWorld){.numBodies = 0};
        find(names[n])->build(find(names[n]), &w);
        const SceneTerrain *t = &w.terrain;
        ck_assert_int_le(t->xCount * t->zCount, SCENE_MAX_HEIGHTS);
        const double slope = n == 0 ? .125 : 0, upright = 1 / sqrt(1 + slope * slope);
        for (int i = 0; i < t->xCount && t->x0 + i * t->step <= 2; i++)
            for (int k = 0; k < t->zCount; k++)
                assert_near(t->heights[k * t->xCount + i], -slope * (t->x0 + i * t->step), 0);
        for (int i = 2; i < w.numBodies; i++) {
            const double *at = w.bodies[i].start.position;
            assert_near((at[1] + slope * at[0]) * upright, w.bodies[i].half[0], 1e-14);
        }
    }
}

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

TEST(faces_meet_where_they_overlap) {
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

TEST(corners_and_spheres_meet_the_ground) {
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

TEST(spheres_meet_where_they_touch) {
    SceneContact c[SCENE_MAX_CONTACTS];
    SceneWorld w = {.numBodies = 0};
    scene_addSphere(&w, 1, .5, 0, 9, 0)->restitution = .5;
    scene_addSphere(&w, 1, .25, .6, 9, .45)->restitution = .75; /* 3-4-5 */
    scene_addSphere(&w, 1, .25, .6, 9, -.48);
    const SceneState states[3] = {w.bodies[0].start, w.bodies[1].start, w.bodies[2].start};
    ck_assert_int_eq(scene_contacts(&w, states, SCENE_FRAME, c), 1);
    ck_assert_int_eq(c[0].body, 0);
    ck_assert_int_eq(c[0].other, 1);
    assert_near(c[0].depth, 0, 1e-15);
    assert_near(c[0].restitution, .75, 0);
    assert_vec3_near(c[0].normal, -.8, 0, -.6, 1e-15);
    assert_vec3_near(c[0].point, .4, 9, .3, 1e-15);
}

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

TEST(a_run_tells_what_breaks) {
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
    ck_assert(run_lack(find("bounce"), &still, 0) != NULL && run_lack(find("pendulum"), &still, 0) == NULL);
}

/* Karma: what it reaches today, one line for each error that is asserted. The goals are in the scenes. */

/* Those of a scene with the same sub-steps stand together, and are of one run. They are the goals, or better. */
static const SceneBound bounds[] = {
    {"pendulum", 1, 0, 3.2e-4, 3.2e-4},
    {"pendulum", 1, 1, 3e-7, 1e-9},
    {"pendulum", 1, 2, 1e-4, 1e-4},
    {"pendulum", 2, 0, 1e-4, 1e-4},
    {"pendulum", 2, 2, 1e-4, 1e-4},
    {"pendulum", 4, 0, 2.1e-5, 2.1e-5},
    {"hinge", 1, 0, 4.5e-4, 4.5e-4},
    {"hinge", 1, 1, 3e-7, 1e-9},
    {"hinge", 1, 2, 1e-4, 1e-4},
    {"hinge", 2, 0, 1.2e-4, 1.2e-4},
    {"hinge", 4, 0, 3e-5, 3e-5},
    {"top", 1, 0, .01, .01},
    {"top", 1, 1, 1e-5, 1e-6},
    {"top", 1, 2, 1e-6, 1e-8},
    {"chain-10", 1, 0, 1e-5, 1e-8},
    {"chain-10", 1, 1, .01, .01},
    {"chain-100", 1, 0, 1e-5, 1e-8},
    {"chain-100", 1, 1, .01, .01},
    {"chain-1000", 1, 0, 1e-5, 1e-8},
    {"chain-1000", 1, 1, .01, .01},
    {"chain-1e5", 1, 0, 1e-5, 1e-7},
    {"chain-1e5", 1, 1, .01, .01},
    {"chain-100-links", 1, 0, 2e-5, 1e-7}, /* in single precision positions are rounded to 4e-6 at 50 m */
    {"chain-100-links", 1, 1, .01, .01},
    {"chain-level", 1, 0, 1e-5, 1e-7},
    {"chain-level", 1, 1, .01, .01},
    {"chain-level-1000", 1, 0, 1e-5, 1e-7},
    {"chain-level-1000", 1, 1, .01, .01},
    {"tumbling", 1, 0, 5e-7, 1e-9},
    {"tumbling", 1, 1, 1e-6, 1e-3},
    {"tumbling", 1, 2, 0, 0},
    {"projectile", 1, 0, 2e-4, 1e-11},
    {"heavy-100", 1, 1, 1e-6, 1e-6},
    {"heavy-100", 1, 2, 1e-9, 1e-9},
    {"heavy-1e4", 1, 1, 1e-6, 1e-6},
    {"heavy-1e4", 1, 2, 1e-9, 1e-9},
    {"heavy-1e6", 1, 1, 1e-6, 1e-6},
    {"heavy-1e6", 1, 2, 1e-9, 1e-9},
    {"tower", 1, 0, 2e-6, 1e-8},
    {"tower", 1, 1, 1e-6, 1e-8},
    {"tower-shaken", 1, 0, 0, 0},
    {"tower-shaken", 1, 1, 2.5e-5, 1e-8}, /* 20 contacts that rest within the rounding of places up to 20 m high */
    {"tower-shaken", 1, 2, 2e-6, 1e-7},
    {"incline", 1, 0, 1e-5, 1e-9},
    {"incline", 1, 1, 1e-9, 1e-11},
    {"incline", 1, 2, 1e-9, 1e-8},
    {"isotropy", 1, 0, 1e-6, 1e-10},
    {"isotropy", 1, 1, 1e-3, 1e-8},
    {"rolling", 1, 0, 2e-6, 1e-8},
    {"rolling", 1, 1, 1e-6, 1e-8},
    {"backspin", 1, 0, 1e-5, 1e-6},
    {"backspin", 1, 1, 1e-5, 1e-6},
    {"block", 1, 0, 1e-5, 1e-8},
    {"block", 1, 1, 1e-6, 1e-8},
    {"block", 1, 2, 0, 0},
    {"bounce", 1, 0, 1e-5, 1e-10},
    {"bounce", 1, 1, 1e-4, 1e-10},
    {"bounce", 1, 2, 1e-4, 1e-10},
    {"sim-energy", 1, 0, 5e-8, 2e-11},
    {"sim-energy", 1, 1, 1e-5, 1e-9},
    {"erez-chain", 1, 0, 2e-3, 2e-3},
    {"erez-chain", 1, 1, 3e-6, 2e-9},
    {"cradle", 1, 0, 1e-6, 1e-12},
    {"cradle", 1, 1, 1e-6, 1e-12},
    {"cradle", 1, 2, 1e-6, 1e-12},
};
enum { BOUNDS = sizeof bounds / sizeof *bounds };

/* Joints in loops, with redundant rows: every step is exact, and none contradict each other, by Karma's own report. */
static const SceneBound loops[] = {
    {"linkage", 1, 0, 1e-6, 3e-11},
    {"linkage", 1, 1, 1.5e-6, 3e-13},
    {"linkage", 1, 2, 0, 0},
    {"led-arm", 1, 0, 1.5e-6, 1e-11},
    {"led-arm", 1, 1, 6e-7, 5e-10},
#ifndef TEST_IS_SLOW
    {"ring", 1, 0, 3e-6, 5e-10},
    {"ring", 1, 1, 2e-3, 2e-3},
#endif
    {"slack-bridge", 1, 0, 1.7e-5, 2e-10},
    /* rounding of places 8 m from the origin */ {"slack-bridge", 1, 1, 1e-3, 1e-3},
};
enum { LOOPS = sizeof loops / sizeof *loops };

TEST(loops_of_joints_hold_and_agree) {
    const int broken = bounds_countBroken(loops, LOOPS, KARMA, ENGINE_STRICT);
    ck_assert_msg(broken == 0, "%d of %d errors are too large", broken, LOOPS);
}

TEST(karma_is_as_accurate_as_it_was) {
    const int broken = bounds_countBroken(bounds, BOUNDS, KARMA, 0);
    ck_assert_msg(broken == 0, "%d of %d errors are too large", broken, BOUNDS);
}

TEST(runs_are_alike) {
    const char *const names[] = {"block", "isotropy", "cradle"};
    for (int i = 0; i < 3; i++) {
        const RunResult a = run_scene(find(names[i]), KARMA, 0, 2, 1e9),
                        b = run_scene(find(names[i]), KARMA, 0, 2, 1e9);
        ck_assert_int_eq(memcmp(a.errors, b.errors, sizeof a.errors), 0);
    }
}
