/* Hulls: closed, convex, with merged faces, and the same for points of any size. */
#include "karma_test.h"
#include "model/mcd_geometries_i.h"
#include "random_numbers.h"

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static McdHull *make(double (*p)[3], int n) {
    return mcd_hullCreate((const double(*)[3])p, n, "test");
}

static void checkEdges(const McdHull *h) {
    int bad = 0;
    for (int i = 0; i < h->edgeCount; i++)
        for (int side = 0; side < 2; side++) {
            const McdHullFace *f = &h->face[h->edgeFace[i][side]];
            const int from = h->edge[i][side], to = h->edge[i][1 - side];
            int found = 0;
            for (int k = 0; k < f->count; k++)
                found += h->faceVertex[f->first + k] == from && h->faceVertex[f->first + (k + 1) % f->count] == to;
            bad += found != 1;
        }
    ck_assert_int_eq(bad, 0);
}

static void checkNeighbours(const McdHull *h) {
    int bad = 0;
    ck_assert_int_eq(h->neighbourFirst[0], 0);
    ck_assert_int_eq(h->neighbourFirst[h->vertexCount], 2 * h->edgeCount);
    for (int i = 0; i < h->edgeCount; i++)
        for (int side = 0; side < 2; side++) {
            const int a = h->edge[i][side], b = h->edge[i][1 - side];
            int found = 0;
            for (int k = h->neighbourFirst[a]; k < h->neighbourFirst[a + 1]; k++)
                found += h->neighbour[k] == b;
            bad += found != 1;
        }
    ck_assert_int_eq(bad, 0);
}

/* All given points are within each face to `slack` of the extent, a face's own corners on it, and none above it. */
static void checkFaces(const McdHull *h, double (*p)[3], int n, double slack) {
    int corners = 0, bad = 0;
    double outside = 0, low = 0, high = 0, length = 0;
    for (int i = 0; i < h->faceCount; i++) {
        const McdHullFace *f = &h->face[i];
        bad += f->first != corners || f->count < 3;
        corners += f->count;
        length = fmax(length, fabs(dot(f->normal, f->normal) - 1));
        for (int k = 0; k < n; k++)
            outside = fmax(outside, dot(f->normal, p[k]) - f->offset);
        for (int k = 0; k < f->count; k++) {
            const double gap = f->offset - dot(f->normal, h->vertex[h->faceVertex[f->first + k]]);
            low = fmin(low, gap);
            high = fmax(high, gap);
        }
    }
    ck_assert_int_eq(bad, 0);
    ck_assert_int_eq(corners, 2 * h->edgeCount);
    assert_near(length, 0, 1e-14);
    assert_below(outside, slack * h->extent);
    assert_below(high, slack * h->extent);
    ck_assert(low >= 0);
}

static void checkHull(const McdHull *h, double (*p)[3], int n, double slack) {
    ck_assert_ptr_nonnull(h);
    ck_assert_int_eq(h->vertexCount - h->edgeCount + h->faceCount, 2);
    checkFaces(h, p, n, slack);
    checkEdges(h);
    checkNeighbours(h);
}

static int cubeCorners(double (*p)[3]) {
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++)
            p[i][k] = (i >> k & 1) ? 1 : -1;
    return 8;
}

/* Turns, scales and moves points, and rounds them as a program in single precision would have them. */
static void place(double (*p)[3], int n, double angle, double size, double away) {
    const double c = cos(angle), s = sin(angle), d = cos(2 * angle), t = sin(2 * angle);
    for (int i = 0; i < n; i++) {
        const double x = c * p[i][0] - s * p[i][1], y = s * p[i][0] + c * p[i][1], z = p[i][2];
        p[i][0] = (double)(float)(size * x + away);
        p[i][1] = (double)(float)(size * (d * y - t * z) + away);
        p[i][2] = (double)(float)(size * (t * y + d * z) - away);
    }
}

static void checkCube(double (*p)[3], int n, double slack) {
    McdHull *h = make(p, n);
    checkHull(h, p, n, slack);
    ck_assert_int_eq(h->vertexCount, 8);
    ck_assert_int_eq(h->edgeCount, 12);
    ck_assert_int_eq(h->faceCount, 6);
    mcd_hullDestroy(h);
}

TEST(a_cube_has_six_faces) {
    for (double size = 1e-3; size < 2e3; size *= 1e3)
        for (int turn = 0; turn < 50; turn++) {
            double p[8][3];
            place(p, cubeCorners(p), turn * .13, size, 0);
            checkCube(p, 8, 1e-6);
        }
}

TEST(inner_and_double_points_do_not_count) {
    for (int turn = 0; turn < 50; turn++) {
        double p[8 + 125 + 300 + 40][3];
        int n = 0;
        for (int i = 0; i < 300; i++, n++)
            for (int k = 0; k < 3; k++)
                p[n][k] = uniform(-1, 1);
        n += cubeCorners(p + n);
        for (int i = 0; i < 125; i++, n++) { /* a grid: also on faces and edges */
            p[n][0] = i % 5 * .5 - 1;
            p[n][1] = i / 5 % 5 * .5 - 1;
            p[n][2] = i / 25 * .5 - 1;
        }
        for (int i = 0; i < 40; i++, n++)
            memcpy(p[n], p[300 + i], sizeof p[n]);
        place(p, n, turn * .13, 1, 0);
        checkCube(p, n, 1e-6);
    }
}

TEST(away_from_the_origin_a_cube_is_a_cube) {
    for (double size = 1e-3; size < 2e3; size *= 1e3)
        for (double away = 0; away < 2e6; away = away * 10 + 1) {
            double p[8][3];
            cubeCorners(p);
            for (int i = 0; i < 8; i++)
                for (int k = 0; k < 3; k++)
                    p[i][k] = p[i][k] * size + away * size;
            checkCube(p, 8, 1e-6 + 1e-15 * away);
        }
}

TEST(points_on_a_ball) {
    for (int n = 4; n < 3000; n *= 3) {
        static double p[3000][3];
        for (int i = 0; i < n; i++) {
            const double z = uniform(-1, 1), a = uniform(0, 2 * 3.14159265358979323846), r = sqrt(1 - z * z);
            p[i][0] = r * cos(a);
            p[i][1] = r * sin(a);
            p[i][2] = z;
        }
        place(p, n, 0, 1, 0);
        McdHull *h = make(p, n);
        checkHull(h, p, n, 2e-6);
        ck_assert_int_ge(h->vertexCount, n - n / 100); /* very few are within others' edges */
        mcd_hullDestroy(h);
    }
}

TEST(prisms_of_many_sides) {
    for (int sides = 3; sides <= 400; sides = sides * 3 / 2 + 1)
        for (double height = 1e-4; height < 2e4; height *= 1e4) {
            static double p[800][3];
            for (int i = 0; i < sides; i++)
                for (int k = 0; k < 2; k++) {
                    p[2 * i + k][0] = cos(i * 2 * 3.14159265358979323846 / sides);
                    p[2 * i + k][1] = sin(i * 2 * 3.14159265358979323846 / sides);
                    p[2 * i + k][2] = k * height;
                }
            if (height > 1 && sides > 10)
                continue; /* a needle's sides would be below the tolerance */
            McdHull *h = make(p, 2 * sides);
            checkHull(h, p, 2 * sides, 2e-6);
            ck_assert_int_eq(h->faceCount, sides + 2);
            ck_assert_int_eq(h->vertexCount, 2 * sides);
            mcd_hullDestroy(h);
        }
}

/* To a sixth of the tolerance: the corners of a facet across the face carry their bumps on, three times as far. */
TEST(nearly_coplanar_points_are_coplanar) {
    for (double bump = 5e-16; bump < 1e-7; bump *= 10)
        for (int turn = 0; turn < 20; turn++) {
            double p[8 + 60][3];
            int n = cubeCorners(p);
            for (int i = 0; i < 60; i++, n++) {
                p[n][0] = uniform(-1, 1);
                p[n][1] = uniform(-1, 1);
                p[n][2] = 1;
                for (int k = 0; k < 3; k++)
                    p[n][k] += uniform(-bump, bump);
            }
            checkCube(p, n, 2e-6);
        }
}

/* Bumps about the tolerance may or may not make faces, but always a sound hull. */
TEST(bumps_of_any_height_make_a_hull) {
    for (double bump = 1e-9; bump < .1; bump *= 2)
        for (int turn = 0; turn < 20; turn++) {
            double p[500][3];
            for (int i = 0; i < 500; i++) {
                const int axis = i % 3;
                for (int k = 0; k < 3; k++)
                    p[i][k] = k == axis ? (i % 2 ? 1 : -1) : uniform(-1, 1);
                for (int k = 0; k < 3; k++)
                    p[i][k] += uniform(-bump, bump);
            }
            McdHull *h = make(p, 500);
            checkHull(h, p, 500, 5e-6);
            mcd_hullDestroy(h);
        }
}

TEST(the_order_is_the_points) {
    double p[200][3];
    for (int i = 0; i < 200; i++)
        for (int k = 0; k < 3; k++)
            p[i][k] = uniform(-1, 1);
    McdHull *h = make(p, 200), *again = make(p, 200);
    int at = -1;
    for (int i = 0; i < h->vertexCount; i++) { /* vertices in the order given */
        int j = at + 1;
        while (j < 200 && memcmp(p[j], h->vertex[i], sizeof p[j]) != 0)
            j++;
        ck_assert_int_lt(j, 200);
        at = j;
    }
    for (int i = 1; i < h->faceCount; i++)
        ck_assert_int_ge(h->faceVertex[h->face[i].first], h->faceVertex[h->face[i - 1].first]);
    ck_assert_int_eq(h->faceCount, again->faceCount);
    ck_assert_int_eq(memcmp(h->vertex, again->vertex, (size_t)h->vertexCount * sizeof *h->vertex), 0);
    ck_assert_int_eq(memcmp(h->face, again->face, (size_t)h->faceCount * sizeof *h->face), 0);
    ck_assert_int_eq(memcmp(h->edge, again->edge, (size_t)h->edgeCount * sizeof *h->edge), 0);
    mcd_hullDestroy(h);
    mcd_hullDestroy(again);
}

static void checkNone(double (*p)[3], int n, const char *word) {
    ck_assert_ptr_null(make(p, n));
    ck_assert(strstr(caught.last, word) != NULL);
    assert_warned("test");
}

TEST(what_has_no_volume_is_refused) {
    double p[20][3];
    checkNone(NULL, 8, "4");
    cubeCorners(p);
    checkNone(p, 3, "4");
    checkNone(p, 0, "4");
    checkNone(p, -5, "4");
    checkNone(p, 4, "volume"); /* a square */
    for (int i = 0; i < 20; i++)
        p[i][0] = p[i][1] = p[i][2] = i * .37; /* a line */
    checkNone(p, 20, "volume");
    for (int i = 0; i < 20; i++)
        p[i][0] = p[i][1] = p[i][2] = 3; /* a point */
    checkNone(p, 20, "place");
    for (double thick = 1e-20; thick < 3e-7; thick *= 10) { /* a sheet, in any direction */
        for (int i = 0; i < 20; i++) {
            const double a = uniform(-1, 1), b = uniform(-1, 1), c = uniform(-thick, thick);
            p[i][0] = a + c;
            p[i][1] = b - a + c;
            p[i][2] = -b + c;
        }
        checkNone(p, 20, "volume");
    }
    const double bad[] = {NAN, INFINITY, -INFINITY, 1e300};
    for (int i = 0; i < 4; i++) {
        cubeCorners(p);
        p[5][1] = bad[i];
        checkNone(p, 8, "");
    }
    mcd_hullDestroy(NULL);
}
