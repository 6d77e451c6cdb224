/* The geometries: sizes in and out, boxes, spheres and farthest points around each, drawing, and bad input. */
#include "MeDebugDraw.h"
#include "shapes.h"

static const double tolerance = TOL(2e-6, 1e-13);

TEST(sizes_come_back) {
    McdFrameworkID f = framework();
    MeReal x, y, z;
    McdGeometryID g = McdSphereCreate(f, 2);
    assert_near(McdSphereGetRadius(g), 2, 0);
    McdSphereSetRadius(g, 3);
    assert_near(McdSphereGetRadius(g), 3, 0);
    ck_assert_int_eq(McdGeometryGetType(g), McdSphereGetTypeId());
    ck_assert_str_eq(McdGeometryGetTypeName(g), McdSphereGetTypeName(g));
    McdGeometryDestroy(g);
    g = McdBoxCreate(f, 2, 3, 4);
    McdBoxGetDimensions(g, &x, &y, &z);
    ck_assert(x == 2 && y == 3 && z == 4);
    McdBoxSetDimensions(g, 5, 6, 7);
    assert_vec3_near(McdBoxGetRadii(g), 2.5, 3, 3.5, 0);
    MeVector3 d = {1, -1, 2}, p;
    McdBoxMaximumPointLocal(g, d, p);
    assert_vec3_near(p, 2.5, -3, 3.5, 0);
    McdGeometryDestroy(g);
    g = McdCylinderCreate(f, 2, 3);
    assert_near(McdCylinderGetHalfHeight(g), 1.5, 0);
    McdCylinderSetRadius(g, 4);
    McdCylinderSetHeight(g, 5);
    ck_assert(McdCylinderGetRadius(g) == 4 && McdCylinderGetHeight(g) == 5);
    McdCylinderSetGeometricalParameters(g, 6, 7);
    ck_assert(McdCylinderGetRadius(g) == 6 && McdCylinderGetHeight(g) == 7);
    MeVector3 e = {3, 4, -1};
    McdCylinderMaximumPointLocal(g, e, p);
    assert_vec3_near(p, 3.6, 4.8, -3.5, TOL(1e-6, 5e-15));
    McdGeometryDestroy(g);
    g = McdSphylCreate(f, 2, 3);
    McdSphylSetRadius(g, 4);
    McdSphylSetHeight(g, 5);
    ck_assert(McdSphylGetRadius(g) == 4 && McdSphylGetHeight(g) == 5);
    McdGeometryDestroy(g);
    g = McdConeCreate(f, 4, 3);
    ck_assert(McdConeGetLength(g) == 4 && McdConeGetLowerRadius(g) == 3 && McdConeGetUpperRadius(g) == 0);
    ck_assert(McdConeGetLowerHeight(g) == 1 && McdConeGetUpperHeight(g) == 3 && McdConeGetZOffset(g) == 1);
}

TEST(polygons_of_a_mesh) {
    McdFrameworkID f = framework();
    McdGeometryID g = boxMesh(f, boxSize, 1, .1);
    assert_near(McdConvexMeshGetFatness(g), .1, TOL(1e-8, 0));
    ck_assert_int_eq(McdConvexMeshGetPolygonCount(g), 6);
    for (int i = 0; i < 6; i++) {
        MeVector3 n, v, e[2], right;
        McdConvexMeshGetPolygonNormal(g, i, n);
        ck_assert_int_eq(McdConvexMeshGetPolygonVertexCount(g, i), 4);
        for (int k = 0; k < 4; k++) {
            McdConvexMeshGetPolygonVertex(g, i, k, v);
            ck_assert_int_eq(memcmp(v, McdConvexMeshGetPolygonVertexPtr(g, i, k), sizeof v), 0);
            ck_assert(MeVector3Dot(v, n) > 0);
        }
        MeVector3Subtract(e[0], McdConvexMeshGetPolygonVertexPtr(g, i, 1), McdConvexMeshGetPolygonVertexPtr(g, i, 0));
        MeVector3Subtract(e[1], McdConvexMeshGetPolygonVertexPtr(g, i, 2), McdConvexMeshGetPolygonVertexPtr(g, i, 1));
        MeVector3Cross(right, e[0], e[1]);
        ck_assert(MeVector3Dot(right, n) > 0); /* counter-clockwise */
    }
    McdGeometryDestroy(g);
    g = McdConvexMeshCreateSphyl(f, 1, 2);
    ck_assert_int_gt(McdConvexMeshGetPolygonCount(g), 100);
    MeVector3 low, high;
    MeMatrix4 tm;
    MeMatrix4TMMakeIdentity(tm);
    McdGeometryGetAABB(g, (const MeVector4 *)tm, low, high);
    assert_vec3_near(low, -1, -1, -2, TOL(1e-6, 1e-14));
    assert_vec3_near(high, 1, 1, 2, TOL(1e-6, 1e-14));
}

/* Points of the surface: from the middle outwards in any direction. */
static void surfacePoint(int kind, double p[3]) {
    double d[3], low = 0, high = 4;
    for (int k = 0; k < 3; k++)
        d[k] = uniform(-1, 1);
    for (int i = 0; i < 60; i++) {
        const double middle = (low + high) / 2, q[3] = {middle * d[0], middle * d[1], middle * d[2]};
        *(excess(kind, q) > 0 ? &high : &low) = middle;
    }
    for (int k = 0; k < 3; k++)
        p[k] = low * d[k];
}

static void assertSphere(McdGeometryID g, double z, double radius) {
    MeVector3 centre;
    MeReal r;
    McdGeometryGetBSphere(g, centre, &r);
    assert_vec3_near(centre, 0, 0, z, TOL(5e-7, 9e-16) * radius);
    assert_near_rel(r, radius, TOL(1e-6, 2e-15));
    McdGeometryDestroy(g);
}

/* Of cones: through the tip and the rim, or with the rim as its equator where that is wider; the origin is a quarter
 * up. */
TEST(spheres_around_are_the_smallest) {
    McdFrameworkID f = framework();
    assertSphere(McdSphereCreate(f, 3), 0, 3);
    assertSphere(McdBoxCreate(f, 2, 4, 4), 0, 3);
    assertSphere(McdCylinderCreate(f, 3, 8), 0, 5);
    assertSphere(McdSphylCreate(f, 3, 8), 0, 7);
    for (double radius = .25; radius < 20; radius *= 2)
        for (double length = .5; length < 9; length *= 2) {
            const double up = radius < length ? (length - radius * radius / length) / 2 : 0;
            assertSphere(McdConeCreate(f, length, radius), up - length / 4, radius < length ? length - up : radius);
        }
}

TEST(boxes_spheres_and_farthest_points) {
    McdFrameworkID f = framework();
    for (int kind = 0; kind < SOLIDS; kind++)
        for (double size = 1e-3; size < 2e3; size *= 1e3) {
            McdGeometryID g = solid(f, kind, size);
            McdModelID m = McdModelCreate(g);
            McdGeometryInstanceID ins = McdModelGetGeometryInstance(m);
            MeMatrix4 tm;
            McdModelSetTransformPtr(m, tm);
            for (int n = 0; n < 20; n++) {
                MeVector3 low, high, centre, far[6], dir[6];
                MeReal radius;
                double out = 0, beyond = 0, away = 0;
                randomPlace(tm, size);
                McdModelUpdate(m);
                McdModelGetAABB(m, low, high);
                McdModelGetBSphere(m, centre, &radius);
                for (int k = 0; k < 6; k++) {
                    for (int i = 0; i < 3; i++)
                        dir[k][i] = (MeReal)(k % 2 ? uniform(-1, 1) : i == k / 2);
                    McdGeometryInstanceMaximumPoint(ins, dir[k], far[k]);
                    const double p[3] = {(double)far[k][0], (double)far[k][1], (double)far[k][2]};
                    double q[3];
                    toShape((const MeVector4 *)tm, p, size, q);
                    assert_near(excess(kind, q), 0, tolerance);
                    if (k % 2 == 0) /* tight */
                        assert_near(high[k / 2], far[k][k / 2], tolerance * size);
                }
                for (int s = 0; s < 500; s++) {
                    double q[3], r = 0;
                    surfacePoint(kind, q);
                    for (int k = 0; k < 6; k++) {
                        double more = 0;
                        for (int i = 0; i < 3; i++)
                            more +=
                                (double)dir[k][i] *
                                ((double)tm[3][i] - (double)far[k][i] +
                                 size * ((double)tm[0][i] * q[0] + (double)tm[1][i] * q[1] + (double)tm[2][i] * q[2]));
                        beyond = fmax(beyond, more);
                    }
                    for (int i = 0; i < 3; i++) {
                        const double x = (double)tm[3][i] + size * ((double)tm[0][i] * q[0] + (double)tm[1][i] * q[1] +
                                                                    (double)tm[2][i] * q[2]);
                        out = fmax(out, fmax((double)low[i] - x, x - (double)high[i]));
                        r += (x - (double)centre[i]) * (x - (double)centre[i]);
                    }
                    away = fmax(away, sqrt(r) - (double)radius);
                }
                assert_below(beyond, tolerance * size);
                assert_below(out, TOL(1e-7, 1e-14) * size); /* the reference's sizes are not rounded */
                assert_below(away, tolerance * size);
            }
            McdModelDestroy(m);
            McdGeometryDestroy(g);
        }
}

TEST(a_box_around_two_places) {
    McdFrameworkID f = framework();
    McdGeometryID g[SOLIDS + 1];
    for (int kind = 0; kind <= SOLIDS; kind++) {
        g[kind] = kind < SOLIDS ? solid(f, kind, 1) : McdPlaneCreate(f);
        McdModelID m = McdModelCreate(g[kind]);
        MeMatrix4 tm[2];
        MeVector3 low[3], high[3];
        McdModelSetTransformPtr(m, tm[0]);
        for (int i = 0; i < 2; i++) {
            randomPlace(tm[i], 3);
            McdGeometryGetAABB(g[kind], (const MeVector4 *)tm[i], low[i], high[i]);
        }
        McdGeometryInstanceUpdateAABB(McdModelGetGeometryInstance(m), tm[1], 1);
        McdModelGetAABB(m, low[2], high[2]);
        for (int k = 0; k < 3; k++) {
            assert_near(low[2][k], MeMIN(low[0][k], low[1][k]), 0);
            assert_near(high[2][k], MeMAX(high[0][k], high[1][k]), 0);
        }
        McdModelDestroy(m);
        McdGeometryDestroy(g[kind]);
    }
}

TEST(a_level_plane_ends_at_its_height) {
    McdFrameworkID f = framework();
    McdGeometryID g = McdPlaneCreate(f);
    MeMatrix4 tm;
    MeVector3 low, high, n;
    MeMatrix4TMMakeIdentity(tm);
    tm[3][2] = 5;
    McdGeometryGetAABB(g, (const MeVector4 *)tm, low, high);
    assert_near(high[2], 5, 0);
    ck_assert(low[2] < -1e30 && low[0] < -1e30 && high[1] > 1e30);
    ck_assert(isfinite(high[0] - low[0]));
    McdPlaneGetNormal(g, (const MeVector4 *)tm, n);
    assert_vec3_near(n, 0, 0, 1, 0);
}

/* It has no farthest point; the one that is named lies beyond all others in each direction but up. */
TEST(a_plane_reaches_in_every_direction_but_up) {
    McdFrameworkID f = framework();
    McdGeometryID g = McdPlaneCreate(f);
    MeMatrix4 tm;
    MeMatrix4TMMakeIdentity(tm);
    for (int x = -1; x <= 1; x++)
        for (int y = -1; y <= 1; y++)
            for (int z = -1; z <= 1; z++) {
                MeVector3 d = {(MeReal)x, (MeReal)y, (MeReal)z}, p;
                const int sign[3] = {x, y, z < 0 ? -1 : 0};
                McdGeometryMaximumPoint(g, tm, d, p);
                for (int k = 0; k < 3; k++)
                    ck_assert(sign[k] == 0 ? p[k] == 0 : (MeReal)sign[k] * p[k] > (MeReal)1e30);
            }
}

/* The sphere around a solid touches it. */
TEST(spheres_are_tight) {
    McdFrameworkID f = framework();
    for (int kind = 0; kind < SOLIDS; kind++) {
        McdGeometryID g = solid(f, kind, 1);
        MeMatrix4 tm;
        MeVector3 centre, d, p;
        MeReal radius;
        double max = 0;
        MeMatrix4TMMakeIdentity(tm);
        McdGeometryGetBSphere(g, centre, &radius);
        for (int n = 0; n < 50; n++) {
            for (int k = 0; k < 3; k++)
                d[k] = (MeReal)uniform(-1, 1);
            for (int i = 0; i < 30; i++) { /* round corners are climbed */
                McdGeometryMaximumPoint(g, tm, d, p);
                MeVector3Subtract(d, p, centre);
            }
            max = fmax(max, MeVector3Magnitude(d));
        }
        assert_near(max, radius, TOL(5e-7, 3e-15));
        McdGeometryDestroy(g);
    }
}

static int lines;
static double lineReach;

static void MEAPI countLine(MeVector3 start, MeVector3 end, MeReal r, MeReal g, MeReal b) {
    lines++;
    lineReach = fmax(lineReach, fmax(MeVector3Magnitude(start), MeVector3Magnitude(end)));
    ck_assert(r == 1 && g == 0 && b == 0);
}

TEST(all_can_be_drawn) {
    McdFrameworkID f = framework();
    const MeReal red[3] = {1, 0, 0};
    const MeDebugLineFuncPtr before = MeDebugDrawAPI.line;
    MeDebugDrawAPI.line = countLine;
    for (int kind = 0; kind < SOLIDS; kind++) {
        McdGeometryID g = solid(f, kind, 1);
        McdModelID m = McdModelCreate(g);
        MeMatrix4 tm;
        MeVector3 centre;
        MeReal radius;
        MeMatrix4TMMakeIdentity(tm);
        lines = 0;
        lineReach = 0;
        McduDebugDrawModel(m, kMcduDebugDrawDetail, red); /* has no place yet */
        ck_assert_int_eq(lines, 0);
        McdModelSetTransformPtr(m, tm);
        McdModelUpdate(m);
        McduDebugDrawModel(m, kMcduDebugDrawDetail, red);
        ck_assert_int_ge(lines, 8);
        McdGeometryGetBSphere(g, centre, &radius);
        assert_below(lineReach, radius + MeVector3Magnitude(centre) + (MeReal)1e-6);
        lines = 0;
        McduDebugDrawModel(m, kMcduDebugDrawAABB, red);
        ck_assert_int_eq(lines, 12);
        McdModelDestroy(m);
        McdGeometryDestroy(g);
    }
    MeDebugDrawAPI.line = before;
}

TEST(a_space_is_drawn_model_by_model) {
    McdFrameworkID f = framework();
    const MeReal red[3] = {1, 0, 0};
    const MeDebugLineFuncPtr before = MeDebugDrawAPI.line;
    McdSpaceID space = McdSpaceAxisSortCreate(f, McdAllAxes, 4, 4);
    McdGeometryID g = McdBoxCreate(f, 1, 1, 1);
    McdModelID m[2];
    MeMatrix4 tm;
    MeMatrix4TMMakeIdentity(tm);
    MeDebugDrawAPI.line = countLine;
    for (int i = 0; i < 2; i++) {
        m[i] = McdModelCreate(g);
        McdModelSetTransformPtr(m[i], tm);
        McdModelUpdate(m[i]);
        McdSpaceInsertModel(space, m[i]);
    }
    McdSpaceFreezeModel(m[0]);
    lines = 0;
    McduDebugDrawSpace(space, kMcduDebugDrawDetail, red);
    ck_assert_int_eq(lines, 24);
    McduDebugDrawSpace(space, (McduDebugDrawFlags)(kMcduDebugDrawDetail | kMcduDebugDrawEnabledOnly), red);
    ck_assert_int_eq(lines, 36);
    lines = 0;
    for (int i = 0; i < 2; i++) {
        McdSpaceRemoveModel(m[i]);
        McdModelDestroy(m[i]);
    }
    McdSpaceDestroy(space);
    McdGeometryDestroy(g);
    MeDebugDrawAPI.line = before;
}

TEST(bad_sizes_are_refused) {
    McdFrameworkID f = framework();
    const MeReal bad[] = {0, -1, NAN, INFINITY, MEINFINITY};
    McdGeometryID ball = McdSphereCreate(f, 1), box = McdBoxCreate(f, 1, 1, 1), cone = McdConeCreate(f, 1, 1);
    McdGeometryID cylinder = McdCylinderCreate(f, 1, 1), sphyl = McdSphylCreate(f, 1, 1);
    assert_silent();
    for (int i = 0; i < 5; i++) {
        assert_none(McdSphereCreate, f, bad[i]);
        assert_none(McdBoxCreate, f, 1, bad[i], 1);
        assert_none(McdCylinderCreate, f, bad[i], 1);
        assert_none(McdSphylCreate, f, 1, bad[i]);
        assert_none(McdConeCreate, f, bad[i], 1);
        assert_none(McdConvexMeshCreateSphyl, f, bad[i], 1);
        assert_refused(McdSphereSetRadius, ball, bad[i]);
        assert_refused(McdBoxSetDimensions, box, 1, 1, bad[i]);
        assert_refused(McdCylinderSetHeight, cylinder, bad[i]);
        assert_refused(McdSphylSetRadius, sphyl, bad[i]);
        assert_refused(McdConeSetGeometricalParameters, cone, 1, bad[i], bad[i]);
    }
    ck_assert(McdSphereGetRadius(ball) == 1 && McdCylinderGetHeight(cylinder) == 1 && McdConeGetLength(cone) == 1);
}

TEST(bad_meshes_are_refused) {
    McdFrameworkID f = framework();
    MeVector3 v[5] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}};
    assert_none(McdConvexMeshCreateHull, f, (const MeVector3 *)v, 4, 0);
    assert_none(McdConvexMeshCreateHull, f, (const MeVector3 *)v, 2, 0);
    assert_none(McdConvexMeshCreateHull, f, NULL, 5, 0);
    assert_none(McdConvexMeshCreateHull, f, (const MeVector3 *)v, 5, -1);
    assert_none(McdConvexMeshCreateHull, NULL, (const MeVector3 *)v, 5, 0);
    McdGeometryID g = McdConvexMeshCreateHull(f, (const MeVector3 *)v, 5, 0);
    ck_assert_ptr_nonnull(g);
    assert_silent();
    assert_none(McdConvexMeshGetPolygonVertexPtr, g, 0, 4);
    assert_none(McdConvexMeshGetPolygonVertexCount, g, 5);
    McdGeometryDestroy(g);
    v[4][2] = (MeReal)NAN;
    ck_assert_ptr_null(McdConvexMeshCreateHull(f, (const MeVector3 *)v, 5, 0));
    assert_warned("not finite");
}

TEST(wrong_types_are_refused) {
    McdFrameworkID f = framework(), bare = McdInit(0, 1, 0, 1);
    McdGeometryID ball = McdSphereCreate(f, 1), box = McdBoxCreate(f, 1, 1, 1);
    assert_none(McdSphereGetRadius, box);
    assert_none(McdBoxGetRadii, ball);
    assert_none(McdConvexMeshGetPolygonCount, ball);
    assert_none(McdCylinderGetRadius, NULL);
    assert_none(McdSphereCreate, bare, 1);
    assert_none(McdPlaneCreate, NULL);
    assert_refused(McdPrimitivesRegisterTypes, NULL);
    McdTerm(bare);
}

TEST(primitives_at_once) {
    McdFrameworkID f = McdInit(0, 1, 0, 1);
    McdPrimitivesRegisterTypes(f);
    ck_assert_int_eq(McdFrameworkGetRegisteredTypeCount(f), (int)McdPrimitivesGetTypeCount());
    ck_assert_int_eq(McdPrimitivesRegisterInteractions(f), 1);
    const int type[] = {kMcdGeometryTypeSphere, kMcdGeometryTypeBox, kMcdGeometryTypeCylinder, kMcdGeometryTypeSphyl,
                        kMcdGeometryTypePlane};
    for (int i = 0; i < 5; i++) {
        ck_assert_ptr_nonnull(McdFrameworkGetLineSegInteraction(f, type[i]));
        for (int j = 0; j <= i && j < 4; j++)
            ck_assert(McdFrameworkGetInteractions(f, type[i], type[j]) ||
                      McdFrameworkGetInteractions(f, type[j], type[i]));
    }
    McdTerm(f);
    f = McdInit(0, 1, 0, 1);
    McdSphereBoxPlaneRegisterTypes(f);
    McdSphereBoxPlaneRegisterInteractions(f);
    ck_assert_int_eq(McdFrameworkGetRegisteredTypeCount(f), 3);
    McdTerm(f);
}
