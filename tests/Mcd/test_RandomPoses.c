/* What programs get for random poses, through McdIntersect: sizes and transforms rounded to the precision of the build
 * make contacts whose depths are those of the exact shapes to 1e-5 of the size in single. */
#include "McdCone.h"
#include "McdConvexInteractions.h"
#include "McdConvexMesh.h"
#include "McdPrimitives.h"
#include "karma_test.h"
#include "convex/mcd_vector_i.h"
#include "reference.h"

enum { POSES = 40, MAX_CORNERS = 48 };
static const int kind[] = {SHAPE_BOX, SHAPE_SPHERE, SHAPE_CYLINDER, SHAPE_SPHYL, SHAPE_CONE, SHAPE_HULL};
enum { KINDS = sizeof kind / sizeof *kind };
static const double depthError = TOL(1e-5, 1e-8); /* of the smaller shape's extent */

static McdFrameworkID frame;

static McdGeometryID createHull(const McdHull *h) {
    MeVector3 corner[MAX_CORNERS];
    for (int i = 0; i < h->vertexCount; i++)
        for (int k = 0; k < 3; k++)
            corner[i][k] = (MeReal)h->vertex[i][k];
    return McdConvexMeshCreateHull(frame, (const MeVector3 *)corner, h->vertexCount, 0);
}

/* The geometry of a shape, whose sizes are rounded on the way. A cone's origin is where the library puts it. */
static McdGeometryID create(McdShape *s) {
    const MeReal x = s->size[0], y = (MeReal)s->size[1], z = (MeReal)s->size[2], r = (MeReal)s->rounding;
    switch (s->kind->type) {
    case kMcdGeometryTypeSphere:
        return McdSphereCreate(frame, r);
    case kMcdGeometryTypeBox:
        return McdBoxCreate(frame, 2 * x, 2 * y, 2 * z);
    case kMcdGeometryTypeCylinder:
        return McdCylinderCreate(frame, x, z);
    case kMcdGeometryTypeSphyl:
        return McdSphylCreate(frame, r, 2 * (MeReal)s->low);
    case kMcdGeometryTypeCone: {
        const McdGeometryID g = McdConeCreate(frame, z, x);
        McdConeSetGeometricalParameters(g, z, x, y);
        s->low = ((const McdCone *)g)->lowerHeight;
        return g;
    }
    default:
        return createHull(s->hull);
    }
}

/* As far as a hundred of their sizes from the world's origin; within each other by up to half the smaller one. */
static void placePair(McdShape *a, McdShape *b, double size, Random *r) {
    double n[3];
    shape_rotateRandomly(a, r);
    shape_rotateRandomly(b, r);
    random_direction(r, n);
    const double k = -reference_along(a, b, n) - random_between(r, 0, .5) * size;
    shape_move(a, k * n[0], k * n[1], k * n[2]);
    random_direction(r, n);
    const double away = random_between(r, 0, 100) * size;
    shape_move(a, away * n[0], away * n[1], away * n[2]);
    shape_move(b, away * n[0], away * n[1], away * n[2]);
}

static McdModelID createModel(const McdShape *s, McdGeometryID g, MeMatrix4 tm) {
    const McdModelID m = McdModelCreate(g);
    MeMatrix4TMMakeIdentity(tm);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            tm[i][k] = (MeReal)s->axis[i][k];
        tm[3][i] = (MeReal)s->place[i];
    }
    McdModelSetTransformPtr(m, tm);
    McdModelUpdate(m);
    return m;
}

static double deepest(const McdIntersectResult *result) {
    double s = INFINITY;
    for (int i = 0; i < result->contactCount; i++)
        s = fmin(s, result->contacts[i].separation);
    return s;
}

static double worst;

static void comparePair(int kindA, int kindB, double scale, Random *r) {
    McdShape a, b;
    MeMatrix4 tm[2];
    McdContact contacts[8];
    McdIntersectResult result = {.contacts = contacts, .contactMaxCount = 8};
    double n[3];
    frame = McdInit(0, 2, 0, scale);
    McdPrimitivesRegisterTypes(frame);
    McdConvexMeshRegisterType(frame);
    McdConeRegisterType(frame);
    McdPrimitivesRegisterInteractions(frame);
    McdConvexMeshPrimitivesRegisterInteractions(frame);
    McdConePrimitivesRegisterInteractions(frame);
    McdConeConvexMeshRegisterInteraction(frame);
    shape_random(&a, kindA, scale, 0, r);
    shape_random(&b, kindB, scale, 0, r);
    const McdGeometryID ga = create(&a), gb = create(&b);
    const double size = fmin(a.extent, b.extent);
    placePair(&a, &b, size, r);
    McdModelPair p = {.model1 = createModel(&a, ga, tm[0]), .model2 = createModel(&b, gb, tm[1])};
    const double expected = reference_distance(&a, &b, 200, n);
    McdHello(&p);
    ck_assert_int_eq(McdIntersect(&p, &result), 1);
    const MeBool isTouching = result.contactCount > 0;
    if (expected < -depthError * size)
        ck_assert_msg(isTouching, "%s, %s: no contact at %g", shape_name[kindA], shape_name[kindB], expected);
    if (isTouching) {
        const MeReal *normal = contacts[0].normal;
        mcd_set(n, (double)normal[0], (double)normal[1], (double)normal[2]);
        /* The reference may miss the best direction, of which the result's normal shows what it is worth. */
        const double off = (deepest(&result) - fmax(expected, reference_along(&a, &b, n))) / size;
        worst = fmax(worst, fabs(off));
        ck_assert_msg(fabs(off) <= depthError, "%s, %s: off by %g of the size", shape_name[kindA], shape_name[kindB],
                      off);
        assert_near(mcd_length(n), 1, TOL(5e-7, 2e-14));
    }
    McdGoodbye(&p);
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    McdTerm(frame);
}

TEST(depths_of_rounded_poses) {
    for (int i = 0; i < KINDS; i++)
        for (int j = i; j < KINDS; j++) {
            Random r = {.state = (unsigned long long)(900 + 10 * i + j)};
            for (int k = 0; k < POSES; k++)
                comparePair(kind[k & 1 ? i : j], kind[k & 1 ? j : i], k % 3 == 0 ? 1e-3 : k % 3 == 1 ? 1e3 : 1, &r);
        }
    printf("depths of rounded poses are off by at most %.2g of the size\n", worst);
}
