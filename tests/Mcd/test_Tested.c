/* Which pairs need not be tested again: those whose test would read the same bits. */
#include "McdInternal.h"
#include "shapes.h"

typedef struct Probe {
    McdFrameworkID frame;
    McdGeometryID shape[2];
    McdModelID model[2];
    MeMatrix4 tm[2];
    McdModelPair pair;
} Probe;

static Probe p;

static void place(int which, McdGeometryID g) {
    p.shape[which] = g;
    p.model[which] = McdModelCreate(g);
    MeMatrix4TMMakeIdentity(p.tm[which]);
    p.tm[which][3][2] = (MeReal)which;
    McdModelSetTransformPtr(p.model[which], p.tm[which]);
    McdModelUpdate(p.model[which]);
}

static void meet(McdGeometryID first, McdGeometryID second) {
    place(0, first);
    place(1, second);
    memset(&p.pair, 0, sizeof p.pair);
    p.pair.model1 = p.model[0];
    p.pair.model2 = p.model[1];
}

static void setUp(void) {
    p.frame = frame_make(0, 100, 100, 1);
    McdAllRegisterTypes(p.frame);
    McdAllRegisterInteractions(p.frame);
}

TEST_FIXTURE(setUp, NULL)

static MeBool isAsTestedInRound(void) {
    static const MeBool mayMove[2] = {MEFALSE, MEFALSE};
    return McdModelPairCompare(&p.pair, 0, mayMove) == McdPairIsUnchanged;
}

static MeBool isAsTested(void) {
    McdFrameworkBeginRound(p.frame);
    return isAsTestedInRound();
}

/* What has just been changed is seen, once. */
static void assertChanged(const char *what) {
    ck_assert_msg(!isAsTested(), "%s: not seen", what);
    ck_assert_msg(isAsTested(), "%s: seen twice", what);
}

static void meetBoxes(void) {
    meet(McdBoxCreate(p.frame, 1, 1, 1), McdBoxCreate(p.frame, 1, 2, 1));
    assertChanged("a new pair");
}

/* ---- what is the same -------------------------------------------------------------------------------------------- */

TEST(convex_shapes_and_planes_that_stay_are_as_tested) {
    static const MeReal tip[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
    const McdGeometryID shape[] = {McdSphereCreate(p.frame, 1),
                                   McdBoxCreate(p.frame, 1, 1, 1),
                                   McdCylinderCreate(p.frame, 1, 1),
                                   McdSphylCreate(p.frame, 1, 1),
                                   McdConeCreate(p.frame, 1, 1),
                                   McdPlaneCreate(p.frame),
                                   McdConvexMeshCreateHull(p.frame, tip, 4, 0)};
    for (int i = 0; i < 7; i++)
        for (int k = 0; k < 7; k++) {
            meet(shape[i], shape[k]);
            if (shape[i] == shape[5] && shape[k] == shape[5])
                ck_assert(!isAsTested() && !isAsTested()); /* two planes do not interact */
            else
                assertChanged("a new pair");
        }
}

/* ---- what is not ------------------------------------------------------------------------------------------------- */

TEST(the_last_bit_of_a_place_counts) {
    meetBoxes();
    for (int which = 0; which < 2; which++)
        for (int row = 0; row < 4; row++)
            for (int i = 0; i < 3; i++) {
                const MeReal before = p.tm[which][row][i];
                p.tm[which][row][i] = before + (before == 0 ? (MeReal)1e-30 : before * ME_EPSILON);
                assertChanged("an ulp");
                p.tm[which][row][i] = before;
                assertChanged("and back");
            }
}

TEST(every_size_counts) {
    meet(McdSphereCreate(p.frame, 1), McdBoxCreate(p.frame, 1, 1, 1));
    isAsTested();
    McdSphereSetRadius(p.shape[0], 1.1);
    assertChanged("a radius");
    McdBoxSetDimensions(p.shape[1], 1, 1, 2);
    assertChanged("a box");
    McdBoxGetRadii(p.shape[1])[0] = 3;
    assertChanged("a box, through its pointer");
    meet(McdCylinderCreate(p.frame, 1, 1), McdSphylCreate(p.frame, 1, 1));
    isAsTested();
    McdCylinderSetRadius(p.shape[0], 2);
    assertChanged("a cylinder's radius");
    McdCylinderSetHeight(p.shape[0], 2);
    assertChanged("a cylinder's height");
    McdSphylSetRadius(p.shape[1], 2);
    assertChanged("a sphyl's radius");
    McdSphylSetHeight(p.shape[1], 2);
    assertChanged("a sphyl's height");
    meet(McdConeCreate(p.frame, 1, 1), McdPlaneCreate(p.frame));
    isAsTested();
    McdConeSetGeometricalParameters(p.shape[0], 1, 1, .5);
    assertChanged("a cone's top");
}

TEST(another_shape_counts) {
    meetBoxes();
    McdModelSetGeometry(p.model[0], McdBoxCreate(p.frame, 1, 1, 1));
    assertChanged("a shape of the same size");
}

TEST(margins_and_requests_count) {
    McdRequest request;
    meetBoxes();
    McdModelSetContactTolerance(p.model[1], .3);
    assertChanged("a tolerance");
    request = *McdModelPairGetRequestPtr(&p.pair);
    McdModelPairSetRequestPtr(&p.pair, &request);
    ck_assert(isAsTested());
    request.contactMaxCount = 1;
    assertChanged("a request's count");
    request.faceNormalsFirst = METRUE;
    assertChanged("a request's choice");
    McdModelPairForgetTest(&p.pair);
    assertChanged("what was given away");
}

/* Contacts with the second model turned about an axis; isCompared: the pair has been looked at since. */
static void intersectTurned(int axis, MeBool isCompared, McdContact contact[4]) {
    McdIntersectResult result = {.contacts = contact, .contactMaxCount = 4};
    MeVector3 angle = {0, 0, 0};
    MeMatrix3 turn;
    meetBoxes();
    angle[axis] = (MeReal).2;
    MeMatrix3FromEulerAngles(turn, angle[0], angle[1], angle[2]);
    MeMatrix4TMSetRotation(p.tm[1], (const MeVector3 *)turn);
    if (isCompared)
        assertChanged("a turn");
    memset(contact, 0, 4 * sizeof *contact);
    ck_assert(McdIntersect(&p.pair, &result));
    ck_assert_int_gt(result.contactCount, 0);
    for (int i = 0; i < 4; i++)
        contact[i].instance1 = contact[i].instance2 = 0;
}

TEST(tests_read_transforms_as_they_are_not_as_they_were_seen) {
    for (int axis = 0; axis < 3; axis++) {
        McdContact seen[4], notSeen[4];
        intersectTurned(axis, METRUE, seen);
        intersectTurned(axis, MEFALSE, notSeen);
        ck_assert_int_eq(memcmp(seen, notSeen, sizeof seen), 0);
    }
}

TEST(models_stay_as_they_are_within_a_round) {
    meetBoxes();
    p.tm[0][3][0] = 1;
    ck_assert(isAsTestedInRound());
    assertChanged("a move");
}

TEST(a_box_of_the_last_update_is_kept_where_nothing_has_changed) {
    const McdSpaceID s = McdSpaceAxisSortCreate(p.frame, McdAllAxes, 10, 10);
    MeVector3 spin = {0, 0, 1}, low, high;
    meet(McdSphereCreate(p.frame, 1), McdBoxCreate(p.frame, 1, 1, 1));
    McdModelSetAngularVelocityPtr(p.model[1], spin);
    McdModelSetSwept(p.model[1], METRUE);
    McdSpaceInsertModel(s, p.model[0]);
    McdSpaceInsertModel(s, p.model[1]);
    for (int i = 0; i < 5; i++) {
        if (i == 1)
            McdSphereSetRadius(p.shape[0], 2);
        if (i == 2)
            p.tm[0][3][0] = 5;
        McdSpaceSetLookAhead(s, i < 3 ? 0 : 1);
        McdSpacePathUpdateAll(s, i < 4 ? 0 : ME_PI / 4);
        McdModelGetAABB(p.model[0], low, high);
        assert_near(high[0], i == 0 ? 1 : i == 1 ? 2 : 7, TOL(1e-5, 1e-12));
        McdModelGetAABB(p.model[1], low, high);
        ck_assert(high[0] > (MeReal).5 + (MeReal).1 || i < 4); /* its corners turn that way */
        ck_assert(high[0] < (MeReal).5 + (MeReal)1e-5 || i == 4);
    }
    McdSpaceDestroy(s);
}

TEST(a_relative_model_follows_what_it_is_relative_to) {
    const McdSpaceID s = McdSpaceAxisSortCreate(p.frame, McdAllAxes, 10, 10);
    MeMatrix4 beside;
    MeVector3 low, high;
    meetBoxes();
    MeMatrix4TMMakeIdentity(beside);
    beside[3][0] = 3;
    McdModelSetRelativeTransform(p.model[0], beside);
    McdSpaceInsertModel(s, p.model[0]);
    for (int i = 0; i < 3; i++) {
        p.tm[0][3][0] = (MeReal)i;
        McdSpaceUpdateAll(s);
        McdModelGetAABB(p.model[0], low, high);
        assert_near(high[0], i + 3.5, TOL(1e-5, 1e-12));
    }
    McdSpaceDestroy(s);
}

static void MEAPI onIntersect(McdModelID m, McdIntersectResult *result) {
    (void)m, (void)result;
}

static int MEAPI ownIntersect(McdModelPair *pair, McdIntersectResult *result) {
    (void)pair, (void)result;
    return 0;
}

TEST(what_a_program_answers_is_always_asked) {
    meetBoxes();
    McdModelSetIntersectCallback(p.model[0], onIntersect);
    ck_assert(!isAsTested() && !isAsTested());
    McdModelSetIntersectCallback(p.model[0], 0);
    isAsTested();
    ck_assert(isAsTested());
    McdFrameworkGetInteractions(p.frame, kMcdGeometryTypeBox, kMcdGeometryTypeBox)->intersectFn = ownIntersect;
    ck_assert(!isAsTested() && !isAsTested());
}

/* A part of a part, beside others. */
static McdGeometryID nested(McdGeometryID g) {
    MeMatrix4 tm;
    const McdAggregateID inner = McdAggregateCreate(p.frame, 2), outer = McdAggregateCreate(p.frame, 2);
    MeMatrix4TMMakeIdentity(tm);
    McdAggregateAddElement(inner, McdSphereCreate(p.frame, 1), tm);
    McdAggregateAddElement(inner, g, tm);
    McdAggregateAddElement(outer, inner, tm);
    McdAggregateAddElement(outer, McdBoxCreate(p.frame, 1, 1, 1), tm);
    return outer;
}

TEST(parts_their_places_and_sizes_count) {
    const McdGeometryID part = McdCylinderCreate(p.frame, 1, 1), whole = nested(part);
    const McdGeometryID inner = McdAggregateGetElementGeometry(whole, 0);
    meet(whole, McdBoxCreate(p.frame, 1, 1, 1));
    assertChanged("a new pair");
    McdAggregateGetElementTransformPtr(whole, 1)[3][0] = 3;
    assertChanged("a part's place");
    McdAggregateGetElementTransformPtr(inner, 1)[0][1] = (MeReal)1e-30;
    assertChanged("the least turn of a part's part");
    McdCylinderSetHeight(part, 2);
    assertChanged("its height");
    McdSphereSetRadius(McdAggregateGetElementGeometry(inner, 0), 2);
    assertChanged("another's radius");
    const McdGeometryInstanceID instance = McdGeometryInstanceGetChild(McdModelGetGeometryInstance(p.model[0]), 1);
    McdGeometryInstanceSetGeometry(instance, McdBoxCreate(p.frame, 1, 1, 1));
    assertChanged("a part of the same shape");
    MeMatrix4 written;
    McdGeometryInstanceSetTransformPtr(instance, written);
    assertChanged("where a part's place is written");
    p.tm[0][3][1] = 1;
    assertChanged("the whole's place");
    McdGeometryInstanceSetMaterial(instance, 0);
    ck_assert(!isAsTested() && !isAsTested()); /* the material decides what its contacts are */
    McdGeometryInstanceSetMaterial(instance, -1);
    isAsTested();
    ck_assert(isAsTested());
    McdFrameworkGetInteractions(p.frame, kMcdGeometryTypeBox, kMcdGeometryTypeCylinder)->intersectFn = ownIntersect;
    ck_assert(!isAsTested() && !isAsTested());
}

TEST(two_parts_that_change_places_count) {
    MeMatrix4 tm[2];
    const McdAggregateID whole = McdAggregateCreate(p.frame, 2);
    for (int k = 0; k < 2; k++) {
        MeMatrix4TMMakeIdentity(tm[k]);
        tm[k][3][0] = (MeReal)k;
        McdAggregateAddElement(whole, McdBoxCreate(p.frame, 1, 1, k + 1.), tm[k]);
    }
    meet(whole, McdBoxCreate(p.frame, 1, 1, 1));
    assertChanged("a new pair");
    for (int k = 0; k < 2; k++)
        McdAggregateGetElementTransformPtr(whole, k)[3][0] = (MeReal)(1 - k);
    assertChanged("two parts");
}

/* ---- surfaces of triangles --------------------------------------------------------------------------------------- */

enum { SIDE = 9 }; /* points of a field, from -4 to 4 along x and y */
static MeReal height[SIDE * SIDE];

/* Flat, at z = 0 of its frame. */
static McdGeometryID flatField(void) {
    memset(height, 0, sizeof height);
    return McdRGHeightFieldCreate(p.frame, height, SIDE, SIDE, 1, 1, -4, -4);
}

static MeReal *heightAt(int x, int y) {
    return &height[(y + 4) * SIDE + x + 4];
}

/* Whether the last test of the pair still holds while one of its models may move. */
static MeBool isAsTestedAwake(void) {
    static const MeBool mayMove[2] = {METRUE, METRUE};
    McdFrameworkBeginRound(p.frame);
    return McdModelPairCompare(&p.pair, 1e-3, mayMove) != McdPairHasChanged;
}

static McdGeometryID turnedBoxes(void) {
    MeMatrix4 tm;
    const McdAggregateID whole = McdAggregateCreate(p.frame, 2);
    for (int k = 0; k < 2; k++) {
        MeMatrix4TMMakeIdentity(tm);
        tm[3][0] = (MeReal)(k ? 2.5 : -2.5);
        McdAggregateAddElement(whole, McdBoxCreate(p.frame, .5, .5, 1), tm);
    }
    return whole;
}

/* A field among the parts as one alone, of either model. */
TEST(what_may_move_on_a_field_is_tested_always) {
    MeMatrix4 tm;
    const McdAggregateID whole = McdAggregateCreate(p.frame, 2);
    MeMatrix4TMMakeIdentity(tm);
    McdAggregateAddElement(whole, McdBoxCreate(p.frame, 1, 1, 1), tm);
    tm[3][0] = -2;
    McdAggregateAddElement(whole, flatField(), tm);
    for (int which = 0; which < 2; which++)
        for (int parts = 0; parts < 4; parts++) {
            const McdGeometryID over = parts & 1 ? turnedBoxes() : McdBoxCreate(p.frame, 1, 1, 1);
            const McdGeometryID ground = parts & 2 ? whole : flatField();
            meet(which ? ground : over, which ? over : ground);
            ck_assert(!isAsTestedAwake() && !isAsTestedAwake());
            ck_assert(isAsTested()); /* where neither may move */
        }
}

/* Of models that do not move: as asleep. */
TEST(a_change_of_heights_counts_once_it_is_told) {
    static MeReal others[SIDE * SIDE];
    for (int which = 0; which < 2; which++) {
        const McdGeometryID box = McdBoxCreate(p.frame, 1, 1, 1), field = flatField();
        meet(which ? field : box, which ? box : field);
        assertChanged("a new pair");
        *heightAt(0, 0) = (MeReal)-.1;
        ck_assert(isAsTested());
        McdGeometryUpdate(field);
        assertChanged("a height");
        McdGeometryUpdate(field);
        assertChanged("no height");
        McdRGHeightFieldUpdateHeights(field);
        assertChanged("the field's own call");
        McdRGHeightFieldSetHeights(field, others);
        assertChanged("another array");
        McdGeometryUpdate(box);
        ck_assert(isAsTested());
        p.tm[which][3][0] = (MeReal)1e-30;
        assertChanged("a move");
    }
}

TEST(a_change_of_a_part_counts_once_it_is_told) {
    MeMatrix4 tm;
    const McdAggregateID whole = McdAggregateCreate(p.frame, 1);
    const McdGeometryID field = flatField();
    MeMatrix4TMMakeIdentity(tm);
    McdAggregateAddElement(whole, field, tm);
    meet(whole, turnedBoxes());
    assertChanged("a new pair");
    *heightAt(2, 0) = 1;
    ck_assert(isAsTested());
    McdGeometryUpdate(field);
    assertChanged("a height");
}

TEST(an_update_of_a_field_renews_its_box) {
    MeVector3 low, high;
    meet(McdBoxCreate(p.frame, 1, 1, 1), flatField());
    *heightAt(1, 1) = 3;
    McdModelUpdate(p.model[1]);
    McdModelGetAABB(p.model[1], low, high);
    assert_near(high[2] - p.tm[1][3][2], 0, 1e-3);
    McdGeometryUpdate(p.shape[1]);
    McdModelUpdate(p.model[1]);
    McdModelGetAABB(p.model[1], low, high);
    assert_near(high[2] - p.tm[1][3][2], 3, 1e-3);
}

TEST(what_is_no_geometry_is_told_of) {
    assert_refused(McdGeometryUpdate, 0);
}

TEST(a_list_among_the_parts_is_always_tested) {
    MeMatrix4 tm;
    MeVector3 low = {-1, -1, -1}, high = {1, 1, 1};
    const McdAggregateID whole = McdAggregateCreate(p.frame, 1);
    MeMatrix4TMMakeIdentity(tm);
    McdAggregateAddElement(whole, McdTriangleListCreate(p.frame, low, high, 4, 0), tm);
    meet(whole, McdBoxCreate(p.frame, 1, 1, 1));
    ck_assert(!isAsTested() && !isAsTested());
    meet(McdTriangleListCreate(p.frame, low, high, 4, 0), McdBoxCreate(p.frame, 1, 1, 1));
    ck_assert(!isAsTested() && !isAsTested());
}

/* ---- what is still apart ----------------------------------------------------------------------------------------- */

/* One of each convex type; the hull is off its origin. */
static McdGeometryID anyConvex(void) {
    MeReal corner[6][3];
    const int kind = (int)uniform(0, 6);
    const MeReal a = uniform(.1, 1), b = (MeReal)uniform(.1, 1), c = (MeReal)uniform(.1, 3);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 3; k++)
            corner[i][k] = (k == 0 ? 1 : 0) + (i % 3 == k ? (i < 3 ? a : -b) : 0);
    return kind == 0   ? McdSphereCreate(p.frame, a)
           : kind == 1 ? McdBoxCreate(p.frame, a, b, c)
           : kind == 2 ? McdCylinderCreate(p.frame, a, c)
           : kind == 3 ? McdSphylCreate(p.frame, a, c)
           : kind == 4 ? McdConeCreate(p.frame, a, c)
                       : McdConvexMeshCreateHull(p.frame, (const MeReal(*)[3])corner, 6, 0);
}

/* One of these, or three in any places. */
static McdGeometryID anyShape(void) {
    if (uniform(0, 1) < .7)
        return anyConvex();
    const McdAggregateID whole = McdAggregateCreate(p.frame, 3);
    for (int i = 0; i < 3; i++) {
        MeMatrix4 tm;
        MeMatrix4TMMakeIdentity(tm);
        for (int k = 0; k < 3; k++)
            tm[3][k] = (MeReal)uniform(-1, 1);
        McdAggregateAddElement(whole, anyConvex(), tm);
    }
    return whole;
}

/* Turned by the quaternion start + time way, made of length 1. */
static void put(int which, const double start[4], const double way[4], double time, const double at[3]) {
    double length = 0;
    MeVector4 q;
    MeMatrix3 R;
    for (int i = 0; i < 4; i++)
        length += pow(start[i] + time * way[i], 2);
    for (int i = 0; i < 4; i++)
        q[i] = (MeReal)((start[i] + time * way[i]) / sqrt(length));
    MeQuaternionToR(R, q);
    MeMatrix4TMMakeFromRotationAndPosition(p.tm[which], R, at[0], at[1], at[2]);
}

static int contactsOf(McdModelPair *pair, MeReal *apart) {
    McdContact contact[20];
    McdIntersectResult result = {.contacts = contact, .contactMaxCount = 20};
    McdIntersect(pair, &result);
    *apart = result.apart;
    return result.contactCount;
}

/* Pairs of any shapes that fly past each other, turning: where it is said that a test still holds, it finds nothing. */
TEST(models_that_are_still_apart_have_no_contacts) {
    enum { FLIGHTS = 300, STEPS = 60 };
    static const MeBool mayMove[2] = {METRUE, METRUE};
    int kept[2] = {0, 0}, steps[2] = {0, 0}, found = 0; /* of convex pairs, of pairs with parts */
    state = 1;
    for (int flight = 0; flight < FLIGHTS; flight++) {
        double start[2][4], way[2][4], at[2][3], velocity[2][3];
        const McdGeometryID first = anyShape(), second = anyShape();
        const int hasParts = McdGeometryGetType(first) == kMcdGeometryTypeAggregate ||
                             McdGeometryGetType(second) == kMcdGeometryTypeAggregate;
        meet(first, second);
        for (int k = 0; k < 2; k++) {
            for (int i = 0; i < 4; i++) {
                start[k][i] = uniform(-1, 1);
                way[k][i] = uniform(-.05, .05);
            }
            for (int i = 0; i < 3; i++) {
                at[k][i] = uniform(-2, 2);
                velocity[k][i] = -at[k][i] / STEPS * uniform(1, 3);
            }
        }
        for (int step = 0; step < STEPS; step++) {
            MeReal apart;
            for (int k = 0; k < 2; k++) {
                for (int i = 0; i < 3; i++)
                    at[k][i] += velocity[k][i];
                put(k, start[k], way[k], step, at[k]);
            }
            McdFrameworkBeginRound(p.frame);
            steps[hasParts]++;
            if (McdModelPairCompare(&p.pair, 0, mayMove) == McdPairIsSeparated) {
                kept[hasParts]++;
                ck_assert_msg(contactsOf(&p.pair, &apart) == 0, "flight %d, step %d", flight, step);
                continue;
            }
            const int count = contactsOf(&p.pair, &apart);
            found += count > 0;
            McdModelPairStoreGap(&p.pair, count == 0 ? apart : 0);
        }
        McdFrameworkDestroyAllModelsAndGeometries(p.frame);
    }
    printf("tests saved: convex pairs %d of %d, pairs with parts %d of %d\n", kept[0], steps[0], kept[1], steps[1]);
    ck_assert_int_gt(kept[0], steps[0] / 4);
    ck_assert_int_gt(kept[1], steps[1] / 20);
    ck_assert_int_gt(found, FLIGHTS);
}

/* ---- what has hardly moved --------------------------------------------------------------------------------------- */

static McdPairChange changeOf(MeReal part) {
    static const MeBool mayMove[2] = {METRUE, METRUE};
    McdFrameworkBeginRound(p.frame);
    return McdModelPairCompare(&p.pair, part, mayMove);
}

/* A box goes round the middle of a large ground, which it always sees in the same place. */
TEST(a_circle_about_the_larger_ones_origin_is_a_motion) {
    for (int which = 0; which < 2; which++) {
        const McdGeometryID box = McdBoxCreate(p.frame, 1, 1, 1), ground = McdBoxCreate(p.frame, 99, 99, 1);
        meet(which ? ground : box, which ? box : ground);
        for (int i = 0; i < 3; i++) {
            const double angle = i < 2 ? i * 1e-7 : 1e-4;
            MeMatrix4TMFromEulerAnglesAndPosition(p.tm[which], 0, 0, angle, 40 * cos(angle), 40 * sin(angle), 1);
            ck_assert_int_eq(changeOf(1e-3), i == 1 ? McdPairHasMoved : McdPairHasChanged);
        }
    }
}

/* ---- what calls no function of the program ----------------------------------------------------------------------- */

static McdGeometryID field(void) {
    static const MeReal flat[9];
    return McdRGHeightFieldCreate(p.frame, (MeReal *)(uintptr_t)flat, 3, 3, 1, 1, 0, 0);
}

static McdGeometryID list(void) {
    MeVector3 low = {-1, -1, -1}, high = {1, 1, 1};
    return McdTriangleListCreate(p.frame, low, high, 4, 0);
}

static MeBool isPlain(McdGeometryID first, McdGeometryID second) {
    meet(first, second);
    return McdModelPairIsPlain(&p.pair);
}

TEST(whatever_the_library_tests_alone_is_plain) {
    const McdGeometryID box = McdBoxCreate(p.frame, 1, 1, 1), plane = McdPlaneCreate(p.frame);
    ck_assert(isPlain(box, box) && isPlain(plane, box) && isPlain(box, field()) && isPlain(field(), box));
    ck_assert(isPlain(nested(box), box) && isPlain(box, nested(box)) && isPlain(nested(box), nested(box)));
    ck_assert(isPlain(nested(box), plane) && isPlain(field(), nested(box)));
}

TEST(a_list_of_triangles_is_a_function_of_the_program) {
    const McdGeometryID box = McdBoxCreate(p.frame, 1, 1, 1);
    ck_assert(!isPlain(box, list()) && !isPlain(list(), box));
    ck_assert(!isPlain(nested(list()), box) && !isPlain(box, nested(list())));
    ck_assert(!isPlain(nested(box), list()));
}

TEST(callbacks_and_interactions_of_the_program_are_not_plain) {
    const McdGeometryID box = McdBoxCreate(p.frame, 1, 1, 1), whole = nested(box);
    ck_assert(isPlain(whole, field()));
    McdModelSetIntersectCallback(p.model[1], onIntersect);
    ck_assert(!McdModelPairIsPlain(&p.pair));
    McdFrameworkGetInteractions(p.frame, kMcdGeometryTypeBox, kMcdGeometryTypeRGHeightField)->intersectFn =
        ownIntersect;
    ck_assert(!isPlain(whole, field()) && !isPlain(box, field()) && isPlain(whole, box));
}

TEST(what_is_fast_and_not_one_convex_shape_is_not_plain) {
    const McdSpaceID s = McdSpaceAxisSortCreate(p.frame, McdAllAxes, 10, 10);
    MeVector3 velocity = {100, 0, 0};
    for (int kind = 0; kind < 3; kind++) { /* a box and a plane, a box and a field, parts and a field */
        const McdGeometryID box = McdBoxCreate(p.frame, 1, 1, 1);
        ck_assert(isPlain(kind == 2 ? nested(box) : box, kind ? field() : McdPlaneCreate(p.frame)));
        McdModelSetLinearVelocityPtr(p.model[0], velocity);
        McdModelSetSwept(p.model[0], METRUE);
        McdSpaceInsertModel(s, p.model[0]);
        McdSpaceSetLookAhead(s, 1);
        McdSpaceUpdateAll(s);
        ck_assert(McdModelGetFastMargin(p.model[0]) > 0);
        ck_assert_int_eq(McdModelPairIsPlain(&p.pair), kind == 0);
    }
    McdSpaceDestroy(s);
}

TEST(parts_with_materials_of_their_own_are_not_plain) {
    ck_assert(isPlain(nested(McdBoxCreate(p.frame, 1, 1, 1)), field()));
    const McdGeometryInstanceID inner = McdGeometryInstanceGetChild(McdModelGetGeometryInstance(p.model[0]), 0);
    McdModelSetMaterial(p.model[0], 3);
    ck_assert(McdModelPairIsPlain(&p.pair));
    McdGeometryInstanceSetMaterial(McdGeometryInstanceGetChild(inner, 1), 0);
    ck_assert(!McdModelPairIsPlain(&p.pair));
}
