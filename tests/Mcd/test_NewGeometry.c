/* A geometry type that the library does not know, an ellipsoid, made of nothing but a table of functions: it meets
 * all that the library knows, as docs/collision.md says. */
#include "frame.h"
#include "model/mcd_geometries_i.h"
#include "convex/mcd_kind_i.h"
#include "geometry/mcd_local_i.h"

/* ---- the geometry ------------------------------------------------------------------------------------------------ */

enum { ELLIPSOID = kMcdGeometryFirstUserType };

typedef struct Ellipsoid {
    McdGeometry head;
    double radius[3];
} Ellipsoid;

/* R^2 d / |R d| */
static void farthest(const double r[3], const double d[3], double point[3]) {
    double length = 0;
    for (int i = 0; i < 3; i++)
        length += r[i] * d[i] * r[i] * d[i];
    for (int i = 0; i < 3; i++)
        point[i] = length > 0 ? r[i] * r[i] * d[i] / sqrt(length) : 0;
}

static void support(const McdGeometry *g, const double d[3], double point[3]) {
    farthest(((const Ellipsoid *)g)->radius, d, point);
}

static void MEAPI box(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight) {
    (void)tight;
    mcd_localUpdateAABB(ins, finalTM, support);
}

static void MEAPI sphere(const McdGeometryID g, MeVector3 center, MeReal *radius) {
    const double *r = ((const Ellipsoid *)g)->radius;
    MeVector3Set(center, 0, 0, 0);
    *radius = mcd_roundUp(fmax(fmax(r[0], r[1]), r[2]));
}

static void MEAPI maximumPoint(McdGeometryInstanceID ins, MeReal *const direction, MeReal *const point) {
    mcd_localMaximumPoint(ins, direction, point, support);
}

static MeI16 MEAPI mass(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 inertia, MeReal *volume) {
    const double *r = ((const Ellipsoid *)g)->radius, m = 4. / 3 * MCD_PI * r[0] * r[1] * r[2];
    McdMass all;
    mcd_massDiagonal(&all, m, m * (r[1] * r[1] + r[2] * r[2]) / 5, m * (r[2] * r[2] + r[0] * r[0]) / 5,
                     m * (r[0] * r[0] + r[1] * r[1]) / 5);
    return mcd_massStore(&all, relTM, inertia, volume);
}

static char *MEAPI name(const McdGeometryID g) {
    static char text[] = "Ellipsoid";
    (void)g;
    return text;
}

static void setShape(const McdGeometry *g, McdShape *s) {
    mcd_copy(s->size, ((const Ellipsoid *)g)->radius);
    s->extent = fmax(fmax(s->size[0], s->size[1]), s->size[2]);
}

static void shapeSupport(const McdShape *s, const double direction[3], double point[3]) {
    double d[3], own[3];
    mcd_shapeToOwnAxes(s, direction, d);
    farthest(s->size, d, own);
    mcd_shapePoint(s, own[0], own[1], own[2], point);
}

/* It has no faces: one point. */
static void face(const McdShape *s, const double direction[3], McdFace *f) {
    shapeSupport(s, direction, f->point[0]);
    f->name[0] = 0;
    f->count = 1;
}

static const McdKind kind = {.type = ELLIPSOID,
                             .name = name,
                             .destroy = mcd_geometryFree,
                             .box = box,
                             .sphere = sphere,
                             .farthest = maximumPoint,
                             .mass = mass,
                             .setShape = setShape,
                             .support = shapeSupport,
                             .face = face,
                             .rank = MCD_RANK_OTHER};

/* ---- what it meets ----------------------------------------------------------------------------------------------- */

static McdFrameworkID frame;
static McdContact contact[20];
static McdIntersectResult result;

static void setUp(void) {
    frame = frame_make(1, 20, 20, 1);
    McdAllRegisterTypes(frame);
    mcd_kindRegister(frame, &kind, "test");
    mcd_kindRegisterInteractions(frame, &kind, "test");
    McdAllRegisterInteractions(frame);
}

TEST_FIXTURE(setUp, NULL)

static McdGeometryID makeEllipsoid(double x, double y, double z) {
    Ellipsoid *e = mcd_geometryCreate(frame, ELLIPSOID, sizeof *e, "test");
    mcd_set(e->radius, x, y, z);
    return &e->head;
}

static double random01(void) {
    return rand() / (RAND_MAX + 1.);
}

static MeReal between(double low, double high) {
    return (MeReal)(low + (high - low) * random01());
}

static void anyTurn(MeMatrix4 tm) {
    MeMatrix4TMFromEulerAnglesAndPosition(tm, between(-3, 3), between(-3, 3), between(-3, 3), 0, 0, 0);
}

/* How far it reaches along a world direction: |R A^T n|. */
static double reachAlong(const MeVector4 *tm, const double r[3], const MeReal *n) {
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        const double x = r[i] * (double)MeVector3Dot(tm[i], n);
        sum += x * x;
    }
    return sqrt(sum);
}

static int meet(McdModelID a, McdModelID b) {
    McdModelPair p;
    memset(&p, 0, sizeof p);
    p.model1 = a;
    p.model2 = b;
    McdModelUpdate(a);
    McdModelUpdate(b);
    McdHello(&p);
    result = (McdIntersectResult){.contacts = contact, .contactMaxCount = 20};
    ck_assert((McdIntersect)(&p, &result));
    McdGoodbye(&p);
    return result.contactCount;
}

static MeReal deepest(void) {
    MeReal min = MEINFINITY;
    for (int i = 0; i < result.contactCount; i++)
        min = MeMIN(min, contact[i].separation);
    return min;
}

/* On what is flat on top, at z = 0 around the origin, it stands as deep as its own extent along z says. */
static void standOn(McdGeometryID g, double low) {
    const double radius[3] = {.5, .3, .2};
    MeMatrix4 tm, ground;
    McdModelID e = McdModelCreate(makeEllipsoid(radius[0], radius[1], radius[2])), m = McdModelCreate(g);
    MeMatrix4TMMakeIdentity(ground);
    ground[3][2] = (MeReal)low;
    McdModelSetTransformPtr(e, tm);
    McdModelSetTransformPtr(m, ground);
    for (int i = 0; i < 100; i++) {
        const MeReal up[3] = {0, 0, 1};
        anyTurn(tm);
        const double reach = reachAlong((const MeVector4 *)tm, radius, up), depth = (double)between(-.005, .02);
        tm[3][2] = (MeReal)(reach - depth);
        ck_assert_int_eq(meet(e, m), 1);
        assert_near(deepest(), -depth, TOL(4e-7, 2e-15));
        assert_vec3_near(contact[0].normal, 0, 0, 1, TOL(5e-7, 9e-16));
        ck_assert_int_eq(meet(m, e), 1); /* the other way round */
        assert_near(deepest(), -depth, TOL(4e-7, 2e-15));
        assert_vec3_near(contact[0].normal, 0, 0, -1, TOL(5e-7, 9e-16));
    }
    McdModelDestroy(e);
    McdModelDestroy(m);
}

static int MEAPI twoTriangles(McdModelPair *p, McdUserTriangle *t, MeVector3 pos, MeReal radius, int max) {
    static MeVector3 corner[4] = {{-4, -4, 0}, {5, -4, 0}, {5, 5, 0}, {-4, 5, 0}};
    (void)p, (void)pos, (void)radius, (void)max;
    for (int i = 0; i < 2; i++)
        t[i] = (McdUserTriangle){.vertices = {&corner[0], &corner[i + 1], &corner[i + 2]},
                                 .flags = kMcdTriangleStandard & ~kMcdTriangleTwoSided};
    return 2;
}

TEST(it_stands_on_whatever_is_flat) {
    static MeVector3 cube[8];
    static MeReal heights[16];
    MeVector3 low = {-4, -4, -1}, high = {5, 5, 1};
    for (int i = 0; i < 8; i++)
        MeVector3Set(cube[i], i & 1 ? 3 : -3, i & 2 ? 3 : -3, i & 4 ? 0 : -2);
    McdAggregateID a = McdAggregateCreate(frame, 1);
    MeMatrix4 tm;
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMSetPosition(tm, 0, 0, -1);
    McdAggregateAddElement(a, McdBoxCreate(frame, 6, 6, 2), tm);
    standOn(McdPlaneCreate(frame), 0);
    standOn(McdBoxCreate(frame, 6, 6, 2), -1);
    standOn(McdCylinderCreate(frame, 3, 2), -1);
    standOn(McdConvexMeshCreateHull(frame, (const MeVector3 *)cube, 8, 0), 0);
    standOn(McdTriangleListCreate(frame, low, high, 3, twoTriangles), 0);
    standOn(McdRGHeightFieldCreate(frame, heights, 4, 4, 3, 3, -4, -4), 0);
    standOn(a, 0);
}

/* One of equal radii is a sphere. */
TEST(a_round_one_is_a_sphere) {
    const McdGeometryID other[] = {McdSphereCreate(frame, 1),       McdSphylCreate(frame, .4, 1),
                                   McdBoxCreate(frame, 1, 1.2, .8), McdCylinderCreate(frame, .6, 1),
                                   McdConeCreate(frame, 1, .7),     makeEllipsoid(.7, .7, .7)};
    MeMatrix4 tm, place;
    McdModelID e = McdModelCreate(makeEllipsoid(.5, .5, .5)), s = McdModelCreate(McdSphereCreate(frame, .5));
    McdModelSetTransformPtr(e, tm);
    McdModelSetTransformPtr(s, tm);
    for (size_t k = 0; k < sizeof other / sizeof *other; k++) {
        McdModelID m = McdModelCreate(other[k]);
        McdModelSetTransformPtr(m, place);
        int touching = 0;
        for (int i = 0; i < 200; i++) {
            anyTurn(tm);
            anyTurn(place);
            MeMatrix4TMSetPosition(tm, between(-1, 1), between(-1, 1), between(-1, 1));
            const int count = meet(e, m);
            const MeReal depth = deepest();
            if (meet(s, m) != count)
                ck_assert(fabs((double)(count ? depth : deepest()) - .02) < 1e-6); /* at the tolerance's end */
            else if (count)
                assert_near(depth, deepest(), 1e-6);
            touching += count;
        }
        ck_assert_int_gt(touching, 50);
    }
}

TEST(queries_and_safe_times_know_it) {
    MeMatrix4 tm, wall;
    MeVector3 velocity = {2, 0, 0}, way = {10, 0, 0}, still = {0, 0, 0};
    McdModelID e = McdModelCreate(makeEllipsoid(.5, .3, .2)), box = McdModelCreate(McdBoxCreate(frame, 1, 4, 4));
    McdModelPair p;
    McdSafeTimeResult time;
    McdDistanceResult distance;
    McdCastResult hit;
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMMakeIdentity(wall);
    wall[3][0] = 3;
    McdModelSetTransformPtr(e, tm);
    McdModelSetTransformPtr(box, wall);
    McdModelSetLinearVelocityPtr(e, velocity);
    McdModelSetAngularVelocityPtr(e, still);
    memset(&p, 0, sizeof p);
    p.model1 = e;
    p.model2 = box;
    McdModelUpdate(e);
    McdModelUpdate(box);
    ck_assert(McdDistance(&p, &distance));
    assert_near(distance.distance, 2, TOL(1e-5, 4e-12));
    assert_vec3_near(distance.position1, .5, 0, 0, TOL(2e-6, 2e-6));
    ck_assert(McdSafeTime(&p, 5, &time));
    assert_near(time.time, 1, TOL(5e-7, 2e-12));
    McdSpaceID space = (McdSpaceAxisSortCreate)(frame, McdAllAxes, 4, 4);
    McdSpaceInsertModel(space, box);
    McdSpaceUpdateAll(space);
    ck_assert(McdSpaceCastGeometry(space, McdModelGetGeometry(e), (const MeVector4 *)tm, way, 0, 0, &hit));
    assert_near(hit.fraction, .2, TOL(1e-7, 4e-13));
    McdSpaceDestroy(space);
}
