/* Documented behaviours: partitions and auto-disable; the cap on the matrix size.
 *
 * Already proved elsewhere:
 *   a partition is what constraints join; the world joins nothing  test_Rest: constraints_join_bodies_and_the_world_...
 *   all four values have to be below their thresholds              test_Rest: each_threshold_keeps_a_body_awake
 *   the thresholds are squares of magnitudes                       test_Rest: each_threshold_keeps_a_body_awake
 *   auto-disable can be switched                                   test_Rest: auto_disable_can_be_switched_off
 *   disabling a body freezes its collision model                   (belongs to collision)
 *
 *   rows go: friction, then body-body, then body-world contacts, from the shallowest to the deepest
 *                                                                  test_MatrixCap: rows_go_in_the_documented_order
 *   joints are never dropped                                       test_MatrixCap: rows_go_in_the_documented_order
 *   each contact group keeps a contact                             test_MatrixCap: a_group_keeps_its_deepest_contact
 *   a callback can replace the order                               test_MatrixCap: a_callback_replaces_the_order
 *   no call, no cap                                                test_MatrixCap: without_a_call_there_is_no_cap
 */
#include "behaviour.h"

/* Dynamics guide ch. 1, "Partitioning the World"; User Guide ch. 6: two boxes on the ground are two partitions, a
 * stack is one. */
TEST(two_boxes_on_the_ground_are_two_partitions_and_a_stack_is_one) {
    MdtWorldID w = scene_world(3, 3, 10);
    MdtBodyID left = scene_body(w, 1, 0, 1, 0), right = scene_body(w, 1, 5, 1, 0), top = scene_body(w, 1, 5, 3, 0);
    scene_contact(w, left, 0, 0, 0, 0);
    scene_contact(w, right, 0, 5, 0, 0);
    scene_contact(w, top, right, 5, 2, 0);
    MdtWorldStep(w, FRAME);
    ck_assert_int_ne(MdtBodyGetPartition(left), MdtBodyGetPartition(right));
    ck_assert_int_eq(MdtBodyGetPartition(top), MdtBodyGetPartition(right));
    MdtWorldDestroy(w);
}

TEST(a_body_knows_the_size_of_its_partition) {
    MdtWorldID w = scene_world(4, 1, 10);
    MdtBodyID left = scene_body(w, 1, 5, 1, 0), right = scene_body(w, 1, 5, 3, 0), alone = scene_body(w, 1, 0, 1, 0),
              asleep = MdtBodyCreate(w);
    scene_contact(w, right, left, 5, 2, 0);
    ck_assert_int_eq(MdtBodyGetPartitionSize(left), 0); /* no step yet */
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(MdtBodyGetPartitionSize(left), 2);
    ck_assert_int_eq(MdtBodyGetPartitionSize(right), 2);
    ck_assert_int_eq(MdtBodyGetPartitionSize(alone), 1);
    ck_assert_int_eq(MdtBodyGetPartition(asleep), -1);
    ck_assert_int_eq(MdtBodyGetPartitionSize(asleep), 0);
    MdtWorldDestroy(w);
}

/* Dynamics guide ch. 1, "Partitioning the World": forces from outside are ignored; bodies that pull at each other by
 * them stay apart. */
TEST(forces_do_not_join_bodies) {
    MdtWorldID w = scene_world(2, 0, 10);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0), b = scene_body(w, 1, 2, 0, 0);
    for (int i = 0; i < 10; i++) {
        MdtBodyAddForceAtPosition(a, 50, 0, 0, 1, 0, 0);
        MdtBodyAddForceAtPosition(b, -50, 0, 0, 1, 0, 0);
        MdtWorldStep(w, FRAME);
        ck_assert_int_ne(MdtBodyGetPartition(a), MdtBodyGetPartition(b));
    }
    MdtWorldDestroy(w);
}

static int MEAPI compareNumbers(const void *a, const void *b) {
    return *(const int *)a - *(const int *)b;
}

static void MEAPI countPartitions(MdtPartitionOutput *po, void *count) {
    ck_assert_int_eq(po->numPartitions, ++*(int *)count);
}

/* User Guide ch. 2, "MdtUpdatePartitions": partitions are found from the enabled bodies; a disabled body that is tied
 * to one is enabled. Here: a chain of two of which one is disabled, one alone, one that is not asked for, one disabled
 * alone. */
TEST(partitions_are_found_from_a_list_of_bodies) {
    static const int key[5] = {3, 1, 4, 2, 5};
    MdtWorldID w = scene_world(5, 1, 10);
    MdtBodyID b[5];
    MeDict list;
    MeDictNode node[5];
    MdtPartitionOutput po;
    int called = 0;
    MeDictInit(&list, 5, compareNumbers);
    for (int i = 0; i < 5; i++) {
        b[i] = scene_body(w, 1, 2. * i, 0, 0);
        MeDictNodeInit(&node[i], b[i]);
        if (i != 2)
            MeDictInsert(&list, &node[i], &key[i]);
    }
    MdtBSJointID joint = MdtBSJointCreate(w);
    MdtBSJointSetBodies(joint, b[0], b[3]);
    MdtBSJointEnable(joint);
    MdtBodyDisable(b[3]);
    MdtBodyDisable(b[4]);
    MdtUpdatePartitions(&list, &po, countPartitions, &called);
    ck_assert(called == 2 && po.numPartitions == 2 && po.world == w);
    ck_assert(MdtBodyIsEnabled(b[3]) && !MdtBodyIsEnabled(b[4]));
    ck_assert(po.info[0].numBodies == 2 && po.info[0].numConstraints == 1 && !po.info[0].isDisabled);
    ck_assert(po.bodies[po.info[0].firstBody] == b[0] && po.bodies[po.info[0].firstBody + 1] == b[3]);
    ck_assert(po.constraints[po.info[0].firstConstraint] == MdtBSJointQuaConstraint(joint));
    ck_assert(po.info[1].numBodies == 1 && po.bodies[po.info[1].firstBody] == b[1]);
    MdtWorldStep(w, FRAME);
    messages_catch();
    MdtUpdatePartitions(0, &po, 0, 0);
    assert_warned("list of bodies");
    MdtUpdatePartitions(&list, 0, 0, 0);
    assert_warned("partition output");
    while (!MeDictIsEmpty(&list))
        MeDictDelete(&list, MeDictFirst(&list));
    MdtUpdatePartitions(&list, &po, 0, 0);
    ck_assert_int_eq(po.numPartitions, 0);
    assert_silent();
    messages_release();
    MdtWorldDestroy(w);
}

/* How many steps until the body is disabled; `max` when it is not. */
static int stepsAwake(MdtWorldID w, MdtBodyID b, int max) {
    int n = 0;
    while (n < max && MdtBodyIsEnabled(b)) {
        MdtWorldStep(w, FRAME);
        n++;
    }
    return n;
}

/* Dynamics guide ch. 4, "Enabling/Disabling Bodies": a body that was awakened is kept alive for a number of steps at
 * least, however still it is. The User Guide gives the window in seconds; both are offered, and each awakening begins
 * it anew. */
TEST(an_awakened_body_is_kept_alive_for_the_window) {
    for (int window = 3; window <= 30; window += 9) {
        MdtWorldID w = MdtWorldCreate(1, 0);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MdtWorldSetAutoDisableAliveWindow(w, window);
        for (int awakening = 0; awakening < 3; awakening++) {
            const int n = stepsAwake(w, b, 100);
            ck_assert_msg(n >= window && n <= window + 2, "window %d: disabled in step %d", window, n);
            MdtBodyEnable(b);
        }
        MdtWorldDestroy(w);
    }
}

/* User Guide ch. 2, "AutoDisable": the bodies of a partition are disabled together, in one step. */
TEST(a_partition_is_disabled_in_one_step) {
    MdtWorldID w = MdtWorldCreate(3, 2);
    MdtBodyID b[3];
    for (int i = 0; i < 3; i++) {
        b[i] = scene_body(w, 1, i, 0, 0);
        if (i) {
            MdtBSJointID j = MdtBSJointCreate(w);
            MdtBSJointSetBodies(j, b[i - 1], b[i]);
            MdtBSJointSetPosition(j, i - .5, 0, 0);
            MdtBSJointEnable(j);
        }
    }
    MdtBodySetLinearVelocity(b[2], 0, .5, 0);
    for (int i = 0; i < 3; i++) {
        MdtBodySetLinearVelocityDamping(b[i], 2);
        MdtBodySetAngularVelocityDamping(b[i], 2);
    }
    int i = 0;
    for (; i < 1000 && MdtBodyIsEnabled(b[0]); i++) {
        for (int k = 1; k < 3; k++)
            ck_assert_msg(MdtBodyIsEnabled(b[k]), "body %d rests before body 0, in step %d", k, i);
        MdtWorldStep(w, FRAME);
    }
    ck_assert_int_gt(i, 12); /* it moved for longer than the window */
    ck_assert_int_eq(MdtWorldGetEnabledBodies(w), 0);
    MdtWorldDestroy(w);
}

/* User Guide ch. 3: higher thresholds disable sooner. A velocity v0 exp(-d t) is below the threshold's root from
 * ln(v0² / threshold) / (2 d) on. */
TEST(higher_thresholds_disable_sooner) {
    const double thresholds[] = {.25, .04, .01};
    for (int k = 0; k < 3; k++) {
        MdtWorldID w = MdtWorldCreate(1, 0);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MdtBodySetLinearVelocity(b, 1, 0, 0);
        MdtBodySetLinearVelocityDamping(b, 1);
        MdtWorldSetAutoDisableAccelerationThreshold(w, 100);
        MdtWorldSetAutoDisableVelocityThreshold(w, thresholds[k]);
        const double n = -.5 * log(thresholds[k]) / (double)FRAME;
        assert_near(stepsAwake(w, b, 1000), n, 3);
        MdtWorldDestroy(w);
    }
}
