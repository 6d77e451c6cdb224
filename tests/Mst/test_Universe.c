/* Universes: what they are made of, the guide's programs, and stacks that stand and go to sleep. */
#include "universe.h"

static MeMatrix4 ground;

static void setUp(void) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    sizes.dynamicConstraintsMaxCount = 1000;
    universe_begin(&sizes);
    MdtWorldSetGravity(MstUniverseGetWorld(u), 0, 0, -9.81);
    MeMatrix4TMMakeIdentity(ground);
}

TEST_FIXTURE(setUp, NULL)

static McdModelID makeGround(void) {
    return MstFixedModelCreate(u, McdPlaneCreate(MstUniverseGetFramework(u)), ground);
}

static McdModelID makeBox(double size, double x, double y, double z) {
    const MeReal s = size;
    McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(MstUniverseGetFramework(u), s, s, s), 1);
    McdModelDynamicsSetPosition(m, x, y, z);
    return m;
}

static double heightOf(McdModelID m) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    return (double)p[2];
}

static void run(double seconds) {
    universe_step((int)(60 * seconds));
}

static void setFriction(double coefficient, double restitution) {
    MdtContactParamsID p = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetType(p, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(p, MdtFrictionModelCone);
    MdtContactParamsSetFrictionCoeffecient(p, coefficient);
    MdtContactParamsSetRestitution(p, restitution);
}

/* ---- what it is made of ------------------------------------------------------------------------------------------ */

TEST(the_default_sizes_are_the_guides) {
    const MstUniverseSizes *s = &MstUniverseDefaultSizes;
    ck_assert(s->dynamicBodiesMaxCount == 100 && s->dynamicConstraintsMaxCount == 500);
    ck_assert(s->collisionUserGeometryTypesMaxCount == 0 && s->collisionModelsMaxCount == 100);
    ck_assert(s->collisionPairsMaxCount == 500 && s->collisionGeometryInstancesMaxCount == 100);
    ck_assert(s->materialsMaxCount == 10 && s->lengthScale == 1 && s->massScale == 1);
}

TEST(its_parts_are_there) {
    ck_assert_ptr_eq(MstUniverseGetWorld(u), u->world);
    ck_assert_ptr_eq(MstUniverseGetFramework(u), u->frame);
    ck_assert_ptr_eq(MstUniverseGetSpace(u), u->space);
    ck_assert_ptr_eq(MstUniverseGetBridge(u), u->bridge);
    ck_assert_int_eq(MdtWorldGetMaxBodies(u->world), 100);
    ck_assert_int_eq(MdtWorldGetMaxConstraints(u->world), 1000);
    ck_assert(u->sizes.collisionModelsMaxCount == 100 && McdSpaceIsChanging(u->space));
    MstUniverseID other = MstUniverseCreate(0);
    ck_assert_int_eq(MdtWorldGetMaxConstraints(other->world), 500);
    MstUniverseDestroy(other);
}

TEST(bad_sizes_make_no_universe) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    sizes.collisionModelsMaxCount = 0x80000000u;
    ck_assert_ptr_null(MstUniverseCreate(&sizes));
    assert_warned("could not be created");
    MstUniverseDestroy(0);
    assert_silent();
    MstUniverseStep(0, 1);
    assert_warned("no universe");
}

/* User Guide ch. 4, "Making a Model with a Box Geometry": density 1, 2 x 1 x 3. */
TEST(a_box_model_has_the_mass_of_its_geometry) {
    MeMatrix3 inertia;
    McdGeometryID boxGeom = McdBoxCreate(u->frame, 2, 1, 3);
    McdModelID boxModel = MstModelAndBodyCreate(u, boxGeom, 1), boxModel2 = MstModelAndBodyCreate(u, boxGeom, 2);
    MdtBodyID body = McdModelGetBody(boxModel);
    ck_assert(MdtBodyIsEnabled(body) && McdModelGetSpace(boxModel) == u->space);
    assert_near(MdtBodyGetMass(body), 6, TOL(1e-6, 6e-14));
    assert_near(MdtBodyGetMass(McdModelGetBody(boxModel2)), 12, TOL(1e-6, 2e-13));
    MdtBodyGetInertiaTensor(body, inertia);
    assert_near(inertia[0][0], 6 * (1 + 9) / 12., TOL(1e-5, 5e-14));
    assert_near(inertia[1][1], 6 * (4 + 9) / 12., TOL(1e-5, 6e-14));
    assert_near(inertia[2][2], 6 * (4 + 1) / 12., TOL(1e-5, 3e-14));
    assert_near(inertia[0][1], 0, TOL(1e-6, 9e-15));
}

TEST(a_model_and_its_body_go_together) {
    McdModelID floor = makeGround(), box = makeBox(1, 0, 0, .5);
    run(.1);
    ck_assert_int_gt(MdtWorldGetTotalConstraints(u->world), 0);
    MstModelAndBodyDestroy(box);
    ck_assert(MdtWorldGetTotalConstraints(u->world) == 0 && MdtWorldGetTotalBodies(u->world) == 0);
    ck_assert_int_eq(McdFrameworkGetModelCount(u->frame), 1);
    box = makeBox(1, 0, 0, .5);
    run(.1);
    MstFixedModelDestroy(floor);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(u->world), 0);
    run(.5);
    assert_below(heightOf(box), 0);
}

/* A box that falls on it lies where the analytic pose says; the caller's numbers are not needed any more. */
TEST(a_fixed_model_may_copy_its_pose) {
    const double angle = .3;
    MeVector3 place = {1, 2, 3};
    MeVector4 turn = {(MeReal)(2 * cos(angle / 2)), (MeReal)(2 * sin(angle / 2)), 0, 0}; /* of length 2 */
    const McdGeometryID slab = McdBoxCreate(u->frame, 4, 4, 1);
    const McdModelID m = MstFixedModelCreateAt(u, slab, place, turn);
    const MeMatrix4Ptr tm = McdModelGetTransformPtr(m);
    MeVector3 normal;
    memset(place, 0, sizeof place);
    memset(turn, 0, sizeof turn);
    ck_assert(McdModelGetSpace(m) == u->space && McdSpaceModelIsFrozen(m));
    assert_vec3_near(tm[3], 1, 2, 3, 0);
    assert_vec3_near(tm[2], 0, -sin(angle), cos(angle), TOL(1e-6, 1e-15));
    setFriction(1, 0);
    const McdModelID box = makeBox(1, 1, 2 - sin(angle), 3 + cos(angle));
    McdModelDynamicsSetQuaternion(box, (MeReal)cos(angle / 2), (MeReal)sin(angle / 2), 0, 0);
    run(1);
    MeVector3Subtract(normal, McdModelGetTransformPtr(box)[3], tm[3]);
    assert_near(MeVector3Dot(normal, tm[2]), 1, TOL(1e-5, 1e-5));
    const McdModelID flat = MstFixedModelCreateAt(u, slab, place, 0);
    for (int i = 0; i < 3; i++)
        ck_assert(McdModelGetTransformPtr(flat)[i][i] == 1 && McdModelGetTransformPtr(flat)[3][i] == 0);
    McdModelSetTransformPtr(flat, ground);
    ck_assert(McdModelGetTransformPtr(flat) == ground);
    MstFixedModelDestroy(flat);
    MstFixedModelDestroy(m);
    ck_assert_int_eq(McdFrameworkGetModelCount(u->frame), 1);
}

/* Its transform is the program's to write, as that of any fixed model: with a lift's speed it carries a box. */
TEST(a_fixed_model_with_its_own_pose_moves) {
    static const MeVector3 place = {0, 0, -.5};
    const McdModelID lift = MstFixedModelCreateAt(u, McdBoxCreate(u->frame, 4, 4, 1), place, 0);
    const McdModelID box = makeBox(1, 0, 0, .5);
    run(.5);
    McdSpaceUnfreezeModel(lift);
    for (int i = 1; i <= 60; i++) {
        McdModelGetTransformPtr(lift)[3][2] = (MeReal)(-.5 + i / 60.);
        universe_step(1);
    }
    assert_near(heightOf(box), 1.5, TOL(1e-5, 1e-5));
}

TEST(a_fixed_model_needs_a_pose) {
    static const MeVector3 place = {0, 0, 0}, nowhere = {0, NAN, 0};
    static const MeVector4 none = {0, 0, 0, 0}, wrong = {1, INFINITY, 0, 0}, unit = {1, 0, 0, 0};
    const McdGeometryID g = McdSphereCreate(u->frame, 1);
    assert_none(MstFixedModelCreateAt, u, g, NULL, unit);
    assert_none(MstFixedModelCreateAt, u, g, nowhere, unit);
    assert_none(MstFixedModelCreateAt, u, g, place, none);
    assert_none(MstFixedModelCreateAt, u, g, place, wrong);
    assert_none(MstFixedModelCreateAt, u, 0, place, unit);
    ck_assert_int_eq(McdFrameworkGetModelCount(u->frame), 0);
}

TEST(the_step_may_be_driven_by_hand) {
    MstUniverseID other = MstUniverseCreate(0);
    MeMatrix4 tm;
    double height[2];
    for (int k = 0; k < 2; k++) {
        MstUniverseID universe = k ? other : u;
        MeMatrix4Ptr at = k ? tm : ground;
        MdtWorldSetGravity(universe->world, 0, 0, -9.81);
        MeMatrix4TMMakeIdentity(at);
        MstFixedModelCreate(universe, McdPlaneCreate(universe->frame), at);
        McdModelID m = MstModelAndBodyCreate(universe, McdSphereCreate(universe->frame, 1), 1);
        McdModelDynamicsSetPosition(m, 0, 0, 2);
        for (int i = 0; i < 60; i++) {
            if (k) {
                McdSpaceUpdateAll(universe->space);
                MstBridgeUpdateContacts(universe->bridge, universe->space, universe->world);
                MdtWorldStep(universe->world, 1. / 60);
            } else {
                MstUniverseStep(universe, 1. / 60);
            }
        }
        height[k] = heightOf(m);
    }
    ck_assert(height[0] == height[1]);
    MstUniverseDestroy(other);
}

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

TEST(a_box_rests_on_the_floor_and_goes_to_sleep) {
    makeGround();
    McdModelID box = makeBox(1, 0, 0, .6);
    run(3);
    assert_near(heightOf(box), .5, TOL(2e-5, 9e-12));
    ck_assert(!McdModelDynamicsIsEnabled(box) && McdSpaceModelIsFrozen(box));
    MdtBodyEnable(McdModelGetBody(box));
    ck_assert(!McdSpaceModelIsFrozen(box));
}

/* A ball falls from h, rebounds with e: where it is after a time, in closed form. */
static double bounce(double h, double e, double time) {
    double v = -sqrt(2 * 9.81 * h), fall = sqrt(2 * h / 9.81);
    if (time < fall)
        return h - 9.81 / 2 * time * time;
    for (time -= fall;; time -= -2 * v / 9.81) {
        v *= e;
        if (time < -2 * v / 9.81)
            return -v * time - 9.81 / 2 * time * time;
    }
}

/* At 10 m/s a frame takes it 16 cm on: it looks ahead, or it would be deep in the floor before it touches. */
TEST(a_fast_ball_rebounds_at_the_floor) {
    MdtContactParamsSetRestitution(MstBridgeGetContactParams(u->bridge, 0, 0), .8);
    makeGround();
    McdModelID ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .5), 1000);
    McdModelDynamicsSetPosition(ball, 0, 0, 5.5);
    for (int i = 1; i <= 240; i++) {
        MstUniverseStep(u, 1. / 60);
        assert_near(heightOf(ball), .5 + bounce(5, .8, i / 60.), TOL(3e-5, 5e-13));
    }
}

/* Clubs of unequal moments that spin at 80 rad/s and strike the floor: where a step met in time does not find their
 * motion, it is taken in parts, and nobody need be warned. */
TEST(what_spins_fast_may_strike) {
    const McdGeometryID g = McdBoxCreate(u->frame, .12, .4, .06);
    setFriction(.3, .3);
    makeGround();
    for (int i = 0; i < 8; i++) {
        McdModelID club = MstModelAndBodyCreate(u, g, 700);
        McdModelDynamicsSetPosition(club, 2. * i, 0, .3);
        McdModelDynamicsSetAngularVelocity(club, 76. - 10 * i, 5. + i, 10. * i - 30);
        McdModelDynamicsSetLinearVelocity(club, 1, .2 * i, -2);
    }
    run(4);
}

/* 9 cm at 20 and 100 m/s: 3.7 and 18 rad in a step, which is divided. It neither sinks, nor jumps, nor changes its
 * speed. */
TEST(a_ball_rolls_on_however_fast_it_turns) {
    for (int k = 0; k < 2; k++) {
        const double speed = k ? 100 : 20, radius = .09;
        MeVector3 v;
        setUp();
        setFriction(.5, 0);
        makeGround();
        MdtWorldSetEpsilon(u->world, 0);
        McdModelID ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, radius), 500);
        McdModelDynamicsSetPosition(ball, 0, 0, radius);
        McdModelDynamicsSetLinearVelocity(ball, speed, 0, 0);
        McdModelDynamicsSetAngularVelocity(ball, 0, speed / radius, 0);
        for (int i = 0; i < 300; i++) {
            MstUniverseStep(u, 1. / 60);
            assert_near(heightOf(ball), radius, TOL(6e-6, 1e-9));
        }
        McdModelDynamicsGetLinearVelocity(ball, v);
        assert_near_rel(v[0], speed, TOL(6e-6, 1e-9));
    }
}

/* What the performance bar shows: both sections of a step, whoever measures. */
TEST(a_step_is_profiled_as_collision_and_dynamics) {
    makeGround();
    makeBox(1, 0, 0, 0.5);
    MeProfileStartTiming((MeProfileTimerMode){kMeProfileCounterModeFlops}, kMeProfileDontLog);
    MeProfileStartFrame();
    MstUniverseStep(u, 1. / 60);
    MeProfileEndFrame();
    assert_below(0, MeProfileGetSectionTime("Collision"));
    assert_below(0, MeProfileGetSectionTime("Dynamics"));
    assert_near(MeProfileGetSectionTime("Collision") + MeProfileGetSectionTime("Dynamics"),
                MeProfileGetAllSectionTime(), TOL(1e-9, 1e-15));
    MeProfileStopTiming();
}
