/* Documented behaviours: single joints (Dynamics guide ch. 3).
 *
 * Already proved elsewhere:
 *   hinge: the angle counts full turns                         test_Hinge: the_angle_counts_full_turns
 *   hinge: limits may lie beyond ±pi, and none is missed       test_Hinge: stops_lie_beyond_full_turns
 *   each joint removes its freedoms and no others              test_Joints: removed_freedoms_stay_removed_and_...
 *   prismatic: it reads zero where the axis was set            test_Prismatic: zero_is_where_the_bodies_were_...
 *   angular: orientation, axis, spring                         test_Angular3
 *   car wheel: suspension, its stops, lock, hinge angle        test_CarWheel
 *   fixed path: with and without the velocity, forces          test_FixedPath
 *   RPRO: driven by quaternion and rate, up to its strength    test_RPROJoint
 *   spring: spring, rod, string and elastic, defaults          test_Spring
 *   cone limit: rows, side, twist, pi                          test_ConeLimit
 *   skeletal: both angles of the cone, the twist               test_Skeletal
 */
#include "behaviour.h"

/* The angle of the turn that takes the orientation of a to that of b. */
static double turnBetween(MdtBodyID a, MdtBodyID b) {
    MeVector4 p, q = {1, 0, 0, 0};
    double w = 0, x[3] = {0};
    MdtBodyGetQuaternion(a, p);
    if (b)
        MdtBodyGetQuaternion(b, q);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        w += (double)p[i + 1] * q[i + 1];
        x[i] = (double)p[0] * q[i + 1] - (double)q[0] * p[i + 1] - (double)p[j + 1] * q[k + 1] +
               (double)p[k + 1] * q[j + 1];
    }
    w += (double)p[0] * q[0];
    return 2 * atan2(sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), fabs(w));
}

/* How far a body that is held at its centre of mass turns away from a free one in two seconds of a torque. */
static double turnOfHeld(int subSteps) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtWorldSetSubSteps(w, subSteps);
    const double edges[3] = {1, .6, .4};
    MdtBodyID held = scene_box(w, 1, edges, 0, 0, 0), loose = scene_box(w, 1, edges, 5, 0, 0);
    scene_ball(w, held, 0, 0, 0, 0);
    for (int i = 0; i < 120; i++) {
        MdtBodyAddTorque(held, .1, .2, -.1);
        MdtBodyAddTorque(loose, .1, .2, -.1);
        MdtWorldStep(w, FRAME);
    }
    assert_position(held, 0, 0, 0, TOL(1e-6, 9e-14));
    return turnBetween(held, loose);
}

/* "BSJoint": all rotations are free: a body held at its centre of mass turns as a free one does, but for the Cayley
 * map of bodies in joints, a relative error of (ω h)²/12 in the angle, which falls with the square of the step. */
TEST(a_ball_and_socket_leaves_all_rotations_free) {
    const double coarse = turnOfHeld(1), fine = turnOfHeld(4);
    assert_below(coarse, .01);
    assert_near(coarse / fine, 16, TOL(.02, .04));
}
