/* McdContact.feature tells contacts apart, however many faces, triangles and parts there are. */
#include "shapes.h"

enum { CORNERS = 502, FACES = 1000, PARTS = 1000, MAX = 3 * FACES };

static McdFrameworkID frame;
static McdModelID model[2];
static MeMatrix4 tm[2];
static McdContact contact[MAX];
static MeU32 feature[MAX];
static int featureCount;

static void setUp(void) {
    frame = McdInit(0, 10, PARTS, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    featureCount = 0;
}

static void tearDown(void) {
    for (int i = 0; i < 2; i++)
        McdModelDestroy(model[i]);
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    McdTerm(frame);
}

static void place(int i, McdGeometryID g) {
    model[i] = McdModelCreate(g);
    MeMatrix4TMMakeIdentity(tm[i]);
    McdModelSetTransformPtr(model[i], tm[i]);
}

/* Notes the features of all contacts of both models. */
static int meet(void) {
    McdRequest request = {.contactMaxCount = MAX};
    McdModelPair pair;
    McdIntersectResult result;
    memset(&pair, 0, sizeof pair);
    memset(&result, 0, sizeof result);
    pair.model1 = model[0];
    pair.model2 = model[1];
    pair.request = &request;
    result.contacts = contact;
    result.contactMaxCount = MAX;
    for (int i = 0; i < 2; i++)
        McdModelUpdate(model[i]);
    ck_assert((McdIntersect)(&pair, &result));
    for (int i = 0; i < result.contactCount && featureCount < MAX; i++)
        feature[featureCount++] = contact[i].feature;
    return result.contactCount;
}

static int compare(const void *a, const void *b) {
    const MeU32 x = *(const MeU32 *)a, y = *(const MeU32 *)b;
    return (x > y) - (x < y);
}

static void expectAllDifferent(void) {
    qsort(feature, (size_t)featureCount, sizeof *feature, compare);
    for (int i = 1; i < featureCount; i++)
        ck_assert_msg(feature[i] != feature[i - 1], "of %d contacts two have the feature %08x", featureCount,
                      feature[i]);
}

/* Points all over a ball, by the golden angle. */
static McdGeometryID pebble(void) {
    static MeVector3 v[CORNERS];
    for (int i = 0; i < CORNERS; i++) {
        const double z = 1 - (2 * i + 1.) / CORNERS, r = sqrt(1 - z * z), turn = i * 2.399963229728653;
        MeVector3Set(v[i], r * cos(turn), r * sin(turn), z);
    }
    return McdConvexMeshCreateHull(frame, (const MeVector3 *)v, CORNERS, 0);
}

/* Puts model 0 so that its face looks down and is at the height. */
static void standOn(McdGeometryID hull, int face, double height) {
    MeVector3 n, corner, u, w;
    McdConvexMeshGetPolygonNormal(hull, face, n);
    McdConvexMeshGetPolygonVertex(hull, face, 0, corner);
    MeVector3PlaneSpace(n, u, w);
    const double lowest = -(double)MeVector3Dot(n, corner);
    for (int i = 0; i < 3; i++) { /* u, w and n, with n = u x w, become y, x and -z */
        tm[0][i][0] = w[i];
        tm[0][i][1] = u[i];
        tm[0][i][2] = -n[i];
    }
    tm[0][3][2] = (MeReal)(height - lowest);
}

/* Face 256 had the features of face 0. */
static void tryAllFaces(MeBool onBox, double height) {
    setUp();
    const McdGeometryID hull = pebble();
    place(0, hull);
    place(1, onBox ? McdBoxCreate(frame, 4, 4, 2) : McdPlaneCreate(frame));
    ck_assert_int_eq(McdConvexMeshGetPolygonCount(hull), FACES);
    for (int face = 0; face < FACES; face++) {
        standOn(hull, face, height);
        ck_assert_int_ge(meet(), 3);
    }
    ck_assert_int_eq(featureCount, 3 * FACES);
    expectAllDifferent();
    tearDown();
}

TEST(each_of_a_thousand_faces_has_its_own) {
    tryAllFaces(MEFALSE, 0);
    tryAllFaces(METRUE, 1);
}

TEST(each_of_a_thousand_parts_has_its_own) {
    setUp();
    const McdGeometryID ball = McdSphereCreate(frame, .5), row = McdAggregateCreate(frame, PARTS);
    MeMatrix4 at;
    MeMatrix4TMMakeIdentity(at);
    for (int i = 0; i < PARTS; i++) {
        at[3][0] = (MeReal)i;
        McdAggregateAddElement(row, ball, at);
    }
    place(0, row);
    tm[0][3][2] = (MeReal).5;
    place(1, McdPlaneCreate(frame));
    ck_assert_int_eq(meet(), PARTS);
    expectAllDifferent();
    tearDown();
}

/* Parts of parts: 40 of 25, whose paths were sums that came out the same. */
TEST(parts_of_parts_have_their_own) {
    setUp();
    const McdGeometryID ball = McdSphereCreate(frame, .5), row = McdAggregateCreate(frame, 40),
                        rows = McdAggregateCreate(frame, 24);
    MeMatrix4 at;
    MeMatrix4TMMakeIdentity(at);
    for (int i = 0; i < 40; i++) {
        at[3][0] = (MeReal)i;
        McdAggregateAddElement(row, ball, at);
    }
    MeMatrix4TMMakeIdentity(at);
    for (int i = 0; i < 24; i++) {
        at[3][1] = (MeReal)i;
        McdAggregateAddElement(rows, row, at);
    }
    place(0, rows);
    tm[0][3][2] = (MeReal).5;
    place(1, McdPlaneCreate(frame));
    ck_assert_int_eq(meet(), 24 * 40);
    expectAllDifferent();
    tearDown();
}

TEST(contacts_with_many_triangles_have_their_own) {
    enum { SIDE = 41 };
    static MeReal height[SIDE * SIDE];
    setUp();
    for (int i = 0; i < SIDE * SIDE; i++)
        height[i] = (MeReal)uniform(-.1, 0);
    place(0, McdBoxCreate(frame, 9, 9, 1));
    tm[0][3][2] = (MeReal).4;
    place(1, McdRGHeightFieldCreate(frame, height, SIDE, SIDE, .25, .25, -5, -5));
    ck_assert_int_gt(meet(), 100);
    expectAllDifferent();
    tearDown();
}
