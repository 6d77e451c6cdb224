/* What is destroyed, moved to another world or given by mistake while it touches something: one message at most, which
 * says what to do, and the scene goes on. */
#include "universe.h"

#define STEP ((MeReal)(1. / 60))

static McdGeometryID unit;

static void beginWith(const MstUniverseSizes *sizes, double gravity) {
    universe_begin(sizes);
    MdtWorldSetGravity(u->world, 0, 0, -gravity);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), .5, 0);
    universe_addFloor();
    unit = McdBoxCreate(u->frame, sizes->lengthScale, sizes->lengthScale, sizes->lengthScale);
}

static void begin(void) {
    beginWith(&MstUniverseGrowingSizes, 9.8);
}

static McdModelID add(double x, double z) {
    const McdModelID m = MstModelAndBodyCreate(u, unit, 100);
    McdModelDynamicsSetPosition(m, x, 0, z);
    return m;
}

static void step(int n) {
    universe_step(n);
}

static double heightOf(McdModelID m) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    return (double)p[2];
}

static void assert_said(const char *function, const char *what) {
    ck_assert_msg(caught.warnings == 1, "%d warnings, the last: %s", caught.warnings, caught.last);
    ck_assert_msg(strncmp(caught.last, function, strlen(function)) == 0, "'%s' does not begin with %s", caught.last,
                  function);
    assert_warned(what);
}

/* ---- bodies and models ------------------------------------------------------------------------------------------- */

/* Of a model that touches others: its contacts go with the body. The model may go later, or stay where it is put. */
TEST(the_body_of_a_model_that_touches_another) {
    for (int way = 0; way < 3; way++) {
        static MeMatrix4 tm;
        begin();
        const McdModelID low = add(0, .5), middle = add(0, 1.5), high = add(0, 2.5);
        step(10);
        const MdtBodyID b = McdModelGetBody(middle);
        MdtBodyDestroy(b);
        ck_assert(!MdtBodyIsValid(b) && !McdModelGetBody(middle));
        if (way == 1)
            McdModelDestroy(middle);
        MeMatrix4TMMakeIdentity(tm);
        tm[3][2] = (MeReal)1.5;
        if (way == 2)
            McdModelSetTransformPtr(middle, tm);
        step(60);
        if (way == 0)
            assert_said("MstUniverseStep", "body was destroyed");
        assert_near(heightOf(low), .5, .02);
        assert_near(heightOf(high), way == 2 ? 2.5 : 1.5, .02);
    }
}

/* A compound by hand: the models of one body make no contacts with each other, however they overlap, but sensors
 * among them sense. */
TEST(two_models_on_one_body) {
    for (int isSensor = 0; isSensor < 2; isSensor++) {
        begin();
        const McdModelID m = add(0, .5), other = McdModelCreate(unit);
        McdModelSetBody(other, McdModelGetBody(m));
        McdModelSetSensor(other, isSensor);
        McdSpaceInsertModel(u->space, other);
        int count, overlaps = 0;
        step(1);
        const MstEvent *event = MstUniverseGetEvents(u, &count);
        for (int i = 0; i < count; i++)
            overlaps += (event[i].model1 == m && event[i].model2 == other) ||
                        (event[i].model1 == other && event[i].model2 == m);
        ck_assert_int_eq(overlaps, isSensor);
        step(60);
        assert_near(heightOf(m), .5, .02);
        ck_assert_int_eq(MdtWorldGetTotalBodies(u->world), 1);
    }
}

/* It makes no contacts, with fixed models or others, in any order; said once. */
TEST(a_body_of_another_world) {
    for (int way = 0; way < 3; way++) {
        begin();
        const MdtWorldID other = MdtWorldCreate(10, 10, 1, 1);
        const McdModelID strange = McdModelCreate(unit), own = way ? add(0, way == 1 ? 1.4 : .5) : 0;
        const MdtBodyID b = MdtBodyCreate(other);
        McdModelSetBody(strange, b);
        MdtBodyEnable(b);
        MdtBodySetPosition(b, 0, 0, way == 2 ? 1.4 : .4);
        McdSpaceInsertModel(u->space, strange);
        step(60);
        assert_said("MstUniverseStep", "MstUniverseGetWorld");
        if (own)
            assert_near(heightOf(own), .5, .02); /* falls through it */
        McdModelDestroy(strange);
        MdtWorldDestroy(other);
        step(2);
    }
}

/* ---- groups ------------------------------------------------------------------------------------------------------ */

static MdtContactGroupID groupOf(McdModelID m) {
    MdtConstraintID c = MdtBodyGetFirstConstraint(McdModelGetBody(m));
    while (c && !MdtConstraintDCastContactGroup(c))
        c = MdtBodyGetNextConstraint(McdModelGetBody(m), c);
    ck_assert_ptr_nonnull(c);
    return MdtConstraintDCastContactGroup(c);
}

static void *nobody;

/* It is the bridge's: it stays with its two models. */
TEST(the_bodies_of_a_bridges_group) {
    for (int way = 0; way < 5; way++) {
        begin();
        const McdModelID m = add(0, .5), other = add(5, .5);
        const MdtBodyID b = McdModelGetBody(other);
        step(10);
        const MdtContactGroupID g = groupOf(m);
        const char *const name[] = {"MdtConstraintSetBodies", "MdtContactGroupSetBodies", "MdtContactGroupSetGenerator",
                                    "MdtContactGroupSetHolder", "MdtContactGroupAppendContact"};
        if (way == 0)
            MdtConstraintSetBodies(MdtContactGroupQuaConstraint(g), b, 0);
        if (way == 1)
            MdtContactGroupSetBodies(g, b, 0);
        if (way == 2)
            MdtContactGroupSetGenerator(g, 0);
        if (way == 3)
            MdtContactGroupSetHolder(g, &nobody);
        if (way == 4)
            MdtContactGroupAppendContact(g, MdtContactCreate(u->world));
        assert_said(name[way], "made by a bridge");
        ck_assert_ptr_eq(MdtContactGroupGetBody(g, 0), McdModelGetBody(m));
        step(60);
        assert_near(heightOf(m), .5, .02);
        MstModelAndBodyDestroy(m);
        MstModelAndBodyDestroy(other);
        step(2);
    }
}

/* Its record continues another group, of more than four contacts, or is that of a lone contact. */
TEST(a_groups_handle_whose_record_is_used_again) {
    for (int isLone = 0; isLone < 2; isLone++) {
        begin();
        enum { CONTACTS = 64, GROUPS = 8 };
        MdtContactGroupID stale[GROUPS];
        const MdtContactGroupID g = MdtContactGroupCreate(u->world);
        for (int i = 0; i < GROUPS; i++)
            stale[i] = MdtContactGroupCreate(u->world);
        for (int i = 0; i < GROUPS; i++)
            MdtContactGroupDestroy(stale[i]);
        for (int i = 0; i < CONTACTS; i++)
            ck_assert(isLone ? MdtContactCreate(u->world) != 0 : MdtContactGroupCreateContact(g) != 0);
        for (int i = 0; i < GROUPS; i++) {
            const MdtConstraintID c = (MdtConstraintID)(void *)stale[i];
            ck_assert(!MdtConstraintIsValid(c));
            ck_assert_int_eq(MdtContactGroupGetCount(stale[i]), 0);
            assert_said("MdtContactGroupGetCount", "");
            MdtContactGroupDestroy(stale[i]);
            assert_said("MdtContactGroupDestroy", "");
            MdtConstraintDestroy(c);
            assert_said("MdtConstraintDestroy", "destroyed");
        }
        ck_assert_int_eq(MdtContactGroupGetCount(g), isLone ? 0 : CONTACTS);
    }
}

/* ---- contacts ---------------------------------------------------------------------------------------------------- */

static McdContact kept;
static int keptSide;

static MeBool keep(McdIntersectResult *r, McdContact *c, MdtContactID d) {
    (void)d;
    kept = *c;
    keptSide = McdModelGetGeometry(r->pair->model1) != McdModelGetGeometry(r->pair->model2) &&
               McdModelGetBody(r->pair->model1) == 0;
    return METRUE;
}

TEST(the_rim_of_a_contact_whose_model_has_gone) {
    double axis[3];
    for (int way = 0; way < 3; way++) {
        begin();
        MstBridgeSetPerContactCB(u->bridge, 0, 0, keep);
        const McdModelID m = MstModelAndBodyCreate(u, McdCylinderCreate(u->frame, 1, 1), 100);
        McdModelDynamicsSetPosition(m, 0, 0, .5);
        step(2);
        MdtBodyDestroy(McdModelGetBody(m)); /* that the model has moved is no message */
        assert_near(McdContactGetRim(&kept, keptSide, axis), 0, 0);
        assert_silent();
        McdModelDestroy(m);
        for (int i = 0; i < 50 && way == 1; i++)
            add(2 * i, 9); /* its record is used again */
        if (way == 2)
            McdFrameworkDestroyAllModelsAndGeometries(u->frame);
        assert_near(McdContactGetRim(&kept, keptSide, axis), 0, 0);
        if (way != 1)
            assert_said("McdContactGetRim", "destroyed");
        caught.warnings = 0;
    }
}

/* ---- numbers ----------------------------------------------------------------------------------------------------- */

TEST(a_centre_of_mass_beyond_reach) {
    const MeReal far[] = {3e38, -3e38, 1e20, INFINITY, NAN};
    for (int i = 0; i < 5; i++)
        for (int axis = 0; axis < 3; axis++) {
            MeMatrix4 tm;
            begin();
            const McdModelID m = add(0, .5);
            MeMatrix4TMMakeIdentity(tm);
            tm[3][axis] = far[i];
            MdtBodySetCenterOfMassRelativeTransform(McdModelGetBody(m), tm);
            assert_said("MdtBodySetCenterOfMassRelativeTransform", "nothing is changed");
            MdtBodySetCenterOfMassRelativePosition(McdModelGetBody(m), tm[3]);
            assert_said("MdtBodySetCenterOfMassRelativePosition", "nothing is changed");
            MdtBodySetCenterOfMassPosition(McdModelGetBody(m), tm[3]);
            assert_said("MdtBodySetCenterOfMassPosition", "nothing is changed");
            step(10);
            assert_near(heightOf(m), .5, .02);
        }
}

/* Shapes of all sizes that there can be, in each other: the distance is a number. */
TEST(the_depth_of_tiny_and_huge_shapes) {
    static MeMatrix4 tm[2];
    begin();
    const double min = sizeof(MeReal) == 4 ? 1e-37 : 1e-300;
    for (double size = min; size < 1e37; size *= 3) {
        McdDistanceResult result;
        const McdModelID a = McdModelCreate(McdBoxCreate(u->frame, size, size, size)),
                         b = McdModelCreate(McdConeCreate(u->frame, size, size));
        for (int i = 0; i < 2; i++)
            MeMatrix4TMMakeIdentity(tm[i]);
        tm[1][3][0] = (MeReal)(.1 * size);
        McdModelSetTransformPtr(a, tm[0]);
        McdModelSetTransformPtr(b, tm[1]);
        McdModelPair *p = McdModelPairCreate(a, b);
        if (McdDistance(p, &result))
            ck_assert(isfinite(result.distance));
        McdModelPairDestroy(p);
        McdModelDestroy(a);
        McdModelDestroy(b);
    }
    caught.warnings = 0;
}

/* ---- through the floor ------------------------------------------------------------------------------------------- */

/* A program that counts in millimetres and leaves the mass scale, and the density of water in kg/m3: whatever sinks is
 * told of, and nothing that is right. */
TEST(lengths_are_scaled_and_masses_are_not) {
    for (double size = 100; size <= 1000; size *= 10)
        for (int isRight = 0; isRight < 2; isRight++) {
            MstUniverseSizes sizes = MstUniverseGrowingSizes;
            sizes.lengthScale = 1000;
            sizes.massScale = isRight ? (MeReal)1e12 : 1;
            beginWith(&sizes, 9800);
            const McdGeometryID box = McdBoxCreate(u->frame, size, size, size);
            const McdModelID m = MstModelAndBodyCreate(u, box, 1000);
            McdModelDynamicsSetPosition(m, 0, 0, size / 2);
            step(60);
            if (isRight)
                assert_near(heightOf(m), size / 2, .01 * size);
            else
                assert_said("MstUniverseStep", "massScale");
        }
}

static int countBelow(double height, const McdModelID list[], int count) {
    int below = 0;
    for (int i = 0; i < count; i++)
        below += !(heightOf(list[i]) > height);
    return below;
}

/* Whose work ends before contacts hold: what it leaves is the fast solver's. */
TEST(boxes_in_one_place_by_the_exact_solver) {
    static const struct {
        int boxes;
        double work;
    } crowd[] = {{30, 5}, {40, 20}, {60, 20}};
    for (int c = 0; c < 3; c++) {
        McdModelID m[60];
        begin();
        MdtWorldSetSolver(u->world, MdtSolverExact);
        MdtWorldSetWorkBudget(u->world, crowd[c].work);
        for (int i = 0; i < crowd[c].boxes; i++)
            m[i] = add(0, .6);
        for (int i = 0; i < 30; i++) {
            step(1);
            ck_assert_int_eq(countBelow(.45, m, crowd[c].boxes), 0);
        }
    }
}

/* ---- events ------------------------------------------------------------------------------------------------------ */

static void countEnds(McdModelID a, McdModelID b, int *ofBoth, int *all) {
    int count;
    const MstEvent *event = MstUniverseGetEvents(u, &count);
    for (int i = 0; i < count; i++) {
        const MeBool isBoth =
            (event[i].model1 == a && event[i].model2 == b) || (event[i].model1 == b && event[i].model2 == a);
        *ofBoth += isBoth && event[i].kind == MstEventEnd;
        *all += event[i].kind == MstEventEnd;
    }
}

/* Disabled by the program, and put elsewhere: the touch ends in the next step, however many models there are, and
 * whoever else is awake. */
TEST(a_disabled_body_that_is_moved_away) {
    static MeMatrix4 tm[200];
    for (int way = 0; way < 12; way++) {
        begin();
        for (int i = 0; i < 200; i++) {
            MeMatrix4TMMakeIdentity(tm[i]);
            tm[i][3][0] = (MeReal)(30 + 2 * i);
            MstFixedModelCreate(u, unit, tm[i]);
        }
        const McdModelID low = add(0, .5), high = add(0, 1.5);
        const MdtBodyID b = McdModelGetBody(high);
        const MeVector3 far = {20, 0, 1.5};
        int ends = 0, ofBoth = 0;
        step(10);
        MdtBodyDisable(b);
        if (way & 1)
            MdtBodyDisable(McdModelGetBody(low));
        step(way < 4 ? 3 : way < 8 ? 0 : 40);
        if (way & 2)
            MdtBodySetCenterOfMassPosition(b, far);
        else
            MdtBodySetPosition(b, far[0], far[1], far[2]);
        for (int i = 0; i < 3; i++) {
            step(1);
            countEnds(low, high, &ofBoth, &ends);
            ck_assert_msg(ofBoth == 1 && ends == 1, "way %d, step %d: %d of both, %d in all", way, i, ofBoth, ends);
        }
    }
}
