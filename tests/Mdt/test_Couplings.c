/* Where two parts of the solver meet: what each alone does right must also be right together. */
#include "scene.h"

/* A long bar hits the floor beside its centre while it slides: its point of contact is not as easily moved in every
 * direction. The friction of the impact is on the cone, and against the way that the point slides. */
TEST(friction_in_impacts_is_against_the_slide_of_a_bar) {
    const double edge[3] = {2, .2, .4}, mu = .1, e = .5, arm[3] = {.7, -.1, .15};
    for (int turn = 0; turn < 8; turn++) {
        const double angle = .7 * turn, start[3] = {3 * cos(angle), -4, 3 * sin(angle)};
        MdtWorldID w = scene_world(1, 1, 0);
        MdtBodyID b = scene_box(w, 1, edge, 0, .1, 0);
        MeVector3 v, spin;
        MdtWorldSetEpsilon(w, 0);
        MdtBodySetLinearVelocity(b, start[0], start[1], start[2]);
        MdtContactID c = MdtContactCreate(w);
        MdtContactSetBodies(c, b, 0);
        MdtContactSetPosition(c, arm[0], 0, arm[2]);
        MdtContactSetNormal(c, 0, 1, 0);
        MdtContactSetDirection(c, 1, 0, 0);
        MdtContactParamsID params = MdtContactGetParams(c);
        MdtContactParamsSetType(params, MdtContactTypeFriction2D);
        MdtContactParamsSetFrictionModel(params, MdtFrictionModelCone);
        MdtContactParamsSetFrictionCoeffecient(params, mu);
        MdtContactParamsSetRestitution(params, e);
        MdtContactEnable(c);
        MdtWorldStep(w, 1e-8); /* the impact alone */
        MdtBodyGetLinearVelocity(b, v);
        MdtBodyGetAngularVelocity(b, spin);
        const double impulse[3] = {(double)v[0] - start[0], (double)v[1] - start[1], (double)v[2] - start[2]};
        const double slide[2] = {(double)v[0] + (double)spin[1] * arm[2] - (double)spin[2] * arm[1],
                                 (double)v[2] + (double)spin[0] * arm[1] - (double)spin[1] * arm[0]};
        const double up = (double)v[1] + (double)spin[2] * arm[0] - (double)spin[0] * arm[2];
        const double sliding = hypot(slide[0], slide[1]);
        assert_near(up, -e * start[1], TOL(1e-5, 6e-8));
        for (int k = 0; k < 2; k++)
            assert_near(impulse[2 * k] / impulse[1], -mu * slide[k] / sliding, TOL(2e-5, 1e-7));
    }
}

/* A step of which a part was left, and then that rest in two goes, is the step: the force acts throughout. */
TEST(a_step_and_its_rest_are_a_step) {
    const MeReal h = .015625;
    MdtWorldID w = scene_world(2, 0, 10);
    MdtBodyID body[2] = {scene_body(w, 2, 0, 0, 0), scene_body(w, 2, 0, 0, 9)};
    MeVector3 p[2], v[2];
    for (int i = 0; i < 2; i++) {
        MdtBodySetLinearVelocity(body[i], 1, 2, 0);
        MdtBodyAddForce(body[i], 6, 0, 0);
    }
    MdtBodySetSafeTime(body[0], h / 4);
    MdtWorldStepSafeTime(w, h);
    ck_assert(MdtBodyGetLag(body[0]) == 3 * h / 4 && MdtBodyGetLag(body[1]) == 0);
    ck_assert(MdtBodyGetPart(body[0]) == h / 4 && MdtBodyGetPart(body[1]) == h);
    ck_assert_int_eq(MdtWorldGetLaggingBodies(w), 1);
    ck_assert_int_eq(MdtWorldStepRest(w), 1);
    ck_assert(MdtBodyGetLag(body[0]) == h / 2 && MdtBodyGetPart(body[0]) == h / 4);
    MdtBodyGetLinearVelocity(body[0], v[0]);
    assert_near(v[0][0], 1 + 3 * (double)h / 2, TOL(5e-7, 9e-16));
    MdtBodySetSafeTime(body[0], MEINFINITY);
    ck_assert_int_eq(MdtWorldStepRest(w), 1);
    ck_assert(MdtBodyGetLag(body[0]) == 0 && MdtBodyGetPart(body[0]) == h / 2);
    ck_assert_int_eq(MdtWorldGetLaggingBodies(w), 0);
    ck_assert_int_eq(MdtWorldStepRest(w), 0);
    for (int i = 0; i < 2; i++) {
        MdtBodyGetPosition(body[i], p[i]);
        MdtBodyGetLinearVelocity(body[i], v[i]);
    }
    assert_vec3_near(v[0], v[1][0], v[1][1], v[1][2], TOL(1e-6, 2e-15));
    assert_vec3_near(p[0], p[1][0], p[1][1], 0, TOL(1e-8, 2e-17));
}

static int wakes, sleeps;

static void MEAPI onEnabled(MdtBodyID b) {
    ck_assert(MdtBodyIsEnabled(b));
    wakes++;
}

static void MEAPI onDisabled(MdtBodyID b) {
    ck_assert(!MdtBodyIsEnabled(b));
    sleeps++;
}

/* The toolkit hears of every body that the program or a neighbour wakes, once each. */
TEST(handlers_hear_of_bodies_that_are_enabled_and_disabled) {
    MdtWorldID w = scene_world(2, 1, 0);
    wakes = sleeps = 0;
    MdtWorldSetBodyHandlers(w, onEnabled, onDisabled);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0), b = MdtBodyCreate(w);
    MdtBSJointID joint = MdtBSJointCreate(w);
    MdtBSJointSetBodies(joint, a, b);
    MdtBSJointEnable(joint);
    ck_assert_int_eq(wakes, 1);
    MdtBodyEnable(a);
    MdtWorldStep(w, FRAME); /* b is woken by its joint */
    ck_assert(MdtBodyIsEnabled(b));
    ck_assert_int_eq(wakes, 2);
    ck_assert_int_eq(sleeps, 0);
    MdtBodyDisable(a);
    MdtBodyDisable(a);
    ck_assert_int_eq(sleeps, 1);
    MdtWorldSetBodyHandlers(w, 0, 0);
    MdtBodyDisable(b);
    MdtBodyEnable(a);
    ck_assert(wakes == 2 && sleeps == 1);
}

TEST(what_is_set_is_got) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtContactID c = MdtContactCreate(w);
    MeVector3 v;
    int model;
    MdtContactSetBodies(c, b, 0);
    ck_assert(MdtContactGetFeature(c) == 0 && MdtBodyGetModel(b) == NULL);
    MdtContactSetFeature(c, 0xfedcba98u);
    ck_assert(MdtContactGetFeature(c) == 0xfedcba98u);
    MdtBodySetModel(b, &model);
    ck_assert_ptr_eq(MdtBodyGetModel(b), &model);
    MdtContactSetWorldVelocity(c, 1, -2, 3);
    MdtContactGetWorldVelocity(c, v);
    assert_vec3_near(v, 1, -2, 3, 0);
    MdtContactGetRelativeVelocity(c, v);
    assert_vec3_near(v, -1, 2, -3, 0);
}
