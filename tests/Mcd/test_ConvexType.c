/* Convex shapes of a program, by their support function: what they are to each other and to all other geometries. */
#include "frame.h"
#include "own_shapes.h"

static McdFrameworkID frame;
static McdContact contact[40];
static McdIntersectResult result;
static MeU32 seed;

static void setUp(void) {
    frame = frame_make(2, 64, 64, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    seed = 1;
}

TEST_FIXTURE(setUp, NULL)

static double between(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (seed / 4294967296.);
}

/* Three numbers, in the same order with any compiler. */
static void anyVector(MeReal v[3], double size) {
    for (int i = 0; i < 3; i++)
        v[i] = (MeReal)between(-size, size);
}

static void anyTurn(MeMatrix4 tm) {
    MeReal v[3];
    anyVector(v, 3);
    MeMatrix4TMFromEulerAnglesAndPosition(tm, v[0], v[1], v[2], 0, 0, 0);
}

static void anyPlace(MeMatrix4 tm, double size) {
    MeReal v[3];
    anyTurn(tm);
    anyVector(v, size);
    MeMatrix4TMSetPosition(tm, v[0], v[1], v[2]);
}

static int meet(McdModelID a, McdModelID b) {
    McdModelPair p;
    memset(&p, 0, sizeof p);
    p.model1 = a;
    p.model2 = b;
    McdModelUpdate(a);
    McdModelUpdate(b);
    McdHello(&p);
    result = (McdIntersectResult){.contacts = contact, .contactMaxCount = 40};
    ck_assert((McdIntersect)(&p, &result));
    McdGoodbye(&p);
    return result.contactCount;
}

static double deepest(void) {
    double min = INFINITY;
    for (int i = 0; i < result.contactCount; i++)
        min = fmin(min, McdContactGetSeparation(&contact[i]));
    return min;
}

/* ---- the same as built-in shapes --------------------------------------------------------------------------------- */

/* Both are placed the same way many times against each of the other geometries: the same contacts. */
typedef struct Twins {
    McdGeometryID own, builtIn;
    double size, normal; /* m; the normal's tolerance, but for some */
} Twins;

static int MEAPI twoTriangles(McdModelPair *p, McdUserTriangle *t, MeVector3 pos, MeReal radius, int max) {
    static MeVector3 corner[4] = {{-4, -4, 0}, {5, -4, 0}, {5, 5, 0}, {-4, 5, 0}};
    (void)p, (void)pos, (void)radius, (void)max;
    for (int i = 0; i < 2; i++)
        t[i] =
            (McdUserTriangle){.vertices = {&corner[0], &corner[i + 1], &corner[i + 2]}, .flags = kMcdTriangleStandard};
    return 2;
}

static int makeOthers(McdGeometryID *g) {
    static MeVector3 corner[8], low = {-4, -4, -1}, high = {5, 5, 1};
    static MeReal heights[16];
    static const int index[] = {0, 1, 2, 0, 2, 3};
    static MeVector3 vertex[4] = {{-4, -4, 0}, {5, -4, 0}, {5, 5, 0}, {-4, 5, 0}};
    int n = 0;
    MeMatrix4 tm;
    for (int i = 0; i < 8; i++)
        MeVector3Set(corner[i], i & 1 ? (MeReal).5 : (MeReal)-.4, i & 2 ? (MeReal).3 : (MeReal)-.3,
                     i & 4 ? (MeReal).4 : (MeReal)-.6);
    g[n++] = McdSphereCreate(frame, (MeReal).6);
    g[n++] = McdSphylCreate(frame, (MeReal).4, 1);
    g[n++] = McdBoxCreate(frame, 1, (MeReal)1.2, (MeReal).8);
    g[n++] = McdCylinderCreate(frame, (MeReal).6, 1);
    g[n++] = McdConeCreate(frame, 1, (MeReal).7);
    g[n++] = McdConvexMeshCreateHull(frame, (const MeVector3 *)corner, 8, 0);
    g[n++] = McdPlaneCreate(frame);
    g[n++] = McdTriangleListCreate(frame, low, high, 3, twoTriangles);
    g[n++] = McdRGHeightFieldCreate(frame, heights, 4, 4, 3, 3, -4, -4);
    g[n++] = McdMeshCreateWithFlags(frame, (const MeVector3 *)vertex, 4, index, 2, 0, kMcdMeshTwoSided);
    McdAggregateID a = McdAggregateCreate(frame, 1);
    MeMatrix4TMMakeIdentity(tm);
    McdAggregateAddElement(a, McdBoxCreate(frame, 1, 1, (MeReal).5), tm);
    g[n++] = a;
    g[n++] = ellipsoid_create(frame, .7, .5, .4);
    return n;
}
enum { OTHERS = 12, SMOOTH = 6 };

/* Whether a surface of triangles or a plane, which lies along z = 0. */
static MeBool isGround(McdGeometryID g) {
    const int type = McdGeometryGetType(g);
    return type == kMcdGeometryTypePlane || type == kMcdGeometryTypeTriangleList ||
           type == kMcdGeometryTypeRGHeightField || type == kMcdGeometryTypeMesh;
}

/* Rims and round sides of other shapes are searched to a normal of 3e-5 (docs/collision.md). */
static MeBool isRound(McdGeometryID g) {
    const int type = McdGeometryGetType(g);
    return type == kMcdGeometryTypeCylinder || type == kMcdGeometryTypeCone || type == kMcdGeometryTypeSphyl;
}

/* A face's normal is preferred to one along which the shapes are 2e-7 of their size less deep: it may then lean by the
 * root of twice that, 6.3e-4. */
static const double preferred = 2e-7, leaning = 7e-4;

/* Whether the normal leans by more than it should where no face is near. A gap of hardly anything has any normal near
 * its own. Where nothing is flat, there is one contact. */
static MeBool compareContacts(const Twins *t, McdGeometryID other, const McdContact *own, int count, double depth) {
    const double expected = deepest();
    double squared = 0;
    assert_near(depth, expected, 2 * preferred * t->size);
    if (fabs(expected) < 1e-3 * t->size)
        return MEFALSE;
    for (int j = 0; j < 3; j++)
        squared += pow((double)own[0].normal[j] - (double)contact[0].normal[j], 2);
    assert_near(sqrt(squared), 0, leaning);
    if (count == 1 && result.contactCount == 1 && !isRound(other) && expected > -.2 * t->size)
        for (int j = 0; j < 3; j++)
            assert_near(own[0].position[j], contact[0].position[j], leaning * t->size);
    return sqrt(squared) > (isRound(other) || expected < -.2 * t->size ? 20 * t->normal : t->normal);
}

static void compareTwins(const Twins *t, int poses) {
    McdGeometryID other[OTHERS];
    McdContact own[40];
    MeMatrix4 tm, place;
    ck_assert_int_eq(makeOthers(other), OTHERS);
    McdModelID first = McdModelCreate(t->own), second = McdModelCreate(t->builtIn);
    McdModelSetTransformPtr(first, tm);
    McdModelSetTransformPtr(second, tm);
    for (int k = 0; k < OTHERS; k++) {
        McdModelID m = McdModelCreate(other[k]);
        McdModelSetTransformPtr(m, place);
        int touching = 0, lean = 0;
        for (int i = 0; i < poses; i++) {
            anyTurn(place);
            if (isGround(other[k]))
                MeMatrix4TMMakeIdentity(place);
            anyPlace(tm, isGround(other[k]) ? .5 : 1);
            if (isGround(other[k])) /* its middle is above */
                tm[3][2] = MeFabs(tm[3][2]);
            const int count = i % 2 ? meet(first, m) : meet(m, first);
            const double depth = deepest();
            memcpy(own, contact, sizeof own);
            const int expected = i % 2 ? meet(second, m) : meet(m, second);
            ck_assert_msg((count > 0) == (expected > 0) || fabs(fmin(depth, deepest()) - .02) < 1e-6, "%s: %d and %d",
                          McdGeometryGetTypeName(other[k]), count, expected);
            touching += count > 0;
            if (count > 0 && expected > 0)
                lean += compareContacts(t, other[k], own, count, depth);
        }
        ck_assert_int_gt(touching, poses / 3);
        ck_assert_msg(lean <= poses / 50, "%s: %d of %d lean", McdGeometryGetTypeName(other[k]), lean, touching);
    }
}

TEST(an_ellipsoid_of_equal_axes_is_a_sphere) {
    const Twins t = {ellipsoid_create(frame, .5, .5, .5), McdSphereCreate(frame, (MeReal).5), .5, 5e-6};
    compareTwins(&t, 400);
}

TEST(a_capsule_is_a_sphyl) {
    const Twins t = {can_create(frame, .4, 1, METRUE), McdSphylCreate(frame, (MeReal).4, 1), .9, 5e-6};
    compareTwins(&t, 400);
}

TEST(a_segment_with_a_rounding_is_a_sphyl) {
    const Twins t = {rod_create(frame, .4, 1), McdSphylCreate(frame, (MeReal).4, 1), .9, 5e-6};
    compareTwins(&t, 400);
}

TEST(a_brick_is_a_box) {
    const Twins t = {brick_create(frame, 1, .8, .6, 0), McdBoxCreate(frame, 1, (MeReal).8, (MeReal).6), .7, 5e-6};
    compareTwins(&t, 400);
}

TEST(a_can_is_a_cylinder) {
    const Twins t = {can_create(frame, .4, 1, MEFALSE), McdCylinderCreate(frame, (MeReal).4, 1), .6, 2e-4};
    compareTwins(&t, 400);
}

/* ---- flat faces and lines ---------------------------------------------------------------------------------------- */

/* Each contact of the built-in twin is the own one's, too. */
static void findAllOf(const McdContact *own, int count, double tolerance) {
    ck_assert_int_eq(count, result.contactCount);
    for (int i = 0; i < result.contactCount; i++) {
        double nearest = INFINITY;
        for (int j = 0; j < count; j++) {
            double squared = 0;
            for (int k = 0; k < 3; k++) {
                const double d = (double)own[j].position[k] - (double)contact[i].position[k];
                squared += d * d;
            }
            nearest = fmin(nearest, sqrt(squared));
        }
        assert_near(nearest, 0, tolerance);
    }
}

/* Tilted a little, on a plane and on a box: as many contacts at the same places. */
static void standTilted(McdGeometryID own, McdGeometryID builtIn, double height, MeBool lies, int contacts,
                        double maxTilt) {
    McdContact kept[40];
    MeMatrix4 tm, ground;
    McdModelID first = McdModelCreate(own), second = McdModelCreate(builtIn);
    McdModelID under[2] = {McdModelCreate(McdPlaneCreate(frame)), McdModelCreate(McdBoxCreate(frame, 8, 8, 2))};
    McdModelSetTransformPtr(first, tm);
    McdModelSetTransformPtr(second, tm);
    for (int k = 0; k < 2; k++) {
        McdModelSetTransformPtr(under[k], ground);
        MeMatrix4TMMakeIdentity(ground);
        ground[3][2] = k ? -1 : 0;
        for (int i = 0; i < 100; i++) {
            const double tilt = i < 20 ? 0 : maxTilt * pow(10, between(-4, 0)), lying = lies ? 1.5707963267948966 : 0;
            MeReal v[3];
            anyVector(v, tilt);
            MeMatrix4TMFromEulerAnglesAndPosition(tm, (MeReal)lying + v[0], v[1], v[2], 0, 0, (MeReal)(height - .005));
            const int count = meet(first, under[k]);
            memcpy(kept, contact, sizeof kept);
            ck_assert_int_eq(meet(second, under[k]), contacts);
            findAllOf(kept, count, TOL(1e-5, 1e-5));
        }
    }
}

TEST(what_stands_has_the_contacts_of_its_twin) {
    standTilted(brick_create(frame, 1, .8, .6, 0), McdBoxCreate(frame, 1, (MeReal).8, (MeReal).6), .3, MEFALSE, 4, .01);
}

TEST(what_lies_has_two_contacts) {
    standTilted(can_create(frame, .4, 1, MEFALSE), McdCylinderCreate(frame, (MeReal).4, 1), .4, METRUE, 2, .01);
    standTilted(rod_create(frame, .4, 1), McdSphylCreate(frame, (MeReal).4, 1), .4, METRUE, 2, .01);
    standTilted(can_create(frame, .4, 1, METRUE), McdSphylCreate(frame, (MeReal).4, 1), .4, METRUE, 2, 2e-5);
}

/* A rim is sampled in other places than a cylinder's. */
TEST(a_can_stands_on_four_points_of_its_rim) {
    MeMatrix4 tm, ground;
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMMakeIdentity(ground);
    McdModelID can = McdModelCreate(can_create(frame, .4, 1, MEFALSE)), plane = McdModelCreate(McdPlaneCreate(frame));
    McdModelSetTransformPtr(can, tm);
    McdModelSetTransformPtr(plane, ground);
    tm[3][2] = (MeReal).495;
    ck_assert_int_eq(meet(can, plane), 4);
    for (int i = 0; i < 4; i++) {
        assert_near(contact[i].separation, -.005, TOL(1e-6, 1e-15));
        assert_near(hypot((double)contact[i].position[0], (double)contact[i].position[1]), .4, TOL(1e-7, 1e-15));
    }
}

/* ---- at any tilt ------------------------------------------------------------------------------------------------- */

/* A hull of corners on a ball, and the library's of the same corners. */
static Twins makeGems(int corners, double size) {
    MeVector3 v[GEM_CORNERS];
    Gem gem = {.count = corners};
    for (int i = 0; i < corners; i++) {
        anyVector(v[i], 1);
        const double k = size / sqrt((double)MeVector3Dot(v[i], v[i]));
        for (int j = 0; j < 3; j++) {
            v[i][j] *= (MeReal)k;
            gem.corner[i][j] = (double)v[i][j];
        }
    }
    return (Twins){gem_create(frame, &gem), McdConvexMeshCreateHull(frame, (const MeVector3 *)v, corners, 0), size, 0};
}

/* Whether a contact's gap is at the margin to within rounding: it may be there or not. */
static MeBool isAtMargin(double margin, double size) {
    for (int i = 0; i < result.contactCount; i++)
        if (fabs(McdContactGetSeparation(&contact[i]) - margin) < 1e-5 * size)
            return METRUE;
    return MEFALSE;
}

/* Of other contacts than its twin's: how many poses of all. Shapes turn freely, and are at most an eighth of their size
 * deep. `ground`: a surface along z = 0; else both are in all poses. */
static int countOthers(McdModelID model[2], McdModelID with[2], MeMatrix4 tm, MeMatrix4 place, const Twins *t,
                       MeBool isOnGround, int poses) {
    McdContact kept[40];
    int others = 0;
    for (int i = 0; i < poses;) {
        const double size = t->size, margin = (double)McdModelGetContactTolerance(model[0]) * 2;
        anyTurn(place);
        if (isOnGround)
            MeMatrix4TMMakeIdentity(place);
        anyPlace(tm, 1.6 * size);
        tm[3][2] = isOnGround ? MeFabs(tm[3][2]) : tm[3][2];
        const int count = meet(model[0], with[0]);
        const double depth = deepest();
        const MeBool isUnsure = isAtMargin(margin, size);
        memcpy(kept, contact, sizeof kept);
        const int expected = meet(model[1], with[1]);
        if (expected == 0 || deepest() < -size / 8 || isUnsure || isAtMargin(margin, size))
            continue;
        i++;
        assert_near(depth, deepest(), 1e-6 * size);
        double worst = count == expected ? 0 : INFINITY;
        for (int j = 0; j < result.contactCount; j++) {
            double nearest = INFINITY;
            for (int k = 0; k < count; k++) {
                MeVector3 offset;
                MeVector3Subtract(offset, kept[k].position, contact[j].position);
                nearest = fmin(nearest, (double)MeVector3Magnitude(offset));
            }
            worst = fmax(worst, nearest);
        }
        others += worst > 1e-5 * size;
    }
    return others;
}

/* On a plane, a mesh, a ball; and, where nothing is round but ends with a rounding, on a box and on itself. */
static void compareAtAnyTilt(const Twins *t, MeBool isRound) {
    enum { GROUNDS = 3, OTHERS_ALL = 5, POSES = 400 };
    static const int index[] = {0, 1, 2, 0, 2, 3};
    MeVector3 vertex[4] = {{-40, -40, 0}, {50, -40, 0}, {50, 50, 0}, {-40, 50, 0}};
    MeMatrix4 tm, place;
    McdGeometryID other[] = {McdPlaneCreate(frame),
                             McdMeshCreateWithFlags(frame, (const MeVector3 *)vertex, 4, index, 2, 0, kMcdMeshTwoSided),
                             McdSphereCreate(frame, (MeReal)t->size), McdBoxCreate(frame, 1, (MeReal)1.2, (MeReal).8),
                             0};
    for (int i = 0; i < (isRound ? GROUNDS : OTHERS_ALL); i++) {
        McdModelID model[2], with[2];
        for (int k = 0; k < 2; k++) {
            model[k] = McdModelCreate(k ? t->builtIn : t->own);
            with[k] = McdModelCreate(other[i] ? other[i] : k ? t->builtIn : t->own);
            McdModelSetTransformPtr(model[k], tm);
            McdModelSetTransformPtr(with[k], place);
        }
        const int others = countOthers(model, with, tm, place, t, i < 2, POSES);
        /* of five points that are equally far or deep another one may be left out */
        ck_assert_msg(others <= (i < GROUNDS ? 0 : POSES / 200), "%d: %d of %d differ", i, others, POSES);
        for (int k = 0; k < 2; k++) {
            McdModelDestroy(model[k]);
            McdModelDestroy(with[k]);
        }
    }
}

TEST(its_contacts_are_those_of_its_twin_at_any_tilt) {
    const Twins flat[] = {{brick_create(frame, 1, .8, .6, 0), McdBoxCreate(frame, 1, (MeReal).8, (MeReal).6), .7, 0},
                          {rod_create(frame, .3, 1), McdSphylCreate(frame, (MeReal).3, 1), .8, 0},
                          makeGems(12, .6),
                          makeGems(40, .6)};
    const Twins round[] = {
        {can_create(frame, .3, 1, METRUE), McdSphylCreate(frame, (MeReal).3, 1), .8, 0},
        {can_create(frame, .4, 1, MEFALSE), McdCylinderCreate(frame, (MeReal).4, 1), .6, 0},
        {can_create(frame, .5, .02, MEFALSE), McdCylinderCreate(frame, (MeReal).5, (MeReal).02), .5, 0},
        {horn_create(frame, .5, 1), McdConeCreate(frame, 1, (MeReal).5), .8, 0}};
    for (int i = 0; i < 4; i++) {
        compareAtAnyTilt(&flat[i], MEFALSE);
        compareAtAnyTilt(&round[i], METRUE);
    }
}

/* ---- rays -------------------------------------------------------------------------------------------------------- */

static void compareRays(McdGeometryID own, McdGeometryID builtIn, double tolerance) {
    MeMatrix4 tm;
    McdModelID first = McdModelCreate(own), second = McdModelCreate(builtIn);
    int hits = 0;
    McdModelSetTransformPtr(first, tm);
    McdModelSetTransformPtr(second, tm);
    for (int i = 0; i < 1000; i++) {
        McdLineSegIntersectResult a = {.distance = -1}, b = {.distance = -1};
        MeVector3 from, to;
        const double far = i % 5 ? 2 : 500, near = i % 3 ? 1 : .2;
        anyPlace(tm, .5);
        for (int k = 0; k < 3; k++) {
            from[k] = (MeReal)between(-far, far);
            to[k] = i % 7 ? (MeReal)between(-near, near) : 3 * from[k];
        }
        McdModelUpdate(first);
        McdModelUpdate(second);
        const unsigned expected = McdLineSegIntersect(second, from, to, &b);
        if (McdLineSegIntersect(first, from, to, &a) != expected) {
            ck_assert_msg(i % 7 == 0, "ray %d", i); /* it ends outside, and may touch */
            continue;
        }
        hits += expected != 0;
        if (!expected)
            continue;
        assert_near(a.distance, b.distance, tolerance * (1 + far / 10));
        for (int k = 0; k < 3 && b.distance > 0; k++)
            assert_near(a.normal[k], b.normal[k], 10 * tolerance * (1 + far / 10));
    }
    ck_assert_int_gt(hits, 250);
}

TEST(rays_hit_it_where_they_hit_its_twin) {
    compareRays(ellipsoid_create(frame, .5, .5, .5), McdSphereCreate(frame, (MeReal).5), TOL(4e-6, 4e-6));
    compareRays(can_create(frame, .4, 1, METRUE), McdSphylCreate(frame, (MeReal).4, 1), TOL(4e-6, 4e-6));
    compareRays(brick_create(frame, 1, .8, .6, 0), McdBoxCreate(frame, 1, (MeReal).8, (MeReal).6), TOL(4e-6, 4e-6));
}

static int rays;

static MeBool MEAPI rayOfBall(const void *data, const double from[3], const double along[3], double *t,
                              double normal[3]) {
    const double *r = ((const Ellipsoid *)data)->radius;
    const double a = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
    const double b = from[0] * along[0] + from[1] * along[1] + from[2] * along[2];
    const double c = from[0] * from[0] + from[1] * from[1] + from[2] * from[2] - r[0] * r[0];
    rays++;
    if (b * b < a * c)
        return MEFALSE;
    *t = (-b - sqrt(b * b - a * c)) / a;
    for (int i = 0; i < 3; i++)
        normal[i] = (from[i] + *t * along[i]) / r[0];
    return *t >= 0 && *t <= 1;
}

TEST(a_ray_function_of_the_program_is_called) {
    static const McdConvexFunctions functions = {.support = ellipsoidSupport, .ray = rayOfBall};
    const Ellipsoid ball = {{.5, .5, .5}};
    const int type = McdFrameworkRegisterConvexType(frame, "Ball", sizeof ball, &functions);
    rays = 0;
    compareRays(McdConvexCreate(frame, type, &ball), McdSphereCreate(frame, (MeReal).5), TOL(4e-6, 4e-6));
    ck_assert_int_gt(rays, 250);
}

/* ---- mass -------------------------------------------------------------------------------------------------------- */

typedef struct Mass {
    MeMatrix4 at;
    MeMatrix3 inertia;
    MeReal volume;
} Mass;

static Mass massOf(McdGeometryID g) {
    Mass m;
    ck_assert(McdGeometryGetMassProperties(g, m.at, m.inertia, &m.volume));
    return m;
}

static void compareMass(McdGeometryID g, McdGeometryID expected, double tolerance) {
    const Mass a = massOf(g), b = massOf(expected);
    const double size = cbrt((double)b.volume), moment = size * size * (double)b.volume;
    assert_near_rel(a.volume, b.volume, tolerance);
    for (int i = 0; i < 3; i++) {
        assert_near(a.at[3][i], b.at[3][i], tolerance * size);
        for (int k = 0; k < 3; k++)
            assert_near(a.inertia[i][k], b.inertia[i][k], tolerance * moment);
    }
}

/* The same shape, whose mass is computed from its support points. */
static McdGeometryID unweighed(const char *name, const McdConvexFunctions *functions, const void *data, size_t size) {
    const McdConvexFunctions bare = {.support = functions->support, .rounding = functions->rounding};
    return McdConvexCreate(frame, McdFrameworkRegisterConvexType(frame, name, size, &bare), data);
}

TEST(mass_by_support_points_is_exact_for_polyhedra) {
    compareMass(brick_create(frame, 1, .8, .6, 0), McdBoxCreate(frame, 1, (MeReal).8, (MeReal).6), TOL(4e-7, 1e-14));
    compareMass(brick_create(frame, 100, 80, 1, 0), McdBoxCreate(frame, 100, 80, 1), TOL(4e-7, 1e-13));
}

TEST(mass_by_support_points_is_nearly_exact_for_round_shapes) {
    const double scale[] = {.01, 1, 100};
    for (int i = 0; i < 3; i++) {
        const double k = scale[i];
        const Ellipsoid e = {{.5 * k, .3 * k, .2 * k}}, flat = {{.5 * k, .5 * k, .05 * k}};
        const Taper t = {{.3 * k, .15 * k}, .6 * k}, blunt = {{.1 * k, .4 * k}, .35 * k};
        compareMass(unweighed("e", &ellipsoidFunctions, &e, sizeof e),
                    ellipsoid_create(frame, e.radius[0], e.radius[1], e.radius[2]), 1e-5);
        compareMass(unweighed("e", &ellipsoidFunctions, &flat, sizeof flat),
                    ellipsoid_create(frame, flat.radius[0], flat.radius[1], flat.radius[2]), 1e-4);
        compareMass(unweighed("t", &taperFunctions, &t, sizeof t), taper_create(frame, .3 * k, .15 * k, .6 * k), 1e-4);
        compareMass(unweighed("t", &taperFunctions, &blunt, sizeof blunt), taper_create(frame, .1 * k, .4 * k, .35 * k),
                    1e-4);
    }
    compareMass(can_create(frame, .4, 1, METRUE), McdSphylCreate(frame, (MeReal).4, 1), 1e-4);
    compareMass(can_create(frame, .4, 1, MEFALSE), McdCylinderCreate(frame, (MeReal).4, 1), 1e-3);
}

/* About its own centre an even taper is a sphyl. */
TEST(the_formula_of_a_taper_is_right) {
    const Mass taper = massOf(taper_create(frame, .4, .4, 1)), sphyl = massOf(McdSphylCreate(frame, (MeReal).4, 1));
    assert_near_rel(taper.volume, sphyl.volume, TOL(4e-7, 1e-15));
    assert_near(taper.at[3][2], .5, TOL(1e-7, 1e-15));
    for (int i = 0; i < 3; i++)
        assert_near_rel(taper.inertia[i][i], sphyl.inertia[i][i], TOL(4e-7, 1e-14));
}

/* ---- boxes, queries ---------------------------------------------------------------------------------------------- */

TEST(its_box_is_the_smallest) {
    MeVector3 low, high, centre;
    MeReal radius;
    MeMatrix4 tm;
    McdGeometryID e = ellipsoid_create(frame, .5, .3, .2);
    for (int i = 0; i < 100; i++) {
        anyPlace(tm, 3);
        McdGeometryGetAABB(e, (const MeVector4 *)tm, low, high);
        for (int k = 0; k < 3; k++) {
            const double reach =
                sqrt(pow(.5 * (double)tm[0][k], 2) + pow(.3 * (double)tm[1][k], 2) + pow(.2 * (double)tm[2][k], 2));
            assert_near(high[k], (double)tm[3][k] + reach, TOL(1e-6, 1e-14));
            assert_near(low[k], (double)tm[3][k] - reach, TOL(1e-6, 1e-14));
        }
    }
    McdGeometryGetBSphere(e, centre, &radius);
    ck_assert((double)radius >= .5 && (double)radius < .505);
}

TEST(queries_of_a_space_know_it) {
    MeMatrix4 tm, place;
    MeVector3 way = {3, 0, 0};
    McdCastResult cast;
    McdClosestResult closest;
    McdModelID list[4];
    McdSpaceID space = (McdSpaceAxisSortCreate)(frame, McdAllAxes, 8, 8);
    McdModelID e = McdModelCreate(ellipsoid_create(frame, .5, .3, .2));
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMMakeIdentity(place);
    McdModelSetTransformPtr(e, tm);
    McdSpaceInsertModel(space, e);
    McdSpaceUpdateAll(space);
    place[3][0] = -2;
    McdGeometryID taper = taper_create(frame, .25, .1, .5);
    ck_assert(McdSpaceCastGeometry(space, taper, (const MeVector4 *)place, way, 0, 0, &cast));
    ck_assert(cast.model == e && (double)cast.fraction > 1.25 / 3 - 1e-6 && (double)cast.fraction < 1.4 / 3);
    ck_assert_int_eq(McdSpaceOverlapGeometry(space, taper, (const MeVector4 *)place, 0, 0, list, 4), 0);
    place[3][0] = (MeReal)-.7;
    ck_assert_int_eq(McdSpaceOverlapGeometry(space, taper, (const MeVector4 *)place, 0, 0, list, 4), 1);
    MeMatrix4TMSetPosition(place, 0, 3, 0);
    ck_assert(
        McdSpaceGetClosest(space, McdSphereCreate(frame, (MeReal).1), (const MeVector4 *)place, 10, 0, 0, &closest));
    assert_near(closest.distance, 2.6, TOL(1e-6, 1e-9));
    assert_vec3_near(closest.position2, 0, .3, 0, TOL(1e-6, 1e-9));
    McdSpaceDestroy(space);
}

/* ---- times of impact --------------------------------------------------------------------------------------------- */

TEST(its_time_of_impact_is_right) {
    McdModelPair p;
    McdSafeTimeResult time;
    MeMatrix4 tm, wall;
    MeVector3 velocity = {100, 0, 0}, spin = {0, 0, 0};
    McdModelID e = McdModelCreate(ellipsoid_create(frame, .5, .3, .2)), plane = McdModelCreate(McdPlaneCreate(frame));
    McdModelID box = McdModelCreate(brick_create(frame, (MeReal).02, 4, 4, 0));
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMMakeIdentity(wall);
    wall[3][0] = 30;
    McdModelSetTransformPtr(e, tm);
    McdModelSetTransformPtr(box, wall);
    McdModelSetTransformPtr(plane, wall);
    McdModelSetLinearVelocityPtr(e, velocity);
    McdModelSetAngularVelocityPtr(e, spin);
    memset(&p, 0, sizeof p);
    p.model1 = e;
    p.model2 = box;
    McdModelUpdate(e);
    McdModelUpdate(box);
    ck_assert(McdSafeTime(&p, 1, &time));
    assert_near(time.time, .2949, TOL(1e-6, 1e-6));
    p.model2 = plane;
    tm[3][2] = 3;
    MeVector3Set(velocity, 0, 0, -10);
    McdModelUpdate(e);
    McdModelUpdate(plane);
    ck_assert(McdSafeTime(&p, 1, &time));
    assert_near(time.time, .28, TOL(1e-5, 1e-5));
}

/* ---- life, registration ------------------------------------------------------------------------------------------ */

TEST(a_type_is_registered_once) {
    const int first = McdFrameworkRegisterConvexType(frame, "A", 8, &brickFunctions);
    const int second = McdFrameworkRegisterConvexType(frame, "B", 8, &brickFunctions);
    ck_assert_int_eq(first, kMcdGeometryFirstUserType + 2); /* behind the program's own two */
    ck_assert_int_eq(second, first + 1);
    ck_assert_int_eq(McdFrameworkRegisterConvexType(frame, "A", 8, &brickFunctions), first);
    ck_assert_str_eq(McdFrameworkGetTypeName(frame, second), "B");
    ck_assert(McdFrameworkTypeIsConvex(frame, first) && !McdFrameworkTypeIsConvex(frame, kMcdGeometryTypeBox));
    ck_assert(!McdFrameworkTypeIsConvex(frame, -1) && !McdFrameworkTypeIsConvex(frame, 1000));
    ck_assert(McdFrameworkGetInteractions(frame, first, second) || McdFrameworkGetInteractions(frame, second, first));
    ck_assert(McdFrameworkGetInteractions(frame, kMcdGeometryTypeAggregate, second));
}

TEST(many_shapes_come_and_go) {
    const int before = McdFrameworkGetGeometryCount(frame);
    for (int i = 0; i < 200; i++) {
        McdGeometryID g = i % 2 ? ellipsoid_create(frame, 1 + i, 1, 1) : taper_create(frame, 1, 2 + i, 200);
        McdModelID m = McdModelCreate(g);
        McdModelDestroy(m);
        McdGeometryDestroy(g);
    }
    ck_assert_int_eq(McdFrameworkGetGeometryCount(frame), before);
    for (int i = 0; i < 5; i++) {
        McdFrameworkID other = (McdInit)(0, 4, 4, 1);
        McdGeometryDestroy(ellipsoid_create(other, 1, 1, 1));
        ellipsoid_create(other, 1, 2, 1);
        McdFrameworkDestroyAllModelsAndGeometries(other);
        McdTerm(other);
    }
}

static void MEAPI pointed(const void *data, const double d[3], double point[3]) {
    const double *const *half = data;
    for (int i = 0; i < 3; i++)
        point[i] = copysign((*half)[i], d[i]);
}

TEST(its_data_may_be_changed) {
    MeMatrix4 tm, ground;
    McdGeometryID e = ellipsoid_create(frame, .5, .3, .2);
    McdModelID m = McdModelCreate(e), plane = McdModelCreate(McdPlaneCreate(frame));
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMMakeIdentity(ground);
    tm[3][2] = (MeReal).5;
    McdModelSetTransformPtr(m, tm);
    McdModelSetTransformPtr(plane, ground);
    ck_assert_int_eq(meet(m, plane), 0);
    McdConvexSetData(e, &(Ellipsoid){{.5, .3, .6}});
    assert_near(((const Ellipsoid *)McdConvexGetData(e))->radius[2], .6, 0);
    ck_assert_int_eq(meet(m, plane), 1);
    assert_near(deepest(), -.1, TOL(1e-6, 1e-15));
}

/* The same number of contacts as a box that was made so. */
TEST(its_faces_change_with_its_data) {
    static double half[3] = {.5, .5, .5};
    MeMatrix4 tm, ground;
    const McdConvexFunctions functions = {.support = pointed};
    const double *data = half;
    McdGeometryID g =
        McdConvexCreate(frame, McdFrameworkRegisterConvexType(frame, "Pointer", sizeof data, &functions), &data);
    McdModelID m = McdModelCreate(g), plane = McdModelCreate(McdPlaneCreate(frame));
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMMakeIdentity(ground);
    McdModelSetTransformPtr(m, tm);
    McdModelSetTransformPtr(plane, ground);
    for (int i = 1; i < 4; i++) {
        half[2] = .5 * i;
        McdConvexSetData(g, McdConvexGetData(g)); /* what they point to has changed */
        tm[3][2] = (MeReal)(half[2] - .005);
        ck_assert_int_eq(meet(m, plane), 4);
        assert_near(deepest(), -.005, TOL(2e-7, 1e-15));
    }
}

/* ---- bad input --------------------------------------------------------------------------------------------------- */

static void MEAPI notANumber(const void *data, const double d[3], double point[3]) {
    (void)data;
    for (int i = 0; i < 3; i++)
        point[i] = d[i] > .9 ? NAN : d[i];
}

static void MEAPI nothing(const void *data, const double d[3], double point[3]) {
    (void)data, (void)d, (void)point;
}

static void MEAPI onePoint(const void *data, const double d[3], double point[3]) {
    (void)d;
    memcpy(point, data, 3 * sizeof *point);
}

TEST(bad_types_are_refused) {
    const McdConvexFunctions none = {.support = 0};
    ck_assert_int_eq(McdFrameworkRegisterConvexType(frame, "x", 8, 0), 0);
    assert_warned("McdFrameworkRegisterConvexType: functions is null");
    ck_assert_int_eq(McdFrameworkRegisterConvexType(frame, "x", 8, &none), 0);
    assert_warned("set functions->support");
    ck_assert_int_eq(McdFrameworkRegisterConvexType(0, "x", 8, &brickFunctions), 0);
    assert_warned("McdFrameworkRegisterConvexType");
    ck_assert_int_eq(McdFrameworkRegisterConvexType(frame, "x", (size_t)-1, &brickFunctions), 0);
    assert_warned("dataSize");
    ck_assert_str_eq(McdFrameworkGetTypeName(frame, McdFrameworkRegisterConvexType(frame, 0, 8, &brickFunctions)),
                     "(no name)");
}

static McdGeometryID createBy(McdConvexSupportFn support, double x) {
    const McdConvexFunctions functions = {.support = support};
    const double data[3] = {x, x, x};
    return McdConvexCreate(frame, McdFrameworkRegisterConvexType(frame, "bad", sizeof data, &functions), data);
}

TEST(bad_shapes_are_refused) {
    const int count = McdFrameworkGetGeometryCount(frame);
    ck_assert(!createBy(notANumber, 1));
    assert_warned("McdConvexCreate");
    ck_assert(!createBy(nothing, 1));
    assert_warned("McdConvexCreate");
    ck_assert(!createBy(onePoint, 0));
    assert_warned("without extent");
    ck_assert(!createBy(onePoint, INFINITY));
    assert_warned("McdConvexCreate");
    ck_assert(!createBy(onePoint, 1e300));
    assert_warned("McdConvexCreate");
    ck_assert(!ellipsoid_create(frame, 0, 0, 0));
    assert_warned("McdConvexCreate");
    ck_assert(!brick_create(frame, 1, 1, 1, -1));
    assert_warned("McdConvexCreate");
    ck_assert(!McdConvexCreate(frame, kMcdGeometryTypeBox, &count));
    assert_warned("McdConvexCreate: 2 is no type");
    ck_assert(!McdConvexCreate(frame, McdFrameworkRegisterConvexType(frame, "x", 8, &brickFunctions), 0));
    assert_warned("McdConvexCreate: data is null");
    ck_assert(!McdConvexCreate(0, 16, &count));
    assert_warned("McdConvexCreate");
    ck_assert_int_eq(McdFrameworkGetGeometryCount(frame), count);
}

TEST(bad_data_leave_a_shape_as_it_is) {
    McdGeometryID e = ellipsoid_create(frame, .5, .3, .2), box = McdBoxCreate(frame, 1, 1, 1);
    McdConvexSetData(e, &(Ellipsoid){{NAN, 1, 1}});
    assert_warned("McdConvexSetData");
    McdConvexSetData(e, 0);
    assert_warned("McdConvexSetData: data is null");
    assert_near(((const Ellipsoid *)McdConvexGetData(e))->radius[0], .5, 0);
    assert_refused(McdConvexSetData, box, &(Ellipsoid){{1, 1, 1}});
    ck_assert(!McdConvexGetData(box));
    assert_warned("McdConvexGetData");
}

/* The function is right while the shape is created, and wrong after that: one message, and numbers that are finite. */
static int wrongWay;

static void MEAPI moody(const void *data, const double d[3], double point[3]) {
    ellipsoidSupport(data, d, point);
    if (wrongWay == 1)
        point[0] = NAN;
    for (int i = 0; i < 3 && wrongWay == 2; i++)
        point[i] *= 1e30;
    for (int i = 0; i < 3 && wrongWay == 3; i++) /* not that of any convex shape */
        point[i] = .3 * sin(1e3 * (d[0] + 2 * d[1] + 3 * d[2]) + i);
    for (int i = 0; i < 3 && wrongWay == 4; i++) /* the nearest point */
        point[i] = -point[i];
}

LOOP_TEST(wrong_points_are_told_once, 1, 5) {
    const McdConvexFunctions functions = {.support = moody};
    const Ellipsoid data = {{.5, .4, .3}};
    McdGeometryID other[OTHERS];
    MeMatrix4 tm, place;
    wrongWay = 0;
    McdModelID m = McdModelCreate(
        McdConvexCreate(frame, McdFrameworkRegisterConvexType(frame, "Moody", sizeof data, &functions), &data));
    McdModelSetTransformPtr(m, tm);
    makeOthers(other);
    wrongWay = _i;
    for (int k = 0; k < OTHERS; k++) {
        McdModelID with = McdModelCreate(other[k]);
        McdModelSetTransformPtr(with, place);
        for (int i = 0; i < 50; i++) {
            McdModelPair p;
            McdDistanceResult distance;
            anyTurn(place);
            anyPlace(tm, .7);
            for (int n = meet(m, with) - 1; n >= 0; n--)
                ck_assert(isfinite((double)contact[n].position[0] + (double)contact[n].separation) &&
                          isfinite((double)contact[n].normal[0]));
            memset(&p, 0, sizeof p);
            p.model1 = m;
            p.model2 = with;
            McdDistance(&p, &distance);
            ck_assert(isfinite((double)distance.distance));
        }
    }
    wrongWay = 0;
    assert_warned("Moody");
}
