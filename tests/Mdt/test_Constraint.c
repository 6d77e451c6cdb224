/* What all constraints share: life, attachment, frames, casts, bookkeeping. */
#include "scene.h"

TEST(frames_are_given_in_the_world_and_move_with_the_bodies) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtBodyID a = scene_body(w, 1, 1, 0, 0), b = scene_body(w, 1, 0, 3, 0);
    MdtHingeID j = MdtHingeCreate(w);
    MdtConstraintID c = MdtHingeQuaConstraint(j);
    MeVector3 p, o;
    MdtHingeSetBodies(j, a, b);
    MdtHingeSetPosition(j, 2, 2, 2);
    MdtConstraintSetAxes(c, 0, 0, 5, 3, 0, 3); /* normalized, made orthogonal */
    MdtConstraintGetAxes(c, p, o);
    assert_vec3_near(p, 0, 0, 1, TOL(1e-6, 9e-14));
    assert_vec3_near(o, 1, 0, 0, TOL(1e-6, 9e-14));
    MdtBodySetPosition(b, 10, 3, 0);
    MdtBodySetQuaternion(b, sqrt(.5), sqrt(.5), 0, 0); /* y to z */
    MdtConstraintBodyGetPosition(c, 0, p);
    assert_vec3_near(p, 2, 2, 2, TOL(1e-6, 2e-13));
    MdtConstraintBodyGetPosition(c, 1, p); /* was (2, -1, 2) from b */
    assert_vec3_near(p, 12, 1, -1, TOL(1e-5, 2e-12));
    MdtConstraintBodyGetPositionRel(c, 1, p);
    assert_vec3_near(p, 2, -1, 2, TOL(1e-6, 2e-13));
    MdtConstraintBodyGetAxes(c, 1, p, o);
    assert_vec3_near(p, 0, -1, 0, TOL(1e-6, 9e-14));
    MdtConstraintBodyGetAxis(c, 1, p);
    assert_vec3_near(p, 0, -1, 0, TOL(1e-6, 9e-14));
    MdtHingeGetAxis(j, p);
    assert_vec3_near(p, 0, 0, 1, TOL(1e-6, 9e-14));
    MdtConstraintBodySetPositionRel(c, 0, 1, 1, 1);
    MdtHingeGetPosition(j, p);
    assert_vec3_near(p, 2, 1, 1, TOL(1e-6, 2e-13));
    MdtConstraintBodySetAxesRel(c, 0, 0, 1, 0, 1, 0, 0);
    MdtConstraintBodyGetAxesRel(c, 0, p, o);
    assert_vec3_near(p, 0, 1, 0, TOL(1e-6, 9e-14));
    assert_vec3_near(o, 1, 0, 0, TOL(1e-6, 9e-14));
    MdtConstraintBodySetBothAxis(c, 0, 1, 0, 0, 0, 1, 0); /* the deprecated names */
    MdtConstraintBodyGetBothAxes(c, 0, p, o);
    assert_vec3_near(p, 1, 0, 0, TOL(1e-6, 9e-14));
}

TEST(a_constraint_acts_only_when_enabled) {
    MdtWorldID w = scene_world(1, 1, 10);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0);
    MdtBSJointID j = MdtBSJointCreate(w);
    MeVector3 v;
    MdtBSJointSetBodies(j, a, 0);
    MdtWorldStep(w, .1);
    MdtBodyGetLinearVelocity(a, v);
    assert_near(v[1], -1, TOL(1e-6, 9e-14));
}

TEST(a_moving_world_drags_a_joint_along) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0);
    MdtBSJointID j = MdtBSJointCreate(w);
    MeVector3 v;
    MdtBSJointSetBodies(j, a, 0);
    MdtConstraintSetWorldLinearVelocity(MdtBSJointQuaConstraint(j), 1, 2, 3);
    MdtConstraintGetWorldLinearVelocity(MdtBSJointQuaConstraint(j), v);
    assert_vec3_near(v, 1, 2, 3, 0);
    MdtBSJointEnable(j);
    MdtWorldStep(w, FRAME);
    MdtBodyGetLinearVelocity(a, v);
    assert_vec3_near(v, 1, 2, 3, TOL(3e-6, 8e-13));
    MdtConstraintSetWorldAngularVelocity(MdtBSJointQuaConstraint(j), 1, 0, 0);
    MdtConstraintGetWorldAngularVelocity(MdtBSJointQuaConstraint(j), v);
    assert_vec3_near(v, 1, 0, 0, 0);
}

TEST(changing_the_bodies_of_an_enabled_constraint_warns_and_does_it) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0), b = scene_body(w, 1, 0, 0, 0);
    MdtBSJointID j = MdtBSJointCreate(w);
    MdtBSJointSetBodies(j, a, 0);
    MdtBSJointEnable(j);
    MdtBSJointSetBodies(j, b, a);
    assert_warned("disable it");
    ck_assert(MdtBSJointGetBody(j, 0) == b && MdtBSJointGetBody(j, 1) == a && MdtBSJointIsEnabled(j));
}

TEST(contacts_form_lists_of_their_makers) {
    MdtWorldID w = scene_world(1, 2, 0);
    MdtContactID a = MdtContactCreate(w), b = MdtContactCreate(w);
    MdtContactSetNext(a, b);
    ck_assert(MdtContactGetNext(a) == b && MdtContactGetNext(b) == MdtContactInvalidID);
    MdtContactSetNext(a, MdtContactInvalidID);
    ck_assert(MdtContactGetNext(a) == MdtContactInvalidID);
}
