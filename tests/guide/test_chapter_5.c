/* Dynamics guide, chapter 5, "Constructing Good Simulations", section by section. */
#include "Mdt/behaviour.h"

/* "Background": the inaccuracy of an explicit integrator may let a system explode; of a semi-implicit one it lets the
 * energy fall. Here a chain that falls from the horizontal, and could fall through 360 J, never has more than it began
 * with, and loses less than half a percent, although it cracks like a whip. */
TEST(a_closed_system_does_not_explode) {
    for (int rate = 60; rate <= 120; rate += 60) {
        MdtWorldID w = scene_world(6, 6, 10);
        MdtBodyID last = 0, link[6];
        for (int i = 0; i < 6; i++) {
            link[i] = scene_body(w, 1, i + .5, 0, 0);
            scene_ball(w, link[i], last, i, 0, 0);
            last = link[i];
        }
        for (int i = 0; i < 10 * rate; i++) {
            MdtWorldStep(w, 1. / rate);
            double energy = 0;
            for (int k = 0; k < 6; k++)
                energy += (double)MdtBodyGetKineticEnergy(link[k]) + 10 * coordinate(link[k], 1);
            assert_below(energy, TOL(1e-4, 1e-9)); /* it began with 0 */
            assert_below(-energy, .005 * 360);
        }
    }
}

/* "Mass Problems": the whip, heavy at the handle and light at the tip, in "a ratio of 100:1 ... reasonable in single
 * precision". Its flick ends as it should: the tip is fast, and all of it stays together. */
TEST(mass_problems) {
    MdtWorldID w = scene_world(5, 5, 0);
    MdtWorldSetEpsilon(w, 0);
    const double masses[] = {100, 31.6, 10, 3.16, 1};
    MdtBodyID link[5], last = 0;
    MdtBSJointID joint[5];
    for (int i = 0; i < 5; i++) {
        link[i] = scene_body(w, masses[i], i + .5, 0, 0);
        MdtBodySetSphericalInertiaTensor(link[i], masses[i] / 12);
        joint[i] = scene_ball(w, link[i], last, i, 0, 0);
        last = link[i];
    }
    double fastest = 0;
    for (int i = 0; i < 240; i++) {
        if (i < 30)
            MdtBodyAddTorque(link[0], 0, 0, 600);
        MdtWorldStep(w, FRAME);
        fastest = fmax(fastest, hypot(velocity(link[4], 0), velocity(link[4], 1)));
        for (int k = 0; k < 5; k++)
            assert_near(gapOf(MdtBSJointQuaConstraint(joint[k])), 0, TOL(2e-5, 3e-8));
    }
    ck_assert_msg(fastest > 10 && fastest < 500, "the tip came to %g m/s", fastest);
}
