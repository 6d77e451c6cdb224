/* Typical beginner's mistakes: each gets one message that says what to do, or the neutral result of the documents. None
 * ends the program. */
#include "Mst.h"
#include "karma_test.h"

static MstUniverseID u;
static McdFrameworkID frame;
static MdtWorldID world;
static MdtContactParamsID surface;
static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

static void setup(void) {
    u = MstUniverseCreate(&MstUniverseGrowingSizes);
    frame = MstUniverseGetFramework(u);
    world = MstUniverseGetWorld(u);
    surface = MstBridgeGetContactParams(MstUniverseGetBridge(u), 0, 0);
    MdtWorldSetGravity(world, 0, 0, -9.8);
}

static void teardown(void) {
    assert_silent();
    MstUniverseDestroy(u);
}
TEST_FIXTURE(setup, teardown)

static void step(int count) {
    for (int i = 0; i < count; i++)
        MstUniverseStep(u, 1.0 / 60);
}

static McdModelID boxAt(MeReal x, MeReal z) {
    McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(frame, 1, 1, 1), 1000);
    McdModelDynamicsSetPosition(m, x, 0, z);
    return m;
}

static McdModelID plane(void) {
    return MstFixedModelCreate(u, McdPlaneCreate(frame), floorTM);
}

static double coordinate(McdModelID m, int axis) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    return (double)p[axis];
}

static MdtHingeID hingeOf(McdModelID m) {
    MdtHingeID h = MdtHingeCreate(world);
    MdtHingeSetBodies(h, McdModelGetBody(m), 0);
    return h;
}

/* One message, which begins with the function and says what is to be done. */
static void assert_said(const char *function, const char *what) {
    ck_assert_msg(caught.warnings == 1, "%d warnings, the last: %s", caught.warnings, caught.last);
    ck_assert_msg(strncmp(caught.last, function, strlen(function)) == 0, "'%s' does not begin with %s", caught.last,
                  function);
    assert_warned(what);
}

/* ---- a world ---- */

TEST(no_gravity) {
    MdtWorldID w = MdtWorldCreate(1, 0);
    MdtBodyEnable(MdtBodyCreate(w));
    for (int i = 0; i < 120; i++)
        MdtWorldStep(w, 1.0 / 60);
    assert_said("MdtWorldStep", "MdtWorldSetGravity");
    MdtWorldDestroy(w);
}

TEST(no_gravity_in_a_universe) {
    MstUniverseID empty = MstUniverseCreate(&MstUniverseGrowingSizes);
    MstModelAndBodyCreate(empty, McdBoxCreate(MstUniverseGetFramework(empty), 1, 1, 1), 1);
    for (int i = 0; i < 120; i++)
        MstUniverseStep(empty, 1.0 / 60);
    assert_said("MstUniverseStep", "MdtWorldSetGravity");
    MstUniverseDestroy(empty);
}

TEST(steps_that_are_none) {
    const MeReal steps[] = {0, -1, (MeReal)NAN};
    McdModelID m = boxAt(0, 3);
    for (int i = 0; i < 3; i++) {
        MstUniverseStep(u, steps[i]);
        assert_said("MstUniverseStep", "must be positive");
    }
    assert_near(coordinate(m, 2), 3, 0);
    MstUniverseStep(0, 1);
    assert_said("MstUniverseStep", "null");
    MdtWorldStep(0, 1);
    assert_said("MdtWorldStep", "null");
}

/* Said once, however many steps follow; a step in which a dropped body falls by less than the length scale is not
 * spoken of: sqrt(2 / 9.8) s. */
TEST(a_step_in_milliseconds) {
    boxAt(0, 3);
    MstUniverseStep(u, 0.45);
    MstUniverseStep(u, 0.46);
    assert_said("MstUniverseStep", "seconds");
    MstUniverseStep(u, 16);
}

/* What is left of the universe goes with it, without a word: the step has said what was wrong. */
TEST(a_part_of_the_universe_is_destroyed) {
    for (int part = 0; part < 4; part++) {
        MstUniverseID other = MstUniverseCreate(&MstUniverseGrowingSizes);
        MstModelAndBodyCreate(other, McdBoxCreate(MstUniverseGetFramework(other), 1, 1, 1), 1);
        if (part == 0)
            MdtWorldDestroy(MstUniverseGetWorld(other));
        if (part == 1)
            MstBridgeDestroy(MstUniverseGetBridge(other));
        if (part >= 2)
            McdSpaceDestroy(MstUniverseGetSpace(other));
        if (part == 3)
            McdTerm(MstUniverseGetFramework(other));
        caught.warnings = 0; /* a framework says what is still in it */
        MstUniverseStep(other, 0.01);
        assert_said("MstUniverseStep", "MstUniverseDestroy");
        MstUniverseDestroy(other);
        assert_silent();
        MstUniverseDestroy(other);
        assert_said("MstUniverseDestroy", "no universe");
    }
}

/* ---- shapes and models ---- */

TEST(sizes_that_are_none) {
    ck_assert_ptr_null(McdSphereCreate(frame, -1));
    assert_said("McdSphereCreate", "not a number > 0");
    ck_assert_ptr_null(McdBoxCreate(frame, 0, 1, 1));
    assert_said("McdBoxCreate", "not a number > 0");
    ck_assert_ptr_null(McdCylinderCreate(frame, 1, NAN));
    assert_said("McdCylinderCreate", "not a number > 0");
    ck_assert_ptr_null(MstModelAndBodyCreate(u, 0, 1000));
    assert_said("MstModelAndBodyCreate", "must be a geometry");
}

TEST(a_density_that_is_none) {
    McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(frame, 1, 1, 1), 0);
    assert_said("MstModelAndBodyCreate", "must be positive");
    assert_near(MdtBodyGetMass(McdModelGetBody(m)), 1, 0);
    MdtBodySetMass(McdModelGetBody(m), 0);
    assert_said("MdtBodySetMass", "must be positive");
}

TEST(a_plane_that_is_to_move) {
    MstModelAndBodyCreate(u, McdPlaneCreate(frame), 1000);
    assert_said("MstModelAndBodyCreate", "MstFixedModelCreate");
}

/* Upright by exchanged axes, which mirrors; by a scale; not filled in. Two digits are as good as all. */
TEST(a_transform_that_is_none) {
    static MeMatrix4 mirrored = {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    static MeMatrix4 scaled = {{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}, {0, 0, 0, 1}}, zero;
    static MeMatrix4 rough = {{1, 0, 0, 0}, {0, (MeReal).71, (MeReal).71, 0}, {0, (MeReal)-.71, (MeReal).71, 0}};
    const MeMatrix4Ptr wrong[] = {mirrored, scaled, zero};
    for (int i = 0; i < 3; i++) {
        McdModelID m = MstFixedModelCreate(u, McdPlaneCreate(frame), wrong[i]);
        assert_said("MstFixedModelCreate", "right angles");
        MstFixedModelDestroy(m);
    }
    MstFixedModelDestroy(MstFixedModelCreate(u, McdPlaneCreate(frame), rough));
    MstFixedModelDestroy(MstFixedModelCreate(u, McdPlaneCreate(frame), 0));
    assert_said("MstFixedModelCreate", "McdModelSetTransformPtr");
}

TEST(a_plane_of_zeros_is_met_by_nothing) {
    static MeMatrix4 zero;
    MstFixedModelCreate(u, McdPlaneCreate(frame), zero);
    assert_said("MstFixedModelCreate", "right angles");
    McdModelID m = boxAt(0, 0);
    MstUniverseStep(u, 1.0 / 60);
    assert_silent(); /* once */
    ck_assert(isfinite(coordinate(m, 2)));
}

TEST(a_geometry_in_use_is_destroyed) {
    McdGeometryID g = McdBoxCreate(frame, 1, 1, 1);
    MstModelAndBodyCreate(u, g, 1000);
    McdGeometryDestroy(g);
    assert_said("McdGeometryDestroy", "still use");
    step(10);
}

TEST(a_model_is_inserted_twice) {
    McdSpaceInsertModel(MstUniverseGetSpace(u), boxAt(0, 3));
    assert_said("McdSpaceInsertModel", "in a space already");
    step(2);
}

TEST(a_fixed_model_is_moved_as_if_it_had_a_body) {
    McdModelDynamicsSetPosition(plane(), 0, 0, 1);
    assert_said("McdModelDynamicsSetPosition", "McdModelSetTransformPtr");
}

TEST(positions_and_turns_that_are_none) {
    McdModelID m = boxAt(0, 3);
    McdModelDynamicsSetPosition(m, NAN, 0, 0);
    assert_said("McdModelDynamicsSetPosition", "nothing is changed");
    assert_near(coordinate(m, 2), 3, 0);
    McdModelDynamicsSetQuaternion(m, 0, 0, 0, 0);
    assert_said("McdModelDynamicsSetQuaternion", "nothing is changed");
    McdModelDynamicsAddForce(m, INFINITY, 0, 0);
    assert_said("McdModelDynamicsAddForce", "nothing is changed");
    MeVector4 q;
    McdModelDynamicsSetQuaternion(m, 2, 0, 0, 0); /* of another length: it is normalized, as documented */
    McdModelDynamicsGetQuaternion(m, q);
    assert_near(q[0], 1, 0);
}

TEST(a_model_that_is_gone_is_used) {
    McdModelID m = boxAt(0, 3);
    MdtBodyID b = McdModelGetBody(m);
    MstModelAndBodyDestroy(m);
    McdModelDynamicsSetPosition(m, 0, 0, 0);
    assert_said("McdModelDynamicsSetPosition", "no model");
    MstModelAndBodyDestroy(m);
    assert_said("MstModelAndBodyDestroy", "destroyed");
    MstFixedModelDestroy(m);
    assert_said("MstFixedModelDestroy", "destroyed");
    MdtBodySetPosition(b, 0, 0, 0);
    assert_said("MdtBodySetPosition", "destroyed");
}

TEST(a_models_body_is_destroyed_alone) {
    McdModelID m = boxAt(0, 3);
    MdtBodyDestroy(McdModelGetBody(m));
    step(2);
    assert_said("MstUniverseStep", "body was destroyed");
    McdModelDynamicsSetPosition(m, 0, 0, 1);
    assert_said("McdModelDynamicsSetPosition", "destroyed");
}

/* ---- joints ---- */

TEST(a_joint_without_bodies) {
    MdtHingeEnable(MdtHingeCreate(world));
    assert_said("MdtHingeEnable", "attached to no body");
    step(2);
}

TEST(a_joint_of_the_world_with_itself) {
    McdModelID m = boxAt(0, 3);
    MdtHingeID h = MdtHingeCreate(world);
    MdtHingeSetBodies(h, 0, 0);
    assert_said("MdtHingeSetBodies", "both bodies are null");
    MdtHingeSetBodies(h, McdModelGetBody(m), McdModelGetBody(m));
    assert_said("MdtHingeSetBodies", "are the same");
}

TEST(a_joint_in_another_world) {
    MdtWorldID other = MdtWorldCreate(1, 1);
    MdtHingeSetBodies(MdtHingeCreate(other), McdModelGetBody(boxAt(0, 3)), 0);
    assert_said("MdtHingeSetBodies", "another world");
    MdtWorldDestroy(other);
}

/* It is held by the world then, or disabled with its last body. */
TEST(a_jointed_body_is_destroyed) {
    McdModelID m1 = boxAt(0, 3), m2 = boxAt(2, 3);
    MdtHingeID h = MdtHingeCreate(world);
    MdtHingeSetBodies(h, McdModelGetBody(m1), McdModelGetBody(m2));
    MdtHingeEnable(h);
    step(2);
    MstModelAndBodyDestroy(m1);
    step(2);
    ck_assert(isfinite(coordinate(m2, 2)));
}

TEST(an_axis_of_no_length) {
    MdtHingeSetAxis(hingeOf(boxAt(0, 3)), 0, 0, 0);
    assert_said("MdtHingeSetAxis", "zero");
}

TEST(stops_in_the_wrong_order) {
    MdtLimitID limit = MdtHingeGetLimit(hingeOf(boxAt(0, 3)));
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(limit), 1);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(limit), -1);
    MdtLimitActivateLimits(limit, METRUE);
    assert_said("MdtLimitActivateLimits", "above the upper one");
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(limit), 2);
    MdtLimitActivateLimits(limit, METRUE);
}

TEST(an_angle_that_is_not_measured) {
    MdtHingeID h = hingeOf(boxAt(0, 3));
    MdtHingeEnable(h);
    step(1);
    MdtLimitGetPosition(MdtHingeGetLimit(h));
    assert_said("MdtLimitGetPosition", "MdtLimitCalculatePosition");
    MdtLimitCalculatePosition(MdtHingeGetLimit(h), METRUE);
    MdtLimitGetPosition(MdtHingeGetLimit(h));
}

/* ---- surfaces ---- */

TEST(a_friction_coefficient_alone) {
    plane();
    MdtContactParamsSetFrictionCoeffecient(surface, 1);
    boxAt(0, (MeReal)0.5);
    step(30);
    assert_said("MstUniverseStep", "MdtContactParamsSetSurface");
}

TEST(surfaces_that_are_none) {
    MdtContactParamsSetSurface(surface, -1, 0);
    assert_said("MdtContactParamsSetSurface", "at least 0");
    MdtContactParamsSetSurface(surface, 1, 50);
    assert_said("MdtContactParamsSetSurface", "between 0 and 1");
    MdtContactParamsSetRestitution(surface, 50);
    assert_said("MdtContactParamsSetRestitution", "between 0 and 1");
}

TEST(a_material_that_nobody_made) {
    plane();
    McdModelSetMaterial(boxAt(0, (MeReal)0.5), 7);
    MstUniverseStep(u, 1.0 / 60);
    assert_said("MstUniverseStep", "MstBridgeGetNewMaterial");
}

/* ---- what starts where it cannot be: pushed apart, slowly, without a word ---- */

TEST(bodies_in_each_other) {
    plane();
    McdModelID m1 = boxAt(0, (MeReal)0.5), m2 = boxAt((MeReal)0.1, (MeReal)0.5), deep = boxAt(5, -3);
    step(120);
    ck_assert(coordinate(m2, 0) - coordinate(m1, 0) > 0.99);
    ck_assert(fabs(coordinate(m1, 2) - 0.5) < 0.01 && fabs(coordinate(deep, 2) - 0.5) < 0.01);
}
