/* The ball-and-socket joint: it holds, sags as the guide says, and swings in time. */
#include "scene.h"

/* A body of the weight F hung on a joint sags by ε F h² / γ, and the joint's force is F. */
static double sagOf(double epsilon, double gamma, double h, double F, double *force) {
    MdtWorldID w = scene_world(1, 1, F); /* mass 1 */
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtWorldSetEpsilon(w, epsilon);
    MdtWorldSetGamma(w, gamma);
    MdtBSJointID j = scene_ball(w, b, 0, 0, 0, 0);
    steps(w, 2000, h);
    MeVector3 p, f;
    MdtBodyGetPosition(b, p);
    MdtBSJointGetForce(j, 0, f);
    *force = f[1];
    MdtWorldDestroy(w);
    return -(double)p[1];
}

TEST(sag_is_epsilon_force_step_squared_over_gamma) {
    const double epsilons[] = {.1, .01, 1e-4}, gammas[] = {.1, .2, .8, 1}, hs[] = {1.0 / 30, 1.0 / 60, .005};
    const double forces[] = {10, 100};
    for (int e = 0; e < 3; e++)
        for (int g = 0; g < 4; g++)
            for (int k = 0; k < 3; k++)
                for (int f = 0; f < 2; f++) {
#ifdef TEST_IS_SLOW
                    if ((e + g + k + f) % 4)
                        continue;
#endif
                    double force;
                    const double sag = sagOf(epsilons[e], gammas[g], hs[k], forces[f], &force);
                    const double expected = epsilons[e] * forces[f] * hs[k] * hs[k] / gammas[g];
                    assert_near(sag, expected, TOL(1e-5, 1e-6) * expected + 1e-11); /* met to 1e-10 of a row's size */
                    assert_near_rel(force, forces[f], TOL(1e-6, 5e-8));
                }
}

TEST(sag_of_the_customer_s_example) {
    double force;
    assert_near(sagOf(.1, .2, 1.0 / 60, 10, &force), 1.38889e-3, 1e-8);
    assert_near(sagOf(.1, .2, 1.0 / 60, 100, &force), 1.38889e-2, 1e-7);
    assert_near(sagOf(.1, .2, 1.0 / 30, 10, &force), 4 * 1.38889e-3, TOL(4e-8, 5e-8));
    assert_near(sagOf(0, .2, 1.0 / 60, 100, &force), 0, 9e-14);
    assert_near(force, 100, TOL(1e-5, 5e-8));
}

/* A joint that is apart closes by the fraction γ a step. */
TEST(gamma_is_the_fraction_that_a_step_removes) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtWorldSetGamma(w, .25);
    scene_ball(w, b, 0, 0, 0, 0);
    MdtBodySetPosition(b, 1, 0, 0);
    MeVector3 p;
    for (int i = 1; i <= 10; i++) {
        MdtWorldStep(w, FRAME);
        MdtBodyGetPosition(b, p);
        assert_near(p[0], pow(.75, i), TOL(1e-6, 3e-13));
    }
    MdtWorldDestroy(w);
}

TEST(gamma_with_reference_step) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtWorldSetGammaWithRefTimeStep(w, .36, .02, .01);
    assert_near(MdtWorldGetGamma(w), .2, TOL(2e-7, 2e-14)); /* (1 - .2)² = 1 - .36 */
    MdtWorldDestroy(w);
}

static double apart(MdtConstraintID c) {
    MeVector3 a, b;
    MdtConstraintBodyGetPosition(c, 0, a);
    MdtConstraintBodyGetPosition(c, 1, b);
    return sqrt(pow((double)a[0] - b[0], 2) + pow((double)a[1] - b[1], 2) + pow((double)a[2] - b[2], 2));
}

/* A ball that spins and swings: the point stays on the point, the rotation is free. */
TEST(the_points_stay_together) {
    const double edge[3] = {.3, 1, .2};
    MdtWorldID w = scene_world(2, 2, 9.81);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID a = scene_box(w, 1, edge, .5, 0, 0), b = scene_box(w, 3, edge, 1.5, 0, 0);
    MdtBSJointID top = MdtBSJointCreate(w), mid = MdtBSJointCreate(w);
    MdtBSJointSetBodies(top, 0, a);
    MdtBSJointSetPosition(top, 0, 0, 0);
    MdtBSJointEnable(top);
    MdtBSJointSetBodies(mid, a, b);
    MdtBSJointSetPosition(mid, 1, 0, 0);
    MdtBSJointEnable(mid);
    MdtBodySetAngularVelocity(b, 5, 2, 0);
    double worst = 0;
    for (int i = 0; i < 600; i++) {
        MdtWorldStep(w, FRAME);
        worst = fmax(worst, fmax(apart(MdtBSJointQuaConstraint(top)), apart(MdtBSJointQuaConstraint(mid))));
    }
    assert_below(worst, TOL(2e-6, 1e-7));
    MdtWorldDestroy(w);
}

/* Complete elliptic integral by the arithmetic-geometric mean: T = 2π sqrt(I/(m g l)) / agm(1, cos(θ/2)). */
static double pendulumPeriod(double inertia, double mgl, double amplitude) {
    double a = 1, b = cos(amplitude / 2);
    for (int i = 0; i < 10; i++) {
        const double mean = (a + b) / 2;
        b = sqrt(a * b);
        a = mean;
    }
    return 2 * 3.14159265358979323846 * sqrt(inertia / mgl) / a;
}

/* A bar released from the horizontal: period, gap and energy over 10 s at 60 Hz. */
TEST(a_pendulum_from_90_degrees_keeps_time) {
    const double g = 9.81;
    HingedBar s = scene_hingedBar(g);
    double period = 0, first = 0, last = 0, worst = 0, before = 0;
    int crossings = 0;
    for (int i = 1; i <= 600; i++) {
        MeVector3 p;
        MdtWorldStep(s.world, FRAME);
        MdtBodyGetPosition(s.bar, p);
        if (before > 0 && p[0] <= 0) { /* through the lowest point, to the left */
            last = (i - (double)p[0] / ((double)p[0] - before)) * (double)FRAME;
            if (crossings++ == 0)
                first = last;
        }
        before = p[0];
        worst = fmax(worst, apart(MdtHingeQuaConstraint(s.hinge)));
    }
    ck_assert_int_ge(crossings, 5);
    period = (last - first) / (crossings - 1);
    assert_near_rel(period, pendulumPeriod(1.0 / 3, g * .5, 1.57079632679), 1e-3);
    assert_below(worst, TOL(1e-6, 1e-8));
    MdtWorldDestroy(s.world);
}

/* Second order in h, as it should be without a first-order loss of energy. The bar turns by up to 5.4 rad/s; steps in
 * which that is more than 0.1 rad would be divided. */
TEST(the_period_converges_at_second_order) {
    double error[2];
    const double exact = pendulumPeriod(1.0 / 3, 9.81 * .5, 1.57079632679);
    for (int k = 0; k < 2; k++) {
        const double h = .016 / (1 << k);
        HingedBar s = scene_hingedBar(9.81);
        double before = .5, first = 0, last = 0;
        int crossings = 0;
        for (int i = 1; i * h < 10; i++) {
            MeVector3 p;
            MdtWorldStep(s.world, h);
            MdtBodyGetPosition(s.bar, p);
            if (before > 0 && p[0] <= 0) {
                last = (i - (double)p[0] / ((double)p[0] - before)) * h;
                if (crossings++ == 0)
                    first = last;
            }
            before = p[0];
        }
        error[k] = fabs((last - first) / (crossings - 1) - exact);
        MdtWorldDestroy(s.world);
    }
    ck_assert_msg(error[0] / error[1] > 3 && error[0] / error[1] < 5, "errors %g %g", error[0], error[1]);
}

/* The force that holds a swinging mass at the lowest point is m g + m v²/l = 3 m g. */
TEST(the_force_read_back_is_the_pendulum_s_tension) {
    MdtWorldID w = scene_world(1, 1, 10);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID b = scene_body(w, 1, 1, 0, 0);
    MdtBodySetSphericalInertiaTensor(b, 1e-6);
    MdtBSJointID j = scene_ball(w, b, 0, 0, 0, 0);
    double max = 0;
    for (int i = 0; i < 300; i++) {
        MeVector3 f;
        MdtWorldStep(w, .005);
        MdtBSJointGetForce(j, 0, f);
        max = fmax(max, sqrt((double)f[0] * f[0] + (double)f[1] * f[1] + (double)f[2] * f[2]));
    }
    assert_near(max, 30, .02);
    MdtWorldDestroy(w);
}

/* Two joints where one would do: the load is shared, nothing explodes, at ε = 0. */
TEST(redundant_joints_share_the_load) {
    MdtWorldID w = scene_world(1, 3, 10);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID b = scene_body(w, 3, 0, 0, 0);
    MdtBSJointID j[3];
    for (int i = 0; i < 3; i++) {
        j[i] = scene_ball(w, b, 0, (MeReal)(i - 1), 0, 0);
    }
    steps(w, 600, FRAME);
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        MeVector3 f;
        MdtBSJointGetForce(j[i], 0, f);
        assert_near(f[1], 10, TOL(1e-5, 3e-8));
        sum += f[1];
    }
    assert_near(sum, 30, TOL(3e-5, 9e-8));
    MeVector3 p;
    MdtBodyGetPosition(b, p);
    assert_vec3_near(p, 0, 0, 0, 9e-14);
    MdtWorldDestroy(w);
}

/* Joints that contradict each other end in a compromise, finite and bounded. */
TEST(contradictory_joints_end_in_a_compromise) {
    MdtWorldID w = scene_world(1, 2, 10);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    for (int i = 0; i < 2; i++) {
        MdtBSJointID j = MdtBSJointCreate(w);
        MdtBSJointSetBodies(j, b, 0);
        MdtConstraintBodySetPosition(MdtBSJointQuaConstraint(j), 0, 0, 0, 0);
        MdtConstraintBodySetPosition(MdtBSJointQuaConstraint(j), 1, i == 0 ? -1 : 1, 0, 0);
        MdtBSJointEnable(j);
    }
    for (int i = 0; i < 300; i++) {
        MeVector3 p;
        MdtWorldStep(w, FRAME);
        MdtBodyGetPosition(b, p);
        assert_vec3_near(p, 0, 0, 0, TOL(1e-6, 4e-10));
    }
    MdtWorldDestroy(w);
}
