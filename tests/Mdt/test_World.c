/* Worlds: parameters, counting, order, determinism, memory. */
#include "scene.h"

TEST(a_new_world_has_the_guide_s_defaults) {
    MdtWorldID w = MdtWorldCreate(3, 5);
    MeVector3 g;
    MdtWorldGetGravity(w, g);
    assert_vec3_near(g, 0, 0, 0, 0);
    assert_near(MdtWorldGetEpsilon(w), 1e-4, TOL(1e-10, 9e-18)); /* the Dynamics guide's; the User Guide says 0.01 */
    assert_near(MdtWorldGetGamma(w), .2, TOL(1e-7, 2e-14));
    ck_assert(MdtWorldGetAutoDisable(w));
    assert_near(MdtWorldGetAutoDisableVelocityThreshold(w), .02, TOL(1e-8, 2e-15));
    assert_near(MdtWorldGetAutoDisableAngularVelocityThreshold(w), .001, TOL(1e-9, 9e-17));
    assert_near(MdtWorldGetAutoDisableAccelerationThreshold(w), .5, TOL(1e-7, 5e-14));
    assert_near(MdtWorldGetAutoDisableAngularAccelerationThreshold(w), .002, TOL(1e-9, 2e-16));
    assert_near(MdtWorldGetAutoDisableAliveTime(w), .2, TOL(1e-7, 2e-14));
    assert_near(MdtWorldGetMinSafeTime(w), .001, TOL(1e-9, 9e-17));
    ck_assert_int_eq(MdtWorldGetMaxBodies(w), 3);
    ck_assert_int_eq(MdtWorldGetMaxConstraints(w), 5);
    ck_assert_int_eq(MdtWorldGetTotalBodies(w) + MdtWorldGetTotalConstraints(w) + MdtWorldGetEnabledBodies(w), 0);
    MdtWorldDestroy(w);
}

TEST(both_forms_of_creation) {
    MdtWorldID a = MdtWorldCreate(1, 0), b = MdtWorldCreate(1, 0, 10, 100);
    MdtWorldID (*const pointer)(const unsigned int, const unsigned int, const MeReal, const MeReal) = MdtWorldCreate;
    MdtWorldID c = pointer(1, 0, 1, 1);
    assert_near(MdtWorldGetDefaultDensity(a), 1, 0);
    assert_near(MdtWorldGetDefaultDensity(b), .1, TOL(1e-8, 9e-15));
    assert_near(MdtWorldGetEpsilon(b), 1e-6, TOL(1e-12, 9e-20));
    assert_near(MdtWorldGetAutoDisableVelocityThreshold(b), 2, TOL(1e-6, 2e-13));
    MdtWorldDestroy(a);
    MdtWorldDestroy(b);
    MdtWorldDestroy(c);
}

/* Steps (a whole number) in the Dynamics guide, seconds (a float) in the User Guide. */
TEST(the_alive_window_is_in_steps_or_in_seconds) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtWorldSetAutoDisableAliveWindow(w, 12);
    ck_assert_int_eq(MdtWorldGetAutoDisableAliveWindow(w), 12);
    assert_near(MdtWorldGetAutoDisableAliveTime(w), .2, TOL(2e-7, 2e-14));
    MdtWorldStep(w, .1);
    assert_near(MdtWorldGetAutoDisableAliveTime(w), 1.2, TOL(1e-6, 2e-13));
    MdtWorldSetAutoDisableAliveWindow(w, 0.5f);
    assert_near(MdtWorldGetAutoDisableAliveTime(w), .5, 0);
    ck_assert_int_eq(MdtWorldGetAutoDisableAliveWindow(w), 5);
    MdtWorldSetAutoDisableAliveWindow(w, 0.25);
    assert_near(MdtWorldGetAutoDisableAliveTime(w), .25, 0);
}

TEST(worlds_are_independent) {
    MdtWorldID a = scene_world(1, 0, 10), b = scene_world(1, 0, 0);
    MdtBodyID inA = scene_body(a, 1, 0, 0, 0), inB = scene_body(b, 1, 0, 0, 0);
    MeVector3 v;
    MdtWorldStep(a, .5);
    MdtBodyGetLinearVelocity(inA, v);
    assert_near(v[1], -5, TOL(1e-6, 5e-13));
    MdtWorldStep(b, .5);
    MdtBodyGetLinearVelocity(inB, v);
    assert_near(v[1], 0, 0);
    MdtBodyGetLinearVelocity(inB, v);
}

TEST(a_world_without_enabled_bodies_leaves_everything) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = MdtBodyCreate(w);
    MeVector3 p;
    MdtWorldSetGravity(w, 0, -10, 0);
    steps(w, 10, FRAME);
    MdtBodyGetPosition(b, p);
    assert_vec3_near(p, 0, 0, 0, 0);
}

TEST(the_step_may_differ_from_call_to_call) {
    MdtWorldID w = scene_world(1, 0, 10);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MeVector3 v;
    MdtWorldStep(w, .1);
    MdtWorldStep(w, .3);
    MdtBodyGetLinearVelocity(b, v);
    assert_near(v[1], -4, TOL(1e-6, 4e-13));
}

TEST(bodies_and_constraints_are_walked_in_the_order_of_their_keys) {
    MdtWorldID w = scene_world(5, 3, 0);
    MdtBodyID b[5];
    const MeI32 keys[5] = {4, 0, 3, 0, 1};
    const int order[5] = {1, 3, 4, 2, 0};
    for (int i = 0; i < 5; i++) {
        b[i] = scene_body(w, 1, 0, 0, 0);
        MdtBodySetSortKey(b[i], keys[i]);
    }
    MdtBodyID at = MdtBodyGetFirst(w);
    for (int i = 0; i < 5; i++, at = MdtBodyGetNext(at))
        ck_assert(at == b[order[i]]);
    ck_assert(at == NULL);
    MdtBSJointID j[3];
    for (int i = 0; i < 3; i++) {
        j[i] = MdtBSJointCreate(w);
        MdtBSJointSetSortKey(j[i], 2 - i);
    }
    MdtConstraintID c = MdtConstraintGetFirst(w);
    for (int i = 2; i >= 0; i--, c = MdtConstraintGetNext(c))
        ck_assert(c == MdtBSJointQuaConstraint(j[i]));
}

/* A double pendulum and a free body; `shuffled` creates them in another order, with the same sort keys. */
static void runScene(MeBool shuffled, MeReal out[3][3]) {
    const double edge[3] = {1, .2, .2};
    MdtWorldID w = scene_world(4, 4, 9.81);
    MdtBodyID b[3] = {0};
    const int order[2][3] = {{0, 1, 2}, {2, 0, 1}};
    for (int i = 0; i < 3; i++) {
        const int k = order[shuffled][i];
        b[k] = scene_box(w, 1 + k, edge, k + .5, 0, k == 2 ? 3 : 0);
        MdtBodySetSortKey(b[k], k + 1);
    }
    for (int i = 0; i < 2; i++) {
        const int k = shuffled ? 1 - i : i;
        MdtBSJointID j = MdtBSJointCreate(w);
        MdtBSJointSetBodies(j, b[k], k ? b[k - 1] : 0);
        MdtBSJointSetPosition(j, (MeReal)k, 0, 0);
        MdtBSJointSetSortKey(j, k + 1);
        MdtBSJointEnable(j);
    }
    MdtBodySetAngularVelocity(b[1], 3, 1, 2);
    if (shuffled) { /* another body came and went */
        MdtBodyID gone = scene_body(w, 1, 0, 0, 0);
        MdtBodyDestroy(gone);
    }
    steps(w, 600, FRAME);
    for (int k = 0; k < 3; k++)
        MdtBodyGetPosition(b[k], out[k]);
}

TEST(the_same_scene_gives_the_same_bits) {
    MeReal a[3][3], b[3][3], c[3][3];
    runScene(0, a);
    runScene(0, b);
    runScene(1, c);
    ck_assert_msg(memcmp(a, b, sizeof a) == 0, "two runs differ");
    ck_assert_msg(memcmp(a, c, sizeof a) == 0, "another order of creation with the same sort keys differs");
}

static void destroyIt(const MdtConstraintID c, void *count) {
    ++*(int *)count;
    MdtConstraintDestroy(c);
}

TEST(all_constraints_may_be_destroyed_while_walking) {
    MdtWorldID w = scene_world(1, 6, 0);
    int count = 0;
    for (int i = 0; i < 6; i++)
        MdtBSJointCreate(w);
    MdtWorldForAllConstraints(w, destroyIt, &count);
    ck_assert_int_eq(count, 6);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(w), 0);
}

TEST(forces_of_all_bodies_may_be_reset) {
    MdtWorldID w = scene_world(2, 0, 0);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0), b = MdtBodyCreate(w);
    MeVector3 v;
    MdtBodyAddForce(a, 1, 0, 0);
    MdtBodyAddTorque(b, 1, 0, 0);
    MdtBodyAddImpulse(a, 1, 0, 0);
    MdtWorldResetForces(w);
    MdtWorldStep(w, FRAME);
    MdtBodyGetLinearVelocity(a, v);
    assert_vec3_near(v, 0, 0, 0, 0);
    MdtBodyGetTorque(b, v);
    assert_vec3_near(v, 0, 0, 0, 0);
}

TEST(safe_time_shortens_the_step_of_a_partition) {
    MdtWorldID w = scene_world(2, 0, 0);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0), b = scene_body(w, 1, 0, 1, 0);
    MdtBodySetLinearVelocity(a, 1, 0, 0);
    MdtBodySetLinearVelocity(b, 1, 0, 0);
    MdtBodySetSafeTime(a, .125);
    MdtWorldStepSafeTime(w, .5);
    assert_near(MdtBodyGetTransformPtr(a)[3][0], .125, TOL(1e-7, 2e-14));
    assert_near(MdtBodyGetTransformPtr(b)[3][0], .5, TOL(1e-7, 5e-14));
    MdtBodySetSafeTime(a, 0);
    MdtWorldStepSafeTime(w, .5);
    assert_near(MdtBodyGetTransformPtr(a)[3][0], .126, TOL(2e-7, 2e-14)); /* the least safe time */
}

TEST(the_least_safe_time_is_a_setting_of_its_own) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtWorldSetMaxMatrixSize(w, 12);
    MdtWorldSetMinSafeTime(w, .25);
    ck_assert(MdtWorldGetMinSafeTime(w) == (MeReal).25);
    ck_assert_int_eq(MdtWorldGetMaxMatrixSize(w), 12);
    MdtWorldSetMinSafeTime(w, -1);
    assert_warned("safe time");
    ck_assert(MdtWorldGetMinSafeTime(w) == (MeReal).25);
}
