/* The shapes' triangles: counts, places, normals, and that closed ones are closed. */
#include "RGeometryUtils.h"
#include "viewer_test.h"

/* What is asked of every vertex: finite, with a normal of length 1, in a box. */
static void checkVertices(const RGraphic *g, int count, double x, double y, double z) {
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, count);
    for (int i = 0; i < count; i++) {
        const RObjectVertex *v = &g->m_pVertices[i];
        assert_near(sqrt(v->m_NX * v->m_NX + v->m_NY * v->m_NY + v->m_NZ * v->m_NZ), 1, 1e-5);
        assert_below(fabs(v->m_X), x + 1e-5);
        assert_below(fabs(v->m_Y), y + 1e-5);
        assert_below(fabs(v->m_Z), z + 1e-5);
    }
}

/* Six times the volume inside, by the divergence theorem: right only if the shape is closed and faces outwards. */
static double volume(const RGraphic *g) {
    double sum = 0;
    for (int i = 0; i < g->m_pObject->m_nNumVertices; i += 3) {
        const RObjectVertex *a = &g->m_pVertices[i], *b = a + 1, *c = a + 2;
        sum += (double)a->m_X * ((double)b->m_Y * (double)c->m_Z - (double)b->m_Z * (double)c->m_Y) +
               (double)a->m_Y * ((double)b->m_Z * (double)c->m_X - (double)b->m_X * (double)c->m_Z) +
               (double)a->m_Z * ((double)b->m_X * (double)c->m_Y - (double)b->m_Y * (double)c->m_X);
    }
    return sum / 6;
}

/* Each edge is passed once in each direction, between places that are equal to the last bit. */
static void checkClosed(const RGraphic *g) {
    const int n = g->m_pObject->m_nNumVertices;
    for (int i = 0; i < n; i++) {
        const RObjectVertex *a = &g->m_pVertices[i], *b = &g->m_pVertices[i % 3 == 2 ? i - 2 : i + 1];
        int back = 0;
        for (int j = 0; j < n; j++) {
            const RObjectVertex *p = &g->m_pVertices[j], *q = &g->m_pVertices[j % 3 == 2 ? j - 2 : j + 1];
            back += p->m_X == b->m_X && p->m_Y == b->m_Y && p->m_Z == b->m_Z && q->m_X == a->m_X && q->m_Y == a->m_Y &&
                    q->m_Z == a->m_Z;
        }
        ck_assert_int_eq(back, 1);
    }
}

static RGraphic *room(int vertices) {
    ck_assert_int_gt(vertices, 0);
    return RGraphicCreateEmpty(vertices);
}

TEST(box) {
    RGraphic *g = room(RCalculateBoxVertexCount());
    RCalculateBoxGeometry(g, 2, 4, 6);
    checkVertices(g, 36, 1, 2, 3);
    assert_near(volume(g), 48, 1e-5);
    checkClosed(g);
    RGraphicDestroy(g);
}

TEST(sphere) {
    RGraphic *g = room(RCalculateSphereVertexCount(24, 12));
    RCalculateSphereGeometry(g, 2, 24, 12);
    checkVertices(g, 6 * 24 * 11, 2, 2, 2);
    assert_near_rel(volume(g), 4.0 / 3 * acos(-1) * 8, 0.04);
    checkClosed(g);
    for (int i = 0; i < g->m_pObject->m_nNumVertices; i++)
        assert_near(g->m_pVertices[i].m_X, 2 * g->m_pVertices[i].m_NX, 1e-5);
    RGraphicDestroy(g);
}

TEST(sphyl) {
    RGraphic *g = room(RCalculateSphylVertexCount(24, 12));
    RCalculateSphylGeometry(g, 1, 3, 24, 12);
    checkVertices(g, 6 * 24 * 12, 1, 1, 2.5);
    assert_near_rel(volume(g), acos(-1) * (4.0 / 3 + 3), 0.03);
    checkClosed(g);
    RGraphicDestroy(g);
}

TEST(cone) {
    RGraphic *g = room(RCalculateConeVertexCount(32));
    RCalculateConeGeometry(g, 1, -1, 2, 32);
    checkVertices(g, 6 * 32, 1, 1, 2);
    assert_near_rel(volume(g), acos(-1), 0.01);
    checkClosed(g);
    RGraphicDestroy(g);
}

TEST(frustums) {
    RGraphic *g = room(RCalculateFrustumVertexCount(6));
    RCalculateFrustumGeometry(g, 2, 1, 0, 3, 6);
    checkVertices(g, 12 * 6, 2, 2, 3);
    const double hexagon = 1.5 * sqrt(3);
    assert_near_rel(volume(g), hexagon * 3 / 3 * (4 + 2 + 1), 1e-5);
    checkClosed(g);
    RCalculateFrustumGeometry(g, 0, 1, 0, 3, 6); /* On its tip: fewer vertices. */
    checkVertices(g, 6 * 6, 1, 1, 3);
    assert_near_rel(volume(g), hexagon, 1e-5);
    checkClosed(g);
    RGraphicDestroy(g);
}

TEST(torus) {
    RGraphic *g = room(RCalculateTorusVertexCount(32, 16));
    RCalculateTorusGeometry(g, 3, 1, 32, 16);
    checkVertices(g, 6 * 32 * 16, 3, 3, 1);
    assert_near_rel(volume(g), 2 * acos(-1) * acos(-1) * 2, 0.05);
    checkClosed(g);
    RGraphicDestroy(g);
}

TEST(dome) {
    RGraphic *g = room(RCalculateDomeVertexCount(16, 4));
    RCalculateDomeGeometry(g, 5, 16, 4, 3, 2);
    checkVertices(g, 3 * 16 * 7, 5, 5, 5);
    for (int i = 0; i < g->m_pObject->m_nNumVertices; i++) {
        const RObjectVertex *v = &g->m_pVertices[i];
        ck_assert(v->m_Y >= 0);
        ck_assert(v->m_X * v->m_NX + v->m_Y * v->m_NY + v->m_Z * v->m_NZ < 0); /* Faces inwards. */
        ck_assert(v->m_U >= 0 && v->m_U <= 3 && v->m_V >= 0 && v->m_V <= 2.0001f);
    }
    RGraphicDestroy(g);
}

TEST(one_vertex) {
    RObjectVertex v;
    const MeVector3 p = {1, 2, 3}, n = {0, 1, 0};
    RSetVertex(&v, p, n, 0.25, 0.5);
    ck_assert(v.m_X == 1 && v.m_Y == 2 && v.m_Z == 3 && v.m_NY == 1 && v.m_U == 0.25f && v.m_V == 0.5f);
}

TEST(bad_input) {
    RGraphic *g = RGraphicCreateEmpty(30);
    ck_assert_int_eq(RCalculateSphereVertexCount(2, 10), 0);
    assert_warned("sides");
    ck_assert_int_eq(RCalculateSphereVertexCount(10, 100000), 0);
    assert_warned("rings");
    ck_assert_int_eq(RCalculateSphylVertexCount(10, 5), 0);
    assert_warned("even");
    RCalculateBoxGeometry(g, 1, 1, 1);
    assert_warned("room");
    RCalculateConeGeometry(g, 1, 2, 1, 4);
    assert_warned("height");
    RCalculateConeGeometry(g, NAN, 1, 2, 4);
    assert_warned("radii");
    RCalculateFrustumGeometry(g, 0, 0, 1, 2, 4);
    assert_warned("radii");
    RCalculateTorusGeometry(NULL, 1, 1, 4, 4);
    assert_warned("null");
    RCalculateConeGeometry(g, 1, 1, 2, -5);
    assert_warned("sides");
    RSetVertex(NULL, NULL, NULL, 0, 0);
    assert_warned("vertex");
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 30);
    RGraphicDestroy(g);
}
