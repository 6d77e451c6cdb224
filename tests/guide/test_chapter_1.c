/* Dynamics guide, Preface and chapter 1, "Introduction to Karma Dynamics", as a reader would try it out. */
#include "Mdt/behaviour.h"

/* Preface, "Coordinate Systems and Reference Frames", "Type Conventions": y = X + R x; a transform is an affine 4 × 4
 * matrix, as in OpenGL; a vector's fourth number is 1 for a place and 0 for a direction. */
TEST(conventions) {
    MdtWorldID world = MdtWorldCreate(1, 0);
    MdtBodyID body = MdtBodyCreate(world);
    const MeReal quarter = MeSqrt(.5);
    MeMatrix3 R;
    MeVector3 x = {1, 0, 0}, X, y;
    MdtBodySetPosition(body, 10, 20, 30);
    MdtBodySetQuaternion(body, quarter, 0, 0, quarter); /* a quarter turn about z, right-handed */
    MdtBodyGetPosition(body, X);
    MdtBodyGetOrientation(body, R);
    for (int i = 0; i < 3; i++)
        y[i] = X[i] + R[i][0] * x[0] + R[i][1] * x[1] + R[i][2] * x[2];
    assert_vec3_near(y, 10, 21, 30, TOL(1e-5, 3e-12));
    MdtConvertPositionVector(body, x, 0, y); /* "utility functions are provided" */
    assert_vec3_near(y, 10, 21, 30, TOL(1e-5, 3e-12));
    MdtConvertVector(body, x, 0, y);
    assert_vec3_near(y, 0, 1, 0, TOL(1e-6, 9e-14));

    MeMatrix4 tm;
    MdtBodyGetTransform(body, tm);
    for (int isPlace = 0; isPlace < 2; isPlace++) {
        const MeVector4 v = {1, 0, 0, (MeReal)isPlace};
        MeReal to[3] = {0, 0, 0};
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 4; k++)
                to[i] += v[k] * tm[k][i];
        assert_vec3_near(to, isPlace * 10, 1 + isPlace * 20, isPlace * 30, TOL(1e-5, 3e-12));
    }
    MdtWorldDestroy(world);
}

/* "The Mdt Library": different worlds are totally disconnected from each other. */
TEST(different_worlds_are_disconnected) {
    MdtWorldID earth = MdtWorldCreate(1, 1), moon = MdtWorldCreate(1, 1);
    MdtBodyID apple = MdtBodyCreate(earth), stone = MdtBodyCreate(moon);
    MdtWorldSetGravity(earth, 0, -(MeReal)9.8, 0);
    MdtWorldSetGravity(moon, 0, -(MeReal)1.6, 0);
    MdtBodyEnable(apple);
    MdtBodyEnable(stone);
    MdtWorldStep(earth, 1);
    assert_velocity(stone, 0, 0, 0, 0);
    MdtWorldStep(moon, 1);
    assert_velocity(apple, 0, -9.8, 0, TOL(1e-6, 9e-13));
    assert_velocity(stone, 0, -1.6, 0, TOL(1e-6, 2e-13));
    messages_catch();
    MdtBSJointID between = MdtBSJointCreate(earth);
    MdtBSJointSetBodies(between, apple, stone); /* "may never interact" */
    ck_assert_int_gt(caught.warnings, 0);
    messages_release();
    MdtWorldDestroy(earth);
    MdtWorldDestroy(moon);
}

/* "Rigid Bodies: A Simplified Description of Reality": any two points of a body stay at their distance, whatever acts
 * on it; and the flow of a program, T, T + Ts, T + 2 Ts, with Ts = 0.01 s. */
TEST(a_rigid_body_never_deforms_and_obeys_newton) {
    MdtWorldID world = MdtWorldCreate(1, 0);
    MdtBodyID body = MdtBodyCreate(world);
    const MeReal Ts = 0.01;
    MdtWorldSetAutoDisable(world, 0);
    MdtWorldSetGravity(world, 0, -(MeReal)9.8, 0);
    MdtBodySetLinearVelocity(body, 3, 4, 0);
    MdtBodySetAngularVelocity(body, 1, 5, 2);
    MdtBodyEnable(body);
    const MeVector3 onBody[2] = {{1, 2, 3}, {-2, 0, 1}};
    for (int i = 1; i <= 200; i++) {
        MeVector3 p, q;
        MdtBodyAddForceAtPosition(body, 30, 0, 0, 1, 1, 1);
        MdtBodyAddForceAtPosition(body, -30, 0, 0, 1, 1, 1);
        MdtWorldStep(world, Ts);
        MdtConvertPositionVector(body, onBody[0], 0, p);
        MdtConvertPositionVector(body, onBody[1], 0, q);
        assert_near(distance(p, q), sqrt(9 + 4 + 4), TOL(7e-6, 4e-13));
        const double t = i * (double)Ts;
        assert_position(body, 3 * t, 4 * t - 4.9 * t * t, 0, TOL(1e-5, 1e-12)); /* exact under a constant force */
    }
    MdtWorldDestroy(world);
}

/* "Joint Constraints and Articulated Bodies": an upper arm and a forearm with an elbow, which bends by 160 degrees and
 * no further; the forearm cannot be pulled far without moving the upper arm. */
TEST(an_elbow_moves_the_upper_arm_and_bends_by_160_degrees) {
    MdtWorldID world = MdtWorldCreate(2, 1);
    MdtWorldSetAutoDisable(world, 0);
    MdtBodyID upperArm = MdtBodyCreate(world), forearm = MdtBodyCreate(world);
    MdtBodySetPosition(upperArm, -.5, 0, 0);
    MdtBodySetPosition(forearm, .5, 0, 0);
    MdtHingeID elbow = MdtHingeCreate(world);
    MdtHingeSetBodies(elbow, forearm, upperArm);
    MdtHingeSetPosition(elbow, 0, 0, 0);
    MdtHingeSetAxis(elbow, 0, 0, 1);
    MdtLimitID limit = MdtHingeGetLimit(elbow);
    const double max = 160 * PI / 180;
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(limit), 0);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(limit), max);
    MdtSingleLimitSetRestitution(MdtLimitGetLowerLimit(limit), 0);
    MdtSingleLimitSetRestitution(MdtLimitGetUpperLimit(limit), 0);
    MdtLimitActivateLimits(limit, 1);
    MdtHingeEnable(elbow);
    MdtBodyEnable(upperArm);
    MdtBodyEnable(forearm);
    for (int i = 0; i < 200; i++) {
        MdtBodyAddTorque(forearm, 0, 0, 1);
        MdtBodyAddTorque(upperArm, 0, 0, -1);
        MdtWorldStep(world, 0.01);
        const double bend = MdtLimitGetPosition(limit);
        ck_assert_msg(bend > -1e-4 && bend < max + 1e-4, "bent by %g", bend);
    }
    assert_near(MdtLimitGetPosition(limit), max, TOL(3e-6, 6e-7));
    for (int i = 0; i < 100; i++) { /* pull the forearm away */
        MdtBodyAddForce(forearm, 10, 0, 0);
        MdtWorldStep(world, 0.01);
    }
    assert_near(velocity(upperArm, 0) + velocity(forearm, 0), 10, TOL(1e-5, 9e-13));
    ck_assert(velocity(upperArm, 0) > 1);
    MdtWorldDestroy(world);
}

/* "Contact Constraints and Collision Detection": a stone falls onto the floor and stops when it strikes it; the
 * rebound is adjusted by the restitution. Without restitution it stops, but for the speed with which gamma pushes it
 * out of the overlap that it has come to, at most gamma times the speed of the impact: it may rise to gamma² of its
 * height. */
TEST(a_stone_stops_or_rebounds_on_the_floor) {
    const double restitutions[] = {0, .4, .8};
    for (int k = 0; k < 3; k++) {
        MdtWorldID world = MdtWorldCreate(1, 1);
        MdtWorldSetAutoDisable(world, 0);
        MdtWorldSetGravity(world, 0, -(MeReal)9.8, 0);
        MdtBodyID stone = MdtBodyCreate(world);
        MdtBodySetPosition(stone, 0, 2, 0);
        MdtBodyEnable(stone);
        MdtContactID contact = 0;
        double top = 0;
        MeBool struck = 0;
        for (int i = 0; i < 1200; i++) {
            const double depth = -coordinate(stone, 1);
            if (contact)
                MdtContactDestroy(contact);
            contact = 0;
            if (depth > 0) {
                contact = MdtContactCreate(world);
                MdtContactSetBodies(contact, stone, 0);
                MdtContactSetPosition(contact, 0, 0, 0);
                MdtContactSetNormal(contact, 0, 1, 0); /* perpendicular to the local contact plane */
                MdtContactSetPenetration(contact, depth);
                MdtContactParamsSetRestitution(MdtContactGetParams(contact), restitutions[k]);
                MdtContactEnable(contact);
                struck = 1;
            }
            MdtWorldStep(world, 0.001);
            if (struck)
                top = fmax(top, coordinate(stone, 1));
        }
        if (restitutions[k] == 0)
            assert_below(top, 2 * .2 * .2);
        else /* the impact is met within a step, so the height is right to a few mm */
            assert_near(top, 2 * restitutions[k] * restitutions[k], .008);
        MdtWorldDestroy(world);
    }
}

/* "Partitioning the World": all bodies of a list are constrained to at least one other of it, and to none of another
 * list; forces from outside are ignored. */
TEST(partitions_are_lists_of_bodies_constrained_together) {
    MdtWorldID world = MdtWorldCreate(10, 10);
    MdtBodyID body[10];
    for (int i = 0; i < 10; i++) {
        body[i] = MdtBodyCreate(world);
        MdtBodySetPosition(body[i], (MeReal)i, 0, 0);
        MdtBodyEnable(body[i]);
        if (i % 5) { /* two chains of five */
            MdtBSJointID link = MdtBSJointCreate(world);
            MdtBSJointSetBodies(link, body[i - 1], body[i]);
            MdtBSJointSetPosition(link, i - .5, 0, 0);
            MdtBSJointEnable(link);
        }
    }
    MdtBodyAddForce(body[4], 5, 0, 0); /* from one chain on the other */
    MdtBodyAddForce(body[5], -5, 0, 0);
    MdtWorldStep(world, 0.01);
    for (int i = 0; i < 10; i++)
        for (int k = 0; k < 10; k++)
            ck_assert_int_eq(MdtBodyGetPartition(body[i]) == MdtBodyGetPartition(body[k]), i / 5 == k / 5);
    MdtWorldDestroy(world);
}

/* "Disabling Bodies": a body that does not move is disabled; it is not enough to disable a body to keep it from
 * moving, since others that collide with it or are constrained to it bring it to life. */
TEST(stationary_bodies_are_disabled_and_come_to_life_when_struck) {
    MdtWorldID world = MdtWorldCreate(2, 1);
    MdtBodyID still = MdtBodyCreate(world), ball = MdtBodyCreate(world);
    MdtBodyEnable(still);
    for (int i = 0; i < 60; i++)
        MdtWorldStep(world, 0.01);
    ck_assert(!MdtBodyIsEnabled(still));
    MdtBodySetPosition(ball, 0, 2, 0);
    MdtBodySetLinearVelocity(ball, 0, -3, 0);
    MdtBodyEnable(ball);
    MdtWorldStep(world, 0.01);
    ck_assert(!MdtBodyIsEnabled(still)); /* not struck yet */
    MdtContactID contact = MdtContactCreate(world);
    MdtContactSetBodies(contact, ball, still);
    MdtContactSetPosition(contact, 0, 1, 0);
    MdtContactSetNormal(contact, 0, 1, 0);
    MdtContactEnable(contact);
    MdtWorldStep(world, 0.01);
    ck_assert(MdtBodyIsEnabled(still));
    assert_near(velocity(still, 1), -1.5, TOL(2e-6, 2e-13)); /* they share the momentum */
    MdtWorldDestroy(world);
}
