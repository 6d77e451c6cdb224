/* The warning that a world has no gravity: when it is given, and by what it is not. */
#include "scene.h"

static MdtWorldID w;
static MdtBodyID body;

static void setUp(void) {
    w = MdtWorldCreate(8, 8);
    body = MdtBodyCreate(w);
    MdtBodyEnable(body);
}

static void tearDown(void) {
    MdtWorldDestroy(w);
}
TEST_FIXTURE(setUp, tearDown)

static void run(int steps) {
    for (int i = 0; i < steps; i++)
        MdtWorldStep(w, FRAME);
}

#if KARMA_CHECK
/* The first step tells where bodies are, and a second of 60 steps is over after 60 more at the latest. */
TEST(it_is_told_once_after_a_second) {
    run(59);
    assert_silent();
    run(3);
    ck_assert_int_eq(caught.warnings, 1);
    assert_warned("MdtWorldSetGravity");
    run(200);
}

TEST(each_world_is_told_of) {
    run(70);
    assert_warned("no gravity");
    MdtWorldID other = MdtWorldCreate(1, 0);
    MdtBodyEnable(MdtBodyCreate(other));
    for (int i = 0; i < 70; i++)
        MdtWorldStep(other, FRAME);
    assert_warned("no gravity");
    MdtWorldDestroy(other);
}

/* A body that comes later, or is put elsewhere, begins the second anew. */
TEST(the_second_is_one_in_which_the_program_does_nothing) {
    run(40);
    MdtBodySetPosition(body, 1, 2, 3);
    run(40);
    MdtBodyEnable(MdtBodyCreate(w));
    run(59);
    assert_silent();
    run(3);
    assert_warned("no gravity");
}
#endif

static void noGravityIsMeant(void) {
    MdtWorldSetGravity(w, 0, 0, 0);
}

static void moves(void) {
    MdtBodySetLinearVelocity(body, 1, 0, 0);
}

static void turns(void) {
    MdtBodySetAngularVelocity(body, 0, 0, 1);
}

static void isPushed(void) {
    MdtBodyAddForce(body, 0, 1, 0);
}

static void isHit(void) {
    MdtBodyAddImpulse(body, 0, 1, 0);
}

static void isHeld(void) {
    MdtBSJointID joint = MdtBSJointCreate(w);
    MdtBSJointSetBodies(joint, body, 0);
    MdtBSJointEnable(joint);
}

static void isDisabled(void) {
    MdtBodyDisable(body);
}

static void isDestroyed(void) {
    MdtBodyDestroy(body);
}

LOOP_TEST(where_something_acts_it_is_silent, 0, 8) {
    void (*const ways[])(void) = {noGravityIsMeant, moves, turns, isPushed, isHit, isHeld, isDisabled, isDestroyed};
    ways[_i]();
    run(200);
}

/* As a program does that has collision alone, or plays an animation. */
TEST(a_body_that_the_program_moves_is_no_mistake) {
    for (int i = 0; i < 200; i++) {
        MdtBodySetPosition(body, i * 0.01, 0, 0);
        run(1);
    }
}
