/* Manifolds: what contacts found by collision share, what one of them has of its own, which of them goes on, and how
 * they are carried along with their bodies. */
#include "MdtInternal.h"
#include "scene.h"

enum { MANY = 11 };

static MdtWorldID world;
static MdtBodyID upper, lower;
static MdtContactGroupID group;
static MdtBclContactParams rough, smooth;

static void setUp(void) {
    const double edge[3] = {1, 1, 1};
    world = scene_world(4, 40, 10);
    upper = scene_box(world, 1, edge, 0, 1.5, 0);
    lower = scene_box(world, 1, edge, 0, .5, 0);
    group = MdtContactGroupCreate(world);
    MdtContactGroupSetBodies(group, upper, lower);
    MdtContactGroupEnable(group);
    MdtContactParamsReset(&rough);
    MdtContactParamsSetSurface(&rough, .5, 0);
    MdtContactParamsReset(&smooth);
    MdtContactParamsSetSurface(&smooth, 0, 0);
}

TEST_FIXTURE(setUp, NULL)

/* A corner of the face between the two; i beyond 3: further in. */
static MdtFoundContact corner(int i) {
    const double at = i < 4 ? .5 : .5 / i;
    return (MdtFoundContact){.position = {i & 1 ? at : -at, 1, i & 2 ? at : -at},
                             .normal = {0, 1, 0},
                             .feature = (MeU32)(100 + i),
                             .params = &rough};
}

static void corners(MdtFoundContact found[], int count) {
    for (int i = 0; i < count; i++)
        found[i] = corner(i);
}

static double heightOf(MdtContactID c) {
    MeVector3 n;
    MdtContactGetNormal(c, n);
    return (double)n[1];
}

TEST(any_number_of_contacts_is_found) {
    MdtFoundContact found[MANY];
    MdtContactID contact[MANY], c;
    corners(found, MANY);
    ck_assert_int_eq(MdtContactGroupRenew(group, found, MANY, 0, contact), MANY);
    ck_assert_int_eq(MdtContactGroupGetCount(group), MANY);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(world), 1 + MANY);
    int i = 0;
    for (c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c), i++) {
        ck_assert_ptr_eq(c, contact[i]);
        ck_assert_ptr_eq(MdtContactGetContactGroup(c), group);
        ck_assert(MdtConstraintIsValid(MdtContactQuaConstraint(c)));
    }
    ck_assert_int_eq(i, MANY);
    ck_assert_int_eq(MdtContactGroupRenew(group, found + 4, 1, 0, contact + 4), 1);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(world), 2);
    for (i = 0; i < MANY; i++)
        ck_assert_int_eq(MdtConstraintIsValid(MdtContactQuaConstraint(contact[i])), i == 4);
    MdtWorldStep(world, FRAME);
}

TEST(a_full_world_has_fewer) {
    MdtFoundContact found[60];
    MdtContactID contact[60];
    corners(found, 60);
    ck_assert_int_eq(MdtContactGroupRenew(group, found, 60, 0, contact), 39);
    assert_warned("maxConstraints");
    ck_assert_int_eq(MdtWorldGetTotalConstraints(world), 40);
    ck_assert_int_eq(MdtContactGroupRenew(group, found + 39, 21, 0, contact), 21);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(world), 22);
}

/* What one contact is given, the others of its manifold do not get. */
TEST(each_has_its_own) {
    MdtFoundContact found[4];
    MdtContactID contact[4];
    int mark;
    corners(found, 4);
    found[2].normal[0] = 1;
    found[3].params = &smooth;
    MdtContactGroupRenew(group, found, 4, 0, contact);
    assert_near(heightOf(contact[2]), sqrt(.5), TOL(1e-6, 1e-15));
    MdtContactSetNormal(contact[1], 1, 0, 0);
    MdtContactSetRadius(contact[1], 0, 3);
    MdtContactSetUserData(contact[1], &mark);
    MdtContactSetWorldVelocity(contact[1], 0, 0, 7);
    MdtContactParamsSetRestitution(MdtContactGetParams(contact[0]), .25);
    for (int i = 0; i < 4; i++) {
        MeVector3 v;
        MdtContactGetWorldVelocity(contact[i], v);
        assert_near(v[2], i == 1 ? 7 : 0, 0);
        ck_assert_ptr_eq(MdtContactGetUserData(contact[i]), i == 1 ? (void *)&mark : NULL);
        assert_near(MdtContactGetRadius(contact[i], 0), i == 1 ? 3 : 0, 0);
        assert_near(heightOf(contact[i]), i == 1 ? 0 : i == 2 ? sqrt(.5) : 1, TOL(1e-6, 1e-15));
        assert_near(MdtContactGetParams(contact[i])->restitution, i == 0 ? .25 : 0, 0);
        assert_near(MdtContactGetParams(contact[i])->FrictionCoefficient, i == 3 ? 0 : .5, 0);
    }
    /* found again, they are as they are found; what a program has hung on them stays */
    corners(found, 4);
    MdtContactGroupRenew(group, found, 4, 0, contact);
    for (int i = 0; i < 4; i++) {
        assert_near(heightOf(contact[i]), 1, 0);
        assert_near(MdtContactGetRadius(contact[i], 0), 0, 0);
        assert_near(MdtContactGetParams(contact[i])->restitution, 0, 0);
        ck_assert_ptr_eq(MdtContactGetUserData(contact[i]), i == 1 ? (void *)&mark : NULL);
    }
    /* another one in its place does not have it */
    MdtContactGroupDestroyContact(group, contact[1]);
    found[1].feature = 999;
    MdtContactGroupRenew(group, found, 4, 0, contact);
    ck_assert_ptr_null(MdtContactGetUserData(contact[1]));
}

/* By feature; what is left goes on where it is nearest, and keeps its force. */
TEST(the_nearest_goes_on) {
    MdtFoundContact found[4];
    MdtContactID before[4], after[4];
    MeVector3 f;
    corners(found, 4);
    MdtContactGroupRenew(group, found, 4, 0, before);
    MdtBodyAddForce(upper, 0, -100, 0);
    MdtWorldStep(world, FRAME);
    for (int i = 0; i < 4; i++) { /* the other way round */
        found[i] = corner(3 - i);
        found[i].feature = i == 0 ? 103 : (MeU32)(500 + i);
        found[i].position[0] += .01;
    }
    MdtContactGroupRenew(group, found, 4, 0, after);
    for (int i = 0; i < 4; i++)
        ck_assert_ptr_eq(after[i], before[3 - i]);
    MdtContactGetForce(after[1], 0, f);
    ck_assert_msg((double)f[1] > 1, "the force of the last step was lost");
}

static void tilt(MdtFoundContact *found) {
    found->normal[0] = 1;
}

/* Then threads may renew different groups at once. */
TEST(a_group_goes_on_where_nothing_is_made_or_lost) {
    MdtFoundContact found[MANY];
    MdtContactID contact[MANY];
    corners(found, MANY);
    ck_assert(!MdtContactGroupGoesOn(group, found, 4));
    MdtContactGroupRenew(group, found, 4, 0, contact);
    ck_assert(MdtContactGroupGoesOn(group, found, 4));
    ck_assert(!MdtContactGroupGoesOn(group, found, 3) && !MdtContactGroupGoesOn(group, found, 5));
    found[2].params = &smooth;
    ck_assert(!MdtContactGroupGoesOn(group, found, 4));
    corners(found, MANY);
    tilt(&found[2]); /* there is no place for a normal of its own yet */
    ck_assert(!MdtContactGroupGoesOn(group, found, 4));
    MdtContactGroupRenew(group, found, 4, 0, contact);
    ck_assert(MdtContactGroupGoesOn(group, found, 4));
    tilt(&found[0]);
    ck_assert(MdtContactGroupGoesOn(group, found, 4));
    corners(found, MANY);
    ck_assert(MdtContactGroupGoesOn(group, found, 4));
    MdtContactGroupRenew(group, found, MANY, 0, contact); /* in three records */
    ck_assert(MdtContactGroupGoesOn(group, found, MANY));
    tilt(&found[9]);
    ck_assert(!MdtContactGroupGoesOn(group, found, MANY));
    MdtContactGroupRenew(group, found, MANY, 0, contact);
    ck_assert(MdtContactGroupGoesOn(group, found, MANY));
    assert_near(heightOf(contact[9]), sqrt(.5), TOL(1e-6, 1e-15));
}

/* Millions of multiplications of a step by the fast solver, which visits each of Kea's manifolds as often: with eight
 * contacts, of which those of one kind follow each other at this distance. */
static double workOfKinds(int kinds) {
    MdtFoundContact found[8];
    MdtContactID contact[8];
    MdtReport r;
    corners(found, 8);
    for (int i = 0; i < 8; i++)
        found[i].normal[0] = (MeReal)(.01 * (i % kinds));
    MdtContactGroupRenew(group, found, 8, 0, contact);
    MdtWorldSetSolver(world, MdtSolverFast);
    MdtWorldSetMaxLCPIterations(world, 16);
    MdtWorldEnableReport(world);
    MdtWorldStep(world, 1. / 60);
    ck_assert(MdtWorldGetReport(world, &r));
    ck_assert_int_eq(r.way, MdtReportWayFast);
    ck_assert_int_eq(r.iterations, 16);
    return (double)r.work;
}

/* In whichever records they are: two kinds in turn fill two records, and each of these has both. */
TEST(contacts_of_one_normal_are_one_manifold_to_the_solver) {
    const double one = workOfKinds(1), two = workOfKinds(2), four = workOfKinds(4), eight = workOfKinds(8);
    assert_near(two, one, 0);
    assert_near(four - one, 2. / 6 * (eight - one), 1e-3 * one); /* 2, 4 and 8 manifolds, in groups of eight */
    ck_assert_double_gt(eight, 1.01 * one);
}

TEST(what_a_bridge_made_stays_in_its_group) {
    MdtFoundContact found[2];
    MdtContactID contact[2];
    corners(found, 2);
    MdtContactGroupRenew(group, found, 2, 0, contact);
    assert_refused(MdtContactGroupRemoveContact, group, contact[0]);
    ck_assert_int_eq(MdtContactGroupGetCount(group), 2);
}

/* Two hundred surfaces, each used by one contact and then by none: nothing of them is left. */
TEST(surfaces_are_kept_once_and_go) {
    MdtContactID contact = MdtContactCreateBetween(world, upper, lower),
                 other = MdtContactCreateBetween(world, upper, 0);
    for (int i = 0; i < 200; i++) {
        MdtBclContactParams p = rough;
        MdtContactParamsSetSurface(&p, .01 * i, 0);
        MdtContactSetParams(contact, &p);
        MdtContactSetParams(other, &p);
        assert_near(MdtContactGetParams(other)->FrictionCoefficient, (MeReal)(.01 * i), 0);
    }
    assert_near(MdtContactGetParams(contact)->FrictionCoefficient, (double)(MeReal)1.99, 0);
}

/* Falls and turns for a step as one body: so do its contacts, exactly. */
TEST(contacts_are_carried_along) {
    static const MeBool both[2] = {METRUE, METRUE}, one[2] = {METRUE, MEFALSE};
    MdtFoundContact found = corner(3);
    MdtContactID contact;
    MeVector3 place, normal;
    found.depth = .001;
    MdtContactGroupRenew(group, &found, 1, 0, &contact);
    MdtContactGroupDisable(group); /* they are free */
    MdtBodySetAngularVelocity(upper, 0, .6, 0);
    MdtBodySetLinearVelocity(upper, 0, 0, 3);
    const unsigned long moves = MdtBodyGetMoves(upper);
    MdtWorldSetGravity(world, 0, 0, 0);
    MdtWorldStep(world, .1);
    ck_assert(MdtBodyMovedByStep(upper, moves));
    assert_near(MdtContactGroupCarry(group, one), -.001, TOL(1e-7, 1e-12)); /* it slides off: no deeper */
    MdtContactGetPosition(contact, place);
    /* half-way between the point of the one, which turns by .06 and goes .3 m, and that of the other */
    const double turned[2] = {.5 * cos(.06) + .5 * sin(.06), .5 * cos(.06) - .5 * sin(.06) + .3};
    assert_vec3_near(place, .5 * (turned[0] + .5), 1, .5 * (turned[1] + .5), TOL(1e-5, 1e-5));

    MdtBodySetAngularVelocity(upper, 0, 0, .5); /* one body, as it were, about the origin */
    MdtBodySetAngularVelocity(lower, 0, 0, .5);
    MdtBodySetLinearVelocity(upper, -.75, 0, 0);
    MdtBodySetLinearVelocity(lower, -.25, 0, 0);
    MdtContactSetExact(contact, (double[3]){.5, 1, .5}, .001);
    MdtWorldStep(world, 1e-3);
    assert_near(MdtContactGroupCarry(group, both), -.001, 1e-6); /* second order: their ways are straight */
    MdtContactGetNormal(contact, normal);
    assert_vec3_near(normal, -sin(5e-4), cos(5e-4), 0, TOL(1e-7, 1e-9));
    MdtContactGetPosition(contact, place);
    assert_vec3_near(place, .5 - 5e-4, 1 + .5 * 5e-4, .5, 1e-6);
}

TEST(a_body_that_was_placed_has_not_moved_by_a_step) {
    const unsigned long moves = MdtBodyGetMoves(upper);
    MdtWorldStep(world, FRAME);
    MdtBodySetPosition(upper, 0, 9, 0);
    ck_assert(!MdtBodyMovedByStep(upper, moves));
    MdtWorldStep(world, FRAME);
    ck_assert(!MdtBodyMovedByStep(upper, moves));
}
