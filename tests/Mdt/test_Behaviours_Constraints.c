/* Documented behaviours: what all constraints share (Dynamics guide ch. 3, "Common Constraint Functions",
 * "Base Constraint Functions").
 *
 * Already proved elsewhere:
 *   a created constraint acts only after Enable             test_Constraint: a_constraint_acts_only_when_enabled
 *   a second body of null is the world                      test_Order: the_sag_of_a_load_is_epsilon_force_over_gamma
 *   it has to be disabled before its bodies change; a warning  test_Constraint: changing_the_bodies_of_an_enabled_...
 *   MdtConstraintSetAxes normalizes and makes orthogonal    test_Constraint: frames_are_given_in_the_world_...
 *   reset brings the defaults of each type back             test_JointLife: reset_restores_the_defaults_and_...
 *   positions and axes are the world's and move with bodies  test_Constraint: frames_are_given_in_the_world_...
 *   forces and torques are opposite on the two bodies       test_Joints: forces_are_opposite
 */
#include "behaviour.h"

/* Ch. 3, MdtConstraintSetAxes: the third axis is the cross product of the two, so the pair is a full orientation. */
TEST(two_axes_make_a_right_handed_frame) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0);
    MdtRPROJointID j = MdtRPROJointCreate(w);
    MdtConstraintID c = MdtRPROJointQuaConstraint(j);
    MeVector4 q;
    MdtRPROJointSetBodies(j, a, 0);
    MdtConstraintBodySetAxes(c, 0, 0, 7, 0, 0, 0, 2); /* x to y, y to z, so the third is x: a third of a turn */
    MdtRPROJointGetAttachmentQuaternion(j, 0, q);
    const double sign = q[0] < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++)
        assert_near(sign * (double)q[i], .5, TOL(5e-7, 5e-14));
}
