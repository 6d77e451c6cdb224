/* Documented behaviours: partitions and auto-disable; the cap on the matrix size.
 *
 * Already proved elsewhere:
 *   a partition is what constraints join; the world joins nothing  test_Partitions
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
    MdtUpdatePartitions(0, &po, 0, 0);
    assert_warned("list of bodies");
    MdtUpdatePartitions(&list, 0, 0, 0);
    assert_warned("partition output");
    while (!MeDictIsEmpty(&list))
        MeDictDelete(&list, MeDictFirst(&list));
    MdtUpdatePartitions(&list, &po, 0, 0);
    ck_assert_int_eq(po.numPartitions, 0);
}
