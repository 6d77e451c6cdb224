/* Cross-sections of geometries, planes against any convex type, and requests for faces first. */
#include "frame.h"

static McdFrameworkID frame;
static MeMatrix4 place[2];

static void setUp(void) {
    frame = frame_make(0, 10, 10, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    for (int i = 0; i < 2; i++)
        MeMatrix4TMMakeIdentity(place[i]);
}

TEST_FIXTURE(setUp, NULL)

static McdModelID modelAt(int i, McdGeometryID g) {
    McdModelID m = McdModelCreate(g);
    McdModelSetTransformPtr(m, place[i]);
    McdModelUpdate(m);
    return m;
}

/* Area and perimeter do not depend on where it begins; the area is positive if it is counter-clockwise about the
 * normal. */
static double areaOf(MeVector3 *v, int n, const MeReal *normal) {
    double sum = 0;
    for (int i = 1; i + 1 < n; i++) {
        MeVector3 a, b, c;
        MeVector3Subtract(a, v[i], v[0]);
        MeVector3Subtract(b, v[i + 1], v[0]);
        MeVector3Cross(c, a, b);
        sum += (double)MeVector3Dot(c, normal) / 2;
    }
    return sum;
}

typedef void(MEAPI *SliceFn)(McdGeometryInstanceID, const MeVector3, MeReal, int, int *, MeVector3 *);

static int sliceOf(McdModelID m, SliceFn f, const MeReal *normal, double dist, int max, double *area) {
    static MeVector3 v[64];
    int n = -1;
    f(McdModelGetGeometryInstance(m), normal, dist, max, &n, v);
    *area = areaOf(v, n, normal);
    for (int i = 0; i < n; i++)
        assert_near(MeVector3Dot(v[i], normal), dist, TOL(1e-5, 1e-12));
    return n;
}

TEST(a_box_is_cut_into_polygons) {
    const MeReal third = 1 / MeSqrt(3), half = 1 / MeSqrt(2);
    const MeVector3 up = {0, 0, 1}, diagonal = {third, third, third}, slant = {half, 0, half};
    McdModelID m = modelAt(0, McdBoxCreate(frame, 2, 2, 2));
    double area;
    ck_assert_int_eq(sliceOf(m, McdBoxGetSlice, up, .5, 64, &area), 4);
    assert_near(area, 4, TOL(1e-5, 1e-12));
    ck_assert_int_eq(sliceOf(m, McdBoxGetSlice, up, 1, 64, &area), 4); /* a face */
    assert_near(area, 4, TOL(1e-5, 1e-12));
    ck_assert_int_eq(sliceOf(m, McdBoxGetSlice, up, 1.01, 64, &area), 0);
    ck_assert_int_eq(sliceOf(m, McdBoxGetSlice, diagonal, 0, 64, &area), 6);
    assert_near(area, 3 * sqrt(3), TOL(1e-5, 1e-12)); /* a hexagon of side sqrt 2 */
    ck_assert_int_eq(sliceOf(m, McdBoxGetSlice, diagonal, 1.2, 64, &area), 3);
    assert_near(area, sqrt(3) / 4 * pow(sqrt(2) * (3 - 1.2 * sqrt(3)), 2), TOL(1e-5, 1e-9));
    ck_assert_int_eq(sliceOf(m, McdBoxGetSlice, slant, sqrt(2), 64, &area), 0); /* an edge */
    MeMatrix4TMFromEulerAnglesAndPosition(place[0], 0, 0, ME_PI / 4, 5, 6, 7);
    ck_assert_int_eq(sliceOf(m, McdGeometryInstanceGetSlice, (MeVector3){1, 0, 0}, 5, 64, &area), 4);
    assert_near(area, 4 * sqrt(2), TOL(1e-4, 1e-12));
}

TEST(a_cylinder_and_a_mesh_are_cut_into_polygons) {
    const MeVector3 up = {0, 0, 1}, side = {0, 1, 0};
    static const MeVector3 corner[] = {{0, 2, 0}, {-3, -1, -3}, {3, -1, -3}, {-3, -1, 3}, {3, -1, 3}};
    McdModelID rod = modelAt(0, McdCylinderCreate(frame, 1, 4));
    McdModelID pyramid = modelAt(1, McdConvexMeshCreateHull(frame, corner, 5, 0));
    double area;
    ck_assert_int_eq(sliceOf(rod, McdCylinderGetSlice, up, 1, 64, &area), 32);
    assert_near(area, 16 * sin(2 * (double)ME_PI / 32), TOL(1e-5, 1e-12));
    ck_assert_int_eq(sliceOf(rod, McdCylinderGetSlice, up, 1, 10, &area), 8);
    ck_assert_int_eq(sliceOf(rod, McdCylinderGetSlice, side, 0, 64, &area), 4);
    assert_near(area, 8, TOL(1e-5, 1e-12));
    ck_assert_int_eq(sliceOf(pyramid, McdConvexMeshGetSlice, side, .5, 64, &area), 4);
    assert_near(area, 9, TOL(1e-5, 1e-12));                                           /* half of the way up: 3 x 3 */
    ck_assert_int_eq(sliceOf(pyramid, McdConvexMeshGetSlice, side, 2, 64, &area), 0); /* the tip */
    ck_assert_int_eq(sliceOf(pyramid, McdConvexMeshGetSlice, side, .5, 3, &area), 3);
}

/* The ridge of a roof, exactly: two corners are no polygon. */
TEST(a_plane_through_an_edge_cuts_nothing_off) {
    const MeVector3 up = {0, 0, 1}, down = {0, 0, -1};
    static const MeVector3 corner[] = {{-1, 0, 1}, {1, 0, 1}, {-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}};
    McdModelID roof = modelAt(0, McdConvexMeshCreateHull(frame, corner, 6, 0));
    double area;
    ck_assert_int_eq(sliceOf(roof, McdConvexMeshGetSlice, up, 1, 64, &area), 0);
    ck_assert_int_eq(sliceOf(roof, McdConvexMeshGetSlice, down, -1, 64, &area), 0);
    ck_assert_int_eq(sliceOf(roof, McdConvexMeshGetSlice, up, .5, 64, &area), 4);
    assert_near(area, 2, TOL(1e-6, 1e-14));
    ck_assert_int_eq(sliceOf(roof, McdConvexMeshGetSlice, up, 0, 64, &area), 4);
    assert_near(area, 4, TOL(1e-6, 1e-14));
}

TEST(slices_of_bad_input_are_none) {
    const MeVector3 up = {0, 0, 1}, longer = {0, 0, 2};
    MeVector3 v[8];
    McdModelID ball = modelAt(0, McdSphereCreate(frame, 1)), box = modelAt(1, McdBoxCreate(frame, 1, 1, 1));
    McdGeometryInstanceID ins = McdModelGetGeometryInstance(box);
    int n = 5;
    assert_refused(McdGeometryInstanceGetSlice, McdModelGetGeometryInstance(ball), up, 0, 8, &n, v);
    ck_assert_int_eq(n, 0);
    assert_refused(McdCylinderGetSlice, ins, up, 0, 8, &n, v);
    n = 5;
    assert_refused(McdBoxGetSlice, ins, longer, 0, 8, &n, v);
    ck_assert_int_eq(n, 0);
    McdBoxGetSlice(ins, up, 0, 2, &n, v);
    assert_warned("maxVert");
    assert_refused(McdBoxGetSlice, NULL, up, 0, 8, &n, v);
    assert_refused(McdBoxGetSlice, ins, up, 0, 8, &n, NULL);
}

/* ---- planes ---- */

TEST(a_plane_meets_any_convex_type_in_either_order) {
    McdContact contact[8];
    McdIntersectResult result = {.contacts = contact, .contactMaxCount = 8};
    McdModelID plane = modelAt(0, McdPlaneCreate(frame));
    McdGeometryID shape[] = {McdSphereCreate(frame, 1), McdBoxCreate(frame, 1, 1, 2), McdCylinderCreate(frame, 1, 2),
                             McdSphylCreate(frame, 0.5, 1), McdConvexMeshCreateSphyl(frame, 0.5, 1)};
    MeMatrix4TMSetPosition(place[1], 3, 4, 0.99);
    for (int i = 0; i < 5; i++) {
        McdModelID m = modelAt(1, shape[i]);
        ck_assert_int_eq(McdPlaneIntersectTest(plane, m, &result), 1);
        ck_assert_ptr_null(result.pair);
        assert_near(contact[0].separation, -.01, TOL(1e-6, 1e-12));
        assert_near(contact[0].normal[2], -1, 0);
        McdModelPairID p = McdModelPairCreate(m, plane);
        ck_assert_int_eq(McdPlaneIntersect(p, &result), 1);
        ck_assert_ptr_eq(result.pair, p);
        assert_near(contact[0].separation, -.01, TOL(1e-6, 1e-12));
        assert_near(contact[0].normal[2], 1, 0);
        McdModelPairDestroy(p);
        McdModelDestroy(m);
    }
    McdModelID ball = modelAt(1, shape[0]);
    ck_assert_int_eq(McdPlaneIntersectTest(ball, plane, &result), 1);
    assert_warned("McdPlaneIntersectTest");
    assert_none(McdPlaneIntersectTest, plane, plane, &result);
    assert_none(McdPlaneIntersectTest, plane, NULL, &result);
    assert_none(McdPlaneIntersect, NULL, &result);
}

/* ---- requests ---- */

/* A floor, and a ramp that rises from it by 20 degrees and is .02 high at y = 1. */
#define SINE    ((MeReal)0.3420201433256687)
#define COSINE  ((MeReal)0.9396926207859084)
#define RAMP(y) ((MeReal)0.02 + ((MeReal)(y)-1) * SINE / COSINE)
static MeVector3 level[] = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}};
static MeVector3 ramp[] = {{-9, 0.5, RAMP(.5)}, {9, 0.5, RAMP(.5)}, {0, 9, RAMP(9)}};
static MeVector3 up = {0, 0, 1}, slant = {0, -SINE, COSINE};

static int MEAPI floorAndRamp(McdModelPair *p, McdUserTriangle *t, MeVector3 pos, MeReal radius, int max) {
    (void)p, (void)pos, (void)radius, (void)max;
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++)
            t[i].vertices[k] = i ? &ramp[k] : &level[k];
        t[i].normal = i ? &slant : &up;
        t[i].flags = (McdTriangleFlags)0;
        t[i].triangleData.tag = 10 + i;
    }
    return 2;
}

/* A box stands on the floor, 4 contacts, and with an edge in the ramp, 2 deeper ones. With room for two those of the
 * ramp are among them, unless faces come first: the mean normal is 6.6 degrees off the floor's and 13.4 off the
 * ramp's. */
TEST(faces_first_keeps_contacts_along_the_mean_normal) {
    MeVector3 low = {-9, -9, -9}, high = {9, 9, 9};
    McdModelID surface = modelAt(0, McdTriangleListCreate(frame, low, high, 4, floorAndRamp));
    McdModelID box = modelAt(1, McdBoxCreate(frame, 2, 2, 2));
    McdRequest request = {2, MEFALSE};
    McdContact contact[8];
    McdIntersectResult result = {.contacts = contact, .contactMaxCount = 8};
    MeMatrix4TMSetPosition(place[1], 0, 0, 0.99);
    McdModelPairID p = McdModelPairCreate(box, surface);
    McdModelPairSetRequestPtr(p, &request);
    for (int isFirst = 0; isFirst < 2; isFirst++) {
        int onRamp = 0;
        request.faceNormalsFirst = isFirst;
        ck_assert(McdIntersect(p, &result) && result.contactCount == 2);
        for (int i = 0; i < 2; i++) {
            ck_assert(contact[i].element2.tag == 10 || contact[i].element2.tag == 11);
            onRamp += contact[i].element2.tag == 11;
        }
        ck_assert(isFirst ? onRamp == 0 : onRamp > 0);
        ck_assert(result.contacts == contact && result.contactMaxCount == 8 && result.pair == p);
    }
    McdModelPairDestroy(p);
}
