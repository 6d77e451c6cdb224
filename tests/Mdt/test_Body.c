/* Bodies: defaults, every accessor against its mutator, frames and the centre of mass. */
#include "scene.h"

TEST(a_new_body_has_the_guide_s_defaults) {
    MdtWorldID w = MdtWorldCreate(1, 0);
    MdtBodyID b = MdtBodyCreate(w);
    MeVector3 v;
    MeVector4 q;
    MeMatrix3 I;
    ck_assert(!MdtBodyIsEnabled(b) && MdtBodyGetMass(b) == 1);
    MdtBodyGetInertiaTensor(b, I);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            assert_near(I[i][j], i == j ? .4 : 0, TOL(1e-7, 9e-14));
    MdtBodyGetPosition(b, v);
    assert_vec3_near(v, 0, 0, 0, 0);
    MdtBodyGetQuaternion(b, q);
    ck_assert(q[0] == 1 && q[1] == 0 && q[2] == 0 && q[3] == 0);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            ck_assert(MdtBodyGetTransformPtr(b)[i][j] == (i == j));
    MdtBodyGetFastSpinAxis(b, v);
    assert_vec3_near(v, 0, 1, 0, 0);
    void (*const zeros[])(const MdtBodyID, MeVector3) = {MdtBodyGetForce,
                                                         MdtBodyGetTorque,
                                                         MdtBodyGetLinearVelocity,
                                                         MdtBodyGetAngularVelocity,
                                                         MdtBodyGetLinearAcceleration,
                                                         MdtBodyGetAngularAcceleration,
                                                         MdtBodyGetCenterOfMassRelativePosition};
    for (int i = 0; i < 7; i++) {
        v[0] = v[1] = v[2] = 9;
        zeros[i](b, v);
        assert_vec3_near(v, 0, 0, 0, 0);
    }
    ck_assert(MdtBodyGetLinearVelocityDamping(b) == 0 && MdtBodyGetAngularVelocityDamping(b) == 0);
    ck_assert(MdtBodyGetUserData(b) == NULL && MdtBodyGetSortKey(b) == 0 && MdtBodyGetWorld(b) == w);
    ck_assert(MdtBodyGetSafeTime(b) == MEINFINITY && MdtBodyGetPartition(b) == -1);
    ck_assert(MdtBodyNonSphericalInertiaIsEnabled(b) && MdtBodyCoriolisForceIsEnabled(b));
    MdtWorldDestroy(w);
}

TEST(scales_set_the_default_mass_and_inertia) {
    MdtWorldID w = MdtWorldCreate(1, 0, 2, 3);
    MdtBodyID b = MdtBodyCreate(w);
    MeMatrix3 I;
    MdtBodyGetInertiaTensor(b, I);
    assert_near(MdtBodyGetMass(b), 3, 0);
    assert_near(I[1][1], .4 * 3 * 4, TOL(1e-6, 5e-13));
    MdtWorldDestroy(w);
}

TEST(what_is_set_is_got) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = MdtBodyCreate(w);
    MeVector3 v;
    int data;
    MdtBodySetMass(b, 7);
    MdtBodySetLinearVelocity(b, 1, 2, 3);
    MdtBodySetAngularVelocity(b, 4, 5, 6);
    MdtBodySetLinearVelocityDamping(b, .25);
    MdtBodySetAngularVelocityDamping(b, .5);
    MdtBodySetUserData(b, &data);
    MdtBodySetSortKey(b, 2147483647);
    MdtBodySetSafeTime(b, .125);
    MdtBodySetFastSpinAxis(b, 0, 0, 5);
    ck_assert(MdtBodyGetMass(b) == 7 && MdtBodyGetUserData(b) == &data && MdtBodyGetSortKey(b) == 2147483647);
    ck_assert(MdtBodyGetLinearVelocityDamping(b) == (MeReal).25 && MdtBodyGetAngularVelocityDamping(b) == (MeReal).5);
    ck_assert(MdtBodyGetSafeTime(b) == (MeReal).125);
    MdtBodyGetLinearVelocity(b, v);
    assert_vec3_near(v, 1, 2, 3, 0);
    MdtBodyGetAngularVelocity(b, v);
    assert_vec3_near(v, 4, 5, 6, TOL(1e-6, 1e-14));
    MdtBodyGetFastSpinAxis(b, v);
    assert_vec3_near(v, 0, 0, 1, 0);
    MdtBodySetNoFastSpinAxis(b);
    MdtBodyGetFastSpinAxis(b, v);
    assert_vec3_near(v, 0, 1, 0, 0);
    MdtBodySetSphericalInertiaTensor(b, 3);
    assert_near(MdtBodyGetKineticEnergy(b), .5 * 7 * 14 + .5 * 3 * 77, TOL(1e-4, 1e-12));
}

/* Position, quaternion, orientation matrix and transform are one thing in four forms. */
TEST(the_four_forms_of_a_pose_agree) {
    MdtWorldID w = scene_world(2, 0, 0);
    MdtBodyID a = MdtBodyCreate(w), b = MdtBodyCreate(w);
    MeMatrix3 R;
    MeMatrix4 tm;
    MeVector4 q;
    MdtBodySetPosition(a, 1, 2, 3);
    MdtBodySetQuaternion(a, 3, -1, 2, .5); /* normalized */
    MdtBodyGetOrientation(a, R);
    MdtBodyGetTransform(a, tm);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            ck_assert(tm[i][j] == R[j][i]); /* OpenGL's layout: the transposed */
    ck_assert(tm[3][0] == 1 && tm[3][1] == 2 && tm[3][2] == 3 && tm[3][3] == 1 && tm[0][3] == 0);
    MdtBodyGetQuaternion(a, q);
    const double length = sqrt(9 + 1 + 4 + .25);
    assert_near(q[0], 3 / length, TOL(1e-6, 8e-14));
    assert_near(q[3], .5 / length, TOL(2e-7, 2e-14));
    MdtBodySetTransform(b, tm);
    MeMatrix4 other;
    MdtBodyGetTransform(b, other);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            assert_near(other[i][j], tm[i][j], TOL(3e-7, 1e-15));
    MdtBodySetPosition(b, 0, 0, 0);
    MdtBodySetOrientation(b, R);
    MdtBodyGetQuaternion(b, q);
    assert_near(q[1], -1 / length, TOL(3e-7, 3e-14));
}

/* y = X + R x: a quarter turn about z takes the body's x to the world's y. */
TEST(rotations_turn_by_the_right_hand_rule) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = MdtBodyCreate(w);
    MeMatrix3 R;
    MdtBodySetQuaternion(b, sqrt(.5), 0, 0, sqrt(.5));
    MdtBodyGetOrientation(b, R);
    assert_near(R[1][0], 1, TOL(1e-6, 9e-14));
    assert_near(R[0][0], 0, TOL(1e-6, 9e-14));
    assert_near(MdtBodyGetTransformPtr(b)[0][1], 1, TOL(1e-6, 9e-14));
}

TEST(the_transform_pointer_follows_every_step) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(b);
    MdtBodySetLinearVelocity(b, 6, 0, 0);
    for (int i = 1; i <= 5; i++) {
        MdtWorldStep(w, .5);
        assert_near(tm[3][0], 3 * i, TOL(1e-6, 2e-12));
    }
}

/* A body whose centre of mass is beside its frame spins about the centre of mass. */
TEST(the_centre_of_mass_may_lie_beside_the_frame) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 1, 5, 0, 0);
    const MeVector3 offset = {1, 0, 0};
    MeVector3 p;
    MdtBodySetCenterOfMassRelativePosition(b, offset);
    MdtBodyGetPosition(b, p);
    assert_vec3_near(p, 5, 0, 0, 0); /* the frame stays */
    MdtBodyGetCenterOfMassPosition(b, p);
    assert_vec3_near(p, 6, 0, 0, 0);
    MdtBodySetAngularVelocity(b, 0, 0, 2);
    steps(w, 60, FRAME);
    MdtBodyGetCenterOfMassPosition(b, p);
    assert_vec3_near(p, 6, 0, 0, TOL(1e-6, 1e-12));
    const double angle = 2 * 60 * (double)FRAME;
    MdtBodyGetPosition(b, p);
    assert_vec3_near(p, 6 - cos(angle), -sin(angle), 0, TOL(1e-6, 6e-13));
    MdtBodySetPosition(b, 0, 0, 0);
    MdtBodyGetCenterOfMassPosition(b, p);
    assert_vec3_near(p, cos(angle), sin(angle), 0, TOL(1e-6, 9e-14));
    const MeVector3 home = {0, 0, 0};
    MdtBodySetCenterOfMassPosition(b, home);
    MdtBodyGetPosition(b, p);
    assert_vec3_near(p, -cos(angle), -sin(angle), 0, TOL(1e-6, 9e-14));
    assert_near(MdtBodyGetCenterOfMassTransformPtr(b)[3][0], 0, 0);
}

TEST(the_centre_of_mass_may_be_turned) {
    MdtWorldID w = scene_world(2, 0, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MeMatrix4 t = {{0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 2, 1}}, back; /* x to y */
    const MeMatrix3 inertia = {{1, 0, 0}, {0, 5, 0}, {0, 0, 5}};
    MdtBodySetInertiaTensor(b, inertia);
    MdtBodySetCenterOfMassRelativeTransform(b, t);
    MdtBodyGetCenterOfMassRelativeTransform(b, back);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            assert_near(back[i][j], t[i][j], TOL(1e-6, 2e-13));
    MdtBodyAddTorque(b, 0, 1, 0); /* about the light axis */
    MdtWorldStep(w, 1);
    MeVector3 v;
    MdtBodyGetAngularVelocity(b, v);
    assert_vec3_near(v, 0, 1, 0, TOL(1e-6, 9e-14));
}

/* What is attached to the body's frame stays there when the centre of mass moves. */
TEST(moving_the_centre_of_mass_keeps_attachments) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtBodyID b = scene_body(w, 1, 3, 0, 0);
    const MeVector3 offset = {.5, 1, 0};
    MeVector3 p;
    MdtHingeID j = MdtHingeCreate(w);
    MdtHingeSetBodies(j, b, 0);
    MdtHingeSetPosition(j, 4, 1, 2);
    MdtHingeSetAxis(j, 0, 1, 1);
    MdtBodySetCenterOfMassRelativePosition(b, offset);
    MdtHingeGetPosition(j, p);
    assert_vec3_near(p, 4, 1, 2, TOL(1e-6, 4e-13));
    MdtHingeGetAxis(j, p);
    assert_vec3_near(p, 0, sqrt(.5), sqrt(.5), TOL(1e-6, 9e-14));
}

TEST(velocity_at_a_point_turns_with_the_body) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 1, 1, 0, 0);
    MeVector3 p = {3, 0, 0}, v;
    MdtBodySetLinearVelocity(b, 0, 0, 4);
    MdtBodySetAngularVelocity(b, 0, 0, 5);
    MdtBodyGetVelocityAtPoint(b, p, v);
    assert_vec3_near(v, 0, 10, 4, TOL(1e-5, 9e-13));
}

/* Changing mass, inertia or pose leaves the velocities alone. */
TEST(velocities_survive_what_is_set_about_them) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    const MeMatrix3 I = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
    MeVector3 v;
    MdtBodySetAngularVelocity(b, 1, 2, 3);
    MdtBodySetInertiaTensor(b, I);
    MdtBodySetQuaternion(b, 1, 1, 0, 0);
    MdtBodySetMass(b, 4);
    MdtBodySetPosition(b, 9, 9, 9);
    MdtBodyGetAngularVelocity(b, v);
    assert_vec3_near(v, 1, 2, 3, TOL(1e-6, 3e-13));
}

TEST(velocities_may_be_written_through_their_pointers) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MeReal *v = MdtBodyGetLinearVelocityPtr(b), *omega = MdtBodyGetAngularVelocityPtr(b);
    v[0] = 3;
    omega[2] = 1;
    MdtWorldStep(w, 1);
    assert_near(MdtBodyGetTransformPtr(b)[3][0], 3, TOL(1e-6, 3e-13));
    assert_near(MdtBodyGetTransformPtr(b)[0][1], sin(1), TOL(1e-6, 8e-14));
    v[0] = (MeReal)NAN;
    MdtWorldStep(w, 1);
    assert_warned("not finite");
    assert_near(v[0], 3, 0);
    assert_near(MdtBodyGetTransformPtr(b)[3][0], 6, TOL(1e-5, 6e-13));
}

TEST(accelerations_are_those_of_the_last_step) {
    MdtWorldID w = scene_world(1, 0, 9);
    MdtBodyID b = scene_body(w, 2, 0, 0, 0);
    MeVector3 a;
    MdtBodyAddForce(b, 8, 0, 0);
    MdtBodyAddTorque(b, 0, .8, 0);
    MdtWorldStep(w, FRAME);
    MdtBodyGetLinearAcceleration(b, a);
    assert_vec3_near(a, 4, -9, 0, TOL(1e-5, 8e-13));
    MdtBodyGetAngularAcceleration(b, a);
    assert_vec3_near(a, 0, 2, 0, TOL(2e-6, 2e-13));
}

/* Forces on a body that is not simulated add up, and act for one step when it is. */
TEST(forces_wait_for_a_disabled_body) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = MdtBodyCreate(w);
    MeVector3 v;
    for (int i = 0; i < 10; i++) {
        MdtBodyAddForce(b, 1, 0, 0);
        MdtWorldStep(w, .1);
    }
    MdtBodyGetForce(b, v);
    assert_vec3_near(v, 10, 0, 0, 0);
    MdtBodyGetLinearVelocity(b, v);
    assert_vec3_near(v, 0, 0, 0, 0);
    MdtBodyEnable(b);
    steps(w, 3, .1);
    MdtBodyGetLinearVelocity(b, v);
    assert_vec3_near(v, 1, 0, 0, TOL(1e-6, 9e-14));
    MdtBodyAddImpulse(b, 5, 0, 0);
    MdtBodyResetImpulses(b);
    MdtWorldStep(w, .1);
    MdtBodyGetLinearVelocity(b, v);
    assert_vec3_near(v, 1, 0, 0, TOL(1e-6, 9e-14));
}

TEST(a_copy_has_everything_but_constraints) {
    MdtWorldID w = scene_world(3, 2, 0), other = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 3, 1, 2, 3);
    MdtBSJointID j = MdtBSJointCreate(w);
    MdtBSJointSetBodies(j, b, 0);
    MdtBodySetLinearVelocity(b, 4, 5, 6);
    MdtBodySetSortKey(b, 7);
    MdtBodyID copies[] = {MdtBodyCopy(b, w), MdtBodyCopy(b, other)};
    for (int i = 0; i < 2; i++) {
        MeVector3 v;
        MdtBodyGetPosition(copies[i], v);
        assert_vec3_near(v, 1, 2, 3, 0);
        MdtBodyGetLinearVelocity(copies[i], v);
        assert_vec3_near(v, 4, 5, 6, 0);
        ck_assert(MdtBodyGetMass(copies[i]) == 3 && MdtBodyIsEnabled(copies[i]) && MdtBodyGetSortKey(copies[i]) == 7);
        ck_assert(MdtBodyGetFirstConstraint(copies[i]) == NULL && MdtBodyGetWorld(copies[i]) == (i ? other : w));
    }
    ck_assert_int_eq(MdtWorldGetEnabledBodies(w), 2);
    ck_assert_int_eq(MdtWorldGetEnabledBodies(other), 1);
}

TEST(reset_brings_the_defaults_back) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 3, 1, 2, 3);
    MeVector3 v;
    MdtBodySetLinearVelocity(b, 4, 5, 6);
    MdtBodySetLinearVelocityDamping(b, 1);
    MdtBodyAddForce(b, 1, 1, 1);
    MdtBodySetSortKey(b, 5);
    MdtBodyReset(b);
    MdtBodyGetPosition(b, v);
    assert_vec3_near(v, 0, 0, 0, 0);
    MdtBodyGetLinearVelocity(b, v);
    assert_vec3_near(v, 0, 0, 0, 0);
    MdtBodyGetForce(b, v);
    assert_vec3_near(v, 0, 0, 0, 0);
    ck_assert(MdtBodyGetMass(b) == 1 && MdtBodyGetLinearVelocityDamping(b) == 0);
    ck_assert(MdtBodyIsEnabled(b) && MdtBodyGetSortKey(b) == 5);
}

static void countCall(const MdtConstraintID c, void *count) {
    (void)c;
    ++*(int *)count;
}

TEST(a_body_knows_its_constraints) {
    MdtWorldID w = scene_world(2, 4, 0);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0), b = scene_body(w, 1, 0, 0, 0);
    MdtBSJointID joint = MdtBSJointCreate(w);
    MdtContactID c1 = MdtContactCreate(w, a, b), c2 = MdtContactCreate(w, 0, a);
    MdtBSJointSetBodies(joint, b, a);
    int count = 0;
    for (MdtConstraintID c = MdtBodyGetFirstConstraint(a); c; c = MdtBodyGetNextConstraint(a, c))
        count++;
    ck_assert_int_eq(count, 3);
    count = 0;
    for (MdtContactID c = MdtBodyGetFirstContact(a); c; c = MdtBodyGetNextContact(a, c))
        count++;
    ck_assert_int_eq(count, 2);
    count = 0;
    MdtBodyForAllConstraints(b, countCall, &count);
    ck_assert_int_eq(count, 2);
    MdtBSJointEnable(joint);
    MdtContactEnable(c1);
    MdtContactEnable(c2);
    MdtBodyDisableContacts(a);
    ck_assert_int_eq(MdtWorldGetEnabledConstraints(w), 1);
    MdtBodyDisableConstraints(a);
    ck_assert_int_eq(MdtWorldGetEnabledConstraints(w), 0);
    MdtBodyDestroyContacts(a);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(w), 1);
    MdtBodyDestroy(b); /* the joint lets go of it and stays */
    ck_assert_int_eq(MdtWorldGetTotalConstraints(w), 1);
    ck_assert(MdtBSJointGetBody(joint, 0) == NULL && MdtBSJointGetBody(joint, 1) == a);
    MdtBodyDestroyConstraints(a);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(w), 0);
}

TEST(inertia_tensors_of_solids) {
    MeMatrix3 I;
    MdtMakeInertiaTensorSphere(5, 2, I);
    assert_near(I[0][0], .4 * 5 * 4, TOL(1e-6, 8e-13));
    assert_near(I[0][1], 0, 0);
    MdtMakeInertiaTensorBox(12, 1, 2, 3, I);
    assert_near(I[0][0], 13, TOL(1e-5, 2e-12));
    assert_near(I[1][1], 10, TOL(1e-5, 9e-13));
    assert_near(I[2][2], 5, TOL(5e-6, 5e-13));
}

TEST(vectors_change_frames) {
    MdtWorldID w = scene_world(2, 0, 0);
    MdtBodyID a = MdtBodyCreate(w), b = MdtBodyCreate(w);
    MdtBodySetPosition(a, 1, 0, 0);
    MdtBodySetQuaternion(a, sqrt(.5), 0, 0, sqrt(.5)); /* x to y */
    MdtBodySetPosition(b, 0, 0, 5);
    MeVector3 f = {2, 0, 0}, t;
    MdtConvertPositionVector(a, f, 0, t);
    assert_vec3_near(t, 1, 2, 0, TOL(1e-6, 2e-13));
    MdtConvertPositionVector(a, f, b, t);
    assert_vec3_near(t, 1, 2, -5, TOL(1e-6, 5e-13));
    MdtConvertVector(0, f, a, t);
    assert_vec3_near(t, 0, -2, 0, TOL(1e-6, 2e-13));
    MdtConvertPositionVector(0, t, 0, t);
    assert_vec3_near(t, 0, -2, 0, TOL(1e-6, 2e-13));
}

/* In single precision a body was at -inf while its double state was finite. */
TEST(a_body_stops_at_the_bound_of_positions) {
    const double bound = TOL(16777216, 9007199254740992);
    MdtWorldID w = scene_world(1, 0, 10);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MeVector3 p, v;
    ck_assert((double)MdtBodyGetPositionBound(b) == bound);
    for (int k = 0; k < 2; k++) {
        MdtBodySetPosition(b, 1, 2, 3);
        MdtBodySetLinearVelocity(b, k ? 2e18 : 0, -3e38, 0);
        for (int i = 0; i < 3; i++) {
            MdtWorldStep(w, FRAME);
            MdtBodyGetPosition(b, p);
            ck_assert((double)p[1] == -bound);
            MdtBodyGetLinearVelocity(b, v);
            ck_assert(v[1] == 0);
        }
        ck_assert((double)p[0] == (k ? bound : 1) && p[2] == 3);
        ck_assert_int_eq(caught.warnings, 1);
        assert_warned("MdtWorldStep");
    }
    assert_refused(MdtBodySetPosition, b, 0, 1.1 * bound, 0);
    MdtBodyGetPosition(b, p);
    ck_assert((double)p[1] == -bound);
}
