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
 *                                                               test_FreeBody: damped_flight_converges_at_second_order
 *   forces of the last step can be read after it                test_BSJoint: the_force_read_back_is_the_pendulum_s_...
 */
#include "behaviour.h"
#include "MeMemory.h"

/* Dynamics guide ch. 2, "Stepping Through Time": the step partitions the world, solves, integrates; on return positions
 * and velocities are the new ones, x⁺ = x + h (v + v⁺)/2. */
TEST(a_step_partitions_solves_and_integrates) {
    const double h = .02;
    MdtWorldID w = scene_world(3, 1, 10);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0), b = scene_body(w, 3, 1, 0, 0), apart = scene_body(w, 1, 9, 0, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtLinear2ID rail = MdtLinear2Create(w); /* b stays on the line through it along x */
    MdtLinear2SetBodies(rail, a, b);
    MdtLinear2SetPosition(rail, 1, 0, 0);
    MdtLinear2Enable(rail);
    MdtBodySetLinearVelocity(a, 0, 0, 4);
    MdtWorldStep(w, h);
    ck_assert_int_eq(MdtBodyGetPartition(a), MdtBodyGetPartition(b)); /* partitioned */
    ck_assert_int_ne(MdtBodyGetPartition(a), MdtBodyGetPartition(apart));
    assert_near(velocity(a, 2) + 3 * velocity(b, 2), 4, TOL(4e-6, 4e-13)); /* solved: the joint shares the momentum */
    ck_assert_msg(velocity(b, 2) > .1, "the joint did not pull: %g", velocity(b, 2));
    /* integrated: a joint's jerk has its effect from the start of the step. It acts at the mean of the poses, to where
     * the point of a has moved along the rail by (1 - cos θ) / 2; so it turns b a little, and the rail with it. */
    const double sine = (coordinate(a, 2) - coordinate(b, 2)) / 1, arm = (1 - sqrt(1 - sine * sine)) / 2;
    const double turn = h * 3 * velocity(b, 2) * arm / .4, aside = h * velocity(b, 2) * turn / 2;
    assert_near(coordinate(b, 0) - 1, aside, TOL(2e-7, 1e-3 * aside));
    assert_near(coordinate(b, 1), -10 * h * h / 2, TOL(2e-9, 2e-16));
    /* what the point of a weighs along the rail, 1 / (4/3 + arm²/I), changes until the end: twice the arm there */
    const double heavier = 3 * arm * arm / .4 / (4. / 3), way = h * velocity(b, 2);
    assert_near(coordinate(b, 2), way, 1e-9 + way * heavier + TOL(1e-7, 0));
    assert_velocity(apart, 0, -10 * h, 0, TOL(1e-7, 9e-14));
    assert_position(apart, 9, -10 * h * h / 2, 0, TOL(1e-6, 8e-13));
    MdtWorldDestroy(w);
}

/* Dynamics guide ch. 5, "Background": the integrator's inaccuracy lets energy fall rather than rise, for the forces of
 * constraints. Here it does not rise: over 60 s at 30 Hz a swinging pair of bars has at most the energy that it began
 * with, but for what the joints' tolerance of 1e-10 of a row's size is worth. */
TEST(constraint_forces_do_not_add_energy) {
    const double edge[3] = {1, .1, .1}, h = 1.0 / 30;
    MdtWorldID w = scene_world(2, 2, 10);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID bar[2] = {scene_box(w, 1, edge, .5, 0, 0), scene_box(w, 1, edge, 1.5, 0, 0)};
    for (int i = 0; i < 2; i++) {
        scene_ball(w, bar[i], i ? bar[0] : 0, (MeReal)i, 0, 0);
    }
    double highest = 0;
    for (int i = 0; i < 1800; i++) {
        MdtWorldStep(w, h);
        double energy = 0;
        for (int k = 0; k < 2; k++)
            energy += (double)MdtBodyGetKineticEnergy(bar[k]) + 10 * coordinate(bar[k], 1);
        highest = fmax(highest, energy);
    }
    assert_below(highest, TOL(4e-6, 1e-8)); /* it began with 0, and fell through 20 J */
    MdtWorldDestroy(w);
}

static int blocks;
static MeMemoryAPIStruct real;

static void *MEAPI countCreate(size_t bytes) {
    blocks++;
    return real.create(bytes);
}

static void *MEAPI countCreateAligned(size_t bytes, unsigned int alignment) {
    blocks++;
    return real.createAligned(bytes, alignment);
}

static void MEAPI countDestroy(void *const block) {
    blocks -= block != NULL;
    real.destroy(block);
}

static void MEAPI countDestroyAligned(void *const block) {
    blocks -= block != NULL;
    real.destroyAligned(block);
}

static void *MEAPI countResize(void *const block, size_t bytes) {
    blocks += block == NULL;
    return real.resize(block, bytes);
}

/* Dynamics guide ch. 2, "Cleaning Up": destroying a world destroys it with all its bodies and constraints, and frees
 * the memory. */
TEST(destroying_a_world_frees_it_with_its_bodies_and_constraints) {
    real = MeMemoryAPI;
    MeMemoryAPI.create = countCreate;
    MeMemoryAPI.createAligned = countCreateAligned;
    MeMemoryAPI.destroy = countDestroy;
    MeMemoryAPI.destroyAligned = countDestroyAligned;
    MeMemoryAPI.resize = countResize;
    MdtWorldID w = scene_world(8, 16, 10);
    MdtBodyID last = 0;
    for (int i = 0; i < 8; i++) {
        MdtBodyID b = scene_body(w, 1, i, 0, 0);
        MdtHingeID j = MdtHingeCreate(w);
        MdtHingeSetBodies(j, b, last);
        MdtHingeEnable(j);
        scene_contact(w, b, 0, i, 0, 0);
        last = b;
    }
    steps(w, 3, FRAME);
    ck_assert_int_gt(blocks, 0);
    MdtWorldDestroy(w);
    MeMemoryAPI = real;
    ck_assert_int_eq(blocks, 0);
}

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
        MdtWorldDestroy(w);
    }
}
