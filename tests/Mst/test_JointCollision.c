/* Joints whose bodies do not collide with each other: what goes, what stays, and when it comes back. */
#include "universe.h"

static McdModelID arm, shoulder;

static McdModelID box(double x, double y, double z) {
    McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 1, 0.5, 0.5), 1000);
    McdModelDynamicsSetPosition(m, x, y, z);
    return m;
}

/* Two boxes that overlap by a fifth of their length, at whose middle a hinge may be. */
static void setUp(void) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), 0.5, 0);
    shoulder = box(0, 0, 2);
    arm = box(0.8, 0, 2);
}

TEST_FIXTURE(setUp, NULL)

static MdtConstraintID hinge(McdModelID a, McdModelID b, double x) {
    MdtHingeID h = MdtHingeCreate(u->world);
    MdtHingeSetBodies(h, McdModelGetBody(a), b ? McdModelGetBody(b) : 0);
    MdtHingeSetPosition(h, x, 0, 2);
    MdtHingeSetAxis(h, 0, 1, 0);
    MdtHingeEnable(h);
    return MdtHingeQuaConstraint(h);
}

static void run(int steps) {
    universe_step(steps);
}

/* Contacts between two bodies; with null, of all that the first one has. */
static int contactsOf(McdModelID a, McdModelID b) {
    int count = 0;
    for (MdtConstraintID c = MdtConstraintGetFirst(u->world); c; c = MdtConstraintGetNext(c)) {
        const MdtContactID contact = MdtConstraintDCastContactGroup(c) ? 0 : MdtConstraintDCastContact(c);
        if (!contact)
            continue;
        for (unsigned int k = 0; k < 2; k++)
            count += MdtConstraintGetBody(c, k) == McdModelGetBody(a) &&
                     (!b || MdtConstraintGetBody(c, 1 - k) == McdModelGetBody(b));
    }
    return count;
}

static int eventsOf(MstEventKind kind) {
    int all, count = 0;
    const MstEvent *e = MstUniverseGetEvents(u, &all);
    for (int i = 0; i < all; i++)
        count += e[i].kind == kind;
    return count;
}

TEST(by_default_they_collide) {
    const MdtConstraintID h = hinge(arm, shoulder, 0.4);
    ck_assert(MdtConstraintGetBodiesCollide(h));
    run(1);
    ck_assert_int_gt(contactsOf(arm, shoulder), 0);
}

TEST(off_there_is_nothing_between_them_and_all_else_is_as_before) {
    const McdModelID third = box(0.4, 0, 2.45); /* on both of them, a little inside */
    MdtConstraintSetBodiesCollide(hinge(arm, shoulder, 0.4), MEFALSE);
    run(1);
    ck_assert_int_eq(contactsOf(arm, shoulder), 0);
    ck_assert_int_gt(contactsOf(arm, third), 0);
    ck_assert_int_gt(contactsOf(shoulder, third), 0);
}

/* A joint without collision moves to the last bit as one whose models are filtered. */
TEST(the_motion_is_that_of_filtered_models) {
    MeMatrix4 ground, end[2][2];
    MeMatrix4TMMakeIdentity(ground);
    for (int filtered = 0; filtered < 2; filtered++) {
        universe_begin(&MstUniverseGrowingSizes);
        MdtWorldSetGravity(u->world, 0, 0, -9.81);
        MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), 0.5, 0);
        MstFixedModelCreate(u, McdPlaneCreate(u->frame), ground);
        shoulder = box(0, 0, 2);
        arm = box(0.8, 0, 2);
        const MdtConstraintID h = hinge(arm, shoulder, 0.4);
        if (filtered) {
            McdModelSetFilterGroup(arm, -1);
            McdModelSetFilterGroup(shoulder, -1);
        } else {
            MdtConstraintSetBodiesCollide(h, MEFALSE);
        }
        MdtBodySetAngularVelocity(McdModelGetBody(arm), 1, 3, 2);
        run(240);
        memcpy(end[filtered][0], MdtBodyGetTransformPtr(McdModelGetBody(arm)), sizeof ground);
        memcpy(end[filtered][1], MdtBodyGetTransformPtr(McdModelGetBody(shoulder)), sizeof ground);
        ck_assert_int_gt(contactsOf(arm, 0) + contactsOf(shoulder, 0), 0); /* They lie on the ground. */
    }
    ck_assert_int_eq(memcmp(end[0], end[1], sizeof end[0]), 0);
}

static void disable(MdtConstraintID c) {
    MdtConstraintDisable(c);
}

static void switchOn(MdtConstraintID c) {
    MdtConstraintSetBodiesCollide(c, METRUE);
}

static void destroy(MdtConstraintID c) {
    MdtConstraintDestroy(c);
}

static void attachElsewhere(MdtConstraintID c) {
    MdtConstraintDisable(c);
    MdtConstraintSetBodies(c, McdModelGetBody(arm), 0);
    MdtConstraintEnable(c);
}

/* From the next step on, whichever way; nothing has moved meanwhile that would have a pair tested anew. */
TEST(contacts_come_back_when_the_joint_does_not_act) {
    void (*const ways[])(MdtConstraintID) = {disable, switchOn, destroy, attachElsewhere};
    const MdtConstraintID fixed = hinge(shoulder, 0, 0), also = hinge(arm, 0, 0.8);
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
        const MdtConstraintID h = hinge(arm, shoulder, 0.4);
        run(1);
        ck_assert_int_gt(contactsOf(arm, shoulder), 0);
        MdtConstraintSetBodiesCollide(h, MEFALSE);
        ck_assert(!MdtConstraintGetBodiesCollide(h));
        run(1);
        ck_assert_int_eq(contactsOf(arm, shoulder), 0);
        ck_assert_int_eq(eventsOf(MstEventEnd), 1);
        run(1);
        ck_assert_int_eq(eventsOf(MstEventEnd), 0);
        ways[i](h);
        run(1);
        ck_assert_int_gt(contactsOf(arm, shoulder), 0);
        ck_assert_int_eq(eventsOf(MstEventBegin), 1);
        if (ways[i] != destroy)
            MdtConstraintDestroy(h);
    }
    MdtConstraintDestroy(fixed);
    MdtConstraintDestroy(also);
}

/* A switch that is set before the joint is attached, or enabled; and the bodies of a joint that has been theirs. */
TEST(the_order_of_calls_does_not_matter) {
    MdtHingeID h = MdtHingeCreate(u->world);
    const MdtConstraintID c = MdtHingeQuaConstraint(h);
    MdtConstraintSetBodiesCollide(c, MEFALSE);
    MdtConstraintSetBodiesCollide(c, MEFALSE);
    MdtHingeSetBodies(h, McdModelGetBody(shoulder), McdModelGetBody(arm));
    MdtHingeSetPosition(h, 0.4, 0, 2);
    run(1);
    ck_assert_int_gt(contactsOf(arm, shoulder), 0); /* It does not act yet. */
    MdtHingeEnable(h);
    run(1);
    ck_assert_int_eq(contactsOf(arm, shoulder), 0);
    MdtConstraintSetBodiesCollide(c, METRUE);
    MdtConstraintSetBodiesCollide(c, METRUE);
    run(1);
    ck_assert_int_gt(contactsOf(arm, shoulder), 0);
}

TEST(of_several_joints_one_is_enough) {
    const MdtConstraintID a = hinge(arm, shoulder, 0.4), b = hinge(shoulder, arm, 0.4);
    MdtConstraintSetBodiesCollide(b, MEFALSE);
    run(1);
    ck_assert_int_eq(contactsOf(arm, shoulder), 0);
    MdtConstraintDestroy(b);
    run(1);
    ck_assert_int_gt(contactsOf(arm, shoulder), 0);
    MdtConstraintDestroy(a);
}

/* A hub with many contacts finds its joint from the other body's side; the world in place of a body has no models. */
TEST(a_hub_and_the_world) {
    McdModelID part[8];
    for (int i = 0; i < 8; i++) {
        part[i] = box(-0.4 + 0.1 * i, i % 2 ? 0.4 : -0.4, 2);
        hinge(part[i], 0, 0);
    }
    MdtConstraintSetBodiesCollide(hinge(shoulder, 0, 0), MEFALSE);
    MdtConstraintSetBodiesCollide(hinge(arm, shoulder, 0.4), MEFALSE);
    run(1);
    ck_assert_int_eq(contactsOf(arm, shoulder), 0);
    for (int i = 0; i < 8; i++)
        ck_assert_int_gt(contactsOf(part[i], shoulder), 0);
}

TEST(what_slept_on_its_contacts_wakes) {
    const MdtConstraintID fixed = hinge(shoulder, 0, 0), h = hinge(arm, shoulder, 0.4);
    MdtWorldSetGravity(u->world, 0, 0, -9.81);
    run(300);
    ck_assert_int_eq(MdtWorldGetEnabledBodies(u->world), 0);
    ck_assert_int_gt(contactsOf(arm, shoulder), 0);
    MdtConstraintSetBodiesCollide(h, MEFALSE);
    run(30);
    ck_assert_int_eq(contactsOf(arm, shoulder), 0);
    ck_assert((double)MdtBodyGetTransformPtr(McdModelGetBody(arm))[3][2] < 1.9); /* It hangs down. */
    MdtConstraintDestroy(fixed);
}

/* What is fast and held apart is not stopped where it would touch. */
TEST(swept_models_pass_too) {
    const double speed = 200;
    McdModelSetSwept(arm, 1);
    McdModelSetSwept(shoulder, 1);
    McdModelDynamicsSetPosition(arm, 3, 0, 2);
    MdtLinear1ID plane = MdtLinear1Create(u->world);
    MdtLinear1SetBodies(plane, McdModelGetBody(arm), McdModelGetBody(shoulder));
    MdtLinear1SetAxis(plane, 0, 0, 1);
    MdtLinear1Enable(plane);
    MdtConstraintSetBodiesCollide(MdtLinear1QuaConstraint(plane), MEFALSE);
    MdtBodySetLinearVelocity(McdModelGetBody(arm), -speed, 0, 0);
    run(1);
    MeVector3 p;
    MdtBodyGetPosition(McdModelGetBody(arm), p);
    assert_near(p[0], 3 - speed / 60, TOL(4e-6, 1e-12));
}

/* Chains of boxes that overlap, in a heap: their joints' switches change while workers collide and commit. */
static void heap(MeTaskPoolID pool, MeMatrix4 end[]) {
    enum { CHAINS = 40, LINKS = 6 };
    McdModelID m[CHAINS * LINKS];
    MdtConstraintID joint[CHAINS * LINKS] = {0};
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, -9.81);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), 0.5, 0);
    MdtWorldSetSolver(u->world, MdtSolverFast);
    MdtWorldSetTaskPool(u->world, pool);
    universe_addFloor();
    for (int i = 0; i < CHAINS * LINKS; i++) {
        const int chain = i / LINKS, k = i % LINKS;
        m[i] = box(0.8 * k + 0.1 * (chain % 3), 0.6 * (chain % 5), 0.3 + 0.52 * (chain / 5));
        if (k == 0)
            continue;
        MdtBSJointID j = MdtBSJointCreate(u->world);
        MdtBSJointSetBodies(j, McdModelGetBody(m[i - 1]), McdModelGetBody(m[i]));
        MdtBSJointSetPosition(j, 0.8 * k - 0.4 + 0.1 * (chain % 3), 0.6 * (chain % 5), 0.3 + 0.52 * (chain / 5));
        MdtBSJointEnable(j);
        joint[i] = MdtBSJointQuaConstraint(j);
        MdtConstraintSetBodiesCollide(joint[i], MEFALSE);
    }
    for (int step = 0; step < 40; step++) {
        for (int i = step % 7; i < CHAINS * LINKS; i += 7)
            if (joint[i])
                MdtConstraintSetBodiesCollide(joint[i], !MdtConstraintGetBodiesCollide(joint[i]) && step > 20);
        run(1);
    }
    for (int i = 0; i < CHAINS * LINKS; i++)
        memcpy(end[i], MdtBodyGetTransformPtr(McdModelGetBody(m[i])), sizeof end[i]);
}

TEST(on_any_number_of_workers) {
    static MeMatrix4 alone[240], shared[240];
    heap(0, alone);
    for (int workers = 2; workers <= 4; workers += 2) {
        MeTaskPoolID pool = MeTaskPoolCreate(workers);
        heap(pool, shared);
        ck_assert_int_eq(memcmp(alone, shared, sizeof alone), 0);
        universe_begin(&MstUniverseGrowingSizes);
        MeTaskPoolDestroy(pool);
    }
}

TEST(bad_input) {
    run(1);
    const MdtConstraintID c = MdtConstraintGetFirst(u->world);
    ck_assert_ptr_nonnull(MdtConstraintDCastContactGroup(c));
    MdtConstraintSetBodiesCollide(c, MEFALSE);
    assert_warned("MdtConstraintSetBodiesCollide: a");
    ck_assert(MdtConstraintGetBodiesCollide(c));
    assert_refused(MdtConstraintSetBodiesCollide, 0, MEFALSE);
    assert_none(MdtConstraintGetBodiesCollide, 0);
}
