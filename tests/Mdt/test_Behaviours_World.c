/* Documented behaviours: worlds and stepping.
 *
 * Already proved elsewhere:
 *   worlds are independent of each other, several may exist     test_World: worlds_are_independent
 *   a world takes so many bodies and constraints, and no more   test_BadInput: more_than_the_world_was_created_for
 *   length and mass scale set tolerances, mass and inertia      test_World: both_forms_of_creation
 *                                                               test_Body: scales_set_the_default_mass_and_inertia
 *   a world without enabled bodies leaves everything            test_World: a_world_without_enabled_bodies_...
 *   the step may differ from call to call                       test_World: the_step_may_differ_from_call_to_call
 *   (the guide: first order) of second order, free fall exact   test_FreeBody: free_fall_is_the_closed_form_to_...
 *                                                               test_FreeBody: damped_projectile_follows_the_expo...
 *   forces of the last step can be read after it                test_BSJoint: the_force_read_back_is_the_pendulum_s_...
 */
#include "behaviour.h"

/* The stages of a step as they can be watched: the partition callback, the rows of a user constraint, and afterwards
 * the world. */
static char watched[8];
static double heightWhenPartitioned, heightWhenPacked;
static MdtBodyID fallingBody;
static MeBool putToRest;

static void MEAPI onPartition(MdtPartitionOutput *po, void *data) {
    (void)data;
    strcat(watched, "p");
    heightWhenPartitioned = coordinate(fallingBody, 1);
    ck_assert_int_eq(MdtBodyGetPartition(fallingBody), 0);
    po->info[po->numPartitions - 1].isDisabled = putToRest;
}

static void MEAPI onRows(MdtKeaConstraints *const rows, void *const constraint, const MdtKeaTransformation *const poses,
                         MdtKeaBody *const bodies[], const void *const params) {
    (void)constraint, (void)bodies, (void)params;
    strcat(watched, "r");
    heightWhenPacked = poses[0].pos[1];
    MdtKeaRow *row = MdtBclAddRow(rows); /* holds the height's rate at 0 */
    row->J[0].lin[1] = 1;
}

/* User Guide ch. 2, "High Level API": partitions, rest, packing, solving, integrating, unpacking, in this order. */
TEST(the_stages_of_a_step_come_in_order) {
    for (int rest = 0; rest < 2; rest++) {
        MdtWorldID w = scene_world(1, 1, 10);
        fallingBody = scene_body(w, 2, 0, 7, 0);
        putToRest = rest;
        watched[0] = 0;
        MdtWorldSetPartitionCB(w, onPartition, 0);
        MdtUserConstraintID j = MdtUserConstraintCreate(w);
        MdtUserConstraintSetFunction(j, onRows);
        MdtUserConstraintSetBodies(j, fallingBody, 0);
        MdtUserConstraintEnable(j);
        MdtBodySetLinearVelocity(fallingBody, 3, 0, 0);
        MdtWorldStep(w, FRAME);
        ck_assert_str_eq(watched, rest ? "p" : "pr"); /* what is put to rest is not packed */
        assert_near(heightWhenPartitioned, 7, 0);
        if (!rest) {
            assert_near(heightWhenPacked, 7, 0);                                     /* before integration */
            assert_near(forceOn(MdtUserConstraintQuaConstraint(j), 0, 1), 20, 1e-2); /* solved, unpacked */
            assert_position(fallingBody, 3 * (double)FRAME, 7, 0, TOL(7e-6, 3e-6));  /* integrated */
        } else
            assert_position(fallingBody, 0, 7, 0, 0);
    }
}
