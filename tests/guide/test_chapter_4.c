/* Dynamics guide, chapter 4, "Advanced Features, Optimization and Utilities", section by section. */
#include "Mdt/behaviour.h"

static const MeReal step = (MeReal)(1.0 / 60);

static MdtBodyID newBody(MdtWorldID world, double x, double y) {
    MdtBodyID body = MdtBodyCreate(world);
    MdtBodySetPosition(body, (MeReal)x, (MeReal)y, 0);
    MdtBodyEnable(body);
    return body;
}

/* "Adding Forces, Torques and Impulse to a Body". */
TEST(adding_forces_torques_and_impulses) {
    MdtWorldID world = MdtWorldCreate(4, 0);
    MdtWorldSetAutoDisable(world, 0);
    const double h = (double)step;
    MdtBodyID body = newBody(world, 0, 0), late = MdtBodyCreate(world);
    MeVector3 v;
    MdtBodyAddForce(body, 1, 0, 0); /* "several forces are summed" */
    MdtBodyAddForce(body, 2, 3, 0);
    MdtBodyGetForce(body, v);
    assert_vec3_near(v, 3, 3, 0, 0);
    MdtWorldStep(world, step);
    assert_velocity(body, 3 * h, 3 * h, 0, TOL(1e-7, 9e-14));
    MdtBodyGetForce(body, v);
    assert_vec3_near(v, 0, 0, 0, 0); /* "reset to zero" */
    MdtWorldStep(world, step);
    assert_velocity(body, 3 * h, 3 * h, 0, TOL(1e-7, 9e-14));

    for (int i = 0; i < 10; i++) { /* "not simulated until after 10 time increments" */
        MdtBodyAddForce(late, 1, 0, 0);
        MdtWorldStep(world, step);
    }
    MdtBodyEnable(late);
    MdtWorldStep(world, step);
    MdtWorldStep(world, step);
    assert_velocity(late, 10 * h, 0, 0, TOL(1e-6, 9e-14)); /* "for the duration of the time step" */

    MdtBodyID struck = newBody(world, 5, 0);
    MdtBodyAddForceAtPosition(struck, 0, 1, 0, 7, 0, 0);
    MdtBodyAddTorque(struck, 1, 0, 0);
    MdtWorldStep(world, step);
    assert_velocity(struck, 0, h, 0, TOL(1e-7, 9e-14));
    assert_spin(struck, h / .4, 0, 2 * h / .4, TOL(1e-6, 9e-14));

    MdtBodyID shot[2];
    for (int i = 0; i < 2; i++) { /* "impulse is time step independent" */
        MdtWorldID range = MdtWorldCreate(1, 0);
        shot[i] = newBody(range, 0, 0);
        MdtBodyAddImpulse(shot[i], 2, 0, 0);
        MdtBodyAddImpulseAtPosition(shot[i], 0, 0, 1, 1, 0, 0);
        MdtWorldStep(range, i ? (MeReal).001 : (MeReal).1);
        assert_velocity(shot[i], 2, 0, 1, TOL(1e-6, 2e-13));
        assert_spin(shot[i], 0, -1 / .4, 0, TOL(3e-6, 3e-13));
        MdtWorldDestroy(range);
    }
    MdtWorldDestroy(world);
}

/* "Enabling/Disabling Bodies": on and off; below all four thresholds; for a number of steps; and awake again by a
 * force above a threshold. */
TEST(enabling_and_disabling_bodies) {
    MdtWorldID world = MdtWorldCreate(2, 1);
    MdtBodyID body = newBody(world, 0, 0);
    MdtWorldSetAutoDisable(world, 0);
    for (int i = 0; i < 100; i++)
        MdtWorldStep(world, step);
    ck_assert(MdtBodyIsEnabled(body));
    MdtWorldSetAutoDisable(world, 1);
    MdtWorldSetAutoDisableAliveWindow(world, 12);
    MdtWorldSetAutoDisableVelocityThreshold(world, (MeReal).01); /* "the square of the magnitude": 0.1 m/s */
    MdtWorldSetAutoDisableAngularVelocityThreshold(world, (MeReal).04);
    MdtWorldSetAutoDisableAccelerationThreshold(world, (MeReal).09);
    MdtWorldSetAutoDisableAngularAccelerationThreshold(world, (MeReal).16);
    assert_near(MdtWorldGetAutoDisableVelocityThreshold(world), .01, TOL(1e-9, 9e-16));
    assert_near(MdtWorldGetAutoDisableAngularVelocityThreshold(world), .04, TOL(1e-8, 4e-15));
    assert_near(MdtWorldGetAutoDisableAccelerationThreshold(world), .09, TOL(1e-8, 8e-15));
    assert_near(MdtWorldGetAutoDisableAngularAccelerationThreshold(world), .16, TOL(1e-7, 2e-14));
    const double speeds[] = {.11, .09};
    for (int k = 0; k < 2; k++) {
        MdtBodyEnable(body);
        MdtBodySetLinearVelocity(body, (MeReal)speeds[k], 0, 0);
        for (int i = 0; i < 60; i++)
            MdtWorldStep(world, step);
        ck_assert_int_eq(MdtBodyIsEnabled(body), k == 0);
    }
    MdtBodySetLinearVelocity(body, 0, 0, 0);
    for (int i = 0; i < 60; i++)
        MdtWorldStep(world, step);
    ck_assert(!MdtBodyIsEnabled(body));
    MdtBodyAddForce(body, (MeReal).2, 0, 0); /* an acceleration of .2 < .3 */
    MdtWorldStep(world, step);
    ck_assert(!MdtBodyIsEnabled(body));
    MdtBodyAddForce(body, (MeReal).4, 0, 0); /* "larger than the threshold values required to wake up" */
    MdtWorldStep(world, step);
    ck_assert(MdtBodyIsEnabled(body));
    for (int i = 0; i < 10; i++) { /* "objects are kept alive for" that long at least */
        MdtWorldStep(world, step);
        ck_assert(MdtBodyIsEnabled(body));
    }
    MdtWorldDestroy(world);
}

static MdtContactID favourite;

static MeReal MEAPI importance(const MdtContactID c) {
    return c == favourite ? 1 : 0;
}

/* "Limiting the Matrix Size": friction first, then contacts of bodies, then contacts with the world, from the
 * shallowest; never joints; one contact stays in each group; and an order of one's own. */
TEST(limiting_the_matrix_size) {
    MdtWorldID world = MdtWorldCreate(2, 12);
    MdtWorldSetGravity(world, 0, -10, 0);
    MdtBodyID lower = newBody(world, 0, 1), upper = newBody(world, 0, 3);
    MdtHingeID joint = MdtHingeCreate(world);
    MdtHingeSetBodies(joint, lower, 0);
    MdtHingeEnable(joint);
    MdtContactID contact[4];
    for (int i = 0; i < 4; i++) { /* 0, 1 between the bodies, 2, 3 with the world */
        contact[i] = scene_contact(world, i < 2 ? upper : lower, i < 2 ? lower : 0, i % 2, i < 2 ? 2 : 0, 0);
        MdtContactSetPenetration(contact[i], (MeReal)(i % 2 ? .002 : .001));
        MdtContactParamsSetType(MdtContactGetParams(contact[i]), MdtContactTypeFriction2D);
    }
    static const struct {
        int cap, rows[4];
    } expected[] = {{17, {3, 3, 3, 3}}, {9, {1, 1, 1, 1}}, {8, {0, 1, 1, 1}}, {7, {0, 0, 1, 1}},
                    {6, {0, 0, 0, 1}},  {5, {0, 0, 0, 0}}, {1, {0, 0, 0, 0}}};
    for (size_t k = 0; k < sizeof expected / sizeof *expected; k++) {
        MdtBodySetPosition(lower, 0, 1, 0);
        MdtBodySetPosition(upper, 0, 3, 0);
        MdtWorldSetMaxMatrixSize(world, expected[k].cap);
        MdtWorldStep(world, step);
        ck_assert_int_eq(MdtConstraintGetRowCount(MdtHingeQuaConstraint(joint)), 5);
        for (int i = 0; i < 4; i++)
            ck_assert_msg(MdtConstraintGetRowCount(MdtContactQuaConstraint(contact[i])) == expected[k].rows[i],
                          "cap %d: contact %d has %d rows", expected[k].cap, i,
                          MdtConstraintGetRowCount(MdtContactQuaConstraint(contact[i])));
    }
    favourite = contact[0];
    MdtWorldSetContactImportanceCB(world, importance);
    MdtWorldSetMaxMatrixSize(world, 6);
    MdtWorldStep(world, step);
    for (int i = 0; i < 4; i++)
        ck_assert_int_eq(MdtConstraintGetRowCount(MdtContactQuaConstraint(contact[i])), i == 0);
    MdtContactGroupID group = MdtContactGroupCreate(world);
    MdtContactGroupSetBodies(group, lower, 0);
    MdtContactGroupEnable(group);
    MdtContactGroupAppendContact(group, contact[2]);
    MdtContactGroupAppendContact(group, contact[3]);
    MdtWorldSetMaxMatrixSize(world, 1);
    MdtWorldStep(world, step);
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtContactQuaConstraint(contact[2])) +
                         MdtConstraintGetRowCount(MdtContactQuaConstraint(contact[3])),
                     1);
    MdtWorldDestroy(world);
}

/* A chain that is thrown about for two seconds; `reordered` removes some of it and adds it again before it starts. */
static void runChain(MeBool reordered, MeReal out[4][4]) {
    MdtWorldID world = MdtWorldCreate(4, 4);
    MdtWorldSetGravity(world, 0, -10, 0);
    MdtBodyID body[4] = {0};
    MdtBSJointID joint[4] = {0};
    for (int round = 0; round < 2; round++)
        for (int n = 0; n < 4; n++) {
            const int i = round ? 3 - n : n;
            if (round && !reordered)
                continue;
            if (body[i]) {
                MdtBSJointDestroy(joint[i]);
                MdtBodyDestroy(body[i]);
            }
            body[i] = newBody(world, i + .5, 0);
            MdtBodySetSortKey(body[i], i);
            joint[i] = MdtBSJointCreate(world);
            MdtBSJointSetSortKey(joint[i], i);
            ck_assert_int_eq(MdtBodyGetSortKey(body[i]), i);
            ck_assert_int_eq(MdtBSJointGetSortKey(joint[i]), i);
        }
    for (int i = 0; i < 4; i++) {
        MdtBSJointSetBodies(joint[i], body[i], i ? body[i - 1] : 0);
        MdtBSJointSetPosition(joint[i], (MeReal)i, 0, 0);
        MdtBSJointEnable(joint[i]);
    }
    MdtBodyAddImpulse(body[3], 1, 2, 3);
    for (int i = 0; i < 120; i++)
        MdtWorldStep(world, step);
    for (int i = 0; i < 4; i++)
        MdtBodyGetQuaternion(body[i], out[i]);
    MdtWorldDestroy(world);
}

/* "Sort Keys - Deterministic Simulation": stopped and executed again, a simulation evolves in the same way; removed
 * and added again, with sort keys, too. */
TEST(sort_keys) {
    MeReal once[4][4], again[4][4], reordered[4][4];
    runChain(0, once);
    runChain(0, again);
    runChain(1, reordered);
    ck_assert(memcmp(once, again, sizeof once) == 0);
    ck_assert(memcmp(once, reordered, sizeof once) == 0);
}
