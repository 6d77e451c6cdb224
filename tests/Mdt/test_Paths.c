/* Ways to the same answer: the two sides of the inner problem, sub-steps, the same bits again. */
#include "measure.h"
#include "scene.h"

enum { LINKS = 6 };

typedef struct {
    MdtWorldID world;
    MdtBodyID link[LINKS];
} Chain;

/* Hung from the world, level, of ball joints and hinges in turn. */
static Chain makeChain(double endMass, int constraints) {
    Chain c = {.world = scene_world(LINKS, (unsigned int)(LINKS + constraints), 9.81)};
    MdtWorldSetEpsilon(c.world, 0);
    for (int i = 0; i < LINKS; i++) {
        const double edges[3] = {.5, .1, .2};
        c.link[i] = scene_box(c.world, i < LINKS - 1 ? 1 : endMass, edges, .5 * i + .25, 0, 0);
        const MdtConstraintID j =
            i % 2 ? MdtHingeQuaConstraint(MdtHingeCreate(c.world)) : MdtBSJointQuaConstraint(MdtBSJointCreate(c.world));
        MdtConstraintSetBodies(j, c.link[i], i > 0 ? c.link[i - 1] : 0);
        MdtConstraintSetPosition(j, .5 * i, 0, 0);
        if (i % 2)
            MdtConstraintSetAxis(j, 0, 0, 1);
        MdtConstraintEnable(j);
    }
    return c;
}

static double farthestApart(const Chain *a, const Chain *b) {
    double worst = 0;
    for (int i = 0; i < LINKS; i++) {
        double p[2][3];
        measure_position(a->link[i], p[0]);
        measure_position(b->link[i], p[1]);
        keaSubtract(p[0], p[0], p[1]);
        worst = fmax(worst, keaLength(p[0]));
    }
    return worst;
}

/* A contact that is never reached is a bounded row, and keeps Kea from the joints' side. */
static void addFarContact(Chain *c) {
    const MdtContactID contact = MdtContactCreate(c->world);
    MdtContactSetBodies(contact, c->link[LINKS - 1], 0);
    MdtContactSetNormal(contact, 0, 1, 0);
    MdtContactSetPenetration(contact, -1000);
    MdtContactEnable(contact);
}

TEST(both_sides_of_the_problem_give_one_motion) {
    const double masses[] = {1, 1000};
    for (int k = 0; k < 2; k++) {
        Chain joints = makeChain(masses[k], 0), bodies = makeChain(masses[k], 1);
        addFarContact(&bodies);
        for (int i = 0; i < 60; i++) {
            MdtWorldStep(joints.world, FRAME);
            MdtWorldStep(bodies.world, FRAME);
        }
        assert_below(farthestApart(&joints, &bodies), TOL(2e-5, 1e-7));
    }
}

TEST(sub_steps_are_steps) {
    Chain once = makeChain(10, 0), divided = makeChain(10, 0);
    MdtWorldSetSubSteps(divided.world, 4);
    ck_assert_int_eq(MdtWorldGetSubSteps(divided.world), 4);
    MdtWorldSetGamma(once.world, 1 - (MeReal)pow(.8, .25)); /* what four parts of γ = 0.2 take away each */
    for (int i = 0; i < 60; i++) {
        for (int k = 0; k < 4; k++)
            MdtWorldStep(once.world, FRAME / 4);
        MdtWorldStep(divided.world, FRAME);
    }
    assert_below(farthestApart(&once, &divided), TOL(2e-4, 1e-6));
}

/* ε F h² / γ, h the whole step, however it is divided. */
TEST(epsilon_and_gamma_hold_for_the_whole_step) {
    const double forces[] = {10, 100}, hs[] = {1.0 / 30, 1.0 / 60}, epsilon = .1, gamma = .2;
    for (int n = 1; n <= 8; n *= 2)
        for (int k = 0; k < 4; k++) {
            const double force = forces[k % 2], h = hs[k / 2];
            MeVector3 p, f;
            MdtWorldID w = scene_world(1, 1, force);
            MdtWorldSetEpsilon(w, epsilon);
            MdtWorldSetSubSteps(w, n);
            MdtBodyID b = scene_body(w, 1, 0, 0, 0);
            MdtBSJointID j = scene_ball(w, b, 0, 0, 0, 0);
            steps(w, 400, h);
            MdtBodyGetPosition(b, p);
            MdtBSJointGetForce(j, 0, f);
            assert_near_rel(-(double)p[1], epsilon * force * h * h / gamma, TOL(2e-6, 2e-8));
            assert_near_rel(f[1], force, TOL(1e-6, 3e-8));
        }
}

TEST(the_same_bits_again) {
    Chain a = makeChain(1e5, 0), b = makeChain(1e5, 0);
    for (int i = 0; i < 120; i++) {
        MdtWorldStep(a.world, FRAME);
        MdtWorldStep(b.world, FRAME);
    }
    for (int i = 0; i < LINKS; i++)
        ck_assert_mem_eq(MdtBodyGetTransformPtr(a.link[i]), MdtBodyGetTransformPtr(b.link[i]), sizeof(MeMatrix4));
}

TEST(settings_are_checked) {
    MdtWorldID w = scene_world(1, 1, 10);
    ck_assert_int_eq(MdtWorldGetSubSteps(w), 1);
    assert_refused(MdtWorldSetSubSteps, w, 0);
    assert_refused(MdtWorldSetSubSteps, w, 1001);
    ck_assert_int_eq(MdtWorldGetSubSteps(w), 1);
    ck_assert_int_eq(MdtWorldGetTimedContacts(w), 8);
    assert_refused(MdtWorldSetTimedContacts, w, -1);
    ck_assert_int_eq(MdtWorldGetTimedContacts(w), 8);
    MdtWorldSetTimedContacts(w, 0);
    ck_assert_int_eq(MdtWorldGetTimedContacts(w), 0);
    const MdtContactID c = MdtContactCreate(w);
    MdtContactSetRadius(c, 0, .5);
    ck_assert(MdtContactGetRadius(c, 0) == (MeReal).5 && MdtContactGetRadius(c, 1) == 0);
    assert_refused(MdtContactSetRadius, c, 0, -1);
    assert_refused(MdtContactSetRadius, c, 2, 1);
    ck_assert(MdtContactGetRadius(c, 0) == (MeReal).5);
}

TEST(a_rim_is_a_radius_and_an_axis) {
    static const MeVector3 along = {0, 0, 2}, none = {0, 0, 0};
    MeVector3 axis = {1, 1, 1};
    const MdtWorldID w = MdtWorldCreate(1, 1, 1, 1);
    const MdtContactID c = MdtContactCreate(w);
    ck_assert(MdtContactGetRim(c, 1, axis) == 0);
    assert_vec3_near(axis, 0, 0, 0, 0);
    MdtContactSetRim(c, 1, .5, along);
    ck_assert(MdtContactGetRim(c, 1, axis) == (MeReal).5 && MdtContactGetRim(c, 0, axis) == 0);
    MdtContactGetRim(c, 1, axis);
    assert_vec3_near(axis, 0, 0, 1, 0);
    assert_refused(MdtContactSetRim, c, 1, -1, along);
    assert_refused(MdtContactSetRim, c, 2, 1, along);
    assert_refused(MdtContactSetRim, c, 1, 1, none);
    assert_refused(MdtContactSetRim, c, 1, 1, 0);
    assert_none(MdtContactGetRim, c, 2, axis);
    ck_assert(MdtContactGetRim(c, 1, axis) == (MeReal).5);
    MdtContactSetVertex(c, 1, METRUE);
    ck_assert(MdtContactIsVertex(c, 1) && !MdtContactIsVertex(c, 0));
    assert_refused(MdtContactSetVertex, c, 2, METRUE);
    assert_none(MdtContactIsVertex, c, 2);
    MdtContactSetEdge(c, 1, (MeVector3){0, 0, 3});
    ck_assert(MdtContactGetRim(c, 1, axis) == 0 && MdtContactGetEdge(c, 1, axis) && !MdtContactGetEdge(c, 0, axis));
    assert_vec3_near(axis, 0, 0, 0, 0);
    MdtContactGetEdge(c, 1, axis);
    assert_vec3_near(axis, 0, 0, 1, 0);
    assert_refused(MdtContactSetEdge, c, 2, axis);
    assert_refused(MdtContactSetEdge, c, 1, 0);
    MdtContactSetEdge(c, 1, (MeVector3){0, 0, 0});
    ck_assert(!MdtContactGetEdge(c, 1, axis));
    MdtContactReset(c);
    ck_assert(MdtContactGetRim(c, 1, axis) == 0 && !MdtContactIsVertex(c, 1));
    MdtWorldDestroy(w);
}
