/* Crowds and published benchmarks, through the bridge: how exact Karma is in those that do not take long, whether they
 * see faults, and whether overlaps are what they should be. */
#include "bounds.h"
#include "karma_test.h"
#include "scenes_i.h"

#ifdef _ME_API_DOUBLE
#define KARMA engine_universe_double
#else
#define KARMA engine_universe_single
#endif

static const SceneBound moved = {"bridge", 1, 0, 1e-5, 1e-9}, gap = {"bridge", 1, 1, 1e-5, 1e-11},
                        rolling = {"sim-rolling-xy", 1, 0, 1e-10, 2e-21},
                        momentum = {"sim-momentum", 1, 0, 5e-11, 5e-26}, hit = {"sim-momentum", 1, 2, 0, 0},
                        bouncing = {"sim-bouncing", 1, 0, 3e-6, 5e-18}, held = {"erez-grasp", 1, 2, 0, 0};

static int countBroken(const SceneBound *b, const Engine *e) {
    return bounds_countBroken(b, 1, e, ENGINE_RIGID);
}

TEST(karma_is_as_accurate_as_it_was) {
    const SceneBound bounds[] = {moved, gap, rolling, momentum, hit, bouncing, held};
    enum { COUNT = sizeof bounds / sizeof *bounds };
    const int broken = bounds_countBroken(bounds, COUNT, &KARMA, ENGINE_RIGID);
    ck_assert_msg(broken == 0, "%d of %d errors are too large", broken, (int)COUNT);
}

/* Karma behind a wrapper that does one thing wrong */

enum { EVERY = 10 };

static int counted; /* steps, or joints, of the world that is simulated now */

static EngineWorld *createCounting(int setting, const double gravity[3], bool collides) {
    counted = 0;
    return KARMA.create(setting, gravity, collides);
}

/* Both of the second plank with the first: one is redundant, since the others hold the planks level across. */
static void dropSecondPlank(EngineWorld *w, const SceneJoint *j) {
    const int number = ++counted;
    if (number != 3 && number != 4)
        KARMA.addJoint(w, j);
}

static void lessenFriction(EngineWorld *w, const SceneBody *b) {
    SceneBody wrong = *b;
    wrong.friction *= .99;
    KARMA.addBody(w, &wrong);
}

/* A box that is pushed is driven on by what should brake it: all of the weight is on it. */
static void driveBox(EngineWorld *w, const SceneBody *b) {
    const double push = sqrt(scene_dot(b->force, b->force)), brake = b->friction * 35 * 9.81;
    SceneBody wrong = *b;
    for (int i = 0; push > 0 && i < 3; i++)
        wrong.force[i] += brake * b->force[i] / push;
    if (push > 0)
        wrong.friction = 0;
    KARMA.addBody(w, &wrong);
}

static void lessenRestitution(EngineWorld *w, const SceneBody *b) {
    SceneBody wrong = *b;
    wrong.restitution *= .999;
    KARMA.addBody(w, &wrong);
}

static void skipTenthStep(EngineWorld *w, double h) {
    if (counted++ % EVERY != EVERY - 1)
        KARMA.step(w, h);
}

static Engine copyOfKarma(void) {
    Engine e = KARMA;
    e.create = createCounting;
    return e;
}

TEST(dropped_joints_are_seen) {
    Engine e = copyOfKarma();
    e.addJoint = dropSecondPlank;
    ck_assert_int_eq(countBroken(&gap, &e), 1);
    ck_assert_int_eq(countBroken(&moved, &e), 1);
}

TEST(wrong_friction_is_seen) {
    Engine e = copyOfKarma();
    e.addBody = lessenFriction;
    ck_assert_int_eq(countBroken(&rolling, &e), 1);
    e.addBody = driveBox;
    ck_assert_int_eq(countBroken(&rolling, &e), 1);
}

TEST(a_thousandth_of_restitution_is_seen) {
    Engine e = copyOfKarma();
    e.addBody = lessenRestitution;
    ck_assert_int_eq(countBroken(&bouncing, &e), 1);
}

TEST(a_skipped_step_is_seen) {
    Engine e = copyOfKarma();
    e.step = skipTenthStep;
    ck_assert_int_eq(countBroken(&rolling, &e), 1);
}

/* A frame's force is not what the step should have had: a ball that is not pushed is not moved. */
TEST(a_force_ends_when_it_should) {
    const SceneBody always = {.force = {0, 1, 0}}, half = {.force = {0, 1, 0}, .forceEnds = .5}, none = {.mass = 1};
    ck_assert(scene_isPushed(&always, 100));
    ck_assert(scene_isPushed(&half, .49) && !scene_isPushed(&half, .5));
    ck_assert(!scene_isPushed(&none, 0));
}

/* Overlaps and inertias of the shapes */

static SceneBody *placed(SceneWorld *w, int shape, double x, double y) {
    if (shape == SCENE_SPHERE)
        return scene_addSphere(w, 1, .5, x, y, 0);
    if (shape == SCENE_CAPSULE)
        return scene_addCapsule(w, 1, .5, 3, x, y, 0);
    return scene_addBox(w, 1, 1, 1, 1, x, y, 0);
}

/* Capsules lie along z: all reach .5 m along x, whichever they are. */
TEST(overlaps_are_those_of_the_shapes) {
    const double right = acos(-1.) / 2;
    for (int a = SCENE_BOX; a <= SCENE_CAPSULE; a++)
        for (int b = SCENE_BOX; b <= SCENE_CAPSULE; b++) {
            SceneWorld w = {.numBodies = 0};
            const SceneBody *p = placed(&w, a, 0, .4), *q = placed(&w, b, .9, .4);
            assert_near(scenes_overlap(p, &p->start, q, &q->start), .1, 1e-12);
            assert_near(scenes_below(p, &p->start), .1, 1e-12);
        }
    SceneWorld w = {.numBodies = 0};
    SceneBody *upright = placed(&w, SCENE_CAPSULE, 0, 1.2), *box = placed(&w, SCENE_BOX, 0, -.6);
    upright->start.quaternion[0] = cos(right / 2);
    upright->start.quaternion[1] = sin(right / 2);
    assert_near(scenes_below(upright, &upright->start), .3, 1e-12);
    assert_near(scenes_overlap(upright, &upright->start, box, &box->start), .2, 1e-7); /* -.3 below, -.1 above */
}

/* A capsule without a cylinder is a ball; a long one is a rod. */
TEST(capsules_have_their_inertia) {
    SceneWorld w = {.numBodies = 0};
    double inertia[3];
    scene_inertia(scene_addCapsule(&w, 2, .5, 1, 0, 0, 0), inertia);
    for (int i = 0; i < 3; i++)
        assert_near(inertia[i], .4 * 2 * .25, 1e-14);
    scene_inertia(scene_addCapsule(&w, 2, 1e-3, 6, 0, 0, 0), inertia);
    assert_near(inertia[0], 2 * 36 / 12., 6e-3); /* but for r / l */
    assert_near(inertia[2], 2 * 1e-6 / 2, 1e-9);
}
