/* Documented behaviours: epsilon and gamma (Dynamics guide ch. 5, "The Meaning of Epsilon and Gamma").
 *
 * Already proved elsewhere:
 *   (A + epsilon I) x = b; larger epsilon, springier joints  test_Order: the_sag_of_a_load_is_epsilon_force_over_gamma
 *   gamma is the fraction of the error that a step removes   errors_die_in_the_same_time_at_any_step
 *   gamma outside 0..1 is unsafe: it is refused              test_BadInput: parameters_out_of_range
 */
#include "behaviour.h"

/* "By making epsilon greater than zero a solution can be guaranteed": a hinge and four more joints hold what one
 * would, at every epsilon, down to 0, and the load is carried. */
TEST(redundant_constraints_have_a_solution_at_every_epsilon) {
    const double epsilons[] = {.1, 1e-4, 1e-8, 0}, edge[3] = {2, .2, .2};
    for (int k = 0; k < 4; k++) {
        MdtWorldID w = scene_world(1, 5, 10);
        MdtWorldSetEpsilon(w, epsilons[k]);
        MdtBodyID b = scene_box(w, 1, edge, 0, 0, 0);
        MdtConstraintID all[5];
        MdtHingeID hinge = MdtHingeCreate(w);
        all[0] = MdtHingeQuaConstraint(hinge);
        for (int i = 1; i < 5; i++)
            all[i] = MdtBSJointQuaConstraint(MdtBSJointCreate(w));
        for (int i = 0; i < 5; i++) {
            MdtConstraintSetBodies(all[i], b, 0);
            MdtConstraintSetPosition(all[i], i - 2., 0, 0);
            MdtConstraintEnable(all[i]);
        }
        steps(w, 300, FRAME);
        double carried = 0;
        for (int i = 0; i < 5; i++)
            carried += forceOn(all[i], 0, 1);
        assert_near(carried, 10, TOL(1e-4, 1e-7));
        assert_near(coordinate(b, 1), 0, epsilons[k] * 10 * (double)FRAME * (double)FRAME / .2 + TOL(1e-7, 1e-9));
    }
}

/* "If gamma = 0, no relaxation is done. Joints will separate": an error stays what it is, and the load of a springy
 * joint lets it grow by epsilon F h² a step. */
TEST(without_gamma_errors_stay_and_add_up) {
    MdtWorldID w = scene_world(2, 2, 10);
    const double epsilon = .01, h = (double)FRAME;
    MdtWorldSetGamma(w, 0);
    MdtWorldSetEpsilon(w, epsilon);
    MdtBodyID loaded = scene_body(w, 1, 0, 0, 0);
    MdtBSJointID j = MdtBSJointCreate(w);
    MdtBSJointSetBodies(j, loaded, 0);
    MdtBSJointEnable(j);
    MdtBodySetPosition(loaded, .5, 0, 0);
    double before = 0;
    for (int i = 1; i <= 100; i++) {
        MdtWorldStep(w, FRAME);
        assert_near(coordinate(loaded, 0), .5, TOL(1e-6, 1e-10));
        if (i == 20) /* the joint's force has built up by now */
            before = coordinate(loaded, 1);
    }
    /* a joint is met to 1e-10 of its size, here the error of 0.5 m, at every step */
    assert_near(coordinate(loaded, 1) - before, -80 * epsilon * 10 * h * h, TOL(2e-7, 80 * 1e-10 * .5));
}

/* The fraction is per step; over the same time steps of any length are to leave the same part of an error:
 * (1 - gamma')^(T/h) = (1 - gamma)^(T/ref) for all T. */
static const struct {
    double gamma, ref, step;
} relaxations[] = {
    {.2, 1. / 60, 1. / 60},  {.2, 1. / 60, 1. / 30}, {.2, 1. / 60, 1. / 240}, {.5, 1. / 50, 1. / 100},
    {.9, 1. / 60, 1. / 120}, {.05, .01, .02},        {.8, .02, .005},         {.01, 1. / 60, 1. / 1000},
};

/* A joint that was pulled open by 1 m has come back by the same part after the same time. */
TEST(errors_die_in_the_same_time_at_any_step) {
    for (size_t k = 0; k < sizeof relaxations / sizeof *relaxations; k++) {
        const double gamma = relaxations[k].gamma, ref = relaxations[k].ref, step = relaxations[k].step;
        const int steps = (int)fmax(1, round(2 * ref / step)); /* 2 reference steps, or one that is longer */
        MdtWorldID w = scene_world(1, 1, 0);
        MdtWorldSetEpsilon(w, 0);
        MdtWorldSetGammaWithRefTimeStep(w, gamma, ref, step);
        const MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        const MdtBSJointID j = MdtBSJointCreate(w);
        MdtBSJointSetBodies(j, b, 0);
        MdtBSJointEnable(j);
        MdtBodySetPosition(b, 1, 0, 0);
        for (int i = 0; i < steps; i++)
            MdtWorldStep(w, step);
        assert_near(coordinate(b, 0), pow(1 - gamma, steps * step / ref), TOL(2e-6, 1e-9));
    }
}

/* At its ends gamma needs no reference. */
TEST(no_gamma_and_all_of_it_are_the_same_at_any_step) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtWorldSetGammaWithRefTimeStep(w, 0, .01, .02);
    ck_assert(MdtWorldGetGamma(w) == 0);
    MdtWorldSetGammaWithRefTimeStep(w, 1, .01, .003);
    ck_assert(MdtWorldGetGamma(w) == 1);
}

/* Epsilon is for joints and for the normals of contacts. On a row without a position it would be viscosity: friction
 * and brakes hold what they can hold, at 1e-4 for 1 kg to 10 t, and motors get to their speed. */
TEST(friction_and_brakes_do_not_creep) {
    for (double mass = 1; mass <= 1e4; mass *= 10) {
        MdtWorldID w = scene_world(2, 2, 10);
        const MdtBodyID cube = scene_body(w, mass, 0, 0, 0), arm = scene_body(w, mass, 5, 0, 0);
        const MdtContactID c = scene_contact(w, cube, 0, 0, 0, 0);
        MdtContactParamsSetType(MdtContactGetParams(c), MdtContactTypeFriction2D);
        MdtContactParamsSetFrictionModel(MdtContactGetParams(c), MdtFrictionModelCone);
        MdtContactParamsSetFrictionCoeffecient(MdtContactGetParams(c), .6);
        const MdtHingeID hinge = MdtHingeCreate(w);
        MdtHingeSetBodies(hinge, arm, 0);
        MdtHingeSetPosition(hinge, 4, 0, 0);
        MdtHingeSetAxis(hinge, 0, 0, 1);
        MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(hinge), 0, 11 * mass);
        MdtHingeEnable(hinge);
        double start[2] = {0, 0};
        for (int i = 0; i < 1260; i++) {
            if (i == 60) /* the hinge has given way, and the contact, which bore little until then */
                start[0] = coordinate(cube, 0), start[1] = coordinate(arm, 1);
            const MeReal *at = MdtBodyGetTransformPtr(cube)[3];
            MdtContactSetPosition(c, at[0], at[1], at[2]); /* the force has no lever arm */
            MdtContactSetPenetration(c, -at[1]);
            MdtBodyAddForce(cube, 5 * mass, 0, 0);
            MdtWorldStep(w, FRAME);
        }
        assert_near(coordinate(cube, 0), start[0], 1e-6);
        assert_near(coordinate(arm, 1), start[1], 1e-6);
    }
}
