/* Do the scenes see faults? Karma behind a wrapper that does one thing wrong: each fault turns a bound red that holds
 * without it. */
#include "bounds.h"
#include "karma_test.h"
#include "scenes_i.h"

#ifdef _ME_API_DOUBLE
#define KARMA engine_karma_double
#else
#define KARMA engine_karma_single
#endif

enum { EVERY = 10 };

static int counted; /* steps, or joints, of the world that is simulated now */

static double weight; /* N a kg, on the ground */

static EngineWorld *createCounting(int setting, const double gravity[3], bool collides) {
    counted = 0;
    weight = -gravity[1];
    return KARMA.create(setting, gravity, collides);
}

/* The faults */

/* Friction of the wrong sign, of bodies that slide along x: the contacts have none, and a force drives them on. */
static void driveBody(EngineWorld *w, const SceneBody *b) {
    SceneBody wrong = *b;
    wrong.force[0] += b->friction * b->mass * weight;
    KARMA.addBody(w, &wrong);
}

static void removeFriction(EngineWorld *w, const SceneContact contacts[], int n) {
    SceneContact wrong[SCENE_MAX_CONTACTS];
    for (int i = 0; i < n; i++) {
        wrong[i] = contacts[i];
        wrong[i].friction = 0;
    }
    KARMA.setContacts(w, wrong, n);
}

static void lessenFriction(EngineWorld *w, const SceneContact contacts[], int n) {
    SceneContact wrong[SCENE_MAX_CONTACTS];
    for (int i = 0; i < n; i++) {
        wrong[i] = contacts[i];
        wrong[i].friction = .99 * contacts[i].friction;
    }
    KARMA.setContacts(w, wrong, n);
}

/* Of the last pair, which then stands on an edge; on three corners a cube stands as well as on four. */
static void dropTwoContacts(EngineWorld *w, const SceneContact contacts[], int n) {
    KARMA.setContacts(w, contacts, n > 2 ? n - 2 : 0);
}

static void dropEveryTenthContacts(EngineWorld *w, const SceneContact contacts[], int n) {
    KARMA.setContacts(w, contacts, counted++ % EVERY == EVERY - 1 ? 0 : n);
}

static void dropThirdJoint(EngineWorld *w, const SceneJoint *j) {
    if (++counted != 3)
        KARMA.addJoint(w, j);
}

static void skipTenthStep(EngineWorld *w, double h) {
    if (counted++ % EVERY != EVERY - 1)
        KARMA.step(w, h);
}

static void stepLonger(EngineWorld *w, double h) {
    KARMA.step(w, 1.001 * h);
}

static Engine copyOfKarma(void) {
    Engine e = KARMA;
    e.create = createCounting;
    return e;
}

/* How many bounds of a scene are broken. */
static int countBroken(const SceneBound *b, const Engine *e) {
    return bounds_countBroken(b, 1, e, ENGINE_RIGID);
}

static const SceneBound slide = {"incline", 1, 0, 1e-5, 1e-9}, stick = {"incline", 1, 1, 1e-9, 1e-11},
                        creep = {"isotropy", 1, 0, 1e-6, 1e-10}, sink = {"tower", 1, 0, 2e-6, 1e-8},
                        chainGap = {"chain-10", 1, 0, 1e-5, 1e-8}, period = {"pendulum", 1, 0, 3.2e-4, 3.2e-4},
                        way = {"block", 1, 0, 1e-5, 1e-8}, flip = {"tumbling", 1, 1, 1e-6, 1e-3},
                        overlap = {"heavy-1e6", 1, 1, 1e-6, 1e-6}, top = {"bounce", 1, 0, 1e-5, 1e-10};

TEST(without_a_fault_all_bounds_hold) {
    const SceneBound *all[] = {&slide, &stick, &creep, &sink, &chainGap, &period, &way, &flip, &overlap, &top};
    const Engine e = copyOfKarma();
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        ck_assert_int_eq(countBroken(all[i], &e), 0);
}

TEST(friction_of_the_wrong_sign_is_seen) {
    Engine e = copyOfKarma();
    e.setContacts = removeFriction;
    ck_assert_int_eq(countBroken(&creep, &e), 1);
    e.addBody = driveBody;
    ck_assert_int_eq(countBroken(&slide, &e), 1);
    ck_assert_int_eq(countBroken(&stick, &e), 1);
    ck_assert_int_eq(countBroken(&way, &e), 1);
}

TEST(a_hundredth_of_friction_is_seen) {
    Engine e = copyOfKarma();
    e.setContacts = lessenFriction;
    ck_assert_int_eq(countBroken(&slide, &e), 1);
    ck_assert_int_eq(countBroken(&way, &e), 1);
}

TEST(dropped_contacts_are_seen) {
    Engine e = copyOfKarma();
    e.setContacts = dropTwoContacts;
    ck_assert_int_eq(countBroken(&overlap, &e), 1);
    ck_assert_int_eq(countBroken(&sink, &e), 1);
}

TEST(contacts_that_are_lost_now_and_then_are_seen) {
    Engine e = copyOfKarma();
    e.setContacts = dropEveryTenthContacts;
    ck_assert_int_eq(countBroken(&stick, &e), 1);
    ck_assert_int_eq(countBroken(&sink, &e), 1);
}

TEST(a_dropped_joint_is_seen) {
    Engine e = copyOfKarma();
    e.addJoint = dropThirdJoint;
    ck_assert_int_eq(countBroken(&chainGap, &e), 1);
}

TEST(a_skipped_step_is_seen) {
    Engine e = copyOfKarma();
    e.step = skipTenthStep;
    ck_assert_int_eq(countBroken(&period, &e), 1);
    ck_assert_int_eq(countBroken(&slide, &e), 1);
    ck_assert_int_eq(countBroken(&flip, &e), 1);
}

TEST(a_step_that_is_too_long_is_seen) {
    Engine e = copyOfKarma();
    e.step = stepLonger;
    ck_assert_int_eq(countBroken(&period, &e), 1);
    ck_assert_int_eq(countBroken(&way, &e), 0); /* the way to a stop does not depend on time */
}
