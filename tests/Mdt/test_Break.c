/* Joints that break: at which load, in which order, and what becomes of them. */
#include "scene.h"

static MdtWorldID w;
static MdtConstraintID seen[8];
static int seenCount;

static void setUp(void) {
    w = scene_world(8, 16, 10);
    MdtWorldSetEpsilon(w, 0);
    seenCount = 0;
}

TEST_FIXTURE(setUp, NULL)

static int brokenCount(void) {
    int count;
    MdtWorldGetBrokenJoints(w, &count);
    return count;
}

/* A weight of 3 kg that hangs by a ball joint. */
static MdtConstraintID hangWeight(double x) {
    MdtBodyID b = scene_body(w, 3, x, 0, 0);
    MdtBSJointID joint = scene_ball(w, b, 0, x, 1, 0);
    return MdtBSJointQuaConstraint(joint);
}

/* A bar of 1 m and 2 kg along x, held at one end as in a wall: it carries 20 N and 10 N m there. */
static MdtConstraintID holdBar(MeBool isFirst) {
    const double edge[3] = {1, .1, .1};
    MdtBodyID bar = scene_box(w, 2, edge, .5, 0, 0);
    MdtFPFOJointID joint = MdtFPFOJointCreate(w);
    MdtConstraintID c = MdtFPFOJointQuaConstraint(joint);
    MdtConstraintSetBodies(c, isFirst ? bar : 0, isFirst ? 0 : bar);
    MdtConstraintSetPosition(c, 0, 0, 0);
    MdtConstraintEnable(c);
    return c;
}

static void run(int steps) {
    for (int i = 0; i < steps && !brokenCount(); i++)
        MdtWorldStep(w, FRAME);
}

TEST(a_joint_breaks_where_its_load_exceeds_the_limit) {
    for (int side = -1; side <= 1; side += 2) {
        MdtConstraintID c = hangWeight(0);
        MdtConstraintSetBreakLimits(c, 30 * (1 + side * 1e-4), MEINFINITY);
        assert_near_rel(MdtConstraintGetBreakForce(c), 30 * (1 + side * 1e-4), TOL(1e-6, 9e-14));
        ck_assert(MdtConstraintGetBreakTorque(c) == MEINFINITY);
        run(100);
        ck_assert_int_eq(brokenCount(), side < 0);
        ck_assert_int_eq(MdtConstraintIsEnabled(c), side > 0);
        MdtConstraintDestroy(c);
        MdtWorldStep(w, FRAME);
        ck_assert_int_eq(brokenCount(), 0);
    }
}

TEST(torque_counts_about_the_joints_position) {
    for (int side = -1; side <= 1; side += 2)
        for (int isFirst = 0; isFirst < 2; isFirst++) {
            MeVector3 torque;
            MdtConstraintID c = holdBar(isFirst);
            MdtConstraintSetBreakLimits(c, 21, 10 * (1 + side * 1e-3));
            run(100);
            MdtConstraintGetJointTorque(c, isFirst ? 0 : 1, torque);
            assert_vec3_near(torque, 0, 0, 10, TOL(1e-5, 1e-6));
            MdtConstraintGetTorque(c, isFirst ? 0 : 1, torque); /* about the centre of mass there is none */
            assert_vec3_near(torque, 0, 0, 0, 1e-6);
            ck_assert_int_eq(brokenCount(), side < 0);
            setUp();
        }
}

TEST(what_is_broken_falls_and_can_be_mended) {
    MdtConstraintID c = hangWeight(0);
    MdtBodyID b = MdtConstraintGetBody(c, 0);
    MeVector3 p;
    MdtConstraintSetBreakLimits(c, 1, 1);
    run(1);
    for (int i = 0; i < 30; i++)
        MdtWorldStep(w, FRAME);
    MdtBodyGetPosition(b, p);
    assert_below(p[1], -1);
    ck_assert(MdtWorldGetTotalConstraints(w) == 1 && MdtWorldGetEnabledConstraints(w) == 0);
    MdtBodySetPosition(b, 0, 0, 0);
    MdtBodySetLinearVelocity(b, 0, 0, 0);
    MdtConstraintSetBreakLimits(c, 31, MEINFINITY);
    MdtConstraintEnable(c);
    run(60);
    ck_assert(brokenCount() == 0 && MdtConstraintIsEnabled(c));
}

static void MEAPI note(const MdtConstraintID c) {
    seen[seenCount++] = c;
    MdtConstraintDestroy(c);
}

TEST(they_are_told_by_sort_key_then_creation) {
    MdtConstraintID c[4];
    const int key[4] = {7, 3, 7, 1};
    for (int i = 0; i < 4; i++) {
        c[i] = hangWeight(2. * i);
        MdtConstraintSetSortKey(c[i], key[i]);
        MdtConstraintSetBreakLimits(c[i], 1, 1);
    }
    MdtWorldSetBreakCB(w, note);
    run(1);
    ck_assert(seenCount == 4 && seen[0] == c[3] && seen[1] == c[1] && seen[2] == c[0] && seen[3] == c[2]);
    ck_assert_int_eq(brokenCount(), 4);
    for (int i = 0; i < 4; i++)
        ck_assert_ptr_null(MdtWorldGetBrokenJoints(w, 0)[i]); /* the callback has destroyed them */
    ck_assert_int_eq(MdtWorldGetTotalConstraints(w), 0);
}

/* One that fell asleep with its load broke long ago, if it should; a limit that is lowered counts when it wakes. */
TEST(a_sleeping_joint_breaks_when_it_wakes) {
    MdtConstraintID c = hangWeight(0);
    MdtBodyID b = MdtConstraintGetBody(c, 0);
    MdtWorldSetAutoDisable(w, 1);
    for (int i = 0; i < 600 && MdtBodyIsEnabled(b); i++)
        MdtWorldStep(w, FRAME);
    ck_assert(!MdtBodyIsEnabled(b));
    MdtConstraintSetBreakLimits(c, 1, 1);
    run(10);
    ck_assert_int_eq(brokenCount(), 0);
    MdtBodyEnable(b);
    run(1);
    ck_assert_int_eq(brokenCount(), 1);
}

TEST(a_sleeping_body_wakes_when_its_joint_goes) {
    for (int way = 0; way < 2; way++) {
        MdtConstraintID c = hangWeight(0);
        MdtBodyID b = MdtConstraintGetBody(c, 0);
        MdtWorldSetAutoDisable(w, 1);
        for (int i = 0; i < 600 && MdtBodyIsEnabled(b); i++)
            MdtWorldStep(w, FRAME);
        ck_assert(!MdtBodyIsEnabled(b));
        if (way)
            MdtConstraintDisable(c);
        else
            MdtConstraintDestroy(c);
        ck_assert(MdtBodyIsEnabled(b));
    }
}

TEST(bad_limits_warn) {
    MdtConstraintID c = hangWeight(0);
    MdtContactID contact = MdtContactCreate(w);
    MeVector3 torque = {7, 7, 7};
    int count = 7;
    MdtConstraintSetBreakLimits(c, -1, 1);
    assert_warned("force");
    MdtConstraintSetBreakLimits(c, 1, NAN);
    assert_warned("torque");
    ck_assert(MdtConstraintGetBreakForce(c) == MEINFINITY && MdtConstraintGetBreakTorque(c) == MEINFINITY);
    MdtConstraintSetBreakLimits(MdtContactQuaConstraint(contact), 1, 1);
    assert_warned("does not break");
    MdtConstraintSetBreakLimits(0, 1, 1);
    assert_warned("constraint");
    MdtConstraintGetJointTorque(c, 2, torque);
    assert_warned("index");
    ck_assert(torque[0] == 0 && torque[2] == 0);
    ck_assert(!MdtWorldGetBrokenJoints(0, &count) && count == 0);
    assert_warned("world");
}
