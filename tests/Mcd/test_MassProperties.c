/* Mass properties: closed forms, integration over columns, and what moving, turning and fattening do to them. */
#include "shapes.h"

typedef struct Mass {
    MeMatrix4 at;
    MeMatrix3 inertia;
    MeReal volume;
} Mass;

static Mass massOf(McdGeometryID g) {
    Mass m;
    ck_assert_int_eq(McdGeometryGetMassProperties(g, m.at, m.inertia, &m.volume), 1);
    return m;
}

/* Where the column at x, y begins or ends, from a z inside to one outside. */
static double edgeOfColumn(int kind, double x, double y, double inside, double outside) {
    for (int i = 0; i < 40; i++) {
        const double middle = (inside + outside) / 2, p[3] = {x, y, middle};
        *(excess(kind, p) > 0 ? &outside : &inside) = middle;
    }
    return inside;
}

/* A z inside the column, or NaN: the least of what is a convex function of z. */
static double withinColumn(int kind, double x, double y) {
    double low = -2, high = 2;
    for (int i = 0; i < 45; i++) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3, p[3] = {x, y, a}, q[3] = {x, y, b};
        if (excess(kind, p) < excess(kind, q))
            high = b;
        else
            low = a;
    }
    const double p[3] = {x, y, low};
    return excess(kind, p) <= 0 ? low : NAN;
}

/* Integrals of 1, z and the squares, exact along z; the error across falls as N^-1.5, and the boxes' sides lie
 * between columns. */
static void integrate(int kind, double *m, double *mz, double square[3]) {
    enum { N = 400 };
    const double h = 2. / N;
    *m = *mz = square[0] = square[1] = square[2] = 0;
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            const double x = (i + .5) * h - 1, y = (j + .5) * h - 1, z = withinColumn(kind, x, y);
            if (isnan(z))
                continue;
            const double low = edgeOfColumn(kind, x, y, z, -2), high = edgeOfColumn(kind, x, y, z, 2);
            const double column = h * h * (high - low);
            *m += column;
            *mz += h * h * (high * high - low * low) / 2;
            square[0] += column * x * x;
            square[1] += column * y * y;
            square[2] += h * h * (high * high * high - low * low * low) / 3;
        }
}

TEST(columns_add_up_to_the_same) {
    McdFrameworkID f = framework();
    for (int kind = 0; kind < SOLIDS; kind++) {
        double m, mz, square[3];
        integrate(kind, &m, &mz, square);
        McdGeometryID g = solid(f, kind, 1);
        const Mass mass = massOf(g);
        assert_near_rel(mass.volume, m, 1e-3);
        assert_vec3_near(mass.at[3], 0, 0, 0, TOL(1e-7, 1e-15));
        assert_near(mz / m, 0, 8e-6);
        for (int k = 0; k < 3; k++) {
            assert_near_rel(mass.inertia[k][k], square[(k + 1) % 3] + square[(k + 2) % 3], 2e-3);
            assert_near(mass.inertia[k][(k + 1) % 3], 0, TOL(9e-16, 1e-16));
            assert_near(mass.inertia[(k + 1) % 3][k], 0, TOL(9e-16, 1e-16));
        }
        McdGeometryDestroy(g);
    }
}

TEST(closed_forms) {
    McdFrameworkID f = framework();
    McdGeometryID g = McdBoxCreate(f, 2, 3, 4);
    Mass m = massOf(g);
    assert_near_rel(m.volume, 24, TOL(1e-7, 1e-15));
    assert_near_rel(m.inertia[0][0], 24 * 25 / 12., TOL(1e-7, 1e-15));
    assert_near_rel(m.inertia[1][1], 24 * 20 / 12., TOL(1e-7, 1e-15));
    assert_near_rel(m.inertia[2][2], 24 * 13 / 12., TOL(1e-7, 1e-15));
    McdGeometryDestroy(g);
    g = McdConeCreate(f, 4, 3); /* V = pi r^2 h/3, I_z = 3/10 m r^2, I_x = 3/80 m (4 r^2 + h^2) */
    m = massOf(g);
    assert_near_rel(m.volume, 12 * 3.14159265358979, TOL(5e-7, 1e-14));
    assert_near_rel(m.inertia[2][2], .3 * 9 * 12 * 3.14159265358979, TOL(5e-7, 1e-14));
    assert_near_rel(m.inertia[0][0], 3 / 80. * (36 + 16) * 12 * 3.14159265358979, TOL(5e-7, 1e-14));
    McdGeometryDestroy(g);
    g = cutCone(f, 4, 3, 3); /* a cylinder */
    McdGeometryID c = McdCylinderCreate(f, 3, 4);
    m = massOf(g);
    const Mass n = massOf(c);
    assert_near_rel(m.volume, n.volume, TOL(5e-7, 2e-15));
    assert_near_rel(m.inertia[0][0], n.inertia[0][0], TOL(5e-7, 9e-16));
    assert_near_rel(m.inertia[2][2], n.inertia[2][2], TOL(5e-7, 9e-16));
}

/* The integral of x^2 over a box with half sizes a, b, c and all within r of it: box, faces, edges, corners. */
static double fatSquare(double a, double b, double c, double r) {
    const double pi = 3.14159265358979323846;
    const double faces = 8 * b * c * (pow(a + r, 3) - pow(a, 3)) / 3 + 8 * r * (a * c + a * b) * a * a / 3;
    const double quarter = a * a * pi * r * r / 4 + 2 * a * r * r * r / 3 + pi * pow(r, 4) / 16;
    const double edges = pi * r * r * 2 * a * a * a / 3 + 8 * (b + c) * quarter;
    const double corners = 8 * (a * a * pi * pow(r, 3) / 6 + 2 * a * pi * pow(r, 4) / 16 + pi * pow(r, 5) / 30);
    return 8 * a * b * c * a * a / 3 + faces + edges + corners;
}

/* V = abc + 2 r (ab + bc + ca) + pi r^2 (a + b + c) + 4/3 pi r^3; and for a hull that is next to nothing, a ball's. */
TEST(a_fat_box_by_steiners_formula) {
    McdFrameworkID f = framework();
    const double pi = 3.14159265358979323846, half[3] = {.5, 1, 1.5}, a = 1, b = 2, c = 3;
    for (double r = 0; r < 3; r = 2 * r + .1) {
        McdGeometryID g = boxMesh(f, half, 1, r);
        const Mass m = massOf(g);
        const double rr = (double)(MeReal)r;
        assert_near_rel(m.volume,
                        a * b * c + 2 * rr * (a * b + b * c + c * a) + pi * rr * rr * (a + b + c) +
                            4. / 3 * pi * rr * rr * rr,
                        TOL(1e-7, 1e-14));
        const double square[3] = {fatSquare(.5, 1, 1.5, rr), fatSquare(1, 1.5, .5, rr), fatSquare(1.5, .5, 1, rr)};
        for (int k = 0; k < 3; k++)
            assert_near_rel(m.inertia[k][k], square[(k + 1) % 3] + square[(k + 2) % 3], TOL(1e-7, 1e-14));
        McdGeometryDestroy(g);
    }
    McdGeometryID point = boxMesh(f, half, 1e-7, 1e7), ball = McdSphereCreate(f, 1);
    const Mass m = massOf(point), n = massOf(ball);
    assert_near_rel(m.volume, n.volume, 2e-6);
    for (int k = 0; k < 3; k++)
        assert_near_rel(m.inertia[k][k], n.inertia[k][k], 2e-6);
}

static const double tetrahedron[4][3] = {{0, 0, 0}, {1, .2, .1}, {.3, .9, -.1}, {.2, .3, .8}};

static McdGeometryID fatTetrahedron(McdFrameworkID f, double fatness) {
    MeVector3 v[4];
    for (int i = 0; i < 4; i++)
        MeVector3Set(v[i], tetrahedron[i][0], tetrahedron[i][1], tetrahedron[i][2]);
    return McdConvexMeshCreateHull(f, (const MeVector3 *)v, 4, fatness);
}

/* The same with balls of many corners at its corners. */
static McdGeometryID roughTetrahedron(McdFrameworkID f, double fatness) {
    enum { N = 1500 };
    static MeVector3 v[4 * N];
    for (int i = 0; i < 4 * N; i++) {
        const double z = 1 - (2 * (i % N) + 1.) / N, r = sqrt(1 - z * z), turn = 2.399963229728653 * (i % N);
        const double d[3] = {r * cos(turn), r * sin(turn), z};
        for (int k = 0; k < 3; k++)
            v[i][k] = (MeReal)(tetrahedron[i / N][k] + fatness * d[k]);
    }
    return McdConvexMeshCreateHull(f, (const MeVector3 *)v, 4 * N, 0);
}

TEST(a_fat_hull_is_the_limit_of_hulls) {
    McdFrameworkID f = framework();
    for (double r = .1; r < 2; r *= 3) {
        McdGeometryID a = fatTetrahedron(f, r), b = roughTetrahedron(f, r);
        const Mass m = massOf(a), n = massOf(b);
        assert_near_rel(m.volume, n.volume, 5e-3);
        ck_assert(m.volume > n.volume);
        const double size = (double)(n.inertia[0][0] + n.inertia[1][1] + n.inertia[2][2]) / 3;
        for (int i = 0; i < 3; i++) {
            assert_near(m.at[3][i], n.at[3][i], 3e-4);
            for (int j = 0; j < 3; j++)
                assert_near(m.inertia[i][j], n.inertia[i][j], (i == j ? 8e-3 : 8e-4) * size);
        }
        McdGeometryDestroy(a);
        McdGeometryDestroy(b);
    }
}

/* A tetrahedron's: V = det/6, the centre the mean; with covariance V/20 (sum v v^T + s s^T) from its centre, where s =
 * 0. */
TEST(a_tetrahedron_off_the_origin) {
    McdFrameworkID f = framework();
    for (double away = 0; away < 200; away = away * 3 + 1) {
        MeVector3 v[4];
        double centre[3] = {0, 0, 0}, sum[3][3] = {{0}};
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 3; k++) {
                v[i][k] = (MeReal)(tetrahedron[i][k] + away);
                centre[k] += (double)v[i][k] / 4;
            }
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++)
                    sum[k][l] += ((double)v[i][k] - centre[k]) * ((double)v[i][l] - centre[l]);
        McdGeometryID g = McdConvexMeshCreateHull(f, (const MeVector3 *)v, 4, 0);
        const Mass m = massOf(g);
        MeVector3 e[3];
        for (int i = 0; i < 3; i++)
            MeVector3Subtract(e[i], v[i + 1], v[0]);
        const double volume = fabs(MeVector3ScalarTripleProduct(e[0], e[1], e[2])) / 6;
        assert_near_rel(m.volume, volume, TOL(1e-6, 2e-15));
        const double trace = sum[0][0] + sum[1][1] + sum[2][2];
        for (int k = 0; k < 3; k++) {
            assert_near(m.at[3][k], centre[k], TOL(2e-7, 1e-15) * (1 + away));
            for (int l = 0; l < 3; l++)
                assert_near(m.inertia[k][l], volume / 20 * ((k == l ? trace : 0) - sum[k][l]), TOL(4e-9, 2e-17));
        }
        McdGeometryDestroy(g);
    }
}

TEST(size_goes_with_its_powers) {
    McdFrameworkID f = framework();
    for (int kind = 0; kind < SOLIDS; kind++) {
        McdGeometryID one = solid(f, kind, 1);
        const Mass m = massOf(one);
        for (double s = 1e-3; s < 2e3; s *= 10) {
            McdGeometryID g = solid(f, kind, s);
            const Mass n = massOf(g);
            assert_near_rel(n.volume, (double)m.volume * pow(s, 3), TOL(1e-6, 5e-14));
            for (int k = 0; k < 3; k++)
                assert_near_rel(n.inertia[k][k], (double)m.inertia[k][k] * pow(s, 5), TOL(2e-6, 4e-14));
            McdGeometryDestroy(g);
        }
        McdGeometryDestroy(one);
    }
}

TEST(some_have_none) {
    McdFrameworkID f = framework();
    McdGeometryID g[2] = {McdPlaneCreate(f), McdNullCreate(f)};
    for (int i = 0; i < 2; i++) {
        Mass m;
        ck_assert_int_eq(McdGeometryGetMassProperties(g[i], m.at, m.inertia, &m.volume), 0);
        assert_near(m.volume, 0, 0);
        McdGeometryDestroy(g[i]);
    }
}
