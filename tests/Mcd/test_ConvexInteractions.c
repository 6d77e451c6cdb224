/* The interactions of convex geometries and planes, as programs call them. The geometries are made by hand. */
#include "frame.h"
#include "model/mcd_geometries_i.h"
#include "reference.h"

static McdFrameworkID frame;
static MeMatrix4 place[2];
static McdContact contacts[8];
static McdIntersectResult result;

static void MEAPI boxAround(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight) {
    const MeMatrix4Ptr tm = McdGeometryInstanceGetTransformPtr(ins);
    MeVector3 low, high;
    (void)finalTM;
    (void)tight;
    for (int i = 0; i < 3; i++) {
        low[i] = tm[3][i] - 2;
        high[i] = tm[3][i] + 2;
    }
    McdGeometryInstanceSetAABB(ins, low, high);
}

static void MEAPI destroy(McdGeometryID g) {
    MeMemoryAPI.destroy(g);
}

static void setUp(void) {
    frame = frame_make(0, 4, 0, 1);
    static char name[] = "test";
    for (McdGeometryType type = 1; type <= kMcdGeometryTypeCone; type++)
        McdFrameworkRegisterGeometryType(frame, type, name, destroy, boxAround, 0, 0, 0, 0);
    McdAllRegisterTypes(frame); /* those functions stay */
    for (int i = 0; i < 2; i++)
        MeMatrix4TMMakeIdentity(place[i]);
    result = (McdIntersectResult){.contacts = contacts, .contactMaxCount = 8};
}

/* Each is 1 high over its middle. */
static McdGeometryID create(McdGeometryType type) {
    static const size_t size[] = {
        [kMcdGeometryTypeSphere] = sizeof(McdSphere), [kMcdGeometryTypeBox] = sizeof(McdBox),
        [kMcdGeometryTypePlane] = sizeof(McdPlane),   [kMcdGeometryTypeCylinder] = sizeof(McdCylinder),
        [kMcdGeometryTypeSphyl] = sizeof(McdSphyl),   [kMcdGeometryTypeConvexMesh] = sizeof(McdConvexMesh),
        [kMcdGeometryTypeCone] = sizeof(McdCone)};
    const McdGeometryID g = mcd_geometryCreate(frame, type, size[type], "test");
    switch (type) {
    case kMcdGeometryTypeSphere:
        ((McdSphere *)g)->radius = 1;
        break;
    case kMcdGeometryTypeBox:
        for (int i = 0; i < 3; i++)
            ((McdBox *)g)->radii[i] = 1;
        break;
    case kMcdGeometryTypeCylinder:
        ((McdCylinder *)g)->radius = ((McdCylinder *)g)->halfHeight = 1;
        break;
    case kMcdGeometryTypeSphyl:
        ((McdSphyl *)g)->radius = ((McdSphyl *)g)->halfHeight = (MeReal).5;
        break;
    case kMcdGeometryTypeConvexMesh:
        ((McdConvexMesh *)g)->hull = (McdHull *)hull_prism(4, 1, 1);
        break;
    case kMcdGeometryTypeCone: /* cut off, so that it stands on its top too */
        ((McdCone *)g)->length = 2;
        ((McdCone *)g)->lowerRadius = ((McdCone *)g)->lowerHeight = 1;
        ((McdCone *)g)->upperRadius = (MeReal).5;
        break;
    default:
        break;
    }
    return g;
}

static McdModelID model(McdGeometryType type, int which, double z) {
    const McdModelID m = McdModelCreate(create(type));
    place[which][3][2] = (MeReal)z;
    McdModelSetTransformPtr(m, place[which]);
    McdModelSetContactTolerance(m, .01);
    McdModelUpdate(m);
    return m;
}

typedef struct Entry {
    McdGeometryType type1, type2;
    MeBool(MEAPI *registerIt)(McdFramework *frame);
    McdIntersectFn intersect;
    int points;
} Entry;

#define ENTRY(X, Y, points)                                                                                            \
    { kMcdGeometryType##X, kMcdGeometryType##Y, Mcd##X##Y##RegisterInteraction, Mcd##X##Y##Intersect, points }
static const Entry entry[] = {
    ENTRY(Sphere, Sphere, 1),       ENTRY(Box, Sphere, 1),        ENTRY(Box, Box, 4),
    ENTRY(Box, Cylinder, 4),        ENTRY(Cylinder, Sphere, 1),   ENTRY(Cylinder, Cylinder, 4),
    ENTRY(Sphyl, Sphere, 1),        ENTRY(Sphyl, Box, 1),         ENTRY(Sphyl, Cylinder, 1),
    ENTRY(Sphyl, Sphyl, 1),         ENTRY(Cone, Sphere, 1),       ENTRY(Cone, Box, 4),
    ENTRY(Cone, Cylinder, 4),       ENTRY(Cone, Sphyl, 1),        ENTRY(Cone, Cone, 4),
    ENTRY(Cone, ConvexMesh, 4),     ENTRY(Sphere, ConvexMesh, 1), ENTRY(Box, ConvexMesh, 4),
    ENTRY(Cylinder, ConvexMesh, 4), ENTRY(Sphyl, ConvexMesh, 1),  ENTRY(ConvexMesh, ConvexMesh, 4),
    ENTRY(Sphere, Plane, 1),        ENTRY(Box, Plane, 4),         ENTRY(Cylinder, Plane, 4),
    ENTRY(Sphyl, Plane, 1),         ENTRY(Cone, Plane, 4),        ENTRY(ConvexMesh, Plane, 4),
    ENTRY(Plane, ConvexMesh, 4),
};
enum { ENTRIES = sizeof entry / sizeof *entry };

/* The first stands on the second, .005 above it; a plane turned over stands on the other. */
static McdModelPair standing(const Entry *e) {
    const double height = (e->type1 == kMcdGeometryTypePlane || e->type2 == kMcdGeometryTypePlane ? 1 : 2) + .005;
    McdModelPair p = {.model1 = model(e->type1, 0, height), .model2 = model(e->type2, 1, 0)};
    if (e->type1 == kMcdGeometryTypePlane) { /* about x */
        place[0][1][1] = place[0][2][2] = -1;
        McdModelUpdate(p.model1);
    }
    return p;
}

static void assertStanding(McdModelPair *p, const Entry *e, double direction) {
    ck_assert_int_eq(result.touch, 1);
    ck_assert_int_eq(result.contactCount, e->points);
    assert_vec3_near(result.normal, 0, 0, direction, TOL(5e-7, 9e-16));
    for (int i = 0; i < e->points; i++) {
        assert_near(contacts[i].separation, .005, TOL(1e-6, 2e-15));
        assert_vec3_near(contacts[i].normal, 0, 0, direction, TOL(5e-7, 9e-16));
        assert_near(contacts[i].position[2], 1.0025, TOL(1e-6, 9e-16));
        ck_assert_ptr_eq(contacts[i].instance1, McdModelGetGeometryInstance(p->model1));
        ck_assert_ptr_eq(contacts[i].instance2, McdModelGetGeometryInstance(p->model2));
        ck_assert_ptr_null(contacts[i].element1.ptr);
        ck_assert_int_eq(contacts[i].dims, e->points < 3 ? e->points - 1 : 2);
    }
}

TEST(all_pairs_stand) {
    for (int i = 0; i < ENTRIES; i++) {
        setUp();
        const Entry *e = &entry[i];
        McdModelPair p = standing(e);
        if (e->type2 == kMcdGeometryTypePlane)
            place[0][3][2] = (MeReal)1.005;
        const MeBool isOnPlane = e->type2 == kMcdGeometryTypePlane;
        ck_assert_int_eq(e->intersect(&p, &result), 1);
        if (isOnPlane)
            for (int k = 0; k < result.contactCount; k++)
                contacts[k].position[2] += 1; /* its ground is 1 lower than a shape's top */
        assertStanding(&p, e, 1);
    }
}

/* First the edge that is lowest, then the far corners. */
TEST(where_there_is_little_place_the_ends_are_kept) {
    setUp();
    McdModelPair p = standing(&entry[2]);
    MeMatrix3 tilt;
    MeMatrix3FromEulerAngles(tilt, 0, .001, 0); /* the edge at x = 1 is lowest */
    MeMatrix4TMSetRotation(place[0], (const MeVector3 *)tilt);
    for (int max = 0; max < 5; max++) {
        result.contactMaxCount = max;
        ck_assert_int_eq(entry[2].intersect(&p, &result), max > 0);
        ck_assert_int_eq(result.contactCount, max);
        MeReal min = 1, distance = 0;
        for (int i = 0; i < max; i++) {
            min = MeMIN(min, contacts[i].separation);
            for (int k = 0; k < i; k++) {
                MeVector3 apart;
                MeVector3Subtract(apart, contacts[i].position, contacts[k].position);
                ck_assert(MeVector3Magnitude(apart) > (MeReal)1.9);
                distance = MeMAX(distance, MeVector3Magnitude(apart));
            }
        }
        if (max)
            assert_near(min, .004, TOL(2e-6, 2e-6));
        if (max == 2)
            assert_near(contacts[1].separation, .004, TOL(2e-6, 2e-6));
        if (max > 2)
            ck_assert(distance > (MeReal)2.8);
    }
    messages_forget();
}

TEST(registered_pairs_are_served_either_way_round) {
    for (int i = 0; i < ENTRIES; i++) {
        setUp();
        const Entry *e = &entry[i];
        McdModelPair p = standing(e);
        ck_assert_int_eq(e->registerIt(frame), 1);
        McdHello(&p);
        ck_assert_int_eq(McdIntersect(&p, &result), 1);
        ck_assert_int_eq(result.contactCount, e->points);
        McdGoodbye(&p);
        McdModelPair turned = {.model1 = p.model2, .model2 = p.model1};
        McdHello(&turned);
        ck_assert_int_eq(McdIntersect(&turned, &result), 1);
        ck_assert_int_eq(result.contactCount, e->points);
        assert_vec3_near(result.normal, 0, 0, -1, TOL(5e-7, 9e-16));
        McdGoodbye(&turned);
    }
}

TEST(groups_register_their_pairs) {
    static const int primitive[] = {kMcdGeometryTypeSphere, kMcdGeometryTypeBox, kMcdGeometryTypeCylinder,
                                    kMcdGeometryTypeSphyl, kMcdGeometryTypePlane};
    static const int mesh = kMcdGeometryTypeConvexMesh, cone = kMcdGeometryTypeCone;
    setUp();
    ck_assert_int_eq(McdConvexMeshRegisterBoxAndSphereFns(frame), 1);
    ck_assert_ptr_nonnull(McdFrameworkGetInteractions(frame, kMcdGeometryTypeBox, mesh));
    ck_assert_ptr_null(McdFrameworkGetInteractions(frame, kMcdGeometryTypeCylinder, mesh));
    ck_assert_int_eq(McdConvexMeshPrimitivesRegisterInteractions(frame), 1);
    ck_assert_int_eq(McdConePrimitivesRegisterInteractions(frame), 1);
    for (int i = 0; i < 5; i++) {
        ck_assert(McdFrameworkGetInteractions(frame, primitive[i], mesh) ||
                  McdFrameworkGetInteractions(frame, mesh, primitive[i]));
        ck_assert_ptr_nonnull(McdFrameworkGetInteractions(frame, cone, primitive[i]));
    }
    ck_assert_ptr_nonnull(McdFrameworkGetInteractions(frame, mesh, mesh));
    ck_assert_ptr_nonnull(McdFrameworkGetInteractions(frame, cone, cone));
}

TEST(far_from_the_origin_contacts_are_as_good) {
    setUp();
    McdModelPair p = standing(&entry[2]);
    for (int i = 0; i < 2; i++)
        place[i][3][0] += 16384;
    McdModelUpdate(p.model1);
    McdModelUpdate(p.model2);
    ck_assert_int_eq(McdBoxBoxIntersect(&p, &result), 1);
    ck_assert_int_eq(result.contactCount, 4);
    for (int i = 0; i < 4; i++)
        assert_near(contacts[i].separation, .005, TOL(1e-6, 2e-15));
}

TEST(misuse_is_named) {
    setUp();
    McdModelPair p = standing(&entry[1]);
    McdModelPair turned = {.model1 = p.model2, .model2 = p.model1};
    assert_none(McdBoxSphereIntersect, &turned, &result);
    assert_none(McdBoxSphereIntersect, 0, &result);
    assert_none(McdBoxSphereIntersect, &p, 0);
    place[1][2][2] = (MeReal)NAN;
    assert_none(McdBoxSphereIntersect, &p, &result);
    ck_assert_int_eq(result.contactCount, 0);
    place[1][2][2] = 1;
    ck_assert_int_eq(McdBoxSphereIntersect(&p, &result), 1);
    assert_silent();
    assert_none(McdBoxSphereRegisterInteraction, 0);
}
